!> A solution updated while a few supports change, at the cost of the stretch they affect.
!>
!> What a changed support sends to either side fades within a few spans, so the factor is made anew from the changed node to
!> where the left side passes on what it did before, and the solution is corrected as far as that can be seen in it.
!> Residuals in twice the working precision, formed from the solution itself, keep errors from adding up over many changes.
module gapbeam_update
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: nodes_apart, most_corrections
    use gapbeam_ordered, only: sort
    use gapbeam_tolerances, only: last_correction, harmless_correction
    use gapbeam_require, only: checked, require
    use gapbeam_band, only: answer_type, factor_chain, band_ok
    use gapbeam_band_substitution, only: correct_chain
    use gapbeam_residual, only: residual_chain
    use gapbeam_model, only: beam_type, node_of_support, last_place
    use gapbeam_workspace, only: workspace_type, apply_scheme, method_mixed, method_pivoting
    use gapbeam_system, only: solve_and_refine
    use gapbeam_reactions, only: find_sizes, find_shears, find_reactions
    implicit none
    private
    public :: start_updates, keep_factor, update_scheme, find_groups

contains

    !> Solve a scheme so that its solution can be kept up to date
    subroutine start_updates(beam, acting, work, solved, follows)
        type(beam_type), intent(in) :: beam
        !> Which supports act
        logical, intent(in) :: acting(:)
        !> Loads in, factor and solution out
        type(workspace_type), intent(inout) :: work
        !> Is there a unique solution
        logical, intent(out) :: solved
        !> Can update_scheme go on from it: it took no pivoting
        logical, intent(out) :: follows
        integer :: state, place

        call solve_and_refine(beam, acting, work, state, place)
        solved = state == band_ok
        follows = .false.
        if (.not. solved) return
        if (any(work%nodes%stiffness < 0.0_wp)) then
            ! Where forces fall a full solve pivots, and corrections tell how far the factor without is right
            call make_factor(beam, work, follows)
        else
            call keep_factor(beam, work, follows)
        end if
    end subroutine start_updates

    !> Make the factor of the scheme solved last, if it was solved without
    pure subroutine keep_factor(beam, work, follows)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        !> Can update_scheme go on from the solution at hand: it took no pivoting
        logical, intent(out) :: follows

        follows = work%method /= method_pivoting
        if (.not. follows) return
        if (work%method == method_mixed .and. .not. work%from_both_ends) return
        call make_factor(beam, work, follows)
    end subroutine keep_factor

    !> Make the factor of a scheme
    pure subroutine make_factor(beam, work, follows)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        !> Are all its numbers in range
        logical, intent(out) :: follows
        integer :: state, place

        follows = .true.
        if (allocated(beam%turning)) return
        call factor_chain(work%nodes, beam%links, work%pivots, state, place)
        follows = state == band_ok
        ! Numbers may leave the range on the way where they did not from both ends
        if (follows) follows = all(work%pivots%c <= huge(1.0_wp))
    end subroutine make_factor

    !> Supports that change together: first and last node of each group
    pure subroutine find_groups(beam, changed, groups, count)
        type(beam_type), intent(in) :: beam
        !> The supports that change, a few
        integer, intent(in) :: changed(:)
        !> From left to right, shape (2, size(changed)), and how many there are
        integer, intent(out) :: groups(:, :), count
        real(wp) :: places(size(changed))
        integer :: nodes(size(changed)), i

        places(:) = [(real(node_of_support(beam, changed(i)), wp), i=1, size(changed))]
        call sort(places)
        nodes(:) = nint(places)
        groups = 0
        count = 0
        do i = 1, size(nodes)
            if (count > 0) then
                if (nodes(i) - groups(2, count) <= nodes_apart) then
                    groups(2, count) = nodes(i)
                    cycle
                end if
            end if
            count = count + 1
            groups(:, count) = nodes(i)
        end do
    end subroutine find_groups

    !> Solve a scheme from the solution of another one that differs at one node, or at some nodes beside each other
    subroutine update_scheme(beam, acting, changed, refined, work, window, state)
        type(beam_type), intent(in) :: beam
        !> Which supports act now
        logical, intent(in) :: acting(:)
        !> First and last node at which that has changed
        integer, intent(in) :: changed(2)
        !> Is the solution to be right to the last digits, or as a plain solve gives it
        logical, intent(in) :: refined
        !> Factor and solution of the other scheme in (gapbeam_band), of this one out
        type(workspace_type), intent(inout) :: work
        !> First and last node at which the solution is another one
        integer, intent(out) :: window(2)
        !> band_ok; otherwise nothing in the workspace can be used any more
        integer, intent(out) :: state
        integer :: place, correction, touched(2), n
        real(wp) :: relative, share, scale(2)

        n = size(beam%links)
        if (checked) call require(0 <= changed(1) .and. changed(1) <= changed(2) .and. changed(2) <= n, "update_scheme: changed")
        if (allocated(beam%turning)) then
            ! Rotations are found anew with all the rest
            call solve_and_refine(beam, acting, work, state, place)
            window = [0, last_place(beam)]
            return
        end if
        work%method = method_mixed
        work%from_both_ends = .false.
        call apply_scheme(beam, acting, changed, work)
        call factor_chain(work%nodes, beam%links, work%pivots, state, place, changed)
        if (state /= band_ok) return
        window = changed
        work%growth = 1.0_wp
        scale = 0.0_wp
        do correction = 1, most_corrections
            call residual_chain(work%nodes, beam%links, work%rhs, work%answers, work%eliminated, work%sizes, window)
            call correct_chain(work%nodes, beam%links, work%pivots, work%eliminated, window, work%answers, work%correction, touched)
            call add_correction(touched, work, scale, relative, share)
            window = [max(0, min(window(1), touched(1) - 1)), min(n, max(window(2), touched(2) + 1))]
            if (correction > 1) work%growth = max(work%growth, share/epsilon(share))
            if (relative <= last_correction .and. correction > 1) exit
            ! What was much larger before has left its rounding errors
            if (relative <= harmless_correction .and. .not. refined) exit
        end do
        call find_sizes(beam, window, work)
        call find_shears(beam, [max(1, window(1)), min(n, window(2) + 1)], work)
        call find_reactions(beam, acting, window, work)
    end subroutine update_scheme

    !> Add a correction to the solution
    pure subroutine add_correction(range, work, scale, relative, share)
        !> First and last node
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        !> Largest deflection and moment so far, those of corrections included
        real(wp), intent(inout) :: scale(2)
        !> How large it is, relative to the largest deflection and moment in the range, and to those so far
        real(wp), intent(out) :: relative, share
        real(wp) :: deflection, moment, largest_deflection, largest_moment
        integer :: i

        deflection = 0.0_wp
        moment = 0.0_wp
        largest_deflection = 0.0_wp
        largest_moment = 0.0_wp
        do i = range(1), range(2)
            associate (a => work%answers(i), d => work%correction(i))
                a = answer_type(a%deflection + d%deflection, a%moment_left + d%moment_left, a%moment_right + d%moment_right)
                deflection = max(deflection, abs(d%deflection))
                moment = max(moment, abs(d%moment_left), abs(d%moment_right))
                largest_deflection = max(largest_deflection, abs(a%deflection))
                largest_moment = max(largest_moment, abs(a%moment_left), abs(a%moment_right))
            end associate
        end do
        relative = max(ratio(deflection, largest_deflection), ratio(moment, largest_moment))
        scale = max(scale, [max(deflection, largest_deflection), max(moment, largest_moment)])
        share = max(ratio(deflection, scale(1)), ratio(moment, scale(2)))
    end subroutine add_correction

    !> a/b, and 0/0 = 0
    elemental function ratio(a, b)
        real(wp), intent(in) :: a, b
        real(wp) :: ratio

        ratio = 0.0_wp
        if (a > 0.0_wp) ratio = a/max(b, a*epsilon(a), tiny(a))
    end function ratio

end module gapbeam_update
