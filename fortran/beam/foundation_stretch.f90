!> A stretch of beam on elastic ground: what it is made of, what loads it, and its stiffness where it tapers.
!>
!> Where EI or GA are powers of a depth that is linear, v = w - M/GA obeys v' = psi - (1/GA)' M, and M/EI and M/GA have series of
!> their own, by division by the powers of the depth; they converge up to where the depth would vanish.
module gapbeam_foundation_stretch
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_power
    use gapbeam_tolerances, only: same_length
    use gapbeam_piece, only: piece_type, is_tapered
    use gapbeam_taper, only: depth_ratios, softness_at
    implicit none
    private
    public :: stretch_type, stretch_load_type, softness_type
    public :: are_alike, same_load
    public :: tension_at, greatest_tension
    public :: stretch_between, is_of_one_stiffness, softness_in, softest, without_slip, part_of_stretch, softness_around, soften

    !> A stretch on elastic ground
    type :: stretch_type
        !> Length, 1/EI and 1/GA (zero: rigid); of a tapered one at its left end
        real(wp) :: length = 0.0_wp, flexibility = 0.0_wp, shear_flexibility = 0.0_wp
        !> Modulus of the ground (force/length**2) at the left and right end, linear in between; negative where it softens
        real(wp) :: modulus_a = 0.0_wp, modulus_b = 0.0_wp
        !> Axial force N in it, tension positive, with that of a layer that resists slopes (Pasternak)
        real(wp) :: tension = 0.0_wp
        !> By how much it is greater at the right end than at the left one, linear in between; not where shear bends
        real(wp) :: tension_change = 0.0_wp
        !> Of EI and of GA: by what share of itself the depth grows from the left to the right end, and which power of it they
        !> are; 0: they are constant
        real(wp) :: taper(2) = 0.0_wp
        integer :: power(2) = 0
    end type stretch_type

    !> What loads a stretch
    type :: stretch_load_type
        !> Load per length qa (1 - xi) + qb xi + qc xi (1 - xi), down; imposed curvature kappa + rise xi
        real(wp) :: qa = 0.0_wp, qb = 0.0_wp, qc = 0.0_wp, kappa = 0.0_wp, rise = 0.0_wp
        !> Rotations imposed at its ends, and couples just inside them, as of piece_load_type
        real(wp) :: kink_a = 0.0_wp, kink_b = 0.0_wp, couple_a = 0.0_wp, couple_b = 0.0_wp
    end type stretch_load_type

    !> 1/EI and 1/GA at a place, the powers of the depth that they are, and the coefficients of these powers relative to the place,
    !> without the first, 1
    type :: softness_type
        real(wp) :: value(2)
        integer :: power(2)
        real(wp) :: b(most_power, 2)
    end type softness_type

contains

    !> Are two stretches the same, but for what rounding of the places of their ends makes of their lengths
    pure function are_alike(a, b) result(alike)
        type(stretch_type), intent(in) :: a, b
        logical :: alike

        alike = abs(a%length - b%length) <= same_length*a%length .and. all(a%power == b%power)
        if (alike) alike = all(is_equal([a%flexibility, a%shear_flexibility, a%modulus_a, a%modulus_b, a%tension, &
                                            a%tension_change, a%taper], &
                                           [b%flexibility, b%shear_flexibility, b%modulus_a, b%modulus_b, b%tension, &
                                            b%tension_change, b%taper]))
    end function are_alike

    !> Are two loads the same
    pure function same_load(a, b) result(same)
        type(stretch_load_type), intent(in) :: a, b
        logical :: same

        same = all(is_equal([a%qa, a%qb, a%qc, a%kappa, a%rise, a%kink_a, a%kink_b, a%couple_a, a%couple_b], &
                               [b%qa, b%qb, b%qc, b%kappa, b%rise, b%kink_a, b%kink_b, b%couple_a, b%couple_b]))
    end function same_load

    !> Is a number the same as another: comparing costs a fraction of what a difference does in quadruple precision
    elemental function is_equal(a, b) result(same)
        real(wp), intent(in) :: a, b
        logical :: same

        same = a <= b .and. a >= b
    end function is_equal

    !> What of a piece lies between two places, without ground
    pure function stretch_between(piece, from, to) result(stretch)
        type(piece_type), intent(in) :: piece
        !> From its left end
        real(wp), intent(in) :: from, to
        type(stretch_type) :: stretch
        real(wp) :: softness(2), growth(2)

        stretch = stretch_type(length=to - from, flexibility=piece%flexibility, shear_flexibility=piece%shear_flexibility, &
                               tension=piece%tension + piece%tension_change*(from/piece%length), &
                               tension_change=piece%tension_change*((to - from)/piece%length))
        if (.not. is_tapered(piece)) return
        softness(:) = softness_at(piece, from)
        growth(:) = depth_ratios(piece) - 1
        stretch%flexibility = softness(1)
        stretch%shear_flexibility = softness(2)
        stretch%taper(:) = growth*((to - from)/piece%length)/(1 + growth*(from/piece%length))
        stretch%power(:) = [piece%power, piece%shear_power]
    end function stretch_between

    !> Are EI and GA constant along it
    pure function is_of_one_stiffness(stretch) result(constant)
        type(stretch_type), intent(in) :: stretch
        logical :: constant

        constant = all(stretch%power == 0)
    end function is_of_one_stiffness

    !> Axial force at a share of the length
    elemental function tension_at(stretch, xi) result(tension)
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: xi
        real(wp) :: tension

        tension = stretch%tension + xi*stretch%tension_change
    end function tension_at

    !> Axial force in it that is greatest by absolute value
    elemental function greatest_tension(stretch) result(tension)
        type(stretch_type), intent(in) :: stretch
        real(wp) :: tension

        tension = stretch%tension
        if (abs(tension_at(stretch, 1.0_wp)) > abs(tension)) tension = tension_at(stretch, 1.0_wp)
    end function greatest_tension

    !> 1/EI and 1/GA at a share of the length
    pure function softness_in(stretch, xi) result(softness)
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: xi
        real(wp) :: softness(2)

        softness(:) = [stretch%flexibility, stretch%shear_flexibility]
        if (any(stretch%power > 0)) softness(:) = softness/(1 + stretch%taper*xi)**stretch%power
    end function softness_in

    !> 1/EI and 1/GA where they are greatest
    pure function softest(stretch) result(softness)
        type(stretch_type), intent(in) :: stretch
        real(wp) :: softness(2)

        softness(:) = max(softness_in(stretch, 0.0_wp), softness_in(stretch, 1.0_wp))
    end function softest

    !> v = w - M/GA at a share of the length
    pure function without_slip(stretch, xi, w, moment) result(v)
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: xi, w, moment
        real(wp) :: v, softness(2)

        softness(:) = softness_in(stretch, xi)
        v = w - softness(2)*moment
    end function without_slip

    !> What lies between two shares of the length of a stretch, also a little beyond its ends
    pure function part_of_stretch(stretch, share) result(part)
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: share(2)
        type(stretch_type) :: part
        real(wp) :: soft(2)

        part = stretch
        part%length = (share(2) - share(1))*stretch%length
        part%tension = tension_at(stretch, share(1))
        part%tension_change = (share(2) - share(1))*stretch%tension_change
        part%modulus_a = at(share(1))
        part%modulus_b = at(share(2))
        if (is_of_one_stiffness(stretch)) return
        soft(:) = softness_in(stretch, share(1))
        part%flexibility = soft(1)
        part%shear_flexibility = soft(2)
        part%taper(:) = stretch%taper*(share(2) - share(1))/(1 + stretch%taper*share(1))

    contains

        !> Modulus at a share
        pure function at(xi) result(modulus)
            real(wp), intent(in) :: xi
            real(wp) :: modulus

            modulus = stretch%modulus_a + xi*(stretch%modulus_b - stretch%modulus_a)
            if (.not. abs(xi - 1) > 0.0_wp) modulus = stretch%modulus_b
        end function at

    end function part_of_stretch

    !> How 1/EI and 1/GA are around a place
    pure function softness_around(stretch, xi, step) result(softness)
        !> As for expand
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: xi, step
        type(softness_type) :: softness
        real(wp) :: growth(2)
        integer :: j

        softness%value(:) = softness_in(stretch, xi)
        softness%power(:) = stretch%power
        if (is_of_one_stiffness(stretch)) return
        growth(:) = stretch%taper*step/(1 + stretch%taper*xi)
        softness%b(1, :) = stretch%power*growth
        do j = 2, most_power
            softness%b(j, :) = softness%b(j - 1, :)*growth*max(stretch%power - j + 1, 0)/j
        end do
    end function softness_around

    !> The next terms of the series of M/EI, M/GA and (1/GA)' M from those of M: all are divided by a power of the depth
    pure subroutine soften(softness, i, moment, bent, slid, shifted)
        type(softness_type), intent(in) :: softness
        !> Number of the term, from 0
        integer, intent(in) :: i
        !> The term of M, shape (cases)
        real(wp), intent(in) :: moment(:)
        !> Terms up to that one, shape (cases, 0:at least i); the last only where GA changes
        real(wp), intent(inout), contiguous :: bent(:, 0:), slid(:, 0:), shifted(:, 0:)
        integer :: j

        associate (s => softness)
            bent(:, i) = s%value(1)*moment
            do j = 1, min(i, s%power(1))
                bent(:, i) = bent(:, i) - s%b(j, 1)*bent(:, i - j)
            end do
            slid(:, i) = s%value(2)*moment
            do j = 1, min(i, s%power(2))
                slid(:, i) = slid(:, i) - s%b(j, 2)*slid(:, i - j)
            end do
            if (s%power(2) == 0) return
            ! The first coefficient is the power times the growth of the depth
            shifted(:, i) = -s%b(1, 2)*slid(:, i)
            if (i > 0) shifted(:, i) = shifted(:, i) - s%b(1, 2)/s%power(2)*shifted(:, i - 1)
        end associate
    end subroutine soften

end module gapbeam_foundation_stretch
