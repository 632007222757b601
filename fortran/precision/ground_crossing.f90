!> Load factor of a change of a zone of contact or a support, between two solved states.
!>
!> How far the change is away (gapbeam_zone_margin) is a continuous function of the load factor, whose zero is found by secants in
!> double precision, and then by one step with the function in quadruple precision: on zones whose ends are off by e the beam is
!> off by the order of e**2, so zones as double precision knows them are enough for all digits of the factor.
module gapbeam_ground_crossing
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_ground, only: ground_type, grounded_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_zone_margin, only: change_type, find_margin
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, &
        fine_grounded_type => grounded_type
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_contact_state_quad, only: fine_outcome_type => outcome_type
    use gapbeam_zones_quad, only: polish_zones
    use gapbeam_zone_margin_quad, only: fine_change_type => change_type, find_fine_margin => find_margin
    use gapbeam_refined_ground, only: refine_zones
    use gapbeam_ground_start, only: ground_start_type, settle_nearby, polish_nearby
    implicit none
    private
    public :: crossing_type, find_crossing, refine_crossing

    !> Factors at most, and fine ones
    integer, parameter :: most_steps = 60, most_fine_steps = 5
    !> Steps that are no longer than these shares of the factor are the last ones: in double precision; and in quadruple precision,
    !> where the slope is that of double precision, or of two points there
    real(wp), parameter :: near_enough = 2.0_wp**(-40), exact = 2.0_wp**(-52), fine_enough = 2.0_wp**(-42)
    !> The margin is nothing but rounding where it asks for no more than this
    real(wp), parameter :: rounding = 2.0_wp**(-30)
    !> From factors that are nearer to each other no slope is taken
    real(wp), parameter :: zero_motion = 2.0_wp**(-34)
    !> So many times farther than a secant tells it goes back over the zero, and so many times farther again
    real(wp), parameter :: back = 4.0_wp, farther = 16.0_wp
    !> So often a step may be longer than half of the one before
    integer, parameter :: non_monotone_steps = 2
    !> Part of the way between the two factors around the place of the change in which that is looked for at last
    real(wp), parameter :: around = 2.0_wp**(-12)

    !> Where a change happens, as far as it is known
    type :: crossing_type
        type(change_type) :: change
        !> Load factor, slope of the margin over it there, and its distance from the left end of the beam
        real(wp) :: factor, slope, place
        !> Zones and supports next to it, on the side on which the margin is smooth
        type(ground_start_type) :: start
    end type crossing_type

    !> A state on the way
    type :: point_type
        real(wp) :: factor, margin, place
        type(ground_start_type) :: start
    end type point_type

contains

    !> Find it in double precision
    subroutine find_crossing(ground, rule, change, low, at_low, high, at_high, crossing, solves, found)
        !> The beam and its ground, and rule for its supports
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: rule
        type(change_type), intent(in) :: change
        !> Load factors before and after it, and zones and supports there
        real(wp), intent(in) :: low, high
        type(ground_start_type), intent(in) :: at_low, at_high
        !> What is found
        type(crossing_type), intent(out) :: crossing
        !> Linear solves so far
        integer, intent(inout) :: solves
        !> Is it that; the margin may have no zero that can be followed
        logical, intent(out) :: found
        type(change_type) :: of_slope

        call follow_margin(ground, rule, change, low, at_low, high, at_high, crossing, solves, found)
        if (found .or. change%support > 0 .or. change%to > change%from) return
        of_slope = change
        of_slope%by_slope = .true.
        call follow_margin(ground, rule, of_slope, low, at_low, high, at_high, crossing, solves, found)
    end subroutine find_crossing

    !> The same for the margin of the change as it is given
    subroutine follow_margin(ground, rule, change, low, at_low, high, at_high, crossing, solves, found)
        !> As for find_crossing
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: rule
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: low, high
        type(ground_start_type), intent(in) :: at_low, at_high
        type(crossing_type), intent(out) :: crossing
        integer, intent(inout) :: solves
        logical, intent(out) :: found
        !> The point next to the zero on the side on which the margin is smooth, the one behind it, that on the other side, the last
        type(point_type) :: near, far, over, now
        real(wp) :: next, slope, way, growth
        integer :: step, waited
        logical :: known

        found = .false.
        crossing%change = change
        call solve_at(low, at_low, near, known)
        if (known) call solve_at(high, at_high, over, known)
        if (.not. known) return
        if (.not. min(near%margin, over%margin) < 0.0_wp .or. .not. max(near%margin, over%margin) > 0.0_wp) return
        ! The ground may be far stiffer than the beam, so that the margin bends sharply where a zone begins
        if (change%support == 0 .and. (near%margin < 0.0_wp .neqv. change%greatest)) then
            now = near
            near = over
            over = now
        end if
        far = near
        now = near
        way = high - low
        growth = back
        waited = 0
        do step = 1, most_steps
            slope = (over%margin - near%margin)/(over%factor - near%factor)
            if (may_be_secant()) slope = (near%margin - far%margin)/(near%factor - far%factor)
            next = now%factor - now%margin/slope
            if (step > 1 .and. abs(next - now%factor) <= near_enough*now%factor) exit
            if (now%margin > 0.0_wp .eqv. over%margin > 0.0_wp) then
                next = merge(now%factor - growth*now%margin/slope, near%factor, may_be_secant())
                growth = farther*growth
            else
                growth = back
                if (abs(next - now%factor) > way/2) waited = waited + 1
                way = abs(next - now%factor)
                if (waited > non_monotone_steps) then
                    if (way <= rounding*now%factor) exit
                    next = near%factor
                    waited = 0
                end if
            end if
            if (.not. (next > min(near%factor, over%factor) .and. next < max(near%factor, over%factor))) then
                next = near%factor + (over%factor - near%factor)/2
                if (abs(next - near%factor) <= near_enough*next) exit
            end if
            if (abs(next - near%factor) < abs(next - over%factor)) then
                call solve_at(next, near%start, now, known, over%start)
            else
                call solve_at(next, over%start, now, known, near%start)
            end if
            if (.not. known) return
            if (.not. abs(now%margin) > 0.0_wp) exit
            if (now%margin > 0.0_wp .eqv. over%margin > 0.0_wp) then
                over = now
            else
                far = near
                near = now
            end if
        end do
        crossing%factor = now%factor
        crossing%slope = slope
        crossing%place = now%place
        crossing%start = near%start
        if (change%support == 0 .and. change%to > change%from) then
            associate (way => around*(change%to - change%from))
                crossing%change%from = max(change%from, now%place - way)
                crossing%change%to = min(change%to, now%place + way)
            end associate
        end if
        found = abs(now%margin) <= abs(slope)*rounding*now%factor

    contains

        !> Are there two points on the smooth side that tell a slope, of the sign that it has to have
        pure function may_be_secant() result(may_be)
            logical :: may_be

            may_be = abs(near%factor - far%factor) > zero_motion*high
            if (.not. may_be) return
            may_be = (near%margin - far%margin)/(near%factor - far%factor) &
                *((over%margin - near%margin)/(over%factor - near%factor)) > 0.0_wp
        end function may_be_secant

        !> Solve at a factor
        subroutine solve_at(factor, start, point, known, other)
            real(wp), intent(in) :: factor
            !> Where to begin
            type(ground_start_type), intent(in) :: start
            type(point_type), intent(out) :: point
            logical, intent(out) :: known
            !> Where to begin if that leads nowhere
            type(ground_start_type), intent(in), optional :: other
            type(grounded_type) :: grounded
            type(workspace_type) :: work
            logical :: settled

            point%factor = factor
            point%start = start
            call settle_nearby(ground, factor, rule, point%start, grounded, work, solves, settled, known)
            if (present(other) .and. .not. settled) then
                point%start = other
                call settle_nearby(ground, factor, rule, point%start, grounded, work, solves, settled, known)
            end if
            if (.not. known) return
            call find_margin(ground, grounded, point%start%zones, factor, work, point%start%closed, change, point%margin, &
                             point%place)
        end subroutine solve_at

    end subroutine follow_margin

    !> Go on in quadruple precision
    subroutine refine_crossing(ground, fine, rule, crossing, solves, found)
        !> The beam and its ground, and the same in quadruple precision
        type(ground_type), intent(in) :: ground
        type(fine_ground_type), intent(in) :: fine
        integer, intent(in) :: rule
        type(crossing_type), intent(inout) :: crossing
        integer, intent(inout) :: solves
        logical, intent(out) :: found
        type(fine_zones_type) :: zones
        type(fine_grounded_type) :: fine_grounded
        type(fine_workspace_type) :: fine_work
        type(fine_outcome_type) :: outcome
        type(fine_change_type) :: change
        type(error_type), allocatable :: error
        logical, allocatable :: closed(:)
        logical :: settled, solved
        real(qp) :: margin, last_margin, place, step
        real(wp) :: last
        integer :: k

        found = .false.
        associate (c => crossing%change)
            change = fine_change_type(c%support, c%closed, c%foundation, c%side, c%branch, c%from, c%to, c%greatest, &
                                      c%by_slope)
        end associate
        allocate (closed(size(crossing%start%closed)))
        do k = 1, most_fine_steps
            call polish_nearby(ground, crossing%factor, rule, crossing%start, solves, solved)
            if (.not. solved) return
            call refine_zones(fine, crossing%start%zones, zones)
            closed(:) = crossing%start%closed
            ! One round: what is asked for is the beam on these zones
            call polish_zones(fine, real(crossing%factor, qp), rule, huge(1.0_qp), zones, closed, fine_grounded, fine_work, &
                              outcome, settled, error)
            solves = solves + fine_work%solves
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            call find_fine_margin(fine, fine_grounded, zones, real(crossing%factor, qp), fine_work, closed, change, margin, place)
            ! Of a support it may be that on the other side
            if (k > 1) then
                if (change%support == 0 .or. margin*last_margin > 0.0_qp) then
                    crossing%slope = real((margin - last_margin)/(crossing%factor - last), wp)
                end if
            end if
            crossing%place = real(place, wp)
            last = crossing%factor
            last_margin = margin
            if (.not. abs(crossing%slope) > 0.0_wp) return
            step = -margin/crossing%slope
            if (.not. abs(step) < last) return
            crossing%factor = real(crossing%factor + step, wp)
            found = abs(step) <= merge(exact, fine_enough, k == 1)*last
            ! It would be the same factor again
            found = found .or. .not. abs(crossing%factor - last) > 0.0_wp
            if (found) return
        end do
    end subroutine refine_crossing

end module gapbeam_ground_crossing
