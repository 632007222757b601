!> States of a beam on the ground at one load factor after another, as a path whose states are found by a solve each
!> (gapbeam_path_problem), and what changes between them.
!>
!> Between two changes the ends of the zones move smoothly with the load, and no formula gives the factor of the next change: the
!> states on a grid of factors are compared. How far a change is away tells gapbeam_zone_margin.
module gapbeam_ground_states
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_moved_ground, only: move_ground
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_zone_margin, only: change_type, find_margin
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type, start_from, settle_nearby, take_zones
    use gapbeam_ground_refinement, only: refine_factor
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_smooth_laws, only: deflections_at_curves
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_path_problem, only: point_type, path_problem_type, crossing_type
    use gapbeam_ground_changes, only: find_zones
    use gapbeam_curve_changes, only: is_of_curve, margin_of_curve, narrow_on_curve
    use gapbeam_ground_events, only: ground_path_type, held_type, list_changes_between => list_changes, note_changes, &
        add_segment, same_contact, beside
    implicit none
    private
    public :: ground_states_type

    !> Parts into which the loading history is cut before changes are looked for
    integer, parameter :: parts = 64
    !> Zones of this share of the beam have next to no length
    real(wp), parameter :: shortest = 2.0_wp**(-24)

    !> What is the same at all load factors, and what comes of them
    type, extends(path_problem_type) :: ground_states_type
        type(assembled_type), pointer :: assembled => null()
        !> The beam and its ground, moved to any factor, the same in quadruple precision, and the rule for its supports
        type(ground_type) :: ground
        type(fine_ground_type) :: fine
        integer :: rule = 0
        !> The scheme of the supports from which every search starts
        logical, allocatable :: start(:)
        !> The state solved last
        type(state_type) :: state
        !> Is the law of any support a curve
        logical :: on_curves = .false.
        !> Does the force of some ground fall, so that there may be other states not far away
        logical :: falls = .false.
        type(ground_path_type) :: path
    contains
        procedure :: find
        procedure :: look
        procedure :: alike
        procedure :: list_changes
        procedure :: measure
        procedure :: refine
        procedure :: next_stop
        procedure :: take_changes
    end type ground_states_type

contains

    !> What holds the beam at a load factor. Just below the last one next to nothing does: what cannot be settled there is no
    !> equilibrium for the time being, and take_end sees to it that there is none
    subroutine find(problem, at, point, error, near)
        class(ground_states_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        class(point_type), intent(in), optional :: near
        type(held_type), allocatable :: held
        type(ground_start_type) :: start
        type(ground_solution_type) :: solution

        allocate (held)
        held%at = at
        problem%state%closed(:) = problem%start
        if (present(near)) call start_in(near, start)
        if (allocated(start%closed)) then
            call solve_on_laws(problem%assembled, at, problem%rule, problem%state, error, curves_in(near), start)
        else
            call solve_on_laws(problem%assembled, at, problem%rule, problem%state, error)
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
            allocate (held%closed, source=problem%state%closed)
            held%on_curves = deflections_at_curves(problem%assembled, problem%state%deflection)
            call start_from(problem%state%ground, problem%state%closed, held%start)
            call find_zones(problem%assembled, problem%state%ground, held%zones, error)
            held%loose = problem%state%indifferent .and. .not. problem%state%loose_along
            if (held%loose .and. .not. allocated(error)) then
                solution = problem%state%ground
                held%carries = held%closed .and. .not. solution%undecided
                where (abs(solution%resultant) <= solution%no_force) solution%acts = 0
                call find_zones(problem%assembled, solution, held%carrying, error)
            end if
        else
            allocate (held%motion(0:size(problem%state%motion) - 1), source=problem%state%motion)
            held%reached = problem%state%ground%axial_share*at
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

    !> Deflections at supports on curves in a point
    pure function curves_in(point) result(deflections)
        class(point_type), intent(in) :: point
        real(wp), allocatable :: deflections(:)

        select type (point)
        type is (held_type)
            if (allocated(point%on_curves)) deflections = point%on_curves
        end select
        if (.not. allocated(deflections)) allocate (deflections(0))
    end function curves_in

    !> The same as far as double precision tells; where that does not tell, and at the last factor, for sure
    subroutine look(problem, at, near, point, error)
        class(ground_states_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        type(held_type), allocatable :: held
        type(ground_solution_type) :: solution
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        logical :: settled, solved, loose

        loose = .false.
        select type (near)
        type is (held_type)
            loose = near%loose
        end select
        if (at < problem%last .and. .not. (problem%falls .or. problem%on_curves .or. loose)) then
            allocate (held)
            held%at = at
            call start_in(near, held%start)
            call move_ground(problem%ground, at)
            call settle_nearby(problem%ground, at, problem%rule, held%start, grounded, work, problem%solves, settled, solved)
            call end_if_stopped(problem%assembled%beam%watch, error)
            if (allocated(error)) return
            if (settled .and. .not. has_short_zone(held%start%zones)) then
                allocate (held%closed, source=held%start%closed)
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
        class(ground_states_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        logical :: alike

        associate (unused => problem)
        end associate
        alike = same_contact(beside(before, after), beside(after, before))
    end function alike

    !> Supports that change, and zones
    subroutine list_changes(problem, before, after, changes)
        class(ground_states_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        type(change_type), allocatable, intent(out) :: changes(:)

        call list_changes_between(problem%assembled, beside(before, after), beside(after, before), changes)
    end subroutine list_changes

    !> How far a change is away at a load factor, in double precision; where laws of supports are curves, on the tangents there
    subroutine measure(problem, change, at, near, point, margin, place, known, other)
        class(ground_states_type), intent(inout) :: problem
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

        margin = 0.0_wp
        place = -1.0_wp
        allocate (held)
        held%at = at
        if (problem%on_curves) then
            call find_on_curves(problem, at, near, point, known, other)
            if (.not. known) return
            if (is_of_curve(problem%assembled, change)) then
                margin = margin_of_curve(problem%assembled, problem%state, change)
                return
            end if
            call put_tangents(problem)
            call settle_from(point)
        else
            call settle_from(near)
            if (present(other) .and. .not. settled) call settle_from(other)
        end if
        if (known) call find_margin(problem%ground, grounded, held%start%zones, at, work, held%start%closed, change, margin, place)
        if (.not. problem%on_curves) call move_alloc(held, point)

    contains

        !> Settle the zones from those of a point
        subroutine settle_from(one)
            class(point_type), intent(in) :: one

            call start_in(one, held%start)
            call move_ground(problem%ground, at)
            call settle_nearby(problem%ground, at, problem%rule, held%start, grounded, work, problem%solves, settled, known)
        end subroutine settle_from

    end subroutine measure

    !> The state at a load factor where laws of supports are curves, from one of two nearby
    subroutine find_on_curves(problem, at, near, point, known, other)
        class(ground_states_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        !> Does the beam stand there
        logical, intent(out) :: known
        class(point_type), intent(in), optional :: other
        type(error_type), allocatable :: error

        call problem%find(at, point, error, near)
        known = .not. allocated(error)
        if (known) known = point%stands
        if (known .or. .not. present(other)) return
        call problem%find(at, point, error, other)
        known = .not. allocated(error)
        if (known) known = point%stands
    end subroutine find_on_curves

    !> Put the tangents of the state solved last in place of curves
    subroutine put_tangents(problem)
        class(ground_states_type), intent(inout) :: problem

        problem%ground = ground_of(problem%assembled, problem%state%factor, problem%state)
        call refine_ground(problem%ground, problem%fine)
    end subroutine put_tangents

    !> The factor of a change to all digits
    subroutine refine(problem, crossing, found)
        class(ground_states_type), intent(inout) :: problem
        type(crossing_type), intent(inout) :: crossing
        logical, intent(out) :: found
        class(point_type), allocatable :: point

        found = .false.
        associate (c => crossing)
            if (problem%on_curves) then
                if (is_of_curve(problem%assembled, c%change)) then
                    c%at = c%one_further
                    call narrow_on_curve(problem, c, found)
                    return
                end if
                ! On the tangents next to it
                call find_on_curves(problem, c%at, c%near, point, found)
                if (.not. found) return
                call put_tangents(problem)
            end if
            select type (near => crossing%near)
            type is (held_type)
                call refine_factor(problem%ground, problem%fine, problem%rule, c%change, c%at, c%slope, c%place, near%start, &
                                   problem%solves, found)
            end select
        end associate
    end subroutine refine

    !> The next factor of the grid
    pure function next_stop(problem, point) result(next)
        class(ground_states_type), intent(in) :: problem
        class(point_type), intent(in) :: point
        real(wp) :: next
        integer :: k

        do k = 1, parts
            next = problem%last*(real(k, wp)/parts)
            if (next > point%at) exit
        end do
        if (.not. allocated(problem%ground%moving)) return
        if (.not. allocated(problem%ground%moving%begins)) return
        ! Where axial forces begin to grow otherwise
        associate (begins => problem%ground%moving%begins)
            next = min(next, minval(begins, begins > point%at))
        end associate
    end function next_stop

    !> Record what changes, and the segment that begins there
    subroutine take_changes(problem, before, after, at, place, error)
        class(ground_states_type), intent(inout) :: problem
        class(point_type), intent(in) :: before, after
        real(wp), intent(in) :: at(:), place(:)
        type(error_type), allocatable, intent(out) :: error

        call note_changes(problem%assembled, beside(before, after), beside(after, before), at, place, problem%path)
        call add_segment(minval(at), after, problem%path, error)
    end subroutine take_changes

end module gapbeam_ground_states
