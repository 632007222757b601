!> Fields of a stretch on elastic ground as polynomials, piece by piece, with their rounding errors
module gapbeam_foundation_pieces
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_taylor_terms
    use gapbeam_tolerances, only: ground_ulps
    use gapbeam_foundation_stretch, only: is_of_one_stiffness, softest, softness_in, without_slip, tension_at, greatest_tension
    use gapbeam_foundation_taylor, only: expand, terms_of, is_sloped, stretched_shear, trace_of, determinant_of, &
        deflection_series
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type, decay_lengths
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_curved, only: curved_type, order, expand_curved, curved_fields
    implicit none
    private
    public :: question_type, piece_type, over_line, slope_of_transverse, slope_of_curvature
    public :: has_middle, is_string, fading, piece_between, middle_piece, string_piece, evaluate

    !> The functions whose zeros are sought, numbered as the fields whose slopes they are
    integer, parameter :: over_line = 0, slope_of_w = 1, slope_of_psi = 2, slope_of_moment = 3, slope_of_shear = 4, &
        slope_of_transverse = 5, slope_of_curvature = 6

    !> What is asked, of which stretch
    type :: question_type
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        type(stretch_ends_type) :: ends
        integer :: what
        !> The line at both ends, for slope_of_w its slope times the length
        real(wp) :: line_a, line_b
        !> Instead of w - line, stiffness side (w - line) - limit, both linear along the stretch
        logical :: is_limit = .false.
        integer :: side = 1
        real(wp) :: stiffness_a = 1.0_wp, stiffness_b = 1.0_wp, limit_a = 0.0_wp, limit_b = 0.0_wp
        !> The stretch where ground acts on it by curves
        type(curved_type), allocatable :: curved
    end type question_type

    !> A function around the middle of a piece: polynomial in t, -1..1
    type :: piece_type
        real(wp) :: middle, half
        integer :: degree
        real(wp) :: a(0:most_taylor_terms)
        !> Rounding error of its values
        real(wp) :: noise
    end type piece_type

contains

    !> Does everything that the ends do decay, with one rate
    pure function has_middle(stretch) result(has)
        type(stretch_type), intent(in) :: stretch
        logical :: has

        associate (s => stretch)
            has = s%modulus_a > 0.0_wp .and. .not. is_sloped(s) .and. .not. s%tension < 0.0_wp &
                .and. trace_of(s, s%modulus_a)**2 <= 4*determinant_of(s, s%modulus_a)
        end associate
    end function has_middle

    !> Is a stretch a string but near its ends: in tension, off the ground
    pure function is_string(stretch) result(it_is)
        type(stretch_type), intent(in) :: stretch
        logical :: it_is

        associate (s => stretch)
            it_is = s%tension > 0.0_wp .and. .not. max(abs(s%modulus_a), abs(s%modulus_b)) > 0.0_wp .and. .not. is_sloped(s)
        end associate
    end function is_string

    !> The function on a piece, from the fields in its middle
    pure subroutine piece_between(question, left, right, piece, in_middle)
        type(question_type), intent(in) :: question
        !> Its ends, 0..1
        real(wp), intent(in) :: left, right
        type(piece_type), intent(out) :: piece
        !> v, psi, M, V in its middle, where they are known
        real(wp), intent(in), optional :: in_middle(:)
        real(wp) :: c(1, 4, 0:most_taylor_terms), y(1, 4), w, scale(4), tail, pressed, soft(2), pull(2), axis(0:most_taylor_terms)
        integer :: n, j

        associate (s => question%stretch, p => question%load, e => question%ends, a => piece%a, &
                   xi => piece%middle, f => soft(1), g => soft(2))
            xi = left + (right - left)/2
            piece%half = (right - left)/2
            pressed = 0.0_wp
            soft(:) = softness_in(s, xi)
            if (allocated(question%curved)) then
                call curved_piece(question%curved, xi, piece%half, c(1, :, :), pressed, in_middle)
                n = order
            else
                call fields_at(s, p, e, xi, w, y(1, 2), y(1, 3), y(1, 4))
                y(1, 1) = w - g*y(1, 3)
                n = terms_of(s, piece%half)
                call expand(s, [p], xi, y, piece%half, n, c)
            end if
            do j = 1, 4
                scale(j) = sum(abs(c(1, j, 0:n)))
            end do
            scale(1) = scale(1) + g*scale(3)
            scale(2) = scale(2) + g*scale(4)
            scale = scale + scales(question, xi, piece%half, pressed)
            select case (question%what)
            case (over_line)
                a(0:n) = deflection_series(s, xi, piece%half, c(1, :, 0:n))
                a(0) = a(0) - (question%line_a*(1 - xi) + question%line_b*xi)
                a(1) = a(1) - (question%line_b - question%line_a)*piece%half
                piece%noise = scale(1) + abs(question%line_a) + abs(question%line_b)
                if (question%is_limit) call take_limit(question, n, piece)
            case (slope_of_w)
                if (is_of_one_stiffness(s)) then
                    a(0:n) = c(1, 2, 0:n) + g*c(1, 4, 0:n)
                else
                    axis(0:n) = deflection_series(s, xi, piece%half, c(1, :, 0:n))
                    call take_slope(axis, s%length*piece%half, a, n)
                end if
                a(0) = a(0) - question%line_a/s%length
                piece%noise = scale(2) + abs(question%line_a)/s%length
            case (slope_of_psi)
                if (is_of_one_stiffness(s)) then
                    a(0:n) = -f*c(1, 3, 0:n)
                    a(0:1) = a(0:1) + [p%kappa + xi*p%rise, piece%half*p%rise]
                else
                    call take_slope(c(1, 2, :), s%length*piece%half, a, n)
                end if
                piece%noise = f*scale(3) + abs(p%kappa) + abs(p%rise)
            case (slope_of_moment)
                a(0:n) = c(1, 4, 0:n)
                piece%noise = scale(4)
            case (slope_of_curvature)
                call take_slope(c(1, 2, :), s%length*piece%half, axis, n)
                call take_slope(axis, s%length*piece%half, a, n)
                piece%noise = f*(scale(4) + maxval(s%power*abs(s%taper))/s%length*scale(3))
            case default
                call take_slope(c(1, 4, :), s%length*piece%half, a, n)
                piece%noise = max(abs(s%modulus_a), abs(s%modulus_b))*scale(1) + abs(p%qa) + abs(p%qb) + abs(p%qc) + pressed &
                    + abs(greatest_tension(s))*(f*scale(3) + abs(p%kappa) + abs(p%rise)) + abs(s%tension_change)/s%length*scale(2)
                if (question%what == slope_of_transverse) then
                    ! s V' + (N psi)' = ground's pressure less the load
                    pull(:) = [tension_at(s, xi), s%tension_change*piece%half]
                    a(0:n) = stretched_shear(s)*a(0:n) - pull(1)*f*c(1, 3, 0:n) + s%tension_change/s%length*c(1, 2, 0:n)
                    if (abs(pull(2)) > 0.0_wp) a(1:n) = a(1:n) - pull(2)*f*c(1, 3, 0:n - 1)
                    a(0:1) = a(0:1) + pull*(p%kappa + xi*p%rise)
                    a(1:2) = a(1:2) + pull*(piece%half*p%rise)
                end if
            end select
            piece%noise = ground_ulps*epsilon(1.0_wp)*piece%noise
            ! What no coefficient can feel is left off
            tail = 0.0_wp
            do while (n > 1)
                tail = tail + abs(a(n))
                if (tail > piece%noise/16) exit
                n = n - 1
            end do
            piece%degree = n
        end associate
    end subroutine piece_between

    !> The slope of a field along the stretch from its series
    pure subroutine take_slope(series, unit, slope, degree)
        real(wp), intent(in) :: series(0:)
        !> Of the series' variable, a length
        real(wp), intent(in) :: unit
        real(wp), intent(out) :: slope(0:)
        !> Of the series, and of its slope
        integer, intent(inout) :: degree
        integer :: i

        degree = degree - 1
        do i = 0, degree
            slope(i) = (i + 1)*series(i + 1)/unit
        end do
    end subroutine take_slope

    !> From w - line to stiffness side (w - line) - limit
    pure subroutine take_limit(question, degree, piece)
        type(question_type), intent(in) :: question
        !> Of the polynomial
        integer, intent(inout) :: degree
        type(piece_type), intent(inout) :: piece
        real(wp) :: stiffness(0:1)
        integer :: j

        associate (q => question, xi => piece%middle)
            stiffness = q%side*[q%stiffness_a*(1 - xi) + q%stiffness_b*xi, (q%stiffness_b - q%stiffness_a)*piece%half]
            degree = min(degree + 1, most_taylor_terms)
            piece%a(degree) = stiffness(1)*piece%a(degree - 1)
            do j = degree - 1, 1, -1
                piece%a(j) = stiffness(0)*piece%a(j) + stiffness(1)*piece%a(j - 1)
            end do
            piece%a(0) = stiffness(0)*piece%a(0) - (q%limit_a*(1 - xi) + q%limit_b*xi)
            piece%a(1) = piece%a(1) - (q%limit_b - q%limit_a)*piece%half
            piece%noise = max(q%stiffness_a, q%stiffness_b)*piece%noise + max(q%limit_a, q%limit_b)
        end associate
    end subroutine take_limit

    !> The fields of a stretch on curves around a place
    pure subroutine curved_piece(curved, xi, half, c, pressed, in_middle)
        type(curved_type), intent(in) :: curved
        !> Middle and half of the piece
        real(wp), intent(in) :: xi, half
        !> Coefficients of v, psi, M, V, shape (4, 0:most_terms)
        real(wp), intent(out) :: c(:, 0:)
        !> Size of the force of the curves per length
        real(wp), intent(out) :: pressed
        !> As for piece_between
        real(wp), intent(in), optional :: in_middle(:)
        real(wp) :: y(4), w, step, modulus(0:order), forces(0:order, size(curved%curves))

        if (present(in_middle)) then
            y = in_middle
        else
            call curved_fields(curved, xi, w, y(2), y(3), y(4))
            y(1) = without_slip(curved%stretch, xi, w, y(3))
        end if
        call expand_curved(curved, xi, y, half, c, modulus, forces, step)
        pressed = sum(abs(forces))
    end subroutine curved_piece

    !> What the fields are made of beside what is left of them: deflection, rotation, moment, shear
    pure function scales(question, xi, half, pressed) result(scale)
        type(question_type), intent(in) :: question
        !> Middle and half of the piece, and what acts on it beside load and linear ground
        real(wp), intent(in) :: xi, half, pressed
        real(wp) :: scale(4)
        real(wp) :: w, m, q, k, bent, square, soft(2)

        associate (s => question%stretch, p => question%load, e => question%ends, l => question%stretch%length)
            k = max(abs(s%modulus_a), abs(s%modulus_b))
            if (.not. allocated(question%curved) .and. decay_lengths(s) > 3.0_wp .and. has_middle(s)) then
                q = abs(p%qa)*(1 - xi) + abs(p%qb)*xi + abs(p%qc)*xi*(1 - xi)
                ! On the piece the ground's pressure is known to the rounding of the load that it bears
                scale = [q/k, (abs(p%qa) + abs(p%qb) + abs(p%qc))/(k*l) + s%flexibility*q*(half*l)**3, &
                         (abs(p%kappa) + abs(p%rise) + 2*abs(p%qc)/(k*l**2))/s%flexibility + q*(half*l)**2, &
                         abs(p%rise)/(s%flexibility*l) + q*half*l]
            else
                w = abs(e%w_a) + abs(e%w_b)
                m = abs(e%moment_a) + abs(e%moment_b)
                q = abs(p%qa) + abs(p%qb) + abs(p%qc) + k*w + pressed
                square = l**2/8
                soft(:) = softest(s)
                ! Along a beam in tension what is farther away than sqrt(EI/N) bends it no more
                if (min(s%tension, tension_at(s, 1.0_wp)) > 0.0_wp) square = square/(1 + square*trace_of(s, k))
                bent = abs(p%kappa) + abs(p%rise)
                m = m + square*(q + abs(greatest_tension(s)*bent))
                bent = bent + soft(1)*m
                w = w + l**2*bent/8
                scale = [w, w/l + soft(2)*m/l, m, m/l]
                ! Where series begin with the transverse force
                if (is_sloped(s)) scale(4) = scale(4) + abs(greatest_tension(s))*w/l
            end if
        end associate
    end function scales

    !> Bound of the deflection on a piece beside the load's own: what is left of the ends
    pure function fading(question, left, right) result(bound)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: left, right
        real(wp) :: bound
        real(wp) :: p, moment(2), arm

        p = decay_lengths(question%stretch)
        associate (s => question%stretch, q => question%load, e => question%ends)
            moment(:) = ([q%kappa, q%kappa + q%rise] + 2*q%qc/(s%modulus_a*s%length**2))/s%flexibility
            arm = sqrt(s%flexibility)/sqrt(s%modulus_a)
            ! exp(-p x) (1 + p x) where the eigenvalues are alike, less elsewhere; 4 to be safe
            bound = 4*(exp(-p*left)*(1 + p*right)*(abs(e%w_a - q%qa/s%modulus_a) + arm*abs(e%moment_a - moment(1))) &
                       + exp(-p*(1 - right))*(1 + p*(1 - left))*(abs(e%w_b - q%qb/s%modulus_a) + arm*abs(e%moment_b - moment(2))))
        end associate
    end function fading

    !> The function where the load's own deflection is all there is
    pure subroutine middle_piece(question, left, right, piece)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: left, right
        type(piece_type), intent(out) :: piece
        real(wp) :: w(0:2), xi, half

        piece%middle = left + (right - left)/2
        piece%half = (right - left)/2
        xi = piece%middle
        half = piece%half
        piece%a = 0.0_wp
        piece%degree = 2
        associate (s => question%stretch, p => question%load, a => piece%a, eta => 1 - xi)
            w(:) = [p%qa*eta + p%qb*xi + p%qc*xi*eta, (p%qb - p%qa + p%qc*(eta - xi))*half, -p%qc*half**2]/s%modulus_a
            piece%noise = ground_ulps*epsilon(1.0_wp)*(abs(p%qa) + abs(p%qb) + abs(p%qc))/s%modulus_a
            select case (question%what)
            case (over_line)
                a(0:2) = w
                a(0) = a(0) - (question%line_a*eta + question%line_b*xi)
                a(1) = a(1) - (question%line_b - question%line_a)*half
                piece%noise = piece%noise + ground_ulps*epsilon(1.0_wp)*(abs(question%line_a) + abs(question%line_b))
            case (slope_of_w)
                a(0) = (w(1)/half - question%line_a)/s%length
                a(1) = 2*w(2)/(half*s%length)
                piece%noise = (piece%noise + ground_ulps*epsilon(1.0_wp)*abs(question%line_a))/s%length
            case (slope_of_psi)
                a(0) = -2*p%qc/(s%modulus_a*s%length**2)
            case (slope_of_moment)
                a(0) = p%rise/(s%flexibility*s%length)
            case (slope_of_transverse)
                a(0) = 2*s%tension*w(2)/(half*s%length)**2
            case default
                continue
            end select
        end associate
    end subroutine middle_piece

    !> The function on the string between the ends of a stretch in tension: a polynomial of the third degree at most
    pure subroutine string_piece(question, left, right, piece)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: left, right
        type(piece_type), intent(out) :: piece
        real(wp), parameter :: places(4) = [-1.0_wp, -0.5_wp, 0.5_wp, 1.0_wp]
        real(wp) :: f(4), slope, share, even(2), odd(2)
        integer :: k

        ! What its rounding is near the middle
        share = 1/(4*decay_lengths(question%stretch))
        call piece_between(question, left + (right - left)/2 - share, left + (right - left)/2 + share, piece)
        piece%half = (right - left)/2
        do k = 1, 4
            call evaluate(question, piece%middle + places(k)*piece%half, f(k), slope)
        end do
        even(:) = [f(1) + f(4), f(2) + f(3)]/2
        odd(:) = [f(4) - f(1), f(3) - f(2)]/2
        piece%a = 0.0_wp
        piece%a(2) = (even(1) - even(2))*4/3
        piece%a(0) = even(1) - piece%a(2)
        piece%a(3) = (odd(1) - 2*odd(2))*4/3
        piece%a(1) = odd(1) - piece%a(3)
        piece%degree = 3
        do while (piece%degree > 1 .and. abs(piece%a(piece%degree)) <= piece%noise/16)
            piece%degree = piece%degree - 1
        end do
    end subroutine string_piece

    !> The function and its slope in xi
    pure subroutine evaluate(question, xi, f, slope)
        type(question_type), intent(in) :: question
        real(wp), intent(in) :: xi
        real(wp), intent(out) :: f, slope
        real(wp) :: w, psi, moment, shear, pressed, steeper, incline, bent, soft(2), softer(2), c(4, 0:order)

        associate (s => question%stretch, p => question%load, l => question%stretch%length, eta => 1 - xi, f_of => soft(1), &
                   g => soft(2))
            soft(:) = softness_in(s, xi)
            softer(:) = -s%power*s%taper/(1 + s%taper*xi)*soft
            if (allocated(question%curved)) then
                call curved_piece(question%curved, xi, 1.0_wp, c, steeper)
                w = c(1, 0) + g*c(3, 0)
                psi = c(2, 0)
                moment = c(3, 0)
                shear = c(4, 0)
                pressed = c(4, 1)/l
                steeper = 2*c(4, 2)/l
            else
                call fields_at(s, p, question%ends, xi, w, psi, moment, shear)
                bent = f_of*moment - (p%kappa + xi*p%rise)
                pressed = ((s%modulus_a*eta + s%modulus_b*xi)*w + tension_at(s, xi)*bent - s%tension_change/l*psi &
                           - (p%qa*eta + p%qb*xi + p%qc*xi*eta))/stretched_shear(s)
                steeper = ((s%modulus_b - s%modulus_a)*w + tension_at(s, xi)*(l*f_of*shear - p%rise) + 2*s%tension_change*bent &
                           + l*(s%modulus_a*eta + s%modulus_b*xi)*(psi + g*shear) &
                           - (p%qb - p%qa + p%qc*(eta - xi)))/stretched_shear(s)
            end if
            incline = psi + g*shear
            select case (question%what)
            case (over_line)
                f = w - (question%line_a*eta + question%line_b*xi)
                slope = l*incline - (question%line_b - question%line_a)
                if (question%is_limit) then
                    associate (q => question, k => question%stiffness_a*eta + question%stiffness_b*xi)
                        slope = q%side*(k*slope + (q%stiffness_b - q%stiffness_a)*f) - (q%limit_b - q%limit_a)
                        f = q%side*k*f - (q%limit_a*eta + q%limit_b*xi)
                    end associate
                end if
            case (slope_of_w)
                f = incline - question%line_a/l
                slope = l*(p%kappa + xi*p%rise - f_of*moment + g*pressed) + softer(2)*shear
            case (slope_of_psi)
                f = p%kappa + xi*p%rise - f_of*moment
                slope = p%rise - l*f_of*shear - softer(1)*moment
            case (slope_of_curvature)
                f = p%rise/l - f_of*shear - softer(1)*moment/l
                slope = -l*f_of*pressed - 2*softer(1)*shear + (s%power(1) + 1)*s%taper(1)/(1 + s%taper(1)*xi)*softer(1)*moment/l
            case (slope_of_moment)
                f = shear
                slope = l*pressed
            case (slope_of_shear)
                f = pressed
                slope = steeper
            case default
                bent = f_of*moment - (p%kappa + xi*p%rise)
                f = stretched_shear(s)*pressed - tension_at(s, xi)*bent + s%tension_change/l*psi
                slope = stretched_shear(s)*steeper - tension_at(s, xi)*(l*f_of*shear - p%rise) - 2*s%tension_change*bent
            end select
        end associate
    end subroutine evaluate

end module gapbeam_foundation_pieces
