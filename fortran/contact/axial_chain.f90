!> The chain of bars along the beam with links that act one way, yield or rub: where it is, and what happens to it next.
!>
!> In first order bending does not feel the axial force, so the chain is a system of its own. While all links stay on their piece,
!> displacements and forces are linear in the load factor: only their rates are solved for, in quadruple precision, and added up.
!> A friction support is a slider whose limit is its coefficient times the reaction across the beam, which is linear in the factor
!> between the events of bending (Moreau's sweeping process): stuck it is rigid where it is, sliding it has the force of its limit.
module gapbeam_axial_chain
    use gapbeam_kinds, only: qp
    use gapbeam_polyline_quad, only: node_support_type, last_breakpoint
    use gapbeam_unloading_quad, only: rewrite_laws
    implicit none
    private
    public :: chain_type, new_chain, find_piece, next_change, advance, change_pieces, sticks, no_rate

    !> Closed breakpoints of a friction support that sticks; one fewer where it slides to the left, one more to the right
    integer, parameter :: sticks = 1
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
    end subroutine new_chain

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
    pure subroutine next_change(chain, at_once, way, links, steps)
        type(chain_type), intent(in) :: chain
        !> Is it the chain that moves, not the load
        logical, intent(in) :: at_once
        !> Of the load factor, or of the chain where it moves at once; huge where nothing comes
        real(qp), intent(out) :: way
        !> Links that come to such an end first, and the piece to which each goes: 1 on, -1 back
        integer, allocatable, intent(out) :: links(:), steps(:)
        real(qp) :: ways(size(chain%first)), slope, gap, rate, forces, places, least_rate, deflection, velocity, share, limits
        integer :: to(size(chain%first)), l, n, j

        ways(:) = huge(way)
        to(:) = 0
        share = merge(0.0_qp, 1.0_qp, at_once)
        forces = maxval(abs(chain%force_rate)) + maxval(abs(chain%tension_rate)) + share*maxval(abs(chain%limit_rate))
        places = maxval(abs(chain%displacement_rate)) + share*maxval(abs(chain%own_rate))
        do l = 1, size(chain%first)
            associate (k => chain%first(l), node => chain%laws(chain%first(l))%node)
                if (chain%laws(k)%side == 0) cycle
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
                            least_rate = no_rate*forces
                            if (abs(gap) <= no_way*abs(s%force)) gap = 0.0_qp
                        else
                            gap = s%contact - deflection
                            if (s%side < 0) gap = -gap
                            rate = merge(velocity, -velocity, s%side > 0)
                            least_rate = no_rate*places
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
                    gap = max(gap, 0.0_qp)/rate
                    if (gap >= ways(l)) cycle
                    ways(l) = gap
                    to(l) = merge(1, -1, j == 0)
                end do
            end associate
        end do
        way = minval(ways)
        links = pack([(l, l=1, size(to))], ways <= way .and. to /= 0)
        steps = to(links)
    end subroutine next_change

    !> Go on by the rates
    pure subroutine advance(chain, way, at_once)
        type(chain_type), intent(inout) :: chain
        real(qp), intent(in) :: way
        !> Is it the chain that moves, not the load
        logical, intent(in) :: at_once
        integer :: l
        real(qp) :: limit

        chain%displacement(:) = chain%displacement + way*chain%displacement_rate
        if (.not. at_once) then
            chain%tension(:) = chain%tension + way*chain%tension_rate
            chain%force(:) = chain%force + way*chain%force_rate
            chain%moved(:) = chain%moved + way*chain%own_rate
        end if
        do l = 1, size(chain%first)
            if (.not. chain%rubs(l)) cycle
            associate (k => chain%first(l))
                limit = chain%laws(k + 1)%force
                if (.not. at_once) limit = max(0.0_qp, limit + way*chain%limit_rate(l))
                chain%laws(k)%force = -limit
                chain%laws(k + 1)%force = limit
                chain%laws(k:k + 1)%contact = chain%displacement(chain%laws(k)%node)
            end associate
        end do
        if (any(chain%keeps_set)) call move_breakpoints(chain)
    end subroutine advance

    !> Write the laws that keep a set anew from where the links are
    pure subroutine move_breakpoints(chain)
        type(chain_type), intent(inout) :: chain
        real(qp) :: deflection(size(chain%laws)), reaction(size(chain%laws))
        integer :: l

        reaction(:) = 0.0_qp
        do l = 1, size(chain%first)
            associate (k => chain%first(l))
                deflection(k:chain%last(l)) = chain%displacement(chain%laws(k)%node) - chain%moved(l)
                reaction(k) = chain%force(l)
            end associate
        end do
        call rewrite_laws(chain%laws, chain%closed, chain%keeps_set, chain%first_slope, deflection, reaction)
    end subroutine move_breakpoints

    !> Let links go to the pieces beside theirs
    pure subroutine change_pieces(chain, links, steps)
        type(chain_type), intent(inout) :: chain
        !> By next_change
        integer, intent(in) :: links(:), steps(:)
        integer :: i, n

        do i = 1, size(links)
            associate (k => chain%first(links(i)), last => chain%last(links(i)))
                n = count(chain%closed(k:last)) + steps(i)
                chain%closed(k:last) = .false.
                chain%closed(k:k + n - 1) = .true.
                ! No rounding where nothing acts
                if (n == 0 .and. .not. (abs(chain%laws(k)%before) > 0.0_qp .or. abs(chain%laws(k)%force) > 0.0_qp)) then
                    chain%force(links(i)) = 0.0_qp
                end if
            end associate
        end do
    end subroutine change_pieces

end module gapbeam_axial_chain
