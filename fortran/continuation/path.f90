!> Path of the solution over the load factor, from one change of the contact state to the next.
!>
!> While a scheme acts, all values are linear in the load factor (gapbeam_affine_response). The next event is the smallest factor
!> ahead at which the reaction of a closed support or the opening of an open one becomes zero; it follows from v0 and v1
!> directly, so nothing accumulates along the path. v0 and v1 are kept up to date around the supports that change
!> (gapbeam_update), and a queue holds the factors at which the supports reach zero, so an event costs what it changes, not
!> the whole beam. There are three ways on from an event, each taken where the one before does not do:
!>
!> 1. What moves through zero changes, and then moves the right way. Mostly this is all there is to it.
!> 2. The scheme at a factor a little further up, found by the search, if every value of it is right from the event to there.
!>    So coincident events, and beams that turn until something holds them, are settled at once.
!> 3. The same in quadruple precision with proof (gapbeam_linear_region).
!>
!> A support that changes again at the factor at which it has just changed goes to 2 and 3, so at one factor the first
!> way is taken once for every support at most; 2 and 3 end beyond the factor. A scheme acts on one interval of factors
!> only, so there are finitely many events, and the path ends.
module gapbeam_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: short_beam_links
    use gapbeam_path_tolerances, only: enter_next_interval, agreement, shortest_interval, far_from_zero, same_factor
    use gapbeam_error, only: error_type, fatal_error, has_ended, gapbeam_solved, gapbeam_indeterminate, gapbeam_not_converged
    use gapbeam_memory, only: for_following_closely
    use gapbeam_polyline, only: vertical_pieces
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_rules, only: find_doubtful
    use gapbeam_search, only: rule_block
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_affine_response, only: response_type, value_at, width_at, falls, stays_at_zero
    use gapbeam_static_indeterminacy, only: find_indeterminacy, refuse_indeterminate
    use gapbeam_refined, only: detail_type, refine_beam
    use gapbeam_extended_precision, only: decide_scheme, reserve_for, rule_given
    use gapbeam_contact_state_quad, only: fine_outcome_type => outcome_type
    use gapbeam_affine_response_quad, only: fine_value_at => value_at, fine_width_at => width_at
    use gapbeam_linear_region, only: find_region
    use gapbeam_path_events, only: path_type, add_event, note_changes
    use gapbeam_pieces, only: gapbeam_opens, gapbeam_closes
    use gapbeam_stretch, only: stretch_type, new_stretch, start_stretch, change_supports, add_those_at_zero, next_in_queue, &
        response_in
    implicit none
    private
    public :: follow_path, path_type

contains

    !> Follow the load from one factor to another
    subroutine follow_path(beam, detail, limit, most, factor, closed, marginal, path, outcome, error)
        !> The beam, and what its links are made of
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> Load factor to go to
        real(wp), intent(in) :: limit
        !> Events after which it stops to be called again; up to 5 a support, and one, more may be made
        integer, intent(in) :: most
        !> Load factor of the state at hand in; how far it went out, or above which there is no equilibrium
        real(wp), intent(inout) :: factor
        !> Scheme at that factor
        logical, intent(inout) :: closed(:)
        !> Supports at zero at that factor
        logical, intent(inout) :: marginal(:)
        !> The events, those at the first factor included
        type(path_type), intent(out) :: path
        !> No equilibrium above the factor reached: the beam begins to move
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: stretch
        logical, allocatable :: closed_before(:), marginal_before(:)
        real(wp) :: begin

        allocate (path%factor(max(most, 1)), path%support(max(most, 1)), path%event(max(most, 1)))
        path%most = most
        closed_before = closed
        marginal_before = marginal
        begin = factor
        call new_stretch(beam, stretch)
        call follow(beam, detail, limit, factor, closed, marginal, stretch, path, outcome, error)
        path%solves = stretch%solves
        path%nodes = stretch%nodes
        if (allocated(error) .or. outcome%status /= gapbeam_solved .or. .not. stretch%in_doubt .or. stretch%closely) return
        if (right_at(beam, detail, factor, closed)) return
        ! What double precision could not see mattered
        closed(:) = closed_before
        marginal(:) = marginal_before
        factor = begin
        path%count = 0
        stretch%closely = .true.
        call follow(beam, detail, limit, factor, closed, marginal, stretch, path, outcome, error)
        path%solves = stretch%solves
    end subroutine follow_path

    !> Is the scheme at the end of the path that of the state there
    function right_at(beam, detail, factor, closed) result(right)
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        logical :: right
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical, allocatable :: acting(:)

        allocate (acting, source=closed)
        call find_scheme(beam, detail, factor, rule_block, acting, outcome, error)
        right = .not. allocated(error) .and. outcome%status == gapbeam_solved
        if (right) right = all((acting .eqv. closed) .or. outcome%undecided)
    end function right_at

    !> The scheme at a factor, whatever precision it takes
    subroutine find_scheme(beam, detail, factor, rule, closed, outcome, error)
        !> As for decide_scheme
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work

        call new_workspace(beam, work)
        call set_loads(beam, factor, work)
        call decide_scheme(beam, detail, factor, rule, closed, work, outcome, error)
    end subroutine find_scheme

    !> The same, in one precision after the other
    subroutine follow(beam, detail, limit, factor, closed, marginal, stretch, path, outcome, error)
        !> As for follow_path
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: limit
        real(wp), intent(inout) :: factor
        logical, intent(inout) :: closed(:), marginal(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: at_zero(:)
        real(qp) :: exactly, here
        real(wp) :: begin
        logical :: done
        integer :: k, short_stretches

        short_stretches = 0
        at_zero = pack([(k, k=1, size(closed))], marginal)
        begin = factor
        exactly = factor
        if (.not. stretch%closely) call start_stretch(beam, closed, factor, stretch)
        if (stretch%current) call add_those_at_zero(beam, closed, factor, limit, stretch, at_zero)
        stretch%closely = stretch%closely .or. must_be_close(beam, stretch)
        along: do
            done = .false.
            if (.not. stretch%closely) then
                call change_in_place(beam, factor, closed, at_zero, stretch, path, done)
                if (.not. done) call try_next_event(beam, factor, limit, at_zero, closed, stretch, path, done)
                stretch%closely = must_be_close(beam, stretch)
                done = done .and. .not. stretch%closely
            end if
            here = exactly
            do
                if (.not. done) then
                    call decide_in_quadruple(beam, detail, here, limit, at_zero, closed, stretch, path, outcome, error)
                    if (allocated(error) .or. outcome%status /= gapbeam_solved) exit along
                end if
                call find_next(beam, closed, factor, limit, stretch, at_zero, exactly)
                done = stretch%closely .or. .not. must_be_close(beam, stretch)
                if (done) exit
                stretch%closely = .true.
            end do
            call refuse_redundant_stretch(beam, detail, here, min(exactly, real(limit, qp)), closed, error)
            if (allocated(error)) exit along
            if (exactly - here < shortest_interval*max(abs(factor), limit - begin)) short_stretches = short_stretches + 1
            stretch%in_doubt = stretch%in_doubt .or. short_stretches > 2*size(closed)
            if (short_stretches > 100 + 4*size(closed)) then
                call fatal_error(error, gapbeam_not_converged, "so many supports open and close so near to each other that "// &
                                 "rounding decides, even in quadruple precision: follow the load by steps")
                exit along
            end if
            if (stretch%indifferent > 16 + 4*size(closed)) then
                ! The position is not unique, so supports may be touched here or there, without end
                call fatal_error(error, gapbeam_not_converged, "above this load factor the beam can move freely without work "// &
                                 "of the loads, so there is no single path of its supports: follow the load by steps")
                exit along
            end if
            if (exactly >= limit) at_zero = [integer ::]
            factor = max(factor, real(min(exactly, real(limit, qp)), wp))
            if (exactly >= limit) exit along
            if (path%count >= path%most .and. (factor > begin .or. path%count >= path%most + 3*size(closed))) exit along
        end do along
        marginal = .false.
        marginal(at_zero) = .true.
    end subroutine follow

    !> Is a beam with something in doubt short enough to be followed in quadruple precision throughout
    pure function must_be_close(beam, stretch)
        type(beam_type), intent(in) :: beam
        type(stretch_type), intent(in) :: stretch
        logical :: must_be_close

        must_be_close = stretch%in_doubt .and. size(beam%links) <= short_beam_links
    end function must_be_close

    !> Refuse a stretch on which other reactions would do as well, as the state in its middle tells
    subroutine refuse_redundant_stretch(beam, detail, from, to, closed, error)
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(qp), intent(in) :: from, to
        logical, intent(in) :: closed(:)
        type(error_type), allocatable, intent(out) :: error
        type(outcome_type) :: outcome
        logical, allocatable :: acting(:)
        integer :: node

        ! Not even if the beam touched every support that is open
        call find_indeterminacy(beam, closed, .not. closed, node)
        if (node < 0 .or. .not. to > from) return
        acting = closed
        call find_scheme(beam, detail, real(from + (to - from)/2, wp), rule_given, acting, outcome, error)
        if (allocated(error)) then
            if (error%code /= gapbeam_indeterminate .and. .not. has_ended(error)) deallocate (error)
        else if (outcome%status == gapbeam_solved) then
            call refuse_indeterminate(beam, acting, outcome%undecided, error)
        end if
    end subroutine refuse_redundant_stretch

    !> Change what moves through zero, if that is all there is to do
    subroutine change_in_place(beam, factor, closed, at_zero, stretch, path, done)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        !> Supports at zero, those that stay there out
        integer, allocatable, intent(inout) :: at_zero(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        logical, intent(out) :: done
        integer, allocatable :: moving(:)
        integer :: j

        done = .false.
        if (.not. stretch%current) return
        moving = pack(at_zero, [(falls(response_in(beam, closed, at_zero(j), stretch)), j=1, size(at_zero))])
        if (any(factor - stretch%last_change(moving) <= same_factor*abs(factor))) return
        call change_supports(beam, moving, factor, closed, stretch)
        if (stretch%current) done = .not. any([(falls(response_in(beam, closed, at_zero(j), stretch)), j=1, size(at_zero))])
        do j = 1, size(moving)
            if (beam%supports(moving(j))%breakpoint == 0) cycle
            associate (i => beam%supports(moving(j))%node)
                ! Two that hold a node share what is there as nothing tells
                associate (numbers => beam%order(beam%first(i):beam%first(i + 1) - 1))
                    if (vertical_pieces(beam%supports, closed, numbers) > 1) done = .false.
                end associate
            end associate
        end do
        if (.not. done) then
            ! The lines are those of the scheme tried
            stretch%current = .false.
            closed(moving) = .not. closed(moving)
            return
        end if
        stretch%last_change(moving) = factor
        do j = 1, size(moving)
            call add_event(path, factor, moving(j), merge(gapbeam_closes, gapbeam_opens, closed(moving(j))))
        end do
        at_zero = pack(at_zero, [(stays_at_zero(response_in(beam, closed, at_zero(j), stretch), factor), j=1, size(at_zero))])

    end subroutine change_in_place

    !> Find the scheme a little further up, and whether it acts all the way from the event
    subroutine try_next_event(beam, factor, limit, at_zero, closed, stretch, path, done)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor, limit
        !> Supports at zero, those that stay there out
        integer, allocatable, intent(inout) :: at_zero(:)
        logical, intent(inout) :: closed(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        logical, intent(out) :: done
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        logical, allocatable :: after(:), doubtful(:), was_far(:), is_far(:)
        type(response_type) :: response
        real(wp) :: trial
        integer :: k

        done = .false.
        allocate (after(size(closed)), doubtful(size(closed)), was_far(size(closed)), is_far(size(closed)))
        after(:) = closed
        trial = factor + enter_next_interval*max(abs(factor), limit - factor)
        call new_workspace(beam, work)
        call set_loads(beam, trial, work)
        call find_contact_state(beam, trial, rule_block, after, work, outcome, error)
        stretch%solves = stretch%solves + work%solves
        if (allocated(error) .or. outcome%status /= gapbeam_solved .or. outcome%indifferent) return
        call find_doubtful(beam, after, work, doubtful)
        call start_stretch(beam, after, factor, stretch)
        if (.not. stretch%current) return
        was_far(:) = .true.
        was_far(at_zero) = .false.
        do k = 1, size(closed)
            response = response_in(beam, after, k, stretch)
            if (value_at(response, factor) < -width_at(response, factor) .or. &
                (doubtful(k) .and. .not. stays_at_zero(response, trial))) then
                stretch%current = .false.
                return
            end if
            is_far(k) = value_at(response, factor) > far_from_zero*width_at(response, factor)
        end do
        done = .true.
        call note_changes(factor, closed, after, was_far, is_far, stretch, path)
        closed(:) = after
        at_zero = pack(at_zero, [(stays_at_zero(response_in(beam, closed, at_zero(k), stretch), factor), k=1, size(at_zero))])
    end subroutine try_next_event

    !> Find the next stretch in quadruple precision
    subroutine decide_in_quadruple(beam, detail, factor, limit, at_zero, closed, stretch, path, outcome, error)
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        real(qp), intent(in) :: factor
        real(wp), intent(in) :: limit
        !> Supports at zero, none out
        integer, allocatable, intent(inout) :: at_zero(:)
        logical, intent(inout) :: closed(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(fine_outcome_type) :: found
        logical, allocatable :: was_far(:), is_far(:)

        call reserve_for(for_following_closely, beam, detail, error)
        if (allocated(error)) return
        if (.not. stretch%has_fine) then
            call refine_beam(beam, detail, stretch%fine)
            stretch%has_fine = .true.
        end if
        stretch%current = .false.
        allocate (was_far(size(closed)), is_far(size(closed)))
        was_far(:) = .true.
        was_far(at_zero) = .false.
        call find_region(stretch%fine, factor, real(limit, qp), closed, stretch%region, found, error)
        stretch%solves = stretch%solves + stretch%region%solves
        if (allocated(error)) return
        if (found%status /= gapbeam_solved) then
            outcome = outcome_type(status=found%status)
            outcome%motion = real(found%motion, wp)
            return
        end if
        stretch%by_region = .true.
        if (found%indifferent) stretch%indifferent = stretch%indifferent + 1
        associate (response => stretch%region%responses)
            is_far(:) = fine_value_at(response, factor) > far_from_zero*fine_width_at(response, factor)
        end associate
        call note_changes(real(factor, wp), closed, stretch%region%closed, was_far, is_far, stretch, path)
        closed(:) = stretch%region%closed
        at_zero = [integer ::]
    end subroutine decide_in_quadruple

    !> The next event, and the supports at zero there
    subroutine find_next(beam, closed, factor, limit, stretch, at_zero, next)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor, limit
        type(stretch_type), intent(inout) :: stretch
        !> Supports that stay at zero in, all that are there at the next event out
        integer, allocatable, intent(inout) :: at_zero(:)
        !> Its load factor; huge if there is none
        real(qp), intent(out) :: next
        real(qp) :: to
        real(wp) :: in_doubles
        integer :: k

        if (.not. stretch%by_region) then
            call next_in_queue(beam, closed, factor, limit, stretch, at_zero, in_doubles)
            next = in_doubles
            return
        end if
        ! Lines in double precision will do again if they lead to the same event
        to = stretch%region%to
        if (.not. stretch%closely) call start_stretch(beam, closed, factor, stretch)
        if (stretch%current) then
            call next_in_queue(beam, closed, factor, limit, stretch, at_zero, in_doubles)
            stretch%current = abs(min(in_doubles, limit) - min(to, real(limit, qp))) <= agreement*(limit - factor) &
                .and. min(in_doubles, limit) > factor
        end if
        next = to
        if (stretch%current) return
        stretch%by_region = .true.
        associate (response => stretch%region%responses)
            at_zero = pack([(k, k=1, size(closed))], abs(fine_value_at(response, to)) <= fine_width_at(response, to))
        end associate
    end subroutine find_next

end module gapbeam_path
