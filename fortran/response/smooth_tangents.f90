!> Tangents in place of smooth laws of supports: where they are put, and whether another one changes nothing.
module gapbeam_smooth_tangents
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: settled_on_laws, position_tolerance
    use gapbeam_laws, only: begins_steep, law_displacement, law_force, law_scale
    use gapbeam_polyline, only: node_support_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_units, only: stiffness_unit
    use gapbeam_slight_supports, only: slight_stiffness
    use gapbeam_law_energy, only: line_type
    use gapbeam_smooth_laws, only: past_the_gap, force_and_slope, deflection_at, reaction_at, put_line
    implicit none
    private
    public :: place_type, find_places, are_settled, put_tangents, last_digit, rounding

    !> Tangents that usually do, from a polyline as near as it is some five
    integer, parameter :: usual_tangents = 10
    !> So often a tangent may lead too far; after that the support has opened
    integer, parameter :: most_shortened = 12
    !> Slope beside force over displacement which is none
    real(wp), parameter :: flat_slope = 2.0_wp**(-50)
    !> Share of a force by which a tangent at the solution is beside its curve at most; the same where more tangents bring no more
    !> digits
    real(wp), parameter :: last_digit = epsilon(1.0_wp)/2, rounding = 1e-13_wp
    !> Share of the scale of a law below which a force, or a displacement, is none: where nothing acts, tangents lead nearer to
    !> that for ever
    real(wp), parameter :: no_force = epsilon(1.0_wp)**2, no_displacement = epsilon(1.0_wp)**8

    !> Where the supports with smooth laws are: in the user's units, one entry each
    type :: place_type
        !> Deflection of the beam; displacement past the gap, and which way that goes; force in that way
        real(wp) :: deflection = 0.0_wp, past = 0.0_wp, reached = 0.0_wp
        !> The larger of its distance from the support and the gap, or nothing, to which digits of the displacement are relative
        real(wp) :: size = 0.0_wp
        !> What rounding of its deflection is where the support has settled
        real(wp) :: settled_rounding = 0.0_wp
        integer :: way = 0
        !> Does the law begin steep, and does the force tell the displacement
        logical :: steep = .false., by_force = .false.
        !> The displacement where the last tangent was put, its way and its change, and how often it has been shortened
        real(wp) :: before = huge(1.0_wp), change = 0.0_wp
        integer :: way_before = 0, shortened = 0
    end type place_type

contains

    !> Where supports are
    pure subroutine find_places(assembled, numbers, line, by_displacement, places)
        type(assembled_type), intent(in) :: assembled
        !> Supports of the model with smooth laws
        integer, intent(in) :: numbers(:)
        !> Deflections and reactions at its beginning
        class(line_type), intent(in) :: line
        !> The displacement tells the force, also where a law begins steep
        logical, intent(in) :: by_displacement
        !> What was before stays; one entry each
        type(place_type), intent(inout) :: places(:)
        integer :: j

        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)), p => places(j))
                p%deflection = deflection_at(assembled, line%deflection, numbers(j))
                p%size = max(abs(p%deflection - s%settlement), abs(s%gap), least_displacement(s%law, s%parameter))
                p%settled_rounding = 2*epsilon(1.0_wp)*abs(s%settlement)
                call past_the_gap(s, p%deflection, p%past, p%way)
                p%reached = p%way*reaction_at(assembled, line%reaction, numbers(j))
                p%steep = begins_steep(s%law, s%parameter)
                p%by_force = p%steep .and. p%reached > 0.0_wp .and. .not. by_displacement
                if (p%by_force) p%past = law_displacement(s%law, s%parameter, p%reached)
            end associate
        end do
    end subroutine find_places

    !> A displacement that is none
    pure function least_displacement(law, parameter) result(least)
        integer, intent(in) :: law
        real(wp), intent(in) :: parameter(:)
        real(wp) :: least

        least = law_scale(law, parameter)
        if (begins_steep(law, parameter)) then
            least = law_displacement(law, parameter, no_force*law_force(law, parameter, least))
        else
            least = no_displacement*least
        end if
    end function least_displacement

    !> Does another tangent change nothing
    pure function are_settled(assembled, numbers, tangents, places) result(they_are)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: numbers(:)
        !> How many have been put so far
        integer, intent(in) :: tangents
        type(place_type), intent(in) :: places(:)
        logical :: they_are
        real(wp) :: force, slope
        integer :: j

        if (tangents < usual_tangents) then
            they_are = all(abs(places%past - places%before) <= settled_on_laws*places%size + places%settled_rounding)
        else
            they_are = all(abs(places%past - places%before) <= rounding*maxval(places%size) + places%settled_rounding)
        end if
        if (they_are .or. any(places%by_force)) return
        ! The tangents have met the curves to the last digit: another round would move the displacements by rounding alone
        do j = 1, size(places)
            call force_and_slope(assembled%model%supports(numbers(j)), places(j)%past, force, slope)
            if (slope > huge(slope)) return
            if (.not. abs(force - places(j)%reached) <= last_digit*(abs(force) + slope*places(j)%size)) return
        end do
        they_are = .true.
    end function are_settled

    !> Put tangents in place of the laws, where supports are or nearer
    pure subroutine put_tangents(assembled, numbers, tangents, searching, places, lines)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: numbers(:)
        !> How many have been put so far
        integer, intent(in) :: tangents
        !> Does the energy tell how far they lead, so that none need be put nearer
        logical, intent(in) :: searching
        type(place_type), intent(inout) :: places(:)
        !> The beam's supports
        type(node_support_type), intent(inout) :: lines(:)
        real(wp) :: force, slope, least
        integer :: j
        logical :: overshot, halved

        least = scale(slight_stiffness(assembled), stiffness_unit(assembled%units))
        do j = 1, size(numbers)
            associate (p => places(j), s => assembled%model%supports(numbers(j)))
                ! From a flat part of a curve the tangent may lead to its other side: first nearer, on this side
                overshot = .not. searching .and. p%before > 0.0_wp .and. p%before < huge(p%before) .and. &
                    p%shortened < most_shortened .and. (.not. p%past > 0.0_wp .or. p%way /= p%way_before)
                if (overshot) then
                    p%past = p%before/8
                    p%way = p%way_before
                    p%shortened = p%shortened + 1
                end if
                ! About a bend they may go to and fro for ever: then half as far
                halved = .not. searching .and. tangents >= usual_tangents .and. p%past > 0.0_wp .and. &
                    p%way == p%way_before .and. (p%past - p%before)*p%change < 0.0_wp
                if (tangents > 0) p%change = p%past - p%before
                if (halved) p%past = (p%past + p%before)/2
                p%before = p%past
                p%way_before = p%way
                if (p%by_force .or. overshot .or. halved) p%deflection = s%settlement + p%way*(s%gap + p%past)
                call force_and_slope(s, p%past, force, slope)
                ! So flat that it changes no digit of the force, or of the state
                if ((slope*p%past <= flat_slope*force .and. force > 0.0_wp) .or. slope < least) slope = 0.0_wp
                ! Where another support holds the beam a curve that begins steep carries nothing
                if (slope > huge(slope)) slope = merge(0.0_wp, slope, is_held_beside(assembled, numbers(j), p%deflection, lines))
                call put_line(assembled, numbers(j), p%deflection, force*p%way, slope, lines)
            end associate
        end do
    end subroutine put_tangents

    !> Does another support at the place of one hold the beam rigidly at a deflection
    pure function is_held_beside(assembled, number, deflection, lines) result(held)
        type(assembled_type), intent(in) :: assembled
        !> The support, and the deflection there
        integer, intent(in) :: number
        real(wp), intent(in) :: deflection
        !> The beam's supports
        type(node_support_type), intent(in) :: lines(:)
        logical :: held
        real(wp) :: contact(size(lines))

        contact(:) = scale(lines%contact, assembled%units%deflection)
        held = any(lines%node == lines(assembled%beam_support(number))%node .and. assembled%normal /= number &
                   .and. lines%stiffness > huge(deflection) .and. abs(contact - deflection) <= position_tolerance*abs(deflection))
    end function is_held_beside

end module gapbeam_smooth_tangents
