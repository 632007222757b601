! Extremes of cases, and fields, for Python, in the manner of face/python.f90, which says what the arguments BEAM, NL, NS, ND, NV
! and NC are; NP and PC as for GBCASE

! Find the extremes of the fields of NC cases that GBCASE has solved, and the fields at NX places (one more than there are)
subroutine gbcext(beam, nl, ns, nd, nv, np, nc, pc, nx, nb, factor, supp, span, rule, closed, w, ml, mr, want, extr, place, piece, &
                  dist, field, status, there)
    use gapbeam_python_handles, only: handle_type, behind
    use gapbeam_lane_spans, only: fits_spans
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_case_extremes, only: case_fields_type, has_lane_extremes, extremes_of_cases
    implicit none
    integer(8), intent(in) :: beam
    integer, intent(in) :: nl, ns, nd, nv, np, nc, pc, nx
    ! Quantities of bending (fortran/beam/quantities.f90)
    integer, intent(in) :: nb
    ! As for GBCASE
    double precision, intent(in), target :: factor(nd, nc), supp(3, nv, nc), span(2, np, pc)
    integer, intent(in) :: rule
    ! By GBCASE
    integer, intent(in), target :: closed(ns + 1, nc)
    double precision, intent(in), target :: w(0:nl, nc), ml(0:nl, nc), mr(0:nl, nc)
    ! 1 for those quantities that are asked for
    integer, intent(in) :: want(nb)
    ! Maximum and minimum of those, and where they are, in the scene's units; the others as they were, as are all of a case that is
    ! not solved
    double precision, intent(inout), target :: extr(2, nb, nc), place(2, nb, nc)
    ! Places, as for GBVALU, and the fields there
    integer, intent(in) :: piece(nx)
    double precision, intent(in) :: dist(nx)
    double precision, intent(inout), target :: field(nb, nx, nc)
    ! By GBCASE in; out otherwise where a case has no extremes. Where memory ends some say so
    integer, intent(inout), target :: status(nc)
    ! 0: not for such a beam, and nothing is done
    integer, intent(out) :: there
    !f2py threadsafe
    type(handle_type), pointer :: handle
    type(case_numbers_type) :: numbers
    type(case_solutions_type) :: solutions
    type(case_fields_type) :: found

    handle => behind(beam)
    there = merge(1, 0, allocated(handle%loads))
    if (there == 0) return
    if (.not. has_lane_extremes(handle%beam%lowered)) there = 0
    if (np > 1) then
        if (.not. fits_spans(handle%beam%lowered, handle%loads)) there = 0
    end if
    if (there == 0 .or. nc == 0) return
    numbers%factors => factor
    numbers%rule = rule
    if (nv > 1) numbers%supports => supp
    if (np > 1) numbers%spans => span
    solutions%closed => closed
    solutions%w => w
    solutions%ml => ml
    solutions%mr => mr
    solutions%status => status
    found%extremes => extr
    found%places => place
    found%fields => field
    call extremes_of_cases(handle%beam%lowered, handle%loads, numbers, solutions, want /= 0, piece(:nx - 1), dist(:nx - 1), found)
end subroutine gbcext
