! Laws of supports for Python, in the manner of face/python.f90: what stands in gapbeam_laws

! A curve at a displacement past the gap, 0 or more: force and slope; and the scale that it has everywhere
subroutine gblawv(law, param, past, values)
    use gapbeam_laws, only: law_force, law_slope, law_scale
    implicit none
    integer, intent(in) :: law
    double precision, intent(in) :: param(3), past
    double precision, intent(out) :: values(3)

    values = [law_force(law, param, past), law_slope(law, param, past), law_scale(law, param)]
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

    allocate (found, source=law_points(law, param))
    n = size(found, 2)
    points = 0.0d0
    points(:, :n) = found
end subroutine gblawp
