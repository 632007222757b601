!> Places at which largest and smallest values are asked for while a train goes over a beam, and what is known of them.
module gapbeam_train_places
    use gapbeam_kinds, only: wp
    use gapbeam_patch, only: most_along
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, piece_load_type
    use gapbeam_quantities, only: bending_count
    use gapbeam_stations, only: sort_stations
    use gapbeam_train, only: track_type
    use gapbeam_train_samples, only: powers_along
    implicit none
    private
    public :: places_type, new_places, values_along, reach, exceed

    !> Places in ascending order along the beam
    type :: places_type
        !> The numbers that they were given with, shape (n), and the first one of every piece, shape (npiece + 1)
        integer, allocatable :: given(:), first(:)
        !> x in the user's units; distances from the left ends of their pieces in the engine's
        real(wp), allocatable :: x(:), distance(:)
        !> Largest and negative smallest values of the quantities of bending that are reached, and those above which a place is
        !> looked at, shape (n, bending_count, 2)
        real(wp), allocatable :: reached(:, :, :), threshold(:, :, :)
        !> Values at both ends of a stretch, shape (n, bending_count, 2), and by how much they may be above the thresholds on it
        real(wp), allocatable :: ends(:, :, :), excess(:)
    end type places_type

contains

    !> Put places in order
    pure subroutine new_places(track, piece, distance, to_length, places, stat)
        type(track_type), intent(in) :: track
        !> Pieces, and the distances from their left ends in the user's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Engine's units of length in one of the user's
        real(wp), intent(in) :: to_length
        type(places_type), intent(out) :: places
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: work(size(piece)), n, q, j

        n = size(piece)
        allocate (places%given(n), places%first(size(track%link) + 1), places%x(n), places%distance(n), &
                  places%reached(n, bending_count, 2), places%threshold(n, bending_count, 2), places%ends(n, bending_count, 2), &
                  places%excess(n), stat=stat)
        if (stat /= 0) return
        call sort_stations(piece, distance, places%given, work)
        places%x(:) = [(track%x(piece(places%given(q)) - 1) + distance(places%given(q)), q=1, n)]
        places%distance(:) = distance(places%given)*to_length
        places%reached(:, :, :) = -huge(1.0_wp)
        q = 1
        do j = 1, size(places%first)
            do while (q <= n)
                if (piece(places%given(q)) >= j) exit
                q = q + 1
            end do
            places%first(j) = q
        end do
    end subroutine new_places

    !> Fields at places in a cell
    pure subroutine values_along(a, p, q, from, first, last, which, places)
        !> Fields at the left end of the cell, and its piece
        type(field_type), intent(in) :: a
        type(piece_type), intent(in) :: p
        !> The load from there on along the length of the piece
        type(piece_load_type), intent(in) :: q
        !> Distance of the left end of the cell from that of the piece
        real(wp), intent(in) :: from
        !> The first and the last place, and the end of the stretch
        integer, intent(in) :: first, last, which
        type(places_type), intent(inout) :: places
        real(wp) :: c(0:most_along), v(first:last)
        integer :: f, k, top

        v(:) = (places%distance(first:last) - from)/p%length
        do f = 1, bending_count
            c(:) = powers_along(f, a, p, q)
            top = max(0, findloc(abs(c) > 0.0_wp, .true., 1, back=.true.) - 1)
            associate (values => places%ends(first:last, f, which))
                values(:) = c(top)
                do k = top - 1, 0, -1
                    values(:) = c(k) + v*values
                end do
            end associate
        end do
    end subroutine values_along

    !> Take values at both ends of a stretch as reached
    pure subroutine reach(first, last, places)
        integer, intent(in) :: first, last
        type(places_type), intent(inout) :: places

        associate (at => places%ends(first:last, :, :), reached => places%reached(first:last, :, :))
            reached(:, :, 1) = max(reached(:, :, 1), at(:, :, 1), at(:, :, 2))
            reached(:, :, 2) = max(reached(:, :, 2), -at(:, :, 1), -at(:, :, 2))
        end associate
    end subroutine reach

    !> By how much places may exceed their thresholds between both ends of a stretch
    pure subroutine exceed(first, last, rise, places)
        integer, intent(in) :: first, last
        !> How far values may be from the line between those at the ends
        real(wp), intent(in) :: rise(bending_count)
        type(places_type), intent(inout) :: places
        integer :: f

        associate (excess => places%excess(first:last))
            excess(:) = -huge(1.0_wp)
            do f = 1, bending_count
                associate (a => places%ends(first:last, f, 1), b => places%ends(first:last, f, 2), &
                           threshold => places%threshold(first:last, f, :))
                    excess(:) = max(excess, max(a, b) + rise(f) - threshold(:, 1), rise(f) - min(a, b) - threshold(:, 2))
                end associate
            end do
        end associate
    end subroutine exceed

end module gapbeam_train_places
