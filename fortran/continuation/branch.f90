!> Path of a beam whose supports soften, break or unload off their law, through limit points.
!> It goes from breakpoint to breakpoint, in double precision by local updates where these leave no doubt (gapbeam_local_step), else
!> in quadruple precision.
!>
!> The solution is followed along itself (gapbeam_outgoing_directions), so the load factor may fall; nothing is stepped and nothing
!> iterates.
!> As no region is crossed twice, a path of laws without memory has finitely many segments (docs/method.md 11). A support that
!> unloads in a way of its own has its law written anew from the point where it is: its breakpoints up to there become one, at
!> that point, before which lies a line with the slope of the first piece, down to its set.
module gapbeam_branch
    use gapbeam_kinds, only: wp => qp, dp => wp
    use gapbeam_path_tolerances, only: same_breakpoint
    use gapbeam_error, only: error_type
    use gapbeam_polyline_quad, only: break_law, last_breakpoint
    use gapbeam_unloading_quad, only: unload, rewrite_laws
    use gapbeam_law_margins_quad, only: margin_in_scheme, is_watched_in
    use gapbeam_model, only: coarse_beam_type => beam_type
    use gapbeam_model_quad, only: beam_type, last_place
    use gapbeam_affine_response_quad, only: value_at, width_at, zero_of
    use gapbeam_region_responses, only: outgoing_type, new_responses, solve_responses, are_one, turn, rise, fall, from_nowhere
    use gapbeam_outgoing_directions, only: find_outgoing
    use gapbeam_stretch, only: tell_reactions
    use gapbeam_local_step, only: new_local, enter_local, find_next, pass_breakpoints, take_direction, local_index, &
        clear_arrival, doubtful
    use gapbeam_branch_state, only: branch_type, note_place, break_supports, find_shared, sense_of, laws_of, parallel, stays_broken
    implicit none
    private
    public :: branch_type, segment_type, start_branch, step_branch, laws_of, goes_on, arrived, no_way_on, never_ends, not_told

    !> What a step came to: the next breakpoint; the factor asked for; the end of the path; no further breakpoint, whatever the
    !> load; supports of which nothing tells how they share a change of load
    integer, parameter :: goes_on = 0, arrived = 1, no_way_on = 2, never_ends = 3, not_told = 4

    !> A stretch of the path on which all pieces stay the same
    type :: segment_type
        real(wp) :: from = 0.0_wp, to = 0.0_wp
    end type segment_type

contains

    !> Begin at a load factor
    subroutine start_branch(beam, in_doubles, unloading, settling, closed, factor, direction, branch, outcome, error)
        !> The beam, the same in double precision but for its laws, and how each of its supports unloads
        type(beam_type), intent(in) :: beam
        type(coarse_beam_type), intent(in) :: in_doubles
        integer, intent(in) :: unloading(:)
        !> How fast each of them moves itself with the factor
        real(wp), intent(in) :: settling(:)
        !> Its scheme there
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        !> rise or fall: where the load goes
        integer, intent(in) :: direction
        type(branch_type), intent(out) :: branch
        !> goes_on, no_way_on or not_told
        integer, intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error

        branch%beam = beam
        branch%unloading = unloading
        branch%first_slope = beam%supports%stiffness
        branch%factor = factor
        call new_responses(beam, branch%responses)
        branch%responses%settling(:) = settling
        ! Stretches on ground and under axial forces have no local updates
        if (.not. allocated(beam%ground)) call new_local(in_doubles, unloading == parallel, settling, branch%local)
        allocate (branch%deflection(0:last_place(beam)), source=0.0_wp)
        call solve_responses(branch%beam, closed, branch%responses)
        branch%way%closed = closed
        branch%way%direction = direction
        if (branch%responses%regular) call note_place(branch)
        call go_on(branch, direction, direction, spread(.false., 1, size(closed)), outcome, error)
    end subroutine start_branch

    !> Go on to the next breakpoint, or to a factor
    subroutine step_branch(branch, target, leg, segment, outcome, error)
        type(branch_type), intent(inout) :: branch
        !> The factor at which the path ends, if it comes there in the direction of the leg (rise or fall)
        real(wp), intent(in) :: target
        integer, intent(in) :: leg
        !> What was passed; branch%way is another one already where the path goes on
        type(segment_type), intent(out) :: segment
        !> goes_on, arrived, no_way_on, never_ends or not_told
        integer, intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: at_hand(:)
        real(wp) :: next
        integer :: direction
        logical :: done

        direction = branch%way%direction
        if (allocated(branch%touched)) deallocate (branch%touched)
        call step_locally(branch, target, leg, segment, outcome, done)
        if (done) return
        segment = segment_type(branch%factor, branch%factor)
        if (direction == turn) then
            call turn_on(branch, at_hand)
            outcome = never_ends
            if (.not. any(at_hand)) return
        else
            call enter_next_interval(branch, target, next, at_hand)
            if (direction == leg .and. direction*(next - target) >= 0.0_wp) then
                branch%factor = target
                segment%to = target
                outcome = arrived
                call note_place(branch)
                return
            end if
            outcome = never_ends
            if (.not. abs(next) < huge(next)) return
            branch%factor = next
            segment%to = next
            call note_place(branch)
            if (branch%local%current .and. abs(next - segment%from) > 0.0_wp .and. count(at_hand) == 1) then
                branch%local%stretch%in_doubt = .false.
                call pass_locally(branch, [findloc(at_hand, .true., 1)], real(next, dp), leg, done)
                outcome = goes_on
                if (done) return
            end if
            branch%local%current = .false.
        end if
        call go_on(branch, leg, turn, at_hand, outcome, error)
    end subroutine step_branch

    !> The same in double precision
    subroutine step_locally(branch, target, leg, segment, outcome, done)
        !> As for step_branch
        type(branch_type), intent(inout) :: branch
        real(wp), intent(in) :: target
        integer, intent(in) :: leg
        type(segment_type), intent(out) :: segment
        integer, intent(out) :: outcome
        !> If not, the branch is where it was, its lines in quadruple precision at hand
        logical, intent(out) :: done
        integer, allocatable :: numbers(:)
        integer :: found
        real(dp) :: next

        done = .false.
        outcome = goes_on
        associate (way => branch%way, local => branch%local)
            if (way%direction == turn .or. .not. local%usable) return
            if (.not. local%current) then
                call enter_local(branch%beam%supports, way%closed, branch%factor, way%direction, local)
                if (.not. local%current) return
            end if
            call tell_reactions(local%beam, local%stretch)
            call find_next(local, way%closed, real(branch%factor, dp), real(target, dp), &
                           way%direction == leg .and. abs(target) < huge(target), next, numbers, found)
            segment%from = branch%factor
            if (found == clear_arrival) then
                segment%to = target
                branch%factor = target
                outcome = arrived
                done = .true.
                return
            end if
            if (found /= doubtful) call pass_locally(branch, numbers, next, leg, done)
            if (done) then
                branch%factor = next
                segment%to = next
                return
            end if
            ! Where what comes next is doubtful, its factor may be all that is
            local%current = found == doubtful .and. .not. local%may_fall
            if (local%steps == 0) return
            call solve_responses(branch%beam, way%closed, branch%responses)
            if (branch%responses%regular) call note_place(branch)
        end associate
    end subroutine step_locally

    !> Pass breakpoints in double precision
    subroutine pass_locally(branch, numbers, factor, leg, done)
        type(branch_type), intent(inout) :: branch
        !> The breakpoint, or several, and their load factor
        integer, intent(in) :: numbers(:)
        real(dp), intent(in) :: factor
        integer, intent(in) :: leg
        !> If not, the branch is where it was
        logical, intent(out) :: done
        type(outgoing_type) :: way
        integer :: direction
        logical :: breaks

        done = .false.
        associate (k => numbers(1), s => branch%beam%supports(numbers(1)), local => branch%local, closed => branch%way%closed)
            breaks = branch%unloading(k) == stays_broken .and. .not. closed(k) .and. s%before < -huge(1.0_wp)
            if (breaks .and. local%any_set) return
            call pass_breakpoints(local, numbers, breaks, factor, closed, direction)
            if (local%stretch%current .and. (direction /= turn .or. breaks)) then
                way%index = local_index(local, closed)
                way%direction = direction
                ! What is gone leaves the same line, to go either way
                if (breaks) way%direction = leg
                if (breaks .and. way%index > 0 .and. branch%sense*sense_of(way) < 0) way%direction = -leg
                call take_direction(local, closed, factor, way%direction, breaks)
                done = local%current
            end if
            if (.not. done) call switch(local%changed, closed)
        end associate
        if (.not. done) return
        call take_laws(branch, numbers(1), breaks)
        if (allocated(branch%outgoing)) deallocate (branch%outgoing)
        allocate (branch%outgoing(merge(2, 1, breaks)))
        ! Its scheme is asked for where there are others
        if (breaks) way%closed = branch%way%closed
        branch%outgoing(:) = way
        if (breaks) branch%outgoing%direction = [rise, fall]
        branch%taken = findloc(branch%outgoing%direction, way%direction, 1)
        branch%way%direction = way%direction
        branch%way%index = way%index
        if (allocated(branch%way%still)) deallocate (branch%way%still)
        if (allocated(branch%way%motion)) deallocate (branch%way%motion)
        branch%sense = sense_of(way)
    end subroutine pass_locally

    !> Open breakpoints that are closed, and close those that are open
    pure subroutine switch(numbers, closed)
        !> One that is there twice stays as it is
        integer, intent(in) :: numbers(:)
        logical, intent(inout) :: closed(:)
        integer :: i

        do i = 1, size(numbers)
            closed(numbers(i)) = .not. closed(numbers(i))
        end do
    end subroutine switch

    !> Take over the laws that a step in double precision has written anew, and note what it has touched
    subroutine take_laws(branch, k, breaks)
        type(branch_type), intent(inout) :: branch
        !> The breakpoint that was passed, and whether its support has broken there
        integer, intent(in) :: k
        logical, intent(in) :: breaks
        logical, allocatable :: before(:)
        integer :: i, j, first, changed(2)

        associate (local => branch%local, laws => branch%beam%supports, closed => branch%way%closed)
            branch%touched = local%changed
            if (breaks) then
                call break_law(laws, k)
                branch%touched = [branch%touched, (j, j=k - laws(k)%breakpoint + 1, k)]
            end if
            branch%rounded_places = branch%rounded_places .or. size(local%turned) > 0
            do i = 1, size(local%turned)
                first = local%turned(i) - laws(local%turned(i))%breakpoint + 1
                associate (last => last_breakpoint(laws, first))
                    before = closed(first:last)
                    call switch(pack(local%changed - first + 1, local%changed >= first .and. local%changed <= last), before)
                    call unload(laws(first:last), before, 1, branch%first_slope(first), real(local%turned_at(i), wp), &
                                real(local%turned_with(i), wp), changed)
                    branch%touched = [branch%touched, (j, j=first, last)]
                end associate
            end do
        end associate
    end subroutine take_laws

    !> Choose the way on: one that is stable under growing load if there is one, else the least unstable
    subroutine go_on(branch, leg, wanted, at_hand, outcome, error)
        type(branch_type), intent(inout) :: branch
        integer, intent(in) :: leg, wanted
        !> Breakpoints that are reached
        logical, intent(in) :: at_hand(:)
        integer, intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(outgoing_type), allocatable :: outgoing(:)
        logical, allocatable :: reached(:), broken(:), other(:)
        integer :: v, w, best, came

        allocate (reached, source=at_hand)
        allocate (broken(size(at_hand)))
        call break_supports(branch, reached, broken)
        associate (laws => branch%beam%supports, work => branch%responses)
            ! Beside its own movement, which goes on
            call rewrite_laws(laws, branch%way%closed, branch%unloading == parallel, branch%first_slope, &
                              branch%deflection(laws%node) - branch%factor*work%settling, &
                              work%dead%reaction + branch%factor*work%live%reaction)
        end associate
        came = branch%way%direction
        ! What is gone leaves the same line, to go either way
        if (wanted /= turn .or. any(broken)) came = from_nowhere
        call find_outgoing(branch%beam, branch%factor, branch%way%closed, came, wanted, branch%deflection, broken, reached, &
                           branch%responses, outgoing, error)
        outcome = no_way_on
        if (allocated(error)) return
        call move_alloc(outgoing, branch%outgoing)
        if (size(branch%outgoing) == 0) return
        best = 1
        do w = 2, size(branch%outgoing)
            if (preference(branch%outgoing(w)) < preference(branch%outgoing(best))) best = w
        end do
        branch%way = branch%outgoing(best)
        allocate (other(size(branch%outgoing)))
        do w = 1, size(other)
            other(w) = w == best .or. .not. are_one(branch%outgoing(w), branch%way)
            if (other(w) .and. w /= best) other(w) = .not. any([(are_one(branch%outgoing(w), branch%outgoing(v)), v=1, w - 1)])
        end do
        branch%taken = count(other(:best))
        branch%outgoing = branch%outgoing(pack([(w, w=1, size(other))], other))
        if (branch%way%direction /= turn) branch%sense = sense_of(branch%way)
        if (any(branch%responses%closed .neqv. branch%way%closed)) then
            call solve_responses(branch%beam, branch%way%closed, branch%responses)
        end if
        outcome = goes_on
        if (branch%way%direction /= turn) call find_shared(branch)
        if (all(branch%shared > 0)) outcome = not_told

    contains

        !> Stable ways come first; of equals the one in which the load goes where it should
        pure function preference(way) result(last)
            type(outgoing_type), intent(in) :: way
            !> The less the better
            integer :: last

            last = 3*way%index
            if (way%direction == turn) last = last + 1
            if (way%direction == -leg) last = last + 2
            ! The others might lead back to where the path came from
            if (last > 0 .and. way%direction /= turn .and. branch%sense*sense_of(way) < 0) last = last + 2**20
        end function preference

    end subroutine go_on

    !> The next breakpoint along a line
    subroutine enter_next_interval(branch, target, next, at_hand)
        type(branch_type), intent(in) :: branch
        !> What is there but for rounding is there, and so it is at 0
        real(wp), intent(in) :: target
        !> Its load factor; huge if there is none
        real(wp), intent(out) :: next
        !> The breakpoints there
        logical, allocatable, intent(out) :: at_hand(:)
        real(wp), allocatable :: zeros(:)
        real(wp) :: passed, slack, same
        integer :: k, direction

        direction = branch%way%direction
        next = direction*huge(next)
        same = 64*merge(real(epsilon(1.0_dp), wp), epsilon(1.0_wp), branch%rounded_places)
        passed = abs(branch%factor)
        if (abs(target) < huge(target)) passed = max(passed, abs(target))
        associate (supports => branch%beam%supports, closed => branch%way%closed, responses => branch%responses%response)
            allocate (at_hand(size(closed)), zeros(size(closed)))
            at_hand(:) = .false.
            do k = 1, size(closed)
                at_hand(k) = is_watched_in(supports, closed, k) .and. direction*responses(k)%v1 < -responses(k)%error_of_v1
                if (.not. at_hand(k)) cycle
                associate (zero => zeros(k))
                    zero = zero_of(responses(k))
                    slack = max(same*passed, width_at(responses(k), zero)/abs(responses(k)%v1))
                    if (abs(zero) <= slack) zero = 0.0_wp
                    if (abs(zero - target) <= slack) zero = target
                    ! What is behind by rounding is here
                    if (abs(zero - branch%factor) <= slack) zero = branch%factor
                    next = direction*min(direction*next, max(direction*zero, direction*branch%factor))
                end associate
            end do
            do k = 1, size(closed)
                if (.not. at_hand(k)) cycle
                ! What ends the stretch is at hand, whatever rounding leaves of it there
                at_hand(k) = direction*zeros(k) <= direction*next + merge(same*passed, 0.0_wp, branch%rounded_places) &
                    .or. value_at(responses(k), next) <= 2*width_at(responses(k), next)
            end do
        end associate
    end subroutine enter_next_interval

    !> Turn until something holds the beam
    subroutine turn_on(branch, at_hand)
        type(branch_type), intent(inout) :: branch
        !> What does; none if nothing
        logical, allocatable, intent(out) :: at_hand(:)
        real(wp), allocatable :: way(:), none(:)
        real(wp) :: speed, margin, rounding
        logical :: by_force
        integer :: k

        associate (supports => branch%beam%supports, closed => branch%way%closed, motion => branch%way%motion)
            allocate (at_hand(size(closed)), way(size(closed)), none(size(closed)))
            none(:) = 0.0_wp
            way(:) = huge(way)
            do k = 1, size(closed)
                if (.not. is_watched_in(supports, closed, k)) cycle
                associate (settling => branch%responses%settling(k), node => supports(k)%node)
                    call margin_in_scheme(branch%responses%incremental%supports, closed, k, motion(node) + settling, 0.0_wp, none, &
                                          none, speed, rounding, by_force)
                    if (by_force .or. .not. speed < 0.0_wp) cycle
                    call margin_in_scheme(supports, closed, k, branch%deflection(node) - branch%factor*settling, 0.0_wp, none, &
                                          none, margin, rounding, by_force)
                end associate
                way(k) = max(0.0_wp, margin)/(-speed)
            end do
            at_hand(:) = way < huge(way)
            if (.not. any(at_hand)) return
            at_hand(:) = at_hand .and. way <= minval(way)*(1 + same_breakpoint)
            branch%deflection(:) = branch%deflection + minval(way)*motion
        end associate
    end subroutine turn_on

end module gapbeam_branch
