!> Signs of supports that bad scaling hides even in quadruple precision.
!>
!> What rounding can do is estimated by sizes of terms, for any beam: where stiffnesses lie tens of powers of ten apart, or a link
!> of 1e-29 swings farther than anything else, the estimates hide signs that the solution itself shows. Supports that are wrong by
!> less than the estimates, but by more than next to nothing, are flipped one at a time, the first of them first (Murty 1974, least
!> index), and the solution tells whether that matters.
module gapbeam_ill_scaled_signs
    use gapbeam_kinds, only: qp
    use gapbeam_limits, only: most_flips, most_tie_solves
    use gapbeam_tolerances, only: fine_width, least_force_share
    use gapbeam_band, only: band_ok
    use gapbeam_model_quad, only: beam_type, has_other_supports
    use gapbeam_workspace_quad, only: workspace_type
    use gapbeam_law_quad, only: separate_rigid_pairs
    use gapbeam_law_margins_quad, only: is_watched_in, margin_of
    use gapbeam_system_quad, only: solve_and_refine
    implicit none
    private
    public :: flip_ill_scaled

contains

    !> Flip the supports that are wrong by less than the estimated rounding errors, as far as that changes reactions
    subroutine flip_ill_scaled(beam, closed, work, known)
        !> A beam without ground; where supports have laws nothing is done
        type(beam_type), intent(in) :: beam
        !> A scheme in which nothing is wrong by more than rounding errors, shape (size(beam%supports))
        logical, intent(inout) :: closed(:)
        !> Its solution, without weak springs
        type(workspace_type), intent(inout) :: work
        !> Has an end been found
        logical, intent(out) :: known
        type(workspace_type), allocatable :: other
        logical, allocatable :: is_tie(:), flipped(:)
        integer :: k, flips, ties, state, place

        known = .true.
        if (has_other_supports(beam) .or. allocated(beam%ground)) return
        k = first_wrong(beam, closed, work)
        if (k == 0) return
        allocate (is_tie(size(closed)), flipped(size(closed)), other)
        is_tie(:) = .false.
        flips = 0
        ties = 0
        do
            k = first_wrong(beam, closed, work, is_tie)
            if (k == 0 .or. ties == most_tie_solves) exit
            ! Where all forces are nothing but rounding, signs go round without end, and none matters
            known = flips < most_flips .or. all(abs(work%reaction) <= work%reaction_error)
            if (flips == most_flips) exit
            flipped(:) = closed
            flipped(k) = .not. closed(k)
            call separate_rigid_pairs(beam%supports, size(beam%links), flipped)
            other = work
            call solve_and_refine(beam, flipped, other, state, place)
            work%solves = other%solves
            known = state == band_ok .or. .not. is_surely_wrong(beam, closed, k, work)
            if (.not. known) exit
            if (state == band_ok .and. (flipped(k) .neqv. closed(k))) then
                if (maxval(abs(other%reaction - work%reaction)) > least_that_matters(work)) then
                    closed(:) = flipped
                    work = other
                    is_tie(:) = .false.
                    flips = flips + 1
                    cycle
                end if
            end if
            is_tie(k) = .true.
            ties = ties + 1
        end do
    end subroutine flip_ill_scaled

    !> The first support that is wrong by as much as may matter, 0 where there is none
    pure function first_wrong(beam, closed, work, is_tie) result(first)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Supports that have been found to be at zero
        logical, intent(in), optional :: is_tie(:)
        integer :: first
        real(qp) :: margin, rounding, least
        integer :: k

        least = least_that_matters(work)
        do first = 1, size(closed)
            k = first
            if (present(is_tie)) then
                if (is_tie(k)) cycle
            end if
            if (.not. is_watched_in(beam%supports, closed, k)) cycle
            associate (s => beam%supports(k))
                call margin_of(s, closed(k), work%answers(s%node)%deflection, 0.0_qp, work%reaction(k), 0.0_qp, margin, rounding)
                if (.not. margin < 0.0_qp) cycle
                ! What comes through an open support pushes back no harder than the links beside it, held fast, or its spring
                if (.not. closed(k)) margin = margin*min(s%stiffness, stiffness_beside(beam, s%node))
                if (margin < -least) return
            end associate
        end do
        first = 0
    end function first_wrong

    !> Is a support wrong by far more than rounding: flipped, it would leave the beam without hold
    pure function is_surely_wrong(beam, closed, k, work) result(is_wrong)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        type(workspace_type), intent(in) :: work
        logical :: is_wrong
        real(qp) :: margin, rounding

        associate (s => beam%supports(k))
            call margin_of(s, closed(k), work%answers(s%node)%deflection, work%deflection_size(s%node), work%reaction(k), &
                           work%reaction_error(k), margin, rounding)
        end associate
        is_wrong = margin < -fine_width*rounding
    end function is_surely_wrong

    !> Bound of the stiffness with which the links beside a node hold it
    pure function stiffness_beside(beam, node) result(stiffness)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: node
        real(qp) :: stiffness
        integer :: i

        stiffness = 0.0_qp
        do i = max(node, 1), min(node + 1, size(beam%links))
            associate (link => beam%links(i))
                if (.not. link%determinant > 0.0_qp) then
                    stiffness = sqrt(huge(1.0_qp))   ! rigid, or rigid but for its shear
                    return
                end if
                stiffness = stiffness + link%bending/link%determinant*link%inverse**2
            end associate
        end do
    end function stiffness_beside

    !> The force below which forces do not matter
    pure function least_that_matters(work) result(force)
        type(workspace_type), intent(in) :: work
        real(qp) :: force

        force = least_force_share*max(maxval(work%load_size), maxval(abs(work%reaction)))
    end function least_that_matters

end module gapbeam_ill_scaled_signs
