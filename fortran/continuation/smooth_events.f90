!> Load factors of events on smooth laws: where another support passes the end of its piece.
module gapbeam_smooth_events
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, has_ended, gapbeam_solved
    use gapbeam_laws, only: is_smooth, begins_steep
    use gapbeam_search, only: rule_block
    use gapbeam_pieces, only: acting_type, acts_in, gapbeam_open
    use gapbeam_smooth_laws, only: past_curve, reaction_at
    use gapbeam_limits, only: most_tangents
    use gapbeam_tolerances, only: settled_on_laws
    use gapbeam_extended_precision, only: rule_given, rule_extended
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_state, only: solve_on_laws, refuse_laws
    implicit none
    private
    public :: find_on_laws

    !> Where secants lead nowhere the event is looked for on either side, as shares of its factor on polylines; the share within
    !> which no state on either side need be known
    real(wp), parameter :: nearest = 2.0_wp**(-30), farther = 8.0_wp, farthest = 0.5_wp, near_enough = 2.0_wp**(-40)
    !> Share of its factor within which the tangents of the path tell where it is, and other supports mostly stay what they are
    real(wp), parameter :: nearby = 2.0_wp**(-16)
    !> Parts of what is between at which a state is asked for, the second where there is none at the first
    real(wp), parameter :: parts(*) = [0.4375_wp, 0.75_wp]

contains

    !> The load factor at which a support or breakpoint changes its state on the laws, from that on their polylines
    subroutine find_on_laws(assembled, closed, number, factor, error)
        !> As for go_along_tangents
        type(assembled_type), intent(in), target :: assembled
        logical, intent(in) :: closed(:)
        integer, intent(in) :: number
        real(wp), intent(inout) :: factor
        type(error_type), allocatable, intent(out) :: error
        type(acting_type) :: before
        real(wp) :: at, on_polylines
        logical :: found, is_below, is_above, known

        on_polylines = factor
        at = factor
        before = acts_in(assembled, assembled%normal(number), closed)
        call go_along_tangents(assembled, closed, number, at, error)
        if (has_ended(error)) return
        if (.not. allocated(error)) then
            factor = at
            ! Supports that change next to it may have led elsewhere
            call acts_still(assembled, assembled%normal(number), before, at*(1 - near_enough), is_below, known)
            if (known) call acts_still(assembled, assembled%normal(number), before, at*(1 + near_enough), is_above, known)
            if (.not. known) return
            if (is_below .and. .not. is_above) return
        end if
        at = on_polylines
        call halve_between(assembled, assembled%normal(number), before, at, found)
        if (.not. found) return
        factor = at
        if (allocated(error)) deallocate (error)
    end subroutine find_on_laws

    !> Is a support at a load factor in the state before its event
    subroutine acts_still(assembled, support, before, factor, it_does, known)
        type(assembled_type), intent(in), target :: assembled
        !> Number of the support in the model, and what acted of it
        integer, intent(in) :: support
        type(acting_type), intent(in) :: before
        real(wp), intent(in) :: factor
        !> Is that so; is there one state
        logical, intent(out) :: it_does, known
        type(state_type) :: state
        type(error_type), allocatable :: error
        type(acting_type) :: acting
        real(wp) :: past
        integer :: way

        it_does = .false.
        call new_state(assembled, state, error)
        if (.not. allocated(error)) call solve_on_laws(assembled, factor, rule_block, state, error)
        known = .not. allocated(error)
        if (known) known = state%status == gapbeam_solved
        if (.not. known) return
        if (is_smooth(assembled%model%supports(support)%law)) then
            call past_curve(assembled, support, state%deflection, state%reaction, past, way)
            it_does = (past > 0.0_wp) .eqv. before%condition /= gapbeam_open
            return
        end if
        acting = acts_in(assembled, support, state%closed)
        it_does = acting%condition == before%condition .and. acting%way == before%way
    end subroutine acts_still

    !> The same by halving what is between states before and after it, each solved for by itself
    subroutine halve_between(assembled, support, before, factor, found)
        type(assembled_type), intent(in), target :: assembled
        !> Number of the support in the model
        integer, intent(in) :: support
        !> What acted of it before
        type(acting_type), intent(in) :: before
        real(wp), intent(inout) :: factor
        !> Is there one before and one after it
        logical, intent(out) :: found
        real(wp) :: below, above, middle, share
        logical :: is_below, is_above, known
        integer :: k

        share = nearest
        do
            below = factor*(1 - share)
            above = factor*(1 + share)
            call acts_still(assembled, support, before, below, is_below, known)
            found = known .and. is_below
            if (found) call acts_still(assembled, support, before, above, is_above, known)
            found = found .and. known .and. .not. is_above
            if (found) exit
            share = farther*share
            if (share > farthest) return
        end do
        do
            do k = 1, size(parts)
                middle = below + parts(k)*(above - below)
                if (.not. (middle > below .and. middle < above)) exit
                call acts_still(assembled, support, before, middle, is_below, known)
                if (known) exit
            end do
            if (.not. (middle > below .and. middle < above)) exit
            if (.not. known) then
                ! At the event itself next to nothing may hold the beam
                found = above - below <= near_enough*above
                factor = middle
                return
            end if
            if (is_below) then
                below = middle
            else
                above = middle
            end if
        end do
        factor = above
    end subroutine halve_between

    !> The same by secants along the tangents of the path
    subroutine go_along_tangents(assembled, closed, number, factor, error)
        type(assembled_type), intent(in), target :: assembled
        !> The scheme before
        logical, intent(in) :: closed(:)
        !> Support or breakpoint of the beam
        integer, intent(in) :: number
        !> Near in, found out
        real(wp), intent(inout) :: factor
        !> As for solve_on_laws
        type(error_type), allocatable, intent(out) :: error
        type(state_type) :: here, there
        real(wp) :: step, now, then, change
        integer :: tangents

        call new_state(assembled, here, error)
        if (allocated(error)) return
        do tangents = 1, most_tangents
            here%closed(:) = closed
            call solve_on_laws(assembled, factor, rule_given, here, error)
            if (allocated(error)) return
            if (here%status /= gapbeam_solved) then
                call refuse_laws(error)
                return
            end if
            there = here
            there%closed(:) = closed
            step = nearby*factor
            call solve_state(assembled, factor + step, rule_extended, there, error)
            if (allocated(error)) return
            now = margin(here)
            then = margin(there)
            if (.not. abs(then - now) > 0.0_wp) return
            change = step*now/(then - now)
            factor = factor - change
            if (abs(change) <= settled_on_laws*abs(factor)) return
        end do
        call refuse_laws(error)

    contains

        !> What is zero at the event
        pure function margin(state)
            type(state_type), intent(in) :: state
            real(wp) :: margin

            associate (s => assembled%beam%supports(number), support => assembled%normal(number))
                if (closed(number) .and. .not. assembled%with_law(support)) then
                    margin = state%reaction(number)
                else
                    margin = state%deflection(s%node) - s%contact
                    ! Past the beginning of a curve that begins steep the force grows, and the deflection hardly
                    associate (given => assembled%model%supports(support), force => reaction_at(assembled, state%reaction, support))
                        if (begins_steep(given%law, given%parameter) .and. abs(force) > 0.0_wp) margin = force
                    end associate
                end if
            end associate
        end function margin

    end subroutine go_along_tangents

end module gapbeam_smooth_events
