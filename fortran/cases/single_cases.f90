!> Cases of a beam one by one, whatever the beam, but for ground.
module gapbeam_single_cases
    use gapbeam_kinds, only: wp, not_a_number
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_not_finite
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type, push_unit
    use gapbeam_slight_supports, only: leave_out_of_case
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type
    use gapbeam_cases, only: case_loads_type, split_loads, solve_case, replace_supports
    implicit none
    private
    public :: single_room_type, solve_one_by_one, give_none

    !> What cases of one beam need, kept from call to call; calls at the same time need one each
    type :: single_room_type
        !> The beam with the loads and supports of a case, where it has been made
        logical :: loaded_is_made = .false.
        type(beam_type) :: loaded
        type(workspace_type) :: work
        !> Of cases whose spans have other stiffnesses: the beam with them, and what loads do to it
        logical :: varied_is_sound = .false.
        type(assembled_type), allocatable :: varied
        type(case_loads_type) :: loads
    end type single_room_type

contains

    !> Solve cases
    subroutine solve_one_by_one(assembled, loads, numbers, which, room, solutions)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> Which cases are to be solved
        integer, intent(in) :: which(:)
        !> Empty, or of earlier cases of this beam
        type(single_room_type), intent(inout) :: room
        !> Contact states of cases that are not solved are all open, their numbers none. Where memory ends the status of all says so
        type(case_solutions_type), intent(inout) :: solutions
        logical :: acting(size(assembled%beam%supports))
        integer :: i, j

        if (size(which) == 0) return
        if (.not. associated(numbers%spans)) then
            if (.not. room%loaded_is_made) then
                room%loaded = assembled%beam
                call new_workspace(room%loaded, room%work)
                room%loaded_is_made = .true.
            end if
            if (size(acting) > 0 .and. .not. associated(numbers%supports)) room%loaded%supports(:) = assembled%beam%supports
            room%loaded%watch = assembled%beam%watch
        end if
        do j = 1, size(which)
            if (is_stopped(assembled%beam%watch)) exit
            i = which(j)
            acting(:) = solutions%closed(:size(acting), i) /= 0
            solutions%solves(i) = 0
            solutions%status(i) = gapbeam_solved
            if (associated(numbers%spans)) then
                call change_spans(assembled, numbers%spans(:, :, i), room, solutions%status(i))
                if (solutions%status(i) == gapbeam_solved) call solve(room%varied, room%loads)
                call give_alone(room%varied, room%work, acting, i, solutions)
            else
                call solve(assembled, loads)
                call give_alone(assembled, room%work, acting, i, solutions)
            end if
            if (solutions%status(i) == gapbeam_no_memory) then
                solutions%status(:) = gapbeam_no_memory
                return
            end if
        end do

    contains

        !> Solve the case at hand
        subroutine solve(beam, shares)
            type(assembled_type), intent(in) :: beam
            type(case_loads_type), intent(in) :: shares

            associate (status => solutions%status(i))
                if (associated(numbers%supports)) call replace_supports(beam, numbers%supports(:, :, i), room%loaded, status)
                if (status /= gapbeam_solved) return
                call solve_case(shares, numbers%factors(:, i), numbers%rule, room%loaded, acting, room%work, status)
                solutions%solves(i) = room%work%solves
            end associate
        end subroutine solve

    end subroutine solve_one_by_one

    !> Make the beam of a case whose spans have other stiffnesses
    subroutine change_spans(assembled, spans, room, status)
        type(assembled_type), intent(in) :: assembled
        !> EI and GA, shape (2, at least nspan)
        real(wp), intent(in) :: spans(:, :)
        type(single_room_type), intent(inout) :: room
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
        associate (own => room%varied%model%spans)
            own%EI = spans(1, :size(own))
            own%GA = spans(2, :size(own))
        end associate
        call assemble_loads(room%varied, error)
        if (.not. allocated(error)) call split_loads(room%varied, room%loads, error)
        room%varied_is_sound = .not. allocated(error)
        status = gapbeam_solved
        if (allocated(error)) then
            status = error%code
        else
            room%loaded = room%varied%beam
            call leave_out_of_case(room%varied, room%loaded)
            call new_workspace(room%loaded, room%work)
        end if
    end subroutine change_spans

    !> Put a case into its columns, where it is solved and the scene's units hold it
    subroutine give_alone(assembled, work, acting, i, solutions)
        type(assembled_type), intent(in) :: assembled
        type(workspace_type), intent(in) :: work
        logical, intent(in) :: acting(:)
        !> The case
        integer, intent(in) :: i
        type(case_solutions_type), intent(inout) :: solutions
        logical :: fits
        integer :: k

        solutions%closed(:, i) = 0
        if (solutions%status(i) == gapbeam_solved) then
            ! gfortran 16 takes a pointer of an associated name for one that may be strided.
            associate (units => assembled%units, a => work%answers(0:size(assembled%beam%links)))
                fits = .true.
                call give(a%deflection, units%deflection, solutions%w)
                call give(a%moment_left, moment_unit(units), solutions%ml)
                call give(a%moment_right, moment_unit(units), solutions%mr)
                call give(scale(work%reaction, [(push_unit(assembled, assembled%normal(k)) - units%force, k=1, size(acting))]), &
                          units%force, solutions%reaction)
                if (fits) then
                    solutions%closed(:size(acting), i) = merge(1, 0, acting)
                    return
                end if
            end associate
            solutions%status(i) = gapbeam_not_finite
        end if
        call give_none(solutions%status(i), i, solutions)

    contains

        !> Numbers in the scene's units, if these hold them
        subroutine give(values, unit, columns)
            real(wp), intent(in) :: values(:)
            integer, intent(in) :: unit
            real(wp), intent(inout), pointer, contiguous :: columns(:, :)

            fits = fits .and. all(abs(scale(values, unit)) <= huge(1.0_wp))
            if (associated(columns) .and. fits) columns(:size(values), i) = scale(values, unit)
        end subroutine give

    end subroutine give_alone

    !> Say that a case has no solution
    pure subroutine give_none(status, i, solutions)
        integer, intent(in) :: status
        !> The case
        integer, intent(in) :: i
        type(case_solutions_type), intent(inout) :: solutions

        solutions%status(i) = status
        solutions%closed(:, i) = 0
        if (associated(solutions%w)) solutions%w(:, i) = not_a_number
        if (associated(solutions%ml)) solutions%ml(:, i) = not_a_number
        if (associated(solutions%mr)) solutions%mr(:, i) = not_a_number
        if (associated(solutions%reaction)) solutions%reaction(:, i) = not_a_number
    end subroutine give_none

end module gapbeam_single_cases
