!> Factor of the mixed system, 2x2-block tridiagonal in (M, w) node by node.
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
!> Where the force of a support falls a stiffness is below zero. Then sums cancel, terms take either sign, and who asks for such a
!> factor judges its growth by how fast residuals correct the solution (gapbeam_update).
!>
!> The limits are exact: rigid support (w known), hinge and free end (M known), clamp (psi known). Where the
!> moment is known and nothing carries the shear so far (an overhang, the suspended part of a Gerber beam)
!> the sweep passes on moment and shear by statics alone and finds the deflection on the way back.
module gapbeam_band
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: pivot_digits
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_nodes, only: plain, hinge, restrained, jointed, hinge_left, hinge_right, joint_left, joint_right, is_hinge, &
        takes_left
    implicit none
    private
    public :: node_type, rhs_type, pivot_type, answer_type, factor_chain, count_unstable_pivots, log_determinant
    public :: band_ok, band_mechanism, band_needs_pivoting, band_stopped
    public :: plain, hinge, restrained, jointed
    ! For gapbeam_band_substitution, and for gapbeam_foundation_chain, which eliminates likewise
    public :: full, w_known, m_known, both_known, statics, end_of_beam

    !> What factor_chain found
    integer, parameter :: band_ok = 0, band_mechanism = 1, band_needs_pivoting = 2, band_stopped = 3

    !> A node as the contact state at hand sees it
    type :: node_type
        !> One of those of gapbeam_nodes
        integer :: kind = plain
        !> Deflection known: a rigid support acts
        logical :: held = .false.
        !> Sum of the stiffnesses of the elastic supports that act, force/length
        real(wp) :: stiffness = 0.0_wp
        !> Compliance of the rotational restraint or of the joint, rad/(force length); 0 is a clamp; used if restrained or jointed
        real(wp) :: compliance = 0.0_wp
        !> Compliance of the joint where a restraint is beside it
        real(wp) :: joint = 0.0_wp
    end type node_type

    !> Right-hand side at a node
    type :: rhs_type
        !> Compatibility, contributions from the left and from the right link
        real(wp) :: left = 0.0_wp, right = 0.0_wp
        !> Equilibrium
        real(wp) :: shear = 0.0_wp
        !> Known deflection where held
        real(wp) :: deflection = 0.0_wp
        !> Applied couple, clockwise, by which the moment grows across the node: on the side of a restraint, right of a joint
        real(wp) :: couple = 0.0_wp
        !> Of a hinge the moment that is known: left of it, but right of it where a restraint is on its left
        real(wp) :: moment = 0.0_wp
    end type rhs_type

    !> Solution at a node: deflection and the moments on its two sides
    type :: answer_type
        real(wp) :: deflection = 0.0_wp, moment_left = 0.0_wp, moment_right = 0.0_wp
    end type answer_type

    !> How a node was eliminated
    integer, parameter :: full = 1, w_known = 2, m_known = 3, both_known = 4, statics = 5, end_of_beam = 6

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

    !> Factor the system of a contact state, or factor anew what changes when some of its nodes have changed
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
        logical :: floating, falls
        integer :: i, n, begin, finish

        n = size(links)
        if (checked) call require(n > 0 .and. size(nodes) == n + 1 .and. size(pivots) == n + 1, "factor_chain: shapes")
        falls = .false.
        if (checked) falls = any(nodes%stiffness < 0.0_wp)
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
            if (checked) call require(falls .or. .not. (phi < 0.0_wp .or. beta < 0.0_wp .or. delta < 0.0_wp), &
                                      "factor_chain: a negative term")
            associate (node => nodes(i), p => pivots(i))
                include 'elimination/factor_node.inc'
                p%c = delta + node%stiffness
                if (i == n) exit
                associate (link => links(i + 1))
                    h = link%inverse
                    p%b = beta + h
                    p%a = phi + link%faa
                    if (floating .or. node%kind == hinge .or. node%kind == hinge_left) then
                        if (node%held) then
                            p%kind = both_known
                            phi = link%fbb
                        else if (abs(p%c) > 0.0_wp) then
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

        same = (floating .eqv. pivot%floating) .and. abs(phi - pivot%phi) <= pivot_digits*abs(phi) &
            .and. abs(beta - pivot%beta) <= pivot_digits*abs(beta) .and. abs(delta - pivot%delta) <= pivot_digits*abs(delta)
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
            if (.not. node%held .and. .not. abs(pivot%c) > 0.0_wp) state = band_mechanism
        else if (floating .or. .not. (node%held .or. abs(pivot%c) > 0.0_wp)) then
            state = band_mechanism
        end if
        if (.not. node%held .and. state == band_ok) pivot%reciprocal = 1/pivot%c
    end subroutine factor_last

    !> In how many independent ways the beam gives way by itself, as the pivots of its factor tell: the negative ones but one for
    !> every moment (count_unstable of gapbeam_pivoting)
    pure function count_unstable_pivots(nodes, pivots) result(index)
        !> As for factor_chain, factored, shape (0:n)
        type(node_type), intent(in) :: nodes(0:)
        type(pivot_type), intent(in) :: pivots(0:)
        integer :: index, i

        index = 0
        do i = 0, ubound(nodes, 1)
            associate (node => nodes(i), p => pivots(i))
                if (takes_left(node%kind) .and. .not. p%floating) then
                    index = index - merge(1, 0, p%phi + node%compliance + merge(node%joint, 0.0_wp, node%kind == joint_right) &
                                          < 0.0_wp)
                end if
                select case (p%kind)
                case (full)
                    if (p%reciprocal < 0.0_wp) index = index + merge(1, -1, p%a > 0.0_wp)
                case (w_known)
                    if (p%a < 0.0_wp) index = index - 1
                case (m_known)
                    if (p%c < 0.0_wp) index = index + 1
                case (end_of_beam)
                    if (p%c < 0.0_wp .and. .not. node%held) index = index + 1
                case default
                end select
            end associate
        end do
    end function count_unstable_pivots

    !> Logarithm to base 2 of the determinant of the mixed system but for its sign and constant factors, from the same pivots
    pure function log_determinant(nodes, pivots) result(size)
        !> As for factor_chain, factored, shape (0:n)
        type(node_type), intent(in) :: nodes(0:)
        type(pivot_type), intent(in) :: pivots(0:)
        real(wp) :: size
        integer :: i

        size = 0.0_wp
        do i = 0, ubound(nodes, 1)
            associate (node => nodes(i), p => pivots(i))
                if (takes_left(node%kind) .and. .not. p%floating) then
                    size = size + log_of(p%phi + node%compliance + merge(node%joint, 0.0_wp, node%kind == joint_right))
                end if
                select case (p%kind)
                case (full)
                    size = size - log_of(p%reciprocal)
                case (w_known)
                    size = size + log_of(p%a)
                case (m_known)
                    size = size + log_of(p%c)
                case (end_of_beam)
                    if (.not. node%held) size = size + log_of(p%c)
                case default
                end select
            end associate
        end do

    contains

        !> Of the size of a number, whatever its range
        elemental function log_of(number) result(logarithm)
            real(wp), intent(in) :: number
            real(wp) :: logarithm

            logarithm = exponent(number) + log(max(abs(fraction(number)), tiny(number)))/log(2.0_wp)
        end function log_of

    end function log_determinant

end module gapbeam_band
