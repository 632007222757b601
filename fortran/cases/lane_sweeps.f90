!> Systems of eight cases solved side by side by sweeps from end to end.
!> That is the arithmetic of gapbeam_three_moment and gapbeam_band, number by number: the bits are theirs. Branches are masks here,
!> and what a mask strikes out is kept finite.
module gapbeam_lane_sweeps
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, link_numbers, link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, &
        link_bending, link_determinant
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: sweep_three_moments, sweep_chain

contains

    !> Three-moment equations of gapbeam_three_moment: all deflections known but those of free tips
    pure subroutine sweep_three_moments(beam, links, n, left, right, shear, couple, held, known, room, w, ml, mr)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides, shape (lanes, 0:n)
        real(wp), intent(in) :: left(lanes, 0:n), right(lanes, 0:n), shear(lanes, 0:n), couple(lanes, 0:n)
        !> Is the deflection known, and which is it
        real(wp), intent(in) :: held(lanes, 0:n), known(lanes, 0:n)
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Deflections, moments left and right of the nodes
        real(wp), intent(inout) :: w(lanes, 0:n), ml(lanes, 0:n), mr(lanes, 0:n)
        real(wp), dimension(lanes) :: phi, e
        real(wp) :: faa, fab, fbb, determinant, chord, a, y, z, psi, tip, root, first, flexible, begin, free, c
        integer :: l, i

        w(:, :) = known
        ! Is the moment known at the left end; if not, the restraint is what lies outside
        free = 1.0_wp
        c = 0.0_wp
        if (beam%restraint(0) > 0) then
            free = 0.0_wp
            c = beam%compliance(beam%restraint(0))
        end if
        ! Moments that are known beforehand: pinned ends, and roots of overhangs by statics
        !$omp simd private(root)
        do l = 1, lanes
            ml(l, 0) = 0.0_wp
            ml(l, 1) = couple(l, 0) - shear(l, 0)*beam%length(1)
            mr(l, n) = 0.0_wp
            ml(l, n) = -couple(l, n)
            root = ml(l, n) - shear(l, n)*beam%length(n)
            room(l, 0, 3) = root
            phi(l) = c
            e(l) = 0.0_wp
        end do
        do i = 0, n - 1
            !$omp simd private(faa, fab, fbb, determinant, chord, a, y, z, first, flexible, begin)
            do l = 1, lanes
                faa = links(min(l, stiffness_lanes), link_faa, i + 1)
                fab = links(min(l, stiffness_lanes), link_fab, i + 1)
                fbb = links(min(l, stiffness_lanes), link_fbb, i + 1)
                determinant = links(min(l, stiffness_lanes), link_determinant, i + 1)
                ! Does the row of the first support stand here: with a tip at node 1
                first = merge(free, 0.0_wp, i == 0)
                if (i == 1) first = 1.0_wp - held(l, 0)
                begin = merge(ml(l, i), 0.0_wp, i < 2)
                chord = (known(l, i + 1) - known(l, i))*beam%inverse(i + 1)
                a = phi(l) + faa
                y = (phi(l)*couple(l, i) - e(l) - chord - right(l, i))/a
                z = fab/a
                flexible = (fbb*phi(l) + determinant)/a
                y = merge(begin + couple(l, i), y, first > 0.5_wp)
                z = merge(0.0_wp, z, first > 0.5_wp)
                phi(l) = merge(fbb, flexible, first > 0.5_wp)
                room(l, i, 1) = y
                room(l, i, 2) = z
                e(l) = fab*y - chord + left(l, i + 1)
            end do
        end do
        if (beam%restraint(n) > 0) then
            c = beam%compliance(beam%restraint(n))
            ml(:, n) = -(e + c*couple(:, n))/(phi + c)
        end if
        do i = n - 1, 0, -1
            !$omp simd private(y, z, tip, root)
            do l = 1, lanes
                y = room(l, i, 1) - room(l, i, 2)*ml(l, i + 1)
                ! The root of a tip on the right
                tip = merge(1.0_wp - held(l, n), 0.0_wp, i == n - 1)
                root = room(l, 0, 3)
                y = merge(root, y, tip > 0.5_wp)
                mr(l, i) = y
                ! The moments at the first support are known
                z = y - couple(l, i)
                tip = merge(1.0_wp, 0.0_wp, i == 0)
                if (i == 1) tip = 1.0_wp - held(l, 0)
                root = ml(l, min(i, 1))
                ml(l, i) = merge(root, z, tip > 0.5_wp)
            end do
        end do
        !$omp simd private(faa, fab, fbb, psi, tip, root, y)
        do l = 1, lanes
            tip = 1.0_wp - held(l, 0)
            root = mr(l, 0)
            y = couple(l, 0)
            mr(l, 0) = merge(y, root, tip > 0.5_wp)
            faa = links(min(l, stiffness_lanes), link_faa, 2)
            fab = links(min(l, stiffness_lanes), link_fab, 2)
            psi = (w(l, 2) - w(l, 1))/beam%length(2) + faa*mr(l, 1) + fab*ml(l, 2) + right(l, 1)
            root = w(l, 0)
            fab = links(min(l, stiffness_lanes), link_fab, 1)
            fbb = links(min(l, stiffness_lanes), link_fbb, 1)
            y = w(l, 1) - beam%length(1)*(psi + left(l, 1) + fab*mr(l, 0) + fbb*ml(l, 1))
            w(l, 0) = merge(y, root, tip > 0.5_wp)
        end do
        !$omp simd private(faa, fab, fbb, psi, tip, root, y)
        do l = 1, lanes
            tip = 1.0_wp - held(l, n)
            fab = links(min(l, stiffness_lanes), link_fab, n - 1)
            fbb = links(min(l, stiffness_lanes), link_fbb, n - 1)
            psi = (w(l, n - 1) - w(l, n - 2))/beam%length(n - 1) - fab*mr(l, n - 2) - fbb*ml(l, n - 1) - left(l, n - 1)
            root = w(l, n)
            faa = links(min(l, stiffness_lanes), link_faa, n)
            fab = links(min(l, stiffness_lanes), link_fab, n)
            y = w(l, n - 1) + beam%length(n)*(psi - right(l, n - 1) - faa*mr(l, n - 1) - fab*ml(l, n))
            w(l, n) = merge(y, root, tip > 0.5_wp)
        end do
    end subroutine sweep_three_moments

    !> The chain of gapbeam_band, from the left
    pure subroutine sweep_chain(beam, links, n, left, right, shear, couple, held, known, spring, room, turning, w, ml, mr, moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides, shape (lanes, 0:n)
        real(wp), intent(in) :: left(lanes, 0:n), right(lanes, 0:n), shear(lanes, 0:n), couple(lanes, 0:n)
        !> Is the deflection known, which is it, stiffness
        real(wp), intent(in) :: held(lanes, 0:n), known(lanes, 0:n), spring(lanes, 0:n)
        real(wp), intent(inout) :: room(lanes, 0:n, 10), turning(lanes, size(beam%restrained), 5)
        !> Deflections, moments left and right of the nodes
        real(wp), intent(inout) :: w(lanes, 0:n), ml(lanes, 0:n), mr(lanes, 0:n)
        !> 1 for mechanisms, whose numbers mean nothing
        real(wp), intent(out) :: moves(lanes)
        real(wp), dimension(lanes) :: phi, beta, delta, e, p, m, floating, psi, turns
        real(wp) :: h, faa, fab, fbb, sum_a, sum_b, bending, determinant, length, hinge, free
        real(wp) :: a, b, c, d, r, g, k, given, rigid, starts, rests, denominator, reciprocal, m_star, w_star, new_e, new_p, &
            new_phi, new_beta, new_delta, moment, deflection, next_m, next_w, y
        integer :: l, i

        phi(:) = 0.0_wp
        beta(:) = 0.0_wp
        delta(:) = 0.0_wp
        e(:) = 0.0_wp
        p(:) = 0.0_wp
        m(:) = 0.0_wp
        floating(:) = 1.0_wp
        turns(:) = 0.0_wp
        do i = 0, n - 1
            free = 1.0_wp
            if (beam%restraint(i) > 0) then
                ! It takes what comes from the left, and the couple
                call pass_restraint(beam%compliance(beam%restraint(i)), left(:, i), couple(:, i), phi, beta, delta, e, p, m, &
                                    floating, turning(:, beam%restraint(i), :))
                free = 0.0_wp
            end if
            hinge = beam%hinge(i)
            h = beam%inverse(i + 1)
            length = beam%length(i + 1)
            !$omp simd private(faa, fab, fbb, sum_a, sum_b, bending, determinant, a, b, c, d, r, g, k, rigid, starts, rests, &
            !$omp   denominator, reciprocal, m_star, w_star, new_e, new_p, given, new_phi, new_beta, new_delta, moment, deflection)
            do l = 1, lanes
                faa = links(min(l, stiffness_lanes), link_faa, i + 1)
                fab = links(min(l, stiffness_lanes), link_fab, i + 1)
                fbb = links(min(l, stiffness_lanes), link_fbb, i + 1)
                sum_a = links(min(l, stiffness_lanes), link_sum_a, i + 1)
                sum_b = links(min(l, stiffness_lanes), link_sum_b, i + 1)
                bending = links(min(l, stiffness_lanes), link_bending, i + 1)
                determinant = links(min(l, stiffness_lanes), link_determinant, i + 1)
                k = free*couple(l, i)
                r = right(l, i)
                g = shear(l, i) + p(l)
                d = known(l, i)
                rigid = held(l, i)
                room(l, i, 7) = floating(l)
                ! Across the node
                ml(l, i) = m(l)
                new_e = (e(l) + free*left(l, i)) - phi(l)*k
                new_p = beta(l)*k
                g = merge(g, shear(l, i) + (p(l) + new_p), floating(l) > 0.5_wp)
                r = merge(r, r + new_e, floating(l) > 0.5_wp)
                moment = merge(0.0_wp, m(l) + k, hinge > 0.5_wp)
                ! A hinge beside what nothing carries turns; else the moment is known there
                turns(l) = turns(l) + hinge*floating(l)
                given = merge(1.0_wp, floating(l), hinge > 0.5_wp)
                a = phi(l) + faa
                b = beta(l) + h
                c = delta(l) + spring(l, i)
                rests = merge(1.0_wp, rigid, c > 0.0_wp)
                starts = given*rests
                ! By which the node is eliminated: held, floating or neither
                denominator = merge(c, a*c + b**2, given > 0.5_wp)
                denominator = merge(a, denominator, rigid*(1.0_wp - given) > 0.5_wp)
                ! Not by merge, for compilers divide before they choose
                denominator = denominator + merge(0.0_wp, 1.0_wp, denominator > 0.0_wp)
                reciprocal = 1/denominator
                ! Neither
                m_star = (b*g - c*r)*reciprocal
                w_star = (b*r + a*g)*reciprocal
                new_delta = c*h**2*reciprocal
                new_beta = h*(c*(phi(l) + sum_a) + b*beta(l))*reciprocal
                new_phi = ((phi(l) + bending)*h**2 + beta(l)*(2*h*sum_b + beta(l)*fbb) &
                           + c*(phi(l)*fbb + determinant))*reciprocal
                ! Held
                m_star = merge((b*d - r)*reciprocal, m_star, rigid > 0.5_wp)
                w_star = merge(d, w_star, rigid > 0.5_wp)
                new_delta = merge(h**2*reciprocal, new_delta, rigid > 0.5_wp)
                new_beta = merge(h*(phi(l) + sum_a)*reciprocal, new_beta, rigid > 0.5_wp)
                new_phi = merge((fbb*phi(l) + determinant)*reciprocal, new_phi, rigid > 0.5_wp)
                new_e = h*w_star + fab*m_star
                new_p = h*m_star
                ! Floating
                deflection = merge(fab*moment + h*d, fab*moment + h*(g - h*moment)*reciprocal, rigid > 0.5_wp)
                new_e = merge(deflection, new_e, given > 0.5_wp)
                new_p = merge(h*moment, new_p, given > 0.5_wp)
                deflection = merge(fbb, fbb + h**2*reciprocal, rigid > 0.5_wp)
                new_phi = merge(deflection, new_phi, given > 0.5_wp)
                new_beta = merge(h, new_beta, given > 0.5_wp)
                new_delta = merge(0.0_wp, new_delta, given > 0.5_wp)
                ! And nothing carries yet
                rests = given - starts
                m(l) = moment - g*length
                p(l) = merge(g, new_p, rests > 0.5_wp)
                e(l) = merge(e(l), new_e, rests > 0.5_wp)
                phi(l) = merge(0.0_wp, new_phi, rests > 0.5_wp)
                beta(l) = merge(0.0_wp, new_beta, rests > 0.5_wp)
                delta(l) = new_delta
                room(l, i, 1) = a
                room(l, i, 2) = b
                room(l, i, 3) = c
                room(l, i, 4) = reciprocal
                room(l, i, 5) = r
                room(l, i, 6) = g
                room(l, i, 8) = rests
                room(l, i, 9) = moment
                room(l, i, 10) = given
                floating(l) = rests
            end do
        end do
        free = 1.0_wp
        if (beam%restraint(n) > 0) then
            call pass_restraint(beam%compliance(beam%restraint(n)), left(:, n), couple(:, n), phi, beta, delta, e, p, m, floating, &
                                turning(:, beam%restraint(n), :))
            free = 0.0_wp
        end if
        !$omp simd private(k, g, c, rests, deflection, denominator, d)
        do l = 1, lanes
            k = free*couple(l, n)
            d = known(l, n)
            g = shear(l, n) + (p(l) + beta(l)*k)
            c = delta(l) + spring(l, n)
            rests = merge(1.0_wp, held(l, n), c > 0.0_wp)
            moves(l) = 1.0_wp - rests*(1.0_wp - floating(l))*merge(0.0_wp, 1.0_wp, turns(l) > 0.5_wp)
            denominator = c + merge(0.0_wp, 1.0_wp, c > 0.0_wp)
            deflection = g*(1/denominator)
            w(l, n) = merge(d, deflection, held(l, n) > 0.5_wp)
            ml(l, n) = 0.0_wp - k
            mr(l, n) = 0.0_wp
            psi(l) = 0.0_wp
        end do
        if (beam%restraint(n) > 0) call return_to_left(beam%compliance(beam%restraint(n)), couple(:, n), mr(:, n), w(:, n), &
                                                       turning(:, beam%restraint(n), :), psi, ml(:, n))
        do i = n - 1, 0, -1
            h = beam%inverse(i + 1)
            length = beam%length(i + 1)
            !$omp simd private(faa, fab, fbb, a, b, c, d, r, g, reciprocal, rigid, moment, deflection, next_m, next_w, y, k)
            do l = 1, lanes
                faa = links(min(l, stiffness_lanes), link_faa, i + 1)
                fab = links(min(l, stiffness_lanes), link_fab, i + 1)
                fbb = links(min(l, stiffness_lanes), link_fbb, i + 1)
                a = room(l, i, 1)
                b = room(l, i, 2)
                c = room(l, i, 3)
                reciprocal = room(l, i, 4)
                r = room(l, i, 5)
                g = room(l, i, 6)
                d = known(l, i)
                rigid = held(l, i)
                next_m = ml(l, i + 1)
                next_w = w(l, i + 1)
                y = ml(l, i)
                moment = (b*g - c*r + (b*h - c*fab)*next_m - c*h*next_w)*reciprocal
                deflection = (b*r + a*g + (b*fab + a*h)*next_m + b*h*next_w)*reciprocal
                moment = merge((b*d - r - fab*next_m - h*next_w)*reciprocal, moment, rigid > 0.5_wp)
                k = room(l, i, 9)
                moment = merge(k, moment, room(l, i, 10) > 0.5_wp)
                deflection = merge((g + h*(next_m - moment))*reciprocal, deflection, room(l, i, 10) > 0.5_wp)
                deflection = merge(next_w - length*(fab*moment + fbb*next_m + psi(l)), deflection, room(l, i, 8) > 0.5_wp)
                deflection = merge(d, deflection, rigid > 0.5_wp)
                psi(l) = h*(next_w - deflection) + faa*moment + fab*next_m
                psi(l) = psi(l) + right(l, i) + left(l, i)
                ml(l, i) = merge(y, moment - couple(l, i), room(l, i, 7) > 0.5_wp)
                ml(l, i) = merge(0.0_wp, ml(l, i), beam%hinge(i) > 0.5_wp)
                mr(l, i) = moment
                w(l, i) = deflection
            end do
            if (beam%restraint(i) > 0) call return_to_left(beam%compliance(beam%restraint(i)), couple(:, i), mr(:, i), w(:, i), &
                                                           turning(:, beam%restraint(i), :), psi, ml(:, i))
        end do
    end subroutine sweep_chain

    !> From the left of a restraint to its right: what is left is no statics any more
    pure subroutine pass_restraint(c, left, couple, phi, beta, delta, e, p, m, floating, kept)
        !> Its compliance
        real(wp), intent(in) :: c
        !> Right-hand sides at the node
        real(wp), intent(in), dimension(lanes) :: left, couple
        !> What the left side passes on
        real(wp), intent(inout), dimension(lanes) :: phi, beta, delta, e, p, m, floating
        !> For return_to_left
        real(wp), intent(out) :: kept(lanes, 5)
        real(wp) :: divisor, before, turned
        integer :: l

        do l = 1, lanes
            before = floating(l)
            turned = e(l)*(1.0_wp - before) + left(l)
            kept(l, 1) = before
            kept(l, 2) = phi(l)
            kept(l, 3) = beta(l)
            kept(l, 4) = turned
            kept(l, 5) = m(l)
            divisor = phi(l) + c
            divisor = divisor + merge(0.0_wp, 1.0_wp, divisor > 0.0_wp)
            p(l) = p(l) + (1.0_wp - before)*(beta(l)*(turned + c*couple(l))*(1/divisor))
            e(l) = merge(-c*(m(l) + couple(l)), c*(turned - phi(l)*couple(l))*(1/divisor), before > 0.5_wp)
            delta(l) = delta(l) + (1.0_wp - before)*(beta(l)**2/divisor)
            beta(l) = c*beta(l)/divisor
            phi(l) = merge(c, c*phi(l)/divisor, before > 0.5_wp)
            floating(l) = 0.0_wp
        end do
    end subroutine pass_restraint

    !> The moment left of a restraint, and where that is known by statics the rotation
    pure subroutine return_to_left(c, couple, moment, deflection, kept, psi, left)
        !> As for pass_restraint
        real(wp), intent(in) :: c
        !> Couple, moment right of it, deflection
        real(wp), intent(in), dimension(lanes) :: couple, moment, deflection
        real(wp), intent(in) :: kept(lanes, 5)
        !> Rotation left of it, if it matters
        real(wp), intent(inout) :: psi(lanes)
        !> Moment left of it
        real(wp), intent(out) :: left(lanes)
        real(wp) :: divisor
        integer :: l

        do l = 1, lanes
            divisor = kept(l, 2) + c
            divisor = divisor + merge(0.0_wp, 1.0_wp, divisor > 0.0_wp)
            left(l) = (kept(l, 3)*deflection(l) - kept(l, 4) + c*(moment(l) - couple(l)))/divisor
            left(l) = merge(kept(l, 5), left(l), kept(l, 1) > 0.5_wp)
            psi(l) = merge(c*((left(l) - moment(l)) + couple(l)) + kept(l, 4), psi(l), kept(l, 1) > 0.5_wp)
        end do
    end subroutine return_to_left

end module gapbeam_lane_sweeps
