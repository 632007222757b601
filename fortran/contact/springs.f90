!> The ground as springs side by side: what decides whether there is an equilibrium at all, and where zones of contact are
!> looked for when those at hand lead nowhere.
!>
!> Springs stand at the ends of all pieces and between them. Whatever the ground can do against the motion of a rigid body, springs
!> at the ends of its pieces can do, and the search over springs always ends. With more and more of them the zones come as near
!> to the right ones as Newton's method needs.
module gapbeam_springs
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_solved, gapbeam_not_converged
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_band, only: plain
    use gapbeam_layers, only: layer_type, law_piece_type, law_piece, pieces_of_law, law_by_points
    use gapbeam_law_points, only: most_points, points_of_law
    use gapbeam_law, only: both
    use gapbeam_polyline, only: join_pieces
    use gapbeam_model, only: beam_type, node_support_type, order_supports
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_search, only: rule_block
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_ground_laws, only: between, contact_line, line_of_kink, piece_of_deflection, parameters_at
    use gapbeam_ground, only: ground_type, zones_type, new_zones, resize, steps_of, steps_of_piece
    implicit none
    private
    public :: search_springs

    !> Nodes at which the search over springs may solve, all its solves together: some seconds
    integer, parameter :: most_nodes = 2*10**7

contains

    !> Solve with springs instead of the ground
    subroutine search_springs(ground, factor, number, closed, zones, solves, outcome, error)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        !> Load factor
        real(wp), intent(in) :: factor
        !> Springs along the whole beam, about
        integer, intent(in) :: number
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        !> The zones that show, and linear solves
        type(zones_type), intent(out) :: zones
        integer, intent(out) :: solves
        !> Solved or no equilibrium, with the motion of the nodes of the beam without ground
        type(outcome_type), intent(out) :: outcome
        !> As for find_scheme
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: beam
        type(workspace_type) :: work
        integer, allocatable :: parts(:), node(:)
        logical, allocatable :: acting(:)
        real(wp), allocatable :: motion(:)
        real(wp) :: spacing
        integer :: j, n

        n = size(ground%pieces)
        allocate (parts(n), node(0:n))
        spacing = sum(ground%pieces%length)/number
        parts(:) = 1
        do j = 1, n
            associate (steps => steps_of_piece(ground, j))
                if (ground%first(j + 1) == ground%first(j)) cycle
                parts(j) = steps*ceiling(max(2.0_wp, ground%pieces(j)%length/spacing)/steps)
            end associate
        end do
        node(0) = 0
        do j = 1, n
            node(j) = node(j - 1) + parts(j)
        end do
        call make_beam(ground, parts, node, beam)
        allocate (acting(size(beam%supports)))
        acting(:) = .true.
        acting(:size(closed)) = closed
        ! Laws begin on their first piece
        where (beam%supports(size(closed) + 1:)%kink > 1) acting(size(closed) + 1:) = .false.
        call new_workspace(beam, work)
        call set_loads(beam, factor, work)
        work%most_solves = most_nodes/size(work%nodes)
        call find_scheme(beam, factor, rule_block, acting, work, outcome, error)
        solves = work%solves
        if (allocated(error) .and. work%solves > work%most_solves) then
            deallocate (error)
            call fatal_error(error, gapbeam_not_converged, "the ground could not be settled, or proved too weak for the loads: "// &
                             "look for loads near what it can bear")
        end if
        if (allocated(error)) return
        if (outcome%status /= gapbeam_solved) then
            allocate (motion(0:n))
            motion(:) = outcome%motion(node)
            call move_alloc(motion, outcome%motion)
            return
        end if
        closed(:) = acting(:size(closed))
        call read_zones(ground, beam, parts, node, work, zones)
    end subroutine search_springs

    !> The beam cut into parts, with its supports and then the springs
    pure subroutine make_beam(ground, parts, node, beam)
        type(ground_type), intent(in) :: ground
        !> Parts of every piece, and node of the right end of every piece
        integer, intent(in) :: parts(:), node(0:)
        type(beam_type), intent(out) :: beam
        type(node_support_type), allocatable :: supports(:)
        integer :: i, j, k, m, n, s

        n = node(ubound(node, 1))
        allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
        beam%kind(:) = plain
        beam%compliance(:) = 0.0_wp
        beam%force(:, :) = 0.0_wp
        beam%couple(:, :) = 0.0_wp
        beam%kind(node) = ground%beam%kind
        beam%compliance(node) = ground%beam%compliance
        beam%force(:, node) = ground%beam%force
        beam%couple(:, node) = ground%beam%couple
        m = size(ground%beam%supports)
        s = m
        do j = 1, size(parts)
            do k = ground%first(j), ground%first(j + 1) - 1
                m = m + (parts(j) + 1)*most_pieces(ground%layers(k))
            end do
        end do
        allocate (supports(m))
        supports(:s) = ground%beam%supports
        supports(:s)%node = node(supports(:s)%node)
        m = s
        do j = 1, size(parts)
            do i = 1, parts(j)
                call make_link(ground, j, i, parts(j), beam, node(j - 1) + i)
            end do
            do k = ground%first(j), ground%first(j + 1) - 1
                do i = 0, parts(j)
                    call make_spring(ground, ground%layers(k), ground%pieces(j)%length, i, parts(j), node(j - 1) + i, supports, m)
                end do
            end do
        end do
        call join_pieces(supports(:m))
        call order_supports(supports(:m), beam)
        beam%watch = ground%beam%watch
    end subroutine make_beam

    !> A part of a piece as a link
    pure subroutine make_link(ground, piece, part, parts, beam, link)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: piece, part, parts, link
        type(beam_type), intent(inout) :: beam
        type(piece_type) :: p(1)
        real(wp) :: work(1)

        p = ground%pieces(piece)
        p%length = p%length/parts
        call condense_link(p, [share(ground%dead(piece))], [share(ground%live(piece))], work, beam%links(link))

    contains

        !> The load on the part
        pure function share(load) result(found)
            type(piece_load_type), intent(in) :: load
            type(piece_load_type) :: found

            found = piece_load_type(between(load%qa, load%qb, part - 1, parts), between(load%qa, load%qb, part, parts), &
                                    load%kappa, 0.0_wp, 0.0_wp)
        end function share

    end subroutine make_link

    !> What a layer does to a node: half of what it does along the parts beside it
    pure subroutine make_spring(ground, layer, length, part, parts, node, supports, number)
        type(ground_type), intent(in) :: ground
        type(layer_type), intent(in) :: layer
        !> Of the piece
        real(wp), intent(in) :: length
        integer, intent(in) :: part, parts, node
        type(node_support_type), intent(inout) :: supports(:)
        !> Springs so far in and out
        integer, intent(inout) :: number
        type(law_piece_type) :: points(most_points), piece
        real(wp) :: width, place, before
        integer :: i, pieces

        place = between(0.0_wp, length, part, parts)
        width = length/parts
        if (part == 0 .or. part == parts) width = width/2
        if (layer%law == law_by_points .and. layer%law_last < layer%law_first) then
            before = between(layer%modulus_a, layer%modulus_b, part, parts)*width
            if (.not. before > 0.0_wp) return
            number = number + 1
            supports(number) = node_support_type(node, layer%side, before, contact_line(layer, place, length))
            return
        end if
        before = 0.0_wp
        if (layer%law == law_by_points) then
            pieces = pieces_of_law(layer)
        else
            call points_of_law(layer%law, parameters_at(layer, place, length), points, pieces)
        end if
        do i = 1, pieces
            if (layer%law == law_by_points) then
                piece = law_piece(layer, ground%laws, i)
            else
                piece = points(i)
            end if
            number = number + 1
            supports(number) = node_support_type(node, layer%side, piece%slope*width, &
                                                 contact_line(layer, place, length) + layer%side*piece%displacement, &
                                                 kink=i, more=i < pieces, force=piece%force*width, before=before)
            before = piece%slope*width
        end do
    end subroutine make_spring

    !> Pieces of the law of a spring, at most
    elemental function most_pieces(layer) result(pieces)
        type(layer_type), intent(in) :: layer
        integer :: pieces

        pieces = pieces_of_law(layer)
        if (layer%law /= law_by_points) pieces = most_points
    end function most_pieces

    !> In which parts every layer may act, neighbours with the same joined
    subroutine read_zones(ground, beam, parts, node, work, zones)
        type(ground_type), intent(in) :: ground
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: parts(:), node(0:)
        type(workspace_type), intent(in) :: work
        type(zones_type), intent(out) :: zones
        integer, allocatable :: acts(:)
        integer :: i, j, m, most, each

        most = maxval(ground%first(2:) - ground%first(:size(parts)))
        allocate (acts(most))
        call new_zones(node(ubound(node, 1)), most, steps_of(ground), zones)
        m = 0
        do j = 1, size(parts)
            each = parts(j)/zones%steps(j)
            do i = 1, parts(j)
                call judge_part(j, i)
                ! Steps of ground that varies stay
                if (i > 1 .and. mod(i - 1, each) > 0) then
                    if (all(acts == zones%acts(:, m))) then
                        zones%to(m) = place(j, i)
                        cycle
                    end if
                end if
                m = m + 1
                zones%piece(m) = j
                zones%from(m) = place(j, i - 1)
                zones%to(m) = place(j, i)
                zones%acts(:, m) = acts
                zones%start(:, m) = start_of(node(j - 1) + i)
            end do
        end do
        call resize(zones, m, m)

    contains

        !> What acts in a part
        subroutine judge_part(piece, part)
            integer, intent(in) :: piece, part
            integer :: k

            acts(:) = 0
            do k = ground%first(piece), ground%first(piece + 1) - 1
                associate (layer => ground%layers(k), state => acts(k - ground%first(piece) + 1))
                    state = 1
                    if (layer%side == both) cycle
                    state = acts_between(layer, piece, part)
                    if (state > 0) cycle
                    ! A spring that is pressed alone stands for a zone shorter than a part
                    if (presses(layer, piece, part - 1)) then
                        if (acts_between(layer, piece, max(1, part - 1)) == 0) state = 1
                    else if (presses(layer, piece, part)) then
                        if (acts_between(layer, piece, min(parts(piece), part + 1)) == 0) state = 1
                    end if
                end associate
            end do
        end subroutine judge_part

        !> Fields at the left end of a part, straight between its ends
        pure function start_of(part) result(start)
            integer, intent(in) :: part
            real(wp) :: start(4)

            associate (a => work%answers(part - 1), b => work%answers(part), link => beam%links(part))
                start = [a%deflection, (b%deflection - a%deflection)/link%length, a%moment_right, &
                         (b%moment_left - a%moment_right)/link%length]
                ! Rotations and shears as they are without load: shear lets deflections differ from v, the chord from the rotation
                start(2) = start(2) - ground%pieces(j)%shear_flexibility*start(4) &
                    + ground%pieces(j)%flexibility*link%length*(2*a%moment_right + b%moment_left)/6
                start(1) = start(1) - ground%pieces(j)%shear_flexibility*a%moment_right
            end associate
        end function start_of

        !> Piece of its law on which a layer is in the middle of a part
        pure function acts_between(layer, piece, part) result(law)
            type(layer_type), intent(in) :: layer
            integer, intent(in) :: piece, part
            integer :: law
            real(wp) :: w

            associate (a => work%answers(node(piece - 1) + part - 1), b => work%answers(node(piece - 1) + part))
                w = a%deflection + (b%deflection - a%deflection)/2
            end associate
            associate (length => ground%pieces(piece)%length)
                law = piece_of_deflection(ground%laws, layer, w, between(0.0_wp, length, 2*part - 1, 2*parts(piece)), length)
            end associate
        end function acts_between

        !> Does the beam press a layer at an end of a part
        pure function presses(layer, piece, part)
            type(layer_type), intent(in) :: layer
            integer, intent(in) :: piece, part
            logical :: presses

            presses = layer%side*(work%answers(node(piece - 1) + part)%deflection &
                                  - line_of_kink(ground%laws, layer, 1, place(piece, part), ground%pieces(piece)%length)) > 0.0_wp
        end function presses

        !> Distance of an end of a part from the left end of its piece, steps exactly where they are
        pure function place(piece, part)
            integer, intent(in) :: piece, part
            real(wp) :: place

            if (mod(part, each) == 0) then
                place = between(0.0_wp, ground%pieces(piece)%length, part/each, parts(piece)/each)
            else
                place = between(0.0_wp, ground%pieces(piece)%length, part, parts(piece))
            end if
        end function place

    end subroutine read_zones

end module gapbeam_springs
