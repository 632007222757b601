!> Crossings and peaks on elastic ground: against dense sampling, against quadruple precision, and where rounding could make some up
program test_foundation_roots
    use, intrinsic :: iso_fortran_env, only: int64
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp, qp
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_foundation_roots, only: find_crossings, find_peaks
    use gapbeam_foundation_quad, only: stretch_quad => stretch_type, load_quad => stretch_load_type, &
        ends_quad => stretch_ends_type
    use gapbeam_foundation_roots_quad, only: crossings_quad => find_crossings, peaks_quad => find_peaks
    implicit none
    integer :: status

    call against_samples()
    call fading_waves()
    call long_middle()
    call contact_ends()
    call touching()
    call cubic()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> The next of a sequence of numbers in 0..1 (Park and Miller 1988)
    subroutine draw(seed, u)
        integer(int64), intent(inout) :: seed
        real(wp), intent(out) :: u

        seed = mod(16807*seed, 2147483647_int64)
        u = real(seed, wp)/2147483647.0_wp
    end subroutine draw

    !> A stretch, its load and ends, and a line, drawn at random
    subroutine draw_all(seed, stretch, load, ends, line)
        integer(int64), intent(inout) :: seed
        type(stretch_type), intent(out) :: stretch
        type(stretch_load_type), intent(out) :: load
        type(stretch_ends_type), intent(out) :: ends
        real(wp), intent(out) :: line(2)
        real(wp) :: u(16), theta
        integer :: i

        do i = 1, size(u)
            call draw(seed, u(i))
        end do
        stretch%length = 0.5_wp + 2*u(1)
        stretch%flexibility = 10**(2*u(2) - 1)
        theta = 10**(2.3_wp*u(3) - 1)
        if (u(4) < 0.2_wp) theta = u(3)
        stretch%modulus_a = 4*theta**4/(stretch%flexibility*stretch%length**4)
        stretch%modulus_b = stretch%modulus_a
        if (u(4) < 0.2_wp) stretch%modulus_b = stretch%modulus_a*u(5)
        if (u(6) < 0.4_wp) stretch%shear_flexibility = stretch%flexibility*stretch%length**2*u(7)*10/(1 + theta**3)
        if (u(6) < 0.1_wp .and. theta < 3.0_wp .and. u(4) >= 0.2_wp) then
            stretch%flexibility = 0.0_wp
            stretch%modulus_a = theta**2/stretch%length**2
            stretch%modulus_b = stretch%modulus_a
            stretch%shear_flexibility = 10*u(7)
        end if
        if (u(8) < 0.7_wp) load = stretch_load_type(2*u(9) - 1, 2*u(10) - 1, merge(u(10), 0.0_wp, u(8) < 0.1_wp), 0.0_wp)
        load%qa = load%qa*stretch%modulus_a*0.1_wp
        load%qb = load%qb*stretch%modulus_a*0.1_wp
        load%qc = load%qc*stretch%modulus_a
        if (u(8) > 0.6_wp) load%kappa = u(9) - 0.5_wp
        ends = stretch_ends_type(2*u(11) - 1, 2*u(12) - 1, 2*u(13) - 1, 2*u(14) - 1)
        if (stretch%flexibility > 0.0_wp) then
            ends%moment_a = ends%moment_a*(1 + theta**2)/(stretch%flexibility*stretch%length**2)
            ends%moment_b = ends%moment_b*(1 + theta**2)/(stretch%flexibility*stretch%length**2)
        end if
        line = 0.1_wp*[2*u(15) - 1, 2*u(16) - 1]
        if (u(5) < 0.3_wp) line = 0.0_wp
    end subroutine draw_all

    !> Every change of sign between 1000 samples has its zero, and no other is there; doubles and quadruple precision agree
    subroutine against_samples()
        integer, parameter :: samples = 1000
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        type(stretch_ends_type) :: ends
        real(wp), allocatable :: xi(:)
        real(qp), allocatable :: exact(:)
        real(wp) :: line(2), f, before, w, psi, moment, shear, scale, error, worst
        integer(int64) :: seed
        integer :: i, j, k, what, number, number_exact, seen, missed, invented, differing, zeros, zeros_exact

        seed = 4711
        missed = 0
        invented = 0
        differing = 0
        zeros = 0
        worst = 0.0_wp
        do k = 1, 150
            call draw_all(seed, stretch, load, ends, line)
            do what = 0, 4
                if (what == 0) then
                    call find_crossings(stretch, load, ends, reshape(line, [2, 1]), xi)
                    call crossings_quad(in_quad(stretch), load_in_quad(load), ends_in_quad(ends), &
                                        reshape(real(line, qp), [2, 1]), exact)
                else
                    call find_peaks(stretch, load, ends, [what], xi)
                    call peaks_quad(in_quad(stretch), load_in_quad(load), ends_in_quad(ends), [what], exact)
                end if
                number = size(xi)
                number_exact = size(exact)
                zeros = zeros + number
                if (number > 1) then
                    if (any(xi(2:) <= xi(:number - 1))) invented = invented + 1
                end if
                before = 0.0_wp
                scale = 0.0_wp
                seen = 0
                do i = 0, samples
                    call fields_at(stretch, load, ends, real(i, wp)/samples, w, psi, moment, shear)
                    f = chosen(what, stretch, load, real(i, wp)/samples, w, psi, moment, shear, line)
                    scale = max(scale, abs(f))
                    ! Samples nearer to zero than rounding say nothing
                    if (abs(f) < 1e-11_wp*scale) cycle
                    if (f*sign(1.0_wp, before) < 0.0_wp .and. abs(before) > 0.0_wp) seen = seen + 1
                    before = f
                end do
                zeros_exact = 0
                do i = 1, number_exact
                    do j = 1, number
                        if (abs(xi(j) - exact(i)) < 1e-6_wp) then
                            zeros_exact = zeros_exact + 1
                            exit
                        end if
                    end do
                end do
                if (seen > number) missed = missed + 1
                ! Those more than seen must be there in quadruple precision
                if (number > number_exact .or. zeros_exact < number) invented = invented + 1
                do i = 1, number
                    call fields_at(stretch, load, ends, xi(i), w, psi, moment, shear)
                    f = chosen(what, stretch, load, xi(i), w, psi, moment, shear, line)
                    error = abs(f)/scale
                    worst = max(worst, error)
                end do
            end do
        end do
        call check(zeros > 500, "there are zeros")
        call check(missed == 0, "no zero is missed")
        call check(invented == 0, "no zero is made up")
        call check_close(worst, 0.0_wp, "values at zeros", absolute=1e-13_wp)
    end subroutine against_samples

    !> The function whose zeros are sought
    function chosen(what, stretch, load, xi, w, psi, moment, shear, line) result(f)
        integer, intent(in) :: what
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        real(wp), intent(in) :: xi, w, psi, moment, shear, line(2)
        real(wp) :: f

        select case (what)
        case (0)
            f = w - (line(1)*(1 - xi) + line(2)*xi)
        case (1)
            f = psi + stretch%shear_flexibility*shear
        case (2)
            f = load%kappa - stretch%flexibility*moment
        case (3)
            f = shear
        case default
            f = (stretch%modulus_a*(1 - xi) + stretch%modulus_b*xi)*w &
                - (load%qa*(1 - xi) + load%qb*xi + load%qc*xi*(1 - xi))
        end select
    end function chosen

    function in_quad(s) result(q)
        type(stretch_type), intent(in) :: s
        type(stretch_quad) :: q

        q = stretch_quad(real(s%length, qp), real(s%flexibility, qp), real(s%shear_flexibility, qp), &
                         real(s%modulus_a, qp), real(s%modulus_b, qp))
    end function in_quad

    function load_in_quad(s) result(q)
        type(stretch_load_type), intent(in) :: s
        type(load_quad) :: q

        q = load_quad(real(s%qa, qp), real(s%qb, qp), real(s%qc, qp), real(s%kappa, qp))
    end function load_in_quad

    function ends_in_quad(s) result(q)
        type(stretch_ends_type), intent(in) :: s
        type(ends_quad) :: q

        q = ends_quad(real(s%w_a, qp), real(s%w_b, qp), real(s%moment_a, qp), real(s%moment_b, qp))
    end function ends_in_quad

    !> A half-infinite beam pushed down at its end, w = exp(-t) cos t with t = beta x: zeros at (n + 1/2) pi
    subroutine fading_waves()
        type(stretch_type) :: stretch
        real(wp), allocatable :: xi(:)
        real(wp), parameter :: pi = acos(-1.0_wp)
        integer :: i, n

        stretch = stretch_type(length=200.0_wp, flexibility=1.0_wp, modulus_a=4.0_wp, modulus_b=4.0_wp)
        call find_crossings(stretch, stretch_load_type(), stretch_ends_type(1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp), &
                            level_lines([0.0_wp]), xi)
        n = min(size(xi), 10)
        call check(size(xi) >= 10, "waves fade, and cross zero")
        call check_close(200*xi(:n), [((i - 0.5_wp)*pi, i=1, n)], "where they do", 1e-14_wp)
        call find_peaks(stretch, stretch_load_type(), stretch_ends_type(1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp), [1], xi)
        call check_close(200*xi(:n), [((i - 0.25_wp)*pi, i=1, n)], "where they peak", 1e-14_wp)
    end subroutine fading_waves

    !> Far from the ends the load stands on the ground: q/K crosses a line there, whatever the ends do
    subroutine long_middle()
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        real(wp), allocatable :: xi(:)

        stretch = stretch_type(length=10000.0_wp, flexibility=1.0_wp, modulus_a=4.0_wp, modulus_b=4.0_wp)
        load = stretch_load_type(qa=1.0_wp, qb=5.0_wp)
        call find_crossings(stretch, load, stretch_ends_type(0.25_wp, 1.25_wp, 0.0_wp, 0.0_wp), &
                            level_lines([0.5_wp]), xi)
        call check(size(xi) == 1, "one crossing far from the ends")
        call check_close(xi, [0.25_wp], "where it is", 1e-15_wp)
        call find_peaks(stretch, stretch_load_type(qa=4.0_wp, qb=4.0_wp, qc=1.0_wp), &
                        stretch_ends_type(1.0_wp, 1.0_wp, 0.5_wp/1e8_wp, 0.5_wp/1e8_wp), [1], xi)
        call check(count(abs(xi - 0.5_wp) < 1e-12_wp) == 1, "peak far from the ends")
    end subroutine long_middle

    !> Ends at which the beam lifts off are zeros themselves: nothing is found beside them
    subroutine contact_ends()
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        type(stretch_ends_type) :: ends
        real(wp), allocatable :: xi(:)
        real(wp) :: line(2)
        integer(int64) :: seed
        integer :: k, beside

        seed = 815
        beside = 0
        do k = 1, 2000
            call draw_all(seed, stretch, load, ends, line)
            call find_crossings(stretch, load, ends, reshape([ends%w_a, ends%w_b], [2, 1]), xi)
            if (any(xi < 1e-13_wp .or. xi > 1 - 1e-13_wp)) beside = beside + 1
        end do
        call check(beside == 0, "no crossing beside an end that is one")
    end subroutine contact_ends

    !> A line that touches the deflection: no crossing; moved to one side two, to the other none
    subroutine touching()
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        type(stretch_ends_type) :: ends
        real(wp), allocatable :: xi(:)
        real(wp) :: top, psi, moment, shear

        stretch = stretch_type(length=3.0_wp, flexibility=0.7_wp, shear_flexibility=0.01_wp, modulus_a=0.3_wp, modulus_b=0.3_wp)
        load = stretch_load_type(qa=1.0_wp, qb=1.0_wp)
        ends = stretch_ends_type()
        call fields_at(stretch, load, ends, 0.5_wp, top, psi, moment, shear)
        call find_crossings(stretch, load, ends, level_lines([top]), xi)
        call check(size(xi) == 0, "touching is no crossing")
        call find_crossings(stretch, load, ends, level_lines([top*(1 - 1e-12_wp)]), xi)
        call check(size(xi) == 2, "two crossings near to each other")
        call find_crossings(stretch, load, ends, level_lines([top*(1 + 1e-12_wp)]), xi)
        call check(size(xi) == 0, "a line just beyond")
        call find_crossings(stretch, load, ends, level_lines(top*[1 - 1e-12_wp, 1 + 1e-12_wp, 1 - 1e-12_wp]), xi)
        call check(size(xi) == 4, "crossings of several lines")
        call check_close(xi(3:), xi(:2), "line after line", 0.0_wp)
    end subroutine touching

    !> Without ground: the cubic of a bar with end moments, w = xi (1 - xi)(1 - 2 xi), has its zero and its peaks in closed form
    subroutine cubic()
        type(stretch_type) :: stretch
        type(stretch_ends_type) :: ends
        real(wp), allocatable :: xi(:)
        integer :: numbers(3)

        stretch = stretch_type(length=2.0_wp, flexibility=0.5_wp)
        ! w'' = (-6 + 12 xi)/L**2 = -M/EI
        ends = stretch_ends_type(0.0_wp, 0.0_wp, 3.0_wp, -3.0_wp)
        call find_crossings(stretch, stretch_load_type(), ends, level_lines([0.0_wp]), xi)
        call check_close(xi, [0.5_wp], "zero of a cubic", 1e-15_wp)
        call find_peaks(stretch, stretch_load_type(), ends, [1], xi)
        call check_close(xi, [0.5_wp - sqrt(1/12.0_wp), 0.5_wp + sqrt(1/12.0_wp)], "peaks of a cubic", 1e-15_wp)
        call find_peaks(stretch, stretch_load_type(), ends, [3], xi)
        call check(size(xi) == 0, "no peak of a straight moment")
        call find_peaks(stretch, stretch_load_type(), ends, [1, 3, 2], xi, numbers=numbers)
        call check(all(numbers == [2, 0, 1]), "peaks of several fields")
        call check_close(xi(3), 0.5_wp, "field after field", 1e-15_wp)
        call find_peaks(stretch, stretch_load_type(), ends, [2], xi)
        call check_close(xi, [0.5_wp], "peak of a parabola", 1e-15_wp)
    end subroutine cubic

    !> Lines along the stretch at some levels
    pure function level_lines(levels) result(lines)
        real(wp), intent(in) :: levels(:)
        real(wp) :: lines(2, size(levels))

        lines(1, :) = levels
        lines(2, :) = levels
    end function level_lines

end program test_foundation_roots
