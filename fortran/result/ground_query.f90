!> What a solved beam on the ground says: fields along it and their extremes, pressure, zones of contact
module gapbeam_ground_query
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type
    use gapbeam_foundation, only: stretch_ends_type, decay_lengths
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_foundation_roots, only: find_peaks
    use gapbeam_layers, only: law_piece_type, law_piece, is_curve, law_by_points
    use gapbeam_law_series, only: curve_force
    use gapbeam_curved, only: curved_type, curved_fields
    use gapbeam_ground_laws, only: contact_line, slope_of_layer, offset_of_layer, parameters_at, take_curves, along
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_lowered, only: lowered_type
    implicit none
    private
    public :: ground_values, ground_extremes, ground_pressure, pressure_extremes, largest_ways, is_shallow

    !> Distances between beam and ground of so many roundings of what they are made of are none
    real(wp), parameter :: touching = 32*epsilon(1.0_wp)
    !> Values that differ by less than this share of them are the same, and the first one of them, from the left, is taken: else
    !> rounding would choose among those of a symmetric beam
    real(wp), parameter :: same = 4*epsilon(1.0_wp)

contains

    !> Deflection, rotation, moment and shear at distances from the left ends of pieces
    pure subroutine ground_values(lowered, solution, piece, distance, fields)
        !> The beam, and its solution
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Pieces of the beam, and distances in the engine's units, shape (n)
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> Shape (n)
        type(field_type), intent(out) :: fields(:)
        integer :: i, k

        do k = 1, size(piece)
            i = stretch_of(solution, piece(k), distance(k))
            call values_in(lowered, solution, i, share_of(solution, i, distance(k)), fields(k))
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

    !> Fields inside a stretch, at its ends as they were solved
    pure subroutine values_in(lowered, solution, i, xi, field)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: xi
        type(field_type), intent(out) :: field
        type(curved_type), allocatable :: curved
        real(wp) :: off(2, 2)

        associate (ends => solution%ends(i))
            if (xi <= 0.0_wp) then
                field%deflection = ends%w_a
                field%moment = ends%moment_a
                field%rotation = solution%rotation(1, i)
                field%shear = solution%shear(1, i)
            else if (xi >= 1.0_wp) then
                field%deflection = ends%w_b
                field%moment = ends%moment_b
                field%rotation = solution%rotation(2, i)
                field%shear = solution%shear(2, i)
            else
                call curved_in(lowered, solution, i, curved)
                if (allocated(curved)) then
                    call curved_fields(curved, xi, field%deflection, field%rotation, field%moment, field%shear)
                    return
                end if
                ! Beside the chord
                call fields_at(solution%stretches(i), solution%loads(i), &
                               stretch_ends_type(0.0_wp, 0.0_wp, ends%moment_a, ends%moment_b), xi, field%deflection, &
                               field%rotation, field%moment, field%shear)
                field%deflection = along(ends%w_a, ends%w_b, xi, 1.0_wp) + field%deflection
                field%rotation = solution%slope(i) + field%rotation
                if (decay_lengths(solution%stretches(i)) > 1.0_wp) return
                ! In a short stretch the shear is a small difference of moments by a small length, and where shear bends most the
                ! rotation one of slopes: their errors are those at the ends, where they are known
                off(:, 1) = off_at(1)
                off(:, 2) = off_at(2)
                field%rotation = field%rotation + along(off(1, 1), off(1, 2), xi, 1.0_wp)
                field%shear = field%shear + along(off(2, 1), off(2, 2), xi, 1.0_wp)
            end if
        end associate

    contains

        !> What rotation and shear at an end of the stretch lack when they are made of load and moments
        pure function off_at(side) result(lacking)
            !> 1 left, 2 right
            integer, intent(in) :: side
            real(wp) :: lacking(2), deflection, rotation, moment, shear

            associate (ends => solution%ends(i))
                call fields_at(solution%stretches(i), solution%loads(i), &
                               stretch_ends_type(0.0_wp, 0.0_wp, ends%moment_a, ends%moment_b), real(side - 1, wp), deflection, &
                               rotation, moment, shear)
            end associate
            lacking = [solution%rotation(side, i) - (solution%slope(i) + rotation), solution%shear(side, i) - shear]
        end function off_at

    end subroutine values_in

    !> A stretch on which ground acts by curves
    pure subroutine curved_in(lowered, solution, i, curved)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        !> Not allocated if the ground is linear there
        type(curved_type), allocatable, intent(out) :: curved

        associate (j => solution%piece(i), ends => solution%ends(i), s => solution%stretches(i))
            associate (layers => lowered%layers(lowered%layer_first(j):lowered%layer_first(j + 1) - 1))
                if (.not. any(is_curve(layers, solution%acts(:size(layers), i)))) return
                allocate (curved)
                call take_curves(layers, solution%acts(:, i), solution%from(i), solution%to(i), lowered%pieces(j)%length, &
                                 curved%curves)
            end associate
            curved%stretch = s
            curved%load = solution%loads(i)
            curved%left = [ends%w_a - s%shear_flexibility*ends%moment_a, solution%rotation(1, i), ends%moment_a, &
                           solution%shear(1, i)]
            curved%right = [ends%w_b - s%shear_flexibility*ends%moment_b, solution%rotation(2, i), ends%moment_b, &
                            solution%shear(2, i)]
        end associate
    end subroutine curved_in

    !> Largest and smallest deflection, rotation, moment and shear, and where they are
    subroutine ground_extremes(lowered, solution, values, piece, distance)
        !> As for ground_values
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Maximum (1) and minimum (2), shape (2, 4)
        real(wp), intent(out) :: values(:, :)
        !> Pieces of the beam and distances from their left ends, shape (2, 4)
        integer, intent(out) :: piece(:, :)
        real(wp), intent(out) :: distance(:, :)
        type(field_type) :: field
        type(curved_type), allocatable :: curved
        real(wp), allocatable :: xi(:)
        integer :: i, j, k, number

        values(1, :) = -huge(1.0_wp)
        values(2, :) = huge(1.0_wp)
        piece(:, :) = 1
        distance(:, :) = 0.0_wp
        do i = 1, size(solution%piece)
            do j = 0, 1
                call values_in(lowered, solution, i, real(j, wp), field)
                do k = 1, 4
                    call consider(real(j, wp))
                end do
            end do
            call curved_in(lowered, solution, i, curved)
            do k = 1, 4
                call peaks_in(solution, i, k, 0.0_wp, curved, xi, number)
                do j = 1, number
                    call values_in(lowered, solution, i, xi(j), field)
                    call consider(xi(j))
                end do
            end do
        end do

    contains

        !> Compare a field with its extremes so far
        subroutine consider(at)
            real(wp), intent(in) :: at
            real(wp) :: value, place

            value = field%shear
            if (k == 1) value = field%deflection
            if (k == 2) value = field%rotation
            if (k == 3) value = field%moment
            place = along(solution%from(i), solution%to(i), at, 1.0_wp)
            if (value > values(1, k) + same*abs(values(1, k))) then
                values(1, k) = value
                piece(1, k) = solution%piece(i)
                distance(1, k) = place
            end if
            if (value < values(2, k) - same*abs(values(2, k))) then
                values(2, k) = value
                piece(2, k) = solution%piece(i)
                distance(2, k) = place
            end if
        end subroutine consider

    end subroutine ground_extremes

    !> Pressure of all ground on the beam at distances from the left ends of pieces, force per length, up
    pure subroutine ground_pressure(lowered, solution, piece, distance, pressure)
        !> The beam, and its solution
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> As for ground_values
        integer, intent(in) :: piece(:)
        real(wp), intent(in) :: distance(:)
        !> In the engine's units, shape (n)
        real(wp), intent(out) :: pressure(:)
        integer :: i, k

        do k = 1, size(piece)
            i = stretch_of(solution, piece(k), distance(k))
            pressure(k) = pressure_in(lowered, solution, i, share_of(solution, i, distance(k)))
        end do
    end subroutine ground_pressure

    !> Pressure of all layers inside a stretch
    pure function pressure_in(lowered, solution, i, xi) result(pressure)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(in) :: xi
        real(wp) :: pressure, place, push
        type(field_type) :: field
        type(law_piece_type) :: law
        integer :: k, acts

        pressure = 0.0_wp
        call values_in(lowered, solution, i, xi, field)
        associate (j => solution%piece(i))
            place = along(solution%from(i), solution%to(i), xi, 1.0_wp)
            do k = lowered%layer_first(j), lowered%layer_first(j + 1) - 1
                acts = solution%acts(k - lowered%layer_first(j) + 1, i)
                if (acts == 0) cycle
                associate (layer => lowered%layers(k), length => lowered%pieces(j)%length)
                    law = law_piece(layer, lowered%law_pieces, acts)
                    if (is_curve(layer, acts)) then
                        push = layer%side*curve_force(layer%law, parameters_at(layer, place, length), &
                                                      layer%side*(field%deflection - contact_line(layer, place, length)))
                    else
                        push = layer%side*offset_of_layer(layer, law, acts, place, length) &
                            + slope_of_layer(layer, law, acts, place, length) &
                            *(field%deflection - contact_line(layer, place, length))
                    end if
                    ! At an end of a zone it is zero but for rounding
                    if (layer%side /= 0) push = layer%side*max(0.0_wp, layer%side*push)
                    pressure = pressure + push
                end associate
            end do
        end associate
    end function pressure_in

    !> Where the distance between the beam and the line at which a layer begins to act is stationary inside a stretch: their
    !> difference is the deflection under the load less what the ground would take of it along the line
    subroutine peaks_beside(lowered, solution, i, k, xi, number)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Stretch and layer
        integer, intent(in) :: i, k
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number
        type(curved_type), allocatable :: curved
        real(wp) :: line(2)

        call curved_in(lowered, solution, i, curved)
        line(:) = contact_line(lowered%layers(k), [solution%from(i), solution%to(i)], lowered%pieces(solution%piece(i))%length)
        call peaks_in(solution, i, 1, (line(2) - line(1))/solution%stretches(i)%length, curved, xi, number)
    end subroutine peaks_beside

    !> Where the pressure of all layers is stationary inside a stretch in which no modulus varies: it is the sum of the moduli by
    !> the distance of the deflection from the mean of the lines at which the layers begin to act, weighted by these
    subroutine peaks_of_pressure(lowered, solution, i, xi, number)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number
        type(curved_type), allocatable :: none
        real(wp) :: modulus, rise, slope, line(2)
        integer :: k, acts

        modulus = 0.0_wp
        rise = 0.0_wp
        associate (j => solution%piece(i))
            do k = lowered%layer_first(j), lowered%layer_first(j + 1) - 1
                acts = solution%acts(k - lowered%layer_first(j) + 1, i)
                if (acts == 0) cycle
                associate (layer => lowered%layers(k), length => lowered%pieces(j)%length)
                    slope = slope_of_layer(layer, law_piece(layer, lowered%law_pieces, acts), acts, solution%from(i), length)
                    line(:) = contact_line(layer, [solution%from(i), solution%to(i)], length)
                end associate
                modulus = modulus + slope
                rise = rise + slope*(line(2) - line(1))
            end do
        end associate
        number = 0
        if (modulus > 0.0_wp) call peaks_in(solution, i, 1, rise/modulus/solution%stretches(i)%length, none, xi, number)
    end subroutine peaks_of_pressure

    !> Where a field of a stretch is stationary, of the deflection that beside a line
    pure subroutine peaks_in(solution, i, field, slope, curved, xi, number)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch, and field as for find_peaks
        integer, intent(in) :: i, field
        !> Of the line
        real(wp), intent(in) :: slope
        !> By curved_in
        type(curved_type), allocatable, intent(in) :: curved
        real(wp), allocatable, intent(out) :: xi(:)
        integer, intent(out) :: number

        if (allocated(curved)) then
            call find_peaks(solution%stretches(i), solution%loads(i), solution%ends(i), field, xi, number, &
                            merge(slope, 0.0_wp, field == 1), curved)
            return
        end if
        associate (ends => solution%ends(i))
            call find_peaks(solution%stretches(i), solution%loads(i), &
                            stretch_ends_type(0.0_wp, 0.0_wp, ends%moment_a, ends%moment_b), field, xi, number, &
                            merge(slope - solution%slope(i), 0.0_wp, field == 1))
        end associate
    end subroutine peaks_in

    !> Largest distance of the beam from every layer under its stretches, and where it touches one without pressing it
    subroutine largest_ways(lowered, solution, way, touch)
        !> The beam, and its solution
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> In the engine's units, 0 where the layer acts all along, shape (most layers, stretches)
        real(wp), intent(out) :: way(:, :)
        !> The at most two places of each that are nearest to the ground, if they touch it, as shares of the stretch, ascending;
        !> none: -1. Shape (2, most layers, stretches)
        real(wp), intent(out) :: touch(:, :, :)
        real(wp), allocatable :: xi(:)
        integer :: i, j, k, number

        way(:, :) = 0.0_wp
        touch(:, :, :) = -1.0_wp
        do i = 1, size(solution%piece)
            associate (first => lowered%layer_first(solution%piece(i)), last => lowered%layer_first(solution%piece(i) + 1) - 1)
                do k = first, last
                    if (solution%acts(k - first + 1, i) > 0) cycle
                    call peaks_beside(lowered, solution, i, k, xi, number)
                    call look_at(0.0_wp)
                    do j = 1, number
                        call look_at(xi(j))
                    end do
                    call look_at(1.0_wp)
                end do
            end associate
        end do

    contains

        !> Ask for the distance at a place of the stretch
        subroutine look_at(at)
            real(wp), intent(in) :: at
            real(wp) :: distance, rounding

            call distance_at(lowered, solution, i, k, at, distance, rounding)
            associate (most => way(k - lowered%layer_first(solution%piece(i)) + 1, i), &
                       places => touch(:, k - lowered%layer_first(solution%piece(i)) + 1, i))
                most = max(most, distance)
                if (abs(distance) > touching*rounding) return
                if (places(1) < 0.0_wp) then
                    places(1) = at
                else
                    places(2) = at
                end if
            end associate
        end subroutine look_at

    end subroutine largest_ways

    !> Distance between the beam and the line at which a layer begins to act, and the size of what it is the difference of, which
    !> times the rounding unit bounds its error (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.1)
    pure subroutine distance_at(lowered, solution, i, k, at, distance, rounding)
        !> As for largest_ways
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Stretch, layer, and share of the stretch
        integer, intent(in) :: i, k
        real(wp), intent(in) :: at
        !> Positive where there is no contact; size of its terms
        real(wp), intent(out) :: distance, rounding
        type(field_type) :: field
        real(wp) :: line, moment, q, square

        associate (layer => lowered%layers(k), s => solution%stretches(i), ends => solution%ends(i), load => solution%loads(i))
            call values_in(lowered, solution, i, at, field)
            line = contact_line(layer, along(solution%from(i), solution%to(i), at, 1.0_wp), &
                                lowered%pieces(solution%piece(i))%length)
            distance = layer%side*(line - field%deflection)
            moment = max(abs(ends%moment_a), abs(ends%moment_b))
            q = max(abs(load%qa), abs(load%qb))
            ! What moment and load bend a simple beam by; on elastic ground what is farther away than 1/beta is not felt
            square = s%length**2/8
            if (s%modulus_a > 0.0_wp .and. s%flexibility > 0.0_wp) then
                square = min(square, 1/sqrt(s%modulus_a)/sqrt(s%flexibility))
            end if
            rounding = max(abs(ends%w_a), abs(ends%w_b)) + abs(line) &
                + square*(s%flexibility*(moment + square*q) + abs(load%kappa)) + s%shear_flexibility*(moment + square*q)
        end associate
    end subroutine distance_at

    !> Is a stretch in which a layer acts pressed into it by nothing but rounding
    pure function is_shallow(lowered, solution, i, k) result(shallow)
        !> As for largest_ways
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Stretch and layer
        integer, intent(in) :: i, k
        logical :: shallow
        real(wp) :: distance, rounding
        integer :: j

        shallow = .true.
        do j = 0, 4
            call distance_at(lowered, solution, i, k, j/4.0_wp, distance, rounding)
            shallow = shallow .and. abs(distance) <= touching*rounding
        end do
    end function is_shallow

    !> Is the pressure in a stretch more than multiples of the deflection beside lines
    pure function varies(lowered, solution, i)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        logical :: varies

        associate (j => solution%piece(i))
            associate (layers => lowered%layers(lowered%layer_first(j):lowered%layer_first(j + 1) - 1))
                varies = any(solution%acts(:size(layers), i) > 0 .and. (layers%law /= law_by_points .or. &
                                                                        abs(layers%modulus_a - layers%modulus_b) > 0.0_wp))
            end associate
        end associate
    end function varies

    !> Largest and smallest pressure, and where it is: at an end of a stretch, or where the deflection is extreme beside the ground
    subroutine pressure_extremes(lowered, solution, values, piece, distance)
        type(lowered_type), intent(in) :: lowered
        type(ground_solution_type), intent(in) :: solution
        !> Maximum (1) and minimum (2), their pieces and distances, shape (2)
        real(wp), intent(out) :: values(2), distance(2)
        integer, intent(out) :: piece(2)
        real(wp), allocatable :: xi(:)
        real(wp) :: pressure
        integer :: i, j, number

        values = [-huge(1.0_wp), huge(1.0_wp)]
        piece = 1
        distance = 0.0_wp
        do i = 1, size(solution%piece)
            call consider(0.0_wp)
            call consider(1.0_wp)
            if (varies(lowered, solution, i)) then
                call consider(peak_where_it_varies(1))
                call consider(peak_where_it_varies(-1))
                cycle
            end if
            call peaks_of_pressure(lowered, solution, i, xi, number)
            do j = 1, number
                call consider(xi(j))
            end do
        end do

    contains

        !> Where the modulus varies, the pressure is a product whose peak no derivative of the fields tells: stretches are short
        !> there, and one peak lies beside the best of some places (golden section)
        function peak_where_it_varies(way) result(at)
            !> 1: largest, -1: smallest
            integer, intent(in) :: way
            real(wp) :: at
            integer, parameter :: places = 16, halvings = 60
            real(wp), parameter :: golden = (sqrt(5.0_wp) - 1)/2
            real(wp) :: found(0:places), low, high, inner(2)
            integer :: n

            do n = 0, places
                found(n) = way*pressure_in(lowered, solution, i, real(n, wp)/places)
            end do
            n = maxloc(found, 1) - 1
            low = max(n - 1, 0)/real(places, wp)
            high = min(n + 1, places)/real(places, wp)
            do n = 1, halvings
                inner = [high - golden*(high - low), low + golden*(high - low)]
                if (way*pressure_in(lowered, solution, i, inner(1)) > way*pressure_in(lowered, solution, i, inner(2))) then
                    high = inner(2)
                else
                    low = inner(1)
                end if
            end do
            at = low + (high - low)/2
        end function peak_where_it_varies

        !> Compare with the extremes so far
        subroutine consider(at)
            real(wp), intent(in) :: at

            pressure = pressure_in(lowered, solution, i, at)
            if (pressure > values(1)) call keep(1, at)
            if (pressure < values(2)) call keep(2, at)
        end subroutine consider

        !> Note an extreme
        subroutine keep(which, at)
            integer, intent(in) :: which
            real(wp), intent(in) :: at

            values(which) = pressure
            piece(which) = solution%piece(i)
            distance(which) = along(solution%from(i), solution%to(i), at, 1.0_wp)
        end subroutine keep

    end subroutine pressure_extremes

end module gapbeam_ground_query
