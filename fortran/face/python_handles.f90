!> Objects behind handles, made for Python. But for the beam nothing is written to them once they are made, so that threads
!> may share them
module gapbeam_python_handles
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_funloc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_solved, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_watch, only: begin_watch
    use gapbeam_polyline, only: node_support_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_path_states, only: audit_lines, by_tangents, with_lines, on_polylines
    use gapbeam_query, only: find_starts
    use gapbeam_train, only: train_type, uniform_type, new_track
    use gapbeam_train_path, only: pass_train
    use gapbeam_train_events, only: find_events
    use gapbeam_train_ties, only: extreme_type
    use gapbeam_api_objects, only: make_state
    use gapbeam_handles, only: handle_type, beam_tag, state_tag, fields_tag, passing_tag, new_handle, finish_handle, &
        number_of, address_numbered
    implicit none
    private
    public :: error_type, handle_type, number_of, behind, new_beam, copy_beam, keep_state, keep_fields, keep_train, train_of
    public :: listen, report, pack_extremes, laws_given, put_laws

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

    !> What a handle stands for; Python has none but its own
    function behind(number) result(handle)
        integer(int64), intent(in) :: number
        type(handle_type), pointer :: handle

        call c_f_pointer(address_numbered(number), handle)
    end function behind

    !> From now on calls with a beam end where Python hears a signal that raises an exception; what was ended goes on
    subroutine listen(handle, thread)
        type(handle_type), intent(inout) :: handle
        !> Python's main thread, by its number
        integer(int64), intent(in) :: thread

        handle%thread = thread
        call begin_watch(handle%watch, c_funloc(hear_signals), transfer(thread, c_null_ptr), real(huge(thread), wp))
    end subroutine listen

    !> A place for a beam
    subroutine new_beam(handle, error)
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        call new_handle(beam_tag, handle, error)
        if (allocated(error)) return
        allocate (handle%beam%lowered, stat=stat)
        if (stat /= 0) call no_memory(error)
    end subroutine new_beam

    !> Keep another beam like one at hand
    subroutine copy_beam(from, to, error)
        type(handle_type), intent(in) :: from
        type(handle_type), pointer, intent(out) :: to
        !> No memory
        type(error_type), allocatable, intent(out) :: error

        call new_beam(to, error)
        if (.not. allocated(error)) to%beam%lowered = from%beam%lowered
        call finish_handle(to, error)
        if (.not. allocated(error)) call listen(to, from%thread)
    end subroutine copy_beam

    !> Solve at one load factor and keep the state
    subroutine keep_state(beam, factor, rule, on_laws, closed, handle, error)
        type(handle_type), intent(in) :: beam
        !> As for solve_state
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> By_tangents on the smooth laws themselves; with_lines or on_polylines as on a path; else on the polylines, or lines, in
        !> place of them
        integer, intent(in) :: on_laws
        !> Scheme that the search starts from
        logical, intent(in) :: closed(:)
        type(handle_type), pointer, intent(out) :: handle
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error

        call new_handle(state_tag, handle, error)
        if (.not. allocated(error)) call make_state(beam%beam, handle%result, error)
        if (.not. allocated(error)) then
            associate (state => handle%result%state, lowered => beam%beam%lowered)
                state%closed(:) = closed
                ! What is not allocated is not present
                if (on_laws == by_tangents) then
                    call solve_on_laws(lowered, factor, rule, state, error, start=beam%beam%near)
                else
                    call solve_state(lowered, factor, rule, state, error, beam%beam%near)
                end if
                if (any(on_laws == [with_lines, on_polylines]) .and. .not. allocated(error)) then
                    call audit_lines(lowered, factor, on_laws == on_polylines, state, error)
                end if
                ! What is not looked at here
                if (allocated(state%starts)) deallocate (state%starts)
                if (state%status == gapbeam_solved .and. allocated(state%motion)) deallocate (state%motion)
            end associate
        end if
        call finish_handle(handle, error)
    end subroutine keep_state

    !> Recover the fields of a solved state at the pieces and keep them
    subroutine keep_fields(beam, state, handle, error)
        type(handle_type), intent(in) :: beam, state
        type(handle_type), pointer, intent(out) :: handle
        !> A field out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        call new_handle(fields_tag, handle, error)
        if (.not. allocated(error)) then
            associate (lowered => beam%beam%lowered, solved => state%result%state)
                allocate (handle%starts(merge(0, size(lowered%pieces), allocated(solved%ground))), stat=stat)
                if (solved%status /= gapbeam_solved) then
                    call fatal_error(error, gapbeam_not_converged, "no state stands at load factor "//trim(shown(solved%factor))// &
                                     ": it has no fields")
                else if (stat /= 0) then
                    call no_memory(error)
                else if (.not. allocated(solved%ground)) then
                    call find_starts(lowered, solved, handle%starts, error)
                end if
            end associate
        end if
        call finish_handle(handle, error)
    end subroutine keep_fields

    !> Move a train over a beam and keep its way
    subroutine keep_train(lowered, train, from, to, backwards, handle, error)
        !> The beam, the train, and its positions
        type(assembled_type), intent(in) :: lowered
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: from, to
        !> Does it go towards smaller positions
        logical, intent(in) :: backwards
        type(handle_type), pointer, intent(out) :: handle
        !> As for pass_train
        type(error_type), allocatable, intent(out) :: error

        call new_handle(passing_tag, handle, error)
        if (allocated(error)) return
        associate (p => handle%passing)
            call new_track(lowered, p%track, error)
            if (.not. allocated(error)) call pass_train(lowered, p%track, train, from, to, p%passage, error)
            if (.not. allocated(error)) call find_events(lowered, p%passage, backwards, p%events, error)
        end associate
        call finish_handle(handle, error)
    end subroutine keep_train

    !> Axles and uniform loads of a train
    pure function train_of(offset, force, uniform) result(train)
        !> As in train_type; uniform loads, and between which distances, shape (3, n), those of 0 left out
        real(wp), intent(in) :: offset(:), force(:), uniform(:, :)
        type(train_type) :: train
        integer :: i

        train%offset = offset
        train%force = force
        train%uniform = pack([(uniform_type(uniform(1, i), uniform(2, i), uniform(3, i)), i=1, size(uniform, 2))], &
                             abs(uniform(1, :)) > 0.0_wp)
    end function train_of

    !> Extremes as arrays
    pure subroutine pack_extremes(extremes, values, sides, ties)
        type(extreme_type), intent(in) :: extremes(:, :)
        !> Value, x, position, shape (3, most_extreme_ties, 2, 4); side (tie_type), shape (most_extreme_ties, 2, 4)
        real(wp), intent(inout) :: values(:, :, :, :)
        integer, intent(inout) :: sides(:, :, :)
        !> How many there are, shape (2, 4)
        integer, intent(out) :: ties(:, :)
        integer :: f, i, k

        do f = 1, size(extremes, 2)
            do i = 1, size(extremes, 1)
                ties(i, f) = extremes(i, f)%number
                do k = 1, extremes(i, f)%number
                    associate (tie => extremes(i, f)%ties(k))
                        values(:, k, i, f) = [tie%value, tie%x, tie%position]
                        sides(k, i, f) = tie%side
                    end associate
                end do
            end do
        end do
    end subroutine pack_extremes

    !> The supports of a beam with the laws that they have become
    pure function laws_given(lowered, laws) result(supports)
        type(assembled_type), intent(in) :: lowered
        !> Contact level, force, slope and slope before of every support, shape (4, size(supports))
        real(wp), intent(in) :: laws(:, :)
        type(node_support_type), allocatable :: supports(:)

        supports = lowered%beam%supports
        supports%contact = laws(1, :)
        supports%force = laws(2, :)
        supports%stiffness = laws(3, :)
        supports%before = laws(4, :)
        supports%passed = supports%breakpoint > 0 .and. .not. abs(supports%stiffness - supports%before) > 0.0_wp
    end function laws_given

    !> The same to Python
    pure subroutine put_laws(supports, laws)
        type(node_support_type), intent(in) :: supports(:)
        !> As for laws_given, or more
        real(wp), intent(inout) :: laws(:, :)

        associate (n => size(supports))
            laws(1, :n) = supports%contact
            laws(2, :n) = supports%force
            laws(3, :n) = supports%stiffness
            laws(4, :n) = supports%before
        end associate
    end subroutine put_laws

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

end module gapbeam_python_handles
