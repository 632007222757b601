!> The way of a beam over ground along its axis while the load goes on: from one change of the parts that slide to the next.
!> Bending does not feel it; its path tells which way the load goes.
module gapbeam_ground_along_path
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: found_slip, no_return, nothing_left, shortest_part
    use gapbeam_limits, only: most_idle_segments
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_ground_along, only: ground_along_type, rates_type, new_ground_along, start_leg, find_rates, length_of
    use gapbeam_ground_along_slip, only: find_motion, remove_parts, are_pushed
    use gapbeam_ground_along_steps, only: begin, first_step, take_step
    use gapbeam_history_record, only: history_type, along_type, limit_type, on_ground_type, mechanism
    implicit none
    private
    public :: follow_ground_along, go_to_change, keep, end_path

    !> Most steps until a change is found
    integer, parameter :: most_tries = 200

contains

    !> Let the beam slide over the ground along its axis as the load of a path of bending does
    subroutine follow_ground_along(assembled, history, error)
        !> With such ground
        type(assembled_type), intent(in) :: assembled
        !> That of bending in; what there is along the beam, or where it slides without end, out
        type(history_type), intent(inout) :: history
        !> Rounding hides what slides first
        type(error_type), allocatable, intent(out) :: error
        type(ground_along_type) :: ground
        integer :: k, leg
        real(wp) :: way, at
        logical :: lost

        associate (axial => assembled%axial)
            call new_ground_along(axial%softness, axial%limit, axial%stiffness, ground)
        end associate
        allocate (history%along)
        allocate (history%along%on_ground(16))
        leg = -1
        way = 0.0_wp
        at = 0.0_wp
        do k = 1, history%number
            associate (s => history%stretches(k))
                if (.not. s%skipped .and. abs(s%to - s%from) > 0.0_wp) then
                    if (s%leg /= leg .or. .not. abs(way - sign(1.0_wp, s%to - s%from)) <= 0.0_wp) then
                        leg = s%leg
                        way = sign(1.0_wp, s%to - s%from)
                        call start_leg(ground)
                        ! What is as short as rounding, where all is at rest
                        call remove_parts(ground, [(length_of(ground, k) <= shortest_part, k=1, size(ground%parts))])
                        call set_loads(assembled, merge(1, 2, leg == 0), way, ground)
                    end if
                end if
                ! The load of a beam that jumps stays as it is
                if (.not. s%skipped) at = s%from
                call pass(assembled, k, way, merge(at, s%to, s%skipped), at, ground, history%along, lost, error)
                if (allocated(error)) return
                if (.not. lost) cycle
                call end_path(history, k, at)
                return
            end associate
        end do
    end subroutine follow_ground_along

    !> Rates of the loads of a leg
    pure subroutine set_loads(assembled, case, way, ground)
        type(assembled_type), intent(in) :: assembled
        !> 1 dead, 2 live; 1 where the load rises, -1 where it falls
        integer, intent(in) :: case
        real(wp), intent(in) :: way
        type(ground_along_type), intent(inout) :: ground

        ground%load_rate(:) = way*assembled%axial%force(case, :)
        ground%longer_rate(:) = 0.0_wp
        if (allocated(assembled%axial%elongation)) ground%longer_rate(:) = way*assembled%axial%elongation(case, :)
    end subroutine set_loads

    !> Go along a stretch, from change to change
    subroutine pass(assembled, k, way, to, at, ground, along, lost, error)
        type(assembled_type), intent(in) :: assembled
        !> The stretch; 1 where the load rises, -1 where it falls; its end
        integer, intent(in) :: k
        real(wp), intent(in) :: way, to
        !> Load factor: the beginning in, the end, or where the beam slides without end, out
        real(wp), intent(inout) :: at
        type(ground_along_type), intent(inout) :: ground
        type(along_type), intent(inout) :: along
        logical, intent(out) :: lost
        type(error_type), allocatable, intent(out) :: error
        type(rates_type) :: rates
        real(wp) :: left, gone
        integer :: idle
        logical :: settled

        lost = .false.
        left = abs(to - at)
        idle = 0
        do
            call end_if_stopped(assembled%beam%watch, error)
            if (allocated(error)) return
            call find_motion(ground, rates, settled)
            call keep(along, k, at, ground)
            lost = rates%lost
            if (lost .or. .not. left > 0.0_wp) return
            gone = 0.0_wp
            if (settled) call go_to_change(ground, rates, left, gone)
            idle = merge(0, idle + 1, gone > 0.0_wp)
            if (.not. settled .or. idle > most_idle_segments + size(ground%parts)) then
                call fatal_error(error, gapbeam_not_converged, "along the beam the path does not leave load factor "// &
                                 trim(shown(at))//", where rounding hides what slides over the ground first: bring the "// &
                                 "magnitudes of the beam nearer to each other")
                return
            end if
            left = left - gone
            at = at + way*gone
            if (left <= nothing_left*abs(to)) then
                left = 0.0_wp
                at = to
            end if
        end do
    end subroutine pass

    !> Keep how the beam is where something changes, or where the load turns
    pure subroutine keep(along, k, at, ground)
        type(along_type), intent(inout) :: along
        !> The stretch, and the load factor
        integer, intent(in) :: k
        real(wp), intent(in) :: at
        type(ground_along_type), intent(in) :: ground
        type(on_ground_type), allocatable :: longer(:)

        if (along%number == size(along%on_ground)) then
            allocate (longer(2*along%number))
            longer(:along%number) = along%on_ground
            call move_alloc(longer, along%on_ground)
        end if
        along%number = along%number + 1
        associate (kept => along%on_ground(along%number))
            kept%stretch = k
            kept%factor = at
            kept%ground = ground
        end associate
    end subroutine keep

    !> Go on until something changes, or all the way
    subroutine go_to_change(ground, rates, most, gone)
        type(ground_along_type), intent(inout) :: ground
        !> By find_motion
        type(rates_type), intent(inout) :: rates
        !> How far to go at most, and how far it went
        real(wp), intent(in) :: most
        real(wp), intent(out) :: gone
        type(ground_along_type) :: next
        real(wp) :: step
        logical :: done

        call begin(ground, rates, most, gone)
        step = first_step(most, gone)
        do while (step > found_slip*most)
            next = ground
            call take_step(next, step, done)
            if (.not. done) then
                step = step/2
            else if (is_sound(next)) then
                ground = next
                gone = gone + step
                step = min(2*step, most - gone)
                if (most - gone <= found_slip*most) then
                    gone = most
                    return
                end if
            else
                call find_change(ground, next, found_slip*most, step)
                gone = gone + step
                exit
            end if
        end do
        call end_parts(ground)
    end subroutine go_to_change

    !> Find where something changes within a step, and go there
    pure subroutine find_change(ground, next, width, step)
        type(ground_along_type), intent(inout) :: ground
        !> Where the step leads
        type(ground_along_type), intent(inout) :: next
        !> To how much it is found
        real(wp), intent(in) :: width
        !> Its length in, how far it is to the change out
        real(wp), intent(inout) :: step
        type(ground_along_type) :: beyond
        real(wp) :: low, high, middle, guess, off
        integer :: tries
        logical :: done

        beyond = next
        low = 0.0_wp
        high = step
        off = step/16
        do tries = 1, most_tries
            if (high - low <= width) exit
            guess = first_change(ground, beyond, high)
            middle = (low + high)/2
            ! On both sides of where lengths seem to vanish, nearer each time
            if (modulo(tries, 3) /= 0 .and. guess > low .and. guess < high) then
                middle = guess + merge(off, -off, modulo(tries, 3) == 1)
                if (modulo(tries, 3) == 2) off = off/64
                if (middle <= low .or. middle >= high) middle = (low + high)/2
            end if
            next = ground
            call take_step(next, middle, done)
            if (done) done = is_sound(next)
            if (done) then
                low = middle
            else
                high = middle
                beyond = next
            end if
        end do
        next = ground
        call take_step(next, high, done)
        if (.not. done) then
            high = low
            next = ground
            if (low > 0.0_wp) call take_step(next, low, done)
        end if
        ground = next
        step = high
    end subroutine find_change

    !> Where lengths of parts that become shorter seem to vanish, by what has been found at a way
    pure function first_change(ground, next, way) result(guess)
        !> At the beginning, and at the way
        type(ground_along_type), intent(in) :: ground, next
        real(wp), intent(in) :: way
        real(wp) :: guess, before, after
        integer :: k

        guess = way
        do k = 1, size(ground%parts)
            before = length_of(ground, k)
            after = length_of(next, k)
            if (after < before .and. after < 0.0_wp) guess = min(guess, way*before/(before - after))
        end do
    end function first_change

    !> Has every part a length, does no node go back, and is none at rest that is pushed
    pure function is_sound(ground) result(sound)
        type(ground_along_type), intent(in) :: ground
        logical :: sound
        type(rates_type) :: rates
        integer :: k

        sound = all([(length_of(ground, k) > 0.0_wp, k=1, size(ground%parts))])
        if (.not. sound) return
        call find_rates(ground, rates)
        sound = .not. rates%lost
        if (sound) sound = all(ground%way*rates%displacement >= -no_return*maxval(abs(rates%displacement))) &
            .and. .not. any(are_pushed(ground, rates))
    end function is_sound

    !> Take out what has become as short as rounding
    pure subroutine end_parts(ground)
        type(ground_along_type), intent(inout) :: ground
        type(rates_type) :: rates
        logical :: gone(size(ground%parts))
        real(wp) :: faster
        integer :: k

        call find_rates(ground, rates)
        do k = 1, size(gone)
            faster = rates%to(k)
            if (k > 1) then
                if (ground%parts(k - 1)%bar == ground%parts(k)%bar) faster = faster - rates%to(k - 1)
            end if
            gone(k) = length_of(ground, k) <= shortest_part .and. (faster < 0.0_wp .or. .not. length_of(ground, k) > 0.0_wp)
        end do
        if (any(gone)) call remove_parts(ground, gone)
    end subroutine end_parts

    !> The beam slides without end
    subroutine end_path(history, k, at)
        type(history_type), intent(inout) :: history
        !> On which stretch, and the load factor
        integer, intent(in) :: k
        real(wp), intent(in) :: at

        associate (s => history%stretches(k))
            history%limits = [pack(history%limits, history%limits%stretch < k), limit_type(mechanism, s%leg, at, k)]
            s%to = at
        end associate
        history%number = k
        history%ending = mechanism
        history%others = pack(history%others, history%others%stretch <= k)
        if (allocated(history%motion)) deallocate (history%motion)
    end subroutine end_path

end module gapbeam_ground_along_path
