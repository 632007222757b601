!> Layers of ground under the pieces of a beam, with their laws.
module gapbeam_layers
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: law_by_points, law_polyline, law_plastic, law_hardening, law_hyperbolic, law_tanh, &
        parameters_of_law
    implicit none
    private
    public :: layer_type, law_piece_type, pieces_of_law, branches_of_law, law_piece, is_curve, has_curves, has_points, has_limit, &
              falls, falls_on, other_way

    !> One foundation under one piece of the beam. It pushes back where side*(w - contact) > 0, by its modulus or by a law
    type :: layer_type
        !> Number of the foundation in the model
        integer :: foundation = 0
        !> 1 pushes up only, -1 pushes down only, 0 both ways
        integer :: side = 0
        !> Force per length and deflection at the left and right end of the piece, linear in between; unused with a law
        real(wp) :: modulus_a = 0.0_wp, modulus_b = 0.0_wp
        !> Deflection at which it begins to act at the two ends, linear in between
        real(wp) :: contact_a = 0.0_wp, contact_b = 0.0_wp
        !> First and last piece of its law among all; none: linear
        integer :: law_first = 1, law_last = 0
        !> The law, if not by points, and its parameters at the left and right end of the piece, linear in between
        integer :: law = law_by_points
        real(wp) :: parameter_a(parameters_of_law) = 0.0_wp, parameter_b(parameters_of_law) = 0.0_wp
        !> Does it never give way: its moduli are 0 then, and it pushes one way
        logical :: rigid = .false.
    end type layer_type

    !> A piece of a law: from a displacement past the contact and the force per length there, with a slope over a way to the next
    !> point; all at the left and right end of the piece of the beam
    type :: law_piece_type
        !> Linear in between; the slope too where the way is the same at both ends, otherwise slope times way
        real(wp) :: displacement_a = 0.0_wp, displacement_b = 0.0_wp, force_a = 0.0_wp, force_b = 0.0_wp, slope_a = 0.0_wp, &
                    slope_b = 0.0_wp, way_a = 1.0_wp, way_b = 1.0_wp
    end type law_piece_type

contains

    !> The layer with which another one holds the beam both ways from one line, the same ground; 0: there is none
    pure function other_way(layers, number) result(other)
        !> Under one piece; which of them it is
        type(layer_type), intent(in) :: layers(:)
        integer, intent(in) :: number
        integer :: other

        do other = max(1, number - 1), min(number + 1, size(layers))
            associate (a => layers(number), b => layers(other))
                if (a%foundation == b%foundation .and. a%side*b%side < 0 .and. &
                    .not. (abs(a%contact_a - b%contact_a) > 0.0_wp .or. abs(a%contact_b - b%contact_b) > 0.0_wp)) return
            end associate
        end do
        other = 0
    end function other_way

    !> Number of pieces on which a layer acts
    elemental function pieces_of_law(layer) result(number)
        type(layer_type), intent(in) :: layer
        integer :: number

        number = max(1, layer%law_last - layer%law_first + 1)
        if (layer%law == law_plastic .or. layer%law == law_hardening) number = 2
    end function pieces_of_law

    !> Number of pieces of the law of a layer, 0: it has none, or a curve
    elemental function branches_of_law(layer) result(number)
        type(layer_type), intent(in) :: layer
        integer :: number

        number = 0
        if (layer%law_last >= layer%law_first .or. pieces_of_law(layer) > 1) number = pieces_of_law(layer)
    end function branches_of_law

    !> Is a piece of a law not linear in displacement and place
    elemental function is_curve(layer, number) result(it_is)
        type(layer_type), intent(in) :: layer
        !> The piece, from 1; 0: none
        integer, intent(in) :: number
        logical :: it_is

        it_is = number > 0 .and. (layer%law >= law_hyperbolic .or. (layer%law == law_hardening .and. number == 2))
    end function is_curve

    !> Does a layer have such pieces
    elemental function has_curves(layer) result(has)
        type(layer_type), intent(in) :: layer
        logical :: has

        has = layer%law >= law_hardening
    end function has_curves

    !> Is a law, if there is one, given by points
    elemental function has_points(layer) result(has)
        type(layer_type), intent(in) :: layer
        logical :: has

        has = layer%law == law_by_points .or. layer%law == law_polyline
    end function has_points

    !> Is there a force that a layer never exceeds
    pure function has_limit(layer, laws) result(has)
        type(layer_type), intent(in) :: layer
        !> Pieces of all laws
        type(law_piece_type), intent(in) :: laws(:)
        logical :: has

        has = any(layer%law == [law_plastic, law_hyperbolic, law_tanh])
        if (has_points(layer) .and. layer%law_last >= layer%law_first) then
            associate (last => laws(layer%law_last))
                has = .not. max(last%slope_a, last%slope_b) > 0.0_wp
            end associate
        end if
    end function has_limit

    !> Does the force of a layer fall anywhere
    pure function falls(layer, laws) result(it_does)
        type(layer_type), intent(in) :: layer
        !> Pieces of all laws
        type(law_piece_type), intent(in) :: laws(:)
        logical :: it_does

        it_does = any(falls_on(laws(layer%law_first:layer%law_last)))
    end function falls

    !> Does the force of a law fall on one of its pieces
    elemental function falls_on(piece) result(it_does)
        type(law_piece_type), intent(in) :: piece
        logical :: it_does

        it_does = min(piece%slope_a, piece%slope_b) < 0.0_wp
    end function falls_on

    !> A piece of the law of a layer; of a linear one the only piece, without its slope
    pure function law_piece(layer, laws, number) result(piece)
        type(layer_type), intent(in) :: layer
        !> Pieces of all laws
        type(law_piece_type), intent(in) :: laws(:)
        !> From 1
        integer, intent(in) :: number
        type(law_piece_type) :: piece

        piece = law_piece_type()
        if (layer%law_last >= layer%law_first) piece = laws(layer%law_first + number - 1)
    end function law_piece

end module gapbeam_layers
