!> Active-set search for the contact states of eight cases side by side.
!>
!> The search changes every wrong support at once, and where that makes no progress those at every other node. It may take
!> signs as they come, for what it ends with is looked at as gapbeam_extended_precision does: the final solution is refined
!> (gapbeam_lane_finish), and where any sign is within its rounding error, or no scheme was found, the case is doubtful and goes to
!> gapbeam_extended_precision itself. A scheme without doubt is the only one there is, so it does not matter how it was found.
module gapbeam_lane_search
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_lane_solves
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, by_both_ends, by_three_moments, by_chain
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_sweeps, only: sweep_chain
    use gapbeam_lane_two_sided_sweep, only: pass_both_ends
    use gapbeam_lane_shared, only: keep_loads, join_supports, find_wrong_beside, wait_beside
    implicit none
    private
    public :: search_pack, add_loads, apply_scheme

    !> Solves without progress before fewer supports are changed at a time
    real(wp), parameter :: non_monotone_steps = 4.5_wp

contains

    !> Find the contact states of eight cases
    subroutine search_pack(beam, factors, pack, solves, method)
        !> What they have in common
        type(lane_beam_type), intent(in) :: beam
        !> Factor of every load, shape (lanes, nload)
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Supports, and starts of the searches in; loads and contact states out
        type(pack_type), intent(inout) :: pack
        !> Linear solves; how gapbeam_system solves the scheme, 0 where there is none
        integer, intent(out) :: solves(lanes), method(lanes)
        logical :: lost(lanes)

        call add_loads(beam, beam%n, factors, pack%left, pack%right, pack%shear, pack%couple, pack%load_size, pack%turn_size, &
                       pack%room, pack%force)
        pack%with_couples = .false.
        if (beam%with_couples) pack%with_couples = any(abs(pack%couple) > 0.0_wp)
        if (size(beam%shared) > 0) call keep_loads(beam, beam%n, pack%shear, pack%load)
        call search(beam, beam%n, pack, solves, lost)
        ! Without the weak springs
        call apply_scheme(beam%n, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%held, pack%known, &
                          pack%spring, pack%force)
        call choose_methods(beam, beam%n, pack, method)
        if (.not. beam%is_plain) method(:) = by_chain
        where (lost) method = 0
        pack%is_solved = pack%is_solved .and. all(method == by_both_ends)
    end subroutine search_pack

    !> The loads of eight cases, as solve_case of gapbeam_cases and set_loads of gapbeam_workspace add them up
    pure subroutine add_loads(beam, n, factors, left, right, shear, couple, load_size, turn_size, room, force)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), contiguous :: factors(:, :)
        real(wp), intent(out), dimension(lanes, 0:n) :: left, right, shear, couple, load_size, turn_size, force
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        integer :: i, k, l, j

        left(:, :) = 0.0_wp
        right(:, :) = 0.0_wp
        couple(:, :) = 0.0_wp
        turn_size(:, :) = 0.0_wp
        force(:, :) = 0.0_wp
        room(:, :, 1:3) = 0.0_wp
        do j = 1, size(beam%link)
            i = beam%link(j)
            k = beam%link_load(j)
            !$omp simd
            do l = 1, lanes
                right(l, i - 1) = right(l, i - 1) + factors(l, k)*beam%to_link(min(l, stiffness_lanes), 1, j)
                left(l, i) = left(l, i) + factors(l, k)*beam%to_link(min(l, stiffness_lanes), 2, j)
                room(l, i, 1) = room(l, i, 1) + factors(l, k)*beam%to_link(min(l, stiffness_lanes), 3, j)
                room(l, i, 2) = room(l, i, 2) + factors(l, k)*beam%to_link(min(l, stiffness_lanes), 4, j)
                room(l, i, 3) = room(l, i, 3) + abs(factors(l, k))*beam%to_link(min(l, stiffness_lanes), 5, j)
                turn_size(l, i) = turn_size(l, i) + abs(factors(l, k))*beam%to_link(min(l, stiffness_lanes), 6, j)
            end do
        end do
        do j = 1, size(beam%node)
            i = beam%node(j)
            k = beam%node_load(j)
            force(:, i) = force(:, i) + factors(:, k)*beam%to_node(1, j)
            couple(:, i) = couple(:, i) + factors(:, k)*beam%to_node(2, j)
        end do
        shear(:, :) = force - room(:, :, 2)
        load_size(:, :) = abs(force) + room(:, :, 3)
        shear(:, :n - 1) = shear(:, :n - 1) + room(:, 1:, 1)
        load_size(:, :n - 1) = load_size(:, :n - 1) + room(:, 1:, 3)
    end subroutine add_loads

    !> Change supports until none is wrong
    subroutine search(beam, n, pack, solves, lost)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(pack_type), intent(inout) :: pack
        integer, intent(out) :: solves(lanes)
        !> Which cases are given up
        logical, intent(out) :: lost(lanes)
        real(wp), dimension(lanes) :: wrong, fewest, idle, moves, alive, looked_at, proximal_weight, count
        real(wp) :: left, longest
        integer :: solve, last, l
        logical :: is_easy

        last = ubound(pack%closed, 2)
        is_easy = beam%is_plain .and. .not. pack%with_couples
        pack%turn_rest(:, :) = 0.0_wp
        if (is_easy) pack%turn(:, :) = pack%left + pack%right
        fewest(:) = huge(1.0_wp)
        idle(:) = 0.0_wp
        alive(:) = 1.0_wp
        proximal_weight(:) = 0.0_wp
        count(:) = 0.0_wp
        do solve = 1, most_lane_solves
            if (last > n) call join_supports(beam, n, last, pack%load, pack%turn_rest, pack%closed, pack%stiffness, pack%rigid, &
                                             pack%contact, pack%shear)
            pack%is_solved = is_easy
            if (pack%is_solved) pack%is_solved = ends_hold(beam, pack, n)
            count(:) = count + alive
            if (pack%is_solved) then
                call pass_both_ends(beam, pack%links, n, pack%turn, pack%shear, pack%stiffness, pack%rigid, pack%contact, &
                                    pack%turn_rest, pack%closed, pack%room, pack%w, pack%ml)
                call find_wrong(beam, n, alive, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%w, &
                                pack%ml, pack%ml, pack%turn_rest, wrong)
                if (last > n) call find_wrong_beside(beam, n, last, alive, pack%load, pack%stiffness, pack%rigid, pack%contact, &
                                                     pack%closed, pack%w, pack%ml, pack%ml, pack%turn_rest, wrong)
            else
                pack%closed(:, :) = abs(pack%closed - pack%turn_rest)
                call apply_scheme(n, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%held, pack%known, &
                                  pack%spring, pack%force)
                if (any(proximal_weight > 0.0_wp)) pack%spring(:, :) = pack%spring + spread(proximal_weight, 2, n + 1)
                call sweep_chain(beam, pack%links, n, pack%left, pack%right, pack%force, pack%couple, pack%held, pack%known, &
                                 pack%spring, pack%room, pack%turning, pack%w, pack%ml, pack%mr, moves)
                ! A scheme that moves is solved once more, with weak springs, as by gapbeam_contact_state
                proximal_weight(:) = proximal_weight + moves*[(beam%proximal_weight(min(l, stiffness_lanes)), l=1, lanes)]
                looked_at(:) = alive*(1.0_wp - moves)
                call find_wrong(beam, n, looked_at, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%w, &
                                pack%ml, pack%mr, pack%turn_rest, wrong)
                if (last > n) call find_wrong_beside(beam, n, last, looked_at, pack%load, pack%stiffness, pack%rigid, &
                                                     pack%contact, pack%closed, pack%w, pack%ml, pack%mr, pack%turn_rest, wrong)
                where (moves > 0.5_wp) wrong = huge(1.0_wp)
                is_easy = is_easy .and. .not. any(moves > 0.5_wp)
            end if
            call note_progress(wrong, alive, fewest, idle, left, longest)
            if (.not. left > 0.5_wp) exit
            if (.not. longest > non_monotone_steps) cycle
            call keep_every_other(n, solve, idle, pack%turn_rest)
            if (last > n) call wait_beside(beam, last, solve, merge(1.0_wp, 0.0_wp, idle > non_monotone_steps), pack%turn_rest)
        end do
        solves(:) = nint(count)
        lost = alive > 0.5_wp
    end subroutine search

    !> What has settled stays as it is; how long have the others made no progress
    pure subroutine note_progress(wrong, alive, fewest, idle, left, longest)
        !> How many supports are wrong
        real(wp), intent(in) :: wrong(lanes)
        !> Which cases have not settled, how many were wrong at the least, and solves without progress since
        real(wp), intent(inout), dimension(lanes) :: alive, fewest, idle
        !> How many have not settled, and the most solves without progress of them
        real(wp), intent(out) :: left, longest
        real(wp) :: least, waits
        integer :: l

        left = 0.0_wp
        longest = 0.0_wp
        !$omp simd private(least, waits) reduction(+:left) reduction(max:longest)
        do l = 1, lanes
            alive(l) = merge(alive(l), 0.0_wp, wrong(l) > 0.5_wp)
            left = left + alive(l)
            least = fewest(l)
            waits = merge(0.0_wp, idle(l) + 1.0_wp, wrong(l) < least)
            fewest(l) = merge(wrong(l), least, wrong(l) < least)
            idle(l) = waits
            longest = max(longest, alive(l)*waits)
        end do
    end subroutine note_progress

    !> Nodes as the scheme sees them
    pure subroutine apply_scheme(n, shear, stiffness, rigid, contact, closed, held, known, spring, force)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: shear, stiffness, rigid, contact, closed
        real(wp), intent(out), dimension(lanes, 0:n) :: held, known, spring, force

        call put_support(closed, shear, stiffness, rigid, contact, held, known, spring, force)
    end subroutine apply_scheme

    !> Will an acting support or a restraint hold each end in all cases, once what is wrong is changed, and a support some node
    pure function ends_hold(beam, pack, n) result(hold)
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(in) :: pack
        integer, intent(in) :: n
        logical :: hold
        real(wp) :: least, most, holding
        integer :: i, l

        least = 1.0_wp
        if (size(beam%restrained) == 0) then
            do l = 1, lanes
                least = min(least, &
                            abs(pack%closed(l, 0) - pack%turn_rest(l, 0))*(pack%rigid(l, 0) + pack%stiffness(l, 0)), &
                            abs(pack%closed(l, n) - pack%turn_rest(l, n))*(pack%rigid(l, n) + pack%stiffness(l, n)))
            end do
        else
            do l = 1, lanes
                most = 0.0_wp
                do i = 0, n
                    holding = abs(pack%closed(l, i) - pack%turn_rest(l, i))*(pack%rigid(l, i) + pack%stiffness(l, i))
                    most = max(most, holding)
                    if (modulo(i, n) == 0 .and. beam%restraint(i) == 0) least = min(least, holding)
                end do
                least = min(least, most)
            end do
        end if
        hold = least > 0.0_wp
    end function ends_hold

    !> Which supports have the wrong state, and by how much
    pure subroutine find_wrong(beam, n, alive, shear, stiffness, rigid, contact, closed, w, ml, mr, wrong, number)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Cases that are looked at
        real(wp), intent(in) :: alive(lanes)
        real(wp), intent(in), dimension(lanes, 0:n) :: shear, stiffness, rigid, contact, closed, w, ml, mr
        !> 1 where wrong
        real(wp), intent(out) :: wrong(lanes, 0:n)
        !> How many are wrong
        real(wp), intent(out) :: number(lanes)
        real(wp) :: force, bad, side, changes, h_left, h_right
        integer :: i, l, before, after

        number(:) = 0.0_wp
        h_left = 0.0_wp
        do i = 0, n
            side = beam%side(i)
            changes = beam%changes(i)
            before = max(i - 1, 0)
            after = min(i + 1, n)
            h_right = 0.0_wp
            if (i < n) h_right = beam%inverse(after)
            !$omp simd private(force, bad)
            do l = 1, lanes
                force = shear(l, i) - (ml(l, i) - mr(l, before))*h_left + (ml(l, after) - mr(l, i))*h_right
                bad = wrongness(side, closed(l, i), stiffness(l, i), closed(l, i)*rigid(l, i), contact(l, i), w(l, i), &
                                force)*changes*alive(l)
                bad = merge(1.0_wp, 0.0_wp, bad > 0.0_wp)
                wrong(l, i) = bad
                number(l) = number(l) + bad
            end do
            h_left = h_right
        end do
    end subroutine find_wrong

    !> Where there is no progress, change only every other node, in turn
    pure subroutine keep_every_other(n, solve, idle, wrong)
        !> Links, and which solve it is
        integer, intent(in) :: n, solve
        !> Solves without progress
        real(wp), intent(in) :: idle(lanes)
        !> 1 where wrong in, where to be changed out
        real(wp), intent(inout) :: wrong(lanes, 0:n)
        integer :: i

        do i = modulo(solve, 2), n, 2
            wrong(:, i) = wrong(:, i)*merge(0.0_wp, 1.0_wp, idle > non_monotone_steps)
        end do
    end subroutine keep_every_other

    !> How gapbeam_system solves the scheme of every case
    pure subroutine choose_methods(beam, n, pack, method)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(pack_type), intent(in) :: pack
        integer, intent(out) :: method(lanes)
        real(wp), dimension(lanes) :: holding, couples
        real(wp) :: at_first, at_last
        integer :: i, l

        at_first = merge(1.0_wp, 0.0_wp, beam%restraint(0) > 0)
        at_last = merge(1.0_wp, 0.0_wp, beam%restraint(n) > 0)

        holding(:) = 0.0_wp
        couples(:) = 0.0_wp
        do i = 1, n - 1
            holding(:) = holding + pack%held(:, i)
        end do
        if (pack%with_couples) couples(:) = sum(abs(pack%couple), 2)
        do l = 1, lanes
            associate (first => pack%held(l, 0), last => pack%held(l, n), left => pack%spring(l, 0), right => pack%spring(l, n))
                method(l) = by_chain
                ! A spring beside a rigid support does nothing there
                if (holding(l) > n - 1.5_wp .and. holding(l) + first*(1.0_wp + at_first) + last*(1.0_wp + at_last) > 1.5_wp &
                    .and. .not. (left + at_first)*(1.0_wp - first) + (right + at_last)*(1.0_wp - last) > 0.0_wp) then
                    method(l) = by_three_moments
                else if (first + left + at_first > 0.0_wp .and. last + right + at_last > 0.0_wp &
                         .and. .not. couples(l) > 0.0_wp) then
                    method(l) = by_both_ends
                    ! Two restrained ends may move together
                    if (first + left + last + right > 0.0_wp) cycle
                    if (.not. sum(pack%held(l, :) + pack%spring(l, :)) > 0.0_wp) method(l) = by_chain
                end if
            end associate
        end do
    end subroutine choose_methods

    include 'cases/support_in_scheme.inc'

    include 'cases/wrongness.inc'

end module gapbeam_lane_search
