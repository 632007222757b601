!> The largest and smallest values while a train goes over a beam, exact in place and position.
!>
!> Bounds leave few stretches of the way (gapbeam_train_bounds). In a cell and on a stretch every field is a polynomial in x and in
!> the position (gapbeam_train_samples), so what no bound of the samples and no Bernstein coefficient reaches is not there; what is
!> left is looked into (gapbeam_bernstein).
module gapbeam_train_envelope
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, gapbeam_solved
    use gapbeam_bernstein, only: to_coefficients, value_of, highest_degree
    use gapbeam_patch, only: patch_type, greatest_on_patch, most_along
    use gapbeam_element, only: field_type
    use gapbeam_units, only: moment_unit, rotation_unit
    use gapbeam_lowered, only: lowered_type
    use gapbeam_train, only: train_type, track_type, degree_of, least_distance
    use gapbeam_train_cells, only: cell_type, cell_ends, x_in_cell
    use gapbeam_train_passage, only: passage_type
    use gapbeam_train_samples, only: samples_type, new_samples, sample_stretch, sample_supports, along_cell, bound_fields, &
        load_degree, lebesgue
    use gapbeam_train_columns, only: set_scheme
    use gapbeam_train_view, only: look_type, show_stretch, look_at_link
    use gapbeam_train_support_bounds, only: watch_scheme
    use gapbeam_train_candidates, only: candidate_type, candidates_type, equal, least_of, raise, upper_bound, offer
    use gapbeam_train_levels, only: keep_level
    use gapbeam_train_ties, only: tie_type, extreme_type, add_tie, drop_rounding
    use gapbeam_train_bounds, only: bounds_type, find_bounds, slack, most_lost
    implicit none
    private
    public :: envelope_type, find_envelope

    !> How far inside a stretch that does not hold at its first or last position, in least distances
    real(wp), parameter :: inside(0:2) = [0.0_wp, 2.0_wp, -2.0_wp]
    !> What values that are the same differ by, as a share of the largest
    real(wp), parameter :: rounding = 2.0_wp**(-46)
    !> Stretches on which it is tried whether bounds are to be trusted
    integer, parameter :: trials = 8

    !> Largest (1) and smallest (2) values in the user's units; none where no stretch is solved
    type :: envelope_type
        !> Deflection, rotation, moment, shear, shape (2, 4)
        type(extreme_type) :: fields(2, 4)
        !> Reaction, opening, deflection, couple of every support, shape (2, 4, nsupport)
        type(extreme_type), allocatable :: supports(:, :, :)
    end type envelope_type

contains

    !> Find the extremes of all fields and supports
    subroutine find_envelope(lowered, track, train, passage, envelope, error)
        type(lowered_type), intent(in) :: lowered
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        !> By pass_train
        type(passage_type), intent(in) :: passage
        type(envelope_type), intent(out) :: envelope
        type(error_type), allocatable, intent(out) :: error
        type(candidates_type), allocatable :: of_fields(:, :), of_supports(:, :, :)
        type(samples_type) :: samples
        type(bounds_type) :: bounds
        real(wp), allocatable :: matrix(:, :), of_nodes(:, :), starts(:, :, :)
        logical, allocatable :: stays(:, :), wanted(:)
        logical :: told, renewed
        integer :: powers(4), c, f, i, k, last, m, n, sampled, stat

        m = size(lowered%model%supports)
        call new_samples(lowered, track, train, samples, error)
        if (allocated(error)) return
        n = samples%degree
        allocate (of_fields(2, 4), of_supports(2, 4, m), envelope%supports(2, 4, m), matrix(0:n, 0:n), &
                  of_nodes(0:degree_of(train), 0:degree_of(train)), starts(0:n, 4, size(samples%starts, 2)), stays(4, m), &
                  wanted(passage%number), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        matrix(:, :) = to_coefficients(n)
        of_nodes(:, :) = to_coefficients(degree_of(train))
        sampled = 0
        call find_bounds(lowered, track, train, passage, bounds, error)
        if (.not. allocated(error)) call try_bounds()
        if (allocated(error)) return
        do k = 1, passage%number
            wanted(k) = .not. told
            do f = 1, 4
                do i = 1, 2
                    wanted(k) = wanted(k) .or. bounds%at_most(i, f, k) >= of_fields(i, f)%known - slack*bounds%size(f)
                end do
            end do
        end do
        stays(:, :) = .false.
        do k = 1, passage%number
            if (passage%status(k) /= gapbeam_solved) cycle
            renewed = k == 1
            if (.not. renewed) renewed = passage%status(k - 1) /= gapbeam_solved .or. &
                                         any(passage%closed(:, k) .neqv. passage%closed(:, k - 1))
            if (renewed) then
                call begin_scheme()
                if (allocated(error)) return
            end if
            if (.not. told .or. bounds%of_supports(k) .or. any(bounds%supports%always)) then
                call sample_supports(lowered, track, train, passage, k, samples, error)
                if (allocated(error)) return
                do i = 1, m
                    do f = 1, 4
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
        associate (units => lowered%units)
            powers(:) = [units%deflection, rotation_unit(units), moment_unit(units), units%force]
        end associate
        do f = 1, 4
            do i = 1, 2
                call find_extreme(of_fields(i, f), i, powers(f), f == 1, envelope%fields(i, f))
                do c = 1, m
                    call find_extreme(of_supports(i, f, c), i, 0, .false., envelope%supports(i, f, c))
                    if (f <= 2) call drop_rounding(f == 1, lowered%model%supports(c)%side, &
                                                   equal*of_supports(i, f, c)%largest, envelope%supports(i, f, c))
                    if (f == 3) call keep_levels(lowered%node_of_point(lowered%support_point(c)), &
                                                 equal*of_supports(i, f, c)%largest, envelope%supports(i, f, c))
                end do
            end do
        end do

    contains

        !> Sample the fields on a stretch
        subroutine sample_fields()
            integer :: j

            if (sampled == k) return
            sampled = k
            call sample_stretch(lowered, track, train, passage, k, samples, error)
            if (allocated(error)) return
            do j = 1, samples%cells%number
                associate (a => samples%starts(:, j))
                    starts(:, 1, j) = a%deflection
                    starts(:, 2, j) = a%rotation
                    starts(:, 3, j) = a%moment
                    starts(:, 4, j) = a%shear
                end associate
            end do
        end subroutine sample_fields

        !> Look first where large values are reached, so that few stretches are left, and whether bounds are to be trusted there
        !> and on some other stretches
        subroutine try_bounds()
            logical :: known(2, 4)
            integer :: apart, field, way

            told = .true.
            apart = max(passage%number/trials, 32)
            do k = apart, passage%number, apart
                if (passage%status(k) == gapbeam_solved) call try_stretch()
                if (allocated(error) .or. .not. told) return
            end do
            known(:, :) = bounds%where_reached == 0
            do while (.not. all(known))
                k = maxval(bounds%where_reached, .not. known)
                call try_stretch()
                if (allocated(error) .or. .not. told) return
                do field = 1, 4
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
            type(look_type) :: look
            type(field_type) :: seen(size(samples%starts, 2))
            integer :: j, link

            call show_stretch(track, train, passage, k, bounds%view)
            if (.not. bounds%view%clear) return
            call sample_fields()
            if (allocated(error)) return
            do link = 1, size(track%beam%links)
                call look_at_link(lowered, track, bounds%view, link, 1.0_wp, look, seen)
            end do
            do j = 1, samples%cells%number
                told = told .and. all(abs([seen(j)%deflection, seen(j)%rotation, seen(j)%moment, seen(j)%shear] - starts(n, :, j)) &
                                      <= most_lost*bounds%size)
            end do
        end subroutine try_stretch

        !> The largest or smallest value of a field on the stretch that is sampled
        subroutine raise_known(field, way)
            integer, intent(in) :: field, way
            type(patch_type) :: patch
            real(wp) :: low(4), high(4), value, v, u
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
                    call greatest_on_patch(patch, candidates%known, value, v, u, ends_of(samples%cells%cells(j), k))
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
            call set_scheme(track%beam, passage%closed(:, k), bounds%view%columns)
            if (.not. bounds%view%columns%usable) return
            call watch_scheme(lowered, passage%closed(:, k), bounds%view%columns, bounds%supports)
            stays(:, :) = bounds%supports%stays
            if (.not. any(stays)) return
            last = k
            do while (last < passage%number)
                if (passage%status(last + 1) /= gapbeam_solved) exit
                if (any(passage%closed(:, last + 1) .neqv. passage%closed(:, k))) exit
                last = last + 1
            end do
            call sample_supports(lowered, track, train, passage, k, samples, error)
            if (allocated(error)) return
            patch%along = 0
            patch%across = degree_of(train)
            do i = 1, m
                do f = 1, 4
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

        !> Ends of a cell at the first and the last position of a stretch
        pure function ends_of(cell, stretch) result(ends)
            type(cell_type), intent(in) :: cell
            integer, intent(in) :: stretch
            real(wp) :: ends(2, 2)

            ends(:, :) = 0.0_wp
            if (cell%piece == 0) return
            call cell_ends(track, samples%cells, cell, passage%from(stretch), ends(1, 1), ends(2, 1))
            call cell_ends(track, samples%cells, cell, passage%to(stretch), ends(1, 2), ends(2, 2))
        end function ends_of

        !> Coefficients of a field in a cell
        subroutine make_patch(c, field, patch)
            integer, intent(in) :: c, field
            type(patch_type), intent(inout) :: patch
            real(wp) :: values(0:most_along, 0:n)
            integer :: p

            ! One degree more from shear to moment to rotation; the deflection under shear has no more than that under bending
            patch%along = 4 - field + load_degree(samples%loads(:, c))
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
            real(wp) :: low(4), high(4)
            integer :: field

            if (.not. any(samples%pieces(:, c)%length > 0.0_wp)) return
            do field = 1, 4
                call raise(of_fields(1, field), maxval(starts(:, field, c)))
                call raise(of_fields(2, field), -minval(starts(:, field, c)))
            end do
            call bound_fields(samples%starts(:, c), samples%pieces(:, c), samples%loads(:, c), low, high)
            do field = 1, 4
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
            patch%across = degree_of(train)
            patch%b(0, 0:patch%across) = matmul(of_nodes, samples%supports(:, what, i))
            call offer(of_supports(1, what, i), patch, cell_type(), k, k)
            patch%b(0, 0:patch%across) = -patch%b(0, 0:patch%across)
            call offer(of_supports(2, what, i), patch, cell_type(), k, k)
        end subroutine add_support

        !> The largest value among candidates, and where it is
        subroutine find_extreme(candidates, which, power, of_deflection, extreme)
            type(candidates_type), intent(in) :: candidates
            !> 1 largest, 2 smallest
            integer, intent(in) :: which
            !> Exponent of the unit
            integer, intent(in) :: power
            !> Of the beam's deflection
            logical, intent(in) :: of_deflection
            type(extreme_type), intent(out) :: extreme
            type(tie_type) :: tie
            real(wp) :: best, value, v, u
            real(wp) :: found(3, candidates%number), upper(candidates%number)
            integer :: q, next, step

            best = candidates%known
            do q = 1, candidates%number
                upper(q) = upper_bound(candidates%list(q)%patch)
            end do
            found(1, :) = -huge(1.0_wp)
            do step = 1, candidates%number
                next = maxloc(upper, 1)
                if (upper(next) < best - equal*candidates%largest) exit
                associate (one => candidates%list(next))
                    call greatest_on_patch(one%patch, best - equal*candidates%largest, value, v, u, ends_of(one%cell, one%stretch))
                end associate
                found(:, next) = [value, v, u]
                best = max(best, value)
                upper(next) = -huge(1.0_wp)
            end do
            ! In their order, but that what is greater on the beam by more than rounding comes first
            next = 1
            if (candidates%number > 0) next = maxloc(found(1, :), 1)
            do step = 0, candidates%number
                q = step
                if (step == 0) then
                    if (candidates%number == 0) return
                    if (candidates%list(next)%cell%piece == 0) cycle
                    if (.not. any(found(1, :next - 1) >= best - equal*candidates%largest .and. &
                                  found(1, :next - 1) < found(1, next) - rounding*candidates%largest)) cycle
                    q = next
                end if
                if (found(1, q) < best - equal*candidates%largest) cycle
                tie%value = merge(found(1, q), -found(1, q), which == 1)
                if (of_deflection) call keep_level(track%beam, node_at(candidates%list(q)%cell, found(2, q)), &
                                                   equal*candidates%largest, tie%value)
                tie%value = scale(tie%value, power)
                call place_tie(candidates%list(q), found(2, q), found(3, q), equal*candidates%largest, tie)
                call add_tie(extreme, tie)
            end do
            do q = 1, extreme%number
                extreme%ties(q)%position = extreme%ties(q)%position + inside(extreme%ties(q)%limit)*least_distance(track, train)
            end do
        end subroutine find_extreme

        !> Deflections of a rigid support, in the user's units
        subroutine keep_levels(node, rounding, extreme)
            integer, intent(in) :: node
            real(wp), intent(in) :: rounding
            type(extreme_type), intent(inout) :: extreme
            real(wp) :: deflection
            integer :: q

            associate (power => lowered%units%deflection)
                do q = 1, extreme%number
                    deflection = scale(extreme%ties(q)%value, -power)
                    call keep_level(track%beam, node, scale(rounding, -power), deflection)
                    extreme%ties(q)%value = scale(deflection, power)
                end do
            end associate
        end subroutine keep_levels

        !> Node at an end of a cell, -1 if there is none
        pure function node_at(cell, v) result(node)
            type(cell_type), intent(in) :: cell
            real(wp), intent(in) :: v
            integer :: node

            node = -1
            if (v <= 0.0_wp .and. cell%left == 0) node = lowered%node_of_point(cell%piece - 1)
            if (v >= 1.0_wp .and. cell%right == 0) node = lowered%node_of_point(cell%piece)
        end function node_at

        !> Where a value is
        subroutine place_tie(candidate, v, share, slack, tie)
            type(candidate_type), intent(in) :: candidate
            real(wp), intent(in) :: v, share
            !> Values that differ by less are equal
            real(wp), intent(in) :: slack
            type(tie_type), intent(inout) :: tie
            real(wp) :: value, u, from, to
            logical :: flat
            integer :: j

            u = share
            associate (whole => passage%to(candidate%stretch) - passage%from(candidate%stretch))
                if (u*whole <= least_distance(track, train)) u = 0.0_wp
                if ((1 - u)*whole <= least_distance(track, train) .and. u > 0.0_wp) u = 1.0_wp
            end associate
            value = value_of([(value_of(candidate%patch%b(0:candidate%patch%along, j), v), j=0, candidate%patch%across)], u)
            associate (q => candidate%stretch, reach => passage%reaches(passage%reach(candidate%stretch)), &
                       cell => candidate%cell, patch => candidate%patch)
                flat = .true.
                do j = 0, patch%across
                    flat = flat .and. abs(value_of(patch%b(0:patch%along, j), v) - value) <= slack
                end do
                if (flat) u = 0.0_wp
                call place_value(q, cell, v, u, tie%x, tie%position)
                call place_value(candidate%last, cell, v, merge(1.0_wp, u, flat), tie%x_end, tie%position_end)
                tie%limit = 0
                if (u >= 1.0_wp .and. passage%to(q) >= reach%to .and. .not. reach%holds_to) tie%limit = 2
                if (u <= 0.0_wp .and. passage%from(q) <= reach%from .and. .not. reach%holds_from) tie%limit = 1
                tie%side = 0
                if (cell%piece == 0) return
                if (v >= 1.0_wp) tie%side = 1
                if (v <= 0.0_wp) tie%side = 2
                ! Between a support and an axle that comes to it there is a shear that neither has when it is there
                call cell_ends(track, samples%cells, cell, tie%position, from, to)
                if (to - from > least_distance(track, train)) return
                if (u <= 0.0_wp) tie%limit = 1
                if (u >= 1.0_wp) tie%limit = 2
            end associate
        end subroutine place_tie

        !> x and position of a place in a cell
        subroutine place_value(q, cell, v, u, x, position)
            integer, intent(in) :: q
            type(cell_type), intent(in) :: cell
            real(wp), intent(in) :: v, u
            real(wp), intent(out) :: x, position

            x = 0.0_wp
            position = passage%from(q) + u*(passage%to(q) - passage%from(q))
            if (u >= 1.0_wp) position = passage%to(q)
            if (cell%piece == 0) return
            x = x_in_cell(track, samples%cells, cell, position, v)
        end subroutine place_value

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
