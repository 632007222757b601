!> Events of the supports along a load path, from stretch to stretch.
module gapbeam_history_events
    use gapbeam_kinds, only: wp
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_pieces, only: acting_type, acts_in, what_happens, no_change, gapbeam_turns
    use gapbeam_axial_links, only: link_change_type, changes_along
    use gapbeam_events, only: event_type, add_event
    use gapbeam_history_stretch, only: stretch_type, pieces_type, enter_stretch
    use gapbeam_history_record, only: history_type, find_pieces
    implicit none
    private
    public :: find_events

contains

    !> All events but those while the dead loads are put on
    subroutine find_events(assembled, path, found)
        type(assembled_type), intent(in) :: assembled
        !> By follow_history
        type(history_type), intent(in) :: path
        !> In their order
        type(event_type), allocatable, intent(out) :: found(:)
        type(event_type), allocatable :: events(:)
        type(pieces_type) :: pieces
        integer, allocatable :: which(:)
        integer :: k, j, at, number, pending
        logical :: begins

        number = 0
        at = 0
        allocate (events(16))
        ! Events from here on are passed in a jump and happen where it begins
        pending = 0
        associate (s => path%stretches(:path%number))
            do k = 1, size(s)
                if (s(k)%skipped) then
                    if (k > 1) call note_changes(k)
                    cycle
                end if
                if (s(k)%direction == 0 .and. k < size(s) .and. s(k)%leg > 0) then
                    call go_to(path, k, at, pieces)
                    which = switching(s(k + 1), pieces)
                    ! A law that goes back to an earlier piece holds as well
                    if (.not. all(pieces%closed(which))) which = pack(which, .not. pieces%closed(which))
                    if (size(which) > 0) call add_event(event_type(s(k)%from, assembled%normal(minval(which)), gapbeam_turns, &
                                                                   gapbeam_turns, k), events, number)
                end if
                if (s(k)%leg == 0) cycle
                begins = .false.
                if (k > 1) begins = s(k)%leg == 1 .and. s(k - 1)%leg == 0 .and. .not. abs(s(k)%from) > 0.0_wp
                if (begins) then
                    ! What happens under the dead loads is no event
                    number = number - pending
                else if (k > 1) then
                    call note_changes(k)
                    do j = number - pending + 1, number
                        events(j)%factor = s(k)%from
                        events(j)%stretch = k
                    end do
                end if
                pending = 0
            end do
            if (pending > 0) call end_at_limit()
        end associate
        found = events(:number)

    contains

        !> What happens to every support where a stretch begins
        subroutine note_changes(other)
            integer, intent(in) :: other
            integer :: before

            before = number
            call find_changes_across(assembled, path, other, at, pieces, events, number)
            if (allocated(assembled%axial%laws)) call find_changes_along(assembled, path, other, events, number)
            pending = pending + number - before
        end subroutine note_changes

        !> The path ends at a limit: what happens there is all that happens
        subroutine end_at_limit()
            integer :: before, j

            number = number - pending
            pending = 0
            if (size(path%limits) == 0) return
            before = path%limits(size(path%limits))%stretch
            if (before < 1 .or. before >= path%number) return
            call note_changes(before + 1)
            do j = number - pending + 1, number
                events(j)%factor = path%limits(size(path%limits))%factor
            end do
        end subroutine end_at_limit

    end subroutine find_events

    !> Have the pieces of a stretch at hand
    pure subroutine go_to(path, number, at, pieces)
        type(history_type), intent(in) :: path
        integer, intent(in) :: number
        !> The stretch whose pieces are at hand, 0: none
        integer, intent(inout) :: at
        type(pieces_type), intent(inout) :: pieces
        integer :: k

        if (at > 0 .and. at <= number) then
            do k = at + 1, number
                call enter_stretch(path%stretches(k), pieces)
            end do
        else
            call find_pieces(path, number, pieces)
        end if
        at = number
    end subroutine go_to

    !> What happens to every support across the beam where a stretch begins
    subroutine find_changes_across(assembled, path, other, at, pieces, events, number)
        type(assembled_type), intent(in) :: assembled
        type(history_type), intent(in) :: path
        !> The stretch
        integer, intent(in) :: other
        !> As for go_to
        integer, intent(inout) :: at
        type(pieces_type), intent(inout) :: pieces
        !> Added to; how many there are
        type(event_type), allocatable, intent(inout) :: events(:)
        integer, intent(inout) :: number
        type(acting_type), allocatable :: before(:)
        type(acting_type) :: after
        integer, allocatable :: which(:)
        integer :: i, change

        call go_to(path, other - 1, at, pieces)
        allocate (which, source=changing(assembled, path%stretches(other), pieces))
        before = [(acts_in(assembled, which(i), pieces%closed, pieces%laws), i=1, size(which))]
        call go_to(path, other, at, pieces)
        do i = 1, size(which)
            after = acts_in(assembled, which(i), pieces%closed, pieces%laws)
            change = what_happens(before(i), after)
            if (change == no_change) cycle
            call add_event(event_type(path%stretches(other)%from, which(i), after%condition, change, other), events, number)
        end do
    end subroutine find_changes_across

    !> Breakpoints that open or close where a stretch begins
    pure function switching(stretch, before) result(breakpoints)
        type(stretch_type), intent(in) :: stretch
        !> The pieces on the stretch before
        type(pieces_type), intent(in) :: before
        integer, allocatable :: breakpoints(:)
        integer :: i

        if (allocated(stretch%changed)) then
            breakpoints = pack(stretch%changed, stretch%closed .neqv. before%closed(stretch%changed))
        else
            breakpoints = pack([(i, i=1, size(stretch%closed))], stretch%closed .neqv. before%closed)
        end if
    end function switching

    !> Their supports, in the order of the model
    pure function changing(assembled, stretch, before) result(supports)
        type(assembled_type), intent(in) :: assembled
        !> As for switching
        type(stretch_type), intent(in) :: stretch
        type(pieces_type), intent(in) :: before
        integer, allocatable :: supports(:)
        logical, allocatable :: changes(:)
        integer :: i

        supports = assembled%normal(switching(stretch, before))
        if (size(supports) < 2) return
        associate (first => minval(supports), last => maxval(supports))
            allocate (changes(first:last), source=.false.)
            changes(supports) = .true.
            supports = pack([(i, i=first, last)], changes)
        end associate
    end function changing

    !> What happens to every link along the beam there
    subroutine find_changes_along(assembled, path, other, events, number)
        !> As for find_changes_across
        type(assembled_type), intent(in) :: assembled
        type(history_type), intent(in) :: path
        integer, intent(in) :: other
        type(event_type), allocatable, intent(inout) :: events(:)
        integer, intent(inout) :: number
        type(link_change_type), allocatable :: changes(:)
        integer :: k

        allocate (changes, source=changes_along(assembled, path%stretches(other - 1)%along, path%stretches(other)%along))
        do k = 1, size(changes)
            associate (c => changes(k))
                call add_event(event_type(path%stretches(other)%from, c%support, c%condition, c%change, other), events, number)
            end associate
        end do
    end subroutine find_changes_along

end module gapbeam_history_events
