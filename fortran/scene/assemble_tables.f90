!> Assembly of tables: values at the ends of the pieces of the beam, which is cut at their points.
module gapbeam_assemble_tables
    use gapbeam_kinds, only: wp
    use gapbeam_assembled_model, only: assembled_type
    implicit none
    private
    public :: place_type, place_in_table, place_of, distance, between, follow_table

    !> Where something is: the span and the distance from its left end
    type :: place_type
        integer :: span
        real(wp) :: offset
    end type place_type

contains

    !> The values of a table at the ends of pieces: straight between its points, beyond its ends the last value. Every piece lies
    !> between two points
    pure subroutine follow_table(assembled, left, right, places, given, values)
        type(assembled_type), intent(in) :: assembled
        !> First and last point of the beam
        integer, intent(in) :: left, right
        !> The points of the table, in ascending order, and their values
        type(place_type), intent(in) :: places(:)
        real(wp), intent(in) :: given(:)
        !> Shape (2, right - left)
        real(wp), intent(out) :: values(:, :)
        type(place_type) :: ends(2)
        integer :: i, j, k

        i = 1
        do j = left + 1, right
            ends = [place_of(assembled, j - 1), place_of(assembled, j)]
            ! The first point of the table that is right of the middle of the piece: its ends may differ from points by rounding
            do while (i <= size(places))
                if (distance(assembled, ends(1), places(i)) > distance(assembled, ends(1), ends(2))/2) exit
                i = i + 1
            end do
            if (i == 1 .or. i > size(places)) then
                values(:, j - left) = given(min(i, size(places)))
                cycle
            end if
            do k = 1, 2
                values(k, j - left) = between(given(i - 1), given(i), &
                                              min(1.0_wp, max(0.0_wp, distance(assembled, places(i - 1), ends(k)) &
                                                              /distance(assembled, places(i - 1), places(i)))))
            end do
        end do
    end subroutine follow_table

    !> Where a point of a table is: on its foundation exactly at the beam's own point, which may differ by rounding
    elemental function place_in_table(assembled, number, x) result(place)
        type(assembled_type), intent(in) :: assembled
        !> Among the points of tables, then of laws; and its place as given
        integer, intent(in) :: number
        real(wp), intent(in) :: x
        type(place_type) :: place

        place = place_type(0, x)
        if (assembled%ground_point(number) >= 0) place = place_of(assembled, assembled%ground_point(number))
    end function place_in_table

    !> Where a point of the beam is
    pure function place_of(assembled, point) result(place)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: point
        type(place_type) :: place

        place = place_type(assembled%point_span(point), assembled%point_offset(point))
    end function place_of

    !> Distance from one place to another, positive to the right
    pure function distance(assembled, from, to) result(length)
        type(assembled_type), intent(in) :: assembled
        type(place_type), intent(in) :: from, to
        real(wp) :: length

        length = (assembled%ends(to%span) - assembled%ends(from%span)) + (to%offset - from%offset)
    end function distance

    !> A value at a share of the way from one to another
    elemental function between(a, b, share) result(value)
        real(wp), intent(in) :: a, b, share
        real(wp) :: value

        value = a
        if (abs(a - b) > 0.0_wp) value = a*(1 - share) + b*share
    end function between

end module gapbeam_assemble_tables
