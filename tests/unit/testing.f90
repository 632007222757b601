!> A few words for unit tests that report in the Test Anything Protocol (TAP), details of failures to standard error:
!>
!>     program test_topic
!>         use testing, only: check_close, finish
!>         implicit none
!>         integer :: status
!>         call some_tests()
!>         call finish(status)
!>         if (status /= 0) stop 1, quiet=.true.
!>     contains
!>         subroutine some_tests()
!>             call check_close(2 * 0.5d0, 1d0, "twice a half is one")
!>         end subroutine some_tests
!>     end program test_topic
!>
!> Keep allocatable variables in procedures: those of a main program are never freed, which the address
!> sanitizer takes for a leak.
module testing
    use, intrinsic :: iso_fortran_env, only: error_unit, output_unit, wp => real64
    implicit none
    private
    public :: check, check_close, finish

    !> Report whether two numbers or two vectors agree
    interface check_close
        module procedure check_close_scalar
        module procedure check_close_vector
    end interface check_close

    !> Error accepted when the caller names none, relative to the largest value expected
    real(wp), parameter :: default_relative = 1e-13_wp

    !> Checks made and failed so far
    integer :: checks = 0, failures = 0

contains

    !> Report one condition
    subroutine check(condition, name)
        !> True where the test holds
        logical, intent(in) :: condition
        !> What the test says
        character(len=*), intent(in) :: name

        checks = checks + 1
        if (condition) then
            write (output_unit, "(a, i0, 2a)") "ok ", checks, " - ", name
        else
            failures = failures + 1
            write (output_unit, "(a, i0, 2a)") "not ok ", checks, " - ", name
        end if
    end subroutine check

    !> Report whether a number is what it should be
    subroutine check_close_scalar(actual, expected, name, relative, absolute)
        !> The number found
        real(wp), intent(in) :: actual
        !> The number that is right
        real(wp), intent(in) :: expected
        !> What the test says
        character(len=*), intent(in) :: name
        !> Largest error accepted, relative to `expected`; default 1e-13
        real(wp), intent(in), optional :: relative
        !> Largest error accepted besides; default 0
        real(wp), intent(in), optional :: absolute

        call check_close_vector([actual], [expected], name, relative, absolute)
    end subroutine check_close_scalar

    !> Report whether every number of a vector is what it should be
    subroutine check_close_vector(actual, expected, name, relative, absolute)
        !> The numbers found
        real(wp), intent(in) :: actual(:)
        !> The numbers that are right, as many
        real(wp), intent(in) :: expected(:)
        !> What the test says
        character(len=*), intent(in) :: name
        !> Largest error accepted, relative to the largest value of `expected`; default 1e-13
        real(wp), intent(in), optional :: relative
        !> Largest error accepted besides; default 0
        real(wp), intent(in), optional :: absolute
        real(wp) :: tolerance
        integer :: i, wrong

        if (size(actual) /= size(expected)) then
            call check(.false., name)
            write (error_unit, "(2a, 2(i0, a))") name, ": sizes differ: ", size(actual), " found, expected ", size(expected), ""
            return
        end if

        tolerance = default_relative
        if (present(relative)) tolerance = relative
        tolerance = tolerance * maxval([0.0_wp, pack(abs(expected), abs(expected) <= huge(1.0_wp))])
        if (present(absolute)) tolerance = tolerance + absolute

        wrong = 0
        do i = size(actual), 1, -1
            if (.not. is_close(actual(i), expected(i), tolerance)) wrong = i
        end do
        call check(wrong == 0, name)
        if (wrong > 0) then
            write (error_unit, "(2a, i0, 3(a, es24.16))") name, ": entry ", wrong, " is ", actual(wrong), &
                ", expected ", expected(wrong), " within ", tolerance
        end if
    end subroutine check_close_vector

    !> True where two numbers agree; never for a NaN, and for infinities only where they are the same
    elemental function is_close(actual, expected, tolerance) result(agree)
        !> The number found
        real(wp), intent(in) :: actual
        !> The number that is right
        real(wp), intent(in) :: expected
        !> Largest error accepted
        real(wp), intent(in) :: tolerance
        logical :: agree

        if (max(abs(actual), abs(expected)) > huge(1.0_wp)) then
            ! Their difference would be NaN, and trapped in the checked build.
            agree = actual >= expected .and. actual <= expected
        else
            agree = abs(actual - expected) <= tolerance
        end if
    end function is_close

    !> Write the plan, and tell how the tests went
    subroutine finish(status)
        !> Number of failed checks; to be returned to the system as a failure where it is not 0
        integer, intent(out) :: status

        write (output_unit, "(a, i0)") "1..", checks
        status = failures
    end subroutine finish

end module testing
