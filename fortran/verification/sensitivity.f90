!> How far results move when the data change in their last digits.
!>
!> Places, loads and contact levels are sums of the scene's numbers, rounded to doubles, so every coefficient and load of the
!> system K x = b may be off by some units in the last place, whatever precision it is solved in. The solution then moves by
!> at most |K^-1| eps s, row by row, s the sum of the absolute values of the row's terms (Oettli and Prager 1964), a
!> difference of neighbours being one term. The largest entry of L |K^-1| s, L giving deflections, say, is a norm of
!> diag(s) K^-1 L', estimated with a few solves (Higham 1988, LAPACK's dlacn2); a single entry takes one.
module gapbeam_sensitivity
    use gapbeam_kinds, only: wp, dp
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, rhs_type, answer_type, factor_chain, solve_chain, plain, restrained, band_mechanism, &
        band_needs_pivoting
    use gapbeam_residual, only: residual_chain
    use gapbeam_pivoting, only: solve_pivoting
    use gapbeam_law, only: margin_rates
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type
    implicit none
    private
    public :: sensitivity_type, prepare_sensitivity, largest_movement, movement_of_support
    public :: of_deflections, of_rotations, of_moments, of_shears, of_reactions

    !> Results
    integer, parameter :: of_deflections = 1, of_rotations = 2, of_moments = 3, of_shears = 4, of_reactions = 5

    !> What it takes to find movements
    type :: sensitivity_type
        !> Is there a unique solution, so that there are any; is there no factor, so that every solve is one with pivoting
        logical :: known = .false., pivoting = .false.
        !> Movements of the rows: compatibility left and right of the nodes, equilibrium; of the levels of held nodes, sums that are
        !> rounded once; shape (4, 0:n)
        real(wp), allocatable :: weight(:, :)
        !> What loads and shears at held nodes may be off: they go into the reactions only
        real(wp) :: at_held = 0.0_wp
        !> What couples at nodes may be off: moments beside them, and shears of links, that follow from them directly
        real(wp) :: of_couple = 0.0_wp, of_couple_shear = 0.0_wp
    end type sensitivity_type

contains

    !> Find by how much the rows may be off
    subroutine prepare_sensitivity(beam, factor, work, sensitivity)
        !> The beam and the factor of its live loads
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> With a solved scheme in, its factor out
        type(workspace_type), intent(inout) :: work
        type(sensitivity_type), intent(out) :: sensitivity
        integer :: state, place, i, n
        real(wp) :: compatibility, equilibrium

        n = size(beam%links)
        state = band_needs_pivoting
        if (.not. any(work%nodes%stiffness < 0.0_wp)) call factor_chain(work%nodes, beam%links, work%pivots, state, place)
        if (state == band_mechanism) return
        sensitivity%known = .true.
        sensitivity%pivoting = state == band_needs_pivoting
        call residual_chain(work%nodes, beam%links, work%rhs, work%answers, work%eliminated, work%sizes, compatibility, &
                            equilibrium)
        call add_load_sizes(beam, factor, work)
        call add_couple_sizes(beam, factor, work, sensitivity)
        allocate (sensitivity%weight(4, 0:n))
        do i = 0, n
            associate (s => work%sizes(i), weight => sensitivity%weight(:, i))
                weight = epsilon(1.0_dp)*[s%left, s%right, s%shear, abs(work%answers(i)%deflection)/2]
                if (work%nodes(i)%held) then
                    sensitivity%at_held = max(sensitivity%at_held, weight(3))
                    weight(3) = 0.0_wp
                else
                    weight(4) = 0.0_wp
                end if
            end associate
        end do
    end subroutine prepare_sensitivity

    !> Loads that cancel in a row are as uncertain as each of them
    pure subroutine add_load_sizes(beam, factor, work)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        type(workspace_type), intent(inout) :: work
        real(wp) :: share(2), turn
        integer :: i

        share = [1.0_wp, abs(factor)]
        do i = 0, size(beam%links)
            work%sizes(i)%shear = work%sizes(i)%shear + dot_product(share, abs(beam%force(:, i)))
        end do
        do i = 1, size(beam%links)
            associate (a => work%sizes(i - 1), b => work%sizes(i), link => beam%links(i))
                a%shear = a%shear + dot_product(share, link%load_sum)
                b%shear = b%shear + dot_product(share, link%load_sum)
                turn = dot_product(share, link%turn_sum)
                ! Rows without compatibility have no term of it
                if (a%right > 0.0_wp) a%right = a%right + turn
                if (b%left > 0.0_wp) then
                    b%left = b%left + turn
                else if (b%right > 0.0_wp) then
                    b%right = b%right + turn
                end if
            end associate
        end do
    end subroutine add_load_sizes

    !> So are couples at nodes: they are the step of the moment there, and what one side of it does to its link is as uncertain
    pure subroutine add_couple_sizes(beam, factor, work, sensitivity)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        type(workspace_type), intent(inout) :: work
        type(sensitivity_type), intent(inout) :: sensitivity
        real(wp) :: couple
        integer :: i, n

        n = size(beam%links)
        do i = 0, n
            couple = dot_product([1.0_wp, abs(factor)], abs(beam%couple(:, i)))
            if (.not. couple > 0.0_wp) cycle
            sensitivity%of_couple = max(sensitivity%of_couple, epsilon(1.0_dp)*couple)
            if (beam%kind(i) == restrained) then
                call add_turn(i, .true., work, beam%compliance(i)*couple)
                call add_turn(i, .false., work, beam%compliance(i)*couple)
            else
                associate (k => min(i + 1, n))
                    associate (link => beam%links(k), a => work%sizes(k - 1), b => work%sizes(k))
                        call add_turn(k - 1, .false., work, merge(link%faa, abs(link%fab), i < n)*couple)
                        call add_turn(k, .true., work, merge(abs(link%fab), link%fbb, i < n)*couple)
                        a%shear = a%shear + couple*link%inverse
                        b%shear = b%shear + couple*link%inverse
                        sensitivity%of_couple_shear = max(sensitivity%of_couple_shear, epsilon(1.0_dp)*couple*link%inverse)
                    end associate
                end associate
            end if
        end do

    contains

        !> A rotation left or right of a node, if there is a row for it
        pure subroutine add_turn(k, left, work, turn)
            integer, intent(in) :: k
            logical, intent(in) :: left
            type(workspace_type), intent(inout) :: work
            real(wp), intent(in) :: turn

            associate (s => work%sizes(k))
                if (beam%kind(k) == restrained .and. left) then
                    s%left = s%left + turn
                else if (beam%kind(k) == restrained .or. (beam%kind(k) == plain .and. k > 0 .and. k < n)) then
                    s%right = s%right + turn
                end if
            end associate
        end subroutine add_turn

    end subroutine add_couple_sizes

    !> The most that any result of a kind moves
    subroutine largest_movement(beam, sensitivity, kind, work, movement)
        !> The beam, and what prepare_sensitivity found
        type(beam_type), intent(in) :: beam
        type(sensitivity_type), intent(in) :: sensitivity
        !> of_deflections, ...
        integer, intent(in) :: kind
        !> With the factor
        type(workspace_type), intent(inout) :: work
        real(wp), intent(out) :: movement
        real(wp), allocatable :: x(:), image(:)
        type(rhs_type), allocatable :: rhs(:), result(:)
        integer :: n, turn, j, last

        ! Higham's estimate of the 1-norm of diag(weight) K^-1 L': the signs of an image lead to a unit vector with a larger one
        n = size(beam%links)
        allocate (x(4*(n + 1)), image(4*(n + 1)), rhs(0:n), result(0:n))
        x(:) = 1.0_wp/size(x)
        movement = 0.0_wp
        last = 0
        do turn = 1, 5
            call spread(x, rhs)
            call solve(rhs)
            image(:) = reshape(weighed(), [size(image)])
            if (sum(abs(image)) <= movement .and. turn > 1) exit
            movement = max(movement, sum(abs(image)))
            image(:) = merge(1.0_wp, -1.0_wp, image >= 0.0_wp)
            call weigh(image, rhs)
            call solve(rhs)
            call take(x)
            j = maxloc(abs(x), 1)
            if (j == last) exit
            last = j
            x(:) = 0.0_wp
            x(j) = 1.0_wp
        end do
        ! And the alternating vector that deceives no cancellation
        x(:) = [((-1)**j*(1 + real(j - 1, wp)/max(1, size(x) - 1)), j=1, size(x))]
        call spread(x, rhs)
        call solve(rhs)
        movement = max(movement, 2*sum(abs(weighed()))/(3*size(x)))
        if (kind == of_reactions) movement = movement + sensitivity%at_held
        if (kind == of_moments) movement = movement + sensitivity%of_couple
        if (kind == of_shears) movement = movement + sensitivity%of_couple_shear

    contains

        !> L' x as a right-hand side
        subroutine spread(x, rhs)
            real(wp), intent(in) :: x(:)
            type(rhs_type), intent(out) :: rhs(0:)
            integer :: i

            do i = 0, n
                call add_functional(beam, work%nodes, kind, i, x(4*i + 1:4*i + 4), rhs)
            end do
            result(:) = rhs
        end subroutine spread

        !> K^-1 times a right-hand side, into the correction
        subroutine solve(rhs)
            type(rhs_type), intent(inout) :: rhs(0:)
            logical :: regular

            call solve_again(beam%links, sensitivity, work, rhs, regular)
        end subroutine solve

        pure function weighed() result(image)
            real(wp) :: image(4, 0:n)

            image = effects(beam, work%nodes, result, work%correction)*sensitivity%weight
        end function weighed

        !> Rows weighted, as a right-hand side
        subroutine weigh(image, rhs)
            real(wp), intent(in) :: image(4, 0:n)
            type(rhs_type), intent(out) :: rhs(0:)

            rhs%left = sensitivity%weight(1, :)*image(1, :)
            rhs%right = sensitivity%weight(2, :)*image(2, :)
            rhs%shear = sensitivity%weight(3, :)*image(3, :)
            rhs%deflection = sensitivity%weight(4, :)*image(4, :)
        end subroutine weigh

        !> L times the correction
        subroutine take(x)
            real(wp), intent(out) :: x(:)
            integer :: i

            do i = 0, n
                x(4*i + 1:4*i + 4) = functional_of(beam, work%nodes, kind, i, work%correction)
            end do
        end subroutine take

    end subroutine largest_movement

    !> By how much the reaction or opening of a support moves
    subroutine movement_of_support(beam, sensitivity, closed, k, work, movement)
        type(beam_type), intent(in) :: beam
        type(sensitivity_type), intent(in) :: sensitivity
        !> The scheme, and the number of the support
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        type(workspace_type), intent(inout) :: work
        real(wp), intent(out) :: movement
        type(rhs_type), allocatable :: rhs(:), result(:)
        real(wp) :: rate, level
        logical :: regular, is_force
        integer :: i

        allocate (rhs(0:size(beam%links)))
        i = beam%supports(k)%node
        call margin_rates(beam%supports, closed, k, rate, level, is_force)
        associate (by_force => is_force .and. work%nodes(i)%held)
            call add_functional(beam, work%nodes, merge(of_reactions, of_deflections, by_force), i, &
                                [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], rhs)
            allocate (result(0:size(beam%links)))
            result(:) = rhs
            call solve_again(beam%links, sensitivity, work, rhs, regular)
            movement = sum(sensitivity%weight*abs(effects(beam, work%nodes, result, work%correction)))
            if (by_force) then
                movement = movement + epsilon(1.0_dp)*work%sizes(i)%shear
            else
                movement = rate*movement + rate*epsilon(1.0_dp)*level
            end if
        end associate
        if (.not. regular) movement = huge(movement)
    end subroutine movement_of_support

    !> K^-1 times a right-hand side, into the correction
    subroutine solve_again(links, sensitivity, work, rhs, regular)
        type(link_type), intent(in) :: links(:)
        type(sensitivity_type), intent(in) :: sensitivity
        type(workspace_type), intent(inout) :: work
        type(rhs_type), intent(inout) :: rhs(0:)
        logical, intent(out) :: regular

        work%correction = answer_type()
        regular = .true.
        if (sensitivity%pivoting) then
            call solve_pivoting(work%nodes, links, rhs, work%correction, regular)
        else
            call solve_chain(work%nodes, links, work%pivots, rhs, work%correction)
        end if
    end subroutine solve_again

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

            if (nodes(k)%kind == restrained .and. left) then
                rhs(k)%left = rhs(k)%left + amount
            else if (nodes(k)%kind == restrained .or. (nodes(k)%kind == plain .and. k > 0 .and. k < n)) then
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

end module gapbeam_sensitivity
