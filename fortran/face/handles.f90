!> Handles: what users of C, Fortran 77 and Python hold instead of the objects of the Fortran interface. A handle is the address of
!> an object that begins with a tag; no table of handles is kept
module gapbeam_handles
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_intptr_t, c_loc, c_f_pointer, c_null_ptr
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved, gapbeam_not_prepared
    use gapbeam_watch, only: watch_type
    use gapbeam_element, only: field_type
    use gapbeam_cases, only: case_loads_type
    use gapbeam_ground_events, only: ground_path_type
    use gapbeam_api_objects, only: prepared_type, result_type, history_type, cases_type, passing_type
    implicit none
    private
    public :: handle_type, beam_tag, state_tag, fields_tag, history_tag, cases_tag, passing_tag
    public :: handle_at, find_handle, free_handle, new_handle, finish_handle, address_of, number_of, address_numbered

    !> Tags tell the kinds of handle apart, and those of the library from other addresses
    integer(int64), parameter :: beam_tag = 7233173843452522818_int64, state_tag = beam_tag + 1, history_tag = beam_tag + 2, &
                                 cases_tag = beam_tag + 3, passing_tag = beam_tag + 4, fields_tag = beam_tag + 5

    !> What is behind a handle: the tag says which of its objects there is. They are pointers, so that compilers write down once how
    !> the largest types of all are freed
    type :: handle_type
        integer(int64) :: tag = 0
        type(prepared_type), pointer :: beam => null()
        !> On calls with the beam
        type(watch_type) :: watch
        !> Of a beam in Python: the thread that hears signals; its loads one by one, and the path on the ground followed last, where
        !> they have been asked for
        integer(int64) :: thread = 0
        type(case_loads_type), allocatable :: loads
        type(ground_path_type), pointer :: ground_path => null()
        type(result_type), pointer :: result => null()
        !> Fields of a state at the left end of every piece, none on the ground: for Python, where threads share states
        type(field_type), allocatable :: starts(:)
        type(history_type), pointer :: history => null()
        type(cases_type), pointer :: cases => null()
        type(passing_type), pointer :: passing => null()
    end type handle_type

contains

    !> Find what is behind a handle
    subroutine find_handle(address, tag, handle, status)
        type(c_ptr), intent(in) :: address
        !> What there has to be
        integer(int64), intent(in) :: tag
        !> Null where there is none
        type(handle_type), pointer, intent(out) :: handle
        !> gapbeam_not_prepared there, else gapbeam_solved
        integer(c_int), intent(out), optional :: status

        handle => handle_at(address)
        if (associated(handle)) then
            if (handle%tag /= tag) nullify (handle)
        end if
        if (present(status)) status = merge(gapbeam_solved, gapbeam_not_prepared, associated(handle))
    end subroutine find_handle

    !> What is at an address; null where nothing of the library can be. Where there is no memory at all it cannot be told
    function handle_at(address) result(handle)
        type(c_ptr), intent(in) :: address
        type(handle_type), pointer :: handle
        !> No object lies below, nor between multiples of the other
        integer(c_intptr_t), parameter :: lowest = 4096, alignment = 8
        integer(c_intptr_t) :: number

        nullify (handle)
        number = transfer(address, number)
        if (number >= 0 .and. number < lowest .or. modulo(number, alignment) /= 0) return
        call c_f_pointer(address, handle)
    end function handle_at

    !> Free the object behind a handle
    subroutine free_handle(address, only, freed)
        type(c_ptr), intent(in) :: address
        !> Tag that it must have; default any
        integer(int64), intent(in), optional :: only
        !> Was it a handle
        logical, intent(out), optional :: freed
        type(handle_type), pointer :: handle
        logical :: is_one

        handle => handle_at(address)
        is_one = associated(handle)
        if (is_one) is_one = handle%tag >= beam_tag .and. handle%tag <= fields_tag
        if (is_one .and. present(only)) is_one = handle%tag == only
        if (present(freed)) freed = is_one
        if (.not. is_one) return
        ! The tag is gone before the memory is, should somebody keep the address
        handle%tag = 0
        call dispose(handle)
    end subroutine free_handle

    !> Free an object with all that it has
    subroutine dispose(handle)
        !> Associated in, null out
        type(handle_type), pointer, intent(inout) :: handle

        if (associated(handle%beam)) deallocate (handle%beam)
        if (associated(handle%ground_path)) deallocate (handle%ground_path)
        if (associated(handle%result)) deallocate (handle%result)
        if (associated(handle%history)) deallocate (handle%history)
        if (associated(handle%cases)) deallocate (handle%cases)
        if (associated(handle%passing)) deallocate (handle%passing)
        deallocate (handle)
    end subroutine dispose

    !> Make a place for an object
    subroutine new_handle(tag, handle, error)
        integer(int64), intent(in) :: tag
        !> Null where memory ends
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        nullify (handle)
        allocate (handle, stat=stat)
        if (stat == 0) then
            handle%tag = tag
            select case (tag)
            case (beam_tag)
                allocate (handle%beam, stat=stat)
            case (state_tag)
                allocate (handle%result, stat=stat)
            case (history_tag)
                allocate (handle%history, stat=stat)
            case (cases_tag)
                allocate (handle%cases, stat=stat)
            case (passing_tag)
                allocate (handle%passing, stat=stat)
            case default
            end select
            if (stat /= 0) call dispose(handle)
        end if
        if (stat /= 0) call no_memory(error)
    end subroutine new_handle

    !> Let go of an object that has not become ready, and let calls with a beam that has look at its watch
    subroutine finish_handle(handle, error)
        !> Null where there is an error
        type(handle_type), pointer, intent(inout) :: handle
        type(error_type), allocatable, intent(in) :: error

        if (allocated(error)) then
            if (associated(handle)) call dispose(handle)
        else if (associated(handle%beam)) then
            handle%beam%lowered%beam%watch = c_loc(handle%watch)
        end if
    end subroutine finish_handle

    !> The handle of an object in C; null where there is none
    function address_of(handle) result(address)
        type(handle_type), pointer, intent(in) :: handle
        type(c_ptr) :: address

        address = c_null_ptr
        if (associated(handle)) address = c_loc(handle)
    end function address_of

    !> The handle of an object in Fortran 77 and Python; 0 where there is none
    function number_of(handle) result(number)
        type(handle_type), pointer, intent(in) :: handle
        integer(int64) :: number

        number = transfer(address_of(handle), 0_c_intptr_t)
    end function number_of

    !> The address that a number is
    pure function address_numbered(number) result(address)
        integer(int64), intent(in) :: number
        type(c_ptr) :: address

        address = transfer(int(number, c_intptr_t), c_null_ptr)
    end function address_numbered

end module gapbeam_handles
