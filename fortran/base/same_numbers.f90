!> Numbers of which those that differ by rounding are one: the first of them stands for the others.
module gapbeam_same_numbers
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: same_numbers_type, new_numbers, find_same

    !> Numbers in cells of a given width, by a table of cells with open addressing (Knuth 1973, 6.4)
    type :: same_numbers_type
        private
        !> Numbers nearer to each other are one
        real(wp) :: width = 0.0_wp
        integer :: count = 0
        !> Cells, and the number in each; none where it is not taken
        integer(int64), allocatable :: cell(:)
        real(wp), allocatable :: number(:)
        logical, allocatable :: taken(:)
    end type same_numbers_type

    !> Entries to begin with
    integer, parameter :: fewest = 255

contains

    !> No numbers yet but zero
    pure subroutine new_numbers(width, numbers)
        !> Numbers nearer to each other than this are one
        real(wp), intent(in) :: width
        type(same_numbers_type), intent(out) :: numbers
        real(wp) :: zero

        numbers%width = width
        call make_room(fewest, numbers)
        call find_same(numbers, 0.0_wp, zero)
    end subroutine new_numbers

    !> The number that stands for a given one: one that is there, or itself
    pure subroutine find_same(numbers, given, same)
        !> Less than 2**62 widths
        type(same_numbers_type), intent(inout) :: numbers
        real(wp), intent(in) :: given
        real(wp), intent(out) :: same
        integer(int64) :: cell
        integer :: i, k

        same = given
        if (.not. numbers%width > 0.0_wp) return
        cell = nint(given/numbers%width, int64)
        do i = 0, 2
            k = place_of(numbers, cell + i*(5 - 3*i)/2)
            if (.not. numbers%taken(k)) cycle
            if (abs(numbers%number(k) - given) > numbers%width) cycle
            same = numbers%number(k)
            return
        end do
        k = place_of(numbers, cell)
        ! Of two that are one with a third the first stays
        if (numbers%taken(k)) return
        numbers%cell(k) = cell
        numbers%number(k) = given
        numbers%taken(k) = .true.
        numbers%count = numbers%count + 1
        if (2*numbers%count > size(numbers%cell)) call make_room(2*size(numbers%cell) + 1, numbers)
    end subroutine find_same

    !> Where a cell is, or would be put
    pure function place_of(numbers, cell) result(k)
        type(same_numbers_type), intent(in) :: numbers
        integer(int64), intent(in) :: cell
        integer :: k

        k = int(modulo(cell, int(size(numbers%cell), int64))) + 1
        do while (numbers%taken(k))
            if (numbers%cell(k) == cell) return
            k = modulo(k, size(numbers%cell)) + 1
        end do
    end function place_of

    !> A larger table
    pure subroutine make_room(entries, numbers)
        integer, intent(in) :: entries
        type(same_numbers_type), intent(inout) :: numbers
        type(same_numbers_type) :: more
        integer :: i, k

        more%width = numbers%width
        more%count = numbers%count
        allocate (more%cell(entries), source=0_int64)
        allocate (more%number(entries), source=0.0_wp)
        allocate (more%taken(entries), source=.false.)
        if (allocated(numbers%cell)) then
            do i = 1, size(numbers%cell)
                if (.not. numbers%taken(i)) cycle
                k = place_of(more, numbers%cell(i))
                more%cell(k) = numbers%cell(i)
                more%number(k) = numbers%number(i)
                more%taken(k) = .true.
            end do
        end if
        call move_alloc(more%cell, numbers%cell)
        call move_alloc(more%number, numbers%number)
        call move_alloc(more%taken, numbers%taken)
    end subroutine make_room

end module gapbeam_same_numbers
