!> Largest and smallest values at chosen places of the beam while a train goes over it.
module gapbeam_train_curves
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: train_slack, train_equal, train_rounding, most_lost
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved
    use gapbeam_bernstein, only: sample_points, to_coefficients
    use gapbeam_patch, only: patch_type, greatest_on_patch
    use gapbeam_element, only: field_type, fields_at
    use gapbeam_link, only: piece_load_type, combine_loads
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: state_count, bending_count, bending
    use gapbeam_units, only: quantity_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: train_type, track_type, degree_of, least_distance
    use gapbeam_train_cells, only: cells_type, cell_ends
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_columns, only: at_distance
    use gapbeam_train_link_bounds, only: view_type, link_bounds_type, new_view, enter_stretch, bound_link, &
        slopes_in_link, greatest_curvature
    use gapbeam_train_prescribed_deflections, only: keep_prescribed
    use gapbeam_train_samples, only: samples_type, new_samples, sample_stretch, degree_in_position
    implicit none
    private
    public :: find_curves

    !> What a place is passed for: to note values that it reaches, to bound them, to look at them with all digits
    integer, parameter :: reaching = 1, bounding = 2, looking = 3

contains

    !> Largest and smallest values of the fields at given places, over all positions
    subroutine find_curves(assembled, track, train, traversal, piece, distance, value, position, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
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
        real(wp), allocatable :: starts(:, :, :), matrix(:, :)
        type(piece_load_type), allocatable :: loads(:)
        real(wp) :: points(0:degree_of(train)), on_whole(0:degree_of(train), 0:degree_in_position(train))
        real(wp) :: at_place(0:degree_of(train), 0:degree_of(train)), sizes(bending_count), near
        type(view_type) :: view
        type(field_type), allocatable :: seen(:, :)
        real(wp), allocatable :: reached(:, :, :), curvature(:, :)
        logical, allocatable :: wanted(:)
        logical :: told
        integer :: powers(bending_count), d, f, k, n, stat, q

        value(1, :, :) = -huge(1.0_wp)
        value(2, :, :) = huge(1.0_wp)
        position(:, :, :) = 0.0_wp
        call new_samples(assembled, track, train, samples, error)
        if (allocated(error)) return
        n = samples%degree
        call new_view(assembled, track, train, view, stat)
        if (stat == 0) allocate (starts(0:n, state_count, size(samples%starts, 2)), matrix(0:n, 0:n), &
                                 seen(size(samples%starts, 2), 3), reached(2, bending_count, size(piece)), &
                                 curvature(bending_count, size(track%beam%links)), wanted(size(piece)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        matrix(:, :) = to_coefficients(n)
        loads = combine_loads(assembled%dead, assembled%live, 1.0_wp)
        d = degree_of(train)
        points(:) = sample_points(d)
        at_place(:, :) = to_coefficients(d)
        do k = 0, d
            on_whole(k, :) = basis(n, points(k))
        end do
        ! First what is reached at the ends of stretches, so that then there is little left to look into
        reached(:, :, :) = -huge(1.0_wp)
        sizes(:) = 0.0_wp
        near = least_distance(track, train)
        told = .true.
        do k = 1, traversal%number
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
            if (traversal%status(k) /= gapbeam_solved) cycle
            call show()
            if (.not. view%clear) cycle
            do q = 1, size(piece)
                call pass_place(view%cells, q, reaching)
            end do
        end do
        call search()
        if (allocated(error)) return
        ! Where what is seen is not to be trusted
        if (.not. told) then
            reached(:, :, :) = -huge(1.0_wp)
            call search()
            if (allocated(error)) return
        end if
        do q = 1, size(piece)
            do k = 1, 2
                call keep_prescribed(track%beam, node_of_place(q), train_equal*sizes(1), value(k, 1, q))
            end do
        end do
        powers(:) = quantity_unit(assembled%units, bending)
        do f = 1, bending_count
            where (abs(value(:, f, :)) < huge(1.0_wp)) value(:, f, :) = scale(value(:, f, :), powers(f))
        end do
        call end_if_stopped(track%beam%watch, error)

    contains

        !> Node of a place, -1 if it is at none
        pure function node_of_place(q) result(node)
            integer, intent(in) :: q
            integer :: node

            node = -1
            if (distance(q) <= 0.0_wp) then
                node = assembled%node_of_point(piece(q) - 1)
            else if (distance(q)*view%columns%to_length >= assembled%pieces(piece(q))%length) then
                node = assembled%node_of_point(piece(q))
            end if
        end function node_of_place

        !> Show a stretch: the fields at the left ends of all cells, at both ends of it
        subroutine show()
            type(link_bounds_type) :: at_link
            integer :: i

            call enter_stretch(track, train, traversal, k, view)
            if (.not. view%clear) return
            do i = 1, size(track%beam%links)
                call bound_link(assembled, track, view, i, 0.0_wp, at_link, seen(:, 1))
                sizes(:) = max(sizes, abs(at_link%high), abs(at_link%low))
                call bound_link(assembled, track, view, i, 1.0_wp, at_link, seen(:, 2))
                sizes(:) = max(sizes, abs(at_link%high), abs(at_link%low))
                curvature(:, i) = greatest_curvature(track, view, i, slopes_in_link(view, i), 0.0_wp, 0.0_wp, at_link%high, &
                                                     at_link%low)
            end do
        end subroutine show

        !> Look into all stretches, at the places at which something larger may be
        subroutine search()
            integer :: c

            do k = 1, traversal%number
                call end_if_stopped(track%beam%watch, error)
                if (allocated(error)) return
                if (traversal%status(k) /= gapbeam_solved) cycle
                call show()
                wanted(:) = .not. (told .and. view%clear)
                if (told .and. view%clear) then
                    do q = 1, size(piece)
                        call pass_place(view%cells, q, bounding)
                    end do
                end if
                if (.not. any(wanted)) cycle
                call sample_stretch(assembled, track, train, traversal, k, samples, error)
                if (allocated(error)) return
                if (told .and. view%clear) then
                    do c = 1, samples%cells%number
                        associate (p => samples%pieces(n, c), kappa => samples%loads(n, c)%kappa)
                            told = told .and. all(abs(bending_values(seen(c, 2), p, kappa) &
                                                      - bending_values(samples%starts(n, c), p, kappa)) <= most_lost*sizes)
                        end associate
                    end do
                    if (.not. told) return
                end if
                do c = 1, samples%cells%number
                    starts(:, 1, c) = matmul(matrix, samples%starts(:, c)%deflection)
                    starts(:, 2, c) = matmul(matrix, samples%starts(:, c)%rotation)
                    starts(:, 3, c) = matmul(matrix, samples%starts(:, c)%moment)
                    starts(:, 4, c) = matmul(matrix, samples%starts(:, c)%shear)
                end do
                do q = 1, size(piece)
                    if (wanted(q)) call pass_place(samples%cells, q, looking)
                end do
            end do
        end subroutine search

        !> A place during a stretch: between the positions at which something passes it
        subroutine pass_place(cells, q, purpose)
            type(cells_type), intent(in) :: cells
            !> Number of the place
            integer, intent(in) :: q
            !> What for: reaching, bounding or looking
            integer, intent(in) :: purpose
            real(wp) :: at, from
            integer :: number

            associate (j => piece(q), x => track%x(piece(q) - 1) + distance(q), to => traversal%to(k))
                from = traversal%from(k)
                do number = cells%first(j + 1) - 2, cells%first(j), -1
                    ! The right end of this cell is a point that passes the place from the left
                    at = x - cells%offset(cells%cells(number)%right)
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
                call search_position(piece(q), distance(q), cell, from, to, reached(:, :, q) - train_slack*spread(sizes, 1, 2), &
                                     value(:, :, q), position(:, :, q))
            else
                call glance(q, cell, from, to, purpose)
            end if
        end subroutine visit

        !> What a place reaches at the ends of a stretch, or whether it may reach more than is known between two positions
        subroutine glance(q, cell, from, to, purpose)
            integer, intent(in) :: q, cell, purpose
            real(wp), intent(in) :: from, to
            real(wp), dimension(bending_count) :: first, last, rise

            if (purpose == reaching) then
                if (from <= view%ends(1)) call reach(q, fields_seen(q, cell, from))
                if (to >= view%ends(2)) call reach(q, fields_seen(q, cell, to))
                return
            end if
            if (wanted(q)) return
            first(:) = fields_seen(q, cell, from)
            last(:) = first
            if (to > from) last(:) = fields_seen(q, cell, to)
            rise(:) = ((to - from)*view%columns%to_length)**2/8*curvature(:, track%link(piece(q)))
            wanted(q) = any(max(first, last) + rise >= reached(1, :, q) - train_slack*sizes .and. &
                            max(first, last) + rise > value(1, :, q) + train_rounding*sizes) .or. &
                any(rise - min(first, last) >= reached(2, :, q) - train_slack*sizes .and. &
                    min(first, last) - rise < value(2, :, q) - train_rounding*sizes)
        end subroutine glance

        !> Values that are reached at a place
        subroutine reach(q, found)
            integer, intent(in) :: q
            real(wp), intent(in) :: found(bending_count)

            reached(1, :, q) = max(reached(1, :, q), found)
            reached(2, :, q) = max(reached(2, :, q), -found)
        end subroutine reach

        !> Fields at a place from what is seen
        function fields_seen(q, cell, s) result(found)
            !> Place, cell that is there, and position
            integer, intent(in) :: q, cell
            real(wp), intent(in) :: s
            real(wp) :: found(bending_count)
            type(link_bounds_type) :: at_link
            type(field_type) :: at
            real(wp) :: t, qa, slope
            integer :: i

            i = 3
            if (s >= view%ends(2)) i = 2
            if (s <= view%ends(1)) i = 1
            if (i == 3) call bound_link(assembled, track, view, track%link(piece(q)), &
                                        (s - view%ends(1))/(view%ends(2) - view%ends(1)), at_link, seen(:, 3))
            associate (p => assembled%pieces(piece(q)), load => view%loads(piece(q)), there => view%cells%cells(cell))
                t = 0.0_wp
                if (there%left > 0) t = at_distance(track, view%columns, piece(q), s + view%cells%offset(there%left))
                slope = load%qb - load%qa
                qa = load%qa + slope*(t/p%length) + there%q
                at = fields_at(seen(cell, i), max(0.0_wp, distance(q)*view%columns%to_length - t), p%length, p%flexibility, &
                               p%shear_flexibility, qa, qa + slope, load%kappa)
                found(:) = bending_values(at, p, load%kappa)
            end associate
        end function fields_seen

        !> A place between two positions
        subroutine search_position(j, t, cell, from, to, least, largest, where_largest)
            integer, intent(in) :: j, cell
            real(wp), intent(in) :: t, from, to
            !> What is reached for certain: largest, negative smallest values
            real(wp), intent(in) :: least(:, :)
            real(wp), intent(inout) :: largest(:, :), where_largest(:, :)
            type(patch_type) :: patch
            type(field_type) :: at
            type(piece_load_type) :: load
            real(wp) :: values(0:d, bending_count), start(state_count), s, u, left, right
            logical :: whole
            integer :: p, field

            whole = from <= traversal%from(k) .and. to >= traversal%to(k)
            do p = 0, d
                s = from + points(p)*(to - from)
                if (whole) then
                    start(:) = matmul(on_whole(p, :), starts(:, :, cell))
                else
                    u = 0.0_wp
                    if (traversal%to(k) > traversal%from(k)) u = (s - traversal%from(k))/(traversal%to(k) - traversal%from(k))
                    start(:) = matmul(basis(n, u), starts(:, :, cell))
                end if
                call cell_ends(track, samples%cells, samples%cells%cells(cell), s, left, right)
                left = left - track%x(j - 1)
                load = loads(j)
                associate (piece => assembled%pieces(j), begin => scale(left, -track%length_unit), &
                           distance => scale(max(0.0_wp, t - left), -track%length_unit), slope => loads(j)%qb - loads(j)%qa)
                    load%qa = load%qa + slope*(begin/piece%length)
                    load%qa = load%qa + samples%cells%cells(cell)%q
                    at = fields_at(field_type(start(1), start(2), start(3), start(4)), distance, piece%length, piece%flexibility, &
                                   piece%shear_flexibility, load%qa, load%qa + slope, load%kappa)
                end associate
                values(p, :) = bending_values(at, assembled%pieces(j), load%kappa)
            end do
            patch%along = 0
            patch%across = d
            do field = 1, bending_count
                do p = 0, d
                    if (values(p, field) > largest(1, field)) then
                        largest(1, field) = values(p, field)
                        where_largest(1, field) = from + points(p)*(to - from)
                    end if
                    if (values(p, field) < largest(2, field)) then
                        largest(2, field) = values(p, field)
                        where_largest(2, field) = from + points(p)*(to - from)
                    end if
                end do
                patch%b(0, 0:d) = matmul(at_place, values(:, field))
                call raise(patch, 1.0_wp, from, to, least(1, field), largest(1, field), where_largest(1, field))
                call raise(patch, -1.0_wp, from, to, least(2, field), largest(2, field), where_largest(2, field))
            end do
        end subroutine search_position

    end subroutine find_curves

    !> Raise the largest value, or lower the smallest one
    pure subroutine raise(patch, way, from, to, least, value, position)
        !> A field over the positions
        type(patch_type), intent(in) :: patch
        !> 1 or -1
        real(wp), intent(in) :: way
        !> The positions; what lies below this is not looked for
        real(wp), intent(in) :: from, to, least
        !> So far
        real(wp), intent(inout) :: value, position
        type(patch_type) :: turned
        real(wp) :: best, v, u

        if (.not. maxval(way*patch%b(0, 0:patch%across)) > max(way*value, least)) return
        turned = patch
        turned%b(0, 0:patch%across) = way*patch%b(0, 0:patch%across)
        call greatest_on_patch(turned, max(way*value, least), best, v, u)
        if (.not. best > way*value) return
        value = way*best
        position = from + u*(to - from)
    end subroutine raise

    !> Bernstein polynomials at a place
    pure function basis(n, u) result(b)
        !> Degree, and the place
        integer, intent(in) :: n
        real(wp), intent(in) :: u
        real(wp) :: b(0:n)
        integer :: k

        b(0) = 1.0_wp
        do k = 1, n
            b(k) = u*b(k - 1)
            b(1:k - 1) = (1 - u)*b(1:k - 1) + u*b(0:k - 2)
            b(0) = (1 - u)*b(0)
        end do
    end function basis

end module gapbeam_train_curves
