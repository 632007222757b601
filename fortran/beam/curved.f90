!> A stretch of beam on ground with a curved law: fields by power series, and its tangent link.
!>
!> From the fields at one place, v = w - M/GA, psi, M and V, the equations of gapbeam_foundation_taylor give their series, with
!> the force of the ground as a series of the displacement (gapbeam_law_series). The slope of that force along the stretch is a
!> modulus; with it the same equations tell what small changes at one end do at the other one. So the stretch is, to first
!> order, one on linear ground: multiple shooting, which converges quadratically. Where 1/beta is long beside the stretch, as the
!> caller cuts it, no digits are lost by that.
module gapbeam_curved
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_steps_on_curves
    use gapbeam_tolerances, only: largest_field, no_curve_slope, beginning_of_way, step_caution, shortest_step
    use gapbeam_foundation_stretch, only: softness_type, softness_in, softness_around, soften, tension_at
    use gapbeam_foundation_taylor, only: stretch_type, stretch_load_type, half_type, half_of_transfer, transfer_of_forces, &
        stretched_shear, transverse_of
    use gapbeam_foundation, only: stretch_link_type, link_of_halves
    use gapbeam_law_series, only: curve_type, law_series_type, order, begin_series, next_term, force_scale, slope_scale, &
        longest_step
    use gapbeam_curved_transfer, only: transfer_of, value_of, integral
    implicit none
    private
    public :: curved_type, order, expand_curved, advance_curved, condense_curved, curved_fields, cut_into_steps

    !> A stretch, its load, the layers of ground that act by curves, and the fields (v, psi, M, V) at its ends
    type :: curved_type
        !> With the modulus of the linear ground
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        type(curve_type), allocatable :: curves(:)
        real(wp) :: left(4) = 0.0_wp, right(4) = 0.0_wp
    end type curved_type

contains

    !> Series around a place
    pure subroutine expand_curved(curved, xi, y, way, c, modulus, forces, step)
        !> The stretch; its ends are not used
        type(curved_type), intent(in) :: curved
        !> The place, 0..1, and v, psi, M, V there
        real(wp), intent(in) :: xi, y(4)
        !> Unit of the series' variable t, in parts of the length, of either sign
        real(wp), intent(in) :: way
        !> Coefficients of v, psi, M, V, shape (4, 0:order)
        real(wp), intent(out) :: c(:, 0:)
        !> Of the modulus of all ground, and of the force of every layer that acts by a curve, against w for one from below and
        !> positive there, shape (0:order), (0:order, number of layers)
        real(wp), intent(out) :: modulus(0:), forces(0:, :)
        !> To which t, 1 at most, they hold to rounding
        real(wp), intent(out) :: step
        type(law_series_type) :: series(size(curved%curves))
        type(softness_type) :: softness
        real(wp) :: h, k(0:1), pull(0:1), q(0:order), pressure, w, axis(0:order)
        real(wp), dimension(1, 0:order) :: bent, slid, shifted
        integer :: i, n

        associate (s => curved%stretch, p => curved%load, eta => 1 - xi)
            h = s%length*way
            k = [s%modulus_a*eta + s%modulus_b*xi, (s%modulus_b - s%modulus_a)*way]
            q(3:) = 0.0_wp
            q(0:2) = [p%qa*eta + p%qb*xi + p%qc*xi*eta, (p%qb - p%qa + p%qc*(eta - xi))*way, -p%qc*way**2]
            softness = softness_around(s, xi, way)
            w = y(1) + softness%value(2)*y(3)
            pull = [tension_at(s, xi), s%tension_change*way]
            q(0:1) = q(0:1) + pull(0)*[p%kappa + xi*p%rise, way*p%rise]
            q(1:2) = q(1:2) + pull(1)*[p%kappa + xi*p%rise, way*p%rise]
            do i = 1, size(series)
                associate (curve => curved%curves(i))
                    call begin_series(curve, xi, way, is_negative(curve), series(i))
                end associate
            end do
            c(:, 0) = y
            modulus(0:order) = 0.0_wp
            modulus(0:1) = k
            do n = 0, order
                call soften(softness, n, c(3:3, n), bent, slid, shifted)
                axis(n) = c(1, n) + slid(1, n)
                pressure = k(0)*axis(n)
                if (n > 0) pressure = pressure + k(1)*axis(max(0, n - 1))
                do i = 1, size(series)
                    associate (curve => curved%curves(i), one => series(i))
                        one%u(n) = axis(n)
                        if (n == 0) one%u(0) = one%u(0) - (curve%contact_a*eta + curve%contact_b*xi)
                        if (n == 1) one%u(1) = one%u(1) - (curve%contact_b - curve%contact_a)*way
                        one%u(n) = curve%side*one%u(n)
                        call next_term(one, n)
                        pressure = pressure + curve%side*one%r(n)
                    end associate
                end do
                if (n == order) exit
                associate (part => h/(n + 1))
                    c(1, n + 1) = part*c(2, n)
                    if (s%power(2) > 0) c(1, n + 1) = c(1, n + 1) - shifted(1, n)/(n + 1)
                    c(2, n + 1) = -part*bent(1, n)
                    if (n == 0) c(2, 1) = c(2, 1) + part*(p%kappa + xi*p%rise)
                    if (n == 1) c(2, 2) = c(2, 2) + part*(way*p%rise)
                    c(3, n + 1) = part*c(4, n)
                    c(4, n + 1) = part*(pressure - q(n))
                    if (abs(pull(0)) > 0.0_wp) c(4, n + 1) = part*(pressure + pull(0)*bent(1, n) - q(n))/stretched_shear(s)
                    if (abs(pull(1)) > 0.0_wp) then
                        c(4, n + 1) = c(4, n + 1) - (pull(1)/(n + 1))*c(2, n)
                        if (n > 0) c(4, n + 1) = c(4, n + 1) + part*pull(1)*bent(1, max(0, n - 1))
                    end if
                end associate
            end do
            step = min(step_of(c(4, :), sum(abs(c(4, 0:3)))), step_on_taper(softness))
            do i = 1, size(series)
                if (sum(abs(series(i)%k(0:3))) > no_curve_slope*slope_scale(series(i))) then
                    modulus(0:order) = modulus(0:order) + series(i)%k
                end if
                forces(0:order, i) = series(i)%r
                step = min(step, step_of(series(i)%r, force_scale(series(i))), step_of(series(i)%k, slope_scale(series(i))), &
                           longest_step(series(i)))
            end do
        end associate

    contains

        !> Is the beam before the contact at the beginning of the way: where a zone begins rotation and curvature tell
        pure function is_negative(curve) result(negative)
            type(curve_type), intent(in) :: curve
            logical :: negative
            real(wp) :: there, ahead

            there = xi + beginning_of_way*way
            ahead = beginning_of_way*h
            associate (f => softness%value(1), g => softness%value(2))
                negative = curve%side*(w + (y(2) + g*y(4))*ahead + (curved%load%kappa + xi*curved%load%rise - f*y(3))*ahead**2/2 &
                                       - (curve%contact_a*(1 - there) + curve%contact_b*there)) < 0.0_wp
            end associate
        end function is_negative

    end subroutine expand_curved

    !> To which t, 1 at most, the series of 1/EI and 1/GA hold
    pure function step_on_taper(softness) result(step)
        type(softness_type), intent(in) :: softness
        real(wp) :: step
        real(wp), dimension(1, 0:order) :: bent, slid, shifted
        integer :: n

        step = 1.0_wp
        if (all(softness%power == 0)) return
        do n = 0, order
            call soften(softness, n, [merge(1.0_wp, 0.0_wp, n == 0)], bent, slid, shifted)
        end do
        step = min(step_of(bent(1, :), softness%value(1)), step_of(slid(1, :), softness%value(2)))
    end function step_on_taper

    !> To which t, 1 at most, a series of some size holds
    pure function step_of(c, scale) result(step)
        real(wp), intent(in) :: c(0:), scale
        real(wp) :: step
        integer :: n

        step = 1.0_wp
        do n = order - 1, order
            if (abs(c(n)) > epsilon(1.0_wp)*scale) then
                step = min(step, step_caution*(epsilon(1.0_wp)*(scale/abs(c(n))))**(1/real(n, wp)))
            end if
        end do
    end function step_of

    !> Fields at one place from those at another
    pure subroutine advance_curved(curved, xi, y, way, values, lost, motion, transfer, forces)
        !> As for expand_curved, but way as far as to the other place
        type(curved_type), intent(in) :: curved
        real(wp), intent(in) :: xi, y(4), way
        !> v, psi, M, V there
        real(wp), intent(out) :: values(4)
        !> The fields run away: what was given was too far from a solution
        logical, intent(out) :: lost
        !> The stretch as small changes of the fields feel it, maybe with another axial force and modulus, and how the fields change
        !> with those at the first place: both or none
        type(stretch_type), intent(in), optional :: motion
        real(wp), intent(out), optional :: transfer(4, 4)
        !> Force of every layer that acts by a curve in between, up where the layer pushes up
        real(wp), intent(out), optional :: forces(:)
        real(wp) :: c(4, 0:order), modulus(0:order), r(0:order, size(curved%curves)), step, at, left
        integer :: number, i

        values = y
        at = xi
        left = way
        if (present(transfer)) then
            transfer = 0.0_wp
            do i = 1, 4
                transfer(i, i) = 1.0_wp
            end do
        end if
        if (present(forces)) forces = 0.0_wp
        do number = 1, most_steps_on_curves
            lost = .not. all(abs(values) <= largest_field)
            if (lost) return
            call expand_curved(curved, at, values, left, c, modulus, r, step)
            lost = .not. step > shortest_step
            if (lost) return
            if (present(transfer)) then
                associate (more_a => motion%modulus_a - curved%stretch%modulus_a, &
                           more_b => motion%modulus_b - curved%stretch%modulus_b)
                    modulus(0:1) = modulus(0:1) + [more_a*(1 - at) + more_b*at, (more_b - more_a)*left]
                end associate
                transfer = matmul(transfer_of(motion, at, left, modulus, step), transfer)
            end if
            if (present(forces)) then
                do i = 1, size(forces)
                    forces(i) = forces(i) + curved%stretch%length*left*integral(r(:, i), step)
                end do
            end if
            do i = 1, 4
                values(i) = value_of(c(i, :), step)
            end do
            if (.not. step < 1.0_wp) return
            at = at + step*left
            left = (xi + way) - at
        end do
        lost = .true.
    end subroutine advance_curved

    !> The link of a stretch near fields that are given at its left end, with what they and the loads make at its ends
    pure subroutine condense_curved(curved, motion, link, turn_a, turn_b, shear_a, shear_b, lost)
        !> The stretch and the fields
        type(curved_type), intent(in) :: curved
        !> The stretch as small changes of the fields feel it
        type(stretch_type), intent(in) :: motion
        type(stretch_link_type), intent(out) :: link
        !> As for condense_loaded (gapbeam_foundation)
        real(wp), intent(out) :: turn_a, turn_b, shear_a, shear_b
        !> As for advance_curved; then nothing else is set
        logical, intent(out) :: lost
        type(half_type) :: a, b
        real(wp) :: transfer(4, 4), mirrored(4, 4), values(4), turn(0), shear(0), soft(2), soft_b(2)
        integer :: i

        turn_a = 0.0_wp
        turn_b = 0.0_wp
        shear_a = 0.0_wp
        shear_b = 0.0_wp
        call advance_curved(curved, 0.0_wp, curved%left, 1.0_wp, values, lost, motion, transfer)
        if (lost) return
        transfer = transfer_of_forces(motion, transfer)
        ! Seen from the other side x, psi and T change their signs
        soft(:) = softness_in(curved%stretch, 0.0_wp)
        soft_b(:) = softness_in(curved%stretch, 1.0_wp)
        mirrored = inverse(transfer, [soft(2), soft_b(2)])
        do i = 2, 4, 2
            mirrored(i, :) = -mirrored(i, :)
            mirrored(:, i) = -mirrored(:, i)
        end do
        call half_of_transfer(transfer, a, turn, shear)
        call half_of_transfer(mirrored, b, turn, shear)
        call link_of_halves([soft(2), soft_b(2)], a, b, link)
        ! What the link leaves over of the fields given, which so are met to all digits
        associate (w_a => curved%left(1) + soft(2)*curved%left(3), m_a => curved%left(3), &
                   w_b => values(1) + soft_b(2)*values(3), m_b => values(3))
            turn_a = curved%left(2) + link%pa*w_a - link%p1*w_b - link%faa*m_a - link%fab*m_b
            turn_b = link%pb*w_b - link%p2*w_a - link%fab*m_a - link%fbb*m_b - values(2)
            shear_a = transverse_of(curved%stretch, 0.0_wp, curved%left(2), curved%left(4)) &
                + link%pa*m_a - link%p2*m_b + link%gaa*w_a + link%gab*w_b
            shear_b = link%pb*m_b - link%p1*m_a + link%gbb*w_b + link%gab*w_a &
                - transverse_of(curved%stretch, 1.0_wp, values(2), values(4))
        end associate
    end subroutine condense_curved

    !> The inverse of a transfer: by Betti's theorem w T' - T w' - psi M' + M psi' of two changes is the same everywhere
    pure function inverse(transfer, shear_flexibility) result(back)
        !> At the first and the second place
        real(wp), intent(in) :: transfer(4, 4), shear_flexibility(2)
        real(wp) :: back(4, 4), of_w(4, 4)
        integer, parameter :: partner(4) = [4, 3, 2, 1]
        real(wp), parameter :: sign_of(4) = [1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]
        integer :: i, j

        ! From v to w = v + M/GA and back
        of_w = transfer
        of_w(1, :) = of_w(1, :) + shear_flexibility(2)*of_w(3, :)
        of_w(:, 3) = of_w(:, 3) - shear_flexibility(1)*of_w(:, 1)
        do j = 1, 4
            do i = 1, 4
                back(i, j) = sign_of(i)*sign_of(j)*of_w(partner(j), partner(i))
            end do
        end do
        back(1, :) = back(1, :) - shear_flexibility(1)*back(3, :)
        back(:, 3) = back(:, 3) + shear_flexibility(2)*back(:, 1)
    end function inverse

    !> Fields anywhere in a stretch, from its nearer end
    pure subroutine curved_fields(curved, xi, w, psi, moment, shear)
        type(curved_type), intent(in) :: curved
        !> The place, 0..1
        real(wp), intent(in) :: xi
        !> Deflection, rotation, moment, shear
        real(wp), intent(out) :: w, psi, moment, shear
        real(wp) :: y(4), soft(2)
        logical :: lost

        if (xi <= 0.5_wp) then
            call advance_curved(curved, 0.0_wp, curved%left, xi, y, lost)
        else
            call advance_curved(curved, 1.0_wp, curved%right, xi - 1, y, lost)
        end if
        soft(:) = softness_in(curved%stretch, xi)
        w = y(1) + soft(2)*y(3)
        psi = y(2)
        moment = y(3)
        shear = y(4)
    end subroutine curved_fields

    !> Cut a stretch so that series around the middle of every part hold in it: the steps from its ends to where they meet
    pure subroutine cut_into_steps(curved, places, middles)
        type(curved_type), intent(in) :: curved
        !> Where the parts begin and end, from 0 to 1, shape (0:number)
        real(wp), allocatable, intent(out) :: places(:)
        !> v, psi, M, V in their middles, shape (4, number)
        real(wp), allocatable, intent(out) :: middles(:, :)
        real(wp) :: ends(0:most_steps_on_curves, 2), inside(4, most_steps_on_curves, 2)
        integer :: number(2)

        call step_to_middle(0.0_wp, curved%left, number(1), ends(:, 1), inside(:, :, 1))
        call step_to_middle(1.0_wp, curved%right, number(2), ends(:, 2), inside(:, :, 2))
        allocate (places(0:sum(number)), middles(4, sum(number)))
        places(0:number(1)) = ends(0:number(1), 1)
        places(number(1):) = ends(number(2):0:-1, 2)
        middles(:, :number(1)) = inside(:, :number(1), 1)
        middles(:, number(1) + 1:) = inside(:, number(2):1:-1, 2)

    contains

        !> The steps from an end to the middle of the stretch
        pure subroutine step_to_middle(from, start, number, ends, inside)
            !> 0 or 1, and the fields there
            real(wp), intent(in) :: from, start(4)
            integer, intent(out) :: number
            real(wp), intent(out) :: ends(0:), inside(:, :)
            real(wp) :: y(4), c(4, 0:order), modulus(0:order), forces(0:order, size(curved%curves)), step, way
            integer :: i

            y = start
            ends(0) = from
            do number = 1, most_steps_on_curves
                way = 0.5_wp - ends(number - 1)
                call expand_curved(curved, ends(number - 1), y, way, c, modulus, forces, step)
                ! Fields that run away are nobody's: the rest is one part
                if (number == most_steps_on_curves .or. .not. (all(abs(y) <= largest_field) .and. step > shortest_step)) then
                    step = 1.0_wp
                end if
                do i = 1, 4
                    inside(i, number) = value_of(c(i, :), step/2)
                    y(i) = value_of(c(i, :), step)
                end do
                ends(number) = merge(ends(number - 1) + step*way, 0.5_wp, step < 1.0_wp)
                if (.not. step < 1.0_wp) return
            end do
        end subroutine step_to_middle

    end subroutine cut_into_steps

end module gapbeam_curved
