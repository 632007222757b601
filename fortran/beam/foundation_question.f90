!> Functions along a stretch on elastic ground whose zeros are sought: which one, and its values
module gapbeam_foundation_question
    use gapbeam_kinds, only: wp
    use gapbeam_foundation_stretch, only: softness_in, without_slip, tension_at
    use gapbeam_foundation_taylor, only: is_sloped, stretched_shear, trace_of, determinant_of
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_curved, only: curved_type, order, expand_curved, curved_fields
    implicit none
    private
    public :: question_type, over_line, slope_of_w, slope_of_psi, slope_of_moment, slope_of_transverse, slope_of_curvature
    public :: has_middle, is_string, curved_piece, evaluate

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
        real(wp) :: line(2) = 0.0_wp
        !> Instead of w - line, stiffness side (w - line) - limit, both linear along the stretch
        logical :: is_limit = .false.
        integer :: side = 1
        real(wp) :: stiffness_a = 1.0_wp, stiffness_b = 1.0_wp, limit_a = 0.0_wp, limit_b = 0.0_wp
        !> The stretch where ground acts on it by curves
        type(curved_type), allocatable :: curved
    end type question_type

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

    !> The fields of a stretch on curves around a place
    pure subroutine curved_piece(curved, xi, half, c, pressed, in_middle)
        type(curved_type), intent(in) :: curved
        !> Middle and half of the piece
        real(wp), intent(in) :: xi, half
        !> Coefficients of v, psi, M, V, shape (4, 0:most_terms)
        real(wp), intent(out) :: c(:, 0:)
        !> Size of the force of the curves per length
        real(wp), intent(out) :: pressed
        !> v, psi, M, V there, where they are known
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
                f = w - (question%line(1)*eta + question%line(2)*xi)
                slope = l*incline - (question%line(2) - question%line(1))
                if (question%is_limit) then
                    associate (q => question, k => question%stiffness_a*eta + question%stiffness_b*xi)
                        slope = q%side*(k*slope + (q%stiffness_b - q%stiffness_a)*f) - (q%limit_b - q%limit_a)
                        f = q%side*k*f - (q%limit_a*eta + q%limit_b*xi)
                    end associate
                end if
            case (slope_of_w)
                f = incline - question%line(1)/l
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

end module gapbeam_foundation_question
