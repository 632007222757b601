!> Refusals of what does not go with rigid ground, or is not available beside it.
module gapbeam_check_rigid_ground
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_words, only: shown
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_scene, only: gapbeam_normal, gapbeam_below, gapbeam_above, gapbeam_linear_curvature
    use gapbeam_assembled_model, only: assembled_type, is_alone, is_beside_point, turns, from_to, in_bending, in_shear
    use gapbeam_piece_stiffness, only: stiffness_of, stiffness_along
    use gapbeam_input_error, only: refuse, of_supports, of_foundations, of_loads, bad_law, bad_load
    implicit none
    private
    public :: check_rigid_ground, is_on_rigid_ground

contains

    !> Is there rigid ground
    pure function is_on_rigid_ground(assembled) result(is_on)
        type(assembled_type), intent(in) :: assembled
        logical :: is_on

        is_on = .false.
        if (allocated(assembled%layers)) is_on = any(assembled%layers%rigid)
    end function is_on_rigid_ground

    !> Can the beam lie on its rigid ground
    subroutine check_rigid_ground(assembled, error)
        !> With loads and layers in the user's units
        type(assembled_type), intent(in) :: assembled
        !> The foundation, or the support, and why not
        type(error_type), allocatable, intent(out) :: error
        integer :: j, k, s

        if (.not. is_on_rigid_ground(assembled)) return
        if (.not. all(assembled%layers%rigid)) then
            k = findloc(assembled%layers%rigid, .true., 1)
            call refuse_ground(assembled, assembled%layers(k)%foundation, "rigid ground beside ground that gives way is not "// &
                               "available in this version; give all of it a stiffness, or none", error)
            return
        end if
        do k = 1, size(assembled%model%loads)
            associate (load => assembled%model%loads(k), from => assembled%load_from(k), to => assembled%load_to(k))
                if (.not. is_alone(load)) cycle
                if (.not. lies_on(assembled, from + merge(0, 1, is_beside_point(load)), &
                                  merge(from + 1, to, is_beside_point(load)))) cycle
                call refuse(error, of_loads, k, size(assembled%model%loads), bad_load, merge("value_to", "rotation", &
                            load%kind == gapbeam_linear_curvature), "a support that is turned, a couple at a hinge, or a "// &
                            "curvature that changes along the beam is not available over rigid ground; give the ground a stiffness")
                return
            end associate
        end do
        do j = 1, size(assembled%pieces)
            if (lies_on(assembled, j, j)) call check_piece(assembled, j, error)
            if (allocated(error)) return
        end do
        do s = 1, size(assembled%model%supports)
            if (.not. lies_on(assembled, assembled%support_point(s), assembled%support_point(s) + 1)) cycle
            if (turns(assembled%model%supports(s))) then
                call refuse(error, of_supports, s, size(assembled%model%supports), bad_law, "direction", "a support that holds "// &
                            "a rotation by a law, a slack, one way or at a hinge is not available over rigid ground; give the "// &
                            "ground a stiffness")
                return
            end if
            if (assembled%model%supports(s)%direction /= gapbeam_normal) cycle
            call check_support(assembled, s, error)
            if (allocated(error)) return
        end do
    end subroutine check_rigid_ground

    !> Is the ground under one of some pieces
    pure function lies_on(assembled, first, last) result(does)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: first, last
        logical :: does
        integer :: j

        does = any([(assembled%layer_first(j + 1) > assembled%layer_first(j), &
                     j=max(1, first), min(last, size(assembled%pieces)))])
    end function lies_on

    !> A piece of the beam over rigid ground
    subroutine check_piece(assembled, piece, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: piece
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: problem
        real(wp) :: ei, ei_to
        integer, allocatable :: sides(:)
        integer :: power

        call stiffness_along(assembled, piece, in_bending, ei, ei_to, power)
        sides = assembled%layers(assembled%layer_first(piece):assembled%layer_first(piece + 1) - 1)%side
        if (ei > huge(ei)) then
            problem = "the beam is rigid there, too"
        else if (stiffness_of(assembled, piece, in_shear) <= huge(ei)) then
            problem = "the beam has a finite GA there"
        else if (power > 0 .and. any(abs([assembled%dead(piece)%kappa, assembled%live(piece)%kappa]) > 0.0_wp)) then
            problem = "a curvature is imposed on a beam that tapers there"
        else if (count(sides == gapbeam_below) > 1 .or. count(sides == gapbeam_above) > 1) then
            problem = "one foundation lies over another one"
        end if
        if (.not. allocated(problem)) return
        call refuse_ground(assembled, assembled%layers(assembled%layer_first(piece))%foundation, &
                           trim(from_to(assembled, piece - 1, piece))//" "//problem//", which on rigid ground is "// &
                           "not available in this version; give the ground a stiffness", error)
    end subroutine check_piece

    !> A support over rigid ground: it must not hold the beam where the ground is, nor turn it elastically
    subroutine check_support(assembled, number, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: number
        type(error_type), allocatable, intent(out) :: error
        integer :: piece, k
        real(wp) :: level, ground, slack

        associate (s => assembled%model%supports(number), point => assembled%support_point(number), &
                   m => size(assembled%model%supports))
            level = s%settlement + s%side*s%gap
            do piece = max(1, point), min(point + 1, size(assembled%pieces))
                if (.not. lies_on(assembled, piece, piece)) cycle
                if (s%rotation > 0.0_wp .and. s%rotation <= huge(s%rotation)) then
                    call refuse(error, of_supports, number, m, bad_law, "rotation", "a support that holds the rotation "// &
                                "elastically is not available over rigid ground; hold it rigidly, or not")
                    return
                end if
                if (.not. s%stiffness > huge(s%stiffness)) cycle
                do k = assembled%layer_first(piece), assembled%layer_first(piece + 1) - 1
                    associate (layer => assembled%layers(k))
                        ground = merge(layer%contact_b, layer%contact_a, piece == point)
                        slack = position_tolerance*max(abs(level), abs(ground))
                        if (s%side == layer%side .or. layer%side*(level - ground) <= slack) cycle
                        call refuse(error, of_supports, number, m, bad_law, "", "this one holds the beam at a deflection of "// &
                                    trim(shown(level))//", which the rigid ground there stops at "//trim(shown(ground))// &
                                    "; give the foundation a greater gap")
                        return
                    end associate
                end do
            end do
        end associate
    end subroutine check_support

    !> Refuse a foundation
    subroutine refuse_ground(assembled, number, problem, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: number
        character(len=*), intent(in) :: problem
        type(error_type), allocatable, intent(out) :: error

        call refuse(error, of_foundations, number, size(assembled%model%foundations), bad_law, "k", problem)
    end subroutine refuse_ground

end module gapbeam_check_rigid_ground
