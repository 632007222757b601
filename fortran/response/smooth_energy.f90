!> The energy of a beam on smooth laws of supports along a line: as gapbeam_law_energy, with the curves in place of polylines.
module gapbeam_smooth_energy
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: node_support_type
    use gapbeam_law_energy, only: line_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: past_the_gap, force_and_slope
    implicit none
    private
    public :: smooth_line_type

    !> A line of the supports of a beam, in the engine's units
    type, extends(line_type) :: smooth_line_type
        type(assembled_type), pointer :: assembled => null()
    contains
        procedure :: force_at => smooth_force_at
    end type smooth_line_type

contains

    !> Reaction of a support by its curve, or by its law where that is none
    pure function smooth_force_at(line, supports, first, last, deflection) result(force)
        class(smooth_line_type), intent(in) :: line
        type(node_support_type), intent(in) :: supports(:)
        integer, intent(in) :: first, last
        real(wp), intent(in) :: deflection
        real(wp) :: force, past, slope
        integer :: way

        associate (s => line%assembled%model%supports(line%assembled%normal(first)), units => line%assembled%units)
            if (is_smooth(s%law)) then
                call past_the_gap(s, scale(deflection, units%deflection), past, way)
                call force_and_slope(s, past, force, slope)
                force = scale(way*force, -units%force)
            else
                force = line%line_type%force_at(supports, first, last, deflection)
            end if
        end associate
    end function smooth_force_at

end module gapbeam_smooth_energy
