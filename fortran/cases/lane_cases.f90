!> Many cases of a beam solved eight side by side (fortran/cases, files lane_*).
!> The beam is one that lanes hold. What comes out has the digits of solve_case of gapbeam_cases, which takes the other beams, and
!> the cases that are doubtful here
module gapbeam_lane_cases
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_lane_links
    use gapbeam_tolerances, only: most_unit_power
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type
    use gapbeam_law, only: has_laws
    use gapbeam_units, only: moment_unit, stiffness_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_cases, only: case_loads_type, split_loads, leave_room, give_case
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, new_pack
    use gapbeam_cpu_dispatch, only: take_columns_at, take_numbers_at, give_pack_at, search_pack_at, finish_pack_at, &
        audit_pack_at, best_level
    use gapbeam_lane_spans, only: span_room_type, prepare_spans, take_spans, make_pack_links
    use gapbeam_lane_model, only: prepare_lanes, take_supports, take_starts, units_of_supports
    implicit none
    private
    public :: lane_room_type, fits_lanes, solve_in_lanes, find_contact_states

    !> Ways in which schemes are solved
    integer, parameter :: ways = 3

    !> Cases that wait until eight are to be solved in the same way
    type :: queue_type
        type(pack_type) :: pack
        integer :: waiting = 0, case_of(lanes) = 0
    end type queue_type

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: lane_room_type
        logical :: made = .false.
        !> Has every case the supports of the beam in the pack
        logical :: with_own_supports = .false.
        type(lane_beam_type) :: beam
        type(pack_type) :: pack
        type(queue_type) :: queues(ways)
        !> Factor of every load, shape (lanes, nload)
        real(wp), allocatable :: factors(:, :)
        !> Room for columns that are turned
        real(wp), allocatable :: turned(:, :)
        !> Where every case has stiffnesses of its own
        type(span_room_type) :: spans
    end type lane_room_type

contains

    !> Do lanes hold a beam: several links that bend, no ground and laws
    pure function fits_lanes(assembled) result(fits)
        type(assembled_type), intent(in) :: assembled
        logical :: fits
        integer :: n

        associate (beam => assembled%beam, units => assembled%units)
            n = size(beam%links)
            fits = n > 1 .and. n <= most_lane_links .and. .not. allocated(beam%ground)
            if (.not. fits) return
            fits = all(beam%links%faa > 0.0_wp .and. beam%links%fbb > 0.0_wp) .and. .not. has_laws(beam%supports) &
                .and. max(abs(units%deflection), abs(units%force), abs(moment_unit(units)), abs(stiffness_unit(units))) &
                < most_unit_power
        end associate
    end function fits_lanes

    !> Solve cases of a beam that fits
    subroutine solve_in_lanes(assembled, loads, factors, values, spans, room, closed, w, ml, mr, reaction, solves, done, level)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads, and the factor of every load, shape (at least nload, ncase)
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Settlement, gap and stiffness of every support of the scene, shape (3, at least nsupport, ncase); nsupport 0: their own
        real(wp), intent(in), contiguous :: values(:, :, :)
        !> EI and GA of every span, shape (2, nspan, ncase); nspan 0: their own
        real(wp), intent(in) :: spans(:, :, :)
        !> Empty, or of earlier cases of this beam, with stiffnesses of their own or without as these are
        type(lane_room_type), intent(inout) :: room
        !> Starts in, contact states out, where a case is done; 1 closed, shape (at least size(beam%supports), ncase)
        integer, intent(inout), contiguous :: closed(:, :)
        !> In the scene's units: deflections, moments left and right of the nodes, shape (n + 1, ncase); reactions, shape (at least
        !> size(beam%supports), ncase). Not wanted: without rows
        real(wp), intent(inout), contiguous :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        integer, intent(inout) :: solves(:)
        !> Which cases are done; the others are as they were
        logical, intent(out) :: done(:)
        !> Instructions (gapbeam_cpu_dispatch); default the best that there are
        integer, intent(in), optional :: level
        real(wp) :: units(3)
        integer :: first, l, kind, solves_of(lanes), method(lanes), case_of(lanes), at_level
        logical :: lost, made, outside(lanes)

        done(:) = .false.
        at_level = best_level()
        if (present(level)) at_level = level
        ! As many factors in every call for the beam
        if (.not. room%made) call make_room(assembled, loads, size(factors, 1), size(spans, 2) > 0, room)
        if (.not. room%made) return
        if (size(values, 2) > 0) room%with_own_supports = .false.
        if (.not. room%with_own_supports) call take_supports(assembled, room%beam%place, room%pack)
        room%with_own_supports = size(values, 2) == 0
        outside(:) = .false.
        units = scale(1.0_wp, [assembled%units%deflection, moment_unit(assembled%units), assembled%units%force])
        do first = 1, size(done), lanes
            if (is_stopped(assembled%beam%watch)) exit
            ! The last lanes repeat the last case
            case_of = [(min(first + l, size(done)), l=0, lanes - 1)]
            call take_columns_at(at_level, size(factors, 1), size(factors, 2), factors, case_of, room%factors)
            if (size(values, 2) > 0) then
                call take_numbers_at(at_level, room%beam, units_of_supports(assembled), values, case_of, room%turned, room%pack, &
                                     lost)
                do l = 1, merge(lanes, 0, size(room%beam%shared) > 0)
                    if (.not. lost) lost = .not. leave_room(assembled, values(:, :, case_of(l)))
                end do
                if (lost) cycle
            end if
            if (size(spans, 2) > 0) then
                do l = 1, lanes
                    call take_spans(spans(:, :, case_of(l)), l, room%spans, outside(l))
                end do
                call make_pack_links(at_level, room%spans, room%beam, room%pack)
            end if
            call take_starts(assembled, room%beam%place, closed, case_of, room%pack)
            call search_pack_at(at_level, room%beam, room%factors, room%pack, solves_of, method)
            where (outside) method = 0
            solves(case_of) = solves_of
            kind = method(1)
            if (kind > 0 .and. all(method == kind)) then
                call finish(kind, case_of, room%pack)
            else
                do l = 1, min(lanes, size(done) - first + 1)
                    if (method(l) == 0) cycle
                    associate (queue => room%queues(method(l)))
                        if (.not. allocated(queue%pack%left)) then
                            call new_pack(room%beam, queue%pack, made)
                            if (.not. made .and. allocated(queue%pack%left)) deallocate (queue%pack%left)
                            if (.not. made) exit
                        end if
                        queue%waiting = queue%waiting + 1
                        queue%case_of(queue%waiting) = case_of(l)
                        call take_lane(room%pack, l, queue%pack, queue%waiting)
                        if (queue%waiting < lanes) cycle
                        queue%waiting = 0
                        call finish(method(l), queue%case_of, queue%pack)
                    end associate
                end do
            end if
        end do
        do kind = 1, ways
            associate (queue => room%queues(kind))
                if (queue%waiting == 0) cycle
                ! The last lanes repeat the first case
                do l = 1, lanes
                    first = merge(l, 1, l <= queue%waiting)
                    case_of(l) = queue%case_of(first)
                    call take_lane(queue%pack, first, room%pack, l)
                end do
                queue%waiting = 0
                room%pack%is_solved = .false.
                call finish(kind, case_of, room%pack)
            end associate
        end do

    contains

        !> Solve eight schemes that are solved in the same way
        subroutine finish(way, numbers, schemes)
            integer, intent(in) :: way, numbers(lanes)
            type(pack_type), intent(inout) :: schemes
            real(wp) :: most, largest(lanes)
            logical :: doubtful(lanes), wrong(lanes)
            integer :: k

            call finish_pack_at(at_level, room%beam, way, schemes, doubtful)
            call audit_pack_at(at_level, room%beam, schemes, wrong)
            doubtful = doubtful .or. wrong
            most = maxval(units)
            if (most > 1.0_wp) then
                largest(:) = largest_values(schemes%w, schemes%ml, schemes%mr, schemes%reaction)
                doubtful = doubtful .or. .not. largest <= huge(1.0_wp)/most
            end if
            if (.not. any(doubtful) .and. all(numbers(lanes) /= numbers([1, lanes - 1]))) then   ! no case is repeated
                done(numbers) = .true.
                call give_pack_at(at_level, room%beam, units, schemes, numbers, room%turned, closed, w, ml, mr, reaction)
                return
            end if
            do k = 1, lanes
                if (doubtful(k) .or. (k > 1 .and. numbers(k) == numbers(max(k - 1, 1)))) cycle
                associate (i => numbers(k))
                    done(i) = .true.
                    call give_case(units, room%beam%place, schemes%closed(k, :), schemes%w(k, :), schemes%ml(k, :), &
                                   schemes%mr(k, :), schemes%reaction(k, :), closed(:, i), w(:, i), ml(:, i), mr(:, i), &
                                   reaction(:, i))
                end associate
            end do
        end subroutine finish

    end subroutine solve_in_lanes

    !> Find the contact states of many combinations (gapbeam_combinations) of a beam that fits. Those that are doubtful are left to
    !> their own searches, with the start that they have
    subroutine find_contact_states(assembled, factors, settlements, supports, closed, solves)
        type(assembled_type), intent(in) :: assembled
        !> As for combine, shape (nload, ncase), (nsupport, ncase), (3, nsupport, ncase); nsupport 0: their own
        real(wp), intent(in) :: factors(:, :), settlements(:, :), supports(:, :, :)
        !> Starts in, schemes out where they have been found, shape (at least size(beam%supports), ncase)
        integer, intent(inout) :: closed(:, :)
        !> How many systems were solved for them
        integer, intent(out) :: solves(:)
        type(case_loads_type) :: loads
        type(lane_room_type) :: room
        type(error_type), allocatable :: error
        real(wp), allocatable :: values(:, :, :), not_wanted(:, :)
        logical, allocatable :: done(:)
        real(wp) :: own_spans(2, 0, 0)
        integer :: i, m, stat

        solves(:) = 0
        call split_loads(assembled, loads, error)
        if (allocated(error)) return
        m = size(solves)
        allocate (not_wanted(0, m), done(m), stat=stat)
        if (stat == 0) allocate (values(3, merge(size(settlements, 1), 0, size(supports, 2) > 0 &
                                                 .or. any(abs(settlements) > 0.0_wp)), m), stat=stat)
        if (stat /= 0) return
        if (size(values, 2) > 0) then
            do i = 1, m
                if (size(supports, 2) > 0) then
                    values(:, :, i) = supports(:, :, i)
                else
                    values(1, :, i) = assembled%model%supports%settlement
                    values(2, :, i) = assembled%model%supports%gap
                    values(3, :, i) = assembled%model%supports%stiffness
                end if
                values(1, :, i) = values(1, :, i) + settlements(:, i)
            end do
        end if
        call solve_in_lanes(assembled, loads, factors, values, own_spans, room, closed, not_wanted, not_wanted, not_wanted, &
                            not_wanted, solves, done)
        where (.not. done) solves = 0
    end subroutine find_contact_states

    !> Room for cases of a beam
    subroutine make_room(assembled, loads, number, with_own_spans, room)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        !> How many factors a case has
        integer, intent(in) :: number
        logical, intent(in) :: with_own_spans
        type(lane_room_type), intent(inout) :: room
        integer :: stat

        call prepare_lanes(assembled, loads, with_own_spans, room%beam, room%made)
        if (room%made .and. with_own_spans) call prepare_spans(assembled, loads, room%spans, room%made)
        if (room%made) call new_pack(room%beam, room%pack, room%made)
        if (.not. room%made) return
        allocate (room%factors(lanes, number), &
                  room%turned(lanes, max(3*size(assembled%model%supports) + 3, size(assembled%beam%supports))), stat=stat)
        room%made = stat == 0
    end subroutine make_room

    !> Put a case into a lane of another pack
    pure subroutine take_lane(from, l, to, m)
        type(pack_type), intent(in) :: from
        type(pack_type), intent(inout) :: to
        integer, intent(in) :: l, m

        if (size(to%links, 1) > 1) to%links(m, :, :) = from%links(l, :, :)
        to%left(m, :) = from%left(l, :)
        to%right(m, :) = from%right(l, :)
        to%shear(m, :) = from%shear(l, :)
        to%couple(m, :) = from%couple(l, :)
        to%load_size(m, :) = from%load_size(l, :)
        to%turn_size(m, :) = from%turn_size(l, :)
        to%stiffness(m, :) = from%stiffness(l, :)
        to%rigid(m, :) = from%rigid(l, :)
        to%contact(m, :) = from%contact(l, :)
        to%closed(m, :) = from%closed(l, :)
        to%load(m, :) = from%load(l, :)
    end subroutine take_lane

    !> The largest absolute values of solutions in the engine's units
    pure function largest_values(w, ml, mr, reaction) result(largest)
        real(wp), intent(in), dimension(:, 0:), contiguous :: w, ml, mr, reaction
        real(wp) :: largest(lanes)
        integer :: i

        largest(:) = 0.0_wp
        do i = 0, ubound(w, 2)
            largest(:) = max(largest, abs(w(:, i)), abs(ml(:, i)), abs(mr(:, i)), abs(reaction(:, i)))
        end do
        do i = ubound(w, 2) + 1, ubound(reaction, 2)
            largest(:) = max(largest, abs(reaction(:, i)))
        end do
    end function largest_values

end module gapbeam_lane_cases
