! Histories of the load in Fortran 77: the exact path, through limit points, of beams whose supports may soften, break or keep a
! set. Marshalling only; units, signs, WORK, STATE and INFO: see fortran77.f90.

! Put on the dead loads, settlements and lacks of fit together, then go through load factors in turn, from factor 0, by the exact
! path: through every event, past limits of the load, with supports that soften, break or keep a set
subroutine gbhist(work, iwork, nfact, factor, limit, maxst, stfact, istrch, maxev, evfact, ievent, maxlim, lmfact, ilimit, &
                  number, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_api, only: prepared_type
    use gapbeam_api_history, only: history_type, follow_history
    use gapbeam_work, only: take_beam, check_history
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! Load factors, 1 or more
    integer, intent(in) :: nfact
    double precision, intent(in) :: factor(*)
    ! Where the load cannot go on: 0 end there; 1 go on from the next stable state on the path at this factor; 2 follow the
    ! path, also with falling load
    integer, intent(in) :: limit
    ! Room for stretches, events and limits, 0 or more
    integer, intent(in) :: maxst, maxev, maxlim
    ! The first MAXST stretches: load factors at their ends; factor that is gone to, from 1, 0 while the dead loads are put on;
    ! 1 the load rises, -1 it falls, 0 the beam turns; 1 stable, 0 not; in how many independent ways the beam gives way by
    ! itself; ways on there were at its beginning; 1 passed in a jump, or beyond the limit at which the load stops
    double precision, intent(inout) :: stfact(2, *)
    integer, intent(inout) :: istrch(6, *)
    ! The first MAXEV events: load factor; support; what it is from there on, as from GBEVNT; what happens, 0 opens, 1 closes,
    ! 3 turns, 4 yields, 5 hardens, 6 softens, 7 breaks, 8 unloads; stretch that begins with it
    double precision, intent(inout) :: evfact(*)
    integer, intent(inout) :: ievent(4, *)
    ! The first MAXLIM limits: load factor; kind, 1 limit point, 2 bifurcation, 3 mechanism; factor that is gone to; last stretch
    ! before it; stretch on which the beam lands at the same factor, 0 if none
    double precision, intent(inout) :: lmfact(*)
    integer, intent(inout) :: ilimit(4, *)
    ! Numbers of stretches, events and limits, which may be more than there is room for; how the path ends, 0 at the last factor, 3
    ! in a mechanism, 4 otherwise; linear solves in quadruple precision
    integer, intent(inout) :: number(5)
    ! -1: no beam in WORK, or one on a foundation; -3, -4, -5, -6, -9, -12; 13 to 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(history_type) :: history
    type(error_type), allocatable :: error
    integer :: k

    info = check_history(nfact, factor, limit)
    if (maxst < 0) info = -6
    if (maxev < 0) info = -9
    if (maxlim < 0) info = -12
    if (info /= 0) return
    call take_beam(work, iwork, 1, beam, info)
    if (info /= 0) return
    call follow_history(beam, factor(1:nfact), limit, history, error)
    if (allocated(error)) then
        info = merge(-1, error%code, error%code == gapbeam_bad_input)
        return
    end if
    number = [size(history%stretches), size(history%events), size(history%limits), history%ending, history%solves]
    do k = 1, min(maxst, number(1))
        associate (s => history%stretches(k))
            stfact(:, k) = [s%from, s%to]
            istrch(:, k) = [s%leg, s%direction, merge(1, 0, s%stable), s%index, s%ways, merge(1, 0, s%skipped)]
        end associate
    end do
    do k = 1, min(maxev, number(2))
        associate (event => history%events(k))
            evfact(k) = event%factor
            ievent(:, k) = [event%support, event%state, event%change, event%stretch]
        end associate
    end do
    do k = 1, min(maxlim, number(3))
        associate (found => history%limits(k))
            lmfact(k) = found%factor
            ilimit(:, k) = [found%kind, found%leg, found%stretch, found%landing]
        end associate
    end do
end subroutine gbhist

! The state at a load factor on the path of GBHIST, which is followed again for that
subroutine gbhsol(work, iwork, nfact, factor, limit, nstrch, at, state, lstate, istate, listat, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_search, only: rule_block
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_api_history, only: history_type, follow_history, solve_on_path
    use gapbeam_work, only: begin_result, put_result, check_history
    implicit none
    ! Beam, and factors and limit as for GBHIST
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*), nfact
    double precision, intent(in) :: factor(*)
    integer, intent(in) :: limit
    ! Number of the stretch; 0: the last one with AT that is not passed in a jump, a stable one if there is any
    integer, intent(in) :: nstrch
    ! Load factor on the stretch
    double precision, intent(in) :: at
    ! Lengths, or -1
    integer, intent(in) :: lstate, listat
    ! The state
    double precision, intent(inout) :: state(*)
    integer, intent(inout) :: istate(*)
    ! -1: no beam in WORK, or one on a foundation; -3, -4, -5; -6: no such stretch; -7: no state at AT on it, or on the path;
    ! -9, -11: too short; 1, 12 to 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(history_type) :: history
    type(error_type), allocatable :: error

    call begin_result(work, iwork, at, rule_block, state, lstate, istate, listat, beam, info)
    ! The places of AT, LSTATE and LISTAT
    if (info == -7 .or. info == -9) then
        info = info - 2
    else if (info == -3) then
        info = -7
    end if
    if (info /= 0 .or. lstate == -1 .or. listat == -1) return
    info = check_history(nfact, factor, limit)
    if (info /= 0) return
    call follow_history(beam, factor(1:nfact), limit, history, error)
    if (allocated(error)) then
        info = merge(-1, error%code, error%code == gapbeam_bad_input)
        return
    end if
    if (nstrch < 0 .or. nstrch > size(history%stretches)) then
        info = -6
        return
    end if
    call solve_on_path(beam, history, at, result, error, nstrch)
    if (allocated(error)) then
        info = merge(-7, error%code, error%code == gapbeam_bad_input)
        return
    end if
    call put_result(result, state, lstate, istate, listat, info)
end subroutine gbhsol
