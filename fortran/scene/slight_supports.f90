!> Supports, restraints, ground and axial forces that are next to nothing beside the beam: what they give is beyond the
!> digits even of quadruple precision, and what they give beside others would be lost in rounding errors.
module gapbeam_slight_supports
    use gapbeam_kinds, only: wp
    use gapbeam_nodes, only: plain, hinge, restrained, hinge_left, hinge_right
    use gapbeam_laws, only: law_by_points
    use gapbeam_law, only: always_closed
    use gapbeam_model, only: beam_type
    use gapbeam_kinematics, only: free_motions, motion_type
    use gapbeam_assembled_model, only: assembled_type, turns
    implicit none
    private
    public :: slight_stiffness, leave_out_slight, leave_out_of_case, may_be_slight, share_in_doubt

    !> Share of the stiffness of the whole beam, and of that of other springs: more digits than doubles have, and fewer than
    !> quadruple precision
    real(wp), parameter :: slight = 2.0_wp**(-80)
    !> What more of ground and of axial forces is next to nothing: less than the digits of doubles, which is what elimination keeps
    !> along a chain of stretches
    real(wp), parameter :: in_stretches = 2.0_wp**20
    !> Share of the stiffness of the whole beam from which on up supports and restraints of cases are never next to nothing: what is
    !> less than that is told case by case
    real(wp), parameter :: share_in_doubt = 2.0_wp**(-40)

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

    !> Stiffness across the beam below which a support of a case may be next to nothing
    pure function may_be_slight(assembled) result(stiffness)
        type(assembled_type), intent(in) :: assembled
        real(wp) :: stiffness

        stiffness = max(tiny(stiffness), share_in_doubt/slight*slight_stiffness(assembled))
    end function may_be_slight

    !> Leave all that out, if what is more than that holds the beam by itself
    subroutine leave_out_slight(assembled)
        !> In the engine's units
        type(assembled_type), intent(inout) :: assembled
        logical :: is_slight(size(assembled%normal)), is_slack(0:size(assembled%beam%links))
        real(wp) :: limit

        associate (kind => assembled%beam%kind)
            ! Beside other stiffnesses others may have been left out before
            if (allocated(assembled%kind_with_all)) kind(:) = assembled%kind_with_all
            call find_slight(assembled, assembled%beam, is_slight, is_slack, limit)
            if (any(is_slack) .and. .not. allocated(assembled%kind_with_all)) then
                allocate (assembled%kind_with_all(0:size(kind) - 1), source=kind)
            end if
        end associate
        call leave_out(is_slight, is_slack, assembled%beam)
        call leave_out_tension(assembled, limit*in_stretches)
        call leave_out_ground(assembled, limit*in_stretches)
    end subroutine leave_out_slight

    !> The same of springs and restraints of a case with numbers of its own
    subroutine leave_out_of_case(assembled, beam)
        type(assembled_type), intent(in) :: assembled
        !> Of the case
        type(beam_type), intent(inout) :: beam
        logical :: is_slight(size(beam%supports)), is_slack(0:size(beam%links))
        real(wp) :: limit

        call find_slight(assembled, beam, is_slight, is_slack, limit)
        call leave_out(is_slight, is_slack, beam)
    end subroutine leave_out_of_case

    !> Leave out springs and restraints
    pure subroutine leave_out(is_slight, is_slack, beam)
        !> As find_slight finds them
        logical, intent(in) :: is_slight(:), is_slack(0:)
        type(beam_type), intent(inout) :: beam

        where (is_slight) beam%supports%stiffness = 0.0_wp
        where (is_slack)
            beam%kind = merge(plain, hinge, beam%kind == restrained)
            beam%compliance = 0.0_wp
        end where
    end subroutine leave_out

    !> What is next to nothing, if what is more than that holds the beam by itself
    subroutine find_slight(assembled, beam, is_slight, is_slack, limit)
        type(assembled_type), intent(in) :: assembled
        type(beam_type), intent(in) :: beam
        !> Supports, and nodes with such a restraint, shape (0:n)
        logical, intent(out) :: is_slight(:), is_slack(0:)
        !> Stiffness across the beam below which all is next to nothing; 0 where nothing is to be left out
        real(wp), intent(out) :: limit
        real(wp) :: length, shortest, loosest
        logical, dimension(size(is_slight)) :: is_spring, is_turned

        is_slight(:) = .false.
        is_slack(:) = .false.
        length = sum(assembled%pieces%length)
        shortest = minval(assembled%pieces%length)
        limit = slight_stiffness(assembled)
        if (.not. limit > 0.0_wp) return
        associate (s => beam%supports)
            is_turned(:) = turns(assembled%model%supports(assembled%normal))
            is_spring(:) = s%breakpoint == 0 .and. s%stiffness > 0.0_wp .and. .not. is_turned
            is_slight(:) = is_spring .and. s%stiffness < limit
            is_slack(:) = beam%kind == restrained .or. beam%kind == hinge_left .or. beam%kind == hinge_right
            ! The shortest lever makes the least of springs beside a restraint, the longest one the most of restraints
            is_slack(:) = is_slack .and. beam%compliance*limit*shortest**2 > 1.0_wp
            if (any(is_slight) .or. any(is_slack) .or. allocated(assembled%layers) &
                .or. any(abs(assembled%pieces%tension) > 0.0_wp)) then
                if (.not. is_held(beam, is_slight, is_slack)) limit = 0.0_wp
            end if
            limit = min(limit, slight*minval(s%stiffness, is_spring .and. .not. is_slight), &
                        slight*minval(s%stiffness, is_turned .and. s%stiffness > 0.0_wp)/length**2)
            loosest = maxval(beam%compliance, .not. is_slack)
            if (loosest > 0.0_wp) limit = min(limit, slight/(loosest*length**2))
            is_slight(:) = is_slight .and. s%stiffness < limit
        end associate
        is_slack(:) = is_slack .and. beam%compliance*limit*shortest**2 > 1.0_wp
    end subroutine find_slight

    !> Do supports and restraints hold a beam without some of them
    function is_held(beam, without, turning) result(held)
        type(beam_type), intent(in) :: beam
        !> Supports, and nodes at which no restraint holds the rotation, shape (0:n)
        logical, intent(in) :: without(:), turning(0:)
        logical :: held
        type(beam_type) :: free
        type(motion_type), allocatable :: motions(:)

        free = beam
        where (turning) free%kind = merge(plain, hinge, beam%kind == restrained)
        call free_motions(free, always_closed(beam%supports) .and. .not. without, motions)
        held = size(motions) == 0
    end function is_held

    !> Axial forces that turn next to nothing, if they are given and stay
    pure subroutine leave_out_tension(assembled, limit)
        type(assembled_type), intent(inout) :: assembled
        !> Stiffness across the beam below which all is next to nothing
        real(wp), intent(in) :: limit

        if (allocated(assembled%tension_growth) .or. assembled%model%axial_loads_bend) return
        associate (pieces => assembled%pieces)
            if (any(pieces%slope_stiffness > 0.0_wp)) return
            if (maxval(abs(pieces%tension)) >= limit*minval(pieces%length)) return
            pieces%tension = 0.0_wp
            pieces%compression = 0.0_wp
        end associate
    end subroutine leave_out_tension

    !> Ground that is next to nothing even as a spring under all of the beam
    pure subroutine leave_out_ground(assembled, limit)
        type(assembled_type), intent(inout) :: assembled
        !> As for leave_out_tension
        real(wp), intent(in) :: limit

        if (.not. allocated(assembled%layers)) return
        associate (layers => assembled%layers, length => sum(assembled%pieces%length))
            where (layers%law == law_by_points .and. layers%law_last < layers%law_first .and. .not. layers%rigid &
                   .and. max(layers%modulus_a, layers%modulus_b)*length < limit)
                layers%modulus_a = 0.0_wp
                layers%modulus_b = 0.0_wp
            end where
        end associate
    end subroutine leave_out_ground

end module gapbeam_slight_supports
