!> Stretches whose stiffness is a power of a linear depth, beside integrals in closed form
program test_taper
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp, qp
    use gapbeam_element, only: field_type
    use gapbeam_piece, only: piece_type, piece_load_type, no_load
    use gapbeam_taper, only: mean_softness, find_softness, turn_ends, fields_in_piece, softness_at
    use gapbeam_taper_quad, only: mean_finely => mean_softness
    use gapbeam_taper_extremes, only: find_turning_places, most_places
    use gapbeam_quantities, only: of_deflection, of_rotation, of_curvature
    implicit none
    integer :: status

    call means()
    call link_of_one_taper()
    call means_over_intervals()
    call fields_inside()
    call places_of_extremes()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> int 1/h, int 1/h**3 for depths that grow, shrink, hardly change, and change by 1e4
    subroutine means()
        real(qp), parameter :: ratio(5) = [2.0_qp, 0.5_qp, 1.0_qp + 2.0_qp**(-20), 1e4_qp, 1e-4_qp]
        real(qp) :: closed, found
        integer :: i

        do i = 1, size(ratio)
            associate (r => ratio(i))
                closed = log(r)/(r - 1)
                if (i == 3) closed = series(r - 1)
                found = mean_finely(1.0_qp, 1/r, 1, 1.0_qp)
                call check(abs(found - closed) <= 1e-31_qp*closed, "mean of 1/h in quadruple precision")
                call check_close(mean_softness(1.0_wp, real(1/r, wp), 1, 1.0_wp), real(closed, wp), "mean of 1/h", &
                                 relative=2e-15_wp)
                closed = (1 + 1/r)/(2*r)
                found = mean_finely(1.0_qp, 1/r**3, 3, 1.0_qp)
                call check(abs(found - closed) <= 1e-32_qp*closed, "mean of 1/h**3 in quadruple precision")
                ! To half the length: the depth there is (1 + r)/2
                closed = (1 + 2/(1 + r))/(1 + r)
                call check_close(mean_softness(1.0_wp, real(1/r**3, wp), 3, 0.5_wp), real(closed, wp), &
                                 "mean of 1/h**3 over half the length", relative=4e-15_wp)
            end associate
        end do
    end subroutine means

    !> log(1 + c)/c where c is small
    pure function series(c) result(value)
        real(qp), intent(in) :: c
        real(qp) :: value
        integer :: k

        value = 0.0_qp
        do k = 8, 0, -1
            value = 1/real(k + 1, qp) - c*value
        end do
    end function series

    !> EI from 1 to 2, GA from 3 to 1 over a length of 1: bending ln 2, centroid (1 - ln 2)/ln 2, and turning under q = 1
    subroutine link_of_one_taper()
        type(piece_type) :: piece
        real(wp) :: bending, centre, spread, slip, left, right
        real(wp), parameter :: two = log(2.0_wp)

        piece = piece_type(1.0_wp, 1.0_wp, 1/3.0_wp, 0.0_wp, 0.5_wp, 1.0_wp, 1, 1)
        call find_softness(piece, bending, centre, spread, slip)
        call check_close(bending, two, "int 1/EI")
        call check_close(centre, (1 - two)/two, "centroid")
        call check_close(bending*(spread + centre**2), two - 0.5_wp, "second moment of 1/EI")
        call check_close(slip, log(3.0_wp)/2, "int 1/GA")
        ! M = x (1 - x)/2: int x M/(1 + x) = ln 2 - 2/3
        call turn_ends(piece, 0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, left, right, slip)
        call check_close(right, two - 2/3.0_wp, "int x M/EI under a uniform load", relative=1e-14_wp)
        call check_close(left + right, (1.5_wp - 2*two)/2, "int M/EI under a uniform load", relative=1e-14_wp)
        ! V = 1/2 - x, 1/GA = 1/(3 - 2 x): int = 1/2 - ln(3)/2
        call check_close(slip, 0.5_wp - log(3.0_wp)/2, "int V/GA under a uniform load", relative=1e-14_wp)
    end subroutine link_of_one_taper

    !> A depth from 1 to 100: int 1/(1 + 99 t) = ln(100)/99, int 1/(1 + 99 t)**2 = 1/100
    subroutine means_over_intervals()
        call check_close(mean_softness(1.0_wp, 0.01_wp, 1, 1.0_wp), log(100.0_wp)/99, "1/(1 + 99 t)", relative=1e-14_wp)
        call check_close(mean_softness(1.0_wp, 0.0001_wp, 2, 1.0_wp), 0.01_wp, "1/(1 + 99 t)**2", relative=1e-14_wp)
    end subroutine means_over_intervals

    !> A cantilever that is fixed at its left end: EI = 2 - x, force 1 at the tip; its tip moves by ln 2 - 1/2
    subroutine fields_inside()
        type(piece_type) :: piece
        type(field_type) :: at

        piece = piece_type(1.0_wp, 0.5_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 1, 0)
        at = fields_in_piece(field_type(0.0_wp, 0.0_wp, -1.0_wp, 1.0_wp), 1.0_wp, piece, no_load)
        call check_close(at%deflection, log(2.0_wp) - 0.5_wp, "deflection of the tip")
        call check_close(at%rotation, 1 - log(2.0_wp), "rotation of the tip")
        call check_close(at%moment, 0.0_wp, "moment at the tip", absolute=1e-15_wp)
        call check_close(softness_at(piece, 0.5_wp), [1/1.5_wp, 0.0_wp], "1/EI in the middle")
    end subroutine fields_inside

    !> The same of EI = h**3, h = 2 - x, M = x - 1: curvature is least where 3 (1 - x) = h, x = 1/2; moment zero in the middle
    subroutine places_of_extremes()
        type(piece_type) :: piece
        real(wp) :: places(most_places)
        integer :: number

        piece = piece_type(1.0_wp, 0.125_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 3, 0)
        call find_turning_places(piece, no_load, field_type(0.0_wp, 0.0_wp, -1.0_wp, 1.0_wp), of_curvature, places, number)
        call check(number == 1, "one place of the least curvature")
        call check_close(places(1), 0.5_wp, "where curvature is least")
        call find_turning_places(piece, no_load, field_type(0.0_wp, 0.0_wp, -1.0_wp, 2.0_wp), of_rotation, places, number)
        call check(number == 1, "one place of the largest rotation")
        call check_close(places(1), 0.5_wp, "where the moment is zero")
        call find_turning_places(piece, piece_load_type(0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp), &
                                 field_type(0.0_wp, -0.5_wp, 0.0_wp, 0.0_wp), of_deflection, places, number)
        call check(number == 1, "one place of the largest deflection")
        call check_close(places(1), 0.5_wp, "where the axis is level: psi = kappa x - 1/2")
    end subroutine places_of_extremes

end program test_taper
