!> Responses of a linear region of the path, in which all pieces of all laws stay the same.
module gapbeam_region_responses
    use gapbeam_kinds, only: wp => qp
    use gapbeam_path_tolerances, only: near_breakpoint, no_rate
    use gapbeam_band_quad, only: band_ok, count_unstable_pivots
    use gapbeam_polyline_quad, only: piece_that_acts, vertical_pieces
    use gapbeam_law_margins_quad, only: is_watched_in, margin_rates
    use gapbeam_model_quad, only: beam_type, last_place
    use gapbeam_system_quad, only: solve_and_refine
    use gapbeam_pivoting_quad, only: count_unstable
    use gapbeam_affine_response_quad, only: lines_type, new_lines, response_type, response_of, value_at, width_at
    implicit none
    private
    public :: responses_type, outgoing_type, new_responses, solve_responses, renew_responses, find_falling, find_index
    public :: is_held_twice, are_one
    public :: rise, fall, turn, from_nowhere

    !> Directions of the load factor along a way
    integer, parameter :: rise = 1, fall = -1, turn = 0
    !> Instead of the direction in which the path came: no way leads back
    integer, parameter :: from_nowhere = 2

    !> A region: what all supports do over the load factor while their pieces stay the same
    type, extends(lines_type) :: responses_type
        type(response_type), allocatable :: response(:)
        !> How fast supports move themselves with the factor (while settlements grow with the dead loads), shape (size(supports))
        real(wp), allocatable :: settling(:)
        !> Greatest and least inverse of the lengths of the spans, and greatest couple at the end of a span by a unit turn of it
        real(wp) :: inverse(2), stiffest
        !> The scheme solved last; is there a unique solution
        logical, allocatable :: closed(:)
        logical :: regular = .false.
        !> Linear solves
        integer :: solves = 0
    end type responses_type

    !> A way on
    type :: outgoing_type
        logical, allocatable :: closed(:)
        !> rise, fall or turn
        integer :: direction = rise
        !> Number of ways in which the beam gives way by itself: stable if 0
        integer :: index = 0
        !> Breakpoints that do not move along it, shape (size(supports))
        logical, allocatable :: still(:)
        !> Where the beam turns: displacements of the nodes, shape (0:n)
        real(wp), allocatable :: motion(:)
    end type outgoing_type

contains

    !> Room for the lines of a beam
    subroutine new_responses(beam, responses)
        type(beam_type), intent(in) :: beam
        type(responses_type), intent(out) :: responses

        call new_lines(beam, responses%lines_type)
        allocate (responses%response(size(beam%supports)), responses%settling(size(beam%supports)))
        responses%settling(:) = 0.0_wp
        responses%inverse(:) = [maxval(beam%links%inverse), minval(beam%links%inverse)]
        responses%stiffest = max(0.0_wp, maxval(12*beam%links%inverse/beam%links%bending, beam%links%bending > 0.0_wp))
        allocate (responses%closed(size(beam%supports)), source=.false.)
    end subroutine new_responses

    !> Solve a region
    subroutine solve_responses(beam, closed, responses)
        !> The beam, whose supports may have changed since new_responses, and the scheme
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(responses_type), intent(inout) :: responses
        integer :: state, place

        call renew_rates(beam, responses)
        call solve_and_refine(beam, closed, responses%dead, state, place)
        if (state == band_ok) call solve_and_refine(responses%incremental, closed, responses%live, state, place)
        responses%solves = responses%solves + 2
        responses%closed(:) = closed
        responses%regular = state == band_ok
        if (responses%regular) call find_responses(beam, responses)
    end subroutine solve_responses

    !> The same where laws may have been written anew since, but for the same lines: solved if another scheme was solved last
    subroutine renew_responses(beam, closed, responses)
        !> As for solve_responses
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(responses_type), intent(inout) :: responses
        logical :: known

        known = responses%regular
        if (known) known = all(responses%closed .eqv. closed)
        if (known) then
            call renew_rates(beam, responses)
            call find_responses(beam, responses)
        else
            call solve_responses(beam, closed, responses)
        end if
    end subroutine renew_responses

    !> The laws for the rates: moved by the supports' own movement only
    pure subroutine renew_rates(beam, responses)
        type(beam_type), intent(in) :: beam
        type(responses_type), intent(inout) :: responses

        associate (s => responses%incremental%supports)
            s = beam%supports
            s%contact = responses%settling
            s%force = 0.0_wp
        end associate
    end subroutine renew_rates

    !> Responses of all breakpoints in the scheme that is solved
    pure subroutine find_responses(beam, responses)
        type(beam_type), intent(in) :: beam
        type(responses_type), intent(inout) :: responses
        !> Greatest rates of what moves, of forces (or couples) that hold it, and of both at a support; slope of its piece
        real(wp) :: moves(2), holds(2), rate, slope, level
        integer :: k, kind
        logical :: by_force

        associate (live => responses%live, n => size(beam%links))
            moves(1) = maxval(abs(live%answers(0:n)%deflection))
            moves(2) = moves(1)*responses%inverse(1) + maxval(live%turn_size)
            holds(1) = responses%stiffest*moves(2)
            holds(2) = holds(1)/responses%inverse(2)
            do k = 1, size(responses%closed)
                associate (response => responses%response(k))
                    response = response_of(beam, responses%closed, k, responses%lines_type)
                    ! What statics leaves at rest has a rate of what refinement leaves there, and no size beside it tells that
                    kind = merge(2, 1, beam%supports(k)%node > n)
                    call margin_rates(beam%supports, responses%closed, k, slope, level, by_force)
                    rate = holds(kind)
                    if (slope <= huge(slope)) rate = slope*moves(kind)
                    if (abs(response%v1) <= no_rate*rate) response%error_of_v1 = max(response%error_of_v1, no_rate*rate)
                end associate
            end do
        end associate
    end subroutine find_responses

    !> Which breakpoints that are at zero fall along the line of a region
    subroutine find_falling(beam, closed, factor, direction, at_hand, responses, falling)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: direction
        logical, intent(in) :: at_hand(:)
        type(responses_type), intent(in) :: responses
        logical, intent(out) :: falling(:)
        integer :: k

        do k = 1, size(closed)
            falling(k) = .false.
            if (.not. is_watched_in(beam%supports, closed, k)) cycle
            associate (response => responses%response(k))
                falling(k) = direction*response%v1 < -response%error_of_v1
                ! What is at hand is at zero, whatever this region has made of it by rounding
                if (.not. at_hand(k)) then
                    falling(k) = falling(k) .and. value_at(response, factor) <= near_breakpoint*width_at(response, factor)
                end if
            end associate
        end do
    end subroutine find_falling

    !> Are two ways one and the same: their regions differ by breakpoints only that do not move
    pure function are_one(way, other) result(one)
        type(outgoing_type), intent(in) :: way, other
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
        do i = 0, last_place(beam)
            associate (first => beam%first(i), last => beam%first(i + 1) - 1)
                if (last > first) twice = vertical_pieces(beam%supports, closed, beam%order(first:last)) > 1
            end associate
            if (twice) return
        end do
    end function is_held_twice

    !> In how many ways the beam gives way by itself in a region
    subroutine find_index(beam, closed, responses, index)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        !> Solved
        type(responses_type), intent(in) :: responses
        integer, intent(out) :: index
        real(wp) :: slope
        integer :: k
        logical :: acts

        index = 0
        associate (nodes => responses%dead%nodes(0:size(beam%links)))
            if (.not. any(responses%dead%nodes%stiffness < 0.0_wp)) then
                continue
            else if (allocated(beam%ground)) then
                index = count_unstable_pivots(nodes, responses%dead%pivots)
            else
                call count_unstable(nodes, beam%links, index)
            end if
        end associate
        do k = 1, size(closed)
            if (beam%supports(k)%breakpoint == 0) cycle
            call piece_that_acts(beam%supports, closed, k, acts, slope)
            ! A vertical drop holds its node, so it is none of the system's stiffnesses
            if (acts .and. slope < -huge(slope)) index = index + 1
        end do
    end subroutine find_index

end module gapbeam_region_responses
