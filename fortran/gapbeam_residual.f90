!> What the rows of the mixed system still lack, in twice the working precision
!>
!> Double-double arithmetic, a number as the unevaluated sum of two doubles, by error-free sums and products (Knuth 1969,
!> Dekker 1971; Ogita, Rump and Oishi 2005). It relies on IEEE arithmetic without contraction and without reordering:
!> never compile with -ffast-math. It stands here and not in a module of its own so that compilers inline it.
module gapbeam_residual
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, rhs_type, answer_type, plain, restrained
    implicit none
    private
    public :: residual_chain, size_type

    !> high + low, high the nearest double
    type :: double_double
        real(wp) :: high = 0.0_wp
        real(wp) :: low = 0.0_wp
    end type double_double

    !> Splits a double into two halves of 26 bits
    real(wp), parameter :: splitter = 134217729.0_wp

    !> Sums of the absolute values of the terms of a node's rows
    type :: size_type
        !> Compatibility left and right of the node (plain nodes: both in right), equilibrium
        real(wp) :: left = 0.0_wp, right = 0.0_wp, shear = 0.0_wp
    end type size_type

contains

    !> Residuals of all rows, with differences of neighbouring deflections and moments formed first
    pure subroutine residual_chain(nodes, links, rhs, answers, residual, sizes, compatibility, equilibrium)
        !> Nodes, links and right-hand side (as before elimination) of the system, see gapbeam_band
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        !> A solution
        type(answer_type), intent(in) :: answers(0:)
        !> Right-hand side of the correction, shape (0:n)
        type(rhs_type), intent(out) :: residual(0:)
        !> Sizes of the terms, shape (0:n)
        type(size_type), intent(out) :: sizes(0:)
        !> Largest residual of the two kinds of rows relative to the largest term of its kind
        real(wp), intent(out) :: compatibility, equilibrium
        type(double_double) :: psi_left, psi_right, v_left, v_right, turn
        real(wp) :: size_left, size_right, size_v_left, size_v_right, largest_turn, largest_shear
        integer :: i, n

        n = size(links)
        compatibility = 0.0_wp
        equilibrium = 0.0_wp
        largest_turn = tiny(largest_turn)
        largest_shear = tiny(largest_shear)
        psi_left = double_double()
        v_left = double_double()
        size_left = 0.0_wp
        size_v_left = 0.0_wp
        do i = 0, n
            psi_right = double_double()
            v_right = double_double()
            size_right = 0.0_wp
            size_v_right = 0.0_wp
            associate (node => nodes(i), a => answers(i), b => rhs(i), r => residual(i), s => sizes(i))
                if (i < n) then
                    associate (link => links(i + 1), z => answers(i + 1))
                        psi_right = divided(plus(double_double(z%deflection, 0.0_wp), -a%deflection), link%length)
                        psi_right = plus_product(psi_right, link%faa, a%moment_right)
                        psi_right = plus_product(psi_right, link%fab, z%moment_left)
                        v_right = divided(plus(double_double(z%moment_left, 0.0_wp), -a%moment_right), link%length)
                        size_right = (abs(z%deflection) + abs(a%deflection))/link%length + link%faa*abs(a%moment_right) &
                            + abs(link%fab*z%moment_left)
                        size_v_right = (abs(z%moment_left) + abs(a%moment_right))/link%length
                    end associate
                end if
                if (node%kind == restrained) then
                    turn = plus(plus(double_double(a%moment_left, 0.0_wp), -a%moment_right), b%couple)
                    turn = plus_product(double_double(node%compliance*turn%low, 0.0_wp), node%compliance, turn%high)
                    if (i > 0) r%left = value_of(plus(plus(minus(turn, psi_left), b%left), 0.0_wp))
                    if (i < n) r%right = value_of(plus(minus(psi_right, turn), b%right))
                    s%left = size_left + abs(turn%high) + abs(b%left)
                    s%right = size_right + abs(turn%high) + abs(b%right)
                    compatibility = max(compatibility, abs(r%left), abs(r%right))
                else if (node%kind == plain .and. i > 0 .and. i < n) then
                    r%right = value_of(plus(plus(minus(psi_right, psi_left), b%left), b%right))
                    s%right = size_left + size_right + abs(b%left) + abs(b%right)
                    compatibility = max(compatibility, abs(r%right))
                end if
                largest_turn = max(largest_turn, s%left, s%right)
                s%shear = size_v_left + size_v_right + abs(b%shear) + node%stiffness*abs(a%deflection)
                largest_shear = max(largest_shear, s%shear)
                if (.not. node%held) then
                    r%shear = value_of(plus_product(plus(minus(v_right, v_left), b%shear), -node%stiffness, a%deflection))
                    equilibrium = max(equilibrium, abs(r%shear))
                end if
                if (i < n) then
                    associate (link => links(i + 1), z => answers(i + 1))
                        psi_left = divided(plus(double_double(z%deflection, 0.0_wp), -a%deflection), link%length)
                        psi_left = plus_product(psi_left, -link%fab, a%moment_right)
                        psi_left = plus_product(psi_left, -link%fbb, z%moment_left)
                        size_left = (abs(z%deflection) + abs(a%deflection))/link%length &
                            + abs(link%fab*a%moment_right) + link%fbb*abs(z%moment_left)
                        v_left = v_right
                        size_v_left = size_v_right
                    end associate
                end if
            end associate
        end do
        compatibility = compatibility/largest_turn
        equilibrium = equilibrium/largest_shear
    end subroutine residual_chain

    !> x + y with a double y; the low part collects the rounding errors and is not normalized
    elemental function plus(x, y) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: y
        type(double_double) :: z
        real(wp) :: t

        z%high = x%high + y
        t = z%high - x%high
        z%low = x%low + ((x%high - (z%high - t)) + (y - t))
    end function plus

    !> x + a b with doubles a and b
    elemental function plus_product(x, a, b) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: a, b
        type(double_double) :: z
        real(wp) :: p, a1, a2, b1, b2

        p = a*b
        a1 = splitter*a
        a1 = a1 - (a1 - a)
        a2 = a - a1
        b1 = splitter*b
        b1 = b1 - (b1 - b)
        b2 = b - b1
        z = plus(x, p)
        z%low = z%low + (((a1*b1 - p) + a1*b2 + a2*b1) + a2*b2)
    end function plus_product

    !> x/y with a double y
    elemental function divided(x, y) result(z)
        type(double_double), intent(in) :: x
        real(wp), intent(in) :: y
        type(double_double) :: z, rest
        real(wp) :: q

        q = x%high/y
        rest = plus_product(x, -q, y)
        z = double_double(q, (rest%high + rest%low)/y)
    end function divided

    !> The nearest double
    elemental function value_of(x) result(value)
        type(double_double), intent(in) :: x
        real(wp) :: value

        value = x%high + x%low
    end function value_of

    !> x - y
    elemental function minus(x, y) result(z)
        type(double_double), intent(in) :: x, y
        type(double_double) :: z

        z = plus(plus(x, -y%high), -y%low)
    end function minus

end module gapbeam_residual
