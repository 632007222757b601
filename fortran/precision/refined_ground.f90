!> The ground under a beam and its zones in quadruple precision
module gapbeam_refined_ground
    use gapbeam_kinds, only: wp, qp
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_foundation_quad, only: fine_stretch_type => stretch_type, fine_stretch_load_type => stretch_load_type, &
        fine_ends_type => stretch_ends_type
    use gapbeam_layers, only: layer_type, law_piece_type
    use gapbeam_layers_quad, only: fine_layer_type => layer_type, fine_law_piece_type => law_piece_type
    use gapbeam_ground, only: ground_type, zones_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type, new_zones
    use gapbeam_refined, only: detail_type, refine_beam, condense_again, fine_piece, fine_load
    implicit none
    private
    public :: refine_ground, refine_links, refine_zones, rounded_stretch, rounded_load, rounded_ends

contains

    !> The beam and its ground in quadruple precision, but for its links without ground, which refine_links condenses where they are
    !> needed
    subroutine refine_ground(ground, fine)
        type(ground_type), intent(in) :: ground
        type(fine_ground_type), intent(out) :: fine

        call refine_beam(ground%beam, detail_type(), fine%beam)
        associate (n => size(ground%pieces))
            allocate (fine%pieces(n), fine%dead(n), fine%live(n), fine%layers(size(ground%layers)), fine%first(n + 1), &
                      fine%laws(size(ground%laws)))
        end associate
        fine%pieces(:) = fine_piece(ground%pieces)
        fine%dead(:) = fine_load(ground%dead)
        fine%live(:) = fine_load(ground%live)
        fine%layers(:) = fine_layer(ground%layers)
        fine%first(:) = ground%first
        fine%laws(:) = fine_law(ground%laws)
        if (allocated(ground%mass)) allocate (fine%mass(0:ubound(ground%mass, 1)), source=real(ground%mass, qp))
        if (.not. allocated(ground%moving)) return
        allocate (fine%moving)
        allocate (fine%moving%supports, source=real(ground%moving%supports, qp))
        allocate (fine%moving%layers, source=real(ground%moving%layers, qp))
        if (allocated(ground%moving%tension)) then
            allocate (fine%moving%begins, source=real(ground%moving%begins, qp))
            allocate (fine%moving%tension, source=real(ground%moving%tension, qp))
        end if
        if (allocated(ground%moving%tension_change)) then
            allocate (fine%moving%tension_change, source=real(ground%moving%tension_change, qp))
        end if
    end subroutine refine_ground

    !> Its links without ground
    subroutine refine_links(detail, fine)
        !> What they are made of
        type(detail_type), intent(in) :: detail
        type(fine_ground_type), intent(inout) :: fine

        call condense_again(detail, fine%beam%links)
    end subroutine refine_links

    !> A layer in quadruple precision
    elemental function fine_layer(layer) result(fine)
        type(layer_type), intent(in) :: layer
        type(fine_layer_type) :: fine

        fine = fine_layer_type(layer%foundation, layer%side, real(layer%modulus_a, qp), real(layer%modulus_b, qp), &
                               real(layer%contact_a, qp), real(layer%contact_b, qp), layer%law_first, layer%law_last, &
                               layer%law, real(layer%parameter_a, qp), real(layer%parameter_b, qp), layer%rigid)
    end function fine_layer

    !> A piece of a law in quadruple precision
    elemental function fine_law(law) result(fine)
        type(law_piece_type), intent(in) :: law
        type(fine_law_piece_type) :: fine

        fine = fine_law_piece_type(real(law%displacement_a, qp), real(law%displacement_b, qp), real(law%force_a, qp), &
                                   real(law%force_b, qp), real(law%slope_a, qp), real(law%slope_b, qp), real(law%way_a, qp), &
                                   real(law%way_b, qp))
    end function fine_law

    !> Zones in quadruple precision
    pure subroutine refine_zones(fine, zones, refined)
        !> The beam and its ground
        type(fine_ground_type), intent(in) :: fine
        type(zones_type), intent(in) :: zones
        type(fine_zones_type), intent(out) :: refined

        call new_zones(size(zones%piece), size(zones%acts, 1), zones%steps, refined)
        refined%piece(:) = zones%piece
        refined%from(:) = zones%from
        refined%to(:) = exact_ends(zones, fine)
        refined%acts(:, :) = zones%acts
        refined%start(:, :) = zones%start
        if (allocated(zones%pushed)) allocate (refined%pushed, source=zones%pushed)
    end subroutine refine_zones

    !> A stretch in double precision
    elemental function rounded_stretch(fine) result(stretch)
        type(fine_stretch_type), intent(in) :: fine
        type(stretch_type) :: stretch

        stretch = stretch_type(length=real(fine%length, wp), flexibility=real(fine%flexibility, wp), &
                               shear_flexibility=real(fine%shear_flexibility, wp), modulus_a=real(fine%modulus_a, wp), &
                               modulus_b=real(fine%modulus_b, wp), tension=real(fine%tension, wp), &
                               tension_change=real(fine%tension_change, wp), taper=real(fine%taper, wp), power=fine%power)
    end function rounded_stretch

    !> The load along it
    elemental function rounded_load(fine) result(load)
        type(fine_stretch_load_type), intent(in) :: fine
        type(stretch_load_type) :: load

        load = stretch_load_type(qa=real(fine%qa, wp), qb=real(fine%qb, wp), qc=real(fine%qc, wp), kappa=real(fine%kappa, wp), &
                                 rise=real(fine%rise, wp))
    end function rounded_load

    !> What is at its ends
    elemental function rounded_ends(fine) result(ends)
        type(fine_ends_type), intent(in) :: fine
        type(stretch_ends_type) :: ends

        ends = stretch_ends_type(real(fine%w_a, wp), real(fine%w_b, wp), real(fine%moment_a, wp), real(fine%moment_b, wp))
    end function rounded_ends

    !> Right ends of the stretches: the last one of a piece ends where the piece does
    pure function exact_ends(zones, fine) result(ends)
        type(zones_type), intent(in) :: zones
        type(fine_ground_type), intent(in) :: fine
        real(qp), allocatable :: ends(:)
        integer :: i

        allocate (ends, source=real(zones%to, qp))
        do i = 1, size(ends)
            if (i < size(ends)) then
                if (zones%piece(i + 1) == zones%piece(i)) cycle
            end if
            ends(i) = fine%pieces(zones%piece(i))%length
        end do
    end function exact_ends

end module gapbeam_refined_ground
