!> The band solver in quadruple precision: against known solutions, against LAPACK's in double precision, singular matrices
program test_band_solver
    use testing, only: check, check_close, finish
    use beams, only: draw
    use gapbeam_kinds, only: wp, qp
    use gapbeam_band_solver, only: solve_band
    use gapbeam_band_solver_quad, only: solve_fine_band => solve_band
    implicit none
    !> Half bandwidth, and unknowns
    integer, parameter :: m = 3, n = 40
    integer :: status

    call known_solutions()
    call the_digits_of_lapack()
    call singular_matrices()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A band matrix of numbers between -1 and 1 with zeros on its diagonal now and then, so that rows must be exchanged
    subroutine draw_matrix(seed, matrix)
        integer, intent(inout) :: seed
        real(qp), intent(out) :: matrix(2*m + 1, n)
        integer :: i, j

        matrix(:, :) = 0.0_qp
        do j = 1, n
            do i = max(1, j - m), min(n, j + m)
                if (i /= j .or. draw(seed) < 0.7_wp) matrix(m + 1 + i - j, j) = 2*draw(seed) - 1
            end do
        end do
    end subroutine draw_matrix

    !> Matrix times vector
    pure function product_of(matrix, x) result(b)
        real(qp), intent(in) :: matrix(2*m + 1, n), x(n)
        real(qp) :: b(n)
        integer :: i, j

        b(:) = 0.0_qp
        do j = 1, n
            do i = max(1, j - m), min(n, j + m)
                b(i) = b(i) + matrix(m + 1 + i - j, j)*x(j)
            end do
        end do
    end function product_of

    !> Other units: every row, and unknowns of two kinds, multiplied with powers of two, which changes no digit
    subroutine scale_matrix(seed, matrix, rows, columns)
        integer, intent(inout) :: seed
        real(qp), intent(inout) :: matrix(2*m + 1, n)
        real(qp), intent(out) :: rows(n), columns(n)
        integer :: i, j

        do i = 1, n
            rows(i) = 2.0_qp**int(400*draw(seed) - 200)
        end do
        columns(1::2) = 2.0_qp**int(400*draw(seed) - 200)
        columns(2::2) = 2.0_qp**int(400*draw(seed) - 200)
        do j = 1, n
            do i = max(1, j - m), min(n, j + m)
                matrix(m + 1 + i - j, j) = rows(i)*matrix(m + 1 + i - j, j)*columns(j)
            end do
        end do
    end subroutine scale_matrix

    !> Right-hand sides made from solutions, which come back with nearly all their digits, whatever the units
    subroutine known_solutions()
        real(qp) :: matrix(2*m + 1, n), kept(2*m + 1, n), rows(n), columns(n), x(n), found(n), b(n), worst, worst_scaled
        logical :: regular, all_regular
        integer :: seed, trial, i

        seed = 5
        worst = 0.0_qp
        worst_scaled = 0.0_qp
        all_regular = .true.
        do trial = 1, 100
            call draw_matrix(seed, matrix)
            kept(:, :) = matrix
            x = [(real(2*draw(seed) - 1, qp), i=1, n)]
            b = product_of(matrix, x)
            call solve_fine_band(m, matrix, b, found, regular)
            all_regular = all_regular .and. regular
            worst = max(worst, maxval(abs(found - x)))
            matrix(:, :) = kept
            call scale_matrix(seed, matrix, rows, columns)
            b = rows*product_of(kept, x)
            call solve_fine_band(m, matrix, b, found, regular)
            all_regular = all_regular .and. regular
            worst_scaled = max(worst_scaled, maxval(abs(found*columns - x)))
        end do
        call check(all_regular, "all regular")
        call check(worst < 1e-27_qp, "known solutions come back")
        call check(worst_scaled < 1e-27_qp, "whatever the units")
    end subroutine known_solutions

    !> Rounded, the solution is that of LAPACK
    subroutine the_digits_of_lapack()
        real(qp) :: matrix(2*m + 1, n), b(n), found(n)
        real(wp) :: rounded(2*m + 1, n), rounded_b(n), x(n)
        logical :: regular, fine_regular
        integer :: seed, trial, i

        seed = 6
        do trial = 1, 20
            call draw_matrix(seed, matrix)
            b = [(real(2*draw(seed) - 1, qp), i=1, n)]
            rounded(:, :) = real(matrix, wp)
            rounded_b(:) = real(b, wp)
            call solve_band(m, rounded, rounded_b, x, regular)
            call solve_fine_band(m, matrix, b, found, fine_regular)
            call check(regular .and. fine_regular, "regular in both precisions")
            call check_close(x, real(found, wp), "the same digits", 1e-11_wp)
        end do
    end subroutine the_digits_of_lapack

    !> Singular matrices are found, nearly singular ones solved as long as quadruple precision sees the difference
    subroutine singular_matrices()
        real(qp) :: matrix(2*m + 1, n), kept(2*m + 1, n), b(n), found(n), x(n)
        real(wp) :: rounded(2*m + 1, n), rounded_b(n), rounded_x(n)
        logical :: regular
        integer :: seed, i, j

        seed = 7
        call draw_matrix(seed, kept)
        matrix(:, :) = kept
        matrix(:, n/2) = 0.0_qp
        b(:) = 1.0_qp
        call solve_fine_band(m, matrix, b, found, regular)
        call check(.not. regular, "a column of zeros")
        matrix(:, :) = kept
        do j = 1, n
            i = n/2
            if (abs(i - j) <= m) matrix(m + 1 + i - j, j) = 0.0_qp
        end do
        b(:) = 1.0_qp
        call solve_fine_band(m, matrix, b, found, regular)
        call check(.not. regular, "a row of zeros")
        call equal_rows(kept, 0.0_qp, matrix)
        b(:) = 1.0_qp
        call solve_fine_band(m, matrix, b, found, regular)
        call check(.not. regular, "two rows that are multiples of each other")
        call equal_rows(kept, 2.0_qp**(-60), matrix)
        rounded(:, :) = real(matrix, wp)
        rounded_b(:) = 1.0_wp
        call solve_band(m, rounded, rounded_b, rounded_x, regular)
        call check(.not. regular, "two rows that differ by 2**-60, in double precision")
        x(:) = 1.0_qp
        b = product_of(matrix, x)
        call solve_fine_band(m, matrix, b, found, regular)
        call check(regular, "and in quadruple precision")
        call check(maxval(abs(found - x)) < 1e-10_qp, "which solves it")
    end subroutine singular_matrices

    !> The middle row and a multiple of it below, but for a small difference in one column
    subroutine equal_rows(matrix, difference, changed)
        real(qp), intent(in) :: matrix(2*m + 1, n), difference
        real(qp), intent(out) :: changed(2*m + 1, n)
        integer :: i, j

        i = n/2
        changed(:, :) = matrix
        do j = i - m, i + m + 1
            ! Where only one of the two rows reaches
            if (j == i - m) changed(m + 1 + i - j, j) = 0.0_qp
            if (j == i + m + 1) changed(m + 1 + i + 1 - j, j) = 0.0_qp
            if (j > i - m .and. j <= i + m) changed(m + 1 + i + 1 - j, j) = 3*changed(m + 1 + i - j, j)
        end do
        changed(m + 1 + 1, i) = changed(m + 1 + 1, i) + difference
    end subroutine equal_rows

end program test_band_solver
