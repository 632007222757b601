!> Laws of the ground as power series of the displacement: force and slope of a layer along a stretch.
!>
!> The recurrences of power-series arithmetic (Moore 1966; Jorba and Zou 2005) give term by term what a series makes of another
!> one; parameters are linear along the stretch.
module gapbeam_law_series
    use gapbeam_kinds, only: wp, dp
    use gapbeam_tolerances, only: same_parameters, tanh_is_one
    use gapbeam_laws, only: law_hardening, law_hyperbolic, law_tanh, law_cubic, law_polyline, parameters_of_law
    implicit none
    private
    public :: curve_type, law_series_type, order, order_in_double, parameters_of_curve
    public :: begin_series, next_term, force_scale, slope_scale, longest_step

    !> Those of laws, or of a piece of a polyline the displacement and force at which it begins, and how far both go from there
    integer, parameter :: parameters_of_curve = parameters_of_law + 1
    !> Degree of all series: with as many terms as digits need that shrink by e**2 each, the fewest operations for a length
    integer, parameter :: order = ceiling(digits(1.0_wp)*0.35_wp) + 3
    !> The same with which double precision gives its own digits: terms of higher degree are below its rounding beside the whole
    integer, parameter :: order_in_double = ceiling(digits(1.0_dp)*0.35_dp)

    !> A layer of ground under a stretch, on a piece of its law that is a curve
    type :: curve_type
        !> The law, and 1 for a layer that pushes up, -1 for one that pushes down
        integer :: law = law_tanh, side = 1
        !> Its parameters at the left and right end of the stretch, linear in between
        real(wp) :: parameter_a(parameters_of_curve) = 0.0_wp, parameter_b(parameters_of_curve) = 0.0_wp
        !> Deflection at which it begins to act at the two ends, linear in between
        real(wp) :: contact_a = 0.0_wp, contact_b = 0.0_wp
    end type curve_type

    !> Series around a place in t, 0..1 along the way that is still to go
    type :: law_series_type
        integer :: law = law_tanh
        !> Parameters: value and change
        real(wp) :: p(parameters_of_curve, 0:1) = 0.0_wp
        !> Is stiffness/limit the same everywhere, and which then
        logical :: keeps_ratio = .false.
        real(wp) :: ratio = 0.0_wp
        !> Sign of the displacement: before contact a law goes on as its mirror image
        real(wp) :: way = 1.0_wp
        !> Displacement past the contact; force and slope
        real(wp) :: u(0:order) = 0.0_wp, r(0:order) = 0.0_wp, k(0:order) = 0.0_wp
        !> What they are made of
        real(wp) :: z(0:order) = 0.0_wp, a(0:order) = 0.0_wp, b(0:order) = 0.0_wp
        !> Of z' times t
        real(wp) :: dz(0:order) = 0.0_wp
    end type law_series_type

contains

    !> Begin the series at a place
    pure subroutine begin_series(curve, xi, way, negative, series)
        !> The layer
        type(curve_type), intent(in) :: curve
        !> The place, 0..1 along the stretch, and what is still to go, of either sign
        real(wp), intent(in) :: xi, way
        !> Is the displacement below 0 there, which it is only while the zones of contact are still sought
        logical, intent(in) :: negative
        !> Without terms
        type(law_series_type), intent(out) :: series
        real(wp) :: cross(2)

        series%law = curve%law
        series%p(:, 0) = curve%parameter_a*(1 - xi) + curve%parameter_b*xi
        series%p(:, 1) = (curve%parameter_b - curve%parameter_a)*way
        series%way = merge(-1.0_wp, 1.0_wp, negative)
        if (curve%law == law_cubic) return
        associate (a => curve%parameter_a, b => curve%parameter_b)
            cross = [a(1)*b(2), b(1)*a(2)]
            if (curve%law == law_polyline) cross = [a(3)*b(4), b(3)*a(4)]
            series%keeps_ratio = abs(cross(1) - cross(2)) <= same_parameters*maxval(abs(cross))
            if (.not. series%keeps_ratio) return
            if (curve%law == law_polyline) then
                series%ratio = a(4)/a(3)
            else if (a(1) + a(2) > b(1) + b(2)) then
                series%ratio = ratio_of(curve%law, a)
            else
                series%ratio = ratio_of(curve%law, b)
            end if
        end associate
    end subroutine begin_series

    !> Stiffness/limit, and the other way round where a law needs that
    pure function ratio_of(law, p) result(ratio)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        real(wp) :: ratio

        if (law == law_hardening) then
            ratio = p(2)/p(1)
        else
            ratio = p(1)/p(2)
        end if
    end function ratio_of

    !> Force and slope of the next degree; the displacement must be there up to it
    pure subroutine next_term(s, n)
        type(law_series_type), intent(inout) :: s
        !> The degree, from 0
        integer, intent(in) :: n
        real(wp) :: exponential

        select case (s%law)
        case (law_tanh)
            ! r = limit T, T = tanh z, z = stiffness u/limit, T' = (1 - T**2) z'
            s%z(n) = share(s, n)
            if (n == 0) then
                s%a(0) = tanh(s%z(0))
                exponential = exp(-2*abs(s%z(0)))
                s%b(0) = 4*exponential/(1 + exponential)**2
                ! As far as longest_step goes
                if (abs(s%z(0)) > tanh_is_one + 1) s%b(0) = 0.0_wp
            else if (s%b(0) > 0.0_wp) then
                s%dz(n) = n*s%z(n)
                s%a(n) = product_term(s%dz(1:), s%b, n - 1)/n
                s%b(n) = -square_term(s%a, n)
            end if
            s%r(n) = linear_times(s%p(2, :), s%a, n)
            s%k(n) = linear_times(s%p(1, :), s%b, n)
        case (law_hyperbolic)
            ! r = b u, b = stiffness/a, a = 1 + stiffness |u|/limit, slope = b/a
            s%z(n) = share(s, n)
            if (n == 0) then
                if (s%way*s%z(0) < -0.5_wp) s%way = -s%way
                s%a(0) = 1 + s%way*s%z(0)
            else
                s%a(n) = s%way*s%z(n)
            end if
            s%b(n) = quotient(linear_term(s%p(1, :), n), s%b, s%a, n)
            s%r(n) = product_term(s%b, s%u, n)
            s%k(n) = quotient(s%b(n), s%k, s%a, n)
        case (law_cubic)
            s%a(n) = square_term(s%u, n)
            s%b(n) = product_term(s%u, s%a, n)
            s%r(n) = linear_times(s%p(1, :), s%u, n) + s%way*linear_times(s%p(2, :), s%a, n) + linear_times(s%p(3, :), s%b, n)
            s%k(n) = linear_term(s%p(1, :), n) + 2*s%way*linear_times(s%p(2, :), s%u, n) + 3*linear_times(s%p(3, :), s%a, n)
        case (law_polyline)
            ! r = force + z (u - displacement), z = rise/way
            if (s%keeps_ratio) then
                s%z(n) = merge(s%ratio, 0.0_wp, n == 0)
            else
                s%z(n) = over_linear(linear_term(s%p(4, :), n), s%z, s%p(3, :), n)
            end if
            s%r(n) = product_term(s%z, s%u, n) + s%way*(linear_term(s%p(2, :), n) - linear_times(s%p(1, :), s%z, n))
            s%k(n) = s%z(n)
        case default
            ! The second piece of a law that hardens: r = slope u + limit - slope (limit/stiffness)
            if (s%keeps_ratio) then
                s%z(n) = merge(s%ratio, 0.0_wp, n == 0)
            else
                s%z(n) = over_linear(linear_term(s%p(2, :), n), s%z, s%p(1, :), n)
            end if
            s%r(n) = linear_times(s%p(3, :), s%u, n) + s%way*(linear_term(s%p(2, :), n) - linear_times(s%p(3, :), s%z, n))
            s%k(n) = linear_term(s%p(3, :), n)
        end select
    end subroutine next_term

    !> Term of stiffness u/limit
    pure function share(s, n) result(term)
        type(law_series_type), intent(in) :: s
        integer, intent(in) :: n
        real(wp) :: term

        if (s%keeps_ratio) then
            term = s%ratio*s%u(n)
        else
            term = over_linear(linear_times(s%p(1, :), s%u, n), s%z, s%p(2, :), n)
        end if
    end function share

    !> Size of the slope along the way
    pure function slope_scale(s) result(scale)
        !> With three terms of the displacement
        type(law_series_type), intent(in) :: s
        real(wp) :: scale, most(parameters_of_curve), u

        most = max(abs(s%p(:, 0)), abs(s%p(:, 0) + s%p(:, 1)))
        u = size_of_way(s)
        select case (s%law)
        case (law_cubic)
            scale = most(1) + u*(2*most(2) + 3*u*most(3))
        case (law_hardening)
            scale = most(3)
        case (law_polyline)
            scale = most(4)/min(s%p(3, 0), s%p(3, 0) + s%p(3, 1))
        case default
            scale = most(1)
        end select
    end function slope_scale

    !> Size of the force along the way
    pure function force_scale(s) result(scale)
        !> As for slope_scale
        type(law_series_type), intent(in) :: s
        real(wp) :: scale

        scale = slope_scale(s)*size_of_way(s)
        if (s%law == law_cubic) return
        associate (limit => max(abs(s%p(2, 0)), abs(s%p(2, 0) + s%p(2, 1))))
            if (s%law == law_hardening .or. s%law == law_polyline) then
                scale = scale + limit
            else
                scale = min(scale, limit)
            end if
        end associate
    end function force_scale

    !> Size of the displacement along the way
    pure function size_of_way(s) result(u)
        type(law_series_type), intent(in) :: s
        real(wp) :: u

        u = sum(abs(s%u(0:3)))
        if (.not. u > 0.0_wp) u = sum(abs(s%u))
    end function size_of_way

    !> How far the series go, as a part of the way: for what is divided by, and for a tanh that is 1 to rounding, whose terms do not
    !> tell where it will be less
    pure function longest_step(s) result(step)
        type(law_series_type), intent(in) :: s
        real(wp) :: step, way
        integer :: divisor

        step = 1.0_wp
        if (s%law == law_tanh) then
            way = sum(abs(s%z(1:3)))
            if (abs(s%z(0)) > tanh_is_one .and. way > abs(s%z(0)) - tanh_is_one) then
                step = max(1.0_wp, abs(s%z(0)) - tanh_is_one)/max(1.0_wp, way)
            end if
        end if
        if (s%keeps_ratio .or. s%law == law_cubic) return
        divisor = merge(1, 2, s%law == law_hardening)
        if (s%law == law_polyline) divisor = 3
        if (abs(s%p(divisor, 1)) > 2*s%p(divisor, 0)) step = min(step, s%p(divisor, 0)/(2*abs(s%p(divisor, 1))))
    end function longest_step

    !> Term of a product of two series; of those that are below the rounding of double precision its digits are enough
    pure function product_term(a, b, n) result(term)
        real(wp), intent(in) :: a(0:), b(0:)
        integer, intent(in) :: n
        real(wp) :: term

        if (n <= order_in_double .or. wp == dp) then
            term = dot_product(a(0:n), b(n:0:-1))
        else
            term = real(dot_product(real(a(0:n), dp), real(b(n:0:-1), dp)), wp)
        end if
    end function product_term

    !> Term of the square of a series: what is there twice is reckoned once
    pure function square_term(a, n) result(term)
        real(wp), intent(in) :: a(0:)
        integer, intent(in) :: n
        real(wp) :: term
        integer :: pairs

        pairs = (n + 1)/2
        if (n > order_in_double .and. wp /= dp) then
            term = product_term(a, a, n)
        else
            term = 2*dot_product(a(0:pairs - 1), a(n:n - pairs + 1:-1))
            if (2*pairs == n) term = term + a(pairs)**2
        end if
    end function square_term

    !> Term of a quotient, the terms before known
    pure function quotient(numerator, terms, divisor, n) result(term)
        !> Term of the numerator; quotient and divisor
        real(wp), intent(in) :: numerator, terms(0:), divisor(0:)
        integer, intent(in) :: n
        real(wp) :: term

        term = (numerator - product_term(divisor(1:), terms, n - 1))/divisor(0)
    end function quotient

    !> Term of what is linear
    pure function linear_term(p, n) result(term)
        real(wp), intent(in) :: p(0:)
        integer, intent(in) :: n
        real(wp) :: term

        term = 0.0_wp
        if (n <= 1) term = p(n)
    end function linear_term

    !> Term of a series times what is linear
    pure function linear_times(p, a, n) result(term)
        real(wp), intent(in) :: p(0:), a(0:)
        integer, intent(in) :: n
        real(wp) :: term

        term = p(0)*a(n)
        if (n > 0) term = term + p(1)*a(n - 1)
    end function linear_times

    !> Term of a quotient by what is linear, the term before known
    pure function over_linear(numerator, terms, p, n) result(term)
        real(wp), intent(in) :: numerator, terms(0:), p(0:)
        integer, intent(in) :: n
        real(wp) :: term

        term = numerator
        if (n > 0) term = term - p(1)*terms(n - 1)
        term = term/p(0)
    end function over_linear

end module gapbeam_law_series
