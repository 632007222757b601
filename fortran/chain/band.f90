!> The mixed system, 2x2-block tridiagonal in (M, w) node by node: factor and solve.
!>
!> Rows of node i (docs/method.md 2), V the shear, psi the rotation of the section:
!>
!>     compatibility   psi_left - psi_right = 0        column M_i, diagonal -(f_bb + f_aa) <= 0
!>     equilibrium     V_left - V_right + R = P        column w_i, diagonal c_i >= 0
!>
!> Eliminating from the left, all nodes before node i act on it through three numbers only,
!>
!>     psi = -phi M + beta w - e        V = beta M + delta w - p        phi, beta, delta >= 0,
!>
!> the Schur complement of the block elimination. Written out, every step of its recursion is a sum of
!> products of nonnegative numbers: nothing cancels, there is no growth, and a pivot is zero only where
!> the structure is a mechanism (the same idea as Grassmann, Taksar and Heyman 1985 for Markov chains). So no
!> pivoting is needed, and a mechanism is found by exact zeros, not by large numbers. The one pivot that
!> can vanish in a sound structure is a rigid beam (f = 0) on rigid supports; that goes to gapbeam_pivoting.
!>
!> The limits are exact: rigid support (w known), hinge and free end (M known), clamp (psi known). Where the
!> moment is known and nothing carries the shear so far (an overhang, the suspended part of a Gerber beam)
!> the sweep passes on moment and shear by statics alone and finds the deflection on the way back.
module gapbeam_band
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_nodes, only: plain, hinge, restrained
    implicit none
    private
    public :: node_type, rhs_type, pivot_type, answer_type, factor_chain, solve_chain, correct_chain
    public :: band_ok, band_mechanism, band_needs_pivoting, band_stopped
    public :: plain, hinge, restrained
    ! For gapbeam_foundation_chain, which eliminates likewise
    public :: full, w_known, m_known, both_known, statics, end_of_beam

    !> What factor_chain found
    integer, parameter :: band_ok = 0, band_mechanism = 1, band_needs_pivoting = 2, band_stopped = 3

    !> A node as the working scheme at hand sees it
    type :: node_type
        !> plain, hinge or restrained
        integer :: kind = plain
        !> Deflection known: a rigid support acts
        logical :: held = .false.
        !> Sum of the stiffnesses of the elastic supports that act, force/length
        real(wp) :: stiffness = 0.0_wp
        !> Compliance of the rotational restraint, rad/(force length); 0 is a clamp; used if restrained
        real(wp) :: compliance = 0.0_wp
    end type node_type

    !> Right-hand side at a node
    type :: rhs_type
        !> Compatibility, contributions from the left and from the right link
        real(wp) :: left = 0.0_wp, right = 0.0_wp
        !> Equilibrium
        real(wp) :: shear = 0.0_wp
        !> Known deflection where held
        real(wp) :: deflection = 0.0_wp
        !> Applied couple, clockwise
        real(wp) :: couple = 0.0_wp
    end type rhs_type

    !> Solution at a node: deflection and the moments on its two sides
    type :: answer_type
        real(wp) :: deflection = 0.0_wp
        real(wp) :: moment_left = 0.0_wp, moment_right = 0.0_wp
    end type answer_type

    !> How a node was eliminated
    integer, parameter :: full = 1, w_known = 2, m_known = 3, both_known = 4, statics = 5, end_of_beam = 6
    !> Relative to the solution, what cannot be seen in it even if it comes back a thousand times
    real(wp), parameter :: unseen = 2.0_wp**(-10)*epsilon(1.0_wp)

    !> The factor at a node
    type :: pivot_type
        !> One of the kinds above
        integer :: kind
        !> Is the moment left of the node known by statics
        logical :: floating
        !> What the left side passes on: flexibility, ratio, stiffness
        real(wp) :: phi, beta, delta
        !> Pivot [-a b; b c] and the reciprocal of what is divided by
        real(wp) :: a, b, c, reciprocal
    end type pivot_type

contains

    !> Factor the system of a working scheme, or factor anew what changes when some of its nodes have changed
    pure subroutine factor_chain(nodes, links, pivots, state, place, changed)
        !> Nodes, shape (0:n), and the links between them, shape (n)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        !> The factor, shape (0:n); a factor of the system before the change, if nodes have changed
        type(pivot_type), intent(inout) :: pivots(0:)
        !> band_ok, band_mechanism or band_needs_pivoting
        integer, intent(out) :: state
        !> Node at which a state other than band_ok was found
        integer, intent(out) :: place
        !> First and last node that changed; the factor is right left of them already, and right of them from where
        !> the left side passes on what it did before
        integer, intent(in), optional :: changed(2)
        real(wp) :: phi, beta, delta, h, divisor
        logical :: floating
        integer :: i, n, begin, finish

        n = size(links)
        if (checked) call require(n > 0 .and. size(nodes) == n + 1 .and. size(pivots) == n + 1, "factor_chain: shapes")
        state = band_ok
        phi = 0.0_wp
        beta = 0.0_wp
        delta = 0.0_wp
        floating = .true.
        begin = 0
        finish = n
        if (present(changed)) then
            if (checked) call require(0 <= changed(1) .and. changed(1) <= changed(2) .and. changed(2) <= n, "factor_chain: changed")
            begin = changed(1)
            finish = changed(2)
            phi = pivots(begin)%phi
            beta = pivots(begin)%beta
            delta = pivots(begin)%delta
            floating = pivots(begin)%floating
        end if
        do i = begin, n
            place = i
            if (i > finish) then
                if (repeats(pivots(i), phi, beta, delta, floating)) return
            end if
            ! Sums of terms that are not negative
            if (checked) call require(.not. (phi < 0.0_wp .or. beta < 0.0_wp .or. delta < 0.0_wp), "factor_chain: a negative term")
            associate (node => nodes(i), p => pivots(i))
                p%floating = floating
                p%phi = phi
                p%beta = beta
                p%delta = delta
                p%reciprocal = 0.0_wp
                ! The moment across the node
                if (node%kind == restrained) then
                    if (floating) then
                        phi = node%compliance
                        floating = .false.
                    else
                        divisor = phi + node%compliance
                        if (.not. divisor > 0.0_wp) then
                            state = band_needs_pivoting
                            return
                        end if
                        delta = delta + beta**2/divisor
                        phi = node%compliance*phi/divisor
                        beta = node%compliance*beta/divisor
                    end if
                else if (node%kind == hinge .and. floating) then
                    state = band_mechanism
                    return
                end if
                p%c = delta + node%stiffness
                if (i == n) exit
                associate (link => links(i + 1))
                    h = link%inverse
                    p%b = beta + h
                    p%a = phi + link%faa
                    if (floating .or. node%kind == hinge) then
                        if (node%held) then
                            p%kind = both_known
                            phi = link%fbb
                        else if (p%c > 0.0_wp) then
                            p%kind = m_known
                            p%reciprocal = 1/p%c
                            phi = link%fbb + h**2*p%reciprocal
                        else
                            p%kind = statics
                        end if
                        floating = p%kind == statics
                        beta = merge(0.0_wp, h, floating)
                        delta = 0.0_wp
                        if (floating) phi = 0.0_wp
                    else if (node%held) then
                        p%kind = w_known
                        if (.not. p%a > 0.0_wp) then
                            state = band_needs_pivoting
                            return
                        end if
                        p%reciprocal = 1/p%a
                        delta = h**2*p%reciprocal
                        beta = h*(phi + link%sum_a)*p%reciprocal
                        phi = (link%fbb*phi + link%determinant)*p%reciprocal
                    else
                        p%kind = full
                        p%reciprocal = 1/(p%a*p%c + p%b**2)
                        delta = p%c*h**2*p%reciprocal
                        divisor = h*(p%c*(phi + link%sum_a) + p%b*beta)*p%reciprocal
                        phi = ((phi + link%bending)*h**2 + beta*(2*h*link%sum_b + beta*link%fbb) &
                            + p%c*(phi*link%fbb + link%determinant))*p%reciprocal
                        beta = divisor
                    end if
                end associate
            end associate
        end do
        call factor_last(nodes(n), pivots(n), phi, beta, delta, floating, state)
    end subroutine factor_chain

    !> Does the left side pass on to a node what it did before, but for the last digits
    pure function repeats(pivot, phi, beta, delta, floating) result(same)
        type(pivot_type), intent(in) :: pivot
        real(wp), intent(in) :: phi, beta, delta
        logical, intent(in) :: floating
        logical :: same
        real(wp), parameter :: digits = 4*epsilon(1.0_wp)

        same = (floating .eqv. pivot%floating) .and. abs(phi - pivot%phi) <= digits*phi &
            .and. abs(beta - pivot%beta) <= digits*beta .and. abs(delta - pivot%delta) <= digits*delta
    end function repeats

    !> The right end of the beam: no link follows
    pure subroutine factor_last(node, pivot, phi, beta, delta, floating, state)
        type(node_type), intent(in) :: node
        type(pivot_type), intent(inout) :: pivot
        real(wp), intent(in) :: phi, beta, delta
        logical, intent(in) :: floating
        integer, intent(inout) :: state

        pivot%kind = end_of_beam
        pivot%a = phi
        pivot%b = beta
        pivot%c = delta + node%stiffness
        if (node%kind == restrained) then
            ! phi, beta, delta already hold the restraint: the moment right of the node is zero
            if (.not. node%held .and. .not. pivot%c > 0.0_wp) state = band_mechanism
        else if (floating .or. .not. (node%held .or. pivot%c > 0.0_wp)) then
            state = band_mechanism
        end if
        if (.not. node%held .and. state == band_ok) pivot%reciprocal = 1/pivot%c
    end subroutine factor_last

    !> Solve with a factor
    pure subroutine solve_chain(nodes, links, pivots, rhs, answers)
        !> The nodes, links and factor of factor_chain (state band_ok)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(pivot_type), intent(in) :: pivots(0:)
        !> Right-hand side, shape (0:n); overwritten by the eliminated one
        type(rhs_type), intent(inout) :: rhs(0:)
        !> The solution, shape (0:n)
        type(answer_type), intent(out) :: answers(0:)

        integer :: last, first

        if (checked) call require(size(nodes) == size(links) + 1 .and. size(pivots) == size(nodes) .and. &
                                  size(rhs) == size(nodes) .and. size(answers) == size(nodes), "solve_chain: shapes")
        call eliminate(nodes, links, pivots, rhs, [0, size(links)], answers, last)
        call substitute(nodes, links, pivots, rhs, [0, size(links)], answers, first)
    end subroutine solve_chain

    !> The correction of a solution for a right-hand side that is zero but at some nodes, as far as it can be seen in the solution
    pure subroutine correct_chain(nodes, links, pivots, rhs, changed, solution, correction, window)
        !> As for solve_chain
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(pivot_type), intent(in) :: pivots(0:)
        !> Right-hand side at the nodes changed(1) to changed(2); overwritten, beyond them as well
        type(rhs_type), intent(inout) :: rhs(0:)
        integer, intent(in) :: changed(2)
        !> The solution to be corrected
        type(answer_type), intent(in) :: solution(0:)
        !> The correction at the nodes window(1) to window(2); elsewhere it is smaller than rounding errors
        type(answer_type), intent(inout) :: correction(0:)
        integer, intent(out) :: window(2)

        if (checked) call require(0 <= changed(1) .and. changed(1) <= changed(2) .and. changed(2) <= size(links), &
                                  "correct_chain: changed")
        call eliminate(nodes, links, pivots, rhs, changed, correction, window(2), solution)
        call substitute(nodes, links, pivots, rhs, [changed(1), window(2)], correction, window(1), solution)
    end subroutine correct_chain

    !> Forward: rhs(i)%left becomes the e that the left side passes to node i, rhs(i)%right and %shear the
    !> right-hand sides E and G of its pivot; moments known by statics go into the answers at once
    pure subroutine eliminate(nodes, links, pivots, rhs, range, answers, last, solution)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(pivot_type), intent(in) :: pivots(0:)
        type(rhs_type), intent(inout) :: rhs(0:)
        !> Nodes outside of which the right-hand side is zero
        integer, intent(in) :: range(2)
        type(answer_type), intent(inout) :: answers(0:)
        !> The last node with an effect
        integer, intent(out) :: last
        !> What makes effects negligible beyond them, needed if there is something beyond them
        type(answer_type), intent(in), optional :: solution(0:)
        real(wp) :: e, p, m, h, divisor, m_star, w_star
        integer :: i, n

        n = size(links)
        m = 0.0_wp
        e = 0.0_wp
        p = 0.0_wp
        last = n
        do i = range(1), n
            if (i > range(2)) then
                if (fades(pivots(i), solution(i), e, p, m)) then
                    last = i - 1
                    return
                end if
                rhs(i) = rhs_type()
            end if
            associate (node => nodes(i), v => pivots(i), r => rhs(i))
                ! Across the node; keep what came from the left for the moment left of the node
                if (v%floating) then
                    answers(i)%moment_left = m
                    m = m + r%couple
                    if (node%kind == restrained) r%right = r%right - node%compliance*m
                else
                    e = e + r%left
                    r%left = e
                    select case (node%kind)
                    case (restrained)
                        divisor = 1/(v%phi + node%compliance)
                        p = p + v%beta*(e + node%compliance*r%couple)*divisor
                        e = node%compliance*(e - v%phi*r%couple)*divisor
                    case (hinge)
                        m = 0.0_wp
                    case default
                        e = e - v%phi*r%couple
                        p = p + v%beta*r%couple
                    end select
                    r%right = r%right + e
                end if
                r%shear = r%shear + p
                if (i == n) exit
                h = links(i + 1)%inverse
                associate (link => links(i + 1), g => r%shear)
                    select case (v%kind)
                    case (full)
                        m_star = (v%b*g - v%c*r%right)*v%reciprocal
                        w_star = (v%b*r%right + v%a*g)*v%reciprocal
                        e = h*w_star + link%fab*m_star
                        p = h*m_star
                    case (w_known)
                        m_star = (v%b*r%deflection - r%right)*v%reciprocal
                        e = h*r%deflection + link%fab*m_star
                        p = h*m_star
                    case (m_known)
                        answers(i)%moment_right = m
                        e = link%fab*m + h*(g - h*m)*v%reciprocal
                        p = h*m
                    case (both_known)
                        answers(i)%moment_right = m
                        e = link%fab*m + h*r%deflection
                        p = h*m
                    case default
                        answers(i)%moment_right = m
                        m = m - g*link%length
                        p = g
                    end select
                end associate
            end associate
        end do
    end subroutine eliminate

    !> Is what the left side of a node passes on too small to be seen in the solution there
    pure function fades(pivot, solution, e, p, m) result(small)
        type(pivot_type), intent(in) :: pivot
        type(answer_type), intent(in) :: solution
        real(wp), intent(in) :: e, p, m
        logical :: small

        associate (moment => abs(solution%moment_left), w => abs(solution%deflection))
            if (pivot%floating) then
                small = .not. (abs(m) > 0.0_wp .or. abs(p) > 0.0_wp)
            else
                small = abs(e) <= unseen*(pivot%phi*moment + pivot%beta*w) &
                    .and. abs(p) <= unseen*(pivot%beta*moment + pivot%delta*w)
            end if
        end associate
    end function fades

    !> Backward
    pure subroutine substitute(nodes, links, pivots, rhs, range, answers, first, solution)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(pivot_type), intent(in) :: pivots(0:)
        type(rhs_type), intent(inout) :: rhs(0:)
        !> Nodes outside of which the eliminated right-hand side is zero
        integer, intent(in) :: range(2)
        type(answer_type), intent(inout) :: answers(0:)
        !> The first node with an effect
        integer, intent(out) :: first
        !> What makes effects negligible left of them, needed if there is something left of them
        type(answer_type), intent(in), optional :: solution(0:)
        real(wp) :: m_next, w_next, m, w, h, psi_right
        integer :: i, small

        m_next = 0.0_wp
        w_next = 0.0_wp
        psi_right = 0.0_wp
        small = 0
        first = 0
        do i = range(2), 0, -1
            if (i < range(1)) then
                ! Two nodes in a row, so that a deflection that passes through zero does not deceive
                associate (a => answers(i + 1), s => solution(i + 1))
                    small = merge(small + 1, 0, .not. pivots(i)%floating .and. &
                                  abs(a%deflection) <= unseen*abs(s%deflection) .and. &
                                  abs(a%moment_left) <= unseen*abs(s%moment_left))
                end associate
                if (small == 2) then
                    first = i + 1
                    return
                end if
                rhs(i) = rhs_type()
                answers(i) = answer_type()
            end if
            associate (node => nodes(i), v => pivots(i), r => rhs(i))
                if (v%kind == end_of_beam) then
                    m = 0.0_wp
                    if (node%held) then
                        w = r%deflection
                    else
                        w = r%shear*v%reciprocal
                    end if
                else
                    associate (link => links(i + 1))
                        h = link%inverse
                        select case (v%kind)
                        case (full)
                            m = (v%b*r%shear - v%c*r%right + (v%b*h - v%c*link%fab)*m_next - v%c*h*w_next) &
                                *v%reciprocal
                            w = (v%b*r%right + v%a*r%shear + (v%b*link%fab + v%a*h)*m_next + v%b*h*w_next) &
                                *v%reciprocal
                        case (w_known)
                            w = r%deflection
                            m = (v%b*w - r%right - link%fab*m_next - h*w_next)*v%reciprocal
                        case (m_known)
                            m = answers(i)%moment_right
                            w = (r%shear + h*(m_next - m))*v%reciprocal
                        case (both_known)
                            m = answers(i)%moment_right
                            w = r%deflection
                        case default
                            m = answers(i)%moment_right
                            w = w_next - link%length*(link%fab*m + link%fbb*m_next + psi_right)
                        end select
                        psi_right = h*(w_next - w) + link%faa*m + link%fab*m_next
                    end associate
                end if
                ! Moment left of the node
                if (.not. v%floating) then
                    select case (node%kind)
                    case (restrained)
                        answers(i)%moment_left = (v%beta*w - r%left + node%compliance*(m - r%couple)) &
                            /(v%phi + node%compliance)
                    case (hinge)
                        answers(i)%moment_left = 0.0_wp
                    case default
                        answers(i)%moment_left = m - r%couple
                    end select
                else if (node%kind == restrained) then
                    psi_right = node%compliance*((answers(i)%moment_left - m) + r%couple) + r%left
                else
                    psi_right = psi_right + r%right + r%left
                end if
                answers(i)%deflection = w
                answers(i)%moment_right = m
                m_next = answers(i)%moment_left
                w_next = w
            end associate
        end do
    end subroutine substitute

end module gapbeam_band
