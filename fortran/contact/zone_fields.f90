!> Fields of a beam solved on its zones of contact, at the ends of stretches and inside those on curves.
module gapbeam_zone_fields
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: straight_field
    use gapbeam_foundation_stretch, only: without_slip
    use gapbeam_foundation_taylor, only: shear_of
    use gapbeam_foundation, only: stretch_ends_type
    use gapbeam_curved, only: curved_type
    use gapbeam_layers, only: is_curve, has_curves
    use gapbeam_ground_laws, only: take_curves
    use gapbeam_workspace, only: workspace_type
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_stretch_loads, only: combined_load
    implicit none
    private
    public :: ends_of, fields_at_ends, take_curved, take_fields, way_of_fields

contains

    !> Rotations and shears at the two ends of a stretch of a solved beam, inside what is imposed there
    pure subroutine fields_at_ends(grounded, factor, work, i, rotation, shear)
        type(grounded_type), intent(in) :: grounded
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Number of the stretch
        integer, intent(in) :: i
        real(wp), intent(out) :: rotation(2), shear(2)
        real(wp) :: transverse(2)

        associate (a => work%answers(i - 1), b => work%answers(i), g => grounded%beam%ground(i), link => grounded%beam%links(i))
            rotation(1) = -g%pa*a%deflection + g%p1*b%deflection + g%faa*a%moment_right + g%fab*b%moment_left &
                + (link%turn_a(1) + factor*link%turn_a(2))
            rotation(2) = g%pb*b%deflection - g%p2*a%deflection - g%fab*a%moment_right - g%fbb*b%moment_left &
                - (link%turn_b(1) + factor*link%turn_b(2))
            transverse(1) = -g%pa*a%moment_right + g%p2*b%moment_left - g%gaa*a%deflection - g%gab*b%deflection &
                + (link%shear_a(1) + factor*link%shear_a(2))
            transverse(2) = g%pb*b%moment_left - g%p1*a%moment_right + g%gbb*b%deflection + g%gab*a%deflection &
                + (link%shear_b(1) + factor*link%shear_b(2))
        end associate
        associate (dead => grounded%dead(i), live => grounded%live(i))
            rotation = rotation + [dead%kink_a + factor*live%kink_a, -(dead%kink_b + factor*live%kink_b)]
        end associate
        shear = shear_of(grounded%stretches(i), [0.0_wp, 1.0_wp], rotation, transverse)
    end subroutine fields_at_ends

    !> Values at the ends of a stretch of a solved beam, inside couples there
    pure function ends_of(grounded, factor, work, i) result(ends)
        type(grounded_type), intent(in) :: grounded
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Number of the stretch
        integer, intent(in) :: i
        type(stretch_ends_type) :: ends

        associate (a => work%answers(i - 1), b => work%answers(i), dead => grounded%dead(i), live => grounded%live(i))
            ends = stretch_ends_type(a%deflection, b%deflection, a%moment_right + (dead%couple_a + factor*live%couple_a), &
                                     b%moment_left - (dead%couple_b + factor*live%couple_b))
        end associate
    end function ends_of

    !> A stretch of a solved beam on which ground acts by curves
    pure subroutine take_curved(ground, grounded, zones, factor, work, i, curved)
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Number of the stretch
        integer, intent(in) :: i
        !> Not allocated if the ground is linear there
        type(curved_type), allocatable, intent(out) :: curved
        real(wp) :: rotation(2), shear(2)

        associate (j => zones%piece(i), s => grounded%stretches(i))
            associate (layers => ground%layers(ground%first(j):ground%first(j + 1) - 1))
                if (.not. any(is_curve(layers, zones%acts(:size(layers), i)))) return
                allocate (curved)
                call take_curves(layers, ground%laws, zones%acts(:, i), zones%from(i), zones%to(i), ground%pieces(j)%length, &
                                 curved%curves)
            end associate
            call fields_at_ends(grounded, factor, work, i, rotation, shear)
            curved%stretch = s
            curved%load = combined_load(grounded%dead(i), grounded%live(i), factor)
            associate (at => ends_of(grounded, factor, work, i))
                curved%left = [without_slip(s, 0.0_wp, at%w_a, at%moment_a), rotation(1), at%moment_a, shear(1)]
                curved%right = [without_slip(s, 1.0_wp, at%w_b, at%moment_b), rotation(2), at%moment_b, shear(2)]
            end associate
        end associate
    end subroutine take_curved

    !> Fields (v, psi, M, V) at the left ends of all stretches of a solved beam, those of short ones as the one before ends
    pure subroutine take_fields(grounded, zones, factor, work, fields)
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> Shape (4, m)
        real(wp), intent(inout) :: fields(:, :)
        real(wp) :: rotation(2), shear(2)
        integer :: i
        logical :: from_right

        do i = 1, size(zones%piece)
            from_right = i > 1
            if (from_right) from_right = zones%piece(i - 1) == zones%piece(i) &
                .and. grounded%stretches(i - 1)%length > grounded%stretches(i)%length
            call fields_at_ends(grounded, factor, work, merge(i - 1, i, from_right), rotation, shear)
            associate (at => ends_of(grounded, factor, work, i), s => grounded%stretches(i), end => merge(2, 1, from_right))
                fields(:, i) = [without_slip(s, 0.0_wp, at%w_a, at%moment_a), rotation(end), at%moment_a, shear(end)]
            end associate
        end do
    end subroutine take_fields

    !> How far the fields near which curves are taken for straight have moved, relative to the greatest of their kind, or to what
    !> the ground makes of the deflections
    pure function way_of_fields(ground, grounded, zones, found) result(way)
        type(ground_type), intent(in) :: ground
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones, found
        real(wp) :: way, most(4)
        integer :: i, k

        way = 0.0_wp
        if (.not. any(has_curves(ground%layers))) return
        if (size(zones%piece) /= size(found%piece)) then
            way = huge(way)
            return
        end if
        most = maxval(abs(found%start), 2)
        do i = 1, size(found%piece)
            associate (g => grounded%beam%ground(i), w => abs(found%start(1, i)))
                most(2:) = max(most(2:), w*[g%pa, g%gaa/g%pa, g%gaa])
            end associate
        end do
        do k = 1, 4
            if (most(k) > 0.0_wp) way = max(way, maxval(abs(found%start(k, :) - zones%start(k, :)))/most(k))
        end do
        ! What they move by now, the solution moves by the square of it in the next round
        if (way <= straight_field) way = 0.0_wp
    end function way_of_fields

end module gapbeam_zone_fields
