!> The one outgoing direction of a path where no force falls, by complementarity.
!>
!> There is one then, and the rates at the breakpoints at hand are a linear complementarity problem with a P-matrix: breakpoints
!> that move the wrong way are passed until none does, all at once, then the one of least index (Murty 1974). So a state with many
!> breakpoints at hand, as there are where supports unload, takes a few solves, not one for every choice of them.
module gapbeam_single_direction
    use gapbeam_kinds, only: wp => qp
    use gapbeam_limits, only: most_looks, looks_without_progress
    use gapbeam_polyline_quad, only: node_support_type, coincide, piece_that_acts, open_from
    use gapbeam_model_quad, only: beam_type
    use gapbeam_region_responses, only: responses_type, outgoing_type, renew_responses, find_falling, is_held_twice, &
        rise, fall, turn
    implicit none
    private
    public :: find_single_direction

contains

    !> Find the way on where no force falls, so that there is one
    subroutine find_single_direction(beam, factor, before, came, wanted, broken, at_hand, responses, outgoing)
        !> As for find_outgoing
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: before(:)
        integer, intent(in) :: came, wanted
        logical, intent(in) :: broken(:), at_hand(:)
        type(responses_type), intent(inout) :: responses
        !> That way; one for each direction if the path comes from nowhere; none if there is none, or not only one
        type(outgoing_type), allocatable, intent(out) :: outgoing(:)
        type(outgoing_type) :: way
        integer :: direction
        logical :: found

        allocate (outgoing(0))
        if (any(broken)) return
        do direction = rise, fall, -2
            if (abs(came) == 1 .and. direction /= came) cycle
            if (wanted /= turn .and. direction /= wanted) cycle
            call search_way(beam, factor, before, direction, at_hand, responses, way%closed, found)
            if (.not. found) cycle
            way%direction = direction
            outgoing = [outgoing, way]
        end do
    end subroutine find_single_direction

    !> Pass breakpoints that move the wrong way until none does
    subroutine search_way(beam, factor, before, direction, at_hand, responses, closed, found)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: before(:)
        integer, intent(in) :: direction
        logical, intent(in) :: at_hand(:)
        type(responses_type), intent(inout) :: responses
        !> The region of the way
        logical, allocatable, intent(out) :: closed(:)
        logical, intent(out) :: found
        logical, allocatable :: reached(:), falling(:)
        integer :: looks, fewest, idle

        allocate (closed(size(before)), reached(size(before)), falling(size(before)))
        closed(:) = before
        reached(:) = at_hand
        found = .false.
        fewest = huge(fewest)
        idle = 0
        do looks = 1, most_looks
            if (any_falls(beam%supports, closed, reached)) return
            if (is_held_twice(beam, closed)) then
                responses%regular = .false.
            else
                call renew_responses(beam, closed, responses)
            end if
            if (.not. responses%regular) then
                if (idle > looks_without_progress) return
                ! One by one, from the beginning
                closed(:) = before
                idle = looks_without_progress + 1
                cycle
            end if
            call find_falling(beam, closed, factor, direction, reached, responses, falling)
            found = .not. any(falling)
            if (found) return
            reached(:) = reached .or. falling
            if (count(falling) < fewest) then
                fewest = count(falling)
            else
                idle = idle + 1
            end if
            call pass_breakpoints(beam%supports, falling, idle > looks_without_progress, closed)
        end do
    end subroutine search_way

    !> Do forces fall on the pieces that act, or beside breakpoints that are reached
    pure function any_falls(supports, closed, reached) result(falls)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:), reached(:)
        logical :: falls
        real(wp) :: slope
        logical :: acts
        integer :: k

        falls = .true.
        do k = 1, size(closed)
            if (supports(k)%breakpoint == 0) cycle
            if (reached(k) .and. min(supports(k)%before, supports(k)%stiffness) < 0.0_wp) return
            call piece_that_acts(supports, closed, k, acts, slope)
            if (acts .and. slope < 0.0_wp) return
        end do
        falls = .false.
    end function any_falls

    !> Pass breakpoints, those at one point of a law together
    pure subroutine pass_breakpoints(supports, falling, first_only, closed)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: falling(:)
        !> Only the first of them
        logical, intent(in) :: first_only
        logical, intent(inout) :: closed(:)
        integer :: k, begin
        logical :: state

        begin = 1
        do k = 1, size(closed)
            if (coincide(supports, k)) then
                if (closed(k) .eqv. closed(k + 1)) cycle
            end if
            if (any(falling(begin:k))) then
                state = .not. closed(k)
                closed(begin:k) = state
                if (first_only) exit
            end if
            begin = k + 1
        end do
        call open_from(supports, closed)
    end subroutine pass_breakpoints

end module gapbeam_single_direction
