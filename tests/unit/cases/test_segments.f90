!> Long beams in segments: the bits of solve_case at every level of the processor; doubtful cases are left
program test_segments
    use, intrinsic :: iso_fortran_env, only: int64
    use testing, only: check, finish
    use lane_beams, only: numbers_of, solutions_of
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_scene, only: span_type, support_type, point_force, point_couple, uniform_load, gapbeam_infinity
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_search, only: rule_block
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, replace_supports
    use gapbeam_cpu_dispatch, only: least_level, best_level, compiled_at
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_case_types, only: case_solutions_type, remaining
    use gapbeam_segment_types, only: segment_room_type
    use gapbeam_segment_cases, only: segments_type, fits_segments, solve_in_segments
    implicit none

    integer, parameter :: beams = 24, cases = 3
    integer :: status

    !> What comes out of some cases
    type :: found_type
        integer, allocatable :: closed(:, :), solves(:)
        real(wp), allocatable :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        logical, allocatable :: done(:)
    end type found_type

    call segments_have_the_bits_of_the_whole()
    call couples_and_lifted_ends_are_left()
    call what_is_broken_is_found()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Beams on rigid and elastic supports, some of which hardly feel what is far away, and some of which do
    subroutine segments_have_the_bits_of_the_whole()
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(found_type) :: best, other
        real(wp), allocatable :: factors(:, :), values(:, :, :)
        integer(int64) :: seed
        integer :: b, level, other_level, other_bits, solved, total, fitting

        seed = 88172645463325252_int64
        other_level = 0
        other_bits = 0
        solved = 0
        total = 0
        fitting = 0
        do b = 1, beams
            call make_beam(seed, b, lowered)
            call split_loads(lowered, loads, error)
            if (fits_segments(lowered)) fitting = fitting + 1
            call draw_cases(seed, lowered, b, factors, values)
            call solve(lowered, loads, factors, values, best_level(), best)
            do level = least_level, best_level() - 1
                call solve(lowered, loads, factors, values, level, other)
                other_level = other_level + count(.not. same(best, other))
            end do
            call solve_one_by_one(lowered, loads, factors, values, other)
            ! What is left to the engine is no difference
            total = total + count(other%done)
            solved = solved + count(best%done)
            other%done = other%done .and. best%done
            other_bits = other_bits + count(.not. (same(best, other) .or. .not. best%done))
        end do
        call check(fitting == beams, "all these beams are such as segments hold")
        call check(other_level == 0, "every kind of processor gives the same numbers")
        call check(other_bits == 0, "the numbers are those of single cases")
        call check(2*solved > total, "most cases are solved in segments")
        write (*, "(a, 4(1x, i0))") "# otherwise by level, engine; solved so, at all:", other_level, other_bits, solved, total
    end subroutine segments_have_the_bits_of_the_whole

    !> Couples at nodes, and ends that do not hold
    subroutine couples_and_lifted_ends_are_left()
        type(assembled_type) :: lowered, turned, lifted
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(found_type) :: found
        real(wp), allocatable :: factors(:, :), values(:, :, :)
        integer(int64) :: seed
        integer :: last

        seed = 362436069_int64
        call make_beam(seed, 1, lowered)
        turned%model = lowered%model
        turned%model%loads(4) = point_couple(5.0_wp, node=7)
        call assemble_model(turned, error)
        call split_loads(turned, loads, error)
        call draw_cases(seed, lowered, 1, factors, values)
        factors(4, 1) = 0.0_wp
        call solve(turned, loads, factors, values, best_level(), found)
        call check(found%done(1) .and. .not. any(found%done(2:)), "a couple at a node is left, where its factor is not zero")

        lifted%model = lowered%model
        last = size(lifted%model%supports)
        lifted%model%supports(last)%side = 1
        lifted%model%loads(4) = point_force(-1e4_wp, node=size(lifted%model%spans))
        call assemble_model(lifted, error)
        call split_loads(lifted, loads, error)
        call solve(lifted, loads, spread([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], 2, 1), values(:, :0, :1), best_level(), found)
        call check(.not. found%done(1), "an end that is lifted is left")
        call check(all(found%closed == 1), "with the start as it was")
    end subroutine couples_and_lifted_ends_are_left

    !> Every kind of number broken on purpose, anywhere along the beam, at every level of the processor
    subroutine what_is_broken_is_found()
        integer, parameter :: kinds = 4, places = 40
        character(len=12), parameter :: names(kinds) = [character(len=12) :: "a reaction", "a deflection", "a moment", "a state"]
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(found_type) :: found
        type(segments_type) :: segments
        type(segment_room_type) :: broken
        type(compiled_type) :: compiled
        real(wp), allocatable :: factors(:, :), values(:, :, :)
        integer(int64) :: seed
        integer :: b, i, k, kind, level, missed(kinds), refused, passed
        logical :: wrong

        seed = 521288629_int64
        missed(:) = 0
        refused = 0
        passed = 0
        do b = 1, 6
            call make_beam(seed, b, lowered)
            call split_loads(lowered, loads, error)
            call draw_cases(seed, lowered, b, factors, values)
            call make_room(lowered, 1, found)
            segments%made = .false.
            call solve_cases(lowered, loads, factors(:, :1), values(:, :, :1), segments, found)
            if (.not. found%done(1)) cycle
            passed = passed + 1
            do level = least_level, best_level()
                compiled = compiled_at(level, .false.)
                call compiled%audit_long_beam(segments%beam, segments%room, wrong)
                if (wrong) refused = refused + 1
                do kind = 1, kinds
                    do i = 1, places
                        broken = segments%room
                        k = int((segments%beam%n + 1)*random(seed))
                        ! Supports are at some nodes only
                        if (kind == 1 .or. kind == 4) k = lowered%beam%supports(1 + modulo(k, size(lowered%beam%supports)))%node
                        if (kind == 1) broken%reaction(k) = broken%reaction(k) + 1e-7_wp*maxval(abs(broken%reaction))
                        if (kind == 2) broken%w(k) = broken%w(k) - 1e-7_wp*maxval(abs(broken%w))
                        if (kind == 3) broken%m(k) = broken%m(k) + 1e-7_wp*maxval(abs(broken%m))
                        if (kind == 4) broken%closed(k) = 1.0_wp - broken%closed(k)
                        call compiled%audit_long_beam(segments%beam, broken, wrong)
                        if (.not. wrong) missed(kind) = missed(kind) + 1
                    end do
                end do
            end do
        end do
        call check(refused == 0 .and. passed > 3, "what has been solved is a solution")
        do kind = 1, kinds
            call check(missed(kind) == 0, trim(names(kind))//" that is wrong is found")
        end do
        write (*, "(a, *(1x, i0))") "# passed, refused, missed:", passed, refused, missed
    end subroutine what_is_broken_is_found

    !> Room for what comes out
    subroutine make_room(lowered, c, found)
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: c
        type(found_type), intent(out) :: found
        integer :: n, m

        n = size(lowered%beam%links) + 1
        m = size(lowered%beam%supports)
        ! A row more than there are supports, as in Python
        allocate (found%closed(m + 1, c), found%solves(c), found%w(n, c), found%ml(n, c), found%mr(n, c), &
                  found%reaction(m + 1, c), found%done(c))
        found%closed(:, :) = 1
        found%w(:, :) = 0.0_wp
        found%ml(:, :) = 0.0_wp
        found%mr(:, :) = 0.0_wp
        found%reaction(:, :) = 0.0_wp
    end subroutine make_room

    !> Solve cases in segments
    subroutine solve_cases(lowered, loads, factors, values, segments, found)
        type(assembled_type), intent(in) :: lowered
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous, target :: factors(:, :), values(:, :, :)
        type(segments_type), intent(inout) :: segments
        !> By make_room
        type(found_type), intent(inout), target :: found
        real(wp), target :: own_spans(2, 0, 0)
        integer, target :: codes(size(found%solves))
        type(case_solutions_type) :: solutions

        found%done(:) = .false.
        solutions = solutions_of(found%closed, found%w, found%ml, found%mr, found%reaction, found%solves, codes)
        call solve_in_segments(lowered, loads, numbers_of(factors, values, own_spans), remaining(found%done), segments, &
                               solutions, found%done)
    end subroutine solve_cases

    !> Solve cases in segments that are made for them
    subroutine solve(lowered, loads, factors, values, level, found)
        type(assembled_type), intent(in) :: lowered
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in) :: factors(:, :), values(:, :, :)
        integer, intent(in) :: level
        type(found_type), intent(out) :: found
        type(segments_type) :: segments
        integer :: beyond

        call make_room(lowered, size(factors, 2), found)
        segments%level = level
        call solve_cases(lowered, loads, factors, values, segments, found)
        beyond = size(lowered%beam%supports) + 1
        if (any(found%closed(beyond, :) /= 1) .or. any(abs(found%reaction(beyond, :)) > 0.0_wp)) then
            call check(.false., "what is beyond the supports stays as it was")
        end if
    end subroutine solve

    !> The same by the engine for all beams
    subroutine solve_one_by_one(lowered, loads, factors, values, found)
        type(assembled_type), intent(in) :: lowered
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in) :: factors(:, :), values(:, :, :)
        type(found_type), intent(out) :: found
        type(beam_type) :: beam
        type(workspace_type) :: work
        logical, allocatable :: acting(:)
        integer :: i, state

        call make_room(lowered, size(factors, 2), found)
        beam = lowered%beam
        call new_workspace(beam, work)
        allocate (acting(size(beam%supports)))
        do i = 1, size(factors, 2)
            if (size(values, 2) > 0) call replace_supports(lowered, values(:, :, i), beam, state)
            acting(:) = .true.
            call solve_case(loads, factors(:, i), rule_block, beam, acting, work, state)
            found%done(i) = state == gapbeam_solved
            if (.not. found%done(i)) cycle
            associate (units => lowered%units, a => work%answers)
                found%closed(:size(acting), i) = merge(1, 0, acting)
                found%w(:, i) = scale(a%deflection, units%deflection)
                found%ml(:, i) = scale(a%moment_left, moment_unit(units))
                found%mr(:, i) = scale(a%moment_right, moment_unit(units))
                found%reaction(:size(acting), i) = scale(work%reaction, units%force)
            end associate
        end do
    end subroutine solve_one_by_one

    !> Are cases the same, to the last bit
    pure function same(a, b) result(equal)
        type(found_type), intent(in) :: a, b
        logical :: equal(size(a%done))
        integer :: i

        do i = 1, size(a%done)
            equal(i) = a%done(i) .eqv. b%done(i)
            if (.not. a%done(i)) cycle
            equal(i) = equal(i) .and. all(a%closed(:, i) == b%closed(:, i)) &
                .and. .not. any(abs(a%w(:, i) - b%w(:, i)) > 0.0_wp .or. abs(a%ml(:, i) - b%ml(:, i)) > 0.0_wp &
                                .or. abs(a%mr(:, i) - b%mr(:, i)) > 0.0_wp) &
                .and. .not. any(abs(a%reaction(:, i) - b%reaction(:, i)) > 0.0_wp)
        end do
    end function same

    !> A beam of 600 to 900 spans with both ends held; every third one on soft springs close to each other
    subroutine make_beam(seed, number, lowered)
        integer(int64), intent(inout) :: seed
        integer, intent(in) :: number
        type(assembled_type), intent(out) :: lowered
        type(error_type), allocatable :: error
        type(support_type), allocatable :: supports(:)
        real(wp) :: x, stiffness
        integer :: i, m, n

        n = 600 + int(300*random(seed)**2)
        stiffness = 10.0_wp**(2 + 4*random(seed))
        associate (model => lowered%model)
            allocate (model%spans(n), model%hinges(0), model%sections(0), model%law(0), model%foundations(0), model%ground(0), &
                      model%ground_law(0), supports(n + 1))
            do i = 1, n
                if (modulo(number, 3) == 0) model%spans(i) = span_type(0.05_wp, EI=1e4_wp)
                if (modulo(number, 3) > 0) model%spans(i) = span_type(3.0_wp + 4*random(seed), EI=10.0_wp**(3 + random(seed)))
            end do
            m = 0
            do i = 0, n
                x = random(seed)
                if (x < 0.1_wp .and. i > 0 .and. i < n) cycle
                m = m + 1
                supports(m) = support_type(node=i, settlement=0.001_wp*(random(seed) - 0.5_wp))
                if (random(seed) < 0.8_wp) supports(m)%stiffness = stiffness
                if (i == 0 .or. i == n .or. x < 0.2_wp) cycle
                supports(m)%side = merge(1, -1, x < 0.85_wp)
                if (random(seed) < 0.6_wp) supports(m)%gap = 0.01_wp*(random(seed) - 0.2_wp)
            end do
            allocate (model%supports(m), model%loads(4))
            model%supports(:) = supports(:m)
            x = sum(model%spans%length)
            model%loads(1) = uniform_load(10.0_wp, 0.0_wp, x)
            model%loads(2) = uniform_load(-20*random(seed), 0.3_wp*x*random(seed), x*(0.5_wp + 0.5_wp*random(seed)))
            model%loads(3) = point_force(40*random(seed), x=x*random(seed))
            model%loads(4) = point_force(-90*random(seed), node=1 + int((n - 1)*random(seed)))
        end associate
        call assemble_model(lowered, error)
    end subroutine make_beam

    !> Factors, and for every second beam supports that differ from case to case
    subroutine draw_cases(seed, lowered, beam, factors, values)
        integer(int64), intent(inout) :: seed
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: beam
        real(wp), allocatable, intent(out) :: factors(:, :), values(:, :, :)
        integer :: i, k

        associate (given => lowered%model%supports)
            allocate (factors(size(lowered%model%loads), cases))
            allocate (values(3, merge(size(given), 0, modulo(beam, 2) == 0), cases))
            do i = 1, cases
                do k = 1, size(factors, 1)
                    factors(k, i) = 3*random(seed) - 1
                end do
                do k = 1, size(values, 2)
                    values(:, k, i) = [given(k)%settlement + 0.001_wp*(random(seed) - 0.5_wp), given(k)%gap, given(k)%stiffness]
                    if (random(seed) < 0.1_wp) values(3, k, i) = gapbeam_infinity
                end do
            end do
        end associate
    end subroutine draw_cases

    !> From 0 to 1 (Marsaglia 2003)
    function random(seed) result(x)
        integer(int64), intent(inout) :: seed
        real(wp) :: x

        seed = ieor(seed, shiftl(seed, 13))
        seed = ieor(seed, shiftr(seed, 7))
        seed = ieor(seed, shiftl(seed, 17))
        x = real(shiftr(seed, 11), wp)*2.0_wp**(-53)
    end function random

end program test_segments
