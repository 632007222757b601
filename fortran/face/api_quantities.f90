!> Quantities along a solved beam by their numbers, for Fortran; as gapbeam_api in all else.
!>
!>     call get_quantities(beam, result, [gapbeam_of_moment, gapbeam_of_curvature], [3d0], values, error)
!>
!> Numbers stay from version to version, and new quantities get new ones, so that no call has to change
module gapbeam_api_quantities
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_words, only: whole
    use gapbeam_quantities, only: quantity_count, gapbeam_of_deflection => of_deflection, gapbeam_of_rotation => of_rotation, &
        gapbeam_of_moment => of_moment, gapbeam_of_shear => of_shear, gapbeam_of_axial_force => of_axial_force, &
        gapbeam_of_axial_displacement => of_axial_displacement, gapbeam_of_pressure => of_pressure, &
        gapbeam_of_curvature => of_curvature, gapbeam_of_transverse => of_transverse
    use gapbeam_query, only: fields_at_places, extremes_of_fields
    use gapbeam_api_objects, only: prepared_type, result_type, require_result, require_size, bad_argument
    implicit none
    private
    public :: gapbeam_of_deflection, gapbeam_of_rotation, gapbeam_of_moment, gapbeam_of_shear, gapbeam_of_axial_force, &
        gapbeam_of_axial_displacement, gapbeam_of_pressure, gapbeam_of_curvature, gapbeam_of_transverse
    public :: get_quantities, get_quantity_extremes, require_quantities

contains

    !> Exact values anywhere along the beam
    subroutine get_quantities(beam, result, quantities, x, values, error, from_left)
        !> Prepared; its solved result, which keeps what the first call has to work out
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: result
        !> Which: gapbeam_of_deflection (down), gapbeam_of_rotation (clockwise), gapbeam_of_moment (sagging), gapbeam_of_shear,
        !> gapbeam_of_axial_force (tension), gapbeam_of_axial_displacement (to the right), gapbeam_of_pressure (of the ground, up),
        !> gapbeam_of_curvature (sagging: M/EI less what is imposed), gapbeam_of_transverse (shear and axial force times slope),
        !> shape (m)
        integer, intent(in) :: quantities(:)
        !> Places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Shape (m, n); 0 of what the beam does not have
        real(wp), intent(inout) :: values(:, :)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory, or gapbeam_bad_input for a place off the beam, a number that
        !> is none of a quantity, or arrays of another size
        type(error_type), allocatable, intent(out) :: error
        !> Where a quantity jumps: its value left of the place; default right of it
        logical, intent(in), optional :: from_left
        type(environment_type) :: environment
        logical :: left

        call require_result(beam, result, gapbeam_solved, error)
        if (.not. allocated(error)) call require_quantities(quantities, quantity_count, error)
        call require_size(size(quantities), [size(values, 1)], error)
        call require_size(size(x), [size(values, 2)], error)
        if (allocated(error)) return
        left = .false.
        if (present(from_left)) left = from_left
        call hold_environment(environment)
        call fields_at_places(beam%lowered, result%state, quantities, x, left, values, error)
    end subroutine get_quantities

    !> Exact extremes along the beam
    subroutine get_quantity_extremes(beam, result, quantities, value, x, error)
        !> As for get_quantities
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: result
        integer, intent(in) :: quantities(:)
        !> Maximum (1) and minimum (2), and where they are, shape (2, m)
        real(wp), intent(out) :: value(:, :), x(:, :)
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        if (.not. allocated(error)) call require_quantities(quantities, quantity_count, error)
        call require_size(2, [size(value, 1), size(x, 1)], error)
        call require_size(size(quantities), [size(value, 2), size(x, 2)], error)
        if (allocated(error)) return
        call hold_environment(environment)
        call extremes_of_fields(beam%lowered, result%state, quantities, value, x, error)
    end subroutine get_quantity_extremes

    !> Refuse numbers that are none of a quantity
    subroutine require_quantities(quantities, last, error)
        !> The numbers, from 1 to last
        integer, intent(in) :: quantities(:), last
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        do k = 1, size(quantities)
            if (quantities(k) >= 1 .and. quantities(k) <= last) cycle
            call bad_argument(error, "quantities", "quantities("//trim(whole(k))//"): expected a number from 1 to "// &
                              trim(whole(last))//", got "//trim(whole(quantities(k))))
            error%entry = k
            return
        end do
    end subroutine require_quantities

end module gapbeam_api_quantities
