!> The working scheme: which one-sided supports act.
!>
!> A scheme is right when no closed support pulls and no open one is penetrated. Two rules find it.
!>
!> single   the paper's: put back the open supports that are penetrated, else release the closed one that pulls
!>          most, until nothing changes. Not proved finite; if a scheme comes back, block goes on.
!> block    change every wrong support at once while the number of wrong ones falls; when it does not fall, for a few
!>          solves the paper's rule in every neighbourhood at once, then the wrong support of least index
!>          until it falls again. Finite for every stable beam: the problem is a linear complementarity problem
!>          with a P-matrix, for which the least-index rule never repeats a scheme (Murty 1974; Judice and
!>          Pires 1994).
!>
!> A beam that its bilateral supports alone do not hold may pass through mechanisms. Then weak springs towards a
!> reference position hold it, the reference moves to the solution, and this is repeated: the proximal point
!> method (Rockafellar 1976). The springs are gone from the final answer. If the reference runs away along a
!> free motion that no support can stop and along which the loads do work, there is no equilibrium.
module gapbeam_scheme
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_no_equilibrium, &
        gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_band, only: band_ok, band_mechanism, band_needs_pivoting
    use gapbeam_model, only: beam_type, both, is_rigid
    use gapbeam_kinematics, only: free_motions, motion_type, work_of_loads
    use gapbeam_system, only: workspace_type, solve_scheme
    use gapbeam_rules, only: find_wrong, keep_worst, keep_least_index, left_to_right
    implicit none
    private
    public :: find_scheme, rule_block, rule_single, outcome_type

    !> The two rules
    integer, parameter :: rule_block = 0, rule_single = 1
    !> Solves without progress after which the block rule falls back to the least index
    integer, parameter :: patience = 2
    !> Weak springs relative to the softest stiffness present
    real(wp), parameter :: ease_ratio = 1e-5_wp
    !> Moves of the reference position before giving up
    integer, parameter :: most_moves = 200
    !> Signs are decided beyond this many rounding errors; widened where they still flicker, up to a limit
    real(wp), parameter :: first_width = 32.0_wp, last_width = 1e7_wp

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
        !> rule_block or rule_single
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
        call iterate(beam, rule, size(motions) > 0, closed, work, settled, error)
        if (allocated(error)) return
        if (.not. settled) then
            closed = start
            call iterate_floating(beam, factor, rule, closed, work, outcome, error)
        end if
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        if (.not. all(abs(work%answers%deflection) <= huge(1.0_wp)) .or. &
            .not. all(abs(work%answers%moment_left) <= huge(1.0_wp))) then
            call fatal_error(error, gapbeam_not_finite, "numbers left the range of double precision: choose units " &
                //"in which lengths, stiffnesses and loads are nearer to 1")
        end if
    end subroutine find_scheme

    !> Change supports until none is wrong. With may_float it gives up (settled is false) at a mechanism or when the
    !> block rule stops making progress
    subroutine iterate(beam, rule, may_float, closed, work, settled, error)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: rule
        logical, intent(in) :: may_float
        logical, intent(inout) :: closed(:)
        type(workspace_type), intent(inout) :: work
        logical, intent(out) :: settled
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: wrong(:), mark(:)
        integer, allocatable :: order(:)
        integer :: active_rule, wrong_now, fewest, chances, state, place, since_mark, next_mark
        real(wp) :: width

        allocate (wrong(size(closed)), mark(size(closed)))
        allocate (order(size(closed)))
        order(:) = left_to_right(beam)
        active_rule = rule
        width = first_width
        fewest = huge(fewest)
        chances = patience
        mark = closed
        since_mark = 0
        next_mark = 1
        do
            call solve_scheme(beam, closed, work, state, place)
            settled = .false.
            if (state == band_mechanism .and. may_float) return
            if (state /= band_ok) then
                call refuse(beam, state, place, error)
                return
            end if
            call find_wrong(beam, closed, width, work, wrong)
            wrong_now = count(wrong)
            settled = wrong_now == 0
            if (settled) return
            if (active_rule == rule_single) then
                call keep_worst(beam, order, closed, work, .false., wrong)
            else if (wrong_now < fewest) then
                fewest = wrong_now
                chances = patience
            else if (chances > 0) then
                chances = chances - 1
                call keep_worst(beam, order, closed, work, .true., wrong)
            else
                if (may_float) return
                if (chances == 0) then
                    chances = -1
                    since_mark = 0
                    next_mark = 1
                    mark = closed
                end if
                call keep_least_index(wrong)
            end if
            closed = closed .neqv. wrong
            ! A scheme that comes back (Brent 1980): the single rule cycles, or rounding decides signs
            if (active_rule == rule_single .or. chances < 0) then
                since_mark = since_mark + 1
                if (all(closed .eqv. mark)) then
                    if (active_rule == rule_single) then
                        active_rule = rule_block
                    else
                        width = 16*width
                        if (width > last_width) then
                            call fatal_error(error, gapbeam_not_converged, "the signs of some reactions or openings "// &
                                             "cannot be told from rounding errors in double precision")
                            settled = .false.
                            return
                        end if
                    end if
                else if (since_mark == next_mark) then
                    mark = closed
                    since_mark = 0
                    next_mark = 2*next_mark
                end if
            end if
        end do
    end subroutine iterate

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
            call iterate(beam, rule, .false., closed, work, settled, error)
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
                    outcome%motion = direction
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

    !> The softest stiffness of the beam and its supports, force per length
    pure function softest(beam) result(stiffness)
        type(beam_type), intent(in) :: beam
        real(wp) :: stiffness
        integer :: i

        stiffness = huge(stiffness)
        do i = 1, size(beam%links)
            associate (link => beam%links(i))
                if (link%bending > 0.0_wp) stiffness = min(stiffness, 1/(link%bending*link%length**2))
            end associate
        end do
        do i = 1, size(beam%supports)
            associate (s => beam%supports(i))
                if (s%stiffness > 0.0_wp) stiffness = min(stiffness, s%stiffness)
            end associate
        end do
        if (.not. stiffness < huge(stiffness)) stiffness = 1.0_wp
    end function softest

    !> Two rigid supports with clearance at one node cannot both act: begin with the first of them
    pure subroutine separate_rigid_pairs(beam, closed)
        type(beam_type), intent(in) :: beam
        logical, intent(inout) :: closed(:)
        logical, allocatable :: taken(:)
        integer :: k

        allocate (taken(0:size(beam%links)))
        taken = .false.
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (.not. closed(k) .or. .not. is_rigid(s)) cycle
                closed(k) = .not. taken(s%node)
                taken(s%node) = .true.
            end associate
        end do
    end subroutine separate_rigid_pairs

    !> A scheme that cannot be solved though all that holds the beam acts
    subroutine refuse(beam, state, place, error)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: state, place
        type(error_type), allocatable, intent(out) :: error
        character(len=40) :: text

        write (text, "(i0, a, i0)") place, " of ", size(beam%links)
        if (state == band_needs_pivoting) then
            call fatal_error(error, gapbeam_indeterminate, "a rigid stretch of the beam near node "//trim(text)// &
                             " rests on more rigid supports than statics can tell apart: give the stretch"// &
                             " or one of its supports a finite stiffness")
        else
            call fatal_error(error, gapbeam_not_converged, "the scheme near node "//trim(text)//" cannot be solved")
        end if
    end subroutine refuse

end module gapbeam_scheme
