!> How far a beam slides at once over ground that is stiff along it.
!>
!> Where ground slides anew it no longer takes what was beyond its limit, and that is passed on. Newton's method lets zones grow by
!> a few lengths over which springs settle, 1/sqrt(c K); where these are short beside the zones it would take thousands of steps.
!> So what is passed on is given to the ground beyond, each part up to its limit.
module gapbeam_bedding_growth
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: found_zone
    use gapbeam_exponential_curve, only: curve_type, value_of
    use gapbeam_axial_bedding, only: cell_type, bedding_type, give_way, settled_push, force_at, friction_on, is_bedded
    implicit none
    private
    public :: grow_zones

    !> Growth, in lengths over which springs settle, below which Newton's method needs no help; tuned
    real(qp), parameter :: least_growth = 0.25_qp

contains

    !> Let zones that have grown by more than such a length grow by what they pass on
    pure subroutine grow_zones(bedding, cells)
        !> Solved for the zones before
        type(bedding_type), intent(in) :: bedding
        !> Zones as Newton's method has them in, from left to right
        type(cell_type), allocatable, intent(inout) :: cells(:)
        real(qp) :: excess(2, size(cells))
        integer :: now(size(cells)), k, side, divided

        call find_excess(bedding, cells, excess)
        now(:) = [(k, k=1, size(now))]
        do k = 1, size(now)
            do side = 1, 2
                if (.not. excess(side, k) > 0.0_qp) cycle
                call give_on(bedding, cells, now(k), 2*side - 3, excess(side, k), divided)
                where (now > divided) now = now + merge(1, 0, divided > 0)
            end do
        end do
    end subroutine grow_zones

    !> What ground that slides anew at the left and the right end of a zone took beyond its limit
    pure subroutine find_excess(bedding, cells, excess)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cells(:)
        real(qp), intent(out) :: excess(:, :)
        type(cell_type) :: part
        type(curve_type) :: push
        real(qp) :: at(2), more
        integer :: i, k, first

        excess(:, :) = 0.0_qp
        first = 1
        do k = 1, size(cells)
            if (cells(k)%way == 0) cycle
            do while (bedding%cells(first)%memory < cells(k)%memory)
                first = first + 1
            end do
            do i = first, size(bedding%cells)
                associate (old => bedding%cells(i))
                    if (old%memory > cells(k)%memory) exit
                    part = cells(k)
                    part%from = max(old%from, part%from)
                    part%to = min(old%to, part%to)
                    if (old%way /= 0 .or. (part%to - part%from)*old%displacement%rate <= least_growth) cycle
                    push = give_way(bedding, old)
                    at(:) = part%way*[value_of(push, part%from), value_of(push, part%to)]
                    ! Along it the axial force changes by what the ground takes, less the load
                    more = part%way*(force_at(bedding, old, part%to) - force_at(bedding, old, part%from) &
                                     + bedding%loads%along(part%bar)*(part%to - part%from)) + friction_on(bedding, part)*part%way
                    if (at(1) > at(2) .and. part%to >= cells(k)%to) excess(2, k) = more
                    if (at(2) > at(1) .and. part%from <= cells(k)%from) excess(1, k) = more
                end associate
            end do
        end do
    end subroutine find_excess

    !> What the ground of a cell takes against a way, beyond what it takes where nothing comes from beside it
    pure function capacity(bedding, cell, way) result(force)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), intent(in) :: cell
        integer, intent(in) :: way
        real(qp) :: force, even(2)

        even(:) = settled_push(bedding, cell)
        associate (t => bedding%limit(:, cell%bar))
            force = (cell%to - cell%from)*(t(1) - way*even(1) + (t(2) - t(1) - way*even(2))*(cell%from + cell%to)/2)
        end associate
        force = max(0.0_qp, force)
    end function capacity

    !> Let a zone grow beyond one of its ends until that ground takes a force: at most over half of what is held there, for others
    !> may grow into it from beyond
    pure subroutine give_on(bedding, cells, k, step, force, divided)
        type(bedding_type), intent(in) :: bedding
        type(cell_type), allocatable, intent(inout) :: cells(:)
        !> The cell at the end of the zone; 1 to the right, -1 to the left
        integer, intent(in) :: k, step
        real(qp), intent(in) :: force
        !> The cell of which there are two now, 0: none
        integer, intent(out) :: divided
        real(qp) :: left, share, at
        integer :: i, way

        divided = 0
        way = cells(k)%way
        left = 0.0_qp
        i = k
        do while (goes_on(i))
            i = i + step
            left = left + capacity(bedding, cells(i), way)
        end do
        left = min(force, left/2)
        i = k
        do while (goes_on(i) .and. left > 0.0_qp)
            i = i + step
            if (.not. is_bedded(bedding, cells(i)%bar)) cycle
            associate (takes => capacity(bedding, cells(i), way))
                share = cells(i)%to - cells(i)%from
                if (takes > left) share = share*(left/takes)
                if (cells(i)%to - cells(i)%from - share <= found_zone) then
                    cells(i)%way = way
                    left = left - takes
                    cycle
                end if
                ! The limit as if it were even: what is not, the next step of Newton's method mends
                at = merge(cells(i)%from + share, cells(i)%to - share, step > 0)
            end associate
            if (share <= found_zone) return
            cells = [cells(:i), cells(i:)]
            cells(i)%to = at
            cells(i + 1)%from = at
            cells(merge(i, i + 1, step > 0))%way = way
            divided = i
            return
        end do

    contains

        !> Is there one beyond a cell, that is held, and no rigid support between
        pure function goes_on(i) result(it_does)
            integer, intent(in) :: i
            logical :: it_does

            it_does = i + step >= 1 .and. i + step <= size(cells)
            if (.not. it_does) return
            associate (from => cells(i), to => cells(i + step))
                it_does = to%way == 0
                if (to%bar /= from%bar) it_does = it_does .and. bedding%support(min(from%bar, to%bar)) <= huge(1.0_wp)
            end associate
        end function goes_on

    end subroutine give_on

end module gapbeam_bedding_growth
