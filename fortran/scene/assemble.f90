!> Assembly of the engine's arrays from what a user describes.
!>
!> The beam is cut into pieces wherever anything changes. Only beam ends, supports across the beam and hinges become nodes of the
!> system, in beams solved stretch by stretch all points; the pieces between two nodes are condensed into one link.
module gapbeam_assemble
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory, failed, gapbeam_no_memory
    use gapbeam_memory, only: reserve_memory, for_assembling
    use gapbeam_scene, only: model_type, gapbeam_by_x, gapbeam_couple, gapbeam_couple_left, gapbeam_couple_right, gapbeam_right_end
    use gapbeam_assembled_model, only: assembled_type, copy_model, is_stretch, is_movement, is_of_support
    use gapbeam_axial_force, only: check_axial_force, check_masses, axial_loads_may_bend
    use gapbeam_piece_stiffness, only: assign_sections
    use gapbeam_stations, only: place_span_ends, locate, merge_stations
    use gapbeam_check, only: check_spans, check_rest, check_loads
    use gapbeam_support_laws, only: gather_points
    use gapbeam_check_laws, only: check_laws
    use gapbeam_check_axial, only: check_along
    use gapbeam_check_foundations, only: check_foundations
    use gapbeam_input_error, only: refuse, of_sections, of_foundations, of_loads, no_stretch, at_hinge, bad_load
    use gapbeam_assemble_hinges, only: find_hinges, make_hinges
    use gapbeam_assemble_supports, only: assemble_supports
    use gapbeam_assemble_movements, only: take_movements
    use gapbeam_assemble_loads, only: assemble_loads
    implicit none
    private
    public :: assemble_model

    !> Places on the beam as they are listed, the first `number` entries: span, and distance from its left end
    type :: places_type
        integer, allocatable :: span(:)
        real(wp), allocatable :: offset(:)
        integer :: number = 0
    end type places_type

contains

    !> Assemble the model that is already in `assembled`, with all its arrays allocated
    subroutine assemble_model(assembled, error)
        !> The model in, everything out
        type(assembled_type), intent(inout) :: assembled
        !> Bad input, numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(model_type) :: given
        type(assembled_type), allocatable :: other
        integer :: stat

        call assemble_once(assembled, given, error)
        if (.not. assembled%model%axial_loads_bend .or. assembled%model%stretching) return
        if (.not. (allocated(error) .or. assembled%depends_on_path)) return
        if (allocated(error)) then
            if (error%code == gapbeam_no_memory) return
        end if
        ! Beside what else there is bending cannot feel axial loads in this version: then of first order, as in the first versions
        allocate (other, stat=stat)
        if (stat == 0) call copy_model(given, other%model, stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        other%model%first_order = .true.
        call assemble_once(other, given, error)
        if (.not. allocated(error)) call reserve_memory(for_assembling, 4*size(other%pieces), 4*size(other%model%supports), &
                                                        2*size(other%pieces), error)
        if (allocated(error)) return
        assembled = other
        ! With other loads it may be available
        assembled%model%first_order = .false.
    end subroutine assemble_model

    !> The same, with axial loads that bend the beam if they may
    subroutine assemble_once(assembled, given, error)
        !> As for assemble_model
        type(assembled_type), intent(inout) :: assembled
        !> The model as it was given, if axial loads bend
        type(model_type), intent(out) :: given
        type(error_type), allocatable, intent(out) :: error
        integer :: stat, n

        associate (model => assembled%model)
            ! Left out: no hinge is elastic
            if (.not. allocated(model%hinge_stiffness)) allocate (model%hinge_stiffness(size(model%hinges)), source=0.0_wp)
            if (.not. allocated(model%masses)) allocate (model%masses(2, 0))
            call check_spans(model%spans, error)
            if (allocated(error)) return
            n = size(model%spans)
            allocate (assembled%ends(0:n), stat=stat)
            if (failed(stat, error)) return
            call place_span_ends(model%spans, assembled%ends)
            call gather_points(model, assembled%law, error)
            if (.not. allocated(error)) then
                call reserve_memory(for_assembling, n, size(model%supports), size(model%foundations) + size(model%ground) &
                                    + size(model%ground_law), error)
            end if
            if (.not. allocated(error)) call check_laws(model, assembled%law, error)
            if (allocated(error)) return
            allocate (assembled%with_law(size(model%supports)), source=.false., stat=stat)
            if (failed(stat, error)) return
            assembled%with_law(assembled%law%support) = .true.
            model%axial_loads_bend = axial_loads_may_bend(model, assembled%with_law)
            if (model%axial_loads_bend) call copy_model(model, given, stat)
            if (failed(stat, error)) return
            call check_rest(model, assembled%with_law, assembled%ends, error)
            if (.not. allocated(error)) call check_along(model, assembled%law, assembled%with_law, error)
            if (allocated(error)) return
            call check_foundations(model, assembled%ends(n), error)
            if (.not. allocated(error)) call check_axial_force(model, error)
            if (.not. allocated(error)) call check_masses(model, assembled%ends(n), error)
            if (allocated(error)) return
            call check_loads(model%loads, model, assembled%ends, error)
        end associate
        if (.not. allocated(error)) call take_movements(assembled, error)
        if (allocated(error)) return
        call find_points(assembled, error)
        if (.not. allocated(error)) call assign_sections(assembled, error)
        if (allocated(error)) return
        call assemble_supports(assembled, error)
        if (allocated(error)) return
        call assemble_loads(assembled, error)
    end subroutine assemble_once

    !> Points between the pieces, and the points of supports, hinges, foundations and loads
    subroutine find_points(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        type(places_type) :: places
        integer, allocatable :: order(:), chosen(:), point(:)
        integer(int64) :: total
        integer :: stat, at, i, n, number

        associate (model => assembled%model)
            n = size(model%spans)
            total = 1_int64 + n + size(model%supports) + size(model%hinges) + size(model%ground) + size(model%ground_law) &
                + size(model%masses, 2) + 2_int64*(size(model%sections) + size(model%loads) + size(model%foundations))
            stat = merge(1, 0, 2*total > huge(0))
            if (stat == 0) allocate (places%span(total), order(total), chosen(total), point(total), places%offset(total), stat=stat)
            if (stat == 0) allocate (assembled%end_point(0:n), assembled%support_point(size(model%supports)), &
                                     assembled%load_from(size(model%loads)), assembled%load_to(size(model%loads)), &
                                     assembled%section_from(size(model%sections)), assembled%section_to(size(model%sections)), &
                                     assembled%foundation_from(size(model%foundations)), &
                                     assembled%foundation_to(size(model%foundations)), &
                                     assembled%mass_point(size(model%masses, 2)), &
                                     assembled%ground_point(size(model%ground) + size(model%ground_law)), stat=stat)
            if (failed(stat, error)) return
            call list_places(assembled, places)
            at = 1 + n + size(model%supports) + size(model%hinges)
            call merge_stations(assembled%ends, places%span, places%offset, at, order, chosen, point, number)
        end associate
        allocate (assembled%point_span(0:number - 1), assembled%point_offset(0:number - 1), assembled%hinged(0:number - 1), &
                  assembled%joint(0:number - 1), assembled%pieces(number - 1), assembled%dead(number - 1), &
                  assembled%live(number - 1), stat=stat)
        if (failed(stat, error)) return
        do i = 1, number
            assembled%point_span(i - 1) = places%span(chosen(i))
            assembled%point_offset(i - 1) = places%offset(chosen(i))
        end do
        call take_points(assembled, point, error)
    end subroutine find_points

    !> List all places: ends of spans, supports, hinges, ends of sections, of loads and of foundations, points of the ground, masses
    subroutine list_places(assembled, places)
        type(assembled_type), intent(inout) :: assembled
        !> With room for all
        type(places_type), intent(inout) :: places
        integer :: i

        associate (model => assembled%model, ends => assembled%ends)
            do i = 0, size(model%spans)
                call add(ends, 0.0_wp, i, places)
            end do
            do i = 1, size(model%supports)
                call add(ends, model%supports(i)%x, model%supports(i)%node, places)
            end do
            do i = 1, size(model%hinges)
                call add(ends, model%hinges(i), gapbeam_by_x, places)
            end do
            do i = 1, size(model%sections)
                call add(ends, model%sections(i)%from, gapbeam_by_x, places)
                call add(ends, right_end(ends, model%sections(i)%to), gapbeam_by_x, places)
            end do
            do i = 1, size(model%loads)
                if (is_of_support(model%loads(i))) then
                    associate (s => model%supports(model%loads(i)%node))
                        call add(ends, s%x, s%node, places)
                        call add(ends, s%x, s%node, places)
                    end associate
                    cycle
                else if (is_movement(model%loads(i))) then
                    associate (f => model%foundations(model%loads(i)%node))
                        call add(ends, f%from, gapbeam_by_x, places)
                        call add(ends, right_end(ends, f%to), gapbeam_by_x, places)
                    end associate
                    cycle
                end if
                associate (load => model%loads(i), node => merge(gapbeam_by_x, model%loads(i)%node, is_stretch(model%loads(i))))
                    call add(ends, load%x, node, places)
                    call add(ends, merge(right_end(ends, load%to), load%x, is_stretch(load)), node, places)
                end associate
            end do
            do i = 1, size(model%foundations)
                call add(ends, model%foundations(i)%from, gapbeam_by_x, places)
                call add(ends, right_end(ends, model%foundations(i)%to), gapbeam_by_x, places)
            end do
            do i = 1, size(model%ground)
                call add_on_foundation(assembled, i, model%ground(i)%foundation, model%ground(i)%x, places)
            end do
            do i = 1, size(model%ground_law)
                call add_on_foundation(assembled, size(model%ground) + i, model%ground_law(i)%foundation, model%ground_law(i)%x, &
                                       places)
            end do
            do i = 1, size(model%masses, 2)
                call add(ends, model%masses(1, i), gapbeam_by_x, places)
            end do
        end associate
    end subroutine list_places

    !> Note a place by node or x
    pure subroutine add(ends, x, node, places)
        real(wp), intent(in) :: ends(0:), x
        integer, intent(in) :: node
        type(places_type), intent(inout) :: places

        places%number = places%number + 1
        associate (at => places%number)
            if (node == gapbeam_by_x) then
                call locate(x, ends, places%span(at), places%offset(at))
            else
                places%span(at) = node
                places%offset(at) = 0.0_wp
            end if
        end associate
    end subroutine add

    !> Note a point of a table or a law. What is not on its foundation is no place, so it stands at one that there is
    pure subroutine add_on_foundation(assembled, number, foundation, x, places)
        type(assembled_type), intent(inout) :: assembled
        !> Among the points of tables and laws; its foundation and place
        integer, intent(in) :: number, foundation
        real(wp), intent(in) :: x
        type(places_type), intent(inout) :: places

        associate (f => assembled%model%foundations(foundation))
            assembled%ground_point(number) = merge(0, -1, x > f%from .and. x < right_end(assembled%ends, f%to))
            call add(assembled%ends, merge(x, f%from, assembled%ground_point(number) == 0), gapbeam_by_x, places)
        end associate
    end subroutine add_on_foundation

    !> Where a stretch ends
    pure function right_end(ends, to) result(x)
        real(wp), intent(in) :: ends(0:), to
        real(wp) :: x

        x = to
        if (to <= gapbeam_right_end) x = ends(ubound(ends, 1))
    end function right_end

    !> Tell all that has a place which point that is
    subroutine take_points(assembled, point, error)
        type(assembled_type), intent(inout) :: assembled
        !> Of the places in the order of list_places
        integer, intent(in) :: point(:)
        !> Stretches without length, hinges twice, couples at hinges
        type(error_type), allocatable, intent(out) :: error
        integer :: at, i

        associate (model => assembled%model)
            at = size(model%spans) + 1
            assembled%end_point(0:) = point(1:at)
            assembled%support_point(:) = point(at + 1:at + size(model%supports))
            at = at + size(model%supports)
            call find_hinges(point(at + 1:at + size(model%hinges)), model%hinge_stiffness, assembled%hinged, assembled%joint, error)
            if (.not. allocated(error)) call make_hinges(assembled, error)
            if (allocated(error)) return
            at = at + size(model%hinges)
            call take_stretches(point(at + 1:), of_sections, assembled%section_from, assembled%section_to, error)
            if (allocated(error)) return
            at = at + 2*size(model%sections)
            do i = 1, size(model%loads)
                assembled%load_from(i) = point(at + 2*i - 1)
                assembled%load_to(i) = point(at + 2*i)
                ! One without length acts on nothing
                if (is_stretch(model%loads(i)) .and. assembled%load_from(i) > assembled%load_to(i)) then
                    call refuse_empty(of_loads, i, size(model%loads), error)
                else if (model%loads(i)%kind == gapbeam_couple .and. is_hinge(assembled%load_from(i))) then
                    call refuse(error, of_loads, i, size(model%loads), at_hinge, "", &
                                "the couple acts exactly at a hinge, so it is unclear which side takes it; put it on one side "// &
                                "of the hinge")
                end if
                if (.not. allocated(error) .and. any(model%loads(i)%kind == [gapbeam_couple_left, gapbeam_couple_right])) then
                    if (.not. is_hinge(assembled%load_from(i))) then
                        call refuse(error, of_loads, i, size(model%loads), bad_load, "at_hinge", &
                                    "there is no hinge at its place; leave it out")
                    end if
                end if
                if (allocated(error)) return
            end do
            at = at + 2*size(model%loads)
            call take_stretches(point(at + 1:), of_foundations, assembled%foundation_from, assembled%foundation_to, error)
            if (allocated(error)) return
            at = at + 2*size(model%foundations)
            where (assembled%ground_point == 0) assembled%ground_point = point(at + 1:at + size(assembled%ground_point))
            assembled%mass_point(:) = point(at + size(assembled%ground_point) + 1:)
        end associate

    contains

        !> Is there a hinge, elastic or not
        pure function is_hinge(point)
            integer, intent(in) :: point
            logical :: is_hinge

            is_hinge = assembled%hinged(point) .or. assembled%joint(point) > 0.0_wp
        end function is_hinge

    end subroutine take_points

    !> Points at the ends of stretches that have a length
    subroutine take_stretches(point, table, from, to, error)
        !> Of first and last place of every stretch
        integer, intent(in) :: point(:)
        !> What they are stretches of
        integer, intent(in) :: table
        integer, intent(out) :: from(:), to(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        do i = 1, size(from)
            from(i) = point(2*i - 1)
            to(i) = point(2*i)
            if (from(i) < to(i)) cycle
            call refuse_empty(table, i, size(from), error)
            return
        end do
    end subroutine take_stretches

    !> Refuse a stretch without length
    subroutine refuse_empty(table, number, count, error)
        integer, intent(in) :: table, number, count
        type(error_type), allocatable, intent(out) :: error

        call refuse(error, table, number, count, no_stretch, "", "its stretch has no length; from must be less than to")
    end subroutine refuse_empty

end module gapbeam_assemble
