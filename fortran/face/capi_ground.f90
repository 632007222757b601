!> Beams on foundations in the C interface: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_ground
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr
    use gapbeam_error, only: error_type
    use gapbeam_api, only: options_type
    use gapbeam_api_ground, only: contact_type, free_span_type, ground_event_type, follow_ground, get_contact, get_free_spans, &
        get_pressure, get_pressure_extremes
    use gapbeam_handles, only: handle_type
    use gapbeam_capi_objects, only: c_options, get_both, read_options, check_points, check_flag, forget, report
    implicit none
    private

contains

    function gapbeam_follow_ground(beam, factor, options, capacity, event_factor, event_support, event_foundation, event_branch, &
                                   event_x, event_change, number, state, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(in), value :: factor
        type(c_options), intent(in), optional :: options
        integer(c_int), intent(in), value :: capacity
        real(c_double), intent(inout), optional :: event_factor(*), event_x(*)
        integer(c_int), intent(inout), optional :: event_support(*), event_foundation(*), event_branch(*), event_change(*)
        integer(c_int), intent(inout), optional :: number
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(options_type) :: chosen
        type(ground_event_type), allocatable :: events(:)
        type(error_type), allocatable :: error
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        call read_options(options, chosen, error)
        if (.not. allocated(error)) call follow_ground(prepared%beam, factor, chosen, events, solved%result, error)
        call forget(solved, error)
        call report(error, status, message, message_size)
        if (allocated(error)) return
        status = solved%result%status
        if (present(number)) number = size(events)
        n = min(int(capacity), size(events))
        if (present(event_factor)) event_factor(1:n) = events(:n)%factor
        if (present(event_support)) event_support(1:n) = events(:n)%support - 1
        if (present(event_foundation)) event_foundation(1:n) = events(:n)%foundation - 1
        if (present(event_branch)) event_branch(1:n) = events(:n)%branch
        if (present(event_x)) event_x(1:n) = events(:n)%x
        if (present(event_change)) event_change(1:n) = events(:n)%change
    end function gapbeam_follow_ground

    function gapbeam_get_contact(beam, state, capacity, foundation, from, to, condition, resultant, number) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: capacity
        integer(c_int), intent(inout), optional :: foundation(*), condition(*)
        real(c_double), intent(inout), optional :: from(*), to(*), resultant(*)
        integer(c_int), intent(inout), optional :: number
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(contact_type), allocatable :: zones(:)
        type(error_type), allocatable :: error
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_contact(prepared%beam, solved%result, zones, error)
        call report(error, status)
        if (allocated(error)) return
        if (present(number)) number = size(zones)
        n = min(int(capacity), size(zones))
        if (present(foundation)) foundation(1:n) = zones(:n)%foundation - 1
        if (present(from)) from(1:n) = zones(:n)%from
        if (present(to)) to(1:n) = zones(:n)%to
        if (present(condition)) condition(1:n) = zones(:n)%condition
        if (present(resultant)) resultant(1:n) = zones(:n)%resultant
    end function gapbeam_get_contact

    function gapbeam_get_free_spans(beam, state, capacity, foundation, from, to, sag, number) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: capacity
        integer(c_int), intent(inout), optional :: foundation(*)
        real(c_double), intent(inout), optional :: from(*), to(*), sag(*)
        integer(c_int), intent(inout), optional :: number
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_free_spans(prepared%beam, solved%result, spans, error)
        call report(error, status)
        if (allocated(error)) return
        if (present(number)) number = size(spans)
        n = min(int(capacity), size(spans))
        if (present(foundation)) foundation(1:n) = spans(:n)%foundation - 1
        if (present(from)) from(1:n) = spans(:n)%from
        if (present(to)) to(1:n) = spans(:n)%to
        if (present(sag)) sag(1:n) = spans(:n)%sag
    end function gapbeam_get_free_spans

    function gapbeam_get_pressure(beam, state, count, x, from_left, pressure, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: count, from_left
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: pressure(*)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error

        call get_both(beam, state, prepared, solved, error)
        call check_points(count, present(x) .and. present(pressure), "x or pressure", error)
        call check_flag("from_left", from_left, error)
        if (.not. allocated(error) .and. count > 0) then
            call get_pressure(prepared%beam, solved%result, x(1:count), pressure(1:count), error, from_left == 1)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_get_pressure

    function gapbeam_get_pressure_extremes(beam, state, value, x) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: value(2), x(2)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double) :: values(2), places(2)

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_pressure_extremes(prepared%beam, solved%result, values, places, error)
        call report(error, status)
        if (allocated(error)) return
        if (present(value)) value(:) = values
        if (present(x)) x(:) = places
    end function gapbeam_get_pressure_extremes

end module gapbeam_capi_ground
