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
    use gapbeam_path_tolerances, only: least_train_share
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_bernstein, only: highest_degree
    use gapbeam_law_margins, only: may_change
    use gapbeam_workspace, only: new_workspace
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state, close_all
    use gapbeam_along_axis, only: solve_along_axis
    use gapbeam_train, only: train_type, track_type
    use gapbeam_train_intervals, only: find_intervals, enter_interval
    use gapbeam_train_traversal, only: traversal_type, lengthen
    use gapbeam_train_passage, only: passage_type, resolution, find_share, take_stretch, too_near
    use gapbeam_train_search, only: search_further
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
        type(passage_type) :: passage
        type(state_type) :: along
        integer :: m, r, stat

        m = size(track%beam%supports)
        track%train = train
        call find_intervals(track, from, to, traversal%intervals, error)
        if (allocated(error)) return
        allocate (passage%closed(m), passage%at_end(m), passage%margins%b(0:highest_degree, max(m, 1)), &
                  passage%margins%slack(max(m, 1)), traversal%motion(0:size(track%beam%links), 0), stat=stat)
        if (stat == 0) call lengthen(traversal, m, size(traversal%intervals) + 64, stat)
        if (failed(stat, error)) return
        call close_all(assembled, passage%closed)
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
            traversal%closed(:, 1) = passage%closed
            traversal%at_zero(:, 1) = .false.
            return
        end if
        call new_workspace(track%beam, passage%work)
        passage%changes = any(may_change(track%beam%supports))
        do r = 1, size(traversal%intervals)
            passage%r = r
            if (passage%known .and. .not. passage%changes) then
                ! It holds everywhere, and need not be looked at
                passage%interval = traversal%intervals(r)
            else
                call enter_interval(track, traversal%intervals(r), passage%interval)
            end if
            call cross_interval(track, passage, traversal, error)
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
        end do
    end subroutine pass_train

    !> Move a train through an interval
    subroutine cross_interval(track, passage, traversal, error)
        type(track_type), intent(inout) :: track
        type(passage_type), intent(inout) :: passage
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: skipped
        logical :: solved
        integer :: changed, searches

        associate (now => passage%now, to => passage%interval%to, closed => passage%closed)
            now = passage%interval%from
            changed = 0
            searches = 0
            skipped = least_train_share
            do
                if (passage%known .and. .not. passage%changes) then
                    call take_stretch(track, gapbeam_solved, 1.0_wp, passage, traversal, error)
                    return
                else if (passage%known) then
                    call find_share(track, resolution(track, passage), passage, traversal, solved)
                    if (solved .and. passage%end > 2*resolution(track, passage)) then
                        call take_stretch(track, gapbeam_solved, passage%end, passage, traversal, error)
                        if (allocated(error) .or. now >= to) return
                        closed(:) = closed .neqv. passage%at_end
                        changed = changed + 1
                        if (changed <= most_train_changes + most_of_each*size(closed)) cycle
                        call too_near(now, error)
                        return
                    end if
                    ! What was tried is not right
                    closed(:) = traversal%closed(:, max(traversal%number, 1))
                end if
                skipped = max(skipped, resolution(track, passage))
                call search_further(track, skipped, passage, traversal, error)
                if (allocated(error) .or. now >= to) return
                searches = searches + 1
                if (searches > most_train_changes + most_of_each*size(closed)) call too_near(now, error)
                if (allocated(error)) return
            end do
        end associate
    end subroutine cross_interval

end module gapbeam_train_path
