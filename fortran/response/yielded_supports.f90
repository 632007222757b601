!> Elastic energies and permanent sets of the supports with plastic unloading in a solved state, in the user's units.
module gapbeam_yielded_supports
    use gapbeam_kinds, only: wp
    use gapbeam_model, only: node_support_type, both
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_scene, only: gapbeam_axial, gapbeam_plastic
    use gapbeam_assembled_model, only: assembled_type, way_unit, push_unit
    use gapbeam_solution, only: state_type, displacement_at, level_at, laws_in, laws_along
    implicit none
    private
    public :: yielded_supports

    !> Shares of what a set is the difference of, below which it is rounding
    real(wp), parameter :: rounding = 16*epsilon(1.0_wp)

contains

    !> Energies and sets of all supports, in the order of the model; 0 of those without plastic unloading
    pure subroutine yielded_supports(assembled, state, energy, set, way)
        !> The beam, and its solved state on a loading history
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Elastic energy: force times length, or couple times angle, in the user's units, shape (nsupport)
        real(wp), intent(out) :: energy(:)
        !> Displacement without force, of one side in the direction in which it gives way, else as deflections are positive
        real(wp), intent(out) :: set(:)
        !> Displacement of the beam, less what the support has moved itself
        real(wp), intent(out) :: way(:)
        type(node_support_type), allocatable :: now(:)
        real(wp) :: at_first
        integer :: j, k, last, of_way, of_force

        energy(:) = 0.0_wp
        set(:) = 0.0_wp
        way(:) = 0.0_wp
        if (.not. any(assembled%with_law)) return
        allocate (now, source=laws_in(assembled, state))
        do k = 1, size(energy)
            associate (s => assembled%model%supports(k), axial => assembled%axial)
                if (.not. assembled%with_law(k) .or. s%unloading /= gapbeam_plastic) cycle
                at_first = level_at(assembled, state, k)
                if (s%direction == gapbeam_axial) then
                    if (.not. allocated(state%along)) cycle
                    of_way = axial%units%deflection
                    of_force = axial%units%force
                    j = findloc(axial%support, k, 1)
                    last = last_breakpoint(axial%laws, j)
                    call values_of_law(laws_along(assembled, state, j, last), state%along(j:last), s%side, &
                                       scale(at_first, -of_way), state%displacement(axial%node(k)), -state%along_force(k), &
                                       energy(k), set(k), way(k))
                else
                    j = assembled%beam_support(k)
                    if (j == 0) cycle
                    of_way = way_unit(assembled, k)
                    of_force = push_unit(assembled, k)
                    last = last_breakpoint(now, j)
                    call values_of_law(now(j:last), state%closed(j:last), s%side, scale(at_first, -of_way), &
                                       displacement_at(assembled, state, k), sum(state%reaction(j:last)), energy(k), set(k), way(k))
                end if
                energy(k) = scale(energy(k), of_force + of_way)
                set(k) = scale(set(k), of_way)
                way(k) = scale(way(k), of_way)
            end associate
        end do
    end subroutine yielded_supports

    !> The same of one law
    pure subroutine values_of_law(law, closed, side, at_first, displacement, force, energy, set, way)
        !> Breakpoints as they are now, and which of them act
        type(node_support_type), intent(in) :: law(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: side
        !> Where the law began before it yielded, with what the support has moved itself
        real(wp), intent(in) :: at_first
        !> Of the beam, and what it has for the support, positive together
        real(wp), intent(in) :: displacement, force
        real(wp), intent(out) :: energy, set, way
        real(wp) :: back

        way = displacement - at_first
        if (side == both) then
            energy = energy_of_sliders(law, displacement, way)
            back = force/law(size(law)/2 + 1)%before
            set = way - back
        else
            ! It goes back parallel to its first piece
            back = force/law(1)%stiffness
            energy = force*back/2
            set = side*(law(1)%contact - at_first)
            if (count(closed(:min(2, size(closed)))) == 2) set = side*(way - back)
        end if
        if (abs(set) <= rounding*max(abs(displacement), abs(back), abs(at_first))) set = 0.0_wp
        set = set + 0.0_wp
    end subroutine values_of_law

    !> Of springs with sliders side by side (Iwan 1966): spring i has the stiffness by which piece i is steeper than the next, and
    !> its slider yields where the law bends; the last piece is a spring without slider
    pure function energy_of_sliders(law, displacement, way) result(energy)
        !> Breakpoints as they are now: where each spring yields one way, and in the opposite order the other way
        type(node_support_type), intent(in) :: law(:)
        !> Displacement of the support, and what it has gone from its place without load
        real(wp), intent(in) :: displacement, way
        real(wp) :: energy, reach, stretch
        integer :: i, n

        n = size(law)/2
        energy = 0.0_wp
        do i = n + 1, 2*n
            ! A rigid one has a slider and no spring
            if (.not. law(i)%before <= huge(1.0_wp)) cycle
            ! Half of the way from yielding one way to yielding the other, which never changes
            reach = (law(i)%contact - law(2*n + 1 - i)%contact)/2
            stretch = max(-reach, min(reach, reach - (law(i)%contact - displacement)))
            energy = energy + (law(i)%before - law(i)%stiffness)*stretch**2/2
        end do
        energy = energy + law(2*n)%stiffness*way**2/2
    end function energy_of_sliders

end module gapbeam_yielded_supports
