! Load paths of beams on the ground for Python; all else is said in python.f90. Marshalling only.

! Follow the load from factor 0 to 1
subroutine gbgpth(beam, nl, ns, rule, closed, sizes, ends, motion, status, message)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of, report
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
    ! Solved, or no equilibrium
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    type(handle_type), pointer :: handle
    type(state_type) :: state
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    sizes = 0
    ends = 0.0d0
    motion = 0.0d0
    if (allocated(handle%ground_path)) deallocate (handle%ground_path)
    allocate (handle%ground_path)
    call new_state(handle%lowered, state, error)
    if (.not. allocated(error)) then
        state%closed(:) = closed(:ns) /= 0
        call follow_on_ground(handle%lowered, 1.0d0, rule, state, handle%ground_path, error)
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
    use gapbeam_handle, only: handle_type, handle_of
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

    handle => handle_of(beam)
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
