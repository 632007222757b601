! Paths of the load for Python, in the manner of face/python.f90, which says what the arguments are

! Follow the load from a factor to LIMIT, from event to event; events are on smooth laws, the scheme is on their polylines
subroutine gbpath(most, beam, nl, ns, limit, factor, closed, margin, events, at, which, what, motion, solves, nodes, status, &
                  message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
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
    type(handle_type), pointer :: handle
    type(path_type) :: path
    type(outcome_type) :: outcome
    type(error_type), allocatable :: error
    logical, allocatable :: acting(:), zero(:)

    handle => behind(beam)
    events = 0
    at = 0.0d0
    which = 0
    what = 0
    motion = 0.0d0
    solves = 0
    nodes = 0
    acting = closed(:ns) /= 0
    zero = margin(:ns) /= 0
    call follow_some_events(handle%beam%lowered, limit, most, factor, acting, zero, path, outcome, error)
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

! Follow the load through factors in turn, by the path itself, on smooth laws where it is known there
subroutine gbhist(beam, nf, factor, limit, most, sizes, hist, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, report
    use gapbeam_handles, only: history_tag, new_handle, finish_handle
    use gapbeam_error, only: no_memory
    use gapbeam_history_record, only: runs_of
    use gapbeam_history_events, only: find_events
    use gapbeam_smooth_path, only: follow_on_laws
    use gapbeam_along_axis, only: name_range
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nf
    ! Load factors to go to
    double precision, intent(in) :: factor(nf)
    ! At a limit: 0 stop, 1 jump, 2 follow the path; stretches after which it is cut off
    integer, intent(in) :: limit, most
    ! Stretches, limits, ways not taken, runs of stretches, events, how it ended (gapbeam_history_record), linear solves
    integer, intent(out) :: sizes(7)
    ! Handle of the path
    integer(8), intent(out) :: hist
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, found
    type(error_type), allocatable :: error
    integer :: stat

    handle => behind(beam)
    sizes = 0
    call new_handle(history_tag, found, error)
    if (.not. allocated(error)) then
        allocate (found%history%path, stat=stat)
        if (stat == 0) call follow_on_laws(handle%beam%lowered, factor, limit, most, found%history%path, error)
        call name_range(handle%beam%lowered, error)
        if (stat /= 0) call no_memory(error)
        if (.not. allocated(error)) call find_events(handle%beam%lowered, found%history%path, found%history%events)
    end if
    call finish_handle(found, error)
    hist = number_of(found)
    call report(error, status, message)
    if (allocated(error)) return
    associate (path => found%history%path)
        sizes = [path%number, size(path%limits), size(path%others), size(runs_of(path), 2), size(found%history%events), &
                 path%ending, path%solves]
    end associate
end subroutine gbhist

! What GBHIST found
subroutine gbhget(hist, nl, ns, nh, nk, nw, nr, ne, along, about, factors, which, motion, others, scheme, runs, at, events)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_history_record, only: runs_of
    use gapbeam_path_states, only: is_exact
    implicit none
    integer(8), intent(in) :: hist
    ! Links; supports of the engine, stretches, limits, ways not taken, runs and events, one more than there are
    integer, intent(in) :: nl, ns, nh, nk, nw, nr, ne
    ! Of every stretch: load factors; leg (0 dead loads, then from 1), direction, index, ways, 1 if passed in a jump, 1 if its end
    ! is on the smooth laws; the stretch from which on no scheme and no law across the beam has changed, from 1
    double precision, intent(out) :: along(2, nh)
    integer, intent(out) :: about(7, nh)
    ! Of every limit: load factor; kind, leg, stretch before it, stretch of the landing (from 1, 0 none)
    double precision, intent(out) :: factors(nk)
    integer, intent(out) :: which(4, nk)
    ! How the beam moves where the path ended in a mechanism; 0 if it did not
    double precision, intent(out) :: motion(0:nl)
    ! Of every way not taken: stretch that was taken instead (from 1), direction, index; scheme
    integer, intent(out) :: others(3, nw)
    integer(1), intent(out) :: scheme(ns, nw)
    ! First and last stretch (from 1) of every part on which all supports stay on their piece, a smooth law being one
    integer, intent(out) :: runs(2, nr)
    ! Of every event: load factor; support of the scene (from 1), what happens as in gapbeam_pieces
    double precision, intent(out) :: at(ne)
    integer, intent(out) :: events(2, ne)
    type(handle_type), pointer :: found
    integer :: k, same
    logical :: begins

    found => behind(hist)
    same = 1
    along = 0.0d0
    about = 0
    factors = 0.0d0
    which = 0
    motion = 0.0d0
    others = 0
    scheme = int(0, kind(scheme))
    runs = 0
    at = 0.0d0
    events = 0
    do k = 1, ne - 1
        associate (event => found%history%events(k))
            at(k) = event%factor
            events(:, k) = [event%support, event%change]
        end associate
    end do
    associate (path => found%history%path)
        if (allocated(path%motion)) motion = path%motion
        do k = 1, nh - 1
            associate (s => path%stretches(k))
                along(:, k) = [s%from, s%to]
                begins = .not. allocated(s%changed)
                if (.not. begins) begins = size(s%changed) > 0
                if (begins) same = k
                about(:, k) = [s%leg, s%direction, s%index, s%ways, merge(1, 0, s%skipped), merge(1, 0, is_exact(path, k)), same]
            end associate
        end do
        do k = 1, nk - 1
            associate (limit => path%limits(k))
                factors(k) = limit%factor
                which(:, k) = [limit%kind, limit%leg, limit%stretch, limit%landing]
            end associate
        end do
        do k = 1, nw - 1
            associate (way => path%others(k))
                others(:, k) = [way%stretch, way%direction, way%index]
                scheme(:ns - 1, k) = int(merge(1, 0, way%closed), kind(scheme))
            end associate
        end do
        runs(:, :nr - 1) = runs_of(path)
    end associate
end subroutine gbhget

! The pieces of all supports on a stretch of a path
subroutine gbhsch(beam, hist, ns, stretch, closed, laws)
    use gapbeam_python_handles, only: handle_type, behind, put_laws
    use gapbeam_history_record, only: scheme_at, laws_at
    implicit none
    integer(8), intent(in) :: beam, hist
    ! Supports of the engine, one more than there are; number of the stretch, from 1
    integer, intent(in) :: ns, stretch
    ! Scheme: 1 closed, 0 open; contact level, force, slope and slope before of every support as it has become
    integer, intent(out) :: closed(ns)
    double precision, intent(out) :: laws(4, ns)
    type(handle_type), pointer :: handle, found

    handle => behind(beam)
    found => behind(hist)
    closed = 0
    laws = 0.0d0
    closed(:ns - 1) = merge(1, 0, scheme_at(found%history%path, stretch))
    call put_laws(laws_at(handle%beam%lowered, found%history%path, stretch), laws)
end subroutine gbhsch

! Lines in place of smooth laws in the state at a load factor on a path
subroutine gbhlin(beam, hist, ns, stretch, factor, laws, how, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report, put_laws
    use gapbeam_path_states, only: find_lines
    use gapbeam_polyline, only: node_support_type
    implicit none
    ! With the loads of the leg: its dead ones as live ones while these are put on
    integer(8), intent(in) :: beam, hist
    integer, intent(in) :: ns
    ! From 1: one of its run in, that with the scheme out
    integer, intent(inout) :: stretch
    double precision, intent(in) :: factor
    ! As from GBHGET; 1 tangents lead to the state, 2 it has these lines, 3 it is known on the polylines only
    double precision, intent(out) :: laws(4, ns)
    integer, intent(out) :: how, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, found
    type(error_type), allocatable :: error
    type(node_support_type), allocatable :: lines(:)

    handle => behind(beam)
    found => behind(hist)
    laws = 0.0d0
    call find_lines(handle%beam%lowered, found%history%path, stretch, factor, lines, how, error)
    call report(error, status, message)
    if (allocated(error)) return
    call put_laws(lines, laws)
end subroutine gbhlin

! What there is along the beam in a state on a path, put into the state
subroutine gbhaxi(beam, hist, state, stretch, factor, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_path_states, only: take_along
    implicit none
    ! The beam with the loads of the leg, the path, the state at the factor on the stretch
    integer(8), intent(in) :: beam, hist, state
    ! From 1
    integer, intent(in) :: stretch
    double precision, intent(in) :: factor
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    type(handle_type), pointer :: handle, found, solved
    type(error_type), allocatable :: error

    handle => behind(beam)
    found => behind(hist)
    solved => behind(state)
    call take_along(handle%beam%lowered, found%history%path, stretch, factor, solved%result%state, error)
    call report(error, status, message)
end subroutine gbhaxi

! What supports do in a state with links along the beam
subroutine gbalng(beam, state, nm, values, condit, force, slip, slides, loose)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_support_values, only: support_values, friction_values
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: nm
    ! As from GBSOLV; state of every support of the scene (gapbeam_pieces); force of friction on the beam and how far it has gone
    ! over the support, to the right; 1 where it slides to the right, -1 to the left
    double precision, intent(out) :: values(nm + 1, 4), force(nm), slip(nm)
    integer, intent(out) :: condit(nm), slides(nm)
    ! 1 where the beam can move freely, 2 where it can along its axis only
    integer, intent(out) :: loose
    type(handle_type), pointer :: handle, solved

    handle => behind(beam)
    solved => behind(state)
    values = 0.0d0
    associate (lowered => handle%beam%lowered, s => solved%result%state)
        call support_values(lowered, s, values(:nm, 1), values(:nm, 2), values(:nm, 3), values(:nm, 4), condit)
        call friction_values(lowered, s, force, slip, slides)
        loose = merge(merge(2, 1, s%loose_along), 0, s%indifferent)
    end associate
end subroutine gbalng

! Which numbers along the beam are at the ends of the stretches of a path
subroutine gbhend(hist, nh, ends)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    integer(8), intent(in) :: hist
    ! Stretches
    integer, intent(in) :: nh
    ! Of every stretch, at both ends, from 1
    integer, intent(out) :: ends(2, nh)
    type(handle_type), pointer :: found
    integer :: k

    found => behind(hist)
    do k = 1, nh
        ends(:, k) = found%history%path%stretches(k)%ends
    end do
end subroutine gbhend

! Axial forces at the ends of the stretches of a path
subroutine gbhten(beam, hist, np, nc, tension)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_assemble_axial, only: axial_node
    implicit none
    integer(8), intent(in) :: beam, hist
    ! Pieces; ends, as from GBHEND
    integer, intent(in) :: np, nc
    ! Of every piece, in the scene's units
    double precision, intent(out) :: tension(np, nc)
    type(handle_type), pointer :: handle, found
    integer :: bars(np), j, k

    handle => behind(beam)
    found => behind(hist)
    associate (axial => handle%beam%lowered%axial, columns => found%history%path%along%columns)
        bars = [(size(axial%point) + axial_node(axial%point, j), j=1, np)]
        do k = 1, nc
            tension(:, k) = scale(columns(k)%x(bars), axial%units%force)
        end do
    end associate
end subroutine gbhten

! Energy that is set free from a limit to its landing
subroutine gbheng(beam, hist, limit, energy, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_released_energy, only: find_released_energy
    implicit none
    integer(8), intent(in) :: beam, hist
    ! From 1
    integer, intent(in) :: limit
    double precision, intent(out) :: energy
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, found
    type(error_type), allocatable :: error

    handle => behind(beam)
    found => behind(hist)
    call find_released_energy(handle%beam%lowered, found%history%path, limit, energy, error)
    call report(error, status, message)
end subroutine gbheng
