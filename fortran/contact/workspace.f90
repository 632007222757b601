!> Workspace of a solve: loads and contact state at the nodes, factor, solution.
module gapbeam_workspace
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_nodes_solved, least_solves, support_block
    use gapbeam_require, only: checked, require
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type
    use gapbeam_residual, only: size_type
    use gapbeam_plain, only: plain_type, is_plain, prepare_plain
    use gapbeam_law, only: add_supports, has_laws
    use gapbeam_model, only: beam_type, last_place
    use gapbeam_turning, only: apply_turning
    implicit none
    private
    public :: workspace_type, interval_type, new_workspace, set_loads, apply_scheme
    public :: method_mixed, method_three_moment, method_pivoting

    !> Which system was solved last
    integer, parameter :: method_mixed = 0, method_three_moment = 1, method_pivoting = 2

    !> Sizes of a shear and of a deflection
    type :: interval_type
        real(wp) :: shear = 0.0_wp, deflection = 0.0_wp
    end type interval_type

    !> Everything a solve needs beside the beam; reused from solve to solve
    type :: workspace_type
        type(node_type), allocatable :: nodes(:)
        !> Sums of the absolute values of the loads that meet at a node, and of the rotations that the loads of a link could make:
        !> what rounding is relative to where they cancel
        real(wp), allocatable :: load_size(:), turn_size(:)
        !> Loads of the current factor; with the supports of the scheme; and what elimination makes of it
        type(rhs_type), allocatable :: loads(:), rhs(:), eliminated(:)
        type(pivot_type), allocatable :: pivots(:)
        !> On elastic ground, the shears at the two ends of every link, shape (2, n)
        real(wp), allocatable :: end_shear(:, :), end_shear_error(:, :)
        !> For plain beams: can the loads and the scheme at hand be solved so
        type(plain_type) :: plain
        logical :: without_couples = .false., from_both_ends = .false.
        !> May the force of supports fall; are reactions and sizes those of the solution
        logical :: may_soften = .false., complete = .false.
        !> Is the solution refined, so that rounding errors are not those of elimination
        logical :: refined = .false.
        !> The solution, and a correction of it
        type(answer_type), allocatable :: answers(:), correction(:)
        !> Sizes of the terms of every row, by refine_scheme
        type(size_type), allocatable :: sizes(:)
        real(wp), allocatable :: moment_work(:, :)
        !> Reaction of every support, positive up, and the rounding error it may have
        real(wp), allocatable :: reaction(:), reaction_error(:)
        !> Shear of every link beside that of the simple bar, (M_b - M_a)/L, and its rounding error
        real(wp), allocatable :: shear(:), shear_error(:)
        !> Moment per rotation of every link held at both ends, 1/int 1/EI; 0 for a rigid one; deflection that a moment of 1 makes;
        !> 1/length
        real(wp), allocatable :: fixity(:), reach(:), inverse(:)
        !> Largest contact level of the supports that act at a node
        real(wp), allocatable :: level(:)
        !> Couples of the supports that hold rotations, and their sizes for rounding errors, shape (r)
        real(wp), allocatable :: couple(:), couple_size(:)
        !> Sizes of the shears and deflections whose rounding reaches a node: from beside it, from the left, from the
        !> right, from everywhere
        type(interval_type), allocatable :: reach_own(:), reach_left(:), reach_right(:)
        real(wp), allocatable :: shear_size(:), deflection_size(:)
        !> Springs towards a reference deflection that keep schemes which are mechanisms solvable; zero if unused
        real(wp), allocatable :: proximal_weight(:), reference(:)
        !> Is every one-sided support, acting or not, a spring instead (gapbeam_interior_point), and which
        logical :: sprung = .false.
        real(wp), allocatable :: spring(:), spring_contact(:)
        !> Linear solves so far, those of parts of the beam by their share of it, and the system solved last
        integer :: solves = 0
        !> Solves after which the least-index rule, which may take very many, gives up
        integer :: most_solves = least_solves
        !> Did the paper's rule come back to a scheme that it had seen
        logical :: cycled = .false.
        integer :: method = method_mixed
        !> By how much elimination has let rounding errors grow, as the corrections of an update tell
        real(wp) :: growth = 1.0_wp
    end type workspace_type

contains

    !> Workspace for a beam
    pure subroutine new_workspace(beam, work)
        type(beam_type), intent(in) :: beam
        !> The workspace, no load set
        type(workspace_type), intent(out) :: work
        integer :: n, m, last

        n = size(beam%links)
        m = size(beam%supports)
        last = last_place(beam)
        allocate (work%nodes(0:last), work%loads(0:last), work%rhs(0:last), work%eliminated(0:n), work%pivots(0:n))
        allocate (work%answers(0:last), work%correction(0:n), work%moment_work(2, 0:n), work%sizes(0:n))
        allocate (work%load_size(0:last), work%turn_size(n))
        work%load_size(n + 1:) = 0.0_wp
        allocate (work%shear(n), work%shear_error(n))
        allocate (work%level(0:last), work%couple(last - n), work%couple_size(last - n))
        allocate (work%reach_own(0:n), work%reach_left(0:n), work%reach_right(0:n))
        allocate (work%shear_size(0:last), work%deflection_size(0:last))
        allocate (work%reaction(m), work%reaction_error(m))
        allocate (work%proximal_weight(0:n), work%reference(0:n), work%fixity(n), source=0.0_wp)
        allocate (work%reach(n), work%inverse(n))
        where (beam%links%bending > 0.0_wp) work%fixity = 1/beam%links%bending
        work%inverse = beam%links%inverse
        work%reach = max(beam%links%bending, beam%links%faa + beam%links%fbb)*beam%links%length
        work%may_soften = has_laws(beam%supports)
        work%most_solves = max(least_solves, most_nodes_solved/(n + 1))
        if (allocated(beam%ground)) then
            allocate (work%end_shear(2, n), work%end_shear_error(2, n))
        else if (is_plain(beam%links, beam%kind) .and. last == n) then
            call prepare_plain(beam%links, work%plain)
        end if
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
            work%load_size(i) = dot_product(abs(share), abs(beam%force(:, i)))
        end do
        do i = 1, n
            associate (link => beam%links(i), a => work%loads(i - 1), b => work%loads(i))
                a%right = dot_product(share, link%turn_a)
                a%shear = a%shear + dot_product(share, link%shear_a)
                b%left = dot_product(share, link%turn_b)
                b%shear = b%shear - dot_product(share, link%shear_b)
                work%turn_size(i) = dot_product(abs(share), link%turn_sum)
                work%load_size(i - 1:i) = work%load_size(i - 1:i) + dot_product(abs(share), link%load_sum)
            end associate
        end do
        work%without_couples = .not. any(abs(work%loads%couple) > 0.0_wp)
    end subroutine set_loads

    !> Nodes and right-hand side as the scheme sees them
    pure subroutine apply_scheme(beam, acting, range, work)
        type(beam_type), intent(in) :: beam
        !> Which supports act
        logical, intent(in) :: acting(:)
        !> First and last node
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        integer :: i, from, to

        if (checked) then
            call require(size(acting) == size(beam%supports), "apply_scheme: acting")
            call require(ubound(work%nodes, 1) == last_place(beam), "apply_scheme: workspace of another beam")
        end if
        do from = range(1), range(2), support_block
            to = min(from + support_block - 1, range(2))
            do i = from, to
                associate (node => work%nodes(i), r => work%rhs(i))
                    node%kind = beam%kind(i)
                    node%compliance = beam%compliance(i)
                    node%held = .false.
                    node%stiffness = work%proximal_weight(i)
                    r = work%loads(i)
                    r%shear = r%shear + work%proximal_weight(i)*work%reference(i)
                    work%level(i) = 0.0_wp
                end associate
            end do
            associate (there => beam%order(beam%first(from):beam%first(to + 1) - 1))
                if (work%sprung) then
                    call add_supports(beam%supports, there, acting, work%nodes, work%rhs, work%level, work%spring, &
                                      work%spring_contact)
                else
                    call add_supports(beam%supports, there, acting, work%nodes, work%rhs, work%level)
                end if
            end associate
        end do
        if (allocated(beam%turning)) call apply_turning(beam, acting, range, work%nodes, work%rhs, work%level)
    end subroutine apply_scheme

end module gapbeam_workspace
