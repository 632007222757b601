!> Loads that no ground can bear: limit analysis of a beam without hinges.
!>
!> A beam that moves as a rigid body is resisted by nothing but supports and ground. If along some motion the loads do more work
!> than all that resists it ever can, ground at its limit force, there is no equilibrium: that motion is the proof, however
!> stiff or weak the beam is (the upper bound theorem: Drucker, Prager, Greenberg 1952). Next to the limit load, where neither
!> zones nor springs tell, this does.
module gapbeam_ground_limit
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_motion_steps
    use gapbeam_tolerances, only: no_ground_work, fine_rounding, near_motion
    use gapbeam_watch, only: is_stopped
    use gapbeam_nodes, only: hinge, restrained
    use gapbeam_line_search_quad, only: bracket_type, place_inside, narrow
    use gapbeam_ground_quad, only: ground_type
    use gapbeam_layers_quad, only: layer_type, has_limit, has_points
    use gapbeam_kinematics_quad, only: work_of_loads
    implicit none
    private
    public :: find_collapse, find_limit

    !> Displacements of the two ends of the beam: all motions are a positive number times one of start + t way, -1 <= t <= 1
    real(qp), parameter :: start(2, 4) = reshape([1, 0, -1, 0, 0, 1, 0, -1], [2, 4]), &
        way(2, 4) = reshape([0, 1, 0, 1, 1, 0, 1, 0], [2, 4])

contains

    !> Look for a motion of the whole beam along which the loads do more work than is resisted
    pure subroutine find_collapse(ground, factor, found, tied, stands, motion)
        !> The beam and its ground, and the load factor
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: factor
        !> Is there one; or is there one along which both are the same to rounding; or do the loads do less along all, so that there
        !> is an equilibrium. Never of a beam with hinges
        logical, intent(out) :: found, tied, stands
        !> Downward displacements of the nodes of the beam without ground along it, largest 1, shape (0:n); if there is none, along
        !> one on which neither loads nor ground do any work, not allocated if there is none either
        real(wp), allocatable, intent(out) :: motion(:)
        real(qp) :: share(0:size(ground%pieces)), work(2), parts(2), y(2), best(2), excess, most, resisted, least, low, high
        integer :: k

        found = .false.
        tied = .false.
        stands = .false.
        if (any(ground%beam%kind == hinge)) return
        share(0) = 0.0_qp
        do k = 1, size(ground%pieces)
            share(k) = share(k - 1) + ground%pieces(k)%length
        end do
        share = share/share(size(ground%pieces))
        call work_of_loads(ground%beam, factor, 1 - share, [0, size(ground%pieces)], work(1), parts(1))
        call work_of_loads(ground%beam, factor, share, [0, size(ground%pieces)], work(2), parts(2))
        most = 0.0_qp
        best = 0.0_qp
        ! What supports that hold rotations resist is not looked into
        stands = .not. allocated(ground%beam%turning)
        do k = 1, size(start, 2)
            call find_allowed(ground, share, start(:, k), way(:, k), low, high)
            if (any(ground%beam%kind == restrained) .or. allocated(ground%beam%turning) &
                .or. sum((ground%pieces%tension + ground%pieces%tension_change/2)*ground%pieces%length) > 0.0_qp) then
                ! Down or up as a whole, both ends by as much: tension keeps its direction, and resists rotations however great
                low = max(low, sum(start(:, k)))
                high = min(high, sum(start(:, k)))
                if (k > 2) cycle
            end if
            if (low > high) cycle
            y = start(:, k) + way(:, k)*most_work(ground, share, work, start(:, k), way(:, k), low, high)
            resisted = dot_product(y, resistance(ground, share, y))
            excess = dot_product(y, work) - resisted
            least = merge(fine_rounding, no_ground_work, resisted > 0.0_qp)*(sum(parts) + resisted)
            tied = tied .or. abs(excess) <= least
            if (abs(excess) <= least .and. .not. max(most, resisted) > 0.0_qp) best = y
            stands = stands .and. excess < -least
            if (excess <= max(most, least)) cycle
            most = excess
            best = y
        end do
        found = most > 0.0_qp
        if (.not. any(abs(best) > 0.0_qp)) return
        share = best(1) + share*(best(2) - best(1))
        where (abs(share) <= fine_rounding) share = 0.0_qp
        allocate (motion(0:size(ground%pieces)), source=real(share/maxval(abs(share)), wp))
    end subroutine find_collapse

    !> Between two load factors, neighbours in double precision of which the loads of the first one are borne, and of the second not
    subroutine find_limit(ground, low, high, found)
        type(ground_type), intent(in) :: ground
        real(wp), intent(inout) :: low, high
        !> Are there such factors; false also where the search is stopped
        logical, intent(out) :: found
        real(wp), allocatable :: motion(:)
        real(wp) :: middle
        logical :: collapses, tied, stands

        call find_collapse(ground, real(high, qp), collapses, tied, stands, motion)
        found = collapses
        if (.not. found) return
        call find_collapse(ground, real(low, qp), collapses, tied, stands, motion)
        found = stands
        if (.not. found) return
        do
            middle = low + (high - low)/2
            if (middle <= low .or. middle >= high) return
            found = .not. is_stopped(ground%beam%watch)
            if (.not. found) return
            call find_collapse(ground, real(middle, qp), collapses, tied, stands, motion)
            if (stands) then
                low = middle
            else
                high = middle
            end if
        end do
    end subroutine find_limit

    !> Between which t no support is pressed, nor ground whose force has no limit
    pure subroutine find_allowed(ground, share, start, way, low, high)
        type(ground_type), intent(in) :: ground
        !> Places of the nodes in parts of the length of the beam, shape (0:n)
        real(qp), intent(in) :: share(0:)
        real(qp), intent(in) :: start(2), way(2)
        !> None if low > high
        real(qp), intent(out) :: low, high
        integer :: j, k

        low = -1.0_qp
        high = 1.0_qp
        do k = 1, size(ground%beam%supports)
            associate (s => ground%beam%supports(k))
                if (s%node >= size(share)) cycle
                if (.not. s%more .and. s%stiffness > 0.0_qp) call keep_off(start, way, share(s%node), s%side, low, high)
                ! A law that begins with a piece without end
                if (s%breakpoint == 1 .and. s%before > 0.0_qp) call keep_off(start, way, share(s%node), -s%side, low, high)
            end associate
        end do
        do j = 1, size(ground%pieces)
            do k = ground%first(j), ground%first(j + 1) - 1
                if (has_limit(ground%layers(k), ground%laws)) cycle
                call keep_off(start, way, share(j - 1), ground%layers(k)%side, low, high)
                call keep_off(start, way, share(j), ground%layers(k)%side, low, high)
            end do
        end do
    end subroutine find_allowed

    !> No motion at a place towards a side, 0: no motion
    pure subroutine keep_off(start, way, at, side, low, high)
        real(qp), intent(in) :: start(2), way(2), at
        integer, intent(in) :: side
        real(qp), intent(inout) :: low, high
        real(qp) :: here, change
        integer :: sense

        here = start(1) + at*(start(2) - start(1))
        change = way(1) + at*(way(2) - way(1))
        do sense = -1, 1, 2
            if (side == -sense) cycle
            if (sense*change > 0.0_qp) then
                high = min(high, -here/change)
            else if (sense*change < 0.0_qp) then
                low = max(low, -here/change)
            else if (sense*here > 0.0_qp) then
                high = -huge(high)
            end if
        end do
    end subroutine keep_off

    !> Where between two t the work of the loads is greatest beside what is resisted: a concave function, whose slope is continuous,
    !> so its zero is searched for
    pure function most_work(ground, share, work, start, way, low, high) result(t)
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: share(0:)
        !> Work of the loads as the left, and the right end goes down
        real(qp), intent(in) :: work(2)
        real(qp), intent(in) :: start(2), way(2), low, high
        real(qp) :: t, excess
        type(bracket_type) :: bracket
        integer :: step

        bracket = bracket_type(low, high, excess_at(low), excess_at(high))
        t = low
        if (bracket%at_low >= 0.0_qp) return
        t = high
        if (bracket%at_high <= 0.0_qp) return
        do step = 1, most_motion_steps
            t = place_inside(bracket)
            excess = excess_at(t)
            if (abs(t - merge(bracket%low, bracket%high, excess < 0.0_qp)) <= near_motion .or. .not. abs(excess) > 0.0_qp) exit
            call narrow(bracket, t, excess)
        end do

    contains

        !> What more displacement takes beside the work of the loads
        pure function excess_at(t) result(excess)
            real(qp), intent(in) :: t
            real(qp) :: excess

            excess = dot_product(way, resistance(ground, share, start + t*way) - work)
        end function excess_at

    end function most_work

    !> What ground and supports at their limits resist a motion with, as work per displacement of the left and the right end
    pure function resistance(ground, share, y) result(force)
        type(ground_type), intent(in) :: ground
        real(qp), intent(in) :: share(0:)
        !> Displacements of the two ends
        real(qp), intent(in) :: y(2)
        real(qp) :: force(2), moves(2), limits(2)
        integer :: j, k, sense

        force = by_supports()
        do j = 1, size(ground%pieces)
            moves = y(1) + share(j - 1:j)*(y(2) - y(1))
            do k = ground%first(j), ground%first(j + 1) - 1
                if (.not. has_limit(ground%layers(k), ground%laws)) cycle
                limits = limits_of(ground, ground%layers(k))
                do sense = -1, 1, 2
                    if (ground%layers(k)%side /= -sense) force = force + pressed(sense*moves)
                end do
            end do
        end do

    contains

        !> What supports whose laws end level resist with
        pure function by_supports() result(added)
            real(qp) :: added(2), at(2)
            integer :: i
            logical :: last, first

            added = 0.0_qp
            do i = 1, size(ground%beam%supports)
                associate (s => ground%beam%supports(i))
                    if (s%breakpoint == 0 .or. s%node >= size(share)) cycle
                    at = [1 - share(s%node), share(s%node)]*s%side
                    last = .not. s%more .and. .not. s%stiffness > 0.0_qp .and. dot_product(at, y) > 0.0_qp
                    first = s%breakpoint == 1 .and. .not. s%before > 0.0_qp .and. dot_product(at, y) < 0.0_qp
                    if (last .or. first) added = added + s%force*at
                end associate
            end do
        end function by_supports

        !> What resists on the part of a piece that goes the way of a force
        pure function pressed(toward) result(added)
            real(qp), intent(in) :: toward(2)
            real(qp) :: added(2), ends(2), at(3), limit(3)

            added = 0.0_qp
            if (.not. any(toward > 0.0_qp)) return
            ends = [0.0_qp, 1.0_qp]
            if (toward(1) < 0.0_qp) ends(1) = toward(1)/(toward(1) - toward(2))
            if (toward(2) < 0.0_qp) ends(2) = toward(1)/(toward(1) - toward(2))
            at = [ends(1), sum(ends)/2, ends(2)]
            ! Simpson's rule is exact
            limit = (limits(1) + at*(limits(2) - limits(1)))*[1, 4, 1]/6*(ends(2) - ends(1))*ground%pieces(j)%length*sense
            at = share(j - 1) + at*(share(j) - share(j - 1))
            added = [sum(limit*(1 - at)), sum(limit*at)]
        end function pressed

    end function resistance

    !> That force at the two ends of its piece, linear in between
    pure function limits_of(ground, layer) result(limits)
        type(ground_type), intent(in) :: ground
        type(layer_type), intent(in) :: layer
        real(qp) :: limits(2)

        if (has_points(layer)) then
            limits = [ground%laws(layer%law_last)%force_a, ground%laws(layer%law_last)%force_b]
        else
            limits = [layer%parameter_a(2), layer%parameter_b(2)]
        end if
    end function limits_of

end module gapbeam_ground_limit
