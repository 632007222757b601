!> Two-sided elimination of the beams of eight cases that are held at both ends.
!> Each end has a support that acts or a restraint, and there are no couples and hinges; with the arithmetic of gapbeam_kernel,
!> number by number: the bits are its. The scheme is applied on the way inward, signs are looked at on the way back, and a
!> right-hand side can be solved for with the elimination of the pass before
module gapbeam_lane_two_sided_sweep
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, link_numbers, link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, &
        link_bending, link_determinant
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: pass_both_ends, find_wrong_between, correct_both_ends

contains

    !> Change supports, and solve the scheme
    pure subroutine pass_both_ends(beam, links, n, turn, shear, stiffness, rigid, contact, change, closed, room, w, m)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides and supports (pack_type), shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, shear, stiffness, rigid, contact
        !> 1 where a support is to be changed
        real(wp), intent(in) :: change(lanes, 0:n)
        !> Scheme: 1 closed
        real(wp), intent(inout) :: closed(lanes, 0:n)
        !> Elimination, for correct_both_ends too
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Deflections and moments
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp), dimension(lanes, 2) :: phi, beta, delta, e, p
        real(wp) :: acts, held, known, spring, force, free, a, b, c, r, v, reciprocal
        integer :: l, i, middle

        middle = n/2
        call go_inward(beam, links, n, 1, 0, middle - 1, 1, turn, shear, stiffness, rigid, contact, change, closed, room, &
                       phi(:, 1), beta(:, 1), delta(:, 1), e(:, 1), p(:, 1))
        call go_inward(beam, links, n, 2, n, middle + 1, -1, turn, shear, stiffness, rigid, contact, change, closed, room, &
                       phi(:, 2), beta(:, 2), delta(:, 2), e(:, 2), p(:, 2))
        i = middle
        !$omp simd private(acts, held, known, spring, force, free, a, b, c, r, v, reciprocal)
        do l = 1, lanes
            acts = abs(closed(l, i) - change(l, i))
            closed(l, i) = acts
            held = acts*rigid(l, i)
            known = held*contact(l, i)
            spring = acts*stiffness(l, i)
            force = shear(l, i) + spring*contact(l, i)
            free = 1.0_wp - held
            a = phi(l, 1) + phi(l, 2)
            b = beta(l, 1) + beta(l, 2)
            c = free*(delta(l, 1) + delta(l, 2)) + (spring*free + held)
            reciprocal = 1/(a*c + free*b**2)
            r = turn(l, i) + (e(l, 1) + e(l, 2))
            v = (force*free + known) + free*(p(l, 1) + p(l, 2))
            room(l, i, 7) = a
            room(l, i, 8) = b
            room(l, i, 9) = c
            room(l, i, 10) = reciprocal
            m(l, i) = (b*v - c*r)*reciprocal
            w(l, i) = (free*b*r + a*v)*reciprocal
        end do
        call go_back(n, middle, room, w, m)
    end subroutine pass_both_ends

    !> Inward from an end
    pure subroutine go_inward(beam, links, n, way, first, last, step, turn, shear, stiffness, rigid, contact, change, closed, &
                              room, phi, beta, delta, e, p)
        type(lane_beam_type), intent(in) :: beam
        !> Links; 1 from the left, 2 from the right; first and last node, step
        integer, intent(in) :: n, way, first, last, step
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> As for pass_both_ends
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, shear, stiffness, rigid, contact, change
        real(wp), intent(inout) :: closed(lanes, 0:n), room(lanes, 0:n, 10)
        !> What the nodes outside pass on
        real(wp), intent(out) :: phi(lanes), beta(lanes), delta(lanes), e(lanes), p(lanes)
        real(wp) :: h, near, far, cross, sum_near, sum_far, bending, determinant
        real(wp) :: acts, held, known, spring, force, free, stiff, v, softness, deflection, a, b, c, b_free, reciprocal, right, &
            moment, c_h, next, before
        real(wp) :: turns
        integer :: l, i, link, begin, at_near, at_far, at_sum_near, at_sum_far

        i = first
        begin = merge(first, first + step, beam%restraint(first) > 0)
        ! Where the end is restrained what is found for a free one means nothing, and stays finite
        turns = merge(1.0_wp, 0.0_wp, begin == first)
        link = merge(1, n, way == 1)
        h = beam%inverse(link)
        at_near = merge(link_faa, link_fbb, way == 1)
        at_far = merge(link_fbb, link_faa, way == 1)
        at_sum_near = merge(link_sum_a, link_sum_b, way == 1)
        at_sum_far = merge(link_sum_b, link_sum_a, way == 1)
        !$omp simd private(far, acts, held, known, spring, force, free, stiff, v, softness, deflection)
        do l = 1, lanes
            far = links(min(l, stiffness_lanes), at_far, link)
            acts = abs(closed(l, i) - change(l, i))
            closed(l, i) = acts
            held = acts*rigid(l, i)
            known = held*contact(l, i)
            spring = acts*stiffness(l, i)
            force = shear(l, i) + spring*contact(l, i)
            free = 1.0_wp - held
            stiff = (spring*free + held) + turns
            v = force*free + known
            softness = free/stiff
            deflection = v/stiff
            room(l, i, 1) = 0.0_wp
            room(l, i, 2) = 0.0_wp
            room(l, i, 3) = 0.0_wp
            room(l, i, 4) = deflection
            room(l, i, 5) = h*softness
            room(l, i, 6) = 0.0_wp
            room(l, i, 7) = stiff
            phi(l) = far + h**2*softness
            beta(l) = h
            delta(l) = 0.0_wp
            e(l) = h*deflection
            p(l) = 0.0_wp
        end do
        if (begin == first) then
            ! The restraint is what lies outside, and the node is one as those inside
            closed(:, first) = abs(closed(:, first) - change(:, first))
            phi(:) = beam%compliance(beam%restraint(first))
            beta(:) = 0.0_wp
            e(:) = 0.0_wp
        end if
        do i = begin, last, step
            link = merge(i + 1, i, way == 1)
            h = beam%inverse(link)
            !$omp simd private(near, far, cross, sum_near, sum_far, bending, determinant, acts, held, known, spring, force, free, &
            !$omp   a, b, c, b_free, reciprocal, right, v, c_h, next, deflection, moment, before)
            do l = 1, lanes
                near = links(min(l, stiffness_lanes), at_near, link)
                far = links(min(l, stiffness_lanes), at_far, link)
                cross = links(min(l, stiffness_lanes), link_fab, link)
                sum_near = links(min(l, stiffness_lanes), at_sum_near, link)
                sum_far = links(min(l, stiffness_lanes), at_sum_far, link)
                bending = links(min(l, stiffness_lanes), link_bending, link)
                determinant = links(min(l, stiffness_lanes), link_determinant, link)
                acts = abs(closed(l, i) - change(l, i))
                closed(l, i) = acts
                held = acts*rigid(l, i)
                known = held*contact(l, i)
                spring = acts*stiffness(l, i)
                force = shear(l, i) + spring*contact(l, i)
                free = 1.0_wp - held
                before = beta(l)
                a = phi(l) + near
                b = before + h
                c = free*delta(l) + (spring*free + held)
                b_free = free*b
                reciprocal = 1/(a*c + b_free*b)
                right = turn(l, i) + e(l)
                v = (force*free + known) + free*p(l)
                c_h = c*h
                moment = (b*v - c*right)*reciprocal
                deflection = (b_free*right + a*v)*reciprocal
                room(l, i, 1) = moment
                room(l, i, 2) = (b_free*h - c*cross)*reciprocal
                room(l, i, 3) = c_h*reciprocal
                room(l, i, 4) = deflection
                room(l, i, 5) = free*(b*cross + a*h)*reciprocal
                room(l, i, 6) = b_free*h*reciprocal
                room(l, i, 7) = a
                room(l, i, 8) = b
                room(l, i, 9) = c
                room(l, i, 10) = reciprocal
                next = (free*((phi(l) + bending)*(h*h) + before*(2*h*sum_far + before*far)) &
                        + c*(phi(l)*far + determinant))*reciprocal
                beta(l) = (c_h*(phi(l) + sum_near) + b_free*h*before)*reciprocal
                phi(l) = next
                delta(l) = c_h*h*reciprocal
                e(l) = h*deflection + cross*moment
                p(l) = h*moment
            end do
        end do
    end subroutine go_inward

    !> Back from the middle
    pure subroutine go_back(n, middle, room, w, m)
        integer, intent(in) :: n, middle
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        !> Those of the middle node in, all out
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp) :: moment, deflection
        integer :: l, i

        do i = middle - 1, 0, -1
            !$omp simd private(moment, deflection)
            do l = 1, lanes
                moment = m(l, i + 1)
                deflection = w(l, i + 1)
                m(l, i) = room(l, i, 1) + room(l, i, 2)*moment - room(l, i, 3)*deflection
                w(l, i) = room(l, i, 4) + room(l, i, 5)*moment + room(l, i, 6)*deflection
            end do
        end do
        do i = middle + 1, n
            !$omp simd private(moment, deflection)
            do l = 1, lanes
                moment = m(l, i - 1)
                deflection = w(l, i - 1)
                m(l, i) = room(l, i, 1) + room(l, i, 2)*moment - room(l, i, 3)*deflection
                w(l, i) = room(l, i, 4) + room(l, i, 5)*moment + room(l, i, 6)*deflection
            end do
        end do
    end subroutine go_back

    !> Which supports have the wrong state
    pure subroutine find_wrong_between(beam, n, alive, shear, stiffness, rigid, contact, closed, w, m, wrong, number)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Cases that are looked at
        real(wp), intent(in) :: alive(lanes)
        real(wp), intent(in), dimension(lanes, 0:n) :: shear, stiffness, rigid, contact, closed, w, m
        !> 1 where wrong
        real(wp), intent(out) :: wrong(lanes, 0:n)
        !> How many are
        real(wp), intent(out) :: number(lanes)
        real(wp) :: force, pressing, bad, held, acts, side, changes, h_left, h_right
        integer :: i, l, before, after

        number(:) = 0.0_wp
        h_left = 0.0_wp
        do i = 0, n
            side = beam%side(i)
            changes = beam%changes(i)
            before = max(i - 1, 0)
            after = min(i + 1, n)
            h_right = 0.0_wp
            if (i < n) h_right = beam%inverse(after)
            !$omp simd private(force, pressing, bad, held, acts)
            do l = 1, lanes
                acts = closed(l, i)
                held = acts*rigid(l, i)
                force = -side*(shear(l, i) - (m(l, i) - m(l, before))*h_left + (m(l, after) - m(l, i))*h_right)
                pressing = side*(w(l, i) - contact(l, i))
                bad = pressing - acts*(pressing + pressing*stiffness(l, i))
                bad = merge(force, bad, held > 0.5_wp)*changes*alive(l)
                bad = merge(1.0_wp, 0.0_wp, bad > 0.0_wp)
                wrong(l, i) = bad
                number(l) = number(l) + bad
            end do
            h_left = h_right
        end do
    end subroutine find_wrong_between

    !> Solve for another right-hand side after pass_both_ends
    pure subroutine correct_both_ends(beam, links, n, turn, force, held, known, room, w, m)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides, is the deflection known and which is it, shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, force, held, known
        !> As pass_both_ends left it
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Deflections and moments
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp), dimension(lanes, 2) :: e, p
        real(wp) :: right, v, a, b, c, free, reciprocal
        integer :: l, i, middle

        middle = n/2
        call put_inward(beam, links, n, 1, 0, middle - 1, 1, turn, force, held, known, room, e(:, 1), p(:, 1))
        call put_inward(beam, links, n, 2, n, middle + 1, -1, turn, force, held, known, room, e(:, 2), p(:, 2))
        i = middle
        !$omp simd private(right, v, a, b, c, free, reciprocal)
        do l = 1, lanes
            free = 1.0_wp - held(l, i)
            a = room(l, i, 7)
            b = room(l, i, 8)
            c = room(l, i, 9)
            reciprocal = room(l, i, 10)
            right = turn(l, i) + (e(l, 1) + e(l, 2))
            v = (force(l, i)*free + known(l, i)) + free*(p(l, 1) + p(l, 2))
            m(l, i) = (b*v - c*right)*reciprocal
            w(l, i) = (free*b*right + a*v)*reciprocal
        end do
        call go_back(n, middle, room, w, m)
    end subroutine correct_both_ends

    !> A right-hand side inward from an end
    pure subroutine put_inward(beam, links, n, way, first, last, step, turn, force, held, known, room, e, p)
        type(lane_beam_type), intent(in) :: beam
        !> As for go_inward
        integer, intent(in) :: n, way, first, last, step
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> As for correct_both_ends
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, force, held, known
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> What the nodes outside pass on
        real(wp), intent(out) :: e(lanes), p(lanes)
        real(wp) :: h, cross, free, right, v, a, b, c, reciprocal, moment, deflection
        integer :: l, i, link, begin

        i = first
        begin = merge(first, first + step, beam%restraint(first) > 0)
        h = beam%inverse(merge(1, n, way == 1))
        !$omp simd private(deflection)
        do l = 1, lanes
            deflection = (force(l, i)*(1.0_wp - held(l, i)) + known(l, i))/room(l, i, 7)
            room(l, i, 4) = deflection
            e(l) = h*deflection
            p(l) = 0.0_wp
        end do
        if (begin == first) e(:) = 0.0_wp
        do i = begin, last, step
            link = merge(i + 1, i, way == 1)
            h = beam%inverse(link)
            !$omp simd private(cross, free, right, v, a, b, c, reciprocal, moment, deflection)
            do l = 1, lanes
                cross = links(min(l, stiffness_lanes), link_fab, link)
                free = 1.0_wp - held(l, i)
                a = room(l, i, 7)
                b = room(l, i, 8)
                c = room(l, i, 9)
                reciprocal = room(l, i, 10)
                right = turn(l, i) + e(l)
                v = (force(l, i)*free + known(l, i)) + free*p(l)
                moment = (b*v - c*right)*reciprocal
                deflection = (free*b*right + a*v)*reciprocal
                room(l, i, 1) = moment
                room(l, i, 4) = deflection
                e(l) = h*deflection + cross*moment
                p(l) = h*moment
            end do
        end do
    end subroutine put_inward

end module gapbeam_lane_two_sided_sweep
