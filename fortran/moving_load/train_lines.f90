!> Largest and smallest fields at places of the beam over all positions of a train on the ground or on smooth laws.
!>
!> At a place values are smooth in the position but where an axle comes to it, and where something changes. Polynomials through
!> the states nearest to an extreme value tell it: where two of them agree to all digits as they are, else with a state more at
!> their top.
module gapbeam_train_lines
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_quantities, only: of_shear
    use gapbeam_query, only: fields_at_places
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_on_beam, only: distance_at_end
    use gapbeam_train_grid, only: places_of_jumps
    use gapbeam_train_states, only: kept_type, box_type
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of, at_birth, nearer_birth, find_vertex, find_highest
    use gapbeam_train_peaks, only: nearest, on_each_side
    use gapbeam_train_limits, only: limit_type, find_limits, ruler_of, solve_in_run
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: find_lines

    !> Polynomials after which the best state is taken; one or two do
    integer, parameter :: most_steps = 5
    !> States through which a polynomial goes whose height is taken as it is, where one through two fewer states has the same but
    !> for this share of the largest value
    integer, parameter :: sure_points = 12
    real(wp), parameter :: sure = 2.0_wp**(-46)
    !> What values gain above the states by no more than this share of the largest is rounding
    real(wp), parameter :: rounding = 2.0_wp**(-48)

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
        !> States of the run at hand beside those of its table, the first entries: next to the birth of a zone all places are
        !> looked at in the same ones
        type(box_type), allocatable :: boxes(:)
        integer :: states = 0
    end type lines_type

    !> Values of the states of a run, shape (quantities, places, states), and their positions
    type :: table_type
        real(wp), allocatable :: value(:, :, :), at(:)
    end type table_type

    !> Values at one place from one passing axle, or end of a run, to the next: shape (quantities, states)
    type :: part_type
        real(wp), allocatable :: at(:), value(:, :)
    end type part_type

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
            call take_states(tables(i), lines)
            greatest(i) = maxval(abs(tables(i)%value))
        end do
        ! The more is known, the fewer places may have more
        do n = 1, size(tables)
            i = maxloc(greatest, 1)
            greatest(i) = -1.0_wp
            if (size(tables(i)%at) < 2) cycle
            lines%states = 0
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
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        lines%quantities(:) = quantities
        lines%shear = findloc(quantities, of_shear, 1)
        lines%x(:) = x
        lines%left(:) = left
        lines%best(:, :, :) = -huge(1.0_wp)
        lines%at(:, :, :) = 0.0_wp
        allocate (lines%boxes(16))
        allocate (jumps, source=places_of_jumps(assembled))
        do k = 1, size(x)
            lines%on_jump(k) = any(abs(jumps - x(k)) <= 0.0_wp)
        end do
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
                allocate (table%value(size(lines%quantities), size(lines%x), size(states)), table%at(size(states)), stat=stat)
                if (stat /= 0) then
                    call no_memory(error)
                    return
                end if
                do k = 1, size(states)
                    table%at(k) = runs%boxes(states(k))%of%position
                    call values_at(runs%boxes(states(k))%of, lines%quantities, lines%x, lines%left, table%value(:, :, k), error)
                    if (allocated(error)) return
                end do
                lines%scale_of(:) = max(lines%scale_of, maxval(maxval(abs(table%value), 3), 2))
            end associate
        end do
    end subroutine fill_tables

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
        type(box_type), allocatable :: more(:)
        type(kept_type), allocatable :: kept
        logical :: solved
        integer :: i

        do number = 1, lines%states
            if (.not. abs(lines%boxes(number)%of%position - position) > 0.0_wp) return
        end do
        allocate (kept)
        call solve_in_run(assembled, runs, runs%runs(run), position, kept, solved, error)
        number = 0
        if (allocated(error) .or. .not. solved) return
        if (lines%states == size(lines%boxes)) then
            allocate (more(2*lines%states))
            do i = 1, lines%states
                call move_alloc(lines%boxes(i)%of, more(i)%of)
            end do
            call move_alloc(more, lines%boxes)
        end if
        lines%states = lines%states + 1
        number = lines%states
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

    !> Consider all states of a run
    pure subroutine take_states(table, lines)
        type(table_type), intent(in) :: table
        type(lines_type), intent(inout) :: lines
        integer :: i, k

        do i = 1, size(table%at)
            do k = 1, size(lines%x)
                call take_all(lines, k, table%value(:, k, i), table%at(i))
            end do
        end do
    end subroutine take_states

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
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(ruler_type) :: ruler
        type(part_type) :: part
        real(wp), allocatable :: passed(:), sides(:, :, :)
        integer :: i, q
        logical :: known

        ruler = ruler_of(assembled, runs, runs%runs(run))
        call pass_place(assembled, runs, run, table, k, lines, passed, sides, error)
        if (allocated(error)) return
        do i = 0, size(passed)
            call cut_part(assembled, runs, run, table, k, lines, passed, sides, i, part, known, error)
            if (allocated(error)) return
            if (.not. known) cycle
            do q = 1, size(lines%quantities)
                call climb_line(assembled, runs, run, q, k, part, ruler, lines, error)
                if (allocated(error)) return
            end do
        end do
    end subroutine climb_place

    !> Consider the positions at which axles stand at a place
    subroutine pass_place(assembled, runs, run, table, k, lines, passed, sides, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        !> Those inside the run, and the values there with the axle left and right of the place, shape (quantities, 2, positions)
        real(wp), allocatable, intent(out) :: passed(:), sides(:, :, :)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: met(:), both(:, :)
        real(wp) :: beside
        integer :: at_end, i, n, number, q, state

        n = size(table%at)
        beside = 4*distance_at_end(assembled, runs%train)
        allocate (both(size(lines%quantities), 2), met(0))
        met = pack(lines%x(k) - runs%train%offset, runs%boxes(runs%runs(run)%states(1))%of%acts)
        met = pack(met, met >= table%at(1) - beside .and. met <= table%at(n) + beside)
        call sort_and_join(met)
        allocate (passed(size(met)), sides(size(lines%quantities), 2, size(met)))
        number = 0
        do i = 1, size(met)
            at_end = 0
            if (met(i) >= table%at(n) - beside) at_end = n
            if (met(i) <= table%at(1) + beside) at_end = 1
            if (at_end > 0 .and. lines%on_jump(k)) cycle  ! take_limits has them
            if (at_end > 0) then
                call values_on_both_sides(runs%boxes(runs%runs(run)%states(at_end))%of, lines%quantities, lines%x(k), &
                                          lines%left(k), both, error)
            else
                call find_state(assembled, runs, run, lines, met(i), state, error)
                if (allocated(error)) return
                if (state == 0) cycle
                call values_on_both_sides(lines%boxes(state)%of, lines%quantities, lines%x(k), lines%left(k), both, error)
            end if
            if (allocated(error)) return
            if (at_end == 0) then
                number = number + 1
                passed(number) = met(i)
                sides(:, :, number) = both
            end if
            do q = 1, 2
                call take_all(lines, k, both(:, q), merge(met(i), table%at(max(at_end, 1)), at_end == 0))
            end do
        end do
        passed = passed(:number)
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

    !> Sort, and leave out what is there twice
    pure subroutine sort_and_join(values)
        real(wp), allocatable, intent(inout) :: values(:)
        real(wp), allocatable :: sorted(:)
        integer :: i

        allocate (sorted(0))
        do i = 1, size(values)
            if (.not. any(values > last_of(sorted))) exit
            sorted = [sorted, minval(values, mask=values > last_of(sorted))]
        end do
        call move_alloc(sorted, values)

    contains

        !> The last one so far
        pure function last_of(some) result(value)
            real(wp), intent(in) :: some(:)
            real(wp) :: value

            value = -huge(value)
            if (size(some) > 0) value = some(size(some))
        end function last_of

    end subroutine sort_and_join

    !> Values at a place from one passing axle, or end of the run, to the next, one state at least between them
    subroutine cut_part(assembled, runs, run, table, k, lines, passed, sides, i, part, known, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(lines_type), intent(inout) :: lines
        !> From pass_place; from which of these on, 0: the first state
        real(wp), intent(in) :: passed(:), sides(:, :, :)
        integer, intent(in) :: i
        type(part_type), intent(out) :: part
        !> Is there any
        logical, intent(out) :: known
        type(error_type), allocatable, intent(out) :: error
        type(kept_type) :: kept
        real(wp), allocatable :: middle(:, :)
        real(wp) :: start, stop
        integer :: first, last, n

        n = size(table%at)
        start = table%at(1)
        if (i > 0) start = passed(i)
        stop = table%at(n)
        if (i < size(passed)) stop = passed(i + 1)
        first = count(table%at <= start) + 1
        last = n - count(table%at >= stop)
        known = .true.
        if (last < first) then
            allocate (middle(size(lines%quantities), 1))
            call solve_in_run(assembled, runs, runs%runs(run), start + (stop - start)/2, kept, known, error)
            if (allocated(error)) return
            known = known .and. start < kept%position .and. kept%position < stop
            if (.not. known) return
            call values_at(kept, lines%quantities, lines%x(k:k), lines%left(k:k), middle, error)
            if (allocated(error)) return
            call take_all(lines, k, middle(:, 1), kept%position)
            part%at = [start, kept%position, stop]
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

        !> Values at an end: on which side of a passing axle the field goes on, the neighbour tells
        subroutine put_end(entry, pass, state, neighbour)
            integer, intent(in) :: entry, pass, state, neighbour
            integer :: q

            if (pass < 1 .or. pass > size(passed)) then
                part%value(:, entry) = table%value(:, k, state)
                return
            end if
            do q = 1, size(lines%quantities)
                associate (both => sides(q, :, pass), here => part%value(q, neighbour))
                    part%value(q, entry) = merge(both(1), both(2), abs(both(1) - here) <= abs(both(2) - here))
                end associate
            end do
        end subroutine put_end

    end subroutine cut_part

    !> Find what is greater between positions where the values of a quantity at a place are known
    subroutine climb_line(assembled, runs, run, q, k, part, ruler, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run, q, k
        type(part_type), intent(in) :: part
        type(ruler_type), intent(in) :: ruler
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: at(:), gain(:), rise(:), widths(:)
        real(wp) :: sign
        integer :: i, j, n
        logical :: is_hill

        n = size(part%at)
        allocate (at(n), gain(n), rise(0:n), widths(n - 1))
        at(:) = angle_of(ruler, part%at)
        widths(:) = at(2:) - at(:n - 1)
        do i = 1, 2
            sign = merge(1.0_wp, -1.0_wp, i == 1)
            rise(0) = 0.0_wp
            rise(1:n - 1) = sign*(part%value(q, 2:) - part%value(q, :n - 1))
            rise(n) = 0.0_wp
            if (i == 1) then
                gain(2:n - 1) = abs(rise(2:n - 1)/widths(2:) - rise(1:n - 2)/widths(:n - 2))*max(widths(2:), widths(:n - 2))
                gain(1) = gain(2)
                gain(n) = gain(n - 1)
            end if
            do j = 1, n
                is_hill = rise(j - 1) >= 0.0_wp .and. rise(j) <= 0.0_wp .and. gain(j) > rounding*lines%scale_of(q)
                if (.not. is_hill) cycle
                ! Zones are born at the ends of a run only, not where an axle passes
                if (j == 1 .and. .not. at_birth(ruler, at(1))) is_hill = -rise(1) <= gain(1)
                if (j == n .and. .not. at_birth(ruler, at(n))) is_hill = rise(n - 1) <= gain(n)
                if (.not. is_hill .or. .not. sign*part%value(q, j) + gain(j) > lines%best(i, q, k)) cycle
                call climb_hill(assembled, runs, run, [i, q, k], at, sign*part%value(q, :), j, ruler, lines, error)
                if (allocated(error)) return
            end do
        end do
    end subroutine climb_line

    !> Go to the top near a state by polynomials through its neighbours
    subroutine climb_hill(assembled, runs, run, which, at, values, j, ruler, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        !> Largest (1) or smallest (2), the quantity, and the place
        integer, intent(in) :: which(3)
        !> Angles, values with the sign of the largest, and the state
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        type(ruler_type), intent(in) :: ruler
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: places(:), heights(:)
        real(wp) :: left, right, width, best, place, height, found(1, 1), here, bend
        integer :: first, n, state, step
        logical :: known, foretold, solved

        associate (i => which(1), q => which(2), k => which(3), size_of => lines%scale_of(which(2)))
            n = size(at)
            left = at(max(j - 1, 1))
            right = at(min(j + 1, n))
            best = at(j)
            call find_top(at, values, j, left, right, ruler, sure*size_of, place, height, known, solved)
            if (solved) then
                call take(lines, i, q, k, height, position_of(ruler, place))
                return
            end if
            if (known .and. n >= nearest) then
                ! Even with twice of what the polynomial gains here, the greatest is elsewhere
                if (2*height - values(j) < lines%best(i, q, k)) return
            end if
            first = min(max(j - on_each_side, 1), max(n - nearest + 1, 1))
            places = at(first:min(first + nearest - 1, n))
            heights = values(first:min(first + nearest - 1, n))
            width = right - left
            found(:, :) = 0.0_wp
            bend = max(values(j) - values(max(j - 1, 1)), values(j) - values(min(j + 1, n)))
            do step = 1, most_steps
                foretold = known
                if (.not. known .and. at_birth(ruler, best)) call nearer_birth(best, left, right, width, ruler, place, known)
                if (.not. known) return
                if (any(abs(places - place) <= 0.0_wp)) return
                call find_state(assembled, runs, run, lines, position_of(ruler, place), state, error)
                if (allocated(error) .or. state == 0) return
                call values_at(lines%boxes(state)%of, lines%quantities(q:q), lines%x(k:k), lines%left(k:k), found, error)
                if (allocated(error)) return
                here = merge(found(1, 1), -found(1, 1), i == 1)
                call take(lines, i, q, k, here, lines%boxes(state)%of%position)
                ! A height that is off by e is that of a place at which e**2/bend is missing
                if (foretold .and. (here - height)**2 <= sure*size_of*bend) return
                places = [places, place]
                heights = [heights, here]
                if (.not. (best > left .and. best < right) .and. here < heights(minloc(abs(places - best), 1))) then
                    left = min(best, place)
                    right = max(best, place)
                end if
                best = places(maxloc(heights, 1))
                call find_vertex(best, places, heights, left, right, place, height, known)
            end do
        end associate
    end subroutine climb_hill

    !> Top of the polynomials in the angle and in the position: that of which two agree, else the higher one
    subroutine find_top(at, values, j, left, right, ruler, enough, place, height, known, is_sure)
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        real(wp), intent(in) :: left, right
        type(ruler_type), intent(in) :: ruler
        !> By how much two may differ
        real(wp), intent(in) :: enough
        !> Angle and height
        real(wp), intent(out) :: place, height
        !> Is there a top, and is its height known to all digits
        logical, intent(out) :: known, is_sure
        real(wp), allocatable :: positions(:)
        real(wp) :: other, higher
        logical :: there
        integer :: from, to

        is_sure = .false.
        if (ruler%bears_zones) then
            positions = position_of(ruler, at)
            call agree(positions, position_of(ruler, left), position_of(ruler, right))
            if (is_sure) then
                place = angle_of(ruler, place)
                return
            end if
        end if
        call agree(at, left, right)
        if (is_sure) return
        from = min(max(j - on_each_side, 1), max(size(at) - nearest + 1, 1))
        to = min(from + nearest - 1, size(at))
        call find_highest(at(from:to), values(from:to), left, right, place, height, known)
        if (.not. known .or. .not. ruler%bears_zones) return
        call find_highest(positions(from:to), values(from:to), position_of(ruler, left), position_of(ruler, right), other, higher, &
                          there)
        if (.not. there .or. higher <= height) return
        place = angle_of(ruler, other)
        height = higher

    contains

        !> Do polynomials through more and through fewer states agree
        subroutine agree(places, low, high)
            real(wp), intent(in) :: places(:), low, high
            real(wp) :: fewer
            logical :: both
            integer :: first

            if (size(places) < sure_points) return
            first = min(max(j - sure_points/2, 1), size(places) - sure_points + 1)
            call find_highest(places(first:first + sure_points - 1), values(first:first + sure_points - 1), low, high, place, &
                              height, known)
            if (.not. known) return
            call find_highest(places(first + 1:first + sure_points - 2), values(first + 1:first + sure_points - 2), low, high, &
                              other, fewer, both)
            is_sure = both .and. abs(height - fewer) <= enough
        end subroutine agree

    end subroutine find_top

end module gapbeam_train_lines
