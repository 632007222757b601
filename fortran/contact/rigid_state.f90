!> State of a search for where a beam touches rigid ground: the contacts at hand, the solution on them, and the next contacts.
module gapbeam_rigid_state
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: rigid_noise
    use gapbeam_workspace, only: workspace_type
    use gapbeam_ground_laws, only: along
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_stretch_loads, only: combined_load
    use gapbeam_rigid_contact, only: contact_type, hold_type, place_at_node, binding_layer
    implicit none
    private
    public :: rigid_type, find_noise, hold_at, add, add_at_node, is_zone, load_at, straightened

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
        integer :: i

        associate (z => rigid%zones, a => rigid%work%answers(:size(rigid%zones%piece)))
            most%deflection = maxval(abs(a%deflection)) &
                + maxval(max(abs(ground%layers%contact_a), abs(ground%layers%contact_b)))
            most%moment = maxval(max(abs(a%moment_left), abs(a%moment_right)))
            most%force = maxval([0.0_wp, abs(rigid%work%reaction)])
            ! Where the beam lies, the ground takes the load at once
            do i = 1, size(z%piece)
                if (.not. is_zone(rigid, i)) cycle
                most%force = max(most%force, (z%to(i) - z%from(i)) &
                                 *maxval(abs(load_at(ground, rigid, z%piece(i), [z%from(i), z%to(i)]))))
            end do
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
        integer :: layer

        layer = binding_layer(ground, node, side)
        if (layer > 0) call add(rigid, place_at_node(ground, node, layer))
    end subroutine add_at_node

    !> Is there a stretch that is a zone
    pure function is_zone(rigid, i)
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: i
        logical :: is_zone

        is_zone = .false.
        if (i >= 1 .and. i <= size(rigid%zones%piece)) is_zone = any(rigid%zones%acts(:, i) > 0)
    end function is_zone

    !> Moment that holds a piece straight against the curvature imposed on it
    pure function straightened(ground, rigid, piece) result(moment)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: piece
        real(wp) :: moment

        moment = (ground%dead(piece)%kappa + rigid%factor*ground%live(piece)%kappa)/ground%pieces(piece)%flexibility
    end function straightened

    !> Load per length at a distance from the left end of a piece, which the ground takes where the beam lies on it
    elemental function load_at(ground, rigid, piece, distance) result(q)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(in) :: rigid
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp) :: q

        associate (load => combined_load(ground%dead(piece), ground%live(piece), rigid%factor))
            q = along(load%qa, load%qb, distance, ground%pieces(piece)%length)
        end associate
    end function load_at

end module gapbeam_rigid_state
