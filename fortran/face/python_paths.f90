! Paths of the load for Python, in the manner of face/python.f90, which says what the arguments are

! Follow the load from a factor to LIMIT, from event to event; events are on smooth laws, the scheme is on their polylines
subroutine gbpath(most, beam, nl, ns, limit, factor, closed, margin, events, at, which, what, motion, solves, nodes, status, &
                  message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_events, only: follow_some_events
    use gapbeam_path, only: path_type
    implicit none
    ! Number of events after which it stops
    integer, intent(in) :: most
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    double precision, intent(in) :: limit
    ! Load factor of the state at hand, its scheme, and 1 for supports at zero there; how far it went out
    double precision, intent(inout) :: factor
    integer, intent(inout) :: closed(ns + 1), margin(ns + 1)
    ! Changes of the scheme: load factor, support (from 1), the event as in gapbeam_pieces, -1 where there is none; 3 turns, which
    ! is no change
    integer, intent(out) :: events
    double precision, intent(out) :: at(most + 6*ns + 8)
    integer, intent(out) :: which(most + 6*ns + 8), what(most + 6*ns + 8)
    ! Motion that begins where there is no equilibrium above FACTOR
    double precision, intent(out) :: motion(0:nl)
    ! Linear solves of the whole beam; nodes at which the solution was made anew besides
    integer, intent(out) :: solves, nodes, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    type(handle_type), pointer :: handle
    type(path_type) :: path
    type(outcome_type) :: outcome
    type(error_type), allocatable :: error
    logical, allocatable :: acting(:), zero(:)

    handle => handle_of(beam)
    events = 0
    at = 0.0d0
    which = 0
    what = 0
    motion = 0.0d0
    solves = 0
    nodes = 0
    allocate (acting(ns), zero(ns))
    acting(:) = closed(:ns) /= 0
    zero(:) = margin(:ns) /= 0
    call follow_some_events(handle%lowered, limit, most, factor, acting, zero, path, outcome, error)
    call report(error, status, message)
    if (allocated(error)) return
    closed(:ns) = merge(1, 0, acting)
    margin(:ns) = merge(1, 0, zero)
    events = path%count
    at(:events) = path%factor(:events)
    which(:events) = path%support(:events)
    what(:events) = path%event(:events)
    solves = path%solves
    nodes = path%nodes
    status = outcome%status
    if (allocated(outcome%motion)) motion = outcome%motion
end subroutine gbpath

! Follow the load through factors in turn, by the path itself
subroutine gbhist(beam, nf, factor, limit, most, sizes, status, message)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_beam_handle, only: handle_type, handle_of
    use gapbeam_history, only: follow_history
    use gapbeam_state, only: name_range
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nf
    ! Load factors to go to
    double precision, intent(in) :: factor(nf)
    ! At a limit: 0 stop, 1 jump, 2 follow the path; stretches after which it is cut off
    integer, intent(in) :: limit, most
    ! Stretches, limits, ways not taken, how it ended (gapbeam_history), linear solves; kept for GBHGET
    integer, intent(out) :: sizes(5), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(factor) :: nf = shape(factor, 0)
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    sizes = 0
    status = gapbeam_solved
    message = " "
    if (allocated(handle%history)) deallocate (handle%history)
    allocate (handle%history)
    call follow_history(handle%lowered, factor, limit, most, handle%history, error)
    call name_range(handle%lowered, error)
    if (allocated(error)) then
        status = error%code
        message = error%message
        return
    end if
    sizes = [handle%history%number, size(handle%history%limits), size(handle%history%others), handle%history%ending, &
             handle%history%solves]
end subroutine gbhist

! What GBHIST found
subroutine gbhget(beam, nl, ns, nh, nk, nw, along, about, closed, laws, factors, which, motion, others, scheme)
    use gapbeam_beam_handle, only: handle_type, handle_of
    use gapbeam_history, only: laws_at
    use gapbeam_polyline, only: node_support_type
    implicit none
    integer(8), intent(in) :: beam
    ! Links; supports of the engine, stretches, limits and ways not taken, one more than there are
    integer, intent(in) :: nl, ns, nh, nk, nw
    ! Of every stretch: load factors; leg (0 dead loads, then from 1), direction, index, ways, 1 if passed in a jump
    double precision, intent(out) :: along(2, nh)
    integer, intent(out) :: about(5, nh)
    ! Scheme: 1 closed, 0 open; contact level, force, slope and slope before of every support as it has become
    integer(1), intent(out) :: closed(ns, nh)
    double precision, intent(out) :: laws(4, ns, nh)
    ! Of every limit: load factor; kind, leg, stretch before it, stretch of the landing (from 1, 0 none)
    double precision, intent(out) :: factors(nk)
    integer, intent(out) :: which(4, nk)
    ! How the beam moves where the path ended in a mechanism; 0 if it did not
    double precision, intent(out) :: motion(0:nl)
    ! Of every way not taken: stretch that was taken instead (from 1), direction, index; scheme
    integer, intent(out) :: others(3, nw)
    integer(1), intent(out) :: scheme(ns, nw)
    type(handle_type), pointer :: handle
    type(node_support_type), allocatable :: now(:)
    integer :: k

    handle => handle_of(beam)
    along = 0.0d0
    about = 0
    closed = int(0, kind(closed))
    laws = 0.0d0
    factors = 0.0d0
    which = 0
    motion = 0.0d0
    if (allocated(handle%history%motion)) motion = handle%history%motion
    do k = 1, nh - 1
        associate (s => handle%history%stretches(k))
            along(:, k) = [s%from, s%to]
            about(:, k) = [s%leg, s%direction, s%index, s%ways, merge(1, 0, s%skipped)]
            closed(:ns - 1, k) = int(merge(1, 0, s%closed), kind(closed))
            now = laws_at(handle%lowered, s)
            laws(1, :ns - 1, k) = now%contact
            laws(2, :ns - 1, k) = now%force
            laws(3, :ns - 1, k) = now%stiffness
            laws(4, :ns - 1, k) = now%before
        end associate
    end do
    do k = 1, nk - 1
        associate (limit => handle%history%limits(k))
            factors(k) = limit%factor
            which(:, k) = [limit%kind, limit%leg, limit%stretch, limit%landing]
        end associate
    end do
    others = 0
    scheme = int(0, kind(scheme))
    do k = 1, nw - 1
        associate (way => handle%history%others(k))
            others(:, k) = [way%stretch, way%direction, way%index]
            scheme(:ns - 1, k) = int(merge(1, 0, way%closed), kind(scheme))
        end associate
    end do
end subroutine gbhget
