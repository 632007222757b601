!> Supports that hold a motion of the beam, block it, or let it go on for a while.
module gapbeam_law_kinematics
    use gapbeam_kinds, only: wp
    use gapbeam_polyline, only: node_support_type, piece_that_acts
    use gapbeam_law, only: both
    implicit none
    private
    public :: mark_held, find_level_forces, find_free_level, outermost, is_blocked, lets_go_beyond, leaves_all, distance_to_contact

contains

    !> Mark the nodes that acting supports hold, rigidly or not
    pure subroutine mark_held(supports, acting, held)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: acting(:)
        !> Shape (0:n)
        logical, intent(inout) :: held(0:)
        real(wp) :: slope
        logical :: acts
        integer :: k

        do k = 1, size(supports)
            if (supports(k)%breakpoint > 0) then
                call piece_that_acts(supports, acting, k, acts, slope)
                if (acts .and. abs(slope) > 0.0_wp) held(supports(k)%node) = .true.
            else if (acting(k) .and. supports(k)%stiffness > 0.0_wp) then
                held(supports(k)%node) = .true.
            end if
        end do
    end subroutine mark_held

    !> Forces of the supports that act on a level piece of their law, up: what they take does not depend on the deflection
    pure subroutine find_level_forces(supports, acting, force)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: acting(:)
        !> Of the nodes, shape (0:n)
        real(wp), intent(out) :: force(0:)
        real(wp) :: slope
        logical :: acts
        integer :: k

        force(:) = 0.0_wp
        do k = 1, size(supports)
            if (supports(k)%breakpoint == 0) cycle
            call piece_that_acts(supports, acting, k, acts, slope)
            if (.not. acts .or. abs(slope) > 0.0_wp) cycle
            associate (s => supports(k))
                force(s%node) = force(s%node) + s%side*s%force
            end associate
        end do
    end subroutine find_level_forces

    !> A deflection of the whole beam at which it touches none of its supports, where all of them act to one side
    pure subroutine find_free_level(supports, level, there_is)
        type(node_support_type), intent(in) :: supports(:)
        real(wp), intent(out) :: level
        !> Is there one: no support holds both ways or has a law, and none stands on the other side
        logical, intent(out) :: there_is
        real(wp) :: nearest, farthest
        integer :: k, side

        level = 0.0_wp
        side = both
        nearest = huge(nearest)
        farthest = -huge(farthest)
        there_is = .false.
        do k = 1, size(supports)
            associate (s => supports(k))
                if (s%breakpoint > 0 .or. (s%side == both .and. s%stiffness > 0.0_wp) .or. s%side == -side &
                    .and. side /= both) return
                if (.not. s%stiffness > 0.0_wp) cycle
                side = s%side
                nearest = min(nearest, side*s%contact)
                farthest = max(farthest, side*s%contact)
            end associate
        end do
        there_is = side /= both
        if (there_is) level = side*(nearest - (farthest - nearest)/16)
    end subroutine find_free_level

    !> First and last node at which supports of a side can carry; the first is beyond the last if there are none
    pure function outermost(supports, side) result(nodes)
        type(node_support_type), intent(in) :: supports(:)
        !> below, above or both
        integer, intent(in) :: side
        integer :: nodes(2), k

        nodes = [huge(0), -1]
        do k = 1, size(supports)
            associate (s => supports(k))
                if (s%side == side .and. s%stiffness > 0.0_wp) nodes = [min(nodes(1), s%node), max(nodes(2), s%node)]
            end associate
        end do
    end function outermost

    !> Is a motion towards any support, closed or open
    pure function is_blocked(supports, displacement) result(blocked)
        type(node_support_type), intent(in) :: supports(:)
        !> Of the nodes, shape (0:n)
        real(wp), intent(in) :: displacement(0:)
        logical :: blocked
        integer :: k

        blocked = .false.
        do k = 1, size(supports)
            associate (s => supports(k), y => displacement(supports(k)%node))
                blocked = s%stiffness > 0.0_wp .and. (s%side*y > 0.0_wp .or. (s%side == both .and. abs(y) > 0.0_wp))
                ! A law that holds both ways begins with a piece without end
                blocked = blocked .or. (s%breakpoint == 1 .and. s%before > 0.0_wp .and. s%side*y < 0.0_wp)
            end associate
            if (blocked) return
        end do
    end function is_blocked

    !> Does a breakpoint let go beyond it, as the end of a slack that a law has on its other side
    elemental function lets_go_beyond(support) result(it_does)
        type(node_support_type), intent(in) :: support
        logical :: it_does

        it_does = support%breakpoint > 0 .and. .not. (abs(support%stiffness) > 0.0_wp .or. abs(support%force) > 0.0_wp) &
            .and. abs(support%before) > 0.0_wp
    end function lets_go_beyond

    !> Is a motion towards none of some supports
    pure function leaves_all(supports, chosen, displacement, way) result(leaves)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: chosen(:)
        !> Displacements of the nodes, shape (0:n), and 1 or -1 for the motion or its opposite
        real(wp), intent(in) :: displacement(0:)
        integer, intent(in) :: way
        logical :: leaves
        integer :: k

        leaves = .true.
        do k = 1, size(chosen)
            associate (s => supports(k))
                if (.not. chosen(k)) cycle
                if (lets_go_beyond(s)) then
                    leaves = leaves .and. way*s%side*displacement(s%node) >= 0.0_wp
                else
                    leaves = leaves .and. way*s%side*displacement(s%node) <= 0.0_wp
                end if
            end associate
        end do
    end function leaves_all

    !> How far a motion can go until one of some supports closes; huge if none does
    pure function distance_to_contact(supports, numbers, closed, direction, deflection, least_speed) result(way)
        !> All supports, the numbers of those in question, and the scheme
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: numbers(:)
        logical, intent(in) :: closed(:)
        !> The motion and where it starts, shape (0:n)
        real(wp), intent(in) :: direction(0:), deflection(0:)
        !> What is not faster stands still
        real(wp), intent(in) :: least_speed
        real(wp) :: way, speed
        integer :: j

        way = huge(way)
        do j = 1, size(numbers)
            associate (s => supports(numbers(j)))
                speed = s%side*direction(s%node)
                if (closed(numbers(j)) .and. s%breakpoint > 0) then
                    ! Back to where the piece before takes more force
                    if (-speed > least_speed .and. s%before > 0.0_wp) then
                        way = min(way, max(0.0_wp, s%side*(s%contact - deflection(s%node))/speed))
                    end if
                    cycle
                end if
                if (closed(numbers(j)) .or. .not. speed > least_speed .or. .not. s%stiffness > 0.0_wp) cycle
                way = min(way, max(0.0_wp, s%side*(s%contact - deflection(s%node))/speed))
            end associate
        end do
    end function distance_to_contact

end module gapbeam_law_kinematics
