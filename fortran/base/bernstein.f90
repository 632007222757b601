!> Polynomials of one and two variables on 0..1 by their Bernstein coefficients: between the least and the greatest coefficient
!> lie all values, so where nothing happens is known at once, and halves of the interval (de Casteljau) show what does
module gapbeam_bernstein
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: highest_degree, most_along, sample_points, to_coefficients, value_of, halve, first_below, crossing, patch_type, &
        greatest_on_patch

    !> Degrees at most, of the second variable of a patch too; of its first one
    integer, parameter :: highest_degree = 7, most_along = 5
    !> Halves narrower than this are not looked into
    real(wp), parameter :: narrowest = 2.0_wp**(-50)
    !> The same of patches; what is left to find there is less than rounding
    real(wp), parameter :: narrowest_patch = 2.0_wp**(-30)
    !> What coefficients that should be equal differ by at most, as a share of the largest. With less, values that stay the
    !> same in one direction are cut there without end; what is found within it is made exact by Newton's method
    real(wp), parameter :: rounding = 2.0_wp**(-45)
    !> Patches that wait at most
    integer, parameter :: most_waiting = 120

    !> A polynomial on the unit square, sum of b(j, k) B_j(v) B_k(u), or on a part of it
    type :: patch_type
        !> Degrees in v and u
        integer :: along, across
        real(wp) :: b(0:most_along, 0:highest_degree)
        !> The part: first v and u, and how far it goes (no default values: many patches are laid out at a time)
        real(wp) :: v, u, width_v, width_u
    end type patch_type

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
        real(wp) :: value
        real(wp) :: c(0:ubound(b, 1))
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
        left(0) = b(0)
        do k = 1, n
            right(0:n - k) = (1 - u)*right(0:n - k) + u*right(1:n - k + 1)
            left(k) = right(0)
        end do
    end subroutine halve

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
            else if (whole(0) < level .or. width(count) < narrowest .or. count == size(width)) then
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
        real(wp) :: u
        real(wp) :: low, high
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

    !> The greatest value on the unit square, and where it is: parts that hold nothing greater are dropped; where one
    !> derivative keeps its sign an edge is left
    pure subroutine greatest_on_patch(whole, known, value, v, u)
        !> On the whole square
        type(patch_type), intent(in) :: whole
        !> What is not above this is not looked for
        real(wp), intent(in) :: known
        !> The greatest value, or a value at a corner where nothing is above `known`
        real(wp), intent(out) :: value
        real(wp), intent(out) :: v, u
        type(patch_type) :: waiting(most_waiting), part
        real(wp) :: slack
        integer :: count

        value = whole%b(0, 0)
        v = 0.0_wp
        u = 0.0_wp
        slack = rounding*maxval(abs(whole%b(0:whole%along, 0:whole%across)))
        count = 1
        waiting(1) = whole
        waiting(1)%v = 0.0_wp
        waiting(1)%u = 0.0_wp
        waiting(1)%width_v = 1.0_wp
        waiting(1)%width_u = 1.0_wp
        call look_at_corners(waiting(1), value, v, u)
        do while (count > 0)
            part = waiting(count)
            count = count - 1
            if (maxval(part%b(0:part%along, 0:part%across)) <= max(value, known) + slack) cycle
            call drop_to_edges(part)
            if (part%along == 0 .and. part%across == 0) cycle
            if (max(part%width_v, part%width_u) < narrowest_patch .or. count + 2 > most_waiting) cycle
            call split(part, waiting(count + 1), waiting(count + 2))
            call look_at_corners(waiting(count + 1), value, v, u)
            call look_at_corners(waiting(count + 2), value, v, u)
            count = count + 2
        end do
        if (value > known - slack) call polish(whole, value, v, u)
    end subroutine greatest_on_patch

    !> Values at the corners are coefficients
    pure subroutine look_at_corners(part, value, v, u)
        type(patch_type), intent(in) :: part
        real(wp), intent(inout) :: value, v, u
        integer :: i, k

        do k = 0, min(1, part%across)
            do i = 0, min(1, part%along)
                associate (corner => part%b(i*part%along, k*part%across))
                    if (.not. corner > value) cycle
                    value = corner
                    v = part%v + i*part%width_v
                    u = part%u + k*part%width_u
                end associate
            end do
        end do
    end subroutine look_at_corners

    !> Where a derivative keeps its sign the greatest value is at an edge
    pure subroutine drop_to_edges(part)
        type(patch_type), intent(inout) :: part

        associate (b => part%b, p => part%along, r => part%across)
            if (r > 0) then
                if (all(b(0:p, 1:r) >= b(0:p, 0:r - 1))) then
                    b(0:p, 0) = b(0:p, r)
                    part%u = part%u + part%width_u
                    part%width_u = 0.0_wp
                    r = 0
                else if (all(b(0:p, 1:r) <= b(0:p, 0:r - 1))) then
                    part%width_u = 0.0_wp
                    r = 0
                end if
            end if
            if (p > 0) then
                if (all(b(1:p, 0:r) >= b(0:p - 1, 0:r))) then
                    b(0, 0:r) = b(p, 0:r)
                    part%v = part%v + part%width_v
                    part%width_v = 0.0_wp
                    p = 0
                else if (all(b(1:p, 0:r) <= b(0:p - 1, 0:r))) then
                    part%width_v = 0.0_wp
                    p = 0
                end if
            end if
        end associate
    end subroutine drop_to_edges

    !> Cut a part in two, across the direction in which it changes more; the second half is that with the greater coefficient
    pure subroutine split(part, first, second)
        type(patch_type), intent(in) :: part
        type(patch_type), intent(out) :: first, second
        type(patch_type) :: left, right
        integer :: j

        left = part
        right = part
        associate (b => part%b, p => part%along, r => part%across)
            if (change(p, r, b, 1) > change(p, r, b, 2)) then
                do j = 0, r
                    call halve(b(0:p, j), 0.5_wp, left%b(0:p, j), right%b(0:p, j))
                end do
                left%width_v = part%width_v/2
                right%width_v = left%width_v
                right%v = part%v + left%width_v
            else
                do j = 0, p
                    call halve(b(j, 0:r), 0.5_wp, left%b(j, 0:r), right%b(j, 0:r))
                end do
                left%width_u = part%width_u/2
                right%width_u = left%width_u
                right%u = part%u + left%width_u
            end if
            if (maxval(left%b(0:p, 0:r)) > maxval(right%b(0:p, 0:r))) then
                first = right
                second = left
            else
                first = left
                second = right
            end if
        end associate
    end subroutine split

    !> How much coefficients change in one direction
    pure function change(p, r, b, direction) result(most)
        integer, intent(in) :: p, r
        real(wp), intent(in) :: b(0:most_along, 0:highest_degree)
        integer, intent(in) :: direction
        real(wp) :: most

        most = -1.0_wp
        if (direction == 1 .and. p > 0) most = p*maxval(abs(b(1:p, 0:r) - b(0:p - 1, 0:r)))
        if (direction == 2 .and. r > 0) most = r*maxval(abs(b(0:p, 1:r) - b(0:p, 0:r - 1)))
    end function change

    !> Newton's method for the place, which bisection finds to half of the digits only: the derivatives are zero there, at an edge
    !> that along it
    pure subroutine polish(whole, value, v, u)
        type(patch_type), intent(in) :: whole
        real(wp), intent(inout) :: value, v, u
        real(wp) :: f, fu, fv, fuu, fuv, fvv, determinant, new_u, new_v
        logical :: free_u, free_v
        integer :: step

        free_u = whole%across > 1 .and. u > 0.0_wp .and. u < 1.0_wp
        free_v = whole%along > 1 .and. v > 0.0_wp .and. v < 1.0_wp
        if (.not. (free_u .or. free_v)) return
        do step = 1, 4
            call derivatives(whole, v, u, f, fu, fv, fuu, fuv, fvv)
            new_u = u
            new_v = v
            if (free_u .and. free_v) then
                determinant = fuu*fvv - fuv**2
                if (.not. (determinant > 0.0_wp .and. fuu < 0.0_wp)) exit
                new_u = u - (fu*fvv - fv*fuv)/determinant
                new_v = v - (fv*fuu - fu*fuv)/determinant
            else if (free_u) then
                if (.not. fuu < 0.0_wp) exit
                new_u = u - fu/fuu
            else
                if (.not. fvv < 0.0_wp) exit
                new_v = v - fv/fvv
            end if
            ! What is found is exact enough for this to be a small step
            if (max(abs(new_u - u), abs(new_v - v)) > 2.0_wp**(-16) .or. min(new_u, new_v, 1 - new_u, 1 - new_v) < 0.0_wp) exit
            u = new_u
            v = new_v
        end do
        call derivatives(whole, v, u, f, fu, fv, fuu, fuv, fvv)
        value = max(value, f)
    end subroutine polish

    !> Value and derivatives at a place
    pure subroutine derivatives(whole, v, u, f, fu, fv, fuu, fuv, fvv)
        type(patch_type), intent(in) :: whole
        real(wp), intent(in) :: v, u
        real(wp), intent(out) :: f, fu, fv, fuu, fuv, fvv
        real(wp) :: along(3, 0:most_along)
        integer :: j, p, r

        p = whole%along
        r = whole%across
        do j = 0, p
            call line(whole%b(j, 0:r), u, along(:, j))
        end do
        block
            real(wp) :: of_value(3), of_slope(3), of_curvature(3)

            call line(along(1, 0:p), v, of_value)
            call line(along(2, 0:p), v, of_slope)
            call line(along(3, 0:p), v, of_curvature)
            f = of_value(1)
            fv = of_value(2)
            fvv = of_value(3)
            fu = of_slope(1)
            fuv = of_slope(2)
            fuu = of_curvature(1)
        end block
    end subroutine derivatives

    !> Value and two derivatives of a polynomial
    pure subroutine line(b, u, found)
        real(wp), intent(in) :: b(0:)
        real(wp), intent(in) :: u
        real(wp), intent(out) :: found(3)
        integer :: n

        n = ubound(b, 1)
        found(:) = [value_of(b, u), 0.0_wp, 0.0_wp]
        if (n > 0) found(2) = n*value_of(b(1:n) - b(0:n - 1), u)
        if (n > 1) found(3) = n*(n - 1)*value_of(b(2:n) - 2*b(1:n - 1) + b(0:n - 2), u)
    end subroutine line

end module gapbeam_bernstein
