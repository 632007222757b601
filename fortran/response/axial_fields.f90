!> Axial force and displacement between the nodes of the axial system.
module gapbeam_axial_fields
    use gapbeam_kinds, only: wp
    use gapbeam_assembled_model, only: assembled_type, point_x, piece_length, along_axis
    use gapbeam_piece_stiffness, only: stiffness_along
    use gapbeam_taper, only: mean_softness
    use gapbeam_assemble_axial, only: axial_node
    implicit none
    private
    public :: axial_fields, extremes_along

contains

    !> Normal force and displacement along the axis in units of the axial system; zero without one
    pure subroutine axial_fields(assembled, factor, displacements, tensions, piece, distance, tension, displacement)
        type(assembled_type), intent(in) :: assembled
        !> Factor of the live loads; displacements of the nodes, shape (0:n), and tensions in the middles of the bars, shape (n)
        real(wp), intent(in) :: factor, displacements(0:), tensions(:)
        !> The place: piece, and distance from its left end in the user's units
        integer, intent(in) :: piece
        real(wp), intent(in) :: distance
        !> To the right
        real(wp), intent(out) :: tension, displacement
        real(wp) :: way, share, spread, EA, EA_to
        integer :: bar, power

        tension = 0.0_wp
        displacement = 0.0_wp
        if (.not. allocated(assembled%axial%point)) return
        bar = axial_node(assembled%axial%point, piece)
        share = distance/piece_length(assembled, piece)
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
    pure subroutine extremes_along(assembled, factor, displacement, tension, value, x)
        !> As for axial_fields
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor, displacement(0:), tension(:)
        !> Maximum and minimum of force and displacement in, of the nodes and of the middles of bars, and their places
        real(wp), intent(inout) :: value(2, 2), x(2, 2)
        real(wp) :: share, found(2)
        integer :: j, k

        do j = 1, size(tension)
            do k = 0, 2
                share = real(k, wp)/2
                if (k == 1) share = top_in_bar(load_along(assembled, factor, j), assembled%axial%softness(j), &
                                               displacement(j) - displacement(j - 1))
                call axial_fields(assembled, factor, displacement, tension, j, share*piece_length(assembled, j), found(1), found(2))
                where (found > value(1, :))
                    value(1, :) = found
                    x(1, :) = point_x(assembled, j - 1) + share*piece_length(assembled, j)
                end where
                where (found < value(2, :))
                    value(2, :) = found
                    x(2, :) = point_x(assembled, j - 1) + share*piece_length(assembled, j)
                end where
            end do
        end do
    end subroutine extremes_along

    !> Where the displacement along a bar may have an extreme, as a share of the bar; at its left end where there is none inside
    elemental function top_in_bar(force, softness, elongation) result(share)
        !> Of the load on the bar, length/EA, and how much longer it has become
        real(wp), intent(in) :: force, softness, elongation
        real(wp) :: share

        share = 0.0_wp
        if (abs(elongation) < abs(force*softness)/2) share = 0.5_wp + elongation/(force*softness)
    end function top_in_bar

end module gapbeam_axial_fields
