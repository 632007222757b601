!> A train on its way through an interval: the scheme that acts, how far it is known to be right, and stretches that are taken.
module gapbeam_train_passage
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: least_train_share
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_solved, gapbeam_indeterminate, gapbeam_not_converged
    use gapbeam_workspace, only: workspace_type
    use gapbeam_static_indeterminacy, only: find_indeterminacy
    use gapbeam_words, only: shown
    use gapbeam_train, only: track_type, degree_of, least_distance
    use gapbeam_train_intervals, only: interval_type
    use gapbeam_train_traversal, only: traversal_type, lengthen
    use gapbeam_train_margins, only: margins_type, sample_margins, find_interval, are_zero
    implicit none
    private
    public :: passage_type, resolution, find_share, take_stretch, too_near

    !> A train on its way through an interval
    type :: passage_type
        !> Number of the interval, and the interval by enter_interval, but where a scheme is known that holds everywhere
        integer :: r = 0
        type(interval_type) :: interval
        !> The place come to
        real(wp) :: now = 0.0_wp
        !> Scheme so far, or the one tried; whether supports can change, and whether the scheme may be tried as it is
        logical, allocatable :: closed(:)
        logical :: changes = .false., known = .false.
        !> Shares of the rest of the interval between which it is right, and what is at zero at the end
        real(wp) :: begin = 0.0_wp, end = 0.0_wp
        logical, allocatable :: at_end(:)
        type(margins_type) :: margins
        type(workspace_type) :: work
    end type passage_type

contains

    !> The share of the rest of the interval that cannot be told from here: events are known to the last digits of positions only
    pure function resolution(track, passage) result(share)
        type(track_type), intent(in) :: track
        type(passage_type), intent(in) :: passage
        real(wp) :: share

        share = 0.0_wp
        associate (now => passage%now, to => passage%interval%to)
            if (to > now) share = min(0.25_wp, max(least_train_share, least_distance(track)/(to - now)))
        end associate
    end function resolution

    !> Find from which share of the rest of the interval to which the scheme at hand is right
    subroutine find_share(track, around, passage, traversal, solved)
        type(track_type), intent(inout) :: track
        !> As for find_interval
        real(wp), intent(in) :: around
        type(passage_type), intent(inout) :: passage
        !> Counts solves
        type(traversal_type), intent(inout) :: traversal
        !> Has the scheme a solution
        logical, intent(out) :: solved

        call sample_margins(track, passage%interval, passage%now, passage%closed, passage%margins, passage%work, solved)
        traversal%solves = traversal%solves + degree_of(track%train) + 1
        if (solved) call find_interval(passage%margins, degree_of(track%train), around, passage%begin, passage%end, passage%at_end)
    end subroutine find_share

    !> Take a stretch from here to a share of the rest
    subroutine take_stretch(track, status, share, passage, traversal, error)
        type(track_type), intent(in) :: track
        integer, intent(in) :: status
        real(wp), intent(in) :: share
        type(passage_type), intent(inout) :: passage
        type(traversal_type), intent(inout) :: traversal
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: to
        integer :: k, stat, node

        associate (now => passage%now, interval => passage%interval, closed => passage%closed)
            to = interval%to
            if (share < 1.0_wp) to = min(now + share*(interval%to - now), interval%to)
            if (interval%to - to <= least_distance(track)) to = interval%to
            stat = 0
            if (traversal%number == size(traversal%from)) call lengthen(traversal, size(closed), 2*traversal%number, stat)
            if (failed(stat, error)) return
            traversal%number = traversal%number + 1
            k = traversal%number
            traversal%from(k) = now
            traversal%to(k) = to
            traversal%status(k) = status
            traversal%interval(k) = passage%r
            traversal%closed(:, k) = closed
            ! All that is asked of supports that cannot change is zero
            traversal%at_zero(:, k) = status == gapbeam_solved .and. .not. passage%changes
            traversal%motion_of(k) = 0
            if (status == gapbeam_solved .and. passage%changes) then
                traversal%at_zero(:, k) = are_zero(passage%margins, degree_of(track%train), size(closed))
                call find_indeterminacy(track%beam, closed, traversal%at_zero(:, k), node)
                if (node >= 0) traversal%status(k) = gapbeam_indeterminate
            end if
            now = to
        end associate
        passage%known = status == gapbeam_solved
    end subroutine take_stretch

    !> Give up
    subroutine too_near(position, error)
        real(wp), intent(in) :: position
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_not_converged, "so many supports open and close so near to each other that "// &
                         "rounding decides, about position "//trim(shown(position))//": give the beam some weight, "// &
                         "or move a support")
    end subroutine too_near

end module gapbeam_train_passage
