! Trains on the ground or on smooth laws for Python, in the manner of face/python.f90: plain arrays, nothing but marshalling.
! Positions are in the scene's units.
!
! BEAM is the handle of a prepared beam, TRAIN that of a train on its way over it. One call at a time may be for the same train.

! Move a train over a beam
subroutine gbrmak(beam, na, nu, offset, force, uniform, from, to, back, rule, train, sizes, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, train_of, report
    use gapbeam_train_runs, only: follow_train_on_ground
    use gapbeam_handles, only: new_handle, finish_handle, number_of, passing_tag
    implicit none
    integer(8), intent(in) :: beam
    ! Axles; uniform loads and one more
    integer, intent(in) :: na, nu
    ! As for GBTMAK
    double precision, intent(in) :: offset(na), force(na), uniform(3, nu), from, to
    integer, intent(in) :: back
    ! 0 block, 1 single
    integer, intent(in) :: rule
    ! Handle; 0 where there is an error
    integer(8), intent(out) :: train
    ! Positions that are solved, those that are not (first and last of each), events, linear solves; 1: there may be other states
    integer, intent(out) :: sizes(5), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, passing
    type(error_type), allocatable :: error
    integer :: i

    handle => behind(beam)
    sizes = 0
    call new_handle(passing_tag, passing, error)
    if (.not. allocated(error)) then
        allocate (passing%passing%runs)
        call follow_train_on_ground(handle%beam%lowered, train_of(offset, force, uniform(:, :nu - 1)), rule, from, to, &
                                    back /= 0, passing%passing%runs, error)
    end if
    call finish_handle(passing, error)
    train = number_of(passing)
    call report(error, status, message)
    if (allocated(error)) return
    associate (runs => passing%passing%runs)
        do i = 1, size(runs%runs)
            sizes(1) = sizes(1) + size(runs%runs(i)%states)
        end do
        sizes(2:) = [size(runs%lost), size(runs%events), runs%solves, merge(1, 0, runs%are_some_of_several)]
    end associate
end subroutine gbrmak

! The way of a train: positions, and events
subroutine gbrget(train, na, ns, nl, ne, place, run, acts, ends, codes, lost, at, events)
    use gapbeam_python_handles, only: handle_type, behind
    implicit none
    integer(8), intent(in) :: train
    ! Axles; positions, ranges that are not solved, events: one more than there are
    integer, intent(in) :: na, ns, nl, ne
    ! Positions that are solved in ascending order, the number of their run, 1 for the axles that act
    double precision, intent(out) :: place(ns)
    integer, intent(out) :: run(ns), acts(na, ns)
    ! First and last position of what is not solved, as Status or NOT_UNIQUE, and the axles that act at the first
    double precision, intent(out) :: ends(2, nl)
    integer, intent(out) :: codes(nl), lost(na, nl)
    ! Of every event the position of the train and the place; support and foundation, from 0, or -1; branch, what happens
    double precision, intent(out) :: at(2, ne)
    integer, intent(out) :: events(4, ne)
    type(handle_type), pointer :: handle
    integer :: i, k, n

    place = 0.0d0
    run = 0
    acts = 0
    ends = 0.0d0
    codes = 0
    lost = 0
    at = 0.0d0
    events = 0
    handle => behind(train)
    associate (runs => handle%passing%runs)
        n = 0
        do i = 1, size(runs%runs)
            do k = 1, size(runs%runs(i)%states)
                n = n + 1
                place(n) = runs%boxes(runs%runs(i)%states(k))%of%position
                acts(:, n) = merge(1, 0, runs%boxes(runs%runs(i)%states(k))%of%acts)
                run(n) = i
            end do
        end do
        do i = 1, size(runs%lost)
            ends(:, i) = [runs%boxes(runs%lost(i)%first)%of%position, runs%boxes(runs%lost(i)%last)%of%position]
            codes(i) = runs%boxes(runs%lost(i)%first)%of%status
            lost(:, i) = merge(1, 0, runs%boxes(runs%lost(i)%first)%of%acts)
        end do
        do i = 1, size(runs%events)
            associate (e => runs%events(i))
                at(:, i) = [e%position, e%x]
                events(:, i) = [e%support - 1, e%foundation - 1, e%branch, e%change]
            end associate
        end do
    end associate
end subroutine gbrget

! The largest or smallest value of one quantity over all positions, all ties
subroutine gbrext(beam, train, of, number, row, least, ties, values, sides, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_train_asked, only: asked_type
    use gapbeam_train_peaks, only: peak_type
    use gapbeam_train_run_extremes, only: peaks_of
    implicit none
    integer(8), intent(in) :: beam, train
    ! 1 a field by its quantity, 2 a support, from 1, with the row 1 reaction, 2 deflection, 3 opening, 4 couple; 3 the force of a
    ! foundation, from 1, 4 its free span, with the row 1 length, 2 sag
    integer, intent(in) :: of, number, row
    ! 1: the smallest
    integer, intent(in) :: least
    ! Ties; of each value, x, position, and of a free span ends and sag; 1 left of x, 2 right of it, 0 both
    integer, intent(out) :: ties
    double precision, intent(out) :: values(6, 16)
    integer, intent(out) :: sides(16), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, passing
    type(peak_type), allocatable :: peaks(:)
    type(error_type), allocatable :: error
    integer :: k

    handle => behind(beam)
    passing => behind(train)
    ties = 0
    values = 0.0d0
    sides = 0
    call peaks_of(handle%beam%lowered, passing%passing%runs, asked_type(of, number, row, least /= 0), peaks, error)
    call report(error, status, message)
    if (allocated(error)) return
    ties = size(peaks)
    do k = 1, ties
        values(:, k) = [peaks(k)%value, peaks(k)%x, peaks(k)%position, peaks(k)%span]
        sides(k) = peaks(k)%side
    end do
end subroutine gbrext

! Largest and smallest values at places of the beam
subroutine gbrcur(beam, train, nq, nx, which, x, left, value, position, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_train_lines, only: find_lines
    implicit none
    integer(8), intent(in) :: beam, train
    ! Quantities, by their numbers (fortran/beam/quantities.f90); places
    integer, intent(in) :: nq, nx
    integer, intent(in) :: which(nq)
    double precision, intent(in) :: x(nx)
    ! 1: the value left of the place
    integer, intent(in) :: left(nx)
    ! Largest (1) and smallest (2) of each, and the positions of the train
    double precision, intent(out) :: value(2, nq, nx), position(2, nq, nx)
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, passing
    type(error_type), allocatable :: error

    handle => behind(beam)
    passing => behind(train)
    value = 0.0d0
    position = 0.0d0
    call find_lines(handle%beam%lowered, passing%passing%runs, which, x, left /= 0, value, position, error)
    call report(error, status, message)
end subroutine gbrcur

! Let states of a beam that the train stands on begin where the train comes to on its way
subroutine gbrway(beam, train, position, placed, status, message)
    use gapbeam_python_handles, only: error_type, handle_type, behind, report
    use gapbeam_train_limits, only: start_on_way
    implicit none
    integer(8), intent(in) :: beam, train
    double precision, intent(in) :: position
    ! The beam with the train at the position: new, nothing solved yet
    integer(8), intent(in) :: placed
    integer, intent(out) :: status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    type(handle_type), pointer :: handle, passing, other
    type(error_type), allocatable :: error

    handle => behind(beam)
    passing => behind(train)
    other => behind(placed)
    call start_on_way(handle%beam%lowered, passing%passing%runs, position, other%beam%lowered, other%beam%near, error)
    call report(error, status, message)
end subroutine gbrway
