!> The beam under a train cut into cells in which the fields are polynomials.
!> It is cut where its pieces end and where axles and ends of its uniform loads are: in every such cell the fields are polynomials
!> in x, and while the train is in one interval, in its place as well.
module gapbeam_train_cells
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type, fields_at
    use gapbeam_link, only: piece_type, piece_load_type, combine_loads
    use gapbeam_recover, only: recover_beam
    use gapbeam_workspace, only: workspace_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type
    implicit none
    private
    public :: cell_type, cells_type, new_cells, find_cells, fill_cells, recover_cells, cell_ends, fields_in_cell, x_in_cell, &
        cell_of_place

    !> A cell: its piece, the moving points at its ends (0: an end of the piece), the uniform load of the train on it in the
    !> engine's units
    type :: cell_type
        integer :: piece = 0, left = 0, right = 0
        real(wp) :: q = 0.0_wp
    end type cell_type

    !> All cells from left to right
    type :: cells_type
        integer :: number = 0
        type(cell_type), allocatable :: cells(:)
        !> Last cell of every link, first cell of every piece
        integer, allocatable :: last(:), first(:)
        !> What moves: distances from the place of the train in ascending order, and forces there in the engine's units
        real(wp), allocatable :: offset(:), force(:)
        !> Number of the axle, -2i + 1 and -2i the ends of uniform load i
        integer, allocatable :: axle(:)
        !> The cells at a place of the train as pieces with loads, and the fields at their left ends
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: loads(:), no_load(:)
        type(field_type), allocatable :: starts(:)
    end type cells_type

contains

    !> Room for the cells of a beam under a train
    subroutine new_cells(track, cells, stat)
        type(track_type), intent(in) :: track
        type(cells_type), intent(out) :: cells
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: axle(size(track%train%offset) + 2*size(track%train%uniform)), most, moving, i, j, k

        ! An axle without a force changes nothing, and a cell that ended there would have its extreme values on a curve of
        ! position and place, not at points
        moving = 0
        do i = 1, size(track%train%offset)
            if (abs(track%train%force(i)) > 0.0_wp) call add(i)
        end do
        do i = 1, size(track%train%uniform)
            call add(1 - 2*i)
            call add(-2*i)
        end do
        most = size(track%link) + moving
        allocate (cells%cells(most), cells%last(size(track%beam%links)), cells%first(size(track%link) + 1), cells%offset(moving), &
                  cells%force(moving), cells%axle(moving), cells%pieces(most), cells%loads(most), cells%no_load(most), &
                  cells%starts(most), stat=stat)
        if (stat /= 0) return
        cells%no_load(:) = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        cells%axle(:) = axle(:moving)
        do i = 1, moving
            k = axle(i)
            if (k > 0) then
                cells%offset(i) = track%train%offset(k)
                cells%force(i) = scale(track%train%force(k), -track%force_unit)
            else
                associate (load => track%train%uniform((1 - k)/2))
                    cells%offset(i) = merge(load%to, load%from, mod(k, 2) == 0)
                end associate
                cells%force(i) = 0.0_wp
            end if
        end do
        do i = 2, moving
            do j = i, 2, -1
                if (cells%offset(j - 1) <= cells%offset(j)) exit
                k = cells%axle(j)
                cells%axle(j) = cells%axle(j - 1)
                cells%axle(j - 1) = k
                cells%offset(j - 1:j) = cells%offset(j:j - 1:-1)
                cells%force(j - 1:j) = cells%force(j:j - 1:-1)
            end do
        end do

    contains

        !> Add what moves
        subroutine add(number)
            integer, intent(in) :: number

            moving = moving + 1
            axle(moving) = number
        end subroutine add

    end subroutine new_cells

    !> The cells of an interval
    subroutine find_cells(track, interval, cells)
        type(track_type), intent(in) :: track
        type(interval_type), intent(in) :: interval
        type(cells_type), intent(inout) :: cells
        real(wp) :: middle, from, to
        integer :: i, j, k, next

        middle = interval%from + (interval%to - interval%from)/2
        cells%number = 0
        next = 1
        do j = 1, size(track%link)
            cells%first(j) = cells%number + 1
            call add(0)
            do while (next <= size(cells%offset))
                k = piece_of(next)
                if (k > j) exit
                if (k == j) then
                    cells%cells(cells%number)%right = next
                    call add(next)
                end if
                next = next + 1
            end do
            cells%last(track%link(j)) = cells%number
        end do
        cells%first(size(track%link) + 1) = cells%number + 1
        if (size(track%train%uniform) == 0) return
        do k = 1, cells%number
            call cell_ends(track, cells, cells%cells(k), middle, from, to)
            do i = 1, size(track%train%uniform)
                associate (x => from + (to - from)/2, load => track%train%uniform(i))
                    if (x <= middle + load%from .or. x >= middle + load%to) cycle
                    cells%cells(k)%q = cells%cells(k)%q + scale(load%q, track%length_unit - track%force_unit)
                end associate
            end do
        end do

    contains

        !> Add a cell that begins at a moving point, or at the left end of the piece
        subroutine add(left)
            integer, intent(in) :: left

            cells%number = cells%number + 1
            cells%cells(cells%number) = cell_type(piece=j, left=left)
        end subroutine add

        !> Piece in which a moving point is, 0 if none
        pure function piece_of(point) result(piece)
            integer, intent(in) :: point
            integer :: piece, load

            if (cells%axle(point) > 0) then
                piece = interval%piece(cells%axle(point))
                return
            end if
            piece = 0
            load = (1 - cells%axle(point))/2
            if (interval%first(load) > interval%last(load)) return
            associate (x => middle + cells%offset(point))
                if (x < 0.0_wp .or. x > track%x(ubound(track%x, 1))) return
            end associate
            piece = merge(interval%first(load), interval%last(load), cells%axle(point) == 1 - 2*load)
        end function piece_of

    end subroutine find_cells

    !> The ends of a cell in the user's units
    pure subroutine cell_ends(track, cells, cell, s, from, to)
        type(track_type), intent(in) :: track
        type(cells_type), intent(in) :: cells
        type(cell_type), intent(in) :: cell
        !> Place of the train
        real(wp), intent(in) :: s
        real(wp), intent(out) :: from, to

        associate (x => track%x, j => cell%piece)
            from = x(j - 1)
            to = x(j)
            if (cell%left > 0) from = min(max(s + cells%offset(cell%left), from), to)
            if (cell%right > 0) to = min(max(s + cells%offset(cell%right), from), to)
        end associate
    end subroutine cell_ends

    !> Make pieces and loads of the cells
    subroutine fill_cells(assembled, track, s, cells)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        !> Place of the train
        real(wp), intent(in) :: s
        type(cells_type), intent(inout) :: cells
        type(piece_load_type) :: whole
        real(wp) :: from, to
        integer :: k, j

        j = 0
        do k = 1, cells%number
            associate (cell => cells%cells(k), load => cells%loads(k), p => cells%pieces(k))
                if (cell%piece /= j) then
                    j = cell%piece
                    whole = combine_loads(assembled%dead(j), assembled%live(j), 1.0_wp)
                end if
                p = assembled%pieces(j)
                load = whole
                if (cell%left > 0 .or. cell%right > 0) then
                    call cell_ends(track, cells, cell, s, from, to)
                    from = scale(from - track%x(j - 1), -track%length_unit)
                    to = scale(to - track%x(j - 1), -track%length_unit)
                    if (cell%right == 0) to = p%length
                    p%length = max(0.0_wp, to - from)
                    load%qa = whole%qa + (whole%qb - whole%qa)*(from/assembled%pieces(j)%length)
                    load%qb = whole%qa + (whole%qb - whole%qa)*(to/assembled%pieces(j)%length)
                end if
                if (cell%right > 0) then
                    load%force = cells%force(cell%right)
                    load%couple = 0.0_wp
                end if
                load%qa = load%qa + cell%q
                load%qb = load%qb + cell%q
            end associate
        end do
    end subroutine fill_cells

    !> Fields at the left ends of all cells, from the solution at the nodes
    subroutine recover_cells(track, work, cells)
        !> With the train at the place of the cells, and its solution
        type(track_type), intent(in) :: track
        type(workspace_type), intent(in) :: work
        !> After fill_cells
        type(cells_type), intent(inout) :: cells

        associate (n => cells%number)
            call recover_beam(cells%pieces(:n), cells%loads(:n), cells%no_load(:n), 1.0_wp, track%beam%links, cells%last, &
                              track%beam%kind, work%answers%deflection, work%answers%moment_left, work%answers%moment_right, &
                              work%shear, cells%starts(:n))
        end associate
    end subroutine recover_cells

    !> Fields at a distance from the left end of a cell
    pure function fields_in_cell(start, distance, piece, load) result(fields)
        !> Fields at its left end, and the distance
        type(field_type), intent(in) :: start
        real(wp), intent(in) :: distance
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        type(field_type) :: fields

        if (piece%length > 0.0_wp) then
            fields = fields_at(start, distance, piece%length, piece%flexibility, piece%shear_flexibility, load%qa, load%qb, &
                               load%kappa)
        else
            fields = start
        end if
    end function fields_in_cell

    !> Place in a cell, from the share of its length
    pure function x_in_cell(track, cells, cell, s, share) result(x)
        type(track_type), intent(in) :: track
        type(cells_type), intent(in) :: cells
        type(cell_type), intent(in) :: cell
        real(wp), intent(in) :: s, share
        real(wp) :: x, from, to

        call cell_ends(track, cells, cell, s, from, to)
        x = from + share*(to - from)
        if (share >= 1.0_wp) x = to
    end function x_in_cell

    !> Cell of a piece in which a place is
    pure function cell_of_place(track, cells, piece, x, s) result(k)
        type(track_type), intent(in) :: track
        type(cells_type), intent(in) :: cells
        integer, intent(in) :: piece
        real(wp), intent(in) :: x, s
        integer :: k
        real(wp) :: from, to

        do k = cells%first(piece), cells%first(piece + 1) - 1
            call cell_ends(track, cells, cells%cells(k), s, from, to)
            if (x <= to) return
        end do
        k = cells%first(piece + 1) - 1
    end function cell_of_place

end module gapbeam_train_cells
