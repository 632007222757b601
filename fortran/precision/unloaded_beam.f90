!> Compressed beams on which no load acts: what only touches them holds them one way, and they may buckle the other way.
module gapbeam_unloaded_beam
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: mode_parts
    use gapbeam_tolerances, only: little_compression
    use gapbeam_law_margins, only: let_go
    use gapbeam_ground, only: ground_type
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
    !> pieces of their laws. Those that a mode would press into, one way or the other, are kept in the next ones
    subroutine leave_supports(ground, solution, most, start, share, mode, leaves)
        !> The beam under its axial forces, and its state
        type(ground_type), intent(in) :: ground
        type(ground_solution_type), intent(in) :: solution
        !> Up to which share is looked
        real(wp), intent(in) :: most
        !> Its zones and the states of its supports in; those in the mode out
        type(ground_start_type), intent(inout) :: start
        real(wp), intent(out) :: share
        !> Deflections in it, the way in which it leaves, shape (0:n)
        real(wp), allocatable, intent(out) :: mode(:)
        !> Is there one
        logical, intent(out) :: leaves
        type(mode_shape_type) :: shape
        logical :: now(size(start%closed)), free(size(start%closed)), closed(size(start%closed), most_schemes_left), lost
        logical :: wrong(size(start%closed))
        real(wp) :: value(1)
        integer :: at, number, found, way, k

        leaves = .false.
        share = most
        now(:) = start%closed
        if (is_loaded(ground, solution)) return
        free(:) = now
        call let_go(ground%beam%supports, solution%deflection, solution%reaction, 0.0_wp, free)
        number = 1
        closed(:, 1) = free
        at = 0
        do while (at < number .and. share > 0.0_wp)
            at = at + 1
            if (all(closed(:, at) .eqv. now)) cycle
            call find_mode_values(ground, start%zones, closed(:, at), solution%factor, by_axial_force, min(share, 1.0_wp), value, &
                                  found, lost)
            if (found == 0) cycle
            if (value(1) >= share) cycle
            ! What turns freely gives way under next to nothing
            call find_mode_shape(ground, start%zones, closed(:, at), solution%factor, by_axial_force, &
                                 max(value(1), little_compression), mode_parts, shape)
            if (size(shape%piece) == 0) cycle
            do way = -1, 1, 2
                wrong(:) = .false.
                do k = 1, size(now)
                    if (closed(k, at) .eqv. now(k)) cycle
                    associate (s => ground%beam%supports(k))
                        wrong(k) = merge(-way, way, now(k))*s%side*shape%at_nodes(s%node) < -no_deflection
                    end associate
                end do
                if (.not. any(wrong)) then
                    leaves = .true.
                    share = merge(value(1), 0.0_wp, value(1) > tiny(1.0_wp)/epsilon(1.0_wp))
                    mode = way*shape%at_nodes
                    start%closed(:) = closed(:, at)
                    exit
                else if (number < most_schemes_left) then
                    number = number + 1
                    closed(:, number) = merge(now, closed(:, at), wrong)
                end if
            end do
        end do
    end subroutine leave_supports

    !> Acts any load, or anything else by which supports push
    function is_loaded(ground, solution) result(it_is)
        type(ground_type), intent(in) :: ground
        type(ground_solution_type), intent(in) :: solution
        logical :: it_is
        type(fine_ground_type) :: fine
        real(wp) :: force, way, modulus
        integer :: k

        it_is = any(abs(solution%reaction) > 0.0_wp)
        if (it_is) return
        call refine_ground(ground, fine)
        do k = 0, 1
            ! Beside loads that grow a state without any is what those under some of them come to
            call size_of_loads(fine, solution%factor + k, force, way, modulus)
            it_is = it_is .or. force > 0.0_wp
        end do
    end function is_loaded

end module gapbeam_unloaded_beam
