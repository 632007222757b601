!> Distance of a solved beam from the ground, and places where it touches without pressing.
module gapbeam_ground_distance
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: touching_distance
    use gapbeam_element, only: field_type
    use gapbeam_curved, only: curved_type
    use gapbeam_ground_laws, only: contact_line, along
    use gapbeam_ground_fields, only: deflection_size
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_layers, only: layer_type
    use gapbeam_ground_query, only: layers_under, values_in, curved_in, peaks_in
    implicit none
    private
    public :: largest_ways, is_shallow

contains

    !> Where the distance between the beam and the line at which a layer begins to act is stationary inside a stretch: their
    !> difference is the deflection under the load less what the ground would take of it along the line
    subroutine peaks_beside(assembled, solution, i, k, xi)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Stretch and layer
        integer, intent(in) :: i, k
        real(wp), allocatable, intent(out) :: xi(:)
        type(curved_type), allocatable :: curved
        real(wp) :: line(2)

        call curved_in(assembled, solution, i, curved)
        line(:) = contact_line(layer_in(assembled, solution, i, k), [solution%from(i), solution%to(i)], &
                               assembled%pieces(solution%piece(i))%length)
        call peaks_in(solution, i, [1], (line(2) - line(1))/solution%stretches(i)%length, curved, xi)
    end subroutine peaks_beside

    !> Largest distance of the beam from every layer under its stretches, and where it touches one without pressing it
    subroutine largest_ways(assembled, solution, way, touch)
        !> The beam, and its solution
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> In the engine's units, 0 where the layer acts all along, shape (most layers, stretches)
        real(wp), intent(out) :: way(:, :)
        !> The at most two places of each that are nearest to the ground, if they touch it, as shares of the stretch, ascending;
        !> none: -1. Shape (2, most layers, stretches)
        real(wp), intent(out) :: touch(:, :, :)
        real(wp), allocatable :: xi(:)
        integer :: i, j, k

        way(:, :) = 0.0_wp
        touch(:, :, :) = -1.0_wp
        do i = 1, size(solution%piece)
            associate (first => assembled%layer_first(solution%piece(i)), last => assembled%layer_first(solution%piece(i) + 1) - 1)
                do k = first, last
                    if (solution%acts(k - first + 1, i) > 0) cycle
                    call peaks_beside(assembled, solution, i, k, xi)
                    call check_at(0.0_wp)
                    do j = 1, size(xi)
                        call check_at(xi(j))
                    end do
                    call check_at(1.0_wp)
                end do
            end associate
        end do

    contains

        !> Ask for the distance at a place of the stretch
        subroutine check_at(at)
            real(wp), intent(in) :: at
            real(wp) :: distance, rounding

            call distance_at(assembled, solution, i, k, at, distance, rounding)
            associate (most => way(k - assembled%layer_first(solution%piece(i)) + 1, i), &
                       places => touch(:, k - assembled%layer_first(solution%piece(i)) + 1, i))
                most = max(most, distance)
                if (abs(distance) > touching_distance*rounding) return
                if (places(1) < 0.0_wp) then
                    places(1) = at
                else
                    places(2) = at
                end if
            end associate
        end subroutine check_at

    end subroutine largest_ways

    !> Distance between the beam and the line at which a layer begins to act, and the size of what it is the difference of
    pure subroutine distance_at(assembled, solution, i, k, at, distance, rounding)
        !> As for largest_ways
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Stretch, layer, and share of the stretch
        integer, intent(in) :: i, k
        real(wp), intent(in) :: at
        !> Positive where there is no contact; size of its terms
        real(wp), intent(out) :: distance, rounding
        type(field_type) :: field
        type(layer_type) :: layer
        real(wp) :: line

        layer = layer_in(assembled, solution, i, k)
        call values_in(assembled, solution, i, at, field)
        line = contact_line(layer, along(solution%from(i), solution%to(i), at, 1.0_wp), &
                            assembled%pieces(solution%piece(i))%length)
        distance = layer%side*(line - field%deflection)
        rounding = deflection_size(solution, i) + abs(line)
    end subroutine distance_at

    !> A layer under a stretch
    pure function layer_in(assembled, solution, i, k) result(layer)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Stretch, and the layer among all
        integer, intent(in) :: i, k
        type(layer_type) :: layer, layers(assembled%layer_first(solution%piece(i) + 1) - assembled%layer_first(solution%piece(i)))

        layers(:) = layers_under(assembled, solution, solution%piece(i))
        layer = layers(k - assembled%layer_first(solution%piece(i)) + 1)
    end function layer_in

    !> Is a stretch in which a layer acts pressed into it by nothing but rounding
    pure function is_shallow(assembled, solution, i, k) result(shallow)
        !> As for largest_ways
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Stretch and layer
        integer, intent(in) :: i, k
        logical :: shallow
        real(wp) :: distance, rounding
        integer :: j

        shallow = .true.
        do j = 0, 4
            call distance_at(assembled, solution, i, k, j/4.0_wp, distance, rounding)
            shallow = shallow .and. abs(distance) <= touching_distance*rounding
        end do
    end function is_shallow

end module gapbeam_ground_distance
