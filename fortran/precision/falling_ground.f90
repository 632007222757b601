!> Beams on ground whose force falls: the state that is reached as the loads grow.
!>
!> Dead loads grow first, then the others (gapbeam_full_load). From a state to the next one the energy has to be convex between
!> the two (gapbeam_uniqueness), or less of the loads is added: so no state is gone beyond at which the beam jumps. Where next to
!> nothing can be added any more the ground gives way; states farther away are not looked for.
module gapbeam_falling_ground
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_states_of_load, most_fresh_starts
    use gapbeam_tolerances, only: least_share, little_compression
    use gapbeam_words, only: shown
    use gapbeam_error, only: error_type, fatal_error, has_ended, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_not_converged, &
        gapbeam_bad_input
    use gapbeam_piece, only: is_compressed
    use gapbeam_law_margins, only: let_go
    use gapbeam_layers, only: pieces_of_law, has_curves
    use gapbeam_ground_laws, only: line_of_breakpoint
    use gapbeam_ground, only: ground_type, grounded_type
    use gapbeam_moved_ground, only: under_loads
    use gapbeam_filled_ground, only: peak_of
    use gapbeam_uniqueness, only: is_unique, is_one_branch, weakest_piece
    use gapbeam_workspace, only: workspace_type
    use gapbeam_modes, only: by_axial_force, count_modes
    use gapbeam_contact_state, only: outcome_type, is_solved
    use gapbeam_refined, only: detail_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_ground_solver, only: solve_on_ground
    use gapbeam_falling_way, only: way_type, stop_type, stop_at, rests_at_zero, take_rest, place_on, begins, is_near_enough, &
        solve_near, solve_afresh, solve_filled
    implicit none
    private
    public :: solve_on_falling_ground

    !> Share by which ground is tried to fall more steeply at the last state, which has few digits where it falls slowly; tuned
    real(wp), parameter :: little_fall = 2.0_wp**(-9)

contains

    !> Solve at a load factor
    subroutine solve_on_falling_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
        !> As for solve_on_ground
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        !> Solved, or no equilibrium with the motion; the solution says then at which share of the load factor
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type), intent(in), optional :: near
        type(way_type) :: way
        type(ground_start_type) :: found

        if (any(is_compressed(ground%pieces))) then
            call fatal_error(error, gapbeam_bad_input, "on ground whose force falls a beam is not compressed in this version; "// &
                             "leave out the axial force, or give a law that never falls")
            return
        end if
        if (any(has_curves(ground%layers))) then
            call fatal_error(error, gapbeam_bad_input, "beside ground whose force falls no ground acts by curves in this "// &
                             "version; give polylines, of one that falls with the same displacements at every place")
            return
        end if
        if (is_unique(ground)) then
            call solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
            return
        end if
        way%ground = ground
        way%detail = detail
        way%factor = factor
        way%rule = rule
        if (present(near)) then
            call solve_near(way, 1.0_wp, factor, near, closed, solution, outcome, error)
            if (is_solved(outcome, error)) then
                call start_from(solution, closed, found)
                if (is_one_branch(ground, near, found, factor)) return
            end if
            if (has_ended(error)) return
            call solve_near(way, 1.0_wp, near%factor, near, closed, solution, outcome, error)
            if (has_ended(error)) return
            if (is_solved(outcome, error)) then
                way%from%dead = 1.0_wp
                way%from%factor = near%factor
                call stop_at(ground, solution, closed, way%from)
            end if
        end if
        if (way%from%dead < 1.0_wp) call begin_at_rest(way, closed, solution, outcome, error)
        if (.not. is_solved(outcome, error)) return
        call follow_loads(way, closed, solution, outcome, error)
    end subroutine solve_on_falling_ground

    !> The state without loads, in which no ground may have been pressed so far that its force has fallen
    subroutine begin_at_rest(way, closed, solution, outcome, error)
        type(way_type), intent(inout) :: way
        !> As for solve_on_ground
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(stop_type) :: rest
        integer :: i, k

        if (rests_at_zero(way%ground)) then
            call take_rest(way%ground, way%from)
            outcome = outcome_type(status=gapbeam_solved)
            return
        end if
        call solve_filled(way, rest, closed, solution, outcome, error)
        if (allocated(error)) return
        if (outcome%status /= gapbeam_solved) then
            call fatal_error(error, gapbeam_bad_input, "without loads the beam is not in equilibrium with what gaps and "// &
                             "settlements press on ground whose force falls, and nothing tells how it came there; give others, "// &
                             "or a law that never falls")
            return
        end if
        do i = 1, size(solution%piece)
            associate (first => way%ground%first(solution%piece(i)))
                do k = first, way%ground%first(solution%piece(i) + 1) - 1
                    if (solution%acts(k - first + 1, i) < peak_of(way%ground, k)) cycle
                    call fatal_error(error, gapbeam_bad_input, "gaps and settlements alone press the ground so far that its "// &
                                     "force falls, and nothing tells on which way; give smaller ones, or a law that never falls")
                    return
                end do
            end associate
        end do
        call stop_at(way%ground, solution, closed, way%from)
    end subroutine begin_at_rest

    !> Let the loads grow from where a way begins
    subroutine follow_loads(way, closed, solution, outcome, error)
        type(way_type), intent(inout) :: way
        !> As for solve_on_falling_ground
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(stop_type) :: next
        integer :: number, fresh_starts
        logical :: grows

        way%last = way%from
        way%earlier = way%from
        way%at = way%from%dead
        fresh_starts = 0
        do number = 1, most_states_of_load
            next = place_on(way, way%at + way%step)
            call solve_near(way, next%dead, next%factor, way%last%state, closed, solution, outcome, error)
            if (has_ended(error)) return
            grows = goes_on()
            if (.not. grows .and. fresh_starts < most_fresh_starts .and. (begins(way) .or. way%step <= least_share)) then
                ! A beam that only touches may come to lie on quite other places under the least load
                fresh_starts = fresh_starts + 1
                call solve_afresh(way, next, closed, solution, outcome, error)
                if (has_ended(error)) return
                if (.not. (allocated(error) .or. way%at + way%step > 1.0_wp)) then
                    if (outcome%status == gapbeam_no_equilibrium) return
                end if
                grows = goes_on()
            end if
            if (grows) then
                if (way%at + way%step >= 2.0_wp) return
                if (way%step > least_share) way%earlier = way%last
                way%at = way%at + way%step
                way%last = next
                way%step = min(2*way%step, merge(1 - way%at, 2 - way%at, way%at < 1.0_wp))
                fresh_starts = 0
            else
                if (allocated(error)) deallocate (error)
                way%step = way%step/2
                if (is_near_enough(way)) exit
            end if
        end do
        if (number <= most_states_of_load .and. is_at_end(way%ground, way%last)) then
            call give_way(way, solution, outcome)
            return
        end if
        ! What is too much for ground that never falls is too much for this one
        call solve_filled(way, place_on(way, merge(1.0_wp, 2.0_wp, way%at < 1.0_wp)), closed, solution, outcome, error)
        if (has_ended(error)) return
        if (.not. allocated(error) .and. outcome%status /= gapbeam_solved) return
        call fatal_error(error, gapbeam_not_converged, "the beam could not be followed beyond load factor "// &
                         trim(shown(way%last%factor))//", where it is still stable: look for supports or ground far stiffer "// &
                         "than it")

    contains

        !> Was a state found that the last one grows into
        function goes_on() result(it_does)
            logical :: it_does

            it_does = is_solved(outcome, error)
            if (.not. it_does) return
            call stop_at(way%ground, solution, closed, next)
            it_does = is_one_branch(under_loads(way%ground, next%dead, next%factor), way%last%state, next%state, next%factor)
        end function goes_on

    end subroutine follow_loads

    !> The end of the states that the loads lead to
    pure subroutine give_way(way, solution, outcome)
        type(way_type), intent(in) :: way
        !> With the share of the load factor that was reached
        type(ground_solution_type), intent(inout) :: solution
        type(outcome_type), intent(out) :: outcome
        real(wp) :: most

        solution%axial_share = 0.0_wp
        if (abs(way%factor) > 0.0_wp) solution%axial_share = way%last%factor/way%factor
        outcome = outcome_type(status=gapbeam_no_equilibrium)
        allocate (outcome%motion(0:size(way%ground%pieces)), source=way%last%deflection - way%earlier%deflection)
        most = maxval(abs(outcome%motion))
        if (most > 0.0_wp) outcome%motion(:) = outcome%motion/most
    end subroutine give_way

    !> Does ground that falls a little more steeply, and everywhere where it all but does, or the loss of supports that hardly carry
    !> any more, let the beam give way
    function is_at_end(ground, last) result(it_is)
        type(ground_type), intent(in) :: ground
        type(stop_type), intent(in) :: last
        logical :: it_is
        type(ground_type) :: steeper
        type(ground_start_type) :: state
        type(workspace_type) :: work
        type(grounded_type) :: grounded
        integer :: number, trial

        steeper = under_loads(ground, last%dead, last%factor)
        where (steeper%laws%slope_a < 0.0_wp) steeper%laws%slope_a = (1 + little_fall)*steeper%laws%slope_a
        where (steeper%laws%slope_b < 0.0_wp) steeper%laws%slope_b = (1 + little_fall)*steeper%laws%slope_b
        state = last%state
        call go_beyond_peaks(ground, last, state)
        do trial = 1, 2
            call count_modes(steeper, state%zones, state%closed, by_axial_force, 1.0_wp, number, work, grounded, factor=last%factor)
            it_is = number > 0
            if (it_is) return
            call let_go(ground%beam%supports, last%deflection, last%reaction, &
                        little_compression*maxval(abs(last%reaction)), state%closed)
        end do
    end function is_at_end

    !> Let layers act on the next piece of their law where that begins so near that rounding decides
    pure subroutine go_beyond_peaks(ground, last, state)
        type(ground_type), intent(in) :: ground
        type(stop_type), intent(in) :: last
        type(ground_start_type), intent(inout) :: state
        real(wp) :: level, length
        integer :: i, k

        do i = 1, size(state%zones%piece)
            associate (j => state%zones%piece(i), z => state%zones)
                length = ground%pieces(j)%length
                do k = ground%first(j), ground%first(j + 1) - 1
                    associate (acts => z%acts(k - ground%first(j) + 1, i), layer => ground%layers(k))
                        if (acts == 0 .or. acts >= pieces_of_law(layer)) cycle
                        level = line_of_breakpoint(ground%laws, layer, acts + 1, z%from(i), length)
                        if (abs(z%start(1, i) - level) > little_compression*maxval(abs(last%deflection))) cycle
                        acts = weakest_piece(layer, ground%laws, acts, acts + 1)
                    end associate
                end do
            end associate
        end do
    end subroutine go_beyond_peaks

end module gapbeam_falling_ground
