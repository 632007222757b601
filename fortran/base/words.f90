!> Numbers as words.
!>
!> Not of deferred length: gfortran keeps the length of such a result in static storage, which threads share.
module gapbeam_words
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: shown, whole

    !> Room for a number
    integer, parameter :: length = 24

contains

    !> A number as a user would write it, blanks behind it
    pure function shown(value) result(text)
        real(wp), intent(in) :: value
        character(len=length) :: text

        if (ieee_is_nan(value)) then
            text = "NaN"
        else if (abs(value) > huge(value)) then
            text = merge("inf ", "-inf", value > 0)
        else if (abs(value) < 1e9_wp .and. abs(value - anint(value)) <= 0.0_wp) then
            text = whole(nint(value))
        else
            write (text, "(g0.9)") value
            text = adjustl(text)
        end if
    end function shown

    !> A whole number as text, blanks behind it
    pure function whole(value) result(text)
        integer, intent(in) :: value
        character(len=length) :: text

        write (text, "(i0)") value
    end function whole

end module gapbeam_words
