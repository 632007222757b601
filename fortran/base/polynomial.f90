!> Real roots of polynomials on an interval, for exact extremes of the fields
module gapbeam_polynomial
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: roots_between, value, highest_degree

    !> Of fields: deflection under linear load is of degree 5, its slope of degree 4
    integer, parameter :: highest_degree = 4

contains

    !> Points in (0, length) where a polynomial changes sign, by the roots of its derivatives one after the other:
    !> between two roots of the derivative a polynomial is monotone and has one root at most
    pure subroutine roots_between(coefficients, length, roots, number)
        !> Coefficients of s**0, s**1, ..., shape (0:degree)
        real(wp), intent(in) :: coefficients(0:)
        !> The interval is 0..length
        real(wp), intent(in) :: length
        !> The roots in rising order, shape (at least degree)
        real(wp), intent(out) :: roots(:)
        !> How many there are
        integer, intent(out) :: number
        real(wp) :: derivative(0:ubound(coefficients, 1)), marks(0:ubound(coefficients, 1) + 1), low, high
        integer :: degree, order, found, k, j

        number = 0
        roots = 0.0_wp
        degree = ubound(coefficients, 1)
        if (keeps_sign(coefficients, length)) return
        marks(0) = 0.0_wp
        found = 0
        do order = degree - 1, 0, -1
            ! derivative of this order; the marks are the roots of the next higher one
            do k = 0, degree - order
                derivative(k) = coefficients(k + order)
                do j = 1, order
                    derivative(k) = derivative(k)*(k + j)
                end do
            end do
            marks(found + 1) = length
            j = 0
            low = marks(0)
            do k = 1, found + 1
                high = marks(k)
                if (value(derivative(0:degree - order), low)*sign(1.0_wp, value(derivative(0:degree - order), high)) &
                    < 0.0_wp) then
                    j = j + 1
                    marks(j) = bracketed_root(derivative(0:degree - order), low, high)
                end if
                low = high
            end do
            found = j
        end do
        number = found
        roots(1:number) = marks(1:number)
    end subroutine roots_between

    !> Do all Bernstein coefficients on the interval have one sign: then there is no root
    pure function keeps_sign(coefficients, length) result(keeps)
        real(wp), intent(in) :: coefficients(0:), length
        logical :: keeps
        real(wp) :: b(0:ubound(coefficients, 1)), weight, power
        integer :: n, i, k

        n = ubound(coefficients, 1)
        b = 0.0_wp
        do i = 0, n
            ! b_i = sum_k C(i,k)/C(n,k) c_k length**k
            weight = 1.0_wp
            power = 1.0_wp
            do k = 0, i
                b(i) = b(i) + weight*coefficients(k)*power
                weight = weight*(i - k)/(n - k + merge(1, 0, n == k))
                power = power*length
            end do
        end do
        keeps = all(b(0:n) > 0.0_wp) .or. all(b(0:n) < 0.0_wp) .or. all(abs(b(0:n)) <= 0.0_wp)
    end function keeps_sign

    !> Horner's rule
    pure function value(coefficients, s) result(p)
        real(wp), intent(in) :: coefficients(0:), s
        real(wp) :: p
        integer :: k

        p = coefficients(ubound(coefficients, 1))
        do k = ubound(coefficients, 1) - 1, 0, -1
            p = coefficients(k) + s*p
        end do
    end function value

    !> Newton's method kept inside a shrinking bracket by bisection
    pure function bracketed_root(coefficients, low, high) result(root)
        real(wp), intent(in) :: coefficients(0:), low, high
        real(wp) :: root, a, b, f_a, f, slope, next
        integer :: step, k

        a = low
        b = high
        f_a = value(coefficients, a)
        root = a + (b - a)/2
        do step = 1, 200
            f = value(coefficients, root)
            if (f*sign(1.0_wp, f_a) > 0.0_wp) then
                a = root
            else
                b = root
            end if
            slope = 0.0_wp
            do k = ubound(coefficients, 1), 1, -1
                slope = k*coefficients(k) + root*slope
            end do
            next = a + (b - a)/2
            if (abs(slope) > 0.0_wp) then
                if (root - f/slope > a .and. root - f/slope < b) next = root - f/slope
            end if
            if (abs(next - root) <= 2*spacing(root) .or. .not. abs(f) > 0.0_wp) return
            root = next
        end do
    end function bracketed_root

end module gapbeam_polynomial
