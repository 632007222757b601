! The library for Python: plain arrays only, in the manner of Fortran 77. f2py reads this very file, so it holds only default
! kinds, explicit shapes and external subroutines, and nothing but marshalling. It is no part of the library for everyone else,
! whose Fortran 77 interface (face/fortran77.f90) has its own GBSOLV and GBCERT.
!
! BEAM is the handle of a prepared beam (gapbeam_handle): NP pieces, NL links between nodes 0 to NL, NS supports of the engine,
! NM supports of the scene, NB axial bars. Arrays over supports and bars have one entry more than there are: f2py takes none
! that is empty. Units are the engine's where nothing else is said. STATUS as in gapbeam_error: 0 solved, 1 no equilibrium, above
! 10 an error with its MESSAGE and nothing else set.

! Prepare a beam
subroutine gbmake(mspan, mhinge, msect, msup, mlaw, mload, mfound, mprof, mflaw, span, hinge, sect, isup, sup, ilaw, alaw, &
                  iload, aload, ifound, found, iprof, aprof, iflaw, aflaw, &
                  beam, status, reason, table, entry, partner, key, message)
    use gapbeam_error, only: error_type
    use gapbeam_scene, only: model_type
    use gapbeam_arrays, only: model_from_arrays, foundations_from_arrays
    use gapbeam_handle, only: new_handle, report
    implicit none
    ! One more than there are
    integer, intent(in) :: mspan, mhinge, msect, msup, mlaw, mload, mfound, mprof, mflaw
    ! As for model_from_arrays, in the scene's units
    double precision, intent(in) :: span(4, mspan), hinge(mhinge), sect(5, msect), sup(5, msup), alaw(2, mlaw), aload(4, mload)
    integer, intent(in) :: isup(4, msup), ilaw(mlaw), iload(3, mload)
    ! As for foundations_from_arrays
    integer, intent(in) :: ifound(mfound), iprof(mprof), iflaw(mflaw)
    double precision, intent(in) :: found(13, mfound), aprof(2, mprof), aflaw(2, mflaw)
    ! The handle; 0 where it is refused
    integer(8), intent(out) :: beam
    ! Why: as in gapbeam_error and gapbeam_refusal; entries count from 1
    integer, intent(out) :: status, reason, table, entry, partner
    character(len=16), intent(out) :: key
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(span) :: mspan = shape(span, 1)
    !f2py integer, intent(hide), depend(hinge) :: mhinge = shape(hinge, 0)
    !f2py integer, intent(hide), depend(sect) :: msect = shape(sect, 1)
    !f2py integer, intent(hide), depend(sup) :: msup = shape(sup, 1)
    !f2py integer, intent(hide), depend(ilaw) :: mlaw = shape(ilaw, 0)
    !f2py integer, intent(hide), depend(aload) :: mload = shape(aload, 1)
    !f2py integer, intent(hide), depend(ifound) :: mfound = shape(ifound, 0)
    !f2py integer, intent(hide), depend(iprof) :: mprof = shape(iprof, 0)
    !f2py integer, intent(hide), depend(iflaw) :: mflaw = shape(iflaw, 0)
    type(model_type) :: model
    type(error_type), allocatable :: error

    beam = 0
    reason = 0
    table = 0
    entry = 0
    partner = 0
    key = " "
    call model_from_arrays(span(:, :mspan - 1), hinge(:mhinge - 1), sect(:, :msect - 1), isup(:, :msup - 1), sup(:, :msup - 1), &
                           ilaw(:mlaw - 1), alaw(:, :mlaw - 1), iload(:, :mload - 1), aload(:, :mload - 1), model, error)
    if (.not. allocated(error)) call foundations_from_arrays(ifound(:mfound - 1), found(:, :mfound - 1), iprof(:mprof - 1), &
                                                             aprof(:, :mprof - 1), iflaw(:mflaw - 1), aflaw(:, :mflaw - 1), &
                                                             model, error)
    if (.not. allocated(error)) call new_handle(model, beam, error)
    call report(error, status, message)
    if (.not. allocated(error)) return
    reason = error%reason
    table = error%table
    entry = error%entry
    partner = error%partner
    key = error%key
end subroutine gbmake

! Free a beam
subroutine gbdrop(beam)
    use gapbeam_handle, only: drop_handle
    implicit none
    integer(8), intent(in) :: beam

    call drop_handle(beam)
end subroutine gbdrop

! Another beam: the loads of a case, all live, each times its factor, and nothing dead
subroutine gbcopy(beam, nd, factor, copy, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, copy_handle, drop_handle, report
    use gapbeam_cases, only: take_case
    implicit none
    integer(8), intent(in) :: beam
    ! One more than there are loads
    integer, intent(in) :: nd
    double precision, intent(in) :: factor(nd)
    integer(8), intent(out) :: copy
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(factor) :: nd = shape(factor, 0)
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    call copy_handle(beam, copy, error)
    if (.not. allocated(error)) then
        handle => handle_of(copy)
        call take_case(factor(:nd - 1), handle%lowered, error)
        if (allocated(error)) call drop_handle(copy)
    end if
    call report(error, status, message)
    if (allocated(error)) copy = 0
end subroutine gbcopy

! Sizes of a beam, and its units
subroutine gbsize(beam, sizes, units)
    use gapbeam_handle, only: handle_type, handle_of
    implicit none
    integer(8), intent(in) :: beam
    ! NP, NL, NS, NM, NB (-1 without an axial system), and whether there are hinges, rotational restraints, shear
    ! flexibility, one-sided supports that can carry, laws, laws on whose path the state depends; layers of ground
    integer, intent(out) :: sizes(12)
    ! Exponents of two: length, force, deflection
    integer, intent(out) :: units(3)
    type(handle_type), pointer :: handle

    handle => handle_of(beam)
    associate (lowered => handle%lowered)
        sizes = [size(lowered%pieces), size(lowered%beam%links), size(lowered%beam%supports), size(lowered%model%supports), -1, &
                 size(lowered%model%hinges), merge(1, 0, any(lowered%turning > 0.0d0)), &
                 merge(1, 0, any(lowered%pieces%shear_flexibility > 0.0d0)), merge(1, 0, any(lowered%beam%supports%side /= 0)), &
                 merge(1, 0, size(lowered%model%law) > 0), merge(1, 0, lowered%depends_on_path), &
                 0]
        if (allocated(lowered%layers)) sizes(12) = size(lowered%layers)
        units = [lowered%units%length, lowered%units%force, lowered%units%deflection]
        if (allocated(lowered%axial%point)) sizes(5) = ubound(lowered%axial%point, 1)
    end associate
end subroutine gbsize

! Which supports of the scene those of the engine are
subroutine gbnumb(beam, ns, number, laws)
    use gapbeam_handle, only: handle_type, handle_of
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ns
    ! Number in the scene, from 0; of a law once for every kink
    integer, intent(out) :: number(ns + 1)
    ! Contact level, force, slope and slope before of every support
    double precision, intent(out) :: laws(4, ns + 1)
    type(handle_type), pointer :: handle

    handle => handle_of(beam)
    number = 0
    laws = 0.0d0
    number(:ns) = handle%lowered%normal - 1
    associate (s => handle%lowered%beam%supports)
        laws(1, :ns) = s%contact
        laws(2, :ns) = s%force
        laws(3, :ns) = s%stiffness
        laws(4, :ns) = s%before
    end associate
end subroutine gbnumb

! What there is along a beam, in the scene's units
subroutine gbplac(beam, np, nl, ns, nm, xend, xpoint, ispan, piece, dead, live, npoint, kind, turn, force, couple, &
                  snode, level)
    use gapbeam_handle, only: handle_type, handle_of
    use gapbeam_units, only: rotation_unit, moment_unit
    use gapbeam_lowered, only: point_x, piece_length, stiffness_of, in_bending, in_shear
    use gapbeam_lower_supports, only: contact_level
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np, nl, ns, nm
    ! The beam's right end; places of the points between pieces, and span of every piece, from 0
    double precision, intent(out) :: xend, xpoint(0:np)
    integer, intent(out) :: ispan(np)
    ! Length, EI, GA of the pieces, and loads on them: per length at both ends, imposed curvature, force and couple at the right
    ! end unless a node is there
    double precision, intent(out) :: piece(3, np), dead(5, np), live(5, np)
    ! Points that are nodes; 0 plain, 1 hinge, 2 rotational restraint of stiffness TURN; dead and live forces and couples
    integer, intent(out) :: npoint(0:nl), kind(0:nl)
    double precision, intent(out) :: turn(0:nl), force(2, 0:nl), couple(2, 0:nl)
    ! Node of the supports of the engine
    integer, intent(out) :: snode(ns + 1)
    ! Deflection at which a support of the scene begins to act; 0 for axial ones
    double precision, intent(out) :: level(nm + 1)
    !f2py threadsafe
    type(handle_type), pointer :: handle
    integer :: j, k

    handle => handle_of(beam)
    associate (lowered => handle%lowered, units => handle%lowered%units)
        xend = lowered%ends(ubound(lowered%ends, 1))
        do j = 0, np
            xpoint(j) = point_x(lowered, j)
        end do
        ispan = lowered%point_span(:np - 1)
        do j = 1, np
            piece(:, j) = [piece_length(lowered, j), stiffness_of(lowered, j, in_bending), stiffness_of(lowered, j, in_shear)]
            associate (a => lowered%dead(j), b => lowered%live(j), q => units%force - units%length, &
                       bent => rotation_unit(units) - units%length)
                dead(:, j) = scale([a%qa, a%qb, a%kappa, a%force, a%couple], [q, q, bent, units%force, moment_unit(units)])
                live(:, j) = scale([b%qa, b%qb, b%kappa, b%force, b%couple], [q, q, bent, units%force, moment_unit(units)])
            end associate
        end do
        npoint = lowered%node_point
        kind = lowered%beam%kind
        turn = lowered%turning
        force = scale(lowered%beam%force, units%force)
        couple = scale(lowered%beam%couple, moment_unit(units))
        snode = 0
        snode(:ns) = lowered%beam%supports%node
        level = 0.0d0
        do k = 1, nm
            if (lowered%model%supports(k)%direction /= 0) cycle
            level(k) = contact_level(lowered%model%supports(k))
        end do
    end associate
end subroutine gbplac

! Find the working scheme at one load factor and solve it
subroutine gbsolv(beam, nl, ns, nm, nb, factor, rule, closed, undec, w, ml, mr, shear, react, motion, u, pull, &
                  values, counts, ground, status, message)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of, report, keep_ground
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_query, only: support_values
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns, nm, nb
    ! Factor of the live loads; rule 0 block, 1 single, 2 CLOSED is known to be the working scheme (as along a path)
    double precision, intent(in) :: factor
    integer, intent(in) :: rule
    ! Scheme: 1 closed, 0 open; start in, working scheme out
    integer, intent(inout) :: closed(ns + 1)
    ! 1 where the reaction or the opening is zero, so that the support may be closed or open
    integer, intent(out) :: undec(ns + 1)
    ! Deflections, moments left and right of the nodes, shears of the links beside those of the simple bar, reactions (up)
    double precision, intent(out) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns + 1)
    ! Free motion where there is no equilibrium
    double precision, intent(out) :: motion(0:nl)
    ! Displacements of the axial system's points and forces in its bars
    double precision, intent(out) :: u(0:nb), pull(nb + 1)
    ! Of the scene's supports in its units: reaction, deflection, opening, couple
    double precision, intent(out) :: values(nm + 1, 4)
    ! Linear solves; system solved last: 0 mixed, 1 three-moment, 2 with pivoting; 1 where the beam can move freely
    ! without work of the loads; 1 where the rule single came back to a scheme; 1 where the beam slides along its axis;
    ! stretches on the ground, and most layers under one of them
    integer, intent(out) :: counts(7), status
    ! What GBGGET takes, once; 0 without ground
    integer(8), intent(out) :: ground
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    type(handle_type), pointer :: handle
    type(state_type) :: state
    type(error_type), allocatable :: error
    integer, allocatable :: conditions(:)

    handle => handle_of(beam)
    undec = 0
    w = 0.0d0
    ml = 0.0d0
    mr = 0.0d0
    shear = 0.0d0
    react = 0.0d0
    motion = 0.0d0
    u = 0.0d0
    pull = 0.0d0
    values = 0.0d0
    counts = 0
    ground = 0
    call new_state(handle%lowered, state, error)
    if (.not. allocated(error)) then
        state%closed(:) = closed(:ns) /= 0
        call solve_state(handle%lowered, factor, rule, state, error)
    end if
    call report(error, status, message)
    if (allocated(error)) return
    status = state%status
    counts(:5) = [state%solves, state%method, merge(1, 0, state%indifferent), merge(1, 0, state%came_back), &
                  merge(1, 0, state%slides)]
    motion = state%motion
    if (status /= gapbeam_solved) return
    closed(:ns) = merge(1, 0, state%closed)
    undec(:ns) = merge(1, 0, state%undecided)
    w = state%deflection
    ml = state%moment_left
    mr = state%moment_right
    shear = state%shear
    react(:ns) = state%reaction
    u = state%displacement
    pull(:nb) = state%tension
    allocate (conditions(nm))
    call support_values(handle%lowered, state, values(:nm, 1), values(:nm, 2), values(:nm, 3), values(:nm, 4), conditions)
    if (.not. allocated(state%ground)) return
    counts(6:7) = shape(transpose(state%ground%acts))
    call keep_ground(state%ground, ground)
end subroutine gbsolv

! Take a solution on the ground, which is freed with that
subroutine gbgget(ground, ng, ny, values, bounds, resid)
    use gapbeam_handle, only: take_ground, pack_ground
    use gapbeam_ground_solver, only: ground_solution_type
    implicit none
    ! From GBSOLV; stretches, and most layers
    integer(8), intent(in) :: ground
    integer, intent(in) :: ng, ny
    ! As for pack_ground, in the engine's units
    double precision, intent(out) :: values(19 + 2*ny, ng)
    ! Bounds of the errors of deflection, rotation, moment, shear and reactions; residuals of compatibility and equilibrium
    double precision, intent(out) :: bounds(5), resid(2)
    type(ground_solution_type), allocatable :: solution

    call take_ground(ground, solution)
    call pack_ground(solution, values)
    bounds = solution%bounds
    resid = solution%residuals
end subroutine gbgget

! Fields on the ground at distances from the left ends of pieces (from 1), in the scene's units
subroutine gbgval(beam, ng, nr, nb, nx, ground, u, pull, piece, dist, value, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_element, only: field_type
    use gapbeam_handle, only: handle_type, handle_of, report, unpack_ground
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_pressure, only: pressure_in_pieces
    use gapbeam_query, only: fields_in_pieces
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ng, nr, nb, nx
    ! From GBGGET and GBSOLV
    double precision, intent(in) :: ground(nr, ng), u(0:nb), pull(nb + 1)
    integer, intent(in) :: piece(nx)
    double precision, intent(in) :: dist(nx)
    ! Deflection, rotation, moment, shear, axial force, axial displacement, pressure of the ground (up)
    double precision, intent(out) :: value(7, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(ground) :: nr = shape(ground, 0), ng = shape(ground, 1)
    !f2py integer, intent(hide), depend(u) :: nb = shape(u, 0) - 1
    !f2py integer, intent(hide), depend(piece) :: nx = shape(piece, 0)
    type(handle_type), pointer :: handle
    type(field_type) :: none(0)
    type(ground_solution_type) :: solution
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    value = 0.0d0
    call unpack_ground(handle%lowered, ground, solution)
    call fields_in_pieces(handle%lowered, 0.0d0, none, u, pull(:nb), piece, dist, value(:6, :), error, solution)
    if (.not. allocated(error)) call pressure_in_pieces(handle%lowered, solution, piece, dist, value(7, :), error)
    call report(error, status, message)
end subroutine gbgval

! Stretches beside each other in which a layer does the same joined: by foundation, below before above, from left to right
subroutine gbgrun(beam, ng, nr, ground, number, about, values, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, report, unpack_ground
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_zones, only: run_type, ground_runs
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ng, nr
    double precision, intent(in) :: ground(nr, ng)
    ! How many there are
    integer, intent(out) :: number
    ! Foundation (from 0), side, pieces of its law (0: linear), the piece on which it acts (0: no contact), 1 if it only touches
    integer, intent(out) :: about(5, 3*(ng*(nr - 19)/2))
    ! Ends, force on the beam (up), largest distance between beam and ground, in the scene's units
    double precision, intent(out) :: values(4, 3*(ng*(nr - 19)/2))
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(ground) :: nr = shape(ground, 0), ng = shape(ground, 1)
    type(handle_type), pointer :: handle
    type(ground_solution_type) :: solution
    type(run_type), allocatable :: runs(:)
    type(error_type), allocatable :: error
    integer :: i

    handle => handle_of(beam)
    number = 0
    about = 0
    values = 0.0d0
    call unpack_ground(handle%lowered, ground, solution)
    call ground_runs(handle%lowered, solution, runs, error)
    call report(error, status, message)
    if (allocated(error)) return
    number = size(runs)
    do i = 1, number
        associate (run => runs(i))
            about(:, i) = [run%foundation - 1, run%side, run%law_pieces, run%acts, merge(1, 0, run%touches)]
            values(:, i) = [run%from, run%to, run%resultant, run%way]
        end associate
    end do
end subroutine gbgrun

! Maximum and minimum of all fields on the ground, and their places, in the scene's units; fields as for GBGVAL
subroutine gbgext(beam, ng, nr, nb, ground, u, pull, value, x, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_element, only: field_type
    use gapbeam_handle, only: handle_type, handle_of, report, unpack_ground
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_pressure, only: extremes_of_pressure
    use gapbeam_query, only: extremes_of_pieces
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ng, nr, nb
    double precision, intent(in) :: ground(nr, ng), u(0:nb), pull(nb + 1)
    double precision, intent(out) :: value(2, 7), x(2, 7)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(ground) :: nr = shape(ground, 0), ng = shape(ground, 1)
    !f2py integer, intent(hide), depend(u) :: nb = shape(u, 0) - 1
    type(handle_type), pointer :: handle
    type(field_type) :: none(0)
    type(ground_solution_type) :: solution
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    value = 0.0d0
    x = 0.0d0
    call unpack_ground(handle%lowered, ground, solution)
    call extremes_of_pieces(handle%lowered, 0.0d0, none, u, pull(:nb), value(:, :6), x(:, :6), error, solution)
    if (.not. allocated(error)) call extremes_of_pressure(handle%lowered, solution, value(:, 7), x(:, 7), error)
    call report(error, status, message)
end subroutine gbgext

! Follow the load from a factor to LIMIT, from event to event
subroutine gbpath(most, beam, nl, ns, limit, factor, closed, margin, events, at, which, what, motion, solves, nodes, status, &
                  message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, report
    use gapbeam_memory, only: for_following
    use gapbeam_scheme, only: outcome_type
    use gapbeam_referee, only: reserve_for
    use gapbeam_path, only: follow_path, path_type
    use gapbeam_state, only: detail_of, name_range
    implicit none
    ! Number of events after which it stops
    integer, intent(in) :: most
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    double precision, intent(in) :: limit
    ! Load factor of the state at hand, its scheme, and 1 for supports at zero there; how far it went out
    double precision, intent(inout) :: factor
    integer, intent(inout) :: closed(ns + 1), margin(ns + 1)
    ! Events: load factor, support (from 1), 0 opens, 1 closes, 3 turns
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
    associate (lowered => handle%lowered)
        call reserve_for(for_following, lowered%beam, detail_of(lowered), error)
        if (.not. allocated(error)) then
            allocate (acting(ns), zero(ns))
            acting(:) = closed(:ns) /= 0
            zero(:) = margin(:ns) /= 0
            call follow_path(lowered%beam, detail_of(lowered), limit, most, factor, acting, zero, path, outcome, error)
            call name_range(lowered, error)
        end if
    end associate
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
    use gapbeam_handle, only: handle_type, handle_of
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
    use gapbeam_handle, only: handle_type, handle_of
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

! Another beam: the same with the laws of its supports as they have become
subroutine gblaws(beam, ns, laws, copy, status, message)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of, copy_handle
    use gapbeam_lower_laws, only: depends_on_path
    implicit none
    integer(8), intent(in) :: beam
    ! As from GBHGET
    integer, intent(in) :: ns
    double precision, intent(in) :: laws(4, ns)
    integer(8), intent(out) :: copy
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(laws) :: ns = shape(laws, 1)
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    status = gapbeam_solved
    message = " "
    call copy_handle(beam, copy, error)
    if (allocated(error)) then
        status = error%code
        message = error%message
        return
    end if
    handle => handle_of(copy)
    associate (s => handle%lowered%beam%supports)
        s%contact = laws(1, :ns - 1)
        s%force = laws(2, :ns - 1)
        s%stiffness = laws(3, :ns - 1)
        s%before = laws(4, :ns - 1)
        s%passed = s%kink > 0 .and. .not. abs(s%stiffness - s%before) > 0.0d0
    end associate
    handle%lowered%depends_on_path = depends_on_path(handle%lowered)
end subroutine gblaws

! Check a solved state
subroutine gbcert(beam, nl, ns, factor, closed, w, ml, mr, shear, react, residu, bound, known, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, state_of, report
    use gapbeam_solution, only: state_type
    use gapbeam_certificate, only: certificate_type
    use gapbeam_state, only: certify_state
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    ! The state, as from GBSOLV
    double precision, intent(in) :: factor
    integer, intent(in) :: closed(ns + 1)
    double precision, intent(in) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns + 1)
    ! Relative residuals of compatibility, equilibrium and complementarity
    double precision, intent(out) :: residu(3)
    ! Largest errors of deflections of the nodes, reactions; of deflections, rotations, moments, shears along the beam
    double precision, intent(out) :: bound(6)
    ! 0 where deflections and rotations have no bound
    integer, intent(out) :: known, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    !f2py integer, intent(hide), depend(shear) :: nl = shape(shear, 0)
    type(handle_type), pointer :: handle
    type(state_type) :: state
    type(certificate_type) :: found
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    residu = 0.0d0
    bound = 0.0d0
    known = 0
    call state_of(handle%lowered, factor, closed, w, ml, mr, shear, react, state, error)
    if (.not. allocated(error)) call certify_state(handle%lowered, state, found, error)
    call report(error, status, message)
    if (allocated(error)) return
    residu = [found%compatibility, found%equilibrium, found%complementarity]
    bound = [found%of_nodes, found%reaction, found%deflection, found%rotation, found%moment, found%shear]
    known = merge(1, 0, found%known)
end subroutine gbcert

! Fields at the left end of every piece
subroutine gbreco(beam, np, nl, ns, factor, closed, w, ml, mr, shear, react, start, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, state_of, report
    use gapbeam_solution, only: state_type
    use gapbeam_query, only: make_starts
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np, nl, ns
    ! The state, as from GBSOLV
    double precision, intent(in) :: factor
    integer, intent(in) :: closed(ns + 1)
    double precision, intent(in) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns + 1)
    ! Deflection, rotation, moment, shear just right of the left end of each piece
    double precision, intent(out) :: start(4, np)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    !f2py integer, intent(hide), depend(shear) :: nl = shape(shear, 0)
    type(handle_type), pointer :: handle
    type(state_type) :: state
    type(error_type), allocatable :: error
    integer :: j

    handle => handle_of(beam)
    start = 0.0d0
    call state_of(handle%lowered, factor, closed, w, ml, mr, shear, react, state, error)
    if (.not. allocated(error)) call make_starts(handle%lowered, state, error)
    call report(error, status, message)
    if (allocated(error)) return
    do j = 1, np
        associate (s => state%starts(j))
            start(:, j) = [s%deflection, s%rotation, s%moment, s%shear]
        end associate
    end do
end subroutine gbreco

! Fields at NX places of the scene, in its units; where they jump right (LEFT = 0) or left of the place
subroutine gbfind(beam, nx, x, left, piece, dist, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_handle, only: handle_type, handle_of, report
    use gapbeam_query, only: find_pieces
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nx
    double precision, intent(in) :: x(nx)
    integer, intent(in) :: left
    ! Piece of every place, from 1, and distance from its left end, in the scene's units
    integer, intent(out) :: piece(nx)
    double precision, intent(out) :: dist(nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(x) :: nx = shape(x, 0)
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    integer, allocatable :: pieces(:)
    double precision, allocatable :: distances(:)

    handle => handle_of(beam)
    piece = 0
    dist = 0.0d0
    call find_pieces(handle%lowered, x, left /= 0, pieces, distances, error)
    call report(error, status, message)
    if (allocated(error)) return
    piece = pieces
    dist = distances
end subroutine gbfind

! Fields at distances from the left ends of pieces (from 1), in the scene's units
subroutine gbvalu(beam, np, nb, nx, factor, start, u, pull, piece, dist, value, status, message)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: error_type
    use gapbeam_element, only: field_type
    use gapbeam_handle, only: handle_type, handle_of, report
    use gapbeam_query, only: fields_in_pieces
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np, nb, nx
    ! From GBRECO and GBSOLV
    double precision, intent(in) :: factor
    double precision, intent(in), target :: start(4, np)
    double precision, intent(in) :: u(0:nb), pull(nb + 1)
    integer, intent(in) :: piece(nx)
    double precision, intent(in) :: dist(nx)
    ! Deflection, rotation, moment, shear, axial force, axial displacement
    double precision, intent(out) :: value(6, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(start) :: np = shape(start, 1)
    !f2py integer, intent(hide), depend(u) :: nb = shape(u, 0) - 1
    !f2py integer, intent(hide), depend(piece) :: nx = shape(piece, 0)
    type(handle_type), pointer :: handle
    type(field_type), pointer :: starts(:)
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    value = 0.0d0
    call c_f_pointer(c_loc(start), starts, [np])
    call fields_in_pieces(handle%lowered, factor, starts, u, pull(:nb), piece, dist, value, error)
    call report(error, status, message)
end subroutine gbvalu

! Maximum and minimum of all fields and their places, in the scene's units
subroutine gbextr(beam, np, nb, factor, start, u, pull, value, x, status, message)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_error, only: error_type
    use gapbeam_element, only: field_type
    use gapbeam_handle, only: handle_type, handle_of, report
    use gapbeam_query, only: extremes_of_pieces
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np, nb
    ! As for GBVALU
    double precision, intent(in) :: factor
    double precision, intent(in), target :: start(4, np)
    double precision, intent(in) :: u(0:nb), pull(nb + 1)
    double precision, intent(out) :: value(2, 6), x(2, 6)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(start) :: np = shape(start, 1)
    !f2py integer, intent(hide), depend(u) :: nb = shape(u, 0) - 1
    type(handle_type), pointer :: handle
    type(field_type), pointer :: starts(:)
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    call c_f_pointer(c_loc(start), starts, [np])
    call extremes_of_pieces(handle%lowered, factor, starts, u, pull(:nb), value, x, error)
    call report(error, status, message)
end subroutine gbextr

! Largest absolute values of deflection, rotation, moment, shear, in the engine's units
subroutine gblarg(beam, np, factor, start, value)
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer
    use gapbeam_element, only: field_type
    use gapbeam_fields, only: find_extremes
    use gapbeam_handle, only: handle_type, handle_of
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: np
    double precision, intent(in) :: factor
    double precision, intent(in), target :: start(4, np)
    double precision, intent(out) :: value(4)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(start) :: np = shape(start, 1)
    type(handle_type), pointer :: handle
    type(field_type), pointer :: starts(:)
    double precision :: found(2, 4), distance(2, 4)
    integer :: piece(2, 4)

    handle => handle_of(beam)
    call c_f_pointer(c_loc(start), starts, [np])
    associate (lowered => handle%lowered)
        call find_extremes(lowered%pieces, lowered%dead, lowered%live, factor, starts, found, piece, distance)
    end associate
    value = maxval(abs(found), 1)
end subroutine gblarg

! Condense the loads of a beam one by one, for GBCASE
subroutine gbshar(beam, status)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of
    use gapbeam_cases, only: split_loads
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(out) :: status
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    status = gapbeam_solved
    if (allocated(handle%cases)) return
    allocate (handle%cases)
    call split_loads(handle%lowered, handle%cases, error)
    if (.not. allocated(error)) return
    deallocate (handle%cases)
    status = error%code
end subroutine gbshar

! Solve NC cases of loads; every load counts with its factor
subroutine gbcase(beam, nl, ns, nd, nv, nc, factor, supp, rule, closed, w, ml, mr, react, solves, status)
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_units, only: moment_unit
    use gapbeam_handle, only: handle_type, handle_of
    use gapbeam_cases, only: solve_case, replace_supports
    use gapbeam_search, only: rule_block
    use gapbeam_lane_cases, only: fits_lanes, solve_in_lanes
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    ! One more than there are loads; cases
    integer, intent(in) :: nd, nc
    ! One more than there are supports of the scene, or 1 where they are those of the scene
    integer, intent(in) :: nv
    ! Factor of every load in every case; settlement, gap and stiffness of every support, of supports without laws
    double precision, intent(in) :: factor(nd, nc), supp(3, nv, nc)
    integer, intent(in) :: rule
    ! Schemes: start in, working scheme out; of a case that is not solved all open, and its results are not numbers
    integer, intent(inout) :: closed(ns + 1, nc)
    ! In the scene's units: deflections and moments left and right of the nodes, reactions
    double precision, intent(inout) :: w(0:nl, nc), ml(0:nl, nc), mr(0:nl, nc), react(ns + 1, nc)
    ! Where memory ends all STATUS say so
    integer, intent(inout) :: solves(nc), status(nc)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    !f2py integer, intent(hide), depend(factor) :: nd = shape(factor, 0)
    !f2py integer, intent(hide), depend(factor) :: nc = shape(factor, 1)
    !f2py integer, intent(hide), depend(supp) :: nv = shape(supp, 1)
    !f2py integer, intent(hide), depend(w) :: nl = shape(w, 0) - 1
    type(handle_type), pointer :: handle
    type(beam_type) :: loaded
    type(workspace_type) :: work
    logical, allocatable :: acting(:), done(:)
    double precision :: nan
    integer :: i

    handle => handle_of(beam)
    solves = 0
    status = gapbeam_no_memory
    if (.not. enough_memory(for_solving, nl, ns, 0)) return
    allocate (acting(ns), done(nc))
    done(:) = .false.
    if (rule == rule_block .and. fits_lanes(handle%lowered)) then
        call solve_in_lanes(handle%lowered, handle%cases, factor, supp(:, :nv - 1, :), closed, w, ml, mr, react, solves, done)
        where (done) status = gapbeam_solved
        if (all(done)) return
    end if
    loaded = handle%lowered%beam
    call new_workspace(loaded, work)
    nan = ieee_value(nan, ieee_quiet_nan)
    do i = 1, nc
        if (done(i)) cycle
        w(:, i) = nan
        ml(:, i) = nan
        mr(:, i) = nan
        react(:, i) = nan
        acting(:) = closed(:ns, i) /= 0
        closed(:, i) = 0
        if (nv > 1) then
            call replace_supports(handle%lowered, supp(:, :nv - 1, i), loaded, status(i))
            if (status(i) /= gapbeam_solved) cycle
        end if
        call solve_case(handle%cases, factor(:, i), rule, loaded, acting, work, status(i))
        if (status(i) == gapbeam_no_memory) then
            status = gapbeam_no_memory
            return
        end if
        solves(i) = work%solves
        if (status(i) /= gapbeam_solved) cycle
        associate (units => handle%lowered%units, a => work%answers)
            w(:, i) = scale(a%deflection, units%deflection)
            ml(:, i) = scale(a%moment_left, moment_unit(units))
            mr(:, i) = scale(a%moment_right, moment_unit(units))
            react(:ns, i) = scale(work%reaction, units%force)
        end associate
        if (all(abs(w(:, i)) <= huge(nan)) .and. all(abs(ml(:, i)) <= huge(nan)) .and. all(abs(mr(:, i)) <= huge(nan)) &
            .and. all(abs(react(:ns, i)) <= huge(nan))) then
            closed(:ns, i) = merge(1, 0, acting)
        else
            status(i) = gapbeam_not_finite
            w(:, i) = nan
            ml(:, i) = nan
            mr(:, i) = nan
            react(:, i) = nan
        end if
    end do
end subroutine gbcase
