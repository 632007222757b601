!> Histories of the load, for Fortran: the path through limit points to load factors in turn, of beams whose supports may soften,
!> break, or keep a set; what gapbeam_api says of all procedures holds here too
module gapbeam_api_history
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_path_segments
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, fatal_error, failed, no_memory, gapbeam_not_converged, gapbeam_not_prepared
    use gapbeam_words, only: shown, whole
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_along_axis, only: name_range
    use gapbeam_history_record, only: runs_of, gapbeam_limit_stop => at_limit_stop, gapbeam_limit_jump => at_limit_jump, &
        gapbeam_limit_follow => at_limit_follow, gapbeam_limit_point => limit_point, gapbeam_bifurcation => bifurcation, &
        gapbeam_mechanism => mechanism, gapbeam_path_ended => ended, gapbeam_arrived => no_limit, cut_off
    use gapbeam_smooth_path, only: follow_on_laws
    use gapbeam_path_states, only: solve_state_on_path => solve_on_path, is_exact
    use gapbeam_history_events, only: find_events
    use gapbeam_released_energy, only: find_released_energy
    use gapbeam_query, only: node_places
    use gapbeam_api_objects, only: prepared_type, result_type, history_type, stretch_type, limit_type, require_beam, &
        bad_argument, make_state, summarise
    implicit none
    private
    public :: history_type, stretch_type, limit_type, follow_history, solve_on_path, get_released_energy
    public :: gapbeam_limit_stop, gapbeam_limit_jump, gapbeam_limit_follow
    public :: gapbeam_arrived, gapbeam_limit_point, gapbeam_bifurcation, gapbeam_mechanism, gapbeam_path_ended

contains

    !> Put on the dead loads, settlements and lacks of fit together, then go through load factors in turn, by the exact path.
    !> Foundations may hold both ways by k alone, and N may not grow
    subroutine follow_history(beam, factors, at_limit, history, error)
        !> Prepared
        type(prepared_type), intent(in) :: beam
        !> Load factors to go to, from factor 0; one at least
        real(wp), intent(in) :: factors(:)
        !> Where the load cannot go on: gapbeam_limit_stop: end there; gapbeam_limit_jump: go on from the landing;
        !> gapbeam_limit_follow: follow the path, also with falling load
        integer, intent(in) :: at_limit
        !> The loading history; that it does not come to the last factor is no error
        type(history_type), intent(out) :: history
        !> gapbeam_bad_input; gapbeam_not_converged where the path has too many stretches, too many supports change at once, or
        !> equal smooth laws soften together and how the path goes on from there is not known;
        !> gapbeam_not_finite, gapbeam_no_memory, gapbeam_not_prepared
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        integer :: stat

        call hold_environment(environment)
        call require_beam(beam, error)
        if (.not. allocated(error)) call check_call(factors, at_limit, error)
        if (allocated(error)) return
        allocate (history%path, stat=stat)
        if (failed(stat, error)) return
        call follow_on_laws(beam%lowered, factors, at_limit, most_path_segments, history%path, error)
        call name_range(beam%lowered, error)
        if (allocated(error)) return
        if (history%path%ending == cut_off) then
            call fatal_error(error, gapbeam_not_converged, "the path has more than "//trim(whole(history%path%number))// &
                             " stretches: shorten the history, or follow it in parts")
        else
            call describe(beam%lowered, factors, history, stat)
            if (stat /= 0) call no_memory(error)
        end if
    end subroutine follow_history

    !> The state at a load factor on a path, for the procedures of gapbeam_api
    subroutine solve_on_path(beam, history, factor, result, error, stretch)
        !> Prepared, and its history
        type(prepared_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        !> Load factor, on the stretch
        real(wp), intent(in) :: factor
        !> The state there
        type(result_type), intent(inout) :: result
        !> gapbeam_bad_input where the path, or the stretch, does not pass the factor, or the beam turns on the stretch or is not
        !> loaded yet; gapbeam_not_converged where it is known on the polylines of smooth laws only; gapbeam_not_prepared; or as
        !> for solve_beam
        type(error_type), allocatable, intent(out) :: error
        !> Number of the stretch; default, or 0: the last one with the factor that is not skipped, a stable one if there is any
        integer, intent(in), optional :: stretch
        type(environment_type) :: environment
        integer, allocatable :: runs(:, :)
        logical :: exact
        integer :: k

        call hold_environment(environment)
        result%status = -1
        k = 0
        if (present(stretch)) k = stretch
        call require_beam(beam, error)
        if (.not. allocated(error)) call require_history(beam, history, error)
        if (.not. allocated(error)) call find_stretch(history%stretches, factor, k, error)
        if (.not. allocated(error)) call make_state(beam, result, error)
        if (.not. allocated(error)) then
            allocate (runs, source=runs_of(history%path))
            call solve_state_on_path(beam%lowered, history%path, runs(2, k), factor, result%state, error, exact)
            if (.not. (allocated(error) .or. exact)) then
                call fatal_error(error, gapbeam_not_converged, "the state at load factor "//trim(shown(factor))//" is known on "// &
                                 "the polylines of the smooth laws only: ask for another one, or give the laws by points")
            end if
        end if
        if (.not. allocated(error)) call summarise(result)
    end subroutine solve_on_path

    !> Energy that is set free where the load cannot go on and the beam falls to its landing: force times length
    subroutine get_released_energy(beam, history, limit, energy, error)
        !> Prepared, and its history
        type(prepared_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        !> Number of the limit, from 1
        integer, intent(in) :: limit
        !> 0 in case of an error
        real(wp), intent(out) :: energy
        !> gapbeam_bad_input where there is no such limit, it has no landing, or it is met while the dead loads are put on;
        !> gapbeam_not_prepared; or as for solve_beam
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call hold_environment(environment)
        energy = 0.0_wp
        call require_beam(beam, error)
        if (.not. allocated(error)) call require_history(beam, history, error)
        if (.not. allocated(error)) then
            if (size(history%limits) == 0) then
                call bad_argument(error, "limit", "limit: the history has none, got "//trim(whole(limit)))
            else if (limit < 1 .or. limit > size(history%limits)) then
                call bad_argument(error, "limit", "limit: expected 1 to "//trim(whole(size(history%limits)))//", got "// &
                                 trim(whole(limit)))
            else if (history%limits(limit)%landing == 0 .or. history%limits(limit)%leg == 0) then
                call bad_argument(error, "limit", "limit "//trim(whole(limit))//" has no landing, or is met while the dead "// &
                                 "loads are put on: no energy is known there")
            end if
        end if
        if (.not. allocated(error)) call find_released_energy(beam%lowered, history%path, limit, energy, error)
    end subroutine get_released_energy

    !> Refuse factors and limits that make no sense
    subroutine check_call(factors, at_limit, error)
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: at_limit
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        if (size(factors) == 0) then
            call bad_argument(error, "factors", "factors: give at least one")
        else if (at_limit < gapbeam_limit_stop .or. at_limit > gapbeam_limit_follow) then
            call bad_argument(error, "at_limit", "at_limit: expected 0 (stop), 1 (jump) or 2 (follow), got "// &
                             trim(whole(at_limit)))
        end if
        do i = 1, size(factors)
            if (abs(factors(i)) <= huge(factors) .or. allocated(error)) cycle
            call bad_argument(error, "factors", "factors: expected finite numbers, got "//trim(shown(factors(i))))
        end do
    end subroutine check_call

    !> Refuse a history of another beam
    subroutine require_history(beam, history, error)
        type(prepared_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(history%path) .or. .not. allocated(history%stretches)) then
            call fatal_error(error, gapbeam_not_prepared, "nothing is followed: call follow_history first")
        else if (history%fingerprint /= beam%lowered%fingerprint) then
            call fatal_error(error, gapbeam_not_prepared, "the history belongs to another beam, or to other loads")
        end if
    end subroutine require_history

    !> The stretch that a load factor belongs to
    subroutine find_stretch(stretches, factor, number, error)
        type(stretch_type), intent(in) :: stretches(:)
        real(wp), intent(in) :: factor
        !> Its number; 0 in: the best one
        integer, intent(inout) :: number
        type(error_type), allocatable, intent(out) :: error
        integer :: k
        logical :: there

        if (number < 0 .or. number > size(stretches)) then
            call bad_argument(error, "stretch", "stretch: expected 0 to "//trim(whole(size(stretches)))//", got "// &
                             trim(whole(number)))
            return
        end if
        if (number > 0) then
            there = has(stretches(number))
        else
            do k = 1, size(stretches)
                if (stretches(k)%skipped .or. .not. has(stretches(k))) cycle
                if (number > 0) then
                    if (stretches(number)%stable .and. .not. stretches(k)%stable) cycle
                end if
                number = k
            end do
            there = number > 0
        end if
        if (there) return
        if (number > 0) then
            call bad_argument(error, "factor", "there is no state at load factor "//trim(shown(factor))// &
                             " on stretch "//trim(whole(number)))
        else
            call bad_argument(error, "factor", "the path does not come to load factor "//trim(shown(factor)))
        end if

    contains

        !> Has a stretch a state of its own at the factor
        pure function has(stretch)
            type(stretch_type), intent(in) :: stretch
            logical :: has

            has = stretch%leg > 0 .and. stretch%direction /= 0 .and. factor >= min(stretch%from, stretch%to) &
                .and. factor <= max(stretch%from, stretch%to)
        end function has

    end subroutine find_stretch

    !> What users look at
    subroutine describe(lowered, factors, history, stat)
        type(assembled_type), intent(in) :: lowered
        real(wp), intent(in) :: factors(:)
        !> The path in, the rest out
        type(history_type), intent(inout) :: history
        !> Not 0 where memory is at an end
        integer, intent(out) :: stat
        integer, allocatable :: runs(:, :)
        integer :: k, way, nodes
        logical :: exact

        associate (path => history%path)
            history%ending = path%ending
            history%solves = path%solves
            history%fingerprint = lowered%fingerprint
            allocate (runs, source=runs_of(path))
            allocate (history%stretches(size(runs, 2)), history%limits(size(path%limits)), stat=stat)
            if (stat /= 0) return
            do k = 1, size(runs, 2)
                associate (first => path%stretches(runs(1, k)), s => path%stretches(runs(2, k)))
                    way = 1
                    if (s%leg == 1) way = merge(1, -1, factors(1) > 0.0_wp)
                    if (s%leg > 1) way = merge(1, -1, factors(s%leg) > factors(s%leg - 1))
                    history%stretches(k) = stretch_type(s%leg, first%from, s%to, s%direction, &
                                                        s%index == 0 .and. s%direction == way, s%index, first%ways, s%skipped, &
                                                        is_exact(path, runs(2, k)))
                end associate
            end do
            do k = 1, size(path%limits)
                associate (limit => path%limits(k))
                    exact = limit%stretch == 0
                    if (.not. exact) exact = is_exact(path, limit%stretch)
                    history%limits(k) = limit_type(limit%factor, limit%kind, limit%leg, run_with(limit%stretch), &
                                                   run_with(limit%landing), exact)
                end associate
            end do
            if (allocated(path%motion)) then
                nodes = size(lowered%node_point)
                allocate (history%x(nodes), history%motion(nodes), stat=stat)
                if (stat /= 0) return
                call node_places(lowered, history%x)
                history%motion(:) = path%motion
            end if
            call find_events(lowered, path, history%events)
            do k = 1, size(history%events)
                history%events(k)%stretch = run_with(history%events(k)%stretch)
            end do
        end associate

    contains

        !> In which run a stretch of the path is; 0 for none
        pure function run_with(stretch)
            integer, intent(in) :: stretch
            integer :: run_with

            run_with = findloc(runs(1, :) <= stretch .and. runs(2, :) >= stretch, .true., 1)
        end function run_with

    end subroutine describe

end module gapbeam_api_history
