!> Fields of a stretch on elastic ground as polynomials, piece by piece, with their rounding errors
module gapbeam_foundation_pieces
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_taylor_terms
    use gapbeam_tolerances, only: ground_ulps
    use gapbeam_foundation_stretch, only: is_of_one_stiffness, softest, softness_in, tension_at, greatest_tension
    use gapbeam_foundation_taylor, only: expand, terms_of, is_sloped, stretched_shear, trace_of, deflection_series
    use gapbeam_foundation, only: decay_lengths
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_curved, only: order
    use gapbeam_foundation_question, only: question_type, over_line, slope_of_w, slope_of_psi, slope_of_moment, &
        slope_of_transverse, slope_of_curvature, has_middle, curved_piece, evaluate
    implicit none
    private
    public :: series_type, piece_type, fading, series_between, piece_of, middle_piece, string_piece

    !> The fields around the middle of a piece, whatever is asked of them: polynomials in t, -1..1
    type :: series_type
        real(wp) :: middle, half
        integer :: degree
        !> Coefficients of v, psi, M, V, and of w where that is asked for
        real(wp) :: c(4, 0:most_taylor_terms), axis(0:most_taylor_terms)
        !> Sizes of what w, psi, M, V are sums of; that of the force of curves per length
        real(wp) :: scale(4), pressed
    end type series_type

    !> A function around the middle of a piece: polynomial in t, -1..1
    type :: piece_type
        real(wp) :: middle, half
        integer :: degree
        real(wp) :: a(0:most_taylor_terms)
        !> Rounding error of its values
        real(wp) :: noise
    end type piece_type

contains

    !> The fields on a piece, from those in its middle
    pure subroutine series_between(question, left, right, of_axis, series, in_middle)
        type(question_type), intent(in) :: question
        !> Its ends, 0..1
        real(wp), intent(in) :: left, right
        !> Is that of w asked for
        logical, intent(in) :: of_axis
        type(series_type), intent(out) :: series
        !> v, psi, M, V in its middle, where they are known
        real(wp), intent(in), optional :: in_middle(:)
        real(wp) :: c(1, 4, 0:most_taylor_terms), y(1, 4), w, soft(2)
        integer :: j

        associate (s => question%stretch, p => question%load, xi => series%middle, half => series%half, n => series%degree, &
                   scale => series%scale, g => soft(2))
            xi = left + (right - left)/2
            half = (right - left)/2
            series%pressed = 0.0_wp
            soft(:) = softness_in(s, xi)
            if (allocated(question%curved)) then
                call curved_piece(question%curved, xi, half, series%c, series%pressed, in_middle)
                n = order
            else
                call fields_at(s, p, question%ends, xi, w, y(1, 2), y(1, 3), y(1, 4))
                y(1, 1) = w - g*y(1, 3)
                n = terms_of(s, half)
                call expand(s, [p], xi, y, half, n, c)
                series%c(:, 0:n) = c(1, :, 0:n)
            end if
            if (of_axis) series%axis(0:n) = deflection_series(s, xi, half, series%c(:, 0:n))
            do j = 1, 4
                scale(j) = sum(abs(series%c(j, 0:n)))
            end do
            scale(1) = scale(1) + g*scale(3)
            scale(2) = scale(2) + g*scale(4)
            scale = scale + scales(question, xi, half, series%pressed)
        end associate
    end subroutine series_between

    !> The function on a piece
    pure subroutine piece_of(question, series, piece)
        type(question_type), intent(in) :: question
        !> By series_between
        type(series_type), intent(in) :: series
        type(piece_type), intent(out) :: piece
        real(wp) :: tail, soft(2), pull(2), slope(0:most_taylor_terms)
        integer :: n

        n = series%degree
        piece%middle = series%middle
        piece%half = series%half
        associate (s => question%stretch, p => question%load, a => piece%a, xi => series%middle, c => series%c, &
                   scale => series%scale, f => soft(1), g => soft(2))
            soft(:) = softness_in(s, xi)
            select case (question%what)
            case (over_line)
                a(0:n) = series%axis(0:n)
                a(0) = a(0) - (question%line(1)*(1 - xi) + question%line(2)*xi)
                a(1) = a(1) - (question%line(2) - question%line(1))*piece%half
                piece%noise = scale(1) + abs(question%line(1)) + abs(question%line(2))
                if (question%is_limit) call take_limit(question, n, piece)
            case (slope_of_w)
                if (is_of_one_stiffness(s)) then
                    a(0:n) = c(2, 0:n) + g*c(4, 0:n)
                else
                    call take_slope(series%axis, s%length*piece%half, a, n)
                end if
                a(0) = a(0) - question%line(1)/s%length
                piece%noise = scale(2) + abs(question%line(1))/s%length
            case (slope_of_psi)
                if (is_of_one_stiffness(s)) then
                    a(0:n) = -f*c(3, 0:n)
                    a(0:1) = a(0:1) + [p%kappa + xi*p%rise, piece%half*p%rise]
                else
                    call take_slope(c(2, :), s%length*piece%half, a, n)
                end if
                piece%noise = f*scale(3) + abs(p%kappa) + abs(p%rise)
            case (slope_of_moment)
                a(0:n) = c(4, 0:n)
                piece%noise = scale(4)
            case (slope_of_curvature)
                call take_slope(c(2, :), s%length*piece%half, slope, n)
                call take_slope(slope, s%length*piece%half, a, n)
                piece%noise = f*(scale(4) + maxval(s%power*abs(s%taper))/s%length*scale(3))
            case default
                call take_slope(c(4, :), s%length*piece%half, a, n)
                piece%noise = max(abs(s%modulus_a), abs(s%modulus_b))*scale(1) + abs(p%qa) + abs(p%qb) + abs(p%qc) &
                    + series%pressed + abs(greatest_tension(s))*(f*scale(3) + abs(p%kappa) + abs(p%rise)) &
                    + abs(s%tension_change)/s%length*scale(2)
                if (question%what == slope_of_transverse) then
                    ! s V' + (N psi)' = ground's pressure less the load
                    pull(:) = [tension_at(s, xi), s%tension_change*piece%half]
                    a(0:n) = stretched_shear(s)*a(0:n) - pull(1)*f*c(3, 0:n) + s%tension_change/s%length*c(2, 0:n)
                    if (abs(pull(2)) > 0.0_wp) a(1:n) = a(1:n) - pull(2)*f*c(3, 0:n - 1)
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
    end subroutine piece_of

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

    !> What the fields are made of beside what is left of them: deflection, rotation, moment, shear
    pure function scales(question, xi, half, pressed) result(scale)
        type(question_type), intent(in) :: question
        !> Middle and half of the piece, and what acts on it beside load and linear ground
        real(wp), intent(in) :: xi, half, pressed
        real(wp) :: scale(4), w, m, q, k, bent, square, soft(2)

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
        real(wp) :: bound, p, moment(2), arm

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
                a(0) = a(0) - (question%line(1)*eta + question%line(2)*xi)
                a(1) = a(1) - (question%line(2) - question%line(1))*half
                piece%noise = piece%noise + ground_ulps*epsilon(1.0_wp)*(abs(question%line(1)) + abs(question%line(2)))
            case (slope_of_w)
                a(0) = (w(1)/half - question%line(1))/s%length
                a(1) = 2*w(2)/(half*s%length)
                piece%noise = (piece%noise + ground_ulps*epsilon(1.0_wp)*abs(question%line(1)))/s%length
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
        type(series_type) :: series
        real(wp) :: f(4), slope, share, even(2), odd(2)
        integer :: k

        ! What its rounding is near the middle
        share = 1/(4*decay_lengths(question%stretch))
        call series_between(question, left + (right - left)/2 - share, left + (right - left)/2 + share, &
                            question%what <= slope_of_w, series)
        call piece_of(question, series, piece)
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

end module gapbeam_foundation_pieces
