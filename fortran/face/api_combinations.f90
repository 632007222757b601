!> Combinations of load cases, for Fortran; as gapbeam_api in all else
module gapbeam_api_combinations
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, failed
    use gapbeam_words, only: shown, whole
    use gapbeam_check, only: check_loads
    use gapbeam_scene, only: load_type
    use gapbeam_combinations, only: combination_type, combine
    use gapbeam_api_objects, only: prepared_type, require_beam, require_size, bad_argument
    implicit none
    private
    public :: combine_loads

contains

    !> Prepare another beam: every load times a factor, and supports that have moved further. Dead loads stay dead, in full with
    !> their factor from the start; the load factor of solve_beam scales the others. Each combination has a contact state of its
    !> own: results cannot be added up
    subroutine combine_loads(beam, factors, combined, error, settlements)
        !> Prepared
        type(prepared_type), intent(in) :: beam
        !> Factor of every load of the model, shape (nload)
        real(wp), intent(in) :: factors(:)
        !> Ready for solve_beam and follow_load; not prepared where an error is found
        type(prepared_type), intent(out) :: combined
        !> gapbeam_bad_input for arrays of another size, numbers that are not finite, or supports that leave no room for each
        !> other; gapbeam_not_prepared, gapbeam_not_finite or gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        !> Further movement of every support of the model, down, of an axial one to the right, shape (nsupport); default 0
        real(wp), intent(in), optional :: settlements(:)
        type(environment_type) :: environment
        type(combination_type) :: made
        type(load_type), allocatable :: loads(:)
        real(wp), allocatable :: moves(:)
        integer :: stat

        call require_beam(beam, error)
        if (allocated(error)) return
        associate (model => beam%lowered%model)
            call require_size(size(model%loads), [size(factors)], error)
            if (present(settlements)) call require_size(size(model%supports), [size(settlements)], error)
            if (allocated(error)) return
            allocate (moves(size(model%supports)), loads(size(model%loads)), stat=stat)
            if (failed(stat, error)) return
            moves(:) = 0.0_wp
            if (present(settlements)) moves(:) = settlements
            call require_finite(factors, "factors", error)
            if (.not. allocated(error)) call require_finite(moves, "settlements", error)
            if (allocated(error)) return
            call hold_environment(environment)
            loads(:) = model%loads
            loads%value = factors*loads%value
            loads%value_to = factors*loads%value_to
            call check_loads(loads, model, beam%lowered%ends, error)
        end associate
        if (.not. allocated(error)) call combine(beam%lowered, factors, moves, made, error)
        if (.not. allocated(error)) call move_alloc(made%assembled, combined%lowered)
    end subroutine combine_loads

    !> Refuse what is no finite number
    subroutine require_finite(values, name, error)
        real(wp), intent(in) :: values(:)
        character(len=*), intent(in) :: name
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        do i = 1, size(values)
            if (abs(values(i)) <= huge(values)) cycle
            call bad_argument(error, name, name//"("//trim(whole(i))//"): expected a finite number, got "// &
                             trim(shown(values(i))))
            error%entry = i
            return
        end do
    end subroutine require_finite

end module gapbeam_api_combinations
