!> The working scheme of a beam, or the proof that there is none.
!>
!> Where the bilateral supports alone hold the beam every scheme is stable, and gapbeam_search ends with the right one.
!> Other beams may pass through mechanisms. Then weak springs towards a reference position hold it, the reference
!> moves to the solution, and this is repeated: the proximal point method (Rockafellar 1976). The springs are
!> gone from the final answer. If the reference runs away along a free motion that no support can stop and along
!> which the loads do work, there is no equilibrium: that motion is the proof (Farkas' lemma).
module gapbeam_scheme
    use gapbeam_kinds, only: wp, dp
    use gapbeam_require, only: checked, require
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_band, only: band_ok, band_needs_pivoting, hinge, restrained
    use gapbeam_law, only: below, above, always_closed, separate_rigid_pairs, limit_stiffness, find_level_forces, outermost, &
        is_blocked, distance_to_contact
    use gapbeam_model, only: beam_type, softest
    use gapbeam_kinematics, only: free_motions, motion_type, work_of_loads
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_and_refine, refine_scheme, complete_scheme, is_finite
    use gapbeam_rules, only: find_wrong, first_width
    use gapbeam_search, only: settle, refuse_scheme
    implicit none
    private
    public :: find_scheme, outcome_type

    !> Weak springs relative to the softest stiffness present
    real(wp), parameter :: ease_ratio = 10.0_wp**(-precision(1.0_wp)/3)
    !> Work and speed, relative to the sum of their parts and to the largest, that count as none
    !> (places and loads are rounded to doubles, whatever the precision here)
    real(wp), parameter :: no_work = max(4096*epsilon(1.0_wp), 8*real(epsilon(1.0_dp), wp)), &
        no_speed = max(512*epsilon(1.0_wp), 4*real(epsilon(1.0_dp), wp))
    !> Forces of the weak springs, relative to the loads, that come from rounding of the loads alone
    real(wp), parameter :: least_force = 8*real(epsilon(1.0_dp), wp)
    !> So many times that much is clearly more
    real(wp), parameter :: clearly_more = 1024.0_wp
    !> Moves of the reference position before giving up
    integer, parameter :: most_moves = 200

    !> A part of the beam that the loads move while a scheme acts: first and last node that move
    type :: runaway_type
        integer :: first, last
    end type runaway_type

    !> How the search ended, apart from errors
    type :: outcome_type
        !> gapbeam_solved or gapbeam_no_equilibrium
        integer :: status = gapbeam_solved
        !> The free motion, where there is no equilibrium, shape (0:n)
        real(wp), allocatable :: motion(:)
        !> Can the beam move freely without work of the loads (forces are unique, the position is not)
        logical :: indifferent = .false.
        !> Does it depend on work or speed that is hardly more than its rounding error
        logical :: in_doubt = .false.
        !> Supports whose reaction or opening is zero as far as any precision here tells: their state may be either
        !> (gapbeam_referee), shape (size(closed))
        logical, allocatable :: undecided(:)
    end type outcome_type

contains

    !> Find the working scheme and its solution
    subroutine find_scheme(beam, factor, rule, closed, work, outcome, error)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> Load factor (the loads themselves are in work, by set_loads)
        real(wp), intent(in) :: factor
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> Start in, working scheme out, shape (size(beam%supports)); bilateral supports always act
        logical, intent(inout) :: closed(:)
        !> Loads in, solution and reactions out
        type(workspace_type), intent(inout) :: work
        !> Solved or no equilibrium
        type(outcome_type), intent(out) :: outcome
        !> Rigid stretch over too many rigid supports; not settled; not finite
        type(error_type), allocatable, intent(out) :: error
        type(motion_type), allocatable :: motions(:)
        logical, allocatable :: start(:), wrong(:)
        logical :: settled, refined
        integer :: attempt

        if (checked) call require(size(closed) == size(beam%supports), "find_scheme: closed")
        closed = closed .or. always_closed(beam%supports)
        call separate_rigid_pairs(beam%supports, size(beam%links), closed)
        work%solves = 0
        work%came_back = .false.
        work%ease = 0.0_wp
        call free_motions(beam, always_closed(beam%supports), motions)
        allocate (start(size(closed)), wrong(size(closed)))
        start = closed
        refined = .false.
        do attempt = 1, 2
            call settle(beam, rule, size(motions) > 0, closed, work, settled, error, carefully=attempt == 2)
            if (allocated(error)) return
            if (.not. settled) then
                closed = start
                call iterate_floating(beam, factor, rule, closed, work, outcome, refined, error)
                if (allocated(error)) call look_for_motion(beam, factor, rule, start, outcome, error)
            end if
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            if (checked) call require(all(closed .or. .not. always_closed(beam%supports)), "find_scheme: opened a bilateral one")
            ! Once, so that the last digits are those of the scheme, whatever way led to it
            if (.not. refined) call refine_scheme(beam, closed, work)
            if (.not. (settled .and. work%from_both_ends .and. is_finite(work))) exit
            call find_wrong(beam, closed, first_width, work, wrong)
            if (.not. any(wrong)) exit
            ! That has turned a sign
        end do
        if (.not. is_finite(work)) then
            call fatal_error(error, gapbeam_not_finite, "numbers left the range of double precision: choose units " &
                //"in which lengths, stiffnesses and loads are nearer to 1")
        end if
    end subroutine find_scheme

    !> A beam whose reactions statics cannot tell apart may still have no equilibrium. That does not depend on how stiff
    !> its supports are, so it is decided with soft ones
    subroutine look_for_motion(beam, factor, rule, start, outcome, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(in) :: start(:)
        type(outcome_type), intent(inout) :: outcome
        !> Why the beam itself could not be solved; gone if it has no equilibrium
        type(error_type), allocatable, intent(inout) :: error
        type(beam_type) :: soft
        type(workspace_type) :: work
        type(error_type), allocatable :: another
        logical, allocatable :: closed(:)
        real(wp) :: stiffness
        logical :: refined

        if (error%code /= gapbeam_indeterminate) return
        allocate (closed(size(start)))
        closed(:) = start
        soft = beam
        stiffness = softest(beam)
        call limit_stiffness(soft%supports, stiffness)
        call new_workspace(soft, work)
        call set_loads(soft, factor, work)
        call iterate_floating(soft, factor, rule, closed, work, outcome, refined, another)
        if (outcome%status == gapbeam_no_equilibrium .and. .not. allocated(another)) deallocate (error)
    end subroutine look_for_motion

    !> The same for a beam that can float: weak springs, and a reference position that follows
    subroutine iterate_floating(beam, factor, rule, closed, work, outcome, refined, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(inout) :: outcome
        !> Has the solution been refined
        logical, intent(out) :: refined
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: wrong(:)
        type(runaway_type), allocatable :: runaways(:)
        real(wp), allocatable :: eased(:), direction(:)
        real(wp) :: ease, way, moved, moved_before
        logical :: settled, stable, in_doubt, at_rest
        integer :: move, state, place, r

        allocate (wrong(size(closed)), eased(0:size(beam%links)), direction(0:size(beam%links)))
        ease = ease_ratio*softest(beam)
        work%reference = 0.0_wp
        moved_before = huge(moved_before)
        refined = .false.
        do move = 1, most_moves
            work%ease = ease
            call settle(beam, rule, .false., closed, work, settled, error)
            if (allocated(error)) return
            if (.not. work%complete) call complete_scheme(beam, closed, work)
            eased = work%answers%deflection
            ! Does the scheme hold without the springs?
            call find_runaways(beam, factor, closed, direction, runaways, stable, in_doubt)
            if (stable) then
                work%ease = 0.0_wp
                call solve_and_refine(beam, closed, work, state, place)
                if (state == band_needs_pivoting) call refuse_scheme(beam, state, place, error)
                if (allocated(error)) return
                if (state == band_ok) then
                    call find_wrong(beam, closed, first_width, work, wrong)
                    refined = .not. any(wrong)
                    if (refined) return
                end if
            else if (size(runaways) == 0) then
                ! Free to move, but no load does work: the springs carry nothing once the reference has come to rest, but for
                ! what loads that balance each other have left to rounding
                moved = maxval(abs(eased - work%reference))
                at_rest = moved <= max(4096*epsilon(1.0_wp)*maxval(abs(eased)), epsilon(1.0_wp)*maxval(work%shear_size)/ease) &
                    .or. (moved <= least_force*maxval(work%load_size)/ease .and. moved > moved_before/2)
                moved_before = moved
                if (at_rest) then
                    outcome%indifferent = .true.
                    outcome%in_doubt = in_doubt
                    return
                end if
            else
                do r = 1, size(runaways)
                    associate (from => runaways(r)%first, to => runaways(r)%last)
                        way = distance_to_contact(beam%supports, beam%order(beam%first(from):beam%first(to + 1) - 1), closed, &
                                                  direction, eased, no_speed)
                        if (.not. way < huge(way)) then
                            outcome%status = gapbeam_no_equilibrium
                            direction(:from - 1) = 0.0_wp
                            direction(to + 1:) = 0.0_wp
                            outcome%in_doubt = in_doubt .or. is_blocked(beam%supports, direction)
                            call prefer_tipping(beam, factor, direction)
                            allocate (outcome%motion(0:size(beam%links)))
                            outcome%motion(:) = direction
                            return
                        end if
                        eased(from:to) = eased(from:to) + way*direction(from:to)
                    end associate
                end do
            end if
            work%reference = eased
        end do
        call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that the working scheme "// &
                         "could not be settled: give it a support that holds both ways, or check the loads")
    end subroutine iterate_floating

    !> The free motions into which the loads push the beam while a scheme acts: of each part that moves by itself the
    !> combination of its independent motions whose work is greatest for its size, the direction in which the weak springs give
    !> way
    subroutine find_runaways(beam, factor, closed, direction, runaways, stable, in_doubt)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> Displacements of the nodes, largest 1 in every part; zero if no load does work
        real(wp), intent(out) :: direction(0:)
        !> The parts that the loads move
        type(runaway_type), allocatable, intent(out) :: runaways(:)
        !> Is there no free motion at all; is work of the loads near its rounding error
        logical, intent(out) :: stable, in_doubt
        type(motion_type), allocatable :: motions(:)
        real(wp), allocatable :: y(:), level(:), gram(:, :), share(:)
        real(wp) :: parts, largest
        integer :: k, begin, finish, last, number

        call free_motions(beam, closed, motions)
        stable = size(motions) == 0
        in_doubt = .false.
        direction = 0.0_wp
        allocate (runaways(0))
        if (stable) return
        allocate (share(size(motions)), y(0:size(beam%links)), level(0:size(beam%links)))
        y(:) = 0.0_wp
        call find_level_forces(beam%supports, closed, level)
        do k = 1, size(motions)
            associate (motion => motions(k))
                y(motion%first:motion%last) = motion%displacement
                call work_of_loads(beam, factor, y, [motion%first, motion%last], share(k), parts)
                y(motion%first:motion%last) = 0.0_wp
                ! Less what supports that yield take of it
                associate (taken => level(motion%first:motion%last)*motion%displacement)
                    share(k) = share(k) - sum(taken)
                    parts = parts + sum(abs(taken))
                end associate
            end associate
            in_doubt = in_doubt .or. (abs(share(k)) > 0.0_wp .and. abs(share(k)) <= clearly_more*no_work*parts)
            if (abs(share(k)) <= no_work*parts) share(k) = 0.0_wp
        end do
        deallocate (runaways)
        allocate (runaways(size(motions)))
        number = 0
        begin = 1
        do while (begin <= size(motions))
            finish = begin
            last = motions(begin)%last
            do while (finish < size(motions))
                if (motions(finish + 1)%first > last) exit
                finish = finish + 1
                last = max(last, motions(finish)%last)
            end do
            call overlaps(motions(begin:finish), gram)
            call solve_gram(gram, share(begin:finish))
            do k = begin, finish
                associate (d => direction(motions(k)%first:motions(k)%last))
                    d = d + share(k)*motions(k)%displacement
                end associate
            end do
            associate (first => motions(begin)%first)
                largest = maxval(abs(direction(first:last)))
                if (largest > 0.0_wp) then
                    direction(first:last) = direction(first:last)/largest
                    number = number + 1
                    runaways(number) = runaway_type(first, last)
                end if
            end associate
            begin = finish + 1
        end do
        runaways = runaways(1:number)
    end subroutine find_runaways

    !> Scalar products of motions and those before them that they overlap with: gram(j, k) of motions k and k - j
    pure subroutine overlaps(motions, gram)
        type(motion_type), intent(in) :: motions(:)
        real(wp), allocatable, intent(out) :: gram(:, :)
        integer :: j, k, width, from, to

        width = 0
        do k = 1, size(motions)
            do j = 1, k - 1
                if (motions(j)%last < motions(k)%first) cycle
                width = max(width, k - j)
                exit
            end do
        end do
        allocate (gram(0:width, size(motions)))
        gram(:, :) = 0.0_wp
        do k = 1, size(motions)
            do j = 0, min(width, k - 1)
                from = max(motions(k)%first, motions(k - j)%first)
                to = min(motions(k)%last, motions(k - j)%last)
                if (from <= to) gram(j, k) = dot_product(motions(k)%displacement(from:to), motions(k - j)%displacement(from:to))
            end do
        end do
    end subroutine overlaps

    !> Solve with a band of scalar products (Cholesky, without roots); the motions are independent, so it is positive definite
    pure subroutine solve_gram(gram, share)
        !> Overwritten
        real(wp), intent(inout) :: gram(0:, :)
        !> Right-hand side in, solution out
        real(wp), intent(inout) :: share(:)
        real(wp) :: multiplier
        integer :: i, j, k, width

        width = ubound(gram, 1)
        do k = 1, size(share)
            do i = k + 1, min(k + width, size(share))
                multiplier = gram(i - k, i)/gram(0, k)
                share(i) = share(i) - multiplier*share(k)
                do j = i, min(k + width, size(share))
                    gram(j - i, j) = gram(j - i, j) - multiplier*gram(j - k, j)
                end do
            end do
        end do
        do k = size(share), 1, -1
            do i = k + 1, min(k + width, size(share))
                share(k) = share(k) - gram(i - k, i)*share(i)
            end do
            share(k) = share(k)/gram(0, k)
        end do
    end subroutine solve_gram

    !> Of the ways in which a beam without hinges can go, the plainest: tipping about one of its supports, or moving as a
    !> whole; the one along which the loads do most work. The motion found is kept if none of these is free. Only the
    !> outermost supports of each side can be what the beam tips about: the next ones would be in the way
    subroutine prefer_tipping(beam, factor, direction)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        real(wp), intent(inout) :: direction(0:)
        real(wp), allocatable :: x(:), y(:), best(:)
        real(wp) :: most
        integer :: i, n, side, tips(2)

        n = size(beam%links)
        if (any(beam%kind == hinge)) return
        allocate (x(0:n), y(0:n), best(0:n))
        x(0) = 0.0_wp
        do i = 1, n
            x(i) = x(i - 1) + beam%links(i)%length
        end do
        most = 0.0_wp
        best(:) = direction
        y(:) = 1.0_wp
        call consider()
        do side = above, below
            if (any(beam%kind == restrained)) exit
            tips = outermost(beam%supports, side)
            if (tips(1) > tips(2)) cycle
            do i = 1, 2
                y(:) = x - x(tips(i))
                call consider()
            end do
        end do
        direction(:) = best

    contains

        !> Take the motion y, or its opposite, if it is free and does more work than any before
        subroutine consider()
            real(wp) :: done, parts
            integer :: way

            y(:) = y/maxval(abs(y))
            do way = 1, 2
                y(:) = -y
                if (is_blocked(beam%supports, y)) cycle
                call work_of_loads(beam, factor, y, [0, n], done, parts)
                if (done <= max(most, no_work*parts)) cycle
                most = done
                best(:) = y
            end do
        end subroutine consider

    end subroutine prefer_tipping

end module gapbeam_scheme
