!> Watch on calls that take long, asked between linear solves whether they are to go on.
!> Whoever calls keeps it, and a beam refers to it; a call that is not to go on ends with the status gapbeam_stopped. Once the watch
!> says so it stays so, until it begins anew.
module gapbeam_watch
    use, intrinsic :: iso_c_binding, only: c_int, c_int64_t, c_double, c_ptr, c_funptr, c_null_ptr, c_null_funptr, c_associated
    use gapbeam_error, only: error_type, fatal_error, status_text, gapbeam_stopped
    implicit none
    private
    public :: watch_type, begin_watch, end_watched, is_stopped, end_if_stopped

    !> As struct watch in watch.c, which alone reads and writes it
    type, bind(c) :: watch_type
        private
        integer(c_int64_t) :: ended = 0, asked = 0, until = huge(0_c_int64_t)
        type(c_funptr) :: ask = c_null_funptr
        type(c_ptr) :: data = c_null_ptr
    end type watch_type

    interface
        !> Watch from now on; what ended before goes on
        subroutine begin_watch(watch, ask, data, seconds) bind(c, name="gb_watch_begin")
            import :: watch_type, c_funptr, c_ptr, c_double
            implicit none
            !> Kept by the caller until no beam refers to it
            type(watch_type), intent(inout) :: watch
            !> A C function of `data` that is asked every 10 ms or so by the thread at work: calls end where it says something else
            !> than 0; or null
            type(c_funptr), intent(in), value :: ask
            type(c_ptr), intent(in), value :: data
            !> When calls are to end, counted from now; more than 9e9: never
            real(c_double), intent(in), value :: seconds
        end subroutine begin_watch

        !> Let all calls end that look at it, from any thread, or from a handler of a signal
        subroutine end_watched(watch) bind(c, name="gb_watch_end")
            import :: watch_type
            implicit none
            type(watch_type), intent(inout) :: watch
        end subroutine end_watched

        !> Look at it
        function look_at_watch(watch) result(ends) bind(c, name="gb_watch_look")
            import :: c_ptr, c_int
            implicit none
            type(c_ptr), intent(in), value :: watch
            integer(c_int) :: ends
        end function look_at_watch
    end interface

contains

    !> Is the work to end
    function is_stopped(watch) result(stopped)
        !> Address of the watch; null: nobody watches
        type(c_ptr), intent(in) :: watch
        logical :: stopped

        stopped = c_associated(watch)
        if (stopped) stopped = look_at_watch(watch) /= 0
    end function is_stopped

    !> Say that the work was ended: what was found until then is worth nothing
    subroutine end_if_stopped(watch, error)
        type(c_ptr), intent(in) :: watch
        !> Another one where the work was ended; else left as it is
        type(error_type), allocatable, intent(inout) :: error

        if (is_stopped(watch)) call fatal_error(error, gapbeam_stopped, trim(status_text(gapbeam_stopped)))
    end subroutine end_if_stopped

end module gapbeam_watch
