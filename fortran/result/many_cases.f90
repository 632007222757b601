!> Many cases of a beam in one call: side by side where lanes hold the beam (gapbeam_lane_cases), the others one by one
module gapbeam_many_cases
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_units, only: moment_unit
    use gapbeam_lowered, only: lowered_type
    use gapbeam_search, only: rule_block
    use gapbeam_cases, only: case_loads_type, solve_case, replace_supports
    use gapbeam_lane_cases, only: fits_lanes, solve_in_lanes
    implicit none
    private
    public :: solve_many_cases

contains

    !> Solve cases of a beam that is on no foundation
    subroutine solve_many_cases(lowered, loads, factors, values, rule, closed, w, ml, mr, reaction, solves, status)
        type(lowered_type), intent(in) :: lowered
        !> By split_loads, and the factor of every load, shape (nload, ncase)
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in) :: factors(:, :)
        !> Settlement, gap and stiffness of every support of the scene, of supports without laws, shape (3, nsupport, ncase);
        !> nsupport 0: their own
        real(wp), intent(in) :: values(:, :, :)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Starts in, working schemes out, of a case that is not solved all open; 1 closed, shape (at least size(beam%supports),
        !> ncase)
        integer, intent(inout) :: closed(:, :)
        !> In the scene's units: deflections, moments left and right of the nodes, shape (n + 1, ncase); reactions, shape as for
        !> closed; of a case that is not solved not-a-number
        real(wp), intent(inout) :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        !> Linear solves; gapbeam_solved, gapbeam_no_equilibrium or the code of an error; where memory ends all say so
        integer, intent(inout) :: solves(:), status(:)
        type(beam_type) :: loaded
        type(workspace_type) :: work
        logical, allocatable :: acting(:), done(:)
        real(wp) :: nan
        integer :: i, m, stat

        m = size(lowered%beam%supports)
        solves(:) = 0
        status(:) = gapbeam_no_memory
        if (.not. enough_memory(for_solving, size(lowered%beam%links), m, 0)) return
        allocate (acting(m), done(size(status)), stat=stat)
        if (stat /= 0) return
        done(:) = .false.
        if (rule == rule_block .and. fits_lanes(lowered)) then
            call solve_in_lanes(lowered, loads, factors, values, closed, w, ml, mr, reaction, solves, done)
            where (done) status = gapbeam_solved
            if (all(done)) return
        end if
        loaded = lowered%beam
        call new_workspace(loaded, work)
        nan = ieee_value(nan, ieee_quiet_nan)
        do i = 1, size(status)
            if (done(i)) cycle
            acting(:) = closed(:m, i) /= 0
            call take_nothing(nan, closed(:, i), w(:, i), ml(:, i), mr(:, i), reaction(:, i))
            if (size(values, 2) > 0) then
                call replace_supports(lowered, values(:, :, i), loaded, status(i))
                if (status(i) /= gapbeam_solved) cycle
            end if
            call solve_case(loads, factors(:, i), rule, loaded, acting, work, status(i))
            if (status(i) == gapbeam_no_memory) then
                status(:) = gapbeam_no_memory
                return
            end if
            solves(i) = work%solves
            if (status(i) /= gapbeam_solved) cycle
            associate (units => lowered%units, a => work%answers)
                w(:, i) = scale(a%deflection, units%deflection)
                ml(:, i) = scale(a%moment_left, moment_unit(units))
                mr(:, i) = scale(a%moment_right, moment_unit(units))
                reaction(:m, i) = scale(work%reaction, units%force)
            end associate
            if (all(abs(w(:, i)) <= huge(nan)) .and. all(abs(ml(:, i)) <= huge(nan)) .and. all(abs(mr(:, i)) <= huge(nan)) &
                .and. all(abs(reaction(:m, i)) <= huge(nan))) then
                closed(:m, i) = merge(1, 0, acting)
            else
                status(i) = gapbeam_not_finite
                call take_nothing(nan, closed(:, i), w(:, i), ml(:, i), mr(:, i), reaction(:, i))
            end if
        end do
    end subroutine solve_many_cases

    !> A case that is not solved
    pure subroutine take_nothing(nan, closed, w, ml, mr, reaction)
        real(wp), intent(in) :: nan
        integer, intent(out) :: closed(:)
        real(wp), intent(out) :: w(:), ml(:), mr(:), reaction(:)

        closed(:) = 0
        w(:) = nan
        ml(:) = nan
        mr(:) = nan
        reaction(:) = nan
    end subroutine take_nothing

end module gapbeam_many_cases
