!> Supports in the form of other methods: as pairs, as stiffnesses, one for a node, or changed.
module gapbeam_law_adapters
    use gapbeam_kinds, only: wp
    use gapbeam_law, only: node_support_type, both, is_rigid
    use gapbeam_law_margins, only: may_change
    implicit none
    private
    public :: least_stiffness, stiffness_of_changing, find_pairs, find_single
    public :: hold_both_ways, limit_stiffness, drop_level

contains

    !> The least stiffness that is not 0; huge if there is no finite one
    pure function least_stiffness(supports, last) result(least)
        type(node_support_type), intent(in) :: supports(:)
        !> Last node of the beam: supports beyond hold rotations
        integer, intent(in) :: last
        real(wp) :: least
        integer :: k

        least = huge(least)
        do k = 1, size(supports)
            if (supports(k)%stiffness > 0.0_wp .and. supports(k)%node <= last) least = min(least, supports(k)%stiffness)
        end do
    end function least_stiffness

    !> Stiffnesses of the supports whose state may change when they are closed, infinite for rigid ones; 0 for the others
    pure function stiffness_of_changing(supports) result(stiffness)
        type(node_support_type), intent(in) :: supports(:)
        real(wp) :: stiffness(size(supports))
        integer :: k

        do k = 1, size(supports)
            stiffness(k) = merge(supports(k)%stiffness, 0.0_wp, supports(k)%side /= both)
        end do
    end function stiffness_of_changing

    !> The supports whose state may change as complementary pairs: R >= 0, side (contact - w) + R compliance >= 0, their product 0
    pure subroutine find_pairs(supports, numbers, side, contact, compliance)
        type(node_support_type), intent(in) :: supports(:)
        !> Their numbers, sides (1 or -1), contact levels, and 1/stiffness
        integer, allocatable, intent(out) :: numbers(:)
        real(wp), allocatable, intent(out) :: side(:), contact(:), compliance(:)
        integer :: k

        numbers = pack([(k, k=1, size(supports))], may_change(supports))
        allocate (side(size(numbers)), contact(size(numbers)), compliance(size(numbers)))
        do k = 1, size(numbers)
            associate (s => supports(numbers(k)))
                side(k) = s%side
                contact(k) = s%contact
                compliance(k) = 0.0_wp
                if (.not. is_rigid(s)) compliance(k) = 1/s%stiffness
            end associate
        end do
    end subroutine find_pairs

    !> The nodes at which one support alone can carry, and that to one side only
    pure subroutine find_single(supports, number, side, contact)
        type(node_support_type), intent(in) :: supports(:)
        !> Its number, 0 at other nodes; its side and contact level; shape (0:n)
        integer, intent(out) :: number(0:), side(0:)
        real(wp), intent(out) :: contact(0:)
        integer :: k

        number(:) = 0
        side(:) = both
        contact(:) = 0.0_wp
        do k = 1, size(supports)
            associate (s => supports(k))
                if (.not. s%stiffness > 0.0_wp) cycle
                ! One support beside others of its node is none
                number(s%node) = merge(k, -1, number(s%node) == 0)
                side(s%node) = s%side
                contact(s%node) = s%contact
            end associate
        end do
        where (number < 0 .or. side == both) number = 0
    end subroutine find_single

    !> Make a support one that holds both ways
    elemental subroutine hold_both_ways(support)
        type(node_support_type), intent(inout) :: support

        support%side = both
    end subroutine hold_both_ways

    !> Make a support no stiffer than this
    elemental subroutine limit_stiffness(support, stiffness)
        type(node_support_type), intent(inout) :: support
        real(wp), intent(in) :: stiffness

        if (support%stiffness > stiffness) support%stiffness = stiffness
    end subroutine limit_stiffness

    !> Take the contact level for the origin: what is left of the law when deflections are changes
    elemental subroutine drop_level(support)
        type(node_support_type), intent(inout) :: support

        support%contact = 0.0_wp
        support%force = 0.0_wp
    end subroutine drop_level

end module gapbeam_law_adapters
