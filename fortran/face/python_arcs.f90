! Paths on smooth laws for Python, in the manner of face/python.f90, which says what the arguments are. ARC is the handle of an arc,
! which one thread has at a time; what is at the N smooth laws and the load factor are N + 1 numbers, in the scene's units. A test
! is a function of the place along an arc, as in gapbeam_arc_roots: KIND, NUMBER, and ABOUT of it: load factor, or level and force
! of the end of a piece, and 1 where the force tells how far it is

! The path on the smooth laws along the line between two states
subroutine gbamak(beam, ns, n, closed, laws, ends, turn, turns, arc, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, number_of, behind, laws_given, report
    use gapbeam_handles, only: arc_tag, new_handle, finish_handle
    use gapbeam_smooth_arc, only: new_arc
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ns, n
    ! Scheme; laws as from GBHGET
    integer, intent(in) :: closed(ns)
    double precision, intent(in) :: laws(4, ns)
    ! The states; where between them the load turns round, if TURNS is not 0
    double precision, intent(in) :: ends(n + 1, 2), turn(n + 1)
    integer, intent(in) :: turns
    integer(8), intent(out) :: arc
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, made
    type(error_type), allocatable :: error
    double precision, allocatable :: turning(:)

    handle => behind(beam)
    call new_handle(arc_tag, made, error)
    if (.not. allocated(error)) then
        ! What is not allocated is not present
        if (turns /= 0) allocate (turning, source=turn)
        associate (lowered => handle%beam%lowered)
            call new_arc(lowered, closed(:ns - 1) /= 0, laws_given(lowered, laws(:, :ns - 1)), ends(:, 1), ends(:, 2), made%arc, &
                         error, turning)
        end associate
    end if
    call finish_handle(made, error)
    arc = number_of(made)
    call report(error, status, message)
end subroutine gbamak

! A state of an arc
subroutine gbaget(arc, ns, n, place, point, rate, slope, laws, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_arc_states, only: find_on_arc
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: ns, n
    double precision, intent(in) :: place
    ! Where it is, derivatives along the arc, slopes of the smooth laws; as from GBHGET, springs in place of the smooth laws
    double precision, intent(out) :: point(n + 1), rate(n + 1), slope(n), laws(4, ns)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    integer :: k

    handle => behind(arc)
    point = 0.0d0
    rate = 0.0d0
    slope = 0.0d0
    laws = 0.0d0
    call find_on_arc(handle%arc, place, k, error)
    call report(error, status, message)
    if (allocated(error)) return
    associate (found => handle%arc%known(k)%one, s => handle%arc%known(k)%one%state%laws)
        point = found%point
        rate = found%rate
        slope = found%slope
        laws(1, :ns - 1) = s%contact
        laws(2, :ns - 1) = s%force
        laws(3, :ns - 1) = s%stiffness
        laws(4, :ns - 1) = s%before
    end associate
end subroutine gbaget

! Places where a test is zero: the first one beside the two states, from FIRST on, or all between them
subroutine gbaroo(arc, kind, number, about, bounds, all, places, count, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_arc_roots, only: arc_test_type, find_root, find_roots
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: kind, number
    double precision, intent(in) :: about(3)
    ! Places beyond which not to look, and the one at which to begin
    double precision, intent(in) :: bounds(3)
    ! 1: all between the two states
    integer, intent(in) :: all
    double precision, intent(out) :: places(16)
    integer, intent(out) :: count, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    type(arc_test_type) :: test
    integer, allocatable :: states(:)
    integer :: k

    handle => behind(arc)
    places = 0.0d0
    count = 0
    test = arc_test_type(kind, number, about(1), about(2), about(3) > 0.0d0)
    if (all /= 0) then
        call find_roots(handle%arc, test, states, error)
    else
        allocate (states(1))
        call find_root(handle%arc, test, bounds(1), bounds(2), bounds(3), states(1), error)
    end if
    call report(error, status, message)
    if (allocated(error)) return
    count = size(states)
    do k = 1, count
        places(k) = handle%arc%known(states(k))%one%at
    end do
end subroutine gbaroo

! A test at a place, how fast the load factor changes beside it (BESIDE -1 before it, 1 beyond, 0: not asked), and how far a support
! is beyond the piece on which it is taken to be (RIGHT not 0)
subroutine gbalok(arc, kind, number, about, place, beside, right, value, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_arc_states, only: find_on_arc, rate_beside, wrongness_of
    use gapbeam_arc_roots, only: arc_test_type, test_value
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: kind, number
    double precision, intent(in) :: about(3), place
    integer, intent(in) :: beside, right
    double precision, intent(out) :: value
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    integer :: k

    handle => behind(arc)
    value = 0.0d0
    if (beside /= 0) then
        call rate_beside(handle%arc, place, beside, value, error)
    else
        call find_on_arc(handle%arc, place, k, error)
        if (.not. allocated(error)) then
            if (right /= 0) then
                call wrongness_of(handle%arc, handle%arc%known(k)%one%state, value, error)
            else
                call test_value(handle%arc, arc_test_type(kind, number, about(1), about(2), about(3) > 0.0d0), k, value, &
                                error)
            end if
        end if
    end if
    call report(error, status, message)
end subroutine gbalok

! Numbers of the signs of the eigenvalues of the tangent stiffness, where the smooth laws have given slopes
subroutine gbaeig(arc, n, slope, values, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_arc_states, only: eigenvalues_at
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: n
    double precision, intent(in) :: slope(n)
    double precision, intent(out) :: values(n)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => behind(arc)
    call eigenvalues_at(handle%arc, slope, values, error)
    call report(error, status, message)
end subroutine gbaeig

! Stable way on from a bifurcation, where the load goes WAY, until it comes to GOAL or stops growing
subroutine gbabra(arc, n, origin, way, goal, points, count, arrive, lost, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_limits, only: most_branch_points
    use gapbeam_smooth_branches, only: branch_points_type, tracer_at, follow_branch
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: n, way
    double precision, intent(in) :: origin(n), goal
    ! From the bifurcation on, COUNT of them; 1 where it comes to GOAL; 1 where it goes on, but cannot be followed
    double precision, intent(out) :: points(n, 10003)
    integer, intent(out) :: count, arrive, lost, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error
    type(branch_points_type) :: branch

    handle => behind(arc)
    points = 0.0d0
    call follow_branch(tracer_at(handle%arc, origin), way, goal, branch, error)
    call report(error, status, message)
    count = min(branch%number, 2*most_branch_points + 3)
    if (count > 0) points(:, :count) = branch%points(:, :count)
    arrive = merge(1, 0, branch%arrives)
    lost = merge(1, 0, branch%lost)
end subroutine gbabra

! The point of such a way at a load factor between those of its first and last point
subroutine gbafac(arc, n, count, origin, points, factor, point, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_smooth_branches, only: tracer_at, point_at_factor
    implicit none
    integer(8), intent(in) :: arc
    integer, intent(in) :: n, count
    double precision, intent(in) :: origin(n), points(n, count), factor
    double precision, intent(out) :: point(n)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => behind(arc)
    point = 0.0d0
    call point_at_factor(tracer_at(handle%arc, origin), points, factor, point, error)
    call report(error, status, message)
end subroutine gbafac
