! Calls that take long, ended from outside, in Fortran 77: by a function that they ask, a time limit, or another thread. Marshalling
! only; handles and INFO: see fortran77.f90. A call that is ended has INFO 18, and so have all others with the beam until GHWTCH or
! GHLIMT is called again. Calls look between two linear solves.

! Watch all calls with a beam from now on; what was ended goes on
subroutine ghwtch(beam, ask, idata, second, info)
    use, intrinsic :: iso_c_binding, only: c_int, c_loc, c_funloc
    use gapbeam_watch, only: begin_watch
    use gapbeam_fortran77_info, only: handle_type, beam_tag, find_first
    implicit none
    interface
        ! INTEGER FUNCTION ASK(IDATA), EXTERNAL where GHWTCH is called: asked every 10 ms or so by the thread at work; not 0 where
        ! the call is to end
        function ask(idata) result(ends) bind(c)
            import :: c_int
            implicit none
            integer(c_int), intent(inout) :: idata(*)
            integer(c_int) :: ends
        end function ask
    end interface
    ! No other thread may be at work with it
    integer(8), intent(in) :: beam
    ! Given to ASK: in COMMON or SAVE, since it is read as long as the beam is watched
    integer, intent(inout), target :: idata(*)
    ! Seconds from now after which calls are to end, 0 or more; GBINF(): never
    double precision, intent(in) :: second
    ! -1, -4
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. .not. second >= 0.0d0) info = -4
    if (info == 0) call begin_watch(prepared%watch, c_funloc(ask), c_loc(idata), second)
end subroutine ghwtch

! The same by a time limit alone
subroutine ghlimt(beam, second, info)
    use, intrinsic :: iso_c_binding, only: c_null_ptr, c_null_funptr
    use gapbeam_watch, only: begin_watch
    use gapbeam_fortran77_info, only: handle_type, beam_tag, find_first
    implicit none
    integer(8), intent(in) :: beam
    ! As for GHWTCH
    double precision, intent(in) :: second
    ! -1, -2
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. .not. second >= 0.0d0) info = -2
    if (info == 0) call begin_watch(prepared%watch, c_null_funptr, c_null_ptr, second)
end subroutine ghlimt

! End all calls with a beam, from any thread
subroutine ghstop(beam, info)
    use gapbeam_watch, only: end_watched
    use gapbeam_fortran77_info, only: handle_type, beam_tag, find_first
    implicit none
    integer(8), intent(in) :: beam
    ! -1
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0) call end_watched(prepared%watch)
end subroutine ghstop
