! Trains for Python, in the manner of face/python.f90: plain arrays, nothing but marshalling. Positions are in the scene's units.
!
! BEAM is the handle of a prepared beam with NL links, NS supports of the engine, NM supports of the scene; TRAIN that of a train on
! its way over it. Arrays over supports, stretches and events have one entry more than there are.

! Move a train over a beam
subroutine gbtmak(beam, na, nu, offset, force, uniform, from, to, back, train, sizes, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, keep_train, train_of, report
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
    type(handle_type), pointer :: handle, passing
    type(error_type), allocatable :: error

    handle => behind(beam)
    sizes = 0
    call keep_train(handle%beam%lowered, train_of(offset, force, uniform(:, :nu - 1)), from, to, back /= 0, passing, error)
    train = number_of(passing)
    call report(error, status, message)
    if (allocated(error)) return
    associate (passage => passing%passing%passage)
        sizes = [passage%number, size(passage%motion, 2), size(passing%passing%events), passage%solves]
    end associate
end subroutine gbtmak

! The way of a train: stretches, motions and events
subroutine gbtget(train, ns, nl, nt, nk, ne, ends, codes, closed, motion, place, events)
    use gapbeam_python_handles, only: handle_type, behind
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
    type(handle_type), pointer :: handle
    integer :: k

    handle => behind(train)
    ends = 0.0d0
    codes = 0
    closed = int(0, kind(closed))
    motion = 0.0d0
    place = 0.0d0
    events = 0
    associate (passage => handle%passing%passage, list => handle%passing%events)
        do k = 1, nt - 1
            ends(:, k) = [passage%from(k), passage%to(k)]
            codes(:, k) = [passage%status(k), passage%motion_of(k)]
            closed(:ns - 1, k) = int(merge(1, 0, passage%closed(:, k)), kind(closed))
        end do
        motion(:, :nk - 1) = passage%motion
        do k = 1, ne - 1
            place(k) = list(k)%position
            events(:, k) = [list(k)%support - 1, list(k)%state, list(k)%change]
        end do
    end associate
end subroutine gbtget

! Extremes while a train goes over a beam
subroutine gbtenv(beam, train, nm, nb, fields, field_sides, field_ties, supports, support_sides, support_ties, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report, pack_extremes
    use gapbeam_train, only: track_type
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
    type(handle_type), pointer :: handle, passing
    type(envelope_type) :: envelope
    type(track_type) :: track
    type(error_type), allocatable :: error
    integer :: k

    handle => behind(beam)
    passing => behind(train)
    supports = 0.0d0
    support_sides = 0
    support_ties = 0
    fields = 0.0d0
    field_sides = 0
    field_ties = 0
    ! Another thread may ask the same train
    associate (p => passing%passing)
        track = p%track
        call find_envelope(handle%beam%lowered, track, p%passage, envelope, error)
    end associate
    call report(error, status, message)
    if (allocated(error)) return
    call pack_extremes(envelope%fields, fields, field_sides, field_ties)
    do k = 1, nm - 1
        call pack_extremes(envelope%supports(:, :, k), supports(:, :, :, :, k), support_sides(:, :, :, k), support_ties(:, :, k))
    end do
end subroutine gbtenv

! Largest and smallest values at places of the beam while a train goes over it
subroutine gbtcur(beam, train, nx, nb, piece, dist, value, position, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_train, only: track_type
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
    type(handle_type), pointer :: handle, passing
    type(track_type) :: track
    type(error_type), allocatable :: error

    handle => behind(beam)
    passing => behind(train)
    ! Another thread may ask the same train
    associate (p => passing%passing)
        track = p%track
        call find_curves(handle%beam%lowered, track, p%passage, piece, dist, value, position, error)
    end associate
    call report(error, status, message)
end subroutine gbtcur

! Influence lines of a scheme at a place of the beam
subroutine gbtinf(beam, train, ns, nm, nx, nb, closed, chosen, piece, dist, x, value, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_train_influence, only: find_influence
    implicit none
    integer(8), intent(in) :: beam, train
    ! One more than there are supports of the engine and of the scene; places of the force
    integer, intent(in) :: ns, nm, nx
    ! Quantities of bending (fortran/beam/quantities.f90), and two more
    integer, intent(in) :: nb
    ! Scheme: 1 closed, 0 open; 1 for the supports of the scene whose reactions and couples are meant
    integer, intent(in) :: closed(ns), chosen(nm)
    ! The place: piece (from 1) and distance from its left end; places of the unit force
    integer, intent(in) :: piece
    double precision, intent(in) :: dist, x(nx)
    ! The quantities at the place, sums of the reactions and of the couples
    double precision, intent(out) :: value(nb, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, passing
    type(error_type), allocatable :: error

    handle => behind(beam)
    passing => behind(train)
    value = 0.0d0
    call find_influence(handle%beam%lowered, passing%passing%track, closed(:ns - 1) /= 0, chosen(:nm - 1) /= 0, piece, dist, x, &
                        value, error)
    call report(error, status, message)
end subroutine gbtinf

! Parts of the beam on which an influence line has one sign
subroutine gbtprt(beam, ns, nm, ne, closed, chosen, piece, dist, what, edge, sign_of, number, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_influence_parts, only: find_parts
    implicit none
    integer(8), intent(in) :: beam
    ! As of gbtinf; the most parts, 4 for every piece of the beam and 4 more
    integer, intent(in) :: ns, nm, ne
    integer, intent(in) :: closed(ns), chosen(nm)
    integer, intent(in) :: piece
    double precision, intent(in) :: dist
    ! Which of the values of gbtinf, from 1
    integer, intent(in) :: what
    ! Right ends of the parts, and the sign of the line on each; how many there are
    double precision, intent(out) :: edge(ne)
    integer, intent(out) :: sign_of(ne), number
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => behind(beam)
    edge = 0.0d0
    sign_of = 0
    call find_parts(handle%beam%lowered, closed(:ns - 1) /= 0, chosen(:nm - 1) /= 0, piece, dist, what, edge, sign_of, number, &
                    error)
    call report(error, status, message)
end subroutine gbtprt
