!> Displacements along the axis of a beam that its deflections stretch: u' = (force and temperature) - w'**2/2.
module gapbeam_stretched_displacement
    use gapbeam_kinds, only: wp
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_query, only: peaks_in, curved_in
    use gapbeam_stretching, only: lengthening_to
    use gapbeam_assembled_model, only: assembled_type, place_x
    implicit none
    private
    public :: displacement_in, extremes_of_displacement

contains

    !> Displacement at a place, in the units of the axial system
    pure function displacement_in(assembled, solution, displacement, piece, distance) result(u)
        !> Every piece a bar of the axial system
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Of the points of the axial system
        real(wp), intent(in) :: displacement(0:)
        !> The place: piece, and distance from its left end in the engine's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        real(wp) :: u

        associate (length => assembled%pieces(piece)%length)
            u = displacement(piece - 1) + (displacement(piece) - displacement(piece - 1) &
                                           + lengthening_to(assembled, solution, piece, length))*(distance/length) &
                - lengthening_to(assembled, solution, piece, distance)
        end associate
    end function displacement_in

    !> Extremes of the displacement between the points of the axial system: where the slope of the axis is one of two
    pure subroutine extremes_of_displacement(assembled, solution, displacement, value, x)
        !> As for displacement_in
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        real(wp), intent(in) :: displacement(0:)
        !> Maximum and minimum in, of the points of the axial system, and their places; those of all of the beam out
        real(wp), intent(inout) :: value(2), x(2)
        type(curved_type), allocatable :: curved
        real(wp), allocatable :: xi(:)
        real(wp) :: square, at, found
        integer :: i, k, sign, unit

        unit = 2*assembled%units%deflection - assembled%units%length - assembled%axial%units%deflection
        do i = 1, size(solution%piece)
            associate (j => solution%piece(i))
                square = 2*scale((displacement(j) - displacement(j - 1) &
                                  + lengthening_to(assembled, solution, j, assembled%pieces(j)%length)) &
                                 /assembled%pieces(j)%length, -unit)
                if (.not. square > 0.0_wp) cycle
                call curved_in(assembled, solution, i, curved)
                do sign = -1, 1, 2
                    call peaks_in(solution, i, [1], sign*sqrt(square), curved, xi)
                    do k = 1, size(xi)
                        at = solution%from(i) + xi(k)*(solution%to(i) - solution%from(i))
                        found = displacement_in(assembled, solution, displacement, j, at)
                        at = place_x(assembled, j, at)
                        if (found > value(1)) x(1) = at
                        if (found < value(2)) x(2) = at
                        value(:) = [max(value(1), found), min(value(2), found)]
                    end do
                end do
            end associate
        end do
    end subroutine extremes_of_displacement

end module gapbeam_stretched_displacement
