!> The real kinds of the engine
module gapbeam_kinds
    use, intrinsic :: iso_c_binding, only: c_double
    use, intrinsic :: iso_fortran_env, only: real128
    implicit none
    private
    public :: wp, dp, qp

    !> Working precision: IEEE double, the same as C's
    integer, parameter :: wp = c_double
    !> The same under another name, for what is compiled in quadruple precision as well, where wp is that
    integer, parameter :: dp = c_double
    !> Quadruple precision, for what doubles cannot decide
    integer, parameter :: qp = real128
end module gapbeam_kinds
