!> States on smooth laws of supports: from the state on a polyline through each curve to the state on the curve itself.
!>
!> Each curve is replaced by its tangent where the support is, the beam is solved with that, and so on (Newton), where a tangent
!> leads too far only to the least energy on the way. Tangents are pieces of laws as any others, so each of these solves is an
!> ordinary one; what it converges to is on the curve, to all digits.
module gapbeam_smooth_state
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_tangents
    use gapbeam_tolerances, only: settled_on_laws
    use gapbeam_memory, only: reserve_memory, for_laws
    use gapbeam_error, only: error_type, fatal_error, no_memory, has_ended, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_not_converged
    use gapbeam_laws, only: is_smooth, law_bound, law_slope
    use gapbeam_search, only: rule_block
    use gapbeam_extended_precision, only: rule_given, rule_extended
    use gapbeam_input_error, only: named, of_supports
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_law_energy, only: new_line, go_towards, way_to_rest
    use gapbeam_smooth_energy, only: smooth_line_type
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, past_curve, force_and_slope, deflection_at, largest_deflection, &
        reaction_at, put_line, put_pieces
    use gapbeam_smooth_tangents, only: place_type, find_places, are_settled, put_tangents, last_digit, rounding
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_solution, only: state_type, close_all
    use gapbeam_state, only: solve_state
    implicit none
    private
    public :: solve_on_laws, refuse_laws, audit_laws, place_type

    !> After so many the energy tells how far a tangent leads, which settles from anywhere; tuned
    integer, parameter :: tangents_to_search = 30
    !> So many times that a force may be off its curve when all is done
    real(wp), parameter :: audited = 16
    !> Share by which laws are taken to give less than all that they can, to see whether anything else holds the beam
    real(wp), parameter :: less = 1e-9_wp

contains

    !> Solve at one load factor; without smooth laws as solve_state
    subroutine solve_on_laws(assembled, factor, rule, state, error, near, start)
        !> As for solve_state
        type(assembled_type), intent(in), target :: assembled
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> On the laws, with lines in place of them as its laws; no equilibrium where they give all that they can
        type(state_type), intent(inout) :: state
        !> As for solve_state; or tangents that do not settle
        type(error_type), allocatable, intent(out) :: error
        !> Deflections of the beam at its smooth laws (smooth_supports) in a state nearby, at which tangents begin if that leads on
        real(wp), intent(in), optional :: near(:)
        !> On the ground: where to begin there
        type(ground_start_type), intent(in), optional :: start
        integer, allocatable :: numbers(:)
        logical, allocatable :: closed(:)
        integer :: how

        if (.not. any(is_smooth(assembled%model%supports%law) .and. assembled%beam_support > 0)) then
            call solve_state(assembled, factor, rule, state, error, start)
            return
        end if
        call reserve_memory(for_laws, size(assembled%beam%links), size(assembled%beam%supports), 0, error)
        if (allocated(error)) return
        numbers = smooth_supports(assembled)
        if (allocated(state%laws)) deallocate (state%laws)
        ! A scheme that is known holds on the laws, not on what is in their place
        how = rule
        if (rule == rule_given) how = rule_extended
        if (present(near)) then
            allocate (closed, source=state%closed)
            call begin_with_tangents(assembled, numbers, near, state)
            if (allocated(state%laws)) then
                call solve_state(assembled, factor, how, state, error, start)
                if (is_unique()) call follow_tangents(assembled, numbers, factor, how, state, error)
                if (is_unique()) then
                    call open_and_close(assembled, numbers, state)
                    return
                end if
                if (has_ended(error)) return
                if (allocated(error)) deallocate (error)
                deallocate (state%laws)
                state%closed(:) = closed
            end if
        end if
        if (how == rule_extended) then
            state%laws = assembled%beam%supports
            call put_pieces(assembled, numbers, state%closed, state%laws)
            call go_on()
            if (is_unique() .or. has_ended(error) .or. assembled%depends_on_path) return
            ! The state is one, so that what is not known from polylines is looked for
            if (allocated(error)) deallocate (error)
            if (allocated(state%laws)) deallocate (state%laws)
            call close_all(assembled, state%closed)
            how = rule_block
        end if
        call go_on()

    contains

        !> From polylines, or from pieces of them, to the curves
        subroutine go_on()
            call solve_state(assembled, factor, how, state, error)
            if (allocated(error) .or. state%status /= gapbeam_solved) return
            call follow_tangents(assembled, numbers, factor, how, state, error)
            if (.not. allocated(error)) call open_and_close(assembled, numbers, state)
        end subroutine go_on

        !> Is there one state so far
        pure function is_unique()
            logical :: is_unique

            is_unique = .not. allocated(error)
            if (is_unique) is_unique = state%status == gapbeam_solved .and. .not. state%indifferent
        end function is_unique

    end subroutine solve_on_laws

    !> Put the tangents at given deflections in place of the laws, if all of them have one
    pure subroutine begin_with_tangents(assembled, numbers, deflection, state)
        type(assembled_type), intent(in) :: assembled
        !> Supports of the model with smooth laws, and deflections of the beam there
        integer, intent(in) :: numbers(:)
        real(wp), intent(in) :: deflection(:)
        !> Its laws: not allocated if one has no tangent
        type(state_type), intent(inout) :: state
        real(wp) :: past, force, slope
        integer :: j, way

        state%laws = assembled%beam%supports
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)))
                call past_the_gap(s, deflection(j), past, way)
                call force_and_slope(s, past, force, slope)
                if (slope > huge(slope)) then
                    deallocate (state%laws)
                    return
                end if
                call put_line(assembled, numbers(j), deflection(j), force*way, slope, state%laws)
            end associate
        end do
    end subroutine begin_with_tangents

    !> From a state near the laws to the state on them
    subroutine follow_tangents(assembled, numbers, factor, rule, state, error)
        type(assembled_type), intent(in), target :: assembled
        !> Supports of the model with smooth laws
        integer, intent(in) :: numbers(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        type(state_type), intent(inout) :: state
        type(error_type), allocatable, intent(out) :: error
        type(place_type), allocatable :: places(:)
        type(smooth_line_type) :: line
        real(wp) :: way
        integer :: tangents, solves, stat
        logical :: searching, settled, unique
        type(ground_start_type), allocatable :: start

        allocate (places(size(numbers)), stat=stat)
        if (stat /= 0) call no_memory(error)
        line%assembled => assembled
        if (.not. allocated(error)) call new_line(state%deflection, state%reaction, line, error)
        if (allocated(error)) return
        solves = state%solves
        way = 1.0_wp
        unique = .true.
        searching = .false.
        do tangents = 0, most_tangents - 1
            ! Where nothing else helps
            if (tangents == tangents_to_search) searching = .true.
            call find_places(assembled, numbers, line, searching, places)
            if (.not. all(abs(places%past) <= huge(1.0_wp))) exit
            settled = .false.
            if (tangents > 0 .and. .not. way < 1.0_wp) settled = are_settled(assembled, numbers, tangents, places)
            if (settled) then
                if (searching .and. any(places%steep .and. places%reached > 0.0_wp)) then
                    searching = .false.  ! the last digits come from the forces
                else
                    call audit_laws(assembled, numbers, places, largest_deflection(assembled, line%deflection), &
                                    scale(maxval(abs(line%reaction)), assembled%units%force), error)
                    if (.not. allocated(error) .or. searching) then
                        if (.not. allocated(error)) call see_capacity(assembled, numbers, places, factor, state)
                        state%solves = solves
                        return
                    end if
                    deallocate (error)
                    searching = .true.  ! from a tangent that was put too near
                end if
            end if
            if (.not. allocated(state%laws)) state%laws = assembled%beam%supports
            call put_tangents(assembled, numbers, tangents, searching, places, state%laws)
            if (allocated(state%ground) .and. state%status == gapbeam_solved) then
                if (.not. allocated(start)) allocate (start)
                call start_from(state%ground, state%closed, start)
                unique = unique .and. state%ground%unique
            end if
            call solve_state(assembled, factor, rule, state, error, start)
            if (allocated(state%ground)) state%ground%unique = state%ground%unique .and. unique
            solves = solves + state%solves
            state%solves = solves
            if (allocated(error)) return
            if (state%status == gapbeam_no_equilibrium .and. .not. state%slides) then
                if (let_go(assembled, numbers, places, state%motion)) return
                line%step(:) = state%motion
                line%change(:) = 0.0_wp
                way = way_to_rest(line, assembled%beam%supports, max(sum(assembled%pieces%length), maxval(abs(line%deflection))))
                if (.not. way <= huge(way)) return
                searching = .true.
                line%deflection(:) = line%deflection + way*line%step
                way = 0.0_wp
            else if (state%status == gapbeam_solved) then
                call go_towards(line, assembled%beam%supports, state%deflection, state%reaction, .not. searching, way)
            else
                exit
            end if
        end do
        call refuse_laws(error)
    end subroutine follow_tangents

    !> Refuse laws that tangents do not settle on
    subroutine refuse_laws(error)
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_not_converged, "the smooth laws of the supports could not be met: give them as polylines")
    end subroutine refuse_laws

    !> Do all laws give as much against a motion as they ever can, so that no other state stops it
    pure function let_go(assembled, numbers, places, motion) result(they_do)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: numbers(:)
        type(place_type), intent(in) :: places(:)
        !> Displacements of the nodes, down, shape (0:n)
        real(wp), intent(in) :: motion(0:)
        logical :: they_do
        real(wp) :: moved, force, slope
        integer :: j

        they_do = .true.
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)), p => places(j))
                moved = deflection_at(assembled, motion, numbers(j))
                call force_and_slope(s, p%past, force, slope)
                they_do = .not. abs(moved) > 0.0_wp &
                    .or. (p%way*moved > 0.0_wp .and. force >= (1 - settled_on_laws)*law_bound(s%law, s%parameter)) &
                    .or. (.not. abs(force) > 0.0_wp .and. s%side*moved < 0.0_wp)
            end associate
            if (.not. they_do) return
        end do
    end function let_go

    !> No equilibrium where the load is, to the last digit, all that the laws can ever give: no finite displacement carries it
    subroutine see_capacity(assembled, numbers, places, factor, state)
        type(assembled_type), intent(in), target :: assembled
        integer, intent(in) :: numbers(:)
        type(place_type), intent(in) :: places(:)
        real(wp), intent(in) :: factor
        !> On the laws
        type(state_type), intent(inout) :: state
        type(state_type) :: other
        type(error_type), allocatable :: error
        type(place_type) :: full(size(places))
        real(wp) :: force, slope, bound
        integer :: j

        if (.not. any([(is_full(j), j=1, size(places))])) return
        other = state
        full = places
        ! A little less, and level: does anything else hold the beam
        do j = 1, size(places)
            associate (s => assembled%model%supports(numbers(j)), p => places(j))
                call past_the_gap(s, p%deflection, full(j)%past, full(j)%way)
                call force_and_slope(s, full(j)%past, force, slope)
                force = full(j)%way*reaction_at(assembled, state%reaction, numbers(j))
                if (is_full(j)) then
                    bound = law_bound(s%law, s%parameter)
                    force = (1 - less)*bound
                    slope = 0.0_wp
                end if
                call put_line(assembled, numbers(j), p%deflection, force*full(j)%way, slope, other%laws)
            end associate
        end do
        call solve_state(assembled, factor, rule_block, other, error)
        if (allocated(error)) return
        if (other%status /= gapbeam_no_equilibrium .or. other%slides) return
        if (let_go(assembled, numbers, full, other%motion)) state = other

    contains

        !> Does a law give all that it can
        pure function is_full(i)
            integer, intent(in) :: i
            logical :: is_full

            associate (s => assembled%model%supports(numbers(i)))
                is_full = places(i)%reached >= (1 - settled_on_laws)*law_bound(s%law, s%parameter)
            end associate
        end function is_full

    end subroutine see_capacity

    !> Refuse forces that are off their laws by more than rounding
    subroutine audit_laws(assembled, numbers, places, most, greatest, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: numbers(:)
        type(place_type), intent(in) :: places(:)
        !> The largest deflection and reaction of the beam, of which the others are known to its last digit
        real(wp), intent(in) :: most, greatest
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: force, slope, steep, off, least
        integer :: j

        do j = 1, size(numbers)
            if (places(j)%by_force) cycle
            associate (s => assembled%model%supports(numbers(j)), past => places(j)%past)
                call force_and_slope(s, past, force, slope)
                steep = law_slope(s%law, s%parameter, max(past, 0.0_wp))
            end associate
            if (slope > huge(slope)) cycle
            ! One that only touches may be open by rounding
            if (steep > huge(steep)) steep = 0.0_wp
            off = abs(force - places(j)%reached)
            least = rounding*(abs(force) + slope*maxval(places%size)) + last_digit*(steep*most + greatest)
            if (off <= audited*least) cycle
            call fatal_error(error, gapbeam_not_converged, &
                             trim(named(of_supports, numbers(j), size(assembled%model%supports)))//": law: the result does "// &
                             "not stand its own audit: the force is not that of the law at the deflection; give the law as a "// &
                             "polyline, and report the scene")
            return
        end do
    end subroutine audit_laws

    !> The scheme of the breakpoints in place of laws: open or not, as the laws are
    pure subroutine open_and_close(assembled, numbers, state)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: numbers(:)
        type(state_type), intent(inout) :: state
        real(wp) :: past
        integer :: first, last, pieces, j, k, way

        if (state%status /= gapbeam_solved) return
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)))
                first = assembled%beam_support(numbers(j))
                last = last_breakpoint(assembled%beam%supports, first)
                if (allocated(state%ground)) then
                    ! Nothing looks for the pieces of polylines there: the gap, and the curve on either side of it
                    pieces = merge((last - first + 1)/2, 0, s%side == 0)
                    call past_curve(assembled, numbers(j), state%deflection, state%reaction, past, way)
                    if (past > 0.0_wp .and. .not. (s%side == 0 .and. .not. abs(s%gap) > 0.0_wp)) then
                        pieces = pieces + merge(way, 1, s%side == 0)
                    end if
                    state%closed(first:last) = [(k <= pieces, k=1, last - first + 1)]
                    cycle
                end if
                if (s%side == 0) cycle
                call past_the_gap(s, deflection_at(assembled, state%deflection, numbers(j)), past, way)
                if (past > 0.0_wp) state%closed(first) = .true.
                if (past < 0.0_wp) state%closed(first:last) = .false.
            end associate
        end do
    end subroutine open_and_close

end module gapbeam_smooth_state
