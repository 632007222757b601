!> Events of the supports along a load path, from stretch to stretch.
module gapbeam_history_events
    use gapbeam_kinds, only: wp
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_pieces, only: acting_type, acts_in, what_happens, no_change, gapbeam_turns, gapbeam_opens, &
        gapbeam_closes
    use gapbeam_events, only: event_type, add_event
    use gapbeam_history, only: history_type
    implicit none
    private
    public :: find_events

contains

    !> All events but those while the dead loads are put on
    subroutine find_events(assembled, path, found, stat)
        type(assembled_type), intent(in) :: assembled
        !> By follow_history
        type(history_type), intent(in) :: path
        !> In their order
        type(event_type), allocatable, intent(out) :: found(:)
        !> Not 0 where memory is at an end
        integer, intent(out) :: stat
        type(event_type), allocatable :: events(:)
        integer :: k, j, number, pending
        logical :: begins

        number = 0
        allocate (events(16), stat=stat)
        ! Events from here on are passed in a jump and happen where it begins
        pending = 0
        associate (s => path%stretches(:path%number))
            do k = 1, size(s)
                if (stat /= 0) return
                if (s(k)%skipped) then
                    if (k > 1) call note_changes(k - 1, k)
                    cycle
                end if
                if (s(k)%direction == 0 .and. k < size(s) .and. s(k)%leg > 0) then
                    j = findloc(s(k + 1)%closed .and. .not. s(k)%closed, .true., 1)
                    if (j > 0) call add_event(event_type(s(k)%from, assembled%normal(j), gapbeam_turns, gapbeam_turns, k), events, &
                                               number, stat)
                end if
                if (s(k)%leg == 0) cycle
                begins = .false.
                if (k > 1) begins = s(k)%leg == 1 .and. s(k - 1)%leg == 0 .and. .not. abs(s(k)%from) > 0.0_wp
                if (begins) then
                    ! What happens under the dead loads is no event
                    number = number - pending
                else if (k > 1) then
                    call note_changes(k - 1, k)
                    do j = number - pending + 1, number
                        events(j)%factor = s(k)%from
                        events(j)%stretch = k
                    end do
                end if
                pending = 0
            end do
            if (stat /= 0) return
            if (pending > 0) call end_at_limit()
        end associate
        if (stat /= 0) return
        allocate (found(number), stat=stat)
        if (stat == 0) found(:) = events(:number)

    contains

        !> What happens to every support between two stretches
        subroutine note_changes(one, other)
            integer, intent(in) :: one, other
            type(acting_type) :: before, after
            integer :: i, first, change

            if (stat /= 0) return
            associate (a => path%stretches(one), b => path%stretches(other))
                do i = 1, size(assembled%model%supports)
                    first = assembled%beam_support(i)
                    if (first == 0) cycle
                    associate (last => last_breakpoint(assembled%beam%supports, first))
                        if (all(a%closed(first:last) .eqv. b%closed(first:last))) cycle
                    end associate
                    before = acts_in(assembled, i, a%closed, a%laws)
                    after = acts_in(assembled, i, b%closed, b%laws)
                    change = no_change
                    if (assembled%beam%supports(first)%breakpoint > 0) then
                        change = what_happens(before, after)
                    else
                        change = merge(gapbeam_closes, gapbeam_opens, b%closed(first))
                    end if
                    if (change == no_change) cycle
                    pending = pending + 1
                    call add_event(event_type(b%from, i, after%condition, change, other), events, number, stat)
                    if (stat /= 0) return
                end do
            end associate
        end subroutine note_changes

        !> The path ends at a limit: what happens there is all that happens
        subroutine end_at_limit()
            integer :: before, j

            number = number - pending
            pending = 0
            if (size(path%limits) == 0) return
            before = path%limits(size(path%limits))%stretch
            if (before < 1 .or. before >= path%number) return
            call note_changes(before, before + 1)
            do j = number - pending + 1, number
                events(j)%factor = path%limits(size(path%limits))%factor
            end do
        end subroutine end_at_limit

    end subroutine find_events

end module gapbeam_history_events
