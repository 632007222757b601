!> How zones in which a beam lies on rigid ground go on from a solution: ends where the moment vanishes.
module gapbeam_rigid_zones
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: shortest_zone
    use gapbeam_band, only: hinge, restrained
    use gapbeam_zone_fields, only: fields_at_ends
    use gapbeam_ground, only: ground_type
    use gapbeam_rigid_contact, only: contact_type, layer_beyond, level_of, slope_of
    use gapbeam_rigid_state, only: rigid_type, hold_at, add, add_at_node, is_zone, load_at, straightened
    implicit none
    private
    public :: move_zone

contains

    !> A zone: its ends go where the moment vanishes, and it leaves what the load lifts
    subroutine move_zone(ground, rigid, contact, i)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        type(contact_type), intent(in) :: contact
        integer, intent(in) :: i
        type(contact_type) :: next
        real(wp) :: q(2), share, lifted

        next = contact
        if (is_pulled(ground, rigid, contact, i, next)) then
            call add(rigid, next)
            return
        end if
        associate (side => ground%layers(contact%layer)%side, length => ground%pieces(contact%piece)%length)
            if (contact%to < length) then
                next%to = contact%to + outward(ground, rigid, i, 2, side)
            else
                call leave_node(ground, rigid, contact, i, 2, next%to)
            end if
            if (contact%from > 0.0_wp) then
                next%from = contact%from - outward(ground, rigid, i, 1, side)
            else
                call leave_node(ground, rigid, contact, i, 1, next%from)
            end if
            q = side*load_at(ground, rigid, contact%piece, [next%from, next%to])
            if (all(q < 0.0_wp) .or. next%to - next%from <= min(shortest_zone*length, (contact%to - contact%from)/2)) then
                next%from = (contact%from + contact%to)/2
                next%to = next%from
            else if (any(q < 0.0_wp)) then
                ! It is lifted from there on
                share = q(1)/(q(1) - q(2))
                lifted = next%from + share*(next%to - next%from)
                if (q(2) < 0.0_wp) next%to = min(lifted, (contact%from + 3*contact%to)/4)
                if (q(1) < 0.0_wp) next%from = max(lifted, (3*contact%from + contact%to)/4)
            end if
        end associate
        call add(rigid, next)
    end subroutine move_zone

    !> Would the ground have to pull at one end of a zone that is short: then the beam touches at the other one
    function is_pulled(ground, rigid, contact, i, next) result(pulled)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        type(contact_type), intent(in) :: contact
        integer, intent(in) :: i
        type(contact_type), intent(inout) :: next
        logical :: pulled
        real(wp) :: push(2)

        pulled = .false.
        if (contact%from <= 0.0_wp .or. contact%to >= ground%pieces(contact%piece)%length) return
        associate (z => rigid%zones, side => ground%layers(contact%layer)%side)
            push = side*rigid%push([hold_at(rigid, i - 1, side), hold_at(rigid, i, side)])
            pulled = minval(push) < -rigid%noise%force .and. z%to(i) - z%from(i) &
                < min(z%to(i - 1) - z%from(i - 1), z%to(i + 1) - z%from(i + 1))/4
        end associate
        if (.not. pulled) return
        if (push(1) < push(2)) next%from = contact%to
        next%to = next%from
    end function is_pulled

    !> How far an end of a zone goes outwards: on its tangent the moment vanishes there
    function outward(ground, rigid, i, end, side) result(step)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        !> Stretch; 1 its left end, 2 its right end; side of the ground
        integer, intent(in) :: i, end, side
        real(wp) :: step, moment(2), change, rotation(2), shear(2), inside, outside, q
        integer :: beyond, far

        beyond = i + merge(-1, 1, end == 1)
        call fields_at_ends(rigid%grounded, rigid%factor, rigid%work, beyond, rotation, shear)
        associate (z => rigid%zones, answers => rigid%work%answers)
            inside = z%to(i) - z%from(i)
            outside = z%to(beyond) - z%from(beyond)
            moment = side*([answers(beyond - 1)%moment_right, answers(beyond)%moment_left] &
                           - straightened(ground, rigid, z%piece(beyond)))
            q = side*load_at(ground, rigid, z%piece(i), merge(z%from(i), z%to(i), end == 1))
        end associate
        change = side*merge(-shear(2), shear(1), end == 1)
        if (end == 1) moment = moment([2, 1])
        step = 0.0_wp
        if (abs(moment(1)) <= rigid%noise%moment) return
        step = merge(outside, -inside, moment(1) < 0.0_wp)/4
        if (change > rigid%noise%force) then
            step = -moment(1)/change
        else if (moment(1) > 0.0_wp .and. q > 0.0_wp) then
            step = max(step, -lifted_length(moment(1), -change, q, .false.))
        end if
        far = hold_at(rigid, merge(beyond - 1, beyond, end == 1), side)
        if (is_pressed(ground, rigid, far, beyond, end, side, moment, rotation(end))) then
            step = outside
        else if (step <= outside .or. outside >= inside/8) then
            step = max(-inside*3/4, min(outside*3/4, step))
        else
            ! A short rest is no free span any more
            step = outside
        end if
        rigid%way(merge(i - 1, i, end == 1)) = abs(step)
    end function outward

    !> Is a free stretch pressed into the ground all along: at the end of a zone, and at a zone or a place beyond it
    function is_pressed(ground, rigid, far, beyond, end, side, moment, turn) result(pressed)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        !> The hold there, 0: none; the stretch; as for outward; moments at the two ends, the near one first, and the rotation at
        !> the far one
        integer, intent(in) :: far, beyond, end, side
        real(wp), intent(in) :: moment(2), turn
        logical :: pressed
        integer :: piece, other, layer, own

        pressed = .false.
        if (far == 0 .or. moment(1) >= 0.0_wp .or. moment(2) > rigid%noise%moment) return
        piece = rigid%zones%piece(beyond)
        layer = rigid%holds(far)%layer
        if (rigid%holds(far)%follows) then
            pressed = moment(2) < -rigid%noise%moment
            ! At a hinge the zone beyond does not hold its slope
            own = findloc(rigid%zones%acts(:, beyond + merge(1, -1, end == 1)) > 0, .true., 1) + ground%first(piece) - 1
            if (pressed .or. rigid%grounded%beam%kind(rigid%holds(far)%border) /= hinge) return
            if (abs(level_of(ground, piece, own, merge(rigid%zones%from(beyond), rigid%zones%to(beyond), end == 1)) &
                    - rigid%holds(far)%level) > rigid%noise%deflection) return
            pressed = falls(slope_of(ground, piece, own))
            return
        end if
        if (.not. rigid%touching(far)) return
        pressed = falls(rigid%holds(far)%slope)
        if (.not. pressed .or. moment(2) >= -rigid%noise%moment) return
        ! Over a corner it may just hang down
        if (merge(rigid%zones%from(beyond) > 0.0_wp, rigid%zones%to(beyond) < ground%pieces(piece)%length, end == 1)) return
        other = piece + merge(-1, 1, end == 1)
        if (layer >= ground%first(piece) .and. layer < ground%first(piece + 1)) then
            pressed = layer_beyond(ground, piece, layer, other) > 0
        else
            pressed = layer_beyond(ground, other, layer, piece) > 0
        end if

    contains

        !> Does the beam go into the ground from its far end
        pure function falls(slope)
            !> Of the ground there
            real(wp), intent(in) :: slope
            logical :: falls

            falls = merge(1, -1, end == 1)*side*(turn - slope) > 0.0_wp
        end function falls

    end function is_pressed

    !> A zone that reaches a node leaves it, or goes on beyond it, where its moment is not that of the node, and leaves it where the
    !> ground would have to pull
    subroutine leave_node(ground, rigid, contact, i, end, at)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        type(contact_type), intent(in) :: contact
        !> As for outward
        integer, intent(in) :: i, end
        !> Distance of that end of the zone from the left end of the piece
        real(wp), intent(inout) :: at
        real(wp) :: moment, bent, couple, kink, pull, step, q
        logical :: goes_on, bends
        integer :: node, border, other, layer

        node = contact%piece + end - 2
        border = i + end - 2
        associate (beam => ground%beam, answer => rigid%work%answers(border), side => ground%layers(contact%layer)%side)
            couple = beam%couple(1, node) + rigid%factor*beam%couple(2, node)
            moment = merge(answer%moment_left + couple, answer%moment_right - couple, end == 1)
            goes_on = is_zone(rigid, i + merge(-1, 1, end == 1))
            other = contact%piece + merge(-1, 1, end == 1)
            kink = 0.0_wp
            if (other >= 1 .and. other <= size(ground%pieces)) kink = straightened(ground, rigid, other)
            if (goes_on) moment = kink + merge(couple, -couple, end == 1)
            if (beam%kind(node) == hinge) moment = 0.0_wp
            associate (held => straightened(ground, rigid, contact%piece))
                bent = side*(moment - held)
                bends = abs(bent) > rigid%noise%moment
                kink = kink - held
            end associate
            if (beam%kind(node) == restrained) bends = bends .and. beam%compliance(node) > 0.0_wp
            layer = layer_beyond(ground, contact%piece, contact%layer, other)
            ! Nor does it go on where the curvature is another one
            if (abs(kink) > rigid%noise%moment) layer = 0
            step = 0.0_wp
            if (bends .and. layer > 0 .and. .not. (goes_on .or. abs(couple) > 0.0_wp)) step = outward(ground, rigid, i, end, side)
            if (step > 0.0_wp) then
                associate (length => ground%pieces(other)%length)
                    call add(rigid, contact_type(other, layer, merge(length - step, 0.0_wp, end == 1), &
                                          merge(length, step, end == 1)))
                end associate
            else if (step < 0.0_wp) then
                at = at + merge(-step, step, end == 1)
            else
                pull = -side*rigid%push(hold_at(rigid, border, side))
                if (.not. (bends .or. pull > rigid%noise%force)) return
                step = (rigid%zones%to(i) - rigid%zones%from(i))/4
                q = side*load_at(ground, rigid, contact%piece, at)
                if (.not. bends) bent = 0.0_wp
                if (q > 0.0_wp .and. .not. (bends .and. goes_on)) step = min(step, lifted_length(bent, pull, q, goes_on))
                at = at + merge(step, -step, end == 1)
                if (bends .and. .not. goes_on) call add_at_node(ground, rigid, node, side)
            end if
        end associate
    end subroutine leave_node

    !> How far a bar is lifted by a force and a couple, or by a force from both sides of it, or bent away from the ground over an
    !> edge of that
    pure function lifted_length(bent, pull, q, to_both_sides) result(length)
        !> Moment, in the sense of one that bends it into the ground; force away from the ground; load towards the ground
        real(wp), intent(in) :: bent, pull, q
        logical, intent(in) :: to_both_sides
        real(wp) :: length

        if (to_both_sides) then
            length = 3*pull/(4*q)
        else if (bent < 0.0_wp) then
            length = 2*sqrt(-bent/q)
        else
            length = (pull + sqrt(pull**2 + 2*q*bent))/q
        end if
    end function lifted_length

end module gapbeam_rigid_zones
