!> Interfaces of LAPACK's band solvers, by the names they have in the library that is linked
module yardstick_lapack
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: dgbsv, dgbtrs, dpbtrf, dpbtrs

! PyPI's scipy-openblas32 prefixes its symbols
#ifdef SCIPY_OPENBLAS
#define symbol_dgbsv scipy_dgbsv
#define symbol_dgbtrs scipy_dgbtrs
#define symbol_dpbtrf scipy_dpbtrf
#define symbol_dpbtrs scipy_dpbtrs
#else
#define symbol_dgbsv dgbsv
#define symbol_dgbtrs dgbtrs
#define symbol_dpbtrf dpbtrf
#define symbol_dpbtrs dpbtrs
#endif

    interface dgbsv
        subroutine symbol_dgbsv(n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
            import :: wp
            implicit none
            integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
            real(wp), intent(inout) :: ab(ldab, *), b(ldb, *)
            integer, intent(inout) :: ipiv(*), info
        end subroutine symbol_dgbsv
    end interface dgbsv

    interface dgbtrs
        subroutine symbol_dgbtrs(trans, n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
            import :: wp
            implicit none
            character(len=1), intent(in) :: trans
            integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
            real(wp), intent(in) :: ab(ldab, *)
            integer, intent(in) :: ipiv(*)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(inout) :: info
        end subroutine symbol_dgbtrs
    end interface dgbtrs

    interface dpbtrf
        subroutine symbol_dpbtrf(uplo, n, kd, ab, ldab, info)
            import :: wp
            implicit none
            character(len=1), intent(in) :: uplo
            integer, intent(in) :: n, kd, ldab
            real(wp), intent(inout) :: ab(ldab, *)
            integer, intent(inout) :: info
        end subroutine symbol_dpbtrf
    end interface dpbtrf

    interface dpbtrs
        subroutine symbol_dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
            import :: wp
            implicit none
            character(len=1), intent(in) :: uplo
            integer, intent(in) :: n, kd, nrhs, ldab, ldb
            real(wp), intent(in) :: ab(ldab, *)
            real(wp), intent(inout) :: b(ldb, *)
            integer, intent(inout) :: info
        end subroutine symbol_dpbtrs
    end interface dpbtrs

end module yardstick_lapack
