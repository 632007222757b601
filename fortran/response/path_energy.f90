!> Energy that is set free between two states of a load path.
!>
!> Along a path the energy changes by the work of the loads only. Where all but smooth laws is linear between two states, the loads
!> that grow do the mean of their work in full at both, times what the factor grows by, less the area between the smooth laws and
!> their chords: for the supports with these hand over the difference (Betti).
module gapbeam_path_energy
    use gapbeam_kinds, only: wp
    use gapbeam_quadrature, only: panels_type, cut_into_panels, points_of
    use gapbeam_piece, only: is_tapered
    use gapbeam_taper, only: intervals_in, points_in, most_places => number_of_points
    use gapbeam_element, only: sum_type, add, total, field_type
    use gapbeam_fields, only: values_at
    use gapbeam_laws, only: law_energy
    use gapbeam_assembled_model, only: assembled_type, growth_of
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, force_and_slope, deflection_at
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: energy_between

contains

    !> Energy that is set free on the way from one state to another, in the user's units
    pure function energy_between(assembled, one, starts_of_one, other, starts_of_other) result(energy)
        !> The beam, not on the ground
        type(assembled_type), intent(in) :: assembled
        !> The states, and their fields at the left ends of the pieces
        type(state_type), intent(in) :: one, other
        type(field_type), intent(in) :: starts_of_one(:), starts_of_other(:)
        real(wp) :: energy

        energy = (other%factor - one%factor)*(work_of_live_loads(assembled, one, starts_of_one) &
                                              + work_of_live_loads(assembled, other, starts_of_other))/2 &
            - area_over_chords(assembled, one, other)
    end function energy_between

    !> Work that the live loads in full would do along the displacements of a state; those along the axis are left out. Of imposed
    !> curvatures what the moments do along them, of movements of supports what the reactions do
    pure function work_of_live_loads(assembled, state, starts) result(work)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        type(field_type), intent(in) :: starts(:)
        real(wp) :: work
        type(sum_type) :: parts
        type(panels_type) :: panels
        type(field_type) :: there
        real(wp) :: points(most_places), weights(most_places), growth(size(assembled%normal))
        integer :: i, j, k, number, intervals

        ! A load that is linear times a deflection of degree 5
        call cut_into_panels([0.0_wp], [0.0_wp], panels)
        do j = 1, size(assembled%pieces)
            associate (live => assembled%live(j), length => assembled%pieces(j)%length)
                if (max(abs(live%qa), abs(live%qb), abs(live%kappa), abs(live%rise)) > 0.0_wp) then
                    intervals = 1
                    if (is_tapered(assembled%pieces(j))) intervals = intervals_in(assembled%pieces(j))
                    do k = 1, intervals
                        if (is_tapered(assembled%pieces(j))) then
                            number = most_places
                            call points_in(assembled%pieces(j), k, points, weights)
                        else
                            call points_of(panels, 1, number, points, weights)
                        end if
                        do i = 1, number
                            there = field_at(j, length*points(i))
                            call add(parts, length*weights(i)*((live%qa + (live%qb - live%qa)*points(i))*there%deflection &
                                                               - (live%kappa + live%rise*points(i))*there%moment))
                        end do
                    end do
                end if
                if (abs(live%kink_a) > 0.0_wp) call add(parts, -live%kink_a*starts(j)%moment)
                if (abs(live%couple_a) > 0.0_wp) call add(parts, live%couple_a*starts(j)%rotation)
                if (.not. max(abs(live%force), abs(live%couple), abs(live%couple_b), abs(live%kink_b)) > 0.0_wp) cycle
                there = field_at(j, length)
                call add(parts, live%force*there%deflection + (live%couple + live%couple_b)*there%rotation &
                         - live%kink_b*there%moment)
            end associate
        end do
        do i = 0, ubound(state%moment_left, 1)
            associate (force => assembled%beam%force(2, i), couple => assembled%beam%couple(2, i), point => assembled%node_point(i))
                call add(parts, force*state%deflection(i))
                if (.not. abs(couple) > 0.0_wp) cycle
                ! A couple at a hinge is refused, so the rotation has one value
                if (point == 0) then
                    there = starts(1)
                else
                    there = field_at(point, assembled%pieces(point)%length)
                end if
                call add(parts, couple*there%rotation)
            end associate
        end do
        if (allocated(assembled%growth)) then
            growth(:) = growth_of(assembled)
            do i = 1, size(growth)
                call add(parts, state%reaction(i)*growth(i))
            end do
        end if
        work = scale(total(parts), assembled%units%force + assembled%units%deflection)

    contains

        !> Fields at a distance from the left end of a piece
        pure function field_at(piece, distance) result(field)
            integer, intent(in) :: piece
            real(wp), intent(in) :: distance
            type(field_type) :: field, found(1)

            call values_at(assembled%pieces, assembled%dead, assembled%live, state%factor, starts, [piece], [distance], found)
            field = found(1)
        end function field_at

    end function work_of_live_loads

    !> Area between smooth laws and their chords from one state to another
    pure function area_over_chords(assembled, one, other) result(area)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: one, other
        real(wp) :: area
        integer, allocatable :: numbers(:)
        real(wp) :: w(2), past(2), force(2), slope(2)
        integer :: j, way(2)

        area = 0.0_wp
        allocate (numbers, source=smooth_supports(assembled))
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)))
                w = [deflection_at(assembled, one%deflection, numbers(j)), deflection_at(assembled, other%deflection, numbers(j))]
                call past_the_gap(s, w, past, way)
                call force_and_slope(s, past, force, slope)
                past = max(past, 0.0_wp)
                area = area + law_energy(s%law, s%parameter, past(2)) - law_energy(s%law, s%parameter, past(1)) &
                    - (way(1)*force(1) + way(2)*force(2))/2*(w(2) - w(1))
            end associate
        end do
    end function area_over_chords

end module gapbeam_path_energy
