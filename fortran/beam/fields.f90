!> Fields anywhere along the beam, and their extremes
module gapbeam_fields
    use gapbeam_kinds, only: wp, infinity
    use gapbeam_tolerances, only: extreme_margin
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, piece_load_type, combine_loads
    use gapbeam_piece, only: is_tapered, curvature_at
    use gapbeam_taper, only: fields_in_piece, softness_at
    use gapbeam_taper_extremes, only: find_turning_places, most_places
    use gapbeam_quantities, only: state_count, derived_count, bending_count, bending, shares_of, terms_of_derived, &
        with_derived
    use gapbeam_polynomial, only: roots_between, highest_degree
    implicit none
    private
    public :: values_at, find_extremes, bending_values, softness_of

    !> Degrees of the derivatives of deflection, rotation, moment, shear along a piece
    integer, parameter :: degree_of_state(state_count) = [4, 3, 2, 1]
    !> Binomial coefficients i of n, shape (1:5, 2:5)
    real(wp), parameter :: chosen(5, 2:5) = reshape([real(wp) :: 2, 1, 0, 0, 0, 3, 3, 1, 0, 0, 4, 6, 4, 1, 0, 5, 10, 10, 5, 1], &
                                                    [5, 4])

contains

    !> 1/EI and 1/GA
    pure function softness_of(piece) result(softness)
        type(piece_type), intent(in) :: piece
        real(wp) :: softness(2)

        softness(:) = [piece%flexibility, piece%shear_flexibility]
    end function softness_of

    !> The quantities of bending (gapbeam_quantities) of a section
    pure function bending_values(field, piece, kappa, distance) result(values)
        type(field_type), intent(in) :: field
        !> Its piece, and the curvature imposed on that
        type(piece_type), intent(in) :: piece
        real(wp), intent(in) :: kappa
        !> From its left end, where it may be tapered
        real(wp), intent(in), optional :: distance
        real(wp) :: values(bending_count), softness(2)

        softness(:) = softness_of(piece)
        if (present(distance)) softness(:) = softness_at(piece, distance)
        values(:) = with_derived([field%deflection, field%rotation, field%moment, field%shear], softness, kappa)
    end function bending_values

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
            fields(i) = fields_in_piece(starts(j), distance(i), pieces(j), load)
        end do
    end subroutine values_at

    !> Largest and smallest value of every field, with their places: at the ends of the pieces and where the
    !> derivative of the field changes sign: a polynomial of degree 4 at most, unless the piece is tapered
    pure subroutine find_extremes(pieces, dead, live, factor, starts, values, piece, distance)
        !> As for values_at
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: dead(:), live(:)
        real(wp), intent(in) :: factor
        type(field_type), intent(in) :: starts(:)
        !> Maximum (1) and minimum (2) of the quantities of bending (gapbeam_quantities), and where they are, shape
        !> (2, bending_count)
        real(wp), intent(out) :: values(:, :)
        integer, intent(out) :: piece(:, :)
        real(wp), intent(out) :: distance(:, :)
        type(piece_load_type) :: q
        real(wp) :: c(0:highest_degree, bending_count), roots(most_places), left(bending_count), right(bending_count)
        real(wp) :: share(state_count + 1, derived_count)
        logical :: near(bending_count), tapered
        integer :: degree(bending_count), j, k, i, number

        values(1, :) = -huge(1.0_wp)
        values(2, :) = huge(1.0_wp)
        piece = 1
        distance = 0.0_wp
        ! Ends of all pieces first, so that little is left to look for inside
        do j = 1, size(pieces)
            q = combine_loads(dead(j), live(j), factor)
            left = values_of(starts(j), 0.0_wp)
            right = fields_here(pieces(j)%length)
            do k = 1, bending_count
                ! Not of numbers that are none
                if (left(k) < values(1, k) .and. right(k) < values(1, k) .and. left(k) > values(2, k) &
                    .and. right(k) > values(2, k)) cycle
                call consider(j, 0.0_wp, left(k), values(:, k), piece(:, k), distance(:, k))
                call consider(j, pieces(j)%length, right(k), values(:, k), piece(:, k), distance(:, k))
            end do
        end do
        degree(1:state_count) = degree_of_state
        degree(state_count + 1:) = maxval(spread(degree_of_state, 2, derived_count), 1, terms_of_derived())
        do j = 1, size(pieces)
            q = combine_loads(dead(j), live(j), factor)
            left = values_of(starts(j), 0.0_wp)
            tapered = is_tapered(pieces(j))
            near = tapered .or. .not. far_from(pieces(j), q, left, fields_here(pieces(j)%length), values)
            if (.not. any(near)) cycle
            ! Derivatives of the fields as polynomials in the distance from the left end
            associate (f => pieces(j)%flexibility, g => pieces(j)%shear_flexibility, a => starts(j))
                c = 0.0_wp
                call derive_deflection(pieces(j)%length, f, g, q%qa, q%qb, q%kappa, a%rotation, a%moment, a%shear, c(0, 1), &
                                       c(1, 1), c(2, 1), c(3, 1), c(4, 1))
                call derive_rotation(pieces(j)%length, f, q%qa, q%qb, q%kappa, a%moment, a%shear, c(0, 2), c(1, 2), &
                                     c(2, 2), c(3, 2))
                call derive_moment(pieces(j)%length, q%qa, q%qb, a%shear, c(0, 3), c(1, 3), c(2, 3))
                c(0:1, 4) = [-q%qa, (q%qa - q%qb)/pieces(j)%length]
            end associate
            share = shares_of(softness_of(pieces(j)))
            c(:, state_count + 1:) = matmul(c(:, 1:state_count), share(1:state_count, :))
            if (abs(q%rise) > 0.0_wp) then
                c(2, 1) = c(2, 1) + q%rise/pieces(j)%length/2
                c(1, 2) = c(1, 2) + q%rise/pieces(j)%length
                c(0, state_count + 1:) = c(0, state_count + 1:) + share(state_count + 1, :)*(q%rise/pieces(j)%length)
            end if
            do k = 1, bending_count
                if (.not. near(k)) cycle
                if (tapered) then
                    call find_turning_places(pieces(j), q, starts(j), bending(k), roots, number)
                else
                    if (stays_between(c(0:degree(k), k), pieces(j)%length, left(k), values(:, k))) cycle
                    call roots_between(c(0:degree(k), k), pieces(j)%length, roots, number)
                end if
                do i = 1, number
                    right = fields_here(roots(i))
                    call consider(j, roots(i), right(k), values(:, k), piece(:, k), distance(:, k))
                end do
            end do
        end do

    contains

        !> The quantities at a distance from the left end of the piece at hand
        pure function fields_here(s) result(found)
            real(wp), intent(in) :: s
            real(wp) :: found(bending_count)

            found = values_of(fields_in_piece(starts(j), s, pieces(j), q), s)
        end function fields_here

        !> The quantities of a section of the piece at hand
        pure function values_of(field, s) result(values)
            type(field_type), intent(in) :: field
            real(wp), intent(in) :: s
            real(wp) :: values(bending_count)

            values = bending_values(field, pieces(j), curvature_at(q, s, pieces(j)%length), s)
        end function values_of

    end subroutine find_extremes

    !> Which fields are inside a piece nowhere near what is known already: they are no farther from the chord of their ends than
    !> length**2/8 times the largest second derivative
    pure function far_from(piece, load, left, right, known) result(far)
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        !> The quantities at its ends
        real(wp), intent(in) :: left(bending_count), right(bending_count)
        !> Largest and smallest values so far, shape (2, bending_count)
        real(wp), intent(in) :: known(:, :)
        logical :: far(bending_count)
        real(wp) :: bend(bending_count), shares(state_count + 1, derived_count), share, most, slope
        integer :: k

        share = piece%length**2/8
        most = max(abs(load%qa), abs(load%qb))
        slope = abs(load%qb - load%qa)/piece%length
        bend(1) = abs(load%kappa) + abs(load%rise) + piece%flexibility*(max(abs(left(3)), abs(right(3))) + share*most) &
            + piece%shear_flexibility*most
        bend(2) = piece%flexibility*(max(abs(left(4)), abs(right(4))) + share*slope) + abs(load%rise)/piece%length
        bend(3) = most
        bend(4) = slope
        shares = shares_of(softness_of(piece))
        bend(state_count + 1:) = matmul(bend(1:state_count), abs(shares(1:state_count, :)))
        do k = 1, bending_count
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
            values(:) = [infinity, -infinity]
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

    include 'beam/derivatives_along.inc'

end module gapbeam_fields
