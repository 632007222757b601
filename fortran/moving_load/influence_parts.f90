!> Parts of a beam on which an influence line has one sign: there a lane load is placed, or left out.
!>
!> While the same supports act, the line is a cubic in the place of the force along every prismatic piece, on either side of the
!> place that it belongs to (Mueller-Breslau: it is a deflected shape).
module gapbeam_influence_parts
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_polynomial, only: roots_between, value_of => value, highest_degree
    use gapbeam_quantities, only: bending_count, of_deflection, of_rotation, of_moment, of_shear
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type, new_track
    use gapbeam_train_influence, only: find_influence
    implicit none
    private
    public :: find_parts

    !> Values of a line in a piece at these shares of its length give its cubic: not at the ends, where shear jumps
    real(wp), parameter :: share(4) = [0.125_wp, 0.375_wp, 0.625_wp, 0.875_wp]
    !> Share of the largest ordinate below which a piece has none, and of a piece below which a part is none
    real(wp), parameter :: none = 1.0e-11_wp, shortest = 1.0e-9_wp

contains

    !> Parts of the influence line of a quantity, while the same supports act
    subroutine find_parts(assembled, closed, support, piece, distance, quantity, edge, sign_of, number, error)
        !> The beam, without foundations
        type(assembled_type), intent(in) :: assembled
        !> The contact state, and which supports of the model are meant, as for find_influence
        logical, intent(in) :: closed(:), support(:)
        !> A place of the beam: piece, and distance from its left end in the user's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        !> Which value of find_influence, 1 .. bending_count + 2
        integer, intent(in) :: quantity
        !> Right ends of the parts in the user's units, and the sign of the line on each, 0 where it is zero; shape 4 for each piece
        !> and 4 more: a cubic has three roots, and a piece is cut where the line belongs to
        real(wp), intent(out) :: edge(:)
        integer, intent(out) :: sign_of(:)
        !> How many there are
        integer, intent(out) :: number
        !> No unique state, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(track_type) :: track
        real(wp), allocatable :: ends(:), places(:), value(:, :)
        real(wp) :: x, largest, v(size(share)), c(0:3), roots(highest_degree), left, right
        integer :: n, k, j, found, stat

        number = 0
        call new_track(assembled, track, error)
        if (allocated(error)) return
        n = size(track%link)
        x = track%x(piece - 1) + distance
        allocate (ends(0:n + 1), places(size(share)*(n + 1)), value(bending_count + 2, size(share)*(n + 1)), stat=stat)
        if (failed(stat, error)) return
        ends(:n) = track%x
        if (x > track%x(piece - 1) .and. x < track%x(piece)) then
            ends(piece) = x
            ends(piece + 1:) = track%x(piece:)
            n = n + 1
        end if
        do k = 1, n
            places(size(share)*(k - 1) + 1:size(share)*k) = ends(k - 1) + (ends(k) - ends(k - 1))*share
        end do
        call find_influence(assembled, track, closed, support, piece, distance, places(:size(share)*n), &
                            value(:, :size(share)*n), error)
        if (allocated(error)) return
        ! What is zero but for rounding is told by what goes with it
        largest = maxval(abs(value(quantity, :size(share)*n)))
        if (quantity == of_deflection) largest = max(largest, maxval(abs(value(of_rotation, :size(share)*n)))*ends(n))
        if (quantity == of_moment) largest = max(largest, maxval(abs(value(of_shear, :size(share)*n)))*ends(n))
        if (quantity == of_shear) largest = max(largest, maxval(abs(value(of_moment, :size(share)*n)))/ends(n))
        do k = 1, n
            v(:) = value(quantity, size(share)*(k - 1) + 1:size(share)*k)
            associate (a => ends(k - 1), b => ends(k))
                if (all(abs(v) <= none*largest)) then
                    call add(b, 0)
                    cycle
                end if
                c(:) = cubic(v)
                call roots_between(c, 4.0_wp, roots, found)
                left = 0.0_wp
                do j = 1, found + 1
                    right = 4.0_wp
                    if (j <= found) right = roots(j)
                    if (right - left <= 4*shortest) cycle
                    call add(a + (b - a)*(right/4), nint(sign(1.0_wp, value_of(c, left + (right - left)/2))))
                    left = right
                end do
                edge(number) = b
            end associate
        end do

    contains

        !> Add a part, or make the last one longer
        subroutine add(end, which)
            real(wp), intent(in) :: end
            integer, intent(in) :: which

            if (number == 0) then
                number = 1
            else if (sign_of(number) /= which) then
                number = number + 1
            end if
            edge(number) = end
            sign_of(number) = which
        end subroutine add

    end subroutine find_parts

    !> Coefficients of the cubic through values at 1/2, 3/2, 5/2, 7/2 (Newton's differences)
    pure function cubic(v) result(c)
        real(wp), intent(in) :: v(4)
        real(wp) :: c(0:3), d(3), t(0:3)

        d(1) = v(2) - v(1)
        d(2) = v(3) - 2*v(2) + v(1)
        d(3) = v(4) - 3*v(3) + 3*v(2) - v(1)
        t(:) = [v(1), d(1) - d(2)/2 + d(3)/3, (d(2) - d(3))/2, d(3)/6]
        ! From the first of these places on, moved to 0
        c(:) = [t(0) - t(1)/2 + t(2)/4 - t(3)/8, t(1) - t(2) + 0.75_wp*t(3), t(2) - 1.5_wp*t(3), t(3)]
    end function cubic

end module gapbeam_influence_parts
