!> Fields of a solved state in the user's units: at places, extremes, the free motion.
module gapbeam_query
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: position_tolerance, end_tolerance
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input
    use gapbeam_element, only: field_type
    use gapbeam_fields, only: bending_values, values_at, find_extremes
    use gapbeam_piece, only: piece_load_type, combine_loads, curvature_at
    use gapbeam_quantities, only: quantity_count, bending_count, bending, of_shear, of_axial_force, of_axial_displacement, &
        of_pressure, of_transverse, needs_axial, quantity_names, quantity_remedies
    use gapbeam_units, only: quantity_unit
    use gapbeam_assembled_model, only: assembled_type, point_x, place_x, piece_length
    use gapbeam_stretched_displacement, only: displacement_in, extremes_of_displacement
    use gapbeam_axial_fields, only: axial_fields, extremes_along
    use gapbeam_ground_along, only: ground_along_type
    use gapbeam_ordered, only: last_not_above
    use gapbeam_stations, only: locate
    use gapbeam_assemble_units, only: name_farthest
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: refuse_range
    use gapbeam_memory, only: reserve_memory, for_fields
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_query, only: ground_values, ground_extremes
    use gapbeam_pressure, only: pressure_in_pieces, extremes_of_pressure
    use gapbeam_transverse, only: transverse_forces, transverse_extremes
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: recover_state
    implicit none
    private
    public :: make_starts, find_starts, find_pieces, fields_in_pieces, extremes_of_pieces
    public :: fields_at_places, extremes_of_fields, motion_of_nodes, node_places

contains

    !> Fields at the left ends of all pieces, if they are not there yet
    subroutine make_starts(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(field_type), allocatable :: starts(:)

        if (state%has_starts) return
        call move_alloc(state%starts, starts)
        call find_starts(assembled, state, starts, error)
        call move_alloc(starts, state%starts)
        state%has_starts = .not. allocated(error)
    end subroutine make_starts

    !> Fields at the left end of every piece of a beam that is not on the ground
    subroutine find_starts(assembled, state, starts, error)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> In the engine's units, shape (npiece)
        type(field_type), intent(out) :: starts(:)
        !> A field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        call reserve_memory(for_fields, size(assembled%beam%links), size(assembled%beam%supports), size(assembled%pieces), error)
        if (allocated(error)) return
        call recover_state(assembled, state, starts)
        do i = 1, size(starts)
            associate (a => starts(i))
                if (all(abs([a%deflection, a%rotation, a%moment, a%shear]) <= huge(1.0_wp))) cycle
            end associate
            call name_farthest(assembled, error)
            return
        end do
    end subroutine find_starts

    !> Fields of a state at given places
    subroutine fields_at_places(assembled, state, quantities, x, from_left, fields, error)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        !> Numbers of the quantities (gapbeam_quantities)
        integer, intent(in) :: quantities(:)
        !> The places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Where a field jumps: its value left of the place; otherwise right of it
        logical, intent(in) :: from_left
        !> Shape (size(quantities), n); written only where none is out of range
        real(wp), intent(inout) :: fields(:, :)
        !> A place outside the beam, a field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: piece(:)
        real(wp), allocatable :: distance(:)

        call find_pieces(assembled, x, from_left, piece, distance, error)
        if (.not. (allocated(error) .or. allocated(state%ground))) call make_starts(assembled, state, error)
        if (allocated(error)) return
        call fields_in_pieces(assembled, state%factor, state%starts, state%displacement, state%tension, quantities, piece, &
                              distance, fields, error, state%ground, state%along_ground)
    end subroutine fields_at_places

    !> Pieces of given places
    subroutine find_pieces(assembled, x, from_left, piece, distance, error)
        type(assembled_type), intent(in) :: assembled
        !> The places, shape (n), and on which side of what is between two pieces
        real(wp), intent(in) :: x(:)
        logical, intent(in) :: from_left
        !> Piece of every place, and the distance from its left end in the user's units, shape (n)
        integer, allocatable, intent(out) :: piece(:)
        real(wp), allocatable, intent(out) :: distance(:)
        !> A place outside the beam, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: end
        integer :: i, stat

        end = assembled%ends(ubound(assembled%ends, 1))
        do i = 1, size(x)
            if (x(i) >= -end_tolerance*end .and. x(i) <= end + end_tolerance*end) cycle
            call fatal_error(error, gapbeam_bad_input, "x: "//trim(shown(x(i)))//" is outside the beam, which runs from x = 0 "// &
                             "to x = "//trim(shown(end)))
            error%entry = i
            return
        end do
        allocate (piece(size(x)), distance(size(x)), stat=stat)
        if (failed(stat, error)) return
        do i = 1, size(x)
            call find_piece(assembled, x(i), from_left, piece(i), distance(i))
        end do
    end subroutine find_pieces

    !> Fields at given distances from the left ends of pieces
    subroutine fields_in_pieces(assembled, factor, starts, displacement, tension, quantities, piece, distance, fields, error, &
                                ground, along_ground)
        type(assembled_type), intent(in) :: assembled
        !> Factor of the live loads, fields at the left ends of all pieces, and the solution along the axis (state_type)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        real(wp), intent(in) :: displacement(0:), tension(:)
        !> Numbers of the quantities; the pieces, and the distances in the user's units, shape (n)
        integer, intent(in) :: quantities(:), piece(:)
        real(wp), intent(in) :: distance(:)
        !> In the user's units, shape (size(quantities), n), zero of what the beam does not have; written only where none is out of
        !> range
        real(wp), intent(inout) :: fields(:, :)
        !> A field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        !> The solution on the ground, instead of the fields at the pieces; and on ground along the beam
        type(ground_solution_type), intent(in), optional :: ground
        type(ground_along_type), intent(in), optional :: along_ground
        type(field_type), allocatable :: bent(:)
        type(piece_load_type) :: load
        real(wp), allocatable :: found(:, :), pressure(:), across(:)
        real(wp) :: all_of_them(quantity_count)
        integer :: powers(size(quantities)), i, k, stat

        allocate (found(size(quantities), size(piece)), bent(size(piece)), pressure(size(piece)), across(size(piece)), stat=stat)
        if (failed(stat, error)) return
        powers = units_of_fields(assembled, quantities)
        pressure(:) = scale(distance, -assembled%units%length)
        if (present(ground)) then
            call ground_values(assembled, ground, piece, pressure, bent)
            across(:) = bent%shear
            if (any(quantities == of_transverse)) call transverse_forces(assembled, ground, piece, pressure, across)
        else
            call values_at(assembled%pieces, assembled%dead, assembled%live, factor, starts, piece, pressure, bent)
            ! Without an axial force that bending feels it is the shear
            across(:) = bent%shear
        end if
        pressure(:) = 0.0_wp
        all_of_them(:) = 0.0_wp
        do i = 1, size(piece)
            load = combine_loads(assembled%dead(piece(i)), assembled%live(piece(i)), factor)
            all_of_them(bending) = bending_values(bent(i), assembled%pieces(piece(i)), &
                                                  curvature_at(load, scale(distance(i), -assembled%units%length), &
                                                               assembled%pieces(piece(i))%length), &
                                                  scale(distance(i), -assembled%units%length))
            all_of_them(of_transverse) = across(i)
            call axial_fields(assembled, factor, displacement, tension, piece(i), distance(i), all_of_them(of_axial_force), &
                              all_of_them(of_axial_displacement), along_ground)
            if (assembled%model%stretching .and. present(ground) .and. any(quantities == of_axial_displacement)) then
                all_of_them(of_axial_displacement) = displacement_in(assembled, ground, factor, displacement, tension, &
                                                                     piece(i), scale(distance(i), -assembled%units%length))
            end if
            found(:, i) = all_of_them(quantities)
            k = findloc(abs(scale(found(:, i), powers)) <= huge(factor), .false., 1)
            if (k == 0) cycle
            call refuse_field(assembled, quantities(k), found(k, i), point_x(assembled, piece(i) - 1) + distance(i), error)
            error%entry = i
            return
        end do
        if (present(ground) .and. any(quantities == of_pressure)) then
            call pressure_in_pieces(assembled, ground, piece, distance, pressure, error)
            if (allocated(error)) return
        end if
        do i = 1, size(piece)
            fields(:, i) = merge(pressure(i), scale(found(:, i), powers), quantities == of_pressure)
        end do
    end subroutine fields_in_pieces

    !> Exponents of the units of fields
    pure function units_of_fields(assembled, quantities) result(powers)
        type(assembled_type), intent(in) :: assembled
        !> Their numbers
        integer, intent(in) :: quantities(:)
        integer :: powers(size(quantities)), k

        do k = 1, size(quantities)
            if (any(quantities(k) == needs_axial)) then
                powers(k) = quantity_unit(assembled%axial%units, quantities(k))
            else
                powers(k) = quantity_unit(assembled%units, quantities(k))
            end if
        end do
    end function units_of_fields

    !> A field is too great for the user's units, or no number
    subroutine refuse_field(assembled, field, value, x, error)
        type(assembled_type), intent(in) :: assembled
        !> Its number, its value in the engine's units, and the place
        integer, intent(in) :: field
        real(wp), intent(in) :: value, x
        type(error_type), allocatable, intent(out) :: error

        if (abs(value) <= huge(value) .or. any(field == needs_axial)) then
            call refuse_range(error, "the "//trim(quantity_names(field))//" at x = "//trim(shown(x))//" is too great", &
                              trim(quantity_remedies(field)))
        else
            call name_farthest(assembled, error)
        end if
    end subroutine refuse_field

    !> Piece of a place, and the distance from its left end
    pure subroutine find_piece(assembled, x, from_left, piece, distance)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: x
        logical, intent(in) :: from_left
        integer, intent(out) :: piece
        real(wp), intent(out) :: distance
        real(wp) :: offset, tolerance, to_right
        integer :: span, low, high

        call locate(x, assembled%ends, span, offset)
        tolerance = position_tolerance*(assembled%ends(span) + offset)
        ! The last point of the span that is not right of the place
        low = assembled%end_point(span)
        high = low + 1
        if (span < ubound(assembled%ends, 1)) high = assembled%end_point(span + 1)
        low = low + last_not_above(assembled%point_offset(low:high - 1), offset)
        distance = offset - assembled%point_offset(low)
        high = min(low + 1, ubound(assembled%point_span, 1))
        to_right = assembled%point_offset(high) - offset
        if (assembled%point_span(high) == span .and. to_right <= tolerance .and. to_right < distance) then
            low = high
            distance = 0.0_wp
        end if
        if (distance <= tolerance) distance = 0.0_wp
        piece = low + 1
        if (distance > 0.0_wp .or. low == 0) return
        if (from_left .or. piece > size(assembled%pieces)) then
            piece = low
            distance = piece_length(assembled, piece)
        end if
    end subroutine find_piece

    !> Largest and smallest values of fields of a state, and where they are
    subroutine extremes_of_fields(assembled, state, quantities, value, x, error)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        !> Numbers of the quantities (gapbeam_quantities)
        integer, intent(in) :: quantities(:)
        !> Maximum (1) and minimum (2) of each, and their places, shape (2, size(quantities))
        real(wp), intent(out) :: value(:, :), x(:, :)
        !> A field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(state%ground)) call make_starts(assembled, state, error)
        if (allocated(error)) return
        call extremes_of_pieces(assembled, state, state%starts, quantities, value, x, error)
    end subroutine extremes_of_fields

    !> The same from the fields at the left ends of all pieces
    subroutine extremes_of_pieces(assembled, state, starts, quantities, value, x, error)
        !> As for extremes_of_fields
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Of no use on the ground
        type(field_type), intent(in) :: starts(:)
        integer, intent(in) :: quantities(:)
        real(wp), intent(out) :: value(:, :), x(:, :)
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: found(2, quantity_count), places(2, quantity_count), bent(2, bending_count), distance(2, bending_count), &
            at(2), nodal(2)
        integer :: piece(2, bending_count), powers(size(quantities)), of_force(2), i, k

        found(:, :) = 0.0_wp
        places(:, :) = 0.0_wp
        if (allocated(state%ground)) then
            call ground_extremes(assembled, state%ground, state%factor, bent, piece, distance)
        else
            call find_extremes(assembled%pieces, assembled%dead, assembled%live, state%factor, starts, bent, piece, distance)
        end if
        found(:, bending) = bent
        places(:, bending) = place_x(assembled, piece, distance)
        ! Without an axial force that bending feels it is the shear
        found(:, of_transverse) = found(:, of_shear)
        places(:, of_transverse) = places(:, of_shear)
        if (allocated(state%ground) .and. any(quantities == of_transverse)) then
            call transverse_extremes(assembled, state%ground, found(:, of_transverse), of_force, at)
            places(:, of_transverse) = place_x(assembled, of_force, at)
        end if
        if (allocated(assembled%axial%point)) then
            associate (point => assembled%axial%point, displacement => state%displacement, tension => state%tension)
                found(:, of_axial_force) = [maxval(tension), minval(tension)]
                places(:, of_axial_force) = [point_x(assembled, point(maxloc(tension, 1) - 1)), &
                                             point_x(assembled, point(minloc(tension, 1) - 1))]
                found(:, of_axial_displacement) = [maxval(displacement), minval(displacement)]
                places(:, of_axial_displacement) = [point_x(assembled, point(maxloc(displacement, 1) - 1)), &
                                                    point_x(assembled, point(minloc(displacement, 1) - 1))]
                nodal = found(:, of_axial_displacement)
                at = places(:, of_axial_displacement)
            end associate
            if (allocated(assembled%axial%along_bar) .or. allocated(state%along_ground)) then
                call extremes_along(assembled, state%factor, state%displacement, state%tension, &
                                    found(:, of_axial_force:of_axial_displacement), &
                                    places(:, of_axial_force:of_axial_displacement), state%along_ground)
            end if
            if (assembled%model%stretching .and. any(quantities == of_axial_displacement)) then
                found(:, of_axial_displacement) = nodal
                places(:, of_axial_displacement) = at
                call extremes_of_displacement(assembled, state%ground, state%factor, state%displacement, state%tension, &
                                              found(:, of_axial_displacement), places(:, of_axial_displacement))
            end if
        end if
        powers = units_of_fields(assembled, quantities)
        x(:, :) = places(:, quantities)
        do k = 1, size(quantities)
            associate (quantity => quantities(k))
                if (quantity == of_pressure .and. allocated(state%ground)) then
                    call extremes_of_pressure(assembled, state%ground, value(:, k), x(:, k), error)
                    if (allocated(error)) return
                    cycle
                end if
                value(:, k) = scale(found(:, quantity), powers(k))
                i = findloc(abs(value(:, k)) <= huge(1.0_wp), .false., 1)
                if (i == 0) cycle
                call refuse_field(assembled, quantity, found(i, quantity), x(i, k), error)
                return
            end associate
        end do
    end subroutine extremes_of_pieces

    !> x of all nodes
    pure subroutine node_places(assembled, x)
        type(assembled_type), intent(in) :: assembled
        !> Shape (0:n), n + 1 the number of nodes
        real(wp), intent(out) :: x(0:)
        integer :: i

        do i = 0, ubound(x, 1)
            x(i) = point_x(assembled, assembled%node_point(i))
        end do
    end subroutine node_places

    !> The free motion where there is no equilibrium
    pure subroutine motion_of_nodes(assembled, state, x, motion)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Places of the nodes and their displacements down, largest 1, straight between, shape (0:n); all 0 where the beam
        !> slides along its axis
        real(wp), intent(out) :: x(0:), motion(0:)

        call node_places(assembled, x)
        motion(:) = state%motion
    end subroutine motion_of_nodes

end module gapbeam_query
