!> How far the results of eight cases move when every row of their systems is off by so much: bounds, where
!> gapbeam_sensitivity estimates.
!>
!> What is off at a node is seen elsewhere through two numbers, the rotation and the force that one part of the beam passes on to
!> the next (gapbeam_kernel). All that the rows of a part may pass on together is a zonotope in the plane of these two; an ellipse
!> around it goes through the elimination in its place. The smallest ellipses around the sum of two, as far as their sizes by the
!> energy go, are those of Kurzhanski and Valyi (1997, 2.2). Where a result is looked at, one ellipse comes from either side, and
!> the bound is their reach in the direction of that result: never less than the largest sum of |K^-1| times what rows are off.
module gapbeam_lane_movements
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type
    implicit none
    private
    public :: find_movements, kinds_of_movement
    public :: of_deflection, of_moment, of_shear, of_rotation

    !> Results: deflections and moments of the nodes; shears of the links, and rotations at their left ends
    integer, parameter :: of_deflection = 1, of_moment = 2, of_shear = 3, of_rotation = 4
    !> Arrays for them and for what comes from the right
    integer, parameter :: kinds_of_movement = 10
    !> Of what comes from the right: flexibilities as in gapbeam_kernel, and the ellipse
    integer, parameter :: phi_right = 5, beta_right = 6, delta_right = 7, q11_right = 8, q12_right = 9, q22_right = 10

contains

    !> Find the movements of beams that are held at both ends and have no hinges
    pure subroutine find_movements(beam, n, held, spring, turn, force, moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Is the deflection known (1), and the stiffness of the node, shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring
        !> What compatibility (0 at the ends) and equilibrium (0 where the deflection is known) may be off
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, force
        !> Movements, those of links with no entry at 0
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)

        call come_from_right(beam, n, held, spring, turn, force, moves)
        call go_to_right(beam, n, held, spring, turn, force, moves)
    end subroutine find_movements

    !> What the parts right of each node pass on
    pure subroutine come_from_right(beam, n, held, spring, turn, force, moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring, turn, force
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)
        real(wp) :: h, near, far, cross, sum_near, sum_far, bending, determinant
        real(wp), dimension(lanes) :: free, a, b, c, r
        real(wp) :: open, stiff, softness, phi, beta, b_free, q11, q12, q22, c11, c12, c21, c22, a11, a12, a21, a22
        integer :: i, l

        h = beam%inverse(n)
        far = beam%faa(n)
        moves(:, n, phi_right:q22_right) = 0.0_wp
        moves(:, n - 1, phi_right:q22_right) = 0.0_wp
        !$omp simd private(open, stiff, softness)
        do l = 1, lanes
            open = 1.0_wp - held(l, n)
            stiff = spring(l, n)*open + held(l, n)
            softness = open/(stiff + merge(0.0_wp, 1.0_wp, stiff > 0.0_wp))
            moves(l, n, q22_right) = open*force(l, n)**2
            moves(l, n - 1, phi_right) = far + h**2*softness
            moves(l, n - 1, beta_right) = h
            moves(l, n - 1, q11_right) = (h*softness*force(l, n))**2
        end do
        do i = n - 1, 1, -1
            h = beam%inverse(i)
            near = beam%fbb(i)
            far = beam%faa(i)
            cross = beam%fab(i)
            sum_near = beam%sum_b(i)
            sum_far = beam%sum_a(i)
            bending = beam%bending(i)
            determinant = beam%determinant(i)
            !$omp simd
            do l = 1, lanes
                free(l) = 1.0_wp - held(l, i)
                a(l) = moves(l, i, phi_right) + near
                b(l) = moves(l, i, beta_right) + h
                c(l) = free(l)*moves(l, i, delta_right) + (spring(l, i)*free(l) + held(l, i))
                r(l) = 1/(a(l)*c(l) + free(l)*b(l)**2)
            end do
            call add_rows(a, b, c, free, r, turn(:, i), force(:, i), moves(:, i, q11_right), moves(:, i, q12_right), &
                          moves(:, i, q22_right))
            !$omp simd private(phi, beta, b_free, q11, q12, q22, c11, c12, c21, c22, a11, a12, a21, a22, open)
            do l = 1, lanes
                open = 1.0_wp - held(l, i - 1)
                phi = moves(l, i, phi_right)
                beta = moves(l, i, beta_right)
                b_free = free(l)*b(l)
                q11 = moves(l, i, q11_right)
                q12 = moves(l, i, q12_right)
                q22 = moves(l, i, q22_right)
                c11 = -c(l)*r(l)
                c12 = b(l)*r(l)
                c21 = b_free*r(l)
                c22 = free(l)*a(l)*r(l)
                a11 = h*c21 + cross*c11
                a12 = h*c22 + cross*c12
                a21 = open*h*c11
                a22 = open*h*c12
                moves(l, i - 1, q11_right) = a11*(a11*q11 + 2*a12*q12) + a12**2*q22
                moves(l, i - 1, q12_right) = a11*(a21*q11 + a22*q12) + a12*(a21*q12 + a22*q22)
                moves(l, i - 1, q22_right) = a21*(a21*q11 + 2*a22*q12) + a22**2*q22
                moves(l, i - 1, phi_right) = (free(l)*((phi + bending)*(h*h) + beta*(2*h*sum_far + beta*far)) &
                                              + c(l)*(phi*far + determinant))*r(l)
                moves(l, i - 1, beta_right) = (c(l)*h*(phi + sum_near) + b_free*h*beta)*r(l)
                moves(l, i - 1, delta_right) = c(l)*h*h*r(l)
            end do
        end do
    end subroutine come_from_right

    !> The same from the left, and at every link what both make of its results
    pure subroutine go_to_right(beam, n, held, spring, turn, force, moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring, turn, force
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)
        real(wp) :: h, faa, fab, fbb, sum_a, sum_b, bending, determinant, first, inner
        real(wp), dimension(lanes) :: phi, beta, delta, p11, p12, p22, free, softness, a_left, b_left, c_left, r_left, at_left
        real(wp) :: free_b, stiff, a, b, c, b_free, r, q11, q12, q22, s11, s12, s22
        real(wp) :: c11, c12, c21, c22, d11, d12, d21, d22, a11, a12, a21, a22, b11, b12, b21, b22, next_phi, next_beta, next_delta
        real(wp) :: m1, m2, w1, w2, n1, n2, n3, n4, u1, u2, u3, u4
        integer :: k, l

        phi(:) = 0.0_wp
        beta(:) = 0.0_wp
        delta(:) = 0.0_wp
        p11(:) = 0.0_wp
        p12(:) = 0.0_wp
        p22(:) = 0.0_wp
        moves(:, 0, of_moment) = 0.0_wp
        do k = 1, n
            h = beam%inverse(k)
            faa = beam%faa(k)
            fab = beam%fab(k)
            fbb = beam%fbb(k)
            sum_a = beam%sum_a(k)
            sum_b = beam%sum_b(k)
            bending = beam%bending(k)
            determinant = beam%determinant(k)
            first = merge(1.0_wp, 0.0_wp, k == 1)
            inner = merge(1.0_wp, 0.0_wp, k < n)
            !$omp simd private(stiff)
            do l = 1, lanes
                ! The node on the left
                free(l) = 1.0_wp - held(l, k - 1)
                stiff = spring(l, k - 1)*free(l) + held(l, k - 1)
                softness(l) = first*free(l)/(stiff + merge(0.0_wp, 1.0_wp, stiff > 0.0_wp))
                a_left(l) = phi(l) + faa
                b_left(l) = beta(l) + h
                c_left(l) = free(l)*delta(l) + stiff
                r_left(l) = 1/(a_left(l)*c_left(l) + free(l)*b_left(l)**2)
            end do
            call add_rows(a_left, b_left, c_left, free, r_left, turn(:, k - 1), force(:, k - 1), p11, p12, p22)
            !$omp simd private(free_b, a, b, c, b_free, r, q11, q12, q22, s11, s12, s22, c11, c12, c21, &
            !$omp   c22, d11, d12, d21, d22, a11, a12, a21, a22, b11, b12, b21, b22, next_phi, next_beta, next_delta, m1, m2, w1, &
            !$omp   w2, n1, n2, n3, n4, u1, u2, u3, u4)
            do l = 1, lanes
                ! What it passes on
                free_b = 1.0_wp - held(l, k)
                a = a_left(l)
                b = b_left(l)
                c = c_left(l)
                b_free = free(l)*b
                r = (1.0_wp - first)*r_left(l)
                q11 = p11(l)
                q12 = p12(l)
                q22 = p22(l)
                c11 = -c*r
                c12 = b*r
                c21 = b_free*r
                c22 = free(l)*a*r + softness(l)
                d11 = (b_free*h - c*fab)*r
                d12 = -c*h*r
                d21 = free(l)*(b*fab + a*h)*r + h*softness(l)
                d22 = b_free*h*r
                a11 = h*c21 + fab*c11
                a12 = h*c22 + fab*c12
                a21 = free_b*h*c11
                a22 = free_b*h*c12
                next_phi = (free(l)*((phi(l) + bending)*(h*h) + beta(l)*(2*h*sum_b + beta(l)*fbb)) &
                            + c*(phi(l)*fbb + determinant))*r + first*(fbb + h**2*softness(l))
                next_beta = (c*h*(phi(l) + sum_a) + b_free*h*beta(l))*r + first*h
                next_delta = c*h*h*r
                phi(l) = next_phi
                beta(l) = next_beta
                delta(l) = next_delta
                p11(l) = a11*(a11*q11 + 2*a12*q12) + a12**2*q22
                p12(l) = a11*(a21*q11 + a22*q12) + a12*(a21*q12 + a22*q22)
                p22(l) = a21*(a21*q11 + 2*a22*q12) + a22**2*q22
                ! The node on the right, where both parts meet; at the end there is no moment
                a = next_phi + moves(l, k, phi_right)
                b = next_beta + moves(l, k, beta_right)
                c = free_b*(next_delta + moves(l, k, delta_right)) + (spring(l, k)*free_b + held(l, k))
                r = inner/(a*c + free_b*b**2)
                b11 = -c*r
                b12 = free_b*b*r
                b21 = free_b*b*r
                b22 = free_b*(a*r + (1.0_wp - inner)/(c + merge(0.0_wp, 1.0_wp, c > 0.0_wp)))
                s11 = moves(l, k, q11_right)
                s12 = moves(l, k, q12_right)
                s22 = moves(l, k, q22_right)
                ! Results by what comes from the left (1, 2) and from the right (3, 4), rotation and force
                m1 = b11*a11 + b12*a21
                m2 = b11*a12 + b12*a22
                w1 = b21*a11 + b22*a21
                w2 = b21*a12 + b22*a22
                n1 = c11 + (d11*m1 + d12*w1)
                n2 = c12 + (d11*m2 + d12*w2)
                n3 = d11*b11 + d12*b21
                n4 = d11*b12 + d12*b22
                u1 = c21 + (d21*m1 + d22*w1)
                u2 = c22 + (d21*m2 + d22*w2)
                u3 = d21*b11 + d22*b21
                u4 = d21*b12 + d22*b22
                moves(l, k, of_moment) = reach(m1, m2, q11, q12, q22) + reach(b11, b12, s11, s12, s22)
                moves(l, k, of_deflection) = reach(w1, w2, q11, q12, q22) + reach(b21, b22, s11, s12, s22)
                moves(l, k, of_shear) = h*(reach(m1 - n1, m2 - n2, q11, q12, q22) + reach(b11 - n3, b12 - n4, s11, s12, s22))
                moves(l, k, of_rotation) = &
                    reach(h*(w1 - u1) + (faa*n1 + fab*m1), h*(w2 - u2) + (faa*n2 + fab*m2), q11, q12, q22) &
                    + reach(h*(b21 - u3) + (faa*n3 + fab*b11), h*(b22 - u4) + (faa*n4 + fab*b12), s11, s12, s22)
                at_left(l) = reach(u1, u2, q11, q12, q22) + reach(u3, u4, s11, s12, s22)
            end do
            if (k == 1) moves(:, 0, of_deflection) = at_left
        end do
    end subroutine go_to_right

    !> Reach of an ellipse in a direction
    elemental function reach(x, y, q11, q12, q22) result(distance)
        real(wp), intent(in) :: x, y, q11, q12, q22
        real(wp) :: distance

        ! Below 0 by rounding only
        distance = sqrt(abs(x*(x*q11 + 2*y*q12) + y**2*q22))
    end function reach

    !> The ellipses around what comes in and what the rows of a node add
    pure subroutine add_rows(a, b, c, free, r, turn, force, q11, q12, q22)
        !> By which the node is eliminated, and what its rows are off
        real(wp), intent(in), dimension(lanes) :: a, b, c, free, r, turn, force
        real(wp), intent(inout), dimension(lanes) :: q11, q12, q22
        real(wp) :: stiff, moment, deflection, size_in, size_turn, size_force, total, share, off
        integer :: l

        !$omp simd private(stiff, moment, deflection, size_in, size_turn, size_force, total, share, off)
        do l = 1, lanes
            ! Sizes by moment and deflection of the node: what they mean to the beam beside it
            stiff = c(l) + b(l)**2/a(l)
            moment = b(l)**2*q22(l) - 2*b(l)*c(l)*q12(l) + c(l)**2*q11(l)
            deflection = b(l)**2*q11(l) + 2*a(l)*b(l)*q12(l) + a(l)**2*q22(l)
            size_in = r(l)*sqrt(abs(a(l)*moment + free(l)*stiff*deflection))
            size_turn = r(l)*turn(l)*sqrt(a(l)*c(l)**2 + stiff*free(l)*b(l)**2)
            off = free(l)*force(l)
            size_force = r(l)*off*sqrt(a(l)*b(l)**2 + stiff*a(l)**2)
            total = size_in + size_turn + size_force
            share = total/(size_in + merge(0.0_wp, 1.0_wp, size_in > 0.0_wp))
            q12(l) = q12(l)*share
            q11(l) = q11(l)*share + total*turn(l)**2/(size_turn + merge(0.0_wp, 1.0_wp, size_turn > 0.0_wp))
            q22(l) = q22(l)*share + total*off**2/(size_force + merge(0.0_wp, 1.0_wp, size_force > 0.0_wp))
        end do
    end subroutine add_rows

end module gapbeam_lane_movements
