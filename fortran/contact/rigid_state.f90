!> State of a search for where a beam touches rigid ground: the contacts at hand, the solution on them, and the next contacts.
module gapbeam_rigid_state
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: rigid_noise
    use gapbeam_workspace, only: workspace_type
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_rigid_contact, only: contact_type, hold_type, binding_layer, same_line
    implicit none
    private
    public :: rigid_type, find_noise, hold_at, add, add_at_node, layer_beyond, is_zone_beyond, along_load, straightened

    !> What is nothing beside rounding
    type :: noise_type
        real(wp) :: deflection = 0.0_wp, moment = 0.0_wp, force = 0.0_wp
    end type noise_type

    !> A beam that touches rigid ground, and its solution
    type :: rigid_type
        real(wp) :: factor = 0.0_wp
        type(contact_type), allocatable :: contacts(:)
        type(zones_type) :: zones
        type(hold_type), allocatable :: holds(:)
        !> Stretch of every zone, border of every single place
        integer, allocatable :: place(:)
        !> Of the holds: do they touch, and how they push, up
        logical, allocatable :: touching(:)
        real(wp), allocatable :: push(:)
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        !> Linear solves so far
        integer :: solves = 0
        type(noise_type) :: noise
        !> The next contacts, the first `number`, and how far what touches at a border goes, shape (0:stretches)
        type(contact_type), allocatable :: found(:)
        integer :: number = 0
        real(wp), allocatable :: way(:)
    end type rigid_type

contains

    !> What is nothing beside rounding
    pure subroutine find_noise(ground, rigid)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        type(noise_type) :: most

        associate (a => rigid%work%answers(:size(rigid%zones%piece)))
            most%deflection = maxval(abs(a%deflection)) &
                + maxval(max(abs(ground%layers%contact_a), abs(ground%layers%contact_b)))
            most%moment = maxval(max(abs(a%moment_left), abs(a%moment_right)))
            most%force = maxval([0.0_wp, abs(rigid%work%reaction)])
        end associate
        rigid%noise = noise_type(rigid_noise*most%deflection, rigid_noise*most%moment, rigid_noise*most%force)
    end subroutine find_noise

    !> The hold at a border by ground of a side, 0: none
    pure function hold_at(rigid, border, side) result(found)
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: border, side
        integer :: found

        do found = size(rigid%holds), 1, -1
            if (rigid%holds(found)%border == border .and. rigid%holds(found)%side == side) exit
        end do
    end function hold_at

    !> One more contact
    subroutine add(rigid, contact)
        type(rigid_type), intent(inout) :: rigid
        type(contact_type), intent(in) :: contact

        rigid%number = rigid%number + 1
        rigid%found(rigid%number) = contact
    end subroutine add

    !> Touch the ground at a node
    subroutine add_at_node(ground, rigid, node, side)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        integer, intent(in) :: node, side
        integer :: layer, piece

        layer = binding_layer(ground, node, side)
        if (layer == 0) return
        piece = max(1, node)
        if (layer < ground%first(piece) .or. layer >= ground%first(piece + 1)) piece = piece + 1
        associate (at => merge(ground%pieces(piece)%length, 0.0_wp, piece == node))
            call add(rigid, contact_type(piece, layer, at, at))
        end associate
    end subroutine add_at_node

    !> The layer that goes on in the next piece, 0: none does
    function layer_beyond(ground, contact, other) result(layer)
        type(ground_type), intent(in) :: ground
        type(contact_type), intent(in) :: contact
        integer, intent(in) :: other
        integer :: layer

        layer = 0
        if (other < 1 .or. other > size(ground%pieces)) return
        do layer = ground%first(other), ground%first(other + 1) - 1
            if (other > contact%piece) then
                if (same_line(ground, contact%piece, [contact%layer, layer])) return
            else
                if (same_line(ground, other, [layer, contact%layer])) return
            end if
        end do
        layer = 0
    end function layer_beyond

    !> Does the zone go on in the next piece
    function is_zone_beyond(rigid, i, end) result(is_zone)
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: i, end
        logical :: is_zone
        integer :: other

        is_zone = .false.
        other = i + merge(-1, 1, end == 1)
        if (other < 1 .or. other > size(rigid%zones%piece)) return
        is_zone = any(rigid%zones%acts(:, other) > 0)
    end function is_zone_beyond

    !> Moment that holds a piece straight against the curvature imposed on it
    pure function straightened(ground, rigid, piece) result(moment)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: piece
        real(wp) :: moment

        moment = (ground%dead(piece)%kappa + rigid%factor*ground%live(piece)%kappa)/ground%pieces(piece)%flexibility
    end function straightened

    !> Load per length at a distance from the left end of a piece
    pure function along_load(ground, rigid, piece, at) result(q)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: piece
        real(wp), intent(in) :: at
        real(wp) :: q, ends(2)

        associate (dead => ground%dead(piece), live => ground%live(piece))
            ends = [dead%qa, dead%qb] + rigid%factor*[live%qa, live%qb]
        end associate
        q = ends(1) + (ends(2) - ends(1))*(at/ground%pieces(piece)%length)
    end function along_load

end module gapbeam_rigid_state
