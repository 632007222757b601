! Beams on foundations in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.
!
! Foundations count from 1. They are the ground under stretches of the beam, which pushes back by its modulus or by a law wherever
! the beam touches it: where the deflection reaches the gap (below), or minus the gap (above):
!
!     IFOUND(NFOUND)    side: 0 both, 1 below, -1 above
!     FOUND(6, NFOUND)  left end; right end; modulus (force/length**2) at the left and at the right end, both 0 with a law; gap at
!                       the left and at the right end, both 0 with a profile; linear in between
!     IPROF(NPROF)      foundation of every point of a profile; those of one stand beside each other, in ascending order
!     APROF(2, NPROF)   x, also beside the foundation; gap there; straight in between, beyond its ends the last value
!     IFLAW(NFLAW)      foundation of every point of a law, a polyline from (0, 0), whose last slope goes on; those of one stand
!                       beside each other, in order
!     AFLAW(2, NFLAW)   displacement past the gap, above that of the point before; force per length, not below that of the point
!                       before
!     IGLAW(NFOUND)     law by parameters a, b, c, instead of a modulus and of points: r is the force per length at the displacement
!                       u past the gap; 0: none; 1 plastic: r = a*u up to b, and b beyond; 2 hardening: the same, but beyond b it
!                       rises by c*u; 3 hyperbolic: r = a*u/(1 + a*u/b); 4 tanh: r = b*tanh(a*u/b); 5 cubic: r = a*u + b*u**2 +
!                       c*u**3, rising everywhere
!     GLAW(6, NFOUND)   a, b, c at the left end, then at the right end, linear in between; 0 or more (b of a cubic: any sign); those
!                       that its law does not have are not looked at
!
! How many zones of contact there are shows only when a beam is solved. GBSOLV asked for LSTATE and LISTAT gives lengths that are
! hardly ever exceeded; see there. Events are found by GBGEVT; GBEVNT, GBHIST and GBHSOL are not for beams
! on foundations.

! Prepare a beam on foundations, whose supports may follow laws
subroutine gbprfd(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, work, lwork, iwork, liwork, info)
    use gapbeam_work, only: prepare_beam
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more; NLAW, NPROF and NFLAW are numbers of points
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw
    ! As for GBPRLW, and above
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*)
    ! Lengths, or -1: then all arrays but those of the loads must be filled already
    integer, intent(in) :: lwork, liwork
    ! The beam
    double precision, intent(inout) :: work(*)
    integer, intent(inout) :: iwork(*)
    ! -1 to -14 as from GBPRLW; -15, -18, -21; -16 or -17: a foundation is impossible, IWORK(1) is its number; -19 or -20: so is its
    ! profile, -22 or -23: its law; -25, -27: too short; 14, 15
    integer, intent(out) :: info
    double precision :: no_parameters(6, 1)
    integer :: no_laws(1)

    call prepare_beam(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                      found, nprof, iprof, aprof, nflaw, iflaw, aflaw, 0, no_laws, no_parameters, work, lwork, iwork, liwork, &
                      info)
    ! The places of LWORK and LIWORK
    if (info == -27 .or. info == -29) info = info + 2
end subroutine gbprfd

! The same where foundations may have laws by parameters
subroutine gbprgl(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, work, lwork, iwork, liwork, info)
    use gapbeam_work, only: prepare_beam
    implicit none
    ! As for GBPRFD, and above
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    double precision, intent(in) :: glaw(6, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*)
    ! Lengths, or -1, as for GBPRFD
    integer, intent(in) :: lwork, liwork
    ! The beam
    double precision, intent(inout) :: work(*)
    integer, intent(inout) :: iwork(*)
    ! -1 to -23 as from GBPRFD; -24: there is no such law of foundation IWORK(1); -25: its parameters are impossible; -27, -29: too
    ! short; 14, 15
    integer, intent(out) :: info

    call prepare_beam(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                      found, nprof, iprof, aprof, nflaw, iflaw, aflaw, nfound, iglaw, glaw, work, lwork, iwork, liwork, info)
end subroutine gbprgl

! Follow the load from factor 0: every change of zones of contact and of supports at its load factor, to the last digit. Changes
! that undo each other within 1/64 of the way are not seen
subroutine gbgevt(work, iwork, factor, rule, maxev, state, lstate, istate, listat, nev, event, ievent, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_api, only: prepared_type, result_type, options_type
    use gapbeam_api_ground, only: ground_event_type, follow_ground
    use gapbeam_work, only: begin_result, put_result
    implicit none
    ! Beam on foundations
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! End of the path, above 0
    double precision, intent(in) :: factor
    ! As for GBSOLV; room in EVENT and IEVENT
    integer, intent(in) :: rule, maxev
    ! Lengths, or -1
    integer, intent(in) :: lstate, listat
    ! The state at FACTOR; without equilibrium the motion that begins at the factor GBINFO gives
    double precision, intent(inout) :: state(*)
    integer, intent(inout) :: istate(*)
    ! Number of events, which may be more than MAXEV
    integer, intent(inout) :: nev
    ! The first MAXEV of them: load factor, place; support or else foundation, 0 the other; branch of the foundation's law, 1 is the
    ! zone of contact; of a support 0 opens, 1 closes, 4 yields, 5 hardens, 8 unloads; of a zone 20 appears, 21 vanishes, 22 merges
    ! with the next, 23 splits; 24 an end reaches, 25 leaves that of the foundation or of the beam
    double precision, intent(inout) :: event(2, *)
    integer, intent(inout) :: ievent(4, *)
    ! -1: no beam in WORK, or one without foundations, or whose state depends on the way of the load; -3, -4, -5; -7, -9: too short;
    ! 1, 12 to 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error
    type(ground_event_type), allocatable :: events(:)
    integer :: k

    call begin_result(work, iwork, factor, rule, state, lstate, istate, listat, beam, info)
    if (maxev < 0) info = -5
    if (.not. factor > 0) info = -3
    if (info /= 0 .or. lstate == -1 .or. listat == -1) return
    call follow_ground(beam, factor, options_type(rule), events, result, error)
    if (allocated(error)) then
        info = merge(-1, error%code, error%code == gapbeam_bad_input)
        return
    end if
    nev = size(events)
    do k = 1, min(maxev, nev)
        event(:, k) = [events(k)%factor, events(k)%x]
        ievent(:, k) = [events(k)%support, events(k)%foundation, events(k)%branch, events(k)%change]
    end do
    call put_result(result, state, lstate, istate, listat, info)
end subroutine gbgevt

! Where foundations act
subroutine gbcont(work, iwork, state, istate, maxzn, nzone, zone, izone, info)
    use gapbeam_error, only: error_type, gapbeam_not_prepared
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_api_ground, only: contact_type, get_contact
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Room for zones, 0 or more
    integer, intent(in) :: maxzn
    ! Number of zones, which may be more than MAXZN; 0 without foundations
    integer, intent(inout) :: nzone
    ! The first MAXZN of them, foundation by foundation from left to right; one that holds both ways in two layers first where it
    ! pushes up: ends, and force on the beam, up
    double precision, intent(inout) :: zone(3, *)
    ! Foundation; 1 in contact, 2 where it holds both ways, 4 where it only touches at a place, or 10 plus the number of the
    ! piece of its law
    integer, intent(inout) :: izone(2, *)
    ! -1: no beam; -3: nothing solved, or not of this beam; -5; 14: a force out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(contact_type), allocatable :: zones(:)
    type(error_type), allocatable :: error
    integer :: k

    call take_both(work, iwork, state, istate, beam, result, info)
    if (maxzn < 0) info = -5
    if (info /= 0) return
    call get_contact(beam, result, zones, error)
    if (allocated(error)) then
        info = merge(-3, error%code, error%code == gapbeam_not_prepared)
        return
    end if
    nzone = size(zones)
    do k = 1, min(maxzn, nzone)
        zone(:, k) = [zones(k)%from, zones(k)%to, zones(k)%resultant]
        izone(:, k) = [zones(k)%foundation, zones(k)%condition]
    end do
end subroutine gbcont

! Where the beam does not touch a one-sided foundation that is there
subroutine gbfree(work, iwork, state, istate, maxfr, nfree, free, ifree, info)
    use gapbeam_error, only: error_type, gapbeam_not_prepared
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_api_ground, only: free_span_type, get_free_spans
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Room for free spans, 0 or more
    integer, intent(in) :: maxfr
    ! Number of free spans, which may be more than MAXFR; 0 without foundations
    integer, intent(inout) :: nfree
    ! The first MAXFR of them, foundation by foundation from left to right: ends, and largest distance between beam and ground
    double precision, intent(inout) :: free(3, *)
    ! Foundation
    integer, intent(inout) :: ifree(*)
    ! -1: no beam; -3: nothing solved, or not of this beam; -5; 14: a distance out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(free_span_type), allocatable :: spans(:)
    type(error_type), allocatable :: error
    integer :: k

    call take_both(work, iwork, state, istate, beam, result, info)
    if (maxfr < 0) info = -5
    if (info /= 0) return
    call get_free_spans(beam, result, spans, error)
    if (allocated(error)) then
        info = merge(-3, error%code, error%code == gapbeam_not_prepared)
        return
    end if
    nfree = size(spans)
    do k = 1, min(maxfr, nfree)
        free(:, k) = [spans(k)%from, spans(k)%to, spans(k)%sag]
        ifree(k) = spans(k)%foundation
    end do
end subroutine gbfree

! Pressure of the ground anywhere along the beam
subroutine gbpres(work, iwork, state, istate, nx, x, left, press, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_api_ground, only: get_pressure
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Places
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! At an end of a foundation: 0 its value right of the place, 1 left of it
    integer, intent(in) :: left
    ! Force per length of all foundations together on the beam, up, at every place; 0 without foundations
    double precision, intent(inout) :: press(*)
    ! -1: no beam; -3: nothing solved, or not of this beam; -5; -6: a place off the beam; 14: a pressure out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error

    call take_both(work, iwork, state, istate, beam, result, info)
    if (nx < 0) info = -5
    if (info /= 0) return
    call get_pressure(beam, result, x(1:nx), press(1:nx), error, left /= 0)
    if (.not. allocated(error)) return
    info = error%code
    if (error%code == gapbeam_not_prepared) info = -3
    if (error%code == gapbeam_bad_input) info = -6
end subroutine gbpres

! Exact extremes of the pressure
subroutine gbpxtr(work, iwork, state, istate, value, xvalue, info)
    use gapbeam_error, only: error_type, gapbeam_not_prepared
    use gapbeam_api, only: prepared_type, result_type
    use gapbeam_api_ground, only: get_pressure_extremes
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Maximum and minimum, and where they are; 0 without foundations
    double precision, intent(inout) :: value(2), xvalue(2)
    ! -1: no beam; -3: nothing solved, or not of this beam; 14: a pressure out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error
    double precision :: values(2), places(2)

    call take_both(work, iwork, state, istate, beam, result, info)
    if (info /= 0) return
    call get_pressure_extremes(beam, result, values, places, error)
    if (allocated(error)) then
        info = merge(-3, error%code, error%code == gapbeam_not_prepared)
        return
    end if
    value = values
    xvalue = places
end subroutine gbpxtr
