!> Certificates of many solved cases of a beam, eight side by side where lanes hold them.
!> Where something is in doubt, or lanes do not hold them (gapbeam_lane_certificate), one by one (gapbeam_certificate).
module gapbeam_case_certificates
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: cut_load_error
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_not_converged, gapbeam_stopped
    use gapbeam_model_quad, only: fine_beam_type => beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads, apply_scheme
    use gapbeam_reactions, only: find_shears
    use gapbeam_refined, only: refine_beam
    use gapbeam_certificate, only: certificate_type
    use gapbeam_units, only: moment_unit, rotation_unit, bound_outside
    use gapbeam_assembled_model, only: assembled_type, find_length_errors
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: certify_state, detail_of
    use gapbeam_cases, only: case_loads_type
    use gapbeam_combinations, only: combination_type, varied_type, combine, solve_combination
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_rounding_type, pack_type, new_pack
    use gapbeam_lane_error_ellipses, only: kinds_of_movement
    use gapbeam_cpu_dispatch, only: take_columns_at, take_numbers_at, certify_pack_at, best_level
    use gapbeam_lane_cases, only: fits_lanes
    use gapbeam_lane_model, only: prepare_lanes, take_supports, take_starts, units_of_supports
    implicit none
    private
    public :: certify_cases, certificate_numbers

    !> Numbers of a certificate: relative residuals of compatibility, equilibrium and complementarity; largest errors of deflections
    !> of the nodes and of reactions; of deflections, rotations, moments and shears along the beam
    integer, parameter :: certificate_numbers = 9

contains

    !> Certify cases
    subroutine certify_cases(assembled, loads, factors, values, spans, moduli, rule, given, closed, w, ml, mr, reaction, found, &
                             known, status, level)
        type(assembled_type), intent(in), target :: assembled
        !> By split_loads, not allocated on the ground; factor of every load, shape (nload, ncase)
        type(case_loads_type), allocatable, intent(in) :: loads
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Settlement, gap and stiffness of every support, shape (3, nsupport, ncase); EI and GA of every span, shape (2, nspan,
        !> ncase); modulus of every foundation, shape (nfoundation, ncase). Of size 0: their own
        real(wp), intent(in), target, contiguous :: values(:, :, :), spans(:, :, :), moduli(:, :)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Are the solutions given, by solve_cases; else each case is solved once more
        logical, intent(in) :: given
        !> Contact states, and solutions as solve_cases gives them
        integer, intent(in), contiguous :: closed(:, :)
        real(wp), intent(in), contiguous :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        !> The certificates, bounds in the scene's units, shape (certificate_numbers, ncase); of a case that is not solved as they
        !> were
        real(wp), intent(inout) :: found(:, :)
        !> Is the position known; if not, there are no bounds for deflections and rotations
        logical, intent(out) :: known(:)
        !> gapbeam_solved in where a case is solved; out an error where there is one
        integer, intent(inout) :: status(:)
        !> As for solve_in_lanes
        integer, intent(in), optional :: level
        type(combination_type) :: combined
        logical, allocatable :: done(:)
        integer :: i, at_level, stat

        known(:) = .false.
        allocate (done(size(status)), stat=stat)
        if (stat /= 0) then
            status(:) = gapbeam_no_memory
            return
        end if
        done(:) = status /= gapbeam_solved
        at_level = best_level()
        if (present(level)) at_level = level
        if (given .and. allocated(loads) .and. size(spans) + size(moduli) == 0) then
            if (fits_lanes(assembled)) then
                call certify_in_lanes(assembled, loads, factors, values, closed, w, ml, mr, reaction, at_level, found, done, stat)
                if (stat /= 0) then
                    status(:) = gapbeam_no_memory
                    return
                end if
                known = done .and. status == gapbeam_solved
            end if
        end if
        do i = 1, size(status)
            if (is_stopped(assembled%beam%watch)) exit
            if (.not. done(i)) call certify_alone(i)
        end do
        if (is_stopped(assembled%beam%watch)) status(:) = gapbeam_stopped

    contains

        !> Certify a case by itself
        subroutine certify_alone(i)
            integer, intent(in) :: i
            type(state_type) :: state
            type(certificate_type) :: certificate
            type(error_type), allocatable :: error
            type(varied_type) :: varied

            if (size(values) > 0) varied%supports => values(:, :, i)
            if (size(spans) > 0) varied%spans => spans(:, :, i)
            if (size(moduli) > 0) varied%moduli => moduli(:, i)
            associate (still => 0*assembled%model%supports%settlement, m => size(assembled%beam%supports))
                call combine(assembled, factors(:size(assembled%model%loads), i), still, combined, error, varied)
                if (.not. allocated(error)) then
                    if (given) then
                        call take_state(combined%assembled, closed(:m, i) /= 0, w(:, i), ml(:, i), mr(:, i), reaction(:m, i), &
                                        state, error)
                    else
                        call solve_combination(combined%assembled, rule, closed(:m, i) /= 0, state, error)
                    end if
                end if
            end associate
            if (.not. allocated(error)) then
                status(i) = state%status
                if (state%status /= gapbeam_solved) return
                call certify_state(combined%assembled, state, certificate, error)
            end if
            if (allocated(error)) then
                status(i) = error%code
                return
            end if
            associate (c => certificate)
                ! A state that quadruple precision does not confirm has no certificate
                if (c%compatibility > huge(c%compatibility)) then
                    status(i) = gapbeam_not_converged
                    return
                end if
                known(i) = c%known
                found(:, i) = in_scene(combined%assembled, [c%compatibility, c%equilibrium, c%complementarity, c%of_nodes, &
                                                            c%reaction, c%deflection, c%rotation, c%moment, c%shear])
            end associate
        end subroutine certify_alone

    end subroutine certify_cases

    !> The state whose numbers are given
    subroutine take_state(assembled, closed, w, ml, mr, reaction, state, error)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: closed(:)
        !> In the scene's units
        real(wp), intent(in) :: w(:), ml(:), mr(:), reaction(:)
        type(state_type), intent(out) :: state
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work

        call new_state(assembled, state, error)
        if (allocated(error)) return
        associate (units => assembled%units, n => size(assembled%beam%links))
            state%status = gapbeam_solved
            state%factor = 1.0_wp
            state%closed(:) = closed
            state%deflection(:) = scale(w, -units%deflection)
            state%moment_left(:) = scale(ml, -moment_unit(units))
            state%moment_right(:) = scale(mr, -moment_unit(units))
            state%reaction(:) = scale(reaction, -units%force)
            call new_workspace(assembled%beam, work)
            call set_loads(assembled%beam, 1.0_wp, work)
            call apply_scheme(assembled%beam, closed, [0, n], work)
            work%answers%deflection = state%deflection
            work%answers%moment_left = state%moment_left
            work%answers%moment_right = state%moment_right
            call find_shears(assembled%beam, [1, n], work)
            state%shear(:) = work%shear
        end associate
    end subroutine take_state

    !> Certify the cases of a beam that lanes hold, as far as nothing is in doubt
    subroutine certify_in_lanes(assembled, loads, factors, values, closed, w, ml, mr, reaction, level, found, done, stat)
        type(assembled_type), intent(in), target :: assembled
        !> As for certify_cases
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous :: factors(:, :), values(:, :, :)
        integer, intent(in), contiguous :: closed(:, :)
        real(wp), intent(in), contiguous :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        integer, intent(in) :: level
        real(wp), intent(inout) :: found(:, :)
        !> Which cases need none in, or have one out
        logical, intent(inout) :: done(:)
        !> Not 0 where memory ends
        integer, intent(out) :: stat
        type(lane_beam_type) :: beam
        type(lane_rounding_type) :: rounding
        type(pack_type) :: pack
        real(wp), allocatable :: factors_of(:, :), moves(:, :, :), turned(:, :)
        integer, allocatable :: wanted(:)
        real(wp) :: numbers(lanes, certificate_numbers), poor(lanes)
        integer :: case_of(lanes), first, i, k, l, number
        logical :: made, lost

        call prepare_lanes(assembled, loads, .false., beam, made)
        stat = 0
        ! Several supports at a place have certificates by themselves
        if (made .and. size(beam%shared) > 0) return
        if (made) call new_pack(beam, pack, made)
        if (made) call find_rounding(assembled, beam, rounding, made)
        if (.not. made) stat = 1
        if (stat /= 0) return
        allocate (factors_of(lanes, size(factors, 1)), moves(lanes, 0:beam%n, kinds_of_movement), wanted(count(.not. done)), &
                  turned(lanes, 3*size(values, 2)), stat=stat)
        if (stat /= 0) return
        number = 0
        do i = 1, size(done)
            if (done(i)) cycle
            number = number + 1
            wanted(number) = i
        end do
        call take_supports(assembled, beam%place, pack)
        pack%reaction(:, :) = 0.0_wp
        moves(:, :, :) = 0.0_wp
        do first = 1, number, lanes
            if (is_stopped(assembled%beam%watch)) return
            ! The last lanes repeat the last case
            case_of = [(wanted(min(first + l, number)), l=0, lanes - 1)]
            if (size(values, 2) > 0) then
                call take_numbers_at(level, beam, units_of_supports(assembled), values, case_of, turned, pack, lost)
                if (lost) cycle
            end if
            call take_columns_at(level, size(factors, 1), size(factors, 2), factors, case_of, factors_of)
            call take_columns_at(level, beam%n + 1, size(w, 2), w, case_of, pack%w)
            call take_columns_at(level, beam%n + 1, size(ml, 2), ml, case_of, pack%ml)
            call take_columns_at(level, beam%n + 1, size(mr, 2), mr, case_of, pack%mr)
            do k = 1, size(assembled%beam%supports)
                pack%reaction(:, assembled%beam%supports(k)%node) = reaction(k, case_of)
            end do
            call take_starts(assembled, beam%place, closed, case_of, pack)
            pack%w(:, :) = scale(1.0_wp, -assembled%units%deflection)*pack%w
            pack%ml(:, :) = scale(1.0_wp, -moment_unit(assembled%units))*pack%ml
            pack%mr(:, :) = scale(1.0_wp, -moment_unit(assembled%units))*pack%mr
            pack%reaction(:, :) = scale(1.0_wp, -assembled%units%force)*pack%reaction
            call certify_pack_at(level, beam, rounding, factors_of, pack, moves, numbers, poor)
            do l = 1, min(lanes, number - first + 1)
                if (poor(l) > 0.5_wp) cycle
                found(:, case_of(l)) = in_scene(assembled, numbers(l, :))
                done(case_of(l)) = .true.
            end do
        end do
    end subroutine certify_in_lanes

    !> What is rounded in all cases of a beam: links beside those condensed in quadruple precision, and loads by their number
    subroutine find_rounding(assembled, lane_beam, rounding, made)
        type(assembled_type), intent(in), target :: assembled
        type(lane_beam_type), intent(in) :: lane_beam
        type(lane_rounding_type), intent(out) :: rounding
        !> False where memory ends
        logical, intent(out) :: made
        type(fine_beam_type) :: fine
        integer, allocatable :: shares(:)
        real(wp), allocatable :: length_error(:)
        integer :: n, k, stat

        n = lane_beam%n
        allocate (rounding%flexibility(n), rounding%length(n), rounding%of_fields(n), rounding%slip(n), shares(0:2*n), &
                  length_error(n), stat=stat)
        made = stat == 0
        if (.not. made) return
        call refine_beam(assembled%beam, detail_of(assembled), fine)
        shares(:) = 0
        do k = 1, size(lane_beam%link)
            shares(lane_beam%link(k)) = shares(lane_beam%link(k)) + 1
        end do
        do k = 1, size(lane_beam%node)
            shares(n + lane_beam%node(k)) = shares(n + lane_beam%node(k)) + 1
        end do
        ! Half a unit for every product and sum, and what condensing a load costs
        call find_length_errors(assembled, length_error)
        rounding%of_loads = epsilon(1.0_wp)*(2 + 0.5_wp*maxval(shares)) + maxval(length_error)
        do k = 1, n
            associate (a => assembled%beam%links(k), b => fine%links(k))
                rounding%flexibility(k) = real(max(abs(a%faa - b%faa), abs(a%fab - b%fab), abs(a%fbb - b%fbb), &
                                                   abs(a%sum_a - b%sum_a), abs(a%sum_b - b%sum_b))*(1 + epsilon(1.0_wp)), wp) &
                    + length_error(k)*max(a%faa, abs(a%fab), a%fbb, abs(a%sum_a), abs(a%sum_b))
                rounding%length(k) = real(abs(a%length - b%length)/b%length, wp) + epsilon(1.0_wp) + length_error(k)
            end associate
            associate (first => assembled%node_point(k - 1) + 1, last => assembled%node_point(k))
                rounding%slip(k) = sum(assembled%pieces(first:last)%shear_flexibility*assembled%pieces(first:last)%length)
                ! A link of one piece has nothing to be summed
                rounding%of_fields(k) = 0.0_wp
                if (last > first) rounding%of_fields(k) = rounding%of_loads + cut_load_error
            end associate
        end do
    end subroutine find_rounding

    !> The numbers of a certificate in the scene's units
    pure function in_scene(assembled, numbers) result(found)
        type(assembled_type), intent(in) :: assembled
        !> In the engine's units
        real(wp), intent(in) :: numbers(certificate_numbers)
        real(wp) :: found(certificate_numbers)

        associate (u => assembled%units)
            found = numbers
            found(4:) = bound_outside(numbers(4:), [u%deflection, u%force, u%deflection, rotation_unit(u), moment_unit(u), u%force])
        end associate
    end function in_scene

end module gapbeam_case_certificates
