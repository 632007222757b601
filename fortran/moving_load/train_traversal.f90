!> The way of a train over a beam as stretches of positions with one contact state.
module gapbeam_train_traversal
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: same_tie
    use gapbeam_error, only: error_type, failed
    use gapbeam_train_intervals, only: interval_type
    implicit none
    private
    public :: traversal_type, not_unique, keep_motion, lengthen

    !> Beside gapbeam_solved, gapbeam_no_equilibrium and gapbeam_buckles: the beam can move freely without work of the loads
    integer, parameter :: not_unique = 3
    !> The way of a train over a beam: stretches of places, on each of which one scheme acts, in ascending order
    type :: traversal_type
        !> How many there are
        integer :: number = 0
        !> First and last place, and gapbeam_solved, gapbeam_no_equilibrium, not_unique, or where there is no unique answer the code
        !> of the error, gapbeam_indeterminate or gapbeam_not_converged
        real(wp), allocatable :: from(:), to(:)
        integer, allocatable :: status(:)
        !> Number of the interval
        integer, allocatable :: interval(:)
        !> Scheme, and supports at zero all the way, shape (size(supports), number at least)
        logical, allocatable :: closed(:, :), at_zero(:, :)
        !> Where there is no equilibrium the free motion, shape (0:n, number of such), and the number of that of each stretch; 0
        !> where the beam slides along its axis
        real(wp), allocatable :: motion(:, :)
        integer, allocatable :: motion_of(:)
        !> The intervals
        type(interval_type), allocatable :: intervals(:)
        !> Linear solves
        integer :: solves = 0
    end type traversal_type

contains

    !> Keep the motion of the last stretch, joined to that before where it is the same
    subroutine keep_motion(traversal, motion, error)
        type(traversal_type), intent(inout) :: traversal
        real(wp), intent(in) :: motion(0:)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: longer(:, :)
        integer :: count, stat

        count = size(traversal%motion, 2)
        if (count > 0) then
            if (maxval(abs(traversal%motion(:, count) - motion)) <= same_tie) then
                traversal%motion_of(traversal%number) = count
                return
            end if
        end if
        allocate (longer(0:ubound(motion, 1), count + 1), stat=stat)
        if (failed(stat, error)) return
        longer(:, :count) = traversal%motion
        longer(:, count + 1) = motion
        call move_alloc(longer, traversal%motion)
        traversal%motion_of(traversal%number) = count + 1
    end subroutine keep_motion

    !> Make room for more stretches
    subroutine lengthen(traversal, m, count, stat)
        type(traversal_type), intent(inout) :: traversal
        !> Supports, and stretches
        integer, intent(in) :: m, count
        integer, intent(out) :: stat
        type(traversal_type) :: longer
        integer :: n

        n = traversal%number
        allocate (longer%from(count), longer%to(count), longer%status(count), longer%interval(count), longer%motion_of(count), &
                  longer%closed(m, count), longer%at_zero(m, count), stat=stat)
        if (stat /= 0) return
        if (n > 0) then
            longer%from(:n) = traversal%from(:n)
            longer%to(:n) = traversal%to(:n)
            longer%status(:n) = traversal%status(:n)
            longer%interval(:n) = traversal%interval(:n)
            longer%motion_of(:n) = traversal%motion_of(:n)
            longer%closed(:, :n) = traversal%closed(:, :n)
            longer%at_zero(:, :n) = traversal%at_zero(:, :n)
        end if
        call move_alloc(longer%from, traversal%from)
        call move_alloc(longer%to, traversal%to)
        call move_alloc(longer%status, traversal%status)
        call move_alloc(longer%interval, traversal%interval)
        call move_alloc(longer%motion_of, traversal%motion_of)
        call move_alloc(longer%closed, traversal%closed)
        call move_alloc(longer%at_zero, traversal%at_zero)
    end subroutine lengthen

end module gapbeam_train_traversal
