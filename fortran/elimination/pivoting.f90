!> The mixed system solved by a band solver with pivoting.
!>
!> gapbeam_band needs no pivoting but for one case, a rigid beam over rigid supports, where a flexibility used
!> as pivot is exactly zero. Rows, unknowns and signs are those of gapbeam_band; a node with a rotational
!> restraint has a third unknown, its second moment, which is known where a hinge is beside the restraint. Half bandwidth 3.
module gapbeam_pivoting
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: pivot_hair
    use gapbeam_link, only: link_type
    use gapbeam_nodes, only: hinge, restrained, jointed, hinge_left, hinge_right, joint_left, joint_right, &
        is_restrained, takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_band_solver, only: solve_band
    implicit none
    private
    public :: solve_pivoting, count_unstable

    !> Half bandwidth of the mixed system
    integer, parameter :: half_bandwidth = 3

contains

    !> Assemble, factor with pivoting, solve and refine
    subroutine solve_pivoting(nodes, links, rhs, answers, regular)
        !> Nodes as the contact state sees them, shape (0:n), and the links between them
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        !> Right-hand side, shape (0:n)
        type(rhs_type), intent(in) :: rhs(0:)
        !> Deflections and moments, shape (0:n)
        type(answer_type), intent(inout) :: answers(0:)
        !> False where the matrix is singular to working precision
        logical, intent(out) :: regular
        real(wp), allocatable :: matrix(:, :), b(:), x(:)
        integer, allocatable :: left(:), deflection(:), right(:)
        integer :: n, unknowns, i

        n = size(links)
        call number_unknowns(nodes, left, deflection, right, unknowns)
        allocate (matrix(2*half_bandwidth + 1, unknowns), b(unknowns), x(unknowns))
        call assemble(nodes, links, rhs, left, deflection, right, matrix, b)
        call solve_band(half_bandwidth, matrix, b, x, regular)
        if (.not. regular) return
        do i = 0, n
            answers(i)%deflection = merge(rhs(i)%deflection, x(deflection(i)), nodes(i)%held)
            answers(i)%moment_left = x(left(i))
            if (right(i) /= left(i)) then
                answers(i)%moment_right = x(right(i))
            else
                answers(i)%moment_right = x(left(i)) + jump(nodes, rhs, i)
            end if
        end do
        ! The outer sides of the two ends carry no moment; the unknown there is the inner one
        answers(0)%moment_right = x(left(0))
        answers(0)%moment_left = 0.0_wp
        answers(n)%moment_right = 0.0_wp
    end subroutine solve_pivoting

    !> In how many independent ways the beam gives way by itself where springs push back less the more they are pressed: the
    !> negative eigenvalues of its stiffness. The mixed matrix is symmetric and has one more for every moment (Haynsworth 1968),
    !> and elimination shows how many (Sylvester's law of inertia)
    subroutine count_unstable(nodes, links, index)
        !> As for solve_pivoting; the system must be regular
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        integer, intent(out) :: index
        type(rhs_type), allocatable :: rhs(:)
        real(wp), allocatable :: matrix(:, :), b(:)
        integer, allocatable :: left(:), deflection(:), right(:)
        logical, allocatable :: known(:)
        real(wp) :: multiplier, size_of_pivot
        integer :: n, unknowns, i, j, k

        n = size(links)
        call number_unknowns(nodes, left, deflection, right, unknowns)
        allocate (matrix(2*half_bandwidth + 1, unknowns), b(unknowns), known(unknowns), rhs(0:n))
        call assemble(nodes, links, rhs, left, deflection, right, matrix, b)
        known(:) = .false.
        do i = 0, n
            known(deflection(i)) = nodes(i)%held
            known(left(i)) = nodes(i)%kind == hinge .or. nodes(i)%kind == hinge_right &
                .or. ((i == 0 .or. i == n) .and. nodes(i)%kind /= restrained)
            if (nodes(i)%kind == hinge_left) known(right(i)) = .true.
        end do
        index = 0
        do k = 1, unknowns
            if (known(k)) cycle
            size_of_pivot = 0.0_wp
            do i = max(1, k - half_bandwidth), min(unknowns, k + half_bandwidth)
                if (.not. known(i)) size_of_pivot = max(size_of_pivot, abs(matrix(half_bandwidth + 1 + i - k, k)))
            end do
            associate (pivot => matrix(half_bandwidth + 1, k))
                if (abs(pivot) <= pivot_hair*epsilon(pivot)*size_of_pivot) pivot = pivot_hair*size_of_pivot
                if (pivot < 0.0_wp) index = index + 1
                do i = k + 1, min(unknowns, k + half_bandwidth)
                    if (known(i)) cycle
                    multiplier = matrix(half_bandwidth + 1 + i - k, k)/pivot
                    do j = i, min(unknowns, k + half_bandwidth)
                        ! Symmetric: the part below the diagonal is enough
                        matrix(half_bandwidth + 1 + j - i, i) = matrix(half_bandwidth + 1 + j - i, i) &
                            - multiplier*matrix(half_bandwidth + 1 + j - k, k)
                    end do
                end do
            end associate
        end do
        do i = 0, n
            if (.not. known(left(i))) index = index - 1
            if (right(i) /= left(i) .and. .not. known(right(i))) index = index - 1
        end do
    end subroutine count_unstable

    !> Numbers of the unknowns of the nodes
    subroutine number_unknowns(nodes, left, deflection, right, unknowns)
        type(node_type), intent(in) :: nodes(0:)
        !> Moment left of a node, its deflection, the moment right of it (the same but at restraints inside), shape (0:n)
        integer, allocatable, intent(out) :: left(:), deflection(:), right(:)
        integer, intent(out) :: unknowns
        integer :: i, n

        n = ubound(nodes, 1)
        allocate (left(0:n), deflection(0:n), right(0:n))
        unknowns = 0
        do i = 0, n
            unknowns = unknowns + 1
            left(i) = unknowns
            unknowns = unknowns + 1
            deflection(i) = unknowns
            right(i) = left(i)
            if (is_restrained(nodes(i)%kind) .and. i > 0 .and. i < n) then
                unknowns = unknowns + 1
                right(i) = unknowns
            end if
        end do
    end subroutine number_unknowns

    !> Band matrix in LAPACK's storage: element (i, j) in row half_bandwidth + 1 + i - j of column j
    subroutine assemble(nodes, links, rhs, left, deflection, right, matrix, b)
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        integer, intent(in) :: left(0:), deflection(0:), right(0:)
        real(wp), intent(out) :: matrix(:, :), b(:)
        integer :: i, n

        n = size(links)
        matrix = 0.0_wp
        b = 0.0_wp
        do i = 0, n
            call moment_rows(i)
            call deflection_row(i)
        end do

    contains

        !> Compatibility, or the moment where it is known
        subroutine moment_rows(i)
            integer, intent(in) :: i

            associate (node => nodes(i), r => rhs(i))
                if (is_restrained(node%kind)) then
                    if (i > 0 .and. takes_left(node%kind)) then
                        call add_rotation(left(i), i, 1.0_wp, links(i)%fab, links(i)%fbb)
                        call put(left(i), left(i), -node%compliance)
                        if (node%kind == joint_right) call put(left(i), left(i), -node%joint)
                        if (i < n) call put(left(i), right(i), node%compliance)
                        b(left(i)) = b(left(i)) + r%left + node%compliance*r%couple
                    end if
                    if (i < n .and. takes_right(node%kind)) then
                        if (i > 0) call put(right(i), left(i), node%compliance)
                        call put(right(i), right(i), -node%compliance)
                        if (node%kind == joint_left) call put(right(i), right(i), -node%joint)
                        call add_rotation(right(i), i + 1, -1.0_wp, links(i + 1)%faa, links(i + 1)%fab)
                        b(right(i)) = b(right(i)) + r%right - node%compliance*r%couple
                    end if
                    if (node%kind == hinge_left) call know(right(i), r%moment, matrix, b)
                    if (node%kind == hinge_right) call know(left(i), r%moment, matrix, b)
                else if (i == 0 .or. i == n) then
                    call know(left(i), merge(r%couple, -r%couple, i == 0), matrix, b)
                else if (node%kind == hinge) then
                    call know(left(i), r%moment, matrix, b)
                else
                    call add_rotation(left(i), i, 1.0_wp, links(i)%fab, links(i)%fbb)
                    call add_rotation(left(i), i + 1, -1.0_wp, links(i + 1)%faa, links(i + 1)%fab)
                    if (node%kind == jointed) call put(left(i), left(i), -node%compliance)
                    b(left(i)) = b(left(i)) + r%left + r%right
                end if
            end associate
        end subroutine moment_rows

        !> Equilibrium, or the deflection where it is known
        subroutine deflection_row(i)
            integer, intent(in) :: i

            associate (row => deflection(i), r => rhs(i))
                if (nodes(i)%held) then
                    call know(row, r%deflection, matrix, b)
                    return
                end if
                b(row) = r%shear
                call put(row, row, nodes(i)%stiffness)
                if (i > 0) then
                    call put(row, left(i), 1/links(i)%length)
                    call put(row, right(i - 1), -1/links(i)%length)
                    b(row) = b(row) + jump(nodes, rhs, i - 1)/links(i)%length
                end if
                if (i < n) then
                    call put(row, left(i + 1), -1/links(i + 1)%length)
                    call put(row, right(i), 1/links(i + 1)%length)
                    b(row) = b(row) - jump(nodes, rhs, i)/links(i + 1)%length
                end if
            end associate
        end subroutine deflection_row

        subroutine put(i, j, value)
            integer, intent(in) :: i, j
            real(wp), intent(in) :: value

            matrix(half_bandwidth + 1 + i - j, j) = matrix(half_bandwidth + 1 + i - j, j) + value
        end subroutine put

        !> Rotation at an end of link k, or minus that
        subroutine add_rotation(row, k, sign, by_left, by_right)
            integer, intent(in) :: row, k
            !> 1 or -1; by how much the moments at its ends turn it
            real(wp), intent(in) :: sign, by_left, by_right

            call put(row, deflection(k), sign/links(k)%length)
            call put(row, deflection(k - 1), -sign/links(k)%length)
            call put(row, right(k - 1), -by_left)
            call put(row, left(k), -by_right)
            b(row) = b(row) + by_left*jump(nodes, rhs, k - 1)
        end subroutine add_rotation

    end subroutine assemble

    !> The row of an unknown that is known
    pure subroutine know(row, value, matrix, b)
        integer, intent(in) :: row
        real(wp), intent(in) :: value
        real(wp), intent(inout) :: matrix(:, :), b(:)

        matrix(half_bandwidth + 1, row) = matrix(half_bandwidth + 1, row) + 1.0_wp
        b(row) = value
    end subroutine know

    !> Moment right of a node minus the unknown that stands for it
    pure function jump(nodes, rhs, k) result(couple)
        type(node_type), intent(in) :: nodes(0:)
        type(rhs_type), intent(in) :: rhs(0:)
        integer, intent(in) :: k
        real(wp) :: couple

        couple = 0.0_wp
        if (.not. is_restrained(nodes(k)%kind) .and. k > 0) couple = rhs(k)%couple
    end function jump

end module gapbeam_pivoting
