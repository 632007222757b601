!> Fields anywhere along the beam, and their extremes
module gapbeam_fields
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type, fields_at
    use gapbeam_link, only: link_type, piece_type, load_type, combine_loads, recover_link
    use gapbeam_band, only: hinge
    use gapbeam_polynomial, only: roots_between, highest_degree
    implicit none
    private
    public :: recover_beam, values_at, find_extremes

contains

    !> Fields at the left end of every piece from the solution at the nodes
    pure subroutine recover_beam(pieces, dead, live, factor, links, last, kind, w, moment_left, moment_right, shear, &
                                 starts)
        !> Pieces and their loads, shape (npiece)
        type(piece_type), intent(in) :: pieces(:)
        type(load_type), intent(in) :: dead(:), live(:)
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
        type(load_type), allocatable :: loads(:)
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
        integer :: i, n

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
        do i = 2, n
            if (kind(i - 1) /= hinge .and. rounding(i - 1) < rounding(i)) then
                psi(i) = psi(i - 1) - bend(i - 1)
                rounding(i) = rounding(i - 1)
            end if
        end do
        do i = n - 1, 1, -1
            if (kind(i) /= hinge .and. rounding(i + 1) < rounding(i)) then
                psi(i) = psi(i + 1) + bend(i)
                rounding(i) = rounding(i + 1)
            end if
        end do
    end subroutine end_rotations

    !> Fields at given places
    pure subroutine values_at(pieces, dead, live, factor, starts, piece, distance, fields)
        !> Pieces, loads, factor of the live loads and fields at the pieces' left ends
        type(piece_type), intent(in) :: pieces(:)
        type(load_type), intent(in) :: dead(:), live(:)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        !> The piece of each place (1-based) and the distance from its left end, shape (m)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> The values, shape (m)
        type(field_type), intent(out) :: fields(:)
        type(load_type) :: load
        integer :: i, j

        do i = 1, size(piece)
            j = piece(i)
            load = combine_loads(dead(j), live(j), factor)
            fields(i) = fields_at(starts(j), distance(i), pieces(j)%length, pieces(j)%flexibility, &
                                  pieces(j)%shear_flexibility, load%qa, load%qb, load%kappa)
        end do
    end subroutine values_at

    !> Largest and smallest value of every field, with their places: at the ends of the pieces and where the
    !> derivative of the field, a polynomial of degree 4 at most, changes sign
    pure subroutine find_extremes(pieces, dead, live, factor, starts, values, piece, distance)
        !> As for values_at
        type(piece_type), intent(in) :: pieces(:)
        type(load_type), intent(in) :: dead(:), live(:)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        !> Maximum (1) and minimum (2) of deflection, rotation, moment, shear, shape (2, 4), and where they are
        real(wp), intent(out) :: values(:, :)
        integer, intent(out) :: piece(:, :)
        real(wp), intent(out) :: distance(:, :)
        type(load_type) :: q
        real(wp) :: c(0:highest_degree, 4), roots(highest_degree), slope
        integer :: degree(4), j, k, i, number

        values(1, :) = -huge(1.0_wp)
        values(2, :) = huge(1.0_wp)
        piece = 1
        distance = 0.0_wp
        do j = 1, size(pieces)
            q = combine_loads(dead(j), live(j), factor)
            do k = 1, 4
                call consider(j, 0.0_wp, k, pieces(j), q, starts(j), values(:, k), piece(:, k), distance(:, k))
                call consider(j, pieces(j)%length, k, pieces(j), q, starts(j), values(:, k), piece(:, k), distance(:, k))
            end do
            ! Derivatives of the four fields as polynomials in the distance from the left end
            associate (f => pieces(j)%flexibility, g => pieces(j)%shear_flexibility, a => starts(j))
                slope = (q%qb - q%qa)/pieces(j)%length
                c = 0.0_wp
                c(0:1, 4) = [-q%qa, -slope]
                c(0:2, 3) = [a%shear, -q%qa, -slope/2]
                c(0:3, 2) = [q%kappa - f*a%moment, -f*a%shear, f*q%qa/2, f*slope/6]
                c(0, 1) = a%rotation + g*a%shear
                c(1, 1) = q%kappa - f*a%moment - g*q%qa
                c(2, 1) = -f*a%shear/2 - g*slope/2
                c(3, 1) = f*q%qa/6
                c(4, 1) = f*slope/24
            end associate
            degree = [4, 3, 2, 1]
            do k = 1, 4
                call roots_between(c(0:degree(k), k), pieces(j)%length, roots, number)
                do i = 1, number
                    call consider(j, roots(i), k, pieces(j), q, starts(j), values(:, k), piece(:, k), distance(:, k))
                end do
            end do
        end do
    end subroutine find_extremes

    !> Compare one field at one place with its extremes so far
    pure subroutine consider(j, s, k, piece, load, start, values, pieces, distances)
        !> Number of the piece, distance from its left end, number of the field
        integer, intent(in) :: j
        real(wp), intent(in) :: s
        integer, intent(in) :: k
        !> The piece, its load, the fields at its left end
        type(piece_type), intent(in) :: piece
        type(load_type), intent(in) :: load
        type(field_type), intent(in) :: start
        !> Maximum and minimum so far and their places
        real(wp), intent(inout) :: values(:)
        integer, intent(inout) :: pieces(:)
        real(wp), intent(inout) :: distances(:)
        type(field_type) :: fields
        real(wp) :: value

        fields = fields_at(start, s, piece%length, piece%flexibility, piece%shear_flexibility, &
                           load%qa, load%qb, load%kappa)
        select case (k)
        case (1)
            value = fields%deflection
        case (2)
            value = fields%rotation
        case (3)
            value = fields%moment
        case default
            value = fields%shear
        end select
        if (value > values(1)) then
            values(1) = value
            pieces(1) = j
            distances(1) = s
        end if
        if (value < values(2)) then
            values(2) = value
            pieces(2) = j
            distances(2) = s
        end if
    end subroutine consider

end module gapbeam_fields
