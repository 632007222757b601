!> The floating-point environment (rounding, traps, flags) of whoever calls the library: held while it works, then restored. Every
!> procedure of the Fortran interface that computes does so, and with it every one of C and Fortran 77
module gapbeam_environment
    use, intrinsic :: iso_c_binding, only: c_long_long
    implicit none
    private
    public :: environment_type, hold_environment

    !> That of the caller, restored where the variable ends
    type :: environment_type
        private
        logical :: held = .false.
        !> As struct environment in environment.c, which alone reads and writes it
        integer(c_long_long) :: room(32)
    contains
        final :: restore_environment
    end type environment_type

    interface
        !> Keep the environment of the caller, and go on in IEEE's default rounding with all traps off
        subroutine hold(room) bind(c, name="gb_environment_hold")
            import :: c_long_long
            implicit none
            integer(c_long_long), intent(out) :: room(32)
        end subroutine hold

        !> Go on in the environment of the caller
        subroutine restore(room) bind(c, name="gb_environment_restore")
            import :: c_long_long
            implicit none
            integer(c_long_long), intent(in) :: room(32)
        end subroutine restore
    end interface

contains

    !> Keep the environment of the caller until the procedure that asks for it ends, and go on in the default one
    subroutine hold_environment(environment)
        type(environment_type), intent(inout) :: environment

        call hold(environment%room)
        environment%held = .true.
    end subroutine hold_environment

    !> Go on in the environment of the caller
    subroutine restore_environment(environment)
        type(environment_type), intent(inout) :: environment

        if (environment%held) call restore(environment%room)
    end subroutine restore_environment

end module gapbeam_environment
