!> A finely meshed beam as plain arrays, every element end a node: one linear system, solved at the speed of memory.
!>
!> For fine meshes, and for programs that have such arrays already. Elements are assembled in small blocks that stay in the
!> first-level cache, right before the sweeps of gapbeam_kernel need them. Memory is passed through once each way:
!> 40 bytes of input, 48 of eliminated rows forward, 48 and 16 of output backward at each node.
module gapbeam_elements
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: cache_block
    use gapbeam_tolerances, only: splitter
    use gapbeam_require, only: checked, require
    use gapbeam_kernel, only: cell_type, row_type, eliminated_type, sweep_type, last_step, start_at_free_end, &
        sweep_inward, step_alone, meet, sweep_outward
    implicit none
    private
    public :: solve_elements, refine_elements, elements_solved, elements_mechanism, elements_bad_input

    !> What solve_elements found: a solution; an end that nothing holds; fewer than two elements, or a length or EI not positive
    integer, parameter :: elements_solved = 0, elements_mechanism = 1, elements_bad_input = 2

    !> The elements outward of the nodes at hand: half the load, the rotation it would make at their ends; rotation and shear
    !> of a solution at their inward ends, high and low part
    type :: outward_type
        real(wp), dimension(2) :: half = 0.0_wp, turn = 0.0_wp, psi = 0.0_wp, psi_low = 0.0_wp, v = 0.0_wp, v_low = 0.0_wp
    end type outward_type

contains

    !> Deflections and moments of a beam with free ends over springs and rigid supports that act both ways
    pure subroutine solve_elements(length, ei, q, stiffness, force, eliminated, deflection, moment, state)
        !> Length and EI of the elements, uniform load on them (force/length, down), shape (n), n >= 2
        real(wp), intent(in), contiguous :: length(:), ei(:), q(:)
        !> Stiffness of the support at each node (0 none, infinite rigid; the end nodes need one), force there (down), shape (0:n)
        real(wp), intent(in), contiguous :: stiffness(0:), force(0:)
        !> Room, shape (0:(n - 1)/2)
        type(eliminated_type), intent(inout), contiguous :: eliminated(0:)
        !> Deflection (down) and moment (sagging) at each node, shape (0:n)
        real(wp), intent(inout), contiguous :: deflection(0:), moment(0:)
        !> elements_solved; otherwise nothing is solved
        integer, intent(out) :: state
        integer :: n
        logical :: good

        n = size(length)
        state = elements_bad_input
        if (n < 2) return
        if (.not. (length(1) > 0.0_wp .and. ei(1) > 0.0_wp .and. length(n) > 0.0_wp .and. ei(n) > 0.0_wp)) return
        if (checked) call require(all([size(ei), size(q), size(stiffness) - 1, size(force) - 1, size(deflection) - 1, &
                                       size(moment) - 1] == n) .and. size(eliminated) > last_step(n), "solve_elements: shapes")
        state = elements_mechanism
        if (.not. (stiffness(0) > 0.0_wp .and. stiffness(n) > 0.0_wp)) return
        call sweep(length, ei, q, stiffness, force, eliminated, deflection, moment, good)
        state = merge(elements_solved, elements_bad_input, good)
    end subroutine solve_elements

    !> One step of iterative refinement of that solution.
    !>
    !> On a fine mesh the residual is lost in the rounding of (w_b - w_a)/L and (M_b - M_a)/L, quotients that nearly cancel from
    !> element to element; so these are kept with their remainders, and plain double does for the rest.
    pure subroutine refine_elements(length, ei, q, stiffness, force, eliminated, correction, deflection, moment)
        !> As for solve_elements
        real(wp), intent(in), contiguous :: length(:), ei(:), q(:), stiffness(0:), force(0:)
        type(eliminated_type), intent(inout), contiguous :: eliminated(0:)
        !> Room, shape (0:n, 2)
        real(wp), intent(inout), contiguous :: correction(0:, :)
        !> The solution
        real(wp), intent(inout), contiguous :: deflection(0:), moment(0:)
        logical :: good
        integer :: i

        call sweep(length, ei, q, stiffness, force, eliminated, correction(:, 1), correction(:, 2), good, deflection, moment)
        do i = 0, size(length)
            deflection(i) = deflection(i) + correction(i, 1)
            moment(i) = moment(i) + correction(i, 2)
        end do
    end subroutine refine_elements

    !> Assemble and solve, for the loads or for what a solution still lacks
    pure subroutine sweep(length, ei, q, stiffness, force, eliminated, deflection, moment, good, solved_w, solved_m)
        real(wp), intent(in), contiguous :: length(:), ei(:), q(:), stiffness(0:), force(0:)
        type(eliminated_type), intent(inout), contiguous :: eliminated(0:)
        real(wp), intent(inout), contiguous :: deflection(0:), moment(0:)
        !> Are all lengths and stiffnesses positive
        logical, intent(out) :: good
        !> Deflections and moments of a solution whose residuals take the place of the loads
        real(wp), intent(in), contiguous, optional :: solved_w(0:), solved_m(0:)
        type(cell_type) :: cells(cache_block)
        type(row_type) :: rows(cache_block)
        type(sweep_type) :: both
        type(outward_type) :: outward
        real(wp) :: turn, shear
        integer :: n, odd, s, count, middle
        logical :: rigid

        n = size(length)
        odd = modulo(n, 2)
        ! The ends; with an odd number of elements lane 2 is one step ahead
        call assemble(0, 1, cells, rows, outward, good)
        if (.not. good) return
        call start_at_free_end(2, cells(1), rows(1), both, eliminated(0))
        if (odd == 1) then
            outward%half(1) = 0.0_wp
            outward%turn(1) = 0.0_wp
            outward%psi(1) = 0.0_wp
            outward%psi_low(1) = 0.0_wp
            outward%v(1) = 0.0_wp
            outward%v_low(1) = 0.0_wp
            call assemble(1, 1, cells, rows, outward, good)
            if (.not. good) return
            call step_alone(2, cells(1), rows(1), both, eliminated(1))
        end if
        call start_at_free_end(1, cells(1), rows(1), both, eliminated(odd))
        do s = odd + 1, last_step(n), cache_block
            count = min(cache_block, last_step(n) - s + 1)
            call assemble(s, count, cells, rows, outward, good)
            if (.not. good) return
            call sweep_inward(cells(:count), rows(:count), both, eliminated(s:s + count - 1))
        end do
        middle = n/2
        rigid = stiffness(middle) > huge(1.0_wp)
        turn = sum(outward%turn)
        shear = force(middle) + sum(outward%half)
        if (present(solved_w)) then
            ! Seen from the right lane rotation and shear have the other sign
            turn = (turn - sum(outward%psi)) - sum(outward%psi_low)
            shear = ((shear - sum(outward%v)) - sum(outward%v_low)) - merge(0.0_wp, stiffness(middle), rigid)*solved_w(middle)
        end if
        call meet(merge(1.0_wp, stiffness(middle), rigid), merge(0.0_wp, 1.0_wp, rigid), turn, merge(0.0_wp, shear, rigid), &
                  both, moment(middle), deflection(middle))
        call sweep_outward(n, eliminated, moment, deflection)

    contains

        !> Links and rows of some steps (docs/method.md 2)
        pure subroutine assemble(first, count, cells, rows, outward, good)
            !> First step, and how many
            integer, intent(in) :: first, count
            type(cell_type), intent(inout) :: cells(:)
            type(row_type), intent(inout) :: rows(:)
            type(outward_type), intent(inout) :: outward
            !> Are all lengths and stiffnesses positive
            logical, intent(out) :: good
            real(wp), dimension(2) :: l, f, half, turn, c, free, shear, w, m, m_next, psi, psi_low, v, v_low
            integer :: k, i, j

            ! Step s takes lane 1 to node s - odd with element s - odd + 1, lane 2 to node n - s with element n - s
            i = max(first - odd + 1, 1)
            j = n - first
            good = all(length(i:i + count - 1) > 0.0_wp .and. ei(i:i + count - 1) > 0.0_wp) &
                .and. all(length(j - count + 1:j) > 0.0_wp .and. ei(j - count + 1:j) > 0.0_wp)
            if (.not. good) return
            do k = 1, count
                l = [length(i), length(j)]
                f = l/(6*[ei(i), ei(j)])
                half = [q(i), q(j)]*l/2
                turn = half*l*f/2
                c = [stiffness(i - 1), stiffness(j)]
                free = merge(0.0_wp, 1.0_wp, c > huge(1.0_wp))
                shear = [force(i - 1), force(j)] + outward%half + half
                rows(k)%stiffness = merge(1.0_wp, c, c > huge(1.0_wp))
                rows(k)%free = free
                rows(k)%turn = outward%turn + turn
                cells(k)%inverse = 1/l
                cells(k)%near = 2*f
                cells(k)%far = 2*f
                cells(k)%cross = f
                cells(k)%sum_near = 3*f
                cells(k)%sum_far = 3*f
                cells(k)%bending = 6*f
                cells(k)%determinant = 3*f*f
                if (present(solved_w)) then
                    w = [solved_w(i - 1), solved_w(j)]
                    m = [solved_m(i - 1), solved_m(j)]
                    m_next = [solved_m(i), solved_m(j - 1)]
                    call divide_difference([solved_w(i), solved_w(j - 1)], w, l, cells(k)%inverse, psi, psi_low)
                    call divide_difference(m_next, m, l, cells(k)%inverse, v, v_low)
                    rows(k)%turn = ((psi - outward%psi) + rows(k)%turn) + ((psi_low + f*(2*m + m_next)) - outward%psi_low)
                    shear = (((v - outward%v) + shear) + (v_low - outward%v_low)) - free*rows(k)%stiffness*w
                    outward%psi = psi
                    outward%psi_low = psi_low - f*(m + 2*m_next)
                    outward%v = v
                    outward%v_low = v_low
                end if
                rows(k)%shear = free*shear
                outward%half = half
                outward%turn = turn
                i = i + 1
                j = j - 1
            end do
        end subroutine assemble

    end subroutine sweep

    !> (a - b)/l as a double and what is missing in it, by error-free difference and product (Knuth 1969, Dekker 1971)
    pure subroutine divide_difference(a, b, l, inverse, high, low)
        !> inverse is 1/l; what high lacks by its rounding is in low
        real(wp), intent(in) :: a(2), b(2), l(2), inverse(2)
        real(wp), intent(out) :: high(2), low(2)
        real(wp), dimension(2) :: d, t, lost, p

        d = a - b
        t = d - a
        lost = (a - (d - t)) - (b + t)
        high = d*inverse
        p = high*l
        low = (((d - p) - product_error(high, l, p)) + lost)*inverse
    end subroutine divide_difference

    include 'elimination/product_error.inc'

end module gapbeam_elements
