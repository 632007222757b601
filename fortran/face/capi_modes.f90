!> Modes and buckling in the C interface: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_modes
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_api_modes, only: get_modes, get_mode_shape, get_mode_amplitude, get_buckling
    use gapbeam_handles, only: handle_type
    use gapbeam_capi_objects, only: get_both, check_points, report
    implicit none
    private

contains

    function gapbeam_get_modes(beam, state, kind, count, values, number, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: kind, count
        real(c_double), intent(inout), optional :: values(*)
        integer(c_int), intent(inout), optional :: number
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double), allocatable :: found(:)
        integer :: known, stat

        call get_both(beam, state, prepared, solved, error)
        call check_points(count, present(values), "values", error)
        if (.not. allocated(error)) then
            allocate (found(count), stat=stat)
            if (stat /= 0) call no_memory(error)
        end if
        if (.not. allocated(error)) call get_modes(prepared%beam, solved%result, kind, found, known, error)
        call report(error, status, message, message_size)
        if (allocated(error)) return
        if (count > 0) values(1:known) = found(:known)
        if (present(number)) number = known
    end function gapbeam_get_modes

    function gapbeam_get_mode_shape(beam, state, kind, value, parts, capacity, x, deflection, moment, number, message, &
                                    message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: kind, parts, capacity
        real(c_double), intent(in), value :: value
        real(c_double), intent(inout), optional :: x(*), deflection(*), moment(2, *)
        integer(c_int), intent(inout), optional :: number
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double), allocatable :: places(:), deflections(:), moments(:, :)
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_mode_shape(prepared%beam, solved%result, kind, value, parts, places, deflections, &
                                                        moments, error)
        call report(error, status, message, message_size)
        if (allocated(error)) return
        if (present(number)) number = size(places)
        n = max(0, min(int(capacity), size(places)))
        if (present(x)) x(1:n) = places(:n)
        if (present(deflection)) deflection(1:n) = deflections(:n)
        if (present(moment)) moment(:, 1:n) = moments(:, :n)
    end function gapbeam_get_mode_shape

    function gapbeam_get_mode_amplitude(beam, state, kind, value, parts, amplitude, support, message, message_size) &
        result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: kind, parts
        real(c_double), intent(in), value :: value
        real(c_double), intent(inout), optional :: amplitude
        integer(c_int), intent(inout), optional :: support
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double) :: swing
        integer :: first

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_mode_amplitude(prepared%beam, solved%result, kind, value, parts, swing, first, error)
        call report(error, status, message, message_size)
        if (allocated(error)) return
        if (present(amplitude)) amplitude = swing
        if (present(support)) support = first - 1
    end function gapbeam_get_mode_amplitude

    function gapbeam_get_buckling(beam, state, share, capacity, x, deflection, number) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        real(c_double), intent(inout), optional :: share
        integer(c_int), intent(in), value :: capacity
        real(c_double), intent(inout), optional :: x(*), deflection(*)
        integer(c_int), intent(inout), optional :: number
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double), allocatable :: places(:), deflections(:)
        real(c_double) :: borne
        integer :: n

        call get_both(beam, state, prepared, solved, error)
        if (.not. allocated(error)) call get_buckling(prepared%beam, solved%result, borne, places, deflections, error)
        call report(error, status)
        if (allocated(error)) return
        if (present(share)) share = borne
        if (present(number)) number = size(places)
        n = max(0, min(int(capacity), size(places)))
        if (present(x)) x(1:n) = places(:n)
        if (present(deflection)) deflection(1:n) = deflections(:n)
    end function gapbeam_get_buckling

end module gapbeam_capi_modes
