!> Handles and INFO of the Fortran 77 interface: handles are whole numbers there, and an error is the place of the argument that is
!> wrong, or a code
module gapbeam_fortran77_info
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_bad_input, gapbeam_no_memory, &
        gapbeam_not_prepared
    use gapbeam_handles, only: handle_type, beam_tag, state_tag, history_tag, cases_tag, passing_tag, find_handle, number_of, &
        address_numbered
    implicit none
    private
    public :: error_type, gapbeam_no_equilibrium, gapbeam_no_memory
    public :: handle_type, beam_tag, state_tag, history_tag, cases_tag, passing_tag, number_of
    public :: find_first, find_both, find, info_of

contains

    !> The object behind the handle that is the first argument
    subroutine find_first(number, tag, handle, info)
        integer(int64), intent(in) :: number
        !> What there has to be (gapbeam_handles)
        integer(int64), intent(in) :: tag
        type(handle_type), pointer, intent(out) :: handle
        !> 0, or -1 where there is no such handle
        integer, intent(out) :: info

        info = 0
        call find(number, 1, tag, handle, info)
    end subroutine find_first

    !> The beam that is the first argument, and the object behind the second one
    subroutine find_both(beam, number, tag, prepared, handle, info)
        integer(int64), intent(in) :: beam, number
        !> What the second one has to be
        integer(int64), intent(in) :: tag
        type(handle_type), pointer, intent(out) :: prepared, handle
        !> 0, or -1 or -2 where there is no such handle
        integer, intent(out) :: info

        call find_first(beam, beam_tag, prepared, info)
        call find(number, 2, tag, handle, info)
    end subroutine find_both

    !> The object behind a handle. INFO is -place where the argument there is no such handle; where it is not 0 before, nothing is
    !> looked at
    subroutine find(number, place, tag, handle, info)
        integer(int64), intent(in) :: number
        !> Among the arguments
        integer, intent(in) :: place
        integer(int64), intent(in) :: tag
        type(handle_type), pointer, intent(out) :: handle
        integer, intent(inout) :: info

        nullify (handle)
        if (info /= 0) return
        call find_handle(address_numbered(number), tag, handle)
        if (.not. associated(handle)) info = -place
    end subroutine find

    !> INFO for what a procedure of the Fortran interface ended with. What is not prepared is the second argument: the first is
    !> a beam, which is prepared
    pure function info_of(error, place, names, places) result(info)
        !> Not allocated where there is none
        type(error_type), allocatable, intent(in) :: error
        !> Argument that bad input is about if none of those below is named
        integer, intent(in) :: place
        !> Arguments of the Fortran procedure as its errors name them (key), and their places here
        character(len=*), intent(in), optional :: names(:)
        integer, intent(in), optional :: places(:)
        integer :: info, i

        info = gapbeam_solved
        if (.not. allocated(error)) return
        info = error%code
        if (error%code == gapbeam_not_prepared) info = -2
        if (error%code /= gapbeam_bad_input) return
        info = -place
        if (.not. present(names)) return
        i = findloc(names, error%key, 1)
        if (i > 0) info = -places(i)
    end function info_of

end module gapbeam_fortran77_info
