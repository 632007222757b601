!> Tops of fields at a place of the beam over the positions of a train on the ground or on smooth laws.
module gapbeam_train_line_tops
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of, at_birth, nearer_birth, find_vertex, find_highest
    use gapbeam_train_line_states, only: lines_type, part_type, values_at, find_state, take
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: climb_line

    !> States on each side of one through which a polynomial goes, and all of them
    integer, parameter :: on_each_side = 3, nearest = 2*on_each_side + 1
    !> Polynomials after which the best state is taken; one or two do
    integer, parameter :: most_steps = 5
    !> States through which a polynomial goes, at least and at most, whose height is taken as it is, where one through two fewer
    !> states has the same but for this share of the largest value
    integer, parameter :: least_points = 9, sure_points = 12
    real(wp), parameter :: sure = 2.0_wp**(-46)
    !> What values gain above the states by no more than this share of the largest is rounding
    real(wp), parameter :: rounding = 2.0_wp**(-48)
    !> States nearer to another one than this share of the way between two of the grid tell nothing more
    real(wp), parameter :: closest = 2.0_wp**(-5)

contains

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
        real(wp), allocatable :: places(:), heights(:), more_at(:), more_values(:)
        real(wp) :: left, right, width, best, place, height, found(1, 1), here
        integer :: first, n, state, step, top
        logical :: known, promising, solved

        associate (i => which(1), q => which(2), k => which(3), size_of => lines%scale_of(which(2)))
            n = size(at)
            left = at(max(j - 1, 1))
            right = at(min(j + 1, n))
            best = at(j)
            call find_top(at, values, j, [left, right], ruler, sure*size_of, place, height, known, solved)
            promising = known .and. .not. solved .and. lines%states > 0
            if (promising) promising = 2*height - values(j) >= lines%best(i, q, k)
            if (promising) then
                call add_known_states(lines, which, ruler, at, values, j, more_at, more_values, top, error)
                if (allocated(error)) return
                if (size(more_at) > n) then
                    left = more_at(max(top - 1, 1))
                    right = more_at(min(top + 1, size(more_at)))
                    call find_top(more_at, more_values, top, [left, right], ruler, sure*size_of, place, height, known, solved)
                    call take(lines, i, q, k, more_values(top), position_of(ruler, more_at(top)))
                    left = at(max(j - 1, 1))
                    right = at(min(j + 1, n))
                    if (.not. solved) call find_top(at, values, j, [left, right], ruler, sure*size_of, place, height, known, solved)
                end if
            end if
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
            do step = 1, most_steps
                if (.not. known .and. at_birth(ruler, best)) call nearer_birth(best, left, right, width, ruler, place, known)
                if (.not. known) return
                if (any(abs(places - place) <= 0.0_wp)) return
                call find_state(assembled, runs, run, lines, position_of(ruler, place), state, error)
                if (allocated(error) .or. state == 0) return
                call values_at(lines%boxes(state)%of, lines%quantities(q:q), lines%x(k:k), lines%left(k:k), found, error)
                if (allocated(error)) return
                here = merge(found(1, 1), -found(1, 1), i == 1)
                call take(lines, i, q, k, here, lines%boxes(state)%of%position)
                places = [places, place]
                heights = [heights, here]
                if (.not. (best > left .and. best < right) .and. here < heights(minloc(abs(places - best), 1))) then
                    left = min(best, place)
                    right = max(best, place)
                end if
                best = places(maxloc(heights, 1))
                call find_next(best, places, heights, [left, right], ruler, place, height, known)
                if (known .and. height - maxval(heights) <= sure*size_of) return
            end do
        end associate
    end subroutine climb_hill

    !> Add what is known of a place from states that others asked for, between the neighbours of a state
    subroutine add_known_states(lines, which, ruler, at, values, j, more_at, more_values, top, error)
        type(lines_type), intent(inout) :: lines
        !> As for climb_hill
        integer, intent(in) :: which(3)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        !> Angles and values with these, and which is the highest of them
        real(wp), allocatable, intent(out) :: more_at(:), more_values(:)
        integer, intent(out) :: top
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: angle, found(1, 1), left, right
        integer :: m, s

        left = at(max(j - 1, 1))
        right = at(min(j + 1, size(at)))
        more_at = at
        more_values = values
        found(:, :) = 0.0_wp
        associate (q => which(2), k => which(3))
            do s = 1, lines%states
                angle = angle_of(ruler, lines%boxes(s)%of%position)
                if (angle <= left .or. angle >= right) cycle
                if (any(abs(more_at - angle) <= closest*(right - left))) cycle
                call values_at(lines%boxes(s)%of, lines%quantities(q:q), lines%x(k:k), lines%left(k:k), found, error)
                if (allocated(error)) return
                m = count(more_at < angle)
                more_at = [more_at(:m), angle, more_at(m + 1:)]
                more_values = [more_values(:m), merge(found(1, 1), -found(1, 1), which(1) == 1), more_values(m + 1:)]
            end do
        end associate
        top = maxloc(merge(more_values, -huge(left), more_at >= left .and. more_at <= right), 1)
    end subroutine add_known_states

    !> Top of the polynomial through the points nearest to the highest one; of a parabola where that has none
    subroutine find_next(best, at, heights, bounds, ruler, place, height, known)
        !> Place of the highest point, all points, and bounds, as angles
        real(wp), intent(in) :: best, at(:), heights(:), bounds(2)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(out) :: place, height
        logical, intent(out) :: known
        real(wp) :: far(size(at)), near_at(min(size(at), nearest)), near_heights(min(size(at), nearest)), other, higher
        integer :: k, n
        logical :: there

        far(:) = abs(at - best)
        do n = 1, size(near_at)
            k = minloc(far, 1)
            near_at(n) = at(k)
            near_heights(n) = heights(k)
            far(k) = huge(far)
        end do
        call find_highest(near_at, near_heights, bounds(1), bounds(2), place, height, known)
        if (known .and. ruler%bears_zones) then
            call find_highest(position_of(ruler, near_at), near_heights, position_of(ruler, bounds(1)), &
                              position_of(ruler, bounds(2)), other, higher, there)
            if (there .and. higher > height) then
                place = angle_of(ruler, other)
                height = higher
            end if
        end if
        ! A top that is not above the highest point is another one
        known = known .and. height >= near_heights(1)
        if (.not. known) call find_vertex(best, at, heights, bounds(1), bounds(2), place, height, known)
    end subroutine find_next

    !> Top of the polynomials in the angle and in the position: that of which two agree, else the higher one
    subroutine find_top(at, values, j, bounds, ruler, enough, place, height, known, is_sure)
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        real(wp), intent(in) :: bounds(2)
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
            call agree(positions, position_of(ruler, bounds(1)), position_of(ruler, bounds(2)))
            if (is_sure) then
                place = angle_of(ruler, place)
                return
            end if
        end if
        call agree(at, bounds(1), bounds(2))
        if (is_sure) return
        from = min(max(j - on_each_side, 1), max(size(at) - nearest + 1, 1))
        to = min(from + nearest - 1, size(at))
        call find_highest(at(from:to), values(from:to), bounds(1), bounds(2), place, height, known)
        if (.not. known .or. .not. ruler%bears_zones) return
        call find_highest(positions(from:to), values(from:to), position_of(ruler, bounds(1)), position_of(ruler, bounds(2)), &
                          other, higher, there)
        if (.not. there .or. higher <= height) return
        place = angle_of(ruler, other)
        height = higher

    contains

        !> Do polynomials through more and through fewer states agree
        subroutine agree(places, low, high)
            real(wp), intent(in) :: places(:), low, high
            real(wp) :: fewer
            logical :: both
            integer :: first, n

            if (size(places) < least_points) return
            n = min(size(places), sure_points)
            first = min(max(j - n/2, 1), size(places) - n + 1)
            call find_highest(places(first:first + n - 1), values(first:first + n - 1), low, high, place, height, known)
            if (.not. known) return
            call find_highest(places(first + 1:first + n - 2), values(first + 1:first + n - 2), low, high, other, fewer, both)
            is_sure = both .and. abs(height - fewer) <= enough .and. height >= values(j)
        end subroutine agree

    end subroutine find_top

end module gapbeam_train_line_tops
