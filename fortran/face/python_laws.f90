! Laws of supports for Python, in the manner of face/python.f90: what stands in gapbeam_laws

! A curve at a displacement past the gap, 0 or more: force, slope and work; and the scale that it has everywhere
subroutine gblawv(law, param, past, values)
    use gapbeam_laws, only: law_force, law_slope, law_energy, law_scale
    implicit none
    integer, intent(in) :: law
    double precision, intent(in) :: param(3), past
    double precision, intent(out) :: values(4)

    values = [law_force(law, param, past), law_slope(law, param, past), law_energy(law, param, past), law_scale(law, param)]
end subroutine gblawv

! The polyline of a law: displacements and forces of N points
subroutine gblawp(law, param, n, points)
    use gapbeam_laws, only: law_points
    implicit none
    integer, intent(in) :: law
    double precision, intent(in) :: param(3)
    integer, intent(out) :: n
    double precision, intent(out) :: points(2, 256)
    double precision, allocatable :: found(:, :)

    found = law_points(law, param)
    n = size(found, 2)
    points = 0.0d0
    points(:, :n) = found
end subroutine gblawp

! Load factor at which support or breakpoint NUMBER (from 1) changes its state on the smooth laws, from that on their polylines
subroutine gblawe(beam, ns, closed, number, factor, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_smooth_events, only: find_on_laws
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: ns
    ! The scheme before, with one entry more than there are supports
    integer, intent(in) :: closed(ns), number
    double precision, intent(inout) :: factor
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py intent(in, out) :: factor
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => behind(beam)
    call find_on_laws(handle%beam%lowered, closed(:ns - 1) /= 0, number, factor, error)
    call report(error, status, message)
end subroutine gblawe
