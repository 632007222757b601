!> Errors of what a user gave: in words, and as codes for an interface with words of its own.
module gapbeam_input_error
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input, gapbeam_not_finite
    use gapbeam_words, only: whole
    implicit none
    private
    public :: refuse, refuse_range, named
    public :: of_spans, of_hinges, of_supports, of_loads, of_sections, of_foundations
    public :: no_span, not_expected, too_long, lost_length, at_end, off_beam, no_place, no_node, no_stretch, not_axial, no_gap, &
              not_held, twice, no_room, at_hinge, idle, bad_law, bad_load

    !> The arrays of a model
    integer, parameter :: of_spans = 1, of_hinges = 2, of_supports = 3, of_loads = 4, of_sections = 5, of_foundations = 6
    !> Reasons: the beam has no span; a number is not as expected; the beam is too long; a length is lost in rounding; a hinge is at
    !> an end; a place is off the beam; it is missing; there is no such node; a stretch has no length
    integer, parameter :: no_span = 1, not_expected = 2, too_long = 3, lost_length = 4, at_end = 5, off_beam = 6, no_place = 7, &
                          no_node = 8, no_stretch = 9
    !> An axial support does not have that; a support or foundation that holds both ways has no gap; nothing holds an axial
    !> load; two parts do the same at one place; two supports leave no room; something is exactly at a hinge; a section changes
    !> nothing
    integer, parameter :: not_axial = 10, no_gap = 11, not_held = 12, twice = 13, no_room = 14, at_hinge = 15, idle = 16
    !> A law, or the ground of a foundation, is impossible: the message says why; the partner is the point, from 1, 0: none
    integer, parameter :: bad_law = 17
    !> A load cannot be as it is given: the message says why
    integer, parameter :: bad_load = 18
    character(len=*), parameter :: names(6) = [character(len=10) :: "span", "hinge", "support", "load", "section", "foundation"]

contains

    !> Refuse an entry of an array: "support 3 of 4: gap: expected ..."
    pure subroutine refuse(error, table, entry, count, reason, key, problem, partner)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        !> of_spans, of_hinges, ...; entry, and how many there are; one of the reasons
        integer, intent(in) :: table, entry, count, reason
        !> What of the entry it is about, "" if all; what is wrong, and what was expected
        character(len=*), intent(in) :: key, problem
        !> Another entry that it is at odds with
        integer, intent(in), optional :: partner

        if (key == "") then
            call fatal_error(error, gapbeam_bad_input, trim(named(table, entry, count))//": "//problem)
        else
            call fatal_error(error, gapbeam_bad_input, trim(named(table, entry, count))//": "//key//": "//problem)
        end if
        error%table = table
        error%entry = entry
        error%reason = reason
        error%key = key
        if (present(partner)) error%partner = partner
    end subroutine refuse

    !> "support 3 of 4", blanks behind it
    pure function named(table, entry, count) result(text)
        !> As for refuse
        integer, intent(in) :: table, entry, count
        character(len=40) :: text

        text = trim(names(table))//" "//trim(whole(entry))//" of "//whole(count)
    end function named

    !> Say what left the range of double precision
    pure subroutine refuse_range(error, what, remedy)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        !> What it is and why, and what to do about it
        character(len=*), intent(in) :: what, remedy

        call fatal_error(error, gapbeam_not_finite, "numbers left the range of double precision: "//what//"; "//remedy)
    end subroutine refuse_range

end module gapbeam_input_error
