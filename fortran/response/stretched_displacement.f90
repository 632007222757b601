!> Displacements along the axis of a beam that its deflections stretch: u' = (force and temperature) - w'**2/2.
module gapbeam_stretched_displacement
    use gapbeam_kinds, only: wp
    use gapbeam_line_search, only: golden_sections, narrow_to_peak
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_query, only: peaks_in, curved_in
    use gapbeam_stretching, only: lengthening_to
    use gapbeam_axial_fields, only: axial_fields
    use gapbeam_piece_stiffness, only: stiffness_along
    use gapbeam_assembled_model, only: assembled_type, place_x, along_axis
    implicit none
    private
    public :: displacement_in, extremes_of_displacement

    !> Samples of a stretch along which the elongation by the axial force changes, and sections that find a place between them
    integer, parameter :: samples = 64, golden_steps = 40

contains

    !> Displacement at a place, in the units of the axial system
    pure function displacement_in(assembled, solution, factor, displacement, tension, piece, distance) result(u)
        !> Every piece a bar of the axial system
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> As for axial_fields
        real(wp), intent(in) :: factor, displacement(0:), tension(:)
        !> The place: piece, and distance from its left end in the engine's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp) :: u, force

        call axial_fields(assembled, factor, displacement, tension, piece, scale(distance, assembled%units%length), force, u)
        associate (length => assembled%pieces(piece)%length)
            u = u + (lengthening_to(assembled, solution, piece, length)*(distance/length) &
                     - lengthening_to(assembled, solution, piece, distance))
        end associate
    end function displacement_in

    !> Extremes of the displacement between the points of the axial system: where the slope of the axis is one of two
    pure subroutine extremes_of_displacement(assembled, solution, factor, displacement, tension, value, x)
        !> As for displacement_in
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        real(wp), intent(in) :: factor, displacement(0:), tension(:)
        !> Maximum and minimum in, of the points of the axial system, and their places; those of all of the beam out
        real(wp), intent(inout) :: value(2), x(2)
        type(curved_type), allocatable :: curved
        real(wp), allocatable :: xi(:)
        real(wp) :: square, EA, EA_to
        integer :: i, k, sign, unit, power

        unit = 2*assembled%units%deflection - assembled%units%length - assembled%axial%units%deflection
        do i = 1, size(solution%piece)
            associate (j => solution%piece(i))
                call stiffness_along(assembled, j, along_axis, EA, EA_to, power)
                if (allocated(assembled%axial%along_bar)) power = power + count(abs(assembled%axial%along_bar(:, j)) > 0.0_wp)
                if (power > 0) then
                    call look_around(i, value, x)
                    cycle
                end if
                square = 2*scale((displacement(j) - displacement(j - 1) &
                                  + lengthening_to(assembled, solution, j, assembled%pieces(j)%length)) &
                                 /assembled%pieces(j)%length, -unit)
                if (.not. square > 0.0_wp) cycle
                call curved_in(assembled, solution, i, curved)
                do sign = -1, 1, 2
                    call peaks_in(solution, i, [1], sign*sqrt(square), curved, xi)
                    do k = 1, size(xi)
                        call take(i, xi(k), value, x)
                    end do
                end do
            end associate
        end do

    contains

        !> Where the elongation by the axial force changes along a stretch: between samples, by golden sections
        pure subroutine look_around(i, value, x)
            integer, intent(in) :: i
            real(wp), intent(inout) :: value(2), x(2)
            real(wp) :: sample(0:samples), between(2), inner(2)
            integer :: k, sign, step

            sample(:) = [(at(i, real(k, wp)/samples), k=0, samples)]
            do sign = -1, 1, 2
                do k = 1, samples - 1
                    if (sign*(sample(k) - sample(k - 1)) < 0.0_wp .or. sign*(sample(k) - sample(k + 1)) < 0.0_wp) cycle
                    between = real([k - 1, k + 1], wp)/samples
                    do step = 1, golden_steps
                        inner = golden_sections(between)
                        call narrow_to_peak(between, sign*[at(i, inner(1)), at(i, inner(2))])
                    end do
                    call take(i, sum(between)/2, value, x)
                end do
            end do
        end subroutine look_around

        !> Take a displacement, at a share of a stretch, that is greater or less
        pure subroutine take(i, share, value, x)
            integer, intent(in) :: i
            real(wp), intent(in) :: share
            real(wp), intent(inout) :: value(2), x(2)
            real(wp) :: found, place

            found = at(i, share)
            place = place_x(assembled, solution%piece(i), distance_of(i, share))
            if (found > value(1)) x(1) = place
            if (found < value(2)) x(2) = place
            value(:) = [max(value(1), found), min(value(2), found)]
        end subroutine take

        !> Displacement at a share of a stretch
        pure function at(i, share) result(u)
            integer, intent(in) :: i
            real(wp), intent(in) :: share
            real(wp) :: u

            u = displacement_in(assembled, solution, factor, displacement, tension, solution%piece(i), distance_of(i, share))
        end function at

        !> Distance of a share of a stretch from the left end of its piece
        pure function distance_of(i, share) result(distance)
            integer, intent(in) :: i
            real(wp), intent(in) :: share
            real(wp) :: distance

            distance = solution%from(i) + share*(solution%to(i) - solution%from(i))
        end function distance_of

    end subroutine extremes_of_displacement

end module gapbeam_stretched_displacement
