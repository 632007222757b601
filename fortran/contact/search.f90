!> Active-set search for the contact state: solve, find wrong supports, change some of them.
!>
!> A scheme is right when no closed support pulls and no open one is penetrated. Two rules find it.
!>
!> single   the paper's: release the closed support that pulls most and put back every open one that is penetrated, until
!>          nothing changes. Not proved finite; if a scheme comes back, block goes on.
!> block    where the wrong supports lie in a subdomain of a long beam, find the scheme of that subdomain by itself, with what the
!>          rest does to it as loads, and solve the whole again (domain decomposition after Schwarz); boundaries
!>          are moved by statics first. Otherwise change every wrong support at once while their number keeps
!>          falling within a few solves. If it does not, guess the scheme by interior points and go on from there. If
!>          that fails too, change in the best scheme so far the wrong support of least index until fewer are wrong, and so on.
!>
!> Why block ends: for a stable beam the problem is a linear complementarity problem with a P-matrix, for which the
!> least-index rule reaches the solution without repeating a scheme (Murty 1974), so the fewest number of wrong
!> supports falls after finitely many solves, and it can fall only finitely often (Judice and Pires 1994). The phases
!> before are bounded by counts, subdomains by their rounds, which get fewer from beam to subdomain. Finite may be very long, so the
!> least-index rule gives up after so many solves as take some seconds (most_solves).
module gapbeam_search
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: non_monotone_solves, warm_non_monotone_solves, polish_non_monotone_solves, &
        last_non_monotone_solves, law_non_monotone_solves, most_law_steps, final_non_monotone_solves, rounding_changes, &
        most_guess_steps, few_guess_changes, steps_between_guesses, subdomain_rounds, few_wrong_supports
    use gapbeam_tolerances, only: last_width, rounding_product, most_in_subdomains
    use gapbeam_words, only: shown, whole
    use gapbeam_error, only: error_type, fatal_error, gapbeam_indeterminate, gapbeam_not_converged
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_band, only: band_ok, band_mechanism, band_needs_pivoting, band_stopped
    use gapbeam_law, only: separate_rigid_pairs, open_from, advance_one_segment
    use gapbeam_model, only: beam_type, has_other_supports
    use gapbeam_workspace, only: workspace_type
    use gapbeam_system, only: complete_scheme
    use gapbeam_evaluation, only: search_type, evaluate_active_set
    use gapbeam_rules, only: keep_worst_pull, keep_local_worst, keep_least_index, mark_type, set_mark, cycled
    use gapbeam_reactions, only: find_shears
    use gapbeam_law_energy, only: line_type, new_line, is_convex, go_towards, states_of_laws
    use gapbeam_contact_boundary, only: find_base, move_boundaries
    use gapbeam_subdomain, only: next_stretch, extract_subdomain, least_margin
    use gapbeam_interior_point, only: interior_type, start_interior, step_interior, product_of
    implicit none
    private
    public :: settle, refuse_scheme, rule_block, rule_single, rule_least_index

    !> The two rules, and the last phase of block alone
    integer, parameter :: rule_block = 0, rule_single = 1, rule_least_index = 2

contains

    !> Change supports until none is wrong
    recursive subroutine settle(beam, rule, may_float, closed, work, settled, error, rounds, carefully)
        type(beam_type), intent(in) :: beam
        !> rule_block, rule_single or rule_least_index
        integer, intent(in) :: rule
        !> Give up (settled is false) at a mechanism, and before the least-index rule
        logical, intent(in) :: may_float
        !> Start in, contact state out
        logical, intent(inout) :: closed(:)
        !> Loads in, solution out
        type(workspace_type), intent(inout) :: work
        !> Is the scheme right
        logical, intent(out) :: settled
        !> No unique solution, or signs that cannot be told from rounding
        type(error_type), allocatable, intent(out) :: error
        !> Rounds of subdomains, if this is a subdomain itself
        integer, intent(in), optional :: rounds
        !> Refine wherever few are wrong, however clearly (default: not what is solved from both ends, where little cancels)
        logical, intent(in), optional :: carefully
        type(search_type) :: search

        allocate (search%wrong(size(closed)), search%best(size(closed)))
        search%best(:) = closed
        search%rounds = subdomain_rounds
        if (present(rounds)) search%rounds = rounds
        search%in_subdomain = present(rounds)
        search%next_rounds = search%rounds/2
        ! Weak springs let the beam go far: little of its deflection is bending
        search%carefully = any(work%proximal_weight > 0.0_wp)
        if (present(carefully)) search%carefully = search%carefully .or. carefully
        ! Parts and interior points know of ordinary supports only
        search%with_laws = has_other_supports(beam)
        if (.not. (search%with_laws .or. allocated(beam%ground))) search%margin = least_margin(beam)
        settled = .false.
        if (rule == rule_single) call change_single(beam, closed, work, search, settled)
        search%fewest = huge(0)
        if (rule == rule_least_index) then
            search%rounds = 0
        else if (.not. settled .and. search%state == band_ok) then
            call change_all(beam, merge(non_monotone_solves, warm_non_monotone_solves, all(closed)), closed, work, search, settled)
        end if
        if (.not. settled .and. search%state == band_ok .and. search%with_laws .and. rule /= rule_least_index) then
            call change_by_energy(beam, closed, work, search, settled)
        end if
        if (.not. (settled .or. search%state == band_mechanism .or. search%with_laws .or. rule == rule_least_index)) then
            call change_by_interior_point(beam, closed, work, search, settled)
        end if
        if (settled .or. may_float) return
        if (search%state == band_ok) call change_least_index(beam, closed, work, search, settled)
        if (settled) return
        if (search%state /= band_ok) then
            call refuse_scheme(beam, search%state, search%place, error)
        else if (work%solves > work%most_solves) then
            call fatal_error(error, gapbeam_not_converged, "the contact state was not found within "//trim(whole(work%solves))// &
                             " solves: follow the load by steps, or give supports and pieces of the beam stiffnesses that "// &
                             "differ less")
        else
            call fatal_error(error, gapbeam_not_converged, "the signs of some reactions or openings cannot be told from "// &
                             "rounding errors in double precision")
        end if
    end subroutine settle

    !> The paper's rule; returns unsettled when a scheme comes back
    subroutine change_single(beam, closed, work, search, settled)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        type(mark_type) :: mark

        call set_mark(mark, closed)
        do
            call evaluate_active_set(beam, closed, .true., work, search, settled)
            if (settled .or. search%state /= band_ok) return
            call keep_worst_pull(closed, work, search%wrong)
            call change(beam, search, closed)
            work%cycled = cycled(mark, closed)
            if (work%cycled) return
        end do
    end subroutine change_single

    !> Change the states that are wrong
    pure subroutine change(beam, search, closed)
        type(beam_type), intent(in) :: beam
        type(search_type), intent(in) :: search
        logical, intent(inout) :: closed(:)

        logical, allocatable :: before(:)

        if (search%with_laws .and. search%by_pieces) then
            allocate (before, source=closed)
            closed(:) = closed .neqv. search%wrong
            call advance_one_segment(beam%supports, before, closed)
        else
            closed(:) = closed .neqv. search%wrong
            if (search%with_laws) call open_from(beam%supports, closed)
        end if
    end subroutine change

    !> Change what is wrong, in subdomains or all at once, until the number of wrong supports did not fall for some solves.
    !> Where few are wrong, a step without progress is followed by one of the paper's rule in every neighbourhood
    recursive subroutine change_all(beam, idle_solves, closed, work, search, settled)
        type(beam_type), intent(in) :: beam
        !> Solves without progress that are allowed
        integer, intent(in) :: idle_solves
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        integer :: idle
        logical :: changed

        idle = 0
        do
            call evaluate_active_set(beam, closed, .false., work, search, settled)
            if (settled .or. search%state /= band_ok) return
            if (search%margin > 0 .and. .not. scattered(beam, search)) then
                if (.not. allocated(search%base%support)) call find_base(beam, search%base)
                call find_shears(beam, [1, size(beam%links)], work)
                call move_boundaries(beam, closed, work, search%base, search%margin/2, search%wrong)
                call settle_subdomains(beam, closed, work, search, changed)
                if (changed) cycle
            end if
            if (search%wrong_now < search%fewest) then
                search%fewest = search%wrong_now
                search%best(:) = closed
                idle = 0
            else
                idle = idle + 1
                search%carefully = .true.
                if (idle > merge(law_non_monotone_solves, idle_solves, search%with_laws)) return
                ! Over several pieces at once laws may go to and fro (Newton without line search)
                search%by_pieces = search%with_laws
                if (search%wrong_now <= few_wrong_supports .and. .not. search%with_laws) then
                    if (.not. work%complete) call complete_scheme(beam, closed, work)
                    call keep_local_worst(beam, closed, work, search%wrong)
                end if
            end if
            call change(beam, search, closed)
        end do
    end subroutine change_all

    !> Newton's method for laws that do not fall: the states at the least energy on the way to the last solution are the next
    subroutine change_by_energy(beam, closed, work, search, settled)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        type(line_type) :: line
        type(error_type), allocatable :: error
        real(wp) :: way
        integer :: step

        settled = .false.
        if (.not. is_convex(beam%supports)) return
        closed(:) = search%best
        do step = 0, most_law_steps
            call evaluate_active_set(beam, closed, .true., work, search, settled)
            if (settled .or. search%state /= band_ok) exit
            if (step == 0) then
                call new_line(work%answers%deflection, work%reaction, line, error)
                if (allocated(error)) return
            else
                call go_towards(line, beam%supports, work%answers%deflection, work%reaction, .false., way)
            end if
            if (search%wrong_now < search%fewest) then
                search%fewest = search%wrong_now
                search%best(:) = closed
            end if
            ! Rigid supports change as they are wrong
            closed(:) = closed .neqv. search%wrong
            call states_of_laws(beam%supports, line%deflection, closed)
        end do
        if (search%state == band_mechanism) search%state = band_ok
    end subroutine change_by_energy

    !> Where the wrong supports lie in a subdomain of the beam only, find its scheme by itself
    recursive subroutine settle_subdomains(beam, closed, work, search, changed)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        !> Is there a new scheme
        logical, intent(out) :: changed
        type(beam_type) :: subdomain
        type(workspace_type) :: subdomain_work
        type(error_type), allocatable :: error
        logical, allocatable :: subdomain_closed(:), before(:)
        integer, allocatable :: number(:)
        integer :: place, from, to, nodes
        real(wp) :: solves
        logical :: settled

        changed = .false.
        if (search%rounds == 0) return
        nodes = 0
        place = 1
        do
            call next_stretch(beam, search%wrong, search%margin, place, from, to)
            if (from < 0) exit
            nodes = nodes + (to - from)
        end do
        if (nodes > most_in_subdomains*size(beam%links)) return
        allocate (before, source=closed)
        solves = 0.0_wp
        place = 1
        do
            call next_stretch(beam, search%wrong, search%margin, place, from, to)
            if (from < 0) exit
            call extract_subdomain(beam, before, work, from, to, subdomain, subdomain_work, number)
            subdomain_closed = before(number)
            call settle(subdomain, rule_block, .true., subdomain_closed, subdomain_work, settled, error, search%next_rounds)
            solves = solves + subdomain_work%solves*real(to - from, wp)/size(beam%links)
            if (settled) then
                changed = .true.
                closed(number) = subdomain_closed
            else
                closed(number) = before(number) .neqv. search%wrong(number)
            end if
        end do
        if (.not. changed) closed(:) = before
        work%solves = work%solves + ceiling(solves)
        ! A round in which no subdomain was settled counts too: else subdomains within subdomains were tried again after every solve
        search%rounds = search%rounds - 1
        if (.not. changed) return
        search%margin = (3*search%margin)/2
    end subroutine settle_subdomains

    !> Are the wrong supports here and there, not at a few boundaries, and fewer than before
    pure function scattered(beam, search) result(everywhere)
        type(beam_type), intent(in) :: beam
        type(search_type), intent(in) :: search
        logical :: everywhere
        integer :: groups, j
        logical :: before

        groups = 0
        before = .false.
        do j = 1, size(beam%order)
            associate (wrong => search%wrong(beam%order(j)))
                if (wrong .and. .not. before) groups = groups + 1
                before = wrong
            end associate
        end do
        everywhere = groups > few_wrong_supports .and. 4*groups > search%wrong_now .and. search%wrong_now < 3*(search%fewest/4)
    end function scattered

    !> Guess the scheme by interior points, and settle the guess by pivoting as soon as it hardly changes any more
    recursive subroutine change_by_interior_point(beam, closed, work, search, settled)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        type(interior_type) :: iterate
        logical, allocatable :: guess(:), last_guess(:)
        integer :: step, wait, changes
        real(wp) :: first_product

        settled = .false.
        allocate (guess(size(closed)), last_guess(size(closed)))
        call start_interior(beam, closed, work, iterate, search%state, search%place)
        last_guess(:) = closed
        wait = 0
        first_product = product_of(iterate)
        do step = 1, most_guess_steps
            if (search%state /= band_ok) exit
            if (allocated(search%kept)) deallocate (search%kept)
            if (allocated(search%applied)) deallocate (search%applied)
            call step_interior(beam, closed, work, iterate, guess, search%state, search%place)
            if (search%state /= band_ok) exit
            changes = count(guess .neqv. last_guess)
            if (.not. product_of(iterate) < first_product/rounding_product) exit  ! it runs away: no equilibrium
            if (product_of(iterate) < rounding_product*first_product .and. changes > rounding_changes) exit
            wait = wait - 1
            if (wait <= 0 .and. changes <= few_guess_changes) then
                closed(:) = guess
                call separate_rigid_pairs(beam%supports, size(beam%links), closed)
                search%fewest = huge(0)
                call change_all(beam, polish_non_monotone_solves, closed, work, search, settled)
                if (settled) exit
                search%state = band_ok
                wait = steps_between_guesses
            end if
            last_guess(:) = guess
        end do
        if (.not. settled .and. search%state == band_ok) then
            closed(:) = last_guess
            call separate_rigid_pairs(beam%supports, size(beam%links), closed)
            search%fewest = huge(0)
            call change_all(beam, final_non_monotone_solves, closed, work, search, settled)
        end if
        deallocate (work%spring, work%spring_contact)
    end subroutine change_by_interior_point

    !> The least-index rule until fewer supports are wrong than before, then all at once again. A scheme that comes back
    !> can only mean that rounding decides signs: then fewer signs count
    recursive subroutine change_least_index(beam, closed, work, search, settled)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(search_type), intent(inout) :: search
        logical, intent(out) :: settled
        type(mark_type) :: mark

        do
            call change_all(beam, last_non_monotone_solves, closed, work, search, settled)
            if (settled .or. search%state /= band_ok) return
            ! Where all were changed at once last, many more may be wrong, from which this rule takes very long to come back
            closed(:) = search%best
            call set_mark(mark, closed)
            do
                call evaluate_active_set(beam, closed, .false., work, search, settled)
                if (settled .or. search%state /= band_ok .or. work%solves > work%most_solves) return
                if (search%wrong_now < search%fewest) exit
                call keep_least_index(search%wrong)
                call change(beam, search, closed)
                if (cycled(mark, closed)) then
                    search%width = 16*search%width
                    if (search%width > last_width) return
                end if
            end do
        end do
    end subroutine change_least_index

    !> A scheme that cannot be solved though all that holds the beam acts
    subroutine refuse_scheme(beam, state, place, error)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: state, place
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: text
        real(kind(0.0d0)) :: x

        x = real(sum(beam%links(:min(place, size(beam%links)))%length), kind(x))
        text = "near x = "//trim(shown(x))
        if (state == band_stopped) then
            call end_if_stopped(beam%watch, error)
        else if (state == band_needs_pivoting) then
            call fatal_error(error, gapbeam_indeterminate, "a rigid stretch of the beam "//text// &
                             " rests on more rigid supports than statics can tell apart: give the stretch"// &
                             " or one of its supports a finite stiffness")
        else
            call fatal_error(error, gapbeam_not_converged, text//" so little holds the beam that it cannot be "// &
                             "solved: give supports or ground there a stiffness from the start, or ask for more of the load")
        end if
        error%distance = x
    end subroutine refuse_scheme

end module gapbeam_search
