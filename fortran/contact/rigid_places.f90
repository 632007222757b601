!> How single places at which a beam touches rigid ground go on from a solution, and where it is stopped besides.
module gapbeam_rigid_places
    use gapbeam_kinds, only: wp
    use gapbeam_taper, only: softness_at
    use gapbeam_foundation, only: stretch_ends_type
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_foundation_roots, only: find_peaks
    use gapbeam_zone_fields, only: ends_of, fields_at_ends
    use gapbeam_ground, only: ground_type
    use gapbeam_stretch_loads, only: combined_load
    use gapbeam_rigid_contact, only: contact_type, level_of, slope_of, place_at_node, binding_layer
    use gapbeam_rigid_state, only: rigid_type, hold_at, add, straightened
    implicit none
    private
    public :: move_place, stop_beam

contains

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

end module gapbeam_rigid_places
