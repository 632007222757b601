!> Laws of ground layers at a place: whether they act, by which piece, and with which force.
module gapbeam_ground_laws
    use gapbeam_kinds, only: wp
    use gapbeam_law_series, only: curve_type, parameters_of_curve
    use gapbeam_laws, only: law_hardening, law_polyline, parameters_of_law, law_force, law_slope
    use gapbeam_layers, only: layer_type, law_piece_type, pieces_of_law, law_piece, is_curve, has_points
    implicit none
    private
    public :: between, along, contact_line, breaks_on_line, line_of_breakpoint, distance_to_breakpoint, parameters_at, &
        piece_of_deflection, slope_of_layer, offset_of_layer, push_of_layer, slope_at, take_curves

contains

    !> A place k of n steps from a to b, exactly b at the end
    elemental function between(a, b, k, n) result(place)
        real(wp), intent(in) :: a, b
        integer, intent(in) :: k, n
        real(wp) :: place

        place = a + (b - a)*k/n
        if (k == n) place = b
    end function between

    !> Value at a distance from the left end of what varies linearly along a length
    elemental function along(value_a, value_b, distance, length) result(value)
        real(wp), intent(in) :: value_a, value_b, distance, length
        real(wp) :: value

        if (distance <= 0.0_wp) then
            value = value_a
        else if (distance >= length) then
            value = value_b
        else
            value = value_a + (value_b - value_a)*(distance/length)
        end if
    end function along

    !> Deflection at which a layer begins to act, at a distance from the left end of its piece
    elemental function contact_line(layer, distance, length) result(level)
        type(layer_type), intent(in) :: layer
        !> Distance, and length of the piece
        real(wp), intent(in) :: distance, length
        real(wp) :: level

        level = along(layer%contact_a, layer%contact_b, distance, length)
    end function contact_line

    !> Are the deflections at which a law goes on to another piece on straight lines: by points, or at the same displacement
    !> everywhere, also where its parameters begin from nothing at an end. There stiffness times displacement less the limit is zero
    !> whatever the beam does, and says nothing
    elemental function breaks_on_line(layer) result(it_does)
        type(layer_type), intent(in) :: layer
        logical :: it_does

        it_does = has_points(layer)
        if (it_does) return
        associate (a => layer%parameter_a(:2), b => layer%parameter_b(:2))
            if (max(a(1), b(1)) > 0.0_wp) it_does = .not. (any(abs(a - b) > 0.0_wp) .and. any(a > 0.0_wp) .and. any(b > 0.0_wp))
        end associate
    end function breaks_on_line

    !> Deflection at which a layer goes on to a piece of its law, the first one or one that begins on a line
    pure function line_of_breakpoint(laws, layer, number, distance, length) result(level)
        !> Pieces of all laws, and the layer
        type(law_piece_type), intent(in) :: laws(:)
        type(layer_type), intent(in) :: layer
        !> The piece, from 1, which begins there
        integer, intent(in) :: number
        real(wp), intent(in) :: distance, length
        real(wp) :: level
        type(law_piece_type) :: piece

        level = contact_line(layer, distance, length)
        if (has_points(layer)) then
            piece = law_piece(layer, laws, number)
            level = level + layer%side*along(piece%displacement_a, piece%displacement_b, distance, length)
        else if (number > 1 .and. breaks_on_line(layer)) then
            level = level + layer%side*limit_displacement(layer)
        end if
    end function line_of_breakpoint

    !> Displacement at which the force of a law with a limit, which breaks on a line, comes to it
    elemental function limit_displacement(layer) result(displacement)
        type(layer_type), intent(in) :: layer
        real(wp) :: displacement

        associate (a => layer%parameter_a, b => layer%parameter_b)
            displacement = merge(a(2), b(2), a(1) > b(1))/max(a(1), b(1))
        end associate
    end function limit_displacement

    !> Is a deflection beyond a breakpoint of a law: positive if so, with its change along the beam. Where these are on no line,
    !> stiffness times displacement less the limit, which has no pole
    pure subroutine distance_to_breakpoint(laws, layer, number, w, incline, distance, length, past, change)
        !> Pieces of all laws, and the layer
        type(law_piece_type), intent(in) :: laws(:)
        type(layer_type), intent(in) :: layer
        !> The piece, from 1, which begins there
        integer, intent(in) :: number
        !> Deflection and its slope at a distance from the left end of the piece of the beam, and the length of that
        real(wp), intent(in) :: w, incline, distance, length
        real(wp), intent(out) :: past, change
        real(wp) :: p(parameters_of_law)

        past = layer%side*(w - line_of_breakpoint(laws, layer, number, distance, length))
        change = layer%side*(incline - (line_of_breakpoint(laws, layer, number, length, length) &
                                        - line_of_breakpoint(laws, layer, number, 0.0_wp, length))/length)
        if (number == 1 .or. breaks_on_line(layer)) return
        p = parameters_at(layer, distance, length)
        associate (a => layer%parameter_a, b => layer%parameter_b)
            change = p(1)*change + past*(b(1) - a(1))/length - (b(2) - a(2))/length
        end associate
        past = p(1)*past - p(2)
    end subroutine distance_to_breakpoint

    !> Parameters of a law at a distance from the left end of its piece of the beam
    pure function parameters_at(layer, distance, length) result(p)
        type(layer_type), intent(in) :: layer
        real(wp), intent(in) :: distance, length
        real(wp) :: p(parameters_of_law)

        p = along(layer%parameter_a, layer%parameter_b, distance, length)
    end function parameters_at

    !> Parameters of a piece of a law that is a curve there
    pure function curve_at(layer, laws, acts, distance, length) result(p)
        !> The layer, the pieces of all laws, and that on which it acts
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: laws(:)
        integer, intent(in) :: acts
        real(wp), intent(in) :: distance, length
        real(wp) :: p(parameters_of_curve)

        p = [parameters_at(layer, distance, length), 0.0_wp]
        if (layer%law == law_hardening .and. breaks_on_line(layer)) then
            ! What the law does beyond its limit needs their ratio, which rounding spoils near where they begin from nothing
            p(1) = max(p(1), epsilon(1.0_wp)**4*max(layer%parameter_a(1), layer%parameter_b(1)))
            p(2) = p(1)*limit_displacement(layer)
        end if
        if (layer%law /= law_polyline) return
        associate (piece => law_piece(layer, laws, acts))
            p = along([piece%displacement_a, piece%force_a, piece%way_a, piece%slope_a*piece%way_a], &
                      [piece%displacement_b, piece%force_b, piece%way_b, piece%slope_b*piece%way_b], distance, length)
        end associate
    end function curve_at

    !> The piece of its law on which a layer is at a deflection, 0: it is not reached
    pure function piece_of_deflection(laws, layer, w, distance, length) result(number)
        !> Pieces of all laws, and the layer
        type(law_piece_type), intent(in) :: laws(:)
        type(layer_type), intent(in) :: layer
        !> Deflection at a distance from the left end of the piece, and length of the piece
        real(wp), intent(in) :: w, distance, length
        integer :: number
        real(wp) :: past, change

        do number = pieces_of_law(layer), 1, -1
            call distance_to_breakpoint(laws, layer, number, w, 0.0_wp, distance, length, past, change)
            if (past > 0.0_wp) exit
        end do
    end function piece_of_deflection

    !> Force per length and deflection of a layer on a piece of its law that is no curve, at a distance from the left end of the
    !> piece of the beam
    elemental function slope_of_layer(layer, law, number, distance, length) result(slope)
        type(layer_type), intent(in) :: layer
        !> The piece of its law, and its number
        type(law_piece_type), intent(in) :: law
        integer, intent(in) :: number
        real(wp), intent(in) :: distance, length
        real(wp) :: slope

        slope = along(law%slope_a, law%slope_b, distance, length)
        if (.not. has_points(layer)) then
            if (number == 1) slope = along(layer%parameter_a(1), layer%parameter_b(1), distance, length)
        else if (layer%law_last < layer%law_first) then
            slope = along(layer%modulus_a, layer%modulus_b, distance, length)
        end if
    end function slope_of_layer

    !> Force per length that such a piece would have at contact
    elemental function offset_of_layer(layer, law, number, distance, length) result(offset)
        !> As for slope_of_layer
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: law
        integer, intent(in) :: number
        real(wp), intent(in) :: distance, length
        real(wp) :: offset

        offset = along(law%force_a - law%slope_a*law%displacement_a, law%force_b - law%slope_b*law%displacement_b, distance, length)
        if (.not. has_points(layer) .and. number == 2) offset = along(layer%parameter_a(2), layer%parameter_b(2), distance, length)
    end function offset_of_layer

    !> Force per length of a layer on the beam, up
    pure function push_of_layer(layer, laws, acts, place, length, deflection) result(push)
        !> The layer, the pieces of all laws, and that on which it acts, 0: not in contact
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: laws(:)
        integer, intent(in) :: acts
        !> Distance from the left end of its piece of the beam, length of that, deflection there
        real(wp), intent(in) :: place, length, deflection
        real(wp) :: push
        type(law_piece_type) :: law

        push = 0.0_wp
        if (acts == 0) return
        if (is_curve(layer, acts)) then
            push = layer%side*law_force(layer%law, curve_at(layer, laws, acts, place, length), &
                                          layer%side*(deflection - contact_line(layer, place, length)))
        else
            law = law_piece(layer, laws, acts)
            push = layer%side*offset_of_layer(layer, law, acts, place, length) &
                + slope_of_layer(layer, law, acts, place, length)*(deflection - contact_line(layer, place, length))
        end if
        ! At an end of a zone it is zero but for rounding
        if (layer%side /= 0) push = layer%side*max(0.0_wp, layer%side*push)
    end function push_of_layer

    !> Its slope over the deflection there
    pure function slope_at(layer, laws, acts, place, length, deflection) result(slope)
        !> As for push_of_layer
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: laws(:)
        integer, intent(in) :: acts
        real(wp), intent(in) :: place, length, deflection
        real(wp) :: slope

        slope = 0.0_wp
        if (acts == 0) return
        if (is_curve(layer, acts)) then
            slope = law_slope(layer%law, curve_at(layer, laws, acts, place, length), &
                                layer%side*(deflection - contact_line(layer, place, length)))
        else
            slope = slope_of_layer(layer, law_piece(layer, laws, acts), acts, place, length)
        end if
    end function slope_at

    !> The layers under a stretch that act by curves
    pure subroutine take_curves(layers, laws, acts, from, to, length, curves)
        !> Layers under the piece of the beam, the pieces of all laws, and those on which the layers act
        type(layer_type), intent(in) :: layers(:)
        type(law_piece_type), intent(in) :: laws(:)
        integer, intent(in) :: acts(:)
        !> Ends of the stretch, from the left end of the piece, and the length of that
        real(wp), intent(in) :: from, to, length
        !> Not allocated if there is none
        type(curve_type), allocatable, intent(out) :: curves(:)
        integer :: k, n

        n = count(is_curve(layers, acts(:size(layers))))
        if (n == 0) return
        allocate (curves(n))
        n = 0
        do k = 1, size(layers)
            if (.not. is_curve(layers(k), acts(k))) cycle
            n = n + 1
            curves(n) = curve_type(layers(k)%law, layers(k)%side, curve_at(layers(k), laws, acts(k), from, length), &
                                   curve_at(layers(k), laws, acts(k), to, length), contact_line(layers(k), from, length), &
                                   contact_line(layers(k), to, length))
        end do
    end subroutine take_curves

end module gapbeam_ground_laws
