!> Places along the beam: kept as a span and a distance from the span's left end, so that a short span far from the
!> origin keeps its digits; places that differ by rounding only become one point.
module gapbeam_places
    use gapbeam_kinds, only: wp
    use gapbeam_scene, only: span_type
    use gapbeam_lowered, only: position_tolerance
    implicit none
    private
    public :: place_span_ends, locate, merge_places

contains

    !> x of the span ends, exact to the last digit: what each addition of the running sum loses is known exactly
    pure subroutine place_span_ends(spans, ends)
        !> The spans, shape (n)
        type(span_type), intent(in) :: spans(:)
        !> The ends, shape (0:n)
        real(wp), intent(out) :: ends(0:)
        real(wp) :: sum, before, added, lost
        integer :: i

        sum = 0.0_wp
        lost = 0.0_wp
        ends(0) = 0.0_wp
        do i = 1, size(spans)
            before = sum
            sum = before + spans(i)%length
            added = sum - before
            lost = lost + ((before - (sum - added)) + (spans(i)%length - added))
            ends(i) = sum + lost
        end do
    end subroutine place_span_ends

    !> Span and distance from its left end of a place. The right end of the beam is the left end of a span that does
    !> not exist, and a place that differs from a span end by rounding only is that span end
    pure subroutine locate(x, ends, span, offset)
        !> The place
        real(wp), intent(in) :: x
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        !> The span, 0..n, and the distance from its left end
        integer, intent(out) :: span
        real(wp), intent(out) :: offset
        integer :: low, high, middle

        low = 0
        high = ubound(ends, 1)
        ! The last end that is not right of x, but never the right end of the beam
        do while (high - low > 1)
            middle = low + (high - low)/2
            if (ends(middle) <= x) then
                low = middle
            else
                high = middle
            end if
        end do
        span = low
        offset = x - ends(span)
        if (ends(span + 1) - x <= position_tolerance*abs(x)) then
            span = span + 1
            offset = 0.0_wp
        else if (offset <= position_tolerance*abs(x)) then
            offset = 0.0_wp
        end if
    end subroutine locate

    !> Points from left to right, places that differ by rounding only taken as one
    pure subroutine merge_places(ends, span, offset, order, chosen, point, number)
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        !> All places, shape (m)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        !> Workspace, shape (m)
        integer, intent(out) :: order(:)
        !> The place that stands for each point, the first `number` entries of shape (m)
        integer, intent(out) :: chosen(:)
        !> Point of every place, from 0, shape (m)
        integer, intent(out) :: point(:)
        !> How many points there are
        integer, intent(out) :: number
        real(wp) :: previous
        integer :: i, k, previous_span

        call sort_places(span, offset, order, chosen)
        number = 0
        previous = 0.0_wp
        previous_span = -1
        do i = 1, size(order)
            k = order(i)
            if (span(k) /= previous_span .or. offset(k) - previous > position_tolerance*(ends(span(k)) + offset(k))) then
                number = number + 1
                chosen(number) = k
            end if
            point(k) = number - 1
            previous_span = span(k)
            previous = offset(k)
        end do
    end subroutine merge_places

    !> Order of the places from left to right by merging sorted runs; equal ones stay in their order
    pure subroutine sort_places(span, offset, order, work)
        integer, intent(in) :: span(:)
        real(wp), intent(in) :: offset(:)
        integer, intent(out) :: order(:), work(:)
        integer :: width, first, middle, last, i, n

        n = size(order)
        do i = 1, n
            order(i) = i
        end do
        width = 1
        do while (width < n)
            do first = 1, n, 2*width
                middle = min(first + width - 1, n)
                last = min(first + 2*width - 1, n)
                if (middle < last) call merge_runs(span, offset, order(first:last), middle - first + 1, work(first:last))
            end do
            width = 2*width
        end do
    end subroutine sort_places

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

end module gapbeam_places
