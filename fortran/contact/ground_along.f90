!> Ground that holds a beam along its axis by friction: bars of which parts slide and others are at rest.
!>
!> The ground takes up to a limit per length, against the way of the beam over it; nothing moves where it holds (Coulomb, no
!> elastic slip). So the axial force of a bar is a polyline over its length: its slope is the limit where the beam slides or has
!> slid last, one way or the other, and 0 where it never has. At rest u' does not change, and the force only by what temperature
!> would lengthen; where a part slides its slope stays, and all of it changes alike. A part at rest beside one that slides ends
!> where their forces meet. Rates of the ends of parts and of the nodes are those of a chain of springs that is fixed at these ends.
module gapbeam_ground_along
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: beginning_part
    use gapbeam_axial_bedding, only: bedding_type
    implicit none
    private
    public :: part_type, ground_along_type, rates_type, new_ground_along, start_leg, find_rates, first_parts, length_of, force_in

    !> A part of a bar over which the axial force is straight
    type :: part_type
        integer :: bar
        !> Of the force to the right: 1 where it slides, or has slid last, to the right, -1 to the left, 0 where it never has; times
        !> the limit of the bar
        integer :: slope = 0
        !> What the force would be at the left end of the bar
        real(wp) :: force = 0.0_wp
        !> Its right end as a share of the bar, and how far that is from the right end of the bar: of short parts beside a node no
        !> digit is lost, on either side of it
        real(wp) :: to = 1.0_wp, back = 0.0_wp
    end type part_type

    !> The bars, and how they are
    type :: ground_along_type
        !> Length/EA of every bar, above 0, and most force that the ground takes along it, shape (n)
        real(wp), allocatable :: softness(:), limit(:)
        !> Stiffness of the support of every node, infinite: rigid, shape (0:n)
        real(wp), allocatable :: stiffness(:)
        !> Rates of the loads at the nodes, to the right, shape (0:n), and of the elongations of the bars without force, shape (n)
        real(wp), allocatable :: load_rate(:), longer_rate(:)
        !> From left to right
        type(part_type), allocatable :: parts(:)
        !> Which nodes move; which way those do over the ground, 1 to the right, -1 to the left, 0 where there is none; shape (0:n)
        logical, allocatable :: moves(:)
        integer, allocatable :: way(:)
        !> To the right, shape (0:n), and elongations without force, shape (n)
        real(wp), allocatable :: displacement(:), longer(:)
        !> Instead of all this, where the ground gives way before the beam slides
        type(bedding_type), allocatable :: springs
    end type ground_along_type

    !> Rates with the load
    type :: rates_type
        !> Of the displacements of the nodes, shape (0:n)
        real(wp), allocatable :: displacement(:)
        !> Of the forces and of the right ends of the parts
        real(wp), allocatable :: force(:), to(:)
        !> What pushes nodes that are at rest, or begin to slide, and which of them do begin, shape (0:n)
        real(wp), allocatable :: push(:)
        logical, allocatable :: begins(:)
        !> Does a part of the beam move without end
        logical :: lost = .false.
    end type rates_type

    !> The parts beside a node: force per displacement of it, and whether their other ends are fixed; does the node begin to slide
    type :: beside_type
        real(wp) :: left = 0.0_wp, right = 0.0_wp
        logical :: held_left = .false., held_right = .false., begins = .false.
    end type beside_type

contains

    !> Bars without force
    pure subroutine new_ground_along(softness, limit, stiffness, ground)
        !> As in ground_along_type
        real(wp), intent(in) :: softness(:), limit(:), stiffness(0:)
        type(ground_along_type), intent(out) :: ground
        integer :: j, n

        n = size(softness)
        ground%softness = softness
        ground%limit = limit
        allocate (ground%stiffness(0:n), source=stiffness)
        allocate (ground%load_rate(0:n), ground%longer_rate(n), ground%displacement(0:n), ground%longer(n), source=0.0_wp)
        allocate (ground%moves(0:n), ground%way(0:n))
        ground%parts = [(part_type(j), j=1, n)]
        call start_leg(ground)
    end subroutine new_ground_along

    !> All that slides comes to rest
    pure subroutine start_leg(ground)
        type(ground_along_type), intent(inout) :: ground
        integer :: i

        ground%way(:) = 0
        do i = 0, ubound(ground%way, 1)
            ground%moves(i) = .not. ground%stiffness(i) > huge(1.0_wp)
            ! Ground beside a node holds it
            if (i > 0) ground%moves(i) = ground%moves(i) .and. .not. ground%limit(i) > 0.0_wp
            if (i < size(ground%limit)) ground%moves(i) = ground%moves(i) .and. .not. ground%limit(i + 1) > 0.0_wp
        end do
    end subroutine start_leg

    !> First part of every bar, and one more than there are parts
    pure function first_parts(ground) result(first)
        type(ground_along_type), intent(in) :: ground
        integer :: first(size(ground%limit) + 1), i

        first(size(first)) = size(ground%parts) + 1
        do i = size(ground%parts), 1, -1
            first(ground%parts(i)%bar) = i
        end do
    end function first_parts

    !> Length of a part as a share of its bar
    pure function length_of(ground, i) result(length)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: i
        real(wp) :: length, to, back

        to = 0.0_wp
        back = 1.0_wp
        if (i > 1) then
            associate (before => ground%parts(max(i, 2) - 1))
                if (before%bar == ground%parts(i)%bar) then
                    to = before%to
                    back = before%back
                end if
            end associate
        end if
        if (ground%parts(i)%to < ground%parts(i)%back) then
            length = ground%parts(i)%to - to
        else
            length = back - ground%parts(i)%back
        end if
    end function length_of

    !> Axial force that a part has, or would have, at a share of its bar
    pure function force_in(ground, i, share) result(force)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: i
        real(wp), intent(in) :: share
        real(wp) :: force

        associate (part => ground%parts(i))
            force = part%force + part%slope*ground%limit(part%bar)*share
        end associate
    end function force_in

    !> Rates of all parts and nodes; nodes that begin to slide on a side are still at rest
    pure subroutine find_rates(ground, rates)
        type(ground_along_type), intent(in) :: ground
        type(rates_type), intent(out) :: rates
        type(beside_type) :: beside(0:size(ground%limit))
        real(wp) :: at_left, at_right, length
        integer :: first(size(ground%limit) + 1), k

        first = first_parts(ground)
        call look_beside(ground, first, beside)
        allocate (rates%displacement(0:size(ground%limit)), rates%push(0:size(ground%limit)), source=0.0_wp)
        allocate (rates%force(size(ground%parts)), rates%to(size(ground%parts)), source=0.0_wp)
        allocate (rates%begins(0:size(ground%limit)), source=beside%begins .and. ground%moves)
        call find_displacements(ground, beside, ground%moves .and. .not. beside%begins, rates%displacement, rates%lost)
        if (rates%lost) return
        do k = 1, size(ground%parts)
            associate (j => ground%parts(k)%bar)
                at_left = 0.0_wp
                at_right = 0.0_wp
                if (k == first(j)) at_left = rates%displacement(j - 1)
                if (k == first(j + 1) - 1) at_right = rates%displacement(j)
                length = length_of(ground, k)
                rates%force(k) = -ground%longer_rate(j)/ground%softness(j)
                if (length > 0.0_wp) rates%force(k) = rates%force(k) + (at_right - at_left)/(length*ground%softness(j))
            end associate
        end do
        call find_pushes(ground, first, rates%force, ground%moves .and. .not. beside%begins, rates%push)
        do k = 1, size(ground%parts) - 1
            associate (a => ground%parts(k), b => ground%parts(k + 1))
                if (a%bar /= b%bar .or. a%slope == b%slope) cycle
                rates%to(k) = (rates%force(k + 1) - rates%force(k))/((a%slope - b%slope)*ground%limit(a%bar))
            end associate
        end do
    end subroutine find_rates

    !> The parts beside every node
    pure subroutine look_beside(ground, first, beside)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: first(:)
        type(beside_type), intent(out) :: beside(0:)
        real(wp) :: longest
        integer :: i, n

        n = size(ground%limit)
        do i = 0, n
            longest = 0.0_wp
            associate (b => beside(i))
                if (i > 0) call look(first(i + 1) - 1, first(max(i, 1)), ground%way(i), b%left, b%held_left, longest, b%begins)
                if (i < n) call look(first(i + 1), first(i + 2) - 1, ground%way(i), b%right, b%held_right, longest, b%begins)
                ! Where all that slides beside a node has hardly begun
                b%begins = b%begins .or. (longest > 0.0_wp .and. longest < beginning_part)
            end associate
        end do

    contains

        !> The part beside the node at hand
        pure subroutine look(k, other, way, stiff, held, longest, begins)
            !> The part, that at the other end of its bar, and the way of the node
            integer, intent(in) :: k, other, way
            real(wp), intent(out) :: stiff
            logical, intent(out) :: held
            real(wp), intent(inout) :: longest
            logical, intent(inout) :: begins
            real(wp) :: share

            share = length_of(ground, k)
            held = k /= other
            stiff = 0.0_wp
            if (share > 0.0_wp) stiff = 1/(ground%softness(ground%parts(k)%bar)*share)
            longest = max(longest, share)
            begins = begins .or. (.not. share > 0.0_wp .and. ground%parts(k)%slope == way)
        end subroutine look

    end subroutine look_beside

    !> Rates of the nodes that move, by elimination from the left without differences, as in gapbeam_axial
    pure subroutine find_displacements(ground, beside, free, rate, lost)
        type(ground_along_type), intent(in) :: ground
        type(beside_type), intent(in) :: beside(0:)
        !> Which rates are unknown; the others are 0
        logical, intent(in) :: free(0:)
        real(wp), intent(inout) :: rate(0:)
        !> Does nothing hold some of them
        logical, intent(out) :: lost
        real(wp) :: seen(0:ubound(free, 1)), load(0:ubound(free, 1))
        integer :: i, n

        n = ubound(free, 1)
        lost = .false.
        do i = 0, n
            load(i) = ground%load_rate(i)
            seen(i) = 0.0_wp
            if (i > 0) load(i) = load(i) + ground%longer_rate(max(i, 1))/ground%softness(max(i, 1))
            if (i < n) load(i) = load(i) - ground%longer_rate(i + 1)/ground%softness(i + 1)
            if (.not. free(i)) cycle
            seen(i) = ground%stiffness(i)
            associate (before => max(i, 1) - 1, left => beside(i)%left)
                if (i > 0 .and. .not. beside(i)%held_left .and. free(before)) then
                    seen(i) = seen(i) + left*seen(before)/(left + seen(before))
                    load(i) = load(i) + load(before)*left/(left + seen(before))
                else
                    seen(i) = seen(i) + left
                end if
            end associate
            if (.not. goes_on(i)) seen(i) = seen(i) + beside(i)%right
        end do
        do i = n, 0, -1
            if (.not. free(i)) cycle
            if (goes_on(i)) then
                rate(i) = (load(i) + beside(i)%right*rate(i + 1))/(seen(i) + beside(i)%right)
            else if (seen(i) > 0.0_wp) then
                rate(i) = load(i)/seen(i)
            else
                lost = .true.
                return
            end if
        end do

    contains

        !> Is the rate of the next node unknown too, with nothing fixed between them
        pure function goes_on(i)
            integer, intent(in) :: i
            logical :: goes_on

            goes_on = i < n
            if (goes_on) goes_on = .not. beside(i)%held_right .and. free(min(i + 1, n))
        end function goes_on

    end subroutine find_displacements

    !> What pushes the nodes that do not move; beside parts that have hardly begun that is told by what lies beyond these
    pure subroutine find_pushes(ground, first, force, free, push)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: first(:)
        !> Rates of the parts; which nodes move
        real(wp), intent(in) :: force(:)
        logical, intent(in) :: free(0:)
        real(wp), intent(inout) :: push(0:)
        integer :: i

        do i = 0, ubound(free, 1)
            if (free(i)) cycle
            push(i) = ground%load_rate(i)
            if (i > 0) push(i) = push(i) - force(beyond(first(i + 1) - 1, -1))
            if (i < ubound(free, 1)) push(i) = push(i) + force(beyond(first(i + 1), 1))
        end do

    contains

        !> The part itself, or the one beyond it where it has hardly begun
        pure function beyond(k, step)
            integer, intent(in) :: k, step
            integer :: beyond

            beyond = k
            if (length_of(ground, k) < beginning_part) beyond = k + step
        end function beyond

    end subroutine find_pushes

end module gapbeam_ground_along
