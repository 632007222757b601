!> The beam whose history is followed: its links, or the stretches that it is solved in on elastic ground and under axial forces.
!>
!> Ground that holds both ways by its modulus alone acts everywhere at all times, and axial forces that do not grow with the load
!> only change how stiff the stretches are. Then what changes along the path are supports, as on a beam without these.
module gapbeam_history_beam
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_memory, only: reserve_memory, for_ground, for_following_closely
    use gapbeam_input_error, only: refuse, of_supports, of_foundations, bad_law
    use gapbeam_axial_force, only: what_stretches
    use gapbeam_law, only: both
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: node_support_type, last_breakpoint
    use gapbeam_layers, only: layer_type, has_points
    use gapbeam_model_quad, only: beam_type
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, zones_type, grounded_type, full_contact, place_stretches
    use gapbeam_refined, only: refine_beam
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_extended_precision, only: reserve_for
    use gapbeam_uniqueness, only: is_unique
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_state, only: detail_of
    implicit none
    private
    public :: make_history_beam

contains

    !> Make the beam of a history, in quadruple precision
    subroutine make_history_beam(assembled, beam, node, error)
        type(assembled_type), intent(in), target :: assembled
        !> At load factor 0
        type(beam_type), intent(out) :: beam
        !> Its node for every node of the beam as it was given, shape (0:n); not allocated where these are the same
        integer, allocatable, intent(out) :: node(:)
        !> A beam in stretches that change along the path, or with smooth laws; or no memory
        type(error_type), allocatable, intent(out) :: error
        type(ground_type) :: ground, held
        type(fine_ground_type) :: fine
        type(zones_type) :: zones
        type(grounded_type) :: grounded

        call reserve_for(for_following_closely, assembled%beam, detail_of(assembled), error)
        if (allocated(error)) return
        if (.not. allocated(assembled%layers)) then
            call refine_beam(assembled%beam, detail_of(assembled), beam)
            return
        end if
        call check_supports(assembled, error)
        if (.not. allocated(error)) call check_stretches(assembled, error)
        if (.not. allocated(error)) call reserve_memory(for_ground, size(assembled%pieces), size(assembled%beam%supports), 0, error)
        if (allocated(error)) return
        ground = ground_of(assembled, 0.0_wp)
        held = ground
        call leave_out_falling(held%beam%supports)
        if (.not. is_unique(held)) then
            call fatal_error(error, gapbeam_bad_input, "a history, or supports that yield or that loads move, are "// &
                             "followed only where the compressed beam (N below 0) is stable with all supports that yield or "// &
                             "act one way open; press less, or give it more supports that hold it both ways")
            return
        end if
        call refine_ground(ground, fine)
        call full_contact(fine, zones)
        call place_stretches(fine, zones, 0.0_qp, grounded)
        beam = grounded%beam
        allocate (node(0:ubound(grounded%node, 1)), source=grounded%node)
    end subroutine make_history_beam

    !> Smooth laws are refused in stretches
    subroutine check_supports(assembled, error)
        type(assembled_type), intent(in) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        do k = 1, size(assembled%normal)
            associate (number => assembled%normal(k), given => assembled%model%supports)
                if (.not. is_smooth(given(number)%law)) cycle
                call refuse(error, of_supports, number, size(given), bad_law, "law", "a curve with a history, or with a "// &
                            "support that keeps a set, beside "//trim(what_stretches(assembled%model))//" is not available "// &
                            "in this version; give its points")
                return
            end associate
        end do
    end subroutine check_supports

    !> Supports whose force falls hold nothing for sure
    pure subroutine leave_out_falling(supports)
        type(node_support_type), intent(inout) :: supports(:)
        integer :: first, last

        last = 0
        do while (last < size(supports))
            first = last + 1
            last = last_breakpoint(supports, first)
            associate (law => supports(first:last))
                if (.not. min(minval(law%stiffness), minval(law%before)) < 0.0_wp) cycle
                law%stiffness = 0.0_wp
                law%before = 0.0_wp
                law%force = 0.0_wp
            end associate
        end do
    end subroutine leave_out_falling

    !> Ground and axial forces that change along the path are refused
    subroutine check_stretches(assembled, error)
        type(assembled_type), intent(in) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        if (allocated(assembled%tension_growth) .or. assembled%model%axial_loads_bend) then
            call fatal_error(error, gapbeam_bad_input, "a history is followed beside axial forces only that do not grow with "// &
                             "the load; give N with N_with dead, or first_order")
            return
        end if
        do k = 1, size(assembled%layers)
            if (is_steady(assembled%layers(k))) cycle
            call refuse(error, of_foundations, assembled%layers(k)%foundation, size(assembled%model%foundations), bad_law, "", &
                        "a history is followed beside ground only that holds the beam both ways by k alone, without gap, "// &
                        "profile and law; give such ground, or leave out the history and what of the supports depends on it")
            return
        end do
        if (.not. allocated(assembled%layer_growth)) return
        call fatal_error(error, gapbeam_bad_input, "a load that moves a foundation beside a history is not available in this "// &
                         "version; move supports, or leave out the history and what of the supports depends on it")
    end subroutine check_stretches

    !> Does ground do the same at all times
    elemental function is_steady(layer) result(it_is)
        type(layer_type), intent(in) :: layer
        logical :: it_is

        it_is = layer%side == both .and. has_points(layer) .and. layer%law_last < layer%law_first .and. .not. layer%rigid &
            .and. .not. max(abs(layer%contact_a), abs(layer%contact_b)) > 0.0_wp
    end function is_steady

end module gapbeam_history_beam
