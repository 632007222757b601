!> Checks of a scene number by number.
!> What depends on places that coincide is looked at in gapbeam_assemble.
module gapbeam_check
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: shown, whole
    use gapbeam_laws, only: is_smooth
    use gapbeam_scene, only: model_type, span_type, section_type, support_type, load_type, gapbeam_by_x, &
        gapbeam_unchanged, gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_normal, gapbeam_axial, &
        gapbeam_ground_movement, gapbeam_force, gapbeam_couple, gapbeam_distributed, gapbeam_curvature, gapbeam_axial_force, &
        gapbeam_movement, gapbeam_temperature, gapbeam_support_rotation, gapbeam_couple_left, gapbeam_couple_right, &
        gapbeam_axial_distributed, gapbeam_linear_curvature, gapbeam_live, gapbeam_dead
    use gapbeam_assembled_model, only: is_along, is_movement, is_of_support, turns, has_ground_along, has_springs_along
    use gapbeam_tolerances, only: position_tolerance, end_tolerance, steepest_taper
    use gapbeam_limits, only: most_power
    use gapbeam_input_error, only: refuse, of_spans, of_hinges, of_sections, of_supports, of_loads, no_span, not_expected, &
        too_long, lost_length, at_end, off_beam, no_place, no_node, not_axial, no_gap, not_held, idle, bad_law, bad_load
    implicit none
    private
    public :: check_spans, check_rest, check_loads
    ! For gapbeam_check_foundations
    public :: entry_type, check_stretch, refuse_entry, refuse_number

    !> Which entry of which array is looked at
    type :: entry_type
        integer :: table, number, count
    end type entry_type

contains

    !> Spans: lengths and stiffnesses
    pure subroutine check_spans(spans, error)
        type(span_type), intent(in) :: spans(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        if (size(spans) == 0) then
            call fatal_error(error, gapbeam_bad_input, "the beam has no span; give at least one")
            error%table = of_spans
            error%reason = no_span
            return
        end if
        do i = 1, size(spans)
            associate (s => spans(i), here => entry_type(of_spans, i, size(spans)))
                if (.not. (s%length > 0.0_wp .and. s%length <= huge(s%length))) then
                    call refuse_number(error, here, "length", s%length, "a finite number above 0")
                else if (.not. s%EI > 0.0_wp) then
                    call refuse_number(error, here, "EI", s%EI, "a number above 0 (infinite: rigid)")
                else if (.not. s%GA > 0.0_wp) then
                    call refuse_number(error, here, "GA", s%GA, "a number above 0 (infinite: rigid in shear)")
                else if (.not. s%EA > 0.0_wp) then
                    call refuse_number(error, here, "EA", s%EA, "a number above 0 (infinite: rigid)")
                end if
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_spans

    !> Lengths beside each other, hinges, sections and supports, each alone
    subroutine check_rest(model, with_law, ends, error)
        !> With all arrays allocated
        type(model_type), intent(in) :: model
        !> Which supports have a law
        logical, intent(in) :: with_law(:)
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i, n

        n = ubound(ends, 1)
        if (.not. ends(n) <= huge(ends)) then
            call refuse(error, of_spans, n, n, too_long, "", "the beam is too long for the range of numbers")
            return
        end if
        do i = 1, n
            if (ends(i) - ends(i - 1) > position_tolerance*ends(i)) cycle
            call refuse(error, of_spans, i, n, lost_length, "", "a length of "//trim(shown(model%spans(i)%length))// &
                        " is lost in rounding at x = "//trim(shown(ends(i - 1)))//"; give a greater length or remove it")
            return
        end do
        do i = 1, size(model%hinges)
            call check_hinge(model%hinges(i), model%hinge_stiffness(i), entry_type(of_hinges, i, size(model%hinges)), ends(n), &
                             error)
            if (allocated(error)) return
        end do
        do i = 1, size(model%sections)
            call check_section(model%sections(i), entry_type(of_sections, i, size(model%sections)), ends(n), error)
            if (allocated(error)) return
        end do
        do i = 1, size(model%supports)
            call check_support(model%supports(i), with_law(i), entry_type(of_supports, i, size(model%supports)), ends, error)
            if (allocated(error)) return
        end do
    end subroutine check_rest

    !> One hinge
    pure subroutine check_hinge(x, stiffness, here, end, error)
        real(wp), intent(in) :: x, stiffness
        type(entry_type), intent(in) :: here
        !> The beam's right end
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error

        call check_inside(x, "x", here, end, error)
        if (.not. (allocated(error) .or. (stiffness >= 0.0_wp .and. stiffness <= huge(x)))) then
            call refuse_number(error, here, "stiffness", stiffness, "a finite number, 0 or more")
        end if
        if (allocated(error) .or. (x > position_tolerance*end .and. x < end - position_tolerance*end)) return
        call refuse_entry(error, here, "", at_end, &
                    "it is at an end of the beam, where no hinge can be; remove it")
    end subroutine check_hinge

    !> One section
    pure subroutine check_section(s, here, end, error)
        type(section_type), intent(in) :: s
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error

        call check_stretch(s%from, s%to, here, end, error)
        if (allocated(error)) return
        if (.not. (s%EI > 0.0_wp .or. not_given(s%EI))) then
            call refuse_number(error, here, "EI", s%EI, "a number above 0 (infinite: rigid)")
        else if (.not. (s%GA > 0.0_wp .or. not_given(s%GA))) then
            call refuse_number(error, here, "GA", s%GA, "a number above 0 (infinite: rigid in shear)")
        else if (.not. (s%EA > 0.0_wp .or. not_given(s%EA))) then
            call refuse_number(error, here, "EA", s%EA, "a number above 0 (infinite: rigid)")
        else if (.not. (abs(s%N) <= huge(s%N) .or. not_given(s%N))) then
            call refuse_number(error, here, "N", s%N, "a finite number, tension positive")
        else if (.not. s%bedding > 0.0_wp) then
            call refuse_number(error, here, "bedding", s%bedding, "a number above 0 (infinite: rigid)")
        else if (.not. (s%friction >= 0.0_wp .and. (s%friction <= huge(end) .or. has_springs_along(s) .and. &
                                                    not_given(s%friction_to)))) then
            call refuse_number(error, here, "friction", s%friction, "a finite number, 0 or more")
        else if (.not. (not_given(s%friction_to) .or. s%friction_to >= 0.0_wp .and. s%friction_to <= huge(end))) then
            call refuse_number(error, here, "friction_to", s%friction_to, "a finite number, 0 or more")
        else if (.not. (not_given(s%friction_to) .or. has_springs_along(s))) then
            call refuse_entry(error, here, "friction_to", not_expected, "a limit that changes along rigid ground is not "// &
                              "available in this version; give a stiffness too")
        else if (all(not_given([s%EI, s%GA, s%EA, s%N])) .and. .not. has_ground_along(s)) then
            call refuse_entry(error, here, "", idle, "it changes nothing; give EI, GA, EA or N")
        end if
        if (.not. allocated(error)) call check_taper("EI", s%EI, s%EI_to, s%EI_power, here, error)
        if (.not. allocated(error)) call check_taper("GA", s%GA, s%GA_to, s%GA_power, here, error)
        if (.not. allocated(error)) call check_taper("EA", s%EA, s%EA_to, s%EA_power, here, error)
    end subroutine check_section

    !> A stiffness that changes along a section
    pure subroutine check_taper(name, from, to, power, here, error)
        character(len=*), intent(in) :: name
        !> At both ends, and its power of the depth
        real(wp), intent(in) :: from, to
        integer, intent(in) :: power
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(inout) :: error

        if (not_given(to)) return
        if (not_given(from)) then
            call refuse_entry(error, here, name, not_expected, "it is given at the right end of the section alone; give both")
        else if (.not. (from <= huge(from))) then
            call refuse_number(error, here, name, from, "a finite number, for it changes along the section")
        else if (.not. (to > 0.0_wp .and. to <= huge(to))) then
            call refuse_number(error, here, name, to, "a finite number above 0")
        else if (power < 1 .or. power > most_power) then
            call refuse_number(error, here, name, real(power, wp), "a power of the depth of 1 to "//trim(whole(most_power)))
        else if (max(from, to)/steepest_taper > min(from, to)) then
            call refuse_number(error, here, name, to, "at most "//trim(shown(steepest_taper))// &
                               " times what it is at the other end, and no less than the reciprocal of that")
        end if
    end subroutine check_taper

    !> Is a number not given
    elemental function not_given(value) result(missing)
        real(wp), intent(in) :: value
        logical :: missing

        missing = value <= gapbeam_unchanged .and. value >= gapbeam_unchanged
    end function not_given

    !> One support
    pure subroutine check_support(s, has_law, here, ends, error)
        type(support_type), intent(in) :: s
        !> Has it a law; only then one that holds both ways may have a gap
        logical, intent(in) :: has_law
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error

        call check_place(s%x, s%node, here, ends, error)
        if (allocated(error)) return
        if (all(s%side /= [gapbeam_both, gapbeam_below, gapbeam_above])) then
            call refuse_entry(error, here, "side", not_expected, &
                              "expected 0 (both), 1 (below) or -1 (above), got "//trim(whole(s%side)))
        else if (all(s%direction /= [gapbeam_normal, gapbeam_axial]) .and. .not. turns(s)) then
            call refuse_entry(error, here, "direction", not_expected, "expected 0 (normal), 1 (axial), 2 (rotational), "// &
                              "3 (relative), 4 or 5 (rotational left or right of a hinge), got "//trim(whole(s%direction)))
        else if (.not. s%stiffness >= 0.0_wp) then
            call refuse_number(error, here, "stiffness", s%stiffness, "a number, 0 or more (infinite: rigid)")
        else if (.not. abs(s%gap) <= huge(s%gap)) then
            call refuse_number(error, here, "gap", s%gap, "a finite number")
        else if (.not. abs(s%settlement) <= huge(s%gap)) then
            call refuse_number(error, here, "settlement", s%settlement, "a finite number")
        else if (.not. s%rotation >= 0.0_wp) then
            call refuse_number(error, here, "rotation", s%rotation, "a number, 0 or more (infinite: clamped)")
        else if (s%direction == gapbeam_axial .and. s%rotation > 0.0_wp) then
            call refuse_entry(error, here, "rotation", not_axial, &
                              "an axial support holds no rotation; a normal one here can do that")
        else if (turns(s) .and. .not. s%stiffness > 0.0_wp) then
            call refuse_number(error, here, "stiffness", s%stiffness, "a number above 0 (infinite: rigid)")
        else if (s%direction /= gapbeam_normal .and. s%rotation > 0.0_wp) then
            call refuse_entry(error, here, "rotation", bad_law, "it holds a rotation by its stiffness; leave it out")
        else if (s%side == gapbeam_both .and. abs(s%gap) > 0.0_wp .and. .not. has_law) then
            call refuse_entry(error, here, "gap", no_gap, &
                              "only a support that acts one way has a gap, got "//trim(shown(s%gap)))
        end if

    end subroutine check_support

    !> Loads, each alone
    pure subroutine check_loads(loads, model, ends, error)
        type(load_type), intent(in) :: loads(:)
        !> What they act on
        type(model_type), intent(in) :: model
        !> Span ends, shape (0:n)
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error
        logical :: held
        integer :: i

        held = any(model%supports%direction == gapbeam_axial .or. model%supports%friction > 0.0_wp) &
            .or. any(has_ground_along(model%sections))
        do i = 1, size(loads)
            associate (load => loads(i), here => entry_type(of_loads, i, size(loads)))
                call check_load(load, here, ends, held, error)
                if (allocated(error)) return
                if (is_movement(load) .or. is_of_support(load)) call check_movement(model, load, here, error)
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_loads

    !> One load
    pure subroutine check_load(load, here, ends, axially_held, error)
        type(load_type), intent(in) :: load
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: ends(0:)
        !> Does anything hold the beam along its axis
        logical, intent(in) :: axially_held
        type(error_type), allocatable, intent(out) :: error

        select case (load%kind)
        case (gapbeam_force, gapbeam_couple, gapbeam_axial_force, gapbeam_couple_left, gapbeam_couple_right)
            call check_place(load%x, load%node, here, ends, error)
        case (gapbeam_movement, gapbeam_support_rotation, gapbeam_ground_movement)
        case (gapbeam_distributed, gapbeam_curvature, gapbeam_temperature, gapbeam_axial_distributed, gapbeam_linear_curvature)
            call check_stretch(load%x, load%to, here, ends(ubound(ends, 1)), error)
        case default
            call refuse_entry(error, here, "kind", not_expected, &
                              "expected 1 (force), 2 (couple), 3 (distributed), 4 (curvature), 5 (axial force), "// &
                              "6 (movement), 7 (temperature), 8 (rotation), 9 or 10 (couple left or right of a hinge), "// &
                              "11 (distributed along the beam), 12 (movement of ground), 13 (linear curvature), got "// &
                              trim(whole(load%kind)))
        end select
        if (allocated(error)) return
        if (all(load%case /= [gapbeam_live, gapbeam_dead])) then
            call refuse_entry(error, here, "case", not_expected, "expected 0 (live) or 1 (dead), got "//trim(whole(load%case)))
        else if (.not. abs(load%value) <= huge(load%value)) then
            call refuse_number(error, here, "value", load%value, "a finite number")
        else if (any(load%kind == [gapbeam_distributed, gapbeam_temperature, gapbeam_ground_movement, gapbeam_linear_curvature]) &
                 .and. .not. abs(load%value_to) <= huge(1.0_wp)) then
            call refuse_number(error, here, "value_to", load%value_to, "a finite number")
        else if (is_along(load) .and. .not. axially_held) then
            call refuse_entry(error, here, "", not_held, &
                              "nothing holds the beam along its axis; give a support with direction 1 (axial), or friction")
        end if

    end subroutine check_load

    !> A movement of a support, or of a foundation
    pure subroutine check_movement(model, load, here, error)
        type(model_type), intent(in) :: model
        type(load_type), intent(in) :: load
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error

        if (load%kind == gapbeam_ground_movement) then
            if (load%node >= 1 .and. load%node <= size(model%foundations)) return
            call refuse_entry(error, here, "foundation", bad_load, "there is no such foundation")
        else if (load%node < 1 .or. load%node > size(model%supports)) then
            call refuse_entry(error, here, "support", bad_load, "there is no such support")
        else if (load%kind == gapbeam_support_rotation) then
            if (model%supports(load%node)%rotation > 0.0_wp) return
            call refuse_entry(error, here, "support", bad_load, "it leaves the rotation of the beam free, so it cannot "// &
                              "turn it; make its rotation fixed, or give it a stiffness")
        else if (load%case == gapbeam_dead .or. .not. abs(load%value) > 0.0_wp) then
            return
        else if (is_smooth(model%supports(load%node)%law)) then
            call refuse_entry(error, here, "support", bad_load, "its law is a curve, which moves with case dead only "// &
                              "in this version; give the law by points")
        else if (size(model%foundations) > 0 .and. model%supports(load%node)%direction == gapbeam_axial) then
            call refuse_entry(error, here, "case", bad_load, "beside a foundation an axial support moves with case dead only "// &
                              "in this version")
        end if
    end subroutine check_movement

    !> Refuse an entry
    pure subroutine refuse_entry(error, here, key, reason, problem)
        type(error_type), allocatable, intent(out) :: error
        type(entry_type), intent(in) :: here
        !> As for refuse
        character(len=*), intent(in) :: key, problem
        integer, intent(in) :: reason

        call refuse(error, here%table, here%number, here%count, reason, key, problem)
    end subroutine refuse_entry

    !> Say what was expected
    pure subroutine refuse_number(error, here, key, value, expected)
        type(error_type), allocatable, intent(out) :: error
        type(entry_type), intent(in) :: here
        character(len=*), intent(in) :: key, expected
        real(wp), intent(in) :: value

        call refuse_entry(error, here, key, not_expected, &
                    "expected "//expected//", got "//trim(shown(value)))
    end subroutine refuse_number

    !> A place by node or x
    pure subroutine check_place(x, node, here, ends, error)
        real(wp), intent(in) :: x
        integer, intent(in) :: node
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: ends(0:)
        type(error_type), allocatable, intent(out) :: error
        integer :: n

        n = ubound(ends, 1)
        if (node < gapbeam_by_x .or. node > n) then
            call refuse_entry(error, here, "node", no_node, &
                        "expected 0 to "//trim(whole(n))//", or -1 where x is given, got "//trim(whole(node)))
        else if (node /= gapbeam_by_x) then
            return
        else if (not_given(x)) then
            call refuse_entry(error, here, "", no_place, "its position is missing; give node or x")
        else
            call check_inside(x, "x", here, ends(n), error)
        end if
    end subroutine check_place

    !> A stretch; that it has a length is seen when its ends are points
    pure subroutine check_stretch(from, to, here, end, error)
        real(wp), intent(in) :: from, to
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error

        call check_inside(from, "from", here, end, error)
        if (.not. (allocated(error) .or. not_given(to))) call check_inside(to, "to", here, end, error)
    end subroutine check_stretch

    !> Refuse a place off the beam, by more than rounding
    pure subroutine check_inside(x, key, here, end, error)
        real(wp), intent(in) :: x
        character(len=*), intent(in) :: key
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error

        if (x >= -end_tolerance*end .and. x <= end + end_tolerance*end) return
        call refuse_entry(error, here, key, merge(off_beam, not_expected, abs(x) >= 0.0_wp), &
                    trim(shown(x))//" is outside the beam, which runs from x = 0 to x = "//shown(end))
        error%message = trim(error%message)
    end subroutine check_inside

end module gapbeam_check
