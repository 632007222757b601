!> What the rows of eight cases still lack, in twice the working precision: gapbeam_residual for plain nodes and hinges, number
!> by number
module gapbeam_lane_residual
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type
    implicit none
    private
    public :: find_rest

    !> Splits a number into two halves of its bits
    real(wp), parameter :: splitter = 2.0_wp**((digits(1.0_wp) + 1)/2) + 1

contains

    !> Residuals of all rows
    pure subroutine find_rest(beam, n, left, right, force, held, known, spring, w, ml, mr, turn_rest, force_rest, known_rest)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Right-hand sides and scheme, shape (lanes, 0:n)
        real(wp), intent(in) :: left(lanes, 0:n), right(lanes, 0:n), force(lanes, 0:n)
        real(wp), intent(in) :: held(lanes, 0:n), known(lanes, 0:n), spring(lanes, 0:n)
        !> Solution
        real(wp), intent(in) :: w(lanes, 0:n), ml(lanes, 0:n), mr(lanes, 0:n)
        !> Compatibility, equilibrium where the deflection is not known, deflection where it is
        real(wp), intent(out) :: turn_rest(lanes, 0:n), force_rest(lanes, 0:n), known_rest(lanes, 0:n)
        ! Of the link left of the node: rotation of its right end and shear
        real(wp), dimension(lanes) :: turned_high, turned_low, passed_high, passed_low
        real(wp) :: length, faa, fab, fbb, plain, inside
        real(wp) :: start_high, start_low, high, low, other_high, other_low, turned, turned_rest, passed, passed_rest
        integer :: i, k, l

        turned_high(:) = 0.0_wp
        turned_low(:) = 0.0_wp
        passed_high(:) = 0.0_wp
        passed_low(:) = 0.0_wp
        do i = 0, n
            ! The link right of the last node is none
            k = min(i + 1, n)
            length = beam%length(k)
            faa = beam%faa(k)
            fab = beam%fab(k)
            fbb = beam%fbb(k)
            plain = 1.0_wp - beam%hinge(i)
            inside = merge(1.0_wp, 0.0_wp, i < n)
            !$omp simd private(start_high, start_low, high, low, other_high, other_low, turned, turned_rest, passed, passed_rest)
            do l = 1, lanes
                turned = turned_high(l)
                turned_rest = turned_low(l)
                passed = passed_high(l)
                passed_rest = passed_low(l)
                start_high = w(l, k)
                start_low = 0.0_wp
                call add(start_high, start_low, -w(l, i))
                call divide(start_high, start_low, length)
                high = start_high
                low = start_low
                call add_product(high, low, faa, mr(l, i))
                call add_product(high, low, fab, ml(l, k))
                call add(high, low, -turned)
                call add(high, low, -turned_rest)
                call add(high, low, left(l, i))
                call add(high, low, right(l, i))
                turn_rest(l, i) = (high + low)*plain
                call add_product(start_high, start_low, -fab, mr(l, i))
                call add_product(start_high, start_low, -fbb, ml(l, k))
                turned_high(l) = start_high
                turned_low(l) = start_low
                other_high = inside*ml(l, k)
                other_low = 0.0_wp
                call add(other_high, other_low, -(inside*mr(l, i)))
                call divide(other_high, other_low, length)
                passed_high(l) = other_high
                passed_low(l) = other_low
                call add(other_high, other_low, -passed)
                call add(other_high, other_low, -passed_rest)
                call add(other_high, other_low, force(l, i))
                call add_product(other_high, other_low, -spring(l, i), w(l, i))
                force_rest(l, i) = (other_high + other_low)*(1.0_wp - held(l, i))
                known_rest(l, i) = (known(l, i) - w(l, i))*held(l, i)
            end do
        end do
        turn_rest(:, 0) = 0.0_wp
        turn_rest(:, n) = 0.0_wp
    end subroutine find_rest

    !> x + y, the rounding error collected in the low part
    elemental subroutine add(high, low, y)
        real(wp), intent(inout) :: high, low
        real(wp), intent(in) :: y
        real(wp) :: z, t

        z = high + y
        t = z - high
        low = low + ((high - (z - t)) + (y - t))
        high = z
    end subroutine add

    !> x + a b
    elemental subroutine add_product(high, low, a, b)
        real(wp), intent(inout) :: high, low
        real(wp), intent(in) :: a, b
        real(wp) :: p, a1, a2, b1, b2

        p = a*b
        a1 = splitter*a
        a1 = a1 - (a1 - a)
        a2 = a - a1
        b1 = splitter*b
        b1 = b1 - (b1 - b)
        b2 = b - b1
        call add(high, low, p)
        low = low + (((a1*b1 - p) + a1*b2 + a2*b1) + a2*b2)
    end subroutine add_product

    !> x/y
    elemental subroutine divide(high, low, y)
        real(wp), intent(inout) :: high, low
        real(wp), intent(in) :: y
        real(wp) :: q

        q = high/y
        call add_product(high, low, -q, y)
        low = (high + low)/y
        high = q
    end subroutine divide

end module gapbeam_lane_residual
