!> Axial forces that bending feels, for Fortran: how a beam buckles and vibrates; as gapbeam_api in all else.
!>
!>     call get_modes(beam, result, gapbeam_buckling, factors, found, error)
!>
!> Modes are those of the supports and the ground that act in a solved state
module gapbeam_api_modes
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_buckles
    use gapbeam_words, only: shown, whole
    use gapbeam_state_modes, only: gapbeam_buckling => by_axial_force, gapbeam_vibration => by_vibration, shape_type, &
        values_of_modes, shape_of_mode, shape_of_buckling
    use gapbeam_api_objects, only: prepared_type, result_type, require_result, bad_argument
    implicit none
    private
    public :: gapbeam_buckling, gapbeam_vibration, get_modes, get_mode_shape, get_mode_amplitude, get_buckling

contains

    !> The first values of modes, in rising order
    subroutine get_modes(beam, result, kind, values, found, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> gapbeam_buckling: factors of all axial forces at which it buckles; gapbeam_vibration: circular frequencies (rad per unit
        !> of time)
        integer, intent(in) :: kind
        !> As many as are wanted, 0 beyond those that there are; how many there are of them
        real(wp), intent(out) :: values(:)
        integer, intent(out) :: found
        !> gapbeam_not_prepared, or gapbeam_bad_input for another kind and for beams whose modes are not available
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        values(:) = 0.0_wp
        found = 0
        call require_result(beam, result, gapbeam_solved, error)
        if (.not. allocated(error)) call require_kind(kind, error)
        if (allocated(error)) return
        call hold_environment(environment)
        call values_of_modes(beam%lowered, result%state, kind, values, found, error)
    end subroutine get_modes

    !> How the beam moves in a mode
    subroutine get_mode_shape(beam, result, kind, value, parts, x, deflection, moment, error)
        !> As for get_modes
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        integer, intent(in) :: kind
        !> One of its values
        real(wp), intent(in) :: value
        !> Intervals between places on every stretch of the beam at least, 1 or more
        integer, intent(in) :: parts
        !> Places; deflections there, the largest 1; moments left and right of them with these, shape (2, ...)
        real(wp), allocatable, intent(out) :: x(:), deflection(:), moment(:, :)
        !> As for get_modes; gapbeam_bad_input also where there is no such mode; gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(shape_type) :: shape

        call find_shape(beam, result, kind, value, parts, shape, error)
        if (allocated(error)) return
        call move_alloc(shape%x, x)
        call move_alloc(shape%deflection, deflection)
        call move_alloc(shape%moment, moment)
    end subroutine get_mode_shape

    !> How far a mode may swing before a support closes or opens
    subroutine get_mode_amplitude(beam, result, kind, value, parts, amplitude, support, error)
        !> As for get_mode_shape
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        integer, intent(in) :: kind
        real(wp), intent(in) :: value
        integer, intent(in) :: parts
        !> How many times the deflections of get_mode_shape swing when a support closes or opens first, and which one; infinite and
        !> 0 where none does
        real(wp), intent(out) :: amplitude
        integer, intent(out) :: support
        !> As for get_mode_shape
        type(error_type), allocatable, intent(out) :: error
        type(shape_type) :: shape

        amplitude = 0.0_wp
        support = 0
        call find_shape(beam, result, kind, value, parts, shape, error)
        if (allocated(error)) return
        amplitude = shape%amplitude
        support = shape%support
    end subroutine get_mode_amplitude

    !> The shape of a mode, where there is one
    subroutine find_shape(beam, result, kind, value, parts, shape, error)
        !> As for get_mode_shape
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        integer, intent(in) :: kind
        real(wp), intent(in) :: value
        integer, intent(in) :: parts
        type(shape_type), intent(out) :: shape
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        if (.not. allocated(error)) call require_kind(kind, error)
        if (allocated(error)) return
        if (.not. (value > 0.0_wp .and. value <= huge(value))) then
            call bad_argument(error, "value", "value: expected a finite number above 0, got "//trim(shown(value)))
        else if (parts < 1) then
            call bad_argument(error, "parts", "parts: expected 1 or more, got "//trim(whole(parts)))
        end if
        if (allocated(error)) return
        call hold_environment(environment)
        call shape_of_mode(beam%lowered, result%state, kind, value, parts, shape, error)
    end subroutine find_shape

    !> How a beam gives way that does not bear its axial forces
    subroutine get_buckling(beam, result, share, x, deflection, error)
        !> Prepared; its result with status gapbeam_buckles
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> How much of its axial forces it bears, all other loads in full
        real(wp), intent(out) :: share
        !> Places; deflections there as it gives way, the largest 1
        real(wp), allocatable, intent(out) :: x(:), deflection(:)
        !> gapbeam_not_prepared or gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        share = 0.0_wp
        call require_result(beam, result, gapbeam_buckles, error)
        if (allocated(error)) return
        call hold_environment(environment)
        share = result%state%ground%axial_share
        call shape_of_buckling(beam%lowered, result%state, x, deflection, error)
    end subroutine get_buckling

    !> Refuse what is no kind of mode
    subroutine require_kind(kind, error)
        integer, intent(in) :: kind
        type(error_type), allocatable, intent(out) :: error

        if (kind == gapbeam_buckling .or. kind == gapbeam_vibration) return
        call bad_argument(error, "kind", "kind: expected "//trim(whole(gapbeam_buckling))//" (buckling) or "// &
                          trim(whole(gapbeam_vibration))//" (vibration), got "//trim(whole(kind)))
    end subroutine require_kind

end module gapbeam_api_modes
