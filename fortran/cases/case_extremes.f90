!> Largest and smallest values of the fields of many solved cases of a beam.
!> Eight side by side (files lane_*), from the solutions at the nodes: whatever solved them, and whatever the company of a case,
!> its digits are the same.
module gapbeam_case_extremes
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: most_unit_power
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_stopped
    use gapbeam_law, only: has_laws
    use gapbeam_units, only: moment_unit, rotation_unit, stiffness_unit, quantity_unit
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_solution, only: state_type
    use gapbeam_quantities, only: bending_count, bending
    use gapbeam_query, only: extremes_of_fields, fields_in_pieces
    use gapbeam_cases, only: case_loads_type
    use gapbeam_combinations, only: combination_type, varied_type, combine, solve_combination
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, pack_type, piece_pack_type, new_pack, new_piece_pack
    use gapbeam_cpu_dispatch, only: take_columns_at, take_numbers_at, extremes_of_pack_at, fields_of_pack_at, best_level
    use gapbeam_lane_pieces, only: prepare_pieces
    use gapbeam_lane_spans, only: span_room_type, prepare_spans, take_spans, make_pack_links
    use gapbeam_lane_model, only: prepare_lanes, take_supports, take_starts, units_of_supports
    implicit none
    private
    public :: has_lane_extremes, extremes_of_cases


contains

    !> Are the extremes of the cases of a beam found here: no ground, laws, axial system
    pure function has_lane_extremes(assembled) result(yes)
        type(assembled_type), intent(in) :: assembled
        logical :: yes

        associate (beam => assembled%beam, units => assembled%units)
            yes = .not. (allocated(beam%ground) .or. has_laws(beam%supports) .or. allocated(assembled%axial%point)) &
                .and. max(abs(units%deflection), abs(units%force), abs(units%length), abs(moment_unit(units)), &
                          abs(rotation_unit(units)), abs(stiffness_unit(units))) < most_unit_power
        end associate
    end function has_lane_extremes

    !> Find the extremes of solved cases of such a beam, and fields at places
    subroutine extremes_of_cases(assembled, loads, factors, values, spans, rule, closed, w, ml, mr, wanted, extremes, places, &
                                 piece, distance, fields, status, level)
        type(assembled_type), intent(in) :: assembled
        !> As for solve_in_lanes
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous :: factors(:, :), values(:, :, :)
        real(wp), intent(in) :: spans(:, :, :)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Solutions: contact states, deflections and moments as solve_in_lanes gives them
        integer, intent(in), contiguous :: closed(:, :)
        real(wp), intent(in), contiguous :: w(:, :), ml(:, :), mr(:, :)
        !> Which quantities of bending (gapbeam_quantities) are asked for
        logical, intent(in) :: wanted(bending_count)
        !> Maximum and minimum of those and their places, in the scene's units, shape (2, bending_count, ncase)
        real(wp), intent(inout) :: extremes(:, :, :), places(:, :, :)
        !> Places (piece, and distance from its left end in the scene's units), shape (n); there all of them, shape
        !> (bending_count, n, ncase)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        real(wp), intent(inout) :: fields(:, :, :)
        !> gapbeam_solved in where a case is solved; out an error where one is found, its values as they were
        integer, intent(inout) :: status(:)
        !> As for solve_in_lanes
        integer, intent(in), optional :: level
        type(lane_beam_type) :: beam
        type(lane_pieces_type) :: pieces
        type(pack_type) :: pack
        type(piece_pack_type) :: along
        type(span_room_type) :: span_room
        type(combination_type) :: combined
        integer, allocatable :: solved(:)
        real(wp), allocatable :: factors_of(:, :), at_places(:, :, :), turned(:, :)
        real(wp) :: found(lanes, 6, bending_count), poor(lanes)
        integer :: first, i, k, l, number, stat, at_level, case_of(lanes)
        logical :: lost, made, fits, outside(lanes)

        at_level = best_level()
        if (present(level)) at_level = level
        call prepare_lanes(assembled, loads, size(spans, 2) > 0, beam, made)
        if (made) call prepare_pieces(assembled, size(beam%links, 1), pieces, made)
        if (made .and. size(spans, 2) > 0) call prepare_spans(assembled, loads, span_room, made)
        if (made) call new_pack(beam, pack, made)
        if (made) call new_piece_pack(size(pieces%length), along, made)
        stat = 0
        if (made) allocate (solved(count(status == gapbeam_solved)), factors_of(lanes, size(factors, 1)), &
                            at_places(lanes, size(piece), bending_count), turned(lanes, 3*size(values, 2)), stat=stat)
        if (.not. made .or. stat /= 0) then
            status(:) = gapbeam_no_memory
            return
        end if
        number = 0
        do i = 1, size(status)
            if (status(i) /= gapbeam_solved) cycle
            number = number + 1
            solved(number) = i
        end do
        call take_supports(assembled, beam%place, pack)
        found(:, :, :) = 0.0_wp
        outside(:) = .false.
        do first = 1, number, lanes
            if (is_stopped(assembled%beam%watch)) exit
            ! The last lanes repeat the last case
            case_of = [(solved(min(first + l, number)), l=0, lanes - 1)]
            lost = .false.
            if (size(values, 2) > 0) then
                call take_numbers_at(at_level, beam, units_of_supports(assembled), values, case_of, turned, pack, lost)
            end if
            if (size(spans, 2) > 0) then
                do l = 1, lanes
                    call take_spans(spans(:, :, case_of(l)), l, span_room, outside(l))
                end do
                call make_pack_links(at_level, span_room, beam, pack)
                pieces%flexibility(:, :) = span_room%flexibility
                pieces%shear_flexibility(:, :) = span_room%shear_flexibility
            end if
            call take_columns_at(at_level, size(factors, 1), size(factors, 2), factors, case_of, factors_of)
            call take_columns_at(at_level, beam%n + 1, size(w, 2), w, case_of, pack%w)
            call take_columns_at(at_level, beam%n + 1, size(ml, 2), ml, case_of, pack%ml)
            call take_columns_at(at_level, beam%n + 1, size(mr, 2), mr, case_of, pack%mr)
            call take_starts(assembled, beam%place, closed, case_of, pack)
            pack%w(:, :) = scale(1.0_wp, -assembled%units%deflection)*pack%w
            pack%ml(:, :) = scale(1.0_wp, -moment_unit(assembled%units))*pack%ml
            pack%mr(:, :) = scale(1.0_wp, -moment_unit(assembled%units))*pack%mr
            poor(:) = 1.0_wp
            if (any(wanted) .and. .not. lost) then
                call extremes_of_pack_at(at_level, beam, pieces, wanted, factors_of, pack, along, found, poor)
            end if
            if (size(piece) > 0 .and. .not. lost) then
                call fields_of_pack_at(at_level, beam, pieces, factors_of, pack, along, piece, &
                                       scale(distance, -assembled%units%length), at_places, poor)
            end if
            do l = 1, min(lanes, number - first + 1)
                i = case_of(l)
                fits = poor(l) < 0.5_wp .and. .not. outside(l)
                if (fits) call give_extremes(assembled, wanted, found, l, extremes(:, :, i), places(:, :, i), fits)
                if (fits) call give_fields(assembled, at_places, l, fields(:, :, i), fits)
                if (.not. fits) call solve_alone(i)
            end do
        end do
        if (is_stopped(assembled%beam%watch)) status(:) = gapbeam_stopped

    contains

        !> Solve a case once more, whose fields are not to be had from its solution
        subroutine solve_alone(i)
            integer, intent(in) :: i
            type(state_type) :: state
            type(error_type), allocatable :: error
            real(wp) :: value(2, bending_count), x(2, bending_count), all_fields(bending_count, size(piece))
            real(wp), target :: own(3, size(values, 2)), own_spans(2, size(spans, 2))
            type(varied_type) :: varied

            if (size(own) > 0) then
                own(:, :) = values(:, :, i)
                varied%supports => own
            end if
            if (size(own_spans) > 0) then
                own_spans(:, :) = spans(:, :, i)
                varied%spans => own_spans
            end if
            associate (still => 0*assembled%model%supports%settlement, m => size(assembled%beam%supports))
                call combine(assembled, factors(:size(assembled%model%loads), i), still, combined, error, varied)
                if (.not. allocated(error)) then
                    call solve_combination(combined%assembled, rule, closed(:m, i) /= 0, state, error)
                end if
            end associate
            if (allocated(error)) then
                status(i) = error%code
                return
            end if
            status(i) = state%status
            if (state%status /= gapbeam_solved) return
            call extremes_of_fields(combined%assembled, state, bending, value, x, error)
            if (.not. allocated(error)) then
                call fields_in_pieces(combined%assembled, 1.0_wp, state%starts, state%displacement, state%tension, bending, &
                                      piece, distance, all_fields, error)
            end if
            if (allocated(error)) then
                status(i) = error%code
                return
            end if
            do k = 1, bending_count
                if (.not. wanted(k)) cycle
                extremes(:, k, i) = value(:, k)
                places(:, k, i) = x(:, k)
            end do
            fields(:, :, i) = all_fields
        end subroutine solve_alone

    end subroutine extremes_of_cases

    !> The extremes of a case in the scene's units, if these hold them
    pure subroutine give_extremes(assembled, wanted, found, l, extremes, places, made)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: wanted(bending_count)
        !> By extremes_of_pack, and the lane
        real(wp), intent(in) :: found(lanes, 6, bending_count)
        integer, intent(in) :: l
        real(wp), intent(inout) :: extremes(:, :), places(:, :)
        logical, intent(out) :: made
        real(wp) :: value
        integer :: powers(bending_count), i, k, piece

        powers = quantity_unit(assembled%units, bending)
        made = .true.
        do k = 1, bending_count
            if (.not. wanted(k)) cycle
            do i = 1, 2
                value = scale(found(l, 3*i - 2, k), powers(k))
                made = made .and. abs(value) <= huge(value)
                piece = int(found(l, 3*i - 1, k))
                extremes(i, k) = value
                places(i, k) = point_x(assembled, piece - 1) + scale(found(l, 3*i, k), assembled%units%length)
            end do
        end do
    end subroutine give_extremes

    !> Fields of a case at places likewise
    pure subroutine give_fields(assembled, found, l, fields, made)
        type(assembled_type), intent(in) :: assembled
        !> By fields_of_pack, and the lane
        real(wp), intent(in) :: found(:, :, :)
        integer, intent(in) :: l
        real(wp), intent(inout) :: fields(:, :)
        logical, intent(out) :: made
        integer :: powers(bending_count), i

        powers = quantity_unit(assembled%units, bending)
        do i = 1, size(fields, 2)
            fields(:, i) = scale(found(l, i, :), powers)
        end do
        made = all(abs(fields) <= huge(1.0_wp))
    end subroutine give_fields

end module gapbeam_case_extremes
