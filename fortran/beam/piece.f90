!> Stretches between two points of a beam, of one stiffness or of one that changes as a power of a linear depth, and their loads.
module gapbeam_piece
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: piece_type, piece_load_type, no_load, any_load, combine_loads, is_tapered, is_prismatic, is_compressed, &
        greatest_softness, curvature_at

    !> A stretch between two points
    type :: piece_type
        !> Length, 1/EI, 1/GA; of a tapered one at the left end
        real(wp) :: length, flexibility, shear_flexibility
        !> Of an elastic hinge at its left end, which is a node: relative rotation by a moment of 1
        real(wp) :: hinge = 0.0_wp
        !> The same at the right end of a tapered piece, and the powers of a linear depth that EI and GA are; 0: they are constant
        real(wp) :: flexibility_to = 0.0_wp, shear_flexibility_to = 0.0_wp
        integer :: power = 0, shear_power = 0
        !> Axial force in it that its bending feels, tension positive, with what ground resists slopes with, and that alone
        real(wp) :: tension = 0.0_wp, slope_stiffness = 0.0_wp
        !> By how much it is greater at the right end than at the left one, linear in between
        real(wp) :: tension_change = 0.0_wp
        !> Compression for which it is cut into steps, the greatest that it comes under
        real(wp) :: compression = 0.0_wp
        !> Mass per length, for vibrations
        real(wp) :: mass = 0.0_wp
        !> Tension for which it is cut where that changes along it, likewise
        real(wp) :: pull = 0.0_wp
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
        !> Couples (clockwise) just inside its ends, beside hinges there
        real(wp) :: couple_a = 0.0_wp, couple_b = 0.0_wp
        !> By how much the imposed curvature is greater at the right end than at the left one, in between linear
        real(wp) :: rise = 0.0_wp
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

    !> Is there compression in it that bending feels
    elemental function is_compressed(piece) result(yes)
        type(piece_type), intent(in) :: piece
        logical :: yes

        yes = piece%tension + min(0.0_wp, piece%tension_change) < piece%slope_stiffness
    end function is_compressed

    !> Is there any load on the pieces of a link; the point load of the last one belongs to its node
    pure function any_load(loads) result(found)
        type(piece_load_type), intent(in) :: loads(:)
        logical :: found
        integer :: j

        found = .true.
        do j = 1, size(loads)
            associate (q => loads(j))
                if (max(abs(q%qa), abs(q%qb), abs(q%kappa), abs(q%kink_a), abs(q%kink_b)) > 0) return
                if (max(abs(q%couple_a), abs(q%couple_b), abs(q%rise)) > 0) return
                if (j < size(loads) .and. max(abs(q%force), abs(q%couple)) > 0) return
            end associate
        end do
        found = .false.
    end function any_load

    !> Dead plus factor times live
    elemental function combine_loads(dead, live, factor) result(loads)
        type(piece_load_type), intent(in) :: dead, live
        real(wp), intent(in) :: factor
        type(piece_load_type) :: loads

        loads%qa = dead%qa + factor*live%qa
        loads%qb = dead%qb + factor*live%qb
        loads%kappa = dead%kappa + factor*live%kappa
        loads%force = dead%force + factor*live%force
        loads%couple = dead%couple + factor*live%couple
        loads%kink_a = dead%kink_a + factor*live%kink_a
        loads%kink_b = dead%kink_b + factor*live%kink_b
        loads%couple_a = dead%couple_a + factor*live%couple_a
        loads%couple_b = dead%couple_b + factor*live%couple_b
        loads%rise = dead%rise + factor*live%rise
    end function combine_loads

    !> Curvature that is imposed at a distance from the left end of a piece
    pure function curvature_at(load, distance, length) result(kappa)
        type(piece_load_type), intent(in) :: load
        real(wp), intent(in) :: distance
        !> Of the piece
        real(wp), intent(in) :: length
        real(wp) :: kappa

        kappa = load%kappa
        if (abs(load%rise) > 0.0_wp) kappa = kappa + load%rise*(distance/length)
    end function curvature_at

    !> 1/EI and 1/GA where they are greatest
    pure function greatest_softness(piece) result(softness)
        type(piece_type), intent(in) :: piece
        real(wp) :: softness(2)

        softness(:) = [max(piece%flexibility, piece%flexibility_to), max(piece%shear_flexibility, piece%shear_flexibility_to)]
    end function greatest_softness

end module gapbeam_piece
