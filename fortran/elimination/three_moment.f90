!> Three-moment equations: the mixed system where every deflection is known.
!>
!> When a rigid support acts at every node (but for unsupported tips at the ends of the beam), only the
!> moments are unknown: Clapeyron's equations, one a node, a tridiagonal system. Its elimination is that
!> of gapbeam_band with the deflections left out.
module gapbeam_three_moment
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, rhs_type, answer_type, plain, restrained
    implicit none
    private
    public :: fits_three_moment, solve_three_moment

contains

    !> Can the scheme be solved by three-moment equations: all deflections known but those of free tips
    pure function fits_three_moment(nodes) result(fits)
        !> Nodes as the contact state sees them, shape (0:n)
        type(node_type), intent(in) :: nodes(0:)
        logical :: fits
        integer :: n, held

        n = ubound(nodes, 1)
        fits = all(nodes(1:n - 1)%held .and. nodes(1:n - 1)%kind == plain)
        if (.not. fits) return
        held = count(nodes%held)
        fits = is_end(nodes(0)) .and. is_end(nodes(n)) .and. &
            (held > 1 .or. (nodes(0)%held .and. nodes(0)%kind == restrained) &
            .or. (nodes(n)%held .and. nodes(n)%kind == restrained))
    end function fits_three_moment

    !> Does the end of the beam either rest on a rigid support or hang free
    pure function is_end(node) result(fits)
        type(node_type), intent(in) :: node
        logical :: fits

        fits = node%held .or. (node%kind == plain .and. .not. node%stiffness > 0.0_wp)
    end function is_end

    !> Assemble and solve. From the left, psi = -phi M - e at every node; M_right = y - z M_left(next)
    pure subroutine solve_three_moment(nodes, links, rhs, work, answers, regular)
        !> Nodes for which fits_three_moment holds, and the links between them
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        !> Right-hand side, shape (0:n)
        type(rhs_type), intent(in) :: rhs(0:)
        !> Workspace for y and z, shape (2, 0:n)
        real(wp), intent(inout) :: work(:, 0:)
        !> Deflections and moments, shape (0:n)
        type(answer_type), intent(inout) :: answers(0:)
        !> False where a pivot vanishes: rigid stretches over rigid supports
        logical, intent(out) :: regular
        real(wp) :: phi, e, chord, a
        integer :: i, n, first, final

        n = size(links)
        if (checked) then
            call require(size(nodes) == n + 1 .and. size(rhs) == n + 1 .and. size(answers) == n + 1, "solve_three_moment: shapes")
            call require(fits_three_moment(nodes), "solve_three_moment: nodes")
        end if
        regular = .true.
        first = merge(0, 1, nodes(0)%held)
        final = merge(n, n - 1, nodes(n)%held)
        answers%deflection = rhs%deflection
        call tip_moments(links, rhs, first, final, answers)
        phi = 0.0_wp
        e = 0.0_wp
        do i = first, final - 1
            associate (node => nodes(i), r => rhs(i), link => links(i + 1))
                chord = (rhs(i + 1)%deflection - r%deflection)*link%inverse
                if (i == first .and. node%kind == plain) then
                    work(1, i) = answers(i)%moment_left + r%couple
                    work(2, i) = 0.0_wp
                    phi = link%fbb
                else
                    if (i == first) phi = node%compliance
                    a = phi + link%faa
                    regular = a > 0.0_wp
                    if (.not. regular) return
                    work(1, i) = (phi*r%couple - e - chord - r%right)/a
                    work(2, i) = link%fab/a
                    phi = (link%fbb*phi + link%determinant)/a
                end if
                e = link%fab*work(1, i) - chord + rhs(i + 1)%left
            end associate
        end do
        if (final == n .and. nodes(n)%kind == restrained .and. first < n) then
            a = phi + nodes(n)%compliance
            regular = a > 0.0_wp
            if (.not. regular) return
            answers(n)%moment_left = -(e + nodes(n)%compliance*rhs(n)%couple)/a
        end if
        do i = final - 1, first, -1
            answers(i)%moment_right = work(1, i) - work(2, i)*answers(i + 1)%moment_left
            if (i > first) answers(i)%moment_left = answers(i)%moment_right - rhs(i)%couple
        end do
        if (first == 1) call left_tip(nodes, links, rhs, answers)
        if (final == n - 1) call right_tip(nodes, links, rhs, answers)
    end subroutine solve_three_moment

    !> Moments known beforehand: at pinned ends and, by statics, at the roots of overhangs
    pure subroutine tip_moments(links, rhs, first, final, answers)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        integer, intent(in) :: first, final
        type(answer_type), intent(inout) :: answers(0:)
        integer :: n

        n = size(links)
        answers(0)%moment_left = 0.0_wp
        answers(n)%moment_right = 0.0_wp
        answers(n)%moment_left = -rhs(n)%couple
        if (first == 1) then
            answers(0)%moment_right = rhs(0)%couple
            answers(1)%moment_left = rhs(0)%couple - rhs(0)%shear*links(1)%length
        end if
        if (final == n - 1) then
            answers(n - 1)%moment_right = answers(n)%moment_left - rhs(n)%shear*links(n)%length
            answers(n - 1)%moment_left = answers(n - 1)%moment_right - rhs(n - 1)%couple
            if (n == 1) answers(0)%moment_left = 0.0_wp
        end if
    end subroutine tip_moments

    !> Deflection of a free left tip from the rotation at the first support
    pure subroutine left_tip(nodes, links, rhs, answers)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        type(answer_type), intent(inout) :: answers(0:)
        real(wp) :: psi

        associate (root => answers(1))
            if (size(links) == 1) then
                psi = nodes(1)%compliance*(root%moment_left + rhs(1)%couple)
            else
                psi = (answers(2)%deflection - root%deflection)/links(2)%length + links(2)%faa*root%moment_right &
                    + links(2)%fab*answers(2)%moment_left + rhs(1)%right
            end if
            answers(0)%deflection = root%deflection - links(1)%length*(psi + rhs(1)%left &
                + links(1)%fab*answers(0)%moment_right + links(1)%fbb*root%moment_left)
        end associate
    end subroutine left_tip

    !> Deflection of a free right tip from the rotation at the last support
    pure subroutine right_tip(nodes, links, rhs, answers)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        type(answer_type), intent(inout) :: answers(0:)
        real(wp) :: psi
        integer :: n

        n = size(links)
        associate (root => answers(n - 1))
            if (n == 1) then
                psi = nodes(0)%compliance*(rhs(0)%couple - root%moment_right)
            else
                psi = (root%deflection - answers(n - 2)%deflection)/links(n - 1)%length &
                    - links(n - 1)%fab*answers(n - 2)%moment_right - links(n - 1)%fbb*root%moment_left &
                    - rhs(n - 1)%left
            end if
            answers(n)%deflection = root%deflection + links(n)%length*(psi - rhs(n - 1)%right &
                - links(n)%faa*root%moment_right - links(n)%fab*answers(n)%moment_left)
        end associate
    end subroutine right_tip

end module gapbeam_three_moment
