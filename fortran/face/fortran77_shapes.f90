!> Many cases for the Fortran 77 interface: arrays with their shapes
module gapbeam_fortran77_shapes
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_api, only: prepared_type, options_type
    use gapbeam_api_cases, only: cases_type, solve_cases
    implicit none
    private
    public :: solve_shaped

contains

    !> Solve cases, as solve_cases
    subroutine solve_shaped(beam, cases, loads, supports, nodes, ncase, factor, varied, given, rule, status, reaction, condition, &
                            deflection, left, right, error)
        type(prepared_type), intent(in) :: beam
        type(cases_type), intent(inout) :: cases
        integer, intent(in) :: loads, supports, nodes, ncase
        real(wp), intent(in) :: factor(loads, ncase)
        !> Settlement, gap and stiffness of the supports, where they vary
        logical, intent(in) :: varied
        real(wp), intent(in) :: given(3, supports, merge(ncase, 0, varied))
        integer, intent(in) :: rule
        !> As for solve_cases
        integer, intent(inout) :: status(ncase), condition(supports, ncase)
        real(wp), intent(inout) :: reaction(supports, ncase), deflection(nodes, ncase), left(nodes, ncase), right(nodes, ncase)
        type(error_type), allocatable, intent(out) :: error

        if (varied) then
            call solve_cases(beam, cases, factor, status, error, given(1, :, :), given(2, :, :), given(3, :, :), &
                             options_type(rule), reaction, condition, deflection, left, right)
        else
            call solve_cases(beam, cases, factor, status, error, options=options_type(rule), reaction=reaction, &
                             condition=condition, deflection=deflection, moment_left=left, moment_right=right)
        end if
    end subroutine solve_shaped

end module gapbeam_fortran77_shapes
