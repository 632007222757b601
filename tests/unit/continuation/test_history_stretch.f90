!> The pieces of all supports along a path, kept as what changes from stretch to stretch
program test_history_stretch
    use testing, only: check, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_model, only: both
    use gapbeam_polyline, only: node_support_type
    use gapbeam_history_stretch, only: stretch_type, pieces_type, keep_pieces, nothing_changes, enter_stretch
    use gapbeam_history_record, only: history_type, new_history, add_stretch, find_pieces
    implicit none
    integer :: status

    call changes(40, 400, .false.)
    call changes(1000, 3000, .true.)
    call some_as_before()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Where little changes little is kept, and any stretch has its own pieces
    subroutine changes(supports, stretches, with_laws)
        integer, intent(in) :: supports, stretches
        logical, intent(in) :: with_laws
        type(history_type) :: history
        type(pieces_type) :: last, found
        type(stretch_type) :: stretch
        type(error_type), allocatable :: error
        type(node_support_type), allocatable :: laws(:)
        logical :: closed(supports), right
        real(wp) :: contact(supports)
        logical, allocatable :: schemes(:, :)
        integer, allocatable :: places(:)
        integer :: i, k, stored

        call new_history(0, history)
        stretch%skipped = .false.
        closed(:) = .false.
        contact(:) = 0.0_wp
        allocate (schemes(supports, stretches))
        do k = 1, stretches
            ! One that changes, and one that may
            places = [1 + modulo(37*k, supports), 1 + modulo(37*k + 11, supports)]
            closed(places(1)) = .not. closed(places(1))
            contact(places(1)) = k
            if (allocated(laws)) deallocate (laws)
            if (k == 1) places = [(i, i=1, supports)]
            if (with_laws) laws = [(node_support_type(0, both, 1.0_wp, contact(places(i))), i=1, size(places))]
            call keep_pieces(places, closed(places), laws, last, stretch)
            schemes(:, k) = closed
            call enter_stretch(stretch, last)
            call add_stretch(stretch, history, error)
            if (allocated(error)) exit
        end do
        call check(.not. allocated(error), "there is memory")
        stored = 0
        right = .true.
        do k = 1, stretches
            stored = stored + size(history%stretches(k)%closed)
            call find_pieces(history, k, found)
            right = right .and. all(found%closed .eqv. schemes(:, k))
        end do
        call check(right, "every stretch has its own scheme")
        if (with_laws) call check(all(abs(found%laws%contact - contact) <= 0.0_wp), "and its laws")
        call check(stored <= supports + 3*stretches, "what is kept grows with what changes")
    end subroutine changes

    !> A stretch cut in two has the same pieces on both parts
    subroutine some_as_before()
        type(history_type) :: history
        type(pieces_type) :: last, found
        type(stretch_type) :: stretch
        type(error_type), allocatable :: error
        type(node_support_type), allocatable :: laws(:)
        integer :: k

        call new_history(0, history)
        stretch%skipped = .false.
        do k = 1, 2
            call keep_pieces([1, 2], [k == 1, .true.], laws, last, stretch)
            if (k == 2) call nothing_changes(stretch)
            call enter_stretch(stretch, last)
            call add_stretch(stretch, history, error)
        end do
        call find_pieces(history, 2, found)
        call check(all(found%closed), "nothing has changed")
    end subroutine some_as_before

end program test_history_stretch
