!> The states of a train on its way, and the crossings between them at which something changes.
module gapbeam_train_way
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_path_problem, only: path_problem_type
    use gapbeam_train_states, only: box_type, take_undecided
    implicit none
    private
    public :: train_way_type, crossing_type, append, append_crossing, decide

    !> Where something changes between two states
    type :: crossing_type
        !> Numbers of the states next to it
        integer :: below = 0, above = 0
        real(wp) :: at = 0.0_wp
        !> Places of what changes, if any are known
        real(wp), allocatable :: place(:)
    end type crossing_type

    !> What a walk has come by
    type, extends(path_problem_type), abstract :: train_way_type
        !> All states, the first entries
        type(box_type), allocatable :: boxes(:)
        integer :: states = 0
        !> Numbers of the states of a walk in ascending order, or of a crossing below zero, the first entries
        integer, allocatable :: way(:)
        integer :: length = 0
        type(crossing_type), allocatable :: crossings(:)
    end type train_way_type

contains

    !> What is not decided just above a crossing is as at the next state, and else as at the latest one
    subroutine decide(problem, number)
        class(train_way_type), intent(inout) :: problem
        integer, intent(in) :: number
        integer :: latest

        if (problem%length == 0) return
        latest = problem%way(problem%length)
        if (latest < 0) then
            latest = problem%crossings(-latest)%above
            if (latest /= number) call take_undecided(problem%boxes(latest)%of, problem%boxes(number)%of)
        end if
        if (latest /= number) call take_undecided(problem%boxes(number)%of, problem%boxes(latest)%of)
    end subroutine decide

    !> One entry more
    subroutine append(problem, entry, error)
        class(train_way_type), intent(inout) :: problem
        integer, intent(in) :: entry
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: longer(:)
        integer :: stat

        if (problem%length == size(problem%way)) then
            allocate (longer(2*problem%length), stat=stat)
            if (failed(stat, error)) return
            longer(:problem%length) = problem%way
            call move_alloc(longer, problem%way)
        end if
        problem%length = problem%length + 1
        problem%way(problem%length) = entry
    end subroutine append

    !> One crossing more
    subroutine append_crossing(problem, crossing, error)
        class(train_way_type), intent(inout) :: problem
        type(crossing_type), intent(in) :: crossing
        type(error_type), allocatable, intent(out) :: error

        problem%crossings = [problem%crossings, crossing]
        call append(problem, -size(problem%crossings), error)
    end subroutine append_crossing

end module gapbeam_train_way
