!> Numbers in ascending order.
module gapbeam_ordered
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: sort, sort_once, last_not_above

contains

    !> Sort numbers (Shell 1959)
    pure subroutine sort(numbers)
        real(wp), intent(inout) :: numbers(:)
        real(wp) :: one
        integer :: gap, i, j

        gap = 1
        do while (gap < size(numbers)/3)
            gap = 3*gap + 1
        end do
        do while (gap > 0)
            do i = gap + 1, size(numbers)
                one = numbers(i)
                j = i
                do while (j > gap)
                    if (numbers(j - gap) <= one) exit
                    numbers(j) = numbers(j - gap)
                    j = j - gap
                end do
                numbers(j) = one
            end do
            gap = gap/3
        end do
    end subroutine sort

    !> Sort numbers, and leave out what is there twice
    pure subroutine sort_once(numbers)
        real(wp), allocatable, intent(inout) :: numbers(:)
        logical, allocatable :: other(:)

        call sort(numbers)
        allocate (other(size(numbers)))
        if (size(numbers) > 0) other(1) = .true.
        other(2:) = numbers(2:) > numbers(:size(numbers) - 1)
        numbers = pack(numbers, other)
    end subroutine sort_once

    !> The last of numbers in order that is not above another one, counted from 0; 0 also if none is
    pure function last_not_above(numbers, x) result(low)
        real(wp), intent(in) :: numbers(0:), x
        integer :: low, high, middle

        low = 0
        high = size(numbers)
        do while (high - low > 1)
            middle = low + (high - low)/2
            if (numbers(middle) <= x) then
                low = middle
            else
                high = middle
            end if
        end do
    end function last_not_above

end module gapbeam_ordered
