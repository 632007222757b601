!> Combinations of load cases in the C interface: marshalling only. include/gapbeam.h says what the function does.
module gapbeam_capi_combinations
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_null_ptr
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_handles, only: handle_type, address_of
    use gapbeam_new_objects, only: new_combination
    use gapbeam_capi_objects, only: get_beam, report
    implicit none
    private

contains

    function gapbeam_combine_loads(beam, factors, settlements, combined, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        real(c_double), intent(in), optional :: factors(*), settlements(*)
        type(c_ptr), intent(out), optional :: combined
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: handle, other
        type(error_type), allocatable :: error

        if (present(combined)) combined = c_null_ptr
        call get_beam(beam, handle, error)
        if (.not. allocated(error) .and. .not. (present(factors) .and. present(combined))) then
            call fatal_error(error, gapbeam_bad_input, "factors or combined is NULL")
        end if
        if (.not. allocated(error)) then
            associate (model => handle%beam%lowered%model)
                if (present(settlements)) then
                    call new_combination(handle%beam, factors(1:size(model%loads)), settlements(1:size(model%supports)), &
                                         other, error)
                else
                    call new_combination(handle%beam, factors(1:size(model%loads)), handle=other, error=error)
                end if
            end associate
            combined = address_of(other)
        end if
        call report(error, status, message, message_size)
    end function gapbeam_combine_loads

end module gapbeam_capi_combinations
