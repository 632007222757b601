!> Codes for states of supports, pieces of laws and events.
module gapbeam_pieces
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: node_support_type, last_breakpoint
    use gapbeam_law, only: both
    use gapbeam_assembled_model, only: assembled_type
    implicit none
    private
    public :: acting_type, acting_piece, acts_in, what_happens, no_change
    public :: gapbeam_open, gapbeam_closed, gapbeam_bilateral, gapbeam_touching, gapbeam_branch
    public :: gapbeam_opens, gapbeam_closes, gapbeam_turns, gapbeam_yields, gapbeam_hardens, gapbeam_softens, gapbeam_breaks, &
        gapbeam_unloads, gapbeam_slips, gapbeam_sticks
    public :: gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits, gapbeam_reaches, gapbeam_leaves

    !> States of a support
    integer, parameter :: gapbeam_open = 0, gapbeam_closed = 1, gapbeam_bilateral = 2
    !> Of ground: a zone of no length
    integer, parameter :: gapbeam_touching = 4
    !> Plus the number of the piece, from 1: of a support with a law
    integer, parameter :: gapbeam_branch = 10
    !> Events. The beam has lost its hold and turns, at constant load, until the support holds it
    integer, parameter :: gapbeam_opens = gapbeam_open, gapbeam_closes = gapbeam_closed, gapbeam_turns = 3
    !> Of supports with a law: on to a piece that is flatter, or steeper; on which the force falls, or drops at once; back
    integer, parameter :: gapbeam_yields = 4, gapbeam_hardens = 5, gapbeam_softens = 6, gapbeam_breaks = 7, gapbeam_unloads = 8
    !> Of friction: the beam begins to slide over the support, or no longer does
    integer, parameter :: gapbeam_slips = 9, gapbeam_sticks = 10
    !> Of zones of contact with the ground; of their ends, at those of the foundation or of the beam
    integer, parameter :: gapbeam_appears = 20, gapbeam_vanishes = 21, gapbeam_merges = 22, gapbeam_splits = 23, &
                          gapbeam_reaches = 24, gapbeam_leaves = 25
    !> No event
    integer, parameter :: no_change = -1

    !> What acts of a support
    type :: acting_type
        !> gapbeam_open, gapbeam_closed, gapbeam_bilateral, or gapbeam_branch plus the number of the piece
        integer :: condition
        !> Of the piece of a law: force per length, and the side of the middle of the law it is on, 1 or -1; else 0
        real(wp) :: slope
        integer :: way
    end type acting_type

contains

    !> What acts of a support
    pure function acting_piece(breakpoints, side, closed) result(acting)
        !> The support as the engine has it: the breakpoints of its law, or one entry
        type(node_support_type), intent(in) :: breakpoints(:)
        !> Its side, and its part of the scheme
        integer, intent(in) :: side
        logical, intent(in) :: closed(:)
        type(acting_type) :: acting
        integer :: middle, number

        acting = acting_type(gapbeam_bilateral, 0.0_wp, 0)
        if (breakpoints(1)%breakpoint == 0) then
            if (side /= both) acting%condition = merge(gapbeam_closed, gapbeam_open, closed(1))
            return
        end if
        middle = 0
        if (side == both) middle = size(breakpoints)/2
        number = abs(count(closed) - middle)
        if (side == both) then
            if (abs(breakpoints(middle)%stiffness) > 0.0_wp) number = number + 1
        end if
        acting%condition = gapbeam_open
        acting%way = merge(1, -1, count(closed) >= middle)
        if (number == 0) return
        acting%condition = gapbeam_branch + number
        acting%slope = breakpoints(1)%before
        if (any(closed)) acting%slope = breakpoints(count(closed))%stiffness
    end function acting_piece

    !> What acts of a support of the model in a scheme; a smooth law is one piece
    pure function acts_in(assembled, support, closed, laws) result(acting)
        type(assembled_type), intent(in) :: assembled
        !> Number of the support, held to the beam, and the scheme of all
        integer, intent(in) :: support
        logical, intent(in) :: closed(:)
        !> The laws of all as they have become, if they are not those of the beam
        type(node_support_type), intent(in), optional :: laws(:)
        type(acting_type) :: acting

        associate (first => assembled%beam_support(support), side => assembled%model%supports(support)%side)
            associate (last => last_breakpoint(assembled%beam%supports, first))
                if (present(laws)) then
                    acting = acting_piece(laws(first:last), side, closed(first:last))
                else
                    acting = acting_piece(assembled%beam%supports(first:last), side, closed(first:last))
                end if
                if (is_smooth(assembled%model%supports(support)%law)) acting = as_one_piece(acting)
            end associate
        end associate
    end function acts_in

    !> What acts of a smooth law, from the piece of its polyline: the law is one piece
    elemental function as_one_piece(acting) result(one)
        type(acting_type), intent(in) :: acting
        type(acting_type) :: one

        one = acting_type(min(acting%condition, gapbeam_branch + 1), merge(0.0_wp, 1.0_wp, acting%condition == gapbeam_open), &
                          acting%way)
    end function as_one_piece

    !> The event between two pieces of a law, or between no contact and contact, or none
    pure function what_happens(before, after) result(event)
        type(acting_type), intent(in) :: before, after
        !> gapbeam_opens, gapbeam_closes, gapbeam_yields, gapbeam_hardens, gapbeam_softens, gapbeam_breaks, gapbeam_unloads or
        !> nothing
        integer :: event
        logical :: same_slope

        same_slope = .not. (before%slope < after%slope .or. before%slope > after%slope)
        if (before%condition == after%condition .and. before%way == after%way .and. same_slope) then
            event = no_change
        else if (before%condition == gapbeam_open .or. after%condition == gapbeam_open) then
            event = merge(gapbeam_opens, gapbeam_closes, after%condition == gapbeam_open)
        else if (same_slope) then
            event = no_change
        else if (after%condition < before%condition) then
            event = gapbeam_unloads
        else if (before%slope < -huge(1.0_wp)) then
            event = no_change  ! the foot of a drop; it has broken at its top
        else if (after%slope < 0.0_wp) then
            event = merge(gapbeam_breaks, gapbeam_softens, after%slope < -huge(1.0_wp))
        else
            event = merge(gapbeam_hardens, gapbeam_yields, after%slope > before%slope)
        end if
    end function what_happens

end module gapbeam_pieces
