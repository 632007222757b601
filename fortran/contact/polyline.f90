!> Supports whose law is a polyline of more than two pieces, one entry a breakpoint.
!>
!> With y = side*deflection and f = side*reaction, piece i of a law begins at breakpoint i, a point (side*contact, force), and goes
!> on with the slope `stiffness` of that breakpoint; left of the first breakpoint it has the slope `before`. Slopes may have any
!> sign: 0 is a constant force, infinite a rigid piece (the node is held while the force grows), minus infinite a brittle drop. The
!> breakpoints of a law stand one after the other among the supports, and are closed up to the piece that acts: a law is a support
!> with one state more for every breakpoint, and any scheme is still a logical array. An ordinary support is one breakpoint: open
!> before it,
!> a spring
!> after it.
!>
!> Which side of zero a breakpoint is on is measured along the steeper of the pieces beside it by the force, along the flatter by
!> the deflection: so neither 1e12 nor 1e-12 costs digits.
module gapbeam_polyline
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: node_support_type, piece_that_acts, piece_force, breakpoint_margin, breakpoint_slopes, is_steeper, is_watched
    public :: past_level, vertical_pieces
    public :: open_from, advance_one_segment, jump_to_plateau, coincide, last_breakpoint, join_pieces
    public :: break_law, find_unit, extend_piece, extend_pieces

    !> A support at a node, or a breakpoint of its law
    type :: node_support_type
        !> Node, 0..n
        integer :: node
        !> below, above or both (gapbeam_law)
        integer :: side
        !> Force per length; infinite for a rigid one. Of a breakpoint the slope of the piece that begins there
        real(wp) :: stiffness
        !> Deflection at which it begins to act: settlement + gap (below), settlement - gap (above). Of a breakpoint its place
        real(wp) :: contact
        !> Number of the breakpoint in its law, from 1; 0 for an ordinary support
        integer :: breakpoint = 0
        !> Is the next support the next breakpoint of the same law
        logical :: more = .false.
        !> Are both sides of it one line, so that nothing happens there
        logical :: passed = .false.
        !> Force at the breakpoint, in the direction in which the support pushes, and slope of the piece that ends there
        real(wp) :: force = 0.0_wp, before = 0.0_wp
    end type node_support_type

contains

    !> Does a piece beside a breakpoint act, and its slope: the one that begins there if no later breakpoint is closed, or the one
    !> before the first breakpoint
    pure subroutine piece_that_acts(supports, closed, k, acts, slope)
        !> All supports, the scheme, and the number of one with a law
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical, intent(out) :: acts
        real(wp), intent(out) :: slope

        associate (s => supports(k))
            if (closed(k)) then
                slope = s%stiffness
                acts = .true.
                if (s%more) acts = .not. closed(k + 1)
            else
                slope = s%before
                acts = s%breakpoint == 1 .and. (abs(s%before) > 0.0_wp .or. abs(s%force) > 0.0_wp)
            end if
        end associate
    end subroutine piece_that_acts

    !> Put the piece of a law that acts in place of all of it, as a line both ways; a vertical one holds what stands there
    pure subroutine extend_piece(supports, closed, anyhow)
        !> Breakpoints of the law
        type(node_support_type), intent(inout) :: supports(:)
        logical, intent(in) :: closed(:)
        !> Also where that piece rises vertically, and where none acts, so that there is no support
        logical, intent(in) :: anyhow
        real(wp) :: slope
        logical :: acts
        integer :: k, last

        k = max(1, count(closed))
        call piece_that_acts(supports, closed, k, acts, slope)
        if (.not. acts) slope = 0.0_wp
        if (.not. anyhow .and. (.not. acts .or. slope > huge(slope))) return
        ! Through the middle of a piece with two ends: so one about the origin goes through that
        last = k
        if (closed(k) .and. supports(k)%more) last = k + 1
        supports%contact = supports(k)%contact/2 + supports(last)%contact/2
        supports%force = merge(supports(k)%force/2 + supports(last)%force/2, 0.0_wp, acts)
        supports%stiffness = slope
        if (slope < -huge(slope)) supports%stiffness = -slope
        supports%before = supports%stiffness
        supports%passed = .true.
    end subroutine extend_piece

    !> The same of all laws; what acts one way holds both ways where it acts, and is not there where it does not
    pure subroutine extend_pieces(supports, closed)
        type(node_support_type), intent(inout) :: supports(:)
        logical, intent(in) :: closed(:)
        integer :: first, last

        last = 0
        do while (last < size(supports))
            first = last + 1
            last = last_breakpoint(supports, first)
            if (supports(first)%breakpoint > 0) then
                call extend_piece(supports(first:last), closed(first:last), .true.)
            else
                supports(first)%side = 0
                if (.not. closed(first)) supports(first)%stiffness = 0.0_wp
            end if
        end do
    end subroutine extend_pieces

    !> Force of a piece that is not vertical, positive up, and the rounding error of that
    pure subroutine piece_force(support, slope, deflection, deflection_size, force, rounding)
        !> The breakpoint and the slope of the piece
        type(node_support_type), intent(in) :: support
        real(wp), intent(in) :: slope
        !> Of the node, and the size of that for rounding errors
        real(wp), intent(in) :: deflection, deflection_size
        real(wp), intent(out) :: force, rounding

        force = slope*(deflection - support%contact) + support%side*support%force
        rounding = epsilon(force)*(abs(slope)*max(deflection_size, abs(support%contact)) + abs(support%force))
    end subroutine piece_force

    !> By how much the state of a breakpoint is right, and the rounding error of that
    pure subroutine breakpoint_margin(supports, closed, k, deflection, deflection_size, reaction, reaction_error, margin, &
                                      rounding, by_force)
        !> All supports, the scheme, and the number of one with a law
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        !> Of its node, and the size of that for rounding errors
        real(wp), intent(in) :: deflection, deflection_size
        !> Of all supports, and their rounding errors; that of a law is that of the breakpoint whose piece acts
        real(wp), intent(in) :: reaction(:), reaction_error(:)
        !> Force or deflection from here to the breakpoint, below zero beyond it; 0 where it is not watched
        real(wp), intent(out) :: margin, rounding
        !> Is it a force
        logical, intent(out) :: by_force
        real(wp) :: here, there
        integer :: from
        logical :: adjacent

        margin = 0.0_wp
        rounding = 0.0_wp
        by_force = .false.
        if (supports(k)%passed) return
        call breakpoint_slopes(supports, closed, k, adjacent, from, here, there)
        associate (s => supports(k))
            if (.not. adjacent .and. abs(here) > huge(here)) return
            by_force = adjacent .and. is_steeper(here, there)
            if (by_force) then
                margin = s%side*reaction(from) - s%force
                if (here < 0.0_wp) margin = -margin
                rounding = reaction_error(from) + epsilon(margin)*abs(s%force)
            else
                margin = s%side*(deflection - s%contact)
                rounding = epsilon(deflection)*max(deflection_size, abs(s%contact))
            end if
        end associate
        if (.not. closed(k)) margin = -margin
    end subroutine breakpoint_margin

    !> Does a force tell better than a deflection where a breakpoint is: by the slopes on this side of it and beyond
    elemental function is_steeper(here, there) result(steeper)
        real(wp), intent(in) :: here, there
        logical :: steeper

        steeper = abs(here) > abs(there) .or. abs(here) > huge(here)
    end function is_steeper

    !> Is a breakpoint beside the piece that acts, and the slopes on this side of it and beyond
    pure subroutine breakpoint_slopes(supports, closed, k, adjacent, from, here, there)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical, intent(out) :: adjacent
        !> The breakpoint that has the reaction of the law
        integer, intent(out) :: from
        real(wp), intent(out) :: here, there

        associate (s => supports(k))
            from = k
            adjacent = .true.
            if (closed(k)) then
                here = s%stiffness
                there = s%before
                if (s%more) adjacent = .not. closed(k + 1)
            else
                here = s%before
                there = s%stiffness
                if (s%breakpoint > 1) then
                    from = k - 1
                    adjacent = closed(k - 1)
                end if
            end if
        end associate
    end subroutine breakpoint_slopes

    !> By how much a node is beyond an end of the vertical piece on which a support of it is, since another one holds it elsewhere
    pure subroutine past_level(supports, closed, k, deflection, deflection_size, beyond, rounding)
        !> As for breakpoint_margin
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        real(wp), intent(in) :: deflection, deflection_size
        !> Deflection past the breakpoint, away from the piece, below zero the other way; 0 where the piece is not vertical
        real(wp), intent(out) :: beyond, rounding
        real(wp) :: here, there
        integer :: from
        logical :: adjacent

        beyond = 0.0_wp
        rounding = 0.0_wp
        if (supports(k)%passed) return
        call breakpoint_slopes(supports, closed, k, adjacent, from, here, there)
        if (.not. adjacent .or. abs(here) <= huge(here)) return
        associate (s => supports(k))
            beyond = s%side*(deflection - s%contact)
            if (closed(k)) beyond = -beyond
            rounding = epsilon(deflection)*max(deflection_size, abs(s%contact))
        end associate
    end subroutine past_level

    !> On how many vertical pieces some supports are: with two at one node nothing tells what each of them takes
    pure function vertical_pieces(supports, closed, numbers) result(pieces)
        !> All supports, the scheme, and the numbers of those in question
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: numbers(:)
        integer :: pieces
        real(wp) :: slope
        logical :: acts
        integer :: j

        pieces = 0
        do j = 1, size(numbers)
            associate (k => numbers(j))
                if (supports(k)%breakpoint > 0) then
                    call piece_that_acts(supports, closed, k, acts, slope)
                else
                    acts = closed(k)
                    slope = supports(k)%stiffness
                end if
                if (acts .and. abs(slope) > huge(slope)) pieces = pieces + 1
            end associate
        end do
    end function vertical_pieces

    !> Can a breakpoint be passed next or at once with others: not if a vertical piece lies between it and the piece that acts
    pure function is_watched(supports, closed, k) result(watched)
        !> As for breakpoint_margin
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical :: watched
        real(wp) :: here, there
        integer :: from

        call breakpoint_slopes(supports, closed, k, watched, from, here, there)
        watched = (watched .or. abs(here) <= huge(here)) .and. .not. supports(k)%passed
    end function is_watched

    !> Open the breakpoints of a law beyond its first open one
    pure subroutine open_from(supports, closed)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(inout) :: closed(:)
        integer :: k

        do k = 2, size(closed)
            if (supports(k)%breakpoint > 1) closed(k) = closed(k) .and. closed(k - 1)
        end do
    end subroutine open_from

    !> Let every law go on from one scheme to another by one piece only
    pure subroutine advance_one_segment(supports, before, closed)
        type(node_support_type), intent(in) :: supports(:)
        !> The first scheme
        logical, intent(in) :: before(:)
        !> The other one in, the one on the way to it out
        logical, intent(inout) :: closed(:)
        integer :: k, last, old, new

        call open_from(supports, closed)
        k = 1
        do while (k <= size(closed))
            last = last_breakpoint(supports, k)
            if (last > k) then
                old = count(before(k:last))
                new = count(closed(k:last))
                new = old + max(-1, min(1, new - old))
                closed(k:last) = .false.
                closed(k:k + new - 1) = .true.
            end if
            k = last + 1
        end do
    end subroutine advance_one_segment

    !> Let every law act by a level piece, on which it holds nothing, where it has one
    pure subroutine jump_to_plateau(supports, closed)
        type(node_support_type), intent(in) :: supports(:)
        !> Any scheme in, laws on their first level piece out; those that have none are on the piece before all breakpoints
        logical, intent(inout) :: closed(:)
        integer :: k, j, last

        k = 1
        do while (k <= size(closed))
            last = last_breakpoint(supports, k)
            if (supports(k)%breakpoint > 0) then
                closed(k:last) = .false.
                if (abs(supports(k)%before) > 0.0_wp) then
                    j = k - 1 + findloc(abs(supports(k:last)%stiffness) > 0.0_wp, .false., 1)
                    closed(k:j) = .true.
                end if
            end if
            k = last + 1
        end do
    end subroutine jump_to_plateau

    !> The last breakpoint of the law that begins at a support; the support itself if it has none
    pure function last_breakpoint(supports, k) result(last)
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: k
        integer :: last

        last = k
        do while (supports(last)%more)
            last = last + 1
        end do
    end function last_breakpoint

    !> Slopes from the breakpoints they lead to, so that pieces rounded to less precision join again
    pure subroutine join_pieces(supports)
        type(node_support_type), intent(inout) :: supports(:)
        real(wp) :: width
        integer :: k

        do k = 1, size(supports) - 1
            if (.not. supports(k)%more .or. supports(k)%passed) cycle
            associate (a => supports(k), b => supports(k + 1))
                width = a%side*(b%contact - a%contact)
                if (.not. width > 0.0_wp .or. .not. abs(a%stiffness) <= huge(width)) cycle
                ! Both sides of a breakpoint that was passed may be one line
                if (abs(a%stiffness) > 0.0_wp) a%stiffness = (b%force - a%force)/width
                b%before = a%stiffness
            end associate
        end do
    end subroutine join_pieces

    !> A law that is broken up to a breakpoint: one line, on both sides of it and of those before
    pure subroutine break_law(supports, k)
        type(node_support_type), intent(inout) :: supports(:)
        !> At the end of a drop of the force
        integer, intent(in) :: k
        integer :: first

        first = k - supports(k)%breakpoint + 1
        supports(first:k)%contact = supports(k)%contact
        supports(first:k)%force = supports(k)%force
        supports(first:k)%before = supports(k)%stiffness
        supports(first:k)%stiffness = supports(k)%stiffness
        supports(first:k)%passed = .true.
    end subroutine break_law

    !> Breakpoints that are passed together with one: first and last
    pure subroutine find_unit(supports, closed, k, first, last)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        integer, intent(out) :: first, last

        first = k
        do while (supports(first)%breakpoint > 1)
            if (.not. coincide(supports, first - 1) .or. (closed(first - 1) .neqv. closed(first))) exit
            first = first - 1
        end do
        last = k
        do while (coincide(supports, last))
            if (closed(last) .neqv. closed(last + 1)) exit
            last = last + 1
        end do
    end subroutine find_unit

    !> Are a breakpoint and the next one of its law the same point, so that they are passed together
    pure function coincide(supports, k) result(same)
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: k
        logical :: same

        same = supports(k)%more
        if (same) same = .not. (abs(supports(k + 1)%contact - supports(k)%contact) > 0.0_wp &
                                .or. abs(supports(k + 1)%force - supports(k)%force) > 0.0_wp)
    end function coincide

end module gapbeam_polyline
