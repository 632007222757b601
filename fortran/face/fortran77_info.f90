!> Handles and INFO of the Fortran 77 interface: handles are whole numbers there, and an error is the place of the argument that is
!> wrong, or a code
module gapbeam_fortran77_info
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_ptr, c_intptr_t, c_null_ptr
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_handles, only: handle_type, find_handle
    implicit none
    private
    public :: find, address_of, number_of, info_of

contains

    !> The address that a number is
    pure function address_of(number) result(address)
        integer(int64), intent(in) :: number
        type(c_ptr) :: address

        address = transfer(int(number, c_intptr_t), c_null_ptr)
    end function address_of

    !> The number that an address is; 0 for null
    pure function number_of(address) result(number)
        type(c_ptr), intent(in) :: address
        integer(int64) :: number

        number = transfer(address, 0_c_intptr_t)
    end function number_of

    !> The object behind a handle. INFO is -place where the argument there is no such handle; where it is not 0 before, nothing is
    !> looked at
    subroutine find(number, place, tag, handle, info)
        integer(int64), intent(in) :: number
        !> Among the arguments
        integer, intent(in) :: place
        !> What there has to be (gapbeam_handles)
        integer(int64), intent(in) :: tag
        type(handle_type), pointer, intent(out) :: handle
        integer, intent(inout) :: info

        nullify (handle)
        if (info /= 0) return
        call find_handle(address_of(number), tag, handle)
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
