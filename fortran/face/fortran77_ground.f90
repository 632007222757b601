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
!     ITAB(2, NTAB)     foundation of every point of a table, those of one beside each other, in ascending order; of what: 1 the
!                       modulus, 2 the gap (a profile, here or there), 3 to 5 the parameters a, b, c; these are 0 above then
!     ATAB(2, NTAB)     x, also beside the foundation; value there; straight in between, beyond its ends the last value; two points
!                       at a place are a step
!
! Events are found by GHGEVT; GHEVNT is not for beams on foundations, nor for those of GHPRAF. GHHIST takes foundations that hold
! both ways by their modulus alone, and axial forces that do not grow.

! Prepare a beam on foundations, whose supports may follow laws
subroutine ghprfd(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, found, &
                  nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more; NLAW, NPROF, NFLAW and NTAB are numbers of points
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw, nfound, nprof, nflaw, ntab
    ! As for GHPRLW, and above
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *), found(6, *), aprof(2, *), aflaw(2, *)
    double precision, intent(in) :: glaw(6, *), atab(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*), ifound(*), iprof(*), iflaw(*), iglaw(*), itab(2, *)
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -14 as from GHPRLW; -15, -18, -21, -26; -16 or -17: a foundation is impossible, IENTRY is its number; -19 or -20: so is
    ! its profile, -22 or -23: its law; -24: there is no such law; -25: its parameters are impossible, -27 or -28: its table; 14, 15
    integer, intent(out) :: info

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, nfound, ifound, &
                 found, nprof, iprof, aprof, nflaw, iflaw, aflaw, iglaw, glaw, ntab, itab, atab, beam, ientry, info)
end subroutine ghprfd

! Follow the load from factor 0: every change of zones of contact and of supports at its load factor, to the last digit. Changes
! that undo each other within 1/64 of the way are not seen
subroutine ghgevt(beam, factor, rule, maxev, state, nev, event, ievent, info)
    use gapbeam_api, only: options_type
    use gapbeam_api_ground, only: ground_event_type, follow_ground
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, state_tag, find_first, find, info_of
    implicit none
    ! On foundations, or from GHPRAF
    integer(8), intent(in) :: beam
    ! End of the path, above 0
    double precision, intent(in) :: factor
    ! As for GHSOLV; room in EVENT and IEVENT
    integer, intent(in) :: rule, maxev
    ! The state at FACTOR; without equilibrium the motion that begins at the factor GHINFO gives
    integer(8), intent(in) :: state
    ! Number of events, which may be more than MAXEV
    integer, intent(inout) :: nev
    ! The first MAXEV of them: load factor, place; support or else foundation, 0 the other; branch of the foundation's law, 1 is the
    ! zone of contact; of a support 0 opens, 1 closes, 4 yields, 5 hardens, 8 unloads; of a zone 20 appears, 21 vanishes, 22 merges
    ! with the next, 23 splits; 24 an end reaches, 25 leaves that of the foundation or of the beam
    double precision, intent(inout) :: event(2, *)
    integer, intent(inout) :: ievent(4, *)
    ! -1, also of a beam that GHEVNT is for, or whose state depends on the loading history; -2, -3, -4, -5; 1, 2, 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    type(ground_event_type), allocatable :: events(:)
    integer :: k

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. maxev < 0) info = -4
    call find(state, 5, state_tag, solved, info)
    if (info /= 0) return
    call follow_ground(prepared%beam, factor, options_type(rule), events, solved%result, error)
    info = info_of(error, 1, ["factor", "rule  "], [2, 3])
    if (info /= 0) return
    info = solved%result%status
    nev = size(events)
    do k = 1, min(maxev, nev)
        event(:, k) = [events(k)%factor, events(k)%x]
        ievent(:, k) = [events(k)%support, events(k)%foundation, events(k)%branch, events(k)%change]
    end do
end subroutine ghgevt

! Where foundations act
subroutine ghcont(beam, state, maxzn, nzone, zone, izone, info)
    use gapbeam_api_ground, only: contact_type, get_contact
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
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
    ! -1, -2, -3; 14: a force out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(contact_type), allocatable :: zones(:)
    type(error_type), allocatable :: error
    integer :: k

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. maxzn < 0) info = -3
    if (info /= 0) return
    call get_contact(prepared%beam, solved%result, zones, error)
    info = info_of(error, 2)
    if (info /= 0) return
    nzone = size(zones)
    do k = 1, min(maxzn, nzone)
        zone(:, k) = [zones(k)%from, zones(k)%to, zones(k)%resultant]
        izone(:, k) = [zones(k)%foundation, zones(k)%condition]
    end do
end subroutine ghcont

! Where the beam does not touch a one-sided foundation that is there
subroutine ghfrsp(beam, state, maxfr, nfree, free, ifree, info)
    use gapbeam_api_ground, only: free_span_type, get_free_spans
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Room for free spans, 0 or more
    integer, intent(in) :: maxfr
    ! Number of free spans, which may be more than MAXFR; 0 without foundations
    integer, intent(inout) :: nfree
    ! The first MAXFR of them, foundation by foundation from left to right: ends, and largest distance between beam and ground
    double precision, intent(inout) :: free(3, *)
    ! Foundation
    integer, intent(inout) :: ifree(*)
    ! -1, -2, -3; 14: a distance out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(free_span_type), allocatable :: spans(:)
    type(error_type), allocatable :: error
    integer :: k

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. maxfr < 0) info = -3
    if (info /= 0) return
    call get_free_spans(prepared%beam, solved%result, spans, error)
    info = info_of(error, 2)
    if (info /= 0) return
    nfree = size(spans)
    do k = 1, min(maxfr, nfree)
        free(:, k) = [spans(k)%from, spans(k)%to, spans(k)%sag]
        ifree(k) = spans(k)%foundation
    end do
end subroutine ghfrsp

! Pressure of the ground anywhere along the beam
subroutine ghpres(beam, state, nx, x, left, press, info)
    use gapbeam_api_ground, only: get_pressure
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Places
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! At an end of a foundation: 0 its value right of the place, 1 left of it
    integer, intent(in) :: left
    ! Force per length of all foundations together on the beam, up, at every place; 0 without foundations
    double precision, intent(inout) :: press(*)
    ! -1, -2, -3, -5; -4: a place off the beam; 14: a pressure out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. nx < 0) info = -3
    if (info == 0 .and. left /= 0 .and. left /= 1) info = -5
    if (info /= 0) return
    call get_pressure(prepared%beam, solved%result, x(1:nx), press(1:nx), error, left == 1)
    info = info_of(error, 4)
end subroutine ghpres

! Exact extremes of the pressure
subroutine ghpxtr(beam, state, value, xvalue, info)
    use gapbeam_api_ground, only: get_pressure_extremes
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Maximum and minimum, and where they are; 0 without foundations
    double precision, intent(inout) :: value(2), xvalue(2)
    ! -1, -2; 14: a pressure out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    double precision :: values(2), places(2)

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    call get_pressure_extremes(prepared%beam, solved%result, values, places, error)
    info = info_of(error, 2)
    if (info /= 0) return
    value = values
    xvalue = places
end subroutine ghpxtr
