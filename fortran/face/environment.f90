!> The floating-point environment (rounding, traps, flags) of whoever calls the library: held while it works, then restored. Every
!> procedure of the Fortran interface that computes does both, and with it every one of C and Fortran 77
module gapbeam_environment
    use, intrinsic :: iso_c_binding, only: c_long_long
    implicit none
    private
    public :: environment_type, hold_environment, restore_environment

    !> As struct environment in environment.c, which alone reads and writes it
    type, bind(c) :: environment_type
        private
        integer(c_long_long) :: room(32)
    end type environment_type

    interface
        !> Keep the environment of the caller, and go on in IEEE's default rounding with all traps off
        subroutine hold_environment(environment) bind(c, name="gb_environment_hold")
            import :: environment_type
            implicit none
            !> That of the caller
            type(environment_type), intent(out) :: environment
        end subroutine hold_environment

        !> Go on in the environment of the caller
        subroutine restore_environment(environment) bind(c, name="gb_environment_restore")
            import :: environment_type
            implicit none
            !> From hold_environment
            type(environment_type), intent(in) :: environment
        end subroutine restore_environment
    end interface

end module gapbeam_environment
