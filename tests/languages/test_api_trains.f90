!> Trains by the module gapbeam alone: a lift-off in closed form, both directions, what is refused
program test_api_trains
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use, intrinsic :: ieee_arithmetic, only: ieee_get_flag, ieee_set_flag, ieee_inexact
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, support_type, section_type, foundation_type, uniform_load, prepared_type, &
        options_type, result_type, error_type, moving_train_type, passing_type, train_extreme_type, follow_train, &
        get_train_extremes, get_train_curves, get_train_quantity_extremes, get_train_quantity_curves, gapbeam_of_curvature, &
        gapbeam_of_shear, gapbeam_of_pressure, prepare_model, replace_loads, solve_beam, get_supports, point_force, &
        support_movement, gapbeam_below, gapbeam_dead, gapbeam_infinity, gapbeam_opens, gapbeam_closes, gapbeam_bad_input, &
        gapbeam_not_prepared, gapbeam_no_equilibrium
    implicit none
    integer :: status

    call a_far_end_lifts()
    call it_tips()
    call everything_refused()
    call on_the_ground()
    call over_a_moved_support()
    call over_tapers_and_joints()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two spans of 1 with a weight of 1 on supports from below
    subroutine two_spans(model)
        type(model_type), intent(out) :: model

        model%spans = [span_type(1.0_wp, EI=1.0_wp), span_type(1.0_wp, EI=1.0_wp)]
        model%supports = [support_type(node=0, side=gapbeam_below), support_type(node=1, side=gapbeam_below), &
                          support_type(node=2, side=gapbeam_below)]
        model%loads = [uniform_load(1.0_wp, 0.0_wp, 2.0_wp, case=gapbeam_dead)]
    end subroutine two_spans

    !> The far end lifts where P s (1 - s**2) > 3/2, by P s (1 - s**2)/6 - 1/4
    subroutine a_far_end_lifts()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(train_extreme_type) :: fields(2, 4), supports(2, 4, 3)
        real(wp) :: value(2, 4, 2), position(2, 4, 2), r(3), w(3), opening(3), couple(3)
        integer :: condition(3)

        call two_spans(model)
        call prepare_model(model, beam, error)
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[8.0_wp], to=1.0_wp), passing, error)
        call check(.not. allocated(error), "it passes")
        call check(all(passing%events%change == [gapbeam_opens, gapbeam_closes]) .and. all(passing%events%support == 3), "events")
        call check_close(passing%events%position, [0.19490392008291112_wp, 0.88819977685765608_wp], "where", relative=1e-14_wp)
        call check(size(passing%gaps) == 0 .and. passing%solves > 0, "no gap")
        call get_train_extremes(beam, passing, fields, supports, error)
        call check_close([supports(1, 2, 3)%value, supports(1, 2, 3)%position], [0.26320023927966735_wp, 1/sqrt(3.0_wp)], &
                         "largest opening", relative=1e-9_wp)
        call check_close([fields(1, 3)%value, fields(1, 3)%x, fields(1, 3)%position], [32, 8, 8]/17.0_wp, "largest moment")
        call check_close(fields(2, 3)%value, -0.5_wp, "smallest moment")
        call get_train_curves(beam, passing, [8/17.0_wp, 1.0_wp], value, position, error)
        call check_close([value(1, 3, 1), value(2, 3, 2)], [32/17.0_wp, -0.5_wp], "curves")
        call check_close(position(1, 3, 1), 8/17.0_wp, "their positions", relative=1e-7_wp)
        ! EI is 1: curvature is the moment
        call get_train_quantity_extremes(beam, passing, [gapbeam_of_curvature, gapbeam_of_shear], fields(:, :2), error)
        call check_close([fields(1, 1)%value, fields(1, 1)%x, fields(1, 1)%position], [32, 8, 8]/17.0_wp, "largest curvature")
        call get_train_quantity_curves(beam, passing, [gapbeam_of_curvature], [8/17.0_wp, 1.0_wp], value(:, :1, :), &
                                       position(:, :1, :), error)
        call check_close([value(1, 1, 1), value(2, 1, 2)], [32/17.0_wp, -0.5_wp], "its curves")
        call get_train_quantity_extremes(beam, passing, [gapbeam_of_shear, gapbeam_of_pressure], fields(:, :2), error)
        call check(error%code == gapbeam_bad_input .and. error%entry == 2 .and. index(error%message, "pressure") > 0, "no ground")
        model%loads = [model%loads, point_force(8.0_wp, x=supports(1, 2, 3)%position)]
        call replace_loads(beam, model%loads, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, r, w, opening, couple, condition, error)
        call check_close(opening(3), supports(1, 2, 3)%value, "the state there")
        call get_train_extremes(beam, passing, fields, supports, error)
        call check(error%code == gapbeam_not_prepared, "other loads")
    end subroutine a_far_end_lifts

    !> A plank of 3 that overhangs by 1: a man of 5 tips it where 5 (s - 2) > 3/2; from the other side as well
    subroutine it_tips()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(error_type), allocatable :: error

        call two_spans(model)
        model%spans = [span_type(2.0_wp, EI=1.0_wp), span_type(1.0_wp, EI=1.0_wp)]
        model%supports = model%supports(:2)
        model%loads = [uniform_load(1.0_wp, 0.0_wp, 3.0_wp, case=gapbeam_dead)]
        call prepare_model(model, beam, error)
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[5.0_wp]), passing, error)
        call check(size(passing%gaps) == 1, "one gap")
        call check_close([passing%gaps(1)%from, passing%gaps(1)%to], [2.3_wp, 3.0_wp], "its ends")
        call check(passing%gaps(1)%reason == gapbeam_no_equilibrium, "it tips")
        call follow_train(beam, moving_train_type(distance=[0.0_wp, 0.4_wp], force=[0.0_wp, 5.0_wp], to_the_left=.true.), passing, &
                          error)
        call check(size(passing%gaps) == 1, "to the left too")
        call check_close([passing%gaps(1)%from, passing%gaps(1)%to], [1.9_wp, 2.6_wp], "with an axle behind")
    end subroutine it_tips

    !> A simple beam whose depth changes, with a joint: it is determinate, so P L/4 is its largest moment, and P its largest shear
    subroutine over_tapers_and_joints()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(error_type), allocatable :: error
        type(train_extreme_type) :: fields(2, 4), supports(2, 4, 2)
        type(moving_train_type) :: train

        train = moving_train_type(distance=[0.0_wp], force=[8.0_wp])
        model%spans = [span_type(2.0_wp, EI=1.0_wp)]
        model%supports = [support_type(node=0), support_type(node=1)]
        model%sections = [section_type(0.0_wp, 2.0_wp, EI=1.0_wp, EI_to=8.0_wp, EI_power=3)]
        call prepare_model(model, beam, error)
        call follow_train(beam, train, passing, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "with_trains") > 0, "a taper asks for it")
        model%with_trains = .true.
        call prepare_model(model, beam, error)
        call follow_train(beam, train, passing, error)
        call get_train_extremes(beam, passing, fields, supports, error)
        call check_close([fields(1, 3)%value, fields(1, 4)%value], [4.0_wp, 8.0_wp], "moment and shear", relative=1e-12_wp)
        deallocate (model%sections)
        model%hinges = [0.5_wp]
        model%hinge_stiffness = [3.0_wp]
        call prepare_model(model, beam, error)
        call follow_train(beam, train, passing, error)
        call get_train_extremes(beam, passing, fields, supports, error)
        call check_close(fields(1, 3)%value, 4.0_wp, "moment with a joint", relative=1e-12_wp)
    end subroutine over_tapers_and_joints

    !> What cannot be had
    subroutine everything_refused()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(error_type), allocatable :: error
        type(train_extreme_type) :: fields(2, 4), supports(2, 4, 3)
        real(wp) :: value(2, 4, 1), position(2, 4, 1)

        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[1.0_wp]), passing, error)
        call check(error%code == gapbeam_not_prepared, "no beam")
        call two_spans(model)
        call prepare_model(model, beam, error)
        call get_train_extremes(beam, passing, fields, supports, error)
        call check(error%code == gapbeam_not_prepared, "no train")
        call follow_train(beam, moving_train_type(), passing, error)
        call check(error%code == gapbeam_bad_input, "no axle")
        call follow_train(beam, moving_train_type(distance=[0.0_wp, 1.0_wp], force=[1.0_wp]), passing, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "as many forces") > 0, "another number of forces")
        call follow_train(beam, moving_train_type(distance=[-1.0_wp], force=[1.0_wp]), passing, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "distance(1)") > 0, "an axle before the first one")
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[gapbeam_infinity]), passing, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "force(1)") > 0, "an infinite force")
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[1.0_wp], from=2.0_wp, to=1.0_wp), passing, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "none") > 0, "no position")
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[1.0_wp]), passing, error)
        call get_train_extremes(beam, passing, fields, supports(:, :, :2), error)
        call check(error%code == gapbeam_bad_input, "an array too short")
        call get_train_curves(beam, passing, [2.5_wp], value, position, error)
        call check(error%code == gapbeam_bad_input .and. index(error%message, "outside the beam") > 0, "off the beam")
    end subroutine everything_refused

    !> A force on a long beam on ground that holds both ways: P/(4 b), P b/2 and P b/(2 k) below it, b = (k/4 EI)**(1/4); and from
    !> one end to the other of a beam on ground that cannot pull
    subroutine on_the_ground()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(error_type), allocatable :: error
        type(train_extreme_type) :: fields(2, 4), supports(2, 4, 1)
        real(wp), parameter :: b = (6.4_wp/400.0_wp)**0.25_wp
        real(wp) :: value(2, 4, 1), position(2, 4, 1)
        logical :: raised

        model%spans = [span_type(90.0_wp, EI=100.0_wp)]
        model%foundations = [foundation_type(k=6.4_wp)]
        call prepare_model(model, beam, error)
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[8.0_wp], from=44.5_wp, to=45.5_wp), passing, error)
        call check(.not. allocated(error), "it passes on the ground")
        call check(size(passing%events) == 0 .and. size(passing%gaps) == 0, "nothing changes")
        call get_train_extremes(beam, passing, fields, supports(:, :, :0), error)
        call check_close([fields(1, 3)%value, fields(1, 1)%value], [2/b, 4*b/6.4_wp], "under the force", relative=1e-13_wp)
        call get_train_quantity_extremes(beam, passing, [gapbeam_of_pressure], fields(:, :1), error)
        call check_close(fields(1, 1)%value, 4*b, "pressure", relative=1e-13_wp)
        call ieee_set_flag(ieee_inexact, .false.)
        call get_train_quantity_extremes(beam, passing, [gapbeam_of_curvature], fields(:, :1), error)
        call ieee_get_flag(ieee_inexact, raised)
        call check(.not. raised, "the caller's flags are as they were")
        call get_train_curves(beam, passing, [45.1_wp], value, position, error)
        call check_close([value(1, 3, 1), position(1, 3, 1)], [2/b, 45.1_wp], "curves", relative=1e-13_wp)
        model%spans = [span_type(12.0_wp, EI=200.0_wp)]
        model%foundations = [foundation_type(k=60.0_wp, side=gapbeam_below)]
        model%supports = [support_type(x=7.0_wp, side=gapbeam_below, stiffness=300.0_wp, gap=0.01_wp)]
        model%loads = [uniform_load(0.5_wp, 0.0_wp, 12.0_wp, case=gapbeam_dead)]
        call prepare_model(model, beam, error)
        call follow_train(beam, moving_train_type(distance=[0.0_wp, 1.5_wp], force=[10.0_wp, 10.0_wp]), passing, error)
        call check(.not. allocated(error), "it passes on one-sided ground")
        call check(count(passing%events%support == 1) > 0 .and. count(passing%events%foundation == 1) > 0, "what changes")
        call get_train_extremes(beam, passing, fields, supports, error)
        call check(supports(1, 1, 1)%value > 0.0_wp .and. abs(supports(2, 1, 1)%value) <= 0.0_wp, "the stop is met and left")
    end subroutine on_the_ground

    !> A support that a dead load moves is moved once, and as a force that stands there would have it
    subroutine over_a_moved_support()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(passing_type) :: passing
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(train_extreme_type) :: fields(2, 4), supports(2, 4, 2)
        real(wp) :: r(2), w(2), opening(2), couple(2)
        integer :: condition(2)

        model%spans = [span_type(4.0_wp, EI=1000.0_wp)]
        model%foundations = [foundation_type(k=500.0_wp, side=gapbeam_below)]
        model%supports = [support_type(node=0), support_type(node=1)]
        model%loads = [support_movement(0.01_wp, 1, case=gapbeam_dead), point_force(5.0_wp, x=1.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, r, w, opening, couple, condition, error)
        call check_close(r(1), -1.93863852647_wp, "a moved support", relative=1e-10_wp)
        model%loads = model%loads(:1)
        call prepare_model(model, beam, error)
        call follow_train(beam, moving_train_type(distance=[0.0_wp], force=[5.0_wp], from=1.0_wp, to=1.0_wp), passing, error)
        call get_train_extremes(beam, passing, fields, supports, error)
        call check_close(supports(1, 1, :)%value, r, "the same under a train")
    end subroutine over_a_moved_support

end program test_api_trains
