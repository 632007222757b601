!> Certificates of many solved cases of a beam, eight side by side where lanes hold them.
!> Where something is in doubt, or lanes do not hold them (gapbeam_lane_certificate), one by one (gapbeam_certificate).
module gapbeam_case_certificates
    use gapbeam_kinds, only: wp
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
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type, remaining
    use gapbeam_cases, only: case_loads_type
    use gapbeam_combinations, only: combination_type, combine_case, solve_combination
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_rounding_type
    use gapbeam_lane_error_ellipses, only: kinds_of_movement
    use gapbeam_lane_cases, only: fits_lanes
    use gapbeam_lane_blocks, only: block_type, make_block, take_cases, take_solutions
    implicit none
    private
    public :: certify_cases, certificate_numbers

    !> Numbers of a certificate: relative residuals of compatibility, equilibrium and complementarity; largest errors of deflections
    !> of the nodes and of reactions; of deflections, rotations, moments and shears along the beam
    integer, parameter :: certificate_numbers = 9

contains

    !> Certify cases
    subroutine certify_cases(assembled, loads, numbers, solutions, found, known, level)
        type(assembled_type), intent(in), target :: assembled
        !> By split_loads, not allocated on the ground
        type(case_loads_type), allocatable, intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> By solve_cases; without deflections, moments and reactions each case is solved once more. Status out an error where one
        !> is found
        type(case_solutions_type), intent(inout) :: solutions
        !> The certificates, bounds in the scene's units, shape (certificate_numbers, ncase); of a case that is not solved as they
        !> were
        real(wp), intent(inout) :: found(:, :)
        !> Is the position known; if not, there are no bounds for deflections and rotations
        logical, intent(out) :: known(:)
        !> Instructions (gapbeam_cpu_dispatch); default the best that there are
        integer, intent(in), optional :: level
        type(combination_type) :: combined
        logical, allocatable :: done(:)
        integer, allocatable :: which(:)
        integer :: i, stat
        logical :: in_lanes

        known(:) = .false.
        allocate (done(size(known)), stat=stat)
        if (stat /= 0) then
            solutions%status(:) = gapbeam_no_memory
            return
        end if
        done(:) = solutions%status /= gapbeam_solved
        in_lanes = associated(solutions%w) .and. allocated(loads) .and. .not. (associated(numbers%spans) &
                                                                               .or. associated(numbers%moduli))
        if (in_lanes) in_lanes = fits_lanes(assembled)
        if (in_lanes) then
            call certify_in_lanes(assembled, loads, numbers, remaining(done), solutions, found, done, stat, level)
            if (stat /= 0) then
                solutions%status(:) = gapbeam_no_memory
                return
            end if
            known = done .and. solutions%status == gapbeam_solved
        end if
        which = remaining(done)
        do i = 1, size(which)
            if (is_stopped(assembled%beam%watch)) exit
            call certify_alone(assembled, numbers, which(i), combined, solutions, found(:, which(i)), known(which(i)))
        end do
        if (is_stopped(assembled%beam%watch)) solutions%status(:) = gapbeam_stopped
    end subroutine certify_cases

    !> Certify a case by itself
    subroutine certify_alone(assembled, numbers, i, combined, solutions, found, known)
        !> As for certify_cases, and the case
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        integer, intent(in) :: i
        !> Of an earlier case, or empty
        type(combination_type), intent(inout) :: combined
        type(case_solutions_type), intent(inout) :: solutions
        real(wp), intent(inout) :: found(:)
        logical, intent(inout) :: known
        type(state_type) :: state
        type(certificate_type) :: certificate
        type(error_type), allocatable :: error

        call combine_case(assembled, numbers, i, combined, error)
        if (.not. allocated(error)) then
            if (associated(solutions%w)) then
                call take_state(combined%assembled, solutions, i, state, error)
            else
                associate (m => size(assembled%beam%supports))
                    call solve_combination(combined%assembled, numbers%rule, solutions%closed(:m, i) /= 0, state, error)
                end associate
            end if
        end if
        if (.not. allocated(error)) then
            solutions%status(i) = state%status
            if (state%status /= gapbeam_solved) return
            call certify_state(combined%assembled, state, certificate, error)
        end if
        if (allocated(error)) then
            solutions%status(i) = error%code
            return
        end if
        associate (c => certificate)
            ! A state that quadruple precision does not confirm has no certificate
            if (c%compatibility > huge(c%compatibility)) then
                solutions%status(i) = gapbeam_not_converged
                return
            end if
            known = c%known
            found(:) = in_scene(combined%assembled, [c%compatibility, c%equilibrium, c%complementarity, c%of_nodes, &
                                                     c%reaction, c%deflection, c%rotation, c%moment, c%shear])
        end associate
    end subroutine certify_alone

    !> The state whose numbers are given
    subroutine take_state(assembled, solutions, i, state, error)
        !> The beam of the case
        type(assembled_type), intent(in) :: assembled
        type(case_solutions_type), intent(in) :: solutions
        integer, intent(in) :: i
        type(state_type), intent(out) :: state
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work

        call new_state(assembled, state, error)
        if (allocated(error)) return
        associate (units => assembled%units, n => size(assembled%beam%links), m => size(assembled%beam%supports))
            state%status = gapbeam_solved
            state%factor = 1.0_wp
            state%closed(:) = solutions%closed(:m, i) /= 0
            state%deflection(:) = scale(solutions%w(:, i), -units%deflection)
            state%moment_left(:) = scale(solutions%ml(:, i), -moment_unit(units))
            state%moment_right(:) = scale(solutions%mr(:, i), -moment_unit(units))
            state%reaction(:) = scale(solutions%reaction(:m, i), -units%force)
            call new_workspace(assembled%beam, work)
            call set_loads(assembled%beam, 1.0_wp, work)
            call apply_scheme(assembled%beam, state%closed, [0, n], work)
            work%answers%deflection = state%deflection
            work%answers%moment_left = state%moment_left
            work%answers%moment_right = state%moment_right
            call find_shears(assembled%beam, [1, n], work)
            state%shear(:) = work%shear
        end associate
    end subroutine take_state

    !> Certify cases of a beam that lanes hold, as far as nothing is in doubt
    subroutine certify_in_lanes(assembled, loads, numbers, which, solutions, found, done, stat, level)
        type(assembled_type), intent(in), target :: assembled
        !> As for certify_cases
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> Which cases
        integer, intent(in) :: which(:)
        type(case_solutions_type), intent(in) :: solutions
        real(wp), intent(inout) :: found(:, :)
        !> True of those that have a certificate then
        logical, intent(inout) :: done(:)
        !> Not 0 where memory ends
        integer, intent(out) :: stat
        integer, intent(in), optional :: level
        type(block_type) :: block
        type(lane_rounding_type) :: rounding
        real(wp), allocatable :: moves(:, :, :)
        real(wp) :: certificates(lanes, certificate_numbers), poor(lanes)
        integer :: first, l
        logical :: made, fits(lanes)

        if (present(level)) block%level = level
        call make_block(assembled, loads, numbers, block)
        made = block%made
        stat = 0
        if (made) then
            ! Several supports at a place have certificates by themselves
            if (size(block%beam%shared) > 0) return
            call find_rounding(assembled, block%beam, rounding, made)
        end if
        if (.not. made) then
            stat = 1
            return
        end if
        allocate (moves(lanes, 0:block%beam%n, kinds_of_movement), source=0.0_wp, stat=stat)
        if (stat /= 0) return
        do first = 1, size(which), lanes
            if (is_stopped(assembled%beam%watch)) return
            call take_cases(assembled, numbers, solutions%closed, which(first:), block, fits)
            if (.not. any(fits)) cycle
            call take_solutions(assembled, solutions, block)
            call block%compiled%certify_pack(block%beam, rounding, block%factors, block%pack, moves, certificates, poor)
            do l = 1, block%cases
                if (poor(l) > 0.5_wp) cycle
                associate (i => block%case_of(l))
                    found(:, i) = in_scene(assembled, certificates(l, :))
                    done(i) = .true.
                end associate
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
