!> The mixed system of a plain beam, no hinges inside, solved from both ends at once.
!>
!> The elimination is that of gapbeam_band (three numbers phi, beta, delta, all terms nonnegative), but factor and right-hand
!> side go together, and the right half is swept from the right end. Seen in a mirror it is the same problem: M and w
!> keep their signs, so do the right-hand sides, and only the two ends of a link change places. So the two sweeps are the two
!> lanes of every array here: lane 1 from the left, lane 2 from the right. They do not depend on each other,
!> the processor divides for both in one instruction, and where they meet their numbers add up. A rigid support
!> (w known) is the same formula with its spring replaced by 1 and the terms of w struck out, so there are no branches.
!>
!> With n links, lane 2 makes steps 0 to (n - 1)/2, at step s for node n - s; lane 1 makes the same steps but step 0 if n is
!> odd, at step s for node s - modulo(n, 2). They meet at node n/2.
module gapbeam_kernel
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: cell_type, row_type, eliminated_type, sweep_type
    public :: last_step, start_at_free_end, step_alone, sweep_inward, meet, sweep_outward

    !> The links inward of two nodes
    type :: cell_type
        !> 1/length
        real(wp) :: inverse(2)
        !> Flexibilities of gapbeam_link: at the node, at the far end, between them, the sums near + cross and far + cross
        real(wp), dimension(2) :: near, far, cross, sum_near, sum_far
        !> near + far + 2 cross, near far - cross**2
        real(wp), dimension(2) :: bending, determinant
    end type cell_type

    !> The rows of two nodes
    type :: row_type
        !> Stiffness of the supports, 1 where one is rigid
        real(wp) :: stiffness(2)
        !> 1 where the deflection is unknown, 0 where it is known
        real(wp) :: free(2)
        !> Right-hand side of compatibility; of equilibrium, or the known deflection
        real(wp) :: turn(2), shear(2)
    end type row_type

    !> The eliminated rows of two nodes, with the next nodes inward, M' and w':
    !> M = moment + moment_m M' - moment_w w', w = deflection + deflection_m M' + deflection_w w'
    type :: eliminated_type
        real(wp), dimension(2) :: moment, deflection, moment_m, moment_w, deflection_m, deflection_w
    end type eliminated_type

    !> What the nodes outside pass on: psi = -phi M + beta w - e, V = beta M + delta w - p
    type :: sweep_type
        real(wp), dimension(2) :: phi = 0.0_wp, beta = 0.0_wp, delta = 0.0_wp, e = 0.0_wp, p = 0.0_wp
    end type sweep_type

contains

    !> Number of the last step
    elemental function last_step(n) result(step)
        !> Links, two or more
        integer, intent(in) :: n
        integer :: step

        step = (n - 1)/2
    end function last_step

    !> The first node of a lane, at an end without a moment
    pure subroutine start_at_free_end(lane, cell, row, sweep, eliminated)
        integer, intent(in) :: lane
        type(cell_type), intent(in) :: cell
        type(row_type), intent(in) :: row
        type(sweep_type), intent(inout) :: sweep
        type(eliminated_type), intent(inout) :: eliminated
        real(wp) :: softness

        associate (h => cell%inverse(lane), far => cell%far(lane), stiff => row%stiffness(lane), free => row%free(lane), &
                   load => row%shear(lane), phi => sweep%phi(lane), beta => sweep%beta(lane), delta => sweep%delta(lane), &
                   e => sweep%e(lane), p => sweep%p(lane), moment => eliminated%moment(lane), &
                   deflection => eliminated%deflection(lane), moment_m => eliminated%moment_m(lane), &
                   moment_w => eliminated%moment_w(lane), deflection_m => eliminated%deflection_m(lane), &
                   deflection_w => eliminated%deflection_w(lane))
            include 'elimination/node_start.inc'
        end associate
    end subroutine start_at_free_end

    !> A step of one lane while the other stands still
    pure subroutine step_alone(lane, cell, row, sweep, eliminated)
        integer, intent(in) :: lane
        type(cell_type), intent(in) :: cell
        type(row_type), intent(in) :: row
        type(sweep_type), intent(inout) :: sweep
        type(eliminated_type), intent(inout) :: eliminated
        type(cell_type) :: cells(1)
        type(row_type) :: rows(1)
        type(eliminated_type) :: result(1)
        type(sweep_type) :: both
        integer :: twice(2)

        ! Both lanes make the step of the one
        twice = lane
        cells(1) = cell_type(cell%inverse(twice), cell%near(twice), cell%far(twice), cell%cross(twice), cell%sum_near(twice), &
                             cell%sum_far(twice), cell%bending(twice), cell%determinant(twice))
        rows(1) = row_type(row%stiffness(twice), row%free(twice), row%turn(twice), row%shear(twice))
        both = sweep_type(sweep%phi(twice), sweep%beta(twice), sweep%delta(twice), sweep%e(twice), sweep%p(twice))
        call sweep_inward(cells, rows, both, result)
        sweep%phi(lane) = both%phi(lane)
        sweep%beta(lane) = both%beta(lane)
        sweep%delta(lane) = both%delta(lane)
        sweep%e(lane) = both%e(lane)
        sweep%p(lane) = both%p(lane)
        eliminated%moment(lane) = result(1)%moment(lane)
        eliminated%deflection(lane) = result(1)%deflection(lane)
        eliminated%moment_m(lane) = result(1)%moment_m(lane)
        eliminated%moment_w(lane) = result(1)%moment_w(lane)
        eliminated%deflection_m(lane) = result(1)%deflection_m(lane)
        eliminated%deflection_w(lane) = result(1)%deflection_w(lane)
    end subroutine step_alone

    !> Steps of both lanes
    pure subroutine sweep_inward(cells, rows, sweep, eliminated)
        !> Links and rows of every step
        type(cell_type), intent(in), contiguous :: cells(:)
        type(row_type), intent(in), contiguous :: rows(:)
        type(sweep_type), intent(inout) :: sweep
        !> Shape (size(cells))
        type(eliminated_type), intent(inout), contiguous :: eliminated(:)
        real(wp), dimension(2) :: phi, beta, delta, e, p, a, b, c, reciprocal, b_free, c_h, next, turn_here, load_here
        real(wp), dimension(2) :: h, near, far, cross, sum_near, sum_far, bending, determinant, stiff, free, turn, load
        real(wp), dimension(2) :: moment, deflection, moment_m, moment_w, deflection_m, deflection_w
        integer :: s

        phi = sweep%phi
        beta = sweep%beta
        delta = sweep%delta
        e = sweep%e
        p = sweep%p
        do s = 1, size(cells)
            associate (cell => cells(s), row => rows(s))
                h = cell%inverse
                near = cell%near
                far = cell%far
                cross = cell%cross
                sum_near = cell%sum_near
                sum_far = cell%sum_far
                bending = cell%bending
                determinant = cell%determinant
                stiff = row%stiffness
                free = row%free
                turn = row%turn
                load = row%shear
            end associate
            include 'elimination/node_step.inc'
            eliminated(s) = eliminated_type(moment, deflection, moment_m, moment_w, deflection_m, deflection_w)
        end do
        sweep = sweep_type(phi, beta, delta, e, p)
    end subroutine sweep_inward

    !> The node at which the lanes meet
    pure subroutine meet(stiff, free, turn, load, sweep, moment, deflection)
        !> Its rows, as in row_type
        real(wp), intent(in) :: stiff, free, turn, load
        type(sweep_type), intent(in) :: sweep
        !> Its moment and deflection
        real(wp), intent(out) :: moment, deflection
        real(wp) :: phi, beta, delta, e, p, a, b, c, b_free, reciprocal, turn_here, load_here

        phi = sum(sweep%phi)
        beta = sum(sweep%beta)
        delta = sum(sweep%delta)
        e = sum(sweep%e)
        p = sum(sweep%p)
        include 'elimination/node_meeting.inc'
    end subroutine meet

    !> Substitute from the node at which the lanes met to both ends
    pure subroutine sweep_outward(n, eliminated, moment, deflection)
        !> Links
        integer, intent(in) :: n
        !> Eliminated rows of every step, shape (0:last_step(n))
        type(eliminated_type), intent(in), contiguous :: eliminated(0:)
        !> Moments and deflections, shape (0:n), those of node n/2 in
        real(wp), intent(inout), contiguous :: moment(0:), deflection(0:)
        real(wp), dimension(2) :: m, w, next
        integer :: s, odd

        odd = modulo(n, 2)
        m = moment(n/2)
        w = deflection(n/2)
        do s = last_step(n), 0, -1
            associate (x => eliminated(s))
                next = x%moment + x%moment_m*m - x%moment_w*w
                w = x%deflection + x%deflection_m*m + x%deflection_w*w
                m = next
            end associate
            moment(n - s) = m(2)
            deflection(n - s) = w(2)
            if (s < odd) exit
            moment(s - odd) = m(1)
            deflection(s - odd) = w(1)
        end do
    end subroutine sweep_outward

end module gapbeam_kernel
