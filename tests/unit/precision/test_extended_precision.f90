!> What doubles decide, quadruple precision decides likewise; what they cannot is decided there, or named
program test_extended_precision
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, detail_of, draw, draw_magnitude, infinite
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_model, only: node_support_type, below, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_rules, only: find_doubtful
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_extended_precision, only: decide_scheme
    use gapbeam_refined, only: refine_loaded_beam
    use gapbeam_model_quad, only: fine_beam_type => beam_type
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_contact_state_quad, only: find_fine_contact_state => find_contact_state, &
        fine_outcome_type => outcome_type
    implicit none
    integer :: status

    call both_precisions_agree()
    call every_start_agrees()
    call a_tie_is_named()
    call a_spring_out_of_reach()
    call a_stiff_spring_beside_a_soft_one()
    call a_spring_beside_a_far_softer_link()
    call an_overhang_on_next_to_nothing()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A beam of 2 to 5 spans with lengths, stiffnesses, gaps and loads of mixed magnitudes
    subroutine draw_beam(seed, sample)
        integer, intent(inout) :: seed
        type(sample_type), intent(out) :: sample
        type(node_support_type), allocatable :: supports(:)
        real(wp), allocatable :: length(:), ei(:), dead(:), live(:)
        integer :: i, n

        n = 2 + int(4*draw(seed))
        allocate (length(n), ei(n), dead(n), live(n), supports(n + 1))
        do i = 1, n
            length(i) = draw_magnitude(seed, -1.0_wp, 1.0_wp)
            ei(i) = draw_magnitude(seed, -2.0_wp, 6.0_wp)
            dead(i) = merge(draw(seed), 0.0_wp, draw(seed) < 0.5_wp)
            live(i) = merge(2*draw(seed) - 1, 0.0_wp, draw(seed) < 0.5_wp)
        end do
        do i = 0, n
            supports(i + 1) = node_support_type(i, int(3*draw(seed)) - 1, infinite(), 0.0_wp)
            if (draw(seed) < 0.3_wp) supports(i + 1)%side = below
            if (draw(seed) < 0.4_wp) supports(i + 1)%stiffness = draw_magnitude(seed, -2.0_wp, 8.0_wp)
            if (draw(seed) < 0.5_wp) supports(i + 1)%contact = (2*draw(seed) - 1)*draw_magnitude(seed, -6.0_wp, 0.0_wp)
        end do
        call make_beam(length, ei, dead, live, supports, sample)
        do i = 0, n
            if (draw(seed) < 0.4_wp) sample%beam%force(2, i) = (2*draw(seed) - 1)*draw_magnitude(seed, -3.0_wp, 3.0_wp)
        end do
    end subroutine draw_beam

    !> Where the search in doubles has no doubt, its outcome, scheme and reactions are those of quadruple precision
    subroutine both_precisions_agree()
        integer, parameter :: beams_drawn = 1000
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        type(fine_beam_type) :: fine
        type(fine_workspace_type) :: fine_work
        type(fine_outcome_type) :: found
        logical, allocatable :: closed(:), fine_closed(:), doubtful(:)
        integer :: seed, i, different, compared, solved

        seed = 20261121
        different = 0
        compared = 0
        solved = 0
        do i = 1, beams_drawn
            call draw_beam(seed, sample)
            associate (m => size(sample%beam%supports))
                if (allocated(closed)) deallocate (closed, fine_closed, doubtful)
                allocate (closed(m), fine_closed(m), doubtful(m))
            end associate
            closed(:) = .true.
            fine_closed(:) = .true.
            call new_workspace(sample%beam, work)
            call set_loads(sample%beam, 1.0_wp, work)
            call find_contact_state(sample%beam, 1.0_wp, rule_block, closed, work, outcome, error)
            if (allocated(error) .or. outcome%in_doubt) cycle
            if (outcome%status == gapbeam_solved) then
                call find_doubtful(sample%beam, closed, work, doubtful)
                if (any(doubtful)) cycle
                solved = solved + 1
            end if
            compared = compared + 1
            call refine_loaded_beam(sample%beam, detail_of(sample), 1.0_qp, fine, fine_work)
            call find_fine_contact_state(fine, 1.0_qp, rule_block, fine_closed, fine_work, found, error)
            if (allocated(error)) then
                different = different + 1
            else if (found%status /= outcome%status) then
                different = different + 1
            else if (outcome%status == gapbeam_solved) then
                if (any(closed .neqv. fine_closed)) then
                    different = different + 1
                else if (any(abs(real(fine_work%reaction, wp) - work%reaction) &
                             > 32*work%reaction_error + 64*epsilon(1.0_wp)*maxval(abs(work%reaction)))) then
                    different = different + 1
                end if
            end if
        end do
        call check(compared > 3*beams_drawn/4, "of most beams drawn doubles have no doubt")
        call check(solved > beams_drawn/2 .and. compared - solved > beams_drawn/20, "with and without equilibrium")
        call check(different == 0, "quadruple precision agrees where doubles have no doubt")
    end subroutine both_precisions_agree

    !> Outcome and scheme do not depend on the start
    subroutine every_start_agrees()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome, first_outcome
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:), first(:)
        real(wp), allocatable :: reaction(:)
        integer :: seed, i, start, k, different

        seed = 31
        different = 0
        do i = 1, 60
            call draw_beam(seed, sample)
            associate (m => size(sample%beam%supports))
                do start = 0, 2**m - 1
                    closed = [(btest(start, k - 1), k=1, m)]
                    call new_workspace(sample%beam, work)
                    call set_loads(sample%beam, 1.0_wp, work)
                    call decide_scheme(sample%beam, detail_of(sample), 1.0_wp, rule_block, closed, work, outcome, error)
                    if (allocated(error)) then
                        different = different + 1
                        cycle
                    end if
                    if (start == 0) then
                        first_outcome = outcome
                        first = closed
                        reaction = work%reaction
                    else if (outcome%status /= first_outcome%status) then
                        different = different + 1
                    else if (outcome%status == gapbeam_solved) then
                        if (any((closed .neqv. first) .and. .not. (outcome%undecided .and. first_outcome%undecided)) .or. &
                            any(abs(work%reaction - reaction) > 32*work%reaction_error &
                                + 64*epsilon(1.0_wp)*maxval(abs(reaction)))) then
                            different = different + 1
                        end if
                    end if
                end do
            end associate
        end do
        call check(different == 0, "from every start the same")
    end subroutine every_start_agrees

    !> A reaction that is zero but for the last digits of the data: either state is right, and the support is named. A load that
    !> is larger by a little lifts it
    subroutine a_tie_is_named()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(3)
        integer :: i, start
        real(wp), parameter :: l = 0.7_wp, weight = 0.1_wp

        do start = 0, 1
            ! The far end lifts when the load of the first span is more than six times the weight
            call make_beam([l, l], [1.0_wp, 1.0_wp], [weight, weight], [0.6_wp, 0.0_wp], &
                           [(node_support_type(i, below, infinite(), 0.0_wp), i=0, 2)], sample)
            closed = [.true., .true., start == 1]
            call decide(sample, closed, work, outcome, error)
            call check(.not. allocated(error) .and. outcome%status == gapbeam_solved, "a tie is solved")
            call check(all(outcome%undecided .eqv. [.false., .false., .true.]), "and named")
            call check_close(work%reaction, [3.0_wp, 5.0_wp, 0.0_wp]*weight*l, "its reaction is zero", &
                             absolute=1e-16_wp)
            call make_beam([l, l], [1.0_wp, 1.0_wp], [weight, weight], [0.6_wp*(1 + 1e-13_wp), 0.0_wp], &
                           [(node_support_type(i, below, infinite(), 0.0_wp), i=0, 2)], sample)
            closed = [.true., .true., start == 1]
            call decide(sample, closed, work, outcome, error)
            call check(all(closed .eqv. [.true., .true., .false.]), "a little more load lifts it")
            call check(.not. any(outcome%undecided), "without doubt")
        end do
    end subroutine a_tie_is_named

    !> A spring far stiffer than all else, 1 mm beyond where the beam comes to rest on a soft one: open
    subroutine a_spring_out_of_reach()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(3)
        integer :: start
        real(wp) :: stiffness

        stiffness = 1e12_wp
        do while (stiffness < 1e20_wp)
            do start = 0, 1
                call make_beam([5.0_wp], [1e4_wp], [0.0_wp], [0.0_wp], &
                               [node_support_type(0, below, stiffness, 0.04_wp), node_support_type(0, both, 100.0_wp, 0.0_wp), &
                                node_support_type(1, both, infinite(), 0.0_wp)], sample)
                sample%beam%force(2, 0) = 3.9_wp
                closed = [start == 1, .true., .true.]
                call decide(sample, closed, work, outcome, error)
                call check(.not. closed(1) .and. .not. outcome%undecided(1), "a stiff spring out of reach is open")
                call check_close(work%answers(0)%deflection, 0.039_wp, "the soft one carries all", 1e-15_wp)
            end do
            stiffness = 1000*stiffness
        end do
    end subroutine a_spring_out_of_reach

    !> Two springs at one place, one of them far stiffer: both reactions have all their digits
    subroutine a_stiff_spring_beside_a_soft_one()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(3)
        real(wp) :: exact
        real(wp), parameter :: stiff = 1e10_wp, soft = 2.0_wp, contact = 0.5_wp, force = 21.0_wp

        call make_beam([4.0_wp], [1e3_wp], [0.0_wp], [0.0_wp], &
                       [node_support_type(0, below, stiff, contact), node_support_type(0, both, soft, 0.0_wp), &
                        node_support_type(1, both, infinite(), 0.0_wp)], sample)
        sample%beam%force(1, 0) = force
        closed = .true.
        call decide(sample, closed, work, outcome, error)
        exact = real(stiff*(real(force, qp) - soft*real(contact, qp))/(stiff + real(soft, qp)), wp)
        call check_close(work%reaction, [exact, force - exact, 0.0_wp], "both have their digits", 4e-16_wp)
    end subroutine a_stiff_spring_beside_a_soft_one

    !> A link of 1e-29 swings so far that even quadruple precision seems to know nothing of what presses on the spring beside it
    subroutine a_spring_beside_a_far_softer_link()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(4)
        integer :: start

        do start = 0, 1
            call make_beam([3.0_wp, 3.0_wp, 2.0_wp, 2.0_wp], [1e4_wp, 1e-29_wp, 1e4_wp, 1e4_wp], spread(0.0_wp, 1, 4), &
                           spread(0.0_wp, 1, 4), &
                           [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(2, below, 1e3_wp, 0.0_wp), &
                            node_support_type(3, both, infinite(), 0.0_wp), node_support_type(4, both, infinite(), 0.0_wp)], &
                           sample)
            sample%beam%force(1, 1) = 322.0_wp
            closed = [.true., start == 1, .true., .true.]
            call decide(sample, closed, work, outcome, error)
            call check(closed(2), "the spring beside a far softer link is pressed")
            ! The moments in the soft link are as small as they may be; what they leave the rest is a beam with an overhang
            call check_close(work%reaction(:2), [115.0_wp, 132.0_wp], "and carries its share", 1e-12_wp)
        end do
    end subroutine a_spring_beside_a_far_softer_link

    !> A spring of 1e-28 at the tip of an overhang holds nothing, and the tip goes where the loads bend it
    subroutine an_overhang_on_next_to_nothing()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(3)
        ! q a (3 a**3 + 4 a**2 b - b**3)/(24 EI)
        real(wp), parameter :: a = 3.0_wp, b = 4.0_wp, ei = 1e4_wp, tip = a*(3*a**3 + 4*a**2*b - b**3)/(24*ei)

        call make_beam([a, b], [ei, ei], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, both, 1e-28_wp, 0.0_wp), node_support_type(1, both, infinite(), 0.0_wp), &
                        node_support_type(2, both, infinite(), 0.0_wp)], sample)
        closed = .true.
        call decide(sample, closed, work, outcome, error)
        call check_close(work%answers(0)%deflection, tip, "a tip on next to nothing is bent by its loads", 1e-14_wp)
    end subroutine an_overhang_on_next_to_nothing

    !> The scheme of dead and live loads
    subroutine decide(sample, closed, work, outcome, error)
        type(sample_type), intent(in), target :: sample
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error

        call new_workspace(sample%beam, work)
        call set_loads(sample%beam, 1.0_wp, work)
        call decide_scheme(sample%beam, detail_of(sample), 1.0_wp, rule_block, closed, work, outcome, error)
    end subroutine decide

end program test_extended_precision
