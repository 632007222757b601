!> Cases side by side: the bits of solve_case whatever the lane, the level of the processor and the company; doubtful cases are left
program test_lanes
    use, intrinsic :: iso_fortran_env, only: int64
    use testing, only: check, finish
    use lane_beams, only: make_beam, draw_cases, random, bits, numbers_of, solutions_of
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: bending_count
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_finite
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type, piece_length
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_search, only: rule_block
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type, remaining
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, replace_supports
    use gapbeam_cpu_dispatch, only: least_level, best_level
    use gapbeam_lane_cases, only: lane_room_type, fits_lanes, solve_in_lanes
    use gapbeam_case_extremes, only: case_fields_type, extremes_of_cases
    use gapbeam_case_certificates, only: certify_cases, certificate_numbers
    implicit none

    !> Cases of a beam; beams of 2 to 40 spans, the last ones of 300 to 700, whose solution alone is kept up to date, with
    !> other last digits
    integer, parameter :: cases = 20, beams = 240, long_beams = 2
    !> Certificates of longer beams take their time where a case goes alone
    integer, parameter :: most_certified = 12
    integer :: status

    !> What comes out of some cases
    type :: found_type
        integer, allocatable :: closed(:, :), solves(:)
        real(wp), allocatable :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        logical, allocatable :: done(:)
        !> Extremes of the fields, and their places
        real(wp), allocatable :: extremes(:, :, :), places(:, :, :)
        !> Fields at both ends of the beam
        real(wp), allocatable :: fields(:, :, :)
        !> Certificates
        real(wp), allocatable :: certificate(:, :)
    end type found_type

    call lanes_have_the_bits_of_single_cases()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Many beams with supports of all kinds
    subroutine lanes_have_the_bits_of_single_cases()
        type(assembled_type) :: lowered
        type(case_loads_type), allocatable :: loads
        type(error_type), allocatable :: error
        type(found_type) :: all_cases, alone, back
        real(wp), allocatable :: factors(:, :), values(:, :, :), spans(:, :, :)
        integer(int64) :: seed
        integer :: b, i, n, level, left, other_level, other_lane, other_bits, total, missed

        seed = 2463534242_int64
        left = 0
        total = 0
        other_level = 0
        other_lane = 0
        other_bits = 0
        missed = 0
        do b = 1, beams
            n = 2 + int(39*random(seed)**3)
            if (b > beams - long_beams) n = 300 + int(400*random(seed))
            call make_beam(seed, n, .false., lowered)
            if (.not. allocated(loads)) allocate (loads)
            call split_loads(lowered, loads, error)
            if (.not. fits_lanes(lowered)) cycle
            call draw_cases(seed, lowered, cases, modulo(b, 2) == 0, modulo(b, 3) == 0, factors, values, spans)
            call solve(lowered, loads, factors, values, spans, best_level(), all_cases)
            total = total + cases
            left = left + count(.not. all_cases%done)
            do level = least_level, best_level() - 1
                call solve(lowered, loads, factors, values, spans, level, back)
                other_level = other_level + count(.not. same(all_cases, back, [(i, i=1, cases)]))
            end do
            call solve(lowered, loads, factors(:, cases:1:-1), values(:, :, cases:1:-1), spans(:, :, cases:1:-1), best_level(), &
                       back)
            other_lane = other_lane + count(.not. same(all_cases, back, [(cases + 1 - i, i=1, cases)]))
            i = 1 + modulo(b, cases)
            call solve(lowered, loads, factors(:, i:i), values(:, :, i:i), spans(:, :, i:i), best_level(), alone)
            if (.not. all(same(alone, all_cases, [i]))) other_lane = other_lane + 1
            call compare(lowered, loads, factors, values, spans, b > beams - long_beams, all_cases, other_bits, missed)
        end do
        call check(total > beams*cases/2, "most of the beams are such as lanes hold")
        call check(other_level == 0, "every kind of processor gives the same bits")
        call check(other_lane == 0, "every lane gives the same bits, and a case alone")
        call check(other_bits == 0, "the bits are those of single cases")
        call check(25*missed < total, "few cases that have a solution are left to others")
        write (*, "(a, 6(1x, i0))") "# otherwise by level, lane, engine; left, of those solved, of all:", other_level, other_lane, &
            other_bits, left, missed, total
    end subroutine lanes_have_the_bits_of_single_cases

    !> Solve cases side by side
    subroutine solve(lowered, loads, factors, values, spans, level, found)
        type(assembled_type), intent(in) :: lowered
        type(case_loads_type), allocatable, intent(in) :: loads
        real(wp), intent(in), contiguous, target :: factors(:, :), values(:, :, :), spans(:, :, :)
        integer, intent(in) :: level
        type(found_type), intent(out), target :: found
        type(lane_room_type) :: room
        type(case_numbers_type) :: numbers
        type(case_solutions_type) :: solutions
        type(case_fields_type) :: fields
        integer, allocatable, target :: status(:)
        logical, allocatable :: known(:)
        integer :: n, m, c

        n = size(lowered%beam%links) + 1
        m = size(lowered%beam%supports)
        c = size(factors, 2)
        ! A row more than there are supports, as in Python
        allocate (found%closed(m + 1, c), found%solves(c), found%w(n, c), found%ml(n, c), found%mr(n, c), &
                  found%reaction(m + 1, c), found%done(c), status(c))
        found%closed(:, :) = 1
        found%w(:, :) = 0.0_wp
        found%ml(:, :) = 0.0_wp
        found%mr(:, :) = 0.0_wp
        found%reaction(:, :) = 0.0_wp
        found%done(:) = .false.
        numbers = numbers_of(factors, values, spans)
        solutions = solutions_of(found%closed, found%w, found%ml, found%mr, found%reaction, found%solves, status)
        room%block%level = level
        call solve_in_lanes(lowered, loads, numbers, remaining(found%done), room, solutions, found%done)
        if (any(found%closed(m + 1, :) /= 1) .or. any(abs(found%reaction(m + 1, :)) > 0.0_wp)) then
            call check(.false., "what is beyond the supports stays as it was")
        end if
        allocate (found%extremes(2, bending_count, c), found%places(2, bending_count, c), found%fields(bending_count, 2, c))
        found%fields(:, :, :) = 0.0_wp
        found%extremes(:, :, :) = 0.0_wp
        found%places(:, :, :) = 0.0_wp
        fields%extremes => found%extremes
        fields%places => found%places
        fields%fields => found%fields
        status(:) = merge(gapbeam_solved, gapbeam_not_finite, found%done)
        nullify (solutions%reaction)
        call extremes_of_cases(lowered, loads, numbers, solutions, spread(.true., 1, bending_count), [1, size(lowered%pieces)], &
                               [0.0_wp, piece_length(lowered, size(lowered%pieces))], fields, level)
        allocate (found%certificate(certificate_numbers, c), known(c))
        found%certificate(:, :) = 0.0_wp
        solutions%reaction => found%reaction
        nullify (numbers%spans)
        if (n <= most_certified) then
            call certify_cases(lowered, loads, numbers, solutions, found%certificate, known, level)
        end if
        found%done = found%done .and. status == gapbeam_solved
    end subroutine solve

    !> Are cases the same, to the last bit
    pure function same(a, b, number) result(equal)
        type(found_type), intent(in) :: a, b
        !> Which cases of b those of a are
        integer, intent(in) :: number(:)
        logical :: equal(size(number))
        integer :: i

        do i = 1, size(number)
            associate (k => number(i))
                equal(i) = a%done(i) .eqv. b%done(k)
                if (.not. a%done(i)) cycle
                equal(i) = equal(i) .and. all(a%closed(:, i) == b%closed(:, k)) .and. &
                    all(bits(a%w(:, i)) == bits(b%w(:, k)) .and. bits(a%ml(:, i)) == bits(b%ml(:, k)) &
                        .and. bits(a%mr(:, i)) == bits(b%mr(:, k))) .and. all(bits(a%reaction(:, i)) == bits(b%reaction(:, k))) &
                    .and. all(bits(a%extremes(:, :, i)) == bits(b%extremes(:, :, k)) &
                              .and. bits(a%places(:, :, i)) == bits(b%places(:, :, k))) &
                    .and. all(bits(a%fields(:, :, i)) == bits(b%fields(:, :, k))) &
                    .and. all(bits(a%certificate(:, i)) == bits(b%certificate(:, k)))
            end associate
        end do
    end function same

    !> Cases that come out otherwise one by one, and those that are solved only so
    subroutine compare(given, given_loads, factors, values, spans, long, found, number, missed)
        type(assembled_type), intent(in) :: given
        type(case_loads_type), intent(in) :: given_loads
        real(wp), intent(in) :: factors(:, :), values(:, :, :), spans(:, :, :)
        !> Not to the last bit
        logical, intent(in) :: long
        type(found_type), intent(in) :: found
        integer, intent(inout) :: number, missed
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(beam_type) :: beam
        type(workspace_type) :: work
        type(error_type), allocatable :: error
        logical, allocatable :: acting(:)
        integer :: i, m, status

        lowered = given
        loads = given_loads
        beam = lowered%beam
        call new_workspace(beam, work)
        m = size(beam%supports)
        allocate (acting(m))
        do i = 1, cases
            if (size(spans, 2) > 0) then
                lowered%model%spans%EI = spans(1, :, i)
                lowered%model%spans%GA = spans(2, :, i)
                call assemble_loads(lowered, error)
                call split_loads(lowered, loads, error)
                beam = lowered%beam
                call new_workspace(beam, work)
            end if
            if (size(values, 2) > 0) call replace_supports(lowered, values(:, :, i), beam, status)
            acting(:) = .true.
            call solve_case(loads, factors(:, i), rule_block, beam, acting, work, status)
            if (.not. found%done(i)) then
                if (status == gapbeam_solved) missed = missed + 1
                cycle
            end if
            associate (units => lowered%units, a => work%answers)
                if (status == gapbeam_solved .and. all(acting .eqv. found%closed(:m, i) == 1)) then
                    if (all(bits(scale(a%deflection, units%deflection)) == bits(found%w(:, i)) &
                            .and. bits(scale(a%moment_left, moment_unit(units))) == bits(found%ml(:, i)) &
                            .and. bits(scale(a%moment_right, moment_unit(units))) == bits(found%mr(:, i))) &
                        .and. all(bits(scale(work%reaction, units%force)) == bits(found%reaction(:m, i)))) cycle
                    associate (w => scale(a%deflection, units%deflection), r => scale(work%reaction, units%force))
                        if (long .and. all(abs(w - found%w(:, i)) <= 1e-12_wp*maxval(abs(w))) &
                            .and. all(abs(r - found%reaction(:m, i)) <= 1e-12_wp*maxval(abs(r)))) cycle
                    end associate
                end if
            end associate
            number = number + 1
        end do
    end subroutine compare

end program test_lanes
