!> Beams and states in the C interface, made and freed: marshalling only. include/gapbeam.h says what every function does.
module gapbeam_capi_beam
    use, intrinsic :: iso_c_binding, only: c_int, c_char, c_size_t, c_ptr, c_null_ptr
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_bad_input, gapbeam_other_version
    use gapbeam_scene, only: model_type, load_type
    use gapbeam_api, only: replace_loads, count_supports, count_nodes
    use gapbeam_handles, only: handle_type, beam_tag, state_tag, find_handle, free_handle, address_of
    use gapbeam_new_objects, only: new_beam, new_state
    use gapbeam_capi_model, only: c_model, is_model_size, empty_model, model_from_c, loads_from_c
    use gapbeam_capi_objects, only: get_beam, report
    implicit none
    private

contains

    function gapbeam_model_init(model, size) result(status) bind(c)
        type(c_model), intent(inout), optional :: model
        integer(c_size_t), intent(in), value :: size
        integer(c_int) :: status

        status = gapbeam_bad_input
        if (.not. present(model)) return
        status = gapbeam_other_version
        if (.not. is_model_size(size)) return
        call empty_model(model, size)
        status = gapbeam_solved
    end function gapbeam_model_init

    function gapbeam_prepare(model, beam, message, message_size) result(status) bind(c)
        type(c_model), intent(in), optional :: model
        type(c_ptr), intent(out), optional :: beam
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: prepared
        type(error_type), allocatable :: error
        type(model_type) :: plain

        if (present(beam)) beam = c_null_ptr
        if (.not. (present(model) .and. present(beam))) then
            call fatal_error(error, gapbeam_bad_input, "model or beam is NULL")
        else
            call model_from_c(model, plain, error)
        end if
        if (.not. allocated(error)) call new_beam(plain, prepared, error)
        if (.not. allocated(error)) beam = address_of(prepared)
        call report(error, status, message, message_size)
    end function gapbeam_prepare

    subroutine gapbeam_free_beam(beam) bind(c)
        type(c_ptr), intent(in), value :: beam

        call free_handle(beam, beam_tag)
    end subroutine gapbeam_free_beam

    function gapbeam_replace_loads(beam, loads, message, message_size) result(status) bind(c)
        type(c_ptr), intent(in), value :: beam
        type(c_model), intent(in), optional :: loads
        character(kind=c_char), intent(inout), optional :: message(*)
        integer(c_size_t), intent(in), value :: message_size
        integer(c_int) :: status
        type(handle_type), pointer :: handle
        type(error_type), allocatable :: error
        type(load_type), allocatable :: list(:)

        call get_beam(beam, handle, error)
        if (.not. allocated(error) .and. .not. present(loads)) call fatal_error(error, gapbeam_bad_input, "loads is NULL")
        if (.not. allocated(error)) call loads_from_c(loads, list, error)
        if (.not. allocated(error)) call replace_loads(handle%beam, list, error)
        call report(error, status, message, message_size)
    end function gapbeam_replace_loads

    function gapbeam_count_supports(beam) result(number) bind(c)
        type(c_ptr), intent(in), value :: beam
        integer(c_int) :: number
        type(handle_type), pointer :: handle

        call find_handle(beam, beam_tag, handle)
        number = 0
        if (associated(handle)) number = count_supports(handle%beam)
    end function gapbeam_count_supports

    function gapbeam_count_nodes(beam) result(number) bind(c)
        type(c_ptr), intent(in), value :: beam
        integer(c_int) :: number
        type(handle_type), pointer :: handle

        call find_handle(beam, beam_tag, handle)
        number = 0
        if (associated(handle)) number = count_nodes(handle%beam)
    end function gapbeam_count_nodes

    function gapbeam_new_state(state) result(status) bind(c)
        type(c_ptr), intent(out), optional :: state
        integer(c_int) :: status
        type(handle_type), pointer :: solved
        type(error_type), allocatable :: error

        status = gapbeam_bad_input
        if (.not. present(state)) return
        call new_state(solved, error)
        state = address_of(solved)
        call report(error, status)
    end function gapbeam_new_state

    subroutine gapbeam_free_state(state) bind(c)
        type(c_ptr), intent(in), value :: state

        call free_handle(state, state_tag)
    end subroutine gapbeam_free_state

end module gapbeam_capi_beam
