!> Beams on foundations by the module gapbeam alone: closed forms, other loads, units, what is refused
program test_api_ground
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, support_type, law_point_type, foundation_type, ground_point_type, &
        ground_law_point_type, point_force, uniform_load, ground_movement, prepared_type, options_type, result_type, &
        certificate_type, event_type, ground_event_type, history_type, error_type, contact_type, free_span_type, prepare_model, &
        replace_loads, &
        combine_loads, solve_beam, follow_load, follow_ground, follow_history, gapbeam_leaves, get_supports, get_fields, &
        get_extremes, get_motion, get_certificate, get_contact, get_free_spans, get_pressure, get_pressure_extremes, count_nodes, &
        count_supports, gapbeam_infinity, gapbeam_below, gapbeam_above, gapbeam_dead, gapbeam_closed, gapbeam_bilateral, &
        gapbeam_branch, gapbeam_plastic, gapbeam_limit_stop, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_bad_input, &
        gapbeam_not_prepared, gapbeam_not_finite
    implicit none
    integer :: status

    call a_rigid_beam_tips()
    call a_beam_that_is_held_both_ways()
    call a_law_both_ways()
    call it_is_lifted_off()
    call a_beam_in_the_air()
    call other_loads()
    call it_sinks()
    call its_edge_lifts()
    call its_force_falls()
    call extreme_units()
    call everything_refused()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A rigid beam of 12 on ground that pushes up only, a force of 30 at a distance of 2 from its left end
    subroutine tipped(model)
        type(model_type), intent(out) :: model

        model%spans = [span_type(12.0_wp, EI=gapbeam_infinity)]
        model%foundations = [foundation_type(k=5.0_wp, side=gapbeam_below)]
        model%loads = [point_force(30.0_wp, x=2.0_wp)]
    end subroutine tipped

    !> Contact over three times the distance of the force from the edge, where the pressure is 2 F/(3 e)
    subroutine a_rigid_beam_tips()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(certificate_type) :: certificate
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 3), value(2, 6), place(2, 6), pressure(3), most(2), at(2), none(0, 4)
        integer :: no_codes(0)
        logical :: undecided(0)

        call tipped(model)
        call prepare_model(model, beam, error)
        call check(.not. allocated(error) .and. count_supports(beam) == 0 .and. count_nodes(beam) == 3, "all points are nodes")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved .and. .not. result%indifferent, "solved")
        call get_contact(beam, result, zones, error)
        call check(size(zones) == 1, "one zone")
        call check(zones(1)%foundation == 1 .and. zones(1)%condition == gapbeam_closed, "what it is")
        call check_close([zones(1)%from, zones(1)%to, zones(1)%resultant], [0.0_wp, 6.0_wp, 30.0_wp], "its ends and its force")
        call get_free_spans(beam, result, spans, error)
        call check(size(spans) == 1, "one free span")
        call check_close([spans(1)%from, spans(1)%to, spans(1)%sag], [6.0_wp, 12.0_wp, 2.0_wp], "its ends and its sag")
        call get_pressure(beam, result, [0.0_wp, 3.0_wp, 9.0_wp], pressure, error)
        call check_close(pressure, [10.0_wp, 5.0_wp, 0.0_wp], "pressure")
        call get_pressure_extremes(beam, result, most, at, error)
        call check_close([most(1), at(1)], [10.0_wp, 0.0_wp], "the largest")
        call check(.not. abs(most(2)) > 0.0_wp, "the smallest")
        call get_fields(beam, result, [0.0_wp, 2.0_wp, 12.0_wp], fields, error)
        call check_close(fields(1, :), [2.0_wp, 4/3.0_wp, -2.0_wp], "deflections")
        call check_close(fields(4, 2), 20 - 2*5/3.0_wp - 30, "shear right of the force")
        call get_fields(beam, result, [2.0_wp], fields(:, 1:1), error, from_left=.true.)
        call check_close(fields(4, 1), 20 - 2*5/3.0_wp, "and left of it")
        call get_extremes(beam, result, value, place, error)
        call check_close(value(:, 1), [2.0_wp, -2.0_wp], "extremes")
        call check_close(place(:, 1), [0.0_wp, 12.0_wp], "their places")
        call get_supports(beam, result, none(:, 1), none(:, 2), none(:, 3), none(:, 4), no_codes, error)
        call check(.not. allocated(error), "no support")
        call get_certificate(beam, result, certificate, undecided, error)
        call check(certificate%known .and. certificate%field_bound(1) < 1e-12_wp .and. certificate%field_bound(1) > 0.0_wp &
                   .and. certificate%deflection_bound <= certificate%field_bound(1) .and. certificate%equilibrium < 1e-12_wp, &
                   "certificate")
    end subroutine a_rigid_beam_tips

    !> On two layers of ground a uniform load presses it down everywhere alike
    subroutine a_beam_that_is_held_both_ways()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: pressure(2), fields(6, 1)

        model%spans = [span_type(4.0_wp, EI=100.0_wp), span_type(6.0_wp, EI=200.0_wp, GA=50.0_wp)]
        model%foundations = [foundation_type(k=2.0_wp), foundation_type(k=1.0_wp, side=gapbeam_below), &
                             foundation_type(k=7.0_wp, side=gapbeam_above, from=3.0_wp)]
        model%loads = [uniform_load(6.0_wp, 0.0_wp, 10.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, -0.5_wp, options_type(), result, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_contact(beam, result, zones, error)
        call check(all(zones%foundation == [1, 2]) .and. all(zones%condition == [gapbeam_bilateral, gapbeam_closed]), "two zones")
        call check_close(zones%resultant, [40.0_wp, 20.0_wp], "their forces")
        call check_close(zones%to, [10.0_wp, 10.0_wp], "over all pieces")
        call get_free_spans(beam, result, spans, error)
        call check(size(spans) == 1, "one free span")
        call check(spans(1)%foundation == 3, "below what is above it")
        call check_close([spans(1)%from, spans(1)%to, spans(1)%sag], [3.0_wp, 10.0_wp, 2.0_wp], "where, and how far")
        call get_pressure(beam, result, [0.0_wp, 10.0_wp], pressure, error)
        call check_close(pressure, [6.0_wp, 6.0_wp], "pressure of both")
        call get_fields(beam, result, [7.0_wp], fields, error)
        call check_close(fields(1, 1), 2.0_wp, "the beam goes down as it is")
    end subroutine a_beam_that_is_held_both_ways

    !> A law that holds both ways with a gap: where the beam is pressed against the upper layer
    subroutine a_law_both_ways()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 1), pressure(1)

        model%spans = [span_type(8.0_wp, EI=10.0_wp)]
        model%foundations = [foundation_type(gap=0.5_wp)]
        model%ground_law = [ground_law_point_type(1, 1.0_wp, 4.0_wp), ground_law_point_type(1, 3.0_wp, 6.0_wp)]
        model%loads = [uniform_load(-5.0_wp, 0.0_wp, 8.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, "solved")
        call get_contact(beam, result, zones, error)
        call check(size(zones) == 1, "one zone")
        call check(zones(1)%condition == gapbeam_branch + 2, "on the second piece")
        call check_close(zones(1)%resultant, -40.0_wp, "it is pushed down")
        call get_free_spans(beam, result, spans, error)
        call check(size(spans) == 0, "no free span of what holds both ways")
        call get_fields(beam, result, [3.0_wp], fields, error)
        call check_close(fields(1, 1), -2.5_wp, "gap, first piece, second piece")
        call get_pressure(beam, result, [3.0_wp], pressure, error)
        call check_close(pressure(1), -5.0_wp, "pressure")
    end subroutine a_law_both_ways

    !> Nothing holds it down
    subroutine it_is_lifted_off()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(error_type), allocatable :: error
        real(wp), allocatable :: x(:), motion(:)

        call tipped(model)
        call prepare_model(model, beam, error)
        call solve_beam(beam, -1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_no_equilibrium, "no equilibrium")
        if (result%status /= gapbeam_no_equilibrium) return
        allocate (x(count_nodes(beam)), motion(count_nodes(beam)))
        call get_motion(beam, result, x, motion, error)
        call check(.not. allocated(error) .and. all(abs(motion) <= 1.0_wp) .and. motion(2) < 0.0_wp, "it goes up")
        call get_contact(beam, result, zones, error)
        call check(error%code == gapbeam_not_prepared .and. .not. allocated(zones), "and touches nothing")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_contact(beam, result, zones, error)
        call check_close(zones(1)%resultant, 30.0_wp, "pressed down again")
    end subroutine it_is_lifted_off

    !> Without foundations there is no contact and no pressure
    subroutine a_beam_in_the_air()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: pressure(2), most(2), at(2)

        model%spans = [span_type(8.0_wp, EI=10.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1)]
        model%loads = [uniform_load(1.0_wp, 0.0_wp, 8.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_contact(beam, result, zones, error)
        call check(.not. allocated(error) .and. size(zones) == 0, "no zone")
        call get_free_spans(beam, result, spans, error)
        call check(.not. allocated(error) .and. size(spans) == 0, "no free span")
        pressure = 7.0_wp
        call get_pressure(beam, result, [1.0_wp, 8.0_wp], pressure, error)
        call check(all(abs(pressure) <= 0.0_wp), "no pressure")
        call get_pressure_extremes(beam, result, most, at, error)
        call check(all(abs(most) <= 0.0_wp) .and. all(abs(at) <= 0.0_wp), "nor extremes of it")
    end subroutine a_beam_in_the_air

    !> A flexible beam on ground of every kind
    subroutine on_everything(model)
        type(model_type), intent(out) :: model

        model%spans = [span_type(7.0_wp, EI=40.0_wp), span_type(5.0_wp, EI=25.0_wp, GA=60.0_wp)]
        model%supports = [support_type(x=2.0_wp, side=gapbeam_above, stiffness=8.0_wp)]
        model%foundations = [foundation_type(from=1.0_wp, to=9.0_wp, k=5.0_wp, k_to=2.0_wp, side=gapbeam_below), &
                             foundation_type(from=3.0_wp, k=1.0_wp, side=gapbeam_above, gap=0.125_wp, gap_to=0.5_wp), &
                             foundation_type(from=0.5_wp, side=gapbeam_below)]
        model%ground = [ground_point_type(1, -1.0_wp, 0.25_wp), ground_point_type(1, 4.0_wp, -0.125_wp), &
                        ground_point_type(1, 8.0_wp, 0.5_wp)]
        model%ground_law = [ground_law_point_type(3, 0.25_wp, 1.0_wp), ground_law_point_type(3, 1.0_wp, 2.5_wp)]
        model%loads = [uniform_load(1.0_wp, 0.0_wp, 12.0_wp, case=gapbeam_dead), point_force(9.0_wp, x=6.0_wp)]
    end subroutine on_everything

    !> Other loads give what a beam prepared with them gives: at the same places, at others, and the first ones again
    subroutine other_loads()
        type(model_type) :: model, first
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 1)

        call on_everything(first)
        model = first
        call prepare_model(first, beam, error)
        call check(.not. allocated(error), "prepared")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        model%loads(2)%value = -6.0_wp
        call replace_loads(beam, model%loads, error)
        call get_fields(beam, result, [1.0_wp], fields, error)
        call check(error%code == gapbeam_not_prepared, "a result of other loads")
        call compare(model, beam, "values")
        ! Far greater loads are solved in other units
        model%loads(1)%value = 1e200_wp
        model%loads(1)%value_to = 1e200_wp
        call replace_loads(beam, model%loads, error)
        call check(.not. allocated(error), "loads in other units")
        call replace_loads(beam, first%loads, error)
        call compare(first, beam, "back from other units")
        model%loads = [first%loads, uniform_load(3.0_wp, from=8.5_wp, to=9.5_wp), point_force(-2.0_wp, x=1.25_wp)]
        call replace_loads(beam, model%loads, error)
        call compare(model, beam, "places")
        call replace_loads(beam, first%loads, error)
        call compare(first, beam, "the first ones")
        call replace_loads(beam, [point_force(gapbeam_infinity, x=1.0_wp)], error)
        call check(error%code == gapbeam_bad_input, "a load that is refused")
        call compare(first, beam, "and leaves the beam as it was")
    end subroutine other_loads

    !> Ground that holds both ways takes the beam along, and turns it; other movements with the same places
    subroutine it_sinks()
        type(model_type) :: model
        type(prepared_type) :: beam, combined
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 2), pressure(2)

        model%spans = [span_type(12.0_wp, EI=50.0_wp)]
        model%foundations = [foundation_type(k=5.0_wp)]
        model%loads = [ground_movement(0.3_wp, 1, value_to=-0.1_wp), &
                       uniform_load(1.0_wp, from=0.0_wp, to=12.0_wp, case=gapbeam_dead)]
        call prepare_model(model, beam, error)
        call check(.not. allocated(error), "prepared")
        call solve_beam(beam, 0.5_wp, options_type(), result, error)
        call get_fields(beam, result, [0.0_wp, 12.0_wp], fields, error)
        call check_close(fields(1, :), [0.35_wp, 0.15_wp], "half of the movement")
        call get_pressure(beam, result, [0.0_wp, 12.0_wp], pressure, error)
        call check_close(pressure, [1.0_wp, 1.0_wp], "the ground carries the weight")
        call combine_loads(beam, [2.0_wp, 1.0_wp], combined, error)
        call solve_beam(combined, 1.0_wp, options_type(), result, error)
        call get_fields(combined, result, [0.0_wp, 12.0_wp], fields, error)
        call check_close(fields(1, :), [0.8_wp, 0.0_wp], "twice the movement")
        call replace_loads(beam, [ground_movement(0.1_wp, 1), model%loads(2)], error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_fields(beam, result, [0.0_wp, 12.0_wp], fields, error)
        call check_close(fields(1, :), [0.3_wp, 0.3_wp], "another movement")
        call replace_loads(beam, [ground_movement(0.1_wp, 2)], error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "no such foundation") > 0, "no such foundation")
    end subroutine it_sinks

    !> A prepared beam and a model prepared anew say the same, to the last digit
    subroutine compare(model, beam, name)
        type(model_type), intent(in) :: model
        type(prepared_type), intent(in) :: beam
        character(len=*), intent(in) :: name
        type(prepared_type) :: fresh
        type(result_type) :: result(2)
        type(contact_type), allocatable :: zones(:), others(:)
        type(free_span_type), allocatable :: spans(:), other_spans(:)
        type(error_type), allocatable :: error
        real(wp) :: x(13), fields(6, 13, 2), pressure(13, 2), value(2, 2), place(2, 2)
        integer :: i, k

        x = [(real(i, wp), i=0, 12)]
        call prepare_model(model, fresh, error)
        call solve_beam(beam, 1.0_wp, options_type(), result(1), error)
        call solve_beam(fresh, 1.0_wp, options_type(), result(2), error)
        call check(all(result%status == gapbeam_solved), name//": solved")
        call get_contact(beam, result(1), zones, error)
        call get_contact(fresh, result(2), others, error)
        call check(size(zones) > 1 .and. size(zones) == size(others), name//": zones")
        call check(all(zones%foundation == others%foundation) .and. all(zones%condition == others%condition) &
                   .and. all(same(zones%from, others%from)) .and. all(same(zones%to, others%to)) &
                   .and. all(same(zones%resultant, others%resultant)), name//": what they say")
        call get_free_spans(beam, result(1), spans, error)
        call get_free_spans(fresh, result(2), other_spans, error)
        call check(size(spans) == size(other_spans), name//": free spans")
        call check(all(same(spans%from, other_spans%from)) .and. all(same(spans%sag, other_spans%sag)), name//": their sags")
        call get_fields(beam, result(1), x, fields(:, :, 1), error)
        call get_fields(fresh, result(2), x, fields(:, :, 2), error)
        call check(all(same(fields(:, :, 1), fields(:, :, 2))), name//": fields")
        call get_pressure(beam, result(1), x, pressure(:, 1), error)
        call get_pressure(fresh, result(2), x, pressure(:, 2), error)
        call check(all(same(pressure(:, 1), pressure(:, 2))), name//": pressure")
        do k = 1, 2
            if (k == 1) call get_pressure_extremes(beam, result(k), value(:, k), place(:, k), error)
            if (k == 2) call get_pressure_extremes(fresh, result(k), value(:, k), place(:, k), error)
        end do
        call check(all(same(value(:, 1), value(:, 2))) .and. all(same(place(:, 1), place(:, 2))), name//": its extremes")
    end subroutine compare

    !> Are two numbers the same
    elemental function same(a, b) result(they_are)
        real(wp), intent(in) :: a, b
        logical :: they_are

        they_are = .not. abs(a - b) > 0.0_wp
    end function same

    !> In units that are powers of two apart answers are, too
    subroutine extreme_units()
        integer, parameter :: length(2) = [0, 90], force(2) = [0, -300]
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: usual(6), found(6), most(2), at(2), pressure(1)
        integer :: k

        do k = 1, 2
            call tipped(model)
            model%spans%length = scale(model%spans%length, length(k))
            model%spans%EI = scale(1000.0_wp, force(k) + 2*length(k))
            model%foundations%k = scale(model%foundations%k, force(k) - 2*length(k))
            model%loads%x = scale(model%loads%x, length(k))
            model%loads%value = scale(model%loads%value, force(k))
            call prepare_model(model, beam, error)
            call check(.not. allocated(error), "prepared")
            call solve_beam(beam, 1.0_wp, options_type(), result, error)
            call get_contact(beam, result, zones, error)
            call get_free_spans(beam, result, spans, error)
            call get_pressure_extremes(beam, result, most, at, error)
            call get_pressure(beam, result, [scale(1.0_wp, length(k))], pressure, error)
            found = [scale(zones(1)%to, -length(k)), scale(zones(1)%resultant, -force(k)), scale(spans(1)%sag, -length(k)), &
                     scale(most(1), length(k) - force(k)), scale(at(1), -length(k)), scale(pressure(1), length(k) - force(k))]
            if (k == 1) usual = found
            call check_close(found, usual, "in other units", relative=16*epsilon(1.0_wp))
        end do
        model%foundations%k = scale(model%foundations%k, 1400)
        call prepare_model(model, beam, error)
        call check(allocated(error), "too far away")
        if (allocated(error)) call check(error%code == gapbeam_not_finite .and. index(error%message, "foundation 1 of 1: k = ") &
                                         > 0, error%message)
    end subroutine extreme_units

    !> The edge of a rigid beam lifts where the resultant of its weight and of a force at the other end leaves the middle third;
    !> the whole beam where as much pulls it up as it weighs
    subroutine its_edge_lifts()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(ground_event_type), allocatable :: events(:)
        type(contact_type), allocatable :: zones(:)
        type(error_type), allocatable :: error
        real(wp), allocatable :: x(:), motion(:)

        call tipped(model)
        model%loads = [uniform_load(5.0_wp, 0.0_wp, 12.0_wp, case=gapbeam_dead), point_force(60.0_wp, x=0.0_wp)]
        call prepare_model(model, beam, error)
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, "it stands")
        call check(size(events) == 1, "one event")
        call check(all([events(1)%support, events(1)%foundation, events(1)%change] == [0, 1, gapbeam_leaves]), "the end leaves")
        call check_close([events(1)%factor, events(1)%x], [0.5_wp, 12.0_wp], "at half the force")
        call get_contact(beam, result, zones, error)
        call check_close([zones(1)%to, zones(1)%resultant], [9.0_wp, 120.0_wp], "the state at the end of the path")
        model%loads(2) = point_force(-100.0_wp, x=6.0_wp)
        call replace_loads(beam, model%loads, error)
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_no_equilibrium, "it is lifted off")
        call check_close(result%factor, 0.6_wp, "where the load is its weight")
        allocate (x(count_nodes(beam)), motion(count_nodes(beam)))
        call get_motion(beam, result, x, motion, error)
        call check(all(abs(motion + 1.0_wp) < 1e-12_wp), "as a whole")
        call follow_ground(beam, 0.0_wp, options_type(), events, result, error)
        call check(error%code == gapbeam_bad_input, "no way to go")
        model%foundations = [foundation_type ::]
        model%supports = [support_type(node=0), support_type(node=1)]
        call prepare_model(model, beam, error)
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "follow_load") > 0, "no ground")
    end subroutine its_edge_lifts

    !> A rigid bar turns about its left end on ground that rises with 7000 to 0.01, falls with 1000 to 0.03, and stays: it bears
    !> most where its tip is at 0.01*(1 + 7000/1000)**(1/3) = 0.02, a force of 60 there
    subroutine its_force_falls()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(ground_event_type), allocatable :: events(:)
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 1)
        real(wp), allocatable :: x(:), motion(:)

        model%spans = [span_type(2.0_wp, EI=gapbeam_infinity)]
        model%supports = [support_type(node=0)]
        model%foundations = [foundation_type(side=gapbeam_below)]
        model%ground_law = [ground_law_point_type(1, 0.01_wp, 70.0_wp), ground_law_point_type(1, 0.03_wp, 50.0_wp), &
                            ground_law_point_type(1, 0.1_wp, 50.0_wp)]
        model%loads = [point_force(100.0_wp, x=2.0_wp)]
        call prepare_model(model, beam, error)
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_no_equilibrium, "it gives way")
        call check(abs(result%factor - 0.6_wp) < 1e-11_wp, "at the peak")
        allocate (x(count_nodes(beam)), motion(count_nodes(beam)))
        call get_motion(beam, result, x, motion, error)
        call check(abs(motion(2) - 1.0_wp) < 1e-12_wp .and. abs(motion(1)) < 1e-12_wp, "it goes down")
        call check(size(events) == 1, "the ground begins to fall under its tip")
        call check_close(events(1)%factor, 7.0_wp/15, "there")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_no_equilibrium, "all of the force")
        model%loads(1)%value = 157.0_wp/2.7_wp
        call replace_loads(beam, model%loads, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, "a little less")
        call get_fields(beam, result, [2.0_wp], fields, error)
        call check(abs(fields(1, 1) - 0.015_wp) < 1e-14_wp, "where the tip is by hand")
    end subroutine its_force_falls

    !> Everything that cannot be had
    subroutine everything_refused()
        type(model_type) :: model
        type(prepared_type) :: beam, other, none
        type(result_type) :: result
        type(history_type) :: history
        type(event_type), allocatable :: events(:)
        type(contact_type), allocatable :: zones(:)
        type(free_span_type), allocatable :: spans(:)
        type(error_type), allocatable :: error
        real(wp) :: pressure(2), value(2), x(2)

        call tipped(model)
        call get_contact(none, result, zones, error)
        call check(error%code == gapbeam_not_prepared, "no beam")
        call prepare_model(model, beam, error)
        call get_free_spans(beam, result, spans, error)
        call check(error%code == gapbeam_not_prepared, "nothing solved")
        call get_pressure_extremes(beam, result, value, x, error)
        call check(error%code == gapbeam_not_prepared, "and no extremes")
        call follow_load(beam, 1.0_wp, options_type(), events, result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "follow_ground") > 0, "events")
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "both ways") > 0, "histories")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_pressure(beam, result, [1.0_wp], pressure, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "2 entries, expected 1") > 0, "array too long")
        call get_pressure(beam, result, [1.0_wp, 13.0_wp], pressure, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "outside the beam") > 0, "off the beam")
        model%foundations(1)%k = 6.0_wp
        call prepare_model(model, other, error)
        call get_contact(other, result, zones, error)
        call check(error%code == gapbeam_not_prepared .and. index(error%message, "another beam") > 0, "a result on other ground")
        model%supports = [support_type(x=2.0_wp, side=gapbeam_below, unloading=gapbeam_plastic)]
        model%law = [law_point_type(1, 0.1_wp, 1.0_wp), law_point_type(1, 1.0_wp, 1.0_wp)]
        call prepare_model(model, other, error)
        call solve_beam(other, 1.0_wp, options_type(), result, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "follow_history") > 0, "a law that keeps a set")
        model%foundations(1)%side = 3
        call prepare_model(model, other, error)
        call check(error%code == gapbeam_bad_input .and. error%table == 6 .and. error%entry == 1 .and. error%key == "side", &
                   "no such side")
    end subroutine everything_refused

end program test_api_ground
