!> Residual of the mixed system of a beam on elastic ground (gapbeam_foundation_chain).
!>
!> Where nothing but a zone of next to no length holds a part of the beam, elimination passes huge numbers through it that cancel
!> later: a zone of a share e of the beam loses the digits of 1/e**2. The rows themselves have no such numbers, so a solution is
!> corrected by what they lack.
module gapbeam_foundation_residual
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_nodes, only: jointed, joint_left, joint_right, is_hinge, is_restrained, takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_foundation, only: stretch_link_type
    implicit none
    private
    public :: residual_on_ground

contains

    !> Residuals of all rows, in the working precision
    pure subroutine residual_on_ground(nodes, links, rhs, answers, residual)
        !> Nodes, shape (0:n), links, shape (n), and right-hand side, shape (0:n), of the system
        type(node_type), intent(in) :: nodes(0:)
        type(stretch_link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        !> A solution, shape (0:n)
        type(answer_type), intent(in) :: answers(0:)
        !> Right-hand side of the correction, shape (0:n)
        type(rhs_type), intent(inout) :: residual(0:)
        !> Rotation and shear left and right of a node by the links there
        real(wp) :: before(2), after(2), next(2), turn, joint(2)
        integer :: i, n

        n = size(links)
        if (checked) call require(size(nodes) == n + 1 .and. size(rhs) == n + 1 .and. size(answers) == n + 1 .and. &
                                  size(residual) == n + 1, "residual_on_ground: shapes")
        before = 0.0_wp
        do i = 0, n
            after = 0.0_wp
            next = 0.0_wp
            if (i < n) call ends_of_link(links(i + 1), answers(i), answers(i + 1), after, next)
            residual(i) = rhs_type()
            associate (node => nodes(i), a => answers(i), b => rhs(i), r => residual(i))
                if (is_restrained(node%kind)) then
                    turn = node%compliance*((a%moment_left - a%moment_right) + b%couple)
                    joint = [merge(node%joint*a%moment_left, 0.0_wp, node%kind == joint_right), &
                             merge(node%joint*a%moment_right, 0.0_wp, node%kind == joint_left)]
                    if (takes_left(node%kind) .and. i > 0) r%left = ((turn + joint(1)) - before(1)) + b%left
                    if (takes_right(node%kind) .and. i < n) r%right = (after(1) - (turn - joint(2))) + b%right
                else if (.not. is_hinge(node%kind) .and. i > 0 .and. i < n) then
                    r%right = ((after(1) - before(1)) + b%left) + b%right
                    if (node%kind == jointed) r%right = r%right + node%compliance*a%moment_left
                end if
                if (node%held) then
                    r%deflection = b%deflection - a%deflection
                else
                    r%shear = ((after(2) - before(2)) + b%shear) - node%stiffness*a%deflection
                end if
            end associate
            before = next
        end do
    end subroutine residual_on_ground

    !> Rotation and transverse force at the two ends of a link, without those of its loads
    pure subroutine ends_of_link(link, a, b, at_a, at_b)
        type(stretch_link_type), intent(in) :: link
        type(answer_type), intent(in) :: a, b
        real(wp), intent(out) :: at_a(2), at_b(2)

        at_a(1) = (link%p1*b%deflection - link%pa*a%deflection) + (link%faa*a%moment_right + link%fab*b%moment_left)
        at_b(1) = (link%pb*b%deflection - link%p2*a%deflection) - (link%fab*a%moment_right + link%fbb*b%moment_left)
        at_a(2) = (link%p2*b%moment_left - link%pa*a%moment_right) - (link%gaa*a%deflection + link%gab*b%deflection)
        at_b(2) = (link%pb*b%moment_left - link%p1*a%moment_right) + (link%gbb*b%deflection + link%gab*a%deflection)
    end subroutine ends_of_link

end module gapbeam_foundation_residual
