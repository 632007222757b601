!> Solver of a beam on the ground: zones in double precision, then all in quadruple precision.
!>
!> So ends, fields and reactions have all digits that doubles hold, and what doubles found is nothing but a start. Whether there is
!> an equilibrium at all, and where zones are if Newton's method does not find them or laws are curves, the least energy on a mesh
!> tells (gapbeam_ground_energy); that loads are more than the ground can bear is proved by limit analysis (gapbeam_ground_limit).
module gapbeam_ground_solver
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: last_try, last_if_tied, most_edge_nodes, most_stiffer
    use gapbeam_tolerances, only: movement_safety, nearly_settled, fine_ends, movable_ends, no_displacement, rough
    use gapbeam_error, only: error_type, fatal_error, out_of_range, has_ended, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_not_converged, gapbeam_not_finite, gapbeam_indeterminate
    use gapbeam_foundation, only: stretch_ends_type
    use gapbeam_memory, only: reserve_memory, for_solving, for_ground
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, full_contact
    use gapbeam_zones, only: settle_zones
    use gapbeam_zone_fields, only: rough_ends_of => ends_of, rough_fields_at_ends => fields_at_ends
    use gapbeam_ground_mesh, only: mesh_type, begin_mesh, refine_mesh
    use gapbeam_mesh_zones, only: zones_of_mesh
    use gapbeam_ground_energy, only: find_least_energy
    use gapbeam_workspace, only: workspace_type
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_law, only: both
    use gapbeam_law_kinematics, only: is_blocked
    use gapbeam_model, only: last_place
    use gapbeam_turning, only: turn_with
    use gapbeam_filled_ground, only: any_falls
    use gapbeam_refined, only: detail_type
    use gapbeam_refined_ground, only: refine_ground, refine_links, refine_zones
    use gapbeam_layers_quad, only: has_curves
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, &
        fine_grounded_type => grounded_type
    use gapbeam_zones_quad, only: settle_fine_zones => settle_zones, polish_zones
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_contact_state_quad, only: fine_outcome_type => outcome_type
    use gapbeam_ground_solution, only: ground_solution_type, take_rounded
    use gapbeam_ground_fields, only: largest_inside
    use gapbeam_rigid_solver, only: solve_on_rigid_ground
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_ground_ties, only: stands_on_edge, may_move, presses_ground, least_force, come_to_rest
    use gapbeam_ground_limit, only: find_collapse
    implicit none
    private
    public :: ground_solution_type, solve_on_ground

contains

    !> Solve at a load factor
    subroutine solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near, only_near)
        !> The beam and its ground, moved to where they are at the load factor
        type(ground_type), intent(in) :: ground
        !> What its links are made of
        type(detail_type), intent(in) :: detail
        !> Factor of the live loads, and rule for the supports
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        !> What was found
        type(ground_solution_type), intent(out) :: solution
        !> Solved, or no equilibrium with the motion of the nodes
        type(outcome_type), intent(out) :: outcome
        !> Not settled, not finite, no memory
        type(error_type), allocatable, intent(out) :: error
        !> Where to begin, if something is known of it, and whether no other state is wanted: no equilibrium then is none near there
        type(ground_start_type), intent(in), optional :: near
        logical, intent(in), optional :: only_near
        type(zones_type) :: zones
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        type(fine_ground_type) :: fine
        logical, allocatable :: start(:)
        type(mesh_type) :: mesh
        logical :: ends, on_edge, collapses, tied, stands, weighed
        real(wp), allocatable :: motion(:), edge_motion(:)
        integer :: try, first, last, pressed, edges, tries

        call reserve_memory(for_ground, size(ground%pieces), size(closed), 0, error)
        if (allocated(error)) return
        allocate (start, source=closed)
        call refine_ground(ground, fine)
        if (any(ground%layers%rigid)) then
            call solve_on_rigid_ground(ground, fine, factor, rule, closed, grounded, work, solution, outcome, error)
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            call bound_errors(ground, grounded, work, factor, solution)
            return
        end if
        if (present(near)) then
            closed(:) = near%closed
            zones = near%zones
            call settle(.true., ends)
            if (allocated(error)) then
                if (has_ended(error)) return
                deallocate (error)
            else if (ends) then
                return
            end if
            if (present(only_near)) then
                outcome = outcome_type(status=gapbeam_no_equilibrium)
                if (only_near) return
            end if
            closed(:) = start
            if (allocated(edge_motion)) deallocate (edge_motion)
        end if
        edges = 0
        tries = 0
        call full_contact(ground, zones)
        on_edge = .false.
        collapses = .false.
        ! Limit analysis is for forces that never fall
        weighed = any_falls(ground)
        stands = .false.
        first = merge(1, 0, any(has_curves(fine%layers)))
        last = last_try
        do try = first, last_try
            if (try > last) exit
            if (try > 0) then
                closed(:) = start
                if (allocated(error)) deallocate (error)
                ! What Newton's method does not find from full contact may be too much to be borne
                if (first == 0 .or. try > 1) call weigh()
                if (.not. allocated(error)) call solve_on_mesh()
                if (has_ended(error)) return
                if (allocated(error) .or. outcome%status /= gapbeam_solved) call weigh()
                if (collapses) then
                    if (allocated(error)) deallocate (error)
                    outcome = outcome_type(status=gapbeam_no_equilibrium)
                    call move_alloc(motion, outcome%motion)
                    return
                end if
                if (allocated(error)) then
                    ! A finer mesh may tell
                    if (try < last) cycle
                    ! Nor does any where it turns without end
                    if (tries == 0 .or. edges < tries) return
                    deallocate (error)
                    exit
                end if
                if (outcome%status /= gapbeam_solved) then
                    ! A mesh is not the ground where next to no load more would be too much
                    if (stands .and. try < last) cycle
                    if (.not. stands) return
                    exit
                end if
                on_edge = pressed <= most_edge_nodes .and. pressed > 0
                if (on_edge) call weigh()
                if (on_edge .and. tips_over()) then
                    ! Zones as short as that show on a finer mesh, or not at all
                    if (try < last) cycle
                    outcome = outcome_type(status=gapbeam_no_equilibrium)
                    call move_alloc(motion, outcome%motion)
                    return
                end if
                call zones_of_mesh(ground, mesh, zones)
            end if
            call settle(try == 0, ends)
            if (ends) return
        end do
        if (allocated(error)) return
        ! From whatever zones it began, a part of the beam came to stand on an edge; the others may lie on the ground
        if (tries > 0 .and. edges == tries) then
            on_edge = .true.
            outcome = outcome_type(status=gapbeam_no_equilibrium)
            call move_alloc(edge_motion, outcome%motion)
        end if
        if (on_edge .and. outcome%status == gapbeam_no_equilibrium) then
            ! The last node alone holds what no zone can, however short: the beam tips over the edge of the ground
            if (size(outcome%motion) /= size(grounded%node)) then
                allocate (motion(0:size(ground%pieces)), source=outcome%motion(grounded%node))
                call move_alloc(motion, outcome%motion)
            end if
            outcome%motion(:) = merge(0.0_wp, outcome%motion, abs(outcome%motion) <= no_displacement)
            ! No support would stop it sooner or later, nor ground
            if (.not. (is_stopped_by(outcome%motion) .or. presses_ground(fine, outcome%motion))) return
        end if
        call fatal_error(error, gapbeam_not_converged, "the zones in which the beam touches the ground could not be settled: "// &
                         "look for a load at the very end of the ground, or for ground that is far stiffer than the beam")

    contains

        !> Settle the zones at hand in double and then in quadruple precision
        subroutine settle(only_near_by, ends)
            !> Are zones that double precision has not come near to not worth while in quadruple precision
            logical, intent(in) :: only_near_by
            !> Is that all: a solution, or an error with which other zones would end too
            logical, intent(out) :: ends
            logical :: settled, known, stands_there
            real(wp) :: moved

            ends = .false.
            tries = tries + 1
            call settle_zones(ground, factor, rule, rough, zones, closed, grounded, work, outcome, known, moved, error)
            solution%solves = solution%solves + work%solves
            if (allocated(error)) then
                ! Supports that hold both ways are as many on any zones
                ends = has_ended(error) &
                    .or. error%code == gapbeam_indeterminate .and. all(ground%beam%supports%side == both)
                return
            end if
            if (outcome%status /= gapbeam_solved) return
            ! Where it all but touches, only quadruple precision tells where
            if (.not. known .and. only_near_by .and. moved > nearly_settled) return
            call settle_finely(fine, real(factor, qp), rule, zones, known, closed, solution, outcome, settled, stands_there, error)
            if (stands_there) then
                edges = edges + 1
                edge_motion = outcome%motion
            end if
            if (allocated(error)) then
                ! A mesh may tell that there is no equilibrium
                ends = all(error%code /= [gapbeam_not_converged, gapbeam_not_finite])
                return
            end if
            if (.not. settled) return
            call bound_errors(ground, grounded, work, factor, solution)
            ends = .true.
        end subroutine settle

        !> Find out once whether the loads are more than the ground can bear
        subroutine weigh()
            if (weighed) return
            weighed = .true.
            call refine_links(detail, fine)
            call find_collapse(fine, real(factor, qp), collapses, tied, stands, motion)
            ! What the last digits of the data decide no finer mesh does
            if (tied) last = last_if_tied
        end subroutine weigh

        !> Is there a motion without work, off all ground but an edge that no mesh is fine enough for. Then along it neither the
        !> loads nor anything else does work, so nothing but what is at its pivot may carry: the beam tips over that
        function tips_over() result(tips)
            logical :: tips

            tips = .false.
            if (.not. allocated(motion)) return
            tips = .not. is_stopped_by(motion)
            associate (node => ground%beam%supports%node)
                if (tips) tips = .not. any(abs(motion(pack(node, node < size(motion)))) <= no_displacement)
            end associate
        end function tips_over

        !> Does some support stop a motion
        pure function is_stopped_by(motion) result(it_is)
            !> Of the nodes, shape (0:n)
            real(wp), intent(in) :: motion(0:)
            logical :: it_is
            real(wp) :: moved(0:last_place(ground%beam))

            moved(:) = 0.0_wp
            moved(0:ubound(motion, 1)) = motion
            call turn_with(ground%beam, moved)
            it_is = is_blocked(ground%beam%supports, moved)
        end function is_stopped_by

        !> Solve on the first mesh, or on one that is finer where zones end
        subroutine solve_on_mesh()
            logical :: refined, exhausted
            integer :: again, solves

            refined = .true.
            if (try == 1) then
                call begin_mesh(ground, mesh)
            else
                call refine_mesh(ground, mesh, .false., refined)
            end if
            do again = 1, most_stiffer
                call reserve_memory(for_solving, size(mesh%piece), size(closed) + size(mesh%piece), 0, error)
                if (allocated(error)) return
                call find_least_energy(ground, factor, mesh, closed, solves, pressed, exhausted, outcome, error)
                solution%solves = solution%solves + solves
                ! One more mesh, and no others
                if (exhausted) last = min(last, try + 1)
                if (allocated(error) .or. outcome%status /= gapbeam_solved) return
                call refine_mesh(ground, mesh, .true., refined)
                if (.not. refined) return
            end do
        end subroutine solve_on_mesh

    end subroutine solve_on_ground

    !> Go on in quadruple precision, and round what is found
    subroutine settle_finely(fine, factor, rule, rough_zones, known, closed, solution, outcome, settled, stands, error)
        type(fine_ground_type), intent(in) :: fine
        real(qp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Zones in double precision, and whether they are right but for their last digits
        type(zones_type), intent(in) :: rough_zones
        logical, intent(in) :: known
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(inout) :: solution
        type(outcome_type), intent(inout) :: outcome
        logical, intent(out) :: settled
        !> Does it stand on a zone of no length
        logical, intent(out) :: stands
        type(error_type), allocatable, intent(out) :: error
        type(fine_zones_type) :: zones
        type(fine_grounded_type) :: grounded
        type(fine_workspace_type) :: work
        type(fine_outcome_type) :: found
        real(qp) :: moved

        call refine_zones(fine, rough_zones, zones)
        settled = .false.
        stands = .false.
        if (known) then
            call polish_zones(fine, factor, rule, movable_ends, zones, closed, grounded, work, found, settled, error)
            solution%solves = solution%solves + work%solves
            if (allocated(error)) return
        end if
        if (.not. settled) then
            call settle_fine_zones(fine, factor, rule, fine_ends, zones, closed, grounded, work, found, settled, moved, error)
            solution%solves = solution%solves + work%solves
            if (allocated(error)) return
            settled = settled .or. moved <= movable_ends
            if (.not. settled) return
        end if
        call take_rounded(fine, factor, zones, grounded, closed, work, solution)
        outcome = outcome_type(status=found%status)
        call stands_on_edge(fine, factor, zones, grounded, closed, work, stands)
        settled = .not. stands
        if (stands) then
            ! So it tips over the edge
            outcome = outcome_type(status=gapbeam_no_equilibrium)
            allocate (outcome%motion(0:size(fine%pieces)))
            associate (w => solution%deflection(0:size(fine%pieces)))
                outcome%motion(:) = w/maxval(abs(w))
            end associate
            return
        end if
        solution%no_force = least_force(fine, factor, solution%resultant, work)
        call come_to_rest(fine, factor, solution)
        outcome%indifferent = found%indifferent
        if (.not. found%indifferent) outcome%indifferent = may_move(fine, zones, grounded, closed, solution)
        if (all(abs(solution%deflection) <= huge(1.0_wp)) .and. all(abs(solution%moment_left) <= huge(1.0_wp))) return
        call out_of_range(error)
    end subroutine settle_finely

    !> How good the solution is. It is rounded from quadruple precision; what its data lost when they were rounded to doubles moves
    !> it as much as double precision moved its own solution, some times over
    subroutine bound_errors(ground, grounded, work, factor, solution)
        type(ground_type), intent(in) :: ground
        !> The beam on its zones in double precision, and the solution there
        type(grounded_type), intent(in) :: grounded
        type(workspace_type), intent(in) :: work
        real(wp), intent(in) :: factor
        type(ground_solution_type), intent(inout) :: solution
        real(wp) :: before(4), right(4), largest(5)
        integer :: first, last, i, j, m

        largest(:) = 0.0_wp
        m = size(solution%piece)
        last = 0
        i = 0
        do j = 1, size(ground%pieces)
            first = last + 1
            last = grounded%node(j)
            i = i + 1
            right = [solution%ends(i)%w_a, solution%rotation(1, i), solution%ends(i)%moment_a, solution%shear(1, i)]
            call compare(first, .false.)
            do while (i < m)
                if (solution%piece(i + 1) /= j) exit
                i = i + 1
            end do
            right = [solution%ends(i)%w_b, solution%rotation(2, i), solution%ends(i)%moment_b, solution%shear(2, i)]
            call compare(last, .true.)
        end do
        do i = 1, m
            associate (most => largest_inside(solution, i))
                largest(:4) = max(largest(:4), [most%deflection, most%rotation, most%moment, most%shear])
            end associate
        end do
        if (size(solution%reaction) > 0) then
            solution%bounds(5) = maxval(abs(work%reaction(:size(solution%reaction)) - solution%reaction))
            largest(5) = maxval(abs(solution%reaction))
        end if
        solution%bounds(:) = movement_safety*(solution%bounds + epsilon(1.0_wp)*largest)

    contains

        !> Compare at an end of a stretch in double precision
        subroutine compare(stretch, at_right)
            integer, intent(in) :: stretch
            logical, intent(in) :: at_right
            type(stretch_ends_type) :: ends
            real(wp) :: rotation(2), shear(2)

            call rough_fields_at_ends(grounded, factor, work, stretch, rotation, shear)
            ends = rough_ends_of(grounded, factor, work, stretch)
            if (at_right) then
                before = [ends%w_b, rotation(2), ends%moment_b, shear(2)]
            else
                before = [ends%w_a, rotation(1), ends%moment_a, shear(1)]
            end if
            solution%bounds(:4) = max(solution%bounds(:4), abs(before - right))
        end subroutine compare

    end subroutine bound_errors

end module gapbeam_ground_solver
