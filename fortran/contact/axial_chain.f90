!> The chain of bars along the beam with links that act one way, yield or rub: where it is, and what happens to it next.
!>
!> In first order bending does not feel the axial force, so the chain is a system of its own. While all links stay on their piece,
!> displacements and forces are linear in the load factor: only their rates are solved for, in quadruple precision, and added up.
!> A change is felt no farther than the nearest rigid links beside it: rates are found anew between them (gapbeam_axial_reach), all
!> else goes on by the rates it has (gapbeam_axial_progress).
!> A friction support is a slider whose limit is its coefficient times the reaction across the beam, which is linear in the factor
!> between the events of bending (Moreau's sweeping process): stuck it is rigid where it is, sliding it has the force of its limit.
module gapbeam_axial_chain
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: short_chain_bars
    use gapbeam_polyline_quad, only: node_support_type, last_breakpoint
    implicit none
    private
    public :: chain_type, new_chain, choose_parts, find_piece, next_change, plan, stays_at_rest, sticks, no_rate, no_way_yet

    !> Closed breakpoints of a friction support that sticks; one fewer where it slides to the left, one more to the right
    integer, parameter :: sticks = 1
    !> Instead of where the link of a point slides: what pushes the point is to be found anew
    integer, parameter :: no_way_yet = 2
    !> Rates and ways below these shares of the largest are rounding
    real(qp), parameter :: no_rate = 1e-26_qp, no_way = 1e-28_qp

    !> A chain on its way
    type :: chain_type
        !> int 1/EA of each bar, shape (n)
        real(qp), allocatable :: flexibility(:)
        !> Breakpoints of all links as they have become, where they are without their own movement; which are closed, shape (m)
        type(node_support_type), allocatable :: laws(:)
        logical, allocatable :: closed(:)
        !> Does the law keep a set, and the slope along which it unloads, shape (m)
        logical, allocatable :: keeps_set(:)
        real(qp), allocatable :: first_slope(:)
        !> First and last breakpoint of every link, and whether it rubs, shape (l)
        integer, allocatable :: first(:), last(:)
        logical, allocatable :: rubs(:)
        !> Displacements of the points, forces of the bars, forces of the links (against a displacement to the right), and how far
        !> the links have moved themselves
        real(qp), allocatable :: displacement(:), tension(:), force(:), moved(:)
        !> Rates of the loads: forces at the points, elongations of the bars, movements of the links, limits of friction
        real(qp), allocatable :: load_rate(:), elongation_rate(:), own_rate(:), limit_rate(:)
        !> Rates of displacements, forces of the bars and of the links
        real(qp), allocatable :: displacement_rate(:), tension_rate(:), force_rate(:)
        !> How far the load has come, and had when points, bars and links were added up last; how far it will be when the piece of
        !> each link ends, and where that goes: 1 on, -1 back
        real(qp) :: clock = 0.0_qp
        real(qp), allocatable :: since_point(:), since_bar(:), since_link(:), due(:)
        real(wp), allocatable :: soon(:)
        integer, allocatable :: goes(:)
        !> Largest rates of forces and of displacements, as far as they were found
        real(qp) :: force_scale = 0.0_qp, place_scale = 0.0_qp
        !> Links in the order of their points, and the first in it of every point, shape (0:n + 1)
        integer, allocatable :: in_order(:), first_at(:)
        !> Rigid link that takes the force of each point, 0: none, shape (0:n)
        integer, allocatable :: holder(:)
        !> Is the chain solved part by part (gapbeam_axial_slip); sums of flexibilities and of rates of elongations from its left
        !> end, shape (0:n)
        logical :: by_parts = .false.
        !> May rates of loads and limits be others than where rates of the chain were found last
        logical :: anew = .true.
        real(qp), allocatable :: softness(:), longer(:)
        !> Rates of what pushes the points, 1 where their links slide to the right, -1 to the left, shape (0:n); sums of these over
        !> some points, and times their softness, shape (2, n + 1)
        real(qp), allocatable :: push(:), sums(:, :)
        integer, allocatable :: way(:)
        !> In double precision: what pushes; flexibilities and rates of elongations, shape (2, n)
        real(wp), allocatable :: pushed(:), bar(:, :)
        !> Which points, shape (0:n), and bars are known in double precision only; which links slide in a part known so, shape (l)
        logical, allocatable :: coarse(:), coarse_bar(:), slides(:)
        !> In double precision what values_of tells: values, rates, and the load at which they were so
        real(wp), allocatable :: value(:), rate(:), since(:)
        !> Do loads act, or links move by themselves
        logical :: driven = .true.
        !> Does nothing hold the chain, nor push it
        logical :: loose = .false.
        !> Linear solves
        integer :: solves = 0
    end type chain_type

contains

    !> A chain at rest without load
    pure subroutine new_chain(flexibility, laws, rubs, keeps_set, chain)
        !> int 1/EA of each bar, shape (n)
        real(qp), intent(in) :: flexibility(:)
        !> Breakpoints of all links, those of one after the other; which of them are of friction, and which of laws that keep a set
        type(node_support_type), intent(in) :: laws(:)
        logical, intent(in) :: rubs(:), keeps_set(:)
        type(chain_type), intent(out) :: chain
        integer :: k, n, l, count

        n = size(flexibility)
        l = 0
        do k = 1, size(laws)
            if (.not. laws(k)%more) l = l + 1
        end do
        allocate (chain%flexibility, source=flexibility)
        allocate (chain%laws, source=laws)
        allocate (chain%keeps_set, source=keeps_set)
        allocate (chain%closed(size(laws)), chain%first_slope(size(laws)), chain%first(l), chain%last(l), chain%rubs(l))
        allocate (chain%displacement(0:n), chain%tension(n), chain%force(l), chain%moved(l), source=0.0_qp)
        allocate (chain%load_rate(0:n), chain%elongation_rate(n), chain%own_rate(l), chain%limit_rate(l), source=0.0_qp)
        allocate (chain%displacement_rate(0:n), chain%tension_rate(n), chain%force_rate(l), source=0.0_qp)
        chain%closed(:) = .false.
        chain%first_slope(:) = 0.0_qp
        k = 1
        do l = 1, size(chain%first)
            chain%first(l) = k
            chain%last(l) = last_breakpoint(laws, k)
            chain%rubs(l) = rubs(k)
            chain%first_slope(k) = laws(k)%stiffness
            count = 0
            if (laws(k)%side == 0 .or. rubs(k)) then
                count = 1
            else if (abs(laws(k)%before) > 0.0_qp .or. abs(laws(k)%force) > 0.0_qp) then
                ! Both ways: at rest on the piece in the middle
                count = (chain%last(l) - k + 1)/2
                chain%first_slope(k) = laws(k + count - 1)%stiffness
            else if (laws(k)%side*laws(k)%contact < 0.0_qp) then
                count = 1
            end if
            chain%closed(k:k + count - 1) = .true.
            k = chain%last(l) + 1
        end do
        allocate (chain%since_point(0:n), chain%since_bar(n), chain%since_link(l - 1), chain%due(l - 1), source=0.0_qp)
        allocate (chain%goes(l - 1), chain%in_order(l - 1), chain%holder(0:n), source=0)
        allocate (chain%value(2*n + l), chain%rate(2*n + l), chain%since(2*n + l), source=0.0_wp)
        allocate (chain%softness(0:n), chain%longer(0:n), source=0.0_qp)
        call sum_up(flexibility, chain%softness)
        allocate (chain%push(0:n), chain%sums(2, n + 1), source=0.0_qp)
        allocate (chain%pushed(0:n), chain%bar(2, n), chain%soon(l - 1), source=0.0_wp)
        allocate (chain%way(0:n), source=0)
        chain%bar(1, :) = real(flexibility, wp)
        allocate (chain%coarse(0:n), chain%coarse_bar(n), chain%slides(l - 1), source=.false.)
        call order_links(chain)
    end subroutine new_chain

    !> Tell whether a chain is solved part by part, its rates of loads being set: where friction alone remembers, and no link moves
    !> by itself
    pure subroutine choose_parts(chain)
        type(chain_type), intent(inout) :: chain

        chain%by_parts = size(chain%flexibility) > short_chain_bars .and. .not. any(chain%keeps_set) &
            .and. .not. any(abs(chain%own_rate) > 0.0_qp)
        chain%driven = any(abs(chain%load_rate) > 0.0_qp) .or. any(abs(chain%elongation_rate) > 0.0_qp) &
            .or. any(abs(chain%own_rate) > 0.0_qp)
        call sum_up(chain%elongation_rate, chain%longer)
        chain%bar(2, :) = real(chain%elongation_rate, wp)
    end subroutine choose_parts

    !> Sums of numbers up to each of them
    pure subroutine sum_up(numbers, sums)
        real(qp), intent(in) :: numbers(:)
        real(qp), intent(inout) :: sums(0:)
        integer :: i

        do i = 1, size(numbers)
            sums(i) = sums(i - 1) + numbers(i)
        end do
    end subroutine sum_up

    !> Links in the order of their points, those of one point in the order that they have
    pure subroutine order_links(chain)
        type(chain_type), intent(inout) :: chain
        integer :: l, node

        allocate (chain%first_at(0:size(chain%flexibility) + 1), source=0)
        do l = 1, size(chain%first)
            node = chain%laws(chain%first(l))%node
            chain%first_at(node + 1) = chain%first_at(node + 1) + 1
        end do
        do node = 1, ubound(chain%first_at, 1)
            chain%first_at(node) = chain%first_at(node) + chain%first_at(node - 1)
        end do
        do l = 1, size(chain%first)
            node = chain%laws(chain%first(l))%node
            chain%first_at(node) = chain%first_at(node) + 1
            chain%in_order(chain%first_at(node)) = l
        end do
        ! They count the links up to their points now: one point on
        chain%first_at(1:) = chain%first_at(:ubound(chain%first_at, 1) - 1) + 1
        chain%first_at(0) = 1
    end subroutine order_links

    !> Does the chain stay as it is whatever limits friction has: nothing acts on it, and it is held
    pure function stays_at_rest(chain)
        type(chain_type), intent(in) :: chain
        logical :: stays_at_rest

        stays_at_rest = .not. (chain%loose .or. chain%driven .or. any(chain%keeps_set))
        if (stays_at_rest) stays_at_rest = .not. any(abs(chain%force) > 0.0_qp)
    end function stays_at_rest

    !> Slope of the piece on which a link is, and how many of its breakpoints are closed
    pure subroutine find_piece(chain, l, slope, count_closed)
        type(chain_type), intent(in) :: chain
        integer, intent(in) :: l
        real(qp), intent(out) :: slope
        integer, intent(out) :: count_closed

        associate (k => chain%first(l))
            count_closed = count(chain%closed(k:chain%last(l)))
            if (count_closed > 0) then
                slope = chain%laws(k + count_closed - 1)%stiffness
            else
                slope = chain%laws(k)%before
                if (chain%laws(k)%breakpoint == 0) slope = 0.0_qp
            end if
        end associate
    end subroutine find_piece

    !> How far the load goes until links come to ends of their pieces, and which those are at once
    pure subroutine next_change(chain, at_once, reaches, way, links, steps)
        type(chain_type), intent(inout) :: chain
        !> Is it the chain that moves, not the load
        logical, intent(in) :: at_once
        !> Parts in which rates or pieces are others than before, shape (2, *)
        integer, intent(in) :: reaches(:, :)
        !> Of the load factor, or of the chain where it moves at once; huge where nothing comes
        real(qp), intent(out) :: way
        !> Links that come to such an end first, and the piece to which each goes: 1 on, -1 back
        integer, allocatable, intent(out) :: links(:), steps(:)
        real(qp) :: first, near
        real(wp) :: soonest
        integer :: l, i, j

        do i = 1, size(reaches, 2)
            call find_scales(chain, at_once, reaches(:, i))
        end do
        do i = 1, size(reaches, 2)
            do j = chain%first_at(reaches(1, i)), chain%first_at(reaches(2, i) + 1) - 1
                if (.not. chain%slides(chain%in_order(j))) call find_due(chain, chain%in_order(j), at_once)
            end do
        end do
        way = huge(way)
        links = [integer ::]
        steps = [integer ::]
        soonest = huge(soonest)
        do l = 1, size(chain%soon)
            soonest = min(soonest, chain%soon(l))
        end do
        if (.not. soonest < huge(soonest)) return
        do l = 1, size(chain%soon)
            if (chain%soon(l) - soonest <= 4*epsilon(soonest)*abs(soonest)) links = [links, l]
        end do
        first = minval(chain%due(links))
        way = max(0.0_qp, first - chain%clock)
        ! Sums of the load round
        near = first + no_way*max(abs(first), abs(chain%clock))
        links = pack(links, chain%due(links) <= near)
        steps = chain%goes(links)
    end subroutine next_change

    !> Largest rates of forces and of displacements, those of a part of the chain included
    pure subroutine find_scales(chain, at_once, reach)
        !> As for next_change
        type(chain_type), intent(inout) :: chain
        logical, intent(in) :: at_once
        !> First and last point
        integer, intent(in) :: reach(2)
        real(qp) :: share
        integer :: l, j

        share = merge(0.0_qp, 1.0_qp, at_once)
        associate (a => reach(1), b => reach(2))
            do j = a, b
                if (.not. chain%coarse(j)) chain%place_scale = max(chain%place_scale, abs(chain%displacement_rate(j)))
                if (j == a) cycle
                if (.not. chain%coarse_bar(j)) chain%force_scale = max(chain%force_scale, abs(chain%tension_rate(j)))
            end do
            do j = chain%first_at(a), chain%first_at(b + 1) - 1
                l = chain%in_order(j)
                if (chain%slides(l)) cycle
                chain%force_scale = max(chain%force_scale, abs(chain%force_rate(l)), share*abs(chain%limit_rate(l)))
                chain%place_scale = max(chain%place_scale, share*abs(chain%own_rate(l)))
            end do
        end associate
    end subroutine find_scales

    !> Note how far the load will be when the piece of a link ends
    pure subroutine plan(chain, l, due, goes)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: l
        !> As in chain_type
        real(qp), intent(in) :: due
        integer, intent(in) :: goes

        chain%due(l) = due
        chain%goes(l) = goes
        chain%soon(l) = huge(chain%soon)
        if (due < huge(chain%soon)) chain%soon(l) = real(due, wp)
    end subroutine plan

    !> How far the load will be when the piece of a link ends
    pure subroutine find_due(chain, l, at_once)
        type(chain_type), intent(inout) :: chain
        !> The link, added up
        integer, intent(in) :: l
        logical, intent(in) :: at_once
        real(qp) :: slope, gap, rate, least_rate, deflection, velocity, limits
        integer :: n, j

        call plan(chain, l, huge(gap), 0)
        associate (k => chain%first(l), node => chain%laws(chain%first(l))%node)
            if (chain%laws(k)%side == 0) return
            call find_piece(chain, l, slope, n)
            deflection = chain%displacement(node) - chain%moved(l)
            velocity = chain%displacement_rate(node)
            limits = 0.0_qp
            if (.not. at_once) then
                velocity = velocity - chain%own_rate(l)
                limits = chain%limit_rate(l)
            end if
            do j = 0, 1
                ! On to the next breakpoint, or back to the last one
                if (n + 1 - j < 1 .or. n + 1 - j > chain%last(l) - k + 1) cycle
                associate (s => chain%laws(k + n - j))
                    if (abs(slope) > huge(slope)) then
                        gap = s%force - merge(chain%force(l), -chain%force(l), s%side > 0)
                        rate = merge(chain%force_rate(l), -chain%force_rate(l), s%side > 0)
                        if (chain%rubs(l)) rate = rate + merge(-limits, limits, j == 0)
                        least_rate = no_rate*chain%force_scale
                        if (abs(gap) <= no_way*abs(s%force)) gap = 0.0_qp
                    else
                        gap = s%contact - deflection
                        if (s%side < 0) gap = -gap
                        rate = merge(velocity, -velocity, s%side > 0)
                        least_rate = no_rate*chain%place_scale
                        if (abs(gap) <= no_way*max(abs(s%contact), abs(deflection))) gap = 0.0_qp
                        ! What slides has its breakpoint with it
                        if (chain%rubs(l)) gap = 0.0_qp
                    end if
                end associate
                if (j == 1) then
                    gap = -gap
                    rate = -rate
                end if
                if (.not. rate > least_rate) cycle
                gap = chain%clock + max(gap, 0.0_qp)/rate
                if (gap >= chain%due(l)) cycle
                call plan(chain, l, gap, merge(1, -1, j == 0))
            end do
        end associate
    end subroutine find_due

end module gapbeam_axial_chain
