!> Fields inside a stretch of beam on elastic ground, from its load and end values.
!> Units and signs as in gapbeam_foundation.
module gapbeam_foundation_fields
    use gapbeam_kinds, only: wp
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_foundation_stretch, only: softness_in, without_slip
    use gapbeam_foundation_taylor, only: half_type, half_link, advance, mirrored, turned, is_sloped, stretched_shear, &
        trace_of, determinant_of, shear_of, transverse_of
    use gapbeam_foundation_series, only: triple_type, response_type, short_type, short_of, short_response, is_short
    use gapbeam_foundation_long, only: long_type, long_of, decay_type, long_response
    implicit none
    private
    public :: shared_type, shared_of, fields_at, moment_at, sloped_start, sloped_fields_from

    !> What fields anywhere in a stretch have in common, where nothing changes along it
    type :: shared_type
        private
        !> K L**2/GA + N L**2/EI and K L**4/EI
        real(wp) :: sigma, tau
        logical :: is_short = .false.
        type(short_type) :: short
        type(long_type) :: long
    end type shared_type

contains

    !> Make it
    pure function shared_of(stretch) result(shared)
        type(stretch_type), intent(in) :: stretch
        type(shared_type) :: shared

        shared%sigma = trace_of(stretch, stretch%modulus_a)*stretch%length**2
        shared%tau = determinant_of(stretch, stretch%modulus_a)*stretch%length**4
        shared%is_short = is_short(shared%sigma, shared%tau)
        if (shared%is_short) then
            shared%short = short_of(shared%sigma, shared%tau)
        else
            shared%long = long_of(shared%sigma, shared%tau)
        end if
    end function shared_of

    !> Fields anywhere in a stretch in equilibrium
    pure subroutine fields_at(stretch, load, ends, xi, w, psi, moment, shear, transverse, shared)
        !> The stretch, its load, deflections and moments of its ends
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> The place, 0..1
        real(wp), intent(in) :: xi
        !> Deflection, rotation, moment, shear
        real(wp), intent(out) :: w, psi, moment, shear
        !> Transverse force, without differences of what an axial force makes of rotations
        real(wp), intent(out), optional :: transverse
        !> Of the stretch, by shared_of, not where something changes along it; default: it is made here
        type(shared_type), intent(in), optional :: shared
        real(wp) :: start(4, 2), y(5)
        integer :: side

        if (is_sloped(stretch)) then
            ! From the nearer end
            side = merge(1, 2, xi <= 0.5_wp)
            start(:, side) = sloped_start(stretch, load, ends, side)
            call sloped_fields_from(stretch, load, start, xi, w, psi, moment, shear)
            if (present(transverse)) transverse = transverse_of(stretch, xi, psi, shear)
            return
        end if
        if (present(shared)) then
            y = constant_fields(stretch, load, ends, shared, xi, moment_alone=.false.)
        else
            y = constant_fields(stretch, load, ends, shared_of(stretch), xi, moment_alone=.false.)
        end if
        w = y(1)
        psi = y(2)
        moment = y(3)
        shear = y(4)
        if (present(transverse)) transverse = y(5)
    end subroutine fields_at

    !> The moment alone where nothing changes along the stretch
    pure function moment_at(stretch, load, ends, shared, xi) result(moment)
        !> As for fields_at
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        type(shared_type), intent(in) :: shared
        real(wp), intent(in) :: xi
        real(wp) :: moment, y(5)

        y = constant_fields(stretch, load, ends, shared, xi, moment_alone=.true.)
        moment = y(3)
    end function moment_at

    !> The same where nothing changes along the stretch
    pure function constant_fields(stretch, load, ends, shared, xi, moment_alone) result(y)
        !> As for fields_at
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        type(shared_type), intent(in) :: shared
        real(wp), intent(in) :: xi
        !> Is the moment all that is wanted; in short stretches the rest is left out then
        logical, intent(in) :: moment_alone
        !> Deflection, rotation, moment, shear, transverse force
        real(wp) :: y(5)
        type(response_type) :: r
        type(decay_type) :: decay
        type(stretch_ends_type) :: over
        real(wp) :: eta, l, f, k, raised, straight(2)

        l = stretch%length
        f = stretch%flexibility
        k = stretch%modulus_a
        eta = 1 - xi
        if (shared%is_short) then
            ! The chord, and the answer to the load that is left: the ground's under the chord taken off
            r = short_response(shared%short, xi, eta, with_slopes=.not. moment_alone, with_bubble=abs(load%qc) > 0.0_wp)
            associate (e => ends, c => load)
                y(1) = eta*e%w_a + xi*e%w_b
                y(3) = eta*e%moment_a + xi*e%moment_b
                y(4) = (e%moment_b - e%moment_a)/l
                y(2) = (e%w_b - e%w_a)/l - stretch%shear_flexibility*y(4)
                y(5) = y(4) + stretch%tension*((e%w_b - e%w_a)/l)
                call respond(stretch, r%even, r%even_slope, f*((e%moment_a + e%moment_b)/2) - (c%kappa + c%rise/2), &
                             (c%qa + c%qb)/2 - k*((e%w_a + e%w_b)/2), moment_alone, y)
                call respond(stretch, r%odd, r%odd_slope, f*((e%moment_b - e%moment_a)/2) - c%rise/2, &
                             (c%qb - c%qa)/2 - k*((e%w_b - e%w_a)/2), moment_alone, y)
                if (abs(c%qc) > 0.0_wp) call respond(stretch, r%bubble, r%bubble_slope, 0.0_wp, c%qc, moment_alone, y)
            end associate
        else
            call long_response(shared%long, xi, decay, r)
            over = ends
            y = 0.0_wp
            if (shared%long%apart) then
                call respond(stretch, r%even, r%even_slope, -(load%kappa + load%rise/2), (load%qa + load%qb)/2, .false., y)
                call respond(stretch, r%odd, r%odd_slope, -load%rise/2, (load%qb - load%qa)/2, .false., y)
                call respond(stretch, r%bubble, r%bubble_slope, 0.0_wp, load%qc, .false., y)
            else
                ! Far from the ends the ground bears the load where it stands, and what the tension makes of its curvature
                raised = -2*stretch%tension*load%qc/(k*l)**2
                y(1) = (load%qa*eta + load%qb*xi + load%qc*xi*eta)/k + raised
                y(2) = (load%qb - load%qa + load%qc*(eta - xi))/(k*l)
                straight(:) = ([load%kappa, load%kappa + load%rise] + 2*load%qc/(k*l**2))/f
                y(3) = eta*straight(1) + xi*straight(2)
                y(4) = load%rise/(f*l)
                y(5) = stretch%tension*y(2) + y(4)
                y(2) = y(2) - stretch%shear_flexibility*y(4)
                over%w_a = ends%w_a - load%qa/k - raised
                over%w_b = ends%w_b - load%qb/k - raised
                over%moment_a = ends%moment_a - straight(1)
                over%moment_b = ends%moment_b - straight(2)
            end if
            call fade(stretch, decay%left, decay%left_slope, over%w_a, over%moment_a, y)
            call fade(stretch, decay%right, decay%right_slope, over%w_b, over%moment_b, y)
        end if
    end function constant_fields

    !> Add the answer to a curvature and a load per length
    pure subroutine respond(stretch, value, slope, curvature, q, moment_alone, y)
        type(stretch_type), intent(in) :: stretch
        !> The answer and its slope
        type(triple_type), intent(in) :: value, slope
        real(wp), intent(in) :: curvature, q
        !> Is nothing else wanted
        logical, intent(in) :: moment_alone
        !> Deflection, rotation, moment, shear, transverse force
        real(wp), intent(inout) :: y(5)
        real(wp) :: bent, pressed, f, k, turned_by, borne

        associate (l => stretch%length, g => stretch%shear_flexibility, n => stretch%tension, s => stretched_shear(stretch))
            f = l**2*stretch%flexibility
            k = l**2*stretch%modulus_a
            bent = l**2*curvature/s
            pressed = l**2*q/s
            y(3) = y(3) + ((k*value%be - n*value%ga)*bent + value%ga*pressed)
            if (moment_alone) return
            y(1) = y(1) + (value%ga*bent + (g*value%ga - f*value%be)*pressed)
            y(4) = y(4) + ((k*slope%be - n*slope%ga)*bent + slope%ga*pressed)/l
            ! As s al + n f be = s ga - k g be: by the lesser of the two terms in be, which may be long
            ! where the rest decays
            if (abs(n*f) < k*g) then
                turned_by = s*slope%al + n*f*slope%be
                borne = s*slope%ga - n*f*slope%be
            else
                turned_by = s*slope%ga - k*g*slope%be
                borne = s*slope%al + k*g*slope%be
            end if
            y(2) = y(2) + (turned_by*bent - f*slope%be*pressed)/l
            y(5) = y(5) + (k*slope%be*bent + borne*pressed)/l
        end associate
    end subroutine respond

    !> Add what the deflection and moment of an end make. Rotations without shear go with w - M/GA
    pure subroutine fade(stretch, value, slope, w, moment, y)
        type(stretch_type), intent(in) :: stretch
        !> How they fade and the slope of it
        type(triple_type), intent(in) :: value, slope
        real(wp), intent(in) :: w, moment
        !> Deflection, rotation, moment, shear, transverse force
        real(wp), intent(inout) :: y(5)
        real(wp) :: f, k, pull

        associate (l => stretch%length, g => stretch%shear_flexibility)
            f = l**2*stretch%flexibility/stretched_shear(stretch)
            k = l**2*stretch%modulus_a/stretched_shear(stretch)
            pull = stretch%tension*f
            y(1) = y(1) + ((value%ga - pull*value%be)*w - f*value%be*moment)
            y(2) = y(2) + (slope%al*(w - g*moment) - l**2*stretch%flexibility*slope%be*moment)/l
            y(3) = y(3) + (k*value%be*w + (value%al + pull*value%be)*moment)
            y(4) = y(4) + (k*slope%be*w + (slope%al + pull*slope%be)*moment)/l
            y(5) = y(5) + ((l**2*stretch%modulus_a*slope%be + stretch%tension*slope%al)*w + slope%al*moment)/l
        end associate
    end subroutine fade

    !> v = w - M/GA, psi, M and V at an end of a stretch whose modulus or stiffness changes, seen from there
    pure function sloped_start(stretch, load, ends, side) result(y)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        type(stretch_ends_type), intent(in) :: ends
        !> 1 left, 2 right
        integer, intent(in) :: side
        real(wp) :: y(4)
        type(half_type) :: h
        type(stretch_type) :: other
        real(wp) :: v_a, v_b, by_load(2)

        v_a = without_slip(stretch, 0.0_wp, ends%w_a, ends%moment_a)
        v_b = without_slip(stretch, 1.0_wp, ends%w_b, ends%moment_b)
        if (side == 1) then
            call half_link(stretch, [load], h, by_load(1:1), by_load(2:2))
            y = start_of(stretch, h, by_load, v_a, v_b, ends%moment_a, ends%moment_b)
        else
            other = mirrored(stretch)
            call half_link(other, [turned(load)], h, by_load(1:1), by_load(2:2))
            y = start_of(other, h, by_load, v_b, v_a, ends%moment_b, ends%moment_a)
        end if
    end function sloped_start

    !> Fields from those at the nearer end
    pure subroutine sloped_fields_from(stretch, load, start, xi, w, psi, moment, shear)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: load
        !> By sloped_start at both ends, shape (4, 2); that of the farther end is not used
        real(wp), intent(in) :: start(:, :)
        real(wp), intent(in) :: xi
        real(wp), intent(out) :: w, psi, moment, shear
        real(wp) :: y(4), soft(2)

        if (xi <= 0.5_wp) then
            call advance(stretch, load, 0.0_wp, start(:, 1), xi, y)
        else
            call advance(mirrored(stretch), turned(load), 0.0_wp, start(:, 2), 1 - xi, y)
            y = [y(1), -y(2), y(3), -y(4)]
        end if
        soft(:) = softness_in(stretch, xi)
        w = y(1) + soft(2)*y(3)
        psi = y(2)
        moment = y(3)
        shear = y(4)
    end subroutine sloped_fields_from

    !> v = w - M/GA, psi, M and V at the left end from v and M at both
    pure function start_of(stretch, half, by_load, v_a, v_b, moment_a, moment_b) result(y)
        !> Seen from that end
        type(stretch_type), intent(in) :: stretch
        type(half_type), intent(in) :: half
        !> Rotation and shear by the load
        real(wp), intent(in) :: by_load(2)
        real(wp), intent(in) :: v_a, v_b, moment_a, moment_b
        real(wp) :: y(4)

        y(1) = v_a
        y(2) = (half%p1*v_b - half%pa*v_a) + (half%faa*moment_a + half%fab*moment_b) + by_load(1)
        y(3) = moment_a
        ! The moment's factor in T_a beside p2 is pa + gaa/GA, as T knows w only
        y(4) = shear_of(stretch, 0.0_wp, y(2), (half%p2*moment_b - (half%pa + stretch%shear_flexibility*half%gaa)*moment_a) &
                        - (half%gaa*v_a + half%gab*v_b) + by_load(2))
    end function start_of

end module gapbeam_foundation_fields
