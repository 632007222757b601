!> The beam as arrays: links, nodes, supports
module gapbeam_model
    use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type, drop_loads_of_link
    use gapbeam_foundation, only: stretch_link_type
    use gapbeam_law, only: node_support_type, below, above, both, is_rigid, is_support, has_laws
    use gapbeam_law_adapters, only: least_stiffness
    implicit none
    private
    public :: beam_type, new_beam, order_supports, take_supports, last_place, node_of_support, has_other_supports, softest, &
        drop_loads
    ! Of gapbeam_law, for those who make beams
    public :: node_support_type, below, above, both, is_rigid
    public :: of_node, of_hinge, of_hinge_held_left, left_of_hinge, right_of_hinge, is_of_hinge

    !> Rotations that supports hold
    integer, parameter :: of_node = 0, of_hinge = 1, of_hinge_held_left = 2, left_of_hinge = 3, right_of_hinge = 4

    !> A beam; load index 1 dead, 2 live
    type :: beam_type
        !> Links between the nodes, shape (n)
        type(link_type), allocatable :: links(:)
        !> The same links as they are on elastic ground, shape (n); not allocated where no ground acts on the beam
        type(stretch_link_type), allocatable :: ground(:)
        !> Kind of every node (gapbeam_band), shape (0:n)
        integer, allocatable :: kind(:)
        !> Compliance of its rotational restraint, shape (0:n)
        real(wp), allocatable :: compliance(:)
        !> Applied force (down) and couple (clockwise), shape (2, 0:n)
        real(wp), allocatable :: force(:, :), couple(:, :)
        !> Nodes whose rotations supports hold by laws, shape (r); not allocated where there are none. Node n + j of such a support
        !> stands for the rotation at node turning(j): its "deflection", over which its "reaction" is a couple
        integer, allocatable :: turning(:)
        !> Which rotation that is, shape (r): of_node, clockwise, and the couple turns the beam back; of_hinge, the rotation left of
        !> the node less that right of it, positive with a sagging moment, which is the couple, and the node a hinge by itself; or
        !> left_of_hinge or right_of_hinge, as of_node but of the part of the beam on that side of a hinge. Only one is there,
        !> so the moment in the hinge is that on its other side: beside left_of_hinge it is of_hinge_held_left. Hinges come first
        integer, allocatable :: turned(:)
        !> Supports in the caller's order
        type(node_support_type), allocatable :: supports(:)
        !> Their numbers from left to right; those at node i are order(first(i)) to order(first(i + 1) - 1)
        integer, allocatable :: order(:), first(:)
        !> Address of the watch on calls with this beam (gapbeam_watch), and with all that are made of it
        type(c_ptr) :: watch = c_null_ptr
    end type beam_type

contains

    !> A beam from arrays; see the components of the type for their meaning
    pure subroutine new_beam(links, kind, compliance, force, couple, supports, beam, turning, turned)
        type(link_type), intent(in) :: links(:)
        !> Nodes, shape (0:n)
        integer, intent(in) :: kind(0:)
        real(wp), intent(in) :: compliance(0:), force(:, 0:), couple(:, 0:)
        type(node_support_type), intent(in) :: supports(:)
        type(beam_type), intent(out) :: beam
        !> Rotations that supports hold, if any
        integer, intent(in), optional :: turning(:), turned(:)
        integer :: n

        n = size(links)
        ! Components that are not allocated are absent
        if (present(turning)) beam%turning = turning
        if (present(turned)) beam%turned = turned
        allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
        beam%links(:) = links
        beam%kind(:) = kind
        beam%compliance(:) = compliance
        beam%force(:, :) = force
        beam%couple(:, :) = couple
        call order_supports(supports, beam)
    end subroutine new_beam

    !> Leave out the loads of a beam that are dead (1) or live (2)
    pure subroutine drop_loads(beam, k)
        type(beam_type), intent(inout) :: beam
        integer, intent(in) :: k

        beam%force(k, :) = 0.0_wp
        beam%couple(k, :) = 0.0_wp
        call drop_loads_of_link(beam%links, k)
    end subroutine drop_loads

    !> Give a beam its supports, and put them in order from left to right, those at the same node in the caller's order
    pure subroutine order_supports(supports, beam)
        type(node_support_type), intent(in) :: supports(:)
        !> A beam whose links, and rotations that supports hold, are there
        type(beam_type), intent(inout) :: beam
        integer :: k, i, n

        n = last_place(beam)
        if (checked) then
            call require(all(supports%node >= 0 .and. supports%node <= n), "order_supports: node")
            call require(all(is_support(supports)), "order_supports: side, stiffness or contact level")
        end if
        if (allocated(beam%supports)) deallocate (beam%supports, beam%order, beam%first)
        allocate (beam%supports(size(supports)), beam%order(size(supports)), beam%first(0:n + 1))
        beam%supports(:) = supports
        beam%first(:) = 0
        do k = 1, size(beam%supports)
            i = beam%supports(k)%node + 1
            beam%first(i) = beam%first(i) + 1
        end do
        beam%first(0) = 1
        do i = 1, n + 1
            beam%first(i) = beam%first(i) + beam%first(i - 1)
        end do
        ! first(i) moves up to first(i + 1) while the supports of node i are put in place
        do k = 1, size(beam%supports)
            i = beam%supports(k)%node
            beam%order(beam%first(i)) = k
            beam%first(i) = beam%first(i) + 1
        end do
        do i = n + 1, 1, -1
            beam%first(i) = beam%first(i - 1)
        end do
        beam%first(0) = 1
    end subroutine order_supports

    !> Give a beam that is another one cut finer the supports of that, and the rotations that they hold
    pure subroutine take_supports(given, node, beam)
        type(beam_type), intent(in) :: given
        !> Node of the finer beam for every node of the given one, shape (0:n)
        integer, intent(in) :: node(0:)
        !> With its links
        type(beam_type), intent(inout) :: beam
        type(node_support_type), allocatable :: supports(:)
        integer :: k, n

        n = size(given%links)
        if (allocated(given%turning)) then
            beam%turning = node(given%turning)
            beam%turned = given%turned
        end if
        allocate (supports, source=given%supports)
        do k = 1, size(supports)
            associate (i => supports(k)%node)
                if (i > n) then
                    i = size(beam%links) + (i - n)
                else
                    i = node(i)
                end if
            end associate
        end do
        call order_supports(supports, beam)
    end subroutine take_supports

    !> The last node that supports can have: that of the beam, or the last rotation
    pure function last_place(beam) result(last)
        type(beam_type), intent(in) :: beam
        integer :: last

        last = size(beam%links)
        if (allocated(beam%turning)) last = last + size(beam%turning)
    end function last_place

    !> Is a rotation that of one side of a hinge against the other
    elemental function is_of_hinge(turned) result(it_is)
        !> As in beam_type
        integer, intent(in) :: turned
        logical :: it_is

        it_is = turned == of_hinge .or. turned == of_hinge_held_left
    end function is_of_hinge

    !> The node of the beam at which a support is
    pure function node_of_support(beam, k) result(node)
        type(beam_type), intent(in) :: beam
        !> Its number
        integer, intent(in) :: k
        integer :: node

        node = beam%supports(k)%node
        if (node > size(beam%links)) node = beam%turning(node - size(beam%links))
    end function node_of_support

    !> Has a beam supports that are no springs with a gap across it: laws, or what holds rotations
    pure function has_other_supports(beam) result(it_has)
        type(beam_type), intent(in) :: beam
        logical :: it_has

        it_has = has_laws(beam%supports) .or. allocated(beam%turning)
    end function has_other_supports

    !> A stiffness far below all others: that of the whole beam in bending, or of its softest support
    pure function softest(beam) result(stiffness)
        type(beam_type), intent(in) :: beam
        real(wp) :: stiffness

        stiffness = least_stiffness(beam%supports, size(beam%links))
        if (any(beam%links%bending > 0.0_wp)) stiffness = min(stiffness, 1/(sum(beam%links%bending)*sum(beam%links%length)**2))
        if (.not. stiffness < huge(stiffness)) stiffness = 1.0_wp
        stiffness = stiffness/(size(beam%links) + 1)
    end function softest

end module gapbeam_model
