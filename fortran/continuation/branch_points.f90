!> Points of branches beyond a bifurcation on smooth laws: put onto the path, with its direction there, stable or not.
module gapbeam_branch_points
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: arc_rounding, arc_noise, nearest_crossing, less_independent
    use gapbeam_error, only: error_type
    use gapbeam_dense_solver, only: solve_least_squares, find_singular_values
    use gapbeam_smooth_arc, only: arc_type, forces_at, tangent_matrix, lose
    use gapbeam_arc_states, only: eigenvalues_at
    implicit none
    private
    public :: tracer_type, tracer_at, branch_points_type, add_point, correct_point, tangent_at, is_stable_at, jacobian_at
    public :: point_at_factor, find_top, find_crossing

    !> Corrections of a point at most, and halvings of a step in which the load stops growing
    integer, parameter :: most_corrections = 12, halvings = 60

    !> The equations at n smooth laws, about a state at which the path branches
    type :: tracer_type
        !> Through the state
        type(arc_type), pointer :: arc => null()
        !> Deflections and load factor there, shape (n + 1); forces of the laws, and displacements past the gap, shape (n)
        real(wp), allocatable :: origin(:), force(:), past(:)
    end type tracer_type

    !> What comes after a bifurcation
    type :: branch_points_type
        !> Points from the bifurcation on, the first `number` columns; the bifurcation only where no way on is stable
        real(wp), allocatable :: points(:, :)
        integer :: number = 0
        !> Does it end at the load factor wanted; else the load cannot grow beyond its end
        logical :: arrives = .false.
        !> Does a stable way go on, but not to be followed: another support passes an end of its piece, for instance
        logical :: lost = .false.
    end type branch_points_type

contains

    !> The equations about a state
    function tracer_at(arc, origin) result(tracer)
        type(arc_type), intent(in), target :: arc
        !> Its point, shape (n + 1)
        real(wp), intent(in) :: origin(:)
        type(tracer_type) :: tracer
        real(wp) :: slope(size(origin) - 1)
        integer :: n

        n = size(origin) - 1
        allocate (tracer%origin(n + 1), tracer%force(n), tracer%past(n))
        tracer%arc => arc
        tracer%origin(:) = origin
        call forces_at(arc, origin(:n), tracer%force, slope, tracer%past)
    end function tracer_at

    !> Keep a point
    pure subroutine add_point(point, branch)
        real(wp), intent(in) :: point(:)
        type(branch_points_type), intent(inout) :: branch

        if (.not. allocated(branch%points)) allocate (branch%points(size(point), 64))
        if (branch%number == size(branch%points, 2)) then
            branch%points = reshape([branch%points, branch%points], [size(point), 2*branch%number])
        end if
        branch%number = branch%number + 1
        branch%points(:, branch%number) = point
    end subroutine add_point

    !> Derivatives of the equations by relative deflections and factor, in relative deflections
    subroutine jacobian_at(tracer, point, matrix, is_finite)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:)
        !> Shape (n, n + 1)
        real(wp), intent(out) :: matrix(:, :)
        logical, intent(out) :: is_finite
        real(wp) :: force(size(point) - 1), slope(size(point) - 1), past(size(point) - 1)

        matrix(:, :) = 0.0_wp
        is_finite = all(abs(point) <= huge(1.0_wp))
        if (.not. is_finite) return
        call forces_at(tracer%arc, point(:size(slope)), force, slope, past)
        is_finite = all(abs(slope) <= huge(1.0_wp))
        if (is_finite) call tangent_matrix(tracer%arc, slope, matrix)
        is_finite = is_finite .and. all(abs(matrix) <= huge(1.0_wp))
    end subroutine jacobian_at

    !> Go to the path at right angles to a direction
    subroutine correct_point(tracer, along, point, error)
        type(tracer_type), intent(in) :: tracer
        !> In relative numbers
        real(wp), intent(in) :: along(:)
        !> Near in, on the path out
        real(wp), intent(inout) :: point(:)
        !> There is none
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), change(:, :), wrong(:, :), start(:), force(:), slope(:), past(:), moved(:)
        integer :: correction, n
        logical :: solved

        n = size(point) - 1
        allocate (matrix(n + 1, n + 1), change(n + 1, 1), wrong(n + 1, 1), start(n + 1), force(n), slope(n), past(n), moved(n + 1))
        start(:) = point
        change(:, :) = huge(1.0_wp)
        associate (arc => tracer%arc)
            do correction = 1, most_corrections
                call jacobian_at(tracer, point, matrix(:n, :), solved)
                if (.not. solved) exit
                matrix(n + 1, :) = along
                moved(:) = point - tracer%origin
                call forces_at(arc, point(:n), force, slope, past)
                wrong(:n, 1) = (moved(:n) - moved(n + 1)*arc%under_load &
                                + matmul(arc%flexibility, force - tracer%force - arc%springs*moved(:n)))/arc%weights(1)
                wrong(n + 1, 1) = dot_product(along, (point - start)/arc%weights)
                call solve_least_squares(matrix, -wrong, arc_noise, change, solved)
                if (.not. solved) exit
                point(:) = point + change(:, 1)*arc%weights
                if (maxval(abs(change)) <= arc_rounding) return
            end do
        end associate
        if (.not. solved .or. .not. maxval(abs(change)) <= arc_noise) call lose(error)
    end subroutine correct_point

    !> Direction of the path in relative numbers, as far as it is one, in the way of another one
    subroutine tangent_at(tracer, point, like, tangent, error)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:), like(:)
        real(wp), intent(out) :: tangent(:)
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: directions(:, :)
        real(wp) :: independence

        allocate (directions(size(point), size(point)))
        call decompose(tracer, point, directions, independence, error)
        tangent(:) = directions(size(point), :)
        if (.not. dot_product(tangent, like) > 0.0_wp) tangent(:) = -tangent
    end subroutine tangent_at

    !> Singular vectors of the equations, and how far they are from dependent ones: they are where branches cross
    subroutine decompose(tracer, point, directions, independence, error)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:)
        real(wp), intent(out) :: directions(:, :), independence
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), values(:)
        integer :: n
        logical :: solved

        n = size(point) - 1
        allocate (matrix(n, n + 1), values(n))
        directions(:, :) = 0.0_wp
        independence = 0.0_wp
        call jacobian_at(tracer, point, matrix, solved)
        if (solved) call find_singular_values(matrix, values, directions, solved)
        if (solved) independence = values(n)/values(1)
        if (.not. solved) call lose(error)
    end subroutine decompose

    !> Is a state stable, but for what is zero
    subroutine is_stable_at(tracer, point, stable, error)
        type(tracer_type), intent(in) :: tracer
        real(wp), intent(in) :: point(:)
        logical, intent(out) :: stable
        !> As for eigenvalues_at
        type(error_type), allocatable, intent(out) :: error
        real(wp), dimension(size(point) - 1) :: force, slope, past, values

        call forces_at(tracer%arc, point(:size(slope)), force, slope, past)
        call eigenvalues_at(tracer%arc, slope, values, error)
        stable = minval(values) > -arc_noise*maxval(abs(values))
    end subroutine is_stable_at

    !> The point of a branch at a load factor
    subroutine point_at_factor(tracer, points, factor, point, error)
        type(tracer_type), intent(in) :: tracer
        !> Along which the factor rises or falls, shape (n + 1, number)
        real(wp), intent(in) :: points(:, :)
        !> Between those of the first and the last one
        real(wp), intent(in) :: factor
        real(wp), intent(out) :: point(:)
        !> There is none
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: along(size(point)), share
        integer :: k, n

        n = size(point) - 1
        do k = 1, size(points, 2) - 2
            if ((points(n + 1, k) - factor)*(points(n + 1, k + 1) - factor) <= 0.0_wp) exit
        end do
        if (k > size(points, 2) - 2 .and. size(points, 2) > 2) then
            if ((points(n + 1, k) - factor)*(points(n + 1, k + 1) - factor) > 0.0_wp) k = 1
        end if
        share = (factor - points(n + 1, k))/(points(n + 1, k + 1) - points(n + 1, k))
        point(:) = points(:, k) + share*(points(:, k + 1) - points(:, k))
        point(n + 1) = factor
        along(:n) = 0.0_wp
        along(n + 1) = 1.0_wp
        call correct_point(tracer, along, point, error)
    end subroutine point_at_factor

    !> Where the load stops growing, within a step
    subroutine find_top(tracer, point, tangent, step, way, top, error)
        type(tracer_type), intent(in) :: tracer
        !> Where the step begins, in which direction, how long it is, and where the load goes
        real(wp), intent(in) :: point(:), tangent(:), step
        integer, intent(in) :: way
        real(wp), intent(out) :: top(:)
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: low, high, middle, direction(size(point))
        integer :: k

        low = 0.0_wp
        high = step
        do k = 1, halvings
            middle = (low + high)/2
            top(:) = point + middle*tangent*tracer%arc%weights
            call correct_point(tracer, tangent, top, error)
            if (.not. allocated(error)) call tangent_at(tracer, top, tangent, direction, error)
            if (allocated(error)) return
            if (way*direction(size(point)) > 0.0_wp) then
                low = middle
            else
                high = middle
            end if
        end do
        top(:) = point + low*tangent*tracer%arc%weights
        call correct_point(tracer, tangent, top, error)
    end subroutine find_top

    !> Where other branches cross within a step, at which the load is stationary too.
    !> The equations are dependent there, and nearby as much less so as it is nearer. At the point itself nothing is found well
    subroutine find_crossing(tracer, point, tangent, step, crosses, top, error)
        type(tracer_type), intent(in) :: tracer
        !> As for find_top
        real(wp), intent(in) :: point(:), tangent(:), step
        logical, intent(out) :: crosses
        real(wp), intent(out) :: top(:)
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: beside(size(point), 2), directions(size(point), size(point)), independence(2), rate(2)
        real(wp) :: place, reach, most, first
        integer :: side

        crosses = .false.
        top(:) = point
        place = step/2
        reach = step/2
        first = 0.0_wp
        do while (reach > nearest_crossing)
            do side = 1, 2
                beside(:, side) = point + (place + (2*side - 3)*reach)*tangent*tracer%arc%weights
                call correct_point(tracer, tangent, beside(:, side), error)
                if (.not. allocated(error)) call decompose(tracer, beside(:, side), directions, independence(side), error)
                if (allocated(error)) return
                associate (last => directions(size(point), :))
                    rate(side) = merge(1, -1, dot_product(last, tangent) > 0.0_wp)*last(size(point))
                end associate
            end do
            most = maxval(independence)/reach
            if (.not. first > 0.0_wp) first = most
            crosses = most <= less_independent*first .and. rate(1)*rate(2) <= 0.0_wp
            if (.not. crosses) return
            place = place + reach*(rate(1) + rate(2))/(rate(1) - rate(2))
            reach = reach/10
            top(:) = (beside(:, 1) + beside(:, 2))/2
        end do
    end subroutine find_crossing

end module gapbeam_branch_points
