!> Assembly of supports and hinges as nodes of the system, and of the axial system.
module gapbeam_assemble_supports
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_memory, only: reserve_memory, for_assembling
    use gapbeam_band, only: plain, hinge, restrained
    use gapbeam_scene, only: support_type, load_type, gapbeam_temperature, gapbeam_both, gapbeam_below, gapbeam_above, &
        gapbeam_normal, gapbeam_axial, gapbeam_axial_force, gapbeam_axial_distributed
    use gapbeam_model, only: node_support_type, order_supports
    use gapbeam_words, only: shown, whole
    use gapbeam_assembled_model, only: assembled_type, is_along, turns, has_ground_along, has_springs_along
    use gapbeam_axial_force, only: in_stretches
    use gapbeam_assemble_hinges, only: number_rotations, kind_of_rotation, check_side, unclear
    use gapbeam_check_foundations, only: find_runs
    use gapbeam_assemble_laws, only: count_breakpoints, make_breakpoints, check_rigid_pieces
    use gapbeam_tolerances, only: position_tolerance
    use gapbeam_input_error, only: refuse, refuse_range, named, of_supports, twice, no_room, at_hinge, bad_law
    implicit none
    private
    public :: assemble_supports, contact_level, is_room

contains

    !> Nodes, supports, restraints, and the axial system where it is needed
    subroutine assemble_supports(assembled, error)
        !> Points and pieces in
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error

        call check_neighbours(assembled, error)
        if (allocated(error)) return
        call choose_nodes(assembled, error)
        if (allocated(error)) return
        call place_supports(assembled, error)
        if (allocated(error)) return
        call check_rigid_pieces(assembled, error)
        if (allocated(error)) return
        if (acts_along(assembled)) call build_axial(assembled, error)
    end subroutine assemble_supports

    !> Is anything loaded or moved along the beam, where something holds it
    pure function acts_along(assembled) result(it_is)
        type(assembled_type), intent(in) :: assembled
        logical :: it_is

        associate (s => assembled%model%supports, loads => assembled%model%loads)
            associate (axial => s%direction == gapbeam_axial, rubs => any(has_ground_along(assembled%model%sections)))
                it_is = assembled%model%stretching .or. any(is_along(loads)) &
                    .or. ((rubs .or. any(axial .or. s%friction > 0.0_wp)) .and. any(makes_longer(loads))) &
                    .or. any(axial .and. (abs(s%settlement) > 0.0_wp .or. s%gap < 0.0_wp))
                if (allocated(assembled%growth)) it_is = it_is .or. any(axial .and. abs(assembled%growth) > 0.0_wp)
            end associate
        end associate
    end function acts_along

    !> Does a load make the beam longer where nothing holds it
    elemental function makes_longer(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = load%kind == gapbeam_temperature .and. abs(load%value_to) > 0.0_wp
    end function makes_longer

    !> Supports at the same place must leave room for each other, and no two may do the same rigidly
    subroutine check_neighbours(assembled, error)
        type(assembled_type), intent(in) :: assembled
        type(error_type), allocatable, intent(out) :: error
        !> The rigid support of each kind at a point, 0: none; kinds are the sides -1..1, 3 clamp, along the beam, elastic ones
        !> too, 5 and for those that push one way 4 and 6, of a rotation 7 to 9, of a hinge 10 to 12, left and right of it 13 to 18
        integer, allocatable :: rigid(:, :)
        !> Do supports hold the rotation of a point by a stiffness
        logical, allocatable :: restrained(:)
        !> Sides of hinges that supports hold: 1 left, 2 right, 3 both
        integer, allocatable :: held(:)
        integer :: k, m, stat, point, centre

        m = size(assembled%model%supports)
        allocate (rigid(-1:18, 0:ubound(assembled%point_span, 1)), restrained(0:ubound(assembled%point_span, 1)), &
                  held(0:ubound(assembled%point_span, 1)), stat=stat)
        if (failed(stat, error)) return
        rigid(:, :) = 0
        restrained(:) = .false.
        held(:) = 0
        do k = 1, m
            if (assembled%model%supports(k)%rotation > 0.0_wp) restrained(assembled%support_point(k)) = .true.
        end do
        do k = 1, m
            point = assembled%support_point(k)
            associate (s => assembled%model%supports(k))
                if (s%rotation > 0.0_wp .and. (assembled%hinged(point) .or. assembled%joint(point) > 0.0_wp)) then
                    call refuse(error, of_supports, k, m, at_hinge, "rotation", unclear)
                else if (s%direction == gapbeam_axial) then
                    call note(5 + s%side, "direction", "hold the beam along its axis")
                else if (turns(s)) then
                    call check_side(assembled, k, held(point), error)
                    if (allocated(error)) then
                        return
                    else if (restrained(point)) then
                        call refuse(error, of_supports, k, m, bad_law, "rotation", "another support holds the rotation here "// &
                                    "by a stiffness; leave one of them out")
                    else if (s%stiffness > huge(s%stiffness) .and. .not. assembled%with_law(k)) then
                        call note(centre_of(s) + s%side, "side", "hold the rotation rigidly")
                    end if
                else if (s%stiffness > huge(s%stiffness)) then
                    ! A law is no stiffness; what it holds rigidly depends on its piece
                    if (.not. assembled%with_law(k)) call note(s%side, "side", "do the same rigidly")
                end if
                if (.not. allocated(error) .and. s%rotation > huge(s%rotation)) then
                    call note(3, "rotation", "hold the rotation rigidly")
                end if
            end associate
            if (allocated(error)) return
        end do
        do k = 1, m
            point = assembled%support_point(k)
            centre = centre_of(assembled%model%supports(k))
            if (rigid(centre + gapbeam_below, point) == k) then
                call check_order(k, rigid(centre + gapbeam_above, point), .false.)
                if (.not. allocated(error)) call check_order(k, rigid(centre + gapbeam_both, point), .true.)
            else if (rigid(centre + gapbeam_above, point) == k) then
                call check_order(rigid(centre + gapbeam_both, point), k, .true.)
            end if
            if (allocated(error)) return
        end do

    contains

        !> Note a rigid support; only one of its kind may be there
        subroutine note(kind, key, what)
            integer, intent(in) :: kind
            character(len=*), intent(in) :: key, what

            if (rigid(kind, point) /= 0) then
                call refuse(error, of_supports, k, m, twice, "", "this one and support "//trim(whole(rigid(kind, point)))// &
                            " stand at the same place and "//what//"; remove one of them", rigid(kind, point))
                error%key = key
            else
                rigid(kind, point) = k
            end if
        end subroutine note

        !> The lower one of two rigid supports must not be in the way of the upper one
        subroutine check_order(lower, upper, strictly)
            integer, intent(in) :: lower, upper
            logical, intent(in) :: strictly
            real(wp) :: stop_at, start_at

            if (lower == 0 .or. upper == 0) return
            stop_at = contact_level(assembled%model%supports(lower))
            start_at = contact_level(assembled%model%supports(upper))
            if (.not. is_room(stop_at, start_at, strictly)) then
                call refuse(error, of_supports, lower, m, no_room, "", "this one acts at a deflection of "//trim(shown(stop_at))// &
                            " and support "//trim(whole(upper))//" at "//trim(shown(start_at))// &
                            ", so no room is left; give a greater gap", upper)
            end if
        end subroutine check_order

    end subroutine check_neighbours

    !> Kind in check_neighbours of a support that holds both ways, beside which are those that push one way
    pure function centre_of(support) result(kind)
        type(support_type), intent(in) :: support
        integer :: kind

        kind = 0
        if (turns(support)) kind = 5 + 3*kind_of_rotation(support)
    end function centre_of

    !> Is there room between two rigid supports at a place
    elemental function is_room(stop_at, start_at, strictly) result(there)
        !> Deflections at which the lower and the upper one begin to act
        real(wp), intent(in) :: stop_at, start_at
        !> Does one of them hold both ways
        logical, intent(in) :: strictly
        logical :: there
        real(wp) :: slack

        slack = position_tolerance*max(abs(stop_at), abs(start_at))
        there = stop_at - start_at > slack .or. (stop_at - start_at >= -slack .and. .not. strictly)
    end function is_room

    !> Deflection at which a support begins to act
    elemental function contact_level(support) result(level)
        type(support_type), intent(in) :: support
        real(wp) :: level

        level = support%settlement + support%side*support%gap
    end function contact_level

    !> Beam ends, hinges (elastic ones too) and supports across the beam are nodes, and on overhangs the places of loads: moments
    !> there follow from the loads farther out alone. With foundations all points are: every piece is a link on ground of its own
    subroutine choose_nodes(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: k, j, n, first, last, stat

        n = ubound(assembled%point_span, 1)
        allocate (assembled%node_of_point(0:n), stat=stat)
        if (failed(stat, error)) return
        associate (node => assembled%node_of_point)
            node(:) = merge(0, -1, assembled%hinged .or. assembled%joint > 0.0_wp)
            node(0) = 0
            node(n) = 0
            if (in_stretches(assembled%model)) node(:) = 0
            first = n + 1
            last = -1
            do k = 1, size(assembled%support_point)
                if (turns(assembled%model%supports(k))) node(assembled%support_point(k)) = 0
                if (assembled%model%supports(k)%direction /= gapbeam_normal) cycle
                node(assembled%support_point(k)) = 0
                first = min(first, assembled%support_point(k))
                last = max(last, assembled%support_point(k))
            end do
            do k = 1, size(assembled%load_from)
                if (last < 0 .or. is_along(assembled%model%loads(k))) cycle
                associate (a => assembled%load_from(k), b => assembled%load_to(k))
                    if (a < first .or. a > last) node(a) = 0
                    if (b < first .or. b > last) node(b) = 0
                end associate
            end do
            allocate (assembled%node_point(0:count(node == 0) - 1), stat=stat)
            if (failed(stat, error)) return
            k = 0
            do j = 0, n
                if (node(j) < 0) cycle
                node(j) = k
                assembled%node_point(k) = j
                k = k + 1
            end do
        end associate
    end subroutine choose_nodes

    !> The supports across the beam that can carry, and rotational restraints; their numbers come with the units
    subroutine place_supports(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        type(node_support_type), allocatable :: supports(:)
        logical, allocatable :: clamped(:)
        integer, allocatable :: first(:), last(:)
        !> Numbers of the rotations that supports hold, by kinds, shape (0:n, 4)
        integer, allocatable :: rotation(:, :)
        integer :: k, j, m, n, place, stat

        n = ubound(assembled%node_point, 1)
        associate (beam => assembled%beam, given => assembled%model%supports, law => assembled%law)
            allocate (first(size(given)), last(size(given)), stat=stat)
            if (failed(stat, error)) return
            call find_runs(law%support, first, last)
            m = 0
            do k = 1, size(given)
                if (can_carry(given(k))) m = m + count_breakpoints(given(k), law(first(k):last(k)))
            end do
            allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n), &
                      assembled%normal(m), assembled%beam_support(size(given)), assembled%couple_share(size(given)), &
                      assembled%turning(0:n), clamped(0:n), supports(m), stat=stat)
            ! order_supports frees and allocates these again
            if (stat == 0) allocate (beam%supports(m), beam%order(m), beam%first(0:n + 1), stat=stat)
            if (failed(stat, error)) return
            ! Copies of supports that the compiler makes, and order_supports
            call reserve_memory(for_assembling, n, 3*size(supports), 0, error)
            if (allocated(error)) return
            assembled%turning(:) = 0.0_wp
            clamped(:) = .false.
            assembled%beam_support(:) = 0
            beam%kind(:) = merge(hinge, plain, assembled%hinged(assembled%node_point))
            if (any(turns(given))) call number_rotations(assembled, rotation)
            j = 0
            do k = 1, size(given)
                if (given(k)%direction == gapbeam_axial) cycle
                associate (node => assembled%node_of_point(assembled%support_point(k)))
                    assembled%turning(node) = assembled%turning(node) + given(k)%rotation
                    if (given(k)%rotation > huge(given(k)%rotation)) clamped(node) = .true.
                    if (.not. can_carry(given(k))) cycle
                    assembled%beam_support(k) = j + 1
                    place = node
                    if (turns(given(k))) place = n + rotation(node, kind_of_rotation(given(k)))
                    m = 1
                    if (assembled%with_law(k)) then
                        m = count_breakpoints(given(k), law(first(k):last(k)))
                        call make_breakpoints(given(k), law(first(k):last(k)), place, supports(j + 1:j + m))
                    else
                        supports(j + 1) = node_support_type(place, given(k)%side, 0.0_wp, 0.0_wp)
                    end if
                    assembled%normal(j + 1:j + m) = k
                    j = j + m
                end associate
            end do
            call order_supports(supports, beam)
            where (assembled%turning > 0.0_wp) beam%kind = restrained
            do k = size(given), 1, -1
                assembled%couple_share(k) = 0.0_wp
                associate (turn => given(k)%rotation, node => assembled%node_of_point(assembled%support_point(k)))
                    if (.not. turn > 0.0_wp) cycle
                    ! A clamp takes all of the couple
                    assembled%couple_share(k) = 1.0_wp
                    if (turn > huge(turn)) cycle
                    assembled%couple_share(k) = turn/assembled%turning(node)
                    if (.not. assembled%turning(node) > huge(turn) .or. clamped(node)) cycle
                    call refuse_range(error, "the rotations of "//trim(named(of_supports, k, size(given)))// &
                                      " and others at its place are too great together", "clamp it")
                    return
                end associate
            end do
        end associate
    end subroutine place_supports

    !> Can a support carry: a one-sided one without stiffness only says where the beam is
    elemental function can_carry(support) result(yes)
        type(support_type), intent(in) :: support
        logical :: yes

        yes = support%direction /= gapbeam_axial .and. (support%stiffness > 0.0_wp .or. support%side == gapbeam_both)
    end function can_carry

    !> Does a support hold the beam along its axis, by friction at least
    elemental function holds_along(support) result(it_does)
        type(support_type), intent(in) :: support
        logical :: it_does

        it_does = support%direction == gapbeam_axial .or. support%friction > 0.0_wp
    end function holds_along

    !> The axial system: its points are the beam's ends and the places of axial forces and supports
    subroutine build_axial(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: node(:)
        logical :: every
        integer :: i, j, k, n, stat

        n = ubound(assembled%point_span, 1)
        associate (axial => assembled%axial, model => assembled%model)
            allocate (node(0:n), axial%node(size(model%supports)), stat=stat)
            if (failed(stat, error)) return
            every = any(makes_longer(model%loads) .or. model%loads%kind == gapbeam_axial_distributed) &
                .or. any(has_ground_along(model%sections)) .or. model%stretching
            node(:) = merge(0, -1, every)
            node(0) = 0
            node(n) = 0
            do k = 1, size(model%supports)
                if (holds_along(model%supports(k))) node(assembled%support_point(k)) = 0
            end do
            do k = 1, size(model%loads)
                if (model%loads(k)%kind == gapbeam_axial_force) node(assembled%load_from(k)) = 0
            end do
            i = count(node == 0) - 1
            allocate (axial%point(0:i), axial%softness(n), axial%before(n), axial%flexibility(i), axial%force(2, 0:i), &
                      axial%stiffness(0:i), axial%settlement(0:i), stat=stat)
            if (stat == 0 .and. (any(makes_longer(model%loads)) .or. model%stretching)) then
                allocate (axial%elongation(2, i), source=0.0_wp, stat=stat)
            end if
            if (stat == 0 .and. any(has_ground_along(model%sections))) allocate (axial%limit(i), stat=stat)
            if (stat == 0 .and. any(has_springs_along(model%sections))) allocate (axial%bedding(i), axial%limits(2, i), stat=stat)
            if (stat == 0 .and. any(model%loads%kind == gapbeam_axial_distributed)) allocate (axial%along_bar(2, i), stat=stat)
            if (failed(stat, error)) return
            i = -1
            do j = 0, n
                if (node(j) < 0) cycle
                i = i + 1
                node(j) = i
                axial%point(i) = j
            end do
            do k = 1, size(model%supports)
                axial%node(k) = -1
                if (holds_along(model%supports(k))) axial%node(k) = node(assembled%support_point(k))
            end do
        end associate
    end subroutine build_axial

end module gapbeam_assemble_supports
