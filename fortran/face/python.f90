! The engine for Python: plain arrays only, in the manner of Fortran 77. f2py reads this very file, so it holds only
! default kinds, explicit shapes and external subroutines, and nothing but marshalling. It is no part of the library, whose
! Fortran 77 interface (face/fortran77.f90) takes beams as users describe them and has its own GBSOLV and GBCERT.
!
! Arrays of records, one column each:
!   PIECE(3, NP)   length, 1/EI, 1/GA
!   DEAD, LIVE(5, NP)  load per length at the left and right end, imposed curvature, force (down) and
!                  couple (clockwise) at the right end of the piece unless a node is there
!   LINK(21, NL)   made by GBCOND, opaque
! Nodes are numbered from 0 to NL; LAST(I) is the last piece of link I. STATUS as in gapbeam_error: 0 solved, 1 no
! equilibrium, above 10 an error with its MESSAGE and nothing else set.

! Condense the pieces between nodes into links
subroutine gbcond(np, nl, piece, dead, live, last, link, lost, status)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory
    use gapbeam_link, only: link_type, piece_type, load_type, condense_link
    use gapbeam_range, only: first_lost_link
    implicit none
    integer, intent(in) :: np, nl
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np)
    integer, intent(in) :: last(nl)
    double precision, intent(out), target :: link(21, nl)
    ! The first link, from 1, that lost digits; with a minus the first whose loads are no numbers; 0: none
    integer, intent(out) :: lost, status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(last) :: nl = shape(last, 0)
    type(piece_type), pointer :: pieces(:)
    type(load_type), pointer :: deads(:), lives(:)
    type(link_type), pointer :: links(:)
    double precision, allocatable :: work(:)
    integer :: i, first, stat

    lost = 0
    status = gapbeam_no_memory
    allocate (work(np), stat=stat)
    if (stat /= 0) return
    status = gapbeam_solved
    call c_f_pointer(c_loc(piece), pieces, [np])
    call c_f_pointer(c_loc(dead), deads, [np])
    call c_f_pointer(c_loc(live), lives, [np])
    call c_f_pointer(c_loc(link), links, [nl])
    first = 1
    do i = 1, nl
        call condense_link(pieces(first:last(i)), deads(first:last(i)), lives(first:last(i)), work, links(i))
        first = last(i) + 1
    end do
    lost = first_lost_link(pieces, links, last)
end subroutine gbcond

! Find the working scheme at one load factor and solve it
subroutine gbsolv(np, nl, ns, piece, dead, live, last, link, kind, compli, force, couple, snode, sside, sstiff, scont, &
                  factor, rule, closed, undec, w, ml, mr, shear, react, motion, solves, method, indiff, back, status, message)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_link, only: link_type
    use gapbeam_model, only: beam_type, new_beam
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_scheme, only: outcome_type
    use gapbeam_referee, only: decide_scheme, detail_type
    implicit none
    ! NP pieces, NL links, NL + 1 nodes, NS supports
    integer, intent(in) :: np, nl, ns
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), link(21, nl)
    integer, intent(in), target :: last(nl)
    ! Nodes: 0 plain, 1 hinge, 2 rotational restraint of compliance COMPLI (0: clamp)
    integer, intent(in) :: kind(0:nl)
    double precision, intent(in) :: compli(0:nl)
    ! Nodal forces (down) and couples (clockwise), dead and live
    double precision, intent(in) :: force(2, 0:nl), couple(2, 0:nl)
    ! Supports: node, side (1 below, -1 above, 0 both), stiffness (infinite: rigid), deflection of first contact
    integer, intent(in) :: snode(ns), sside(ns)
    double precision, intent(in) :: sstiff(ns), scont(ns)
    ! Factor of the live loads; rule 0 block, 1 single, 2 CLOSED is known to be the working scheme (as along a path)
    double precision, intent(in) :: factor
    integer, intent(in) :: rule
    ! Scheme: 1 closed, 0 open; start in, working scheme out
    integer, intent(inout) :: closed(ns)
    ! 1 where the reaction or the opening is zero, so that the support may be closed or open
    integer, intent(out) :: undec(ns)
    ! Deflections, moments left and right of the nodes, shears of the links beside those of the simple bar, reactions (up)
    double precision, intent(out) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns)
    ! Free motion where there is no equilibrium
    double precision, intent(out) :: motion(0:nl)
    ! Linear solves; system solved last: 0 mixed, 1 three-moment, 2 with pivoting; 1 where the beam can move freely
    ! without work of the loads (the forces are unique, the position is not); 1 where the rule single came back to a scheme
    integer, intent(out) :: solves, method, indiff, back, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    !f2py integer, intent(hide), depend(snode) :: ns = shape(snode, 0)
    type(link_type), pointer :: links(:)
    type(detail_type) :: detail
    type(beam_type) :: beam
    type(workspace_type) :: work
    type(outcome_type) :: outcome
    type(error_type), allocatable :: error
    logical, allocatable :: acting(:)

    w = 0.0d0
    ml = 0.0d0
    mr = 0.0d0
    shear = 0.0d0
    react = 0.0d0
    motion = 0.0d0
    undec = 0
    indiff = 0
    solves = 0
    method = 0
    back = 0
    message = " "
    status = gapbeam_no_memory
    if (.not. enough_memory(for_solving, nl, ns, np)) return
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(piece), detail%pieces, [np])
    call c_f_pointer(c_loc(dead), detail%dead, [np])
    call c_f_pointer(c_loc(live), detail%live, [np])
    detail%last => last
    call new_beam(links, kind, compli, force, couple, snode, sside, sstiff, scont, beam)
    call new_workspace(beam, work)
    call set_loads(beam, factor, work)
    allocate (acting(ns))
    acting(:) = closed /= 0
    call decide_scheme(beam, detail, factor, rule, acting, work, outcome, error)
    solves = work%solves
    method = work%method
    back = merge(1, 0, work%came_back)
    if (allocated(error)) then
        status = error%code
        message = error%message
        return
    end if
    status = outcome%status
    if (allocated(outcome%motion)) motion = outcome%motion
    if (status /= gapbeam_solved) return
    closed = merge(1, 0, acting)
    indiff = merge(1, 0, outcome%indifferent)
    undec = merge(1, 0, outcome%undecided)
    w = work%answers%deflection
    ml = work%answers%moment_left
    mr = work%answers%moment_right
    shear = work%shear
    react = work%reaction
end subroutine gbsolv

! Residuals, and bounds for the errors, of a state that GBSOLV found
subroutine gbcert(np, nl, ns, piece, dead, live, last, link, kind, compli, force, couple, snode, sside, sstiff, scont, &
                  factor, closed, w, ml, mr, react, start, resid, bound, known, status, message)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_element, only: field_type
    use gapbeam_link, only: link_type
    use gapbeam_model, only: beam_type, new_beam
    use gapbeam_referee, only: detail_type
    use gapbeam_certificate, only: certify, certificate_type
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_certifying
    implicit none
    ! As for GBSOLV, START by GBRECO
    integer, intent(in) :: np, nl, ns
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), link(21, nl)
    integer, intent(in), target :: last(nl)
    integer, intent(in) :: kind(0:nl)
    double precision, intent(in) :: compli(0:nl)
    double precision, intent(in) :: force(2, 0:nl), couple(2, 0:nl)
    integer, intent(in) :: snode(ns), sside(ns)
    double precision, intent(in) :: sstiff(ns), scont(ns)
    double precision, intent(in) :: factor
    integer, intent(in) :: closed(ns)
    double precision, intent(in) :: w(0:nl), ml(0:nl), mr(0:nl), react(ns)
    double precision, intent(in), target :: start(4, np)
    ! Relative residuals of compatibility, equilibrium, complementarity
    double precision, intent(out) :: resid(3)
    ! Largest errors of deflections of the nodes, of reactions; of deflections, rotations, moments, shears along the beam; 1, or 0
    ! where the position is free: deflections and rotations have none then
    double precision, intent(out) :: bound(6)
    integer, intent(out) :: known, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    !f2py integer, intent(hide), depend(snode) :: ns = shape(snode, 0)
    type(link_type), pointer :: links(:)
    type(field_type), pointer :: starts(:)
    type(detail_type) :: detail
    type(beam_type) :: beam
    type(certificate_type) :: found
    type(error_type), allocatable :: error
    logical, allocatable :: acting(:)

    resid = 0.0d0
    bound = 0.0d0
    known = 0
    message = " "
    status = gapbeam_no_memory
    if (.not. enough_memory(for_certifying, nl, ns, np)) return
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(start), starts, [np])
    call c_f_pointer(c_loc(piece), detail%pieces, [np])
    call c_f_pointer(c_loc(dead), detail%dead, [np])
    call c_f_pointer(c_loc(live), detail%live, [np])
    detail%last => last
    call new_beam(links, kind, compli, force, couple, snode, sside, sstiff, scont, beam)
    allocate (acting(ns))
    acting(:) = closed /= 0
    call certify(beam, detail, factor, acting, w, ml, mr, react, starts, found, error)
    resid = [found%compatibility, found%equilibrium, found%complementarity]
    bound = [found%of_nodes, found%reaction, found%deflection, found%rotation, found%moment, found%shear]
    known = merge(1, 0, found%known)
    status = gapbeam_solved
    if (allocated(error)) then
        status = error%code
        message = error%message
    end if
end subroutine gbcert

! Follow the load from one factor to another, from event to event
subroutine gbpath(np, nl, ns, most, piece, dead, live, last, link, kind, compli, force, couple, snode, sside, sstiff, scont, &
                  limit, factor, closed, margin, events, at, which, what, motion, solves, nodes, status, message)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: error_type, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_following
    use gapbeam_link, only: link_type
    use gapbeam_model, only: beam_type, new_beam
    use gapbeam_scheme, only: outcome_type
    use gapbeam_referee, only: detail_type
    use gapbeam_path, only: follow_load, path_type
    implicit none
    ! As for GBSOLV; it stops after about MOST events, to be called again
    integer, intent(in) :: np, nl, ns, most
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), link(21, nl)
    integer, intent(in), target :: last(nl)
    integer, intent(in) :: kind(0:nl)
    double precision, intent(in) :: compli(0:nl)
    double precision, intent(in) :: force(2, 0:nl), couple(2, 0:nl)
    integer, intent(in) :: snode(ns), sside(ns)
    double precision, intent(in) :: sstiff(ns), scont(ns)
    ! Load factor to go to
    double precision, intent(in) :: limit
    ! Load factor of the state at hand in; how far it went out, or above which there is no equilibrium
    double precision, intent(inout) :: factor
    ! Scheme at FACTOR and supports at zero there
    integer, intent(inout) :: closed(ns), margin(ns)
    ! EVENTS events: load factors, supports (from 1), and what happens: 0 opens, 1 closes, 3 the beam turns until this one holds
    integer, intent(out) :: events
    double precision, intent(out) :: at(most + 6*ns + 8)
    integer, intent(out) :: which(most + 6*ns + 8), what(most + 6*ns + 8)
    ! Motion that begins where there is no equilibrium above FACTOR
    double precision, intent(out) :: motion(0:nl)
    ! Linear solves of the whole beam; nodes at which the solution was made anew besides
    integer, intent(out) :: solves, nodes, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    !f2py integer, intent(hide), depend(snode) :: ns = shape(snode, 0)
    type(link_type), pointer :: links(:)
    type(detail_type) :: detail
    type(beam_type) :: beam
    type(path_type) :: path
    type(outcome_type) :: outcome
    type(error_type), allocatable :: error
    logical, allocatable :: acting(:), zero(:)

    events = 0
    at = 0.0d0
    which = 0
    what = 0
    motion = 0.0d0
    message = " "
    solves = 0
    nodes = 0
    status = gapbeam_no_memory
    if (.not. enough_memory(for_following, nl, ns, np)) return
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(piece), detail%pieces, [np])
    call c_f_pointer(c_loc(dead), detail%dead, [np])
    call c_f_pointer(c_loc(live), detail%live, [np])
    detail%last => last
    call new_beam(links, kind, compli, force, couple, snode, sside, sstiff, scont, beam)
    allocate (acting(ns), zero(ns))
    acting(:) = closed /= 0
    zero(:) = margin /= 0
    call follow_load(beam, detail, limit, most, factor, acting, zero, path, outcome, error)
    closed = merge(1, 0, acting)
    margin = merge(1, 0, zero)
    events = path%count
    at(:events) = path%factor(:events)
    which(:events) = path%support(:events)
    what(:events) = path%event(:events)
    solves = path%solves
    nodes = path%nodes
    status = outcome%status
    if (allocated(outcome%motion)) motion = outcome%motion
    if (allocated(error)) then
        status = error%code
        message = error%message
    end if
end subroutine gbpath

! What each load does to the links, for GBCASE: rows of loads on pieces, sorted by load, then piece (both from 1)
subroutine gbshar(np, nl, nr, piece, link, last, rload, rpiece, rvalue, nshare, sload, slink, share, status)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_fields
    use gapbeam_link, only: link_type, piece_type, load_type
    use gapbeam_cases, only: share_type, condense_shares
    implicit none
    integer, intent(in) :: np, nl, nr
    double precision, intent(in), target :: piece(3, np), link(21, nl)
    integer, intent(in) :: last(nl)
    integer, intent(in) :: rload(nr), rpiece(nr)
    double precision, intent(in), target :: rvalue(5, nr)
    ! NSHARE shares: load, link, values
    integer, intent(out) :: nshare, sload(nr), slink(nr)
    double precision, intent(out), target :: share(6, nr)
    integer, intent(out) :: status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    !f2py integer, intent(hide), depend(rload) :: nr = shape(rload, 0)
    type(piece_type), pointer :: pieces(:)
    type(link_type), pointer :: links(:)
    type(load_type), pointer :: values(:)
    type(share_type), pointer :: shares(:)

    nshare = 0
    status = gapbeam_no_memory
    if (.not. enough_memory(for_fields, nl, 0, np)) return
    status = gapbeam_solved
    call c_f_pointer(c_loc(piece), pieces, [np])
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(rvalue), values, [nr])
    call c_f_pointer(c_loc(share), shares, [nr])
    call condense_shares(pieces, links, last, rload, rpiece, values, nshare, sload, slink, shares)
end subroutine gbshar

! Solve NC cases of loads; every load counts with its factor
subroutine gbcase(nl, ns, nd, nsh, nno, nc, link, kind, compli, snode, sside, sstiff, scont, &
                  sload, slink, share, pload, pnode, pshare, factor, rule, closed, &
                  w, ml, mr, shear, react, solves, status)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use gapbeam_link, only: link_type
    use gapbeam_model, only: beam_type, new_beam
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_cases, only: share_type, node_share_type, solve_case
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_solving
    implicit none
    ! As for GBSOLV; ND loads, NSH shares of links, NNO shares of nodes, NC cases
    integer, intent(in) :: nl, ns, nd, nsh, nno, nc
    double precision, intent(in), target :: link(21, nl)
    integer, intent(in) :: kind(0:nl)
    double precision, intent(in) :: compli(0:nl)
    integer, intent(in) :: snode(ns), sside(ns)
    double precision, intent(in) :: sstiff(ns), scont(ns)
    ! Shares by GBSHAR; forces and couples at nodes (load from 1, node from 0, values)
    integer, intent(in) :: sload(nsh), slink(nsh)
    double precision, intent(in), target :: share(6, nsh)
    integer, intent(in) :: pload(nno), pnode(nno)
    double precision, intent(in), target :: pshare(2, nno)
    ! Factor of every load in every case
    double precision, intent(in) :: factor(nd, nc)
    integer, intent(in) :: rule
    ! Schemes: start in, working scheme out; of a case that is not solved all open, and its results are not numbers
    integer, intent(inout) :: closed(ns, nc)
    double precision, intent(out) :: w(0:nl, nc), ml(0:nl, nc), mr(0:nl, nc), shear(nl, nc), react(ns, nc)
    ! Where memory ends all STATUS say so
    integer, intent(out) :: solves(nc), status(nc)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    !f2py integer, intent(hide), depend(snode) :: ns = shape(snode, 0)
    !f2py integer, intent(hide), depend(sload) :: nsh = shape(sload, 0)
    !f2py integer, intent(hide), depend(pload) :: nno = shape(pload, 0)
    !f2py integer, intent(hide), depend(factor) :: nd = shape(factor, 0)
    !f2py integer, intent(hide), depend(factor) :: nc = shape(factor, 1)
    type(link_type), pointer :: links(:)
    type(share_type), pointer :: shares(:)
    type(node_share_type), pointer :: node_shares(:)
    type(beam_type) :: beam
    type(workspace_type) :: work
    logical, allocatable :: acting(:)
    double precision, allocatable :: none(:, :)
    double precision :: nan
    integer :: i

    solves = 0
    status = gapbeam_no_memory
    if (.not. enough_memory(for_solving, nl, ns, 0)) return
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(share), shares, [nsh])
    call c_f_pointer(c_loc(pshare), node_shares, [nno])
    allocate (acting(ns), none(2, 0:nl))
    none(:, :) = 0.0d0
    call new_beam(links, kind, compli, none, none, snode, sside, sstiff, scont, beam)
    call new_workspace(beam, work)
    nan = ieee_value(nan, ieee_quiet_nan)
    w = nan
    ml = nan
    mr = nan
    shear = nan
    react = nan
    do i = 1, nc
        acting(:) = closed(:, i) /= 0
        call solve_case(factor(:, i), sload, slink, shares, pload, pnode, node_shares, rule, beam, acting, work, status(i))
        if (status(i) == gapbeam_no_memory) then
            status = gapbeam_no_memory
            return
        end if
        solves(i) = work%solves
        closed(:, i) = 0
        if (status(i) /= gapbeam_solved) cycle
        closed(:, i) = merge(1, 0, acting)
        w(:, i) = work%answers%deflection
        ml(:, i) = work%answers%moment_left
        mr(:, i) = work%answers%moment_right
        shear(:, i) = work%shear
        react(:, i) = work%reaction
    end do
end subroutine gbcase

! Fields at the left end of every piece
subroutine gbreco(np, nl, piece, dead, live, factor, link, last, kind, w, ml, mr, shear, start, status)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_fields
    use gapbeam_element, only: field_type
    use gapbeam_link, only: link_type, piece_type, load_type
    use gapbeam_recover, only: recover_beam
    implicit none
    integer, intent(in) :: np, nl
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), link(21, nl)
    double precision, intent(in) :: factor
    integer, intent(in) :: last(nl), kind(0:nl)
    double precision, intent(in) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl)
    ! Deflection, rotation, moment, shear just right of the left end of each piece
    double precision, intent(out), target :: start(4, np)
    integer, intent(out) :: status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(link) :: nl = shape(link, 1)
    type(piece_type), pointer :: pieces(:)
    type(load_type), pointer :: deads(:), lives(:)
    type(link_type), pointer :: links(:)
    type(field_type), pointer :: starts(:)

    status = gapbeam_no_memory
    if (.not. enough_memory(for_fields, nl, 0, np)) return
    status = gapbeam_solved
    call c_f_pointer(c_loc(piece), pieces, [np])
    call c_f_pointer(c_loc(dead), deads, [np])
    call c_f_pointer(c_loc(live), lives, [np])
    call c_f_pointer(c_loc(link), links, [nl])
    call c_f_pointer(c_loc(start), starts, [np])
    call recover_beam(pieces, deads, lives, factor, links, last, kind, w, ml, mr, shear, starts)
end subroutine gbreco

! Fields at NX places, each a piece (from 1) and the distance from its left end
subroutine gbvalu(np, nx, piece, dead, live, factor, start, where, dist, value)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, load_type
    use gapbeam_fields, only: values_at
    implicit none
    integer, intent(in) :: np, nx
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), start(4, np)
    double precision, intent(in) :: factor
    integer, intent(in) :: where(nx)
    double precision, intent(in) :: dist(nx)
    double precision, intent(out), target :: value(4, nx)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    !f2py integer, intent(hide), depend(where) :: nx = shape(where, 0)
    type(piece_type), pointer :: pieces(:)
    type(load_type), pointer :: deads(:), lives(:)
    type(field_type), pointer :: starts(:), fields(:)

    call c_f_pointer(c_loc(piece), pieces, [np])
    call c_f_pointer(c_loc(dead), deads, [np])
    call c_f_pointer(c_loc(live), lives, [np])
    call c_f_pointer(c_loc(start), starts, [np])
    call c_f_pointer(c_loc(value), fields, [nx])
    call values_at(pieces, deads, lives, factor, starts, where, dist, fields)
end subroutine gbvalu

! Maximum and minimum of deflection, rotation, moment, shear, with piece and distance from its left end
subroutine gbextr(np, piece, dead, live, factor, start, value, where, dist)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, load_type
    use gapbeam_fields, only: find_extremes
    implicit none
    integer, intent(in) :: np
    double precision, intent(in), target :: piece(3, np), dead(5, np), live(5, np), start(4, np)
    double precision, intent(in) :: factor
    double precision, intent(out) :: value(2, 4), dist(2, 4)
    integer, intent(out) :: where(2, 4)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(piece) :: np = shape(piece, 1)
    type(piece_type), pointer :: pieces(:)
    type(load_type), pointer :: deads(:), lives(:)
    type(field_type), pointer :: starts(:)

    call c_f_pointer(c_loc(piece), pieces, [np])
    call c_f_pointer(c_loc(dead), deads, [np])
    call c_f_pointer(c_loc(live), lives, [np])
    call c_f_pointer(c_loc(start), starts, [np])
    call find_extremes(pieces, deads, lives, factor, starts, value, where, dist)
end subroutine gbextr

! The axial system: N bars between points 0..N
subroutine gbaxia(n, flex, force, stiff, settle, u, pull, react, state, place)
    use gapbeam_error, only: gapbeam_no_memory
    use gapbeam_memory, only: enough_memory, for_fields
    use gapbeam_axial, only: solve_axial
    implicit none
    integer, intent(in) :: n
    ! Length/EA of each bar; force (to the right), support stiffness (0 none, infinite rigid) and settlement of each point
    double precision, intent(in) :: flex(n), force(0:n), stiff(0:n), settle(0:n)
    ! Displacement of each point, normal force of each bar (tension), force of each support on the beam
    double precision, intent(out) :: u(0:n), pull(n), react(0:n)
    ! 0 solved, 1 slides, 2 rigid between two rigid supports, at point PLACE; or GAPBEAM_NO_MEMORY
    integer, intent(out) :: state, place
    !f2py threadsafe
    !f2py integer, intent(hide), depend(flex) :: n = shape(flex, 0)

    u = 0.0d0
    pull = 0.0d0
    react = 0.0d0
    place = 0
    state = gapbeam_no_memory
    if (.not. enough_memory(for_fields, 0, 0, n)) return
    call solve_axial(flex, force, stiff, settle, u, pull, react, state, place)
end subroutine gbaxia

! Deflections and moments of a beam of N elements over two-sided supports, REPEAT times (for measuring)
subroutine gbkern(n, length, ei, q, stiff, force, refine, repeat, w, m, status)
    use gapbeam_error, only: gapbeam_no_memory
    use gapbeam_kernel, only: eliminated_type, last_step
    use gapbeam_elements, only: solve_elements, refine_elements, elements_solved
    implicit none
    integer, intent(in) :: n
    double precision, intent(in) :: length(n), ei(n), q(n)
    ! At the nodes: stiffness of the supports (infinite: rigid), forces down
    double precision, intent(in) :: stiff(0:n), force(0:n)
    ! Steps of refinement
    integer, intent(in) :: refine, repeat
    double precision, intent(out) :: w(0:n), m(0:n)
    ! 0 solved, 1 an end without support, 2 a length or EI that is not positive; or GAPBEAM_NO_MEMORY
    integer, intent(out) :: status
    !f2py threadsafe
    !f2py integer, intent(hide), depend(length) :: n = shape(length, 0)
    type(eliminated_type), allocatable :: eliminated(:)
    double precision, allocatable :: correction(:, :)
    integer :: k, step, stat

    w = 0.0d0
    m = 0.0d0
    status = gapbeam_no_memory
    allocate (eliminated(0:last_step(n)), correction(0:n, 2), stat=stat)
    if (stat /= 0) return
    do k = 1, repeat
        call solve_elements(length, ei, q, stiff, force, eliminated, w, m, status)
        if (status /= elements_solved) return
        do step = 1, refine
            call refine_elements(length, ei, q, stiff, force, eliminated, correction, w, m)
        end do
    end do
end subroutine gbkern
