!> A cell of the path: all pieces of all laws stay the same, and the solution is a line over the load factor
module gapbeam_lines
    use gapbeam_kinds, only: wp => qp
    use gapbeam_band_quad, only: band_ok
    use gapbeam_polyline_quad, only: piece_that_acts, vertical_pieces
    use gapbeam_law_margins_quad, only: is_watched_in
    use gapbeam_model_quad, only: beam_type
    use gapbeam_workspace_quad, only: workspace_type, new_workspace, set_loads
    use gapbeam_system_quad, only: solve_and_refine
    use gapbeam_pivoting_quad, only: count_unstable
    use gapbeam_line_quad, only: line_type, line_of, without_dead_loads, value_at, width_at
    implicit none
    private
    public :: lines_type, way_type, new_lines, solve_lines, find_falling, find_index, is_held_twice, are_one
    public :: rise, fall, turn, from_nowhere

    !> Directions of the load factor along a way
    integer, parameter :: rise = 1, fall = -1, turn = 0
    !> Instead of the direction in which the path came: no way leads back
    integer, parameter :: from_nowhere = 2
    !> Rounding errors within which another breakpoint is at zero too
    real(wp), parameter :: near = 2.0_wp**10
    !> Share of the rates beside it below which a rate is none
    real(wp), parameter :: no_rate = 2.0_wp**(-70)

    !> A cell: what all supports do over the load factor while their pieces stay the same
    type :: lines_type
        type(beam_type) :: incremental
        type(workspace_type) :: dead, live
        type(line_type), allocatable :: line(:)
        !> How fast supports move themselves with the factor (while settlements grow with the dead loads), shape (size(supports))
        real(wp), allocatable :: settling(:)
        !> The scheme solved last; is there a unique solution
        logical, allocatable :: closed(:)
        logical :: regular = .false.
        !> Linear solves
        integer :: solves = 0
    end type lines_type

    !> A way on
    type :: way_type
        logical, allocatable :: closed(:)
        !> rise, fall or turn
        integer :: direction = rise
        !> Number of ways in which the beam gives way by itself: stable if 0
        integer :: index = 0
        !> Breakpoints that do not move along it, shape (size(supports))
        logical, allocatable :: still(:)
        !> Where the beam turns: displacements of the nodes, shape (0:n)
        real(wp), allocatable :: motion(:)
    end type way_type

contains

    !> Room for the lines of a beam
    subroutine new_lines(beam, lines)
        type(beam_type), intent(in) :: beam
        type(lines_type), intent(out) :: lines

        call without_dead_loads(beam, lines%incremental)
        call new_workspace(beam, lines%dead)
        call new_workspace(lines%incremental, lines%live)
        call set_loads(beam, 0.0_wp, lines%dead)
        call set_loads(lines%incremental, 1.0_wp, lines%live)
        allocate (lines%line(size(beam%supports)), lines%settling(size(beam%supports)))
        lines%settling(:) = 0.0_wp
        allocate (lines%closed(size(beam%supports)))
        lines%closed(:) = .false.
    end subroutine new_lines

    !> Solve a cell
    subroutine solve_lines(beam, closed, lines)
        !> The beam, whose supports may have changed since new_lines, and the scheme
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(lines_type), intent(inout) :: lines
        integer :: state, place, k

        associate (s => lines%incremental%supports)
            s = beam%supports
            s%contact = lines%settling
            s%force = 0.0_wp
        end associate
        call solve_and_refine(beam, closed, lines%dead, state, place)
        if (state == band_ok) call solve_and_refine(lines%incremental, closed, lines%live, state, place)
        lines%solves = lines%solves + 2
        lines%closed(:) = closed
        lines%regular = state == band_ok
        if (.not. lines%regular) return
        do k = 1, size(closed)
            lines%line(k) = line_of(beam, lines%incremental, closed, k, lines%dead, lines%live)
        end do
    end subroutine solve_lines

    !> Which breakpoints that are at zero fall along the line of a cell
    subroutine find_falling(beam, closed, factor, direction, at_hand, lines, falling)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: direction
        logical, intent(in) :: at_hand(:)
        type(lines_type), intent(in) :: lines
        logical, intent(out) :: falling(:)
        integer :: k

        do k = 1, size(closed)
            falling(k) = .false.
            if (.not. is_watched_in(beam%supports, closed, k)) cycle
            associate (line => lines%line(k))
                falling(k) = direction*line%v1 < -max(line%error_of_v1, no_rate*abs(line%v1))
                ! What is at hand is at zero, whatever this cell has made of it by rounding
                if (.not. at_hand(k)) falling(k) = falling(k) .and. value_at(line, factor) <= near*width_at(line, factor)
            end associate
        end do
    end subroutine find_falling

    !> Are two ways one and the same: their cells differ by breakpoints only that do not move
    pure function are_one(way, other) result(one)
        type(way_type), intent(in) :: way, other
        logical :: one

        one = way%direction == other%direction .and. allocated(way%still) .and. allocated(other%still)
        if (one) one = all((way%closed .eqv. other%closed) .or. (way%still .and. other%still))
    end function are_one

    !> Do vertical pieces of two supports hold some node, so that statics cannot tell what each of them takes
    pure function is_held_twice(beam, closed) result(twice)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        logical :: twice
        integer :: i

        twice = .false.
        do i = 0, size(beam%links)
            associate (first => beam%first(i), last => beam%first(i + 1) - 1)
                if (last > first) twice = vertical_pieces(beam%supports, closed, beam%order(first:last)) > 1
            end associate
            if (twice) return
        end do
    end function is_held_twice

    !> In how many ways the beam gives way by itself in a cell
    subroutine find_index(beam, closed, lines, index)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Solved
        type(lines_type), intent(in) :: lines
        integer, intent(out) :: index
        real(wp) :: slope
        integer :: k
        logical :: acts

        index = 0
        if (any(lines%dead%nodes%stiffness < 0.0_wp)) call count_unstable(lines%dead%nodes, beam%links, index)
        do k = 1, size(closed)
            if (beam%supports(k)%breakpoint == 0) cycle
            call piece_that_acts(beam%supports, closed, k, acts, slope)
            ! A vertical drop holds its node, so it is none of the system's stiffnesses
            if (acts .and. slope < -huge(slope)) index = index + 1
        end do
    end subroutine find_index

end module gapbeam_lines
