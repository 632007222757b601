!> Load path of a beam on the ground: changes of zones of contact and supports at their factors (gapbeam_ground_problem).
module gapbeam_ground_path
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: load_begin
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input, gapbeam_buckles
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_check_rigid_ground, only: is_on_rigid_ground
    use gapbeam_solution, only: state_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_walk, only: walk_along
    use gapbeam_ground_events, only: ground_path_type, add_segment, note_links
    use gapbeam_ground_problem, only: ground_problem_type, new_ground_problem
    use gapbeam_steady_path, only: pass_steady
    implicit none
    private
    public :: follow_on_ground

    !> Where the load at load_begin is nothing beside gaps and settlements, or the beam hardly touches what it lies on (found from
    !> more load), what acts from the beginning is what acts at one of the next shares of the way
    real(wp), parameter :: begins(*) = [load_begin, 2.0_wp**(-31), 2.0_wp**(-22)]

contains

    !> Follow the load from factor 0 upwards
    subroutine follow_on_ground(assembled, factor, rule, state, path, error)
        !> A beam on the ground
        type(assembled_type), intent(in), target :: assembled
        !> Where the path ends, above 0
        real(wp), intent(in) :: factor
        !> rule_block or rule_single
        integer, intent(in) :: rule
        !> The scheme that every search starts from in; out the state at `factor`, or the motion just above path%last
        type(state_type), intent(inout) :: state
        !> All changes above load factor 0
        type(ground_path_type), intent(out) :: path
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(ground_problem_type) :: problem

        if (is_on_rigid_ground(assembled)) then
            call fatal_error(error, gapbeam_bad_input, "a beam on rigid ground is not followed from event to event in this "// &
                             "version; take steps, or give the ground a stiffness")
            return
        end if
        call new_ground_problem(assembled, factor, rule, state, problem)
        call go_along(problem, error)
        if (allocated(assembled%axial%laws) .and. .not. allocated(error) .and. problem%path%segments > 0) then
            call note_links(assembled, problem%path, error)
        end if
        path = problem%path
        path%solves = problem%solves
        state = problem%state
    end subroutine follow_on_ground

    !> Go along the whole way
    subroutine go_along(problem, error)
        type(ground_problem_type), intent(inout) :: problem
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: start, last
        logical :: ended
        integer :: k

        do k = 1, size(begins)
            call problem%find(problem%last*begins(k), start, error)
            if (allocated(error)) return
            if (.not. (allocated(start%trouble) .or. problem%state%ground%from_more_load)) exit
        end do
        if (.not. start%stands) then
            if (allocated(start%trouble)) error = start%trouble
            problem%path%beyond = 0.0_wp
            ! Without any load it may be balanced
            if (problem%state%status == gapbeam_buckles) problem%path%beyond = start%at
            return
        end if
        call add_segment(0.0_wp, start, problem%path, error)
        if (.not. allocated(error)) call pass_steady(problem, start, error)
        if (allocated(error)) return
        call walk_along(problem, start, ended, error)
        if (allocated(error) .or. ended) return
        problem%path%last = problem%last
        if (problem%state%factor < problem%last) call problem%find(problem%last, last, error)
    end subroutine go_along

end module gapbeam_ground_path
