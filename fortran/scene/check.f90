!> Is what the user gave possible, number by number; what depends on places that coincide is looked at in gapbeam_lower
module gapbeam_check
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input, gapbeam_not_finite
    use gapbeam_scene, only: model_type, span_type, support_type, load_type, gapbeam_by_x, &
        gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_normal, gapbeam_axial, &
        gapbeam_force, gapbeam_couple, gapbeam_distributed, gapbeam_curvature, gapbeam_axial_force, gapbeam_live, gapbeam_dead
    use gapbeam_lowered, only: position_tolerance
    implicit none
    private
    public :: check_spans, check_rest, check_loads, refuse, refuse_range, named, shown
    public :: of_spans, of_hinges, of_supports, of_loads

    !> The arrays of a model
    integer, parameter :: of_spans = 1, of_hinges = 2, of_supports = 3, of_loads = 4
    !> Room for a number
    integer, parameter :: shown_length = 24
    character(len=*), parameter :: names(4) = [character(len=7) :: "span", "hinge", "support", "load"]

contains

    !> Refuse an entry of an array: "support 3 of 4: ..."
    pure subroutine refuse(error, table, entry, count, problem)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        !> of_spans, of_hinges, of_supports or of_loads; entry, and how many there are
        integer, intent(in) :: table, entry, count
        !> What is wrong, and what was expected
        character(len=*), intent(in) :: problem

        call fatal_error(error, gapbeam_bad_input, trim(named(table, entry, count))//": "//problem)
        error%table = table
        error%entry = entry
    end subroutine refuse

    !> "support 3 of 4", blanks behind it
    pure function named(table, entry, count) result(text)
        !> As for refuse
        integer, intent(in) :: table, entry, count
        character(len=40) :: text

        write (text, "(a, 1x, i0, ' of ', i0)") trim(names(table)), entry, count
    end function named

    !> Say what left the range of double precision
    pure subroutine refuse_range(error, what, remedy)
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        !> What it is and why, and what to do about it
        character(len=*), intent(in) :: what, remedy

        call fatal_error(error, gapbeam_not_finite, "numbers left the range of double precision: "//what//"; "//remedy)
    end subroutine refuse_range

    !> A number as a user would write it, blanks behind it. Not of deferred length: gfortran keeps the length of such a result in
    !> static storage, which threads share
    pure function shown(value) result(text)
        real(wp), intent(in) :: value
        character(len=shown_length) :: text

        if (ieee_is_nan(value)) then
            text = "NaN"
        else if (abs(value) > huge(value)) then
            text = merge("inf ", "-inf", value > 0)
        else if (abs(value) < 1e9_wp .and. abs(value - anint(value)) <= 0.0_wp) then
            write (text, "(i0)") nint(value)
        else
            write (text, "(g0.9)") value
            text = adjustl(text)
        end if
    end function shown

    !> Spans: lengths and stiffnesses
    subroutine check_spans(spans, error)
        type(span_type), intent(in) :: spans(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        if (size(spans) == 0) then
            call fatal_error(error, gapbeam_bad_input, "the beam has no span; give at least one")
            error%table = of_spans
            return
        end if
        do i = 1, size(spans)
            associate (s => spans(i))
                if (.not. (ieee_is_finite(s%length) .and. s%length > 0.0_wp)) then
                    call wrong(i, "length", s%length, "a finite number above 0")
                else if (.not. s%EI > 0.0_wp) then
                    call wrong(i, "EI", s%EI, "a number above 0 (infinite: rigid)")
                else if (.not. s%GA > 0.0_wp) then
                    call wrong(i, "GA", s%GA, "a number above 0 (infinite: rigid in shear)")
                else if (.not. s%EA > 0.0_wp) then
                    call wrong(i, "EA", s%EA, "a number above 0 (infinite: rigid)")
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> Say what was expected
        subroutine wrong(entry, key, value, expected)
            integer, intent(in) :: entry
            character(len=*), intent(in) :: key, expected
            real(wp), intent(in) :: value

            call refuse(error, of_spans, entry, size(spans), key//": expected "//expected//", got "//trim(shown(value)))
        end subroutine wrong

    end subroutine check_spans

    !> Hinges and supports, each alone
    subroutine check_rest(model, ends, error)
        !> With all arrays allocated
        type(model_type), intent(in) :: model
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: problem
        integer :: i, n

        n = ubound(ends, 1)
        do i = 1, n
            if (.not. ieee_is_finite(ends(i))) then
                call refuse(error, of_spans, i, n, "the beam is too long for the range of numbers")
            else if (ends(i) - ends(i - 1) <= position_tolerance*ends(i)) then
                call refuse(error, of_spans, i, n, "a length of "//trim(shown(model%spans(i)%length))// &
                            " is lost in rounding at x = "//trim(shown(ends(i - 1)))//"; give a greater length or remove it")
            end if
            if (allocated(error)) return
        end do
        do i = 1, size(model%hinges)
            if (.not. is_inside(model%hinges(i), ends(n))) then
                call outside("x", model%hinges(i), ends(n), problem)
                call refuse(error, of_hinges, i, size(model%hinges), problem)
            else if (.not. (model%hinges(i) > position_tolerance*ends(n) .and. &
                            model%hinges(i) < ends(n) - position_tolerance*ends(n))) then
                call refuse(error, of_hinges, i, size(model%hinges), "it is at an end of the beam, where no hinge can be; "// &
                            "remove it")
            end if
            if (allocated(error)) return
        end do
        do i = 1, size(model%supports)
            call check_support(model%supports(i), i, size(model%supports), ends, error)
            if (allocated(error)) return
        end do
    end subroutine check_rest

    !> One support
    subroutine check_support(s, i, count, ends, error)
        type(support_type), intent(in) :: s
        integer, intent(in) :: i, count
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: problem

        call check_place(s%x, s%node, ends, problem)
        if (allocated(problem)) then
            call refuse(error, of_supports, i, count, problem)
        else if (all(s%side /= [gapbeam_both, gapbeam_below, gapbeam_above])) then
            call wrong("side: expected 0 (both), 1 (below) or -1 (above), got "//trim(whole(s%side)))
        else if (all(s%direction /= [gapbeam_normal, gapbeam_axial])) then
            call wrong("direction: expected 0 (normal) or 1 (axial), got "//trim(whole(s%direction)))
        else if (.not. s%stiffness >= 0.0_wp) then
            call wrong("stiffness: expected a number, 0 or more (infinite: rigid), got "//trim(shown(s%stiffness)))
        else if (.not. ieee_is_finite(s%gap)) then
            call wrong("gap: expected a finite number, got "//trim(shown(s%gap)))
        else if (.not. ieee_is_finite(s%settlement)) then
            call wrong("settlement: expected a finite number, got "//trim(shown(s%settlement)))
        else if (.not. s%rotation >= 0.0_wp) then
            call wrong("rotation: expected a number, 0 or more (infinite: clamped), got "//trim(shown(s%rotation)))
        else if (s%direction == gapbeam_axial .and. s%side /= gapbeam_both) then
            call wrong("side: an axial support holds on both sides; give 0 (both)")
        else if (s%direction == gapbeam_axial .and. s%rotation > 0.0_wp) then
            call wrong("rotation: an axial support holds no rotation; a normal one here can do that")
        else if (s%side == gapbeam_both .and. abs(s%gap) > 0.0_wp) then
            call wrong("gap: only a support of side below or above has a gap, got "//trim(shown(s%gap)))
        end if

    contains

        !> Refuse this support
        subroutine wrong(text)
            character(len=*), intent(in) :: text

            call refuse(error, of_supports, i, count, text)
        end subroutine wrong

    end subroutine check_support

    !> Loads, each alone
    pure subroutine check_loads(loads, ends, axially_held, error)
        type(load_type), intent(in) :: loads(:)
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        !> Is there an axial support
        logical, intent(in) :: axially_held
        type(error_type), allocatable, intent(out) :: error
        character(len=:), allocatable :: problem
        integer :: i

        do i = 1, size(loads)
            associate (load => loads(i))
                select case (load%kind)
                case (gapbeam_force, gapbeam_couple, gapbeam_axial_force)
                    call check_place(load%x, load%node, ends, problem)
                case (gapbeam_distributed, gapbeam_curvature)
                    call check_stretch(load%x, load%to, ends, problem)
                case default
                    problem = "kind: expected 1 (force), 2 (couple), 3 (distributed), 4 (curvature) or 5 (axial force), got "// &
                        trim(whole(load%kind))
                end select
                if (allocated(problem)) then
                    continue
                else if (all(load%case /= [gapbeam_live, gapbeam_dead])) then
                    problem = "case: expected 0 (live) or 1 (dead), got "//trim(whole(load%case))
                else if (.not. ieee_is_finite(load%value)) then
                    problem = "value: expected a finite number, got "//trim(shown(load%value))
                else if (load%kind == gapbeam_distributed .and. .not. ieee_is_finite(load%value_to)) then
                    problem = "value_to: expected a finite number, got "//trim(shown(load%value_to))
                else if (load%kind == gapbeam_axial_force .and. .not. axially_held) then
                    problem = "nothing holds the beam along its axis; give a support with direction 1 (axial)"
                end if
            end associate
            if (allocated(problem)) then
                call refuse(error, of_loads, i, size(loads), problem)
                return
            end if
        end do
    end subroutine check_loads

    !> A place by node or x
    pure subroutine check_place(x, node, ends, problem)
        real(wp), intent(in) :: x
        integer, intent(in) :: node
        real(wp), intent(in) :: ends(0:)
        character(len=:), allocatable, intent(out) :: problem
        integer :: n

        n = ubound(ends, 1)
        if (node < gapbeam_by_x .or. node > n) then
            problem = "node: expected 0 to "//trim(whole(n))//", or -1 where x is given, got "//trim(whole(node))
        else if (node /= gapbeam_by_x) then
            return
        else if (x <= -huge(x)) then
            problem = "its place is missing; give node or x"
        else if (.not. is_inside(x, ends(n))) then
            call outside("x", x, ends(n), problem)
        end if
    end subroutine check_place

    !> A stretch; that it has a length is seen when its ends are points
    pure subroutine check_stretch(x, to, ends, problem)
        real(wp), intent(in) :: x, to
        real(wp), intent(in) :: ends(0:)
        character(len=:), allocatable, intent(out) :: problem
        integer :: n

        n = ubound(ends, 1)
        if (.not. is_inside(x, ends(n))) then
            call outside("from", x, ends(n), problem)
        else if (.not. is_inside(to, ends(n))) then
            call outside("to", to, ends(n), problem)
        end if
    end subroutine check_stretch

    !> On the beam, or beside it by rounding only
    elemental function is_inside(x, end) result(inside)
        real(wp), intent(in) :: x, end
        logical :: inside

        inside = x >= -position_tolerance*end .and. x <= end + position_tolerance*end
    end function is_inside

    !> Say that a place is off the beam
    pure subroutine outside(key, x, end, problem)
        character(len=*), intent(in) :: key
        real(wp), intent(in) :: x, end
        character(len=:), allocatable, intent(out) :: problem

        problem = key//": "//trim(shown(x))//" is outside the beam, which runs from x = 0 to x = "//trim(shown(end))
    end subroutine outside

    !> A whole number as text, blanks behind it
    pure function whole(value) result(text)
        integer, intent(in) :: value
        character(len=shown_length) :: text

        write (text, "(i0)") value
    end function whole

end module gapbeam_check
