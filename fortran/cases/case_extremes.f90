!> Largest and smallest values of the fields of many solved cases of a beam.
!> Eight side by side (files lane_*), from the solutions at the nodes: whatever solved them, and whatever the company of a case,
!> its digits are the same.
module gapbeam_case_extremes
    use gapbeam_kinds, only: wp
    use gapbeam_piece, only: is_prismatic
    use gapbeam_tolerances, only: most_unit_power
    use gapbeam_watch, only: is_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_memory, gapbeam_stopped
    use gapbeam_model, only: has_other_supports
    use gapbeam_units, only: moment_unit, rotation_unit, stiffness_unit, quantity_unit
    use gapbeam_assembled_model, only: assembled_type, place_x, is_alone
    use gapbeam_solution, only: state_type
    use gapbeam_quantities, only: bending_count, bending
    use gapbeam_query, only: extremes_of_fields, fields_in_pieces
    use gapbeam_case_types, only: case_numbers_type, case_solutions_type, remaining
    use gapbeam_cases, only: case_loads_type
    use gapbeam_combinations, only: combination_type, combine_case, solve_combination
    use gapbeam_lane_types, only: lanes, lane_pieces_type, piece_pack_type, new_piece_pack
    use gapbeam_lane_pieces, only: prepare_pieces
    use gapbeam_lane_blocks, only: block_type, make_block, take_cases, take_solutions
    implicit none
    private
    public :: case_fields_type, has_lane_extremes, extremes_of_cases
    !> Fields of cases, in the scene's units
    type :: case_fields_type
        !> Maximum and minimum of quantities of bending, and where they are, shape (2, bending_count, ncase)
        real(wp), pointer, contiguous :: extremes(:, :, :) => null(), places(:, :, :) => null()
        !> All of them at places, shape (bending_count, at least n, ncase)
        real(wp), pointer, contiguous :: fields(:, :, :) => null()
    end type case_fields_type

contains

    !> Are the extremes of the cases of a beam found here: no ground, laws, axial system
    pure function has_lane_extremes(assembled) result(yes)
        type(assembled_type), intent(in) :: assembled
        logical :: yes

        associate (beam => assembled%beam, units => assembled%units)
            yes = .not. (allocated(beam%ground) .or. has_other_supports(beam) .or. allocated(assembled%axial%point) &
                        .or. .not. all(is_prismatic(assembled%pieces)) &
                        .or. any(is_alone(assembled%model%loads))) &
                .and. max(abs(units%deflection), abs(units%force), abs(units%length), abs(moment_unit(units)), &
                          abs(rotation_unit(units)), abs(stiffness_unit(units))) < most_unit_power
        end associate
    end function has_lane_extremes

    !> Find the extremes of solved cases of such a beam, and fields at places
    subroutine extremes_of_cases(assembled, loads, numbers, solutions, wanted, piece, distance, found, level)
        type(assembled_type), intent(in) :: assembled
        !> By split_loads
        type(case_loads_type), intent(in) :: loads
        type(case_numbers_type), intent(in) :: numbers
        !> By solve_cases, reactions null; status out an error where one is found
        type(case_solutions_type), intent(inout) :: solutions
        !> Which quantities of bending (gapbeam_quantities) are asked for
        logical, intent(in) :: wanted(bending_count)
        !> Places of fields (piece, and distance from its left end in the scene's units), shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Of cases that are not solved as they were
        type(case_fields_type), intent(inout) :: found
        !> Instructions (gapbeam_cpu_dispatch); default the best that there are
        integer, intent(in), optional :: level
        type(block_type) :: block
        type(lane_pieces_type) :: pieces
        type(piece_pack_type) :: along
        type(combination_type) :: combined
        integer, allocatable :: which(:)
        real(wp), allocatable :: at_places(:, :, :)
        real(wp) :: extremes(lanes, 6, bending_count), poor(lanes)
        integer :: first, l, stat
        logical :: made, fits(lanes)

        if (present(level)) block%level = level
        call make_block(assembled, loads, numbers, block)
        made = block%made
        if (made) call prepare_pieces(assembled, size(block%beam%links, 1), pieces, made)
        if (made) call new_piece_pack(size(pieces%length), along, made)
        stat = 0
        if (made) allocate (at_places(lanes, size(piece), bending_count), stat=stat)
        if (.not. made .or. stat /= 0) then
            solutions%status(:) = gapbeam_no_memory
            return
        end if
        which = remaining(solutions%status /= gapbeam_solved)
        extremes(:, :, :) = 0.0_wp
        do first = 1, size(which), lanes
            if (is_stopped(assembled%beam%watch)) exit
            call take_cases(assembled, numbers, solutions%closed, which(first:), block, fits)
            call take_solutions(assembled, solutions, block)
            if (associated(numbers%spans)) then
                pieces%flexibility(:, :) = block%spans%flexibility
                pieces%shear_flexibility(:, :) = block%spans%shear_flexibility
            end if
            poor(:) = 1.0_wp
            if (any(wanted) .and. any(fits)) then
                call block%compiled%extremes_of_pack(block%beam, pieces, wanted, block%factors, block%pack, along, extremes, poor)
            end if
            if (size(piece) > 0 .and. any(fits)) then
                call block%compiled%fields_of_pack(block%beam, pieces, block%factors, block%pack, along, piece, &
                                                   scale(distance, -assembled%units%length), at_places, poor)
            end if
            do l = 1, block%cases
                associate (i => block%case_of(l))
                    fits(l) = fits(l) .and. poor(l) < 0.5_wp
                    if (fits(l)) call give_extremes(assembled, wanted, extremes, l, found%extremes(:, :, i), &
                                                    found%places(:, :, i), fits(l))
                    if (fits(l)) call give_fields(assembled, at_places, l, found%fields(:, :, i), fits(l))
                    if (.not. fits(l)) call solve_again(assembled, numbers, i, wanted, piece, distance, combined, solutions, found)
                end associate
            end do
        end do
        if (is_stopped(assembled%beam%watch)) solutions%status(:) = gapbeam_stopped
    end subroutine extremes_of_cases

    !> Solve a case once more, whose fields are not to be had from its solution
    subroutine solve_again(assembled, numbers, i, wanted, piece, distance, combined, solutions, found)
        !> As for extremes_of_cases, and the case
        type(assembled_type), intent(in) :: assembled
        type(case_numbers_type), intent(in) :: numbers
        integer, intent(in) :: i
        logical, intent(in) :: wanted(bending_count)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Of an earlier case, or empty
        type(combination_type), intent(inout) :: combined
        type(case_solutions_type), intent(inout) :: solutions
        type(case_fields_type), intent(inout) :: found
        type(state_type) :: state
        type(error_type), allocatable :: error
        real(wp) :: value(2, bending_count), x(2, bending_count), all_fields(bending_count, size(piece))
        integer :: k

        call combine_case(assembled, numbers, i, combined, error)
        if (.not. allocated(error)) then
            associate (m => size(assembled%beam%supports))
                call solve_combination(combined%assembled, numbers%rule, solutions%closed(:m, i) /= 0, state, error)
            end associate
        end if
        if (.not. allocated(error)) then
            solutions%status(i) = state%status
            if (state%status /= gapbeam_solved) return
            call extremes_of_fields(combined%assembled, state, bending, value, x, error)
        end if
        if (.not. allocated(error)) call fields_in_pieces(combined%assembled, 1.0_wp, state%starts, state%displacement, &
                                                          state%tension, bending, piece, distance, all_fields, error)
        if (allocated(error)) then
            solutions%status(i) = error%code
            return
        end if
        do k = 1, bending_count
            if (.not. wanted(k)) cycle
            found%extremes(:, k, i) = value(:, k)
            found%places(:, k, i) = x(:, k)
        end do
        found%fields(:, :size(piece), i) = all_fields
    end subroutine solve_again

    !> The extremes of a case in the scene's units, if these hold them
    pure subroutine give_extremes(assembled, wanted, found, l, extremes, places, made)
        type(assembled_type), intent(in) :: assembled
        logical, intent(in) :: wanted(bending_count)
        !> By extremes_of_pack, and the lane
        real(wp), intent(in) :: found(lanes, 6, bending_count)
        integer, intent(in) :: l
        real(wp), intent(inout) :: extremes(:, :), places(:, :)
        logical, intent(out) :: made
        real(wp) :: value
        integer :: powers(bending_count), i, k, piece

        powers = quantity_unit(assembled%units, bending)
        made = .true.
        do k = 1, bending_count
            if (.not. wanted(k)) cycle
            do i = 1, 2
                value = scale(found(l, 3*i - 2, k), powers(k))
                made = made .and. abs(value) <= huge(value)
                piece = int(found(l, 3*i - 1, k))
                extremes(i, k) = value
                places(i, k) = place_x(assembled, piece, found(l, 3*i, k))
            end do
        end do
    end subroutine give_extremes

    !> Fields of a case at places likewise
    pure subroutine give_fields(assembled, found, l, fields, made)
        type(assembled_type), intent(in) :: assembled
        !> By fields_of_pack, and the lane
        real(wp), intent(in) :: found(:, :, :)
        integer, intent(in) :: l
        real(wp), intent(inout) :: fields(:, :)
        logical, intent(out) :: made
        integer :: powers(bending_count), i

        powers = quantity_unit(assembled%units, bending)
        made = .true.
        do i = 1, size(found, 2)
            fields(:, i) = scale(found(l, i, :), powers)
            made = made .and. all(abs(fields(:, i)) <= huge(1.0_wp))
        end do
    end subroutine give_fields

end module gapbeam_case_extremes
