!> Cases of a beam, side by side where lanes hold them (gapbeam_lane_cases), else one by one.
module gapbeam_many_cases
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: least_cases, least_alone_links
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite, gapbeam_stopped
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_search, only: rule_block
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, replace_supports
    use gapbeam_lane_spans, only: fits_spans
    use gapbeam_lane_cases, only: lane_room_type, fits_lanes, solve_in_lanes
    use gapbeam_segment_cases, only: segments_type, fits_segments, solve_in_segments
    implicit none
    private
    public :: case_room_type, solve_cases

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: case_room_type
        logical :: made = .false., fits = .false., fits_with_own_spans = .false., is_long = .false.
        type(lane_room_type) :: lanes, lanes_with_own_spans
        type(segments_type) :: segments
        !> Of cases one by one: the beam with their loads and supports, where it has been made
        logical :: loaded_is_made = .false.
        type(beam_type) :: loaded
        type(workspace_type) :: work
        !> Of cases whose spans have other stiffnesses: the beam with them, and what loads do to it
        logical :: varied_is_sound = .false.
        type(assembled_type), allocatable :: varied
        type(case_loads_type) :: loads
    end type case_room_type

contains

    !> Solve cases
    subroutine solve_cases(assembled, loads, factors, values, spans, rule, room, closed, w, ml, mr, reaction, solves, status)
        !> A beam without ground
        type(assembled_type), intent(in) :: assembled
        !> By split_loads, and the factor of every load, shape (at least nload, ncase)
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Settlement, gap and stiffness of every support of the scene, none of which has a law, shape (3, at least nsupport,
        !> ncase); nsupport 0: their own
        real(wp), intent(in), contiguous :: values(:, :, :)
        !> EI and GA of every span, shape (2, nspan, ncase); nspan 0: their own
        real(wp), intent(in) :: spans(:, :, :)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Empty, or of earlier cases of this beam
        type(case_room_type), intent(inout) :: room
        !> Starts in, contact states out, 1 closed; of a case that is not solved all open; shape (at least size(beam%supports),
        !> ncase). Contiguous, as gfortran would copy all cases before it handed them on
        integer, intent(inout), contiguous :: closed(:, :)
        !> In the scene's units: deflections, moments left and right of the nodes, reactions, as many rows as of the schemes at
        !> least; without rows: not wanted. Those of a case that is not solved are not numbers
        real(wp), intent(inout), contiguous :: w(:, :), ml(:, :), mr(:, :), reaction(:, :)
        !> Linear solves; gapbeam_solved, gapbeam_no_equilibrium or the code of an error. Where memory ends, or whoever watches
        !> the call has ended it, all say so
        integer, intent(out) :: solves(:), status(:)
        logical, allocatable :: acting(:), done(:)
        integer :: i, m, stat

        m = size(assembled%beam%supports)
        solves(:) = 0
        status(:) = gapbeam_no_memory
        if (.not. room%made) then
            if (.not. enough_memory(for_solving, size(assembled%beam%links), m, 0)) return
            room%is_long = fits_segments(assembled)
            room%fits = fits_lanes(assembled)
            room%fits_with_own_spans = room%fits .and. fits_spans(assembled, loads)
            room%made = .true.
        end if
        allocate (acting(m), done(size(status)), stat=stat)
        if (stat /= 0) return
        done(:) = .false.
        if (rule == rule_block) then
            if (size(spans, 2) > 0) then
                if (room%fits_with_own_spans) then
                    call solve_in_lanes(assembled, loads, factors, values, spans, room%lanes_with_own_spans, closed, w, ml, mr, &
                                        reaction, solves, done)
                end if
            else if (room%is_long .and. (size(status) < least_cases .or. size(assembled%beam%links) >= least_alone_links)) then
                call solve_in_segments(assembled, loads, factors, values, room%segments, closed, w, ml, mr, reaction, solves, done)
                ! Lanes hold ends that open
                do i = 1, size(status)
                    if (.not. (done(i) .or. .not. room%fits)) call solve_beside(i, i)
                end do
            else if (room%fits) then
                call solve_beside(1, size(status))
            end if
            where (done) status = gapbeam_solved
            if (all(done)) return
        end if
        if (size(spans, 2) == 0) then
            if (.not. room%loaded_is_made) then
                room%loaded = assembled%beam
                call new_workspace(room%loaded, room%work)
                room%loaded_is_made = .true.
            end if
            if (m > 0 .and. size(values, 2) == 0) room%loaded%supports(:) = assembled%beam%supports
            room%loaded%watch = assembled%beam%watch
        end if
        do i = 1, size(status)
            if (is_stopped(assembled%beam%watch)) exit
            if (done(i)) cycle
            acting(:) = closed(:m, i) /= 0
            solves(i) = 0
            if (size(spans, 2) > 0) then
                call change_spans(assembled, spans(:, :, i), room, status(i))
                if (status(i) == gapbeam_solved) call solve(room%varied, room%loads)
                call give_case(room%varied, room%work, acting, closed(:, i), w(:, i), ml(:, i), mr(:, i), reaction(:, i), status(i))
            else
                status(i) = gapbeam_solved
                call solve(assembled, loads)
                call give_case(assembled, room%work, acting, closed(:, i), w(:, i), ml(:, i), mr(:, i), reaction(:, i), status(i))
            end if
            if (status(i) == gapbeam_no_memory) then
                status(:) = gapbeam_no_memory
                return
            end if
        end do
        if (is_stopped(assembled%beam%watch)) status(:) = gapbeam_stopped

    contains

        !> Solve some cases side by side
        subroutine solve_beside(first, last)
            integer, intent(in) :: first, last
            integer :: from, to

            from = merge(first, 1, size(values, 2) > 0)
            to = merge(last, size(values, 3), size(values, 2) > 0)
            call solve_in_lanes(assembled, loads, factors(:, first:last), values(:, :, from:to), spans, room%lanes, &
                                closed(:, first:last), w(:, first:last), ml(:, first:last), mr(:, first:last), &
                                reaction(:, first:last), solves(first:last), done(first:last))
        end subroutine solve_beside

        !> Solve the case at hand
        subroutine solve(beam, shares)
            type(assembled_type), intent(in) :: beam
            type(case_loads_type), intent(in) :: shares

            if (size(values, 2) > 0) call replace_supports(beam, values(:, :, i), room%loaded, status(i))
            if (status(i) /= gapbeam_solved) return
            call solve_case(shares, factors(:, i), rule, room%loaded, acting, room%work, status(i))
            solves(i) = room%work%solves
        end subroutine solve

    end subroutine solve_cases

    !> Make the beam of a case whose spans have other stiffnesses
    subroutine change_spans(assembled, spans, room, status)
        type(assembled_type), intent(in) :: assembled
        !> EI and GA, shape (2, nspan)
        real(wp), intent(in) :: spans(:, :)
        type(case_room_type), intent(inout) :: room
        !> gapbeam_solved or the code of an error
        integer, intent(out) :: status
        type(error_type), allocatable :: error
        integer :: stat

        status = gapbeam_no_memory
        room%loaded_is_made = .false.
        ! What an error leaves behind is no beam to go on with
        if (allocated(room%varied) .and. .not. room%varied_is_sound) deallocate (room%varied)
        if (.not. allocated(room%varied)) then
            allocate (room%varied, source=assembled, stat=stat)
            if (stat /= 0) return
        end if
        room%varied%beam%watch = assembled%beam%watch
        room%varied%model%spans%EI = spans(1, :)
        room%varied%model%spans%GA = spans(2, :)
        call assemble_loads(room%varied, error)
        if (.not. allocated(error)) call split_loads(room%varied, room%loads, error)
        room%varied_is_sound = .not. allocated(error)
        status = gapbeam_solved
        if (allocated(error)) then
            status = error%code
        else
            room%loaded = room%varied%beam
            call new_workspace(room%loaded, room%work)
        end if
    end subroutine change_spans

    !> A case in the scene's units, where it is solved and these hold it
    subroutine give_case(assembled, work, acting, closed, w, ml, mr, reaction, status)
        type(assembled_type), intent(in) :: assembled
        type(workspace_type), intent(in) :: work
        logical, intent(in) :: acting(:)
        !> As for solve_cases
        integer, intent(out) :: closed(:)
        real(wp), intent(inout) :: w(:), ml(:), mr(:), reaction(:)
        integer, intent(inout) :: status

        closed(:) = 0
        if (status == gapbeam_solved) then
            associate (units => assembled%units, a => work%answers)
                if (all(abs(scale(a%deflection, units%deflection)) <= huge(1.0_wp)) &
                    .and. all(abs(scale(a%moment_left, moment_unit(units))) <= huge(1.0_wp)) &
                    .and. all(abs(scale(a%moment_right, moment_unit(units))) <= huge(1.0_wp)) &
                    .and. all(abs(scale(work%reaction, units%force)) <= huge(1.0_wp))) then
                    if (size(w) > 0) w(:) = scale(a%deflection, units%deflection)
                    if (size(ml) > 0) ml(:) = scale(a%moment_left, moment_unit(units))
                    if (size(mr) > 0) mr(:) = scale(a%moment_right, moment_unit(units))
                    if (size(reaction) > 0) reaction(:size(acting)) = scale(work%reaction, units%force)
                    closed(:size(acting)) = merge(1, 0, acting)
                    return
                end if
            end associate
            status = gapbeam_not_finite
        end if
        w(:) = not_a_number()
        ml(:) = not_a_number()
        mr(:) = not_a_number()
        reaction(:) = not_a_number()
    end subroutine give_case

    !> A number that is none. Procedures that know of ieee_arithmetic save the processor's state, each time they are called
    function not_a_number() result(nan)
        use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
        real(wp) :: nan

        nan = ieee_value(nan, ieee_quiet_nan)
    end function not_a_number

end module gapbeam_many_cases
