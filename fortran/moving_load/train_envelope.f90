!> Largest and smallest values while a train goes over a beam, exact in place and position.
!>
!> Bounds leave few stretches of the way (gapbeam_train_bounds). In a cell and on a stretch every field is a polynomial in x and in
!> the position (gapbeam_train_samples), so what no bound of the samples and no Bernstein coefficient reaches is not there; what is
!> left is looked into (gapbeam_bernstein).
module gapbeam_train_envelope
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: bound_trials
    use gapbeam_path_tolerances, only: train_slack, train_equal, most_lost, lebesgue
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, failed, gapbeam_solved
    use gapbeam_bernstein, only: to_coefficients, highest_degree
    use gapbeam_patch, only: patch_type, greatest_on_patch, most_along
    use gapbeam_element, only: field_type
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: bending_count, bending
    use gapbeam_units, only: quantity_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type, degree_of
    use gapbeam_train_cells, only: cell_type
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_samples, only: samples_type, new_samples, sample_stretch, sample_supports, degree_in_position, along_cell, &
        bound_fields, degree_along
    use gapbeam_train_columns, only: set_scheme
    use gapbeam_train_link_bounds, only: link_bounds_type, enter_stretch, bound_link
    use gapbeam_train_support_bounds, only: watch_scheme
    use gapbeam_train_candidates, only: candidates_type, least_of, raise, offer
    use gapbeam_train_prescribed_deflections, only: keep_prescribed_extreme
    use gapbeam_train_ties, only: extreme_type, drop_rounding
    use gapbeam_train_extremes, only: find_extreme, ends_of
    use gapbeam_train_bounds, only: bounds_type, find_bounds
    implicit none
    private
    public :: envelope_type, find_envelope

    !> Values of a support: reaction, opening, deflection, couple
    integer, parameter :: at_support = 4

    !> Largest (1) and smallest (2) values in the user's units; none where no stretch is solved
    type :: envelope_type
        !> Of the quantities of bending (gapbeam_quantities), shape (2, bending_count)
        type(extreme_type) :: fields(2, bending_count)
        !> Reaction, opening, deflection, couple of every support, shape (2, at_support, nsupport)
        type(extreme_type), allocatable :: supports(:, :, :)
    end type envelope_type

contains

    !> Find the extremes of all fields and supports
    subroutine find_envelope(assembled, track, traversal, envelope, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        !> By pass_train
        type(traversal_type), intent(in) :: traversal
        type(envelope_type), intent(out) :: envelope
        type(error_type), allocatable, intent(out) :: error
        type(candidates_type), allocatable :: of_fields(:, :), of_supports(:, :, :)
        type(samples_type) :: samples
        type(bounds_type) :: bounds
        real(wp), allocatable :: matrix(:, :), of_nodes(:, :), starts(:, :, :)
        logical, allocatable :: stays(:, :), wanted(:)
        logical :: told, renewed
        integer :: powers(bending_count), c, f, i, k, last, m, n, sampled, stat

        m = size(assembled%model%supports)
        call new_samples(assembled, track, degree_in_position(track%train), samples, error)
        if (allocated(error)) return
        n = samples%degree
        allocate (of_fields(2, bending_count), of_supports(2, at_support, m), envelope%supports(2, at_support, m), &
                  matrix(0:n, 0:n), of_nodes(0:degree_of(track%train), 0:degree_of(track%train)), &
                  starts(0:n, bending_count, size(samples%starts, 2)), stays(at_support, m), &
                  wanted(traversal%number), stat=stat)
        if (failed(stat, error)) return
        matrix(:, :) = to_coefficients(n)
        of_nodes(:, :) = to_coefficients(degree_of(track%train))
        sampled = 0
        call find_bounds(assembled, track, traversal, bounds, error)
        if (.not. allocated(error)) call try_bounds()
        if (allocated(error)) return
        do k = 1, traversal%number
            wanted(k) = .not. told
            do f = 1, bending_count
                do i = 1, 2
                    wanted(k) = wanted(k) .or. bounds%at_most(i, f, k) >= of_fields(i, f)%known - train_slack*bounds%size(f)
                end do
            end do
        end do
        stays(:, :) = .false.
        do k = 1, traversal%number
            call end_if_stopped(track%beam%watch, error)
            if (allocated(error)) return
            if (traversal%status(k) /= gapbeam_solved) cycle
            renewed = k == 1
            if (.not. renewed) renewed = traversal%status(k - 1) /= gapbeam_solved &
                .or. any(traversal%closed(:, k) .neqv. traversal%closed(:, k - 1))
            if (renewed) then
                call begin_scheme()
                if (allocated(error)) return
            end if
            if (.not. told .or. bounds%of_supports(k) .or. any(bounds%supports%always)) then
                call sample_supports(assembled, track, traversal, k, samples, error)
                if (allocated(error)) return
                do i = 1, m
                    do f = 1, at_support
                        if (.not. stays(f, i)) call add_support(i, f)
                    end do
                end do
            end if
            if (.not. wanted(k)) cycle
            call sample_fields()
            if (allocated(error)) return
            do c = 1, samples%cells%number
                call add_cell(c)
            end do
        end do
        powers(:) = quantity_unit(assembled%units, bending)
        do f = 1, bending_count
            do i = 1, 2
                call end_if_stopped(track%beam%watch, error)
                if (allocated(error)) return
                call find_extreme(assembled, track, traversal, samples%cells, of_fields(i, f), i, powers(f), f == 1, &
                                  envelope%fields(i, f))
            end do
        end do
        do f = 1, at_support
            do i = 1, 2
                call end_if_stopped(track%beam%watch, error)
                if (allocated(error)) return
                do c = 1, m
                    call find_extreme(assembled, track, traversal, samples%cells, of_supports(i, f, c), i, 0, .false., &
                                      envelope%supports(i, f, c))
                    if (f <= 2) call drop_rounding(f == 1, assembled%model%supports(c)%side, &
                                                   train_equal*of_supports(i, f, c)%largest, envelope%supports(i, f, c))
                    if (f == 3) call keep_prescribed_extreme(track%beam, assembled%node_of_point(assembled%support_point(c)), &
                                                             assembled%units%deflection, train_equal*of_supports(i, f, c)%largest, &
                                                             envelope%supports(i, f, c))
                end do
            end do
        end do

    contains

        !> Sample the fields on a stretch
        subroutine sample_fields()
            integer :: j, p

            if (sampled == k) return
            sampled = k
            call sample_stretch(assembled, track, traversal, k, samples, error)
            if (allocated(error)) return
            do j = 1, samples%cells%number
                do p = 0, n
                    starts(p, :, j) = bending_values(samples%starts(p, j), samples%pieces(p, j), samples%loads(p, j)%kappa)
                end do
            end do
        end subroutine sample_fields

        !> Look first where large values are reached, so that few stretches are left, and whether bounds are to be trusted there
        !> and on some other stretches
        subroutine try_bounds()
            logical :: known(2, bending_count)
            integer :: apart, field, way

            told = .true.
            apart = max(traversal%number/bound_trials, 32)
            do k = apart, traversal%number, apart
                if (traversal%status(k) == gapbeam_solved) call try_stretch()
                if (allocated(error) .or. .not. told) return
            end do
            known(:, :) = bounds%where_reached == 0
            do while (.not. all(known))
                k = maxval(bounds%where_reached, .not. known)
                call try_stretch()
                if (allocated(error) .or. .not. told) return
                do field = 1, bending_count
                    do way = 1, 2
                        if (bounds%where_reached(way, field) /= k) cycle
                        call raise_known(field, way)
                        known(way, field) = .true.
                    end do
                end do
            end do
        end subroutine try_bounds

        !> Compare what bounds rest on with what is refined
        subroutine try_stretch()
            type(link_bounds_type) :: at_link
            type(field_type) :: seen(size(samples%starts, 2))
            integer :: j, link

            call enter_stretch(track, traversal, k, bounds%view)
            if (.not. bounds%view%clear) return
            call sample_fields()
            if (allocated(error)) return
            do link = 1, size(track%beam%links)
                call bound_link(assembled, track, bounds%view, link, 1.0_wp, at_link, seen)
            end do
            do j = 1, samples%cells%number
                told = told .and. all(abs(bending_values(seen(j), samples%pieces(n, j), samples%loads(n, j)%kappa) &
                                          - starts(n, :, j)) <= most_lost*bounds%size)
            end do
        end subroutine try_stretch

        !> The largest or smallest value of a field on the stretch that is sampled
        subroutine raise_known(field, way)
            integer, intent(in) :: field, way
            type(patch_type) :: patch
            real(wp) :: low(bending_count), high(bending_count), value, v, u
            integer :: j

            associate (candidates => of_fields(way, field))
                do j = 1, samples%cells%number
                    if (.not. any(samples%pieces(:, j)%length > 0.0_wp)) cycle
                    candidates%known = max(candidates%known, maxval(merge(1, -1, way == 1)*starts(:, field, j)))
                end do
                do j = 1, samples%cells%number
                    if (.not. any(samples%pieces(:, j)%length > 0.0_wp)) cycle
                    call bound_fields(samples%starts(:, j), samples%pieces(:, j), samples%loads(:, j), low, high)
                    if (max(high(field), -low(field)) < candidates%known) cycle
                    call make_patch(j, field, patch)
                    if (way == 2) patch%b(:, 0:n) = -patch%b(:, 0:n)
                    call greatest_on_patch(patch, candidates%known, value, v, u, &
                                           ends_of(track, traversal, samples%cells, samples%cells%cells(j), k))
                    candidates%known = max(candidates%known, value)
                end do
            end associate
        end subroutine raise_known

        !> Supports in a scheme of which values stay as they are until it changes
        subroutine begin_scheme()
            type(patch_type) :: patch
            integer :: i, f

            stays(:, :) = .false.
            if (.not. told .or. m == 0) return
            call set_scheme(track%beam, traversal%closed(:, k), bounds%view%columns)
            if (.not. bounds%view%columns%usable) return
            call watch_scheme(assembled, traversal%closed(:, k), bounds%view%columns, bounds%supports)
            stays(:, :) = bounds%supports%stays
            if (.not. any(stays)) return
            last = k
            do while (last < traversal%number)
                if (traversal%status(last + 1) /= gapbeam_solved) exit
                if (any(traversal%closed(:, last + 1) .neqv. traversal%closed(:, k))) exit
                last = last + 1
            end do
            call sample_supports(assembled, track, traversal, k, samples, error)
            if (allocated(error)) return
            patch%along = 0
            patch%across = degree_of(track%train)
            do i = 1, m
                do f = 1, at_support
                    if (.not. stays(f, i)) cycle
                    associate (value => samples%supports(0, f, i))
                        call raise(of_supports(1, f, i), value)
                        call raise(of_supports(2, f, i), -value)
                        patch%b(0, :) = value
                        call offer(of_supports(1, f, i), patch, cell_type(), k, last)
                        patch%b(0, :) = -value
                        call offer(of_supports(2, f, i), patch, cell_type(), k, last)
                    end associate
                end do
            end do
        end subroutine begin_scheme

        !> Coefficients of a field in a cell
        subroutine make_patch(c, field, patch)
            integer, intent(in) :: c, field
            type(patch_type), intent(inout) :: patch
            real(wp) :: values(0:most_along, 0:n)
            integer :: p

            patch%along = degree_along(field, samples%loads(:, c))
            patch%across = n
            do p = 0, n
                call along_cell(field, patch%along, samples%starts(p, c), samples%pieces(p, c), samples%loads(p, c), &
                                values(0:patch%along, p))
            end do
            call convert(matrix, values(0:patch%along, :), patch%b)
        end subroutine make_patch

        !> Look at the fields in a cell
        subroutine add_cell(c)
            integer, intent(in) :: c
            type(patch_type) :: patch
            real(wp) :: low(bending_count), high(bending_count)
            integer :: field

            if (.not. any(samples%pieces(:, c)%length > 0.0_wp)) return
            do field = 1, bending_count
                call raise(of_fields(1, field), maxval(starts(:, field, c)))
                call raise(of_fields(2, field), -minval(starts(:, field, c)))
            end do
            call bound_fields(samples%starts(:, c), samples%pieces(:, c), samples%loads(:, c), low, high)
            do field = 1, bending_count
                if (high(field) < least_of(of_fields(1, field)) .and. -low(field) < least_of(of_fields(2, field))) cycle
                call make_patch(c, field, patch)
                call offer(of_fields(1, field), patch, samples%cells%cells(c), k, k)
                patch%b(:, 0:n) = -patch%b(:, 0:n)
                call offer(of_fields(2, field), patch, samples%cells%cells(c), k, k)
            end do
        end subroutine add_cell

        !> Look at a support
        subroutine add_support(i, what)
            integer, intent(in) :: i, what
            type(patch_type) :: patch
            real(wp) :: change

            associate (values => samples%supports(:, what, i))
                call raise(of_supports(1, what, i), maxval(values))
                call raise(of_supports(2, what, i), -minval(values))
                change = lebesgue*maxval(abs(values - samples%supports(0, what, i)))
            end associate
            associate (first => samples%supports(0, what, i))
                if (first + change < least_of(of_supports(1, what, i)) .and. &
                    change - first < least_of(of_supports(2, what, i))) return
            end associate
            patch%along = 0
            patch%across = degree_of(track%train)
            patch%b(0, 0:patch%across) = matmul(of_nodes, samples%supports(:, what, i))
            call offer(of_supports(1, what, i), patch, cell_type(), k, k)
            patch%b(0, 0:patch%across) = -patch%b(0, 0:patch%across)
            call offer(of_supports(2, what, i), patch, cell_type(), k, k)
        end subroutine add_support

    end subroutine find_envelope

    !> Coefficients in the position from values at the sample points
    pure subroutine convert(matrix, values, b)
        !> Shape (0:n, 0:n)
        real(wp), intent(in) :: matrix(0:, 0:)
        !> Coefficients along the cell at the sample points, shape (0:along, 0:n)
        real(wp), intent(in) :: values(0:, 0:)
        real(wp), intent(inout) :: b(0:most_along, 0:highest_degree)
        integer :: j, k, p

        do k = 0, ubound(matrix, 1)
            b(0:ubound(values, 1), k) = 0.0_wp
            do p = 0, ubound(matrix, 1)
                do j = 0, ubound(values, 1)
                    b(j, k) = b(j, k) + matrix(k, p)*values(j, p)
                end do
            end do
        end do
    end subroutine convert

end module gapbeam_train_envelope
