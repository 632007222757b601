!> Where fields have extremes inside a piece whose stiffness changes along it.
!>
!> With the depths h and g relative to those at the left end, psi' = kappa - f M/h**n and w' = psi + s V/g**m. Multiplied by powers
!> of the depths the derivatives are polynomials, but for that of the deflection: it is monotone between the roots of its own.
module gapbeam_taper_extremes
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_power
    use gapbeam_line_search, only: bracket_type, narrow
    use gapbeam_polynomial, only: roots_between
    use gapbeam_piece, only: piece_type, piece_load_type
    use gapbeam_element, only: field_type
    use gapbeam_taper, only: depth_ratio, softness_at, fields_in_piece
    use gapbeam_quantities, only: of_rotation, of_moment, of_shear, of_curvature
    implicit none
    private
    public :: find_turning_places, most_places

    !> Degree of what the roots of the second derivative of the deflection are those of, and places in a piece
    integer, parameter :: most_degree = 2*most_power + 1, most_places = most_degree + 1

contains

    !> Places inside a piece where a quantity may have an extreme
    pure subroutine find_turning_places(piece, load, start, quantity, places, number)
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        !> Fields at its left end
        type(field_type), intent(in) :: start
        !> Number in gapbeam_quantities: rotation, moment, shear or curvature, else the deflection
        integer, intent(in) :: quantity
        !> Distances from the left end, shape (most_places)
        real(wp), intent(out) :: places(:)
        integer, intent(out) :: number
        real(wp) :: m(0:3), v(0:2), h(0:1), g(0:1), turning(0:most_degree)
        integer :: n

        number = 0
        places(:) = 0.0_wp
        ! Moment and shear as polynomials in t = s/length, the depths likewise
        associate (l => piece%length)
            m(:) = [start%moment, start%shear*l, -load%qa*l**2/2, -(load%qb - load%qa)*l**2/6]
            v(:) = [start%shear, -load%qa*l, -(load%qb - load%qa)*l/2]
        end associate
        h(:) = [1.0_wp, depth_ratio(piece%flexibility, piece%flexibility_to, piece%power) - 1]
        g(:) = [1.0_wp, depth_ratio(piece%shear_flexibility, piece%shear_flexibility_to, piece%shear_power) - 1]
        select case (quantity)
        case (of_moment)
            call roots_between(v, 1.0_wp, places, number)
        case (of_shear)
            call roots_between(slope(v), 1.0_wp, places, number)
        case (of_rotation)
            call roots_between(curving(), 1.0_wp, places, number)
        case (of_curvature)
            ! (M/h**n)' h**(n + 1)
            call roots_between(summed(times(slope(m), h), -piece%power*h(1)*m), 1.0_wp, places, number)
        case default
            turning(:) = 0.0_wp
            n = most_degree
            if (piece%shear_flexibility > 0.0_wp) then
                turning(:) = summed(turning, times(piece%length*curving(), power(g, piece%shear_power + 1)))
                turning(:) = summed(turning, times(piece%shear_flexibility*summed(times(slope(v), g), &
                                                     -piece%shear_power*g(1)*v), power(h, piece%power)))
            else
                turning(:) = summed(turning, curving())
            end if
            do while (n > 0 .and. .not. abs(turning(n)) > 0.0_wp)
                n = n - 1
            end do
            call roots_between(turning(:n), 1.0_wp, places, number)
            call find_level_places(piece, load, start, places, number)
        end select
        places(1:number) = piece%length*places(1:number)

    contains

        !> psi' h**n
        pure function curving() result(c)
            real(wp) :: c(0:max(3, piece%power))

            c(:) = summed(load%kappa*power(h, piece%power), -piece%flexibility*m)
        end function curving

    end subroutine find_turning_places

    !> Shares of the length at which the axis is level, between places at which its slope has extremes
    pure subroutine find_level_places(piece, load, start, places, number)
        !> As for find_turning_places
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        type(field_type), intent(in) :: start
        !> Those of the extremes in, where it is level out
        real(wp), intent(inout) :: places(:)
        integer, intent(inout) :: number
        real(wp) :: marks(0:most_places)
        integer :: n, k

        n = number
        marks(0) = 0.0_wp
        marks(1:n) = places(1:n)
        marks(n + 1) = 1.0_wp
        number = 0
        do k = 1, n + 1
            if (.not. incline(marks(k - 1))*sign(1.0_wp, incline(marks(k))) < 0.0_wp) cycle
            number = number + 1
            places(number) = where_level(marks(k - 1), marks(k))
        end do

    contains

        !> Slope of the axis at a share of the length
        pure function incline(t) result(slope)
            real(wp), intent(in) :: t
            real(wp) :: slope
            type(field_type) :: here
            real(wp) :: softness(2)

            here = fields_in_piece(start, t*piece%length, piece, load)
            softness(:) = softness_at(piece, t*piece%length)
            slope = here%rotation + softness(2)*here%shear
        end function incline

        !> Where it is zero between two places at which it has different signs: a bisection every third step
        pure function where_level(from, to) result(t)
            real(wp), intent(in) :: from, to
            real(wp) :: t, upward, here
            type(bracket_type) :: b
            integer :: step

            upward = sign(1.0_wp, incline(to))
            b = bracket_type(from, to, upward*incline(from), upward*incline(to))
            do step = 1, 200
                t = b%low + (b%high - b%low)/2
                if (mod(step, 3) > 0) t = max(b%low, min(b%high, b%high - b%at_high*((b%high - b%low)/(b%at_high - b%at_low))))
                here = upward*incline(t)
                if (.not. abs(here) > 0.0_wp) return
                call narrow(b, t, here)
                if (b%high - b%low <= 4*spacing(b%high)) return
            end do
        end function where_level

    end subroutine find_level_places

    !> Derivative of a polynomial
    pure function slope(c) result(derivative)
        !> Coefficients of s**0, s**1, ..., shape (0:n)
        real(wp), intent(in) :: c(0:)
        real(wp) :: derivative(0:max(0, ubound(c, 1) - 1))
        integer :: k

        derivative(0) = 0.0_wp
        do k = 1, ubound(c, 1)
            derivative(k - 1) = k*c(k)
        end do
    end function slope

    !> Sum of two polynomials
    pure function summed(a, b) result(c)
        real(wp), intent(in) :: a(0:), b(0:)
        real(wp) :: c(0:max(ubound(a, 1), ubound(b, 1)))

        c(:) = 0.0_wp
        c(0:ubound(a, 1)) = a
        c(0:ubound(b, 1)) = c(0:ubound(b, 1)) + b
    end function summed

    !> Product of two polynomials
    pure function times(a, b) result(c)
        real(wp), intent(in) :: a(0:), b(0:)
        real(wp) :: c(0:ubound(a, 1) + ubound(b, 1))
        integer :: k

        c(:) = 0.0_wp
        do k = 0, ubound(b, 1)
            c(k:k + ubound(a, 1)) = c(k:k + ubound(a, 1)) + a*b(k)
        end do
    end function times

    !> Power of a linear polynomial
    pure function power(a, n) result(c)
        real(wp), intent(in) :: a(0:1)
        integer, intent(in) :: n
        real(wp) :: c(0:n)
        integer :: k

        c(:) = 0.0_wp
        c(0) = 1.0_wp
        do k = 1, n
            c(0:k) = times(c(0:k - 1), a)
        end do
    end function power

end module gapbeam_taper_extremes
