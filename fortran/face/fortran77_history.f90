! Histories of the load in Fortran 77: the exact path, through limit points, of beams whose supports may soften, break or keep a
! set. Marshalling only; units, signs, handles and INFO: see fortran77.f90.

! Put on the dead loads, settlements and lacks of fit together, then go through load factors in turn, from factor 0, by the exact
! path: through every event, past limits of the load, with supports that soften, break or keep a set
subroutine ghhist(beam, nfact, factor, limit, hist, number, info)
    use gapbeam_new_objects, only: new_history
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, find_first, number_of, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! Load factors, 1 or more
    integer, intent(in) :: nfact
    double precision, intent(in) :: factor(*)
    ! Where the load cannot go on: 0 end there; 1 go on from the next stable state on the path at this factor; 2 follow the
    ! path, also with falling load
    integer, intent(in) :: limit
    ! The history, which keeps nothing of the beam
    integer(8), intent(out) :: hist
    ! Numbers of stretches, events and limits; how the path ends, 0 at the last factor, 3 in a mechanism, 4 otherwise; linear solves
    ! in quadruple precision; nodes in GHHMOT, 0 where the path does not end in a motion
    integer, intent(inout) :: number(6)
    ! -1, also of a beam on a foundation; -2, -3, -4; 13 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, followed
    type(error_type), allocatable :: error

    hist = 0
    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. nfact < 1) info = -2
    if (info /= 0) return
    call new_history(prepared%beam, factor(1:nfact), limit, followed, error)
    info = info_of(error, 1, ["factors ", "at_limit"], [3, 4])
    if (info /= 0) return
    hist = number_of(followed)
    associate (h => followed%history)
        number = [size(h%stretches), size(h%events), size(h%limits), h%ending, h%solves, 0]
        if (allocated(h%motion)) number(6) = size(h%motion)
    end associate
end subroutine ghhist

! What a history is made of
subroutine ghhget(hist, maxst, stfact, istrch, maxev, evfact, ievent, maxlim, lmfact, ilimit, info)
    use gapbeam_fortran77_info, only: handle_type, history_tag, find_first
    implicit none
    integer(8), intent(in) :: hist
    ! Room for stretches, events and limits, 0 or more
    integer, intent(in) :: maxst, maxev, maxlim
    ! The first MAXST stretches: load factors at their ends; factor that is gone to, from 1, 0 while the dead loads are put on;
    ! 1 the load rises, -1 it falls, 0 the beam turns; 1 stable, 0 not; in how many independent ways the beam gives way by
    ! itself; ways on there were at its beginning; 1 passed in a jump, or beyond the limit at which the load stops
    double precision, intent(inout) :: stfact(2, *)
    integer, intent(inout) :: istrch(6, *)
    ! The first MAXEV events: load factor; support; what it is from there on, as from GHEVNT; what happens, 0 opens, 1 closes,
    ! 3 turns, 4 yields, 5 hardens, 6 softens, 7 breaks, 8 unloads; stretch that begins with it
    double precision, intent(inout) :: evfact(*)
    integer, intent(inout) :: ievent(4, *)
    ! The first MAXLIM limits: load factor; kind, 1 limit point, 2 bifurcation, 3 mechanism; factor that is gone to; last stretch
    ! before it; stretch on which the beam lands at the same factor, 0 if none
    double precision, intent(inout) :: lmfact(*)
    integer, intent(inout) :: ilimit(4, *)
    ! -1, -2, -5, -8
    integer, intent(out) :: info
    type(handle_type), pointer :: followed
    integer :: k

    call find_first(hist, history_tag, followed, info)
    if (info == 0 .and. maxst < 0) info = -2
    if (info == 0 .and. maxev < 0) info = -5
    if (info == 0 .and. maxlim < 0) info = -8
    if (info /= 0) return
    do k = 1, min(maxst, size(followed%history%stretches))
        associate (s => followed%history%stretches(k))
            stfact(:, k) = [s%from, s%to]
            istrch(:, k) = [s%leg, s%direction, merge(1, 0, s%stable), s%index, s%ways, merge(1, 0, s%skipped)]
        end associate
    end do
    do k = 1, min(maxev, size(followed%history%events))
        associate (event => followed%history%events(k))
            evfact(k) = event%factor
            ievent(:, k) = [event%support, event%state, event%change, event%stretch]
        end associate
    end do
    do k = 1, min(maxlim, size(followed%history%limits))
        associate (found => followed%history%limits(k))
            lmfact(k) = found%factor
            ilimit(:, k) = [found%kind, found%leg, found%stretch, found%landing]
        end associate
    end do
end subroutine ghhget

! Where a history is on the laws of supports that are curves: 1, also without curves; 0 where load factors are known on polylines of
! these only, off by about one part in a hundred of what the curve carries, and no state is given
subroutine ghhexa(hist, maxst, istrch, maxlim, ilimit, info)
    use gapbeam_fortran77_info, only: handle_type, history_tag, find_first
    implicit none
    integer(8), intent(in) :: hist
    ! Room for stretches and limits, 0 or more
    integer, intent(in) :: maxst, maxlim
    ! Of the first MAXST stretches, where they end; of the first MAXLIM limits
    integer, intent(inout) :: istrch(*), ilimit(*)
    ! -1, -2, -4
    integer, intent(out) :: info
    type(handle_type), pointer :: followed

    call find_first(hist, history_tag, followed, info)
    if (info == 0 .and. maxst < 0) info = -2
    if (info == 0 .and. maxlim < 0) info = -4
    if (info /= 0) return
    associate (s => followed%history%stretches, limits => followed%history%limits)
        istrch(:min(maxst, size(s))) = merge(1, 0, s(:min(maxst, size(s)))%exact)
        ilimit(:min(maxlim, size(limits))) = merge(1, 0, limits(:min(maxlim, size(limits)))%exact)
    end associate
end subroutine ghhexa

! The motion in which a history ends
subroutine ghhmot(hist, maxnd, xnode, motion, info)
    use gapbeam_fortran77_info, only: handle_type, history_tag, find_first
    implicit none
    integer(8), intent(in) :: hist
    ! Room in the arrays, NUMBER(6) of GHHIST
    integer, intent(in) :: maxnd
    ! As from GHMOTN
    double precision, intent(inout) :: xnode(*), motion(*)
    ! -1, also of a history that does not end in a motion; -2: too little room
    integer, intent(out) :: info
    type(handle_type), pointer :: followed

    call find_first(hist, history_tag, followed, info)
    if (info /= 0) return
    associate (h => followed%history)
        if (.not. allocated(h%motion)) info = -1
        if (info /= 0) return
        if (maxnd < size(h%motion)) info = -2
        if (info /= 0) return
        xnode(1:size(h%x)) = h%x
        motion(1:size(h%motion)) = h%motion
    end associate
end subroutine ghhmot

! The state at a load factor on a history
subroutine ghhsol(beam, hist, nstrch, at, state, info)
    use gapbeam_api_history, only: solve_on_path
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, history_tag, find_both, find, info_of
    implicit none
    integer(8), intent(in) :: beam, hist
    ! Number of the stretch; 0: the last one with AT that is not passed in a jump, a stable one if there is any
    integer, intent(in) :: nstrch
    ! Load factor on the stretch
    double precision, intent(in) :: at
    ! The state
    integer(8), intent(in) :: state
    ! -1; -2, also of another beam, or of other loads; -3: no such stretch; -4: no state at AT on it, or on the path; -5; 1, 12 to
    ! 15 (13 also where it is known on the polylines of curves only, see GHHEXA), 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, followed, solved
    type(error_type), allocatable :: error

    call find_both(beam, hist, history_tag, prepared, followed, info)
    call find(state, 5, state_tag, solved, info)
    if (info /= 0) return
    call solve_on_path(prepared%beam, followed%history, at, solved%result, error, nstrch)
    info = info_of(error, 4, ["stretch"], [3])
    if (info == 0) info = solved%result%status
end subroutine ghhsol

! Energy that is set free where the load cannot go on and the beam falls to its landing: force times length
subroutine ghheng(beam, hist, nlimit, energy, info)
    use gapbeam_api_history, only: get_released_energy
    use gapbeam_fortran77_info, only: error_type, handle_type, history_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, hist
    ! Number of the limit
    integer, intent(in) :: nlimit
    ! Left as it is where INFO is not 0
    double precision, intent(inout) :: energy
    ! -1; -2, also of another beam, or of other loads; -3: no such limit, it has no landing, or it is met while the dead loads are
    ! put on; 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, followed
    type(error_type), allocatable :: error
    double precision :: found

    call find_both(beam, hist, history_tag, prepared, followed, info)
    if (info /= 0) return
    call get_released_energy(prepared%beam, followed%history, nlimit, found, error)
    info = info_of(error, 3, ["limit"], [3])
    if (info == 0) energy = found
end subroutine ghheng
