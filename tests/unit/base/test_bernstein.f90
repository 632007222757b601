!> Polynomials by their Bernstein coefficients
program test_bernstein
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_bernstein, only: highest_degree, sample_points, to_coefficients, value_of, halve, part_of, find_greatest, first_below, &
        crossing
    use gapbeam_patch, only: patch_type, greatest_on_patch
    implicit none
    integer :: status

    call samples_give_the_polynomial_back()
    call greatest_on_a_part()
    call first_place_below()
    call greatest_of_two_variables()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Of every degree
    subroutine samples_give_the_polynomial_back()
        real(wp) :: points(0:highest_degree), b(0:highest_degree), left(0:highest_degree), right(0:highest_degree)
        real(wp) :: matrix(0:highest_degree, 0:highest_degree)
        integer :: n

        do n = 0, highest_degree
            points(0:n) = sample_points(n)
            matrix(0:n, 0:n) = to_coefficients(n)
            b(0:n) = matmul(matrix(0:n, 0:n), (points(0:n) - 0.3_wp)**n)
            call check_close(value_of(b(0:n), 0.8_wp), 0.5_wp**n, "a power")
            call halve(b(0:n), 0.6_wp, left(0:n), right(0:n))
            call check_close(value_of(left(0:n), 0.5_wp), 0.0_wp**n, "a power on the left part", absolute=1e-15_wp)
            call check_close(value_of(right(0:n), 0.5_wp), 0.5_wp**n, "a power on the right part")
        end do
    end subroutine samples_give_the_polynomial_back

    !> Inside, at an end, or everywhere
    subroutine greatest_on_a_part()
        real(wp) :: b(0:4), matrix(0:4, 0:4), value, u

        ! 1 - (u - 1/4)**2 (u + 1)**2, with another peak at -1
        matrix(:, :) = to_coefficients(4)
        b(:) = sample_points(4)
        b(:) = matmul(matrix, 1 - (b - 0.25_wp)**2*(b + 1)**2)
        call find_greatest(b, value, u)
        call check_close(value, 1.0_wp, "a peak")
        call check_close(u, 0.25_wp, "where it is")
        call find_greatest(part_of(b, 0.5_wp, 0.75_wp), value, u)
        call check_close(value, 1 - 0.0625_wp*2.25_wp, "falling on a part")
        call check_close(u, 0.0_wp, "from its beginning")
        call find_greatest(part_of(b, 0.0_wp, 0.125_wp), value, u)
        call check_close(value, 1 - 0.015625_wp*1.265625_wp, "rising on the first part")
        call find_greatest(part_of(b, 1.0_wp, 1.0_wp), value, u)
        call check_close(value, 1 - 0.5625_wp*4, "at a point")
        call find_greatest([3.0_wp], value, u)
        call check_close(value, 3.0_wp, "the same everywhere")
    end subroutine greatest_on_a_part

    !> A level that is touched, crossed, or not reached
    subroutine first_place_below()
        real(wp) :: b(0:2), matrix(0:2, 0:2), u

        ! (u - 1/4)**2
        matrix(:, :) = to_coefficients(2)
        b(:) = sample_points(2)
        b(:) = matmul(matrix, (b - 0.25_wp)**2)
        call check(first_below(b, -1e-9_wp) > 1.0_wp, "touched, not crossed")
        u = first_below(b - 1.0_wp/64, 0.0_wp)
        call check_close(u, 0.125_wp, "crossed")
        call check_close(crossing(b - 1.0_wp/64, 0.0_wp, 0.2_wp), 0.125_wp, "where")
        call check_close(first_below(b, 1.0_wp), 0.0_wp, "from the beginning")
    end subroutine first_place_below

    !> A peak inside, one at an edge, one at a corner, none above what is known
    subroutine greatest_of_two_variables()
        type(patch_type) :: patch
        real(wp) :: points(0:4), matrix(0:4, 0:4), values(0:4, 0:4), value, v, u
        real(wp), parameter :: small = 1e-9_wp
        integer :: j, k

        patch%along = 4
        patch%across = 4
        points(:) = sample_points(4)
        matrix(:, :) = to_coefficients(4)
        do k = 0, 4
            do j = 0, 4
                values(j, k) = peak(points(j), points(k))
            end do
        end do
        patch%b(0:4, 0:4) = matmul(matmul(matrix, values), transpose(matrix))
        call greatest_on_patch(patch, -1.0_wp, value, v, u)
        call check_close([value, v, u], [3.0_wp, 0.7_wp, 0.2_wp], "inside", 1e-12_wp)
        call greatest_on_patch(patch, 4.0_wp, value, v, u)
        call check(value < 3.5_wp, "nothing above what is known")
        patch%b(0:4, 0:4) = -patch%b(0:4, 0:4)
        call greatest_on_patch(patch, -10.0_wp, value, v, u)
        call check_close([value, v, u], [-peak(1.0_wp, 1.0_wp), 1.0_wp, 1.0_wp], "at a corner")
        patch%along = 2
        patch%across = 6
        do k = 0, 6
            patch%b(0:2, k) = [0.0_wp, 1.0_wp, 0.0_wp] + 4*mod(k, 2)*epsilon(1.0_wp)
        end do
        call greatest_on_patch(patch, -1.0_wp, value, v, u)
        call check_close([value, v], [0.5_wp, 0.5_wp], "the same in one direction but for rounding")
        ! Next to nothing moves over what stays: x = u + v, at x = 1 with a little more on the right
        do k = 0, 4
            do j = 0, 4
                values(j, k) = 1 - (points(j) + points(k) - 1)**2 + small*points(k)
            end do
        end do
        patch%along = 4
        patch%across = 4
        patch%b(0:4, 0:4) = matmul(matmul(matrix, values), transpose(matrix))
        call greatest_on_patch(patch, -1.0_wp, value, v, u, reshape([0.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2]))
        call check_close([value, u], [1 + small, 1.0_wp], "nearly the same along a line", 1e-14_wp)
        patch%along = 0
        patch%across = 2
        patch%b(0, 0:2) = [0.0_wp, 1.0_wp, 0.0_wp]
        call greatest_on_patch(patch, -1.0_wp, value, v, u)
        call check_close([value, u], [0.5_wp, 0.5_wp], "of one variable")
    end subroutine greatest_of_two_variables

    !> 3 at (0.7, 0.2)
    pure function peak(v, u) result(value)
        real(wp), intent(in) :: v, u
        real(wp) :: value

        value = 3 - (v - 0.7_wp)**2 - (v - 0.7_wp)*(u - 0.2_wp) - 2*(u - 0.2_wp)**2 - (v - 0.7_wp)**2*(u - 0.2_wp)**2
    end function peak

end program test_bernstein
