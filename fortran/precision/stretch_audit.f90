!> Audit of a stretch of a beam on the ground by the integrated equations of the beam.
!> Its fields, asked for as users ask, are put into the equations, psi' = kappa - M/EI, w' = psi + V/GA, M' = V = T - N w', T' =
!> pressure - load, and these are integrated from end to end. The pressure is what the laws make of the deflection, the load is that
!> of the model; nothing of how the stretch was solved is used.
module gapbeam_stretch_audit
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type
    use gapbeam_piece, only: is_tapered, greatest_softness, curvature_at
    use gapbeam_taper, only: part_of_piece, softness_at
    use gapbeam_layers, only: pieces_of_law, is_curve
    use gapbeam_ground_laws, only: along, distance_to_breakpoint, push_of_layer
    use gapbeam_curved, only: curved_type, advance_curved
    use gapbeam_link, only: piece_load_type, combine_loads
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_foundation_stretch, only: tension_at, greatest_tension
    use gapbeam_foundation_taylor, only: trace_of, determinant_of
    use gapbeam_ground_fields, only: inside_type, prepare_inside, field_at_end, force_at_end, field_inside, moment_inside, &
        curved_stretch, breakpoint_terms, pressure_terms
    use gapbeam_quadrature, only: panels_type, cut_into_panels, points_of, most_points
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_resultants, of_contact, deflections, rotations, &
        moments, forces, beyond, pulls
    implicit none
    private
    public :: sums_type, audit_stretch, rates_of, least_rate

    !> Samples of stretches in which ground acts by curves: their series are taken from end to end, not integrated by points
    integer, parameter :: samples = 3

    !> Rate at which a stretch is integrated at least that tapers, or along which the axial force changes; or squares of its slopes
    real(wp), parameter :: least_rate = 4.0_wp

    !> Forces on a stretch, ground and loads, in sum
    type :: sums_type
        !> Up, and their moment about the right end; the sizes of the terms
        real(wp) :: force = 0.0_wp, moment = 0.0_wp, force_size = 0.0_wp, moment_size = 0.0_wp
    end type sums_type

    !> A place at which the state of a layer was looked at: how far it is from the lines at which its piece of the law begins and
    !> ends, positive on the right side, and how that changes along the stretch
    type :: link_bounds_type
        real(wp) :: xi = 0.0_wp, away(2) = 0.0_wp, change(2) = 0.0_wp
    end type link_bounds_type

contains

    !> Audit a stretch
    subroutine audit_stretch(ground, factor, solution, i, sizes, least, ledger, sums)
        !> The beam and its ground, and the load factor
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        !> The solution, and the number of the stretch
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        !> By find_sizes
        type(field_type), intent(in) :: sizes, least
        type(ledger_type), intent(inout) :: ledger
        !> What it adds up to
        type(sums_type), intent(out) :: sums
        type(link_bounds_type) :: last(size(solution%acts, 1))
        type(inside_type) :: inside
        type(piece_load_type) :: load
        type(field_type) :: left, right
        real(wp) :: force(size(solution%acts, 1)), terms(size(solution%acts, 1)), bent(2), pressed(2), wsize, msize, qsize, &
            imposed, push(2), pull, soft(2)
        !> What rounding of the places of its ends makes of its deflection, in roundings
        real(wp) :: displaced
        !> int V/GA over the length where GA changes
        real(wp) :: slid
        !> int N w' over the length where N changes
        real(wp) :: pulled
        integer :: n
        logical :: curves

        associate (j => solution%piece(i), s => solution%stretches(i))
            soft(:) = greatest_softness(part_of_piece(ground%pieces(j), solution%from(i), solution%to(i)))
            associate (layers => ground%layers(ground%first(j):ground%first(j + 1) - 1), l => s%length, f => soft(1), g => soft(2))
                n = size(layers)
                force(:) = 0.0_wp
                load = combine_loads(ground%dead(j), ground%live(j), factor)
                left = field_at_end(solution, i, 1)
                right = field_at_end(solution, i, 2)
                push = [force_at_end(solution, i, 1), force_at_end(solution, i, 2)]
                pull = s%tension*(right%deflection - left%deflection)
                wsize = sizes%deflection
                displaced = ground%pieces(j)%length*max(abs(left%rotation), abs(right%rotation))
                msize = sizes%moment
                call take_sizes()
                curves = any(is_curve(layers, solution%acts(:n, i)))
                call check_layers(0.0_wp, left, .true.)
                if (curves) then
                    call go_along_curves()
                else
                    call prepare_inside(layers, ground%laws, ground%pieces(j)%length, solution, i, inside, roughly=.true., &
                                        without_forces=.true.)
                    call integrate()
                    if (abs(s%tension_change) > 0.0_wp) pull = l*pulled
                    call fits(of_bending, rotations, (right%rotation - left%rotation) - l*bent(1), &
                              abs(right%rotation) + abs(left%rotation) + l*(f*msize + imposed))
                    call fits(of_bending, deflections, (right%deflection - left%deflection) - l*(left%rotation + l*bent(2)) &
                              - merge(l*slid, g*(right%moment - left%moment), ground%pieces(j)%shear_power > 0), &
                              wsize + l*(abs(left%rotation) + l*(f*msize + imposed)) &
                              + g*(abs(right%moment) + abs(left%moment)))
                    call fits(of_equilibrium, forces, (push(2) - push(1)) - l*pressed(1), sum(abs(push)) + sizes%shear &
                              + l*(sum(terms(:n)) + qsize))
                    call fits(of_equilibrium, moments, (right%moment - left%moment) + pull - l*(push(1) + l*pressed(2)), &
                              abs(right%moment) + abs(left%moment) + l*(sizes%shear + abs(push(1)) + l*(sum(terms(:n)) + qsize)))
                    sums%moment = l**2*pressed(2) - pull
                end if
                call check_layers(1.0_wp, right, .true.)
                call audit_resultants()
            end associate
        end associate

    contains

        !> Note what an equation of the stretch leaves over
        subroutine fits(what, kind, left_over, terms_of_it)
            integer, intent(in) :: what, kind
            real(wp), intent(in) :: left_over, terms_of_it
            real(wp) :: terms_of_all

            select case (kind)
            case (deflections)
                terms_of_all = terms_of_it + least%deflection
            case (rotations)
                terms_of_all = terms_of_it + least%rotation
            case (moments)
                terms_of_all = terms_of_it + least%moment
            case (forces)
                terms_of_all = terms_of_it + least%shear
            case default
                terms_of_all = terms_of_it
            end select
            call note(ledger, what, kind, left_over, terms_of_all, solution%piece(i), solution%from(i))
        end subroutine fits

        !> Sizes of what loads, imposed curvatures and the pressures of the layers are made of
        subroutine take_sizes()
            integer :: k

            associate (j => solution%piece(i))
                qsize = abs(ground%dead(j)%qa) + abs(ground%dead(j)%qb) + abs(factor)*(abs(ground%live(j)%qa) &
                                                                                      + abs(ground%live(j)%qb))
                imposed = abs(ground%dead(j)%kappa) + abs(ground%dead(j)%rise) + abs(factor)*(abs(ground%live(j)%kappa) &
                                                                                             + abs(ground%live(j)%rise))
                terms(:) = 0.0_wp
                do k = 1, n
                    terms(k) = pressure_terms(ground%layers(ground%first(j) + k - 1), ground%laws, solution%acts(k, i), wsize)
                    if (ground%layers(ground%first(j) + k - 1)%rigid .and. solution%acts(k, i) > 0) terms(k) = qsize
                end do
            end associate
        end subroutine take_sizes

        !> Integrals over a stretch of linear ground, in parts of its length: of curvature and of pressure less load, by themselves
        !> and times the distance from the right end; and of the pressures of the layers
        subroutine integrate()
            type(panels_type) :: panels
            type(field_type) :: field
            real(wp) :: points(most_points), weights(most_points), rate(2), fade(2), q, place, push, total, curvature, here(2)
            integer :: p, k, t, number
            !> Without ground, and where nothing changes along the stretch, the equations feel the moment only
            logical :: moment_alone

            moment_alone = n == 0
            call rates_of(solution, i, rate, fade)
            ! On a step of a taper the depth would vanish four steps away: ten points leave less than rounding of that, and of what
            ! an axial force that changes makes
            if (is_tapered(ground%pieces(solution%piece(i))) .or. abs(solution%stretches(i)%tension_change) > 0.0_wp) then
                rate = max(rate, least_rate)
                moment_alone = .false.
            end if
            call cut_into_panels(rate, fade, panels)
            bent = 0.0_wp
            slid = 0.0_wp
            pulled = 0.0_wp
            pressed = 0.0_wp
            here(:) = soft
            associate (j => solution%piece(i))
                do p = 1, panels%number
                    call points_of(panels, p, number, points, weights)
                    do t = 1, number
                        if (moment_alone) then
                            field = field_type(0.0_wp, 0.0_wp, moment_inside(inside, points(t)), 0.0_wp)
                        else
                            call field_inside(inside, points(t), field)
                        end if
                        call check_layers(points(t), field, .false.)
                        place = along(solution%from(i), solution%to(i), points(t), 1.0_wp)
                        q = along(load%qa, load%qb, place, ground%pieces(j)%length)
                        total = -q
                        do k = 1, n
                            if (solution%acts(k, i) == 0) cycle
                            associate (layer => ground%layers(ground%first(j) + k - 1))
                                push = push_of_layer(layer, ground%laws, solution%acts(k, i), place, ground%pieces(j)%length, &
                                                     field%deflection)
                                if (layer%rigid) push = along(solution%pressure(1, i), solution%pressure(2, i), points(t), 1.0_wp)
                                if (layer%rigid .and. layer%side*push < 0.0_wp) call note(ledger, of_contact, pulls, push, &
                                                                                          terms(k), j, place)
                            end associate
                            force(k) = force(k) + weights(t)*push
                            total = total + push
                        end do
                        if (is_tapered(ground%pieces(j))) here(:) = softness_at(ground%pieces(j), place)
                        curvature = curvature_at(load, place, ground%pieces(j)%length) - here(1)*field%moment
                        slid = slid + weights(t)*here(2)*field%shear
                        pulled = pulled + weights(t)*tension_at(solution%stretches(i), points(t))*field%rotation
                        bent = bent + weights(t)*curvature*[1.0_wp, 1 - points(t)]
                        pressed = pressed + weights(t)*total*[1.0_wp, 1 - points(t)]
                    end do
                end do
            end associate
            force(:n) = solution%stretches(i)%length*force(:n)
        end subroutine integrate

        !> Where ground acts by curves, the equations are followed from the left end to the right one by their series
        subroutine go_along_curves()
            type(curved_type), allocatable :: curved
            type(field_type) :: field
            real(wp) :: y(4), slope, here(2)
            real(wp), allocatable :: by_curves(:)
            logical :: lost
            integer :: k, t, c

            associate (j => solution%piece(i), s => solution%stretches(i))
                associate (layers => ground%layers(ground%first(j):ground%first(j + 1) - 1), l => s%length)
                    call curved_stretch(layers, ground%laws, ground%pieces(j)%length, solution, i, curved)
                    allocate (by_curves(size(curved%curves)))
                    call advance_curved(curved, 0.0_wp, curved%left, 1.0_wp, y, lost, forces=by_curves)
                    if (lost) then
                        call fits(of_equilibrium, 0, huge(1.0_wp), 0.0_wp)
                        return
                    end if
                    here(:) = softness_at(ground%pieces(j), solution%to(i))
                    y(1) = y(1) + here(2)*y(3)
                    slope = abs(left%rotation) + abs(soft(2)*left%shear)
                    call fits(of_bending, deflections, right%deflection - y(1), wsize + l*(slope &
                              + l*(soft(1)*msize + imposed)))
                    call fits(of_bending, rotations, right%rotation - y(2), abs(right%rotation) + slope &
                              + l*(soft(1)*msize + imposed))
                    call fits(of_equilibrium, moments, right%moment - y(3), msize + l*(abs(left%shear) + l*(sum(terms) + qsize)))
                    call fits(of_equilibrium, forces, right%shear - y(4), abs(left%shear) + abs(right%shear) &
                              + l*(sum(terms) + qsize))
                    sums%moment = y(3) - left%moment - l*push(1)
                    c = 0
                    do k = 1, n
                        force(k) = solution%resultant(k, i)
                        if (.not. is_curve(layers(k), solution%acts(k, i))) cycle
                        c = c + 1
                        force(k) = layers(k)%side*by_curves(c)
                    end do
                    call prepare_inside(layers, ground%laws, ground%pieces(j)%length, solution, i, inside)
                    do t = 1, samples
                        call field_inside(inside, t/(samples + 1.0_wp), field)
                        call check_layers(t/(samples + 1.0_wp), field, .false.)
                    end do
                end associate
            end associate
        end subroutine go_along_curves

        !> Do the pressures add up to the resultants, and these with the loads to what the shear gains
        subroutine audit_resultants()
            real(wp) :: q
            integer :: k

            associate (j => solution%piece(i), l => solution%stretches(i)%length, r => solution%resultant(:, i))
                q = l*(along(load%qa, load%qb, solution%from(i), ground%pieces(j)%length) &
                       + along(load%qa, load%qb, solution%to(i), ground%pieces(j)%length))/2
                do k = 1, n
                    if (solution%acts(k, i) == 0) force(k) = 0.0_wp
                    call fits(of_resultants, forces, r(k) - force(k), abs(r(k)) + l*terms(k))
                end do
                sums%force = sum(r(:n)) - q
                sums%force_size = sum(abs(r(:n))) + l*(sum(terms(:n)) + qsize)
                sums%moment_size = l*sums%force_size + abs(greatest_tension(solution%stretches(i)))*wsize
                call fits(of_equilibrium, forces, (push(2) - push(1)) - sums%force, sum(abs(push)) + sizes%shear + sums%force_size)
            end associate
        end subroutine audit_resultants

        !> Is every layer that acts one way in the right state at a place, and at the place since the last one where the beam comes
        !> nearest to a line at which the state would change
        subroutine check_layers(xi, field, at_end)
            real(wp), intent(in) :: xi
            type(field_type), intent(in) :: field
            logical, intent(in) :: at_end
            type(field_type) :: nearest
            type(link_bounds_type) :: now
            real(wp) :: t
            integer :: k, side

            do k = 1, n
                if (ground%layers(ground%first(solution%piece(i)) + k - 1)%side == 0) cycle
                call check_layer(k, xi, field, at_end, now)
                if (xi > 0.0_wp .and. .not. curves) then
                    do side = 1, 2
                        if (.not. (last(k)%change(side) < 0.0_wp .and. now%change(side) > 0.0_wp)) cycle
                        t = lowest(last(k)%away(side), now%away(side), last(k)%change(side)*(xi - last(k)%xi), &
                                   now%change(side)*(xi - last(k)%xi))
                        t = last(k)%xi + t*(xi - last(k)%xi)
                        if (.not. (t > 0.0_wp .and. t < 1.0_wp)) cycle
                        call field_inside(inside, t, nearest)
                        call check_layer(k, t, nearest, .false.)
                    end do
                end if
                last(k) = now
            end do
        end subroutine check_layers

        !> Is a layer in the right state at a place
        subroutine check_layer(k, xi, field, at_end, found)
            !> Its number among those of the piece
            integer, intent(in) :: k
            real(wp), intent(in) :: xi
            type(field_type), intent(in) :: field
            logical, intent(in) :: at_end
            type(link_bounds_type), intent(out), optional :: found
            real(wp) :: place, steepness, terms_of_it, incline, past, change, here(2)
            type(link_bounds_type) :: now
            integer :: side, breakpoint

            now%xi = xi
            associate (j => solution%piece(i), s => solution%stretches(i))
                place = along(solution%from(i), solution%to(i), xi, 1.0_wp)
                here(:) = softness_at(ground%pieces(j), place)
                incline = field%rotation + here(2)*field%shear
                associate (layer => ground%layers(ground%first(j) + k - 1))
                    do side = 1, 2
                        breakpoint = solution%acts(k, i) + side - 1
                        if (breakpoint < 1 .or. breakpoint > pieces_of_law(layer)) cycle
                        call distance_to_breakpoint(ground%laws, layer, breakpoint, field%deflection, incline, place, &
                                                    ground%pieces(j)%length, past, change)
                        now%away(side) = merge(past, -past, side == 1)
                        now%change(side) = merge(change, -change, side == 1)*s%length
                        ! In a zone on rigid ground the beam is not past the ground either
                        if (now%away(side) >= 0.0_wp .and. .not. (layer%rigid .and. side == 1)) cycle
                        call breakpoint_terms(layer, ground%laws, breakpoint, wsize, steepness, terms_of_it)
                        terms_of_it = terms_of_it + least%deflection + merge(ground%pieces(j)%length*abs(change), displaced, at_end)
                        if (steepness > 0.0_wp) then
                            call note(ledger, of_contact, beyond, now%away(side)/steepness, terms_of_it/steepness, j, place)
                        else
                            call note(ledger, of_contact, 0, now%away(side), terms_of_it, j, place)
                        end if
                    end do
                end associate
            end associate
            if (present(found)) found = now
        end subroutine check_layer

    end subroutine audit_stretch

    !> Rates at which fields grow or fade along a stretch, and how they fade
    pure subroutine rates_of(solution, i, rate, fade)
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        real(wp), intent(out) :: rate(2), fade(2)
        real(wp) :: k, sigma, root, mean, half

        associate (s => solution%stretches(i))
            k = max(s%modulus_a, s%modulus_b)
            sigma = abs(trace_of(s, k))*s%length**2
            root = sqrt(determinant_of(s, k))*s%length**2
            mean = sqrt(sigma + 2*root)/2
            half = sqrt(max(0.0_wp, sigma - 2*root))/2
            if (half > 0.0_wp) then
                rate = [mean + half, root/(mean + half)]
                fade = rate
            else
                rate = sqrt(root)
                fade = mean
            end if
        end associate
    end subroutine rates_of

    !> Where between 0 and 1 the cubic with these values and slopes at both ends, falling first and then rising, is lowest
    pure function lowest(value_a, value_b, slope_a, slope_b) result(t)
        real(wp), intent(in) :: value_a, value_b, slope_a, slope_b
        real(wp) :: t, z, root

        z = slope_a + slope_b - 3*(value_b - value_a)
        root = sqrt(max(0.0_wp, z**2 - slope_a*slope_b))
        t = min(1.0_wp, max(0.0_wp, 1 - (slope_b + root - z)/max(slope_b - slope_a + 2*root, tiny(t))))
    end function lowest

end module gapbeam_stretch_audit
