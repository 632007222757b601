!> The contact state of a beam, or the proof that it has no equilibrium: the search, around it what mechanisms need.
!>
!> Where the bilateral supports alone hold the beam every scheme is stable, and gapbeam_search ends with the right one.
!> Other beams may pass through mechanisms. Then weak springs towards a reference position hold it, the reference
!> moves to the solution, and this is repeated: the proximal point method (Rockafellar 1976). The springs are
!> gone from the final answer. If the reference runs away along a free motion that no support can stop and along
!> which the loads do work, there is no equilibrium: that motion is the proof (Farkas' lemma).
module gapbeam_contact_state
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_moves
    use gapbeam_tolerances, only: sign_width, proximal_ratio, least_spring_force, at_rest_share, no_speed
    use gapbeam_require, only: checked, require
    use gapbeam_error, only: error_type, fatal_error, out_of_range, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_indeterminate, gapbeam_not_converged
    use gapbeam_band, only: band_ok, band_needs_pivoting
    use gapbeam_law, only: always_closed, separate_rigid_pairs, has_laws, jump_to_plateau
    use gapbeam_law_kinematics, only: find_free_level, is_blocked, distance_to_contact
    use gapbeam_law_adapters, only: limit_stiffness
    use gapbeam_model, only: beam_type, last_place, softest
    use gapbeam_turning, only: turn_with
    use gapbeam_kinematics, only: free_motions, motion_type
    use gapbeam_unbounded_motions, only: unbounded_motion_type, find_unbounded_motions, prefer_rotation_mode
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_reactions, only: by_stretches
    use gapbeam_system, only: solve_and_refine, refine_scheme, complete_scheme, is_finite
    use gapbeam_rules, only: find_wrong
    use gapbeam_search, only: settle, refuse_scheme, rule_least_index
    implicit none
    private
    public :: find_contact_state, outcome_type, is_solved

    !> How the search ended, apart from errors
    type :: outcome_type
        !> gapbeam_solved, gapbeam_no_equilibrium or gapbeam_buckles
        integer :: status = gapbeam_solved
        !> The free motion, where there is no equilibrium, or that with which it buckles, shape (0:n)
        real(wp), allocatable :: motion(:)
        !> Can the beam move freely without work of the loads (forces are unique, the position is not)
        logical :: indifferent = .false.
        !> Does it depend on work or speed that is hardly more than its rounding error
        logical :: in_doubt = .false.
        !> Supports whose reaction or opening is zero as far as any precision here tells: their state may be either
        !> (gapbeam_extended_precision), shape (size(closed))
        logical, allocatable :: undecided(:)
    end type outcome_type

contains

    !> Was a state found
    pure function is_solved(outcome, error)
        type(outcome_type), intent(in) :: outcome
        type(error_type), allocatable, intent(in) :: error
        logical :: is_solved

        is_solved = .not. allocated(error) .and. outcome%status == gapbeam_solved
    end function is_solved

    !> Find the contact state and its solution
    subroutine find_contact_state(beam, factor, rule, closed, work, outcome, error)
        type(beam_type), intent(in) :: beam
        !> Load factor (the loads themselves are in work, by set_loads)
        real(wp), intent(in) :: factor
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Start in, contact state out, shape (size(beam%supports)); bilateral supports always act
        logical, intent(inout) :: closed(:)
        !> Loads in, solution and reactions out
        type(workspace_type), intent(inout) :: work
        !> Solved or no equilibrium
        type(outcome_type), intent(out) :: outcome
        !> Rigid stretch over too many rigid supports; not settled; not finite
        type(error_type), allocatable, intent(out) :: error
        type(motion_type), allocatable :: motions(:)
        logical, allocatable :: start(:), wrong(:)
        logical :: settled, refined
        integer :: attempt

        if (checked) call require(size(closed) == size(beam%supports), "find_contact_state: closed")
        closed = closed .or. always_closed(beam%supports)
        call separate_rigid_pairs(beam%supports, last_place(beam), closed)
        work%solves = 0
        work%cycled = .false.
        work%proximal_weight = 0.0_wp
        work%reference = 0.0_wp  ! an earlier search may have left what is no number
        allocate (start(size(closed)), wrong(size(closed)))
        start = always_closed(beam%supports)
        ! Within its gap a law that holds both ways does not
        if (has_laws(beam%supports)) call jump_to_plateau(beam%supports, start)
        call free_motions(beam, start, motions)
        start = closed
        refined = .false.
        do attempt = 1, 2
            call settle(beam, rule, size(motions) > 0, closed, work, settled, error, carefully=attempt == 2)
            if (allocated(error)) return
            if (.not. settled) then
                closed = start
                call proximal_iteration(beam, factor, rule, closed, work, outcome, refined, error)
                if (allocated(error)) call find_motion_on_soft_supports(beam, factor, rule, start, outcome, error)
            end if
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            if (checked) then
                call require(all(closed .or. .not. always_closed(beam%supports)), "find_contact_state: opened a bilateral one")
            end if
            ! Once, so that the last digits are those of the scheme, whatever way led to it
            if (.not. refined) call refine_scheme(beam, closed, work)
            if (.not. (settled .and. (work%from_both_ends .or. by_stretches) .and. is_finite(work))) exit
            call find_wrong(beam, closed, sign_width, work, wrong)
            if (.not. any(wrong)) exit
            ! That has turned a sign, or shown one that elimination had hidden
        end do
        if (.not. is_finite(work)) call out_of_range(error)
    end subroutine find_contact_state

    !> A beam whose reactions statics cannot tell apart may still have no equilibrium. That does not depend on how stiff
    !> its supports are, so it is decided with soft ones
    subroutine find_motion_on_soft_supports(beam, factor, rule, start, outcome, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(in) :: start(:)
        type(outcome_type), intent(inout) :: outcome
        !> Why the beam itself could not be solved; gone if it has no equilibrium
        type(error_type), allocatable, intent(inout) :: error
        type(beam_type) :: soft
        type(workspace_type) :: work
        type(error_type), allocatable :: another
        logical, allocatable :: closed(:)
        real(wp) :: stiffness
        logical :: refined

        if (error%code /= gapbeam_indeterminate) return
        allocate (closed, source=start)
        soft = beam
        stiffness = softest(beam)
        call limit_stiffness(soft%supports, stiffness)
        call new_workspace(soft, work)
        call set_loads(soft, factor, work)
        call proximal_iteration(soft, factor, rule, closed, work, outcome, refined, another)
        if (outcome%status == gapbeam_no_equilibrium .and. .not. allocated(another)) deallocate (error)
    end subroutine find_motion_on_soft_supports

    !> The same for a beam that can float: weak springs, and a reference position that follows
    subroutine proximal_iteration(beam, factor, rule, closed, work, outcome, refined, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(inout) :: outcome
        !> Has the solution been refined
        logical, intent(out) :: refined
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: wrong(:)
        type(unbounded_motion_type), allocatable :: unbounded(:)
        real(wp), allocatable :: displaced(:), direction(:)
        real(wp) :: proximal_weight, way, moved, moved_before
        logical :: settled, stable, in_doubt, at_rest, stopped, there_is
        integer :: move, state, place

        allocate (wrong(size(closed)), displaced(0:last_place(beam)), direction(0:last_place(beam)))
        displaced(:) = 0.0_wp
        proximal_weight = proximal_ratio*softest(beam)
        work%reference = 0.0_wp
        moved_before = huge(moved_before)
        refined = .false.
        do move = 1, most_moves
            if (work%solves > work%most_solves) exit
            work%proximal_weight = proximal_weight
            call settle(beam, rule, .true., closed, work, settled, error)
            if (.not. settled .and. move == 1 .and. work%without_couples .and. &
                .not. (any(work%load_size > 0.0_wp) .or. any(work%turn_size > 0.0_wp))) then
                ! Weak springs press it onto lacks of fit, which takes very long to settle; off all supports it rests as well
                there_is = .false.
                if (.not. allocated(beam%turning)) call find_free_level(beam%supports, way, there_is)
                if (there_is) then
                    work%reference = way
                    closed = always_closed(beam%supports)
                    call settle(beam, rule, .true., closed, work, settled, error)
                end if
            end if
            if (.not. settled .and. .not. has_laws(beam%supports)) then
                ! A beam that nothing stops goes so far on weak springs that rounding hides what is open. That nothing stops it
                ! is a proof in any scheme
                call find_unbounded_motions(beam, factor, closed, direction, unbounded, stable, in_doubt)
                call follow_unbounded_motions(beam, factor, closed, unbounded, in_doubt, displaced, direction, outcome, stopped)
                if (.not. stopped) return
            end if
            if (.not. settled) call settle(beam, rule_least_index, .false., closed, work, settled, error)
            if (allocated(error)) return
            if (.not. work%complete) call complete_scheme(beam, closed, work)
            displaced(:) = work%answers%deflection
            ! Does the scheme hold without the springs?
            call find_unbounded_motions(beam, factor, closed, direction, unbounded, stable, in_doubt)
            if (stable) then
                work%proximal_weight = 0.0_wp
                call solve_and_refine(beam, closed, work, state, place)
                if (state == band_needs_pivoting) call refuse_scheme(beam, state, place, error)
                if (allocated(error)) return
                if (state == band_ok) then
                    call find_wrong(beam, closed, sign_width, work, wrong)
                    refined = .not. any(wrong)
                    if (refined) return
                end if
            else if (size(unbounded) == 0) then
                ! Free to move, but no load does work: the springs carry nothing once the reference has come to rest, but for
                ! what loads that balance each other have left to rounding
                moved = maxval(abs(displaced(:ubound(work%reference, 1)) - work%reference))
                at_rest = moved <= max(at_rest_share*maxval(abs(displaced)), &
                                       epsilon(1.0_wp)*maxval(work%shear_size)/proximal_weight) &
                    .or. (moved <= least_spring_force*max(maxval(work%load_size), maxval(work%shear_size))/proximal_weight &
                          .and. moved > moved_before/2)
                moved_before = moved
                if (at_rest) then
                    outcome%indifferent = .true.
                    outcome%in_doubt = in_doubt
                    return
                end if
            else
                call follow_unbounded_motions(beam, factor, closed, unbounded, in_doubt, displaced, direction, outcome, stopped)
                if (.not. stopped) return
            end if
            work%reference(:) = displaced(:ubound(work%reference, 1))
        end do
        call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that the contact state "// &
                         "could not be settled: give it a support that holds both ways, or check the loads")
    end subroutine proximal_iteration

    !> Let every part that the loads move go as far as its next open support
    subroutine follow_unbounded_motions(beam, factor, closed, unbounded, in_doubt, displaced, direction, outcome, stopped)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> By find_unbounded_motions
        type(unbounded_motion_type), intent(in) :: unbounded(:)
        logical, intent(in) :: in_doubt
        !> Deflections of the nodes, and the motions of all parts, shape (0:n)
        real(wp), intent(inout) :: displaced(0:), direction(0:)
        type(outcome_type), intent(inout) :: outcome
        !> Has each one; if not, this is no equilibrium, and the outcome says so
        logical, intent(out) :: stopped
        real(wp) :: way
        integer :: r

        stopped = .true.
        do r = 1, size(unbounded)
            associate (from => unbounded(r)%first, to => unbounded(r)%last)
                way = distance_to_contact(beam%supports, supports_between(beam, from, to), closed, direction, displaced, no_speed)
                stopped = way < huge(way)
                if (.not. stopped) then
                    outcome%status = gapbeam_no_equilibrium
                    direction(:from - 1) = 0.0_wp
                    direction(to + 1:) = 0.0_wp
                    call turn_with(beam, direction)
                    outcome%in_doubt = in_doubt .or. is_blocked(beam%supports, direction)
                    call prefer_rotation_mode(beam, factor, direction)
                    allocate (outcome%motion(0:size(beam%links)), source=direction(0:size(beam%links)))
                    return
                end if
                displaced(from:to) = displaced(from:to) + way*direction(from:to)
            end associate
        end do
    end subroutine follow_unbounded_motions

    !> Numbers of the supports at some nodes of the beam, and of those that hold rotations there or beside them
    pure function supports_between(beam, from, to) result(numbers)
        type(beam_type), intent(in) :: beam
        !> First and last node
        integer, intent(in) :: from, to
        integer, allocatable :: numbers(:)
        integer :: j, v

        numbers = beam%order(beam%first(from):beam%first(to + 1) - 1)
        if (.not. allocated(beam%turning)) return
        do j = 1, size(beam%turning)
            v = size(beam%links) + j
            ! Nodes that stay turn as well where their neighbours move
            if (beam%turning(j) < from - 1 .or. beam%turning(j) > to + 1) cycle
            numbers = [numbers, beam%order(beam%first(v):beam%first(v + 1) - 1)]
        end do
    end function supports_between

end module gapbeam_contact_state
