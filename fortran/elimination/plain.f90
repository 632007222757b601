!> Beams without hinges, couples at nodes and rigid links, solved from both ends (gapbeam_kernel).
!>
!> Nearly all schemes of nearly all beams are such; the others go to gapbeam_band. Nothing of the factor is kept: to
!> solve again costs less than to read one.
module gapbeam_plain
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    use gapbeam_link, only: link_type
    use gapbeam_band, only: node_type, rhs_type, answer_type, plain, restrained
    use gapbeam_residual, only: residual_chain, residual_inside, size_type
    use gapbeam_kernel, only: cell_type, row_type, eliminated_type, sweep_type, last_step, start_at_free_end, step_alone, &
        sweep_inward, meet, sweep_outward
    implicit none
    private
    public :: plain_type, prepare_plain, is_plain, ends_hold, solve_plain, set_node, solve_rows, refine_rows

    !> A plain beam prepared for solves, and room for them
    type :: plain_type
        type(cell_type), allocatable :: cells(:)
        type(row_type), allocatable :: rows(:)
        type(eliminated_type), allocatable :: eliminated(:)
        real(wp), allocatable :: moment(:), deflection(:)
        !> Room for the rows of a correction
        real(wp), allocatable :: turn(:), shear(:)
        !> Are the rows those of the scheme that was solved last
        logical :: has_rows = .false.
    end type plain_type

contains

    !> Can a beam be solved here, whatever its supports do
    pure function is_plain(links, kind) result(fits)
        !> Links, shape (n), and kinds of the nodes, shape (0:n)
        type(link_type), intent(in) :: links(:)
        integer, intent(in) :: kind(0:)
        logical :: fits
        integer :: n

        n = size(links)
        fits = n >= 2
        if (.not. fits) return
        fits = all(kind(1:n - 1) == plain) .and. all(links%faa > 0.0_wp .and. links%fbb > 0.0_wp)
    end function is_plain

    !> Does each end have a support or a restraint in a scheme, and does any node have a support
    pure function ends_hold(nodes) result(fits)
        type(node_type), intent(in) :: nodes(:)
        logical :: fits

        associate (a => nodes(1), b => nodes(size(nodes)))
            fits = (is_held(a) .or. a%kind == restrained) .and. (is_held(b) .or. b%kind == restrained)
            if (fits .and. .not. (is_held(a) .or. is_held(b))) fits = any(is_held(nodes))
        end associate
    end function ends_hold

    !> Does a node have a support
    elemental function is_held(node) result(held)
        type(node_type), intent(in) :: node
        logical :: held

        held = node%held .or. node%stiffness > 0.0_wp
    end function is_held

    !> Prepare a beam for which is_plain holds
    pure subroutine prepare_plain(links, beam)
        type(link_type), intent(in) :: links(:)
        type(plain_type), intent(out) :: beam
        integer :: n, s

        n = size(links)
        if (checked) call require(is_plain(links, spread(plain, 1, n + 1)), "prepare_plain: a rigid link, or one link alone")
        allocate (beam%cells(0:last_step(n)), beam%rows(0:last_step(n)), beam%eliminated(0:last_step(n)))
        allocate (beam%moment(0:n), beam%deflection(0:n), beam%turn(0:n), beam%shear(0:n))
        ! Lane 1 may have nothing to do at step 0, and multiplies what it finds there all the same
        beam%rows(0) = row_type([0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp])
        beam%eliminated(0) = eliminated_type([0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                                             [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp])
        do s = 0, last_step(n)
            ! With an odd number of links lane 1 has nothing to do at step 0
            associate (l => links(max(s + 1 - modulo(n, 2), 1)), r => links(n - s))
                beam%cells(s) = cell_type([l%inverse, r%inverse], [l%faa, r%fbb], [l%fbb, r%faa], [l%fab, r%fab], &
                                          [l%sum_a, r%sum_b], [l%sum_b, r%sum_a], [l%bending, r%bending], &
                                          [l%determinant, r%determinant])
            end associate
        end do
    end subroutine prepare_plain

    !> Solve a scheme for which ends_hold is true, without couples at nodes
    pure subroutine solve_plain(beam, nodes, rhs, answers)
        type(plain_type), intent(inout) :: beam
        !> Nodes and right-hand side as for gapbeam_band, shape (0:n)
        type(node_type), intent(in) :: nodes(0:)
        type(rhs_type), intent(in) :: rhs(0:)
        !> The solution
        type(answer_type), intent(inout) :: answers(0:)
        integer :: n, s, odd

        n = ubound(nodes, 1)
        if (checked) call require(.not. any(abs(rhs%couple) > 0.0_wp), "solve_plain: couples")
        odd = modulo(n, 2)
        do s = 0, last_step(n)
            call set_row(nodes(max(s - odd, 0)), rhs(max(s - odd, 0)), 1, beam%rows(s))
            call set_row(nodes(n - s), rhs(n - s), 2, beam%rows(s))
        end do
        call solve_rows(beam, nodes, rhs, answers)
    end subroutine solve_plain

    !> Set the rows of one node anew
    pure subroutine set_node(beam, i, node, rhs)
        type(plain_type), intent(inout) :: beam
        !> Its number, and its row
        integer, intent(in) :: i
        type(node_type), intent(in) :: node
        type(rhs_type), intent(in) :: rhs
        integer :: n

        n = size(beam%moment) - 1
        if (i < n/2) call set_row(node, rhs, 1, beam%rows(i + modulo(n, 2)))
        if (i > n/2) call set_row(node, rhs, 2, beam%rows(n - i))
    end subroutine set_node

    !> Solve the rows that are set
    pure subroutine solve_rows(beam, nodes, rhs, answers)
        !> As for solve_plain
        type(plain_type), intent(inout) :: beam
        type(node_type), intent(in) :: nodes(0:)
        type(rhs_type), intent(in) :: rhs(0:)
        type(answer_type), intent(inout) :: answers(0:)
        type(sweep_type) :: sweep
        type(row_type) :: row
        integer :: n, i, odd

        n = ubound(nodes, 1)
        if (checked) then
            call require(size(beam%moment) == n + 1, "solve_rows: prepared for another beam")
            call require(size(rhs) == n + 1 .and. size(answers) == n + 1, "solve_rows: shapes")
            call require(ends_hold(nodes) .and. all(nodes(1:n - 1)%kind == plain), "solve_rows: nodes")
        end if
        odd = modulo(n, 2)
        call start_lane(2, nodes(n), beam%cells(0), beam%rows(0), sweep, beam%eliminated(0))
        if (odd == 1) call step_alone(2, beam%cells(1), beam%rows(1), sweep, beam%eliminated(1))
        call start_lane(1, nodes(0), beam%cells(odd), beam%rows(odd), sweep, beam%eliminated(odd))
        call sweep_inward(beam%cells(odd + 1:), beam%rows(odd + 1:), sweep, beam%eliminated(odd + 1:))
        i = n/2
        call set_row(nodes(i), rhs(i), 1, row)
        call meet(row%stiffness(1), row%free(1), row%turn(1), row%shear(1), sweep, beam%moment(i), beam%deflection(i))
        call sweep_outward(n, beam%eliminated, beam%moment, beam%deflection)
        do i = 0, n
            answers(i) = answer_type(beam%deflection(i), beam%moment(i), beam%moment(i))
        end do
        answers(0)%moment_left = 0.0_wp
        answers(n)%moment_right = 0.0_wp
    end subroutine solve_rows

    !> The correction of the solution of solve_rows, from residuals in twice the working precision
    pure subroutine refine_rows(beam, nodes, links, rhs, answers, residual, correction)
        !> Solved by solve_rows; its rows become those of the correction
        type(plain_type), intent(inout) :: beam
        !> As for solve_plain
        type(node_type), intent(in) :: nodes(0:)
        type(link_type), intent(in) :: links(:)
        type(rhs_type), intent(in) :: rhs(0:)
        type(answer_type), intent(in) :: answers(0:)
        !> Room, shape (0:n)
        type(rhs_type), intent(inout) :: residual(0:)
        !> The correction, shape (0:n)
        type(answer_type), intent(inout) :: correction(0:)
        type(size_type), allocatable :: sizes(:)
        integer :: n, i, odd

        n = ubound(nodes, 1)
        odd = modulo(n, 2)
        allocate (sizes(0:n))
        do i = 0, n, n
            call residual_chain(nodes, links, rhs, answers, residual, sizes, [i, i])
            call set_node(beam, i, nodes(i), residual(i))
        end do
        call residual_inside(nodes, links, rhs, beam%moment, beam%deflection, beam%turn, beam%shear)
        do i = 1, n/2 - 1
            beam%rows(i + odd)%turn(1) = beam%turn(i)
            beam%rows(i + odd)%shear(1) = beam%shear(i)
        end do
        do i = n/2 + 1, n - 1
            beam%rows(n - i)%turn(2) = beam%turn(i)
            beam%rows(n - i)%shear(2) = beam%shear(i)
        end do
        associate (middle => residual(n/2))
            middle = rhs_type(right=beam%turn(n/2), shear=beam%shear(n/2), deflection=beam%shear(n/2))
        end associate
        call solve_rows(beam, nodes, residual, correction)
        beam%has_rows = .false.
    end subroutine refine_rows

    !> The first node of a lane: without a moment, or with its restraint as what lies outside
    pure subroutine start_lane(lane, node, cell, row, sweep, eliminated)
        integer, intent(in) :: lane
        type(node_type), intent(in) :: node
        type(cell_type), intent(in) :: cell
        type(row_type), intent(in) :: row
        type(sweep_type), intent(inout) :: sweep
        type(eliminated_type), intent(inout) :: eliminated

        if (node%kind == restrained) then
            sweep%phi(lane) = node%compliance
            call step_alone(lane, cell, row, sweep, eliminated)
        else
            call start_at_free_end(lane, cell, row, sweep, eliminated)
        end if
    end subroutine start_lane

    !> The rows of a node
    pure subroutine set_row(node, rhs, lane, row)
        type(node_type), intent(in) :: node
        type(rhs_type), intent(in) :: rhs
        integer, intent(in) :: lane
        type(row_type), intent(inout) :: row

        row%turn(lane) = rhs%left + rhs%right
        if (node%held) then
            row%stiffness(lane) = 1.0_wp
            row%free(lane) = 0.0_wp
            row%shear(lane) = rhs%deflection
        else
            row%stiffness(lane) = node%stiffness
            row%free(lane) = 1.0_wp
            row%shear(lane) = rhs%shear
        end if
    end subroutine set_row

end module gapbeam_plain
