!> The path of a beam with smooth laws through load factors in turn: found on their polylines, then put onto the laws themselves.
!>
!> On a polyline the path bends wherever a support passes a breakpoint, which is nothing on the law. Only what happens is looked for
!> on the laws: where the load turns round, where the beam begins to give way to another side, where another support passes an end
!> of its piece, and the load factors that are gone to. What is not found there stays as it is on the polylines, and says so.
module gapbeam_smooth_path
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: segments_a_breakpoint
    use gapbeam_path_tolerances, only: nothing_on_arc, farthest_beside, further_than_asked
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_laws, only: smooth_supports
    use gapbeam_smooth_arc, only: arc_type, lose, is_lost
    use gapbeam_arc_states, only: find_on_arc, rate_beside
    use gapbeam_arc_roots, only: arc_test_type, of_eigenvalue, find_root, test_value
    use gapbeam_axial_path, only: follow_along_axis
    use gapbeam_ground_along_path, only: follow_ground_along
    use gapbeam_bedding_path, only: follow_bedding
    use gapbeam_history_start, only: grow_dead_loads, supports_move
    use gapbeam_history, only: history_type, follow_history, at_limit_stop, at_limit_jump, no_limit, ended, cut_off
    use gapbeam_path_on_laws, only: view_type, begin_on_laws, arc_about, is_known, keep_end, forget_end, check_on_laws, find_at, &
        begin_of_leg, goal_of_leg, way_of_leg, passed_ends, through, given_factor, branches, event, unknown, start_of_stretch, &
        stop_of_stretch
    use gapbeam_smooth_turns, only: find_turns, put_turns_on_laws
    use gapbeam_traced_branch, only: branch_off
    use gapbeam_unloaded_laws, only: mark_unloading, write_laws_of_legs
    implicit none
    private
    public :: follow_on_laws

contains

    !> Put on the dead loads, settlements and lacks of fit together, then go through load factors in turn; without smooth laws as
    !> follow_history
    subroutine follow_on_laws(assembled, factors, at_limit, most, history, error)
        !> As for follow_history
        type(assembled_type), intent(in), target :: assembled
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: at_limit
        !> Stretches after which it is cut off, beside those that breakpoints make
        integer, intent(in) :: most
        type(history_type), intent(out), target :: history
        !> As for follow_history; or what cannot be told on the laws
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), target :: dead
        type(view_type) :: view
        real(wp), allocatable :: to(:)
        integer :: goes, tries, n, longest

        n = size(assembled%beam%supports)
        if (allocated(assembled%axial%laws)) n = n + size(assembled%axial%laws)
        longest = int(min(real(huge(n), wp), most + real(segments_a_breakpoint, wp)*n*size(factors)))
        if (size(smooth_supports(assembled)) == 0) then
            call follow_history(assembled, factors, at_limit, longest, history, error)
            if (allocated(error) .or. history%ending == cut_off) return
            if (allocated(assembled%axial%bedding)) then
                call follow_bedding(assembled, history, error)
            else if (allocated(assembled%axial%limit)) then
                call follow_ground_along(assembled, history, error)
            end if
            if (.not. allocated(assembled%axial%laws)) return
            call grow_dead_loads(assembled, dead)
            call follow_along_axis(assembled, dead, longest, history, error)
            return
        end if
        n = size(factors)
        view%assembled => assembled
        view%stops = at_limit == at_limit_stop
        view%target = factors(n)
        ! Where the load stops on the laws is told by what it lands on
        goes = merge(at_limit_jump, at_limit, view%stops)
        allocate (to, source=factors)
        do tries = 1, 2
            call follow_history(assembled, to, goes, longest, history, error)
            if (allocated(error) .or. history%ending == cut_off) return
            view%history => history
            if (any(history%stretches(:history%number)%leg == 0) .and. .not. associated(view%dead)) then
                if (.not. supports_move(assembled)) then
                    call grow_dead_loads(assembled, dead)
                    view%dead => dead
                end if
            end if
            call begin_on_laws(view, error)
            if (.not. allocated(error)) call mark_unloading(assembled, history)
            if (.not. allocated(error)) call put_on_laws(view, error)
            if (.not. allocated(error)) call write_laws_of_legs(assembled, history, error)
            if (allocated(error) .or. history%on_laws%unreached /= n) exit
            ! The limit load that keeps it from there lies beyond on the polylines
            to(n) = factors(n) + further_than_asked*factors(n)
            if (n > 1) to(n) = to(n) - further_than_asked*factors(n - 1)
        end do
        if (allocated(error)) return
        if (history%on_laws%unreached >= 0) call refuse_near_limit(factors, history%on_laws%unreached, error)
    end subroutine follow_on_laws

    !> Whether a load factor is above or below a limit load cannot be told
    pure subroutine refuse_near_limit(factors, leg, error)
        real(wp), intent(in) :: factors(:)
        integer, intent(in) :: leg
        type(error_type), allocatable, intent(out) :: error
        character(len=60) :: which

        which = "the dead loads are"
        if (leg > 0) which = "load factor "//trim(shown(factors(leg)))//" is"
        call fatal_error(error, gapbeam_not_converged, trim(which)//" so near a limit load that the smooth laws of the "// &
                         "supports cannot be followed there: change it a little")
    end subroutine refuse_near_limit

    !> Put the ends of all stretches onto the laws
    subroutine put_on_laws(view, error)
        type(view_type), intent(inout) :: view
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: turns(:)
        type(arc_type) :: arc
        integer :: k

        associate (h => view%history, known => view%history%on_laws)
            k = 1
            do while (k <= h%number)
                call find_turns(view, k, turns, error)
                if (allocated(error)) return
                if (size(turns) > 0) then
                    call put_turns_on_laws(view, turns, error)
                else if (known%joins(k) /= through .and. known%joins(k) /= unknown) then
                    call put_end_on_laws(view, k, arc, error)
                    if (.not. allocated(error) .and. known%joins(k) == branches) then
                        call branch_off(view, k, arc, error)
                        if (allocated(error)) return
                    end if
                end if
                if (is_lost(error)) then
                    deallocate (error)
                    if (known%joins(k) == given_factor .and. .not. known%unique) call miss_end(view, k)
                end if
                if (allocated(error)) return
                if (known%traced > 0) exit
                if (size(turns) > 0) k = turns(size(turns))
                k = k + 1
            end do
            call place_limits(view)
            call find_runs(view)
            call end_at_target(view, error)
            if (view%stops .and. size(h%limits) > 0 .and. .not. allocated(error)) call end_at_limit(view)
        end associate
    end subroutine put_on_laws

    !> Find the end of a stretch on the laws, where the load does not turn round
    subroutine put_end_on_laws(view, k, arc, error)
        type(view_type), intent(inout) :: view
        integer, intent(in) :: k
        !> On which it was found
        type(arc_type), intent(out) :: arc
        !> The path is lost
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: low
        integer :: number, least

        associate (s => view%history%stretches, known => view%history%on_laws)
            low = merge(0.0_wp, -huge(low), is_known(view, k, start_of_stretch))
            select case (known%joins(k))
            case (given_factor)
                call find_at(view, k, known%rough(2, k), arc, number, error)
                if (.not. allocated(error)) call check_on_laws(view, arc, number, error)
            case (branches)
                call arc_about(view, k, k, arc, error, forward=.false.)
                if (allocated(error)) return
                least = min(s(k)%index, s(k + 1)%index)
                if (least == size(arc%numbers)) call lose(error)
                if (.not. allocated(error)) call find_root(arc, arc_test_type(of_eigenvalue, least + 1), low, huge(low), 0.0_wp, &
                                                           number, error)
                if (allocated(error)) return
                ! Not where the stretch begins, which rounding puts before or beyond
                if (is_known(view, k, start_of_stretch) .and. arc%known(number)%one%at < nothing_on_arc) call lose(error)
                if (.not. allocated(error)) call check_on_laws(view, arc, number, error, [s(k)%index, s(k + 1)%index])
            case default
                call find_event(view, k, arc, number, error)
            end select
            if (allocated(error)) return
            call keep_end(view, k, arc%known(number)%one%point)
            ! There to the last digit, or no step is found there
            if (known%joins(k) == given_factor) s(k)%to = known%rough(2, k)
            if (known%joins(k) /= event) return
            call check_way_on(view, k + 1, error)
            if (is_lost(error)) call forget_end(view, k)
        end associate
    end subroutine put_end_on_laws

    !> Find where another support passes an end of its piece
    subroutine find_event(view, k, arc, number, error)
        type(view_type), intent(inout) :: view
        !> The stretch that ends there
        integer, intent(in) :: k
        !> An arc, and which of its states it is
        type(arc_type), intent(out) :: arc
        integer, intent(out) :: number
        !> The path is lost
        type(error_type), allocatable, intent(out) :: error
        type(arc_test_type), allocatable :: ends(:)
        real(wp) :: low, first, value, rate, goal
        integer :: begin, j, way

        number = 0
        call arc_about(view, k, k, arc, error, forward=.false.)
        if (allocated(error)) return
        allocate (ends, source=passed_ends(view, k))
        call find_on_arc(arc, 0.0_wp, begin, error)
        if (.not. allocated(error)) call test_value(arc, ends(1), begin, value, error)
        if (allocated(error)) return
        low = merge(0.0_wp, -huge(low), is_known(view, k, start_of_stretch))
        first = 0.0_wp
        ! It may have been at the same breakpoint at the start of the arc
        if (abs(value) < nothing_on_arc) first = farthest_beside
        call find_root(arc, ends(1), max(low, merge(first, low, first > 0.0_wp)), huge(low), first, number, error)
        if (allocated(error)) return
        associate (s => view%history%stretches(k), at => arc%known(number)%one%at, h => view%history)
            ! Not at the event itself, where a support may be on either side of it by rounding
            call rate_beside(arc, at, -1, rate, error)
            do j = 1, size(ends)
                if (.not. allocated(error)) call test_value(arc, ends(j), number, value, error)
                if (.not. allocated(error) .and. abs(value) > nothing_on_arc) call lose(error)
            end do
            if (.not. allocated(error) .and. .not. s%direction*rate > 0.0_wp) call lose(error)
            if (.not. allocated(error)) call check_on_laws(view, arc, number, error)
            if (allocated(error)) return
            goal = goal_of_leg(view, s%leg)
            way = way_of_leg(view, s%leg, goal)
            if (s%leg /= h%stretches(h%number)%leg .or. s%direction /= way) return
            ! What happens there does so beyond
            associate (point => arc%known(number)%one%point)
                if (way*(point(size(point)) - goal) > 0.0_wp) call miss_end(view, k)
            end associate
        end associate
    end subroutine find_event

    !> Whether the load goes as it does on the polylines after an event
    subroutine check_way_on(view, k, error)
        type(view_type), intent(in) :: view
        !> The stretch that begins there
        integer, intent(in) :: k
        !> It does not
        type(error_type), allocatable, intent(out) :: error
        type(arc_type) :: arc
        real(wp) :: rate
        integer :: number, n

        call arc_about(view, k, k, arc, error)
        if (.not. allocated(error)) call find_on_arc(arc, 0.0_wp, number, error)
        if (allocated(error)) return
        n = size(arc%numbers)
        associate (there => view%history%on_laws%ends(stop_of_stretch, k - 1)%x)
            if (maxval(abs(arc%known(number)%one%point(:n) - there)) > nothing_on_arc*maxval(abs(there))) call lose(error)
        end associate
        if (.not. allocated(error)) call rate_beside(arc, 0.0_wp, 1, rate, error)
        if (.not. allocated(error) .and. .not. rate*view%history%stretches(k)%direction > 0.0_wp) call lose(error)
    end subroutine check_way_on

    !> Note that the path does not come to the end of its leg as on the polylines; what is beyond a limit may not matter
    subroutine miss_end(view, k)
        type(view_type), intent(inout) :: view
        integer, intent(in) :: k

        associate (h => view%history)
            if (h%on_laws%unreached >= 0) return
            if (view%stops .and. any(h%limits%stretch < k)) return
            h%on_laws%unreached = h%stretches(k)%leg
        end associate
    end subroutine miss_end

    !> Load factors of the limits, and of the landings
    subroutine place_limits(view)
        type(view_type), intent(inout) :: view
        real(wp) :: goal
        integer :: j

        associate (h => view%history, s => view%history%stretches, known => view%history%on_laws)
            do j = 1, size(h%limits)
                associate (limit => h%limits(j))
                    if (limit%stretch > 0) limit%factor = s(limit%stretch)%to
                    if (any(s(:h%number)%leg == limit%leg) .and. limit%leg < s(max(h%number, 1))%leg) then
                        goal = goal_of_leg(view, limit%leg)
                        ! It would have come there before
                        if ((limit%factor - goal)*(goal - begin_of_leg(view, limit%leg)) > 0.0_wp) known%unreached = limit%leg
                    end if
                    if (limit%landing == 0) cycle
                    if (known%lands(limit%landing)) s(limit%landing)%from = limit%factor
                end associate
            end do
        end associate
    end subroutine place_limits

    !> What is one stretch on the laws
    subroutine find_runs(view)
        type(view_type), intent(inout) :: view
        integer, allocatable :: first(:)
        integer :: k

        associate (known => view%history%on_laws, n => view%history%number)
            allocate (first, source=pack([(k, k=1, n)], [(begins(k), k=1, n)]))
            allocate (known%runs(2, size(first)))
            known%runs(1, :) = first
            known%runs(2, :) = [first(2:) - 1, spread(n, 1, min(1, size(first)))]
        end associate

    contains

        !> Does something happen before a stretch
        pure function begins(k)
            integer, intent(in) :: k
            logical :: begins

            begins = k == 1
            if (.not. begins) begins = view%history%on_laws%joins(k - 1) /= through .or. view%history%on_laws%lands(k)
        end function begins

    end subroutine find_runs

    !> End the path where it first comes to the last load factor
    subroutine end_at_target(view, error)
        type(view_type), intent(inout) :: view
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error
        type(arc_type) :: arc
        integer :: number, k, way, run

        associate (h => view%history, s => view%history%stretches, known => view%history%on_laws)
            do run = 1, size(known%runs, 2)
                associate (first => known%runs(1, run), last => known%runs(2, run))
                    way = way_of_leg(view, s(first)%leg, view%target)
                    if (s(first)%leg /= s(h%number)%leg .or. s(first)%skipped .or. s(first)%direction /= way) cycle
                    if (way*(view%target - s(first)%from) < 0.0_wp .or. way*(s(last)%to - view%target) <= 0.0_wp) cycle
                    do k = first, last
                        if (way*(s(k)%to - view%target) >= 0.0_wp) exit
                    end do
                end associate
                call find_at(view, k, view%target, arc, number, error)
                if (is_lost(error)) then
                    deallocate (error)
                    if (is_known(view, k, stop_of_stretch)) deallocate (known%ends(stop_of_stretch, k)%x)
                else if (allocated(error)) then
                    return
                else
                    known%ends(stop_of_stretch, k)%x = arc%known(number)%one%point(:size(arc%numbers))
                end if
                s(k)%to = view%target
                h%number = k
                h%limits = pack(h%limits, h%limits%stretch < k)
                h%ending = no_limit
                if (allocated(h%motion)) deallocate (h%motion)
                known%runs = known%runs(:, :run)
                known%runs(2, run) = k
                return
            end do
        end associate
    end subroutine end_at_target

    !> End the path at its first limit; what is beyond was only looked at
    subroutine end_at_limit(view)
        type(view_type), intent(inout) :: view

        associate (h => view%history, s => view%history%stretches, limit => view%history%limits(1))
            s(limit%stretch + 1:h%number)%skipped = .true.
            if (limit%landing > 0) then
                if (h%on_laws%lands(limit%landing)) s(limit%landing)%from = s(limit%landing - 1)%to
            end if
            h%limits = h%limits(:1)
            if (h%ending == no_limit) h%ending = ended
        end associate
    end subroutine end_at_limit

end module gapbeam_smooth_path
