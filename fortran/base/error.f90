!> Status codes and errors.
!> Outcomes carry data and are no errors: a scene without equilibrium is valid.
module gapbeam_error
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: error_type, fatal_error, no_memory, failed, out_of_range, has_ended
    public :: status_text, status_codes, status_texts, unknown_status
    public :: gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles
    public :: gapbeam_bad_input, gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite
    public :: gapbeam_no_memory, gapbeam_not_prepared, gapbeam_other_version, gapbeam_stopped

    !> Outcome: the scene is solved
    integer, parameter :: gapbeam_solved = 0
    !> Outcome: a free motion along which nothing resists; no numbers are returned
    integer, parameter :: gapbeam_no_equilibrium = 1
    !> Outcome: compression is more than the beam bears; no numbers are returned but the motion and how much it bears
    integer, parameter :: gapbeam_buckles = 2
    !> Error: a number or an array makes no sense; nothing was done
    integer, parameter :: gapbeam_bad_input = 11
    !> Error: a rigid stretch rests on more rigid supports than statics can tell apart
    integer, parameter :: gapbeam_indeterminate = 12
    !> Error: the contact state could not be settled in the precision at hand
    integer, parameter :: gapbeam_not_converged = 13
    !> Error: numbers left the range of double precision
    integer, parameter :: gapbeam_not_finite = 14
    !> Error: the system gives no more memory
    integer, parameter :: gapbeam_no_memory = 15
    !> Error: no beam has been prepared, or no state solved, in what was passed
    integer, parameter :: gapbeam_not_prepared = 16
    !> Error: caller and library were built with different versions of a structure
    integer, parameter :: gapbeam_other_version = 17
    !> Error: whoever watches the call has ended it
    integer, parameter :: gapbeam_stopped = 18

    !> All codes, and what they mean
    integer, parameter :: status_codes(11) = [gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, gapbeam_bad_input, &
                                             gapbeam_indeterminate, &
                                             gapbeam_not_converged, gapbeam_not_finite, gapbeam_no_memory, gapbeam_not_prepared, &
                                             gapbeam_other_version, gapbeam_stopped]
    character(len=*), parameter :: status_texts(11) = [character(len=88) :: &
        "solved", &
        "no equilibrium: the loads push the beam along a free motion that no support resists", &
        "buckles: the beam does not bear its axial forces", &
        "bad input: a number or an array makes no sense", &
        "a rigid stretch rests on more rigid supports than statics can tell apart", &
        "the contact state could not be settled in the precision at hand", &
        "numbers left the range of double precision", &
        "not enough memory", &
        "no beam has been prepared, or no state solved, in what was passed", &
        "caller and library were built with different versions of a structure", &
        "ended before it was done, by whoever watches the call or by its time limit"]
    character(len=*), parameter :: unknown_status = "unknown status"

    !> An error: allocated means failed
    type :: error_type
        !> One of the codes above
        integer :: code
        !> What happened, where, and what to do about it
        character(len=:), allocatable :: message
        !> Of bad input the array, 1 spans, 2 hinges, 3 supports, 4 loads, 5 sections, 6 foundations, 0 another argument, and the
        !> entry in it, from 1
        integer :: table = 0, entry = 0
        !> Why (gapbeam_input_error), what of the entry it is about, and another entry that it is at odds with
        integer :: reason = 0
        character(len=16) :: key = " "
        integer :: partner = 0
        !> Distance from the left end that the message tells in the engine's units, -1: none
        real(wp) :: distance = -1.0_wp
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

    !> Set the error that says that memory is at an end
    pure subroutine no_memory(error)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_no_memory, trim(status_text(gapbeam_no_memory)))
    end subroutine no_memory

    !> Is there an error by now: one from before, or that memory is at an end, which is set here
    function failed(stat, error)
        !> What `allocate` says
        integer, intent(in) :: stat
        type(error_type), allocatable, intent(inout) :: error
        logical :: failed

        if (stat /= 0) call no_memory(error)
        failed = allocated(error)
    end function failed

    !> Set the error that says that numbers left the range of double precision, and what helps
    pure subroutine out_of_range(error)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_not_finite, trim(status_text(gapbeam_not_finite)) &
                         //": choose units in which lengths, stiffnesses and loads are nearer to 1")
    end subroutine out_of_range

    !> What a status code means, in a few words, blanks behind them. Not of deferred length: gfortran keeps the length of such a
    !> result in static storage, which threads share
    pure function status_text(code) result(text)
        !> Any integer
        integer, intent(in) :: code
        character(len=len(status_texts)) :: text
        integer :: i

        i = findloc(status_codes, code, 1)
        text = unknown_status
        if (i > 0) text = status_texts(i)
    end function status_text

    !> Has a call been ended, for want of memory or by whoever watches it, so that nothing else is to be tried
    pure function has_ended(error)
        type(error_type), allocatable, intent(in) :: error
        logical :: has_ended

        has_ended = .false.
        if (allocated(error)) has_ended = any(error%code == [gapbeam_no_memory, gapbeam_stopped])
    end function has_ended

end module gapbeam_error
