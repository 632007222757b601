!> Zones of contact that carry nothing, or are too short for what they would have to carry
module gapbeam_ground_ties
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: min_tied_zone, least_tied_share, most_tied_slope, no_tied_force, fine_rounding
    use gapbeam_piece_quad, only: piece_load_type, combine_loads, greatest_softness
    use gapbeam_ground_quad, only: ground_type, zones_type, grounded_type
    use gapbeam_nodes, only: is_hinge
    use gapbeam_layers_quad, only: other_way, has_limit
    use gapbeam_ground_laws_quad, only: line_of_breakpoint
    use gapbeam_zone_fields_quad, only: fields_at_ends
    use gapbeam_workspace_quad, only: workspace_type
    use gapbeam_model_quad, only: beam_type, last_place
    use gapbeam_turning_quad, only: turn_with
    use gapbeam_law, only: both
    use gapbeam_polyline_quad, only: piece_that_acts
    use gapbeam_law_kinematics_quad, only: leaves_all
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_kinematics_quad, only: free_motions, motion_type
    implicit none
    private
    public :: size_of_loads, stands_on_edge, may_move, presses_ground, least_force, come_to_rest

contains

    !> Does a zone of no length carry what none can: a force, as under a load at the very end of the ground, or a couple; or is the
    !> beam pressed into the ground there, which is so where it turns over an edge without end
    pure subroutine stands_on_edge(ground, factor, zones, grounded, closed, work, stands)
        !> The beam and its ground, and the load factor
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: factor
        !> The zones that its solution asks for, and the beam on those before, as many
        type(zones_type), intent(in) :: zones
        type(grounded_type), intent(in) :: grounded
        !> States of the supports
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        logical, intent(out) :: stands
        real(qp) :: length, rounding, slope
        real(wp) :: force, way, modulus
        logical :: acts
        integer :: i

        length = sum(ground%pieces%length)
        stands = .false.
        if (.not. any(is_short(zones%to - zones%from) .and. any(zones%acts > 0, 1))) return
        call size_of_loads(ground, real(factor, wp), force, way, modulus)
        associate (supports => grounded%beam%supports)
            do i = 1, size(supports)
                if (supports(i)%node > size(zones%piece) .or. .not. abs(work%reaction(i)) > 0.0_qp) cycle
                if (supports(i)%breakpoint > 0) then
                    ! However far the beam goes along a level piece, that is no size
                    call piece_that_acts(supports, closed, i, acts, slope)
                    if (.not. (acts .and. abs(slope) > 0.0_qp)) cycle
                end if
                way = max(way, real(abs(work%answers(supports(i)%node)%deflection), wp))
            end do
        end associate
        ! Without loads forces are rounding of what movements of the ground would make, and depths that of deflections
        force = real(max(least_tied_share*force, fine_rounding*length*modulus*way), wp)
        rounding = fine_rounding*max(real(way, qp), maxval(abs(work%answers%deflection)))
        do i = 1, size(zones%piece)
            associate (along => zones%to(i) - zones%from(i))
                if (.not. (is_short(along) .and. any(zones%acts(:, i) > 0))) cycle
                stands = force_on(grounded, factor, work, i, length) > force .or. &
                    depth_in(ground, grounded, zones, work, i, min_tied_zone*length) > rounding + most_tied_slope*way*along/length
            end associate
            if (stands) return
        end do

    contains

        !> Is a stretch so short that it counts as none
        elemental function is_short(along)
            real(qp), intent(in) :: along
            logical :: is_short

            is_short = along <= min_tied_zone*length
        end function is_short

    end subroutine stands_on_edge

    !> Force, or couple by the length of the beam, of the ground on a stretch: what shear and moment gain
    pure function force_on(grounded, factor, work, i, length) result(force)
        type(grounded_type), intent(in) :: grounded
        real(qp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Number of the stretch, and length of the beam
        integer, intent(in) :: i
        real(qp), intent(in) :: length
        real(qp) :: force, rotation(2), shear(2)

        call fields_at_ends(grounded, factor, work, i, rotation, shear)
        force = max(abs(shear(2) - shear(1)), abs(work%answers(i)%moment_left - work%answers(i - 1)%moment_right)/length)
    end function force_on

    !> How deep the beam is pressed into the ground at the ends of a stretch, in the layers that act one way, and on it alone
    pure function depth_in(ground, grounded, zones, work, i, short) result(depth)
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        type(workspace_type), intent(in) :: work
        integer, intent(in) :: i
        !> Length up to which stretches count as none
        real(qp), intent(in) :: short
        real(qp) :: depth
        integer :: k

        depth = 0.0_qp
        associate (j => zones%piece(i), a => work%answers(i - 1), b => work%answers(i))
            do k = ground%first(j), ground%first(j + 1) - 1
                associate (layer => ground%layers(k), length => ground%pieces(j)%length)
                    if (layer%side == 0 .or. zones%acts(k - ground%first(j) + 1, i) == 0) cycle
                    if (goes_on(ground, grounded%beam%kind, zones, i, layer%side, short)) cycle
                    depth = max(depth, &
                                layer%side*(a%deflection - line_of_breakpoint(ground%laws, layer, 1, zones%from(i), length)), &
                                layer%side*(b%deflection - line_of_breakpoint(ground%laws, layer, 1, zones%to(i), length)))
                end associate
            end do
        end associate
    end function depth_in

    !> Does ground on one side act beside a stretch as well, on more than another short one. Beyond a hinge it holds no rotation
    pure function goes_on(ground, kind, zones, i, side, short) result(it_does)
        type(ground_type), intent(in) :: ground
        !> Kinds of the nodes between the stretches, shape (0:m)
        integer, intent(in) :: kind(0:)
        type(zones_type), intent(in) :: zones
        !> The stretch, the side, and as for depth_in
        integer, intent(in) :: i, side
        real(qp), intent(in) :: short
        logical :: it_does
        integer :: j, step

        it_does = .false.
        do step = -1, 1, 2
            j = i + step
            do while (j >= 1 .and. j <= size(zones%piece))
                if (is_hinge(kind(min(j, j - step)))) exit
                associate (first => ground%first(zones%piece(j)), next => ground%first(zones%piece(j) + 1))
                    if (.not. any(zones%acts(:next - first, j) > 0 .and. ground%layers(first:next - 1)%side == side)) exit
                end associate
                it_does = zones%to(j) - zones%from(j) > short
                if (it_does) return
                j = j + step
            end do
        end do
    end function goes_on

    !> Sum of the sizes of all loads as forces, imposed curvatures by what would straighten the beam; and how far loads and gaps
    !> may move it
    pure subroutine size_of_loads(ground, factor, force, way, modulus)
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        real(wp), intent(out) :: force, way
        !> Greatest modulus of the ground
        real(wp), intent(out) :: modulus
        real(wp) :: length, kappa, bent, soft(2), softest(2), curved
        integer :: j

        length = real(sum(ground%pieces%length), wp)
        force = sum(combined(ground%beam%force(1, :), ground%beam%force(2, :))) &
            + sum(combined(ground%beam%couple(1, :), ground%beam%couple(2, :)))/length
        kappa = 0.0_wp
        bent = 0.0_wp
        softest(:) = 0.0_wp
        do j = 1, size(ground%pieces)
            associate (dead => ground%dead(j), live => ground%live(j))
                force = force + real(ground%pieces(j)%length, wp)*max(combined(dead%qa, live%qa), combined(dead%qb, live%qb)) &
                    + (combined(dead%couple_a, live%couple_a) + combined(dead%couple_b, live%couple_b))/length
                curved = combined(dead%kappa, live%kappa) + combined(dead%rise, live%rise)
                kappa = max(kappa, curved + max(combined(dead%kink_a, live%kink_a), combined(dead%kink_b, live%kink_b))/length)
                soft(:) = real(greatest_softness(ground%pieces(j)), wp)
                if (soft(1) > 0.0_wp) bent = max(bent, curved/(soft(1)*length))
                softest = max(softest, soft)
            end associate
        end do
        ! The first parameter of a law that is not by points is its stiffness
        modulus = real(maxval([0.0_qp, ground%layers%modulus_a, ground%layers%modulus_b, ground%laws%slope_a, &
                               ground%laws%slope_b, ground%layers%parameter_a(1), ground%layers%parameter_b(1)]), wp)
        way = kappa*length**2 + real(maxval(abs([0.0_qp, ground%layers%contact_a, ground%layers%contact_b])), wp) &
            + force*length*(softest(1)*length**2 + softest(2))
        if (modulus > 0.0_wp) way = way + force/(length*modulus)
        do j = 1, size(ground%beam%supports)
            associate (s => ground%beam%supports(j))
                if (s%node <= size(ground%pieces) .and. abs(s%contact) <= huge(1.0_wp)) way = max(way, real(abs(s%contact), wp))
            end associate
        end do
        force = force + bent

    contains

        !> Size of what dead and live load come to
        elemental function combined(dead, live)
            real(qp), intent(in) :: dead, live
            real(wp) :: combined

            combined = abs(real(dead, wp) + factor*real(live, wp))
        end function combined

    end subroutine size_of_loads

    !> Up to which a force of the ground is none. The gain of the shear does not tell: on a beam that lies evenly it is 0, since the
    !> load is in it
    pure function least_force(ground, factor, carried, work) result(least)
        !> As for stands_on_edge
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: factor
        !> Forces of the layers on the stretches, up, shape (most layers, stretches): of a layer that pushes one way 0 only if its
        !> pressure is
        real(wp), intent(in) :: carried(:, :)
        type(workspace_type), intent(in) :: work
        real(wp) :: least
        real(wp) :: force, way, modulus

        call size_of_loads(ground, real(factor, wp), force, way, modulus)
        least = real(no_tied_force, wp)*max(force, maxval(sum(abs(carried), 1)), &
                                            real(maxval([0.0_qp, abs(work%reaction)]), wp), &
                                            real(maxval([0.0_qp, abs(ground%beam%supports%force)]), wp), &
                                            real(sum(ground%pieces%length), wp)*modulus*way)
    end function least_force

    !> A beam without loads on which nothing pushes has no forces: what is left of them is rounding, of which none is left beside it
    pure subroutine come_to_rest(ground, factor, solution)
        !> As for stands_on_edge
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: factor
        !> With the force that is none
        type(ground_solution_type), intent(inout) :: solution
        type(piece_load_type) :: load
        real(qp) :: farthest
        integer :: j

        if (any(abs(solution%resultant) > solution%no_force) .or. any(abs(solution%reaction) > solution%no_force)) return
        ! Restraints make moments of an imposed curvature, without any force
        if (any(max(abs(solution%moment_left), abs(solution%moment_right)) > solution%no_force*sum(ground%pieces%length))) return
        ! Pressures both ways under one stretch may balance each other
        if (any(ground%layers%side == both)) return
        if (any(abs(ground%beam%force(1, :) + factor*ground%beam%force(2, :)) > 0.0_qp) &
            .or. any(abs(ground%beam%couple(1, :) + factor*ground%beam%couple(2, :)) > 0.0_qp)) return
        do j = 1, size(ground%pieces)
            load = combine_loads(ground%dead(j), ground%live(j), factor)
            if (any(abs([load%qa, load%qb, load%force, load%couple, load%couple_a, load%couple_b]) > 0.0_qp)) return
        end do
        if (any(abs(ground%pieces%tension) > 0.0_qp) .or. any(abs(ground%pieces%tension_change) > 0.0_qp)) return
        solution%resultant(:, :) = 0.0_wp
        solution%reaction(:) = 0.0_wp
        solution%shear(:, :) = 0.0_wp
        solution%force(:, :) = 0.0_wp
        solution%moment_left(:) = 0.0_wp
        solution%moment_right(:) = 0.0_wp
        solution%ends%moment_a = 0.0_wp
        solution%ends%moment_b = 0.0_wp
        solution%loads%qa = 0.0_wp
        solution%loads%qb = 0.0_wp
        ! Nor is what rounding leaves of the places of its supports a deflection
        farthest = maxval(abs(ground%beam%supports%contact))
        if (any(abs(solution%deflection) > fine_rounding*farthest)) return
        if (any(abs(solution%rotation)*sum(ground%pieces%length) > fine_rounding*farthest)) return
        solution%deflection(:) = 0.0_wp
        solution%rotation(:, :) = 0.0_wp
        solution%slope(:) = 0.0_wp
        solution%ends%w_a = 0.0_wp
        solution%ends%w_b = 0.0_wp
    end subroutine come_to_rest

    !> Does a motion go into ground whose force has no limit
    pure function presses_ground(ground, motion) result(presses)
        type(ground_type), intent(in) :: ground
        !> Downward displacements of the nodes of the beam without ground, shape (0:n)
        real(wp), intent(in) :: motion(0:)
        logical :: presses
        integer :: j, k

        presses = .false.
        do j = 1, size(ground%pieces)
            do k = ground%first(j), ground%first(j + 1) - 1
                associate (layer => ground%layers(k), moves => motion(j - 1:j))
                    if (has_limit(layer, ground%laws)) cycle
                    presses = presses .or. any(layer%side*moves > 0.0_wp) .or. layer%side == 0 .and. any(abs(moves) > 0.0_wp)
                end associate
            end do
        end do
    end function presses_ground

    !> May the beam move although it is in equilibrium: off supports and ground that carry nothing, and against nothing else
    function may_move(ground, zones, grounded, closed, solution) result(free)
        !> As for stands_on_edge
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        type(grounded_type), intent(in) :: grounded
        !> States of the supports, and the solution
        logical, intent(in) :: closed(:)
        type(ground_solution_type), intent(in) :: solution
        logical :: free
        type(beam_type) :: beam
        type(motion_type), allocatable :: motions(:)
        logical :: idle(size(zones%piece))
        real(qp) :: moved(0:last_place(grounded%beam))
        integer :: i, m, sense

        free = .false.
        do i = 1, size(zones%piece)
            idle(i) = acts_one_way(i) .and. sum(abs(solution%resultant(:, i))) <= solution%no_force
        end do
        if (.not. (any(idle) .or. any(closed .and. solution%undecided))) return
        beam = grounded%beam
        where (idle)
            beam%ground%grounded = .false.
            beam%ground%gaa = (grounded%stretches%tension + grounded%stretches%tension_change/2)/grounded%stretches%length
        end where
        call free_motions(beam, closed .and. .not. solution%undecided, motions)
        do m = 1, size(motions)
            moved(:) = 0.0_qp
            moved(motions(m)%first:motions(m)%last) = motions(m)%displacement
            call turn_with(beam, moved)
            do sense = -1, 1, 2
                free = free .or. (leaves_all(beam%supports, solution%undecided, moved, sense) &
                                  .and. leaves_ground(motions(m), sense))
            end do
        end do

    contains

        !> Do all layers of a stretch that act push one way only
        pure function acts_one_way(i) result(one_way)
            integer, intent(in) :: i
            logical :: one_way
            integer :: k

            one_way = any(zones%acts(:, i) > 0)
            associate (first => ground%first(zones%piece(i)), last => ground%first(zones%piece(i) + 1) - 1)
                do k = first, last
                    if (zones%acts(k - first + 1, i) == 0) cycle
                    one_way = ground%layers(k)%side /= 0 .and. other_way(ground%layers(first:last), k - first + 1) == 0
                    if (.not. one_way) return
                end do
            end associate
        end function acts_one_way

        !> Does a motion press on no ground that is touched
        pure function leaves_ground(motion, sense) result(leaves)
            type(motion_type), intent(in) :: motion
            integer, intent(in) :: sense
            logical :: leaves
            integer :: i, k, node

            leaves = .true.
            do i = 1, size(idle)
                if (.not. idle(i)) cycle
                associate (first => ground%first(zones%piece(i)))
                    do k = first, ground%first(zones%piece(i) + 1) - 1
                        if (zones%acts(k - first + 1, i) == 0) cycle
                        do node = max(i - 1, motion%first), min(i, motion%last)
                            leaves = leaves .and. sense*ground%layers(k)%side*motion%displacement(node) <= min_tied_zone
                        end do
                    end do
                end associate
            end do
        end function leaves_ground

    end function may_move

end module gapbeam_ground_ties
