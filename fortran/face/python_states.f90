! Single states for Python, in the manner of face/python.f90, which says what the arguments are

! Find the working scheme at one load factor and solve it
subroutine gbsolv(beam, nl, ns, nm, nb, factor, rule, closed, undec, w, ml, mr, shear, react, motion, u, pull, &
                  values, counts, ground, status, message)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of, report, keep_ground
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_support_values, only: support_values
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
    counts(:5) = [state%solves, state%method, merge(1, 0, state%indifferent), merge(1, 0, state%cycled), &
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
