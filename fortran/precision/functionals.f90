!> Results at nodes as linear functionals of the solution of the mixed system.
!>
!> A deflection, a moment, a shear, a rotation or a reaction is l'x of the solution x of K x = b. K is symmetric, so K^-1 l, the
!> solution with the functional as right-hand side, is how much the result moves when a row is off by one.
module gapbeam_functionals
    use gapbeam_kinds, only: wp
    use gapbeam_nodes, only: is_through, takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_model, only: beam_type
    implicit none
    private
    public :: add_functional, functional_of, effects
    public :: of_deflections, of_rotations, of_moments, of_shears, of_reactions

    !> Results
    integer, parameter :: of_deflections = 1, of_rotations = 2, of_moments = 3, of_shears = 4, of_reactions = 5

contains

    !> What a result moves when a row, or the level of a held node, is off by one: the solution whose right-hand side it is, and at
    !> held nodes how its shear jumps there, and what the result has of the level itself
    pure function effects(beam, nodes, of, solution) result(effect)
        type(beam_type), intent(in) :: beam
        type(node_type), intent(in) :: nodes(0:)
        !> The result as a right-hand side, by add_functional, and its solution
        type(rhs_type), intent(in) :: of(0:)
        type(answer_type), intent(in) :: solution(0:)
        real(wp) :: effect(4, 0:size(beam%links))
        real(wp), dimension(0:size(beam%links) + 1) :: shear, error
        real(wp), dimension(0:size(beam%links)) :: change, passed
        integer :: i, n

        n = size(beam%links)
        shear(:) = 0.0_wp
        error(:) = 0.0_wp
        do i = 1, n
            associate (a => solution(i - 1)%moment_right, b => solution(i)%moment_left)
                shear(i) = (b - a)*beam%links(i)%inverse
                error(i) = (abs(b) + abs(a))*beam%links(i)%inverse
            end associate
        end do
        ! That of a short link is told better by its neighbour, as in find_shears of gapbeam_reactions
        change = nodes%stiffness*solution%deflection - of%shear
        passed = abs(nodes%stiffness*solution%deflection) + abs(of%shear)
        do i = 1, n - 1
            if (nodes(i)%held .or. error(i) + passed(i) >= error(i + 1)) cycle
            shear(i + 1) = shear(i) + change(i)
            error(i + 1) = error(i) + passed(i)
        end do
        do i = n - 1, 1, -1
            if (nodes(i)%held .or. error(i + 1) + passed(i) >= error(i)) cycle
            shear(i) = shear(i + 1) - change(i)
            error(i) = error(i + 1) + passed(i)
        end do
        do i = 0, n
            associate (s => solution(i))
                effect(:, i) = [s%moment_left, s%moment_right, s%deflection, 0.0_wp]
            end associate
            if (nodes(i)%held) effect(4, i) = of(i)%shear + (shear(i + 1) - shear(i))
        end do
    end function effects

    !> Add the results at a node (by default rotations), each times a factor, as the right-hand side whose solution they are a
    !> row of
    subroutine add_functional(beam, nodes, kind, i, x, rhs)
        type(beam_type), intent(in) :: beam
        type(node_type), intent(in) :: nodes(0:)
        integer, intent(in) :: kind, i
        !> Of the deflection or reaction; of the moments left and right; of shear, or of the rotations at both ends, of the link
        !> that follows
        real(wp), intent(in) :: x(4)
        type(rhs_type), intent(inout) :: rhs(0:)
        integer :: n

        n = size(beam%links)
        select case (kind)
        case (of_deflections)
            if (.not. nodes(i)%held) call add_deflection(i, x(1))
        case (of_reactions)
            if (i > 0) call add_shear(i, -x(1))
            if (i < n) call add_shear(i + 1, x(1))
        case (of_moments)
            call add_moment(i, .true., x(1))
            call add_moment(i, .false., x(2))
        case (of_shears)
            if (i < n) call add_shear(i + 1, x(1))
        case default
            if (i == n) return
            associate (link => beam%links(i + 1))
                call add_deflection(i + 1, (x(1) + x(2))*link%inverse)
                call add_deflection(i, -(x(1) + x(2))*link%inverse)
                call add_moment(i, .false., x(1)*link%faa - x(2)*link%fab)
                call add_moment(i + 1, .true., x(1)*link%fab - x(2)*link%fbb)
            end associate
        end select

    contains

        !> The shear of a link
        subroutine add_shear(k, amount)
            integer, intent(in) :: k
            real(wp), intent(in) :: amount

            call add_moment(k, .true., amount*beam%links(k)%inverse)
            call add_moment(k - 1, .false., -amount*beam%links(k)%inverse)
        end subroutine add_shear

        !> The deflection of a node; of a held one no row of the system has it
        subroutine add_deflection(k, amount)
            integer, intent(in) :: k
            real(wp), intent(in) :: amount

            rhs(k)%shear = rhs(k)%shear + amount
        end subroutine add_deflection

        !> The moment left or right of a node, in the row that belongs to it; nothing if that is known
        subroutine add_moment(k, left, amount)
            integer, intent(in) :: k
            logical, intent(in) :: left
            real(wp), intent(in) :: amount

            if (takes_left(nodes(k)%kind) .and. left) then
                rhs(k)%left = rhs(k)%left + amount
            else if ((takes_right(nodes(k)%kind) .and. .not. left) .or. (is_through(nodes(k)%kind) .and. k > 0 .and. k < n)) then
                rhs(k)%right = rhs(k)%right + amount
            end if
        end subroutine add_moment

    end subroutine add_functional

    !> The results at a node, see add_functional
    pure function functional_of(beam, nodes, kind, i, answers) result(x)
        type(beam_type), intent(in) :: beam
        type(node_type), intent(in) :: nodes(0:)
        integer, intent(in) :: kind, i
        type(answer_type), intent(in) :: answers(0:)
        real(wp) :: x(4), slope
        integer :: n

        n = size(beam%links)
        x(:) = 0.0_wp
        select case (kind)
        case (of_deflections)
            if (.not. nodes(i)%held) x(1) = answers(i)%deflection
        case (of_reactions)
            if (i > 0) x(1) = x(1) - shear(i)
            if (i < n) x(1) = x(1) + shear(i + 1)
        case (of_moments)
            x(1:2) = [answers(i)%moment_left, answers(i)%moment_right]
        case (of_shears)
            if (i < n) x(1) = shear(i + 1)
        case default
            if (i == n) return
            associate (link => beam%links(i + 1), a => answers(i), b => answers(i + 1))
                slope = (b%deflection - a%deflection)*link%inverse
                x(1:2) = [slope + link%faa*a%moment_right + link%fab*b%moment_left, &
                          slope - link%fab*a%moment_right - link%fbb*b%moment_left]
            end associate
        end select

    contains

        pure function shear(k)
            integer, intent(in) :: k
            real(wp) :: shear

            shear = (answers(k)%moment_left - answers(k - 1)%moment_right)*beam%links(k)%inverse
        end function shear

    end function functional_of

end module gapbeam_functionals
