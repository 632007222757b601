!> Eight cases of a beam at a time, taken from the columns of many into lanes.
!> Values, extremes and certificates of cases begin here.
module gapbeam_lane_blocks
    use gapbeam_kinds, only: wp
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_slight_supports, only: share_in_doubt
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_cases, only: case_loads_type, leave_room
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, new_pack, link_bending
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_cpu_dispatch, only: compiled_at
    use gapbeam_lane_spans, only: span_room_type, prepare_spans, take_spans, proximal_weight_of
    use gapbeam_lane_model, only: prepare_lanes, take_supports, take_starts, units_of_supports
    implicit none
    private
    public :: block_type, make_block, take_cases, take_solutions

    !> Whose supports a pack has
    integer, parameter :: of_none = 0, of_beam = 1, of_cases = 2

    !> Eight cases of one beam, with room for them that is kept from call to call; calls at the same time need one each
    type :: block_type
        logical :: made = .false.
        !> Instructions (gapbeam_cpu_dispatch), 0: the best that there are; and what is compiled for them
        integer :: level = 0
        type(compiled_type) :: compiled
        type(lane_beam_type) :: beam
        type(pack_type) :: pack
        !> Which case is in which lane, the last one in all that are left; how many these are
        integer :: case_of(lanes) = 0, cases = 0
        integer :: supports = of_none
        !> Factor of every load, shape (lanes, nload)
        real(wp), allocatable :: factors(:, :)
        !> Room for columns that are turned
        real(wp), allocatable :: turned(:, :)
        !> Where every case has stiffnesses of its own
        type(span_room_type) :: spans
    end type block_type

contains

    !> Make a block for cases of a beam that lanes hold, unless it is made
    subroutine make_block(assembled, loads, numbers, block)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads
        type(case_loads_type), intent(in) :: loads
        !> In every call for the beam as many factors, and spans in all or in none
        type(case_numbers_type), intent(in) :: numbers
        !> Not made where memory ends
        type(block_type), intent(inout) :: block
        integer :: stat
        logical :: with_own_spans

        if (block%made) return
        with_own_spans = associated(numbers%spans)
        block%compiled = compiled_at(block%level, with_own_spans)
        call prepare_lanes(assembled, loads, with_own_spans, block%beam, block%made)
        if (block%made .and. with_own_spans) call prepare_spans(assembled, loads, block%spans, block%made)
        if (block%made) call new_pack(block%beam, block%pack, block%made)
        if (.not. block%made) return
        allocate (block%factors(lanes, size(numbers%factors, 1)), &
                  block%turned(lanes, max(3*size(assembled%model%supports) + 3, size(assembled%beam%supports))), stat=stat)
        block%made = stat == 0
    end subroutine make_block

    !> Take the next cases
    subroutine take_cases(assembled, numbers, closed, which, block, fits)
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        !> Their contact states, or starts of the search (case_solutions_type)
        integer, intent(in), contiguous :: closed(:, :)
        !> All that are left, at least one; the first eight are taken
        integer, intent(in) :: which(:)
        !> Made
        type(block_type), intent(inout) :: block
        !> Which of them lanes hold
        logical, intent(out) :: fits(lanes)
        logical :: lost, outside
        integer :: l

        block%cases = min(lanes, size(which))
        block%case_of = which([(min(l, block%cases), l=1, lanes)])
        fits(:) = .true.
        associate (case_of => block%case_of, pack => block%pack)
            call block%compiled%take_columns(size(numbers%factors, 1), size(numbers%factors, 2), numbers%factors, case_of, &
                                             block%factors)
            if (associated(numbers%supports)) then
                if (block%supports == of_none) call take_supports(assembled, block%beam%place, pack)
                block%supports = of_cases
                call block%compiled%take_numbers(block%beam, units_of_supports(assembled), numbers%supports, case_of, &
                                                 block%turned, pack, lost)
                do l = 1, merge(lanes, 0, size(block%beam%shared) > 0)
                    if (.not. lost) lost = .not. leave_room(assembled, numbers%supports(:, :, case_of(l)))
                end do
                fits(:) = .not. lost
                if (lost) return
            else
                if (block%supports /= of_beam) call take_supports(assembled, block%beam%place, pack)
                block%supports = of_beam
            end if
            if (associated(numbers%spans)) then
                do l = 1, lanes
                    call take_spans(numbers%spans(:, :, case_of(l)), l, block%spans, outside)
                    fits(l) = .not. outside
                end do
                call make_pack_links(block)
                do l = 1, lanes
                    fits(l) = fits(l) .and. .not. has_slight(block%beam, pack, l)
                end do
            end if
            call take_starts(assembled, block%beam%place, closed, case_of, pack)
        end associate
    end subroutine take_cases

    !> May springs or restraints be next to nothing beside the spans of a case
    pure function has_slight(beam, pack, l) result(has)
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(in) :: pack
        !> The lane
        integer, intent(in) :: l
        logical :: has
        real(wp) :: bent

        bent = sum(pack%links(l, link_bending, :))/share_in_doubt
        has = any(beam%compliance > bent) &
            .or. any(pack%stiffness(l, :) > 0.0_wp .and. pack%stiffness(l, :)*bent*sum(beam%length)**2 < 1.0_wp)
    end function has_slight

    !> Make the links of eight cases whose stiffnesses have been taken
    subroutine make_pack_links(block)
        type(block_type), intent(inout) :: block
        integer :: l

        associate (room => block%spans, beam => block%beam, links => block%pack%links)
            call block%compiled%make_links(room%spans, beam%length, room%stiffness, room%flexibility, room%shear_flexibility, &
                                           links, beam%to_link)
            do l = 1, lanes
                beam%proximal_weight(l) = proximal_weight_of(room%spans%softest, sum(links(l, link_bending, :)), &
                                                             sum(beam%length), beam%n)
            end do
        end associate
    end subroutine make_pack_links

    !> Take the solutions of the cases that have been taken
    pure subroutine take_solutions(assembled, solutions, block)
        type(assembled_type), intent(in) :: assembled
        !> Deflections, moments, and reactions if there are any
        type(case_solutions_type), intent(in) :: solutions
        type(block_type), intent(inout) :: block
        integer :: k, rows

        rows = block%beam%n + 1
        associate (pack => block%pack, units => assembled%units, case_of => block%case_of, cases => size(solutions%w, 2))
            call block%compiled%take_columns(rows, cases, solutions%w, case_of, pack%w)
            call block%compiled%take_columns(rows, cases, solutions%ml, case_of, pack%ml)
            call block%compiled%take_columns(rows, cases, solutions%mr, case_of, pack%mr)
            pack%w(:, :) = scale(1.0_wp, -units%deflection)*pack%w
            pack%ml(:, :) = scale(1.0_wp, -moment_unit(units))*pack%ml
            pack%mr(:, :) = scale(1.0_wp, -moment_unit(units))*pack%mr
            if (.not. associated(solutions%reaction)) return
            pack%reaction(:, :) = 0.0_wp
            do k = 1, size(block%beam%place)
                pack%reaction(:, block%beam%place(k)) = scale(1.0_wp, -units%force)*solutions%reaction(k, case_of)
            end do
        end associate
    end subroutine take_solutions

end module gapbeam_lane_blocks
