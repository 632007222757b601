!> Quantities along the beam by their numbers in the C interface: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_quantities
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: whole
    use gapbeam_quantities, only: quantity_count
    use gapbeam_api_quantities, only: get_quantities, get_quantity_extremes
    use gapbeam_api_trains, only: train_extreme_type, get_train_quantity_extremes, get_train_quantity_curves, copy_extremes
    use gapbeam_handles, only: handle_type
    use gapbeam_capi_objects, only: get_both, get_train, check_points, check_flag, report
    implicit none
    private
    public :: gapbeam_get_quantity_extremes, gapbeam_get_train_quantity_curves

contains

    function gapbeam_get_quantities(beam, state, quantities, quantity, count, x, from_left, values, message, message_size) &
        result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: quantities, count, from_left
        integer(c_int), intent(in), optional :: quantity(*)
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: values(quantities, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error

        call get_both(beam, state, prepared, solved, error)
        call check_quantities(quantities, present(quantity), error, quantity)
        call check_points(count, present(x) .and. present(values), "x or values", error)
        call check_flag("from_left", from_left, error)
        if (.not. allocated(error) .and. count > 0) then
            call get_quantities(prepared%beam, solved%result, quantity(1:quantities) + 1, x(1:count), values(:, 1:count), error, &
                                from_left == 1)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_get_quantities

    function gapbeam_get_quantity_extremes(beam, state, quantities, quantity, value, x, message, message_size) &
        result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, state
        integer(c_int), intent(in), value :: quantities
        integer(c_int), intent(in), optional :: quantity(*)
        real(c_double), intent(inout), optional :: value(2, *), x(2, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, solved
        type(error_type), allocatable :: error
        real(c_double) :: values(2, max(quantities, 0)), places(2, max(quantities, 0))

        call get_both(beam, state, prepared, solved, error)
        call check_quantities(quantities, present(quantity), error, quantity)
        if (.not. allocated(error)) then
            call get_quantity_extremes(prepared%beam, solved%result, quantity(1:quantities) + 1, values, places, error)
        end if
        call report(error, status, message, message_size)
        if (allocated(error)) return
        if (present(value)) value(:, 1:quantities) = values
        if (present(x)) x(:, 1:quantities) = places
    end function gapbeam_get_quantity_extremes

    function gapbeam_get_train_quantity_extremes(beam, passing, quantities, quantity, values, message, message_size) &
        result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, passing
        integer(c_int), intent(in), value :: quantities
        integer(c_int), intent(in), optional :: quantity(*)
        real(c_double), intent(inout), optional :: values(4, 2, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, handle
        type(train_extreme_type) :: found(2, max(quantities, 0))
        type(error_type), allocatable :: error

        call get_train(beam, passing, prepared, handle, error)
        call check_quantities(quantities, present(quantity) .and. present(values), error, quantity)
        if (.not. allocated(error)) then
            call get_train_quantity_extremes(prepared%beam, handle%passing, quantity(1:quantities) + 1, found, error)
        end if
        call report(error, status, message, message_size)
        if (allocated(error)) return
        call copy_extremes(found, values(:, :, 1:quantities))
    end function gapbeam_get_train_quantity_extremes

    function gapbeam_get_train_quantity_curves(beam, passing, quantities, quantity, count, x, value, position, message, &
                                               message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam, passing
        integer(c_int), intent(in), value :: quantities, count
        integer(c_int), intent(in), optional :: quantity(*)
        real(c_double), intent(in), optional :: x(*)
        real(c_double), intent(inout), optional :: value(2, quantities, *), position(2, quantities, *)
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared, handle
        type(error_type), allocatable :: error

        call get_train(beam, passing, prepared, handle, error)
        call check_quantities(quantities, present(quantity), error, quantity)
        call check_points(count, present(x) .and. present(value) .and. present(position), "x, value or position", error)
        if (.not. allocated(error) .and. count > 0) then
            call get_train_quantity_curves(prepared%beam, handle%passing, quantity(1:quantities) + 1, x(1:count), &
                                           value(:, :, 1:count), position(:, :, 1:count), error)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_get_train_quantity_curves

    !> Refuse quantities that make no sense, as C counts them
    subroutine check_quantities(quantities, given, error, quantity)
        integer(c_int), intent(in) :: quantities
        !> Are they given
        logical, intent(in) :: given
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error
        integer(c_int), intent(in), optional :: quantity(*)
        integer :: k

        if (allocated(error)) return
        if (quantities < 1) then
            call fatal_error(error, gapbeam_bad_input, "quantities: expected 1 or more")
        else if (.not. given) then
            call fatal_error(error, gapbeam_bad_input, "quantity or values is NULL")
        else
            do k = 1, quantities
                if (quantity(k) >= 0 .and. quantity(k) < quantity_count) cycle
                call fatal_error(error, gapbeam_bad_input, "quantity["//trim(whole(k - 1))//"]: expected a number from 0 to "// &
                                 trim(whole(quantity_count - 1))//", got "//trim(whole(int(quantity(k)))))
                return
            end do
        end if
    end subroutine check_quantities

end module gapbeam_capi_quantities
