!> Loads of stretches: what of those of a piece is on a part of it, and what is imposed at the ends of pieces.
module gapbeam_stretch_loads
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: piece_load_type, link_type, no_load
    use gapbeam_piece, only: curvature_at
    use gapbeam_foundation, only: stretch_load_type, stretch_link_type
    use gapbeam_ground_laws, only: along
    implicit none
    private
    public :: add_end_loads, ends_of_piece, load_on_part, on_stretch, on_piece, combined_load

contains

    !> Rotations imposed at the ends of a stretch, and couples just inside them: its end moments are those of the nodes with these
    pure subroutine add_end_loads(link, loads, bar)
        type(stretch_link_type), intent(in) :: link
        !> Dead and live
        type(stretch_load_type), intent(in) :: loads(2)
        type(link_type), intent(inout) :: bar

        associate (a => loads%couple_a, b => loads%couple_b, kink_a => loads%kink_a, kink_b => loads%kink_b)
            if (.not. maxval(abs([a, b, kink_a, kink_b])) > 0.0_wp) return
            bar%turn_a(:) = bar%turn_a + ((link%faa*a - link%fab*b) - kink_a)
            bar%turn_b(:) = bar%turn_b + ((link%fab*a - link%fbb*b) - kink_b)
            bar%shear_a(:) = bar%shear_a - (link%pa*a + link%p2*b)
            bar%shear_b(:) = bar%shear_b - (link%p1*a + link%pb*b)
            bar%load_sum(:) = bar%load_sum + (abs(a) + abs(b))*bar%inverse
            bar%turn_sum(:) = bar%turn_sum + (bar%bending*(abs(a) + abs(b)) + abs(kink_a) + abs(kink_b))
        end associate
    end subroutine add_end_loads

    !> Is a part the first of its piece, and the last one
    pure function ends_of_piece(piece, i) result(ends)
        !> Pieces of all parts, in order; number of the part
        integer, intent(in) :: piece(:), i
        logical :: ends(2)

        ends(:) = [i == 1, i == size(piece)]
        if (i > 1) ends(1) = piece(i - 1) /= piece(i)
        if (i < size(piece)) ends(2) = piece(i + 1) /= piece(i)
    end function ends_of_piece

    !> What of the loads of a piece is on a part of it
    pure function load_on_part(load, from, to, length, ends) result(part)
        type(piece_load_type), intent(in) :: load
        real(wp), intent(in) :: from, to, length
        !> As of ends_of_piece
        logical, intent(in) :: ends(2)
        type(piece_load_type) :: part

        part = no_load
        part%qa = along(load%qa, load%qb, from, length)
        part%qb = along(load%qa, load%qb, to, length)
        part%kappa = curvature_at(load, from, length)
        if (abs(load%rise) > 0.0_wp) part%rise = load%rise*((to - from)/length)
        if (ends(1)) part%kink_a = load%kink_a
        if (ends(1)) part%couple_a = load%couple_a
        if (ends(2)) part%kink_b = load%kink_b
        if (ends(2)) part%couple_b = load%couple_b
    end function load_on_part

    !> A load of a part as that of a stretch
    pure function on_stretch(load) result(found)
        type(piece_load_type), intent(in) :: load
        type(stretch_load_type) :: found

        found = stretch_load_type(qa=load%qa, qb=load%qb, kappa=load%kappa, rise=load%rise, kink_a=load%kink_a, &
                                  kink_b=load%kink_b, couple_a=load%couple_a, couple_b=load%couple_b)
    end function on_stretch

    !> The load along a stretch as that of a piece
    pure function on_piece(load) result(found)
        type(stretch_load_type), intent(in) :: load
        type(piece_load_type) :: found

        found = no_load
        found%qa = load%qa
        found%qb = load%qb
        found%kappa = load%kappa
        found%rise = load%rise
    end function on_piece

    !> Dead plus factor times live
    elemental function combined_load(dead, live, factor) result(load)
        type(stretch_load_type), intent(in) :: dead, live
        real(wp), intent(in) :: factor
        type(stretch_load_type) :: load

        load = stretch_load_type(dead%qa + factor*live%qa, dead%qb + factor*live%qb, dead%qc + factor*live%qc, &
                                 dead%kappa + factor*live%kappa, dead%rise + factor*live%rise, &
                                 dead%kink_a + factor*live%kink_a, dead%kink_b + factor*live%kink_b, &
                                 dead%couple_a + factor*live%couple_a, dead%couple_b + factor*live%couple_b)
    end function combined_load

end module gapbeam_stretch_loads
