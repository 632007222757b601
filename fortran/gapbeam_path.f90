!> The path of the solution over the load factor, from one change of the working scheme to the next.
!>
!> While a scheme acts, all values are linear in the load factor: v = v0 + factor v1, with v0 from the dead loads and
!> the contact levels, v1 from the live loads alone. The next event is the smallest factor ahead at which the
!> reaction of a closed support or the opening of an open one becomes zero; it follows from v0 and v1 directly,
!> so nothing accumulates along the path. What happens there is decided by the rate problem: supports at zero are
!> one-sided without gap, other closed ones hold, other open ones are absent, and the live loads act alone. Mostly what
!> moves through zero simply changes; if the rates then have the right signs, that is the solution of the rate
!> problem. If not, it is a contact problem of its own, so any number of simultaneous changes is settled at once (parametric
!> linear complementarity, Cottle 1972). Every scheme is right on one interval of factors only, so there are
!> finitely many events.
!>
!> v0 and v1 are kept up to date around the supports that change (gapbeam_update), and a queue holds the factors at which
!> the supports reach zero, so an event costs what it changes, not the whole beam.
module gapbeam_path
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged, gapbeam_solved
    use gapbeam_band, only: band_ok
    use gapbeam_model, only: beam_type, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_update, only: start_updates, update_scheme, find_groups
    use gapbeam_queue, only: queue_type, new_queue, set_key, first_key, all_up_to
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_search, only: first_width
    implicit none
    private
    public :: follow_load, find_marginal, path_type

    !> Changes of the scheme along the path, in the order in which they happen
    type :: path_type
        !> How many there are in the arrays
        integer :: count = 0
        !> Load factor, and support that opens or closes
        real(wp), allocatable :: factor(:)
        integer, allocatable :: support(:)
        !> Linear solves of the whole beam; nodes at which the solution was made anew besides
        integer :: solves = 0, nodes = 0
    end type path_type

    !> What is known on a stretch of the path
    type :: stretch_type
        !> The beam without its dead loads and gaps
        type(beam_type) :: incremental
        !> v0 and v1
        type(workspace_type) :: dead, live
        !> Is their solution that of the scheme at hand
        logical :: current = .false.
        !> Factors at which supports come near zero
        type(queue_type) :: queue
    end type stretch_type

    !> Reaction or opening of a support as a line over the load factor, counted positive, and the errors of its coefficients
    type :: line_type
        real(wp) :: v0 = 0.0_wp, v1 = 0.0_wp, error_of_v0 = 0.0_wp, error_of_v1 = 0.0_wp
    end type line_type

contains

    !> Supports whose reaction or opening is zero in a solved state: they may change without notice
    pure subroutine find_marginal(beam, closed, work, marginal)
        !> The beam, the scheme, and the workspace with its solution
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(in) :: work
        !> The supports at zero
        logical, intent(out) :: marginal(:)
        integer :: k

        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (s%side == both .or. .not. s%stiffness > 0.0_wp) then
                    marginal(k) = .false.
                else if (closed(k)) then
                    marginal(k) = abs(work%reaction(k)) <= first_width*work%reaction_error(k)
                else
                    marginal(k) = abs(s%contact - work%answers(s%node)%deflection) &
                        <= first_width*epsilon(1.0_wp)*max(work%deflection_size(s%node), abs(s%contact))
                end if
            end associate
        end do
    end subroutine find_marginal

    !> Follow the load from one factor to another
    subroutine follow_load(beam, limit, rule, most, factor, closed, marginal, path, outcome, error)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> Load factor to go to
        real(wp), intent(in) :: limit
        !> How rate problems are solved
        integer, intent(in) :: rule
        !> Changes after which it stops to be called again; a few more may be made
        integer, intent(in) :: most
        !> Load factor of the state at hand in; how far it went out, or above which there is no equilibrium
        real(wp), intent(inout) :: factor
        !> Scheme at that factor
        logical, intent(inout) :: closed(:)
        !> Supports at zero at that factor
        logical, intent(inout) :: marginal(:)
        !> The changes, those at the first factor included
        type(path_type), intent(out) :: path
        !> No equilibrium above the factor reached: the beam begins to move
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: stretch
        integer, allocatable :: at_zero(:)
        real(wp) :: next
        integer :: k

        allocate (path%factor(max(most, 1)), path%support(max(most, 1)))
        call new_stretch(beam, stretch)
        at_zero = pack([(k, k=1, size(closed))], marginal)
        do
            call change_at(beam, rule, factor, closed, at_zero, stretch, path, outcome, error)
            if (allocated(error) .or. outcome%status /= gapbeam_solved) exit
            call find_next(beam, closed, factor, stretch, at_zero, next)
            if (next >= limit) at_zero = [integer ::]
            factor = min(next, limit)
            if (next >= limit .or. path%count >= most) exit
        end do
        marginal = .false.
        marginal(at_zero) = .true.
    end subroutine follow_load

    !> Room for what is known on a stretch of the path
    subroutine new_stretch(beam, stretch)
        type(beam_type), intent(in) :: beam
        type(stretch_type), intent(out) :: stretch
        integer :: i

        stretch%incremental = beam
        stretch%incremental%supports%contact = 0.0_wp
        stretch%incremental%force(1, :) = 0.0_wp
        stretch%incremental%couple(1, :) = 0.0_wp
        do i = 1, size(beam%links)
            associate (link => stretch%incremental%links(i))
                link%turn_a(1) = 0.0_wp
                link%turn_b(1) = 0.0_wp
                link%shear_a(1) = 0.0_wp
                link%shear_b(1) = 0.0_wp
            end associate
        end do
        call new_workspace(beam, stretch%dead)
        call set_loads(beam, 0.0_wp, stretch%dead)
        call new_workspace(beam, stretch%live)
        call set_loads(stretch%incremental, 1.0_wp, stretch%live)
        call new_queue(size(beam%supports), stretch%queue)
    end subroutine new_stretch

    !> From the scheme at a factor to the one just above it
    subroutine change_at(beam, rule, factor, closed, at_zero, stretch, path, outcome, error)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: rule
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        !> Supports at zero, those that stay there out
        integer, allocatable, intent(inout) :: at_zero(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: before(:)
        integer, allocatable :: moving(:)
        integer :: k, j

        if (stretch%current) then
            moving = pack(at_zero, [(moves(line_of(beam, closed(at_zero(j)), at_zero(j), stretch)), j=1, size(at_zero))])
            call change_supports(beam, moving, factor, closed, stretch, path)
            if (stretch%current) stretch%current = .not. any([(moves(line_of(beam, closed(at_zero(j)), at_zero(j), stretch)), &
                                                               j=1, size(at_zero))])
            if (.not. stretch%current) closed(moving) = .not. closed(moving)
        end if
        if (stretch%current) then
            do j = 1, size(moving)
                call add_change(path, factor, moving(j))
            end do
        else
            allocate (before(size(closed)))
            before(:) = closed
            call solve_rates(rule, at_zero, closed, stretch, path, outcome, error)
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            do k = 1, size(closed)
                if (closed(k) .neqv. before(k)) call add_change(path, factor, k)
            end do
            call start_stretch(beam, factor, closed, stretch, path, error)
            if (allocated(error)) return
        end if
        at_zero = pack(at_zero, [(stays(line_of(beam, closed(at_zero(j)), at_zero(j), stretch), factor), j=1, size(at_zero))])
    end subroutine change_at

    !> Change supports in v0 and v1, and in the queue; afterwards the stretch is not current if that is not possible
    subroutine change_supports(beam, changed, factor, closed, stretch, path)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: changed(:)
        real(wp), intent(in) :: factor
        logical, intent(inout) :: closed(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        integer :: groups(2, size(changed)), count, window(2), window_of_live(2), state, i, j

        closed(changed) = .not. closed(changed)
        call find_groups(beam, changed, groups, count)
        do j = 1, count
            call update_scheme(beam, closed, groups(:, j), .true., stretch%dead, window, state)
            if (state == band_ok) call update_scheme(stretch%incremental, closed, groups(:, j), .true., stretch%live, &
                                                     window_of_live, state)
            stretch%current = state == band_ok
            if (.not. stretch%current) return
            window = [min(window(1), window_of_live(1)), max(window(2), window_of_live(2))]
            path%nodes = path%nodes + window(2) - window(1) + 1
            do i = beam%first(window(1)), beam%first(window(2) + 1) - 1
                call queue_support(beam, closed, beam%order(i), factor, stretch)
            end do
        end do
    end subroutine change_supports

    !> Solve v0 and v1 of a scheme anew
    subroutine start_stretch(beam, factor, closed, stretch, path, error)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        type(stretch_type), intent(inout) :: stretch
        type(path_type), intent(inout) :: path
        type(error_type), allocatable, intent(out) :: error
        logical :: solved, follows, live_follows
        integer :: k

        call start_updates(beam, closed, stretch%dead, solved, follows)
        if (solved) call start_updates(stretch%incremental, closed, stretch%live, solved, live_follows)
        if (.not. solved) then
            call fatal_error(error, gapbeam_not_converged, "above this load factor the beam can move freely without work of "// &
                             "the loads, so there is no single path of its supports: follow the load by steps")
            return
        end if
        path%solves = path%solves + 2
        stretch%current = follows .and. live_follows
        do k = 1, size(closed)
            call queue_support(beam, closed, k, factor, stretch)
        end do
    end subroutine start_stretch

    !> Reaction or opening of a support over the load factor
    pure function line_of(beam, closed, k, stretch) result(line)
        type(beam_type), intent(in) :: beam
        !> Does the support act
        logical, intent(in) :: closed
        integer, intent(in) :: k
        type(stretch_type), intent(in) :: stretch
        type(line_type) :: line

        associate (s => beam%supports(k), dead => stretch%dead, live => stretch%live)
            if (s%side == both .or. .not. s%stiffness > 0.0_wp) return
            if (closed) then
                line%v0 = s%side*dead%reaction(k)
                line%v1 = s%side*live%reaction(k)
                line%error_of_v0 = first_width*dead%reaction_error(k)
                line%error_of_v1 = first_width*live%reaction_error(k)
            else
                line%v0 = s%side*(s%contact - dead%answers(s%node)%deflection)
                line%v1 = -s%side*live%answers(s%node)%deflection
                line%error_of_v0 = first_width*epsilon(1.0_wp)*max(dead%deflection_size(s%node), abs(s%contact))
                line%error_of_v1 = first_width*epsilon(1.0_wp)*live%deflection_size(s%node)
            end if
        end associate
    end function line_of

    !> Does a line fall as the factor grows
    elemental function moves(line)
        type(line_type), intent(in) :: line
        logical :: moves

        moves = line%v1 < -line%error_of_v1
    end function moves

    !> How near to zero counts as zero at a factor
    elemental function width_of(line, factor) result(width)
        type(line_type), intent(in) :: line
        real(wp), intent(in) :: factor
        real(wp) :: width

        width = max(line%error_of_v0 + factor*line%error_of_v1, &
                    4*epsilon(1.0_wp)*max(abs(line%v0), factor*abs(line%v1)))
    end function width_of

    !> Is a line at zero, and does it stay there
    elemental function stays(line, factor)
        type(line_type), intent(in) :: line
        real(wp), intent(in) :: factor
        logical :: stays

        stays = abs(line%v1) <= line%error_of_v1 .and. abs(line%v0 + factor*line%v1) <= width_of(line, factor)
    end function stays

    !> The factor at which a falling line is zero
    elemental function zero_of(line, factor) result(zero)
        type(line_type), intent(in) :: line
        !> Where it is at hand
        real(wp), intent(in) :: factor
        real(wp) :: zero

        zero = max(factor, -line%v0/line%v1)
    end function zero_of

    !> Put a support into the queue with the first factor at which it counts as zero
    pure subroutine queue_support(beam, closed, k, factor, stretch)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        real(wp), intent(in) :: factor
        type(stretch_type), intent(inout) :: stretch
        type(line_type) :: line
        real(wp) :: zero

        line = line_of(beam, closed(k), k, stretch)
        if (moves(line)) then
            zero = zero_of(line, factor)
            call set_key(stretch%queue, k, zero - width_of(line, zero)/abs(line%v1))
        else
            call set_key(stretch%queue, k, huge(zero))
        end if
    end subroutine queue_support

    !> The next event, and the supports at zero there
    subroutine find_next(beam, closed, factor, stretch, at_zero, next)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        real(wp), intent(in) :: factor
        type(stretch_type), intent(in) :: stretch
        !> Supports that stay at zero in, all that are there at the next event out
        integer, allocatable, intent(inout) :: at_zero(:)
        !> Its load factor; huge if there is none
        real(wp), intent(out) :: next
        integer, allocatable :: near(:)
        logical, allocatable :: there(:)
        integer :: j, round

        next = huge(next)
        if (.not. first_key(stretch%queue) < huge(next)) return
        ! The first to come near zero need not be the first that is there
        near = all_up_to(stretch%queue, first_key(stretch%queue))
        do round = 1, 2
            do j = 1, size(near)
                next = min(next, zero_of(line_of(beam, closed(near(j)), near(j), stretch), factor))
            end do
            near = all_up_to(stretch%queue, next)
        end do
        allocate (there(size(near)))
        do j = 1, size(near)
            associate (line => line_of(beam, closed(near(j)), near(j), stretch))
                there(j) = abs(line%v0 + next*line%v1) <= width_of(line, next)
            end associate
        end do
        at_zero = [at_zero, pack(near, there)]
    end subroutine find_next

    !> Note a change
    pure subroutine add_change(path, factor, k)
        type(path_type), intent(inout) :: path
        real(wp), intent(in) :: factor
        integer, intent(in) :: k

        if (path%count == size(path%factor)) then
            path%factor = [path%factor, path%factor]
            path%support = [path%support, path%support]
        end if
        path%count = path%count + 1
        path%factor(path%count) = factor
        path%support(path%count) = k
    end subroutine add_change

    !> The rate problem as a contact problem: what the live loads alone do from here
    subroutine solve_rates(rule, at_zero, closed, stretch, path, outcome, error)
        integer, intent(in) :: rule
        integer, intent(in) :: at_zero(:)
        logical, intent(inout) :: closed(:)
        type(stretch_type), intent(in) :: stretch
        type(path_type), intent(inout) :: path
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: rates
        type(workspace_type) :: work
        logical, allocatable :: free(:)
        integer :: k

        rates = stretch%incremental
        allocate (free(size(closed)))
        free(:) = .false.
        free(at_zero) = .true.
        do k = 1, size(closed)
            associate (s => rates%supports(k))
                if (free(k) .or. s%side == both) cycle
                if (closed(k)) then
                    s%side = both
                else
                    s%stiffness = 0.0_wp
                end if
            end associate
        end do
        call new_workspace(rates, work)
        call set_loads(rates, 1.0_wp, work)
        call find_scheme(rates, 1.0_wp, rule, closed, work, outcome, error)
        path%solves = path%solves + work%solves
    end subroutine solve_rates

end module gapbeam_path
