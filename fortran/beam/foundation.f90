!> A prismatic stretch of beam on elastic ground (Winkler 1867; Hetenyi 1946): how its ends answer, and the fields inside.
!>
!> The unknowns are those of the simply supported bar of docs/method.md 1, deflections and moments of both ends; a
!> modulus of zero leaves that bar. Local coordinate x = 0..L to the right, xi = x/L. Signs as there: deflection, load and
!> ground's pressure K w with the load against it, moment sagging, V = M', psi = w' - V/GA:
!> psi' = -M/EI + kappa, V' = K w - q.
module gapbeam_foundation
    use gapbeam_kinds, only: wp
    use gapbeam_foundation_taylor, only: stretch_type, stretch_load_type, half_type, half_link, advance
    use gapbeam_foundation_series, only: end_functions_type, triple_type, response_type, short_ends, short_response
    use gapbeam_foundation_long, only: long_type, long_of, long_ends, decay_type, long_response
    implicit none
    private
    public :: stretch_type, stretch_load_type, stretch_link_type, stretch_ends_type
    public :: condense_stretch, condense_loaded, link_of_halves, load_stretch, fields_at, decay_lengths

    !> How a stretch's ends answer:
    !>
    !>     psi_a = -pa w_a + p1 w_b + faa M_a + fab M_b + turn_a      V_a = -pa M_a + p2 M_b - gaa w_a - gab w_b + shear_a
    !>     psi_b =  pb w_b - p2 w_a - fab M_a - fbb M_b - turn_b      V_b =  pb M_b - p1 M_a + gbb w_b + gab w_a - shear_b
    type :: stretch_link_type
        !> 1/length: without ground all are 1/L
        real(wp) :: pa, pb, p1, p2
        !> Flexibilities (rotation by a moment) and stiffnesses (force by a deflection); the latter vanish without ground
        real(wp) :: faa, fab, fbb, gaa, gab, gbb
        !> faa fbb - fab**2, gaa gbb - gab**2 and pa pb - p1 p2, formed without subtraction
        real(wp) :: df, dg, dh
        !> Sums that eliminations need, formed without subtraction: faa p2**2 + 2 pa p2 fab + pa**2 fbb
        real(wp) :: s1
        !> p2 fab + pa fbb
        real(wp) :: s2
        !> faa pb + p1 fab
        real(wp) :: s3
        !> pa (dh + fab gab) + faa p2 gab
        real(wp) :: s4
        !> pa pb + dh + fab gab
        real(wp) :: s5
    end type stretch_link_type

    !> Deflections and moments of the two ends of a stretch in equilibrium
    type :: stretch_ends_type
        real(wp) :: w_a = 0.0_wp, w_b = 0.0_wp, moment_a = 0.0_wp, moment_b = 0.0_wp
    end type stretch_ends_type

contains

    !> How many decay lengths a stretch is long: beta L, beta = (K/(4 EI))**(1/4), and more with shear. Where the modulus is
    !> linear or negative it is the caller's to cut stretches until this is 1 at most; others may be as long as they are
    elemental function decay_lengths(stretch) result(number)
        !> The stretch
        type(stretch_type), intent(in) :: stretch
        real(wp) :: number
        real(wp) :: k

        k = max(abs(stretch%modulus_a), abs(stretch%modulus_b))
        number = stretch%length*sqrt(k*stretch%shear_flexibility + 2*sqrt(k)*sqrt(stretch%flexibility))/2
    end function decay_lengths

    !> How the ends of a stretch answer to their deflections and moments
    pure subroutine condense_stretch(stretch, link)
        !> The stretch
        type(stretch_type), intent(in) :: stretch
        !> Its link
        type(stretch_link_type), intent(out) :: link

        real(wp) :: none(0)

        if (is_sloped(stretch)) then
            call condense_sloped(stretch, [stretch_load_type ::], link, none, none, none, none)
        else
            call condense_even(stretch, end_functions(stretch), link)
        end if
    end subroutine condense_stretch

    !> The same, and what loads make at its ends, for which the functions of the ends, or the series, are found once
    pure subroutine condense_loaded(stretch, loads, link, turn_a, turn_b, shear_a, shear_b)
        !> The stretch and some loads
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: loads(:)
        !> Its link
        type(stretch_link_type), intent(out) :: link
        !> As for load_stretch, shape (size(loads))
        real(wp), intent(out) :: turn_a(:), turn_b(:), shear_a(:), shear_b(:)
        type(end_functions_type) :: h
        integer :: k

        if (is_sloped(stretch)) then
            call condense_sloped(stretch, loads, link, turn_a, turn_b, shear_a, shear_b)
        else
            h = end_functions(stretch)
            call condense_even(stretch, h, link)
            do k = 1, size(loads)
                call load_even(stretch, h, loads(k), turn_a(k), turn_b(k), shear_a(k), shear_b(k))
            end do
        end if
    end subroutine condense_loaded

    !> How the ends answer where the modulus is constant
    pure subroutine condense_even(stretch, h, link)
        type(stretch_type), intent(in) :: stretch
        !> The functions of its ends
        type(end_functions_type), intent(in) :: h
        type(stretch_link_type), intent(out) :: link
        real(wp) :: l, k, f, d, bend, bend_b

        l = stretch%length
        k = l*stretch%modulus_a
        f = l*stretch%flexibility
        d = (h%c - h%e)*(h%c + h%e)
        link%pa = h%a/l
        link%p1 = h%b/l
        link%gaa = k*h%c
        link%gab = k*h%e
        link%dg = k**2*d
        link%dh = k*f*d
        bend = f*h%c
        bend_b = f*h%e
        ! With shear the flexibilities are bend + p/GA; where that would subtract, the sums below are arranged anew
        associate (p => link%pa, p1 => link%p1, g => stretch%shear_flexibility)
            link%faa = bend + g*p
            link%fab = bend_b - g*p1
            link%df = f**2*d + g*(2*(p*bend + p1*bend_b) + g*link%dh)
            link%s1 = bend*(p**2 + p1**2) + 2*p*p1*bend_b + g*p*link%dh
            link%s2 = p1*bend_b + p*bend + g*link%dh
            link%s4 = p*link%dh + link%gab*(p*bend_b + p1*bend)
            link%s5 = 2*link%dh + h%determinant/l**2
        end associate
        link%s3 = link%s2
        link%pb = link%pa
        link%p2 = link%p1
        link%fbb = link%faa
        link%gbb = link%gaa
    end subroutine condense_even

    !> The same where the modulus changes along the stretch
    pure subroutine condense_sloped(stretch, loads, link, turn_a, turn_b, shear_a, shear_b)
        !> As for condense_loaded
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: loads(:)
        type(stretch_link_type), intent(out) :: link
        real(wp), intent(out) :: turn_a(:), turn_b(:), shear_a(:), shear_b(:)
        type(half_type) :: a, b

        call half_link(stretch, loads, a, turn_a, shear_a)
        call half_link(mirrored(stretch), turned(loads), b, turn_b, shear_b)
        call link_of_halves(stretch%shear_flexibility, a, b, link)
    end subroutine condense_sloped

    !> The link from what its ends feel
    pure subroutine link_of_halves(g, a, b, link)
        !> 1/GA
        real(wp), intent(in) :: g
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
        link%faa = a%faa + g*a%pa
        link%fbb = b%faa + g*b%pa
        link%fab = a%fab - g*a%p1
        link%df = a%df + g*(a%faa*b%pa + b%faa*a%pa + a%fab*b%p1 + b%fab*a%p1 + g*a%dh)
        link%s1 = a%faa*b%p1**2 + a%pa*b%p1*(a%fab + b%fab) + a%pa**2*b%faa + g*a%pa*a%dh
        link%s2 = b%p1*a%fab + a%pa*b%faa + g*a%dh
        link%s3 = a%faa*b%pa + a%p1*b%fab + g*a%dh
        link%s4 = a%pa*a%dh + link%gab*(a%pa*b%fab + a%faa*b%p1)
        link%s5 = 2*a%dh + 1/a%determinant
    end subroutine link_of_halves

    !> Rotations and shears of the ends of a stretch that its loads make where deflections and moments are zero there
    pure subroutine load_stretch(stretch, load, turn_a, turn_b, shear_a, shear_b)
        !> The stretch and its load
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        !> turn_a, -turn_b: rotations; shear_a, -shear_b: shears
        real(wp), intent(out) :: turn_a, turn_b, shear_a, shear_b
        type(half_type) :: half
        real(wp) :: turn(2), shear(2)

        if (is_sloped(stretch)) then
            call half_link(stretch, [load], half, turn(1:1), shear(1:1))
            call half_link(mirrored(stretch), [turned(load)], half, turn(2:2), shear(2:2))
            turn_a = turn(1)
            turn_b = turn(2)
            shear_a = shear(1)
            shear_b = shear(2)
        else
            call load_even(stretch, end_functions(stretch), load, turn_a, turn_b, shear_a, shear_b)
        end if
    end subroutine load_stretch

    !> The same where the modulus is constant
    pure subroutine load_even(stretch, h, load, turn_a, turn_b, shear_a, shear_b)
        type(stretch_type), intent(in) :: stretch
        !> The functions of its ends
        type(end_functions_type), intent(in) :: h
        type(stretch_load_type), intent(in) :: load
        real(wp), intent(out) :: turn_a, turn_b, shear_a, shear_b
        real(wp) :: l, f, sum, turn, shear

        l = stretch%length
        f = l**2*stretch%flexibility
        sum = h%a_rest + h%b_rest
        turn = load%qc*h%bubble*f - load%kappa*((h%c + h%e) + stretch%modulus_a*l**2*stretch%shear_flexibility*sum)
        shear = 2*load%qc*sum + load%kappa*sum*(stretch%modulus_a*l**2)
        turn_a = l*((load%qa*h%a_rest + load%qb*h%b_rest)*f + turn)
        turn_b = l*((load%qb*h%a_rest + load%qa*h%b_rest)*f + turn)
        shear_a = l*((load%qa*h%c + load%qb*h%e) + shear)
        shear_b = l*((load%qb*h%c + load%qa*h%e) + shear)
    end subroutine load_even

    !> Fields anywhere in a stretch in equilibrium
    pure subroutine fields_at(stretch, load, ends, xi, w, psi, moment, shear)
        !> The stretch, its load, deflections and moments of its ends
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> The place, 0..1
        real(wp), intent(in) :: xi
        !> Deflection, rotation, moment, shear
        real(wp), intent(out) :: w, psi, moment, shear
        type(response_type) :: r
        type(decay_type) :: decay
        type(long_type) :: long
        type(stretch_ends_type) :: over
        real(wp) :: sigma, tau, eta, l, f, k, y(4)

        if (is_sloped(stretch)) then
            call sloped_fields(stretch, load, ends, xi, w, psi, moment, shear)
            return
        end if
        l = stretch%length
        f = stretch%flexibility
        k = stretch%modulus_a
        sigma = k*l**2*stretch%shear_flexibility
        tau = k*l**4*f
        eta = 1 - xi
        if (is_short(sigma, tau)) then
            ! The chord, and the answer to the load that is left: the ground's under the chord taken off
            r = short_response(sigma, tau, xi, eta)
            associate (e => ends, c => load)
                y(1) = eta*e%w_a + xi*e%w_b
                y(3) = eta*e%moment_a + xi*e%moment_b
                y(4) = (e%moment_b - e%moment_a)/l
                y(2) = (e%w_b - e%w_a)/l - stretch%shear_flexibility*y(4)
                call respond(stretch, r%even, r%even_slope, f*((e%moment_a + e%moment_b)/2) - c%kappa, &
                             (c%qa + c%qb)/2 - k*((e%w_a + e%w_b)/2), y)
                call respond(stretch, r%odd, r%odd_slope, f*((e%moment_b - e%moment_a)/2), &
                             (c%qb - c%qa)/2 - k*((e%w_b - e%w_a)/2), y)
                if (abs(c%qc) > 0.0_wp) call respond(stretch, r%bubble, r%bubble_slope, 0.0_wp, c%qc, y)
            end associate
        else
            long = long_of(sigma, tau)
            call long_response(long, xi, decay, r)
            over = ends
            y = 0.0_wp
            if (long%apart) then
                call respond(stretch, r%even, r%even_slope, -load%kappa, (load%qa + load%qb)/2, y)
                call respond(stretch, r%odd, r%odd_slope, 0.0_wp, (load%qb - load%qa)/2, y)
                call respond(stretch, r%bubble, r%bubble_slope, 0.0_wp, load%qc, y)
            else
                ! Far from the ends the ground bears the load where it stands
                y(1) = (load%qa*eta + load%qb*xi + load%qc*xi*eta)/k
                y(2) = (load%qb - load%qa + load%qc*(eta - xi))/(k*l)
                y(3) = (load%kappa + 2*load%qc/(k*l**2))/f
                over%w_a = ends%w_a - load%qa/k
                over%w_b = ends%w_b - load%qb/k
                over%moment_a = ends%moment_a - y(3)
                over%moment_b = ends%moment_b - y(3)
            end if
            call fade(stretch, decay%left, decay%left_slope, over%w_a, over%moment_a, y)
            call fade(stretch, decay%right, decay%right_slope, over%w_b, over%moment_b, y)
        end if
        w = y(1)
        psi = y(2)
        moment = y(3)
        shear = y(4)
    end subroutine fields_at

    !> Add the answer to a curvature and a load per length
    pure subroutine respond(stretch, value, slope, curvature, q, y)
        type(stretch_type), intent(in) :: stretch
        !> The answer and its slope
        type(triple_type), intent(in) :: value, slope
        real(wp), intent(in) :: curvature, q
        !> Deflection, rotation, moment, shear
        real(wp), intent(inout) :: y(4)
        real(wp) :: bent, pressed, f, k

        associate (l => stretch%length, g => stretch%shear_flexibility)
            f = l**2*stretch%flexibility
            k = l**2*stretch%modulus_a
            bent = l**2*curvature
            pressed = l**2*q
            y(1) = y(1) + (value%ga*bent + (g*value%ga - f*value%be)*pressed)
            y(2) = y(2) + (slope%al*bent - f*slope%be*pressed)/l
            y(3) = y(3) + (k*value%be*bent + value%ga*pressed)
            y(4) = y(4) + (k*slope%be*bent + slope%ga*pressed)/l
        end associate
    end subroutine respond

    !> Add what the deflection and moment of an end make. Rotations without shear go with w - M/GA
    pure subroutine fade(stretch, value, slope, w, moment, y)
        type(stretch_type), intent(in) :: stretch
        !> How they fade and the slope of it
        type(triple_type), intent(in) :: value, slope
        real(wp), intent(in) :: w, moment
        !> Deflection, rotation, moment, shear
        real(wp), intent(inout) :: y(4)
        real(wp) :: f, k

        associate (l => stretch%length, g => stretch%shear_flexibility)
            f = l**2*stretch%flexibility
            k = l**2*stretch%modulus_a
            y(1) = y(1) + (value%ga*w - f*value%be*moment)
            y(2) = y(2) + (slope%al*(w - g*moment) - f*slope%be*moment)/l
            y(3) = y(3) + (k*value%be*w + value%al*moment)
            y(4) = y(4) + (k*slope%be*w + slope%al*moment)/l
        end associate
    end subroutine fade

    !> Fields where the modulus changes along the stretch, from its nearer end
    pure subroutine sloped_fields(stretch, load, ends, xi, w, psi, moment, shear)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        real(wp), intent(in) :: xi
        real(wp), intent(out) :: w, psi, moment, shear
        type(half_type) :: h
        real(wp) :: y(4), v_a, v_b, by_load(2)

        v_a = ends%w_a - stretch%shear_flexibility*ends%moment_a
        v_b = ends%w_b - stretch%shear_flexibility*ends%moment_b
        if (xi <= 0.5_wp) then
            call half_link(stretch, [load], h, by_load(1:1), by_load(2:2))
            call advance(stretch, load, 0.0_wp, start_of(stretch, h, by_load, v_a, v_b, ends%moment_a, ends%moment_b), xi, y)
        else
            call half_link(mirrored(stretch), [turned(load)], h, by_load(1:1), by_load(2:2))
            call advance(mirrored(stretch), turned(load), 0.0_wp, &
                         start_of(stretch, h, by_load, v_b, v_a, ends%moment_b, ends%moment_a), 1 - xi, y)
            y = [y(1), -y(2), y(3), -y(4)]
        end if
        w = y(1) + stretch%shear_flexibility*y(3)
        psi = y(2)
        moment = y(3)
        shear = y(4)
    end subroutine sloped_fields

    !> v = w - M/GA, psi, M and V at the left end from v and M at both
    pure function start_of(stretch, half, by_load, v_a, v_b, moment_a, moment_b) result(y)
        type(stretch_type), intent(in) :: stretch
        type(half_type), intent(in) :: half
        !> Rotation and shear by the load
        real(wp), intent(in) :: by_load(2)
        real(wp), intent(in) :: v_a, v_b, moment_a, moment_b
        real(wp) :: y(4)

        y(1) = v_a
        y(2) = (half%p1*v_b - half%pa*v_a) + (half%faa*moment_a + half%fab*moment_b) + by_load(1)
        y(3) = moment_a
        ! The moment's factor in V_a beside p2 is pa + gaa/GA, as V knows w only
        y(4) = (half%p2*moment_b - (half%pa + stretch%shear_flexibility*half%gaa)*moment_a) &
            - (half%gaa*v_a + half%gab*v_b) + by_load(2)
    end function start_of

    !> A stretch seen from the other side
    pure function mirrored(stretch) result(other)
        type(stretch_type), intent(in) :: stretch
        type(stretch_type) :: other

        other = stretch
        other%modulus_a = stretch%modulus_b
        other%modulus_b = stretch%modulus_a
    end function mirrored

    !> Its load seen from there
    elemental function turned(load) result(other)
        type(stretch_load_type), intent(in) :: load
        type(stretch_load_type) :: other

        other = load
        other%qa = load%qb
        other%qb = load%qa
    end function turned

    !> Does the modulus change along the stretch
    pure function is_sloped(stretch) result(sloped)
        type(stretch_type), intent(in) :: stretch
        logical :: sloped

        sloped = abs(stretch%modulus_b - stretch%modulus_a) > 0.0_wp
    end function is_sloped

    !> The functions of the ends of a stretch of constant modulus
    pure function end_functions(stretch) result(h)
        type(stretch_type), intent(in) :: stretch
        type(end_functions_type) :: h
        real(wp) :: sigma, tau, square

        square = stretch%modulus_a*stretch%length**2
        sigma = square*stretch%shear_flexibility
        tau = square*stretch%length**2*stretch%flexibility
        if (is_short(sigma, tau)) then
            h = short_ends(sigma, tau)
        else
            h = long_ends(long_of(sigma, tau))
        end if
    end function end_functions

    !> Are power series good for a stretch: they are for every one on softening ground, that is cut short
    pure function is_short(sigma, tau) result(short)
        !> K L**2/GA and K L**4/EI
        real(wp), intent(in) :: sigma, tau
        logical :: short

        short = sigma <= 8.0_wp .and. tau <= 64.0_wp
    end function is_short

end module gapbeam_foundation
