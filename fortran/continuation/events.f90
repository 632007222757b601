!> The load followed from event to event: every change of the contact state at its load factor.
!>
!> With smooth laws the path is followed on their polylines, which see every event; its factor is then put onto the laws.
module gapbeam_events
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: changes_at_a_time
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, failed, no_memory, has_ended, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_not_converged
    use gapbeam_laws, only: is_smooth
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: rule_given, reserve_for
    use gapbeam_path, only: follow_path, path_type
    use gapbeam_pieces, only: acting_type, acts_in, what_happens, no_change, gapbeam_turns, gapbeam_open
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state, close_all, forget
    use gapbeam_search, only: rule_block
    use gapbeam_along_axis, only: name_range
    use gapbeam_state, only: solve_state, detail_of
    use gapbeam_memory, only: for_following
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_smooth_events, only: find_on_laws
    implicit none
    private
    public :: event_type, follow_events, follow_some_events, add_event

    !> A change of the contact state
    type :: event_type
        !> Load factor at which it happens
        real(wp) :: factor
        !> Number of the support in the model, from 1
        integer :: support
        !> gapbeam_closed or gapbeam_open, or gapbeam_branch plus the number of the piece of its law: what the support is from here
        !> on; gapbeam_turns: the beam has lost its hold and turns at constant load until this support holds it
        integer :: state
        !> gapbeam_opens, gapbeam_closes, gapbeam_turns; of a support with a law also gapbeam_yields, gapbeam_hardens,
        !> gapbeam_softens, gapbeam_breaks, gapbeam_unloads
        integer :: change = no_change
        !> Of a history: the stretch that begins with it
        integer :: stretch = 0
    end type event_type

contains

    !> Follow the load from factor 0 to `factor`: every change of the contact state at its load factor. The state is that at
    !> the end, or at the factor above which there is no equilibrium, with the motion that begins there
    subroutine follow_events(assembled, factor, rule, state, events, number, error)
        type(assembled_type), intent(in), target :: assembled
        !> End of the path, above 0
        real(wp), intent(in) :: factor
        !> rule_block or rule_single
        integer, intent(in) :: rule
        !> From new_state or an earlier solve
        type(state_type), intent(inout) :: state
        !> The events in their order, the first `number` entries
        type(event_type), allocatable, intent(out) :: events(:)
        integer, intent(out) :: number
        !> As for solve_state; or no single path
        type(error_type), allocatable, intent(out) :: error
        type(outcome_type) :: outcome
        type(path_type) :: path
        real(wp) :: at
        integer :: solves, k, stat

        number = 0
        allocate (events(2*size(state%closed) + 8), stat=stat)
        if (failed(stat, error)) return
        call close_all(assembled, state%closed)
        call solve_state(assembled, 0.0_wp, rule, state, error)
        if (allocated(error) .or. state%status /= gapbeam_solved) return
        at = 0.0_wp
        solves = state%solves
        do while (at < factor)
            call follow_some_events(assembled, factor, changes_at_a_time, at, state%closed, state%undecided, path, outcome, error)
            call end_if_stopped(assembled%beam%watch, error)
            if (allocated(error)) then
                error%message = "at load factor "//trim(shown(at))//": "//error%message
                return
            end if
            solves = solves + path%solves
            do k = 1, path%count
                call note(path%factor(k), path%support(k), path%event(k), path%condition(k))
            end do
            if (outcome%status == gapbeam_no_equilibrium) then
                call forget(state)
                state%status = gapbeam_no_equilibrium
                state%factor = at
                state%solves = solves
                if (allocated(outcome%motion)) state%motion(:) = outcome%motion
                return
            end if
        end do
        call solve_on_laws(assembled, factor, rule_given, state, error)
        if (.not. allocated(error)) state%solves = state%solves + solves

    contains

        !> Note what happens to a support. What changes at factor 0 is no event, unless the beam turns there
        subroutine note(when, which, change, condition)
            real(wp), intent(in) :: when
            integer, intent(in) :: which, change, condition

            if (change == no_change .or. (.not. when > 0.0_wp .and. change /= gapbeam_turns)) return
            call add_event(event_type(when, assembled%normal(which), condition, change), events, number)
        end subroutine note

    end subroutine follow_events

    !> Put an event to others
    pure subroutine add_event(event, events, number)
        type(event_type), intent(in) :: event
        !> The first `number` entries are events
        type(event_type), allocatable, intent(inout) :: events(:)
        integer, intent(inout) :: number

        if (number == size(events)) events = [events, events]
        number = number + 1
        events(number) = event
    end subroutine add_event

    !> Follow the load from a factor on, as follow_path; what changes is named, and on smooth laws at its factor on these
    subroutine follow_some_events(assembled, limit, most, factor, closed, marginal, path, outcome, error)
        type(assembled_type), intent(in), target :: assembled
        !> As for follow_path
        real(wp), intent(in) :: limit
        integer, intent(in) :: most
        real(wp), intent(inout) :: factor
        logical, intent(inout) :: closed(:), marginal(:)
        !> With the conditions, and the events of event_type in place of what the supports do, no_change where that is none
        type(path_type), intent(out) :: path
        type(outcome_type), intent(out) :: outcome
        !> As for follow_path, or no memory
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: now(:)
        logical :: curved
        real(wp) :: at
        integer :: k, stat

        call reserve_for(for_following, assembled%beam, detail_of(assembled), error)
        if (allocated(error)) return
        allocate (now, source=closed, stat=stat)
        if (stat == 0) then
            call follow_path(assembled%beam, detail_of(assembled), limit, most, factor, closed, marginal, path, outcome, error)
            if (.not. allocated(error)) allocate (path%condition(path%count), stat=stat)
        end if
        if (stat /= 0) call no_memory(error)
        if (.not. allocated(error)) then
            curved = any(is_smooth(assembled%model%supports%law))
            do k = 1, path%count
                at = path%factor(k)
                call name_change(assembled, curved, k, now, path, error)
                if (allocated(error)) then
                    factor = at
                    exit
                end if
                if (path%factor(k) > limit) then
                    ! On the curves it happens beyond the end
                    now(path%support(k)) = .not. now(path%support(k))
                    closed(:) = now
                    factor = limit
                    outcome = outcome_type()
                    path%count = k - 1
                    exit
                end if
            end do
            if (curved .and. .not. allocated(error) .and. factor >= limit .and. outcome%status == gapbeam_solved) then
                call check_end(assembled, limit, closed, error)
            end if
        end if
        call name_range(assembled, error)
    end subroutine follow_some_events

    !> Refuse a path along polylines that does not end in the state on the curves
    subroutine check_end(assembled, factor, closed, error)
        type(assembled_type), intent(in), target :: assembled
        !> Where it ends, and the scheme there
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> It does not
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: state
        type(error_type), allocatable :: unknown
        type(acting_type) :: one, other
        integer :: k

        call new_state(assembled, state, error)
        if (allocated(error)) return
        call solve_on_laws(assembled, factor, rule_block, state, unknown)
        if (allocated(unknown)) then
            if (has_ended(unknown)) call move_alloc(unknown, error)
            return
        end if
        if (state%status /= gapbeam_solved .or. state%indifferent) return
        do k = 1, size(closed)
            if (state%undecided(k) .or. assembled%beam%supports(k)%breakpoint > 1) cycle
            one = acts_in(assembled, assembled%normal(k), closed)
            other = acts_in(assembled, assembled%normal(k), state%closed)
            if ((one%condition == gapbeam_open) .eqv. (other%condition == gapbeam_open)) cycle
            call fatal_error(error, gapbeam_not_converged, "the events on the smooth laws of the supports could not be put in "// &
                             "order: take steps, or give the laws as polylines")
            return
        end do
    end subroutine check_end

    !> Name what changes, and find where that is on smooth laws
    subroutine name_change(assembled, curved, number, now, path, error)
        type(assembled_type), intent(in), target :: assembled
        !> Are there smooth laws
        logical, intent(in) :: curved
        !> Of the change
        integer, intent(in) :: number
        !> The scheme before it in, after it out
        logical, intent(inout) :: now(:)
        type(path_type), intent(inout) :: path
        !> As for find_on_laws
        type(error_type), allocatable, intent(out) :: error
        type(acting_type) :: before, after

        associate (which => path%support(number), change => path%event(number))
            if (change == gapbeam_turns) then
                path%condition(number) = gapbeam_turns
                return
            end if
            before = acts_in(assembled, assembled%normal(which), now)
            now(which) = .not. now(which)
            after = acts_in(assembled, assembled%normal(which), now)
            path%condition(number) = after%condition
            change = what_happens(before, after)
            if (.not. curved .or. change == no_change .or. .not. path%factor(number) > 0.0_wp) return
            now(which) = .not. now(which)
            call find_on_laws(assembled, now, which, path%factor(number), error)
            now(which) = .not. now(which)
        end associate
    end subroutine name_change

end module gapbeam_events
