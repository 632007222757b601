!> Combinations of load cases in the C interface: marshalling only. include/gapbeam.h says what the function does.
module gapbeam_capi_combinations
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_char, c_size_t, c_ptr, c_null_ptr, c_loc
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_api_combinations, only: combine_loads
    use gapbeam_capi_objects, only: beam_handle, get_beam, report
    implicit none
    private

contains

    !> See the header
    function c_combine_loads(beam, factors, settlements, combined, message, message_size) result(status) &
        bind(c, name="gapbeam_combine_loads")
        type(c_ptr), intent(in), value :: beam
        real(c_double), intent(in), optional :: factors(*), settlements(*)
        type(c_ptr), intent(out), optional :: combined
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(beam_handle), pointer :: handle, made
        type(error_type), allocatable :: error
        integer :: loads, supports, stat

        if (present(combined)) combined = c_null_ptr
        call get_beam(beam, handle)
        if (.not. associated(handle)) then
            call fatal_error(error, gapbeam_not_prepared, "beam is no prepared beam")
        else if (.not. (present(factors) .and. present(combined))) then
            call fatal_error(error, gapbeam_bad_input, "factors or combined is NULL")
        else
            allocate (made, stat=stat)
            if (stat /= 0) then
                call no_memory(error)
            else
                loads = size(handle%beam%lowered%model%loads)
                supports = size(handle%beam%lowered%model%supports)
                if (present(settlements)) then
                    call combine_loads(handle%beam, factors(1:loads), made%beam, error, settlements(1:supports))
                else
                    call combine_loads(handle%beam, factors(1:loads), made%beam, error)
                end if
                if (allocated(error)) then
                    deallocate (made)
                else
                    made%beam%lowered%beam%watch = c_loc(made%watch)
                    combined = c_loc(made)
                end if
            end if
        end if
        call report(error, status, message, message_size)
    end function c_combine_loads

end module gapbeam_capi_combinations
