!> Supports that hold rotations: restraints and hinges with laws of their own.
!>
!> The law of a couple over a rotation is that of a force over a deflection, so such a support is one as any other, at a node of its
!> own behind those of the beam (turning of beam_type). What its piece does there goes into the node of the beam at which it is: a
!> spring becomes a compliance, which is added (docs/method.md 2), a level piece a couple, or the moment that a hinge passes on, and
!> a rigid piece a rotation that is known.
module gapbeam_turning
    use gapbeam_kinds, only: wp
    use gapbeam_nodes, only: plain, hinge, restrained, jointed, hinge_left, hinge_right, joint_left, joint_right, is_hinge, &
        takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_law, only: add_supports
    use gapbeam_law_kinematics, only: mark_held
    use gapbeam_model, only: beam_type, last_place, of_node, of_hinge_held_left, left_of_hinge, right_of_hinge, is_of_hinge
    implicit none
    private
    public :: apply_turning, restrain, find_turning, find_kinds, turn_with

contains

    !> Nodes as the supports that hold their rotations make them
    pure subroutine apply_turning(beam, acting, range, nodes, rhs, level)
        type(beam_type), intent(in) :: beam
        !> Which supports act
        logical, intent(in) :: acting(:)
        !> First and last node of the beam
        integer, intent(in) :: range(2)
        !> As the other supports leave them; of rotations as well out, shape (0:n + r)
        type(node_type), intent(inout) :: nodes(0:)
        type(rhs_type), intent(inout) :: rhs(0:)
        real(wp), intent(inout) :: level(0:)
        integer :: i, j, v

        do j = 1, size(beam%turning)
            i = beam%turning(j)
            if (i < range(1) .or. i > range(2)) cycle
            v = size(beam%links) + j
            nodes(v) = node_type()
            rhs(v) = rhs_type()
            level(v) = 0.0_wp
            call add_supports(beam%supports, beam%order(beam%first(v):beam%first(v + 1) - 1), acting, nodes, rhs, level)
            associate (node => nodes(i), r => rhs(i), of => nodes(v), known => rhs(v))
                if (of%held) then
                    ! What a known rotation would make where a link is held against it
                    level(i) = level(i) + abs(known%deflection)*maxval(beam%links(max(1, i):min(i + 1, size(beam%links)))%length)
                    if (is_of_hinge(beam%turned(j))) then
                        node%kind = jointed
                        node%compliance = 0.0_wp
                        r%moment = known%deflection
                    else
                        call restrain(beam%turned(j), 0.0_wp, node)
                        if (takes_left(node%kind)) r%left = r%left + known%deflection
                        if (takes_right(node%kind)) r%right = r%right - known%deflection
                    end if
                else if (of%stiffness > 0.0_wp) then
                    if (is_of_hinge(beam%turned(j))) then
                        node%kind = jointed
                        node%compliance = 1/of%stiffness
                        r%moment = node%compliance*known%shear
                    else
                        call restrain(beam%turned(j), 1/of%stiffness, node)
                        r%couple = r%couple + known%shear
                    end if
                else if (is_of_hinge(beam%turned(j))) then
                    node%kind = hinge
                    r%moment = -known%shear
                else
                    r%couple = r%couple + known%shear
                    if (beam%turned(j) == left_of_hinge) then
                        if (node%kind == hinge) r%moment = r%moment - known%shear
                        if (node%kind == jointed) r%moment = r%moment + node%compliance*known%shear
                    end if
                end if
            end associate
        end do
        ! What turns a joint by itself is between it and a restraint
        do j = 1, size(beam%turning)
            i = beam%turning(j)
            if (i < range(1) .or. i > range(2) .or. .not. is_of_hinge(beam%turned(j))) cycle
            associate (node => nodes(i), r => rhs(i))
                if (is_hinge(node%kind)) cycle
                if (node%kind == joint_right) then
                    r%left = r%left + r%moment
                else
                    r%right = r%right + r%moment
                end if
            end associate
        end do
    end subroutine apply_turning

    !> Let a spring hold the rotation of a node, or of one side of the hinge or joint that it is
    pure subroutine restrain(turned, compliance, node)
        !> As in beam_type
        integer, intent(in) :: turned
        !> Of the spring
        real(wp), intent(in) :: compliance
        type(node_type), intent(inout) :: node
        logical :: left

        left = turned == left_of_hinge
        if (turned == of_node) then
            node%kind = restrained
        else if (node%kind == hinge) then
            node%kind = merge(hinge_left, hinge_right, left)
        else
            node%joint = node%compliance
            node%kind = merge(joint_left, joint_right, left)
        end if
        node%compliance = compliance
    end subroutine restrain

    !> Rotations from the solution at the nodes of the beam, and the couples that go with them
    pure subroutine find_turning(beam, nodes, rhs, level, loads, turn_size, answers, rotation_size, couple, couple_size)
        type(beam_type), intent(in) :: beam
        !> Nodes, right-hand sides and levels as apply_turning left them; the loads alone
        type(node_type), intent(in) :: nodes(0:)
        type(rhs_type), intent(in) :: rhs(0:)
        real(wp), intent(in) :: level(0:)
        type(rhs_type), intent(in) :: loads(0:)
        !> Of every link, the rotations that its loads could make, shape (n)
        real(wp), intent(in) :: turn_size(:)
        !> Solution at the nodes of the beam in, rotations as the deflections of those behind them out, shape (0:n + r)
        type(answer_type), intent(inout) :: answers(0:)
        !> Sizes for rounding errors of the rotations, the couples, and their sizes, shape (r)
        real(wp), intent(out) :: rotation_size(:), couple(:), couple_size(:)
        real(wp) :: turn(2), turn_terms(2)
        integer :: i, j, n, v

        n = size(beam%links)
        do j = 1, size(beam%turning)
            i = beam%turning(j)
            v = n + j
            associate (a => answers(i), of => nodes(v), known => rhs(v), rotation => answers(v)%deflection)
                couple_size(j) = max(abs(a%moment_left), abs(a%moment_right))
                if (i > 0) couple_size(j) = max(couple_size(j), abs(answers(i - 1)%moment_right))
                if (i < n) couple_size(j) = max(couple_size(j), abs(answers(i + 1)%moment_left))
                if (is_of_hinge(beam%turned(j))) then
                    couple(j) = merge(a%moment_right, a%moment_left, beam%turned(j) == of_hinge_held_left)
                else
                    couple(j) = (a%moment_left - a%moment_right) + loads(i)%couple
                    couple_size(j) = couple_size(j) + abs(loads(i)%couple)
                end if
                if (of%held) then
                    rotation = known%deflection
                    rotation_size(j) = abs(rotation)
                else if (of%stiffness > 0.0_wp) then
                    rotation = (couple(j) + known%shear)/of%stiffness
                    ! The line of a law is told by a point of it, so that what it gives where it begins may be a difference
                    rotation_size(j) = (couple_size(j) + abs(known%shear))/of%stiffness + level(v)
                else
                    call turns_beside(beam, loads, turn_size, answers, i, turn, turn_terms)
                    if (is_of_hinge(beam%turned(j))) then
                        rotation = turn(1) - turn(2)
                        rotation_size(j) = sum(turn_terms)
                    else if (beam%turned(j) == left_of_hinge .or. beam%turned(j) == right_of_hinge) then
                        rotation = turn(merge(1, 2, beam%turned(j) == left_of_hinge))
                        rotation_size(j) = turn_terms(merge(1, 2, beam%turned(j) == left_of_hinge))
                    else
                        ! Both are the same; the one whose terms are smaller is more exact
                        rotation = turn(minloc(turn_terms, 1))
                        rotation_size(j) = minval(turn_terms)
                    end if
                end if
            end associate
        end do
    end subroutine find_turning

    !> Rotations left and right of a node by the links beside it, and the sizes of their terms; huge where there is no link
    pure subroutine turns_beside(beam, loads, turn_size, answers, i, turn, terms)
        !> As for find_turning
        type(beam_type), intent(in) :: beam
        type(rhs_type), intent(in) :: loads(0:)
        real(wp), intent(in) :: turn_size(:)
        type(answer_type), intent(in) :: answers(0:)
        !> The node
        integer, intent(in) :: i
        real(wp), intent(out) :: turn(2), terms(2)

        turn(:) = 0.0_wp
        terms(:) = huge(1.0_wp)
        if (i > 0) then
            call turn_of_end(beam, answers, i, 2, turn(1), terms(1))
            turn(1) = turn(1) - loads(i)%left
            terms(1) = terms(1) + turn_size(i)
        end if
        if (i < size(beam%links)) then
            call turn_of_end(beam, answers, i + 1, 1, turn(2), terms(2))
            turn(2) = turn(2) + loads(i)%right
            terms(2) = terms(2) + turn_size(i + 1)
        end if
    end subroutine turns_beside

    !> Rotation of an end of a link without its loads, and the size of the terms
    pure subroutine turn_of_end(beam, answers, i, end, turn, terms)
        !> As for find_turning
        type(beam_type), intent(in) :: beam
        type(answer_type), intent(in) :: answers(0:)
        !> The link; its left end, 1, or its right one, 2
        integer, intent(in) :: i, end
        real(wp), intent(out) :: turn, terms
        real(wp) :: w(2), m(2), chord(2), by_moments(2)

        w(:) = answers(i - 1:i)%deflection
        m(:) = [answers(i - 1)%moment_right, answers(i)%moment_left]
        associate (link => beam%links(i))
            if (allocated(beam%ground)) then
                associate (g => beam%ground(i))
                    chord(:) = merge([g%pa, g%p1], [g%p2, g%pb], end == 1)*w
                    turn = chord(2) - chord(1)
                    terms = abs(chord(2)) + abs(chord(1))
                    by_moments(:) = merge([g%faa, g%fab], [g%fab, g%fbb], end == 1)*m
                end associate
            else
                turn = (w(2) - w(1))*link%inverse
                terms = (abs(w(2)) + abs(w(1)))*link%inverse
                by_moments(:) = merge([link%faa, link%fab], [link%fab, link%fbb], end == 1)*m
            end if
        end associate
        turn = turn + merge(1, -1, end == 1)*(by_moments(1) + by_moments(2))
        terms = terms + abs(by_moments(1)) + abs(by_moments(2))
    end subroutine turn_of_end

    !> Kinds of the nodes of a beam while a scheme acts: a hinge that acts is none, a restraint that does not either
    pure subroutine find_kinds(beam, acting, kind)
        !> The beam, and which supports act
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        !> plain, restrained, or a hinge, which a restraint may be beside, shape (0:n)
        integer, intent(out) :: kind(0:)
        logical, allocatable :: held(:)
        integer :: j

        kind(:) = beam%kind
        if (.not. allocated(beam%turning)) return
        allocate (held(0:last_place(beam)), source=.false.)
        call mark_held(beam%supports, acting, held)
        do j = 1, size(beam%turning)
            associate (holds => held(size(beam%links) + j), here => kind(beam%turning(j)))
                if (is_of_hinge(beam%turned(j))) then
                    here = merge(plain, hinge, holds)
                else if (holds .and. here == hinge) then
                    here = merge(hinge_left, hinge_right, beam%turned(j) == left_of_hinge)
                else if (holds) then
                    here = restrained
                end if
            end associate
        end do
    end subroutine find_kinds

    !> Rotations that go with a motion in which the beam is straight between its nodes
    pure subroutine turn_with(beam, motion)
        type(beam_type), intent(in) :: beam
        !> Displacements of the nodes in, rotations behind them out, shape (0:n + r)
        real(wp), intent(inout) :: motion(0:)
        integer :: i, j, n

        if (.not. allocated(beam%turning)) return
        n = size(beam%links)
        do j = 1, size(beam%turning)
            i = beam%turning(j)
            if (is_of_hinge(beam%turned(j))) then
                motion(n + j) = slope(i) - slope(i + 1)
            else if (beam%turned(j) == left_of_hinge) then
                motion(n + j) = slope(i)
            else
                motion(n + j) = slope(min(i + 1, n))
            end if
        end do

    contains

        pure function slope(k)
            !> Link
            integer, intent(in) :: k
            real(wp) :: slope

            slope = (motion(k) - motion(k - 1))*beam%links(k)%inverse
        end function slope

    end subroutine turn_with

end module gapbeam_turning
