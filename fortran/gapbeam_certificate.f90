!> How good a result is: a bound of its error from residuals and the condition of the factor.
!>
!> With the residual r in twice the working precision, and coefficients and loads known to some units in the last place,
!> the error of the solution x of K x = b is at most |K^-1| (|r| + gamma eps s), row by row, s the sum of the absolute values
!> of the row's terms (Oettli and Prager 1964; the bound LAPACK's dgbrfs gives, but for differences that are one term). The
!> largest entry of L |K^-1| g, for deflections and for reactions, is a norm of diag(g) K^-1 L', estimated with a few
!> solves (Higham 1988, LAPACK's dlacn2).
module gapbeam_certificate
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, pivot_type, rhs_type, answer_type, solve_chain, plain, restrained
    use gapbeam_residual, only: size_type
    use gapbeam_lapack, only: estimate_type, estimate_norm, solve_pivoting
    implicit none
    private
    public :: bound_errors

    !> Units in the last place that coefficients and loads may be off: they are sums of products of the scene's numbers
    real(wp), parameter :: gamma = 8.0_wp
    !> The estimate of the norm is a lower bound, hardly ever more than three times too small
    real(wp), parameter :: safety = 3.0_wp

contains

    !> Bounds for the errors of deflections and of reactions
    subroutine bound_errors(nodes, links, pivots, pivoting, residual, sizes, deflection_bound, reaction_bound)
        !> System and factor of the scheme, see gapbeam_band; is there no factor, so that every solve is one with pivoting
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(pivot_type), intent(in) :: pivots(0:)
        logical, intent(in) :: pivoting
        !> Residuals and sizes of the rows, see gapbeam_residual
        type(rhs_type), intent(in) :: residual(0:)
        type(size_type), intent(in) :: sizes(0:)
        !> Largest error any deflection of a node, and any reaction, can have
        real(wp), intent(out) :: deflection_bound, reaction_bound
        real(wp), allocatable :: weight(:, :)
        integer :: n

        n = size(links)
        allocate (weight(3, 0:n))
        call row_weights(nodes, residual, sizes, weight)
        deflection_bound = safety*norm(.false.)
        ! Held nodes have no row in the system, but their loads and shears go into the reactions
        reaction_bound = safety*norm(.true.) + gamma*epsilon(1.0_wp)*maxval(merge(sizes%shear, 0.0_wp, nodes%held))

    contains

        !> Norm of diag(weight) K^-1 L', L giving deflections or reactions
        function norm(of_reactions) result(largest)
            logical, intent(in) :: of_reactions
            real(wp) :: largest
            type(estimate_type) :: estimate
            real(wp), allocatable :: x(:)
            type(rhs_type), allocatable :: rhs(:)
            type(answer_type), allocatable :: answers(:)

            allocate (x(3*(n + 1)), rhs(0:n), answers(0:n))
            x = 0.0_wp
            largest = 0.0_wp
            do
                call estimate_norm(estimate, x, largest)
                if (estimate%wanted == 0) exit
                if (estimate%wanted == 1) then
                    call spread_functional(nodes, links, of_reactions, x, rhs)
                    call solve(rhs, answers)
                    call weigh_answers(weight, answers, x)
                else
                    call weigh_rows(weight, x, rhs)
                    call solve(rhs, answers)
                    call take_functional(links, of_reactions, answers, x)
                end if
            end do
        end function norm

        !> K^-1 times a right-hand side
        subroutine solve(rhs, answers)
            type(rhs_type), intent(inout) :: rhs(0:)
            type(answer_type), intent(inout) :: answers(0:)
            logical :: regular

            answers = answer_type()
            if (pivoting) then
                call solve_pivoting(nodes, links, rhs, answers, regular)
            else
                call solve_chain(nodes, links, pivots, rhs, answers)
            end if
        end subroutine solve

    end subroutine bound_errors

    !> Largest change of every row: residual and what its terms may be off
    pure subroutine row_weights(nodes, residual, sizes, weight)
        type(node_type), intent(in) :: nodes(0:)
        type(rhs_type), intent(in) :: residual(0:)
        type(size_type), intent(in) :: sizes(0:)
        real(wp), intent(out) :: weight(:, 0:)
        integer :: i, n

        n = ubound(nodes, 1)
        do i = 0, n
            associate (r => residual(i), s => sizes(i))
                weight(1, i) = abs(r%left) + gamma*epsilon(1.0_wp)*s%left
                weight(2, i) = abs(r%right) + gamma*epsilon(1.0_wp)*s%right
                weight(3, i) = abs(r%shear) + gamma*epsilon(1.0_wp)*s%shear
                if (nodes(i)%held) weight(3, i) = 0.0_wp
            end associate
        end do
    end subroutine row_weights

    !> L' x as a right-hand side
    subroutine spread_functional(nodes, links, of_reactions, x, rhs)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        logical, intent(in) :: of_reactions
        real(wp), intent(in) :: x(:)
        type(rhs_type), intent(out) :: rhs(0:)
        real(wp) :: shear
        integer :: i, n

        n = size(links)
        if (of_reactions) then
            ! The shear of a link pulls at the node to its right and carries the one to its left
            do i = 1, n
                shear = (x(3*i) - x(3*i + 3))/links(i)%length
                call add_moment(i, .true., shear)
                call add_moment(i - 1, .false., -shear)
            end do
        else
            do i = 0, n
                if (.not. nodes(i)%held) rhs(i)%shear = x(3*i + 3)
            end do
        end if

    contains

        !> Into the row that belongs to the moment left or right of a node; nowhere if that moment is known
        subroutine add_moment(k, left, amount)
            integer, intent(in) :: k
            logical, intent(in) :: left
            real(wp), intent(in) :: amount

            if (nodes(k)%kind == restrained .and. left) then
                rhs(k)%left = rhs(k)%left + amount
            else if (nodes(k)%kind == restrained .or. (nodes(k)%kind == plain .and. k > 0 .and. k < n)) then
                rhs(k)%right = rhs(k)%right + amount
            end if
        end subroutine add_moment

    end subroutine spread_functional

    !> L times a solution
    pure subroutine take_functional(links, of_reactions, answers, x)
        type(link_type), intent(in) :: links(:)
        logical, intent(in) :: of_reactions
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(out) :: x(:)
        real(wp) :: shear
        integer :: i

        x = 0.0_wp
        if (of_reactions) then
            do i = 1, size(links)
                shear = (answers(i)%moment_left - answers(i - 1)%moment_right)/links(i)%length
                x(3*i) = x(3*i) + shear
                x(3*i + 3) = -shear
            end do
        else
            do i = 0, size(links)
                x(3*i + 3) = answers(i)%deflection
            end do
        end if
    end subroutine take_functional

    !> Rows weighted, as a right-hand side
    pure subroutine weigh_rows(weight, x, rhs)
        real(wp), intent(in) :: weight(:, 0:), x(:)
        type(rhs_type), intent(out) :: rhs(0:)
        integer :: i

        do i = 0, ubound(rhs, 1)
            rhs(i)%left = weight(1, i)*x(3*i + 1)
            rhs(i)%right = weight(2, i)*x(3*i + 2)
            rhs(i)%shear = weight(3, i)*x(3*i + 3)
        end do
    end subroutine weigh_rows

    !> A solution weighted, unknown by unknown as the rows
    pure subroutine weigh_answers(weight, answers, x)
        real(wp), intent(in) :: weight(:, 0:)
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(out) :: x(:)
        integer :: i

        do i = 0, ubound(answers, 1)
            x(3*i + 1) = weight(1, i)*answers(i)%moment_left
            x(3*i + 2) = weight(2, i)*answers(i)%moment_right
            x(3*i + 3) = weight(3, i)*answers(i)%deflection
        end do
    end subroutine weigh_answers

end module gapbeam_certificate
