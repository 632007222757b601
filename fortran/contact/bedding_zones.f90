!> Where a beam slides over springs and sliders along it: zones under given loads, what sliders remember, and whether they go on.
!>
!> Between turns of the load sliders go one way, so a state follows from that at the last turn and from the loads: ground takes
!> what its springs give, cut off at its limit. Its zones are found by Newton's method for that law, with all of the beam solved
!> in closed form in every step (semismooth; Hintermueller, Ito and Kunisch, SIAM J. Optim. 13 (2003)).
module gapbeam_bedding_zones
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: no_slip, found_zone, steady_zone
    use gapbeam_ordered_quad, only: sort
    use gapbeam_exponential_curve, only: curve_type, most_roots, value_of, derivative, scaled, roots_of
    use gapbeam_bedding_growth, only: grow_zones
    use gapbeam_axial_bedding, only: memory_type, cell_type, bedding_type, loads_type, solve_cells, give_way, is_bedded, no_limit
    implicit none
    private
    public :: new_bedding, start_anew, find_zones, turns_back

    !> Newton steps under one load, parts of a way to loads that are tried, and how often these are halved
    integer, parameter :: most_steps = 60, most_parts = 48, most_halves = 12

contains

    !> Bars without force
    pure subroutine new_bedding(softness, stiffness, limit, support, bedding)
        !> As in bedding_type
        real(wp), intent(in) :: softness(:), stiffness(:), limit(:, :), support(0:)
        type(bedding_type), intent(out) :: bedding
        integer :: j, n

        n = size(softness)
        allocate (bedding%softness, source=real(softness, qp))
        allocate (bedding%stiffness, source=real(stiffness, qp))
        allocate (bedding%limit, source=min(real(limit, qp), no_limit))
        allocate (bedding%support(0:n), source=support)
        allocate (bedding%displacement(0:n), bedding%loads%node(0:n), bedding%loads%along(n), bedding%loads%longer(n), &
                  source=0.0_qp)
        allocate (bedding%memory, source=[(memory_type(j), j=1, n)])
        call hold_all(bedding)
    end subroutine new_bedding

    !> The load turns: what slides is held where it is, and sliders remember how far they have gone
    pure subroutine start_anew(bedding)
        type(bedding_type), intent(inout) :: bedding
        type(memory_type) :: memory(size(bedding%cells))
        integer :: k, m

        m = 0
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k), before => bedding%cells(max(k, 2) - 1))
                if (k > 1 .and. cell%way /= 0 .and. cell%way == before%way .and. cell%bar == before%bar) then
                    memory(m)%to = cell%to
                    cycle
                end if
                m = m + 1
                memory(m) = memory_type(cell%bar, cell%from, cell%to, bedding%memory(cell%memory)%slid)
                if (cell%way == 0) cycle
                associate (t => bedding%limit(:, cell%bar), K => bedding%stiffness(cell%bar), slid => memory(m)%slid)
                    slid(:) = cell%displacement%power
                    slid(0) = slid(0) - cell%way*t(1)/K
                    slid(1) = slid(1) - cell%way*(t(2) - t(1))/K
                end associate
            end associate
        end do
        bedding%memory = memory(:m)
        call hold_all(bedding)
    end subroutine start_anew

    !> One cell for every memory, held
    pure subroutine hold_all(bedding)
        type(bedding_type), intent(inout) :: bedding
        integer :: i

        bedding%cells = [(cell_type(i, bedding%memory(i)%bar, 0, bedding%memory(i)%from, bedding%memory(i)%to, curve_type()), &
                          i=1, size(bedding%memory))]
    end subroutine hold_all

    !> Find what slides under loads
    pure subroutine find_zones(bedding, loads, settled)
        !> As where the load turned last, or on the way from there
        type(bedding_type), intent(inout) :: bedding
        type(loads_type), intent(in) :: loads
        !> False where no state is found: all slides, or rounding hides what does
        logical, intent(out) :: settled
        type(bedding_type) :: next
        type(loads_type) :: start
        real(qp) :: done, step
        integer :: part

        start = bedding%loads
        done = 0.0_qp
        step = 1.0_qp
        do part = 1, most_parts
            next = bedding
            next%loads%node(:) = start%node + (done + step)*(loads%node - start%node)
            next%loads%along(:) = start%along + (done + step)*(loads%along - start%along)
            next%loads%longer(:) = start%longer + (done + step)*(loads%longer - start%longer)
            call iterate(next, .true., settled)
            if (.not. settled) then
                next%cells = bedding%cells
                call iterate(next, .false., settled)
            end if
            if (settled) then
                bedding = next
                done = done + step
                if (done >= 1.0_qp) return
                step = min(2*step, 1 - done)
            else
                if (step < 0.5_qp**most_halves) return
                step = step/2
            end if
        end do
        settled = .false.
    end subroutine find_zones

    !> Newton's method under the loads that there are
    pure subroutine iterate(bedding, grows, settled)
        type(bedding_type), intent(inout) :: bedding
        !> Are zones to grow by what they pass on, which may lead astray where they meet
        logical, intent(in) :: grows
        logical, intent(out) :: settled
        type(cell_type), allocatable :: cells(:)
        real(qp) :: off, before
        logical :: lost
        integer :: step

        settled = .false.
        off = huge(off)
        do step = 1, most_steps
            call solve_cells(bedding, lost)
            if (lost) return
            call divide(bedding, cells)
            before = off
            off = otherwise(bedding%cells, cells)
            ! Zones that have just begun are known to the root of rounding only
            settled = off <= found_zone .or. (off <= steady_zone .and. off >= before/2)
            if (settled) return
            if (grows) call grow_zones(bedding, cells)
            call move_alloc(cells, bedding%cells)
        end do
    end subroutine iterate

    !> The greatest share of a bar over which cells slide otherwise than others
    pure function otherwise(before, after) result(most)
        !> Over the same memories
        type(cell_type), intent(in) :: before(:), after(:)
        real(qp) :: most
        integer :: i, k

        most = 0.0_qp
        i = 1
        k = 1
        do
            if (before(k)%memory == after(i)%memory .and. before(k)%way /= after(i)%way) then
                most = max(most, min(before(k)%to, after(i)%to) - max(before(k)%from, after(i)%from))
            end if
            if (k == size(before) .and. i == size(after)) return
            if (i == size(after)) then
                k = k + 1
            else if (k == size(before)) then
                i = i + 1
            else if (before(k)%memory < after(i)%memory .or. (before(k)%memory == after(i)%memory .and. &
                                                              before(k)%to <= after(i)%to)) then
                k = k + 1
            else
                i = i + 1
            end if
        end do
    end function otherwise

    !> Cells by what springs give way in those that there are
    pure subroutine divide(bedding, cells)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), allocatable, intent(out) :: cells(:)
        type(cell_type), allocatable :: found(:)
        real(qp) :: at(0:2*most_roots + 1)
        type(curve_type) :: push
        integer :: i, k, m, n, way
        logical :: may_slide

        allocate (found((2*most_roots + 1)*size(bedding%cells)))
        m = 0
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k))
                n = 0
                may_slide = is_bedded(bedding, cell%bar)
                if (may_slide) then
                    push = give_way(bedding, cell)
                    ! Far from the ends of zones no more has to be known
                    may_slide = sum(abs(push%power)) + abs(push%left) + abs(push%right) > minval(bedding%limit(:, cell%bar))
                end if
                if (may_slide) call find_changes(push, bedding%limit(:, cell%bar), at(1:), n)
                at(0) = cell%from
                at(n + 1) = cell%to
                do i = 0, n
                    way = 0
                    if (may_slide) way = way_at(push, bedding%limit(:, cell%bar), (at(i) + at(i + 1))/2)
                    call add(cell, way, at(i), at(i + 1), found, m)
                end do
            end associate
        end do
        allocate (cells, source=found(:m))
    end subroutine divide

    !> One more cell, or the last one goes on; none is as short as rounding
    pure subroutine add(cell, way, from, to, found, m)
        !> The cell of which it is a part
        type(cell_type), intent(in) :: cell
        integer, intent(in) :: way
        real(qp), intent(in) :: from, to
        !> The first `m` of these
        type(cell_type), intent(inout) :: found(:)
        integer, intent(inout) :: m

        if (m > 0) then
            if (found(m)%memory == cell%memory) then
                if (found(m)%to - found(m)%from <= found_zone) found(m)%way = way
                if (found(m)%way == way .or. to - from <= found_zone) then
                    found(m)%to = to
                    return
                end if
            end if
        end if
        m = m + 1
        found(m) = cell_type(cell%memory, cell%bar, way, from, to, curve_type())
    end subroutine add

    !> Where a push on the ground passes its limit, either way, in order
    pure subroutine find_changes(push, limit, at, number)
        type(curve_type), intent(in) :: push
        !> At both ends of the bar
        real(qp), intent(in) :: limit(2)
        real(qp), intent(out) :: at(:)
        integer, intent(out) :: number
        real(qp) :: roots(most_roots)
        integer :: n, way

        at(:) = 0.0_qp
        number = 0
        if (maxval(limit) >= no_limit) return
        do way = -1, 1, 2
            call roots_of(beyond(push, limit, way), roots, n)
            at(number + 1:number + n) = roots(:n)
            number = number + n
        end do
        call sort(at(:number))
    end subroutine find_changes

    !> By how much a push one way passes the limit: what has not come farther than rounding has not
    pure function beyond(push, limit, way) result(curve)
        type(curve_type), intent(in) :: push
        real(qp), intent(in) :: limit(2)
        integer, intent(in) :: way
        type(curve_type) :: curve

        curve = scaled(push, real(way, qp))
        curve%power(0) = curve%power(0) - limit(1)*(1 + no_slip)
        curve%power(1) = curve%power(1) - (limit(2) - limit(1))*(1 + no_slip)
    end function beyond

    !> Which way a push makes the beam slide at a place
    pure function way_at(push, limit, x) result(way)
        type(curve_type), intent(in) :: push
        real(qp), intent(in) :: limit(2), x
        integer :: way

        way = 0
        if (maxval(limit) >= no_limit) return
        if (value_of(beyond(push, limit, 1), x) > 0.0_qp) way = 1
        if (value_of(beyond(push, limit, -1), x) > 0.0_qp) way = -1
    end function way_at

    !> Does the beam go back, or stand still, anywhere where it slides, as the load goes on: then sliders have to be asked again
    pure function turns_back(bedding, rate) result(it_does)
        type(bedding_type), intent(in) :: bedding
        !> Of the loads as the load goes on
        type(loads_type), intent(in) :: rate
        logical :: it_does
        type(bedding_type) :: next
        type(curve_type) :: motion, slope
        real(qp) :: roots(most_roots), fastest, slowest
        integer :: i, k, n
        logical :: lost

        it_does = .false.
        if (all(bedding%cells%way == 0)) return
        next = bedding
        next%loads%node(:) = bedding%loads%node + rate%node
        next%loads%along(:) = bedding%loads%along + rate%along
        next%loads%longer(:) = bedding%loads%longer + rate%longer
        call solve_cells(next, lost)
        if (lost) return
        fastest = maxval(abs(next%displacement - bedding%displacement))
        slowest = 0.0_qp
        do k = 1, size(next%cells)
            associate (cell => next%cells(k))
                if (cell%way == 0) cycle
                motion = cell%displacement
                motion%power(:) = cell%way*(motion%power - bedding%cells(k)%displacement%power)
                slowest = min(slowest, value_of(motion, cell%from), value_of(motion, cell%to))
                slope = derivative(motion)
                call roots_of(slope, roots, n)
                do i = 1, n
                    slowest = min(slowest, value_of(motion, roots(i)))
                end do
            end associate
        end do
        it_does = slowest < -no_slip*fastest
    end function turns_back

end module gapbeam_bedding_zones
