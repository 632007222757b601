!> A beam with a train on it at one position: its axles are forces, its uniform loads are loads of the beam.
module gapbeam_train_on_beam
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: load_type, gapbeam_force, gapbeam_distributed, gapbeam_live, gapbeam_by_x
    use gapbeam_assembled_model, only: assembled_type, copy_given
    use gapbeam_assemble, only: assemble_model
    use gapbeam_train, only: train_type
    implicit none
    private
    public :: end_of_beam, distance_at_end, acting_axles, put_train

contains

    !> x of the right end
    pure function end_of_beam(assembled) result(x)
        type(assembled_type), intent(in) :: assembled
        real(wp) :: x

        x = assembled%ends(ubound(assembled%ends, 1))
    end function end_of_beam

    !> Distance below which an axle is at an end of the beam: that of places that differ by rounding only
    pure function distance_at_end(assembled, train) result(distance)
        type(assembled_type), intent(in) :: assembled
        type(train_type), intent(in) :: train
        real(wp) :: distance

        distance = position_tolerance*(end_of_beam(assembled) + maxval(abs(train%offset)))
    end function distance_at_end

    !> The axles on the beam at a position, those at its ends included
    pure function acting_axles(assembled, train, position) result(acts)
        type(assembled_type), intent(in) :: assembled
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: position
        logical, allocatable :: acts(:)

        allocate (acts(size(train%offset)))
        associate (near => distance_at_end(assembled, train))
            acts(:) = position + train%offset >= -near .and. position + train%offset <= end_of_beam(assembled) + near
        end associate
    end function acting_axles

    !> Put a train on a beam
    subroutine put_train(assembled, train, position, acts, placed, error)
        !> The beam with the loads that stay
        type(assembled_type), intent(in) :: assembled
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: position
        !> Which axles act
        logical, intent(in) :: acts(:)
        !> The beam with all loads
        type(assembled_type), intent(out) :: placed
        !> As for assemble_model
        type(error_type), allocatable, intent(out) :: error
        type(load_type), allocatable :: loads(:)
        real(wp) :: from, to
        integer :: i, n, stat

        call copy_given(assembled, placed%model, stat)
        n = size(assembled%model%loads)
        if (stat == 0) allocate (loads(n + count(acts) + size(train%uniform)), stat=stat)
        if (failed(stat, error)) return
        loads(:n) = placed%model%loads
        do i = 1, size(acts)
            if (.not. acts(i)) cycle
            n = n + 1
            loads(n) = load_type(kind=gapbeam_force, case=gapbeam_live, node=gapbeam_by_x, value=train%force(i), &
                                 x=min(max(position + train%offset(i), 0.0_wp), end_of_beam(assembled)))
        end do
        do i = 1, size(train%uniform)
            associate (load => train%uniform(i))
                from = max(position + load%from, 0.0_wp)
                to = min(position + load%to, end_of_beam(assembled))
                if (.not. to - from > distance_at_end(assembled, train)) cycle
                n = n + 1
                loads(n) = load_type(kind=gapbeam_distributed, case=gapbeam_live, x=from, to=to, value=load%q, value_to=load%q)
            end associate
        end do
        deallocate (placed%model%loads)
        allocate (placed%model%loads(n), source=loads(:n), stat=stat)
        if (failed(stat, error)) return
        call assemble_model(placed, error)
        placed%beam%watch = assembled%beam%watch
    end subroutine put_train

end module gapbeam_train_on_beam
