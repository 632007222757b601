!> Stations along the beam, each a span and a distance from its left end.
!> So a short span far from the origin keeps its digits.
!>
!> Places that differ by rounding only (position_tolerance) count as one point: a place becomes the span end that is so near,
!> else the nearest support or hinge, else the first of the loads' ends to its left. What is near is near to the point itself,
!> not to another place near it, so no chain of places can become one: no place is moved by more than the tolerance, and no
!> two points of a span are nearer to each other than that. python/gapbeam/places.py does the same for scenes.
module gapbeam_stations
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_ordered, only: last_not_above
    use gapbeam_scene, only: span_type
    implicit none
    private
    public :: place_span_ends, locate, merge_stations, sort_stations

contains

    !> x of the span ends, exact to the last digit: what each addition of the running sum loses is known exactly
    pure subroutine place_span_ends(spans, ends, rest)
        !> The spans, shape (n)
        type(span_type), intent(in) :: spans(:)
        !> The ends, shape (0:n)
        real(wp), intent(out) :: ends(0:)
        !> What the ends lack of the sums, as doubles do
        real(wp), intent(out), contiguous, optional :: rest(0:)
        real(wp) :: sum, before, added, lost
        integer :: i

        sum = 0.0_wp
        lost = 0.0_wp
        ends(0) = 0.0_wp
        if (present(rest)) rest(0) = 0.0_wp
        do i = 1, size(spans)
            before = sum
            sum = before + spans(i)%length
            added = sum - before
            lost = lost + ((before - (sum - added)) + (spans(i)%length - added))
            ends(i) = sum + lost
            if (present(rest)) rest(i) = (sum - ends(i)) + lost
        end do
    end subroutine place_span_ends

    !> Span and distance from its left end of a place. The right end of the beam is the left end of a span that does
    !> not exist, and a place that differs from a span end by rounding only is that span end
    pure subroutine locate(x, ends, span, offset)
        real(wp), intent(in) :: x
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        !> The span, 0..n, and the distance from its left end
        integer, intent(out) :: span
        real(wp), intent(out) :: offset
        real(wp) :: rounding

        ! Never the right end of the beam
        span = last_not_above(ends(:ubound(ends, 1) - 1), x)
        offset = x - ends(span)
        if (ends(span + 1) - x <= position_tolerance*abs(x)) then
            span = span + 1
            offset = 0.0_wp
            return
        end if
        rounding = position_tolerance*abs(x)
        ! What is left of a distance from the right end, unless the first span is as short
        associate (of_beam => position_tolerance*ends(ubound(ends, 1)))
            if (span == 0 .and. ends(1) > of_beam) rounding = of_beam
        end associate
        if (offset <= rounding) offset = 0.0_wp
    end subroutine locate

    !> Points from left to right, places that differ by rounding only taken as one
    pure subroutine merge_stations(ends, span, offset, anchors, order, chosen, point, number)
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        !> All places, shape (m)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        !> The first so many of them are span ends, supports and hinges
        integer, intent(in) :: anchors
        !> Workspace, shape (m)
        integer, intent(out) :: order(:)
        !> The place that stands for each point, the first `number` entries of shape (m)
        integer, intent(out) :: chosen(:)
        !> Point of every place, from 0, shape (m)
        integer, intent(out) :: point(:)
        !> How many points there are
        integer, intent(out) :: number
        integer :: i, k, last

        call sort_stations(span, offset, order, chosen)
        ! Until the points are numbered, point holds the place that stands for the point of each
        last = order(1)
        do i = 1, size(order)
            k = order(i)
            if (k > anchors) cycle
            if (.not. is_near(ends, span, offset, last, k)) last = k
            point(k) = last
        end do
        call join_anchors(ends, span, offset, anchors, order, chosen, point)
        last = 0
        do i = 1, size(order)
            k = order(i)
            if (point(k) /= 0) cycle
            if (last == 0) last = k
            if (.not. is_near(ends, span, offset, last, k)) last = k
            point(k) = last
        end do
        number = 0
        do i = 1, size(order)
            if (point(order(i)) /= order(i)) cycle
            number = number + 1
            chosen(number) = order(i)
        end do
        do i = 1, number
            order(chosen(i)) = i - 1
        end do
        point(:) = order(point)
    end subroutine merge_stations

    !> Does place b, not left of place a, differ from it by rounding only
    pure function is_near(ends, span, offset, a, b) result(near)
        !> As for merge_stations
        real(wp), intent(in) :: ends(0:)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        !> The places
        integer, intent(in) :: a, b
        logical :: near

        near = span(a) == span(b) .and. offset(b) - offset(a) <= position_tolerance*(ends(span(b)) + offset(b))
    end function is_near

    !> What is near a point of the anchors is at the nearest of them
    pure subroutine join_anchors(ends, span, offset, anchors, order, next, stands)
        !> As for merge_stations
        real(wp), intent(in) :: ends(0:)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        integer, intent(in) :: anchors, order(:)
        !> Workspace: the next point of the anchors to the right, 0: none
        integer, intent(out) :: next(:)
        !> Of anchors in, of the others 0 where no point of an anchor is near
        integer, intent(inout) :: stands(:)
        integer :: i, k, left, right

        right = 0
        do i = size(order), 1, -1
            k = order(i)
            next(i) = right
            if (k > anchors) cycle
            if (stands(k) == k) right = k
        end do
        left = order(1)
        do i = 1, size(order)
            k = order(i)
            right = next(i)
            if (k <= anchors) then
                if (stands(k) == k) left = k
                cycle
            end if
            stands(k) = 0
            if (is_near(ends, span, offset, left, k)) stands(k) = left
            if (right == 0) cycle
            if (.not. is_near(ends, span, offset, k, right)) cycle
            if (stands(k) == 0 .or. offset(right) - offset(k) < offset(k) - offset(left)) stands(k) = right
        end do
    end subroutine join_anchors

    !> Order of the places from left to right by merging sorted runs; equal ones stay in their order
    pure subroutine sort_stations(span, offset, order, work)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        integer, intent(out) :: order(:), work(:)
        integer :: width, first, middle, last, i, n

        n = size(order)
        order(1:n) = [(i, i=1, n)]
        width = 1
        do while (width < n)
            do first = 1, n, 2*width
                middle = min(first + width - 1, n)
                last = min(first + 2*width - 1, n)
                if (middle < last) call merge_runs(span, offset, order(first:last), middle - first + 1, work(first:last))
            end do
            width = 2*width
        end do
    end subroutine sort_stations

    !> Merge two runs, the first `half` entries and the rest
    pure subroutine merge_runs(span, offset, order, half, work)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        integer, intent(inout) :: order(:)
        integer, intent(in) :: half
        integer, intent(out) :: work(:)
        integer :: i, j, k, n

        n = size(order)
        if (.not. is_left_of(order(half + 1), order(half))) return
        work(1:half) = order(1:half)
        i = 1
        j = half + 1
        do k = 1, n
            if (i > half) exit
            if (j > n) then
                order(k) = work(i)
                i = i + 1
            else if (is_left_of(order(j), work(i))) then
                order(k) = order(j)
                j = j + 1
            else
                order(k) = work(i)
                i = i + 1
            end if
        end do

    contains

        !> Is place a left of place b
        pure function is_left_of(a, b) result(left)
            integer, intent(in) :: a, b
            logical :: left

            left = span(a) < span(b) .or. (span(a) == span(b) .and. offset(a) < offset(b))
        end function is_left_of

    end subroutine merge_runs

end module gapbeam_stations
