!> Fields of a solved beam on the ground, and their extremes.
module gapbeam_ground_query
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_extreme
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_load_type, combine_loads
    use gapbeam_piece, only: is_tapered, curvature_at
    use gapbeam_fields, only: bending_values
    use gapbeam_quantities, only: state_count, derived_count, bending_count, terms_of_derived
    use gapbeam_foundation, only: stretch_ends_type
    use gapbeam_foundation_question, only: slope_of_curvature
    use gapbeam_foundation_roots, only: find_peaks
    use gapbeam_curved, only: curved_type
    use gapbeam_layers, only: layer_type
    use gapbeam_ground_laws, only: along
    use gapbeam_ground_fields, only: inside_type, prepare_inside, field_at_end, field_inside, curved_stretch
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_assembled_model, only: assembled_type
    implicit none
    private
    public :: ground_values, ground_extremes
    ! For gapbeam_pressure and gapbeam_ground_distance
    public :: layers_under, stretch_of, share_of, values_in, curved_in, compare, peaks_in

contains

    !> Deflection, rotation, moment and shear at distances from the left ends of pieces
    pure subroutine ground_values(assembled, solution, piece, distance, fields)
        !> The beam, and its solution
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> Pieces of the beam, and distances in the engine's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Shape (n)
        type(field_type), intent(out) :: fields(:)
        integer :: i, k

        do k = 1, size(piece)
            i = stretch_of(solution, piece(k), distance(k))
            call values_in(assembled, solution, i, share_of(solution, i, distance(k)), fields(k))
        end do
    end subroutine ground_values

    !> The stretch in which a place lies
    pure function stretch_of(solution, piece, distance) result(i)
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        integer :: i, high, middle

        i = 1
        high = size(solution%piece) + 1
        do while (high - i > 1)
            middle = i + (high - i)/2
            if (solution%piece(middle) < piece .or. (solution%piece(middle) == piece .and. solution%from(middle) <= distance)) then
                i = middle
            else
                high = middle
            end if
        end do
    end function stretch_of

    !> Where in its stretch a place lies, 0 to 1
    pure function share_of(solution, i, distance) result(xi)
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: distance
        real(wp) :: xi

        xi = 0.0_wp
        associate (from => solution%from(i), to => solution%to(i))
            if (distance > from .and. to > from) xi = min(1.0_wp, (distance - from)/(to - from))
        end associate
    end function share_of

    !> The layers under a piece of the beam, where they have moved to when it was solved
    pure function layers_under(assembled, solution, piece) result(layers)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: piece
        type(layer_type) :: layers(assembled%layer_first(piece + 1) - assembled%layer_first(piece))

        associate (first => assembled%layer_first(piece), last => assembled%layer_first(piece + 1) - 1)
            layers(:) = assembled%layers(first:last)
            if (.not. allocated(assembled%layer_growth)) return
            layers%contact_a = layers%contact_a + solution%factor*assembled%layer_growth(1, first:last)
            layers%contact_b = layers%contact_b + solution%factor*assembled%layer_growth(2, first:last)
        end associate
    end function layers_under

    !> Fields inside a stretch, at its ends as they were solved
    pure subroutine values_in(assembled, solution, i, xi, field)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: xi
        type(field_type), intent(out) :: field
        type(inside_type) :: inside

        if (xi <= 0.0_wp .or. xi >= 1.0_wp) then
            field = field_at_end(solution, i, merge(1, 2, xi <= 0.0_wp))
            return
        end if
        associate (j => solution%piece(i))
            call prepare_inside(layers_under(assembled, solution, j), assembled%law_pieces, &
                                assembled%pieces(j)%length, solution, i, inside)
        end associate
        call field_inside(inside, xi, field)
    end subroutine values_in

    !> A stretch on which ground acts by curves
    pure subroutine curved_in(assembled, solution, i, curved)
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        !> Not allocated if the ground is linear there
        type(curved_type), allocatable, intent(out) :: curved

        associate (j => solution%piece(i))
            call curved_stretch(layers_under(assembled, solution, j), assembled%law_pieces, &
                                assembled%pieces(j)%length, solution, i, curved)
        end associate
    end subroutine curved_in

    !> Largest and smallest quantities of bending (gapbeam_quantities), and where they are. Those of derived ones are sought where
    !> those of what they are made of are: one of deflection, rotation, moment, shear, for shares do not change inside a piece that
    !> is prismatic
    subroutine ground_extremes(assembled, solution, factor, values, piece, distance)
        !> As for ground_values, and the factor of the live loads
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        real(wp), intent(in) :: factor
        !> Maximum (1) and minimum (2), shape (2, bending_count)
        real(wp), intent(out) :: values(:, :)
        !> Pieces of the beam and distances from their left ends, shape (2, bending_count)
        integer, intent(out) :: piece(:, :)
        real(wp), intent(out) :: distance(:, :)
        type(field_type) :: field
        type(curved_type), allocatable :: curved
        type(piece_load_type) :: load
        real(wp), allocatable :: xi(:)
        logical :: is_term(state_count, derived_count)
        integer :: i, j, k, d, numbers(state_count)

        is_term(:, :) = terms_of_derived()
        values(1, :) = -huge(1.0_wp)
        values(2, :) = huge(1.0_wp)
        piece(:, :) = 1
        distance(:, :) = 0.0_wp
        do i = 1, size(solution%piece)
            load = combine_loads(assembled%dead(solution%piece(i)), assembled%live(solution%piece(i)), factor)
            do j = 0, 1
                call values_in(assembled, solution, i, real(j, wp), field)
                do k = 1, bending_count
                    call consider(k, real(j, wp))
                end do
            end do
            call curved_in(assembled, solution, i, curved)
            call peaks_in(solution, i, [(k, k=1, state_count)], 0.0_wp, curved, xi, numbers)
            do k = 1, state_count
                do j = sum(numbers(:k - 1)) + 1, sum(numbers(:k))
                    call values_in(assembled, solution, i, xi(j), field)
                    call consider(k, xi(j))
                    do d = 1, derived_count
                        if (is_term(k, d)) call consider(state_count + d, xi(j))
                    end do
                end do
            end do
            if (.not. (is_tapered(assembled%pieces(solution%piece(i))) .or. abs(load%rise) > 0.0_wp)) cycle
            ! There the curvature is not a multiple of the moment
            call peaks_in(solution, i, [slope_of_curvature], 0.0_wp, curved, xi)
            do j = 1, size(xi)
                call values_in(assembled, solution, i, xi(j), field)
                do d = 1, derived_count
                    call consider(state_count + d, xi(j))
                end do
            end do
        end do

    contains

        !> Compare a quantity with its extremes so far
        subroutine consider(k, at)
            integer, intent(in) :: k
            real(wp), intent(in) :: at
            real(wp) :: all_of_them(bending_count), place

            place = along(solution%from(i), solution%to(i), at, 1.0_wp)
            associate (piece => assembled%pieces(solution%piece(i)))
                all_of_them(:) = bending_values(field, piece, curvature_at(load, place, piece%length), place)
            end associate
            call compare(solution, i, at, all_of_them(k), same_extreme, values(:, k), piece(:, k), distance(:, k))
        end subroutine consider

    end subroutine ground_extremes

    !> Compare a value inside a stretch with the extremes so far
    pure subroutine compare(solution, i, xi, found, slack, value, piece, distance)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        !> Share of its length, the value there, and the share of an extreme by which another one is beyond it
        real(wp), intent(in) :: xi, found, slack
        !> Maximum (1) and minimum (2), their pieces, and distances from the left ends of these
        real(wp), intent(inout) :: value(2), distance(2)
        integer, intent(inout) :: piece(2)

        where ([found > value(1) + slack*abs(value(1)), found < value(2) - slack*abs(value(2))])
            value = found
            piece = solution%piece(i)
            distance = along(solution%from(i), solution%to(i), xi, 1.0_wp)
        end where
    end subroutine compare

    !> Where fields of a stretch are stationary, of the deflection that beside a line
    pure subroutine peaks_in(solution, i, fields, slope, curved, xi, numbers)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch, and fields as for find_peaks
        integer, intent(in) :: i, fields(:)
        !> Of the line
        real(wp), intent(in) :: slope
        !> By curved_in
        type(curved_type), allocatable, intent(in) :: curved
        !> Field after field, and how many of each
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out), optional :: numbers(:)

        if (allocated(curved)) then
            call find_peaks(solution%stretches(i), solution%loads(i), solution%ends(i), fields, xi, slope, curved, numbers)
        else
            associate (ends => solution%ends(i))
                call find_peaks(solution%stretches(i), solution%loads(i), &
                                stretch_ends_type(0.0_wp, 0.0_wp, ends%moment_a, ends%moment_b), fields, xi, &
                                slope - solution%slope(i), numbers=numbers)
            end associate
        end if
    end subroutine peaks_in

end module gapbeam_ground_query
