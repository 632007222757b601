!> Links along the beam and hinges with a stiffness, by the module gapbeam alone: friction, stops with gaps, links that yield
program test_api_along
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use testing, only: check, finish
    use gapbeam, only: model_type, span_type, support_type, law_point_type, prepared_type, options_type, result_type, error_type, &
        history_type, uniform_load, axial_force, temperature_load, support_movement, prepare_model, follow_history, solve_on_path, &
        solve_beam, get_supports, get_friction, get_fields, count_supports, gapbeam_axial, gapbeam_left, gapbeam_both, &
        gapbeam_dead, gapbeam_plastic, gapbeam_infinity, gapbeam_limit_stop, gapbeam_slips, gapbeam_sticks, gapbeam_closes, &
        gapbeam_mechanism, gapbeam_bad_input, gapbeam_indeterminate, section_type, ground_event_type, follow_ground
    implicit none
    real(wp), parameter :: EA = 1000.0_wp, strain = 0.05_wp, length = 4.0_wp
    integer :: status

    call friction_slips_and_sticks()
    call stops_and_links_that_yield()
    call what_nothing_holds()
    call hinges_with_a_stiffness()
    call ground_along_the_beam()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A bar with its own weight of 8 a length that gets warm
    function warm_bar() result(model)
        type(model_type) :: model

        allocate (model%spans, source=[span_type(length, EI=1e3_wp, EA=EA)])
        allocate (model%supports, &
                  source=[support_type(node=0), support_type(node=1), support_type(node=0, direction=gapbeam_axial)])
        allocate (model%loads, source=[uniform_load(8.0_wp, from=0.0_wp, to=length, case=gapbeam_dead), &
                                       temperature_load(0.0_wp, strain, from=0.0_wp, to=length)])
    end function warm_bar

    !> Is a number another one, but for rounding
    pure function near(a, b) result(so)
        real(wp), intent(in) :: a, b
        logical :: so

        so = abs(a - b) <= 1e-13_wp*max(abs(a), abs(b), 1e-3_wp)
    end function near

    !> Held at its left end, on friction at its right one: hot, then cold
    subroutine friction_slips_and_sticks()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(history_type) :: history
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: limit = 0.3_wp*16.0_wp, full = EA*strain
        real(wp) :: force(3), slip(3)
        integer :: slides(3)

        model = warm_bar()
        model%supports(2)%friction = 0.3_wp
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp, 0.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error), "friction: followed")
        if (allocated(error)) return
        call check(all(history%events%change == [gapbeam_slips, gapbeam_sticks, gapbeam_slips]), "friction: what happens")
        call check(near(history%events(1)%factor, limit/full), "friction: where it slips")
        call check(near(history%events(3)%factor, 1 - 2*limit/full), "friction: where it slips back")
        call solve_on_path(beam, history, 0.0_wp, result, error)
        call check(.not. allocated(error), "friction: the state when it is cold")
        call get_friction(beam, result, force, slip, slides, error)
        call check(near(force(2), limit) .and. near(slip(2), length*limit/EA), "friction: force and slip when it is cold")
        call check(all(slides == [0, -1, 0]), "friction: it slides to the left")
        call get_friction(beam, result, force(:2), slip(:2), slides(:2), error)
        call check(allocated(error), "friction: arrays of another size")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(allocated(error), "friction: a state without its path")
    end subroutine friction_slips_and_sticks

    !> A stop with a gap that is jacked, and a link that yields either way; with bending that feels it, and without
    subroutine stops_and_links_that_yield()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(history_type) :: history
        type(ground_event_type), allocatable :: events(:)
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: reaction(4), deflection(4), opening(4), couple(4)
        integer :: condition(4)

        model = warm_bar()
        model%supports = [model%supports, support_type(node=1, direction=gapbeam_axial, side=gapbeam_left, gap=0.1_wp)]
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(.not. allocated(error), "stop that bends: solved")
        call check(near(reaction(4), -EA*(strain - 0.1_wp/length)), "stop that bends: its force")
        call check(size(events) == 1 .and. all(events%support == 4) .and. all(events%change == gapbeam_closes), "stop that bends")
        call check(near(events(1)%factor, 0.1_wp/(strain*length)), "stop that bends: where it closes")
        call solve_beam(beam, 0.25_wp, options_type(), result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(near(opening(4), 0.05_wp), "stop that bends: how far it is open")
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(has_code(error, gapbeam_bad_input), "stop that bends: a history is for first_order")
        model%first_order = .true.
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        if (.not. allocated(error)) call solve_on_path(beam, history, 1.0_wp, result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(.not. allocated(error), "stop: solved")
        call check(near(reaction(4), -EA*(strain - 0.1_wp/length)), "stop: its force")
        call check(size(history%events) == 1 .and. all(history%events%change == gapbeam_closes), "stop: it closes")
        call solve_on_path(beam, history, 0.25_wp, result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(near(opening(4), 0.05_wp), "stop: how far it is open")
        model%loads = [model%loads(1), support_movement(-0.3_wp, 4)]
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        if (.not. allocated(error)) call solve_on_path(beam, history, 1.0_wp, result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(near(reaction(4), -EA*0.2_wp/length), "stop: jacked")
        model = warm_bar()
        model%first_order = .true.
        model%supports = [model%supports, support_type(node=1, direction=gapbeam_axial, side=gapbeam_both, &
                                                       unloading=gapbeam_plastic)]
        model%law = [law_point_type(4, 0.02_wp, 3.0_wp), law_point_type(4, 1.0_wp, 3.0_wp)]
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp, 0.0_wp], gapbeam_limit_stop, history, error)
        if (.not. allocated(error)) call solve_on_path(beam, history, 0.0_wp, result, error)
        if (.not. allocated(error)) call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call check(.not. allocated(error), "link: solved")
        call check(near(reaction(4), 3.0_wp), "link: it has yielded back")
    end subroutine stops_and_links_that_yield

    !> The load that friction alone does not bear, and two rigid holds of a rigid beam
    subroutine what_nothing_holds()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(history_type) :: history
        type(error_type), allocatable :: error

        model = warm_bar()
        model%supports = [support_type(node=0, friction=0.5_wp), support_type(node=1)]
        model%loads = [model%loads(1), axial_force(10.0_wp, x=length)]
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error), "sliding: followed")
        call check(history%ending == gapbeam_mechanism, "sliding: nothing holds it")
        call check(near(history%limits(1)%factor, 0.8_wp), "sliding: at its limit")
        model%supports(2)%friction = 0.5_wp
        model%spans(1)%EA = gapbeam_infinity
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(has_code(error, gapbeam_indeterminate), "two of a rigid beam cannot be told apart")
        model%supports(2)%friction = -1.0_wp
        call prepare_model(model, beam, error)
        call check(has_code(error, gapbeam_bad_input), "a coefficient below zero")
    end subroutine what_nothing_holds

    !> In the middle of a beam between clamps: M = q L^2/24/(1 + EI/(c L))
    subroutine hinges_with_a_stiffness()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: stiffness(4) = [1e-7_wp, 1.0_wp, 600.0_wp, 1e20_wp]
        real(wp) :: left(6, 1), right(6, 1), expected
        integer :: k

        do k = 1, size(stiffness)
            model%spans = [span_type(2.0_wp, EI=1e3_wp), span_type(2.0_wp, EI=1e3_wp)]
            model%hinges = [2.0_wp]
            model%hinge_stiffness = [stiffness(k)]
            model%supports = [support_type(node=0, rotation=gapbeam_infinity), support_type(node=2, rotation=gapbeam_infinity)]
            model%loads = [uniform_load(3.0_wp, from=0.0_wp, to=length)]
            call prepare_model(model, beam, error)
            if (.not. allocated(error)) call solve_beam(beam, 1.0_wp, options_type(), result, error)
            if (.not. allocated(error)) call get_fields(beam, result, [2.0_wp], left, error, from_left=.true.)
            if (.not. allocated(error)) call get_fields(beam, result, [2.0_wp], right, error)
            call check(.not. allocated(error), "hinge: solved")
            if (allocated(error)) return
            expected = 3.0_wp*length**2/24/(1 + 1e3_wp/(stiffness(k)*length))
            call check(abs(right(3, 1) - expected) <= 1e-13_wp*2, "hinge: its moment")
            call check(near(left(2, 1) - right(2, 1), expected/stiffness(k)), "hinge: its rotation")
        end do
        model%hinge_stiffness = [1e-9_wp]
        call prepare_model(model, beam, error)
        call check(has_code(error, gapbeam_bad_input), "hinge: so soft that it is free")
        model%hinge_stiffness = [-1.0_wp]
        call prepare_model(model, beam, error)
        call check(has_code(error, gapbeam_bad_input), "hinge: a stiffness below zero")
    end subroutine hinges_with_a_stiffness

    !> Is there an error with this code
    pure function has_code(error, code) result(has)
        type(error_type), allocatable, intent(in) :: error
        integer, intent(in) :: code
        logical :: has

        has = allocated(error)
        if (has) has = error%code == code
    end function has_code

    !> Ground that rubs: warm, the ends slide as far as friction makes EA alpha dT; cold again, half of that slides back
    subroutine ground_along_the_beam()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(history_type) :: history
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: full = EA*strain, friction = 40.0_wp, anchor = full/friction
        real(wp) :: fields(6, 3)

        model = warm_bar()
        model%supports = model%supports(:2)
        model%sections = [section_type(friction=friction)]
        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call follow_history(beam, [1.0_wp, 0.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error), "ground along the beam: followed")
        if (allocated(error)) return
        call solve_on_path(beam, history, 0.0_wp, result, error)
        call get_fields(beam, result, [0.0_wp, anchor/2, length/2], fields, error)
        call check(near(fields(5, 2), full/2) .and. abs(fields(5, 3)) < 1e-12_wp*full, "ground along the beam: what stays")
        call check(near(fields(6, 1), -friction*anchor**2/(4*EA)), "ground along the beam: where the end stays")
        call solve_on_path(beam, history, 1.0_wp, result, error)
        call get_fields(beam, result, [0.0_wp, anchor, length/2], fields, error)
        call check(near(fields(5, 2), -full) .and. near(fields(5, 3), -full), "ground along the beam: held in full")
    end subroutine ground_along_the_beam

end program test_api_along
