!> Outgoing directions of a path from a state with supports at the end of their piece.
!>
!> While the pieces of all laws stay the same (in one region), the solutions lie on a straight line over the load factor. At its end
!> one breakpoint or more are reached, and those beyond which the solution goes on are passed. A choice of passed breakpoints is a
!> way on if the line of its region leads into it: then every breakpoint at hand moves away from zero in the direction taken,
!> with the load rising or falling. Mostly there is one way. There is none where the path ends, and there are several at a
!> bifurcation. Where the loads do work on a free motion the load stays, and the beam turns until something holds it.
!> (Katzenelson 1965; Chien and Kuh 1977; docs/method.md 8.)
!> Where no force falls there is one way, and the rates at the breakpoints at hand are a linear complementarity problem with a
!> P-matrix: breakpoints that move the wrong way are passed until none does, all at once, then the one of least index (Murty 1974).
!> So a state with many breakpoints at hand, as there are where supports unload, takes a few solves, not one for every choice of
!> them. Elsewhere all choices are tried.
module gapbeam_outgoing_directions
    use gapbeam_kinds, only: wp => qp
    use gapbeam_limits, only: most_at_once, most_looks, looks_without_progress
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_polyline_quad, only: node_support_type, coincide, piece_that_acts, open_from
    use gapbeam_law_margins_quad, only: margin_in_scheme, is_watched_in
    use gapbeam_model_quad, only: beam_type
    use gapbeam_turning_quad, only: turn_with
    use gapbeam_kinematics_quad, only: free_motions, motion_type
    use gapbeam_region_responses, only: responses_type, outgoing_type, solve_responses, renew_responses, find_falling, &
        find_index, is_held_twice, rise, fall, turn
    implicit none
    private
    public :: find_outgoing

contains

    !> Find all ways on
    subroutine find_outgoing(beam, factor, before, came, wanted, deflection, broken, at_hand, responses, outgoing, error)
        !> The beam and the load factor
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> Scheme of the way that led here, and its direction; the same way back is none
        logical, intent(in) :: before(:)
        integer, intent(in) :: came
        !> rise or fall if only such a way is asked for, turn for any
        integer, intent(in) :: wanted
        !> Of the nodes, shape (0:n)
        real(wp), intent(in) :: deflection(0:)
        !> Breakpoints at which supports have just broken: a beam that turns goes on there
        logical, intent(in) :: broken(:)
        !> Breakpoints that are reached in, and those that follow from them out
        logical, intent(inout) :: at_hand(:)
        !> Solves are counted there
        type(responses_type), intent(inout) :: responses
        type(outgoing_type), allocatable, intent(out) :: outgoing(:)
        !> Too many breakpoints at once
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: closed(:), more(:)
        integer, allocatable :: first(:), last(:)
        type(outgoing_type) :: way
        integer :: mask, u, number, count_before, direction
        logical :: leads

        call find_single_direction(beam, factor, before, came, wanted, broken, at_hand, responses, outgoing)
        if (size(outgoing) > 0) return
        allocate (closed(size(before)), more(size(before)))
        do
            call find_units(beam, before, at_hand, first, last)
            number = size(first)
            if (number > most_at_once) then
                call fatal_error(error, gapbeam_not_converged, &
                                 "so many supports reach a kink of their law at once that not "// &
                                 "all ways on can be tried: give their laws kinks that differ a little")
                return
            end if
            if (allocated(outgoing)) deallocate (outgoing)
            allocate (outgoing(0))
            more(:) = .false.
            ! With nothing passed there is the way that led here only
            do mask = merge(1, 0, number > 0 .and. (came == rise .or. came == fall)), 2**number - 1
                closed(:) = before
                do u = 1, number
                    if (btest(mask, u - 1)) closed(first(u):last(u)) = .not. before(first(u))
                end do
                if (.not. is_nested(beam%supports, closed)) cycle
                if (is_held_twice(beam, closed)) cycle
                call solve_responses(beam, closed, responses)
                if (.not. responses%regular) then
                    call try_motion(beam, closed, factor, mask == 0, came, deflection, broken, at_hand, responses, way, leads, more)
                    if (leads) outgoing = [outgoing, way]
                    cycle
                end if
                do direction = rise, fall, -2
                    if (mask == 0 .and. direction == -came) cycle
                    if (wanted /= turn .and. direction /= wanted) cycle
                    call follow_region(beam, closed, factor, direction, at_hand, responses, leads, more)
                    if (.not. leads) cycle
                    way%closed = closed
                    way%direction = direction
                    way%still = abs(responses%response%v1) <= responses%response%error_of_v1
                    if (allocated(way%motion)) deallocate (way%motion)
                    call find_index(beam, closed, responses, way%index)
                    outgoing = [outgoing, way]
                end do
            end do
            count_before = count(at_hand)
            at_hand(:) = at_hand .or. more
            if (count(at_hand) == count_before) exit
        end do
    end subroutine find_outgoing

    !> Does the line of a region lead into it, and what else is at zero and falls along it
    subroutine follow_region(beam, closed, factor, direction, at_hand, responses, leads, more)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: direction
        logical, intent(in) :: at_hand(:)
        type(responses_type), intent(in) :: responses
        logical, intent(out) :: leads
        logical, intent(inout) :: more(:)
        logical, allocatable :: falling(:)

        allocate (falling(size(closed)))
        call find_falling(beam, closed, factor, direction, at_hand, responses, falling)
        leads = .not. any(falling .and. at_hand)
        if (.not. leads) return
        leads = .not. any(falling)
        more(:) = more .or. falling
    end subroutine follow_region

    !> A region without a unique solution: does the beam move freely, and into it
    subroutine try_motion(beam, closed, factor, as_before, came, deflection, broken, at_hand, responses, way, leads, more)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        !> Is it the scheme that led here
        logical, intent(in) :: as_before
        integer, intent(in) :: came
        real(wp), intent(in) :: deflection(0:)
        logical, intent(in) :: broken(:), at_hand(:)
        type(responses_type), intent(in) :: responses
        type(outgoing_type), intent(out) :: way
        logical, intent(out) :: leads
        !> What else is at zero and would be passed
        logical, intent(inout) :: more(:)
        type(motion_type), allocatable :: motions(:)
        real(wp), allocatable :: y(:), none(:)
        logical, allocatable :: touched(:)
        real(wp) :: speed, margin, rounding
        integer :: k, sign
        logical :: moves, by_force

        leads = .false.
        if (as_before .and. came == turn) return
        call free_motions(beam, closed, motions)
        if (size(motions) /= 1) return
        allocate (y(0:ubound(deflection, 1)), none(size(closed)), touched(size(closed)))
        none(:) = 0.0_wp
        do sign = 1, -1, -2
            y(:) = 0.0_wp
            y(motions(1)%first:motions(1)%last) = sign*motions(1)%displacement
            call turn_with(beam, y)
            leads = .true.
            moves = .false.
            touched(:) = .false.
            do k = 1, size(closed)
                if (broken(k)) then
                    speed = beam%supports(k)%side*y(beam%supports(k)%node)
                    leads = leads .and. speed >= 0.0_wp
                    moves = moves .or. speed > 0.0_wp
                end if
                if (.not. is_watched_in(beam%supports, closed, k)) cycle
                associate (node => beam%supports(k)%node)
                    call margin_in_scheme(responses%incremental%supports, closed, k, y(node) + responses%settling(k), 0.0_wp, &
                                          none, none, speed, rounding, by_force)
                    if (by_force) cycle
                    if (at_hand(k)) then
                        leads = leads .and. speed >= 0.0_wp
                        moves = moves .or. speed > 0.0_wp
                    else
                        call margin_in_scheme(beam%supports, closed, k, deflection(node) - factor*responses%settling(k), &
                                              abs(deflection(node)), none, none, margin, rounding)
                        touched(k) = speed < 0.0_wp .and. margin <= 64*rounding
                    end if
                end associate
            end do
            leads = leads .and. moves
            if (leads) exit
        end do
        if (leads .and. any(touched)) then
            more(:) = more .or. touched
            leads = .false.
        end if
        if (.not. leads) return
        way%closed = closed
        way%direction = turn
        way%motion = y
    end subroutine try_motion

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
        integer, allocatable :: first(:), last(:)
        integer :: looks, fewest, idle, u

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
            call find_units(beam, closed, falling, first, last)
            do u = 1, merge(1, size(first), idle > looks_without_progress)
                closed(first(u):last(u)) = .not. closed(first(u):last(u))
            end do
            call open_from(beam%supports, closed)
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

    !> Breakpoints that are passed together: first and last of each unit
    pure subroutine find_units(beam, closed, at_hand, first, last)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), at_hand(:)
        integer, allocatable, intent(out) :: first(:), last(:)
        integer :: k, begin

        allocate (first(0), last(0))
        begin = 1
        do k = 1, size(at_hand)
            if (coincide(beam%supports, k)) then
                if (closed(k) .eqv. closed(k + 1)) cycle
            end if
            if (any(at_hand(begin:k))) then
                first = [first, begin]
                last = [last, k]
            end if
            begin = k + 1
        end do
    end subroutine find_units

    !> Are the breakpoints of every law closed up to one
    pure function is_nested(supports, closed) result(nested)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        logical :: nested
        integer :: k

        nested = .true.
        do k = 2, size(closed)
            if (supports(k)%breakpoint > 1) nested = nested .and. (closed(k - 1) .or. .not. closed(k))
        end do
    end function is_nested

end module gapbeam_outgoing_directions
