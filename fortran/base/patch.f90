!> Polynomials of two variables on the unit square in Bernstein form, and their greatest values.
!>
!> Between the least and the greatest coefficient lie all values, so parts of the square that hold nothing greater than what is
!> known are dropped, and the others cut in two. Where a derivative keeps its sign only an edge is left. A field in a cell whose
!> ends move may all but depend on the place alone, as where a light train passes a beam under a great load: then it is nearly the
!> same along a line across the square, and cuts do not end soon. But where its derivative in the position at a place that stays
!> keeps its sign, what is greatest is at the edges at which such places enter or leave.
module gapbeam_patch
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_waiting_patches
    use gapbeam_tolerances, only: narrowest_patch, patch_rounding, newton_leaves
    use gapbeam_bernstein, only: highest_degree, value_of, halve
    implicit none
    private
    public :: patch_type, most_along, greatest_on_patch

    !> Degree in the first variable at most
    integer, parameter :: most_along = 5

    !> A polynomial on the unit square, sum of b(j, k) B_j(v) B_k(u), or on a part of it
    type :: patch_type
        !> Degrees in v and u
        integer :: along, across
        real(wp) :: b(0:most_along, 0:highest_degree)
        !> The part: first v and u, and how far it goes (no default values: many patches are laid out at a time)
        real(wp) :: v, u, width_v, width_u
    end type patch_type

contains

    !> The greatest value on the unit square, and where it is: parts that hold nothing greater are dropped; where one
    !> derivative keeps its sign an edge is left
    pure subroutine greatest_on_patch(whole, known, value, v, u, ends)
        !> On the whole square
        type(patch_type), intent(in) :: whole
        !> What is not above this is not looked for
        real(wp), intent(in) :: known
        !> The greatest value, or a value at a corner where nothing is above `known`
        real(wp), intent(out) :: value
        real(wp), intent(out) :: v, u
        !> Places at v = 0 and 1 (first index) for u = 0 and 1 (second one), linear between: a field in a cell that moves
        real(wp), intent(in), optional :: ends(2, 2)
        type(patch_type) :: waiting(most_waiting_patches), part
        real(wp) :: slack
        integer :: count, rises

        value = whole%b(0, 0)
        v = 0.0_wp
        u = 0.0_wp
        slack = patch_rounding*maxval(abs(whole%b(0:whole%along, 0:whole%across)))
        count = 1
        waiting(1) = whole
        waiting(1)%v = 0.0_wp
        waiting(1)%u = 0.0_wp
        waiting(1)%width_v = 1.0_wp
        waiting(1)%width_u = 1.0_wp
        call raise_to_corners(waiting(1), value, v, u)
        do while (count > 0)
            part = waiting(count)
            count = count - 1
            if (maxval(part%b(0:part%along, 0:part%across)) <= max(value, known) + slack) cycle
            call drop_to_edges(part)
            if (part%along == 0 .and. part%across == 0) cycle
            if (max(part%width_v, part%width_u) < narrowest_patch .or. count + 3 > most_waiting_patches) cycle
            if (present(ends) .and. part%along > 0 .and. part%across > 0) then
                rises = way_at_places(part, ends, slack)
                if (rises /= 0) then
                    waiting(count + 1:count + 3) = part
                    call keep_across(merge(part%across, 0, rises > 0), waiting(count + 1))
                    call keep_along(0, waiting(count + 2))
                    call keep_along(part%along, waiting(count + 3))
                    count = count + 3
                    cycle
                end if
            end if
            call split(part, waiting(count + 1), waiting(count + 2))
            call raise_to_corners(waiting(count + 1), value, v, u)
            call raise_to_corners(waiting(count + 2), value, v, u)
            count = count + 2
        end do
        if (value > known - slack) call polish(whole, value, v, u)
    end subroutine greatest_on_patch

    !> Values at the corners are coefficients
    pure subroutine raise_to_corners(part, value, v, u)
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
    end subroutine raise_to_corners

    !> Where a derivative keeps its sign the greatest value is at an edge
    pure subroutine drop_to_edges(part)
        type(patch_type), intent(inout) :: part

        associate (b => part%b, p => part%along, r => part%across)
            if (r > 0) then
                if (all(b(0:p, 1:r) >= b(0:p, 0:r - 1))) then
                    call keep_across((r), part)
                else if (all(b(0:p, 1:r) <= b(0:p, 0:r - 1))) then
                    call keep_across(0, part)
                end if
            end if
            if (p > 0) then
                if (all(b(1:p, 0:r) >= b(0:p - 1, 0:r))) then
                    call keep_along((p), part)
                else if (all(b(1:p, 0:r) <= b(0:p - 1, 0:r))) then
                    call keep_along(0, part)
                end if
            end if
        end associate
    end subroutine drop_to_edges

    !> Keep the first or the last edge in the direction of u
    pure subroutine keep_across(k, part)
        !> 0 or the degree
        integer, intent(in) :: k
        type(patch_type), intent(inout) :: part

        if (k > 0) then
            part%b(0:part%along, 0) = part%b(0:part%along, k)
            part%u = part%u + part%width_u
        end if
        part%width_u = 0.0_wp
        part%across = 0
    end subroutine keep_across

    !> The same in the direction of v
    pure subroutine keep_along(j, part)
        integer, intent(in) :: j
        type(patch_type), intent(inout) :: part

        if (j > 0) then
            part%b(0, 0:part%across) = part%b(j, 0:part%across)
            part%v = part%v + part%width_v
        end if
        part%width_v = 0.0_wp
        part%along = 0
    end subroutine keep_along

    !> Does the value rise (1) or fall (-1) with u all over a part at every place that stays, but for rounding; 0 where it is not
    !> known. With x = a(u) + v l(u) the derivative there, times l > 0, is l f_u - (a' + v l') f_v
    pure function way_at_places(part, ends, slack) result(way)
        type(patch_type), intent(in) :: part
        !> As for greatest_on_patch
        real(wp), intent(in) :: ends(2, 2)
        !> What coefficients of the part are off
        real(wp), intent(in) :: slack
        integer :: way
        real(wp) :: c(0:part%along, 0:part%across), l(0:1), speed(0:1), lost
        integer :: j, k

        associate (b => part%b, p => part%along, r => part%across)
            l(0) = (ends(2, 1) - ends(1, 1))*(1 - part%u) + (ends(2, 2) - ends(1, 2))*part%u
            l(1) = l(0) + ((ends(2, 2) - ends(2, 1)) - (ends(1, 2) - ends(1, 1)))*part%width_u
            speed(0) = (ends(1, 2) - ends(1, 1))*(1 - part%v) + (ends(2, 2) - ends(2, 1))*part%v
            speed(1) = speed(0) + ((ends(2, 2) - ends(2, 1)) - (ends(1, 2) - ends(1, 1)))*part%width_v
            l(:) = l*part%width_v
            speed(:) = speed*part%width_u
            do k = 0, r
                do j = 0, p
                    c(j, k) = 0.0_wp
                    if (k < r) c(j, k) = c(j, k) + (r - k)*l(0)*(b(j, k + 1) - b(j, k))
                    if (k > 0) c(j, k) = c(j, k) + k*l(1)*(b(j, k) - b(j, k - 1))
                    if (j < p) c(j, k) = c(j, k) - (p - j)*speed(0)*(b(j + 1, k) - b(j, k))
                    if (j > 0) c(j, k) = c(j, k) - j*speed(1)*(b(j, k) - b(j - 1, k))
                end do
            end do
            lost = slack*(max(l(0), l(1)) + maxval(abs(speed)))
            way = 0
            if (.not. min(l(0), l(1)) >= 0.0_wp) return
            if (all(c >= -lost)) then
                way = 1
            else if (all(c <= lost)) then
                way = -1
            end if
        end associate
    end function way_at_places

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
            if (max(abs(new_u - u), abs(new_v - v)) > newton_leaves .or. min(new_u, new_v, 1 - new_u, 1 - new_v) < 0.0_wp) exit
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
        real(wp), intent(in) :: b(0:), u
        real(wp), intent(out) :: found(3)
        integer :: n

        n = ubound(b, 1)
        found(:) = [value_of(b, u), 0.0_wp, 0.0_wp]
        if (n > 0) found(2) = n*value_of(b(1:n) - b(0:n - 1), u)
        if (n > 1) found(3) = n*(n - 1)*value_of(b(2:n) - 2*b(1:n - 1) + b(0:n - 2), u)
    end subroutine line

end module gapbeam_patch
