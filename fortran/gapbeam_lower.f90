!> From what a user describes to the engine's arrays.
!>
!> The beam is cut into pieces wherever anything changes: at span ends, supports, hinges, point loads and the ends of
!> distributed loads. Only beam ends, supports across the beam and hinges become nodes of the system; the pieces between two
!> nodes are condensed into one link. python/gapbeam/lowering.py does the same for scenes.
module gapbeam_lower
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_link, only: condense_link, piece_load_type => load_type
    use gapbeam_scene, only: load_type, gapbeam_by_x, gapbeam_axial, gapbeam_force, gapbeam_couple, gapbeam_distributed, &
        gapbeam_curvature, gapbeam_axial_force, gapbeam_dead
    use gapbeam_lowered, only: lowered_type, fingerprint
    use gapbeam_places, only: place_span_ends, locate, merge_places
    use gapbeam_check, only: check_spans, check_rest, check_loads, refuse, of_hinges, of_loads
    use gapbeam_lower_supports, only: lower_supports
    implicit none
    private
    public :: lower_model, lower_loads

    !> Models whose lengths or forces are beyond two to this power are solved in other units
    integer, parameter :: ordinary_exponent = 64

contains

    !> Lower the model that is already in `lowered`, with all its arrays allocated
    subroutine lower_model(lowered, error)
        !> The model in, everything out
        type(lowered_type), intent(inout) :: lowered
        !> Bad input, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: stat, n

        associate (model => lowered%model)
            call check_spans(model%spans, error)
            if (allocated(error)) return
            n = size(model%spans)
            allocate (lowered%ends(0:n), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            call place_span_ends(model%spans, lowered%ends)
            call check_rest(model, lowered%ends, error)
            if (allocated(error)) return
            call check_loads(model%loads, lowered%ends, any(model%supports%direction == gapbeam_axial), error)
            if (allocated(error)) return
        end associate
        call find_points(lowered, error)
        if (allocated(error)) return
        call cut_pieces(lowered, error)
        if (allocated(error)) return
        call lower_supports(lowered, error)
        if (allocated(error)) return
        call lower_loads(lowered, error)
    end subroutine lower_model

    !> Points between the pieces, and the points of supports, hinges and loads
    subroutine find_points(lowered, error)
        type(lowered_type), intent(inout) :: lowered
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: span(:), order(:), chosen(:), point(:)
        real(wp), allocatable :: offset(:)
        integer(int64) :: total
        integer :: stat, at, i, n, number

        associate (model => lowered%model)
            n = size(model%spans)
            total = 1_int64 + n + size(model%supports) + size(model%hinges) + 2_int64*size(model%loads)
            stat = merge(1, 0, 2*total > huge(0))
            if (stat == 0) allocate (span(total), order(total), chosen(total), point(total), offset(total), stat=stat)
            if (stat == 0) allocate (lowered%end_point(0:n), lowered%support_point(size(model%supports)), &
                                     lowered%load_from(size(model%loads)), lowered%load_to(size(model%loads)), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            at = 0
            do i = 0, n
                call add(0.0_wp, i)
            end do
            do i = 1, size(model%supports)
                call add(model%supports(i)%x, model%supports(i)%node)
            end do
            do i = 1, size(model%hinges)
                call add(model%hinges(i), gapbeam_by_x)
            end do
            do i = 1, size(model%loads)
                associate (load => model%loads(i))
                    call add(load%x, merge(gapbeam_by_x, load%node, is_stretch(load)))
                    call add(merge(load%to, load%x, is_stretch(load)), merge(gapbeam_by_x, load%node, is_stretch(load)))
                end associate
            end do
            at = 1 + n + size(model%supports) + size(model%hinges)
            call merge_places(lowered%ends, span, offset, at, order, chosen, point, number)
            allocate (lowered%point_span(0:number - 1), lowered%point_offset(0:number - 1), lowered%hinged(0:number - 1), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            do i = 1, number
                lowered%point_span(i - 1) = span(chosen(i))
                lowered%point_offset(i - 1) = offset(chosen(i))
            end do
            lowered%end_point(0:n) = point(1:n + 1)
            at = n + 1
            lowered%support_point(:) = point(at + 1:at + size(model%supports))
            at = at + size(model%supports)
            call find_hinges(point(at + 1:at + size(model%hinges)))
            if (allocated(error)) return
            at = at + size(model%hinges)
            do i = 1, size(model%loads)
                lowered%load_from(i) = point(at + 2*i - 1)
                lowered%load_to(i) = point(at + 2*i)
                if (is_stretch(model%loads(i)) .and. lowered%load_from(i) >= lowered%load_to(i)) then
                    call refuse(error, of_loads, i, size(model%loads), "its stretch has no length; from must be less than to")
                else if (model%loads(i)%kind == gapbeam_couple .and. lowered%hinged(lowered%load_from(i))) then
                    call refuse(error, of_loads, i, size(model%loads), "the couple acts exactly at a hinge, so it is open "// &
                                "which side takes it; put it on one side of the hinge")
                end if
                if (allocated(error)) return
            end do
        end associate

    contains

        !> Note a place by node or x
        subroutine add(x, node)
            real(wp), intent(in) :: x
            integer, intent(in) :: node

            at = at + 1
            if (node == gapbeam_by_x) then
                call locate(x, lowered%ends, span(at), offset(at))
            else
                span(at) = node
                offset(at) = 0.0_wp
            end if
        end subroutine add

        !> Mark the hinges
        subroutine find_hinges(points)
            integer, intent(in) :: points(:)
            integer :: k

            lowered%hinged(:) = .false.
            do k = 1, size(points)
                if (lowered%hinged(points(k))) then
                    call refuse(error, of_hinges, k, size(points), "there is a hinge at this place already; remove one of them")
                end if
                if (allocated(error)) return
                lowered%hinged(points(k)) = .true.
            end do
        end subroutine find_hinges

    end subroutine find_points

    !> Does a load act over a stretch
    elemental function is_stretch(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = load%kind == gapbeam_distributed .or. load%kind == gapbeam_curvature
    end function is_stretch

    !> Length and flexibilities of every piece, and the engine's units
    subroutine cut_pieces(lowered, error)
        type(lowered_type), intent(inout) :: lowered
        type(error_type), allocatable, intent(out) :: error
        integer :: stat, j, n

        n = ubound(lowered%point_span, 1)
        allocate (lowered%pieces(n), lowered%axial_flexibility(n), lowered%dead(n), lowered%live(n), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        do j = 1, n
            associate (s => lowered%point_span(j - 1), offset => lowered%point_offset, p => lowered%pieces(j), &
                       span => lowered%model%spans(lowered%point_span(j - 1) + 1))
                if (lowered%point_span(j) == s) then
                    p%length = offset(j) - offset(j - 1)
                else
                    p%length = span%length - offset(j - 1)
                end if
                p%flexibility = 1/span%EI
                p%shear_flexibility = 1/span%GA
                lowered%axial_flexibility(j) = 1/span%EA
            end associate
        end do
        call choose_units(lowered)
        associate (l => lowered%length_exponent, f => lowered%force_exponent, p => lowered%pieces)
            if (l /= 0 .or. f /= 0) then
                p%length = scale(p%length, -l)
                p%flexibility = scale(p%flexibility, f + 2*l)
                p%shear_flexibility = scale(p%shear_flexibility, f)
            end if
        end associate
    end subroutine cut_pieces

    !> Powers of two near the mean span and the median bending stiffness, where these are far from 1; products such as
    !> stiffness * flexibility * length**2 might otherwise leave the range of doubles
    pure subroutine choose_units(lowered)
        type(lowered_type), intent(inout) :: lowered
        integer :: length, force, j, half
        integer :: histogram(minexponent(1.0_wp) - digits(1.0_wp):maxexponent(1.0_wp))

        length = exponent(lowered%ends(ubound(lowered%ends, 1))/ubound(lowered%ends, 1))
        histogram = 0
        do j = 1, size(lowered%pieces)
            associate (flexibility => lowered%pieces(j)%flexibility)
                if (flexibility > 0.0_wp) histogram(exponent(flexibility)) = histogram(exponent(flexibility)) + 1
            end associate
        end do
        half = (sum(histogram) + 1)/2
        force = 0
        do j = lbound(histogram, 1), ubound(histogram, 1)
            half = half - histogram(j)
            if (half <= 0 .and. histogram(j) > 0) then
                force = -j - 2*length
                exit
            end if
        end do
        if (max(abs(length), abs(force)) > ordinary_exponent) then
            lowered%length_exponent = length
            lowered%force_exponent = force
        end if
    end subroutine choose_units

    !> Loads of all pieces and nodes from the model's loads, and the links; all places are known
    subroutine lower_loads(lowered, error)
        type(lowered_type), intent(inout) :: lowered
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: work(:)
        integer :: i, k, first, stat

        allocate (work(size(lowered%pieces)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        lowered%fingerprint = fingerprint(lowered%model)
        call clear(lowered%dead)
        call clear(lowered%live)
        associate (beam => lowered%beam, axial => lowered%axial)
            beam%force(:, :) = 0.0_wp
            beam%couple(:, :) = 0.0_wp
            if (allocated(axial%force)) axial%force(:, :) = 0.0_wp
            do i = 1, size(lowered%model%loads)
                associate (load => lowered%model%loads(i), a => lowered%load_from(i), b => lowered%load_to(i))
                    k = merge(1, 2, load%case == gapbeam_dead)
                    if (load%kind == gapbeam_axial_force) then
                        call add_axial(a, k, load%value)
                    else if (.not. is_stretch(load)) then
                        call add_at_point(load, a, k)
                    else if (k == 1) then
                        call spread_load(lowered, load, a, b, lowered%dead)
                    else
                        call spread_load(lowered, load, a, b, lowered%live)
                    end if
                end associate
            end do
            call change_units(lowered)
            first = 1
            do i = 1, size(beam%links)
                associate (last => lowered%node_point(i))
                    call condense_link(lowered%pieces(first:last), lowered%dead(first:last), lowered%live(first:last), &
                                       work, beam%links(i))
                    first = last + 1
                end associate
            end do
        end associate

    contains

        !> A force along the beam
        subroutine add_axial(point, case, value)
            integer, intent(in) :: point, case
            real(wp), intent(in) :: value
            integer :: low, high, middle

            associate (points => lowered%axial%point, force => lowered%axial%force)
                low = 0
                high = ubound(points, 1)
                do while (low < high)
                    middle = low + (high - low)/2
                    if (points(middle) < point) then
                        low = middle + 1
                    else
                        high = middle
                    end if
                end do
                force(case, low) = force(case, low) + value
            end associate
        end subroutine add_axial

        !> A force or couple: at a node, or at the right end of the piece before
        subroutine add_at_point(load, point, case)
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

    end subroutine lower_loads

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

    !> Loads in the engine's units; powers of two, so nothing is rounded
    pure subroutine change_units(lowered)
        type(lowered_type), intent(inout) :: lowered

        associate (l => lowered%length_exponent, f => lowered%force_exponent, beam => lowered%beam)
            if (l == 0 .and. f == 0) return
            call rescale(lowered%dead, l, f)
            call rescale(lowered%live, l, f)
            beam%force(:, :) = scale(beam%force, -f)
            beam%couple(:, :) = scale(beam%couple, -f - l)
        end associate
    end subroutine change_units

    !> The load of a piece in other units of length and force
    elemental subroutine rescale(load, l, f)
        type(piece_load_type), intent(inout) :: load
        integer, intent(in) :: l, f

        load%qa = scale(load%qa, l - f)
        load%qb = scale(load%qb, l - f)
        load%kappa = scale(load%kappa, l)
        load%force = scale(load%force, -f)
        load%couple = scale(load%couple, -f - l)
    end subroutine rescale

end module gapbeam_lower
