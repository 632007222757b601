!> Fields at the left ends of all pieces of eight cases, from their solutions at the nodes.
!> That is gapbeam_recover and recover_link of gapbeam_link side by side. Places are the same in all cases, so sums of lengths are
!> made once (lane_pieces_type).
module gapbeam_lane_fields
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: worst_shear_digits, greatest_product, smallest_product
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, pack_type, piece_pack_type, link_numbers, &
        link_faa, link_fab, link_sum_a, link_sum_b, link_bending
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_search, only: add_loads, apply_scheme
    use gapbeam_lane_reactions, only: find_shears
    use gapbeam_lane_shared, only: keep_loads, join_supports
    implicit none
    private
    public :: recover_pack, find_rotations

contains

    !> Fields of eight solved cases
    pure subroutine recover_pack(beam, pieces, factors, pack, fields, poor)
        !> What the cases have in common
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        !> Factor of every load, shape (lanes, nload)
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Supports, contact states and solutions
        type(pack_type), intent(inout) :: pack
        !> Loads and starts of the pieces
        type(piece_pack_type), intent(inout) :: fields
        !> 1 where a shear is known to few digits from the moments, or numbers are far from 1
        real(wp), intent(out) :: poor(lanes)
        integer :: n, last

        n = beam%n
        last = ubound(pack%closed, 2)
        call add_loads(beam, n, factors, pack%left, pack%right, pack%shear, pack%couple, pack%load_size, pack%turn_size, &
                       pack%room, pack%force)
        if (last > n) then
            call keep_loads(beam, n, pack%shear, pack%load)
            pack%turn_rest(:, :) = 0.0_wp   ! no support is to be changed
            call join_supports(beam, n, last, pack%load, pack%turn_rest, pack%closed, pack%stiffness, pack%rigid, pack%contact, &
                               pack%shear)
        end if
        call apply_scheme(n, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%held, pack%known, &
                          pack%spring, pack%force)
        call find_shears(beam, n, pack%held, pack%spring, pack%force, pack%w, pack%ml, pack%mr, pack%room)
        call find_rotations(beam, pack%links, n, pack%left, pack%right, pack%w, pack%ml, pack%mr, pack%room)
        call check_shears(n, pack%room, poor)
        call add_piece_loads(pieces, size(pieces%length), factors, fields%loads)
        call recover(beam, pieces, n, size(pieces%length), fields%loads, pack%w, pack%ml, pack%mr, pack%room, fields%room, &
                     fields%starts)
        call check_range(size(pieces%length), fields%starts, poor)
    end subroutine recover_pack

    !> Rotations at the left ends of the links in room 1, with room 2 to 4: end_rotations of gapbeam_recover
    pure subroutine find_rotations(beam, links, n, left, right, w, ml, mr, room)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, w, ml, mr
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        real(wp) :: faa, fab, sum_a, sum_b, bending, turn_a, turn_b, m, z, psi, size, other, other_size, crosses
        integer :: i, j, k, l, way

        do i = 1, n
            !$omp simd private(faa, fab, sum_a, sum_b, bending, turn_a, turn_b, m, z)
            do l = 1, lanes
                faa = links(min(l, stiffness_lanes), link_faa, i)
                fab = links(min(l, stiffness_lanes), link_fab, i)
                sum_a = links(min(l, stiffness_lanes), link_sum_a, i)
                sum_b = links(min(l, stiffness_lanes), link_sum_b, i)
                bending = links(min(l, stiffness_lanes), link_bending, i)
                turn_a = right(l, i - 1)
                turn_b = left(l, i)
                m = mr(l, i - 1)
                z = ml(l, i)
                room(l, i, 1) = (w(l, i) - w(l, i - 1))*beam%inverse(i) + (faa*m + fab*z) + turn_a
                ! From end to end the rotation falls by this much
                room(l, i, 2) = (sum_a*m + sum_b*z) + (turn_a + turn_b)
                room(l, i, 3) = (abs(w(l, i)) + abs(w(l, i - 1)))*beam%inverse(i) &
                    + larger(larger(abs(turn_a), abs(turn_b)), bending*larger(abs(m), abs(z)))
            end do
        end do
        do way = 1, -1, -2
            do i = merge(2, n - 1, way == 1), merge(n, 1, way == 1), way
                ! By that of link k, across node j
                k = i - way
                j = min(i, k)
                crosses = 1.0_wp - beam%hinge(j)
                !$omp simd private(psi, size, other, other_size)
                do l = 1, lanes
                    psi = room(l, i, 1)
                    size = room(l, i, 3)
                    other = room(l, k, 1) - way*room(l, j, 2)
                    other_size = room(l, k, 3)
                    other_size = merge(other_size, size, crosses > 0.5_wp)
                    room(l, i, 1) = merge(other, psi, other_size < size)
                    room(l, i, 3) = merge(other_size, size, other_size < size)
                end do
            end do
        end do
    end subroutine find_rotations

    !> In which cases some shear has few digits
    pure subroutine check_shears(n, room, poor)
        integer, intent(in) :: n
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        real(wp), intent(out) :: poor(lanes)
        real(wp), dimension(lanes) :: largest, worst
        integer :: i, l

        largest(:) = 0.0_wp
        worst(:) = 0.0_wp
        do i = 1, n
            !$omp simd
            do l = 1, lanes
                largest(l) = larger(largest(l), abs(room(l, i, 5)))
                worst(l) = larger(worst(l), room(l, i, 6))
            end do
        end do
        do l = 1, lanes
            poor(l) = merge(0.0_wp, 1.0_wp, worst(l) <= worst_shear_digits*largest(l))
        end do
    end subroutine check_shears

    !> Loads of all pieces
    pure subroutine add_piece_loads(pieces, number, factors, loads)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: number
        real(wp), intent(in), contiguous :: factors(:, :)
        real(wp), intent(out) :: loads(lanes, number, 5)
        real(wp) :: share
        integer :: i, j, k, l, m

        loads(:, :, :) = 0.0_wp
        do i = 1, size(pieces%load)
            k = pieces%load(i)
            j = pieces%piece(i)
            do m = 1, 5
                share = pieces%to_piece(m, i)
                if (.not. abs(share) > 0.0_wp) cycle
                !$omp simd
                do l = 1, lanes
                    loads(l, j, m) = loads(l, j, m) + factors(l, k)*share
                end do
            end do
        end do
    end subroutine add_piece_loads

    !> Fields at the left ends of the pieces
    pure subroutine recover(beam, pieces, n, number, loads, w, ml, mr, room, work, starts)
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        !> Links, and pieces
        integer, intent(in) :: n, number
        real(wp), intent(in) :: loads(lanes, number, 5)
        real(wp), intent(in), dimension(lanes, 0:n) :: w, ml, mr
        !> Rotations (1) and shears (5) of the links
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        real(wp), intent(inout) :: work(lanes, number, 3)
        real(wp), intent(out) :: starts(lanes, number, 4)
        real(wp) :: length
        integer :: i, j, l

        do i = 1, n
            j = pieces%last(i)
            if (pieces%last(i - 1) + 1 < j) then
                call recover_link(pieces, i, n, number, beam%length(i), loads, w, ml, mr, room, work, starts)
                cycle
            end if
            length = pieces%length(j)
            !$omp simd
            do l = 1, lanes
                starts(l, j, 1) = w(l, i - 1)
                starts(l, j, 2) = room(l, i, 1)
                starts(l, j, 3) = mr(l, i - 1)
                starts(l, j, 4) = room(l, i, 5) + length*(loads(l, j, 2) + 2*loads(l, j, 1))/6
            end do
        end do
    end subroutine recover

    !> Those of a link of several pieces: sums that keep their rounding error run from both ends towards the point
    pure subroutine recover_link(pieces, i, n, number, length, loads, w, ml, mr, room, work, starts)
        type(lane_pieces_type), intent(in) :: pieces
        !> The link; links and pieces
        integer, intent(in) :: i, n, number
        real(wp), intent(in) :: length, loads(lanes, number, 5)
        real(wp), intent(in), dimension(lanes, 0:n) :: w, ml, mr
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        real(wp), intent(inout) :: work(lanes, number, 3), starts(lanes, number, 4)
        real(wp), dimension(lanes) :: high, low, before, turn_high, turn_low, slip_high, slip_low
        real(wp) :: x0, x1, xi, at_end, behind, inside, p, f, g, m0, m1, right, to_left, to_right
        integer :: j, l, first, last

        first = pieces%last(i - 1) + 1
        last = pieces%last(i)
        ! Moments about the right end of what lies to the right of every piece, in work 1
        high(:) = 0.0_wp
        low(:) = 0.0_wp
        work(:, last, 1) = 0.0_wp
        do j = last, first, -1
            x0 = pieces%behind(j)
            p = pieces%length(j)
            !$omp simd
            do l = 1, lanes
                call add(high(l), low(l), load_moment(x0, p, loads(l, j, 2), loads(l, j, 1)))
            end do
            if (j == first) exit
            x0 = pieces%behind(j - 1)
            !$omp simd
            do l = 1, lanes
                work(l, j - 1, 1) = high(l) + low(l)
                call add(high(l), low(l), loads(l, j - 1, 4)*x0)
                call add(high(l), low(l), -loads(l, j - 1, 5))
            end do
        end do
        ! Forward: moment, shear, rotation; the turning of each piece, weighted to its ends, waits in work 2 and 3
        before(:) = high + low
        high(:) = 0.0_wp
        low(:) = 0.0_wp
        turn_high(:) = 0.0_wp
        turn_low(:) = 0.0_wp
        slip_high(:) = 0.0_wp
        slip_low(:) = 0.0_wp
        do j = first, last
            x0 = pieces%before(j)
            x1 = length
            if (j < last) x1 = pieces%before(j + 1)
            p = pieces%length(j)
            xi = x0/length
            at_end = x1/length
            ! The point at the right end of the link is a node, which has its loads itself
            behind = length - x1
            inside = merge(1.0_wp, 0.0_wp, j < last)
            !$omp simd private(f, g, m0, m1, right, to_left, to_right)
            do l = 1, lanes
                f = pieces%flexibility(min(l, stiffness_lanes), j)
                g = pieces%shear_flexibility(min(l, stiffness_lanes), j)
                m0 = (1 - xi)*(mr(l, i - 1) + (high(l) + low(l))) + xi*(ml(l, i) + before(l))
                starts(l, j, 3) = m0
                starts(l, j, 4) = room(l, i, 5) + (before(l) - (high(l) + low(l)))/length
                starts(l, j, 2) = room(l, i, 1) - (turn_high(l) + turn_low(l))
                starts(l, j, 1) = slip_high(l) + slip_low(l)
                call add(high(l), low(l), load_moment(x0, p, loads(l, j, 1), loads(l, j, 2)))
                right = work(l, j, 1)
                before(l) = right
                right = right + inside*(loads(l, j, 4)*behind - loads(l, j, 5))
                m1 = (1 - at_end)*(mr(l, i - 1) + (high(l) + low(l))) + at_end*(ml(l, i) + right)
                call moment_integrals(p, m0, m1, loads(l, j, 1), loads(l, j, 2), to_left, to_right)
                work(l, j, 2) = f*to_left - loads(l, j, 3)*p/2
                work(l, j, 3) = f*to_right - loads(l, j, 3)*p/2
                call add(turn_high(l), turn_low(l), work(l, j, 2) + work(l, j, 3))
                call add(slip_high(l), slip_low(l), g*(m1 - m0))
                call add(high(l), low(l), inside*loads(l, j, 4)*x1)
                call add(high(l), low(l), inside*loads(l, j, 5))
            end do
        end do
        ! First moment of the turning right of each piece's start, about the right end of the link, in work 1
        high(:) = 0.0_wp
        low(:) = 0.0_wp
        do j = last, first, -1
            x0 = pieces%behind(j)
            x1 = length
            if (j > first) x1 = pieces%behind(j - 1)
            !$omp simd
            do l = 1, lanes
                call add(high(l), low(l), work(l, j, 3)*x0)
                call add(high(l), low(l), work(l, j, 2)*x1)
                work(l, j, 1) = high(l) + low(l)
            end do
        end do
        ! Deflections by Mohr's theorem, shear deflection relative to the chord
        high(:) = 0.0_wp
        low(:) = 0.0_wp
        do j = first, last
            x0 = pieces%before(j)
            x1 = length
            if (j < last) x1 = pieces%before(j + 1)
            xi = x0/length
            !$omp simd
            do l = 1, lanes
                starts(l, j, 1) = (1 - xi)*(w(l, i - 1) + (high(l) + low(l))) + xi*(w(l, i) + work(l, j, 1)) &
                    + (starts(l, j, 1) - xi*(slip_high(l) + slip_low(l)))
                call add(high(l), low(l), work(l, j, 2)*x0)
                call add(high(l), low(l), work(l, j, 3)*x1)
            end do
        end do
    end subroutine recover_link

    !> Numbers too far from 1 for what is made of them here
    pure subroutine check_range(n, starts, poor)
        integer, intent(in) :: n
        real(wp), intent(in) :: starts(lanes, n, 4)
        real(wp), intent(inout) :: poor(lanes)
        real(wp) :: total(lanes)
        integer :: j, k, l

        total(:) = 0.0_wp
        do k = 1, 4
            do j = 1, n
                !$omp simd
                do l = 1, lanes
                    total(l) = total(l) + abs(starts(l, j, k))
                end do
            end do
        end do
        do l = 1, lanes
            if (.not. (total(l) >= smallest_product .and. total(l) <= greatest_product)) poor(l) = 1.0_wp
        end do
    end subroutine check_range

    include 'beam/moments_along.inc'
    include 'elimination/add.inc'

    include 'cases/larger.inc'

end module gapbeam_lane_fields
