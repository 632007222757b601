!> Stiffness of a stretch of beam on elastic ground and under an axial force (Winkler 1867; Hetenyi 1946).
!>
!> The unknowns are those of the simply supported bar of docs/method.md 2, deflections and moments of both ends; a
!> modulus of zero leaves that bar. Local coordinate x = 0..L to the right, xi = x/L. Signs as there: deflection, load and
!> ground's pressure K w with the load against it, moment sagging, V = M', psi = w' - V/GA:
!> psi' = -M/EI + kappa, T' = K w - q. T is the transverse force V + N w', without an axial force the shear.
module gapbeam_foundation
    use gapbeam_kinds, only: wp
    use gapbeam_foundation_stretch, only: softest, softness_in
    use gapbeam_foundation_taylor, only: stretch_type, stretch_load_type, half_type, half_link, mirrored, turned, is_sloped, &
        stretched_shear, trace_of, determinant_of
    use gapbeam_foundation_series, only: end_functions_type, short_ends, is_short
    use gapbeam_foundation_long, only: long_of, long_ends
    implicit none
    private
    public :: stretch_type, stretch_load_type, stretch_link_type, stretch_ends_type
    public :: condense_loaded, link_of_halves, decay_lengths

    !> How a stretch's ends answer:
    !>
    !>     psi_a = -pa w_a + p1 w_b + faa M_a + fab M_b + turn_a      T_a = -pa M_a + p2 M_b - gaa w_a - gab w_b + shear_a
    !>     psi_b =  pb w_b - p2 w_a - fab M_a - fbb M_b - turn_b      T_b =  pb M_b - p1 M_a + gbb w_b + gab w_a - shear_b
    type :: stretch_link_type
        !> 1/length: without ground all are 1/L
        real(wp) :: pa, pb, p1, p2
        !> Flexibilities (rotation by a moment) and stiffnesses (force by a deflection); the latter vanish without ground and
        !> axial force
        real(wp) :: faa, fab, fbb, gaa, gab, gbb
        !> faa fbb - fab**2, gaa gbb - gab**2 and pa pb - p1 p2, formed without subtraction
        real(wp) :: df, dg, dh
        !> Sums that eliminations need, formed without subtraction: faa p2**2 + 2 pa p2 fab + pa**2 fbb
        real(wp) :: s1
        !> p2 fab + pa fbb
        real(wp) :: s2
        !> faa pb + p1 fab
        real(wp) :: s3
        !> gaa s3 + pa (dh + fab gab) + faa p2 gab
        real(wp) :: s4
        !> pa pb + dh + fab gab
        real(wp) :: s5
        !> gaa pb + p2 gab
        real(wp) :: s6
        !> p1 gab + pa gbb
        real(wp) :: s7
        !> gaa p1**2 + 2 pa p1 gab + pa**2 gbb
        real(wp) :: s8
        !> Does ground hold it
        logical :: grounded
    end type stretch_link_type

    !> Deflections and moments of the two ends of a stretch in equilibrium
    type :: stretch_ends_type
        real(wp) :: w_a = 0.0_wp, w_b = 0.0_wp, moment_a = 0.0_wp, moment_b = 0.0_wp
    end type stretch_ends_type

contains

    !> How many decay lengths a stretch is long: beta L, beta = (K/(4 EI))**(1/4), and more with shear or an axial force. Where the
    !> modulus is linear or negative, the stretch tapers, or the beam is compressed, it is the caller's to cut stretches until this
    !> is 1 at most; others may be as long as they are
    elemental function decay_lengths(stretch) result(number)
        type(stretch_type), intent(in) :: stretch
        real(wp) :: number, k, soft(2)

        k = max(abs(stretch%modulus_a), abs(stretch%modulus_b))
        soft(:) = softest(stretch)
        number = stretch%length*sqrt(abs(trace_of(stretch, k)) + 2*sqrt(k/stretched_shear(stretch))*sqrt(soft(1)))/2
    end function decay_lengths

    !> How the ends of a stretch answer to their deflections and moments, and what loads make there where these are zero: the
    !> functions of the ends, or the series, are found once
    pure subroutine condense_loaded(stretch, loads, link, turn_a, turn_b, shear_a, shear_b)
        !> The stretch and some loads
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: loads(:)
        !> Its link
        type(stretch_link_type), intent(out) :: link
        !> turn_a, -turn_b: rotations; shear_a, -shear_b: shears, shape (size(loads))
        real(wp), intent(out) :: turn_a(:), turn_b(:), shear_a(:), shear_b(:)
        type(end_functions_type) :: h
        type(half_type) :: a, b
        integer :: k

        if (is_sloped(stretch)) then
            call half_link(stretch, loads, a, turn_a, shear_a)
            call half_link(mirrored(stretch), turned(loads), b, turn_b, shear_b)
            call link_of_halves(shear_softness(stretch), a, b, link)
        else
            h = end_functions(stretch)
            call condense_even(stretch, h, link)
            do k = 1, size(loads)
                call load_even(stretch, h, loads(k), turn_a(k), turn_b(k), shear_a(k), shear_b(k))
            end do
        end if
        link%grounded = max(abs(stretch%modulus_a), abs(stretch%modulus_b)) > 0.0_wp
    end subroutine condense_loaded

    !> How the ends answer where modulus and stiffness are constant
    pure subroutine condense_even(stretch, h, link)
        type(stretch_type), intent(in) :: stretch
        !> The functions of its ends
        type(end_functions_type), intent(in) :: h
        type(stretch_link_type), intent(out) :: link
        real(wp) :: l, k, f, d, bend, bend_b, press, press_b

        l = stretch%length
        k = l*stretch%modulus_a
        f = l*stretch%flexibility
        d = (h%c - h%e)*(h%c + h%e)
        link%pa = h%a/l
        link%p1 = h%b/l
        link%dh = k*f*d/stretched_shear(stretch)
        bend = f*h%c
        bend_b = f*h%e
        press = k*h%c
        press_b = k*h%e
        ! With shear the flexibilities are bend + p/GA, with an axial force the stiffnesses press + p N; where that would subtract,
        ! the sums below are arranged anew
        associate (p => link%pa, p1 => link%p1, g => stretch%shear_flexibility, n => stretch%tension)
            link%faa = bend + g*p
            link%fab = bend_b - g*p1
            link%gaa = press + n*p
            link%gab = press_b - n*p1
            link%df = f**2*d + g*(2*(p*bend + p1*bend_b) + g*link%dh)
            link%dg = k**2*d + n*(2*(p*press + p1*press_b) + n*link%dh)
            link%s1 = bend*(p**2 + p1**2) + 2*p*p1*bend_b + g*p*link%dh
            link%s2 = p1*bend_b + p*bend + g*link%dh
            link%s4 = link%dh*(p + n*link%faa) + press*link%s2 + press_b*(p*bend_b + p1*bend)
            link%s5 = 2*link%dh + stretched_shear(stretch)*h%determinant/l**2
            link%s6 = press*p + p1*press_b + n*link%dh
            link%s8 = press*(p**2 + p1**2) + 2*p*p1*press_b + n*p*link%dh
        end associate
        link%s7 = link%s6
        link%s3 = link%s2
        link%pb = link%pa
        link%p2 = link%p1
        link%fbb = link%faa
        link%gbb = link%gaa
    end subroutine condense_even

    !> 1/GA at both ends of a stretch
    pure function shear_softness(stretch) result(g)
        type(stretch_type), intent(in) :: stretch
        real(wp) :: g(2), soft(2)
        integer :: end

        do end = 1, 2
            soft(:) = softness_in(stretch, real(end - 1, wp))
            g(end) = soft(2)
        end do
    end function shear_softness

    !> The link from what its ends feel
    pure subroutine link_of_halves(g, a, b, link)
        !> 1/GA at both ends
        real(wp), intent(in) :: g(2)
        !> What the left end feels, and the right one, seen from there
        type(half_type), intent(in) :: a, b
        type(stretch_link_type), intent(out) :: link

        link%pa = a%pa
        link%pb = b%pa
        link%p1 = a%p1
        link%p2 = b%p1
        link%gaa = a%gaa
        link%gbb = b%gaa
        link%gab = (a%gab + b%gab)/2
        link%dg = a%dg
        link%dh = a%dh
        ! With shear w = v + M/GA; the sums are arranged as where the modulus is constant
        link%faa = a%faa + g(1)*a%pa
        link%fbb = b%faa + g(2)*b%pa
        link%fab = a%fab - g(2)*a%p1
        link%df = a%df + (g(1)*(b%faa*a%pa + a%fab*b%p1) + g(2)*(a%faa*b%pa + b%fab*a%p1) + g(1)*g(2)*a%dh)
        link%s1 = a%faa*b%p1**2 + a%pa*b%p1*(a%fab + b%fab) + a%pa**2*b%faa + g(2)*a%pa*a%dh
        link%s2 = b%p1*a%fab + a%pa*b%faa + g(2)*a%dh
        link%s3 = a%faa*b%pa + a%p1*b%fab + g(1)*a%dh
        link%s4 = link%gaa*link%s3 + a%pa*a%dh + link%gab*(a%pa*b%fab + a%faa*b%p1)
        link%s5 = 2*a%dh + 1/a%determinant
        link%s6 = link%gaa*link%pb + link%p2*link%gab
        link%s7 = link%p1*link%gab + link%pa*link%gbb
        link%s8 = link%gaa*link%p1**2 + link%pa*(2*link%p1*link%gab + link%pa*link%gbb)
        link%grounded = .true.
        if (any(abs([a%dg, a%dh, b%dg, b%dh]) > 0.0_wp)) return
        ! Without ground nothing resists ends that move alike, not even by rounding
        link%gaa = -link%gab
        link%gbb = -link%gab
        link%dg = 0.0_wp
        link%dh = 0.0_wp
        link%s4 = 0.0_wp
        link%s6 = 0.0_wp
        link%s7 = 0.0_wp
        link%s8 = 0.0_wp
    end subroutine link_of_halves

    !> Rotations and shears of the ends that a load makes where modulus and stiffness are constant
    pure subroutine load_even(stretch, h, load, turn_a, turn_b, shear_a, shear_b)
        type(stretch_type), intent(in) :: stretch
        !> The functions of its ends
        type(end_functions_type), intent(in) :: h
        type(stretch_load_type), intent(in) :: load
        real(wp), intent(out) :: turn_a, turn_b, shear_a, shear_b
        real(wp) :: l, f, k, pull, bent(2), turn, shear

        l = stretch%length
        f = l**2*stretch%flexibility/stretched_shear(stretch)
        k = l**2*stretch%modulus_a/stretched_shear(stretch)
        pull = stretch%tension*f
        associate (p => h%a_rest, q => h%b_rest, at_a => load%kappa, at_b => load%kappa + load%rise)
            ! What both ends feel of a curvature, as of end moments, but for those themselves
            bent(:) = [at_a*p + at_b*q, at_b*p + at_a*q]*k
            turn = load%qc*h%bubble*f
            shear = load%qc*(2*(p + q) + pull*h%bubble)
            turn_a = l*((load%qa*p + load%qb*q)*f + (turn - ((at_a*h%c + at_b*h%e) + stretch%shear_flexibility*bent(1))))
            turn_b = l*((load%qb*p + load%qa*q)*f + (turn - ((at_b*h%c + at_a*h%e) + stretch%shear_flexibility*bent(2))))
            shear_a = l*((load%qa*(h%c + pull*p) + load%qb*(h%e + pull*q)) + (shear + bent(1)))
            shear_b = l*((load%qb*(h%c + pull*p) + load%qa*(h%e + pull*q)) + (shear + bent(2)))
        end associate
    end subroutine load_even

    !> The functions of the ends of a stretch of constant modulus
    pure function end_functions(stretch) result(h)
        type(stretch_type), intent(in) :: stretch
        type(end_functions_type) :: h
        real(wp) :: sigma, tau

        sigma = trace_of(stretch, stretch%modulus_a)*stretch%length**2
        tau = determinant_of(stretch, stretch%modulus_a)*stretch%length**4
        if (is_short(sigma, tau)) then
            h = short_ends(sigma, tau)
        else
            h = long_ends(long_of(sigma, tau))
        end if
    end function end_functions

end module gapbeam_foundation
