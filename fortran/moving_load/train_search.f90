!> The scheme that acts from a position of a train on: found by the search a little further on, nearer where it is not right from
!> there.
module gapbeam_train_search
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: first_train_share, most_train_share, sliver
    use gapbeam_error, only: error_type, has_ended, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_indeterminate, &
        gapbeam_not_converged
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_extended_precision, only: decide_scheme, detail_type
    use gapbeam_train, only: track_type, degree_of
    use gapbeam_train_intervals, only: interval_type
    use gapbeam_train_loads, only: place_train
    use gapbeam_train_traversal, only: traversal_type, not_unique, keep_motion
    use gapbeam_train_margins, only: sample_work, find_interval
    use gapbeam_train_passage, only: passage_type, resolution, find_share, take_stretch, too_near
    implicit none
    private
    public :: search_further

    !> A scheme tried further on
    type :: trial_type
        !> Share of the rest of the interval at which it was found
        real(wp) :: share = 0.0_wp
        !> Is it found in whatever precision it takes; is it right anywhere
        logical :: closely = .false., right = .false.
        type(outcome_type) :: outcome
        type(workspace_type) :: work
    end type trial_type

contains

    !> Find the scheme that acts from here on
    subroutine search_further(track, least, passage, traversal, error)
        type(track_type), intent(inout) :: track
        !> Shares that are left out; grows where nothing else leads on
        real(wp), intent(inout) :: least
        type(passage_type), intent(inout) :: passage
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error
        type(trial_type) :: trial
        logical, allocatable :: before(:)
        logical :: is_place
        integer :: code

        allocate (before, source=passage%closed)
        if (nearly_all_free(passage, traversal)) then
            call take_stretch(track, not_unique, 1.0_wp, passage, traversal, error)
            return
        end if
        ! An interval may be one place only
        is_place = .not. passage%interval%to > passage%interval%from
        trial%share = merge(0.0_wp, first_train_share, is_place)
        do
            call try_scheme(track, before, passage, trial, traversal, error)
            if (has_ended(error)) return
            if (.not. trial%right .and. .not. trial%closely) then
                trial%closely = .true.
                if (allocated(error)) deallocate (error)
                cycle
            end if
            if (allocated(error)) then
                code = error%code
                if (all(code /= [gapbeam_indeterminate, gapbeam_not_converged])) return
                deallocate (error)
                passage%closed(:) = before
                if (.not. is_place) trial%share = so_until(track, passage, trial%share, before, code)
                call take_stretch(track, code, max(trial%share, 2*resolution(track, passage)), passage, traversal, error)
                return
            end if
            if (is_place .or. (trial%right .and. passage%begin <= least)) exit
            if (trial%share <= least) then
                if (least > max(most_train_share, 64*resolution(track, passage))) then
                    call too_near(passage%now + trial%share*(passage%interval%to - passage%now), error)
                    return
                end if
                ! Rounding decides here: leave out what it hides
                least = 4*least
                passage%end = max(passage%end, 2*trial%share)
                exit
            end if
            trial%share = max(min(trial%share/2, passage%begin/2), least)
        end do
        if (is_place) passage%end = 1.0_wp
        call take_trial(track, before, trial, passage, traversal, error)
    end subroutine search_further

    !> Is the rest of an interval but a sliver beside positions at which the beam can move freely: what is loaded by next to nothing
    !> there rounding alone tells
    pure function nearly_all_free(passage, traversal) result(so)
        type(passage_type), intent(in) :: passage
        type(traversal_type), intent(in) :: traversal
        logical :: so

        so = traversal%number > 0
        if (so) so = traversal%status(max(traversal%number, 1)) == not_unique
        associate (now => passage%now, from => passage%interval%from, to => passage%interval%to)
            so = so .and. now > from .and. to - now <= sliver*(to - from)
        end associate
    end function nearly_all_free

    !> Find a scheme further on, and where it is right
    subroutine try_scheme(track, before, passage, trial, traversal, error)
        type(track_type), intent(inout) :: track
        !> Where the search starts
        logical, intent(in) :: before(:)
        type(passage_type), intent(inout) :: passage
        !> With its share, and whether it is found closely
        type(trial_type), intent(inout) :: trial
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error

        passage%closed(:) = before
        associate (interval => passage%interval, now => passage%now, share => trial%share, right => trial%right, &
                   outcome => trial%outcome, work => trial%work)
            if (trial%closely .or. .not. allocated(work%nodes)) call new_workspace(track%beam, work)
            call find_scheme(track, interval, now + share*(interval%to - now), trial%closely, passage%closed, work, outcome, error)
            traversal%solves = traversal%solves + work%solves
            right = .not. allocated(error)
            if (right .and. .not. trial%closely) right = .not. outcome%in_doubt
            if (right .and. outcome%status == gapbeam_solved .and. .not. outcome%indifferent) then
                call find_share(track, share, passage, traversal, right)
            else if (right .and. outcome%status == gapbeam_no_equilibrium) then
                call sample_work(track, interval, now, outcome%motion, passage%margins)
                call find_interval(passage%margins, degree_of(track%train), share, passage%begin, passage%end, passage%at_end)
            else if (right) then
                passage%begin = 0.0_wp
                passage%end = so_until(track, passage, share, before, not_unique)
            end if
            if (right) right = passage%end > 0.0_wp .or. .not. interval%to > interval%from
        end associate
    end subroutine try_scheme

    !> Take the stretch of a trial
    subroutine take_trial(track, before, trial, passage, traversal, error)
        !> As for try_scheme
        type(track_type), intent(in) :: track
        logical, intent(in) :: before(:)
        type(trial_type), intent(in) :: trial
        type(passage_type), intent(inout) :: passage
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: end
        integer :: status

        end = max(passage%end, 2*resolution(track, passage))
        status = trial%outcome%status
        if (status /= gapbeam_no_equilibrium) status = merge(not_unique, gapbeam_solved, trial%outcome%indifferent)
        if (status /= gapbeam_solved) passage%closed(:) = before
        call take_stretch(track, status, end, passage, traversal, error)
        if (status == gapbeam_solved) then
            if (passage%now < passage%interval%to) passage%closed(:) = passage%closed .neqv. passage%at_end
        else if (status == gapbeam_no_equilibrium) then
            if (.not. allocated(error)) call keep_motion(traversal, trial%outcome%motion, error)
        end if
    end subroutine take_trial

    !> The scheme with the train at a place
    subroutine find_scheme(track, interval, place, closely, closed, work, outcome, error)
        type(track_type), intent(inout) :: track
        type(interval_type), intent(in) :: interval
        real(wp), intent(in) :: place
        !> In whatever precision it takes, and refused where it is not unique
        logical, intent(in) :: closely
        !> As for find_contact_state
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(detail_type) :: links_only

        call place_train(track, interval, place)
        call set_loads(track%beam, 1.0_wp, work)
        if (closely) then
            call decide_scheme(track%beam, links_only, 1.0_wp, rule_block, closed, work, outcome, error)
        else
            call find_contact_state(track%beam, 1.0_wp, rule_block, closed, work, outcome, error)
        end if
    end subroutine find_scheme

    !> How far a beam that can move freely without work of the loads, or has no unique answer, stays so: tried at a few places up to
    !> the end of the interval, else half as far, and so on
    function so_until(track, passage, least, start, status) result(share)
        type(track_type), intent(inout) :: track
        type(passage_type), intent(in) :: passage
        !> Known to be so up to this share of what is left
        real(wp), intent(in) :: least
        logical, intent(in) :: start(:)
        !> not_unique, or the code of the error
        integer, intent(in) :: status
        real(wp) :: share
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:)
        logical :: stays
        integer :: k

        call new_workspace(track%beam, work)
        share = 1.0_wp
        do while (share > least)
            do k = 3, 1, -1
                closed = start
                associate (interval => passage%interval, now => passage%now)
                    call find_scheme(track, interval, now + share*(k/3.0_wp - first_train_share)*(interval%to - now), &
                                     status /= not_unique, closed, work, outcome, error)
                end associate
                if (status == not_unique) then
                    stays = .not. allocated(error) .and. outcome%indifferent
                else
                    stays = allocated(error)
                    if (stays) stays = error%code == status
                end if
                if (.not. stays) exit
            end do
            if (stays) return
            share = share/2
        end do
        share = least
    end function so_until

end module gapbeam_train_search
