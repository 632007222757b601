!> Changes of supports whose law is a curve, along a path whose states are found by a solve each: where they leave the beam, or meet
!> it. Along the curve nothing happens.
module gapbeam_curve_changes
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: is_smooth
    use gapbeam_line_search, only: bracket_type, place_inside, narrow
    use gapbeam_zone_margin, only: change_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: past_curve
    use gapbeam_solution, only: state_type
    use gapbeam_path_problem, only: point_type, path_problem_type, crossing_type
    implicit none
    private
    public :: is_of_curve, margin_of_curve, narrow_on_curve

    !> Share of a parameter within which it is known before all its digits are looked for
    real(wp), parameter :: beside = 2.0_wp**(-22)

contains

    !> Is a change that of a support on a curve, which a deflection of the beam tells to all digits
    pure function is_of_curve(assembled, change) result(it_is)
        type(assembled_type), intent(in) :: assembled
        type(change_type), intent(in) :: change
        logical :: it_is

        it_is = change%support > 0
        if (it_is) it_is = is_smooth(assembled%model%supports(assembled%normal(change%support))%law)
    end function is_of_curve

    !> How far away such a change is in a state on the curves: below zero before it, above zero after it
    pure function margin_of_curve(assembled, state, change) result(margin)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        type(change_type), intent(in) :: change
        real(wp) :: margin
        integer :: way

        call past_curve(assembled, assembled%normal(change%support), state%deflection, state%reaction, margin, way)
        margin = merge(-abs(margin), abs(margin), state%closed(change%support) .eqv. change%closed)
    end function margin_of_curve

    !> All digits of the parameter at which a support on a curve changes
    subroutine narrow_on_curve(problem, crossing, found)
        class(path_problem_type), intent(inout) :: problem
        !> But for its last digits in, all of them out
        type(crossing_type), intent(inout) :: crossing
        !> Are there states on either side
        logical, intent(out) :: found
        type(bracket_type) :: bracket
        class(point_type), allocatable :: point
        real(wp) :: at, margin, place

        associate (c => crossing)
            bracket%low = c%at*(1 - beside)
            bracket%high = c%at*(1 + beside)
            call problem%measure(c%change, bracket%low, c%near, point, bracket%at_low, place, found)
            if (found) call problem%measure(c%change, bracket%high, c%near, point, bracket%at_high, place, found)
            if (.not. found) return
            do while (bracket%at_low < 0.0_wp .and. bracket%at_high > 0.0_wp)
                at = place_inside(bracket)
                if (.not. (at > bracket%low .and. at < bracket%high)) exit
                c%at = at
                call problem%measure(c%change, at, c%near, point, margin, place, found)
                if (.not. found) return
                if (bracket%high - bracket%low <= 4*epsilon(at)*at .or. .not. abs(margin) > 0.0_wp) exit
                call narrow(bracket, at, margin)
            end do
        end associate
    end subroutine narrow_on_curve

end module gapbeam_curve_changes
