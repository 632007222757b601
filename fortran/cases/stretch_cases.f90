!> Cases of a beam that is solved stretch by stretch, on ground or with an axial force that bending feels; or on curves or a path.
!> Each is solved alone. Where the beam is linear in its loads as long as no support changes, cases in a scheme that comes again and
!> again are sums of responses.
module gapbeam_stretch_cases
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_schemes, most_scheme_changes, most_response_numbers
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite, gapbeam_stopped
    use gapbeam_units, only: moment_unit
    use gapbeam_law_margins, only: may_change
    use gapbeam_search, only: rule_block
    use gapbeam_assembled_model, only: assembled_type, push_unit
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_solution, only: state_type
    use gapbeam_combinations, only: combination_type, combine_case, solve_combination
    use gapbeam_single_cases, only: give_none
    use gapbeam_scheme_responses, only: response_type, is_linear_in_schemes, changes_axial_force, find_responses, add_up, agrees
    implicit none
    private
    public :: stretch_room_type, solve_stretch_cases

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: stretch_room_type
        !> Has it been looked whether cases are sums of responses, and are they
        logical :: is_made = .false., is_linear = .false.
        !> Which supports have more than one state, and which loads change the axial force
        logical, allocatable :: watched(:), axial(:)
        !> Factors of all loads in the first case: the responses are for those of the latter
        real(wp), allocatable :: axial_factors(:)
        !> Schemes that were found, so many of them, and that of the last case
        type(response_type), allocatable :: schemes(:)
        integer :: count = 0, last = 0
        !> The beam under the last case solved alone
        type(combination_type) :: combined
    end type stretch_room_type

contains

    !> Solve cases
    subroutine solve_stretch_cases(assembled, numbers, room, solutions)
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        !> Empty, or of earlier cases of this beam
        type(stretch_room_type), intent(inout) :: room
        !> Numbers of a case that is not solved are none, and its supports all open. Where memory ends the status of all says so
        type(case_solutions_type), intent(inout) :: solutions
        real(wp) :: values(3*size(assembled%node_point) + 2*size(assembled%beam%supports))
        logical :: adds_up, is_done, is_sure
        integer :: i, k

        adds_up = size(solutions%status) > 1 .and. numbers%rule == rule_block &
            .and. .not. (associated(numbers%supports) .or. associated(numbers%spans) .or. associated(numbers%moduli))
        if (adds_up) then
            call prepare(assembled, numbers%factors(:, 1), room)
            adds_up = room%is_linear
        end if
        do i = 1, size(solutions%status)
            if (is_stopped(assembled%beam%watch)) exit
            is_done = .false.
            if (adds_up) call try_schemes(numbers%factors(:, i), size(assembled%node_point), room, values, k, is_done)
            if (is_done) then
                solutions%solves(i) = 0
                call give(values, size(assembled%node_point), room%schemes(k)%closed, i, solutions)
                cycle
            end if
            call solve_alone(assembled, numbers, i, room%combined, solutions, values, is_sure)
            if (any(solutions%status(i) == [gapbeam_no_memory, gapbeam_stopped])) then
                solutions%status(:) = solutions%status(i)
                return
            end if
            if (adds_up .and. is_sure) then
                call note_scheme(assembled, numbers%factors(:, i), solutions%closed(:size(room%watched), i) /= 0, &
                                 values(:size(values) - size(room%watched)), room)
            end if
        end do
    end subroutine solve_stretch_cases

    !> Solve a case by itself
    subroutine solve_alone(assembled, numbers, i, combined, solutions, values, is_sure)
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        !> The case
        integer, intent(in) :: i
        !> Empty, or of earlier cases of this beam
        type(combination_type), intent(inout) :: combined
        !> As for solve_stretch_cases
        type(case_solutions_type), intent(inout) :: solutions
        !> Its numbers (response_type), but for margins
        real(wp), intent(out) :: values(:)
        !> Is it solved, with no support at zero, and held
        logical, intent(out) :: is_sure
        type(state_type) :: state
        type(error_type), allocatable :: error
        integer :: n, m, k, status

        n = size(assembled%node_point)
        m = size(assembled%beam%supports)
        is_sure = .false.
        solutions%solves(i) = 0
        call combine_case(assembled, numbers, i, combined, error)
        if (.not. allocated(error)) then
            call solve_combination(combined%assembled, numbers%rule, solutions%closed(:m, i) /= 0, state, error)
        end if
        if (allocated(error)) then
            status = error%code
        else
            solutions%solves(i) = state%solves
            status = state%status
        end if
        if (status == gapbeam_solved) then
            associate (now => combined%assembled)
                values(:n) = scale(state%deflection(0:n - 1), now%units%deflection)
                values(n + 1:2*n) = scale(state%moment_left, moment_unit(now%units))
                values(2*n + 1:3*n) = scale(state%moment_right, moment_unit(now%units))
                values(3*n + 1:3*n + m) = scale(state%reaction, [(push_unit(now, now%normal(k)), k=1, m)])
            end associate
            if (.not. all(abs(values(:3*n + m)) <= huge(1.0_wp))) status = gapbeam_not_finite
        end if
        if (status == gapbeam_solved) then
            call give(values, n, state%closed, i, solutions)
            is_sure = .not. (state%indifferent .or. any(state%undecided))
        else
            call give_none(status, i, solutions)
        end if
    end subroutine solve_alone

    !> Put the numbers of a case into its columns
    pure subroutine give(values, n, closed, i, solutions)
        !> Numbers (response_type), and how many nodes there are
        real(wp), intent(in) :: values(:)
        integer, intent(in) :: n
        logical, intent(in) :: closed(:)
        !> The case
        integer, intent(in) :: i
        type(case_solutions_type), intent(inout) :: solutions
        integer :: m

        m = size(closed)
        solutions%status(i) = gapbeam_solved
        solutions%closed(:, i) = 0
        solutions%closed(:m, i) = merge(1, 0, closed)
        if (associated(solutions%w)) solutions%w(:n, i) = values(:n)
        if (associated(solutions%ml)) solutions%ml(:n, i) = values(n + 1:2*n)
        if (associated(solutions%mr)) solutions%mr(:n, i) = values(2*n + 1:3*n)
        if (associated(solutions%reaction)) solutions%reaction(:m, i) = values(3*n + 1:3*n + m)
    end subroutine give

    !> Make room for the responses, or begin anew for other factors of the loads that change the axial force
    subroutine prepare(assembled, factors, room)
        type(assembled_type), intent(in) :: assembled
        !> Of the first case
        real(wp), intent(in) :: factors(:)
        type(stretch_room_type), intent(inout) :: room
        integer :: loads, stat

        loads = size(assembled%model%loads)
        if (.not. room%is_made) then
            room%is_made = .true.
            allocate (room%watched(size(assembled%beam%supports)), room%axial(loads), room%axial_factors(loads), &
                      room%schemes(most_schemes), stat=stat)
            if (stat /= 0) return
            room%watched(:) = may_change(assembled%beam%supports)
            room%axial(:) = changes_axial_force(assembled)
            room%axial_factors(:) = factors(:loads)
            room%is_linear = is_linear_in_schemes(assembled, factors(:loads))
        else if (allocated(room%axial_factors)) then
            if (is_for(room, factors)) return
            room%axial_factors(:) = factors(:loads)
            room%count = 0
            room%last = 0
            room%is_linear = is_linear_in_schemes(assembled, factors(:loads))
        end if
    end subroutine prepare

    !> Are the responses those for the axial force of a case
    pure function is_for(room, factors) result(they_are)
        type(stretch_room_type), intent(in) :: room
        !> Shape (at least nload)
        real(wp), intent(in) :: factors(:)
        logical :: they_are

        they_are = all(abs(factors(:size(room%axial)) - room%axial_factors) <= 0.0_wp .or. .not. room%axial)
    end function is_for

    !> Look for a case among the responses, from the scheme of the last one: every support that is wrong changes, as rule_block does
    pure subroutine try_schemes(factors, nodes, room, values, found, is_done)
        !> Shape (at least nload)
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: nodes
        type(stretch_room_type), intent(inout) :: room
        !> Its numbers (response_type), and its scheme
        real(wp), intent(out) :: values(:)
        integer, intent(out) :: found
        logical, intent(out) :: is_done
        logical :: wrong(size(room%watched)), is_sound
        integer :: change

        is_done = .false.
        if (.not. is_for(room, factors)) return
        found = room%last
        do change = 0, most_scheme_changes
            if (found == 0) return
            if (.not. allocated(room%schemes(found)%values) .or. room%schemes(found)%is_useless) return
            call add_up(room%schemes(found), factors(:size(room%axial)), room%watched, nodes, values, is_sound, wrong)
            if (.not. is_sound) return
            is_done = .not. any(wrong)
            if (is_done) exit
            found = number_of_scheme(room, room%schemes(found)%closed .neqv. wrong)
        end do
        if (is_done) room%last = found
    end subroutine try_schemes

    !> Number of a scheme, 0: not there
    pure function number_of_scheme(room, closed) result(number)
        type(stretch_room_type), intent(in) :: room
        logical, intent(in) :: closed(:)
        integer :: number

        do number = room%count, 1, -1
            if (all(room%schemes(number)%closed .eqv. closed)) exit
        end do
    end function number_of_scheme

    !> Count the scheme of a case solved alone. Its responses are found once that was done as often as they need solves, so that
    !> they never cost much more than they save
    subroutine note_scheme(assembled, factors, closed, alone, room)
        type(assembled_type), intent(in) :: assembled
        !> The case (at least nload), its scheme, and its numbers (response_type) but for margins
        real(wp), intent(in) :: factors(:)
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: alone(:)
        type(stretch_room_type), intent(inout) :: room
        real(wp) :: values(size(alone) + size(closed))
        logical :: wrong(size(closed)), is_sound
        integer :: number, loads, stat

        if (.not. is_for(room, factors)) return
        loads = size(room%axial)
        number = number_of_scheme(room, closed)
        if (number == 0) then
            if (room%count == most_schemes) return
            room%count = room%count + 1
            number = room%count
            room%schemes(number) = response_type()
            allocate (room%schemes(number)%closed(size(closed)), stat=stat)
            if (stat /= 0) then
                room%count = room%count - 1
                return
            end if
            room%schemes(number)%closed(:) = closed
        end if
        room%last = number
        associate (scheme => room%schemes(number))
            scheme%times = scheme%times + 1
            if (allocated(scheme%values) .or. scheme%is_useless .or. scheme%times <= loads) return
            if (size(values)*(loads + 1) > most_response_numbers/most_schemes) return
            call find_responses(assembled, factors(:loads), scheme)
            if (scheme%is_useless) return
            call add_up(scheme, factors(:loads), room%watched, size(assembled%node_point), values, is_sound, wrong)
            scheme%is_useless = any(wrong) .or. .not. agrees(values, alone, size(assembled%node_point))
        end associate
    end subroutine note_scheme

end module gapbeam_stretch_cases
