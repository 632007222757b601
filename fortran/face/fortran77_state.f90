! Values of a solved state in Fortran 77: supports, fields, extremes, motion, certificate. Marshalling only; units, signs, handles
! and INFO: see fortran77.f90. -2 is also a state in which nothing is solved, or that is not of this beam as it is now.

! Values at the supports
subroutine ghsupp(beam, state, supval, kstate, info)
    use gapbeam_api, only: get_supports, count_supports
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Reaction, deflection, opening (negative: the beam has gone past a support without stiffness), couple of every support
    double precision, intent(inout) :: supval(4, *)
    ! 0 open, 1 closed, 2 bilateral, 10 plus the number of the piece of a law
    integer, intent(inout) :: kstate(*)
    ! -1, -2
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    integer :: n

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    n = count_supports(prepared%beam)
    call get_supports(prepared%beam, solved%result, supval(1, 1:n), supval(2, 1:n), supval(3, 1:n), supval(4, 1:n), kstate(1:n), &
                      error)
    info = info_of(error, 2)
end subroutine ghsupp

! What friction does at the supports, in a state from GHPATH
subroutine ghfric(beam, state, frival, kslide, info)
    use gapbeam_api, only: get_friction, count_supports
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Force on the beam and how far it has gone over the support, to the right; zeros where there is none
    double precision, intent(inout) :: frival(2, *)
    ! 1 where it slides to the right, -1 to the left, 0 where it sticks
    integer, intent(inout) :: kslide(*)
    ! -1, -2
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error
    integer :: n

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    n = count_supports(prepared%beam)
    call get_friction(prepared%beam, solved%result, frival(1, 1:n), frival(2, 1:n), kslide(1:n), error)
    info = info_of(error, 2)
end subroutine ghfric

! Exact fields anywhere along the beam
subroutine ghflds(beam, state, nx, x, left, field, info)
    use gapbeam_api, only: get_fields
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Places
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Where a field jumps: 0 its value right of the place, 1 left of it
    integer, intent(in) :: left
    ! Deflection, rotation, moment, shear, axial force, axial displacement at every place
    double precision, intent(inout) :: field(6, *)
    ! -1, -2, -3, -5; -4: a place off the beam; 14: a field out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. nx < 0) info = -3
    if (info == 0 .and. left /= 0 .and. left /= 1) info = -5
    if (info /= 0) return
    call get_fields(prepared%beam, solved%result, x(1:nx), field(:, 1:nx), error, left == 1)
    info = info_of(error, 4)
end subroutine ghflds

! Exact extremes of all fields
subroutine ghxtrm(beam, state, value, xvalue, info)
    use gapbeam_api, only: get_extremes
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Maximum and minimum of the six fields of GHFLDS, and where they are
    double precision, intent(inout) :: value(2, 6), xvalue(2, 6)
    ! -1, -2; 14: a field out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    call get_extremes(prepared%beam, solved%result, value, xvalue, error)
    info = info_of(error, 2)
end subroutine ghxtrm

! The free motion where there is no equilibrium
subroutine ghmotn(beam, state, maxnd, nnode, xnode, motion, info)
    use gapbeam_api, only: get_motion, count_nodes
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Room in the arrays; NSPAN + NHINGE + NSUP + 2 NLOAD + 1 is always enough, with foundations 2 NFOUND + NPROF + NFLAW + NTAB
    ! more, with sections 2 NSEC more, with lumped masses NMASS more
    integer, intent(in) :: maxnd
    ! Number of nodes of the system
    integer, intent(inout) :: nnode
    ! Their places and displacements, down, largest 1, straight lines between; all 0 where the beam slides along its axis
    double precision, intent(inout) :: xnode(*), motion(*)
    ! -1; -2, also of a state that is not without equilibrium; -3: too little room, NNODE says how much it takes
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    nnode = count_nodes(prepared%beam)
    if (maxnd < nnode) info = -3
    if (info /= 0) return
    call get_motion(prepared%beam, solved%result, xnode(1:nnode), motion(1:nnode), error)
    info = info_of(error, 2)
end subroutine ghmotn

! How good a state is, and which supports its digits cannot decide
subroutine ghcert(beam, state, cert, known, iundec, info)
    use gapbeam_api, only: certificate_type, get_certificate, count_supports
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_memory, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Relative residuals of equilibrium, compatibility, complementarity; largest error of any deflection of a node, any reaction;
    ! of deflections, rotations, moments and shears along the beam
    double precision, intent(inout) :: cert(9)
    ! 1 where deflections and rotations have a bound
    integer, intent(inout) :: known
    ! 1 for every support whose reaction or opening is zero, so that it may be closed or open
    integer, intent(inout) :: iundec(*)
    ! -1, -2; 12, 13: it cannot be checked in quadruple precision; 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(certificate_type) :: certificate
    type(error_type), allocatable :: error
    logical, allocatable :: undecided(:)
    integer :: stat

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info /= 0) return
    allocate (undecided(count_supports(prepared%beam)), stat=stat)
    if (stat /= 0) info = gapbeam_no_memory
    if (info /= 0) return
    call get_certificate(prepared%beam, solved%result, certificate, undecided, error)
    info = info_of(error, 2)
    if (info /= 0) return
    cert = [certificate%equilibrium, certificate%compatibility, certificate%complementarity, &
            certificate%deflection_bound, certificate%reaction_bound, certificate%field_bound]
    known = merge(1, 0, certificate%known)
    iundec(1:size(undecided)) = merge(1, 0, undecided)
end subroutine ghcert
