!> A beam of many elements as plain arrays, solved as fast as memory allows: every element end is a node.
!>
!> For fine meshes, and for programs that have such arrays already. Elements are assembled in small blocks that stay in the
!> first-level cache, right before the sweeps of gapbeam_kernel need them. Memory is passed through once each way:
!> 40 bytes of input, 48 of eliminated rows forward, 48 and 16 of output backward at each node.
module gapbeam_elements
    use gapbeam_kinds, only: wp
    use gapbeam_kernel, only: cell_type, row_type, eliminated_type, sweep_type, last_step, start_at_free_end, &
        sweep_inward, step_alone, meet, sweep_outward
    implicit none
    private
    public :: solve_elements, elements_solved, elements_mechanism, elements_bad_input

    !> What solve_elements found: a solution; an end that nothing holds; fewer than two elements, or a length or EI not positive
    integer, parameter :: elements_solved = 0, elements_mechanism = 1, elements_bad_input = 2
    !> Steps assembled at a time
    integer, parameter :: block_size = 64

    !> Loads of the elements outward of the nodes at hand: half of each, and the rotation it would make at their ends
    type :: outward_type
        real(wp) :: half(2) = 0.0_wp, turn(2) = 0.0_wp
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
        type(cell_type) :: cells(block_size)
        type(row_type) :: rows(block_size)
        type(sweep_type) :: sweep
        type(outward_type) :: outward
        integer :: n, odd, s, count, middle
        logical :: good

        n = size(length)
        odd = modulo(n, 2)
        state = elements_bad_input
        if (n < 2) return
        if (.not. (length(1) > 0.0_wp .and. ei(1) > 0.0_wp .and. length(n) > 0.0_wp .and. ei(n) > 0.0_wp)) return
        state = elements_mechanism
        if (.not. (stiffness(0) > 0.0_wp .and. stiffness(n) > 0.0_wp)) return
        state = elements_bad_input
        ! The ends; with an odd number of elements lane 2 is one step ahead
        call assemble(0, 1, cells, rows, outward, good)
        if (.not. good) return
        call start_at_free_end(2, cells(1), rows(1), sweep, eliminated(0))
        if (odd == 1) then
            outward%half(1) = 0.0_wp
            outward%turn(1) = 0.0_wp
            call assemble(1, 1, cells, rows, outward, good)
            if (.not. good) return
            call step_alone(2, cells(1), rows(1), sweep, eliminated(1))
        end if
        call start_at_free_end(1, cells(1), rows(1), sweep, eliminated(odd))
        do s = odd + 1, last_step(n), block_size
            count = min(block_size, last_step(n) - s + 1)
            call assemble(s, count, cells, rows, outward, good)
            if (.not. good) return
            call sweep_inward(cells(:count), rows(:count), sweep, eliminated(s:s + count - 1))
        end do
        middle = n/2
        associate (rigid => stiffness(middle) > huge(1.0_wp))
            call meet(merge(1.0_wp, stiffness(middle), rigid), merge(0.0_wp, 1.0_wp, rigid), sum(outward%turn), &
                      merge(0.0_wp, force(middle) + sum(outward%half), rigid), sweep, moment(middle), deflection(middle))
        end associate
        call sweep_outward(n, eliminated, moment, deflection)
        state = elements_solved

    contains

        !> Links and rows of some steps (method.md 2)
        pure subroutine assemble(first, count, cells, rows, outward, good)
            !> First step, and how many
            integer, intent(in) :: first, count
            type(cell_type), intent(inout) :: cells(:)
            type(row_type), intent(inout) :: rows(:)
            type(outward_type), intent(inout) :: outward
            !> Are all lengths and stiffnesses positive
            logical, intent(out) :: good
            real(wp), dimension(2) :: l, f, half, turn, c, free, shear
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
                rows(k)%shear = free*shear
                cells(k)%inverse = 1/l
                cells(k)%near = 2*f
                cells(k)%far = 2*f
                cells(k)%cross = f
                cells(k)%sum_near = 3*f
                cells(k)%sum_far = 3*f
                cells(k)%bending = 6*f
                cells(k)%determinant = 3*f*f
                outward%half = half
                outward%turn = turn
                i = i + 1
                j = j - 1
            end do
        end subroutine assemble

    end subroutine solve_elements

end module gapbeam_elements
