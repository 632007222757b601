!> The next breakpoint of a path and the region beyond it in double precision, by local updates.
!>
!> Where one support alone reaches a breakpoint, the region beyond it is the only way on, and the load goes as that breakpoint moves
!> away from zero. Where no force falls and several reach theirs at once, as in symmetric beams, there is one way on too: that
!> beyond all of them, if all move away from zero there. Lines are updated around them (gapbeam_stretch). Whatever rounding errors
!> leave open (what does not move, factors that lose digits) is left to quadruple precision (gapbeam_branch).
module gapbeam_local_step
    use gapbeam_kinds, only: wp, qp
    use gapbeam_band, only: band_ok, count_unstable_pivots
    use gapbeam_polyline, only: node_support_type, piece_that_acts, break_law, find_unit, last_breakpoint, vertical_pieces
    use gapbeam_unloading, only: unload
    use gapbeam_polyline_quad, only: fine_support_type => node_support_type
    use gapbeam_law_margins, only: is_watched_in
    use gapbeam_model, only: beam_type
    use gapbeam_update, only: update_scheme
    use gapbeam_affine_response, only: response_type, falls, rises, value_at, width_at, zero_of
    use gapbeam_queue, only: first_key, all_up_to
    use gapbeam_stretch, only: stretch_type, new_stretch, start_stretch, queue_all, change_supports, next_in_queue, response_in, &
        unloads_from_here
    implicit none
    private
    public :: local_type, new_local, enter_local, find_next, pass_breakpoints, take_direction, local_index, rounded, find_passed
    public :: clear_arrival, doubtful

    !> What find_next came to
    integer, parameter :: clear_event = 0, clear_arrival = 1, doubtful = 2
    !> Share of a load factor by which it may be off, its bound of rounding errors being many times what they are
    real(wp), parameter :: share_off = 2.0_wp**(-34)
    !> Growth of rounding errors in elimination, where forces fall, that refinement takes back and the signs allow
    real(wp), parameter :: most_growth = 2.0_wp**16
    !> Rounding errors within which factors are not told apart
    real(wp), parameter :: slack = 64*epsilon(1.0_wp)

    !> Rounds in which supports turn back in turn where others yield
    integer, parameter :: most_turns = 8

    !> A path in double precision
    type :: local_type
        !> May it be tried; are its lines those of the way at hand; steps since quadruple precision had them
        logical :: usable = .false., current = .false.
        integer :: steps = 0
        !> What changed in the last of them
        integer, allocatable :: changed(:)
        !> Last breakpoints passed by supports that began to unload in it; their deflections and reactions
        integer, allocatable :: turned(:)
        real(wp), allocatable :: turned_at(:), turned_with(:)
        !> The beam, with the laws as they have become but for those that keep a set and go on loading
        type(beam_type) :: beam
        type(stretch_type) :: stretch
        !> How fast supports move themselves with the factor; slopes of the first pieces
        real(wp), allocatable :: settling(:), first_slope(:)
        !> Do forces of some law fall; does a support keep a set
        logical :: may_fall = .false., any_set = .false.
    end type local_type

contains

    !> Room for a path in double precision
    subroutine new_local(beam, keeps_set, settling, local)
        type(beam_type), intent(in) :: beam
        !> Which supports unload parallel to their first piece; how fast they move themselves, shape (size(supports))
        logical, intent(in) :: keeps_set(:)
        real(qp), intent(in) :: settling(:)
        type(local_type), intent(out) :: local
        integer :: i

        local%usable = .true.
        local%beam = beam
        local%settling = real(settling, wp)
        local%first_slope = beam%supports%stiffness
        local%any_set = any(keeps_set)
        local%may_fall = any(beam%supports%breakpoint > 0 .and. min(beam%supports%before, beam%supports%stiffness) < 0.0_wp)
        do i = 0, size(beam%links)
            ! What rigid supports that keep a set share, statics cannot tell (gapbeam_branch)
            associate (there => beam%order(beam%first(i):beam%first(i + 1) - 1))
                if (count(beam%supports(there)%breakpoint <= 1) <= 1) cycle
                local%usable = local%usable .and. .not. any(keeps_set(there) .and. beam%supports(there)%stiffness > huge(1.0_wp))
            end associate
        end do
        call new_stretch(beam, local%stretch)
        local%stretch%share_off = share_off
        if (local%any_set) local%stretch%keeps_set = keeps_set
    end subroutine new_local

    !> Solve the lines of a region that is the right one
    subroutine enter_local(laws, closed, factor, direction, local)
        !> The laws as they have become, the scheme, and where the load is and goes, 1 or -1
        type(fine_support_type), intent(in) :: laws(:)
        logical, intent(in) :: closed(:)
        real(qp), intent(in) :: factor
        integer, intent(in) :: direction
        !> Not current if anything is in doubt
        type(local_type), intent(inout) :: local
        integer :: window(2), state
        real(wp) :: here

        associate (stretch => local%stretch, n => size(local%beam%links))
            local%beam%supports = rounded(laws, local%beam%supports)
            local%beam%supports%passed = laws%passed
            call renew_rates(local, 1, size(closed))
            stretch%direction = real(direction, wp)
            stretch%in_doubt = .false.
            stretch%turns_back = .false.
            here = direction*real(factor, wp)
            call start_stretch(local%beam, closed, here, stretch)
            if (stretch%current .and. any(stretch%dead%nodes%stiffness < 0.0_wp)) then
                ! Solved with pivoting: with the factor without, corrected, once more
                call update_scheme(local%beam, closed, [0, n], .true., stretch%dead, window, state)
                if (state == band_ok) call update_scheme(stretch%incremental, closed, [0, n], .true., stretch%live, window, state)
                stretch%current = state == band_ok
                if (stretch%current) call queue_all(local%beam, closed, here, stretch)
            end if
        end associate
        local%steps = 0
        local%current = is_clear(local, here)
    end subroutine enter_local

    !> The laws for the rates: moved by the supports' own movement only
    pure subroutine renew_rates(local, first, last)
        type(local_type), intent(inout) :: local
        !> Breakpoints
        integer, intent(in) :: first, last

        associate (rates => local%stretch%incremental%supports(first:last))
            rates = local%beam%supports(first:last)
            rates%contact = local%settling(first:last)
            rates%force = 0.0_wp
        end associate
    end subroutine renew_rates

    !> Is nothing about the lines in doubt, and nothing at zero that would be passed at once
    pure function is_clear(local, here)
        type(local_type), intent(in) :: local
        !> The factor in the direction of the load
        real(wp), intent(in) :: here
        logical :: is_clear

        associate (stretch => local%stretch)
            is_clear = stretch%current .and. .not. (stretch%in_doubt .or. stretch%turns_back)
            if (is_clear .and. local%may_fall) is_clear = max(stretch%dead%growth, stretch%live%growth) <= most_growth
            if (is_clear) is_clear = first_key(stretch%queue) > here
        end associate
    end function is_clear

    !> The next breakpoint along the lines, or the end of the leg
    subroutine find_next(local, closed, factor, target, arrives, next, at_zero, found)
        type(local_type), intent(inout) :: local
        logical, intent(in) :: closed(:)
        !> Load factors at hand and at the end of the leg; does the load go there
        real(wp), intent(in) :: factor, target
        logical, intent(in) :: arrives
        !> Load factor of the breakpoint, and its number; or those of several
        real(wp), intent(out) :: next
        integer, allocatable, intent(out) :: at_zero(:)
        !> clear_event, clear_arrival or doubtful
        integer, intent(out) :: found
        real(wp) :: here, goal, first, near, limit

        found = doubtful
        next = factor
        allocate (at_zero(0))
        associate (stretch => local%stretch)
            here = stretch%direction*factor
            goal = huge(goal)
            if (arrives) goal = stretch%direction*target
            limit = here + max(1.0_wp, abs(here))
            if (goal < huge(goal)) limit = goal
            near = slack*max(abs(here), abs(limit))
            first = first_key(stretch%queue)
            if (.not. first < huge(first) .and. .not. goal < huge(goal)) return
            if (first > goal + near .or. .not. first < huge(first)) then
                found = clear_arrival
                return
            end if
            call next_in_queue(local%beam, closed, here, limit, stretch, at_zero, next)
            if (size(at_zero) > 1 .and. .not. local%may_fall) stretch%in_doubt = .not. reach_zero_together()
            if (stretch%in_doubt .or. size(at_zero) == 0) return
            if (local%may_fall) then
                if (size(at_zero) > 1) return
                ! Where forces fall errors may grow beyond their bounds: what is next to each other may be there at once
                if (size(all_up_to(stretch%queue, next + share_off*abs(next))) > 1) return
            end if
            if (next <= here + near .or. next + (next - first) + near >= goal) return
            ! What is there but for rounding is at 0
            if (abs(next) <= near) next = 0.0_wp
            next = stretch%direction*next
            found = clear_event
        end associate

    contains

        !> Do all reach zero at the same factor, but for rounding, each at a node of its own
        pure function reach_zero_together() result(they_do)
            logical :: they_do
            type(response_type) :: response
            integer :: j

            they_do = .true.
            associate (stretch => local%stretch, nodes => local%beam%supports(at_zero)%node)
                do j = 1, size(at_zero)
                    response = response_in(local%beam, closed, at_zero(j), stretch)
                    they_do = they_do .and. falls(response) .and. count(nodes == nodes(j)) == 1
                    if (they_do) they_do = abs(zero_of(response) - next) <= near &
                        .and. width_at(response, next) <= share_off*abs(next*response%v1)
                end do
            end associate
        end function reach_zero_together

    end subroutine find_next

    !> Pass breakpoints, and those that coincide with them
    subroutine pass_breakpoints(local, numbers, breaks, factor, closed, direction)
        type(local_type), intent(inout) :: local
        !> The breakpoint, or several where no force falls; does its support break there
        integer, intent(in) :: numbers(:)
        logical, intent(in) :: breaks
        real(wp), intent(in) :: factor
        !> The scheme
        logical, intent(inout) :: closed(:)
        !> Where the load goes, 1 or -1; 0 if that is in doubt, or either way as after a break
        integer, intent(out) :: direction
        type(response_type) :: responses(size(numbers))
        integer :: first, last, i, j

        direction = 0
        local%changed = [integer ::]
        associate (stretch => local%stretch)
            do i = 1, size(numbers)
                first = numbers(i)
                last = numbers(i)
                if (breaks) then
                    call break_law(local%beam%supports, last)
                    call renew_rates(local, last - local%beam%supports(last)%breakpoint + 1, last)
                else
                    call find_unit(local%beam%supports, closed, numbers(i), first, last)
                end if
                local%changed = [local%changed, (j, j=first, last)]
            end do
            call change_supports(local%beam, local%changed, stretch%direction*factor, closed, stretch)
            ! Two that hold a node leave no room between them, or share what is there as nothing tells
            do i = 1, size(numbers)
                associate (beam => local%beam, node => local%beam%supports(numbers(i))%node)
                    associate (there => beam%order(beam%first(node):beam%first(node + 1) - 1))
                        stretch%current = stretch%current .and. vertical_pieces(beam%supports, closed, there) <= 1
                    end associate
                end associate
            end do
            if (.not. stretch%current .or. breaks) return
            do i = 1, size(numbers)
                responses(i) = response_in(local%beam, closed, numbers(i), stretch)
            end do
            if (all(rises(responses))) direction = nint(stretch%direction)
            if (size(numbers) == 1 .and. all(falls(responses))) direction = -nint(stretch%direction)
        end associate
    end subroutine pass_breakpoints

    !> Go on in a direction, the region being solved: local%current tells whether all is clear
    subroutine take_direction(local, closed, factor, direction, breaks)
        type(local_type), intent(inout) :: local
        !> The scheme; supports that turn back change in it
        logical, intent(inout) :: closed(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: direction
        !> Has a support just broken, so that either direction must be clear
        logical, intent(in) :: breaks
        type(response_type) :: response
        integer :: k

        if (allocated(local%turned)) deallocate (local%turned, local%turned_at, local%turned_with)
        allocate (local%turned(0), local%turned_at(0), local%turned_with(0))
        local%current = local%stretch%current
        if (.not. local%current) return
        if (breaks) then
            do k = 1, size(closed)
                if (.not. is_watched_in(local%beam%supports, closed, k)) cycle
                response = response_in(local%beam, closed, k, local%stretch)
                local%current = local%current .and. value_at(response, local%stretch%direction*factor) &
                    > width_at(response, factor)
            end do
            if (.not. local%current) return
        end if
        if (direction /= nint(local%stretch%direction)) then
            local%stretch%direction = real(direction, wp)
            local%stretch%in_doubt = .false.
            local%stretch%turns_back = .false.
            call queue_all(local%beam, closed, direction*factor, local%stretch)
        end if
        if (local%stretch%turns_back .and. .not. local%may_fall) call turn_back(local, closed, factor)
        local%current = is_clear(local, direction*factor)
        if (local%current) local%steps = local%steps + 1
    end subroutine take_direction

    !> Let supports that keep a set unload until all others go on; one that does so no more as others unload goes on as before.
    !> Where no force falls there is one way, and what is right for every support is it
    subroutine turn_back(local, closed, factor)
        type(local_type), intent(inout) :: local
        logical, intent(inout) :: closed(:)
        real(wp), intent(in) :: factor
        type(response_type) :: response
        integer, allocatable :: tops(:), changed(:), again(:)
        integer :: k, turn, i, j, ends(2)
        real(wp) :: at, with

        associate (stretch => local%stretch, laws => local%beam%supports)
            do turn = 0, most_turns
                tops = [integer ::]
                do k = 1, size(closed)
                    if (.not. unloads_from_here(local%beam, closed, k, stretch)) cycle
                    response = response_in(local%beam, closed, k, stretch)
                    if (rises(response)) cycle
                    if (.not. falls(response) .or. turn == most_turns) return
                    if (any(local%turned == k)) return
                    tops = [tops, k]
                end do
                again = all_up_to(stretch%queue, stretch%direction*factor)
                stretch%turns_back = size(tops) > 0
                if (size(tops) + size(again) == 0) exit
                if (turn == most_turns) return
                changed = [integer ::]
                do i = 1, size(again)
                    call find_unit(laws, closed, again(i), ends(1), ends(2))
                    if (.not. any(local%turned >= ends(1) .and. local%turned <= ends(2))) return
                    if (all(changed /= again(i))) changed = [changed, (j, j=ends(1), ends(2))]
                end do
                do i = 1, size(tops)
                    associate (dead => stretch%dead, live => stretch%live, top => tops(i), node => laws(tops(i))%node, &
                               first => tops(i) - laws(tops(i))%breakpoint + 1)
                        at = dead%answers(node)%deflection + factor*(live%answers(node)%deflection - local%settling(top))
                        with = dead%reaction(top) + factor*live%reaction(top)
                        call unload(laws, closed, first, local%first_slope(first), at, with, ends)
                        call renew_rates(local, first, last_breakpoint(laws, first))
                        local%turned = [local%turned, top]
                    end associate
                    local%turned_at = [local%turned_at, at]
                    local%turned_with = [local%turned_with, with]
                    changed = [changed, (j, j=ends(1), ends(2))]
                end do
                local%changed = [local%changed, changed]
                call change_supports(local%beam, changed, stretch%direction*factor, closed, stretch)
                if (.not. stretch%current) return
            end do
            ! Where one that hardly moves has turned back, it comes to again: doubles do not know that place well enough. What does
            ! not move has not turned at all: where nothing reaches a support, updates leave rates of 1e-80
            do i = 1, size(local%turned)
                response = response_in(local%beam, closed, local%turned(i), stretch)
                if (width_at(response, factor) > share_off*abs(factor*response%v1)) stretch%in_doubt = .true.
            end do
        end associate
    end subroutine turn_back

    !> In how many ways the beam gives way by itself
    pure function local_index(local, closed) result(index)
        type(local_type), intent(in) :: local
        logical, intent(in) :: closed(:)
        integer :: index
        real(wp) :: slope
        integer :: k
        logical :: acts

        index = 0
        if (.not. local%may_fall) return
        index = count_unstable_pivots(local%stretch%dead%nodes, local%stretch%dead%pivots)
        do k = 1, size(closed)
            if (local%beam%supports(k)%breakpoint == 0) cycle
            call piece_that_acts(local%beam%supports, closed, k, acts, slope)
            if (acts .and. slope < -huge(slope)) index = index + 1
        end do
    end function local_index

    !> Laws in double precision
    pure function rounded(fine, like) result(laws)
        type(fine_support_type), intent(in) :: fine(:)
        type(node_support_type), intent(in) :: like(:)
        type(node_support_type) :: laws(size(fine))

        laws(:) = like
        laws%stiffness = real(fine%stiffness, wp)
        laws%before = real(fine%before, wp)
        laws%contact = real(fine%contact, wp)
        laws%force = real(fine%force, wp)
        call find_passed(laws)
    end function rounded

    !> At which breakpoints both sides are one line
    pure subroutine find_passed(laws)
        type(node_support_type), intent(inout) :: laws(:)

        laws%passed = laws%breakpoint > 0 .and. .not. (laws%stiffness < laws%before .or. laws%stiffness > laws%before)
    end subroutine find_passed

end module gapbeam_local_step
