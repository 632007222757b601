!> Trains on their way over the ground or over smooth laws as numbers that Python keeps
module gapbeam_runs_handle
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: train_type
    use gapbeam_train_runs, only: runs_type, follow_train_on_ground
    implicit none
    private
    public :: runs_handle_type, new_runs, runs_of, drop_runs

    !> What a handle stands for
    type :: runs_handle_type
        type(runs_type) :: runs
    end type runs_handle_type

contains

    !> Move a train over a beam and keep its way
    subroutine new_runs(lowered, train, range, backwards, rule, address, error)
        !> The beam
        type(assembled_type), intent(in), target :: lowered
        type(train_type), intent(in) :: train
        !> First and last position
        real(wp), intent(in) :: range(2)
        !> Does it go towards smaller positions
        logical, intent(in) :: backwards
        !> As for follow_train_on_ground
        integer, intent(in) :: rule
        !> The handle; 0 where an error is found
        integer(int64), intent(out) :: address
        type(error_type), allocatable, intent(out) :: error
        type(runs_handle_type), pointer :: handle
        integer :: stat

        address = 0
        allocate (handle, stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call follow_train_on_ground(lowered, train, rule, range(1), range(2), backwards, handle%runs, error)
        if (allocated(error)) then
            deallocate (handle)
        else
            address = transfer(c_loc(handle), address)
        end if
    end subroutine new_runs

    !> What a handle stands for
    function runs_of(address) result(handle)
        integer(int64), intent(in) :: address
        type(runs_handle_type), pointer :: handle

        call c_f_pointer(transfer(address, c_null_ptr), handle)
    end function runs_of

    !> Free it; the handle is worth nothing from then on
    subroutine drop_runs(address)
        integer(int64), intent(in) :: address
        type(runs_handle_type), pointer :: handle

        handle => runs_of(address)
        if (associated(handle)) deallocate (handle)
    end subroutine drop_runs

end module gapbeam_runs_handle
