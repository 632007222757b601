!> Where what rises goes through zero, as a slope of the energy that never falls along a line; and where what has one peak is
!> highest.
module gapbeam_line_search
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: bracket_type, place_inside, narrow, golden_sections, narrow_to_peak

    !> Places, the values there, and which end was replaced last
    type :: bracket_type
        real(wp) :: low, high, at_low, at_high
        integer :: last = 0
    end type bracket_type

contains

    !> Where a straight line between the ends of a bracket is zero, or its middle
    pure function place_inside(bracket) result(t)
        type(bracket_type), intent(in) :: bracket
        real(wp) :: t

        associate (b => bracket)
            t = (b%high*b%at_low - b%low*b%at_high)/(b%at_low - b%at_high)
            if (.not. (t > b%low .and. t < b%high)) t = b%low + (b%high - b%low)/2
        end associate
    end function place_inside

    !> Take a value inside a bracket for one of its ends; the other counts half if it stays twice (Illinois method, Dowell and
    !> Jarratt 1971)
    pure subroutine narrow(bracket, t, at)
        type(bracket_type), intent(inout) :: bracket
        real(wp), intent(in) :: t, at

        if (at <= 0.0_wp) then
            bracket%low = t
            bracket%at_low = at
            if (bracket%last == 1) bracket%at_high = bracket%at_high/2
            bracket%last = 1
        else
            bracket%high = t
            bracket%at_high = at
            if (bracket%last == 2) bracket%at_low = bracket%at_low/2
            bracket%last = 2
        end if
    end subroutine narrow

    !> The two places inside an interval at which to look for a peak: one of them is that of the next, narrower one
    pure function golden_sections(interval) result(inner)
        real(wp), intent(in) :: interval(2)
        real(wp) :: inner(2)
        real(wp), parameter :: golden = (sqrt(5.0_wp) - 1)/2

        associate (low => interval(1), high => interval(2))
            inner = [high - golden*(high - low), low + golden*(high - low)]
        end associate
    end function golden_sections

    !> Leave of an interval the part with the peak
    pure subroutine narrow_to_peak(interval, values)
        real(wp), intent(inout) :: interval(2)
        !> At its golden sections
        real(wp), intent(in) :: values(2)
        real(wp) :: inner(2)

        inner = golden_sections(interval)
        if (values(1) > values(2)) then
            interval(2) = inner(2)
        else
            interval(1) = inner(1)
        end if
    end subroutine narrow_to_peak

end module gapbeam_line_search
