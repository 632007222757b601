!> Influence lines of a beam in one contact state.
module gapbeam_train_influence
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_not_converged
    use gapbeam_band, only: band_ok
    use gapbeam_element, only: field_type
    use gapbeam_law_adapters, only: drop_level
    use gapbeam_link, only: piece_load_type
    use gapbeam_model, only: drop_loads
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_and_refine
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: bending_count, bending, of_moment, of_shear
    use gapbeam_units, only: quantity_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: train_type, track_type, uniform_type
    use gapbeam_train_intervals, only: interval_type, find_intervals, enter_interval
    use gapbeam_train_loads, only: place_train
    use gapbeam_train_cells, only: cells_type, new_cells, find_cells, fill_cells, recover_cells, cell_ends, cell_of_place, &
        fields_in_cell
    implicit none
    private
    public :: find_influence

contains

    !> Influence line of a scheme: what a unit force at each place adds, while the same supports act
    subroutine find_influence(assembled, track, closed, support, piece, distance, places, value, error)
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        !> The scheme
        logical, intent(in) :: closed(:)
        !> Which supports of the model, shape (nsupport)
        logical, intent(in) :: support(:)
        !> A place of the beam: piece, and distance from its left end in the user's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        !> Places of the force, shape (n)
        real(wp), intent(in) :: places(:)
        !> The quantities of bending (gapbeam_quantities) at the place, and the sums of the reactions (up) and of the couples
        !> (clockwise) of the supports, in the user's units, shape (bending_count + 2, n)
        real(wp), intent(out) :: value(:, :)
        !> No unique state, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(track_type) :: bare
        type(uniform_type) :: none(0)
        type(cells_type) :: cells
        type(assembled_type) :: empty
        type(interval_type), allocatable :: intervals(:)
        type(interval_type) :: interval
        type(workspace_type) :: work
        type(field_type) :: at
        real(wp) :: left, right
        integer :: powers(bending_count), c, j, k, state, place, stat

        bare = track
        empty = assembled
        empty%dead(:) = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        empty%live(:) = empty%dead
        call drop_level(bare%beam%supports)
        call drop_loads(bare%beam, 1)
        call drop_loads(bare%beam, 2)
        bare%loaded = 0
        bare%is_loaded(:) = .false.
        bare%train = train_type([0.0_wp], [1.0_wp], none)
        call new_workspace(bare%beam, work)
        call new_cells(bare, cells, stat)
        if (failed(stat, error)) return
        powers(:) = quantity_unit(assembled%units, bending)
        do k = 1, size(places)
            call find_intervals(bare, places(k), places(k), intervals, error)
            if (allocated(error)) return
            call enter_interval(bare, intervals(1), interval)
            call place_train(bare, interval, places(k))
            call set_loads(bare%beam, 1.0_wp, work)
            call solve_and_refine(bare%beam, closed, work, state, place)
            if (state /= band_ok) then
                call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that its state is not unique")
                call end_if_stopped(bare%beam%watch, error)
                return
            end if
            call find_cells(bare, interval, cells)
            call fill_cells(empty, bare, places(k), cells)
            call recover_cells(bare, work, cells)
            c = cell_of_place(bare, cells, piece, track%x(piece - 1) + distance, places(k))
            call cell_ends(bare, cells, cells%cells(c), places(k), left, right)
            at = fields_in_cell(cells%starts(c), scale(max(0.0_wp, track%x(piece - 1) + distance - left), -track%length_unit), &
                                cells%pieces(c), cells%loads(c))
            value(:, k) = [scale(bending_values(at, cells%pieces(c), cells%loads(c)%kappa), powers), 0.0_wp, 0.0_wp]
            associate (sum_of_reactions => value(bending_count + 1, k), sum_of_couples => value(bending_count + 2, k))
                do j = 1, size(closed)
                    if (.not. support(assembled%normal(j))) cycle
                    sum_of_reactions = sum_of_reactions + scale(work%reaction(j), powers(of_shear))
                end do
                do j = 1, size(support)
                    if (.not. (support(j) .and. assembled%couple_share(j) > 0.0_wp)) cycle
                    associate (node => work%answers(assembled%node_of_point(assembled%support_point(j))))
                        sum_of_couples = sum_of_couples + scale((node%moment_right - node%moment_left)*assembled%couple_share(j), &
                                                                powers(of_moment))
                    end associate
                end do
            end associate
        end do
    end subroutine find_influence

end module gapbeam_train_influence
