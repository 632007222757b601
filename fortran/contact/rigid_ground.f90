!> Zones and places in which a beam touches rigid ground, found by Newton's method.
!>
!> At the end of a zone the moment vanishes. On zones whose ends are off by e the beam is off by the order of e**2 or less, since
!> what it is held to there is what it comes to by itself: so each end goes where the moment would vanish, and they converge
!> quadratically without any equation of their own. Where the beam touches at a single place it is parallel to the ground, and a
!> spring there tells how far the place has to go (rigid_held, fix_slope). Where the beam goes through the ground it is stopped,
!> and what would have to pull lets go.
module gapbeam_rigid_ground
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_rigid_rounds
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_ground, only: ground_type
    use gapbeam_rigid_contact, only: contact_type, level_of, slope_of, place_at_node, binding_layer
    use gapbeam_rigid_held, only: solve_held
    use gapbeam_rigid_order, only: put_in_order
    use gapbeam_rigid_state, only: rigid_type, find_noise, is_zone, hold_at, add, straightened
    use gapbeam_rigid_zones, only: move_zone
    use gapbeam_taper, only: softness_at
    use gapbeam_foundation, only: stretch_ends_type
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_foundation_roots, only: find_peaks
    use gapbeam_zone_fields, only: ends_of, fields_at_ends
    use gapbeam_stretch_loads, only: combined_load
    implicit none
    private
    public :: settle_contacts

contains

    !> Move contacts until they stay where they are
    subroutine settle_contacts(ground, factor, rule, tolerance, rigid, closed, outcome, settled, error)
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports (gapbeam_search)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Share of the beam's length by which they may still move
        real(wp), intent(in) :: tolerance
        !> Contacts to begin with in; those found, and the solution on them, out
        type(rigid_type), intent(inout) :: rigid
        logical, intent(inout) :: closed(:)
        type(outcome_type), intent(out) :: outcome
        logical, intent(out) :: settled
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        integer :: round

        settled = .false.
        rigid%factor = factor
        do round = 1, most_rigid_rounds
            call solve_held(ground, factor, rule, rigid, closed, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call move_contacts(ground, rigid)
            call end_if_stopped(ground%beam%watch, error)
            if (allocated(error)) return
            settled = way_of(rigid%contacts, rigid%found) <= tolerance*sum(ground%pieces%length)
            if (settled) return
            call move_alloc(rigid%found, rigid%contacts)
        end do
    end subroutine settle_contacts

    !> How far contacts move, huge if they are others
    pure function way_of(contacts, found) result(way)
        type(contact_type), intent(in) :: contacts(:), found(:)
        real(wp) :: way

        way = huge(way)
        if (size(contacts) /= size(found)) return
        if (any(contacts%piece /= found%piece .or. contacts%layer /= found%layer .or. &
                (contacts%to > contacts%from .neqv. found%to > found%from))) return
        way = maxval([0.0_wp, abs(contacts%from - found%from), abs(contacts%to - found%to)])
        ! A place that is new has not been moved
        if (any(contacts%compliance < 0.0_wp .and. found%compliance >= 0.0_wp)) way = huge(way)
        ! A zone that shrinks away goes on
        if (any(found%to > found%from .and. max(abs(contacts%from - found%from), abs(contacts%to - found%to)) &
                > (found%to - found%from)/64)) way = huge(way)
    end function way_of

    !> The contacts that a solution asks for
    subroutine move_contacts(ground, rigid)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        integer :: c, i, most

        most = 4*size(rigid%contacts) + 4*size(rigid%zones%piece)*max(1, size(rigid%zones%acts, 1))
        if (allocated(rigid%found)) deallocate (rigid%found)
        if (allocated(rigid%way)) deallocate (rigid%way)
        allocate (rigid%found(most), rigid%way(0:size(rigid%zones%piece)))
        rigid%number = 0
        rigid%way(:) = 0.0_wp
        call find_noise(ground, rigid)
        do c = 1, size(rigid%contacts)
            if (rigid%contacts(c)%to > rigid%contacts(c)%from) then
                call move_zone(ground, rigid, rigid%contacts(c), rigid%place(c))
            else
                call move_place(ground, rigid, rigid%contacts(c), rigid%place(c))
            end if
        end do
        do i = 1, size(rigid%zones%piece)
            if (.not. is_zone(rigid, i)) call stop_beam(ground, rigid, i)
        end do
        call put_in_order(rigid%found, rigid%number)
    end subroutine move_contacts

    !> A single place: it lets go, or goes where the beam is parallel to the ground, or becomes a zone where the beam is bent into
    !> the ground on both sides
    subroutine move_place(ground, rigid, contact, border)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        type(contact_type), intent(in) :: contact
        integer, intent(in) :: border
        real(wp) :: rotation(2), shear(4), soft(2), moment, push, step
        type(contact_type) :: next
        integer :: h

        associate (z => rigid%zones, side => ground%layers(contact%layer)%side, answer => rigid%work%answers(border))
            h = hold_at(rigid, border, side)
            ! At the end of a zone that has it
            if (rigid%holds(h)%follows .or. .not. rigid%touching(h)) return
            next = contact
            if (contact%from > 0.0_wp .and. contact%from < ground%pieces(contact%piece)%length) then
                moment = side*((answer%moment_left + answer%moment_right)/2 - straightened(ground, rigid, contact%piece))
                push = side*rigid%push(h)
                associate (before => z%to(border) - z%from(border), after => z%to(border + 1) - z%from(border + 1))
                    if (moment < -rigid%noise%moment) then
                        ! As far as it is bent so
                        call fields_at_ends(rigid%grounded, rigid%factor, rigid%work, border, rotation, shear(1:2))
                        call fields_at_ends(rigid%grounded, rigid%factor, rigid%work, border + 1, rotation, shear(3:4))
                        next%from = contact%from - before/4
                        next%to = contact%to + after/4
                        if (side*shear(2) < 0.0_wp) next%from = max(next%from, contact%from - moment/(side*shear(2)))
                        if (side*shear(3) > 0.0_wp) next%to = min(next%to, contact%to - moment/(side*shear(3)))
                    else if (moment > rigid%noise%moment .and. push > rigid%noise%force) then
                        soft(:) = softness_at(ground%pieces(contact%piece), contact%from)
                        next%compliance = soft(1)*moment/push
                        step = 0.0_wp
                        if (contact%compliance >= 0.0_wp) step = side*(answer%moment_left - answer%moment_right)/push
                        step = max(-before*3/4, min(after*3/4, step))
                        rigid%way(border) = abs(step)
                        next%from = contact%from + step
                        next%to = next%from
                    end if
                end associate
            end if
            call add(rigid, next)
        end associate
    end subroutine move_place

    !> Where a free stretch goes through the ground it is stopped, at its deepest place
    subroutine stop_beam(ground, rigid, i)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        integer, intent(in) :: i
        real(wp), allocatable :: xi(:)
        type(stretch_ends_type) :: ends
        real(wp) :: deepest, depth, at, best, w, psi, moment, shear
        integer :: k, p

        associate (z => rigid%zones, j => rigid%zones%piece(i), s => rigid%grounded%stretches(i), &
                   load => combined_load(rigid%grounded%dead(i), rigid%grounded%live(i), rigid%factor))
            ends = ends_of(rigid%grounded, rigid%factor, rigid%work, i)
            do k = ground%first(j), ground%first(j + 1) - 1
                associate (side => ground%layers(k)%side)
                    if (z%from(i) <= 0.0_wp) call stop_at_node(ground, rigid, j - 1, i - 1, side)
                    if (z%to(i) >= ground%pieces(j)%length) call stop_at_node(ground, rigid, j, i, side)
                    call find_peaks(s, load, ends, [1], xi, slope_of(ground, j, k))
                    deepest = rigid%noise%deflection
                    best = -1.0_wp
                    do p = 1, size(xi)
                        at = xi(p)*s%length
                        if (at <= 3*rigid%way(i - 1) .or. s%length - at <= 3*rigid%way(i)) cycle
                        call fields_at(s, load, ends, xi(p), w, psi, moment, shear)
                        depth = side*(w - level_of(ground, j, k, z%from(i) + at))
                        if (depth <= deepest) cycle
                        deepest = depth
                        best = z%from(i) + at
                    end do
                    if (best > 0.0_wp .and. lies_between(ground, rigid, i, side)) then
                        call add(rigid, contact_type(j, k, z%from(i), z%to(i)))
                    else if (best > 0.0_wp) then
                        call add(rigid, contact_type(j, k, best, best))
                    end if
                end associate
            end do
        end associate
    end subroutine stop_beam

    !> Does the ground hold the beam at both ends of a stretch and press it there, as it does all along a zone
    function lies_between(ground, rigid, i, side) result(lies)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: i, side
        logical :: lies
        real(wp) :: moment(2)
        integer :: ends(2)

        ends = [hold_at(rigid, i - 1, side), hold_at(rigid, i, side)]
        lies = .false.
        if (any(ends == 0)) return
        moment = [rigid%work%answers(i - 1)%moment_right, rigid%work%answers(i)%moment_left] &
            - straightened(ground, rigid, rigid%zones%piece(i))
        lies = all(rigid%touching(ends)) .and. rigid%holds(ends(1))%layer == rigid%holds(ends(2))%layer .and. &
            maxval(side*moment) <= rigid%noise%moment
    end function lies_between

    !> Stop the beam at a node beyond the ground
    subroutine stop_at_node(ground, rigid, node, border, side)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        integer, intent(in) :: node, border, side

        if (hold_at(rigid, border, side) > 0) return
        associate (w => rigid%work%answers(border)%deflection, &
                   place => place_at_node(ground, node, binding_layer(ground, node, side)))
            if (side*(w - level_of(ground, place%piece, place%layer, place%from)) > rigid%noise%deflection) call add(rigid, place)
        end associate
    end subroutine stop_at_node

end module gapbeam_rigid_ground
