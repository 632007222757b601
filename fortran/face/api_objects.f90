!> The objects that users of the Fortran interface hold: a prepared beam, its results, how good they are, loading histories, cases
!> and trains; and what its procedures refuse before anything is done with them
module gapbeam_api_objects
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, &
        gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_words, only: shown, whole
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_force, only: what_stretches, or_first_order
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_events, only: event_type
    use gapbeam_history, only: path_type => history_type, gapbeam_arrived => no_limit
    use gapbeam_cases, only: case_loads_type
    use gapbeam_many_cases, only: case_room_type
    use gapbeam_train, only: train_type, track_type
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_events, only: train_event_type
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: prepared_type, options_type, result_type, certificate_type
    public :: history_type, stretch_type, limit_type, cases_type, passing_type, train_gap_type
    public :: require_beam, require_no_ground, require_no_ground_along, require_no_path
    public :: require_result, require_size, check_call
    public :: bad_argument, make_state, summarise

    !> A prepared beam: opaque
    type :: prepared_type
        type(assembled_type), allocatable :: lowered
        !> On the ground: where the search for its states begins, if something is known of it
        type(ground_start_type), allocatable :: near
    end type prepared_type

    !> How a beam is solved
    type :: options_type
        !> How the contact state is found: gapbeam_rule_block changes many supports at once and always ends,
        !> gapbeam_rule_single is the paper's rule
        integer :: rule = rule_block
    end type options_type

    !> A solved state; what it says of supports, fields and extremes is asked for with the get_ procedures
    type :: result_type
        !> gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, or -1: nothing solved
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
        !> Solved: is the state known to be the only one; under compression it may be one of several, that which is reached as
        !> the axial forces grow
        logical :: unique = .true.
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

    !> A stretch of a path on which all supports stay on their piece
    type :: stretch_type
        !> Number of the load factor that is gone to, from 1; 0 while the dead loads are put on, with settlements and lacks of fit,
        !> their factor from 0 to 1
        integer :: leg
        !> Load factors at its ends
        real(wp) :: from, to
        !> Does the load rise (1), fall (-1), or does the beam turn at constant load until something holds it (0)
        integer :: direction
        !> Would the beam stay there under this load
        logical :: stable
        !> In how many independent ways the beam gives way by itself; ways on there were at its beginning
        integer :: index, ways
        !> Is it passed in a jump, or beyond the limit at which the load stops
        logical :: skipped
        !> Is its end on the smooth laws of the supports; not where it is known on their polylines only
        logical :: exact
    end type stretch_type

    !> Where the load cannot go on
    type :: limit_type
        !> Load factor
        real(wp) :: factor
        !> gapbeam_limit_point: the load must fall; gapbeam_bifurcation: several ways go on, none of them stable;
        !> gapbeam_mechanism: none does
        integer :: kind
        !> As in stretch_type; last stretch before it, 0 if none; stretch on which the beam lands: the next stable state on
        !> the path at this load factor, 0 if none; dynamics may lead elsewhere
        integer :: leg, stretch, landing
        !> As in stretch_type
        logical :: exact
    end type limit_type

    !> The loading history
    type :: history_type
        !> Its stretches in their order
        type(stretch_type), allocatable :: stretches(:)
        !> What happens to the supports, but while the dead loads are put on
        type(event_type), allocatable :: events(:)
        !> Where the load could not go on
        type(limit_type), allocatable :: limits(:)
        !> gapbeam_arrived at the last factor, gapbeam_mechanism, or gapbeam_path_ended: at a limit, or there is no further event,
        !> however far the path is followed
        integer :: ending = gapbeam_arrived
        !> Linear solves, in quadruple precision
        integer :: solves = 0
        !> Places of the nodes and how they move, down, largest 1, where the path ends in a free motion of rigid parts; else not
        !> allocated
        real(wp), allocatable :: x(:), motion(:)
        !> Opaque
        type(path_type), allocatable :: path
        integer :: fingerprint = 0
    end type history_type

    !> What solving many cases of a beam takes, kept from call to call: opaque. It belongs to one thread at a time
    type :: cases_type
        integer :: fingerprint = 0, nodes = 0, supports = 0
        !> Is each case another beam, assembled with its loads
        logical :: alone = .false.
        type(case_loads_type), allocatable :: loads
        type(case_room_type) :: room
        integer, allocatable :: start(:), closed(:, :), solves(:)
        real(wp), allocatable :: w(:, :), ml(:, :), mr(:, :), reaction(:, :), values(:, :, :)
    end type cases_type

    !> Positions that are not solved
    type :: train_gap_type
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> gapbeam_no_equilibrium, gapbeam_buckles, gapbeam_moves_freely where the beam can move without work of the loads,
        !> gapbeam_indeterminate or gapbeam_not_converged
        integer :: reason = gapbeam_no_equilibrium
    end type train_gap_type

    !> A train on its way over a beam
    type :: passing_type
        !> Changes of the contact state, in the order in which they happen
        type(train_event_type), allocatable :: events(:)
        !> In the order in which they are met
        type(train_gap_type), allocatable :: gaps(:)
        !> Linear solves
        integer :: solves = 0
        !> Opaque
        integer :: fingerprint = 0
        type(train_type) :: train
        type(track_type) :: track
        type(traversal_type) :: passage
        !> On the ground, or with smooth laws, instead of these two
        type(runs_type), allocatable :: runs
    end type passing_type

contains

    !> Refuse a beam that is not prepared
    subroutine require_beam(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(beam%lowered)) then
            call fatal_error(error, gapbeam_not_prepared, "the beam is not prepared: call prepare_model first")
        end if
    end subroutine require_beam

    !> Refuse a beam on ground along its axis, where states are not solved for one by one
    subroutine require_no_ground_along(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(beam%lowered%axial%limit)) return
        call fatal_error(error, gapbeam_bad_input, "ground along the beam beside trains is not available in "// &
                         "this version: leave one of both out")
    end subroutine require_no_ground_along

    !> Refuse a beam whose state depends on the loading history
    subroutine require_no_path(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. beam%lowered%depends_on_path) return
        call fatal_error(error, gapbeam_bad_input, "the state of this beam depends on the loading history, since the law "// &
                         "of a support falls, keeps a set, or may let go of the beam, or a load moves a support: use "// &
                         "follow_history and solve_on_path")
    end subroutine require_no_path

    !> Refuse a beam that is solved in stretches, whose way is followed apart
    subroutine require_no_ground(beam, error)
        type(prepared_type), intent(in) :: beam
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(beam%lowered%layers)) return
        call fatal_error(error, gapbeam_bad_input, "the beam has "//trim(what_stretches(beam%lowered%model))// &
                         ": use follow_ground"//trim(or_first_order(beam%lowered%model)))
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
        else if (result%status /= status .and. status == gapbeam_buckles) then
            call fatal_error(error, gapbeam_not_prepared, "there is no buckling: the beam was found to bear its axial forces")
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
            .and. size(state%moment_left) == size(beam%lowered%node_point) .and. size(state%tension) == bars
    end function fits

    !> Refuse arrays of another size than expected
    subroutine require_size(expected, found, error)
        integer, intent(in) :: expected, found(:)
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error) .or. all(found == expected)) return
        call fatal_error(error, gapbeam_bad_input, "an array has "//trim(whole(found(findloc(found /= expected, .true., 1))))// &
                         " entries, expected "//trim(whole(expected)))
    end subroutine require_size

    !> Refuse a factor or a rule that makes no sense
    subroutine check_call(factor, options, error)
        real(wp), intent(in) :: factor
        type(options_type), intent(in) :: options
        type(error_type), allocatable, intent(out) :: error

        if (.not. abs(factor) <= huge(factor)) then
            call bad_argument(error, "factor", "factor: expected a finite number, got "//trim(shown(factor)))
        else if (options%rule /= rule_block .and. options%rule /= rule_single) then
            call bad_argument(error, "rule", "rule: expected 0 (block) or 1 (single), got "//trim(whole(options%rule)))
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
        if (.not. failed(stat, error)) call new_state(beam%lowered, result%state, error)
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
            result%unique = .true.
            if (allocated(state%ground)) result%unique = state%ground%unique
        end associate
    end subroutine summarise

end module gapbeam_api_objects
