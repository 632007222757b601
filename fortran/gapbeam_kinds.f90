!> The one real kind of the engine
module gapbeam_kinds
    use, intrinsic :: iso_c_binding, only: c_double
    implicit none
    private
    public :: wp

    !> Working precision: IEEE double, the same as C's
    integer, parameter :: wp = c_double
end module gapbeam_kinds
