!> Rates of a long chain along the beam, part by part between supports that hold it.
!>
!> Where the only link of a point slides, what it takes is known; so points that nothing else holds are left out of the equations.
!> What pushes them is summed up in quadruple precision, and with it what the links take that tell what happens next. All else is
!> found in double precision: how these points move and the forces of the bars between them, which nothing depends on, and whether
!> links slide the way that they do. A part where that is in doubt beside rounding, or with links of other kinds, is left to
!> gapbeam_axial_rates.
module gapbeam_axial_slip
    use gapbeam_kinds, only: wp, qp
    use gapbeam_axial_quad, only: solve_axial, axial_ok
    use gapbeam_axial_chain, only: chain_type, find_piece, plan
    use gapbeam_axial_progress, only: settle_link, note_link, note_point, note_part, make_fine
    use gapbeam_axial_rates, only: find_rates, moves_on
    implicit none
    private
    public :: find_rates_by_parts

    !> Points by their links: nothing but one that slides, or none; springs; one that holds, maybe beside springs; others
    integer, parameter :: free = 0, elastic = 1, held = 2, other = 3

    !> What there is at a point
    type :: point_type
        integer :: kind = free
        !> Number of the point; link that holds it, link that slides, and where to: 1 to the right, -1 to the left; 0: none
        integer :: number = 0, holder = 0, slider = 0, way = 0
        !> Stiffness of its links, infinite where one holds it
        real(qp) :: stiffness = 0.0_qp
    end type point_type

contains

    !> The rates between two points with all links on their pieces
    subroutine find_rates_by_parts(chain, reach, outcome, place, dragged)
        !> As for find_rates
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        integer, intent(out) :: outcome, place
        logical, intent(out) :: dragged
        type(point_type), allocatable :: points(:)
        integer :: a, b
        logical :: done

        if (reach(2) - reach(1) == size(chain%flexibility)) then
            chain%force_scale = 0.0_qp
            chain%place_scale = 0.0_qp
        end if
        if (.not. chain%by_parts) then
            call make_fine(chain, reach)
            call find_rates(chain, reach, outcome, place, dragged)
            return
        end if
        chain%loose = .false.
        outcome = moves_on
        place = 0
        dragged = .false.
        allocate (points(reach(1):reach(2)))
        do a = reach(1), reach(2)
            points(a) = point_at(chain, a)
        end do
        call take_pushes(chain, points)
        a = reach(1)
        do while (a < reach(2))
            do b = a + 1, reach(2) - 1
                if (points(b)%kind == held) exit
            end do
            call solve_part(chain, points(a:b), done)
            if (.not. done) then
                call make_fine(chain, [a, b])
                call find_rates(chain, [a, b], outcome, place, dragged)
                if (outcome /= moves_on .or. dragged) return
            end if
            a = b
        end do
        do a = reach(1), reach(2)
            if (points(a)%kind == held) call hold(chain, points(a))
        end do
        chain%anew = .false.
    end subroutine find_rates_by_parts

    !> What there is at a point
    pure function point_at(chain, number) result(point)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: number
        type(point_type) :: point
        real(qp) :: slope
        integer :: j, l, count_closed

        point%number = number
        do j = chain%first_at(number), chain%first_at(number + 1) - 1
            l = chain%in_order(j)
            associate (begins => chain%closed(chain%first(l)), ends => chain%closed(chain%last(l)))
                if (chain%rubs(l) .and. (begins .eqv. ends)) then
                    if (point%slider > 0) point%kind = other
                    point%slider = l
                    point%way = merge(1, -1, begins)
                    cycle
                end if
            end associate
            call find_piece(chain, l, slope, count_closed)
            point%stiffness = point%stiffness + slope
            if (slope < 0.0_qp .or. (slope > huge(slope) .and. point%holder > 0)) point%kind = other
            point%kind = max(point%kind, elastic)
            if (slope > huge(slope)) point%holder = l
        end do
        if (point%holder > 0) point%kind = max(point%kind, merge(other, held, point%slider > 0))
    end function point_at

    !> The rates between two points that are held, or where the chain ends, if all points between them are free or elastic
    subroutine solve_part(chain, points, done)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: points(0:)
        !> Are they found, and no sign is in doubt
        logical, intent(out) :: done
        integer, allocatable :: kept(:)
        real(qp), allocatable :: softness(:), longer(:), push(:), nothing(:), rate(:), first(:), reaction(:)
        real(wp), allocatable :: velocity(:), tension(:)
        integer :: i, m, last, state, place

        last = size(points) - 1
        done = .not. any(points%kind == other)
        associate (a => points(0)%number, b => points(last)%number, n => size(chain%flexibility))
            done = done .and. (a == 0 .or. points(0)%kind == held) .and. (b == n .or. points(last)%kind == held)
        end associate
        if (.not. done) return
        kept = [0, pack([(i, i=1, last - 1)], points(1:last - 1)%kind == elastic), last]
        m = size(kept) - 1
        allocate (softness(m), longer(m), push(0:m), nothing(0:m), rate(0:m), first(m), reaction(0:m), velocity(0:last), &
                  tension(last))
        nothing(:) = 0.0_qp
        push(:) = chain%push(points(kept)%number)
        do i = 1, m
            call leave_out(chain, points(kept(i):kept(i + 1)), softness(i), longer(i), push(i))
        end do
        call solve_axial(softness, longer, push, points(kept)%stiffness, nothing, rate, first, reaction, state, place)
        done = state == axial_ok
        do i = 1, m
            if (.not. done) return
            associate (from => kept(i), to => kept(i + 1))
                call find_velocities(chain, points(from:to), real(rate(i - 1:i), wp), real(first(i), wp), velocity(from:to), &
                                     tension(from + 1:to), done)
            end associate
        end do
        if (.not. done) return
        do i = 1, m
            associate (from => kept(i), to => kept(i + 1))
                call take_part(chain, points(from:to), first(i), first(i) - (push(i) - chain%push(points(to)%number)), &
                               velocity(from:to), tension(from + 1:to))
            end associate
        end do
        do i = 0, m
            call note_point(chain, points(kept(i + 1))%number, rate(i))
            if (points(kept(i + 1))%kind /= held) call push_on(chain, points(kept(i + 1)), rate(i))
        end do
    end subroutine solve_part

    !> One bar instead of those between two points, which has the force of the first of them
    pure subroutine leave_out(chain, points, softness, longer, push)
        type(chain_type), intent(in) :: chain
        !> Those between the first and the last are left out
        type(point_type), intent(in) :: points(0:)
        real(qp), intent(out) :: softness, longer
        !> On the last point, to which what pushes the others goes
        real(qp), intent(inout) :: push
        real(qp) :: pushes(2)

        associate (a => points(0)%number, b => points(ubound(points, 1))%number)
            pushes(:) = pushes_between(chain, a, b)
            softness = chain%softness(b) - chain%softness(a)
            longer = chain%longer(b) - chain%longer(a) - (pushes(1)*chain%softness(b) - pushes(2))
        end associate
        push = push + pushes(1)
    end subroutine leave_out

    !> Find what pushes the points, as far as that has changed, and its sums
    pure subroutine take_pushes(chain, points)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: points(:)
        real(qp) :: push, more
        logical :: many
        integer :: i

        many = chain%anew .or. count(chain%way(points%number) /= points%way) > size(chain%push)/16
        do i = 1, size(points)
            associate (point => points(i)%number)
                if (.not. chain%anew .and. chain%way(point) == points(i)%way) cycle
                push = chain%load_rate(point)
                if (points(i)%way > 0) push = push - chain%limit_rate(points(i)%slider)
                if (points(i)%way < 0) push = push + chain%limit_rate(points(i)%slider)
                more = push - chain%push(point)
                chain%push(point) = push
                chain%pushed(point) = real(push, wp)
                chain%way(point) = points(i)%way
                if (.not. many) call add_up(chain, point, [more, more*chain%softness(point)])
            end associate
        end do
        if (many) call add_up_all(chain)
    end subroutine take_pushes

    !> Add to the sums over 1, 2, 4, ... points, by the last bit of the number of the last one (Fenwick 1994)
    pure subroutine add_up(chain, point, more)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: point
        real(qp), intent(in) :: more(2)
        integer :: k

        k = point + 1
        do while (k <= size(chain%push))
            chain%sums(:, k) = chain%sums(:, k) + more
            k = k + iand(k, -k)
        end do
    end subroutine add_up

    !> Make these sums anew: each is complete when its last point comes, and goes into the next one
    pure subroutine add_up_all(chain)
        type(chain_type), intent(inout) :: chain
        integer :: k, next

        chain%sums(:, :) = 0.0_qp
        do k = 1, size(chain%push)
            chain%sums(:, k) = chain%sums(:, k) + [chain%push(k - 1), chain%push(k - 1)*chain%softness(k - 1)]
            next = k + iand(k, -k)
            if (next <= size(chain%push)) chain%sums(:, next) = chain%sums(:, next) + chain%sums(:, k)
        end do
    end subroutine add_up_all

    !> What pushes the points between two, and its moment: times their softness
    pure function pushes_between(chain, a, b) result(pushes)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: a, b
        real(qp) :: pushes(2)
        integer :: k, l

        pushes(:) = 0.0_qp
        k = b
        do while (k > a + 1)
            pushes(:) = pushes + chain%sums(:, k)
            k = k - iand(k, -k)
        end do
        l = a + 1
        do while (l > k)
            pushes(:) = pushes - chain%sums(:, l)
            l = l - iand(l, -l)
        end do
    end function pushes_between

    !> How the points of a part move, in double precision, and whether that leaves no sign in doubt
    pure subroutine find_velocities(chain, points, ends, first, velocity, tension, clear)
        type(chain_type), intent(in) :: chain
        type(point_type), intent(in) :: points(0:)
        !> Rates at its ends; of the force of its first bar
        real(wp), intent(in) :: ends(2), first
        real(wp), intent(out) :: velocity(0:), tension(:)
        logical, intent(out) :: clear
        real(wp) :: force, size, bound
        integer :: i, last

        last = ubound(points, 1)
        velocity(0) = ends(1)
        size = abs(ends(1))
        force = first
        do i = 1, last
            if (i > 1) force = force - chain%pushed(points(i - 1)%number)
            tension(i) = force
            associate (by_force => chain%bar(1, points(i)%number)*force, by_itself => chain%bar(2, points(i)%number))
                velocity(i) = velocity(i - 1) + (by_force + by_itself)
                size = size + abs(by_force) + abs(by_itself)
            end associate
        end do
        velocity(last) = ends(2)
        ! Every sum rounds
        bound = 4*last*epsilon(size)*size
        clear = all(points(1:last - 1)%way == 0 .or. abs(velocity(1:last - 1)) > bound)
    end subroutine find_velocities

    !> Take the rates of a part
    pure subroutine take_part(chain, points, first, last_force, velocity, tension)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: points(0:)
        !> Of the force of its first and its last bar
        real(qp), intent(in) :: first, last_force
        !> By find_velocities
        real(wp), intent(in) :: velocity(0:), tension(:)
        integer :: i, last

        last = ubound(points, 1)
        call note_part(chain, [points(0)%number, points(last)%number], velocity(1:last - 1), tension)
        chain%tension_rate(points(0)%number + 1) = first
        chain%tension_rate(points(last)%number) = last_force
        do i = 1, last - 1
            if (points(i)%slider > 0) call slide(chain, points(i), velocity(i))
            chain%holder(points(i)%number) = 0
        end do
        chain%force_scale = max(chain%force_scale, real(maxval(abs(tension)), qp))
        chain%place_scale = max(chain%place_scale, real(maxval(abs(velocity)), qp))
    end subroutine take_part

    !> Let the link of a point slide on, or stick at once where its point goes the other way
    pure subroutine slide(chain, point, velocity)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: point
        real(wp), intent(in) :: velocity

        associate (l => point%slider)
            if (chain%anew .or. .not. chain%slides(l)) then
                call settle_link(chain, l)
                chain%force_rate(l) = point%way*chain%limit_rate(l)
                chain%slides(l) = .true.
                call note_link(chain, l)
            else if (chain%goes(l) == 0 .and. point%way*velocity > 0.0_wp) then
                return
            end if
            call plan(chain, l, merge(huge(chain%clock), chain%clock, point%way*velocity > 0.0_wp), &
                      merge(0, -point%way, point%way*velocity > 0.0_wp))
        end associate
    end subroutine slide

    !> What the links of a point take that moves with a given rate, but for one that holds it
    pure subroutine push_on(chain, point, rate)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: point
        real(qp), intent(in) :: rate
        real(qp) :: slope
        integer :: j, count_closed

        do j = chain%first_at(point%number), chain%first_at(point%number + 1) - 1
            associate (l => chain%in_order(j))
                if (l == point%holder) cycle
                chain%force_rate(l) = 0.0_qp
                if (l == point%slider) then
                    chain%force_rate(l) = point%way*chain%limit_rate(l)
                else if (.not. chain%rubs(l)) then
                    call find_piece(chain, l, slope, count_closed)
                    chain%force_rate(l) = slope*rate
                end if
                call note_link(chain, l)
            end associate
        end do
        chain%holder(point%number) = point%holder
    end subroutine push_on

    !> What the links of a point that is held take
    pure subroutine hold(chain, point)
        type(chain_type), intent(inout) :: chain
        type(point_type), intent(in) :: point
        real(qp) :: rate

        call note_point(chain, point%number, 0.0_qp)
        call push_on(chain, point, 0.0_qp)
        rate = chain%push(point%number)
        if (point%number > 0) rate = rate - chain%tension_rate(point%number)
        if (point%number < size(chain%flexibility)) rate = rate + chain%tension_rate(point%number + 1)
        chain%force_rate(point%holder) = rate
        call note_link(chain, point%holder)
    end subroutine hold

end module gapbeam_axial_slip
