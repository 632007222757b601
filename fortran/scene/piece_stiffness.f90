!> Stiffness of the pieces of a beam in the user's units: that of their span, or of the last section that gives it.
module gapbeam_piece_stiffness
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: gapbeam_unchanged
    use gapbeam_assembled_model, only: assembled_type, point_x, in_bending, in_shear, along_axis, axial_force_in, kinds
    implicit none
    private
    public :: assign_sections, stiffness_of, stiffness_along, least_stiffness_of

contains

    !> Which section gives the stiffness of a piece: the last one that gives it
    subroutine assign_sections(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        if (size(assembled%model%sections) == 0) return
        allocate (assembled%section_of(kinds, size(assembled%pieces)), source=0, stat=stat)
        if (failed(stat, error)) return
        do i = 1, size(assembled%model%sections)
            associate (s => assembled%model%sections(i), first => assembled%section_from(i) + 1, last => assembled%section_to(i))
                if (s%EI > gapbeam_unchanged) assembled%section_of(in_bending, first:last) = i
                if (s%GA > gapbeam_unchanged) assembled%section_of(in_shear, first:last) = i
                if (s%EA > gapbeam_unchanged) assembled%section_of(along_axis, first:last) = i
                if (s%N > gapbeam_unchanged) assembled%section_of(axial_force_in, first:last) = i
            end associate
        end do
    end subroutine assign_sections

    !> Stiffness of a piece, or the axial force in it, in the user's units
    pure function stiffness_of(assembled, piece, kind) result(stiffness)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: piece
        !> in_bending, in_shear, along_axis or axial_force_in
        integer, intent(in) :: kind
        real(wp) :: stiffness, all_of_them(kinds)

        associate (s => assembled%model%spans(assembled%point_span(piece - 1) + 1))
            all_of_them = [s%EI, s%GA, s%EA, s%N]
        end associate
        stiffness = all_of_them(kind)
        if (.not. allocated(assembled%section_of)) return
        if (assembled%section_of(kind, piece) == 0) return
        associate (s => assembled%model%sections(assembled%section_of(kind, piece)))
            all_of_them = [s%EI, s%GA, s%EA, s%N]
        end associate
        stiffness = all_of_them(kind)
    end function stiffness_of

    !> Stiffness at both ends of a piece in the user's units, and its power of a depth that is linear between them
    pure subroutine stiffness_along(assembled, piece, kind, from, to, power)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: piece
        !> in_bending, in_shear or along_axis
        integer, intent(in) :: kind
        real(wp), intent(out) :: from, to
        !> 0: it is the same all along
        integer, intent(out) :: power
        real(wp) :: ends(2, 3), ratio
        integer :: powers(3)

        from = stiffness_of(assembled, piece, kind)
        to = from
        power = 0
        if (.not. allocated(assembled%section_of)) return
        associate (section => assembled%section_of(kind, piece))
            if (section == 0) return
            associate (s => assembled%model%sections(section), first => assembled%section_from(section), &
                       last => assembled%section_to(section))
                ends(1, :) = [s%EI, s%GA, s%EA]
                ends(2, :) = [s%EI_to, s%GA_to, s%EA_to]
                powers(:) = [s%EI_power, s%GA_power, s%EA_power]
                ! As given where both ends are alike
                if (.not. ends(2, kind) > gapbeam_unchanged .or. .not. abs(ends(2, kind) - ends(1, kind)) > 0.0_wp) return
                power = powers(kind)
                ratio = (ends(2, kind)/ends(1, kind))**(1/real(power, wp))
                if (piece - 1 > first) from = at_share(way(piece - 1)/way(last))
                to = ends(2, kind)
                if (piece < last) to = at_share(way(piece)/way(last))
            end associate
        end associate

    contains

        !> Stiffness at a share of the section
        pure function at_share(t) result(stiffness)
            real(wp), intent(in) :: t
            real(wp) :: stiffness

            stiffness = ends(1, kind)*((1 - t) + ratio*t)**power
        end function at_share

        !> Distance of a point from the left end of the section; within a span free of where that is
        pure function way(point) result(distance)
            integer, intent(in) :: point
            real(wp) :: distance

            associate (start => assembled%section_from(assembled%section_of(kind, piece)))
                distance = point_x(assembled, point) - point_x(assembled, start)
                if (assembled%point_span(point) == assembled%point_span(start)) then
                    distance = assembled%point_offset(point) - assembled%point_offset(start)
                end if
            end associate
        end function way

    end subroutine stiffness_along

    !> The smaller one of those at both ends of a piece
    pure function least_stiffness_of(assembled, piece, kind) result(least)
        type(assembled_type), intent(in) :: assembled
        !> As for stiffness_of
        integer, intent(in) :: piece, kind
        real(wp) :: least, from, to
        integer :: power

        call stiffness_along(assembled, piece, kind, from, to, power)
        least = min(from, to)
    end function least_stiffness_of

end module gapbeam_piece_stiffness
