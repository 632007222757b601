!> What a solved state says, in the user's units: values at the supports, fields anywhere, extremes, the free motion
module gapbeam_query
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_element, only: field_type
    use gapbeam_fields, only: values_at, find_extremes
    use gapbeam_model, only: both
    use gapbeam_scene, only: gapbeam_axial
    use gapbeam_lowered, only: lowered_type, position_tolerance
    use gapbeam_places, only: locate
    use gapbeam_check, only: shown
    use gapbeam_path, only: event_opens, event_closes, event_turns
    use gapbeam_memory, only: reserve_memory, for_fields
    use gapbeam_state, only: state_type, recover_state
    implicit none
    private
    public :: support_values, find_undecided, fields_at_places, extremes_of_fields, motion_of_nodes, node_places
    public :: gapbeam_open, gapbeam_closed, gapbeam_bilateral, gapbeam_turns, field_count

    !> States of a support
    integer, parameter :: gapbeam_open = event_opens, gapbeam_closed = event_closes, gapbeam_bilateral = 2
    !> An event: the beam has lost its hold and turns, at constant load, until the support holds it
    integer, parameter :: gapbeam_turns = event_turns
    !> Fields: deflection, rotation, moment, shear, axial force, axial displacement
    integer, parameter :: field_count = 6

contains

    !> Values at all supports, in the order of the model
    pure subroutine support_values(lowered, state, reaction, deflection, opening, couple, condition)
        !> The beam, and its solved state
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(in) :: state
        !> Force on the beam, up; of an axial support to the right, shape (nsupport)
        real(wp), intent(out) :: reaction(:)
        !> Deflection of the beam there, down; at an axial support to the right, shape (nsupport)
        real(wp), intent(out) :: deflection(:)
        !> Distance still to go until it acts, shape (nsupport)
        real(wp), intent(out) :: opening(:)
        !> Couple on the beam, clockwise, shape (nsupport)
        real(wp), intent(out) :: couple(:)
        !> gapbeam_open, gapbeam_closed or gapbeam_bilateral, shape (nsupport)
        integer, intent(out) :: condition(:)
        real(wp) :: at_node
        integer :: j, k

        associate (l => lowered%length_exponent, f => lowered%force_exponent, beam => lowered%beam)
            do k = 1, size(reaction)
                reaction(k) = 0.0_wp
                deflection(k) = 0.0_wp
                opening(k) = 0.0_wp
                couple(k) = 0.0_wp
                condition(k) = gapbeam_bilateral
                if (lowered%model%supports(k)%direction /= gapbeam_axial .or. .not. allocated(lowered%axial%node)) cycle
                reaction(k) = state%axial_reaction(lowered%axial%node(k))
                deflection(k) = state%displacement(lowered%axial%node(k))
            end do
            do j = 1, size(lowered%normal)
                k = lowered%normal(j)
                associate (s => beam%supports(j), node => beam%supports(j)%node)
                    reaction(k) = scale(state%reaction(j), f)
                    deflection(k) = scale(state%deflection(node), l)
                    if (s%side /= both) condition(k) = merge(gapbeam_closed, gapbeam_open, state%closed(j))
                    if (.not. state%closed(j)) opening(k) = scale(max(0.0_wp, s%side*(s%contact - state%deflection(node))), l)
                    if (.not. lowered%couple_share(j) > 0.0_wp) cycle
                    ! Across a node the moment grows by the applied couple and that of the supports
                    at_node = (state%moment_right(node) - state%moment_left(node)) &
                        - (beam%couple(1, node) + state%factor*beam%couple(2, node))
                    couple(k) = scale(at_node*lowered%couple_share(j), f + l)
                end associate
            end do
        end associate
    end subroutine support_values

    !> Supports whose reaction or opening is zero: open or closed is not decided
    pure subroutine find_undecided(lowered, state, undecided)
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(in) :: state
        !> In the order of the model, shape (nsupport)
        logical, intent(out) :: undecided(:)

        undecided(:) = .false.
        undecided(lowered%normal) = state%undecided
    end subroutine find_undecided

    !> Fields at the left ends of all pieces, if they are not there yet
    subroutine make_starts(lowered, state, error)
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error

        if (state%has_starts) return
        call reserve_memory(for_fields, size(lowered%beam%links), size(lowered%beam%supports), size(lowered%pieces), error)
        if (allocated(error)) return
        call recover_state(lowered, state, state%starts)
        state%has_starts = .true.
    end subroutine make_starts

    !> Fields at given places
    subroutine fields_at_places(lowered, state, x, from_left, fields, error)
        !> The beam, and its solved state
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(inout) :: state
        !> The places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Where a field jumps: its value left of the place; otherwise right of it
        logical, intent(in) :: from_left
        !> Shape (field_count, n)
        real(wp), intent(out) :: fields(:, :)
        !> A place outside the beam, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(field_type) :: field(1)
        real(wp) :: distance, end
        integer :: i, piece

        end = lowered%ends(ubound(lowered%ends, 1))
        do i = 1, size(x)
            if (x(i) >= -position_tolerance*end .and. x(i) <= end + position_tolerance*end) cycle
            call fatal_error(error, gapbeam_bad_input, "x: "//trim(shown(x(i)))//" is outside the beam, which runs from x = 0 "// &
                             "to x = "//trim(shown(end)))
            error%entry = i
            return
        end do
        call make_starts(lowered, state, error)
        if (allocated(error)) return
        associate (l => lowered%length_exponent, f => lowered%force_exponent)
            do i = 1, size(x)
                call find_piece(lowered, x(i), from_left, piece, distance)
                call values_at(lowered%pieces, lowered%dead, lowered%live, state%factor, state%starts, [piece], &
                               [scale(distance, -l)], field)
                fields(1:4, i) = [scale(field(1)%deflection, l), field(1)%rotation, scale(field(1)%moment, f + l), &
                                  scale(field(1)%shear, f)]
                call axial_fields(lowered, state, piece, distance, fields(5, i), fields(6, i))
            end do
        end associate
    end subroutine fields_at_places

    !> Piece of a place, and the distance from its left end
    pure subroutine find_piece(lowered, x, from_left, piece, distance)
        type(lowered_type), intent(in) :: lowered
        real(wp), intent(in) :: x
        logical, intent(in) :: from_left
        integer, intent(out) :: piece
        real(wp), intent(out) :: distance
        real(wp) :: offset, tolerance, to_right
        integer :: span, low, high, middle

        call locate(x, lowered%ends, span, offset)
        tolerance = position_tolerance*(lowered%ends(span) + offset)
        ! The last point of the span that is not right of the place
        low = lowered%end_point(span)
        high = low + 1
        if (span < ubound(lowered%ends, 1)) high = lowered%end_point(span + 1)
        do while (high - low > 1)
            middle = low + (high - low)/2
            if (lowered%point_offset(middle) <= offset) then
                low = middle
            else
                high = middle
            end if
        end do
        distance = offset - lowered%point_offset(low)
        high = min(low + 1, ubound(lowered%point_span, 1))
        to_right = lowered%point_offset(high) - offset
        if (lowered%point_span(high) == span .and. to_right <= tolerance .and. to_right < distance) then
            low = high
            distance = 0.0_wp
        end if
        if (distance <= tolerance) distance = 0.0_wp
        piece = low + 1
        if (distance > 0.0_wp .or. low == 0) return
        if (from_left .or. piece > size(lowered%pieces)) then
            piece = low
            distance = scale(lowered%pieces(piece)%length, lowered%length_exponent)
        end if
    end subroutine find_piece

    !> Normal force and displacement along the axis; zero without an axial system
    pure subroutine axial_fields(lowered, state, piece, distance, tension, displacement)
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(in) :: state
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp), intent(out) :: tension, displacement
        real(wp) :: way
        integer :: bar, j, low, high, middle

        tension = 0.0_wp
        displacement = 0.0_wp
        if (.not. allocated(lowered%axial%point)) return
        ! The bar that the piece belongs to: bar i lies between points i - 1 and i
        associate (point => lowered%axial%point)
            low = 0
            high = ubound(point, 1)
            do while (high - low > 1)
                middle = low + (high - low)/2
                if (point(middle) < piece) then
                    low = middle
                else
                    high = middle
                end if
            end do
            bar = high
            way = distance*lowered%axial_flexibility(piece)
            do j = point(bar - 1) + 1, piece - 1
                way = way + scale(lowered%pieces(j)%length, lowered%length_exponent)*lowered%axial_flexibility(j)
            end do
        end associate
        tension = state%tension(bar)
        displacement = state%displacement(bar - 1) + tension*way
    end subroutine axial_fields

    !> Largest and smallest values of all fields, and where they are
    subroutine extremes_of_fields(lowered, state, value, x, error)
        !> The beam, and its solved state
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(inout) :: state
        !> Maximum (1) and minimum (2) of every field, and their places, shape (2, field_count)
        real(wp), intent(out) :: value(:, :), x(:, :)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: distance(2, 4)
        integer :: piece(2, 4), exponents(4), i, k

        call make_starts(lowered, state, error)
        if (allocated(error)) return
        call find_extremes(lowered%pieces, lowered%dead, lowered%live, state%factor, state%starts, value(:, 1:4), piece, distance)
        associate (l => lowered%length_exponent, f => lowered%force_exponent)
            exponents = [l, 0, f + l, f]
            do k = 1, 4
                do i = 1, 2
                    value(i, k) = scale(value(i, k), exponents(k))
                    x(i, k) = point_x(piece(i, k) - 1) + scale(distance(i, k), l)
                end do
            end do
        end associate
        value(:, 5:6) = 0.0_wp
        x(:, 5:6) = 0.0_wp
        if (.not. allocated(lowered%axial%point)) return
        associate (point => lowered%axial%point)
            value(:, 5) = [maxval(state%tension), minval(state%tension)]
            x(:, 5) = [point_x(point(maxloc(state%tension, 1) - 1)), point_x(point(minloc(state%tension, 1) - 1))]
            value(:, 6) = [maxval(state%displacement), minval(state%displacement)]
            x(:, 6) = [point_x(point(maxloc(state%displacement, 1) - 1)), point_x(point(minloc(state%displacement, 1) - 1))]
        end associate

    contains

        !> x of a point
        pure function point_x(j) result(place)
            integer, intent(in) :: j
            real(wp) :: place

            place = lowered%ends(lowered%point_span(j)) + lowered%point_offset(j)
        end function point_x

    end subroutine extremes_of_fields

    !> x of all nodes
    pure subroutine node_places(lowered, x)
        type(lowered_type), intent(in) :: lowered
        !> Shape (0:n), n + 1 the number of nodes
        real(wp), intent(out) :: x(0:)
        integer :: i

        do i = 0, ubound(x, 1)
            associate (j => lowered%node_point(i))
                x(i) = lowered%ends(lowered%point_span(j)) + lowered%point_offset(j)
            end associate
        end do
    end subroutine node_places

    !> The free motion where there is no equilibrium
    pure subroutine motion_of_nodes(lowered, state, x, motion)
        type(lowered_type), intent(in) :: lowered
        type(state_type), intent(in) :: state
        !> Places of the nodes and their displacements down, largest 1, straight between, shape (0:n); all 0 where the beam
        !> slides along its axis
        real(wp), intent(out) :: x(0:), motion(0:)

        call node_places(lowered, x)
        motion(:) = state%motion
    end subroutine motion_of_nodes

end module gapbeam_query
