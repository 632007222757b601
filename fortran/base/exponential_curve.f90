!> Curves that are a polynomial of degree 3 and two exponentials, each decaying from one end: what a bar on springs along it does,
!> in closed form. In quadruple precision: springs are stiff beside what they hold.
module gapbeam_exponential_curve
    use gapbeam_kinds, only: qp
    implicit none
    private
    public :: curve_type, new_curve, value_of, derivative, scaled, roots_of, most_roots

    !> Such a curve has no more: four derivatives leave two exponentials, which have one
    integer, parameter :: most_roots = 5

    !> Over a stretch
    type :: curve_type
        !> Its ends
        real(qp) :: from = 0.0_qp, to = 0.0_qp
        !> Coefficients of the powers of x
        real(qp) :: power(0:3) = 0.0_qp
        !> Of exp(-rate (x - from)) and of exp(-rate (to - x))
        real(qp) :: left = 0.0_qp, right = 0.0_qp, rate = 0.0_qp
    end type curve_type

contains

    !> A polynomial, and what an equation h'' = rate**2 h adds to it
    pure function new_curve(from, to, power, rate, at_from, at_to) result(curve)
        !> Ends, above each other; coefficients; rate, 0: h is a straight line
        real(qp), intent(in) :: from, to, power(0:3), rate
        !> h at the ends
        real(qp), intent(in) :: at_from, at_to
        type(curve_type) :: curve
        real(qp) :: decay, slope

        curve = curve_type(from, to, power, 0.0_qp, 0.0_qp, rate)
        if (rate > 0.0_qp) then
            decay = exp(-rate*(to - from))
            curve%left = (at_from - at_to*decay)/(1 - decay**2)
            curve%right = (at_to - at_from*decay)/(1 - decay**2)
        else
            slope = (at_to - at_from)/(to - from)
            curve%power(0) = curve%power(0) + at_from - slope*from
            curve%power(1) = curve%power(1) + slope
        end if
    end function new_curve

    !> Its value at a place
    pure function value_of(curve, x) result(value)
        type(curve_type), intent(in) :: curve
        real(qp), intent(in) :: x
        real(qp) :: value

        value = curve%power(0) + x*(curve%power(1) + x*(curve%power(2) + x*curve%power(3)))
        if (.not. curve%rate > 0.0_qp) return
        value = value + curve%left*exp(-curve%rate*(x - curve%from)) + curve%right*exp(-curve%rate*(curve%to - x))
    end function value_of

    !> Its derivative
    pure function derivative(curve) result(slope)
        type(curve_type), intent(in) :: curve
        type(curve_type) :: slope

        slope = curve
        slope%power(:) = [curve%power(1), 2*curve%power(2), 3*curve%power(3), 0.0_qp]
        slope%left = -curve%rate*curve%left
        slope%right = curve%rate*curve%right
    end function derivative

    !> The curve times a number
    pure function scaled(curve, factor) result(times)
        type(curve_type), intent(in) :: curve
        real(qp), intent(in) :: factor
        type(curve_type) :: times

        times = curve
        times%power(:) = factor*curve%power
        times%left = factor*curve%left
        times%right = factor*curve%right
    end function scaled

    !> Where it is 0 inside its stretch and changes its sign there, in order. Between roots of its derivative there is one at most;
    !> derivatives end in one that has a single root: that of two exponentials, or of a straight line
    pure recursive subroutine roots_of(curve, roots, number)
        type(curve_type), intent(in) :: curve
        !> The first `number` of these
        real(qp), intent(out) :: roots(most_roots)
        integer, intent(out) :: number
        real(qp) :: turns(most_roots), at(0:most_roots + 1), value(0:most_roots + 1), x
        logical :: found
        integer :: i, m

        roots(:) = 0.0_qp
        number = 0
        if (.not. any(abs(curve%power(merge(0, 2, curve%rate > 0.0_qp):)) > 0.0_qp)) then
            call last_root(curve, x, found)
            if (found .and. x > curve%from .and. x < curve%to) then
                number = 1
                roots(1) = x
            end if
            return
        end if
        call roots_of(derivative(curve), turns, m)
        at(0) = curve%from
        at(1:m) = turns(:m)
        at(m + 1) = curve%to
        do i = 0, m + 1
            value(i) = value_of(curve, at(i))
        end do
        do i = 0, m
            if (.not. (value(i) < 0.0_qp .and. value(i + 1) > 0.0_qp .or. value(i) > 0.0_qp .and. value(i + 1) < 0.0_qp)) cycle
            number = number + 1
            roots(number) = root_between(curve, at(i), at(i + 1), value(i))
        end do
    end subroutine roots_of

    !> The root of two exponentials, or of a straight line
    pure subroutine last_root(curve, x, found)
        type(curve_type), intent(in) :: curve
        real(qp), intent(out) :: x
        logical, intent(out) :: found

        x = 0.0_qp
        associate (a => curve%left, b => curve%right)
            found = curve%rate > 0.0_qp .and. (a < 0.0_qp .and. b > 0.0_qp .or. a > 0.0_qp .and. b < 0.0_qp)
            if (found) x = (curve%from + curve%to + log(abs(a/b))/curve%rate)/2
        end associate
        if (curve%rate > 0.0_qp) return
        found = abs(curve%power(1)) > 0.0_qp
        if (found) x = -curve%power(0)/curve%power(1)
    end subroutine last_root

    !> The root between two places where it has values of opposite signs and no turn: Newton steps, halved where they leave these
    pure function root_between(curve, from, to, value_from) result(x)
        type(curve_type), intent(in) :: curve
        real(qp), intent(in) :: from, to, value_from
        real(qp) :: x
        type(curve_type) :: slope
        real(qp) :: low, high, value, next, off
        integer :: i

        slope = derivative(curve)
        low = from
        high = to
        x = (low + high)/2
        off = huge(off)
        do i = 1, 4*digits(x)
            value = value_of(curve, x)
            if (.not. abs(value) > 0.0_qp) return
            if ((value > 0.0_qp) .eqv. (value_from > 0.0_qp)) then
                low = x
            else
                high = x
            end if
            next = value_of(slope, x)
            if (abs(next) > 0.0_qp) next = x - value/next
            ! Steps that do not shorten by half are no better than halves
            if (.not. (next > low .and. next < high .and. abs(next - x) < off/2)) next = (low + high)/2
            off = abs(next - x)
            x = next
            if (off <= 2*epsilon(x)*abs(x) .or. .not. (x > low .and. x < high)) return
        end do
    end function root_between

end module gapbeam_exponential_curve
