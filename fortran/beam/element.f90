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
    public :: moment_integrals, field_type, fields_at

    !> A running sum that keeps its rounding error (Neumaier 1974), so that a million pieces lose no digits
    type :: sum_type
        real(wp) :: high = 0.0_wp
        real(wp) :: low = 0.0_wp
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

    !> Integrals of the moment over a piece, weighted towards its ends:
    !> left = int (1-t) M ds, right = int t M ds, for M linear from m0 to m1 plus the bubble of the load.
    !> The load terms are those of the simple beam under a linear load (7 and 8 over 360).
    pure subroutine moment_integrals(l, m0, m1, qa, qb, left, right)
        !> Length of the piece
        real(wp), intent(in) :: l
        !> Moments at its left and right end
        real(wp), intent(in) :: m0, m1
        !> Load per length at its left and right end, positive downward
        real(wp), intent(in) :: qa, qb
        !> The two integrals, moment times length
        real(wp), intent(out) :: left, right

        left = l*((2*m0 + m1)/6 + l**2*(8*qa + 7*qb)/360)
        right = l*((m0 + 2*m1)/6 + l**2*(7*qa + 8*qb)/360)
    end subroutine moment_integrals

    !> Fields inside a piece from the fields at its left end, by exact integration of
    !> M'' = -q, psi' = -M/EI + kappa, w' = psi + V/GA
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
        real(wp) :: slope, rise

        slope = (qb - qa)/l
        rise = s*(start%shear - s*(qa/2 + s*slope/6))
        fields%moment = start%moment + rise
        fields%shear = start%shear - s*(qa + s*slope/2)
        fields%rotation = start%rotation + s*(kappa - flexibility*(start%moment &
            + s*(start%shear/2 - s*(qa/6 + s*slope/24))))
        fields%deflection = start%deflection + s*(start%rotation + s*(kappa/2 &
            - flexibility*(start%moment/2 + s*(start%shear/6 - s*(qa/24 + s*slope/120))))) &
            + shear_flexibility*rise
    end function fields_at

end module gapbeam_element
