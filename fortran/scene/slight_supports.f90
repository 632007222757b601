!> Supports that are next to nothing beside the beam: what they give is beyond the digits even of quadruple precision, and what
!> they give beside other supports would be lost in rounding errors.
module gapbeam_slight_supports
    use gapbeam_kinds, only: wp
    use gapbeam_law, only: always_closed
    use gapbeam_kinematics, only: free_motions, motion_type
    use gapbeam_assembled_model, only: assembled_type, turns
    implicit none
    private
    public :: slight_stiffness, leave_out_slight

    !> Share of the stiffness of the whole beam, and of that of other springs: more digits than doubles have, and fewer than
    !> quadruple precision
    real(wp), parameter :: slight = 2.0_wp**(-80)

contains

    !> Stiffness across the beam below which a support is next to nothing, in the engine's units; 0 for a rigid beam
    pure function slight_stiffness(assembled) result(stiffness)
        type(assembled_type), intent(in) :: assembled
        real(wp) :: stiffness, length, soft

        associate (pieces => assembled%pieces)
            length = sum(pieces%length)
            soft = length*(length**2*maxval([pieces%flexibility, pieces%flexibility_to]) &
                           + maxval([pieces%shear_flexibility, pieces%shear_flexibility_to]))
        end associate
        stiffness = 0.0_wp
        if (soft > 0.0_wp) stiffness = slight/soft
    end function slight_stiffness

    !> Leave such springs out, if all others hold the beam without them
    subroutine leave_out_slight(assembled)
        !> In the engine's units
        type(assembled_type), intent(inout) :: assembled
        type(motion_type), allocatable :: motions(:)
        real(wp) :: limit
        logical :: is_slight(size(assembled%normal)), acting(size(assembled%normal))

        associate (s => assembled%beam%supports)
            is_slight(:) = s%breakpoint == 0 .and. s%stiffness > 0.0_wp &
                .and. .not. turns(assembled%model%supports(assembled%normal))
            limit = slight_stiffness(assembled)
            if (.not. any(is_slight .and. s%stiffness < limit)) return
            limit = min(limit, slight*minval(s%stiffness, is_slight .and. s%stiffness >= limit))
            is_slight(:) = is_slight .and. s%stiffness < limit
            if (.not. any(is_slight)) return
            acting(:) = always_closed(s) .and. .not. is_slight
            call free_motions(assembled%beam, acting, motions)
            if (size(motions) > 0) return
            where (is_slight) s%stiffness = 0.0_wp
        end associate
    end subroutine leave_out_slight

end module gapbeam_slight_supports
