!> The working scheme of a beam, or the proof that there is none.
!>
!> Where the bilateral supports alone hold the beam every scheme is stable, and gapbeam_search ends with the right one.
!> Other beams may pass through mechanisms. Then weak springs towards a reference position hold it, the reference
!> moves to the solution, and this is repeated: the proximal point method (Rockafellar 1976). The springs are
!> gone from the final answer. If the reference runs away along a free motion that no support can stop and along
!> which the loads do work, there is no equilibrium: that motion is the proof (Farkas' lemma).
module gapbeam_scheme
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_band, only: band_ok, band_needs_pivoting, hinge, restrained
    use gapbeam_model, only: beam_type, both, softest
    use gapbeam_kinematics, only: free_motions, motion_type, work_of_loads
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: solve_scheme, refine_scheme
    use gapbeam_rules, only: find_wrong, separate_rigid_pairs
    use gapbeam_search, only: settle, refuse, first_width
    implicit none
    private
    public :: find_scheme, outcome_type

    !> Weak springs relative to the softest stiffness present
    real(wp), parameter :: ease_ratio = 1e-5_wp
    !> Moves of the reference position before giving up
    integer, parameter :: most_moves = 200

    !> How the search ended, apart from errors
    type :: outcome_type
        !> gapbeam_solved or gapbeam_no_equilibrium
        integer :: status = gapbeam_solved
        !> The free motion, where there is no equilibrium, shape (0:n)
        real(wp), allocatable :: motion(:)
        !> Can the beam move freely without work of the loads (forces are unique, the position is not)
        logical :: indifferent = .false.
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
        logical, allocatable :: start(:)
        logical :: settled

        closed = closed .or. beam%supports%side == both
        call separate_rigid_pairs(beam, closed)
        work%solves = 0
        work%ease = 0.0_wp
        call free_motions(beam, beam%supports%side == both, motions)
        allocate (start(size(closed)))
        start = closed
        call settle(beam, rule, size(motions) > 0, closed, work, settled, error)
        if (allocated(error)) return
        if (.not. settled) then
            closed = start
            call iterate_floating(beam, factor, rule, closed, work, outcome, error)
            if (allocated(error)) call look_for_motion(beam, factor, rule, start, outcome, error)
        end if
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        call refine_scheme(beam, closed, work)
        if (.not. all(abs(work%answers%deflection) <= huge(1.0_wp)) .or. &
            .not. all(abs(work%answers%moment_left) <= huge(1.0_wp))) then
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

        if (error%code /= gapbeam_indeterminate) return
        allocate (closed(size(start)))
        closed(:) = start
        soft = beam
        stiffness = softest(beam)
        where (soft%supports%stiffness > stiffness) soft%supports%stiffness = stiffness
        call new_workspace(soft, work)
        call set_loads(soft, factor, work)
        call iterate_floating(soft, factor, rule, closed, work, outcome, another)
        if (outcome%status == gapbeam_no_equilibrium .and. .not. allocated(another)) deallocate (error)
    end subroutine look_for_motion

    !> The same for a beam that can float: weak springs, and a reference position that follows
    subroutine iterate_floating(beam, factor, rule, closed, work, outcome, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(outcome_type), intent(inout) :: outcome
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: wrong(:)
        real(wp), allocatable :: eased(:), direction(:)
        real(wp) :: ease, way
        logical :: settled, stable
        integer :: move, state, place

        allocate (wrong(size(closed)), eased(0:size(beam%links)), direction(0:size(beam%links)))
        ease = ease_ratio*softest(beam)
        work%reference = 0.0_wp
        do move = 1, most_moves
            work%ease = ease
            call settle(beam, rule, .false., closed, work, settled, error)
            if (allocated(error)) return
            eased = work%answers%deflection
            ! Does the scheme hold without the springs?
            call runaway(beam, factor, closed, direction, stable)
            if (stable) then
                work%ease = 0.0_wp
                call solve_scheme(beam, closed, work, state, place)
                if (state == band_needs_pivoting) call refuse(beam, state, place, error)
                if (allocated(error)) return
                if (state == band_ok) then
                    call refine_scheme(beam, closed, work)
                    call find_wrong(beam, closed, first_width, work, wrong)
                    if (.not. any(wrong)) return
                end if
            else if (.not. any(abs(direction) > 0.0_wp)) then
                ! Free to move, but no load does work: the springs carry nothing once the reference has come to rest
                if (maxval(abs(eased - work%reference)) <= max(1e-12_wp*maxval(abs(eased)), &
                                                               epsilon(1.0_wp)*maxval(work%shear_size)/ease)) then
                    outcome%indifferent = .true.
                    return
                end if
            else
                way = distance_to_contact(beam, closed, direction, eased)
                if (.not. way < huge(way)) then
                    outcome%status = gapbeam_no_equilibrium
                    call prefer_tipping(beam, factor, direction)
                    allocate (outcome%motion(0:size(beam%links)))
                    outcome%motion(:) = direction
                    return
                end if
                eased = eased + way*direction
            end if
            work%reference = eased
        end do
        call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that the working scheme "// &
                         "could not be settled: give it a support that holds both ways, or check the loads")
    end subroutine iterate_floating

    !> The free motion into which the loads push the beam while a scheme acts: the combination of the independent
    !> motions whose work is greatest for its size, the direction in which the weak springs give way
    subroutine runaway(beam, factor, closed, direction, stable)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> Displacements of the nodes, largest 1; zero if no load does work
        real(wp), intent(out) :: direction(0:)
        !> Is there no free motion at all
        logical, intent(out) :: stable
        type(motion_type), allocatable :: motions(:)
        real(wp), allocatable :: gram(:, :), share(:)
        real(wp) :: parts, largest
        integer :: k, j, m

        call free_motions(beam, closed, motions)
        m = size(motions)
        stable = m == 0
        direction = 0.0_wp
        if (stable) return
        allocate (gram(m, m), share(m))
        do k = 1, m
            call work_of_loads(beam, factor, motions(k)%displacement, share(k), parts)
            if (abs(share(k)) <= 1e-12_wp*parts) share(k) = 0.0_wp
            do j = 1, k
                gram(k, j) = dot_product(motions(k)%displacement, motions(j)%displacement)
                gram(j, k) = gram(k, j)
            end do
        end do
        ! Cholesky elimination; the motions are independent, so the matrix is positive definite
        do k = 1, m
            do j = k + 1, m
                share(j) = share(j) - gram(j, k)/gram(k, k)*share(k)
                gram(j, k + 1:) = gram(j, k + 1:) - gram(j, k)/gram(k, k)*gram(k, k + 1:)
            end do
        end do
        do k = m, 1, -1
            share(k) = (share(k) - dot_product(gram(k, k + 1:), share(k + 1:)))/gram(k, k)
            direction = direction + share(k)*motions(k)%displacement
        end do
        largest = maxval(abs(direction))
        if (largest > 0.0_wp) direction = direction/largest
    end subroutine runaway

    !> Of the ways in which a beam without hinges can go, the plainest: tipping about one of its supports, or moving as a
    !> whole; the one along which the loads do most work. The motion found is kept if none of these is free. Only the
    !> outermost supports of each side can be what the beam tips about: the next ones would be in the way
    subroutine prefer_tipping(beam, factor, direction)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        real(wp), intent(inout) :: direction(0:)
        real(wp), allocatable :: x(:), y(:), best(:)
        logical, allocatable :: member(:)
        real(wp) :: most
        integer :: i, n, side

        n = size(beam%links)
        if (any(beam%kind == hinge)) return
        allocate (x(0:n), y(0:n), best(0:n), member(size(beam%supports)))
        x(0) = 0.0_wp
        do i = 1, n
            x(i) = x(i - 1) + beam%links(i)%length
        end do
        most = 0.0_wp
        best(:) = direction
        y(:) = 1.0_wp
        call consider()
        do side = -1, 1
            if (any(beam%kind == restrained)) exit
            member(:) = beam%supports%side == side .and. beam%supports%stiffness > 0.0_wp
            if (.not. any(member)) cycle
            y(:) = x - x(minval(beam%supports%node, member))
            call consider()
            y(:) = x - x(maxval(beam%supports%node, member))
            call consider()
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
                associate (s => beam%supports)
                    if (any(s%stiffness > 0.0_wp .and. (s%side*y(s%node) > 0.0_wp &
                                                        .or. (s%side == both .and. abs(y(s%node)) > 0.0_wp)))) cycle
                end associate
                call work_of_loads(beam, factor, y, done, parts)
                if (done <= max(most, 1e-12_wp*parts)) cycle
                most = done
                best(:) = y
            end do
        end subroutine consider

    end subroutine prefer_tipping

    !> How far the beam can go along a motion until an open support is met
    pure function distance_to_contact(beam, closed, direction, deflection) result(way)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: direction(0:), deflection(0:)
        real(wp) :: way, speed
        integer :: k

        way = huge(way)
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                speed = s%side*direction(s%node)
                if (closed(k) .or. .not. speed > 1e-13_wp .or. .not. s%stiffness > 0.0_wp) cycle
                way = min(way, max(0.0_wp, s%side*(s%contact - deflection(s%node))/speed))
            end associate
        end do
    end function distance_to_contact

end module gapbeam_scheme
