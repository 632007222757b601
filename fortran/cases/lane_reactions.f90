!> Shears and reactions of eight cases, and which of them rounding could turn.
!> That is gapbeam_reactions and gapbeam_law for ordinary supports, number by number.
module gapbeam_lane_reactions
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: sign_width, worst_digits, worst_correction
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, link_numbers, link_fixity, link_reach
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_shared, only: find_levels, share_forces
    implicit none
    private
    public :: complete, find_shears, doubt_corrections

contains

    !> Reactions, and whether the scheme is beyond doubt
    pure subroutine complete(beam, n, pack, doubtful)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Solved
        type(pack_type), intent(inout) :: pack
        !> Above 0: a sign is wrong or within its rounding error, digits are lost, or numbers are not finite
        real(wp), intent(out) :: doubtful(lanes)
        real(wp), dimension(lanes) :: largest, worst
        integer :: last

        last = ubound(pack%closed, 2)
        doubtful(:) = 0.0_wp
        largest(:) = 0.0_wp
        worst(:) = 0.0_wp
        if (last > n) call find_levels(beam, last, pack%closed, pack%contact)
        call find_sizes(beam, pack%links, n, pack%held, pack%contact, pack%closed, pack%load_size, pack%turn_size, pack%w, &
                        pack%ml, pack%mr, pack%room)
        call find_shears(beam, n, pack%held, pack%spring, pack%force, pack%w, pack%ml, pack%mr, pack%room)
        if (last > n) call share_forces(beam, n, last, pack%load, pack%load_size, pack%stiffness, pack%rigid, pack%contact, &
                                        pack%closed, pack%w, pack%room, pack%reaction, largest, worst, doubtful)
        call find_reactions(beam, n, pack%shear, pack%load_size, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%w, &
                            pack%ml, pack%mr, pack%room, pack%reaction, largest, worst, doubtful)
    end subroutine complete

    !> Sizes whose rounding errors reach a node: room 1 of shears, 2 of deflections
    pure subroutine find_sizes(beam, links, n, held, contact, closed, load_size, turn_size, w, ml, mr, room)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: held, contact, closed, load_size, turn_size, w, ml, mr
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        real(wp) :: moment, turn, by_shear, by_deflection, share, s, d, inverse, fixity, reach
        real(wp), dimension(lanes) :: shear, deflection
        integer :: i, l, way

        do i = 0, n
            room(:, i, 1) = 0.0_wp
            room(:, i, 2) = 0.0_wp
            room(:, i, 3) = load_size(:, i)
            room(:, i, 4) = abs(w(:, i))
        end do
        do i = 1, n
            inverse = beam%inverse(i)
            !$omp simd private(fixity, reach, moment, turn, by_shear, by_deflection)
            do l = 1, lanes
                fixity = links(min(l, stiffness_lanes), link_fixity, i)
                reach = links(min(l, stiffness_lanes), link_reach, i)
                turn = turn_size(l, i) + (abs(contact(l, i))*closed(l, i) + abs(contact(l, i - 1))*closed(l, i - 1))*inverse
                moment = larger(larger(abs(mr(l, i - 1)), abs(ml(l, i))), turn*fixity)
                by_shear = 2*moment*inverse
                by_deflection = reach*moment
                room(l, i - 1, 3) = larger(room(l, i - 1, 3), by_shear)
                room(l, i - 1, 4) = larger(room(l, i - 1, 4), by_deflection)
                room(l, i, 3) = larger(room(l, i, 3), by_shear)
                room(l, i, 4) = larger(room(l, i, 4), by_deflection)
            end do
        end do
        do way = 1, -1, -2
            shear(:) = 0.0_wp
            deflection(:) = 0.0_wp
            do i = merge(0, n, way == 1), merge(n, 0, way == 1), way
                !$omp simd private(share, s, d)
                do l = 1, lanes
                    share = 1.0_wp - 0.5_wp*held(l, i)
                    shear(l) = larger(room(l, i, 3), share*shear(l))
                    deflection(l) = larger(room(l, i, 4), share*deflection(l))
                    s = room(l, i, 1)
                    d = room(l, i, 2)
                    room(l, i, 1) = larger(s, shear(l))
                    room(l, i, 2) = larger(d, deflection(l))
                end do
            end do
        end do
    end subroutine find_sizes

    !> Shears of the links and their rounding errors: room 5 and 6, by the better of two ways
    pure subroutine find_shears(beam, n, held, spring, force, w, ml, mr, room)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring, force, w, ml, mr
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        real(wp) :: by_spring, change, passed, v, e, other, error
        integer :: i, j, k, l, way

        do i = 1, n
            room(:, i, 5) = (ml(:, i) - mr(:, i - 1))*beam%inverse(i)
            room(:, i, 6) = epsilon(1.0_wp)*(abs(ml(:, i)) + abs(mr(:, i - 1)))*beam%inverse(i)
        end do
        do way = 1, -1, -2
            do i = merge(2, n - 1, way == 1), merge(n, 1, way == 1), way
                ! By that of link k, across node j
                k = i - way
                j = min(i, k)
                !$omp simd private(by_spring, change, passed, v, e, other, error)
                do l = 1, lanes
                    by_spring = spring(l, j)*w(l, j)
                    change = by_spring - force(l, j)
                    passed = epsilon(1.0_wp)*(abs(by_spring) + abs(force(l, j)))
                    v = room(l, i, 5)
                    e = room(l, i, 6)
                    other = room(l, k, 5) + way*change
                    ! No way past a rigid support
                    error = room(l, k, 6) + passed
                    error = merge(e, error, held(l, j) > 0.5_wp)
                    room(l, i, 5) = merge(other, v, error < e)
                    room(l, i, 6) = merge(error, e, error < e)
                end do
            end do
        end do
        room(:, 0, 5:6) = 0.0_wp
    end subroutine find_shears

    !> Reactions, and whether signs and digits are certain
    pure subroutine find_reactions(beam, n, shear, load_size, stiffness, rigid, contact, closed, w, ml, mr, room, reaction, &
                                   largest, worst, doubtful)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: shear, load_size, stiffness, rigid, contact, closed, w, ml, mr
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        real(wp), intent(inout) :: reaction(lanes, 0:n)
        !> As for share_forces of gapbeam_lane_shared
        real(wp), intent(in), dimension(lanes) :: largest, worst
        real(wp), intent(inout) :: doubtful(lanes)
        real(wp) :: left, right, left_error, right_error, force, error, by_spring, spring_error, r, r_error, margin, rounding, c
        real(wp) :: side, there, changes, bad
        ! Sums of dummies would go through the memory at every node
        real(wp), dimension(lanes) :: most, off
        integer :: i, l

        most(:) = largest
        off(:) = worst
        do i = 0, n
            side = beam%side(i)
            there = beam%there(i)
            changes = beam%changes(i)
            !$omp simd private(left, right, left_error, right_error, force, error, by_spring, spring_error, r, r_error, margin, &
            !$omp   rounding, c, bad)
            do l = 1, lanes
                left = room(l, i, 5)
                left_error = room(l, i, 6)
                right = 0.0_wp
                right_error = 0.0_wp
                if (i < n) then
                    right = room(l, min(i + 1, n), 5)
                    right_error = room(l, min(i + 1, n), 6)
                end if
                error = epsilon(1.0_wp)*load_size(l, i) + left_error + right_error
                force = shear(l, i) - (left - right)
                associate (shear_size => room(l, i, 1), deflection_size => room(l, i, 2), stiffness => stiffness(l, i), &
                           rigid => rigid(l, i), contact => contact(l, i), closed => closed(l, i), w => w(l, i))
                    include 'cases/support_reaction.inc'
                end associate
                reaction(l, i) = r
                most(l) = larger(most(l), abs(r))
                off(l) = larger(off(l), r_error)
                ! Not a number, or beyond the range
                c = abs(w(l, i)) + abs(ml(l, i)) + abs(mr(l, i)) + abs(r)
                bad = merge(bad, 1.0_wp, c <= huge(1.0_wp))
                doubtful(l) = doubtful(l) + bad
            end do
        end do
        do l = 1, lanes
            if (off(l) > worst_digits*most(l)) doubtful(l) = doubtful(l) + 1.0_wp
        end do
    end subroutine find_reactions

    !> Are deflections known to few digits, as in digits_lost of gapbeam_extended_precision
    pure subroutine doubt_corrections(n, w, dw, room, doubtful)
        integer, intent(in) :: n
        !> Deflections and their corrections; sizes of deflections in room 2, by find_sizes
        real(wp), intent(in) :: w(lanes, 0:n), dw(lanes, 0:n), room(lanes, 0:n, 10)
        !> Raised where they are
        real(wp), intent(inout) :: doubtful(lanes)
        real(wp) :: largest(lanes), change(lanes), beyond
        integer :: i, l

        largest(:) = 0.0_wp
        change(:) = 0.0_wp
        do i = 0, n
            !$omp simd private(beyond)
            do l = 1, lanes
                largest(l) = merge(abs(w(l, i)), largest(l), abs(w(l, i)) > largest(l))
                beyond = merge(abs(dw(l, i)), 0.0_wp, abs(dw(l, i)) > sign_width*epsilon(1.0_wp)*room(l, i, 2))
                change(l) = merge(beyond, change(l), beyond > change(l))
            end do
        end do
        where (change > worst_correction*largest) doubtful = doubtful + 1.0_wp
    end subroutine doubt_corrections

    include 'cases/larger.inc'

end module gapbeam_lane_reactions
