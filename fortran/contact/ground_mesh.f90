!> Mesh of a beam on the ground for the first search of zones of contact (gapbeam_ground_energy).
!> The beam is cut into parts, at whose ends the ground acts, finer and finer where zones end.
module gapbeam_ground_mesh
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: least_mesh_parts, most_first_parts, most_mesh_parts, mesh_cuts
    use gapbeam_tolerances, only: parts_of_decay, straight_force
    use gapbeam_layers, only: has_curves
    use gapbeam_ground_laws, only: between, piece_of_deflection, push_of_layer, slope_at
    use gapbeam_ground_steps, only: decays_between
    use gapbeam_ground, only: ground_type, steps_of_piece
    implicit none
    private
    public :: mesh_type, begin_mesh, refine_mesh, acts_at

    !> Parts of a beam, and its deflections
    type :: mesh_type
        !> Piece of the beam, and distances of the ends of the part from the left end of the piece, shape (m)
        integer, allocatable :: piece(:)
        real(wp), allocatable :: from(:), to(:)
        !> Node at the right end of every piece, shape (0:n)
        integer, allocatable :: node(:)
        !> Deflections of the nodes, moments left and right of them, shape (0:m); nothing yet if not solved
        real(wp), allocatable :: deflection(:), moment_left(:), moment_right(:)
        logical :: solved = .false.
    end type mesh_type

contains

    !> Parts as short as the stiffness of the ground asks for
    pure subroutine begin_mesh(ground, mesh)
        type(ground_type), intent(in) :: ground
        !> Not solved yet
        type(mesh_type), intent(out) :: mesh
        integer :: parts(size(ground%pieces)), i, j
        real(wp) :: whole, shortest

        whole = sum(ground%pieces%length)
        shortest = whole/merge(most_mesh_parts, most_first_parts, any(has_curves(ground%layers)))
        do j = 1, size(parts)
            ! As short under compression as series ask for
            parts(j) = steps_of_piece(ground, j)
            if (ground%first(j + 1) == ground%first(j)) cycle
            associate (p => ground%pieces(j))
                parts(j) = max(2, merge(parts(j), 1, p%compression > 0.0_wp), &
                               ceiling(min(max(parts_of_decay*decays_between(p, 0.0_wp, p%length, first_stiffness(j)), &
                                               least_mesh_parts*(p%length/whole)), p%length/shortest)))
            end associate
        end do
        allocate (mesh%piece(sum(parts)), mesh%from(sum(parts)), mesh%to(sum(parts)), mesh%node(0:size(parts)))
        mesh%node(0) = 0
        do j = 1, size(parts)
            mesh%node(j) = mesh%node(j - 1) + parts(j)
            mesh%piece(mesh%node(j - 1) + 1:mesh%node(j)) = j
            do i = 1, parts(j)
                mesh%from(mesh%node(j - 1) + i) = between(0.0_wp, ground%pieces(j)%length, i - 1, parts(j))
                mesh%to(mesh%node(j - 1) + i) = between(0.0_wp, ground%pieces(j)%length, i, parts(j))
            end do
        end do
        allocate (mesh%deflection(0:sum(parts)), mesh%moment_left(0:sum(parts)), mesh%moment_right(0:sum(parts)), source=0.0_wp)

    contains

        !> Stiffness of all ground under a piece as it begins to act
        pure function first_stiffness(piece) result(stiffness)
            integer, intent(in) :: piece
            real(wp) :: stiffness
            integer :: k

            stiffness = 0.0_wp
            do k = ground%first(piece), ground%first(piece + 1) - 1
                associate (layer => ground%layers(k), length => ground%pieces(piece)%length)
                    stiffness = stiffness + max(slope_at(layer, ground%laws, 1, 0.0_wp, length, layer%contact_a), &
                                                slope_at(layer, ground%laws, 1, length, length, layer%contact_b))
                end associate
            end do
        end function first_stiffness

    end subroutine begin_mesh

    !> Shorter parts where zones end or curves bend, and where the ground has become stiffer; everywhere where the mesh could not be
    !> solved
    pure subroutine refine_mesh(ground, mesh, only_stiffer, refined)
        type(ground_type), intent(in) :: ground
        !> With deflections in between as they were
        type(mesh_type), intent(inout) :: mesh
        !> Only where the ground has become stiffer
        logical, intent(in) :: only_stiffer
        !> Are there any more parts now
        logical, intent(out) :: refined
        integer :: into(size(mesh%piece)), i, k, m
        logical :: changes(0:size(mesh%piece) + 1)

        m = size(mesh%piece)
        changes(:) = .false.
        do i = 1, m
            do k = ground%first(mesh%piece(i)), ground%first(mesh%piece(i) + 1) - 1
                if (acts_at(ground, mesh, k, i, 1) /= acts_at(ground, mesh, k, i, 2)) changes(i) = .true.
            end do
        end do
        do i = 1, m
            into(i) = max(1, min(mesh_cuts, ceiling(parts_of_decay/2*decays_between(ground%pieces(mesh%piece(i)), mesh%from(i), &
                                                                                   mesh%to(i), stiffness_in(i)))))
            if ((any(changes(i - 1:i + 1)) .or. bends(i)) .and. .not. only_stiffer) into(i) = mesh_cuts
            ! Where nothing is known, everywhere
            if (.not. mesh%solved) into(i) = mesh_cuts
            if (ground%first(mesh%piece(i) + 1) == ground%first(mesh%piece(i))) into(i) = 1
        end do
        refined = any(into > 1) .and. sum(into) <= most_mesh_parts*2
        if (refined) call split(into, mesh)

    contains

        !> Is the force of a curve along a part other than straight between its ends, as where the beam goes far beyond a short
        !> stretch in which its force grows
        pure function bends(part)
            integer, intent(in) :: part
            logical :: bends
            real(wp) :: force(0:2), place, w
            integer :: k, t

            bends = .false.
            associate (from => mesh%from(part), to => mesh%to(part), j => mesh%piece(part))
                do k = ground%first(j), ground%first(j + 1) - 1
                    if (.not. has_curves(ground%layers(k))) cycle
                    do t = 0, 2
                        place = between(from, to, t, 2)
                        w = between(mesh%deflection(part - 1), mesh%deflection(part), t, 2)
                        associate (acts => piece_of_deflection(ground%laws, ground%layers(k), w, place, ground%pieces(j)%length))
                            force(t) = push_of_layer(ground%layers(k), ground%laws, acts, place, ground%pieces(j)%length, w)
                        end associate
                    end do
                    bends = bends .or. abs(force(1) - (force(0) + force(2))/2) > straight_force*maxval(abs(force))
                end do
            end associate
        end function bends

        !> Stiffness of all ground at the ends of a part, the greater one
        pure function stiffness_in(part) result(stiffness)
            integer, intent(in) :: part
            real(wp) :: stiffness, at(2)
            integer :: k, end

            at(:) = 0.0_wp
            do end = 1, 2
                do k = ground%first(mesh%piece(part)), ground%first(mesh%piece(part) + 1) - 1
                    at(end) = at(end) + slope_at(ground%layers(k), ground%laws, acts_at(ground, mesh, k, part, end), &
                                                 merge(mesh%from(part), mesh%to(part), end == 1), &
                                                 ground%pieces(mesh%piece(part))%length, mesh%deflection(part + end - 2))
                end do
            end do
            stiffness = maxval(at)
        end function stiffness_in

    end subroutine refine_mesh

    !> The piece of its law on which a layer is at an end of a part
    pure function acts_at(ground, mesh, k, part, end) result(acts)
        type(ground_type), intent(in) :: ground
        type(mesh_type), intent(in) :: mesh
        !> The layer; the part; 1 left, 2 right
        integer, intent(in) :: k, part, end
        integer :: acts

        acts = 1
        if (ground%layers(k)%side == 0) return
        acts = piece_of_deflection(ground%laws, ground%layers(k), mesh%deflection(part + end - 2), &
                                   merge(mesh%from(part), mesh%to(part), end == 1), ground%pieces(mesh%piece(part))%length)
    end function acts_at

    !> Cut every part into so many equal ones
    pure subroutine split(into, mesh)
        integer, intent(in) :: into(:)
        type(mesh_type), intent(inout) :: mesh
        type(mesh_type) :: found
        integer :: i, k, m

        m = sum(into)
        allocate (found%piece(m), found%from(m), found%to(m), found%node(0:ubound(mesh%node, 1)), found%deflection(0:m), &
                  found%moment_left(0:m), found%moment_right(0:m))
        found%solved = mesh%solved
        found%node(0) = 0
        found%deflection(0) = mesh%deflection(0)
        found%moment_left(0) = mesh%moment_left(0)
        m = 0
        do i = 1, size(into)
            do k = 1, into(i)
                m = m + 1
                found%piece(m) = mesh%piece(i)
                found%from(m) = between(mesh%from(i), mesh%to(i), k - 1, into(i))
                found%to(m) = between(mesh%from(i), mesh%to(i), k, into(i))
                found%deflection(m) = between(mesh%deflection(i - 1), mesh%deflection(i), k, into(i))
            end do
            found%node(mesh%piece(i)) = m
        end do
        found%moment_left(:) = 0.0_wp
        found%moment_right(:) = 0.0_wp
        mesh = found
    end subroutine split

end module gapbeam_ground_mesh
