!> Loads of a model whose points and nodes are known, and with them the links: everything as the engine takes it
module gapbeam_lower_loads
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_link, only: condense_link, piece_load_type
    use gapbeam_range, only: first_lost_link
    use gapbeam_scene, only: load_type, gapbeam_force, gapbeam_axial_force, gapbeam_curvature, gapbeam_dead
    use gapbeam_lowered, only: lowered_type, fingerprint, is_stretch
    use gapbeam_lower_laws, only: depends_on_path
    use gapbeam_lower_axial, only: lower_axial
    use gapbeam_lower_foundations, only: lower_foundations
    use gapbeam_lower_units, only: change_units, refuse_link
    implicit none
    private
    public :: lower_loads, spread_load

contains

    !> Loads of all pieces and nodes from the model's loads, units, and the links; all places are known
    subroutine lower_loads(lowered, error)
        !> Points, nodes and supports in
        type(lowered_type), intent(inout) :: lowered
        !> Numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: work(:)
        integer :: i, first, stat

        allocate (work(size(lowered%pieces)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        lowered%fingerprint = fingerprint(lowered%model)
        call sum_loads(lowered)
        call lower_foundations(lowered, error)
        if (allocated(error)) return
        call change_units(lowered, error)
        if (.not. allocated(error)) call lower_axial(lowered, error)
        if (allocated(error)) return
        associate (links => lowered%beam%links)
            first = 1
            do i = 1, size(links)
                associate (last => lowered%node_point(i))
                    call condense_link(lowered%pieces(first:last), lowered%dead(first:last), lowered%live(first:last), &
                                       work, links(i))
                    first = last + 1
                end associate
            end do
            i = first_lost_link(lowered%pieces, links, lowered%node_point(1:size(links)))
        end associate
        if (i /= 0) call refuse_link(lowered, i, error)
        if (.not. allocated(error)) lowered%depends_on_path = depends_on_path(lowered)
    end subroutine lower_loads

    !> Sums of the loads on all pieces and nodes in the user's units
    pure subroutine sum_loads(lowered)
        type(lowered_type), intent(inout) :: lowered
        integer :: i, k

        call clear(lowered%dead)
        call clear(lowered%live)
        lowered%beam%force(:, :) = 0.0_wp
        lowered%beam%couple(:, :) = 0.0_wp
        do i = 1, size(lowered%model%loads)
            associate (load => lowered%model%loads(i), a => lowered%load_from(i), b => lowered%load_to(i))
                k = merge(1, 2, load%case == gapbeam_dead)
                if (load%kind == gapbeam_axial_force) then
                    cycle
                else if (.not. is_stretch(load)) then
                    call add_at_point(lowered, load, a, k)
                else if (k == 1) then
                    call spread_load(lowered, load, a, b, lowered%dead)
                else
                    call spread_load(lowered, load, a, b, lowered%live)
                end if
            end associate
        end do
    end subroutine sum_loads

    !> A force or couple: at a node, or at the right end of the piece before
    pure subroutine add_at_point(lowered, load, point, case)
        type(lowered_type), intent(inout) :: lowered
        type(load_type), intent(in) :: load
        integer, intent(in) :: point, case
        integer :: node

        node = lowered%node_of_point(point)
        if (node >= 0 .and. load%kind == gapbeam_force) then
            lowered%beam%force(case, node) = lowered%beam%force(case, node) + load%value
        else if (node >= 0) then
            lowered%beam%couple(case, node) = lowered%beam%couple(case, node) + load%value
        else if (case == 1) then
            call add_to_piece(lowered%dead(point), load)
        else
            call add_to_piece(lowered%live(point), load)
        end if
    end subroutine add_at_point

    !> No load
    elemental subroutine clear(load)
        type(piece_load_type), intent(out) :: load

        load = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
    end subroutine clear

    !> A force or couple at the right end of a piece
    elemental subroutine add_to_piece(piece_load, load)
        type(piece_load_type), intent(inout) :: piece_load
        type(load_type), intent(in) :: load

        if (load%kind == gapbeam_force) then
            piece_load%force = piece_load%force + load%value
        else
            piece_load%couple = piece_load%couple + load%value
        end if
    end subroutine add_to_piece

    !> A distributed load or an imposed curvature, from point a to point b, on the pieces between
    pure subroutine spread_load(lowered, load, a, b, piece_loads)
        type(lowered_type), intent(in) :: lowered
        type(load_type), intent(in) :: load
        integer, intent(in) :: a, b
        type(piece_load_type), intent(inout) :: piece_loads(:)
        real(wp) :: whole
        integer :: j

        if (load%kind == gapbeam_curvature) then
            piece_loads(a + 1:b)%kappa = piece_loads(a + 1:b)%kappa + load%value
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

            associate (ends => lowered%ends, span => lowered%point_span, offset => lowered%point_offset)
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

end module gapbeam_lower_loads
