!> Trains on their way as numbers that Python keeps
module gapbeam_train_handle
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: iso_c_binding, only: c_loc, c_f_pointer, c_null_ptr
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: train_type, uniform_type, track_type, new_track
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_path, only: pass_train
    use gapbeam_train_events, only: train_event_type, find_events
    use gapbeam_train_ties, only: extreme_type
    implicit none
    private
    public :: train_handle_type, new_train, train_of, drop_train, pack_extremes

    !> What a handle stands for
    type :: train_handle_type
        type(train_type) :: train
        type(track_type) :: track
        type(traversal_type) :: passage
        type(train_event_type), allocatable :: events(:)
    end type train_handle_type

contains

    !> Move a train over a beam and keep its way
    subroutine new_train(lowered, offset, force, uniform, from, to, backwards, address, sizes, error)
        !> The beam
        type(assembled_type), intent(in) :: lowered
        !> As in train_type; uniform loads, and between which distances, shape (3, n)
        real(wp), intent(in) :: offset(:), force(:), uniform(:, :)
        !> Positions of the train
        real(wp), intent(in) :: from, to
        !> Does it go towards smaller positions
        logical, intent(in) :: backwards
        !> The handle; 0 where an error is found
        integer(int64), intent(out) :: address
        !> Stretches, motions, events, linear solves
        integer, intent(out) :: sizes(4)
        !> As for pass_train
        type(error_type), allocatable, intent(out) :: error
        type(train_handle_type), pointer :: handle
        integer :: i, k, n, stat

        address = 0
        sizes(:) = 0
        n = size(offset)
        allocate (handle, stat=stat)
        if (stat == 0) allocate (handle%train%offset(n), handle%train%force(n), &
                                 handle%train%uniform(count(abs(uniform(1, :)) > 0.0_wp)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        handle%train%offset(:) = offset
        handle%train%force(:) = force
        k = 0
        do i = 1, size(uniform, 2)
            if (.not. abs(uniform(1, i)) > 0.0_wp) cycle
            k = k + 1
            handle%train%uniform(k) = uniform_type(uniform(1, i), uniform(2, i), uniform(3, i))
        end do
        call new_track(lowered, handle%track, error)
        if (.not. allocated(error)) call pass_train(lowered, handle%track, handle%train, from, to, handle%passage, error)
        if (.not. allocated(error)) call find_events(lowered, handle%passage, backwards, handle%events, error)
        if (allocated(error)) then
            deallocate (handle)
            return
        end if
        associate (passage => handle%passage)
            sizes(:) = [passage%number, size(passage%motion, 2), size(handle%events), passage%solves]
        end associate
        address = transfer(c_loc(handle), address)
    end subroutine new_train

    !> What a handle stands for
    function train_of(address) result(handle)
        integer(int64), intent(in) :: address
        type(train_handle_type), pointer :: handle

        call c_f_pointer(transfer(address, c_null_ptr), handle)
    end function train_of

    !> Free it; the handle is worth nothing from then on
    subroutine drop_train(address)
        integer(int64), intent(in) :: address
        type(train_handle_type), pointer :: handle

        handle => train_of(address)
        if (associated(handle)) deallocate (handle)
    end subroutine drop_train

    !> Extremes as arrays
    pure subroutine pack_extremes(extremes, values, sides, ties)
        type(extreme_type), intent(in) :: extremes(:, :)
        !> Value, x, position, shape (3, most_extreme_ties, 2, 4); side (tie_type), shape (most_extreme_ties, 2, 4)
        real(wp), intent(inout) :: values(:, :, :, :)
        integer, intent(inout) :: sides(:, :, :)
        !> How many there are, shape (2, 4)
        integer, intent(out) :: ties(:, :)
        integer :: f, i, k

        do f = 1, size(extremes, 2)
            do i = 1, size(extremes, 1)
                ties(i, f) = extremes(i, f)%number
                do k = 1, extremes(i, f)%number
                    associate (tie => extremes(i, f)%ties(k))
                        values(:, k, i, f) = [tie%value, tie%x, tie%position]
                        sides(k, i, f) = tie%side
                    end associate
                end do
            end do
        end do
    end subroutine pack_extremes

end module gapbeam_train_handle
