!> Pressure of the ground on a solved beam, anywhere along it, and its extremes; also in the user's units.
module gapbeam_pressure
    use gapbeam_kinds, only: wp
    use gapbeam_line_search, only: golden_sections, narrow_to_peak
    use gapbeam_error, only: error_type, failed
    use gapbeam_words, only: shown
    use gapbeam_quantities, only: of_pressure, quantity_names, quantity_remedies
    use gapbeam_units, only: quantity_unit
    use gapbeam_input_error, only: refuse_range
    use gapbeam_assembled_model, only: assembled_type, point_x, place_x
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_element, only: field_type
    use gapbeam_laws, only: law_by_points
    use gapbeam_layers, only: layer_type, law_piece
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_laws, only: contact_line, slope_of_layer, along, push_of_layer
    use gapbeam_ground_query, only: layers_under, stretch_of, share_of, values_in, compare, peaks_in
    implicit none
    private
    public :: pressure_in_pieces, extremes_of_pressure, ground_pressure, pressure_extremes

contains

    !> Pressure at given distances from the left ends of pieces
    subroutine pressure_in_pieces(assembled, solution, piece, distance, pressure, error)
        !> The beam, and its solution on the ground
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> The pieces, and the distances in the user's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Force per length on the beam, up, shape (n); written only where none is out of range
        real(wp), intent(inout) :: pressure(:)
        !> A pressure out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: found(:)
        integer :: i, stat

        allocate (found(size(piece)), stat=stat)
        if (failed(stat, error)) return
        call ground_pressure(assembled, solution, piece, scale(distance, -assembled%units%length), found)
        found(:) = scale(found, quantity_unit(assembled%units, of_pressure))
        i = findloc(abs(found) <= huge(found), .false., 1)
        if (i == 0) then
            pressure(:) = found
        else
            call refuse_pressure(point_x(assembled, piece(i) - 1) + distance(i), error)
            error%entry = i
        end if
    end subroutine pressure_in_pieces

    !> Largest and smallest pressure
    subroutine extremes_of_pressure(assembled, solution, value, x, error)
        !> As for pressure_in_pieces
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Maximum (1) and minimum (2), force per length on the beam, up, and their places
        real(wp), intent(out) :: value(2), x(2)
        !> A pressure out of range
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: distance(2)
        integer :: piece(2), i

        call pressure_extremes(assembled, solution, value, piece, distance)
        value = scale(value, quantity_unit(assembled%units, of_pressure))
        do i = 1, 2
            x(i) = place_x(assembled, piece(i), distance(i))
            if (abs(value(i)) <= huge(value) .or. allocated(error)) cycle
            call refuse_pressure(x(i), error)
        end do
    end subroutine extremes_of_pressure

    !> A pressure is too great for the user's units
    pure subroutine refuse_pressure(x, error)
        real(wp), intent(in) :: x
        type(error_type), allocatable, intent(out) :: error

        call refuse_range(error, "the "//trim(quantity_names(of_pressure))//" at x = "//trim(shown(x))//" is too great", &
                          trim(quantity_remedies(of_pressure)))
    end subroutine refuse_pressure

    !> Pressure of all ground on the beam at distances from the left ends of pieces, force per length, up
    pure subroutine ground_pressure(assembled, solution, piece, distance, pressure)
        !> The beam, and its solution
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> As for ground_values
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> In the engine's units, shape (n)
        real(wp), intent(out) :: pressure(:)
        integer :: i, k

        do k = 1, size(piece)
            i = stretch_of(solution, piece(k), distance(k))
            pressure(k) = pressure_in(assembled, solution, i, share_of(solution, i, distance(k)))
        end do
    end subroutine ground_pressure

    !> Pressure of all layers inside a stretch
    pure function pressure_in(assembled, solution, i, xi) result(pressure)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: xi
        real(wp) :: pressure, place
        type(layer_type) :: layers(assembled%layer_first(solution%piece(i) + 1) - assembled%layer_first(solution%piece(i)))
        type(field_type) :: field
        integer :: k

        pressure = 0.0_wp
        if (allocated(solution%pressure)) then
            pressure = along(solution%pressure(1, i), solution%pressure(2, i), xi, 1.0_wp)
            return
        end if
        call values_in(assembled, solution, i, xi, field)
        place = along(solution%from(i), solution%to(i), xi, 1.0_wp)
        layers(:) = layers_under(assembled, solution, solution%piece(i))
        do k = 1, size(layers)
            pressure = pressure + push_of_layer(layers(k), assembled%law_pieces, solution%acts(k, i), place, &
                                                assembled%pieces(solution%piece(i))%length, field%deflection)
        end do
    end function pressure_in

    !> Where the pressure of all layers is stationary inside a stretch in which no modulus varies: it is the sum of the moduli by
    !> the distance of the deflection from the mean of the lines at which the layers begin to act, weighted by these
    subroutine peaks_of_pressure(assembled, solution, i, xi)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        real(wp), allocatable, intent(out) :: xi(:)
        type(curved_type), allocatable :: none
        type(layer_type) :: layers(assembled%layer_first(solution%piece(i) + 1) - assembled%layer_first(solution%piece(i)))
        real(wp) :: modulus, rise, slope, line(2)
        integer :: k

        modulus = 0.0_wp
        rise = 0.0_wp
        layers(:) = layers_under(assembled, solution, solution%piece(i))
        do k = 1, size(layers)
            associate (acts => solution%acts(k, i), length => assembled%pieces(solution%piece(i))%length)
                if (acts == 0) cycle
                slope = slope_of_layer(layers(k), law_piece(layers(k), assembled%law_pieces, acts), acts, solution%from(i), length)
                line(:) = contact_line(layers(k), [solution%from(i), solution%to(i)], length)
            end associate
            modulus = modulus + slope
            rise = rise + slope*(line(2) - line(1))
        end do
        if (abs(modulus) > 0.0_wp) then
            call peaks_in(solution, i, [1], rise/modulus/solution%stretches(i)%length, none, xi)
        else
            allocate (xi(0))
        end if
    end subroutine peaks_of_pressure

    !> Is the pressure in a stretch more than multiples of the deflection beside lines
    pure function varies(assembled, solution, i)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        logical :: varies

        associate (j => solution%piece(i))
            associate (layers => assembled%layers(assembled%layer_first(j):assembled%layer_first(j + 1) - 1))
                varies = any(solution%acts(:size(layers), i) > 0 .and. (layers%law /= law_by_points .or. law_varies(layers) .or. &
                                                                        abs(layers%modulus_a - layers%modulus_b) > 0.0_wp))
            end associate
        end associate

    contains

        !> Is a law by points another one at the right end of a piece than at the left
        elemental function law_varies(layer)
            type(layer_type), intent(in) :: layer
            logical :: law_varies

            associate (pieces => assembled%law_pieces(layer%law_first:layer%law_last))
                law_varies = any(abs(pieces%force_a - pieces%force_b) > 0.0_wp .or. abs(pieces%slope_a - pieces%slope_b) > 0.0_wp)
            end associate
        end function law_varies

    end function varies

    !> Largest and smallest pressure, and where it is: at an end of a stretch, or where the deflection is extreme beside the ground
    subroutine pressure_extremes(assembled, solution, values, piece, distance)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Maximum (1) and minimum (2), their pieces and distances, shape (2)
        real(wp), intent(out) :: values(2), distance(2)
        integer, intent(out) :: piece(2)
        real(wp), allocatable :: xi(:)
        integer :: i, j

        values = [-huge(1.0_wp), huge(1.0_wp)]
        piece = 1
        distance = 0.0_wp
        do i = 1, size(solution%piece)
            call consider(0.0_wp)
            call consider(1.0_wp)
            if (varies(assembled, solution, i)) then
                call consider(peak_where_it_varies(1))
                call consider(peak_where_it_varies(-1))
                cycle
            end if
            call peaks_of_pressure(assembled, solution, i, xi)
            do j = 1, size(xi)
                call consider(xi(j))
            end do
        end do

    contains

        !> Where the modulus varies, the pressure is a product whose peak no derivative of the fields tells: stretches are short
        !> there, and one peak lies beside the best of some places (golden section)
        function peak_where_it_varies(way) result(at)
            !> 1: largest, -1: smallest
            integer, intent(in) :: way
            real(wp) :: at
            integer, parameter :: places = 16, halvings = 60
            real(wp) :: found(0:places), between(2), inner(2)
            integer :: n

            do n = 0, places
                found(n) = way*pressure_in(assembled, solution, i, real(n, wp)/places)
            end do
            n = maxloc(found, 1) - 1
            between = [max(n - 1, 0), min(n + 1, places)]/real(places, wp)
            do n = 1, halvings
                inner = golden_sections(between)
                call narrow_to_peak(between, way*[pressure_in(assembled, solution, i, inner(1)), &
                                                  pressure_in(assembled, solution, i, inner(2))])
            end do
            at = between(1) + (between(2) - between(1))/2
        end function peak_where_it_varies

        !> Compare with the extremes so far
        subroutine consider(at)
            real(wp), intent(in) :: at

            call compare(solution, i, at, pressure_in(assembled, solution, i, at), 0.0_wp, values, piece, distance)
        end subroutine consider

    end subroutine pressure_extremes

end module gapbeam_pressure
