!> Fields at places of the beam under a train on the ground or on smooth laws: the largest so far, and states that are asked for.
module gapbeam_train_line_states
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_query, only: fields_at_places
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_states, only: kept_type, box_type
    use gapbeam_train_limits, only: solve_in_run
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: lines_type, part_type, most_states, values_at, find_state, take, take_all

    !> States beside those of a run that are kept; tuned
    integer, parameter :: most_states = 128

    !> Places, and what is known of them
    type :: lines_type
        !> Numbers of the quantities, and which of them is the shear, 0: none
        integer, allocatable :: quantities(:)
        integer :: shear = 0
        !> Places; where the value left of one is meant; where a support or a force is
        real(wp), allocatable :: x(:)
        logical, allocatable :: left(:), on_jump(:)
        !> Largest, and smallest with the other sign, and the positions, shape (2, quantities, places)
        real(wp), allocatable :: best(:, :, :), at(:, :, :)
        !> Largest of every quantity
        real(wp), allocatable :: scale_of(:)
        !> States of the run at hand beside those of its table, the first entries, and the one found last: next to the birth of a
        !> zone all places are looked at in the same ones, and what one place asked for helps the others
        type(box_type), allocatable :: boxes(:)
        integer :: states = 0, latest = 0
    end type lines_type

    !> Values at one place from one passing axle, or end of a run, to the next: shape (quantities, states)
    type :: part_type
        real(wp), allocatable :: at(:), value(:, :)
    end type part_type

contains

    !> Values of a state at places, each on its side
    subroutine values_at(kept, quantities, x, left, value, error)
        type(kept_type), intent(inout) :: kept
        !> Their numbers; the places
        integer, intent(in) :: quantities(:)
        real(wp), intent(in) :: x(:)
        logical, intent(in) :: left(:)
        !> Shape (quantities, places)
        real(wp), intent(inout) :: value(:, :)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: found(:, :)
        integer :: k, n, side
        logical :: at_left

        do side = 1, 2
            at_left = side == 2
            if (.not. any(left .eqv. at_left)) cycle
            allocate (found(size(quantities), count(left .eqv. at_left)))
            call fields_at_places(kept%placed, kept%state, quantities, pack(x, left .eqv. at_left), at_left, found, error)
            if (allocated(error)) return
            n = 0
            do k = 1, size(x)
                if (left(k) .neqv. at_left) cycle
                n = n + 1
                value(:, k) = found(:, n)
            end do
            deallocate (found)
        end do
    end subroutine values_at

    !> Solve at a position of the run at hand, unless that has been done
    subroutine find_state(assembled, runs, run, lines, position, number, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(lines_type), intent(inout) :: lines
        real(wp), intent(in) :: position
        !> Of the state, 0: it is not solved
        integer, intent(out) :: number
        type(error_type), allocatable, intent(out) :: error
        type(kept_type), allocatable :: kept
        logical :: solved

        do number = 1, lines%states
            if (.not. abs(lines%boxes(number)%of%position - position) > 0.0_wp) return
        end do
        allocate (kept)
        call solve_in_run(assembled, runs, runs%runs(run), position, kept, solved, error)
        number = 0
        if (allocated(error) .or. .not. solved) return
        ! The oldest makes room
        lines%latest = mod(lines%latest, size(lines%boxes)) + 1
        lines%states = max(lines%states, lines%latest)
        number = lines%latest
        call move_alloc(kept, lines%boxes(number)%of)
    end subroutine find_state

    !> Consider one value
    pure subroutine take(lines, i, q, k, value, position)
        type(lines_type), intent(inout) :: lines
        !> Largest (1) or smallest (2), number of the quantity, and of the place
        integer, intent(in) :: i, q, k
        !> With the sign of the largest
        real(wp), intent(in) :: value, position

        if (.not. value > lines%best(i, q, k)) return
        lines%best(i, q, k) = value
        lines%at(i, q, k) = position
    end subroutine take

    !> Consider the values of a state at a place
    pure subroutine take_all(lines, k, value, position)
        type(lines_type), intent(inout) :: lines
        integer, intent(in) :: k
        real(wp), intent(in) :: value(:), position
        integer :: q

        do q = 1, size(value)
            call take(lines, 1, q, k, value(q), position)
            call take(lines, 2, q, k, -value(q), position)
        end do
    end subroutine take_all

end module gapbeam_train_line_states
