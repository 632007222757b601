!> Extremes of fields and supports over the runs of a train, with all ties.
module gapbeam_train_run_extremes
    use gapbeam_error, only: error_type
    use gapbeam_quantities, only: of_shear
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_ties, only: extreme_type, tie_type
    use gapbeam_train_asked, only: asked_type, of_field, of_support, rows_of_support
    use gapbeam_train_limits, only: limit_type, find_limits
    use gapbeam_train_peaks, only: peak_type, find_peaks
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: fields_of_runs, supports_of_runs, peaks_of

    !> Rows of the values of a support in the order reaction, opening, deflection, couple
    integer, parameter :: rows(rows_of_support) = [1, 3, 2, 4]

contains

    !> Largest (1) and smallest (2) values of quantities
    subroutine fields_of_runs(assembled, runs, quantities, extremes, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        !> Their numbers (gapbeam_quantities)
        integer, intent(in) :: quantities(:)
        !> Shape (2, size(quantities))
        type(extreme_type), intent(out) :: extremes(:, :)
        !> As for find_peaks
        type(error_type), allocatable, intent(out) :: error
        type(peak_type), allocatable :: peaks(:)
        integer :: i, k

        do k = 1, size(quantities)
            do i = 1, 2
                call peaks_of(assembled, runs, asked_type(of_field, quantities(k), 0, i == 2), peaks, error)
                if (allocated(error)) return
                extremes(i, k) = as_extreme(peaks)
            end do
        end do
    end subroutine fields_of_runs

    !> The same of reaction, opening, deflection, couple of every support
    subroutine supports_of_runs(assembled, runs, extremes, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        !> Shape (2, 4, number of supports)
        type(extreme_type), intent(out) :: extremes(:, :, :)
        !> As for find_peaks
        type(error_type), allocatable, intent(out) :: error
        type(peak_type), allocatable :: peaks(:)
        integer :: i, j, k

        do k = 1, size(extremes, 3)
            do j = 1, size(rows)
                do i = 1, 2
                    call peaks_of(assembled, runs, asked_type(of_support, k, rows(j), i == 2), peaks, error)
                    if (allocated(error)) return
                    extremes(i, j, k) = as_extreme(peaks)
                end do
            end do
        end do
    end subroutine supports_of_runs

    !> The largest value of one of them, all that tie
    subroutine peaks_of(assembled, runs, asked, peaks, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        type(asked_type), intent(in) :: asked
        type(peak_type), allocatable, intent(out) :: peaks(:)
        !> As for find_peaks
        type(error_type), allocatable, intent(out) :: error
        type(limit_type), allocatable :: limits(:)

        allocate (limits(0))
        if (asked%of == of_field .and. asked%number == of_shear) call find_limits(assembled, runs, limits, error)
        if (.not. allocated(error)) call find_peaks(assembled, runs, asked, limits, peaks, error)
    end subroutine peaks_of

    !> Peaks as an extreme
    pure function as_extreme(peaks) result(extreme)
        type(peak_type), intent(in) :: peaks(:)
        type(extreme_type) :: extreme
        integer :: k

        extreme%number = min(size(peaks), size(extreme%ties))
        do k = 1, extreme%number
            associate (p => peaks(k))
                extreme%ties(k) = tie_type(value=p%value, x=p%x, position=p%position, side=p%side)
            end associate
        end do
    end function as_extreme

end module gapbeam_train_run_extremes
