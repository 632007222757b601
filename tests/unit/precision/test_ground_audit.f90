!> The audit of a beam on the ground: what is right stands, and every kind of answer that is broken on purpose is refused
program test_ground_audit
    use testing, only: check, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_scene, only: span_type, support_type, foundation_type, ground_law_point_type, uniform_load, &
        point_force, gapbeam_below, gapbeam_law_tanh, gapbeam_law_plastic
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_state, only: solve_state
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_audit, only: audit_ground
    use gapbeam_ledger, only: ledger_type, words_for, of_bending, of_equilibrium, of_parts, of_resultants, of_zone_ends, &
        of_contact, of_supports, of_restraints, of_places
    use gapbeam_quadrature, only: panels_type, cut_into_panels, points_of, most_points
    implicit none
    !> By so much numbers are broken, relative to them
    real(wp), parameter :: crack = 1e-11_wp
    type(ground_type) :: ground
    type(state_type) :: state
    integer :: status

    call integrals_are_exact()
    call make(gapbeam_law_plastic)
    call the_answer_stands()
    call numbers_are_broken()
    call states_are_broken()
    call the_model_is_another_one()
    call make(gapbeam_law_tanh)
    call the_answer_stands()
    call curves_are_broken()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A beam with a hinge, a clamp, springs that are closed and open, ground by points of a law, with a modulus that grows, and
    !> with a law with parameters
    subroutine make(law)
        integer, intent(in) :: law
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        associate (m => lowered%model)
            m%spans = [span_type(4.0_wp, EI=20.0_wp), span_type(4.0_wp, EI=30.0_wp, GA=200.0_wp), span_type(3.0_wp, EI=20.0_wp)]
            m%hinges = [5.5_wp]
            m%supports = [support_type(node=0, rotation=50.0_wp), support_type(x=4.0_wp, side=gapbeam_below, stiffness=30.0_wp), &
                              support_type(x=8.0_wp, side=gapbeam_below, stiffness=5.0_wp, gap=9.0_wp)]
            m%foundations = [foundation_type(from=0.5_wp, to=8.0_wp, side=gapbeam_below, gap=0.02_wp), &
                                 foundation_type(from=2.0_wp, to=11.0_wp, k=5.0_wp, k_to=30.0_wp, side=gapbeam_below, gap=0.05_wp, &
                                                 gap_to=0.0_wp), &
                                 foundation_type(from=6.0_wp, to=11.0_wp, side=gapbeam_below, law=law, &
                                                 parameter=[40.0_wp, 6.0_wp, 0.0_wp], parameter_to=[20.0_wp, 9.0_wp, 0.0_wp])]
            m%ground_law = [ground_law_point_type(1, 0.05_wp, 2.0_wp), ground_law_point_type(1, 0.2_wp, 4.0_wp)]
            m%loads = [uniform_load(8.0_wp, 1.0_wp, 5.0_wp), point_force(30.0_wp, x=10.0_wp), point_force(-6.0_wp, x=7.0_wp)]
            allocate (m%sections(0), m%law(0), m%ground(0))
        end associate
        call assemble_model(lowered, error)
        call check(.not. allocated(error), "a beam")
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        call check(.not. allocated(error) .and. state%status == gapbeam_solved, "solved")
        ground = ground_of(lowered, 1.0_wp)
    end subroutine make

    !> Nothing is wrong, and what is left over is the rounding of numbers that are not zero
    subroutine the_answer_stands()
        type(ledger_type) :: ledger
        real(wp) :: residuals(3)

        call audit_ground(ground, 1.0_wp, state%closed, state%ground, ledger, residuals)
        call check(ledger%wrong == 0 .and. ledger%excess < 8.0_wp, "it stands its audit")
        call check(all(residuals < 1e-13_wp) .and. all(residuals(:2) > 0.0_wp), "residuals are measured")
        call check(all(abs(residuals - state%ground%residuals) <= 0.0_wp), "those of the state are the same")
        call check(any(state%ground%acts > 1) .and. any(state%closed) .and. .not. all(state%closed), "there is something to audit")
    end subroutine the_answer_stands

    !> A broken answer is refused, with a reason among those that may be given
    subroutine refused(broken, closed, reasons, what)
        type(ground_solution_type), intent(in) :: broken
        logical, intent(in) :: closed(:)
        integer, intent(in) :: reasons(:)
        character(len=*), intent(in) :: what
        type(ledger_type) :: ledger
        real(wp) :: residuals(3)

        call audit_ground(ground, 1.0_wp, closed, broken, ledger, residuals)
        call check(any(ledger%wrong == reasons), what//": "//words_for(ledger%wrong))
    end subroutine refused

    !> One number after the other
    subroutine numbers_are_broken()
        type(ground_solution_type) :: broken
        real(wp) :: way
        integer :: i, k, j

        do k = 1, size(state%ground%reaction)
            if (.not. abs(state%ground%reaction(k)) > 0.0_wp) cycle
            broken = state%ground
            broken%reaction(k) = broken%reaction(k)*(1 + crack)
            call refused(broken, state%closed, [of_equilibrium, of_supports, of_parts], "a reaction")
        end do
        do j = 0, ubound(state%ground%deflection, 1)
            broken = state%ground
            broken%deflection(j) = broken%deflection(j) + crack
            call refused(broken, state%closed, [of_bending, of_supports], "a deflection")
            broken = state%ground
            broken%moment_left(j) = broken%moment_left(j) + crack*30
            call refused(broken, state%closed, [of_equilibrium, of_parts, of_restraints], "a moment left of a node")
            broken = state%ground
            broken%moment_right(j) = broken%moment_right(j) + crack*30
            call refused(broken, state%closed, [of_equilibrium, of_restraints], "a moment right of a node")
        end do
        do i = 1, size(state%ground%piece)
            broken = state%ground
            broken%ends(i)%w_a = broken%ends(i)%w_a + crack
            call refused(broken, state%closed, [of_bending, of_equilibrium, of_resultants, of_zone_ends], "a deflection at an end")
            broken = state%ground
            broken%ends(i)%moment_b = broken%ends(i)%moment_b + crack*30
            call refused(broken, state%closed, [of_bending, of_equilibrium], "a moment at an end")
            broken = state%ground
            broken%rotation(1, i) = broken%rotation(1, i) + crack
            call refused(broken, state%closed, [of_bending, of_restraints], "a rotation")
            broken = state%ground
            broken%shear(2, i) = broken%shear(2, i) + crack*30
            call refused(broken, state%closed, [of_equilibrium, of_parts], "a shear")
            broken = state%ground
            broken%loads(i)%qa = broken%loads(i)%qa + 1e-6_wp
            call refused(broken, state%closed, [of_bending, of_equilibrium, of_resultants], "the load inside a stretch")
            do k = 1, size(state%ground%resultant, 1)
                if (.not. abs(state%ground%resultant(k, i)) > 1e-3_wp) cycle
                broken = state%ground
                broken%resultant(k, i) = broken%resultant(k, i)*(1 + 100*crack)
                call refused(broken, state%closed, [of_resultants, of_equilibrium, of_parts], "a resultant")
                ! What one layer has too much, another one has too little
                broken%resultant(1, i) = broken%resultant(1, i) + (state%ground%resultant(k, i) - broken%resultant(k, i))
                if (k > 1) call refused(broken, state%closed, [of_resultants], "two resultants")
            end do
            if (i == size(state%ground%piece)) cycle
            if (state%ground%piece(i) /= state%ground%piece(i + 1)) cycle
            way = 1e-9_wp
            broken = state%ground
            broken%to(i) = broken%to(i) + way
            broken%from(i + 1) = broken%from(i + 1) + way
            call refused(broken, state%closed, [of_places], "an end of a zone")
            broken%stretches(i)%length = broken%stretches(i)%length + way
            broken%stretches(i + 1)%length = broken%stretches(i + 1)%length - way
            call refused(broken, state%closed, [of_places, of_bending, of_equilibrium, of_zone_ends, of_resultants, of_contact], &
                         "an end of a zone with its stretches")
        end do
        broken = state%ground
        broken%deflection(1) = huge(1.0_wp)
        call refused(broken, state%closed, [of_bending, of_supports], "a deflection that is none")
    end subroutine numbers_are_broken

    !> States of supports and layers
    subroutine states_are_broken()
        type(ground_solution_type) :: broken
        logical :: closed(size(state%closed))
        integer :: i, k, acts, most

        do k = 1, size(closed)
            if (ground%beam%supports(k)%side == 0) cycle
            closed = state%closed
            closed(k) = .not. closed(k)
            call refused(state%ground, closed, [of_supports], "the state of a support")
        end do
        do i = 1, size(state%ground%piece)
            do k = 1, ground%first(state%ground%piece(i) + 1) - ground%first(state%ground%piece(i))
                most = merge(1, 2, ground%layers(ground%first(state%ground%piece(i)) + k - 1)%law_last == 0)
                do acts = 0, most
                    if (acts == state%ground%acts(k, i)) cycle
                    broken = state%ground
                    broken%acts(k, i) = acts
                    call refused(broken, state%closed, [of_contact, of_zone_ends, of_resultants, of_equilibrium], &
                                 "the state of a layer")
                    ! Even where nothing else tells: the force is that of the state
                    call refused(broken, state%closed, [of_contact, of_zone_ends, of_resultants, of_equilibrium], "a state")
                end do
            end do
        end do
    end subroutine states_are_broken

    !> The right answer to another question
    subroutine the_model_is_another_one()
        type(ground_type) :: given

        given = ground
        ground%laws%slope_a = ground%laws%slope_a*(1 + 100*crack)
        ground%laws%slope_b = ground%laws%slope_b*(1 + 100*crack)
        call refused(state%ground, state%closed, [of_resultants, of_equilibrium, of_zone_ends], "the law of the ground")
        ground = given
        ground%layers%contact_a = ground%layers%contact_a + 100*crack
        call refused(state%ground, state%closed, [of_resultants, of_equilibrium, of_zone_ends, of_contact], "its gap")
        ground = given
        ground%live%qb = ground%live%qb*(1 + 100*crack)
        call refused(state%ground, state%closed, [of_equilibrium, of_parts], "a load per length")
        ground = given
        ground%beam%force = ground%beam%force*(1 + crack)
        call refused(state%ground, state%closed, [of_equilibrium, of_parts], "a force")
        ground = given
        ground%beam%compliance = ground%beam%compliance*(1 + crack)
        call refused(state%ground, state%closed, [of_restraints], "a rotational restraint")
        ground = given
        ground%beam%supports%stiffness = ground%beam%supports%stiffness*(1 + crack)
        call refused(state%ground, state%closed, [of_supports], "a spring")
        ground = given
        ground%pieces%length = ground%pieces%length*(1 + crack)
        call refused(state%ground, state%closed, [of_places], "a length")
        ground = given
    end subroutine the_model_is_another_one

    !> Ground that acts by a curve
    subroutine curves_are_broken()
        type(ground_solution_type) :: broken
        type(ground_type) :: given
        integer :: i, k

        do i = 1, size(state%ground%piece)
            do k = 1, size(state%ground%resultant, 1)
                if (.not. abs(state%ground%resultant(k, i)) > 1e-3_wp) cycle
                broken = state%ground
                broken%resultant(k, i) = broken%resultant(k, i)*(1 + 100*crack)
                call refused(broken, state%closed, [of_resultants, of_equilibrium, of_parts], "a resultant on curves")
            end do
            broken = state%ground
            broken%shear(1, i) = broken%shear(1, i) + crack*30
            call refused(broken, state%closed, [of_equilibrium, of_parts, of_bending], "a shear on curves")
        end do
        given = ground
        ground%layers%parameter_a(2) = ground%layers%parameter_a(2)*(1 + 100*crack)
        call refused(state%ground, state%closed, [of_resultants, of_equilibrium, of_bending], "a limit of the ground")
        ground = given
    end subroutine curves_are_broken

    !> Polynomials, and what fades from both ends, however fast
    subroutine integrals_are_exact()
        type(panels_type) :: panels
        real(wp) :: points(most_points), weights(most_points), rate, fading, cubes
        integer :: p, k, n, power

        do power = -40, 200
            rate = 1.2_wp**power
            call cut_into_panels([rate], [rate/sqrt(2.0_wp)], panels)
            fading = 0.0_wp
            cubes = 0.0_wp
            do p = 1, panels%number
                call points_of(panels, p, n, points, weights)
                do k = 1, n
                    fading = fading + weights(k)*(waves(rate, points(k)) + waves(rate, 1 - points(k)))
                    cubes = cubes + weights(k)*points(k)**7
                end do
            end do
            call check(abs(cubes - 0.125_wp) < 1e-15_wp, "a polynomial")
            ! 1 - x is off by a rounding
            call check(abs(fading - 2*under_waves(rate)) < 1e-15_wp + 1e-14_wp/max(rate, 1.0_wp), "what fades")
        end do
    end subroutine integrals_are_exact

    !> exp(-b x) cos(b x), b = rate/sqrt(2)
    pure function waves(rate, x)
        real(wp), intent(in) :: rate, x
        real(wp) :: waves

        waves = exp(-min(rate/sqrt(2.0_wp)*x, 600.0_wp))*cos(rate/sqrt(2.0_wp)*x)
    end function waves

    !> Its integral from 0 to 1
    pure function under_waves(rate) result(integral)
        real(wp), intent(in) :: rate
        real(wp) :: integral

        associate (b => rate/sqrt(2.0_wp))
            if (b < 1e-2_wp) then
                integral = 1 - b/2 + b**3/12 - b**4/30 + b**5/180
            else
                integral = (1 + exp(-min(b, 600.0_wp))*(sin(b) - cos(b)))/(2*b)
            end if
        end associate
    end function under_waves

end program test_ground_audit
