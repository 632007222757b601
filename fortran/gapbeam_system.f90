!> One working scheme solved: the system it needs is chosen, assembled and solved; reactions follow.
module gapbeam_system
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, factor_chain, solve_chain, &
        band_ok, band_mechanism, band_needs_pivoting
    use gapbeam_residual, only: residual_chain, size_type
    use gapbeam_certificate, only: bound_errors
    use gapbeam_three_moment, only: fits_three_moment, solve_three_moment
    use gapbeam_lapack, only: solve_pivoting
    use gapbeam_model, only: beam_type, both, is_rigid
    use gapbeam_kinematics, only: free_motions, motion_type
    implicit none
    private
    public :: workspace_type, new_workspace, set_loads, solve_scheme, refine_scheme, check_scheme, certify_scheme
    public :: method_mixed, method_three_moment, method_pivoting

    !> Which system was solved last
    integer, parameter :: method_mixed = 0, method_three_moment = 1, method_pivoting = 2

    !> Everything a solve needs beside the beam; reused from solve to solve
    type :: workspace_type
        type(node_type), allocatable :: nodes(:)
        !> Loads of the current factor; with the supports of the scheme; and what elimination makes of it
        type(rhs_type), allocatable :: loads(:), rhs(:), eliminated(:)
        type(pivot_type), allocatable :: pivots(:)
        type(answer_type), allocatable :: answers(:)
        !> Sizes of the terms of every row, by check_scheme
        type(size_type), allocatable :: sizes(:)
        real(wp), allocatable :: moment_work(:, :)
        !> Reaction of every support, positive up, and the rounding error it may have
        real(wp), allocatable :: reaction(:), reaction_error(:)
        !> Shear of every link beside that of the simple bar, (M_b - M_a)/L, and its rounding error
        real(wp), allocatable :: shear(:), shear_error(:)
        !> How many supports act at a node, and the force of the elastic ones
        integer, allocatable :: company(:)
        real(wp), allocatable :: elastic(:)
        !> Moment per rotation of every link held at both ends, 1/int 1/EI; 0 for a rigid one
        real(wp), allocatable :: fixity(:)
        !> Largest contact level of the supports that act at a node
        real(wp), allocatable :: level(:)
        !> Sizes of the shears and deflections whose rounding reaches a node
        real(wp), allocatable :: shear_size(:), deflection_size(:)
        !> Springs towards a reference deflection that keep schemes which are mechanisms solvable; zero if unused
        real(wp), allocatable :: ease(:), reference(:)
        !> Is every one-sided support, acting or not, a spring instead (gapbeam_interior_point), and which
        logical :: sprung = .false.
        real(wp), allocatable :: spring(:), spring_contact(:)
        !> Linear solves so far, and the system solved last
        integer :: solves = 0
        integer :: method = method_mixed
        !> Relative residuals of the last solve
        real(wp) :: compatibility = 0.0_wp, equilibrium = 0.0_wp
    end type workspace_type

contains

    !> Workspace for a beam
    pure subroutine new_workspace(beam, work)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> The workspace, no load set
        type(workspace_type), intent(out) :: work
        integer :: n, m

        n = size(beam%links)
        m = size(beam%supports)
        allocate (work%nodes(0:n), work%loads(0:n), work%rhs(0:n), work%eliminated(0:n), work%pivots(0:n))
        allocate (work%answers(0:n), work%moment_work(2, 0:n), work%sizes(0:n))
        allocate (work%shear(n), work%shear_error(n))
        allocate (work%level(0:n))
        allocate (work%shear_size(0:n), work%deflection_size(0:n))
        allocate (work%reaction(m), work%reaction_error(m))
        allocate (work%ease(0:n), work%reference(0:n))
        work%ease = 0.0_wp
        work%reference = 0.0_wp
        allocate (work%fixity(n), work%company(0:n), work%elastic(0:n))
        work%fixity = 0.0_wp
        where (beam%links%bending > 0.0_wp) work%fixity = 1/beam%links%bending
    end subroutine new_workspace

    !> Set the loads: dead plus factor times live
    pure subroutine set_loads(beam, factor, work)
        type(beam_type), intent(in) :: beam
        !> Load factor of the live loads
        real(wp), intent(in) :: factor
        type(workspace_type), intent(inout) :: work
        real(wp) :: share(2)
        integer :: i, n

        n = size(beam%links)
        share = [1.0_wp, factor]
        do i = 0, n
            associate (r => work%loads(i))
                r = rhs_type()
                r%couple = dot_product(share, beam%couple(:, i))
                r%shear = dot_product(share, beam%force(:, i))
            end associate
        end do
        do i = 1, n
            associate (link => beam%links(i), a => work%loads(i - 1), b => work%loads(i))
                a%right = dot_product(share, link%turn_a)
                a%shear = a%shear + dot_product(share, link%shear_a)
                b%left = dot_product(share, link%turn_b)
                b%shear = b%shear - dot_product(share, link%shear_b)
            end associate
        end do
    end subroutine set_loads

    !> Nodes and right-hand side as the scheme sees them
    pure subroutine apply_scheme(beam, acting, work)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        integer :: k

        work%nodes%kind = beam%kind
        work%nodes%compliance = beam%compliance
        work%nodes%held = .false.
        work%nodes%stiffness = work%ease
        work%rhs = work%loads
        work%rhs%shear = work%rhs%shear + work%ease*work%reference
        work%level = 0.0_wp
        do k = 1, size(acting)
            associate (s => beam%supports(k), node => work%nodes(beam%supports(k)%node), &
                       r => work%rhs(beam%supports(k)%node))
                if (work%sprung .and. s%side /= both) then
                    node%stiffness = node%stiffness + work%spring(k)
                    r%shear = r%shear + work%spring(k)*work%spring_contact(k)
                else if (.not. acting(k)) then
                    cycle
                else
                    work%level(s%node) = max(work%level(s%node), abs(s%contact))
                    if (is_rigid(s)) then
                        node%held = .true.
                        r%deflection = s%contact
                    else
                        node%stiffness = node%stiffness + s%stiffness
                        r%shear = r%shear + s%stiffness*s%contact
                    end if
                end if
            end associate
        end do
    end subroutine apply_scheme

    !> Solve a scheme and find the reactions of its supports
    subroutine solve_scheme(beam, acting, work, state, place)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> Which supports act
        logical, intent(in) :: acting(:)
        !> Loads in, solution out
        type(workspace_type), intent(inout) :: work
        !> band_ok, band_mechanism, or band_needs_pivoting where even pivoting finds no unique solution
        integer, intent(out) :: state
        !> Node at which another state than band_ok was found
        integer, intent(out) :: place
        type(motion_type), allocatable :: motions(:)
        logical :: regular

        call apply_scheme(beam, acting, work)
        work%solves = work%solves + 1
        place = 0
        if (fits_three_moment(work%nodes)) then
            work%method = method_three_moment
            call solve_three_moment(work%nodes, beam%links, work%rhs, work%moment_work, work%answers, regular)
        else
            work%method = method_mixed
            call factor_chain(work%nodes, beam%links, work%pivots, state, place)
            regular = state == band_ok
            if (state == band_mechanism) return
            if (regular) then
                work%eliminated = work%rhs
                call solve_chain(work%nodes, beam%links, work%pivots, work%eliminated, work%answers)
            end if
        end if
        if (.not. regular) then
            work%method = method_pivoting
            call solve_pivoting(work%nodes, beam%links, work%rhs, work%answers, regular)
        end if
        state = merge(band_ok, band_needs_pivoting, regular)
        if (.not. regular) then
            ! Singular because something moves, or because statics cannot tell reactions apart
            call free_motions(beam, acting, motions)
            if (size(motions) > 0 .and. .not. any(work%ease > 0.0_wp)) state = band_mechanism
            return
        end if
        if (work%sprung) return
        call find_sizes(beam, work)
        call find_shears(beam, work)
        call find_reactions(beam, acting, work)
    end subroutine solve_scheme

    !> Shears of the links. From the moments at its ends a short link between long ones gets a poor one; then the
    !> equilibrium of a node that no rigid support holds gives a better one from its neighbour
    pure subroutine find_shears(beam, work)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        real(wp) :: change, passed
        integer :: i

        associate (v => work%shear, e => work%shear_error, a => work%answers, links => beam%links)
            do i = 1, size(links)
                v(i) = (a(i)%moment_left - a(i - 1)%moment_right)*links(i)%inverse
                e(i) = epsilon(1.0_wp)*(abs(a(i)%moment_left) + abs(a(i - 1)%moment_right)) &
                    *links(i)%inverse
                if (i == 1 .or. work%nodes(i - 1)%held) cycle
                call change_at_node(work, i - 1, change, passed)
                if (e(i - 1) + passed < e(i)) then
                    v(i) = v(i - 1) + change
                    e(i) = e(i - 1) + passed
                end if
            end do
            do i = size(links) - 1, 1, -1
                if (work%nodes(i)%held) cycle
                call change_at_node(work, i, change, passed)
                if (e(i + 1) + passed < e(i)) then
                    v(i) = v(i + 1) - change
                    e(i) = e(i + 1) + passed
                end if
            end do
        end associate
    end subroutine find_shears

    !> By how much the shear changes at a node that is not held, and the rounding error of that
    pure subroutine change_at_node(work, i, change, error)
        type(workspace_type), intent(in) :: work
        integer, intent(in) :: i
        real(wp), intent(out) :: change, error

        change = work%nodes(i)%stiffness*work%answers(i)%deflection - work%rhs(i)%shear
        error = epsilon(1.0_wp)*(work%nodes(i)%stiffness*abs(work%answers(i)%deflection) + abs(work%rhs(i)%shear))
    end subroutine change_at_node

    !> Sizes whose rounding errors reach a node: those beside it, and those of its neighbours; what crosses
    !> a rigid support is halved at least, so sizes far away do not count
    pure subroutine find_sizes(beam, work)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work
        real(wp) :: moment, passed, turn
        integer :: i, n

        n = size(beam%links)
        associate (v => work%shear_size, w => work%deflection_size, a => work%answers)
            v = abs(work%loads%shear)
            w = abs(a%deflection)
            do i = 1, n
                associate (link => beam%links(i))
                    ! Also the moments that imposed rotations and contact levels would make if they were held fast
                    turn = abs(work%loads(i - 1)%right) + abs(work%loads(i)%left) &
                        + (work%level(i) + work%level(i - 1))*link%inverse
                    moment = max(abs(a(i - 1)%moment_right), abs(a(i)%moment_left))
                    moment = max(moment, turn*work%fixity(i))
                    passed = max(v(i - 1), 2*moment*link%inverse)
                    v(i - 1) = passed
                    v(i) = max(v(i), 2*moment*link%inverse, merge(passed/2, passed, work%nodes(i)%held))
                    passed = max(w(i - 1), link%bending*link%length*moment)
                    w(i - 1) = passed
                    w(i) = max(w(i), link%bending*link%length*moment, merge(passed/2, passed, work%nodes(i)%held))
                end associate
            end do
            do i = n - 1, 0, -1
                v(i) = max(v(i), merge(v(i + 1)/2, v(i + 1), work%nodes(i)%held))
                w(i) = max(w(i), merge(w(i + 1)/2, w(i + 1), work%nodes(i)%held))
            end do
        end associate
    end subroutine find_sizes

    !> Reactions from the equilibrium of the nodes, or from the spring where that is more exact
    pure subroutine find_reactions(beam, acting, work)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        real(wp) :: by_spring, by_node, spring_error, node_error
        integer :: k, i

        work%company = 0
        work%elastic = 0.0_wp
        do k = 1, size(acting)
            work%reaction(k) = 0.0_wp
            work%reaction_error(k) = 0.0_wp
            if (.not. acting(k)) cycle
            associate (s => beam%supports(k))
                work%company(s%node) = work%company(s%node) + 1
                if (.not. is_rigid(s)) work%elastic(s%node) = work%elastic(s%node) &
                    + s%stiffness*(work%answers(s%node)%deflection - s%contact)
            end associate
        end do
        do k = 1, size(acting)
            if (.not. acting(k)) cycle
            associate (s => beam%supports(k))
                i = s%node
                call force_at_node(work, i, size(beam%links), by_node, node_error)
                ! For signs, rounding that comes from farther away counts as well
                node_error = max(node_error, epsilon(1.0_wp)*work%shear_size(i))
                if (is_rigid(s)) then
                    work%reaction(k) = by_node - work%elastic(i)
                    work%reaction_error(k) = node_error + epsilon(1.0_wp)*abs(work%elastic(i))
                else
                    by_spring = s%stiffness*(work%answers(i)%deflection - s%contact)
                    spring_error = epsilon(1.0_wp)*s%stiffness*max(work%deflection_size(i), abs(s%contact))
                    if (work%company(i) == 1 .and. node_error < spring_error) then
                        work%reaction(k) = by_node
                        work%reaction_error(k) = node_error
                    else
                        work%reaction(k) = by_spring
                        work%reaction_error(k) = spring_error
                    end if
                end if
            end associate
        end do
    end subroutine find_reactions

    !> Force of all supports together at a node, from the shears beside it
    pure subroutine force_at_node(work, i, n, reaction, error)
        type(workspace_type), intent(in) :: work
        !> Node, and number of links
        integer, intent(in) :: i, n
        real(wp), intent(out) :: reaction, error
        real(wp) :: left, right

        left = 0.0_wp
        right = 0.0_wp
        error = epsilon(1.0_wp)*abs(work%loads(i)%shear)
        if (i > 0) then
            left = work%shear(i)
            error = error + work%shear_error(i)
        end if
        if (i < n) then
            right = work%shear(i + 1)
            error = error + work%shear_error(i + 1)
        end if
        reaction = (work%loads(i)%shear - (left - right)) + work%ease(i)*(work%reference(i) - work%answers(i)%deflection)
    end subroutine force_at_node

    !> One step of iterative refinement of the last solve, with residuals formed from differences
    pure subroutine refine_scheme(beam, acting, work)
        !> The beam and the scheme solved last
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        type(workspace_type), intent(inout) :: work
        type(answer_type), allocatable :: correction(:)
        logical :: regular

        if (work%method == method_pivoting) return  ! LAPACK's expert driver has refined already
        allocate (correction(0:size(beam%links)))
        call residual_chain(work%nodes, beam%links, work%rhs, work%answers, work%eliminated, &
                            work%sizes, work%compatibility, work%equilibrium)
        if (work%method == method_three_moment) then
            call solve_three_moment(work%nodes, beam%links, work%eliminated, work%moment_work, correction, regular)
        else
            call solve_chain(work%nodes, beam%links, work%pivots, work%eliminated, correction)
        end if
        work%answers%deflection = work%answers%deflection + correction%deflection
        work%answers%moment_left = work%answers%moment_left + correction%moment_left
        work%answers%moment_right = work%answers%moment_right + correction%moment_right
        call find_shears(beam, work)
        call find_reactions(beam, acting, work)
    end subroutine refine_scheme

    !> Relative residuals of the last solve, into work%compatibility and work%equilibrium
    pure subroutine check_scheme(beam, work)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(inout) :: work

        call residual_chain(work%nodes, beam%links, work%rhs, work%answers, work%eliminated, work%sizes, &
                            work%compatibility, work%equilibrium)
    end subroutine check_scheme

    !> Bounds for the errors of the last solve
    subroutine certify_scheme(beam, factor, work, deflection_bound, reaction_bound, known)
        !> The beam and the factor of its live loads
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        type(workspace_type), intent(inout) :: work
        !> Largest error of any deflection of a node, and of any reaction
        real(wp), intent(out) :: deflection_bound, reaction_bound
        !> False where there is no factor without pivoting to bound them with
        logical, intent(out) :: known
        integer :: state, place

        deflection_bound = 0.0_wp
        reaction_bound = 0.0_wp
        call factor_chain(work%nodes, beam%links, work%pivots, state, place)
        known = state == band_ok
        if (.not. known) return
        call check_scheme(beam, work)
        call add_load_sizes(beam, factor, work)
        call bound_errors(work%nodes, beam%links, work%pivots, work%eliminated, work%sizes, deflection_bound, reaction_bound)
        ! The numbers given are rounded once more, and contact levels are given to half a unit in the last place
        deflection_bound = deflection_bound + 2*epsilon(1.0_wp)*maxval(max(abs(work%answers%deflection), abs(work%rhs%deflection)))
        if (size(work%reaction) > 0) reaction_bound = reaction_bound &
            + maxval(2*epsilon(1.0_wp)*abs(work%reaction) + work%reaction_error)
    end subroutine certify_scheme

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

end module gapbeam_system
