!> Bars on springs and sliders along them: random ones, soft and stiff, under loads that turn
program test_bedding
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp, qp
    use gapbeam_exponential_curve, only: curve_type, new_curve, value_of, roots_of, most_roots
    use gapbeam_axial_bedding, only: bedding_type, loads_type, give_way, force_at, is_bedded
    use gapbeam_bedding_zones, only: new_bedding, start_anew, find_zones
    implicit none
    integer :: status

    call roots()
    call random_bars()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> All roots, of a curve with three of them too
    subroutine roots()
        type(curve_type) :: curve
        real(qp) :: found(most_roots)
        integer :: i, n

        curve = new_curve(0.0_qp, 1.0_qp, [0.0_qp, 0.0_qp, 0.0_qp, 0.0_qp], 0.0_qp, -1.0_qp, 2.0_qp)
        call roots_of(curve, found, n)
        call check(n == 1, "a straight line has one")
        call check_close(real(found(1), wp), 1/3.0_wp, "of a straight line")
        ! (x - 0.2)(x - 0.5)(x - 0.9)
        curve = new_curve(0.0_qp, 1.0_qp, [-0.09_qp, 0.73_qp, -1.6_qp, 1.0_qp], 0.0_qp, 0.0_qp, 0.0_qp)
        call roots_of(curve, found, n)
        call check(n == 3, "three of a cubic")
        call check_close(real(found(:3), wp), [0.2_wp, 0.5_wp, 0.9_wp], "of a cubic")
        ! Two of them, and the turns beside them, lie on one side of the middle
        curve = new_curve(0.0_qp, 1.0_qp, [-2.25_qp, 3.0_qp, 0.0_qp, 0.0_qp], 3.0_qp, 4.48_qp - exp(-3.0_qp), &
                          4.48_qp*exp(-3.0_qp) - 1.0_qp)
        call roots_of(curve, found, n)
        call check(n == 3, "three of a line and two exponentials")
        do i = 1, n
            call check_close(real(value_of(curve, found(i)), wp), 0.0_wp, "there it is 0", absolute=1e-30_wp)
        end do
    end subroutine roots

    !> Equilibrium of nodes and parts, and the law of the ground, at the ends of legs
    subroutine random_bars()
        type(bedding_type) :: bedding
        type(loads_type) :: loads
        real(wp), allocatable :: softness(:), stiffness(:), limit(:, :), support(:)
        real(wp) :: x(4)
        integer :: seed, n, j, leg, found, slid, size_of_seed
        logical :: settled, sound

        call random_seed(size=size_of_seed)
        call random_seed(put=[(j, j=1, size_of_seed)])
        found = 0
        slid = 0
        sound = .true.
        do seed = 1, 25
            call random_number(x)
            n = 1 + int(6*x(1))
            allocate (softness(n), stiffness(n), limit(2, n), support(0:n), loads%node(0:n), loads%along(n), loads%longer(n))
            support(:) = 0.0_wp
            if (x(2) < 0.4_wp) support(int((n + 1)*x(3))) = 10.0_wp**(4*x(4))
            do j = 1, n
                call random_number(x)
                softness(j) = 10.0_wp**(2*x(1) - 1)
                stiffness(j) = 10.0_wp**(5*x(2) - 2)
                limit(:, j) = x(3:4)
            end do
            call random_number(x)
            if (x(1) < 0.2_wp) limit(:, 1 + int(n*x(2))) = 0.0_wp
            if (x(1) > 0.8_wp) limit(:, 1 + int(n*x(2))) = huge(1.0_wp)
            call new_bedding(softness, stiffness, limit, support, bedding)
            do leg = 1, 3
                call random_loads(loads)
                ! What no ground takes slides away
                if (.not. any(support > 0.0_wp)) loads%node(:) = loads%node*min(1.0_qp, sum(min(bedding%limit, 1.0_qp)) &
                                                                                /(4*sum(abs(loads%node))))
                call find_zones(bedding, loads, settled)
                if (.not. settled) exit
                found = found + 1
                slid = slid + merge(1, 0, any(bedding%cells%way /= 0))
                sound = sound .and. is_sound(bedding)
                call start_anew(bedding)
            end do
            deallocate (softness, stiffness, limit, support, loads%node, loads%along, loads%longer)
        end do
        call check(found >= 70, "states of bars are found")
        call check(slid >= 25, "of these many slide")
        call check(sound, "they stand their checks")
    end subroutine random_bars

    !> Forces at nodes and elongations
    subroutine random_loads(loads)
        type(loads_type), intent(inout) :: loads
        real(wp) :: node(size(loads%node)), longer(size(loads%longer))

        call random_number(node)
        call random_number(longer)
        loads%node(:) = real(node - 0.5_wp, qp)
        loads%along(:) = 0.0_qp
        loads%longer(:) = real(longer - 0.5_wp, qp)
    end subroutine random_loads

    !> Do forces balance, and does the ground take what its law says
    function is_sound(bedding) result(sound)
        type(bedding_type), intent(in) :: bedding
        logical :: sound
        real(qp) :: off(0:size(bedding%softness)), push, limit, middle
        integer :: k

        off(:) = bedding%loads%node - bedding%support*bedding%displacement
        sound = .true.
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k), j => bedding%cells(k)%bar)
                if (.not. cell%from > 0.0_qp) off(j - 1) = off(j - 1) + force_at(bedding, cell, cell%from)
                if (.not. cell%to < 1.0_qp) off(j) = off(j) - force_at(bedding, cell, cell%to)
                if (.not. is_bedded(bedding, j)) cycle
                middle = (cell%from + cell%to)/2
                push = value_of(give_way(bedding, cell), middle)
                limit = bedding%limit(1, j) + middle*(bedding%limit(2, j) - bedding%limit(1, j))
                if (cell%way == 0) sound = sound .and. abs(push) <= limit*(1 + 1e-12_qp)
                if (cell%way /= 0) sound = sound .and. cell%way*push >= limit*(1 - 1e-12_qp)
            end associate
        end do
        sound = sound .and. maxval(abs(off)) < 1e-15_qp
    end function is_sound

end program test_bedding
