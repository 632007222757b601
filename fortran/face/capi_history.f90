!> Histories of the load in the C interface: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_history
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_null_ptr, c_sizeof
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared, gapbeam_other_version
    use gapbeam_words, only: whole
    use gapbeam_api_history, only: solve_on_path, get_released_energy
    use gapbeam_handles, only: handle_type, history_tag, find_handle, free_handle, address_of
    use gapbeam_new_objects, only: new_history
    use gapbeam_capi_objects, only: get_beam, get_both, forget, report
    implicit none
    private
    public :: c_history_info

    !> Mirror of the header's structure; tests/languages/test_capi.c compares the sizes
    type, bind(c) :: c_history_info
        integer(c_size_t) :: size
        integer(c_int) :: stretches, events, limits, ending, solves, nodes
    end type c_history_info

contains

    function gapbeam_follow_history(beam, count, factors, at_limit, history, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        integer(c_int), intent(in), value :: count, at_limit
        real(c_double), intent(in), optional :: factors(*)
        type(c_ptr), intent(out), optional :: history
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, followed
        type(error_type), allocatable :: error

        if (present(history)) history = c_null_ptr
        call get_beam(beam, prepared, error)
        if (allocated(error)) then
            continue
        else if (.not. present(history)) then
            call fatal_error(error, gapbeam_bad_input, "history is NULL")
        else if (count < 1 .or. .not. present(factors)) then
            call fatal_error(error, gapbeam_bad_input, "factors: give at least one")
        else
            call new_history(prepared%beam, factors(1:count), int(at_limit), followed, error)
            history = address_of(followed)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_follow_history

    subroutine gapbeam_free_history(history) bind(c)
        type(c_ptr), intent(in), value :: history

        call free_handle(history, history_tag)
    end subroutine gapbeam_free_history

    function gapbeam_get_history_info(history, info) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        type(c_history_info), intent(inout), optional :: info
        integer(c_int) :: status
        type(handle_type), pointer :: handle
        integer :: nodes

        status = gapbeam_bad_input
        if (.not. present(info)) return
        status = gapbeam_other_version
        if (info%size /= c_sizeof(info)) return
        call find_handle(history, history_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (h => handle%history)
            nodes = 0
            if (allocated(h%motion)) nodes = size(h%motion)
            info = c_history_info(info%size, size(h%stretches), size(h%events), size(h%limits), h%ending, h%solves, nodes)
        end associate
    end function gapbeam_get_history_info

    function gapbeam_get_stretches(history, from, to, leg, direction, stable, index, ways, skipped) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        real(c_double), intent(inout), optional :: from(*), to(*)
        integer(c_int), intent(inout), optional :: leg(*), direction(*), stable(*), index(*), ways(*), skipped(*)
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(history, history_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (s => handle%history%stretches, n => size(handle%history%stretches))
            if (present(from)) from(1:n) = s%from
            if (present(to)) to(1:n) = s%to
            if (present(leg)) leg(1:n) = s%leg - 1
            if (present(direction)) direction(1:n) = s%direction
            if (present(stable)) stable(1:n) = merge(1, 0, s%stable)
            if (present(index)) index(1:n) = s%index
            if (present(ways)) ways(1:n) = s%ways
            if (present(skipped)) skipped(1:n) = merge(1, 0, s%skipped)
        end associate
    end function gapbeam_get_stretches

    function gapbeam_get_events(history, factor, support, condition, change, stretch) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        real(c_double), intent(inout), optional :: factor(*)
        integer(c_int), intent(inout), optional :: support(*), condition(*), change(*), stretch(*)
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(history, history_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (events => handle%history%events, n => size(handle%history%events))
            if (present(factor)) factor(1:n) = events%factor
            if (present(support)) support(1:n) = events%support - 1
            if (present(condition)) condition(1:n) = events%state
            if (present(change)) change(1:n) = events%change
            if (present(stretch)) stretch(1:n) = events%stretch - 1
        end associate
    end function gapbeam_get_events

    function gapbeam_get_limits(history, factor, kind, leg, stretch, landing) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        real(c_double), intent(inout), optional :: factor(*)
        integer(c_int), intent(inout), optional :: kind(*), leg(*), stretch(*), landing(*)
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(history, history_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (limits => handle%history%limits, n => size(handle%history%limits))
            if (present(factor)) factor(1:n) = limits%factor
            if (present(kind)) kind(1:n) = limits%kind
            if (present(leg)) leg(1:n) = limits%leg - 1
            if (present(stretch)) stretch(1:n) = limits%stretch - 1
            if (present(landing)) landing(1:n) = limits%landing - 1
        end associate
    end function gapbeam_get_limits

    function gapbeam_get_exact(history, stretches, limits) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        integer(c_int), intent(inout), optional :: stretches(*), limits(*)
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(history, history_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (h => handle%history)
            if (present(stretches)) stretches(1:size(h%stretches)) = merge(1, 0, h%stretches%exact)
            if (present(limits)) limits(1:size(h%limits)) = merge(1, 0, h%limits%exact)
        end associate
    end function gapbeam_get_exact

    function gapbeam_get_history_motion(history, x, motion) result(status) bind(c)
        type(c_ptr), intent(in), value :: history
        real(c_double), intent(inout), optional :: x(*), motion(*)
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        status = gapbeam_not_prepared
        call find_handle(history, history_tag, handle)
        if (.not. associated(handle)) return
        if (.not. allocated(handle%history%motion)) return
        associate (h => handle%history)
            if (present(x)) x(1:size(h%x)) = h%x
            if (present(motion)) motion(1:size(h%motion)) = h%motion
        end associate
        status = gapbeam_solved
    end function gapbeam_get_history_motion

    function gapbeam_solve_on_path(beam, history, stretch, factor, state, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, history, state
        integer(c_int), intent(in), value :: stretch
        real(c_double), intent(in), value :: factor
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved, handle
        type(error_type), allocatable :: error

        call get_both(beam, state, prepared, solved, error)
        call find_history(history, handle, error)
        if (.not. allocated(error)) call check_number("stretch", stretch, -1, size(handle%history%stretches), error)
        if (.not. allocated(error)) then
            call solve_on_path(prepared%beam, handle%history, factor, solved%result, error, stretch + 1)
            if (allocated(error)) call count_from_zero("stretch", stretch, error)
        end if
        call forget(solved, error)
        call report(error, status, message, message_size)
        if (.not. allocated(error)) status = solved%result%status
    end function gapbeam_solve_on_path

    function gapbeam_get_released_energy(beam, history, limit, energy, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, history
        integer(c_int), intent(in), value :: limit
        real(c_double), intent(inout), optional :: energy
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, handle
        type(error_type), allocatable :: error
        real(c_double) :: found

        call get_beam(beam, prepared, error)
        call find_history(history, handle, error)
        if (.not. allocated(error)) call check_number("limit", limit, 0, size(handle%history%limits), error)
        if (.not. allocated(error)) then
            call get_released_energy(prepared%beam, handle%history, limit + 1, found, error)
            if (allocated(error)) call count_from_zero("limit", limit, error)
        end if
        if (.not. allocated(error) .and. present(energy)) energy = found
        call report(error, status, message, message_size)
    end function gapbeam_get_released_energy

    !> Refuse a number of a stretch or a limit that is none, as C counts them
    subroutine check_number(name, number, first, count, error)
        character(len=*), intent(in) :: name
        !> The number, the first one that there is, and how many stretches or limits
        integer(c_int), intent(in) :: number
        integer, intent(in) :: first, count
        type(error_type), allocatable, intent(out) :: error

        if (number >= first .and. number < count) return
        if (count > 0) then
            call fatal_error(error, gapbeam_bad_input, name//": expected "//trim(whole(first))//" to "//trim(whole(count - 1))// &
                             ", got "//trim(whole(int(number))))
        else
            call fatal_error(error, gapbeam_bad_input, name//": the history has none, got "//trim(whole(int(number))))
        end if
    end subroutine check_number

    !> Name a stretch or a limit in a message as C counts it
    subroutine count_from_zero(name, number, error)
        character(len=*), intent(in) :: name
        integer(c_int), intent(in) :: number
        type(error_type), intent(inout) :: error
        integer :: at, last

        at = index(error%message, name//" "//trim(whole(number + 1)))
        if (at == 0) return
        last = at + len(name) + len_trim(whole(number + 1))
        error%message = error%message(:at + len(name))//trim(whole(int(number)))//error%message(last + 1:)
    end subroutine count_from_zero

    !> The history behind a handle
    subroutine find_history(history, handle, error)
        type(c_ptr), intent(in) :: history
        type(handle_type), pointer, intent(out) :: handle
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        call find_handle(history, history_tag, handle)
        if (.not. allocated(error) .and. .not. associated(handle)) then
            call fatal_error(error, gapbeam_not_prepared, "history is none: make one with gapbeam_follow_history")
        end if
    end subroutine find_history

end module gapbeam_capi_history
