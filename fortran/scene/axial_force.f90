!> Axial forces that bending feels (second order): where there are any, and what pieces of the beam have of them.
!>
!> With them every piece is a link of its own, and the beam is solved as one on the ground (gapbeam_foundation), whether there is
!> ground or not.
module gapbeam_axial_force
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_range, only: is_lost
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_words, only: shown, whole
    use gapbeam_scene, only: model_type, foundation_type, gapbeam_both, gapbeam_unchanged, gapbeam_law_by_points, gapbeam_axial, &
        force_along => gapbeam_axial_force, gapbeam_axial_distributed, gapbeam_temperature, gapbeam_movement
    use gapbeam_units, only: rotation_unit
    use gapbeam_assembled_model, only: assembled_type, from_to, axial_force_in, is_alone, turns, has_ground_along
    use gapbeam_piece_stiffness, only: stiffness_of
    use gapbeam_input_error, only: refuse, refuse_range, of_spans, of_sections, of_foundations, not_expected, bad_law
    implicit none
    private
    public :: has_axial_force, has_links_along, axial_loads_may_bend, in_stretches, only_foundations, what_stretches, &
        or_first_order, check_axial_force, check_masses, assign_axial_force

contains

    !> Is there an axial force that bending feels
    pure function has_axial_force(model) result(it_has)
        !> With all its arrays allocated
        type(model_type), intent(in) :: model
        logical :: it_has

        it_has = is_given(model) .or. model%axial_loads_bend
    end function has_axial_force

    !> Is one given for spans or sections
    pure function is_given(model) result(it_is)
        type(model_type), intent(in) :: model
        logical :: it_is

        it_is = any(abs(model%spans%N) > 0.0_wp) &
            .or. any(model%sections%N > gapbeam_unchanged .and. abs(model%sections%N) > 0.0_wp)
    end function is_given

    !> Are there supports that act along the beam otherwise than springs both ways: one way, by a law, or by friction
    pure function has_links_along(model, with_law) result(it_has)
        type(model_type), intent(in) :: model
        !> Which supports have a law
        logical, intent(in) :: with_law(:)
        logical :: it_has

        associate (s => model%supports)
            it_has = any(s%friction > 0.0_wp .or. (s%direction == gapbeam_axial .and. (s%side /= gapbeam_both .or. with_law)))
        end associate
    end function has_links_along

    !> Are there forces of axial loads, temperatures, settlements and stretching that bending might feel: those of a chain of bars,
    !> springs and links, which bending does not change
    pure function axial_loads_may_bend(model, with_law) result(they_may)
        !> With all its arrays allocated
        type(model_type), intent(in) :: model
        !> Which supports have a law
        logical, intent(in) :: with_law(:)
        logical :: they_may, moved
        integer :: i

        they_may = .false.
        if (model%first_order) return
        associate (s => model%supports, loads => model%loads)
            ! One support lets temperatures and settlements pass
            moved = .false.
            do i = 1, size(loads)
                if (loads(i)%kind /= gapbeam_movement) cycle
                if (loads(i)%node < 1 .or. loads(i)%node > size(s)) cycle
                moved = moved .or. s(loads(i)%node)%direction == gapbeam_axial
            end do
            they_may = any(s%direction == gapbeam_axial) &
                .and. any(loads%kind == force_along .or. loads%kind == gapbeam_axial_distributed) &
                .or. count(s%direction == gapbeam_axial) > 1 &
                .and. (any(s%direction == gapbeam_axial .and. (abs(s%settlement) > 0.0_wp .or. s%gap < 0.0_wp)) .or. moved &
                       .or. any(loads%kind == gapbeam_temperature .and. abs(loads%value_to) > 0.0_wp) .or. model%stretching)
            if (.not. they_may) return
            they_may = .not. (any(s%friction > 0.0_wp) .or. any(has_ground_along(model%sections)) &
                              .or. (has_links_along(model, with_law) .or. moved) .and. model%stretching &
                              .or. any(loads%kind == gapbeam_axial_distributed) .and. .not. may_change(model))
        end associate
    end function axial_loads_may_bend

    !> May the axial force change along a piece: series know that where nothing bends by shear, off ground that is rigid
    pure function may_change(model) result(it_may)
        type(model_type), intent(in) :: model
        logical :: it_may

        it_may = all(model%spans%GA > huge(1.0_wp)) &
            .and. .not. any(model%sections%GA > 0.0_wp .and. model%sections%GA <= huge(1.0_wp)) &
            .and. .not. any(model%foundations%k > huge(1.0_wp))
    end function may_change

    !> Is a beam solved stretch by stretch, each with functions of its own: on ground, with an axial force that bending feels, with
    !> mass, or with what influence lines of cubic pieces do not know under trains
    pure function in_stretches(model) result(it_is)
        !> With all its arrays allocated
        type(model_type), intent(in) :: model
        logical :: it_is

        it_is = size(model%foundations) > 0
        if (.not. it_is) it_is = has_axial_force(model) .or. any(model%spans%mass > 0.0_wp) .or. size(model%masses) > 0
        if (.not. it_is .and. model%with_trains) it_is = any(model%hinge_stiffness > 0.0_wp) .or. any(is_alone(model%loads)) &
            .or. any(turns(model%supports)) &
            .or. any(max(model%sections%EI_to, model%sections%GA_to) > gapbeam_unchanged)
    end function in_stretches

    !> Do foundations alone make it so
    pure function only_foundations(model) result(they_do)
        !> As for in_stretches
        type(model_type), intent(in) :: model
        logical :: they_do

        they_do = size(model%foundations) > 0 .and. .not. (has_axial_force(model) .or. any(model%spans%mass > 0.0_wp) &
                                                           .or. size(model%masses) > 0 .or. model%with_trains)
    end function only_foundations

    !> What makes it so, in words
    pure function what_stretches(model) result(words)
        type(model_type), intent(in) :: model
        character(len=24) :: words

        words = "trains"
        if (any(model%spans%mass > 0.0_wp) .or. size(model%masses) > 0) words = "a mass for frequencies"
        if (model%axial_loads_bend) words = "axial loads that bend it"
        if (is_given(model)) words = "an axial force N"
        if (size(model%foundations) > 0) words = "a foundation"
    end function what_stretches

    !> A way out of what is refused for that, in words behind others; none but beside axial loads
    pure function or_first_order(model) result(words)
        type(model_type), intent(in) :: model
        character(len=20) :: words

        words = ""
        if (model%axial_loads_bend) words = ", or set first_order"
    end function or_first_order

    !> Axial forces of spans, and what resists slopes of the beam on the ground
    subroutine check_axial_force(model, error)
        !> With all its arrays allocated
        type(model_type), intent(in) :: model
        !> Bad input, or what is not available
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        do i = 1, size(model%spans)
            associate (s => model%spans(i), m => size(model%spans))
                if (.not. abs(s%N) <= huge(1.0_wp)) then
                    call refuse(error, of_spans, i, m, not_expected, "N", "expected a finite number, tension positive, got "// &
                                trim(shown(s%N)))
                else if (.not. (s%mass >= 0.0_wp .and. s%mass <= huge(1.0_wp))) then
                    call refuse(error, of_spans, i, m, not_expected, "mass", "expected a finite number, 0 or more, got "// &
                                trim(shown(s%mass)))
                end if
            end associate
            if (allocated(error)) return
        end do
        do i = 1, size(model%foundations)
            call check_foundation(model%foundations(i), i)
            if (allocated(error)) return
        end do
        call check_stretching(model, error)
        if (allocated(error)) return
        if (.not. (in_stretches(model) .and. (has_axial_force(model) .or. any(model%foundations%shear > 0.0_wp) &
                                              .or. any(model%spans%mass > 0.0_wp) .or. size(model%masses) > 0))) return
        do i = 1, size(model%sections)
            associate (s => model%sections(i))
                if (.not. s%GA_to > gapbeam_unchanged) cycle
                call refuse(error, of_sections, i, size(model%sections), bad_law, "GA", "a GA that changes along a section "// &
                            "beside an axial force N, a shear of the ground or a mass is not available in this version; "// &
                            "give short sections, each of one GA")
                return
            end associate
        end do

    contains

        !> One foundation
        subroutine check_foundation(f, number)
            type(foundation_type), intent(in) :: f
            integer, intent(in) :: number

            if (.not. (f%shear >= 0.0_wp .and. f%shear <= huge(1.0_wp))) then
                call say("shear", not_expected, "expected a finite number, 0 or more, got "//trim(shown(f%shear)))
            else if (f%shear > 0.0_wp .and. (f%side /= gapbeam_both .or. abs(f%gap) > 0.0_wp &
                                             .or. (f%gap_to > gapbeam_unchanged .and. abs(f%gap_to) > 0.0_wp) &
                                             .or. f%law /= gapbeam_law_by_points .or. any(model%ground%foundation == number) &
                                             .or. any(model%ground_law%foundation == number))) then
                call say("shear", bad_law, "ground with a second parameter holds the beam both ways and has a modulus k, "// &
                         "without gap, profile, law or points, in this version; leave shear out, or give k alone")
            end if
        end subroutine check_foundation

        !> What is wrong with foundation i
        subroutine say(key, reason, problem)
            character(len=*), intent(in) :: key, problem
            integer, intent(in) :: reason

            call refuse(error, of_foundations, i, size(model%foundations), reason, key, problem)
        end subroutine say

    end subroutine check_axial_force

    !> Lumped masses
    subroutine check_masses(model, end, error)
        type(model_type), intent(in) :: model
        !> x of the right end
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error
        character(len=100) :: problem
        integer :: i

        do i = 1, size(model%masses, 2)
            associate (x => model%masses(1, i), mass => model%masses(2, i))
                if (.not. (x >= -position_tolerance*end .and. x <= end*(1 + position_tolerance))) then
                    problem = "x: expected a place on the beam, from 0 to "//trim(shown(end))//", got "//trim(shown(x))
                else if (.not. (mass >= 0.0_wp .and. mass <= huge(mass))) then
                    problem = "mass: expected a finite number, 0 or more, got "//trim(shown(mass))
                else
                    cycle
                end if
            end associate
            call fatal_error(error, gapbeam_bad_input, "masses("//trim(whole(i))//")."//trim(problem))
            error%key = "masses"
            error%entry = i
            return
        end do
    end subroutine check_masses

    !> What pulls a beam that its deflections lengthen
    subroutine check_stretching(model, error)
        type(model_type), intent(in) :: model
        !> Nothing holds it, or what is not available
        type(error_type), allocatable, intent(out) :: error

        if (.not. model%stretching) return
        if (count(model%supports%direction == gapbeam_axial) /= 2) then
            call fatal_error(error, gapbeam_bad_input, "a beam that its deflections stretch is held along its axis at two "// &
                             "places, not at "//trim(whole(count(model%supports%direction == gapbeam_axial)))//"; give two "// &
                             "supports of direction axial, or leave stretching out")
        else if (.not. model%axial_loads_bend) then
            call fatal_error(error, gapbeam_bad_input, "stretching beside first_order, friction, axial supports that act one "// &
                             "way, have a law or are moved by loads, and loads distributed along the beam is not available "// &
                             "in this version; leave one of both out")
        end if
        if (allocated(error)) error%key = "stretching"
    end subroutine check_stretching

    !> Axial forces of the pieces in the engine's units, with what ground there resists slopes with, and masses
    subroutine assign_axial_force(assembled, error)
        !> With the other numbers of its pieces
        type(assembled_type), intent(inout) :: assembled
        !> Out of range, or so great a compression that it bends by shear alone
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j

        if (allocated(assembled%tension_growth)) deallocate (assembled%tension_growth)
        if (assembled%model%N_grows .and. has_axial_force(assembled%model)) then
            allocate (assembled%tension_growth(size(assembled%pieces)))
        end if
        assembled%pieces%slope_stiffness = 0.0_wp
        do i = 1, size(assembled%model%foundations)
            if (.not. assembled%model%foundations(i)%shear > 0.0_wp) cycle
            do j = assembled%foundation_from(i) + 1, assembled%foundation_to(i)
                assembled%pieces(j)%slope_stiffness = assembled%pieces(j)%slope_stiffness &
                    + in_units(assembled%model%foundations(i)%shear)
            end do
        end do
        do j = 1, size(assembled%pieces)
            associate (p => assembled%pieces(j), N => stiffness_of(assembled, j, axial_force_in), units => assembled%units)
                p%tension = p%slope_stiffness + in_units(N)
                if (allocated(assembled%tension_growth)) assembled%tension_growth(j) = in_units(N)
                p%compression = max(0.0_wp, -p%tension)
                p%mass = scale(assembled%model%spans(assembled%point_span(j - 1) + 1)%mass, &
                               units%length + units%deflection - units%force)
                if (.not. abs(p%tension) <= huge(1.0_wp) .or. is_lost(abs(p%tension)) .and. abs(N) > 0.0_wp) then
                    call refuse_range(error, "N = "//trim(shown(N))//" "//trim(from_to(assembled, j - 1, j))// &
                                      " is too far from the stiffnesses of the beam", "bring them nearer together, or make it 0")
                else if (.not. 1 + p%tension*p%shear_flexibility > 0.0_wp) then
                    call refuse_range(error, "the compression N = "//trim(shown(N))//" "//trim(from_to(assembled, j - 1, j))// &
                                      " is not below GA there, so the beam gives way by shear alone", &
                                      "give less compression, or leave GA out")
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> A force along the beam in the engine's units: what it makes of a slope is a force across it
        pure function in_units(force)
            real(wp), intent(in) :: force
            real(wp) :: in_units

            in_units = scale(force, rotation_unit(assembled%units) - assembled%units%force)
        end function in_units

    end subroutine assign_axial_force

end module gapbeam_axial_force
