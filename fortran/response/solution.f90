!> The state of a beam at one load factor as numbers, checked to be finite.
module gapbeam_solution
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_indeterminate
    use gapbeam_element, only: field_type
    use gapbeam_polyline, only: node_support_type, last_breakpoint
    use gapbeam_tolerances, only: rounding_unit
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: refuse_range, named, of_supports
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_scene, only: gapbeam_axial
    use gapbeam_units, only: moment_unit
    use gapbeam_ground_along, only: ground_along_type
    use gapbeam_assembled_model, only: assembled_type, growth_of, turns, way_unit, push_unit, point_x
    use gapbeam_model, only: last_place
    use gapbeam_assemble_supports, only: contact_level, is_room
    use gapbeam_assemble_units, only: name_farthest
    implicit none
    private
    public :: state_type, new_state, close_all, forget, check_range, check_room, couple_at_node, displacement_at, way_to_contact, &
        level_at, has_own_laws, laws_in, laws_along

    !> A state, in the engine's units and those of the axial system; arrays have one entry per support of the engine's beam, or
    !> per node 0..n
    type :: state_type
        !> gapbeam_solved or gapbeam_no_equilibrium; -1: nothing solved yet
        integer :: status = -1
        !> Load factor of the live loads
        real(wp) :: factor = 0.0_wp
        !> Fingerprint of the model with the loads that were solved
        integer :: fingerprint = 0
        !> Linear solves it took, and the system solved last (gapbeam_system)
        integer :: solves = 0, method = 0
        !> Can the beam move freely without work of the loads; does it slide along its axis
        logical :: indifferent = .false., slides = .false.
        !> With links along the beam: can it move freely along its axis alone
        logical :: loose_along = .false.
        !> Did the rule single come back to a scheme
        logical :: cycled = .false.
        !> The scheme: which supports act, and whose reaction or opening is zero, so that they may be closed or open
        logical, allocatable :: closed(:), undecided(:)
        !> The laws of the supports as they have become, where they are not those of the beam
        type(node_support_type), allocatable :: laws(:)
        !> Deflections and moments left and right of the nodes; the free motion where there is no equilibrium
        real(wp), allocatable :: deflection(:), moment_left(:), moment_right(:), motion(:)
        !> Shear of every link beside that of the simple bar
        real(wp), allocatable :: shear(:)
        real(wp), allocatable :: reaction(:)
        !> Displacements and reactions of the axial system's points, forces in its bars; of size 0 without one
        real(wp), allocatable :: displacement(:), axial_reaction(:), tension(:)
        !> By what deflections lengthen the bars, where that pulls the beam
        real(wp), allocatable :: stretched(:)
        !> With links along the beam: their scheme, and the force on the beam, to the right, of every support of the model
        logical, allocatable :: along(:)
        real(wp), allocatable :: along_force(:)
        !> Contacts of their laws as they have become, where some keep a set, shape (size(axial%laws))
        real(wp), allocatable :: along_contact(:)
        !> On ground that holds the beam along its axis
        type(ground_along_type), allocatable :: along_ground
        !> On the ground, what is in its stretches
        type(ground_solution_type), allocatable :: ground
        !> Fields at the left end of every piece; made when first asked for
        type(field_type), allocatable :: starts(:)
        logical :: has_starts = .false.
    end type state_type

contains

    !> A state for a beam, nothing solved, all supports closed, those with a law on its first piece
    subroutine new_state(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        !> Ready for solve_state
        type(state_type), intent(out) :: state
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: n, m, bars, stat

        n = size(assembled%beam%links)
        m = size(assembled%beam%supports)
        bars = 0
        if (allocated(assembled%axial%point)) bars = ubound(assembled%axial%point, 1)
        allocate (state%closed(m), state%undecided(m), state%reaction(m), state%deflection(0:last_place(assembled%beam)), &
                  state%moment_left(0:n), state%moment_right(0:n), state%motion(0:n), state%shear(n), state%displacement(0:bars), &
                  state%axial_reaction(0:bars), state%tension(bars), state%starts(size(assembled%pieces)), stat=stat)
        if (failed(stat, error)) return
        call close_all(assembled, state%closed)
        state%displacement(:) = 0.0_wp
        state%axial_reaction(:) = 0.0_wp
        state%tension(:) = 0.0_wp
        state%starts(:) = field_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        call forget(state)
    end subroutine new_state

    !> The scheme that a search starts from: all supports closed, those with a law on its first piece
    pure subroutine close_all(assembled, closed)
        type(assembled_type), intent(in) :: assembled
        !> Shape (size(beam%supports))
        logical, intent(out) :: closed(:)
        integer :: k, last, first_piece

        closed(:) = .true.
        associate (supports => assembled%beam%supports)
            do k = 1, size(closed)
                if (supports(k)%breakpoint /= 1) cycle
                last = last_breakpoint(supports, k)
                first_piece = 1
                if (assembled%model%supports(assembled%normal(k))%side == 0) first_piece = max(1, (last - k + 1)/2)
                closed(k + first_piece:last) = .false.
            end do
        end associate
    end subroutine close_all

    !> Numbers of an earlier solve are not to be taken for those of a later one
    pure subroutine forget(state)
        type(state_type), intent(inout) :: state

        state%status = -1
        state%solves = 0
        state%method = 0
        state%indifferent = .false.
        state%slides = .false.
        state%loose_along = .false.
        state%cycled = .false.
        state%has_starts = .false.
        if (allocated(state%ground)) deallocate (state%ground)
        state%undecided(:) = .false.
        state%reaction(:) = 0.0_wp
        state%deflection(:) = 0.0_wp
        state%moment_left(:) = 0.0_wp
        state%moment_right(:) = 0.0_wp
        state%motion(:) = 0.0_wp
        state%shear(:) = 0.0_wp
    end subroutine forget

    !> Refuse a solution with numbers that are none, or none in the user's units
    subroutine check_range(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(inout) :: state
        !> Set, and the state forgotten, where that is so
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j, k

        if (clearly_in_range(assembled, state)) return
        associate (units => assembled%units, axial => assembled%axial)
            do i = 0, ubound(state%moment_left, 1)
                call check_finite(state%deflection(i), units%deflection, "deflection", "length", assembled%node_point(i))
                call check_finite(state%moment_left(i), moment_unit(units), "moment", "force", assembled%node_point(i))
                call check_finite(state%moment_right(i), moment_unit(units), "moment", "force", assembled%node_point(i))
                if (i > 0) call check_finite(state%shear(i), units%force, "shear", "force", assembled%node_point(i))
                if (assembled%turning(i) > 0.0_wp) then
                    call check_finite(couple_at_node(assembled, state, i), moment_unit(units), &
                                      "couple of the rotational restraint", "force", assembled%node_point(i))
                end if
            end do
            do k = 1, size(assembled%model%supports)
                j = assembled%beam_support(k)
                associate (point => assembled%support_point(k))
                    if (j > 0) call check_finite(sum(state%reaction(j:last_breakpoint(assembled%beam%supports, j))), &
                                                 push_unit(assembled, k), "reaction of the support", "force", point)
                    if (assembled%model%supports(k)%side == 0 .or. assembled%model%supports(k)%direction == gapbeam_axial) cycle
                    call check_finite(way_to_contact(assembled, state, k), way_unit(assembled, k), "opening of the support", &
                                      "length", point)
                end associate
            end do
            if (.not. allocated(axial%point)) return
            do i = 0, ubound(axial%point, 1)
                call check_finite(state%displacement(i), axial%units%deflection, "axial displacement", "length", axial%point(i))
                call check_finite(state%axial_reaction(i), axial%units%force, "axial reaction", "force", axial%point(i))
                if (i > 0) call check_finite(state%tension(i), axial%units%force, "axial force", "force", axial%point(i))
            end do
        end associate

    contains

        !> Is a value finite in the user's units
        subroutine check_finite(value, power, what, unit, point)
            real(wp), intent(in) :: value
            integer, intent(in) :: power, point
            character(len=*), intent(in) :: what, unit

            if (abs(scale(value, power)) <= huge(value) .or. allocated(error)) return
            if (abs(value) <= huge(value) .or. index(what, "axial") == 1) then
                call refuse_range(error, "the "//what//" at x = "//trim(shown(point_x(assembled, point)))//" is too great", &
                                  "choose a greater unit of "//unit)
            else
                call name_farthest(assembled, error)
            end if
            call forget(state)
        end subroutine check_finite

    end subroutine check_range

    !> Are all numbers far within the range of doubles, in units that are the user's
    pure function clearly_in_range(assembled, state) result(so)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        logical :: so
        real(wp), parameter :: far_within = sqrt(huge(1.0_wp))

        associate (units => assembled%units, beam => assembled%beam)
            so = .not. allocated(assembled%axial%point) .and. all([units%length, units%force, units%deflection] == 0)
            if (so) so = all(abs(state%deflection) <= far_within) .and. all(abs(state%moment_left) <= far_within) &
                .and. all(abs(state%moment_right) <= far_within) .and. all(abs(state%shear) <= far_within) &
                .and. all(abs(state%reaction) <= far_within) .and. all(abs(beam%couple) <= far_within) &
                .and. abs(state%factor) <= 1.0_wp &
                .and. all(abs(assembled%model%supports%gap) <= far_within) &
                .and. all(abs(assembled%model%supports%settlement) <= far_within)
        end associate
    end function clearly_in_range

    !> Refuse rigid supports at one place that loads have moved past each other
    subroutine check_room(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        !> With its load factor
        type(state_type), intent(in) :: state
        type(error_type), allocatable, intent(out) :: error
        type(node_support_type) :: laws(size(assembled%beam%supports))
        real(wp) :: growth(size(assembled%beam%supports))
        integer :: i, a, b

        if (.not. allocated(assembled%growth)) return
        laws(:) = laws_in(assembled, state)
        growth(:) = growth_of(assembled)
        associate (first => assembled%beam%first, order => assembled%beam%order)
            do i = 0, size(assembled%beam%links)
                do a = first(i), first(i + 1) - 1
                    do b = first(i), first(i + 1) - 1
                        if (allocated(error)) return
                        if (a /= b) call check_pair(order(a), order(b))
                    end do
                end do
            end do
        end associate

    contains

        !> One that may push up, and one that may push down
        subroutine check_pair(lower, upper)
            integer, intent(in) :: lower, upper
            real(wp) :: meet

            associate (s => laws(lower), t => laws(upper))
                if (s%side < 0 .or. t%side > 0 .or. min(s%stiffness, t%stiffness) <= huge(1.0_wp)) return
                if (s%breakpoint > 0 .or. t%breakpoint > 0 .or. .not. abs(growth(lower) - growth(upper)) > 0.0_wp) return
                if (is_room(s%contact, t%contact, .false.)) return
                meet = state%factor - (s%contact - t%contact)/(growth(lower) - growth(upper))
            end associate
            associate (numbers => assembled%normal([lower, upper]), m => size(assembled%beam_support))
                call fatal_error(error, gapbeam_indeterminate, trim(named(of_supports, numbers(1), m))//" and "// &
                                 trim(named(of_supports, numbers(2), m))//", which loads move, leave no room for the beam "// &
                                 "between them from load factor "//trim(shown(meet))//" on; move them less")
            end associate
        end subroutine check_pair

    end subroutine check_room

    !> Couple of the rotational restraint of a node on the beam, in the engine's units: across a node the moment grows by the
    !> applied couple and that of the supports
    pure function couple_at_node(assembled, state, node) result(couple)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: node
        real(wp) :: couple

        associate (applied => assembled%beam%couple(:, node))
            couple = (state%moment_right(node) - state%moment_left(node)) - (applied(1) + state%factor*applied(2))
        end associate
    end function couple_at_node

    !> How far the beam is from a one-sided support of the model, in the engine's units; negative where it has gone past it
    pure function way_to_contact(assembled, state, support) result(way)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: support
        real(wp) :: way

        way = assembled%model%supports(support)%side*(scale(level_at(assembled, state, support), -way_unit(assembled, support)) &
                                                      - displacement_at(assembled, state, support))
    end function way_to_contact

    !> Where a support of the model begins to act, with what it has moved, before it has yielded, in the user's units
    pure function level_at(assembled, state, support) result(level)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: support
        real(wp) :: level

        level = contact_level(assembled%model%supports(support))
        if (allocated(assembled%growth)) level = level + state%factor*assembled%growth(support)
    end function level_at

    !> Deflection of the beam at a support of the model, or the rotation that it holds, in the engine's units
    pure function displacement_at(assembled, state, support) result(displacement)
        !> The beam, and its solved state
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: support
        real(wp) :: displacement
        integer :: place

        place = assembled%node_of_point(assembled%support_point(support))
        if (turns(assembled%model%supports(support))) place = assembled%beam%supports(assembled%beam_support(support))%node
        displacement = state%deflection(place)
    end function displacement_at

    !> Do supports of a state act otherwise than those of the beam without live loads
    pure function has_own_laws(assembled, state) result(it_has)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        logical :: it_has

        it_has = allocated(state%laws) .or. allocated(assembled%growth)
    end function has_own_laws

    !> The supports of a state: their laws as they are, where they have moved to at its load factor
    pure function laws_in(assembled, state) result(laws)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        type(node_support_type) :: laws(size(assembled%beam%supports))
        real(wp) :: moved(size(laws))

        if (allocated(state%laws)) then
            laws(:) = state%laws
        else
            laws(:) = assembled%beam%supports
        end if
        if (.not. allocated(assembled%growth)) return
        moved(:) = state%factor*growth_of(assembled)
        laws%contact = laws%contact + moved
        ! At the event at which one comes to a beam that nothing bends, the rounding of the load factor is all that is left
        where (abs(laws%contact) <= rounding_unit*abs(moved)) laws%contact = 0.0_wp
    end function laws_in

    !> The law of a link along the beam, its contacts where they have gone and are in a state
    pure function laws_along(assembled, state, first, last) result(laws)
        !> With such links
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Its first and last breakpoint
        integer, intent(in) :: first, last
        type(node_support_type) :: laws(last - first + 1)

        associate (axial => assembled%axial)
            laws(:) = axial%laws(first:last)
            if (allocated(state%along_contact)) laws%contact = state%along_contact(first:last)
            if (.not. allocated(assembled%growth)) return
            laws%contact = laws%contact + state%factor*scale(assembled%growth(axial%support(first)), -axial%units%deflection)
        end associate
    end function laws_along

end module gapbeam_solution
