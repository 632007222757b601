!> Fields anywhere along the beam, and their extremes
module gapbeam_fields
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: extreme_margin
    use gapbeam_element, only: field_type, fields_at
    use gapbeam_link, only: piece_type, piece_load_type, combine_loads
    use gapbeam_polynomial, only: roots_between, highest_degree
    implicit none
    private
    public :: values_at, find_extremes

    !> Degrees of the derivatives of deflection, rotation, moment, shear along a piece
    integer, parameter :: degree(4) = [4, 3, 2, 1]
    !> Binomial coefficients i of n, shape (1:5, 2:5)
    real(wp), parameter :: chosen(5, 2:5) = reshape([real(wp) :: 2, 1, 0, 0, 0, 3, 3, 1, 0, 0, 4, 6, 4, 1, 0, 5, 10, 10, 5, 1], &
                                                    [5, 4])

contains

    !> Fields at given places
    pure subroutine values_at(pieces, dead, live, factor, starts, piece, distance, fields)
        !> Pieces, loads, factor of the live loads and fields at the pieces' left ends
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: dead(:), live(:)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        !> The piece of each place (1-based) and the distance from its left end, shape (m)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> The values, shape (m)
        type(field_type), intent(out) :: fields(:)
        type(piece_load_type) :: load
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
        type(piece_load_type), intent(in) :: dead(:), live(:)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        !> Maximum (1) and minimum (2) of deflection, rotation, moment, shear, shape (2, 4), and where they are
        real(wp), intent(out) :: values(:, :)
        integer, intent(out) :: piece(:, :)
        real(wp), intent(out) :: distance(:, :)
        type(piece_load_type) :: q
        real(wp) :: c(0:highest_degree, 4), roots(highest_degree), slope, left(4), right(4)
        logical :: near(4)
        integer :: j, k, i, number

        values(1, :) = -huge(1.0_wp)
        values(2, :) = huge(1.0_wp)
        piece = 1
        distance = 0.0_wp
        ! Ends of all pieces first, so that little is left to look for inside
        do j = 1, size(pieces)
            q = combine_loads(dead(j), live(j), factor)
            left = [starts(j)%deflection, starts(j)%rotation, starts(j)%moment, starts(j)%shear]
            right = fields_here(pieces(j)%length)
            do k = 1, 4
                ! Not of numbers that are none
                if (left(k) < values(1, k) .and. right(k) < values(1, k) .and. left(k) > values(2, k) &
                    .and. right(k) > values(2, k)) cycle
                call consider(j, 0.0_wp, left(k), values(:, k), piece(:, k), distance(:, k))
                call consider(j, pieces(j)%length, right(k), values(:, k), piece(:, k), distance(:, k))
            end do
        end do
        do j = 1, size(pieces)
            q = combine_loads(dead(j), live(j), factor)
            left = [starts(j)%deflection, starts(j)%rotation, starts(j)%moment, starts(j)%shear]
            near = .not. far_from(pieces(j), q, left, fields_here(pieces(j)%length), values)
            if (.not. any(near)) cycle
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
            do k = 1, 4
                if (.not. near(k)) cycle
                if (stays_between(c(0:degree(k), k), pieces(j)%length, left(k), values(:, k))) cycle
                call roots_between(c(0:degree(k), k), pieces(j)%length, roots, number)
                do i = 1, number
                    right = fields_here(roots(i))
                    call consider(j, roots(i), right(k), values(:, k), piece(:, k), distance(:, k))
                end do
            end do
        end do

    contains

        !> The four fields at a distance from the left end of the piece at hand
        pure function fields_here(s) result(found)
            real(wp), intent(in) :: s
            real(wp) :: found(4)
            type(field_type) :: fields

            fields = fields_at(starts(j), s, pieces(j)%length, pieces(j)%flexibility, pieces(j)%shear_flexibility, q%qa, q%qb, &
                               q%kappa)
            found = [fields%deflection, fields%rotation, fields%moment, fields%shear]
        end function fields_here

    end subroutine find_extremes

    !> Which fields are inside a piece nowhere near what is known already: they are no farther from the chord of their ends than
    !> length**2/8 times the largest second derivative
    pure function far_from(piece, load, left, right, known) result(far)
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        !> The four fields at its ends
        real(wp), intent(in) :: left(4), right(4)
        !> Largest and smallest values so far, shape (2, 4)
        real(wp), intent(in) :: known(:, :)
        logical :: far(4)
        real(wp) :: bend(4), share, most, slope
        integer :: k

        share = piece%length**2/8
        most = max(abs(load%qa), abs(load%qb))
        slope = abs(load%qb - load%qa)/piece%length
        bend(1) = abs(load%kappa) + piece%flexibility*(max(abs(left(3)), abs(right(3))) + share*most) &
            + piece%shear_flexibility*most
        bend(2) = piece%flexibility*(max(abs(left(4)), abs(right(4))) + share*slope)
        bend(3) = most
        bend(4) = slope
        do k = 1, 4
            bend(k) = share*bend(k)
            bend(k) = bend(k) + extreme_margin*(abs(left(k)) + abs(right(k)) + bend(k))
            far(k) = bend(k) <= huge(1.0_wp)
            if (.not. far(k)) cycle
            far(k) = max(left(k), right(k)) + bend(k) < known(1, k) .and. min(left(k), right(k)) - bend(k) > known(2, k)
        end do
    end function far_from

    !> Is a field inside a piece nowhere near what is known already: it stays between its Bernstein coefficients, here those on both
    !> halves of the piece (Lane and Riesenfeld 1981)
    pure function stays_between(derivative, length, start, known) result(yes)
        !> Coefficients of the derivative, shape (0:n - 1), n at most 5
        real(wp), intent(in) :: derivative(0:)
        !> Length of the piece, and the field at its left end
        real(wp), intent(in) :: length, start
        !> Largest and smallest value so far
        real(wp), intent(in) :: known(2)
        logical :: yes
        real(wp) :: b(0:5), power, size, low, high
        integer :: n, i, j

        n = ubound(derivative, 1) + 1
        b(0) = start
        size = abs(start)
        power = 1.0_wp
        do i = 1, n
            power = power*length
            b(i) = derivative(i - 1)*power/i
            size = size + abs(b(i))
            b(i) = b(i)/chosen(i, n)
        end do
        ! What leaves the range of doubles has no bounds
        yes = size <= huge(size)/64
        if (.not. yes) return
        yes = size*(1 + extreme_margin) < min(known(1), -known(2))
        if (yes) return
        do i = 1, n
            do j = n, i, -1
                b(j) = b(j) + b(j - 1)
            end do
        end do
        low = minval(b(0:n)) - extreme_margin*size
        high = maxval(b(0:n)) + extreme_margin*size
        yes = high < known(1) .and. low > known(2)
        if (yes) return
        ! Halved (de Casteljau): those of the right half pass by at the end of the array, those of the left one are left in it
        low = b(n)
        high = b(n)
        do i = 1, n
            do j = n, i, -1
                b(j) = 0.5_wp*(b(j) + b(j - 1))
            end do
            low = min(low, b(n))
            high = max(high, b(n))
        end do
        low = min(low, minval(b(0:n)))
        high = max(high, maxval(b(0:n)))
        yes = high + extreme_margin*size < known(1) .and. low - extreme_margin*size > known(2)
    end function stays_between

    !> Above and below all numbers
    pure function infinities() result(values)
        use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf, ieee_negative_inf   ! see infinity of gapbeam_units
        real(wp) :: values(2)

        values(:) = [ieee_value(1.0_wp, ieee_positive_inf), ieee_value(1.0_wp, ieee_negative_inf)]
    end function infinities

    !> Compare the value of a field at one place with its extremes so far
    pure subroutine consider(j, s, value, values, pieces, distances)
        !> Number of the piece, distance from its left end, the value there
        integer, intent(in) :: j
        real(wp), intent(in) :: s, value
        !> Maximum and minimum so far and their places
        real(wp), intent(inout) :: values(:)
        integer, intent(inout) :: pieces(:)
        real(wp), intent(inout) :: distances(:)

        if (.not. abs(value) <= huge(value)) then
            ! Nothing is beyond it: who asked will see it
            values(:) = infinities()
            pieces(:) = j
            distances(:) = s
            return
        end if
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
