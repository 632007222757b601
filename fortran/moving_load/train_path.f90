!> A train on its way over a beam: every change of the contact state at its exact position.
!>
!> While one scheme acts and the train is in one interval (gapbeam_train), reactions and openings are polynomials in its place: a
!> few solves give them. They say where the scheme ceases to be right: the way on is tried with those supports changed that
!> have come to zero there; where that does not do, since several meet, or loads come onto the beam at once, the scheme a
!> little further on is found by the search, and taken if its polynomials say that it is right from here on; else nearer.
!> With laws that never fall there is but one state at every place, so a scheme whose signs are all right is the right one. Where
!> no scheme is found since the beam moves, the work of the loads along the motion is a polynomial as well.
!>
!> A change that is nearer to the last one than least_share of the interval is not told apart from it; where even that does not lead
!> on, the share grows, so that every interval comes to an end.
module gapbeam_train_path
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_train_changes, most_of_each
    use gapbeam_path_tolerances, only: first_train_share, most_train_share, sliver, least_train_share
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_indeterminate, &
        gapbeam_not_converged
    use gapbeam_bernstein, only: highest_degree
    use gapbeam_law_margins, only: may_change
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_static_indeterminacy, only: find_indeterminacy
    use gapbeam_extended_precision, only: decide_scheme, detail_type
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state, close_all
    use gapbeam_state, only: solve_along_axis
    use gapbeam_train, only: train_type, track_type, degree_of, least_distance
    use gapbeam_train_intervals, only: interval_type, find_intervals, enter_interval
    use gapbeam_train_loads, only: place_train
    use gapbeam_train_traversal, only: traversal_type, not_unique, keep_motion, lengthen
    use gapbeam_train_margins, only: margins_type, sample_margins, sample_work, find_interval, are_zero
    implicit none
    private
    public :: pass_train

contains

    !> Move a train over a beam
    subroutine pass_train(assembled, track, train, from, to, traversal, error)
        !> The beam, and the same ready for trains
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        !> The train, and its places
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: from, to
        type(traversal_type), intent(out) :: traversal
        !> No unique state, not settled, not finite, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work
        type(margins_type) :: margins
        type(state_type) :: along
        type(interval_type) :: interval
        logical, allocatable :: closed(:)
        logical :: changes, known
        integer :: m, r, stat

        m = size(track%beam%supports)
        call find_intervals(track, train, from, to, traversal%intervals, error)
        if (allocated(error)) return
        allocate (closed(m), margins%b(0:highest_degree, max(m, 1)), margins%slack(max(m, 1)), &
                  traversal%motion(0:size(track%beam%links), 0), stat=stat)
        if (stat == 0) call lengthen(traversal, m, size(traversal%intervals) + 64, stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call close_all(assembled, closed)
        call new_state(assembled, along, error)
        if (allocated(error)) return
        along%factor = 1.0_wp
        call solve_along_axis(assembled, along, error)
        if (allocated(error)) return
        if (along%slides) then
            traversal%number = 1
            traversal%from(1) = from
            traversal%to(1) = to
            traversal%status(1) = gapbeam_no_equilibrium
            traversal%interval(1) = 1
            traversal%motion_of(1) = 0
            traversal%closed(:, 1) = closed
            traversal%at_zero(:, 1) = .false.
            return
        end if
        call new_workspace(track%beam, work)
        known = .false.
        changes = any(may_change(track%beam%supports))
        do r = 1, size(traversal%intervals)
            if (known .and. .not. changes) then
                ! It holds everywhere, and need not be looked at
                interval = traversal%intervals(r)
            else
                call enter_interval(track, train, traversal%intervals(r), interval)
            end if
            call cross_interval(track, train, r, interval, closed, changes, known, margins, work, traversal, error)
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
        end do
    end subroutine pass_train

    !> Move a train through an interval
    subroutine cross_interval(track, train, r, interval, closed, changes, known, margins, work, traversal, error)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        !> Number of the interval, and the interval by enter_interval, but where a scheme is known that holds everywhere
        integer, intent(in) :: r
        type(interval_type), intent(in) :: interval
        !> Scheme so far, whether supports can change, and whether it may be tried as it is
        logical, intent(inout) :: closed(:)
        logical, intent(in) :: changes
        logical, intent(inout) :: known
        type(margins_type), intent(inout) :: margins
        type(workspace_type), intent(inout) :: work
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: at_end(:)
        real(wp) :: now, begin, end, skipped
        logical :: solved
        integer :: changed, searches

        allocate (at_end(size(closed)))
        now = interval%from
        changed = 0
        searches = 0
        skipped = least_train_share
        do
            if (known .and. .not. changes) then
                call accept(gapbeam_solved, 1.0_wp)
                return
            else if (known) then
                call sample_margins(track, train, interval, now, closed, margins, work, solved)
                traversal%solves = traversal%solves + degree_of(train) + 1
                if (solved) call find_interval(margins, degree_of(train), resolution(), begin, end, at_end)
                if (solved .and. end > 2*resolution()) then
                    call accept(gapbeam_solved, end)
                    if (allocated(error) .or. now >= interval%to) return
                    closed(:) = closed .neqv. at_end
                    changed = changed + 1
                    if (changed <= most_train_changes + most_of_each*size(closed)) cycle
                    call too_near(now)
                    return
                end if
                ! What was tried is not right
                closed(:) = traversal%closed(:, max(traversal%number, 1))
            end if
            skipped = max(skipped, resolution())
            call search_further(skipped)
            if (allocated(error) .or. now >= interval%to) return
            searches = searches + 1
            if (searches > most_train_changes + most_of_each*size(closed)) call too_near(now)
            if (allocated(error)) return
        end do

    contains

        !> The share of the rest of the interval that cannot be told from here: events are known to the last digits of positions
        !> only
        pure function resolution() result(share)
            real(wp) :: share

            share = 0.0_wp
            if (interval%to > now) share = min(0.25_wp, max(least_train_share, least_distance(track, train)/(interval%to - now)))
        end function resolution

        !> Give up
        subroutine too_near(position)
            real(wp), intent(in) :: position

            call fatal_error(error, gapbeam_not_converged, "so many supports open and close so near to each other that "// &
                             "rounding decides, about position "//trim(shown(position))//": give the beam some weight, "// &
                             "or move a support")
        end subroutine too_near

        !> Take a stretch from here to a share of the rest
        subroutine accept(status, share)
            integer, intent(in) :: status
            real(wp), intent(in) :: share
            real(wp) :: to
            integer :: k, stat, node

            to = interval%to
            if (share < 1.0_wp) to = min(now + share*(interval%to - now), interval%to)
            if (interval%to - to <= least_distance(track, train)) to = interval%to
            stat = 0
            if (traversal%number == size(traversal%from)) call lengthen(traversal, size(closed), 2*traversal%number, stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            traversal%number = traversal%number + 1
            k = traversal%number
            traversal%from(k) = now
            traversal%to(k) = to
            traversal%status(k) = status
            traversal%interval(k) = r
            traversal%closed(:, k) = closed
            ! All that is asked of supports that cannot change is zero
            traversal%at_zero(:, k) = status == gapbeam_solved .and. .not. changes
            traversal%motion_of(k) = 0
            if (status == gapbeam_solved .and. changes) then
                traversal%at_zero(:, k) = are_zero(margins, degree_of(train), size(closed))
                call find_indeterminacy(track%beam, closed, traversal%at_zero(:, k), node)
                if (node >= 0) traversal%status(k) = gapbeam_indeterminate
            end if
            now = to
            known = status == gapbeam_solved
        end subroutine accept

        !> Is the rest of an interval but a sliver beside positions at which the beam can move freely: what is loaded by next to
        !> nothing there rounding alone tells
        function nearly_all_free() result(so)
            logical :: so

            so = traversal%number > 0
            if (so) so = traversal%status(max(traversal%number, 1)) == not_unique
            so = so .and. now > interval%from .and. interval%to - now <= sliver*(interval%to - interval%from)
        end function nearly_all_free

        !> Find the scheme that acts from here on
        subroutine search_further(least)
            !> Shares that are left out; grows where nothing else leads on
            real(wp), intent(inout) :: least
            type(workspace_type) :: trial_work
            type(outcome_type) :: outcome
            type(detail_type) :: links_only
            logical, allocatable :: before(:)
            real(wp) :: share, place
            logical :: closely, right
            integer :: code

            allocate (before(size(closed)))
            before(:) = closed
            if (nearly_all_free()) then
                call accept(not_unique, 1.0_wp)
                return
            end if
            share = merge(first_train_share, 0.0_wp, interval%to > interval%from)
            closely = .false.
            do
                place = now + share*(interval%to - now)
                closed(:) = before
                call place_train(track, train, interval, place)
                if (closely) call new_workspace(track%beam, trial_work)
                if (.not. allocated(trial_work%nodes)) call new_workspace(track%beam, trial_work)
                call set_loads(track%beam, 1.0_wp, trial_work)
                if (closely) then
                    call decide_scheme(track%beam, links_only, 1.0_wp, rule_block, closed, trial_work, outcome, error)
                else
                    call find_contact_state(track%beam, 1.0_wp, rule_block, closed, trial_work, outcome, error)
                end if
                traversal%solves = traversal%solves + trial_work%solves
                right = .not. allocated(error)
                if (right .and. .not. closely) right = .not. outcome%in_doubt
                if (right .and. outcome%status == gapbeam_solved .and. .not. outcome%indifferent) then
                    call sample_margins(track, train, interval, now, closed, margins, work, right)
                    traversal%solves = traversal%solves + degree_of(train) + 1
                    if (right) call find_interval(margins, degree_of(train), share, begin, end, at_end)
                else if (right .and. outcome%status == gapbeam_no_equilibrium) then
                    call sample_work(track, train, interval, now, outcome%motion, margins)
                    call find_interval(margins, degree_of(train), share, begin, end, at_end)
                else if (right) then
                    begin = 0.0_wp
                    end = so_until(track, train, interval, now, share, before, not_unique)
                end if
                if (right) right = end > 0.0_wp .or. .not. interval%to > interval%from
                if (.not. right .and. .not. closely) then
                    closely = .true.
                    if (allocated(error)) deallocate (error)
                    cycle
                end if
                if (allocated(error)) then
                    code = error%code
                    if (all(code /= [gapbeam_indeterminate, gapbeam_not_converged])) return
                    deallocate (error)
                    closed(:) = before
                    if (interval%to > interval%from) share = so_until(track, train, interval, now, share, before, code)
                    call accept(code, max(share, 2*resolution()))
                    return
                end if
                if (.not. interval%to > interval%from) exit
                if (right .and. begin <= least) exit
                if (share <= least) then
                    if (least > max(most_train_share, 64*resolution())) then
                        call too_near(place)
                        return
                    end if
                    ! Rounding decides here: leave out what it hides
                    least = 4*least
                    end = max(end, 2*share)
                    exit
                end if
                share = max(min(share/2, begin/2), least)
            end do
            if (.not. interval%to > interval%from) end = 1.0_wp
            end = max(end, 2*resolution())
            if (outcome%status == gapbeam_no_equilibrium) then
                closed(:) = before
                call accept(gapbeam_no_equilibrium, end)
                if (.not. allocated(error)) call keep_motion(traversal, outcome%motion, error)
            else if (outcome%indifferent) then
                closed(:) = before
                call accept(not_unique, end)
            else
                call accept(gapbeam_solved, end)
                if (now < interval%to) closed(:) = closed .neqv. at_end
            end if
        end subroutine search_further

    end subroutine cross_interval

    !> How far a beam that can move freely without work of the loads, or has no unique answer, stays so: tried at a few places up to
    !> the end of the interval, else half as far, and so on
    function so_until(track, train, interval, now, least, start, status) result(share)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        type(interval_type), intent(in) :: interval
        real(wp), intent(in) :: now
        !> Known to be so up to this share of what is left
        real(wp), intent(in) :: least
        logical, intent(in) :: start(:)
        !> not_unique, or the code of the error
        integer, intent(in) :: status
        real(wp) :: share
        type(workspace_type) :: work
        type(detail_type) :: links_only
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(size(start)), stays
        integer :: k

        call new_workspace(track%beam, work)
        share = 1.0_wp
        do while (share > least)
            stays = .true.
            do k = 3, 1, -1
                closed(:) = start
                call place_train(track, train, interval, now + share*(k/3.0_wp - first_train_share)*(interval%to - now))
                call set_loads(track%beam, 1.0_wp, work)
                if (status == not_unique) then
                    call find_contact_state(track%beam, 1.0_wp, rule_block, closed, work, outcome, error)
                    stays = .not. allocated(error) .and. outcome%indifferent
                else
                    call decide_scheme(track%beam, links_only, 1.0_wp, rule_block, closed, work, outcome, error)
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

end module gapbeam_train_path
