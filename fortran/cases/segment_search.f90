!> Active-set search for the contact state of a long beam in segments.
!>
!> Every wrong support but those of the ends, which hold the beam, is changed at once; where that makes no progress, one in every
!> neighbourhood. Where nothing helps, or an end is wrong at last, the case is given up. Signs are taken as they come: the scheme
!> is looked at again (segment_finish), and a scheme without doubt is the only one there is, so it does not matter how it was found.
module gapbeam_segment_search
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_segment_solves, segment_non_monotone_solves, end_non_monotone_solves, few_in_segments, &
        few_segment_solves, most_segment_rounds, neighbourhood
    use gapbeam_lane_types, only: lanes
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type, node_of, half
    use gapbeam_segment_two_sided_sweep, only: solve_segments
    implicit none
    private
    public :: search_segments

contains

    !> Find the contact state
    subroutine search_segments(beam, room, solves, found)
        type(segment_beam_type), intent(in) :: beam
        !> Loads, supports and start in; scheme and solution out
        type(segment_room_type), intent(inout) :: room
        integer, intent(out) :: solves
        !> Is there a scheme in which nothing is wrong
        logical, intent(out) :: found
        integer :: fewest, idle, with_wrong_end, number, columns
        logical :: exact, middle_is_wrong, ends_are_right

        solves = 0
        found = .false.
        fewest = huge(0)
        idle = 0
        with_wrong_end = 0
        room%entry(:, :) = 0.0_wp
        room%next(:, :) = 0.0_wp
        call set_rows(beam, room)
        room%support(1, 5, beam%start(1)) = 0.0_wp
        room%support(half + 1, 5, beam%start(2)) = 0.0_wp
        if (.not. ends_hold(beam, room)) return
        do while (solves < most_segment_solves)
            call solve_segments(beam, most_segment_rounds, room, exact)
            solves = solves + 1
            call find_wrong(beam%columns, beam%link, room%solution, room%support, room%wrong, room%changed, columns, number)
            middle_is_wrong = 0.0_wp < badness(room%middle_support, room%middle(2), &
                                       (room%solution(half, 1, beam%columns) - room%middle(1))*beam%link(half, 1, beam%columns), &
                                       (room%solution(lanes, 1, beam%columns) - room%middle(1))*beam%link(lanes, 1, beam%columns))
            if (middle_is_wrong) number = number + 1
            ends_are_right = .not. (end_is_wrong(beam, room, 1, beam%start(1), beam%changing(0)) &
                                    .or. end_is_wrong(beam, room, half + 1, beam%start(2), beam%changing(beam%n)))
            found = number == 0 .and. ends_are_right .and. exact
            if (found) call take_scheme(beam, room)
            with_wrong_end = merge(0, with_wrong_end + 1, ends_are_right)
            if (number == 0 .and. exact .or. with_wrong_end == end_non_monotone_solves) return
            if (number == 0) cycle
            idle = merge(0, idle + 1, number < fewest)
            fewest = min(fewest, number)
            if (idle > segment_non_monotone_solves) return
            if (idle > 0 .and. (number <= few_in_segments .or. idle > few_segment_solves)) call keep_local_worst(beam, &
                room%changed(:columns), room)
            call change(room%changed(:columns), room%wrong, room%support, room%row)
            if (middle_is_wrong) then
                room%middle_support(6) = 1.0_wp - room%middle_support(6)
                call apply(room%middle_support, room%middle_row)
            end if
        end do
    end subroutine search_segments

    !> Does an acting support hold each end
    pure function ends_hold(beam, room) result(hold)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(in) :: room
        logical :: hold

        hold = room%row(1, 1, beam%start(1)) > 0.0_wp .and. room%row(half + 1, 1, beam%start(2)) > 0.0_wp
    end function ends_hold

    !> Supports and rows of all columns from those of the nodes
    pure subroutine set_rows(beam, room)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(inout) :: room
        integer, dimension(lanes) :: first, step, begin
        integer :: l, s, i

        call node_of(beam, [(l, l=1, lanes)], first, step, begin)
        ! Column by column: what is written lies together
        do s = 1, beam%columns
            do l = 1, lanes
                if (s < begin(l)) cycle
                i = first(l) + (s - 1)*step(l)
                call set_node(room, i, beam%changing(i), room%support(l, :, s), room%row(l, :, s))
            end do
        end do
        i = beam%n/2
        call set_node(room, i, beam%changing(i), room%middle_support, room%middle_row)
    end subroutine set_rows

    !> Support and row of a node
    pure subroutine set_node(room, i, changing, support, row)
        type(segment_room_type), intent(in) :: room
        integer, intent(in) :: i
        real(wp), intent(in) :: changing
        !> As in segment_room_type
        real(wp), intent(inout) :: support(:), row(:)

        support(1) = room%shear(i)
        support(2) = room%stiffness(i)
        support(3) = room%rigid(i)
        support(4) = room%contact(i)
        support(5) = changing
        support(6) = room%closed(i)
        row(3) = room%left(i) + room%right(i)
        call apply(support, row)
    end subroutine set_node

    !> The row of a node as its support makes it
    pure subroutine apply(support, row)
        real(wp), intent(in) :: support(:)
        real(wp), intent(inout) :: row(:)

        call make_row(support(6), support(1), support(2), support(3), support(4), row(1), row(2), row(4))
    end subroutine apply

    !> Which supports have the wrong state, but for the node in the middle and the ends
    pure subroutine find_wrong(columns, link, solution, support, wrong, changed, number_of_columns, number)
        integer, intent(in) :: columns
        real(wp), intent(in) :: link(lanes, 8, 0:columns), solution(lanes, 2, 0:columns + 1), support(lanes, 6, columns)
        !> 1 where wrong, set in the columns in which any is
        real(wp), intent(inout) :: wrong(lanes, columns)
        !> These columns, and how many there are
        integer, intent(inout) :: changed(columns)
        integer, intent(out) :: number_of_columns
        !> How many supports are wrong
        integer, intent(out) :: number
        real(wp) :: m, outward, inward, force, bad, acts, side, total, of_column(lanes)
        integer :: s, l

        number_of_columns = 0
        number = 0
        do s = 1, columns
            !$omp simd private(m, outward, inward, force, bad, acts, side)
            do l = 1, lanes
                side = support(l, 5, s)
                acts = support(l, 6, s)
                m = solution(l, 1, s)
                outward = (solution(l, 1, s - 1) - m)*link(l, 1, s - 1)
                inward = (solution(l, 1, s + 1) - m)*link(l, 1, s)
                ! From left to right
                force = (support(l, 1, s) + merge(outward, inward, l <= half)) + merge(inward, outward, l <= half)
                bad = wrongness(side, acts, support(l, 2, s), acts*support(l, 3, s), support(l, 4, s), solution(l, 2, s), force)
                of_column(l) = merge(1.0_wp, 0.0_wp, bad > 0.0_wp)
            end do
            total = sum(of_column)
            if (.not. total > 0.0_wp) cycle
            number = number + nint(total)
            number_of_columns = number_of_columns + 1
            changed(number_of_columns) = s
            wrong(:, s) = of_column
        end do
    end subroutine find_wrong

    !> The same of an end
    pure function end_is_wrong(beam, room, l, s, changing) result(wrong)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(in) :: room
        !> Segment, column, and side of its support where that may change
        integer, intent(in) :: l, s
        real(wp), intent(in) :: changing
        logical :: wrong
        real(wp) :: support(6)

        support(:) = room%support(l, :, s)
        support(5) = changing
        wrong = 0.0_wp < badness(support, room%solution(l, 2, s), 0.0_wp, &
                                 (room%solution(l, 1, s + 1) - room%solution(l, 1, s))*beam%link(l, 1, s))
    end function end_is_wrong

    !> By how much a support pulls, or is penetrated
    pure function badness(support, w, left, right) result(bad)
        !> As in segment_room_type
        real(wp), intent(in) :: support(:)
        !> Deflection of its node, and the forces that come from the links beside it
        real(wp), intent(in) :: w, left, right
        real(wp) :: bad

        bad = wrongness(support(5), support(6), support(2), support(6)*support(3), support(4), w, (support(1) + left) + right)
    end function badness

    !> One change in every neighbourhood: put back the support that is penetrated most; where there is none, release the one that
    !> pulls most
    pure subroutine keep_local_worst(beam, changed, room)
        type(segment_beam_type), intent(in) :: beam
        !> Columns in which something is to be changed
        integer, intent(in) :: changed(:)
        type(segment_room_type), intent(inout) :: room
        real(wp) :: bad, worst
        integer :: l, j, s, first, step, begin, node, before, lane, column
        logical :: opens, worst_opens, near, worse

        before = -2*neighbourhood
        worst = 0.0_wp
        worst_opens = .false.
        lane = 1
        column = 1
        ! From the left end to the middle, then from the right end
        do l = 1, lanes
            call node_of(beam, l, first, step, begin)
            do j = 1, size(changed)
                s = changed(j)
                if (.not. room%wrong(l, s) > 0.5_wp) cycle
                node = first + (s - 1)*step
                opens = room%support(l, 6, s) > 0.5_wp
                bad = badness(room%support(l, :, s), room%solution(l, 2, s), &
                              (room%solution(l, 1, s - 1) - room%solution(l, 1, s))*beam%link(l, 1, s - 1), &
                              (room%solution(l, 1, s + 1) - room%solution(l, 1, s))*beam%link(l, 1, s))
                near = abs(node - before) <= neighbourhood
                worse = merge(bad > worst, worst_opens, opens .eqv. worst_opens)
                before = node
                if (near .and. .not. worse) then
                    room%wrong(l, s) = 0.0_wp
                else
                    if (near) room%wrong(lane, column) = 0.0_wp
                    lane = l
                    column = s
                    worst = bad
                    worst_opens = opens
                end if
            end do
        end do
    end subroutine keep_local_worst

    !> Change what is wrong
    pure subroutine change(changed, wrong, support, row)
        !> Columns
        integer, intent(in) :: changed(:)
        real(wp), intent(in) :: wrong(:, :)
        real(wp), intent(inout), contiguous :: support(:, :, :), row(:, :, :)
        real(wp) :: acts
        integer :: j, l

        do j = 1, size(changed)
            associate (s => changed(j))
                !$omp simd private(acts)
                do l = 1, lanes
                    acts = abs(support(l, 6, s) - wrong(l, s))
                    support(l, 6, s) = acts
                    call make_row(acts, support(l, 1, s), support(l, 2, s), support(l, 3, s), support(l, 4, s), row(l, 1, s), &
                                  row(l, 2, s), row(l, 4, s))
                end do
            end associate
        end do
    end subroutine change

    !> The scheme by nodes
    pure subroutine take_scheme(beam, room)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(inout) :: room
        integer :: l, s, i, step, begin

        do l = 1, lanes
            call node_of(beam, l, i, step, begin)
            do s = begin, beam%columns
                room%closed(i + (s - 1)*step) = room%support(l, 6, s)
            end do
        end do
        room%closed(beam%n/2) = room%middle_support(6)
    end subroutine take_scheme

    include 'cases/row_of_node.inc'

    include 'cases/wrongness.inc'

end module gapbeam_segment_search
