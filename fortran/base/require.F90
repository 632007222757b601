!> Preconditions of procedures as executable checks, in the build with checks only (tests/run).
!> In all other builds `checked` is a constant false: nothing is tested, no code is made, and nothing here can end the process.
!>
!>     if (checked) call require(size(x) == n, "solve_chain: x")
module gapbeam_require
    implicit none
    private
    public :: checked, require

    !> Are requirements tested
#ifdef GAPBEAM_CHECKED
    logical, parameter :: checked = .true.
#else
    logical, parameter :: checked = .false.
#endif

contains

    !> End the process where a requirement does not hold, in the build with checks only
    pure subroutine require(holds, what)
        !> The requirement
        logical, intent(in) :: holds
        !> Procedure, and what is wrong with its arguments or its result
        character(len=*), intent(in) :: what

#ifdef GAPBEAM_CHECKED
        if (.not. holds) error stop what
#else
        if (.not. holds .and. len(what) > 0) return
#endif
    end subroutine require

end module gapbeam_require
