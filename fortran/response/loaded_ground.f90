!> The beam with the ground under it, its supports and its axial forces, where they are at a load factor.
module gapbeam_loaded_ground
    use gapbeam_kinds, only: wp
    use gapbeam_ground, only: ground_type, moving_type
    use gapbeam_moved_ground, only: move_ground
    use gapbeam_axial_tension, only: tensions_of_loads, changes_of_tension
    use gapbeam_axial_links, only: tensions_of_links
    use gapbeam_assembled_model, only: assembled_type, growth_of
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: ground_of

contains

    !> The beam with the ground under it, where they are at a load factor
    function ground_of(assembled, factor, state) result(ground)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor
        !> In which deflections may lengthen the bars along the axis, and supports have laws of their own
        type(state_type), intent(in), optional :: state
        type(ground_type) :: ground
        logical :: grows
        integer :: i

        ground%beam = assembled%beam
        if (present(state)) then
            if (allocated(state%laws)) ground%beam%supports(:) = state%laws
        end if
        associate (n => size(assembled%pieces))
            allocate (ground%pieces(n), ground%dead(n), ground%live(n), ground%layers(size(assembled%layers)), &
                      ground%first(n + 1), ground%laws(size(assembled%law_pieces)))
        end associate
        ground%pieces(:) = assembled%pieces
        ground%dead(:) = assembled%dead
        ground%live(:) = assembled%live
        ground%layers(:) = assembled%layers
        ground%first(:) = assembled%layer_first
        ground%laws(:) = assembled%law_pieces
        if (size(assembled%mass_point) > 0) then
            allocate (ground%mass(0:size(ground%pieces)), source=0.0_wp)
            do i = 1, size(assembled%mass_point)
                associate (at => assembled%mass_point(i))
                    ground%mass(at) = ground%mass(at) + scale(assembled%model%masses(2, i), &
                                                              assembled%units%deflection - assembled%units%force)
                end associate
            end do
        end if
        grows = allocated(assembled%growth) .or. allocated(assembled%layer_growth) .or. allocated(assembled%tension_growth) &
            .or. assembled%model%axial_loads_bend
        if (.not. grows) return
        allocate (ground%moving)
        associate (moving => ground%moving)
            allocate (moving%supports(2, size(ground%beam%supports)), moving%layers(2, 2, size(ground%layers)), source=0.0_wp)
            moving%supports(1, :) = ground%beam%supports%contact
            moving%supports(2, :) = growth_of(assembled)
            moving%layers(1, 1, :) = ground%layers%contact_a
            moving%layers(1, 2, :) = ground%layers%contact_b
            if (allocated(assembled%layer_growth)) moving%layers(2, :, :) = assembled%layer_growth
            if (allocated(assembled%tension_growth) .or. assembled%model%axial_loads_bend) then
                call let_tensions_grow(assembled, factor, ground%pieces%tension, moving, state)
            end if
        end associate
        call move_ground(ground, factor)
    end function ground_of

    !> Axial forces at all load factors
    subroutine let_tensions_grow(assembled, factor, given, moving, state)
        type(assembled_type), intent(in) :: assembled
        !> The load factor at hand
        real(wp), intent(in) :: factor
        !> Tensions of the pieces at load factor 1 that are not those of loads, shape (n)
        real(wp), intent(in) :: given(:)
        type(moving_type), intent(inout) :: moving
        !> As for ground_of
        type(state_type), intent(in), optional :: state
        real(wp) :: alone(2, size(given))
        integer :: k

        alone(1, :) = given
        alone(2, :) = 0.0_wp
        if (allocated(assembled%tension_growth)) then
            alone(1, :) = given - assembled%tension_growth
            alone(2, :) = assembled%tension_growth
        end if
        if (assembled%model%axial_loads_bend .and. allocated(assembled%axial%laws)) then
            call tensions_of_links(assembled, sign(max(1.0_wp, abs(factor)), factor), moving%begins, moving%tension)
        else
            allocate (moving%begins(1), moving%tension(2, size(given), 1), source=0.0_wp)
            if (assembled%model%axial_loads_bend) then
                if (present(state)) then
                    moving%tension(:, :, 1) = tensions_of_loads(assembled, state%stretched)
                else
                    moving%tension(:, :, 1) = tensions_of_loads(assembled)
                end if
            end if
        end if
        if (assembled%model%axial_loads_bend .and. allocated(assembled%axial%along_bar)) then
            moving%tension_change = changes_of_tension(assembled)
        end if
        do k = 1, size(moving%begins)
            associate (tension => moving%tension(:, :, k), begins => moving%begins(k))
                tension(:, :) = alone + tension
                tension(1, :) = tension(1, :) + begins*alone(2, :)
                if (.not. allocated(moving%tension_change)) cycle
                tension(:, :) = tension - moving%tension_change/2
                tension(1, :) = tension(1, :) - begins*moving%tension_change(2, :)/2
            end associate
        end do
    end subroutine let_tensions_grow

end module gapbeam_loaded_ground
