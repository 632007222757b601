!> Load path of a beam on the ground, as a path whose states are found by a solve at each load factor (gapbeam_path_problem).
!>
!> Between two changes the ends of the zones move smoothly with the load, and no formula gives the factor of the next change: the
!> states on a grid of factors are compared. How far a change is away tells gapbeam_zone_margin. The last factor below which there
!> is equilibrium is where loads begin to do work along the motion that begins there; where laws are curves, limit analysis knows it.
module gapbeam_ground_problem
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_layers, only: has_limit, has_curves
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_zone_margin, only: change_type, find_margin
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_solver, only: limit_on_ground
    use gapbeam_ground_start, only: ground_start_type, start_from, settle_nearby, take_zones
    use gapbeam_ground_refinement, only: refine_factor
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: solve_state, ground_of, detail_of
    use gapbeam_path_problem, only: point_type, path_problem_type, crossing_type
    use gapbeam_ground_changes, only: find_zones
    use gapbeam_ground_events, only: ground_path_type, held_type, new_path, list_changes_between => list_changes, note_changes, &
        add_segment, same_contact
    implicit none
    private
    public :: ground_problem_type, new_ground_problem

    !> Parts into which the loading history is cut before changes are looked for
    integer, parameter :: parts = 64
    !> Zones of this share of the beam have next to no length
    real(wp), parameter :: shortest = 2.0_wp**(-24)
    !> Curves come to their limit where the beam has gone without end: the path is followed until this share of it is missing, or
    !> that, powers of 2
    integer, parameter :: missing_powers(*) = [-20, -10]
    !> Next to the limit of laws that are curves states take long: there parameters as near as this are neighbours
    real(wp), parameter :: near_on_curves = 2.0_wp**(-20)
    !> So near to the factor at which the loads begin to do work there is equilibrium, and none; that many times farther; and how
    !> often that factor is computed
    real(wp), parameter :: next_to_limit = 2.0_wp**(-50), wider = 64.0_wp
    integer, parameter :: most_guesses = 8

    !> What is the same at all load factors, and what comes of them
    type, extends(path_problem_type) :: ground_problem_type
        type(assembled_type), pointer :: assembled => null()
        !> The beam and its ground, the same in quadruple precision, and the rule for its supports
        type(ground_type) :: ground
        type(fine_ground_type) :: fine
        integer :: rule = 0
        !> The scheme of the supports from which every search starts
        logical, allocatable :: start(:)
        !> Does some ground carry no more than so much, and does it come to that on a curve
        logical :: yields = .false., levels_off = .false.
        !> The state solved last
        type(state_type) :: state
        type(ground_path_type) :: path
    contains
        procedure :: find
        procedure :: look
        procedure :: alike
        procedure :: list_changes
        procedure :: measure
        procedure :: refine
        procedure :: next_stop
        procedure :: approach_end
        procedure :: take_end
        procedure :: take_changes
    end type ground_problem_type

contains

    !> Make ready
    subroutine new_ground_problem(assembled, last, rule, state, problem)
        type(assembled_type), intent(in), target :: assembled
        !> The last factor, and the rule
        real(wp), intent(in) :: last
        integer, intent(in) :: rule
        !> With the scheme that every search starts from
        type(state_type), intent(in) :: state
        type(ground_problem_type), intent(out) :: problem
        integer :: k

        problem%assembled => assembled
        problem%ground = ground_of(assembled)
        call refine_ground(problem%ground, detail_of(assembled), problem%fine)
        problem%rule = rule
        problem%parameter = "load factor"
        problem%last = last
        problem%state = state
        allocate (problem%start(size(state%closed)))
        problem%start(:) = state%closed
        do k = 1, size(assembled%layers)
            associate (layer => assembled%layers(k))
                if (.not. has_limit(layer, assembled%law_pieces)) cycle
                problem%yields = .true.
                problem%levels_off = problem%levels_off .or. has_curves(layer)
            end associate
        end do
        if (problem%levels_off) problem%neighbours_at_end = near_on_curves
        call new_path(problem%path)
        problem%path%beyond = last
    end subroutine new_ground_problem

    !> What holds the beam at a load factor. Just below the last one next to nothing does: what cannot be settled there is no
    !> equilibrium for the time being, and take_end sees to it that there is none
    subroutine find(problem, at, point, error, near)
        class(ground_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        class(point_type), intent(in), optional :: near
        type(held_type), allocatable :: held
        type(ground_start_type) :: start

        allocate (held)
        held%at = at
        problem%state%closed(:) = problem%start
        if (present(near)) call start_in(near, start)
        if (allocated(start%closed)) then
            call solve_state(problem%assembled, at, problem%rule, problem%state, error, start)
        else
            call solve_state(problem%assembled, at, problem%rule, problem%state, error)
        end if
        if (allocated(error)) then
            if (error%code == gapbeam_not_converged .or. error%code == gapbeam_not_finite) then
                call move_alloc(error, held%trouble)
                call move_alloc(held, point)
            else
                error%message = "at "//problem%parameter//" "//trim(shown(at))//": "//error%message
            end if
            return
        end if
        problem%solves = problem%solves + problem%state%solves
        held%stands = problem%state%status == gapbeam_solved
        if (held%stands) then
            allocate (held%closed(size(problem%start)))
            held%closed(:) = problem%state%closed
            call start_from(problem%state%ground, problem%state%closed, held%start)
            call find_zones(problem%assembled, problem%state%ground, held%zones, error)
        else
            allocate (held%motion(0:size(problem%state%motion) - 1))
            held%motion(:) = problem%state%motion
        end if
        call move_alloc(held, point)
    end subroutine find

    !> Where the search for a state may begin from a point; not allocated if there is none there
    pure subroutine start_in(point, start)
        class(point_type), intent(in) :: point
        type(ground_start_type), intent(out) :: start

        select type (point)
        type is (held_type)
            start = point%start
        end select
    end subroutine start_in

    !> The same as far as double precision tells; where that does not tell, and at the last factor, for sure
    subroutine look(problem, at, near, point, error)
        class(ground_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        type(held_type), allocatable :: held
        type(ground_solution_type) :: solution
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        logical :: settled, solved

        if (at < problem%last) then
            allocate (held)
            held%at = at
            call start_in(near, held%start)
            call settle_nearby(problem%ground, at, problem%rule, held%start, grounded, work, problem%solves, settled, solved)
            call end_if_stopped(problem%assembled%beam%watch, error)
            if (allocated(error)) return
            if (settled .and. .not. has_short_zone(held%start%zones)) then
                allocate (held%closed(size(problem%start)))
                held%closed(:) = held%start%closed
                call take_zones(held%start%zones, solution)
                call find_zones(problem%assembled, solution, held%zones, error)
                held%stands = .true.
                held%sure = .false.
                call move_alloc(held, point)
                return
            end if
        end if
        call problem%find(at, point, error, near)
    end subroutine look

    !> Is there a zone with next to no length: it may have to carry what none can (gapbeam_ground_ties)
    pure function has_short_zone(zones) result(has)
        type(zones_type), intent(in) :: zones
        logical :: has
        real(wp) :: length
        integer :: i

        has = .false.
        length = sum(zones%to - zones%from)
        do i = 1, size(zones%piece)
            has = has .or. any(zones%acts(:, i) > 0) .and. zones%to(i) - zones%from(i) <= shortest*length
        end do
    end function has_short_zone

    !> Do the same supports hold the beam, and as many zones with ends of the same kind
    function alike(problem, before, after)
        class(ground_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        logical :: alike

        associate (unused => problem)
        end associate
        alike = .false.
        select type (before)
        type is (held_type)
            select type (after)
            type is (held_type)
                alike = same_contact(before, after)
            end select
        end select
    end function alike

    !> Supports that change, and zones
    subroutine list_changes(problem, before, after, changes)
        class(ground_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        type(change_type), allocatable, intent(out) :: changes(:)

        select type (before)
        type is (held_type)
            select type (after)
            type is (held_type)
                call list_changes_between(problem%assembled, before, after, changes)
            end select
        end select
    end subroutine list_changes

    !> How far a change is away at a load factor, in double precision
    subroutine measure(problem, change, at, near, point, margin, place, known, other)
        class(ground_problem_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        real(wp), intent(out) :: margin, place
        logical, intent(out) :: known
        class(point_type), intent(in), optional :: other
        type(held_type), allocatable :: held
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        logical :: settled

        allocate (held)
        held%at = at
        call start_in(near, held%start)
        call settle_nearby(problem%ground, at, problem%rule, held%start, grounded, work, problem%solves, settled, known)
        if (present(other) .and. .not. settled) then
            call start_in(other, held%start)
            call settle_nearby(problem%ground, at, problem%rule, held%start, grounded, work, problem%solves, settled, known)
        end if
        margin = 0.0_wp
        place = -1.0_wp
        if (known) call find_margin(problem%ground, grounded, held%start%zones, at, work, held%start%closed, change, margin, place)
        call move_alloc(held, point)
    end subroutine measure

    !> The factor of a change to all digits
    subroutine refine(problem, crossing, found)
        class(ground_problem_type), intent(inout) :: problem
        type(crossing_type), intent(inout) :: crossing
        logical, intent(out) :: found

        found = .false.
        associate (c => crossing)
            select type (near => crossing%near)
            type is (held_type)
                call refine_factor(problem%ground, problem%fine, problem%rule, c%change, c%at, c%slope, c%place, near%start, &
                                   problem%solves, found)
            end select
        end associate
    end subroutine refine

    !> The next factor of the grid
    pure function next_stop(problem, point) result(next)
        class(ground_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: point
        real(wp) :: next
        integer :: k

        do k = 1, parts
            next = problem%last*(real(k, wp)/parts)
            if (next > point%at) return
        end do
    end function next_stop

    !> Record what changes, and the segment that begins there
    subroutine take_changes(problem, before, after, at, place, error)
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: before, after
        real(wp), intent(in) :: at(:), place(:)
        type(error_type), allocatable, intent(out) :: error

        select type (before)
        type is (held_type)
            select type (after)
            type is (held_type)
                call note_changes(problem%assembled, before, after, at, place, problem%path, error)
                if (.not. allocated(error)) call add_segment(minval(at), after, problem%path, error)
            end select
        end select
    end subroutine take_changes

    !> Nearer to the factor above which there is no equilibrium: by limit analysis where laws are curves, else by the work of the loads
    subroutine approach_end(problem, below, above, ended, error)
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: below, above
        logical, intent(out) :: ended
        type(error_type), allocatable, intent(out) :: error

        ended = .false.
        if (problem%levels_off) call go_to_limit(problem, below, above, ended, error)
        if (allocated(error) .or. ended) return
        if (.not. above%stands) call approach_by_work(problem, below, above, error)
    end subroutine approach_end

    !> Where laws are curves limit analysis knows the limit load: end the path there, or look next to it for what changes before
    subroutine go_to_limit(problem, below, above, ended, error)
        !> As for approach_end
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(in) :: below
        class(point_type), allocatable, intent(inout) :: above
        logical, intent(inout) :: ended
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        real(wp) :: bears, beyond
        logical :: found
        integer :: k

        bears = below%at
        beyond = above%at
        call limit_on_ground(problem%ground, detail_of(problem%assembled), bears, beyond, found)
        if (.not. found) return
        do k = 1, size(missing_powers)
            associate (last => bears*(1 - 2.0_wp**missing_powers(k)))
                if (last <= below%at) return
                call problem%find(last, point, error, below)
            end associate
            if (allocated(error)) return
            if (point%stands) exit
        end do
        if (.not. point%stands) return
        if (.not. problem%alike(below, point)) then
            call move_alloc(point, above)
            return
        end if
        problem%path%last = point%at
        problem%path%beyond = beyond
        problem%path%at_limit = .true.
        ended = .true.
        call problem%find(beyond, point, error)
    end subroutine go_to_limit

    !> Nearer to where the loads begin to do work along the motion at the upper of two factors
    subroutine approach_by_work(problem, below, above, error)
        !> As for approach_end
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: below, above
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: between
        real(wp) :: guess, reach
        integer :: guesses

        reach = next_to_limit
        do guesses = 1, most_guesses
            if (above%stands) return
            guess = factor_without_work(problem, above)
            ! States may end before, where they are told from others
            if (guess*(1 - reach) >= above%at .and. guess*(1 - wider*reach) < above%at) reach = wider*reach
            if (.not. (guess*(1 - reach) > below%at .and. guess*(1 - reach) < above%at)) return
            call problem%find(guess*(1 - reach), between, error, below)
            if (allocated(error)) return
            if (problem%alike(below, between)) exit
            if (allocated(between%trouble)) return
            call move_alloc(between, above)
        end do
        if (.not. allocated(between)) return
        call move_alloc(between, below)
        if (guess*(1 + reach) >= above%at) return
        call problem%find(guess*(1 + reach), between, error)
        if (allocated(error) .or. between%stands) return
        call move_alloc(between, above)
    end subroutine approach_by_work

    !> The load factor at which the loads do no work along the motion at a factor at which they do; below zero if there is none
    pure function factor_without_work(problem, above) result(guess)
        type(ground_problem_type), intent(in) :: problem
        class(point_type), intent(in) :: above
        real(wp) :: guess, of_dead, of_all, size_of_parts

        guess = -1.0_wp
        select type (above)
        type is (held_type)
            if (.not. allocated(above%motion)) return
            associate (all_nodes => [0, ubound(above%motion, 1)], beam => problem%ground%beam)
                call work_of_loads(beam, 0.0_wp, above%motion, all_nodes, of_dead, size_of_parts)
                call work_of_loads(beam, above%at, above%motion, all_nodes, of_all, size_of_parts)
            end associate
            if (abs(of_dead - of_all) > 0.0_wp) guess = above%at*(of_dead/(of_dead - of_all))
        end select
    end function factor_without_work

    !> End the path, and find a factor just above at which there is no equilibrium for sure, and how the beam moves there
    subroutine take_end(problem, below, above, goes_on, error)
        class(ground_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: below, above
        logical, intent(out) :: goes_on
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point
        integer :: power

        goes_on = .false.
        associate (path => problem%path)
            path%last = below%at
            path%beyond = below%at
            path%at_limit = problem%yields .and. path%last > 0.0_wp
            if (.not. allocated(above%trouble)) then
                if (problem%levels_off) path%beyond = above%at
                call problem%find(above%at, point, error)
                return
            end if
            do power = -50, -9, 4
                path%beyond = path%last*(1 + 2.0_wp**power)
                call problem%find(path%beyond, point, error)
                if (allocated(error)) return
                if (.not. point%stands .and. .not. allocated(point%trouble)) return
            end do
        end associate
        error = above%trouble
    end subroutine take_end

end module gapbeam_ground_problem
