!> Numbers written as words.
!>
!> Not of deferred length: gfortran keeps the length of such a result in static storage, which threads share.
module gapbeam_words
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: shown, whole, pair

    !> Room for a number
    integer, parameter :: length = 24

contains

    !> A number as a user would write it, blanks behind it
    pure function shown(value) result(text)
        use, intrinsic :: ieee_arithmetic, only: ieee_is_nan   ! see infinity of gapbeam_units
        real(wp), intent(in) :: value
        character(len=length) :: text

        if (ieee_is_nan(value)) then
            text = "nan"
        else if (abs(value) > huge(value)) then
            text = merge("inf ", "-inf", value > 0)
        else if (abs(value) < 1e9_wp .and. abs(value - anint(value)) <= 0.0_wp) then
            text = whole(nint(value))
        else
            text = fifteen_digits(value)
        end if
    end function shown

    !> Two numbers as a point, blanks behind it
    pure function pair(a, b) result(text)
        real(wp), intent(in) :: a, b
        character(len=2*length + 4) :: text

        text = "["//trim(shown(a))//", "//trim(shown(b))//"]"
    end function pair

    !> A number without the noise of its last bits, as C's format %.15g writes it
    pure function fifteen_digits(value) result(text)
        real(wp), intent(in) :: value
        character(len=length) :: text, scientific
        character(len=15) :: digit
        integer :: power, last

        write (scientific, "(es22.14e3)") abs(value)
        scientific = adjustl(scientific)
        digit = scientific(1:1)//scientific(3:16)
        read (scientific(18:21), "(i4)") power
        last = max(1, verify(digit, "0", back=.true.))
        if (power < -4 .or. power >= 15) then
            text = mantissa(digit, last, 1)//"e"//merge("+", "-", power >= 0)
            if (abs(power) < 10) text = trim(text)//"0"
            text = trim(text)//whole(abs(power))
        else if (power < 0) then
            text = "0."//repeat("0", -power - 1)//digit(:last)
        else
            text = mantissa(digit, last, power + 1)
        end if
        if (value < 0.0_wp) text = "-"//text(:length - 1)
    end function fifteen_digits

    !> Digits with a point behind the first so many
    pure function mantissa(digit, last, before) result(text)
        character(len=*), intent(in) :: digit
        integer, intent(in) :: last, before
        character(len=merge(before, last + 1, last <= before)) :: text

        text = digit(:before)
        if (last > before) text = digit(:before)//"."//digit(before + 1:last)
    end function mantissa

    !> A whole number as text, blanks behind it
    pure function whole(value) result(text)
        integer, intent(in) :: value
        character(len=length) :: text

        write (text, "(i0)") value
    end function whole

end module gapbeam_words
