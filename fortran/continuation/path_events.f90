!> Events along a load path, noted in their order.
module gapbeam_path_events
    use gapbeam_kinds, only: wp
    use gapbeam_pieces, only: gapbeam_opens, gapbeam_closes, gapbeam_turns
    use gapbeam_stretch, only: stretch_type
    implicit none
    private
    public :: path_type, add_event, note_changes

    !> Events along the path, in the order in which they happen
    type :: path_type
        !> How many there are in the arrays
        integer :: count = 0
        !> Events after which the path stops to be called again
        integer :: most = 0
        !> Load factor, support, and what happens to it
        real(wp), allocatable :: factor(:)
        integer, allocatable :: support(:), event(:)
        !> What the support is from there on, where that is told (gapbeam_events)
        integer, allocatable :: condition(:)
        !> Linear solves of the whole beam; nodes at which the solution was made anew besides
        integer :: solves = 0, nodes = 0
    end type path_type

contains

    !> Note what changes between two schemes at a factor. If something that changes was not at zero before, or is not after,
    !> the beam has moved a finite way at constant load: it has turned
    subroutine note_changes(factor, before, after, was_far, is_far, stretch, path)
        real(wp), intent(in) :: factor
        logical, intent(in) :: before(:), after(:)
        !> Is a support far from zero before and after the change
        logical, intent(in) :: was_far(:), is_far(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        logical :: closes
        integer :: k, pass, holds

        holds = 0
        if (any((before .neqv. after) .and. merge(was_far, is_far, after))) then
            holds = findloc(after .and. .not. before, .true., 1)
            if (holds == 0) then
                ! A law that goes back to an earlier piece, from the end of which it has lost its hold
                k = findloc((before .neqv. after) .and. was_far .and. .not. is_far, .true., 1)
                if (k > 0 .and. any((before .neqv. after) .and. .not. was_far)) call add_event(path, factor, k, gapbeam_turns)
            end if
        end if
        do pass = 1, 2
            closes = pass == 2
            if (closes .and. holds > 0) call add_event(path, factor, holds, gapbeam_turns)
            do k = 1, size(before)
                if (before(k) .eqv. after(k)) cycle
                if (after(k) .neqv. closes) cycle
                stretch%last_change(k) = factor
                call add_event(path, factor, k, merge(gapbeam_closes, gapbeam_opens, closes))
            end do
        end do
    end subroutine note_changes

    !> Note an event
    pure subroutine add_event(path, factor, k, event)
        type(path_type), intent(inout) :: path
        real(wp), intent(in) :: factor
        !> Support, and what happens to it
        integer, intent(in) :: k, event

        if (path%count == size(path%factor)) then
            path%factor = [path%factor, path%factor]
            path%support = [path%support, path%support]
            path%event = [path%event, path%event]
        end if
        path%count = path%count + 1
        path%factor(path%count) = factor
        path%support(path%count) = k
        path%event(path%count) = event
    end subroutine add_event

end module gapbeam_path_events
