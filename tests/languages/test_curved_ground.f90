!> Ground whose laws have parameters, by the module gapbeam: closed forms of beams that sink evenly, and one that is bent
program test_curved_ground
    use, intrinsic :: iso_fortran_env, only: wp => real64
    use testing, only: check, check_close, finish
    use gapbeam, only: model_type, span_type, foundation_type, point_force, uniform_load, prepared_type, options_type, &
        result_type, error_type, contact_type, prepare_model, solve_beam, get_fields, get_contact, get_pressure, &
        get_pressure_extremes, gapbeam_below, gapbeam_closed, gapbeam_solved, gapbeam_bad_input, gapbeam_law_plastic, &
        gapbeam_law_hardening, gapbeam_law_hyperbolic, gapbeam_law_tanh, gapbeam_law_cubic
    implicit none
    integer :: status

    call it_sinks_evenly()
    call it_is_bent()
    call it_is_refused()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Deflection under an even load
    subroutine sink(law, parameter, expected, what)
        integer, intent(in) :: law
        real(wp), intent(in) :: parameter(3), expected
        character(len=*), intent(in) :: what
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 2)

        model%spans = [span_type(4.0_wp, EI=10.0_wp)]
        model%foundations = [foundation_type(side=gapbeam_below, gap=0.25_wp, law=law, parameter=parameter)]
        model%loads = [uniform_load(6.0_wp, 0.0_wp, 4.0_wp)]
        call prepare_model(model, beam, error)
        call check(.not. allocated(error), what//" is prepared")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, what//" is solved")
        call get_fields(beam, result, [1.0_wp, 4.0_wp], fields, error)
        call check_close(fields(1, :), [expected, expected] + 0.25_wp, what)
    end subroutine sink

    !> Every law has a closed form there
    subroutine it_sinks_evenly()
        call sink(gapbeam_law_tanh, [20.0_wp, 8.0_wp, 0.0_wp], 0.4_wp*atanh(0.75_wp), "tanh")
        call sink(gapbeam_law_hyperbolic, [20.0_wp, 8.0_wp, 0.0_wp], 1.2_wp, "a hyperbola")
        call sink(gapbeam_law_cubic, [2.0_wp, 1.0_wp, 3.0_wp], 1.0_wp, "a cubic")
        call sink(gapbeam_law_hardening, [20.0_wp, 4.0_wp, 5.0_wp], 0.6_wp, "hardening")
        call sink(gapbeam_law_plastic, [20.0_wp, 8.0_wp, 0.0_wp], 0.3_wp, "plastic")
    end subroutine it_sinks_evenly

    !> Strength that grows: the forces balance, and the pressure is that of the law
    subroutine it_is_bent()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(contact_type), allocatable :: zones(:)
        type(error_type), allocatable :: error
        real(wp) :: fields(6, 3), pressure(3), most(2), at(2)
        real(wp), parameter :: x(3) = [0.25_wp, 1.0_wp, 2.5_wp]

        model%spans = [span_type(8.0_wp, EI=10.0_wp)]
        model%foundations = [foundation_type(side=gapbeam_below, law=gapbeam_law_tanh, parameter=[0.0_wp, 0.0_wp, 0.0_wp], &
                                             parameter_to=[80.0_wp, 40.0_wp, 0.0_wp])]
        model%loads = [point_force(12.0_wp, x=2.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, "strength that grows")
        call get_contact(beam, result, zones, error)
        call check(all(zones%condition == gapbeam_closed) .and. zones(1)%to < 8.0_wp, "the end lifts off")
        call check_close(sum(zones%resultant), 12.0_wp, "the ground bears the force")
        call get_fields(beam, result, x, fields, error)
        call get_pressure(beam, result, x, pressure, error)
        call check_close(pressure, 5*x*tanh(2*fields(1, :)), "pressure")
        call get_pressure_extremes(beam, result, most, at, error)
        call check(most(1) >= maxval(pressure) .and. at(1) > 0.0_wp .and. at(1) < zones(1)%to, "the largest is inside")
    end subroutine it_is_bent

    !> Parameters that cannot be
    subroutine it_is_refused()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(error_type), allocatable :: error

        model%spans = [span_type(8.0_wp, EI=10.0_wp)]
        model%foundations = [foundation_type(law=gapbeam_law_cubic, parameter=[1.0_wp, -2.0_wp, 1.0_wp])]
        call prepare_model(model, beam, error)
        call check(allocated(error), "a law that falls")
        if (allocated(error)) call check(error%code == gapbeam_bad_input .and. index(error%message, "law.k2") > 0, "is named")
        model%foundations = [foundation_type(law=9)]
        call prepare_model(model, beam, error)
        call check(allocated(error), "no such law")
    end subroutine it_is_refused

end program test_curved_ground
