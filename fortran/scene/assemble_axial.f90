!> Assembly of the axial system of a model whose points are known, in units of its own.
module gapbeam_assemble_axial
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_range, only: is_lost
    use gapbeam_laws, only: is_smooth
    use gapbeam_taper, only: mean_softness
    use gapbeam_scene, only: gapbeam_axial, gapbeam_axial_force, gapbeam_axial_distributed, gapbeam_temperature, gapbeam_dead, &
        gapbeam_unchanged, gapbeam_below, gapbeam_infinity
    use gapbeam_units, only: exponents_type, stiffness_unit, units_with_loads, middle, middle_of, largest, no_exponent
    use gapbeam_assembled_model, only: assembled_type, point_x, from_to, piece_length, along_axis, has_ground_along, &
        has_springs_along
    use gapbeam_axial_force, only: has_links_along, in_stretches, only_foundations, what_stretches
    use gapbeam_piece_stiffness, only: stiffness_of, stiffness_along
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: refuse, refuse_range, named, of_supports, of_loads, of_sections, bad_load, bad_law
    use gapbeam_model, only: node_support_type
    use gapbeam_check_foundations, only: find_runs
    use gapbeam_assemble_laws, only: count_breakpoints, make_breakpoints
    implicit none
    private
    public :: assemble_axial, axial_node, moves_along

contains

    !> Flexibilities, supports and loads, if there is an axial system
    subroutine assemble_axial(assembled, error)
        !> Its points in
        type(assembled_type), intent(inout) :: assembled
        !> Numbers out of range
        type(error_type), allocatable, intent(out) :: error
        type(exponents_type) :: lengths, soft, stiff, forces, ways
        real(wp) :: length, EA, EA_to
        integer :: i, j, k, stiffness, unit, power

        if (.not. allocated(assembled%axial%point)) return
        associate (axial => assembled%axial, model => assembled%model)
            do j = 1, size(assembled%pieces)
                length = piece_length(assembled, j)
                EA = stiffness_of(assembled, j, along_axis)
                call lengths%note(length, 0)
                if (EA <= huge(EA)) call soft%note(length, -exponent(EA))
            end do
            do k = 1, size(model%supports)
                if (model%supports(k)%direction /= gapbeam_axial) cycle
                call stiff%note(model%supports(k)%stiffness, 0)
                call ways%note(abs(model%supports(k)%settlement), 0)
                call ways%note(abs(model%supports(k)%gap), 0)
            end do
            do k = 1, size(model%loads)
                if (model%loads(k)%kind == gapbeam_axial_force) call forces%note(abs(model%loads(k)%value), 0)
                if (model%loads(k)%kind == gapbeam_axial_distributed) then
                    call forces%note(abs(model%loads(k)%value)*assembled%ends(size(model%spans)), 0)
                end if
                if (model%loads(k)%kind /= gapbeam_temperature) cycle
                call ways%note(abs(model%loads(k)%value_to*assembled%ends(size(model%spans))), 0)
            end do
            stiffness = middle(stiff)
            if (middle(soft) /= no_exponent) stiffness = middle_of(-soft%low, -soft%high)
            do k = 1, size(model%sections)
                associate (limit => max(model%sections(k)%friction, model%sections(k)%friction_to))
                    if (limit <= huge(limit)) call forces%note(limit*assembled%ends(size(model%spans)), 0)
                end associate
            end do
            axial%units = units_with_loads(0, stiffness, largest(forces), largest(ways))
            unit = middle(lengths)
            axial%flexibility(:) = 0.0_wp
            i = 1
            do j = 1, size(assembled%pieces)
                call stiffness_along(assembled, j, along_axis, EA, EA_to, power)
                axial%softness(j) = scale(piece_length(assembled, j), -unit)/scale(EA, -unit - stiffness_unit(axial%units))
                if (power > 0) axial%softness(j) = axial%softness(j)*mean_softness(1.0_wp, EA/EA_to, power, 1.0_wp)
                if (EA <= huge(EA) .and. is_lost(axial%softness(j))) then
                    call refuse_range(error, "EA = "//trim(shown(EA))//" "//trim(from_to(assembled, j - 1, j))// &
                                      " is too far from the other axial stiffnesses", "bring them nearer together")
                    return
                end if
                axial%before(j) = axial%flexibility(i)
                axial%flexibility(i) = axial%flexibility(i) + axial%softness(j)
                if (axial%point(i) == j) i = i + 1
            end do
            axial%stiffness(:) = 0.0_wp
            axial%settlement(:) = 0.0_wp
            do k = 1, size(model%supports)
                i = axial%node(k)
                if (i < 0 .or. model%supports(k)%direction /= gapbeam_axial .or. assembled%with_law(k)) cycle
                associate (s => model%supports(k))
                    axial%stiffness(i) = scale(s%stiffness, -stiffness_unit(axial%units))
                    axial%settlement(i) = scale(s%settlement, -axial%units%deflection)
                    if (.not. is_lost(axial%stiffness(i)) .or. .not. s%stiffness > 0.0_wp .or. s%stiffness > huge(length)) cycle
                    call refuse_range(error, trim(named(of_supports, k, size(model%supports)))//": stiffness = "// &
                                      trim(shown(s%stiffness))//" is too far from the axial stiffness of the beam", &
                                      "make it infinite (rigid) or 0")
                    return
                end associate
            end do
            axial%force(:, :) = 0.0_wp
            if (allocated(axial%along_bar)) axial%along_bar(:, :) = 0.0_wp
            if (allocated(axial%elongation)) axial%elongation(:, :) = 0.0_wp
            do k = 1, size(model%loads)
                associate (load => model%loads(k))
                    if (load%kind == gapbeam_temperature .and. allocated(axial%elongation)) then
                        i = merge(1, 2, load%case == gapbeam_dead)
                        do j = assembled%load_from(k) + 1, assembled%load_to(k)
                            axial%elongation(i, j) = axial%elongation(i, j) &
                                + scale(load%value_to*piece_length(assembled, j), -axial%units%deflection)
                        end do
                    end if
                    if (load%kind == gapbeam_axial_distributed) then
                        call spread_along(assembled, k, error)
                        if (allocated(error)) return
                    end if
                    if (load%kind /= gapbeam_axial_force) cycle
                    i = axial_node(axial%point, assembled%load_from(k))
                    j = merge(1, 2, load%case == gapbeam_dead)
                    axial%force(j, i) = axial%force(j, i) + scale(load%value, -axial%units%force)
                end associate
            end do
            if (moves_along(assembled)) call check_curves(assembled, error)
            if (allocated(error)) return
            if (has_links_along(model, assembled%with_law) .or. moves_along(assembled)) call assemble_links_along(assembled)
            if (allocated(axial%limit)) call lay_ground(assembled, error)
        end associate
    end subroutine assemble_axial

    !> A load along the beam over a stretch: half of what is on a bar at either end, which leaves the elongation as it is
    subroutine spread_along(assembled, k, error)
        type(assembled_type), intent(inout) :: assembled
        !> Number of the load
        integer, intent(in) :: k
        !> The axial stiffness changes along a section there
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: half, EA, EA_to
        integer :: case, j, power

        associate (axial => assembled%axial, load => assembled%model%loads(k))
            case = merge(1, 2, load%case == gapbeam_dead)
            do j = assembled%load_from(k) + 1, assembled%load_to(k)
                call stiffness_along(assembled, j, along_axis, EA, EA_to, power)
                if (power > 0) then
                    call refuse(error, of_loads, k, size(assembled%model%loads), bad_load, "from", &
                                "a load along the beam where EA changes along a section is not available in this version; "// &
                                "give it as forces at places")
                    return
                end if
                half = scale(load%value*piece_length(assembled, j)/2, -axial%units%force)
                axial%along_bar(case, j) = axial%along_bar(case, j) + 2*half
                axial%force(case, j - 1) = axial%force(case, j - 1) + half
                axial%force(case, j) = axial%force(case, j) + half
            end do
        end associate
    end subroutine spread_along

    !> Ground along the beam: of stretches that overlap the last one
    subroutine lay_ground(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        !> What is not there beside it
        type(error_type), allocatable, intent(out) :: error
        character(len=*), parameter :: in_version = " is not available in this version"
        integer :: j, k
        real(wp) :: EA, EA_to
        integer :: power
        logical :: rigid

        associate (axial => assembled%axial, model => assembled%model, n => size(assembled%model%sections))
            axial%limit(:) = 0.0_wp
            if (allocated(axial%bedding)) axial%bedding(:) = 0.0_wp
            if (allocated(axial%bedding)) axial%limits(:, :) = 0.0_wp
            rigid = .false.
            do k = 1, n
                if (.not. has_ground_along(model%sections(k))) cycle
                rigid = rigid .or. .not. has_springs_along(model%sections(k))
                do j = assembled%section_from(k) + 1, assembled%section_to(k)
                    call lay_on_piece(k, j)
                end do
            end do
            if (rigid .and. allocated(axial%bedding)) then
                call say(" that is rigid beside such that has a stiffness,"//in_version//"; give all of it a stiffness")
                return
            end if
            if (any(is_smooth(model%supports%law))) then
                call say(" beside a support whose law is a curve"//in_version//"; give the points of the curve")
            else if (allocated(axial%laws) .or. any(model%supports%direction == gapbeam_axial .and. &
                                               abs(model%supports%settlement) > 0.0_wp)) then
                call say(" beside friction of supports, or axial supports that push one way, have a law, a settlement or a "// &
                         "movement,"//in_version//"; leave one of them out")
            else if (in_stretches(model) .and. .not. (allocated(axial%bedding) .and. only_foundations(model))) then
                call say(" beside "//trim(what_stretches(model))//in_version//"; their effects do not meet, so "// &
                         "look at them one by one")
            end if
            do j = 1, size(axial%limit)
                if (allocated(error)) return
                call stiffness_along(assembled, j, along_axis, EA, EA_to, power)
                if (power > 0) then
                    call say(" beside an EA that changes along a section"//in_version//"; give short sections, each of one EA")
                else if (EA > huge(EA)) then
                    call say(" needs the axial stiffness of the beam; give EA")
                else if (allocated(axial%along_bar) .and. .not. allocated(axial%bedding)) then
                    if (any(abs(axial%along_bar(:, j)) > 0.0_wp)) then
                        call say(" beside loads that are distributed along it"//in_version//"; give these as forces at places")
                    end if
                end if
            end do
        end associate

    contains

        !> One section on one piece
        subroutine lay_on_piece(k, j)
            integer, intent(in) :: k, j
            real(wp) :: limits(2), from, to

            associate (s => assembled%model%sections(k), axial => assembled%axial, length => piece_length(assembled, j))
                limits(:) = s%friction
                if (s%friction_to > gapbeam_unchanged) then
                    from = point_x(assembled, assembled%section_from(k))
                    to = point_x(assembled, assembled%section_to(k))
                    associate (share => (point_x(assembled, j - 1) - from)/(to - from), share_to => (point_x(assembled, j) - from) &
                               /(to - from))
                        limits(:) = [s%friction*(1 - share) + s%friction_to*share, &
                                     s%friction*(1 - share_to) + s%friction_to*share_to]
                    end associate
                end if
                limits(:) = scale(limits*length, -axial%units%force)
                axial%limit(j) = sum(limits)/2
                if (.not. allocated(axial%bedding)) return
                axial%limits(:, j) = limits
                axial%bedding(j) = scale(s%bedding*length, -stiffness_unit(axial%units))
            end associate
        end subroutine lay_on_piece

        !> What is wrong
        subroutine say(problem)
            character(len=*), intent(in) :: problem

            associate (sections => assembled%model%sections)
                call refuse(error, of_sections, findloc(has_ground_along(sections), .true., 1), size(sections), bad_law, &
                            "friction", "ground along the beam"//problem)
            end associate
        end subroutine say

    end subroutine lay_ground

    !> Refuse supports whose law is a curve where a load moves a support along the beam
    subroutine check_curves(assembled, error)
        type(assembled_type), intent(in) :: assembled
        !> The support that moves
        type(error_type), allocatable, intent(out) :: error

        associate (s => assembled%model%supports)
            if (.not. any(is_smooth(s%law))) return
            call refuse(error, of_supports, findloc(s%direction == gapbeam_axial .and. abs(assembled%growth) > 0.0_wp, .true., 1), &
                        size(s), bad_law, "direction", "a load that moves an axial support beside a support whose law is a "// &
                        "curve is not available in this version; give the points of the curve")
        end associate
    end subroutine check_curves

    !> Does a load move a support along the beam
    pure function moves_along(assembled) result(it_does)
        type(assembled_type), intent(in) :: assembled
        logical :: it_does

        it_does = .false.
        if (.not. allocated(assembled%growth)) return
        it_does = any(assembled%model%supports%direction == gapbeam_axial .and. abs(assembled%growth) > 0.0_wp)
    end function moves_along

    !> Node of the axial system at a point, or else the next one to the right, with which the bar there ends
    pure function axial_node(points, point) result(node)
        !> Points of the nodes, shape (0:n), and the point
        integer, intent(in) :: points(0:), point
        integer :: node, high, middle

        node = 0
        high = ubound(points, 1)
        do while (node < high)
            middle = node + (high - node)/2
            if (points(middle) < point) then
                node = middle + 1
            else
                high = middle
            end if
        end do
    end function axial_node

    !> The links in units of the axial system, one entry a breakpoint
    pure subroutine assemble_links_along(assembled)
        !> With its axial system and the units of that
        type(assembled_type), intent(inout) :: assembled
        integer, allocatable :: first(:), last(:), size_of(:)
        integer :: k, m, n

        associate (axial => assembled%axial, given => assembled%model%supports, law => assembled%law)
            allocate (first(size(given)), last(size(given)), size_of(size(given)))
            call find_runs(law%support, first, last)
            size_of(:) = 0
            do k = 1, size(given)
                if (axial%node(k) < 0) cycle
                if (given(k)%direction /= gapbeam_axial) then
                    ! A slider: two limits with a rigid piece between them
                    size_of(k) = 2
                else if (assembled%with_law(k)) then
                    size_of(k) = count_breakpoints(given(k), law(first(k):last(k)))
                else if (given(k)%stiffness > 0.0_wp) then
                    size_of(k) = 1
                end if
            end do
            n = sum(size_of)
            ! Of a beam with the loads of a case they are there already
            if (allocated(axial%laws)) deallocate (axial%laws, axial%support, axial%rubs)
            allocate (axial%laws(n), axial%support(n), axial%rubs(n))
            m = 0
            do k = 1, size(given)
                if (size_of(k) == 0) cycle
                associate (s => axial%laws(m + 1:m + size_of(k)))
                    axial%support(m + 1:m + size_of(k)) = k
                    axial%rubs(m + 1:m + size_of(k)) = given(k)%direction /= gapbeam_axial
                    if (given(k)%direction /= gapbeam_axial) then
                        s(1) = node_support_type(axial%node(k), gapbeam_below, gapbeam_infinity, 0.0_wp, 1, .true.)
                        s(2) = node_support_type(axial%node(k), gapbeam_below, 0.0_wp, 0.0_wp, 2, before=gapbeam_infinity)
                    else if (assembled%with_law(k)) then
                        call make_breakpoints(given(k), law(first(k):last(k)), axial%node(k), s)
                    else
                        s(1) = node_support_type(axial%node(k), given(k)%side, given(k)%stiffness, given(k)%settlement &
                                                 + given(k)%side*given(k)%gap)
                    end if
                end associate
                m = m + size_of(k)
            end do
            axial%laws%contact = scale(axial%laws%contact, -axial%units%deflection)
            axial%laws%force = scale(axial%laws%force, -axial%units%force)
            axial%laws%stiffness = scale(axial%laws%stiffness, -stiffness_unit(axial%units))
            axial%laws%before = scale(axial%laws%before, -stiffness_unit(axial%units))
        end associate
    end subroutine assemble_links_along

end module gapbeam_assemble_axial
