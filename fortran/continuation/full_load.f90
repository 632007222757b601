!> A beam at full load: by one search, or at the end of the path there where its state depends on the loading history.
module gapbeam_full_load
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_path_segments
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged, gapbeam_no_equilibrium
    use gapbeam_words, only: whole
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_laws, only: laws_depend_on_path
    use gapbeam_solution, only: state_type
    use gapbeam_smooth_laws, only: smooth_supports
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_history_record, only: history_type, runs_of, at_limit_stop, cut_off
    use gapbeam_smooth_path, only: follow_on_laws
    use gapbeam_path_states, only: solve_on_path
    implicit none
    private
    public :: solve_full_load, is_solved_alone

contains

    !> Is a state more than one search for the scheme of a beam whose loads add up, so that no case helps to solve another: is it
    !> solved in stretches, known on a path alone, or are supports on curves
    function is_solved_alone(assembled) result(it_is)
        type(assembled_type), intent(in) :: assembled
        logical :: it_is

        it_is = allocated(assembled%layers)
        if (.not. it_is) it_is = is_known_on_path(assembled)
        if (.not. it_is) it_is = size(smooth_supports(assembled)) > 0
    end function is_solved_alone

    !> Is a state known on a path alone. Where loads do no more than move supports, they have moved, on whatever path
    function is_known_on_path(assembled) result(it_is)
        type(assembled_type), intent(in) :: assembled
        logical :: it_is

        it_is = assembled%depends_on_path
        if (it_is .and. allocated(assembled%given_settlement)) it_is = laws_depend_on_path(assembled)
    end function is_known_on_path

    !> Solve a beam under all its loads; by a path these are put on once, dead ones first
    subroutine solve_full_load(assembled, rule, state, error)
        type(assembled_type), intent(in), target :: assembled
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> New, with the start of a search, in; solved, or with the status gapbeam_no_equilibrium or gapbeam_buckles, out
        type(state_type), intent(inout) :: state
        !> As for solve_on_laws, follow_on_laws and solve_on_path
        type(error_type), allocatable, intent(out) :: error
        type(history_type), target :: history
        integer :: number, solves
        logical :: exact

        if (.not. is_known_on_path(assembled)) then
            call solve_on_laws(assembled, 1.0_wp, rule, state, error)
            return
        end if
        call follow_on_laws(assembled, [1.0_wp], at_limit_stop, most_path_segments, history, error)
        if (allocated(error)) return
        if (history%ending == cut_off) then
            call fatal_error(error, gapbeam_not_converged, "the path to this load has more than "// &
                             trim(whole(history%number))//" stretches")
            return
        end if
        number = last_at_full_load(history)
        solves = history%solves
        if (number == 0) then
            state%status = gapbeam_no_equilibrium
            state%solves = solves
            return
        end if
        call solve_on_path(assembled, history, number, 1.0_wp, state, error, exact)
        state%solves = state%solves + solves
        if (.not. (allocated(error) .or. exact)) then
            call fatal_error(error, gapbeam_not_converged, "the state at full load is known on the polylines of the "// &
                             "smooth laws only: give the laws by points")
        end if
    end subroutine solve_full_load

    !> The last stretch that comes to full load in a stable state; 0 where none does
    pure function last_at_full_load(history) result(number)
        type(history_type), intent(in) :: history
        integer :: number
        integer, allocatable :: runs(:, :)
        integer :: k

        allocate (runs, source=runs_of(history))
        do k = size(runs, 2), 1, -1
            number = runs(2, k)
            associate (first => history%stretches(runs(1, k)), s => history%stretches(number))
                if (s%skipped .or. s%leg == 0 .or. s%direction /= 1 .or. s%index /= 0) cycle
                if (first%from <= 1.0_wp .and. s%to >= 1.0_wp) return
            end associate
        end do
        number = 0
    end function last_at_full_load

end module gapbeam_full_load
