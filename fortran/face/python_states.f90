! Single states for Python, in the manner of face/python.f90, which says what the arguments are. STATE is the handle of a solved
! state, FIELDS that of its fields at the pieces

! Find the contact state at one load factor and solve it
subroutine gbsolv(beam, ns, nm, factor, rule, onlaws, closed, undec, values, counts, share, state, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, keep_state, report
    use gapbeam_error, only: gapbeam_solved
    use gapbeam_support_values, only: support_values
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ns, nm
    ! Factor of the live loads; rule 0 block, 1 single, 2 CLOSED is known to be the contact state (as along a path)
    double precision, intent(in) :: factor
    integer, intent(in) :: rule
    ! 1: on the smooth laws themselves; else on the polylines or lines in place of them, 2: which have to give their forces, 3: as
    ! far as polylines do
    integer, intent(in) :: onlaws
    ! Scheme: 1 closed, 0 open; start in, contact state out
    integer, intent(inout) :: closed(ns + 1)
    ! 1 where the reaction or the opening is zero, so that the support may be closed or open
    integer, intent(out) :: undec(ns + 1)
    ! Of the scene's supports in its units: reaction, deflection, opening, couple
    double precision, intent(out) :: values(nm + 1, 4)
    ! Linear solves; system solved last: 0 mixed, 1 three-moment, 2 with pivoting; 1 where the beam can move freely
    ! without work of the loads; 1 where the rule single came back to a scheme; 1 where the beam slides along its axis;
    ! 0 where other states may be there under compression; stretches on the ground, and most layers under one of them
    integer, intent(out) :: counts(8)
    ! Share of the axial forces that the beam bears where it buckles
    double precision, intent(out) :: share
    ! 0 where there is an error
    integer(8), intent(out) :: state
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(error_type), allocatable :: error
    integer, allocatable :: conditions(:)

    handle => behind(beam)
    undec = 0
    values = 0.0d0
    counts = 0
    share = 1.0d0
    call keep_state(handle, factor, rule, onlaws, closed(:ns) /= 0, solved, error)
    state = number_of(solved)
    call report(error, status, message)
    if (allocated(error)) return
    associate (s => solved%result%state)
        status = s%status
        counts(:6) = [s%solves, s%method, merge(1, 0, s%indifferent), merge(1, 0, s%cycled), merge(1, 0, s%slides), 1]
        if (allocated(s%ground)) counts(6) = merge(1, 0, s%ground%unique)
        if (allocated(s%ground)) share = s%ground%axial_share
        if (status /= gapbeam_solved) return
        closed(:ns) = merge(1, 0, s%closed)
        undec(:ns) = merge(1, 0, s%undecided)
        allocate (conditions(nm))
        call support_values(handle%beam%lowered, s, values(:nm, 1), values(:nm, 2), values(:nm, 3), values(:nm, 4), conditions)
        if (allocated(s%ground)) counts(7:8) = shape(transpose(s%ground%acts))
    end associate
end subroutine gbsolv

! The numbers of a state
subroutine gbsget(state, nl, ns, nb, w, ml, mr, shear, react, motion, u, pull)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_error, only: gapbeam_solved
    implicit none
    integer(8), intent(in) :: state
    integer, intent(in) :: nl, ns, nb
    ! Deflections, moments left and right of the nodes, shears of the links beside those of the simple bar, reactions (up)
    double precision, intent(out) :: w(0:nl), ml(0:nl), mr(0:nl), shear(nl), react(ns + 1)
    ! Free motion where there is no equilibrium, and all else is 0
    double precision, intent(out) :: motion(0:nl)
    ! Displacements of the axial system's points and forces in its bars
    double precision, intent(out) :: u(0:nb), pull(nb + 1)
    !f2py threadsafe
    type(handle_type), pointer :: solved

    w = 0.0d0
    ml = 0.0d0
    mr = 0.0d0
    shear = 0.0d0
    react = 0.0d0
    motion = 0.0d0
    u = 0.0d0
    pull = 0.0d0
    solved => behind(state)
    associate (s => solved%result%state)
        if (allocated(s%motion)) motion = s%motion
        if (s%status /= gapbeam_solved) return
        w = s%deflection(0:nl)
        ml = s%moment_left
        mr = s%moment_right
        shear = s%shear
        react(:ns) = s%reaction
        u = s%displacement
        pull(:nb) = s%tension
    end associate
end subroutine gbsget

! Check a solved state
subroutine gbcert(beam, state, residu, bound, known, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_certificate, only: certificate_type
    use gapbeam_state, only: certify_state
    implicit none
    integer(8), intent(in) :: beam, state
    ! Relative residuals of compatibility, equilibrium and complementarity
    double precision, intent(out) :: residu(3)
    ! Largest errors of deflections of the nodes, reactions; of deflections, rotations, moments, shears along the beam
    double precision, intent(out) :: bound(6)
    ! 0 where deflections and rotations have no bound
    integer, intent(out) :: known, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(certificate_type) :: found
    type(error_type), allocatable :: error

    handle => behind(beam)
    solved => behind(state)
    residu = 0.0d0
    bound = 0.0d0
    known = 0
    call certify_state(handle%beam%lowered, solved%result%state, found, error)
    call report(error, status, message)
    if (allocated(error)) return
    residu = [found%compatibility, found%equilibrium, found%complementarity]
    bound = [found%of_nodes, found%reaction, found%deflection, found%rotation, found%moment, found%shear]
    known = merge(1, 0, found%known)
end subroutine gbcert

! Recover the fields at the pieces
subroutine gbreco(beam, state, fields, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, keep_fields, report
    implicit none
    integer(8), intent(in) :: beam, state
    ! 0 where there is an error
    integer(8), intent(out) :: fields
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved, recovered
    type(error_type), allocatable :: error

    handle => behind(beam)
    solved => behind(state)
    call keep_fields(handle, solved, recovered, error)
    fields = number_of(recovered)
    call report(error, status, message)
end subroutine gbreco

! Fields at NX places of the scene, in its units; where they jump right (LEFT = 0) or left of the place
subroutine gbfind(beam, nx, x, left, piece, dist, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
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
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    integer, allocatable :: pieces(:)
    double precision, allocatable :: distances(:)

    handle => behind(beam)
    piece = 0
    dist = 0.0d0
    call find_pieces(handle%beam%lowered, x, left /= 0, pieces, distances, error)
    call report(error, status, message)
    if (allocated(error)) return
    piece = pieces
    dist = distances
end subroutine gbfind

! Quantities at distances from the left ends of pieces, in the scene's units
subroutine gbvalu(beam, state, fields, nq, nx, which, piece, dist, value, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_query, only: fields_in_pieces
    implicit none
    integer(8), intent(in) :: beam, state, fields
    ! Quantities, by their numbers (fortran/beam/quantities.f90); places
    integer, intent(in) :: nq, nx
    integer, intent(in) :: which(nq), piece(nx)
    double precision, intent(in) :: dist(nx)
    double precision, intent(out) :: value(nq, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved, recovered
    type(error_type), allocatable :: error

    handle => behind(beam)
    solved => behind(state)
    recovered => behind(fields)
    value = 0.0d0
    associate (s => solved%result%state)
        call fields_in_pieces(handle%beam%lowered, s%factor, recovered%starts, s%displacement, s%tension, which, piece, dist, &
                              value, error, s%ground, s%along_ground)
    end associate
    call report(error, status, message)
end subroutine gbvalu

! Maximum and minimum of quantities and their places, in the scene's units; WHICH as for GBVALU
subroutine gbextr(beam, state, fields, nq, which, value, x, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_query, only: extremes_of_pieces
    implicit none
    integer(8), intent(in) :: beam, state, fields
    integer, intent(in) :: nq
    integer, intent(in) :: which(nq)
    double precision, intent(out) :: value(2, nq), x(2, nq)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved, recovered
    type(error_type), allocatable :: error

    handle => behind(beam)
    solved => behind(state)
    recovered => behind(fields)
    value = 0.0d0
    x = 0.0d0
    associate (s => solved%result%state)
        call extremes_of_pieces(handle%beam%lowered, s, recovered%starts, which, value, x, error)
    end associate
    call report(error, status, message)
end subroutine gbextr

! Smallest axial force of every piece, in the scene's units, of a state on ground along the beam
subroutine gbleas(beam, state, np, force)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: np
    double precision, intent(out) :: force(np)
    type(handle_type), pointer :: handle, solved

    handle => behind(beam)
    solved => behind(state)
    force = scale(solved%result%state%tension, handle%beam%lowered%axial%units%force)
end subroutine gbleas

! Where a beam slides, or has slid last, over ground along it: the first MP parts, from left to right
subroutine gbpart(beam, state, mp, number, place, way, force)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_kinds, only: dp
    use gapbeam_assembled_model, only: assembled_type, point_x, piece_length
    use gapbeam_ground_along, only: length_of
    use gapbeam_axial_bedding, only: bedding_type, friction_on
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: mp
    ! How many there are
    integer, intent(out) :: number
    ! Both ends; 1 to the right, -1 to the left; force of the ground on the beam, to the right
    double precision, intent(out) :: place(2, mp), force(mp)
    integer, intent(out) :: way(mp)
    type(handle_type), pointer :: handle, solved
    integer :: k

    handle => behind(beam)
    solved => behind(state)
    number = 0
    place = 0.0d0
    way = 0
    force = 0.0d0
    associate (lowered => handle%beam%lowered, ground => solved%result%state%along_ground)
        if (allocated(ground%springs)) then
            call look_at_springs(lowered, ground%springs)
            return
        end if
        do k = 1, size(ground%parts)
            associate (part => ground%parts(k), j => ground%parts(k)%bar)
                if (part%slope == 0 .or. .not. ground%limit(j) > 0.0d0) cycle
                number = number + 1
                if (number > mp) cycle
                place(:, number) = point_x(lowered, j - 1) + piece_length(lowered, j)*[part%to - length_of(ground, k), part%to]
                way(number) = part%slope
                force(number) = -scale(part%slope*ground%limit(j)*length_of(ground, k), lowered%axial%units%force)
            end associate
        end do
    end associate

contains

    ! The same where the ground has springs: where the beam slides
    subroutine look_at_springs(lowered, springs)
        type(assembled_type), intent(in) :: lowered
        type(bedding_type), intent(in) :: springs
        integer :: i

        do i = 1, size(springs%cells)
            associate (cell => springs%cells(i), j => springs%cells(i)%bar)
                if (cell%way == 0) cycle
                number = number + 1
                if (number > mp) cycle
                place(:, number) = point_x(lowered, j - 1) + piece_length(lowered, j)*real([cell%from, cell%to], dp)
                way(number) = cell%way
                force(number) = scale(real(friction_on(springs, cell), dp), lowered%axial%units%force)
            end associate
        end do
    end subroutine look_at_springs
end subroutine gbpart

! Slopes of the smooth laws in a state, in the scene's units
subroutine gbslop(beam, state, n, slope)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, force_and_slope, deflection_at
    implicit none
    integer(8), intent(in) :: beam, state
    ! Smooth laws, and one more
    integer, intent(in) :: n
    double precision, intent(out) :: slope(n)
    type(handle_type), pointer :: handle, solved
    integer, allocatable :: numbers(:)
    double precision :: past, force
    integer :: j, way

    handle => behind(beam)
    solved => behind(state)
    slope = 0.0d0
    associate (lowered => handle%beam%lowered)
        allocate (numbers, source=smooth_supports(lowered))
        do j = 1, size(numbers)
            associate (s => lowered%model%supports(numbers(j)))
                call past_the_gap(s, deflection_at(lowered, solved%result%state%deflection, numbers(j)), past, way)
                call force_and_slope(s, past, force, slope(j))
            end associate
        end do
    end associate
end subroutine gbslop

! What the supports that yield keep, in a state on a loading history; 0 of others
subroutine gbyiel(beam, state, nm, values)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_yielded_supports, only: yielded_supports
    implicit none
    integer(8), intent(in) :: beam, state
    ! Supports of the scene
    integer, intent(in) :: nm
    ! Elastic energies, permanent sets, and displacements less what they have moved themselves, in the scene's units
    double precision, intent(out) :: values(nm + 1, 3)
    type(handle_type), pointer :: handle, solved

    handle => behind(beam)
    solved => behind(state)
    values(nm + 1, :) = 0.0d0
    call yielded_supports(handle%beam%lowered, solved%result%state, values(:nm, 1), values(:nm, 2), values(:nm, 3))
end subroutine gbyiel

! Largest absolute values of deflection, rotation, moment, shear, in the engine's units; not on the ground
subroutine gblarg(beam, state, fields, value)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_fields, only: find_extremes
    use gapbeam_quantities, only: bending_count, bounded_count
    implicit none
    integer(8), intent(in) :: beam, state, fields
    double precision, intent(out) :: value(4)
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved, recovered
    double precision :: found(2, bending_count), distance(2, bending_count)
    integer :: piece(2, bending_count)

    handle => behind(beam)
    solved => behind(state)
    recovered => behind(fields)
    associate (lowered => handle%beam%lowered)
        call find_extremes(lowered%pieces, lowered%dead, lowered%live, solved%result%state%factor, recovered%starts, found, piece, &
                           distance)
    end associate
    value = maxval(abs(found(:, :bounded_count)), 1)
end subroutine gblarg
