!> A band matrix in quadruple precision, factored with pivoting and solved.
!> LAPACK has that in double precision only.
module gapbeam_band_solver_quad
    use gapbeam_kinds, only: wp => qp
    use gapbeam_tolerances, only: least_quad_pivot
    implicit none
    private
    public :: solve_band

contains

    !> Solve a band system (Golub and Van Loan, Matrix Computations, 4.3.5): rows and columns equilibrated, partial pivoting
    pure subroutine solve_band(half_bandwidth, matrix, b, x, regular)
        !> Diagonals on either side of the main one
        integer, intent(in) :: half_bandwidth
        !> Element (i, j) in row half_bandwidth + 1 + i - j of column j, shape (2 half_bandwidth + 1, n); overwritten
        real(wp), intent(inout) :: matrix(:, :)
        !> Right-hand side, shape (n); overwritten
        real(wp), intent(inout) :: b(:)
        !> The solution, shape (n)
        real(wp), intent(out) :: x(:)
        !> False where the matrix is singular to working precision
        logical, intent(out) :: regular
        real(wp), allocatable :: row(:, :), scale(:)
        real(wp) :: swap(0:2*half_bandwidth), multiplier
        integer :: i, j, k, n, m, pivot

        n = size(b)
        m = half_bandwidth
        ! row(:, i) holds columns i - m to i + 2 m of row i
        allocate (row(-m:2*m, n), scale(n), source=0.0_wp)
        regular = .false.
        do i = 1, n
            do j = max(1, i - m), min(n, i + m)
                row(j - i, i) = matrix(m + 1 + i - j, j)
            end do
            multiplier = maxval(abs(row(:, i)))
            if (.not. multiplier > 0.0_wp) return
            row(:, i) = row(:, i)/multiplier
            b(i) = b(i)/multiplier
            do j = max(1, i - m), min(n, i + m)
                scale(j) = max(scale(j), abs(row(j - i, i)))
            end do
        end do
        if (.not. all(scale > 0.0_wp)) return
        do i = 1, n
            do j = max(1, i - m), min(n, i + m)
                row(j - i, i) = row(j - i, i)/scale(j)
            end do
        end do
        do k = 1, n
            pivot = k
            do i = k + 1, min(n, k + m)
                if (abs(row(k - i, i)) > abs(row(k - pivot, pivot))) pivot = i
            end do
            if (.not. abs(row(k - pivot, pivot)) > least_quad_pivot) return
            if (pivot /= k) then
                swap(:) = row(0:2*m, k)
                row(0:2*m, k) = row(k - pivot:k - pivot + 2*m, pivot)
                row(k - pivot:k - pivot + 2*m, pivot) = swap
                multiplier = b(k)
                b(k) = b(pivot)
                b(pivot) = multiplier
            end if
            do i = k + 1, min(n, k + m)
                multiplier = row(k - i, i)/row(0, k)
                row(k - i:k - i + 2*m, i) = row(k - i:k - i + 2*m, i) - multiplier*row(0:2*m, k)
                b(i) = b(i) - multiplier*b(k)
            end do
        end do
        do k = n, 1, -1
            x(k) = b(k)
            do j = k + 1, min(n, k + 2*m)
                x(k) = x(k) - row(j - k, k)*x(j)
            end do
            x(k) = x(k)/row(0, k)
        end do
        x(:) = x/scale
        regular = .true.
    end subroutine solve_band

end module gapbeam_band_solver_quad
