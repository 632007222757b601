!> How far results move when the data change in their last digits: against the same beams solved with changed data
program test_sensitivity
    use testing, only: check, finish
    use beams, only: sample_type, make_beam, detail_of, draw, draw_magnitude, infinite
    use gapbeam_kinds, only: wp, qp
    use gapbeam_model, only: node_support_type, below, both
    use gapbeam_refined, only: refine_beam
    use gapbeam_band_quad, only: band_ok
    use gapbeam_model_quad, only: fine_beam_type => beam_type, is_rigid
    use gapbeam_workspace_quad, only: workspace_type, new_workspace, set_loads
    use gapbeam_system_quad, only: solve_scheme
    use gapbeam_law_margins_quad, only: find_margins
    use gapbeam_sensitivity_quad, only: sensitivity_type, prepare_sensitivity, movement_of_support, largest_movement
    use gapbeam_functionals_quad, only: of_deflections, of_reactions
    implicit none
    integer :: status

    call changed_data()
    call largest_of_all()
    call held_by_nothing()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A beam of 2 to 6 spans, and a scheme that holds it
    subroutine draw_beam(seed, beam, closed)
        integer, intent(inout) :: seed
        type(fine_beam_type), intent(out) :: beam
        logical, allocatable, intent(out) :: closed(:)
        type(sample_type), target :: sample
        type(node_support_type), allocatable :: supports(:)
        real(wp), allocatable :: length(:), ei(:), dead(:), live(:)
        integer :: i, n

        n = 2 + int(5*draw(seed))
        allocate (length(n), ei(n), dead(n), live(n), supports(n + 1), closed(n + 1))
        do i = 1, n
            length(i) = draw_magnitude(seed, -1.0_wp, 1.0_wp)
            ei(i) = draw_magnitude(seed, 0.0_wp, 4.0_wp)
            dead(i) = draw(seed)
            live(i) = 2*draw(seed) - 1
        end do
        do i = 0, n
            supports(i + 1) = node_support_type(i, below, infinite(), draw_magnitude(seed, -6.0_wp, -2.0_wp))
            if (draw(seed) < 0.4_wp) supports(i + 1)%stiffness = draw_magnitude(seed, 0.0_wp, 5.0_wp)
            closed(i + 1) = draw(seed) < 0.5_wp
        end do
        supports(1)%side = both
        supports(n + 1)%side = both
        closed([1, n + 1]) = .true.
        call make_beam(length, ei, dead, live, supports, sample)
        do i = 0, n
            if (draw(seed) < 0.4_wp) sample%beam%force(:, i) = [draw(seed), 2*draw(seed) - 1]
        end do
        call refine_beam(sample%beam, detail_of(sample), beam)
    end subroutine draw_beam

    !> The same with every number of the system changed as if it had been rounded to a double
    subroutine change_data(seed, beam, changed)
        integer, intent(inout) :: seed
        type(fine_beam_type), intent(in) :: beam
        type(fine_beam_type), intent(out) :: changed
        integer :: i, k

        changed = beam
        do i = 1, size(beam%links)
            associate (link => changed%links(i))
                link%inverse = link%inverse*one(seed)
                link%length = 1/link%inverse
                link%faa = link%faa*one(seed)
                link%fab = link%fab*one(seed)
                link%fbb = link%fbb*one(seed)
                link%sum_a = link%faa + link%fab
                link%sum_b = link%fab + link%fbb
                link%bending = link%sum_a + link%sum_b
                link%determinant = link%faa*link%fbb - link%fab**2
                do k = 1, 2
                    link%turn_a(k) = link%turn_a(k)*one(seed)
                    link%turn_b(k) = link%turn_b(k)*one(seed)
                    link%shear_a(k) = link%shear_a(k)*one(seed)
                    link%shear_b(k) = link%shear_b(k)*one(seed)
                end do
            end associate
        end do
        do i = 0, size(beam%links)
            do k = 1, 2
                changed%force(k, i) = changed%force(k, i)*one(seed)
            end do
        end do
        do k = 1, size(beam%supports)
            changed%supports(k)%contact = changed%supports(k)%contact*one(seed)
            if (.not. is_rigid(changed%supports(k))) changed%supports(k)%stiffness = changed%supports(k)%stiffness*one(seed)
        end do
    end subroutine change_data

    !> One, but for half a unit in the last place of a double up or down
    function one(seed) result(factor)
        integer, intent(inout) :: seed
        real(qp) :: factor

        factor = 1 + sign(0.5_qp*epsilon(1.0_wp), real(draw(seed) - 0.5_wp, qp))
    end function one

    !> Solve a scheme
    subroutine solve(beam, closed, work, state)
        type(fine_beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(out) :: work
        integer, intent(out) :: state
        integer :: place

        call new_workspace(beam, work)
        call set_loads(beam, 1.0_qp, work)
        call solve_scheme(beam, closed, work, state, place)
    end subroutine solve

    !> No change of the data in their last digits moves a reaction or an opening farther than is said, and some come near
    subroutine changed_data()
        type(fine_beam_type) :: beam, changed
        type(workspace_type) :: work, other
        type(sensitivity_type) :: sensitivity
        logical, allocatable :: closed(:)
        real(qp), allocatable :: movement(:), margin(:), farthest(:), moved(:), rounding(:)
        real(qp) :: nearest, worst
        integer :: seed, trial, change, k, state

        seed = 8
        worst = 0.0_qp
        nearest = huge(nearest)
        do trial = 1, 40
            call draw_beam(seed, beam, closed)
            call solve(beam, closed, work, state)
            call check(state == band_ok, "a drawn beam is held")
            allocate (movement(size(closed)), margin(size(closed)), farthest(size(closed)))
            allocate (moved(size(closed)), rounding(size(closed)))
            call find_margins(beam%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                              margin, rounding)
            call prepare_sensitivity(beam, 1.0_qp, work, sensitivity)
            call check(sensitivity%known, "a movement is known")
            do k = 1, size(closed)
                call movement_of_support(beam, sensitivity, closed, k, work, movement(k))
            end do
            farthest(:) = 0.0_qp
            do change = 1, 60
                call change_data(seed, beam, changed)
                call solve(changed, closed, other, state)
                call find_margins(changed%supports, closed, other%answers, other%deflection_size, other%reaction, &
                                  other%reaction_error, moved, rounding)
                farthest(:) = max(farthest, abs(moved - margin))
            end do
            do k = 1, size(closed)
                if (beam%supports(k)%side == both) cycle
                worst = max(worst, farthest(k)/movement(k))
                nearest = min(nearest, farthest(k)/movement(k))
            end do
            deallocate (movement, margin, farthest, moved, rounding)
        end do
        call check(worst <= 1, "nothing moves farther than is said")
        call check(nearest > 1e-3_qp, "nor is what is said far beyond what moves")
    end subroutine changed_data

    !> The largest movement of any reaction or deflection is an estimate: hardly ever below that of a single one, and never by
    !> more than the factor by which the certificate multiplies it
    subroutine largest_of_all()
        type(fine_beam_type) :: beam
        type(workspace_type) :: work
        type(sensitivity_type) :: sensitivity
        logical, allocatable :: closed(:)
        integer, parameter :: trials = 400
        real(qp) :: largest(2), single, ratio, short
        integer :: seed, trial, k, state, below_single

        seed = 9
        below_single = 0
        short = 0.0_qp
        do trial = 1, trials
            call draw_beam(seed, beam, closed)
            call solve(beam, closed, work, state)
            call prepare_sensitivity(beam, 1.0_qp, work, sensitivity)
            call largest_movement(beam, sensitivity, of_reactions, work, largest(1))
            call largest_movement(beam, sensitivity, of_deflections, work, largest(2))
            ratio = 0.0_qp
            do k = 1, size(closed)
                call movement_of_support(beam, sensitivity, closed, k, work, single)
                if (.not. closed(k)) then
                    ! That of an opening has the rounding of the contact level besides
                    ratio = max(ratio, (single - epsilon(1.0_wp)*abs(beam%supports(k)%contact))/largest(2))
                else if (is_rigid(beam%supports(k))) then
                    ratio = max(ratio, single/largest(1))
                end if
            end do
            short = max(short, ratio)
            if (ratio > 1 + 1e-20_qp) below_single = below_single + 1
        end do
        call check(below_single <= trials/20, "the largest movement is mostly found")
        call check(short <= 3, "and never missed by more than the certificate allows for")
    end subroutine largest_of_all

    !> A beam that can move has none
    subroutine held_by_nothing()
        type(fine_beam_type) :: beam
        type(workspace_type) :: work
        type(sensitivity_type) :: sensitivity
        logical, allocatable :: closed(:)
        integer :: seed, state

        seed = 10
        call draw_beam(seed, beam, closed)
        closed(:) = .false.
        closed(1) = .true.
        call solve(beam, closed, work, state)
        call prepare_sensitivity(beam, 1.0_qp, work, sensitivity)
        call check(.not. sensitivity%known, "a beam on one support has no movements")
    end subroutine held_by_nothing

end program test_sensitivity
