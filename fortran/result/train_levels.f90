!> Deflections at rigid supports are their levels: what differs from that by rounding only is made so
module gapbeam_train_levels
    use gapbeam_kinds, only: wp
    use gapbeam_law, only: is_rigid
    use gapbeam_model, only: beam_type
    implicit none
    private
    public :: keep_level

contains

    !> Make a deflection at a node the contact level of a rigid support there, if it is that but for rounding
    pure subroutine keep_level(beam, node, rounding, deflection)
        type(beam_type), intent(in) :: beam
        !> The node; none if below 0
        integer, intent(in) :: node
        !> How much is rounding, and the deflection, in the engine's units
        real(wp), intent(in) :: rounding
        real(wp), intent(inout) :: deflection
        integer :: j

        if (node < 0) return
        do j = beam%first(node), beam%first(node + 1) - 1
            associate (s => beam%supports(beam%order(j)))
                if (s%kink > 0 .or. .not. is_rigid(s)) cycle
                if (abs(deflection - s%contact) <= rounding) deflection = s%contact
            end associate
        end do
    end subroutine keep_level

end module gapbeam_train_levels
