!> A piece of the path of a beam with smooth laws, on the laws themselves: what its states are computed from.
!>
!> What is near it is known from the polylines. The other supports stay on their pieces, so the beam is linear but for the smooth
!> laws: put springs in their place, and the deflections x there are u0 + factor u1 - F (r(x) - k x). These are solved together
!> with the place along the line between two known states (Newton, pseudo-arclength; Keller 1977), which has no trouble where
!> the load turns round. A limit point, an event or a load factor is then the root of one function of that place
!> (gapbeam_arc_states, gapbeam_arc_roots). Deflections, forces and factors are in the user's units.
module gapbeam_smooth_arc
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, failed, has_ended, gapbeam_solved, gapbeam_not_converged
    use gapbeam_laws, only: law_force, law_slope, law_scale
    use gapbeam_polyline, only: node_support_type
    use gapbeam_extended_precision, only: rule_extended
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, force_and_slope, deflections_at_curves, put_line
    implicit none
    private
    public :: arc_type, arc_state_type, known_type, new_arc, springs_at, solve_with_springs, forces_at, &
        tangent_matrix, or_one, lose, is_lost

    !> A state on the smooth laws
    type :: arc_state_type
        !> Place along the arc, 0 and 1 at the two states it leads through or by
        real(wp) :: at = 0.0_wp
        !> Deflections at the smooth laws and the load factor, their derivatives along the arc, shape (n + 1); slopes of the laws
        real(wp), allocatable :: point(:), rate(:), slope(:)
        !> With springs through the points of the laws instead of these
        type(state_type) :: state
    end type arc_state_type

    !> A place for one, to be moved
    type :: known_type
        type(arc_state_type), allocatable :: one
    end type known_type

    !> The path on n smooth laws along the line between two states
    type :: arc_type
        !> The beam, its scheme, and its laws with their polylines
        type(assembled_type), pointer :: assembled => null()
        logical, allocatable :: closed(:)
        type(node_support_type), allocatable :: laws(:)
        !> Supports of the model with smooth laws
        integer, allocatable :: numbers(:)
        !> Deflections and load factor of the two states, shape (n + 1, 2), and their sizes
        real(wp), allocatable :: ends(:, :), weights(:)
        !> Direction along which places are told, and how long it is between the two states
        real(wp), allocatable :: along(:)
        real(wp) :: length = 0.0_wp
        !> Stiffnesses of the springs; deflections due to a force at each law (a column each), and due to the live loads with these
        real(wp), allocatable :: springs(:), flexibility(:, :), under_load(:)
        !> States that have been found, the first `number` entries
        type(known_type), allocatable :: known(:)
        integer :: number = 0
    end type arc_type

contains

    !> The path is not where the polylines have it
    pure subroutine lose(error)
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_not_converged, "the path on the smooth laws is not where their polylines have it")
    end subroutine lose

    !> Has the path been lost, or are memory or time at an end
    pure function is_lost(error) result(it_is)
        type(error_type), allocatable, intent(in) :: error
        logical :: it_is

        it_is = allocated(error) .and. .not. has_ended(error)
    end function is_lost

    !> The path along the line between two states
    subroutine new_arc(assembled, closed, laws, start, stop, arc, error, turn)
        !> With smooth laws
        type(assembled_type), intent(in), target :: assembled
        !> The scheme, and the laws of the supports as they have become
        logical, intent(in) :: closed(:)
        type(node_support_type), intent(in) :: laws(:)
        !> Deflections at the smooth laws and load factor of the two states, near the path or on it, shape (n + 1)
        real(wp), intent(in) :: start(:), stop(:)
        type(arc_type), intent(out) :: arc
        !> They are one and the same, or the beam cannot be solved there
        type(error_type), allocatable, intent(out) :: error
        !> Where between them the load turns round: places are told by the deflections alone then, in a way in which both parts of
        !> the arc go on
        real(wp), intent(in), optional :: turn(:)
        integer :: n, m, stat

        n = size(start) - 1
        m = size(laws)
        allocate (arc%closed(m), arc%laws(m), arc%numbers(n), arc%ends(n + 1, 2), arc%weights(n + 1), arc%along(n + 1), &
                  arc%springs(n), arc%flexibility(n, n), arc%under_load(n), arc%known(16), stat=stat)
        if (failed(stat, error)) return
        arc%assembled => assembled
        arc%closed(:) = closed
        arc%laws(:) = laws
        arc%numbers(:) = smooth_supports(assembled)
        arc%ends(:, 1) = start
        arc%ends(:, 2) = stop
        if (.not. all(abs(arc%ends) <= huge(1.0_wp))) then
            call lose(error)
            return
        end if
        arc%weights(:n) = or_one(maxval(abs(arc%ends(:n, :))))
        arc%weights(n + 1) = or_one(maxval(abs(arc%ends(n + 1, :))))
        arc%along(:) = (stop - start)/arc%weights
        if (present(turn)) then
            arc%along(:n) = relative(turn(:n) - start(:n)) + relative(stop(:n) - turn(:n))
            arc%along(n + 1) = 0.0_wp
        end if
        arc%length = dot_product(arc%along, (stop - start)/arc%weights)
        if (arc%length > 0.0_wp) then
            arc%springs(:) = springs_at(assembled, arc%numbers, sum(arc%ends(:n, :), 2)/2)
            if (all(arc%springs > 0.0_wp .and. arc%springs <= huge(1.0_wp))) then
                call find_responses(arc, error)
                return
            end if
        end if
        call lose(error)
    end subroutine new_arc

    !> A size, or 1 where there is none
    elemental function or_one(length) result(number)
        real(wp), intent(in) :: length
        real(wp) :: number

        number = merge(length, 1.0_wp, length > 0.0_wp)
    end function or_one

    !> A vector relative to its largest entry
    pure function relative(vector) result(found)
        real(wp), intent(in) :: vector(:)
        real(wp) :: found(size(vector))

        found = vector/or_one(maxval(abs(vector)))
    end function relative

    !> Stiffnesses about those of the laws at given deflections, none of them falling; 0 where there is none
    pure function springs_at(assembled, numbers, deflection) result(springs)
        type(assembled_type), intent(in) :: assembled
        !> Supports of the model with smooth laws, and deflections there
        integer, intent(in) :: numbers(:)
        real(wp), intent(in) :: deflection(:)
        real(wp) :: springs(size(numbers)), at(4), past, scale_of_law
        integer :: i, j, way

        springs(:) = 0.0_wp
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)))
                call past_the_gap(s, deflection(j), past, way)
                scale_of_law = law_scale(s%law, s%parameter)
                at = [past, past/2, scale_of_law, scale_of_law/2]
                do i = 1, size(at)
                    if (springs(j) > 0.0_wp .or. .not. at(i) > 0.0_wp) cycle
                    springs(j) = max(law_slope(s%law, s%parameter, at(i)), law_force(s%law, s%parameter, at(i))/at(i))
                end do
            end associate
        end do
    end function springs_at

    !> Solve with springs through given points
    subroutine solve_with_springs(arc, deflection, force, factor, state, error)
        type(arc_type), intent(in) :: arc
        !> At the smooth laws, forces up
        real(wp), intent(in) :: deflection(:), force(:), factor
        type(state_type), intent(out) :: state
        !> No such state
        type(error_type), allocatable, intent(out) :: error
        integer :: j

        call new_state(arc%assembled, state, error)
        if (allocated(error)) return
        state%closed(:) = arc%closed
        state%laws = arc%laws
        do j = 1, size(arc%numbers)
            call put_line(arc%assembled, arc%numbers(j), deflection(j), force(j), arc%springs(j), state%laws)
        end do
        call solve_state(arc%assembled, factor, rule_extended, state, error)
        if (.not. allocated(error) .and. state%status /= gapbeam_solved) call lose(error)
    end subroutine solve_with_springs

    !> Deflections due to a force at each law, and due to the live loads
    subroutine find_responses(arc, error)
        type(arc_type), intent(inout) :: arc
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: state
        real(wp), allocatable :: still(:), force(:), none(:)
        integer :: n, j

        n = size(arc%numbers)
        associate (x => arc%ends(:n, 1), factor => arc%ends(n + 1, 1), load => arc%weights(n + 1))
            allocate (none(n), force(n), still(n))
            none(:) = 0.0_wp
            call solve_with_springs(arc, x, none, factor, state, error)
            if (allocated(error)) return
            still(:) = deflections_at_curves(arc%assembled, state%deflection)
            call solve_with_springs(arc, x, none, factor + load, state, error)
            if (allocated(error)) return
            arc%under_load(:) = (deflections_at_curves(arc%assembled, state%deflection) - still)/load
            do j = 1, n
                force(:) = 0.0_wp
                force(j) = arc%springs(j)*max(abs(x(j)), arc%weights(1))
                call solve_with_springs(arc, x, force, factor, state, error)
                if (allocated(error)) return
                arc%flexibility(:, j) = (still - deflections_at_curves(arc%assembled, state%deflection))/force(j)
            end do
        end associate
    end subroutine find_responses

    !> Forces of the smooth laws at given deflections, up, slopes, and displacements past the gap
    pure subroutine forces_at(arc, deflection, force, slope, past)
        type(arc_type), intent(in) :: arc
        real(wp), intent(in) :: deflection(:)
        real(wp), intent(out) :: force(:), slope(:), past(:)
        integer :: j, way

        do j = 1, size(arc%numbers)
            associate (s => arc%assembled%model%supports(arc%numbers(j)))
                call past_the_gap(s, deflection(j), past(j), way)
                call force_and_slope(s, past(j), force(j), slope(j))
                force(j) = way*force(j)
            end associate
        end do
    end subroutine forces_at

    !> Derivatives of the equations by relative deflections and load factor, in relative deflections
    pure subroutine tangent_matrix(arc, slope, matrix)
        type(arc_type), intent(in) :: arc
        !> Slopes of the smooth laws, shape (n)
        real(wp), intent(in) :: slope(:)
        !> Shape (n, n + 1)
        real(wp), intent(out) :: matrix(:, :)
        integer :: n, j

        n = size(slope)
        do j = 1, n
            matrix(:, j) = arc%flexibility(:, j)*(slope(j) - arc%springs(j))
            matrix(j, j) = matrix(j, j) + 1
        end do
        matrix(:, n + 1) = -arc%under_load*arc%weights(n + 1)/arc%weights(1)
    end subroutine tangent_matrix

end module gapbeam_smooth_arc
