!> Two-sided elimination of a long beam in eight segments at once.
!> Each end has a support that acts, and there are no couples and hinges; with the arithmetic of gapbeam_kernel, number by number:
!> the bits are its.
!>
!> What a node passes on hardly depends on what lies far outside of it, to the last bit as a rule after some thirty nodes. So every
!> segment begins with a guess of what comes in from outside, all at once, and then again with what does come in, until the bits are
!> those of before. Whether they are is tested, no tolerance is needed: where they never are, the segments end up one after the
!> other. The way back is the same.
module gapbeam_segment_two_sided_sweep
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: kept_columns
    use gapbeam_lane_types, only: lanes
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type, half
    implicit none
    private
    public :: solve_segments

contains

    !> Solve the rows that are set
    pure subroutine solve_segments(beam, most_rounds, room, exact)
        type(segment_beam_type), intent(in) :: beam
        !> So often each way at most
        integer, intent(in) :: most_rounds
        !> Rows in, with guesses; solution out, and guesses from which to go on
        type(segment_room_type), intent(inout) :: room
        !> Does every segment begin with what does come in; after as many rounds as there are segments in a half and one it does
        logical, intent(out) :: exact
        real(wp) :: leaves(lanes, 5), found(lanes, 5), other(lanes, 2)
        integer :: round
        logical :: as_before

        leaves(:, :) = 0.0_wp
        exact = .false.
        do round = 1, most_rounds
            call go_inward(beam%columns, beam%start, beam%link, room%row, round > 1, room%entry, leaves, room%passed, &
                           room%eliminated, as_before)
            found(:, :) = room%entry
            found(2:half, :) = leaves(1:half - 1, :)
            found(half + 2:, :) = leaves(half + 1:lanes - 1, :)
            exact = as_before .or. .not. sum(abs(found - room%entry)) > 0.0_wp
            if (exact) exit
            room%entry(:, :) = found
        end do
        call meet(room%middle_row, leaves(half, :), leaves(lanes, :), room%middle)
        room%next(half, :) = room%middle
        room%next(lanes, :) = room%middle
        do round = 1, most_rounds
            call go_outward(beam%columns, room%eliminated, room%next, round > 1, room%solution, as_before)
            if (as_before) exit
            other(:, :) = room%next
            other(1:half - 1, :) = room%solution(2:half, :, 1)
            other(half + 1:lanes - 1, :) = room%solution(half + 2:, :, 1)
            if (.not. sum(abs(other - room%next)) > 0.0_wp) exit
            room%next(:, :) = other
        end do
        exact = exact .and. round <= most_rounds
        ! What segments see of each other
        room%solution(2:half, :, 0) = room%solution(1:half - 1, :, beam%columns)
        room%solution(half + 2:, :, 0) = room%solution(half + 1:lanes - 1, :, beam%columns)
        room%solution(:, :, beam%columns + 1) = room%next
    end subroutine solve_segments

    !> Inward, all segments at once
    pure subroutine go_inward(columns, start, link, row, again, entry, leaves, passed, eliminated, as_before)
        integer, intent(in) :: columns, start(2)
        real(wp), intent(in) :: link(lanes, 8, 0:columns), row(lanes, 4, columns)
        !> Not for the first time: end where nothing is other than before
        logical, intent(in) :: again
        !> What comes in, and what is passed on in the end, which stays where nothing is other than before; phi, beta, delta, e, p
        real(wp), intent(in) :: entry(lanes, 5)
        real(wp), intent(inout) :: leaves(lanes, 5), passed(lanes, 5, kept_columns), eliminated(lanes, 6, columns)
        !> Has it ended there
        logical, intent(out) :: as_before
        real(wp) :: flow(lanes, 5), a, b, c, b_free, c_h, reciprocal, turn_here, load_here, next
        integer :: s, l, k

        as_before = .false.
        flow(:, :) = entry
        do s = 1, columns
            !$omp simd private(a, b, c, b_free, c_h, reciprocal, turn_here, load_here, next)
            do l = 1, lanes
                associate (h => link(l, 1, s), near => link(l, 2, s), far => link(l, 3, s), cross => link(l, 4, s), &
                           sum_near => link(l, 5, s), sum_far => link(l, 6, s), bending => link(l, 7, s), &
                           determinant => link(l, 8, s), stiff => row(l, 1, s), free => row(l, 2, s), turn => row(l, 3, s), &
                           load => row(l, 4, s), phi => flow(l, 1), beta => flow(l, 2), delta => flow(l, 3), e => flow(l, 4), &
                           p => flow(l, 5), moment => eliminated(l, 1, s), moment_m => eliminated(l, 2, s), &
                           moment_w => eliminated(l, 3, s), deflection => eliminated(l, 4, s), &
                           deflection_m => eliminated(l, 5, s), deflection_w => eliminated(l, 6, s))
                    include 'elimination/node_step.inc'
                end associate
            end do
            do k = 1, 2
                if (s /= start(k)) cycle
                l = merge(1, half + 1, k == 1)
                call begin_at_end(link(l, :, s), row(l, :, s), eliminated(l, :, s), flow(l, :))
            end do
            if (s > kept_columns) cycle
            if (again) then
                as_before = .not. sum(abs(passed(:, :, s) - flow)) > 0.0_wp
                if (as_before) return
            end if
            passed(:, :, s) = flow
        end do
        leaves(:, :) = flow
    end subroutine go_inward

    !> The end of the beam, whatever has been passed on before
    pure subroutine begin_at_end(link, row, eliminated, flow)
        real(wp), intent(in) :: link(:), row(:)
        real(wp), intent(inout) :: eliminated(:), flow(:)
        real(wp) :: softness

        associate (h => link(1), far => link(3), stiff => row(1), free => row(2), load => row(4), moment => eliminated(1), &
                   moment_m => eliminated(2), moment_w => eliminated(3), deflection => eliminated(4), &
                   deflection_m => eliminated(5), deflection_w => eliminated(6), phi => flow(1), beta => flow(2), &
                   delta => flow(3), e => flow(4), p => flow(5))
            include 'elimination/node_start.inc'
        end associate
    end subroutine begin_at_end

    !> The node in the middle
    pure subroutine meet(row, left, right, solution)
        real(wp), intent(in) :: row(4), left(:), right(:)
        !> Moment and deflection
        real(wp), intent(out) :: solution(2)
        real(wp) :: phi, beta, delta, e, p, a, b, c, b_free, reciprocal, turn_here, load_here

        phi = left(1) + right(1)
        beta = left(2) + right(2)
        delta = left(3) + right(3)
        e = left(4) + right(4)
        p = left(5) + right(5)
        associate (stiff => row(1), free => row(2), turn => row(3), load => row(4), moment => solution(1), &
                   deflection => solution(2))
            include 'elimination/node_meeting.inc'
        end associate
    end subroutine meet

    !> Back to the ends
    pure subroutine go_outward(columns, eliminated, next, again, solution, as_before)
        integer, intent(in) :: columns
        real(wp), intent(in) :: eliminated(lanes, 6, columns)
        !> Moment and deflection at the next node inward
        real(wp), intent(in) :: next(lanes, 2)
        !> As for go_inward
        logical, intent(in) :: again
        real(wp), intent(inout) :: solution(lanes, 2, 0:columns + 1)
        logical, intent(out) :: as_before
        real(wp) :: m(lanes), w(lanes), moment, deflection, differs(lanes)
        integer :: s, l

        as_before = .false.
        m(:) = next(:, 1)
        w(:) = next(:, 2)
        do s = columns, 1, -1
            !$omp simd private(moment, deflection)
            do l = 1, lanes
                moment = eliminated(l, 1, s) + eliminated(l, 2, s)*m(l) - eliminated(l, 3, s)*w(l)
                deflection = eliminated(l, 4, s) + eliminated(l, 5, s)*m(l) + eliminated(l, 6, s)*w(l)
                m(l) = moment
                w(l) = deflection
            end do
            if (again) then
                differs(:) = abs(solution(:, 1, s) - m) + abs(solution(:, 2, s) - w)
                as_before = .not. sum(differs) > 0.0_wp
                if (as_before) return
            end if
            solution(:, 1, s) = m
            solution(:, 2, s) = w
        end do
    end subroutine go_outward

end module gapbeam_segment_two_sided_sweep
