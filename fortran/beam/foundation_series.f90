!> Short stretches on elastic ground of constant modulus, by power series of a matrix.
!>
!> The fields y = (w, M) obey y'' = A y - load, A the matrix with the rows (K/GA, -1/EI) and (K, 0). Ends and fields are
!> even functions of X = sqrt(A) L, hence power series in X**2: nothing depends on whether its roots are real, complex,
!> alike or zero. Every function is a + b Z with Z = X**2/4 (half the stretch is the argument, so few terms do and little
!> cancels), Z**2 = sigma Z - tau (Cayley and Hamilton).
module gapbeam_foundation_series
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: end_functions_type, triple_type, response_type, short_type, short_ends, short_of, short_response, is_short

    !> Functions of a stretch's ends, all without unit: X coth X = a + c X**2, X/sinh X = b - e X**2
    type :: end_functions_type
        !> 1, 1, 1/3, 1/6 where nothing is elastic
        real(wp) :: a, b, c, e
        !> (a - 1)/T and (1 - b)/T, T = K L**4/EI; 1/45 and 7/360 where nothing is elastic
        real(wp) :: a_rest, b_rest
        !> The same of the load 4 x (L - x)/L**2, a quarter of it; 1/120
        real(wp) :: bubble
        !> Determinant of X/sinh X
        real(wp) :: determinant
    end type end_functions_type

    !> a function of X**2: al + be X**2, and ga = al + S be with S = K L**2/GA, the trace of X**2
    type :: triple_type
        real(wp) :: al = 0.0_wp, be = 0.0_wp, ga = 0.0_wp
    end type triple_type

    !> Answers of a stretch held at both ends (y = 0) to loads over it, and their slopes in xi
    type :: response_type
        !> To a uniform load, to one that rises from -1 to 1, to xi (1 - xi)
        type(triple_type) :: even, odd, bubble
        type(triple_type) :: even_slope, odd_slope, bubble_slope
    end type response_type

    !> a + b Z
    type :: pair_type
        real(wp) :: a, b
    end type pair_type

    !> Z**2 = sigma Z - tau; terms of the series needed
    type :: ring_type
        real(wp) :: sigma, tau
        integer :: terms
    end type ring_type

    !> What answers anywhere in a short stretch are made of
    type :: short_type
        private
        type(ring_type) :: ring
        !> (cosh x - 1)/x**2 and (sinh x - x)/x**3; x/sinh x and 1/cosh x
        type(pair_type) :: cosine_rest, sine_rest, over_sine, over_cosine
    end type short_type

    !> Terms for any stretch, for eigenvalues of Z up to 2 and up to 1/8: the next one is below rounding
    integer, parameter :: most_terms = merge(40, 30, digits(1.0_wp) > 64)
    integer, parameter :: usual_terms = merge(18, 11, digits(1.0_wp) > 64)
    integer, parameter :: few_terms = merge(12, 6, digits(1.0_wp) > 64)
    !> Ratios of the terms of (cosh x - 1)/x**2 and (sinh x - x)/x**3
    integer, parameter :: twice(40) = 2*[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, &
                                         21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40]
    real(wp), parameter :: cosine_ratio(40) = 1/real((twice + 1)*(twice + 2), wp)
    real(wp), parameter :: sine_ratio(40) = 1/real((twice + 2)*(twice + 3), wp)

contains

    !> The functions of the ends
    pure function short_ends(sigma, tau) result(ends)
        !> K L**2/GA and K L**4/EI, any sign, both of modulus 8 and 64 at most where they are not negative
        real(wp), intent(in) :: sigma, tau
        type(end_functions_type) :: ends
        type(ring_type) :: ring
        type(pair_type) :: sine, cosine, rest, u, v, w
        real(wp) :: sine_determinant, cosine_determinant

        ring = ring_of(sigma, tau)
        call both_rests(ring, 1.0_wp, cosine, sine)
        rest = pair_type(cosine%a - sine%a, cosine%b - sine%b)
        sine = one_plus(ring, sine)
        cosine = one_plus(ring, cosine)
        sine_determinant = determinant(ring, sine)
        cosine_determinant = determinant(ring, cosine)
        ! x coth x = 1 + x**2 u and x tanh x = x**2 w at half the stretch
        u = ratio(ring, rest, sine, sine_determinant)
        w = ratio(ring, sine, cosine, cosine_determinant)
        v = ratio(ring, rest, cosine, cosine_determinant)
        ends%a_rest = -(u%b + w%b)/16
        ends%b_rest = (u%b - w%b)/16
        ends%bubble = -v%b/16
        ends%a = 1 + tau*ends%a_rest
        ends%b = 1 - tau*ends%b_rest
        ends%c = ((u%a + w%a) + ring%sigma*(u%b + w%b))/4
        ends%e = ((w%a - u%a) + ring%sigma*(w%b - u%b))/4
        ends%determinant = 1/(sine_determinant*cosine_determinant)
    end function short_ends

    !> What the answers in a stretch have in common
    pure function short_of(sigma, tau) result(short)
        !> As for short_ends
        real(wp), intent(in) :: sigma, tau
        type(short_type) :: short

        short%ring = ring_of(sigma, tau)
        call both_rests(short%ring, 1.0_wp, short%cosine_rest, short%sine_rest)
        short%over_sine = inverse(short%ring, one_plus(short%ring, short%sine_rest))
        short%over_cosine = inverse(short%ring, one_plus(short%ring, short%cosine_rest))
    end function short_of

    !> The answers to loads at a place; every one is zero at the ends, with all digits beside them
    pure function short_response(short, xi, eta, with_slopes, with_bubble) result(response)
        !> By short_of
        type(short_type), intent(in) :: short
        !> The place in parts of the length from the left end and from the right one
        real(wp), intent(in) :: xi, eta
        !> Are slopes wanted, and the answers to the last one; else they are 0
        logical, intent(in) :: with_slopes, with_bubble
        type(response_type) :: response
        type(ring_type) :: ring
        type(pair_type) :: left, right, middle, z, middle_cosine, left_sine, right_sine
        real(wp) :: t, bump, product

        ring = short%ring
        t = xi - eta
        bump = xi*eta
        left = one_rest(ring, xi**2)
        right = one_rest(ring, eta**2)
        left_sine = one_plus(ring, scaled(left, xi**2))
        right_sine = one_plus(ring, scaled(right, eta**2))

        ! (1 - cosh(x t)/cosh x)/(4 x**2) = 1/2 sinh(x xi) sinh(x eta)/(x**2 cosh x)
        z = times(ring, times(ring, left_sine, right_sine), short%over_cosine)
        response%even = triple(ring, z, bump/2)
        ! (t - sinh(x t)/sinh x)/(4 x**2)
        z = times(ring, risen(ring, t**2), short%over_sine)
        response%odd = triple(ring, z, t*bump)
        if (with_bubble) then
            ! The first one again, less its own leading term
            product = bump**2
            z = times(ring, left, right)
            z = pair_type(-ring%tau*z%b*product, (z%a + ring%sigma*z%b)*product)
            z%a = short%cosine_rest%a - xi**2*left%a - eta**2*right%a - z%a
            z%b = short%cosine_rest%b - xi**2*left%b - eta**2*right%b - z%b
            response%bubble = triple(ring, times(ring, z, short%over_cosine), bump/4)
        end if
        if (.not. with_slopes) return
        call both_rests(ring, t**2, middle_cosine, middle)
        z = times(ring, one_plus(ring, scaled(middle, t**2)), short%over_cosine)
        response%even_slope = triple(ring, z, -t/2)
        z = pair_type(short%sine_rest%a - t**2*middle_cosine%a, short%sine_rest%b - t**2*middle_cosine%b)
        response%odd_slope = triple(ring, times(ring, z, short%over_sine), 0.5_wp)
        if (.not. with_bubble) return
        z = pair_type(short%cosine_rest%a - t**2*middle%a, short%cosine_rest%b - t**2*middle%b)
        response%bubble_slope = triple(ring, times(ring, z, short%over_cosine), -t/4)
    end function short_response

    !> The ring at half the stretch, and how many terms it takes
    pure function ring_of(sigma, tau) result(ring)
        real(wp), intent(in) :: sigma, tau
        type(ring_type) :: ring

        ring%sigma = sigma/4
        ring%tau = tau/16
        if (abs(ring%sigma) <= 1.0_wp/16 .and. abs(ring%tau) <= 1.0_wp/256) then
            ring%terms = few_terms
        else if (abs(ring%sigma) <= 2.0_wp .and. abs(ring%tau) <= 4.0_wp) then
            ring%terms = usual_terms
        else
            ring%terms = most_terms
        end if
    end function ring_of

    !> (cosh x - 1)/x**2 and (sinh x - x)/x**3 at x**2 = square Z
    pure subroutine both_rests(ring, square, cosine, sine)
        type(ring_type), intent(in) :: ring
        real(wp), intent(in) :: square
        type(pair_type), intent(out) :: cosine, sine
        real(wp) :: tau, sigma
        integer :: i

        tau = square*ring%tau
        sigma = square*ring%sigma
        cosine = pair_type(1.0_wp, 0.0_wp)
        sine = cosine
        if (abs(tau) > 0.0_wp) then
            do i = ring%terms, 1, -1
                cosine = pair_type(1 - tau*cosine_ratio(i)*cosine%b, (square*cosine%a + sigma*cosine%b)*cosine_ratio(i))
                sine = pair_type(1 - tau*sine_ratio(i)*sine%b, (square*sine%a + sigma*sine%b)*sine_ratio(i))
            end do
        else  ! the same without ground
            do i = ring%terms, 1, -1
                cosine%b = (square + sigma*cosine%b)*cosine_ratio(i)
                sine%b = (square + sigma*sine%b)*sine_ratio(i)
            end do
        end if
        cosine = scaled(cosine, 0.5_wp)
        sine = pair_type(sine%a/6, sine%b/6)
    end subroutine both_rests

    !> The second one alone
    pure function one_rest(ring, square) result(sine)
        type(ring_type), intent(in) :: ring
        real(wp), intent(in) :: square
        type(pair_type) :: sine
        real(wp) :: tau, sigma
        integer :: i

        tau = square*ring%tau
        sigma = square*ring%sigma
        sine = pair_type(1.0_wp, 0.0_wp)
        if (abs(tau) > 0.0_wp) then
            do i = ring%terms, 1, -1
                sine = pair_type(1 - tau*sine_ratio(i)*sine%b, (square*sine%a + sigma*sine%b)*sine_ratio(i))
            end do
        else
            do i = ring%terms, 1, -1
                sine%b = (square + sigma*sine%b)*sine_ratio(i)
            end do
        end if
        sine = pair_type(sine%a/6, sine%b/6)
    end function one_rest

    !> (s(Z) - s(square Z))/((1 - square) Z) for s(x**2) = sinh x/x: the terms of (sinh x - x)/x**3 times 1 + square + ...
    pure function risen(ring, square) result(sum)
        type(ring_type), intent(in) :: ring
        real(wp), intent(in) :: square
        type(pair_type) :: sum
        real(wp) :: weight(0:most_terms)
        integer :: i

        weight(0) = 1.0_wp
        do i = 1, ring%terms
            weight(i) = 1 + square*weight(i - 1)
        end do
        sum = pair_type(weight(ring%terms), 0.0_wp)
        if (abs(ring%tau) > 0.0_wp) then
            do i = ring%terms, 1, -1
                sum = pair_type(weight(i - 1) - ring%tau*sine_ratio(i)*sum%b, (sum%a + ring%sigma*sum%b)*sine_ratio(i))
            end do
        else
            do i = ring%terms, 1, -1
                sum = pair_type(weight(i - 1), (sum%a + ring%sigma*sum%b)*sine_ratio(i))
            end do
        end if
        sum = pair_type(sum%a/6, sum%b/6)
    end function risen

    !> 1 + Z x
    pure function one_plus(ring, x) result(y)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x
        type(pair_type) :: y

        y = pair_type(1 - ring%tau*x%b, x%a + ring%sigma*x%b)
    end function one_plus

    !> A number times x
    pure function scaled(x, factor) result(y)
        type(pair_type), intent(in) :: x
        real(wp), intent(in) :: factor
        type(pair_type) :: y

        y = pair_type(factor*x%a, factor*x%b)
    end function scaled

    !> x y
    pure function times(ring, x, y) result(z)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x, y
        type(pair_type) :: z

        z = pair_type(x%a*y%a - ring%tau*x%b*y%b, x%a*y%b + x%b*y%a + ring%sigma*x%b*y%b)
    end function times

    !> The determinant of x
    pure function determinant(ring, x) result(d)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x
        real(wp) :: d

        d = x%a*(x%a + ring%sigma*x%b) + ring%tau*x%b**2
    end function determinant

    !> 1/x
    pure function inverse(ring, x) result(y)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x
        type(pair_type) :: y
        real(wp) :: d

        d = determinant(ring, x)
        y = pair_type((x%a + ring%sigma*x%b)/d, -x%b/d)
    end function inverse

    !> x/y, y of determinant d
    pure function ratio(ring, x, y, d) result(z)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x, y
        real(wp), intent(in) :: d
        type(pair_type) :: z

        z = pair_type((x%a*(y%a + ring%sigma*y%b) + ring%tau*x%b*y%b)/d, (y%a*x%b - y%b*x%a)/d)
    end function ratio

    !> A factor times a + b Z as a function of X**2 = 4 Z
    pure function triple(ring, x, factor) result(y)
        type(ring_type), intent(in) :: ring
        type(pair_type), intent(in) :: x
        real(wp), intent(in) :: factor
        type(triple_type) :: y

        y = triple_type(factor*x%a, factor*x%b/4, factor*(x%a + ring%sigma*x%b))
    end function triple

    !> Are power series good for a stretch: they are for every one on softening ground, that is cut short
    pure function is_short(sigma, tau) result(short)
        !> K L**2/GA and K L**4/EI
        real(wp), intent(in) :: sigma, tau
        logical :: short

        short = sigma <= 8.0_wp .and. tau <= 64.0_wp
    end function is_short

end module gapbeam_foundation_series
