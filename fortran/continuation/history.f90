!> Load path through given factors, past limit points, with supports that soften, break or keep a set.
module gapbeam_history
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_idle_segments
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_not_converged, gapbeam_indeterminate, no_memory
    use gapbeam_words, only: shown
    use gapbeam_memory, only: for_following_closely
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: node_support_type
    use gapbeam_polyline_quad, only: fine_support_type => node_support_type
    use gapbeam_model_quad, only: beam_type
    use gapbeam_model, only: coarse_beam_type => beam_type
    use gapbeam_affine_response, only: drop_live_in_doubles => drop_live
    use gapbeam_affine_response_quad, only: drop_live
    use gapbeam_contact_state_quad, only: outcome_type
    use gapbeam_refined, only: refine_beam
    use gapbeam_extended_precision, only: reserve_for
    use gapbeam_region_responses, only: outgoing_type, rise, fall, turn
    use gapbeam_branch, only: branch_type, segment_type, start_branch, step_branch, laws_of, goes_on, no_way_on, &
        never_ends, not_told
    use gapbeam_scene, only: gapbeam_elastic
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_state, only: detail_of
    use gapbeam_history_start, only: find_beginning, find_movements, has_dead_loads, find_rest
    implicit none
    private
    public :: history_type, stretch_type, limit_type, other_way_type, follow_history, laws_at
    public :: at_limit_stop, at_limit_jump, at_limit_follow
    public :: no_limit, limit_point, bifurcation, mechanism, ended, cut_off

    !> What to do where the load cannot go on: end there; go on from the next stable state at the same factor; follow the path
    integer, parameter :: at_limit_stop = 0, at_limit_jump = 1, at_limit_follow = 2
    !> Kinds of limit. A path may also have ended without an end in sight: no further breakpoint, whatever the load; or after so
    !> many stretches
    integer, parameter :: no_limit = 0, limit_point = 1, bifurcation = 2, mechanism = 3, ended = 4, cut_off = 5

    !> A stretch of the path on which all pieces of all laws stay the same
    type :: stretch_type
        !> Number of the factor that is gone to, from 1; 0 while the dead loads are put on
        integer :: leg
        !> Load factors
        real(wp) :: from, to
        !> Does the load rise (1), fall (-1), or does the beam turn at constant load (0); in how many ways the beam gives way by
        !> itself; ways on there were at its beginning
        integer :: direction, index, ways
        !> Is it passed in a jump
        logical :: skipped
        !> The scheme, shape (size(supports))
        logical, allocatable :: closed(:)
        !> The laws as they have become, where they are not those of the beam
        type(node_support_type), allocatable :: laws(:)
    end type stretch_type

    !> Another way on from a tie
    type :: other_way_type
        !> The stretch that was taken instead
        integer :: stretch
        !> As in stretch_type
        integer :: direction, index
        logical, allocatable :: closed(:)
    end type other_way_type

    !> Where the load cannot go on
    type :: limit_type
        !> limit_point, bifurcation or mechanism
        integer :: kind
        !> As in stretch_type; last stretch before it
        integer :: leg
        real(wp) :: factor
        integer :: stretch
        !> Stretch on which the beam lands at the same factor; 0 if nowhere on its path
        integer :: landing = 0
    end type limit_type

    !> The loading history
    type :: history_type
        !> The stretches, the first `number` entries
        type(stretch_type), allocatable :: stretches(:)
        integer :: number = 0
        !> Where the load could not go on
        type(limit_type), allocatable :: limits(:)
        !> Ways that were not taken
        type(other_way_type), allocatable :: others(:)
        !> How it ended: no_limit at the last factor
        integer :: ending = no_limit
        !> How the beam moves where it ended in a mechanism, if that is a free motion of rigid parts, shape (0:n)
        real(wp), allocatable :: motion(:)
        !> Linear solves
        integer :: solves = 0
    end type history_type

contains

    !> Put on the dead loads, and with them settlements and lacks of fit, then go through load factors in turn
    subroutine follow_history(assembled, factors, at_limit, most, history, error)
        !> The beam
        type(assembled_type), intent(in), target :: assembled
        !> Load factors to go to
        real(wp), intent(in) :: factors(:)
        !> at_limit_stop, at_limit_jump or at_limit_follow
        integer, intent(in) :: at_limit
        !> Stretches after which it is cut off
        integer, intent(in) :: most
        type(history_type), intent(out) :: history
        !> As for follow_path
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: beam, dead
        type(coarse_beam_type) :: dead_in_doubles
        type(branch_type) :: branch
        type(fine_support_type), allocatable :: laws(:)
        logical, allocatable :: closed(:)
        integer, allocatable :: unloading(:)
        real(qp), allocatable :: settling(:)
        real(qp) :: factor
        integer :: leg
        !> Do laws change on the way
        logical :: keeps

        call reserve_for(for_following_closely, assembled%beam, detail_of(assembled), error)
        if (allocated(error)) return
        call refine_beam(assembled%beam, detail_of(assembled), beam)
        allocate (history%stretches(16), history%limits(0), history%others(0))
        allocate (unloading(size(beam%supports)), closed(size(beam%supports)))
        unloading(:) = assembled%model%supports(assembled%normal)%unloading
        keeps = any(unloading /= gapbeam_elastic)
        laws = beam%supports
        call find_rest(assembled, closed)
        allocate (settling(size(laws)))
        call find_movements(assembled, settling)
        if (has_dead_loads(beam) .or. any(abs(settling) > 0.0_qp)) then
            call drop_live(beam, dead)
            call drop_live_in_doubles(assembled%beam, dead_in_doubles)
            laws%contact = laws%contact - settling
            call go_leg(dead, dead_in_doubles, 0, 0.0_qp, 1.0_qp)
            call end_if_stopped(beam%watch, error)
            if (allocated(error) .or. history%ending /= no_limit) return
            laws%contact = laws%contact + settling
            settling(:) = 0.0_qp
        end if
        factor = 0.0_qp
        do leg = 1, size(factors)
            if (.not. abs(factors(leg) - factor) > 0.0_qp) cycle
            call go_leg(beam, assembled%beam, leg, factor, real(factors(leg), qp))
            call end_if_stopped(beam%watch, error)
            if (allocated(error)) return
            if (history%ending /= no_limit) exit
            factor = factors(leg)
        end do
        if (at_limit == at_limit_follow .or. size(history%limits) == 0) return
        if (is_jumping() .or. at_limit == at_limit_stop) then
            ! What lies beyond the last limit was only looked at
            do leg = history%limits(size(history%limits))%stretch + 1, history%number
                history%stretches(leg)%skipped = .true.
            end do
        end if

    contains

        !> Go from one load factor to another
        subroutine go_leg(beam, in_doubles, leg, from, to)
            type(beam_type), intent(inout) :: beam
            type(coarse_beam_type), intent(in) :: in_doubles
            integer, intent(in) :: leg
            real(qp), intent(in) :: from, to
            type(segment_type) :: segment
            type(outcome_type) :: beginning
            integer :: way, outcome, index, direction, taken, idle
            type(outgoing_type), allocatable :: ways(:)
            logical :: stable, moves, rounded_places
            real(qp) :: target
            logical :: acting(size(closed)), first(size(closed))
            integer :: first_direction
            type(node_support_type), allocatable :: laws_before(:)

            way = merge(rise, fall, to > from)
            beam%supports = laws
            rounded_places = branch%rounded_places
            if (history%number == 0) then
                call find_beginning(beam, to, closed, history%solves, beginning, error)
                if (allocated(error)) return
                if (beginning%status /= gapbeam_solved) then
                    history%limits = [limit_type(mechanism, 0, 0.0_wp, 0)]
                    if (allocated(beginning%motion)) history%motion = real(beginning%motion, wp)
                    history%ending = mechanism
                    return
                end if
            end if
            call start_branch(beam, in_doubles, unloading, settling, closed, from, way, branch, outcome, error)
            if (history%number == 0 .and. .not. allocated(error) .and. outcome == goes_on .and. branch%way%index > 0) then
                ! No force falls in a beam without load: the search has gone too far
                call find_rest(assembled, closed)
                call start_branch(beam, in_doubles, unloading, settling, closed, from, way, branch, outcome, error)
                if (.not. allocated(error) .and. outcome == goes_on .and. branch%way%index > 0) outcome = no_way_on
                if (.not. allocated(error) .and. outcome == no_way_on) then
                    call fatal_error(error, gapbeam_not_converged, "the beam moves freely before it carries any load, to "// &
                                     "supports whose forces may fall, and no stable state was found there: hold it, or give "// &
                                     "these supports no gap")
                end if
            end if
            branch%rounded_places = rounded_places
            ! On the polylines of smooth laws, equal ones soften all but together: which goes first is told by all digits only
            if (any(is_smooth(assembled%model%supports%law))) branch%local%usable = .false.
            call refuse_shared(outcome)
            if (.not. allocated(error) .and. outcome /= goes_on) call note_limit(mechanism, leg, real(from, wp))
            if (outcome /= goes_on) history%ending = mechanism
            allocate (ways(0))
            first(:) = branch%way%closed
            first_direction = branch%way%direction
            idle = 0
            do while (.not. allocated(error) .and. outcome == goes_on)
                if (history%number >= most) then
                    history%ending = cut_off
                    exit
                end if
                acting(:) = branch%way%closed
                index = branch%way%index
                direction = branch%way%direction
                ways = branch%outgoing
                taken = branch%taken
                if (keeps) laws_before = laws_of(branch, assembled%beam%supports)
                stable = index == 0 .and. direction /= -way
                ! Not at an end while it falls, but where it may have landed
                target = to
                if (is_jumping() .and. at_limit /= at_limit_follow) then
                    if (.not. (stable .and. direction == way .and. way*(branch%factor - to) <= 0.0_qp)) target = way*huge(to)
                end if
                call step_branch(branch, target, way, segment, outcome, error)
                call refuse_shared(outcome)
                if (allocated(error)) exit
                moves = direction == turn .or. abs(real(segment%to, wp) - real(segment%from, wp)) > 0.0_wp
                idle = merge(0, idle + 1, moves)
                if (idle > 4*size(closed) + most_idle_segments) then
                    call fatal_error(error, gapbeam_not_converged, "the path does not leave load factor "// &
                                     trim(shown(real(branch%factor, wp)))//", where rounding hides which support gives way "// &
                                     "first: bring the magnitudes of the beam nearer to each other")
                    exit
                end if
                if (outcome == never_ends) then
                    if (direction == turn) history%motion = real(branch%way%motion, wp)
                else if (moves) then
                    if (outcome == goes_on .and. all(unloading == gapbeam_elastic)) then
                        ! No cell is crossed twice, but a path without end may come round to where it began
                        if (branch%way%direction == first_direction .and. all(branch%way%closed .eqv. first)) history%ending = ended
                    end if
                    call add(leg, segment, direction, index, size(ways), acting, laws_before)
                    call add_others(ways, taken)
                    if (stable) call find_landings(way)
                end if
                if (outcome == goes_on) then
                    if (stable .and. (branch%way%index > 0 .or. branch%way%direction == -way)) then
                        call note_limit(merge(limit_point, bifurcation, branch%way%direction == -way .and. &
                                              size(branch%outgoing) == 1), leg, real(segment%to, wp))
                    end if
                else if (outcome == no_way_on .or. outcome == never_ends) then
                    history%ending = merge(ended, mechanism, outcome == never_ends .and. direction /= turn)
                    if (stable) call note_limit(mechanism, leg, real(segment%to, wp))
                end if
                if (at_limit == at_limit_stop .and. size(history%limits) > 0 .and. .not. is_jumping()) history%ending = ended
                if (history%ending /= no_limit) exit
            end do
            history%solves = history%solves + branch%responses%solves
            closed(:) = branch%way%closed
            laws = branch%beam%supports
        end subroutine go_leg

        !> Refuse to tell what statics cannot
        subroutine refuse_shared(outcome)
            integer, intent(in) :: outcome
            real(wp) :: x

            if (allocated(error) .or. outcome /= not_told) return
            x = point_x(assembled, assembled%support_point(assembled%normal(branch%shared(1))))
            call fatal_error(error, gapbeam_indeterminate, "two supports at x = "//trim(shown(x))//" have yielded to the same "// &
                             "deflection and unload rigidly from there at load factor "//trim(shown(real(branch%factor, wp)))// &
                             ", so statics cannot tell what each of them takes: give one of them a finite stiffness")
        end subroutine refuse_shared

        !> Keep a stretch
        subroutine add(leg, segment, direction, index, ways, acting, now)
            integer, intent(in) :: leg
            type(segment_type), intent(in) :: segment
            integer, intent(in) :: direction, index, ways
            logical, intent(in) :: acting(:)
            type(node_support_type), allocatable, intent(inout) :: now(:)
            type(stretch_type), allocatable :: longer(:)
            integer :: stat, i

            if (history%number == size(history%stretches)) then
                allocate (longer(2*history%number), stat=stat)
                if (stat /= 0) then
                    call no_memory(error)
                    return
                end if
                do i = 1, history%number
                    call hand_over(history%stretches(i), longer(i))
                end do
                call move_alloc(longer, history%stretches)
            end if
            history%number = history%number + 1
            associate (s => history%stretches(history%number))
                ! No negative zeros
                s = stretch_type(leg, real(segment%from, wp) + 0.0_wp, real(segment%to, wp) + 0.0_wp, direction, index, ways, &
                                 .false., acting)
                if (allocated(now)) call move_alloc(now, s%laws)
            end associate
        end subroutine add

        !> Keep the ways that the last stretch is not
        subroutine add_others(ways, taken)
            type(outgoing_type), intent(in) :: ways(:)
            integer, intent(in) :: taken
            integer :: w

            do w = 1, size(ways)
                if (w == taken) cycle
                associate (way => ways(w))
                    history%others = [history%others, other_way_type(history%number, way%direction, way%index, way%closed)]
                end associate
            end do
        end subroutine add_others

        !> Note a limit, but not while the beam falls from one to its landing
        subroutine note_limit(kind, leg, factor)
            integer, intent(in) :: kind, leg
            real(wp), intent(in) :: factor

            if (is_jumping() .and. at_limit /= at_limit_follow) return
            history%limits = [history%limits, limit_type(kind, leg, factor, history%number)]
        end subroutine note_limit

        !> Is there a limit from which the beam has not landed yet
        function is_jumping()
            logical :: is_jumping

            is_jumping = size(history%limits) > 0
            if (is_jumping) is_jumping = history%limits(size(history%limits))%landing == 0
        end function is_jumping

        !> From which limits the beam lands on the last stretch, which is stable and passes their load factors
        subroutine find_landings(way)
            integer, intent(in) :: way
            integer :: j, k

            associate (s => history%stretches(history%number))
                do j = 1, size(history%limits)
                    associate (limit => history%limits(j))
                        if (limit%landing > 0 .or. s%direction /= way .or. s%leg /= limit%leg) cycle
                        if (way*(s%to - limit%factor) < 0.0_wp) cycle
                        limit%landing = history%number
                        if (at_limit /= at_limit_jump) cycle
                        s%from = limit%factor
                        do k = limit%stretch + 1, history%number - 1
                            history%stretches(k)%skipped = .true.
                        end do
                    end associate
                end do
            end associate
        end subroutine find_landings

    end subroutine follow_history

    !> Put a stretch to another place, with what it has allocated
    pure subroutine hand_over(from, to)
        type(stretch_type), intent(inout) :: from, to

        call move_alloc(from%closed, to%closed)
        call move_alloc(from%laws, to%laws)
        to%leg = from%leg
        to%from = from%from
        to%to = from%to
        to%direction = from%direction
        to%index = from%index
        to%ways = from%ways
        to%skipped = from%skipped
    end subroutine hand_over

    !> The laws of a stretch
    pure function laws_at(assembled, stretch) result(laws)
        type(assembled_type), intent(in) :: assembled
        type(stretch_type), intent(in) :: stretch
        type(node_support_type), allocatable :: laws(:)

        laws = assembled%beam%supports
        if (allocated(stretch%laws)) laws = stretch%laws
    end function laws_at

end module gapbeam_history
