!> Contact states: the paper's beam from every start, cycling, floating beams, free motions
program test_contact_state
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, draw, draw_magnitude
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_indeterminate
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_band, only: hinge, restrained
    use gapbeam_model, only: beam_type, node_support_type, order_supports, below, above, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    implicit none
    integer :: status

    call paper_beam()
    call smallest_cycle()
    call plank()
    call rigid_plank()
    call boundaries()
    call parts_that_cannot_be_settled()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Infinity without an exception
    pure function infinite() result(value)
        use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
        real(wp) :: value

        value = ieee_value(value, ieee_positive_inf)
    end function infinite

    !> Equal spans without loads
    subroutine make(n, length, ei, beam)
        integer, intent(in) :: n
        real(wp), intent(in) :: length, ei
        type(beam_type), intent(out) :: beam
        type(piece_load_type) :: none(1)
        real(wp) :: work(1)
        integer :: i

        none = piece_load_type(0, 0, 0, 0, 0)
        allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
        do i = 1, n
            call condense_link([piece_type(length, 1/ei, 0.0_wp)], none, none, work, beam%links(i))
        end do
        beam%kind = 0
        beam%compliance = 0.0_wp
        beam%force = 0.0_wp
        beam%couple = 0.0_wp
    end subroutine make

    !> Reference problem P1
    subroutine paper_beam()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(4)
        integer :: start, rule, most
        real(wp), parameter :: f2 = 0.70707_wp, f3 = -4.3597_wp, f4 = 2.1155_wp

        call make(3, 2.0_wp, 44.5_wp, beam)
        beam%kind(0) = restrained
        beam%force(2, :) = [0.0_wp, f2, f3, f4]
        call order_supports([node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, above, infinite(), 0.0_wp), &
                         node_support_type(2, below, infinite(), 0.0_wp), node_support_type(3, below, infinite(), 0.0_wp)], beam)
        most = 0
        do rule = rule_block, rule_single
            do start = 0, 7
                closed = [.true., btest(start, 0), btest(start, 1), btest(start, 2)]
                call new_workspace(beam, work)
                call set_loads(beam, 1.0_wp, work)
                call find_contact_state(beam, 1.0_wp, rule, closed, work, outcome, error)
                call check(.not. allocated(error) .and. outcome%status == gapbeam_solved, "solved")
                call check(all(closed .eqv. [.true., .true., .false., .true.]), "supports 2 and 4 act, 3 is open")
                call check_close(work%reaction(2:4), [f2 + 23*f3/22, 0.0_wp, f4 + 4*f3/11], "reactions")
                call check_close(work%answers(2)%deflection, 13*f3*8/(132*44.5_wp), "lift-off")
                ! The paper starts with all supports closed
                if (rule == rule_block .or. start == 7) most = max(most, work%solves)
            end do
        end do
        call check(most <= 3, "three solves at most: by block from all eight starts, by the paper's rule from its own")
    end subroutine paper_beam

    !> Reference problem P6: changing all wrong supports at once cycles with period 3
    subroutine smallest_cycle()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(5)
        integer :: rule, start

        call make(4, 1.0_wp, 1000.0_wp, beam)
        beam%force(2, 1:2) = [-80.0_wp, 35.0_wp]
        call order_supports([node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, above, 1e6_wp, 0.009_wp), &
                         node_support_type(2, below, 1e8_wp, 0.018_wp), node_support_type(3, below, 1e6_wp, -0.012_wp), &
                         node_support_type(4, both, infinite(), 0.0_wp)], beam)
        do rule = rule_block, rule_single
            do start = 0, 7
                closed = [.true., btest(start, 0), btest(start, 1), btest(start, 2), .true.]
                call new_workspace(beam, work)
                call set_loads(beam, 1.0_wp, work)
                call find_contact_state(beam, 1.0_wp, rule, closed, work, outcome, error)
                call check(all(closed .eqv. [.true., .true., .false., .true., .true.]), "closed, open, closed")
                call check_close(work%answers(1:3)%deflection, [0.00888281_wp, 0.00046923_wp, -0.01191242_wp], &
                                 "deflections", 1e-6_wp)
            end do
        end do
    end subroutine smallest_cycle

    !> Two equal spans on three one-sided supports, nothing bilateral: own weight g, q on the left span; then a
    !> force on an overhang that tips the beam
    subroutine plank()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        type(piece_load_type) :: dead(1), live(1)
        logical :: closed(3)
        real(wp) :: space(1)
        integer :: i

        call make(2, 1.0_wp, 1.0_wp, beam)
        dead = piece_load_type(1, 1, 0, 0, 0)
        do i = 1, 2
            live = piece_load_type(merge(10.0_wp, 0.0_wp, i == 1), merge(10.0_wp, 0.0_wp, i == 1), 0, 0, 0)
            call condense_link([piece_type(1.0_wp, 1.0_wp, 0.0_wp)], dead, live, space, beam%links(i))
        end do
        call order_supports([(node_support_type(i, below, infinite(), 0.0_wp), i=0, 2)], beam)
        closed = .true.
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call find_contact_state(beam, 1.0_wp, rule_block, closed, work, outcome, error)
        call check_close(work%reaction, [5.0_wp, 7.0_wp, 0.0_wp], "the far end lifts")
        call check_close(work%answers(2)%deflection, -1/6.0_wp, "by (q - 6 g) l**4/24 EI")
        beam%supports(3)%node = 1
        call order_supports([(node_support_type(i, below, infinite(), 0.0_wp), i=0, 1)], beam)
        beam%force(2, 2) = 100.0_wp
        closed = .true.
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call find_contact_state(beam, 1.0_wp, rule_block, closed(1:2), work, outcome, error)
        call check(.not. allocated(error) .and. outcome%status == gapbeam_no_equilibrium, "the plank tips")
        call check_close(outcome%motion, [-1.0_wp, 0.0_wp, 1.0_wp], "about the middle support")
    end subroutine plank

    !> A rigid plank on three rigid supports that hold both ways cannot be resolved; on one-sided ones neither
    subroutine rigid_plank()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(3)
        integer :: i

        call make(2, 1.0_wp, infinite(), beam)
        call order_supports([(node_support_type(i, both, infinite(), 0.0_wp), i=0, 2)], beam)
        beam%force(1, 1) = 1.0_wp
        closed = .true.
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call find_contact_state(beam, 1.0_wp, rule_block, closed, work, outcome, error)
        call check(allocated(error), "refused")
        if (allocated(error)) call check(error%code == gapbeam_indeterminate, "as not determined")
    end subroutine rigid_plank

    !> A beam on 2,001 rigid one-sided supports, its weight as nodal forces, lifted at its left end and in the middle, and the
    !> same with its left half turned upside down; then lifted a little less, from the scheme found
    subroutine boundaries()
        integer, parameter :: n = 2000
        real(wp), parameter :: spacing = 0.01_wp
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:)
        integer :: i, side, step
        real(wp) :: lift

        call make(n, spacing, 1.0_wp, beam)
        allocate (closed(n + 1))
        do side = -1, 1, 2
            call order_supports([(node_support_type(i, merge(side, 1, i < n/2), infinite(), 0.0_wp), i=0, n)], beam)
            do i = 0, n
                beam%force(1, i) = merge(side, 1, i < n/2)*spacing
            end do
            closed = .true.
            do step = 1, 2
                lift = merge(1.0_wp, 0.999_wp, step == 1)
                beam%force(2, 0) = -side*1.5_wp*lift
                beam%force(2, 3*n/4) = -lift
                call new_workspace(beam, work)
                call set_loads(beam, 1.0_wp, work)
                call find_contact_state(beam, 1.0_wp, rule_block, closed, work, outcome, error)
                call check(.not. allocated(error) .and. outcome%status == gapbeam_solved, "solved")
                call check(work%solves <= merge(30, 8, step == 1), "in few solves")
                ! Statics of the lifted end: 1.5 x = q x**2/2 at x = 3
                call check(all(.not. closed(:298)) .and. any(closed(299:303)), "3 long")
                call check(.not. any(closed(3*n/4 - 20:3*n/4 + 20)), "lifted in the middle")
                call check(minval(beam%supports%side*work%reaction) > -1e-9_wp, "no support pulls")
                call check(maxval(beam%supports%side*work%answers%deflection) < 1e-12_wp, "none is penetrated")
            end do
        end do
    end subroutine boundaries

    !> A beam in pieces between hinges that nothing stops: no part of it can be settled, and the whole is known to have no
    !> equilibrium after some solves (5,000, when rounds without a settled part did not count)
    subroutine parts_that_cannot_be_settled()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:)

        call hinged_beam(500, 558000, beam)
        allocate (closed(size(beam%supports)))
        closed(:) = .true.
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call find_contact_state(beam, 1.0_wp, rule_block, closed, work, outcome, error)
        call check(.not. allocated(error), "parts that cannot be settled: an error")
        call check(outcome%status == gapbeam_no_equilibrium, "parts that cannot be settled: equilibrium")
        call check(work%solves < 600, "parts that cannot be settled: solves")
    end subroutine parts_that_cannot_be_settled

    !> A long beam with a hinge at every fifth node, with springs of any stiffness above and below most nodes
    subroutine hinged_beam(n, start, beam)
        integer, intent(in) :: n, start
        type(beam_type), intent(out) :: beam
        type(sample_type) :: sample
        type(node_support_type) :: supports(n + 1)
        real(wp) :: load(n)
        integer :: i, m, seed

        seed = start
        m = 0
        do i = 0, n
            if (draw(seed) < 0.07_wp) cycle
            m = m + 1
            supports(m) = node_support_type(i, merge(below, above, draw(seed) < 0.7_wp), draw_magnitude(seed, 0.0_wp, 9.0_wp), &
                                            0.1_wp*(draw(seed) - 0.3_wp))
        end do
        do i = 1, n
            load(i) = 35*draw(seed) - 10
        end do
        call make_beam(spread(6.0_wp, 1, n), spread(1e4_wp, 1, n), load, spread(0.0_wp, 1, n), supports(:m), sample)
        beam = sample%beam
        do i = 1, n - 1
            if (draw(seed) < 0.2_wp) beam%kind(i) = hinge
        end do
    end subroutine hinged_beam

end program test_contact_state
