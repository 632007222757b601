!> Factor and solution of the mixed system of a beam whose links may lie on elastic ground.
!>
!> A link on ground has two rotations and two shears of its own (gapbeam_foundation); all nodes before a node still act on it
!> through the three numbers phi, beta, delta of gapbeam_band. With the determinants and sums that a link brings along,
!> every step of the recursion is a sum of terms that are not negative as long as beta L < 2.365; beyond that the only terms that
!> change sign are below 1/40 of the others, and tension adds terms that are not negative. Under compression the sums are of mixed
!> sign. Links are so short there that none buckles by itself, and the pivots tell whether the beam does (Sylvester; Wittrick and
!> Williams 1971).
!>
!> Under compression a pivot may be zero by chance, where the beam up to there would buckle by itself: then a little less stiffness
!> at the node makes up for it, which refinement takes out again. Less, so that no beam that is about to buckle is held by it.
!>
!> A pivot is zero where a rigid link goes on from a node whose deflection and rotation are known, as at a clamp. Then so is the
!> deflection at its other end, and the moment follows from equilibrium there on the way back.
module gapbeam_foundation_chain
    use gapbeam_kinds, only: wp, dp
    use gapbeam_require, only: checked, require
    use gapbeam_nodes, only: hinge_left, hinge_right, joint_left, joint_right, is_hinge, takes_left
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, plain, hinge, restrained, jointed, band_ok, &
        band_mechanism, band_needs_pivoting, full, w_known, m_known, both_known, statics, end_of_beam, count_unstable_pivots
    use gapbeam_foundation, only: stretch_link_type
    implicit none
    private
    public :: factor_foundation_chain, solve_foundation_chain, of_numbers_as_given, of_working_precision

    !> One more way to eliminate a node: the rigid link behind it tells the deflection at the next one
    integer, parameter :: w_ahead = 7
    !> Below which share of what cancels in it a pivot is rounding: of the working precision, and of numbers as they were given
    real(wp), parameter :: of_working_precision = 8*epsilon(1.0_wp), &
                           of_numbers_as_given = max(4*real(epsilon(1.0_dp), wp), of_working_precision)
    !> Share of the stiffness there that is taken out then: rounding of the working precision is lost by its square, which
    !> refinement brings back
    real(wp), parameter :: little = epsilon(1.0_wp)**(1.0_wp/3)

contains

    !> Factor the system of a contact state
    pure subroutine factor_foundation_chain(nodes, links, rounding, pivots, state, place, unstable)
        !> Nodes, shape (0:n), and the links between them, shape (n)
        type(node_type), intent(in) :: nodes(0:)
        type(stretch_link_type), intent(in) :: links(:)
        !> Below which share of what cancels in it a pivot is rounding
        real(wp), intent(in) :: rounding
        !> The factor, shape (0:n)
        type(pivot_type), intent(inout) :: pivots(0:)
        !> band_ok; band_mechanism, also where compression makes it unstable; or band_needs_pivoting: a rigid stretch over too many
        !> rigid supports
        integer, intent(out) :: state
        !> Node at which a state other than band_ok was found
        integer, intent(out) :: place
        !> May the beam give way by itself, as on supports whose forces fall; default no
        logical, intent(in), optional :: unstable
        real(wp) :: phi, beta, delta, divisor, next(3)
        logical :: floating, held
        integer :: i, n

        n = size(links)
        if (checked) call require(n > 0 .and. size(nodes) == n + 1 .and. size(pivots) == n + 1, "factor_foundation_chain: shapes")
        state = band_ok
        phi = 0.0_wp
        beta = 0.0_wp
        delta = 0.0_wp
        floating = .true.
        do i = 0, n
            place = i
            associate (node => nodes(i), p => pivots(i))
                include 'elimination/factor_node.inc'
                held = is_placed(pivots, i)
                if (held .and. node%held) then
                    state = band_needs_pivoting
                    return
                end if
                held = held .or. node%held
                p%c = delta + node%stiffness
                if (i == n) then
                    call factor_last(node, held, p, phi, beta, floating, rounding*size_of_delta(links(n), pivots(n - 1)), &
                                     state)
                    if (present(unstable)) then
                        if (unstable) return
                    end if
                    if (state == band_ok .and. count_unstable_pivots(nodes, pivots) > 0) state = band_mechanism
                    return
                end if
                associate (link => links(i + 1), carried => p%c)
                    p%a = phi + link%faa
                    p%b = beta + link%pa
                    if (floating .or. node%kind == hinge .or. node%kind == hinge_left) then
                        if (held) then
                            p%kind = both_known
                            next = [link%fbb, link%pb, link%gbb]
                        else if (max(abs(carried), abs(link%gaa)) > 0.0_wp) then
                            if (abs(carried + link%gaa) <= rounding*abs(link%gaa)) carried = -link%gaa - little*abs(link%gaa)
                            p%kind = m_known
                            p%reciprocal = 1/(carried + link%gaa)
                            next = [link%fbb + link%p2**2*p%reciprocal, (carried*link%pb + link%s6)*p%reciprocal, &
                                    (carried*link%gbb + link%dg)*p%reciprocal]
                        else
                            p%kind = statics
                            next = 0.0_wp
                        end if
                        floating = p%kind == statics
                    else if (held .and. .not. max(abs(phi), abs(link%faa)) > 0.0_wp) then
                        p%kind = w_ahead
                        p%reciprocal = 1/link%p1
                        next = [link%fbb, link%pb, link%gbb]
                    else if (held) then
                        p%kind = w_known
                        if (.not. abs(p%a) > 0.0_wp) then
                            state = band_needs_pivoting
                            return
                        end if
                        p%reciprocal = 1/p%a
                        next = [(phi*link%fbb + link%df)*p%reciprocal, (phi*link%pb + link%s3)*p%reciprocal, &
                                link%gbb + link%p1**2*p%reciprocal]
                    else
                        p%kind = full
                        divisor = p%a*(carried + link%gaa) + p%b**2
                        if (abs(divisor) <= rounding*(abs(p%a)*max(abs(carried), abs(link%gaa)) &
                                                      + max(abs(beta), abs(link%pa))**2)) then
                            carried = carried - little*max(abs(carried), abs(link%gaa))
                            divisor = p%a*(carried + link%gaa) + p%b**2
                        end if
                        if (.not. abs(divisor) > 0.0_wp) then
                            state = band_mechanism
                            return
                        end if
                        p%reciprocal = 1/divisor
                        next = passed_on(link, phi, beta, carried, p)
                    end if
                    p%c = carried + link%gaa
                end associate
            end associate
            phi = next(1)
            beta = next(2)
            delta = next(3)
        end do
    end subroutine factor_foundation_chain

    !> Is the deflection of a node known from the rigid link before it
    pure function is_placed(pivots, i) result(placed)
        type(pivot_type), intent(in) :: pivots(0:)
        integer, intent(in) :: i
        logical :: placed

        placed = i > 0
        if (placed) placed = pivots(i - 1)%kind == w_ahead
    end function is_placed

    !> phi, beta, delta behind a link before which nothing is known (docs/method.md 3)
    pure function passed_on(link, phi, beta, carried, pivot) result(next)
        type(stretch_link_type), intent(in) :: link
        !> What comes from the left, and the stiffness of what stands at the node with it
        real(wp), intent(in) :: phi, beta, carried
        type(pivot_type), intent(in) :: pivot
        real(wp) :: next(3)

        associate (c => carried + link%gaa)
            next(1) = phi*link%p2**2 + link%s1 + beta*(2*link%s2 + beta*link%fbb) + c*(phi*link%fbb + link%df)
            next(2) = beta**2*link%pb + beta*link%s5 + phi*link%s6 + link%s4 + carried*(phi*link%pb + link%s3)
            next(3) = carried*link%p1**2 + link%s8 + beta*(2*link%s7 + beta*link%gbb) + pivot%a*(carried*link%gbb + link%dg)
        end associate
        next = next*pivot%reciprocal
    end function passed_on

    !> The right end of the beam: no link follows
    pure subroutine factor_last(node, held, pivot, phi, beta, floating, least, state)
        type(node_type), intent(in) :: node
        !> Is its deflection known
        logical, intent(in) :: held
        type(pivot_type), intent(inout) :: pivot
        real(wp), intent(in) :: phi, beta
        logical, intent(in) :: floating
        !> Rounding in the stiffness that comes from the left
        real(wp), intent(in) :: least
        integer, intent(inout) :: state

        pivot%kind = end_of_beam
        pivot%a = phi
        pivot%b = beta
        ! So near to buckling nothing holds the beam
        if (abs(pivot%c) <= least) pivot%c = -least
        if (.not. (held .or. abs(pivot%c) > 0.0_wp)) state = band_mechanism
        if (floating .and. node%kind /= restrained) state = band_mechanism
        if (.not. held .and. state == band_ok) pivot%reciprocal = 1/pivot%c
    end subroutine factor_last

    !> Sum of the sizes of the terms of delta behind a link (passed_on): much more than it only where compression lets them cancel
    pure function size_of_delta(link, pivot) result(total)
        type(stretch_link_type), intent(in) :: link
        !> Of the node before it
        type(pivot_type), intent(in) :: pivot
        real(wp) :: total

        associate (carried => abs(pivot%c - link%gaa), beta => abs(pivot%b - link%pa), each => abs(pivot%reciprocal))
            select case (pivot%kind)
            case (statics)
                total = 0.0_wp
            case (m_known)
                total = (carried*abs(link%gbb) + abs(link%dg))*each
            case (w_known)
                total = abs(link%gbb) + link%p1**2*each
            case (full)
                total = (carried*link%p1**2 + abs(link%s8) + beta*(2*abs(link%s7) + beta*abs(link%gbb)) &
                        + abs(pivot%a)*(carried*abs(link%gbb) + abs(link%dg)))*each
            case default
                total = abs(link%gbb)
            end select
        end associate
    end function size_of_delta

    !> Solve with a factor
    pure subroutine solve_foundation_chain(nodes, links, lengths, pivots, rhs, eliminated, answers)
        !> The nodes, links and factor of factor_foundation_chain (state band_ok)
        type(node_type), intent(in) :: nodes(0:)
        type(stretch_link_type), intent(in) :: links(:)
        !> Lengths of the links, shape (n)
        real(wp), intent(in) :: lengths(:)
        type(pivot_type), intent(in) :: pivots(0:)
        !> Right-hand side, shape (0:n), and workspace for the eliminated one
        type(rhs_type), intent(in) :: rhs(0:)
        type(rhs_type), intent(inout) :: eliminated(0:)
        !> The solution, shape (0:n)
        type(answer_type), intent(out) :: answers(0:)

        if (checked) call require(size(nodes) == size(links) + 1 .and. size(pivots) == size(nodes) .and. &
                                  size(rhs) == size(nodes) .and. size(answers) == size(nodes), "solve_foundation_chain: shapes")
        eliminated = rhs
        call eliminate(nodes, links, lengths, pivots, eliminated, answers)
        call substitute(nodes, links, lengths, pivots, rhs, eliminated, answers)
    end subroutine solve_foundation_chain

    !> Forward: rhs(i)%left becomes the e that the left side passes to node i, rhs(i)%right and %shear the right-hand sides E and
    !> G of its pivot; moments known by statics go into the answers at once, deflections that rigid links tell into the next rhs
    pure subroutine eliminate(nodes, links, lengths, pivots, rhs, answers)
        type(node_type), intent(in) :: nodes(0:)
        type(stretch_link_type), intent(in) :: links(:)
        real(wp), intent(in) :: lengths(:)
        type(pivot_type), intent(in) :: pivots(0:)
        type(rhs_type), intent(inout) :: rhs(0:)
        type(answer_type), intent(inout) :: answers(0:)
        real(wp) :: e, p, m, w, divisor
        integer :: i

        m = 0.0_wp
        e = 0.0_wp
        p = 0.0_wp
        do i = 0, size(links)
            associate (node => nodes(i), v => pivots(i), r => rhs(i))
                include 'elimination/come_to_node.inc'
                if (v%kind == end_of_beam) exit
                associate (link => links(i + 1), g => r%shear)
                    select case (v%kind)
                    case (full)
                        m = (v%b*g - v%c*r%right)*v%reciprocal
                        w = (v%b*r%right + v%a*g)*v%reciprocal
                    case (w_known)
                        m = (v%b*r%deflection - r%right)*v%reciprocal
                        w = r%deflection
                    case (w_ahead)
                        m = 0.0_wp
                        w = r%deflection
                        rhs(i + 1)%deflection = (v%b*w - r%right)*v%reciprocal
                    case (m_known)
                        answers(i)%moment_right = m
                        w = (g - link%pa*m)*v%reciprocal
                    case (both_known)
                        answers(i)%moment_right = m
                        w = r%deflection
                    case default
                        answers(i)%moment_right = m
                        m = m - g*lengths(i + 1)
                        p = g
                        cycle
                    end select
                    e = link%p2*w + link%fab*m
                    p = link%p1*m - link%gab*w
                end associate
            end associate
        end do
    end subroutine eliminate

    !> Backward
    pure subroutine substitute(nodes, links, lengths, pivots, given, rhs, answers)
        type(node_type), intent(in) :: nodes(0:)
        type(stretch_link_type), intent(in) :: links(:)
        real(wp), intent(in) :: lengths(:)
        type(pivot_type), intent(in) :: pivots(0:)
        !> Right-hand side as it was, and eliminated
        type(rhs_type), intent(in) :: given(0:), rhs(0:)
        type(answer_type), intent(inout) :: answers(0:)
        real(wp) :: m_next, w_next, m, w, psi_right, shear_right, turn, push
        integer :: i

        m_next = 0.0_wp
        w_next = 0.0_wp
        psi_right = 0.0_wp
        shear_right = 0.0_wp
        do i = size(links), 0, -1
            associate (node => nodes(i), v => pivots(i), r => rhs(i))
                if (v%kind == end_of_beam) then
                    m = 0.0_wp
                    w = r%deflection
                    if (.not. (node%held .or. is_placed(pivots, i))) w = r%shear*v%reciprocal
                else
                    associate (link => links(i + 1))
                        turn = link%p1*w_next + link%fab*m_next
                        push = link%p2*m_next - link%gab*w_next
                        m = answers(i)%moment_right
                        w = r%deflection
                        select case (v%kind)
                        case (full)
                            m = (v%b*(r%shear + push) - v%c*(r%right + turn))*v%reciprocal
                            w = (v%b*(r%right + turn) + v%a*(r%shear + push))*v%reciprocal
                        case (w_known)
                            m = (v%b*w - r%right - turn)*v%reciprocal
                        case (w_ahead)
                            m = (link%pb*m_next + link%gab*w + (link%gbb + nodes(i + 1)%stiffness)*w_next &
                                 - given(i + 1)%shear - shear_right)*v%reciprocal
                        case (m_known)
                            if (abs(v%c*link%fbb) < link%p2**2 .and. nodes(i + 1)%kind == plain &
                                .and. pivots(i + 1)%kind /= end_of_beam) then
                                ! What is so soft that the link beside it is stiff is known better from the slope of what follows
                                w = (link%pb*w_next - link%fab*m - link%fbb*m_next - given(i + 1)%left &
                                     - (psi_right + given(i + 1)%right))/link%p2
                            else
                                w = (r%shear - link%pa*m + push)*v%reciprocal
                            end if
                        case (statics)
                            w = w_next - lengths(i + 1)*(link%fab*m + link%fbb*m_next + psi_right)
                        case default  ! both are known
                            continue
                        end select
                        psi_right = turn - link%pa*w + link%faa*m
                        shear_right = push - link%pa*m - link%gaa*w
                    end associate
                end if
                include 'elimination/leave_node.inc'
            end associate
        end do
    end subroutine substitute

end module gapbeam_foundation_chain
