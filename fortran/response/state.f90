!> The state of a beam at one load factor: solved, recovered and certified.
module gapbeam_state
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, no_memory, has_ended, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_buckles, gapbeam_not_converged
    use gapbeam_element, only: field_type
    use gapbeam_polyline, only: node_support_type, extend_pieces
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_recover, only: recover_beam
    use gapbeam_contact_state, only: outcome_type, is_solved
    use gapbeam_static_indeterminacy, only: refuse_indeterminate
    use gapbeam_extended_precision, only: rule_given, decide_scheme, detail_type, reserve_for
    use gapbeam_search, only: rule_block
    use gapbeam_ground, only: ground_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_axial_tension, only: check_tensions
    use gapbeam_compressed, only: solve_stable
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_ground_solver, only: ground_solution_type, solve_on_ground
    use gapbeam_ledger, only: ledger_type
    use gapbeam_ground_audit, only: audit_ground
    use gapbeam_certificate, only: certificate_type, certify
    use gapbeam_assembled_model, only: assembled_type, find_length_errors
    use gapbeam_solution, only: state_type, forget, check_range, check_room, has_own_laws, laws_in
    use gapbeam_along_axis, only: solve_along_axis, name_fault, name_range
    use gapbeam_stretching, only: stretching_type, lengthening, begin_stretching, bound_stretching, guess_stretching
    use gapbeam_memory, only: reserve_memory, for_solving, for_certifying, for_fields
    implicit none
    private
    public :: solve_state, recover_state, certify_state, detail_of

contains

    !> Solve at one load factor; the search starts from the scheme the state holds
    subroutine solve_state(assembled, factor, rule, state, error, near)
        type(assembled_type), intent(in), target :: assembled
        !> Factor of the live loads
        real(wp), intent(in) :: factor
        !> rule_block, rule_single, rule_given or rule_extended
        integer, intent(in) :: rule
        !> From new_state or an earlier solve
        type(state_type), intent(inout) :: state
        !> No unique solution, not settled, not finite, or no memory
        type(error_type), allocatable, intent(out) :: error
        !> On the ground: where to begin, before the search starts as ever
        type(ground_start_type), intent(in), optional :: near
        type(beam_type) :: changed

        call forget(state)
        if (allocated(state%stretched)) deallocate (state%stretched)
        state%factor = factor
        state%fingerprint = assembled%fingerprint
        call reserve_for(for_solving, assembled%beam, detail_of(assembled), error)
        if (allocated(error)) return
        call solve_along_axis(assembled, state, error)
        if (allocated(error)) return
        if (allocated(assembled%layers)) then
            call check_room(assembled, state, error)
            if (allocated(error)) return
            if (assembled%model%stretching) then
                call settle_stretched(assembled, rule, state, error)
            else
                call settle_on_ground(assembled, rule, state, error, near)
            end if
        else if (has_own_laws(assembled, state)) then
            changed = assembled%beam
            changed%supports(:) = laws_in(assembled, state)
            call settle(assembled, changed, rule, state, error)
        else
            call settle(assembled, assembled%beam, rule, state, error)
        end if
        if (.not. allocated(error) .and. state%status == gapbeam_solved) call check_range(assembled, state, error)
        state%loose_along = state%loose_along .and. .not. state%indifferent
        state%indifferent = state%indifferent .or. state%loose_along
        call end_if_stopped(assembled%beam%watch, error)
    end subroutine solve_state

    !> Find the scheme of a beam, and take its solution
    subroutine settle(assembled, beam, rule, state, error)
        type(assembled_type), intent(in) :: assembled
        !> With the laws of the supports as they are
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: rule
        !> With its factor, and the scheme from which the search starts
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(ledger_type) :: fault
        logical, allocatable :: acting(:)

        call copy_scheme(state, acting, error)
        if (allocated(error)) return
        call new_workspace(beam, work)
        call set_loads(beam, state%factor, work)
        call decide_scheme(beam, detail_of(assembled), state%factor, rule, acting, work, outcome, error, fault)
        if (fault%wrong /= 0) then
            fault%piece = assembled%node_point(fault%piece) + 1
            call name_fault(assembled, fault, error)
        end if
        call name_range(assembled, error)
        if (allocated(error)) return
        state%solves = work%solves
        state%method = work%method
        state%cycled = work%cycled
        call take_outcome(outcome, acting, state)
        if (state%status /= gapbeam_solved) return
        state%undecided(:) = outcome%undecided
        state%deflection(:) = work%answers%deflection
        associate (a => work%answers(0:size(beam%links)))
            state%moment_left(:) = a%moment_left
            state%moment_right(:) = a%moment_right
        end associate
        state%shear(:) = work%shear
        state%reaction(:) = work%reaction
    end subroutine settle

    !> The same of a beam that is pulled by what its deflections lengthen it by
    subroutine settle_stretched(assembled, rule, state, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: rule
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(stretching_type) :: stretching
        logical :: start(size(state%closed))
        integer :: solves

        start(:) = state%closed
        solves = 0
        call begin_stretching(assembled, stretching)
        do
            state%closed(:) = start
            if (allocated(state%ground)) deallocate (state%ground)
            state%status = -1
            state%stretched = stretching%stretched
            call settle_on_ground(assembled, rule, state, error)
            if (allocated(state%ground)) solves = solves + state%ground%solves
            if (has_ended(error)) return
            if (.not. allocated(error) .and. state%status == gapbeam_solved) then
                call guess_stretching(stretching, lengthening(assembled, state%ground))
            else
                if (state%status == gapbeam_buckles .and. .not. any(state%stretched > 0.0_wp)) then
                    call bound_stretching(assembled, state%factor, state%ground%axial_share, stretching)
                end if
                call guess_stretching(stretching)
            end if
            if (stretching%ends) exit
            if (allocated(error)) deallocate (error)
        end do
        if (stretching%fails) then
            ! Why is told without stretching
            if (allocated(error)) deallocate (error)
            if (allocated(state%ground)) deallocate (state%ground)
            deallocate (state%stretched)
            state%closed(:) = start
            call settle_on_ground(assembled, rule, state, error)
            return
        end if
        state%solves = solves
        if (allocated(error) .or. state%status /= gapbeam_solved) return
        if (stretching%jumps) then
            call fatal_error(error, gapbeam_not_converged, "the beam jumps from one shape to another while it is stretched, "// &
                             "and none was found that fits its tension: look for supports or loads that press it into two waves")
            return
        end if
        state%stretched = stretching%stretched
        call solve_along_axis(assembled, state, error)
    end subroutine settle_stretched

    !> The same on the ground
    subroutine settle_on_ground(assembled, rule, state, error, near)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: rule
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type), intent(in), optional :: near
        type(outcome_type) :: outcome
        type(ledger_type) :: ledger
        logical, allocatable :: acting(:)
        type(ground_type) :: ground

        ground = ground_of(assembled, state%factor, state)
        call check_tensions(assembled, ground, error)
        if (.not. allocated(error)) call copy_scheme(state, acting, error)
        if (allocated(error)) return
        allocate (state%ground)
        call solve_stable(ground, detail_of(assembled), state%factor, merge(rule_block, rule, rule >= rule_given), acting, &
                          state%ground, outcome, error, near)
        if (rule == rule_given) then
            call solve_as_given()
        else if (is_solved(outcome, error)) then
            ! As for a beam without ground: in a scheme that is known, what only touches pushes nothing
            call refuse_indeterminate(ground%beam, acting, state%ground%undecided, error)
        end if
        call name_range(assembled, error)
        if (allocated(error)) return
        state%solves = state%ground%solves
        call take_outcome(outcome, acting, state)
        if (state%status /= gapbeam_solved) return
        state%undecided(:) = state%ground%undecided
        state%deflection(:) = state%ground%deflection
        state%moment_left(:) = state%ground%moment_left
        state%moment_right(:) = state%ground%moment_right
        state%reaction(:) = state%ground%reaction
        call reserve_memory(for_fields, 0, 0, 2*size(state%ground%piece) + size(acting), error)
        if (allocated(error)) return
        call audit_ground(ground, state%factor, acting, state%ground, ledger, state%ground%residuals)
        call name_fault(assembled, ledger, error)

    contains

        !> Take the scheme that is known where the search has ended in another one: at the end of a piece as well beyond it, and
        !> where forces fall in another state
        subroutine solve_as_given()
            type(ground_solution_type), allocatable :: solution
            type(outcome_type) :: another
            type(error_type), allocatable :: trouble
            type(node_support_type), allocatable :: laws(:)
            logical :: closed(size(acting))

            if (has_ended(error)) return
            if (is_solved(outcome, error)) then
                ! At the end of a piece a law is on that which is known: it has the slope for what comes next
                associate (is_law => ground%beam%supports%breakpoint > 0)
                    if (all((acting .eqv. state%closed) .or. (state%ground%undecided .and. .not. is_law))) return
                end associate
            end if
            laws = ground%beam%supports
            call extend_pieces(ground%beam%supports, state%closed)
            allocate (solution)
            closed(:) = state%closed
            if (any(ground%beam%supports%stiffness < 0.0_wp)) then
                ! Whether the beam is stable tells the path: axial forces that grow from nothing would lead elsewhere
                call solve_on_ground(ground, detail_of(assembled), state%factor, rule_block, closed, solution, another, trouble)
            else
                call solve_stable(ground, detail_of(assembled), state%factor, rule_block, closed, solution, another, trouble)
            end if
            if (is_solved(another, trouble)) then
                if (allocated(error)) deallocate (error)
                acting(:) = state%closed
                outcome = another
                solution%solves = solution%solves + state%ground%solves
                solution%unique = solution%unique .and. state%ground%unique
                call move_alloc(solution, state%ground)
            else
                call move_alloc(laws, ground%beam%supports)
            end if
        end subroutine solve_as_given

    end subroutine settle_on_ground

    !> The scheme of a state, to start from; no memory is an error
    pure subroutine copy_scheme(state, acting, error)
        type(state_type), intent(in) :: state
        logical, allocatable, intent(out) :: acting(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        allocate (acting(size(state%closed)), source=state%closed, stat=stat)
        if (stat /= 0) call no_memory(error)
    end subroutine copy_scheme

    !> Take what was found of a scheme: no equilibrium, or which one it is
    pure subroutine take_outcome(outcome, acting, state)
        type(outcome_type), intent(in) :: outcome
        logical, intent(in) :: acting(:)
        !> Does the beam slide, in
        type(state_type), intent(inout) :: state

        state%status = merge(gapbeam_no_equilibrium, outcome%status, state%slides)
        if (state%slides) return
        if (outcome%status /= gapbeam_solved) then
            if (allocated(outcome%motion)) state%motion(:) = outcome%motion
            return
        end if
        state%indifferent = outcome%indifferent
        state%closed(:) = acting
    end subroutine take_outcome


    !> What the links of a beam are made of
    function detail_of(assembled) result(detail)
        type(assembled_type), intent(in), target :: assembled
        type(detail_type) :: detail

        detail%pieces => assembled%pieces
        detail%dead => assembled%dead
        detail%live => assembled%live
        detail%last => assembled%node_point(1:)
    end function detail_of

    !> Fields of a solved state at the left ends of all pieces
    pure subroutine recover_state(assembled, state, starts)
        !> The beam and the state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> The fields, shape (npiece)
        type(field_type), intent(out) :: starts(:)

        associate (n => size(assembled%beam%links))
            call recover_beam(assembled%pieces, assembled%dead, assembled%live, state%factor, assembled%beam%links, &
                              assembled%node_point(1:n), assembled%beam%kind, state%deflection(0:n), state%moment_left, &
                              state%moment_right, state%shear, starts)
        end associate
    end subroutine recover_state

    !> Residuals of a solved state, and bounds for its errors in the engine's units
    subroutine certify_state(assembled, state, certificate, error)
        type(assembled_type), intent(in), target :: assembled
        !> Solved
        type(state_type), intent(in) :: state
        !> How good it is
        type(certificate_type), intent(out) :: certificate
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(field_type), allocatable :: starts(:)
        real(wp), allocatable :: length_error(:)
        type(beam_type), target :: changed
        type(beam_type), pointer :: beam

        if (allocated(state%ground)) then
            associate (bounds => state%ground%bounds, residuals => state%ground%residuals)
                certificate = certificate_type(compatibility=residuals(1), equilibrium=residuals(2), &
                                               complementarity=residuals(3), reaction=bounds(5), moment=bounds(3), &
                                               shear=bounds(4), known=.not. state%indifferent)
                if (state%indifferent) return
                certificate%of_nodes = bounds(1)
                certificate%deflection = bounds(1)
                certificate%rotation = bounds(2)
            end associate
            return
        end if
        call reserve_for(for_certifying, assembled%beam, detail_of(assembled), error)
        if (allocated(error)) return
        allocate (starts(size(assembled%pieces)), length_error(size(assembled%beam%links)))
        call recover_state(assembled, state, starts)
        call find_length_errors(assembled, length_error)
        beam => assembled%beam
        if (has_own_laws(assembled, state)) then
            changed = assembled%beam
            changed%supports(:) = laws_in(assembled, state)
            beam => changed
        end if
        call certify(beam, detail_of(assembled), state%factor, state%closed, state%deflection, state%moment_left, &
                     state%moment_right, state%reaction, starts, length_error, certificate, error)
        call end_if_stopped(assembled%beam%watch, error)
    end subroutine certify_state

end module gapbeam_state
