!> Start of a load path: supports at rest, settlements, dead loads, and the first contact state.
module gapbeam_history_start
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_link, only: no_load
    use gapbeam_path_tolerances, only: first_share_of_way
    use gapbeam_model, only: coarse_beam_type => beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, coarse_outcome_type => outcome_type, is_solved
    use gapbeam_affine_response, only: drop_live
    use gapbeam_local_step, only: rounded
    use gapbeam_model_quad, only: beam_type
    use gapbeam_contact_state_quad, only: outcome_type
    use gapbeam_linear_region, only: find_region, region_type
    use gapbeam_scene, only: gapbeam_both, gapbeam_live, gapbeam_dead, gapbeam_axial
    use gapbeam_assembled_model, only: assembled_type, way_unit
    implicit none
    private
    public :: find_beginning, find_movements, supports_move, has_dead_loads, has_dead_along, grow_dead_loads, find_rest

contains

    !> The scheme at the first factor above 0
    subroutine find_beginning(beam, in_doubles, to, closed, solves, outcome, error)
        !> The beam, and the same in double precision but for its laws
        type(beam_type), intent(in) :: beam
        type(coarse_beam_type), intent(in) :: in_doubles
        real(qp), intent(in) :: to
        !> Start in, scheme out
        logical, intent(inout) :: closed(:)
        !> Linear solves, added to
        integer, intent(inout) :: solves
        !> Solved, or no equilibrium, with the motion
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: mirrored
        type(region_type) :: region

        mirrored = beam
        if (to < 0.0_qp) call reverse_live(mirrored)
        if (.not. allocated(beam%ground)) call search_in_doubles(beam, in_doubles, to, closed, solves)
        call find_region(mirrored, 0.0_qp, abs(to), closed, region, outcome, error)
        solves = solves + region%solves
        if (allocated(error)) then
            ! Only that the search does not know its way among falling forces: every combination is tried instead
            if (error%code == gapbeam_not_converged) deallocate (error)
            outcome%status = gapbeam_solved
        else if (outcome%status == gapbeam_solved) then
            closed(:) = region%closed
        end if
    end subroutine find_beginning

    !> What doubles find is most of the way, where no force falls and the beam is held: there is one scheme then
    subroutine search_in_doubles(beam, in_doubles, to, closed, solves)
        !> As for find_beginning
        type(beam_type), intent(in) :: beam
        type(coarse_beam_type), intent(in) :: in_doubles
        real(qp), intent(in) :: to
        logical, intent(inout) :: closed(:)
        integer, intent(inout) :: solves
        type(coarse_beam_type) :: rough
        type(workspace_type) :: work
        type(coarse_outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical :: found(size(closed))
        real(wp) :: factor

        if (any(beam%supports%breakpoint > 0 .and. min(beam%supports%before, beam%supports%stiffness) < 0.0_qp)) return
        rough = in_doubles
        rough%supports = rounded(beam%supports, in_doubles%supports)
        factor = real(first_share_of_way*to, wp)
        found(:) = closed
        call new_workspace(rough, work)
        call set_loads(rough, factor, work)
        call find_contact_state(rough, factor, rule_block, found, work, outcome, error)
        solves = solves + work%solves
        if (is_solved(outcome, error) .and. .not. outcome%indifferent) closed(:) = found
    end subroutine search_in_doubles

    !> Settlements and lacks of fit, in the engine's units
    pure subroutine find_movements(assembled, movement)
        type(assembled_type), intent(in) :: assembled
        !> Of the supports of the engine
        real(qp), intent(out) :: movement(:)
        integer :: k

        do k = 1, size(movement)
            associate (s => assembled%model%supports(assembled%normal(k)))
                movement(k) = scale(s%settlement + s%side*min(s%gap, 0.0_wp), -way_unit(assembled, assembled%normal(k)))
            end associate
        end do
    end subroutine find_movements

    !> Do supports move by themselves while the dead loads are put on
    pure function supports_move(assembled) result(they_do)
        type(assembled_type), intent(in) :: assembled
        logical :: they_do

        associate (s => assembled%model%supports)
            they_do = any(abs(s%settlement) > 0.0_wp .or. s%gap < 0.0_wp)
        end associate
    end function supports_move

    !> The beam while its dead loads are put on: they grow with the factor, as movements of supports do, and there is no other load;
    !> in the same units
    pure subroutine grow_dead_loads(assembled, dead)
        type(assembled_type), intent(in) :: assembled
        type(assembled_type), intent(out) :: dead

        dead = assembled
        call drop_live(assembled%beam, dead%beam)
        dead%live(:) = assembled%dead
        dead%dead(:) = no_load
        call let_supports_move(assembled, dead)
        if (allocated(dead%axial%force)) then
            dead%axial%force(2, :) = dead%axial%force(1, :)
            dead%axial%force(1, :) = 0.0_wp
        end if
        if (allocated(dead%axial%elongation)) then
            dead%axial%elongation(2, :) = dead%axial%elongation(1, :)
            dead%axial%elongation(1, :) = 0.0_wp
        end if
        if (allocated(dead%axial%along_bar)) then
            dead%axial%along_bar(2, :) = dead%axial%along_bar(1, :)
            dead%axial%along_bar(1, :) = 0.0_wp
        end if
        where (dead%model%loads%case == gapbeam_dead)
            dead%model%loads%case = gapbeam_live
        else where
            dead%model%loads%value = 0.0_wp
            dead%model%loads%value_to = 0.0_wp
        end where
    end subroutine grow_dead_loads

    !> What supports move by themselves grows with the dead loads, from where they stand without it
    pure subroutine let_supports_move(assembled, dead)
        type(assembled_type), intent(in) :: assembled
        !> The same beam in
        type(assembled_type), intent(inout) :: dead
        real(qp) :: movement(size(assembled%normal))

        if (allocated(dead%growth)) deallocate (dead%growth)
        if (.not. supports_move(assembled)) return
        call find_movements(assembled, movement)
        dead%beam%supports%contact = real(assembled%beam%supports%contact - movement, wp)
        associate (s => assembled%model%supports)
            dead%growth = s%settlement + s%side*min(s%gap, 0.0_wp)
            dead%model%supports%settlement = s%settlement - dead%growth
        end associate
    end subroutine let_supports_move

    !> Let the live loads act the other way
    subroutine reverse_live(beam)
        type(beam_type), intent(inout) :: beam
        integer :: i

        beam%force(2, :) = -beam%force(2, :)
        beam%couple(2, :) = -beam%couple(2, :)
        do i = 1, size(beam%links)
            associate (link => beam%links(i))
                link%turn_a(2) = -link%turn_a(2)
                link%turn_b(2) = -link%turn_b(2)
                link%shear_a(2) = -link%shear_a(2)
                link%shear_b(2) = -link%shear_b(2)
            end associate
        end do
    end subroutine reverse_live

    !> Are there any dead loads
    pure function has_dead_loads(beam) result(has)
        type(beam_type), intent(in) :: beam
        logical :: has
        integer :: i

        has = any(abs(beam%force(1, :)) > 0.0_qp) .or. any(abs(beam%couple(1, :)) > 0.0_qp)
        do i = 1, size(beam%links)
            associate (link => beam%links(i))
                has = has .or. link%load_sum(1) > 0.0_qp .or. link%turn_sum(1) > 0.0_qp
            end associate
        end do
    end function has_dead_loads

    !> Do dead loads, settlements or lacks of fit act along the beam, where its links act one way, yield or rub
    pure function has_dead_along(assembled) result(has)
        type(assembled_type), intent(in) :: assembled
        logical :: has

        associate (axial => assembled%axial, s => assembled%model%supports)
            has = allocated(axial%laws) .or. allocated(axial%limit)
            if (.not. has) return
            has = any(abs(axial%force(1, :)) > 0.0_wp) &
                .or. any(s%direction == gapbeam_axial .and. (abs(s%settlement) > 0.0_wp .or. s%gap < 0.0_wp))
            if (allocated(axial%elongation)) has = has .or. any(abs(axial%elongation(1, :)) > 0.0_wp)
        end associate
    end function has_dead_along

    !> Where supports are before any load: on the piece on which the straight beam is
    subroutine find_rest(assembled, closed)
        type(assembled_type), intent(in) :: assembled
        logical, intent(out) :: closed(:)
        integer :: k, last, middle

        k = 1
        do while (k <= size(closed))
            last = last_breakpoint(assembled%beam%supports, k)
            middle = 1
            if (assembled%model%supports(assembled%normal(k))%side == gapbeam_both) then
                middle = max(1, (last - k + 1)/2)
            else if (assembled%beam%supports(k)%side*assembled%beam%supports(k)%contact > 0.0_wp) then
                middle = 0
            end if
            closed(k:last) = .false.
            closed(k:k + middle - 1) = .true.
            k = last + 1
        end do
    end subroutine find_rest

end module gapbeam_history_start
