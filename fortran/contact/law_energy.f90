!> The energy of a beam on supports with laws, along the way from one state of it to another.
!>
!> Two solutions of the beam on any lines in place of the laws are each in equilibrium with the forces of their supports; between
!> them deflections and these forces change in proportion, and the energy with the true laws has there the slope
!>
!>     sum over the supports of (change of deflection) * (force of the law - force in equilibrium)
!>
!> which never falls where no force falls with growing displacement. Going to where it vanishes is the line search that Newton's
!> method wants to settle from any start (semismooth Newton: Pang and Qi 1995, Facchinei 1995).
module gapbeam_law_energy
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_line_steps
    use gapbeam_tolerances, only: flat_energy
    use gapbeam_band, only: answer_type
    use gapbeam_law, only: node_support_type, both, is_rigid
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_line_search, only: bracket_type, place_inside, narrow
    implicit none
    private
    public :: is_convex, way_to_least_energy, force_at, states_of_laws

contains

    !> Does the force of no support fall, so that the energy is convex
    pure function is_convex(supports) result(convex)
        type(node_support_type), intent(in) :: supports(:)
        logical :: convex

        convex = all(supports%stiffness >= 0.0_wp .and. supports%before >= 0.0_wp)
    end function is_convex

    !> What share of the way from one state to another leads to the least energy on it, up to all of it
    pure function way_to_least_energy(supports, from, from_force, to, to_force) result(t)
        type(node_support_type), intent(in) :: supports(:)
        !> Deflections of the nodes in both states, shape (0:n); and the reactions of the supports with which the beam is in
        !> equilibrium there, shape (size(supports))
        real(wp), intent(in) :: from(0:), from_force(:)
        type(answer_type), intent(in) :: to(0:)
        real(wp), intent(in) :: to_force(:)
        real(wp) :: t
        type(bracket_type) :: bracket
        real(wp) :: first, slope
        integer :: number

        t = 1.0_wp
        first = energy_slope(0.0_wp)
        slope = energy_slope(t)
        if (slope <= flat_energy*abs(first) .or. .not. first < 0.0_wp) return
        bracket = bracket_type(0.0_wp, t, first, slope)
        do number = 1, most_line_steps
            t = place_inside(bracket)
            slope = energy_slope(t)
            if (abs(slope) <= flat_energy*abs(first)) exit
            call narrow(bracket, t, slope)
        end do

    contains

        !> Slope of the energy
        pure function energy_slope(t) result(slope)
            !> Share of the way
            real(wp), intent(in) :: t
            real(wp) :: slope, change
            integer :: k, last

            slope = 0.0_wp
            k = 1
            do while (k <= size(supports))
                last = last_breakpoint(supports, k)
                associate (node => supports(k)%node)
                    change = to(node)%deflection - from(node)
                    slope = slope + change*(force_at(supports(k:last), from(node) + t*change) &
                                            - ((1 - t)*sum(from_force(k:last)) + t*sum(to_force(k:last))))
                end associate
                k = last + 1
            end do
        end function energy_slope

    end function way_to_least_energy

    !> Reaction of a support by its law: of a rigid one none, on a vertical piece what it has at its beginning
    pure function force_at(law, deflection) result(force)
        !> The support, or all breakpoints of its law
        type(node_support_type), intent(in) :: law(:)
        real(wp), intent(in) :: deflection
        real(wp) :: force, past, slope
        integer :: piece

        piece = pieces_reached(law, deflection)
        associate (s => law(max(1, piece)))
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
