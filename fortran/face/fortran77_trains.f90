! Combinations of loads and trains in the Fortran 77 interface; all else is said in fortran77.f90. Marshalling only.

! Prepare another beam: every load times a factor, dead ones too, and supports that have moved further. It has a scheme of its own:
! results cannot be added up
subroutine ghcmbn(beam, factor, settle, combnd, ientry, info)
    use gapbeam_input_error, only: of_supports
    use gapbeam_new_objects, only: new_combination
    use gapbeam_fortran77_info, only: error_type, handle_type, beam_tag, find_first, number_of, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! Factor of every load; further movement of every support, down, of an axial one to the right
    double precision, intent(in) :: factor(*), settle(*)
    ! The other beam, with a watch of its own
    integer(8), intent(out) :: combnd
    ! Of bad input the number of the load or support, or 0
    integer, intent(out) :: ientry
    ! -1; -2 or -3: no finite number, a load too great, or supports that leave no room for each other; 14, 15
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, combined
    type(error_type), allocatable :: error

    combnd = 0
    ientry = 0
    call find_first(beam, beam_tag, prepared, info)
    if (info /= 0) return
    associate (model => prepared%beam%lowered%model)
        call new_combination(prepared%beam, factor(1:size(model%loads)), settle(1:size(model%supports)), combined, error)
    end associate
    combnd = number_of(combined)
    info = info_of(error, 2, ["settlements"], [3])
    if (info == 0) return
    ientry = error%entry
    if (info == -2 .and. error%table == of_supports) info = -3
end subroutine ghcmbn

! Move a train over a beam: loads that move together, followed from event to event in their position, which is that of the first
! axle. All loads of the beam stay, dead and live ones in full
subroutine ghtran(beam, naxle, axle, q, left, from, to, pass, number, info)
    use gapbeam_scene, only: gapbeam_unchanged
    use gapbeam_api_trains, only: moving_train_type
    use gapbeam_new_objects, only: new_passing
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_memory, handle_type, beam_tag, find_first, number_of, info_of
    implicit none
    integer(8), intent(in) :: beam
    ! Axles, 1 or more: distance of every one behind the first, 0 or more; force, down
    integer, intent(in) :: naxle
    double precision, intent(in) :: axle(2, *)
    ! Uniform load over the length of the train, down
    double precision, intent(in) :: q
    ! 0 the train goes to the right; 1 to the left, its axles then stand to the right of the first one
    integer, intent(in) :: left
    ! First and last position, in ascending order; -GBINF() and GBINF(): from the first axle on the beam, to the last
    double precision, intent(in) :: from, to
    ! The train on its way, which keeps nothing of the beam; it belongs to one thread at a time
    integer(8), intent(out) :: pass
    ! Numbers of events and gaps; linear solves
    integer, intent(inout) :: number(3)
    ! -1, also of a beam whose state depends on the loading history; -2, -3, -4, -5, -6; -7, also where there is no position from
    ! FROM to TO; 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, passed
    type(moving_train_type) :: train
    type(error_type), allocatable :: error
    integer :: stat

    pass = 0
    call find_first(beam, beam_tag, prepared, info)
    if (info == 0 .and. naxle < 1) info = -2
    if (info == 0 .and. left /= 0 .and. left /= 1) info = -5
    if (info /= 0) return
    allocate (train%distance(naxle), train%force(naxle), stat=stat)
    if (stat /= 0) info = gapbeam_no_memory
    if (info /= 0) return
    train%distance(:) = axle(1, 1:naxle)
    train%force(:) = axle(2, 1:naxle)
    train%q = q
    train%to_the_left = left == 1
    train%from = merge(gapbeam_unchanged, from, from < gapbeam_unchanged)
    train%to = merge(gapbeam_unchanged, to, to > huge(to))
    call new_passing(prepared%beam, train, passed, error)
    info = info_of(error, 1, ["distance", "force   ", "q       ", "from    ", "to      "], [3, 3, 4, 6, 7])
    if (info /= 0) return
    pass = number_of(passed)
    number = [size(passed%passing%events), size(passed%passing%gaps), passed%passing%solves]
end subroutine ghtran

! What changes while a train passes, and the positions that are not solved
subroutine ghtget(pass, maxev, evpos, ievent, maxgap, gap, igap, info)
    use gapbeam_fortran77_info, only: handle_type, passing_tag, find_first
    implicit none
    integer(8), intent(in) :: pass
    ! Room for events and gaps, 0 or more
    integer, intent(in) :: maxev, maxgap
    ! The first MAXEV events in the order in which they happen: position; support, what it is from there on and what happens, as
    ! IEVENT(3, .) of GHHGET
    double precision, intent(inout) :: evpos(*)
    integer, intent(inout) :: ievent(3, *)
    ! The first MAXGAP gaps: first and last position; 1 no equilibrium, 2 the beam buckles, 3 it can move freely without work of
    ! the loads, 12 or 13 no unique answer
    double precision, intent(inout) :: gap(2, *)
    integer, intent(inout) :: igap(*)
    ! -1, -2, -5
    integer, intent(out) :: info
    type(handle_type), pointer :: passed
    integer :: k

    call find_first(pass, passing_tag, passed, info)
    if (info == 0 .and. maxev < 0) info = -2
    if (info == 0 .and. maxgap < 0) info = -5
    if (info /= 0) return
    do k = 1, min(maxev, size(passed%passing%events))
        associate (event => passed%passing%events(k))
            evpos(k) = event%position
            ievent(:, k) = [event%support, event%state, event%change]
        end associate
    end do
    do k = 1, min(maxgap, size(passed%passing%gaps))
        associate (here => passed%passing%gaps(k))
            gap(:, k) = [here%from, here%to]
            igap(k) = here%reason
        end associate
    end do
end subroutine ghtget

! Largest and smallest values over all positions of a train but those of the gaps, exact in place and position
subroutine ghtxtr(beam, pass, field, supval, info)
    use gapbeam_api, only: count_supports
    use gapbeam_api_trains, only: train_extreme_type, get_train_extremes, copy_extremes
    use gapbeam_fortran77_info, only: error_type, gapbeam_no_equilibrium, gapbeam_no_memory, handle_type, passing_tag, &
        find_both, info_of
    implicit none
    integer(8), intent(in) :: beam, pass
    ! Of largest (1) and smallest (2) deflection, rotation, moment, shear: value, x, position, and -1 left of x or 1 right of it
    ! where the field jumps, else 0
    double precision, intent(inout) :: field(4, 2, 4)
    ! The same of reaction, opening, deflection, couple of every support, without x: 0
    double precision, intent(inout) :: supval(4, 2, 4, *)
    ! -1; -2, also of another beam, or of other loads; 1: no position is solved; 12 to 15, 18
    integer, intent(out) :: info
    type(handle_type), pointer :: prepared, passed
    type(train_extreme_type) :: fields(2, 4)
    type(train_extreme_type), allocatable :: supports(:, :, :)
    type(error_type), allocatable :: error
    integer :: k, stat

    call find_both(beam, pass, passing_tag, prepared, passed, info)
    if (info /= 0) return
    allocate (supports(2, 4, count_supports(prepared%beam)), stat=stat)
    if (stat /= 0) info = gapbeam_no_memory
    if (info /= 0) return
    call get_train_extremes(prepared%beam, passed%passing, fields, supports, error)
    info = info_of(error, 2)
    if (info == 0 .and. .not. fields(1, 1)%known) info = gapbeam_no_equilibrium
    if (info /= 0) return
    call copy_extremes(fields, field)
    do k = 1, size(supports, 3)
        call copy_extremes(supports(:, :, k), supval(:, :, :, k))
    end do
end subroutine ghtxtr

! Largest and smallest fields at places of the beam over all positions of a train but those of the gaps
subroutine ghtcrv(beam, pass, nx, x, curve, posn, info)
    use gapbeam_fortran77_shapes, only: fill_curves
    implicit none
    integer(8), intent(in) :: beam, pass
    ! Places; where a field jumps both sides count
    integer, intent(in) :: nx
    double precision, intent(in) :: x(*)
    ! Largest (1) and smallest (2) deflection, rotation, moment, shear at every place, and the positions of the train
    double precision, intent(inout) :: curve(2, 4, *), posn(2, 4, *)
    ! -1, -2, -3; -4: a place off the beam; 1: no position is solved; 12 to 15, 18
    integer, intent(out) :: info

    call fill_curves(beam, pass, 4, [1, 2, 3, 4], nx, x, [3, 4, 4], curve, posn, info)
end subroutine ghtcrv
