!> Contact states decided in quadruple precision where double precision cannot.
!>
!> The search in double precision tells signs from rounding by the sizes of the terms behind them. Where a sign is within
!> its rounding error, where the search does not end, or where a motion is free by a hair only, the same engine,
!> compiled in quadruple precision, searches again, from the numbers of the pieces rather than from links rounded to
!> doubles, and its solution, rounded once, is the result.
module gapbeam_extended_precision
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: sign_width, worst_digits, worst_correction, most_left_out, most_hidden, given_leeway
    use gapbeam_error, only: error_type, fatal_error, has_ended, gapbeam_solved, gapbeam_indeterminate, gapbeam_not_converged
    use gapbeam_memory, only: reserve_memory, for_refining
    use gapbeam_law, only: always_closed, has_laws
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, method_pivoting
    use gapbeam_rules, only: find_doubtful, find_wrong
    use gapbeam_system, only: solve_and_refine
    use gapbeam_band, only: band_ok
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_static_indeterminacy, only: refuse_indeterminate
    use gapbeam_kinematics, only: held_by_ties
    use gapbeam_kinematics_quad, only: fine_held_by_ties => held_by_ties
    use gapbeam_model_quad, only: fine_beam_type => beam_type, fine_support_type => node_support_type
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_law_margins_quad, only: is_watched_in
    use gapbeam_system_quad, only: solve_and_refine_fine => solve_and_refine
    use gapbeam_search_quad, only: rule_block
    use gapbeam_contact_state_quad, only: find_fine_contact_state => find_contact_state, fine_outcome_type => outcome_type
    use gapbeam_ill_scaled_signs, only: flip_ill_scaled
    use gapbeam_refined, only: detail_type, refine_loaded_beam
    use gapbeam_undecided, only: find_undecided, come_to_rest
    use gapbeam_ledger, only: ledger_type, words_for
    use gapbeam_audit, only: audit_beam
    implicit none
    private
    public :: decide_scheme, rule_given, rule_extended, detail_type, reserve_for

    !> Beside the rules of gapbeam_search: the scheme is known; its lines are followed beyond where it holds, as tangents are, and
    !> signs say nothing
    integer, parameter :: rule_given = 2, rule_extended = 3

contains

    !> Find the contact state and its solution, whatever precision it takes; refused where other reactions would do as well, and
    !> where what came out does not stand its audit
    subroutine decide_scheme(beam, detail, factor, rule, closed, work, outcome, error, fault)
        !> The beam, and what its links are made of
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> As for find_contact_state
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        !> What the audit found wrong, at which node
        type(ledger_type), intent(out), optional :: fault
        type(ledger_type) :: ledger
        logical, allocatable :: undecided(:)
        character(len=40) :: place
        integer :: known

        known = min(rule, rule_given)
        call find_contact_state_in_doubles(beam, detail, factor, known, closed, work, outcome, error)
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        call audit_beam(beam, closed, outcome%undecided .or. rule == rule_extended, outcome%indifferent, &
                        merge(given_leeway, 1.0_wp, known == rule_given), work%answers, work%shear, work%reaction, work, ledger)
        if (ledger%wrong /= 0) then
            ! Quadruple precision has the last word on that as well
            allocate (undecided(size(closed)))
            if (known == rule_given .and. has_laws(beam%supports)) then
                call refer_given(beam, detail, factor, closed, undecided, work, outcome, error)
            else
                call refer(beam, detail, factor, closed, undecided, work, outcome, error)
            end if
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            call move_alloc(undecided, outcome%undecided)
            call audit_beam(beam, closed, outcome%undecided .or. rule == rule_extended, outcome%indifferent, &
                            merge(given_leeway, 1.0_wp, known == rule_given), work%answers, work%shear, work%reaction, work, ledger)
        end if
        if (ledger%wrong /= 0) then
            write (place, "(i0, a, i0)") ledger%piece, " of ", size(beam%links)
            call fatal_error(error, gapbeam_not_converged, "the result does not stand its own audit: at node "//trim(place)//" "// &
                             trim(words_for(ledger%wrong)))
            if (present(fault)) fault = ledger
            return
        end if
        ! In a scheme that is known, what only touches pushes nothing: at an event of a path reactions may go from there to others
        if (known /= rule_given) call refuse_indeterminate(beam, closed, outcome%undecided, error)
    end subroutine decide_scheme

    !> Find a contact state and its solution
    subroutine find_contact_state_in_doubles(beam, detail, factor, rule, closed, work, outcome, error)
        !> As for decide_scheme
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: undecided(:)
        logical :: in_doubt

        allocate (undecided(size(closed)), source=.false.)
        if (rule == rule_given) then
            call solve_given(beam, closed, undecided, work, outcome)
            if (allocated(outcome%undecided)) return
            if (has_laws(beam%supports)) then
                ! Another scheme may be right as well, but it is not the one asked for
                call refer_given(beam, detail, factor, closed, undecided, work, outcome, error)
                if (.not. allocated(error)) call move_alloc(undecided, outcome%undecided)
                return
            end if
        end if
        call find_contact_state(beam, factor, merge(rule_block, rule, rule == rule_given), closed, work, outcome, error)
        if (allocated(error)) then
            if (has_ended(error)) return
            in_doubt = .true.
        else if (outcome%status == gapbeam_solved) then
            call find_doubtful(beam, closed, work, undecided, in_doubt)
            in_doubt = in_doubt .or. outcome%in_doubt .or. digits_lost(work)
        else
            in_doubt = outcome%in_doubt
        end if
        if (in_doubt) then
            call refer(beam, detail, factor, closed, undecided, work, outcome, error)
        else if (outcome%status == gapbeam_solved) then
            if (.not. outcome%indifferent) outcome%indifferent = held_by_ties(beam, closed, undecided)
        end if
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        call move_alloc(undecided, outcome%undecided)
    end subroutine find_contact_state_in_doubles

    !> Solve a scheme that is known from the path of the load. At the factor of an event, rounded to a double, a search could as
    !> well end on the other side of it
    subroutine solve_given(beam, closed, undecided, work, outcome)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        logical, intent(inout) :: undecided(:)
        type(workspace_type), intent(inout) :: work
        !> With undecided allocated if the scheme has been solved, and nothing in it is wrong
        type(outcome_type), intent(inout) :: outcome
        logical, allocatable :: wrong(:)
        integer :: state, place

        work%solves = 0
        work%cycled = .false.
        work%proximal_weight = 0.0_wp
        call solve_and_refine(beam, closed, work, state, place)
        if (state /= band_ok) return
        allocate (wrong(size(closed)))
        call find_wrong(beam, closed, sign_width, work, wrong)
        if (any(wrong) .or. digits_lost(work) .or. .not. all(abs(work%answers%deflection) <= huge(1.0_wp))) return
        call find_doubtful(beam, closed, work, undecided)
        outcome%indifferent = held_by_ties(beam, closed, undecided)
        outcome%undecided = undecided
    end subroutine solve_given

    !> Are reactions known to few digits, as those of springs far stiffer than the beam beside each other, or deflections
    pure function digits_lost(work) result(lost)
        type(workspace_type), intent(in) :: work
        logical :: lost

        lost = .false.
        if (size(work%reaction) > 0) lost = maxval(work%reaction_error) > worst_digits*maxval(abs(work%reaction))
        if (lost .or. work%method == method_pivoting .or. allocated(work%end_shear)) return
        ! Elimination loses what springs hold that are next to nothing beside the links: the correction tells
        associate (change => abs(work%correction%deflection), own => work%deflection_size(:ubound(work%correction, 1)))
            lost = maxval(change, change > sign_width*epsilon(1.0_wp)*own) &
                > worst_correction*maxval(abs(work%answers%deflection))
        end associate
    end function digits_lost

    !> A scheme that is known, in quadruple precision
    subroutine refer_given(beam, detail, factor, closed, undecided, work, outcome, error)
        !> As for refer; where part of the beam moves freely, a scheme out that is as right
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        logical, intent(out) :: undecided(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(inout) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(fine_beam_type) :: fine
        type(fine_workspace_type) :: fine_work
        logical, allocatable :: found(:)
        logical :: same, rests
        integer :: state, place

        undecided(:) = .false.
        call reserve_for(for_refining, beam, detail, error)
        if (allocated(error)) return
        call refine_loaded_beam(beam, detail, real(factor, qp), fine, fine_work)
        call solve_and_refine_fine(fine, closed, fine_work, state, place)
        work%solves = work%solves + fine_work%solves
        if (state /= band_ok) then
            ! Part of the beam may move freely without work of the loads: its forces are unique, and the search knows how
            found = closed
            call refer(beam, detail, factor, found, undecided, work, outcome, error)
            same = .not. allocated(error) .and. outcome%status == gapbeam_solved .and. outcome%indifferent
            if (same) same = all((found .eqv. closed) .or. undecided)
            if (same) closed(:) = found
            if (same) return
            if (has_ended(error)) return
            call fatal_error(error, gapbeam_not_converged, "the beam is held by so little here that its state is not unique")
            return
        end if
        outcome = outcome_type()
        call come_to_rest(fine, fine_work, rests)
        call find_undecided(fine, real(factor, qp), closed, fine_work, undecided)
        call take_rounded(fine_work, work)
    end subroutine refer_given

    !> The solution in quadruple precision, rounded once
    pure subroutine take_rounded(fine_work, work)
        type(fine_workspace_type), intent(in) :: fine_work
        type(workspace_type), intent(inout) :: work

        associate (a => fine_work%answers)
            work%answers%deflection = real(a%deflection, wp)  ! and rotations
            work%answers%moment_left = real(a%moment_left, wp)
            work%answers%moment_right = real(a%moment_right, wp)
        end associate
        work%shear = real(fine_work%shear, wp)
        work%reaction = real(fine_work%reaction, wp)
        work%method = fine_work%method
    end subroutine take_rounded

    !> Is there the memory for what is to be done to a beam
    subroutine reserve_for(purpose, beam, detail, error)
        !> One of the purposes of gapbeam_memory
        integer, intent(in) :: purpose
        !> The beam, and what its links are made of
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> Set where there is not
        type(error_type), allocatable, intent(out) :: error
        integer :: pieces

        pieces = 0
        if (associated(detail%pieces)) pieces = size(detail%pieces)
        call reserve_memory(purpose, size(beam%links), size(beam%supports), pieces, error)
    end subroutine reserve_for

    !> The same in quadruple precision
    subroutine refer(beam, detail, factor, closed, undecided, work, outcome, error)
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        !> Start in, contact state out
        logical, intent(inout) :: closed(:)
        !> Supports that are at zero even so
        logical, intent(out) :: undecided(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(inout) :: outcome
        type(error_type), allocatable, intent(inout) :: error
        type(fine_beam_type) :: fine
        type(fine_workspace_type) :: fine_work
        type(fine_outcome_type) :: found
        real(qp), allocatable :: reaction(:)
        integer :: try, solves
        logical :: known, rests

        undecided(:) = .false.
        call reserve_for(for_refining, beam, detail, error)
        if (allocated(error)) return
        call refine_loaded_beam(beam, detail, real(factor, qp), fine, fine_work)
        do try = 0, 2
            ! Rigid stretches may touch more supports than they need: whether there is an answer must not depend on the start
            if (try > 0) closed(:) = try == 1 .or. always_closed(beam%supports)
            call find_fine_contact_state(fine, real(factor, qp), rule_block, closed, fine_work, found, error)
            work%solves = work%solves + fine_work%solves
            if (.not. allocated(error)) exit
            if (error%code /= gapbeam_indeterminate) exit
        end do
        if (allocated(error)) return
        outcome = outcome_type(status=found%status, indifferent=found%indifferent)
        if (found%status /= gapbeam_solved) then
            outcome%motion = real(found%motion, wp)
            return
        end if
        call come_to_rest(fine, fine_work, rests)
        if (.not. (found%indifferent .or. rests)) then
            solves = fine_work%solves
            call flip_ill_scaled(fine, closed, fine_work, known)
            work%solves = work%solves + fine_work%solves - solves
            if (.not. known) call fatal_error(error, gapbeam_not_converged, "stiffnesses, gaps and loads lie so far apart that "// &
                                              "rounding hides which supports act: check their numbers and units")
            if (allocated(error)) return
        end if
        allocate (reaction, source=fine_work%reaction)
        call find_undecided(fine, real(factor, qp), closed, fine_work, undecided)
        call refuse_hidden(fine%supports, closed, reaction, fine_work, error)
        if (allocated(error)) return
        if (.not. outcome%indifferent) outcome%indifferent = fine_held_by_ties(fine, closed, undecided)
        call take_rounded(fine_work, work)
    end subroutine refer

    !> Refuse a state in which reactions that rounding hides are more than next to nothing beside the loads
    subroutine refuse_hidden(supports, closed, reaction, work, error)
        type(fine_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        !> Before what is nothing but rounding was left out, and the solution after
        real(qp), intent(in) :: reaction(:)
        type(fine_workspace_type), intent(in) :: work
        type(error_type), allocatable, intent(out) :: error
        real(qp) :: load, least
        logical :: hidden
        integer :: k

        load = maxval(work%load_size)
        if (.not. load > 0.0_qp) return
        hidden = any(abs(reaction - work%reaction) > most_left_out*load)
        ! Of loads that are smaller still nothing is left, not even rounding
        least = most_hidden*max(load, maxval(abs(work%reaction)))
        do k = 1, size(closed)
            if (hidden) exit
            if (.not. closed(k) .or. abs(work%reaction(k)) > 0.0_qp .or. .not. work%reaction_error(k) > least) cycle
            hidden = is_watched_in(supports, closed, k)
        end do
        if (.not. hidden) return
        call fatal_error(error, gapbeam_not_converged, "stiffnesses lie so far apart, or gaps, lacks of fit or settlements are "// &
                         "so great that reactions to the loads are lost in rounding errors: check their numbers and units")
    end subroutine refuse_hidden

end module gapbeam_extended_precision
