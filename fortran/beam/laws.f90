!> The laws of supports and ground by name: force, slope, energy, inverse, bound, and the polyline in place of a curve.
!>
!> A law is the force over the displacement past the gap, both in the direction in which it pushes; of ground per length of the
!> beam. Its series are in gapbeam_law_series, those of supports by points in gapbeam_polyline.
module gapbeam_laws
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: law_by_points, law_plastic, law_hardening, law_hyperbolic, law_tanh, law_cubic, law_polyline, law_power, law_brittle
    public :: parameters_of_law, parameters_of, key_of_parameter, is_smooth, begins_steep, law_force, law_slope, law_energy, &
        law_displacement, law_bound, law_scale, law_points

    !> Laws: by points, or none; elastic up to a force (stiffness, limit), of another slope beyond (and slope); curves that tend to
    !> a force (stiffness, limit); k1 d + k2 d**2 + k3 d**3 (k1, k2, k3)
    integer, parameter :: law_by_points = 0, law_plastic = 1, law_hardening = 2, law_hyperbolic = 3, law_tanh = 4, law_cubic = 5
    !> Of ground by points whose displacements vary along the piece of the beam, so that slopes are no lines there; nobody gives it
    integer, parameter :: law_polyline = 6
    !> Of supports only: limit (d/d0)**n (d0, limit, n); elastic up to a force at which it drops to nothing (stiffness, limit)
    integer, parameter :: law_power = 7, law_brittle = 8
    !> Parameters of a law, at most
    integer, parameter :: parameters_of_law = 3
    !> Points of the polyline in place of a curve, and the powers of two of its scale between which they are
    integer, parameter :: points_of_curve = 96, widest = 20

contains

    !> How many parameters a law has
    elemental function parameters_of(law) result(number)
        integer, intent(in) :: law
        integer :: number

        number = merge(3, 2, any(law == [law_hardening, law_cubic, law_power]))
        if (law == law_by_points) number = 0
    end function parameters_of

    !> A parameter as scenes call it, blanks behind it
    pure function key_of_parameter(law, number) result(key)
        integer, intent(in) :: law, number
        character(len=13) :: key
        character(len=*), parameter :: keys(parameters_of_law) = [character(len=9) :: "stiffness", "limit", "slope"], &
                                       of_cubic(parameters_of_law) = [character(len=9) :: "k1", "k2", "k3"], &
                                       of_power(parameters_of_law) = [character(len=9) :: "d0", "limit", "n"]

        key = "law."//keys(number)
        if (law == law_cubic) key = "law."//of_cubic(number)
        if (law == law_power) key = "law."//of_power(number)
    end function key_of_parameter

    !> Is a law a curve
    elemental function is_smooth(law) result(it_is)
        integer, intent(in) :: law
        logical :: it_is

        it_is = any(law == [law_hyperbolic, law_tanh, law_cubic, law_power])
    end function is_smooth

    !> Does a curve begin infinitely steep, so that a force tells the point on it and a displacement does not
    pure function begins_steep(law, p) result(it_does)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        logical :: it_does

        it_does = law == law_power
        if (it_does) it_does = p(3) < 1.0_wp
    end function begins_steep

    !> Force at a displacement past the gap, 0 or more; of law_hardening on the line beyond its limit
    pure function law_force(law, p, u) result(force)
        !> The law, not linear, its parameters, the displacement
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:), u
        real(wp) :: force

        force = 0.0_wp
        select case (law)
        case (law_tanh)
            if (p(2) > 0.0_wp) force = p(2)*tanh(p(1)*u/p(2))
        case (law_hyperbolic)
            if (p(2) > 0.0_wp) force = p(1)*u/(1 + p(1)*u/p(2))
        case (law_cubic)
            force = u*(p(1) + u*(p(2) + u*p(3)))
        case (law_polyline)
            force = p(2) + p(4)*((u - p(1))/p(3))
        case (law_power)
            if (u > 0.0_wp) force = p(2)*power(u/p(1), p(3))
        case default
            force = p(2) + p(3)*u
            if (p(1) > 0.0_wp) force = force - p(3)*(p(2)/p(1))
        end select
    end function law_force

    !> Its slope there
    pure function law_slope(law, p, u) result(slope)
        !> As for law_force
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:), u
        real(wp) :: slope, exponential

        slope = 0.0_wp
        select case (law)
        case (law_tanh)
            if (.not. p(2) > 0.0_wp) return
            exponential = exp(-2*abs(p(1)*u/p(2)))
            slope = p(1)*(4*exponential/(1 + exponential)**2)
        case (law_hyperbolic)
            if (p(2) > 0.0_wp) slope = p(1)/(1 + p(1)*u/p(2))**2
        case (law_cubic)
            slope = p(1) + u*(2*p(2) + 3*p(3)*u)
        case (law_polyline)
            slope = p(4)/p(3)
        case (law_power)
            if (u > 0.0_wp) then
                slope = p(3)*law_force(law, p, u)/u
            else if (p(3) < 1.0_wp) then
                slope = ieee_value(slope, ieee_positive_inf)
            else if (.not. p(3) > 1.0_wp) then
                slope = p(2)/p(1)
            end if
        case default
            slope = p(3)
        end select
    end function law_slope

    !> Work up to a displacement past the gap; 0 before it
    pure function law_energy(law, p, u) result(energy)
        !> A curve, its parameters, the displacement
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:), u
        real(wp) :: energy, z

        energy = 0.0_wp
        if (.not. u > 0.0_wp) return
        select case (law)
        case (law_tanh)
            z = p(1)*u/p(2)
            if (z < 1.0_wp) then
                z = log_one_more(sinh(z)**2)/2
            else
                z = z + log_one_more(exp(-2*z)) - log(2.0_wp)
            end if
            energy = p(2)*(p(2)/p(1))*z
        case (law_hyperbolic)
            z = p(1)*u/p(2)
            energy = p(2)*(p(2)/p(1))*without_log(z)
        case (law_cubic)
            energy = u*u*(p(1)/2 + u*(p(2)/3 + u*p(3)/4))
        case (law_power)
            energy = law_force(law, p, u)*u/(p(3) + 1)
        case default
        end select
    end function law_energy

    !> Displacement past the gap at a force above 0, of a curve that begins steep
    pure function law_displacement(law, p, force) result(u)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:), force
        real(wp) :: u

        u = 0.0_wp
        if (law == law_power) u = p(1)*power(force/p(2), 1/p(3))
    end function law_displacement

    !> The force that a curve never exceeds; infinite if there is none
    pure function law_bound(law, p) result(bound)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        real(wp) :: bound

        bound = ieee_value(bound, ieee_positive_inf)
        if (law == law_hyperbolic .or. law == law_tanh) bound = p(2)
    end function law_bound

    !> A displacement that is typical of a curve: where its first slope would reach the limit, or two of its parts are equal
    pure function law_scale(law, p) result(u)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        real(wp) :: u

        select case (law)
        case (law_power)
            u = p(1)
        case (law_cubic)
            u = 0.0_wp
            if (p(1) > 0.0_wp .and. p(3) > 0.0_wp) then
                u = sqrt(p(1))/sqrt(p(3))
            else if (p(3) > 0.0_wp) then
                u = p(2)/p(3)
            else if (abs(p(2)) > 0.0_wp) then
                u = p(1)/p(2)
            end if
            if (.not. abs(u) > 0.0_wp) u = 1.0_wp
        case default
            u = p(2)/p(1)
        end select
    end function law_scale

    !> The polyline of a law of a support from (0, 0) on, which is left out: displacement and force, shape (2, :). Of a curve points
    !> on it, closer where it bends
    pure function law_points(law, p) result(points)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        real(wp), allocatable :: points(:, :)
        real(wp) :: d, way

        if (is_smooth(law)) then
            points = points_on_curve(law, p)
            return
        end if
        d = p(2)/p(1)
        way = 2*d
        if (.not. way > 0.0_wp) way = 1.0_wp
        select case (law)
        case (law_brittle)
            points = reshape([d, p(2), d, 0.0_wp, way, 0.0_wp], [2, 3])
        case (law_hardening)
            if (.not. p(3) > 0.0_wp) then
                points = reshape([d, p(2), way, p(2)], [2, 2])
            else if (p(3) > huge(d)) then
                points = reshape([d, p(2), d, 2*p(2)], [2, merge(2, 1, d > 0.0_wp)])
            else
                ! So far that the slope comes out of it to all digits
                way = max(d, p(2)/p(3))
                points = reshape([d, p(2), d + way, p(2) + merge(p(3)*way, p(2), way > 0.0_wp)], [2, 2])
            end if
        case default
            points = reshape([d, p(2), way, p(2)], [2, 2])
        end select
    end function law_points

    !> The same of a curve
    pure function points_on_curve(law, p) result(points)
        integer, intent(in) :: law
        real(wp), intent(in) :: p(:)
        real(wp), allocatable :: points(:, :), ways(:)
        real(wp) :: spacing, force, before, scale_of_law
        integer :: k, n

        scale_of_law = law_scale(law, p)
        allocate (ways, source=[(scale_of_law*2.0_wp**(widest*(2*real(k, wp)/(points_of_curve - 1) - 1)), &
                                 k=0, points_of_curve - 1)])
        if (law == law_cubic .and. p(2) < 0.0_wp) then
            ! Where it softens at equal distances, up to twice where the force is nearest to 0
            spacing = 2*scale_of_law/points_of_curve
            ways = [pack(ways, ways < 0.9_wp*spacing), [(k*spacing, k=1, points_of_curve)], &
                    pack(ways, ways > 1.1_wp*points_of_curve*spacing)]
            points = reshape([(ways(k), max(law_force(law, p, ways(k)), 0.0_wp), k=1, size(ways))], [2, size(ways)])
            return
        end if
        allocate (points(2, points_of_curve))
        n = 0
        before = 0.0_wp
        do k = 1, size(ways)
            ! Where a curve has become flat to the last digit, or leaves the range of doubles, a point less
            force = law_force(law, p, ways(k))
            if (force > before .and. force <= huge(force)) then
                n = n + 1
                points(:, n) = [ways(k), force]
            end if
            before = force
        end do
        if (n > 0) then
            points = points(:, :n)
            ! What tends to a force carries no more than that, however far it goes
            if (law_bound(law, p) <= huge(force)) then
                points = reshape([points, 2*points(1, n), law_bound(law, p), 4*points(1, n), law_bound(law, p)], [2, n + 2])
            end if
        else
            points = reshape([scale_of_law, law_force(law, p, scale_of_law)], [2, 1])
        end if
    end function points_on_curve

    !> A power of a number of 0 or more; infinite beyond the range of doubles
    pure function power(base, exponent)
        real(wp), intent(in) :: base, exponent
        real(wp) :: power

        power = ieee_value(power, ieee_positive_inf)
        if (base > huge(base)) return
        if (base > 1.0_wp) then
            if (exponent*log(base) > log(huge(base))) return
        end if
        power = base**exponent
    end function power

    !> log(1 + x) to all digits (Kahan; Higham, Accuracy and Stability, 1.14)
    pure function log_one_more(x) result(value)
        real(wp), intent(in) :: x
        real(wp) :: value, more

        more = 1 + x
        value = x
        if (abs(more - 1) > 0.0_wp) value = log(more)*(x/(more - 1))
    end function log_one_more

    !> z - log(1 + z) of a number above 0, to all digits
    pure function without_log(z) result(value)
        real(wp), intent(in) :: z
        real(wp) :: value, term
        integer :: n

        if (z > 0.5_wp) then
            value = z - log_one_more(z)
            return
        end if
        value = 0.0_wp
        term = z
        n = 1
        do
            n = n + 1
            term = -term*z
            value = value - term/n
            if (.not. abs(term) > epsilon(z)*value) exit
        end do
    end function without_log

end module gapbeam_laws
