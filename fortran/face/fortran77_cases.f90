! Many cases in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.

! Solve NCASE cases in one call, eight side by side. In each all loads act, dead or live, every one times a factor of its own. The
! digits are those of each case alone
subroutine gbmany(work, iwork, ncase, factor, nvary, supval, rule, istat, react, icond, defl, bmleft, bmrigt, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_input_error, only: of_loads, of_supports
    use gapbeam_api, only: prepared_type, count_supports, count_nodes
    use gapbeam_work, only: take_beam
    use gapbeam_work_cases, only: solve_shaped
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! Cases, 0 or more; factor of every load in every case, (NLOAD, NCASE)
    integer, intent(in) :: ncase
    double precision, intent(in) :: factor(*)
    ! 1: supports vary by case, 0: they are those of the beam, and SUPVAL is not read; settlement, gap and stiffness (above 0) of
    ! every support in every case, (3, NSUP, NCASE)
    integer, intent(in) :: nvary
    double precision, intent(in) :: supval(*)
    ! As for GBSOLV
    integer, intent(in) :: rule
    ! Of every case 0 solved, 1 no equilibrium, or an error as from GBSOLV
    integer, intent(inout) :: istat(*)
    ! Reaction of every support, up, and what it is, as from GBSUPP, (NSUP, NCASE); deflection, moments left and right of every
    ! node (NNODE of GBMOTN, NCASE). Not a number where a case is not solved; so are reactions of axial supports
    double precision, intent(inout) :: react(*), defl(*), bmleft(*), bmrigt(*)
    integer, intent(inout) :: icond(*)
    ! -1: no beam in WORK, or one that is not taken: on a foundation, or whose state depends on the way of the load; -3; -4: no
    ! finite number, ISTAT(1) is the number of the case; -5; -6: impossible, ISTAT(1) is the number of the case, or 0 where
    ! supports of this beam cannot vary: one has a law; -7; 15
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(error_type), allocatable :: error
    integer :: loads, supports

    info = 0
    if (rule /= 0 .and. rule /= 1) info = -7
    if (nvary /= 0 .and. nvary /= 1) info = -5
    if (ncase < 0) info = -3
    if (info /= 0) return
    call take_beam(work, iwork, 1, beam, info)
    if (info /= 0) return
    loads = size(beam%lowered%model%loads)
    supports = count_supports(beam)
    call solve_shaped(beam, loads, supports, count_nodes(beam), ncase, factor, nvary == 1, supval, rule, istat, react, icond, &
                      defl, bmleft, bmrigt, error)
    if (.not. allocated(error)) return
    info = error%code
    if (error%code /= gapbeam_bad_input) return
    ! What is refused of a beam has no table
    info = -1
    if (error%table == of_loads) info = -4
    if (error%table == of_supports) info = -6
    if (info /= -1 .and. ncase > 0) istat(1) = error%entry
end subroutine gbmany
