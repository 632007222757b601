!> The load path of a beam on the ground: every change of zones of contact and of supports at its load factor.
!>
!> Between two changes the ends of the zones move smoothly with the load, and no formula gives the factor of the next change. So
!> states are solved on a grid of factors, and where what acts differs between two neighbours, the change between them is found by
!> bisection, down to neighbouring doubles. Changes that undo each other between two places of the grid are not seen.
module gapbeam_ground_path
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_polyline, only: last_kink
    use gapbeam_layers, only: has_limit, has_curves
    use gapbeam_ground_solver, only: limit_on_ground
    use gapbeam_lowered, only: lowered_type, point_x
    use gapbeam_pieces, only: acting_type, acting_piece, what_happens, nothing
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: solve_state, ground_of, detail_of
    use gapbeam_ground_changes, only: zone_type, zone_change_type, find_zones, same_zones, compare_zones
    implicit none
    private
    public :: ground_path_type, ground_event_type, ground_segment_type, follow_on_ground

    !> Parts into which the way of the load is cut before changes are looked for
    integer, parameter :: parts = 64
    !> Distance of load factors at which it is enough to know that states between them cannot be settled
    real(wp), parameter :: near = 2.0_wp**(-44)
    !> The same where laws are curves that come to a limit: next to it states take long
    real(wp), parameter :: near_on_curves = 2.0_wp**(-20)
    !> Next to an event a state may not be settled, since a zone has next to no length there: factors on both sides of it that are
    !> as near as this are neighbours
    real(wp), parameter :: next_to = 2.0_wp**(-32)
    !> Curves come to their limit where the beam has gone without end: the path is followed until this share of it is missing, or
    !> that, powers of 2
    integer, parameter :: missing_powers(*) = [-20, -10]
    !> What acts at this share of the way, a power of 2, acts from the beginning: at factor 0 a beam without dead load lies there
    !> without any force. Where so small a load is nothing beside gaps and settlements, it is what acts at one of the next shares
    integer, parameter :: begin_powers(*) = [-40, -34, -28, -22]

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
        integer :: change = nothing
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

    !> What holds the beam at a load factor
    type :: held_type
        logical, allocatable :: closed(:)
        type(zone_type), allocatable :: zones(:)
        !> Is there equilibrium
        logical :: stands = .false.
    end type held_type

contains

    !> Follow the load from factor 0 upwards
    subroutine follow_on_ground(lowered, factor, rule, state, path, error)
        !> A beam on the ground
        type(lowered_type), intent(in), target :: lowered
        !> Where the path ends, above 0
        real(wp), intent(in) :: factor
        !> rule_block or rule_single
        integer, intent(in) :: rule
        !> The scheme that every search starts from in; out the state at `factor`, or the motion just above path%last
        type(state_type), intent(inout) :: state
        !> All changes above load factor 0
        type(ground_path_type), intent(out) :: path
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        !> A state next to the last one that could not be settled
        type(error_type), allocatable :: trouble
        type(held_type) :: now, then, below, above
        logical, allocatable :: start(:)
        real(wp) :: at, next, low, high
        logical :: yields, levels_off
        integer :: k

        allocate (start(size(state%closed)), path%events(8), path%segment(8))
        start(:) = state%closed
        path%beyond = factor
        call find_limits(lowered, yields, levels_off)
        do k = 1, size(begin_powers)
            at = factor*2.0_wp**begin_powers(k)
            if (allocated(trouble)) deallocate (trouble)
            call hold(at, now)
            if (allocated(error)) return
            if (.not. allocated(trouble)) exit
        end do
        if (.not. now%stands) then
            call move_alloc(trouble, error)
            path%beyond = 0.0_wp
            return
        end if
        call add_segment(0.0_wp, now)
        do k = 1, parts
            next = factor*(real(k, wp)/parts)
            do
                call hold(next, then)
                if (allocated(error)) return
                if (alike(now, then)) exit
                low = at
                high = next
                below = now
                above = then
                if (.not. then%stands) then
                    call go_to_limit(low, high, below, above)
                    if (allocated(error) .or. path%at_limit) return
                end if
                call bisect(low, below, high, above)
                if (allocated(error)) return
                if (.not. above%stands) then
                    path%last = low
                    call prove_end(low, high)
                    path%at_limit = yields .and. low > 0.0_wp
                    return
                end if
                call note_changes(high, below, above)
                if (allocated(error)) return
                call add_segment(high, above)
                if (allocated(error)) return
                now = above
                at = high
                if (.not. high < next) exit
            end do
            at = next
        end do
        path%last = factor
        if (state%factor < factor) call hold(factor, now)

    contains

        !> What holds the beam at a load factor. Just below the last one next to nothing does: what cannot be settled there is put
        !> down as no equilibrium, and prove_end sees to it that there is none
        subroutine hold(at, held)
            real(wp), intent(in) :: at
            type(held_type), intent(out) :: held

            state%closed(:) = start
            call solve_state(lowered, at, rule, state, error)
            if (allocated(error)) then
                if (error%code == gapbeam_not_converged .or. error%code == gapbeam_not_finite) then
                    call move_alloc(error, trouble)
                else
                    error%message = "at load factor "//trim(shown(at))//": "//error%message
                end if
                return
            end if
            path%solves = path%solves + state%solves
            if (state%status /= gapbeam_solved) then
                if (allocated(trouble)) deallocate (trouble)
                return
            end if
            held%stands = .true.
            allocate (held%closed(size(start)))
            held%closed(:) = state%closed
            call find_zones(lowered, state%ground, held%zones, error)
        end subroutine hold

        !> Where laws are curves limit analysis knows the limit load: end the path there, or look next to it for what changes before
        subroutine go_to_limit(low, high, below, above)
            real(wp), intent(in) :: low
            real(wp), intent(inout) :: high
            type(held_type), intent(in) :: below
            type(held_type), intent(inout) :: above
            type(held_type) :: held
            real(wp) :: bears, beyond, last
            logical :: found
            integer :: k

            if (.not. levels_off) return
            bears = low
            beyond = high
            call limit_on_ground(ground_of(lowered), detail_of(lowered), bears, beyond, found)
            if (.not. found) return
            do k = 1, size(missing_powers)
                last = bears*(1 - 2.0_wp**missing_powers(k))
                if (last <= low) return
                call hold(last, held)
                if (allocated(error)) return
                if (held%stands) exit
            end do
            if (.not. held%stands) return
            if (.not. alike(below, held)) then
                high = last
                above = held
                return
            end if
            call hold(beyond, held)
            if (allocated(error)) return
            path%last = last
            path%beyond = beyond
            path%at_limit = .true.
        end subroutine go_to_limit

        !> Neighbouring factors around the first change between two, and what holds the beam there
        subroutine bisect(low, below, high, above)
            real(wp), intent(inout) :: low, high
            type(held_type), intent(inout) :: below, above
            type(held_type) :: between, standing
            real(wp) :: middle, stands_at

            stands_at = huge(high)
            do
                if (above%stands) then
                    stands_at = high
                    standing = above
                end if
                middle = low + (high - low)/2
                if (middle <= low .or. middle >= high) exit
                if (.not. above%stands) then
                    if (allocated(trouble) .and. high - low <= near*high) exit
                    if (levels_off .and. high - low <= near_on_curves*high) exit
                end if
                call hold(middle, between)
                if (allocated(error)) return
                if (alike(below, between)) then
                    low = middle
                    below = between
                else
                    high = middle
                    above = between
                end if
            end do
            if (above%stands .or. .not. allocated(trouble) .or. stands_at - low > next_to*stands_at) return
            high = stands_at
            above = standing
            deallocate (trouble)
        end subroutine bisect

        !> Find a factor just above the last one at which there is no equilibrium for sure, and how the beam moves there
        subroutine prove_end(last, above)
            real(wp), intent(in) :: last, above
            type(held_type) :: held
            type(error_type), allocatable :: first_trouble
            integer :: power

            path%beyond = last
            if (.not. allocated(trouble)) then
                if (levels_off) path%beyond = above
                call hold(above, held)
                return
            end if
            allocate (first_trouble, source=trouble)
            do power = -50, -9, 4
                path%beyond = last*(1 + 2.0_wp**power)
                call hold(path%beyond, held)
                if (allocated(error)) return
                if (.not. held%stands .and. .not. allocated(trouble)) return
            end do
            call move_alloc(first_trouble, error)
        end subroutine prove_end

        !> The events between two neighbouring factors: of supports, then of zones
        subroutine note_changes(at, before, after)
            real(wp), intent(in) :: at
            type(held_type), intent(in) :: before, after
            type(zone_change_type), allocatable :: changes(:)
            integer :: k, last, number, what

            associate (supports => lowered%beam%supports)
                k = 1
                do while (k <= size(supports))
                    last = k
                    if (supports(k)%kink > 0) last = last_kink(supports, k)
                    what = change_of(k, last, before, after)
                    if (what /= nothing) then
                        associate (s => lowered%normal(k), point => lowered%support_point(lowered%normal(k)))
                            call add_event(ground_event_type(at, point_x(lowered, point), support=s, change=what))
                        end associate
                        if (allocated(error)) return
                    end if
                    k = last + 1
                end do
            end associate
            call compare_zones(before%zones, after%zones, changes, number)
            do k = 1, number
                associate (c => changes(k))
                    call add_event(ground_event_type(at, c%x, foundation=c%foundation, branch=c%branch, change=c%change))
                end associate
                if (allocated(error)) return
            end do
        end subroutine note_changes

        !> What happens to a support, one entry of the engine or the kinks of a law
        function change_of(first, last, before, after) result(change)
            integer, intent(in) :: first, last
            type(held_type), intent(in) :: before, after
            integer :: change
            type(acting_type) :: was, is

            associate (kinks => lowered%beam%supports(first:last), side => lowered%model%supports(lowered%normal(first))%side)
                was = acting_piece(kinks, side, before%closed(first:last))
                is = acting_piece(kinks, side, after%closed(first:last))
            end associate
            change = what_happens(was, is)
        end function change_of

        !> One event more
        subroutine add_event(event)
            type(ground_event_type), intent(in) :: event
            type(ground_event_type), allocatable :: longer(:)
            integer :: stat

            if (path%number == size(path%events)) then
                allocate (longer(2*path%number), stat=stat)
                if (stat /= 0) then
                    call no_memory(error)
                    return
                end if
                longer(:path%number) = path%events
                call move_alloc(longer, path%events)
            end if
            path%number = path%number + 1
            path%events(path%number) = event
        end subroutine add_event

        !> One segment more
        subroutine add_segment(from, held)
            real(wp), intent(in) :: from
            type(held_type), intent(in) :: held
            type(ground_segment_type), allocatable :: longer(:)
            integer :: k, stat

            if (path%segments == size(path%segment)) then
                allocate (longer(2*path%segments), stat=stat)
                if (stat /= 0) then
                    call no_memory(error)
                    return
                end if
                do k = 1, path%segments
                    longer(k)%from = path%segment(k)%from
                    call move_alloc(path%segment(k)%closed, longer(k)%closed)
                end do
                call move_alloc(longer, path%segment)
            end if
            path%segments = path%segments + 1
            path%segment(path%segments)%from = from
            allocate (path%segment(path%segments)%closed(size(held%closed)))
            path%segment(path%segments)%closed(:) = held%closed
        end subroutine add_segment

    end subroutine follow_on_ground

    !> Does the same hold the beam: the same supports, and as many zones with ends of the same kind
    pure function alike(held, other) result(same)
        type(held_type), intent(in) :: held, other
        logical :: same

        same = held%stands .and. other%stands
        if (same) same = all(held%closed .eqv. other%closed)
        if (same) same = same_zones(held%zones, other%zones)
    end function alike

    !> Does some ground carry no more than so much, and does it come to that on a curve
    pure subroutine find_limits(lowered, yields, levels_off)
        type(lowered_type), intent(in) :: lowered
        logical, intent(out) :: yields, levels_off
        integer :: k

        yields = .false.
        levels_off = .false.
        do k = 1, size(lowered%layers)
            associate (layer => lowered%layers(k))
                if (.not. has_limit(layer, lowered%law_pieces)) cycle
                yields = .true.
                levels_off = levels_off .or. has_curves(layer)
            end associate
        end do
    end subroutine find_limits

end module gapbeam_ground_path
