!> Objects behind handles, made for C and Fortran 77 by procedures of the Fortran interface; null where there is an error
module gapbeam_new_objects
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_scene, only: model_type
    use gapbeam_api, only: prepared_type, prepare_model
    use gapbeam_api_cases, only: prepare_cases
    use gapbeam_api_combinations, only: combine_loads
    use gapbeam_api_history, only: follow_history
    use gapbeam_api_trains, only: moving_train_type, follow_train
    use gapbeam_handles, only: handle_type, beam_tag, state_tag, history_tag, cases_tag, passing_tag, new_handle, finish_handle
    implicit none
    private
    public :: new_beam, new_combination, new_state, new_history, new_cases, new_passing

contains

    !> Prepare a model, as prepare_model
    subroutine new_beam(model, handle, error)
        type(model_type), intent(in) :: model
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(beam_tag, handle, error)
        if (.not. allocated(error)) call prepare_model(model, handle%beam, error)
        call finish_handle(handle, error)
    end subroutine new_beam

    !> Combine the loads of a beam, as combine_loads
    subroutine new_combination(beam, factors, settlements, handle, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        real(wp), intent(in), optional :: settlements(:)
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(beam_tag, handle, error)
        if (.not. allocated(error)) call combine_loads(beam, factors, handle%beam, error, settlements)
        call finish_handle(handle, error)
    end subroutine new_combination

    !> An empty place for results
    subroutine new_state(handle, error)
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(state_tag, handle, error)
    end subroutine new_state

    !> Follow the load through factors in turn, as follow_history
    subroutine new_history(beam, factors, at_limit, handle, error)
        type(prepared_type), intent(in) :: beam
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: at_limit
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(history_tag, handle, error)
        if (.not. allocated(error)) call follow_history(beam, factors, at_limit, handle%history, error)
        call finish_handle(handle, error)
    end subroutine new_history

    !> Make ready for many cases, as prepare_cases
    subroutine new_cases(beam, handle, error)
        type(prepared_type), intent(in) :: beam
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(cases_tag, handle, error)
        if (.not. allocated(error)) call prepare_cases(beam, handle%cases, error)
        call finish_handle(handle, error)
    end subroutine new_cases

    !> Move a train over a beam, as follow_train
    subroutine new_passing(beam, train, handle, error)
        type(prepared_type), intent(in) :: beam
        type(moving_train_type), intent(in) :: train
        type(handle_type), pointer, intent(out) :: handle
        type(error_type), allocatable, intent(out) :: error

        call new_handle(passing_tag, handle, error)
        if (.not. allocated(error)) call follow_train(beam, train, handle%passing, error)
        call finish_handle(handle, error)
    end subroutine new_passing

end module gapbeam_new_objects
