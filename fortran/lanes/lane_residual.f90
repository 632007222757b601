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
    pure subroutine find_rest(beam, n, left, right, force, held, known, spring, w, ml, mr, room, turn_rest, force_rest, known_rest)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Right-hand sides and scheme, shape (lanes, 0:n)
        real(wp), intent(in) :: left(lanes, 0:n), right(lanes, 0:n), force(lanes, 0:n)
        real(wp), intent(in) :: held(lanes, 0:n), known(lanes, 0:n), spring(lanes, 0:n)
        !> Solution
        real(wp), intent(in) :: w(lanes, 0:n), ml(lanes, 0:n), mr(lanes, 0:n)
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Compatibility, equilibrium where the deflection is not known, deflection where it is
        real(wp), intent(out) :: turn_rest(lanes, 0:n), force_rest(lanes, 0:n), known_rest(lanes, 0:n)
        real(wp) :: length, faa, fab, fbb, plain
        real(wp) :: high, low, turn_high, turn_low, other_high, other_low, minus_high, minus_low, free
        integer :: i, l

        room(:, 0, 1:4) = 0.0_wp
        room(:, n, 5:8) = 0.0_wp
        do i = 1, n
            length = beam%length(i)
            faa = beam%faa(i)
            fab = beam%fab(i)
            fbb = beam%fbb(i)
            !$omp simd private(high, low, turn_high, turn_low, other_high, other_low)
            do l = 1, lanes
                high = w(l, i)
                low = 0.0_wp
                call add(high, low, -w(l, i - 1))
                call divide(high, low, length)
                turn_high = high
                turn_low = low
                call add_product(turn_high, turn_low, faa, mr(l, i - 1))
                call add_product(turn_high, turn_low, fab, ml(l, i))
                room(l, i - 1, 5) = turn_high
                room(l, i - 1, 6) = turn_low
                call add_product(high, low, -fab, mr(l, i - 1))
                call add_product(high, low, -fbb, ml(l, i))
                room(l, i, 1) = high
                room(l, i, 2) = low
                other_high = ml(l, i)
                other_low = 0.0_wp
                call add(other_high, other_low, -mr(l, i - 1))
                call divide(other_high, other_low, length)
                room(l, i, 3) = other_high
                room(l, i, 4) = other_low
                room(l, i - 1, 7) = other_high
                room(l, i - 1, 8) = other_low
            end do
        end do
        do i = 0, n
            plain = 1.0_wp - beam%hinge(i)
            !$omp simd private(high, low, minus_high, minus_low, free)
            do l = 1, lanes
                high = room(l, i, 5)
                low = room(l, i, 6)
                minus_high = room(l, i, 1)
                minus_low = room(l, i, 2)
                call add(high, low, -minus_high)
                call add(high, low, -minus_low)
                call add(high, low, left(l, i))
                call add(high, low, right(l, i))
                turn_rest(l, i) = (high + low)*plain
                free = 1.0_wp - held(l, i)
                high = room(l, i, 7)
                low = room(l, i, 8)
                minus_high = room(l, i, 3)
                minus_low = room(l, i, 4)
                call add(high, low, -minus_high)
                call add(high, low, -minus_low)
                call add(high, low, force(l, i))
                call add_product(high, low, -spring(l, i), w(l, i))
                force_rest(l, i) = (high + low)*free
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
