!> Smooth laws of supports over the deflections of the beam, in the user's units, and lines in place of them in the engine's.
module gapbeam_smooth_laws
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: is_smooth, begins_steep, law_force, law_slope
    use gapbeam_scene, only: support_type, gapbeam_both
    use gapbeam_polyline, only: node_support_type, last_breakpoint, extend_piece
    use gapbeam_units, only: stiffness_unit
    use gapbeam_assembled_model, only: assembled_type
    implicit none
    private
    public :: smooth_supports, past_the_gap, past_curve, force_and_slope, deflection_at, deflections_at_curves, &
        largest_deflection, reaction_at, put_line, put_pieces

contains

    !> The supports of a model that have a smooth law, and can carry
    pure function smooth_supports(assembled) result(numbers)
        type(assembled_type), intent(in) :: assembled
        integer, allocatable :: numbers(:)
        integer :: k

        associate (s => assembled%model%supports)
            numbers = pack([(k, k=1, size(s))], is_smooth(s%law) .and. assembled%beam_support > 0)
        end associate
    end function smooth_supports

    !> Displacement past the gap, negative where a support is open, and which way it goes (1 down)
    elemental subroutine past_the_gap(support, deflection, past, way)
        type(support_type), intent(in) :: support
        !> Of the beam there, down
        real(wp), intent(in) :: deflection
        real(wp), intent(out) :: past
        integer, intent(out) :: way

        way = support%side
        if (way == gapbeam_both) way = merge(-1, 1, deflection - support%settlement < 0.0_wp)
        past = way*(deflection - support%settlement) - support%gap
    end subroutine past_the_gap

    !> How far a state is past the beginning of a curve: a distance, or, where that grows with the square of the load or so, since
    !> the curve begins steep, the force there
    pure subroutine past_curve(assembled, support, deflection, reaction, past, way)
        type(assembled_type), intent(in) :: assembled
        !> Of the model
        integer, intent(in) :: support
        !> Of the nodes and of the beam's supports, in the engine's units
        real(wp), intent(in) :: deflection(0:), reaction(:)
        !> Above 0 where it acts; and as for past_the_gap
        real(wp), intent(out) :: past
        integer, intent(out) :: way
        real(wp) :: force

        associate (given => assembled%model%supports(support))
            call past_the_gap(given, deflection_at(assembled, deflection, support), past, way)
            if (.not. begins_steep(given%law, given%parameter)) return
            force = way*reaction_at(assembled, reaction, support)
            past = merge(force, min(past, 0.0_wp), force > 0.0_wp)
        end associate
    end subroutine past_curve

    !> Force in the way of a displacement past the gap, and its slope
    elemental subroutine force_and_slope(support, past, force, slope)
        type(support_type), intent(in) :: support
        real(wp), intent(in) :: past
        real(wp), intent(out) :: force, slope

        force = 0.0_wp
        slope = 0.0_wp
        if (past > 0.0_wp) then
            force = law_force(support%law, support%parameter, past)
            slope = law_slope(support%law, support%parameter, past)
        else if (support%side == gapbeam_both .and. .not. abs(support%gap) > 0.0_wp) then
            slope = law_slope(support%law, support%parameter, 0.0_wp)
        end if
    end subroutine force_and_slope

    !> Deflection of the beam at a support
    pure function deflection_at(assembled, deflection, support) result(value)
        type(assembled_type), intent(in) :: assembled
        !> Of the nodes in the engine's units, shape (0:n); and a support of the model
        real(wp), intent(in) :: deflection(0:)
        integer, intent(in) :: support
        real(wp) :: value

        value = scale(deflection(assembled%beam%supports(assembled%beam_support(support))%node), assembled%units%deflection)
    end function deflection_at

    !> Deflections of the beam at all supports with smooth laws
    pure function deflections_at_curves(assembled, deflection) result(found)
        type(assembled_type), intent(in) :: assembled
        !> As for deflection_at
        real(wp), intent(in) :: deflection(0:)
        real(wp), allocatable :: found(:)
        integer :: j

        associate (numbers => smooth_supports(assembled))
            found = [(deflection_at(assembled, deflection, numbers(j)), j=1, size(numbers))]
        end associate
    end function deflections_at_curves

    !> The largest deflection of the beam at its nodes, either way
    pure function largest_deflection(assembled, deflection) result(value)
        type(assembled_type), intent(in) :: assembled
        !> As for deflection_at
        real(wp), intent(in) :: deflection(0:)
        real(wp) :: value

        value = scale(maxval(abs(deflection(:size(assembled%beam%links)))), assembled%units%deflection)
    end function largest_deflection

    !> Reaction of a support, up
    pure function reaction_at(assembled, reaction, support) result(value)
        type(assembled_type), intent(in) :: assembled
        !> Of the beam's supports in the engine's units; and a support of the model
        real(wp), intent(in) :: reaction(:)
        integer, intent(in) :: support
        real(wp) :: value

        associate (first => assembled%beam_support(support))
            value = scale(sum(reaction(first:last_breakpoint(assembled%beam%supports, first))), assembled%units%force)
        end associate
    end function reaction_at

    !> Put a line in place of a law: on both sides of all its breakpoints
    pure subroutine put_line(assembled, support, deflection, force, slope, lines)
        type(assembled_type), intent(in) :: assembled
        !> A support of the model
        integer, intent(in) :: support
        !> A point of the line, force up, and the slope
        real(wp), intent(in) :: deflection, force, slope
        !> The beam's supports
        type(node_support_type), intent(inout) :: lines(:)
        integer :: first, last

        first = assembled%beam_support(support)
        last = last_breakpoint(lines, first)
        associate (s => lines(first:last), side => assembled%model%supports(support)%side, units => assembled%units)
            s%contact = scale(deflection, -units%deflection)
            s%force = scale(force*merge(1, side, side == gapbeam_both), -units%force)
            s%stiffness = scale(slope, -stiffness_unit(units))
            s%before = s(1)%stiffness
            s%passed = s%breakpoint > 0
        end associate
    end subroutine put_line

    !> Put the pieces that act in a scheme in place of their laws, as lines: the scheme may be that of another load factor, and
    !> pieces near the origin are narrower than the places of their ends are exact
    pure subroutine put_pieces(assembled, supports, closed, lines)
        type(assembled_type), intent(in) :: assembled
        !> Of the model, with smooth laws
        integer, intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        !> The beam's supports
        type(node_support_type), intent(inout) :: lines(:)
        integer :: j

        do j = 1, size(supports)
            associate (first => assembled%beam_support(supports(j)))
                associate (last => last_breakpoint(lines, first))
                    call extend_piece(lines(first:last), closed(first:last), .false.)
                end associate
            end associate
        end do
    end subroutine put_pieces

end module gapbeam_smooth_laws
