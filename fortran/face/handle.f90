!> Prepared beams as numbers that Python keeps: the address of what gapbeam_assemble made of a scene
module gapbeam_handle
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_loc, c_funloc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved
    use gapbeam_watch, only: watch_type, begin_watch, end_watched
    use gapbeam_scene, only: model_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_cases, only: case_loads_type
    use gapbeam_many_cases, only: case_room_type
    use gapbeam_history, only: history_type
    use gapbeam_ground_events, only: ground_path_type
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_ground_solver, only: ground_solution_type
    implicit none
    private
    public :: keep_ground, take_ground, ground_rows, pack_ground, unpack_ground
    public :: handle_type, new_handle, copy_handle, handle_of, drop_handle, state_of, report, listen, stop_calls
    public :: new_room, room_of, drop_room

    !> Rows of a solution on the ground as an array, beside those of the layers
    integer, parameter :: ground_rows = 19

    !> What a handle stands for
    type :: handle_type
        !> On calls with it, and the thread that hears signals
        type(watch_type) :: watch
        integer(int64) :: thread = 0
        type(assembled_type) :: lowered
        !> Its loads one by one, where they have been asked for
        type(case_loads_type), allocatable :: cases
        !> The way of the load followed last
        type(history_type), allocatable :: history
        !> The same on the ground, until it is taken
        type(ground_path_type), allocatable :: ground_path
    end type handle_type

    !> A solution on the ground that waits to be taken
    type :: kept_ground_type
        type(ground_solution_type), allocatable :: solution
    end type kept_ground_type

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

    !> A state from the numbers that were taken out of it
    subroutine state_of(lowered, factor, closed, w, ml, mr, shear, react, state, error)
        type(assembled_type), intent(in) :: lowered
        !> As in state_type; closed 1, open 0
        real(wp), intent(in) :: factor
        integer, intent(in) :: closed(:)
        real(wp), intent(in) :: w(0:), ml(0:), mr(0:), shear(:), react(:)
        type(state_type), intent(out) :: state
        !> No memory
        type(error_type), allocatable, intent(out) :: error

        call new_state(lowered, state, error)
        if (allocated(error)) return
        state%factor = factor
        state%closed(:) = closed(:size(state%closed)) /= 0
        state%deflection(:) = w
        state%moment_left(:) = ml
        state%moment_right(:) = mr
        state%shear(:) = shear
        state%reaction(:) = react(:size(state%reaction))
    end subroutine state_of

    !> Keep a solution on the ground until Python has taken it
    subroutine keep_ground(solution, address)
        !> Moved away
        type(ground_solution_type), allocatable, intent(inout) :: solution
        integer(int64), intent(out) :: address
        type(kept_ground_type), pointer :: kept

        allocate (kept)
        call move_alloc(solution, kept%solution)
        address = transfer(c_loc(kept), address)
    end subroutine keep_ground

    !> Take it back; the address is worth nothing from then on
    subroutine take_ground(address, solution)
        integer(int64), intent(in) :: address
        type(ground_solution_type), allocatable, intent(out) :: solution
        type(kept_ground_type), pointer :: kept

        call c_f_pointer(transfer(address, c_null_ptr), kept)
        call move_alloc(kept%solution, solution)
        deallocate (kept)
    end subroutine take_ground

    !> A solution on the ground as an array, a column a stretch
    pure subroutine pack_ground(solution, values)
        type(ground_solution_type), intent(in) :: solution
        !> Piece; distances of the ends from its left end, length; moduli; loads qa, qb, qc, kappa; deflections, moments,
        !> rotations, shears of the ends; of every layer the force up, and the piece of its law on which it acts (0: none)
        real(wp), intent(out) :: values(:, :)
        integer :: i, n

        n = size(solution%acts, 1)
        do i = 1, size(solution%piece)
            associate (s => solution%stretches(i), q => solution%loads(i), e => solution%ends(i))
                values(:ground_rows, i) = [real(solution%piece(i), wp), solution%from(i), solution%to(i), s%length, s%modulus_a, &
                                           s%modulus_b, q%qa, q%qb, q%qc, q%kappa, e%w_a, e%w_b, e%moment_a, e%moment_b, &
                                           solution%rotation(:, i), solution%shear(:, i), solution%slope(i)]
            end associate
            values(ground_rows + 1:ground_rows + n, i) = solution%resultant(:, i)
            values(ground_rows + n + 1:ground_rows + 2*n, i) = solution%acts(:, i)
        end do
    end subroutine pack_ground

    !> The same back, as far as what is asked of it needs it
    pure subroutine unpack_ground(lowered, values, solution)
        type(assembled_type), intent(in) :: lowered
        real(wp), intent(in) :: values(:, :)
        type(ground_solution_type), intent(out) :: solution
        integer :: i, m, n

        m = size(values, 2)
        n = (size(values, 1) - ground_rows)/2
        allocate (solution%piece(m), solution%from(m), solution%to(m), solution%acts(n, m), solution%stretches(m), &
                  solution%loads(m), solution%ends(m), solution%slope(m), solution%rotation(2, m), solution%shear(2, m), &
                  solution%resultant(n, m))
        solution%piece(:) = nint(values(1, :))
        solution%from(:) = values(2, :)
        solution%to(:) = values(3, :)
        solution%rotation(:, :) = values(15:16, :)
        solution%shear(:, :) = values(17:18, :)
        solution%slope(:) = values(19, :)
        solution%resultant(:, :) = values(ground_rows + 1:ground_rows + n, :)
        solution%acts(:, :) = nint(values(ground_rows + n + 1:, :))
        do i = 1, m
            associate (v => values(:, i), p => lowered%pieces(solution%piece(i)))
                solution%stretches(i) = stretch_type(v(4), p%flexibility, p%shear_flexibility, v(5), v(6))
                solution%loads(i) = stretch_load_type(v(7), v(8), v(9), v(10))
                solution%ends(i) = stretch_ends_type(v(11), v(12), v(13), v(14))
            end associate
        end do
    end subroutine unpack_ground

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

end module gapbeam_handle
