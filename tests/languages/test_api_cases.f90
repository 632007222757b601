!> Many cases in one call of the Fortran interface: beside solve_beam, in every order, and what is refused
program test_api_cases
    use, intrinsic :: iso_fortran_env, only: wp => real64, int64
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, support_type, law_point_type, foundation_type, prepared_type, options_type, &
        result_type, error_type, cases_type, uniform_load, point_force, axial_force, prepare_model, replace_loads, solve_beam, &
        get_supports, get_motion, count_nodes, prepare_cases, solve_cases, get_nodes, gapbeam_below, gapbeam_axial, gapbeam_dead, &
        gapbeam_infinity, gapbeam_closed, gapbeam_open, gapbeam_branch, gapbeam_bilateral, gapbeam_rule_single, gapbeam_solved, &
        gapbeam_no_equilibrium, gapbeam_indeterminate, gapbeam_bad_input, gapbeam_not_prepared
    implicit none
    integer :: status

    call as_one_by_one()
    call laws_and_axial()
    call held_twice()
    call refused()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Three spans on supports from below, the first one rigid, one dead and one live load
    subroutine three_spans(model)
        type(model_type), intent(out) :: model

        model%spans = [span_type(6.0_wp, EI=1e4_wp), span_type(5.0_wp, EI=1e4_wp), span_type(6.0_wp, EI=1e4_wp)]
        model%supports = [support_type(node=0, side=gapbeam_below), &
                          support_type(node=1, side=gapbeam_below, stiffness=1e5_wp), &
                          support_type(node=2, side=gapbeam_below, stiffness=1e5_wp, gap=0.002_wp), &
                          support_type(node=3, side=gapbeam_below)]
        model%loads = [uniform_load(5.0_wp, from=0.0_wp, to=17.0_wp, case=gapbeam_dead), point_force(20.0_wp, x=3.0_wp)]
    end subroutine three_spans

    !> 600 cases, more than are solved in one go; some have no equilibrium
    subroutine as_one_by_one()
        integer, parameter :: m = 4, n = 600
        type(model_type) :: model, other
        type(prepared_type) :: beam, alone
        type(cases_type) :: cases
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(options_type) :: single
        real(wp) :: factors(2, n), moves(m, n), gaps(m, n), springs(m, n), reaction(m, n), w(m, n), left(m, n), right(m, n), x(m)
        real(wp) :: expected(m, 4), once(m, 1), motion(m)
        integer :: codes(n), conditions(m, n), what(m), nodes(m), solves(n), code(1), i, k, wrong, unsolved

        call three_spans(model)
        call prepare_model(model, beam, error)
        call prepare_cases(beam, cases, error)
        call check(.not. allocated(error), "prepared")
        do i = 1, n
            factors(:, i) = [1.0_wp, 3*random(i, 1) - 1.5_wp]
            do k = 1, m
                moves(k, i) = 0.01_wp*random(i, 4*k)
                gaps(k, i) = 0.01_wp*random(i, 4*k + 1) - 0.002_wp
                springs(k, i) = 1e5_wp*(0.1_wp + random(i, 4*k + 2))
            end do
            if (mod(i, 3) == 0) springs(1, i) = gapbeam_infinity
        end do
        factors(:, 100) = [-1.0_wp, 0.0_wp]
        call solve_cases(beam, cases, factors, codes, error, moves, gaps, springs, reaction=reaction, condition=conditions, &
                         deflection=w, moment_left=left, moment_right=right, solves=solves)
        call check(.not. allocated(error), "solved")
        call get_nodes(beam, x, error, nodes)
        call check_close(x, [0.0_wp, 6.0_wp, 11.0_wp, 17.0_wp], "places of the nodes")
        call check(all(nodes == [1, 2, 3, 4]), "nodes of the supports")

        ! Beside models that have these numbers
        wrong = 0
        unsolved = 0
        do i = 1, n, 20
            call three_spans(other)
            other%supports%settlement = moves(:, i)
            other%supports%gap = gaps(:, i)
            other%supports%stiffness = springs(:, i)
            other%loads%value = factors(:, i)*model%loads%value
            other%loads%value_to = factors(:, i)*model%loads%value_to
            call prepare_model(other, alone, error)
            call solve_beam(alone, 1.0_wp, options_type(), result, error)
            if (codes(i) /= result%status) wrong = wrong + 1
            if (result%status == gapbeam_no_equilibrium) then
                call get_motion(alone, result, x, motion, error)
                unsolved = unsolved + 1
            else
                call get_supports(alone, result, expected(:, 1), expected(:, 2), expected(:, 3), expected(:, 4), what, error)
                if (any(conditions(:, i) /= what)) wrong = wrong + 1
                if (any(abs(reaction(:, i) - expected(:, 1)) > 1e-12_wp*maxval(abs(expected(:, 1))))) wrong = wrong + 1
                if (any(abs(w(:, i) - expected(:, 2)) > 1e-12_wp*maxval(abs(expected(:, 2))))) wrong = wrong + 1
            end if
        end do
        call check(wrong == 0 .and. unsolved == 0, "as models of their own")
        call check(codes(100) == gapbeam_no_equilibrium .and. all(conditions(:, 100) == gapbeam_open) &
                   .and. all(ieee_is_nan(reaction(:, 100))) .and. all(ieee_is_nan(w(:, 100))), "lifted off")
        call check(count(codes == gapbeam_solved) > n - 50 .and. any(conditions == gapbeam_open) &
                   .and. any(conditions == gapbeam_closed) .and. minval(solves) > 0, "of all kinds")

        ! Alone, a case has the same bits
        wrong = 0
        do i = 1, n, 7
            call solve_cases(beam, cases, factors(:, i:i), code, error, moves(:, i:i), gaps(:, i:i), springs(:, i:i), reaction=once)
            if (any(transfer(once(:, 1), 0_int64, m) /= transfer(reaction(:, i), 0_int64, m))) wrong = wrong + 1
            if (code(1) /= codes(i)) wrong = wrong + 1
        end do
        call check(wrong == 0, "the same bits alone")

        ! By the other rule, and where only loads vary
        single%rule = gapbeam_rule_single
        call solve_cases(beam, cases, factors, codes, error, options=single, reaction=reaction)
        call solve_cases(beam, cases, factors, codes, error, settlement=spread([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 2, n), &
                         reaction=w)
        where (ieee_is_nan(w) .and. ieee_is_nan(reaction))
            w = 0.0_wp
            reaction = 0.0_wp
        end where
        call check(all(abs(reaction - w) <= 1e-12_wp*20), "by the paper's rule")
    end subroutine as_one_by_one

    !> A support with a law and one along the axis, where the loads alone vary
    subroutine laws_and_axial()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(cases_type) :: cases
        type(error_type), allocatable :: error
        real(wp) :: reaction(4, 2), moves(4, 2)
        integer :: codes(2), conditions(4, 2)

        model%spans = [span_type(2.0_wp, EI=gapbeam_infinity), span_type(2.0_wp, EI=gapbeam_infinity)]
        model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below), support_type(node=2, stiffness=10.0_wp), &
                          support_type(node=0, direction=gapbeam_axial)]
        model%law = [law_point_type(2, 1.0_wp, 10.0_wp), law_point_type(2, 2.0_wp, 30.0_wp)]
        model%loads = [point_force(10.0_wp, x=4.0_wp)]
        call prepare_model(model, beam, error)
        call prepare_cases(beam, cases, error)
        call solve_cases(beam, cases, reshape([1.0_wp, -1.0_wp], [1, 2]), codes, error, reaction=reaction, condition=conditions)
        call check(.not. allocated(error) .and. all(codes == gapbeam_solved), "with a law")
        ! The right end goes down by w: 2*10 w/2... about the left end 4*10 = 4*10 w + 2*10*(w/2)
        call check_close(reaction(2:3, 1), [4.0_wp, 8.0_wp], "on its first piece")
        call check_close(reaction(3, 2), -10.0_wp, "open")
        call check(all(conditions(2:, 1) == [gapbeam_branch + 1, gapbeam_bilateral, gapbeam_bilateral]) &
                   .and. conditions(2, 2) == gapbeam_open, "conditions")
        call check(all(ieee_is_nan(reaction(4, :))), "nothing of axial supports")
        moves(:, :) = 0.0_wp
        moves(1, 2) = 0.1_wp
        call solve_cases(beam, cases, reshape([1.0_wp, -1.0_wp], [1, 2]), codes, error, moves)
        call refuse(error, gapbeam_bad_input, "has a law", "movements beside a law")
    end subroutine laws_and_axial

    !> Two supports along a beam that does not lengthen share a force, which only the case without it does not have
    subroutine held_twice()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(cases_type) :: cases
        type(error_type), allocatable :: error
        real(wp) :: reaction(4, 2)
        integer :: codes(2)

        model%spans = [span_type(4.0_wp, EI=1e4_wp)]
        model%supports = [support_type(node=0), support_type(node=1), support_type(node=0, direction=gapbeam_axial), &
                          support_type(node=1, direction=gapbeam_axial)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=4.0_wp), axial_force(5.0_wp, x=2.0_wp)]
        model%first_order = .true.
        call prepare_model(model, beam, error)
        call prepare_cases(beam, cases, error)
        call solve_cases(beam, cases, reshape([1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp], [2, 2]), codes, error, reaction=reaction)
        call check(.not. allocated(error) .and. all(codes == gapbeam_indeterminate), "held twice along the axis")
        call check(all(ieee_is_nan(reaction)), "no reactions then")
    end subroutine held_twice

    !> What is no case
    subroutine refused()
        type(model_type) :: model, ground
        type(prepared_type) :: beam, none
        type(cases_type) :: cases
        type(error_type), allocatable :: error
        real(wp) :: factors(2, 3), values(4, 3)
        integer :: codes(3)

        call three_spans(model)
        call prepare_model(model, beam, error)
        call prepare_cases(none, cases, error)
        call refuse(error, gapbeam_not_prepared, "not prepared", "no beam")
        factors(:, :) = 1.0_wp
        call solve_cases(beam, cases, factors, codes, error)
        call refuse(error, gapbeam_not_prepared, "call prepare_cases first", "no cases")
        call prepare_cases(beam, cases, error)
        call solve_cases(beam, cases, factors(:1, :), codes, error)
        call refuse(error, gapbeam_bad_input, "an array has 1 entries, expected 2", "one factor for two loads")
        call solve_cases(beam, cases, factors, codes(:2), error)
        call refuse(error, gapbeam_bad_input, "an array has 3 entries, expected 2", "more cases than statuses")
        factors(2, 3) = gapbeam_infinity
        call solve_cases(beam, cases, factors, codes, error)
        call refuse(error, gapbeam_bad_input, "case 3, load 2 of 2: factor: expected a finite number", "an infinite factor")
        factors(2, 3) = ieee_value(1.0_wp, ieee_quiet_nan)
        call solve_cases(beam, cases, factors, codes, error)
        call refuse(error, gapbeam_bad_input, "case 3, load 2 of 2: factor: expected a finite number, got nan", "no number")
        factors(2, 3) = 1.0_wp
        values(:, :) = 1.0_wp
        values(4, 2) = 0.0_wp
        call solve_cases(beam, cases, factors, codes, error, stiffness=values)
        call refuse(error, gapbeam_bad_input, "case 2, support 4 of 4: stiffness: expected a number above 0", "no stiffness")
        values(4, 2) = gapbeam_infinity
        call solve_cases(beam, cases, factors, codes, error, gap=values)
        call refuse(error, gapbeam_bad_input, "case 2, support 4 of 4: gap: expected a finite number", "an infinite gap")
        call solve_cases(beam, cases, factors, codes, error, settlement=values(:3, :))
        call refuse(error, gapbeam_bad_input, "an array has 3 entries, expected 4", "too few settlements")
        call solve_cases(beam, cases, factors, codes, error, deflection=values(:3, :))
        call refuse(error, gapbeam_bad_input, "an array has 3 entries, expected 4", "too little room")
        call solve_cases(beam, cases, factors, codes, error, options=options_type(rule=7))
        call refuse(error, gapbeam_bad_input, "rule: expected 0 (block) or 1 (single), got 7", "no rule")
        call replace_loads(beam, [model%loads, point_force(1.0_wp, x=1.0_wp)], error)
        call solve_cases(beam, cases, factors, codes, error)
        call refuse(error, gapbeam_not_prepared, "to other loads", "other loads")
        call three_spans(ground)
        ground%foundations = [foundation_type(k=1e3_wp)]
        call prepare_model(ground, beam, error)
        call prepare_cases(beam, cases, error)
        call check(.not. allocated(error), "cases on the ground are taken")
        call check(count_nodes(none) == 0, "nothing is prepared")
    end subroutine refused

    !> An error must have been found, with a word of the message
    subroutine refuse(error, code, word, what)
        type(error_type), allocatable, intent(in) :: error
        integer, intent(in) :: code
        character(len=*), intent(in) :: word, what

        call check(allocated(error), "refused: "//what)
        if (.not. allocated(error)) return
        call check(error%code == code .and. index(error%message, word) > 0, error%message)
    end subroutine refuse

    !> A number from 0 to 1, the same on every run
    pure function random(i, k) result(number)
        integer, intent(in) :: i, k
        real(wp) :: number

        number = modulo(12.9898_wp*i + 78.233_wp*k + 43758.5453_wp*sin(0.7_wp*i + 1.3_wp*k), 1.0_wp)
    end function random

end program test_api_cases
