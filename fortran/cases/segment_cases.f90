!> Cases of a long beam one by one, each in eight segments side by side (fortran/cases, files lane_*).
!> The beam is such as fits. What comes out has the digits of solve_case of gapbeam_cases, which takes the other beams, and the
!> cases that are doubtful here
module gapbeam_segment_cases
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: least_segment_links
    use gapbeam_watch, only: is_stopped
    use gapbeam_band, only: plain
    use gapbeam_law, only: both
    use gapbeam_law_margins, only: may_change
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_units, only: support_in_units
    use gapbeam_slight_supports, only: may_be_slight
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_cases, only: case_loads_type, give_case
    use gapbeam_lane_types, only: lanes
    use gapbeam_lane_cases, only: fits_side_by_side
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type, new_segments, node_of
    use gapbeam_lane_compiled, only: compiled_type
    use gapbeam_cpu_dispatch, only: compiled_at
    implicit none
    private
    public :: segments_type, fits_segments, solve_in_segments

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: segments_type
        logical :: made = .false.
        !> Instructions (gapbeam_cpu_dispatch), 0: the best that there are; and what is compiled for them
        integer :: level = 0
        type(compiled_type) :: compiled
        !> Are the supports in room those of the beam
        logical :: with_own_supports = .false.
        type(segment_beam_type) :: beam
        type(segment_room_type) :: room
    end type segments_type

contains

    !> Is a beam such: long, without hinges and restraints, one support at a node
    pure function fits_segments(assembled) result(fits)
        type(assembled_type), intent(in) :: assembled
        logical :: fits

        associate (beam => assembled%beam, n => size(assembled%beam%links))
            fits = n >= least_segment_links
            if (fits) fits = fits_side_by_side(assembled)
            if (fits) fits = all(beam%kind == plain) .and. all(beam%first(1:n + 1) - beam%first(0:n) <= 1)
        end associate
    end function fits_segments

    !> Solve cases of a beam that fits
    subroutine solve_in_segments(assembled, loads, numbers, which, segments, solutions, done)
        type(assembled_type), intent(in) :: assembled
        !> As for solve_in_lanes of gapbeam_lane_cases
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        integer, intent(in) :: which(:)
        !> Empty, or of earlier cases of this beam
        type(segments_type), intent(inout) :: segments
        !> As for solve_in_lanes
        type(case_solutions_type), intent(inout) :: solutions
        logical, intent(inout) :: done(:)
        real(wp) :: units(3), largest
        integer :: i, j, k
        logical :: lost, couples, doubtful, with_own_supports

        if (.not. segments%made) call make_segments(assembled, segments)
        if (.not. segments%made) return
        units = scale(1.0_wp, [assembled%units%deflection, moment_unit(assembled%units), assembled%units%force])
        with_own_supports = .not. associated(numbers%supports)
        associate (room => segments%room)
            if (with_own_supports .and. .not. segments%with_own_supports) call take_supports(assembled, room, lost)
            segments%with_own_supports = with_own_supports
            do j = 1, size(which)
                i = which(j)
                if (is_stopped(assembled%beam%watch)) exit
                lost = .false.
                if (.not. with_own_supports) call take_supports(assembled, room, lost, numbers%supports(:, :, i))
                if (lost) cycle
                call add_loads(loads, numbers%factors(:, i), segments%beam%n, room, couples)
                if (couples) cycle
                do k = 1, size(assembled%beam%supports)
                    associate (s => assembled%beam%supports(k))
                        room%closed(s%node) = merge(1.0_wp, 0.0_wp, solutions%closed(k, i) /= 0 .or. s%side == both)
                    end associate
                end do
                call segments%compiled%solve_long_beam(segments%beam, room, solutions%solves(i), doubtful)
                if (.not. doubtful) call segments%compiled%audit_long_beam(segments%beam, room, doubtful)
                if (doubtful) cycle
                largest = max(maxval(abs(room%w)), maxval(abs(room%m)), maxval(abs(room%reaction)))
                done(i) = largest <= huge(1.0_wp)/max(maxval(units), 1.0_wp)
                if (.not. done(i)) cycle
                call give_case(units, assembled%beam%supports%node, i, room%closed, room%w, room%m, room%m, room%reaction, &
                               solutions)
                ! Beyond the ends there is no moment
                if (associated(solutions%ml)) solutions%ml(1, i) = 0.0_wp
                if (associated(solutions%mr)) solutions%mr(size(solutions%mr, 1), i) = 0.0_wp
            end do
        end associate
    end subroutine solve_in_segments

    !> Cut the beam
    subroutine make_segments(assembled, segments)
        type(assembled_type), intent(in) :: assembled
        type(segments_type), intent(inout) :: segments
        integer :: k, l, s, i, step, begin

        segments%compiled = compiled_at(segments%level, .false.)
        call new_segments(size(assembled%beam%links), segments%beam, segments%room, segments%made)
        if (.not. segments%made) return
        associate (to => segments%beam, from => assembled%beam%links)
            to%length(:) = from%length
            to%inverse(:) = from%inverse
            to%faa(:) = from%faa
            to%fab(:) = from%fab
            to%fbb(:) = from%fbb
            to%fixity(:) = 0.0_wp
            where (from%bending > 0.0_wp) to%fixity = 1/from%bending
            to%reach(:) = max(from%bending, from%faa + from%fbb)*from%length
            to%side(:) = 0.0_wp
            to%changing(:) = 0.0_wp
            to%there(:) = 0.0_wp
            do k = 1, size(assembled%beam%supports)
                associate (s => assembled%beam%supports(k))
                    to%there(s%node) = 1.0_wp
                    to%side(s%node) = s%side
                    if (may_change(s)) to%changing(s%node) = s%side
                end associate
            end do
            do l = 1, lanes
                call node_of(to, l, i, step, begin)
                do s = begin, to%columns
                    ! Inward is to the right in the left half
                    associate (link => from(i + (s - 1)*step + merge(1, 0, step == 1)))
                        to%link(l, 1, s) = link%inverse
                        to%link(l, 2, s) = merge(link%faa, link%fbb, step == 1)
                        to%link(l, 3, s) = merge(link%fbb, link%faa, step == 1)
                        to%link(l, 4, s) = link%fab
                        to%link(l, 5, s) = merge(link%sum_a, link%sum_b, step == 1)
                        to%link(l, 6, s) = merge(link%sum_b, link%sum_a, step == 1)
                        to%link(l, 7, s) = link%bending
                        to%link(l, 8, s) = link%determinant
                    end associate
                end do
            end do
            do l = 2, lanes
                if (l /= lanes/2 + 1) to%link(l, :, 0) = to%link(l - 1, :, to%columns)
            end do
        end associate
    end subroutine make_segments

    !> The loads of a case, as solve_case of gapbeam_cases and set_loads of gapbeam_workspace add them up
    pure subroutine add_loads(loads, factors, n, room, couples)
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in) :: factors(:)
        !> Links
        integer, intent(in) :: n
        type(segment_room_type), intent(inout) :: room
        !> Is there a couple at a node
        logical, intent(out) :: couples
        integer :: k

        couples = .false.
        room%by_node(:, 1:4) = 0.0_wp
        room%left(:) = 0.0_wp
        room%right(:) = 0.0_wp
        room%turn_size(:) = 0.0_wp
        ! Forces at nodes; shears of the links at both ends and sums of absolute values
        associate (force => room%by_node(:, 1), shear_a => room%by_node(:, 2), shear_b => room%by_node(:, 3), &
                   total => room%by_node(:, 4))
            do k = 1, size(loads%of_links)
                associate (s => loads%of_links(k), factor => factors(loads%of_links(k)%load), i => loads%of_links(k)%link + 1)
                    room%right(i - 2) = room%right(i - 2) + factor*s%turn_a
                    room%left(i - 1) = room%left(i - 1) + factor*s%turn_b
                    shear_a(i) = shear_a(i) + factor*s%shear_a
                    shear_b(i) = shear_b(i) + factor*s%shear_b
                    total(i) = total(i) + abs(factor)*s%load_sum
                    room%turn_size(i - 1) = room%turn_size(i - 1) + abs(factor)*s%turn_sum
                end associate
            end do
            do k = 1, size(loads%of_nodes)
                associate (s => loads%of_nodes(k), factor => factors(loads%of_nodes(k)%load), i => loads%of_nodes(k)%node)
                    force(i + 1) = force(i + 1) + factor*s%force
                    couples = couples .or. abs(factor*s%couple) > 0.0_wp
                end associate
            end do
            room%shear(0:n) = force(1:n + 1) - shear_b(1:n + 1)
            room%load_size(0:n) = abs(force(1:n + 1)) + total(1:n + 1)
            room%shear(0:n - 1) = room%shear(0:n - 1) + shear_a(2:n + 1)
            room%load_size(0:n - 1) = room%load_size(0:n - 1) + total(2:n + 1)
        end associate
    end subroutine add_loads

    !> The supports of the beam, or those of a case (replace_supports of gapbeam_cases)
    pure subroutine take_supports(assembled, room, lost, values)
        type(assembled_type), intent(in) :: assembled
        type(segment_room_type), intent(inout) :: room
        !> Is a number out of range, or may a support be next to nothing
        logical, intent(out) :: lost
        !> As in case_numbers_type
        real(wp), intent(in), optional :: values(:, :)
        real(wp) :: stiffness, least
        integer :: k
        logical :: lost_stiffness, lost_level

        lost = .false.
        least = may_be_slight(assembled)
        room%stiffness(:) = 0.0_wp
        room%rigid(:) = 0.0_wp
        room%contact(:) = 0.0_wp
        room%closed(:) = 0.0_wp
        do k = 1, size(assembled%beam%supports)
            associate (s => assembled%beam%supports(k), i => assembled%beam%supports(k)%node)
                stiffness = s%stiffness
                room%contact(i) = s%contact
                if (present(values)) then
                    associate (given => values(:, assembled%normal(k)))
                        call support_in_units(given(3), given(1) + s%side*given(2), assembled%units%deflection, &
                                              assembled%units%force, stiffness, room%contact(i), lost_stiffness, lost_level)
                        lost = lost .or. lost_stiffness .or. lost_level .or. stiffness > 0.0_wp .and. stiffness < least
                    end associate
                end if
                if (stiffness > huge(1.0_wp)) then
                    room%rigid(i) = 1.0_wp
                else
                    room%stiffness(i) = stiffness
                end if
            end associate
        end do
    end subroutine take_supports

end module gapbeam_segment_cases
