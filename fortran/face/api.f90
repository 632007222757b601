!> The library's procedures, for Fortran; the C and Fortran 77 interfaces marshal to these and do nothing else.
!>
!> Every procedure works in IEEE's default rounding with all traps off, and leaves the floating-point environment of its
!> caller (rounding, traps, flags) as it found it. None prints, stops, or keeps data between calls. A prepared beam is only read
!> by all but prepare_model and replace_loads, so that many threads may share one; a result belongs to one thread at a time.
module gapbeam_api
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, failed, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_scene, only: model_type, load_type, gapbeam_movement, gapbeam_temperature
    use gapbeam_assembled_model, only: assembled_type, copy_model, copy_given
    use gapbeam_units, only: bound_outside, quantity_unit
    use gapbeam_assemble, only: assemble_model
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_check, only: check_loads
    use gapbeam_words, only: shown
    use gapbeam_certificate, only: found_type => certificate_type
    use gapbeam_state, only: certify_state
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_events, only: event_type, follow_events
    use gapbeam_support_values, only: support_values, friction_values, find_undecided
    use gapbeam_query, only: motion_of_nodes
    use gapbeam_quantities, only: bounded_count, bending
    use gapbeam_api_quantities, only: get_quantities, get_quantity_extremes
    use gapbeam_api_objects, only: prepared_type, options_type, result_type, certificate_type, require_beam, require_no_ground, &
        require_no_path, require_result, require_size, check_call, bad_argument, make_state, summarise
    implicit none
    private
    public :: prepared_type, options_type, result_type, certificate_type
    public :: prepare_model, replace_loads, count_supports, count_nodes
    public :: solve_beam, follow_load, get_supports, get_friction, get_fields, get_extremes, get_motion, get_certificate

    !> Fields of get_fields and get_extremes: the first so many quantities (gapbeam_quantities)
    integer, parameter :: field_count = 6

contains

    !> Make a model ready for solving
    subroutine prepare_model(model, beam, error)
        !> What is to be solved; copied
        type(model_type), intent(in) :: model
        !> Ready for solve_beam and follow_load
        type(prepared_type), intent(out) :: beam
        !> gapbeam_bad_input with the array and the entry, gapbeam_not_finite or gapbeam_no_memory; beam is then not prepared
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        integer :: stat

        call hold_environment(environment)
        allocate (beam%lowered, stat=stat)
        if (stat == 0) call copy_model(model, beam%lowered%model, stat)
        if (.not. failed(stat, error)) call assemble_model(beam%lowered, error)
        if (allocated(error) .and. allocated(beam%lowered)) deallocate (beam%lowered)
    end subroutine prepare_model

    !> Take other loads instead of those of the model; quick where only values differ and no place does. The number of nodes
    !> changes with the places of loads on overhangs, that of supports never does; a result of other loads is refused
    subroutine replace_loads(beam, loads, error)
        !> Prepared; left as it is if an error is found
        type(prepared_type), intent(inout) :: beam
        !> All loads from now on
        type(load_type), intent(in) :: loads(:)
        !> As for prepare_model
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        type(assembled_type), allocatable :: other
        integer :: stat

        call require_beam(beam, error)
        if (allocated(error)) return
        call hold_environment(environment)
        if (same_places(beam%lowered%model%loads, loads)) then
            call check_loads(loads, beam%lowered%model, beam%lowered%ends, error)
            if (.not. allocated(error)) call exchange_loads(beam%lowered, loads, error)
        else
            allocate (other, stat=stat)
            if (stat == 0) call copy_given(beam%lowered, other%model, stat)
            if (stat == 0) then
                deallocate (other%model%loads)
                allocate (other%model%loads(size(loads)), stat=stat)
            end if
            if (failed(stat, error)) return
            other%model%loads(:) = loads
            call assemble_model(other, error)
            if (allocated(error)) return
            other%beam%watch = beam%lowered%beam%watch
            call move_alloc(other, beam%lowered)
        end if
    end subroutine replace_loads

    !> Take other values of the loads; the old ones stay where numbers leave the range of double precision
    subroutine exchange_loads(lowered, loads, error)
        type(assembled_type), intent(inout) :: lowered
        type(load_type), intent(in) :: loads(:)
        type(error_type), allocatable, intent(out) :: error
        type(error_type), allocatable :: none
        type(load_type), allocatable :: before(:)
        integer :: stat

        allocate (before(size(loads)), source=lowered%model%loads, stat=stat)
        if (failed(stat, error)) return
        lowered%model%loads(:) = loads
        call assemble_loads(lowered, error)
        if (.not. allocated(error)) return
        lowered%model%loads(:) = before
        call assemble_loads(lowered, none)
    end subroutine exchange_loads

    !> Do two lists of loads differ in their values only, and none moves a support
    pure function same_places(a, b) result(same)
        type(load_type), intent(in) :: a(:), b(:)
        logical :: same
        integer :: i

        same = .false.
        if (size(a) /= size(b)) return
        do i = 1, size(a)
            if (a(i)%kind /= b(i)%kind .or. a(i)%node /= b(i)%node .or. a(i)%kind == gapbeam_movement) return
            ! Where none makes the beam longer there are no bars for it
            if (a(i)%kind == gapbeam_temperature .and. (abs(a(i)%value_to) > 0.0_wp .neqv. abs(b(i)%value_to) > 0.0_wp)) return
            if (.not. abs(a(i)%x - b(i)%x) <= 0.0_wp .or. .not. abs(a(i)%to - b(i)%to) <= 0.0_wp) return
        end do
        same = .true.
    end function same_places

    !> Number of supports of a prepared beam
    pure function count_supports(beam) result(number)
        type(prepared_type), intent(in) :: beam
        !> 0 if it is not prepared
        integer :: number

        number = 0
        if (allocated(beam%lowered)) number = size(beam%lowered%model%supports)
    end function count_supports

    !> Number of nodes of the system: beam ends, hinges, supports across the beam, on overhangs the places of loads; of a beam that
    !> is solved stretch by stretch (on foundations, under axial forces) all places at which anything changes; ask again after
    !> replace_loads
    pure function count_nodes(beam) result(number)
        type(prepared_type), intent(in) :: beam
        !> 0 if it is not prepared
        integer :: number

        number = 0
        if (allocated(beam%lowered)) number = size(beam%lowered%node_point)
    end function count_nodes

    !> Solve at one load factor. Where `result` holds an earlier result of this beam, the search starts from its scheme: that
    !> changes the number of solves, not the answer. Beams whose state depends on the loading history are refused: they have
    !> support laws that fall, keep a set, or may let go of the beam; follow_history and solve_on_path are for these
    subroutine solve_beam(beam, factor, options, result, error)
        !> Prepared
        type(prepared_type), intent(in) :: beam
        !> Factor of the live loads
        real(wp), intent(in) :: factor
        type(options_type), intent(in) :: options
        !> The new state; result%status says whether there is equilibrium, or the beam buckles (get_buckling)
        type(result_type), intent(inout) :: result
        !> gapbeam_bad_input, also of beams whose state depends on the loading history, gapbeam_indeterminate,
        !> gapbeam_not_converged, gapbeam_not_finite, gapbeam_no_memory, gapbeam_not_prepared or gapbeam_stopped; result%status
        !> is then -1
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call hold_environment(environment)
        result%status = -1
        call require_beam(beam, error)
        if (.not. allocated(error)) call require_no_path(beam, error)
        if (.not. allocated(error)) call check_call(factor, options, error)
        if (.not. allocated(error)) call make_state(beam, result, error)
        if (.not. allocated(error)) call solve_on_laws(beam%lowered, factor, options%rule, result%state, error)
        if (.not. allocated(error)) call summarise(result)
    end subroutine solve_beam

    !> Follow the load from factor 0 upwards: every change of the contact state at its exact load factor, on smooth laws too; not
    !> of beams that solve_beam refuses; follow_ground is for beams on foundations, with axial forces or mass
    subroutine follow_load(beam, factor, options, events, result, error)
        !> Prepared
        type(prepared_type), intent(in) :: beam
        !> Where the path ends, above 0
        real(wp), intent(in) :: factor
        type(options_type), intent(in) :: options
        !> The events in their order
        type(event_type), allocatable, intent(out) :: events(:)
        !> The state at `factor`; or, with status gapbeam_no_equilibrium, the motion that begins at result%factor
        type(result_type), intent(inout) :: result
        !> As for solve_beam; events are then not allocated
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        type(event_type), allocatable :: list(:)
        integer :: number, stat

        call hold_environment(environment)
        result%status = -1
        call require_beam(beam, error)
        if (.not. allocated(error)) call require_no_ground(beam, error)
        if (.not. allocated(error)) call require_no_path(beam, error)
        if (.not. allocated(error)) call check_call(factor, options, error)
        if (.not. allocated(error) .and. .not. factor > 0.0_wp) then
            call bad_argument(error, "factor", "factor: expected a number above 0, got "//trim(shown(factor)))
        end if
        if (.not. allocated(error)) call make_state(beam, result, error)
        if (.not. allocated(error)) call follow_events(beam%lowered, factor, options%rule, result%state, list, number, error)
        if (.not. allocated(error)) then
            allocate (events(number), stat=stat)
            if (failed(stat, error)) return
            events(:) = list(1:number)
            call summarise(result)
        end if
    end subroutine follow_load

    !> Values at the supports, in the order of the model; shapes (count_supports(beam))
    subroutine get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Force on the beam, up; of an axial support to the right
        real(wp), intent(out) :: reaction(:)
        !> Deflection of the beam there, down; at an axial support to the right
        real(wp), intent(out) :: deflection(:)
        !> Distance still to go until it acts; negative where the beam has gone past one without stiffness
        real(wp), intent(out) :: opening(:)
        !> Couple on the beam, clockwise
        real(wp), intent(out) :: couple(:)
        !> gapbeam_open, gapbeam_closed or gapbeam_bilateral; of a support with a law gapbeam_open, or gapbeam_branch plus the
        !> number of its piece, from 1
        integer, intent(out) :: condition(:)
        !> gapbeam_not_prepared, or gapbeam_bad_input for arrays of another size
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        call require_size(count_supports(beam), [size(reaction), size(deflection), size(opening), size(couple), &
                                                 size(condition)], error)
        if (allocated(error)) return
        call hold_environment(environment)
        call support_values(beam%lowered, result%state, reaction, deflection, opening, couple, condition)
    end subroutine get_supports

    !> What friction does at the supports, in the order of the model, in a state from solve_on_path; zeros where there is none;
    !> shapes (count_supports(beam))
    subroutine get_friction(beam, result, force, slip, slides, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Force on the beam, and how far it has gone over the support, both to the right
        real(wp), intent(out) :: force(:), slip(:)
        !> 1 where the beam slides to the right, -1 to the left, 0 where it sticks
        integer, intent(out) :: slides(:)
        !> As for get_supports
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_solved, error)
        call require_size(count_supports(beam), [size(force), size(slip), size(slides)], error)
        if (allocated(error)) return
        call hold_environment(environment)
        call friction_values(beam%lowered, result%state, force, slip, slides)
    end subroutine get_friction

    !> Exact fields anywhere along the beam
    subroutine get_fields(beam, result, x, fields, error, from_left)
        !> Prepared; its solved result, which keeps what the first call has to work out
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: result
        !> Places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Deflection (down), rotation (clockwise), moment (sagging), shear, axial force (tension), axial displacement (to the
        !> right), shape (6, n); get_quantities for others
        real(wp), intent(inout) :: fields(:, :)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory, or gapbeam_bad_input for a place off the beam
        type(error_type), allocatable, intent(out) :: error
        !> Where a field jumps: its value left of the place; default right of it
        logical, intent(in), optional :: from_left
        integer :: k

        call get_quantities(beam, result, [(k, k=1, field_count)], x, fields, error, from_left)
    end subroutine get_fields

    !> Exact extremes of all fields along the beam
    subroutine get_extremes(beam, result, value, x, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: result
        !> Maximum (1) and minimum (2) of the fields in the order of get_fields, and where they are, shape (2, 6)
        real(wp), intent(out) :: value(:, :), x(:, :)
        !> gapbeam_not_prepared, gapbeam_not_finite, gapbeam_no_memory, or gapbeam_bad_input for arrays of another size
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        call get_quantity_extremes(beam, result, [(k, k=1, field_count)], value, x, error)
    end subroutine get_extremes

    !> The free motion of a beam that has no equilibrium; shapes (count_nodes(beam))
    subroutine get_motion(beam, result, x, motion, error)
        !> Prepared; its result with status gapbeam_no_equilibrium
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Places of the nodes
        real(wp), intent(out) :: x(:)
        !> Their displacements down, largest 1, straight lines between; all 0 where the beam slides along its axis
        real(wp), intent(out) :: motion(:)
        !> gapbeam_not_prepared, or gapbeam_bad_input for arrays of another size
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call require_result(beam, result, gapbeam_no_equilibrium, error)
        call require_size(count_nodes(beam), [size(x), size(motion)], error)
        if (allocated(error)) return
        call hold_environment(environment)
        call motion_of_nodes(beam%lowered, result%state, x, motion)
    end subroutine get_motion

    !> How good a result is, and which supports its digits cannot decide
    subroutine get_certificate(beam, result, certificate, undecided, error)
        !> Prepared; its solved result
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        !> Residuals and bounds
        type(certificate_type), intent(out) :: certificate
        !> Supports whose reaction or opening is zero, so that they may be closed or open, shape (count_supports(beam))
        logical, intent(out) :: undecided(:)
        !> gapbeam_not_prepared, gapbeam_no_memory, or gapbeam_bad_input for an array of another size; gapbeam_indeterminate or
        !> gapbeam_not_converged where the state cannot be checked in quadruple precision
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        type(found_type) :: found

        call require_result(beam, result, gapbeam_solved, error)
        call require_size(count_supports(beam), [size(undecided)], error)
        if (allocated(error)) return
        call hold_environment(environment)
        call certify_state(beam%lowered, result%state, found, error)
        if (.not. allocated(error)) then
            call find_undecided(beam%lowered, result%state, undecided)
            associate (units => beam%lowered%units)
                certificate = certificate_type(found%equilibrium, found%compatibility, found%complementarity, found%known, &
                                               bound_outside(found%of_nodes, units%deflection), &
                                               bound_outside(found%reaction, units%force), &
                                               bound_outside([found%deflection, found%rotation, found%moment, found%shear], &
                                                             quantity_unit(units, bending(:bounded_count))))
            end associate
        end if
    end subroutine get_certificate

end module gapbeam_api
