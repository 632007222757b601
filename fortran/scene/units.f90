!> The engine's units: powers of two, so that nothing is rounded, near the sizes of the model itself.
!>
!> Lengths along the beam, forces and deflections have a unit each: the equations are linear, so deflections need not have the
!> unit of the lengths. python/gapbeam/units.py does the same for scenes.
module gapbeam_units
    use gapbeam_kinds, only: wp, infinity
    use gapbeam_quantities, only: quantity_units
    implicit none
    private
    public :: units_type, rotation_unit, moment_unit, stiffness_unit, turning_unit, quantity_unit, units_with_loads
    public :: exponents_type, middle, largest, no_exponent, ordinary_exponent, middle_of, bound_outside

    !> Units of other models are 1: those whose lengths, forces and deflections are within two to this power
    integer, parameter :: ordinary_exponent = 64
    !> There are no numbers to take an exponent of
    integer, parameter :: no_exponent = -huge(1)

    !> Units as powers of two
    type :: units_type
        integer :: length = 0, force = 0, deflection = 0
    end type units_type

    !> Smallest and largest exponent of the finite numbers above 0 met so far
    type :: exponents_type
        integer :: low = huge(1), high = no_exponent
        !> The last number, with its power: many are the same
        real(wp) :: last = 0.0_wp
        integer :: last_power = 0
    contains
        procedure :: note
    end type exponents_type

contains

    !> Of rotations
    elemental function rotation_unit(units) result(power)
        type(units_type), intent(in) :: units
        integer :: power

        power = units%deflection - units%length
    end function rotation_unit

    !> Of moments and couples
    elemental function moment_unit(units) result(power)
        type(units_type), intent(in) :: units
        integer :: power

        power = units%force + units%length
    end function moment_unit

    !> Of the stiffness of supports
    elemental function stiffness_unit(units) result(power)
        type(units_type), intent(in) :: units
        integer :: power

        power = units%force - units%deflection
    end function stiffness_unit

    !> Of the stiffness of rotational restraints
    elemental function turning_unit(units) result(power)
        type(units_type), intent(in) :: units
        integer :: power

        power = moment_unit(units) - rotation_unit(units)
    end function turning_unit

    !> Exponent of the unit of a quantity along the beam, by its number (gapbeam_quantities)
    elemental function quantity_unit(units, quantity) result(power)
        type(units_type), intent(in) :: units
        integer, intent(in) :: quantity
        integer :: power

        power = dot_product(quantity_units(:, quantity), [units%force, units%length, units%deflection])
    end function quantity_unit

    !> Meet a number, with a power of two added to its exponent
    elemental subroutine note(self, value, power)
        class(exponents_type), intent(inout) :: self
        real(wp), intent(in) :: value
        integer, intent(in) :: power

        if (.not. (value > 0.0_wp .and. value <= huge(value))) return
        if (power == self%last_power .and. .not. abs(value - self%last) > 0.0_wp) return
        self%last = value
        self%last_power = power
        self%low = min(self%low, exponent(value) + power)
        self%high = max(self%high, exponent(value) + power)
    end subroutine note

    !> Middle between the smallest and the largest exponent; no_exponent where no number was met
    elemental function middle(exponents) result(power)
        type(exponents_type), intent(in) :: exponents
        integer :: power

        power = no_exponent
        if (exponents%high > no_exponent) power = middle_of(exponents%low, exponents%high)
    end function middle

    !> The largest exponent; no_exponent where no number was met
    elemental function largest(exponents) result(power)
        type(exponents_type), intent(in) :: exponents
        integer :: power

        power = exponents%high
    end function largest

    !> Middle of two exponents, the lower one of two
    elemental function middle_of(a, b) result(power)
        integer, intent(in) :: a, b
        integer :: power

        power = (a + b - modulo(a + b, 2))/2
    end function middle_of

    !> Units of force and deflection from the stiffness of the beam, and the largest force and way imposed on it
    elemental function units_with_loads(length, stiffness, force, way) result(units)
        !> Exponents, no_exponent where there is nothing
        integer, intent(in) :: length, stiffness, force, way
        type(units_type) :: units
        integer :: stiff, effect

        stiff = stiffness
        if (stiff == no_exponent) stiff = merge(0, force, force == no_exponent) - merge(length, way, way == no_exponent)
        effect = force
        if (force /= no_exponent) effect = force - stiff
        if (effect == no_exponent) effect = way
        if (effect == no_exponent) effect = length
        units%length = length
        units%deflection = effect
        if (way /= no_exponent) units%deflection = middle_of(effect, way)
        units%force = stiff + units%deflection
        if (max(abs(length), abs(units%force), abs(units%deflection)) <= ordinary_exponent) units = units_type()
    end function units_with_loads

    !> A bound of errors in the model's units; where it and what it bounds may have been rounded, the next greater number; infinite
    !> where it left the range of double precision
    elemental function bound_outside(bound, power) result(outside)
        !> In the engine's units, and the exponent of its unit
        real(wp), intent(in) :: bound
        integer, intent(in) :: power
        real(wp) :: outside

        if (bound <= huge(bound)) then
            outside = scale(bound, power)
        else
            outside = infinity
        end if
        if (power /= 0 .and. bound > 0.0_wp .and. outside < tiny(outside)) outside = nearest(outside, 1.0_wp)
    end function bound_outside

end module gapbeam_units
