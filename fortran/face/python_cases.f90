! Many cases of loads for Python, in the manner of face/python.f90, which says what the arguments are

! Condense the loads of a beam one by one, for GBCASE
subroutine gbshar(beam, status)
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_handle, only: handle_type, handle_of
    use gapbeam_cases, only: split_loads
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(out) :: status
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    status = gapbeam_solved
    if (allocated(handle%cases)) return
    allocate (handle%cases)
    call split_loads(handle%lowered, handle%cases, error)
    if (.not. allocated(error)) return
    deallocate (handle%cases)
    status = error%code
end subroutine gbshar

! Solve NC cases of loads; every load counts with its factor
subroutine gbcase(beam, nl, ns, nd, nv, nc, factor, supp, rule, closed, w, ml, mr, react, solves, status)
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
    use gapbeam_error, only: gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_units, only: moment_unit
    use gapbeam_handle, only: handle_type, handle_of
    use gapbeam_cases, only: solve_case, replace_supports
    use gapbeam_search, only: rule_block
    use gapbeam_lane_cases, only: fits_lanes, solve_in_lanes
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns
    ! One more than there are loads; cases
    integer, intent(in) :: nd, nc
    ! One more than there are supports of the scene, or 1 where they are those of the scene
    integer, intent(in) :: nv
    ! Factor of every load in every case; settlement, gap and stiffness of every support, of supports without laws
    double precision, intent(in) :: factor(nd, nc), supp(3, nv, nc)
    integer, intent(in) :: rule
    ! Schemes: start in, working scheme out; of a case that is not solved all open, and its results are not numbers
    integer, intent(inout) :: closed(ns + 1, nc)
    ! In the scene's units: deflections and moments left and right of the nodes, reactions
    double precision, intent(inout) :: w(0:nl, nc), ml(0:nl, nc), mr(0:nl, nc), react(ns + 1, nc)
    ! Where memory ends all STATUS say so
    integer, intent(inout) :: solves(nc), status(nc)
    !f2py threadsafe
    !f2py integer, intent(hide), depend(closed) :: ns = shape(closed, 0) - 1
    !f2py integer, intent(hide), depend(factor) :: nd = shape(factor, 0)
    !f2py integer, intent(hide), depend(factor) :: nc = shape(factor, 1)
    !f2py integer, intent(hide), depend(supp) :: nv = shape(supp, 1)
    !f2py integer, intent(hide), depend(w) :: nl = shape(w, 0) - 1
    type(handle_type), pointer :: handle
    type(beam_type) :: loaded
    type(workspace_type) :: work
    logical, allocatable :: acting(:), done(:)
    double precision :: nan
    integer :: i

    handle => handle_of(beam)
    solves = 0
    status = gapbeam_no_memory
    if (.not. enough_memory(for_solving, nl, ns, 0)) return
    allocate (acting(ns), done(nc))
    done(:) = .false.
    if (rule == rule_block .and. fits_lanes(handle%lowered)) then
        call solve_in_lanes(handle%lowered, handle%cases, factor, supp(:, :nv - 1, :), closed, w, ml, mr, react, solves, done)
        where (done) status = gapbeam_solved
        if (all(done)) return
    end if
    loaded = handle%lowered%beam
    call new_workspace(loaded, work)
    nan = ieee_value(nan, ieee_quiet_nan)
    do i = 1, nc
        if (done(i)) cycle
        w(:, i) = nan
        ml(:, i) = nan
        mr(:, i) = nan
        react(:, i) = nan
        acting(:) = closed(:ns, i) /= 0
        closed(:, i) = 0
        if (nv > 1) then
            call replace_supports(handle%lowered, supp(:, :nv - 1, i), loaded, status(i))
            if (status(i) /= gapbeam_solved) cycle
        end if
        call solve_case(handle%cases, factor(:, i), rule, loaded, acting, work, status(i))
        if (status(i) == gapbeam_no_memory) then
            status = gapbeam_no_memory
            return
        end if
        solves(i) = work%solves
        if (status(i) /= gapbeam_solved) cycle
        associate (units => handle%lowered%units, a => work%answers)
            w(:, i) = scale(a%deflection, units%deflection)
            ml(:, i) = scale(a%moment_left, moment_unit(units))
            mr(:, i) = scale(a%moment_right, moment_unit(units))
            react(:ns, i) = scale(work%reaction, units%force)
        end associate
        if (all(abs(w(:, i)) <= huge(nan)) .and. all(abs(ml(:, i)) <= huge(nan)) .and. all(abs(mr(:, i)) <= huge(nan)) &
            .and. all(abs(react(:ns, i)) <= huge(nan))) then
            closed(:ns, i) = merge(1, 0, acting)
        else
            status(i) = gapbeam_not_finite
            w(:, i) = nan
            ml(:, i) = nan
            mr(:, i) = nan
            react(:, i) = nan
        end if
    end do
end subroutine gbcase
