!> Parts of the search for the contact state, each by itself
program test_contact
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, infinite
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: band_ok, band_mechanism, hinge, restrained
    use gapbeam_model, only: beam_type, node_support_type, order_supports, softest, below, above, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads, apply_scheme
    use gapbeam_system, only: solve_scheme
    use gapbeam_reactions, only: find_shears
    use gapbeam_signs, only: sign_type, prepare_signs, find_clearly_wrong
    use gapbeam_rules, only: find_wrong, find_doubtful, keep_worst_pull, keep_local_worst, &
        keep_least_index
    use gapbeam_kinematics, only: free_motions, motion_type, work_of_loads, held_by_ties
    use gapbeam_contact_boundary, only: base_type, find_base, move_boundaries
    use gapbeam_subdomain, only: least_margin, next_stretch, extract_subdomain
    use gapbeam_interior_point, only: interior_type, start_interior, step_interior, product_of
    implicit none
    integer :: status

    call weak_springs()
    call reactions_of_two_spans()
    call shear_of_a_short_link()
    call rules()
    call motions()
    call ties()
    call work_along_a_motion()
    call bases()
    call a_front_moves()
    call margins_of_parts()
    call stretches()
    call a_part_is_the_beam()
    call interior_points()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Equal spans of length 1 and EI 1 under a load per length
    subroutine spans(n, q, supports, beam)
        integer, intent(in) :: n
        real(wp), intent(in) :: q
        type(node_support_type), intent(in) :: supports(:)
        type(beam_type), intent(out) :: beam
        type(sample_type) :: sample

        call make_beam(spread(1.0_wp, 1, n), spread(1.0_wp, 1, n), spread(q, 1, n), spread(0.0_wp, 1, n), supports, sample)
        beam = sample%beam
    end subroutine spans

    !> Rigid supports at all nodes of so many spans
    function at_all(n, side) result(supports)
        integer, intent(in) :: n, side
        type(node_support_type) :: supports(n + 1)
        integer :: i

        do i = 0, n
            supports(i + 1) = node_support_type(i, side, infinite(), 0.0_wp)
        end do
    end function at_all

    !> A solved scheme
    subroutine solve(beam, closed, work, state)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(out) :: work
        integer, intent(out) :: state
        integer :: place

        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call solve_scheme(beam, closed, work, state, place)
    end subroutine solve

    !> A stiffness far below all others
    subroutine weak_springs()
        type(beam_type) :: beam

        call spans(2, 0.0_wp, at_all(2, both), beam)
        call check_close(softest(beam), 1/24.0_wp, "EI/L**3 of the whole beam, a third of it")
        call spans(2, 0.0_wp, [node_support_type(0, both, 3e-6_wp, 0.0_wp), node_support_type(1, both, 0.0_wp, 0.0_wp)], beam)
        call check_close(softest(beam), 1e-6_wp, "a soft support's, not that of one without stiffness")
        call make_rigid(beam)
        call order_supports(at_all(2, both), beam)
        call check_close(softest(beam), 1/3.0_wp, "nothing is elastic")
    end subroutine weak_springs

    subroutine make_rigid(beam)
        type(beam_type), intent(inout) :: beam

        beam%links%bending = 0.0_wp
    end subroutine make_rigid

    !> Two spans under uniform load: 3/8, 10/8, 3/8
    subroutine reactions_of_two_spans()
        type(beam_type) :: beam
        type(workspace_type) :: work
        integer :: state

        call spans(2, 8.0_wp, at_all(2, both), beam)
        call solve(beam, [.false., .true., .false.], work, state)
        call check(state == band_mechanism, "one support alone holds nothing")
        call solve(beam, [.true., .true., .true.], work, state)
        call check(state == band_ok, "three do")
        call check_close(work%reaction, [3.0_wp, 10.0_wp, 3.0_wp], "reactions")
        call check_close(work%shear, [-1.0_wp, 1.0_wp], "shears beside those of the simple bars")
        call check(all(work%reaction_error > 0.0_wp .and. work%reaction_error < 1e-13_wp), "known to rounding")
        call solve(beam, [.true., .false., .true.], work, state)
        call check_close(work%reaction, [8.0_wp, 0.0_wp, 8.0_wp], "an open one carries nothing")
        call check_close(work%answers(1)%deflection, 5*8*2.0_wp**4/384, "5 q L**4/384 EI")
    end subroutine reactions_of_two_spans

    !> A link of length 1e-9 gets its shear from the equilibrium of its node
    subroutine shear_of_a_short_link()
        type(sample_type) :: sample
        type(workspace_type) :: work
        integer :: state

        call make_beam([1.0_wp, 1e-9_wp, 1.0_wp], spread(1.0_wp, 1, 3), spread(0.0_wp, 1, 3), spread(0.0_wp, 1, 3), &
                       [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(3, both, infinite(), 0.0_wp)], sample)
        sample%beam%force(1, 1) = 2.0_wp
        call solve(sample%beam, [.true., .true.], work, state)
        call find_shears(sample%beam, [1, 3], work)
        call check_close(work%shear, [1.0_wp, -1.0_wp, -1.0_wp], "shears beside a force at midspan", 1e-8_wp)
        call check_close(work%shear(2), work%shear(3), "the short link has its neighbour's")
        call check(work%shear_error(2) < 1e-12_wp, "and says how well it is known")
    end subroutine shear_of_a_short_link

    !> Which supports are wrong, and which of them a rule changes
    subroutine rules()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(sign_type) :: signs
        logical :: wrong(6), doubtful
        integer :: state, number
        logical, parameter :: t = .true., f = .false.

        ! A force up at node 1 of two spans: with all supports closed the right end pushes, the middle pulls
        call spans(2, 0.0_wp, at_all(2, below), beam)
        beam%force(1, 0:2) = [1.0_wp, -1.0_wp, 1.0_wp]
        call solve(beam, [t, t, t], work, state)
        call find_wrong(beam, [t, t, t], 32.0_wp, work, wrong(:3))
        call check(all(wrong(:3) .eqv. [f, t, f]), "the middle support pulls")
        call prepare_signs(beam, work, signs)
        call find_clearly_wrong(beam, signs, [t, t, t], work, wrong(:3), number, doubtful)
        call check(all(wrong(:3) .eqv. [f, t, f]) .and. number == 1 .and. .not. doubtful, "clearly so")
        beam%force(1, :) = 0.0_wp
        call solve(beam, [t, t, t], work, state)
        call find_doubtful(beam, [t, t, t], work, wrong(:3), doubtful)
        call check(all(wrong(:3)) .and. .not. doubtful, "without loads all is exactly zero")
        call find_clearly_wrong(beam, signs, [t, t, t], work, wrong(:3), number, doubtful)
        call check(doubtful, "so nothing is clear")
        beam%force(1, 0:2) = [1.0_wp, 1.0_wp, 1.0_wp]
        beam%supports(2)%contact = 0.5_wp
        call prepare_signs(beam, work, signs)
        call solve(beam, [t, f, t], work, state)
        work%answers%deflection = [0.0_wp, 0.5_wp + 1e-13_wp, 0.0_wp]
        call find_clearly_wrong(beam, signs, [t, f, t], work, wrong(:3), number, doubtful)
        call check(doubtful, "a deflection near contact is not clear")
        work%answers%deflection = [0.0_wp, 0.5_wp + 1e-3_wp, 0.0_wp]
        call find_clearly_wrong(beam, signs, [t, f, t], work, wrong(:3), number, doubtful)
        call check(all(wrong(:3) .eqv. [f, t, f]) .and. .not. doubtful, "one beyond it is")
        beam%supports(2)%node = 0
        beam%supports(2)%side = above
        call order_supports([beam%supports], beam)
        call prepare_signs(beam, work, signs)
        call find_clearly_wrong(beam, signs, [t, f, t], work, wrong(:3), number, doubtful)
        call check(doubtful, "nor is the share of a rigid support that is not alone")

        call spans(5, 0.0_wp, at_all(5, below), beam)
        call new_workspace(beam, work)
        work%reaction = [-2.0_wp, 1.0_wp, -3.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
        work%reaction_error = 0.0_wp
        work%answers%deflection = [0.0_wp, 0.0_wp, 0.0_wp, 0.25_wp, 0.5_wp, 0.0_wp]
        work%deflection_size = 1.0_wp
        associate (closed => [t, t, t, f, f, t])
            call find_wrong(beam, closed, 32.0_wp, work, wrong)
            call check(all(wrong .eqv. [t, f, t, t, t, f]), "two pull, two are penetrated")
            call keep_worst_pull(closed, work, wrong)
            call check(all(wrong .eqv. [f, f, t, t, t, f]), "the paper's rule: one is released, all are put back")
            call find_wrong(beam, closed, 32.0_wp, work, wrong)
            call keep_local_worst(beam, closed, work, wrong)
            call check(all(wrong .eqv. [f, f, f, f, t, f]), "one in a neighbourhood: put back first, the deepest")
            work%answers%deflection = 0.0_wp
            call find_wrong(beam, closed, 32.0_wp, work, wrong)
            call keep_local_worst(beam, closed, work, wrong)
            call check(all(wrong .eqv. [t, f, t, f, f, f]), "then every group releases its worst")
            call keep_least_index(wrong)
            call check(all(wrong .eqv. [t, f, f, f, f, f]), "Murty's rule")
            wrong = f
            call keep_worst_pull(closed, work, wrong)
            call check(.not. any(wrong), "nothing wrong, nothing to change")
        end associate
    end subroutine rules

    !> Free motions, by counting
    subroutine motions()
        type(beam_type) :: beam
        type(motion_type), allocatable :: found(:)

        call spans(4, 0.0_wp, at_all(4, both), beam)
        call free_motions(beam, spread(.false., 1, 5), found)
        call check(size(found) == 2, "held by nothing: two motions")
        call free_motions(beam, [.false., .true., .false., .false., .false.], found)
        call check(size(found) == 1, "held at one place: one motion")
        if (size(found) == 1) then
            call check(found(1)%first == 0 .and. found(1)%last == 4, "of the whole beam")
            call check_close(abs(found(1)%displacement), [1.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp]/3, "about that place")
            call check(found(1)%displacement(0)*found(1)%displacement(4) < 0.0_wp, "one end up, one down")
        end if
        call free_motions(beam, [.true., .false., .false., .false., .true.], found)
        call check(size(found) == 0, "held at two places: none")
        beam%kind(2) = hinge
        call free_motions(beam, [.true., .false., .false., .false., .true.], found)
        call check(size(found) == 1, "but for a hinge between")
        if (size(found) == 1) call check_close(abs(found(1)%displacement), [0.5_wp, 1.0_wp, 0.5_wp], "that goes down")
        beam%kind(0) = restrained
        call free_motions(beam, [.true., .false., .false., .false., .true.], found)
        call check(size(found) == 0, "and a clamp")
        call free_motions(beam, spread(.false., 1, 5), found)
        call check(size(found) == 2, "which, without a support, can slide across, the other body turns")
    end subroutine motions

    !> Supports that carry nothing may be all that holds the beam
    subroutine ties()
        type(beam_type) :: beam
        logical, parameter :: t = .true., f = .false.

        call spans(2, 0.0_wp, at_all(2, below), beam)
        call check(.not. held_by_ties(beam, [t, t, t], [f, f, f]), "all carry")
        call check(.not. held_by_ties(beam, [t, t, t], [f, f, t]), "two of them do")
        call check(held_by_ties(beam, [t, t, t], [f, t, t]), "one of them does: the beam may lift off the others")
        beam%supports(3)%side = above
        call check(.not. held_by_ties(beam, [t, t, t], [f, t, t]), "not if one holds it from above")
    end subroutine ties

    !> Work of loads along a motion
    subroutine work_along_a_motion()
        type(beam_type) :: beam
        real(wp) :: done, parts

        call spans(2, 6.0_wp, at_all(2, both), beam)
        beam%force(2, 2) = 4.0_wp
        beam%couple(2, 1) = 1.0_wp
        call work_of_loads(beam, 0.5_wp, [-1.0_wp, 0.0_wp, 1.0_wp], [0, 2], done, parts)
        call check_close(done, 0.5*(4.0_wp + 1.0_wp), "force and couple; the uniform load balances about the middle")
        call check(parts >= abs(done) + 6.0_wp, "the parts that cancel are not forgotten")
        call work_of_loads(beam, 0.0_wp, [1.0_wp, 1.0_wp, 1.0_wp], [0, 2], done, parts)
        call check_close(done, 12.0_wp, "weight of a beam that falls")
    end subroutine work_along_a_motion

    !> Where boundaries can be, and the moment of a beam that follows a parabola: -EI w''
    subroutine bases()
        type(beam_type) :: beam
        type(base_type) :: base
        integer :: i
        type(node_support_type) :: supports(8)

        supports(1:7) = [(node_support_type(i, below, infinite(), 0.25_wp*i**2), i=0, 6)]
        supports(8) = node_support_type(2, above, 1.0_wp, 0.0_wp)
        supports(7)%side = both
        call spans(6, 0.0_wp, supports, beam)
        beam%kind(4) = hinge
        call find_base(beam, base)
        call check(all(base%support(-1:7) == [0, 1, 2, 0, 4, 0, 6, 0, 0]), &
                   "not with another beside it, at a hinge, where it holds both ways")
        call check(.not. any(abs(base%moment) > 0.0_wp), "no moment where neighbours are missing")
        call order_supports(supports(:7), beam)
        beam%kind(4) = 0
        call find_base(beam, base)
        call check_close(base%moment, [0.0_wp, -0.5_wp, -0.5_wp, -0.5_wp, -0.5_wp, 0.0_wp, 0.0_wp], "along a parabola")
    end subroutine bases

    !> A beam of unit weights at its nodes, lifted at its left end by P: statics lift as many supports as 2 P - 1
    subroutine a_front_moves()
        integer, parameter :: n = 40
        type(beam_type) :: beam
        type(base_type) :: base
        type(workspace_type) :: work
        logical :: wrong(n + 1), first(n + 1)
        integer :: state, i

        call spans(n, 0.0_wp, at_all(n, below), beam)
        beam%force(1, :) = 1.0_wp
        beam%force(2, 0) = -5.25_wp
        call solve(beam, spread(.true., 1, n + 1), work, state)
        call find_wrong(beam, spread(.true., 1, n + 1), 32.0_wp, work, first)
        call check(first(1) .and. count(first) == 1, "at first one support pulls")
        call find_base(beam, base)
        wrong = first
        call move_boundaries(beam, spread(.true., 1, n + 1), work, base, 2, wrong)
        call check(all(wrong .eqv. [(i <= 10, i=1, n + 1)]), "ten are passed")
        wrong = first
        call move_boundaries(beam, spread(.true., 1, n + 1), work, base, 11, wrong)
        call check(all(wrong .eqv. first), "fewer than are asked for are left to switching")
        wrong = .false.
        call move_boundaries(beam, spread(.true., 1, n + 1), work, base, 2, wrong)
        call check(.not. any(wrong), "nothing wrong, nothing moves")
    end subroutine a_front_moves

    !> Nodes that go with a part
    subroutine margins_of_parts()
        type(beam_type) :: beam

        call spans(10, 0.0_wp, at_all(10, below), beam)
        call check(least_margin(beam) == 20, "twenty at least")
        beam%supports%stiffness = 1e-12_wp
        call check(least_margin(beam) == 0, "supports so soft that everything feels everything")
        beam%supports%side = both
        call check(least_margin(beam) == 20, "those that hold both ways do not count")
        call spans(900, 0.0_wp, at_all(900, below), beam)
        call check(least_margin(beam) == 30, "the root of all")
    end subroutine margins_of_parts

    !> Stretches around chosen supports
    subroutine stretches()
        type(beam_type) :: beam
        logical :: chosen(41)
        integer :: place, from, to

        call spans(40, 0.0_wp, at_all(40, below), beam)
        chosen = .false.
        place = 1
        call next_stretch(beam, chosen, 5, place, from, to)
        call check(from < 0, "nothing chosen, no stretch")
        chosen([3, 12, 38]) = .true.
        place = 1
        call next_stretch(beam, chosen, 5, place, from, to)
        call check(from == 0 .and. to == 16, "two that come near are one, cut at the end of the beam")
        call next_stretch(beam, chosen, 5, place, from, to)
        call check(from == 32 .and. to == 40, "the next")
        call next_stretch(beam, chosen, 5, place, from, to)
        call check(from < 0, "and no more")
    end subroutine stretches

    !> A stretch with what the rest does to it is solved as the whole
    subroutine a_part_is_the_beam()
        integer, parameter :: n = 12, from = 3, to = 8
        type(beam_type) :: beam, part
        type(workspace_type) :: work, part_work
        integer, allocatable :: number(:)
        logical :: closed(n + 1)
        integer :: state, place, i

        call spans(n, 1.0_wp, at_all(n, below), beam)
        beam%force(1, 5) = 7.0_wp
        beam%couple(1, 6) = -2.0_wp
        closed = .true.
        closed(7) = .false.
        call solve(beam, closed, work, state)
        call extract_subdomain(beam, closed, work, from, to, part, part_work, number)
        call check(all(number == [(i, i=from + 1, to + 1)]), "its supports")
        call check(all(part%supports%side == [both, both, below, below, both, both]), "the outermost two hold both ways")
        call solve_scheme(part, closed(number), part_work, state, place)
        call check(state == band_ok, "solved")
        call check_close(part_work%answers(:)%moment_left, [0.0_wp, work%answers(from + 1:to)%moment_left], "same moments")
        call check_close(part_work%answers(:)%deflection, work%answers(from:to)%deflection, "same deflections")
        call check_close(part_work%reaction, work%reaction(number), "same reactions", 1e-12_wp)
        closed(9) = .false.
        closed(4) = .false.
        call extract_subdomain(beam, closed, work, 0, n, part, part_work, number)
        call check(all(part%supports%side == below), "nothing is cut, nothing is held")
    end subroutine a_part_is_the_beam

    !> The paper's beam by interior points: the product falls, the scheme shows
    subroutine interior_points()
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(interior_type) :: iterate
        logical :: guess(4)
        real(wp) :: before
        integer :: state, place, step

        call check_close(product_of(iterate), 0.0_wp, "nothing begun")
        call spans(3, 0.0_wp, [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(1, above, infinite(), 0.0_wp), &
                               node_support_type(2, below, 1e4_wp, 0.0_wp), node_support_type(3, below, infinite(), 0.0_wp)], beam)
        beam%kind(0) = restrained
        beam%force(1, :) = [0.0_wp, 0.70707_wp, -4.3597_wp, 2.1155_wp]
        call new_workspace(beam, work)
        call set_loads(beam, 1.0_wp, work)
        call start_interior(beam, [.true., .false., .false., .false.], work, iterate, state, place)
        call check(state == band_ok, "on springs every scheme is solved")
        call check(all(iterate%support == [2, 3, 4]), "one-sided supports only")
        call check_close([iterate%side, iterate%contact, iterate%compliance], &
                         [-1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1e-4_wp, 0.0_wp], "their law")
        call check(minval([iterate%reaction, iterate%opening]) > 0.0_wp, "begins inside")
        before = huge(before)
        do step = 1, 6
            call step_interior(beam, [.true., .false., .false., .false.], work, iterate, guess, state, place)
            call check(state == band_ok .and. product_of(iterate) < before, "every step makes the product smaller")
            before = product_of(iterate)
        end do
        call check(all(guess .eqv. [.true., .true., .false., .true.]), "the scheme of the paper")
        call check(minval([iterate%reaction, iterate%opening]) > 0.0_wp, "and stays inside")
        call apply_scheme(beam, guess, [0, 3], work)
        call check(all(work%nodes%held .eqv. [.true., .true., .false., .true.]), "afterwards supports are themselves again")
    end subroutine interior_points

end program test_contact
