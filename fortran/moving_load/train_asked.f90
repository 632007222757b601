!> Values of a state under a train that have extremes over all positions: of fields, of supports, of foundations.
module gapbeam_train_asked
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_quantities, only: quantity_count
    use gapbeam_query, only: extremes_of_fields
    use gapbeam_support_values, only: support_values
    use gapbeam_ground_zones, only: contact_type, free_span_type, find_contact, find_free_spans
    use gapbeam_train_states, only: kept_type
    implicit none
    private
    public :: asked_type, keep_extremes, of_field, of_support, of_resultant, of_free_span, value_of, rows_of_support

    !> What is asked of
    integer, parameter :: of_field = 1, of_support = 2, of_resultant = 3, of_free_span = 4
    !> Reaction, deflection, opening, couple
    integer, parameter :: rows_of_support = 4

    !> A value, the largest of which is asked for
    type :: asked_type
        integer :: of = of_field
        !> Number of the quantity, of the support, or of the foundation; the row of a support's values, or 1 for the length and 2
        !> for the sag of a free span
        integer :: number = 0, row = 0
        !> Is the smallest one asked for: then values are those below zero
        logical :: smallest = .false.
    end type asked_type

contains

    !> Find the extremes of all quantities of a state, if they are not known
    subroutine keep_extremes(kept, error)
        !> A solved one
        type(kept_type), intent(inout) :: kept
        !> As for extremes_of_fields
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: extremes(2, quantity_count), places(2, quantity_count)
        integer :: k

        if (allocated(kept%extremes)) return
        call extremes_of_fields(kept%placed, kept%state, [(k, k=1, quantity_count)], extremes, places, error)
        if (allocated(error)) return
        kept%extremes = extremes
        kept%places = places
    end subroutine keep_extremes

    !> The value in a state
    subroutine value_of(asked, kept, value, error, x, span)
        type(asked_type), intent(in) :: asked
        !> A solved one
        type(kept_type), intent(inout) :: kept
        real(wp), intent(out) :: value
        !> As for extremes_of_fields
        type(error_type), allocatable, intent(out) :: error
        !> Its place, of a field; ends and sag of a free span, zero if there is none
        real(wp), intent(out), optional :: x, span(3)
        type(contact_type), allocatable :: zones(:)
        real(wp) :: extremes(2, 1), places(2, 1), there(3)
        real(wp), allocatable :: rows(:, :)
        integer, allocatable :: condition(:)
        integer :: i, stat

        i = merge(2, 1, asked%smallest)
        value = 0.0_wp
        places(:, :) = 0.0_wp
        there(:) = 0.0_wp
        select case (asked%of)
        case (of_field)
            if (allocated(kept%extremes)) then
                value = kept%extremes(i, asked%number)
                places(i, 1) = kept%places(i, asked%number)
            else
                call extremes_of_fields(kept%placed, kept%state, [asked%number], extremes, places, error)
                value = extremes(i, 1)
            end if
        case (of_support)
            associate (n => size(kept%placed%model%supports))
                allocate (rows(n, rows_of_support), condition(n), stat=stat)
            end associate
            if (failed(stat, error)) return
            call support_values(kept%placed, kept%state, rows(:, 1), rows(:, 2), rows(:, 3), rows(:, 4), condition)
            value = rows(asked%number, asked%row)
        case (of_resultant)
            if (.not. allocated(kept%state%ground)) return
            call find_contact(kept%placed, kept%state%ground, zones, error)
            if (.not. allocated(error)) value = sum(pack(zones%resultant, zones%foundation == asked%number))
        case (of_free_span)
            if (.not. allocated(kept%state%ground)) return
            call find_span(asked, kept, value, there, error)
        case default
            continue
        end select
        if (asked%smallest) value = -value
        if (present(x)) x = places(i, 1)
        if (present(span)) span(:) = there
    end subroutine value_of

    !> The longest or the deepest free span over a foundation
    subroutine find_span(asked, kept, value, there, error)
        type(asked_type), intent(in) :: asked
        type(kept_type), intent(in) :: kept
        !> Its size; 0 if there is none
        real(wp), intent(inout) :: value
        !> Its ends and its sag
        real(wp), intent(inout) :: there(3)
        type(error_type), allocatable, intent(out) :: error
        type(free_span_type), allocatable :: spans(:)
        real(wp) :: size_of
        logical :: found
        integer :: k

        found = .false.
        call find_free_spans(kept%placed, kept%state%ground, spans, error)
        if (allocated(error)) return
        do k = 1, size(spans)
            if (spans(k)%foundation /= asked%number) cycle
            size_of = merge(spans(k)%to - spans(k)%from, spans(k)%sag, asked%row == 1)
            if (found .and. size_of <= value) cycle
            found = .true.
            value = size_of
            there(:) = [spans(k)%from, spans(k)%to, spans(k)%sag]
        end do
    end subroutine find_span

end module gapbeam_train_asked
