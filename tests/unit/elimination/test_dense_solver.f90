!> Small dense systems: known solutions, what is left out where the matrix is singular, and known eigenvalues
program test_dense_solver
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_dense_solver, only: solve_least_squares, symmetric_eigenvalues, find_singular_values
    implicit none
    integer :: status

    call least_squares()
    call eigenvalues()
    call singular_values()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two columns at once; of a singular matrix the least solution
    subroutine least_squares()
        real(wp) :: matrix(3, 3), found(3, 2), columns(3, 2), wide(1, 2), least(2, 1)
        logical :: solved

        matrix = reshape([4.0_wp, 1.0_wp, 0.0_wp, 2.0_wp, 5.0_wp, 1.0_wp, 0.0_wp, 3.0_wp, 6.0_wp], [3, 3])
        columns(:, 1) = matmul(matrix, [1.0_wp, -2.0_wp, 3.0_wp])
        columns(:, 2) = matmul(matrix, [0.5_wp, 0.0_wp, -1.0_wp])
        call solve_least_squares(matrix, columns, 1e-6_wp, found, solved)
        call check(solved, "settled")
        call check_close(found(:, 1), [1.0_wp, -2.0_wp, 3.0_wp], "a known solution", 1e-14_wp)
        call check_close(found(:, 2), [0.5_wp, 0.0_wp, -1.0_wp], "and another one", 1e-14_wp)
        ! Its third column is the sum of the others, but for less than counts
        matrix(:, 3) = matrix(:, 1) + matrix(:, 2) + [1e-9_wp, 0.0_wp, 0.0_wp]
        columns(:, 1) = matmul(matrix(:, :2), [1.0_wp, 1.0_wp])
        call solve_least_squares(matrix, columns, 1e-6_wp, found, solved)
        call check_close(found(:, 1), [1.0_wp, 1.0_wp, 2.0_wp]/3, "the least solution", 1e-8_wp)
        wide(1, :) = [3.0_wp, 4.0_wp]
        call solve_least_squares(wide, reshape([25.0_wp], [1, 1]), 1e-6_wp, least, solved)
        call check_close(least(:, 1), [3.0_wp, 4.0_wp], "fewer equations than unknowns", 1e-14_wp)
    end subroutine least_squares

    !> Those of 2 on the diagonal and -1 beside it are 2 - 2 cos(k pi/(n + 1))
    subroutine eigenvalues()
        integer, parameter :: n = 7
        real(wp), parameter :: pi = acos(-1.0_wp)
        real(wp) :: matrix(n, n), kept(n, n), values(n)
        logical :: solved
        integer :: i

        matrix(:, :) = 0.0_wp
        do i = 1, n
            matrix(i, i) = 2.0_wp
        end do
        do i = 1, n - 1
            matrix(i, i + 1) = -1.0_wp
            matrix(i + 1, i) = -1.0_wp
        end do
        kept(:, :) = matrix
        call symmetric_eigenvalues(matrix, values, solved)
        call check(solved, "settled")
        call check_close(values, [(2 - 2*cos(i*pi/(n + 1)), i=1, n)], "known eigenvalues", 1e-14_wp)
        call check_close(matmul(kept, matrix(:, 3)), values(3)*matrix(:, 3), "with their vectors", 1e-14_wp)
    end subroutine eigenvalues

    !> A matrix of rank 1, and the directions that it leaves out
    subroutine singular_values()
        real(wp) :: matrix(2, 3), values(2), directions(3, 3)
        logical :: solved

        matrix(1, :) = [1.0_wp, 2.0_wp, 2.0_wp]
        matrix(2, :) = -2*matrix(1, :)
        call find_singular_values(matrix, values, directions, solved)
        call check(solved, "settled")
        call check_close(values, [3*sqrt(5.0_wp), 0.0_wp], "known singular values", 1e-14_wp)
        call check_close(abs(matmul(directions, matrix(1, :))), [3.0_wp, 0.0_wp, 0.0_wp], "known directions", 1e-14_wp)
    end subroutine singular_values

end program test_dense_solver
