!> Residuals of eight cases in twice the working precision: gapbeam_residual, number by number.
module gapbeam_lane_residual
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: cache_block
    use gapbeam_tolerances, only: splitter
    use gapbeam_lane_types, only: lanes, lane_beam_type, link_numbers, link_faa, link_fab, link_fbb
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: find_rest, find_rest_at_restraints, find_rest_along

contains

    !> Residuals of all rows
    pure subroutine find_rest(beam, links, n, left, right, force, held, known, spring, w, ml, mr, turn_rest, force_rest, &
                              known_rest)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
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
            plain = 1.0_wp - beam%hinge(i)
            inside = merge(1.0_wp, 0.0_wp, i < n)
            !$omp simd private(faa, fab, fbb, start_high, start_low, high, low, other_high, other_low, turned, turned_rest, &
            !$omp   passed, passed_rest)
            do l = 1, lanes
                faa = links(min(l, stiffness_lanes), link_faa, k)
                fab = links(min(l, stiffness_lanes), link_fab, k)
                fbb = links(min(l, stiffness_lanes), link_fbb, k)
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

    !> Residuals of compatibility on both sides of restraints
    pure subroutine find_rest_at_restraints(beam, links, n, left, right, couple, w, ml, mr, left_rest, turn_rest)
        type(lane_beam_type), intent(in) :: beam
        !> As for find_rest
        integer, intent(in) :: n
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, couple, w, ml, mr
        !> Left and right of them; those of other nodes stay
        real(wp), intent(inout), dimension(lanes, 0:n) :: left_rest, turn_rest
        real(wp) :: c, turn_high, turn_low, high, low
        integer :: i, k, l

        do k = 1, size(beam%restrained)
            i = beam%restrained(k)
            c = beam%compliance(k)
            do l = 1, lanes
                high = ml(l, i)
                low = 0.0_wp
                call add(high, low, -mr(l, i))
                call add(high, low, couple(l, i))
                turn_high = c*low
                turn_low = 0.0_wp
                call add_product(turn_high, turn_low, c, high)
                left_rest(l, i) = 0.0_wp
                turn_rest(l, i) = 0.0_wp
                if (i < n) then
                    high = w(l, i + 1)
                    low = 0.0_wp
                    call add(high, low, -w(l, i))
                    call divide(high, low, beam%length(i + 1))
                    call add_product(high, low, links(min(l, stiffness_lanes), link_faa, i + 1), mr(l, i))
                    call add_product(high, low, links(min(l, stiffness_lanes), link_fab, i + 1), ml(l, i + 1))
                    call add(high, low, -turn_high)
                    call add(high, low, -turn_low)
                    call add(high, low, right(l, i))
                    turn_rest(l, i) = high + low
                end if
                if (i > 0) then
                    high = w(l, i)
                    low = 0.0_wp
                    call add(high, low, -w(l, i - 1))
                    call divide(high, low, beam%length(i))
                    call add_product(high, low, -links(min(l, stiffness_lanes), link_fab, i), mr(l, i - 1))
                    call add_product(high, low, -links(min(l, stiffness_lanes), link_fbb, i), ml(l, i))
                    call add(turn_high, turn_low, -high)
                    call add(turn_high, turn_low, -low)
                    call add(turn_high, turn_low, left(l, i))
                    left_rest(l, i) = turn_high + turn_low
                end if
            end do
        end do
    end subroutine find_rest_at_restraints

    !> The same of one long beam without hinges and couples, of which neighbouring nodes are side by side
    pure subroutine find_rest_along(n, length, faa, fab, fbb, left, right, force, held, known, spring, w, m, turn_rest, shear_rest)
        integer, intent(in) :: n
        !> Links (lane_beam_type)
        real(wp), intent(in), dimension(n) :: length, faa, fab, fbb
        !> As for find_rest, shape (0:n); moments at both sides of nodes
        real(wp), intent(in), dimension(0:n) :: left, right, force, held, known, spring, w, m
        !> Compatibility; equilibrium, or deflection where it is known
        real(wp), intent(out), dimension(0:n) :: turn_rest, shear_rest
        ! Of the links, from that before the first node on: rotations of both ends and shear
        real(wp), dimension(0:cache_block) :: start_high, start_low, end_high, end_low, shear_high, shear_low
        real(wp) :: high, low, other_high, other_low
        integer :: from, to, i, k

        do from = 0, n, cache_block
            to = min(from + cache_block - 1, n)
            ! There are no links beyond the ends
            do k = 0, cache_block, to - from + 1
                start_high(k) = 0.0_wp
                start_low(k) = 0.0_wp
                end_high(k) = 0.0_wp
                end_low(k) = 0.0_wp
                shear_high(k) = 0.0_wp
                shear_low(k) = 0.0_wp
            end do
            !$omp simd private(k, high, low, other_high, other_low)
            do i = max(from, 1), min(to + 1, n)
                k = i - from
                high = w(i)
                low = 0.0_wp
                call add(high, low, -w(i - 1))
                call divide(high, low, length(i))
                other_high = high
                other_low = low
                call add_product(high, low, faa(i), m(i - 1))
                call add_product(high, low, fab(i), m(i))
                start_high(k) = high
                start_low(k) = low
                call add_product(other_high, other_low, -fab(i), m(i - 1))
                call add_product(other_high, other_low, -fbb(i), m(i))
                end_high(k) = other_high
                end_low(k) = other_low
                high = m(i)
                low = 0.0_wp
                call add(high, low, -m(i - 1))
                call divide(high, low, length(i))
                shear_high(k) = high
                shear_low(k) = low
            end do
            !$omp simd private(k, high, low)
            do i = from, to
                k = i - from
                high = start_high(k + 1)
                low = start_low(k + 1)
                call add(high, low, -end_high(k))
                call add(high, low, -end_low(k))
                call add(high, low, left(i))
                call add(high, low, right(i))
                turn_rest(i) = high + low
                high = shear_high(k + 1)
                low = shear_low(k + 1)
                call add(high, low, -shear_high(k))
                call add(high, low, -shear_low(k))
                call add(high, low, force(i))
                call add_product(high, low, -spring(i), w(i))
                shear_rest(i) = (high + low)*(1.0_wp - held(i)) + (known(i) - w(i))*held(i)
            end do
        end do
        turn_rest(0) = 0.0_wp
        turn_rest(n) = 0.0_wp
    end subroutine find_rest_along

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
