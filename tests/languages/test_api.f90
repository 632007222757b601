!> The Fortran interface, by the module gapbeam alone: what is refused, closed forms, other loads, results and their beams
program test_api
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, support_type, load_type, foundation_type, prepared_type, options_type, result_type, &
        certificate_type, event_type, error_type, point_force, point_couple, uniform_load, linear_load, imposed_curvature, &
        axial_force, axial_uniform_load, support_movement, support_rotation, temperature_load, prepare_model, replace_loads, &
        solve_beam, follow_load, get_supports, get_fields, get_extremes, &
        get_motion, get_certificate, count_supports, count_nodes, combine_loads, gapbeam_infinity, gapbeam_both, gapbeam_below, &
        gapbeam_above, gapbeam_axial, gapbeam_dead, gapbeam_closed, gapbeam_bilateral, gapbeam_rule_single, gapbeam_solved, &
        gapbeam_no_equilibrium, gapbeam_bad_input, gapbeam_not_finite, gapbeam_not_prepared, gapbeam_indeterminate, &
        gapbeam_status_message, law_point_type, history_type, follow_history, solve_on_path, get_released_energy, gapbeam_plastic, &
        gapbeam_branch, gapbeam_open, gapbeam_yields, gapbeam_breaks, gapbeam_unloads, gapbeam_opens, gapbeam_limit_stop, &
        gapbeam_limit_jump, &
        gapbeam_law_tanh, gapbeam_limit_follow, gapbeam_arrived, gapbeam_limit_point, gapbeam_path_ended, gapbeam_mechanism
    implicit none
    integer :: status

    call refused_models()
    call refused_calls()
    call gap_closes()
    call every_load()
    call hinge_and_spring()
    call clearance()
    call slides_away()
    call extreme_units()
    call hardening_law()
    call brittle_law()
    call smooth_law()
    call plastic_law()
    call plastic_law_under_tension()
    call mechanism_at_limit()
    call turned()
    call jacked_up()
    call warm()
    call combinations()
    call errors_within_bounds(1.0e-3_wp)
    call errors_within_bounds(1.0e-7_wp)
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two spans of 2 with EI = 100, a support from below with a gap in the middle, a uniform load of 3
    subroutine two_spans(model)
        type(model_type), intent(out) :: model

        model%spans = [span_type(2.0_wp, EI=100.0_wp), span_type(2.0_wp, EI=100.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below, gap=0.001_wp), support_type(x=4.0_wp)]
        model%loads = [uniform_load(3.0_wp, from=0.0_wp, to=4.0_wp)]
    end subroutine two_spans

    !> A model must be refused, with the array, the entry, and a word of the message
    subroutine refuse(model, table, entry, word)
        type(model_type), intent(in) :: model
        integer, intent(in) :: table, entry
        character(len=*), intent(in) :: word
        type(prepared_type) :: beam
        type(error_type), allocatable :: error

        call prepare_model(model, beam, error)
        call check(allocated(error), "refused: "//word)
        if (.not. allocated(error)) return
        call check(error%code == gapbeam_bad_input .and. error%table == table .and. error%entry == entry &
                   .and. index(error%message, word) > 0, error%message)
        call check(count_supports(beam) == 0, "not prepared then")
    end subroutine refuse

    !> A model whose numbers leave the range of double precision must be refused, with a word of the message
    subroutine refuse_range(model, word)
        type(model_type), intent(in) :: model
        character(len=*), intent(in) :: word
        type(prepared_type) :: beam
        type(error_type), allocatable :: error

        call prepare_model(model, beam, error)
        call check(allocated(error), "refused: "//word)
        if (.not. allocated(error)) return
        call check(error%code == gapbeam_not_finite .and. index(error%message, word) > 0, error%message)
        call check(count_supports(beam) == 0, "not prepared then")
    end subroutine refuse_range

    !> Everything that prepare_model refuses
    subroutine refused_models()
        type(model_type) :: model, empty

        call refuse(empty, 1, 0, "no span")
        call two_spans(model)
        model%spans(2)%length = -1.0_wp
        call refuse(model, 1, 2, "length")
        call two_spans(model)
        model%spans(1)%EI = 0.0_wp
        call refuse(model, 1, 1, "EI")
        call two_spans(model)
        model%spans(2)%EI = 1e-310_wp
        call refuse_range(model, "EI = ")
        call two_spans(model)
        model%spans(2)%length = 1e-16_wp
        call refuse(model, 1, 2, "lost in rounding")
        call two_spans(model)
        model%spans%length = 1e308_wp
        call refuse(model, 1, 2, "too long")
        call two_spans(model)
        model%hinges = [1.0_wp, 1.0_wp]
        call refuse(model, 2, 2, "hinge at this place")
        model%hinges = [0.0_wp]
        call refuse(model, 2, 1, "end of the beam")
        model%hinges = [4.5_wp]
        call refuse(model, 2, 1, "outside")
        call two_spans(model)
        model%supports(2)%x = 4.5_wp
        model%supports(2)%node = -1
        call refuse(model, 3, 2, "outside")
        model%supports(2) = support_type()
        call refuse(model, 3, 2, "give node or x")
        model%supports(2) = support_type(node=3)
        call refuse(model, 3, 2, "expected 0 to 2")
        model%supports(2) = support_type(node=1, side=2)
        call refuse(model, 3, 2, "side")
        model%supports(2) = support_type(node=1, stiffness=-1.0_wp)
        call refuse(model, 3, 2, "stiffness")
        model%supports(2) = support_type(node=1, gap=0.1_wp)
        call refuse(model, 3, 2, "gap")
        model%supports(2) = support_type(node=1, settlement=gapbeam_infinity)
        call refuse(model, 3, 2, "settlement")
        model%supports(2) = support_type(node=1, direction=gapbeam_axial, friction=0.1_wp)
        call refuse(model, 3, 2, "friction")
        model%supports(2) = support_type(node=0)
        call refuse(model, 3, 2, "support 1")
        model%supports(2) = support_type(node=1, rotation=gapbeam_infinity)
        model%hinges = [2.0_wp]
        call refuse(model, 3, 2, "hinge")
        call two_spans(model)
        model%supports(1:2) = [support_type(node=1, side=gapbeam_below, gap=0.01_wp), &
                               support_type(node=1, side=gapbeam_above, gap=-0.02_wp)]
        model%supports(1)%gap = -0.03_wp
        call refuse(model, 3, 1, "no room")
        call two_spans(model)
        model%loads = [load_type(kind=99, x=1.0_wp)]
        call refuse(model, 4, 1, "kind")
        model%loads = [point_force(1.0_wp, x=1.0_wp), point_force(1.0_wp, x=1.0_wp, case=4)]
        call refuse(model, 4, 2, "case")
        model%loads = [point_force(gapbeam_infinity, x=1.0_wp)]
        call refuse(model, 4, 1, "value")
        model%loads = [uniform_load(1.0_wp, from=2.0_wp, to=1.0_wp)]
        call refuse(model, 4, 1, "no length")
        model%loads = [axial_force(1.0_wp, node=1)]
        call refuse(model, 4, 1, "axial")
        model%loads = [point_couple(1.0_wp, x=1.0_wp)]
        model%hinges = [1.0_wp]
        call refuse(model, 4, 1, "hinge")
    end subroutine refused_models

    !> Calls in a wrong order, arrays of a wrong size, results of another beam
    subroutine refused_calls()
        type(model_type) :: model
        type(prepared_type) :: beam, other, none
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        real(wp) :: r(3), w(3), opening(3), couple(3), short(2), fields(6, 1), x(3)
        integer :: condition(3)

        call two_spans(model)
        call solve_beam(none, 1.0_wp, options_type(), result, error)
        call check(error%code == gapbeam_not_prepared, "solve: not prepared")
        call replace_loads(none, model%loads, error)
        call check(error%code == gapbeam_not_prepared, "replace_loads: not prepared")
        call prepare_model(model, beam, error)
        call check(.not. allocated(error) .and. count_supports(beam) == 3 .and. count_nodes(beam) == 3, "prepared")
        call get_supports(beam, result, r, w, opening, couple, condition, error)
        call check(error%code == gapbeam_not_prepared, "nothing solved")
        call solve_beam(beam, gapbeam_infinity, options_type(), result, error)
        call check(error%code == gapbeam_bad_input .and. result%status == -1, "infinite factor")
        call solve_beam(beam, 1.0_wp, options_type(7), result, error)
        call check(error%code == gapbeam_bad_input, "no such rule")
        call follow_load(beam, -1.0_wp, options_type(), events, result, error)
        call check(error%code == gapbeam_bad_input .and. .not. allocated(events), "follow backwards")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error), "solved")
        call get_supports(beam, result, short, w, opening, couple, condition, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "2 entries, expected 3") > 0, "array too short")
        call get_fields(beam, result, [1.0_wp, 2.0_wp], fields, error)
        call check(error%code == gapbeam_bad_input, "one column for two places")
        call get_motion(beam, result, x, r, error)
        call check(error%code == gapbeam_not_prepared, "no motion")
        model%loads = [point_force(1.0_wp, x=1.0_wp)]
        call prepare_model(model, other, error)
        call get_fields(other, result, [1.0_wp], fields, error)
        call check(error%code == gapbeam_not_prepared .and. index(error%message, "another beam") > 0, "result of another beam")
        call two_spans(model)
        call prepare_model(model, other, error)
        call get_fields(other, result, [1.0_wp], fields, error)
        call check(.not. allocated(error), "the same beam, prepared twice")
        model%supports(2)%gap = 2*model%supports(2)%gap
        call prepare_model(model, other, error)
        call get_fields(other, result, [1.0_wp], fields, error)
        call check(error%code == gapbeam_not_prepared, "result of a beam of the same sizes")
        call check(gapbeam_status_message(gapbeam_solved) == "solved", "a status in words")
    end subroutine refused_calls

    !> The gap closes at 5 q L**4/384 EI
    subroutine gap_closes()
        type(model_type) :: model
        type(prepared_type) :: beam, copy
        type(result_type) :: result, again
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        type(certificate_type) :: certificate
        real(wp), parameter :: free = 5*3*256.0_wp/(384*100), flexibility = 64/(48*100.0_wp)
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3), value(2, 6), place(2, 6), fields(6, 2), first(3)
        integer :: condition(3), rule
        logical :: undecided(3)

        call two_spans(model)
        call prepare_model(model, beam, error)
        do rule = 0, gapbeam_rule_single
            call solve_beam(beam, 1.0_wp, options_type(rule), result, error)
            call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
            call check_close(reaction(2), (free - 0.001_wp)/flexibility, "reaction past the gap")
        end do
        call check_close(sum(reaction), 12.0_wp, "equilibrium")
        call check(all(condition == [gapbeam_bilateral, gapbeam_closed, gapbeam_bilateral]), "conditions")
        call get_extremes(beam, result, value, place, error)
        call check_close(value(1, 4), 6 - reaction(1), "largest shear")
        call check_close(place(1, 4), 2.0_wp, "right of the support")
        call get_fields(beam, result, [1.0_wp, 2.0_wp], fields, error, from_left=.true.)
        call check_close(fields(4, 2), reaction(1) - 6, "shear left of it")
        call get_certificate(beam, result, certificate, undecided, error)
        call check(certificate%known .and. certificate%reaction_bound < 1e-11_wp .and. .not. any(undecided), "certificate")
        call follow_load(beam, 1.0_wp, options_type(), events, again, error)
        call check(size(events) == 1, "one event")
        call check_close(events(1)%factor, 0.001_wp/free, "its factor")
        call check(events(1)%support == 2 .and. events(1)%state == gapbeam_closed, "support 2 closes")
        first = reaction
        copy = beam
        call replace_loads(beam, [uniform_load(6.0_wp, 0.0_wp, 4.0_wp, case=gapbeam_dead)], error)
        call solve_beam(beam, 0.5_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(sum(reaction), 24.0_wp, "twice the load, dead")
        call solve_beam(copy, 1.0_wp, options_type(), result, error)
        call get_supports(copy, result, reaction, deflection, opening, couple, condition, error)
        call check(all(abs(reaction - first) <= 0), "a copy of a prepared beam is one of its own")
    end subroutine gap_closes

    !> A cantilever of length 3, EI = 50, GA = 20, EA = 40 under each load: deflection of its tip
    subroutine every_load()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(load_type) :: loads(6)
        real(wp) :: expected(6), fields(6, 1)
        integer :: k

        loads = [point_force(2.0_wp, x=3.0_wp), point_couple(5.0_wp, node=1), uniform_load(4.0_wp, 0.0_wp, 3.0_wp), &
                 linear_load(0.0_wp, 6.0_wp, 0.0_wp, 3.0_wp), imposed_curvature(0.01_wp, 0.0_wp, 3.0_wp), &
                 axial_force(8.0_wp, node=1)]
        expected = [2*27/150.0_wp + 6/20.0_wp, 45/100.0_wp, 4*81/400.0_wp + 36/40.0_wp, 11*486/6000.0_wp + 54/60.0_wp, &
                    0.045_wp, 24/40.0_wp]
        model%spans = [span_type(3.0_wp, EI=50.0_wp, GA=20.0_wp, EA=40.0_wp)]
        model%supports = [support_type(node=0, rotation=gapbeam_infinity), support_type(node=0, direction=gapbeam_axial)]
        do k = 1, 6
            model%loads = [loads(k)]
            call prepare_model(model, beam, error)
            call solve_beam(beam, 1.0_wp, options_type(), result, error)
            call get_fields(beam, result, [3.0_wp], fields, error)
            call check_close(fields(merge(6, 1, k == 6), 1), expected(k), "tip of a cantilever")
        end do
    end subroutine every_load

    !> A Gerber beam whose suspended end rests on a spring: statics give the reactions
    subroutine hinge_and_spring()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: reaction(2), deflection(2), opening(2), couple(2)
        integer :: condition(2)

        model%spans = [span_type(6.0_wp, EI=10.0_wp)]
        model%hinges = [2.0_wp]
        model%supports = [support_type(x=0.0_wp, rotation=gapbeam_infinity), support_type(x=6.0_wp, stiffness=5.0_wp)]
        model%loads = [point_force(8.0_wp, x=4.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction, [4.0_wp, 4.0_wp], "half each")
        call check_close(deflection(2), 0.8_wp, "the spring gives")
        call check_close(couple(1), -8.0_wp, "the clamp holds the cantilever")
    end subroutine hinge_and_spring

    !> Clearance on both sides, lack of fit and settlement: a rigid plank between stops
    subroutine clearance()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: reaction(4), deflection(4), opening(4), couple(4)
        integer :: condition(4)

        model%spans = [span_type(4.0_wp, EI=gapbeam_infinity)]
        model%supports = [support_type(node=0), support_type(node=1, stiffness=10.0_wp), &
                          support_type(x=2.0_wp, side=gapbeam_below, gap=0.05_wp, settlement=0.01_wp), &
                          support_type(x=2.0_wp, side=gapbeam_above, gap=0.02_wp)]
        model%loads = [point_force(4.0_wp, node=1)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(deflection(2:3), [0.12_wp, 0.06_wp], "down to the lower stop")
        call check_close(reaction, [-2.8_wp, 1.2_wp, 5.6_wp, 0.0_wp], "its reactions")
        call check_close(opening(4), 0.08_wp, "way to the upper stop")
        model%supports = [support_type(node=0), support_type(x=2.0_wp), support_type(node=1)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(error%code == gapbeam_indeterminate, "a rigid beam over three rigid supports")
    end subroutine clearance

    !> Nothing holds the beam along its axis, or not stiffly enough to tell
    subroutine slides_away()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: x(2), motion(2)

        model%spans = [span_type(4.0_wp, EI=1.0_wp, EA=1.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1), &
                          support_type(node=0, direction=gapbeam_axial, stiffness=0.0_wp)]
        model%loads = [axial_force(1.0_wp, node=1)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(result%status == gapbeam_no_equilibrium .and. result%slides, "slides")
        call get_motion(beam, result, x, motion, error)
        call check(.not. allocated(error) .and. all(abs(motion) <= 0), "and does not move across")
    end subroutine slides_away

    !> The same beam in units far from 1 has the same digits
    subroutine extreme_units()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: usual(3), reaction(3), deflection(3), opening(3), couple(3), value(2, 6), place(2, 6), usual_value(2, 6)
        real(wp) :: fields(6, 1)
        integer :: condition(3), k
        integer, parameter :: length(3) = [0, 130, -90], force(3) = [0, -240, 300]

        do k = 1, 3
            call two_spans(model)
            model%spans%length = scale(model%spans%length, length(k))
            model%spans%EI = scale(model%spans%EI, force(k) + 2*length(k))
            model%supports(2)%gap = scale(model%supports(2)%gap, length(k))
            model%supports(3) = support_type(node=2, stiffness=scale(7.0_wp, force(k) - length(k)))
            model%loads = [linear_load(scale(3.0_wp, force(k) - length(k)), scale(2.0_wp, force(k) - length(k)), &
                                       0.0_wp, scale(4.0_wp, length(k))), &
                           point_couple(scale(1.5_wp, force(k) + length(k)), x=scale(1.0_wp, length(k)))]
            call prepare_model(model, beam, error)
            call solve_beam(beam, 1.0_wp, options_type(), result, error)
            call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
            call get_extremes(beam, result, value, place, error)
            call get_fields(beam, result, [scale(1.25_wp, length(k))], fields, error)
            call check(abs(scale(fields(3, 1), -force(k) - length(k))) > 0.1_wp, "a moment in its units")
            reaction = scale(reaction, -force(k))
            value(:, 1) = scale(value(:, 1), -length(k))
            value(:, 3) = scale(value(:, 3), -force(k) - length(k))
            if (k == 1) then
                usual = reaction
                usual_value = value
            end if
            call check_close(reaction, usual, "reactions in other units", relative=4*epsilon(1.0_wp))
            call check_close(value(:, 1), usual_value(:, 1), "deflections in other units", relative=4*epsilon(1.0_wp))
            call check_close(value(:, 3), usual_value(:, 3), "moments in other units", relative=4*epsilon(1.0_wp))
        end do
    end subroutine extreme_units

    !> A simple beam of stiffness 1 in the middle over a support with a law from below, a load of 2.2 on it
    subroutine over_law(points, model)
        !> Displacements and forces, shape (2, n)
        real(wp), intent(in) :: points(:, :)
        type(model_type), intent(out) :: model
        integer :: i

        model%spans = [span_type(2.0_wp, EI=4/3.0_wp), span_type(2.0_wp, EI=4/3.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below), support_type(node=2)]
        model%law = [(law_point_type(2, points(1, i), points(2, i)), i=1, size(points, 2))]
        model%loads = [point_force(2.2_wp, node=1)]
    end subroutine over_law

    !> A law that only hardens is solved as any beam, with its piece as condition
    subroutine hardening_law()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: condition(3)

        call over_law(reshape([0.1_wp, 1.0_wp, 1.1_wp, 5.0_wp], [2, 2]), model)
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(deflection(2), 0.32_wp, "on the second piece")
        call check_close(reaction(2), 1.88_wp, "its force")
        call check(condition(2) == gapbeam_branch + 2 .and. condition(1) == gapbeam_bilateral, "its number")
        call follow_load(beam, 1.0_wp, options_type(), events, result, error)
        call check(size(events) == 1, "one event")
        call check_close(events(1)%factor, 0.5_wp, "its factor")
        call check(events(1)%state == gapbeam_branch + 2 .and. events(1)%change == gapbeam_yields, "the support yields")
        model%law(2)%displacement = 0.05_wp
        call refuse(model, 3, 2, "go back")
        model%law(2)%displacement = 1.1_wp
        model%law(2)%support = 4
        call refuse(model, 3, 1, "does not exist")
        model%law(2)%support = 2
        model%supports(2)%side = gapbeam_both
        model%supports(2)%gap = -0.01_wp
        call refuse(model, 3, 2, "gap: expected 0 or more")
    end subroutine hardening_law

    !> A law by name that is a curve: its force is the load less what the beam takes, and it closes where its gap does
    subroutine smooth_law()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        type(history_type) :: history
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: condition(3)

        call two_spans(model)
        model%supports(2) = support_type(node=1, side=gapbeam_below, law=gapbeam_law_tanh, parameter=[900.0_wp, 4.0_wp, 0.0_wp])
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), 4*tanh(900*deflection(2)/4), "the force is that of the curve")
        call check_close(deflection(2), 5*3*4.0_wp**4/(384*100) - reaction(2)*4.0_wp**3/(48*100), "and of the beam")
        call check(condition(2) == gapbeam_branch + 1, "a curve is one piece")
        call follow_load(beam, 1.0_wp, options_type(), events, result, error)
        call check(result%status == 0 .and. size(events) == 0, "nothing happens to it")
        call check_close(result%factor, 1.0_wp, "to the end of the load")
        model%supports(2)%gap = 0.01_wp
        call prepare_model(model, beam, error)
        call follow_load(beam, 1.0_wp, options_type(), events, result, error)
        call check(size(events) == 1, "it closes")
        call check(events(1)%support == 2 .and. events(1)%state == gapbeam_branch + 1, "and has one piece then")
        call check_close(events(1)%factor, 0.01_wp/(5*3*4.0_wp**4/(384*100)), "where the beam comes to it")
        call follow_history(beam, [1.0_wp, 0.5_wp], 0, history, error)
        call check(size(history%stretches) == 3 .and. size(history%events) == 1, "it has a history")
        call check(all(history%stretches%exact), "on the curve")
        call check_close(history%events(1)%factor, events(1)%factor, "with the same event")
        call solve_on_path(beam, history, 0.7_wp, result, error, 3)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), 4*tanh(900*(deflection(2) - 0.01_wp)/4), "and its states there")
        model%supports(2)%gap = 0.0_wp
        model%supports(2)%parameter(2) = 0.0_wp
        call refuse(model, 3, 2, "law.limit: expected a finite number above 0, got 0")
        model%supports(2)%law = 6
        call refuse(model, 3, 2, "law: expected 0 to 5, 7 or 8, got 6")
        model%supports(2)%law = gapbeam_law_tanh
        model%law = [law_point_type(2, 0.1_wp, 1.0_wp)]
        call refuse(model, 3, 2, "by name and by points")
    end subroutine smooth_law

    !> A support that breaks: the load stops, the beam falls on to a state beyond, or the path is followed
    subroutine brittle_law()
        type(model_type) :: model
        type(prepared_type) :: beam, other
        type(result_type) :: result
        type(history_type) :: history, none
        type(certificate_type) :: certificate
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3), energy
        integer :: condition(3)
        logical :: undecided(3)

        call over_law(reshape([0.1_wp, 1.0_wp, 0.1_wp, 0.0_wp, 1.0_wp, 0.0_wp], [2, 3]), model)
        call prepare_model(model, beam, error)
        call solve_beam(beam, 0.1_wp, options_type(), result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "follow_history") > 0, "solve_beam names the way")
        call follow_load(beam, 0.1_wp, options_type(), events, result, error)
        call check(error%code == gapbeam_bad_input, "and so does follow_load")
        call solve_on_path(beam, none, 0.1_wp, result, error)
        call check(error%code == gapbeam_not_prepared, "no history")
        call follow_history(beam, [1.0_wp], 3, history, error)
        call check(error%code == gapbeam_bad_input, "no such way at limits")
        call follow_history(beam, [1.0_wp, gapbeam_infinity], gapbeam_limit_stop, history, error)
        call check(error%code == gapbeam_bad_input, "no finite factor")
        call follow_history(beam, [real(wp) ::], gapbeam_limit_stop, history, error)
        call check(error%code == gapbeam_bad_input, "no factor")

        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error) .and. history%ending == gapbeam_path_ended, "the load stops")
        call check(size(history%limits) == 1, "at one limit")
        call check_close(history%limits(1)%factor, 0.5_wp, "its factor")
        call check(history%limits(1)%kind == gapbeam_limit_point .and. history%limits(1)%stretch == 1, "its kind and place")
        call check(history%events(1)%support == 2 .and. history%events(1)%change == gapbeam_breaks &
                   .and. history%events(1)%state == gapbeam_branch + 2, "the support breaks")
        call check(history%stretches(1)%stable .and. .not. history%stretches(2)%stable, "before it the beam is stable")
        call solve_on_path(beam, history, 0.25_wp, result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), 0.5_wp, "half way to the limit")
        call check(condition(2) == gapbeam_branch + 1, "on the first piece")
        call get_certificate(beam, result, certificate, undecided, error)
        call check(.not. allocated(error) .and. certificate%known .and. certificate%reaction_bound < 1e-12_wp, "certified")
        call solve_on_path(beam, history, 0.75_wp, result, error)
        call check(error%code == gapbeam_bad_input, "not beyond it")
        call solve_on_path(beam, history, 0.5_wp, result, error, stretch=history%limits(1)%landing)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(deflection(2), 1.1_wp, "the landing")
        call get_released_energy(beam, history, 1, energy, error)
        call check_close(energy, 0.5_wp, "the energy of the beam alone, of stiffness 1, that it moves by 1")
        call get_released_energy(beam, history, 2, energy, error)
        call check(error%code == gapbeam_bad_input .and. .not. abs(energy) > 0.0_wp, "there is one limit")
        call solve_on_path(beam, history, 0.5_wp, result, error, stretch=99)
        call check(error%code == gapbeam_bad_input, "no such stretch")

        call follow_history(beam, [1.0_wp], gapbeam_limit_jump, history, error)
        call check(history%ending == gapbeam_arrived, "after a jump it goes on")
        call solve_on_path(beam, history, 1.0_wp, result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(deflection(2), 2.2_wp, "to the end")
        call check(condition(2) == gapbeam_branch + 3, "without the support")
        call follow_history(beam, [1.0_wp], gapbeam_limit_follow, history, error)
        call check(history%stretches(2)%direction == -1 .and. .not. any(history%stretches%skipped), "the load falls and rises")
        model%loads(1)%value = 2.3_wp
        call prepare_model(model, other, error)
        call solve_on_path(other, history, 0.25_wp, result, error)
        call check(error%code == gapbeam_not_prepared, "the history of another beam")
    end subroutine brittle_law

    !> A support that keeps a set: loaded, and unloaded
    subroutine plastic_law()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(history_type) :: history
        type(certificate_type) :: certificate
        type(error_type), allocatable :: error
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: condition(3), k
        logical :: undecided(3)

        call over_law(reshape([0.1_wp, 1.0_wp, 1.0_wp, 1.0_wp], [2, 2]), model)
        model%supports(2)%unloading = gapbeam_plastic
        call prepare_model(model, beam, error)
        call follow_history(beam, [1.0_wp, 0.0_wp], gapbeam_limit_stop, history, error)
        call check(history%ending == gapbeam_arrived .and. size(history%limits) == 0, "there and back")
        call check(all(history%events%change == [gapbeam_yields, gapbeam_unloads, gapbeam_opens]), "yields, unloads, opens")
        call check_close(history%events%factor, [0.5_wp, 1.0_wp, 0.5_wp], "at these factors")
        k = history%events(2)%stretch
        call check(history%stretches(k)%leg == 2 .and. history%stretches(k)%direction == -1, "on the way back")
        call solve_on_path(beam, history, 0.75_wp, result, error, stretch=k)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), 0.5_wp, "along the first slope")
        call check_close(deflection(2), 1.15_wp, "from where it was")
        call get_certificate(beam, result, certificate, undecided, error)
        call check(.not. allocated(error) .and. certificate%complementarity < 1e-14_wp, "certified with its set")
        call solve_on_path(beam, history, 0.25_wp, result, error, stretch=size(history%stretches))
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(opening(2), 0.55_wp, "a gap is left")
        call check(condition(2) == gapbeam_open, "it is open")
        call solve_on_path(beam, history, 0.25_wp, result, error, stretch=1)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), 0.5_wp, "on the way there it had none")
    end subroutine plastic_law

    !> The same beam as a tensioned string that bends: c = (L/2 - tanh(v L/2)/v)/(2 N), v = sqrt(N/EI), in place of 1
    subroutine plastic_law_under_tension()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(history_type) :: history
        type(error_type), allocatable :: error
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        real(wp), parameter :: c = (2 - tanh(3.0_wp)/1.5_wp)/6
        integer :: condition(3)

        call over_law(reshape([0.1_wp, 1.0_wp, 1.0_wp, 1.0_wp], [2, 2]), model)
        model%supports(2)%unloading = gapbeam_plastic
        model%spans%N = 3.0_wp
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "follow_history") > 0, "a path is needed")
        call follow_history(beam, [1.0_wp, 0.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error) .and. all(history%events%change == [gapbeam_yields, gapbeam_unloads, gapbeam_opens]), &
                   "yields, unloads, opens")
        call check_close(history%events%factor, [(1 + 0.1_wp/c)/2.2_wp, 1.0_wp, (1.2_wp - 0.1_wp/c)/2.2_wp], "at these factors")
        call solve_on_path(beam, history, 0.0_wp, result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(opening(2), 1.2_wp*c - 0.1_wp, "a gap is left")
        call solve_on_path(beam, history, 0.75_wp, result, error, stretch=history%events(2)%stretch)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(2), (1 + 4.5_wp*c)/(1 + 10*c), "along the first slope, from where it was")
        model%foundations = [foundation_type(from=0.0_wp, to=1.0_wp, side=gapbeam_below, k=1.0_wp)]
        call prepare_model(model, beam, error)
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "both ways") > 0, "ground that changes on the way")
    end subroutine plastic_law_under_tension

    !> A support that is jacked up by twice what the load would lower the beam there: it closes at half of that
    subroutine jacked_up()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(history_type) :: history
        type(error_type), allocatable :: error
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: condition(3)
        real(wp), parameter :: sag = 5*3.0_wp*4.0_wp**4/(384*100)

        call two_spans(model)
        model%supports(2)%gap = 2*sag
        model%loads = [uniform_load(3.0_wp, from=0.0_wp, to=4.0_wp, case=gapbeam_dead), support_movement(-2*sag, 2)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "a load moves a support") > 0, "a path is needed")
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(size(history%events) == 1, "it closes once")
        call check_close(history%events%factor, [0.5_wp], "at half of the lift")
        call solve_on_path(beam, history, 1.0_wp, result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(deflection(2), 0.0_wp, "up to where the ends are")
        call check_close(reaction(2), 0.625_wp*3*4, "two spans")
        call replace_loads(beam, [support_movement(1.0_wp, 4)], error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "no such support") > 0, "refused")
    end subroutine jacked_up

    !> A clamped end of two equal spans that turns: 24/7 EI/L theta
    subroutine turned()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: condition(3)

        call two_spans(model)
        model%supports(2)%side = gapbeam_both
        model%supports(2)%gap = 0.0_wp
        model%loads = [support_rotation(0.01_wp, 1)]
        call prepare_model(model, beam, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "free") > 0, "a free rotation turns nothing")
        model%supports(1)%rotation = gapbeam_infinity
        call prepare_model(model, beam, error)
        call solve_beam(beam, 2.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(couple(1), 24*100/(7*2.0_wp)*0.02_wp, "couple that turns it")
    end subroutine turned

    !> A beam between axial supports that is warmed: EA alpha dT; warmer below, it sags between its ends
    subroutine warm()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: reaction(5), deflection(5), opening(5), couple(5)
        integer :: condition(5)

        model%spans = [span_type(2.0_wp, EI=1e4_wp, EA=2e5_wp), span_type(2.0_wp, EI=1e4_wp, EA=2e5_wp)]
        model%supports = [support_type(node=0), support_type(node=2), support_type(node=0, direction=gapbeam_axial), &
                          support_type(node=2, direction=gapbeam_axial), support_type(node=1, side=gapbeam_below, stiffness=0.0_wp)]
        model%loads = [temperature_load(-2e-4_wp, 1e-5_wp*40, 0.0_wp, 4.0_wp)]
        model%first_order = .true.
        call prepare_model(model, beam, error)
        call solve_beam(beam, 0.5_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(3:4), [40.0_wp, -40.0_wp], "held at both ends")
        call check_close(deflection(5), 0.5_wp*2e-4_wp*4**2/8, "free to sag")
        call replace_loads(beam, [temperature_load(0.0_wp, 0.0_wp, 0.0_wp, 4.0_wp)], error)
        call replace_loads(beam, [temperature_load(0.0_wp, 1e-5_wp*40, 0.0_wp, 4.0_wp)], error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(3:4), [80.0_wp, -80.0_wp], "held as well where the loads before made nothing longer")
        call replace_loads(beam, [axial_uniform_load(3.0_wp, from=0.0_wp, to=4.0_wp)], error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check_close(reaction(3:4), [-6.0_wp, -6.0_wp], "a load along the beam, half at either end")
    end subroutine warm

    !> A rigid lever that a yielding support holds: the path ends in a motion
    subroutine mechanism_at_limit()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(history_type) :: history
        type(error_type), allocatable :: error

        model%spans = [span_type(2.0_wp, EI=gapbeam_infinity)]
        model%supports = [support_type(node=0), support_type(x=1.0_wp, side=gapbeam_below)]
        model%law = [law_point_type(2, 0.1_wp, 1.0_wp), law_point_type(2, 1.0_wp, 1.0_wp)]
        model%loads = [point_force(1.0_wp, node=1)]
        call prepare_model(model, beam, error)
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error) .and. size(history%limits) == 1, "one limit")
        call check(history%limits(1)%kind == gapbeam_mechanism .and. history%ending == gapbeam_mechanism, "a mechanism")
        call check_close(history%limits(1)%factor, 0.5_wp, "when the support yields")
        call check(allocated(history%motion), "with its motion")
        if (allocated(history%motion)) call check_close(history%motion, history%x/2, "turning")
    end subroutine mechanism_at_limit

    !> Every load times a factor, dead ones in full; supports move further; what is refused
    subroutine combinations()
        type(model_type) :: model
        type(prepared_type) :: beam, combined, none
        type(error_type), allocatable :: error

        model%spans = [span_type(6.0_wp, EI=12.0_wp), span_type(6.0_wp, EI=12.0_wp)]
        model%supports = [support_type(node=0), support_type(node=2), support_type(node=1, side=gapbeam_below, gap=1.0_wp)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=12.0_wp, case=gapbeam_dead), point_force(4.0_wp, x=6.0_wp)]
        call combine_loads(none, [1.0_wp, 1.0_wp], combined, error)
        call check(error%code == gapbeam_not_prepared, "not prepared")
        call prepare_model(model, beam, error)
        call combine_loads(beam, [2.0_wp, 1.0_wp], combined, error)
        call compare_reactions(combined, error, 0.0_wp, [12.0_wp - 22.0_wp/3, 12.0_wp - 22.0_wp/3, 44.0_wp/3], &
                               "dead loads in full from the start")
        call compare_reactions(combined, error, 1.0_wp, [14.0_wp - 28.0_wp/3, 14.0_wp - 28.0_wp/3, 56.0_wp/3], &
                               "and the others scaled")
        call combine_loads(beam, [0.0_wp, 0.0_wp], combined, error, [0.0_wp, 0.0_wp, -4.0_wp])
        call compare_reactions(combined, error, 1.0_wp, [-0.5_wp, -0.5_wp, 1.0_wp], "lifted by 3")
        call combine_loads(beam, [2.0_wp], combined, error)
        call check(error%code == gapbeam_bad_input, "one factor for two loads")
        call combine_loads(beam, [1.0_wp, gapbeam_infinity], combined, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "factors(2)") == 1, "no number")
        call combine_loads(beam, [1.0_wp, 1.0e308_wp], combined, error)
        call check(error%code == gapbeam_bad_input, "too great a factor")
        call combine_loads(beam, [1.0_wp, 1.0_wp], combined, error, [1.0_wp])
        call check(error%code == gapbeam_bad_input, "one movement for three supports")
    end subroutine combinations

    !> Solve a combination and compare its reactions
    subroutine compare_reactions(combined, error, factor, expected, what)
        type(prepared_type), intent(in) :: combined
        type(error_type), allocatable, intent(inout) :: error
        real(wp), intent(in) :: factor, expected(3)
        character(len=*), intent(in) :: what
        type(result_type) :: result
        real(wp) :: reaction(3), deflection(3), opening(3), couple(3)
        integer :: conditions(3)

        call check(.not. allocated(error), what)
        call solve_beam(combined, factor, options_type(), result, error)
        call get_supports(combined, result, reaction, deflection, opening, couple, conditions, error)
        call check_close(reaction, expected, what)
    end subroutine compare_reactions

    !> An error put into a state on purpose is within its bound: the difference from the solution in quadruple precision counts in
    !> full, and here it is all there is
    subroutine errors_within_bounds(share)
        !> Of the numbers that are wrong
        real(wp), intent(in) :: share
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result, wrong
        type(error_type), allocatable :: error

        model%spans = [span_type(6.0_wp, EI=1.0e4_wp), span_type(4.0_wp, EI=1.0e4_wp), span_type(5.0_wp, EI=1.0e4_wp)]
        model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below, stiffness=3.0e4_wp), &
                          support_type(node=2), support_type(node=3, side=gapbeam_below)]
        model%loads = [uniform_load(2.0_wp, from=0.0_wp, to=15.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        associate (units => beam%lowered%units, state => result%state)
            wrong = result
            wrong%state%deflection(:) = (1.0_wp + share)*wrong%state%deflection
            call check_bound(beam, wrong, 1, share*scale(maxval(abs(state%deflection)), units%deflection), "deflections")
            wrong = result
            wrong%state%reaction(:) = (1.0_wp + share)*wrong%state%reaction
            call check_bound(beam, wrong, 2, share*scale(maxval(abs(state%reaction)), units%force), "reactions")
            wrong = result
            wrong%state%moment_left(:) = (1.0_wp + share)*wrong%state%moment_left
            wrong%state%moment_right(:) = (1.0_wp + share)*wrong%state%moment_right
            call check_bound(beam, wrong, 3, share*scale(maxval(abs(state%moment_left)), units%force + units%length), "moments")
        end associate
    end subroutine errors_within_bounds

    !> Is the bound of a wrong state that of the error put in, or a little more
    subroutine check_bound(beam, wrong, bound_of, wanted, what)
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(inout) :: wrong
        !> 1: of deflections, 2: of reactions, 3: of moments
        integer, intent(in) :: bound_of
        !> The error
        real(wp), intent(in) :: wanted
        character(len=*), intent(in) :: what
        type(certificate_type) :: certificate
        type(error_type), allocatable :: error
        real(wp) :: bounds(3)
        logical :: undecided(4)

        call get_certificate(beam, wrong, certificate, undecided, error)
        call check(.not. allocated(error) .and. certificate%known, what//" that are wrong are certified")
        bounds = [certificate%deflection_bound, certificate%reaction_bound, certificate%field_bound(3)]
        call check(wanted <= bounds(bound_of) .and. bounds(bound_of) <= 8*wanted, "the bound says so")
    end subroutine check_bound

end program test_api
