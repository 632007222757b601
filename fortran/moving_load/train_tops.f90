!> Tops of polynomials through values at some positions, in the position or in an angle.
!>
!> Where a zone of contact is born values go like the power 3/2 of the distance from there, which no polynomial in the position
!> follows, but one in its root does: in an angle from 0 to pi, whose square is the distance from either end, next to it.
module gapbeam_train_tops
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: ruler_type, angle_of, position_of, at_birth, nearer_birth, find_vertex, find_highest, last_terms

    real(wp), parameter :: pi = acos(-1.0_wp)
    !> Share of the angle to the next state down to which is looked beside the birth of a zone: its square is that of the way, and
    !> what is greater still nearer is so by less than one part in 1e9 of what values bend
    real(wp), parameter :: nearest_birth = 2.0_wp**(-11)
    !> Places at which the slope of a polynomial is looked at; halvings that find all digits of where it is zero
    integer, parameter :: looks = 48, halvings = 60

    !> What positions between two changes are measured by
    type :: ruler_type
        !> By the angle, or as they are
        logical :: bears_zones = .false.
        !> The ends
        real(wp) :: low = 0.0_wp, high = 0.0_wp
    end type ruler_type

contains

    !> The angle of a position
    elemental function angle_of(ruler, position) result(angle)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(in) :: position
        real(wp) :: angle

        angle = position
        if (.not. ruler%bears_zones) return
        angle = 2*atan2(sqrt(max(position - ruler%low, 0.0_wp)), sqrt(max(ruler%high - position, 0.0_wp)))
    end function angle_of

    !> The position of an angle
    elemental function position_of(ruler, angle) result(position)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(in) :: angle
        real(wp) :: position

        position = angle
        if (.not. ruler%bears_zones) return
        if (angle <= pi/2) then
            position = ruler%low + (ruler%high - ruler%low)*sin(angle/2)**2
        else
            position = ruler%high - (ruler%high - ruler%low)*cos(angle/2)**2
        end if
    end function position_of

    !> Is an angle the first or the last one, where zones may be born
    elemental function at_birth(ruler, angle) result(born)
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(in) :: angle
        logical :: born

        born = ruler%bears_zones .and. (angle <= 0.0_wp .or. angle >= pi)
    end function at_birth

    !> The angle to look at next where values fall from the end of a run on
    elemental subroutine nearer_birth(best, left, right, width, ruler, angle, known)
        !> That end, the bounds, and their distance at first
        real(wp), intent(in) :: best, left, right, width
        type(ruler_type), intent(in) :: ruler
        real(wp), intent(out) :: angle
        !> Can something be born, and what may still be greater be more than rounding
        logical, intent(out) :: known

        associate (away => right + left - 2*best)
            known = at_birth(ruler, best) .and. abs(away) > nearest_birth*width
            angle = best + away/4
        end associate
    end subroutine nearer_birth

    !> Top of the parabola through the highest point and the two nearest to it
    pure subroutine find_vertex(best, at, heights, left, right, place, height, known)
        !> Place of the highest point
        real(wp), intent(in) :: best
        !> All points
        real(wp), intent(in) :: at(:), heights(:)
        !> Bounds
        real(wp), intent(in) :: left, right
        real(wp), intent(out) :: place, height
        !> Is there a top between the bounds
        logical, intent(out) :: known
        real(wp) :: far(size(at)), da, db, f, slope_a, slope_b, bend
        integer :: a, b

        known = .false.
        place = 0.0_wp
        height = 0.0_wp
        if (size(at) < 3) return
        far(:) = abs(at - best)
        f = heights(minloc(far, 1))
        where (.not. far > 0.0_wp) far = huge(far)
        a = minloc(far, 1)
        far(a) = huge(far)
        b = minloc(far, 1)
        da = at(a) - best
        db = at(b) - best
        if (.not. abs(da - db) > 0.0_wp .or. .not. min(abs(da), abs(db)) > 0.0_wp) return
        slope_a = (heights(a) - f)/da
        slope_b = (heights(b) - f)/db
        bend = (slope_a - slope_b)/(da - db)
        if (.not. bend < 0.0_wp) return
        slope_a = slope_a - bend*da
        place = best - slope_a/(2*bend)
        height = f - slope_a/(4*bend)*slope_a
        known = left < place .and. place < right
    end subroutine find_vertex

    !> The highest stationary point between bounds of the polynomial through points
    subroutine find_highest(at, heights, left, right, place, height, known)
        !> The points
        real(wp), intent(in) :: at(:), heights(:)
        !> Bounds
        real(wp), intent(in) :: left, right
        real(wp), intent(out) :: place, height
        !> Is there one
        logical, intent(out) :: known
        real(wp) :: t(size(at)), c(size(at)), middle, half, next, low, value, slope, low_slope
        integer :: k, power

        known = .false.
        place = 0.0_wp
        height = -huge(height)
        middle = (left + right)/2
        half = (right - left)/2
        if (.not. half > 0.0_wp) return
        t(:) = (at - middle)/half
        ! A power of two: products of great numbers would be beyond all numbers
        power = exponent(max(maxval(abs(heights)), tiny(half)))
        c(:) = divided_differences(t, scale(heights, -power))
        low = -1.0_wp
        call evaluate(low, value, low_slope)
        do k = 1, looks
            next = -cos(pi*k/looks)
            if (k == looks) next = 1.0_wp
            call evaluate(next, value, slope)
            if (low_slope >= 0.0_wp .and. slope <= 0.0_wp) call take_zero(low, next)
            low = next
            low_slope = slope
        end do
        if (known) height = scale(height, power)

    contains

        !> The polynomial and its slope
        pure subroutine evaluate(u, p, dp)
            real(wp), intent(in) :: u
            real(wp), intent(out) :: p, dp
            integer :: i

            p = c(size(c))
            dp = 0.0_wp
            do i = size(c) - 1, 1, -1
                dp = dp*(u - t(i)) + p
                p = p*(u - t(i)) + c(i)
            end do
        end subroutine evaluate

        !> Where the slope is zero between two places, and take it if it is the highest so far
        subroutine take_zero(from, to)
            real(wp), intent(in) :: from, to
            real(wp) :: a, b, u, p, dp
            integer :: i

            a = from
            b = to
            do i = 1, halvings
                u = a + (b - a)/2
                if (u <= a .or. u >= b) exit
                call evaluate(u, p, dp)
                if (dp >= 0.0_wp) then
                    a = u
                else
                    b = u
                end if
            end do
            u = a + (b - a)/2
            call evaluate(u, p, dp)
            if (known .and. p <= height) return
            known = .true.
            height = p
            place = middle + half*u
        end subroutine take_zero

    end subroutine find_highest

    !> By how much the polynomial through points and the one without the first and the last of them differ at most, about
    pure function last_terms(at, heights, left, right) result(difference)
        !> The points, three at least, in ascending order
        real(wp), intent(in) :: at(:), heights(:)
        !> Bounds between which it is asked for
        real(wp), intent(in) :: left, right
        real(wp) :: difference
        integer, parameter :: places = 16
        real(wp) :: t(size(at)), c(size(at)), half, u
        integer :: k, n, power

        n = size(at)
        half = (right - left)/2
        t(:) = ([at(2:n - 1), at(1), at(n)] - (left + right)/2)/half
        power = exponent(max(maxval(abs(heights)), tiny(half)))
        c(:) = divided_differences(t, scale([heights(2:n - 1), heights(1), heights(n)], -power))
        difference = 0.0_wp
        do k = 0, places
            u = -cos(pi*k/places)
            difference = max(difference, abs((c(n - 1) + c(n)*(u - t(n - 1)))*product(u - t(:n - 2))))
        end do
        difference = scale(difference, power)
    end function last_terms

    !> Coefficients of the polynomial through points by Newton's formula
    pure function divided_differences(t, heights) result(c)
        real(wp), intent(in) :: t(:), heights(:)
        real(wp) :: c(size(t))
        integer :: k, step

        c(:) = heights
        do k = 2, size(c)
            do step = size(c), k, -1
                c(step) = (c(step) - c(step - 1))/(t(step) - t(step - k + 1))
            end do
        end do
    end function divided_differences

end module gapbeam_train_tops
