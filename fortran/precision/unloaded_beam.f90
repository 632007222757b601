!> Compressed beams on which no load acts: supports and ground that only touch them hold them one way, and they may buckle the
!> other way.
module gapbeam_unloaded_beam
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: mode_parts
    use gapbeam_tolerances, only: little_compression
    use gapbeam_law_margins, only: let_go
    use gapbeam_law, only: both
    use gapbeam_ground, only: ground_type, zones_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_modes, only: by_axial_force, mode_shape_type, find_mode_shape
    use gapbeam_mode_values, only: find_mode_values
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_ground_ties, only: size_of_loads
    implicit none
    private
    public :: leave_supports

    !> Part of the greatest deflection of a mode that is none: half of its digits
    real(wp), parameter :: no_deflection = sqrt(epsilon(1.0_wp))
    !> Schemes in which modes are looked for: all of them where six supports touch
    integer, parameter :: most_schemes_left = 64

contains

    !> Look for the least share of the axial forces under which a beam buckles away from supports without force, or on to flatter
    !> pieces of their laws, and off ground. What a mode would press into, one way or the other, is kept in the next ones
    subroutine leave_supports(ground, solution, share, start, mode, leaves)
        !> The beam under its axial forces, and its state
        type(ground_type), intent(in) :: ground
        type(ground_solution_type), intent(in) :: solution
        !> Up to which share is looked in; where there is one, the least out
        real(wp), intent(inout) :: share
        !> Its zones and the states of its supports in; those in the mode out
        type(ground_start_type), intent(inout) :: start
        !> Deflections in it at the places of a mode_shape_type, the way in which it leaves
        real(wp), allocatable, intent(out) :: mode(:)
        !> Is there one
        logical, intent(out) :: leaves
        type(mode_shape_type) :: shape
        type(zones_type) :: zones, best
        logical :: now(size(start%closed)), closed(size(start%closed), most_schemes_left), wrong(size(start%closed))
        !> Does the ground that acts one way act in a scheme, and would a mode press into it
        logical :: on_ground(most_schemes_left), presses, lost
        real(wp) :: value(1)
        integer :: at, number, found, way, k

        leaves = .false.
        if (is_loaded(ground, solution)) return
        now(:) = start%closed
        closed(:, 1) = now
        call let_go(ground%beam%supports, solution%deflection, solution%reaction, 0.0_wp, closed(:, 1))
        on_ground(1) = .false.
        number = 1
        at = 0
        do while (at < number .and. share > 0.0_wp)
            at = at + 1
            zones = start%zones
            if (.not. on_ground(at)) zones = off_ground(ground, zones)
            if (all(closed(:, at) .eqv. now) .and. all(zones%acts == start%zones%acts)) cycle
            call find_mode_values(ground, zones, closed(:, at), solution%factor, by_axial_force, min(share, 1.0_wp), value, found, &
                                  lost)
            if (found == 0) cycle
            if (value(1) >= share) cycle
            ! What turns freely gives way under next to nothing
            call find_mode_shape(ground, zones, closed(:, at), solution%factor, by_axial_force, &
                                 max(value(1), little_compression), mode_parts, shape)
            if (size(shape%piece) == 0) cycle
            do way = -1, 1, 2
                do k = 1, size(now)
                    associate (s => ground%beam%supports(k))
                        wrong(k) = (closed(k, at) .neqv. now(k)) .and. &
                            merge(-way, way, now(k))*s%side*shape%at_nodes(s%node) < -no_deflection
                    end associate
                end do
                presses = .not. on_ground(at) .and. mode_presses(ground, shape, way)
                if (.not. (presses .or. any(wrong))) then
                    leaves = .true.
                    share = value(1)
                    mode = way*shape%deflection
                    start%closed(:) = closed(:, at)
                    best = zones
                    exit
                else if (number < most_schemes_left) then
                    number = number + 1
                    closed(:, number) = merge(now, closed(:, at), wrong)
                    on_ground(number) = on_ground(at) .or. presses
                end if
            end do
        end do
        if (leaves) start%zones = best
    end subroutine leave_supports

    !> Zones without the ground that acts one way
    pure function off_ground(ground, zones) result(left)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        type(zones_type) :: left
        integer :: i, k

        left = zones
        do i = 1, size(zones%piece)
            associate (j => zones%piece(i))
                do k = ground%first(j), ground%first(j + 1) - 1
                    if (ground%layers(k)%side /= both) left%acts(k - ground%first(j) + 1, i) = 0
                end do
            end associate
        end do
    end function off_ground

    !> Does a mode, one way, go into ground that acts one way
    pure function mode_presses(ground, shape, way) result(presses)
        type(ground_type), intent(in) :: ground
        type(mode_shape_type), intent(in) :: shape
        !> 1 or -1
        integer, intent(in) :: way
        logical :: presses
        integer :: i, k

        presses = .false.
        do i = 1, size(shape%piece)
            do k = ground%first(shape%piece(i)), ground%first(shape%piece(i) + 1) - 1
                presses = presses .or. way*ground%layers(k)%side*shape%deflection(i) > no_deflection
            end do
        end do
    end function mode_presses

    !> Acts any load, or anything else by which supports push
    function is_loaded(ground, solution) result(it_is)
        type(ground_type), intent(in) :: ground
        type(ground_solution_type), intent(in) :: solution
        logical :: it_is
        type(fine_ground_type) :: fine
        real(wp) :: force, way, modulus
        integer :: k

        it_is = any(ground%layers%rigid) .or. any(abs(solution%reaction) > 0.0_wp) .or. any(abs(solution%resultant) > 0.0_wp)
        if (it_is) return
        call refine_ground(ground, fine)
        do k = 0, 1
            ! Beside loads that grow a state without any is what those under some of them come to
            call size_of_loads(fine, solution%factor + k, force, way, modulus)
            it_is = it_is .or. force > 0.0_wp
        end do
    end function is_loaded

end module gapbeam_unloaded_beam
