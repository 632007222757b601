!> Beams with hinges on ground: parts that no load keeps on it.
!>
!> Ground holds a beam as supports at the ends of its pieces do: between hinges a beam that moves freely presses on a piece only
!> if it does at an end of it. Where the loads do no work along a motion that presses on nothing, ground that it leaves carries
!> nothing in any equilibrium, and without that ground the beam is in the same one. A part that turns about a place where the
!> beam is pressed into ground that the part leaves then turns without end: the ground would push it as long as it touches.
module gapbeam_ground_mechanism
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: no_displacement
    use gapbeam_error, only: error_type, has_ended, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_not_converged
    use gapbeam_nodes, only: hinge
    use gapbeam_link, only: piece_load_type
    use gapbeam_layers, only: has_limit
    use gapbeam_ground_laws, only: line_of_breakpoint
    use gapbeam_ground, only: ground_type
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_refined, only: detail_type
    use gapbeam_refined_ground, only: refine_ground, refine_links
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_model_quad, only: beam_type, node_support_type, order_supports, softest
    use gapbeam_workspace_quad, only: workspace_type, new_workspace, set_loads
    use gapbeam_search_quad, only: rule_block
    use gapbeam_contact_state_quad, only: find_contact_state, fine_outcome_type => outcome_type
    use gapbeam_kinematics_quad, only: free_motions, motion_type
    use gapbeam_law_kinematics_quad, only: leaves_all
    use gapbeam_undecided, only: find_undecided
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_ground_solver, only: solve_on_ground
    use gapbeam_less_load, only: solve_from_more_load
    implicit none
    private
    public :: solve_or_refute

contains

    !> Solve at a load factor, but where a part turns without end. That is asked first where a part has no load, else where zones
    !> could not be settled
    subroutine solve_or_refute(ground, detail, factor, rule, closed, solution, outcome, error, near)
        !> As for solve_on_ground
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type), intent(in), optional :: near
        type(error_type), allocatable :: another
        logical :: start(size(closed)), fit, first, refuted

        start(:) = closed
        fit = is_fit(ground)
        first = fit .and. has_part_without_load(ground)
        if (first) then
            call refute(ground, detail, factor, rule, start, outcome, refuted, error)
            if (refuted .or. allocated(error)) return
        end if
        call solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
        if (.not. allocated(error)) return
        if (error%code /= gapbeam_not_converged) return
        if (fit .and. .not. first) then
            call refute(ground, detail, factor, rule, start, outcome, refuted, another)
            if (refuted) deallocate (error)
            if (allocated(another)) call move_alloc(another, error)
            if (.not. allocated(error)) return
            if (has_ended(error)) return
        end if
        ! Beside a state that is known there is nothing farther away to come from
        if (present(near) .or. any(ground%layers%rigid)) return
        closed(:) = start
        call solve_from_more_load(ground, detail, factor, rule, closed, solution, outcome, error)
    end subroutine solve_or_refute

    !> Is there a part that turns without end: solved without the ground that carries nothing
    subroutine refute(ground, detail, factor, rule, start, outcome, refuted, error)
        !> As for solve_on_ground
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Where the search for supports starts
        logical, intent(in) :: start(:)
        !> No equilibrium, with the motion, if it is refuted
        type(outcome_type), intent(inout) :: outcome
        logical, intent(out) :: refuted
        !> Ended by memory or from outside
        type(error_type), allocatable, intent(out) :: error
        type(ground_solution_type) :: without
        type(outcome_type) :: found
        real(wp), allocatable :: motion(:)
        logical :: idle(size(ground%layers)), closed(size(start))

        refuted = .false.
        call find_idle_ground(ground, detail, factor, motion, idle)
        if (.not. any(idle)) return
        closed(:) = start
        call solve_on_ground(without_layers(ground, idle), detail, factor, rule, closed, without, found, error)
        if (has_ended(error)) return
        if (allocated(error)) then
            deallocate (error)
            return
        end if
        refuted = found%status == gapbeam_no_equilibrium
        if (found%status == gapbeam_solved) refuted = turns_into(ground, idle, motion, without%deflection(0:size(ground%pieces)))
        if (.not. refuted) return
        outcome = outcome_type(status=gapbeam_no_equilibrium)
        call move_alloc(motion, outcome%motion)
    end subroutine refute

    !> Is there a part between hinges on which nothing acts, but at these
    pure function has_part_without_load(ground) result(has)
        type(ground_type), intent(in) :: ground
        logical :: has
        logical :: loaded
        integer :: j

        has = .false.
        loaded = acts_at(0)
        do j = 1, size(ground%pieces)
            loaded = loaded .or. acts_on(ground%dead(j)) .or. acts_on(ground%live(j))
            if (ground%beam%kind(j) == hinge .or. j == size(ground%pieces)) then
                if (j == size(ground%pieces)) loaded = loaded .or. acts_at(j)
                has = has .or. .not. loaded
                loaded = .false.
            else
                loaded = loaded .or. acts_at(j)
            end if
        end do

    contains

        !> Are there a force or a couple at a node
        pure function acts_at(node)
            integer, intent(in) :: node
            logical :: acts_at

            acts_at = any(abs(ground%beam%force(:, node)) > 0.0_wp) .or. any(abs(ground%beam%couple(:, node)) > 0.0_wp)
        end function acts_at

        !> Is there any load on a piece
        pure function acts_on(load)
            type(piece_load_type), intent(in) :: load
            logical :: acts_on

            acts_on = any(abs([load%qa, load%qb, load%force, load%couple, load%couple_a, load%couple_b]) > 0.0_wp)
        end function acts_on

    end function has_part_without_load

    !> Does ground by forces without limit, and nothing else but simple supports, hold a beam with hinges
    pure function is_fit(ground) result(fit)
        type(ground_type), intent(in) :: ground
        logical :: fit
        integer :: k

        fit = any(ground%beam%kind == hinge) .and. .not. allocated(ground%beam%turning) .and. .not. any(ground%layers%rigid) &
            .and. all(ground%beam%supports%breakpoint == 0)
        if (fit) fit = .not. any(max(abs(ground%pieces%tension), abs(ground%pieces%tension_change)) > 0.0_wp)
        do k = 1, size(ground%layers)
            fit = fit .and. .not. has_limit(ground%layers(k), ground%laws)
        end do
    end function is_fit

    !> Look for a motion along which the loads do no work, and that presses on nothing, and for the ground that it leaves
    subroutine find_idle_ground(ground, detail, factor, motion, idle)
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        !> Downward displacements of the nodes of the beam without ground, shape (0:n)
        real(wp), allocatable, intent(out) :: motion(:)
        !> Of the layers
        logical, intent(out) :: idle(:)
        type(fine_ground_type) :: fine
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(fine_outcome_type) :: outcome
        type(error_type), allocatable :: error
        type(motion_type), allocatable :: motions(:)
        logical, allocatable :: closed(:), undecided(:)
        real(qp) :: moved(0:size(ground%pieces)), total(0:size(ground%pieces))
        logical :: may(-1:1)
        integer :: j, k, m

        idle(:) = .false.
        call refine_ground(ground, fine)
        call refine_links(detail, fine)
        beam = fine%beam
        call order_supports(supports_instead(fine), beam)
        allocate (closed(size(beam%supports)), source=.true.)
        allocate (undecided(size(closed)), motion(0:size(ground%pieces)))
        call new_workspace(beam, work)
        call set_loads(beam, real(factor, qp), work)
        call find_contact_state(beam, real(factor, qp), rule_block, closed, work, outcome, error)
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        call find_undecided(beam, real(factor, qp), closed, work, undecided)
        call free_motions(beam, closed .and. .not. undecided, motions)
        total(:) = 0.0_qp
        do m = 1, size(motions)
            moved(:) = 0.0_qp
            moved(motions(m)%first:motions(m)%last) = motions(m)%displacement
            where (abs(moved) <= no_displacement) moved = 0.0_qp
            may(-1) = leaves_all(beam%supports, beam%supports%side /= 0, moved, -1)
            may(1) = leaves_all(beam%supports, beam%supports%side /= 0, moved, 1)
            ! What may go both ways leaves nothing
            if (may(-1) .neqv. may(1)) total = total + merge(1, -1, may(1))*moved
        end do
        motion(:) = real(total, wp)
        do j = 1, size(ground%pieces)
            do k = ground%first(j), ground%first(j + 1) - 1
                idle(k) = any(ground%layers(k)%side*motion(j - 1:j) < 0.0_wp)
            end do
        end do
    end subroutine find_idle_ground

    !> The supports of a beam, and one for each layer at both ends of every piece, all without gaps
    pure function supports_instead(fine) result(supports)
        type(fine_ground_type), intent(in) :: fine
        type(node_support_type), allocatable :: supports(:)
        integer :: j, k, m

        allocate (supports(size(fine%beam%supports) + 2*size(fine%layers)))
        m = size(fine%beam%supports)
        supports(:m) = fine%beam%supports
        supports(:m)%contact = 0.0_qp
        do j = 1, size(fine%pieces)
            do k = fine%first(j), fine%first(j + 1) - 1
                supports(m + 1:m + 2) = node_support_type(j, fine%layers(k)%side, softest(fine%beam), 0.0_qp)
                supports(m + 1)%node = j - 1
                m = m + 2
            end do
        end do
    end function supports_instead

    !> Ground without some of its layers
    pure function without_layers(ground, idle) result(left)
        type(ground_type), intent(in) :: ground
        logical, intent(in) :: idle(:)
        type(ground_type) :: left
        integer :: j

        left = ground
        left%layers = pack(ground%layers, .not. idle)
        do j = 1, size(ground%first)
            left%first(j) = 1 + count(.not. idle(:ground%first(j) - 1))
        end do
    end function without_layers

    !> Does a part turn about a place where the beam is pressed into ground that the part leaves
    pure function turns_into(ground, idle, motion, deflection) result(turns)
        type(ground_type), intent(in) :: ground
        logical, intent(in) :: idle(:)
        !> Of the nodes, shape (0:n)
        real(wp), intent(in) :: motion(0:), deflection(0:)
        logical :: turns
        real(wp) :: level(2), rounding
        integer :: i, j, k

        turns = .false.
        do j = 1, size(ground%pieces)
            do k = ground%first(j), ground%first(j + 1) - 1
                if (.not. idle(k)) cycle
                associate (layer => ground%layers(k), length => ground%pieces(j)%length)
                    level(1) = line_of_breakpoint(ground%laws, layer, 1, 0.0_wp, length)
                    level(2) = line_of_breakpoint(ground%laws, layer, 1, length, length)
                    rounding = 64*epsilon(1.0_wp)*max(maxval(abs(level)), maxval(abs(deflection(j - 1:j))))
                    do i = 1, 2
                        if (abs(motion(j - 2 + i)) > 0.0_wp) cycle
                        turns = turns .or. layer%side*(deflection(j - 2 + i) - level(i)) > rounding
                    end do
                end associate
            end do
        end do
    end function turns_into

end module gapbeam_ground_mechanism
