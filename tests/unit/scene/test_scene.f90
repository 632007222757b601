!> From the user's words to the system and back: numbers as words, places, refusals, sections, units, cases, fields
program test_scene
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_status_type, ieee_get_status, &
        ieee_set_status, ieee_set_halting_mode, ieee_all
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_bad_input, gapbeam_not_finite
    use gapbeam_words, only: shown, whole
    use gapbeam_scene, only: model_type, span_type, section_type, support_type, load_type, point_force, point_couple, &
        uniform_load, imposed_curvature, gapbeam_infinity, gapbeam_below, gapbeam_above, gapbeam_axial, gapbeam_distributed, &
        gapbeam_dead, gapbeam_rotational, gapbeam_rotational_left, gapbeam_rotational_right
    use gapbeam_units, only: units_type, units_with_loads, moment_unit, turning_unit, bound_outside, no_exponent
    use gapbeam_stations, only: place_span_ends, locate, merge_stations
    use gapbeam_input_error, only: named, of_spans, of_hinges, of_supports, of_loads, of_sections, no_span, not_expected, &
        too_long, &
        lost_length, at_end, off_beam, no_place, no_node, no_stretch, not_axial, no_gap, not_held, twice, no_room, at_hinge, idle, &
        bad_law
    use gapbeam_check, only: check_spans
    use gapbeam_fingerprint, only: fingerprint
    use gapbeam_assembled_model, only: assembled_type, copy_model, point_x, piece_length, in_bending, in_shear, &
        along_axis
    use gapbeam_piece_stiffness, only: stiffness_of
    use gapbeam_assemble, only: assemble_model
    use gapbeam_assemble_supports, only: contact_level
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_support_values, only: support_values
    use gapbeam_quantities, only: quantity_count
    use gapbeam_query, only: fields_at_places, node_places
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, take_case
    use gapbeam_combinations, only: combination_type, combine, solve_combination, values_of_combination
    use gapbeam_search, only: rule_block
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_model, only: beam_type
    implicit none
    integer :: status

    call numbers_as_words()
    call ends_of_spans()
    call places_become_points()
    call everything_is_refused_with_a_reason()
    call later_sections_win()
    call a_load_goes_to_the_right_end()
    call units_are_powers_of_two()
    call fingerprints_differ()
    call fields_of_a_simple_beam()
    call cases_are_sums_of_loads()
    call combinations_are_sums_of_loads()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two spans of 6 on supports at both ends
    function simple() result(model)
        type(model_type) :: model

        allocate (model%spans(2), model%supports(2), model%hinges(0), model%sections(0), model%loads(0))
        model%spans(:) = span_type(6.0_wp, EI=12.0_wp)
        model%supports(:) = [support_type(node=0), support_type(node=2)]
    end function simple

    !> Lower a model with all traps off, as gapbeam_api does: what leaves the range of doubles is refused in words
    subroutine lower(model, lowered, error)
        type(model_type), intent(in) :: model
        type(assembled_type), intent(out) :: lowered
        type(error_type), allocatable, intent(out) :: error
        type(ieee_status_type) :: environment
        integer :: stat

        call ieee_get_status(environment)
        call ieee_set_halting_mode(ieee_all, .false.)
        call copy_model(model, lowered%model, stat)
        call assemble_model(lowered, error)
        call ieee_set_status(environment)
    end subroutine lower

    !> Solve likewise
    subroutine solve(lowered, state, error)
        type(assembled_type), intent(in) :: lowered
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(ieee_status_type) :: environment

        call ieee_get_status(environment)
        call ieee_set_halting_mode(ieee_all, .false.)
        call solve_state(lowered, 1.0_wp, rule_block, state, error)
        call ieee_set_status(environment)
    end subroutine solve

    !> As C's %.15g
    subroutine numbers_as_words()
        call check(shown(0.1_wp + 0.2_wp) == "0.3", "the noise of the last bits is left out")
        call check(shown(6.0_wp) == "6", "whole numbers")
        call check(shown(-2.5e-7_wp) == "-2.5e-07", "small ones")
        call check(shown(1.7e308_wp) == "1.7e+308", "great ones")
        call check(shown(123456.789_wp) == "123456.789", "a point inside")
        call check(shown(0.00012_wp) == "0.00012", "zeros behind the point")
        call check(shown(-gapbeam_infinity) == "-inf", "infinite")
        call check(shown(ieee_value(1.0_wp, ieee_quiet_nan)) == "nan", "no number")
        call check(whole(-7) == "-7", "an integer")
        call check(named(of_supports, 3, 4) == "support 3 of 4", "an entry")
    end subroutine numbers_as_words

    !> Ten spans of 0.1 end at 1
    subroutine ends_of_spans()
        type(span_type) :: spans(10)
        real(wp) :: ends(0:10)

        spans(:) = span_type(0.1_wp, EI=1.0_wp)
        call place_span_ends(spans, ends)
        call check(abs(ends(10) - 1.0_wp) <= 0.0_wp, "to the last digit, which a running sum loses")
    end subroutine ends_of_spans

    !> What differs by rounding is one point; what is near is near to the point, not to another place
    subroutine places_become_points()
        real(wp), parameter :: ends(0:2) = [0.0_wp, 6.0_wp, 12.0_wp], near = 40*epsilon(1.0_wp)
        integer :: span(6), order(6), chosen(6), point(6), number, at
        real(wp) :: offset(6), distance

        call locate(6.0_wp*(1 + epsilon(1.0_wp)), ends, at, distance)
        call check(at == 1 .and. distance <= 0.0_wp, "a span end and a little")
        call locate(12.0_wp, ends, at, distance)
        call check(at == 2, "the right end")
        call locate(7.5_wp, ends, at, distance)
        call check(at == 1 .and. abs(distance - 1.5_wp) <= 0.0_wp, "inside a span")
        span = [0, 1, 2, 0, 0, 0]
        offset = [0.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 3.0_wp*(1 + near), 3.0_wp*(1 + 2*near)]
        call merge_stations(ends, span, offset, 3, order, chosen, point, number)
        call check(number == 5, "three in a chain are two points")
        call check(all(point == [0, 3, 4, 1, 1, 2]), "the second is at the first")
    end subroutine places_become_points

    !> Reasons, tables, entries, keys and partners
    subroutine everything_is_refused_with_a_reason()
        type(error_type), allocatable :: error
        type(model_type) :: model
        real(wp) :: nan

        nan = ieee_value(nan, ieee_quiet_nan)
        call check_spans([span_type ::], error)
        call check(error%table == of_spans .and. error%reason == no_span, "no span")
        model = simple()
        model%spans(2)%length = -6.0_wp
        call expect(model, of_spans, 2, not_expected, "length", "a length below 0")
        model = simple()
        model%spans(1)%GA = 0.0_wp
        call expect(model, of_spans, 1, not_expected, "GA", "a stiffness of 0")
        model = simple()
        model%spans%length = 1e308_wp
        call expect(model, of_spans, 2, too_long, "", "too long")
        model%spans%length = [1e20_wp, 1.0_wp]
        call expect(model, of_spans, 2, lost_length, "", "lost in rounding")
        model = simple()
        model%hinges = [12.0_wp]
        call expect(model, of_hinges, 1, at_end, "", "a hinge at the end")
        model%hinges = [3.0_wp, 5.0_wp, 3.0_wp]
        call expect(model, of_hinges, 3, twice, "", "two hinges", 1)
        model%hinges = [13.0_wp]
        call expect(model, of_hinges, 1, off_beam, "x", "a hinge off the beam")
        model%hinges = [nan]
        call expect(model, of_hinges, 1, not_expected, "x", "a hinge nowhere")
        model = simple()
        model%sections = [section_type(EI=2.0_wp), section_type()]
        call expect(model, of_sections, 2, idle, "", "a section that changes nothing")
        model%sections = [section_type(from=4.0_wp, to=4.0_wp, EI=2.0_wp)]
        call expect(model, of_sections, 1, no_stretch, "", "a section without length")
        model = simple()
        model%supports = [model%supports, support_type(gap=0.1_wp)]
        call expect(model, of_supports, 3, no_place, "", "a support without a place")
        model%supports(3)%x = 3.0_wp
        call expect(model, of_supports, 3, no_gap, "gap", "a gap of a support that holds both ways")
        model%supports(3)%direction = gapbeam_axial
        call expect(model, of_supports, 3, no_gap, "gap", "a gap along the beam of a support that holds both ways")
        model%supports(3) = support_type(x=3.0_wp, direction=gapbeam_axial, rotation=1.0_wp)
        call expect(model, of_supports, 3, not_axial, "rotation", "a rotation held along the beam")
        model%supports(3) = support_type(x=3.0_wp, direction=gapbeam_axial, friction=0.1_wp)
        call expect(model, of_supports, 3, bad_law, "friction", "friction of a support along the beam")
        model%supports(3) = support_type(node=3)
        call expect(model, of_supports, 3, no_node, "node", "there is no such node")
        model%supports(3) = support_type(node=2)
        call expect(model, of_supports, 3, twice, "side", "two rigid supports", 2)
        model%supports(2:3) = [support_type(node=2, side=gapbeam_above, gap=-0.1_wp), support_type(node=2, side=gapbeam_below)]
        call expect(model, of_supports, 3, no_room, "", "no room between them", 2)
        model = simple()
        model%hinges = [6.0_wp]
        model%supports = [model%supports, support_type(node=1, stiffness=1.0_wp, rotation=2.0_wp)]
        call expect(model, of_supports, 3, at_hinge, "rotation", "a restraint at a hinge")
        model%supports(3) = support_type(node=1, direction=gapbeam_rotational)
        call expect(model, of_supports, 3, at_hinge, "rotation", "one that is a support of its own")
        model%supports(3) = support_type(x=5.0_wp, direction=gapbeam_rotational_left)
        call expect(model, of_supports, 3, bad_law, "at_hinge", "left of no hinge")
        model%supports(3) = support_type(node=1, direction=gapbeam_rotational_left)
        model%supports = [model%supports, support_type(node=1, direction=gapbeam_rotational_right)]
        call expect(model, of_supports, 4, bad_law, "at_hinge", "both sides of a hinge")
        model%hinge_stiffness = [2.0_wp]
        call expect(model, of_supports, 3, bad_law, "direction", "beside a hinge with a stiffness")
        deallocate (model%hinge_stiffness)
        model%supports = [model%supports(:2), support_type(node=1, stiffness=1.0_wp)]
        model%loads = [point_couple(1.0_wp, x=6.0_wp)]
        call expect(model, of_loads, 1, at_hinge, "", "a couple at a hinge")
        model%loads = [uniform_load(1.0_wp, from=5.0_wp, to=4.0_wp)]
        call expect(model, of_loads, 1, no_stretch, "", "a load from right to left")
        model%loads = [uniform_load(nan, from=5.0_wp, to=6.0_wp)]
        call expect(model, of_loads, 1, not_expected, "value", "a load that is no number")
        model%loads(1)%kind = 5
        model%loads(1)%value = 1.0_wp
        call expect(model, of_loads, 1, not_held, "", "a load along a beam that slides")
    end subroutine everything_is_refused_with_a_reason

    !> A model is refused, and why
    subroutine expect(model, table, entry, reason, key, name, partner)
        type(model_type), intent(in) :: model
        integer, intent(in) :: table, entry, reason
        character(len=*), intent(in) :: key, name
        integer, intent(in), optional :: partner
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        logical :: right

        call lower(model, lowered, error)
        right = allocated(error)
        if (right) right = error%code == gapbeam_bad_input .and. error%table == table .and. error%entry == entry &
            .and. error%reason == reason .and. error%key == key
        if (right .and. present(partner)) right = error%partner == partner
        call check(right, name)
    end subroutine expect

    !> Of sections over one another the last that gives a stiffness
    subroutine later_sections_win()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%sections = [section_type(from=2.0_wp, EI=5.0_wp, GA=7.0_wp), section_type(from=4.0_wp, to=9.0_wp, EI=3.0_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error) .and. size(lowered%pieces) == 5, "cut at 2, 4, 6 and 9")
        call check_close([stiffness_of(lowered, 1, in_bending), stiffness_of(lowered, 2, in_bending), &
                          stiffness_of(lowered, 3, in_bending), stiffness_of(lowered, 5, in_bending)], &
                         [12.0_wp, 5.0_wp, 3.0_wp, 5.0_wp], "EI of the pieces")
        call check_close(stiffness_of(lowered, 4, in_shear), 7.0_wp, "GA stays where a later section gives none")
        call check(stiffness_of(lowered, 4, along_axis) > huge(1.0_wp), "EA is that of the span")
        call check_close([point_x(lowered, 4), piece_length(lowered, 4)], [9.0_wp, 3.0_wp], "places of points, lengths of pieces")
        call check_close(1/lowered%pieces(3)%flexibility, 3.0_wp, "and it is what the engine gets")
    end subroutine later_sections_win

    !> Where no right end is given
    subroutine a_load_goes_to_the_right_end()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%loads = [load_type(kind=gapbeam_distributed, x=3.0_wp, value=2.0_wp, value_to=2.0_wp)]
        call lower(model, lowered, error)
        call check_close(lowered%live%qb, [0.0_wp, 2.0_wp, 2.0_wp], "from 3 to 12")
        call check(contact_level(support_type(side=gapbeam_above, gap=0.5_wp, settlement=0.25_wp)) < 0.0_wp, "above: less the gap")
    end subroutine a_load_goes_to_the_right_end

    !> 1 but for models far from it
    subroutine units_are_powers_of_two()
        type(units_type) :: units

        units = units_with_loads(2, 10, 3, no_exponent)
        call check(units%length == 0 .and. units%force == 0 .and. units%deflection == 0, "ordinary models keep their own")
        units = units_with_loads(0, 300, 300, no_exponent)
        call check(units%force == 300 .and. units%deflection == 0, "a stiff beam under great loads")
        call check(moment_unit(units) == 300 .and. turning_unit(units) == 300, "moments and restraints follow")
        call check(bound_outside(tiny(1.0_wp), -10) > 0.0_wp, "a bound is rounded up")
        call check(bound_outside(gapbeam_infinity, 1) > huge(1.0_wp), "or infinite")
    end subroutine units_are_powers_of_two

    !> Results are known by it
    subroutine fingerprints_differ()
        type(assembled_type) :: a, b
        type(error_type), allocatable :: error
        type(model_type) :: model

        model = simple()
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=3.0_wp), uniform_load(2.0_wp, from=0.0_wp, to=3.0_wp)]
        call lower(model, a, error)
        call check(a%fingerprint == fingerprint(a%model), "the same model")
        model%loads = [model%loads(2), model%loads(1)]
        call lower(model, b, error)
        call check(a%fingerprint /= b%fingerprint, "loads in another order")
    end subroutine fingerprints_differ

    !> q L**2/8, 5 q L**4/(384 EI), q L/2
    subroutine fields_of_a_simple_beam()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(state_type) :: state
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 2), reaction(2), deflection(2), opening(2), couple(2), x(0:1)
        integer :: condition(2)

        model = simple()
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=12.0_wp), imposed_curvature(0.0_wp, from=0.0_wp, to=12.0_wp)]
        call lower(model, lowered, error)
        call new_state(lowered, state, error)
        call solve(lowered, state, error)
        call check(.not. allocated(error) .and. state%status == 0, "it is solved")
        call fields_at_places(lowered, state, [1, 2, 3, 4, 5, 6], [6.0_wp, 12.0_wp], .true., fields, error)
        call check_close(fields(:, 1), [5*12.0_wp**4/(384*12.0_wp), 0.0_wp, 18.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], "in the middle", &
                         absolute=1e-13_wp)
        call check_close(fields(4, 2), -6.0_wp, "at the right end")
        call support_values(lowered, state, reaction, deflection, opening, couple, condition)
        call check_close(reaction, [6.0_wp, 6.0_wp], "reactions")
        call node_places(lowered, x)
        call check_close(x, [0.0_wp, 12.0_wp], "two nodes")
        call fields_at_places(lowered, state, [1, 2, 3, 4, 5, 6], [13.0_wp, 0.0_wp], .true., fields, error)
        call check(error%code == gapbeam_bad_input .and. error%entry == 1, "off the beam")
        model%loads(1)%value = 1.7e308_wp
        model%loads(1)%value_to = 1.7e308_wp
        call lower(model, lowered, error)
        if (.not. allocated(error)) call solve(lowered, state, error)
        call check(error%code == gapbeam_not_finite, "numbers out of range")
    end subroutine fields_of_a_simple_beam

    !> Each load times its factor
    subroutine cases_are_sums_of_loads()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(beam_type) :: beam
        type(case_loads_type) :: loads
        type(workspace_type) :: work
        type(error_type), allocatable :: error
        logical :: closed(2)
        integer :: status

        model = simple()
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=12.0_wp), point_force(4.0_wp, x=3.0_wp), point_force(5.0_wp, node=2)]
        call lower(model, lowered, error)
        call split_loads(lowered, loads, error)
        beam = lowered%beam
        call new_workspace(beam, work)
        closed = .true.
        call solve_case(loads, [2.0_wp, -1.0_wp, 1.0_wp], rule_block, beam, closed, work, status)
        call check_close(work%reaction, [12.0_wp - 3.0_wp, 12.0_wp - 1.0_wp + 5.0_wp], "a case")
        call take_case([2.0_wp, -1.0_wp, 1.0_wp], lowered, error)
        call check_close([lowered%live(1)%qa, lowered%beam%force(2, 1)], [2.0_wp, 5.0_wp], "the same as a beam of its own")
    end subroutine cases_are_sums_of_loads

    !> Combinations keep dead loads apart, move supports, and are made one after the other on the same beam
    subroutine combinations_are_sums_of_loads()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(combination_type) :: combined
        type(error_type), allocatable :: error

        model = simple()
        deallocate (model%supports)
        allocate (model%supports(3))
        model%supports(:) = [support_type(node=0), support_type(node=2), support_type(node=1, side=gapbeam_below, gap=1.0_wp)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=12.0_wp, case=gapbeam_dead), point_force(4.0_wp, x=6.0_wp)]
        call lower(model, lowered, error)
        call try_combination(lowered, [2.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 200.0_wp], combined, &
                             [14.0_wp, 14.0_wp, 0.0_wp], "the support in the middle is far off")
        call check_close([combined%assembled%dead(1)%qa, combined%assembled%live(1)%qa], [2.0_wp, 0.0_wp], "dead loads stay dead")
        call try_combination(lowered, [0.0_wp, 0.5_wp], [1.0_wp, 1.0_wp, 100.0_wp], combined, &
                             [1.0_wp, 1.0_wp, 0.0_wp], "the ends move down by 1")
        call try_combination(lowered, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, -1.0_wp], combined, &
                             [0.0_wp, 0.0_wp, 0.0_wp], "the gap is closed, without load")
        ! Force at the middle of the beam for a displacement: 48 EI/L**3 = 1/3
        call try_combination(lowered, [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, -4.0_wp], combined, &
                             [-0.5_wp, -0.5_wp, 1.0_wp], "lifted by 3")
        call try_combination(lowered, [2.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], combined, &
                             [14.0_wp - 28.0_wp/3, 14.0_wp - 28.0_wp/3, 56.0_wp/3], "nothing moves")
    end subroutine combinations_are_sums_of_loads

    !> Solve a combination and compare reactions, and the moment at 3
    subroutine try_combination(lowered, factors, settlements, combined, reactions, what)
        type(assembled_type), intent(in) :: lowered
        real(wp), intent(in) :: factors(:), settlements(:), reactions(:)
        type(combination_type), intent(inout) :: combined
        character(len=*), intent(in) :: what
        type(error_type), allocatable :: error
        type(state_type) :: state
        real(wp) :: at_supports(3, 4), extremes(2, quantity_count), places(2, quantity_count), &
            fields(quantity_count, 1)

        call combine(lowered, factors, settlements, combined, error)
        if (.not. allocated(error)) call solve_combination(combined%assembled, rule_block, [.true., .true., .true.], state, error)
        if (.not. allocated(error)) then
            call values_of_combination(combined%assembled, state, [1], [3.0_wp], at_supports, extremes, places, fields, error)
        end if
        call check(.not. allocated(error), what)
        if (allocated(error)) return
        call check_close(at_supports(:, 1), reactions, what)
        call check_close([fields(3, 1)], [3.0_wp*reactions(1) - 4.5_wp*factors(1)], "moment: "//what)
    end subroutine try_combination

end program test_scene
