!> Power series of the fields along a stretch on ground of linear modulus, and its link.
!>
!> v = w - M/GA instead of w leaves four equations without derivatives of loads: v' = psi, psi' = -M/EI + kappa, M' = V,
!> (1 + N/GA) V' = K (v + M/GA) + N (M/EI - kappa) - q. Their series converge everywhere (K is a polynomial); they are short where
!> beta L is 1 at most, and the caller cuts stretches to that. Links know the transverse force T = V + N w' in place of V.
!> N may be linear where GA is infinite: -N' psi beside. Where the beam tapers M/EI, M/GA and (1/GA)' M have series of their own
!> (gapbeam_foundation_stretch).
module gapbeam_foundation_taylor
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_taylor_terms
    use gapbeam_tolerances, only: taylor_tail
    use gapbeam_foundation_stretch, only: stretch_type, stretch_load_type, softness_type, is_of_one_stiffness, softest, &
        softness_around, soften, part_of_stretch, tension_at, greatest_tension
    implicit none
    private
    public :: stretch_type, stretch_load_type, half_type
    public :: half_link, half_of_transfer, transfer_of_forces, advance, expand, terms_of
    public :: mirrored, turned, is_sloped, stretched_shear, trace_of, determinant_of, transverse_of, shear_of
    public :: deflection_series

    !> What the left end feels of both, with v in place of w and signs as in stretch_link_type:
    !> psi_a = -pa v_a + p1 v_b + faa M_a + fab M_b + turn, V_a = -.. M_a + p2 M_b - gaa v_a - gab v_b + shear, where turn and shear
    !> are what loads make there
    type :: half_type
        real(wp) :: pa, p1, p2, faa, fab, gaa, gab
        !> Determinants of the flexibilities, of the stiffnesses and of the p, and 1/(p1 p2 + fab gab)
        real(wp) :: df, dg, dh, determinant
    end type half_type

contains

    !> What the left end feels; for the right one give the stretch and its loads mirrored
    pure subroutine half_link(stretch, loads, half, turn, shear)
        !> The stretch and some loads
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: loads(:)
        !> The left half of its link
        type(half_type), intent(out) :: half
        !> Rotation and shear by each of the loads, shape (size(loads))
        real(wp), intent(out) :: turn(:), shear(:)
        !> v, psi, M, V at the right end from each of them at the left end, and from the loads, terms by terms
        real(wp) :: c(4 + size(loads), 4, 0:most_taylor_terms), start(4 + size(loads), 4)
        integer :: n, i, j

        start = 0.0_wp
        do j = 1, 4
            start(j, j) = 1.0_wp
        end do
        n = terms_of(stretch, 1.0_wp)
        call expand(stretch, loads, 0.0_wp, start, 1.0_wp, n, c)
        start = c(:, :, n)
        do i = n - 1, 0, -1
            start = start + c(:, :, i)
        end do
        call half_of_transfer(transfer_of_forces(stretch, transpose(start)), half, turn, shear)
    end subroutine half_link

    !> What the right end gets of the left one, and of loads, with the transverse force at both in place of the shear
    pure function transfer_of_forces(stretch, t) result(found)
        type(stretch_type), intent(in) :: stretch
        !> v, psi, M, V at the right end from each of them at the left end, and from the loads, shape (4, at least 4)
        real(wp), intent(in) :: t(:, :)
        real(wp) :: found(size(t, 1), size(t, 2))

        found(:, :) = t
        if (.not. abs(greatest_tension(stretch)) > 0.0_wp) return
        ! At a given transverse force a rotation of 1 brings a shear of -N/s along
        found(:, 4) = t(:, 4)/stretched_shear(stretch)
        found(:, 2) = t(:, 2) - stretch%tension*found(:, 4)
        found(4, :) = stretched_shear(stretch)*found(4, :) + tension_at(stretch, 1.0_wp)*found(2, :)
        ! Without ground deflections make no force, and the transverse force is that of the loads, not even by rounding another
        if (.not. any(abs(t(2:4, 1)) > 0.0_wp)) found(4, :4) = [0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
    end function transfer_of_forces

    !> The same from what the right end gets of the left one
    pure subroutine half_of_transfer(t, half, turn, shear)
        !> v, psi, M, T at the right end from each of them at the left end, and from the loads, shape (4, 4 + number of loads)
        real(wp), intent(in) :: t(:, :)
        !> As for half_link
        type(half_type), intent(out) :: half
        real(wp), intent(out) :: turn(:), shear(:)
        real(wp) :: d

        d = t(1, 2)*t(3, 4) - t(1, 4)*t(3, 2)
        half%determinant = d
        half%p1 = t(3, 4)/d
        half%p2 = t(1, 2)/d
        half%fab = -t(1, 4)/d
        half%gab = t(3, 2)/d
        half%pa = half%p1*t(1, 1) + half%fab*t(3, 1)
        half%faa = -(half%p1*t(1, 3) + half%fab*t(3, 3))
        half%gaa = half%p2*t(3, 1) - half%gab*t(1, 1)
        ! Minors of t: differences of these products cancel less than differences of the products of what they make
        half%df = (t(1, 3)*t(2, 4) - t(1, 4)*t(2, 3))/d
        half%dg = (t(3, 1)*t(4, 2) - t(3, 2)*t(4, 1))/d
        half%dh = (t(3, 4)*t(2, 1) - t(3, 1)*t(2, 4))/d
        turn(:) = -(half%p1*t(1, 5:) + half%fab*t(3, 5:))
        shear(:) = half%gab*t(1, 5:) - half%p2*t(3, 5:)
    end subroutine half_of_transfer

    !> Fields at one place from those at another
    pure subroutine advance(stretch, load, xi, start, step, values)
        !> The stretch and its load
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        !> The place, 0..1
        real(wp), intent(in) :: xi
        !> v = w - M/GA, psi, M, V there
        real(wp), intent(in) :: start(4)
        !> From that place to the other one, in parts of the length
        real(wp), intent(in) :: step
        !> The same at the other place
        real(wp), intent(out) :: values(4)
        real(wp) :: c(1, 4, 0:most_taylor_terms)
        integer :: n, i

        n = terms_of(stretch, step)
        call expand(stretch, [load], xi, reshape(start, [1, 4]), step, n, c)
        values = c(1, :, n)
        do i = n - 1, 0, -1
            values = values + c(1, :, i)
        end do
    end subroutine advance

    !> Fields around a place as polynomials
    pure subroutine expand(stretch, loads, xi, start, step, n, c)
        !> The stretch, and the loads of the last cases
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: loads(:)
        !> The place, 0..1
        real(wp), intent(in) :: xi
        !> v = w - M/GA, psi, M, V there, shape (cases, 4); all cases but the last ones have no load
        real(wp), intent(in), contiguous :: start(:, :)
        !> Unit of the polynomials' variable, in parts of the length
        real(wp), intent(in) :: step
        !> Degree
        integer, intent(in) :: n
        !> Coefficients of v, psi, M, V, shape (cases, 4, 0:at least n)
        real(wp), intent(out), contiguous :: c(:, :, 0:)
        real(wp) :: q(size(loads), 0:2), bend(size(loads), 0:1), k0, k1, n0, n1, h, part, slack
        real(wp), dimension(size(start, 1), 0:n) :: w, bent, slid, shifted
        type(softness_type) :: softness
        integer :: i, first

        associate (s => stretch, p => loads, eta => 1 - xi)
            h = s%length*step
            k0 = s%modulus_a*eta + s%modulus_b*xi
            k1 = (s%modulus_b - s%modulus_a)*step
            q(:, 0) = p%qa*eta + p%qb*xi + p%qc*xi*eta
            q(:, 1) = (p%qb - p%qa + p%qc*(eta - xi))*step
            q(:, 2) = -p%qc*step**2
            first = size(start, 1) - size(loads) + 1
            slack = 1/stretched_shear(s)
            k0 = k0*slack
            k1 = k1*slack
            n0 = tension_at(s, xi)*slack
            n1 = s%tension_change*step*slack
            bend(:, 0) = p%kappa + xi*p%rise
            bend(:, 1) = step*p%rise
            q(:, 0) = q(:, 0)*slack + n0*bend(:, 0)
            q(:, 1) = q(:, 1)*slack + (n0*bend(:, 1) + n1*bend(:, 0))
            q(:, 2) = q(:, 2)*slack + n1*bend(:, 1)
            softness = softness_around(s, xi, step)
            c(:, :, 0) = start
            do i = 0, n - 1
                part = h/(i + 1)
                call soften(softness, i, c(:, 3, i), bent, slid, shifted)
                w(:, i) = c(:, 1, i) + slid(:, i)
                c(:, 1, i + 1) = part*c(:, 2, i)
                if (s%power(2) > 0) c(:, 1, i + 1) = c(:, 1, i + 1) - shifted(:, i)/(i + 1)
                c(:, 2, i + 1) = -part*bent(:, i)
                c(:, 3, i + 1) = part*c(:, 4, i)
                c(:, 4, i + 1) = part*k0*w(:, i)
                if (i > 0) c(:, 4, i + 1) = c(:, 4, i + 1) + part*k1*w(:, i - 1)
                if (abs(n0) > 0.0_wp) c(:, 4, i + 1) = c(:, 4, i + 1) + part*n0*bent(:, i)
                if (abs(n1) > 0.0_wp) then
                    ! Of (N psi)' the part N' psi, and N psi' as N changes
                    c(:, 4, i + 1) = c(:, 4, i + 1) - (n1/(i + 1))*c(:, 2, i)
                    if (i > 0) c(:, 4, i + 1) = c(:, 4, i + 1) + part*n1*bent(:, i - 1)
                end if
                if (i <= 1) c(first:, 2, i + 1) = c(first:, 2, i + 1) + part*bend(:, i)
                if (i <= 2) c(first:, 4, i + 1) = c(first:, 4, i + 1) - part*q(:, i)
            end do
        end associate
    end subroutine expand

    !> Series of the deflection w = v + M/GA from those of the fields
    pure function deflection_series(stretch, xi, step, c) result(w)
        !> As for expand
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: xi, step
        !> Of v, psi, M, V, shape (4, 0:n)
        real(wp), intent(in) :: c(:, 0:)
        real(wp) :: w(0:ubound(c, 2))
        real(wp), dimension(1, 0:ubound(c, 2)) :: bent, slid, shifted
        type(softness_type) :: softness
        integer :: i

        softness = softness_around(stretch, xi, step)
        do i = 0, ubound(c, 2)
            call soften(softness, i, c(3:3, i), bent, slid, shifted)
        end do
        w(:) = c(1, :) + slid(1, :)
    end function deflection_series

    !> How many terms it takes until the next ones are below rounding
    pure function terms_of(stretch, step) result(n)
        type(stretch_type), intent(in) :: stretch
        !> Distance in parts of its length
        real(wp), intent(in) :: step
        integer :: n
        real(wp) :: rate, term, k, growth(2)
        integer :: i, number

        k = max(abs(stretch%modulus_a), abs(stretch%modulus_b))
        rate = stretch%length*abs(step)*sqrt(abs(trace_of(stretch, k)) + sqrt(determinant_of(stretch, k)))
        n = 1
        term = rate
        do while (term > taylor_tail .and. n < most_taylor_terms)
            n = n + 1
            term = term*rate/n
        end do
        ! A modulus that changes gives five terms in place of four, with shear three in place of two; a load begins late
        if (abs(stretch%modulus_b - stretch%modulus_a) > 0.0_wp) n = n + n/merge(2, 4, stretch%shear_flexibility > 0.0_wp)
        if (abs(stretch%tension_change) > 0.0_wp) n = n + n/2
        n = min(n + 6, most_taylor_terms)
        if (is_of_one_stiffness(stretch)) return
        ! Beside them those of the reciprocal of a power of the depth
        growth(:) = abs(stretch%taper)*step/min(1.0_wp, 1 + stretch%taper)
        number = 0
        do i = 1, 2
            if (stretch%power(i) == 0) cycle
            k = 0.0_wp
            term = 1.0_wp
            do while (term > taylor_tail .and. k < most_taylor_terms)
                k = k + 1
                term = term*growth(i)*(k + stretch%power(i) - 1)/k
            end do
            number = max(number, nint(k))
        end do
        n = min(n + number, most_taylor_terms)
    end function terms_of

    !> 1 + N/GA: the shear force is normal to the deflected axis (Engesser 1891), so T = (1 + N/GA) V + N psi
    elemental function stretched_shear(stretch) result(factor)
        type(stretch_type), intent(in) :: stretch
        real(wp) :: factor

        factor = 1 + stretch%tension*stretch%shear_flexibility
    end function stretched_shear

    !> Trace of the matrix A of y'' = A y, y = (w, M), with the rows (K/GA, -1/EI) and (K, N/EI), both over 1 + N/GA; of a tapered
    !> stretch where it is softest
    elemental function trace_of(stretch, modulus) result(trace)
        type(stretch_type), intent(in) :: stretch
        !> K
        real(wp), intent(in) :: modulus
        real(wp) :: trace, soft(2)

        soft(:) = softest(stretch)
        trace = (modulus*soft(2) + greatest_tension(stretch)*soft(1))/stretched_shear(stretch)
    end function trace_of

    !> Its determinant
    elemental function determinant_of(stretch, modulus) result(determinant)
        !> As for trace_of
        type(stretch_type), intent(in) :: stretch
        real(wp), intent(in) :: modulus
        real(wp) :: determinant, soft(2)

        soft(:) = softest(stretch)
        determinant = modulus*soft(1)/stretched_shear(stretch)
    end function determinant_of

    !> The transverse force T = V + N w', which loads and reactions balance
    elemental function transverse_of(stretch, xi, rotation, shear) result(force)
        type(stretch_type), intent(in) :: stretch
        !> The place, 0..1; psi and V there
        real(wp), intent(in) :: xi, rotation, shear
        real(wp) :: force

        force = stretched_shear(stretch)*shear + tension_at(stretch, xi)*rotation
    end function transverse_of

    !> The shear V = M' from the transverse force
    elemental function shear_of(stretch, xi, rotation, force) result(shear)
        type(stretch_type), intent(in) :: stretch
        !> The place, 0..1; psi and T there
        real(wp), intent(in) :: xi, rotation, force
        real(wp) :: shear

        shear = (force - tension_at(stretch, xi)*rotation)/stretched_shear(stretch)
    end function shear_of

    !> A stretch seen from the other side
    pure function mirrored(stretch) result(other)
        type(stretch_type), intent(in) :: stretch
        type(stretch_type) :: other

        other = part_of_stretch(stretch, [1.0_wp, 0.0_wp])
        other%length = stretch%length
    end function mirrored

    !> Its load seen from there
    elemental function turned(load) result(other)
        type(stretch_load_type), intent(in) :: load
        type(stretch_load_type) :: other

        other = load
        other%qa = load%qb
        other%qb = load%qa
        other%kappa = load%kappa + load%rise
        other%rise = -load%rise
    end function turned

    !> Does the modulus, a stiffness of the beam, or its axial force change along the stretch
    pure function is_sloped(stretch) result(sloped)
        type(stretch_type), intent(in) :: stretch
        logical :: sloped

        sloped = abs(stretch%modulus_b - stretch%modulus_a) > 0.0_wp .or. abs(stretch%tension_change) > 0.0_wp &
            .or. .not. is_of_one_stiffness(stretch)
    end function is_sloped

end module gapbeam_foundation_taylor
