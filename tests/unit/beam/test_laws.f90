!> The table of laws: slopes and work beside differences and sums of forces, inverses, polylines
program test_laws
    use gapbeam_kinds, only: wp
    use testing, only: check, finish
    use gapbeam_laws, only: law_plastic, law_hardening, law_hyperbolic, law_tanh, law_cubic, law_power, law_brittle, is_smooth, &
        begins_steep, law_force, law_slope, law_energy, law_displacement, law_bound, law_scale, law_points
    implicit none
    integer :: status

    call one_curve(law_tanh, [4e3_wp, 36.0_wp, 0.0_wp])
    call one_curve(law_hyperbolic, [4e3_wp, 36.0_wp, 0.0_wp])
    call one_curve(law_cubic, [400.0_wp, -1e3_wp, 1e5_wp])
    call one_curve(law_cubic, [0.0_wp, 0.0_wp, 1e5_wp])
    call one_curve(law_power, [0.01_wp, 36.0_wp, 0.33_wp])
    call one_curve(law_power, [0.01_wp, 36.0_wp, 3.0_wp])
    call polylines()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A curve at displacements from far below its scale to beyond it
    subroutine one_curve(law, p)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(3)
        real(wp), allocatable :: points(:, :)
        real(wp) :: u, step, difference, work, middle
        integer :: i, k

        call check(is_smooth(law), "a curve")
        do i = -12, 2
            u = law_scale(law, p)*2.0_wp**i
            step = u*1e-4_wp
            difference = (law_force(law, p, u + step) - law_force(law, p, u - step))/(2*step)
            call check(abs(difference - law_slope(law, p, u)) <= 1e-6_wp*abs(law_slope(law, p, u)) + 1e-9_wp, "slope")
            ! The work of the second half of the way, by Simpson's rule in parts
            work = 0.0_wp
            do k = 0, 63
                middle = u/2*(1 + (k + 0.5_wp)/64)
                work = work + u/128*(law_force(law, p, middle - u/256) + 4*law_force(law, p, middle) &
                                     + law_force(law, p, middle + u/256))/6
            end do
            difference = law_energy(law, p, u) - law_energy(law, p, u/2)
            call check(abs(difference - work) <= 1e-8_wp*work, "work")
            if (begins_steep(law, p)) then
                call check(abs(law_displacement(law, p, law_force(law, p, u)) - u) <= 1e-14_wp*u, "inverse")
            end if
            call check(law_force(law, p, u) <= law_bound(law, p), "bound")
        end do
        allocate (points, source=law_points(law, p))
        call check(size(points, 2) > 30 .and. all(points(1, 2:) > points(1, :size(points, 2) - 1)), "polyline in order")
        call check(.not. law_energy(law, p, -1.0_wp) > 0.0_wp, "no work before contact")
    end subroutine one_curve

    !> Laws that are polylines
    subroutine polylines()
        call check(all(abs(law_points(law_plastic, [100.0_wp, 5.0_wp]) &
                           - reshape([0.05_wp, 5.0_wp, 0.1_wp, 5.0_wp], [2, 2])) < 1e-15_wp), "plastic")
        call check(all(abs(law_points(law_brittle, [100.0_wp, 5.0_wp]) &
                           - reshape([0.05_wp, 5.0_wp, 0.05_wp, 0.0_wp, 0.1_wp, 0.0_wp], [2, 3])) < 1e-15_wp), "brittle")
        call check(all(abs(law_points(law_hardening, [100.0_wp, 5.0_wp, 200.0_wp]) &
                           - reshape([0.05_wp, 5.0_wp, 0.1_wp, 15.0_wp], [2, 2])) < 1e-14_wp), "hardening")
    end subroutine polylines

end program test_laws
