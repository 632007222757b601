!> A beam on rigid ground where it is known where the two touch: in zones, in which it follows the ground, and at single places.
!>
!> In a zone the beam is straight and without moment, and the ground takes what load lies there; at its ends, at nodes in it and at
!> single places the ground pushes with point forces. So a zone parts the beam: beyond its ends deflection and slope are known.
module gapbeam_rigid_contact
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_level
    use gapbeam_ground_laws, only: contact_line
    use gapbeam_taper, only: steps_of_taper
    use gapbeam_ground_steps, only: border_of_step
    use gapbeam_ground, only: ground_type, zones_type, new_zones
    implicit none
    private
    public :: contact_type, hold_type, lay_out, level_of, slope_of, place_at_node, binding_layer, same_line, layer_beyond

    !> A place at which the beam touches a layer, or a zone
    type :: contact_type
        !> Piece of the beam; layer
        integer :: piece = 0, layer = 0
        !> Distances of its ends from the left end of the piece; the same for a single place
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> Of a single place inside a piece: rotation beside the ground over the couple that moving its push makes there, which is
        !> the curvature over the push (see solve_held); below 0: not known yet
        real(wp) :: compliance = -1.0_wp
    end type contact_type

    !> What holds the beam where stretches meet
    type :: hold_type
        !> Right end of which stretch, 0: left end of the beam; layer
        integer :: border = 0, layer = 0
        !> Side of that: it holds the beam one way, but both ways in a zone
        integer :: side = 0
        real(wp) :: level = 0.0_wp
        !> Is it in or at an end of a zone, where the slope is known too
        logical :: follows = .false.
        real(wp) :: slope = 0.0_wp
        !> That of the contact, 0 in a zone
        real(wp) :: compliance = 0.0_wp
    end type hold_type

contains

    !> Deflection of a layer at a distance from the left end of its piece
    pure function level_of(ground, piece, layer, at) result(level)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: piece, layer
        real(wp), intent(in) :: at
        real(wp) :: level

        level = contact_line(ground%layers(layer), at, ground%pieces(piece)%length)
    end function level_of

    !> Slope of a layer
    elemental function slope_of(ground, piece, layer) result(slope)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: piece, layer
        real(wp) :: slope

        associate (l => ground%layers(layer))
            slope = (l%contact_b - l%contact_a)/ground%pieces(piece)%length
        end associate
    end function slope_of

    !> Are two layers one line where their pieces meet, but for the rounding of what they were given by
    pure function same_line(ground, piece, layers) result(same)
        type(ground_type), intent(in) :: ground
        !> The piece left of the node, and the layer of that and of the next one
        integer, intent(in) :: piece, layers(2)
        logical :: same
        real(wp) :: rounding

        associate (a => ground%layers(layers(1)), b => ground%layers(layers(2)))
            rounding = same_level*max(abs(a%contact_a), abs(a%contact_b), abs(b%contact_a), abs(b%contact_b))
            same = a%side == b%side .and. abs(a%contact_b - b%contact_a) <= rounding .and. &
                abs(slope_of(ground, piece, layers(1)) - slope_of(ground, piece + 1, layers(2))) &
                *min(ground%pieces(piece)%length, ground%pieces(piece + 1)%length) <= 2*rounding
        end associate
    end function same_line

    !> The layer that goes on in the piece before or after, 0: none does
    pure function layer_beyond(ground, piece, layer, other) result(beyond)
        type(ground_type), intent(in) :: ground
        !> A piece and a layer of it, and the piece beside, which need not exist
        integer, intent(in) :: piece, layer, other
        integer :: beyond

        beyond = 0
        if (other < 1 .or. other > size(ground%pieces)) return
        do beyond = ground%first(other), ground%first(other + 1) - 1
            if (same_line(ground, min(piece, other), merge([layer, beyond], [beyond, layer], other > piece))) return
        end do
        beyond = 0
    end function layer_beyond

    !> The layer of a side that stops the beam first at a node, 0: there is none
    pure function binding_layer(ground, node, side) result(layer)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: node, side
        integer :: layer, piece, k
        real(wp) :: level, lowest

        layer = 0
        lowest = 0.0_wp
        do piece = max(node, 1), min(node + 1, size(ground%pieces))
            do k = ground%first(piece), ground%first(piece + 1) - 1
                if (ground%layers(k)%side /= side) cycle
                level = side*level_of(ground, piece, k, merge(ground%pieces(piece)%length, 0.0_wp, piece == node))
                if (layer > 0 .and. level >= lowest) cycle
                layer = k
                lowest = level
            end do
        end do
    end function binding_layer

    !> The single place where a layer ends at a node
    pure function place_at_node(ground, node, layer) result(place)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: node, layer
        type(contact_type) :: place
        integer :: piece
        real(wp) :: at

        piece = max(1, node)
        if (layer < ground%first(piece) .or. layer >= ground%first(piece + 1)) piece = piece + 1
        at = merge(ground%pieces(piece)%length, 0.0_wp, piece == node)
        place = contact_type(piece, layer, at, at)
    end function place_at_node

    !> Stretches between contacts, and what holds the beam at their ends
    subroutine lay_out(ground, contacts, zones, holds, place)
        type(ground_type), intent(in) :: ground
        !> From left to right, without any in zones of others
        type(contact_type), intent(in) :: contacts(:)
        type(zones_type), intent(out) :: zones
        type(hold_type), allocatable, intent(out) :: holds(:)
        !> Stretch of every zone, border of every single place, shape (size(contacts))
        integer, allocatable, intent(out) :: place(:)
        integer :: j, c, i, h, steps(size(ground%pieces))

        ! Series of what tapers hold over steps only
        steps(:) = [(steps_of_taper(ground%pieces(j)), j=1, size(steps))]
        call new_zones(2*size(contacts) + sum(steps), maxval(ground%first(2:) - ground%first(:size(steps))), steps, zones)
        allocate (holds(2*size(contacts)), place(size(contacts)))
        i = 0
        h = 0
        c = 1
        do j = 1, size(ground%pieces)
            associate (length => ground%pieces(j)%length)
                call open_stretch(0.0_wp)
                do while (c <= size(contacts))
                    associate (this => contacts(c))
                        if (this%piece /= j) exit
                        if (this%from > zones%from(i)) then
                            call end_stretch(this%from)
                            if (this%from < length) call open_stretch(this%from)
                        end if
                        if (this%to > this%from) then
                            zones%acts(this%layer - ground%first(j) + 1, i) = 1
                            place(c) = i
                            call hold(i - 1, this, this%from)
                            zones%to(i) = this%to
                            call hold(i, this, this%to)
                            if (this%to < length) call open_stretch(this%to)
                        else
                            place(c) = merge(i - 1, i, this%from < length)
                            call hold(place(c), this, this%from)
                        end if
                    end associate
                    c = c + 1
                end do
                call end_stretch(length)
            end associate
        end do
        zones%piece = zones%piece(:i)
        zones%from = zones%from(:i)
        zones%to = zones%to(:i)
        zones%acts = zones%acts(:, :i)
        zones%start = zones%start(:, :i)
        holds = holds(:h)

    contains

        !> The stretch at hand ends, and is cut where it is free
        subroutine end_stretch(to)
            real(wp), intent(in) :: to
            real(wp) :: border
            integer :: step

            do step = 1, steps(j) - 1
                if (any(zones%acts(:, i) > 0)) exit
                border = border_of_step(ground%pieces(j), step, steps(j))
                if (border > zones%from(i) .and. border < to) then
                    zones%to(i) = border
                    call open_stretch(border)
                end if
            end do
            zones%to(i) = to
        end subroutine end_stretch

        !> The next stretch begins
        subroutine open_stretch(from)
            real(wp), intent(in) :: from

            i = i + 1
            zones%piece(i) = j
            zones%from(i) = from
            zones%acts(:, i) = 0
        end subroutine open_stretch

        !> Hold the beam at an end of a contact, once where two meet
        subroutine hold(border, contact, at)
            !> Right end of which stretch, the contact, and the distance from the left end of the piece
            integer, intent(in) :: border
            type(contact_type), intent(in) :: contact
            real(wp), intent(in) :: at

            if (h > 0) then
                if (holds(h)%border == border .and. holds(h)%side == ground%layers(contact%layer)%side) return
            end if
            h = h + 1
            holds(h) = hold_type(border, contact%layer, ground%layers(contact%layer)%side, &
                                 level_of(ground, contact%piece, contact%layer, at), contact%to > contact%from, &
                                 slope_of(ground, contact%piece, contact%layer))
            if (.not. holds(h)%follows) holds(h)%compliance = contact%compliance
        end subroutine hold

    end subroutine lay_out

end module gapbeam_rigid_contact
