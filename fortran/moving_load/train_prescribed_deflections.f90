!> Prescribed deflections at rigid supports, put in place of what differs by rounding only.
module gapbeam_train_prescribed_deflections
    use gapbeam_kinds, only: wp
    use gapbeam_law, only: is_rigid
    use gapbeam_model, only: beam_type
    use gapbeam_train_ties, only: extreme_type
    implicit none
    private
    public :: keep_prescribed, keep_prescribed_extreme

contains

    !> Make a deflection at a node the contact level of a rigid support there, if it is that but for rounding
    pure subroutine keep_prescribed(beam, node, rounding, deflection)
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
                if (s%breakpoint > 0 .or. .not. is_rigid(s)) cycle
                if (abs(deflection - s%contact) <= rounding) deflection = s%contact
            end associate
        end do
    end subroutine keep_prescribed

    !> The same of extremes in the user's units
    pure subroutine keep_prescribed_extreme(beam, node, power, rounding, extreme)
        !> As for keep_prescribed
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: node
        !> Exponent of the unit
        integer, intent(in) :: power
        !> How much is rounding, in the user's units
        real(wp), intent(in) :: rounding
        type(extreme_type), intent(inout) :: extreme
        real(wp) :: deflection
        integer :: q

        do q = 1, extreme%number
            deflection = scale(extreme%ties(q)%value, -power)
            call keep_prescribed(beam, node, scale(rounding, -power), deflection)
            extreme%ties(q)%value = scale(deflection, power)
        end do
    end subroutine keep_prescribed_extreme

end module gapbeam_train_prescribed_deflections
