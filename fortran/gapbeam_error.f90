!> Status codes and errors. Outcomes carry data and are no errors: a scene without equilibrium is valid.
module gapbeam_error
    implicit none
    private
    public :: error_type, fatal_error
    public :: gapbeam_solved, gapbeam_no_equilibrium
    public :: gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite

    !> Outcome: the scene is solved
    integer, parameter :: gapbeam_solved = 0
    !> Outcome: a free motion along which nothing resists; no numbers are returned
    integer, parameter :: gapbeam_no_equilibrium = 1
    !> Error: a rigid stretch rests on more rigid supports than statics can tell apart
    integer, parameter :: gapbeam_indeterminate = 12
    !> Error: the working scheme could not be settled in the precision at hand
    integer, parameter :: gapbeam_not_converged = 13
    !> Error: numbers left the range of double precision
    integer, parameter :: gapbeam_not_finite = 14

    !> An error: allocated means failed
    type :: error_type
        !> One of the codes above
        integer :: code
        !> What happened, where, and what to do about it
        character(len=:), allocatable :: message
    end type error_type

contains

    !> Set an error
    pure subroutine fatal_error(error, code, message)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        !> One of the codes of this module
        integer, intent(in) :: code
        !> Text for the user
        character(len=*), intent(in) :: message

        allocate (error)
        error%code = code
        error%message = message
    end subroutine fatal_error

end module gapbeam_error
