! Certificates of cases for Python, in the manner of face/python.f90, which says what the argument BEAM is

! Certify NC cases
subroutine gbccrt(beam, nn, ns, nd, nv, np, nf, nc, factor, supp, span, modul, rule, given, closed, w, ml, mr, react, cert, known, &
                  status)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_case_certificates, only: certify_cases
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nn, ns, nd, nv, np, nf, nc
    ! As for GBCOMB
    double precision, intent(in), target :: factor(nd, nc), supp(3, nv, nc), span(2, np, nc), modul(nf, nc)
    integer, intent(in) :: rule
    ! 1: solutions are given, as from GBCASE; 0: each case is solved once more, and W, ML, MR and REACT are not looked at
    integer, intent(in) :: given
    integer, intent(in), target :: closed(ns, nc)
    double precision, intent(in), target :: w(nn, nc), ml(nn, nc), mr(nn, nc), react(ns, nc)
    ! Relative residuals of compatibility, equilibrium and complementarity; largest errors of deflections of the nodes, reactions;
    ! of deflections, rotations, moments, shears along the beam, in the scene's units; of a case that is not solved as they were
    double precision, intent(inout) :: cert(9, nc)
    ! 0 where deflections and rotations have no bound
    integer, intent(inout) :: known(nc)
    ! By GBCASE in; out otherwise where a case has no certificate. Where memory ends some say so
    integer, intent(inout), target :: status(nc)
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(case_numbers_type) :: numbers
    type(case_solutions_type) :: solutions
    logical :: has_position(nc)

    handle => behind(beam)
    numbers%factors => factor
    numbers%rule = rule
    if (nv > 1) numbers%supports => supp
    if (np > 1) numbers%spans => span
    if (nf > 1) numbers%moduli => modul
    solutions%closed => closed
    solutions%status => status
    if (given /= 0) then
        solutions%w => w
        solutions%ml => ml
        solutions%mr => mr
        solutions%reaction => react
    end if
    call certify_cases(handle%beam%lowered, handle%loads, numbers, solutions, cert, has_position)
    known = merge(1, 0, has_position)
end subroutine gbccrt
