!> Axial forces that bending feels, by the module gapbeam: closed forms, a column with a stop, buckling, frequencies, refusals
program test_api_modes
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, support_type, foundation_type, prepared_type, options_type, result_type, error_type, &
        ground_event_type, event_type, cases_type, history_type, point_force, uniform_load, prepare_model, solve_beam, &
        get_supports, get_fields, get_quantities, get_quantity_extremes, get_motion, get_modes, get_mode_shape, get_buckling, &
        get_pressure, follow_ground, follow_load, follow_history, prepare_cases, solve_cases, gapbeam_buckling, &
        gapbeam_vibration, gapbeam_of_transverse, gapbeam_of_shear, gapbeam_below, gapbeam_closes, gapbeam_dead, &
        gapbeam_limit_stop, gapbeam_solved, gapbeam_buckles, gapbeam_bad_input, gapbeam_not_prepared, &
        gapbeam_status_message, gapbeam_axial, axial_force, axial_uniform_load, replace_loads, count_supports
    implicit none
    real(wp), parameter :: euler = acos(-1.0_wp)**2
    integer :: status

    call simple_beam()
    call stop_under_tension()
    call column_with_a_stop()
    call column_with_a_spring()
    call it_buckles()
    call along_the_load()
    call axial_loads()
    call frequencies()
    call refused()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Length, stiffness and load 1
    subroutine simple_beam()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: u(3) = [0.001_wp, 1.0_wp, 3.0_wp], &
                               w(3) = [0.013020832009548745_wp, 0.011818883970073909_wp, 0.0067913090733614872_wp], &
                               moment(3) = [0.124999986979168_wp, 0.113181116029926_wp, 0.0638782183397466_wp]
        real(wp) :: fields(6, 1), values(2, 1), value(2, 1), x(2, 1)
        integer :: i

        do i = 1, size(u)
            model%spans = [span_type(1.0_wp, EI=1.0_wp, N=u(i)**2)]
            model%supports = [support_type(node=0), support_type(node=1)]
            model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=1.0_wp)]
            call prepare_model(model, beam, error)
            call solve_beam(beam, 1.0_wp, options_type(), result, error)
            call check(.not. allocated(error) .and. result%status == gapbeam_solved .and. result%unique, "one state under tension")
            call get_fields(beam, result, [0.5_wp], fields, error)
            call check_close(fields(1, 1), w(i), "deflection", relative=1e-14_wp)
            call check_close(fields(3, 1), moment(i), "moment", relative=1e-13_wp)
            call get_quantities(beam, result, [gapbeam_of_transverse, gapbeam_of_shear], [0.0_wp], values, error)
            call check_close(values(1, 1), 0.5_wp, "what the support balances", relative=1e-14_wp)
            call get_fields(beam, result, [0.0_wp], fields, error)
            call check_close(values(2, 1), 0.5_wp - u(i)**2*fields(2, 1), "and the shear", relative=1e-13_wp)
            call get_quantity_extremes(beam, result, [gapbeam_of_transverse], value, x, error)
            call check_close([value(:, 1), x(:, 1)], [0.5_wp, -0.5_wp, 0.0_wp, 1.0_wp], "extremes", relative=1e-14_wp)
        end do
        call get_pressure(beam, result, [0.5_wp], value(:1, 1), error)
        call check(.not. allocated(error) .and. abs(value(1, 1)) <= 0.0_wp, "no ground")
    end subroutine simple_beam

    !> Length 10, stiffness 1e4, load 10
    subroutine stop_under_tension()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        real(wp), parameter :: u(2) = [1.0_wp, 3.0_wp], force(2) = [59.75731044135905_wp, 57.111825264558784_wp]
        real(wp) :: reaction(3)
        integer :: i

        do i = 1, size(u)
            model%spans = [span_type(10.0_wp, EI=1e4_wp, N=u(i)**2*100)]
            model%supports = [support_type(node=0), support_type(x=5.0_wp, side=gapbeam_below, gap=0.005_wp), support_type(node=1)]
            model%loads = [uniform_load(10.0_wp, from=0.0_wp, to=10.0_wp)]
            call solve_model(model, beam, result)
            reaction = reactions(beam, result)
            call check_close(reaction(2), force(i), "stop", relative=1e-14_wp)
        end do
    end subroutine stop_under_tension

    !> Length, stiffness and load 1, a stop at midspan below a gap of 0.02
    subroutine column(compression, model)
        !> In parts of the Euler load
        real(wp), intent(in) :: compression
        type(model_type), intent(out) :: model

        model%spans = [span_type(1.0_wp, EI=1.0_wp, N=-compression*euler)]
        model%supports = [support_type(node=0), support_type(x=0.5_wp, side=gapbeam_below, gap=0.02_wp), support_type(node=1)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=1.0_wp)]
    end subroutine column

    !> Prepare and solve it
    subroutine solve_model(model, beam, result)
        type(model_type), intent(in) :: model
        type(prepared_type), intent(out) :: beam
        type(result_type), intent(inout) :: result
        type(error_type), allocatable :: error

        call prepare_model(model, beam, error)
        if (.not. allocated(error)) call solve_beam(beam, 1.0_wp, options_type(), result, error)
        if (allocated(error)) call check(.false., error%message)
    end subroutine solve_model

    !> Reactions of the supports
    function reactions(beam, result) result(reaction)
        type(prepared_type), intent(in) :: beam
        type(result_type), intent(in) :: result
        real(wp) :: reaction(count_supports(beam))
        type(error_type), allocatable :: error
        real(wp), dimension(size(reaction)) :: deflection, opening, couple
        integer :: condition(size(reaction))

        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        if (allocated(error)) call check(.false., error%message)
    end function reactions

    !> Its states and the factors at which these buckle
    subroutine column_with_a_stop()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: compression(3) = [0.5_wp, 0.9_wp, 2.0_wp], &
                               force(3) = [0.14714005862549203_wp, 0.53807030793317657_wp, 1.6440875059318176_wp]
        real(wp) :: reaction(3), factors(2)
        integer :: i, found

        do i = 1, size(force)
            call column(compression(i), model)
            call solve_model(model, beam, result)
            call check(result%status == gapbeam_solved .and. (result%unique .eqv. compression(i) < 1), "the only state below Euler")
            reaction = reactions(beam, result)
            call check_close(reaction(2), force(i), "stop", relative=1e-13_wp)
            call get_modes(beam, result, gapbeam_buckling, factors, found, error)
            call check(.not. allocated(error) .and. found == 2, "two modes")
            call check_close(factors(1), 4/compression(i), "in two waves", relative=1e-14_wp)
        end do
        call get_modes(beam, result, gapbeam_vibration, factors, found, error)
        call check(.not. allocated(error) .and. found == 0, "no frequency without mass")
    end subroutine column_with_a_stop

    !> A spring at midspan of an unloaded column
    subroutine column_with_a_spring()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), parameter :: spring(2) = [10.0_wp, 50.0_wp], factor(2) = [1.2046188484569489_wp, 2.0075802309154398_wp]
        real(wp), allocatable :: x(:), deflection(:), moment(:, :)
        real(wp) :: factors(1)
        integer :: i, found

        do i = 1, size(spring)
            call column(1.0_wp, model)
            model%supports(2) = support_type(x=0.5_wp, stiffness=spring(i))
            call solve_model(model, beam, result)
            call get_modes(beam, result, gapbeam_buckling, factors, found, error)
            call check(.not. allocated(error) .and. found == 1, "a factor")
            call check_close(factors(1), factor(i), "of the spring", relative=1e-14_wp)
        end do
        call get_mode_shape(beam, result, gapbeam_buckling, factors(1), 8, x, deflection, moment, error)
        call check(.not. allocated(error) .and. size(x) == 17 .and. size(moment, 2) == 17, "places of its shape")
        call check_close(x(9), 0.5_wp, "midspan")
        call check_close([deflection(1), deflection(9), deflection(17)], [0.0_wp, 1.0_wp, 0.0_wp], "shape", absolute=1e-12_wp)
        ! Statics of the left half: the moment is that of the axial force less half the spring's force times the distance
        call check_close(moment(1, 9), factors(1)*euler - spring(2)/4, "moment", relative=1e-10_wp)
    end subroutine column_with_a_spring

    !> Four times Euler's load is too much with the stop
    subroutine it_buckles()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), allocatable :: x(:), deflection(:)
        real(wp) :: share, motion(3), fields(6, 1)

        call column(2.0_wp, model)
        call solve_model(model, beam, result)
        call get_buckling(beam, result, share, x, deflection, error)
        call check(error%code == gapbeam_not_prepared .and. .not. allocated(x), "it stands")
        call column(5.0_wp, model)
        call solve_model(model, beam, result)
        call check(result%status == gapbeam_buckles, "it buckles")
        call check(gapbeam_status_message(gapbeam_buckles) == "buckles: the beam does not bear its axial forces", "in words")
        call get_buckling(beam, result, share, x, deflection, error)
        call check(.not. allocated(error), "how")
        call check_close(share, 0.8_wp, "share", relative=1e-12_wp)
        call check(size(x) == size(deflection) .and. size(x) >= 17, "places")
        call check_close(deflection*sign(1.0_wp, deflection(2)), sin(2*acos(-1.0_wp)*x), "in two waves", absolute=1e-9_wp)
        call check_close(maxval(abs(deflection)), 1.0_wp, "the largest is 1")
        call get_motion(beam, result, x(:3), motion, error)
        call check(error%code == gapbeam_not_prepared, "no free motion")
        call get_fields(beam, result, [0.5_wp], fields, error)
        call check(error%code == gapbeam_not_prepared, "and no fields")
    end subroutine it_buckles

    !> From event to event the axial force stays what it is
    subroutine along_the_load()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(event_type), allocatable :: others(:)
        type(ground_event_type), allocatable :: events(:)
        real(wp), allocatable :: x(:), deflection(:)
        real(wp) :: share, reaction(3)

        call column(0.5_wp, model)
        call solve_model(model, beam, result)
        call follow_load(beam, 1.0_wp, options_type(), others, result, error)
        call check(error%code == gapbeam_bad_input .and. error%message == "the beam has an axial force N: use follow_ground", &
                   "not followed without it")
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(.not. allocated(error) .and. size(events) == 1, "one event")
        call check(events(1)%support == 2 .and. events(1)%change == gapbeam_closes, "the stop closes")
        reaction = reactions(beam, result)
        call check_close(reaction(2), 0.14714005862549203_wp, "stop", relative=1e-13_wp)
        ! Lifted off the stop it buckles upwards
        call column(2.0_wp, model)
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=1.0_wp, case=gapbeam_dead), point_force(-3.0_wp, x=0.5_wp)]
        call solve_model(model, beam, result)
        call check(result%status == gapbeam_buckles, "it buckles")
        call follow_ground(beam, 1.0_wp, options_type(), events, result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_buckles, "on its way")
        call check_close(result%factor, 1.6440875059318176_wp/3, "where the stop has nothing to push any more", relative=1e-12_wp)
        call get_buckling(beam, result, share, x, deflection, error)
        call check_close(share, 0.5_wp, "share", relative=1e-9_wp)
        call check_close(abs(deflection), sin(acos(-1.0_wp)*x), "in one wave", absolute=1e-8_wp)
    end subroutine along_the_load

    !> That bending feels, of first order where that is asked for and where they cannot; and a given force that grows
    subroutine axial_loads()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(cases_type) :: cases
        type(event_type), allocatable :: events(:)
        type(ground_event_type), allocatable :: changes(:)
        type(error_type), allocatable :: error
        real(wp) :: reaction(4), of_cases(4, 1)
        integer :: status(1)

        call column(0.0_wp, model)
        model%supports = [model%supports, support_type(node=0, direction=gapbeam_axial)]
        model%loads = [model%loads, axial_force(-2*euler, node=1)]
        call solve_model(model, beam, result)
        reaction = reactions(beam, result)
        call check_close(reaction(2), 1.6440875059318176_wp, "stop", relative=1e-13_wp)
        call check(.not. result%unique, "the load of the stop bends it")
        call prepare_cases(beam, cases, error)
        call solve_cases(beam, cases, reshape([1.0_wp, 1.0_wp], [2, 1]), status, error, reaction=of_cases)
        call check(.not. allocated(error) .and. status(1) == gapbeam_solved, "cases")
        call check_close(of_cases(2, 1), 1.6440875059318176_wp, "stop in a case", relative=1e-13_wp)
        call follow_load(beam, 1.0_wp, options_type(), events, result, error)
        call check(error%message == "the beam has axial loads that bend it: use follow_ground, or set first_order", "the path too")
        call follow_ground(beam, 1.0_wp, options_type(), changes, result, error)
        call check(.not. allocated(error) .and. size(changes) == 1, "the other one is not")
        call check_close(changes(1)%factor, 0.37694943478542292_wp, "where it touches", relative=1e-13_wp)
        ! Other loads, and none that presses
        model%loads(2)%value = -5*euler
        call replace_loads(beam, model%loads, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(result%status == gapbeam_buckles, "it buckles")
        call replace_loads(beam, model%loads(:1), error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        reaction = reactions(beam, result)
        call check_close(reaction(1), 0.5_wp, "without", relative=1e-14_wp)
        ! Of first order: where that is asked for, and beside what is not available
        model%first_order = .true.
        call solve_model(model, beam, result)
        reaction = reactions(beam, result)
        call check_close([reaction(1), reaction(2), reaction(4)], [0.5_wp, 0.0_wp, 5*euler], "first order", relative=1e-14_wp)
        model%first_order = .false.
        model%loads = [model%loads, axial_uniform_load(1.0_wp, from=0.0_wp, to=1.0_wp)]
        call solve_model(model, beam, result)
        call check(result%status == gapbeam_buckles, "beside a load along the beam")
        model%spans(1)%GA = 1e3_wp
        call solve_model(model, beam, result)
        reaction = reactions(beam, result)
        call check_close(reaction(1), 0.5_wp, "beside that and shear", relative=1e-14_wp)
        ! What is given may grow
        call column(2.0_wp, model)
        model%N_grows = .true.
        call solve_model(model, beam, result)
        call follow_ground(beam, 1.0_wp, options_type(), changes, result, error)
        call check_close(changes(1)%factor, 0.37694943478542292_wp, "where it touches", relative=1e-13_wp)
    end subroutine axial_loads

    !> Two spans with the middle support closed and open; a free span between ground
    subroutine frequencies()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp), allocatable :: x(:), deflection(:), moment(:, :)
        real(wp) :: omega(2)
        integer :: found

        model%spans = [span_type(1.0_wp, EI=1.0_wp, mass=1.0_wp), span_type(1.0_wp, EI=1.0_wp, mass=1.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below), support_type(node=2)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=2.0_wp)]
        call solve_model(model, beam, result)
        call get_modes(beam, result, gapbeam_vibration, omega, found, error)
        call check(.not. allocated(error) .and. found == 2, "two frequencies")
        call check_close(omega, [9.869604401089_wp, 15.41820571698_wp], "closed", relative=1e-12_wp)
        call get_mode_shape(beam, result, gapbeam_vibration, omega(1), 4, x, deflection, moment, error)
        call check_close(deflection, deflection(3)*sin(acos(-1.0_wp)*x), "two waves", absolute=1e-9_wp)
        call get_modes(beam, result, gapbeam_buckling, omega, found, error)
        call check(.not. allocated(error) .and. found == 0, "nothing compressed")
        call solve_beam(beam, -1.0_wp, options_type(), result, error)
        call get_modes(beam, result, gapbeam_vibration, omega, found, error)
        call check_close(omega, [2.467401100272_wp, 9.869604401089_wp], "open", relative=1e-12_wp)

        model%spans = [span_type(24.0_wp, EI=1.0_wp, mass=1.0_wp)]
        model%supports = [support_type(x=0.0_wp), support_type(x=24.0_wp)]
        model%foundations = [foundation_type(to=10.0_wp, k=100.0_wp), foundation_type(from=14.0_wp, k=100.0_wp)]
        model%loads = [uniform_load(1.0_wp, from=0.0_wp, to=24.0_wp)]
        call solve_model(model, beam, result)
        call get_modes(beam, result, gapbeam_vibration, omega, found, error)
        call check_close(omega, [0.923729504793_wp, 2.4934881405_wp], "between ground", relative=1e-10_wp)
        model%spans(1)%N = 5.0_wp
        call solve_model(model, beam, result)
        call get_modes(beam, result, gapbeam_vibration, omega, found, error)
        call check_close(omega, [1.76512387529_wp, 3.80941611761_wp], "and under tension", relative=1e-10_wp)
        ! Ground that resists slopes does what tension does
        model%spans(1)%N = 0.0_wp
        model%foundations = [model%foundations, foundation_type(k=1e-11_wp, shear=5.0_wp)]
        call solve_model(model, beam, result)
        call get_modes(beam, result, gapbeam_vibration, omega, found, error)
        call check_close(omega, [1.76512387529_wp, 3.80941611761_wp], "or a second parameter", relative=1e-10_wp)
    end subroutine frequencies

    !> What is refused, and in which words
    subroutine refused()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(history_type) :: history
        real(wp), allocatable :: x(:), deflection(:), moment(:, :)
        real(wp) :: values(1)
        integer :: found

        call column(0.5_wp, model)
        model%spans(1)%mass = -1.0_wp
        call prepare_model(model, beam, error)
        call check(error%code == gapbeam_bad_input .and. error%key == "mass" .and. error%entry == 1, "a negative mass")
        call column(0.5_wp, model)
        call prepare_model(model, beam, error)
        call get_modes(beam, result, gapbeam_buckling, values, found, error)
        call check(error%code == gapbeam_not_prepared, "nothing solved")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_modes(beam, result, 3, values, found, error)
        call check(error%code == gapbeam_bad_input .and. error%key == "kind", "no such kind")
        call get_mode_shape(beam, result, gapbeam_buckling, -1.0_wp, 8, x, deflection, moment, error)
        call check(error%code == gapbeam_bad_input .and. error%key == "value", "no such mode")
        call get_mode_shape(beam, result, gapbeam_buckling, 8.0_wp, 0, x, deflection, moment, error)
        call check(error%code == gapbeam_bad_input .and. error%key == "parts", "no parts")
        call get_mode_shape(beam, result, gapbeam_vibration, 8.0_wp, 8, x, deflection, moment, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "no mass") > 0, "no mass")
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(.not. allocated(error) .and. size(history%events) == 1, "a history of a column that is stable without its stop")
        call column(2.0_wp, model)
        call prepare_model(model, beam, error)
        call follow_history(beam, [1.0_wp], gapbeam_limit_stop, history, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "(N below 0) is stable") > 0, "none of another")
        call column(0.0_wp, model)
        call solve_model(model, beam, result)
        call get_mode_shape(beam, result, gapbeam_buckling, 1.0_wp, 8, x, deflection, moment, error)
        call check(error%code == gapbeam_bad_input, "bending that feels no axial force")
    end subroutine refused

end program test_api_modes
