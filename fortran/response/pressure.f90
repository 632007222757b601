!> Pressure of the ground on a beam in the user's units: at places, and its extremes.
module gapbeam_pressure
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_words, only: shown
    use gapbeam_quantities, only: of_pressure, quantity_names, quantity_remedies
    use gapbeam_units, only: quantity_unit
    use gapbeam_input_error, only: refuse_range
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_pressure, only: ground_pressure, pressure_extremes
    implicit none
    private
    public :: pressure_in_pieces, extremes_of_pressure

contains

    !> Pressure at given distances from the left ends of pieces
    subroutine pressure_in_pieces(assembled, solution, piece, distance, pressure, error)
        !> The beam, and its solution on the ground
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> The pieces, and the distances in the user's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Force per length on the beam, up, shape (n); written only where none is out of range
        real(wp), intent(inout) :: pressure(:)
        !> A pressure out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: found(:)
        integer :: i, stat

        allocate (found(size(piece)), stat=stat)
        if (failed(stat, error)) return
        call ground_pressure(assembled, solution, piece, scale(distance, -assembled%units%length), found)
        found(:) = scale(found, quantity_unit(assembled%units, of_pressure))
        i = findloc(abs(found) <= huge(found), .false., 1)
        if (i == 0) then
            pressure(:) = found
        else
            call refuse_pressure(point_x(assembled, piece(i) - 1) + distance(i), error)
            error%entry = i
        end if
    end subroutine pressure_in_pieces

    !> Largest and smallest pressure
    subroutine extremes_of_pressure(assembled, solution, value, x, error)
        !> As for pressure_in_pieces
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Maximum (1) and minimum (2), force per length on the beam, up, and their places
        real(wp), intent(out) :: value(2), x(2)
        !> A pressure out of range
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: distance(2)
        integer :: piece(2), i

        call pressure_extremes(assembled, solution, value, piece, distance)
        value = scale(value, quantity_unit(assembled%units, of_pressure))
        do i = 1, 2
            x(i) = point_x(assembled, piece(i) - 1) + scale(distance(i), assembled%units%length)
            if (abs(value(i)) <= huge(value) .or. allocated(error)) cycle
            call refuse_pressure(x(i), error)
        end do
    end subroutine extremes_of_pressure

    !> A pressure is too great for the user's units
    pure subroutine refuse_pressure(x, error)
        real(wp), intent(in) :: x
        type(error_type), allocatable, intent(out) :: error

        call refuse_range(error, "the "//trim(quantity_names(of_pressure))//" at x = "//trim(shown(x))//" is too great", &
                          trim(quantity_remedies(of_pressure)))
    end subroutine refuse_pressure

end module gapbeam_pressure
