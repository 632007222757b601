!> The displacement method as a yardstick: cubic Hermite elements, w and rotations, banded Cholesky.
!>
!> Plain: K u = f once. Incremental, as research codes do it: the residual is formed element by element from the
!> deformations of each element (differences first), K du = residual, until du no longer gets smaller.
module yardstick_displacement
    use gapbeam_kinds, only: wp
    use yardstick_beam, only: beam_type, answer_type, method_type, is_rigid, node_load, solved, singular
    use yardstick_lapack, only: dpbtrf, dpbtrs
    implicit none
    private
    public :: displacement_type

    !> Half bandwidth
    integer, parameter :: band = 3
    !> Increments with one scheme before giving up
    integer, parameter :: most_increments = 20

    !> The method and its workspace
    type, extends(method_type) :: displacement_type
        !> Incremental or plain
        logical :: incremental = .false.
        real(wp), allocatable, private :: matrix(:, :), b(:, :), u(:)
    contains
        procedure :: solve
        procedure :: finish
        procedure :: restart
    end type displacement_type

contains

    !> Forget the displacements so far
    pure subroutine restart(self)
        class(displacement_type), intent(inout) :: self

        self%u(:) = 0.0_wp
    end subroutine restart

    !> Assemble, factor, solve; incremental: one increment from where the last scheme ended
    subroutine solve(self, beam, closed, answer, status)
        class(displacement_type), intent(inout) :: self
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        integer, intent(out) :: status
        integer :: n, unknowns, info

        n = size(beam%length)
        unknowns = 2*(n + 1)
        if (.not. allocated(self%matrix)) then
            allocate (self%matrix(band + 1, unknowns), self%b(unknowns, 1), self%u(unknowns))
            self%u(:) = 0.0_wp
        end if
        if (.not. self%incremental) self%u(:) = 0.0_wp
        call element_forces(beam, closed, self%u, self%b(:, 1))
        call assemble(beam, closed, self%matrix)
        call hold(beam, closed, self%matrix, self%u, self%b(:, 1))
        call dpbtrf("L", unknowns, band, self%matrix, band + 1, info)
        status = merge(solved, singular, info == 0)
        if (status /= solved) return
        call dpbtrs("L", unknowns, band, 1, self%matrix, band + 1, self%b, unknowns, info)
        self%u(:) = self%u + self%b(:, 1)
        call take(beam, closed, self%u, answer)
    end subroutine solve

    !> Further increments with the factor of the last solve, as long as they get smaller
    subroutine finish(self, beam, closed, answer, status)
        class(displacement_type), intent(inout) :: self
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        type(answer_type), intent(in) :: answer
        integer, intent(out) :: status
        real(wp) :: change, last
        integer :: unknowns, info, increment, i

        status = solved
        if (.not. self%incremental) return
        unknowns = size(self%u)
        last = huge(last)
        do increment = 1, most_increments
            call element_forces(beam, closed, self%u, self%b(:, 1))
            do i = 0, size(beam%length)
                if (is_rigid(beam%stiff(i), closed(i))) self%b(2*i + 1, 1) = 0.0_wp
            end do
            if (beam%clamped(1)) self%b(2, 1) = 0.0_wp
            if (beam%clamped(2)) self%b(unknowns, 1) = 0.0_wp
            call dpbtrs("L", unknowns, band, 1, self%matrix, band + 1, self%b, unknowns, info)
            change = maxval(abs(self%b(1::2, 1)))
            if (.not. change < last/2) exit
            self%u(:) = self%u + self%b(:, 1)
            if (change <= epsilon(change)*maxval(abs(self%u(1::2)))) exit
            last = change
        end do
        call take(beam, closed, self%u, answer)
    end subroutine finish

    !> Stiffness matrix of all elements and springs, lower band: element (i, j) in row 1 + i - j of column j
    pure subroutine assemble(beam, closed, matrix)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        real(wp), intent(out) :: matrix(:, :)
        real(wp) :: k, h
        integer :: i, j

        matrix = 0.0_wp
        do i = 1, size(beam%length)
            h = beam%length(i)
            k = 2*beam%ei(i)/h**3
            j = 2*i - 1
            matrix(1:4, j) = matrix(1:4, j) + k*[6.0_wp, 3*h, -6.0_wp, 3*h]
            matrix(1:3, j + 1) = matrix(1:3, j + 1) + k*[2*h**2, -3*h, h**2]
            matrix(1:2, j + 2) = matrix(1:2, j + 2) + k*[6.0_wp, -3*h]
            matrix(1, j + 3) = matrix(1, j + 3) + k*2*h**2
        end do
        do i = 0, size(beam%length)
            if (closed(i) .and. .not. is_rigid(beam%stiff(i), .true.)) matrix(1, 2*i + 1) = matrix(1, 2*i + 1) + beam%stiff(i)
        end do
    end subroutine assemble

    !> Replace the rows of known displacements; what they do to the others goes to the right-hand side
    subroutine hold(beam, closed, matrix, u, b)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        real(wp), intent(inout) :: matrix(:, :), b(:)
        !> Displacements so far
        real(wp), intent(in) :: u(:)
        integer :: i

        do i = 0, size(beam%length)
            if (is_rigid(beam%stiff(i), closed(i))) call fix(2*i + 1, beam%level(i) - u(2*i + 1))
        end do
        if (beam%clamped(1)) call fix(2, -u(2))
        if (beam%clamped(2)) call fix(size(u), -u(size(u)))

    contains

        !> Give one displacement
        subroutine fix(j, value)
            integer, intent(in) :: j
            real(wp), intent(in) :: value
            integer :: d

            do d = 1, band
                if (j + d <= size(b)) b(j + d) = b(j + d) - matrix(1 + d, j)*value
                if (j - d >= 1) then
                    b(j - d) = b(j - d) - matrix(1 + d, j - d)*value
                    matrix(1 + d, j - d) = 0.0_wp
                end if
            end do
            matrix(:, j) = 0.0_wp
            matrix(1, j) = 1.0_wp
            b(j) = value
        end subroutine fix

    end subroutine hold

    !> Loads less the forces of all elements and springs: the residual, for u = 0 the loads alone
    pure subroutine element_forces(beam, closed, u, b)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        !> Displacements (w, rotation) node by node
        real(wp), intent(in) :: u(:)
        !> Residual, in the same order
        real(wp), intent(out) :: b(:)
        real(wp) :: m_a, m_b, shear, couple
        integer :: i, j

        do i = 0, size(beam%length)
            b(2*i + 1) = node_load(beam, i)
            b(2*i + 2) = 0.0_wp
            if (closed(i) .and. .not. is_rigid(beam%stiff(i), .true.)) then
                b(2*i + 1) = b(2*i + 1) - beam%stiff(i)*(u(2*i + 1) - beam%level(i))
            end if
        end do
        do i = 1, size(beam%length)
            j = 2*i - 1
            call end_moments(beam, i, u, m_a, m_b)
            shear = (m_a + m_b)/beam%length(i)
            couple = beam%q(i)*beam%length(i)**2/12
            b(j) = b(j) - shear
            b(j + 1) = b(j + 1) - (m_a - couple)
            b(j + 2) = b(j + 2) + shear
            b(j + 3) = b(j + 3) - (m_b + couple)
        end do
    end subroutine element_forces

    !> Moments that the nodes exert on an element, clockwise, from the turns of its ends against its chord
    pure subroutine end_moments(beam, i, u, m_a, m_b)
        type(beam_type), intent(in) :: beam
        !> The element, from 1
        integer, intent(in) :: i
        real(wp), intent(in) :: u(:)
        real(wp), intent(out) :: m_a, m_b
        real(wp) :: chord, turn_a, turn_b, k

        chord = (u(2*i + 1) - u(2*i - 1))/beam%length(i)
        turn_a = u(2*i) - chord
        turn_b = u(2*i + 2) - chord
        k = 2*beam%ei(i)/beam%length(i)
        m_a = k*(2*turn_a + turn_b)
        m_b = k*(turn_a + 2*turn_b)
    end subroutine end_moments

    !> Deflections, moments and reactions from the displacements
    subroutine take(beam, closed, u, answer)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(0:)
        real(wp), intent(in) :: u(:)
        type(answer_type), intent(in) :: answer
        real(wp) :: m_a, m_b, left, right
        integer :: i, n

        n = size(beam%length)
        answer%w = u(1::2)
        left = 0.0_wp
        do i = 0, n
            right = 0.0_wp
            if (i < n) then
                call end_moments(beam, i + 1, u, m_a, m_b)
                right = (m_a + m_b)/beam%length(i + 1)
                answer%m(i) = m_a - beam%q(i + 1)*beam%length(i + 1)**2/12
                if (i == n - 1) answer%m(n) = -m_b - beam%q(n)*beam%length(n)**2/12
            end if
            if (.not. closed(i)) then
                answer%r(i) = 0.0_wp
            else if (is_rigid(beam%stiff(i), .true.)) then
                answer%r(i) = node_load(beam, i) + (left - right)
            else
                answer%r(i) = beam%stiff(i)*(answer%w(i) - beam%level(i))
            end if
            left = right
        end do
    end subroutine take

end module yardstick_displacement
