!> Beams that touch the ground with next to nothing, as one without weight that is loose between gaps: from more load to less.
!>
!> Zones grow shorter with the load there, far shorter than any mesh, and what they have to carry is a small difference of what
!> acts elsewhere: Newton's method finds them from nearby only. Under some times the loads they are found from anywhere; from there
!> the loads go back to what they are.
module gapbeam_less_load
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_solves_under_more
    use gapbeam_error, only: error_type, has_ended
    use gapbeam_ground, only: ground_type
    use gapbeam_moved_ground, only: under_loads
    use gapbeam_contact_state, only: outcome_type, is_solved
    use gapbeam_refined, only: detail_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_ground_solver, only: solve_on_ground
    implicit none
    private
    public :: solve_from_more_load

    !> How many times the loads are tried, in powers of two, one after the other; and by how much they go back at once, in such
    !> powers, at the most and at the least
    real(wp), parameter :: more(*) = [4.0_wp, 8.0_wp, 16.0_wp, 24.0_wp, 32.0_wp], longest = 1.0_wp, shortest = 2.0_wp**(-5)

contains

    !> Solve what could not be settled
    subroutine solve_from_more_load(ground, detail, factor, rule, closed, solution, outcome, error)
        !> As for solve_on_ground
        type(ground_type), intent(in) :: ground
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        !> With the solves that it took in and out
        type(ground_solution_type), intent(inout) :: solution
        type(outcome_type), intent(out) :: outcome
        !> Why it could not be settled in; not allocated if it could be from more load
        type(error_type), allocatable, intent(inout) :: error
        type(error_type), allocatable :: trouble
        type(ground_type) :: still
        type(ground_start_type) :: start
        logical :: first(size(closed))
        real(wp) :: power, step
        integer :: k, solves

        first(:) = closed
        solves = solution%solves
        ! Supports and ground stay where they are
        still = ground
        if (allocated(still%moving)) deallocate (still%moving)
        do k = 1, size(more)
            power = more(k)
            closed(:) = first
            call solve_under(power)
            if (is_solved(outcome, trouble) .or. has_ended(trouble) .or. solves > most_solves_under_more) exit
        end do
        step = longest
        do while (is_solved(outcome, trouble) .and. power > 0.0_wp)
            call start_from(solution, closed, start)
            do
                closed(:) = start%closed
                call solve_under(max(0.0_wp, power - step), start)
                if (is_solved(outcome, trouble) .or. has_ended(trouble) .or. step <= shortest) exit
                if (solves > most_solves_under_more) exit
                step = step/2
            end do
            power = max(0.0_wp, power - step)
            step = min(2*step, longest)
        end do
        if (is_solved(outcome, trouble)) then
            solution%from_more_load = .true.
            deallocate (error)
        else if (has_ended(trouble)) then
            call move_alloc(trouble, error)
        end if

    contains

        !> Solve under so many times the loads, in powers of two
        subroutine solve_under(power, near)
            real(wp), intent(in) :: power
            type(ground_start_type), intent(in), optional :: near
            real(wp) :: times

            times = 2.0_wp**power
            call solve_on_ground(under_loads(still, times, times*factor), detail, times*factor, rule, closed, solution, outcome, &
                                 trouble, near)
            solves = solves + solution%solves
            solution%solves = solves
        end subroutine solve_under

    end subroutine solve_from_more_load

end module gapbeam_less_load
