!> States of beams in the C interface, solved and asked: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_sizeof
    use gapbeam_error, only: error_type, fatal_error, failed, no_memory, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared, &
        gapbeam_other_version
    use gapbeam_scene, only: model_type
    use gapbeam_events, only: event_type
    use gapbeam_api, only: prepared_type, options_type, result_type, certificate_type, prepare_model, count_supports, &
        count_nodes, solve_beam, follow_load, get_supports, get_friction, get_fields, get_motion, get_certificate
    use gapbeam_handles, only: handle_type, state_tag, find_handle
    use gapbeam_capi_model, only: c_model, model_from_c
    use gapbeam_capi_quantities, only: gapbeam_get_quantity_extremes
    use gapbeam_capi_objects, only: c_options, get_both, read_options, check_points, check_flag, forget, report
    implicit none
    private
    public :: c_info, c_certificate

    !> Mirrors of the header's structures; tests/languages/test_capi.c compares their sizes
    type, bind(c) :: c_info
        integer(c_size_t) :: size
        real(c_double) :: factor
        integer(c_int) :: status, solves, method, indifferent, slides, unique
    end type c_info

    type, bind(c) :: c_certificate
        integer(c_size_t) :: size
        real(c_double) :: equilibrium, compatibility, complementarity
        real(c_double) :: deflection_bound, reaction_bound, field_bound(4)
        integer(c_int) :: known, reserved
    end type c_certificate

contains

    function gapbeam_options_init(options, size) result(status) bind(c)
        type(c_options), intent(inout), optional :: options
        integer(c_size_t), intent(in), value :: size
        integer(c_int) :: status
        type(options_type) :: defaults

        status = gapbeam_bad_input
        if (.not. present(options)) return
        status = gapbeam_other_version
        if (size /= c_sizeof(options)) return
        options = c_options(size, defaults%rule, 0)
        status = gapbeam_solved
    end function gapbeam_options_init

    function gapbeam_solve(beam, factor, options, state, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(in), value :: factor
        type(c_options), intent(in), optional :: options
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        type(options_type) :: chosen

        call get_both(beam, state, prepared, solved, error)
        call read_options(options, chosen, error)
        if (.not. allocated(error)) call solve_beam(prepared%beam, factor, chosen, solved%result, error)
        call forget(solved, error)
        call report(error, status, message, message_size)
        if (.not. allocated(error)) status = solved%result%status
    end function gapbeam_solve

    function gapbeam_follow(beam, factor, options, capacity, event_factor, event_support, event_condition, number, state, message, &
                            message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(in), value :: factor
        type(c_options), intent(in), optional :: options
        integer(c_int), intent(in), value :: capacity
        real(c_double), intent(inout), optional :: event_factor(*)
        integer(c_int), intent(inout), optional :: event_support(*), event_condition(*)
        integer(c_int), intent(inout), optional :: number
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        type(options_type) :: chosen
        type(event_type), allocatable :: events(:)
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        call read_options(options, chosen, error)
        if (.not. allocated(error)) call follow_load(prepared%beam, factor, chosen, events, solved%result, error)
        call forget(solved, error)
        call report(error, status, message, message_size)
        if (allocated(error)) return
        status = solved%result%status
        if (present(number)) number = size(events)
        n = min(int(capacity), size(events))
        if (present(event_factor)) event_factor(1:n) = events(:n)%factor
        if (present(event_support)) event_support(1:n) = events(:n)%support - 1
        if (present(event_condition)) event_condition(1:n) = events(:n)%state
    end function gapbeam_follow

    function gapbeam_get_info(state, info) result(status) bind(c)
        type(c_ptr), intent(in), value :: state
        type(c_info), intent(inout), optional :: info
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(state, state_tag, handle)
        status = gapbeam_bad_input
        if (.not. present(info)) return
        status = gapbeam_other_version
        if (info%size /= c_sizeof(info)) return
        status = gapbeam_not_prepared
        if (.not. associated(handle)) return
        associate (r => handle%result)
            if (r%status < 0) return
            info = c_info(info%size, r%factor, r%status, r%solves, r%method, merge(1, 0, r%indifferent), merge(1, 0, r%slides), &
                          merge(1, 0, r%unique))
        end associate
        status = gapbeam_solved
    end function gapbeam_get_info

    function gapbeam_get_supports(beam, state, reaction, deflection, opening, couple, condition) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: reaction(*), deflection(*), opening(*), couple(*)
        integer(c_int), intent(inout), optional :: condition(*)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) then
            call copy_supports(prepared%beam, solved%result, reaction, deflection, opening, couple, condition, error)
        end if
        call report(error, status)
    end function gapbeam_get_supports

    !> Values at the supports into the arrays that are there
    subroutine copy_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        real(c_double), intent(inout), optional :: reaction(*), deflection(*), opening(*), couple(*)
        integer(c_int), intent(inout), optional :: condition(*)
        type(error_type), allocatable, intent(out) :: error
        real(c_double), allocatable :: values(:, :)
        integer, allocatable :: conditions(:)
        integer :: m, stat

        m = count_supports(beam)
        allocate (values(m, 4), conditions(m), stat=stat)
        if (failed(stat, error)) return
        call get_supports(beam, result, values(:, 1), values(:, 2), values(:, 3), values(:, 4), conditions, error)
        if (allocated(error)) return
        if (present(reaction)) reaction(1:m) = values(:, 1)
        if (present(deflection)) deflection(1:m) = values(:, 2)
        if (present(opening)) opening(1:m) = values(:, 3)
        if (present(couple)) couple(1:m) = values(:, 4)
        if (present(condition)) condition(1:m) = conditions
    end subroutine copy_supports

    function gapbeam_get_friction(beam, state, force, slip, slides) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: force(*), slip(*)
        integer(c_int), intent(inout), optional :: slides(*)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double), allocatable :: values(:, :)
        integer, allocatable :: ways(:)
        integer :: m, stat

        m = 0
        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) then
            m = count_supports(prepared%beam)
            allocate (values(m, 2), ways(m), stat=stat)
            if (stat /= 0) call no_memory(error)
        end if
        if (.not. allocated(error)) call get_friction(prepared%beam, solved%result, values(:, 1), values(:, 2), ways, error)
        if (.not. allocated(error)) then
            if (present(force)) force(1:m) = values(:, 1)
            if (present(slip)) slip(1:m) = values(:, 2)
            if (present(slides)) slides(1:m) = ways
        end if
        call report(error, status)
    end function gapbeam_get_friction

    function gapbeam_get_fields(beam, state, count, x, from_left, fields, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: count, from_left
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: fields(6, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error

        call get_both(beam, state, prepared, solved, error)
        call check_points(count, present(x) .and. present(fields), "x or fields", error)
        call check_flag("from_left", from_left, error)
        if (.not. allocated(error) .and. count > 0) then
            call get_fields(prepared%beam, solved%result, x(1:count), fields(:, 1:count), error, from_left == 1)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_get_fields

    function gapbeam_get_extremes(beam, state, value, x) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: value(2, 6), x(2, 6)
        integer(c_int) :: status

        status = gapbeam_get_quantity_extremes(beam, state, 6, [0, 1, 2, 3, 4, 5], value, x, message_size=0_c_size_t)
    end function gapbeam_get_extremes

    function gapbeam_get_motion(beam, state, x, motion) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: x(*), motion(*)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error) .and. .not. (present(x) .and. present(motion))) then
            call fatal_error(error, gapbeam_bad_input, "x or motion is NULL")
        end if
        if (.not. allocated(error)) then
            n = count_nodes(prepared%beam)
            call get_motion(prepared%beam, solved%result, x(1:n), motion(1:n), error)
        end if
        call report(error, status)
    end function gapbeam_get_motion

    function gapbeam_get_certificate(beam, state, certificate, undecided) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        type(c_certificate), intent(inout), optional :: certificate
        integer(c_int), intent(inout), optional :: undecided(*)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        type(certificate_type) :: found
        logical, allocatable :: doubtful(:)
        integer :: stat

        status = gapbeam_bad_input
        if (.not. present(certificate)) return
        status = gapbeam_other_version
        if (certificate%size /= c_sizeof(certificate)) return
        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) then
            allocate (doubtful(count_supports(prepared%beam)), stat=stat)
            if (.not. failed(stat, error)) call get_certificate(prepared%beam, solved%result, found, doubtful, error)
        end if
        call report(error, status)
        if (allocated(error)) return
        certificate = c_certificate(certificate%size, found%equilibrium, found%compatibility, found%complementarity, &
                                    found%deflection_bound, found%reaction_bound, found%field_bound, merge(1, 0, found%known), 0)
        if (present(undecided)) undecided(1:size(doubtful)) = merge(1, 0, doubtful)
    end function gapbeam_get_certificate

    function gapbeam_solve_model(model, factor, options, reaction, deflection, opening, couple, condition, count, x, fields, &
                                 message, message_size) result(status) bind(c)
        type(c_model), intent(in), optional :: model
        real(c_double), intent(in), value :: factor
        type(c_options), intent(in), optional :: options
        real(c_double), intent(inout), optional :: reaction(*), deflection(*), opening(*), couple(*)
        integer(c_int), intent(inout), optional :: condition(*)
        integer(c_int), intent(in), value :: count
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: fields(6, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(error_type), allocatable :: error
        type(model_type) :: plain
        type(prepared_type) :: beam
        type(options_type) :: chosen
        type(result_type) :: result
        logical :: solved

        if (.not. present(model)) then
            call fatal_error(error, gapbeam_bad_input, "model is NULL")
        else
            call model_from_c(model, plain, error)
        end if
        call read_options(options, chosen, error)
        call check_points(count, present(x) .and. present(fields), "x or fields", error)
        if (.not. allocated(error)) call prepare_model(plain, beam, error)
        if (.not. allocated(error)) call solve_beam(beam, factor, chosen, result, error)
        solved = .not. allocated(error) .and. result%status == gapbeam_solved
        ! Fields first: they may be refused, and then nothing else is to be written
        if (solved .and. count > 0) call get_fields(beam, result, x(1:count), fields(:, 1:count), error)
        if (solved .and. .not. allocated(error)) then
            call copy_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        end if
        call report(error, status, message, message_size)
        if (.not. allocated(error)) status = result%status
    end function gapbeam_solve_model

end module gapbeam_capi
