!> One linear system, by each of the ways to solve it: from both ends, three moments, with pivoting, along the axis
program test_chain
    use testing, only: check, check_close, finish
    use beams, only: infinite
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_band, only: node_type, rhs_type, answer_type, pivot_type, factor_chain, band_ok, plain, hinge, restrained, jointed
    use gapbeam_nodes, only: hinge_left, hinge_right, joint_left, joint_right
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_plain, only: plain_type, is_plain, ends_hold, prepare_plain, solve_plain
    use gapbeam_three_moment, only: fits_three_moment, solve_three_moment
    use gapbeam_pivoting, only: solve_pivoting
    use gapbeam_axial, only: solve_axial, axial_ok, axial_slides, axial_indeterminate
    implicit none
    integer :: status

    call what_is_plain()
    call from_both_ends()
    call what_fits_three_moments()
    call three_moments()
    call free_tips()
    call rigid_links()
    call joints()
    call along_the_axis()
    call not_along_the_axis()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Equal spans of length 2 and this EI under a load per length, all nodes held, and the right-hand side
    subroutine make(n, ei, q, nodes, links, rhs)
        integer, intent(in) :: n
        real(wp), intent(in) :: ei, q
        type(node_type), allocatable, intent(out) :: nodes(:)
        type(link_type), allocatable, intent(out) :: links(:)
        type(rhs_type), allocatable, intent(out) :: rhs(:)
        real(wp) :: work(1)
        integer :: i

        allocate (nodes(0:n), links(n), rhs(0:n))
        nodes%held = .true.
        do i = 1, n
            call condense_link([piece_type(2.0_wp, 1/ei, 0.0_wp)], [piece_load_type(q, q, 0, 0, 0)], &
                               [piece_load_type(0, 0, 0, 0, 0)], &
                               work, links(i))
            rhs(i - 1)%right = links(i)%turn_a(1)
            rhs(i)%left = links(i)%turn_b(1)
            rhs(i - 1)%shear = rhs(i - 1)%shear + links(i)%shear_a(1)
            rhs(i)%shear = rhs(i)%shear - links(i)%shear_b(1)
        end do
    end subroutine make

    !> Only beams without hinges and rigid links, held at both ends
    subroutine what_is_plain()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)

        call make(1, 1.0_wp, 0.0_wp, nodes, links, rhs)
        call check(.not. is_plain(links, nodes%kind), "not one link alone")
        call make(3, 1.0_wp, 0.0_wp, nodes, links, rhs)
        call check(is_plain(links, nodes%kind), "three are")
        call check(.not. is_plain(links, [plain, plain, hinge, plain]), "not with a hinge inside")
        call check(is_plain(links, [restrained, plain, plain, restrained]), "clamps at the ends are well")
        links(2)%faa = 0.0_wp
        call check(.not. is_plain(links, nodes%kind), "not with a rigid link")
        call check(ends_hold(nodes), "held at both ends")
        nodes(0)%held = .false.
        call check(.not. ends_hold(nodes), "at one")
        nodes(0)%stiffness = 1e-300_wp
        call check(ends_hold(nodes), "a spring holds")
        nodes(0) = node_type(kind=restrained)
        call check(ends_hold(nodes), "so does a restraint")
        nodes(1:2) = node_type()
        nodes(3) = node_type(kind=restrained)
        call check(.not. ends_hold(nodes), "two of them let it go up and down")
        nodes(1)%held = .true.
        call check(ends_hold(nodes), "but for a support between them")
    end subroutine what_is_plain

    !> Continuous beams of two, three and four spans: -q L**2 times 1/8; 1/10; 3/28, 1/14, 3/28
    subroutine from_both_ends()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(answer_type), allocatable :: answers(:), other(:)
        type(plain_type) :: beam
        logical :: regular
        real(wp), parameter :: q = 3.0_wp
        integer :: n

        do n = 2, 5
            call make(n, 7.0_wp, q, nodes, links, rhs)
            if (allocated(answers)) deallocate (answers, other)
            allocate (answers(0:n), other(0:n))
            call prepare_plain(links, beam)
            call solve_plain(beam, nodes, rhs, answers)
            if (n == 2) call check_close(answers%moment_left, -q*[0.0_wp, 0.5_wp, 0.0_wp], "two spans")
            if (n == 3) call check_close(answers%moment_left, -q*[0.0_wp, 0.4_wp, 0.4_wp, 0.0_wp], "three spans")
            if (n == 4) call check_close(answers%moment_right, -q*[0.0_wp, 12.0_wp, 8.0_wp, 12.0_wp, 0.0_wp]/28, "four spans")
            call check_close(answers%deflection, spread(0.0_wp, 1, n + 1), "held", absolute=0.0_wp)
            ! On springs and with pivoting, which knows nothing of ends
            nodes%held = .false.
            nodes%stiffness = 5.0_wp
            call solve_plain(beam, nodes, rhs, answers)
            call solve_pivoting(nodes, links, rhs, other, regular)
            call check(regular, "regular")
            call check_close(answers%moment_left, other%moment_left, "as with pivoting, moments", 1e-12_wp)
            call check_close(answers%deflection, other%deflection, "as with pivoting, deflections", 1e-12_wp)
            call check_close(5*sum(answers%deflection), 2*n*q, "springs carry the load")
        end do
        ! Clamped ends and a settlement: M = -6 EI d/L**2 at the clamps of two spans, + in the middle
        call make(2, 7.0_wp, 0.0_wp, nodes, links, rhs)
        nodes([0, 2])%kind = restrained
        rhs(1)%deflection = 0.1_wp
        deallocate (answers)
        allocate (answers(0:2))
        call prepare_plain(links, beam)
        call solve_plain(beam, nodes, rhs, answers)
        call check_close(answers%moment_right, 6*7*0.1_wp/4*[-1.0_wp, 1.0_wp, 0.0_wp], "settlement between clamps")
        call check_close(answers%deflection, [0.0_wp, 0.1_wp, 0.0_wp], "of this size")
    end subroutine from_both_ends

    !> Compliant joints and hinges with a known moment by elimination, once and without a correction, as with pivoting: beams on
    !> springs, with and without a free end at the left, through which moments come to the joint by statics
    subroutine joints()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:), work(:)
        type(pivot_type) :: pivots(0:6)
        type(answer_type) :: answers(0:6), other(0:6)
        logical :: regular
        integer :: free, first, second, state, place

        do free = 0, 2
            do first = 1, 9
                do second = 1, 9
                    call make(6, 7.0_wp, 3.0_wp, nodes, links, rhs)
                    nodes%held = .false.
                    nodes%stiffness = 5.0_wp
                    nodes(:free - 1)%stiffness = 0.0_wp
                    call join(first, nodes(1), rhs(1))
                    call join(second, nodes(4), rhs(4))
                    call factor_chain(nodes, links, pivots, state, place)
                    call solve_pivoting(nodes, links, rhs, other, regular)
                    ! Part of a beam that hangs on a hinge alone turns about it
                    call check((state == band_ok) .eqv. (free == 0 .or. all(first /= [2, 5, 9])), "whether it is held")
                    if (state /= band_ok) cycle
                    call check(regular, "regular")
                    work = rhs
                    call solve_chain(nodes, links, pivots, work, answers)
                    call check_close(answers%moment_left, other%moment_left, "moments left of joints", 1e-12_wp)
                    call check_close(answers%moment_right, other%moment_right, "moments right of joints", 1e-12_wp)
                    call check_close(answers%deflection, other%deflection, "deflections beside joints", 1e-12_wp)
                end do
            end do
        end do
    end subroutine joints

    !> A node with a compliant joint that is bent from the start, or a hinge with a known moment: each with a restraint left or
    !> right of it, with a couple, or with neither
    recursive subroutine join(how, node, r)
        integer, intent(in) :: how
        type(node_type), intent(inout) :: node
        type(rhs_type), intent(inout) :: r

        select case (how)
        case (1)
            node%kind = jointed
            node%compliance = 0.3_wp
            r%right = r%right + 0.02_wp
        case (2)
            node%kind = hinge
            r%moment = 1.5_wp
        case (4, 5)
            node%kind = merge(hinge_left, hinge_right, how == 4)
            node%compliance = 0.3_wp
            r%moment = 1.5_wp
            r%couple = 0.7_wp
        case (6, 7)
            node%kind = merge(joint_left, joint_right, how == 6)
            node%compliance = 0.3_wp
            node%joint = 0.2_wp
            r%couple = 0.7_wp
        case (8, 9)
            call join(how - 7, node, r)
            r%couple = 0.7_wp
        case default
            node%kind = plain
        end select
    end subroutine join

    !> Deflections must be known but at free tips
    subroutine what_fits_three_moments()
        type(node_type) :: nodes(0:3)

        nodes%held = .true.
        call check(fits_three_moment(nodes), "held everywhere")
        nodes(0)%held = .false.
        nodes(3)%held = .false.
        call check(fits_three_moment(nodes), "but at the tips")
        nodes(0)%stiffness = 1.0_wp
        call check(.not. fits_three_moment(nodes), "not a tip on a spring")
        nodes(0)%stiffness = 0.0_wp
        nodes(1)%kind = hinge
        call check(.not. fits_three_moment(nodes), "not with a hinge")
        nodes(1) = node_type()
        call check(.not. fits_three_moment(nodes), "not with a node that may move")
        call check(.not. fits_three_moment(nodes(1:2)), "nothing holds")
        nodes(1:2) = [node_type(held=.true., kind=restrained), node_type()]
        call check(fits_three_moment(nodes(1:2)), "a cantilever")
        nodes(1)%kind = plain
        call check(.not. fits_three_moment(nodes(1:2)), "turns without its clamp")
    end subroutine what_fits_three_moments

    !> Clamped, propped, settled
    subroutine three_moments()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(answer_type) :: answers(0:2)
        real(wp) :: work(2, 0:2)
        logical :: regular
        real(wp), parameter :: q = 3.0_wp

        call make(1, 7.0_wp, q, nodes, links, rhs)
        call solve_three_moment(nodes, links, rhs, work, answers(:1), regular)
        call check_close(answers(:1)%moment_left, [0.0_wp, 0.0_wp], "a simple beam", absolute=0.0_wp)
        nodes%kind = restrained
        call solve_three_moment(nodes, links, rhs, work, answers(:1), regular)
        call check_close([answers(0)%moment_right, answers(1)%moment_left], -[q, q]/3, "q L**2/12 between clamps")
        nodes(1)%kind = plain
        call solve_three_moment(nodes, links, rhs, work, answers(:1), regular)
        call check_close(answers(0)%moment_right, -q/2, "q L**2/8 at one clamp")
        call make(2, 7.0_wp, 0.0_wp, nodes, links, rhs)
        rhs(1)%deflection = 0.1_wp
        call solve_three_moment(nodes, links, rhs, work, answers, regular)
        call check_close(answers(1)%moment_left, 3*7*0.1_wp/4, "3 EI d/L**2 where the middle support settles")
        rhs(1)%couple = 4.0_wp
        rhs(1)%deflection = 0.0_wp
        call solve_three_moment(nodes, links, rhs, work, answers, regular)
        call check_close([answers(1)%moment_left, answers(1)%moment_right], [-2.0_wp, 2.0_wp], "a couple goes both ways")
    end subroutine three_moments

    !> P L**3/3 EI, and an overhang
    subroutine free_tips()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(answer_type) :: answers(0:2)
        real(wp) :: work(2, 0:2)
        logical :: regular
        integer :: tip, root

        do tip = 0, 1
            root = 1 - tip
            call make(1, 7.0_wp, 0.0_wp, nodes, links, rhs)
            nodes(root)%kind = restrained
            nodes(tip)%held = .false.
            rhs(tip)%shear = 5.0_wp
            call solve_three_moment(nodes, links, rhs, work, answers(:1), regular)
            call check_close(answers(tip)%deflection, 5*8/(3*7.0_wp), "cantilever")
            call check_close(answers(root)%moment_left + answers(root)%moment_right, -10.0_wp, "moment at its root")
        end do
        call make(2, 7.0_wp, 0.0_wp, nodes, links, rhs)
        nodes(2)%held = .false.
        rhs(2)%shear = 5.0_wp
        call solve_three_moment(nodes, links, rhs, work, answers, regular)
        call check_close(answers(2)%deflection, 5*4*4/(3*7.0_wp), "overhang: P a**2 (L + a)/3 EI")
    end subroutine free_tips

    !> A rigid stretch over rigid supports: two are statics, three cannot be told apart
    subroutine rigid_links()
        type(node_type), allocatable :: nodes(:)
        type(link_type), allocatable :: links(:)
        type(rhs_type), allocatable :: rhs(:)
        type(answer_type) :: answers(0:2)
        real(wp) :: work(2, 0:2)
        logical :: regular

        call make(2, infinite(), 3.0_wp, nodes, links, rhs)
        call solve_three_moment(nodes, links, rhs, work, answers, regular)
        call check(.not. regular, "three supports: no pivot")
        call solve_pivoting(nodes, links, rhs, answers, regular)
        call check(.not. regular, "nor are they told apart with pivoting")
        nodes(1)%held = .false.
        call solve_pivoting(nodes, links, rhs, answers, regular)
        call check(regular, "two are")
        call check_close(answers%moment_left, [0.0_wp, 6.0_wp, 0.0_wp], "by statics: q l**2/8 at midspan", absolute=1e-12_wp)
        call check_close(answers%deflection, spread(0.0_wp, 1, 3), "and nothing bends", absolute=1e-12_wp)
    end subroutine rigid_links

    !> Bars in a row
    subroutine along_the_axis()
        real(wp) :: u(0:2), reaction(0:2), tension(2)
        integer :: state, place, i

        call solve_axial([0.5_wp, 0.25_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 4.0_wp], [infinite(), 0.0_wp, 0.0_wp], &
                         spread(0.0_wp, 1, 3), u, &
                         tension, reaction, state, place)
        call check(state == axial_ok, "held on the left, pulled on the right")
        call check_close(u, [0.0_wp, 2.0_wp, 3.0_wp], "displacements")
        call check_close(tension, [4.0_wp, 4.0_wp], "tension")
        call check_close(reaction, [-4.0_wp, 0.0_wp, 0.0_wp], "reaction")
        call solve_axial([0.5_wp, 0.5_wp], [0.0_wp, 0.0_wp], [0.0_wp, 4.0_wp, 0.0_wp], [infinite(), 0.0_wp, infinite()], &
                         spread(0.0_wp, 1, 3), u, &
                         tension, reaction, state, place)
        call check_close(tension, [2.0_wp, -2.0_wp], "pulled in the middle")
        call solve_axial([0.5_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], [infinite(), 0.0_wp, 2.0_wp], &
                         [0.0_wp, 0.0_wp, 1.0_wp], u, tension, reaction, state, place)
        call check_close(u, [0.0_wp, 0.5_wp, 0.5_wp], "a spring that settles pulls a rigid bar")
        call check_close(reaction, [-1.0_wp, 0.0_wp, 1.0_wp], "with the same force at both ends")
        do i = 1, 100
            call solve_axial([0.3_wp, 0.7_wp], [0.0_wp, 0.0_wp], [0.0_wp, i/7.0_wp, 0.0_wp], [0.0_wp, 3.0_wp, 0.0_wp], &
                             spread(0.0_wp, 1, 3), u, tension, reaction, state, place)
            call check_close(tension, [0.0_wp, 0.0_wp], "a spring takes all that stands there", absolute=0.0_wp)
        end do
    end subroutine along_the_axis

    !> Nothing holds, or statics cannot tell
    subroutine not_along_the_axis()
        real(wp) :: u(0:1), reaction(0:1), tension(1)
        integer :: state, place

        call solve_axial([0.5_wp], [0.0_wp], [0.0_wp, 1.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], u, tension, reaction, &
                         state, place)
        call check(state == axial_slides, "nothing holds the beam")
        call solve_axial([0.0_wp], [0.0_wp], [0.0_wp, 1.0_wp], [infinite(), infinite()], [0.0_wp, 0.0_wp], u, tension, &
                         reaction, state, place)
        call check(state == axial_indeterminate .and. place == 1, "a rigid bar between two rigid supports")
        call solve_axial([0.0_wp], [0.0_wp], [0.0_wp, 3.0_wp], [infinite(), 1.0_wp], [0.0_wp, 0.0_wp], u, tension, &
                         reaction, state, place)
        call check(state == axial_ok, "one of them elastic")
        call check_close(reaction, [-3.0_wp, 0.0_wp], "carries nothing")
    end subroutine not_along_the_axis

end program test_chain
