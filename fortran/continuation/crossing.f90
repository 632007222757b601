!> Parameter of a change between two states on a path: the zero of how far the change is away.
!>
!> That is a continuous function of the parameter, but smooth on one side of its zero only. So its zero is found by secants
!> through points on the smooth side, safeguarded by the bracket; those that go over it are taken back.
module gapbeam_crossing
    use gapbeam_kinds, only: wp
    use gapbeam_zone_margin, only: change_type
    use gapbeam_path_problem, only: point_type, path_problem_type, crossing_type
    implicit none
    private
    public :: find_crossing

    !> Parameters at most
    integer, parameter :: most_steps = 60
    !> Steps that are no longer than this share of the parameter are the last ones
    real(wp), parameter :: near_enough = 2.0_wp**(-40)
    !> The margin is nothing but rounding where it asks for no more than this
    real(wp), parameter :: rounding = 2.0_wp**(-30)
    !> From parameters that are nearer to each other no slope is taken
    real(wp), parameter :: zero_motion = 2.0_wp**(-34)
    !> So many times farther than a secant tells it goes back over the zero, and so many times farther again
    real(wp), parameter :: back = 4.0_wp, farther = 16.0_wp
    !> So often a step may be longer than half of the one before
    integer, parameter :: non_monotone_steps = 2
    !> Part of the way between the two parameters around the place of the change in which that is looked for at last
    real(wp), parameter :: around = 2.0_wp**(-12)

    !> What was measured on the way
    type :: measured_type
        real(wp) :: at, margin, place
        class(point_type), allocatable :: point
    end type measured_type

contains

    !> Find it, if it can be followed
    subroutine find_crossing(problem, change, low, high, crossing, found)
        class(path_problem_type), intent(inout) :: problem
        !> By list_changes
        type(change_type), intent(in) :: change
        !> The points before and after it
        class(point_type), intent(in) :: low, high
        type(crossing_type), intent(out) :: crossing
        logical, intent(out) :: found
        type(change_type) :: of_slope

        call follow_margin(problem, change, low, high, crossing, found)
        if (found .or. change%support > 0 .or. change%to > change%from) return
        of_slope = change
        of_slope%by_slope = .true.
        call follow_margin(problem, of_slope, low, high, crossing, found)
    end subroutine find_crossing

    !> The same for the margin of the change as it is given
    subroutine follow_margin(problem, change, low, high, crossing, found)
        !> As for find_crossing
        class(path_problem_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        class(point_type), intent(in) :: low, high
        type(crossing_type), intent(out) :: crossing
        logical, intent(out) :: found
        !> Next to the zero on the side on which the margin is smooth, on the other side, and the last one
        type(measured_type) :: near, over, now
        !> The one behind that next to the zero
        real(wp) :: far_at, far_margin, next, slope, way, growth, size, unit, of_over
        integer :: step, waited
        logical :: known

        found = .false.
        crossing%change = change
        size = problem%size_at(high%at)
        call measure_at(problem, change, low%at, low, near, known)
        if (known) call measure_at(problem, change, high%at, high, over, known)
        if (known) known = min(near%margin, over%margin) < 0.0_wp .and. max(near%margin, over%margin) > 0.0_wp
        if (.not. known) return
        ! The ground may be far stiffer than the beam, so that the margin bends sharply where a zone begins
        if (change%support == 0 .and. (near%margin < 0.0_wp .neqv. change%greatest)) call swap(near, over)
        ! A support has a force where it acts, and a distance where it does not: in the unit of the smooth side both have one slope
        of_over = over%margin
        unit = 1.0_wp
        if (change%support > 0) unit = abs(near%margin/of_over)
        over%margin = unit*of_over
        now%at = near%at
        now%margin = near%margin
        now%place = near%place
        far_at = near%at
        far_margin = near%margin
        way = high%at - low%at
        growth = back
        waited = 0
        do step = 1, most_steps
            slope = (over%margin - near%margin)/(over%at - near%at)
            if (may_be_secant()) slope = (near%margin - far_margin)/(near%at - far_at)
            next = now%at - now%margin/slope
            if (step > 1 .and. abs(next - now%at) <= near_enough*problem%size_at(now%at)) exit
            if (now%margin > 0.0_wp .eqv. over%margin > 0.0_wp) then
                next = merge(now%at - growth*now%margin/slope, near%at, may_be_secant())
                growth = farther*growth
            else
                growth = back
                if (abs(next - now%at) > way/2) waited = waited + 1
                way = abs(next - now%at)
                if (waited > non_monotone_steps) then
                    if (way <= rounding*problem%size_at(now%at)) exit
                    next = near%at
                    waited = 0
                end if
            end if
            if (.not. (next > min(near%at, over%at) .and. next < max(near%at, over%at))) then
                next = near%at + (over%at - near%at)/2
                if (abs(next - near%at) <= near_enough*problem%size_at(next)) exit
            end if
            if (abs(next - near%at) < abs(next - over%at)) then
                call measure_at(problem, change, next, near%point, now, known, over%point)
            else
                call measure_at(problem, change, next, over%point, now, known, near%point)
            end if
            if (.not. known) return
            if (.not. abs(now%margin) > 0.0_wp) exit
            if (now%margin > 0.0_wp .eqv. over%margin > 0.0_wp) then
                call take_over()
            else
                far_at = near%at
                far_margin = near%margin
                call become(near, now)
            end if
        end do
        call put_crossing(change, near, over, now, slope, crossing)
        found = abs(now%margin) <= abs(slope)*rounding*problem%size_at(now%at)

    contains

        !> Take what was measured on the other side in the unit of the smooth one
        subroutine take_over()
            real(wp) :: slope_over

            slope_over = (of_over - now%margin)/(over%at - now%at)
            if (change%support > 0 .and. may_be_secant() .and. slope_over*slope > 0.0_wp) unit = slope/slope_over
            of_over = now%margin
            now%margin = unit*of_over
            call become(over, now)
        end subroutine take_over

        !> Are there two points on the smooth side that tell a slope, of the sign that it has to have
        pure function may_be_secant() result(may_be)
            logical :: may_be

            may_be = abs(near%at - far_at) > zero_motion*size
            if (.not. may_be) return
            may_be = (near%margin - far_margin)/(near%at - far_at) &
                *((over%margin - near%margin)/(over%at - near%at)) > 0.0_wp
        end function may_be_secant

    end subroutine follow_margin

    !> What is known of it at last
    subroutine put_crossing(change, near, over, now, slope, crossing)
        !> As in follow_margin
        type(change_type), intent(in) :: change
        type(measured_type), intent(inout) :: near
        type(measured_type), intent(in) :: over, now
        real(wp), intent(in) :: slope
        type(crossing_type), intent(inout) :: crossing

        crossing%at = now%at
        crossing%one_further = now%at
        if (abs(now%margin) > 0.0_wp) then
            crossing%one_further = near%at - near%margin/slope
            if (change%support > 0) crossing%one_further = now%at - now%margin/slope
            crossing%one_further = max(min(near%at, over%at), min(max(near%at, over%at), crossing%one_further))
        end if
        crossing%slope = slope
        crossing%place = now%place
        call move_alloc(near%point, crossing%near)
        if (change%support == 0 .and. change%to > change%from) then
            associate (way => around*(change%to - change%from))
                crossing%change%from = max(change%from, now%place - way)
                crossing%change%to = min(change%to, now%place + way)
            end associate
        end if
    end subroutine put_crossing

    !> Measure a margin at a parameter
    subroutine measure_at(problem, change, at, start, measured, known, other)
        class(path_problem_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: at
        !> Where to begin
        class(point_type), intent(in) :: start
        type(measured_type), intent(inout) :: measured
        logical, intent(out) :: known
        !> Where to begin if that leads nowhere
        class(point_type), intent(in), optional :: other

        measured%at = at
        call problem%measure(change, at, start, measured%point, measured%margin, measured%place, known, other)
    end subroutine measure_at

    !> Let one take the place of another
    subroutine become(measured, now)
        type(measured_type), intent(inout) :: measured
        !> Its point is gone then
        type(measured_type), intent(inout) :: now

        measured%at = now%at
        measured%margin = now%margin
        measured%place = now%place
        call move_alloc(now%point, measured%point)
    end subroutine become

    !> Exchange two
    subroutine swap(one, other)
        type(measured_type), intent(inout) :: one, other
        type(measured_type) :: kept

        call become(kept, one)
        call become(one, other)
        call become(other, kept)
    end subroutine swap

end module gapbeam_crossing
