!> Ground under the pieces of a beam: what every layer does as the beam is pressed into it
module gapbeam_layers
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: layer_type, law_piece_type, pieces_of_law, law_piece

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
    end type layer_type

    !> A piece of a law: from a displacement past the contact and the force per length there, with a slope that is not below 0
    type :: law_piece_type
        real(wp) :: displacement = 0.0_wp, force = 0.0_wp, slope = 0.0_wp
    end type law_piece_type

contains

    !> Number of pieces on which a layer acts
    elemental function pieces_of_law(layer) result(number)
        type(layer_type), intent(in) :: layer
        integer :: number

        number = max(1, layer%law_last - layer%law_first + 1)
    end function pieces_of_law

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
