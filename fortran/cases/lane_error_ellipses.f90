!> Bounds of how far results of eight cases move when rows of their systems are off, by ellipses.
!> gapbeam_sensitivity estimates the same.
!>
!> What is off at a node is seen elsewhere through two numbers, the rotation and the force that one part of the beam passes on to
!> the next (gapbeam_kernel). All that the rows of a part may pass on together is a zonotope in the plane of these two; an ellipse
!> around it goes through the elimination in its place. The smallest ellipses around the sum of two, as far as their sizes by the
!> energy go, are those of Kurzhanski and Valyi (1997, 2.2). Where a result is looked at, one ellipse comes from either side, and
!> the bound is their reach in the direction of that result: never less than the largest sum of |K^-1| times what rows are off.
module gapbeam_lane_error_ellipses
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: unknown_movement
    use gapbeam_lane_types, only: lanes, lane_beam_type, &
        link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, link_bending, link_determinant
    implicit none
    private
    public :: find_movements, kinds_of_movement
    public :: of_deflection, of_moment, of_shear, of_rotation

    !> Results: deflections and moments of the nodes; shears of the links, and rotations at their left ends
    integer, parameter :: of_deflection = 1, of_moment = 2, of_shear = 3, of_rotation = 4
    !> Arrays for them and for what comes from the right: flexibilities as in gapbeam_kernel, whether nothing there carries, the
    !> ellipse with what the node adds
    integer, parameter :: kinds_of_movement = 11
    integer, parameter :: phi_right = 5, beta_right = 6, delta_right = 7, floats_right = 8, q11_right = 9, q12_right = 10, &
        q22_right = 11

    !> What the part of the beam up to a node passes on to it
    type :: part_type
        !> Its flexibilities; does it float (1), for nothing in it carries yet
        real(wp), dimension(lanes) :: phi = 0.0_wp, beta = 0.0_wp, delta = 0.0_wp, floats = 1.0_wp
        !> The ellipse: of rotation and force or, where it floats, of moment and force
        real(wp), dimension(lanes) :: q11 = 0.0_wp, q12 = 0.0_wp, q22 = 0.0_wp
    end type part_type

    !> A link as it is gone through
    type :: way_type
        real(wp) :: length, h, near, far, cross, sum_near, sum_far, bending, determinant
        !> Is there a hinge (1) at the node before it, or a restraint (1) and its compliance
        real(wp) :: hinge, restrained, compliance
    end type way_type

    !> How a node and the link behind it are eliminated
    type :: step_type
        !> Moment and deflection of the node by what comes to it, and by those of the next one
        real(wp), dimension(lanes) :: c11, c12, c21, c22, d11, d12, d21, d22
        !> What is passed on by what comes
        real(wp), dimension(lanes) :: a11, a12, a21, a22
        !> The ellipse with what the node adds; is it known by its neighbours only where it is (1)
        real(wp), dimension(lanes) :: q11, q12, q22, hangs
        !> What comes to the node, through its restraint
        real(wp), dimension(lanes) :: phi, beta, delta, floats
    end type step_type

contains

    !> Find the movements
    pure subroutine find_movements(beam, n, held, spring, left, turn, force, moves, lost)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Is the deflection known (1), and the stiffness of the node, shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring
        !> What compatibility left of restraints, compatibility elsewhere (0 at the ends without one and at hinges) and equilibrium
        !> may be off; where the deflection is known there is none
        real(wp), intent(in), dimension(lanes, 0:n) :: left, turn, force
        !> Movements, those of links with no entry at 0
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)
        !> Above 0: the beam is held by too little
        real(wp), intent(out) :: lost(lanes)

        lost(:) = 0.0_wp
        call come_from_right(beam, n, held, spring, left, turn, force, moves, lost)
        call go_to_right(beam, n, held, spring, left, turn, force, moves, lost)
    end subroutine find_movements

    !> What the parts right of each node pass on
    pure subroutine come_from_right(beam, n, held, spring, left, turn, force, moves, lost)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring, left, turn, force
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement), lost(lanes)
        type(part_type) :: part
        type(step_type) :: step
        type(way_type) :: way
        integer :: i

        do i = n, 1, -1
            associate (link => beam%links(1, :, i))
                way = way_type(beam%length(i), beam%inverse(i), link(link_fbb), link(link_faa), link(link_fab), link(link_sum_b), &
                               link(link_sum_a), link(link_bending), link(link_determinant), beam%hinge(i), 0.0_wp, 0.0_wp)
            end associate
            if (beam%restraint(i) == 0) then
                call eliminate(way, held(:, i), spring(:, i), left(:, i), turn(:, i), force(:, i), held(:, i - 1), part, step, lost)
            else
                way%restrained = 1.0_wp
                way%compliance = beam%compliance(beam%restraint(i))
                call eliminate(way, held(:, i), spring(:, i), turn(:, i), left(:, i), force(:, i), held(:, i - 1), part, step, lost)
            end if
            moves(:, i, phi_right) = step%phi
            moves(:, i, beta_right) = step%beta
            moves(:, i, delta_right) = step%delta
            moves(:, i, floats_right) = step%floats
            moves(:, i, q11_right) = step%q11
            moves(:, i, q12_right) = step%q12
            moves(:, i, q22_right) = step%q22
        end do
        moves(:, 0, beta_right) = part%beta
        moves(:, 0, delta_right) = part%delta
        moves(:, 0, q22_right) = part%q22
    end subroutine come_from_right

    !> The same from the left, and at every link what both make of its results
    pure subroutine go_to_right(beam, n, held, spring, left, turn, force, moves, lost)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring, left, turn, force
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement), lost(lanes)
        type(part_type) :: part
        type(step_type) :: step
        type(way_type) :: way
        real(wp) :: at_left(lanes), moment_left(lanes)
        integer :: k

        moves(:, 0, of_moment) = 0.0_wp
        do k = 1, n
            associate (link => beam%links(1, :, k))
                way = way_type(beam%length(k), beam%inverse(k), link(link_faa), link(link_fbb), link(link_fab), link(link_sum_a), &
                               link(link_sum_b), link(link_bending), link(link_determinant), beam%hinge(k - 1), 0.0_wp, 0.0_wp)
                if (beam%restraint(k - 1) > 0) then
                    way%restrained = 1.0_wp
                    way%compliance = beam%compliance(beam%restraint(k - 1))
                end if
                call eliminate(way, held(:, k - 1), spring(:, k - 1), left(:, k - 1), turn(:, k - 1), force(:, k - 1), held(:, k), &
                               part, step, lost)
                call find_results(beam%inverse(k), link(link_faa), link(link_fab), beam%hinge(k), n, k, held, spring, part, step, &
                                  moves, at_left, moment_left, lost)
            end associate
            ! The moment right of a restraint is another
            if (beam%restraint(k - 1) > 0) moves(:, k - 1, of_moment) = max(moves(:, k - 1, of_moment), moment_left)
            if (k > 1) cycle
            ! The first node, or its tip, which the rest of the beam holds
            moves(:, 0, of_deflection) = at_left
            where (step%hangs > 0.5_wp)
                moves(:, 0, of_deflection) = (force(:, 0) + sqrt(abs(moves(:, 0, q22_right)))) &
                    /(moves(:, 0, delta_right) + merge(0.0_wp, 1.0_wp, moves(:, 0, delta_right) > 0.0_wp))
            end where
        end do
    end subroutine go_to_right

    !> Eliminate a node and the link behind it
    pure subroutine eliminate(way, held, spring, before, turn, force, held_next, part, step, lost)
        type(way_type), intent(in) :: way
        !> At the node, `before` on the near side of its restraint; is the deflection of the next one known
        real(wp), intent(in), dimension(lanes) :: held, spring, before, turn, force, held_next
        !> What comes to the node in, what comes to the next one out
        type(part_type), intent(inout) :: part
        type(step_type), intent(out) :: step
        real(wp), intent(inout) :: lost(lanes)
        real(wp), dimension(lanes) :: a, b, c, free, r, turning, pushing
        real(wp) :: stiff, carries, starts, goes, soft, phi, beta, b_free, open, given, plain
        integer :: l

        plain = 1.0_wp - way%hinge
        turning(:) = turn
        pushing(:) = force
        if (way%restrained > 0.5_wp) call go_through_restraint(way%compliance, held, before, part, turning, pushing)
        step%phi = part%phi
        step%beta = part%beta
        step%delta = part%delta
        step%floats = part%floats
        !$omp simd private(given)
        do l = 1, lanes
            lost(l) = lost(l) + way%hinge*part%floats(l)
            ! The moment is known beforehand: of statics, or at a hinge
            given = merge(part%floats(l), 1.0_wp, plain > 0.5_wp)
            part%floats(l) = given
            part%q11(l) = part%q11(l)*plain
            part%q12(l) = part%q12(l)*plain
            ! Then sizes are by moments at the next node
            free(l) = merge(1.0_wp, 1.0_wp - held(l), given > 0.5_wp)
            a(l) = merge(way%length**2, part%phi(l) + way%near, given > 0.5_wp)
            b(l) = merge(0.0_wp, part%beta(l) + way%h, given > 0.5_wp)
            c(l) = merge(1.0_wp, (1.0_wp - held(l))*(part%delta(l) + spring(l)) + held(l), given > 0.5_wp)
            r(l) = 1/(a(l)*c(l) + free(l)*b(l)**2)
            turning(l) = turning(l)*(1.0_wp - given)
            pushing(l) = pushing(l)*(1.0_wp - held(l))
            step%q11(l) = part%q11(l)
            step%q12(l) = part%q12(l)
            step%q22(l) = part%q22(l)
        end do
        call add_rows(a, b, c, free, r, turning, pushing, step%q11, step%q12, step%q22)
        !$omp simd private(stiff, carries, starts, goes, soft, phi, beta, b_free, open, given)
        do l = 1, lanes
            open = 1.0_wp - held(l)
            given = part%floats(l)
            phi = part%phi(l)
            beta = part%beta(l)
            b_free = open*b(l)
            stiff = open*(part%delta(l) + spring(l)) + held(l)
            carries = merge(1.0_wp, 0.0_wp, stiff > 0.0_wp)
            soft = open/(stiff + (1.0_wp - carries))
            starts = given*carries
            goes = given - starts
            r(l) = (1.0_wp - given)*r(l)
            soft = soft*starts
            step%hangs(l) = goes
            step%c11(l) = given - c(l)*r(l)
            step%c12(l) = b(l)*r(l)
            step%c21(l) = b_free*r(l) - way%h*soft
            step%c22(l) = open*a(l)*r(l) + soft
            step%d11(l) = (b_free*way%h - c(l)*way%cross)*r(l)
            step%d12(l) = -c(l)*way%h*r(l)
            step%d21(l) = open*(b(l)*way%cross + a(l)*way%h)*r(l) + way%h*soft
            step%d22(l) = b_free*way%h*r(l)
            open = 1.0_wp - held_next(l)
            ! A part that floats passes on moment and force
            step%a11(l) = (1.0_wp - goes)*(way%h*step%c21(l) + way%cross*step%c11(l)) + goes
            step%a12(l) = (1.0_wp - goes)*(way%h*step%c22(l) + way%cross*step%c12(l)) - goes*way%length
            step%a21(l) = open*(1.0_wp - goes)*way%h*step%c11(l)
            step%a22(l) = open*((1.0_wp - goes)*way%h*step%c12(l) + goes)
            part%delta(l) = c(l)*way%h*way%h*r(l)
            part%phi(l) = ((1.0_wp - held(l))*((phi + way%bending)*way%h**2 + beta*(2*way%h*way%sum_far + beta*way%far)) &
                           + c(l)*(phi*way%far + way%determinant))*r(l) + starts*way%far + way%h**2*soft
            part%beta(l) = (c(l)*way%h*(phi + way%sum_near) + b_free*way%h*beta)*r(l) + starts*way%h
            part%floats(l) = goes
            part%q11(l) = step%a11(l)*(step%a11(l)*step%q11(l) + 2*step%a12(l)*step%q12(l)) + step%a12(l)**2*step%q22(l)
            part%q12(l) = step%a11(l)*(step%a21(l)*step%q11(l) + step%a22(l)*step%q12(l)) &
                + step%a12(l)*(step%a21(l)*step%q12(l) + step%a22(l)*step%q22(l))
            part%q22(l) = step%a21(l)*(step%a21(l)*step%q11(l) + 2*step%a22(l)*step%q12(l)) + step%a22(l)**2*step%q22(l)
        end do
    end subroutine eliminate

    !> What comes to a node with a restraint, on the other side of that: there the rotation is the restraint's
    pure subroutine go_through_restraint(compliance, held, before, part, turn, force)
        real(wp), intent(in) :: compliance
        !> Is the deflection known; what compatibility on the near side is off
        real(wp), intent(in), dimension(lanes) :: held, before
        type(part_type), intent(inout) :: part
        !> What the rows of the node are off, raised
        real(wp), intent(inout), dimension(lanes) :: turn, force
        real(wp) :: share, t11, t21
        integer :: l

        do l = 1, lanes
            share = (1.0_wp - part%floats(l))/(compliance + part%phi(l) + part%floats(l))
            ! A part that floats turns the restraint by its moment
            t11 = compliance*(share - part%floats(l))
            t21 = (1.0_wp - held(l))*part%beta(l)*share
            turn(l) = turn(l) + compliance*share*before(l)
            force(l) = force(l) + t21*before(l)
            part%q22(l) = part%q22(l) + t21*(2*part%q12(l) + t21*part%q11(l))
            part%q12(l) = t11*(part%q12(l) + t21*part%q11(l))
            part%q11(l) = t11**2*part%q11(l)
            part%delta(l) = part%delta(l) + part%beta(l)**2*share
            part%beta(l) = part%beta(l)*compliance*share
            part%phi(l) = compliance*(part%phi(l)*share + part%floats(l))
            part%floats(l) = 0.0_wp
        end do
    end subroutine go_through_restraint

    !> Results of link k and the node right of it; deflection of the node left of it, and moment at the left end of the link
    pure subroutine find_results(h, faa, fab, hinge, n, k, held, spring, part, step, moves, at_left, moment_left, lost)
        !> Of the link; is there a hinge at the node right of it
        real(wp), intent(in) :: h, faa, fab, hinge
        integer, intent(in) :: n, k
        real(wp), intent(in), dimension(lanes, 0:n) :: held, spring
        !> What comes to that node, and how
        type(part_type), intent(in) :: part
        type(step_type), intent(in) :: step
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)
        real(wp), intent(out) :: at_left(lanes), moment_left(lanes)
        real(wp), intent(inout) :: lost(lanes)
        real(wp) :: open, by_left, by_right, both, none, a, b, c, r, soft, q11, q12, q22, s11, s12, s22
        real(wp) :: l11, l12, l21, l22, r11, r12, r21, r22, m1, m2, w1, w2, n1, n2, n3, n4, u1, u2, u3, u4
        integer :: l

        !$omp simd private(open, by_left, by_right, both, none, a, b, c, r, soft, q11, q12, q22, s11, s12, s22, l11, l12, l21, &
        !$omp   l22, r11, r12, r21, r22, m1, m2, w1, w2, n1, n2, n3, n4, u1, u2, u3, u4)
        do l = 1, lanes
            open = 1.0_wp - held(l, k)
            ! Where both parts meet: the moment may be that of the one that floats, or none
            by_left = (1.0_wp - hinge)*part%floats(l)
            by_right = (1.0_wp - hinge)*moves(l, k, floats_right)
            lost(l) = lost(l) + part%floats(l)*moves(l, k, floats_right)
            both = (1.0_wp - hinge)*(1.0_wp - by_left)*(1.0_wp - by_right)
            none = 1.0_wp - both
            a = part%phi(l) + moves(l, k, phi_right) + none
            b = part%beta(l) + moves(l, k, beta_right)
            c = open*(part%delta(l) + moves(l, k, delta_right) + spring(l, k)) + held(l, k)
            r = both*a*c + both*open*b**2
            r = both/(r + merge(0.0_wp, 1.0_wp, r > 0.0_wp))
            soft = none*open/(c + merge(0.0_wp, 1.0_wp, c > 0.0_wp))
            l11 = by_left - c*r
            l12 = b*r
            l21 = open*b*r - soft*by_left*moves(l, k, beta_right)
            l22 = open*a*r + soft
            r11 = by_right - c*r
            r12 = b*r
            r21 = open*b*r - soft*by_right*part%beta(l)
            r22 = l22
            q11 = step%q11(l)
            q12 = step%q12(l)
            q22 = step%q22(l)
            s11 = moves(l, k, q11_right)
            s12 = moves(l, k, q12_right)
            s22 = moves(l, k, q22_right)
            ! Results by what comes from the left (1, 2) and from the right (3, 4), rotation or moment, and force
            m1 = l11*step%a11(l) + l12*step%a21(l)
            m2 = l11*step%a12(l) + l12*step%a22(l)
            w1 = l21*step%a11(l) + l22*step%a21(l)
            w2 = l21*step%a12(l) + l22*step%a22(l)
            n1 = step%c11(l) + (step%d11(l)*m1 + step%d12(l)*w1)
            n2 = step%c12(l) + (step%d11(l)*m2 + step%d12(l)*w2)
            n3 = step%d11(l)*r11 + step%d12(l)*r21
            n4 = step%d11(l)*r12 + step%d12(l)*r22
            u1 = step%c21(l) + (step%d21(l)*m1 + step%d22(l)*w1)
            u2 = step%c22(l) + (step%d21(l)*m2 + step%d22(l)*w2)
            u3 = step%d21(l)*r11 + step%d22(l)*r21
            u4 = step%d21(l)*r12 + step%d22(l)*r22
            moves(l, k, of_moment) = reach(m1, m2, q11, q12, q22) + reach(r11, r12, s11, s12, s22)
            moves(l, k, of_deflection) = reach(w1, w2, q11, q12, q22) + reach(r21, r22, s11, s12, s22)
            moves(l, k, of_shear) = h*(reach(m1 - n1, m2 - n2, q11, q12, q22) + reach(r11 - n3, r12 - n4, s11, s12, s22))
            moves(l, k, of_rotation) = unknown_movement*step%hangs(l) &
                + reach(h*(w1 - u1) + (faa*n1 + fab*m1), h*(w2 - u2) + (faa*n2 + fab*m2), q11, q12, q22) &
                + reach(h*(r21 - u3) + (faa*n3 + fab*r11), h*(r22 - u4) + (faa*n4 + fab*r12), s11, s12, s22)
            at_left(l) = reach(u1, u2, q11, q12, q22) + reach(u3, u4, s11, s12, s22)
            moment_left(l) = reach(n1, n2, q11, q12, q22) + reach(n3, n4, s11, s12, s22)
        end do
    end subroutine find_results

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

end module gapbeam_lane_error_ellipses
