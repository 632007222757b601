!> Forces and slopes of the ground at the nodes of a mesh, and the links of the beam between them.
!>
!> The ground acts at a node on half of the parts of the mesh beside it, by the laws of its layers there.
module gapbeam_ground_nodes
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: no_node_slope
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_taper, only: part_of_piece
    use gapbeam_band, only: plain
    use gapbeam_model, only: beam_type, take_supports
    use gapbeam_ground_laws, only: along, piece_of_deflection, push_of_layer, slope_at
    use gapbeam_foundation_stretch, only: stretch_between, stretch_load_type
    use gapbeam_ground, only: ground_type, condense_both
    use gapbeam_stretch_loads, only: add_end_loads, load_on_part, on_stretch, ends_of_piece
    use gapbeam_ground_mesh, only: mesh_type
    implicit none
    private
    public :: point_type, press, list_points, make_beam

    !> Where the ground acts: at a node, on a length of a piece of the beam
    type :: point_type
        integer :: node, piece
        !> Distance from the left end of the piece, and the length that belongs to it
        real(wp) :: place, width
    end type point_type

contains

    !> Force and slope of the ground at the nodes
    pure subroutine press(ground, points, w, push, slope, pressed, full)
        type(ground_type), intent(in) :: ground
        type(point_type), intent(in) :: points(:)
        !> Deflections
        real(wp), intent(in) :: w(0:)
        !> Up, and how it grows downwards
        real(wp), intent(out) :: push(0:), slope(0:)
        !> Nodes at which ground that acts one way is pressed
        integer, intent(out) :: pressed
        !> As if all layers acted, on the first piece of their law as it begins; default no
        logical, intent(in), optional :: full
        real(wp) :: steepest(0:ubound(w, 1)), contact
        logical :: all_act, presses
        integer :: i, k, acts

        all_act = .false.
        if (present(full)) all_act = full
        push(:) = 0.0_wp
        slope(:) = 0.0_wp
        steepest(:) = 0.0_wp
        pressed = 0
        do i = 1, size(points)
            presses = .false.
            associate (p => points(i), length => ground%pieces(points(i)%piece)%length)
                do k = ground%first(p%piece), ground%first(p%piece + 1) - 1
                    associate (layer => ground%layers(k), at => w(p%node))
                        contact = along(layer%contact_a, layer%contact_b, p%place, length)
                        steepest(p%node) = max(steepest(p%node), &
                                               p%width*slope_at(layer, ground%laws, 1, p%place, length, contact))
                        if (all_act) then
                            slope(p%node) = slope(p%node) + p%width*slope_at(layer, ground%laws, 1, p%place, length, contact)
                            push(p%node) = push(p%node) &
                                + p%width*slope_at(layer, ground%laws, 1, p%place, length, contact)*(at - contact)
                            cycle
                        end if
                        acts = 1
                        if (layer%side /= 0) acts = piece_of_deflection(ground%laws, layer, at, p%place, length)
                        if (acts == 0) cycle
                        presses = presses .or. layer%side /= 0
                        push(p%node) = push(p%node) + p%width*push_of_layer(layer, ground%laws, acts, p%place, length, at)
                        slope(p%node) = slope(p%node) + p%width*slope_at(layer, ground%laws, acts, p%place, length, at)
                    end associate
                end do
            end associate
            if (presses) pressed = pressed + 1
        end do
        where (slope <= no_node_slope*maxval(steepest)) slope = 0.0_wp
    end subroutine press

    !> Where the ground acts
    pure subroutine list_points(ground, mesh, points)
        type(ground_type), intent(in) :: ground
        type(mesh_type), intent(in) :: mesh
        type(point_type), allocatable, intent(out) :: points(:)
        integer :: i, m

        allocate (points(2*size(mesh%piece)))
        m = 0
        do i = 1, size(mesh%piece)
            if (ground%first(mesh%piece(i) + 1) == ground%first(mesh%piece(i))) cycle
            associate (width => (mesh%to(i) - mesh%from(i))/2)
                if (mesh%from(i) > 0.0_wp .and. m > 0) then
                    points(m)%width = points(m)%width + width
                else
                    m = m + 1
                    points(m) = point_type(i - 1, mesh%piece(i), mesh%from(i), width)
                end if
                m = m + 1
                points(m) = point_type(i, mesh%piece(i), mesh%to(i), width)
            end associate
        end do
        points = points(:m)
    end subroutine list_points

    !> The beam cut into the parts of the mesh, with its supports
    pure subroutine make_beam(ground, mesh, beam)
        type(ground_type), intent(in) :: ground
        type(mesh_type), intent(in) :: mesh
        type(beam_type), intent(out) :: beam
        type(piece_type) :: p(1)
        type(stretch_load_type) :: loads(2)
        real(wp) :: work(1)
        integer :: i, n

        n = size(mesh%piece)
        allocate (beam%links(n))
        allocate (beam%kind(0:n), source=plain)
        allocate (beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n), source=0.0_wp)
        beam%kind(mesh%node) = ground%beam%kind
        beam%compliance(mesh%node) = ground%beam%compliance
        beam%force(:, mesh%node) = ground%beam%force
        beam%couple(:, mesh%node) = ground%beam%couple
        do i = 1, n
            p = part_of_piece(ground%pieces(mesh%piece(i)), mesh%from(i), mesh%to(i))
            call condense_link(p, [on_part(ground%dead, i)], [on_part(ground%live, i)], work, beam%links(i))
        end do
        if (any(max(abs(ground%pieces%tension), abs(ground%pieces%tension_change)) > 0.0_wp)) then
            allocate (beam%ground(n))
            do i = 1, n
                loads = [on_stretch(on_part(ground%dead, i)), on_stretch(on_part(ground%live, i))]
                call condense_both(stretch_between(ground%pieces(mesh%piece(i)), mesh%from(i), mesh%to(i)), loads(1), loads(2), &
                                   beam%links(i), beam%ground(i))
                call add_end_loads(beam%ground(i), loads, beam%links(i))
            end do
        end if
        call take_supports(ground%beam, mesh%node, beam)
        beam%watch = ground%beam%watch

    contains

        !> The load on a part
        pure function on_part(loads, i) result(found)
            !> Of all pieces
            type(piece_load_type), intent(in) :: loads(:)
            integer, intent(in) :: i
            type(piece_load_type) :: found

            associate (j => mesh%piece(i))
                found = load_on_part(loads(j), mesh%from(i), mesh%to(i), ground%pieces(j)%length, ends_of_piece(mesh%piece, i))
            end associate
        end function on_part

    end subroutine make_beam

end module gapbeam_ground_nodes
