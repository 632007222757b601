! Trains on the ground or on smooth laws for Python, in the manner of face/python.f90: plain arrays, nothing but marshalling.
! Positions are in the scene's units.
!
! BEAM is the handle of a prepared beam, TRAIN that of a train on its way over it. One call at a time may be for the same train.

! Move a train over a beam
subroutine gbrmak(beam, na, nu, offset, force, uniform, from, to, back, rule, train, sizes, status, message)
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_train, only: train_type, uniform_type
    use gapbeam_runs_handle, only: runs_handle_type, new_runs, runs_of
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
    ! Positions that are solved, those that are not (first and last of each), events, linear solves
    integer, intent(out) :: sizes(4), status
    character(len=240), intent(out) :: message
    !f2py threadsafe
    !f2py integer, intent(hide), depend(offset) :: na = shape(offset, 0)
    !f2py integer, intent(hide), depend(uniform) :: nu = shape(uniform, 1)
    type(handle_type), pointer :: handle
    type(runs_handle_type), pointer :: passing
    type(train_type) :: loads
    type(error_type), allocatable :: error
    integer :: i, k

    handle => handle_of(beam)
    sizes = 0
    allocate (loads%offset(na), loads%force(na), loads%uniform(count(abs(uniform(1, :nu - 1)) > 0.0d0)))
    loads%offset = offset
    loads%force = force
    k = 0
    do i = 1, nu - 1
        if (.not. abs(uniform(1, i)) > 0.0d0) cycle
        k = k + 1
        loads%uniform(k) = uniform_type(uniform(1, i), uniform(2, i), uniform(3, i))
    end do
    call new_runs(handle%lowered, loads, [from, to], back /= 0, rule, train, error)
    call report(error, status, message)
    if (allocated(error)) return
    passing => runs_of(train)
    associate (runs => passing%runs)
        do i = 1, size(runs%runs)
            sizes(1) = sizes(1) + size(runs%runs(i)%states)
        end do
        sizes(2:) = [size(runs%lost), size(runs%events), runs%solves]
    end associate
end subroutine gbrmak

! Free a train
subroutine gbrdro(train)
    use gapbeam_runs_handle, only: drop_runs
    implicit none
    integer(8), intent(in) :: train

    call drop_runs(train)
end subroutine gbrdro

! The way of a train: positions, and events
subroutine gbrget(train, na, ns, nl, ne, place, run, acts, ends, codes, lost, at, events)
    use gapbeam_runs_handle, only: runs_handle_type, runs_of
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
    type(runs_handle_type), pointer :: handle
    integer :: i, k, n

    place = 0.0d0
    run = 0
    acts = 0
    ends = 0.0d0
    codes = 0
    lost = 0
    at = 0.0d0
    events = 0
    handle => runs_of(train)
    associate (runs => handle%runs)
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
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_runs_handle, only: runs_handle_type, runs_of
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
    type(handle_type), pointer :: handle
    type(runs_handle_type), pointer :: passing
    type(peak_type), allocatable :: peaks(:)
    type(error_type), allocatable :: error
    integer :: k

    handle => handle_of(beam)
    passing => runs_of(train)
    ties = 0
    values = 0.0d0
    sides = 0
    call peaks_of(handle%lowered, passing%runs, asked_type(of, number, row, least /= 0), peaks, error)
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
    use gapbeam_error, only: error_type
    use gapbeam_beam_handle, only: handle_type, handle_of, report
    use gapbeam_runs_handle, only: runs_handle_type, runs_of
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
    !f2py integer, intent(hide), depend(which) :: nq = shape(which, 0)
    !f2py integer, intent(hide), depend(x) :: nx = shape(x, 0)
    type(handle_type), pointer :: handle
    type(runs_handle_type), pointer :: passing
    type(error_type), allocatable :: error

    handle => handle_of(beam)
    passing => runs_of(train)
    value = 0.0d0
    position = 0.0d0
    call find_lines(handle%lowered, passing%runs, which, x, left /= 0, value, position, error)
    call report(error, status, message)
end subroutine gbrcur
