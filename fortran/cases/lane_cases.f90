!> Many cases of a beam solved eight side by side (fortran/cases, files lane_*).
!> The beam is one that lanes hold. What comes out has the digits of solve_case of gapbeam_cases, which takes the other beams, and
!> the cases that are doubtful here
module gapbeam_lane_cases
    use gapbeam_kinds, only: wp
    use gapbeam_piece, only: is_prismatic
    use gapbeam_limits, only: most_lane_links
    use gapbeam_tolerances, only: most_unit_power
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type
    use gapbeam_model, only: has_other_supports
    use gapbeam_units, only: moment_unit, stiffness_unit
    use gapbeam_assembled_model, only: assembled_type, is_alone
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type, remaining
    use gapbeam_cases, only: case_loads_type, split_loads, give_case
    use gapbeam_lane_types, only: lanes, pack_type, new_pack
    use gapbeam_lane_blocks, only: block_type, make_block, take_cases
    implicit none
    private
    public :: lane_room_type, fits_lanes, fits_side_by_side, solve_in_lanes, find_contact_states

    !> Ways in which schemes are solved
    integer, parameter :: ways = 3

    !> Cases that wait until eight are to be solved in the same way
    type :: queue_type
        type(pack_type) :: pack
        integer :: waiting = 0, case_of(lanes) = 0
    end type queue_type

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: lane_room_type
        type(block_type) :: block
        type(queue_type) :: queues(ways)
    end type lane_room_type

contains

    !> Do lanes hold a beam with all its links
    pure function fits_lanes(assembled) result(fits)
        type(assembled_type), intent(in) :: assembled
        logical :: fits

        fits = size(assembled%beam%links) <= most_lane_links
        if (fits) fits = fits_side_by_side(assembled)
    end function fits_lanes

    !> Is a beam such as lanes are made for: several links that bend, no ground and laws
    pure function fits_side_by_side(assembled) result(fits)
        type(assembled_type), intent(in) :: assembled
        logical :: fits

        associate (beam => assembled%beam, units => assembled%units)
            fits = size(beam%links) > 1 .and. .not. allocated(beam%ground)
            if (.not. fits) return
            fits = all(beam%links%faa > 0.0_wp .and. beam%links%fbb > 0.0_wp) &
                .and. .not. has_other_supports(beam) .and. all(is_prismatic(assembled%pieces)) &
                .and. .not. any(is_alone(assembled%model%loads)) &
                .and. max(abs(units%deflection), abs(units%force), abs(moment_unit(units)), abs(stiffness_unit(units))) &
                < most_unit_power
        end associate
    end function fits_side_by_side

    !> Solve cases of a beam that fits
    subroutine solve_in_lanes(assembled, loads, numbers, which, room, solutions, done)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> Which cases are to be solved
        integer, intent(in) :: which(:)
        !> Empty, or of earlier cases of this beam, with stiffnesses of their own or without as these are
        type(lane_room_type), intent(inout) :: room
        !> Those that are not done stay as they were, but for how often they were solved
        type(case_solutions_type), intent(inout) :: solutions
        !> Which cases are done
        logical, intent(inout) :: done(:)
        real(wp) :: units(3)
        integer :: first, l, kind, solves_of(lanes), method(lanes), case_of(lanes)
        logical :: made, fits(lanes)

        call make_block(assembled, loads, numbers, room%block)
        if (.not. room%block%made) return
        units = scale(1.0_wp, [assembled%units%deflection, moment_unit(assembled%units), assembled%units%force])
        associate (block => room%block)
            do first = 1, size(which), lanes
                if (is_stopped(assembled%beam%watch)) exit
                call take_cases(assembled, numbers, solutions%closed, which(first:), block, fits)
                if (.not. any(fits)) cycle
                call block%compiled%search_pack(block%beam, block%factors, block%pack, solves_of, method)
                where (.not. fits) method = 0
                solutions%solves(block%case_of) = solves_of
                kind = method(1)
                if (kind > 0 .and. all(method == kind)) then
                    call finish(kind, block%case_of, block%pack)
                    cycle
                end if
                do l = 1, block%cases
                    if (method(l) == 0) cycle
                    associate (queue => room%queues(method(l)))
                        if (.not. allocated(queue%pack%left)) then
                            call new_pack(block%beam, queue%pack, made)
                            if (.not. made .and. allocated(queue%pack%left)) deallocate (queue%pack%left)
                            if (.not. made) exit
                        end if
                        queue%waiting = queue%waiting + 1
                        queue%case_of(queue%waiting) = block%case_of(l)
                        call take_lane(block%pack, l, queue%pack, queue%waiting)
                        if (queue%waiting < lanes) cycle
                        queue%waiting = 0
                        call finish(method(l), queue%case_of, queue%pack)
                    end associate
                end do
            end do
            do kind = 1, ways
                associate (queue => room%queues(kind))
                    if (queue%waiting == 0) cycle
                    ! The last lanes repeat the first case
                    do l = 1, lanes
                        first = merge(l, 1, l <= queue%waiting)
                        case_of(l) = queue%case_of(first)
                        call take_lane(queue%pack, first, block%pack, l)
                    end do
                    queue%waiting = 0
                    block%pack%is_solved = .false.
                    call finish(kind, case_of, block%pack)
                end associate
            end do
        end associate

    contains

        !> Solve eight schemes that are solved in the same way
        subroutine finish(way, of_lane, schemes)
            integer, intent(in) :: way, of_lane(lanes)
            type(pack_type), intent(inout) :: schemes
            real(wp) :: most, largest(lanes)
            logical :: doubtful(lanes), wrong(lanes)
            integer :: k

            associate (block => room%block)
                call block%compiled%finish_pack(block%beam, way, schemes, doubtful)
                call block%compiled%audit_pack(block%beam, schemes, wrong)
                doubtful = doubtful .or. wrong
                most = maxval(units)
                if (most > 1.0_wp) then
                    largest(:) = largest_values(schemes%w, schemes%ml, schemes%mr, schemes%reaction)
                    doubtful = doubtful .or. .not. largest <= huge(1.0_wp)/most
                end if
                if (.not. any(doubtful) .and. all(of_lane(lanes) /= of_lane([1, lanes - 1]))) then   ! no case is repeated
                    done(of_lane) = .true.
                    call block%compiled%give_pack(block%beam, units, schemes, of_lane, block%turned, solutions)
                    return
                end if
                do k = 1, lanes
                    if (doubtful(k) .or. (k > 1 .and. of_lane(k) == of_lane(max(k - 1, 1)))) cycle
                    done(of_lane(k)) = .true.
                    call give_case(units, block%beam%place, of_lane(k), schemes%closed(k, :), schemes%w(k, :), &
                                   schemes%ml(k, :), schemes%mr(k, :), schemes%reaction(k, :), solutions)
                end do
            end associate
        end subroutine finish

    end subroutine solve_in_lanes

    !> Find the contact states of many combinations (gapbeam_combinations) of a beam that fits. Those that are doubtful are left to
    !> their own searches, with the start that they have
    subroutine find_contact_states(assembled, factors, settlements, supports, closed, solves)
        type(assembled_type), intent(in) :: assembled
        !> As for combine, shape (nload, ncase), (nsupport, ncase), (3, nsupport, ncase); nsupport 0: their own
        real(wp), intent(in), contiguous, target :: factors(:, :)
        real(wp), intent(in) :: settlements(:, :), supports(:, :, :)
        !> Starts in, schemes out where they have been found, shape (at least size(beam%supports), ncase)
        integer, intent(inout), contiguous, target :: closed(:, :)
        !> How many systems were solved for them
        integer, intent(out), contiguous, target :: solves(:)
        type(case_loads_type) :: loads
        type(case_numbers_type) :: numbers
        type(case_solutions_type) :: solutions
        type(lane_room_type) :: room
        type(error_type), allocatable :: error
        real(wp), allocatable, target :: values(:, :, :)
        logical, allocatable :: done(:)
        integer :: i, m, stat

        solves(:) = 0
        call split_loads(assembled, loads, error)
        if (allocated(error)) return
        m = size(solves)
        allocate (done(m), stat=stat)
        if (stat /= 0) return
        numbers%factors => factors
        if (size(supports, 2) > 0 .or. any(abs(settlements) > 0.0_wp)) then
            allocate (values(3, size(settlements, 1), m), stat=stat)
            if (stat /= 0) return
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
            numbers%supports => values
        end if
        solutions%closed => closed
        solutions%solves => solves
        done(:) = .false.
        call solve_in_lanes(assembled, loads, numbers, remaining(done), room, solutions, done)
        where (.not. done) solves = 0
    end subroutine find_contact_states

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
