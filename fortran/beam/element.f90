!> One prismatic piece of beam: closed forms for its flexibility, its loads and the fields inside it.
!>
!> Local coordinate s = 0..l to the right, t = s/l; EI, GA and the imposed curvature are constant,
!> the load q is linear from qa to qb. Signs: deflection and load downward, moment sagging,
!> V = M', rotation and couples clockwise (docs/method.md 2). The unknowns are those of the bar of the
!> "second kind" of Ignatiev et al. 2021: end deflections and end moments.
module gapbeam_element
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: sum_type, add, total
    public :: load_moment, moment_integrals, field_type, fields_at

    !> A running sum that keeps its rounding error (Neumaier 1974), so that a million pieces lose no digits
    type :: sum_type
        real(wp) :: high = 0.0_wp, low = 0.0_wp
    end type sum_type

    !> Values of all fields at one point
    type :: field_type
        real(wp) :: deflection, rotation, moment, shear
    end type field_type

contains

    !> Add a term to a compensated sum
    elemental subroutine add(self, term)
        type(sum_type), intent(inout) :: self
        real(wp), intent(in) :: term
        real(wp) :: high

        high = self%high + term
        if (abs(self%high) >= abs(term)) then
            self%low = self%low + ((self%high - high) + term)
        else
            self%low = self%low + ((term - high) + self%high)
        end if
        self%high = high
    end subroutine add

    !> Value of a compensated sum
    elemental function total(self) result(value)
        type(sum_type), intent(in) :: self
        real(wp) :: value

        value = self%high + self%low
    end function total

    !> Fields inside a piece from the fields at its left end
    pure function fields_at(start, s, l, flexibility, shear_flexibility, qa, qb, kappa) result(fields)
        !> Fields just right of the piece's left end
        type(field_type), intent(in) :: start
        !> Distance from the left end, 0..l
        real(wp), intent(in) :: s
        !> Length of the piece
        real(wp), intent(in) :: l
        !> 1/EI and 1/GA; zero for a rigid one
        real(wp), intent(in) :: flexibility, shear_flexibility
        !> Load per length at the left and right end
        real(wp), intent(in) :: qa, qb
        !> Imposed curvature
        real(wp), intent(in) :: kappa
        type(field_type) :: fields

        associate (w => start%deflection, psi => start%rotation, m => start%moment, v => start%shear)
            fields%deflection = deflection_at(s, l, flexibility, shear_flexibility, qa, qb, kappa, w, psi, m, v)
            fields%rotation = rotation_at(s, l, flexibility, qa, qb, kappa, psi, m, v)
            fields%moment = moment_at(s, l, qa, qb, m, v)
            fields%shear = shear_at(s, l, qa, qb, v)
        end associate
    end function fields_at

    include 'beam/moments_along.inc'
    include 'beam/fields_along.inc'

end module gapbeam_element
