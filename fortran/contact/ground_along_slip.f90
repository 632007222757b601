!> Where a beam begins to slide over ground along its axis, and where it stops.
module gapbeam_ground_along_slip
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: no_push, no_return, beginning_part
    use gapbeam_ground_along, only: part_type, ground_along_type, rates_type, find_rates, first_parts, length_of
    implicit none
    private
    public :: find_motion, start_sliding, longest_start, remove_parts, are_pushed

contains

    !> Find which nodes move, and let those that begin to slide have parts of their own
    pure subroutine find_motion(ground, rates, settled)
        type(ground_along_type), intent(inout) :: ground
        type(rates_type), intent(out) :: rates
        !> False where rounding hides it
        logical, intent(out) :: settled
        real(wp) :: least, slowest
        logical :: changes, pushed(0:ubound(ground%way, 1))
        integer :: i, round

        settled = .true.
        do round = 1, 8*size(ground%way) + 16
            call find_rates(ground, rates)
            if (rates%lost) return
            least = least_push(ground)
            slowest = no_return*maxval(abs(rates%displacement))
            changes = .false.
            do i = 0, ubound(ground%way, 1)
                ! What has begun may be pushed no more, because of what has begun since
                if (ground%way(i) == 0) cycle
                if (rates%begins(i)) then
                    if (ground%way(i)*rates%push(i) > least) cycle
                else if (ground%way(i)*rates%displacement(i) >= -slowest) then
                    cycle
                end if
                ground%way(i) = 0
                ground%moves(i) = .false.
                changes = .true.
            end do
            if (changes) call take_back(ground)
            if (changes) cycle
            pushed(:) = are_pushed(ground, rates)
            do i = 0, ubound(ground%way, 1)
                if (.not. pushed(i)) cycle
                call begin_to_slide(ground, i, merge(1, -1, rates%push(i) > 0.0_wp))
                changes = .true.
            end do
            if (.not. changes) return
        end do
        settled = .false.
    end subroutine find_motion

    !> What pushes a node by rounding only
    pure function least_push(ground) result(least)
        type(ground_along_type), intent(in) :: ground
        real(wp) :: least

        least = no_push*max(maxval(abs(ground%load_rate)), maxval(abs(ground%longer_rate)/ground%softness))
    end function least_push

    !> Which nodes are pushed that are at rest, so that they begin to slide
    pure function are_pushed(ground, rates) result(they_are)
        type(ground_along_type), intent(in) :: ground
        !> By find_rates
        type(rates_type), intent(in) :: rates
        logical :: they_are(0:ubound(ground%way, 1))

        they_are(:) = .not. (ground%moves .or. ground%stiffness > huge(1.0_wp)) .and. abs(rates%push) > least_push(ground)
    end function are_pushed

    !> Take out parts that have hardly begun beside nodes that are at rest
    pure subroutine take_back(ground)
        type(ground_along_type), intent(inout) :: ground
        logical :: gone(size(ground%parts))
        integer :: first(size(ground%limit) + 1), j

        gone(:) = .false.
        first = first_parts(ground)
        do j = 1, size(ground%limit)
            associate (a => first(j), b => first(j + 1) - 1)
                gone(a) = ground%way(j - 1) == 0 .and. length_of(ground, a) < beginning_part
                gone(b) = gone(b) .or. (ground%way(j) == 0 .and. length_of(ground, b) < beginning_part)
            end associate
        end do
        if (any(gone)) call remove_parts(ground, gone)
    end subroutine take_back

    !> Let a node slide one way: parts without length beside it, but where the ground gives way already
    pure subroutine begin_to_slide(ground, i, way)
        type(ground_along_type), intent(inout) :: ground
        integer, intent(in) :: i, way
        integer :: first(size(ground%limit) + 1), k

        ground%moves(i) = .true.
        ground%way(i) = way
        if (i < size(ground%limit)) then
            first = first_parts(ground)
            k = first(i + 1)
            if (ground%limit(i + 1) > 0.0_wp .and. ground%parts(k)%slope /= way) then
                ground%parts = [ground%parts(:k - 1), part_type(i + 1, way, ground%parts(k)%force, 0.0_wp, 1.0_wp), &
                                ground%parts(k:)]
            end if
        end if
        if (i > 0) then
            first = first_parts(ground)
            k = first(i + 1) - 1
            if (ground%limit(i) > 0.0_wp .and. ground%parts(k)%slope /= way) then
                associate (last => ground%parts(k))
                    ground%parts = [ground%parts(:k), part_type(i, way, last%force + (last%slope - way)*ground%limit(i)), &
                                    ground%parts(k + 1:)]
                end associate
            end if
        end if
    end subroutine begin_to_slide

    !> Go so little a way that parts without length get one
    pure subroutine start_sliding(ground, rates, way)
        type(ground_along_type), intent(inout) :: ground
        !> By find_motion
        type(rates_type), intent(in) :: rates
        real(wp), intent(in) :: way
        type(part_type) :: before(size(ground%parts))
        real(wp) :: pull(2), gap(2), soft(2), slope(2)
        integer :: first(size(ground%limit) + 1), k(2), i, n, side
        logical :: long(size(ground%parts))

        n = size(ground%limit)
        first = first_parts(ground)
        before = ground%parts
        long = [(length_of(ground, i) >= beginning_part, i=1, size(long))]
        ground%parts%force = before%force + way*rates%force
        ground%parts%to = before%to + way*rates%to
        ground%parts%back = before%back - way*rates%to
        do i = 0, n
            gap(:) = 0.0_wp
            k(:) = 0
            if (i > 0) k(1) = first(i + 1) - 1
            if (i < n) k(2) = first(i + 1)
            do side = 1, 2
                if (k(side) == 0) cycle
                associate (part => before(k(side)), beyond => k(side) + 2*side - 3)
                    if (long(k(side))) cycle
                    gap(side) = abs(part%slope - before(beyond)%slope)*ground%limit(part%bar)
                    soft(side) = ground%softness(part%bar)
                    ! What lies beyond may slide the other way: then its displacements grow from where it ends
                    slope(side) = max(0.0_wp, (3 - 2*side)*ground%way(i)*(soft(side)*rates%force(beyond) &
                                                                           + ground%longer_rate(part%bar)))
                end associate
            end do
            if (.not. any(gap > 0.0_wp)) cycle
            pull(:) = shares_of_push(abs(rates%push(i)), gap, soft, slope)
            do side = 1, 2
                if (.not. gap(side) > 0.0_wp) cycle
                associate (part => ground%parts(k(side)), beyond => k(side) + 2*side - 3, length => pull(side)*way/gap(side))
                    ! On its right the force falls with the push, on its left it grows
                    part%force = before(k(side))%force + way*(rates%force(beyond) + (3 - 2*side)*ground%way(i)*pull(side))
                    if (side == 2) then
                        part%to = before(k(side))%to + length
                        part%back = 1 - part%to
                    else
                        ground%parts(beyond)%back = before(beyond)%back + length
                        ground%parts(beyond)%to = 1 - ground%parts(beyond)%back
                    end if
                    ground%displacement(i) = ground%displacement(i) &
                        + ground%way(i)*(slope(side) + soft(side)*pull(side))*length*way/(2*count(gap > 0.0_wp))
                end associate
            end do
        end do
        ground%displacement(:) = ground%displacement + way*rates%displacement
        ground%longer(:) = ground%longer + way*ground%longer_rate
    end subroutine start_sliding

    !> How far parts may begin to slide before one has gone half through what lies beyond it
    pure function longest_start(ground, rates) result(way)
        type(ground_along_type), intent(in) :: ground
        !> By find_motion
        type(rates_type), intent(in) :: rates
        real(wp) :: way
        integer :: first(size(ground%limit) + 1), i

        way = huge(way)
        first = first_parts(ground)
        do i = 0, ubound(ground%way, 1)
            if (.not. rates%begins(i)) cycle
            if (i > 0) call look(first(i + 1) - 1, first(i + 1) - 2, way)
            if (i < size(ground%limit)) call look(first(i + 1), first(i + 1) + 1, way)
        end do

    contains

        !> The part beside the node at hand, and the one beyond it
        pure subroutine look(k, beyond, way)
            integer, intent(in) :: k, beyond
            real(wp), intent(inout) :: way

            if (length_of(ground, k) >= beginning_part) return
            associate (gap => abs(ground%parts(k)%slope - ground%parts(beyond)%slope)*ground%limit(ground%parts(k)%bar))
                way = min(way, length_of(ground, beyond)*gap/(2*abs(rates%push(i))))
            end associate
        end subroutine look

    end function longest_start

    !> What parts that begin on the two sides of a node take of its push: their lengths are this by the gap of slopes, and with them
    !> both move the node alike. Where only one begins it takes all
    pure function shares_of_push(push, gap, soft, slope) result(share)
        !> The push; of each side by how much the slopes of the force differ, 0: none begins there; length/EA; and slope of the
        !> rates of displacements beyond it
        real(wp), intent(in) :: push, gap(2), soft(2), slope(2)
        real(wp) :: share(2), low, high
        integer :: i

        share = merge(push, 0.0_wp, gap > 0.0_wp)
        if (any(.not. gap > 0.0_wp)) return
        low = 0.0_wp
        high = 1.0_wp
        do i = 1, digits(push) + 2
            share(1) = push*(low + high)/2
            share(2) = push - share(1)
            if ((slope(1) + soft(1)*share(1))*share(1)/gap(1) > (slope(2) + soft(2)*share(2))*share(2)/gap(2)) then
                high = (low + high)/2
            else
                low = (low + high)/2
            end if
        end do
    end function shares_of_push

    !> Take parts out that have no length left
    pure subroutine remove_parts(ground, gone)
        type(ground_along_type), intent(inout) :: ground
        !> Shape of the parts
        logical, intent(in) :: gone(:)
        type(part_type) :: kept(size(ground%parts))
        integer :: first(size(ground%limit) + 1), i, k, number
        logical :: goes_on

        number = 0
        do k = 1, size(ground%parts)
            if (gone(k)) cycle
            associate (part => ground%parts(k))
                if (number > 0) then
                    associate (last => kept(number))
                        if (last%bar == part%bar .and. last%slope == part%slope) then
                            last%to = part%to
                            last%back = part%back
                            cycle
                        else if (last%bar == part%bar .and. gone(max(k, 2) - 1)) then
                            ! Where the forces of the two meet
                            last%to = (part%force - last%force)/((last%slope - part%slope)*ground%limit(part%bar))
                            last%back = 1 - last%to
                        end if
                    end associate
                end if
                number = number + 1
                kept(number) = part
            end associate
        end do
        do k = 1, number
            if (k < number) then
                if (kept(k + 1)%bar == kept(k)%bar) cycle
            end if
            kept(k)%to = 1.0_wp
            kept(k)%back = 0.0_wp
        end do
        ground%parts = kept(:number)
        ! A node whose parts slide no more the way that it goes has stopped
        first = first_parts(ground)
        do i = 0, ubound(ground%way, 1)
            goes_on = .true.
            if (i > 0) goes_on = slides_with(ground, first(i + 1) - 1, ground%way(i))
            if (i < size(ground%limit)) goes_on = goes_on .and. slides_with(ground, first(i + 1), ground%way(i))
            if (ground%way(i) == 0 .or. goes_on) cycle
            ground%way(i) = 0
            ground%moves(i) = .false.
        end do
    end subroutine remove_parts

    !> May a part slide with a node that goes a way
    pure function slides_with(ground, k, way) result(it_may)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: k, way
        logical :: it_may

        it_may = ground%parts(k)%slope == way .or. .not. ground%limit(ground%parts(k)%bar) > 0.0_wp
    end function slides_with

end module gapbeam_ground_along_slip
