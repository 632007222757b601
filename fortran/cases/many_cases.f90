!> Many cases of a beam: each in the widest way that holds it, what is doubtful there in the next one.
!> The ways: eight segments of a long beam side by side (gapbeam_segment_cases), eight cases side by side (gapbeam_lane_cases), one
!> by one (gapbeam_single_cases). All give the same digits. Beams that are solved stretch by stretch, on curves or on a path have a
!> way of their own (gapbeam_stretch_cases)
module gapbeam_many_cases
    use gapbeam_watch, only: is_stopped
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_no_memory, gapbeam_stopped
    use gapbeam_memory, only: enough_memory, for_solving
    use gapbeam_search, only: rule_block
    use gapbeam_scene, only: gapbeam_axial
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_along_axis, only: solve_along_axis
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type, remaining
    use gapbeam_full_load, only: is_solved_alone
    use gapbeam_cases, only: case_loads_type
    use gapbeam_lane_types, only: lanes
    use gapbeam_lane_spans, only: fits_spans
    use gapbeam_lane_cases, only: lane_room_type, fits_lanes, solve_in_lanes
    use gapbeam_segment_cases, only: segments_type, fits_segments, solve_in_segments
    use gapbeam_single_cases, only: single_room_type, solve_one_by_one, give_none
    use gapbeam_combinations, only: combination_type, combine_case
    use gapbeam_stretch_cases, only: stretch_room_type, solve_stretch_cases
    use gapbeam_limits, only: least_cases
    implicit none
    private
    public :: case_room_type, solve_cases

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: case_room_type
        logical :: made = .false., fits = .false., fits_with_own_spans = .false., is_long = .false., alone = .false.
        type(lane_room_type) :: lanes, lanes_with_own_spans
        type(segments_type) :: segments
        type(single_room_type) :: single
        type(stretch_room_type) :: stretches
    end type case_room_type

contains

    !> Solve cases
    subroutine solve_cases(assembled, loads, numbers, room, solutions)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> Empty, or of earlier cases of this beam
        type(case_room_type), intent(inout) :: room
        !> Numbers of a case that is not solved are none, and its supports all open. Where memory ends, or whoever watches the call
        !> has ended it, the status of all says so
        type(case_solutions_type), intent(inout) :: solutions
        logical, allocatable :: done(:)
        integer :: cases, left, i, stat

        cases = size(solutions%status)
        solutions%solves(:) = 0
        solutions%status(:) = gapbeam_no_memory
        if (.not. room%made) then
            if (.not. enough_memory(for_solving, size(assembled%beam%links), size(assembled%beam%supports), 0)) return
            room%alone = is_solved_alone(assembled)
            room%is_long = fits_segments(assembled)
            room%fits = fits_lanes(assembled)
            room%fits_with_own_spans = room%fits .and. fits_spans(assembled, loads)
            room%made = .true.
        end if
        if (room%alone) then
            call solve_stretch_cases(assembled, numbers, room%stretches, solutions)
            if (is_stopped(assembled%beam%watch)) solutions%status(:) = gapbeam_stopped
            return
        end if
        allocate (done(cases), source=.false., stat=stat)
        if (stat /= 0) return
        if (numbers%rule == rule_block) then
            if (associated(numbers%spans)) then
                if (room%fits_with_own_spans) call solve_in_lanes(assembled, loads, numbers, remaining(done), &
                                                                  room%lanes_with_own_spans, solutions, done)
            else
                if (room%is_long) then
                    left = modulo(cases, lanes)
                    if (left >= least_cases) left = 0
                    if (.not. room%fits) left = cases
                    call solve_in_segments(assembled, loads, numbers, [(cases - left + i, i=1, left)], room%segments, &
                                           solutions, done)
                end if
                ! Lanes hold ends that open, too
                if (room%fits .and. .not. all(done)) then
                    call solve_in_lanes(assembled, loads, numbers, remaining(done), room%lanes, solutions, done)
                end if
            end if
            where (done) solutions%status = gapbeam_solved
        end if
        if (.not. all(done)) call solve_one_by_one(assembled, loads, numbers, remaining(done), room%single, solutions)
        call refuse_along_axis(assembled, numbers, solutions)
        if (is_stopped(assembled%beam%watch)) solutions%status(:) = gapbeam_stopped
    end subroutine solve_cases

    !> Refuse cases in which supports along the beam share a force that statics cannot tell apart, or it slides: what is across the
    !> beam does not depend on that
    subroutine refuse_along_axis(assembled, numbers, solutions)
        !> As for solve_cases
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        type(case_solutions_type), intent(inout) :: solutions
        type(combination_type) :: combined
        type(state_type) :: state
        type(error_type), allocatable :: error
        integer :: i

        if (.not. may_be_held_twice(assembled)) return
        do i = 1, size(solutions%status)
            if (is_stopped(assembled%beam%watch)) return
            if (solutions%status(i) /= gapbeam_solved) cycle
            call combine_case(assembled, numbers, i, combined, error)
            if (.not. allocated(error)) call new_state(combined%assembled, state, error)
            if (.not. allocated(error)) then
                state%factor = 1.0_wp
                call solve_along_axis(combined%assembled, state, error)
            end if
            if (allocated(error)) then
                call give_none(error%code, i, solutions)
            else if (state%slides) then
                call give_none(gapbeam_no_equilibrium, i, solutions)
            end if
        end do
    end subroutine refuse_along_axis

    !> May two supports along the beam hold it with nothing between them that gives way
    pure function may_be_held_twice(assembled) result(may)
        type(assembled_type), intent(in) :: assembled
        logical :: may

        associate (model => assembled%model)
            may = count(model%supports%direction == gapbeam_axial) > 1
            if (may) may = any(model%spans%EA > huge(1.0_wp)) .or. size(model%sections) > 0
        end associate
        if (may .and. allocated(assembled%axial%flexibility)) may = .not. all(assembled%axial%flexibility > 0.0_wp)
    end function may_be_held_twice

end module gapbeam_many_cases
