!> Fields of eight cases anywhere along the beam, from those at the left ends of the pieces
module gapbeam_lane_values
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_pieces_type, pack_type, piece_pack_type
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_fields, only: recover_pack
    implicit none
    private
    public :: fields_of_pack, find_values, deflection_at, rotation_at
    public :: deflection, rotation, moment, shear

    !> Fields as gapbeam_query counts them
    integer, parameter :: deflection = 1, rotation = 2, moment = 3, shear = 4

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
        !> Deflection, rotation, moment, shear
        real(wp), intent(out) :: values(lanes, size(piece), 4)
        !> As for recover_pack
        real(wp), intent(out) :: poor(lanes)
        integer :: k

        call recover_pack(beam, pieces, factors, pack, fields, poor)
        do k = deflection, shear
            call find_values(pieces, size(pieces%length), k, piece, distance, fields%loads, fields%starts, values(:, :, k))
        end do
    end subroutine fields_of_pack

    !> A field at places
    pure subroutine find_values(pieces, n, k, piece, distance, loads, starts, values)
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
            case (deflection)
                !$omp simd private(f, g)
                do l = 1, lanes
                    f = pieces%flexibility(min(l, stiffness_lanes), j)
                    g = pieces%shear_flexibility(min(l, stiffness_lanes), j)
                    values(l, i) = deflection_at(s, length, f, g, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), &
                                                 starts(l, j, 1), starts(l, j, 2), starts(l, j, 3), starts(l, j, 4))
                end do
            case (rotation)
                !$omp simd private(f)
                do l = 1, lanes
                    f = pieces%flexibility(min(l, stiffness_lanes), j)
                    values(l, i) = rotation_at(s, length, f, loads(l, j, 1), loads(l, j, 2), loads(l, j, 3), starts(l, j, 2), &
                                               starts(l, j, 3), starts(l, j, 4))
                end do
            case (moment)
                !$omp simd
                do l = 1, lanes
                    values(l, i) = starts(l, j, 3) + s*(starts(l, j, 4) - s*(loads(l, j, 1)/2 &
                        + s*((loads(l, j, 2) - loads(l, j, 1))/length)/6))
                end do
            case default
                !$omp simd
                do l = 1, lanes
                    values(l, i) = starts(l, j, 4) - s*(loads(l, j, 1) + s*((loads(l, j, 2) - loads(l, j, 1))/length)/2)
                end do
            end select
        end do
    end subroutine find_values

    !> The deflection at a distance from the left end of a piece: fields_at of gapbeam_element
    elemental function deflection_at(s, length, f, g, qa, qb, kappa, w, turn, m, v) result(x)
        !> The distance; length, 1/EI, 1/GA; loads, and fields at the left end
        real(wp), intent(in) :: s, length, f, g, qa, qb, kappa, w, turn, m, v
        real(wp) :: x
        real(wp) :: slope

        slope = (qb - qa)/length
        x = w + s*(turn + s*(kappa/2 - f*(m/2 + s*(v/6 - s*(qa/24 + s*slope/120))))) + g*(s*(v - s*(qa/2 + s*slope/6)))
    end function deflection_at

    !> The rotation likewise
    elemental function rotation_at(s, length, f, qa, qb, kappa, turn, m, v) result(x)
        real(wp), intent(in) :: s, length, f, qa, qb, kappa, turn, m, v
        real(wp) :: x

        x = turn + s*(kappa - f*(m + s*(v/2 - s*(qa/6 + s*((qb - qa)/length)/24))))
    end function rotation_at

end module gapbeam_lane_values
