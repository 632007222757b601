!> Long stretches on elastic ground of constant modulus, by exponentials.
!>
!> X has the eigenvalues p + d and p - d, of which d may be real or imaginary: without shear p = beta L, d = i beta L
!> (Hetenyi 1946). Near to each other, functions of X go by p and d**2; well apart, by quotients of differences. Every
!> exponential falls, so nothing overflows.
module gapbeam_foundation_long
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: no_decay_length
    use gapbeam_foundation_series, only: end_functions_type, triple_type, response_type, short_ends, short_of, short_response
    implicit none
    private
    public :: long_type, long_of, long_ends, long_response, decay_type

    !> Eigenvalues of X
    type :: long_type
        !> Trace and determinant of X**2
        real(wp) :: sigma, tau
        !> Mean of the eigenvalues, square of half their difference
        real(wp) :: p, d2
        !> Are they well apart
        logical :: apart
        !> Then they are these, the greater one first
        real(wp) :: x(2)
    end type long_type

    !> sinh(X xi)/sinh X as functions of xi, for the right end, and of 1 - xi, for the left one; their slopes in xi
    type :: decay_type
        type(triple_type) :: left, right, left_slope, right_slope
    end type decay_type

    !> Hyperbolic functions of p s and d s times exp(-p s)
    type :: scaled_type
        !> sinh(p s)/p, cosh(p s), sinh(d s)/d, cosh(d s)
        real(wp) :: sine_p, cosine_p, sine_d, cosine_d
    end type scaled_type

contains

    !> Eigenvalues of a long stretch
    pure function long_of(sigma, tau) result(long)
        !> K L**2/GA and K L**4/EI, none negative and not both small
        real(wp), intent(in) :: sigma, tau
        type(long_type) :: long
        real(wp) :: root, d

        root = sqrt(tau)
        long%sigma = sigma
        long%tau = tau
        long%p = sqrt(sigma + 2*root)/2
        long%d2 = (sigma - 2*root)/4
        long%x = 0.0_wp
        ! One is twice the other at least
        long%apart = long%d2 > long%p**2/9
        if (long%apart) then
            d = sqrt(long%d2)
            long%x(1) = long%p + d
            long%x(2) = root/long%x(1)
        end if
    end function long_of

    !> The functions of the ends
    pure function long_ends(long) result(ends)
        !> The stretch
        type(long_type), intent(in) :: long
        type(end_functions_type) :: ends, one(2)
        type(scaled_type) :: s
        real(wp) :: n, root, difference, square(2)
        integer :: i

        if (long%apart) then
            do i = 1, 2
                one(i) = scalar_ends(long%x(i))
            end do
            square = long%x**2
            difference = square(1) - square(2)
            ends%c = (square(1)*one(1)%c - square(2)*one(2)%c)/difference
            if (square(2) < 8.0_wp) then
                ends%e = (square(1)*one(1)%e - square(2)*one(2)%e)/difference
            else
                ends%e = (one(2)%b - one(1)%b)/difference
            end if
            ends%a_rest = (one(2)%c - one(1)%c)/difference
            ends%b_rest = (one(2)%e - one(1)%e)/difference
            ends%bubble = (one(2)%bubble - one(1)%bubble)/difference
            ends%a = 1 + long%tau*ends%a_rest
            ends%b = one(2)%b + square(2)*ends%e
            ends%determinant = one(1)%b*one(2)%b
            return
        end if
        s = scaled_at(long, 1.0_wp)
        root = sqrt(long%tau)
        n = (long%p*s%sine_p)**2 - long%d2*s%sine_d**2
        ends%a = root*(s%sine_p*s%cosine_p + s%sine_d*s%cosine_d)/(2*n)
        ends%b = root*(s%cosine_p*s%sine_d + s%sine_p*s%cosine_d)/(2*n)
        ends%c = (s%sine_p*s%cosine_p - s%sine_d*s%cosine_d)/(2*n)
        ends%e = (s%cosine_p*s%sine_d - s%sine_p*s%cosine_d)/(2*n)
        ends%a_rest = (ends%a - 1)/long%tau
        ends%b_rest = (1 - ends%b)/long%tau
        ends%bubble = (1 - 2*((ends%c + ends%e) + long%sigma*(ends%a_rest + ends%b_rest)))/long%tau
        ends%determinant = root*exp(-2*long%p)/n
    end function long_ends

    !> The same of one eigenvalue. Of bubble 1/12 less the answer is left, for the sake of the differences
    pure function scalar_ends(x) result(ends)
        real(wp), intent(in) :: x
        type(end_functions_type) :: ends
        real(wp) :: square, small

        square = x**2
        if (square <= 8.0_wp) then
            ends = short_ends(square, 0.0_wp)
            ends%b = 1 - square*ends%e
            ends%bubble = -square*ends%bubble
        else
            small = exp(-2*x)
            ends%a = x*(1 + small)/(1 - small)
            ends%b = 2*x*exp(-x)/(1 - small)
            ends%c = (ends%a - 1)/square
            ends%e = (1 - ends%b)/square
            ends%a_rest = 0.0_wp
            ends%b_rest = 0.0_wp
            ends%bubble = (1 - 2*(ends%c + ends%e))/square - 1.0_wp/12
            ends%determinant = ends%b
        end if
    end function scalar_ends

    !> How the ends decay into the stretch, and where the eigenvalues are apart the answers to loads
    pure subroutine long_response(long, xi, decay, response)
        !> The stretch, and the place 0..1
        type(long_type), intent(in) :: long
        real(wp), intent(in) :: xi
        !> Decay of the deflections and moments of the ends
        type(decay_type), intent(out) :: decay
        !> Answers to loads; all zero where the eigenvalues are not apart
        type(response_type), intent(out) :: response
        type(scaled_type) :: from_left, from_right, over_left, over_right, whole
        type(triple_type) :: zero
        real(wp) :: eta, n, value(2, 5), slope(2, 5), answers(5), rises(5)
        integer :: i

        eta = 1 - xi
        if (long%apart) then
            do i = 1, 2
                call scalar_response(long%x(i), xi, eta, answers, rises)
                value(i, :) = answers
                slope(i, :) = rises
            end do
            decay%left = quotient(long, value(:, 1))
            decay%right = quotient(long, value(:, 2))
            response%even = quotient(long, value(:, 3))
            response%odd = quotient(long, value(:, 4))
            response%bubble = quotient(long, value(:, 5))
            decay%left_slope = quotient(long, slope(:, 1))
            decay%right_slope = quotient(long, slope(:, 2))
            response%even_slope = quotient(long, slope(:, 3))
            response%odd_slope = quotient(long, slope(:, 4))
            response%bubble_slope = quotient(long, slope(:, 5))
            return
        end if
        whole = scaled_at(long, 1.0_wp)
        n = (long%p*whole%sine_p)**2 - long%d2*whole%sine_d**2
        from_left = scaled_at(long, xi)
        from_right = scaled_at(long, eta)
        over_left = scaled_at(long, 1 + xi)
        over_right = scaled_at(long, 1 + eta)
        call decay_of(long, n, from_right, over_left, 1.0_wp, decay%right, decay%right_slope)
        call decay_of(long, n, from_left, over_right, -1.0_wp, decay%left, decay%left_slope)
        zero = triple_type(0.0_wp, 0.0_wp, 0.0_wp)
        response = response_type(zero, zero, zero, zero, zero, zero)
    end subroutine long_response

    !> sinh(X s)/sinh X and its slope from the functions at 1 - s and 1 + s
    pure subroutine decay_of(long, n, near, far, direction, value, slope)
        type(long_type), intent(in) :: long
        !> sinh(p)**2 - sinh(d)**2, times exp(-2 p)
        real(wp), intent(in) :: n
        type(scaled_type), intent(in) :: near, far
        !> 1 or -1: of the slope
        real(wp), intent(in) :: direction
        type(triple_type), intent(out) :: value, slope
        real(wp) :: mean, be

        be = (near%sine_p*far%sine_d - far%sine_p*near%sine_d)/(4*n)
        mean = (far%cosine_p*near%cosine_d - near%cosine_p*far%cosine_d)/(2*n)
        value = triple_type(mean - be*long%sigma/2, be, mean + be*long%sigma/2)
        be = direction*((near%sine_p*far%cosine_d - near%cosine_p*far%sine_d) &
                        + (far%sine_p*near%cosine_d - far%cosine_p*near%sine_d))/(4*n)
        mean = direction*(long%p**2*(far%sine_p*near%cosine_d + near%sine_p*far%cosine_d) &
                          - long%d2*(far%cosine_p*near%sine_d + near%cosine_p*far%sine_d))/(2*n)
        slope = triple_type(mean - be*long%sigma/2, be, mean + be*long%sigma/2)
    end subroutine decay_of

    !> Hyperbolic functions at a distance s
    pure function scaled_at(long, s) result(scaled)
        type(long_type), intent(in) :: long
        real(wp), intent(in) :: s
        type(scaled_type) :: scaled
        real(wp) :: fall, d

        fall = exp(-long%p*s)
        if (long%p*s < 0.5_wp) then
            scaled%sine_p = fall*sinh(long%p*s)/long%p
        else
            scaled%sine_p = (1 - fall**2)/(2*long%p)
        end if
        scaled%cosine_p = (1 + fall**2)/2
        d = sqrt(abs(long%d2))
        if (d*s < no_decay_length) then
            scaled%sine_d = fall*s
            scaled%cosine_d = fall
        else if (long%d2 < 0.0_wp) then
            scaled%sine_d = fall*sin(d*s)/d
            scaled%cosine_d = fall*cos(d*s)
        else if (d*s < 1.0_wp) then
            scaled%sine_d = fall*sinh(d*s)/d
            scaled%cosine_d = fall*cosh(d*s)
        else
            scaled%sine_d = (exp((d - long%p)*s) - exp(-(d + long%p)*s))/(2*d)
            scaled%cosine_d = (exp((d - long%p)*s) + exp(-(d + long%p)*s))/2
        end if
    end function scaled_at

    !> Decay from the left and right end, answers to the even, odd and bubble load, for one eigenvalue x, and their slopes
    pure subroutine scalar_response(x, xi, eta, value, slope)
        real(wp), intent(in) :: x, xi, eta
        real(wp), intent(out) :: value(5), slope(5)
        type(response_type) :: r
        real(wp) :: square, t, n

        square = x**2
        t = xi - eta
        if (square <= 8.0_wp) then
            r = short_response(short_of(square, 0.0_wp), xi, eta, with_slopes=.true., with_bubble=.true.)
            value = [eta - square*(r%even%ga - r%odd%ga)/2, xi - square*(r%even%ga + r%odd%ga)/2, &
                     r%even%ga, r%odd%ga, r%bubble%ga]
            slope = [-1 - square*(r%even_slope%ga - r%odd_slope%ga)/2, 1 - square*(r%even_slope%ga + r%odd_slope%ga)/2, &
                     r%even_slope%ga, r%odd_slope%ga, r%bubble_slope%ga]
            return
        end if
        n = 1 - exp(-2*x)
        value(1) = exp(-x*xi)*(1 - exp(-2*x*eta))/n
        value(2) = exp(-x*eta)*(1 - exp(-2*x*xi))/n
        slope(1) = -x*exp(-x*xi)*(1 + exp(-2*x*eta))/n
        slope(2) = x*exp(-x*eta)*(1 + exp(-2*x*xi))/n
        value(3) = (1 - (value(2) + value(1)))/square
        value(4) = (t - (value(2) - value(1)))/square
        value(5) = (xi*eta - 2*value(3))/square
        slope(3) = -(slope(2) + slope(1))/square
        slope(4) = (2 - (slope(2) - slope(1)))/square
        slope(5) = -(t + 2*slope(3))/square
    end subroutine scalar_response

    !> A function of X**2 from its values at both eigenvalues
    pure function quotient(long, value) result(triple)
        type(long_type), intent(in) :: long
        real(wp), intent(in) :: value(2)
        type(triple_type) :: triple
        real(wp) :: square(2), difference

        square = long%x**2
        difference = square(1) - square(2)
        triple%be = (value(1) - value(2))/difference
        triple%al = value(2) - square(2)*triple%be
        triple%ga = (square(1)*value(1) - square(2)*value(2))/difference
    end function quotient

end module gapbeam_foundation_long
