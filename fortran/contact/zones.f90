!> Where the ground acts: the zones of contact, and of the pieces of its laws, found by Newton's method.
!>
!> On given zones the beam is solved, with its one-sided supports by the search of gapbeam_scheme; the places where its
!> deflection crosses the contact lines are the ends of the next zones. An end that is off by e leaves an unbalanced load of the
!> order e**2, so this is Newton's method for the whole problem, whose energy is convex: near the solution the ends converge
!> quadratically without any equation of their own (docs/method.md, section 12). Zones appear, vanish, merge and split by
!> themselves, since all crossings inside a stretch are isolated with certainty.
module gapbeam_zones
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_foundation, only: stretch_ends_type, stretch_load_type, fields_at
    use gapbeam_foundation_roots, only: find_crossings
    use gapbeam_layers, only: pieces_of_law
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, new_zones, resize, place_stretches, steps_of_piece, &
        between, line_of_kink, piece_of_deflection, combined_load
    implicit none
    private
    public :: settle_zones, polish_zones, find_zones, ends_of, fields_at_ends

    !> Rounds at most, few in quadruple precision; where ends only touch they converge by halves
    integer, parameter :: most_rounds = merge(200, 40, digits(1.0_wp) < 64), most_polishing = 12
    !> Ends that are moved by rounding alone move by less than this share of the stretches beside them
    real(wp), parameter :: noise = epsilon(1.0_wp)**0.375_wp
    !> An end that moves by more is far from the solution. It goes farther if it moved by at least so large a share of the move
    !> before, as if it were this one at most
    real(wp), parameter :: far = 0.01_wp, least_ratio = 0.3_wp, largest_ratio = 0.7_wp
    !> What moves by less than this share of the beam does not move: so short zones have no force, and behind a part of the beam
    !> that next to no ground holds no end is known better
    real(wp), parameter :: unseen = sqrt(epsilon(1.0_wp))
    !> Places nearer to each other than so many roundings of the length of their piece are one
    real(wp), parameter :: one_place = 16*epsilon(1.0_wp)

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
        !> As for find_scheme
        type(error_type), allocatable, intent(out) :: error
        type(zones_type) :: found, last
        real(wp) :: before
        integer :: round, solves

        settled = .false.
        moved = huge(moved)
        solves = 0
        do round = 1, most_rounds
            call solve_on_zones(ground, factor, rule, zones, solves, closed, grounded, work, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call find_zones(ground, grounded, zones, factor, work, found)
            before = moved
            moved = way_of_ends(zones, found)
            if (moved > far) call go_farther(last, zones, found)
            last = zones
            zones = found
            settled = moved <= tolerance .or. (moved <= noise .and. moved >= before/2)
            if (settled) return
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
        integer :: round, solves

        settled = .false.
        solves = 0
        do round = 1, most_polishing
            call solve_on_zones(ground, factor, rule, zones, solves, closed, grounded, work, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call move_ends(ground, grounded, zones, factor, work, found)
            moved = way_of_ends(zones, found)
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

        call place_stretches(ground, zones, grounded)
        call new_workspace(grounded%beam, work)
        call set_loads(grounded%beam, factor, work)
        call find_scheme(grounded%beam, factor, rule, closed, work, outcome, error)
        solves = solves + work%solves
        work%solves = solves
    end subroutine solve_on_zones

    !> Move every end along the tangent at it
    pure subroutine move_ends(ground, grounded, zones, factor, work, found)
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        type(zones_type), intent(out) :: found
        real(wp) :: rotation(2), shear(2), slope, before, beyond, away
        integer :: i, k, law

        found = zones
        do i = 1, size(zones%piece) - 1
            if (zones%piece(i) /= zones%piece(i + 1)) cycle
            k = findloc(zones%acts(:, i) /= zones%acts(:, i + 1), .true., 1)
            if (k == 0) cycle  ! a step of ground that varies
            law = max(zones%acts(k, i), zones%acts(k, i + 1))
            associate (layer => ground%layers(ground%first(zones%piece(i)) + k - 1), at => zones%to(i), &
                       length => ground%pieces(zones%piece(i))%length, s => grounded%stretches(i))
                before = line_of_kink(ground, layer, law, 0.0_wp, length)
                beyond = line_of_kink(ground, layer, law, length, length)
                away = work%answers(i)%deflection - line_of_kink(ground, layer, law, at, length)
                call fields_at_ends(grounded, factor, work, i, rotation, shear)
                slope = rotation(2) + s%shear_flexibility*shear(2) - (beyond - before)/length
                if (.not. abs(away) < abs(slope)*min(s%length, grounded%stretches(i + 1)%length)) cycle
                found%to(i) = at - away/slope
                found%from(i + 1) = found%to(i)
            end associate
        end do
    end subroutine move_ends

    !> Rotations and shears at the two ends of a stretch of a solved beam
    pure subroutine fields_at_ends(grounded, factor, work, i, rotation, shear)
        type(grounded_type), intent(in) :: grounded
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Number of the stretch
        integer, intent(in) :: i
        real(wp), intent(out) :: rotation(2), shear(2)

        associate (a => work%answers(i - 1), b => work%answers(i), g => grounded%beam%ground(i), link => grounded%beam%links(i))
            rotation(1) = -g%pa*a%deflection + g%p1*b%deflection + g%faa*a%moment_right + g%fab*b%moment_left &
                + (link%turn_a(1) + factor*link%turn_a(2))
            rotation(2) = g%pb*b%deflection - g%p2*a%deflection - g%fab*a%moment_right - g%fbb*b%moment_left &
                - (link%turn_b(1) + factor*link%turn_b(2))
            shear(1) = -g%pa*a%moment_right + g%p2*b%moment_left - g%gaa*a%deflection - g%gab*b%deflection &
                + (link%shear_a(1) + factor*link%shear_a(2))
            shear(2) = g%pb*b%moment_left - g%p1*a%moment_right + g%gbb*b%deflection + g%gab*a%deflection &
                + (link%shear_b(1) + factor*link%shear_b(2))
        end associate
    end subroutine fields_at_ends

    !> Far from the solution an end goes the same way by nearly the same length round after round, since what happens beyond
    !> 1/beta is not seen: then go farther at once (Aitken's extrapolation, with a limit)
    pure subroutine go_farther(last, zones, found)
        !> Zones of the last two rounds
        type(zones_type), intent(in) :: last, zones
        !> Those of the next one
        type(zones_type), intent(inout) :: found
        real(wp) :: before, now, ratio, farther
        integer :: i

        if (.not. allocated(last%piece)) return
        if (.not. (way_of_ends(last, zones) < huge(1.0_wp) .and. way_of_ends(zones, found) < huge(1.0_wp))) return
        do i = 1, size(found%piece) - 1
            if (found%piece(i) /= found%piece(i + 1)) cycle
            before = zones%to(i) - last%to(i)
            now = found%to(i) - zones%to(i)
            if (.not. (before*now > 0.0_wp .and. abs(now) > least_ratio*abs(before))) cycle
            ratio = min(now/before, largest_ratio)
            farther = now*ratio/(1 - ratio)
            farther = sign(min(abs(farther), merge(found%to(i + 1) - found%from(i + 1), found%to(i) - found%from(i), &
                                                   now > 0.0_wp)/2), now)
            found%to(i) = found%to(i) + farther
            found%from(i + 1) = found%to(i)
        end do
    end subroutine go_farther

    !> The zones that a solution asks for
    subroutine find_zones(ground, grounded, zones, factor, work, found)
        type(ground_type), intent(in) :: ground
        !> The beam on its zones, solved in work at a load factor
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> The zones with which to go on
        type(zones_type), intent(out) :: found
        real(wp), allocatable :: cuts(:)
        type(zones_type) :: next
        integer :: j, first, last, m, number, room

        room = 4*size(zones%piece)
        call new_zones(room, size(zones%acts, 1), next)
        m = 0
        last = 0
        do j = 1, size(ground%pieces)
            first = last + 1
            last = grounded%node(j)
            call cut_piece(j)
            if (m + number > room) then
                room = 2*(m + number)
                call resize(next, room, m)
            end if
            call judge_piece(j)
        end do
        call resize(next, m, m)
        found = next

    contains

        !> All places of a piece at which something may change: where it changed before, and where the deflection crosses the
        !> line at which a layer begins or goes on to another piece of its law
        subroutine cut_piece(piece)
            integer, intent(in) :: piece
            real(wp), allocatable :: xi(:)
            real(wp) :: length
            integer :: i, k, law, crossings

            length = ground%pieces(piece)%length
            if (allocated(cuts)) deallocate (cuts)
            allocate (cuts(last - first + 1))
            cuts(:) = zones%to(first:last)
            do k = ground%first(piece), ground%first(piece + 1) - 1
                associate (layer => ground%layers(k))
                    if (layer%side == 0) cycle
                    do i = first, last
                        associate (from => zones%from(i), to => zones%to(i))
                            do law = 1, pieces_of_law(layer)
                                call find_crossings(grounded%stretches(i), load_of(i), ends_of(work, i), &
                                                    line_of_kink(ground, layer, law, from, length), &
                                                    line_of_kink(ground, layer, law, to, length), xi, crossings)
                                if (crossings > 0) cuts = [cuts, from + xi(:crossings)*(to - from)]
                            end do
                        end associate
                    end do
                end associate
            end do
            call sort(cuts)
            number = 0
            do i = 1, size(cuts)
                if (number > 0) then
                    if (cuts(i) - cuts(number) <= one_place*length) then
                        if (i == size(cuts)) cuts(number) = cuts(i)
                        cycle
                    end if
                else if (cuts(i) <= one_place*length) then
                    cycle
                end if
                number = number + 1
                cuts(number) = cuts(i)
            end do
            cuts(number) = length
        end subroutine cut_piece

        !> What acts between the places, neighbours with the same joined
        subroutine judge_piece(piece)
            integer, intent(in) :: piece
            integer :: acts(size(zones%acts, 1))
            real(wp) :: from, middle
            integer :: i, k, c, step, steps
            logical :: joins

            steps = steps_of_piece(ground, piece)
            from = 0.0_wp
            i = first
            step = 1
            do c = 1, number
                middle = from + (cuts(c) - from)/2
                do while (i < last .and. zones%to(i) < middle)
                    i = i + 1
                end do
                acts(:) = 0
                do k = ground%first(piece), ground%first(piece + 1) - 1
                    acts(k - ground%first(piece) + 1) = piece_at(k, i, middle)
                end do
                joins = .false.
                if (from > 0.0_wp) joins = all(acts == next%acts(:, m))
                do while (step < steps)
                    ! Steps of ground that varies stay
                    if (from < between(0.0_wp, ground%pieces(piece)%length, step, steps)) exit
                    joins = .false.
                    step = step + 1
                end do
                if (joins) then
                    next%to(m) = cuts(c)
                else
                    m = m + 1
                    next%piece(m) = piece
                    next%from(m) = from
                    next%to(m) = cuts(c)
                    next%acts(:, m) = acts
                end if
                from = cuts(c)
            end do
        end subroutine judge_piece

        !> The piece of its law on which a layer is at a place
        pure function piece_at(k, i, distance) result(acts)
            !> Layer, stretch, and distance from the left end of the piece
            integer, intent(in) :: k, i
            real(wp), intent(in) :: distance
            integer :: acts, before, law
            real(wp) :: w, psi, moment, shear, length

            associate (layer => ground%layers(k))
                acts = 1
                if (layer%side == 0) return
                length = ground%pieces(zones%piece(i))%length
                call fields_at(grounded%stretches(i), load_of(i), ends_of(work, i), &
                               (distance - zones%from(i))/(zones%to(i) - zones%from(i)), w, psi, moment, shear)
                acts = piece_of_deflection(ground, layer, w, distance, length)
                before = zones%acts(k - ground%first(zones%piece(i)) + 1, i)
                if (before <= acts) return
                ! A beam that lies on it without any load stays as it is
                do law = before, acts + 1, -1
                    if (abs(w - line_of_kink(ground, layer, law, distance, length)) > 0.0_wp) cycle
                    acts = law
                    return
                end do
            end associate
        end function piece_at

        !> Load of a stretch at the factor
        pure function load_of(i) result(load)
            integer, intent(in) :: i
            type(stretch_load_type) :: load

            load = combined_load(grounded%dead(i), grounded%live(i), factor)
        end function load_of

    end subroutine find_zones

    !> Values at the ends of a stretch of a solved beam
    pure function ends_of(work, i) result(ends)
        type(workspace_type), intent(in) :: work
        !> Number of the stretch
        integer, intent(in) :: i
        type(stretch_ends_type) :: ends

        associate (a => work%answers(i - 1), b => work%answers(i))
            ends = stretch_ends_type(a%deflection, b%deflection, a%moment_right, b%moment_left)
        end associate
    end function ends_of

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
            if (move <= unseen*length) cycle
            way = max(way, move/min(found%to(i) - found%from(i), found%to(i + 1) - found%from(i + 1)))
        end do
    end function way_of_ends

    !> Sort a few numbers that are nearly in order
    pure subroutine sort(values)
        real(wp), intent(inout) :: values(:)
        real(wp) :: value
        integer :: i, j

        do i = 2, size(values)
            value = values(i)
            do j = i - 1, 1, -1
                if (values(j) <= value) exit
                values(j + 1) = values(j)
            end do
            values(j + 1) = value
        end do
    end subroutine sort

end module gapbeam_zones
