!> Fields at the left end of every piece, recovered from the solution at the nodes.
module gapbeam_recover
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type
    use gapbeam_link, only: link_type, piece_type, piece_load_type, combine_loads, recover_link
    use gapbeam_nodes, only: hinge
    implicit none
    private
    public :: recover_beam

contains

    !> Fields at the left end of every piece from the solution at the nodes
    pure subroutine recover_beam(pieces, dead, live, factor, links, last, kind, w, moment_left, moment_right, shear, &
                                 starts)
        !> Pieces and their loads, shape (npiece)
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: dead(:), live(:)
        !> Factor of the live loads
        real(wp), intent(in) :: factor
        !> Links, shape (n), and the last piece of each
        type(link_type), intent(in) :: links(:)
        integer, intent(in) :: last(:)
        !> Kinds of the nodes, their deflections, moments left and right of them, shape (0:n)
        integer, intent(in) :: kind(0:)
        real(wp), intent(in) :: w(0:), moment_left(0:), moment_right(0:)
        !> Shear of every link beside that of the simple bar, shape (n)
        real(wp), intent(in) :: shear(:)
        !> The fields, shape (npiece)
        type(field_type), intent(out) :: starts(:)
        type(piece_load_type), allocatable :: loads(:)
        real(wp), allocatable :: work(:, :), psi(:)
        integer :: i, first, longest

        longest = last(1)
        do i = 2, size(links)
            longest = max(longest, last(i) - last(i - 1))
        end do
        allocate (loads(longest), work(longest, 3), psi(size(links)))
        call end_rotations(links, factor, kind, w, moment_left, moment_right, psi)
        first = 1
        do i = 1, size(links)
            associate (n => last(i) - first + 1, link => links(i))
                loads(1:n) = combine_loads(dead(first:last(i)), live(first:last(i)), factor)
                call recover_link(pieces(first:last(i)), loads(1:n), link%length, moment_right(i - 1), &
                                  moment_left(i), shear(i), w(i - 1), w(i), psi(i), work, starts(first:last(i)))
            end associate
            first = last(i) + 1
        end do
    end subroutine recover_beam

    !> Rotation at the left end of every link: from its own chord, or, where that is short and its deflections are
    !> large, through a node that is no hinge from the chord of a neighbour
    pure subroutine end_rotations(links, factor, kind, w, moment_left, moment_right, psi)
        type(link_type), intent(in) :: links(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: kind(0:)
        real(wp), intent(in) :: w(0:), moment_left(0:), moment_right(0:)
        real(wp), intent(out) :: psi(:)
        real(wp) :: turn_a, turn_b, part, largest
        real(wp), allocatable :: rounding(:), bend(:)
        integer :: i, j, k, n, way

        n = size(links)
        allocate (rounding(n), bend(n))
        do i = 1, n
            associate (link => links(i), m => moment_right(i - 1), z => moment_left(i))
                turn_a = link%turn_a(1) + factor*link%turn_a(2)
                turn_b = link%turn_b(1) + factor*link%turn_b(2)
                part = link%faa*m + link%fab*z
                psi(i) = (w(i) - w(i - 1))/link%length + part + turn_a
                ! From end to end the rotation falls by this much
                bend(i) = (link%sum_a*m + link%sum_b*z) + (turn_a + turn_b)
                largest = max(abs(turn_a), abs(turn_b), link%bending*abs(m), link%bending*abs(z))
                rounding(i) = (abs(w(i)) + abs(w(i - 1)))/link%length + largest
            end associate
        end do
        do way = 1, -1, -2
            do i = merge(2, n - 1, way == 1), merge(n, 1, way == 1), way
                ! By that of link k, across node j
                k = i - way
                j = min(i, k)
                if (kind(j) == hinge .or. .not. rounding(k) < rounding(i)) cycle
                psi(i) = psi(k) - way*bend(j)
                rounding(i) = rounding(k)
            end do
        end do
    end subroutine end_rotations

end module gapbeam_recover
