!> Beams under compression: whether their state is unique, and the one that is reached as the axial forces grow.
!>
!> With all one-sided supports open and off all one-sided ground a stable beam has one state whatever acts (its matrix is
!> positive definite, so the complementarity problem has one solution). Where it is not stable then, the axial forces grow from 0
!> to what they are with all other loads in full, from state to state, in steps over which these are on one branch for sure
!> (gapbeam_uniqueness). Where the branch ends the beam buckles: other stable states, farther away, are not looked for.
!>
!> A beam that gives way even with all that may hold it acting has no stable state in any scheme. The axial forces are let grow to
!> the share for which that is so first, in stretches that are no shorter than it asks for: hopeless compression costs no more.
module gapbeam_compressed
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: least_compressions, most_compressions, most_solves_followed, mode_parts, most_mode_stretches
    use gapbeam_tolerances, only: same_compression, least_share, little_compression, long_compression
    use gapbeam_words, only: whole
    use gapbeam_error, only: error_type, fatal_error, has_ended, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, &
        gapbeam_not_converged, gapbeam_bad_input
    use gapbeam_law, only: both
    use gapbeam_law_margins, only: let_go
    use gapbeam_piece, only: is_compressed
    use gapbeam_filled_ground, only: any_falls
    use gapbeam_uniqueness, only: is_unique, is_one_branch, compression_lengths
    use gapbeam_ground_steps, only: greatest_modulus
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, full_contact
    use gapbeam_moved_ground, only: under_share
    use gapbeam_workspace, only: workspace_type
    use gapbeam_modes, only: by_axial_force, mode_shape_type, count_modes, find_mode_shape
    use gapbeam_mode_values, only: find_mode_values
    use gapbeam_contact_state, only: outcome_type, is_solved
    use gapbeam_refined, only: detail_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_ground_solver, only: solve_on_ground
    use gapbeam_ground_mechanism, only: solve_or_refute
    use gapbeam_unloaded_beam, only: leave_supports
    use gapbeam_falling_ground, only: solve_on_falling_ground
    implicit none
    private
    public :: solve_stable

contains

    !> Solve at a load factor: the stable state to which loads, or axial forces, lead where there may be others
    subroutine solve_stable(ground, detail, factor, rule, closed, solution, outcome, error, near)
        !> As for solve_on_ground
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        !> Solved, no equilibrium, or buckles, with the motion; the solution says then at which share of the axial forces
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type), intent(in), optional :: near
        type(ground_type) :: pressed
        logical :: first(size(closed))
        real(wp) :: share

        if (any_falls(ground)) then
            call solve_on_falling_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
            return
        end if
        if (.not. any(is_compressed(ground%pieces))) then
            call solve_or_refute(ground, detail, factor, rule, closed, solution, outcome, error, near)
            return
        end if
        if (any(ground%layers%rigid)) then
            if (.not. is_unique(ground)) call fatal_error(error, gapbeam_bad_input, "over rigid ground a beam is compressed in "// &
                                                          "this version only where it is stable off the ground, on supports "// &
                                                          "that hold it both ways; press less, add such supports, or give "// &
                                                          "the ground a stiffness")
            if (.not. allocated(error)) call solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
            return
        end if
        first(:) = closed
        share = greatest_share(ground)
        do while (share < 1.0_wp)
            pressed = cut_for_share(ground, share)
            call check_compression(pressed, error)
            if (allocated(error)) return
            closed(:) = first
            call follow_compression(pressed, share, detail, factor, rule, closed, solution, outcome, error)
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            ! Ground that stiffens without end bears more
            share = min(1.0_wp, 16*share)
        end do
        call check_compression(ground, error)
        if (allocated(error)) return
        closed(:) = first
        if (is_unique(ground)) then
            call solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
        else
            call follow_compression(ground, share, detail, factor, rule, closed, solution, outcome, error, near)
        end if
    end subroutine solve_stable

    !> Compression that would cut the beam into stretches without end is refused
    subroutine check_compression(ground, error)
        type(ground_type), intent(in) :: ground
        type(error_type), allocatable, intent(out) :: error

        if (sum(compression_lengths(ground%pieces)) <= most_mode_stretches) return
        call fatal_error(error, gapbeam_bad_input, "the axial force N presses so hard beside EI that states would have to be "// &
                         "followed in more than "//trim(whole(most_mode_stretches))//" stretches; press less, or give a "// &
                         "stiffer beam")
    end subroutine check_compression

    !> Share of the axial forces for which no scheme is stable, if ground does not stiffen without end; 1 where there is none below,
    !> and where no piece is so long that it matters
    function greatest_share(ground) result(share)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        real(wp) :: share
        type(ground_type) :: held, pressed
        type(zones_type) :: zones
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        integer :: number

        share = (long_compression/max(long_compression, maxval(compression_lengths(ground%pieces))))**2
        if (.not. share < 1.0_wp) return
        held = all_that_holds(ground)
        do
            pressed = cut_for_share(held, share)
            ! Where stiffnesses lie so far apart that nothing is counted
            if (sum(compression_lengths(pressed%pieces)) > most_mode_stretches) return
            call full_contact(pressed, zones)
            call count_modes(pressed, zones, pressed%beam%supports%side == both, by_axial_force, 1.0_wp, number, work, grounded)
            if (number > 0 .or. share >= 1.0_wp) return
            share = min(1.0_wp, 4*share)
        end do
    end function greatest_share

    !> A beam on which all supports and all ground act both ways at once, as stiff as they ever are
    pure function all_that_holds(ground) result(held)
        type(ground_type), intent(in) :: ground
        type(ground_type) :: held
        integer :: j, k

        held = ground
        associate (s => held%beam%supports)
            s%stiffness = max(s%stiffness, s%before)
            s%side = both
            s%breakpoint = 0
            s%more = .false.
        end associate
        held%first = [(j, j=1, size(ground%pieces) + 1)]
        deallocate (held%layers)
        allocate (held%layers(size(ground%pieces)))
        do j = 1, size(ground%pieces)
            do k = ground%first(j), ground%first(j + 1) - 1
                held%layers(j)%modulus_a = held%layers(j)%modulus_a + greatest_modulus(ground%layers(k), ground%laws)
            end do
            held%layers(j)%modulus_b = held%layers(j)%modulus_a
        end do
    end function all_that_holds

    !> A beam under a share of its axial forces that is cut for no more than that share
    pure function cut_for_share(ground, share) result(changed)
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: share
        type(ground_type) :: changed

        changed = under_share(ground, share)
        changed%pieces%compression = max(0.0_wp, -changed%pieces%tension, &
                                         -(changed%pieces%tension + changed%pieces%tension_change))
    end function cut_for_share

    !> Let the axial forces grow, with all other loads in full
    subroutine follow_compression(ground, given, detail, factor, rule, closed, solution, outcome, error, near)
        !> As for solve_stable, under all of the axial forces or a share of them, and that share
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: given
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(ground_solution_type), intent(out) :: solution
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(ground_start_type), intent(in), optional :: near
        type(ground_solution_type) :: last
        type(ground_type) :: pressed
        type(ground_start_type) :: start, next
        logical :: first(size(closed)), last_closed(size(closed)), reached, gives_way, leaves
        real(wp), allocatable :: mode(:)
        real(wp) :: share, step
        integer :: search, number, solves

        first(:) = closed
        if (present(near)) then
            ! A state close by tells which one it is
            call solve_on_ground(ground, detail, factor, rule, closed, solution, outcome, error, near)
            solution%unique = .false.
            if (is_solved(outcome, error) .or. has_ended(error)) return
            closed(:) = first
        end if
        call solve_on_ground(under_share(ground, 0.0_wp), detail, factor, rule, closed, last, outcome, error)
        solves = last%solves
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        last_closed(:) = closed
        share = 0.0_wp
        reached = .false.
        do search = 1, 2
            ! All at once where that stays on one branch for sure
            step = merge(1.0_wp, 1.0_wp/least_compressions, search == 1)
            do number = 1, most_compressions
                call start_from(last, last_closed, start)
                closed(:) = last_closed
                pressed = under_share(ground, min(1.0_wp, share + step))
                call solve_on_ground(pressed, detail, factor, rule, closed, solution, outcome, error, start, &
                                     only_near=search == 1)
                solves = solves + solution%solves
                if (has_ended(error)) return
                reached = is_solved(outcome, error)
                if (reached) then
                    call start_from(solution, closed, next)
                    reached = is_one_branch(pressed, start, next, factor)
                end if
                if (reached .and. share + step >= 1.0_wp) exit
                if (reached) then
                    reached = .false.
                    share = share + step
                    last = solution
                    last_closed(:) = closed
                    step = 2*step
                else
                    step = step/2
                    if (step <= same_compression*max(share, least_share) .or. solves > most_solves_followed) exit
                end if
            end do
            if (reached) exit
            ! Only where it does not give way the search for zones from anew, long where there are none, may lead on
            call start_from(last, last_closed, start)
            call find_way_out(ground, last, share, start, gives_way)
            if (gives_way) exit
        end do
        if (.not. (reached .or. share > 0.0_wp)) then
            ! What bears none of them at all may be about to tip under its loads alone
            closed(:) = first
            call solve_on_ground(under_share(ground, 0.0_wp), detail, factor*(1 + little_compression), rule, closed, solution, &
                                 outcome, error)
            if (has_ended(error)) return
            if (.not. allocated(error) .and. outcome%status == gapbeam_no_equilibrium) return
            if (allocated(error)) deallocate (error)
        end if
        solution%solves = solves
        solution%unique = .false.
        if (reached) then
            last = solution
            last_closed(:) = closed
            share = 1.0_wp
        end if
        call start_from(last, last_closed, start)
        call leave_supports(ground, last, share, start, mode, leaves)
        if (reached .and. .not. leaves) return
        call buckle(ground, given, last, start, share, solution, outcome, error, mode)
    end subroutine follow_compression

    !> The end of stable states: how the beam gives way there
    subroutine buckle(ground, given, last, start, share, solution, outcome, error, mode)
        !> As for follow_compression
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: given
        !> The last state, its zones and supports as it leaves, and the share of the axial forces in it
        type(ground_solution_type), intent(in) :: last
        type(ground_start_type), intent(inout) :: start
        real(wp), intent(in) :: share
        !> With that share and the mode, on the side to which the last state bends, or of the mode that is known
        type(ground_solution_type), intent(inout) :: solution
        type(outcome_type), intent(out) :: outcome
        !> It is stable still
        type(error_type), allocatable, intent(out) :: error
        !> Deflections of that, not allocated where none is
        real(wp), allocatable, intent(in) :: mode(:)
        type(ground_type) :: pressed
        type(mode_shape_type) :: shape
        character(len=20) :: text
        real(wp) :: value(1), way
        logical :: gives_way, lost
        integer :: found, i

        call find_way_out(ground, last, share, start, gives_way)
        if (.not. gives_way) then
            write (text, "(es10.3e3)") given*share
            call fatal_error(error, gapbeam_not_converged, "the beam could not be followed beyond "//trim(adjustl(text))// &
                             " times its axial forces, where it is still stable: look for supports or ground far stiffer than it")
            return
        end if
        solution%axial_share = given*share
        outcome = outcome_type(status=gapbeam_buckles)
        allocate (outcome%motion(0:size(ground%pieces)))
        ! What has lost a support gives way under less already, or under next to nothing
        pressed = under_share(ground, max(share, little_compression))
        call find_mode_values(pressed, start%zones, start%closed, last%factor, by_axial_force, 1.0_wp, value, found, lost)
        if (found == 0) value(:) = 1.0_wp
        call find_mode_shape(pressed, start%zones, start%closed, last%factor, by_axial_force, &
                             max(value(1), little_compression), mode_parts, shape)
        call move_alloc(shape%piece, solution%mode_piece)
        call move_alloc(shape%distance, solution%mode_distance)
        call move_alloc(shape%deflection, solution%mode_deflection)
        if (size(solution%mode_piece) == 0) then
            call fatal_error(error, gapbeam_not_converged, "the beam buckles under its axial forces, but its stiffnesses are "// &
                             "too far apart to tell how; bring them nearer together, or make them infinite or 0")
            return
        end if
        outcome%motion(0) = solution%mode_deflection(1)
        do i = 2, size(solution%mode_piece)
            outcome%motion(solution%mode_piece(i)) = solution%mode_deflection(i)
        end do
        way = dot_product(outcome%motion, last%deflection)
        if (allocated(mode)) then
            if (size(mode) == size(solution%mode_deflection)) way = dot_product(solution%mode_deflection, mode)
        end if
        if (way >= 0.0_wp) return
        outcome%motion(:) = -outcome%motion
        solution%mode_deflection(:) = -solution%mode_deflection
    end subroutine buckle

    !> Does a little more compression, or the loss of what hardly carries any more, let the beam give way
    subroutine find_way_out(ground, last, share, start, gives_way)
        type(ground_type), intent(in) :: ground
        !> As for buckle
        type(ground_solution_type), intent(in) :: last
        real(wp), intent(in) :: share
        !> Its zones and the states of its supports in; with those of what was lost out
        type(ground_start_type), intent(inout) :: start
        logical, intent(out) :: gives_way
        type(workspace_type) :: work
        type(grounded_type) :: grounded
        integer :: number, trial

        do trial = 1, 2
            call count_modes(under_share(ground, share), start%zones, start%closed, by_axial_force, 1 + little_compression, &
                             number, work, grounded, factor=last%factor)
            gives_way = number /= 0
            if (gives_way) return
            ! What bends the beam may leave all supports at once
            call let_go(ground%beam%supports, last%deflection, last%reaction, &
                        little_compression*max(maxval(abs(last%reaction)), maxval(abs(last%shear))), start%closed)
        end do
    end subroutine find_way_out

end module gapbeam_compressed
