!> A stretch of the load path: lines over the load factor, where they end, in doubles and in quadruple precision; and how good a
!> state is
program test_affine_response
    use testing, only: check, check_close, finish
    use beams, only: sample_type, make_beam, detail_of, infinite
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_element, only: field_type
    use gapbeam_model, only: beam_type, node_support_type, below, above, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_scheme
    use gapbeam_affine_response, only: response_type, without_dead_loads, value_at, width_at, zero_of, falls, rises, &
        stays_at_zero
    use gapbeam_stretch, only: stretch_type, new_stretch, start_stretch, change_supports, add_those_at_zero, next_in_queue, &
        response_in
    use gapbeam_refined, only: refine_beam
    use gapbeam_model_quad, only: fine_beam_type => beam_type
    use gapbeam_contact_state_quad, only: outcome_type
    use gapbeam_linear_region, only: region_type, find_region
    use gapbeam_recover, only: recover_beam
    use gapbeam_certificate, only: certificate_type, certify
    implicit none
    integer :: status

    call single_lines()
    call incremental_beam()
    call stretch_of_two_spans()
    call stretch_of_a_mechanism()
    call cells()
    call certificates()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two spans of length 1 and EI 1 on one-sided supports, dead load 1, live load 1 on the left span. Reactions, factor f:
    !> 3/8 + 7/16 f, 10/8 + 10/16 f, 3/8 - 1/16 f; so the right end lifts at f = 6
    subroutine two_spans(sample)
        type(sample_type), intent(out) :: sample

        call make_beam([1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [1.0_wp, 0.0_wp], &
                       [node_support_type(0, below, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.0_wp), &
                        node_support_type(2, below, infinite(), 0.0_wp)], sample)
    end subroutine two_spans

    !> Signs, zeros, widths
    subroutine single_lines()
        type(response_type) :: line

        line = response_type(3.0_wp, -2.0_wp, 0.0_wp, 0.5_wp)
        call check(falls(line) .and. .not. rises(line), "falls")
        call check_close([value_at(line, 1.0_wp), value_at(line, zero_of(line))], [1.0_wp, 0.0_wp], "value and zero")
        call check_close(width_at(line, -2.0_wp), 1.0_wp, "what counts as zero")
        call check(.not. stays_at_zero(line, zero_of(line)), "a falling line does not stay")
        line = response_type(3.0_wp, 0.25_wp, 0.0_wp, 0.5_wp)
        call check(.not. (falls(line) .or. rises(line)), "a slope within its error is none")
        call check(.not. stays_at_zero(line, 0.0_wp), "level, but not at zero")
        call check(stays_at_zero(response_type(), 7.0_wp), "nothing at all stays at zero")
        call check(stays_at_zero(response_type(1e-9_wp, 0.0_wp, 1e-8_wp, 0.0_wp), 1.0_wp), "within its error")
    end subroutine single_lines

    !> Dead loads and contact levels are gone, live loads stay
    subroutine incremental_beam()
        type(sample_type) :: sample
        type(beam_type) :: incremental

        call two_spans(sample)
        sample%beam%supports%contact = 0.5_wp
        sample%beam%force = 2.0_wp
        sample%beam%couple = 3.0_wp
        call without_dead_loads(sample%beam, incremental)
        call check(.not. any(abs(incremental%supports%contact) > 0.0_wp), "levels")
        call check_close([incremental%force(:, 1), incremental%couple(:, 1)], [0.0_wp, 2.0_wp, 0.0_wp, 3.0_wp], "at nodes")
        call check_close([incremental%links(1)%shear_a, incremental%links(1)%turn_a], &
                         [0.0_wp, 0.5_wp, 0.0_wp, 1/24.0_wp], "in links")
    end subroutine incremental_beam

    !> All supports closed from 0 to 6, then the right one open
    subroutine stretch_of_two_spans()
        type(sample_type) :: sample
        type(stretch_type) :: stretch
        type(response_type) :: line
        logical :: closed(3)
        integer, allocatable :: at_zero(:)
        real(wp) :: next

        call two_spans(sample)
        call new_stretch(sample%beam, stretch)
        closed = .true.
        call start_stretch(sample%beam, closed, 0.0_wp, stretch)
        call check(stretch%current .and. .not. stretch%in_doubt, "one scheme acts")
        line = response_in(sample%beam, closed, 3, stretch)
        call check_close([line%v0, line%v1], [0.375_wp, -0.0625_wp], "reaction over the factor")
        at_zero = [integer ::]
        call next_in_queue(sample%beam, closed, 0.0_wp, 10.0_wp, stretch, at_zero, next)
        call check_close(next, 6.0_wp, "the next event")
        call check(size(at_zero) == 1 .and. all(at_zero == 3), "is that of the right support")
        call change_supports(sample%beam, [3], next, closed, stretch)
        call check(stretch%current .and. all(closed .eqv. [.true., .true., .false.]), "it opens")
        line = response_in(sample%beam, closed, 3, stretch)
        call check_close([line%v0, line%v1], [-0.25_wp, 1/24.0_wp], "and lifts by (f - 6) q L**4/24 EI")
        at_zero = [integer ::]
        call add_those_at_zero(sample%beam, closed, 6.0_wp, 10.0_wp, stretch, at_zero)
        call check(all(at_zero == [3]), "from zero")
        call next_in_queue(sample%beam, closed, 6.0_wp, 10.0_wp, stretch, at_zero, next)
        call check(next >= huge(next), "for good")
    end subroutine stretch_of_two_spans

    !> A scheme that holds nothing has no lines
    subroutine stretch_of_a_mechanism()
        type(sample_type) :: sample
        type(stretch_type) :: stretch

        call two_spans(sample)
        call new_stretch(sample%beam, stretch)
        call start_stretch(sample%beam, [.false., .true., .false.], 0.0_wp, stretch)
        call check(.not. stretch%current, "a mechanism")
    end subroutine stretch_of_a_mechanism

    !> The same path in quadruple precision; with a force on the right tip there is an end of equilibrium
    subroutine cells()
        type(sample_type), target :: sample
        type(fine_beam_type) :: fine
        type(region_type) :: region
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error

        call two_spans(sample)
        call refine_beam(sample%beam, detail_of(sample), fine)
        call find_region(fine, 0.0_qp, 10.0_qp, [.true., .true., .true.], region, outcome, error)
        call check(.not. allocated(error) .and. outcome%status == gapbeam_solved, "found")
        call check(all(region%closed), "all are closed")
        call check(abs(region%to - 6) < 1e-28_qp, "up to 6")
        call find_region(fine, 6.0_qp, 10.0_qp, [.true., .true., .true.], region, outcome, error)
        call check(all(region%closed .eqv. [.true., .true., .false.]), "then the right one is open")
        call check(region%to > 10, "to the end")
        call make_beam([1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, below, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.0_wp)], sample)
        sample%beam%force(2, 2) = 1.0_wp
        call refine_beam(sample%beam, detail_of(sample), fine)
        call find_region(fine, 0.0_qp, 10.0_qp, [.true., .true.], region, outcome, error)
        call check(.not. allocated(error) .and. outcome%status == gapbeam_no_equilibrium, "balanced, so any force tips it")
    end subroutine cells

    !> A solved state is good to rounding, a spoiled one is not
    subroutine certificates()
        type(sample_type), target :: sample
        type(workspace_type) :: work
        type(certificate_type) :: certificate
        type(error_type), allocatable :: error
        type(field_type) :: starts(2)
        integer :: state, place

        call make_beam([1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], &
                       [node_support_type(0, both, infinite(), 0.0_wp), node_support_type(2, both, infinite(), 0.0_wp)], sample)
        call new_workspace(sample%beam, work)
        call set_loads(sample%beam, 1.0_wp, work)
        call solve_scheme(sample%beam, [.true., .true.], work, state, place)
        associate (a => work%answers)
            call recover_beam(sample%pieces, sample%dead, sample%live, 1.0_wp, sample%beam%links, sample%last, &
                              sample%beam%kind, a%deflection, a%moment_left, a%moment_right, work%shear, starts)
            call certify(sample%beam, detail_of(sample), 1.0_wp, [.true., .true.], a%deflection, a%moment_left, a%moment_right, &
                         work%reaction, starts, [0.0_wp, 0.0_wp], certificate, error)
            call check(.not. allocated(error) .and. certificate%known, "certified")
            call check(max(certificate%deflection, certificate%moment, certificate%reaction, certificate%compatibility, &
                           certificate%equilibrium) < 1e-13_wp, "to rounding")
            call check(certificate%deflection > 0.0_wp, "not to nothing")
            a(1)%deflection = a(1)%deflection + 1e-3_wp
            call certify(sample%beam, detail_of(sample), 1.0_wp, [.true., .true.], a%deflection, a%moment_left, a%moment_right, &
                         work%reaction, starts, [0.0_wp, 0.0_wp], certificate, error)
            call check(certificate%of_nodes >= 1e-3_wp .and. certificate%of_nodes < 1.001e-3_wp, "an error is seen")
            call check(certificate%compatibility > 1e-4_wp, "in its residual too")
            call check(certificate%moment < 1e-13_wp, "moments are as good as before")
            sample%beam%supports%side = above
            call certify(sample%beam, detail_of(sample), 1.0_wp, [.true., .true.], a%deflection, a%moment_left, a%moment_right, &
                         work%reaction, starts, [0.0_wp, 0.0_wp], certificate, error)
            call check(.not. allocated(error) .and. .not. certificate%known .and. min(certificate%of_nodes, certificate%reaction, &
                       certificate%moment, certificate%compatibility) > huge(1.0_wp), "no bounds where nothing is confirmed")
        end associate
    end subroutine certificates

end program test_affine_response
