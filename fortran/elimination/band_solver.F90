!> A band matrix factored with pivoting, solved and refined by LAPACK's expert driver dgbsvx
module gapbeam_band_solver
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: solve_band

! PyPI's scipy-openblas32 prefixes its symbols
#ifdef SCIPY_OPENBLAS
#define dgbsvx scipy_dgbsvx
#endif

    interface
        subroutine dgbsvx(fact, trans, n, kl, ku, nrhs, ab, ldab, afb, ldafb, ipiv, equed, r, c, b, ldb, &
                          x, ldx, rcond, ferr, berr, work, iwork, info)
            import :: wp
            character(len=1), intent(in) :: fact, trans
            character(len=1), intent(inout) :: equed
            integer, intent(in) :: n, kl, ku, nrhs, ldab, ldafb, ldb, ldx
            real(wp), intent(inout) :: ab(ldab, *), afb(ldafb, *), r(*), c(*), b(ldb, *)
            real(wp), intent(inout) :: x(ldx, *), rcond, ferr(*), berr(*), work(*)
            integer, intent(inout) :: ipiv(*), iwork(*), info
        end subroutine dgbsvx
    end interface

contains

    !> Solve a band system
    subroutine solve_band(half_bandwidth, matrix, b, x, regular)
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
        real(wp), allocatable :: factor(:, :), r(:), c(:), work(:)
        integer, allocatable :: pivot(:), iwork(:)
        real(wp) :: rcond, ferr(1), berr(1)
        character(len=1) :: equed
        integer :: n, info

        n = size(b)
        allocate (factor(3*half_bandwidth + 1, n), r(n), c(n), work(3*n), pivot(n), iwork(n))
        equed = "N"
        call dgbsvx("E", "N", n, half_bandwidth, half_bandwidth, 1, matrix, size(matrix, 1), factor, size(factor, 1), &
                    pivot, equed, r, c, b, n, x, n, rcond, ferr, berr, work, iwork, info)
        regular = info == 0
    end subroutine solve_band

end module gapbeam_band_solver
