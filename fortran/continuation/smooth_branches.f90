!> Stable paths beyond a bifurcation on smooth laws, and where the load stops growing along one of them.
!>
!> On polylines of equal laws that soften together the slopes on both sides of a breakpoint decide what is stable, and these depend
!> on where the breakpoints happen to be. Here the equations of gapbeam_smooth_arc are followed on the laws themselves from the
!> bifurcation on, by pseudo-arclength (Keller 1977) with short steps. Points are deflections at the smooth laws and the factor.
module gapbeam_smooth_branches
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_branch_points
    use gapbeam_path_tolerances, only: arc_noise, beside_branching, first_branch_step, longest_branch_step, &
        shortest_branch_step, branch_bend, branch_rises, crossing_directions
    use gapbeam_error, only: error_type
    use gapbeam_dense_solver, only: solve_least_squares, find_singular_values
    use gapbeam_smooth_arc, only: forces_at, lose, is_lost
    use gapbeam_arc_states, only: holds_at
    use gapbeam_branch_points, only: tracer_type, tracer_at, branch_points_type, add_point, correct_point, tangent_at, &
        is_stable_at, jacobian_at, point_at_factor, find_top, find_crossing
    implicit none
    private
    public :: follow_branch, branch_points_type, tracer_at, point_at_factor

contains

    !> Follow a stable way on until the load cannot grow any more, or comes to a factor
    subroutine follow_branch(tracer, way, goal, branch, error)
        !> At the bifurcation
        type(tracer_type), intent(in) :: tracer
        !> Where the load goes, 1 or -1, and the load factor at which to end
        integer, intent(in) :: way
        real(wp), intent(in) :: goal
        type(branch_points_type), intent(out) :: branch
        !> Whether a stable way goes on cannot be told
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), values(:), rows(:, :), aside(:), point(:), first(:), tangent(:)
        real(wp) :: rise
        integer :: n, side, taken
        logical :: solved, stable

        n = size(tracer%force)
        associate (origin => tracer%origin, weights => tracer%arc%weights)
            allocate (matrix(n, n + 1), values(n), rows(n, n), aside(n + 1), point(n + 1), first(n + 1), tangent(n + 1))
            call jacobian_at(tracer, origin, matrix, solved)
            if (solved) call find_singular_values(matrix(:, :n), values, rows, solved)
            if (solved .and. n > 1) solved = .not. values(max(n - 1, 1)) < crossing_directions*values(1)
            if (.not. solved) then
                call lose(error)
                return
            end if
            aside(:n) = rows(n, :)
            aside(n + 1) = 0.0_wp
            if (aside(maxloc(abs(aside), 1)) < 0.0_wp) aside = -aside
            taken = 0
            do side = 1, -1, -2
                point(:) = origin + side*beside_branching*aside*weights
                call correct_point(tracer, aside, point, error)
                if (allocated(error)) return
                rise = way*(point(n + 1) - origin(n + 1))
                if (abs(rise) < branch_rises*max(abs(origin(n + 1)), weights(n + 1)*beside_branching)) call lose(error)
                stable = .false.
                if (.not. allocated(error) .and. rise > 0.0_wp) call is_stable_at(tracer, point, stable, error)
                if (allocated(error)) return
                if (.not. stable .or. taken /= 0) cycle
                taken = side
                first(:) = point
            end do
            call add_point(origin, branch)
            if (taken == 0) return
            call add_point(first, branch)
            call check_pieces(tracer, first, error)
            if (.not. allocated(error)) call tangent_at(tracer, first, taken*aside, tangent, error)
            if (.not. allocated(error)) call go_on(tracer, way, goal, tangent, branch, error)
        end associate
        if (.not. is_lost(error)) return
        deallocate (error)
        branch%number = 2
        branch%lost = .true.
    end subroutine follow_branch

    !> Whether all supports are still on their pieces
    subroutine check_pieces(tracer, point, error)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:)
        !> They are not
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: force(:), slope(:), past(:)
        integer :: n
        logical :: holds

        n = size(tracer%force)
        allocate (force(n), slope(n), past(n))
        call forces_at(tracer%arc, point(:n), force, slope, past)
        holds = all((past > 0.0_wp) .eqv. (tracer%past > 0.0_wp))
        if (holds) call holds_at(tracer%arc, point, arc_noise, holds, error)
        if (.not. (holds .or. allocated(error))) call lose(error)
    end subroutine check_pieces

    !> From the first point on
    subroutine go_on(tracer, way, goal, tangent, branch, error)
        !> As for follow_branch
        type(tracer_type), intent(in) :: tracer
        integer, intent(in) :: way
        real(wp), intent(in) :: goal
        !> Direction at the last point
        real(wp), intent(inout) :: tangent(:)
        type(branch_points_type), intent(inout) :: branch
        !> The path is lost
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: ahead(:), turned(:), last(:)
        real(wp) :: step
        integer :: tried, n
        logical :: stable, crosses

        n = size(tangent) - 1
        allocate (ahead(n + 1), turned(n + 1), last(n + 1))
        step = first_branch_step
        do tried = 1, most_branch_points
            last(:) = branch%points(:, branch%number)
            call look_ahead()
            if (is_lost(error)) then
                step = step/2
                if (step < shortest_branch_step) return
                deallocate (error)
                cycle
            end if
            if (allocated(error)) return
            if (way*turned(n + 1) <= 0.0_wp) then
                call find_crossing(tracer, last, tangent, step, crosses, ahead, error)
                if (allocated(error)) return
                if (.not. crosses) then
                    call find_top(tracer, last, tangent, step, way, ahead, error)
                    if (.not. allocated(error)) call check_pieces(tracer, ahead, error)
                    if (.not. allocated(error)) call add_point(ahead, branch)
                    return
                end if
                call leave_crossing()
            else if (way*(ahead(n + 1) - goal) >= 0.0_wp) then
                call add_point(ahead, branch)
                if (.not. allocated(error)) call point_at_factor(tracer, branch%points(:, :branch%number), goal, last, error)
                if (.not. allocated(error)) call check_pieces(tracer, last, error)
                branch%points(:, branch%number) = last
                branch%arrives = .not. allocated(error)
                return
            else
                call is_stable_at(tracer, ahead, stable, error)
                if (.not. (allocated(error) .or. stable)) call lose(error)
                if (.not. allocated(error)) call check_pieces(tracer, ahead, error)
                if (.not. allocated(error)) call add_point(ahead, branch)
                tangent(:) = turned
                step = min(1.3_wp*step, longest_branch_step)
            end if
            if (allocated(error)) return
        end do
        call lose(error)

    contains

        !> The point a step ahead, and the direction there, which has not changed by much
        subroutine look_ahead()
            ahead(:) = last + step*tangent*tracer%arc%weights
            call correct_point(tracer, tangent, ahead, error)
            if (.not. allocated(error)) call tangent_at(tracer, ahead, tangent, turned, error)
            if (allocated(error)) return
            if (maxval(abs(turned - tangent)) > branch_bend) call lose(error)
        end subroutine look_ahead

        !> Go on along the other branch where branches cross
        subroutine leave_crossing()
            call add_point(ahead, branch)
            call other_branch(tracer, ahead, way, tangent, error)
            if (allocated(error)) return
            step = first_branch_step
            ahead(:) = ahead + step*tangent*tracer%arc%weights
            call correct_point(tracer, tangent, ahead, error)
            if (.not. allocated(error)) call add_point(ahead, branch)
            if (.not. allocated(error)) call tangent_at(tracer, ahead, tangent, turned, error)
            if (.not. allocated(error)) call is_stable_at(tracer, ahead, stable, error)
            if (allocated(error)) return
            tangent(:) = turned
            if (.not. (way*tangent(n + 1) > 0.0_wp .and. stable)) call lose(error)
        end subroutine leave_crossing

    end subroutine go_on

    !> Direction of the other branch where branches cross
    subroutine other_branch(tracer, point, way, tangent, error)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:)
        integer, intent(in) :: way
        real(wp), intent(out) :: tangent(:)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), ahead(:, :)
        integer :: n
        logical :: solved

        n = size(point) - 1
        allocate (matrix(n, n + 1), ahead(n, 1))
        tangent(:) = 0.0_wp
        call jacobian_at(tracer, point, matrix, solved)
        if (solved) call solve_least_squares(matrix(:, :n), -matrix(:, n + 1:), crossing_directions, ahead, solved)
        if (.not. solved) then
            call lose(error)
            return
        end if
        tangent(:n) = ahead(:, 1)
        tangent(n + 1) = 1.0_wp
        tangent(:) = way*tangent/norm2(tangent)
    end subroutine other_branch

end module gapbeam_smooth_branches
