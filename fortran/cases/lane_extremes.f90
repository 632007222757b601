!> Largest and smallest values of the fields of eight cases, and their places.
!> They are at the ends of the pieces, and inside them where the derivative changes sign. Shear and moment by the roots of a line
!> and a parabola; rotation and deflection in those pieces only in which there may be more than is known, eight such pieces at a
!> time.
module gapbeam_lane_extremes
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: least_load
    use gapbeam_quantities, only: state_count, derived_count, bending_count, terms_of_derived, deflection => of_deflection, &
        rotation => of_rotation, moment => of_moment, shear => of_shear
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, pack_type, piece_pack_type
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_fields, only: recover_pack
    use gapbeam_lane_values, only: find_values, shares_in_lanes
    use gapbeam_lane_roots, only: find_open, count_turns, find_only_root, find_roots
    implicit none
    private
    public :: extremes_of_pack

    !> Queues of pieces with one root at most, and with several
    integer, parameter :: one_root = 1, some_roots = 2

    !> Pieces of eight cases that wait for their roots to be found
    type :: queue_type
        integer :: waiting = 0, lane(lanes) = 1, piece(lanes) = 1
        !> Coefficients of the derivative of the field
        real(wp) :: derivative(lanes, 0:4) = 0.0_wp
    end type queue_type

contains

    !> Extremes of eight solved cases
    subroutine extremes_of_pack(beam, pieces, wanted, factors, pack, fields, extremes, poor)
        !> What the cases have in common
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        !> Which quantities of bending (gapbeam_quantities) are asked for
        logical, intent(in) :: wanted(bending_count)
        !> Factor of every load, shape (lanes, nload)
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Supports, contact states and solutions
        type(pack_type), intent(inout) :: pack
        type(piece_pack_type), intent(inout) :: fields
        !> Maximum, its piece and the distance from that one's left end; the same of the minimum, shape (lanes, 6, bending_count)
        real(wp), intent(inout) :: extremes(lanes, 6, bending_count)
        !> 1 for cases to be solved otherwise: a shear of few digits, or numbers far from 1
        real(wp), intent(out) :: poor(lanes)
        integer :: k, n

        n = size(pieces%length)
        call recover_pack(beam, pieces, factors, pack, fields, poor)
        do k = 1, bending_count
            if (.not. wanted(k)) cycle
            if (k > state_count) then
                call find_values(pieces, n, k, pieces%number, 0*pieces%length, fields%loads, fields%starts, fields%room(:, :, 3))
                call take_values_at_ends(pieces, n, k, fields%loads, fields%starts, fields%room(:, :, 3), extremes(:, :, k), &
                                         fields%room)
                call search_derived(pieces, n, k - state_count, fields%loads, fields%starts, fields%room(:, :, 3), &
                                    extremes(:, :, k))
                cycle
            end if
            call take_values_at_ends(pieces, n, k, fields%loads, fields%starts, fields%starts(:, :, k), extremes(:, :, k), &
                                     fields%room)
            select case (k)
            case (shear)
                call take_shear_extremes(pieces, n, fields%loads, fields%starts, extremes(:, :, k))
            case (moment)
                call take_moment_extremes(pieces, n, fields%loads, fields%starts, extremes(:, :, k), poor)
            case default
                call search_inside(pieces, n, k, fields%loads, fields%starts, fields%room, extremes(:, :, k))
            end select
        end do
    end subroutine extremes_of_pack

    !> Ends of all pieces. Room 1 is what is known of the inside, the field in the middle, and room 2 is that at the right end
    pure subroutine take_values_at_ends(pieces, n, k, loads, starts, left, best, room)
        type(lane_pieces_type), intent(in) :: pieces
        !> Pieces, and the field
        integer, intent(in) :: n, k
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        !> The field at the left ends
        real(wp), intent(in) :: left(lanes, n)
        real(wp), intent(out) :: best(lanes, 6)
        real(wp), intent(inout) :: room(lanes, n, 2)
        real(wp) :: x, length
        integer :: j, l

        if (k <= rotation) call find_values(pieces, n, k, pieces%number, pieces%half, loads, starts, room(:, :, 1))
        call find_values(pieces, n, k, pieces%number, pieces%length, loads, starts, room(:, :, 2))
        best(:, 1) = left(:, 1)
        best(:, 2) = 1.0_wp
        best(:, 3) = 0.0_wp
        best(:, 4:6) = best(:, 1:3)
        do j = 1, n
            length = pieces%length(j)
            !$omp simd private(x)
            do l = 1, lanes
                x = left(l, j)
                call consider(x, real(j, wp), 0.0_wp, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
                x = room(l, j, 2)
                call consider(x, real(j, wp), length, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
            end do
        end do
    end subroutine take_values_at_ends

    !> Shear inside pieces: where a linear load changes sign
    pure subroutine take_shear_extremes(pieces, n, loads, starts, best)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: n
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        real(wp), intent(inout) :: best(lanes, 6)
        real(wp) :: x, s, qa, qb, change, length, divisor(lanes)
        integer :: j, l

        do j = 1, n
            length = pieces%length(j)
            ! In a loop of its own: compilers divide by both before they choose
            !$omp simd private(change)
            do l = 1, lanes
                change = loads(l, j, 1) - loads(l, j, 2)
                divisor(l) = change + merge(0.0_wp, 1.0_wp, abs(change) > 0.0_wp)
            end do
            !$omp simd private(x, s, qa, qb, change)
            do l = 1, lanes
                qa = loads(l, j, 1)
                qb = loads(l, j, 2)
                change = qa - qb
                ! Of one sign they are no farther apart
                s = merge(1.0_wp, 0.0_wp, abs(change) > larger(abs(qa), abs(qb)))
                x = length*(qa/divisor(l))
                s = merge(x, 0.0_wp, s > 0.5_wp)
                x = shear_at(s, length, qa, qb, starts(l, j, 4))
                call consider(x, real(j, wp), s, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
            end do
        end do
    end subroutine take_shear_extremes

    !> Moment inside pieces: where the shear, a parabola, is zero
    pure subroutine take_moment_extremes(pieces, n, loads, starts, best, poor)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: n
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        real(wp), intent(inout) :: best(lanes, 6), poor(lanes)
        real(wp) :: x, s, qa, qb, v, size, slope, root, length, first, second, there
        integer :: j, l

        do j = 1, n
            length = pieces%length(j)
            !$omp simd private(x, s, qa, qb, v, size, slope, root, first, second, there)
            do l = 1, lanes
                qa = loads(l, j, 1)
                qb = loads(l, j, 2)
                v = starts(l, j, 4)
                size = larger(abs(qa), abs(qb))
                there = size + merge(0.0_wp, 1.0_wp, size > 0.0_wp)
                poor(l) = poor(l) + merge(1.0_wp, 0.0_wp, there < least_load)
                size = size + merge(0.0_wp, 1.0_wp, size > least_load)
                ! v - qa s - slope s**2/2 over the size of the load, by the root that does not cancel
                qa = qa/size
                qb = qb/size
                v = v/size
                slope = (qb - qa)/length
                root = qa**2 + 2*slope*v
                there = merge(1.0_wp, 0.0_wp, root >= 0.0_wp)
                root = qa + sign(sqrt(root*there), qa)
                there = there*merge(1.0_wp, 0.0_wp, abs(root) > 0.0_wp)
                root = root + (1.0_wp - there)
                first = there*(2*v/root)
                second = there*merge(-root, 0.0_wp, abs(slope) > 0.0_wp)
                slope = slope + merge(0.0_wp, 1.0_wp, abs(slope) > 0.0_wp)
                second = second/slope
                s = merge(first, 0.0_wp, first > 0.0_wp)
                s = merge(s, 0.0_wp, s < length)
                x = moment_at(s, length, loads(l, j, 1), loads(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                call consider(x, real(j, wp), s, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
                s = merge(second, 0.0_wp, second > 0.0_wp)
                s = merge(s, 0.0_wp, s < length)
                x = moment_at(s, length, loads(l, j, 1), loads(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                call consider(x, real(j, wp), s, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
            end do
        end do
    end subroutine take_moment_extremes

    !> A derived quantity inside pieces: where its derivative, the sum of the shares of those of the state, changes sign
    subroutine search_derived(pieces, n, d, loads, starts, left, best)
        type(lane_pieces_type), intent(in) :: pieces
        !> Pieces, and the quantity among the derived ones
        integer, intent(in) :: n, d
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4), left(lanes, n)
        real(wp), intent(inout) :: best(lanes, 6)
        real(wp) :: c(lanes, 0:4), own(lanes, 0:4), share(lanes, state_count + 1), roots(lanes, 4), there(lanes, 4), open(lanes)
        real(wp) :: length, x, s
        logical :: is_term(state_count, derived_count)
        integer :: j, l, m

        is_term(:, :) = terms_of_derived()
        do j = 1, n
            length = pieces%length(j)
            share(:, :) = shares_in_lanes(pieces, j, d)
            c(:, :) = 0.0_wp
            do m = 1, state_count
                if (.not. is_term(m, d)) cycle
                call find_derivative(pieces, n, j, m, loads, starts, own)
                c(:, :) = c + spread(share(:, m), 2, 5)*own
            end do
            call find_open(length, left(:, j), c, best(:, 1), best(:, 4), open)
            if (.not. any(open > 0.5_wp)) cycle
            call find_roots(c, spread(length, 1, lanes), roots, there)
            do m = 1, 4
                do l = 1, lanes
                    s = merge(roots(l, m), 0.0_wp, there(l, m) > 0.5_wp)
                    x = left(l, j) + s*(c(l, 0) + s*(c(l, 1)/2 + s*(c(l, 2)/3 + s*(c(l, 3)/4 + s*(c(l, 4)/5)))))
                    call consider(x, real(j, wp), s, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
                end do
            end do
        end do
    end subroutine search_derived

    !> Coefficients of the derivative of deflection, rotation, moment or shear along a piece
    pure subroutine find_derivative(pieces, n, j, k, loads, starts, c)
        type(lane_pieces_type), intent(in) :: pieces
        !> Pieces; the piece and the field
        integer, intent(in) :: n, j, k
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        real(wp), intent(out) :: c(lanes, 0:4)
        real(wp) :: length, f, g
        integer :: l

        length = pieces%length(j)
        select case (k)
        case (deflection)
            !$omp simd private(f, g)
            do l = 1, lanes
                f = pieces%flexibility(min(l, stiffness_lanes), j)
                g = pieces%shear_flexibility(min(l, stiffness_lanes), j)
                call derive_deflection(length, f, g, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), starts(l, j, 2), &
                                       starts(l, j, 3), starts(l, j, 4), c(l, 0), c(l, 1), c(l, 2), c(l, 3), c(l, 4))
            end do
        case (rotation)
            c(:, 4) = 0.0_wp
            !$omp simd private(f)
            do l = 1, lanes
                f = pieces%flexibility(min(l, stiffness_lanes), j)
                call derive_rotation(length, f, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), starts(l, j, 3), &
                                     starts(l, j, 4), c(l, 0), c(l, 1), c(l, 2), c(l, 3))
            end do
        case (moment)
            c(:, 3:) = 0.0_wp
            call derive_moment(length, loads(:, j, 1), loads(:, j, 2), starts(:, j, 4), c(:, 0), c(:, 1), c(:, 2))
        case default
            c(:, 0) = -loads(:, j, 1)
            c(:, 1) = (loads(:, j, 1) - loads(:, j, 2))/length
            c(:, 2:) = 0.0_wp
        end select
    end subroutine find_derivative

    !> Deflection or rotation inside pieces
    subroutine search_inside(pieces, n, k, loads, starts, room, best)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: n, k
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4), room(lanes, n, 3)
        real(wp), intent(inout) :: best(lanes, 6)
        type(queue_type) :: queues(2)
        real(wp), dimension(lanes) :: most, least, open, turns
        real(wp) :: c(lanes, 0:4), x, length
        integer :: j, l, m

        most(:) = best(:, 1)
        least(:) = best(:, 4)
        do j = 1, n
            !$omp simd private(x)
            do l = 1, lanes
                x = room(l, j, 1)
                most(l) = merge(x, most(l), x > most(l))
                least(l) = merge(x, least(l), x < least(l))
            end do
        end do
        do j = 1, n
            if (k == rotation .and. .not. (any(pieces%flexibility(:, j) > 0.0_wp) .or. any(abs(loads(:, j, 3)) > 0.0_wp))) cycle
            length = pieces%length(j)
            call find_derivative(pieces, n, j, k, loads, starts, c)
            call find_open(length, starts(:, j, k), c, most, least, open)
            if (.not. any(open > 0.5_wp)) cycle
            call count_turns(length, c, turns)
            do l = 1, lanes
                if (open(l) < 0.5_wp .or. turns(l) < 0.5_wp) cycle
                associate (queue => queues(merge(one_root, some_roots, turns(l) < 1.5_wp)))
                    queue%waiting = queue%waiting + 1
                    queue%lane(queue%waiting) = l
                    queue%piece(queue%waiting) = j
                    queue%derivative(queue%waiting, :) = c(l, :)
                end associate
                do m = one_root, some_roots
                    if (queues(m)%waiting == lanes) call take_values_at_roots(pieces, n, k, m, loads, starts, queues(m), best)
                end do
            end do
        end do
        do m = one_root, some_roots
            if (queues(m)%waiting > 0) call take_values_at_roots(pieces, n, k, m, loads, starts, queues(m), best)
        end do
    end subroutine search_inside

    !> The field where its derivative changes sign, in the pieces of a queue, which is empty then
    subroutine take_values_at_roots(pieces, n, k, kind, loads, starts, queue, best)
        type(lane_pieces_type), intent(in) :: pieces
        !> Pieces, the field, and which queue it is
        integer, intent(in) :: n, k, kind
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        type(queue_type), intent(inout) :: queue
        real(wp), intent(inout) :: best(lanes, 6)
        real(wp) :: length(lanes), roots(lanes, 4), there(lanes, 4), x, f, g
        integer :: i, l, m

        do i = 1, lanes
            ! The last ones repeat the first
            m = merge(i, 1, i <= queue%waiting)
            length(i) = pieces%length(queue%piece(m))
            queue%derivative(i, :) = queue%derivative(m, :)
        end do
        if (kind == one_root) then
            call find_only_root(queue%derivative, length, roots(:, 1), there(:, 1))
        else
            call find_roots(queue%derivative, length, roots, there)
        end if
        do i = 1, queue%waiting
            l = queue%lane(i)
            do m = 1, merge(1, 4, kind == one_root)
                if (there(i, m) < 0.5_wp) cycle
                associate (j => queue%piece(i), s => roots(i, m))
                    f = pieces%flexibility(min(l, stiffness_lanes), j)
                    g = pieces%shear_flexibility(min(l, stiffness_lanes), j)
                    if (k == rotation) then
                        x = rotation_at(s, length(i), f, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), &
                                        starts(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                    else
                        x = deflection_at(s, length(i), f, g, loads(l, j, 1), &
                                          loads(l, j, 2), loads(l, j, 3), starts(l, j, 1), starts(l, j, 2), starts(l, j, 3), &
                                          starts(l, j, 4))
                    end if
                    call consider(x, real(j, wp), s, best(l, 1), best(l, 2), best(l, 3), best(l, 4), best(l, 5), best(l, 6))
                end associate
            end do
        end do
        queue%waiting = 0
    end subroutine take_values_at_roots

    !> Compare a value with the extremes so far
    elemental subroutine consider(x, piece, s, most, most_piece, most_at, least, least_piece, least_at)
        !> The value, its piece, and the distance from its left end
        real(wp), intent(in) :: x, piece, s
        !> Maximum and minimum so far and their places
        real(wp), intent(inout) :: most, most_piece, most_at, least, least_piece, least_at
        real(wp) :: a, b, c

        a = most
        b = most_piece
        c = most_at
        most = merge(x, a, x > a)
        most_piece = merge(piece, b, x > a)
        most_at = merge(s, c, x > a)
        a = least
        b = least_piece
        c = least_at
        least = merge(x, a, x < a)
        least_piece = merge(piece, b, x < a)
        least_at = merge(s, c, x < a)
    end subroutine consider

    include 'beam/fields_along.inc'
    include 'beam/derivatives_along.inc'
    include 'cases/larger.inc'

end module gapbeam_lane_extremes
