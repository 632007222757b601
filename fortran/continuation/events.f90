!> The load followed from event to event: every change of the contact state at its load factor.
module gapbeam_events
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: changes_at_a_time
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: rule_given, reserve_for
    use gapbeam_path, only: follow_path, path_type
    use gapbeam_pieces, only: acting_type, acts_in, what_happens, no_change, gapbeam_turns
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, close_all, forget
    use gapbeam_state, only: solve_state, detail_of, name_range
    use gapbeam_memory, only: for_following
    implicit none
    private
    public :: event_type, follow_events, add_event

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
        !> The beam
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
        logical, allocatable :: now(:)
        real(wp) :: at
        integer :: solves, k, stat

        number = 0
        allocate (events(2*size(state%closed) + 8), now(size(state%closed)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call close_all(assembled, state%closed)
        call solve_state(assembled, 0.0_wp, rule, state, error)
        if (allocated(error) .or. state%status /= gapbeam_solved) return
        at = 0.0_wp
        now(:) = state%closed
        solves = state%solves
        do while (at < factor)
            call reserve_for(for_following, assembled%beam, detail_of(assembled), error)
            if (allocated(error)) return
            call follow_path(assembled%beam, detail_of(assembled), factor, changes_at_a_time, at, state%closed, state%undecided, &
                             path, outcome, error)
            call end_if_stopped(assembled%beam%watch, error)
            call name_range(assembled, error)
            if (allocated(error)) then
                error%message = "at load factor "//trim(shown(at))//": "//error%message
                return
            end if
            solves = solves + path%solves
            do k = 1, path%count
                call note(path%factor(k), path%support(k), path%event(k))
                if (allocated(error)) return
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
        call solve_state(assembled, factor, rule_given, state, error)
        if (.not. allocated(error)) state%solves = state%solves + solves

    contains

        !> Note what happens to a support. What changes at factor 0 is no event, unless the beam turns there
        subroutine note(when, which, what)
            real(wp), intent(in) :: when
            integer, intent(in) :: which, what
            type(acting_type) :: before, after
            integer :: change

            before = acts_in(assembled, assembled%normal(which), now)
            if (what /= gapbeam_turns) now(which) = .not. now(which)
            after = acts_in(assembled, assembled%normal(which), now)
            change = what
            if (assembled%beam%supports(which)%breakpoint > 0 .and. what /= gapbeam_turns) change = what_happens(before, after)
            if (change == no_change .or. (.not. when > 0.0_wp .and. what /= gapbeam_turns)) return
            call add_event(event_type(when, assembled%normal(which), merge(what, after%condition, what == gapbeam_turns), change), &
                           events, number, stat)
            if (stat /= 0) call no_memory(error)
        end subroutine note

    end subroutine follow_events

    !> Put an event to others
    pure subroutine add_event(event, events, number, stat)
        type(event_type), intent(in) :: event
        !> The first `number` entries are events
        type(event_type), allocatable, intent(inout) :: events(:)
        integer, intent(inout) :: number
        !> Not 0 where memory is at an end
        integer, intent(out) :: stat
        type(event_type), allocatable :: longer(:)

        stat = 0
        if (number == size(events)) then
            allocate (longer(2*number), stat=stat)
            if (stat /= 0) return
            longer(:number) = events
            call move_alloc(longer, events)
        end if
        number = number + 1
        events(number) = event
    end subroutine add_event

end module gapbeam_events
