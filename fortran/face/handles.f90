!> Handles: what users of C and Fortran 77 hold instead of the objects of the Fortran interface. A handle is the address of an
!> object that begins with a tag; no table of handles is kept
module gapbeam_handles
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_ptr, c_intptr_t, c_loc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_watch, only: watch_type
    use gapbeam_scene, only: model_type
    use gapbeam_api, only: prepared_type, result_type, prepare_model
    use gapbeam_api_cases, only: cases_type, prepare_cases
    use gapbeam_api_combinations, only: combine_loads
    use gapbeam_api_history, only: history_type, follow_history
    use gapbeam_api_trains, only: moving_train_type, passing_type, follow_train
    implicit none
    private
    public :: handle_type, beam_tag, state_tag, history_tag, cases_tag, passing_tag
    public :: find_handle, free_handle, new_beam, new_combination, new_state, new_history, new_cases, new_passing

    !> Tags tell the kinds of handle apart, and those of the library from other addresses
    integer(int64), parameter :: beam_tag = 7233173843452522818_int64, state_tag = beam_tag + 1, history_tag = beam_tag + 2, &
                                 cases_tag = beam_tag + 3, passing_tag = beam_tag + 4

    !> What is behind a handle: the tag says which of its objects there is
    type :: handle_type
        integer(int64) :: tag = 0
        type(prepared_type), allocatable :: beam
        !> On calls with the beam
        type(watch_type) :: watch
        type(result_type), allocatable :: result
        type(history_type), allocatable :: history
        type(cases_type), allocatable :: cases
        type(passing_type), allocatable :: passing
    end type handle_type

contains

    !> Find what is behind a handle
    subroutine find_handle(address, tag, handle)
        type(c_ptr), intent(in) :: address
        !> What there has to be
        integer(int64), intent(in) :: tag
        !> Null where there is none
        type(handle_type), pointer, intent(out) :: handle

        handle => handle_at(address)
        if (.not. associated(handle)) return
        if (handle%tag /= tag) nullify (handle)
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
    subroutine free_handle(address, freed, only)
        type(c_ptr), intent(in) :: address
        !> Was it a handle
        logical, intent(out) :: freed
        !> Tag that it must have; default any
        integer(int64), intent(in), optional :: only
        type(handle_type), pointer :: handle

        handle => handle_at(address)
        freed = associated(handle)
        if (.not. freed) return
        freed = handle%tag >= beam_tag .and. handle%tag <= passing_tag
        if (present(only)) freed = handle%tag == only
        if (.not. freed) return
        ! The tag is gone before the memory is, should somebody keep the address
        handle%tag = 0
        deallocate (handle)
    end subroutine free_handle

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
            case default
                allocate (handle%passing, stat=stat)
            end select
            if (stat /= 0) deallocate (handle)
        end if
        if (stat /= 0) call no_memory(error)
    end subroutine new_handle

    !> Give the address of an object that is ready
    subroutine give(handle, address, error)
        !> Freed where there is an error
        type(handle_type), pointer, intent(inout) :: handle
        !> Null where there is an error
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(in) :: error

        address = c_null_ptr
        if (allocated(error)) then
            if (associated(handle)) deallocate (handle)
            return
        end if
        if (allocated(handle%beam)) handle%beam%lowered%beam%watch = c_loc(handle%watch)
        address = c_loc(handle)
    end subroutine give

    !> Prepare a model, as prepare_model
    subroutine new_beam(model, address, error)
        type(model_type), intent(in) :: model
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(beam_tag, handle, error)
        if (.not. allocated(error)) call prepare_model(model, handle%beam, error)
        call give(handle, address, error)
    end subroutine new_beam

    !> Combine the loads of a beam, as combine_loads
    subroutine new_combination(beam, factors, settlements, address, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        real(wp), intent(in), optional :: settlements(:)
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(beam_tag, handle, error)
        if (.not. allocated(error)) call combine_loads(beam, factors, handle%beam, error, settlements)
        call give(handle, address, error)
    end subroutine new_combination

    !> An empty place for results
    subroutine new_state(address, error)
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(state_tag, handle, error)
        call give(handle, address, error)
    end subroutine new_state

    !> Follow the load through factors in turn, as follow_history
    subroutine new_history(beam, factors, at_limit, address, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: at_limit
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(history_tag, handle, error)
        if (.not. allocated(error)) call follow_history(beam, factors, at_limit, handle%history, error)
        call give(handle, address, error)
    end subroutine new_history

    !> Make ready for many cases, as prepare_cases
    subroutine new_cases(beam, address, error)
        type(prepared_type), intent(in) :: beam
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(cases_tag, handle, error)
        if (.not. allocated(error)) call prepare_cases(beam, handle%cases, error)
        call give(handle, address, error)
    end subroutine new_cases

    !> Move a train over a beam, as follow_train
    subroutine new_passing(beam, train, address, error)
        type(prepared_type), intent(in) :: beam
        type(moving_train_type), intent(in) :: train
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle

        call new_handle(passing_tag, handle, error)
        if (.not. allocated(error)) call follow_train(beam, train, handle%passing, error)
        call give(handle, address, error)
    end subroutine new_passing

end module gapbeam_handles
