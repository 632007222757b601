!> States at load factors on a path; with smooth laws of supports on the laws themselves, wherever they are known there.
module gapbeam_path_states
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: off_its_law, off_its_polyline, arc_settled
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: named, of_supports
    use gapbeam_laws, only: law_force, law_scale, law_displacement, law_points, begins_steep
    use gapbeam_polyline, only: node_support_type
    use gapbeam_extended_precision, only: rule_given, rule_extended
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_laws, only: depends_on_path
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: solve_state
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, force_and_slope, deflection_at, largest_deflection, &
        reaction_at, put_line
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_smooth_arc, only: arc_type, springs_at, is_lost
    use gapbeam_smooth_branches, only: tracer_at, point_at_factor
    use gapbeam_history_record, only: history_type, scheme_at, laws_at, same_laws
    use gapbeam_axial_links, only: take_numbers
    use gapbeam_ground_along_states, only: take_ground_along
    use gapbeam_bedding_path, only: take_bedding
    use gapbeam_unloaded_laws, only: find_unloaded
    use gapbeam_path_on_laws, only: view_type, find_at, is_known, through, given_factor, start_of_stretch, stop_of_stretch
    implicit none
    private
    public :: solve_on_path, take_along, find_lines, is_exact, audit_lines
    public :: with_lines, by_tangents, on_polylines

    !> How a state is known: lines stand in place of smooth laws at their points; tangents lead to it; on their polylines only
    integer, parameter :: by_tangents = 1, with_lines = 2, on_polylines = 3

contains

    !> The state at a load factor on a stretch
    subroutine solve_on_path(beam, history, stretch, factor, state, error, exact)
        !> With the loads of the leg: its dead ones as live ones while these are put on
        type(assembled_type), intent(in), target :: beam
        !> By follow_on_laws
        type(history_type), intent(in), target :: history
        integer, intent(in) :: stretch
        real(wp), intent(in) :: factor
        !> New in
        type(state_type), intent(inout) :: state
        !> As for solve_state; or forces that are not those of the laws
        type(error_type), allocatable, intent(out) :: error
        !> Is it on the smooth laws themselves
        logical, intent(out), optional :: exact
        type(node_support_type), allocatable :: laws(:)
        type(assembled_type) :: changed
        integer :: number, how

        number = stretch
        how = with_lines
        if (allocated(history%on_laws)) then
            call find_lines(beam, history, number, factor, laws, how, error)
            if (allocated(error)) return
        else
            allocate (laws, source=laws_at(beam, history, stretch))
        end if
        if (present(exact)) exact = how /= on_polylines
        state%closed(:) = scheme_at(history, number)
        if (how == by_tangents) then
            if (same_laws(laws, beam%beam%supports)) then
                call solve_on_laws(beam, factor, rule_given, state, error)
            else
                changed = beam
                changed%beam%supports = laws
                changed%depends_on_path = depends_on_path(changed)
                call solve_on_laws(changed, factor, rule_given, state, error)
            end if
            return
        end if
        if (.not. same_laws(laws, beam%beam%supports)) call move_alloc(laws, state%laws)
        call solve_state(beam, factor, merge(rule_extended, rule_given, allocated(history%on_laws)), state, error)
        if (allocated(history%along) .and. .not. allocated(error)) call take_along(beam, history, stretch, factor, state, error)
        if (.not. allocated(history%on_laws) .or. allocated(error)) return
        call audit_lines(beam, factor, how == on_polylines, state, error)
    end subroutine solve_on_path

    !> What there is along the beam at a load factor on a stretch
    subroutine take_along(beam, history, stretch, factor, state, error)
        type(assembled_type), intent(in) :: beam
        !> With links or ground along the beam
        type(history_type), intent(in) :: history
        integer, intent(in) :: stretch
        real(wp), intent(in) :: factor
        !> Of the same beam
        type(state_type), intent(inout) :: state
        !> As for take_ground_along
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: values(:)
        real(wp) :: share

        if (allocated(beam%axial%bedding)) then
            call take_bedding(beam, history, stretch, factor, state, error)
            return
        else if (allocated(history%along%on_ground)) then
            call take_ground_along(beam, history, stretch, factor, state, error)
            return
        end if
        associate (s => history%stretches(stretch), along => history%along)
            share = 0.0_wp
            if (abs(s%to - s%from) > 0.0_wp) share = (factor - s%from)/(s%to - s%from)
            values = (1 - share)*along%columns(s%ends(1))%x + share*along%columns(s%ends(2))%x
            call take_numbers(beam, values, along%support, s%along, state)
            if (allocated(s%along_contact)) state%along_contact = s%along_contact
            state%loose_along = s%loose .and. .not. state%indifferent
            state%indifferent = state%indifferent .or. s%loose
        end associate
    end subroutine take_along

    !> Is the end of a stretch known on the laws
    pure function is_exact(history, stretch) result(it_is)
        type(history_type), intent(in) :: history
        integer, intent(in) :: stretch
        logical :: it_is

        it_is = .not. allocated(history%on_laws)
        if (it_is) return
        associate (known => history%on_laws)
            it_is = allocated(known%ends(stop_of_stretch, stretch)%x) &
                .or. (known%unique .and. known%joins(stretch) == given_factor)
        end associate
    end function is_exact

    !> Lines in place of smooth laws in the state at a load factor
    subroutine find_lines(beam, history, stretch, factor, laws, how, error)
        !> As for solve_on_path
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in), target :: history
        !> One of its run in; that with the scheme out
        integer, intent(inout) :: stretch
        real(wp), intent(in) :: factor
        !> Of all supports; polylines where no lines are known
        type(node_support_type), allocatable, intent(out) :: laws(:)
        !> with_lines, by_tangents or on_polylines
        integer, intent(out) :: how
        !> No memory, or no time
        type(error_type), allocatable, intent(out) :: error
        type(view_type) :: view
        type(arc_type) :: arc
        real(wp), allocatable :: x(:)
        integer :: k, first, last, number
        logical :: not_known, told

        if (stretch >= history%on_laws%unloaded(1)) then
            call find_unloaded(beam, history, stretch, factor, laws, told, error)
            how = merge(with_lines, on_polylines, told)
            if (.not. told) laws = laws_at(beam, history, stretch)
            return
        end if
        view%assembled => beam
        view%dead => beam
        view%history => history
        how = with_lines
        associate (s => history%stretches, known => history%on_laws)
            k = findloc(known%runs(1, :) <= stretch .and. known%runs(2, :) >= stretch, .true., 1)
            first = known%runs(1, k)
            last = known%runs(2, k)
            if (is_known(view, first, start_of_stretch) .and. .not. abs(s(first)%from - factor) > 0.0_wp) then
                stretch = first
                x = known%ends(start_of_stretch, first)%x
            else if (is_known(view, last, stop_of_stretch) .and. .not. abs(s(last)%to - factor) > 0.0_wp) then
                stretch = last
                x = known%ends(stop_of_stretch, last)%x
            else if (known%traced == stretch) then
                call find_on_branch(beam, history, factor, x, error)
                if (is_lost(error)) then
                    deallocate (error)
                    how = on_polylines
                end if
                if (allocated(error)) return
            end if
            laws = laws_at(beam, history, stretch)
            if (allocated(x)) call put_lines(beam, x, laws)
            if (allocated(x) .or. how == on_polylines) return
            not_known = known%joins(last) /= through .and. .not. is_exact(history, last)
            if (abs(factor - s(last)%to) > 0.0_wp) not_known = .false.
            do k = first, last - 1
                if (s(first)%direction*(s(k)%to - factor) >= 0.0_wp) exit
            end do
            stretch = k
            if (.not. not_known) then
                call find_at(view, k, factor, arc, number, error)
                if (.not. allocated(error)) then
                    laws = arc%known(number)%one%state%laws
                    return
                end if
                if (.not. is_lost(error)) return
                deallocate (error)
            end if
            how = merge(by_tangents, on_polylines, known%unique .and. .not. not_known)
            laws = laws_at(beam, history, k)
        end associate
    end subroutine find_lines

    !> Deflections at the laws at a load factor on the branch beyond a bifurcation
    subroutine find_on_branch(beam, history, factor, x, error)
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in) :: history
        real(wp), intent(in) :: factor
        !> Not allocated where there is no such state
        real(wp), allocatable, intent(out) :: x(:)
        type(error_type), allocatable, intent(out) :: error
        type(arc_type), target :: arc
        real(wp), allocatable :: point(:)

        associate (known => history%on_laws)
            arc = known%arc
            arc%assembled => beam
            allocate (point(size(known%branch, 1)))
            call point_at_factor(tracer_at(arc, known%branch(:, 1)), known%branch, factor, point, error)
            if (.not. allocated(error)) x = point(:size(point) - 1)
        end associate
    end subroutine find_on_branch

    !> Put lines through the points of the laws at given deflections
    subroutine put_lines(beam, deflection, laws)
        type(assembled_type), intent(in) :: beam
        !> At the smooth laws
        real(wp), intent(in) :: deflection(:)
        !> Polylines in
        type(node_support_type), intent(inout) :: laws(:)
        integer, allocatable :: numbers(:)
        real(wp) :: springs(size(deflection)), past, force, slope
        integer :: j, way

        allocate (numbers, source=smooth_supports(beam))
        springs(:) = springs_at(beam, numbers, deflection)
        do j = 1, size(numbers)
            associate (s => beam%model%supports(numbers(j)))
                call past_the_gap(s, deflection(j), past, way)
                call force_and_slope(s, past, force, slope)
                call put_line(beam, numbers(j), deflection(j), way*force, springs(j), laws)
            end associate
        end do
    end subroutine put_lines

    !> Refuse a state in which a support has not the force of its law
    subroutine audit_lines(beam, factor, rough, state, error)
        type(assembled_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> Is it known on the polylines only
        logical, intent(in) :: rough
        type(state_type), intent(in) :: state
        !> Which support, and both forces
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: numbers(:)
        real(wp) :: past, force, slope, off, most, least, largest, closest, near, pushes, found, given
        real(wp), allocatable :: points(:, :)
        integer :: i, j, way, worst

        allocate (numbers, source=smooth_supports(beam))
        largest = 0.0_wp
        do i = 1, size(beam%model%supports)
            if (beam%beam_support(i) > 0) largest = max(largest, abs(reaction_at(beam, state%reaction, i)))
        end do
        largest = largest*merge(off_its_polyline, off_its_law, rough)
        closest = arc_settled*largest_deflection(beam, state%deflection)
        worst = 0
        most = 0.0_wp
        found = 0.0_wp
        given = 0.0_wp
        do j = 1, size(numbers)
            associate (s => beam%model%supports(numbers(j)))
                call past_the_gap(s, deflection_at(beam, state%deflection, numbers(j)), past, way)
                call force_and_slope(s, past, force, slope)
                off = abs(reaction_at(beam, state%reaction, numbers(j)) - way*force)
                ! Nothing where nothing acts: rounding of what the law gives
                least = arc_settled*law_force(s%law, s%parameter, law_scale(s%law, s%parameter))
                if (off <= largest + least .or. off <= most) cycle
                ! Where it begins steep, rounding of the deflection makes much of the force, and so does a polyline's first piece
                if (begins_steep(s%law, s%parameter)) then
                    pushes = max(0.0_wp, way*reaction_at(beam, state%reaction, numbers(j)))
                    near = closest
                    if (rough) then
                        points = law_points(s%law, s%parameter)
                        near = max(near, points(1, 1))
                    end if
                    if (abs(max(past, 0.0_wp) - law_displacement(s%law, s%parameter, pushes)) <= near) cycle
                end if
                most = off
                worst = numbers(j)
                found = reaction_at(beam, state%reaction, worst)
                given = way*force + 0.0_wp
            end associate
        end do
        if (worst == 0) return
        call fatal_error(error, gapbeam_not_converged, trim(named(of_supports, worst, size(beam%model%supports)))// &
                         ": law: at load factor "//trim(shown(factor))//" the path leads to a reaction of "//trim(shown(found))// &
                         ", where the law gives "//trim(shown(given))//": the supports may carry less than this load; lower "// &
                         "it, or give the laws as polylines")
    end subroutine audit_lines

end module gapbeam_path_states
