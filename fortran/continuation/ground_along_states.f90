!> States of a beam on ground along its axis at load factors on a path, and their audit.
module gapbeam_ground_along_states
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: slip_audited
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_ground_along, only: ground_along_type, rates_type, first_parts, length_of, force_in
    use gapbeam_ground_along_slip, only: find_motion
    use gapbeam_ground_along_path, only: go_to_change
    use gapbeam_history_record, only: history_type
    use gapbeam_solution, only: state_type
    use gapbeam_bedding_state, only: refuse_misfit
    implicit none
    private
    public :: take_ground_along

contains

    !> What there is along the beam at a load factor on a stretch
    subroutine take_ground_along(beam, history, stretch, factor, state, error)
        !> With the loads of the leg: its dead ones as live ones while these are put on
        type(assembled_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        integer, intent(in) :: stretch
        real(wp), intent(in) :: factor
        !> Of the same beam
        type(state_type), intent(inout) :: state
        !> It does not stand its audit
        type(error_type), allocatable, intent(out) :: error
        type(ground_along_type) :: ground
        type(rates_type) :: rates
        real(wp), allocatable :: longer(:)
        real(wp) :: at, way, gone
        integer :: first(size(beam%axial%limit) + 1), i, k, idle
        logical :: settled

        associate (known => history%along%on_ground, s => history%stretches(stretch))
            k = 0
            do i = 1, history%along%number
                if (known(i)%stretch > stretch) exit
                ! Of a stretch that is passed in a jump there is one only
                if (known(i)%stretch < stretch .or. k == 0) k = i
                if (known(i)%stretch == stretch .and. (factor - known(i)%factor)*(s%to - s%from) >= 0.0_wp) k = i
            end do
            ground = known(k)%ground
            way = abs(factor - known(k)%factor)
            at = factor
            ! While the beam jumps nothing changes along it
            if (known(k)%stretch < stretch .or. s%skipped) then
                way = 0.0_wp
                at = known(k)%factor
            end if
        end associate
        ! As the path itself goes: a part may end by rounding; what does not get there the audit tells
        idle = 0
        do while (way > 0.0_wp .and. idle <= size(ground%parts))
            call find_motion(ground, rates, settled)
            call go_to_change(ground, rates, way, gone)
            idle = merge(0, idle + 1, gone > 0.0_wp)
            way = way - gone
        end do
        associate (axial => beam%axial)
            state%displacement(:) = ground%displacement
            state%tension(:) = least_forces(ground)
            state%axial_reaction(:) = -axial%force(1, :) - at*axial%force(2, :)
            first(:) = first_parts(ground)
            associate (reaction => state%axial_reaction(0:), n => size(ground%limit))
                reaction(2:) = reaction(2:) + ground%parts(first(2:) - 1)%force &
                    + ground%parts(first(2:) - 1)%slope*ground%limit
                reaction(:n) = reaction(:n) - ground%parts(first(:n))%force
            end associate
            allocate (longer(size(axial%limit)), source=0.0_wp)
            if (allocated(axial%elongation)) longer(:) = axial%elongation(1, :) + at*axial%elongation(2, :)
            call refuse_misfit(misfit(ground, longer, state%axial_reaction), slip_audited, factor, error)
        end associate
        state%along_ground = ground
    end subroutine take_ground_along

    !> Smallest axial force of every bar
    pure function least_forces(ground) result(least)
        type(ground_along_type), intent(in) :: ground
        real(wp) :: least(size(ground%limit))
        integer :: k

        least(:) = huge(1.0_wp)
        do k = 1, size(ground%parts)
            associate (part => ground%parts(k))
                least(part%bar) = min(least(part%bar), force_in(ground, k, part%to), &
                                      force_in(ground, k, part%to - length_of(ground, k)))
            end associate
        end do
    end function least_forces

    !> What is off, relative to the largest: lengths of bars beside displacements of their nodes, forces where parts meet, reactions
    pure function misfit(ground, free, reaction) result(worst)
        type(ground_along_type), intent(in) :: ground
        !> What the loads give, however the state was come to: elongations of the bars without force, and forces of the supports
        real(wp), intent(in) :: free(:), reaction(0:)
        real(wp) :: worst, longer(size(ground%limit)), most, way
        integer :: i, k

        most = max(maxval(abs(ground%parts%force)), maxval(ground%limit), maxval(abs(reaction)))
        way = max(maxval(abs(ground%displacement)), most*maxval(ground%softness), maxval(abs(free)))
        longer(:) = free
        worst = 0.0_wp
        do k = 1, size(ground%parts)
            associate (part => ground%parts(k), j => ground%parts(k)%bar)
                longer(j) = longer(j) &
                    + ground%softness(j)*length_of(ground, k)*force_in(ground, k, part%to - length_of(ground, k)/2)
                if (k == size(ground%parts)) cycle
                if (ground%parts(k + 1)%bar /= j) cycle
                worst = max(worst, abs(force_in(ground, k, part%to) - force_in(ground, k + 1, part%to))/most)
            end associate
        end do
        do i = 1, size(longer)
            worst = max(worst, abs(ground%displacement(i) - ground%displacement(i - 1) - longer(i))/way)
        end do
        do i = 0, size(longer)
            if (ground%stiffness(i) > huge(most)) then
                worst = max(worst, abs(ground%displacement(i))/way)
            else
                worst = max(worst, abs(reaction(i) + ground%stiffness(i)*ground%displacement(i))/most)
            end if
        end do
    end function misfit

end module gapbeam_ground_along_states
