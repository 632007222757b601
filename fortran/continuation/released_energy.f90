!> Energy that is set free where the load cannot go on and the beam lands further along its path.
module gapbeam_released_energy
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_element, only: field_type
    use gapbeam_extended_precision, only: rule_given
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_query, only: find_starts
    use gapbeam_path_energy, only: energy_between
    use gapbeam_history, only: history_type, laws_at
    implicit none
    private
    public :: find_released_energy

contains

    !> From a limit to its landing, along the stretches that are passed in between
    subroutine find_released_energy(assembled, path, number, energy, error)
        type(assembled_type), intent(in), target :: assembled
        !> By follow_history, of laws that are polylines
        type(history_type), intent(in) :: path
        !> Of a limit that has a landing, and is not met while the dead loads are put on
        integer, intent(in) :: number
        real(wp), intent(out) :: energy
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: states(2)
        type(field_type), allocatable :: starts(:), starts_of_other(:)
        real(wp) :: from, to
        integer :: k, stat

        energy = 0.0_wp
        allocate (starts(size(assembled%pieces)), starts_of_other(size(assembled%pieces)), stat=stat)
        if (stat /= 0) call no_memory(error)
        do k = 1, 2
            if (.not. allocated(error)) call new_state(assembled, states(k), error)
        end do
        if (allocated(error)) return
        associate (limit => path%limits(number))
            do k = limit%stretch + 1, limit%landing
                from = path%stretches(k)%from
                to = path%stretches(k)%to
                ! The landing begins at the factor of the limit
                if (k == limit%landing) to = limit%factor
                if (k == limit%landing .and. k > 1) from = path%stretches(k - 1)%to
                if (.not. abs(to - from) > 0.0_wp) cycle
                call find_state(k, from, states(1), starts)
                if (.not. allocated(error)) call find_state(k, to, states(2), starts_of_other)
                if (allocated(error)) return
                energy = energy + energy_between(assembled, states(1), starts, states(2), starts_of_other)
            end do
        end associate

    contains

        !> A state on a stretch, and its fields
        subroutine find_state(stretch, factor, state, fields)
            integer, intent(in) :: stretch
            real(wp), intent(in) :: factor
            type(state_type), intent(inout) :: state
            type(field_type), intent(out) :: fields(:)

            state%closed(:) = path%stretches(stretch)%closed
            state%laws = laws_at(assembled, path%stretches(stretch))
            call solve_state(assembled, factor, rule_given, state, error)
            if (.not. allocated(error)) call find_starts(assembled, state, fields, error)
        end subroutine find_state

    end subroutine find_released_energy

end module gapbeam_released_energy
