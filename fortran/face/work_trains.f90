!> What the Fortran 77 routines for trains have in common: the beam out of its work arrays, and a train on its way over it
module gapbeam_work_trains
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_bad_input, gapbeam_no_memory
    use gapbeam_scene, only: gapbeam_unchanged
    use gapbeam_api, only: prepared_type
    use gapbeam_api_trains, only: moving_train_type, passing_type, follow_train
    use gapbeam_work, only: take_beam
    implicit none
    private
    public :: pass_axles

contains

    !> Move a train over a beam; the arguments stand at the places 1 to 8 of all routines for trains
    subroutine pass_axles(work, iwork, naxle, axle, q, left, from, to, beam, passing, info)
        real(wp), intent(in) :: work(*)
        integer, intent(in) :: iwork(*), naxle, left
        real(wp), intent(in) :: axle(2, *), q, from, to
        type(prepared_type), intent(out) :: beam
        type(passing_type), intent(out) :: passing
        !> 0, -1, -3 to -8, or the code of an error
        integer, intent(out) :: info
        type(moving_train_type) :: train
        type(error_type), allocatable :: error
        integer :: k, stat

        info = 0
        if (naxle < 1) info = -3
        if (.not. abs(q) <= huge(q)) info = -5
        if (left /= 0 .and. left /= 1) info = -6
        ! Infinite: where the train enters, or has left
        if (.not. from <= huge(from)) info = -7
        if (.not. to >= -huge(to)) info = -8
        if (info /= 0) return
        do k = 1, naxle
            if (.not. (axle(1, k) >= 0.0_wp .and. axle(1, k) <= huge(q) .and. abs(axle(2, k)) <= huge(q))) info = -4
        end do
        if (info /= 0) return
        call take_beam(work, iwork, 1, beam, info)
        if (info /= 0) return
        allocate (train%distance(naxle), train%force(naxle), stat=stat)
        if (stat /= 0) then
            info = gapbeam_no_memory
            return
        end if
        train%distance(:) = axle(1, 1:naxle)
        train%force(:) = axle(2, 1:naxle)
        train%q = q
        train%to_the_left = left == 1
        train%from = max(from, gapbeam_unchanged)
        train%to = gapbeam_unchanged
        if (to <= huge(to)) train%to = to
        call follow_train(beam, train, passing, error)
        if (.not. allocated(error)) return
        info = error%code
        if (info == gapbeam_bad_input) info = merge(-8, -1, error%key == "positions")
    end subroutine pass_axles

end module gapbeam_work_trains
