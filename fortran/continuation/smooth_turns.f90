!> Where the load turns round on smooth laws: on their polylines it may do so more than once, or not at all.
module gapbeam_smooth_turns
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_smooth_arc, only: arc_type, lose, is_lost
    use gapbeam_arc_states, only: rate_beside, look_at_direction
    use gapbeam_arc_roots, only: arc_test_type, of_rate, find_root, find_roots
    use gapbeam_path_on_laws, only: view_type, arc_about, end_of, is_near, is_known, keep_end, check_on_laws, through, &
        turns_round, branches, start_of_stretch, stop_of_stretch
    implicit none
    private
    public :: find_turns, put_turns_on_laws

contains

    !> Ends of stretches at which the load turns round, near each other
    subroutine find_turns(view, k, turns, error)
        type(view_type), intent(in) :: view
        !> The first one; none where the load does not turn round there
        integer, intent(in) :: k
        integer, allocatable, intent(out) :: turns(:)
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: start(:), stop(:)
        integer :: at

        allocate (turns(0))
        associate (joins => view%history%on_laws%joins)
            if (joins(k) /= turns_round) return
            turns = [k]
            do at = k + 1, view%history%number
                if (joins(at) /= through .and. joins(at) /= turns_round) return
                call end_of(view, turns(size(turns)), stop_of_stretch, start, error)
                if (.not. allocated(error)) call end_of(view, at, stop_of_stretch, stop, error)
                if (is_lost(error)) then
                    deallocate (error)
                    return
                end if
                if (allocated(error)) return
                if (.not. is_near(view, start, stop, 1)) return
                if (joins(at) == turns_round) turns = [turns, at]
            end do
        end associate
    end subroutine find_turns

    !> Find where the load turns round on the laws
    subroutine put_turns_on_laws(view, turns, error)
        type(view_type), intent(inout) :: view
        !> By find_turns
        integer, intent(in) :: turns(:)
        !> The path is lost
        type(error_type), allocatable, intent(out) :: error
        type(arc_type) :: arc
        integer, allocatable :: states(:), kept(:)
        integer :: first, j, k

        first = turns(1)
        call arc_about(view, first, turns(size(turns)) + 1, arc, error, turn=first)
        if (.not. allocated(error)) call find_states(view, turns, arc, states, error)
        if (.not. allocated(error)) call choose_turns(view, turns, size(states), kept, error)
        if (allocated(error)) return
        associate (s => view%history%stretches, joins => view%history%on_laws%joins)
            do j = 1, size(kept)
                k = kept(j)
                call check_on_laws(view, arc, states(j), error, [s(k)%index, s(k + 1)%index])
                if (allocated(error)) return
            end do
            do j = 1, size(turns)
                if (any(kept == turns(j))) cycle
                joins(turns(j)) = through
                call drop_limits(view, turns(j))
            end do
        end associate
        if (size(kept) == 0) return
        do j = 1, size(turns)
            ! What is between them is of no length
            k = min(count(kept < turns(j)) + 1, size(kept))
            call keep_end(view, turns(j), arc%known(states(k))%one%point)
        end do
    end subroutine put_turns_on_laws

    !> States of an arc in which the load is stationary
    subroutine find_states(view, turns, arc, states, error)
        type(view_type), intent(in) :: view
        integer, intent(in) :: turns(:)
        type(arc_type), intent(inout) :: arc
        integer, allocatable, intent(out) :: states(:)
        type(error_type), allocatable, intent(out) :: error
        type(arc_test_type) :: test
        logical, allocatable :: turning(:)
        logical :: begins
        real(wp) :: rate
        integer :: k, number

        test = arc_test_type(of_rate)
        begins = is_known(view, turns(1), start_of_stretch)
        call find_roots(arc, test, states, error)
        if (allocated(error)) return
        if (begins .and. turns(1) > 1) then
            if (view%history%on_laws%joins(turns(1) - 1) == branches) call leave_out_crossings(arc, states, error)
            if (allocated(error)) return
        end if
        if (size(turns) > 1) return
        ! Others may follow close behind
        allocate (turning(size(states)))
        do k = 1, size(states)
            call rate_beside(arc, arc%known(states(k))%one%at, -1, rate, error)
            if (allocated(error)) return
            turning(k) = view%history%stretches(turns(1))%direction*rate > 0.0_wp
        end do
        states = pack(states, turning)
        if (size(states) > 0) return
        call find_root(arc, test, merge(0.0_wp, -huge(rate), begins), huge(rate), 0.0_wp, number, error)
        states = [number]
    end subroutine find_states

    !> Leave out turns that are none: where branches cross the load is stationary on the one of them that is no turn. The equations
    !> are dependent there, as they are not where the load turns round
    subroutine leave_out_crossings(arc, states, error)
        !> From the crossing on
        type(arc_type), intent(in) :: arc
        !> Where its rate changes sign
        integer, allocatable, intent(inout) :: states(:)
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: told(:)
        integer :: k

        allocate (told(size(states)))
        do k = 1, size(states)
            call look_at_direction(arc, states(k), told(k), error)
            if (allocated(error)) return
        end do
        states = pack(states, told)
    end subroutine leave_out_crossings

    !> Choose as many of the turns as there are on the laws, to and fro in turn; limits of the load before others
    subroutine choose_turns(view, turns, number, kept, error)
        type(view_type), intent(in) :: view
        integer, intent(in) :: turns(:)
        !> How many there are
        integer, intent(in) :: number
        integer, allocatable, intent(out) :: kept(:)
        !> There cannot be so many
        type(error_type), allocatable, intent(out) :: error
        logical :: is_limit
        integer :: left, at, j, i, chosen

        left = size(turns) - number
        allocate (kept(number))
        if (left < 0 .or. modulo(left, 2) == 1) then
            call lose(error)
            return
        end if
        at = 1
        do i = 1, number
            chosen = 0
            do j = at + left - modulo(left, 2), at, -2
                is_limit = any(view%history%limits%stretch == turns(j))
                if (chosen == 0) then
                    chosen = j
                else if (is_limit .and. .not. any(view%history%limits%stretch == turns(chosen))) then
                    chosen = j
                end if
            end do
            kept(i) = turns(chosen)
            left = left - (chosen - at)
            at = chosen + 1
        end do
    end subroutine choose_turns

    !> Go through what is no limit on the laws
    subroutine drop_limits(view, k)
        type(view_type), intent(inout) :: view
        !> Last stretch before it
        integer, intent(in) :: k
        integer :: j

        associate (h => view%history, s => view%history%stretches, lands => view%history%on_laws%lands)
            do j = 1, size(h%limits)
                if (h%limits(j)%stretch /= k .or. h%limits(j)%landing == 0) cycle
                associate (landing => h%limits(j)%landing)
                    if (.not. lands(landing)) cycle
                    s(k + 1:landing - 1)%skipped = .false.
                    s(landing)%from = s(landing - 1)%to
                    lands(landing) = .false.
                end associate
            end do
            h%limits = pack(h%limits, h%limits%stretch /= k)
        end associate
    end subroutine drop_limits

end module gapbeam_smooth_turns
