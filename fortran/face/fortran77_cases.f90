! Many cases in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.

! Make ready for many cases of a beam
subroutine ghcase(beam, cases, info)
    use gapbeam_new_objects, only: new_cases
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, find_first, number_of, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! For GHMANY; it keeps nothing of the beam, and is of no use after GHLOAD. Threads take one each
    integer(8), intent(out) :: cases
    ! -1, also of a beam that is not taken: one whose state depends on the loading history; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, room
    type(error_type), allocatable :: error

    cases = 0
    call find_first(beam, beam_tag, prepared, info)
    if (info /= 0) return
    call new_cases(prepared%beam, room, error)
    cases = number_of(room)
    info = info_of(error, 1)
end subroutine ghcase

! Solve NCASE cases in one call, eight side by side. In each all loads act, dead or live, every one times a factor of its own;
! where a state depends on the loading history, dead ones are put on first. The digits are those of each case alone
subroutine ghmany(beam, cases, ncase, factor, nvary, supval, rule, istat, react, icond, defl, bmleft, bmrigt, info)
    use gapbeam_input_error, only: of_loads, of_supports
    use gapbeam_api, only: count_supports, count_nodes
    use gapbeam_fortran77_shapes, only: solve_shaped
    use gapbeam_fortran77_info, only: error_type, handle_type, cases_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, cases
    ! Cases, 0 or more; factor of every load in every case, (NLOAD, NCASE)
    integer, intent(in) :: ncase
    double precision, intent(in) :: factor(*)
    ! 1: supports vary by case, 0: they are those of the beam, and SUPVAL is not read; settlement, gap and stiffness (above 0) of
    ! every support in every case, (3, NSUP, NCASE)
    integer, intent(in) :: nvary
    double precision, intent(in) :: supval(*)
    ! As for GHSOLV
    integer, intent(in) :: rule
    ! Of every case 0 solved, 1 no equilibrium, or an error as from GHSOLV
    integer, intent(inout) :: istat(*)
    ! Reaction of every support, up, and what it is, as from GHSUPP, (NSUP, NCASE); deflection, moments left and right of every
    ! node (NNODE of GHMOTN, NCASE). Not a number where a case is not solved; so are reactions of axial supports
    double precision, intent(inout) :: react(*), defl(*), bmleft(*), bmrigt(*)
    integer, intent(inout) :: icond(*)
    ! -1, -2, -3; -4: no finite number, ISTAT(1) is the number of the case; -5; -6: impossible, ISTAT(1) is the number of the case,
    ! or 0 where supports of this beam cannot vary: one has a law; -7; 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, room
    type(error_type), allocatable :: error

    call find_both(beam, cases, cases_tag, prepared, room, info)
    if (info == 0 .and. ncase < 0) info = -3
    if (info == 0 .and. nvary /= 0 .and. nvary /= 1) info = -5
    if (info /= 0) return
    associate (lowered => prepared%beam%lowered)
        call solve_shaped(prepared%beam, room%cases, size(lowered%model%loads), count_supports(prepared%beam), &
                          count_nodes(prepared%beam), ncase, factor, nvary == 1, supval, rule, istat, react, icond, defl, &
                          bmleft, bmrigt, error)
    end associate
    info = info_of(error, 1, ["rule"], [7])
    if (info /= -1) return
    if (error%table == of_loads) info = -4
    if (error%table == of_supports) info = -6
    if (info /= -1 .and. ncase > 0) istat(1) = error%entry
end subroutine ghmany
