!> Fields of eight cases anywhere along the beam, from those at the left ends of the pieces
module gapbeam_lane_values
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: state_count, derived_count, bending_count, shares_of, terms_of_derived, of_deflection, &
        of_rotation, of_moment
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, pack_type, piece_pack_type
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_fields, only: recover_pack
    implicit none
    private
    public :: fields_of_pack, find_values, shares_in_lanes

contains

    !> Fields of eight solved cases at places
    subroutine fields_of_pack(beam, pieces, factors, pack, fields, piece, distance, values, poor)
        !> As for recover_pack
        type(lane_beam_type), intent(in) :: beam
        type(lane_pieces_type), intent(in) :: pieces
        real(wp), intent(in), contiguous :: factors(:, :)
        type(pack_type), intent(inout) :: pack
        type(piece_pack_type), intent(inout) :: fields
        !> Pieces of the places, and distances from the left ends of these, shape (n)
        integer, intent(in), contiguous :: piece(:)
        real(wp), intent(in), contiguous :: distance(:)
        !> The quantities of bending (gapbeam_quantities)
        real(wp), intent(out) :: values(lanes, size(piece), bending_count)
        !> As for recover_pack
        real(wp), intent(out) :: poor(lanes)
        integer :: k

        call recover_pack(beam, pieces, factors, pack, fields, poor)
        do k = 1, bending_count
            call find_values(pieces, size(pieces%length), k, piece, distance, fields%loads, fields%starts, values(:, :, k))
        end do
    end subroutine fields_of_pack

    !> A quantity of bending at places
    pure subroutine find_values(pieces, n, k, piece, distance, loads, starts, values)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: n, k
        !> Their pieces, and distances from the left ends of these
        integer, intent(in), contiguous :: piece(:)
        real(wp), intent(in), contiguous :: distance(:)
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        real(wp), intent(out) :: values(lanes, size(piece))
        real(wp) :: term(lanes, size(piece)), share(lanes, state_count + 1)
        logical :: is_term(state_count, derived_count)
        integer :: d, i, m

        if (k <= state_count) then
            call find_state(pieces, n, k, piece, distance, loads, starts, values)
            return
        end if
        d = k - state_count
        is_term(:, :) = terms_of_derived()
        values(:, :) = 0.0_wp
        do m = 1, state_count
            if (.not. is_term(m, d)) cycle
            call find_state(pieces, n, m, piece, distance, loads, starts, term)
            do i = 1, size(piece)
                share(:, :) = shares_in_lanes(pieces, piece(i), d)
                values(:, i) = values(:, i) + share(:, m)*term(:, i)
            end do
        end do
        do i = 1, size(piece)
            share(:, :) = shares_in_lanes(pieces, piece(i), d)
            values(:, i) = values(:, i) + share(:, state_count + 1)*loads(:, piece(i), 3)
        end do
    end subroutine find_values

    !> Shares of deflection, rotation, moment, shear and imposed curvature in a derived quantity on a piece, in all lanes
    pure function shares_in_lanes(pieces, j, d) result(share)
        type(lane_pieces_type), intent(in) :: pieces
        !> The piece; the quantity among the derived ones
        integer, intent(in) :: j, d
        real(wp) :: share(lanes, state_count + 1), all_of_them(state_count + 1, derived_count)
        integer :: l, m

        do l = 1, lanes
            m = min(l, stiffness_lanes)
            all_of_them(:, :) = shares_of([pieces%flexibility(m, j), pieces%shear_flexibility(m, j)])
            share(l, :) = all_of_them(:, d)
        end do
    end function shares_in_lanes

    !> Deflection, rotation, moment or shear at places
    pure subroutine find_state(pieces, n, k, piece, distance, loads, starts, values)
        type(lane_pieces_type), intent(in) :: pieces
        integer, intent(in) :: n, k
        !> Their pieces, and distances from the left ends of these
        integer, intent(in), contiguous :: piece(:)
        real(wp), intent(in), contiguous :: distance(:)
        real(wp), intent(in) :: loads(lanes, n, 5), starts(lanes, n, 4)
        real(wp), intent(out) :: values(lanes, size(piece))
        real(wp) :: s, length, f, g
        integer :: i, j, l

        do i = 1, size(piece)
            j = piece(i)
            s = distance(i)
            length = pieces%length(j)
            select case (k)
            case (of_deflection)
                !$omp simd private(f, g)
                do l = 1, lanes
                    f = pieces%flexibility(min(l, stiffness_lanes), j)
                    g = pieces%shear_flexibility(min(l, stiffness_lanes), j)
                    values(l, i) = deflection_at(s, length, f, g, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), &
                                                 starts(l, j, 1), starts(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                end do
            case (of_rotation)
                !$omp simd private(f)
                do l = 1, lanes
                    f = pieces%flexibility(min(l, stiffness_lanes), j)
                    values(l, i) = rotation_at(s, length, f, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), starts(l, j, 2), &
                                               starts(l, j, 3), starts(l, j, 4))
                end do
            case (of_moment)
                !$omp simd
                do l = 1, lanes
                    values(l, i) = moment_at(s, length, loads(l, j, 1), loads(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                end do
            case default
                !$omp simd
                do l = 1, lanes
                    values(l, i) = shear_at(s, length, loads(l, j, 1), loads(l, j, 2), starts(l, j, 4))
                end do
            end select
        end do
    end subroutine find_state

    include 'beam/fields_along.inc'

end module gapbeam_lane_values
