! The Fortran 77 interface: plain arrays and integers, no data kept but in the caller's work arrays. Marshalling only.
!
! Units, signs: see gapbeam.f90. Nodes (span ends) count from 0, spans, supports, loads and hinges from 1. Beams on foundations:
! fortran77_ground.f90. Histories of the load: fortran77_history.f90. Combinations and trains: fortran77_trains.f90.
!
!     SPAN(4, NSPAN)    length; EI; GA (GBINF(): rigid in shear); EA (GBINF() if not needed), above 0
!     HINGE(NHINGE)     places of moment hinges
!     ISUP(3, NSUP)     side: 0 both, 1 below, -1 above; direction: 0 across the beam, 1 along it; node, or -1: SUP(1, .) counts
!     SUP(5, NSUP)      x; stiffness (GBINF(): rigid); gap; settlement; rotational stiffness (0: free, GBINF(): clamped)
!     ILOAD(3, NLOAD)   kind: 1 force, 2 couple, 3 distributed, 4 curvature, 5 axial force; case: 0 live, 1 dead; node, or -1
!     ALOAD(4, NLOAD)   x, or left end of the stretch; right end; value; of kind 3 the value at the right end
!
! and for GBPRLW the laws that supports have instead of a stiffness, polylines from (0, 0) through points, in which equal
! displacements are a vertical piece, and whose last slope goes on; a support that holds both ways has it both ways:
!
!     ILAW(NLAW)        support of every point; those of one stand beside each other, in order
!     ALAW(2, NLAW)     displacement past the gap, not below that of the point before; force, 0 or more
!     IUNL(NSUP)        unloading of supports with a law: 0 along it, 1 parallel to its first piece so that a set stays, 2 along it,
!                       but not at all once its force has dropped; not looked at where NLAW is 0
!
! WORK(LWORK), IWORK(LIWORK) hold the prepared beam, STATE(LSTATE), ISTATE(LISTAT) a solved state. With LWORK, LIWORK,
! LSTATE or LISTAT = -1 a routine does nothing but return the lengths it needs in WORK(1) and IWORK(1), or STATE(1) and ISTATE(1).
!
! INFO  0   solved, or done
!      -i   the i-th argument has an illegal value; from GBPREP, GBPRLW, GBPRFD and GBPRGL IWORK(1) is then the number of the entry
!           (column) of that array, or 0, and the work arrays hold no beam any more; after GBLOAD they hold the old one
!       1   no equilibrium: GBMOTN gives the motion
!     >10   an error, see gapbeam_error: 12 indeterminate, 13 not converged, 14 not finite, 15 no memory, 16 nothing solved
! Nothing but INFO (and IWORK(1)) is written where INFO is not 0 or 1.
!
! A beam in WORK is only read by all but GBPREP, GBPRLW, GBPRFD, GBPRGL and GBLOAD: threads may share it, each with its own STATE.

! Prepare a beam
subroutine gbprep(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, work, lwork, iwork, liwork, info)
    use gapbeam_work, only: prepare_beam
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more
    integer, intent(in) :: nspan, nhinge, nsup, nload
    ! See above
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *)
    integer, intent(in) :: isup(3, *), iload(3, *)
    ! Lengths, or -1
    integer, intent(in) :: lwork, liwork
    ! The beam
    double precision, intent(inout) :: work(*)
    integer, intent(inout) :: iwork(*)
    ! -1, -2, -4, -6 or -7, -9 or -10: bad input; -12, -14: too short; 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_foundations(6, 1)
    integer :: no_laws(1)

    call prepare_beam(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, 0, no_laws, no_points, no_laws, &
                      0, no_laws, no_foundations, 0, no_laws, no_points, 0, no_laws, no_points, 0, no_laws, no_foundations, &
                      work, lwork, iwork, liwork, info)
    ! The places of LWORK and LIWORK
    if (info == -27 .or. info == -29) info = info + 15
end subroutine gbprep

! Prepare a beam whose supports may follow laws
subroutine gbprlw(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, &
                  work, lwork, iwork, liwork, info)
    use gapbeam_work, only: prepare_beam
    implicit none
    ! Sizes; NSPAN 1 or more, the others 0 or more; NLAW is the number of points of all laws together
    integer, intent(in) :: nspan, nhinge, nsup, nload, nlaw
    ! See above; the stiffness of a support with a law is GBINF()
    double precision, intent(in) :: span(4, *), hinge(*), sup(5, *), aload(4, *), alaw(2, *)
    integer, intent(in) :: isup(3, *), iload(3, *), ilaw(*), iunl(*)
    ! Lengths, or -1
    integer, intent(in) :: lwork, liwork
    ! The beam
    double precision, intent(inout) :: work(*)
    integer, intent(inout) :: iwork(*)
    ! -1 to -10 as from GBPREP; -11; -12 or -13: a law is impossible, IWORK(1) is its support; -14: so is IUNL(IWORK(1)); -16,
    ! -18: too short; 14, 15
    integer, intent(out) :: info
    double precision :: no_points(2, 1), no_found(6, 1)
    integer :: no_foundations(1)

    call prepare_beam(nspan, span, nhinge, hinge, nsup, isup, sup, nload, iload, aload, nlaw, ilaw, alaw, iunl, &
                      0, no_foundations, no_found, 0, no_foundations, no_points, 0, no_foundations, no_points, &
                      0, no_foundations, no_found, work, lwork, iwork, liwork, info)
    ! The places of LWORK and LIWORK
    if (info == -27 .or. info == -29) info = info + 11
end subroutine gbprlw

! Take other loads for a prepared beam. The work arrays must have room for the largest NLOAD to come: ask GBPREP, GBPRLW, GBPRFD
! or GBPRGL for their lengths with that. States solved before belong to the old loads, and are not taken until solved anew. Where
! places of loads change, so may the lengths of states (ask GBSOLV again) and the number of nodes in GBMOTN
subroutine gbload(nload, iload, aload, work, lwork, iwork, liwork, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_scene, only: load_type
    use gapbeam_api, only: prepared_type, replace_loads
    use gapbeam_arrays, only: loads_from_arrays
    use gapbeam_work, only: take_beam, put_beam
    implicit none
    ! All loads from now on, see above
    integer, intent(in) :: nload
    integer, intent(in) :: iload(3, *)
    double precision, intent(in) :: aload(4, *)
    ! Lengths of the arrays, and the beam in them
    integer, intent(in) :: lwork, liwork
    double precision, intent(inout) :: work(*)
    integer, intent(inout) :: iwork(*)
    ! -1; -2: bad load; -4: no beam in WORK; -5: too short; 14, 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(load_type), allocatable :: loads(:)
    type(error_type), allocatable :: error
    integer :: short

    info = 0
    if (nload < 0) info = -1
    if (info /= 0) return
    call take_beam(work, iwork, 4, beam, info)
    if (info /= 0) return
    call loads_from_arrays(iload(:, 1:nload), aload(:, 1:nload), loads, error)
    if (.not. allocated(error)) call replace_loads(beam, loads, error)
    if (allocated(error)) then
        info = merge(-2, error%code, error%code == gapbeam_bad_input)
        return
    end if
    call put_beam(beam, work, lwork, iwork, liwork, short)
    if (short > 0) info = -5
end subroutine gbload

! Solve at one load factor
subroutine gbsolv(work, iwork, factor, rule, start, state, lstate, istate, listat, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_api, only: prepared_type, result_type, options_type, solve_beam
    use gapbeam_work, only: begin_result, put_result, take_result
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! Factor of the live loads
    double precision, intent(in) :: factor
    ! 0 block, 1 single; where the search starts: 0 all supports closed, 1 from the scheme of the state in STATE
    integer, intent(in) :: rule, start
    ! Lengths, or -1
    integer, intent(in) :: lstate, listat
    ! The state
    double precision, intent(inout) :: state(*)
    integer, intent(inout) :: istate(*)
    ! -1: no beam in WORK, or one whose state depends on the way of the load (GBHIST); -3, -4, -5; -6: START is 1 and there is no
    ! state; -7, -9: too short, on a foundation also where there are more zones than the lengths asked for hold: STATE(1) and
    ! ISTATE(1) are then the lengths that it takes, and an earlier state is gone; 1, 12 to 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error

    call begin_result(work, iwork, factor, rule, state, lstate, istate, listat, beam, info)
    if (start /= 0 .and. start /= 1) info = -5
    if (info /= 0 .or. lstate == -1 .or. listat == -1) return
    if (start == 1) call take_result(state, istate, 6, result, info)
    if (info /= 0) return
    call solve_beam(beam, factor, options_type(rule), result, error)
    if (allocated(error)) then
        info = merge(-1, error%code, error%code == gapbeam_bad_input)
        return
    end if
    call put_result(result, state, lstate, istate, listat, info)
end subroutine gbsolv

! Follow the load from factor 0: every change of the working scheme at its exact load factor
subroutine gbevnt(work, iwork, factor, rule, maxev, state, lstate, istate, listat, nev, evfact, ievent, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_events, only: event_type
    use gapbeam_api, only: prepared_type, result_type, options_type, follow_load
    use gapbeam_work, only: begin_result, put_result
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! End of the path, above 0
    double precision, intent(in) :: factor
    ! As for GBSOLV; room in EVFACT and IEVENT
    integer, intent(in) :: rule, maxev
    ! Lengths, or -1
    integer, intent(in) :: lstate, listat
    ! The state at FACTOR; without equilibrium the motion that begins at the factor GBINFO gives
    double precision, intent(inout) :: state(*)
    integer, intent(inout) :: istate(*)
    ! Number of events, which may be more than MAXEV
    integer, intent(inout) :: nev
    ! The first MAXEV of them: load factor; support, and what it is from there on, 0 open or 1 closed, or 10 plus the number of the
    ! piece of its law; 3: the beam has lost its hold and turns at constant load until this support holds it
    double precision, intent(inout) :: evfact(*)
    integer, intent(inout) :: ievent(2, *)
    ! -1: no beam in WORK, or one on a foundation, or whose state depends on the way of the load (GBHIST); -3, -4, -5; -7, -9: too
    ! short; 1, 12 to 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error
    type(event_type), allocatable :: events(:)
    integer :: k

    call begin_result(work, iwork, factor, rule, state, lstate, istate, listat, beam, info)
    if (maxev < 0) info = -5
    if (.not. factor > 0) info = -3
    if (info /= 0 .or. lstate == -1 .or. listat == -1) return
    call follow_load(beam, factor, options_type(rule), events, result, error)
    if (allocated(error)) then
        info = merge(-1, error%code, error%code == gapbeam_bad_input)
        return
    end if
    nev = size(events)
    do k = 1, min(maxev, nev)
        evfact(k) = events(k)%factor
        ievent(1, k) = events(k)%support
        ievent(2, k) = events(k)%state
    end do
    call put_result(result, state, lstate, istate, listat, info)
end subroutine gbevnt

! What a state says in a few numbers
subroutine gbinfo(state, istate, factor, ninfo, info)
    use gapbeam_api, only: result_type
    use gapbeam_work, only: take_result
    implicit none
    double precision, intent(in) :: state(*)
    integer, intent(in) :: istate(*)
    ! Load factor
    double precision, intent(inout) :: factor
    ! Status (0 or 1), linear solves, method (0 mixed, 1 three-moment, 2 with pivoting), 1 where the beam is free to move without
    ! work of the loads, 1 where it slides along its axis
    integer, intent(inout) :: ninfo(5)
    ! -1: nothing solved; 15
    integer, intent(out) :: info
    type(result_type) :: result

    call take_result(state, istate, 1, result, info)
    if (info /= 0) return
    factor = result%factor
    ninfo = [result%status, result%solves, result%method, merge(1, 0, result%indifferent), merge(1, 0, result%slides)]
end subroutine gbinfo

! Values at the supports
subroutine gbsupp(work, iwork, state, istate, supval, kstate, info)
    use gapbeam_error, only: error_type
    use gapbeam_api, only: prepared_type, result_type, get_supports, count_supports
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Reaction, deflection, opening (negative: the beam has gone past a support without stiffness), couple of every support
    double precision, intent(inout) :: supval(4, *)
    ! 0 open, 1 closed, 2 bilateral, 10 plus the number of the piece of a law
    integer, intent(inout) :: kstate(*)
    ! -1: no beam; -3: nothing solved, or not of this beam; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error
    integer :: n

    call take_both(work, iwork, state, istate, beam, result, info)
    if (info /= 0) return
    n = count_supports(beam)
    call get_supports(beam, result, supval(1, 1:n), supval(2, 1:n), supval(3, 1:n), supval(4, 1:n), kstate(1:n), error)
    if (allocated(error)) info = -3
end subroutine gbsupp

! Exact fields anywhere along the beam
subroutine gbflds(work, iwork, state, istate, nx, x, left, field, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input, gapbeam_not_finite, gapbeam_no_memory
    use gapbeam_api, only: prepared_type, result_type, get_fields
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Places
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Where a field jumps: 0 its value right of the place, 1 left of it
    integer, intent(in) :: left
    ! Deflection, rotation, moment, shear, axial force, axial displacement at every place
    double precision, intent(inout) :: field(6, *)
    ! -1: no beam; -3: nothing solved, or not of this beam; -5; -6: a place off the beam; 14: a field out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error

    call take_both(work, iwork, state, istate, beam, result, info)
    if (nx < 0) info = -5
    if (info /= 0) return
    call get_fields(beam, result, x(1:nx), field(:, 1:nx), error, left /= 0)
    if (.not. allocated(error)) return
    info = -3
    if (error%code == gapbeam_bad_input) info = -6
    if (any(error%code == [gapbeam_not_finite, gapbeam_no_memory])) info = error%code
end subroutine gbflds

! Exact extremes of all fields
subroutine gbxtrm(work, iwork, state, istate, value, xvalue, info)
    use gapbeam_error, only: error_type, gapbeam_not_finite, gapbeam_no_memory
    use gapbeam_api, only: prepared_type, result_type, get_extremes
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Maximum and minimum of the six fields of GBFLDS, and where they are
    double precision, intent(inout) :: value(2, 6), xvalue(2, 6)
    ! -1: no beam; -3: nothing solved, or not of this beam; 14: a field out of range; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error

    call take_both(work, iwork, state, istate, beam, result, info)
    if (info /= 0) return
    call get_extremes(beam, result, value, xvalue, error)
    if (allocated(error)) info = merge(error%code, -3, any(error%code == [gapbeam_not_finite, gapbeam_no_memory]))
end subroutine gbxtrm

! The free motion where there is no equilibrium
subroutine gbmotn(work, iwork, state, istate, maxnd, nnode, xnode, motion, info)
    use gapbeam_error, only: error_type
    use gapbeam_api, only: prepared_type, result_type, get_motion, count_nodes
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Room in the arrays; NHINGE + NSUP + 2 NLOAD + 2 is always enough, with foundations NSPAN + 2 NFOUND + NPROF more
    integer, intent(in) :: maxnd
    ! Number of nodes of the system
    integer, intent(inout) :: nnode
    ! Their places and displacements, down, largest 1, straight lines between; all 0 where the beam slides along its axis
    double precision, intent(inout) :: xnode(*), motion(*)
    ! -1: no beam; -3: the state is not without equilibrium, or not of this beam; -5: too little room, NNODE says how much; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(error_type), allocatable :: error

    call take_both(work, iwork, state, istate, beam, result, info)
    if (info /= 0) return
    nnode = count_nodes(beam)
    if (maxnd < nnode) info = -5
    if (info /= 0) return
    call get_motion(beam, result, xnode(1:nnode), motion(1:nnode), error)
    if (allocated(error)) info = -3
end subroutine gbmotn

! How good a state is, and which supports its digits cannot decide
subroutine gbcert(work, iwork, state, istate, cert, known, iundec, info)
    use gapbeam_error, only: error_type, gapbeam_no_memory, gapbeam_not_prepared
    use gapbeam_api, only: prepared_type, result_type, certificate_type, get_certificate, count_supports
    use gapbeam_work, only: take_both
    implicit none
    ! Beam and state
    double precision, intent(in) :: work(*), state(*)
    integer, intent(in) :: iwork(*), istate(*)
    ! Relative residuals of equilibrium, compatibility, complementarity; largest error of any deflection of a node, any reaction;
    ! of deflections, rotations, moments and shears along the beam
    double precision, intent(inout) :: cert(9)
    ! 1 where deflections and rotations have a bound
    integer, intent(inout) :: known
    ! 1 for every support whose reaction or opening is zero, so that it may be closed or open
    integer, intent(inout) :: iundec(*)
    ! -1: no beam; -3: nothing solved, or not of this beam; 12, 13: it cannot be checked in quadruple precision; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(result_type) :: result
    type(certificate_type) :: certificate
    type(error_type), allocatable :: error
    logical, allocatable :: undecided(:)
    integer :: stat

    call take_both(work, iwork, state, istate, beam, result, info)
    if (info /= 0) return
    allocate (undecided(count_supports(beam)), stat=stat)
    if (stat /= 0) then
        info = gapbeam_no_memory
        return
    end if
    call get_certificate(beam, result, certificate, undecided, error)
    if (allocated(error)) then
        info = merge(-3, error%code, error%code == gapbeam_not_prepared)
        return
    end if
    cert = [certificate%equilibrium, certificate%compatibility, certificate%complementarity, &
            certificate%deflection_bound, certificate%reaction_bound, certificate%field_bound]
    known = merge(1, 0, certificate%known)
    iundec(1:size(undecided)) = merge(1, 0, undecided)
end subroutine gbcert

! Infinity, for which Fortran 77 has no name
function gbinf() result(value)
    use gapbeam_scene, only: gapbeam_infinity
    implicit none
    double precision :: value

    value = gapbeam_infinity
end function gbinf

! Version of the library
subroutine gbvers(major, minor, patch)
    use gapbeam_version, only: gapbeam_version_major, gapbeam_version_minor, gapbeam_version_patch
    implicit none
    integer, intent(out) :: major, minor, patch

    major = gapbeam_version_major
    minor = gapbeam_version_minor
    patch = gapbeam_version_patch
end subroutine gbvers
