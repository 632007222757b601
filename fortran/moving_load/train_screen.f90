!> A train on a stretch of its way as it is seen without all digits: the fields of its cells at the sample points, from the
!> polynomials of gapbeam_train_columns.
module gapbeam_train_screen
    use gapbeam_kinds, only: wp
    use gapbeam_bernstein, only: sample_points, to_coefficients
    use gapbeam_element, only: field_type, fields_at
    use gapbeam_link, only: piece_load_type
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: bending_count
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type, degree_of
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_columns, only: at_distance
    use gapbeam_train_link_bounds, only: view_type, link_bounds_type, new_view, enter_stretch, bound_link, slopes_in_link, &
        greatest_curvature
    use gapbeam_train_places, only: places_type, values_along, reach
    implicit none
    private
    public :: screen_type, new_screen, show_stretch, values_in_cell, reach_at, bounds_in_cell, fields_at_position

    !> What is seen
    type :: screen_type
        type(view_type) :: view
        !> Degree of nodes in the position, the sample points of that degree, and what makes coefficients of values there
        integer :: degree = 0
        real(wp), allocatable :: points(:), matrix(:, :)
        !> Fields at the left ends of all cells at the sample points of the stretch and, last, anywhere,
        !> shape (ncell, 0:degree + 1); of which links those between both ends are known
        type(field_type), allocatable :: seen(:, :)
        logical, allocatable :: sampled(:)
        !> The link whose fields anywhere are known, 0: none, and the position
        integer :: link = 0
        real(wp) :: position = 0.0_wp
        !> Of every link bounds of the second derivatives in the position of the quantities of bending
        real(wp), allocatable :: curvature(:, :)
        !> Bounds of these quantities on all stretches so far
        real(wp) :: sizes(bending_count) = 0.0_wp
    end type screen_type

contains

    !> Make ready to look
    subroutine new_screen(assembled, track, screen, stat)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(out) :: screen
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat

        screen%degree = degree_of(track%train)
        call new_view(assembled, track, screen%view, stat)
        if (stat /= 0) return
        associate (d => screen%degree, n => size(track%beam%links))
            allocate (screen%points(0:d), screen%matrix(0:d, 0:d), screen%seen(size(screen%view%cells%cells), 0:d + 1), &
                      screen%sampled(n), screen%curvature(bending_count, n), stat=stat)
            if (stat /= 0) return
            screen%points(:) = sample_points(d)
            screen%matrix(:, :) = to_coefficients(d)
        end associate
    end subroutine new_screen

    !> Show a stretch: the fields at the left ends of all cells, at both ends of it
    subroutine show_stretch(assembled, track, traversal, k, screen)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(traversal_type), intent(in) :: traversal
        !> Number of a stretch that is solved
        integer, intent(in) :: k
        type(screen_type), intent(inout) :: screen
        type(link_bounds_type) :: at_link
        integer :: i, one

        associate (view => screen%view, sizes => screen%sizes)
            call enter_stretch(track, traversal, k, view)
            if (.not. view%clear) return
            screen%sampled(:) = .false.
            screen%link = 0
            do i = 1, size(track%beam%links)
                do one = 0, 1
                    ! Deflections and rotations are only measured
                    view%enough(:, :) = spread(sizes(:2), 1, 2)
                    call bound_link(assembled, track, view, i, real(one, wp), at_link, screen%seen(:, one*screen%degree))
                    sizes(:) = max(sizes, abs(at_link%high), abs(at_link%low))
                end do
                screen%curvature(:, i) = greatest_curvature(track, view, i, slopes_in_link(view, i), 0.0_wp, 0.0_wp, &
                                                            at_link%high, at_link%low)
            end do
        end associate
    end subroutine show_stretch

    !> Left end of a cell in its piece, and the load from there on
    pure subroutine begin_cell(assembled, track, screen, cell, s, from, load)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(in) :: screen
        integer, intent(in) :: cell
        !> Position
        real(wp), intent(in) :: s
        real(wp), intent(out) :: from
        type(piece_load_type), intent(out) :: load
        real(wp) :: slope

        associate (view => screen%view, there => screen%view%cells%cells(cell))
            from = 0.0_wp
            if (there%left > 0) from = at_distance(track, view%columns, there%piece, s + view%cells%offset(there%left))
            load = view%loads(there%piece)
            slope = load%qb - load%qa
            load%qa = load%qa + slope*(from/assembled%pieces(there%piece)%length) + there%q
            load%qb = load%qa + slope
        end associate
    end subroutine begin_cell

    !> Values at both ends of the stretch at places that stay in a cell
    pure subroutine values_in_cell(assembled, track, screen, cell, first, last, places)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(in) :: screen
        !> The cell, and its first and last place
        integer, intent(in) :: cell, first, last
        type(places_type), intent(inout) :: places
        type(piece_load_type) :: load
        real(wp) :: from
        integer :: one

        do one = 1, 2
            call begin_cell(assembled, track, screen, cell, screen%view%ends(one), from, load)
            call values_along(screen%seen(cell, (one - 1)*screen%degree), assembled%pieces(screen%view%cells%cells(cell)%piece), &
                              load, from, first, last, one, places)
        end do
    end subroutine values_in_cell

    !> Take what a place has at a position as reached
    subroutine reach_at(assembled, track, screen, q, cell, s, places)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(inout) :: screen
        !> The place, the cell that is there, and the position
        integer, intent(in) :: q, cell
        real(wp), intent(in) :: s
        type(places_type), intent(inout) :: places

        places%ends(q, :, 1) = fields_at_position(assembled, track, screen, q, cell, s, places)
        places%ends(q, :, 2) = places%ends(q, :, 1)
        call reach(q, q, places)
    end subroutine reach_at

    !> Coefficients in the position at a place that stays in a cell: between the least and the greatest are all values
    function bounds_in_cell(assembled, track, screen, q, cell, places) result(b)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(inout) :: screen
        !> The place and the cell
        integer, intent(in) :: q, cell
        type(places_type), intent(in) :: places
        !> Of the quantities of bending
        real(wp) :: b(0:screen%degree, bending_count)
        type(link_bounds_type) :: at_link
        integer :: p

        associate (i => track%link(screen%view%cells%cells(cell)%piece), ends => screen%view%ends)
            if (.not. screen%sampled(i)) then
                do p = 1, screen%degree - 1
                    call bound_link(assembled, track, screen%view, i, screen%points(p), at_link, screen%seen(:, p))
                end do
                screen%sampled(i) = .true.
            end if
            do p = 0, screen%degree
                b(p, :) = fields_seen(assembled, track, screen, q, cell, ends(1) + screen%points(p)*(ends(2) - ends(1)), p, places)
            end do
        end associate
        b(:, :) = matmul(screen%matrix, b)
    end function bounds_in_cell

    !> Fields at a place at any position of the stretch
    function fields_at_position(assembled, track, screen, q, cell, s, places) result(found)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(inout) :: screen
        !> The place, the cell that is there, and the position
        integer, intent(in) :: q, cell
        real(wp), intent(in) :: s
        type(places_type), intent(in) :: places
        !> Quantities of bending
        real(wp) :: found(bending_count)
        type(link_bounds_type) :: at_link
        integer :: p

        associate (view => screen%view, d => screen%degree)
            p = d + 1
            if (s >= view%ends(2)) p = d
            if (s <= view%ends(1)) p = 0
            associate (link => track%link(view%cells%cells(cell)%piece))
                if (p > d .and. (link /= screen%link .or. abs(s - screen%position) > 0.0_wp)) then
                    ! Both sides of what passes the place
                    call bound_link(assembled, track, view, link, (s - view%ends(1))/(view%ends(2) - view%ends(1)), at_link, &
                                    screen%seen(:, p))
                    screen%link = link
                    screen%position = s
                end if
            end associate
        end associate
        found(:) = fields_seen(assembled, track, screen, q, cell, s, p, places)
    end function fields_at_position

    !> The same where the fields at the left ends of the cells are seen
    pure function fields_seen(assembled, track, screen, q, cell, s, p, places) result(found)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(screen_type), intent(in) :: screen
        integer, intent(in) :: q, cell
        real(wp), intent(in) :: s
        !> Number of that position
        integer, intent(in) :: p
        type(places_type), intent(in) :: places
        real(wp) :: found(bending_count)
        type(piece_load_type) :: load
        real(wp) :: t

        call begin_cell(assembled, track, screen, cell, s, t, load)
        associate (piece => assembled%pieces(screen%view%cells%cells(cell)%piece))
            found(:) = bending_values(fields_at(screen%seen(cell, p), max(0.0_wp, places%distance(q) - t), piece%length, &
                                                piece%flexibility, piece%shear_flexibility, load%qa, load%qb, load%kappa), &
                                      piece, load%kappa)
        end associate
    end function fields_seen

end module gapbeam_train_screen
