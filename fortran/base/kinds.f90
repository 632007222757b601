!> The real kinds of the engine, and what is no finite number
module gapbeam_kinds
    use, intrinsic :: iso_c_binding, only: c_double
    use, intrinsic :: iso_fortran_env, only: int64, real128
    implicit none
    private
    public :: wp, dp, qp, infinity, not_a_number

    !> Working precision: IEEE double, the same as C's
    integer, parameter :: wp = c_double
    !> The same under another name, for what is compiled in quadruple precision as well, where wp is that
    integer, parameter :: dp = c_double
    !> Quadruple precision, for what doubles cannot decide
    integer, parameter :: qp = real128
    !> Constants: whatever uses a module that uses ieee_arithmetic, outside of modules, saves the processor's state each time it is
    !> called
    real(wp), parameter :: infinity = transfer(int(z"7FF0000000000000", int64), 1.0_wp)
    real(wp), parameter :: not_a_number = transfer(int(z"7FF8000000000000", int64), 1.0_wp)
end module gapbeam_kinds
