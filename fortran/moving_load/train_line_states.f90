!> Fields at places of the beam under a train on the ground or on smooth laws: the largest so far, and states that are asked for.
module gapbeam_train_line_states
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_query, only: fields_at_places
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_states, only: kept_type, box_type
    use gapbeam_train_limits, only: ruler_of, solve_in_run
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: lines_type, part_type, table_type, most_states, most_cuts, not_wanted, closest
    public :: add_states, values_at, find_state, take, take_all

    !> States beside those of a run that are kept; tuned
    integer, parameter :: most_states = 128
    !> Where no state is wanted between two others
    real(wp), parameter :: not_wanted = huge(1.0_wp)
    !> States nearer to another one than this share of the way to the next one tell nothing more
    real(wp), parameter :: closest = 2.0_wp**(-5)
    !> How often ways between states of a run are cut by more states; tuned
    integer, parameter :: most_cuts = 3

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

    !> Values at one place from one passing axle, or end of a run, to the next: shape (quantities, states). Between which
    !> of these more may be solved, and at which positions they are wanted, as for add_states, shape (states - 1)
    type :: part_type
        real(wp), allocatable :: at(:), value(:, :)
        logical, allocatable :: may_add(:)
        real(wp), allocatable :: wanted(:)
    end type part_type

    !> Values of the states of a run, shape (quantities, places, states), and their positions; how often the ways between these were
    !> cut, shape (states - 1)
    type :: table_type
        real(wp), allocatable :: value(:, :, :), at(:)
        integer, allocatable :: cuts(:)
    end type table_type

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
        integer, allocatable :: which(:)
        integer :: k, side

        do side = 1, 2
            which = pack([(k, k=1, size(x))], left .eqv. side == 2)
            if (size(which) == 0) cycle
            allocate (found(size(quantities), size(which)))
            call fields_at_places(kept%placed, kept%state, quantities, x(which), side == 2, found, error)
            if (allocated(error)) return
            value(:, which) = found
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

    !> Solve between states of a run; all places look at these
    subroutine add_states(assembled, runs, run, wanted, table, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        !> At which positions, shape (states - 1); not_wanted: nowhere there. Next to a state the middle is taken, in the angle
        real(wp), intent(in) :: wanted(:)
        type(table_type), intent(inout) :: table
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(table_type) :: longer
        type(ruler_type) :: ruler
        type(kept_type), allocatable :: kept
        real(wp) :: ends(2), position
        integer :: i, k, n, stat
        logical :: solved

        ruler = ruler_of(assembled, runs, runs%runs(run))
        n = size(table%at) + count(wanted < not_wanted)
        allocate (longer%value(size(lines%quantities), size(lines%x), n), longer%at(n), longer%cuts(n - 1), stat=stat)
        if (failed(stat, error)) return
        n = 0
        do i = 1, size(table%at)
            n = n + 1
            longer%at(n) = table%at(i)
            longer%value(:, :, n) = table%value(:, :, i)
            if (i == size(table%at)) exit
            longer%cuts(n) = table%cuts(i)
            if (.not. wanted(i) < not_wanted) cycle
            ends(:) = angle_of(ruler, table%at(i:i + 1))
            position = wanted(i)
            if (minval(abs(angle_of(ruler, position) - ends)) < closest*(ends(2) - ends(1))) then
                position = position_of(ruler, ends(1) + (ends(2) - ends(1))/2)
            end if
            longer%cuts(n) = most_cuts
            if (.not. (position > table%at(i) .and. position < table%at(i + 1))) cycle
            allocate (kept)
            call solve_in_run(assembled, runs, runs%runs(run), position, kept, solved, error)
            if (allocated(error)) return
            if (solved) then
                n = n + 1
                longer%at(n) = position
                call values_at(kept, lines%quantities, lines%x, lines%left, longer%value(:, :, n), error)
                if (allocated(error)) return
                longer%cuts(n - 1:n) = table%cuts(i) + 1
                do k = 1, size(lines%x)
                    call take_all(lines, k, longer%value(:, k, n), position)
                end do
            end if
            deallocate (kept)
        end do
        table%at = longer%at(:n)
        table%cuts = longer%cuts(:n - 1)
        if (n == size(longer%at)) then
            call move_alloc(longer%value, table%value)
        else
            table%value = longer%value(:, :, :n)
        end if
    end subroutine add_states

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
