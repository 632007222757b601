!> Events of the supports while a train goes over a beam.
module gapbeam_train_events
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed, gapbeam_solved
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_pieces, only: acting_type, acts_in, what_happens, no_change
    use gapbeam_train_traversal, only: traversal_type
    implicit none
    private
    public :: train_event_type, find_events

    !> A change of the contact state: position of the train, number of the support in the model, what it is from there on and what
    !> happens (gapbeam_pieces); on the ground also of a zone of contact
    type :: train_event_type
        real(wp) :: position = 0.0_wp
        integer :: support = 0, state = 0, change = no_change
        !> Of a zone, which is of no support: number of the foundation in the model, the first of the branches of its law that make
        !> up the zone, and its place
        integer :: foundation = 0, branch = 1
        real(wp) :: x = 0.0_wp
    end type train_event_type

contains

    !> The events on the way of a train. What changes though it is zero all the way is none
    subroutine find_events(assembled, traversal, backwards, events, error)
        type(assembled_type), intent(in) :: assembled
        !> By pass_train
        type(traversal_type), intent(in) :: traversal
        !> Does the train go towards smaller positions
        logical, intent(in) :: backwards
        !> In the order in which they happen
        type(train_event_type), allocatable, intent(out) :: events(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: now(:)
        type(acting_type) :: before, after
        integer :: first, i, k, last, number, stat, step

        allocate (events(64), now(size(assembled%beam%supports)), stat=stat)
        if (failed(stat, error)) return
        number = 0
        first = 0
        do step = 1, traversal%number
            i = merge(traversal%number + 1 - step, step, backwards)
            if (traversal%status(i) /= gapbeam_solved) cycle
            if (first == 0) now(:) = traversal%closed(:, i)
            first = i
            if (all(traversal%closed(:, i) .eqv. now)) cycle
            k = 1
            do while (k <= size(now))
                last = last_breakpoint(assembled%beam%supports, k)
                if (any((now(k:last) .neqv. traversal%closed(k:last, i)) .and. .not. traversal%at_zero(k:last, i))) then
                    before = acts_in(assembled, assembled%normal(k), now)
                    now(k:last) = traversal%closed(k:last, i)
                    after = acts_in(assembled, assembled%normal(k), now)
                    call note(merge(traversal%to(i), traversal%from(i), backwards), assembled%normal(k), before, after)
                end if
                k = last + 1
            end do
        end do
        events = events(:number)

    contains

        !> Note an event
        subroutine note(position, support, before, after)
            real(wp), intent(in) :: position
            integer, intent(in) :: support
            type(acting_type), intent(in) :: before, after
            integer :: change

            change = what_happens(before, after)
            if (change == no_change) return
            if (number == size(events)) events = [events, events]
            number = number + 1
            events(number) = train_event_type(position, support, after%condition, change)
        end subroutine note

    end subroutine find_events

end module gapbeam_train_events
