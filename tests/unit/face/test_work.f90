!> States on the ground in the work arrays of Fortran 77: what is put in is taken out, and arrays that are too short say so
program test_work
    use testing, only: check, finish
    use gapbeam_kinds, only: wp
    use gapbeam, only: model_type, span_type, foundation_type, ground_law_point_type, point_force, prepared_type, options_type, &
        result_type, error_type, contact_type, free_span_type, prepare_model, solve_beam, get_contact, get_free_spans, get_fields, &
        get_pressure, gapbeam_infinity, gapbeam_below, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_work, only: put_beam, take_beam, put_result, take_result
    implicit none
    integer :: status

    call a_state_comes_back()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A rigid beam on two foundations, tipped by a force, and lifted by it
    subroutine a_state_comes_back()
        integer, parameter :: room = 2000
        type(model_type) :: model
        type(prepared_type) :: beam, same_beam
        type(result_type) :: result, same_result
        type(error_type), allocatable :: error
        real(wp) :: work(room), state(room)
        integer :: iwork(room), istate(room), info, short, needed(2)

        model%spans = [span_type(12.0_wp, EI=gapbeam_infinity)]
        model%foundations = [foundation_type(k=5.0_wp, side=gapbeam_below), foundation_type(to=4.0_wp, side=gapbeam_below)]
        model%ground_law = [ground_law_point_type(2, 0.5_wp, 1.0_wp), ground_law_point_type(2, 1.0_wp, 1.5_wp)]
        model%loads = [point_force(30.0_wp, x=2.0_wp)]
        call prepare_model(model, beam, error)
        call solve_beam(beam, 1.0_wp, options_type(), result, error)
        call put_beam(beam, work, room, iwork, 10, short)
        call check(short == 2, "whole numbers of the beam do not fit")
        call put_beam(beam, work, 10, iwork, room, short)
        call check(short == 1, "nor do numbers")
        call put_beam(beam, work, room, iwork, room, short)
        call check(short == 0, "a beam fits")
        call take_beam(work, iwork, 1, same_beam, info)
        call put_result(result, state, 10, istate, 10, info)
        needed = [int(state(1)), istate(1)]
        call check(info == -7, "a state does not fit")
        call put_result(result, state, needed(1) - 1, istate, needed(2), info)
        call check(info == -7, "nor into one number less than it says")
        call put_result(result, state, needed(1), istate, needed(2) - 1, info)
        call check(info == -9, "nor into one whole number less")
        call put_result(result, state, needed(1), istate, needed(2), info)
        call check(info == gapbeam_solved, "but into what it says")
        call take_result(state, istate, 3, same_result, info)
        call check(info == 0, "it is taken out")
        call compare(beam, result, same_beam, same_result)
        call solve_beam(beam, -1.0_wp, options_type(), result, error)
        call put_result(result, state, room, istate, room, info)
        call check(info == gapbeam_no_equilibrium, "a motion fits too")
        call take_result(state, istate, 3, same_result, info)
        call check(info == 0 .and. same_result%status == gapbeam_no_equilibrium, "and is taken out")
    end subroutine a_state_comes_back

    !> Two states say the same, to the last digit
    subroutine compare(beam, result, other_beam, other)
        type(prepared_type), intent(in) :: beam, other_beam
        type(result_type), intent(inout) :: result, other
        type(contact_type), allocatable :: zones(:), other_zones(:)
        type(free_span_type), allocatable :: spans(:), other_spans(:)
        type(error_type), allocatable :: error
        real(wp) :: x(5), fields(6, 5), other_fields(6, 5), pressure(5), other_pressure(5)

        x = [0.0_wp, 1.0_wp, 3.0_wp, 6.0_wp, 12.0_wp]
        call get_contact(beam, result, zones, error)
        call get_contact(other_beam, other, other_zones, error)
        call check(size(zones) == size(other_zones) .and. size(zones) > 1, "zones")
        call check(all(zones%condition == other_zones%condition) .and. all(abs(zones%to - other_zones%to) <= 0.0_wp) &
                   .and. all(abs(zones%resultant - other_zones%resultant) <= 0.0_wp), "what they say")
        call get_free_spans(beam, result, spans, error)
        call get_free_spans(other_beam, other, other_spans, error)
        call check(size(spans) == size(other_spans) .and. size(spans) > 0, "free spans")
        call check(all(abs(spans%sag - other_spans%sag) <= 0.0_wp), "how far they hang")
        call get_fields(beam, result, x, fields, error)
        call get_fields(other_beam, other, x, other_fields, error)
        call check(all(abs(fields - other_fields) <= 0.0_wp), "fields")
        call get_pressure(beam, result, x, pressure, error)
        call get_pressure(other_beam, other, x, other_pressure, error)
        call check(all(abs(pressure - other_pressure) <= 0.0_wp), "pressure")
    end subroutine compare

end program test_work
