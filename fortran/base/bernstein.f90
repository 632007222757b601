!> Polynomials on 0..1 by their Bernstein coefficients, which bound all values.
!> All values lie between the least and the greatest coefficient, so where nothing happens is known at once, and halves of the
!> interval (de Casteljau) show the rest.
module gapbeam_bernstein
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: narrowest_interval
    use gapbeam_polynomial, only: roots_between, most_roots => highest_degree
    implicit none
    private
    public :: highest_degree, sample_points, to_coefficients, value_of, halve, part_of, find_greatest, first_below, crossing

    !> Degrees at most
    integer, parameter :: highest_degree = 7

contains

    !> Where a polynomial is best sampled (Chebyshev and Lobatto), both ends included
    pure function sample_points(degree) result(points)
        integer, intent(in) :: degree
        !> Rising from 0 to 1, shape (0:degree)
        real(wp) :: points(0:degree)
        real(wp), parameter :: pi = acos(-1.0_wp)
        integer :: k

        points(:) = [(sin(pi*k/(2*max(degree, 1)))**2, k=0, degree)]
        points(degree) = real(min(degree, 1), wp)
    end function sample_points

    !> The matrix that makes coefficients of values at the sample points
    pure function to_coefficients(degree) result(matrix)
        integer, intent(in) :: degree
        !> Shape (0:degree, 0:degree)
        real(wp) :: matrix(0:degree, 0:degree)
        real(wp) :: a(0:degree, 0:2*degree + 1), points(0:degree), row(0:2*degree + 1)
        integer :: j, k, best

        points(:) = sample_points(degree)
        a(:, :) = 0.0_wp
        do k = 0, degree
            do j = 0, degree
                a(k, j) = binomial(degree, j)*points(k)**j*(1 - points(k))**(degree - j)
            end do
            a(k, degree + 1 + k) = 1.0_wp
        end do
        do j = 0, degree
            best = j - 1 + maxloc(abs(a(j:, j)), 1)
            row(:) = a(best, :)
            a(best, :) = a(j, :)
            a(j, :) = row/row(j)
            do k = 0, degree
                if (k /= j) a(k, :) = a(k, :) - a(k, j)*a(j, :)
            end do
        end do
        matrix(:, :) = a(:, degree + 1:)
    end function to_coefficients

    !> n over k
    pure function binomial(n, k) result(number)
        integer, intent(in) :: n, k
        real(wp) :: number
        integer :: i

        number = 1.0_wp
        do i = 1, k
            number = number*(n - k + i)/i
        end do
    end function binomial

    !> Value of a polynomial
    pure function value_of(b, u) result(value)
        !> Coefficients, shape (0:degree)
        real(wp), intent(in) :: b(0:)
        !> The place, 0..1
        real(wp), intent(in) :: u
        real(wp) :: value, c(0:ubound(b, 1))
        integer :: k

        c(:) = b
        do k = ubound(b, 1), 1, -1
            c(0:k - 1) = (1 - u)*c(0:k - 1) + u*c(1:k)
        end do
        value = c(0)
    end function value_of

    !> Coefficients on the two parts of the interval
    pure subroutine halve(b, u, left, right)
        !> Shape (0:degree)
        real(wp), intent(in) :: b(0:)
        !> Where it is cut
        real(wp), intent(in) :: u
        real(wp), intent(out) :: left(0:), right(0:)
        integer :: k, n

        n = ubound(b, 1)
        right(0:n) = b
        do k = 0, n
            left(k) = right(0)
            right(0:n - k - 1) = (1 - u)*right(0:n - k - 1) + u*right(1:n - k)
        end do
    end subroutine halve

    !> Coefficients on a part of the interval
    pure function part_of(b, first, last) result(part)
        !> Shape (0:degree)
        real(wp), intent(in) :: b(0:)
        !> Ends of the part, 0 to 1
        real(wp), intent(in) :: first, last
        real(wp), dimension(0:ubound(b, 1)) :: part, whole, rest

        part(:) = b
        if (last < 1.0_wp) then
            whole(:) = part
            call halve(whole, last, part, rest)
        end if
        if (first > 0.0_wp .and. last > 0.0_wp) then
            whole(:) = part
            call halve(whole, first/last, rest, part)
        end if
    end function part_of

    !> The greatest value of a polynomial, and where it is: at an end, or where the slope changes its sign
    pure subroutine find_greatest(b, value, u)
        !> Shape (0:degree), degree at most most_roots + 1
        real(wp), intent(in) :: b(0:)
        real(wp), intent(out) :: value, u
        real(wp) :: slope(0:ubound(b, 1) - 1), roots(most_roots), here
        integer :: j, k, n, number

        n = ubound(b, 1)
        value = b(0)
        u = 0.0_wp
        if (b(n) > value) then
            value = b(n)
            u = 1.0_wp
        end if
        if (.not. maxval(b) > value) return
        slope(:) = b(1:) - b(:n - 1)
        do j = 1, n - 1
            do k = n - 1, j, -1
                slope(k) = slope(k) - slope(k - 1)
            end do
        end do
        do j = 0, n - 1
            slope(j) = binomial(n - 1, j)*slope(j)
        end do
        call roots_between(slope, 1.0_wp, roots, number)
        do k = 1, number
            here = value_of(b, roots(k))
            if (.not. here > value) cycle
            value = here
            u = roots(k)
        end do
    end subroutine find_greatest

    !> The first place at which a polynomial is below a level
    pure function first_below(b, level) result(u)
        !> Shape (0:degree)
        real(wp), intent(in) :: b(0:)
        real(wp), intent(in) :: level
        !> 2 if it is nowhere below it
        real(wp) :: u
        real(wp) :: waiting(0:highest_degree, 60), from(60), width(60), whole(0:highest_degree)
        integer :: n, count

        n = ubound(b, 1)
        u = 2.0_wp
        if (all(b >= level)) return
        count = 1
        waiting(0:n, 1) = b
        from(1) = 0.0_wp
        width(1) = 1.0_wp
        do while (count > 0)
            whole(0:n) = waiting(0:n, count)
            if (all(whole(0:n) >= level)) then
                count = count - 1
            else if (whole(0) < level .or. width(count) < narrowest_interval .or. count == size(width)) then
                u = from(count)
                return
            else
                width(count) = width(count)/2
                from(count + 1) = from(count)
                width(count + 1) = width(count)
                from(count) = from(count) + width(count)
                call halve(whole(0:n), 0.5_wp, waiting(0:n, count + 1), waiting(0:n, count))
                count = count + 1
            end if
        end do
    end function first_below

    !> Where a polynomial goes below zero, between a place at which it is not and one at which it is
    pure function crossing(b, from, to) result(u)
        !> Shape (0:degree)
        real(wp), intent(in) :: b(0:)
        real(wp), intent(in) :: from, to
        real(wp) :: u, low, high
        integer :: step

        low = from
        high = to
        do step = 1, 60
            u = low + (high - low)/2
            if (.not. (u > low .and. u < high)) exit
            if (value_of(b, u) < 0.0_wp) then
                high = u
            else
                low = u
            end if
        end do
        u = low
    end function crossing

end module gapbeam_bernstein
