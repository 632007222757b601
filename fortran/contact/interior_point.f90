!> First guess of the contact state by a primal-dual interior-point method (Mehrotra 1992).
!>
!> With reaction R >= 0 and opening s >= 0 of every one-sided support, s = side (contact - w) + R/stiffness, the method
!> follows R s = mu to mu = 0. Each of its linear systems is the beam with every one-sided support, closed or open, as a
!> spring of stiffness R/(s + R/stiffness): never a mechanism as long as all supports together hold the beam, and
!> solved by the same sweep. The number of steps hardly grows with the number of supports, so boundaries that move
!> over thousands of them cost no more than others. Which of R and s goes to zero shows long before mu is small (the
!> indicators of El-Bakry, Tapia and Zhang 1994); the scheme so guessed is then settled by pivoting.
module gapbeam_interior_point
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: boundary_share, first_spring, first_reaction_share
    use gapbeam_band, only: band_ok
    use gapbeam_law_adapters, only: find_pairs
    use gapbeam_model, only: beam_type, softest
    use gapbeam_workspace, only: workspace_type
    use gapbeam_system, only: solve_deflections
    implicit none
    private
    public :: interior_type, start_interior, step_interior, product_of

    !> The iterate; components only of one-sided supports with a stiffness
    type :: interior_type
        !> Supports taking part, by number
        integer, allocatable :: support(:)
        !> Reactions and openings, both positive; deflections
        real(wp), allocatable :: reaction(:), opening(:), deflection(:)
        !> 1 or -1, contact levels, 1/stiffness
        real(wp), allocatable :: side(:), contact(:), compliance(:)
    end type interior_type

contains

    !> Set up the iterate from one solve with equal springs
    subroutine start_interior(beam, closed, work, iterate, state, place)
        type(beam_type), intent(in) :: beam
        !> Any scheme
        logical, intent(in) :: closed(:)
        !> Loads in
        type(workspace_type), intent(inout) :: work
        !> The iterate
        type(interior_type), intent(out) :: iterate
        !> band_ok, or why the beam on springs cannot be solved, and where
        integer, intent(out) :: state, place
        real(wp) :: stiffness, largest

        call find_pairs(beam%supports, iterate%support, iterate%side, iterate%contact, iterate%compliance)
        allocate (work%spring(size(closed)), work%spring_contact(size(closed)), source=0.0_wp)
        associate (i => iterate%support, side => iterate%side, contact => iterate%contact)
            stiffness = first_spring*softest(beam)*size(beam%links)
            work%spring(i) = stiffness
            work%spring_contact(i) = contact
            call solve_springs(beam, closed, work, iterate%support, iterate%deflection, state, place)
            if (state /= band_ok) return
            allocate (iterate%reaction(size(i)), iterate%opening(size(i)))
            iterate%reaction(:) = side*stiffness*(iterate%deflection - contact)
            largest = max(maxval(abs(iterate%reaction)), tiny(largest))
            iterate%reaction(:) = max(iterate%reaction, 0.0_wp) + first_reaction_share*largest
            iterate%opening(:) = max(side*(contact - iterate%deflection) + iterate%reaction*iterate%compliance, 0.0_wp) &
                + first_reaction_share*largest/stiffness
        end associate
    end subroutine start_interior

    !> One predictor and one corrector, two linear solves
    subroutine step_interior(beam, closed, work, iterate, guess, state, place)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(inout) :: work
        type(interior_type), intent(inout) :: iterate
        !> The scheme that shows: closed where the reaction shrinks less than the opening
        logical, intent(out) :: guess(:)
        !> band_ok, or why the system cannot be solved, and where
        integer, intent(out) :: state, place
        real(wp), allocatable :: change_w(:), change_r(:), change_s(:), target(:), gap_error(:)
        real(wp) :: mean, mean_ahead, way

        guess = closed
        allocate (target(size(iterate%support)), gap_error(size(iterate%support)))
        allocate (change_r(size(iterate%support)), change_s(size(iterate%support)))
        associate (r => iterate%reaction, s => iterate%opening, w => iterate%deflection, n => size(iterate%support))
            mean = dot_product(r, s)/n
            gap_error(:) = s - (iterate%side*(iterate%contact - w) + r*iterate%compliance)
            target(:) = 0.0_wp
            call newton(target)
            if (state /= band_ok) return
            way = min(step_to_zero(r, change_r), step_to_zero(s, change_s))
            mean_ahead = dot_product(r + way*change_r, s + way*change_s)/n
            target(:) = (mean_ahead/mean)**3*mean - change_r*change_s
            call newton(target)
            if (state /= band_ok) return
            way = min(1.0_wp, boundary_share*min(step_to_zero(r, change_r), step_to_zero(s, change_s)))
            guess(iterate%support) = (r + way*change_r)*s > (s + way*change_s)*r
            r = r + way*change_r
            s = s + way*change_s
            w = w + way*change_w
        end associate

    contains

        !> Solve s dR + R ds = target - s R with ds = -side dw + dR/stiffness - gap_error
        subroutine newton(target)
            real(wp), intent(in) :: target(:)
            real(wp), allocatable :: spring(:), fixed(:)

            allocate (spring(size(target)), fixed(size(target)))
            associate (r => iterate%reaction, s => iterate%opening, w => iterate%deflection, i => iterate%support, &
                       side => iterate%side)
                spring(:) = r/(s + r*iterate%compliance)
                fixed(:) = (target - s*r + r*gap_error)/(s + r*iterate%compliance)
                work%spring(i) = spring
                work%spring_contact(i) = w - side*(r + fixed)/spring
                call solve_springs(beam, closed, work, iterate%support, change_w, state, place)
                if (state /= band_ok) return
                change_w(:) = change_w - w
                change_r(:) = fixed + spring*side*change_w
                change_s(:) = -side*change_w + change_r*iterate%compliance - gap_error
            end associate
        end subroutine newton

    end subroutine step_interior

    !> Sum of reactions times openings, zero at the solution
    pure function product_of(iterate) result(total)
        type(interior_type), intent(in) :: iterate
        real(wp) :: total

        total = 0.0_wp
        if (allocated(iterate%reaction)) total = dot_product(iterate%reaction, iterate%opening)
    end function product_of

    !> Deflections at the supports of the beam on springs
    subroutine solve_springs(beam, closed, work, support, deflection, state, place)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(inout) :: work
        integer, intent(in) :: support(:)
        real(wp), allocatable, intent(out) :: deflection(:)
        integer, intent(out) :: state, place

        work%sprung = .true.
        call solve_deflections(beam, closed, work, state, place)
        work%sprung = .false.
        allocate (deflection(size(support)), source=work%answers(beam%supports(support)%node)%deflection)
    end subroutine solve_springs

    !> Largest step, 1 at most, that keeps all components from becoming negative
    pure function step_to_zero(x, change) result(way)
        real(wp), intent(in) :: x(:), change(:)
        real(wp) :: way
        integer :: k

        way = 1.0_wp
        do k = 1, size(x)
            if (change(k) < -x(k)) way = min(way, -x(k)/change(k))
        end do
    end function step_to_zero

end module gapbeam_interior_point
