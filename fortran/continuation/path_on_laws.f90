!> The path of a beam with smooth laws as it is on their polylines, and the ends of its stretches that are known on the laws.
!>
!> On a polyline the path bends wherever a support passes a breakpoint, which is nothing on the law. What there is between two
!> stretches is told here, and where they end on the laws is found along arcs about them (gapbeam_smooth_arc).
module gapbeam_path_on_laws
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, failed
    use gapbeam_path_tolerances, only: nothing_on_arc, wide_of_polyline
    use gapbeam_laws, only: is_smooth, law_scale
    use gapbeam_polyline, only: node_support_type
    use gapbeam_extended_precision, only: rule_extended
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_state, only: solve_state
    use gapbeam_pieces, only: acting_type, acts_in
    use gapbeam_smooth_laws, only: smooth_supports, deflections_at_curves
    use gapbeam_smooth_arc, only: arc_type, new_arc, lose
    use gapbeam_arc_states, only: eigenvalues_at, wrongness_of
    use gapbeam_arc_roots, only: arc_test_type, of_factor, of_breakpoint, find_root
    use gapbeam_history_record, only: history_type, pieces_type, find_pieces, scheme_at, laws_at, same_laws, no_limit
    implicit none
    private
    public :: view_type, begin_on_laws, join_after, beam_of, end_of, arc_about, is_near, keep_end, forget_end, check_on_laws, &
        find_at, begin_of_leg, goal_of_leg, way_of_leg, passed_ends, is_known, start_of_stretch, stop_of_stretch
    public :: through, given_factor, turns_round, branches, event, unknown

    !> What there is at the end of a stretch: nothing on the laws; a load factor that is gone to; the load turns round; the beam
    !> begins to give way to another side; another support passes an end of its piece; what is not to be found on the laws
    integer, parameter :: through = 0, given_factor = 1, turns_round = 2, branches = 3, event = 4, unknown = 5
    !> Ends of a stretch
    integer, parameter :: start_of_stretch = 1, stop_of_stretch = 2

    !> A path that is put onto the laws
    type :: view_type
        !> The beam; the same with its dead loads as live ones, as they grow before the path, null if supports move with them
        type(assembled_type), pointer :: assembled => null(), dead => null()
        !> The path, with load factors on the laws where they are known
        type(history_type), pointer :: history => null()
        !> The last load factor that is gone to, and whether the path ends at its first limit
        real(wp) :: target = 0.0_wp
        logical :: stops = .false.
    end type view_type

contains

    !> Begin: nothing is known on the laws yet
    subroutine begin_on_laws(view, error)
        !> With its beams and its history
        type(view_type), intent(inout) :: view
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: numbers(:)
        type(node_support_type), allocatable :: laws(:)
        integer :: k, j, stat

        associate (h => view%history, n => view%history%number)
            allocate (h%on_laws, stat=stat)
            if (stat == 0) allocate (h%on_laws%joins(n), h%on_laws%rough(2, n), h%on_laws%ends(2, n), h%on_laws%lands(n), stat=stat)
            if (failed(stat, error)) return
            associate (s => h%stretches, known => h%on_laws)
                do k = 1, n
                    known%rough(:, k) = [s(k)%from, s(k)%to]
                end do
                allocate (numbers, source=smooth_supports(view%assembled))
                known%size(:) = 0.0_wp
                do j = 1, size(numbers)
                    associate (support => view%assembled%model%supports(numbers(j)))
                        known%size(1) = max(known%size(1), law_scale(support%law, support%parameter))
                    end associate
                end do
                if (n > 0) known%size(2) = maxval(abs(known%rough))
                ! Where no force falls there is one state only, and tangents lead to it
                known%unique = .true.
                do k = 1, n
                    if (k > 1 .and. .not. allocated(s(k)%laws)) exit
                    laws = laws_at(view%assembled, h, k)
                    known%unique = known%unique .and. all(laws%stiffness >= 0.0_wp .and. laws%before >= 0.0_wp)
                end do
                ! Where a jump has landed, a stretch begins at the load factor of the limit
                known%lands(:) = .false.
                do j = 1, size(h%limits)
                    k = h%limits(j)%landing
                    if (k > 1) known%lands(k) = s(k - 1)%skipped .and. .not. s(k)%skipped
                end do
                do k = 1, n
                    known%joins(k) = join_after(view, k)
                end do
            end associate
        end associate
    end subroutine begin_on_laws

    !> What there is at the end of a stretch
    function join_after(view, k) result(join)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k
        integer :: join

        associate (h => view%history, s => view%history%stretches(k))
            if (s%direction == 0 .or. (s%leg == 0 .and. .not. associated(view%dead))) then
                join = unknown
            else if (k == h%number) then
                join = merge(given_factor, unknown, h%ending == no_limit .and. .not. abs(s%to - view%target) > 0.0_wp)
            else
                join = join_between(view, k)
            end if
        end associate
    end function join_after

    !> What there is between a stretch and the next one
    function join_between(view, k) result(join)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k
        integer :: join
        logical :: turns

        associate (h => view%history, s => view%history%stretches(k), next => view%history%stretches(k + 1))
            turns = s%direction /= next%direction
            if (next%leg /= s%leg) then
                join = given_factor
            else if (next%direction == 0) then
                join = unknown
            else if (turns .and. .not. same_laws(laws_at(view%assembled, h, k), laws_at(view%assembled, h, k + 1))) then
                join = unknown  ! laws written anew where the load turns round
            else if (size(passed_ends(view, k)) > 0) then
                join = event
            else if (turns .and. next%ways == 1) then
                join = turns_round
            else
                join = merge(branches, through, turns .or. s%index /= next%index .or. next%ways > 1)
            end if
        end associate
    end function join_between

    !> Ends of pieces that are passed from a stretch to the next one; along a smooth law only where it begins
    function passed_ends(view, k) result(ends)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k
        type(arc_test_type), allocatable :: ends(:)
        type(acting_type) :: piece, after
        type(pieces_type) :: a, b
        integer :: j
        logical :: by_force

        allocate (ends(0))
        call find_pieces(view%history, k, a)
        call find_pieces(view%history, k + 1, b)
        associate (beam => view%assembled)
            do j = 1, size(a%closed)
                if (a%closed(j) .eqv. b%closed(j)) cycle
                by_force = a%closed(j)
                associate (i => beam%normal(j))
                    if (beam%with_law(i)) then
                        piece = acts_in(beam, i, a%closed, a%laws)
                        if (is_smooth(beam%model%supports(i)%law)) then
                            after = acts_in(beam, i, b%closed, a%laws)
                            if (piece%condition == after%condition) cycle
                        end if
                        by_force = abs(piece%slope) > huge(piece%slope)
                    end if
                end associate
                if (allocated(a%laws)) then
                    ends = [ends, arc_test_type(of_breakpoint, j, a%laws(j)%contact, a%laws(j)%force, by_force)]
                else
                    associate (s => beam%beam%supports(j))
                        ends = [ends, arc_test_type(of_breakpoint, j, s%contact, s%force, by_force)]
                    end associate
                end if
            end do
        end associate
    end function passed_ends

    !> The beam on a stretch
    function beam_of(view, k) result(beam)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k
        type(assembled_type), pointer :: beam

        beam => view%assembled
        if (view%history%stretches(k)%leg == 0) beam => view%dead
    end function beam_of

    !> Is an end of a stretch known on the laws
    pure function is_known(view, k, which) result(it_is)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k, which
        logical :: it_is

        it_is = allocated(view%history%on_laws%ends(which, k)%x)
    end function is_known

    !> Deflections at the smooth laws and load factor at an end of a stretch: on the laws where that is known, else on the polylines
    subroutine end_of(view, k, which, point, error)
        type(view_type), intent(in) :: view
        !> The stretch, and which end
        integer, intent(in) :: k, which
        real(wp), allocatable, intent(out) :: point(:)
        !> There is no such state
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), pointer :: beam
        type(state_type) :: state
        real(wp) :: factor

        associate (s => view%history%stretches(k), known => view%history%on_laws)
            if (is_known(view, k, which)) then
                point = [known%ends(which, k)%x, merge(s%from, s%to, which == start_of_stretch)]
                return
            end if
            factor = known%rough(which, k)
            if (which == start_of_stretch .and. known%lands(k)) factor = known%rough(stop_of_stretch, k - 1)
            beam => beam_of(view, k)
            call new_state(beam, state, error)
            if (allocated(error)) return
            state%closed(:) = scheme_at(view%history, k)
            allocate (state%laws, source=laws_at(beam, view%history, k))
            call solve_state(beam, factor, rule_extended, state, error)
            if (.not. allocated(error) .and. state%status /= gapbeam_solved) call lose(error)
            if (.not. allocated(error)) point = [deflections_at_curves(beam, state%deflection), factor]
        end associate
    end subroutine end_of

    !> The path about some stretches, as far as it is one and so long that its direction on the polylines is right
    subroutine arc_about(view, from, to, arc, error, forward, turn)
        type(view_type), intent(in) :: view
        !> The stretches
        integer, intent(in) :: from, to
        type(arc_type), intent(out) :: arc
        !> As for new_arc
        type(error_type), allocatable, intent(out) :: error
        !> Does it go on beyond the last stretch, default yes; and the stretch at whose end the load turns round
        logical, intent(in), optional :: forward
        integer, intent(in), optional :: turn
        real(wp), allocatable :: start(:), stop(:), turning(:)
        integer :: first, last

        first = from
        last = to
        call end_of(view, first, start_of_stretch, start, error)
        if (.not. allocated(error)) call end_of(view, last, stop_of_stretch, stop, error)
        do while (first > 1 .and. .not. allocated(error))
            if (is_known(view, first, start_of_stretch) .or. view%history%on_laws%joins(first - 1) /= through) exit
            if (.not. is_near(view, start, stop, 1)) exit
            first = first - 1
            call end_of(view, first, start_of_stretch, start, error)
        end do
        do while (.not. allocated(error))
            if (present(forward)) then
                if (.not. forward) exit
            end if
            if (is_known(view, last, stop_of_stretch) .or. view%history%on_laws%joins(last) /= through) exit
            if (.not. is_near(view, start, stop, 2)) exit
            last = last + 1
            call end_of(view, last, stop_of_stretch, stop, error)
        end do
        ! What is not allocated is not present
        if (present(turn) .and. .not. allocated(error)) call end_of(view, turn, stop_of_stretch, turning, error)
        if (allocated(error)) return
        call new_arc(beam_of(view, first), scheme_at(view%history, first), laws_at(view%assembled, view%history, first), start, &
                     stop, arc, error, turning)
    end subroutine arc_about

    !> May the error of the polylines be as large as the distance of two states
    pure function is_near(view, start, stop, times) result(they_are)
        type(view_type), intent(in) :: view
        real(wp), intent(in) :: start(:), stop(:)
        !> So many times as large
        integer, intent(in) :: times
        logical :: they_are
        real(wp) :: away, length
        integer :: n

        n = size(start) - 1
        away = maxval(abs(stop(:n) - start(:n)))
        length = max(view%history%on_laws%size(1), maxval(abs(start(:n))), maxval(abs(stop(:n))))
        they_are = away < times*wide_of_polyline*length &
            .and. abs(stop(n + 1) - start(n + 1)) < times*wide_of_polyline*view%history%on_laws%size(2)
    end function is_near

    !> Note the end of a stretch on the laws, where the next one begins
    subroutine keep_end(view, k, point)
        type(view_type), intent(inout) :: view
        integer, intent(in) :: k
        real(wp), intent(in) :: point(:)
        integer :: n

        n = size(point) - 1
        associate (s => view%history%stretches, known => view%history%on_laws)
            known%ends(stop_of_stretch, k)%x = point(:n)
            s(k)%to = point(n + 1)
            if (k == view%history%number) return
            if (known%lands(k + 1)) return
            known%ends(start_of_stretch, k + 1)%x = point(:n)
            if (s(k)%leg == s(k + 1)%leg) s(k + 1)%from = point(n + 1)
        end associate
    end subroutine keep_end

    !> Take the end of a stretch on the polylines again
    subroutine forget_end(view, k)
        type(view_type), intent(inout) :: view
        integer, intent(in) :: k

        associate (s => view%history%stretches, known => view%history%on_laws)
            if (is_known(view, k, stop_of_stretch)) then
                deallocate (known%ends(stop_of_stretch, k)%x)
                s(k)%to = known%rough(stop_of_stretch, k)
            end if
            if (k == view%history%number) return
            if (.not. is_known(view, k + 1, start_of_stretch)) return
            deallocate (known%ends(start_of_stretch, k + 1)%x)
            s(k + 1)%from = known%rough(start_of_stretch, k + 1)
        end associate
    end subroutine forget_end

    !> Whether all supports are on their pieces, and where the beam begins to give way so many ways as on the polylines
    subroutine check_on_laws(view, arc, number, error, indices)
        type(view_type), intent(in) :: view
        !> The arc, and which of its states
        type(arc_type), intent(in) :: arc
        integer, intent(in) :: number
        !> They are not
        type(error_type), allocatable, intent(out) :: error
        !> In how many ways the beam gives way on both sides of the state
        integer, intent(in), optional :: indices(:)
        real(wp), allocatable :: values(:)
        real(wp) :: wrongness
        integer :: falling

        associate (found => arc%known(number)%one)
            call wrongness_of(arc, found%state, wrongness, error)
            if (.not. allocated(error) .and. wrongness > nothing_on_arc) call lose(error)
            if (allocated(error) .or. .not. present(indices)) return
            ! Other laws may fall too
            if (any(view%assembled%with_law .and. .not. is_smooth(view%assembled%model%supports%law))) return
            allocate (values(size(found%slope)))
            call eigenvalues_at(arc, found%slope, values, error)
            if (allocated(error)) return
            falling = count(values < -minval(abs(values)))
            if (.not. all(indices == falling .or. indices == falling + 1)) call lose(error)
        end associate
    end subroutine check_on_laws

    !> Find the state on a stretch at a load factor
    subroutine find_at(view, k, factor, arc, number, error)
        type(view_type), intent(in) :: view
        integer, intent(in) :: k
        real(wp), intent(in) :: factor
        !> An arc, and which of its states it is
        type(arc_type), intent(out) :: arc
        integer, intent(out) :: number
        !> There is none
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: low, high

        number = 0
        low = merge(0.0_wp, -huge(low), is_known(view, k, start_of_stretch))
        high = merge(1.0_wp, huge(high), is_known(view, k, stop_of_stretch))
        call arc_about(view, k, k, arc, error)
        if (.not. allocated(error)) call find_root(arc, arc_test_type(of_factor, level=factor), low, high, 0.0_wp, number, error)
        if (allocated(error)) return
        associate (rate => arc%known(number)%one%rate)
            if (.not. rate(size(rate))*view%history%stretches(k)%direction > 0.0_wp) call lose(error)
        end associate
    end subroutine find_at

    !> Load factor at which a leg begins
    pure function begin_of_leg(view, leg) result(factor)
        type(view_type), intent(in) :: view
        integer, intent(in) :: leg
        real(wp) :: factor

        factor = 0.0_wp
        associate (h => view%history)
            if (leg > 1) factor = h%on_laws%rough(1, findloc(h%stretches(:h%number)%leg, leg, 1))
        end associate
    end function begin_of_leg

    !> Load factor at which a leg ends on the polylines
    pure function goal_of_leg(view, leg) result(factor)
        type(view_type), intent(in) :: view
        integer, intent(in) :: leg
        real(wp) :: factor

        associate (h => view%history)
            factor = h%on_laws%rough(2, findloc(h%stretches(:h%number)%leg, leg, 1, back=.true.))
        end associate
    end function goal_of_leg

    !> Where the load goes from the begin of a leg to a load factor: 1, -1, or 0
    pure function way_of_leg(view, leg, factor) result(way)
        type(view_type), intent(in) :: view
        integer, intent(in) :: leg
        real(wp), intent(in) :: factor
        integer :: way

        way = merge(1, 0, factor > begin_of_leg(view, leg)) - merge(1, 0, factor < begin_of_leg(view, leg))
    end function way_of_leg

end module gapbeam_path_on_laws
