!> Trains in the C interface: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_trains
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_null_ptr
    use gapbeam_error, only: error_type, fatal_error, failed, no_memory, gapbeam_solved, gapbeam_bad_input
    use gapbeam_api, only: count_supports
    use gapbeam_api_trains, only: moving_train_type, train_extreme_type, get_train_extremes, copy_extremes
    use gapbeam_handles, only: handle_type, passing_tag, find_handle, free_handle, address_of
    use gapbeam_new_objects, only: new_passing
    use gapbeam_capi_objects, only: get_beam, get_train, check_flag, report
    use gapbeam_capi_quantities, only: gapbeam_get_train_quantity_curves
    implicit none
    private

contains

    function gapbeam_follow_train(beam, axles, distance, force, q, to_the_left, from, to, passing, message, message_size) &
        result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        integer(c_int), intent(in), value :: axles, to_the_left
        real(c_double), intent(in), optional :: distance(*), force(*), from, to
        real(c_double), intent(in), value :: q
        type(c_ptr), intent(out), optional :: passing
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, passed
        type(moving_train_type) :: train
        type(error_type), allocatable :: error
        integer :: stat

        if (present(passing)) passing = c_null_ptr
        call get_beam(beam, prepared, error)
        call check_flag("to_the_left", to_the_left, error)
        if (allocated(error)) then
            continue
        else if (.not. present(passing)) then
            call fatal_error(error, gapbeam_bad_input, "passing is NULL")
        else if (axles < 1 .or. .not. (present(distance) .and. present(force))) then
            call fatal_error(error, gapbeam_bad_input, "distance and force: give at least one axle")
        else
            allocate (train%distance(axles), train%force(axles), stat=stat)
            if (stat /= 0) call no_memory(error)
        end if
        if (.not. allocated(error)) then
            train%distance(:) = distance(1:axles)
            train%force(:) = force(1:axles)
            train%q = q
            train%to_the_left = to_the_left == 1
            if (present(from)) train%from = from
            if (present(to)) train%to = to
            call new_passing(prepared%beam, train, passed, error)
            passing = address_of(passed)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_follow_train

    subroutine gapbeam_free_passing(passing) bind(c)
        type(c_ptr), intent(in), value :: passing

        call free_handle(passing, passing_tag)
    end subroutine gapbeam_free_passing

    function gapbeam_get_train_events(passing, capacity, position, support, condition, change, number) result(status) bind(c)
        type(c_ptr), intent(in), value :: passing
        integer(c_int), intent(in), value :: capacity
        real(c_double), intent(inout), optional :: position(*)
        integer(c_int), intent(inout), optional :: support(*), condition(*), change(*)
        integer(c_int), intent(inout), optional :: number
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(passing, passing_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (events => handle%passing%events, n => min(int(capacity), size(handle%passing%events)))
            if (present(number)) number = size(events)
            if (present(position)) position(1:n) = events(:n)%position
            if (present(support)) support(1:n) = events(:n)%support - 1
            if (present(condition)) condition(1:n) = events(:n)%state
            if (present(change)) change(1:n) = events(:n)%change
        end associate
    end function gapbeam_get_train_events

    function gapbeam_get_train_gaps(passing, capacity, from, to, reason, number) result(status) bind(c)
        type(c_ptr), intent(in), value :: passing
        integer(c_int), intent(in), value :: capacity
        real(c_double), intent(inout), optional :: from(*), to(*)
        integer(c_int), intent(inout), optional :: reason(*)
        integer(c_int), intent(inout), optional :: number
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        call find_handle(passing, passing_tag, handle, status)
        if (status /= gapbeam_solved) return
        associate (gaps => handle%passing%gaps, n => min(int(capacity), size(handle%passing%gaps)))
            if (present(number)) number = size(gaps)
            if (present(from)) from(1:n) = gaps(:n)%from
            if (present(to)) to(1:n) = gaps(:n)%to
            if (present(reason)) reason(1:n) = gaps(:n)%reason
        end associate
    end function gapbeam_get_train_gaps

    function gapbeam_get_train_extremes(beam, passing, fields, supports) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, passing
        real(c_double), intent(inout), optional :: fields(4, 2, 4), supports(4, 2, 4, *)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, handle
        type(train_extreme_type) :: of_fields(2, 4)
        type(train_extreme_type), allocatable :: of_supports(:, :, :)
        type(error_type), allocatable :: error
        integer :: k, stat

        call get_train(beam, passing, prepared, handle, error)
        if (.not. allocated(error)) then
            allocate (of_supports(2, 4, count_supports(prepared%beam)), stat=stat)
            if (.not. failed(stat, error)) call get_train_extremes(prepared%beam, handle%passing, of_fields, of_supports, error)
        end if
        call report(error, status)
        if (allocated(error)) return
        if (present(fields)) call copy_extremes(of_fields, fields)
        if (.not. present(supports)) return
        do k = 1, size(of_supports, 3)
            call copy_extremes(of_supports(:, :, k), supports(:, :, :, k))
        end do
    end function gapbeam_get_train_extremes

    function gapbeam_get_train_curves(beam, passing, count, x, value, position, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, passing
        integer(c_int), intent(in), value :: count
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: value(2, 4, *), position(2, 4, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status

        status = gapbeam_get_train_quantity_curves(beam, passing, 4, [0, 1, 2, 3], count, x, value, position, message, message_size)
    end function gapbeam_get_train_curves

end module gapbeam_capi_trains
