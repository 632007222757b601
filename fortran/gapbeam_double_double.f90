!> Double-double arithmetic: a number as the unevaluated sum of two doubles, about 32 digits
!>
!> Error-free sums and products (Knuth 1969, Dekker 1971). They rely on IEEE arithmetic without contraction and without
!> reordering: never compile with -ffast-math.
module gapbeam_double_double
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: double_double, plus, plus_product, divided, value_of

    !> high + low, high the nearest double
    type :: double_double
        real(wp) :: high = 0.0_wp
        real(wp) :: low = 0.0_wp
    end type double_double

    !> Splits a double into two halves of 26 bits
    real(wp), parameter :: splitter = 134217729.0_wp

contains

    !> x + y with a double y
    elemental function plus(x, y) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: y
        type(double_double) :: z
        real(wp) :: s, t, e

        s = x%high + y
        t = s - x%high
        e = ((x%high - (s - t)) + (y - t)) + x%low
        z%high = s + e
        z%low = e - (z%high - s)
    end function plus

    !> x + a b with doubles a and b
    elemental function plus_product(x, a, b) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: a, b
        type(double_double) :: z
        real(wp) :: p, a1, a2, b1, b2

        p = a*b
        a1 = splitter*a
        a1 = a1 - (a1 - a)
        a2 = a - a1
        b1 = splitter*b
        b1 = b1 - (b1 - b)
        b2 = b - b1
        z = plus(plus(x, p), ((a1*b1 - p) + a1*b2 + a2*b1) + a2*b2)
    end function plus_product

    !> x/y with a double y
    elemental function divided(x, y) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: y
        type(double_double) :: z, rest
        real(wp) :: q

        q = x%high/y
        rest = plus_product(x, -q, y)
        z = plus(double_double(q, 0.0_wp), (rest%high + rest%low)/y)
    end function divided

    !> The nearest double
    elemental function value_of(x) result(value)
        type(double_double), intent(in) :: x
        real(wp) :: value

        value = x%high + x%low
    end function value_of

end module gapbeam_double_double
