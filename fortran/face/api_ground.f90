!> Beams on foundations, for Fortran: where the ground acts, where the beam hangs free above it, its pressure, and its load path;
!> the path also of beams without foundations, with an axial force that bending feels.
!> As in gapbeam_api nothing is printed or kept, and the floating-point environment is that of the caller. Without foundations
!> there is no contact and no free span, and the pressure is 0
module gapbeam_api_ground
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_solved, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_query, only: find_pieces
    use gapbeam_ground_zones, only: contact_type, free_span_type, find_contact, find_free_spans
    use gapbeam_pressure, only: pressure_in_pieces, extremes_of_pressure
    use gapbeam_ground_events, only: ground_event_type, ground_path_type
    use gapbeam_ground_path, only: follow_on_ground
    use gapbeam_api_objects, only: prepared_type, result_type, options_type, require_result, require_size, require_beam, &
        require_no_path, check_call, bad_argument, make_state, summarise
    use gapbeam_solution, only: close_all
    implicit none
    private
    public :: contact_type, free_span_type, ground_event_type
    public :: follow_ground, get_contact, get_free_spans, get_pressure, get_pressure_extremes

contains

    !> Follow the load of a beam on foundations, or with an axial force N that bending feels, from factor 0 upwards: every change
    !> of zones of contact and of supports at its load factor, to the last digit. N stays what it is. Changes that undo each other
    !> within 1/64 of the way are not seen
    subroutine follow_ground(beam, factor, options, events, result, error)
        !> Prepared, with foundations, axial forces or mass of spans
        type(prepared_type), intent(in) :: beam
        !> Where the path ends, above 0
        real(wp), intent(in) :: factor
        type(options_type), intent(in) :: options
        !> The events in their order
        type(ground_event_type), allocatable, intent(out) :: events(:)
        !> The state at `factor`; or, with status gapbeam_no_equilibrium or gapbeam_buckles, the motion that begins at
        !> result%factor
        type(result_type), intent(inout) :: result
        !> As for solve_beam; gapbeam_bad_input also of beams that follow_load is for; events are then not allocated
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        type(ground_path_type) :: path
        integer :: stat

        call hold_environment(environment)
        result%status = -1
        call require_beam(beam, error)
        if (.not. allocated(error)) call require_no_path(beam, error)
        if (.not. allocated(error)) call check_call(factor, options, error)
        if (.not. allocated(error)) call check_way()
        if (.not. allocated(error)) call make_state(beam, result, error)
        if (.not. allocated(error)) then
            call close_all(beam%lowered, result%state%closed)
            call follow_on_ground(beam%lowered, factor, options%rule, result%state, path, error)
        end if
        if (.not. allocated(error)) then
            allocate (events(path%number), stat=stat)
            if (failed(stat, error)) return
            events(:) = path%events(:path%number)
            if (result%state%status /= gapbeam_solved) result%state%factor = path%last
            result%state%solves = path%solves
            call summarise(result)
        end if

    contains

        !> Is it solved in stretches, and is there a way to go
        subroutine check_way()
            if (.not. allocated(beam%lowered%layers)) then
                call fatal_error(error, gapbeam_bad_input, "the beam has no foundation, no axial force N and no "// &
                                 "mass: use follow_load")
            else if (beam%lowered%model%stretching) then
                call fatal_error(error, gapbeam_bad_input, "events of a beam that its deflections stretch are not available in "// &
                                 "this version; use solve_beam at several factors")
            else if (.not. factor > 0.0_wp) then
                call bad_argument(error, "factor", "factor: expected a number above 0, got "//trim(shown(factor)))
            end if
        end subroutine check_way

    end subroutine follow_ground

    !> Zones in which the ground acts
    subroutine get_contact(beam, result, zones, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Foundation by foundation from left to right; one that holds both ways by a law first where it pushes up
        type(contact_type), allocatable, intent(out) :: zones(:)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        if (allocated(error)) return
        call hold_environment(environment)
        if (allocated(result%state%ground)) then
            call find_contact(beam%lowered, result%state%ground, zones, error)
        else
            allocate (zones(0))
        end if
    end subroutine get_contact

    !> Stretches in which the beam does not touch a one-sided foundation that is there
    subroutine get_free_spans(beam, result, spans, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Foundation by foundation from left to right; of one that holds both ways there are none
        type(free_span_type), allocatable, intent(out) :: spans(:)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        if (allocated(error)) return
        call hold_environment(environment)
        if (allocated(result%state%ground)) then
            call find_free_spans(beam%lowered, result%state%ground, spans, error)
        else
            allocate (spans(0))
        end if
    end subroutine get_free_spans

    !> Pressure of the ground anywhere along the beam
    subroutine get_pressure(beam, result, x, pressure, error, from_left)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Force per length of all ground on the beam, up, shape (n); written only where there is no error
        real(wp), intent(inout) :: pressure(:)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory, or gapbeam_bad_input for a place off the beam
        type(error_type), allocatable, intent(out) :: error
        !> At an end of a foundation: its value left of the place; default right of it
        logical, intent(in), optional :: from_left
        type(environment_type) :: environment
        integer, allocatable :: piece(:)
        real(wp), allocatable :: distance(:)
        logical :: left

        call require_result(beam, result, gapbeam_solved, error)
        call require_size(size(x), [size(pressure)], error)
        if (allocated(error)) return
        left = .false.
        if (present(from_left)) left = from_left
        call hold_environment(environment)
        call find_pieces(beam%lowered, x, left, piece, distance, error)
        if (.not. allocated(error)) then
            if (allocated(result%state%ground)) then
                call pressure_in_pieces(beam%lowered, result%state%ground, piece, distance, pressure, error)
            else
                pressure(:) = 0.0_wp
            end if
        end if
    end subroutine get_pressure

    !> Exact extremes of the pressure of the ground
    subroutine get_pressure_extremes(beam, result, value, x, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Maximum (1) and minimum (2) of the force per length of all ground on the beam, up, and where they are
        real(wp), intent(out) :: value(2), x(2)
        !> gapbeam_not_prepared, gapbeam_not_finite
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        value = 0.0_wp
        x = 0.0_wp
        call require_result(beam, result, gapbeam_solved, error)
        if (allocated(error)) return
        if (.not. allocated(result%state%ground)) return
        call hold_environment(environment)
        call extremes_of_pressure(beam%lowered, result%state%ground, value, x, error)
    end subroutine get_pressure_extremes

end module gapbeam_api_ground
