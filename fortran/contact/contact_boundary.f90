!> Boundaries of contact, where a row of closed supports ends and the beam lifts off.
!>
!> At a boundary that stands too far out only the few supports next to it pull, one up, one down, so switching the wrong ones
!> moves it by a few supports a solve. But on a base that the beam lies on closely the moment beyond what the shape of the
!> base asks for has to vanish at a boundary, and where the lifted stretch ends in the free, statics tell at which support
!> it does. Between two boundaries, where shear and moment change as they move, this is repeated with a limit.
module gapbeam_contact_boundary
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: plain
    use gapbeam_law_adapters, only: find_single
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type
    implicit none
    private
    public :: base_type, find_base, move_boundaries

    !> Where boundaries can be
    type :: base_type
        !> The one-sided support of every node at which a boundary can be, else 0; shape (-1:n + 1)
        integer, allocatable :: support(:)
        !> Its side, 1 or -1, shape (0:n)
        integer, allocatable :: side(:)
        !> Moment of a beam that follows the contact levels, shape (0:n)
        real(wp), allocatable :: moment(:)
    end type base_type

    !> Neighbouring supports on the same side in the same state
    type :: run_type
        integer :: first = 0, last = -1
        logical :: closed = .false.
        !> Is any of them wrong; does it lie beside a boundary that moves
        logical :: wrong = .false., adjacent = .false.
    end type run_type

contains

    !> Find where boundaries can be: single one-sided supports at plain nodes
    pure subroutine find_base(beam, base)
        type(beam_type), intent(in) :: beam
        !> Its supports by nodes
        type(base_type), intent(out) :: base
        real(wp), allocatable :: contact(:)
        real(wp) :: left, right, bending
        integer :: i, n

        n = size(beam%links)
        allocate (base%support(-1:n + 1), base%side(0:n), base%moment(0:n), contact(0:n))
        base%support(:) = 0
        base%moment(:) = 0.0_wp
        call find_single(beam%supports, base%support(0:n), base%side, contact)
        where (beam%kind /= plain) base%support(0:n) = 0
        do i = 1, n - 1
            bending = beam%links(i)%bending + beam%links(i + 1)%bending
            if (any(base%support(i - 1:i + 1) == 0) .or. .not. bending > 0.0_wp) cycle
            left = (contact(i) - contact(i - 1))*beam%links(i)%inverse
            right = (contact(i + 1) - contact(i))*beam%links(i + 1)%inverse
            base%moment(i) = -2*(right - left)/bending
        end do
    end subroutine find_base

    !> See how far the boundaries have to move
    pure subroutine move_boundaries(beam, closed, work, base, few, wrong)
        !> The beam and its supports by nodes
        type(beam_type), intent(in) :: beam
        type(base_type), intent(in) :: base
        !> The scheme, solved in work
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> Supports that a boundary moves at least; less is left to switching
        integer, intent(in) :: few
        !> Wrong supports in, those to be changed out: beside a boundary that moves all that it passes and no others
        logical, intent(inout) :: wrong(:)
        type(run_type), allocatable :: runs(:)
        logical, allocatable :: passed(:)
        integer :: r, way, distance, j, k

        call find_runs(beam, closed, base, wrong, runs)
        allocate (passed(size(closed)), source=.false.)
        do r = 1, ubound(runs, 1) - 1
            if (.not. (runs(r)%closed .and. runs(r)%wrong)) cycle
            do way = -1, 1, 2
                j = merge(runs(r)%first, runs(r)%last, way == 1)
                associate (outer => runs(r - way))
                    distance = supports_to_open(beam, work, base, wrong, j, way)
                    if (outer%last >= outer%first .and. outer%first > 0 .and. outer%last < size(beam%links)) then
                        distance = min(distance, max(few, outer%last - outer%first + 1))
                    end if
                    if (distance < few) cycle
                    runs(r)%adjacent = .true.
                    outer%adjacent = .true.
                end associate
                do k = j, j + way*(distance - 1), way
                    passed(base%support(k)) = closed(base%support(k))
                end do
            end do
        end do
        do r = 1, ubound(runs, 1) - 1
            if (.not. runs(r)%adjacent) cycle
            do k = runs(r)%first, runs(r)%last
                wrong(base%support(k)) = .false.
            end do
        end do
        wrong = wrong .or. passed
    end subroutine move_boundaries

    !> Runs from left to right, with an empty one wherever a run has no neighbour
    pure subroutine find_runs(beam, closed, base, wrong, runs)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), wrong(:)
        type(base_type), intent(in) :: base
        type(run_type), allocatable, intent(out) :: runs(:)
        integer :: i, r, pass

        do pass = 1, 2
            r = 0
            do i = 0, size(beam%links)
                associate (k => base%support(i), before => base%support(i - 1))
                    if (k == 0) cycle
                    if (.not. neighbours(base, i - 1, i)) then
                        r = r + 2
                    else if (closed(before) .neqv. closed(k)) then
                        r = r + 1
                    end if
                    if (pass == 1) cycle
                    if (runs(r)%last < 0) runs(r)%first = i
                    runs(r)%last = i
                    runs(r)%closed = closed(k)
                    runs(r)%wrong = runs(r)%wrong .or. wrong(k)
                end associate
            end do
            if (pass == 1) allocate (runs(0:r + 1))
        end do
    end subroutine find_runs

    !> Have two nodes supports of the same base
    pure function neighbours(base, one, other) result(same)
        type(base_type), intent(in) :: base
        integer, intent(in) :: one, other
        logical :: same

        same = base%support(one) > 0 .and. base%support(other) > 0
        if (same) same = base%side(one) == base%side(other)
    end function neighbours

    !> How many supports from node j on would have to go until the moment vanishes, if shear and moment outside stayed
    pure function supports_to_open(beam, work, base, wrong, j, way) result(distance)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: wrong(:)
        type(workspace_type), intent(in) :: work
        type(base_type), intent(in) :: base
        !> First closed node; way into the closed supports, 1 to the right, -1 to the left
        integer, intent(in) :: j, way
        integer :: distance, k
        real(wp) :: moment, shear

        distance = 0
        shear = 0.0_wp
        if (way == 1 .and. j > 0) shear = work%shear(j)
        if (way == -1 .and. j < size(beam%links)) shear = work%shear(j + 1)
        moment = merge(work%answers(j)%moment_right, work%answers(j)%moment_left, way == 1)
        associate (side => base%side(j))
            if (.not. (wrong(base%support(j)) .or. side*(moment - base%moment(j)) > 0.0_wp)) return
            k = j
            do
                distance = distance + 1
                if (.not. neighbours(base, j, k + way)) return
                shear = shear - way*work%loads(k)%shear
                k = k + way
                moment = moment + way*shear*beam%links(max(k, k - way))%length
                if (side*(moment - base%moment(k)) <= 0.0_wp) return
                moment = moment + way*work%loads(k)%couple
            end do
        end associate
    end function supports_to_open

end module gapbeam_contact_boundary
