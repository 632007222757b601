!> Combinations of loads and moved supports, each solved in a contact state of its own.
!> Every load is taken times a factor, dead ones as dead ones; each begins from the same start, so none depends on those before.
module gapbeam_combinations
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: model_type
    use gapbeam_assembled_model, only: assembled_type, copy_given
    use gapbeam_assemble, only: assemble_model
    use gapbeam_assemble_loads, only: assemble_loads
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_full_load, only: solve_full_load
    use gapbeam_support_values, only: support_values
    use gapbeam_query, only: extremes_of_fields, fields_in_pieces, make_starts
    use gapbeam_quantities, only: quantity_count
    use gapbeam_case_types, only: case_numbers_type
    implicit none
    private
    public :: combination_type, varied_type, combine, combine_case, solve_combination, values_of_combination

    !> Numbers of a combination in place of those of the beam; what has no columns stays
    type :: varied_type
        !> Settlement, gap and stiffness of every support, shape (3, nsupport)
        real(wp), pointer :: supports(:, :) => null()
        !> EI and GA of every span, shape (2, nspan)
        real(wp), pointer :: spans(:, :) => null()
        !> Modulus of every foundation; negative: as it was. Shape (nfoundation)
        real(wp), pointer :: moduli(:) => null()
    end type varied_type

    !> A beam under a combination, made again for the next one
    type :: combination_type
        type(assembled_type), allocatable :: assembled
        !> Have supports moved
        logical :: moved = .false.
    end type combination_type

contains

    !> Put a combination on a beam
    subroutine combine(base, factors, settlements, combined, error, varied)
        type(assembled_type), intent(in) :: base
        !> Factor of every load, shape (nload); the products are within range
        real(wp), intent(in) :: factors(:)
        !> Further movement of every support, down (of an axial one to the right), shape (nsupport)
        real(wp), intent(in) :: settlements(:)
        !> Nothing, or an earlier combination on the same beam, in
        type(combination_type), intent(inout) :: combined
        !> Supports that leave no room for each other, numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(varied_type), intent(in), optional :: varied
        logical :: moves, vary
        integer :: stat

        vary = .false.
        if (present(varied)) vary = associated(varied%supports)
        moves = any(abs(settlements) > 0.0_wp) .or. allocated(base%given_settlement) .or. vary
        stat = 0
        if ((moves .or. combined%moved) .and. allocated(combined%assembled)) deallocate (combined%assembled)
        if (moves) then
            allocate (combined%assembled, stat=stat)
            if (stat == 0) call copy_given(base, combined%assembled%model, stat)
        else if (.not. allocated(combined%assembled)) then
            ! What is made of its loads has room for all of them, also for those that are 0 in other combinations
            allocate (combined%assembled, source=base, stat=stat)
        end if
        if (failed(stat, error)) return
        associate (assembled => combined%assembled, loads => base%model%loads)
            assembled%model%loads%value = factors*loads%value
            assembled%model%loads%value_to = factors*loads%value_to
            if (present(varied)) call take_varied(varied, assembled%model)
            if (moves) then
                assembled%model%supports%settlement = assembled%model%supports%settlement + settlements
                call assemble_model(assembled, error)
            else
                call assemble_loads(assembled, error)
            end if
        end associate
        combined%assembled%beam%watch = base%beam%watch
        ! What an error leaves behind is no beam to go on with
        combined%moved = moves .or. allocated(error)
    end subroutine combine

    !> Put one of many cases on a beam
    subroutine combine_case(base, numbers, i, combined, error)
        type(assembled_type), intent(in) :: base
        type(case_numbers_type), intent(in) :: numbers
        !> The case
        integer, intent(in) :: i
        !> As for combine
        type(combination_type), intent(inout) :: combined
        type(error_type), allocatable, intent(out) :: error
        type(varied_type) :: varied

        associate (model => base%model)
            if (associated(numbers%supports)) varied%supports => numbers%supports(:, :size(model%supports), i)
            if (associated(numbers%spans)) varied%spans => numbers%spans(:, :size(model%spans), i)
            if (associated(numbers%moduli)) varied%moduli => numbers%moduli(:size(model%foundations), i)
            call combine(base, numbers%factors(:size(model%loads), i), 0*model%supports%settlement, combined, error, varied)
        end associate
    end subroutine combine_case

    !> Take other numbers of supports, spans and foundations
    pure subroutine take_varied(varied, model)
        type(varied_type), intent(in) :: varied
        type(model_type), intent(inout) :: model

        if (associated(varied%supports)) then
            model%supports%settlement = varied%supports(1, :)
            model%supports%gap = varied%supports(2, :)
            model%supports%stiffness = varied%supports(3, :)
        end if
        if (associated(varied%spans)) then
            model%spans%EI = varied%spans(1, :)
            model%spans%GA = varied%spans(2, :)
        end if
        if (associated(varied%moduli)) then
            where (varied%moduli >= 0.0_wp)
                model%foundations%k = varied%moduli
                model%foundations%k_to = varied%moduli
            end where
        end if
    end subroutine take_varied

    !> Solve a combination at full load
    subroutine solve_combination(assembled, rule, closed, state, error)
        !> By combine
        type(assembled_type), intent(in) :: assembled
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Where the search for the scheme starts, shape (size(beam%supports))
        logical, intent(in) :: closed(:)
        !> Solved, or with the status gapbeam_no_equilibrium
        type(state_type), intent(out) :: state
        !> As for solve_full_load
        type(error_type), allocatable, intent(out) :: error

        call new_state(assembled, state, error)
        if (allocated(error)) return
        state%closed(:) = closed
        call solve_full_load(assembled, rule, state, error)
    end subroutine solve_combination

    !> What a solved combination says, in the user's units
    subroutine values_of_combination(assembled, state, piece, distance, at_supports, extremes, places, fields, error)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        !> Places of the fields: piece, and distance from its left end, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Reaction, deflection, opening and couple of the supports, shape (nsupport, 4)
        real(wp), intent(out) :: at_supports(:, :)
        !> Maximum and minimum of every quantity along the beam, and where they are, shape (2, quantity_count); or none, (2, 0)
        real(wp), intent(inout) :: extremes(:, :), places(:, :)
        !> The same at the places, shape (quantity_count, n)
        real(wp), intent(inout) :: fields(:, :)
        !> A value out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: conditions(size(at_supports, 1)), i

        call support_values(assembled, state, at_supports(:, 1), at_supports(:, 2), at_supports(:, 3), at_supports(:, 4), &
                            conditions)
        if (size(extremes, 2) > 0) then
            call extremes_of_fields(assembled, state, [(i, i=1, quantity_count)], extremes, places, error)
            if (allocated(error)) return
        end if
        if (size(piece) == 0) return
        if (.not. allocated(state%ground)) call make_starts(assembled, state, error)
        if (allocated(error)) return
        call fields_in_pieces(assembled, 1.0_wp, state%starts, state%displacement, state%tension, [(i, i=1, quantity_count)], &
                              piece, distance, fields, error, state%ground, state%along_ground)
    end subroutine values_of_combination

end module gapbeam_combinations
