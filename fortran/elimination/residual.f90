!> Residual of the mixed system in twice the working precision.
!>
!> Numbers are unevaluated sums of two doubles (double_double.inc), with differences of neighbouring deflections and moments
!> formed first.
module gapbeam_residual
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: cache_block
    use gapbeam_tolerances, only: splitter
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, rhs_type, answer_type, plain, jointed
    use gapbeam_nodes, only: joint_left, joint_right, is_through, is_restrained, takes_left, takes_right
    implicit none
    private
    public :: residual_chain, residual_inside, size_type

    !> Sums of the absolute values of the terms of a node's rows. A difference of deflections or moments is one term: only
    !> the length that divides it can be off
    type :: size_type
        !> Compatibility left and right of the node (plain nodes: both in right), equilibrium
        real(wp) :: left = 0.0_wp, right = 0.0_wp, shear = 0.0_wp
    end type size_type

    !> Rotation and shear at an end of a link, and the sizes of their terms
    type :: end_type
        real(wp) :: psi = 0.0_wp, psi_low = 0.0_wp, shear = 0.0_wp, shear_low = 0.0_wp, size_of_psi = 0.0_wp, size_of_shear = 0.0_wp
    end type end_type

contains

    !> Residuals of all rows, with differences of neighbouring deflections and moments formed first
    pure subroutine residual_chain(nodes, links, rhs, answers, residual, sizes, range)
        !> Nodes, links and right-hand side (as before elimination) of the system, see gapbeam_band
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        !> A solution
        type(answer_type), intent(in) :: answers(0:)
        !> Right-hand side of the correction, shape (0:n)
        type(rhs_type), intent(inout) :: residual(0:)
        !> Sizes of the terms, shape (0:n)
        type(size_type), intent(inout) :: sizes(0:)
        !> First and last node of interest, if not all are
        integer, intent(in), optional :: range(2)
        type(end_type) :: left, right, left_of_next
        real(wp) :: high, low
        integer :: i, n, begin, finish

        n = size(links)
        begin = 0
        finish = n
        if (present(range)) then
            if (checked) call require(0 <= range(1) .and. range(1) <= range(2) .and. range(2) <= n, "residual_chain: range")
            begin = range(1)
            finish = range(2)
        end if
        left = end_type()
        if (begin > 0) call ends_of_link(links(begin), answers(begin - 1), answers(begin), right, left)
        do i = begin, finish
            right = end_type()
            left_of_next = end_type()
            if (i < n) call ends_of_link(links(i + 1), answers(i), answers(i + 1), right, left_of_next)
            residual(i) = rhs_type()
            sizes(i) = size_type()
            associate (node => nodes(i), a => answers(i), b => rhs(i), r => residual(i), s => sizes(i))
                if (is_restrained(node%kind)) then
                    call residual_of_restraint(node, a, b, left, right, i > 0, i < n, r, s)
                else if (is_through(node%kind) .and. i > 0 .and. i < n) then
                    high = right%psi
                    low = right%psi_low
                    call subtract(high, low, left%psi, left%psi_low)
                    call add(high, low, b%left)
                    call add(high, low, b%right)
                    s%right = left%size_of_psi + right%size_of_psi + abs(b%left) + abs(b%right)
                    if (node%kind == jointed) then
                        call add_product(high, low, node%compliance, a%moment_left)
                        s%right = s%right + node%compliance*abs(a%moment_left)
                    end if
                    r%right = high + low
                end if
                s%shear = left%size_of_shear + right%size_of_shear + abs(b%shear) + abs(node%stiffness*a%deflection)
                if (node%held) then
                    r%deflection = b%deflection - a%deflection
                else
                    high = right%shear
                    low = right%shear_low
                    call subtract(high, low, left%shear, left%shear_low)
                    call add(high, low, b%shear)
                    call add_product(high, low, -node%stiffness, a%deflection)
                    r%shear = high + low
                end if
            end associate
            left = left_of_next
        end do
    end subroutine residual_chain

    !> Residuals of the rotations beside a restraint, where a joint or a hinge may be on one side of it
    pure subroutine residual_of_restraint(node, a, b, left, right, has_left, has_right, r, s)
        type(node_type), intent(in) :: node
        type(answer_type), intent(in) :: a
        type(rhs_type), intent(in) :: b
        !> Of the links beside it, and are they there
        type(end_type), intent(in) :: left, right
        logical, intent(in) :: has_left, has_right
        type(rhs_type), intent(inout) :: r
        type(size_type), intent(inout) :: s
        real(wp) :: turn, turn_low, high, low

        call turn_of_restraint(node%compliance, a%moment_left, a%moment_right, b%couple, turn, turn_low)
        if (takes_left(node%kind)) then
            high = turn
            low = turn_low
            call subtract(high, low, left%psi, left%psi_low)
            call end_row(high, low, left, b%left, merge(node%joint, 0.0_wp, node%kind == joint_right), a%moment_left, s%left)
            if (has_left) r%left = high + low
        end if
        if (takes_right(node%kind)) then
            high = right%psi
            low = right%psi_low
            call subtract(high, low, turn, turn_low)
            call end_row(high, low, right, b%right, merge(node%joint, 0.0_wp, node%kind == joint_left), a%moment_right, s%right)
            if (has_right) r%right = high + low
        end if

    contains

        !> What is given in a row, and what a joint turns on its side of the restraint
        pure subroutine end_row(high, low, beside, given, joint, moment, size_of_row)
            real(wp), intent(inout) :: high, low
            type(end_type), intent(in) :: beside
            !> Compliance of the joint, 0: none is there
            real(wp), intent(in) :: given, joint, moment
            real(wp), intent(out) :: size_of_row

            call add(high, low, given)
            size_of_row = beside%size_of_psi + abs(turn) + abs(given)
            if (.not. joint > 0.0_wp) return
            call add_product(high, low, joint, moment)
            size_of_row = size_of_row + joint*abs(moment)
        end subroutine end_row

    end subroutine residual_of_restraint

    !> The same numbers at the inner nodes of a plain beam without couples, some nodes at a time side by side in wide registers
    pure subroutine residual_inside(nodes, links, rhs, moment, deflection, turn, shear)
        !> As for residual_chain
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        !> A solution, shape (0:n): moments just inside the ends, deflections
        real(wp), intent(in), contiguous :: moment(0:), deflection(0:)
        !> Residuals of compatibility and of equilibrium, or of the known deflection, shape (0:n); those at the ends are not set
        real(wp), intent(inout), contiguous :: turn(0:), shear(0:)
        real(wp), dimension(cache_block + 1) :: length, faa, fab, fbb
        real(wp), dimension(cache_block) :: left, right, force, known, stiffness, held
        integer :: from, to, i, m

        if (checked) call require(all(nodes(1:size(links) - 1)%kind == plain), "residual_inside: nodes")
        do from = 1, size(links) - 1, cache_block
            to = min(from + cache_block - 1, size(links) - 1)
            m = to - from + 1
            do i = from, to + 1
                length(i - from + 1) = links(i)%length
                faa(i - from + 1) = links(i)%faa
                fab(i - from + 1) = links(i)%fab
                fbb(i - from + 1) = links(i)%fbb
            end do
            do i = from, to
                left(i - from + 1) = rhs(i)%left
                right(i - from + 1) = rhs(i)%right
                force(i - from + 1) = rhs(i)%shear
                known(i - from + 1) = rhs(i)%deflection
                stiffness(i - from + 1) = nodes(i)%stiffness
                held(i - from + 1) = merge(1.0_wp, 0.0_wp, nodes(i)%held)
            end do
            call residual_of_block(m, length, faa, fab, fbb, left, right, force, known, stiffness, held, &
                                   moment(from - 1:to + 1), deflection(from - 1:to + 1), turn(from:to), shear(from:to))
        end do
    end subroutine residual_inside

    !> Rotations and shear at the two ends of a link
    pure subroutine ends_of_link(link, a, b, end_a, end_b)
        type(link_type), intent(in) :: link
        type(answer_type), intent(in) :: a, b
        type(end_type), intent(out) :: end_a, end_b
        real(wp) :: size_of_turn

        call divide_difference(b%deflection, a%deflection, link%length, end_a%psi, end_a%psi_low)
        end_b%psi = end_a%psi
        end_b%psi_low = end_a%psi_low
        call add_product(end_a%psi, end_a%psi_low, link%faa, a%moment_right)
        call add_product(end_a%psi, end_a%psi_low, link%fab, b%moment_left)
        call add_product(end_b%psi, end_b%psi_low, -link%fab, a%moment_right)
        call add_product(end_b%psi, end_b%psi_low, -link%fbb, b%moment_left)
        call divide_difference(b%moment_left, a%moment_right, link%length, end_a%shear, end_a%shear_low)
        end_b%shear = end_a%shear
        end_b%shear_low = end_a%shear_low
        size_of_turn = difference_size(b%deflection, a%deflection)/link%length
        end_a%size_of_psi = size_of_turn + link%faa*abs(a%moment_right) + abs(link%fab*b%moment_left)
        end_b%size_of_psi = size_of_turn + abs(link%fab*a%moment_right) + link%fbb*abs(b%moment_left)
        end_a%size_of_shear = difference_size(b%moment_left, a%moment_right)/link%length
        end_b%size_of_shear = end_a%size_of_shear
    end subroutine ends_of_link

    !> A difference, and what double-double arithmetic may lose of it
    elemental function difference_size(x, y) result(total)
        real(wp), intent(in) :: x, y
        real(wp) :: total

        total = abs(x - y) + epsilon(x)*(abs(x) + abs(y))
    end function difference_size

    include 'elimination/turn_of_restraint.inc'
    include 'elimination/residual_along.inc'
    include 'elimination/double_double.inc'

end module gapbeam_residual
