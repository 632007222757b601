!> Largest and smallest fields at places of the beam over all positions of a train on the ground or on smooth laws.
!>
!> At a place values are smooth in the position but where an axle comes to it, and where something changes. Polynomials through
!> the states nearest to an extreme value tell it: where two of them agree to all digits as they are, else with a state more at
!> their top (gapbeam_train_line_tops).
module gapbeam_train_lines
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed
    use gapbeam_ordered, only: sort_once
    use gapbeam_quantities, only: of_shear
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_on_beam, only: distance_at_end
    use gapbeam_train_grid, only: places_of_jumps
    use gapbeam_train_states, only: kept_type
    use gapbeam_train_limits, only: limit_type, find_limits
    use gapbeam_train_line_states, only: lines_type, part_type, table_type, most_states, most_cuts, not_wanted, closest, &
        add_states, values_at, find_state, take, take_all
    use gapbeam_train_line_tops, only: climb_line
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: find_lines

    !> How often a place may ask for states between others; tuned
    integer, parameter :: most_rounds = 4

    !> Positions at which axles stand at a place, and the values there right and left of the axle, shape (quantities, 2, positions)
    type :: passes_type
        real(wp), allocatable :: at(:), sides(:, :, :)
    end type passes_type

contains

    !> Find them
    subroutine find_lines(assembled, runs, quantities, x, left, value, position, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        !> Their numbers (gapbeam_quantities)
        integer, intent(in) :: quantities(:)
        !> Places; where the value left of one is meant
        real(wp), intent(in) :: x(:)
        logical, intent(in) :: left(:)
        !> Largest (1) and smallest (2), and the positions of the train, shape (2, quantities, places); where no position is solved
        !> -huge and huge, and 0
        real(wp), intent(out) :: value(:, :, :), position(:, :, :)
        !> As for fields_at_places and solve_at
        type(error_type), allocatable, intent(out) :: error
        type(lines_type) :: lines
        type(table_type), allocatable :: tables(:)
        type(limit_type), allocatable :: limits(:)
        real(wp), allocatable :: greatest(:)
        integer :: i, k, n

        call new_lines(assembled, quantities, x, left, lines, error)
        if (.not. allocated(error)) call fill_tables(runs, lines, tables, error)
        if (.not. allocated(error)) call find_limits(assembled, runs, limits, error)
        if (allocated(error)) return
        call take_limits(assembled, runs, limits, lines)
        allocate (greatest(size(tables)))
        do i = 1, size(tables)
            do n = 1, size(tables(i)%at)
                do k = 1, size(x)
                    call take_all(lines, k, tables(i)%value(:, k, n), tables(i)%at(n))
                end do
            end do
            greatest(i) = maxval(abs(tables(i)%value))
        end do
        ! The more is known, the fewer places may have more
        do n = 1, size(tables)
            i = maxloc(greatest, 1)
            greatest(i) = -1.0_wp
            if (size(tables(i)%at) < 2) cycle
            lines%states = 0
            lines%latest = 0
            do k = 1, size(x)
                call climb_place(assembled, runs, i, tables(i), k, lines, error)
                if (.not. allocated(error)) call end_if_stopped(assembled%beam%watch, error)
                if (allocated(error)) return
            end do
        end do
        value(1, :, :) = lines%best(1, :, :)
        value(2, :, :) = -lines%best(2, :, :)
        position(:, :, :) = lines%at
    end subroutine find_lines

    !> Room for them
    subroutine new_lines(assembled, quantities, x, left, lines, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: quantities(:)
        real(wp), intent(in) :: x(:)
        logical, intent(in) :: left(:)
        type(lines_type), intent(out) :: lines
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: jumps(:)
        integer :: k, stat

        associate (q => size(quantities), n => size(x))
            allocate (lines%quantities(q), lines%x(n), lines%left(n), lines%on_jump(n), lines%best(2, q, n), lines%at(2, q, n), &
                      lines%scale_of(q), stat=stat)
        end associate
        if (failed(stat, error)) return
        lines%quantities(:) = quantities
        lines%shear = findloc(quantities, of_shear, 1)
        lines%x(:) = x
        lines%left(:) = left
        lines%best(:, :, :) = -huge(1.0_wp)
        lines%at(:, :, :) = 0.0_wp
        allocate (lines%boxes(most_states))
        allocate (jumps, source=places_of_jumps(assembled))
        lines%on_jump(:) = [(any(abs(jumps - x(k)) <= 0.0_wp), k=1, size(x))]
    end subroutine new_lines

    !> Values of all states at all places
    subroutine fill_tables(runs, lines, tables, error)
        type(runs_type), intent(inout) :: runs
        type(lines_type), intent(inout) :: lines
        type(table_type), allocatable, intent(out) :: tables(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i, k, stat

        allocate (tables(size(runs%runs)))
        lines%scale_of(:) = 0.0_wp
        do i = 1, size(tables)
            associate (states => runs%runs(i)%states, table => tables(i))
                allocate (table%value(size(lines%quantities), size(lines%x), size(states)), table%at(size(states)), &
                          table%cuts(size(states) - 1), stat=stat)
                if (failed(stat, error)) return
                table%cuts(:) = 0
                do k = 1, size(states)
                    table%at(k) = runs%boxes(states(k))%of%position
                    call values_at(runs%boxes(states(k))%of, lines%quantities, lines%x, lines%left, table%value(:, :, k), error)
                    if (allocated(error)) return
                end do
                lines%scale_of(:) = max(lines%scale_of, maxval(maxval(abs(table%value), 3), 2))
            end associate
        end do
    end subroutine fill_tables

    !> Consider shears between an axle and the support or force to which it comes
    pure subroutine take_limits(assembled, runs, limits, lines)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(in) :: runs
        type(limit_type), intent(in) :: limits(:)
        type(lines_type), intent(inout) :: lines
        integer :: i, k

        if (lines%shear == 0) return
        do i = 1, size(limits)
            do k = 1, size(lines%x)
                if (abs(lines%x(k) - limits(i)%x) > distance_at_end(assembled, runs%train)) cycle
                if (lines%left(k) .neqv. limits(i)%at_left) cycle
                call take(lines, 1, lines%shear, k, limits(i)%value, limits(i)%position)
                call take(lines, 2, lines%shear, k, -limits(i)%value, limits(i)%position)
            end do
        end do
    end subroutine take_limits

    !> Find what is greater at a place between the states of a run: from one passing axle to the next
    subroutine climb_place(assembled, runs, run, table, k, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(table_type), intent(inout) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(part_type) :: part
        type(passes_type) :: passes
        real(wp), allocatable :: wanted(:)
        integer :: i, m, q, round

        call pass_place(assembled, runs, run, table, k, lines, passes, error)
        if (allocated(error)) return
        do round = 0, most_rounds
            allocate (wanted(size(table%cuts)), source=not_wanted)
            do i = 0, size(passes%at)
                call cut_part(assembled, runs, run, table, k, lines, passes, i, part, error)
                if (allocated(error)) return
                if (.not. allocated(part%at)) cycle
                allocate (part%may_add(size(part%at) - 1), source=.false.)
                allocate (part%wanted(size(part%at) - 1), source=not_wanted)
                if (round < most_rounds) then
                    do m = 1, size(part%may_add)
                        part%may_add(m) = any(beside(table, part%at(m:m + 1)) .and. table%cuts < most_cuts)
                    end do
                end if
                do q = 1, size(lines%quantities)
                    call climb_line(assembled, runs, run, q, k, part, lines, error)
                    if (allocated(error)) return
                end do
                do m = 1, size(part%wanted)
                    if (.not. part%wanted(m) < not_wanted) cycle
                    where (beside(table, part%at(m:m + 1)) .and. table%cuts < most_cuts)
                        wanted = min(max(part%wanted(m), table%at(:size(wanted))), table%at(2:))
                    end where
                end do
            end do
            if (all(wanted >= not_wanted)) return
            call add_states(assembled, runs, run, wanted, table, lines, error)
            if (allocated(error)) return
            deallocate (wanted)
        end do
    end subroutine climb_place

    !> Ways between states of a table that share more than an end with another way
    pure function beside(table, way)
        type(table_type), intent(in) :: table
        real(wp), intent(in) :: way(2)
        logical :: beside(size(table%at) - 1)

        associate (n => size(table%at))
            beside(:) = table%at(:n - 1) < way(2) .and. table%at(2:) > way(1)
        end associate
    end function beside

    !> Consider the positions at which axles stand at a place
    subroutine pass_place(assembled, runs, run, table, k, lines, passes, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        !> Those inside the run
        type(passes_type), intent(out) :: passes
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: met(:), both(:, :)
        real(wp) :: beside
        integer :: at_end, i, n, number, q, state

        n = size(table%at)
        beside = 4*distance_at_end(assembled, runs%train)
        allocate (both(size(lines%quantities), 2), met(0))
        met = pack(lines%x(k) - runs%train%offset, runs%boxes(runs%runs(run)%states(1))%of%acts)
        met = pack(met, met >= table%at(1) - beside .and. met <= table%at(n) + beside)
        call sort_once(met)
        allocate (passes%at(size(met)), passes%sides(size(lines%quantities), 2, size(met)))
        number = 0
        do i = 1, size(met)
            at_end = 0
            if (met(i) >= table%at(n) - beside) at_end = n
            if (met(i) <= table%at(1) + beside) at_end = 1
            if (at_end > 0 .and. lines%on_jump(k)) cycle  ! take_limits has them
            if (at_end > 0) then
                associate (states => runs%runs(run)%states)
                    call values_on_both_sides(runs%boxes(states(merge(1, size(states), at_end == 1)))%of, lines%quantities, &
                                              lines%x(k), lines%left(k), both, error)
                end associate
            else
                call find_state(assembled, runs, run, lines, met(i), state, error)
                if (allocated(error)) return
                if (state == 0) cycle
                call values_on_both_sides(lines%boxes(state)%of, lines%quantities, lines%x(k), lines%left(k), both, error)
            end if
            if (allocated(error)) return
            if (at_end == 0) then
                number = number + 1
                passes%at(number) = met(i)
                passes%sides(:, :, number) = both
            end if
            do q = 1, 2
                call take_all(lines, k, both(:, q), merge(met(i), table%at(max(at_end, 1)), at_end == 0))
            end do
        end do
        passes%at = passes%at(:number)
    end subroutine pass_place

    !> Values of a state at a place right and left of an axle there; what jumps there without an axle has two places of its own
    subroutine values_on_both_sides(kept, quantities, x, left, both, error)
        type(kept_type), intent(inout) :: kept
        integer, intent(in) :: quantities(:)
        !> The place, and whether the value left of it is meant
        real(wp), intent(in) :: x
        logical, intent(in) :: left
        !> Shape (quantities, 2)
        real(wp), intent(out) :: both(:, :)
        type(error_type), allocatable, intent(out) :: error
        integer :: q

        call values_at(kept, quantities, [x, x], [.false., .true.], both, error)
        if (allocated(error)) return
        do q = 1, size(quantities)
            if (quantities(q) /= of_shear) both(q, :) = both(q, merge(2, 1, left))
        end do
    end subroutine values_on_both_sides

    !> Values at a place from one passing axle, or end of the run, to the next, one state at least between them
    subroutine cut_part(assembled, runs, run, table, k, lines, passes, i, part, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        !> From pass_place; from which of these on, 0: the first state
        type(passes_type), intent(in) :: passes
        integer, intent(in) :: i
        !> Its positions are not allocated if there is none
        type(part_type), intent(out) :: part
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: middle(:, :)
        real(wp) :: start, stop
        integer :: first, last, n, state

        n = size(table%at)
        start = table%at(1)
        if (i > 0) start = passes%at(i)
        stop = table%at(n)
        if (i < size(passes%at)) stop = passes%at(i + 1)
        first = count(table%at <= start) + 1
        last = n - count(table%at >= stop)
        ! States next to a passing axle would only add rounding
        if (i > 0 .and. first < last) then
            if (table%at(first) - start < closest*(table%at(first + 1) - table%at(first))) first = first + 1
        end if
        if (i < size(passes%at) .and. first < last) then
            if (stop - table%at(last) < closest*(table%at(last) - table%at(last - 1))) last = last - 1
        end if
        if (last < first) then
            allocate (middle(size(lines%quantities), 1))
            call find_state(assembled, runs, run, lines, start + (stop - start)/2, state, error)
            if (allocated(error) .or. state == 0) return
            associate (kept => lines%boxes(state)%of)
                if (.not. (start < kept%position .and. kept%position < stop)) return
                call values_at(kept, lines%quantities, lines%x(k:k), lines%left(k:k), middle, error)
                if (allocated(error)) return
                call take_all(lines, k, middle(:, 1), kept%position)
                part%at = [start, kept%position, stop]
            end associate
            allocate (part%value(size(lines%quantities), 3))
            part%value(:, 2) = middle(:, 1)
        else
            part%at = [start, table%at(first:last), stop]
            allocate (part%value(size(lines%quantities), last - first + 3))
            part%value(:, 2:last - first + 2) = table%value(:, k, first:last)
        end if
        call put_end(1, i, 1, 2)
        call put_end(size(part%at), i + 1, n, size(part%at) - 1)

    contains

        !> Values at an end: on which side of an axle the field goes on, the neighbour tells
        subroutine put_end(entry, pass, state, neighbour)
            integer, intent(in) :: entry, pass, state, neighbour
            real(wp) :: force
            integer :: q

            if (pass < 1 .or. pass > size(passes%at)) then
                part%value(:, entry) = table%value(:, k, state)
                force = force_at(runs, runs%boxes(runs%runs(run)%states(1))%of%acts, lines%x(k) - table%at(state), &
                                 4*distance_at_end(assembled, runs%train))
                if (lines%shear == 0 .or. .not. abs(force) > 0.0_wp) return
                associate (here => part%value(lines%shear, entry), inside => part%value(lines%shear, neighbour))
                    associate (there => here + sign(force, inside - here))
                        if (abs(there - inside) < abs(here - inside)) here = there
                    end associate
                end associate
                return
            end if
            do q = 1, size(lines%quantities)
                associate (both => passes%sides(q, :, pass), here => part%value(q, neighbour))
                    part%value(q, entry) = merge(both(1), both(2), abs(both(1) - here) <= abs(both(2) - here))
                end associate
            end do
        end subroutine put_end

    end subroutine cut_part

    !> Force of the axles as far behind the position of the train
    pure function force_at(runs, acts, offset, slack) result(force)
        type(runs_type), intent(in) :: runs
        !> Which axles act
        logical, intent(in) :: acts(:)
        !> The distance, and by how much another one is the same
        real(wp), intent(in) :: offset, slack
        real(wp) :: force

        force = sum(runs%train%force, acts .and. abs(runs%train%offset - offset) <= slack)
    end function force_at

end module gapbeam_train_lines
