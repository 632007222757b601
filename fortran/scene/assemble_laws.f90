!> Assembly of support laws: the user's points to breakpoints, in the user's units.
module gapbeam_assemble_laws
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_words, only: shown, whole
    use gapbeam_scene, only: support_type, law_point_type, gapbeam_axial, gapbeam_both, gapbeam_below, gapbeam_infinity, &
        gapbeam_elastic
    use gapbeam_model, only: node_support_type, last_place
    use gapbeam_law, only: always_closed
    use gapbeam_polyline, only: join_pieces
    use gapbeam_laws, only: is_smooth
    use gapbeam_kinematics, only: free_motions, motion_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_input_error, only: refuse, of_supports, twice
    implicit none
    private
    public :: count_breakpoints, make_breakpoints, check_rigid_pieces, depends_on_path, laws_depend_on_path

contains

    !> No two supports at a place may be rigid at one deflection, if one of them has a law: statics could not tell what each of them
    !> takes. One that begins to push up and another one to push down there may.
    subroutine check_rigid_pieces(assembled, error)
        !> With its supports in the user's units
        type(assembled_type), intent(in) :: assembled
        !> The supports
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j, k

        associate (beam => assembled%beam)
            do i = 0, last_place(beam)
                do j = beam%first(i) + 1, beam%first(i + 1) - 1
                    do k = beam%first(i), j - 1
                        call compare(beam%order(j), beam%order(k))
                        if (allocated(error)) return
                    end do
                end do
            end do
        end associate

    contains

        !> Compare two supports or breakpoints of a place
        subroutine compare(j, k)
            integer, intent(in) :: j, k
            type(node_support_type) :: a, b
            logical :: apart

            associate (this => assembled%normal(j), other => assembled%normal(k), given => assembled%model%supports)
                if (this == other .or. .not. (assembled%with_law(this) .or. assembled%with_law(other))) return
                a = rise_of(j)
                b = rise_of(k)
                if (min(a%stiffness, b%stiffness) <= huge(1.0_wp)) return
                apart = abs(a%contact - b%contact) > position_tolerance*max(abs(a%contact), abs(b%contact))
                apart = apart .or. (given(this)%side*given(other)%side < 0 .and. .not. max(a%force, b%force) > 0.0_wp)
                if (apart) return
                call refuse(error, of_supports, this, size(given), twice, "", "this one and support "//trim(whole(other))// &
                            " stand at the same place and are rigid at the same deflection of "//trim(shown(a%contact))// &
                            ", so statics cannot tell what each of them takes; give one of them a finite stiffness", other)
                error%key = "law"
            end associate
        end subroutine compare

        !> The piece that begins at a breakpoint, or that of a support without a law, which has no numbers yet
        pure function rise_of(k) result(made)
            integer, intent(in) :: k
            type(node_support_type) :: made

            made = assembled%beam%supports(k)
            associate (s => assembled%model%supports(assembled%normal(k)))
                if (assembled%with_law(assembled%normal(k))) return
                made%stiffness = s%stiffness
                made%contact = s%settlement + s%side*s%gap
            end associate
        end function rise_of

    end subroutine check_rigid_pieces

    !> Does a state depend on the loading history to it. That loads move supports is known on a path alone, but on the ground, where
    !> every load factor is solved for by itself
    function depends_on_path(assembled) result(depends)
        type(assembled_type), intent(in) :: assembled
        logical :: depends

        depends = allocated(assembled%given_settlement) .and. .not. allocated(assembled%layers)
        if (.not. depends) depends = laws_depend_on_path(assembled)
    end function depends_on_path

    !> The same, whatever loads move: a force may fall, a support unloads otherwise than along its law, or acts along the beam by
    !> one, or the ground does
    function laws_depend_on_path(assembled) result(depends)
        type(assembled_type), intent(in) :: assembled
        logical :: depends
        type(motion_type), allocatable :: motions(:)

        depends = .true.
        ! Where bending feels them they are followed under the load at hand
        if (allocated(assembled%axial%laws) .and. .not. assembled%model%axial_loads_bend) return
        ! Beside a foundation what sliders remember is that of the dead loads alone
        if (allocated(assembled%axial%limit)) then
            if (.not. (allocated(assembled%axial%bedding) .and. allocated(assembled%layers))) return
        end if
        associate (s => assembled%beam%supports)
            depends = any(s%breakpoint > 0 .and. (s%stiffness < 0.0_wp .or. s%before < 0.0_wp))
        end associate
        if (.not. allocated(assembled%law)) return
        if (size(assembled%law) == 0) return
        associate (of_law => assembled%model%supports(assembled%law%support))
            depends = depends .or. any(of_law%unloading /= gapbeam_elastic .and. of_law%direction /= gapbeam_axial)
        end associate
        if (depends) return
        ! What yields may let go of a beam that nothing else holds: only its path tells at which load. Stretches tell that by
        ! limit analysis, as of ground that yields
        if (allocated(assembled%layers)) return
        associate (s => assembled%beam%supports)
            if (.not. any(s%breakpoint > 0 .and. abs(s%force) > 0.0_wp .and. &
                          .not. (abs(s%stiffness) > 0.0_wp .and. abs(s%before) > 0.0_wp) .and. &
                          .not. is_smooth(assembled%model%supports(assembled%normal)%law))) return
        end associate
        call free_motions(assembled%beam, always_closed(assembled%beam%supports), motions)
        depends = size(motions) > 0
    end function laws_depend_on_path

    !> Number of breakpoints of a support: those of its law, or one
    pure function count_breakpoints(support, points) result(breakpoints)
        type(support_type), intent(in) :: support
        !> Its law
        type(law_point_type), intent(in) :: points(:)
        integer :: breakpoints

        breakpoints = max(1, size(points))
        if (support%side /= gapbeam_both .or. size(points) == 0) return
        ! Mirrored; without a gap the law goes through the origin without a breakpoint
        breakpoints = 2*(size(points) - merge(0, 1, abs(support%gap) > 0.0_wp))
        ! One piece both ways is a spring
        breakpoints = max(1, breakpoints)
    end function count_breakpoints

    !> The breakpoints of a law
    pure subroutine make_breakpoints(support, points, node, breakpoints)
        type(support_type), intent(in) :: support
        !> Its law, one point at least
        type(law_point_type), intent(in) :: points(:)
        !> Its node
        integer, intent(in) :: node
        !> In ascending order of the displacement towards the support, shape (count_breakpoints)
        type(node_support_type), intent(out) :: breakpoints(:)
        integer :: i, m, n

        n = size(points)
        m = size(breakpoints)
        if (support%side /= gapbeam_both) then
            breakpoints(1) = breakpoint(1, 0.0_wp, 0.0_wp, 0.0_wp, slope(1))
            do i = 2, n
                breakpoints(i) = breakpoint(i, points(i - 1)%displacement, points(i - 1)%force, slope(i - 1), slope(i))
            end do
        else if (n == 1 .and. m == 1) then
            breakpoints(1) = node_support_type(node, gapbeam_both, slope(1), support%settlement)
            return
        else
            do i = 1, m/2
                ! From the last breakpoint of the pushing side down
                associate (j => n - i)
                    if (j > 0) then
                        breakpoints(i) = breakpoint(i, -points(j)%displacement, -points(j)%force, slope(j + 1), slope(j))
                        breakpoints(m + 1 - i) = breakpoint(m + 1 - i, points(j)%displacement, points(j)%force, slope(j), &
                                                            slope(j + 1))
                    else
                        breakpoints(i) = breakpoint(i, -0.0_wp, 0.0_wp, slope(1), 0.0_wp)
                        breakpoints(m + 1 - i) = breakpoint(m + 1 - i, 0.0_wp, 0.0_wp, 0.0_wp, slope(1))
                    end if
                end associate
            end do
        end if
        breakpoints(:m - 1)%more = .true.
        ! Beside gap and settlement the first points of a curve are so near that rounding moves them
        if (is_smooth(support%law)) call join_pieces(breakpoints)

    contains

        !> A breakpoint at a displacement past the gap
        pure function breakpoint(number, displacement, force, before, after) result(made)
            integer, intent(in) :: number
            real(wp), intent(in) :: displacement, force, before, after
            type(node_support_type) :: made
            integer :: side, way

            side = merge(gapbeam_below, support%side, support%side == gapbeam_both)
            way = side
            if (support%side == gapbeam_both .and. 2*number <= m) way = -1
            made = node_support_type(node, side, after, support%settlement + (way*support%gap + side*displacement), &
                                     breakpoint=number, force=force, before=before)
        end function breakpoint

        !> Slope of the piece that ends at a point; a vertical one is infinite
        pure function slope(i)
            integer, intent(in) :: i
            real(wp) :: slope, width, rise

            width = points(i)%displacement
            rise = points(i)%force
            if (i > 1) then
                width = width - points(i - 1)%displacement
                rise = rise - points(i - 1)%force
            end if
            if (width > 0.0_wp) then
                slope = rise/width
            else
                slope = sign(gapbeam_infinity, rise)
            end if
        end function slope

    end subroutine make_breakpoints

end module gapbeam_assemble_laws
