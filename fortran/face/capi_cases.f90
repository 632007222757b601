!> Many cases in the C interface: marshalling only. include/gapbeam.h says what the functions do.
module gapbeam_capi_cases
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_null_ptr, c_f_pointer, c_associated
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_api, only: options_type, count_supports, count_nodes
    use gapbeam_api_cases, only: solve_cases, get_nodes
    use gapbeam_handles, only: handle_type, cases_tag, find_handle, free_handle, address_of
    use gapbeam_new_objects, only: new_cases
    use gapbeam_capi_objects, only: c_options, get_beam, read_options, report
    implicit none
    private

contains

    function gapbeam_prepare_cases(beam, cases, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        type(c_ptr), intent(out), optional :: cases
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, room
        type(error_type), allocatable :: error

        if (present(cases)) cases = c_null_ptr
        call get_beam(beam, prepared, error)
        if (.not. allocated(error) .and. .not. present(cases)) call fatal_error(error, gapbeam_bad_input, "cases is NULL")
        if (.not. allocated(error)) call new_cases(prepared%beam, room, error)
        if (.not. allocated(error)) cases = address_of(room)
        call report(error, status, message, message_size)
    end function gapbeam_prepare_cases

    subroutine gapbeam_free_cases(cases) bind(c)
        type(c_ptr), intent(in), value :: cases

        call free_handle(cases, cases_tag)
    end subroutine gapbeam_free_cases

    function gapbeam_solve_cases(beam, cases, count, factors, settlement, gap, stiffness, options, status_of, reaction, condition, &
                                 deflection, moment_left, moment_right, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, cases
        integer(c_int), intent(in), value :: count
        type(c_ptr), intent(in), value :: factors, settlement, gap, stiffness
        type(c_options), intent(in), optional :: options
        type(c_ptr), intent(in), value :: status_of, reaction, condition, deflection, moment_left, moment_right
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, handle
        type(error_type), allocatable :: error
        type(options_type) :: chosen
        real(c_double), pointer :: shares(:, :), moves(:, :), gaps(:, :), springs(:, :), forces(:, :), w(:, :), left(:, :), &
                                   right(:, :)
        integer(c_int), pointer :: statuses(:), conditions(:, :)
        integer :: loads, supports, nodes

        call find_handle(cases, cases_tag, handle)
        call get_beam(beam, prepared, error)
        if (allocated(error)) then
            continue
        else if (.not. associated(handle)) then
            call fatal_error(error, gapbeam_not_prepared, "cases are none: make them with gapbeam_prepare_cases")
        else if (count < 0) then
            call fatal_error(error, gapbeam_bad_input, "count is negative")
        else if (count > 0 .and. .not. (c_associated(factors) .and. c_associated(status_of))) then
            call fatal_error(error, gapbeam_bad_input, "factors or status is NULL")
        else
            call read_options(options, chosen, error)
        end if
        if (.not. allocated(error) .and. count > 0) then
            loads = size(prepared%beam%lowered%model%loads)
            supports = count_supports(prepared%beam)
            nodes = count_nodes(prepared%beam)
            call c_f_pointer(factors, shares, [loads, int(count)])
            call c_f_pointer(status_of, statuses, [count])
            call look_at(settlement, supports, count, moves)
            call look_at(gap, supports, count, gaps)
            call look_at(stiffness, supports, count, springs)
            call look_at(reaction, supports, count, forces)
            call look_at(deflection, nodes, count, w)
            call look_at(moment_left, nodes, count, left)
            call look_at(moment_right, nodes, count, right)
            nullify (conditions)
            if (c_associated(condition)) call c_f_pointer(condition, conditions, [supports, int(count)])
            ! What is not associated is not present
            call solve_cases(prepared%beam, handle%cases, shares, statuses, error, moves, gaps, springs, chosen, forces, &
                             conditions, w, left, right)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_solve_cases

    function gapbeam_get_nodes(beam, x, support_node) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        real(c_double), intent(inout), optional :: x(*)
        integer(c_int), intent(inout), optional :: support_node(*)
        integer(c_int) :: status
        type(handle_type), pointer :: prepared
        type(error_type), allocatable :: error
        real(c_double), allocatable :: places(:)
        integer, allocatable :: nodes(:)
        integer :: stat

        call get_beam(beam, prepared, error)
        if (.not. allocated(error)) then
            allocate (places(count_nodes(prepared%beam)), nodes(count_supports(prepared%beam)), stat=stat)
            if (.not. failed(stat, error)) call get_nodes(prepared%beam, places, error, nodes)
        end if
        call report(error, status)
        if (allocated(error)) return
        if (present(x)) x(1:size(places)) = places
        if (present(support_node)) support_node(1:size(nodes)) = nodes - 1
    end function gapbeam_get_nodes

    !> An array of rows by cases, or nothing
    subroutine look_at(address, rows, count, values)
        type(c_ptr), intent(in) :: address
        integer, intent(in) :: rows
        integer(c_int), intent(in) :: count
        real(c_double), pointer, intent(out) :: values(:, :)

        nullify (values)
        if (c_associated(address)) call c_f_pointer(address, values, [rows, int(count)])
    end subroutine look_at

end module gapbeam_capi_cases
