!> Path of a beam whose supports soften, break or unload off their law, through limit points.
!> It goes from breakpoint to breakpoint, in quadruple precision.
!>
!> The solution is followed along itself (gapbeam_outgoing_directions), so the load factor may fall; nothing is stepped and nothing
!> iterates.
!> As no region is crossed twice, a path of laws without memory has finitely many segments (docs/method.md 8). A support that
!> unloads in a way of its own has its law written anew from the point where it is: its breakpoints up to there become one, at
!> that point, before which lies a line with the slope of the first piece, down to its set.
module gapbeam_branch
    use gapbeam_kinds, only: wp => qp
    use gapbeam_path_tolerances, only: same_breakpoint
    use gapbeam_error, only: error_type
    use gapbeam_polyline_quad, only: node_support_type, piece_that_acts, last_breakpoint
    use gapbeam_law_margins_quad, only: margin_in_scheme, is_watched_in
    use gapbeam_model_quad, only: beam_type
    use gapbeam_affine_response_quad, only: value_at, width_at, zero_of
    use gapbeam_region_responses, only: responses_type, outgoing_type, new_responses, solve_responses, are_one, turn, &
        from_nowhere
    use gapbeam_outgoing_directions, only: find_outgoing
    implicit none
    private
    public :: branch_type, segment_type, start_branch, step_branch, goes_on, arrived, no_way_on, never_ends, not_told
    public :: along_law, parallel, stays_broken

    !> How a support unloads
    integer, parameter :: along_law = 0, parallel = 1, stays_broken = 2
    !> What a step came to: the next breakpoint; the factor asked for; the end of the path; no further breakpoint, whatever the
    !> load; supports of which nothing tells how they share a change of load
    integer, parameter :: goes_on = 0, arrived = 1, no_way_on = 2, never_ends = 3, not_told = 4

    !> A path on its way
    type :: branch_type
        !> The beam, with the laws as they have become
        type(beam_type) :: beam
        type(responses_type) :: responses
        !> How each support unloads, shape (size(supports)); slopes of the first pieces
        integer, allocatable :: unloading(:)
        real(wp), allocatable :: first_slope(:)
        real(wp) :: factor = 0.0_wp
        type(outgoing_type) :: way
        !> Deflections of the nodes, shape (0:n)
        real(wp), allocatable :: deflection(:)
        !> Ways on there were at the last breakpoint, and which is taken
        type(outgoing_type), allocatable :: outgoing(:)
        integer :: taken = 0
        !> Direction of the load times (-1)**index: it stays along the path (Eaves and Scarf 1976)
        integer :: sense = 0
        !> The two supports, where nothing tells how they share what comes
        integer :: shared(2) = 0
    end type branch_type

    !> A stretch of the path on which all pieces stay the same
    type :: segment_type
        real(wp) :: from = 0.0_wp, to = 0.0_wp
    end type segment_type

contains

    !> Begin at a load factor
    subroutine start_branch(beam, unloading, settling, closed, factor, direction, branch, outcome, error)
        !> The beam, and how each of its supports unloads
        type(beam_type), intent(in) :: beam
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
        allocate (branch%deflection(0:size(beam%links)))
        branch%deflection(:) = 0.0_wp
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

        direction = branch%way%direction
        segment%from = branch%factor
        segment%to = branch%factor
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
        end if
        call go_on(branch, leg, turn, at_hand, outcome, error)
    end subroutine step_branch

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

        allocate (reached(size(at_hand)))
        reached(:) = at_hand
        allocate (broken(size(at_hand)))
        call break_supports(branch, reached, broken)
        call rewrite_laws(branch)
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

        !> Direction of the load times (-1)**index
        pure function sense_of(way) result(sense)
            type(outgoing_type), intent(in) :: way
            integer :: sense

            sense = way%direction*merge(1, -1, modulo(way%index, 2) == 0)
        end function sense_of

    end subroutine go_on

    !> Find supports at one node that could share a change of load in any way: one on a vertical piece, another one at the end of
    !> such a piece at the same deflection, to which its own set has brought it
    subroutine find_shared(branch)
        type(branch_type), intent(inout) :: branch
        real(wp) :: slope, rate
        logical :: acts, rigid
        integer :: i, j, k

        associate (beam => branch%beam, closed => branch%way%closed)
            do k = 1, size(closed)
                associate (s => beam%supports(k))
                    acts = closed(k)
                    slope = s%stiffness
                    if (s%breakpoint > 0) call piece_that_acts(beam%supports, closed, k, acts, slope)
                    if (.not. (acts .and. slope > huge(slope))) cycle
                    rate = branch%way%direction*s%side*branch%responses%live%reaction(k)
                    do i = beam%first(s%node), beam%first(s%node + 1) - 1
                        j = beam%order(i)
                        associate (other => beam%supports(j))
                            if (branch%unloading(j) /= parallel .or. other%passed .or. other%side /= s%side) cycle
                            if (abs(other%contact - s%contact) > same_breakpoint*abs(s%contact)) cycle
                            rigid = rate < 0.0_wp .and. ends_at(beam%supports, closed, j) .and. other%before > huge(rate)
                            if (other%breakpoint == 1 .and. .not. closed(j)) rigid = rate > 0.0_wp &
                                .and. other%stiffness > huge(rate)
                            if (rigid) branch%shared = [k, j]
                        end associate
                    end do
                end associate
            end do
        end associate
    end subroutine find_shared

    !> Is a closed breakpoint the last one that is not passed before the piece that acts
    pure function ends_at(supports, closed, k) result(last)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical :: last
        integer :: j

        j = k
        do while (supports(j)%more)
            if (.not. supports(j + 1)%passed) exit
            j = j + 1
        end do
        last = closed(k)
        if (supports(j)%more) last = last .and. .not. closed(j + 1)
    end function ends_at

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
        real(wp) :: passed, slack
        integer :: k, direction

        direction = branch%way%direction
        next = direction*huge(next)
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
                    slack = max(same_breakpoint*passed, width_at(responses(k), zero)/abs(responses(k)%v1))
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
                at_hand(k) = direction*zeros(k) <= direction*next &
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

    !> Deflections at the factor at hand
    subroutine note_place(branch)
        type(branch_type), intent(inout) :: branch

        branch%deflection(:) = branch%responses%dead%answers%deflection + branch%factor*branch%responses%live%answers%deflection
    end subroutine note_place

    !> Break supports that stay broken at the end of a drop of their force: what lies before it is gone
    subroutine break_supports(branch, at_hand, broken)
        type(branch_type), intent(inout) :: branch
        !> Breakpoints that are reached in, without those out
        logical, intent(inout) :: at_hand(:)
        !> Those of them at which supports break
        logical, intent(out) :: broken(:)
        integer :: k, first

        broken(:) = .false.
        do k = 1, size(at_hand)
            associate (s => branch%beam%supports)
                if (.not. at_hand(k) .or. branch%way%closed(k) .or. branch%unloading(k) /= stays_broken) cycle
                if (.not. s(k)%before < -huge(1.0_wp)) cycle
                broken(k) = .true.
                at_hand(k) = .false.
                branch%way%closed(k) = .true.
                ! One line, on both sides of its breakpoints
                first = k - s(k)%breakpoint + 1
                s(first:k)%contact = s(k)%contact
                s(first:k)%force = s(k)%force
                s(first:k)%before = s(k)%stiffness
                s(first:k)%stiffness = s(k)%stiffness
                s(first:k)%passed = .true.
            end associate
        end do
    end subroutine break_supports

    !> Write the laws of supports that keep a set anew, from where they are
    subroutine rewrite_laws(branch)
        type(branch_type), intent(inout) :: branch
        real(wp) :: deflection, force, slope
        logical :: acts
        integer :: k, last, top

        k = 1
        do while (k <= size(branch%way%closed))
            last = last_breakpoint(branch%beam%supports, k)
            top = k - 1 + count(branch%way%closed(k:last))
            if (branch%unloading(k) == parallel .and. top > k) then
                associate (s => branch%beam%supports, work => branch%responses)
                    call piece_that_acts(s, branch%way%closed, top, acts, slope)
                    ! Beside its own movement, which goes on
                    deflection = branch%deflection(s(k)%node) - branch%factor*work%settling(k)
                    if (abs(slope) > huge(slope)) then
                        deflection = s(top)%contact
                        force = s(k)%side*(work%dead%reaction(top) + branch%factor*work%live%reaction(top))
                    else
                        force = s(top)%force + slope*s(top)%side*(deflection - s(top)%contact)
                    end if
                    s(k)%contact = deflection
                    if (abs(branch%first_slope(k)) <= huge(slope)) s(k)%contact = deflection - s(k)%side*force/branch%first_slope(k)
                    s(k + 1:top)%contact = deflection
                    s(k + 1:top)%force = force
                    s(k + 1:top)%stiffness = s(top)%stiffness
                    s(k + 2:top)%before = s(top)%stiffness
                    s(k + 2:top)%passed = .true.
                    s(k + 1)%before = branch%first_slope(k)
                end associate
            end if
            k = last + 1
        end do
    end subroutine rewrite_laws

end module gapbeam_branch
