!> First change of the contact of a beam on the ground between two load factors.
!> Its own factor, and states on both sides of it.
!>
!> Where the change is to be expected is computed (gapbeam_ground_crossing); states next to that factor tell whether it is so. What
!> cannot be computed is found by bisection. The last factor below which there is equilibrium is where loads begin to do work along
!> the motion that begins there, or else found by bisection too.
module gapbeam_ground_narrow
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_zone_margin, only: change_type
    use gapbeam_ground_crossing, only: crossing_type, find_crossing, refine_crossing
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_ground_events, only: held_type, list_changes, same_contact
    use gapbeam_ground_walk, only: walk_type, hold, make_sure
    implicit none
    private
    public :: narrow

    !> States as near as this to the factor of a change tell that it is one; where they do not, which may be so where zones begin
    !> without length, those so many times farther away; and how often the factor is computed anew where another change comes first
    real(wp), parameter :: nearest = 2.0_wp**(-38), wider = 64.0_wp, farthest = 2.0_wp**(-26)
    integer, parameter :: most_guesses = 8
    !> So near to the factor at which the loads begin to do work there is equilibrium, and none
    real(wp), parameter :: next_to_limit = 2.0_wp**(-50)
    !> Distance of load factors at which it is enough to know that states between them cannot be settled
    real(wp), parameter :: near = 2.0_wp**(-44)
    !> The same where laws are curves that come to a limit: next to it states take long
    real(wp), parameter :: near_on_curves = 2.0_wp**(-20)
    !> Next to an event a state may not be settled, since a zone has next to no length there: factors on both sides of it that are
    !> as near as this are neighbours
    real(wp), parameter :: next_to = 2.0_wp**(-32)

contains

    !> Factors around the first change between two, what holds the beam there, and factors and places of what changes
    subroutine narrow(assembled, walk, low, below, high, above, earlier, at_earlier, levels_off, factors, places, error)
        !> The beam on its way
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        !> Load factors around the change, and what holds the beam there
        real(wp), intent(inout) :: low, high
        type(held_type), intent(inout) :: below, above
        !> A factor not above the lower one from which on nothing was seen to change, and what holds the beam there
        real(wp), intent(in) :: earlier
        type(held_type), intent(in) :: at_earlier
        !> Does some ground come to what it carries at most on a curve
        logical, intent(in) :: levels_off
        !> Of the changes between them as note_changes takes them; where there are several, they are as near as that
        real(wp), allocatable, intent(out) :: factors(:), places(:)
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: far_below, far_above
        type(change_type), allocatable :: changes(:)
        type(crossing_type) :: crossing
        real(wp) :: far_low, far_high
        integer :: guesses, i
        logical :: found

        found = .false.
        if (.not. above%stands) call approach_limit(assembled, walk, low, below, high, above, error)
        if (allocated(error)) return
        do guesses = 1, most_guesses
            far_low = low
            far_high = high
            far_below = below
            far_above = above
            call guess_factor(assembled, walk, low, below, high, above, crossing, found)
            if (.not. found .and. earlier < low) then
                ! It may have happened next to the lower factor already
                call guess_factor(assembled, walk, earlier, at_earlier, high, above, crossing, found)
                found = found .and. crossing%factor > low*(1 - farthest)
                if (found) far_low = earlier
                if (found) far_below = at_earlier
            end if
            if (.not. found) exit
            call confirm(assembled, walk, crossing, low, below, high, above, found, error)
            if (allocated(error)) return
            if (found .or. .not. above%stands) exit
        end do
        if (.not. found) call bisect(assembled, walk, low, below, high, above, levels_off, error)
        if (allocated(error)) return
        call make_sure(assembled, walk, low, below, error)
        if (allocated(error) .or. walk%misled .or. .not. above%stands) return
        call make_sure(assembled, walk, high, above, error)
        if (allocated(error) .or. walk%misled) return
        call list_changes(assembled, below, above, changes)
        allocate (factors(size(changes)), places(size(changes)))
        factors(:) = high
        places(:) = -1.0_wp
        if (.not. found) return
        factors(:) = crossing%factor
        do i = 1, size(changes)
            if (size(changes) > 1) then
                call find_crossing(walk%ground, walk%rule, changes(i), far_low, far_below%start, far_high, far_above%start, &
                                   crossing, walk%solves, found)
                if (found) call refine_crossing(walk%ground, walk%fine, walk%rule, crossing, walk%solves, found)
                if (.not. found .or. abs(crossing%factor - factors(i)) > high - low) cycle
                factors(i) = crossing%factor
            end if
            if (changes(i)%to > changes(i)%from) places(i) = place_of(assembled, crossing%place)
        end do
    end subroutine narrow

    !> Is a factor that of the first change between two others: states just below and just above it tell
    subroutine confirm(assembled, walk, crossing, low, below, high, above, found, error)
        !> As for narrow
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        type(crossing_type), intent(in) :: crossing
        real(wp), intent(inout) :: low, high
        type(held_type), intent(inout) :: below, above
        logical, intent(out) :: found
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: between, neighbour
        real(wp) :: guess, reach
        logical :: others

        found = .false.
        guess = crossing%factor
        neighbour%stands = .true.
        neighbour%start = crossing%start
        reach = nearest*guess
        do while (guess - reach > low)
            call hold(assembled, walk, guess - reach, between, error, neighbour)
            if (allocated(error)) return
            if (between%stands .or. .not. allocated(walk%trouble)) then
                if (same_contact(below, between)) then
                    low = guess - reach
                    below = between
                    exit
                end if
                ! There is another change before, or states do not tell so near to it
                others = .not. same_contact(between, above)
                high = guess - reach
                above = between
                if (others) return
            end if
            reach = wider*reach
            if (reach > farthest*guess) return
        end do
        reach = nearest*guess
        do while (guess + reach < high)
            call hold(assembled, walk, guess + reach, between, error, neighbour)
            if (allocated(error)) return
            if (between%stands .or. .not. allocated(walk%trouble)) then
                if (.not. same_contact(below, between)) then
                    high = guess + reach
                    above = between
                    exit
                end if
                low = guess + reach
                below = between
            end if
            reach = wider*reach
            if (reach > farthest*guess) return
        end do
        found = above%stands
    end subroutine confirm

    !> Where the first change between two factors is to be expected
    subroutine guess_factor(assembled, walk, low, below, high, above, first, found)
        !> As for narrow
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(in) :: low, high
        type(held_type), intent(in) :: below, above
        type(crossing_type), intent(out) :: first
        !> Is anything known of it
        logical, intent(out) :: found
        type(change_type), allocatable :: changes(:)
        type(crossing_type) :: crossing
        logical :: known
        integer :: i

        found = .false.
        if (.not. above%stands) return
        call list_changes(assembled, below, above, changes)
        do i = 1, size(changes)
            call find_crossing(walk%ground, walk%rule, changes(i), low, below%start, high, above%start, crossing, &
                               walk%solves, known)
            if (.not. known) cycle
            if (found) then
                if (.not. crossing%factor < first%factor) cycle
            end if
            first = crossing
            found = .true.
        end do
        if (found) call refine_crossing(walk%ground, walk%fine, walk%rule, first, walk%solves, found)
        found = found .and. first%factor > low .and. first%factor < high
    end subroutine guess_factor

    !> Bring two factors nearer to the one above which there is no equilibrium: where it begins, loads do no work along the motion
    subroutine approach_limit(assembled, walk, low, below, high, above, error)
        !> As for narrow
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(inout) :: low, high
        type(held_type), intent(inout) :: below, above
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: between
        real(wp) :: guess, reach
        integer :: guesses

        reach = next_to_limit
        do guesses = 1, most_guesses
            if (above%stands .or. .not. allocated(above%motion)) return
            guess = factor_without_work(walk, high, above%motion)
            ! States may end before, where they are told from others
            if (guess*(1 - reach) >= high .and. guess*(1 - wider*reach) < high) reach = wider*reach
            if (.not. (guess*(1 - reach) > low .and. guess*(1 - reach) < high)) return
            call hold(assembled, walk, guess*(1 - reach), between, error, below)
            if (allocated(error)) return
            if (same_contact(below, between)) exit
            if (.not. between%stands .and. allocated(walk%trouble)) return
            high = guess*(1 - reach)
            above = between
        end do
        if (above%stands .or. .not. same_contact(below, between)) return
        low = guess*(1 - reach)
        below = between
        if (guess*(1 + reach) >= high) return
        call hold(assembled, walk, guess*(1 + reach), between, error)
        if (allocated(error) .or. between%stands) return
        high = guess*(1 + reach)
        above = between
    end subroutine approach_limit

    !> The load factor at which the loads do no work along a motion
    pure function factor_without_work(walk, at, motion) result(guess)
        type(walk_type), intent(in) :: walk
        !> A factor at which they do
        real(wp), intent(in) :: at
        !> Displacements of the nodes
        real(wp), intent(in) :: motion(0:)
        real(wp) :: guess, of_dead, of_all, size_of_parts

        associate (all_nodes => [0, ubound(motion, 1)])
            call work_of_loads(walk%ground%beam, 0.0_wp, motion, all_nodes, of_dead, size_of_parts)
            call work_of_loads(walk%ground%beam, at, motion, all_nodes, of_all, size_of_parts)
        end associate
        guess = -1.0_wp
        if (abs(of_dead - of_all) > 0.0_wp) guess = at*(of_dead/(of_dead - of_all))
    end function factor_without_work

    !> Neighbouring factors around the first change between two, and what holds the beam there
    subroutine bisect(assembled, walk, low, below, high, above, levels_off, error)
        !> As for narrow
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(inout) :: low, high
        type(held_type), intent(inout) :: below, above
        logical, intent(in) :: levels_off
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: between, standing
        real(wp) :: middle, stands_at

        stands_at = huge(high)
        do
            if (above%stands) then
                stands_at = high
                standing = above
            end if
            middle = low + (high - low)/2
            if (middle <= low .or. middle >= high) exit
            if (.not. above%stands) then
                if (allocated(walk%trouble) .and. high - low <= near*high) exit
                if (levels_off .and. high - low <= near_on_curves*high) exit
            end if
            call hold(assembled, walk, middle, between, error, below)
            if (allocated(error)) return
            if (same_contact(below, between)) then
                low = middle
                below = between
            else
                high = middle
                above = between
            end if
        end do
        if (above%stands .or. .not. allocated(walk%trouble) .or. stands_at - low > next_to*stands_at) return
        high = stands_at
        above = standing
        deallocate (walk%trouble)
    end subroutine bisect

    !> A place in the user's units; next to an end of a piece of the beam that end, since rounding tells no more
    pure function place_of(assembled, distance) result(x)
        type(assembled_type), intent(in) :: assembled
        !> From the left end of the beam
        real(wp), intent(in) :: distance
        real(wp) :: x
        integer :: j

        x = max(0.0_wp, scale(distance, assembled%units%length))
        associate (n => size(assembled%pieces))
            do j = 0, n
                if (abs(x - point_x(assembled, j)) > 4*epsilon(x)*point_x(assembled, n)) cycle
                x = point_x(assembled, j)
                return
            end do
        end associate
    end function place_of

end module gapbeam_ground_narrow
