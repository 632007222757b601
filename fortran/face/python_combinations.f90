! Combinations for Python, in the manner of face/python.f90, which says what the arguments BEAM, NS and NM are

! Solve NC combinations of loads at full load; one that is not solved has values that are not numbers, and its code as STATUS
subroutine gbcomb(beam, ns, nd, nm, nc, nx, nv, np, nf, nq, ne, factor, settle, supp, span, modul, rule, closed, piece, dist, &
                  value, extr, place, field, solves, status)
    use gapbeam_kinds, only: not_a_number
    use gapbeam_python_handles, only: error_type, handle_type, behind
    use gapbeam_error, only: has_ended, gapbeam_solved
    use gapbeam_solution, only: state_type
    use gapbeam_combinations, only: combination_type, varied_type, combine, solve_combination, values_of_combination
    use gapbeam_search, only: rule_block
    use gapbeam_lane_cases, only: fits_lanes, find_contact_states
    implicit none
    integer(8), intent(in) :: beam
    ! One more than there are: supports of the engine, loads, supports of the scene, places; combinations
    integer, intent(in) :: ns, nd, nm, nx, nc
    ! NM, or 1 where the supports are those of the scene
    integer, intent(in) :: nv
    ! One more than there are spans or foundations, or 1 where they are those of the scene
    integer, intent(in) :: np, nf
    ! All quantities along the beam (fortran/beam/quantities.f90)
    integer, intent(in) :: nq
    ! NQ where the extremes of all of them are wanted, else 0
    integer, intent(in) :: ne
    ! Factor of every load, further movement of every support; settlement, gap and stiffness of every support
    double precision, intent(in) :: factor(nd, nc), settle(nm, nc)
    double precision, intent(in), target :: supp(3, nv, nc)
    ! EI and GA of every span; modulus of every foundation, negative: that of the scene
    double precision, intent(in), target :: span(2, np, nc), modul(nf, nc)
    integer, intent(in) :: rule
    ! Schemes: start in, contact state out, all open where there is none
    integer, intent(inout) :: closed(ns, nc)
    ! Places, as for GBVALU
    integer, intent(in) :: piece(nx)
    double precision, intent(in) :: dist(nx)
    ! Reaction, deflection, opening, couple of the supports
    double precision, intent(out) :: value(nm, 4, nc)
    ! Maximum and minimum of the quantities, and where they are; the quantities at the places
    double precision, intent(out) :: extr(2, ne, nc), place(2, ne, nc), field(nq, nx, nc)
    integer, intent(out) :: solves(nc), status(nc)
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(combination_type) :: combined
    type(varied_type) :: varied
    type(state_type) :: state
    type(error_type), allocatable :: error
    integer :: i, found(nc)

    handle => behind(beam)
    value = not_a_number
    extr = not_a_number
    place = not_a_number
    field = not_a_number
    solves = 0
    found = 0
    if (rule == rule_block .and. np == 1 .and. nf == 1 .and. fits_lanes(handle%beam%lowered)) then
        call find_contact_states(handle%beam%lowered, factor(:nd - 1, :), settle(:nm - 1, :), supp(:, :nv - 1, :), closed, found)
    end if
    do i = 1, nc
        if (nv > 1) varied%supports => supp(:, :nv - 1, i)
        if (np > 1) varied%spans => span(:, :np - 1, i)
        if (nf > 1) varied%moduli => modul(:nf - 1, i)
        call combine(handle%beam%lowered, factor(:nd - 1, i), settle(:nm - 1, i), combined, error, varied)
        if (.not. allocated(error)) call solve_combination(combined%assembled, rule, closed(:ns - 1, i) /= 0, state, error)
        closed(:, i) = 0
        if (.not. allocated(error)) then
            solves(i) = max(found(i) - 1, 0) + state%solves   ! the last one again, for all that is asked of it
            status(i) = state%status
            if (state%status == gapbeam_solved) then
                call values_of_combination(combined%assembled, state, piece(:nx - 1), dist(:nx - 1), value(:nm - 1, :, i), &
                                           extr(:, :, i), place(:, :, i), field(:, :nx - 1, i), error)
                closed(:ns - 1, i) = merge(1, 0, state%closed)
            end if
        end if
        if (.not. allocated(error)) cycle
        status(i) = error%code
        value(:, :, i) = not_a_number
        extr(:, :, i) = not_a_number
        place(:, :, i) = not_a_number
        field(:, :, i) = not_a_number
        closed(:, i) = 0
        if (has_ended(error)) then
            status(i:) = error%code
            return
        end if
    end do
end subroutine gbcomb
