!> The paper's beam in Fortran: prepared once, solved in ten load steps, followed from event to event.
!>
!>     gfortran paper_beam.f90 $(pkg-config --cflags --libs gapbeam) -o paper_beam
!>
!> The programs beside it do the same in C, Fortran 77 and Python and print the same digits.
program paper_beam
    use, intrinsic :: iso_fortran_env, only: real64
    use gapbeam, only: model_type, prepared_type, result_type, options_type, event_type, certificate_type, error_type, &
        span_type, support_type, point_force, gapbeam_above, gapbeam_below, gapbeam_infinity, gapbeam_solved, &
        prepare_model, solve_beam, follow_load, get_supports, get_fields, get_extremes, get_certificate
    implicit none

    call run()

contains

    !> Everything: arrays of a procedure are freed at its end
    subroutine run()
        type(model_type) :: model
        type(prepared_type) :: beam
        type(result_type) :: result
        type(certificate_type) :: certificate
        type(event_type), allocatable :: events(:)
        type(error_type), allocatable :: error
        real(real64) :: reaction(4), deflection(4), opening(4), couple(4), fields(6, 3), value(2, 6), place(2, 6)
        integer :: condition(4), step
        logical :: undecided(4)

        ! A clamped beam of three spans, in tf and m; the middle one of its one-sided supports lifts off
        allocate (model%spans(3))
        model%spans(:) = span_type(2.0_real64, EI=44.5_real64)
        model%supports = [support_type(node=0, rotation=gapbeam_infinity), support_type(node=1, side=gapbeam_above), &
                          support_type(node=2, side=gapbeam_below), support_type(node=3, side=gapbeam_below)]
        model%loads = [point_force(0.70707_real64, node=1), point_force(-4.3597_real64, node=2), &
                       point_force(2.1155_real64, node=3)]
        call prepare_model(model, beam, error)
        do step = 1, 10
            if (.not. allocated(error)) call solve_beam(beam, step/10.0_real64, options_type(), result, error)
        end do
        if (allocated(error)) error stop error%message
        if (result%status /= gapbeam_solved) error stop "no equilibrium"

        call get_supports(beam, result, reaction, deflection, opening, couple, condition, error)
        call row("reaction", reaction)
        call row("deflection", deflection)
        call row("opening", opening)
        call row("couple", couple)
        print "(a12, 4i4)", "condition   ", condition
        call get_fields(beam, result, [1.0_real64, 3.0_real64, 5.0_real64], fields, error)
        call row("moment", fields(3, :))
        call row("shear", fields(4, :))
        call row("rotation", fields(2, :))
        call get_extremes(beam, result, value, place, error)
        call row("largest", value(:, 1))
        call row("at", place(:, 1))
        call get_certificate(beam, result, certificate, undecided, error)
        call row("certificate", [certificate%equilibrium, certificate%compatibility, certificate%deflection_bound, &
                                 certificate%reaction_bound])
        call follow_load(beam, 1.0_real64, options_type(), events, result, error)
        if (allocated(error)) error stop error%message
        print "(a12, i4)", "events      ", size(events)
    end subroutine run

    !> A name and its values, all digits of them
    subroutine row(name, values)
        character(len=*), intent(in) :: name
        real(real64), intent(in) :: values(:)
        character(len=12) :: label

        label = name
        print "(a12, *(es25.16))", label, values
    end subroutine row

end program paper_beam
