!> Solution of a beam on the ground in quadruple precision, rounded once to doubles.
!> Ends, fields, reactions, and the force of every layer on every stretch.
module gapbeam_ground_solution
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_taylor_terms
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_tolerances, only: sign_width, fine_rounding, ground_fine_width, same_ratio_of_slopes
    use gapbeam_foundation_quad, only: fine_stretch_type => stretch_type, fine_stretch_load_type => stretch_load_type, &
        fine_ends_type => stretch_ends_type
    use gapbeam_foundation_stretch_quad, only: softness_in, without_slip, part_of_stretch, tension_at
    use gapbeam_foundation_taylor_quad, only: expand, terms_of, stretched_shear, transverse_of, deflection_series
    use gapbeam_layers_quad, only: fine_law_piece_type => law_piece_type, law_piece, is_curve
    use gapbeam_ground_laws_quad, only: contact_line, slope_of_layer, offset_of_layer
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, &
        fine_grounded_type => grounded_type
    use gapbeam_stretch_loads_quad, only: combined_load
    use gapbeam_zone_fields_quad, only: ends_of, fields_at_ends, take_curved
    use gapbeam_curved_quad, only: curved_type, advance_curved, curved_fields
    use gapbeam_laws_quad, only: law_force
    use gapbeam_refined_ground, only: rounded_stretch, rounded_load, rounded_ends
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_law_margins_quad, only: find_margins, is_watched_in
    implicit none
    private
    public :: ground_solution_type, take_rounded

    !> A solved beam on the ground, in stretches from left to right, and the values at the nodes
    type :: ground_solution_type
        !> Piece of the beam, and distances of the ends of the stretch from its left end, shape (m)
        integer, allocatable :: piece(:)
        real(wp), allocatable :: from(:), to(:)
        !> Piece of the law on which every layer acts, 0: not in contact, shape (most layers of a piece, m)
        integer, allocatable :: acts(:, :)
        !> Into how many steps every piece of the beam was cut in any case, shape (n)
        integer, allocatable :: steps(:)
        !> The stretches and what is at their ends, and their loads, with those of the layers, less what the ground takes of the
        !> chord between the ends: so the deflection beside the chord has its digits however deep the ground lies, shape (m)
        type(stretch_type), allocatable :: stretches(:)
        type(stretch_load_type), allocatable :: loads(:)
        type(stretch_ends_type), allocatable :: ends(:)
        !> Slope of the chord, shape (m)
        real(wp), allocatable :: slope(:)
        !> Rotations, shears and transverse forces (gapbeam_foundation) at the two ends, shape (2, m)
        real(wp), allocatable :: rotation(:, :), shear(:, :), force(:, :)
        !> Force of every layer on the stretch, up, shape (most layers of a piece, m)
        real(wp), allocatable :: resultant(:, :)
        !> Of rigid ground, not allocated where there is none: pressure at both ends of every stretch, up, shape (2, m), and point
        !> forces, up, at the right end of every stretch, at the beam's left end for 0, and which layer it is, 0: none; shape (0:m)
        real(wp), allocatable :: pressure(:, :), push(:)
        integer, allocatable :: pushing(:)
        !> At the nodes of the beam, shape (0:n); behind these of the deflections rotations that supports hold
        real(wp), allocatable :: deflection(:), moment_left(:), moment_right(:)
        !> Of the supports
        real(wp), allocatable :: reaction(:)
        logical, allocatable :: undecided(:)
        !> Load factor of its live loads, to which supports and ground have moved; up to which forces of layers are none
        real(wp) :: factor = 0.0_wp, no_force = 0.0_wp
        !> Linear solves; was it found from the one under more load (gapbeam_less_load)
        integer :: solves = 0
        logical :: from_more_load = .false.
        !> Is it known to be the only one; where there is none under compression, the share of the axial forces that the beam bears,
        !> where the force of ground falls that of the load factor
        logical :: unique = .true.
        real(wp) :: axial_share = 1.0_wp
        !> How it gives way then: pieces of the beam, distances from their left ends, deflections, the largest 1
        integer, allocatable :: mode_piece(:)
        real(wp), allocatable :: mode_distance(:), mode_deflection(:)
        !> Bounds of errors of deflections, rotations, moments, shears and reactions; residuals (gapbeam_ground_audit)
        real(wp) :: bounds(5) = 0.0_wp, residuals(3) = 0.0_wp
    end type ground_solution_type

contains

    !> The solution in quadruple precision, rounded once
    subroutine take_rounded(fine, factor, zones, grounded, closed, work, solution)
        type(fine_ground_type), intent(in) :: fine
        real(qp), intent(in) :: factor
        !> Zones that the solution asks for, and the beam on those before
        type(fine_zones_type), intent(in) :: zones
        type(fine_grounded_type), intent(in) :: grounded
        logical, intent(in) :: closed(:)
        type(fine_workspace_type), intent(inout) :: work
        type(ground_solution_type), intent(inout) :: solution
        type(fine_stretch_type) :: stretch
        type(fine_ends_type) :: ends
        type(fine_stretch_load_type) :: load
        type(curved_type), allocatable :: curved
        real(qp) :: field(2, 2), forces(size(zones%acts, 1)), from, margin(size(closed)), rounding(size(closed))
        integer :: i, k, m

        m = size(zones%piece)
        from = 0.0_qp
        call make_room(solution, m, size(zones%acts, 1), size(fine%pieces), ubound(work%answers, 1) - m, size(closed))
        solution%factor = real(factor, wp)
        solution%steps(:) = zones%steps
        solution%piece(:) = zones%piece
        solution%from(:) = real(zones%from, wp)
        solution%to(:) = real(zones%to, wp)
        solution%acts(:, :) = zones%acts
        do i = 1, m
            call drop_rounding(grounded, i, work)
            stretch = grounded%stretches(i)
            ends = ends_of(grounded, factor, work, i)
            load = combined_load(grounded%dead(i), grounded%live(i), factor)
            call fields_at_ends(grounded, factor, work, i, field(:, 1), field(:, 2))
            call drop_small(grounded, factor, work, i, field)
            ! Where it was when it was solved: its ends have moved since then
            if (i > 1) then
                from = from + grounded%stretches(i - 1)%length
                if (zones%piece(i) /= zones%piece(i - 1)) from = 0.0_qp
            end if
            call take_curved(fine, grounded, zones, factor, work, i, curved)
            call go_with_ends(zones%from(i) - from, zones%to(i) - zones%from(i), stretch, load, ends, field, curved)
            solution%stretches(i) = rounded_stretch(stretch)
            solution%slope(i) = real((ends%w_b - ends%w_a)/stretch%length, wp)
            solution%ends(i) = rounded_ends(ends)
            call sum_layers(fine, zones, i, stretch, load, ends, field, curved, forces)
            if (.not. allocated(curved)) load = beside_line(stretch, load, [ends%w_a, ends%w_b])
            solution%loads(i) = rounded_load(load)
            solution%resultant(:, i) = real(forces, wp)
            solution%rotation(:, i) = real(field(:, 1), wp)
            solution%shear(:, i) = real(field(:, 2), wp)
            solution%force(:, i) = real(transverse_of(stretch, [0.0_qp, 1.0_qp], field(:, 1), field(:, 2)), wp)
        end do
        call find_margins(grounded%beam%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                          margin, rounding)
        solution%undecided(:) = .false.
        do k = 1, size(closed)
            if (.not. is_watched_in(grounded%beam%supports, closed, k)) cycle
            solution%undecided(k) = abs(margin(k)) <= sign_width*rounding(k)*(epsilon(1.0_wp)/epsilon(1.0_qp))
            ! What begins to act there has no force; a later piece of a law begins with one
            if (closed(k) .and. .not. abs(grounded%beam%supports(k)%force) > 0.0_qp .and. &
                abs(margin(k)) <= ground_fine_width*rounding(k)) work%reaction(k) = 0.0_qp
        end do
        solution%deflection(:) = real(work%answers([grounded%node, (i, i=m + 1, ubound(work%answers, 1))])%deflection, wp)
        solution%moment_left(:) = real(work%answers(grounded%node)%moment_left, wp)
        solution%moment_right(:) = real(work%answers(grounded%node)%moment_right, wp)
        solution%reaction(:) = real(work%reaction, wp)
    end subroutine take_rounded

    !> Move the ends of a stretch a little, and all that stands there with them: the rest is of the order of the square of the way
    pure subroutine go_with_ends(way, length, stretch, load, ends, field, curved)
        !> Way of the left end, and the new length
        real(qp), intent(in) :: way, length
        !> The stretch and its load, and what is at its ends
        type(fine_stretch_type), intent(inout) :: stretch
        type(fine_stretch_load_type), intent(inout) :: load
        type(fine_ends_type), intent(inout) :: ends
        !> Left and right, rotation and shear
        real(qp), intent(inout) :: field(2, 2)
        !> Allocated if some ground acts by curves
        type(curved_type), allocatable, intent(inout) :: curved
        type(fine_stretch_type) :: s
        type(fine_stretch_load_type) :: q
        real(qp) :: ways(2), share(2)

        s = stretch
        q = load
        ways = [way, way + (length - s%length)]
        if (all(abs(ways) <= fine_rounding*length)) return
        where (abs(ways) <= fine_rounding*length) ways = 0.0_qp
        call go(ways(1), 0.0_qp, s%modulus_a, q%qa - by_curves(.true.), ends%w_a, ends%moment_a, field(1, :))
        call go(ways(2), 1.0_qp, s%modulus_b, q%qb - by_curves(.false.), ends%w_b, ends%moment_b, field(2, :))
        share = [ways(1), s%length + ways(2)]/s%length
        stretch = part_of_stretch(s, share)
        stretch%length = length
        load%qa = q%qa + share(1)*(q%qb - q%qa + q%qc*(1 - share(1)))
        load%qb = q%qa + share(2)*(q%qb - q%qa + q%qc*(1 - share(2)))
        load%qc = q%qc*(length/s%length)**2
        load%kappa = q%kappa + share(1)*q%rise
        load%rise = (share(2) - share(1))*q%rise
        if (.not. allocated(curved)) return
        curved%stretch = stretch
        curved%load = load
        curved%left = [without_slip(stretch, 0.0_qp, ends%w_a, ends%moment_a), field(1, 1), ends%moment_a, field(1, 2)]
        curved%right = [without_slip(stretch, 1.0_qp, ends%w_b, ends%moment_b), field(2, 1), ends%moment_b, field(2, 2)]

    contains

        !> Pressure of the ground that acts by curves, at the left or right end
        pure function by_curves(at_left) result(pressure)
            logical, intent(in) :: at_left
            real(qp) :: pressure
            integer :: k

            pressure = 0.0_qp
            if (.not. allocated(curved)) return
            do k = 1, size(curved%curves)
                associate (c => curved%curves(k))
                    if (at_left) then
                        pressure = pressure + c%side*law_force(c%law, c%parameter_a, c%side*(ends%w_a - c%contact_a))
                    else
                        pressure = pressure + c%side*law_force(c%law, c%parameter_b, c%side*(ends%w_b - c%contact_b))
                    end if
                end associate
            end do
        end function by_curves

        !> The fields a little farther on
        pure subroutine go(way, xi, modulus, pressure, w, moment, turn_and_shear)
            !> How far, from which end of the stretch: 0 or 1
            real(qp), intent(in) :: way, xi, modulus, pressure
            real(qp), intent(inout) :: w, moment, turn_and_shear(2)
            real(qp) :: gain(4), softness(2), bent

            softness(:) = softness_in(s, xi)
            associate (psi => turn_and_shear(1), shear => turn_and_shear(2))
                bent = q%kappa + xi*q%rise - softness(1)*moment
                gain = way*[psi + softness(2)*shear, bent, shear, (modulus*w - pressure - tension_at(s, xi)*bent &
                             - s%tension_change/s%length*psi)/stretched_shear(s)]
                w = w + gain(1)
                psi = psi + gain(2)
                moment = moment + gain(3)
                shear = shear + gain(4)
            end associate
        end subroutine go

    end subroutine go_with_ends

    !> A solution without numbers, but for those of the solves
    pure subroutine make_room(solution, stretches, layers, pieces, rotations, supports)
        type(ground_solution_type), intent(inout) :: solution
        !> Stretches, most layers under one, pieces of the beam, rotations that supports hold, supports
        integer, intent(in) :: stretches, layers, pieces, rotations, supports
        type(ground_solution_type) :: empty

        empty%solves = solution%solves
        solution = empty
        allocate (solution%piece(stretches), solution%from(stretches), solution%to(stretches), solution%acts(layers, stretches), &
                  solution%stretches(stretches), solution%loads(stretches), solution%ends(stretches), solution%slope(stretches), &
                  solution%rotation(2, stretches), solution%shear(2, stretches), solution%force(2, stretches), &
                  solution%resultant(layers, stretches), solution%steps(pieces), solution%deflection(0:pieces + rotations), &
                  solution%moment_left(0:pieces), solution%moment_right(0:pieces), solution%reaction(supports), &
                  solution%undecided(supports))
    end subroutine make_room

    !> Moments that are nothing but rounding beside what the stretch right of them could make are zero
    subroutine drop_rounding(grounded, i, work)
        type(fine_grounded_type), intent(in) :: grounded
        integer, intent(in) :: i
        type(fine_workspace_type), intent(inout) :: work
        real(qp) :: least

        associate (a => work%answers(i - 1), b => work%answers(i), g => grounded%beam%ground(i), link => grounded%beam%links(i))
            least = fine_rounding*(g%pa*max(abs(a%moment_right), abs(b%moment_left)) &
                                   + g%gaa*max(abs(a%deflection), abs(b%deflection)) + sum(abs(link%shear_a)))/g%pa
            if (abs(a%moment_right) <= least) a%moment_right = 0.0_qp
            if (abs(b%moment_left) <= least) b%moment_left = 0.0_qp
        end associate
    end subroutine drop_rounding

    !> Rotations and shears at the ends of a stretch that are nothing but rounding are zero
    subroutine drop_small(grounded, factor, work, i, field)
        type(fine_grounded_type), intent(in) :: grounded
        real(qp), intent(in) :: factor
        type(fine_workspace_type), intent(in) :: work
        integer, intent(in) :: i
        !> Left and right, rotation and shear
        real(qp), intent(inout) :: field(2, 2)
        real(qp) :: w, moment, sizes(2)

        associate (a => work%answers(i - 1), b => work%answers(i), g => grounded%beam%ground(i), link => grounded%beam%links(i))
            w = max(abs(a%deflection), abs(b%deflection))
            moment = max(abs(a%moment_right), abs(b%moment_left))
            sizes = [g%pa*w + max(g%faa, g%fbb)*moment + abs(link%turn_a(1)) + abs(factor*link%turn_a(2)), &
                     g%pa*moment + max(g%gaa, g%gbb)*w + abs(link%shear_a(1)) + abs(factor*link%shear_a(2))]
        end associate
        where (abs(field) <= fine_rounding*spread(sizes, 1, 2)) field = 0.0_qp
    end subroutine drop_small

    !> Force of every layer on a stretch: transverse force gains all pressure less the load; one layer takes it, several share it
    subroutine sum_layers(fine, zones, i, stretch, load, ends, field, curved, forces)
        type(fine_ground_type), intent(in) :: fine
        type(fine_zones_type), intent(in) :: zones
        !> Number of the stretch; what it is made of, its load, what is at its ends
        integer, intent(in) :: i
        type(fine_stretch_type), intent(in) :: stretch
        type(fine_stretch_load_type), intent(in) :: load
        type(fine_ends_type), intent(in) :: ends
        !> Left and right, rotation and shear
        real(qp), intent(in) :: field(2, 2)
        !> Allocated if some ground acts by curves
        type(curved_type), allocatable, intent(in) :: curved
        !> Up
        real(qp), intent(out) :: forces(:)
        type(fine_law_piece_type) :: law
        real(qp) :: from, slope(2), contact(2), offset(2), modulus(2), by_springs, y(4)
        real(qp), allocatable :: by_curves(:)
        logical :: lost
        integer :: k, n

        forces(:) = 0.0_qp
        if (.not. any(zones%acts(:, i) > 0)) return
        from = zones%from(i)
        modulus = [stretch%modulus_a, stretch%modulus_b]
        by_springs = (transverse_of(stretch, 1.0_qp, field(2, 1), field(2, 2)) &
                      - transverse_of(stretch, 0.0_qp, field(1, 1), field(1, 2))) &
            + stretch%length*((load%qa + load%qb)/2 + load%qc/6)
        n = 0
        if (allocated(curved)) then
            allocate (by_curves(size(curved%curves)), source=by_springs*curved%curves%side)
            if (count(zones%acts(:, i) > 0) > 1) call advance_curved(curved, 0.0_qp, curved%left, 1.0_qp, y, lost, forces=by_curves)
            by_springs = by_springs - dot_product(curved%curves%side, by_curves)
        end if
        associate (j => zones%piece(i), length => stretch%length)
            do k = 1, fine%first(j + 1) - fine%first(j)
                if (zones%acts(k, i) == 0) cycle
                associate (layer => fine%layers(fine%first(j) + k - 1))
                    if (is_curve(layer, zones%acts(k, i))) then
                        n = n + 1
                        forces(k) = layer%side*by_curves(n)
                        cycle
                    end if
                    law = law_piece(layer, fine%laws, zones%acts(k, i))
                    slope = slope_of_layer(layer, law, zones%acts(k, i), [from, from + length], fine%pieces(j)%length)
                    contact = contact_line(layer, [from, from + length], fine%pieces(j)%length)
                    offset = offset_of_layer(layer, law, zones%acts(k, i), [from, from + length], fine%pieces(j)%length)
                    forces(k) = layer%side*(offset(1) + offset(2))/2*length &
                        - length*(dot_product(slope, contact)/2 - (slope(2) - slope(1))*(contact(2) - contact(1))/6)
                    if (.not. any(abs(slope) > 0.0_qp)) cycle
                    ! Is its share of the modulus the same everywhere, and at most 1: where others fall they cancel
                    if (abs(slope(1)*modulus(2) - slope(2)*modulus(1)) <= same_ratio_of_slopes*abs(slope(1)*modulus(2)) &
                        .and. all(abs(slope) <= (1 + same_ratio_of_slopes)*abs(modulus))) then
                        forces(k) = forces(k) + by_springs*(sum(slope)/sum(modulus))
                    else
                        forces(k) = forces(k) + integral(slope)
                    end if
                end associate
            end do
        end associate

    contains

        !> Integral of the slope times the deflection: term by term of its series, which is short as such stretches are
        function integral(slope) result(total)
            real(qp), intent(in) :: slope(2)
            real(qp) :: total, c(1, 4, 0:most_taylor_terms), start(1, 4), w(0:most_taylor_terms)
            integer :: n, i

            if (allocated(curved)) then
                total = integral_on_curves(curved, stretch%length, slope)
                return
            end if
            n = terms_of(stretch, 1.0_qp)
            start(1, :) = [ends%w_a - stretch%shear_flexibility*ends%moment_a, field(1, 1), ends%moment_a, field(1, 2)]
            call expand(stretch, [load], 0.0_qp, start, 1.0_qp, n, c)
            w(0:n) = deflection_series(stretch, 0.0_qp, 1.0_qp, c(1, :, 0:n))
            total = stretch%length*sum([(w(i)*(slope(1)/(i + 1) + (slope(2) - slope(1))/(i + 2)), i=n, 0, -1)])
        end function integral

    end subroutine sum_layers

    !> Integral of a slope times the deflection on a stretch where laws are curves (Gauss, 5 points on each of 16 parts)
    function integral_on_curves(curved, length, slope) result(total)
        type(curved_type), intent(in) :: curved
        real(qp), intent(in) :: length, slope(2)
        real(qp) :: total, xi, w, psi, moment, shear
        real(qp), parameter :: near = sqrt(5 - 2*sqrt(10/7.0_qp))/3, far = sqrt(5 + 2*sqrt(10/7.0_qp))/3, &
            point(5) = [-far, -near, 0.0_qp, near, far], root = sqrt(70.0_qp), &
            weight(5) = [322 - 13*root, 322 + 13*root, 512.0_qp, 322 + 13*root, 322 - 13*root]/1800
        integer, parameter :: parts = 16
        integer :: part, g

        total = 0.0_qp
        do part = 1, parts
            do g = 1, size(point)
                xi = (part - 0.5_qp + point(g)/2)/parts
                call curved_fields(curved, xi, w, psi, moment, shear)
                total = total + weight(g)*(slope(1) + (slope(2) - slope(1))*xi)*w
            end do
        end do
        total = total*length/parts
    end function integral_on_curves

    !> Load of a stretch for the deflection beside a line: less what the ground takes of the line
    pure function beside_line(stretch, load, line) result(found)
        type(fine_stretch_type), intent(in) :: stretch
        type(fine_stretch_load_type), intent(in) :: load
        !> At the two ends
        real(qp), intent(in) :: line(2)
        type(fine_stretch_load_type) :: found

        found = load
        if (.not. max(abs(stretch%modulus_a), abs(stretch%modulus_b), abs(stretch%tension_change)) > 0.0_qp) return
        ! Where it slopes, an axial force that changes pulls
        found%qa = difference(load%qa + stretch%tension_change*(line(2) - line(1))/stretch%length**2, stretch%modulus_a*line(1))
        found%qb = difference(load%qb + stretch%tension_change*(line(2) - line(1))/stretch%length**2, stretch%modulus_b*line(2))
        found%qc = difference(load%qc, -(stretch%modulus_b - stretch%modulus_a)*(line(2) - line(1)))
    end function beside_line

    !> A difference; where nothing but rounding is left of it, 0
    elemental function difference(a, b) result(found)
        real(qp), intent(in) :: a, b
        real(qp) :: found

        found = a - b
        if (abs(found) <= fine_rounding*(abs(a) + abs(b))) found = 0.0_qp
    end function difference

end module gapbeam_ground_solution
