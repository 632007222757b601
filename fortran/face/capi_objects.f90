!> Objects and conversions that the functions of the C interface share: beams and states behind handles, options, errors, messages
module gapbeam_capi_objects
    use, intrinsic :: iso_c_binding, only: c_int, c_char, c_size_t, c_ptr, c_null_char, c_sizeof
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared, gapbeam_other_version
    use gapbeam_words, only: whole
    use gapbeam_api, only: options_type
    use gapbeam_handles, only: handle_type, state_tag, beam_tag, passing_tag, find_handle
    implicit none
    private
    public :: c_options, get_beam, get_both, get_train, read_options, check_points, check_flag, forget, report

    !> Mirror of the header's structure
    type, bind(c) :: c_options
        integer(c_size_t) :: size
        integer(c_int) :: rule, reserved
    end type c_options

contains

    !> The beam behind a handle, refused where there is none
    subroutine get_beam(beam, prepared, error)
        type(c_ptr), intent(in) :: beam
        type(handle_type), pointer, intent(out) :: prepared
        type(error_type), allocatable, intent(out) :: error

        call find_handle(beam, beam_tag, prepared)
        if (.not. associated(prepared)) call fatal_error(error, gapbeam_not_prepared, "beam is no prepared beam")
    end subroutine get_beam

    !> A beam and a state, refused where one is missing
    subroutine get_both(beam, state, prepared, solved, error)
        type(c_ptr), intent(in) :: beam, state
        type(handle_type), pointer, intent(out) :: prepared, solved
        type(error_type), allocatable, intent(out) :: error

        call find_handle(state, state_tag, solved)
        call get_beam(beam, prepared, error)
        if (.not. allocated(error) .and. .not. associated(solved)) then
            call fatal_error(error, gapbeam_not_prepared, "state is no state: make one with gapbeam_new_state")
        end if
    end subroutine get_both

    !> A beam and a train on its way, refused where one is missing
    subroutine get_train(beam, passing, prepared, handle, error)
        type(c_ptr), intent(in) :: beam, passing
        type(handle_type), pointer, intent(out) :: prepared, handle
        type(error_type), allocatable, intent(out) :: error

        call find_handle(beam, beam_tag, prepared)
        call find_handle(passing, passing_tag, handle)
        if (associated(prepared) .and. associated(handle)) return
        call fatal_error(error, gapbeam_not_prepared, "beam is no prepared beam, or passing no train on its way")
    end subroutine get_train

    !> Options, or the defaults
    subroutine read_options(options, chosen, error)
        type(c_options), intent(in), optional :: options
        type(options_type), intent(out) :: chosen
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error) .or. .not. present(options)) return
        if (options%size /= c_sizeof(options)) then
            call fatal_error(error, gapbeam_other_version, "options: size is not the library's; use gapbeam_options_init")
        else
            chosen%rule = options%rule
        end if
    end subroutine read_options

    !> Refuse a number of places that makes no sense
    subroutine check_points(count, given, what, error)
        integer(c_int), intent(in) :: count
        !> Are the arrays there, and their names
        logical, intent(in) :: given
        character(len=*), intent(in) :: what
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error)) return
        if (count < 0) then
            call fatal_error(error, gapbeam_bad_input, "count is negative")
        else if (count > 0 .and. .not. given) then
            call fatal_error(error, gapbeam_bad_input, what//" is NULL")
        end if
    end subroutine check_points

    !> Refuse a flag that is neither 0 nor 1
    subroutine check_flag(name, flag, error)
        character(len=*), intent(in) :: name
        integer(c_int), intent(in) :: flag
        !> What was wrong before stays
        type(error_type), allocatable, intent(inout) :: error

        if (allocated(error) .or. flag == 0 .or. flag == 1) return
        call fatal_error(error, gapbeam_bad_input, name//": expected 0 or 1, got "//trim(whole(int(flag))))
    end subroutine check_flag

    !> After an error a state holds nothing that can be asked for
    subroutine forget(solved, error)
        !> Null where there is none
        type(handle_type), pointer, intent(in) :: solved
        type(error_type), allocatable, intent(in) :: error

        if (allocated(error) .and. associated(solved)) solved%result%status = -1
    end subroutine forget

    !> A message about one entry of an argument, which C counts from 0
    pure subroutine count_from_zero(error, message)
        type(error_type), intent(in) :: error
        character(len=:), allocatable, intent(out) :: message
        integer :: bracket, last, number

        message = error%message
        if (len_trim(error%key) == 0) return
        bracket = len_trim(error%key) + 1
        if (index(message, trim(error%key)//"(") /= 1) return
        last = index(message, "): ")
        if (last <= bracket + 1) return
        if (verify(message(bracket + 1:last - 1), "0123456789") > 0) return
        read (message(bracket + 1:last - 1), *) number
        message = message(:bracket - 1)//"["//trim(whole(number - 1))//"]"//message(last + 1:)
        if (error%key == "quantities") message = "quantity"//message(bracket:)
    end subroutine count_from_zero

    !> Status and message for C
    subroutine report(error, status, message, message_size)
        type(error_type), allocatable, intent(in) :: error
        integer(c_int), intent(out) :: status
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), optional :: message_size
        character(len=:), allocatable :: text
        integer(c_size_t) :: i, length

        status = gapbeam_solved
        if (allocated(error)) status = error%code
        if (.not. present(message) .or. .not. present(message_size)) return
        if (message_size < 1) return
        text = ""
        if (allocated(error)) call count_from_zero(error, text)
        length = min(len(text, c_size_t), message_size - 1)
        do i = 1, length
            message(i) = text(i:i)
        end do
        message(length + 1) = c_null_char
    end subroutine report

end module gapbeam_capi_objects
