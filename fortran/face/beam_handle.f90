!> Handles of prepared beams for Python: the address of what gapbeam_assemble made of a scene
module gapbeam_beam_handle
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_loc, c_funloc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved
    use gapbeam_watch, only: watch_type, begin_watch, end_watched
    use gapbeam_scene, only: model_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    use gapbeam_cases, only: case_loads_type
    use gapbeam_many_cases, only: case_room_type
    use gapbeam_history, only: history_type
    use gapbeam_ground_events, only: ground_path_type
    implicit none
    private
    public :: handle_type, new_handle, copy_handle, handle_of, drop_handle, report, listen, stop_calls
    public :: new_room, room_of, drop_room

    !> What a handle stands for
    type :: handle_type
        !> On calls with it, and the thread that hears signals
        type(watch_type) :: watch
        integer(int64) :: thread = 0
        type(assembled_type) :: lowered
        !> Its loads one by one, where they have been asked for
        type(case_loads_type), allocatable :: cases
        !> The loading history followed last
        type(history_type), allocatable :: history
        !> The same on the ground, until it is taken
        type(ground_path_type), allocatable :: ground_path
    end type handle_type

    interface
        !> Let Python see to signals that have come, in its main thread; not 0 where what it did then is an exception
        function hear_signals(thread) result(raised) bind(c, name="gb_hear_signals")
            import :: c_int, c_ptr
            implicit none
            type(c_ptr), intent(in), value :: thread
            integer(c_int) :: raised
        end function hear_signals
    end interface

contains

    !> From now on calls with a beam end where Python hears a signal that raises an exception; what was ended goes on
    subroutine listen(address, thread)
        integer(int64), intent(in) :: address
        !> Python's main thread, by its number
        integer(int64), intent(in) :: thread
        type(handle_type), pointer :: handle

        handle => handle_of(address)
        handle%thread = thread
        call begin_watch(handle%watch, c_funloc(hear_signals), transfer(thread, c_null_ptr), real(huge(thread), wp))
    end subroutine listen

    !> Let all calls with a beam end, those to come too, until it listens again
    subroutine stop_calls(address)
        integer(int64), intent(in) :: address
        type(handle_type), pointer :: handle

        handle => handle_of(address)
        call end_watched(handle%watch)
    end subroutine stop_calls

    !> Lower a model and keep it
    subroutine new_handle(model, address, error)
        !> Moved away
        type(model_type), intent(inout) :: model
        !> The handle; 0 where an error is found
        integer(int64), intent(out) :: address
        !> As for assemble_model
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: handle
        integer :: stat

        address = 0
        allocate (handle, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (kept => handle%lowered%model)
            call move_alloc(model%spans, kept%spans)
            call move_alloc(model%hinges, kept%hinges)
            call move_alloc(model%sections, kept%sections)
            call move_alloc(model%supports, kept%supports)
            call move_alloc(model%law, kept%law)
            call move_alloc(model%foundations, kept%foundations)
            call move_alloc(model%ground, kept%ground)
            call move_alloc(model%ground_law, kept%ground_law)
            call move_alloc(model%loads, kept%loads)
        end associate
        call assemble_model(handle%lowered, error)
        if (allocated(error)) then
            deallocate (handle)
        else
            handle%lowered%beam%watch = c_loc(handle%watch)
            address = transfer(c_loc(handle), address)
        end if
    end subroutine new_handle

    !> Keep another beam like one at hand
    subroutine copy_handle(address, copy, error)
        integer(int64), intent(in) :: address
        integer(int64), intent(out) :: copy
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(handle_type), pointer :: from, to
        integer :: stat

        copy = 0
        from => handle_of(address)
        allocate (to, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        to%lowered = from%lowered
        to%lowered%beam%watch = c_loc(to%watch)
        copy = transfer(c_loc(to), copy)
        call listen(copy, from%thread)
    end subroutine copy_handle

    !> What a handle stands for
    function handle_of(address) result(handle)
        integer(int64), intent(in) :: address
        type(handle_type), pointer :: handle

        call c_f_pointer(transfer(address, c_null_ptr), handle)
    end function handle_of

    !> Free it; the handle is worth nothing from then on
    subroutine drop_handle(address)
        integer(int64), intent(in) :: address
        type(handle_type), pointer :: handle

        handle => handle_of(address)
        if (associated(handle)) deallocate (handle)
    end subroutine drop_handle

    !> Room for cases of a beam
    subroutine new_room(address)
        !> 0 where memory ends
        integer(int64), intent(out) :: address
        type(case_room_type), pointer :: room
        integer :: stat

        address = 0
        allocate (room, stat=stat)
        if (stat == 0) address = transfer(c_loc(room), address)
    end subroutine new_room

    !> The room at an address
    function room_of(address) result(room)
        integer(int64), intent(in) :: address
        type(case_room_type), pointer :: room

        call c_f_pointer(transfer(address, c_null_ptr), room)
    end function room_of

    !> Free it; the address is worth nothing from then on
    subroutine drop_room(address)
        integer(int64), intent(in) :: address
        type(case_room_type), pointer :: room

        room => room_of(address)
        if (associated(room)) deallocate (room)
    end subroutine drop_room

    !> What Python is told of an error
    pure subroutine report(error, status, message)
        !> Not allocated where there is none
        type(error_type), allocatable, intent(in) :: error
        !> Its code, or gapbeam_solved; its message, or blank
        integer, intent(out) :: status
        character(len=240), intent(out) :: message

        status = gapbeam_solved
        message = " "
        if (.not. allocated(error)) return
        status = error%code
        message = error%message
    end subroutine report

end module gapbeam_beam_handle
