! Beams on the ground for Python: values and load paths, in the manner of face/python.f90, which says what the arguments are

! Follow the load from factor 0 to 1
subroutine gbgpth(beam, nl, ns, rule, closed, sizes, ends, motion, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_error, only: gapbeam_solved
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_ground_path, only: follow_on_ground
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    ! 0 block, 1 single
    integer, intent(in) :: rule
    ! Scheme from which every search starts: 1 closed, 0 open
    integer, intent(in) :: closed(ns + 1)
    ! Events, segments, linear solves; 1 where ground that yields carries no more; 1 where it slides along its axis; for GBGPTE
    integer, intent(out) :: sizes(5)
    ! Load factor that the path goes to, and one above which there is no equilibrium for sure
    double precision, intent(out) :: ends(2)
    ! How the beam moves above it; 0 where it stands to the end
    double precision, intent(out) :: motion(0:nl)
    ! Solved, no equilibrium, or buckles
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(state_type) :: state
    type(error_type), allocatable :: error

    handle => behind(beam)
    sizes = 0
    ends = 0.0d0
    motion = 0.0d0
    if (associated(handle%ground_path)) deallocate (handle%ground_path)
    allocate (handle%ground_path)
    call new_state(handle%beam%lowered, state, error)
    if (.not. allocated(error)) then
        state%closed(:) = closed(:ns) /= 0
        call follow_on_ground(handle%beam%lowered, 1.0d0, rule, state, handle%ground_path, error)
    end if
    call report(error, status, message)
    if (allocated(error)) return
    status = state%status
    associate (path => handle%ground_path)
        sizes = [path%number, path%segments, path%solves, merge(1, 0, path%at_limit), merge(1, 0, state%slides)]
        ends = [path%last, path%beyond]
    end associate
    if (status /= gapbeam_solved) motion = state%motion
end subroutine gbgpth

! The events and segments of a path that GBGPTH found, which is freed with that
subroutine gbgpte(beam, ns, ne, nk, at, which, from, closed)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    integer(8), intent(in) :: beam
    ! Supports of the engine, events, segments, one more than there are
    integer, intent(in) :: ns, ne, nk
    ! Of every event: load factor, place; support and foundation (from 1, 0 none), branch, what happens (gapbeam_pieces)
    double precision, intent(out) :: at(2, ne)
    integer, intent(out) :: which(4, ne)
    ! Of every segment: load factor at which it begins; scheme, 1 closed, 0 open
    double precision, intent(out) :: from(nk)
    integer(1), intent(out) :: closed(ns, nk)
    type(handle_type), pointer :: handle
    integer :: k

    handle => behind(beam)
    at = 0.0d0
    which = 0
    from = 0.0d0
    closed = int(0, kind(closed))
    do k = 1, ne - 1
        associate (event => handle%ground_path%events(k))
            at(:, k) = [event%factor, event%x]
            which(:, k) = [event%support, event%foundation, event%branch, event%change]
        end associate
    end do
    do k = 1, nk - 1
        associate (segment => handle%ground_path%segment(k))
            from(k) = segment%from
            closed(:ns - 1, k) = int(merge(1, 0, segment%closed), kind(closed))
        end associate
    end do
    deallocate (handle%ground_path)
end subroutine gbgpte

! What is in the stretches of a state on the ground
subroutine gbgget(state, ng, ny, values, bounds, resid)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    ! From GBSOLV; stretches, and most layers
    integer(8), intent(in) :: state
    integer, intent(in) :: ng, ny
    ! A column a stretch, in the engine's units: piece; distances of the ends from its left end, length; moduli; loads qa, qb, qc,
    ! kappa; deflections, moments, rotations, shears of the ends, slope; of every layer the force up, and the piece of its law on
    ! which it acts (0: none)
    double precision, intent(out) :: values(19 + 2*ny, ng)
    ! Bounds of the errors of deflection, rotation, moment, shear and reactions; residuals of compatibility, equilibrium,
    ! complementarity
    double precision, intent(out) :: bounds(5), resid(3)
    !f2py threadsafe
    type(handle_type), pointer :: solved
    integer :: i

    solved => behind(state)
    associate (ground => solved%result%state%ground)
        do i = 1, ng
            associate (s => ground%stretches(i), q => ground%loads(i), e => ground%ends(i))
                values(:19, i) = [dble(ground%piece(i)), ground%from(i), ground%to(i), s%length, s%modulus_a, s%modulus_b, q%qa, &
                                  q%qb, q%qc, q%kappa, e%w_a, e%w_b, e%moment_a, e%moment_b, ground%rotation(:, i), &
                                  ground%shear(:, i), ground%slope(i)]
            end associate
            values(20:19 + ny, i) = ground%resultant(:, i)
            values(20 + ny:, i) = ground%acts(:, i)
        end do
        bounds = ground%bounds
        resid = ground%residuals
    end associate
end subroutine gbgget

! Stretches beside each other in which a layer does the same joined: by foundation, below before above, from left to right
subroutine gbgrun(beam, state, ng, ny, number, about, values, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_ground_runs, only: run_type, ground_runs
    implicit none
    integer(8), intent(in) :: beam, state
    ! As for GBGGET
    integer, intent(in) :: ng, ny
    ! How many there are
    integer, intent(out) :: number
    ! Foundation (from 0), side, pieces of its law (0: linear), the piece on which it acts (0: no contact), 1 if it only touches
    integer, intent(out) :: about(5, 3*ng*ny)
    ! Ends, force on the beam (up), largest distance between beam and ground, in the scene's units
    double precision, intent(out) :: values(4, 3*ng*ny)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(run_type), allocatable :: runs(:)
    type(error_type), allocatable :: error
    integer :: i

    handle => behind(beam)
    solved => behind(state)
    number = 0
    about = 0
    values = 0.0d0
    call ground_runs(handle%beam%lowered, solved%result%state%ground, runs, error)
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
