!> Supports that hold rotations, beside closed forms: yielding clamps and hinges, slack, feet that tip, springs
program test_turning
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, detail_of, infinite
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_band, only: hinge
    use gapbeam_model, only: node_support_type, order_supports, below, above, both, of_node, of_hinge
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: decide_scheme
    implicit none
    integer :: status

    call yielding_clamps()
    call slack_hinge()
    call tipping_foot()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A law that holds rigidly until a couple, and then yields
    pure function rigid_plastic(node, most) result(law)
        integer, intent(in) :: node
        real(wp), intent(in) :: most
        type(node_support_type) :: law(2)

        law(1) = node_support_type(node, below, infinite(), 0.0_wp, 1, .true., force=-most)
        law(2) = node_support_type(node, below, 0.0_wp, 0.0_wp, 2, force=most, before=infinite())
    end function rigid_plastic

    !> Solve, without turning what comes out into more than numbers
    subroutine solve(sample, factor, closed, work, outcome)
        type(sample_type), intent(in), target :: sample
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable :: error

        call new_workspace(sample%beam, work)
        call set_loads(sample%beam, factor, work)
        call decide_scheme(sample%beam, detail_of(sample), factor, rule_block, closed, work, outcome, error)
        if (allocated(error)) print *, error%message
        call check(.not. allocated(error), "no error")
    end subroutine solve

    !> Clamps and a hinge at midspan that yield at 1: the clamps at q L^2 = 12, a mechanism at 16 (ratio 4/3)
    subroutine yielding_clamps()
        type(sample_type) :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(node_support_type) :: supports(8)
        logical :: closed(8)
        real(wp) :: q

        supports(1) = node_support_type(0, both, infinite(), 0.0_wp)
        supports(2) = node_support_type(2, both, infinite(), 0.0_wp)
        supports(3:4) = rigid_plastic(3, 1.0_wp)
        supports(5:6) = rigid_plastic(4, 1.0_wp)
        supports(7:8) = rigid_plastic(5, 1.0_wp)
        call make_beam([0.5_wp, 0.5_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], supports(1:2), sample)
        sample%beam%turning = [0, 2, 1]
        sample%beam%turned = [of_node, of_node, of_hinge]
        sample%beam%kind(1) = hinge
        call order_supports(supports, sample%beam)
        closed = [.true., .true., .true., .false., .true., .false., .true., .false.]
        q = 11
        call solve(sample, q, closed, work, outcome)
        call check(outcome%status == gapbeam_solved, "solved")
        call check(all(closed .eqv. [.true., .true., .true., .false., .true., .false., .true., .false.]), "all hold")
        call check_close(work%answers(0:1)%moment_right, [-q/12, q/24], "clamped beam")
        call check_close(work%reaction(3:8), [q/12, 0.0_wp, -q/12, 0.0_wp, q/24, 0.0_wp], "couples")
        q = 14
        call solve(sample, q, closed, work, outcome)
        call check(outcome%status == gapbeam_solved, "solved after the clamps yield")
        call check(all(closed .eqv. [.true., .true., .true., .true., .false., .false., .true., .false.]), "both yield")
        call check_close(work%answers(0:1)%moment_right, [-1.0_wp, q/8 - 1], "clamps that yield")
        ! Rotation of the ends, simply supported: q L^3/24 - M L/2
        call check_close(work%answers(3:5)%deflection, [q/24 - 0.5_wp, -(q/24 - 0.5_wp), 0.0_wp], "rotations")
        q = 16.5_wp
        closed = [.true., .true., .true., .false., .true., .false., .true., .false.]
        call solve(sample, q, closed, work, outcome)
        call check(outcome%status == gapbeam_no_equilibrium, "a mechanism")
        if (allocated(outcome%motion)) call check_close(outcome%motion, [0.0_wp, 1.0_wp, 0.0_wp], "its motion")
    end subroutine yielding_clamps

    !> Three supports, and a hinge in the first span that is free between two angles
    subroutine slack_hinge()
        type(sample_type) :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(node_support_type) :: supports(4)
        logical :: closed(4)
        real(wp) :: q, slack, moment

        slack = 0.125_wp
        supports(1) = node_support_type(0, both, infinite(), 0.0_wp)
        supports(2) = node_support_type(2, both, infinite(), 0.0_wp)
        supports(3) = node_support_type(4, below, infinite(), slack)
        supports(4) = node_support_type(4, above, infinite(), -slack)
        ! A propped cantilever: clamp on the right
        call make_beam([0.5_wp, 0.5_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], supports(1:2), sample)
        sample%beam%kind(2) = 2
        sample%beam%turning = [0, 1]
        sample%beam%turned = [of_node, of_hinge]
        sample%beam%kind(1) = hinge
        call order_supports(supports, sample%beam)
        closed = .false.
        closed(1:2) = .true.
        q = 1
        call solve(sample, q, closed, work, outcome)
        call check(.not. any(closed(3:4)), "within the slack")
        ! Half the load goes through the hinge as q/4 to the tip of a cantilever, tip q/8/... by superposition
        call check_close(work%answers(1)%deflection, q/128 + q/4/24, "cantilever with a suspended half")
        q = 8
        call solve(sample, q, closed, work, outcome)
        call check(closed(3) .and. .not. closed(4), "at the end of the slack")
        call check_close(work%answers(4)%deflection, slack, "rotation")
        ! Propped cantilever with a kink in its middle: R = 3qL/8 - 3 EI kink (1/2)/L^2
        moment = (3*q/8 - 1.5_wp*slack)/2 - q/8
        call check_close(work%answers(1)%moment_left, moment, "moment in the hinge")
        call check_close(work%reaction(3), moment, "is its couple")
    end subroutine slack_hinge

    !> A clamp that turns the beam clockwise only
    subroutine tipping_foot()
        type(sample_type) :: sample
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(node_support_type) :: supports(3)
        logical :: closed(3)

        supports(1) = node_support_type(0, both, infinite(), 0.0_wp)
        supports(2) = node_support_type(1, both, infinite(), 0.0_wp)
        supports(3) = node_support_type(2, below, infinite(), 0.0_wp)
        call make_beam([1.0_wp], [1.0_wp], [0.0_wp], [1.0_wp], supports(1:2), sample)
        sample%beam%turning = [0]
        sample%beam%turned = [of_node]
        call order_supports(supports, sample%beam)
        closed = .true.
        call solve(sample, 8.0_wp, closed, work, outcome)
        call check(closed(3), "held")
        call check_close(work%reaction(3), 1.0_wp, "couple")
        call check_close(work%answers(0)%moment_right, -1.0_wp, "moment")
        call solve(sample, -8.0_wp, closed, work, outcome)
        call check(.not. closed(3), "lets go")
        call check_close(work%answers(2)%deflection, -8/24.0_wp, "rotation of a simple beam")
    end subroutine tipping_foot

end program test_turning
