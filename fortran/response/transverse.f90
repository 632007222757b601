!> Transverse force of a beam whose bending feels an axial force: T = V + N w', which loads and reactions balance.
module gapbeam_transverse
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_extreme
    use gapbeam_element, only: field_type
    use gapbeam_piece, only: piece_type
    use gapbeam_foundation_taylor, only: stretch_type, transverse_of
    use gapbeam_foundation_pieces, only: slope_of_transverse
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_laws, only: along
    use gapbeam_ground_fields, only: force_at_end
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_ground_query, only: values_in, curved_in, peaks_in
    implicit none
    private
    public :: transverse_at, transverse_extremes

contains

    !> Transverse force where the other fields are known; without an axial force the shear
    elemental function transverse_at(piece, field) result(force)
        !> The piece of the beam
        type(piece_type), intent(in) :: piece
        type(field_type), intent(in) :: field
        real(wp) :: force

        force = transverse_of(stretch_type(shear_flexibility=piece%shear_flexibility, tension=piece%tension), field%rotation, &
                              field%shear)
    end function transverse_at

    !> Its maximum (1) and minimum (2), and where they are: at ends of stretches, or where ground and load balance
    subroutine transverse_extremes(assembled, solution, value, piece, distance)
        !> The beam, and its solution
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> In the engine's units
        real(wp), intent(out) :: value(2)
        !> Pieces of the beam, and distances from their left ends in the engine's units
        integer, intent(out) :: piece(2)
        real(wp), intent(out) :: distance(2)
        type(field_type) :: field
        type(curved_type), allocatable :: curved
        real(wp), allocatable :: xi(:)
        integer :: i, j, number

        value = [-huge(1.0_wp), huge(1.0_wp)]
        piece = 1
        distance = 0.0_wp
        do i = 1, size(solution%piece)
            call consider(force_at_end(solution, i, 1), 0.0_wp)
            call consider(force_at_end(solution, i, 2), 1.0_wp)
            call curved_in(assembled, solution, i, curved)
            call peaks_in(solution, i, slope_of_transverse, 0.0_wp, curved, xi, number)
            do j = 1, number
                call values_in(assembled, solution, i, xi(j), field)
                call consider(transverse_at(assembled%pieces(solution%piece(i)), field), xi(j))
            end do
        end do

    contains

        !> Compare with the extremes so far
        subroutine consider(force, at)
            real(wp), intent(in) :: force, at
            integer :: k
            real(wp), parameter :: sense(2) = [1.0_wp, -1.0_wp]

            do k = 1, 2
                if (.not. sense(k)*(force - value(k)) > same_extreme*abs(value(k))) cycle
                value(k) = force
                piece(k) = solution%piece(i)
                distance(k) = along(solution%from(i), solution%to(i), at, 1.0_wp)
            end do
        end subroutine consider

    end subroutine transverse_extremes

end module gapbeam_transverse
