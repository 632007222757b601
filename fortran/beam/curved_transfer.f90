!> Steps along a stretch of beam on ground with a curved law: series at the end of a step, and how they change with its beginning.
module gapbeam_curved_transfer
    use gapbeam_kinds, only: wp, dp
    use gapbeam_foundation_stretch, only: stretch_type, softness_type, is_of_one_stiffness, softness_around, soften, &
        tension_at
    use gapbeam_foundation_taylor, only: stretched_shear
    use gapbeam_law_series, only: order, order_in_double
    implicit none
    private
    public :: transfer_of, value_of, integral

contains

    !> How the fields at the end of a step change with those where it begins
    pure function transfer_of(stretch, xi, way, modulus, step) result(transfer)
        type(stretch_type), intent(in) :: stretch
        !> Where it begins, unit of t, the modulus as a series in it, and the step
        real(wp), intent(in) :: xi, way, modulus(0:), step
        real(wp) :: transfer(4, 4), c(0:order, 4), w(0:order), part(0:order), stretched, pull(0:1)
        real(dp) :: rough_modulus(0:order), rough_w(0:order)
        real(wp), dimension(1, 0:order) :: bent, slid, shifted
        type(softness_type) :: softness
        integer :: j, n, i, terms

        ! Where the force of the ground does not change with the deflection, nothing is left beyond cubes
        terms = order
        pull = [tension_at(stretch, xi), stretch%tension_change*way]
        if (.not. (any(abs(modulus) > 0.0_wp) .or. any(abs(pull) > 0.0_wp)) .and. is_of_one_stiffness(stretch)) terms = 3
        softness = softness_around(stretch, xi, way)
        part(:) = [(stretch%length*way/(n + 1), n=0, order)]
        stretched = stretched_shear(stretch)
        rough_modulus(:) = real(modulus, dp)
        do j = 1, 4
            c(0, :) = 0.0_wp
            c(0, j) = 1.0_wp
            do n = 0, terms - 1
                call soften(softness, n, c(n:n, 3), bent, slid, shifted)
                w(n) = c(n, 1) + slid(1, n)
                rough_w(n) = real(w(n), dp)
                c(n + 1, 1) = part(n)*c(n, 2)
                if (stretch%power(2) > 0) c(n + 1, 1) = c(n + 1, 1) - shifted(1, n)/(n + 1)
                c(n + 1, 2) = -part(n)*bent(1, n)
                c(n + 1, 3) = part(n)*c(n, 4)
                if (n <= order_in_double) then
                    c(n + 1, 4) = dot_product(modulus(0:n), w(n:0:-1))
                else
                    c(n + 1, 4) = real(dot_product(rough_modulus(0:n), rough_w(n:0:-1)), wp)
                end if
                if (abs(pull(0)) > 0.0_wp) then
                    c(n + 1, 4) = part(n)*(c(n + 1, 4) + pull(0)*bent(1, n))/stretched
                else
                    c(n + 1, 4) = part(n)*c(n + 1, 4)
                end if
                if (abs(pull(1)) > 0.0_wp) then
                    c(n + 1, 4) = c(n + 1, 4) - (pull(1)/(n + 1))*c(n, 2)
                    if (n > 0) c(n + 1, 4) = c(n + 1, 4) + part(n)*pull(1)*bent(1, max(0, n - 1))
                end if
            end do
            do i = 1, 4
                transfer(i, j) = value_of(c(0:terms, i), step)
            end do
        end do
    end function transfer_of

    !> A series at a place; terms that are below the rounding of double precision in that
    pure function value_of(c, t) result(value)
        real(wp), intent(in) :: c(0:), t
        real(wp) :: value
        real(dp) :: rest
        integer :: n

        rest = real(c(ubound(c, 1)), dp)
        do n = ubound(c, 1) - 1, order_in_double + 1, -1
            rest = real(c(n), dp) + real(t, dp)*rest
        end do
        value = real(rest, wp)
        if (ubound(c, 1) <= order_in_double) value = c(ubound(c, 1))
        do n = min(order_in_double, ubound(c, 1) - 1), 0, -1
            value = c(n) + t*value
        end do
    end function value_of

    !> Its integral from 0
    pure function integral(c, t) result(value)
        real(wp), intent(in) :: c(0:), t
        real(wp) :: value
        integer :: n

        value = c(order)/(order + 1)
        do n = order - 1, 0, -1
            value = c(n)/(n + 1) + t*value
        end do
        value = t*value
    end function integral

end module gapbeam_curved_transfer
