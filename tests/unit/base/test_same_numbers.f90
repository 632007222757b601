!> Numbers of which those that differ by rounding are one
program test_same_numbers
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_same_numbers, only: same_numbers_type, new_numbers, find_same
    implicit none
    integer :: status

    call near_ones_are_one()
    call many_stay_what_they_are()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> The first stands for those nearer than the width, wherever cells end
    subroutine near_ones_are_one()
        type(same_numbers_type) :: numbers
        real(wp) :: same

        call new_numbers(0.125_wp, numbers)
        call find_same(numbers, 0.05_wp, same)
        call check_close(same, 0.0_wp, "near zero", absolute=0.0_wp)
        call find_same(numbers, 1.05_wp, same)
        call check_close(same, 1.05_wp, "the first of its kind")
        call find_same(numbers, 1.07_wp, same)
        call check_close(same, 1.05_wp, "in the next cell")
        call find_same(numbers, 0.95_wp, same)
        call check_close(same, 1.05_wp, "in the cell before")
        call find_same(numbers, -1.05_wp, same)
        call check_close(same, -1.05_wp, "of the other sign")
        call new_numbers(0.0_wp, numbers)
        call find_same(numbers, 1e-300_wp, same)
        call check_close(same, 1e-300_wp, "without width", absolute=0.0_wp)
    end subroutine near_ones_are_one

    !> While the table grows
    subroutine many_stay_what_they_are()
        type(same_numbers_type) :: numbers
        real(wp) :: same
        integer :: i, round
        logical :: kept

        call new_numbers(0.25_wp, numbers)
        kept = .true.
        do round = 0, 1
            do i = -5000, 5000
                call find_same(numbers, i + 0.125_wp*round, same)
                kept = kept .and. nint(8*same) == 8*i
            end do
        end do
        call check(kept, "ten thousand numbers are found again")
    end subroutine many_stay_what_they_are

end program test_same_numbers
