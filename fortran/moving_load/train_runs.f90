!> A train on its way over the ground or over smooth laws: states at positions near to each other, and what changes between them.
!>
!> With zones of contact and curves no formula says how a state depends on the position. Between two borders
!> (gapbeam_train_grid) the walk of gapbeam_train_problem goes along a grid; what undoes itself between two of its states is not
!> seen.
module gapbeam_train_runs
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_laws, only: law_cubic
    use gapbeam_quantities, only: of_deflection
    use gapbeam_query, only: extremes_of_fields
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_walk, only: walk_along
    use gapbeam_pieces, only: what_happens, no_change
    use gapbeam_ground_changes, only: zone_change_type, compare_zones
    use gapbeam_train, only: train_type
    use gapbeam_train_events, only: train_event_type
    use gapbeam_train_on_beam, only: acting_axles
    use gapbeam_train_grid, only: find_borders, find_parts, ends_of_ground
    use gapbeam_train_states, only: kept_type, box_type, alike
    use gapbeam_train_way, only: crossing_type, append
    use gapbeam_train_problem, only: train_problem_type, position_type, new_train_problem, add_state
    use gapbeam_train_reversal, only: are_some_of_several, refuse_other_way
    implicit none
    private
    public :: run_type, lost_type, runs_type, follow_train_on_ground

    !> Positions on both sides of a change between which a state is not settled are neighbours if they are as near as this share of
    !> the beam: a zone has next to no length there
    real(wp), parameter :: next_to = 2.0_wp**(-32)
    !> Zones begin and end at the ends of the ground if they do so within this share of the beam
    real(wp), parameter :: at_end = 2.0_wp**(-34)
    !> Positions of a run nearer to each other than this share of the beam have none between them
    real(wp), parameter :: apart = 2.0_wp**(-43)

    !> Positions one after the other between two changes, all solved, with the same axles on the beam: numbers of the states
    type :: run_type
        integer, allocatable :: states(:)
    end type run_type

    !> Positions that are not solved: numbers of the first and the last such state
    type :: lost_type
        integer :: first = 0, last = 0
    end type lost_type

    !> A train on its way, in ascending order of the positions
    type :: runs_type
        type(train_type) :: train
        integer :: rule = 0
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        type(box_type), allocatable :: boxes(:)
        !> The state of the top that was climbed last, where it is none of those
        type(box_type) :: top
        type(run_type), allocatable :: runs(:)
        type(lost_type), allocatable :: lost(:)
        !> In the order in which they happen
        type(train_event_type), allocatable :: events(:)
        !> May the beam have other states at these positions
        logical :: are_some_of_several = .false.
        integer :: solves = 0
    end type runs_type

contains

    !> Follow a train
    subroutine follow_train_on_ground(assembled, train, rule, from, to, backwards, runs, error)
        !> On the ground, or with smooth laws
        type(assembled_type), intent(in), target :: assembled
        type(train_type), intent(in) :: train
        !> rule_block or rule_single
        integer, intent(in) :: rule
        !> Positions
        real(wp), intent(in) :: from, to
        !> Does it go towards smaller positions
        logical, intent(in) :: backwards
        type(runs_type), intent(out) :: runs
        !> As for solve_at and refuse_other_way, too many positions, or changes that cannot be told apart
        type(error_type), allocatable, intent(out) :: error
        type(train_problem_type) :: problem
        integer, allocatable :: cells(:)

        runs%train = train
        runs%rule = rule
        runs%from = from
        runs%to = to
        call new_train_problem(assembled, train, rule, problem)
        call walk_cells(problem, from, to, cells, error)
        runs%are_some_of_several = are_some_of_several(problem)
        if (backwards .and. runs%are_some_of_several .and. .not. allocated(error)) call refuse_other_way(problem, error)
        if (.not. allocated(error)) call read_way(problem, cells, backwards, runs)
        if (.not. allocated(error)) call fill_short_runs(problem, runs, error)
        if (allocated(error)) return
        runs%solves = problem%solves
        call drop_others(problem, runs)
        call move_alloc(problem%boxes, runs%boxes)
    end subroutine follow_train_on_ground

    !> Go along the whole way, from border to border
    subroutine walk_cells(problem, from, to, cells, error)
        type(train_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: from, to
        !> Numbers of the entries of the way with which cells begin: in one the same axles act, and none passes a kink
        integer, allocatable, intent(out) :: cells(:)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: borders(:)
        integer, allocatable :: parts(:)
        logical, allocatable :: acts(:)
        type(position_type) :: start
        real(wp) :: deflection
        integer :: k, number
        logical :: ended

        cells = [1]
        problem%acts = acting_axles(problem%assembled, problem%train, from)
        call add_to_way(from)
        if (allocated(error) .or. .not. to > from) return
        call find_borders(problem%assembled, problem%train, from, to, borders)
        call largest_deflection(problem, from, to, deflection, error)
        if (.not. allocated(error)) call find_parts(problem%assembled, borders, deflection, parts, error)
        if (allocated(error)) return
        do k = 1, size(parts)
            acts = acting_axles(problem%assembled, problem%train, borders(k) + (borders(k + 1) - borders(k))/2)
            call begin_cell(borders(k))
            if (allocated(error)) return
            problem%first = borders(k)
            problem%last = borders(k + 1)
            problem%parts = parts(k)
            number = problem%way(problem%length)
            start%at = borders(k)
            start%state = number
            start%stands = problem%boxes(number)%of%status == gapbeam_solved
            call walk_along(problem, start, ended, error)
            if (allocated(error)) return
            acts = acting_axles(problem%assembled, problem%train, borders(k + 1))
            if (any(acts .neqv. problem%acts)) call begin_cell(borders(k + 1))
            if (allocated(error)) return
        end do

    contains

        !> Begin a cell with the last state, or where other axles act with another one there
        subroutine begin_cell(position)
            real(wp), intent(in) :: position

            if (any(acts .neqv. problem%acts)) then
                problem%acts = acts
                cells = [cells, problem%length + 1]
                call add_to_way(position)
            else if (problem%length > cells(size(cells))) then
                cells = [cells, problem%length + 1]
                call append(problem, (problem%way(problem%length)), error)
            end if
        end subroutine begin_cell

        !> Solve at a position, near the last state
        subroutine add_to_way(position)
            real(wp), intent(in) :: position
            integer :: new, near

            near = 0
            if (problem%length > 0) near = problem%way(problem%length)
            call add_state(problem, position, new, error, max(near, 0))
            if (.not. allocated(error)) call append(problem, new, error)
        end subroutine add_to_way

    end subroutine walk_cells

    !> How far the beam goes down or up about, on ground that gets stiffer by that; 0 without
    subroutine largest_deflection(problem, from, to, deflection, error)
        type(train_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: from, to
        real(wp), intent(out) :: deflection
        type(error_type), allocatable, intent(out) :: error
        type(train_problem_type) :: other
        real(wp) :: position, value(2, 1), x(2, 1)
        integer :: k, number

        deflection = 0.0_wp
        if (.not. any(problem%assembled%model%foundations%law == law_cubic)) return
        call new_train_problem(problem%assembled, problem%train, problem%rule, other)
        do k = 1, 3
            position = from + 0.25_wp*k*(to - from)
            other%acts = acting_axles(problem%assembled, problem%train, position)
            call add_state(other, position, number, error, 0)
            if (allocated(error)) return
            associate (kept => other%boxes(number)%of)
                if (kept%status /= gapbeam_solved) cycle
                call extremes_of_fields(kept%placed, kept%state, [of_deflection], value, x, error)
            end associate
            if (allocated(error)) return
            deflection = max(deflection, maxval(abs(value)))
        end do
        problem%solves = problem%solves + other%solves
    end subroutine largest_deflection

    !> Runs, events and lost positions
    subroutine read_way(problem, cells, backwards, runs)
        type(train_problem_type), intent(in) :: problem
        integer, intent(in) :: cells(:)
        logical, intent(in) :: backwards
        type(runs_type), intent(inout) :: runs
        type(lost_type) :: missing
        integer, allocatable :: run(:)
        integer :: i, last, number

        allocate (runs%runs(0), runs%lost(0), runs%events(0), run(0))
        last = 0
        do i = 1, problem%length
            if (any(cells == i)) call end_run()
            number = problem%way(i)
            if (number < 0) then
                call cross(problem%crossings(-number))
                cycle
            end if
            associate (kept => problem%boxes(number)%of)
                if (kept%status /= gapbeam_solved) then
                    call end_run()
                    if (missing%first > 0) then
                        if (problem%boxes(missing%last)%of%status /= kept%status) call note_lost()
                    end if
                    if (missing%first == 0) missing%first = number
                    missing%last = number
                    cycle
                end if
                if (missing%first > 0) then
                    if (.not. is_narrow(kept)) call note_lost()
                    missing = lost_type()
                end if
                if (last > 0 .and. last /= number) then
                    if (.not. alike(problem%boxes(max(last, 1))%of, kept)) then
                        if (size(run) > 0 .and. last > 0) call end_run()
                        call add_events(crossing_type(last, number, kept%position))
                    end if
                end if
            end associate
            if (last /= number .or. size(run) == 0) run = [run, number]
            last = number
        end do
        call end_run()
        if (missing%first > 0) call note_lost()
        if (.not. backwards) return
        runs%events = runs%events(size(runs%events):1:-1)
        runs%lost = runs%lost(size(runs%lost):1:-1)

    contains

        !> Go on to the states beyond a crossing
        subroutine cross(crossing)
            type(crossing_type), intent(in) :: crossing

            if (last /= crossing%below) run = [run, crossing%below]
            call end_run()
            call add_events(crossing)
            last = crossing%above
            run = [crossing%above]
        end subroutine cross

        !> The run so far is one
        subroutine end_run()
            type(run_type), allocatable :: longer(:)
            integer :: k

            if (size(run) == 0) return
            allocate (longer(size(runs%runs) + 1))
            do k = 1, size(runs%runs)
                call move_alloc(runs%runs(k)%states, longer(k)%states)
            end do
            longer(size(longer))%states = run
            call move_alloc(longer, runs%runs)
            run = [integer ::]
        end subroutine end_run

        !> Positions were lost
        subroutine note_lost()
            runs%lost = [runs%lost, missing]
            missing = lost_type()
            last = 0
        end subroutine note_lost

        !> Were states only not settled, next to a change
        function is_narrow(kept)
            type(kept_type), intent(in) :: kept
            logical :: is_narrow

            is_narrow = last > 0 .and. any(problem%boxes(missing%first)%of%status == [gapbeam_not_converged, gapbeam_not_finite])
            if (is_narrow) is_narrow = kept%position - problem%boxes(last)%of%position <= next_to*problem%extent
        end function is_narrow

        !> Events of a crossing
        subroutine add_events(crossing)
            type(crossing_type), intent(in) :: crossing

            associate (before => merge(crossing%above, crossing%below, backwards), &
                       after => merge(crossing%below, crossing%above, backwards))
                call list_events(problem%assembled, problem%boxes(before)%of, problem%boxes(after)%of, crossing, runs%events, &
                                 backwards)
            end associate
        end subroutine add_events

    end subroutine read_way

    !> The events between two states, supports before zones; reversed where the train goes backwards, as all events will be
    subroutine list_events(assembled, before, after, crossing, events, backwards)
        type(assembled_type), intent(in) :: assembled
        !> As the train goes
        type(kept_type), intent(in) :: before, after
        type(crossing_type), intent(in) :: crossing
        !> They are added at the end
        type(train_event_type), allocatable, intent(inout) :: events(:)
        logical, intent(in) :: backwards
        type(train_event_type), allocatable :: found(:)
        type(zone_change_type), allocatable :: changes(:)
        real(wp) :: x
        integer :: k, number, what
        logical :: measured

        allocate (found(0))
        do k = 1, size(before%acting)
            if (.not. (before%decided(k) .and. after%decided(k))) cycle
            what = what_happens(before%acting(k), after%acting(k))
            if (what == no_change) cycle
            x = point_x(assembled, assembled%support_point(k))
            found = [found, train_event_type(crossing%at, k, after%acting(k)%condition, what, x=x)]
        end do
        if (allocated(before%zones)) then
            call compare_zones(before%zones, after%zones, changes, number)
            do k = 1, number
                x = changes(k)%x
                measured = allocated(crossing%place)
                if (measured) measured = size(crossing%place) > 0
                if (measured) then
                    associate (there => crossing%place(minloc(abs(crossing%place - x), 1)))
                        if (abs(there - x) <= changes(k)%to - changes(k)%from .or. abs(there - x) <= next_to*(1 + abs(x))) x = there
                    end associate
                end if
                found = [found, train_event_type(crossing%at, 0, 0, changes(k)%change, changes(k)%foundation, changes(k)%branch, &
                                                 end_or(x))]
            end do
        end if
        if (backwards) found = found(size(found):1:-1)
        events = [events, found]

    contains

        !> A place, or the end of the beam or of a foundation that is as near
        function end_or(place) result(there)
            real(wp), intent(in) :: place
            real(wp) :: there
            real(wp), allocatable :: ends(:)

            allocate (ends, source=ends_of_ground(assembled))
            there = ends(minloc(abs(ends - place), 1))
            if (abs(there - place) > at_end*ends(size(ends))) there = place
        end function end_or

    end subroutine list_events

    !> Solve in the middle of runs of two states: those do not tell how values bend
    subroutine fill_short_runs(problem, runs, error)
        type(train_problem_type), intent(inout) :: problem
        type(runs_type), intent(inout) :: runs
        type(error_type), allocatable, intent(out) :: error
        integer :: k, number

        do k = 1, size(runs%runs)
            associate (states => runs%runs(k)%states)
                if (size(states) /= 2) cycle
                associate (from => problem%boxes(states(1))%of%position, to => problem%boxes(states(2))%of%position)
                    if (to - from <= apart*problem%extent) cycle
                    problem%acts = problem%boxes(states(1))%of%acts
                    call add_state(problem, from + (to - from)/2, number, error, states(1))
                end associate
            end associate
            if (allocated(error)) return
            if (problem%boxes(number)%of%status /= gapbeam_solved) cycle
            runs%runs(k)%states = [runs%runs(k)%states(1), number, runs%runs(k)%states(2)]
        end do
    end subroutine fill_short_runs

    !> States of no run and no lost position are not needed any more
    subroutine drop_others(problem, runs)
        type(train_problem_type), intent(inout) :: problem
        type(runs_type), intent(in) :: runs
        logical, allocatable :: needed(:)
        integer :: k

        allocate (needed(problem%states), source=.false.)
        do k = 1, size(runs%runs)
            needed(runs%runs(k)%states) = .true.
        end do
        needed(runs%lost%first) = .true.
        needed(runs%lost%last) = .true.
        do k = 1, size(needed)
            if (.not. needed(k)) deallocate (problem%boxes(k)%of)
        end do
    end subroutine drop_others

end module gapbeam_train_runs
