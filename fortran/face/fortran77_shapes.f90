!> Many cases, and curves of trains, for the Fortran 77 interface: arrays with their shapes
module gapbeam_fortran77_shapes
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_api, only: prepared_type, options_type
    use gapbeam_api_cases, only: cases_type, solve_cases
    use gapbeam_api_trains, only: get_train_quantity_curves
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_equilibrium, gapbeam_no_memory, handle_type, passing_tag, find_both, &
        info_of
    implicit none
    private
    public :: solve_shaped, fill_curves

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

    !> Curves of a train, as get_train_quantity_curves; what GHTCRV and GHTQCR do
    subroutine fill_curves(beam, pass, nquan, iquan, nx, x, places, curve, posn, info)
        integer(int64), intent(in) :: beam, pass
        integer, intent(in) :: nquan, nx, iquan(nquan)
        real(wp), intent(in) :: x(nx)
        !> Places of NX, X and IQUAN among the arguments; NQUAN is before IQUAN
        integer, intent(in) :: places(3)
        !> Written only where some position is solved
        real(wp), intent(inout) :: curve(2, nquan, nx), posn(2, nquan, nx)
        integer, intent(out) :: info
        type(handle_type), pointer :: prepared, passed
        real(wp), allocatable :: value(:, :, :), position(:, :, :)
        type(error_type), allocatable :: error
        integer :: stat

        call find_both(beam, pass, passing_tag, prepared, passed, info)
        if (info == 0 .and. nquan < 1) info = 1 - places(3)
        if (info == 0 .and. nx < 0) info = -places(1)
        if (info /= 0) return
        allocate (value(2, nquan, nx), position(2, nquan, nx), stat=stat)
        if (stat /= 0) info = gapbeam_no_memory
        if (info /= 0) return
        call get_train_quantity_curves(prepared%beam, passed%passing, iquan, x, value, position, error)
        info = info_of(error, places(2), ["quantities"], places(3:3))
        if (info /= 0 .or. nx == 0) return
        if (.not. value(1, 1, 1) > -huge(value)) info = gapbeam_no_equilibrium
        if (info /= 0) return
        curve(:, :, :) = value
        posn(:, :, :) = position
    end subroutine fill_curves

end module gapbeam_fortran77_shapes
