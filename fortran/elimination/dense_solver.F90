!> Small dense systems by LAPACK: least squares where the matrix may be singular, eigenvalues of symmetric matrices, singular values
module gapbeam_dense_solver
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: solve_least_squares, symmetric_eigenvalues, find_singular_values

! PyPI's scipy-openblas32 prefixes its symbols
#ifdef SCIPY_OPENBLAS
#define dgelsd scipy_dgelsd
#define dsyev scipy_dsyev
#define dgesdd scipy_dgesdd
#endif

    interface
        subroutine dgelsd(m, n, nrhs, a, lda, b, ldb, s, rcond, rank, work, lwork, iwork, info)
            import :: wp
            integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
            real(wp), intent(in) :: rcond
            real(wp), intent(inout) :: a(lda, *), b(ldb, *), s(*), work(*)
            integer, intent(inout) :: iwork(*), rank, info
        end subroutine dgelsd

        subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
            import :: wp
            character(len=1), intent(in) :: jobz, uplo
            integer, intent(in) :: n, lda, lwork
            real(wp), intent(inout) :: a(lda, *), w(*), work(*)
            integer, intent(inout) :: info
        end subroutine dsyev

        subroutine dgesdd(jobz, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, iwork, info)
            import :: wp
            character(len=1), intent(in) :: jobz
            integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
            real(wp), intent(inout) :: a(lda, *), s(*), u(ldu, *), vt(ldvt, *), work(*)
            integer, intent(inout) :: iwork(*), info
        end subroutine dgesdd
    end interface

contains

    !> The least solution with the least residual (dgelsd)
    subroutine solve_least_squares(matrix, columns, smallest, solutions, solved)
        !> Shape (m, n)
        real(wp), intent(in) :: matrix(:, :)
        !> Right-hand sides, shape (m, k)
        real(wp), intent(in) :: columns(:, :)
        !> Singular values below this share of the largest one are none
        real(wp), intent(in) :: smallest
        !> Shape (n, k)
        real(wp), intent(out) :: solutions(:, :)
        !> False where the iteration for the singular values did not settle
        logical, intent(out) :: solved
        real(wp), allocatable :: a(:, :), b(:, :), values(:), work(:)
        integer, allocatable :: iwork(:)
        real(wp) :: length(1)
        integer :: m, n, k, rank, info, first(1)

        m = size(matrix, 1)
        n = size(matrix, 2)
        k = size(columns, 2)
        allocate (a(m, n), b(max(m, n), k), values(min(m, n)))
        a(:, :) = matrix
        b(:, :) = 0.0_wp
        b(:m, :) = columns
        call dgelsd(m, n, k, a, m, b, max(m, n), values, smallest, rank, length, -1, first, info)
        allocate (work(nint(length(1))), iwork(first(1)))
        call dgelsd(m, n, k, a, m, b, max(m, n), values, smallest, rank, work, size(work), iwork, info)
        solved = info == 0
        solutions(:, :) = b(:n, :)
    end subroutine solve_least_squares

    !> Eigenvalues of a symmetric matrix (dsyev)
    subroutine symmetric_eigenvalues(matrix, values, solved)
        !> Its upper triangle in; the eigenvectors out, a column each
        real(wp), intent(inout) :: matrix(:, :)
        !> In ascending order
        real(wp), intent(out) :: values(:)
        !> False where the iteration did not settle
        logical, intent(out) :: solved
        real(wp), allocatable :: work(:)
        real(wp) :: length(1)
        integer :: n, info

        n = size(values)
        call dsyev("V", "U", n, matrix, n, values, length, -1, info)
        allocate (work(nint(length(1))))
        call dsyev("V", "U", n, matrix, n, values, work, size(work), info)
        solved = info == 0
    end subroutine symmetric_eigenvalues

    !> Singular values of a matrix that is not higher than wide, and the directions that belong to them (dgesdd)
    subroutine find_singular_values(matrix, values, directions, solved)
        !> Shape (m, n), m <= n
        real(wp), intent(in) :: matrix(:, :)
        !> In descending order, shape (m)
        real(wp), intent(out) :: values(:)
        !> Right singular vectors, a row each, those beyond the m-th with the singular value 0, shape (n, n)
        real(wp), intent(out) :: directions(:, :)
        !> False where the iteration did not settle
        logical, intent(out) :: solved
        real(wp), allocatable :: a(:, :), left(:, :), work(:)
        integer, allocatable :: iwork(:)
        real(wp) :: length(1)
        integer :: m, n, info

        m = size(matrix, 1)
        n = size(matrix, 2)
        allocate (a(m, n), left(m, m), iwork(8*m))
        a(:, :) = matrix
        call dgesdd("A", m, n, a, m, values, left, m, directions, n, length, -1, iwork, info)
        allocate (work(nint(length(1))))
        call dgesdd("A", m, n, a, m, values, left, m, directions, n, work, size(work), iwork, info)
        solved = info == 0
    end subroutine find_singular_values

end module gapbeam_dense_solver
