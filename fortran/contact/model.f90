!> The beam as arrays: links, nodes, supports
module gapbeam_model
    use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_foundation, only: stretch_link_type
    use gapbeam_law, only: node_support_type, below, above, both, is_rigid, is_support
    use gapbeam_law_adapters, only: least_stiffness
    implicit none
    private
    public :: beam_type, new_beam, order_supports, softest
    ! Of gapbeam_law, for those who make beams
    public :: node_support_type, below, above, both, is_rigid

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
        !> Supports in the caller's order
        type(node_support_type), allocatable :: supports(:)
        !> Their numbers from left to right; those at node i are order(first(i)) to order(first(i + 1) - 1)
        integer, allocatable :: order(:), first(:)
        !> Address of the watch on calls with this beam (gapbeam_watch), and with all that are made of it
        type(c_ptr) :: watch = c_null_ptr
    end type beam_type

contains

    !> A beam from arrays; see the components of the type for their meaning
    pure subroutine new_beam(links, kind, compliance, force, couple, supports, beam)
        !> Links, shape (n)
        type(link_type), intent(in) :: links(:)
        !> Nodes, shape (0:n)
        integer, intent(in) :: kind(0:)
        real(wp), intent(in) :: compliance(0:), force(:, 0:), couple(:, 0:)
        !> Supports
        type(node_support_type), intent(in) :: supports(:)
        !> The beam
        type(beam_type), intent(out) :: beam
        integer :: n

        n = size(links)
        allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
        beam%links(:) = links
        beam%kind(:) = kind
        beam%compliance(:) = compliance
        beam%force(:, :) = force
        beam%couple(:, :) = couple
        call order_supports(supports, beam)
    end subroutine new_beam

    !> Give a beam its supports, and put them in order from left to right, those at the same node in the caller's order
    pure subroutine order_supports(supports, beam)
        !> The supports
        type(node_support_type), intent(in) :: supports(:)
        !> A beam whose links are there
        type(beam_type), intent(inout) :: beam
        integer :: k, i, n

        n = size(beam%links)
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

    !> A stiffness far below all others: that of the whole beam in bending, or of its softest support
    pure function softest(beam) result(stiffness)
        type(beam_type), intent(in) :: beam
        real(wp) :: stiffness

        stiffness = least_stiffness(beam%supports)
        if (any(beam%links%bending > 0.0_wp)) then
            stiffness = min(stiffness, 1/(sum(beam%links%bending)*sum(beam%links%length)**2))
        end if
        if (.not. stiffness < huge(stiffness)) stiffness = 1.0_wp
        stiffness = stiffness/(size(beam%links) + 1)
    end function softest

end module gapbeam_model
