!> Forward elimination and back substitution with the factor of gapbeam_band.
!> On the whole beam, or on as much of it as a change can be seen on.
module gapbeam_band_substitution
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: hidden_change
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_nodes, only: hinge, restrained, jointed, hinge_left, hinge_right, joint_left, joint_right, takes_left
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, full, w_known, m_known, both_known, end_of_beam
    implicit none
    private
    public :: solve_chain, correct_chain

contains

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
                include 'elimination/come_to_node.inc'
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
                small = abs(e) <= hidden_change*(abs(pivot%phi)*moment + abs(pivot%beta)*w) &
                    .and. abs(p) <= hidden_change*(abs(pivot%beta)*moment + abs(pivot%delta)*w)
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
                                  abs(a%deflection) <= hidden_change*abs(s%deflection) .and. &
                                  abs(a%moment_left) <= hidden_change*abs(s%moment_left))
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
                include 'elimination/leave_node.inc'
            end associate
        end do
    end subroutine substitute

end module gapbeam_band_substitution
