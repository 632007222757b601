!> The energy of a beam on smooth laws of supports, along a line: how far a tangent may be followed.
!>
!> As in gapbeam_law_energy, with the curves themselves in place of lines. Where tangents let the beam go, the line is the motion on
!> which they do: the curves, and supports that it reaches, tell how far.
module gapbeam_smooth_energy
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_line_steps
    use gapbeam_tolerances, only: flat_energy, first_way, last_way
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_law_energy, only: force_at
    use gapbeam_line_search, only: bracket_type, place_inside, narrow
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: past_the_gap, force_and_slope
    implicit none
    private
    public :: line_type, way_to_least_energy, way_to_rest

    !> Deflections and reactions at its beginning and their changes along it, in the engine's units, shapes (0:n) and (number of
    !> the beam's supports)
    type :: line_type
        real(wp), allocatable :: deflection(:), step(:), reaction(:), change(:)
    end type line_type

contains

    !> What share of a line leads to the least energy on it, up to all of it
    pure function way_to_least_energy(assembled, line) result(t)
        type(assembled_type), intent(in) :: assembled
        type(line_type), intent(in) :: line
        real(wp) :: t, first, slope, rounding

        t = 1.0_wp
        call find_slope(assembled, line, 0.0_wp, first, rounding)
        call find_slope(assembled, line, t, slope, rounding)
        if (slope <= max(flat_energy*abs(first), rounding) .or. .not. first < 0.0_wp) return
        t = flat_place(assembled, line, bracket_type(0.0_wp, t, first, slope), abs(first))
    end function way_to_least_energy

    !> How far a motion goes until the curves stop it; infinite where nothing does
    pure function way_to_rest(assembled, line) result(t)
        !> As for way_to_least_energy; the reactions do not change
        type(assembled_type), intent(in) :: assembled
        type(line_type), intent(in) :: line
        real(wp) :: t, first, length, rounding
        type(bracket_type) :: bracket

        call find_slope(assembled, line, 0.0_wp, first, rounding)
        length = max(sum(assembled%pieces%length), maxval(abs(line%deflection)))
        bracket = bracket_type(0.0_wp, first_way*length, first, 0.0_wp)
        do
            t = bracket%high
            if (.not. t <= last_way*length) then
                t = ieee_value(t, ieee_positive_inf)
                return
            end if
            call find_slope(assembled, line, t, bracket%at_high, rounding)
            if (bracket%at_high > 0.0_wp) exit
            bracket = bracket_type(t, 8*t, bracket%at_high, 0.0_wp)
        end do
        t = flat_place(assembled, line, bracket, abs(first))
    end function way_to_rest

    !> Where the slope has fallen to a small share of what it was
    pure function flat_place(assembled, line, bracket, first) result(t)
        type(assembled_type), intent(in) :: assembled
        type(line_type), intent(in) :: line
        !> Around that place, and the absolute slope in the beginning
        type(bracket_type), value :: bracket
        real(wp), intent(in) :: first
        real(wp) :: t, slope, rounding
        integer :: number

        do number = 1, most_line_steps
            t = place_inside(bracket)
            call find_slope(assembled, line, t, slope, rounding)
            if (abs(slope) <= flat_energy*first) return
            call narrow(bracket, t, slope)
        end do
    end function flat_place

    !> Slope of the energy at a place of a line, and what of it may be rounding
    pure subroutine find_slope(assembled, line, t, slope, rounding)
        type(assembled_type), intent(in) :: assembled
        type(line_type), intent(in) :: line
        real(wp), intent(in) :: t
        real(wp), intent(out) :: slope, rounding
        real(wp) :: force, carried
        integer :: k, last

        slope = 0.0_wp
        rounding = 0.0_wp
        k = 1
        do while (k <= size(assembled%beam%supports))
            last = last_breakpoint(assembled%beam%supports, k)
            associate (node => assembled%beam%supports(k)%node, number => assembled%normal(k))
                if (is_smooth(assembled%model%supports(number)%law)) then
                    force = smooth_force(assembled, number, line%deflection(node) + t*line%step(node))
                else
                    force = force_at(assembled%beam%supports(k:last), line%deflection(node) + t*line%step(node))
                end if
                carried = sum(line%reaction(k:last)) + t*sum(line%change(k:last))
                slope = slope + line%step(node)*(force - carried)
                rounding = rounding + 8*epsilon(slope)*abs(line%step(node))*(abs(force) + abs(carried))
            end associate
            k = last + 1
        end do
    end subroutine find_slope

    !> Reaction of a support by its curve, in the engine's units
    pure function smooth_force(assembled, number, deflection) result(force)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: number
        !> Of its node in the engine's units
        real(wp), intent(in) :: deflection
        real(wp) :: force, past, slope
        integer :: way

        associate (s => assembled%model%supports(number), units => assembled%units)
            call past_the_gap(s, scale(deflection, units%deflection), past, way)
            call force_and_slope(s, past, force, slope)
            force = scale(way*force, -units%force)
        end associate
    end function smooth_force

end module gapbeam_smooth_energy
