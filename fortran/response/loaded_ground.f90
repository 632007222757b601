!> The beam with the ground under it, its supports and its axial forces, where they are at a load factor.
module gapbeam_loaded_ground
    use gapbeam_kinds, only: wp
    use gapbeam_ground, only: ground_type
    use gapbeam_moved_ground, only: move_ground
    use gapbeam_axial_tension, only: tensions_of_loads, changes_of_tension
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
        logical :: grows, stretches
        integer :: i

        ground%beam = assembled%beam
        stretches = .false.
        if (present(state)) then
            stretches = allocated(state%stretched)
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
                allocate (moving%tension(2, size(ground%pieces)))
                moving%tension(1, :) = ground%pieces%tension
                moving%tension(2, :) = 0.0_wp
                if (allocated(assembled%tension_growth)) then
                    moving%tension(1, :) = ground%pieces%tension - assembled%tension_growth
                    moving%tension(2, :) = assembled%tension_growth
                end if
                if (assembled%model%axial_loads_bend) then
                    if (stretches) then
                        moving%tension(:, :) = moving%tension + tensions_of_loads(assembled, state%stretched)
                    else
                        moving%tension(:, :) = moving%tension + tensions_of_loads(assembled)
                    end if
                    if (allocated(assembled%axial%along_bar)) then
                        moving%tension_change = changes_of_tension(assembled)
                        moving%tension(:, :) = moving%tension - moving%tension_change/2
                    end if
                end if
            end if
        end associate
        call move_ground(ground, factor)
    end function ground_of

end module gapbeam_loaded_ground
