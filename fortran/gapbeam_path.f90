!> The path of the solution over the load factor, from one change of the working scheme to the next.
!>
!> While a scheme acts, all values are linear in the load factor: v = v0 + factor v1, with v0 from the dead loads and
!> the contact levels, v1 from the live loads alone. The next event is the smallest factor ahead at which the
!> reaction of a closed support or the opening of an open one becomes zero; it follows from v0 and v1 directly,
!> so nothing accumulates along the path. What happens there is decided by the rate problem: supports at zero are
!> one-sided without gap, other closed ones hold, other open ones are absent, and the live loads act alone. It is a
!> contact problem of its own, so any number of simultaneous changes is settled at once (parametric
!> linear complementarity, Cottle 1972). Every scheme is right on one interval of factors only, so there are
!> finitely many events.
module gapbeam_path
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged, gapbeam_solved
    use gapbeam_band, only: band_ok
    use gapbeam_model, only: beam_type, both
    use gapbeam_system, only: workspace_type, new_workspace, set_loads, solve_scheme, refine_scheme
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_search, only: first_width
    implicit none
    private
    public :: next_event, find_marginal

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

    !> The scheme just above a load factor, and the factor at which it changes next
    subroutine next_event(beam, factor, rule, closed, marginal, next, solves, outcome, error)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> Load factor of the state at hand
        real(wp), intent(in) :: factor
        !> How the rate problem is solved
        integer, intent(in) :: rule
        !> Scheme at that factor in, just above it out
        logical, intent(inout) :: closed(:)
        !> Supports at zero at that factor in, at the next event out
        logical, intent(inout) :: marginal(:)
        !> Factor of the next event; huge if there is none
        real(wp), intent(out) :: next
        !> Linear solves
        integer, intent(out) :: solves
        !> No equilibrium above the factor at hand: the beam begins to move
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: rates, dead
        real(wp), allocatable :: v0(:), v1(:), error_of_v0(:), error_of_v1(:)
        integer :: state, place, k

        next = huge(next)
        call solve_rates(beam, rule, closed, marginal, rates, outcome, error)
        solves = rates%solves
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        call new_workspace(beam, dead)
        call set_loads(beam, 0.0_wp, dead)
        call solve_scheme(beam, closed, dead, state, place)
        solves = solves + dead%solves
        if (state /= band_ok) then
            call fatal_error(error, gapbeam_not_converged, "above this load factor the beam can move freely without work of "// &
                             "the loads, so there is no single path of its supports: follow the load by steps")
            return
        end if
        call refine_scheme(beam, closed, dead)
        allocate (v0(size(closed)), v1(size(closed)), error_of_v0(size(closed)), error_of_v1(size(closed)))
        do k = 1, size(closed)
            associate (s => beam%supports(k))
                if (closed(k)) then
                    v0(k) = s%side*dead%reaction(k)
                    v1(k) = s%side*rates%reaction(k)
                    error_of_v0(k) = first_width*dead%reaction_error(k)
                    error_of_v1(k) = first_width*rates%reaction_error(k)
                else
                    v0(k) = s%side*(s%contact - dead%answers(s%node)%deflection)
                    v1(k) = -s%side*rates%answers(s%node)%deflection
                    error_of_v0(k) = first_width*epsilon(1.0_wp)*max(dead%deflection_size(s%node), abs(s%contact))
                    error_of_v1(k) = first_width*epsilon(1.0_wp)*rates%deflection_size(s%node)
                end if
                ! What is at zero and does not grow stays there; what grows has left
                if (s%side == both .or. .not. s%stiffness > 0.0_wp) cycle
                if (marginal(k) .or. .not. v1(k) < -error_of_v1(k)) cycle
                next = min(next, max(factor, -v0(k)/v1(k)))
            end associate
        end do
        marginal = .false.
        if (.not. next < huge(next)) return
        do k = 1, size(closed)
            if (beam%supports(k)%side == both .or. .not. beam%supports(k)%stiffness > 0.0_wp) cycle
            marginal(k) = abs(v0(k) + next*v1(k)) <= max(error_of_v0(k) + next*error_of_v1(k), &
                                                         4*epsilon(1.0_wp)*max(abs(v0(k)), next*abs(v1(k))))
        end do
    end subroutine next_event

    !> The rate problem: what the live loads alone do from here
    subroutine solve_rates(beam, rule, closed, marginal, work, outcome, error)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: rule
        logical, intent(inout) :: closed(:)
        logical, intent(in) :: marginal(:)
        type(workspace_type), intent(out) :: work
        type(outcome_type), intent(out) :: outcome
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: incremental
        integer :: k, i

        incremental = beam
        do k = 1, size(closed)
            associate (s => incremental%supports(k))
                s%contact = 0.0_wp
                if (marginal(k) .or. s%side == both) cycle
                if (closed(k)) then
                    s%side = both
                else
                    s%stiffness = 0.0_wp
                end if
            end associate
        end do
        ! The live loads alone
        incremental%force(1, :) = 0.0_wp
        incremental%couple(1, :) = 0.0_wp
        do i = 1, size(incremental%links)
            associate (link => incremental%links(i))
                link%turn_a(1) = 0.0_wp
                link%turn_b(1) = 0.0_wp
                link%shear_a(1) = 0.0_wp
                link%shear_b(1) = 0.0_wp
            end associate
        end do
        call new_workspace(incremental, work)
        call set_loads(incremental, 1.0_wp, work)
        call find_scheme(incremental, 1.0_wp, rule, closed, work, outcome, error)
    end subroutine solve_rates

end module gapbeam_path
