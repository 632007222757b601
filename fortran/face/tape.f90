!> Arrays one after the other in a work array of reals and one of integers, as Fortran 77 keeps data between calls.
!>
!> The same list of calls measures, writes or reads, so that what is written is what is read.
module gapbeam_tape
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: tape_type, exchange, exchange_size, measuring, writing, reading

    !> What a tape does
    integer, parameter :: measuring = 0, writing = 1, reading = 2

    !> Two work arrays and how far they are used
    type :: tape_type
        integer :: mode = measuring
        integer(int64) :: reals = 0, integers = 0
        real(wp), pointer, contiguous :: real_array(:) => null()
        integer, pointer, contiguous :: integer_array(:) => null()
        !> Not 0 where memory is at an end, or what is read was never written
        integer :: stat = 0
    end type tape_type

    !> Measure, write or read one value or array; arrays to be read are allocated
    interface exchange
        module procedure exchange_real
        module procedure exchange_integer
        module procedure exchange_logical
        module procedure exchange_row
        module procedure exchange_reals
        module procedure exchange_matrix
        module procedure exchange_integers
        module procedure exchange_logicals
    end interface exchange

contains

    !> A number
    pure subroutine exchange_real(tape, value)
        type(tape_type), intent(inout) :: tape
        real(wp), intent(inout) :: value

        tape%reals = tape%reals + 1
        if (tape%mode == writing) tape%real_array(tape%reals) = value
        if (tape%mode == reading) value = tape%real_array(tape%reals)
    end subroutine exchange_real

    !> A whole number
    pure subroutine exchange_integer(tape, value)
        type(tape_type), intent(inout) :: tape
        integer, intent(inout) :: value

        tape%integers = tape%integers + 1
        if (tape%mode == writing) tape%integer_array(tape%integers) = value
        if (tape%mode == reading) value = tape%integer_array(tape%integers)
    end subroutine exchange_integer

    !> A truth
    pure subroutine exchange_logical(tape, value)
        type(tape_type), intent(inout) :: tape
        logical, intent(inout) :: value
        integer :: number

        number = 0
        if (tape%mode /= reading) number = merge(1, 0, value)   ! what is to be read is no truth yet
        call exchange_integer(tape, number)
        if (tape%mode == reading) value = number /= 0
    end subroutine exchange_logical

    !> Numbers of known count
    pure subroutine exchange_row(tape, count, values)
        type(tape_type), intent(inout) :: tape
        integer, intent(in) :: count
        real(wp), intent(inout) :: values(count)

        if (tape%mode == writing) tape%real_array(tape%reals + 1:tape%reals + count) = values
        if (tape%mode == reading) values = tape%real_array(tape%reals + 1:tape%reals + count)
        tape%reals = tape%reals + count
    end subroutine exchange_row

    !> The size of an array that follows, -1 for one that is not allocated
    pure subroutine exchange_size(tape, given, number)
        type(tape_type), intent(inout) :: tape
        !> Is it allocated
        logical, intent(in) :: given
        !> Its size; out when reading
        integer, intent(inout) :: number

        if (.not. given .and. tape%mode /= reading) number = -1
        call exchange_integer(tape, number)
        if (tape%mode == reading .and. number < -1) tape%stat = 1
        if (tape%stat /= 0) number = -1
    end subroutine exchange_size

    !> An array of numbers
    pure subroutine exchange_reals(tape, values, lower)
        type(tape_type), intent(inout) :: tape
        real(wp), allocatable, intent(inout) :: values(:)
        !> Its lower bound
        integer, intent(in) :: lower
        integer :: number, stat

        number = 0
        if (allocated(values)) number = size(values)
        call exchange_size(tape, allocated(values), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (values(lower:lower + number - 1), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        if (tape%mode == writing) tape%real_array(tape%reals + 1:tape%reals + number) = values
        if (tape%mode == reading) values(:) = tape%real_array(tape%reals + 1:tape%reals + number)
        tape%reals = tape%reals + number
    end subroutine exchange_reals

    !> Dead and live values of nodes, shape (2, 0:n)
    pure subroutine exchange_matrix(tape, values)
        type(tape_type), intent(inout) :: tape
        real(wp), allocatable, intent(inout) :: values(:, :)
        integer :: number, i, stat

        number = 0
        if (allocated(values)) number = size(values, 2)
        call exchange_size(tape, allocated(values), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (values(2, 0:number - 1), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 0, number - 1
            call exchange_row(tape, 2, values(:, i))
        end do
    end subroutine exchange_matrix

    !> An array of whole numbers
    pure subroutine exchange_integers(tape, values, lower)
        type(tape_type), intent(inout) :: tape
        integer, allocatable, intent(inout) :: values(:)
        !> Its lower bound
        integer, intent(in) :: lower
        integer :: number, stat

        number = 0
        if (allocated(values)) number = size(values)
        call exchange_size(tape, allocated(values), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (values(lower:lower + number - 1), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        if (tape%mode == writing) tape%integer_array(tape%integers + 1:tape%integers + number) = values
        if (tape%mode == reading) values(:) = tape%integer_array(tape%integers + 1:tape%integers + number)
        tape%integers = tape%integers + number
    end subroutine exchange_integers

    !> An array of truths
    pure subroutine exchange_logicals(tape, values, lower)
        type(tape_type), intent(inout) :: tape
        logical, allocatable, intent(inout) :: values(:)
        !> Its lower bound
        integer, intent(in) :: lower
        integer :: number, i, stat

        number = 0
        if (allocated(values)) number = size(values)
        call exchange_size(tape, allocated(values), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (values(lower:lower + number - 1), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = lower, lower + number - 1
            call exchange_logical(tape, values(i))
        end do
    end subroutine exchange_logicals

end module gapbeam_tape
