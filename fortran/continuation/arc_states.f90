!> States of the path on smooth laws, at places along an arc, and what tells whether they are stable and stand.
module gapbeam_arc_states
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: arc_settled, arc_rounding, arc_noise, dependent_branches, crossing_directions, &
        nearest_beside, farthest_beside
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_dense_solver, only: solve_least_squares, symmetric_eigenvalues, find_singular_values
    use gapbeam_certificate, only: certificate_type
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: certify_state
    use gapbeam_smooth_laws, only: deflections_at_curves
    use gapbeam_smooth_arc, only: arc_type, arc_state_type, known_type, solve_with_springs, forces_at, &
        tangent_matrix, lose, is_lost
    implicit none
    private
    public :: find_on_arc, look_at_direction, rate_beside, eigenvalues_at, wrongness_of, holds_at

    !> Corrections of a state at most; from the polyline five or so do
    integer, parameter :: most_corrections = 25

contains

    !> Find a state
    subroutine find_on_arc(arc, place, number, error)
        type(arc_type), intent(inout) :: arc
        !> Along the line between the two states, 0 and 1 at these
        real(wp), intent(in) :: place
        !> Entry of `known`
        integer, intent(out) :: number
        !> There is none near
        type(error_type), allocatable, intent(out) :: error
        type(arc_state_type), allocatable :: found
        real(wp), allocatable :: force(:), past(:), deflection(:), solved(:, :)
        real(wp) :: before, length, wrong, noise
        integer :: n, correction
        logical :: halved

        do number = 1, arc%number
            if (.not. abs(arc%known(number)%one%at - place) > 0.0_wp) return
        end do
        n = size(arc%numbers)
        allocate (found, force(n), past(n), deflection(n), solved(n + 1, 2))
        allocate (found%point(n + 1), found%rate(n + 1), found%slope(n))
        found%at = place
        call begin_near(arc, place, found%point)
        before = huge(before)
        halved = .false.
        do correction = 0, most_corrections - 1
            associate (x => found%point)
                call forces_at(arc, x(:n), force, found%slope, past)
                call solve_with_springs(arc, x(:n), force, x(n + 1), found%state, error)
                if (allocated(error)) return
                deflection(:) = deflections_at_curves(arc%assembled, found%state%deflection)
                call correct(arc, found, deflection, solved, wrong, error)
                if (allocated(error)) return
                found%rate(:) = solved(:, 2)*arc%weights
                length = maxval(abs(solved(:, 1)))
                noise = merge(arc_rounding, arc_noise, 2*correction < most_corrections - 1)
                if (wrong <= arc_noise .and. (length <= arc_settled .or. &
                                              (length <= noise .and. length >= before/2 .and. .not. halved))) then
                    call keep(found, arc, number, error)
                    return
                end if
                ! Where a law begins they may go to and fro for ever: then half as far
                halved = length >= before
                x(:) = x + solved(:, 1)*arc%weights/merge(2, 1, halved)
                before = length
            end associate
        end do
        call lose(error)
    end subroutine find_on_arc

    !> Where to begin: between or beside the states that are known
    pure subroutine begin_near(arc, place, point)
        type(arc_type), intent(in) :: arc
        real(wp), intent(in) :: place
        real(wp), intent(out) :: point(:)
        integer :: below, above, k

        below = 0
        above = 0
        do k = 1, arc%number
            associate (at => arc%known(k)%one%at)
                if (at < place) then
                    if (below > 0) then
                        if (at < arc%known(below)%one%at) cycle
                    end if
                    below = k
                else
                    if (above > 0) then
                        if (at > arc%known(above)%one%at) cycle
                    end if
                    above = k
                end if
            end associate
        end do
        if (.not. abs(place*(1 - place)) > 0.0_wp .or. max(below, above) == 0) then
            point(:) = arc%ends(:, 1) + place*(arc%ends(:, 2) - arc%ends(:, 1))
        else if (min(below, above) == 0) then
            associate (near => arc%known(max(below, above))%one)
                point(:) = near%point + (place - near%at)*near%rate
            end associate
        else
            associate (a => arc%known(below)%one, b => arc%known(above)%one)
                point(:) = a%point + (place - a%at)/(b%at - a%at)*(b%point - a%point)
            end associate
        end if
    end subroutine begin_near

    !> The next correction, and how fast deflections and factor change along the arc
    subroutine correct(arc, found, deflection, solved, wrong, error)
        type(arc_type), intent(in) :: arc
        !> With its point and slopes
        type(arc_state_type), intent(in) :: found
        !> That the springs through the point give
        real(wp), intent(in) :: deflection(:)
        !> Correction and rate, relative to the sizes, shape (n + 1, 2); how far the equations are from being met
        real(wp), intent(out) :: solved(:, :), wrong
        !> No numbers, or none that solve them
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), columns(:, :)
        integer :: n
        logical :: regular

        n = size(deflection)
        solved(:, :) = 0.0_wp
        wrong = huge(wrong)
        regular = all(abs(found%slope) <= huge(wrong)) .and. all(abs(deflection) <= huge(wrong))
        if (regular) then
            allocate (matrix(n + 1, n + 1), columns(n + 1, 2))
            call equations_at(arc, found%slope, matrix)
            columns(:, :) = 0.0_wp
            columns(:n, 1) = (deflection - found%point(:n))/arc%weights(1)
            columns(n + 1, 1) = found%at*arc%length - dot_product(arc%along, (found%point - arc%ends(:, 1))/arc%weights)
            columns(n + 1, 2) = arc%length
            wrong = maxval(abs(columns(:, 1)))
            regular = all(abs(matrix) <= huge(wrong)) .and. all(abs(columns) <= huge(wrong))
            ! Where the path branches the way to the other branch is left out
            if (regular) call solve_least_squares(matrix, columns, dependent_branches, solved, regular)
        end if
        if (.not. regular) call lose(error)
    end subroutine correct

    !> Derivatives of the equations, the place along the arc being the last one, by relative deflections and load factor
    pure subroutine equations_at(arc, slope, matrix)
        type(arc_type), intent(in) :: arc
        !> Slopes of the smooth laws, shape (n)
        real(wp), intent(in) :: slope(:)
        !> Shape (n + 1, n + 1)
        real(wp), intent(out) :: matrix(:, :)

        call tangent_matrix(arc, slope, matrix(:size(slope), :))
        matrix(size(slope) + 1, :) = arc%along
    end subroutine equations_at

    !> Is the direction of the path told in a state, or are the equations dependent there since other branches cross
    subroutine look_at_direction(arc, number, told, error)
        type(arc_type), intent(in) :: arc
        !> Of a state of the arc
        integer, intent(in) :: number
        logical, intent(out) :: told
        !> No numbers
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: matrix(:, :), values(:), directions(:, :)
        integer :: n

        n = size(arc%numbers) + 1
        allocate (matrix(n, n), values(n), directions(n, n))
        call equations_at(arc, arc%known(number)%one%slope, matrix)
        call find_singular_values(matrix, values, directions, told)
        if (.not. told) call lose(error)
        told = told .and. values(n) > crossing_directions*values(1)
    end subroutine look_at_direction

    !> Keep a state
    pure subroutine keep(found, arc, number, error)
        !> Moved away
        type(arc_state_type), allocatable, intent(inout) :: found
        type(arc_type), intent(inout) :: arc
        !> Where it is
        integer, intent(out) :: number
        type(error_type), allocatable, intent(out) :: error
        type(known_type), allocatable :: longer(:)
        integer :: k, stat

        if (arc%number == size(arc%known)) then
            allocate (longer(2*arc%number), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                number = 0
                return
            end if
            do k = 1, arc%number
                call move_alloc(arc%known(k)%one, longer(k)%one)
            end do
            call move_alloc(longer, arc%known)
        end if
        arc%number = arc%number + 1
        number = arc%number
        call move_alloc(found, arc%known(number)%one)
    end subroutine keep

    !> How fast the load factor changes on one side of a place, where the law of a support may begin or end
    subroutine rate_beside(arc, place, way, rate, error)
        type(arc_type), intent(inout) :: arc
        real(wp), intent(in) :: place
        !> On which side: -1 before, 1 beyond
        integer, intent(in) :: way
        real(wp), intent(out) :: rate
        !> There is no state near
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: beside
        integer :: number

        rate = 0.0_wp
        beside = nearest_beside
        do
            call find_on_arc(arc, place + way*beside, number, error)
            if (.not. is_lost(error) .or. beside >= farthest_beside) exit
            beside = min(100*beside, farthest_beside)
        end do
        if (.not. allocated(error)) rate = arc%known(number)%one%rate(size(arc%numbers) + 1)
    end subroutine rate_beside

    !> Numbers of the signs of the eigenvalues of the tangent stiffness, in ascending order, one a law: those of
    !> 1 + F (slope - spring), made symmetric
    subroutine eigenvalues_at(arc, slope, values, error)
        type(arc_type), intent(in) :: arc
        !> Slopes of the smooth laws, shape (n)
        real(wp), intent(in) :: slope(:)
        real(wp), intent(out) :: values(:)
        !> The other supports soften too
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: root(:, :), matrix(:, :)
        integer :: n, j
        logical :: solved

        n = size(slope)
        allocate (root(n, n), matrix(n, n))
        root(:, :) = (arc%flexibility + transpose(arc%flexibility))/2
        values(:) = 0.0_wp
        solved = all(abs(root) <= huge(1.0_wp)) .and. all(abs(slope) <= huge(1.0_wp))
        if (solved) call symmetric_eigenvalues(root, values, solved)
        if (solved) solved = .not. minval(values) < -arc_noise*maxval(values)
        if (solved) then
            do j = 1, n
                root(:, j) = root(:, j)*sqrt(max(values(j), 0.0_wp))
            end do
            do j = 1, n
                matrix(:, j) = matmul((slope - arc%springs)*root(:, j), root)
                matrix(j, j) = matrix(j, j) + 1
            end do
            call symmetric_eigenvalues(matrix, values, solved)
        end if
        if (.not. solved) call lose(error)
    end subroutine eigenvalues_at

    !> How far a support is beyond the piece on which it is taken to be, relative to the largest reaction or deflection
    subroutine wrongness_of(arc, state, wrongness, error)
        type(arc_type), intent(in) :: arc
        !> Of the arc
        type(state_type), intent(in) :: state
        real(wp), intent(out) :: wrongness
        type(error_type), allocatable, intent(out) :: error
        type(certificate_type) :: certificate

        call certify_state(arc%assembled, state, certificate, error)
        wrongness = certificate%complementarity
    end subroutine wrongness_of

    !> Are all other supports on their pieces
    subroutine holds_at(arc, point, tolerance, holds, error)
        type(arc_type), intent(in) :: arc
        !> Deflections at the smooth laws, and the load factor
        real(wp), intent(in) :: point(:)
        !> Share of the largest reaction or deflection that is nothing
        real(wp), intent(in) :: tolerance
        logical, intent(out) :: holds
        !> No such state
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: state
        real(wp), allocatable :: force(:), slope(:), past(:)
        real(wp) :: wrongness
        integer :: n

        n = size(arc%numbers)
        allocate (force(n), slope(n), past(n))
        holds = .false.
        call forces_at(arc, point(:n), force, slope, past)
        call solve_with_springs(arc, point(:n), force, point(n + 1), state, error)
        if (.not. allocated(error)) call wrongness_of(arc, state, wrongness, error)
        if (.not. allocated(error)) holds = wrongness <= tolerance
    end subroutine holds_at

end module gapbeam_arc_states
