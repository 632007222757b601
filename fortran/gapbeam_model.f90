!> The beam as arrays: links, nodes, supports
module gapbeam_model
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type
    implicit none
    private
    public :: beam_type, support_type, new_beam, below, above, both, is_rigid, softest

    !> Sides of a support: pushes up only, pushes down only, both
    integer, parameter :: below = 1, above = -1, both = 0

    !> A support at a node
    type :: support_type
        !> Node, 0..n
        integer :: node
        !> below, above or both
        integer :: side
        !> Force per length; infinite for a rigid one
        real(wp) :: stiffness
        !> Deflection at which it begins to act: settlement + gap (below), settlement - gap (above)
        real(wp) :: contact
    end type support_type

    !> A beam; load index 1 dead, 2 live
    type :: beam_type
        !> Links between the nodes, shape (n)
        type(link_type), allocatable :: links(:)
        !> Kind of every node (gapbeam_band), shape (0:n)
        integer, allocatable :: kind(:)
        !> Compliance of its rotational restraint, shape (0:n)
        real(wp), allocatable :: compliance(:)
        !> Applied force (down) and couple (clockwise), shape (2, 0:n)
        real(wp), allocatable :: force(:, :), couple(:, :)
        !> Supports in the caller's order
        type(support_type), allocatable :: supports(:)
    end type beam_type

contains

    !> A beam from plain arrays; see the components of the types for their meaning
    pure subroutine new_beam(links, kind, compliance, force, couple, node, side, stiffness, contact, beam)
        !> Links, shape (n)
        type(link_type), intent(in) :: links(:)
        !> Nodes, shape (0:n)
        integer, intent(in) :: kind(0:)
        real(wp), intent(in) :: compliance(0:), force(:, 0:), couple(:, 0:)
        !> Supports, shape (m)
        integer, intent(in) :: node(:), side(:)
        real(wp), intent(in) :: stiffness(:), contact(:)
        !> The beam
        type(beam_type), intent(out) :: beam
        integer :: k, n

        n = size(links)
        allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
        allocate (beam%supports(size(node)))
        beam%links(:) = links
        beam%kind(:) = kind
        beam%compliance(:) = compliance
        beam%force(:, :) = force
        beam%couple(:, :) = couple
        do k = 1, size(node)
            beam%supports(k) = support_type(node(k), side(k), stiffness(k), contact(k))
        end do
    end subroutine new_beam

    !> Is a support rigid
    elemental function is_rigid(support) result(rigid)
        type(support_type), intent(in) :: support
        logical :: rigid

        rigid = support%stiffness > huge(support%stiffness)
    end function is_rigid

    !> A stiffness far below all others: that of the whole beam in bending, or of its softest support
    pure function softest(beam) result(stiffness)
        type(beam_type), intent(in) :: beam
        real(wp) :: stiffness
        integer :: i

        stiffness = huge(stiffness)
        if (any(beam%links%bending > 0.0_wp)) stiffness = 1/(sum(beam%links%bending)*sum(beam%links%length)**2)
        do i = 1, size(beam%supports)
            associate (s => beam%supports(i))
                if (s%stiffness > 0.0_wp) stiffness = min(stiffness, s%stiffness)
            end associate
        end do
        if (.not. stiffness < huge(stiffness)) stiffness = 1.0_wp
        stiffness = stiffness/(size(beam%links) + 1)
    end function softest

end module gapbeam_model
