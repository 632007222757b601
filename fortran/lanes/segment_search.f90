!> The working scheme of a long beam in segments, by the search of gapbeam_lane_search, scheme by scheme.
!>
!> Every wrong support is changed at once; where that makes no progress for some solves, those at every other node. Where the
!> support of an end is to be opened, or nothing helps, the case is given up. Signs are taken as they come: the scheme is looked at
!> again (segment_finish), and a scheme without doubt is the only one there is, so it does not matter how it was found.
module gapbeam_segment_search
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type, node_of, half
    use gapbeam_segment_passes, only: solve_segments
    implicit none
    private
    public :: search_segments

    !> Solves at most; without progress before fewer supports are changed at a time, and before the case is given up
    integer, parameter :: most_solves = 80, patience = 5, last_patience = 16

contains

    !> Find the working scheme
    pure subroutine search_segments(beam, room, solves, found)
        type(segment_beam_type), intent(in) :: beam
        !> Loads, supports and start in; scheme and solution out
        type(segment_room_type), intent(inout) :: room
        !> Linear solves
        integer, intent(out) :: solves
        !> Is there a scheme in which nothing is wrong
        logical, intent(out) :: found
        real(wp) :: odd(lanes)
        integer :: fewest, idle, number, columns, l, first, step, begin
        logical :: middle_is_wrong

        solves = 0
        found = .false.
        fewest = huge(0)
        idle = 0
        room%entry(:, :) = 0.0_wp
        room%next(:, :) = 0.0_wp
        call set_rows(beam, room)
        do l = 1, lanes
            call node_of(beam, l, first, step, begin)
            odd(l) = real(modulo(first, 2), wp)
        end do
        do while (solves < most_solves .and. ends_hold(beam, room))
            call solve_segments(beam, room)
            solves = solves + 1
            call find_wrong(beam%columns, beam%link, room%solution, room%support, room%wrong, room%changed, columns, number)
            call look_at_middle(beam, room, middle_is_wrong)
            if (middle_is_wrong) number = number + 1
            found = number == 0
            if (found) then
                call take_scheme(beam, room)
                return
            end if
            idle = merge(0, idle + 1, number < fewest)
            fewest = min(fewest, number)
            if (idle > last_patience) return
            if (idle >= patience) then
                call spare_every_other(solves, odd, room%changed(:columns), room%wrong)
                middle_is_wrong = middle_is_wrong .and. modulo(beam%n/2, 2) /= modulo(solves, 2)
            end if
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
        integer :: l, s, i, step, begin

        do l = 1, lanes
            call node_of(beam, l, i, step, begin)
            i = i + (begin - 1)*step
            do s = begin, beam%columns
                call set_node(room, i, beam%changing(i), room%support(l, :, s), room%row(l, :, s))
                i = i + step
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
        real(wp) :: held, spring, free

        held = support(6)*support(3)
        spring = support(6)*support(2)
        free = 1.0_wp - held
        row(1) = spring*free + held
        row(2) = free
        row(4) = (support(1) + spring*support(4))*free + held*support(4)
    end subroutine apply

    !> Which supports have the wrong state, but for the node in the middle
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
        real(wp) :: m, outward, inward, force, pressing, bad, acts, side, total, of_column(lanes)
        integer :: s, l

        number_of_columns = 0
        number = 0
        do s = 1, columns
            !$omp simd private(m, outward, inward, force, pressing, bad, acts, side)
            do l = 1, lanes
                side = support(l, 5, s)
                acts = support(l, 6, s)
                m = solution(l, 1, s)
                outward = (solution(l, 1, s - 1) - m)*link(l, 1, s - 1)
                inward = (solution(l, 1, s + 1) - m)*link(l, 1, s)
                ! From left to right, as in lanes
                force = -side*((support(l, 1, s) + merge(outward, inward, l <= half)) + merge(inward, outward, l <= half))
                pressing = side*(solution(l, 2, s) - support(l, 4, s))
                bad = pressing - acts*(pressing + pressing*support(l, 2, s))
                bad = merge(force, bad, acts*support(l, 3, s) > 0.5_wp)
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

    !> The same of the node in the middle
    pure subroutine look_at_middle(beam, room, is_wrong)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(in) :: room
        logical, intent(out) :: is_wrong
        real(wp) :: bad

        associate (s => room%middle_support, m => room%middle(1), w => room%middle(2), last => beam%columns)
            if (s(6)*s(3) > 0.5_wp) then
                bad = -s(5)*(s(1) + (room%solution(half, 1, last) - m)*beam%link(half, 1, last) &
                             + (room%solution(lanes, 1, last) - m)*beam%link(lanes, 1, last))
            else
                bad = s(5)*(w - s(4))
                bad = bad - s(6)*(bad + bad*s(2))
            end if
        end associate
        is_wrong = bad > 0.0_wp
    end subroutine look_at_middle

    !> Where there is no progress, change only every other node, in turn
    pure subroutine spare_every_other(solves, odd, changed, wrong)
        integer, intent(in) :: solves
        !> 1 where the node of column 1 has an odd number
        real(wp), intent(in) :: odd(lanes)
        !> Columns in which something is to be changed
        integer, intent(in) :: changed(:)
        real(wp), intent(inout) :: wrong(:, :)
        real(wp) :: kept(lanes)
        integer :: j

        do j = 1, size(changed)
            ! Nodes go up or down by one a column
            kept(:) = merge(odd, 1.0_wp - odd, modulo(solves + changed(j) - 1, 2) == 0)
            wrong(:, changed(j)) = wrong(:, changed(j))*kept
        end do
    end subroutine spare_every_other

    !> Change what is wrong
    pure subroutine change(changed, wrong, support, row)
        !> Columns
        integer, intent(in) :: changed(:)
        real(wp), intent(in) :: wrong(:, :)
        real(wp), intent(inout), contiguous :: support(:, :, :), row(:, :, :)
        real(wp) :: acts, held, spring, free
        integer :: j, l

        do j = 1, size(changed)
            associate (s => changed(j))
                !$omp simd private(acts, held, spring, free)
                do l = 1, lanes
                    acts = abs(support(l, 6, s) - wrong(l, s))
                    support(l, 6, s) = acts
                    held = acts*support(l, 3, s)
                    spring = acts*support(l, 2, s)
                    free = 1.0_wp - held
                    row(l, 1, s) = spring*free + held
                    row(l, 2, s) = free
                    row(l, 4, s) = (support(l, 1, s) + spring*support(l, 4, s))*free + held*support(l, 4, s)
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

end module gapbeam_segment_search
