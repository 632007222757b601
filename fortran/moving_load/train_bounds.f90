!> Bounds of the values under a train, which leave few stretches of its way for the extremes.
!>
!> In a cell (gapbeam_train_cells) at a fixed share of its length a field depends on the position alone. It lies between the line
!> through its values at two positions and that line moved by h**2/8 of its second derivative. What the axles in a link add to that
!> is known, as are the derivatives of the values at its nodes (gapbeam_train_link_bounds). So a link is looked at now and then:
!> whenever something comes to it or leaves it, and after a share of its length. What may hold an extreme value is looked at again,
!> stretch by stretch, and halves of these. The slopes of node values do not jump but where an axle passes a hinge, an end of the
!> beam or,
!> in one that gives way in shear, any point, and those of a moment where one passes its node; and where an end of a uniform load
!> passes an end of the beam.
module gapbeam_train_bounds
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_halves
    use gapbeam_path_tolerances, only: train_slack, longest_way, far_below
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed, gapbeam_solved
    use gapbeam_nodes, only: hinge
    use gapbeam_quantities, only: bending_count
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type
    use gapbeam_train_intervals, only: interval_type
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_link_bounds, only: view_type, link_bounds_type, slopes_type, new_view, enter_stretch, &
        enter_next_interval, bound_link, slopes_in_link, greatest_curvature, greater
    use gapbeam_train_support_bounds, only: support_bounds_type, new_support_bounds, watch_scheme, bound_supports, mark_stretches
    implicit none
    private
    public :: bounds_type, find_bounds

    !> A link on stretches in a row
    type :: part_type
        integer :: link = 0, first = 0, last = 0
        !> Largest (1) and negative smallest (2) quantities of bending (gapbeam_quantities) at most
        real(wp) :: bound(2, bending_count) = 0.0_wp
    end type part_type

    !> What is known of extremes
    type :: bounds_type
        !> Largest (1) and negative smallest (2) quantities of bending that are reached, in the engine's units, and the largest
        !> absolute value
        real(wp) :: reached(2, bending_count) = -huge(1.0_wp), size(bending_count) = 0.0_wp
        !> Stretches on which they are
        integer :: where_reached(2, bending_count) = 0
        !> The same at most on every stretch; -huge where no extreme value is, huge where nothing is known; shape (2, bending_count,
        !> number)
        real(wp), allocatable :: at_most(:, :, :)
        !> Stretches on which a support may have an extreme value
        logical, allocatable :: of_supports(:)
        type(support_bounds_type) :: supports
        type(view_type) :: view
    end type bounds_type

contains

    !> Find bounds of the fields on all stretches of a train's way
    subroutine find_bounds(assembled, track, traversal, bounds, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        !> By pass_train
        type(traversal_type), intent(in) :: traversal
        type(bounds_type), intent(out) :: bounds
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(part_type), allocatable :: parts(:)
        integer, allocatable :: start(:)
        real(wp), allocatable :: begin(:)
        logical, allocatable :: touched(:)
        type(link_bounds_type), allocatable :: first_at_link(:)
        type(link_bounds_type) :: first, last
        type(slopes_type), allocatable :: slopes(:)
        integer :: count, i, k, n, stat

        n = size(track%beam%links)
        call new_view(assembled, track, bounds%view, stat)
        if (stat == 0) call new_support_bounds(assembled, bounds%supports, stat)
        if (stat == 0) allocate (bounds%at_most(2, bending_count, traversal%number), &
                                 bounds%of_supports(traversal%number), parts(256), start(n), begin(n), touched(n), &
                                 first_at_link(n), slopes(n), stat=stat)
        if (failed(stat, error)) return
        bounds%at_most(:, :, :) = -huge(1.0_wp)
        bounds%of_supports(:) = .false.
        count = 0
        start(:) = 0
        do k = 1, traversal%number
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
            if (traversal%status(k) /= gapbeam_solved) cycle
            call enter_stretch(track, traversal, k, bounds%view)
            if (.not. bounds%view%clear) then
                bounds%at_most(:, :, k) = huge(1.0_wp)
                bounds%of_supports(k) = .true.
                start(:) = 0
                cycle
            end if
            if (bounds%view%new_scheme) call watch_scheme(assembled, traversal%closed(:, k), bounds%view%columns, bounds%supports)
            call bound_supports(track, k, bounds%view%columns, bounds%supports)
            call find_touched(k)
            do i = 1, n
                call go_on(i, k)
                if (allocated(error)) return
            end do
        end do
        call mark_stretches(bounds%supports, bounds%of_supports)
        call drop_parts()
        do i = 1, count
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
            do k = parts(i)%first, parts(i)%last
                associate (link => parts(i)%link)
                    call enter_stretch(track, traversal, k, bounds%view)
                    call bound_link(assembled, track, bounds%view, link, 0.0_wp, first)
                    call reach_values(first, k)
                    call bound_link(assembled, track, bounds%view, link, 1.0_wp, last)
                    call reach_values(last, k)
                    call bound_between(link, k, slopes_in_link(bounds%view, link), 0.0_wp, 1.0_wp, first, last, most_halves)
                end associate
            end do
        end do

    contains

        !> To which links something comes, or which it leaves, at the end of a stretch
        subroutine find_touched(k)
            integer, intent(in) :: k
            logical :: smooth
            integer :: i

            touched(:) = .true.
            if (k == traversal%number) return
            smooth = traversal%status(k + 1) == gapbeam_solved
            if (smooth) smooth = all(traversal%closed(:, k + 1) .eqv. traversal%closed(:, k))
            if (.not. smooth) return
            if (traversal%interval(k) == traversal%interval(k + 1)) then
                touched(:) = .false.
                return
            end if
            if (bounds%view%shears) return
            call enter_next_interval(track, traversal, traversal%interval(k + 1), bounds%view)
            touched(:) = .false.
            associate (before => bounds%view%interval, after => bounds%view%ahead)
                do i = 1, size(after%piece)
                    call touch(before%piece(i), after%piece(i), past_hinges=.false.)
                end do
                do i = 1, size(track%train%uniform)
                    associate (load => track%train%uniform(i))
                        call touch(piece_of_end(before, load%from, before%first(i)), &
                                   piece_of_end(after, load%from, after%first(i)), past_hinges=.true.)
                        call touch(piece_of_end(before, load%to, before%last(i)), &
                                   piece_of_end(after, load%to, after%last(i)), past_hinges=.true.)
                    end associate
                end do
            end associate
        end subroutine find_touched

        !> Something goes from a piece to another one; to the next one it is felt in their links only
        subroutine touch(i, j, past_hinges)
            !> The pieces; 0 and beyond the last one are not on the beam
            integer, intent(in) :: i, j
            !> May it pass a hinge
            logical, intent(in) :: past_hinges
            logical :: smooth

            if (i == j) return
            smooth = i > 0 .and. j == i + 1 .and. j <= size(track%link)
            if (smooth .and. .not. past_hinges) smooth = track%link(i) == track%link(j) .or. track%beam%kind(track%link(i)) /= hinge
            if (smooth) then
                touched(track%link(i:j)) = .true.
            else
                touched(:) = .true.
            end if
        end subroutine touch

        !> Piece of an end of a uniform load, 0 left of the beam, one more than there are right of it
        pure function piece_of_end(interval, distance, inside) result(piece)
            type(interval_type), intent(in) :: interval
            !> Its distance from the place of the train, and its piece on the beam
            real(wp), intent(in) :: distance
            integer, intent(in) :: inside
            integer :: piece

            piece = inside
            if (interval%about + distance <= 0.0_wp) piece = 0
            if (interval%about + distance >= track%x(size(track%link))) piece = size(track%link) + 1
        end function piece_of_end

        !> A link on the next stretch
        subroutine go_on(i, k)
            integer, intent(in) :: i, k
            type(link_bounds_type) :: at_link
            real(wp) :: way

            associate (view => bounds%view)
                if (start(i) == 0) then
                    start(i) = k
                    begin(i) = view%ends(1)
                    slopes(i) = slopes_type()
                    call bound_link(assembled, track, view, i, 0.0_wp, first_at_link(i))
                    call reach_values(first_at_link(i), k)
                end if
                slopes(i) = greater(slopes(i), slopes_in_link(view, i))
                way = (view%ends(2) - begin(i))*view%columns%to_length
                if (.not. touched(i) .and. way < longest_way*track%beam%links(i)%length) return
                call bound_link(assembled, track, view, i, 1.0_wp, at_link)
                call reach_values(at_link, k)
                call keep_part(part_type(i, start(i), k, bound_of(i, way, slopes(i), first_at_link(i), at_link)))
                start(i) = 0
                if (touched(i)) return
                start(i) = k + 1
                begin(i) = view%ends(2)
                slopes(i) = slopes_type()
                first_at_link(i) = at_link
            end associate
        end subroutine go_on

        !> Bounds on a way from what is at both ends of it
        function bound_of(i, way, slopes, first, last) result(bound)
            integer, intent(in) :: i
            real(wp), intent(in) :: way
            type(slopes_type), intent(in) :: slopes
            type(link_bounds_type), intent(in) :: first, last
            real(wp) :: bound(2, bending_count)
            real(wp), dimension(bending_count) :: high, low, rise

            high(:) = max(first%high, last%high)
            low(:) = min(first%low, last%low)
            rise(:) = way**2/8*greatest_curvature(track, bounds%view, i, slopes, 1.0_wp, way, high, low)
            bound(1, :) = high + rise
            bound(2, :) = rise - low
        end function bound_of

        !> Values that are reached
        subroutine reach_values(at_link, k)
            type(link_bounds_type), intent(in) :: at_link
            integer, intent(in) :: k

            where (at_link%top > bounds%reached(1, :))
                bounds%reached(1, :) = at_link%top
                bounds%where_reached(1, :) = k
            end where
            where (-at_link%bottom > bounds%reached(2, :))
                bounds%reached(2, :) = -at_link%bottom
                bounds%where_reached(2, :) = k
            end where
            bounds%size(:) = max(bounds%size, abs(at_link%high), abs(at_link%low))
            where (bounds%reached(:, :2) > 0.0_wp) bounds%view%enough(:, :) = far_below*bounds%reached(:, :2)
        end subroutine reach_values

        !> May a part hold an extreme value
        pure function counts(part)
            type(part_type), intent(in) :: part
            logical :: counts
            integer :: f

            counts = .true.
            do f = 1, bending_count
                if (any(.not. part%bound(:, f) < bounds%reached(:, f) - train_slack*bounds%size(f))) return
            end do
            counts = .false.
        end function counts

        !> Keep a part, if it may hold an extreme value
        subroutine keep_part(part)
            type(part_type), intent(in) :: part

            if (.not. counts(part)) return
            if (count == size(parts)) then
                call drop_parts()
                if (2*count > size(parts)) parts = [parts, parts]
            end if
            count = count + 1
            parts(count) = part
        end subroutine keep_part

        !> Drop those that are no longer in question
        subroutine drop_parts()
            integer :: q, kept

            kept = 0
            do q = 1, count
                if (.not. counts(parts(q))) cycle
                kept = kept + 1
                if (kept < q) parts(kept) = parts(q)
            end do
            count = kept
        end subroutine drop_parts

        !> Bounds between two positions on a stretch, halved while they are above what is reached
        recursive subroutine bound_between(i, k, slopes, from, to, first, last, halves)
            integer, intent(in) :: i, k
            type(slopes_type), intent(in) :: slopes
            !> The positions as shares of the stretch, and what there is
            real(wp), intent(in) :: from, to
            type(link_bounds_type), intent(in) :: first, last
            !> Halves that are left
            integer, intent(in) :: halves
            type(link_bounds_type) :: middle
            real(wp) :: bound(2, bending_count)
            logical :: high(2, bending_count)

            bound(:, :) = bound_of(i, (to - from)*bounds%view%columns%length, slopes, first, last)
            high(:, :) = .not. bound < bounds%reached - train_slack*spread(bounds%size, 1, 2)
            if (.not. any(high)) return
            if (halves > 0 .and. any(high .and. bound > bounds%reached + train_slack*spread(bounds%size, 1, 2))) then
                call bound_link(assembled, track, bounds%view, i, from + (to - from)/2, middle)
                call reach_values(middle, k)
                call bound_between(i, k, slopes, from, from + (to - from)/2, first, middle, halves - 1)
                call bound_between(i, k, slopes, from + (to - from)/2, to, middle, last, halves - 1)
                return
            end if
            where (high) bounds%at_most(:, :, k) = max(bounds%at_most(:, :, k), bound)
        end subroutine bound_between

    end subroutine find_bounds

end module gapbeam_train_bounds
