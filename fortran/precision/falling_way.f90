!> The way of the loads on ground whose force falls: its states, where they are on it, and how one is looked for.
module gapbeam_falling_way
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_compression, least_share
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged
    use gapbeam_law, only: both
    use gapbeam_ground, only: ground_type, full_contact
    use gapbeam_moved_ground, only: under_loads
    use gapbeam_filled_ground, only: fill_valleys
    use gapbeam_contact_state, only: outcome_type, is_solved
    use gapbeam_refined, only: detail_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_ground_solver, only: solve_on_ground
    implicit none
    private
    public :: way_type, stop_type, stop_at, rests_at_zero, take_rest, place_on, begins, is_near_enough
    public :: solve_near, solve_afresh, solve_filled

    !> A state on the way, and where it is: the share of the dead loads, and the load factor
    type :: stop_type
        real(wp) :: dead = 0.0_wp, factor = 0.0_wp
        type(ground_start_type) :: state
        !> Of the nodes, shape (0:n), and of the supports
        real(wp), allocatable :: deflection(:), reaction(:)
    end type stop_type

    !> The way to a load factor
    type :: way_type
        type(ground_type) :: ground
        type(detail_type) :: detail
        real(wp) :: factor = 0.0_wp
        integer :: rule = 0
        !> Where it begins, the last state so far and one before that
        type(stop_type) :: from, last, earlier
        !> How far the last one is: 0 to 1 while the dead loads grow, 1 to 2 while the load factor does; and the next step
        real(wp) :: at = 0.0_wp, step = 1.0_wp
        integer :: solves = 0
    end type way_type

contains

    !> Take a state on the way
    pure subroutine stop_at(ground, solution, closed, stop)
        type(ground_type), intent(in) :: ground
        type(ground_solution_type), intent(in) :: solution
        logical, intent(in) :: closed(:)
        !> With its place in
        type(stop_type), intent(inout) :: stop

        call start_from(solution, closed, stop%state)
        if (.not. allocated(stop%deflection)) allocate (stop%deflection(0:size(ground%pieces)), stop%reaction(size(closed)))
        stop%deflection(:) = solution%deflection(0:size(ground%pieces))
        stop%reaction(:) = solution%reaction
    end subroutine stop_at

    !> Does nothing press anything while the beam is where it is drawn
    pure function rests_at_zero(ground) result(it_does)
        type(ground_type), intent(in) :: ground
        logical :: it_does
        type(ground_type) :: rest

        rest = under_loads(ground, 0.0_wp, 0.0_wp)
        associate (layers => rest%layers, supports => rest%beam%supports)
            it_does = all(merge(abs(layers%contact_a), -layers%side*layers%contact_a, layers%side == 0) <= 0.0_wp) &
                .and. all(merge(abs(layers%contact_b), -layers%side*layers%contact_b, layers%side == 0) <= 0.0_wp) &
                .and. all(merge(abs(supports%contact), -supports%side*supports%contact, supports%side == both) <= 0.0_wp) &
                .and. all(supports%breakpoint == 0)
        end associate
    end function rests_at_zero

    !> The beam there: what it touches acts, without force
    pure subroutine take_rest(ground, rest)
        type(ground_type), intent(in) :: ground
        type(stop_type), intent(inout) :: rest
        integer :: i, k

        associate (supports => ground%beam%supports, state => rest%state)
            allocate (state%closed(size(supports)), source=.not. abs(supports%contact) > 0.0_wp)
            allocate (rest%deflection(0:size(ground%pieces)), rest%reaction(size(supports)), source=0.0_wp)
            call full_contact(ground, state%zones)
            state%zones%start(:, :) = 0.0_wp
            do i = 1, size(state%zones%piece)
                associate (j => state%zones%piece(i))
                    do k = ground%first(j), ground%first(j + 1) - 1
                        associate (layer => ground%layers(k), acts => state%zones%acts(k - ground%first(j) + 1, i))
                            if (max(abs(layer%contact_a), abs(layer%contact_b)) > 0.0_wp) acts = 0
                        end associate
                    end do
                end associate
            end do
        end associate
    end subroutine take_rest

    !> A place on a way
    pure function place_on(way, at) result(place)
        type(way_type), intent(in) :: way
        !> As for way_type
        real(wp), intent(in) :: at
        type(stop_type) :: place

        place%dead = min(1.0_wp, at)
        place%factor = way%from%factor
        if (at > 1.0_wp) place%factor = way%from%factor + (at - 1)*(way%factor - way%from%factor)
        if (at >= 2.0_wp) place%factor = way%factor
    end function place_on

    !> Have no loads been added yet, or but the dead ones
    pure function begins(way) result(it_does)
        type(way_type), intent(in) :: way
        logical :: it_does

        it_does = .not. way%at > way%from%dead .or. .not. abs(way%at - 1) > 0.0_wp
    end function begins

    !> Would another step change the loads by rounding only
    pure function is_near_enough(way) result(it_is)
        type(way_type), intent(in) :: way
        logical :: it_is

        it_is = way%step <= same_compression*max(way%at - way%from%dead, least_share)
        if (way%at >= 1.0_wp) it_is = it_is .or. way%step*abs(way%factor - way%from%factor) <= same_compression*abs(way%last%factor)
    end function is_near_enough

    !> Look for a state near another one
    subroutine solve_near(way, dead, factor, state, closed, solution, outcome, error)
        type(way_type), intent(inout) :: way
        !> Share of the dead loads, load factor
        real(wp), intent(in) :: dead, factor
        type(ground_start_type), intent(in) :: state
        !> As for solve_on_ground
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error

        closed(:) = state%closed
        call solve_on_ground(under_loads(way%ground, dead, factor), way%detail, factor, way%rule, closed, solution, outcome, &
                             error, state, only_near=.true.)
        call count_solves(way, solution)
    end subroutine solve_near

    !> The same near the one on ground that never falls
    subroutine solve_afresh(way, next, closed, solution, outcome, error)
        type(way_type), intent(inout) :: way
        !> Where
        type(stop_type), intent(in) :: next
        !> As for solve_on_ground; not converged where there is none near that one
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type) :: state

        closed(:) = way%from%state%closed
        call solve_filled(way, next, closed, solution, outcome, error)
        if (.not. is_solved(outcome, error)) return
        call start_from(solution, closed, state)
        call solve_near(way, next%dead, next%factor, state, closed, solution, outcome, error)
        if (.not. allocated(error) .and. outcome%status /= gapbeam_solved) outcome%status = gapbeam_not_converged
    end subroutine solve_afresh

    !> The state on ground that never falls
    subroutine solve_filled(way, next, closed, solution, outcome, error)
        type(way_type), intent(inout) :: way
        !> Where
        type(stop_type), intent(in) :: next
        !> As for solve_on_ground
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_type) :: filled

        filled = under_loads(way%ground, next%dead, next%factor)
        call fill_valleys(filled)
        call solve_on_ground(filled, way%detail, next%factor, way%rule, closed, solution, outcome, error)
        call count_solves(way, solution)
    end subroutine solve_filled

    !> Linear solves so far
    pure subroutine count_solves(way, solution)
        type(way_type), intent(inout) :: way
        type(ground_solution_type), intent(inout) :: solution

        way%solves = way%solves + solution%solves
        solution%solves = way%solves
        solution%unique = .false.
    end subroutine count_solves

end module gapbeam_falling_way
