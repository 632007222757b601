!> The audit: solved beams stand it, and whatever is broken in one is found
program test_audit
    use testing, only: check, finish
    use beams, only: sample_type, make_beam, detail_of, draw, draw_magnitude, infinite
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_nodes, only: plain, hinge, restrained
    use gapbeam_model, only: node_support_type, below, above, both, order_supports, of_node, of_hinge, of_hinge_held_left, &
        left_of_hinge, right_of_hinge
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: decide_scheme
    use gapbeam_ledger, only: ledger_type
    use gapbeam_audit, only: audit_beam, audit_axial, audit_residuals
    use gapbeam_axial, only: solve_axial, axial_ok
    implicit none
    !> What is broken is changed by this share: far more than rounding, far less than eyes would see
    real(wp), parameter :: share = 1e-8_wp
    integer :: status

    call what_is_solved_stands()
    call what_is_broken_is_found()
    call lines_without_force()
    call another_hinge()
    call rigid_supports_side_by_side()
    call bars()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A beam of 2 to 5 spans with magnitudes drawn, and sometimes a restraint, a hinge, couples, several supports at a place
    subroutine draw_beam(seed, decades, sample)
        integer, intent(inout) :: seed
        real(wp), intent(in) :: decades
        type(sample_type), intent(out) :: sample
        type(node_support_type), allocatable :: supports(:)
        real(wp), allocatable :: length(:), ei(:), dead(:), live(:)
        integer :: i, n, m

        n = 2 + int(4*draw(seed))
        allocate (length(n), ei(n), dead(n), live(n), supports(n + 2))
        do i = 1, n
            length(i) = draw_magnitude(seed, -0.3_wp*decades, 0.3_wp*decades)
            ei(i) = draw_magnitude(seed, 3.0_wp - decades, 3.0_wp + decades)
            dead(i) = 1 + draw(seed)
            live(i) = 2*draw(seed) - 1
        end do
        do i = 0, n
            supports(i + 1) = node_support_type(i, merge(both, below, i == 0 .or. draw(seed) < 0.3_wp), infinite(), 0.0_wp)
            if (draw(seed) < 0.4_wp) supports(i + 1)%stiffness = draw_magnitude(seed, 3.0_wp - decades, 3.0_wp + decades)
            if (draw(seed) < 0.5_wp) supports(i + 1)%contact = draw_magnitude(seed, -6.0_wp, -2.0_wp)
        end do
        m = 1 + int(n*draw(seed))
        supports(n + 2) = node_support_type(m, below, draw_magnitude(seed, 2.0_wp, 4.0_wp), 1e-3_wp*draw(seed))
        call make_beam(length, ei, dead, live, supports, sample)
        associate (beam => sample%beam)
            beam%kind(0) = restrained
            beam%compliance(0) = merge(0.0_wp, 1/draw_magnitude(seed, 2.0_wp, 4.0_wp), draw(seed) < 0.5_wp)
            if (draw(seed) < 0.3_wp) beam%kind(1) = hinge
            do i = 0, n
                if (draw(seed) < 0.4_wp) beam%force(2, i) = (2*draw(seed) - 1)*draw_magnitude(seed, -1.0_wp, 3.0_wp)
                if (draw(seed) < 0.2_wp .and. beam%kind(i) /= hinge) beam%couple(2, i) = 2*draw(seed) - 1
            end do
        end associate
        if (draw(seed) < 0.4_wp) call hold_rotations(seed, decades, sample)
    end subroutine draw_beam

    !> Let supports hold the rotation of a node between the spans, or those beside a hinge there
    subroutine hold_rotations(seed, decades, sample)
        integer, intent(inout) :: seed
        real(wp), intent(in) :: decades
        type(sample_type), intent(inout) :: sample
        type(node_support_type) :: held
        type(node_support_type), allocatable :: supports(:)
        integer :: i, j, n

        associate (beam => sample%beam)
            n = size(beam%links)
            i = 1 + int((n - 1)*draw(seed))
            select case (int(6*draw(seed)))
            case (0)
                beam%turned = [of_node]
            case (1)
                beam%turned = [of_hinge]
            case (2)
                beam%turned = [left_of_hinge]
            case (3)
                beam%turned = [right_of_hinge]
            case (4)
                beam%turned = [of_hinge_held_left, left_of_hinge]
            case default
                beam%turned = [of_hinge, right_of_hinge]
            end select
            allocate (beam%turning(size(beam%turned)), source=i)
            beam%kind(i) = merge(plain, hinge, beam%turned(1) == of_node)
            supports = beam%supports
            do j = 1, size(beam%turned)
                held = node_support_type(n + j, both, draw_magnitude(seed, 3.0_wp - decades, 3.0_wp + decades), 0.0_wp)
                if (draw(seed) < 0.3_wp) held%stiffness = infinite()
                if (draw(seed) < 0.5_wp) held%side = merge(above, below, draw(seed) < 0.5_wp)
                if (draw(seed) < 0.5_wp) held%contact = (2*draw(seed) - 1)*draw_magnitude(seed, -6.0_wp, -2.0_wp)
                supports = [supports, held]
            end do
            call order_supports(supports, beam)
        end associate
    end subroutine hold_rotations

    !> Solve it
    subroutine solve(sample, closed, work, outcome, stands)
        type(sample_type), intent(in), target :: sample
        logical, allocatable, intent(out) :: closed(:)
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        !> Is there a solution
        logical, intent(out) :: stands
        type(error_type), allocatable :: error

        allocate (closed(size(sample%beam%supports)))
        closed(:) = .true.
        call new_workspace(sample%beam, work)
        call set_loads(sample%beam, 1.0_wp, work)
        call decide_scheme(sample%beam, detail_of(sample), 1.0_wp, rule_block, closed, work, outcome, error)
        stands = .not. allocated(error) .and. outcome%status == gapbeam_solved
    end subroutine solve

    !> Is anything wrong with what is in the workspace
    logical function is_refused(sample, closed, outcome, work, reaction)
        type(sample_type), intent(in) :: sample
        logical, intent(in) :: closed(:)
        type(outcome_type), intent(in) :: outcome
        type(workspace_type), intent(in) :: work
        real(wp), intent(in) :: reaction(:)
        type(ledger_type) :: ledger

        call audit_beam(sample%beam, closed, outcome%undecided, outcome%indifferent, 1.0_wp, work%answers, work%shear, reaction, &
                        work, ledger)
        is_refused = ledger%wrong /= 0
    end function is_refused

    !> Whatever the magnitudes, residuals are those of rounding
    subroutine what_is_solved_stands()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(ledger_type) :: ledger
        logical, allocatable :: closed(:)
        logical :: stands
        real(wp) :: worst(3)
        integer :: seed, i, solved, refused

        seed = 20261123
        solved = 0
        refused = 0
        worst = 0.0_wp
        do i = 1, 1500
            call draw_beam(seed, 1.0_wp + modulo(i, 3)*2.5_wp, sample)
            call solve(sample, closed, work, outcome, stands)
            if (.not. stands) cycle
            solved = solved + 1
            call audit_beam(sample%beam, closed, outcome%undecided, outcome%indifferent, 1.0_wp, work%answers, work%shear, &
                            work%reaction, work, ledger, measured=.true.)
            if (ledger%wrong /= 0) refused = refused + 1
            worst = max(worst, audit_residuals(ledger))
        end do
        call check(solved > 1200, "most beams drawn stand")
        call check(refused == 0, "what is solved stands its audit")
        call check(all(worst < 64*epsilon(1.0_wp)) .and. worst(1) > 0.0_wp .and. worst(2) > 0.0_wp, &
                   "residuals are measured, and small")
    end subroutine what_is_solved_stands

    !> Every number, one after the other, and every state
    subroutine what_is_broken_is_found()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        logical, allocatable :: closed(:), other(:)
        real(wp), allocatable :: reaction(:)
        real(wp) :: kept
        logical :: stands
        integer :: seed, i, k, n, of_each(6), found(6)

        seed = 4711
        of_each = 0
        found = 0
        do i = 1, 200
            call draw_beam(seed, 1.0_wp, sample)
            call solve(sample, closed, work, outcome, stands)
            if (.not. stands .or. outcome%indifferent) cycle
            n = size(sample%beam%links)
            reaction = work%reaction
            do k = 1, size(reaction)
                if (abs(reaction(k)) > share*maxval(abs(reaction))) then
                    reaction(k) = reaction(k)*(1 + share)
                    call note_case(of_each(1), found(1), is_refused(sample, closed, outcome, work, reaction))
                    reaction(k) = work%reaction(k)
                end if
                if (sample%beam%supports(k)%side == both .or. outcome%undecided(k)) cycle
                other = closed
                other(k) = .not. closed(k)
                call note_case(of_each(2), found(2), is_refused(sample, other, outcome, work, reaction))
            end do
            do k = 0, n
                associate (a => work%answers(k))
                    if (abs(a%deflection) > 1e-3_wp*maxval(abs(work%answers%deflection))) then
                        kept = a%deflection
                        a%deflection = kept*(1 + share)
                        call note_case(of_each(3), found(3), is_refused(sample, closed, outcome, work, reaction))
                        a%deflection = kept
                    end if
                    if (abs(a%moment_left) > 1e-3_wp*maxval(abs(work%answers%moment_left))) then
                        kept = a%moment_left
                        a%moment_left = kept*(1 + share)
                        call note_case(of_each(4), found(4), is_refused(sample, closed, outcome, work, reaction))
                        a%moment_left = kept
                    end if
                    if (abs(a%moment_right) > 1e-3_wp*maxval(abs(work%answers%moment_right))) then
                        kept = a%moment_right
                        a%moment_right = kept*(1 + share)
                        call note_case(of_each(5), found(5), is_refused(sample, closed, outcome, work, reaction))
                        a%moment_right = kept
                    end if
                end associate
            end do
            do k = 1, n
                if (abs(work%shear(k)) < 1e-3_wp*maxval(abs(work%shear))) cycle
                kept = work%shear(k)
                work%shear(k) = kept*(1 + share)
                call note_case(of_each(6), found(6), is_refused(sample, closed, outcome, work, reaction))
                work%shear(k) = kept
            end do
        end do
        call check(all(of_each > 100), "there is enough of everything to break")
        call check(found(1) == of_each(1), "a reaction that is another one")
        call check(found(2) == of_each(2), "a state that is another one")
        call check(found(3) == of_each(3), "a deflection")
        call check(found(4) == of_each(4), "a moment left of a node, or of its restraint")
        call check(found(5) == of_each(5), "a moment right of a node")
        call check(found(6) == of_each(6), "a shear")
    end subroutine what_is_broken_is_found

    !> Where nothing acts, the points by which lines of laws are known leave their rounding, and no force beside that
    subroutine lines_without_force()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        logical, allocatable :: closed(:)
        real(wp), allocatable :: reaction(:)
        logical :: stands
        integer :: k

        call make_beam([3.0_wp, 2.0_wp], [100.0_wp, 100.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, both, infinite(), 0.0_wp), &
                        node_support_type(2, both, 700.0_wp, 0.1_wp, 1, .false., .true., 70.0_wp, 700.0_wp)], sample)
        sample%beam%turned = [of_node]
        sample%beam%turning = [1]
        call order_supports([sample%beam%supports, node_support_type(3, both, 70.0_wp, 0.1_wp, 1, .false., .true., 7.0_wp, &
                                                                    70.0_wp)], sample%beam)
        call solve(sample, closed, work, outcome, stands)
        call check(stands, "a beam on which nothing acts")
        reaction = work%reaction
        do k = 1, size(reaction)
            reaction(k) = 1e-18_wp
            call check(is_refused(sample, closed, outcome, work, reaction), "a force that nothing makes")
            reaction(k) = work%reaction(k)
        end do
    end subroutine lines_without_force

    !> The solution of a beam in which there is no hinge, or whose restraint is on its other side, or in it
    subroutine another_hinge()
        integer, parameter :: turned(4) = [of_node, left_of_hinge, right_of_hinge, of_hinge]
        type(sample_type), target :: sample(4)
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        logical, allocatable :: closed(:)
        logical :: stands, refused(4)
        integer :: i, j

        do i = 1, 4
            call make_beam([3.0_wp, 2.0_wp], [100.0_wp, 100.0_wp], [0.0_wp, 0.0_wp], [1.0_wp, 2.0_wp], &
                           [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, both, infinite(), 0.0_wp), &
                            node_support_type(2, both, infinite(), 0.0_wp)], sample(i))
            sample(i)%beam%turned = turned(i:i)
            sample(i)%beam%turning = [1]
            sample(i)%beam%kind(1) = merge(plain, hinge, turned(i) == of_node)
            call order_supports([sample(i)%beam%supports, node_support_type(3, both, 50.0_wp, 0.0_wp)], sample(i)%beam)
        end do
        do i = 1, 4
            call solve(sample(i), closed, work, outcome, stands)
            do j = 1, 4
                refused(j) = is_refused(sample(j), closed, outcome, work, work%reaction)
            end do
            call check(stands .and. all(refused .neqv. turned == turned(i)), "only the beam that was solved")
        end do
    end subroutine another_hinge

    !> One of a kind broken; was it refused
    subroutine note_case(of_each, found, refused)
        integer, intent(inout) :: of_each, found
        logical, intent(in) :: refused

        of_each = of_each + 1
        if (refused) found = found + 1
    end subroutine note_case

    !> Two rigid supports at one place that each are said to take the whole force
    subroutine rigid_supports_side_by_side()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        logical, allocatable :: closed(:)
        logical :: stands

        call make_beam([2.0_wp, 2.0_wp], [100.0_wp, 100.0_wp], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], &
                       [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.0_wp), &
                        node_support_type(1, below, infinite(), 0.0_wp), node_support_type(2, both, infinite(), 0.0_wp)], sample)
        call solve(sample, closed, work, outcome, stands)
        call check(stands, "one of them may take it all")
        closed(:) = .true.
        work%reaction(2:3) = maxval(work%reaction(2:3))
        outcome%undecided(:) = .false.
        call check(is_refused(sample, closed, outcome, work, work%reaction), "but not both")
    end subroutine rigid_supports_side_by_side

    !> The system along the beam
    subroutine bars()
        real(wp), parameter :: flexibility(3) = [1.0_wp, 0.0_wp, 3.0_wp], force(0:3) = [1.0_wp, -2.0_wp, 0.3_wp, 4.0_wp]
        real(wp) :: stiffness(0:3), settlement(0:3), displacement(0:3), tension(3), reaction(0:3)
        type(ledger_type) :: ledger
        integer :: state, place, i

        stiffness = [2.0_wp, 0.0_wp, infinite(), 0.5_wp]
        settlement = [0.0_wp, 0.0_wp, 0.1_wp, 0.2_wp]
        call solve_axial(flexibility, 0*flexibility, force, stiffness, settlement, displacement, tension, reaction, state, place)
        call check(state == axial_ok, "bars hold")
        call audit_axial(flexibility, 0*flexibility, force, stiffness, settlement, displacement, tension, reaction, ledger)
        call check(ledger%wrong == 0, "and stand their audit")
        do i = 0, 3
            displacement(i) = displacement(i) + share
            call audit_axial(flexibility, 0*flexibility, force, stiffness, settlement, displacement, tension, reaction, ledger)
            call check(ledger%wrong /= 0, "a displacement that is another one")
            displacement(i) = displacement(i) - share
            reaction(i) = reaction(i) + share
            call audit_axial(flexibility, 0*flexibility, force, stiffness, settlement, displacement, tension, reaction, ledger)
            call check(ledger%wrong /= 0, "a reaction that is another one")
            reaction(i) = reaction(i) - share
        end do
        do i = 1, 3
            tension(i) = tension(i) + share
            call audit_axial(flexibility, 0*flexibility, force, stiffness, settlement, displacement, tension, reaction, ledger)
            call check(ledger%wrong /= 0, "a force in a bar that is another one")
            tension(i) = tension(i) - share
        end do
    end subroutine bars

end program test_audit
