!> Intervals of train positions in which no load passes an end of a piece of the beam.
module gapbeam_train_intervals
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_ordered, only: sort, last_not_above
    use gapbeam_train, only: track_type, least_distance
    implicit none
    private
    public :: interval_type, find_intervals, enter_interval

    !> Places of a train between which nothing passes a point; of no length where axles come and go at one place
    type :: interval_type
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> A place within it that stands for all, and how many axles are left of the beam and right of it
        real(wp) :: about = 0.0_wp
        integer :: outside(2) = 0
        !> By enter_interval: piece of every axle, 0: not on the beam
        integer, allocatable :: piece(:)
        !> And in which every uniform load begins and ends; the first is beyond the last where it is not on the beam
        integer, allocatable :: first(:), last(:)
        !> Do the loads on its ends act there as in between
        logical :: holds_from = .true., holds_to = .true.
    end type interval_type

contains

    !> The intervals of a range of places
    subroutine find_intervals(track, from, to, intervals, error)
        type(track_type), intent(in) :: track
        !> Places of the train
        real(wp), intent(in) :: from, to
        !> From left to right
        type(interval_type), allocatable, intent(out) :: intervals(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(interval_type), allocatable :: found(:)
        real(wp), allocatable :: place(:)
        real(wp) :: near
        integer :: count, number, i, k, stat

        allocate (place(2 + (size(track%train%offset) + 2*size(track%train%uniform))*size(track%x)), stat=stat)
        if (stat == 0) allocate (found(2*size(place)), stat=stat)
        if (failed(stat, error)) return
        near = least_distance(track)
        count = 1
        place(1) = from
        do i = 1, size(track%train%offset)
            call add(track%train%offset(i))
        end do
        do i = 1, size(track%train%uniform)
            call add(track%train%uniform(i)%from)
            call add(track%train%uniform(i)%to)
        end do
        count = count + 1
        place(count) = to
        call sort(place(:count))
        number = 1
        do k = 2, count - 1
            if (place(k) - place(number) <= near .or. to - place(k) <= near) cycle
            number = number + 1
            place(number) = place(k)
        end do
        if (to > from) then
            number = number + 1
            place(number) = to
        end if
        count = 0
        do k = 1, number
            count = count + 1
            found(count) = interval_at(track, place(k), place(k), place(k), near)
            if (k == number) exit
            count = count + 1
            found(count) = interval_at(track, place(k), place(k + 1), place(k) + (place(k + 1) - place(k))/2, near)
        end do
        call drop_singles()

    contains

        !> Note the places at which something at a distance from the train's place passes a point
        subroutine add(offset)
            real(wp), intent(in) :: offset
            integer :: j

            do j = 0, ubound(track%x, 1)
                if (track%x(j) - offset <= from .or. track%x(j) - offset >= to) cycle
                count = count + 1
                place(count) = track%x(j) - offset
            end do
        end subroutine add

        !> Keep those places by themselves at which other axles act than on both sides
        subroutine drop_singles()
            logical :: keep(count)
            integer :: j

            keep(:) = .true.
            do j = 1, count, 2
                if (j > 1) then
                    found(j - 1)%holds_to = all(found(j - 1)%outside == found(j)%outside)
                    keep(j) = .not. found(j - 1)%holds_to
                end if
                if (j < count) then
                    found(j + 1)%holds_from = all(found(j + 1)%outside == found(j)%outside)
                    keep(j) = keep(j) .and. .not. found(j + 1)%holds_from
                end if
            end do
            intervals = pack(found(:count), keep)
        end subroutine drop_singles

    end subroutine find_intervals

    !> A interval: what acts in it, as the train goes to the right, is told by how many axles are not yet, or no longer, on the beam
    pure function interval_at(track, from, to, about, near) result(interval)
        type(track_type), intent(in) :: track
        real(wp), intent(in) :: from, to, about
        !> What is not farther from an end of the beam is on it
        real(wp), intent(in) :: near
        type(interval_type) :: interval

        interval%from = from
        interval%to = to
        interval%about = about
        interval%outside = [count(about + track%train%offset < -near), &
                            count(about + track%train%offset > track%x(ubound(track%x, 1)) + near)]
    end function interval_at

    !> Find the pieces in which axles and uniform loads are, from those of an interval nearby in a few steps
    subroutine enter_interval(track, next, interval)
        type(track_type), intent(in) :: track
        !> By find_intervals
        type(interval_type), intent(in) :: next
        !> The interval where the train was before, if any; the same as the next one then, with all pieces
        type(interval_type), intent(inout) :: interval
        real(wp) :: x, near
        integer :: i, j, n

        n = ubound(track%x, 1)
        near = least_distance(track)
        if (.not. allocated(interval%piece)) then
            allocate (interval%piece(size(track%train%offset)), interval%first(size(track%train%uniform)), &
                      interval%last(size(track%train%uniform)))
            interval%piece(:) = 0
        end if
        interval%from = next%from
        interval%to = next%to
        interval%about = next%about
        interval%outside = next%outside
        interval%holds_from = next%holds_from
        interval%holds_to = next%holds_to
        do i = 1, size(track%train%offset)
            x = interval%about + track%train%offset(i)
            j = interval%piece(i)
            if (.not. (x >= -near .and. x <= track%x(n) + near)) then
                j = 0
            else if (j == 0) then
                j = piece_at(track, x)
            else
                do while (j < n)
                    if (track%x(j) > x) exit
                    j = j + 1
                end do
                do while (j > 1)
                    if (track%x(j - 1) <= x) exit
                    j = j - 1
                end do
            end if
            interval%piece(i) = j
        end do
        do i = 1, size(track%train%uniform)
            interval%first(i) = 1
            interval%last(i) = 0
            associate (from => interval%about + track%train%uniform(i)%from, to => interval%about + track%train%uniform(i)%to)
                if (to <= 0.0_wp .or. from >= track%x(n)) cycle
                interval%first(i) = piece_at(track, from)
                interval%last(i) = piece_at(track, to)
            end associate
        end do
    end subroutine enter_interval

    !> Piece of a place, the nearest one for places beyond the ends
    pure function piece_at(track, x) result(piece)
        type(track_type), intent(in) :: track
        real(wp), intent(in) :: x
        integer :: piece

        piece = last_not_above(track%x(:ubound(track%x, 1) - 1), x) + 1
    end function piece_at

end module gapbeam_train_intervals
