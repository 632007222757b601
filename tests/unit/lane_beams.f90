!> Beams and cases drawn at random for the tests of cases side by side, and the bits of what comes of them
module lane_beams
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_search, only: rule_block
    use gapbeam_error, only: error_type
    use gapbeam_scene, only: section_type, span_type, support_type, uniform_load, point_force, point_couple, gapbeam_both, &
        gapbeam_infinity
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble, only: assemble_model
    implicit none
    private
    public :: make_beam, draw_cases, random, bits
    public :: numbers_of, solutions_of

contains

    !> The numbers of cases, searched for block by block
    function numbers_of(factors, values, spans) result(numbers)
        real(wp), intent(in), contiguous, target :: factors(:, :)
        !> Of no support and no span: those of the beam
        real(wp), intent(in), contiguous, target :: values(:, :, :), spans(:, :, :)
        type(case_numbers_type) :: numbers

        numbers%factors => factors
        if (size(values, 2) > 0) numbers%supports => values
        if (size(spans, 2) > 0) numbers%spans => spans
        numbers%rule = rule_block
    end function numbers_of

    !> Columns for the solutions of cases
    function solutions_of(closed, w, ml, mr, reaction, solves, status) result(solutions)
        integer, intent(in), contiguous, target :: closed(:, :), solves(:), status(:)
        real(wp), intent(in), contiguous, target :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        type(case_solutions_type) :: solutions

        solutions%closed => closed
        solutions%w => w
        solutions%ml => ml
        solutions%mr => mr
        solutions%reaction => reaction
        solutions%solves => solves
        solutions%status => status
    end function solutions_of

    !> A beam on supports of all kinds with four loads
    subroutine make_beam(seed, spans, whole, lowered)
        !> As for random
        integer(int64), intent(inout) :: seed
        integer, intent(in) :: spans
        !> With a support at every node and no hinge; otherwise now and then one is missing, and there may be a hinge
        logical, intent(in) :: whole
        !> The beam, ready to be solved
        type(assembled_type), intent(out) :: lowered
        type(error_type), allocatable :: error
        type(support_type), allocatable :: supports(:)
        real(wp) :: x, turns
        integer :: i, k, m

        associate (model => lowered%model)
            x = random(seed)
            k = merge(1, 0, spans > 3 .and. x < 0.3_wp .and. .not. whole)
            allocate (model%spans(spans), model%hinges(k), model%sections(merge(1, 0, modulo(spans, 3) == 0)), &
                      model%law(0), model%foundations(0), model%ground(0), model%ground_law(0), supports(2*spans + 2))
            do i = 1, spans
                model%spans(i) = span_type(2.0_wp + 4*random(seed), EI=10.0_wp**(3 + 2*random(seed)))
            end do
            m = 0
            turns = random(seed)
            do i = 0, spans
                x = random(seed)
                if (x < 0.15_wp .and. i > 0 .and. .not. whole) cycle
                m = m + 1
                supports(m) = support_type(node=i, settlement=0.01_wp*(random(seed) - 0.5_wp))
                if (random(seed) < 0.4_wp) supports(m)%stiffness = 10.0_wp**(1 + 4*random(seed))
                if (x > 0.4_wp) then
                    supports(m)%side = merge(1, -1, x < 0.85_wp)
                    if (random(seed) < 0.6_wp) supports(m)%gap = 0.01_wp*(random(seed) - 0.2_wp)
                end if
                ! Some beams are restrained at their ends, some at any support
                if (turns < merge(0.4_wp, 0.1_wp, i == 0 .or. i == spans) .and. random(seed) < 0.6_wp) then
                    supports(m)%rotation = 10.0_wp**(2 + 3*random(seed))
                    if (random(seed) < 0.6_wp) supports(m)%rotation = gapbeam_infinity
                    if (random(seed) < 0.1_wp .and. supports(m)%side == gapbeam_both) supports(m)%stiffness = 0.0_wp
                end if
                if (random(seed) < 0.7_wp) cycle
                ! With another one beside it that stops the beam the other way, or downwards
                m = m + 1
                supports(m) = support_type(node=i, side=-1, settlement=supports(m - 1)%settlement, &
                                           gap=0.002_wp + 0.01_wp*random(seed), stiffness=10.0_wp**(1 + 4*random(seed)))
                if (x > 0.4_wp) supports(m)%side = -supports(m - 1)%side
                if (x > 0.4_wp .and. random(seed) < 0.4_wp) supports(m)%stiffness = gapbeam_infinity
            end do
            allocate (model%supports(m), model%loads(4))
            model%supports(:) = supports(:m)
            x = sum(model%spans%length)
            if (size(model%sections) > 0) model%sections(1) = section_type(0.3_wp*x, 0.6_wp*x, EI=10.0_wp**(3 + 2*random(seed)))
            if (k > 0) model%hinges(:) = x*(0.2_wp + 0.6_wp*random(seed))
            model%loads(1) = uniform_load(10.0_wp, 0.0_wp, x)
            model%loads(2) = uniform_load(20*random(seed), 0.3_wp*x*random(seed), x*(0.5_wp + 0.5_wp*random(seed)))
            model%loads(3) = point_force(40*random(seed), x=x*random(seed))
            model%loads(4) = point_force(40*random(seed), node=int((spans + 1)*random(seed)))
            if (random(seed) < 0.3_wp) model%loads(4) = point_couple(20*random(seed), node=int((spans + 1)*random(seed)))
        end associate
        call assemble_model(lowered, error)
        if (allocated(error)) error stop "no beam"
    end subroutine make_beam

    !> Cases of it
    subroutine draw_cases(seed, lowered, cases, varied, with_own_spans, factors, values, spans)
        !> As for random
        integer(int64), intent(inout) :: seed
        type(assembled_type), intent(in) :: lowered
        integer, intent(in) :: cases
        !> With supports, with stiffnesses of spans that differ from case to case
        logical, intent(in) :: varied, with_own_spans
        !> Factors, shape (loads, cases); settlements, gaps and stiffnesses, shape (3, supports or 0, cases); EI and GA, shape
        !> (2, spans or 0, cases)
        real(wp), allocatable, intent(out) :: factors(:, :), values(:, :, :), spans(:, :, :)
        integer :: i, k

        associate (given => lowered%model%supports)
            allocate (factors(size(lowered%model%loads), cases))
            allocate (values(3, merge(size(given), 0, varied), cases))
            allocate (spans(2, merge(size(lowered%model%spans), 0, with_own_spans), cases))
            do i = 1, cases
                do k = 1, size(factors, 1)
                    factors(k, i) = 3*random(seed) - 1
                end do
                do k = 1, size(values, 2)
                    values(:, k, i) = [given(k)%settlement + 0.01_wp*(random(seed) - 0.5_wp), given(k)%gap, given(k)%stiffness]
                    if (given(k)%side /= gapbeam_both) values(2, k, i) = 0.01_wp*(random(seed) - 0.2_wp)
                    if (random(seed) < 0.2_wp) values(3, k, i) = 10.0_wp**(1 + 4*random(seed))
                    if (random(seed) < 0.1_wp) values(3, k, i) = gapbeam_infinity
                    if (k == 1) cycle
                    if (given(k)%node /= given(k - 1)%node) cycle
                    ! With room between rigid ones
                    values(:2, k, i) = [values(1, k - 1, i), 0.002_wp + 0.01_wp*random(seed)]
                    if (given(k - 1)%side == gapbeam_both) values(3, k, i) = given(k)%stiffness
                end do
                do k = 1, size(spans, 2)
                    spans(:, k, i) = [10.0_wp**(2 + 4*random(seed)), gapbeam_infinity]
                    if (random(seed) < 0.2_wp) spans(2, k, i) = 10.0_wp**(2 + 4*random(seed))
                end do
            end do
        end associate
    end subroutine draw_cases

    !> A reproducible number from 0 to 1 (Marsaglia 2003); a million cases use up the sequence of draw of module beams
    function random(seed) result(x)
        !> Not 0; the next one out
        integer(int64), intent(inout) :: seed
        real(wp) :: x

        seed = ieor(seed, shiftl(seed, 13))
        seed = ieor(seed, shiftr(seed, 7))
        seed = ieor(seed, shiftl(seed, 17))
        x = real(shiftr(seed, 11), wp)*2.0_wp**(-53)
    end function random

    !> The bits of a number: zeros of both signs are two
    elemental function bits(number)
        real(wp), intent(in) :: number
        integer(int64) :: bits

        bits = transfer(number, bits)
    end function bits

end module lane_beams
