!> Assembly of the engine's arrays from what a user describes.
!>
!> The beam is cut into pieces wherever anything changes: at span ends, supports, hinges, point loads, the ends of distributed
!> loads and of foundations, and the points of their tables. Only beam ends, supports across the beam and hinges become nodes of
!> the system, with foundations all points; the pieces between two nodes are condensed into one link.
module gapbeam_assemble
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_memory, only: reserve_memory, for_assembling
    use gapbeam_scene, only: gapbeam_by_x, gapbeam_axial, gapbeam_couple, gapbeam_right_end, gapbeam_unchanged
    use gapbeam_assembled_model, only: assembled_type, is_stretch, in_bending, in_shear, along_axis
    use gapbeam_stations, only: place_span_ends, locate, merge_stations
    use gapbeam_check, only: check_spans, check_rest, check_loads
    use gapbeam_support_laws, only: gather_points
    use gapbeam_check_laws, only: check_laws, have_laws
    use gapbeam_check_foundations, only: check_foundations
    use gapbeam_input_error, only: refuse, of_hinges, of_sections, of_foundations, of_loads, twice, no_stretch, at_hinge
    use gapbeam_assemble_supports, only: assemble_supports
    use gapbeam_assemble_loads, only: assemble_loads
    implicit none
    private
    public :: assemble_model

contains

    !> Assemble the model that is already in `assembled`, with all its arrays allocated
    subroutine assemble_model(assembled, error)
        !> The model in, everything out
        type(assembled_type), intent(inout) :: assembled
        !> Bad input, numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: stat, n

        associate (model => assembled%model)
            call check_spans(model%spans, error)
            if (allocated(error)) return
            n = size(model%spans)
            allocate (assembled%ends(0:n), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            call place_span_ends(model%spans, assembled%ends)
            call gather_points(model, assembled%law, error)
            if (.not. allocated(error)) then
                call reserve_memory(for_assembling, n, size(model%supports), size(model%foundations) + size(model%ground) &
                                    + size(model%ground_law), error)
            end if
            if (.not. allocated(error)) call check_laws(model, assembled%law, error)
            if (allocated(error)) return
            allocate (assembled%with_law(size(model%supports)), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            assembled%with_law(:) = have_laws(model, assembled%law)
            call check_rest(model, assembled%with_law, assembled%ends, error)
            if (allocated(error)) return
            call check_foundations(model, assembled%ends(n), error)
            if (allocated(error)) return
            call check_loads(model%loads, assembled%ends, any(model%supports%direction == gapbeam_axial), error)
            if (allocated(error)) return
        end associate
        call find_points(assembled, error)
        if (.not. allocated(error)) call assign_sections(assembled, error)
        if (allocated(error)) return
        call assemble_supports(assembled, error)
        if (allocated(error)) return
        call assemble_loads(assembled, error)
    end subroutine assemble_model

    !> Which section gives the stiffness of a piece: the last one that gives it
    subroutine assign_sections(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        if (size(assembled%model%sections) == 0) return
        allocate (assembled%section_of(3, size(assembled%pieces)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        assembled%section_of(:, :) = 0
        do i = 1, size(assembled%model%sections)
            associate (s => assembled%model%sections(i), first => assembled%section_from(i) + 1, last => assembled%section_to(i))
                if (s%EI > gapbeam_unchanged) assembled%section_of(in_bending, first:last) = i
                if (s%GA > gapbeam_unchanged) assembled%section_of(in_shear, first:last) = i
                if (s%EA > gapbeam_unchanged) assembled%section_of(along_axis, first:last) = i
            end associate
        end do
    end subroutine assign_sections

    !> Points between the pieces, and the points of supports, hinges, foundations and loads
    subroutine find_points(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: span(:), order(:), chosen(:), point(:)
        real(wp), allocatable :: offset(:)
        integer(int64) :: total
        integer :: stat, at, i, n, number

        associate (model => assembled%model)
            n = size(model%spans)
            total = 1_int64 + n + size(model%supports) + size(model%hinges) + size(model%ground) + size(model%ground_law) &
                + 2_int64*(size(model%sections) + size(model%loads) + size(model%foundations))
            stat = merge(1, 0, 2*total > huge(0))
            if (stat == 0) allocate (span(total), order(total), chosen(total), point(total), offset(total), stat=stat)
            if (stat == 0) allocate (assembled%end_point(0:n), assembled%support_point(size(model%supports)), &
                                     assembled%load_from(size(model%loads)), assembled%load_to(size(model%loads)), &
                                     assembled%section_from(size(model%sections)), assembled%section_to(size(model%sections)), &
                                     assembled%foundation_from(size(model%foundations)), &
                                     assembled%foundation_to(size(model%foundations)), &
                                     assembled%ground_point(size(model%ground) + size(model%ground_law)), stat=stat)
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
            do i = 1, size(model%sections)
                call add(model%sections(i)%from, gapbeam_by_x)
                call add(right_end(model%sections(i)%to), gapbeam_by_x)
            end do
            do i = 1, size(model%loads)
                associate (load => model%loads(i))
                    call add(load%x, merge(gapbeam_by_x, load%node, is_stretch(load)))
                    call add(merge(right_end(load%to), load%x, is_stretch(load)), merge(gapbeam_by_x, load%node, is_stretch(load)))
                end associate
            end do
            do i = 1, size(model%foundations)
                call add(model%foundations(i)%from, gapbeam_by_x)
                call add(right_end(model%foundations(i)%to), gapbeam_by_x)
            end do
            do i = 1, size(model%ground)
                call add_on_foundation(i, model%ground(i)%foundation, model%ground(i)%x)
            end do
            do i = 1, size(model%ground_law)
                call add_on_foundation(size(model%ground) + i, model%ground_law(i)%foundation, model%ground_law(i)%x)
            end do
            at = 1 + n + size(model%supports) + size(model%hinges)
            call merge_stations(assembled%ends, span, offset, at, order, chosen, point, number)
            allocate (assembled%point_span(0:number - 1), assembled%point_offset(0:number - 1), assembled%hinged(0:number - 1), &
                      assembled%pieces(number - 1), assembled%dead(number - 1), assembled%live(number - 1), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            do i = 1, number
                assembled%point_span(i - 1) = span(chosen(i))
                assembled%point_offset(i - 1) = offset(chosen(i))
            end do
            assembled%end_point(0:n) = point(1:n + 1)
            at = n + 1
            assembled%support_point(:) = point(at + 1:at + size(model%supports))
            at = at + size(model%supports)
            call find_hinges(point(at + 1:at + size(model%hinges)))
            if (allocated(error)) return
            at = at + size(model%hinges)
            do i = 1, size(model%sections)
                assembled%section_from(i) = point(at + 2*i - 1)
                assembled%section_to(i) = point(at + 2*i)
                if (assembled%section_from(i) < assembled%section_to(i)) cycle
                call refuse_empty(of_sections, i, size(model%sections))
                return
            end do
            at = at + 2*size(model%sections)
            do i = 1, size(model%loads)
                assembled%load_from(i) = point(at + 2*i - 1)
                assembled%load_to(i) = point(at + 2*i)
                ! One without length acts on nothing
                if (is_stretch(model%loads(i)) .and. assembled%load_from(i) > assembled%load_to(i)) then
                    call refuse_empty(of_loads, i, size(model%loads))
                else if (model%loads(i)%kind == gapbeam_couple .and. assembled%hinged(assembled%load_from(i))) then
                    call refuse(error, of_loads, i, size(model%loads), at_hinge, "", &
                                "the couple acts exactly at a hinge, so it is unclear which side takes it; put it on one side "// &
                                "of the hinge")
                end if
                if (allocated(error)) return
            end do
            at = at + 2*size(model%loads)
            do i = 1, size(model%foundations)
                assembled%foundation_from(i) = point(at + 2*i - 1)
                assembled%foundation_to(i) = point(at + 2*i)
                if (assembled%foundation_from(i) < assembled%foundation_to(i)) cycle
                call refuse_empty(of_foundations, i, size(model%foundations))
                return
            end do
            at = at + 2*size(model%foundations)
            where (assembled%ground_point == 0) assembled%ground_point = point(at + 1:at + size(assembled%ground_point))
        end associate

    contains

        !> Note a place by node or x
        subroutine add(x, node)
            real(wp), intent(in) :: x
            integer, intent(in) :: node

            at = at + 1
            if (node == gapbeam_by_x) then
                call locate(x, assembled%ends, span(at), offset(at))
            else
                span(at) = node
                offset(at) = 0.0_wp
            end if
        end subroutine add

        !> Note a point of a table or a law. What is not on its foundation is no place, so it stands at one that there is
        subroutine add_on_foundation(number, foundation, x)
            !> Among the points of tables and laws; its foundation and place
            integer, intent(in) :: number, foundation
            real(wp), intent(in) :: x

            associate (f => assembled%model%foundations(foundation))
                assembled%ground_point(number) = merge(0, -1, x > f%from .and. x < right_end(f%to))
                call add(merge(x, f%from, assembled%ground_point(number) == 0), gapbeam_by_x)
            end associate
        end subroutine add_on_foundation

        !> Where a stretch ends
        function right_end(to) result(x)
            real(wp), intent(in) :: to
            real(wp) :: x

            x = to
            if (to <= gapbeam_right_end) x = assembled%ends(n)
        end function right_end

        !> Refuse a stretch without length
        subroutine refuse_empty(table, number, count)
            integer, intent(in) :: table, number, count

            call refuse(error, table, number, count, no_stretch, "", "its stretch has no length; from must be less than to")
        end subroutine refuse_empty

        !> Mark the hinges
        subroutine find_hinges(points)
            integer, intent(in) :: points(:)
            integer :: k, other

            assembled%hinged(:) = .false.
            do k = 1, size(points)
                if (assembled%hinged(points(k))) then
                    other = findloc(points, points(k), 1)
                    call refuse(error, of_hinges, k, size(points), twice, "", &
                                "there is a hinge at this place already; remove one of them", other)
                    return
                end if
                assembled%hinged(points(k)) = .true.
            end do
        end subroutine find_hinges

    end subroutine find_points

end module gapbeam_assemble
