!> Roots of polynomials of eight cases along a piece, by Bernstein coefficients.
!> As gapbeam_fields and gapbeam_polynomial find them for one (Lane and Riesenfeld 1981).
module gapbeam_lane_roots
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_lane_root_steps
    use gapbeam_tolerances, only: extreme_margin, root_place
    use gapbeam_lane_types, only: lanes
    implicit none
    private
    public :: find_open, count_turns, find_only_root, find_roots

    !> Reciprocal binomial coefficients i of 5, over i, and i of 4
    real(wp), parameter :: of_5(5) = [1.0_wp/5, 1.0_wp/20, 1.0_wp/30, 1.0_wp/20, 1.0_wp/5]
    real(wp), parameter :: of_4(0:4) = [1.0_wp, 1.0_wp/4, 1.0_wp/6, 1.0_wp/4, 1.0_wp]

contains

    !> In which cases a field may leave what is known inside a piece: its Bernstein coefficients on both halves do
    pure subroutine find_open(length, start, derivative, most, least, leaves)
        real(wp), intent(in) :: length
        !> The field at the left end, and the coefficients of its derivative
        real(wp), intent(in) :: start(lanes), derivative(lanes, 0:4)
        !> What is known
        real(wp), intent(in) :: most(lanes), least(lanes)
        !> 1 where it may
        real(wp), intent(out) :: leaves(lanes)
        real(wp) :: b(lanes, 0:5), power, x
        real(wp), dimension(lanes) :: size, low, high
        integer :: i, j, l

        b(:, 0) = start
        size(:) = abs(start)
        power = 1.0_wp
        do i = 1, 5
            power = power*length
            !$omp simd private(x)
            do l = 1, lanes
                x = derivative(l, i - 1)*power
                size(l) = size(l) + abs(x)
                b(l, i) = x*of_5(i)
            end do
        end do
        do i = 1, 5
            do j = 5, i, -1
                !$omp simd
                do l = 1, lanes
                    b(l, j) = b(l, j) + b(l, j - 1)
                end do
            end do
        end do
        ! Halved (de Casteljau): those of the right half pass by at the end of the array, those of the left one are left in it
        low(:) = b(:, 5)
        high(:) = b(:, 5)
        do i = 1, 5
            do j = 5, i, -1
                !$omp simd
                do l = 1, lanes
                    b(l, j) = 0.5_wp*(b(l, j) + b(l, j - 1))
                end do
            end do
            call widen(b(:, 5), low, high)
        end do
        do i = 0, 4
            call widen(b(:, i), low, high)
        end do
        !$omp simd private(x)
        do l = 1, lanes
            x = merge(0.0_wp, 1.0_wp, high(l) + extreme_margin*size(l) < most(l))
            leaves(l) = merge(x, 1.0_wp, low(l) - extreme_margin*size(l) > least(l))
        end do
    end subroutine find_open

    !> Take values into what lies between low and high
    pure subroutine widen(value, low, high)
        real(wp), intent(in) :: value(lanes)
        real(wp), intent(inout) :: low(lanes), high(lanes)
        real(wp) :: y, a, b
        integer :: l

        !$omp simd private(y, a, b)
        do l = 1, lanes
            y = value(l)
            a = low(l)
            b = high(l)
            low(l) = merge(y, a, y < a)
            high(l) = merge(y, b, y > b)
        end do
    end subroutine widen

    !> How often the Bernstein coefficients of a derivative change sign: it has so many roots inside the piece, or 2, 4 less
    pure subroutine count_turns(length, derivative, turns)
        real(wp), intent(in) :: length, derivative(lanes, 0:4)
        !> More where the derivative is nearly zero at an end
        real(wp), intent(out) :: turns(lanes)
        real(wp) :: b(lanes, 0:4), size(lanes), power
        integer :: i, j, l

        power = 1.0_wp
        do i = 0, 4
            b(:, i) = derivative(:, i)*(power*of_4(i))
            power = power*length
        end do
        do i = 1, 4
            do j = 4, i, -1
                !$omp simd
                do l = 1, lanes
                    b(l, j) = b(l, j) + b(l, j - 1)
                end do
            end do
        end do
        size(:) = 0.0_wp
        do i = 0, 4
            !$omp simd
            do l = 1, lanes
                size(l) = size(l) + abs(b(l, i))
            end do
        end do
        ! What is zero at an end may have any sign there
        do l = 1, lanes
            turns(l) = merge(0.0_wp, 2.0_wp, abs(b(l, 0)) > extreme_margin*size(l) .and. abs(b(l, 4)) > extreme_margin*size(l))
        end do
        do i = 1, 4
            !$omp simd
            do l = 1, lanes
                turns(l) = turns(l) + 0.5_wp*abs(sign(1.0_wp, b(l, i)) - sign(1.0_wp, b(l, i - 1)))
            end do
        end do
    end subroutine count_turns

    !> Where polynomials of degree 4 with one root at most change sign
    pure subroutine find_only_root(coefficients, length, root, there)
        real(wp), intent(in) :: coefficients(lanes, 0:4), length(lanes)
        !> 1 where there is a root
        real(wp), intent(out) :: root(lanes), there(lanes)
        real(wp) :: right(lanes), start(lanes)
        integer :: j, l

        right(:) = coefficients(:, 4)
        do j = 3, 0, -1
            right(:) = coefficients(:, j) + length*right
        end do
        do l = 1, lanes
            there(l) = merge(1.0_wp, 0.0_wp, coefficients(l, 0)*sign(1.0_wp, right(l)) < 0.0_wp)
        end do
        start(:) = 0.0_wp
        root(:) = 0.0_wp
        call find_root(4, coefficients, start, length, coefficients(:, 0), there, root)
    end subroutine find_only_root

    !> Where polynomials of degree 4 change sign between 0 and a length, by the roots of their derivatives one after the other:
    !> between two of them a polynomial is monotone
    pure subroutine find_roots(coefficients, length, roots, there)
        real(wp), intent(in) :: coefficients(lanes, 0:4), length(lanes)
        !> A root of every stretch, and 1 where there is one
        real(wp), intent(out) :: roots(lanes, 4), there(lanes, 4)
        real(wp) :: d(lanes, 0:4), marks(lanes, 0:4), times, f
        real(wp), dimension(lanes) :: a, b, left, right, changes, root
        integer :: order, degree, k, j, l

        marks(:, :) = 0.0_wp
        marks(:, 1) = length
        do order = 3, 0, -1
            degree = 4 - order
            do k = 0, degree
                times = 1.0_wp
                do j = 1, order
                    times = times*(k + j)
                end do
                d(:, k) = times*coefficients(:, k + order)
            end do
            marks(:, degree) = length
            a(:) = 0.0_wp
            left(:) = d(:, 0)
            do k = 1, degree
                b(:) = marks(:, k)
                right(:) = d(:, degree)
                do j = degree - 1, 0, -1
                    !$omp simd
                    do l = 1, lanes
                        right(l) = d(l, j) + b(l)*right(l)
                    end do
                end do
                !$omp simd private(f)
                do l = 1, lanes
                    f = left(l)*sign(1.0_wp, right(l))
                    changes(l) = merge(1.0_wp, 0.0_wp, f < 0.0_wp)
                end do
                root(:) = b
                if (any(changes > 0.5_wp)) call find_root(degree, d, a, b, left, changes, root)
                roots(:, k) = root
                there(:, k) = changes
                a(:) = b
                left(:) = right
            end do
            marks(:, 1:degree) = roots(:, 1:degree)
        end do
    end subroutine find_roots

    !> The roots of polynomials between two places, where they change sign once: Newton's method kept inside a shrinking bracket
    pure subroutine find_root(degree, d, from, to, left, changes, root)
        integer, intent(in) :: degree
        real(wp), intent(in) :: d(lanes, 0:4)
        !> The places, and the values at the first of them
        real(wp), intent(in), dimension(lanes) :: from, to, left
        !> 1 where there is a root
        real(wp), intent(in) :: changes(lanes)
        !> As it is where there is none
        real(wp), intent(inout) :: root(lanes)
        real(wp), dimension(lanes) :: a, b, x, busy, f, slope
        real(wp) :: at, value, above, low, high, next, newton, steep, goes_on
        integer :: step, k, l

        a(:) = from
        b(:) = to
        x(:) = a + 0.5_wp*(b - a)
        busy(:) = changes
        do step = 1, most_lane_root_steps
            f(:) = d(:, degree)
            slope(:) = 0.0_wp
            do k = degree - 1, 0, -1
                !$omp simd
                do l = 1, lanes
                    slope(l) = f(l) + x(l)*slope(l)
                    f(l) = d(l, k) + x(l)*f(l)
                end do
            end do
            !$omp simd private(at, value, above, low, high, next, newton, steep, goes_on)
            do l = 1, lanes
                at = x(l)
                value = f(l)
                above = value*sign(1.0_wp, left(l))
                low = merge(at, a(l), above > 0.0_wp)
                high = merge(b(l), at, above > 0.0_wp)
                next = low + 0.5_wp*(high - low)
                steep = abs(slope(l))
                newton = slope(l) + merge(0.0_wp, 1.0_wp, steep > 0.0_wp)
                newton = at - value/newton
                newton = merge(newton, next, newton > low)
                newton = merge(newton, next, newton < high)
                next = merge(newton, next, steep > 0.0_wp)
                goes_on = merge(1.0_wp, 0.0_wp, abs(next - at) > root_place*at)
                goes_on = merge(goes_on, 0.0_wp, abs(value) > 0.0_wp)*busy(l)
                next = merge(next, at, goes_on > 0.5_wp)
                a(l) = low
                b(l) = high
                busy(l) = goes_on
                x(l) = next
            end do
            if (.not. any(busy > 0.5_wp)) exit
        end do
        where (changes > 0.5_wp) root = x
    end subroutine find_root

end module gapbeam_lane_roots
