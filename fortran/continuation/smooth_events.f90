!> Load factors of events on smooth laws: where another support passes the end of its piece.
module gapbeam_smooth_events
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_limits, only: most_tangents
    use gapbeam_tolerances, only: settled_on_laws
    use gapbeam_extended_precision, only: rule_given, rule_extended
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_state, only: solve_on_laws, refuse_laws
    implicit none
    private
    public :: find_on_laws

contains

    !> The load factor at which a support or breakpoint changes its state on the laws, from that on their polylines (secants along
    !> the tangents of the path)
    subroutine find_on_laws(assembled, closed, number, factor, error)
        type(assembled_type), intent(in), target :: assembled
        !> The scheme before
        logical, intent(in) :: closed(:)
        !> Support or breakpoint of the beam
        integer, intent(in) :: number
        !> Near in, found out
        real(wp), intent(inout) :: factor
        !> As for solve_on_laws
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: here, there
        real(wp) :: step, now, then, change
        integer :: tangents

        call new_state(assembled, here, error)
        if (allocated(error)) return
        do tangents = 1, most_tangents
            here%closed(:) = closed
            call solve_on_laws(assembled, factor, rule_given, here, error)
            if (allocated(error)) return
            if (here%status /= gapbeam_solved) then
                call refuse_laws(error)
                return
            end if
            there = here
            there%closed(:) = closed
            step = max(abs(factor), 1.0_wp)
            call solve_state(assembled, factor + step, rule_extended, there, error)
            if (allocated(error)) return
            now = margin(here)
            then = margin(there)
            if (.not. abs(then - now) > 0.0_wp) return
            change = step*now/(then - now)
            factor = factor - change
            if (abs(change) <= settled_on_laws*abs(factor)) return
        end do

    contains

        !> What is zero at the event
        pure function margin(state)
            type(state_type), intent(in) :: state
            real(wp) :: margin

            associate (s => assembled%beam%supports(number))
                if (closed(number) .and. .not. assembled%with_law(assembled%normal(number))) then
                    margin = state%reaction(number)
                else
                    margin = state%deflection(s%node) - s%contact
                end if
            end associate
        end function margin

    end subroutine find_on_laws

end module gapbeam_smooth_events
