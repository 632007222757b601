!> The least energy of a beam on one-sided ground, on a mesh: Newton's method with a line search.
!>
!> With the ground at the nodes of the mesh (gapbeam_ground_nodes) the energy is convex and has a Lipschitz continuous gradient. A
!> model of it with the forces and slopes of the ground at hand, and with the supports as they are, is solved by
!> gapbeam_contact_state; along the way to its solution the slope of the energy never falls, and costs no more than the forces of
!> the ground. Going to where it vanishes, or nearly so, the energy falls by a share of what it can in every round: from any start
!> this ends at the least one (semismooth Newton methods: Pang and Qi 1995, Facchinei 1995). Where the model runs away along a
!> motion of the beam, the same search tells how far; if nothing stops it, there is no equilibrium.
module gapbeam_ground_energy
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_mesh_rounds, most_node_rounds, most_line_steps, most_nodes_asked
    use gapbeam_tolerances, only: proximal_ratio, balanced, flat_energy, first_way, last_way, mesh_rounding
    use gapbeam_error, only: error_type, fatal_error, out_of_range, has_ended, gapbeam_solved, gapbeam_not_converged
    use gapbeam_law, only: both
    use gapbeam_law_kinematics, only: find_level_forces
    use gapbeam_model, only: beam_type, node_support_type, order_supports, last_place, softest
    use gapbeam_turning, only: turn_with
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_line_search, only: bracket_type, place_inside, narrow
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_mesh, only: mesh_type
    use gapbeam_ground_nodes, only: point_type, press, list_points, make_beam
    implicit none
    private
    public :: find_least_energy

contains

    !> Find the deflections of least energy
    subroutine find_least_energy(ground, factor, mesh, closed, solves, pressed, exhausted, outcome, error)
        !> The beam and its ground, and the load factor
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        !> With a start where it is solved already; else that is full contact
        type(mesh_type), intent(inout) :: mesh
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        !> Linear solves, and nodes at which ground that acts one way is pressed
        integer, intent(out) :: solves, pressed
        !> Whether it was given up because nodes had been asked for so often that a finer mesh will hardly tell more
        logical, intent(out) :: exhausted
        !> Solved or no equilibrium, with the motion of the nodes of the beam without ground
        type(outcome_type), intent(out) :: outcome
        !> As for find_contact_state, or not settled
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(point_type), allocatable :: points(:)
        type(node_support_type), allocatable :: own(:)
        !> Of the nodes, and of rotations that supports hold: deflection, what the beam asks ground and supports for there, force
        !> and slope of the ground, force of the model, a step, the change of what is asked for, loads
        real(wp), allocatable, dimension(:) :: w, asked, push, slope, modelled, step, change, load
        real(wp), allocatable :: proximal_weight
        logical, allocatable :: acting(:)
        real(wp) :: way, force
        integer(int64) :: asked_for
        integer :: round, n, last
        logical :: begun, stopped

        n = size(mesh%piece)
        solves = 0
        pressed = 0
        exhausted = .false.
        call make_beam(ground, mesh, beam)
        call list_points(ground, mesh, points)
        last = last_place(beam)
        allocate (own(size(closed)), w(0:last), asked(0:last), push(0:last), slope(0:last), modelled(0:last), step(0:last), &
                  change(0:last), load(0:n))
        own(:) = beam%supports
        load(:) = beam%force(1, :)
        w(:) = 0.0_wp
        w(0:n) = mesh%deflection
        asked(:) = 0.0_wp
        call press(ground, points, w, push, slope, pressed, full=.not. mesh%solved)
        begun = .false.
        asked_for = 0
        do round = 1, most_mesh_rounds + min(n, most_node_rounds)
            exhausted = asked_for > most_nodes_asked
            if (exhausted) exit
            call solve_model()
            if (allocated(error)) then
                if (has_ended(error) .or. allocated(proximal_weight)) return
                deallocate (error)
            end if
            if (outcome%status /= gapbeam_solved .and. begun) then
                call follow_motion(stopped)
                if (.not. stopped) return
                cycle
            end if
            if (allocated(error) .or. outcome%status /= gapbeam_solved) then
                ! Held by so little that springs have to help, here or from the start
                if (allocated(proximal_weight)) exit
                proximal_weight = proximal_ratio*softest(beam)
                cycle
            end if
            call take_model()
            way = 1.0_wp
            if (begun) way = way_to_flat()
            if (way < 1.0_wp) then
                w = w + way*step
                asked = asked + way*change
            else
                w(:) = work%answers%deflection
                asked = asked + change
            end if
            call press(ground, points, w, push, slope, pressed)
            force = sum(abs(push)) + sum(work%load_size)
            ! A rounding of deflections is a force on stiff ground
            force = balanced*force + mesh_rounding*sum(slope)*maxval(abs(w(0:n)))
            if (.not. (force <= huge(force) .and. maxval(abs(w)) <= huge(force))) then
                call out_of_range(error)
                return
            end if
            if (begun .and. way >= 1.0_wp .and. sum(abs(push - modelled)) <= force) then
                closed(:) = acting(:size(closed))
                mesh%deflection(:) = w(0:n)
                mesh%moment_left(:) = work%answers(0:n)%moment_left
                mesh%moment_right(:) = work%answers(0:n)%moment_right
                mesh%solved = .true.
                return
            end if
            ! Now motions tell how far to go
            if (.not. begun .and. allocated(proximal_weight)) deallocate (proximal_weight)
            begun = .true.
        end do
        call fatal_error(error, gapbeam_not_converged, "the ground could not be settled, or proved too weak for the loads: "// &
                         "look for loads near what it can bear")

    contains

        !> Solve the beam on springs with the forces and slopes of the ground
        subroutine solve_model()
            type(node_support_type), allocatable :: supports(:)
            real(wp) :: stiffness
            integer :: i, m

            allocate (supports(size(own) + n + 1))
            m = size(own)
            supports(:m) = own
            do i = 0, n
                stiffness = slope(i)
                if (allocated(proximal_weight)) stiffness = stiffness + proximal_weight
                beam%force(1, i) = load(i) - push(i)
                if (.not. stiffness > 0.0_wp) cycle
                m = m + 1
                supports(m) = node_support_type(i, both, stiffness, w(i))
            end do
            call order_supports(supports(:m), beam)
            if (allocated(acting)) deallocate (acting)
            allocate (acting(m), source=.true.)
            acting(:size(closed)) = closed
            call new_workspace(beam, work)
            call set_loads(beam, factor, work)
            call find_contact_state(beam, factor, rule_block, acting, work, outcome, error)
            solves = solves + work%solves
        end subroutine solve_model

        !> Its forces, the way to it, and what the beam asks for there
        subroutine take_model()
            integer :: k

            closed(:) = acting(:size(closed))
            step(:) = work%answers%deflection - w
            modelled(:) = push + slope*step
            if (allocated(proximal_weight)) modelled(:) = modelled + proximal_weight*step
            change(:) = modelled - asked
            do k = 1, size(own)
                associate (i => own(k)%node)
                    change(i) = change(i) + work%reaction(k)
                end associate
            end do
        end subroutine take_model

        !> How far to go to the solution of the model: all the way, or to where the energy no longer falls. Supports count by their
        !> forces at the end of the way, which overrates their energy before
        function way_to_flat() result(t)
            real(wp) :: t, at, first, half
            type(bracket_type) :: bracket
            integer :: number

            first = energy_slope(0.0_wp)
            t = 1.0_wp
            at = energy_slope(t)
            if (at <= 0.0_wp .or. .not. first < 0.0_wp) return
            bracket = bracket_type(0.0_wp, t, first, at)
            do number = 1, most_line_steps
                if (at <= flat_energy*abs(first) .and. at >= -flat_energy*abs(first)) then
                    if (at <= 0.0_wp) exit
                    ! The slope never falls, so the energy falls by no less than this
                    half = energy_slope(t/2)
                    if (half + at <= -flat_energy*abs(first)) exit
                end if
                t = place_inside(bracket)
                at = energy_slope(t)
                call narrow(bracket, t, at)
            end do
        end function way_to_flat

        !> Slope of the energy along the step
        function energy_slope(t) result(at)
            real(wp), intent(in) :: t
            real(wp) :: at, force(0:last), ignored(0:last)
            integer :: nodes

            asked_for = asked_for + n
            call press(ground, points, w + t*step, force, ignored, nodes)
            at = dot_product(step, force - modelled + (1 - t)*change)
        end function energy_slope

        !> Go along a motion that nothing of the model stops, as far as the energy falls
        subroutine follow_motion(stopped)
            !> Does it fall for a part of the way only
            logical, intent(out) :: stopped
            real(wp), allocatable :: motion(:)
            real(wp) :: level(0:last), gain, parts, length, t
            type(bracket_type) :: bracket
            integer :: number

            step(:) = 0.0_wp
            step(0:n) = outcome%motion
            call turn_with(beam, step)
            call find_level_forces(own, acting(:size(own)), level)
            call work_of_loads(beam, factor, step(0:n), [0, n], gain, parts)
            gain = gain - dot_product(step, level)
            modelled(:) = push
            change(:) = 0.0_wp
            length = max(sum(ground%pieces%length), maxval(abs(w(0:n))))
            bracket = bracket_type(0.0_wp, first_way*length, -gain, 0.0_wp)
            do
                bracket%at_high = energy_slope(bracket%high) - gain
                stopped = bracket%at_high > 0.0_wp .or. .not. gain > 0.0_wp
                if (stopped .or. .not. bracket%high <= min(last_way*length, huge(length))) exit
                bracket = bracket_type(bracket%high, 8*bracket%high, bracket%at_high, 0.0_wp)
            end do
            if (.not. stopped) then
                allocate (motion(0:size(ground%pieces)), source=outcome%motion(mesh%node))
                call move_alloc(motion, outcome%motion)
                return
            end if
            do number = 1, most_line_steps
                if (bracket%at_low >= -flat_energy*gain) exit
                t = place_inside(bracket)
                call narrow(bracket, t, energy_slope(t) - gain)
            end do
            w = w + bracket%low*step
            call press(ground, points, w, push, slope, pressed)
        end subroutine follow_motion

    end subroutine find_least_energy

end module gapbeam_ground_energy
