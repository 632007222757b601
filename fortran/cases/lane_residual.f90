!> Residuals of eight cases in twice the working precision: gapbeam_residual, number by number.
module gapbeam_lane_residual
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: cache_block
    use gapbeam_tolerances, only: splitter
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, link_numbers, link_faa, link_fab, link_fbb
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: find_rests, find_rest_along

contains

    !> Residuals of the solutions of eight cases
    pure subroutine find_rests(beam, pack)
        type(lane_beam_type), intent(in) :: beam
        !> As the scheme sees it; residuals out
        type(pack_type), intent(inout) :: pack

        call find_rest(beam, pack%links, beam%n, pack%left, pack%right, pack%force, pack%held, pack%known, pack%spring, pack%w, &
                       pack%ml, pack%mr, pack%turn_rest, pack%force_rest, pack%known_rest)
        call find_rest_at_restraints(beam, pack%links, beam%n, pack%left, pack%right, pack%couple, pack%w, pack%ml, pack%mr, &
                                     pack%left_rest, pack%turn_rest)
    end subroutine find_rests

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
                call divide_difference(w(l, k), w(l, i), length, start_high, start_low)
                high = start_high
                low = start_low
                call add_product(high, low, faa, mr(l, i))
                call add_product(high, low, fab, ml(l, k))
                call subtract(high, low, turned, turned_rest)
                call add(high, low, left(l, i))
                call add(high, low, right(l, i))
                turn_rest(l, i) = (high + low)*plain
                call add_product(start_high, start_low, -fab, mr(l, i))
                call add_product(start_high, start_low, -fbb, ml(l, k))
                turned_high(l) = start_high
                turned_low(l) = start_low
                call divide_difference(inside*ml(l, k), inside*mr(l, i), length, other_high, other_low)
                passed_high(l) = other_high
                passed_low(l) = other_low
                call subtract(other_high, other_low, passed, passed_rest)
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
                call turn_of_restraint(c, ml(l, i), mr(l, i), couple(l, i), turn_high, turn_low)
                left_rest(l, i) = 0.0_wp
                turn_rest(l, i) = 0.0_wp
                if (i < n) then
                    call divide_difference(w(l, i + 1), w(l, i), beam%length(i + 1), high, low)
                    call add_product(high, low, links(min(l, stiffness_lanes), link_faa, i + 1), mr(l, i))
                    call add_product(high, low, links(min(l, stiffness_lanes), link_fab, i + 1), ml(l, i + 1))
                    call subtract(high, low, turn_high, turn_low)
                    call add(high, low, right(l, i))
                    turn_rest(l, i) = high + low
                end if
                if (i > 0) then
                    call divide_difference(w(l, i), w(l, i - 1), beam%length(i), high, low)
                    call add_product(high, low, -links(min(l, stiffness_lanes), link_fab, i), mr(l, i - 1))
                    call add_product(high, low, -links(min(l, stiffness_lanes), link_fbb, i), ml(l, i))
                    call subtract(turn_high, turn_low, high, low)
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
        real(wp) :: high, low, link_high, link_low
        integer :: from, to, i, k

        do from = 1, n - 1, cache_block
            to = min(from + cache_block - 1, n - 1)
            call residual_of_block(to - from + 1, length(from:to + 1), faa(from:to + 1), fab(from:to + 1), fbb(from:to + 1), &
                                   left(from:to), right(from:to), force(from:to), known(from:to), spring(from:to), &
                                   held(from:to), m(from - 1:to + 1), w(from - 1:to + 1), turn_rest(from:to), shear_rest(from:to))
        end do
        ! There are no links beyond the ends
        do i = 0, n, n
            k = max(i, 1)
            call divide_difference(m(k), m(k - 1), length(k), link_high, link_low)
            high = 0.0_wp
            low = 0.0_wp
            if (i == 0) then
                high = link_high
                low = link_low
            else
                call subtract(high, low, link_high, link_low)
            end if
            call add(high, low, force(i))
            call add_product(high, low, -spring(i), w(i))
            shear_rest(i) = (high + low)*(1 - held(i)) + (known(i) - w(i))*held(i)
        end do
        turn_rest(0) = 0.0_wp
        turn_rest(n) = 0.0_wp
    end subroutine find_rest_along

    include 'elimination/turn_of_restraint.inc'
    include 'elimination/residual_along.inc'
    include 'elimination/double_double.inc'

end module gapbeam_lane_residual
