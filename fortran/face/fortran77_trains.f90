! Combinations of loads and trains in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.
!
! A train is loads that move together over a beam; its position is that of its first axle. All loads of the beam stay, dead and
! live ones in full. Every routine for trains follows it anew, from event to event in its position:
!
!     AXLE(2, NAXLE)    distance of every axle behind the first one, 0 or more; force, down
!     Q                 uniform load over the length of the train, down
!     LEFT              0 the train goes to the right; 1 to the left, its axles then stand to the right of the first one
!     FROM, TO          first and last position, in ascending order; -GBINF() and GBINF(): from the first axle on the beam, to the
!                       last
!
! INFO of these arguments: -1 no beam in WORK, or one on a foundation, or whose state depends on the way of the load; -3, -4, -5,
! -6, -7; -8 also where there is no position from FROM to TO; 12 to 15.

! Prepare another beam: every load times a factor, dead ones too, and supports that have moved further. It has a scheme of its own:
! results cannot be added up
subroutine gbcmbn(work, iwork, factor, settle, cwork, lcwork, icwork, licwrk, info)
    use gapbeam_error, only: error_type, gapbeam_bad_input
    use gapbeam_api, only: prepared_type
    use gapbeam_api_combinations, only: combine_loads
    use gapbeam_work, only: take_beam, put_beam
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! Factor of every load; further movement of every support, down, of an axial one to the right
    double precision, intent(in) :: factor(*), settle(*)
    ! Lengths, or -1: those of WORK and IWORK are enough
    integer, intent(in) :: lcwork, licwrk
    ! The other beam
    double precision, intent(inout) :: cwork(*)
    integer, intent(inout) :: icwork(*)
    ! -1: no beam in WORK; -3 or -4: no finite number, a load too great, or supports that leave no room for each other: ICWORK(1)
    ! is the number of the load or support, or 0; -6, -8: too short; 14, 15
    integer, intent(out) :: info
    type(prepared_type) :: beam, combined
    type(error_type), allocatable :: error
    integer :: short

    call take_beam(work, iwork, 1, beam, info)
    if (info /= 0) return
    if (lcwork == -1 .or. licwrk == -1) then
        cwork(1) = iwork(2)
        icwork(1) = iwork(3)
        return
    end if
    associate (loads => size(beam%lowered%model%loads), supports => size(beam%lowered%model%supports))
        if (.not. all(abs(settle(1:supports)) <= huge(settle))) info = -4
        call combine_loads(beam, factor(1:loads), combined, error, settle(1:supports))
    end associate
    if (allocated(error)) then
        if (error%code == gapbeam_bad_input) then
            if (error%table == 3) info = -4
            if (info == 0) info = -3
            icwork(1) = error%entry
        else
            info = error%code
        end if
        return
    end if
    call put_beam(combined, cwork, lcwork, icwork, licwrk, short)
    if (short > 0) info = merge(-6, -8, short == 1)
end subroutine gbcmbn

! Move a train over a beam: every change of the working scheme at its exact position, and the positions that are not solved
subroutine gbtran(work, iwork, naxle, axle, q, left, from, to, maxev, evpos, ievent, maxgap, gap, igap, number, info)
    use gapbeam_api, only: prepared_type
    use gapbeam_api_trains, only: passing_type
    use gapbeam_work_trains, only: pass_axles
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! The train
    integer, intent(in) :: naxle, left
    double precision, intent(in) :: axle(2, *), q, from, to
    ! Room for events and gaps, 0 or more
    integer, intent(in) :: maxev, maxgap
    ! The first MAXEV events in the order in which they happen: position; support, what it is from there on and what happens, as
    ! IEVENT(3, .) of GBHIST
    double precision, intent(inout) :: evpos(*)
    integer, intent(inout) :: ievent(3, *)
    ! The first MAXGAP gaps: first and last position; 1 no equilibrium, 2 the beam can move freely without work of the loads, 12 or
    ! 13 no unique answer
    double precision, intent(inout) :: gap(2, *)
    integer, intent(inout) :: igap(*)
    ! Numbers of events and gaps, which may be more than there is room for; linear solves
    integer, intent(inout) :: number(3)
    ! See above; -9, -12
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(passing_type) :: passing
    integer :: k

    info = 0
    if (maxev < 0) info = -9
    if (maxgap < 0) info = -12
    if (info /= 0) return
    call pass_axles(work, iwork, naxle, axle, q, left, from, to, beam, passing, info)
    if (info /= 0) return
    number = [size(passing%events), size(passing%gaps), passing%solves]
    do k = 1, min(maxev, number(1))
        associate (event => passing%events(k))
            evpos(k) = event%position
            ievent(:, k) = [event%support, event%state, event%change]
        end associate
    end do
    do k = 1, min(maxgap, number(2))
        gap(:, k) = [passing%gaps(k)%from, passing%gaps(k)%to]
        igap(k) = passing%gaps(k)%reason
    end do
end subroutine gbtran

! Largest and smallest values over all positions of a train but those of the gaps, exact in place and position
subroutine gbtxtr(work, iwork, naxle, axle, q, left, from, to, field, supval, info)
    use gapbeam_error, only: error_type, gapbeam_no_equilibrium, gapbeam_no_memory
    use gapbeam_api, only: prepared_type
    use gapbeam_api_trains, only: passing_type, train_extreme_type, get_train_extremes
    use gapbeam_work_trains, only: pass_axles
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! The train
    integer, intent(in) :: naxle, left
    double precision, intent(in) :: axle(2, *), q, from, to
    ! Of largest (1) and smallest (2) deflection, rotation, moment, shear: value, x, position, and -1 left of x or 1 right of it
    ! where the field jumps, else 0
    double precision, intent(inout) :: field(4, 2, 4)
    ! The same of reaction, opening, deflection, couple of every support, without x: 0
    double precision, intent(inout) :: supval(4, 2, 4, *)
    ! See above; 1: no position is solved
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(passing_type) :: passing
    type(train_extreme_type) :: fields(2, 4)
    type(train_extreme_type), allocatable :: supports(:, :, :)
    type(error_type), allocatable :: error
    integer :: i, j, k, stat

    call pass_axles(work, iwork, naxle, axle, q, left, from, to, beam, passing, info)
    if (info /= 0) return
    allocate (supports(2, 4, size(beam%lowered%model%supports)), stat=stat)
    if (stat /= 0) then
        info = gapbeam_no_memory
        return
    end if
    call get_train_extremes(beam, passing, fields, supports, error)
    if (allocated(error)) then
        info = error%code
        return
    end if
    if (.not. fields(1, 1)%known) then
        info = gapbeam_no_equilibrium
        return
    end if
    do j = 1, 4
        do i = 1, 2
            field(:, i, j) = numbers_of(fields(i, j))
            do k = 1, size(supports, 3)
                supval(:, i, j, k) = numbers_of(supports(i, j, k))
            end do
        end do
    end do

contains

    pure function numbers_of(extreme) result(numbers)
        type(train_extreme_type), intent(in) :: extreme
        double precision :: numbers(4)

        numbers = [extreme%value, extreme%x, extreme%position, dble(extreme%side)]
    end function numbers_of

end subroutine gbtxtr

! Largest and smallest fields at places of the beam over all positions of a train but those of the gaps
subroutine gbtcrv(work, iwork, naxle, axle, q, left, from, to, nx, x, curve, posn, info)
    use gapbeam_error, only: error_type, gapbeam_no_equilibrium, gapbeam_no_memory, gapbeam_bad_input
    use gapbeam_api, only: prepared_type
    use gapbeam_api_trains, only: passing_type, get_train_curves
    use gapbeam_work_trains, only: pass_axles
    implicit none
    ! Beam
    double precision, intent(in) :: work(*)
    integer, intent(in) :: iwork(*)
    ! The train
    integer, intent(in) :: naxle, left
    double precision, intent(in) :: axle(2, *), q, from, to
    ! Places; where a field jumps both sides count
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Largest (1) and smallest (2) deflection, rotation, moment, shear at every place, and the positions of the train
    double precision, intent(inout) :: curve(2, 4, *), posn(2, 4, *)
    ! See above; -9; -10: a place off the beam; 1: no position is solved
    integer, intent(out) :: info
    type(prepared_type) :: beam
    type(passing_type) :: passing
    double precision, allocatable :: value(:, :, :), position(:, :, :)
    type(error_type), allocatable :: error
    integer :: stat

    info = 0
    if (nx < 0) info = -9
    if (info /= 0) return
    call pass_axles(work, iwork, naxle, axle, q, left, from, to, beam, passing, info)
    if (info /= 0) return
    allocate (value(2, 4, nx), position(2, 4, nx), stat=stat)
    if (stat /= 0) then
        info = gapbeam_no_memory
        return
    end if
    call get_train_curves(beam, passing, x(1:nx), value, position, error)
    if (allocated(error)) then
        info = merge(-10, error%code, error%code == gapbeam_bad_input)
        return
    end if
    if (nx == 0) return
    if (.not. value(1, 1, 1) > -huge(value)) then
        info = gapbeam_no_equilibrium
        return
    end if
    curve(:, :, 1:nx) = value
    posn(:, :, 1:nx) = position
end subroutine gbtcrv
