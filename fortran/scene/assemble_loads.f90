!> Assembly of the loads and links of a model whose points and nodes are known.
module gapbeam_assemble_loads
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_link, only: condense_link, piece_load_type, no_load
    use gapbeam_piece, only: is_tapered
    use gapbeam_range, only: first_lost_link
    use gapbeam_axial_force, only: in_stretches
    use gapbeam_scene, only: load_type, gapbeam_force, gapbeam_curvature, gapbeam_linear_curvature, &
        gapbeam_temperature, gapbeam_support_rotation, gapbeam_couple_left, gapbeam_dead
    use gapbeam_fingerprint, only: fingerprint
    use gapbeam_assembled_model, only: assembled_type, is_along, is_movement, is_stretch, is_beside_point
    use gapbeam_assemble_laws, only: depends_on_path
    use gapbeam_assemble_axial, only: assemble_axial
    use gapbeam_assemble_foundations, only: assemble_foundations
    use gapbeam_check_rigid_ground, only: check_rigid_ground
    use gapbeam_assemble_units, only: change_units, load_in_units, refuse_link
    use gapbeam_input_error, only: refuse, of_loads, bad_load
    implicit none
    private
    public :: assemble_loads, find_loaded, put_load

contains

    !> Loads of all pieces and nodes from the model's loads, units, and the links; all places are known
    subroutine assemble_loads(assembled, error)
        !> Points, nodes and supports in
        type(assembled_type), intent(inout) :: assembled
        !> Numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: work(:)
        integer :: i, first, stat

        allocate (work(size(assembled%pieces)), stat=stat)
        if (failed(stat, error)) return
        assembled%fingerprint = fingerprint(assembled%model)
        call sum_loads(assembled)
        call assemble_foundations(assembled, error)
        if (.not. allocated(error)) call check_rigid_ground(assembled, error)
        if (allocated(error)) return
        call change_units(assembled, error)
        if (.not. allocated(error)) call check_together(assembled, error)
        if (.not. allocated(error)) call assemble_axial(assembled, error)
        if (allocated(error)) return
        associate (links => assembled%beam%links)
            first = 1
            do i = 1, size(links)
                associate (last => assembled%node_point(i))
                    call condense_link(assembled%pieces(first:last), assembled%dead(first:last), assembled%live(first:last), &
                                       work, links(i))
                    first = last + 1
                end associate
            end do
            i = first_lost_link(assembled%pieces, links, assembled%node_point(1:size(links)))
        end associate
        if (i /= 0) call refuse_link(assembled, i, error)
        if (.not. allocated(error)) assembled%depends_on_path = depends_on_path(assembled)
    end subroutine assemble_loads

    !> Refuse to turn a support where another one holds the rotation as well, and curvatures that change along tapered sections
    subroutine check_together(assembled, error)
        type(assembled_type), intent(in) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        do k = 1, size(assembled%model%loads)
            associate (load => assembled%model%loads(k), point => assembled%support_point)
                if (load%kind == gapbeam_linear_curvature) then
                    if (in_stretches(assembled%model)) cycle
                    if (.not. any(is_tapered(assembled%pieces(assembled%load_from(k) + 1:assembled%load_to(k))))) cycle
                    call refuse(error, of_loads, k, size(assembled%model%loads), bad_load, "value_to", "a curvature that "// &
                                "changes along a section that tapers is not available in this version; give short ones")
                    return
                end if
                if (load%kind /= gapbeam_support_rotation) cycle
                if (count(point == point(load%node) .and. assembled%model%supports%rotation > 0.0_wp) < 2) cycle
                call refuse(error, of_loads, k, size(assembled%model%loads), bad_load, "support", "another support at its "// &
                            "place holds the rotation of the beam, too; leave one of them out")
                return
            end associate
        end do
    end subroutine check_together

    !> Sums of the loads on all pieces and nodes in the user's units
    pure subroutine sum_loads(assembled)
        type(assembled_type), intent(inout) :: assembled
        integer :: i, k, first, last, node

        assembled%dead(:) = no_load
        assembled%live(:) = no_load
        assembled%beam%force(:, :) = 0.0_wp
        assembled%beam%couple(:, :) = 0.0_wp
        do i = 1, size(assembled%model%loads)
            call find_loaded(assembled, i, first, last, node)
            associate (load => assembled%model%loads(i), force => assembled%beam%force, couple => assembled%beam%couple)
                k = merge(1, 2, load%case == gapbeam_dead)
                if (node >= 0 .and. load%kind == gapbeam_force) then
                    force(k, node) = force(k, node) + load%value
                else if (node >= 0) then
                    couple(k, node) = couple(k, node) + load%value
                else if (k == 1) then
                    call put_on_pieces(assembled, i, first, last, assembled%dead)
                else
                    call put_on_pieces(assembled, i, first, last, assembled%live)
                end if
            end associate
        end do
    end subroutine sum_loads

    !> Put a load on the pieces on which it acts
    pure subroutine put_on_pieces(assembled, k, first, last, piece_loads)
        !> As for find_loaded
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: k, first, last
        !> Of all pieces
        type(piece_load_type), intent(inout) :: piece_loads(:)

        if (first > last) return
        associate (load => assembled%model%loads(k))
            if (is_stretch(load)) then
                call spread_load(assembled, load, first - 1, last, piece_loads)
            else if (is_beside_point(load)) then
                call put_beside(load, assembled%load_from(k), piece_loads)
            else if (load%kind == gapbeam_force) then
                piece_loads(first)%force = piece_loads(first)%force + load%value
            else
                piece_loads(first)%couple = piece_loads(first)%couple + load%value
            end if
        end associate
    end subroutine put_on_pieces

    !> Put a load that acts on the ends of the pieces beside its point on these
    pure subroutine put_beside(load, point, piece_loads)
        type(load_type), intent(in) :: load
        integer, intent(in) :: point
        !> Of all pieces
        type(piece_load_type), intent(inout) :: piece_loads(:)

        select case (load%kind)
        case (gapbeam_support_rotation)
            if (point > 0) piece_loads(point)%kink_b = piece_loads(point)%kink_b - load%value
            if (point < size(piece_loads)) piece_loads(point + 1)%kink_a = piece_loads(point + 1)%kink_a + load%value
        case (gapbeam_couple_left)
            piece_loads(point)%couple_b = piece_loads(point)%couple_b + load%value
        case default
            piece_loads(point + 1)%couple_a = piece_loads(point + 1)%couple_a + load%value
        end select
    end subroutine put_beside

    !> Where a load acts across the beam
    pure subroutine find_loaded(assembled, k, first, last, node)
        type(assembled_type), intent(in) :: assembled
        !> Its number
        integer, intent(in) :: k
        !> On which pieces, last before first if on none; at which node, -1 at none
        integer, intent(out) :: first, last, node

        associate (load => assembled%model%loads(k), a => assembled%load_from(k))
            first = a + 1
            last = assembled%load_to(k)
            node = -1
            if (is_stretch(load) .and. .not. is_along(load)) return
            last = a
            if (is_beside_point(load)) then
                first = max(1, a)
                last = min(size(assembled%pieces), a + 1)
                return
            end if
            if (is_along(load) .or. is_movement(load)) return
            node = assembled%node_of_point(a)
            if (node < 0) first = a
        end associate
    end subroutine find_loaded

    !> Put a load with factor 1 on the pieces that it acts on, in the engine's units
    pure subroutine put_load(assembled, k, first, last, node, on_pieces)
        !> As for find_loaded
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: k
        integer, intent(out) :: first, last, node
        !> Of all pieces, without loads in
        type(piece_load_type), intent(inout) :: on_pieces(:)

        call find_loaded(assembled, k, first, last, node)
        call put_on_pieces(assembled, k, first, last, on_pieces)
        call load_in_units(on_pieces(first:last), assembled%units)
    end subroutine put_load

    !> A distributed load or an imposed curvature, from point a to point b, on the pieces between
    pure subroutine spread_load(assembled, load, a, b, piece_loads)
        type(assembled_type), intent(in) :: assembled
        type(load_type), intent(in) :: load
        integer, intent(in) :: a, b
        type(piece_load_type), intent(inout) :: piece_loads(:)
        real(wp) :: whole
        integer :: j

        if (load%kind == gapbeam_curvature .or. load%kind == gapbeam_temperature) then
            piece_loads(a + 1:b)%kappa = piece_loads(a + 1:b)%kappa + load%value
        else if (load%kind == gapbeam_linear_curvature) then
            whole = distance(b)
            do j = a + 1, b
                piece_loads(j)%kappa = piece_loads(j)%kappa + between(distance(j - 1)/whole)
                piece_loads(j)%rise = piece_loads(j)%rise + (load%value_to - load%value)*((distance(j) - distance(j - 1))/whole)
            end do
        else if (abs(load%value - load%value_to) <= 0.0_wp) then
            piece_loads(a + 1:b)%qa = piece_loads(a + 1:b)%qa + load%value
            piece_loads(a + 1:b)%qb = piece_loads(a + 1:b)%qb + load%value
        else
            whole = distance(b)
            do j = a + 1, b
                piece_loads(j)%qa = piece_loads(j)%qa + between(distance(j - 1)/whole)
                piece_loads(j)%qb = piece_loads(j)%qb + between(distance(j)/whole)
            end do
        end if

    contains

        !> Distance of a point from the left end of the load
        pure function distance(point) result(x)
            integer, intent(in) :: point
            real(wp) :: x

            associate (ends => assembled%ends, span => assembled%point_span, offset => assembled%point_offset)
                x = (ends(span(point)) - ends(span(a))) + (offset(point) - offset(a))
            end associate
        end function distance

        !> Value of the load at a share of its length
        pure function between(share) result(value)
            real(wp), intent(in) :: share
            real(wp) :: value

            value = load%value*(1 - share) + load%value_to*share
        end function between

    end subroutine spread_load

end module gapbeam_assemble_loads
