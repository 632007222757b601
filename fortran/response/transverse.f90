!> Transverse force of a beam whose bending feels an axial force: T = V + N w', which loads and reactions balance.
module gapbeam_transverse
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_extreme
    use gapbeam_foundation_question, only: slope_of_transverse
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_fields, only: inside_type, prepare_inside, force_at_end, force_inside
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_ground_query, only: layers_under, stretch_of, share_of, curved_in, compare, peaks_in
    implicit none
    private
    public :: transverse_forces, transverse_extremes

contains

    !> Transverse force at distances from the left ends of pieces
    pure subroutine transverse_forces(assembled, solution, piece, distance, force)
        !> The beam, and its solution
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Pieces of the beam, and distances in the engine's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> In the engine's units, shape (n)
        real(wp), intent(out) :: force(:)
        integer :: i, k

        do k = 1, size(piece)
            i = stretch_of(solution, piece(k), distance(k))
            force(k) = force_in(assembled, solution, i, share_of(solution, i, distance(k)))
        end do
    end subroutine transverse_forces

    !> The same inside a stretch, at its ends as it was solved
    pure function force_in(assembled, solution, i, xi) result(force)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: xi
        real(wp) :: force
        type(inside_type) :: inside

        if (xi <= 0.0_wp .or. xi >= 1.0_wp) then
            force = force_at_end(solution, i, merge(1, 2, xi <= 0.0_wp))
            return
        end if
        associate (j => solution%piece(i))
            call prepare_inside(layers_under(assembled, solution, j), assembled%law_pieces, assembled%pieces(j)%length, solution, &
                                i, inside, roughly=.true.)
        end associate
        force = force_inside(inside, xi)
    end function force_in

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
        type(curved_type), allocatable :: curved
        real(wp), allocatable :: xi(:)
        integer :: i, j

        value = [-huge(1.0_wp), huge(1.0_wp)]
        piece = 1
        distance = 0.0_wp
        do i = 1, size(solution%piece)
            do j = 1, 2
                call compare(solution, i, real(j - 1, wp), force_at_end(solution, i, j), same_extreme, value, piece, distance)
            end do
            call curved_in(assembled, solution, i, curved)
            call peaks_in(solution, i, [slope_of_transverse], 0.0_wp, curved, xi)
            do j = 1, size(xi)
                call compare(solution, i, xi(j), force_in(assembled, solution, i, xi(j)), same_extreme, value, piece, distance)
            end do
        end do
    end subroutine transverse_extremes

end module gapbeam_transverse
