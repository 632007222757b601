!> Samples of a train on a stretch of its way: solutions at a few positions, from which all follows.
!>
!> In a cell of the beam under the train (gapbeam_train_cells) and on a stretch of its way (gapbeam_train_path) every field is a
!> polynomial in x and in the position. Degrees in the position: node values 3, times 3 for the deflection under an axle; one more
!> with a uniform load.
module gapbeam_train_samples
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: lebesgue
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_bernstein, only: sample_points
    use gapbeam_patch, only: most_along
    use gapbeam_band, only: band_ok
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, piece_load_type
    use gapbeam_fields, only: bending_values, softness_of
    use gapbeam_quantities, only: state_count, derived_count, bending_count, shares_of, terms_of_derived
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_and_refine
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_along_axis, only: solve_along_axis
    use gapbeam_support_values, only: support_values
    use gapbeam_train, only: train_type, track_type, degree_of
    use gapbeam_train_intervals, only: interval_type, enter_interval
    use gapbeam_train_loads, only: place_train
    use gapbeam_train_cells, only: cells_type, new_cells, find_cells, fill_cells, recover_cells, fields_in_cell
    use gapbeam_train_traversal, only: traversal_type
    implicit none
    private
    public :: samples_type, new_samples, sample_stretch, sample_supports, degree_in_position, along_cell, powers_along, &
        bound_fields, degree_along

    !> What is sampled of a stretch
    type :: samples_type
        integer :: degree = 0
        !> Positions, shape (0:degree)
        real(wp), allocatable :: position(:)
        !> Fields at the left ends of the cells, their lengths and loads, shape (0:degree, ncell)
        type(field_type), allocatable :: starts(:, :)
        type(piece_type), allocatable :: pieces(:, :)
        type(piece_load_type), allocatable :: loads(:, :)
        !> Of the supports, which have the degree of the nodes, shape (0:degree_of(train), 4, nsupport)
        real(wp), allocatable :: supports(:, :, :)
        type(cells_type) :: cells
        !> Where the train is
        type(interval_type) :: interval
        type(workspace_type) :: work
        type(state_type) :: state
    end type samples_type

contains

    !> Degree of the fields in the position of a train
    pure function degree_in_position(train) result(degree)
        type(train_type), intent(in) :: train
        integer :: degree

        degree = merge(7, 6, size(train%uniform) > 0)
    end function degree_in_position

    !> Room for samples
    subroutine new_samples(assembled, track, degree, samples, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        !> Of what is made of the samples, in the position
        integer, intent(in) :: degree
        type(samples_type), intent(out) :: samples
        !> No memory, or as for solve_along_axis
        type(error_type), allocatable, intent(out) :: error
        integer :: most, stat

        samples%degree = degree
        most = size(track%link) + size(track%train%offset) + 2*size(track%train%uniform)
        call new_cells(track, samples%cells, stat)
        if (stat == 0) allocate (samples%position(0:degree), samples%starts(0:degree, most), samples%pieces(0:degree, most), &
                                 samples%loads(0:degree, most), samples%supports(0:degree_of(track%train), 4, &
                                                                            size(assembled%model%supports)), &
                                 stat=stat)
        if (failed(stat, error)) return
        call new_workspace(track%beam, samples%work)
        call new_state(assembled, samples%state, error)
        if (allocated(error)) return
        ! No train moves what is along the axis
        samples%state%factor = 1.0_wp
        call solve_along_axis(assembled, samples%state, error)
    end subroutine new_samples

    !> Sample the fields on a stretch that is solved
    subroutine sample_stretch(assembled, track, traversal, k, samples, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        type(traversal_type), intent(in) :: traversal
        !> Number of the stretch
        integer, intent(in) :: k
        type(samples_type), intent(inout) :: samples
        !> The scheme has no solution
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: points(0:samples%degree)
        integer :: p

        points(:) = sample_points(samples%degree)
        call enter_interval(track, traversal%intervals(traversal%interval(k)), samples%interval)
        call find_cells(track, samples%interval, samples%cells)
        associate (n => samples%cells%number)
            do p = 0, samples%degree
                samples%position(p) = traversal%from(k) + points(p)*(traversal%to(k) - traversal%from(k))
                call solve_at(track, traversal%closed(:, k), samples%position(p), samples, error)
                if (allocated(error)) return
                call fill_cells(assembled, track, samples%position(p), samples%cells)
                call recover_cells(track, samples%work, samples%cells)
                samples%starts(p, :n) = samples%cells%starts(:n)
                samples%pieces(p, :n) = samples%cells%pieces(:n)
                samples%loads(p, :n) = samples%cells%loads(:n)
            end do
        end associate
    end subroutine sample_stretch

    !> Sample the supports on a stretch that is solved
    subroutine sample_supports(assembled, track, traversal, k, samples, error)
        !> As for sample_stretch
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(inout) :: track
        type(traversal_type), intent(in) :: traversal
        integer, intent(in) :: k
        type(samples_type), intent(inout) :: samples
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: points(0:degree_of(track%train))
        integer :: condition(size(assembled%model%supports)), p

        points(:) = sample_points(degree_of(track%train))
        call enter_interval(track, traversal%intervals(traversal%interval(k)), samples%interval)
        do p = 0, degree_of(track%train)
            call solve_at(track, traversal%closed(:, k), &
                          traversal%from(k) + points(p)*(traversal%to(k) - traversal%from(k)), &
                          samples, error)
            if (allocated(error)) return
            associate (s => samples%state, work => samples%work)
                s%closed(:) = traversal%closed(:, k)
                s%deflection(:) = work%answers%deflection
                s%moment_left(:) = work%answers%moment_left
                s%moment_right(:) = work%answers%moment_right
                s%reaction(:) = work%reaction
                call support_values(assembled, s, samples%supports(p, 1, :), samples%supports(p, 3, :), &
                                    samples%supports(p, 2, :), samples%supports(p, 4, :), condition)
            end associate
        end do
    end subroutine sample_supports

    !> Solve at a position in the interval that the samples are in
    subroutine solve_at(track, closed, s, samples, error)
        type(track_type), intent(inout) :: track
        !> The scheme, and the position
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: s
        type(samples_type), intent(inout) :: samples
        type(error_type), allocatable, intent(out) :: error
        integer :: state, place

        call place_train(track, samples%interval, s)
        call set_loads(track%beam, 1.0_wp, samples%work)
        call solve_and_refine(track%beam, closed, samples%work, state, place)
        if (state /= band_ok) then
            call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that its state is not unique")
            call end_if_stopped(track%beam%watch, error)
        else if (.not. all(abs(samples%work%answers%deflection) <= huge(1.0_wp))) then
            call fatal_error(error, gapbeam_not_finite, "about position "//trim(shown(s))//" numbers left the range of "// &
                             "double precision: choose units in which lengths, stiffnesses and loads are nearer to 1")
        end if
    end subroutine solve_at

    !> Bounds of the fields in a cell on a stretch: along the cell at its beginning, and by how much they change at the samples; no
    !> polynomial leaves its samples by more than the Lebesgue constant of the sample points allows
    pure subroutine bound_fields(a, pieces, loads, low, high)
        !> Fields at the left ends, the cell, and its loads at the samples, shape (0:n)
        type(field_type), intent(in) :: a(0:)
        type(piece_type), intent(in) :: pieces(0:)
        type(piece_load_type), intent(in) :: loads(0:)
        !> Of the quantities of bending (gapbeam_quantities)
        real(wp), intent(out) :: low(bending_count), high(bending_count)
        type(field_type) :: end
        real(wp) :: length, change_of_length, q, change_of_q, curvature, moment, rotation, shear, change(state_count)
        real(wp), dimension(bending_count) :: deviation, first, last
        real(wp) :: share(state_count + 1, derived_count)

        length = maxval(pieces%length)
        change_of_length = maxval(abs(pieces%length - pieces(0)%length))
        q = max(maxval(abs(loads%qa)), maxval(abs(loads%qb)))
        change_of_q = max(maxval(abs(loads%qa - loads(0)%qa)), maxval(abs(loads%qb - loads(0)%qb)))
        end = fields_in_cell(a(0), pieces(0)%length, pieces(0), loads(0))
        associate (f => pieces(0)%flexibility, g => pieces(0)%shear_flexibility)
            shear = max(abs(a(0)%shear), abs(end%shear)) + length*q
            moment = max(abs(a(0)%moment), abs(end%moment)) + length**2*q
            curvature = f*moment + abs(loads(0)%kappa)
            rotation = max(abs(a(0)%rotation), abs(end%rotation)) + length*curvature
            deviation(1:state_count) = [length**2*(curvature + g*q)/8, length*curvature/2, length**2*q/8, length*q]
            change(4) = maxval(abs(a%shear - a(0)%shear)) + change_of_length*q + length*change_of_q
            change(3) = maxval(abs(a%moment - a(0)%moment)) + length*change(4) + change_of_length*shear
            change(2) = maxval(abs(a%rotation - a(0)%rotation)) + length*f*change(3) + change_of_length*curvature
            change(1) = maxval(abs(a%deflection - a(0)%deflection)) + length*(change(2) + g*change(4)) &
                + change_of_length*(rotation + g*shear)
        end associate
        deviation(1:state_count) = deviation(1:state_count) + lebesgue*change
        share(:, :) = shares_of(softness_of(pieces(0)))
        deviation(state_count + 1:) = matmul(deviation(1:state_count), abs(share(1:state_count, :)))
        first(:) = bending_values(a(0), pieces(0), loads(0)%kappa)
        last(:) = bending_values(end, pieces(0), loads(0)%kappa)
        high(:) = max(first, last) + deviation
        low(:) = min(first, last) - deviation
    end subroutine bound_fields

    !> Degree of a quantity of bending along the cells: one more from shear to moment to rotation; the deflection under shear has no
    !> more than that under bending
    pure function degree_along(quantity, loads) result(degree)
        integer, intent(in) :: quantity
        type(piece_load_type), intent(in) :: loads(:)
        integer :: degree
        logical :: is_term(state_count, derived_count)
        integer :: first

        first = quantity
        if (quantity > state_count) then
            is_term(:, :) = terms_of_derived()
            first = findloc(is_term(:, quantity - state_count), .true., 1)
        end if
        degree = 4 - first
        if (any(abs(loads%qb - loads%qa) > 0.0_wp)) then
            degree = degree + 2
        else if (any(max(abs(loads%qa), abs(loads%qb)) > 0.0_wp)) then
            degree = degree + 1
        end if
    end function degree_along

    !> Bernstein coefficients of a quantity of bending along a cell
    pure subroutine along_cell(quantity, degree, a, p, q, b)
        !> Its number among them; its degree
        integer, intent(in) :: quantity, degree
        !> Fields at the left end, the cell, and its load
        type(field_type), intent(in) :: a
        type(piece_type), intent(in) :: p
        type(piece_load_type), intent(in) :: q
        !> Shape (0:degree)
        real(wp), intent(out) :: b(0:)
        real(wp) :: c(0:most_along), weight
        integer :: i, k

        c(:) = powers_along(quantity, a, p, q)
        do i = 0, degree
            b(i) = 0.0_wp
            weight = 1.0_wp
            do k = 0, i
                b(i) = b(i) + weight*c(k)
                if (k < i) weight = weight*(i - k)/(degree - k)
            end do
        end do
    end subroutine along_cell

    !> Coefficients of a quantity of bending along a cell, of powers of the share of its length
    pure function powers_along(quantity, a, p, q) result(c)
        integer, intent(in) :: quantity
        !> As for along_cell
        type(field_type), intent(in) :: a
        type(piece_type), intent(in) :: p
        type(piece_load_type), intent(in) :: q
        real(wp) :: c(0:most_along), share(state_count + 1, derived_count)
        integer :: k

        if (quantity <= state_count) then
            c(:) = powers_of_state(quantity, a, p, q)
            return
        end if
        share(:, :) = shares_of(softness_of(p))
        c(:) = 0.0_wp
        c(0) = share(state_count + 1, quantity - state_count)*q%kappa
        do k = 1, state_count
            c(:) = c + share(k, quantity - state_count)*powers_of_state(k, a, p, q)
        end do
    end function powers_along

    !> Coefficients of deflection (1), rotation, moment or shear (4)
    pure function powers_of_state(field, a, p, q) result(c)
        integer, intent(in) :: field
        !> As for along_cell
        type(field_type), intent(in) :: a
        type(piece_type), intent(in) :: p
        type(piece_load_type), intent(in) :: q
        real(wp) :: c(0:most_along), slope

        slope = q%qb - q%qa
        c(:) = 0.0_wp
        associate (l => p%length, f => p%flexibility, g => p%shear_flexibility)
            select case (field)
            case (1)
                c(0) = a%deflection
                c(1) = l*(a%rotation + g*a%shear)
                c(2) = l**2*((q%kappa - f*a%moment)/2 - g*q%qa/2)
                c(3) = l**2*(-f*l*a%shear/6 - g*slope/6)
                c(4) = f*l**4*q%qa/24
                c(5) = f*l**4*slope/120
            case (2)
                c(0) = a%rotation
                c(1) = l*(q%kappa - f*a%moment)
                c(2) = -f*l**2*a%shear/2
                c(3) = f*l**3*q%qa/6
                c(4) = f*l**3*slope/24
            case (3)
                c(0:3) = [a%moment, l*a%shear, -l**2*q%qa/2, -l**2*slope/6]
            case default
                c(0:2) = [a%shear, -l*q%qa, -l*slope/2]
            end select
        end associate
    end function powers_of_state

end module gapbeam_train_samples
