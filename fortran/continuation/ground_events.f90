!> Load path of a beam on the ground, event by event and segment by segment.
module gapbeam_ground_events
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: load_begin
    use gapbeam_error, only: error_type, failed
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_pieces, only: acts_in, what_happens, no_change
    use gapbeam_axial_links, only: links_type, link_change_type, follow_links, changes_along
    use gapbeam_zone_margin, only: change_type
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_ground_changes, only: zone_type, zone_change_type, same_zones, compare_zones, looked_for
    implicit none
    private
    public :: ground_path_type, ground_event_type, ground_segment_type, held_type, note_changes, list_changes, add_segment, &
        note_links, same_contact, beside

    !> A change of what holds the beam
    type :: ground_event_type
        !> Load factor at which it happens, and its place
        real(wp) :: factor, x
        !> Number of the support in the model, or else 0 and that of the foundation
        integer :: support = 0, foundation = 0
        !> Of a foundation with a law the first of its branches that make up the zone; 1 is the zone of contact
        integer :: branch = 1
        !> Of a support: gapbeam_opens, gapbeam_closes, with a law also gapbeam_yields, gapbeam_hardens, gapbeam_unloads; of a zone:
        !> gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits; of its ends: gapbeam_reaches, gapbeam_leaves
        integer :: change = no_change
    end type ground_event_type

    !> Between two load factors the same acts
    type :: ground_segment_type
        !> Where it begins
        real(wp) :: from = 0.0_wp
        !> Scheme of the supports
        logical, allocatable :: closed(:)
    end type ground_segment_type

    !> The path; the first entries of the arrays
    type :: ground_path_type
        integer :: number = 0, segments = 0
        type(ground_event_type), allocatable :: events(:)
        type(ground_segment_type), allocatable :: segment(:)
        !> Load factor that it goes to; a factor not below it above which there is no equilibrium for sure
        real(wp) :: last = 0.0_wp, beyond = 0.0_wp
        !> Does it end where ground that yields carries no more
        logical :: at_limit = .false.
        !> Linear solves
        integer :: solves = 0
    end type ground_path_type

    !> What holds the beam at a load factor; sure if it was solved in quadruple precision and audited
    type, extends(point_type) :: held_type
        logical, allocatable :: closed(:)
        type(zone_type), allocatable :: zones(:)
        !> May the beam move freely: then what it touches is not unique, and only these of them, which carry something, are
        logical :: loose = .false.
        logical, allocatable :: carries(:)
        type(zone_type), allocatable :: carrying(:)
        !> Deflections of the beam at supports whose law is a curve
        real(wp), allocatable :: on_curves(:)
        !> Where the search for other states may begin
        type(ground_start_type) :: start
        !> Where there is no equilibrium, how the beam moves: displacements of its nodes
        real(wp), allocatable :: motion(:)
        !> Where the force of ground falls and no state was reached: the last parameter with one
        real(wp) :: reached = 0.0_wp
    end type held_type

contains

    !> The events between two factors in the order of their factors; at the same one of supports, then of zones
    subroutine note_changes(assembled, before, after, factor, place, path)
        type(assembled_type), intent(in) :: assembled
        type(held_type), intent(in) :: before, after
        !> Of the changes as listed by list_changes: load factor, and place in the user's units; that of a zone below zero: where it
        !> is between the zones before and after
        real(wp), intent(in) :: factor(:), place(:)
        type(ground_path_type), intent(inout) :: path
        type(zone_change_type), allocatable :: changes(:)
        integer :: begin, k, n, last, number, what

        begin = path%number
        n = 0
        associate (supports => assembled%beam%supports, changed => before%closed .neqv. after%closed)
            k = 1
            do while (k <= size(supports))
                last = last_breakpoint(supports, k)
                associate (s => assembled%normal(k), point => assembled%support_point(assembled%normal(k)))
                    what = what_happens(acts_in(assembled, s, before%closed), acts_in(assembled, s, after%closed))
                    if (what /= no_change) call add_event(ground_event_type(factor(n + 1), point_x(assembled, point), support=s, &
                                                                            change=what), begin, path)
                end associate
                n = n + count(changed(k:last))
                k = last + 1
            end do
        end associate
        call compare_zones(before%zones, after%zones, changes, number)
        do k = 1, number
            associate (c => changes(k))
                call add_event(ground_event_type(factor(n + k), merge(place(n + k), c%x, place(n + k) >= 0.0_wp), &
                                                 foundation=c%foundation, branch=c%branch, change=c%change), begin, path)
            end associate
        end do
    end subroutine note_changes

    !> The changes between two factors as the engine looks for them
    subroutine list_changes(assembled, before, after, list)
        type(assembled_type), intent(in) :: assembled
        type(held_type), intent(in) :: before, after
        !> Of supports, then of zones
        type(change_type), allocatable, intent(out) :: list(:)
        type(zone_change_type), allocatable :: changes(:)
        integer :: k, number

        call compare_zones(before%zones, after%zones, changes, number)
        list = [pack([(change_type(support=k, closed=before%closed(k)), k=1, size(before%closed))], &
                     before%closed .neqv. after%closed), looked_for(changes(:number), assembled%units%length)]
    end subroutine list_changes

    !> One event more
    pure subroutine add_event(event, first, path)
        type(ground_event_type), intent(in) :: event
        !> Among events after so many the factor tells where
        integer, intent(in) :: first
        type(ground_path_type), intent(inout) :: path
        integer :: at

        if (path%number == size(path%events)) path%events = [path%events, path%events]
        path%number = path%number + 1
        at = path%number
        do while (at > first + 1)
            if (path%events(at - 1)%factor <= event%factor) exit
            path%events(at) = path%events(at - 1)
            at = at - 1
        end do
        path%events(at) = event
    end subroutine add_event

    !> One segment more
    subroutine add_segment(from, held, path, error)
        real(wp), intent(in) :: from
        class(point_type), intent(in) :: held
        type(ground_path_type), intent(inout) :: path
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(ground_segment_type), allocatable :: longer(:)
        integer :: k, stat

        if (path%segments == size(path%segment)) then
            allocate (longer(2*path%segments), stat=stat)
            if (failed(stat, error)) return
            do k = 1, path%segments
                longer(k)%from = path%segment(k)%from
                call move_alloc(path%segment(k)%closed, longer(k)%closed)
            end do
            call move_alloc(longer, path%segment)
        end if
        path%segments = path%segments + 1
        path%segment(path%segments)%from = from
        select type (held)
        type is (held_type)
            ! What has been taken back may have been here
            path%segment(path%segments)%closed = held%closed
        end select
    end subroutine add_segment

    !> Changes of links along the beam, whose forces bending feels, in their order among the events; segments begin there, too
    subroutine note_links(assembled, path, error)
        type(assembled_type), intent(in) :: assembled
        type(ground_path_type), intent(inout) :: path
        !> No memory, or as for follow_links
        type(error_type), allocatable, intent(out) :: error
        type(links_type) :: links
        type(link_change_type), allocatable :: changes(:)
        integer :: k, i

        call follow_links(assembled, path%last, links, error)
        do k = 2, links%number
            if (allocated(error)) return
            associate (factor => links%ends(1, k))
                ! What touches under the dead loads touches from the beginning
                if (factor <= load_begin*path%last) cycle
                allocate (changes, source=changes_along(assembled, links%closed(:, k - 1), links%closed(:, k)))
                do i = 1, size(changes)
                    associate (c => changes(i))
                        call add_event(ground_event_type(factor, point_x(assembled, assembled%support_point(c%support)), &
                                                         support=c%support, change=c%change), 0, path)
                    end associate
                end do
                if (size(changes) > 0) call cut_segment(factor, path, error)
                deallocate (changes)
            end associate
        end do
    end subroutine note_links

    !> Let a segment begin at a load factor with what acts there
    subroutine cut_segment(factor, path, error)
        real(wp), intent(in) :: factor
        type(ground_path_type), intent(inout) :: path
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: held
        integer :: k

        k = path%segments
        do while (k > 1)
            if (path%segment(k)%from <= factor) exit
            k = k - 1
        end do
        if (.not. abs(path%segment(k)%from - factor) > 0.0_wp) return
        held%closed = path%segment(k)%closed
        call add_segment(factor, held, path, error)
        if (allocated(error)) return
        path%segment(k + 1:path%segments) = cshift(path%segment(k + 1:path%segments), -1)
    end subroutine cut_segment

    !> What holds the beam of a state beside another one: what carries where both may move freely
    pure function beside(held, other) result(seen)
        class(point_type), intent(in) :: held, other
        !> Supports and zones alone
        type(held_type) :: seen
        logical :: both_loose

        both_loose = .false.
        select type (other)
        type is (held_type)
            both_loose = other%loose
        end select
        seen%stands = held%stands
        select type (held)
        type is (held_type)
            both_loose = both_loose .and. held%loose
            if (both_loose) then
                seen%closed = held%carries
                seen%zones = held%carrying
            else
                if (allocated(held%closed)) seen%closed = held%closed
                if (allocated(held%zones)) seen%zones = held%zones
            end if
        end select
    end function beside

    !> Does the same hold the beam: the same supports, and as many zones with ends of the same kind
    pure function same_contact(held, other) result(same)
        type(held_type), intent(in) :: held, other
        logical :: same

        same = held%stands .and. other%stands
        if (same) same = all(held%closed .eqv. other%closed)
        if (same) same = same_zones(held%zones, other%zones)
    end function same_contact

end module gapbeam_ground_events
