!> Calls that are ended from outside, by the module gapbeam alone: a flag that is read, a time limit, another call
module ask_flag
    use, intrinsic :: iso_c_binding, only: c_ptr, c_int, c_f_pointer
    implicit none
    private
    public :: flag_is_set

contains

    !> Is a flag set after it has been looked at three times
    function flag_is_set(data) result(ends) bind(c)
        !> Address of the flag: how often it was looked at
        type(c_ptr), intent(in), value :: data
        integer(c_int) :: ends
        integer(c_int), pointer :: flag

        call c_f_pointer(data, flag)
        flag = flag + 1
        ends = merge(1_c_int, 0_c_int, flag > 3)
    end function flag_is_set

end module ask_flag

program test_api_watch
    use, intrinsic :: iso_fortran_env, only: wp => real64, int64
    use, intrinsic :: iso_c_binding, only: c_int, c_loc
    use testing, only: check, finish
    use ask_flag, only: flag_is_set
    use gapbeam, only: model_type, span_type, support_type, prepared_type, options_type, result_type, error_type, event_type, &
        uniform_load, point_force, prepare_model, replace_loads, solve_beam, follow_load, combine_loads, get_supports, &
        watch_type, watch_beam, stop_calls, gapbeam_below, gapbeam_dead, gapbeam_solved, gapbeam_stopped, gapbeam_bad_input, &
        gapbeam_not_prepared
    implicit none
    integer :: status

    call ended_calls()
    call refused_calls()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Many spans on supports that push up only
    subroutine many_spans(n, beam)
        integer, intent(in) :: n
        type(prepared_type), intent(out) :: beam
        type(model_type) :: model
        type(error_type), allocatable :: error
        integer :: i

        model%spans = [(span_type(1.0_wp, EI=1e4_wp), i=1, n)]
        model%supports = [(support_type(node=i, side=gapbeam_below, stiffness=50.0_wp), i=0, n)]
        model%loads = [uniform_load(0.1_wp, from=0.0_wp, to=real(n, wp), case=gapbeam_dead), point_force(40.0_wp, x=n/2.0_wp)]
        call prepare_model(model, beam, error)
        call check(.not. allocated(error), "prepared")
    end subroutine many_spans

    !> Is there an error with this code
    pure function has_code(error, code) result(has)
        type(error_type), allocatable, intent(in) :: error
        integer, intent(in) :: code
        logical :: has

        has = allocated(error)
        if (has) has = error%code == code
    end function has_code

    !> A beam of which calls are ended, and go on
    subroutine ended_calls()
        type(prepared_type) :: beam, combined
        type(watch_type), target :: watch
        type(result_type) :: result
        type(error_type), allocatable :: error
        type(event_type), allocatable :: events(:)
        real(wp) :: before(401), after(401), deflection(401), opening(401), couple(401)
        integer :: condition(401), i
        integer(c_int), target :: flag
        integer(int64) :: begin, end, rate

        call many_spans(400, beam)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call get_supports(beam, result, before, deflection, opening, couple, condition, error)
        flag = 0
        call watch_beam(beam, watch, error, ask=flag_is_set, data=c_loc(flag))
        call check(.not. allocated(error), "watched")
        do i = 1, 100000
            call follow_load(beam, 1.0_wp, options_type(), events, result, error)
            if (allocated(error)) exit
        end do
        call check(has_code(error, gapbeam_stopped) .and. flag == 4, "ended by a flag")
        call check(result%status == -1, "nothing is solved then")
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(has_code(error, gapbeam_stopped) .and. flag == 4, "and so it stays")
        call combine_loads(beam, [1.0_wp, 2.0_wp], combined, error)
        call solve_beam(combined, 1.0_wp, options_type(), result, error)
        call check(has_code(error, gapbeam_stopped), "also with other loads")

        call watch_beam(beam, watch, error, seconds=0.1_wp)
        call system_clock(begin, rate)
        do i = 1, 1000000
            call solve_beam(beam, 1.0_wp, options_type(), result, error)
            if (allocated(error)) exit
        end do
        call system_clock(end)
        call check(has_code(error, gapbeam_stopped), "ended by a time limit")
        call check(abs(real(end - begin, wp)/rate - 0.1_wp) < 0.9_wp, "when it is over")

        call watch_beam(beam, watch, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(.not. allocated(error) .and. result%status == gapbeam_solved, "goes on")
        call get_supports(beam, result, after, deflection, opening, couple, condition, error)
        call check(all(before >= after .and. before <= after), "to the last digit")
        call replace_loads(beam, [point_force(10.0_wp, x=3.3_wp)], error)
        call stop_calls(watch)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call check(has_code(error, gapbeam_stopped), "ended by a call, under other loads too")
    end subroutine ended_calls

    !> What is refused
    subroutine refused_calls()
        type(prepared_type) :: beam
        type(watch_type), target :: watch
        type(error_type), allocatable :: error

        call watch_beam(beam, watch, error)
        call check(has_code(error, gapbeam_not_prepared), "no beam")
        call many_spans(2, beam)
        call watch_beam(beam, watch, error, seconds=-1.0_wp)
        call check(has_code(error, gapbeam_bad_input), "a negative time")
    end subroutine refused_calls

end program test_api_watch
