!> Largest and smallest values at chosen places of the beam while a train goes over it.
module gapbeam_train_curves
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: train_slack, train_equal, train_rounding, most_lost
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed, gapbeam_solved
    use gapbeam_bernstein, only: part_of, find_greatest
    use gapbeam_element, only: fields_at
    use gapbeam_link, only: piece_load_type
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: bending_count, bending
    use gapbeam_units, only: quantity_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type, degree_of, least_distance
    use gapbeam_train_cells, only: cells_type, cell_ends
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_prescribed_deflections, only: keep_prescribed
    use gapbeam_train_samples, only: samples_type, new_samples, sample_stretch
    use gapbeam_train_places, only: places_type, new_places, reach, exceed
    use gapbeam_train_screen, only: screen_type, new_screen, show_stretch, values_in_cell, reach_at, bounds_in_cell, &
        fields_at_position
    implicit none
    private
    public :: find_curves

    !> What a place is passed for: to note values that it reaches, to bound them, to look at them with all digits
    integer, parameter :: reaching = 1, bounding = 2, looking = 3

contains

    !> Largest and smallest values of the fields at given places, over all positions
    subroutine find_curves(assembled, track, traversal, piece, distance, value, position, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        !> By pass_train
        type(traversal_type), intent(in) :: traversal
        !> Pieces, and the distances from their left ends in the user's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Largest (1) and smallest (2) of the quantities of bending (gapbeam_quantities) in the user's units, and the positions of
        !> the train, shape (2, bending_count, n); where no stretch is solved -huge and huge
        real(wp), intent(out) :: value(:, :, :), position(:, :, :)
        type(error_type), allocatable, intent(out) :: error
        type(samples_type) :: samples
        type(screen_type) :: screen
        type(places_type) :: places
        real(wp) :: near
        logical, allocatable :: wanted(:)
        logical :: told
        integer :: powers(bending_count), d, f, k, stat, q

        value(1, :, :) = -huge(1.0_wp)
        value(2, :, :) = huge(1.0_wp)
        position(:, :, :) = 0.0_wp
        d = degree_of(track%train)
        call new_samples(assembled, track, d, samples, error)
        if (allocated(error)) return
        call new_screen(assembled, track, screen, stat)
        if (stat == 0) call new_places(track, piece, distance, screen%view%columns%to_length, places, stat)
        if (stat == 0) allocate (wanted(size(piece)), stat=stat)
        if (failed(stat, error)) return
        ! First what is reached at the ends of stretches, so that then there is little left to look into
        near = least_distance(track)
        told = .true.
        do k = 1, traversal%number
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
            if (traversal%status(k) /= gapbeam_solved) cycle
            call show_stretch(assembled, track, traversal, k, screen)
            if (screen%view%clear) call pass_beam(reaching)
        end do
        call search()
        if (allocated(error)) return
        ! Where what is seen is not to be trusted
        if (.not. told) then
            places%reached(:, :, :) = -huge(1.0_wp)
            call search()
            if (allocated(error)) return
        end if
        do q = 1, size(piece)
            do k = 1, 2
                call keep_prescribed(track%beam, node_of_place(q), train_equal*screen%sizes(1), value(k, 1, q))
            end do
        end do
        powers(:) = quantity_unit(assembled%units, bending)
        do f = 1, bending_count
            where (abs(value(:, f, :)) < huge(1.0_wp)) value(:, f, :) = scale(value(:, f, :), powers(f))
        end do
        call end_if_stopped(track%beam%watch, error)

    contains

        !> Node of a place, by the number that it was given with, -1 if it is at none
        pure function node_of_place(q) result(node)
            integer, intent(in) :: q
            integer :: node

            node = -1
            if (distance(q) <= 0.0_wp) then
                node = assembled%node_of_point(piece(q) - 1)
            else if (distance(q)*screen%view%columns%to_length >= assembled%pieces(piece(q))%length) then
                node = assembled%node_of_point(piece(q))
            end if
        end function node_of_place

        !> Look into all stretches, at the places at which something larger may be
        subroutine search()
            integer :: c, q

            do q = 1, size(piece)
                call set_threshold(q)
            end do
            do k = 1, traversal%number
                call end_if_stopped(track%beam%watch, error)
                if (allocated(error)) return
                if (traversal%status(k) /= gapbeam_solved) cycle
                call show_stretch(assembled, track, traversal, k, screen)
                wanted(:) = .not. (told .and. screen%view%clear)
                if (told .and. screen%view%clear) call pass_beam(bounding)
                if (.not. any(wanted)) cycle
                call sample_stretch(assembled, track, traversal, k, samples, error)
                if (allocated(error)) return
                if (told .and. screen%view%clear) then
                    do c = 1, samples%cells%number
                        associate (p => samples%pieces(d, c), kappa => samples%loads(d, c)%kappa)
                            told = told .and. all(abs(bending_values(screen%seen(c, d), p, kappa) &
                                                      - bending_values(samples%starts(d, c), p, kappa)) <= most_lost*screen%sizes)
                        end associate
                    end do
                    if (.not. told) return
                end if
                do q = 1, size(piece)
                    if (.not. wanted(q)) cycle
                    call pass_place(samples%cells, q, looking)
                    call set_threshold(q)
                end do
            end do
        end subroutine search

        !> What a place must exceed to be looked at: what is reached for certain, and what is known with all digits
        subroutine set_threshold(q)
            integer, intent(in) :: q

            associate (known => value(:, :, places%given(q)), sizes => screen%sizes)
                places%threshold(q, :, 1) = max(places%reached(q, :, 1) - train_slack*sizes, known(1, :) + train_rounding*sizes)
                places%threshold(q, :, 2) = max(places%reached(q, :, 2) - train_slack*sizes, train_rounding*sizes - known(2, :))
            end associate
        end subroutine set_threshold

        !> All places during a stretch, cell by cell: those that stay in one, and those that something passes
        subroutine pass_beam(purpose)
            !> What for: reaching or bounding
            integer, intent(in) :: purpose
            integer :: j, number, first, last, q
            real(wp) :: right

            do j = 1, size(track%link)
                first = places%first(j)
                last = places%first(j + 1) - 1
                if (first > last) cycle
                do number = screen%view%cells%first(j), screen%view%cells%first(j + 1) - 2
                    right = screen%view%cells%offset(screen%view%cells%cells(number)%right)
                    q = first
                    do while (q <= last)
                        if (places%x(q) - right >= traversal%from(k) - near) exit
                        q = q + 1
                    end do
                    call stay(number, first, q - 1, purpose)
                    first = q
                    do while (first <= last)
                        if (places%x(first) - right > traversal%to(k) + near) exit
                        call pass_place(screen%view%cells, first, purpose)
                        first = first + 1
                    end do
                end do
                call stay(number, first, last, purpose)
            end do
        end subroutine pass_beam

        !> Places in a cell that stay in it all the way
        subroutine stay(cell, first, last, purpose)
            !> The cell, and its first and last place
            integer, intent(in) :: cell, first, last, purpose
            real(wp) :: b(0:d, bending_count)
            integer :: q

            if (first > last) return
            call values_in_cell(assembled, track, screen, cell, first, last, places)
            if (purpose == reaching) then
                call reach(first, last, places)
                return
            end if
            call exceed(first, last, rise_between(track%link(screen%view%cells%cells(cell)%piece), screen%view%ends), places)
            do q = first, last
                if (.not. places%excess(q) > 0.0_wp) cycle
                b(:, :) = bounds_in_cell(assembled, track, screen, q, cell, places)
                wanted(q) = any(maxval(b, 1) > places%threshold(q, :, 1)) .or. any(-minval(b, 1) > places%threshold(q, :, 2))
            end do
        end subroutine stay

        !> How far values can be from the line between those at two positions
        pure function rise_between(link, ends) result(rise)
            integer, intent(in) :: link
            real(wp), intent(in) :: ends(2)
            real(wp) :: rise(bending_count)

            rise(:) = ((ends(2) - ends(1))*screen%view%columns%to_length)**2/8*screen%curvature(:, link)
        end function rise_between

        !> A place during a stretch: between the positions at which something passes it
        subroutine pass_place(cells, q, purpose)
            type(cells_type), intent(in) :: cells
            !> Number of the place
            integer, intent(in) :: q
            !> What for: reaching, bounding or looking
            integer, intent(in) :: purpose
            real(wp) :: at, from
            integer :: number

            associate (j => piece(places%given(q)), to => traversal%to(k))
                from = traversal%from(k)
                do number = cells%first(j + 1) - 2, cells%first(j), -1
                    ! The right end of this cell is a point that passes the place from the left
                    at = places%x(q) - cells%offset(cells%cells(number)%right)
                    if (at > to + near) exit
                    if (at < from - near) cycle
                    ! Both sides of it, also where it passes at an end of the stretch
                    call visit(q, number + 1, from, min(max(at, from), to), purpose)
                    from = min(max(at, from), to)
                end do
                call visit(q, number + 1, from, to, purpose)
            end associate
        end subroutine pass_place

        !> A place between two positions
        subroutine visit(q, cell, from, to, purpose)
            integer, intent(in) :: q, cell, purpose
            real(wp), intent(in) :: from, to

            if (purpose == looking) then
                call search_position(q, cell, from, to)
            else
                call glance(q, cell, from, to, purpose)
            end if
        end subroutine visit

        !> What a place reaches at the ends of a stretch, or whether it may reach more than is known between two positions
        subroutine glance(q, cell, from, to, purpose)
            integer, intent(in) :: q, cell, purpose
            real(wp), intent(in) :: from, to
            real(wp), dimension(bending_count) :: first, last, rise

            associate (ends => screen%view%ends)
                if (purpose == reaching) then
                    if (from <= ends(1)) call reach_at(assembled, track, screen, q, cell, from, places)
                    if (to >= ends(2)) call reach_at(assembled, track, screen, q, cell, to, places)
                    return
                end if
            end associate
            if (wanted(q)) return
            first(:) = fields_at_position(assembled, track, screen, q, cell, from, places)
            last(:) = first
            if (to > from) last(:) = fields_at_position(assembled, track, screen, q, cell, to, places)
            rise(:) = rise_between(track%link(screen%view%cells%cells(cell)%piece), [from, to])
            wanted(q) = any(max(first, last) + rise > places%threshold(q, :, 1)) .or. &
                any(rise - min(first, last) > places%threshold(q, :, 2))
        end subroutine glance

        !> A place between two positions, with all digits; the fields of its cell go on as polynomials beyond the ends of the cell
        subroutine search_position(q, cell, from, to)
            integer, intent(in) :: q, cell
            real(wp), intent(in) :: from, to
            type(piece_load_type) :: load
            real(wp) :: values(0:d, bending_count), part(0:d), first, last, left, right, slope, x
            integer :: p, field, j

            j = samples%cells%cells(cell)%piece
            x = distance(places%given(q))
            slope = screen%view%loads(j)%qb - screen%view%loads(j)%qa
            do p = 0, d
                call cell_ends(track, samples%cells, samples%cells%cells(cell), samples%position(p), left, right)
                left = left - track%x(j - 1)
                load = samples%loads(p, cell)
                associate (piece => assembled%pieces(j))
                    values(p, :) = bending_values(fields_at(samples%starts(p, cell), scale(x - left, -track%length_unit), &
                                                            piece%length, piece%flexibility, piece%shear_flexibility, load%qa, &
                                                            load%qa + slope, load%kappa), piece, load%kappa)
                end associate
            end do
            first = share_of(from)
            last = share_of(to)
            values(:, :) = matmul(screen%matrix, values)
            associate (known => value(:, :, places%given(q)), where_known => position(:, :, places%given(q)), &
                       same => train_rounding*screen%sizes, &
                       least => places%reached(q, :, :) - train_slack*spread(screen%sizes, 2, 2))
                do field = 1, bending_count
                    ! No part has more than the whole
                    if (maxval(values(:, field)) < max(known(1, field), least(field, 1)) - same(field) .and. &
                        -minval(values(:, field)) < max(-known(2, field), least(field, 2)) - same(field)) cycle
                    part(:) = part_of(values(:, field), first, last)
                    call raise(part, 1.0_wp, from, to, least(field, 1), same(field), known(1, field), where_known(1, field))
                    call raise(part, -1.0_wp, from, to, least(field, 2), same(field), known(2, field), where_known(2, field))
                end do
            end associate
        end subroutine search_position

        !> Share of the stretch at a position
        pure function share_of(s) result(share)
            real(wp), intent(in) :: s
            real(wp) :: share

            share = 0.0_wp
            if (s > traversal%from(k)) share = (s - traversal%from(k))/(traversal%to(k) - traversal%from(k))
            if (s >= traversal%to(k)) share = 1.0_wp
        end function share_of

    end subroutine find_curves

    !> Raise the largest value, or lower the smallest one
    pure subroutine raise(b, way, from, to, least, same, value, position)
        !> Bernstein coefficients of a field over the positions
        real(wp), intent(in) :: b(0:)
        !> 1 or -1
        real(wp), intent(in) :: way
        !> The positions; what lies below this is not looked for
        real(wp), intent(in) :: from, to, least
        !> Of positions whose values differ by less the first one is taken
        real(wp), intent(in) :: same
        !> So far
        real(wp), intent(inout) :: value, position
        real(wp) :: best, u

        if (.not. maxval(way*b) > max(way*value, least)) return
        call find_greatest(way*b, best, u)
        if (.not. best > way*value) return
        if (best > way*value + same) position = from + u*(to - from)
        value = way*best
    end subroutine raise

end module gapbeam_train_curves
