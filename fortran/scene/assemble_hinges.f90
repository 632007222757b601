!> Hinges: where they are, those that supports with laws make, and elastic ones as compliances at the left ends of pieces; and the
!> rotations that supports hold.
module gapbeam_assemble_hinges
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: softest_hinge
    use gapbeam_error, only: error_type, failed
    use gapbeam_range, only: is_lost
    use gapbeam_units, only: turning_unit
    use gapbeam_assembled_model, only: assembled_type, turns
    use gapbeam_axial_force, only: in_stretches
    use gapbeam_nodes, only: jointed
    use gapbeam_scene, only: support_type, gapbeam_relative, gapbeam_rotational_left, gapbeam_rotational_right
    use gapbeam_model, only: of_node, of_hinge, of_hinge_held_left, left_of_hinge, right_of_hinge
    use gapbeam_input_error, only: refuse, of_hinges, of_supports, twice, bad_law, at_hinge
    implicit none
    private
    public :: find_hinges, make_hinges, check_side, unclear, number_rotations, kind_of_rotation, assemble_hinges

    !> What a support does not say
    character(len=*), parameter :: unclear = "there is a hinge here, so it is unclear which side is held; say that by a "// &
        "support of direction rotational left or right"

contains

    !> Mark the hinges
    subroutine find_hinges(points, stiffness, hinged, joint, error)
        integer, intent(in) :: points(:)
        !> Couple per relative rotation of each, 0: none
        real(wp), intent(in) :: stiffness(:)
        !> Of all points, from 0
        logical, intent(out) :: hinged(0:)
        real(wp), intent(out) :: joint(0:)
        !> Two at one point
        type(error_type), allocatable, intent(out) :: error
        integer :: k, other

        hinged(:) = .false.
        joint(:) = 0.0_wp
        do k = 1, size(points)
            if (hinged(points(k)) .or. joint(points(k)) > 0.0_wp) then
                other = findloc(points, points(k), 1)
                call refuse(error, of_hinges, k, size(points), twice, "", &
                            "there is a hinge at this place already; remove one of them", other)
                return
            end if
            hinged(points(k)) = .not. stiffness(k) > 0.0_wp
            joint(points(k)) = stiffness(k)
        end do
    end subroutine find_hinges

    !> Mark the hinges that supports make, with laws
    subroutine make_hinges(assembled, error)
        !> With the points of its supports, and its other hinges marked
        type(assembled_type), intent(inout) :: assembled
        !> A hinge is there already, or the end of the beam
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: made(:)
        integer :: k, stat

        if (.not. any(assembled%model%supports%direction == gapbeam_relative)) return
        allocate (made(0:ubound(assembled%point_span, 1)), source=.false., stat=stat)
        if (failed(stat, error)) return
        do k = 1, size(assembled%model%supports)
            if (assembled%model%supports(k)%direction /= gapbeam_relative) cycle
            associate (at => assembled%support_point(k), m => size(assembled%model%supports))
                if ((assembled%hinged(at) .or. assembled%joint(at) > 0.0_wp) .and. .not. made(at)) then
                    call refuse(error, of_supports, k, m, bad_law, "", "there is a hinge at its place already; remove one of them")
                else if (at == 0 .or. at == ubound(assembled%point_span, 1)) then
                    call refuse(error, of_supports, k, m, bad_law, "", "a hinge at an end of the beam has nothing on its other "// &
                                "side; move it into the beam, or hold the rotation there")
                end if
                if (allocated(error)) return
                assembled%hinged(at) = .true.
                made(at) = .true.
            end associate
        end do
    end subroutine make_hinges

    !> Is it clear which side of a hinge a support holds, and only one held
    subroutine check_side(assembled, k, held, error)
        !> With its points
        type(assembled_type), intent(in) :: assembled
        !> Number of the support
        integer, intent(in) :: k
        !> Sides of its point that supports hold: 1 left, 2 right
        integer, intent(inout) :: held
        type(error_type), allocatable, intent(out) :: error

        associate (kind => kind_of_rotation(assembled%model%supports(k)), m => size(assembled%model%supports), &
                   hinged => assembled%hinged(assembled%support_point(k)), &
                   elastic => assembled%joint(assembled%support_point(k)) > 0.0_wp)
            if (kind == 1 .and. (hinged .or. elastic)) then
                call refuse(error, of_supports, k, m, at_hinge, "rotation", unclear)
            else if (kind >= 3 .and. elastic) then
                call refuse(error, of_supports, k, m, bad_law, "direction", "the hinge here has a stiffness; make a "// &
                            "support of direction relative of it, with that stiffness")
            else if (kind >= 3 .and. .not. hinged) then
                call refuse(error, of_supports, k, m, bad_law, "at_hinge", "there is no hinge at its place; leave it out")
            else if (kind >= 3) then
                held = ior(held, kind - 2)
                if (held < 3) return
                call refuse(error, of_supports, k, m, bad_law, "at_hinge", "the other side of the hinge is held too, which "// &
                            "is not available in this version; hold one side, or move one of the two supports aside")
            end if
        end associate
    end subroutine check_side

    !> Number the rotations that supports hold: of hinges, then others, in the order of the supports
    pure subroutine number_rotations(assembled, number)
        !> With its nodes and supports; its turning and turned out
        type(assembled_type), intent(inout) :: assembled
        !> 0 where none is held, shape (0:n, 4)
        integer, allocatable, intent(out) :: number(:, :)
        integer, parameter :: turned(4) = [of_node, of_hinge, left_of_hinge, right_of_hinge]
        integer :: k, r, turn

        associate (beam => assembled%beam, given => assembled%model%supports)
            allocate (number(0:ubound(assembled%node_point, 1), 4), source=0)
            allocate (beam%turning(count(turns(given))), beam%turned(count(turns(given))))
            r = 0
            do turn = 1, 2
                do k = 1, size(given)
                    if (.not. turns(given(k)) .or. ((given(k)%direction == gapbeam_relative) .neqv. turn == 1)) cycle
                    associate (node => assembled%node_of_point(assembled%support_point(k)), kind => kind_of_rotation(given(k)))
                        if (number(node, kind) > 0) cycle
                        r = r + 1
                        number(node, kind) = r
                        beam%turning(r) = node
                        beam%turned(r) = turned(kind)
                        if (turned(kind) == left_of_hinge .and. number(node, 2) > 0) then
                            beam%turned(number(node, 2)) = of_hinge_held_left
                        end if
                    end associate
                end do
            end do
            beam%turning = beam%turning(:r)
            beam%turned = beam%turned(:r)
        end associate
    end subroutine number_rotations

    !> 1 of a node, 2 of the two sides of a hinge, 3 left of a hinge, 4 right of it
    pure function kind_of_rotation(support) result(kind)
        type(support_type), intent(in) :: support
        integer :: kind

        kind = merge(2, 1, support%direction == gapbeam_relative)
        if (support%direction == gapbeam_rotational_left) kind = 3
        if (support%direction == gapbeam_rotational_right) kind = 4
    end function kind_of_rotation

    !> Compliances of the elastic hinges, if there are any, beside those of restraints
    subroutine assemble_hinges(assembled, error)
        !> Points, and pieces in the engine's units in
        type(assembled_type), intent(inout) :: assembled
        !> What a hinge cannot be
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: softness
        integer :: j

        assembled%pieces%hinge = 0.0_wp
        if (.not. any(assembled%joint > 0.0_wp)) return
        softness = sum(assembled%pieces%flexibility*assembled%pieces%length)
        do j = 2, size(assembled%pieces)
            if (.not. assembled%joint(j - 1) > 0.0_wp) cycle
            associate (beside => assembled%pieces(j - 1:j)%flexibility, hinge => assembled%pieces(j)%hinge)
                hinge = 1/scale(assembled%joint(j - 1), -turning_unit(assembled%units))
                if (is_lost(hinge)) then
                    call refuse_hinge("it is too far from the other stiffnesses of the beam; bring them nearer together")
                else if (.not. minval(beside) > 0.0_wp) then
                    call refuse_hinge("the beam is rigid beside it (infinite EI), which is not available with a stiffness in "// &
                                      "this version")
                else if (hinge > softest_hinge*softness) then
                    call refuse_hinge("it is so far below EI/length of the beam that it is a free hinge; give 0")
                else if (in_stretches(assembled%model)) then
                    ! Where pieces are cut into stretches it is at their node
                    associate (node => assembled%node_of_point(j - 1))
                        assembled%beam%kind(node) = jointed
                        assembled%beam%compliance(node) = hinge
                    end associate
                    hinge = 0.0_wp
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> Refuse the hinge at the left end of piece j
        subroutine refuse_hinge(problem)
            character(len=*), intent(in) :: problem

            call refuse(error, of_hinges, findloc(assembled%model%hinge_stiffness, assembled%joint(j - 1), 1), &
                        size(assembled%model%hinges), bad_law, "stiffness", problem)
        end subroutine refuse_hinge

    end subroutine assemble_hinges

end module gapbeam_assemble_hinges
