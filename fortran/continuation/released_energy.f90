!> Energy that is set free where the load cannot go on and the beam lands further along its path.
module gapbeam_released_energy
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_element, only: field_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_query, only: find_starts
    use gapbeam_path_energy, only: energy_between
    use gapbeam_history_record, only: history_type, runs_of
    use gapbeam_history_start, only: grow_dead_loads
    use gapbeam_path_states, only: solve_on_path
    implicit none
    private
    public :: find_released_energy

contains

    !> From a limit to its landing, along the stretches that are passed in between; a smooth law is one piece
    subroutine find_released_energy(assembled, path, number, energy, error)
        type(assembled_type), intent(in), target :: assembled
        !> By follow_on_laws
        type(history_type), intent(in), target :: path
        !> Of a limit that has a landing; met while the dead loads are put on only if supports do not move with them
        integer, intent(in) :: number
        real(wp), intent(out) :: energy
        !> As for solve_on_path
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), target :: dead
        type(assembled_type), pointer :: beam
        type(field_type), allocatable :: starts(:), starts_of_other(:)
        integer, allocatable :: runs(:, :)
        type(state_type) :: one, other
        real(wp) :: from, to
        integer :: run, first, last, stat

        energy = 0.0_wp
        allocate (starts(size(assembled%pieces)), starts_of_other(size(assembled%pieces)), stat=stat)
        if (failed(stat, error)) return
        beam => assembled
        allocate (runs, source=runs_of(path))
        associate (limit => path%limits(number))
            if (limit%leg == 0) then
                call grow_dead_loads(assembled, dead)
                beam => dead
            end if
            do run = 1, size(runs, 2)
                first = max(runs(1, run), limit%stretch + 1)
                last = min(runs(2, run), limit%landing)
                if (first > last) cycle
                from = path%stretches(first)%from
                to = path%stretches(last)%to
                ! The landing begins at the factor of the limit
                if (last == limit%landing) to = limit%factor
                if (last == limit%landing .and. first > 1) from = path%stretches(first - 1)%to
                if (.not. abs(to - from) > 0.0_wp) cycle
                call find_state(first, from, one, starts)
                if (.not. allocated(error)) call find_state(last, to, other, starts_of_other)
                if (allocated(error)) return
                energy = energy + energy_between(beam, one, starts, other, starts_of_other)
            end do
        end associate

    contains

        !> A state on a stretch, and its fields
        subroutine find_state(stretch, factor, state, fields)
            integer, intent(in) :: stretch
            real(wp), intent(in) :: factor
            type(state_type), intent(out) :: state
            type(field_type), intent(inout) :: fields(:)

            call new_state(beam, state, error)
            if (.not. allocated(error)) call solve_on_path(beam, path, stretch, factor, state, error)
            if (allocated(error) .or. allocated(state%ground)) return
            call find_starts(beam, state, fields, error)
        end subroutine find_state

    end subroutine find_released_energy

end module gapbeam_released_energy
