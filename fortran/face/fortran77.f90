! The Fortran 77 interface: plain arrays, integers, and handles of what the library keeps. Marshalling only.
!
! Units, signs: see gapbeam.f90. Nodes (span ends) count from 0, spans, supports, loads and hinges from 1. Beams on foundations:
! fortran77_ground.f90. Histories of the load: fortran77_history.f90. Combinations and trains: fortran77_trains.f90. Many cases:
! fortran77_cases.f90. Axial forces that bending feels, buckling, frequencies: fortran77_modes.f90. Calls that take long, ended:
! fortran77_watch.f90.
!
!     SPAN(4, NSPAN)    length; EI; GA (GBINF(): rigid in shear); EA (GBINF() if not needed), above 0
!     HINGE(NHINGE)     places of moment hinges
!     ISUP(3, NSUP)     side: 0 both, 1 below, -1 above; direction: 0 across the beam, 1 along it, 2 of its rotation, 3 of a
!                       hinge, 4 left of a hinge, 5 right of it; node, or -1: SUP(1, .) counts
!     SUP(5, NSUP)      x; stiffness (GBINF(): rigid); gap; settlement; rotational stiffness (0: free, GBINF(): clamped)
!     ILOAD(3, NLOAD)   kind: 1 force, 2 couple, 3 distributed, 4 curvature, 5 axial force,
!                       6 movement of a support, 7 temperature, 8 rotation of a support, 9 couple left of a hinge, 10 right of it,
!                       11 distributed along the beam, 12 movement of ground, 13 linear curvature; case: 0 live, 1 dead; node, or
!                       of 6 and 8 the support, of 12 the foundation, or -1
!     ALOAD(4, NLOAD)   x, or left end of the stretch; right end; value, of 7 curvature; of kinds 3, 12 and 13 the value at the
!                       right end, of 7 elongation per length
!
! and for GHPRLW the laws that supports have instead of a stiffness, polylines from (0, 0) through points, in which equal
! displacements are a vertical piece, and whose last slope goes on; a support that holds both ways has it both ways:
!
!     ILAW(NLAW)        support of every point; those of one stand beside each other, in order
!     ALAW(2, NLAW)     displacement past the gap, not below that of the point before; force, 0 or more
!     IUNL(NSUP)        unloading of supports with a law: 0 along it, 1 parallel to its first piece so that a set stays, 2 along it,
!                       but not at all once its force has dropped; not looked at where NLAW is 0
!
! BEAM, STATE, HIST, CASES and PASS are handles, INTEGER*8. The routine that makes one writes over what was there; GHFREE frees it.
! 0 is no handle, nor is one that was freed. What is in a file, or in a copy of memory, is none either: a beam is prepared anew.
!
! INFO  0   solved, or done
!      -i   the i-th argument has an illegal value: a handle is of another kind or none of the library's (which cannot be told of
!           the address of no memory at all), or a state, history, cases or train are not of the beam as it is now
!       1   no equilibrium: GHMOTN gives the motion
!       2   the beam buckles: GHBUCK says how
!     >10   an error, see gapbeam_error: 12 indeterminate, 13 not converged, 14 not finite, 15 no memory, 18 stopped (GHWTCH)
! Nothing but INFO, handles to be made (0) and IENTRY is written where INFO is not 0, 1 or 2.
!
! A beam is only read by all but GHLOAD, GHWTCH, GHLIMT and GHFREE: threads may share it, each with its own STATE.

! Prepare a beam
subroutine ghprep(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more
    integer, intent(in) :: nspan, nhinge, nsup, nload
    ! See above
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *)
    integer, intent(in) :: isup(3, *), iload(3, *)
    ! The beam
    integer(8), intent(out) :: beam
    ! Of bad input the number of the entry (column) of the array, or 0
    integer, intent(out) :: ientry
    ! -1, -2, -3, -4, -5, -6 or -7, -8, -9 or -10: bad input; 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_numbers(6, 1)
    integer :: none(2)

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, 0, none, no_points, none, 0, none, no_numbers, &
                 0, none, no_points, 0, none, no_points, none, no_numbers, 0, none, no_points, beam, ientry, info)
end subroutine ghprep

! Prepare a beam whose supports may follow laws
subroutine ghprlw(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more; NLAW is the number of points of all laws together
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw
    ! See above; the stiffness of a support with a law is GBINF()
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*)
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -10 as from GHPREP; -11; -12 or -13: a law is impossible, IENTRY is its support; -14: so is IUNL(IENTRY); 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_numbers(6, 1)
    integer :: none(2)

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, 0, none, no_numbers, &
                 0, none, no_points, 0, none, no_points, none, no_numbers, 0, none, no_points, beam, ientry, info)
end subroutine ghprlw

! Prepare a beam whose supports may follow laws by name
subroutine ghprsl(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, islaw, slaw, beam, &
                  ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! As for GHPRLW; IUNL is looked at where NLAW is 0 too
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*)
    ! The law of every support, 0: none or by points, and its parameters: 1 plastic, 3 hyperbolic, 4 tanh, 8 brittle: stiffness,
    ! limit; 2 hardening: and the slope beyond; 5 cubic: k1, k2, k3; 7 power: d0, limit, exponent
    integer, intent(in) :: islaw(*)
    double precision, intent(in) :: slaw(3, *)
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -14 as from GHPRLW, -12 where ISLAW(IENTRY) is no law or stands beside points too; -16: SLAW(., IENTRY); 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_numbers(6, 1)
    integer :: none(2)

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, 0, none, no_numbers, &
                 0, none, no_points, 0, none, no_points, none, no_numbers, 0, none, no_points, beam, ientry, info, islaw, slaw)
end subroutine ghprsl

! Prepare a beam whose supports may follow laws by name, and rub along it
subroutine ghprfr(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, islaw, slaw, fric, &
                  beam, ientry, info)
    use gapbeam_fortran77_model, only: prepare
    implicit none
    ! As for GHPRSL
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*)
    integer, intent(in) :: islaw(*)
    double precision, intent(in) :: slaw(3, *)
    ! Friction coefficient of every support across the beam, 0 or more
    double precision, intent(in) :: fric(*)
    ! As from GHPREP
    integer(8), intent(out) :: beam
    integer, intent(out) :: ientry
    ! -1 to -16 as from GHPRSL; -17: FRIC(IENTRY); 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_numbers(6, 1)
    integer :: none(2)

    call prepare(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, 0, none, no_numbers, &
                 0, none, no_points, 0, none, no_points, none, no_numbers, 0, none, no_points, beam, ientry, info, islaw, slaw, &
                 fric)
end subroutine ghprfr

! Free what a handle stands for, whatever it is
subroutine ghfree(handle, info)
    use gapbeam_handles, only: free_handle, address_numbered
    implicit none
    ! 0 out
    integer(8), intent(inout) :: handle
    ! -1: it is none, and stays as it is
    integer, intent(out) :: info
    logical :: freed

    call free_handle(address_numbered(handle), freed=freed)
    info = merge(0, -1, freed)
    if (freed) handle = 0
end subroutine ghfree

! Take other loads for a prepared beam. States, histories, cases and trains from before belong to the old loads, and are not taken.
! Where places of loads change, so may the number of nodes in GHMOTN
subroutine ghload(beam, nload, iload, aload, info)
    use gapbeam_scene, only: load_type
    use gapbeam_api, only: replace_loads
    use gapbeam_arrays, only: loads_from_arrays
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, find_first, info_of
    implicit none
    ! Left as it is where a load is refused
    integer(8), intent(in) :: beam
    ! All loads from now on, see above
    integer, intent(in) :: nload
    integer, intent(in) :: iload(3, *)
    double precision, intent(in) :: aload(4, *)
    ! -1, -2; -3: bad load; 14, 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared
    type(load_type), allocatable :: loads(:)
    type(error_type), allocatable :: error

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. nload < 0) info = -2
    if (info /= 0) return
    call loads_from_arrays(iload(:, 1:nload), aload(:, 1:nload), loads, error)
    if (.not. allocated(error)) call replace_loads(prepared%beam, loads, error)
    info = info_of(error, 3)
end subroutine ghload

! Make a place for results
subroutine ghstat(state, info)
    use gapbeam_new_objects, only: new_state
    use gapbeam_fortran77_info, only: error_type, handle_type, number_of, info_of
    implicit none
    integer(8), intent(out) :: state
    ! 15
    integer, intent(out) :: info
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    call new_state(handle, error)
    state = number_of(handle)
    info = info_of(error, 1)
end subroutine ghstat

! Solve at one load factor
subroutine ghsolv(beam, factor, rule, start, state, info)
    use gapbeam_api, only: options_type, solve_beam
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, state_tag, find_first, find, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! Factor of the live loads
    double precision, intent(in) :: factor
    ! 0 block, 1 single; where the search starts: 0 all supports closed, 1 from the scheme of the state in STATE
    integer, intent(in) :: rule, start
    ! The state
    integer(8), intent(in) :: state
    ! -1, also of a beam whose state depends on the loading history (GHHIST); -2, -3, -4; -5, also where START is 1 and nothing is
    ! solved there; 1, 2, 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. start /= 0 .and. start /= 1) info = -4
    call find(state, 5, state_tag, solved, info)
    if (info == 0) then
        if (start == 1 .and. solved%result%status < 0) info = -5
    end if
    if (info /= 0) return
    if (start == 0 .and. allocated(solved%result%state)) deallocate (solved%result%state)
    call solve_beam(prepared%beam, factor, options_type(rule), solved%result, error)
    info = info_of(error, 1, ["factor", "rule  "], [2, 3])
    if (info == 0) info = solved%result%status
end subroutine ghsolv

! Follow the load from factor 0: every change of the contact state at its exact load factor
subroutine ghevnt(beam, factor, rule, maxev, state, nev, evfact, ievent, info)
    use gapbeam_events, only: event_type
    use gapbeam_api, only: options_type, follow_load
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, state_tag, find_first, find, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! End of the path, above 0
    double precision, intent(in) :: factor
    ! As for GHSOLV; room in EVFACT and IEVENT
    integer, intent(in) :: rule, maxev
    ! The state at FACTOR; without equilibrium the motion that begins at the factor GHINFO gives
    integer(8), intent(in) :: state
    ! Number of events, which may be more than MAXEV
    integer, intent(inout) :: nev
    ! The first MAXEV of them: load factor; support, and what it is from there on, 0 open or 1 closed, or 10 plus the number of the
    ! piece of its law; 3: the beam has lost its hold and turns at constant load until this support holds it
    double precision, intent(inout) :: evfact(*)
    integer, intent(inout) :: ievent(2, *)
    ! -1, also of a beam on a foundation, or whose state depends on the loading history (GHHIST); -2, -3, -4, -5; 1, 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    type(event_type), allocatable :: events(:)
    integer :: k

    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. maxev < 0) info = -4
    call find(state, 5, state_tag, solved, info)
    if (info /= 0) return
    call follow_load(prepared%beam, factor, options_type(rule), events, solved%result, error)
    info = info_of(error, 1, ["factor", "rule  "], [2, 3])
    if (info /= 0) return
    info = solved%result%status
    nev = size(events)
    do k = 1, min(maxev, nev)
        evfact(k) = events(k)%factor
        ievent(:, k) = [events(k)%support, events(k)%state]
    end do
end subroutine ghevnt

! What a state says in a few numbers
subroutine ghinfo(state, factor, ninfo, info)
    use gapbeam_fortran77_info, only: handle_type, state_tag, find_first
    implicit none
    integer(8), intent(in) :: state
    ! Load factor
    double precision, intent(inout) :: factor
    ! Status (0, 1 or 2), linear solves, method (0 mixed, 1 three-moment, 2 with pivoting), 1 where the beam is free to move without
    ! work of the loads, 1 where it slides along its axis
    integer, intent(inout) :: ninfo(5)
    ! -1, also where nothing is solved
    integer, intent(out) :: info
    type(handle_type), pointer :: solved

    call find_first(state, state_tag, solved, info)
    if (info /= 0) return
    associate (r => solved%result)
        if (r%status < 0) info = -1
        if (info /= 0) return
        factor = r%factor
        ninfo = [r%status, r%solves, r%method, merge(1, 0, r%indifferent), merge(1, 0, r%slides)]
    end associate
end subroutine ghinfo

! Infinity, for which Fortran 77 has no name
function gbinf() result(value)
    use gapbeam_scene, only: gapbeam_infinity
    implicit none
    double precision :: value

    value = gapbeam_infinity
end function gbinf

! What stands for a number of a section that stays as it is
function gbsame() result(value)
    use gapbeam_scene, only: gapbeam_unchanged
    implicit none
    double precision :: value

    value = gapbeam_unchanged
end function gbsame

! Version of the library
subroutine gbvers(major, minor, patch)
    use gapbeam_version, only: gapbeam_version_major, gapbeam_version_minor, gapbeam_version_patch
    implicit none
    integer, intent(out) :: major, minor, patch

    major = gapbeam_version_major
    minor = gapbeam_version_minor
    patch = gapbeam_version_patch
end subroutine gbvers
