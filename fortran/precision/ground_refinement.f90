!> Load factor of a change of a zone of contact or a support to all digits, from what secants in double precision tell of it.
!>
!> By one step or two with the margin in quadruple precision: on zones whose ends are off by e the beam is off by the order of
!> e**2, so zones as double precision knows them are enough for all digits of the factor.
module gapbeam_ground_refinement
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_ground, only: ground_type
    use gapbeam_moved_ground, only: move_ground
    use gapbeam_zone_margin, only: change_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, &
        fine_grounded_type => grounded_type
    use gapbeam_moved_ground_quad, only: move_finely => move_ground
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_contact_state_quad, only: fine_outcome_type => outcome_type
    use gapbeam_zones_quad, only: polish_zones
    use gapbeam_zone_margin_quad, only: fine_change_type => change_type, find_fine_margin => find_margin
    use gapbeam_refined_ground, only: refine_zones
    use gapbeam_ground_start, only: ground_start_type, polish_nearby
    implicit none
    private
    public :: refine_factor

    !> Steps at most
    integer, parameter :: most_steps = 7
    !> Steps that are no longer than these shares of the factor are the last ones: where the slope is that of double precision, or
    !> of two points in quadruple precision
    real(wp), parameter :: exact = 2.0_wp**(-52), fine_enough = 2.0_wp**(-42)
    !> Share of the factor by which two points are apart at least that give the slope of a support's margin
    real(wp), parameter :: apart = 2.0_wp**(-46)

contains

    !> Find the factor to all digits
    subroutine refine_factor(ground, fine, rule, change, factor, slope, place, start, solves, found)
        !> The beam and its ground, moved to any factor, the same in quadruple precision, and the rule for its supports
        type(ground_type), intent(inout) :: ground
        type(fine_ground_type), intent(inout) :: fine
        integer, intent(in) :: rule
        type(change_type), intent(in) :: change
        !> Load factor, slope of the margin over it, and the place of the change from the left end of the beam
        real(wp), intent(inout) :: factor, slope, place
        !> Zones and supports next to it, on the side on which the margin is smooth
        type(ground_start_type), intent(inout) :: start
        !> Linear solves so far
        integer, intent(inout) :: solves
        logical, intent(out) :: found
        type(fine_zones_type) :: zones
        type(fine_grounded_type) :: fine_grounded
        type(fine_workspace_type) :: fine_work
        type(fine_outcome_type) :: outcome
        type(fine_change_type) :: fine_change
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:)
        logical :: settled, solved
        real(qp) :: margin, last_margin, fine_place, step
        real(wp) :: last
        integer :: k

        found = .false.
        associate (c => change)
            fine_change = fine_change_type(c%support, c%closed, c%foundation, c%side, c%branch, c%from, c%to, c%greatest, &
                                           c%by_slope)
        end associate
        allocate (closed(size(start%closed)))
        last = factor
        last_margin = 0.0_qp
        do k = 1, most_steps
            call move_ground(ground, factor)
            call polish_nearby(ground, factor, rule, start, solves, solved)
            if (.not. solved) return
            call refine_zones(fine, start%zones, zones)
            closed(:) = start%closed
            call move_finely(fine, real(factor, qp))
            ! One round: what is asked for is the beam on these zones
            call polish_zones(fine, real(factor, qp), rule, huge(1.0_qp), zones, closed, fine_grounded, fine_work, outcome, &
                              settled, error)
            solves = solves + fine_work%solves
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            call find_fine_margin(fine, fine_grounded, zones, real(factor, qp), fine_work, closed, fine_change, margin, fine_place)
            place = real(fine_place, wp)
            if (k > 1) then
                if (change%support > 0 .and. .not. margin*last_margin > 0.0_qp) then
                    ! That on the other side, a force for a distance, or a distance for a force: as far to this side instead
                    found = .not. abs(margin) > 0.0_qp
                    if (found) return
                    factor = last - (factor - last)
                    cycle
                end if
                slope = real((margin - last_margin)/(factor - last), wp)
            end if
            last = factor
            last_margin = margin
            if (.not. abs(slope) > 0.0_wp) return
            step = -margin/slope
            ! The slope of double precision may be that on the other side
            if (k == 1 .and. change%support > 0) step = sign(max(abs(step), real(apart*factor, qp)), step)
            if (.not. abs(step) < last) return
            factor = real(factor + step, wp)
            if (k == 1 .and. change%support > 0) cycle
            found = abs(step) <= merge(exact, fine_enough, k == 1)*last
            ! It would be the same factor again
            found = found .or. .not. abs(factor - last) > 0.0_wp
            if (found) return
        end do
    end subroutine refine_factor

end module gapbeam_ground_refinement
