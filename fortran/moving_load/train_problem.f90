!> Position of a train on the ground or on smooth laws, as a path whose states are found by a solve each (gapbeam_path_problem).
!>
!> While the same axles act, zones, supports and laws change smoothly with the position. What comes of a walk is the list of its
!> states, and of the crossings between them.
module gapbeam_train_problem
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed, gapbeam_solved
    use gapbeam_laws, only: is_smooth
    use gapbeam_ground, only: ground_type, grounded_type
    use gapbeam_ground_start, only: ground_start_type, settle_nearby
    use gapbeam_workspace, only: workspace_type
    use gapbeam_zone_margin, only: change_type, find_margin
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_path_problem, only: point_type
    use gapbeam_train, only: train_type
    use gapbeam_train_on_beam, only: put_train, end_of_beam
    use gapbeam_train_states, only: kept_type, box_type, solve_at, put_near, take_undecided, alike_states => alike, same_units
    use gapbeam_train_changes, only: list_changes_between, measure_support
    use gapbeam_train_way, only: train_way_type, crossing_type, append, append_crossing, decide
    implicit none
    private
    public :: train_problem_type, position_type, new_train_problem, add_state

    !> Positions nearer to each other than this share of the beam are neighbours
    real(wp), parameter :: neighbours = 2.0_wp**(-45)
    !> States as near as this to a crossing are left out, but for the neighbours on both sides of it
    real(wp), parameter :: share_apart = 2.0_wp**(-30)
    !> States that are tried to find these, each so many times farther away as long as nothing changes
    integer, parameter :: most_tries = 60
    real(wp), parameter :: farther = 8.0_wp

    !> A position: the number of its state, or only what another measurement needs to begin there
    type, extends(point_type) :: position_type
        integer :: state = 0
        type(kept_type), allocatable :: measured
    end type position_type

    !> A beam, a train on it, and what comes of it
    type, extends(train_way_type) :: train_problem_type
        type(assembled_type), pointer :: assembled => null()
        type(train_type) :: train
        integer :: rule = 0
        !> Which axles act, and the grid: equal parts from one position to the last
        logical, allocatable :: acts(:)
        real(wp) :: first = 0.0_wp
        integer :: parts = 1
        !> Is the law of any support a curve
        logical :: on_curves = .false.
    contains
        procedure :: find
        procedure :: alike
        procedure :: list_changes
        procedure :: measure
        procedure :: next_stop
        procedure :: take_changes
        procedure :: take
    end type train_problem_type

contains

    !> Make ready
    subroutine new_train_problem(assembled, train, rule, problem)
        type(assembled_type), intent(in), target :: assembled
        type(train_type), intent(in) :: train
        !> rule_block or rule_single
        integer, intent(in) :: rule
        type(train_problem_type), intent(out) :: problem

        problem%assembled => assembled
        problem%train = train
        problem%rule = rule
        problem%parameter = "position"
        problem%on_curves = any(is_smooth(assembled%model%supports%law))
        problem%extent = end_of_beam(assembled)
        problem%neighbours = neighbours
        problem%neighbours_at_end = neighbours
        allocate (problem%boxes(64), problem%way(64), problem%crossings(0))
    end subroutine new_train_problem

    !> Solve at a position, and keep the state
    subroutine add_state(problem, at, number, error, near, measured, undecided)
        class(train_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        !> Of the state
        integer, intent(out) :: number
        !> As for solve_at
        type(error_type), allocatable, intent(out) :: error
        !> Number of a state near which it may be looked for, and from which what is not decided is taken; 0: none
        integer, intent(in) :: near
        !> Where else it may be looked for
        type(kept_type), intent(in), optional :: measured
        !> Does that stay undecided
        logical, intent(in), optional :: undecided
        type(box_type), allocatable :: more(:)
        type(kept_type), allocatable :: kept
        integer :: i, stat
        logical :: takes

        number = problem%states + 1
        if (number > size(problem%boxes)) then
            allocate (more(2*number), stat=stat)
            if (failed(stat, error)) return
            do i = 1, problem%states
                call move_alloc(problem%boxes(i)%of, more(i)%of)
            end do
            call move_alloc(more, problem%boxes)
        end if
        allocate (kept)
        if (near > 0) then
            call solve_at(problem%assembled, problem%train, problem%rule, at, problem%acts, kept, problem%solves, error, &
                          problem%boxes(near)%of)
        else
            call solve_at(problem%assembled, problem%train, problem%rule, at, problem%acts, kept, problem%solves, error, measured)
        end if
        if (.not. allocated(error)) call end_if_stopped(problem%assembled%beam%watch, error)
        if (allocated(error)) return
        takes = near > 0
        if (present(undecided)) takes = takes .and. .not. undecided
        if (takes) call take_undecided(kept, problem%boxes(near)%of)
        call move_alloc(kept, problem%boxes(number)%of)
        problem%states = number
    end subroutine add_state

    !> The state at a position; what is not decided there is as near it
    subroutine find(problem, at, point, error, near)
        class(train_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        class(point_type), intent(in), optional :: near
        type(position_type), allocatable :: found

        allocate (found)
        found%at = at
        if (present(near)) then
            select type (near)
            type is (position_type)
                call add_state(problem, at, found%state, error, near%state, near%measured)
            end select
        else
            call add_state(problem, at, found%state, error, 0)
        end if
        if (allocated(error)) return
        found%stands = problem%boxes(found%state)%of%status == gapbeam_solved
        call move_alloc(found, point)
    end subroutine find

    !> Number of the state of a point
    pure function number_of(point) result(number)
        class(point_type), intent(in) :: point
        integer :: number

        number = 0
        select type (point)
        type is (position_type)
            number = point%state
        end select
    end function number_of

    !> Does the same hold the beam
    function alike(problem, before, after)
        class(train_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        logical :: alike

        alike = alike_states(problem%boxes(number_of(before))%of, problem%boxes(number_of(after))%of)
    end function alike

    !> Supports that change, and zones
    subroutine list_changes(problem, before, after, changes)
        class(train_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        type(change_type), allocatable, intent(out) :: changes(:)

        call list_changes_between(problem%boxes(number_of(before))%of, problem%boxes(number_of(after))%of, changes)
    end subroutine list_changes

    !> How far a change is away at a position
    subroutine measure(problem, change, at, near, point, margin, place, known, other)
        class(train_problem_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        real(wp), intent(out) :: margin, place
        logical, intent(out) :: known
        class(point_type), intent(in), optional :: other
        type(error_type), allocatable :: error

        margin = 0.0_wp
        place = -1.0_wp
        if (allocated(problem%assembled%layers) .and. .not. problem%on_curves) then
            call measure_on_ground(problem, change, at, near, point, margin, place, known, other)
            return
        end if
        known = .false.
        call problem%find(at, point, error, near)
        if (allocated(error)) then
            allocate (position_type :: point)
            return
        end if
        if (.not. point%stands) return
        associate (kept => problem%boxes(number_of(point))%of)
            if (change%support > 0) known = is_smooth(kept%placed%model%supports(kept%placed%normal(change%support))%law)
            if (known .or. .not. allocated(kept%placed%layers)) then
                call measure_support(kept, change%support, margin, known)
            else
                call measure_on_tangents(kept, problem%rule, change, problem%solves, margin, place, known)
            end if
        end associate
    end subroutine measure

    !> The same of what is on no curve, on the ground, where tangents of the state take the place of curves
    subroutine measure_on_tangents(kept, rule, change, solves, margin, place, known)
        type(kept_type), intent(in) :: kept
        integer, intent(in) :: rule
        type(change_type), intent(in) :: change
        integer, intent(inout) :: solves
        real(wp), intent(inout) :: margin, place
        logical, intent(out) :: known
        type(ground_type) :: ground
        type(ground_start_type) :: start
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        logical :: settled

        ground = ground_of(kept%placed, 1.0_wp, kept%state)
        start = kept%start
        call settle_nearby(ground, 1.0_wp, rule, start, grounded, work, solves, settled, known)
        if (known) call find_margin(ground, grounded, start%zones, 1.0_wp, work, start%closed, change, margin, place)
        if (known .and. place >= 0.0_wp) place = scale(place, kept%placed%units%length)
    end subroutine measure_on_tangents

    !> The same on the ground, in double precision
    subroutine measure_on_ground(problem, change, at, near, point, margin, place, known, other)
        !> As for measure
        class(train_problem_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        real(wp), intent(inout) :: margin, place
        logical, intent(out) :: known
        class(point_type), intent(in), optional :: other
        type(position_type), allocatable :: found
        type(ground_type) :: ground
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        type(error_type), allocatable :: error
        logical :: settled

        allocate (found)
        allocate (found%measured)
        found%at = at
        settled = .false.
        known = .false.
        associate (measured => found%measured)
            measured%position = at
            allocate (measured%placed)
            call put_train(problem%assembled, problem%train, at, problem%acts, measured%placed, error)
            if (.not. allocated(error)) then
                ground = ground_of(measured%placed, 1.0_wp)
                call begin_at(near)
                if (present(other) .and. .not. settled) call begin_at(other)
            end if
            if (known) then
                call find_margin(ground, grounded, measured%start%zones, 1.0_wp, work, measured%start%closed, change, margin, place)
                if (place >= 0.0_wp) place = scale(place, measured%placed%units%length)
            end if
        end associate
        call move_alloc(found, point)

    contains

        !> Settle the zones from those of a point
        subroutine begin_at(one)
            class(point_type), intent(in) :: one

            select type (one)
            type is (position_type)
                if (one%state > 0) then
                    call carry(problem%boxes(one%state)%of)
                else if (allocated(one%measured)) then
                    call carry(one%measured)
                end if
            end select
            if (known) call settle_nearby(ground, 1.0_wp, problem%rule, found%measured%start, grounded, work, problem%solves, &
                                          settled, known)
        end subroutine begin_at

        !> The zones of a state are where to begin
        subroutine carry(kept)
            type(kept_type), intent(in) :: kept

            known = same_units(kept, found%measured%placed)
            if (known) call put_near(kept, found%measured%placed, ground, found%measured%start, known)
        end subroutine carry

    end subroutine measure_on_ground

    !> The next position of the grid
    pure function next_stop(problem, point) result(next)
        class(train_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: point
        real(wp) :: next
        integer :: k

        k = max(1, int((point%at - problem%first)/(problem%last - problem%first)*problem%parts) - 1)
        do
            next = problem%last
            if (k < problem%parts) next = problem%first + (problem%last - problem%first)*k/problem%parts
            if (next > point%at .or. k >= problem%parts) return
            k = k + 1
        end do
    end function next_stop

    !> Record a state on the way
    subroutine take(problem, point, error)
        class(train_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: point
        type(error_type), allocatable, intent(out) :: error
        integer :: latest

        latest = 0
        if (problem%length > 0) latest = -problem%way(problem%length)
        call decide(problem, number_of(point))
        if (latest > 0) then
            associate (crossing => problem%crossings(latest))
                if (number_of(point) /= crossing%above .and. point%at < problem%last .and. &
                    point%at - crossing%at <= share_apart*problem%extent) return
            end associate
        end if
        call append(problem, number_of(point), error)
    end subroutine take

    !> Record a crossing
    subroutine take_changes(problem, before, after, at, place, error)
        class(train_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: before, after
        real(wp), intent(in) :: at(:), place(:)
        type(error_type), allocatable, intent(out) :: error
        type(crossing_type) :: crossing

        crossing%below = number_of(before)
        crossing%above = number_of(after)
        call decide(problem, crossing%below)
        crossing%place = pack(place, place >= 0.0_wp)
        crossing%at = after%at
        if (size(at) > 0) crossing%at = min(max(minval(at), before%at), after%at)
        if (crossing%at > before%at .and. crossing%at < after%at) call draw_near(problem, crossing, error)
        if (allocated(error)) return
        if (problem%length > 1 .and. crossing%below /= number_of(before)) then
            if (problem%way(problem%length) == number_of(before) .and. crossing%at - before%at <= share_apart*problem%extent &
                .and. problem%way(problem%length - 1) > 0) problem%length = problem%length - 1
        end if
        call append_crossing(problem, crossing, error)
    end subroutine take_changes

    !> Neighbours on both sides of a crossing: what it was computed from has rounding of its own
    subroutine draw_near(problem, crossing, error)
        class(train_problem_type), intent(inout) :: problem
        !> With its position as computed, and states around it, in; its neighbours out
        type(crossing_type), intent(inout) :: crossing
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: way, next
        integer :: number, tries
        logical :: is_below, is_above

        way = 2*neighbours*problem%extent
        next = crossing%at
        do tries = 1, most_tries
            call add_state(problem, next, number, error, crossing%below, undecided=.true.)
            if (allocated(error)) return
            if (problem%boxes(number)%of%status /= gapbeam_solved) exit
            is_below = alike_states(problem%boxes(crossing%below)%of, problem%boxes(number)%of)
            is_above = alike_states(problem%boxes(crossing%above)%of, problem%boxes(number)%of)
            ! Next to it others change, which the states around it do not show
            if (.not. (is_below .or. is_above)) exit
            ! What is like both does not tell, so the position as computed does
            if (is_below) is_below = next <= crossing%at .or. .not. is_above
            call take_undecided(problem%boxes(number)%of, problem%boxes(merge(crossing%below, crossing%above, is_below))%of)
            if (is_below) crossing%below = number
            if (.not. is_below) crossing%above = number
            associate (low => problem%boxes(crossing%below)%of%position, high => problem%boxes(crossing%above)%of%position)
                if (high - low <= 2*neighbours*problem%extent) exit
                next = merge(low + way, high - way, is_below)
                if (.not. (next > low .and. next < high)) next = low + (high - low)/2
                if (.not. (next > low .and. next < high)) exit
            end associate
            way = farther*way
        end do
        crossing%at = min(max(crossing%at, problem%boxes(crossing%below)%of%position), problem%boxes(crossing%above)%of%position)
    end subroutine draw_near

end module gapbeam_train_problem
