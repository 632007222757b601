!> Stretches between two points of a beam, of one stiffness or of one that changes as a power of a linear depth, and their loads.
module gapbeam_piece
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: piece_type, piece_load_type, no_load, is_tapered, is_prismatic, greatest_softness

    !> A stretch between two points
    type :: piece_type
        !> Length, 1/EI, 1/GA; of a tapered one at the left end
        real(wp) :: length, flexibility, shear_flexibility
        !> Of an elastic hinge at its left end, which is a node: relative rotation by a moment of 1
        real(wp) :: hinge = 0.0_wp
        !> The same at the right end of a tapered piece, and the powers of a linear depth that EI and GA are; 0: they are constant
        real(wp) :: flexibility_to = 0.0_wp, shear_flexibility_to = 0.0_wp
        integer :: power = 0, shear_power = 0
    end type piece_type

    !> Loads on a piece and on the point at its right end
    type :: piece_load_type
        !> Load per length at the left and right end, imposed curvature
        real(wp) :: qa, qb, kappa
        !> Force (down) and couple (clockwise) at the right end; those on a node are the node's, not the link's
        real(wp) :: force, couple
        !> Rotations imposed at its ends, as a curvature there would: of the node at its left end that rotation, of the one at its
        !> right end minus that
        real(wp) :: kink_a = 0.0_wp, kink_b = 0.0_wp
    end type piece_load_type
    type(piece_load_type), parameter :: no_load = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)

contains

    !> Does its bending or its shear stiffness change along a piece
    elemental function is_tapered(piece) result(yes)
        type(piece_type), intent(in) :: piece
        logical :: yes

        yes = piece%power > 0 .or. piece%shear_power > 0
    end function is_tapered

    !> Is it of one stiffness, without an elastic hinge beside it: what is solved many at a time, and under trains
    elemental function is_prismatic(piece) result(yes)
        type(piece_type), intent(in) :: piece
        logical :: yes

        yes = .not. (is_tapered(piece) .or. piece%hinge > 0.0_wp)
    end function is_prismatic

    !> 1/EI and 1/GA where they are greatest
    pure function greatest_softness(piece) result(softness)
        type(piece_type), intent(in) :: piece
        real(wp) :: softness(2)

        softness(:) = [max(piece%flexibility, piece%flexibility_to), max(piece%shear_flexibility, piece%shear_flexibility_to)]
    end function greatest_softness

end module gapbeam_piece
