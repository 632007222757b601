! Many cases of loads for Python, in the manner of face/python.f90, which says what the arguments are

! Condense the loads of a beam one by one, for GBCASE
subroutine gbshar(beam, status)
    use gapbeam_python_handles, only: error_type, handle_type, behind
    use gapbeam_error, only: gapbeam_solved
    use gapbeam_cases, only: split_loads
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(out) :: status
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    handle => behind(beam)
    status = gapbeam_solved
    if (allocated(handle%loads)) return
    allocate (handle%loads)
    call split_loads(handle%beam%lowered, handle%loads, error)
    if (.not. allocated(error)) return
    deallocate (handle%loads)
    status = error%code
end subroutine gbshar

! Room for cases, kept from call to call; calls at the same time need one each. 0 where memory ends
subroutine gbroom(room)
    use gapbeam_python_handles, only: error_type, handle_type, number_of
    use gapbeam_handles, only: new_handle, cases_tag
    implicit none
    integer(8), intent(out) :: room
    type(handle_type), pointer :: handle
    type(error_type), allocatable :: error

    call new_handle(cases_tag, handle, error)
    room = number_of(handle)
end subroutine gbroom

! Solve NC cases of loads; every load counts with its factor
subroutine gbcase(beam, room, nw, nl, nr, nt, ns, nd, nv, np, nc, vc, pc, factor, supp, span, rule, closed, w, ml, mr, react, &
                  solves, status)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_many_cases, only: solve_cases
    implicit none
    ! The beam, and room of its own (GBROOM)
    integer(8), intent(in) :: beam, room
    ! One more than there are supports of the engine; loads, at least 1; cases
    integer, intent(in) :: ns, nd, nc
    ! One more than there are supports of the scene, or 1 where they are those of the scene
    integer, intent(in) :: nv
    ! One more than there are spans, or 1 where they are those of the scene
    integer, intent(in) :: np
    ! NC; or any number where they are those of the scene
    integer, intent(in) :: vc, pc
    ! Nodes, supports of the engine and one more; 1 where they are not wanted
    integer, intent(in) :: nw, nl, nr, nt
    ! Factor of every load in every case; settlement, gap and stiffness of every support, of supports without laws; EI and GA of
    ! every span
    double precision, intent(in), target :: factor(nd, nc), span(2, np, pc), supp(3, nv, vc)
    integer, intent(in) :: rule
    ! Schemes: start in, contact state out; of a case that is not solved all open, and its results are not numbers
    integer, intent(inout), target :: closed(ns, nc)
    ! In the scene's units: deflections and moments left and right of the nodes, reactions
    double precision, intent(inout), target :: w(nw, nc), ml(nl, nc), mr(nr, nc), react(nt, nc)
    ! Where memory ends all STATUS say so
    integer, intent(inout), target :: solves(nc), status(nc)
    !f2py threadsafe
    type(handle_type), pointer :: handle, kept
    type(case_numbers_type) :: numbers
    type(case_solutions_type) :: solutions

    handle => behind(beam)
    kept => behind(room)
    numbers%factors => factor
    numbers%rule = rule
    if (nv > 1) numbers%supports => supp
    if (np > 1) numbers%spans => span
    solutions%closed => closed
    if (nw > 1) solutions%w => w
    if (nl > 1) solutions%ml => ml
    if (nr > 1) solutions%mr => mr
    if (nt > 1) solutions%reaction => react
    solutions%solves => solves
    solutions%status => status
    call solve_cases(handle%beam%lowered, handle%loads, numbers, kept%cases%room, solutions)
end subroutine gbcase

! Solve one case of a beam with loads, every search from all supports closed, at the least cost of a call
subroutine gbone(beam, room, nd, nv, nb, factor, supp, rule, block, status)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_error, only: gapbeam_no_memory
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_many_cases, only: solve_cases
    implicit none
    ! As for GBCASE
    integer(8), intent(in) :: beam, room
    integer, intent(in) :: nd, nv, nb
    double precision, intent(in), target :: factor(nd), supp(3, nv)
    integer, intent(in) :: rule
    ! STATUS and solves; deflections; moments left and right; reactions; scheme; the factors again
    double precision, intent(inout), target :: block(nb)
    ! -1 where a factor is not finite, and nothing was done
    integer, intent(out) :: status
    !f2py threadsafe
    type(handle_type), pointer :: handle, kept
    type(case_numbers_type) :: numbers
    type(case_solutions_type) :: solutions
    integer, target :: solves(1), found(1)
    integer, allocatable, target :: closed(:, :)
    integer :: n, m, at, stat

    status = -1
    if (.not. all(abs(factor) <= huge(1.0d0))) return
    handle => behind(beam)
    kept => behind(room)
    n = size(handle%beam%lowered%beam%links) + 1
    m = size(handle%beam%lowered%beam%supports)
    at = 3*n + 2
    status = gapbeam_no_memory
    allocate (closed(m, 1), source=1, stat=stat)
    if (stat /= 0) return
    numbers%factors(1:nd, 1:1) => factor
    numbers%rule = rule
    if (nv > 1) numbers%supports(1:3, 1:nv, 1:1) => supp
    solutions%closed => closed
    solutions%w(1:n, 1:1) => block(3:n + 2)
    solutions%ml(1:n, 1:1) => block(n + 3:2*n + 2)
    solutions%mr(1:n, 1:1) => block(2*n + 3:at)
    solutions%reaction(1:m, 1:1) => block(at + 1:at + m)
    solutions%solves => solves
    solutions%status => found
    call solve_cases(handle%beam%lowered, handle%loads, numbers, kept%cases%room, solutions)
    status = found(1)
    block(1) = status
    block(2) = solves(1)
    block(at + m + 1:at + 2*m) = closed(:, 1)
    block(at + 2*m + 1:) = factor
end subroutine gbone
