!> Zones of contact, and of the pieces of the ground's laws, found by Newton's method.
!>
!> On given zones the beam is solved, with its one-sided supports by the search of gapbeam_contact_state; the places where its
!> deflection crosses the contact lines are the ends of the next zones. An end that is off by e leaves an unbalanced load of the
!> order e**2, so this is Newton's method for the whole problem, whose energy is convex: near the solution the ends converge
!> quadratically without any equation of their own (docs/method.md 4). Zones appear, vanish, merge and split by
!> themselves, since all crossings inside a stretch are isolated with certainty.
module gapbeam_zones
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_zone_rounds, most_polishing
    use gapbeam_tolerances, only: moving_noise, far_from_solution, largest_ratio, most_ahead, same_ends, unmoved_share
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_not_converged
    use gapbeam_foundation_stretch, only: softness_in
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_layers, only: has_curves
    use gapbeam_ground_laws, only: distance_to_breakpoint
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, place_stretches
    use gapbeam_zone_fields, only: fields_at_ends, take_fields, way_of_fields
    use gapbeam_find_zones, only: find_zones
    implicit none
    private
    public :: settle_zones, polish_zones

contains

    !> Change the zones until their ends stay where they are
    subroutine settle_zones(ground, factor, rule, tolerance, zones, closed, grounded, work, outcome, settled, moved, error)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports (gapbeam_search)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Share of the stretches beside them by which the ends may still move
        real(wp), intent(in) :: tolerance
        !> Start in, zones with their ends out
        type(zones_type), intent(inout) :: zones
        !> The same for the supports
        logical, intent(inout) :: closed(:)
        !> The beam on the zones solved last, and its solution
        type(grounded_type), intent(out) :: grounded
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        !> Are the zones right
        logical, intent(out) :: settled
        !> By which share of the stretches beside it an end moved last
        real(wp), intent(out) :: moved
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        type(zones_type) :: found, asked, last, last_asked, mark
        real(wp) :: before
        integer :: round, solves
        logical :: hurries

        settled = .false.
        hurries = .true.
        moved = huge(moved)
        solves = 0
        do round = 1, most_zone_rounds
            call solve_on_zones(ground, factor, rule, zones, solves, closed, grounded, work, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call find_zones(ground, grounded, zones, factor, work, found)
            call end_if_stopped(ground%beam%watch, error)
            if (allocated(error)) return
            before = moved
            moved = max(way_of_ends(zones, found), way_of_fields(ground, grounded, zones, found))
            asked = found
            ! Zones that are parted again were joined by going too far
            if (round > 2) hurries = hurries .and. size(found%piece) <= size(zones%piece)
            if (moved > far_from_solution .and. round > 1 .and. hurries) call go_farther(last, last_asked, zones, found)
            last = zones
            last_asked = asked
            zones = found
            settled = moved <= tolerance .or. (moved <= moving_noise .and. moved >= before/2)
            if (settled) return
            ! Zones that come back do so again and again. Compared with those of the last round that is a power of two (Brent 1980)
            if (round > 2 .and. moved > far_from_solution) then
                if (max(way_of_ends(mark, asked), way_of_fields(ground, grounded, mark, asked)) <= same_ends) return
            end if
            if (iand(round, round - 1) == 0) mark = asked
        end do
    end subroutine settle_zones

    !> The same where nothing but the last digits of the ends are wrong: each goes where a tangent says that the deflection crosses
    !> its line. What crosses where is not looked for again
    subroutine polish_zones(ground, factor, rule, tolerance, zones, closed, grounded, work, outcome, settled, error)
        !> As for settle_zones
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        real(wp), intent(in) :: tolerance
        type(zones_type), intent(inout) :: zones
        logical, intent(inout) :: closed(:)
        type(grounded_type), intent(out) :: grounded
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        logical, intent(out) :: settled
        type(error_type), allocatable, intent(out) :: error
        type(zones_type) :: found
        real(wp) :: moved
        logical :: others
        integer :: round, solves

        settled = .false.
        solves = 0
        do round = 1, most_polishing
            call solve_on_zones(ground, factor, rule, zones, solves, closed, grounded, work, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call move_ends(ground, grounded, zones, factor, work, found, others)
            ! Zones that no tangent leads to are for settle_zones
            if (others) return
            if (any(has_curves(ground%layers))) call take_fields(grounded, zones, factor, work, found%start)
            moved = max(way_of_ends(zones, found), way_of_fields(ground, grounded, zones, found))
            zones = found
            settled = moved <= tolerance
            if (settled) return
        end do
    end subroutine polish_zones

    !> Solve the beam on given zones
    subroutine solve_on_zones(ground, factor, rule, zones, solves, closed, grounded, work, outcome, error)
        !> As for settle_zones
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        type(zones_type), intent(in) :: zones
        !> Linear solves so far in and out; those of the workspace are all of them
        integer, intent(inout) :: solves
        logical, intent(inout) :: closed(:)
        type(grounded_type), intent(out) :: grounded
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error

        call place_stretches(ground, zones, factor, grounded)
        if (grounded%lost) then
            call fatal_error(error, gapbeam_not_converged, "the beam on ground whose law is a curve could not be settled: "// &
                             "look for loads near what the ground can bear, or far beyond it")
            return
        end if
        call new_workspace(grounded%beam, work)
        call set_loads(grounded%beam, factor, work)
        call find_contact_state(grounded%beam, factor, rule, closed, work, outcome, error)
        solves = solves + work%solves
        work%solves = solves
    end subroutine solve_on_zones

    !> Move every end along the tangent at it
    pure subroutine move_ends(ground, grounded, zones, factor, work, found, others)
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        type(zones_type), intent(out) :: found
        !> Is there an end that would have to go farther than the stretches beside it are long: there are other zones
        logical, intent(out) :: others
        real(wp) :: rotation(2), shear(2), soft(2), slope, away
        integer :: i, k, law

        found = zones
        others = .false.
        do i = 1, size(zones%piece) - 1
            if (zones%piece(i) /= zones%piece(i + 1)) cycle
            k = findloc(zones%acts(:, i) /= zones%acts(:, i + 1), .true., 1)
            if (k == 0) cycle  ! a step of ground that varies
            law = max(zones%acts(k, i), zones%acts(k, i + 1))
            associate (layer => ground%layers(ground%first(zones%piece(i)) + k - 1), at => zones%to(i), &
                       length => ground%pieces(zones%piece(i))%length, s => grounded%stretches(i))
                call fields_at_ends(grounded, factor, work, i, rotation, shear)
                soft(:) = softness_in(s, 1.0_wp)
                call distance_to_breakpoint(ground%laws, layer, law, work%answers(i)%deflection, rotation(2) + soft(2)*shear(2), &
                                            at, length, away, slope)
                if (.not. abs(away) < abs(slope)*min(s%length, grounded%stretches(i + 1)%length)) then
                    others = others .or. abs(away) > 0.0_wp
                    cycle
                end if
                found%to(i) = at - away/slope
                found%from(i + 1) = found%to(i)
            end associate
        end do
        ! Nor are there zones that end before they begin
        others = others .or. any(found%to <= found%from)
    end subroutine move_ends

    !> Far from the solution an end goes the same way by nearly the same length round after round, since what happens beyond
    !> 1/beta is not seen: then go farther at once. Where the end of a long heavy beam is lifted, moves that fall by a ratio r
    !> leave a way of about r/(4 - 4 r) times the last one
    pure subroutine go_farther(last, last_asked, zones, found)
        !> Zones of the last round, and those that its solution asked for
        type(zones_type), intent(in) :: last, last_asked, zones
        !> Those that the solution of this round asks for in, those of the next one out
        type(zones_type), intent(inout) :: found
        real(wp) :: place, came_to, came_from, now, ratio, farther(size(found%piece))
        integer :: i

        farther(:) = 0.0_wp
        do i = 1, size(found%piece) - 1
            if (found%piece(i) /= found%piece(i + 1)) cycle
            place = nearest_end(zones, found, i, found%to(i))
            came_to = nearest_end(last_asked, found, i, place)
            came_from = nearest_end(last, found, i, came_to)
            if (min(place, came_to, came_from) < 0.0_wp) cycle
            now = found%to(i) - place
            if (.not. now*(came_to - came_from) > 0.0_wp) cycle
            ratio = min(now/(came_to - came_from), largest_ratio)
            farther(i) = sign(min(abs(now)*ratio/(4 - 4*ratio), merge(found%to(i + 1) - found%from(i + 1), &
                                                                     found%to(i) - found%from(i), now > 0.0_wp)*most_ahead), now)
        end do
        do i = 1, size(found%piece) - 1
            if (found%piece(i) /= found%piece(i + 1)) cycle
            found%to(i) = found%to(i) + farther(i)
            found%from(i + 1) = found%to(i)
        end do
    end subroutine go_farther

    !> Where an end was in other zones: the nearest one between the same, -1 if there is none
    pure function nearest_end(zones, found, i, at) result(place)
        type(zones_type), intent(in) :: zones, found
        !> Number of the end of found, and near which place
        integer, intent(in) :: i
        real(wp), intent(in) :: at
        real(wp) :: place
        integer :: k

        place = -1.0_wp
        do k = 1, size(zones%piece) - 1
            if (zones%piece(k) /= found%piece(i) .or. zones%piece(k + 1) /= found%piece(i)) cycle
            if (any(zones%acts(:, k) /= found%acts(:, i)) .or. any(zones%acts(:, k + 1) /= found%acts(:, i + 1))) cycle
            if (place < 0.0_wp .or. abs(zones%to(k) - at) < abs(place - at)) place = zones%to(k)
        end do
    end function nearest_end

    !> How far the ends have moved, relative to the shorter of the stretches beside them; huge if the zones are others
    pure function way_of_ends(zones, found) result(way)
        type(zones_type), intent(in) :: zones, found
        real(wp) :: way, move, length
        integer :: i

        way = huge(way)
        if (size(zones%piece) /= size(found%piece)) return
        if (any(zones%piece /= found%piece) .or. any(zones%acts /= found%acts)) return
        way = 0.0_wp
        length = sum(found%to - found%from)
        do i = 1, size(found%piece) - 1
            if (found%piece(i) /= found%piece(i + 1)) cycle
            move = abs(zones%to(i) - found%to(i))
            if (move <= unmoved_share*length) cycle
            way = max(way, move/min(found%to(i) - found%from(i), found%to(i + 1) - found%from(i + 1)))
        end do
    end function way_of_ends

end module gapbeam_zones
