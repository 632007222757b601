!> Tops of fields at a place of the beam over the positions of a train on the ground or on smooth laws.
module gapbeam_train_line_tops
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of, at_birth, nearer_birth, find_vertex, find_highest, last_terms
    use gapbeam_train_limits, only: ruler_of
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
    !> Ways between states on each side of one at which more states are asked for
    integer, parameter :: around = 2

    !> Top of a polynomial: angle and height; is there one, and is that known to all digits
    type :: top_type
        real(wp) :: place = 0.0_wp, height = 0.0_wp
        logical :: known = .false., is_sure = .false.
    end type top_type

contains

    !> Find what is greater between positions where the values of a quantity at a place are known
    subroutine climb_line(assembled, runs, run, q, k, part, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run, q, k
        !> Asks for states between others, where it may, if these do not tell
        type(part_type), intent(inout) :: part
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(ruler_type) :: ruler
        real(wp), allocatable :: at(:), heights(:), gain(:), rise(:), widths(:)
        integer :: i, j, n
        logical :: is_hill

        n = size(part%at)
        ruler = ruler_of(assembled, runs, runs%runs(run))
        allocate (at(n), heights(n), gain(n), rise(0:n), widths(n - 1))
        at(:) = angle_of(ruler, part%at)
        widths(:) = at(2:) - at(:n - 1)
        do i = 1, 2
            heights(:) = merge(part%value(q, :), -part%value(q, :), i == 1)
            rise(0) = 0.0_wp
            rise(1:n - 1) = heights(2:) - heights(:n - 1)
            rise(n) = 0.0_wp
            if (i == 1) then
                gain(2:n - 1) = abs(rise(2:n - 1)/widths(2:) - rise(1:n - 2)/widths(:n - 2))*max(widths(2:), widths(:n - 2))
                gain(1) = gain(2)
                gain(n) = gain(n - 1)
            end if
            do j = 1, n
                is_hill = rise(j - 1) >= 0.0_wp .and. rise(j) <= 0.0_wp .and. gain(j) > rounding*lines%scale_of(q)
                if (.not. is_hill .or. is_plain(heights, j)) cycle
                ! Zones are born at the ends of a run only, not where an axle passes
                if (j == 1 .and. .not. at_birth(ruler, at(1))) is_hill = -rise(1) <= gain(1)
                if (j == n .and. .not. at_birth(ruler, at(n))) is_hill = rise(n - 1) <= gain(n)
                if (.not. is_hill .or. .not. heights(j) + gain(j) > lines%best(i, q, k)) cycle
                call look_at_hill(assembled, runs, run, [i, q, k], at, heights, j, part, lines, error)
                if (allocated(error)) return
            end do
        end do
    end subroutine climb_line

    !> Is what is zero in a state and in one beside it zero between them: without contact, or at a rigid support
    pure function is_plain(heights, j)
        !> Values, and number of the state
        real(wp), intent(in) :: heights(:)
        integer, intent(in) :: j
        logical :: is_plain

        is_plain = count(abs(heights(max(j - 1, 1):min(j + 1, size(heights)))) <= 0.0_wp) > 1 .and. abs(heights(j)) <= 0.0_wp
    end function is_plain

    !> Take the top near a state if polynomials are sure of it, else ask for states there or around it, or go there
    subroutine look_at_hill(assembled, runs, run, which, at, heights, j, part, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        !> Largest (1) or smallest (2), the quantity, and the place
        integer, intent(in) :: which(3)
        !> Angles, values with the sign of the largest, and the state
        real(wp), intent(in) :: at(:), heights(:)
        integer, intent(in) :: j
        type(part_type), intent(inout) :: part
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(ruler_type) :: ruler
        type(top_type) :: top
        integer :: first, last

        ruler = ruler_of(assembled, runs, runs%runs(run))
        associate (i => which(1), q => which(2), k => which(3), n => size(at))
            call find_top(at, heights, j, ruler, sure*lines%scale_of(q), top)
            if (top%is_sure) then
                if (top%known) call take(lines, i, q, k, top%height, position_of(ruler, top%place))
                return
            end if
            if (top%known .and. n >= nearest) then
                ! Even with twice of what the polynomial gains here, the greatest is elsewhere, or the state has it
                if (2*top%height - heights(j) < lines%best(i, q, k)) return
                if (top%height - heights(j) <= sure*lines%scale_of(q)) return
            end if
            first = max(j - around, 1)
            last = min(j + around - 1, n - 1)
            if (n < least_points) then
                first = 1
                last = n - 1
            else if (top%known) then
                ! With a state there the polynomials hardly differ
                first = min(max(count(at <= top%place), 1), n - 1)
                last = first
            end if
            if (any(part%may_add(first:last))) then
                part%wanted(first:last) = part%at(first:last)
                if (first == last) part%wanted(first) = position_of(ruler, top%place)
            else if (top%known .or. n < least_points) then
                ! At the birth of a zone from which values fall, as all polynomials do, nothing is higher
                call climb_hill(assembled, runs, run, which, at, heights, j, top, lines, error)
            end if
        end associate
    end subroutine look_at_hill

    !> Go to the top near a state by polynomials through its neighbours
    subroutine climb_hill(assembled, runs, run, which, at, values, j, top, lines, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        integer, intent(in) :: run
        !> As for look_at_hill
        integer, intent(in) :: which(3)
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        !> What is known of it
        type(top_type), intent(in) :: top
        type(lines_type), intent(inout) :: lines
        type(error_type), allocatable, intent(out) :: error
        type(ruler_type) :: ruler
        real(wp), allocatable :: places(:), heights(:)
        real(wp) :: left, right, width, best, place, height, found(1, 1), here
        integer :: first, n, state, step
        logical :: known

        ruler = ruler_of(assembled, runs, runs%runs(run))
        associate (i => which(1), q => which(2), k => which(3), size_of => lines%scale_of(which(2)))
            n = size(at)
            left = at(max(j - 1, 1))
            right = at(min(j + 1, n))
            best = at(j)
            known = top%known
            place = top%place
            first = min(max(j - on_each_side, 1), max(n - nearest + 1, 1))
            allocate (places, source=at(first:min(first + nearest - 1, n)))
            allocate (heights, source=values(first:min(first + nearest - 1, n)))
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

    !> Top of the polynomial through the points nearest to the highest one; of a parabola where that has none
    subroutine find_next(best, at, heights, bounds, ruler, place, height, known)
        !> Place of the highest point, all points, and bounds, as angles
        real(wp), intent(in) :: best, at(:), heights(:), bounds(2)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(out) :: place, height
        logical, intent(out) :: known
        real(wp) :: far(size(at)), near_at(min(size(at), nearest)), near_heights(min(size(at), nearest))
        integer :: k, n

        far(:) = abs(at - best)
        do n = 1, size(near_at)
            k = minloc(far, 1)
            near_at(n) = at(k)
            near_heights(n) = heights(k)
            far(k) = huge(far)
        end do
        call find_higher(near_at, near_heights, bounds, ruler, place, height, known)
        ! A top that is not above the highest point is another one
        known = known .and. height >= near_heights(1)
        if (.not. known) call find_vertex(best, at, heights, bounds(1), bounds(2), place, height, known)
    end subroutine find_next

    !> The higher one of the tops of the polynomials in the angle and in the position
    subroutine find_higher(at, heights, bounds, ruler, place, height, known)
        !> Points, and bounds, as angles
        real(wp), intent(in) :: at(:), heights(:), bounds(2)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(out) :: place, height
        logical, intent(out) :: known
        real(wp) :: other, higher
        logical :: there

        call find_highest(at, heights, bounds(1), bounds(2), place, height, known)
        if (.not. (known .and. ruler%bears_zones)) return
        call find_highest(position_of(ruler, at), heights, position_of(ruler, bounds(1)), position_of(ruler, bounds(2)), &
                          other, higher, there)
        if (.not. there .or. higher <= height) return
        place = angle_of(ruler, other)
        height = higher
    end subroutine find_higher

    !> Top of the polynomials in the angle and in the position: that of which two agree, else the higher one
    subroutine find_top(at, values, j, ruler, enough, top)
        !> As for look_at_hill
        real(wp), intent(in) :: at(:), values(:)
        integer, intent(in) :: j
        type(ruler_type), intent(in) :: ruler
        !> By how much two may differ
        real(wp), intent(in) :: enough
        type(top_type), intent(out) :: top
        real(wp) :: bounds(2)
        integer :: from, to

        bounds(:) = [at(max(j - 1, 1)), at(min(j + 1, size(at)))]
        if (ruler%bears_zones) then
            call agree(position_of(ruler, at), position_of(ruler, bounds))
            if (top%is_sure) then
                if (top%known) top%place = angle_of(ruler, top%place)
                return
            end if
        end if
        call agree(at, bounds)
        if (top%is_sure) return
        from = min(max(j - on_each_side, 1), max(size(at) - nearest + 1, 1))
        to = min(from + nearest - 1, size(at))
        call find_higher(at(from:to), values(from:to), bounds, ruler, top%place, top%height, top%known)
        ! A top that is not above the state is another one
        top%known = top%known .and. top%height >= values(j)

    contains

        !> Do polynomials through more and through fewer states agree: in the top, or at an end that there is none
        subroutine agree(places, between)
            real(wp), intent(in) :: places(:), between(2)
            real(wp) :: fewer, other
            logical :: both
            integer :: first, last, n

            if (size(places) < least_points) return
            n = min(size(places), sure_points)
            first = min(max(j - n/2, 1), size(places) - n + 1)
            last = first + n - 1
            call find_highest(places(first:last), values(first:last), between(1), between(2), top%place, top%height, top%known)
            call find_highest(places(first + 1:last - 1), values(first + 1:last - 1), between(1), between(2), other, fewer, both)
            if (top%known .and. both) then
                top%is_sure = abs(top%height - fewer) <= enough .and. top%height >= values(j)
            else if (.not. (top%known .or. both) .and. any(j == [1, size(places)])) then
                top%is_sure = last_terms(places(first:last), values(first:last), between(1), between(2)) <= enough
            end if
        end subroutine agree

    end subroutine find_top

end module gapbeam_train_line_tops
