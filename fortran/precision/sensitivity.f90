!> Sensitivity of results to the last digits of the data.
!>
!> Places, loads and contact levels are sums of the scene's numbers, rounded to doubles, so every coefficient and load of the
!> system K x = b may be off by some units in the last place, whatever precision it is solved in. The solution then moves by
!> at most |K^-1| eps s, row by row, s the sum of the absolute values of the row's terms (Oettli and Prager 1964), a
!> difference of neighbours being one term. The largest entry of L |K^-1| s, L giving deflections, say, is a norm of
!> diag(s) K^-1 L', estimated with a few solves (Higham 1988, LAPACK's dlacn2); a single entry takes one.
module gapbeam_sensitivity
    use gapbeam_kinds, only: wp, dp
    use gapbeam_link, only: link_type
    use gapbeam_nodes, only: is_through, takes_left, takes_right
    use gapbeam_band, only: rhs_type, answer_type, factor_chain, band_mechanism, band_needs_pivoting
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_residual, only: residual_chain
    use gapbeam_pivoting, only: solve_pivoting
    use gapbeam_law_margins, only: margin_rates
    use gapbeam_model, only: beam_type, node_of_support, left_of_hinge, of_hinge_held_left, is_of_hinge
    use gapbeam_workspace, only: workspace_type
    use gapbeam_functionals, only: add_functional, functional_of, effects, of_deflections, of_rotations, of_moments, &
        of_shears, of_reactions
    implicit none
    private
    public :: sensitivity_type, prepare_sensitivity, add_forces, largest_movement, movement_of_support, way_of_forces

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

        n = size(beam%links)
        state = band_needs_pivoting
        if (.not. any(work%nodes%stiffness < 0.0_wp)) call factor_chain(work%nodes(0:n), beam%links, work%pivots, state, place)
        if (state == band_mechanism) return
        sensitivity%known = .true.
        sensitivity%pivoting = state == band_needs_pivoting
        call residual_chain(work%nodes(0:n), beam%links, work%rhs(0:n), work%answers(0:n), work%eliminated, work%sizes)
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
            if (takes_left(work%nodes(i)%kind)) then
                call add_turn(i, .true., work, work%nodes(i)%compliance*couple)
                call add_turn(i, .false., work, work%nodes(i)%compliance*couple)
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
                if (takes_left(work%nodes(k)%kind) .and. left) then
                    s%left = s%left + turn
                else if ((takes_right(work%nodes(k)%kind) .and. .not. left) &
                         .or. (is_through(work%nodes(k)%kind) .and. k > 0 .and. k < n)) then
                    s%right = s%right + turn
                end if
            end associate
        end subroutine add_turn

    end subroutine add_couple_sizes

    !> Forces that may be off at every node that gives way
    pure subroutine add_forces(work, force, sensitivity)
        type(workspace_type), intent(in) :: work
        real(wp), intent(in) :: force
        type(sensitivity_type), intent(inout) :: sensitivity

        associate (nodes => work%nodes(:ubound(sensitivity%weight, 2)))
            where (.not. nodes%held) sensitivity%weight(3, :) = sensitivity%weight(3, :) + force
        end associate
    end subroutine add_forces

    !> The most that any node moves where forces are off, and nothing else
    subroutine way_of_forces(beam, sensitivity, force, work, way)
        !> As for largest_movement
        type(beam_type), intent(in) :: beam
        type(sensitivity_type), intent(in) :: sensitivity
        !> Of every node, in either direction
        real(wp), intent(in) :: force
        type(workspace_type), intent(inout) :: work
        real(wp), intent(out) :: way
        type(sensitivity_type) :: of_forces

        of_forces%known = sensitivity%known
        of_forces%pivoting = sensitivity%pivoting
        allocate (of_forces%weight(4, 0:size(beam%links)), source=0.0_wp)
        call add_forces(work, force, of_forces)
        call largest_movement(beam, of_forces, of_deflections, work, way)
    end subroutine way_of_forces

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
                call add_functional(beam, work%nodes(0:n), kind, i, x(4*i + 1:4*i + 4), rhs)
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

            image = effects(beam, work%nodes(0:n), result, work%correction)*sensitivity%weight
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
                x(4*i + 1:4*i + 4) = functional_of(beam, work%nodes(0:n), kind, i, work%correction)
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
        associate (by_force => is_force .and. work%nodes(i)%held, n => size(beam%links))
            if (i > n) then
                call add_turn(i, by_force)
                i = node_of_support(beam, k)
            else
                call add_functional(beam, work%nodes(0:n), merge(of_reactions, of_deflections, by_force), i, &
                                    [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], rhs)
            end if
            allocate (result(0:size(beam%links)), source=rhs)
            call solve_again(beam%links, sensitivity, work, rhs, regular)
            movement = sum(sensitivity%weight*abs(effects(beam, work%nodes(0:n), result, work%correction)))
            if (by_force .and. i < beam%supports(k)%node) then
                movement = movement + sensitivity%of_couple
            else if (by_force) then
                movement = movement + epsilon(1.0_dp)*work%sizes(i)%shear
            else
                movement = rate*movement + rate*epsilon(1.0_dp)*level
            end if
        end associate
        if (.not. regular) movement = huge(movement)

    contains

        !> The rotation that a support holds, or its couple
        subroutine add_turn(v, couple)
            integer, intent(in) :: v
            logical, intent(in) :: couple
            real(wp) :: share(4)
            integer :: j

            j = v - size(beam%links)
            share(:) = 0.0_wp
            associate (at => beam%turning(j), nodes => work%nodes(0:size(beam%links)))
                if (couple .or. work%nodes(v)%stiffness > 0.0_wp) then
                    ! Of a spring the rotation is its couple over its stiffness
                    share(1:2) = merge([1.0_wp, 0.0_wp], [1.0_wp, -1.0_wp], is_of_hinge(beam%turned(j)))
                    if (beam%turned(j) == of_hinge_held_left) share(1:2) = [0.0_wp, 1.0_wp]
                    if (.not. couple) share(:) = share/work%nodes(v)%stiffness
                    call add_functional(beam, nodes, of_moments, at, share, rhs)
                else if (at == size(beam%links) .or. beam%turned(j) == left_of_hinge) then
                    share(2) = 1.0_wp
                    call add_functional(beam, nodes, of_rotations, at - 1, share, rhs)
                else
                    share(1) = merge(-1.0_wp, 1.0_wp, is_of_hinge(beam%turned(j)))
                    call add_functional(beam, nodes, of_rotations, at, share, rhs)
                    if (.not. is_of_hinge(beam%turned(j))) return
                    call add_functional(beam, nodes, of_rotations, at - 1, [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp], rhs)
                end if
            end associate
        end subroutine add_turn

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
            call solve_pivoting(work%nodes(0:size(links)), links, rhs, work%correction, regular)
        else
            call solve_chain(work%nodes(0:size(links)), links, work%pivots, rhs, work%correction)
        end if
    end subroutine solve_again

end module gapbeam_sensitivity
