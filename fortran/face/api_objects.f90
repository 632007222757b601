!> The objects that users of the Fortran interface hold: a prepared beam, its results, how good they are; and what its procedures
!> refuse before anything is done with them
module gapbeam_api_objects
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_words, only: shown
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_input_error, only: of_supports
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: smooth_supports
    use gapbeam_solution, only: state_type, new_state
    implicit none
    private
    public :: prepared_type, options_type, result_type, certificate_type
    public :: require_beam, require_no_ground, require_no_path, require_no_curves, require_result, require_size, check_call
    public :: bad_argument, make_state, summarise

    !> A prepared beam: opaque
    type :: prepared_type
        type(assembled_type), allocatable :: lowered
    end type prepared_type

    !> How a beam is solved
    type :: options_type
        !> How the contact state is found: gapbeam_rule_block changes many supports at once and always ends,
        !> gapbeam_rule_single is the paper's rule
        integer :: rule = rule_block
    end type options_type

    !> A solved state; what it says of supports, fields and extremes is asked for with the get_ procedures
    type :: result_type
        !> gapbeam_solved, gapbeam_no_equilibrium, or -1: nothing solved
        integer :: status = -1
        !> Load factor of the live loads
        real(wp) :: factor = 0.0_wp
        !> Linear solves it took
        integer :: solves = 0
        !> What was solved: 0 the mixed system, 1 three-moment equations, 2 the mixed system with pivoting
        integer :: method = 0
        !> Can the beam move freely without work of the loads: its forces are unique, its position is not
        logical :: indifferent = .false.
        !> Without equilibrium: does the beam slide along its axis
        logical :: slides = .false.
        !> Opaque
        type(state_type), allocatable :: state
    end type result_type

    !> How good a result is
    type :: certificate_type
        !> Largest relative residuals of the equations of equilibrium and compatibility
        real(wp) :: equilibrium = 0.0_wp, compatibility = 0.0_wp
        !> Largest reaction or penetration of the wrong sign, relative to the largest reaction or deflection
        real(wp) :: complementarity = 0.0_wp
        !> Have deflections and rotations a bound; not where the beam is indifferent
        logical :: known = .false.
        !> Largest error that any deflection of a node, and any reaction, can have, in units of length and force
        real(wp) :: deflection_bound = 0.0_wp, reaction_bound = 0.0_wp
        !> Largest errors of deflection, rotation, moment and shear anywhere along the beam
        real(wp) :: field_bound(4) = 0.0_wp
    end type certificate_type

contains

    !> Refuse a beam that is not prepared
    subroutine require_beam(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(beam%lowered)) then
            call fatal_error(error, gapbeam_not_prepared, "the beam is not prepared: call prepare_model first")
        end if
    end subroutine require_beam

    !> Refuse a beam whose state depends on the loading history
    subroutine require_no_path(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. beam%lowered%depends_on_path) return
        if (allocated(beam%lowered%layers)) then
            call fatal_error(error, gapbeam_bad_input, "the law of a support falls, keeps a set, or may let go of the beam: "// &
                             "beside a foundation that is not available in this version; give laws that rise")
        else
            call fatal_error(error, gapbeam_bad_input, "the state of this beam depends on the loading history, since the law "// &
                             "of a support falls, keeps a set, or may let go of the beam: use follow_history and solve_on_path")
        end if
    end subroutine require_no_path

    !> Refuse a beam with smooth laws of supports where these are not available
    subroutine require_no_curves(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (size(smooth_supports(beam%lowered)) == 0) return
        call fatal_error(error, gapbeam_bad_input, "the law of a support is a curve: in this version such a beam is solved "// &
                         "with solve_beam and follow_load only; give the law by points")
        error%table = of_supports
    end subroutine require_no_curves

    !> Refuse a beam on a foundation, whose way is followed apart
    subroutine require_no_ground(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(beam%lowered%layers)) return
        call fatal_error(error, gapbeam_bad_input, "the beam is on a foundation: use follow_ground")
    end subroutine require_no_ground

    !> Refuse a result of another beam or of another status
    subroutine require_result(beam, result, status, error)
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        integer, intent(in) :: status
        type(error_type), allocatable, intent(out) :: error

        call require_beam(beam, error)
        if (allocated(error)) return
        if (.not. allocated(result%state) .or. (result%status /= status .and. status == gapbeam_solved)) then
            call fatal_error(error, gapbeam_not_prepared, "nothing is solved: call solve_beam first")
        else if (result%status /= status) then
            call fatal_error(error, gapbeam_not_prepared, "there is no motion: the beam was not found without equilibrium")
        else if (.not. fits(beam, result%state) .or. result%state%fingerprint /= beam%lowered%fingerprint) then
            call fatal_error(error, gapbeam_not_prepared, "the result belongs to another beam, or to other loads")
        end if
    end subroutine require_result

    !> Has a state the sizes of a beam
    pure function fits(beam, state) result(same)
        type(prepared_type), intent(in) :: beam
        type(state_type), intent(in) :: state
        logical :: same
        integer :: bars

        bars = 0
        if (allocated(beam%lowered%axial%flexibility)) bars = size(beam%lowered%axial%flexibility)
        same = size(state%closed) == size(beam%lowered%normal) .and. size(state%starts) == size(beam%lowered%pieces) &
            .and. size(state%deflection) == size(beam%lowered%node_point) .and. size(state%tension) == bars
    end function fits

    !> Refuse arrays of another size than expected
    subroutine require_size(expected, found, error)
        integer, intent(in) :: expected, found(:)
        type(error_type), allocatable, intent(out) :: error
        character(len=80) :: text

        if (all(found == expected)) return
        write (text, "(2(a, i0))") "an array has ", found(findloc(found /= expected, .true., 1)), " entries, expected ", expected
        call fatal_error(error, gapbeam_bad_input, trim(text))
    end subroutine require_size

    !> Refuse a factor or a rule that makes no sense
    subroutine check_call(factor, options, error)
        real(wp), intent(in) :: factor
        type(options_type), intent(in) :: options
        type(error_type), allocatable, intent(out) :: error
        character(len=20) :: text

        if (.not. abs(factor) <= huge(factor)) then
            call bad_argument(error, "factor", "factor: expected a finite number, got "//trim(shown(factor)))
        else if (options%rule /= rule_block .and. options%rule /= rule_single) then
            write (text, "(i0)") options%rule
            call bad_argument(error, "rule", "rule: expected 0 (block) or 1 (single), got "//trim(text))
        end if
    end subroutine check_call

    !> Refuse an argument, whose name stands in the key of the error
    pure subroutine bad_argument(error, name, message)
        type(error_type), allocatable, intent(out) :: error
        character(len=*), intent(in) :: name, message

        call fatal_error(error, gapbeam_bad_input, message)
        error%key = name
    end subroutine bad_argument

    !> A state for a result that has none that fits
    subroutine make_state(beam, result, error)
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: result
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        if (allocated(result%state)) then
            if (allocated(result%state%laws)) deallocate (result%state%laws)
            if (fits(beam, result%state)) return
            deallocate (result%state)
        end if
        allocate (result%state, stat=stat)
        if (stat == 0) then
            call new_state(beam%lowered, result%state, error)
        else
            call no_memory(error)
        end if
        if (allocated(error) .and. allocated(result%state)) deallocate (result%state)
    end subroutine make_state

    !> Copy what users look at first
    subroutine summarise(result)
        type(result_type), intent(inout) :: result

        associate (state => result%state)
            result%status = state%status
            result%factor = state%factor
            result%solves = state%solves
            result%method = state%method
            result%indifferent = state%indifferent
            result%slides = state%slides
        end associate
    end subroutine summarise

end module gapbeam_api_objects
