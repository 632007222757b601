!> Load path through given factors, past limit points, with supports that soften, break or keep a set.
module gapbeam_history
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_idle_segments
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_not_converged, gapbeam_indeterminate
    use gapbeam_words, only: shown
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: node_support_type
    use gapbeam_polyline_quad, only: fine_support_type => node_support_type
    use gapbeam_model_quad, only: beam_type
    use gapbeam_model, only: coarse_beam_type => beam_type
    use gapbeam_history_beam, only: make_history_beam
    use gapbeam_affine_response, only: drop_live_in_doubles => drop_live
    use gapbeam_affine_response_quad, only: drop_live
    use gapbeam_contact_state_quad, only: outcome_type
    use gapbeam_region_responses, only: outgoing_type, rise, fall, turn
    use gapbeam_branch, only: branch_type, segment_type, start_branch, step_branch, laws_of, goes_on, no_way_on, &
        never_ends, not_told
    use gapbeam_scene, only: gapbeam_elastic
    use gapbeam_assembled_model, only: assembled_type, growth_of, point_x
    use gapbeam_history_start, only: find_beginning, find_movements, has_dead_loads, has_dead_along, find_rest
    use gapbeam_history_stretch, only: stretch_type, pieces_type, keep_pieces, enter_stretch
    use gapbeam_stretch, only: take_reactions
    use gapbeam_friction_limits, only: go_by_reactions
    use gapbeam_history_record, only: history_type, limit_type, new_history, add_stretch, add_others, note_limit, note_landings, &
        is_jumping, at_limit_stop, at_limit_jump, at_limit_follow, no_limit, limit_point, bifurcation, mechanism, ended, cut_off
    implicit none
    private
    public :: follow_history
    ! Of gapbeam_history_record
    public :: history_type, at_limit_stop, at_limit_jump, no_limit, ended, cut_off

    !> A path on its way
    type :: walk_type
        !> The beam, how its supports unload, and whether laws change on the way
        type(assembled_type), pointer :: assembled => null()
        !> Node of its system for every node of the beam, shape (0:n); not allocated where these are the same
        integer, allocatable :: node(:)
        integer, allocatable :: unloading(:)
        logical :: keeps = .false.
        !> Are reactions told for friction
        logical :: tells = .false.
        !> Stretches after which it is cut off
        integer :: most = 0
        !> Scheme and laws as they have become; how fast supports move themselves with the factor, shape (size(supports))
        logical, allocatable :: closed(:)
        type(fine_support_type), allocatable :: laws(:)
        real(qp), allocatable :: settling(:)
        type(branch_type) :: branch
        !> Leg at hand: its number from 1, or 0 while the dead loads are put on; rise or fall; the factor at its end
        integer :: leg = 0, way = rise
        real(qp) :: to = 0.0_qp
        !> Scheme and direction with which it began, and stretches since the factor has changed
        logical, allocatable :: first(:)
        integer :: first_direction = rise, idle = 0
        !> Pieces on the last stretch
        type(pieces_type) :: last
    end type walk_type

contains

    !> Put on the dead loads, and with them settlements and lacks of fit, then go through load factors in turn
    subroutine follow_history(assembled, factors, at_limit, most, history, error)
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
        type(walk_type) :: walk
        real(qp) :: factor
        integer :: leg

        call make_history_beam(assembled, beam, walk%node, error)
        if (allocated(error)) return
        call new_history(at_limit, history)
        call new_walk(assembled, beam%supports, most, walk)
        if (has_dead_loads(beam) .or. any(abs(walk%settling) > 0.0_qp) .or. has_dead_along(assembled)) then
            call drop_live(beam, dead)
            call drop_live_in_doubles(assembled%beam, dead_in_doubles)
            walk%laws%contact = walk%laws%contact - walk%settling
            call go_leg(walk, dead, dead_in_doubles, 0, 0.0_qp, 1.0_qp, history, error)
            call end_if_stopped(beam%watch, error)
            if (allocated(error) .or. history%ending /= no_limit) return
            walk%laws%contact = walk%laws%contact + walk%settling
        end if
        walk%settling(:) = growth_of(assembled)
        factor = 0.0_qp
        do leg = 1, size(factors)
            if (.not. abs(factors(leg) - factor) > 0.0_qp) cycle
            call go_leg(walk, beam, assembled%beam, leg, factor, real(factors(leg), qp), history, error)
            call end_if_stopped(beam%watch, error)
            if (allocated(error)) return
            if (history%ending /= no_limit) exit
            factor = factors(leg)
        end do
        if (at_limit == at_limit_follow .or. size(history%limits) == 0) return
        if (is_jumping(history) .or. at_limit == at_limit_stop) then
            ! What lies beyond the last limit was only looked at
            do leg = history%limits(size(history%limits))%stretch + 1, history%number
                history%stretches(leg)%skipped = .true.
            end do
        end if
    end subroutine follow_history

    !> A beam at rest
    subroutine new_walk(assembled, laws, most, walk)
        type(assembled_type), intent(in), target :: assembled
        !> Of its supports
        type(fine_support_type), intent(in) :: laws(:)
        integer, intent(in) :: most
        !> With the nodes of its system
        type(walk_type), intent(inout) :: walk

        walk%assembled => assembled
        walk%most = most
        walk%laws = laws
        associate (m => size(laws))
            allocate (walk%unloading(m), walk%closed(m), walk%settling(m))
        end associate
        walk%unloading(:) = assembled%model%supports(assembled%normal)%unloading
        walk%keeps = any(walk%unloading /= gapbeam_elastic)
        walk%tells = go_by_reactions(assembled)
        call find_rest(assembled, walk%closed)
        call find_movements(assembled, walk%settling)
    end subroutine new_walk

    !> Go from one load factor to another
    subroutine go_leg(walk, beam, in_doubles, leg, from, to, history, error)
        type(walk_type), intent(inout) :: walk
        !> The beam with the loads of the leg, and the same in double precision
        type(beam_type), intent(inout) :: beam
        type(coarse_beam_type), intent(in) :: in_doubles
        !> As in walk_type
        integer, intent(in) :: leg
        real(qp), intent(in) :: from, to
        type(history_type), intent(inout) :: history
        type(error_type), allocatable, intent(out) :: error
        type(outcome_type) :: beginning
        integer :: outcome

        walk%leg = leg
        walk%way = merge(rise, fall, to > from)
        walk%to = to
        beam%supports = walk%laws
        if (history%number == 0) then
            call find_beginning(beam, in_doubles, to, walk%closed, history%solves, beginning, error)
            if (allocated(error)) return
            if (beginning%status /= gapbeam_solved) then
                history%limits = [limit_type(mechanism, 0, 0.0_wp, 0)]
                if (allocated(beginning%motion)) history%motion = motion_of_nodes(walk, beginning%motion)
                history%ending = mechanism
                return
            end if
        end if
        call begin_leg(walk, beam, in_doubles, from, history, outcome, error)
        do while (.not. allocated(error) .and. outcome == goes_on)
            if (history%number >= walk%most) then
                history%ending = cut_off
                exit
            end if
            call pass_stretch(walk, history, outcome, error)
            if (allocated(error) .or. history%ending /= no_limit) exit
        end do
        history%solves = history%solves + walk%branch%responses%solves
        walk%closed(:) = walk%branch%way%closed
        walk%laws = walk%branch%beam%supports
    end subroutine go_leg

    !> Find the first way of a leg
    subroutine begin_leg(walk, beam, in_doubles, from, history, outcome, error)
        !> As for go_leg
        type(walk_type), intent(inout) :: walk
        type(beam_type), intent(in) :: beam
        type(coarse_beam_type), intent(in) :: in_doubles
        real(qp), intent(in) :: from
        type(history_type), intent(inout) :: history
        !> By start_branch
        integer, intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        logical :: rounded_places

        rounded_places = walk%branch%rounded_places
        call start_branch(beam, in_doubles, walk%unloading, walk%settling, walk%closed, from, walk%way, walk%branch, outcome, error)
        if (history%number == 0 .and. .not. allocated(error) .and. outcome == goes_on .and. walk%branch%way%index > 0) then
            ! No force falls in a beam without load: the search has gone too far
            call find_rest(walk%assembled, walk%closed)
            call start_branch(beam, in_doubles, walk%unloading, walk%settling, walk%closed, from, walk%way, walk%branch, outcome, &
                              error)
            if (.not. allocated(error) .and. outcome == goes_on .and. walk%branch%way%index > 0) outcome = no_way_on
            if (.not. allocated(error) .and. outcome == no_way_on) then
                call fatal_error(error, gapbeam_not_converged, "the beam moves freely before it carries any load, to "// &
                                 "supports whose forces may fall, and no stable state was found there: hold it, or give "// &
                                 "these supports no gap")
            end if
        end if
        if (.not. allocated(error) .and. outcome == no_way_on .and. history%number == 0) then
            call fatal_error(error, gapbeam_not_converged, "before it carries any load a part of the beam can move freely "// &
                             "without work of the loads, so the path of supports that yield or move cannot be followed: "// &
                             "hold that part, give its supports no gap or slack, or take steps where supports only move")
        end if
        walk%branch%rounded_places = rounded_places
        if (walk%tells) allocate (walk%branch%local%stretch%touched(2, 0))
        ! On the polylines of smooth laws, equal ones soften all but together: which goes first is told by all digits only
        if (walk%branch%local%may_fall .and. any(is_smooth(walk%assembled%model%supports%law))) walk%branch%local%usable = .false.
        if (allocated(walk%assembled%beam%turning)) walk%branch%local%usable = .false.
        call refuse_shared(walk, outcome, error)
        if (.not. allocated(error) .and. outcome /= goes_on) call note_limit(mechanism, walk%leg, real(from, wp), history)
        if (outcome /= goes_on) history%ending = mechanism
        walk%first = walk%branch%way%closed
        walk%first_direction = walk%branch%way%direction
        walk%idle = 0
    end subroutine begin_leg

    !> Go along a stretch, keep it, and note what its end is
    subroutine pass_stretch(walk, history, outcome, error)
        type(walk_type), intent(inout) :: walk
        type(history_type), intent(inout) :: history
        !> By step_branch
        integer, intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: stretch
        type(segment_type) :: segment
        type(outgoing_type), allocatable :: ways(:)
        logical :: stable, moves
        real(qp) :: target
        integer :: taken

        associate (branch => walk%branch, way => walk%way, direction => stretch%direction)
            if (size(branch%outgoing) > 1) allocate (ways, source=branch%outgoing)
            taken = branch%taken
            stretch = stretch_type(walk%leg, 0.0_wp, 0.0_wp, branch%way%direction, branch%way%index, size(branch%outgoing), .false.)
            call take_pieces(walk, stretch)
            stable = stretch%index == 0 .and. direction /= -way
            ! Not at an end while it falls, but where it may have landed
            target = walk%to
            if (is_jumping(history) .and. history%at_limit /= at_limit_follow) then
                if (.not. (stable .and. direction == way .and. way*(branch%factor - walk%to) <= 0.0_qp)) target = way*huge(target)
            end if
            call step_branch(branch, target, way, segment, outcome, error)
            call refuse_shared(walk, outcome, error)
            if (allocated(error)) return
            ! No negative zeros
            stretch%from = real(segment%from, wp) + 0.0_wp
            stretch%to = real(segment%to, wp) + 0.0_wp
            moves = direction == turn .or. abs(stretch%to - stretch%from) > 0.0_wp
            call take_reactions(branch%local%stretch, moves .and. outcome /= never_ends, stretch%pressed, stretch%reactions)
            walk%idle = merge(0, walk%idle + 1, moves)
            if (walk%idle > 4*size(walk%closed) + most_idle_segments) then
                call fatal_error(error, gapbeam_not_converged, "the path does not leave load factor "// &
                                 trim(shown(real(branch%factor, wp)))//", where rounding hides which support gives way first: "// &
                                 "bring the magnitudes of the beam nearer to each other")
                return
            end if
            if (outcome == never_ends) then
                if (direction == turn) history%motion = motion_of_nodes(walk, branch%way%motion)
            else if (moves) then
                if (outcome == goes_on .and. .not. walk%keeps) then
                    ! No cell is crossed twice, but a path without end may come round to where it began
                    if (branch%way%direction == walk%first_direction .and. all(branch%way%closed .eqv. walk%first)) then
                        history%ending = ended
                    end if
                end if
                call enter_stretch(stretch, walk%last)
                call add_stretch(stretch, history, error)
                if (allocated(error)) return
                if (allocated(ways)) call add_others(ways, taken, history)
                if (stable) call note_landings(way, history)
            end if
            if (outcome == goes_on) then
                if (stable .and. (branch%way%index > 0 .or. branch%way%direction == -way)) then
                    call note_limit(merge(limit_point, bifurcation, branch%way%direction == -way .and. &
                                          size(branch%outgoing) == 1), walk%leg, real(segment%to, wp), history)
                end if
            else if (outcome == no_way_on .or. outcome == never_ends) then
                history%ending = merge(ended, mechanism, outcome == never_ends .and. direction /= turn)
                if (stable) call note_limit(mechanism, walk%leg, real(segment%to, wp), history)
            end if
        end associate
        if (history%at_limit == at_limit_stop .and. size(history%limits) > 0 .and. .not. is_jumping(history)) history%ending = ended
    end subroutine pass_stretch

    !> How the nodes of the beam as it was given move
    pure function motion_of_nodes(walk, motion) result(moved)
        type(walk_type), intent(in) :: walk
        !> Of the nodes of its system, and rotations that supports hold, shape (0:)
        real(qp), intent(in) :: motion(0:)
        real(wp) :: moved(size(walk%assembled%beam%links) + 1)

        if (allocated(walk%node)) then
            moved(:) = real(motion(walk%node), wp)
        else
            moved(:) = real(motion(:size(moved) - 1), wp)
        end if
    end function motion_of_nodes

    !> Note the pieces of the supports on the stretch that begins
    subroutine take_pieces(walk, stretch)
        type(walk_type), intent(in) :: walk
        type(stretch_type), intent(inout) :: stretch
        integer, allocatable :: places(:)
        type(node_support_type), allocatable :: laws(:)
        integer :: k

        associate (branch => walk%branch)
            if (allocated(branch%touched) .and. allocated(walk%last%closed)) then
                allocate (places, source=branch%touched)
            else
                allocate (places, source=[(k, k=1, size(branch%way%closed))])
            end if
            if (walk%keeps) laws = laws_of(branch, walk%assembled%beam%supports, places)
            call keep_pieces(places, branch%way%closed(places), laws, walk%last, stretch)
        end associate
    end subroutine take_pieces

    !> Refuse to tell what statics cannot
    subroutine refuse_shared(walk, outcome, error)
        type(walk_type), intent(in) :: walk
        !> By start_branch or step_branch
        integer, intent(in) :: outcome
        type(error_type), allocatable, intent(inout) :: error
        real(wp) :: x

        if (allocated(error) .or. outcome /= not_told) return
        associate (assembled => walk%assembled, branch => walk%branch)
            x = point_x(assembled, assembled%support_point(assembled%normal(branch%shared(1))))
            call fatal_error(error, gapbeam_indeterminate, "two supports at x = "//trim(shown(x))//" have yielded to the same "// &
                             "deflection and unload rigidly from there at load factor "//trim(shown(real(branch%factor, wp)))// &
                             ", so statics cannot tell what each of them takes: give one of them a finite stiffness")
        end associate
    end subroutine refuse_shared

end module gapbeam_history
