! Quantities along the beam by their numbers in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.
!
!     IQUAN(NQUAN)      1 deflection, 2 rotation, 3 moment, 4 shear, 5 axial force, 6 axial displacement, 7 pressure of the ground
!                       (up), 8 curvature (sagging: M/EI less what is imposed), 9 transverse force (shear and axial force times
!                       slope). Numbers stay, and new quantities get new ones

! Exact values at places
subroutine ghquan(beam, state, nquan, iquan, nx, x, left, value, info)
    use gapbeam_api_quantities, only: get_quantities
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    ! Quantities, 1 or more
    integer, intent(in) :: nquan, iquan(*)
    ! Places
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Where a quantity jumps: 0 its value right of the place, 1 left of it
    integer, intent(in) :: left
    ! All quantities at every place; 0 of what the beam does not have
    double precision, intent(inout) :: value(nquan, *)
    ! -1, -2, -3, -4, -5, -7; -6: a place off the beam; 14: a value out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. nquan < 1) info = -3
    if (info == 0 .and. nx < 0) info = -5
    if (info == 0 .and. left /= 0 .and. left /= 1) info = -7
    if (info /= 0) return
    call get_quantities(prepared%beam, solved%result, iquan(1:nquan), x(1:nx), value(:, 1:nx), error, left == 1)
    info = info_of(error, 6, ["quantities"], [4])
end subroutine ghquan

! Exact extremes along the beam
subroutine ghqxtr(beam, state, nquan, iquan, value, xvalue, info)
    use gapbeam_api_quantities, only: get_quantity_extremes
    use gapbeam_fortran77_info, only: error_type, handle_type, state_tag, find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, state
    integer, intent(in) :: nquan, iquan(*)
    ! Maximum and minimum of every quantity, and where they are
    double precision, intent(inout) :: value(2, *), xvalue(2, *)
    ! -1, -2, -3, -4; 14: a value out of range; 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, solved
    type(error_type), allocatable :: error

    call find_both(beam, state, state_tag, prepared, solved, info)
    if (info == 0 .and. nquan < 1) info = -3
    if (info /= 0) return
    call get_quantity_extremes(prepared%beam, solved%result, iquan(1:nquan), value(:, 1:nquan), xvalue(:, 1:nquan), error)
    info = info_of(error, 2, ["quantities"], [4])
end subroutine ghqxtr

! Largest and smallest values over all positions of a train; of quantities 1 to 4, 8 and 9
subroutine ghtqxt(beam, pass, nquan, iquan, value, info)
    use gapbeam_api_trains, only: train_extreme_type, get_train_quantity_extremes, copy_extremes
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_equilibrium, gapbeam_no_memory, handle_type, passing_tag, &
        find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, pass
    integer, intent(in) :: nquan, iquan(*)
    ! Largest (1) and smallest (2) of every quantity, as GHTXTR has them
    double precision, intent(inout) :: value(4, 2, *)
    ! -1, -3, -4; -2, also of another beam, or of other loads; 1: no position is solved; 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, passed
    type(train_extreme_type), allocatable :: found(:, :)
    type(error_type), allocatable :: error
    integer :: stat

    call find_both(beam, pass, passing_tag, prepared, passed, info)
    if (info == 0 .and. nquan < 1) info = -3
    if (info /= 0) return
    allocate (found(2, nquan), stat=stat)
    if (stat /= 0) info = gapbeam_no_memory
    if (info /= 0) return
    call get_train_quantity_extremes(prepared%beam, passed%passing, iquan(1:nquan), found, error)
    info = info_of(error, 2, ["quantities"], [4])
    if (info == 0 .and. .not. found(1, 1)%known) info = gapbeam_no_equilibrium
    if (info /= 0) return
    call copy_extremes(found, value(:, :, 1:nquan))
end subroutine ghtqxt

! Largest and smallest values at places over all positions of a train; of quantities 1 to 4, 8 and 9
subroutine ghtqcr(beam, pass, nquan, iquan, nx, x, curve, posn, info)
    use gapbeam_fortran77_shapes, only: fill_curves
    implicit none
    integer(8), intent(in) :: beam, pass
    integer, intent(in) :: nquan, iquan(*)
    ! Places; where a quantity jumps both sides count
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Largest (1) and smallest (2) of every quantity at every place, and the positions of the train
    double precision, intent(inout) :: curve(2, nquan, *), posn(2, nquan, *)
    ! -1 to -5; -6: a place off the beam; 1: no position is solved; 12 to 15, 18
    integer, intent(out) :: info

    call fill_curves(beam, pass, nquan, iquan, nx, x, [5, 6, 4], curve, posn, info)
end subroutine ghtqcr
