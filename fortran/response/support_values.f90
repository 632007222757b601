!> Reactions, openings and states of the supports in a solved state, in the user's units.
module gapbeam_support_values
    use gapbeam_kinds, only: wp
    use gapbeam_model, only: node_support_type, both
    use gapbeam_laws, only: is_smooth
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_scene, only: support_type, gapbeam_axial, gapbeam_normal, gapbeam_relative
    use gapbeam_units, only: moment_unit
    use gapbeam_assembled_model, only: assembled_type, turns, way_unit, push_unit
    use gapbeam_smooth_laws, only: past_the_gap
    use gapbeam_solution, only: state_type, couple_at_node, displacement_at, way_to_contact, laws_in, laws_along
    use gapbeam_pieces, only: acting_type, acting_piece, gapbeam_open, gapbeam_closed, gapbeam_bilateral, gapbeam_branch
    implicit none
    private
    public :: support_values, friction_values, find_undecided

contains

    !> Values at all supports, in the order of the model
    pure subroutine support_values(assembled, state, reaction, deflection, opening, couple, condition)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Force on the beam, up; of an axial support to the right; couple of one that holds a rotation, counterclockwise, or the
        !> sagging moment of a hinge, shape (nsupport)
        real(wp), intent(out) :: reaction(:)
        !> Deflection of the beam there, down; at an axial support to the right; the rotation that one holds, shape (nsupport)
        real(wp), intent(out) :: deflection(:)
        !> Distance still to go until it acts, negative where the beam has gone past one without stiffness, shape (nsupport)
        real(wp), intent(out) :: opening(:)
        !> Couple on the beam, clockwise; of what holds a rotation alone it is told at the support there, shape (nsupport)
        real(wp), intent(out) :: couple(:)
        !> gapbeam_open, gapbeam_closed or gapbeam_bilateral; of a support with a law gapbeam_open or gapbeam_branch plus the number
        !> of the piece, shape (nsupport)
        integer, intent(out) :: condition(:)
        integer :: j, k, last
        type(node_support_type), allocatable :: laws(:)
        logical :: has_law
        real(wp) :: past
        integer :: way

        if (any(assembled%with_law)) allocate (laws, source=laws_in(assembled, state))
        associate (units => assembled%units, beam => assembled%beam, axial => assembled%axial)
            do k = 1, size(reaction)
                reaction(k) = 0.0_wp
                deflection(k) = 0.0_wp
                opening(k) = 0.0_wp
                couple(k) = 0.0_wp
                condition(k) = gapbeam_bilateral
                ! One piece both ways is a spring
                if (assembled%with_law(k)) condition(k) = gapbeam_branch + 1
                associate (s => assembled%model%supports(k), node => assembled%node_of_point(assembled%support_point(k)))
                    if (s%direction == gapbeam_axial) then
                        call value_along(assembled, state, k, reaction(k), deflection(k), opening(k), condition(k))
                        cycle
                    end if
                    j = assembled%beam_support(k)
                    deflection(k) = scale(displacement_at(assembled, state, k), way_unit(assembled, k))
                    last = j
                    has_law = .false.
                    if (j > 0) then
                        last = last_breakpoint(beam%supports, j)
                        has_law = beam%supports(j)%breakpoint > 0
                        ! Of a law the breakpoint whose piece acts has the force
                        reaction(k) = scale(sum(state%reaction(j:last)), push_unit(assembled, k))
                    end if
                    if (has_law) then
                        call state_of_law(laws(j:last), s%side, state%closed(j:last), displacement_at(assembled, state, k), &
                                          condition(k), opening(k))
                        opening(k) = scale(opening(k), way_unit(assembled, k))
                        if (is_smooth(s%law)) then
                            call past_the_gap(s, deflection(k), past, way)
                            opening(k) = max(0.0_wp, -past)
                            condition(k) = min(condition(k), gapbeam_branch + 1)
                        end if
                    else if (s%side /= both) then
                        condition(k) = gapbeam_open
                        if (j > 0) condition(k) = merge(gapbeam_closed, gapbeam_open, state%closed(j))
                        opening(k) = scale(way_to_contact(assembled, state, k), way_unit(assembled, k))
                        ! The beam goes past a support without stiffness
                        if (j > 0) opening(k) = merge(0.0_wp, max(0.0_wp, opening(k)), state%closed(j))
                    end if
                    if (turns(s)) then
                        ! The moment of a hinge is inside the beam
                        if (holds_beam(s)) couple(k) = 0.0_wp - reaction(k)
                        cycle
                    end if
                    if (.not. assembled%couple_share(k) > 0.0_wp) cycle
                    couple(k) = scale(couple_at_node(assembled, state, node)*assembled%couple_share(k), moment_unit(units))
                end associate
            end do
        end associate
        call give_couples(assembled, couple)
    end subroutine support_values

    !> The couple of a support that holds the rotation alone is told of the one across the beam at its place, if there is one
    pure subroutine give_couples(assembled, couple)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(inout) :: couple(:)
        integer, allocatable :: host(:)
        integer :: k

        if (.not. any(holds_beam(assembled%model%supports))) return
        allocate (host(0:maxval(assembled%support_point)), source=0)
        associate (s => assembled%model%supports, at => assembled%support_point)
            do k = size(couple), 1, -1
                if (s(k)%direction == gapbeam_normal) host(at(k)) = k
            end do
            do k = 1, size(couple)
                if (.not. holds_beam(s(k)) .or. host(at(k)) == 0) cycle
                couple(host(at(k))) = couple(host(at(k))) + couple(k)
                couple(k) = 0.0_wp
            end do
        end associate
    end subroutine give_couples

    !> Does a support hold a rotation against what is outside the beam, not as a hinge
    elemental function holds_beam(support) result(it_does)
        type(support_type), intent(in) :: support
        logical :: it_does

        it_does = turns(support) .and. support%direction /= gapbeam_relative
    end function holds_beam

    !> The same of a support along the beam
    pure subroutine value_along(assembled, state, k, reaction, deflection, opening, condition)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: k
        !> In the user's units; the first two and the condition as for a beam without axial system in
        real(wp), intent(inout) :: reaction, deflection
        real(wp), intent(out) :: opening
        integer, intent(inout) :: condition
        integer :: first, last

        associate (axial => assembled%axial, s => assembled%model%supports(k))
            opening = 0.0_wp
            if (s%side /= both) then
                opening = max(0.0_wp, s%gap)
                if (opening > 0.0_wp) condition = gapbeam_open
                if (condition == gapbeam_bilateral) condition = gapbeam_closed
            end if
            if (.not. allocated(axial%node)) return
            deflection = scale(state%displacement(axial%node(k)), axial%units%deflection)
            if (.not. allocated(state%along)) then
                if (.not. allocated(axial%laws)) reaction = scale(state%axial_reaction(axial%node(k)), axial%units%force)
                return
            end if
            reaction = scale(state%along_force(k), axial%units%force)
            first = findloc(axial%support, k, 1)
            if (first == 0) return
            last = last_breakpoint(axial%laws, first)
            call state_of_law(laws_along(assembled, state, first, last), s%side, state%along(first:last), &
                              state%displacement(axial%node(k)), condition, opening)
            opening = scale(opening, axial%units%deflection)
        end associate
    end subroutine value_along

    !> Forces of friction on the beam, how far it has gone over the supports, both to the right, and whether it slides
    pure subroutine friction_values(assembled, state, force, slip, slides)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> In the user's units, shape (nsupport)
        real(wp), intent(out) :: force(:), slip(:)
        !> 1 to the right, -1 to the left, 0: it sticks
        integer, intent(out) :: slides(:)
        integer :: k

        force(:) = 0.0_wp
        slip(:) = 0.0_wp
        slides(:) = 0
        if (.not. allocated(state%along)) return
        associate (axial => assembled%axial)
            do k = 1, size(axial%laws) - 1
                if (.not. (axial%rubs(k) .and. axial%laws(k)%more)) cycle
                force(axial%support(k)) = scale(state%along_force(axial%support(k)), axial%units%force)
                slip(axial%support(k)) = scale(state%displacement(axial%laws(k)%node), axial%units%deflection)
                slides(axial%support(k)) = count(state%along(k:k + 1)) - 1
            end do
        end associate
    end subroutine friction_values

    !> Which piece of a law acts, as a condition, and how far it is open
    pure subroutine state_of_law(breakpoints, side, closed, deflection, condition, opening)
        type(node_support_type), intent(in) :: breakpoints(:)
        !> Side of the support, and the scheme of its breakpoints
        integer, intent(in) :: side
        logical, intent(in) :: closed(:)
        !> Of its node
        real(wp), intent(in) :: deflection
        integer, intent(out) :: condition
        real(wp), intent(out) :: opening
        type(acting_type) :: acting

        acting = acting_piece(breakpoints, side, closed)
        condition = acting%condition
        opening = 0.0_wp
        if (condition == gapbeam_open) opening = way_to_law(breakpoints, side, deflection)
    end subroutine state_of_law

    !> How far a law is open
    pure function way_to_law(breakpoints, side, deflection) result(way)
        type(node_support_type), intent(in) :: breakpoints(:)
        integer, intent(in) :: side
        real(wp), intent(in) :: deflection
        real(wp) :: way

        associate (middle => size(breakpoints)/2)
            if (side == both) then
                way = min(breakpoints(middle + 1)%contact - deflection, deflection - breakpoints(middle)%contact)
            else
                way = side*(breakpoints(1)%contact - deflection)
            end if
        end associate
        way = max(0.0_wp, way)
    end function way_to_law

    !> Supports whose reaction or opening is zero: open or closed is not decided
    pure subroutine find_undecided(assembled, state, undecided)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> In the order of the model, shape (nsupport)
        logical, intent(out) :: undecided(:)
        integer :: j

        undecided(:) = .false.
        do j = 1, size(assembled%normal)
            undecided(assembled%normal(j)) = undecided(assembled%normal(j)) .or. state%undecided(j)
        end do
    end subroutine find_undecided

end module gapbeam_support_values
