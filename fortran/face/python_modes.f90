! Modes of solved states for Python, in the manner of face/python.f90, which says what the arguments are

! The first values of modes: factors of the axial forces (WHAT 1), or circular frequencies (2)
subroutine gbmode(beam, state, what, n, values, found, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_state_modes, only: values_of_modes
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: what, n
    ! The first FOUND ones are there
    double precision, intent(out) :: values(n)
    integer, intent(out) :: found, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(error_type), allocatable :: error

    handle => behind(beam)
    solved => behind(state)
    call values_of_modes(handle%beam%lowered, solved%result%state, what, values, found, error)
    call report(error, status, message)
end subroutine gbmode

! How the beam moves in a mode of a VALUE, at PARTS places on every stretch at least; NX places have room, and there are FOUND
subroutine gbshap(beam, state, what, value, parts, nx, x, w, moment, swing, suppt, found, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_state_modes, only: shape_type, shape_of_mode
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: what, parts, nx
    double precision, intent(in) :: value
    ! Places, deflections (the largest 1), moments left and right of the places
    double precision, intent(out) :: x(nx), w(nx), moment(2, nx)
    ! How many times these deflections swing when a support closes or opens first, and which, from 0; infinite and -1: none does
    double precision, intent(out) :: swing
    integer, intent(out) :: suppt, found, status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(error_type), allocatable :: error
    type(shape_type) :: shape

    handle => behind(beam)
    solved => behind(state)
    x = 0.0d0
    w = 0.0d0
    moment = 0.0d0
    swing = 0.0d0
    suppt = 0
    found = 0
    call shape_of_mode(handle%beam%lowered, solved%result%state, what, value, parts, shape, error)
    call report(error, status, message)
    if (allocated(error)) return
    swing = shape%amplitude
    suppt = shape%support - 1
    found = size(shape%x)
    if (found > nx) return
    x(:found) = shape%x
    w(:found) = shape%deflection
    moment(:, :found) = shape%moment
end subroutine gbshap

! How a beam buckles that does not bear its axial forces; NX places have room, and there are FOUND
subroutine gbbuck(beam, state, nx, x, w, found)
    use gapbeam_python_handles, only: error_type, handle_type, behind
    use gapbeam_state_modes, only: shape_of_buckling
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: nx
    ! Places, deflections (the largest 1)
    double precision, intent(out) :: x(nx), w(nx)
    integer, intent(out) :: found
    !f2py threadsafe
    type(handle_type), pointer :: handle, solved
    type(error_type), allocatable :: error
    double precision, allocatable :: places(:), deflections(:)

    handle => behind(beam)
    solved => behind(state)
    x = 0.0d0
    w = 0.0d0
    found = 0
    if (.not. allocated(solved%result%state%ground)) return
    if (.not. allocated(solved%result%state%ground%mode_piece)) return
    call shape_of_buckling(handle%beam%lowered, solved%result%state, places, deflections, error)
    if (allocated(error)) return
    found = size(places)
    if (found > nx) return
    x(:found) = places
    w(:found) = deflections
end subroutine gbbuck
