!> Many cases of one beam in one call, for Fortran; as gapbeam_api in all else
module gapbeam_api_cases
    use gapbeam_kinds, only: wp, not_a_number
    use gapbeam_limits, only: case_batch
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, fatal_error, failed, no_memory, gapbeam_solved, gapbeam_bad_input, gapbeam_no_memory, &
        gapbeam_not_prepared, gapbeam_stopped
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_words, only: shown, whole
    use gapbeam_input_error, only: named, of_supports, of_loads
    use gapbeam_scene, only: load_type, gapbeam_axial, gapbeam_both, gapbeam_movement
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_solution, only: close_all
    use gapbeam_pieces, only: acting_type, acts_in, gapbeam_open, gapbeam_bilateral
    use gapbeam_full_load, only: is_solved_alone
    use gapbeam_cases, only: split_loads
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_many_cases, only: solve_in_room => solve_cases
    use gapbeam_query, only: node_places
    use gapbeam_api_objects, only: prepared_type, options_type, cases_type, require_beam, require_size, check_call
    implicit none
    private
    public :: cases_type, prepare_cases, solve_cases, get_nodes

contains

    !> Make ready for many cases of a beam: what every load does alone is worked out once, where it adds up
    subroutine prepare_cases(beam, cases, error)
        !> Prepared. Where a state depends on the loading history, dead loads are put on first in every case, then the others
        type(prepared_type), intent(in) :: beam
        !> For solve_cases; it keeps nothing of the beam, and is of no use after replace_loads
        type(cases_type), intent(out) :: cases
        !> gapbeam_not_prepared, gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        integer :: n, m, stat

        call require_beam(beam, error)
        if (allocated(error)) return
        associate (lowered => beam%lowered)
            n = size(lowered%node_point)
            m = size(lowered%beam%supports)
            allocate (cases%start(m), cases%closed(m, case_batch), cases%solves(case_batch), cases%w(n, case_batch), &
                      cases%ml(n, case_batch), cases%mr(n, case_batch), cases%reaction(m, case_batch), &
                      cases%values(3, size(lowered%model%supports), case_batch), cases%loads, stat=stat)
            if (failed(stat, error)) return
            call hold_environment(environment)
            call split_loads(lowered, cases%loads, error)
            call start_closed(lowered, cases%start)
            if (allocated(error)) return
            cases%alone = is_solved_alone(lowered)
            cases%fingerprint = lowered%fingerprint
            cases%nodes = n
            cases%supports = m
        end associate
    end subroutine prepare_cases

    !> Solve many cases. In each all loads of the model act, dead or live, every one times a factor of its own; and supports may
    !> have other numbers than in the model. A case that has no solution is recorded in its status, and the others go on. The
    !> digits are those of each case alone, in Python too
    subroutine solve_cases(beam, cases, factors, status, error, settlement, gap, stiffness, options, reaction, condition, &
                           deflection, moment_left, moment_right, solves)
        !> Prepared; by prepare_cases from it
        type(prepared_type), intent(in) :: beam
        type(cases_type), intent(inout), target :: cases
        !> Factor of every load, shape (nload, ncase)
        real(wp), intent(in), contiguous, target :: factors(:, :)
        !> gapbeam_solved, gapbeam_no_equilibrium, or the code of the error that solve_beam would give, shape (ncase)
        integer, intent(out) :: status(:)
        !> gapbeam_bad_input: nothing is solved; also where supports vary that have laws.
        !> gapbeam_not_prepared, gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        !> Movement (down), gap and stiffness (above 0, infinite: rigid) of every support instead of those of the model, shape
        !> (nsupport, ncase). Loads that move supports add to it
        real(wp), intent(in), optional :: settlement(:, :), gap(:, :), stiffness(:, :)
        type(options_type), intent(in), optional :: options
        !> Force on the beam, up, shape (nsupport, ncase); of axial supports, and of cases that are not solved, not-a-number
        real(wp), intent(out), optional :: reaction(:, :)
        !> As from get_supports, shape (nsupport, ncase); of cases that are not solved gapbeam_open
        integer, intent(out), optional :: condition(:, :)
        !> Deflection, moment left and right of every node (get_nodes), shape (count_nodes(beam), ncase); of cases that are not
        !> solved not-a-number
        real(wp), intent(out), optional :: deflection(:, :), moment_left(:, :), moment_right(:, :)
        !> Linear solves that they took, shape (ncase)
        integer, intent(out), optional :: solves(:)
        type(environment_type) :: environment
        type(options_type) :: chosen
        type(case_numbers_type) :: numbers
        type(case_solutions_type) :: solutions
        integer, allocatable, target :: codes(:)
        integer :: supports, nodes, first, last, n, i, stat
        logical :: given

        call require_beam(beam, error)
        if (allocated(error)) return
        call hold_environment(environment)
        if (present(options)) chosen = options
        call check_call(1.0_wp, chosen, error)
        if (.not. allocated(error)) call require_cases(beam%lowered, cases, error)
        if (.not. allocated(error)) call check_factors(factors, size(beam%lowered%model%loads), size(status), error)
        supports = size(beam%lowered%model%supports)
        nodes = size(beam%lowered%node_point)
        given = present(settlement) .or. present(gap) .or. present(stiffness) &
            .or. (allocated(beam%lowered%given_settlement) .and. .not. cases%alone)
        if (given) call require_own_supports(beam%lowered, error)
        if (present(settlement)) call check_values(beam%lowered, size(status), settlement, "settlement", error)
        if (present(gap)) call check_values(beam%lowered, size(status), gap, "gap", error)
        if (present(stiffness)) call check_values(beam%lowered, size(status), stiffness, "stiffness", error)
        if (present(reaction)) call check_shape([supports, size(status)], shape(reaction), error)
        if (present(deflection)) call check_shape([nodes, size(status)], shape(deflection), error)
        if (present(moment_left)) call check_shape([nodes, size(status)], shape(moment_left), error)
        if (present(moment_right)) call check_shape([nodes, size(status)], shape(moment_right), error)
        if (present(condition)) call check_shape([supports, size(status)], shape(condition), error)
        if (present(solves)) call check_shape([size(status)], shape(solves), error)
        allocate (codes(min(case_batch, size(status))), stat=stat)
        if (stat /= 0 .and. .not. allocated(error)) call no_memory(error)
        do first = 1, size(status), case_batch
            if (allocated(error)) exit
            last = min(first + case_batch - 1, size(status))
            n = last - first + 1
            do i = 1, merge(n, 0, given)
                associate (own => beam%lowered%model%supports, values => cases%values(:, :, i), c => first + i - 1)
                    values(1, :) = own%settlement
                    if (allocated(beam%lowered%given_settlement)) values(1, :) = beam%lowered%given_settlement
                    values(2, :) = own%gap
                    values(3, :) = own%stiffness
                    if (present(settlement)) values(1, :) = settlement(:, c)
                    if (present(gap)) values(2, :) = gap(:, c)
                    if (present(stiffness)) values(3, :) = stiffness(:, c)
                    if (.not. cases%alone) call move_supports(beam%lowered%model%loads, factors(:, c), values(1, :))
                end associate
            end do
            cases%closed(:, :n) = spread(cases%start, 2, n)
            numbers%factors => factors(:, first:last)
            numbers%rule = chosen%rule
            if (given) numbers%supports => cases%values(:, :, :n)
            solutions%closed => cases%closed(:, :n)
            if (present(deflection)) solutions%w => cases%w(:, :n)
            if (present(moment_left)) solutions%ml => cases%ml(:, :n)
            if (present(moment_right)) solutions%mr => cases%mr(:, :n)
            if (present(reaction)) solutions%reaction => cases%reaction(:, :n)
            solutions%solves => cases%solves(:n)
            solutions%status => codes(:n)
            call solve_in_room(beam%lowered, cases%loads, numbers, cases%room, solutions)
            if (codes(1) == gapbeam_no_memory) call no_memory(error)
            if (codes(1) == gapbeam_stopped) call end_if_stopped(beam%lowered%beam%watch, error)
            if (allocated(error)) exit
            status(first:last) = codes(:n)
            if (present(deflection)) deflection(:, first:last) = cases%w(:, :n)
            if (present(moment_left)) moment_left(:, first:last) = cases%ml(:, :n)
            if (present(moment_right)) moment_right(:, first:last) = cases%mr(:, :n)
            if (present(solves)) solves(first:last) = cases%solves(:n)
            if (present(reaction)) call give_reactions(beam%lowered, codes(:n), cases%reaction(:, :n), reaction(:, first:last))
            if (present(condition)) call give_conditions(beam%lowered, codes(:n), cases%closed(:, :n), condition(:, first:last))
        end do
    end subroutine solve_cases

    !> Places of the nodes, and the node of every support
    subroutine get_nodes(beam, x, error, support_node)
        type(prepared_type), intent(in) :: beam
        !> Shape (count_nodes(beam))
        real(wp), intent(out) :: x(:)
        !> gapbeam_not_prepared, or gapbeam_bad_input for arrays of another size
        type(error_type), allocatable, intent(out) :: error
        !> From 1, as the arrays of nodes are read; shape (count_supports(beam))
        integer, intent(out), optional :: support_node(:)

        call require_beam(beam, error)
        if (allocated(error)) return
        associate (lowered => beam%lowered)
            call require_size(size(lowered%node_point), [size(x)], error)
            if (present(support_node)) call require_size(size(lowered%model%supports), [size(support_node)], error)
            if (allocated(error)) return
            call node_places(lowered, x)
            if (present(support_node)) support_node(:) = lowered%node_of_point(lowered%support_point) + 1
        end associate
    end subroutine get_nodes

    !> Where the searches start
    pure subroutine start_closed(lowered, start)
        type(assembled_type), intent(in) :: lowered
        integer, intent(out) :: start(:)
        logical :: closed(size(start))

        call close_all(lowered, closed)
        start(:) = merge(1, 0, closed)
    end subroutine start_closed

    !> Move supports by the loads of a case that do so
    pure subroutine move_supports(loads, factors, settlement)
        type(load_type), intent(in) :: loads(:)
        real(wp), intent(in) :: factors(:)
        !> Of every support
        real(wp), intent(inout) :: settlement(:)
        integer :: i

        do i = 1, size(loads)
            if (loads(i)%kind /= gapbeam_movement) cycle
            associate (moved => settlement(loads(i)%node))
                moved = moved + factors(i)*loads(i)%value
            end associate
        end do
    end subroutine move_supports

    !> Refuse what prepare_cases has not made, or has made from another beam
    subroutine require_cases(lowered, cases, error)
        type(assembled_type), intent(in) :: lowered
        type(cases_type), intent(in) :: cases
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(cases%loads)) then
            call fatal_error(error, gapbeam_not_prepared, "the cases are not prepared: call prepare_cases first")
        else if (cases%fingerprint /= lowered%fingerprint .or. cases%nodes /= size(lowered%node_point) &
                 .or. cases%supports /= size(lowered%beam%supports)) then
            call fatal_error(error, gapbeam_not_prepared, "the cases belong to another beam, or to other loads: call prepare_cases")
        end if
    end subroutine require_cases

    !> Refuse factors that are too few, or no finite numbers
    subroutine check_factors(factors, loads, cases, error)
        real(wp), intent(in) :: factors(:, :)
        integer, intent(in) :: loads, cases
        type(error_type), allocatable, intent(out) :: error
        integer :: i, k

        call require_size(loads, [size(factors, 1)], error)
        call require_size(cases, [size(factors, 2)], error)
        if (allocated(error)) return
        do i = 1, cases
            if (all(abs(factors(:, i)) <= huge(1.0_wp))) cycle
            k = findloc(abs(factors(:, i)) <= huge(1.0_wp), .false., 1)
            call fatal_error(error, gapbeam_bad_input, "case "//trim(whole(i))//", "//trim(named(of_loads, k, loads))// &
                             ": factor: expected a finite number, got "//trim(shown(factors(k, i))))
            error%table = of_loads  ! the entry is the case
            error%entry = i
            return
        end do
    end subroutine check_factors

    !> Refuse other supports by case where they cannot be
    subroutine require_own_supports(lowered, error)
        type(assembled_type), intent(in) :: lowered
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error)) return
        if (any(lowered%with_law)) then
            call fatal_error(error, gapbeam_bad_input, "supports cannot vary by case where one has a law; use combine_loads, "// &
                             "or prepare a model for each")
            error%table = of_supports
        end if
    end subroutine require_own_supports

    !> Refuse numbers that a support cannot have; those of the model are always right
    subroutine check_values(lowered, cases, values, key, error)
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: cases
        !> Shape (nsupport, cases), and what they are
        real(wp), intent(in) :: values(:, :)
        character(len=*), intent(in) :: key
        type(error_type), allocatable, intent(inout) :: error
        integer :: i, k

        call check_shape([size(lowered%model%supports), cases], shape(values), error)
        if (allocated(error)) return
        do i = 1, cases
            do k = 1, size(lowered%model%supports)
                associate (s => lowered%model%supports(k))
                    if (key == "settlement") then
                        call check_number(values(k, i), s%settlement, error)
                    else if (key == "gap") then
                        call check_number(values(k, i), s%gap, error)
                    else
                        call check_number(values(k, i), s%stiffness, error)
                    end if
                end associate
                if (allocated(error)) return
            end do
        end do

    contains

        !> One number
        subroutine check_number(value, own, wrong)
            real(wp), intent(in) :: value, own
            type(error_type), allocatable, intent(out) :: wrong
            character(len=:), allocatable :: expected

            if (value <= own .and. value >= own) return
            associate (s => lowered%model%supports(k))
                if (key == "stiffness" .and. .not. value > 0.0_wp) then
                    expected = "a number above 0 (infinite: rigid)"
                else if (key == "stiffness" .and. s%side /= gapbeam_both .and. .not. own > 0.0_wp) then
                    expected = "0 as in the model, whose support never acts; prepare it with another"
                else if (key /= "stiffness" .and. .not. abs(value) <= huge(value)) then
                    expected = "a finite number"
                else if (key == "gap" .and. (s%side == gapbeam_both .or. s%direction == gapbeam_axial)) then
                    expected = "0, as only a support of side below or above has a gap"
                else
                    return
                end if
                call fatal_error(wrong, gapbeam_bad_input, "case "//trim(whole(i))//", "// &
                                 trim(named(of_supports, k, size(lowered%model%supports)))//": "//key//": expected "//expected// &
                                 ", got "//trim(shown(value)))
                wrong%table = of_supports
                wrong%entry = i
            end associate
        end subroutine check_number

    end subroutine check_values

    !> Refuse an array of another shape
    subroutine check_shape(expected, given, error)
        integer, intent(in) :: expected(:), given(:)
        type(error_type), allocatable, intent(inout) :: error
        integer :: k

        do k = 1, size(expected)
            call require_size(expected(k), given(k:k), error)
        end do
    end subroutine check_shape

    !> Reactions in the order of the model; of a law the sum of those of its kinks
    pure subroutine give_reactions(lowered, status, found, reaction)
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: status(:)
        real(wp), intent(in) :: found(:, :)
        real(wp), intent(out) :: reaction(:, :)
        integer :: i, j, k, last

        do k = 1, size(lowered%model%supports)
            j = lowered%beam_support(k)
            if (j > 0) then
                last = last_breakpoint(lowered%beam%supports, j)
                do i = 1, size(status)
                    reaction(k, i) = sum(found(j:last, i))
                end do
            else
                reaction(k, :) = 0.0_wp   ! it never carries
            end if
            where (status /= gapbeam_solved .or. lowered%model%supports(k)%direction == gapbeam_axial)
                reaction(k, :) = not_a_number
            end where
        end do
    end subroutine give_reactions

    !> Conditions in the order of the model, as gapbeam_support_values has them
    pure subroutine give_conditions(lowered, status, closed, condition)
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: status(:), closed(:, :)
        integer, intent(out) :: condition(:, :)
        type(acting_type) :: acting
        integer :: i, k

        do k = 1, size(lowered%model%supports)
            associate (side => lowered%model%supports(k)%side)
                if (lowered%beam_support(k) > 0) then
                    do i = 1, size(status)
                        acting = acts_in(lowered, k, closed(:, i) /= 0)
                        condition(k, i) = acting%condition
                    end do
                else
                    condition(k, :) = merge(gapbeam_bilateral, gapbeam_open, side == gapbeam_both)
                end if
            end associate
            where (status /= gapbeam_solved) condition(k, :) = gapbeam_open
        end do
    end subroutine give_conditions

end module gapbeam_api_cases
