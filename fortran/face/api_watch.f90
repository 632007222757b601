!> The end of calls that take long, from outside: by a question that they ask, by another thread, or by a time limit
module gapbeam_api_watch
    use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_loc, c_funloc, c_null_ptr, c_null_funptr, c_int
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_watch, only: watch_type, begin_watch, end_watched
    use gapbeam_api_objects, only: prepared_type, require_beam
    implicit none
    private
    public :: watch_type, watch_beam, stop_calls

    abstract interface
        !> Is the call at work to end: not 0
        function question(data) result(ends) bind(c)
            import :: c_ptr, c_int
            implicit none
            !> As for watch_beam
            type(c_ptr), intent(in), value :: data
            integer(c_int) :: ends
        end function question
    end interface

contains

    !> Watch all calls with a beam, and with those that combine_loads makes of it, from now on. One that is ended has the error
    !> gapbeam_stopped, and so have all others until watch_beam is called again. Calls look between two linear solves
    subroutine watch_beam(beam, watch, error, seconds, ask, data)
        !> Prepared; no other thread may be at work with it
        type(prepared_type), intent(inout) :: beam
        !> Has the attribute target, and lives as long as the beam; what ended before goes on
        type(watch_type), intent(inout), target :: watch
        !> gapbeam_bad_input, gapbeam_not_prepared
        type(error_type), allocatable, intent(out) :: error
        !> When calls are to end, counted from now, 0 or more; default never
        real(wp), intent(in), optional :: seconds
        !> Asked every 10 ms or so by the thread at work, with `data`; default nobody is asked
        procedure(question), optional :: ask
        type(c_ptr), intent(in), optional :: data
        type(c_funptr) :: asked
        type(c_ptr) :: about
        real(wp) :: limit

        limit = huge(limit)
        if (present(seconds)) limit = seconds
        call require_beam(beam, error)
        if (allocated(error)) return
        if (.not. limit >= 0.0_wp) then
            call fatal_error(error, gapbeam_bad_input, "seconds: expected 0 or more, got "//trim(shown(limit)))
            return
        end if
        asked = c_null_funptr
        if (present(ask)) asked = c_funloc(ask)
        about = c_null_ptr
        if (present(data)) about = data
        call begin_watch(watch, asked, about, limit)
        beam%lowered%beam%watch = c_loc(watch)
    end subroutine watch_beam

    !> End all calls with the beams of a watch, those to come too; from any thread
    subroutine stop_calls(watch)
        type(watch_type), intent(inout) :: watch

        call end_watched(watch)
    end subroutine stop_calls

end module gapbeam_api_watch
