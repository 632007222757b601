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
    public :: beam_handle, state_handle, history_handle, cases_handle, passing_handle
    public :: beam_tag, state_tag, history_tag, cases_tag, passing_tag
    public :: find_handle, free_handle, new_beam, new_combination, new_state, new_history, new_cases, new_passing

    !> Tags tell the kinds of handle apart, and those of the library from other addresses
    integer(int64), parameter :: beam_tag = 7233173843452522818_int64, state_tag = beam_tag + 1, history_tag = beam_tag + 2, &
                                 cases_tag = beam_tag + 3, passing_tag = beam_tag + 4

    !> What every object begins with
    type :: tag_type
        integer(int64) :: tag = 0
    end type tag_type

    type, extends(tag_type) :: beam_handle
        type(prepared_type) :: beam
        !> On calls with it
        type(watch_type) :: watch
    end type beam_handle

    type, extends(tag_type) :: state_handle
        type(result_type) :: result
    end type state_handle

    type, extends(tag_type) :: history_handle
        type(history_type) :: history
    end type history_handle

    type, extends(tag_type) :: cases_handle
        type(cases_type) :: cases
    end type cases_handle

    type, extends(tag_type) :: passing_handle
        type(passing_type) :: passing
    end type passing_handle

    !> The object behind a handle
    interface find_handle
        module procedure find_beam
        module procedure find_state
        module procedure find_history
        module procedure find_cases
        module procedure find_passing
    end interface find_handle

contains

    !> Tag of what is at an address; 0 where nothing of the library can be. Where there is no memory at all it cannot be told
    function tag_at(address) result(tag)
        type(c_ptr), intent(in) :: address
        integer(int64) :: tag
        !> No object lies below, nor between multiples of the other
        integer(c_intptr_t), parameter :: lowest = 4096, alignment = 8
        integer(c_intptr_t) :: number
        type(tag_type), pointer :: object

        tag = 0
        number = transfer(address, number)
        if (number >= 0 .and. number < lowest .or. modulo(number, alignment) /= 0) return
        call c_f_pointer(address, object)
        tag = object%tag
    end function tag_at

    subroutine find_beam(address, object)
        type(c_ptr), intent(in) :: address
        !> Null where it is no handle of a beam
        type(beam_handle), pointer, intent(out) :: object

        nullify (object)
        if (tag_at(address) == beam_tag) call c_f_pointer(address, object)
    end subroutine find_beam

    subroutine find_state(address, object)
        type(c_ptr), intent(in) :: address
        !> Null where it is no handle of a state
        type(state_handle), pointer, intent(out) :: object

        nullify (object)
        if (tag_at(address) == state_tag) call c_f_pointer(address, object)
    end subroutine find_state

    subroutine find_history(address, object)
        type(c_ptr), intent(in) :: address
        !> Null where it is no handle of a history
        type(history_handle), pointer, intent(out) :: object

        nullify (object)
        if (tag_at(address) == history_tag) call c_f_pointer(address, object)
    end subroutine find_history

    subroutine find_cases(address, object)
        type(c_ptr), intent(in) :: address
        !> Null where it is no handle of cases
        type(cases_handle), pointer, intent(out) :: object

        nullify (object)
        if (tag_at(address) == cases_tag) call c_f_pointer(address, object)
    end subroutine find_cases

    subroutine find_passing(address, object)
        type(c_ptr), intent(in) :: address
        !> Null where it is no handle of a train on its way
        type(passing_handle), pointer, intent(out) :: object

        nullify (object)
        if (tag_at(address) == passing_tag) call c_f_pointer(address, object)
    end subroutine find_passing

    !> Free the object behind a handle
    subroutine free_handle(address, freed, only)
        type(c_ptr), intent(in) :: address
        !> Was it a handle
        logical, intent(out) :: freed
        !> Tag that it must have; default any
        integer(int64), intent(in), optional :: only
        integer(int64) :: tag
        type(beam_handle), pointer :: beam
        type(state_handle), pointer :: state
        type(history_handle), pointer :: history
        type(cases_handle), pointer :: cases
        type(passing_handle), pointer :: passing

        tag = tag_at(address)
        if (present(only)) then
            if (tag /= only) tag = 0
        end if
        freed = .true.
        ! The tag is gone before the memory is, should somebody keep the address
        select case (tag)
        case (beam_tag)
            call c_f_pointer(address, beam)
            beam%tag = 0
            deallocate (beam)
        case (state_tag)
            call c_f_pointer(address, state)
            state%tag = 0
            deallocate (state)
        case (history_tag)
            call c_f_pointer(address, history)
            history%tag = 0
            deallocate (history)
        case (cases_tag)
            call c_f_pointer(address, cases)
            cases%tag = 0
            deallocate (cases)
        case (passing_tag)
            call c_f_pointer(address, passing)
            passing%tag = 0
            deallocate (passing)
        case default
            freed = .false.
        end select
    end subroutine free_handle

    !> Prepare a model, as prepare_model
    subroutine new_beam(model, address, error)
        type(model_type), intent(in) :: model
        !> Of the beam; null where an error is found
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(beam_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call prepare_model(model, object%beam, error)
        call keep_beam(object, address, error)
    end subroutine new_beam

    !> Combine the loads of a beam, as combine_loads
    subroutine new_combination(beam, factors, settlements, address, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        real(wp), intent(in), optional :: settlements(:)
        !> Of the other beam; null where an error is found
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(beam_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call combine_loads(beam, factors, object%beam, error, settlements)
        call keep_beam(object, address, error)
    end subroutine new_combination

    !> Keep a beam that is ready, with a watch of its own
    subroutine keep_beam(object, address, error)
        !> Freed where there is an error
        type(beam_handle), pointer, intent(inout) :: object
        type(c_ptr), intent(inout) :: address
        type(error_type), allocatable, intent(in) :: error

        if (allocated(error)) then
            deallocate (object)
            return
        end if
        object%tag = beam_tag
        object%beam%lowered%beam%watch = c_loc(object%watch)
        address = c_loc(object)
    end subroutine keep_beam

    !> An empty place for results
    subroutine new_state(address, error)
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(state_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        object%tag = state_tag
        address = c_loc(object)
    end subroutine new_state

    !> Follow the load through factors in turn, as follow_history
    subroutine new_history(beam, factors, at_limit, address, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: at_limit
        !> Of the history; null where an error is found
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(history_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call follow_history(beam, factors, at_limit, object%history, error)
        if (allocated(error)) then
            deallocate (object)
            return
        end if
        object%tag = history_tag
        address = c_loc(object)
    end subroutine new_history

    !> Make ready for many cases, as prepare_cases
    subroutine new_cases(beam, address, error)
        type(prepared_type), intent(in) :: beam
        !> Of the cases; null where an error is found
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(cases_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call prepare_cases(beam, object%cases, error)
        if (allocated(error)) then
            deallocate (object)
            return
        end if
        object%tag = cases_tag
        address = c_loc(object)
    end subroutine new_cases

    !> Move a train over a beam, as follow_train
    subroutine new_passing(beam, train, address, error)
        type(prepared_type), intent(in) :: beam
        type(moving_train_type), intent(in) :: train
        !> Of the train on its way; null where an error is found
        type(c_ptr), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(passing_handle), pointer :: object
        integer :: stat

        address = c_null_ptr
        allocate (object, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call follow_train(beam, train, object%passing, error)
        if (allocated(error)) then
            deallocate (object)
            return
        end if
        object%tag = passing_tag
        address = c_loc(object)
    end subroutine new_passing

end module gapbeam_handles
