!> Load path of a beam on the ground: changes of zones of contact and supports at their factors (gapbeam_ground_problem).
module gapbeam_ground_path
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: load_begin
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_walk, only: walk_along
    use gapbeam_ground_events, only: ground_path_type, held_type, add_segment
    use gapbeam_ground_problem, only: ground_problem_type, new_ground_problem
    implicit none
    private
    public :: follow_on_ground

<<<<<<< HEAD
    !> Parts into which the loading history is cut before changes are looked for
    integer, parameter :: parts = 64
    !> Curves come to their limit where the beam has gone without end: the path is followed until this share of it is missing, or
    !> that, powers of 2
    integer, parameter :: missing_powers(*) = [-20, -10]
    !> Where the load at load_begin is nothing beside gaps and settlements, what acts from the beginning is what acts at one of the
    !> next shares of the way
    real(wp), parameter :: begins(*) = [load_begin, 2.0_wp**(-34), 2.0_wp**(-28), 2.0_wp**(-22)]
=======
    !> What acts at this share of the way, a power of 2, acts from the beginning: at factor 0 a beam without dead load lies there
    !> without any force. Where so small a load is nothing beside gaps and settlements, it is what acts at one of the next shares
    integer, parameter :: begin_powers(*) = [-40, -34, -28, -22]
>>>>>>> hlp4

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

        call new_ground_problem(assembled, factor, rule, state, problem)
        call go_along(problem, error)
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

<<<<<<< HEAD
        call find_limits(assembled, yields, levels_off)
        associate (factor => walk%last)
            do k = 1, size(begins)
                at = factor*begins(k)
                if (allocated(walk%trouble)) deallocate (walk%trouble)
                call hold(assembled, walk, at, now, error)
                if (allocated(error)) return
                if (.not. allocated(walk%trouble)) exit
            end do
            if (.not. now%stands) then
                call move_alloc(walk%trouble, error)
                path%beyond = 0.0_wp
                return
            end if
            call add_segment(0.0_wp, now, path, error)
=======
        do k = 1, size(begin_powers)
            call problem%find(problem%last*2.0_wp**begin_powers(k), start, error)
>>>>>>> hlp4
            if (allocated(error)) return
            if (.not. allocated(start%trouble)) exit
        end do
        if (.not. start%stands) then
            if (allocated(start%trouble)) error = start%trouble
            problem%path%beyond = 0.0_wp
            return
        end if
        select type (start)
        type is (held_type)
            call add_segment(0.0_wp, start, problem%path, error)
        end select
        if (allocated(error)) return
        call walk_along(problem, start, ended, error)
        if (allocated(error) .or. ended) return
        problem%path%last = problem%last
        if (problem%state%factor < problem%last) call problem%find(problem%last, last, error)
    end subroutine go_along

end module gapbeam_ground_path
