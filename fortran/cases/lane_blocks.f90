!> A beam, its supports and the starts of searches as columns of eight cases, for the files lane_*, and cases of it eight at a time,
!> taken from the columns of many into lanes. Values, extremes and certificates of cases begin here.
module gapbeam_lane_blocks
    use gapbeam_kinds, only: wp
    use gapbeam_units, only: moment_unit, stiffness_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_slight_supports, only: share_in_doubt, may_be_slight
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_cases, only: case_loads_type, leave_room
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, new_pack, link_bending, link_numbers, link_faa, link_fab, &
        link_fbb, link_sum_a, link_sum_b, link_determinant, link_fixity, link_reach
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_cpu_dispatch, only: compiled_at
    use gapbeam_lane_spans, only: span_room_type, prepare_spans, take_spans, proximal_weight_of
    use gapbeam_band, only: plain, hinge, restrained
    use gapbeam_model, only: softest
    use gapbeam_law, only: both, is_rigid
    use gapbeam_law_margins, only: may_change
    use gapbeam_tolerances, only: proximal_ratio
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

    !> What all cases have in common
    subroutine prepare_lanes(assembled, loads, with_own_spans, lane_beam, made)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        !> Has every case stiffnesses of its own
        logical, intent(in) :: with_own_spans
        type(lane_beam_type), intent(out) :: lane_beam
        !> False where memory ends
        logical, intent(out) :: made
        integer :: k, n, m, last, extent, stat

        extent = merge(lanes, 1, with_own_spans)
        n = size(assembled%beam%links)
        call find_places(assembled, lane_beam, made)
        if (made) call find_restraints(assembled, lane_beam, made)
        if (.not. made) return
        last = lane_beam%last_place(size(lane_beam%shared))
        m = size(loads%of_links)
        k = size(loads%of_nodes)
        lane_beam%n = n
        allocate (lane_beam%length(n), lane_beam%inverse(n), lane_beam%links(extent, link_numbers, n), &
                  lane_beam%proximal_weight(extent), lane_beam%side(0:last), lane_beam%there(0:n), lane_beam%changes(0:last), &
                  lane_beam%hinge(0:n), lane_beam%number(size(assembled%beam%supports)), lane_beam%link_load(m), &
                  lane_beam%link(m), lane_beam%to_link(extent, 6, m), lane_beam%node_load(k), lane_beam%node(k), &
                  lane_beam%to_node(2, k), stat=stat)
        made = stat == 0
        if (.not. made) return
        associate (to => lane_beam, from => assembled%beam%links)
            to%length(:) = from%length
            to%inverse(:) = from%inverse
            to%proximal_weight(:) = proximal_ratio*softest(assembled%beam)
            do k = 1, extent
                to%links(k, link_faa, :) = from%faa
                to%links(k, link_fab, :) = from%fab
                to%links(k, link_fbb, :) = from%fbb
                to%links(k, link_sum_a, :) = from%sum_a
                to%links(k, link_sum_b, :) = from%sum_b
                to%links(k, link_bending, :) = from%bending
                to%links(k, link_determinant, :) = from%determinant
                to%links(k, link_fixity, :) = 0.0_wp
                where (from%bending > 0.0_wp) to%links(k, link_fixity, :) = 1/from%bending
                to%links(k, link_reach, :) = max(from%bending, from%faa + from%fbb)*from%length
            end do
            to%side(:) = 0.0_wp
            to%there(:) = 0.0_wp
            to%changes(:) = 0.0_wp
            to%hinge(:) = merge(1.0_wp, 0.0_wp, assembled%beam%kind == hinge)
            to%is_plain = all(assembled%beam%kind(1:n - 1) == plain)
            to%number(:) = assembled%normal
            do k = 1, size(assembled%beam%supports)
                associate (s => assembled%beam%supports(k), i => to%place(k))
                    if (i <= n) to%there(i) = 1.0_wp
                    to%side(i) = s%side
                    if (may_change(s)) to%changes(i) = 1.0_wp
                end associate
            end do
            do k = 1, size(loads%of_links)
                associate (s => loads%of_links(k))
                    to%link_load(k) = s%load
                    to%link(k) = s%link
                    to%to_link(:, :, k) = spread([s%turn_a, s%turn_b, s%shear_a, s%shear_b, s%load_sum, s%turn_sum], 1, extent)
                end associate
            end do
            to%with_couples = any(abs(loads%of_nodes%couple) > 0.0_wp)
            do k = 1, size(loads%of_nodes)
                to%node_load(k) = loads%of_nodes(k)%load
                to%node(k) = loads%of_nodes(k)%node
                to%to_node(:, k) = [loads%of_nodes(k)%force, loads%of_nodes(k)%couple]
            end do
        end associate
    end subroutine prepare_lanes

    !> Rotational restraints
    pure subroutine find_restraints(assembled, lane_beam, made)
        type(assembled_type), intent(in) :: assembled
        type(lane_beam_type), intent(inout) :: lane_beam
        !> False where memory ends
        logical, intent(out) :: made
        integer :: i, m, n, stat

        associate (beam => assembled%beam)
            n = size(beam%links)
            m = count(beam%kind == restrained)
            allocate (lane_beam%restraint(0:n), lane_beam%restrained(m), lane_beam%compliance(m), stat=stat)
            made = stat == 0
            if (.not. made) return
            m = 0
            do i = 0, n
                lane_beam%restraint(i) = 0
                if (beam%kind(i) /= restrained) cycle
                m = m + 1
                lane_beam%restraint(i) = m
                lane_beam%restrained(m) = i
                lane_beam%compliance(m) = beam%compliance(i)
            end do
        end associate
    end subroutine find_restraints

    !> Places of the supports in arrays of them
    pure subroutine find_places(assembled, lane_beam, made)
        type(assembled_type), intent(in) :: assembled
        type(lane_beam_type), intent(inout) :: lane_beam
        !> False where memory ends
        logical, intent(out) :: made
        integer :: i, j, m, n, stat

        associate (beam => assembled%beam)
            n = size(beam%links)
            m = count(beam%first(1:n + 1) - beam%first(0:n) > 1)
            allocate (lane_beam%place(size(beam%supports)), lane_beam%shared(m), lane_beam%last_place(0:m), stat=stat)
            made = stat == 0
            if (.not. made) return
            m = 0
            lane_beam%last_place(0) = n
            do i = 0, n
                associate (there => beam%order(beam%first(i):beam%first(i + 1) - 1))
                    lane_beam%place(there) = i
                    if (size(there) < 2) cycle
                    m = m + 1
                    lane_beam%shared(m) = i
                    lane_beam%last_place(m) = lane_beam%last_place(m - 1) + size(there)
                    lane_beam%place(there) = [(lane_beam%last_place(m - 1) + j, j=1, size(there))]
                end associate
            end do
        end associate
    end subroutine find_places

    !> The supports as they are in all cases, open
    pure subroutine take_supports(assembled, place, pack)
        type(assembled_type), intent(in) :: assembled
        !> Their places (lane_beam_type)
        integer, intent(in), contiguous :: place(:)
        type(pack_type), intent(inout) :: pack
        integer :: k

        pack%stiffness(:, :) = 0.0_wp
        pack%rigid(:, :) = 0.0_wp
        pack%contact(:, :) = 0.0_wp
        pack%closed(:, :) = 0.0_wp
        do k = 1, size(assembled%beam%supports)
            associate (s => assembled%beam%supports(k), i => place(k))
                pack%contact(:, i) = s%contact
                if (is_rigid(s)) then
                    pack%rigid(:, i) = 1.0_wp
                else
                    pack%stiffness(:, i) = s%stiffness
                end if
            end associate
        end do
    end subroutine take_supports

    !> What levels and stiffnesses of supports are multiplied by in the engine's units, and of these stiffnesses that below which a
    !> support may be next to nothing
    pure function units_of_supports(assembled) result(units)
        type(assembled_type), intent(in) :: assembled
        real(wp) :: units(3)

        units(:2) = scale(1.0_wp, [-assembled%units%deflection, -stiffness_unit(assembled%units)])
        units(3) = may_be_slight(assembled)
    end function units_of_supports

    !> Where the searches of cases start
    pure subroutine take_starts(assembled, place, closed, case_of, pack)
        type(assembled_type), intent(in) :: assembled
        !> As for take_supports
        integer, intent(in), contiguous :: place(:)
        !> As in case_solutions_type, and the case of every lane
        integer, intent(in), contiguous :: closed(:, :)
        integer, intent(in) :: case_of(lanes)
        !> Open where there is no support
        type(pack_type), intent(inout) :: pack
        integer :: k, l

        do k = 1, size(assembled%beam%supports)
            associate (s => assembled%beam%supports(k))
                do l = 1, lanes
                    pack%closed(l, place(k)) = merge(1.0_wp, 0.0_wp, closed(k, case_of(l)) /= 0 .or. s%side == both)
                end do
            end associate
        end do
    end subroutine take_starts

end module gapbeam_lane_blocks
