!> The interval of load factors after a given one that has one contact state, in quadruple precision.
!>
!> Its scheme is that of a factor just above. It acts on an interval of factors, between the zeros of its reactions and
!> openings; if that begins further up, other schemes come first, and a nearer factor is tried. Every scheme has but
!> one interval and there are finitely many schemes, so this ends, and a path made of such stretches never comes back to
!> one (Katzenelson 1965; Chien and Kuh 1977; the path of a parametric linear complementarity problem, Cottle 1972).
!> Coincident events and ties need nothing of their own. Where contact is lost and the beam is free to
!> turn, the scheme just above is that with which it comes to rest: the limit from the right.
module gapbeam_linear_region
    use gapbeam_kinds, only: wp => qp
    use gapbeam_path_tolerances, only: first_share_of_way, last_share_of_way, unseen_share, weaker_springs
    use gapbeam_error, only: error_type, gapbeam_solved, fatal_error, gapbeam_not_converged
    use gapbeam_band_quad, only: band_ok
    use gapbeam_model_quad, only: beam_type
    use gapbeam_kinematics_quad, only: work_of_loads
    use gapbeam_workspace_quad, only: workspace_type, new_workspace, set_loads
    use gapbeam_system_quad, only: solve_and_refine
    use gapbeam_search_quad, only: rule_block
    use gapbeam_contact_state_quad, only: find_contact_state, outcome_type
    use gapbeam_affine_response_quad, only: lines_type, new_lines, response_type, response_of, zero_of, falls, rises
    implicit none
    private
    public :: region_type, find_region

    !> A stretch of the path
    type :: region_type
        !> The scheme, shape (size(supports))
        logical, allocatable :: closed(:)
        !> Where it ends; huge if never
        real(wp) :: to = huge(1.0_wp)
        !> Reactions and openings over the factor
        type(response_type), allocatable :: responses(:)
        !> Linear solves
        integer :: solves = 0
    end type region_type

contains

    !> Find the stretch that begins at a factor
    subroutine find_region(beam, factor, limit, start, region, outcome, error)
        type(beam_type), intent(in) :: beam
        !> The factor, and the end of the path
        real(wp), intent(in) :: factor, limit
        !> Where the search for the scheme starts
        logical, intent(in) :: start(:)
        !> The stretch
        type(region_type), intent(out) :: region
        !> No equilibrium above the factor, with the motion
        type(outcome_type), intent(out) :: outcome
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        type(workspace_type) :: work
        real(wp) :: scale_of_factor, trial, from, at_zero, at_one, parts
        logical :: farther

        scale_of_factor = max(abs(factor), limit - factor)
        trial = factor + first_share_of_way*scale_of_factor
        call new_workspace(beam, work)
        allocate (region%closed(size(start)), region%responses(size(start)))
        farther = .false.
        do
            region%closed(:) = start
            call set_loads(beam, trial, work)
            call find_contact_state(beam, trial, rule_block, region%closed, work, outcome, error)
            region%solves = region%solves + work%solves
            if (allocated(error)) return
            if (outcome%status == gapbeam_solved) then
                call find_responses(beam, work, region, error)
                if (allocated(error)) return
                call find_interval(region, trial, from)
            else
                ! Above which the loads do work along the motion
                associate (motion => outcome%motion, range => [0, ubound(outcome%motion, 1)])
                    call work_of_loads(beam, 0.0_wp, motion, range, at_zero, parts)
                    call work_of_loads(beam, 1.0_wp, motion, range, at_one, parts)
                end associate
                from = -huge(from)
                if (at_one > at_zero) from = -at_zero/(at_one - at_zero)
            end if
            if (from > factor + last_share_of_way*scale_of_factor) then
                if (farther) then
                    ! The position is not unique, so supports may be touched here or there, without end
                    if (from > factor + unseen_share*scale_of_factor) call fatal_error(error, gapbeam_not_converged, "above "// &
                        "this load factor the beam can move freely without work of the loads, so there is no single path "// &
                        "of its supports: follow the load by steps")
                    exit
                end if
                ! Nearer, before what happens there
                trial = factor + (min(from, trial) - factor)/2
            else
                ! Farther, if so near to the factor even this precision cannot tell what falls from zero
                farther = outcome%status == gapbeam_solved .and. .not. region%to > trial .and. trial < limit
                if (.not. farther) exit
                trial = min(limit, factor + 16*(trial - factor))
            end if
        end do
    end subroutine find_region

    !> Solve the scheme for dead and for live loads
    subroutine find_responses(beam, work, region, error)
        type(beam_type), intent(in) :: beam
        !> The solution at the factor tried
        type(workspace_type), intent(in) :: work
        type(region_type), intent(inout) :: region
        type(error_type), allocatable, intent(out) :: error
        type(lines_type) :: lines
        real(wp) :: springs
        integer :: state, place, k, n

        call new_lines(beam, lines)
        ! A beam that stays free to move stays where it is
        lines%dead%proximal_weight = weaker_springs*work%proximal_weight
        lines%live%proximal_weight = lines%dead%proximal_weight
        n = size(beam%links)
        lines%dead%reference(:) = work%answers(0:n)%deflection
        call solve_and_refine(beam, region%closed, lines%dead, state, place)
        if (state == band_ok) call solve_and_refine(lines%incremental, region%closed, lines%live, state, place)
        if (state /= band_ok) then
            call fatal_error(error, gapbeam_not_converged, "the beam is held by so little that the path of its supports "// &
                             "could not be followed: follow the load by steps")
            return
        end if
        region%solves = region%solves + 2
        associate (dead => lines%dead, live => lines%live)
            springs = sum(dead%proximal_weight*(abs(dead%reference - dead%answers(0:n)%deflection) &
                                                + abs(live%answers(0:n)%deflection)))
        end associate
        do k = 1, size(region%closed)
            region%responses(k) = response_of(beam, region%closed, k, lines)
            ! What only the weak springs press on carries nothing
            associate (response => region%responses(k))
                if (beam%supports(k)%breakpoint > 0) cycle
                if (region%closed(k) .and. max(abs(response%v0), abs(response%v1)) <= 2*springs) response = response_type()
            end associate
        end do
    end subroutine find_responses

    !> The interval of factors on which no sign is wrong, around the factor tried
    pure subroutine find_interval(region, trial, from)
        type(region_type), intent(inout) :: region
        real(wp), intent(in) :: trial
        !> Where it begins
        real(wp), intent(out) :: from
        integer :: k

        from = -huge(from)
        region%to = huge(from)
        do k = 1, size(region%responses)
            associate (response => region%responses(k))
                if (falls(response)) region%to = min(region%to, max(trial, zero_of(response)))
                if (rises(response)) from = max(from, min(trial, zero_of(response)))
            end associate
        end do
    end subroutine find_interval

end module gapbeam_linear_region
