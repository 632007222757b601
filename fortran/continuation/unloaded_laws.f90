!> Laws of supports that keep a set beside smooth laws, as they are on these, and not on their polylines.
!>
!> A support that turns back where a leg ends has its law written anew from the state there, which is the only one where no force
!> falls. Where one turns back on the way, the polylines alone tell at which load factor: what follows is known on these only.
module gapbeam_unloaded_laws
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, has_ended, gapbeam_solved
    use gapbeam_laws, only: is_smooth
    use gapbeam_scene, only: gapbeam_plastic
    use gapbeam_polyline, only: node_support_type
    use gapbeam_unloading, only: rewrite_laws
    use gapbeam_search, only: rule_block
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_pieces, only: acts_in, what_happens, gapbeam_unloads
    use gapbeam_history_stretch, only: enter_stretch
    use gapbeam_history_record, only: history_type, pieces_type, find_pieces, scheme_at
    use gapbeam_path_on_laws, only: through, unknown
    implicit none
    private
    public :: mark_unloading, write_laws_of_legs, find_unloaded

contains

    !> Note from which stretch on a support has turned back, and that ends of stretches from there on are known on polylines only
    subroutine mark_unloading(assembled, history)
        type(assembled_type), intent(in) :: assembled
        !> With its ends as they would be known
        type(history_type), intent(inout) :: history
        type(pieces_type) :: before, after
        integer, allocatable :: supports(:)
        integer :: k, n

        n = history%number
        allocate (supports, source=pack(assembled%normal, keeps_set(assembled) .and. assembled%beam%supports%breakpoint == 1))
        associate (s => history%stretches, known => history%on_laws)
            known%unloaded(:) = n + 1
            if (size(supports) == 0 .or. n == 0) return
            call find_pieces(history, 1, after)
            do k = 1, n - 1
                if (known%unloaded(2) <= n) exit
                before = after
                call enter_stretch(s(k + 1), after)
                if (.not. turns_back(assembled, supports, before, after)) cycle
                known%unloaded(1) = min(known%unloaded(1), k + 1)
                if (s(k)%leg == s(k + 1)%leg) known%unloaded(2) = k + 1
            end do
            do k = known%unloaded(1), n
                if (known%joins(k) /= through) known%joins(k) = unknown
            end do
        end associate
    end subroutine mark_unloading

    !> Supports of the engine that unload parallel to their first piece, and whose laws are no curves, shape (size(supports))
    pure function keeps_set(assembled) result(it_does)
        type(assembled_type), intent(in) :: assembled
        logical :: it_does(size(assembled%normal))

        associate (s => assembled%model%supports(assembled%normal))
            it_does(:) = s%unloading == gapbeam_plastic .and. .not. is_smooth(s%law)
        end associate
    end function keeps_set

    !> Does one of some supports turn back between two stretches
    pure function turns_back(assembled, supports, before, after) result(it_does)
        type(assembled_type), intent(in) :: assembled
        !> Of the model
        integer, intent(in) :: supports(:)
        type(pieces_type), intent(in) :: before, after
        logical :: it_does
        integer :: i

        it_does = .false.
        do i = 1, size(supports)
            it_does = what_happens(acts_in(assembled, supports(i), before%closed, before%laws), &
                                   acts_in(assembled, supports(i), after%closed, after%laws)) == gapbeam_unloads
            if (it_does) return
        end do
    end function turns_back

    !> Write the laws with which every leg begins on the smooth laws, as far as they are known there
    subroutine write_laws_of_legs(assembled, history, error)
        type(assembled_type), intent(in), target :: assembled
        type(history_type), intent(inout) :: history
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), target :: changed
        type(state_type) :: state
        real(wp) :: factor
        integer :: leg, last

        associate (s => history%stretches(:history%number), known => history%on_laws)
            if (.not. known%unique .or. known%unloaded(1) > size(s)) return
            allocate (known%of_legs(0:s(size(s))%leg))
            changed = assembled
            do leg = 0, s(size(s))%leg
                known%of_legs(leg)%laws = changed%beam%supports
                last = findloc(s%leg, leg, 1, back=.true.)
                if (last == 0 .or. leg == s(size(s))%leg) cycle
                if (last >= known%unloaded(2)) return
                ! The dead loads in full are those of load factor 0
                factor = merge(0.0_wp, known%rough(2, last), leg == 0)
                call solve_with(changed, factor, scheme_at(history, last), state, error)
                if (allocated(error)) return
                if (state%status /= gapbeam_solved) return
                associate (laws => changed%beam%supports)
                    call rewrite_laws(laws, state%closed, keeps_set(assembled), assembled%beam%supports%stiffness, &
                                      state%deflection(laws%node), state%reaction)
                end associate
            end do
        end associate
    end subroutine write_laws_of_legs

    !> The state on the laws of a leg; not solved where that is not found
    subroutine solve_with(changed, factor, closed, state, error)
        !> With these laws
        type(assembled_type), intent(in), target :: changed
        real(wp), intent(in) :: factor
        !> Where the search for its scheme starts
        logical, intent(in) :: closed(:)
        type(state_type), intent(out) :: state
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error

        call new_state(changed, state, error)
        if (allocated(error)) return
        state%closed(:) = closed
        call solve_on_laws(changed, factor, rule_block, state, error)
        if (.not. allocated(error)) return
        state%status = -1
        if (.not. has_ended(error)) deallocate (error)
    end subroutine solve_with

    !> Lines in place of the smooth laws in the state at a load factor on a stretch from which on a support has turned back
    subroutine find_unloaded(assembled, history, stretch, factor, laws, told, error)
        type(assembled_type), intent(in) :: assembled
        !> By write_laws_of_legs
        type(history_type), intent(in) :: history
        !> The stretch in, that with the scheme out
        integer, intent(inout) :: stretch
        real(wp), intent(in) :: factor
        !> Of all supports
        type(node_support_type), allocatable, intent(out) :: laws(:)
        !> If not, the state is known on the polylines only
        logical, intent(out) :: told
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), target :: changed
        type(state_type) :: state
        integer, allocatable :: numbers(:)
        integer :: k

        told = .false.
        associate (s => history%stretches(:history%number), known => history%on_laws)
            if (.not. allocated(known%of_legs) .or. stretch >= known%unloaded(2)) return
            if (.not. allocated(known%of_legs(s(stretch)%leg)%laws)) return
            changed = assembled
            changed%beam%supports(:) = known%of_legs(s(stretch)%leg)%laws
            call solve_with(changed, factor, scheme_at(history, stretch), state, error)
            if (allocated(error)) return
            if (state%status /= gapbeam_solved) return
            allocate (numbers, source=pack([(k, k=1, size(assembled%normal))], &
                                           .not. is_smooth(assembled%model%supports(assembled%normal)%law)))
            do k = 1, size(s)
                if (s(k)%leg /= s(stretch)%leg) cycle
                associate (closed => scheme_at(history, k))
                    told = all(closed(numbers) .eqv. state%closed(numbers))
                end associate
                if (told) exit
            end do
        end associate
        if (.not. told) return
        stretch = k
        call move_alloc(state%laws, laws)
    end subroutine find_unloaded

end module gapbeam_unloaded_laws
