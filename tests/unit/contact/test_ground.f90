!> Beams on the ground: the chain, the zones, the mesh, the solution in quadruple precision, and what is asked of it
program test_ground
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: bending_count
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_element, only: field_type
    use gapbeam_scene, only: span_type, foundation_type, ground_point_type, load_type, uniform_load, &
        point_force, gapbeam_below
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, hinge, restrained, band_ok, &
        band_needs_pivoting, band_mechanism
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_link_type, condense_loaded
    use gapbeam_foundation_chain, only: factor_foundation_chain, solve_foundation_chain, of_numbers_as_given
    use gapbeam_layers, only: layer_type, law_piece_type, pieces_of_law, law_piece
    use gapbeam_filled_ground, only: any_falls, peak_of, fill_valleys
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, full_contact, steps_of_piece
    use gapbeam_zones, only: settle_zones
    use gapbeam_ground_mesh, only: mesh_type, begin_mesh, refine_mesh
    use gapbeam_mesh_zones, only: zones_of_mesh
    use gapbeam_ground_energy, only: find_least_energy
    use gapbeam_workspace, only: workspace_type
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_state, only: solve_state
    use gapbeam_ground_query, only: ground_values, ground_extremes
    use gapbeam_pressure, only: ground_pressure, pressure_extremes
    use gapbeam_ground_distance, only: largest_ways
    implicit none
    real(wp), parameter :: pi = acos(-1.0_wp)
    integer :: status

    call the_chain_solves_its_rows()
    call the_chain_finds_mechanisms()
    call layers_and_their_laws()
    call valleys_of_laws_are_filled()
    call zones_converge_quadratically()
    call meshes_come_near()
    call a_force_on_a_long_beam()
    call a_beam_that_is_lifted()
    call soil_that_grows_with_depth()
    call what_is_asked_of_it()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> All rows of random chains hold: rotations and shears of the two links at a node
    subroutine the_chain_solves_its_rows()
        integer, parameter :: n = 12, trials = 200
        type(stretch_type) :: stretch
        type(stretch_link_type) :: links(n)
        type(node_type) :: nodes(0:n)
        type(rhs_type) :: rhs(0:n), eliminated(0:n)
        type(pivot_type) :: pivots(0:n)
        type(answer_type) :: answers(0:n)
        real(wp) :: r(6), lengths(n), turn(2), shear(2), psi(2, n), v(2, n), rotation, largest(2), worst(2)
        integer :: trial, i, state, place, too_many

        call random_init(.true., .true.)
        worst = 0.0_wp
        too_many = 0
        do trial = 1, trials
            rhs = rhs_type()
            nodes = node_type()
            do i = 1, n
                call random_number(r)
                stretch = stretch_type(length=0.1_wp + r(1), flexibility=10**(2*r(2) - 1), shear_flexibility=0.0_wp)
                if (r(3) > 0.5_wp) stretch%shear_flexibility = r(4)
                ! Rigid from a clamp on, or over two supports and farther
                if ((mod(trial, 7) == 0 .and. i <= 4) .or. mod(trial, 7) == 1) stretch%flexibility = 0.0_wp
                if (.not. stretch%flexibility > 0.0_wp) stretch%shear_flexibility = 0.0_wp
                if (r(5) > 0.3_wp) stretch%modulus_a = 10**(6*r(6) - 2)
                if (mod(trial, 3) == 0 .and. i == 1) stretch%modulus_a = 0.0_wp
                stretch%modulus_b = stretch%modulus_a
                lengths(i) = stretch%length
                call random_number(r)
                call condense_loaded(stretch, [stretch_load_type(qa=r(1), qb=r(2), kappa=r(3))], links(i), turn(1:1), turn(2:2), &
                                     shear(1:1), shear(2:2))
                rhs(i - 1)%right = turn(1)
                rhs(i)%left = turn(2)
                rhs(i - 1)%shear = rhs(i - 1)%shear + shear(1)
                rhs(i)%shear = rhs(i)%shear + shear(2)
            end do
            do i = 0, n
                call random_number(r)
                if (r(1) > 0.6_wp) nodes(i)%stiffness = 100*r(2)
                if (i == n/2) nodes(i)%held = mod(trial, 2) == 0
                if (i == 4 .and. mod(trial, 5) == 0) nodes(i)%kind = hinge
                if (i == 7 .and. mod(trial, 4) == 0) nodes(i) = node_type(kind=restrained, compliance=r(3))
                if (i == 0 .and. mod(trial, 7) == 0) nodes(i) = node_type(kind=restrained, held=.true.)
                if (i == n/2 + 1) nodes(i)%held = mod(trial, 14) == 8
                if (nodes(i)%held) rhs(i)%deflection = r(4)
                if (nodes(i)%kind /= hinge) rhs(i)%couple = r(5)
            end do
            call factor_foundation_chain(nodes, links, of_numbers_as_given, pivots, state, place)
            too_many = too_many + merge(1, 0, state == band_needs_pivoting)
            if (state /= band_ok) cycle
            call solve_foundation_chain(nodes, links, lengths, pivots, rhs, eliminated, answers)
            largest = tiny(1.0_wp)
            do i = 1, n
                associate (a => answers(i - 1), b => answers(i), k => links(i))
                    psi(1, i) = -k%pa*a%deflection + k%p1*b%deflection + k%faa*a%moment_right + k%fab*b%moment_left
                    psi(2, i) = k%pb*b%deflection - k%p2*a%deflection - k%fab*a%moment_right - k%fbb*b%moment_left
                    v(1, i) = -k%pa*a%moment_right + k%p2*b%moment_left - k%gaa*a%deflection - k%gab*b%deflection
                    v(2, i) = k%pb*b%moment_left - k%p1*a%moment_right + k%gbb*b%deflection + k%gab*a%deflection
                    largest = max(largest, [k%faa*abs(a%moment_right) + k%pa*abs(a%deflection), &
                                            k%pa*abs(a%moment_right) + k%gaa*abs(a%deflection)])
                end associate
            end do
            do i = 1, n - 1
                associate (a => answers(i), node => nodes(i), b => rhs(i))
                    if (node%kind == restrained) then
                        rotation = node%compliance*(a%moment_left - a%moment_right + b%couple)
                        worst(1) = max(worst(1), abs(psi(2, i) - b%left - rotation)/largest(1), &
                                       abs(psi(1, i + 1) + b%right - rotation)/largest(1))
                    else if (node%kind == hinge) then
                        worst(1) = max(worst(1), abs(a%moment_left), abs(a%moment_right))
                    else
                        worst(1) = max(worst(1), abs(psi(2, i) - b%left - psi(1, i + 1) - b%right)/largest(1))
                    end if
                    if (node%held) then
                        worst(2) = max(worst(2), abs(a%deflection - b%deflection))
                    else
                        worst(2) = max(worst(2), abs(v(2, i) - v(1, i + 1) - b%shear + node%stiffness*a%deflection)/largest(2))
                    end if
                end associate
            end do
        end do
        call check(too_many == 0, "no chain has too many rigid supports")
        ! Before any refinement; what is wanted of it is done in quadruple precision
        call check(worst(1) < 1e-11_wp, "the chain's rotations fit together")
        call check(worst(2) < 1e-12_wp, "the chain's shears fit together")
    end subroutine the_chain_solves_its_rows

    !> Without ground and supports, and with a hinge too many
    subroutine the_chain_finds_mechanisms()
        type(stretch_type), parameter :: grounded = stretch_type(1.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, 1.0_wp)
        type(stretch_link_type) :: links(2)
        type(node_type) :: nodes(0:2)
        type(pivot_type) :: pivots(0:2)
        real(wp) :: none(0, 4)
        integer :: state, place

        call condense_loaded(stretch_type(1.0_wp, 1.0_wp), [stretch_load_type ::], links(1), none(:, 1), none(:, 2), &
                             none(:, 3), none(:, 4))
        links(2) = links(1)
        call factor_foundation_chain(nodes, links, of_numbers_as_given, pivots, state, place)
        call check(state == band_mechanism, "nothing holds the beam")
        call condense_loaded(grounded, [stretch_load_type ::], links(2), none(:, 1), none(:, 2), &
                             none(:, 3), none(:, 4))
        nodes(1)%kind = hinge
        call factor_foundation_chain(nodes, links, of_numbers_as_given, pivots, state, place)
        call check(state == band_mechanism .and. place == 1, "a part that hangs at a hinge turns")
        call condense_loaded(grounded, [stretch_load_type ::], links(1), none(:, 1), none(:, 2), &
                             none(:, 3), none(:, 4))
        call factor_foundation_chain(nodes, links, of_numbers_as_given, pivots, state, place)
        call check(state == band_ok, "ground holds both parts")
    end subroutine the_chain_finds_mechanisms

    !> Which piece of a law is which
    subroutine layers_and_their_laws()
        type(layer_type) :: linear, bent
        type(law_piece_type) :: laws(3), second, only_one

        linear = layer_type(side=1, modulus_a=2.0_wp, modulus_b=2.0_wp)
        bent = layer_type(side=1, law_first=2, law_last=3)
        laws = [law_piece_type(slope_a=9.0_wp), law_piece_type(slope_a=5.0_wp), law_piece_type(0.1_wp, 0.1_wp, 0.5_wp, 0.5_wp, &
                                                                                               1.0_wp, 1.0_wp)]
        call check(pieces_of_law(linear) == 1 .and. pieces_of_law(bent) == 2, "pieces of laws")
        second = law_piece(bent, laws, 2)
        only_one = law_piece(linear, laws, 1)
        call check(abs(second%displacement_a - 0.1_wp) <= 0.0_wp, "the second piece begins where the first ends")
        call check(.not. only_one%slope_a > 0.0_wp, "a linear layer has its moduli instead")
    end subroutine layers_and_their_laws

    !> Up to a force of 4, down to 1, and up again: the ground that never falls stays at 4 from the peak to the last point at least
    subroutine valleys_of_laws_are_filled()
        type(ground_type) :: ground
        type(law_piece_type) :: rises, falls, rises_again
        real(wp) :: force(4)
        integer :: i

        rises = law_piece_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp, 1.0_wp, 2.0_wp, 2.0_wp)
        falls = law_piece_type(2.0_wp, 2.0_wp, 4.0_wp, 2.0_wp, -1.0_wp, 0.5_wp, 3.0_wp, 3.0_wp)
        rises_again = law_piece_type(5.0_wp, 5.0_wp, 1.0_wp, 3.5_wp, 1.5_wp, -0.25_wp, 2.0_wp, 2.0_wp)
        ground%layers = [layer_type(side=1, law_first=1, law_last=3), layer_type(side=1, modulus_a=2.0_wp, modulus_b=2.0_wp)]
        ground%laws = [rises, falls, rises_again]
        call check(any_falls(ground) .and. peak_of(ground, 1) == 2 .and. peak_of(ground, 2) == 2, "where the force falls first")
        call fill_valleys(ground)
        call check(.not. any_falls(ground), "nor does it fall any more")
        do i = 1, 4
            associate (p => ground%laws(min(i, 3)), on => [1.0_wp, 3.5_wp, 6.0_wp, 20.0_wp])
                force(i) = p%force_a + p%slope_a*(on(i) - p%displacement_a)
            end associate
        end do
        call check_close(force, [2.0_wp, 4.0_wp, 5.5_wp, 26.5_wp], "at the left end", 1e-15_wp)
        force(:) = [ground%laws%force_b, ground%laws(3)%slope_b]
        call check_close(force, [0.0_wp, 2.0_wp, 3.5_wp, 0.0_wp], "at the right end", 1e-15_wp)
    end subroutine valleys_of_laws_are_filled

    !> A free beam of two spans on ground that pushes up
    subroutine lower(loads, lowered, moduli, profile)
        type(load_type), intent(in) :: loads(:)
        type(assembled_type), intent(out) :: lowered
        real(wp), intent(in), optional :: moduli(2)
        type(ground_point_type), intent(in), optional :: profile(:)
        type(error_type), allocatable :: error
        real(wp) :: k(2)

        k = 4.0_wp
        if (present(moduli)) k = moduli
        associate (m => lowered%model)
            allocate (m%hinges(0), m%sections(0), m%supports(0), m%law(0), m%ground(0), m%ground_law(0))
            if (present(profile)) m%ground = profile
            m%spans = [span_type(15.0_wp, EI=1.0_wp), span_type(15.0_wp, EI=1.0_wp)]
            m%foundations = [foundation_type(from=0.0_wp, to=30.0_wp, k=k(1), k_to=k(2), side=gapbeam_below)]
            m%loads = loads
        end associate
        call assemble_model(lowered, error)
        call check(.not. allocated(error), "lowered")
    end subroutine lower

    !> Loads under which the beam lifts beside its middle and stands on a short zone at its right end
    function lifting() result(loads)
        type(load_type), allocatable :: loads(:)

        loads = [uniform_load(1.0_wp, 0.0_wp, 30.0_wp), point_force(16.0_wp, node=1), point_force(-8.0_wp, x=25.0_wp)]
    end function lifting

    !> From full contact; and once more from what was found, where nothing moves
    subroutine zones_converge_quadratically()
        type(assembled_type) :: lowered
        type(ground_type) :: ground
        type(zones_type) :: zones
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: closed(0), settled
        real(wp) :: moved

        call lower(lifting(), lowered)
        ground = ground_of(lowered, 1.0_wp)
        call full_contact(ground, zones)
        call check(size(zones%piece) == 3 .and. all(zones%acts == 1), "full contact")
        call check(steps_of_piece(ground, 1) == 1, "an even modulus needs no steps")
        call settle_zones(ground, 1.0_wp, 0, 1e-10_wp, zones, closed, grounded, work, outcome, settled, moved, error)
        call check(settled .and. work%solves <= 13, "settled in a few solves")
        call check(size(zones%piece) == 5 .and. all(zones%acts(1, :) == [1, 1, 0, 0, 1]), "two zones")
        call settle_zones(ground, 1.0_wp, 0, 1e-10_wp, zones, closed, grounded, work, outcome, settled, moved, error)
        call check(settled .and. work%solves == 1 .and. moved < 1e-10_wp, "and stay where they are")
    end subroutine zones_converge_quadratically

    !> The least energy on a mesh shows the zones, nearer and nearer, and that nothing holds a beam which is pulled up
    subroutine meshes_come_near()
        type(assembled_type) :: lowered
        type(ground_type) :: ground
        type(mesh_type) :: mesh
        type(zones_type) :: zones
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        type(state_type) :: state
        logical :: closed(0), refined, exhausted
        integer :: solves, pressed, try
        real(wp) :: off(3)

        call lower(lifting(), lowered)
        ground = ground_of(lowered, 1.0_wp)
        call begin_mesh(ground, mesh)
        do try = 1, 3
            call find_least_energy(ground, 1.0_wp, mesh, closed, solves, pressed, exhausted, outcome, error)
            call check(.not. allocated(error) .and. outcome%status == gapbeam_solved, "the mesh holds it")
            call check(solves <= 10 .and. pressed > 20, "in a few rounds")
            call zones_of_mesh(ground, mesh, zones)
            call check(size(zones%piece) == 5 .and. all(zones%acts(1, :) == [1, 1, 0, 0, 1]), "zones of the mesh")
            off(try) = max(abs(zones%to(2) - 4.6335826_wp), abs(zones%from(5) - 4.6732507_wp))
            call refine_mesh(ground, mesh, .false., refined)
            call check(refined, "a finer mesh")
        end do
        call check(off(1) < 0.1_wp .and. off(3) < 0.02_wp .and. off(3) < off(1), "nearer and nearer")
        call find_least_energy(ground, -1.0_wp, mesh, closed, solves, pressed, exhausted, outcome, error)
        call check(.not. allocated(error) .and. outcome%status == gapbeam_no_equilibrium, "nothing holds it down on a mesh")
        call check(size(outcome%motion) == size(ground%pieces) + 1 .and. minval(outcome%motion) < -0.99_wp, "nor stops it")
        call lower([uniform_load(1.0_wp, 0.0_wp, 30.0_wp), point_force(-40.0_wp, x=25.0_wp)], lowered)
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        call check(.not. allocated(error) .and. state%status == gapbeam_no_equilibrium, "nothing holds it down")
        call check(minval(state%motion) < -0.99_wp, "its motion goes up")
    end subroutine meshes_come_near

    !> Reference problem P3: k w/(P beta) = coth(pi/2)/2, contact over pi/(2 beta) to both sides (beta = 1)
    subroutine a_force_on_a_long_beam()
        type(assembled_type) :: lowered
        type(state_type) :: state
        type(error_type), allocatable :: error
        integer :: i

        call lower([point_force(2.0_wp, node=1)], lowered)
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        call check(.not. allocated(error) .and. state%status == gapbeam_solved, "solved")
        call check(abs(4*state%deflection(1)/2 - 1/tanh(pi/2)/2) < 1e-15_wp, "deflection under the force")
        call check(abs(state%moment_left(1)/2 - 1/tanh(pi/2)/4) < 1e-15_wp, "moment under the force")
        i = findloc(state%ground%acts(1, :), 1, 1)
        call check(abs(state%ground%from(i) - (15 - pi/2)) < 4e-15_wp, "left end of the contact")
        call check(abs(sum(state%ground%resultant) - 2) < 1e-15_wp, "the ground carries the force")
        call check(all(state%ground%bounds < 1e-13_wp) .and. all(state%ground%residuals < 1e-14_wp), "and says how exact it is")
    end subroutine a_force_on_a_long_beam

    !> Reference problem P3: a heavy half-infinite beam lifted at its end over a length l: F = q/2 (l + 1/beta)
    subroutine a_beam_that_is_lifted()
        type(assembled_type) :: lowered
        type(state_type) :: state
        type(error_type), allocatable :: error
        real(wp), parameter :: l = 2.0_wp
        real(wp) :: exact
        integer :: i

        call lower([uniform_load(1.0_wp, 0.0_wp, 30.0_wp), point_force(-(l + 1)/2, x=0.0_wp)], lowered)
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        i = findloc(state%ground%acts(1, :), 1, 1)
        exact = -(l + l**2 + 2*l**3/3 + l**4/6)/4
        call check(abs(state%ground%from(i) - l) < 1e-10_wp, "length lifted")  ! the other end is 28/beta away
        call check(abs(state%deflection(0)/exact - 1) < 1e-10_wp, "rise of the end")
    end subroutine a_beam_that_is_lifted

    !> Where the modulus varies the ground is cut into steps, and the answer is that of an even one in the limit
    subroutine soil_that_grows_with_depth()
        type(assembled_type) :: lowered
        type(state_type) :: state
        type(error_type), allocatable :: error
        real(wp) :: w

        call lower([point_force(2.0_wp, node=1)], lowered, moduli=[3.0_wp, 5.0_wp])
        call check(steps_of_piece(ground_of(lowered, 1.0_wp), 1) > 10, "steps where the modulus varies")
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        w = state%deflection(1)
        call check(abs(w - 1/tanh(pi/2)/4) < 3e-3_wp .and. abs(w - 1/tanh(pi/2)/4) > 1e-6_wp, "near the even modulus")
        call lower([point_force(2.0_wp, node=1)], lowered, moduli=[5.0_wp, 3.0_wp])
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        call check(abs(state%deflection(1) - w) < 1e-16_wp, "and the same mirrored")
    end subroutine soil_that_grows_with_depth

    !> Fields, pressure and distances agree with each other
    subroutine what_is_asked_of_it()
        type(assembled_type) :: lowered
        type(state_type) :: state
        type(error_type), allocatable :: error
        type(field_type) :: fields(3)
        real(wp) :: pressure(3), values(2, bending_count), distance(2, bending_count), pressures(2), at(2)
        real(wp), allocatable :: way(:, :), touch(:, :, :)
        integer :: piece(2, bending_count), place(2)

        call lower(lifting(), lowered, profile=[ground_point_type(1, 0.0_wp, 0.1_wp), ground_point_type(1, 30.0_wp, 0.1_wp)])
        call new_state(lowered, state, error)
        call solve_state(lowered, 1.0_wp, 0, state, error)
        associate (ground => state%ground)
            call ground_values(lowered, ground, [1, 1, 2], [0.0_wp, 7.5_wp, 10.0_wp], fields)
            call ground_pressure(lowered, ground, [1, 1, 2], [0.0_wp, 7.5_wp, 10.0_wp], pressure)
            call check(all(abs(pressure(:2) - 4*(fields(:2)%deflection - 0.1_wp)) < 1e-14_wp), "pressure is what is pressed in")
            call check(pressure(3) <= 0.0_wp, "no pressure where it has lifted")
            call ground_extremes(lowered, ground, 1.0_wp, values, piece, distance)
            call check(values(1, 1) >= state%deflection(1) .and. values(1, 1) < state%deflection(1) + 1e-4_wp, &
                       "the largest deflection is near the force")
            call pressure_extremes(lowered, ground, pressures, place, at)
            call check(abs(pressures(1) - 4*(values(1, 1) - 0.1_wp)) < 1e-13_wp, "and the largest pressure")
            allocate (way(1, size(ground%piece)), touch(2, 1, size(ground%piece)))
            call largest_ways(lowered, ground, way, touch)
            call check(abs(maxval(way) - (0.1_wp - values(2, 1))) < 1e-12_wp, "and the highest place is farthest from the ground")
        end associate
    end subroutine what_is_asked_of_it

end program test_ground
