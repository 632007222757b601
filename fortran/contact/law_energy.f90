!> The energy of a beam on supports with laws, along the way from one state of it to another.
!>
!> Two solutions of the beam on any lines in place of the laws are each in equilibrium with the forces of their supports; between
!> them deflections and these forces change in proportion, and the energy with the true laws has there the slope
!>
!>     sum over the supports of (change of deflection) * (force of the law - force in equilibrium)
!>
!> which never falls where no force falls with growing displacement. Going to where it vanishes is the line search that Newton's
!> method wants to settle from any start (semismooth Newton: Pang and Qi 1995, Facchinei 1995). Where lines let the beam go, the
!> way is the motion on which they do: laws, and supports that it reaches, tell how far.
module gapbeam_law_energy
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_line_steps
    use gapbeam_tolerances, only: flat_energy, first_way, last_way
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_law, only: node_support_type, both, is_rigid
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_line_search, only: bracket_type, place_inside, narrow
    implicit none
    private
    public :: line_type, new_line, is_convex, go_towards, way_to_rest, states_of_laws

    !> Deflections of the nodes and reactions of the supports at its beginning, and their changes along it, shapes (0:n) and (m)
    type :: line_type
        real(wp), allocatable :: deflection(:), step(:), reaction(:), change(:)
    contains
        !> Reaction of a support by its law
        procedure :: force_at
    end type line_type

contains

    !> Room for a line, at a state
    pure subroutine new_line(deflection, reaction, line, error)
        !> Of the nodes and of the supports
        real(wp), intent(in) :: deflection(0:), reaction(:)
        class(line_type), intent(inout) :: line
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: n, m, stat

        n = ubound(deflection, 1)
        m = size(reaction)
        allocate (line%deflection(0:n), line%step(0:n), line%reaction(m), line%change(m), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        line%deflection(:) = deflection
        line%reaction(:) = reaction
    end subroutine new_line

    !> Does the force of no support fall, so that the energy is convex
    pure function is_convex(supports) result(convex)
        type(node_support_type), intent(in) :: supports(:)
        logical :: convex

        convex = all(supports%stiffness >= 0.0_wp .and. supports%before >= 0.0_wp)
    end function is_convex

    !> Go from a state towards another one, to the least energy on the way
    pure subroutine go_towards(line, supports, deflection, reaction, whole, way)
        !> At the first state; then where that leads
        class(line_type), intent(inout) :: line
        type(node_support_type), intent(in) :: supports(:)
        !> Deflections and reactions of the other state
        real(wp), intent(in) :: deflection(0:), reaction(:)
        !> Go all the way, whatever the energy
        logical, intent(in) :: whole
        !> What share of the way that is
        real(wp), intent(out) :: way

        line%step(:) = deflection - line%deflection
        line%change(:) = reaction - line%reaction
        way = 1.0_wp
        if (.not. whole) way = way_to_least_energy(line, supports)
        if (way < 1.0_wp) then
            line%deflection(:) = line%deflection + way*line%step
            line%reaction(:) = line%reaction + way*line%change
        else
            line%deflection(:) = deflection
            line%reaction(:) = reaction
        end if
    end subroutine go_towards

    !> What share of a line leads to the least energy on it, up to all of it
    pure function way_to_least_energy(line, supports) result(t)
        class(line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        real(wp) :: t, first, slope, rounding

        t = 1.0_wp
        call find_slope(line, supports, 0.0_wp, first, rounding)
        call find_slope(line, supports, t, slope, rounding)
        if (slope <= max(flat_energy*abs(first), rounding) .or. .not. first < 0.0_wp) return
        t = flat_place(line, supports, bracket_type(0.0_wp, t, first, slope), abs(first))
    end function way_to_least_energy

    !> How far a motion goes until the laws stop it; infinite where nothing does
    pure function way_to_rest(line, supports, length) result(t)
        !> The motion is its step; the reactions do not change
        class(line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        !> Of the beam, or its largest deflection
        real(wp), intent(in) :: length
        real(wp) :: t, first, rounding
        type(bracket_type) :: bracket

        call find_slope(line, supports, 0.0_wp, first, rounding)
        bracket = bracket_type(0.0_wp, first_way*length, first, 0.0_wp)
        do
            t = bracket%high
            if (.not. t <= last_way*length) then
                t = ieee_value(t, ieee_positive_inf)
                return
            end if
            call find_slope(line, supports, t, bracket%at_high, rounding)
            if (bracket%at_high > 0.0_wp) exit
            bracket = bracket_type(t, 8*t, bracket%at_high, 0.0_wp)
        end do
        t = flat_place(line, supports, bracket, abs(first))
    end function way_to_rest

    !> Where the slope has fallen to a small share of what it was
    pure function flat_place(line, supports, bracket, first) result(t)
        class(line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        !> Around that place, and the absolute slope in the beginning
        type(bracket_type), value :: bracket
        real(wp), intent(in) :: first
        real(wp) :: t, slope, rounding
        integer :: number

        do number = 1, most_line_steps
            t = place_inside(bracket)
            call find_slope(line, supports, t, slope, rounding)
            if (abs(slope) <= flat_energy*first) return
            call narrow(bracket, t, slope)
        end do
    end function flat_place

    !> Slope of the energy at a place of a line, and what of it may be rounding
    pure subroutine find_slope(line, supports, t, slope, rounding)
        class(line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        real(wp), intent(in) :: t
        real(wp), intent(out) :: slope, rounding
        real(wp) :: force, carried
        integer :: k, last

        slope = 0.0_wp
        rounding = 0.0_wp
        k = 1
        do while (k <= size(supports))
            last = last_breakpoint(supports, k)
            associate (step => line%step(supports(k)%node))
                force = line%force_at(supports, k, last, line%deflection(supports(k)%node) + t*step)
                carried = sum(line%reaction(k:last)) + t*sum(line%change(k:last))
                slope = slope + step*(force - carried)
                rounding = rounding + 8*epsilon(slope)*abs(step)*(abs(force) + abs(carried))
            end associate
            k = last + 1
        end do
    end subroutine find_slope

    !> Reaction of a support by its law: of a rigid one none, on a vertical piece what it has at its beginning
    pure function force_at(line, supports, first, last, deflection) result(force)
        class(line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        !> The support, or the breakpoints of its law
        integer, intent(in) :: first, last
        !> Of its node
        real(wp), intent(in) :: deflection
        real(wp) :: force, past, slope
        integer :: piece

        associate (unused => line)
        end associate
        piece = pieces_reached(supports(first:last), deflection)
        associate (s => supports(first - 1 + max(1, piece)))
            past = deflection - s%contact
            if (s%breakpoint == 0) then
                slope = merge(s%stiffness, 0.0_wp, piece > 0 .or. s%side == both)
            else
                slope = merge(s%stiffness, s%before, piece > 0)
            end if
            force = s%side*s%force
            if (abs(slope) <= huge(slope)) force = force + slope*past
        end associate
    end function force_at

    !> How many breakpoints of a law a deflection has reached
    pure function pieces_reached(law, deflection) result(number)
        type(node_support_type), intent(in) :: law(:)
        real(wp), intent(in) :: deflection
        integer :: number, beyond, middle

        number = 0
        beyond = size(law) + 1
        do while (beyond - number > 1)
            middle = (number + beyond)/2
            if (law(middle)%side*(deflection - law(middle)%contact) >= 0.0_wp) then
                number = middle
            else
                beyond = middle
            end if
        end do
    end function pieces_reached

    !> The states in which deflections are; those of rigid supports stay
    pure subroutine states_of_laws(supports, deflection, closed)
        type(node_support_type), intent(in) :: supports(:)
        !> Of the nodes, shape (0:n)
        real(wp), intent(in) :: deflection(0:)
        logical, intent(inout) :: closed(:)
        integer :: k, last

        k = 1
        do while (k <= size(supports))
            last = last_breakpoint(supports, k)
            associate (s => supports(k))
                if (s%breakpoint > 0) then
                    closed(k:last) = .false.
                    closed(k:k - 1 + pieces_reached(supports(k:last), deflection(s%node))) = .true.
                else if (s%side /= both .and. .not. is_rigid(s)) then
                    closed(k) = s%side*(deflection(s%node) - s%contact) > 0.0_wp
                end if
            end associate
            k = last + 1
        end do
    end subroutine states_of_laws

end module gapbeam_law_energy
