!> Solution of one contact state: its system chosen, assembled, solved and refined.
module gapbeam_system
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_refinements
    use gapbeam_tolerances, only: short_zone
    use gapbeam_watch, only: is_stopped
    use gapbeam_band, only: node_type, rhs_type, pivot_type, factor_chain, band_ok, band_mechanism, band_needs_pivoting, &
        band_stopped, full, m_known, w_known
    use gapbeam_foundation, only: stretch_link_type
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_foundation_chain, only: factor_foundation_chain, solve_foundation_chain, of_numbers_as_given
    use gapbeam_foundation_residual, only: residual_on_ground
    use gapbeam_residual, only: residual_chain
    use gapbeam_three_moment, only: fits_three_moment, solve_three_moment
    use gapbeam_pivoting, only: solve_pivoting
    use gapbeam_plain, only: ends_hold, solve_plain, set_node, solve_rows, refine_rows
    use gapbeam_model, only: beam_type, node_of_support
    use gapbeam_turning, only: find_turning
    use gapbeam_kinematics, only: free_motions, motion_type
    use gapbeam_workspace, only: workspace_type, apply_scheme, method_mixed, method_three_moment, method_pivoting
    use gapbeam_reactions, only: find_sizes, find_shears, find_reactions
    implicit none
    private
    public :: solve_scheme, solve_and_refine, solve_deflections, complete_scheme, refine_scheme, is_finite

contains

    !> Solve a scheme and find the reactions of its supports
    subroutine solve_scheme(beam, acting, work, state, place)
        !> As for solve_deflections
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        integer, intent(out) :: state, place

        call solve_deflections(beam, acting, work, state, place)
        if (state == band_ok) call complete_scheme(beam, acting, work)
    end subroutine solve_scheme

    !> Solve a scheme, and refine its solution once where there is one
    subroutine solve_and_refine(beam, acting, work, state, place)
        !> As for solve_deflections
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        integer, intent(out) :: state, place

        call solve_scheme(beam, acting, work, state, place)
        if (state == band_ok) call refine_scheme(beam, acting, work)
    end subroutine solve_and_refine

    !> Shears and reactions of a scheme of which deflections and moments are solved, and the sizes of rounding errors
    pure subroutine complete_scheme(beam, acting, work)
        !> The beam and its scheme
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work

        if (allocated(beam%turning)) then
            associate (n => size(beam%links))
                call find_turning(beam, work%nodes, work%rhs, work%level, work%loads, work%turn_size, work%answers, &
                                  work%deflection_size(n + 1:), work%couple, work%couple_size)
            end associate
        end if
        call find_sizes(beam, [0, size(beam%links)], work)
        call find_shears(beam, [1, size(beam%links)], work)
        call find_reactions(beam, acting, [0, size(beam%links)], work)
        work%complete = .true.
    end subroutine complete_scheme

    !> Solve a scheme for deflections and moments only
    subroutine solve_deflections(beam, acting, work, state, place, applied)
        type(beam_type), intent(in) :: beam
        !> Which supports act
        logical, intent(in) :: acting(:)
        !> Loads in, solution out
        type(workspace_type), intent(inout) :: work
        !> band_ok, band_mechanism, band_needs_pivoting where even pivoting finds no unique solution, or band_stopped
        integer, intent(out) :: state
        !> Node at which another state than band_ok was found
        integer, intent(out) :: place
        !> The scheme that nodes and right-hand side in work are those of, if they are of these loads and any
        logical, intent(in), optional :: applied(:)
        type(motion_type), allocatable :: motions(:)
        logical :: regular, has_rows
        integer :: n

        place = 0
        if (is_stopped(beam%watch)) then
            state = band_stopped
            return
        end if
        has_rows = .false.
        if (present(applied)) then
            has_rows = work%plain%has_rows
            call apply_changes(beam, acting, applied, has_rows, work)
        else
            call apply_scheme(beam, acting, [0, size(beam%links)], work)
        end if
        work%plain%has_rows = .false.
        work%complete = .false.
        work%refined = .false.
        work%solves = work%solves + 1
        if (allocated(beam%ground)) then
            call solve_on_ground(beam, work, state, place)
            return
        end if
        n = size(beam%links)
        if (work%may_soften .and. softens(work%nodes)) then
            regular = .false.
        else if (fits_three_moment(work%nodes(0:n))) then
            work%method = method_three_moment
            call solve_three_moment(work%nodes(0:n), beam%links, work%rhs(0:n), work%moment_work, work%answers(0:n), regular)
        else
            work%method = method_mixed
            work%from_both_ends = fits_both_ends(work)
            if (work%from_both_ends) then
                if (has_rows) then
                    call solve_rows(work%plain, work%nodes, work%rhs, work%answers)
                else
                    call solve_plain(work%plain, work%nodes, work%rhs, work%answers)
                end if
                work%plain%has_rows = .true.
                regular = .true.
            else
                call factor_chain(work%nodes(0:n), beam%links, work%pivots, state, place)
                regular = state == band_ok
                if (state == band_mechanism) return
                if (regular) then
                    work%eliminated(:) = work%rhs(0:n)
                    call solve_chain(work%nodes(0:n), beam%links, work%pivots, work%eliminated, work%answers(0:n))
                end if
            end if
        end if
        if (.not. regular) then
            work%method = method_pivoting
            call solve_pivoting(work%nodes(0:n), beam%links, work%rhs(0:n), work%answers(0:n), regular)
        end if
        state = merge(band_ok, band_needs_pivoting, regular)
        if (.not. regular) then
            ! Singular because something moves, or because statics cannot tell reactions apart
            call free_motions(beam, acting, motions)
            if (size(motions) > 0 .and. .not. any(work%proximal_weight > 0.0_wp)) state = band_mechanism
        end if
    end subroutine solve_deflections

    !> Nodes and right-hand side of another scheme, where its supports do something else
    pure subroutine apply_changes(beam, acting, applied, has_rows, work)
        type(beam_type), intent(in) :: beam
        !> The scheme, and that at hand
        logical, intent(in) :: acting(:), applied(:)
        !> Have the rows of work%plain to follow
        logical, intent(in) :: has_rows
        type(workspace_type), intent(inout) :: work
        integer :: k

        do k = 1, size(acting)
            if (acting(k) .eqv. applied(k)) cycle
            associate (i => node_of_support(beam, k))
                call apply_scheme(beam, acting, [i, i], work)
                if (has_rows) call set_node(work%plain, i, work%nodes(i), work%rhs(i))
            end associate
        end do
    end subroutine apply_changes

    !> The same on elastic ground, which has a chain of its own
    pure subroutine solve_on_ground(beam, work, state, place)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        integer, intent(out) :: state, place

        work%method = method_mixed
        associate (n => size(beam%links))
            call factor_foundation_chain(work%nodes(0:n), beam%ground, of_numbers_as_given, work%pivots, state, place, &
                                         softens(work%nodes))
            if (state /= band_ok) return
            call solve_foundation_chain(work%nodes(0:n), beam%ground, beam%links%length, work%pivots, work%rhs(0:n), &
                                        work%eliminated, work%answers(0:n))
        end associate
    end subroutine solve_on_ground

    !> Is the force of some node's supports falling: only pivoting minds signs
    pure function softens(nodes) result(any_does)
        type(node_type), intent(in) :: nodes(:)
        logical :: any_does

        any_does = any(nodes%stiffness < 0.0_wp)
    end function softens

    !> Can a scheme be solved from both ends
    pure function fits_both_ends(work) result(fits)
        type(workspace_type), intent(in) :: work
        logical :: fits

        fits = allocated(work%plain%cells) .and. work%without_couples
        if (fits) fits = ends_hold(work%nodes)
    end function fits_both_ends

    !> One step of iterative refinement of the last solve, with residuals formed from differences
    pure subroutine refine_scheme(beam, acting, work)
        !> The beam and the scheme solved last
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        logical :: regular
        integer :: n

        n = size(beam%links)
        if (allocated(beam%ground)) then
            call refine_on_ground(beam, work)
            if (.not. work%complete) call complete_scheme(beam, acting, work)
            return
        end if
        ! LAPACK's expert driver has refined already
        if (work%method == method_pivoting) then
            if (.not. work%complete) call complete_scheme(beam, acting, work)
            return
        end if
        if (work%plain%has_rows) then
            call refine_rows(work%plain, work%nodes, beam%links, work%rhs, work%answers, work%eliminated, work%correction)
        else
            call residual_chain(work%nodes(0:n), beam%links, work%rhs(0:n), work%answers(0:n), work%eliminated, work%sizes)
            if (fits_three_moment(work%nodes(0:n))) then
                work%method = method_three_moment
                call solve_three_moment(work%nodes(0:n), beam%links, work%eliminated, work%moment_work, work%correction, regular)
            else if (fits_both_ends(work)) then
                call solve_plain(work%plain, work%nodes, work%eliminated, work%correction)
            else
                call solve_chain(work%nodes(0:n), beam%links, work%pivots, work%eliminated, work%correction)
            end if
        end if
        associate (a => work%answers(0:n), change => work%correction)
            a%deflection = a%deflection + change%deflection
            a%moment_left = a%moment_left + change%moment_left
            a%moment_right = a%moment_right + change%moment_right
        end associate
        work%refined = .true.
        call complete_scheme(beam, acting, work)
    end subroutine refine_scheme

    !> The same on elastic ground where digits are lost; elsewhere quadruple precision refines (gapbeam_ground_solver)
    pure subroutine refine_on_ground(beam, work)
        !> As for refine_scheme
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        type(rhs_type), allocatable :: residual(:)
        real(wp) :: share, before
        integer :: step, n

        if (.not. (loses_digits(beam) .or. cancels(work%pivots, beam%ground))) return
        n = size(beam%links)
        allocate (residual(0:n))
        before = huge(before)
        do step = 1, most_refinements
            associate (nodes => work%nodes(0:n), a => work%answers(0:n), change => work%correction)
                call residual_on_ground(nodes, beam%ground, work%rhs(0:n), a, residual)
                call solve_foundation_chain(nodes, beam%ground, beam%links%length, work%pivots, residual, work%eliminated, change)
                share = max(share_of(change%deflection, a%deflection), share_of(change%moment_left, a%moment_left), &
                            share_of(change%moment_right, a%moment_right))
                ! Not worth while, or beyond what this precision tells
                if (.not. share < before/2) exit
                a%deflection = a%deflection + change%deflection
                a%moment_left = a%moment_left + change%moment_left
                a%moment_right = a%moment_right + change%moment_right
            end associate
            work%complete = .false.
            if (share <= epsilon(share)) exit
            before = share
        end do

    contains

        !> Greatest part beside the greatest of all
        pure function share_of(parts, all_of) result(share)
            real(wp), intent(in) :: parts(:), all_of(:)
            real(wp) :: share

            share = maxval(abs(parts))/max(maxval(abs(all_of)), tiny(share))
        end function share_of

    end subroutine refine_on_ground

    !> Are there zones that are short, or that next to nothing holds beside others
    pure function loses_digits(beam) result(loses)
        type(beam_type), intent(in) :: beam
        logical :: loses

        associate (g => beam%ground%gaa)
            loses = minval(beam%links%length) < short_zone*sum(beam%links%length) .or. minval(g, g > 0.0_wp) < short_zone*maxval(g)
        end associate
    end function loses_digits

    !> Does compression leave little of a pivot, so that huge numbers are passed on that cancel later
    pure function cancels(pivots, links) result(it_does)
        !> Shape (0:n), and the links between nodes, shape (n)
        type(pivot_type), intent(in) :: pivots(0:)
        type(stretch_link_type), intent(in) :: links(:)
        logical :: it_does
        integer :: i

        it_does = .false.
        do i = 1, size(links)
            associate (p => pivots(i - 1), link => links(i))
                select case (p%kind)
                case (full)
                    it_does = short_zone**2*abs(p%reciprocal)*(abs(p%a*link%gaa) &
                                                               + max(abs(p%b - link%pa), abs(link%pa))**2) > 1.0_wp
                case (m_known)
                    it_does = abs(p%c) < short_zone**2*abs(link%gaa)
                case (w_known)
                    it_does = abs(p%a) < short_zone**2*abs(link%faa)
                case default
                    continue
                end select
            end associate
            if (it_does) return
        end do
    end function cancels

    !> Is the solution in the range of numbers
    pure function is_finite(work) result(it_is)
        type(workspace_type), intent(in) :: work
        logical :: it_is

        it_is = all(abs(work%answers%deflection) <= huge(1.0_wp)) .and. all(abs(work%answers%moment_left) <= huge(1.0_wp))
    end function is_finite

end module gapbeam_system
