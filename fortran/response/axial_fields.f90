!> Axial force and displacement between the nodes of the axial system.
module gapbeam_axial_fields
    use gapbeam_kinds, only: wp, qp
    use gapbeam_assembled_model, only: assembled_type, point_x, piece_length, along_axis
    use gapbeam_piece_stiffness, only: stiffness_along
    use gapbeam_taper, only: mean_softness
    use gapbeam_assemble_axial, only: axial_node
    use gapbeam_ground_along, only: ground_along_type, length_of, force_in
    use gapbeam_exponential_curve, only: most_roots, value_of, derivative, roots_of
    use gapbeam_axial_bedding, only: bedding_type, pulling, force_at
    implicit none
    private
    public :: axial_fields, extremes_along

contains

    !> Normal force and displacement along the axis in units of the axial system; zero without one
    pure subroutine axial_fields(assembled, factor, displacements, tensions, piece, distance, tension, displacement, ground)
        type(assembled_type), intent(in) :: assembled
        !> Factor of the live loads; displacements of the nodes, shape (0:n), and tensions in the middles of the bars, shape (n)
        real(wp), intent(in) :: factor, displacements(0:), tensions(:)
        !> The place: piece, and distance from its left end in the user's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        !> To the right
        real(wp), intent(out) :: tension, displacement
        !> On ground along the beam, where tensions are the smallest of the bars
        type(ground_along_type), intent(in), optional :: ground
        real(wp) :: way, share, spread, EA, EA_to
        integer :: bar, power

        tension = 0.0_wp
        displacement = 0.0_wp
        if (.not. allocated(assembled%axial%point)) return
        bar = axial_node(assembled%axial%point, piece)
        share = distance/piece_length(assembled, piece)
        if (present(ground)) then
            if (allocated(ground%springs)) then
                call fields_on_springs(ground%springs, cell_at(ground%springs, bar, real(share, qp)), real(share, qp), tension, &
                                       displacement)
            else
                call fields_on_ground(ground, bar, share, tension, displacement)
            end if
            return
        end if
        way = share
        call stiffness_along(assembled, piece, along_axis, EA, EA_to, power)
        if (power > 0 .and. share > 0.0_wp) way = share*mean_softness(1.0_wp, EA/EA_to, power, share) &
            /mean_softness(1.0_wp, EA/EA_to, power, 1.0_wp)
        tension = tensions(bar)
        if (allocated(assembled%axial%elongation)) then
            ! Every piece is a bar: what is not elastic is the same all along
            displacement = displacements(bar - 1) + (displacements(bar) - displacements(bar - 1))*share &
                + tension*assembled%axial%softness(piece)*(way - share)
        else
            displacement = displacements(bar - 1) + tension*(assembled%axial%before(piece) + assembled%axial%softness(piece)*way)
        end if
        if (.not. allocated(assembled%axial%along_bar)) return
        spread = load_along(assembled, factor, bar)
        tension = tension + spread*(0.5_wp - share)
        displacement = displacement + spread*assembled%axial%softness(piece)*share*(1.0_wp - share)/2
    end subroutine axial_fields

    !> Force of the loads that are distributed along a bar, to the right
    pure function load_along(assembled, factor, bar) result(force)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor
        integer, intent(in) :: bar
        real(wp) :: force

        force = assembled%axial%along_bar(1, bar) + factor*assembled%axial%along_bar(2, bar)
    end function load_along

    !> Extremes along the beam where loads are distributed along it: the axial force is linear in every bar, the displacement of
    !> degree 2
    pure subroutine extremes_along(assembled, factor, displacement, tension, value, x, ground)
        !> As for axial_fields
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor, displacement(0:), tension(:)
        !> Maximum and minimum of force and displacement in, of the nodes and of the middles of bars, and their places
        real(wp), intent(inout) :: value(2, 2), x(2, 2)
        type(ground_along_type), intent(in), optional :: ground
        real(wp) :: share
        integer :: j, k

        if (present(ground)) then
            ! Of what comes from the nodes nothing stays: they have other values than bars
            value(1, :) = -huge(share)
            value(2, :) = huge(share)
            if (allocated(ground%springs)) then
                do k = 1, size(ground%springs%cells)
                    call look_in_cell(ground%springs, k, value, x)
                end do
                return
            end if
            do k = 1, size(ground%parts)
                call look(ground%parts(k)%bar, ground%parts(k)%to - length_of(ground, k), k, value, x)
                call look(ground%parts(k)%bar, top_in_part(ground, k), k, value, x)
                call look(ground%parts(k)%bar, ground%parts(k)%to, k, value, x)
            end do
            return
        end if
        do j = 1, size(tension)
            do k = 0, 2
                share = real(k, wp)/2
                if (k == 1) share = top_in_bar(load_along(assembled, factor, j), assembled%axial%softness(j), &
                                               displacement(j) - displacement(j - 1))
                call look(j, share, 0, value, x)
            end do
        end do

    contains

        !> Values at the ends of a cell on springs, and where force and displacement turn inside it
        pure subroutine look_in_cell(bedding, k, value, x)
            type(bedding_type), intent(in) :: bedding
            integer, intent(in) :: k
            real(wp), intent(inout) :: value(2, 2), x(2, 2)
            real(qp) :: of_force(most_roots), of_displacement(most_roots)
            integer :: i, m, n

            associate (cell => bedding%cells(k))
                call roots_of(derivative(pulling(bedding, cell)), of_force, m)
                call roots_of(derivative(cell%displacement), of_displacement, n)
                associate (at => [cell%from, cell%to, of_force(:m), of_displacement(:n)])
                    do i = 1, size(at)
                        call look(cell%bar, real(at(i), wp), -k, value, x)
                    end do
                end associate
            end associate
        end subroutine look_in_cell

        !> Values at a place
        pure subroutine look(bar, share, part, value, x)
            !> The part at the place, below 0: the cell, 0: there is no such ground
            integer, intent(in) :: bar, part
            real(wp), intent(in) :: share
            real(wp), intent(inout) :: value(2, 2), x(2, 2)
            real(wp) :: found(2), at

            at = point_x(assembled, bar - 1) + share*piece_length(assembled, bar)
            if (part < 0) then
                call fields_on_springs(ground%springs, -part, real(share, qp), found(1), found(2))
            else if (part > 0) then
                call fields_on_ground(ground, bar, share, found(1), found(2), part)
            else
                call axial_fields(assembled, factor, displacement, tension, bar, share*piece_length(assembled, bar), found(1), &
                                  found(2))
            end if
            where (found > value(1, :))
                value(1, :) = found
                x(1, :) = at
            end where
            where (found < value(2, :))
                value(2, :) = found
                x(2, :) = at
            end where
        end subroutine look

    end subroutine extremes_along

    !> The cell of a bar on springs along the beam at a share of it
    pure function cell_at(bedding, bar, share) result(k)
        type(bedding_type), intent(in) :: bedding
        integer, intent(in) :: bar
        real(qp), intent(in) :: share
        integer :: k

        k = axial_node(bedding%cells%bar, bar) + 1
        do while (k < size(bedding%cells))
            if (bedding%cells(k)%to >= share .or. bedding%cells(k + 1)%bar /= bar) exit
            k = k + 1
        end do
    end function cell_at

    !> Axial force and displacement in a cell on springs along the beam
    pure subroutine fields_on_springs(bedding, k, share, tension, displacement)
        type(bedding_type), intent(in) :: bedding
        integer, intent(in) :: k
        !> Of the bar, from its left end
        real(qp), intent(in) :: share
        real(wp), intent(out) :: tension, displacement

        tension = real(force_at(bedding, bedding%cells(k), share), wp)
        displacement = real(value_of(bedding%cells(k)%displacement, share), wp)
    end subroutine fields_on_springs

    !> Axial force and displacement in a bar on ground along the beam
    pure subroutine fields_on_ground(ground, bar, share, tension, displacement, part)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: bar
        !> Of the bar, from its left end
        real(wp), intent(in) :: share
        real(wp), intent(out) :: tension, displacement
        !> The part at the place, where that is known
        integer, intent(in), optional :: part
        real(wp) :: from, to
        integer :: k

        displacement = ground%displacement(bar - 1) + share*ground%longer(bar)
        from = 0.0_wp
        do k = axial_node(ground%parts%bar, bar) + 1, size(ground%parts)
            associate (p => ground%parts(k))
                to = min(share, p%to)
                tension = force_in(ground, k, share)
                displacement = displacement + (to - from)*ground%softness(bar)*force_in(ground, k, (from + to)/2)
                from = to
                if (present(part)) then
                    if (k == part) return
                else if (p%to >= share) then
                    return
                end if
            end associate
        end do
    end subroutine fields_on_ground

    !> Where the displacement in a part may have an extreme, as a share of the bar; at its right end where there is none inside
    pure function top_in_part(ground, k) result(share)
        type(ground_along_type), intent(in) :: ground
        integer, intent(in) :: k
        real(wp) :: share, inside

        associate (part => ground%parts(k), j => ground%parts(k)%bar)
            share = part%to
            if (part%slope == 0 .or. .not. ground%limit(j) > 0.0_wp) return
            inside = -(part%force + ground%longer(j)/ground%softness(j))/(part%slope*ground%limit(j))
            if (inside > part%to - length_of(ground, k) .and. inside < part%to) share = inside
        end associate
    end function top_in_part

    !> Where the displacement along a bar may have an extreme, as a share of the bar; at its left end where there is none inside
    elemental function top_in_bar(force, softness, elongation) result(share)
        !> Of the load on the bar, length/EA, and how much longer it has become
        real(wp), intent(in) :: force, softness, elongation
        real(wp) :: share

        share = 0.0_wp
        if (abs(elongation) < abs(force*softness)/2) share = 0.5_wp + elongation/(force*softness)
    end function top_in_bar

end module gapbeam_axial_fields
