!> Random cases of beams of ten widths, 3 to 300 spans: the same bits in one call, alone, by the general engine, at every level of
!> instructions, and in four threads on one prepared beam
!>
!> Usage: lane_widths [CASES [SEED]]     cases of all widths together; 1000000 take some minutes
program lane_widths
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_ptr, c_null_ptr, c_funptr, c_funloc, c_loc, c_f_pointer
    use testing, only: check, finish
    use lane_beams, only: make_beam, draw_cases, random, bits, numbers_of, solutions_of
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_search, only: rule_block
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, replace_supports
    use gapbeam_cpu_dispatch, only: least_level, best_level
    use gapbeam_lane_cases, only: lane_room_type, fits_lanes, solve_in_lanes
    use gapbeam_case_types, only: case_solutions_type, remaining
    use gapbeam_many_cases, only: case_room_type, solve_cases
    implicit none

    integer, parameter :: widths(10) = [3, 5, 8, 10, 17, 30, 60, 100, 299, 300]
    !> Most cases of a beam, threads, and where the cases of each begin
    integer, parameter :: most = 100, threads = 4
    !> What was compared, and what of it came out otherwise
    integer, parameter :: alone = 1, engine = 2, levels = 3, in_threads = 4, kinds = 4

    !> Cases of a beam, and what came of them
    type :: share_type
        type(assembled_type), pointer :: lowered => null()
        type(case_loads_type), pointer :: loads => null()
        real(wp), pointer, contiguous :: factors(:, :) => null(), values(:, :, :) => null(), spans(:, :, :) => null()
        integer, allocatable :: closed(:, :), solves(:), status(:)
        real(wp), allocatable :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        logical, allocatable :: done(:)
    end type share_type

    interface
        !> POSIX
        function pthread_create(thread, attributes, start, argument) result(code) bind(c)
            import :: c_intptr_t, c_ptr, c_funptr, c_int
            implicit none
            integer(c_intptr_t), intent(out) :: thread
            type(c_ptr), intent(in), value :: attributes, argument
            type(c_funptr), intent(in), value :: start
            integer(c_int) :: code
        end function pthread_create
        !> POSIX
        function pthread_join(thread, answer) result(code) bind(c)
            import :: c_intptr_t, c_ptr, c_int
            implicit none
            integer(c_intptr_t), intent(in), value :: thread
            type(c_ptr), intent(in), value :: answer
            integer(c_int) :: code
        end function pthread_join
    end interface

    call all_widths(argument(1, 200), argument(2, 1))

contains

    !> A number of the command line
    function argument(position, default) result(number)
        integer, intent(in) :: position, default
        integer :: number
        character(len=20) :: text

        number = default
        if (command_argument_count() < position) return
        call get_command_argument(position, text)
        read (text, *) number
    end function argument

    !> Compare the cases of all widths
    subroutine all_widths(cases, start)
        integer, intent(in) :: cases, start
        integer :: i, left, now, seen(kinds), wrong(kinds), all_seen(kinds), status, unsolved
        integer(int64) :: seed
        logical :: other

        seed = 2463534242_int64 + 7919*start
        all_seen(:) = 0
        other = .false.
        do i = 1, size(widths)
            left = cases/size(widths)
            seen(:) = 0
            wrong(:) = 0
            unsolved = 0
            do while (left > 0)
                now = min(left, most)
                call one_beam(seed, widths(i), now, seen, wrong, unsolved)
                left = left - now
            end do
            write (*, "(*(a, i0))") "# ", widths(i), " spans, without an answer ", unsolved, &
                "; compared, otherwise: alone ", seen(alone), ", ", wrong(alone), "; engine ", seen(engine), ", ", wrong(engine), &
                "; levels ", seen(levels), ", ", wrong(levels), "; threads ", seen(in_threads), ", ", wrong(in_threads)
            call check(all(wrong == 0) .and. seen(levels) > 0 .and. (seen(engine) > 0 .eqv. widths(i) < 300), &
                       "the same bits whatever stands beside a case")
            all_seen = all_seen + seen
        end do
        call finish(status)
        if (status /= 0) stop 1, quiet=.true.
    end subroutine all_widths

    !> Draw a beam and cases of it, and solve them in all ways
    subroutine one_beam(seed, spans, cases, seen, wrong, unsolved)
        integer(int64), intent(inout) :: seed
        integer, intent(in) :: spans, cases
        integer, intent(inout) :: seen(:), wrong(:), unsolved
        type(assembled_type), target :: lowered
        type(case_loads_type), target :: loads
        type(error_type), allocatable :: error
        real(wp), allocatable, target :: factors(:, :), values(:, :, :), own_spans(:, :, :)
        type(share_type), target :: together, one, part(threads)
        type(case_room_type) :: room
        type(lane_room_type) :: lane_room
        type(case_solutions_type) :: solutions
        integer(c_intptr_t) :: thread(threads)
        integer(c_int) :: code
        integer :: bounds(0:threads), i, t, level
        logical :: varied

        call make_beam(seed, spans, spans >= 299, lowered)
        call split_loads(lowered, loads, error)
        varied = random(seed) < 0.5_wp
        call draw_cases(seed, lowered, cases, varied, random(seed) < 0.4_wp, factors, values, own_spans)
        call share_cases(lowered, loads, factors, values, own_spans, together)
        call solve_share(together, room)
        unsolved = unsolved + count(together%status == gapbeam_no_equilibrium)

        do i = 1, cases
            call share_cases(lowered, loads, factors(:, i:i), values(:, :, i:i), own_spans(:, :, i:i), one)
            call solve_share(one, room)
            call count_one(same(together, i, one, 1), alone, seen, wrong)
        end do
        ! A longer beam alone keeps its solution up to date, with other last digits
        if (spans < 300) call compare_engine(together, seen, wrong)
        if (fits_lanes(lowered)) then
            do level = least_level, best_level()
                call share_cases(lowered, loads, factors, values, own_spans, one)
                lane_room = lane_room_type()
                lane_room%block%level = level
                solutions = solutions_of_share(one)
                call solve_in_lanes(lowered, loads, numbers_of(factors, values, own_spans), remaining(one%done), lane_room, &
                                    solutions, one%done)
                do i = 1, cases
                    if (one%done(i)) call count_one(same(together, i, one, i), levels, seen, wrong)
                end do
            end do
        end if

        bounds(:) = [(cases*t**2/threads**2, t=0, threads)]
        do t = 1, threads
            associate (first => bounds(t - 1) + 1, last => bounds(t))
                call share_cases(lowered, loads, factors(:, first:last), values(:, :, first:last), own_spans(:, :, first:last), &
                                 part(t))
            end associate
            code = pthread_create(thread(t), c_null_ptr, c_funloc(solve_in_thread), c_loc(part(t)))
            if (code /= 0) error stop "no thread"
        end do
        do t = 1, threads
            code = pthread_join(thread(t), c_null_ptr)
            do i = 1, bounds(t) - bounds(t - 1)
                call count_one(same(together, bounds(t - 1) + i, part(t), i), in_threads, seen, wrong)
            end do
        end do
    end subroutine one_beam

    !> Count what was compared
    subroutine count_one(equal, kind, seen, wrong)
        logical, intent(in) :: equal
        integer, intent(in) :: kind
        integer, intent(inout) :: seen(:), wrong(:)

        seen(kind) = seen(kind) + 1
        if (.not. equal) wrong(kind) = wrong(kind) + 1
    end subroutine count_one

    !> Cases to be solved
    subroutine share_cases(lowered, loads, factors, values, spans, share)
        type(assembled_type), intent(in), target :: lowered
        type(case_loads_type), intent(in), target :: loads
        real(wp), intent(in), contiguous, target :: factors(:, :), values(:, :, :), spans(:, :, :)
        type(share_type), intent(out) :: share
        integer :: n, m, c

        share%lowered => lowered
        share%loads => loads
        share%factors => factors
        share%values => values
        share%spans => spans
        n = size(lowered%beam%links) + 1
        m = size(lowered%beam%supports)
        c = size(factors, 2)
        allocate (share%closed(m, c), share%solves(c), share%status(c), share%w(n, c), share%ml(n, c), share%mr(n, c), &
                  share%reaction(m, c), share%done(c))
        share%closed(:, :) = 1
        share%solves(:) = 0
        share%status(:) = gapbeam_solved
        share%w(:, :) = 0.0_wp
        share%ml(:, :) = 0.0_wp
        share%mr(:, :) = 0.0_wp
        share%reaction(:, :) = 0.0_wp
        share%done(:) = .false.
    end subroutine share_cases

    !> Columns for their solutions
    function solutions_of_share(share) result(solutions)
        type(share_type), intent(in), target :: share
        type(case_solutions_type) :: solutions

        solutions = solutions_of(share%closed, share%w, share%ml, share%mr, share%reaction, share%solves, share%status)
    end function solutions_of_share

    !> Solve them in one call
    subroutine solve_share(share, room)
        type(share_type), intent(inout), target :: share
        !> Empty, or of earlier cases of the beam
        type(case_room_type), intent(inout) :: room
        type(case_solutions_type) :: solutions

        solutions = solutions_of_share(share)
        call solve_cases(share%lowered, share%loads, numbers_of(share%factors, share%values, share%spans), room, solutions)
    end subroutine solve_share

    !> The same, for pthread_create
    function solve_in_thread(address) result(answer) bind(c)
        type(c_ptr), intent(in), value :: address
        type(c_ptr) :: answer
        type(share_type), pointer :: share
        type(case_room_type) :: room

        call c_f_pointer(address, share)
        call solve_share(share, room)
        answer = c_null_ptr
    end function solve_in_thread

    !> Has case i of a the bits of case k of b
    pure function same(a, i, b, k) result(equal)
        type(share_type), intent(in) :: a, b
        integer, intent(in) :: i, k
        logical :: equal

        equal = a%status(i) == b%status(k)
        if (.not. equal .or. a%status(i) /= gapbeam_solved) return
        equal = all(a%closed(:, i) == b%closed(:, k)) .and. all(bits(a%reaction(:, i)) == bits(b%reaction(:, k))) .and. &
            all(bits(a%w(:, i)) == bits(b%w(:, k)) .and. bits(a%ml(:, i)) == bits(b%ml(:, k)) &
                .and. bits(a%mr(:, i)) == bits(b%mr(:, k)))
    end function same

    !> Compare with the engine that knows no lanes
    subroutine compare_engine(together, seen, wrong)
        type(share_type), intent(in) :: together
        integer, intent(inout) :: seen(:), wrong(:)
        type(share_type) :: one
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(beam_type) :: beam
        type(workspace_type) :: work
        logical, allocatable :: acting(:)
        integer :: i

        lowered = together%lowered
        loads = together%loads
        associate (units => lowered%units)
            beam = lowered%beam
            call new_workspace(beam, work)
            allocate (acting(size(beam%supports)))
            call share_cases(together%lowered, together%loads, together%factors(:, 1:1), together%values(:, :, 1:1), &
                             together%spans(:, :, 1:1), one)
            do i = 1, size(together%status)
                one%status(1) = gapbeam_solved
                if (size(together%spans, 2) > 0) then
                    lowered%model%spans%EI = together%spans(1, :, i)
                    lowered%model%spans%GA = together%spans(2, :, i)
                    call assemble_loads(lowered, error)
                    call split_loads(lowered, loads, error)
                    beam = lowered%beam
                    call new_workspace(beam, work)
                end if
                if (size(together%values, 2) > 0) call replace_supports(lowered, together%values(:, :, i), beam, one%status(1))
                acting(:) = .true.
                call solve_case(loads, together%factors(:, i), rule_block, beam, acting, work, one%status(1))
                one%closed(:, 1) = merge(1, 0, acting)
                one%w(:, 1) = scale(work%answers%deflection, units%deflection)
                one%ml(:, 1) = scale(work%answers%moment_left, moment_unit(units))
                one%mr(:, 1) = scale(work%answers%moment_right, moment_unit(units))
                one%reaction(:, 1) = scale(work%reaction, units%force)
                call count_one(same(together, i, one, 1), engine, seen, wrong)
            end do
        end associate
    end subroutine compare_engine

end program lane_widths
