!> The audit of cases side by side: whatever is broken on purpose is found, in its own lane alone, at every level of instructions;
!> what has not been touched passes
program test_lane_audit
    use, intrinsic :: iso_fortran_env, only: int64
    use testing, only: check, finish
    use lane_beams, only: make_beam, draw_cases, random, numbers_of
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_cases, only: case_loads_type, split_loads
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_cpu_dispatch, only: least_level, best_level, compiled_at
    use gapbeam_lane_cases, only: fits_lanes
    use gapbeam_lane_blocks, only: block_type, make_block, take_cases
    implicit none

    integer, parameter :: beams = 400
    !> What is broken; the last is a state
    integer, parameter :: reaction = 1, deflection = 2, moment = 3, left_moment = 4, right_moment = 5, kinds = 6
    character(len=21), parameter :: names(kinds) = [character(len=21) :: "a reaction", "a deflection", "a moment", &
        "a moment on the left", "a moment on the right", "a state"]
    !> By how much, relative to the largest of its kind
    real(wp), parameter :: share = 1e-7_wp
    integer :: status

    call broken_cases_are_found()
    call extreme_cases_pass()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Beams with supports of all kinds
    subroutine broken_cases_are_found()
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(lane_beam_type) :: beam
        type(compiled_type) :: compiled
        type(pack_type) :: pack, broken
        real(wp), allocatable :: factors(:, :), values(:, :, :), spans(:, :, :)
        integer(int64) :: seed
        logical :: sound(lanes), wrong(lanes), expected(lanes), is_broken
        integer :: b, l, kind, level, tried(kinds), found(kinds), elsewhere, refused, passed

        seed = 1234567890123_int64
        tried(:) = 0
        found(:) = 0
        elsewhere = 0
        refused = 0
        passed = 0
        do b = 1, beams
            call make_beam(seed, 2 + int(20*random(seed)**2), .false., lowered)
            call split_loads(lowered, loads, error)
            if (.not. fits_lanes(lowered)) cycle
            call draw_cases(seed, lowered, lanes, modulo(b, 2) == 0, modulo(b, 3) == 0, factors, values, spans)
            call solve(lowered, loads, factors, values, spans, beam, pack, sound)
            if (.not. any(sound)) cycle
            do level = least_level, best_level()
                compiled = compiled_at(level, size(beam%links, 1) > 1)
                call compiled%audit_pack(beam, pack, wrong)
                refused = refused + count(wrong .and. sound)
                passed = passed + count(sound)
            end do
            if (any(wrong .and. sound)) cycle
            do kind = 1, kinds
                l = 1 + int(lanes*random(seed))
                if (.not. sound(l)) cycle
                broken = pack
                call break_lane(seed, beam, kind, l, broken, is_broken)
                if (.not. is_broken) cycle
                expected = sound
                expected(l) = .false.
                do level = least_level, best_level()
                    compiled = compiled_at(level, size(beam%links, 1) > 1)
                    call compiled%audit_pack(beam, broken, wrong)
                    tried(kind) = tried(kind) + 1
                    if (wrong(l)) found(kind) = found(kind) + 1
                    elsewhere = elsewhere + count(wrong .and. expected)
                end do
            end do
        end do
        call check(refused == 0 .and. passed > beams, "what has been solved is a solution")
        do kind = 1, kinds
            call check(found(kind) == tried(kind) .and. tried(kind) > beams/8, trim(names(kind))//" that is wrong is found")
        end do
        call check(elsewhere == 0, "in its lane alone")
        write (*, "(a, *(1x, i0))") "# passed, refused, tried, found:", passed, refused, tried, found
    end subroutine broken_cases_are_found

    !> What is solved without doubt is not put off, whatever the magnitudes, but where digits are lost
    subroutine extreme_cases_pass()
        type(assembled_type) :: lowered
        type(case_loads_type) :: loads
        type(error_type), allocatable :: error
        type(lane_beam_type) :: beam
        type(compiled_type) :: compiled
        type(pack_type) :: pack
        real(wp), allocatable :: factors(:, :), values(:, :, :), spans(:, :, :)
        integer(int64) :: seed
        logical :: sound(lanes), wrong(lanes)
        integer :: b, i, k, refused, passed

        seed = 987654321_int64
        refused = 0
        passed = 0
        do b = 1, 4*beams
            call make_beam(seed, 2 + int(20*random(seed)**2), .false., lowered)
            call split_loads(lowered, loads, error)
            if (.not. fits_lanes(lowered)) cycle
            call draw_cases(seed, lowered, lanes, .true., modulo(b, 2) == 0, factors, values, spans)
            do i = 1, lanes
                factors(:, i) = factors(:, i)*10.0_wp**(40*random(seed) - 20)
                do k = 1, size(values, 2)
                    if (values(3, k, i) < huge(1.0_wp)) values(3, k, i) = 10.0_wp**(16*random(seed) - 4)
                    if (random(seed) < 0.2_wp) values(1, k, i) = 100*values(1, k, i)
                end do
                do k = 1, size(spans, 2)
                    spans(1, k, i) = 10.0_wp**(14*random(seed) - 3)
                end do
            end do
            call solve(lowered, loads, factors, values, spans, beam, pack, sound)
            if (.not. any(sound)) cycle
            compiled = compiled_at(best_level(), size(beam%links, 1) > 1)
            call compiled%audit_pack(beam, pack, wrong)
            refused = refused + count(wrong .and. sound)
            passed = passed + count(sound)
        end do
        call check(1000*refused <= passed .and. passed > beams, "hardly anything is put off for its magnitudes")
        write (*, "(a, *(1x, i0))") "# passed, refused:", passed, refused
    end subroutine extreme_cases_pass

    !> Solve eight cases side by side, where all of them are solved in the same way
    subroutine solve(lowered, loads, factors, values, spans, beam, pack, sound)
        type(assembled_type), intent(in) :: lowered
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous, target :: factors(:, :), values(:, :, :), spans(:, :, :)
        type(lane_beam_type), intent(out) :: beam
        type(pack_type), intent(out) :: pack
        !> Which of them are solved without doubt
        logical, intent(out) :: sound(lanes)
        type(block_type) :: block
        integer :: closed(size(lowered%beam%supports), lanes), solves(lanes), method(lanes), l
        logical :: doubtful(lanes), fits(lanes)

        closed(:, :) = 1
        associate (numbers => numbers_of(factors, values, spans))
            call make_block(lowered, loads, numbers, block)
            call take_cases(lowered, numbers, closed, [(l, l=1, lanes)], block, fits)
        end associate
        beam = block%beam
        pack = block%pack
        call block%compiled%search_pack(beam, block%factors, pack, solves, method)
        sound(:) = .false.
        if (any(method /= method(1)) .or. method(1) == 0) return
        call block%compiled%finish_pack(beam, method(1), pack, doubtful)
        sound = fits .and. .not. doubtful
    end subroutine solve

    !> Break a number of a lane
    subroutine break_lane(seed, beam, kind, l, pack, is_broken)
        integer(int64), intent(inout) :: seed
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: kind, l
        type(pack_type), intent(inout) :: pack
        !> Is there such a number
        logical, intent(out) :: is_broken
        real(wp) :: m, r
        integer :: i, k

        i = int((beam%n + 1)*random(seed))
        k = beam%place(1 + int(size(beam%place)*random(seed)))
        m = share*max(maxval(abs(pack%ml(l, :))), maxval(abs(pack%mr(l, :))))
        r = share*maxval(abs(pack%reaction(l, beam%place)))
        is_broken = .true.
        select case (kind)
        case (reaction)
            is_broken = r > 0.0_wp
            pack%reaction(l, k) = pack%reaction(l, k) + merge(r, -r, random(seed) < 0.5_wp)
        case (deflection)
            pack%w(l, i) = pack%w(l, i) + share*maxval(abs(pack%w(l, :)))
        case (moment)
            is_broken = m > 0.0_wp
            pack%ml(l, i) = pack%ml(l, i) + m
            pack%mr(l, i) = pack%mr(l, i) + m
        case (left_moment)
            is_broken = m > 0.0_wp
            pack%ml(l, i) = pack%ml(l, i) + m
        case (right_moment)
            is_broken = m > 0.0_wp
            pack%mr(l, i) = pack%mr(l, i) - m
        case default
            pack%closed(l, k) = 1.0_wp - pack%closed(l, k)
            ! A support without stiffness is as good closed as open
            is_broken = pack%rigid(l, k) + pack%stiffness(l, k) > 0.0_wp
        end select
    end subroutine break_lane

end program test_lane_audit
