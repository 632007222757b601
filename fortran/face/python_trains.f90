! Trains for Python, in the manner of face/python.f90: plain arrays, nothing but marshalling. Positions are in the scene's units.
!
! BEAM is the handle of a prepared beam with NL links, NS supports of the engine, NM supports of the scene; TRAIN that of a train on
! its way over it. Arrays over supports, stretches and events have one entry more than there are.

! Move a train over a beam
subroutine gbtmak(beam, na, nu, offset, force, uniform, from, to, back, train, sizes, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_train_handle, only: new_train
    implicit none
    integer(8), intent(in) :: beam
    ! Axles; uniform loads and one more
    integer, intent(in) :: na, nu
    ! Distances of the axles from the place of the train, to the right, and their forces (down)
    double precision, intent(in) :: offset(na), force(na)
    ! Uniform loads (down), and distances between which they act; positions of the train
    double precision, intent(in) :: uniform(3, nu), from, to
    ! 1 where the train goes towards smaller positions
    integer, intent(in) :: back
    ! Handle; 0 where there is an error
    integer(8), intent(out) :: train
    ! Stretches, motions, events, linear solves
    integer, intent(out) :: sizes(4), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(offset) :: na = shape(offset, 0)
    !f2py integer, intent(hide), depend(uniform) :: nu = shape(uniform, 1)
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    call new_train(handle%lowered, offset, force, uniform(:, :nu - 1), from, to, back /= 0, train, sizes, error)
    call report(error, status, message)
end subroutine gbtmak

! Free a train
subroutine gbtdro(train)
    use gapbeam_train_handle, only: drop_train
    implicit none
    integer(8), intent(in) :: train

    call drop_train(train)
end subroutine gbtdro

! The way of a train: stretches, motions and events
subroutine gbtget(train, ns, nl, nt, nk, ne, ends, codes, closed, motion, place, events)
    use gapbeam_train_handle, only: train_handle_type, train_of
    implicit none
    integer(8), intent(in) :: train
    ! Supports of the engine, stretches, motions, events: one more than there are; links
    integer, intent(in) :: ns, nl, nt, nk, ne
    ! First and last position of every stretch
    double precision, intent(out) :: ends(2, nt)
    ! 0 solved, 1 no equilibrium, 2 the position of the beam is not unique; number of the motion, from 1 (0: none)
    integer, intent(out) :: codes(2, nt)
    ! Scheme: 1 closed, 0 open
    integer(1), intent(out) :: closed(ns, nt)
    ! Free motions
    double precision, intent(out) :: motion(0:nl, nk)
    ! Of every event the position of the train; number of the support, from 0, what it is then, what happens (gapbeam_pieces)
    double precision, intent(out) :: place(ne)
    integer, intent(out) :: events(3, ne)
    type(train_handle_type), pointer :: handle
    integer :: k

    handle => train_of(train)
    ends = 0.0d0
    codes = 0
    closed = int(0, kind(closed))
    motion = 0.0d0
    place = 0.0d0
    events = 0
    do k = 1, nt - 1
        ends(:, k) = [handle%passage%from(k), handle%passage%to(k)]
        codes(:, k) = [handle%passage%status(k), handle%passage%motion_of(k)]
        closed(:ns - 1, k) = int(merge(1, 0, handle%passage%closed(:, k)), kind(closed))
    end do
    motion(:, :nk - 1) = handle%passage%motion
    do k = 1, ne - 1
        place(k) = handle%events(k)%position
        events(:, k) = [handle%events(k)%support - 1, handle%events(k)%state, handle%events(k)%change]
    end do
end subroutine gbtget

! Extremes while a train goes over a beam
subroutine gbtenv(beam, train, nm, nb, fields, field_sides, field_ties, supports, support_sides, support_ties, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_train, only: track_type
    use gapbeam_train_handle, only: train_handle_type, train_of, pack_extremes
    use gapbeam_train_envelope, only: envelope_type, find_envelope
    implicit none
    integer(8), intent(in) :: beam, train
    ! One more than there are; quantities of bending (fortran/beam/quantities.f90)
    integer, intent(in) :: nm, nb
    ! Of the largest (1) and smallest (2) of each up to 16 ties: value, x, position
    double precision, intent(out) :: fields(3, 16, 2, nb)
    ! 1 left of x, 2 right of it, 0 both
    integer, intent(out) :: field_sides(16, 2, nb), field_ties(2, nb)
    ! The same of reaction, opening, deflection, couple of every support
    double precision, intent(out) :: supports(3, 16, 2, 4, nm)
    integer, intent(out) :: support_sides(16, 2, 4, nm), support_ties(2, 4, nm), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(train_handle_type), pointer :: passing
    type(envelope_type) :: envelope
    type(track_type) :: track
    type(error_type), allocatable :: error
    integer :: k

    handle => handle_of(beam)
    passing => train_of(train)
    supports = 0.0d0
    support_sides = 0
    support_ties = 0
    fields = 0.0d0
    field_sides = 0
    field_ties = 0
    ! Another thread may ask the same train
    track = passing%track
    call find_envelope(handle%lowered, track, passing%train, passing%passage, envelope, error)
    call report(error, status, message)
    if (allocated(error)) return
    call pack_extremes(envelope%fields, fields, field_sides, field_ties)
    do k = 1, nm - 1
        call pack_extremes(envelope%supports(:, :, k), supports(:, :, :, :, k), support_sides(:, :, :, k), &
                           support_ties(:, :, k))
    end do
end subroutine gbtenv

! Largest and smallest values at places of the beam while a train goes over it
subroutine gbtcur(beam, train, nx, nb, piece, dist, value, position, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_train, only: track_type
    use gapbeam_train_handle, only: train_handle_type, train_of
    use gapbeam_train_curves, only: find_curves
    implicit none
    integer(8), intent(in) :: beam, train
    ! Places; quantities of bending (fortran/beam/quantities.f90)
    integer, intent(in) :: nx, nb
    ! Pieces (from 1) and distances from their left ends
    integer, intent(in) :: piece(nx)
    double precision, intent(in) :: dist(nx)
    ! Largest (1) and smallest (2) of each, and the positions of the train
    double precision, intent(out) :: value(2, nb, nx), position(2, nb, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: nx = shape(piece, 0)
    type(handle_type), pointer :: handle
    type(train_handle_type), pointer :: passing
    type(track_type) :: track
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    passing => train_of(train)
    ! Another thread may ask the same train
    track = passing%track
    call find_curves(handle%lowered, track, passing%train, passing%passage, piece, dist, value, position, error)
    call report(error, status, message)
end subroutine gbtcur

! Influence lines of a scheme at a place of the beam
subroutine gbtinf(beam, train, ns, nm, nx, nb, closed, chosen, piece, dist, x, value, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_train_handle, only: train_handle_type, train_of
    use gapbeam_train_influence, only: find_influence
    implicit none
    integer(8), intent(in) :: beam, train
    ! One more than there are supports of the engine and of the scene; places of the force
    integer, intent(in) :: ns, nm, nx
    ! Quantities of bending (fortran/beam/quantities.f90), and one more
    integer, intent(in) :: nb
    ! Scheme: 1 closed, 0 open; 1 for the supports of the scene whose reactions are meant
    integer, intent(in) :: closed(ns), chosen(nm)
    ! The place: piece (from 1) and distance from its left end; places of the unit force
    integer, intent(in) :: piece
    double precision, intent(in) :: dist, x(nx)
    ! The quantities at the place, sum of the reactions
    double precision, intent(out) :: value(nb, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0)
    !f2py integer, intent(hide), depend(chosen) :: nm = shape(chosen, 0)
    !f2py integer, intent(hide), depend(x) :: nx = shape(x, 0)
    type(handle_type), pointer :: handle
    type(train_handle_type), pointer :: passing
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    passing => train_of(train)
    value = 0.0d0
    call find_influence(handle%lowered, passing%track, closed(:ns - 1) /= 0, chosen(:nm - 1) /= 0, piece, dist, x, value, error)
    call report(error, status, message)
end subroutine gbtinf
