!> The end of calls that take long, from outside, for C: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_watch
    use, intrinsic :: iso_c_binding, only: c_int, c_double, c_ptr, c_funptr, c_loc
    use gapbeam_error, only: gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_watch, only: begin_watch, end_watched
    use gapbeam_handles, only: handle_type, beam_tag, find_handle
    implicit none
    private
    public :: gapbeam_set_watch, gapbeam_stop

contains

    function gapbeam_set_watch(beam, ask, data, seconds) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        type(c_funptr), intent(in), value :: ask
        type(c_ptr), intent(in), value :: data
        real(c_double), intent(in), value :: seconds
        integer(c_int) :: status
        type(handle_type), pointer :: handle

        status = gapbeam_not_prepared
        call find_handle(beam, beam_tag, handle)
        if (.not. associated(handle)) return
        status = gapbeam_bad_input
        if (.not. seconds >= 0.0_c_double) return
        call begin_watch(handle%watch, ask, data, seconds)
        handle%beam%lowered%beam%watch = c_loc(handle%watch)
        status = gapbeam_solved
    end function gapbeam_set_watch

    subroutine gapbeam_stop(beam) bind(c)
        type(c_ptr), intent(in), value :: beam
        type(handle_type), pointer :: handle

        call find_handle(beam, beam_tag, handle)
        if (associated(handle)) call end_watched(handle%watch)
    end subroutine gapbeam_stop

end module gapbeam_capi_watch
