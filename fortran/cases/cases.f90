!> Many load cases of one beam as sums of its loads, each condensed once.
!> A case is a sum of what each load does alone, times a factor.
module gapbeam_cases
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed, gapbeam_solved, gapbeam_not_finite, gapbeam_bad_input
    use gapbeam_link, only: link_type, piece_load_type, condense_loads, no_load
    use gapbeam_model, only: beam_type, drop_loads
    use gapbeam_workspace, only: workspace_type, set_loads
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_extended_precision, only: decide_scheme, detail_type
    use gapbeam_scene, only: gapbeam_force, gapbeam_couple, gapbeam_live
    use gapbeam_units, only: moment_unit
    use gapbeam_law, only: both
    use gapbeam_assembled_model, only: assembled_type, way_unit, push_unit
    use gapbeam_assemble_supports, only: is_room
    use gapbeam_assemble_loads, only: find_loaded, put_load, assemble_loads
    use gapbeam_slight_supports, only: leave_out_of_case
    use gapbeam_assemble_units, only: support_in_units
    use gapbeam_case_types, only: case_solutions_type
    implicit none
    private
    public :: case_loads_type, split_loads, replace_supports, leave_room, solve_case, take_case, give_case

    !> What a load does to a link: rotations and shears of the simple bar, sums of absolute values (link_type)
    type :: share_type
        integer :: load, link
        real(wp) :: turn_a, turn_b, shear_a, shear_b, load_sum, turn_sum
    end type share_type

    !> What a load does to a node: force (down) and couple (clockwise)
    type :: node_share_type
        integer :: load, node
        real(wp) :: force, couple
    end type node_share_type

    !> The loads of a beam one by one, in the engine's units
    type :: case_loads_type
        type(share_type), allocatable :: of_links(:)
        type(node_share_type), allocatable :: of_nodes(:)
    end type case_loads_type

contains

    !> Condense the loads of a beam one by one
    subroutine split_loads(assembled, loads, error)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(out) :: loads
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(piece_load_type), allocatable :: on_pieces(:)
        integer, allocatable :: link_of(:)
        real(wp), allocatable :: work(:)
        integer :: i, k, first, last, node, shares, at_nodes, stat

        if (allocated(assembled%layers)) then
            ! In stretches they do not add up
            allocate (loads%of_links(0), loads%of_nodes(0))
            return
        end if
        allocate (on_pieces(size(assembled%pieces)), work(size(assembled%pieces)), link_of(size(assembled%pieces)), stat=stat)
        if (failed(stat, error)) return
        on_pieces(:) = no_load
        do i = 1, size(assembled%beam%links)
            link_of(assembled%node_point(i - 1) + 1:assembled%node_point(i)) = i
        end do
        shares = 0
        at_nodes = 0
        do k = 1, size(assembled%model%loads)
            call find_loaded(assembled, k, first, last, node)
            if (first <= last) shares = shares + link_of(last) - link_of(first) + 1
            if (node >= 0) at_nodes = at_nodes + 1
        end do
        allocate (loads%of_links(shares), loads%of_nodes(at_nodes), stat=stat)
        if (failed(stat, error)) return
        shares = 0
        at_nodes = 0
        do k = 1, size(assembled%model%loads)
            call put_load(assembled, k, first, last, node, on_pieces)
            if (node >= 0) then
                at_nodes = at_nodes + 1
                loads%of_nodes(at_nodes) = at_node(assembled, k, node)
            end if
            if (first > last) cycle
            do i = link_of(first), link_of(last)
                call condense(i)
            end do
            on_pieces(first:last) = no_load
        end do

    contains

        !> What the load at hand does to a link
        subroutine condense(i)
            integer, intent(in) :: i
            type(link_type) :: link

            link = assembled%beam%links(i)
            associate (first => assembled%node_point(i - 1) + 1, last => assembled%node_point(i))
                call condense_loads(assembled%pieces(first:last), on_pieces(first:last), link, 1, work)
            end associate
            shares = shares + 1
            loads%of_links(shares) = share_type(k, i, link%turn_a(1), link%turn_b(1), link%shear_a(1), link%shear_b(1), &
                                                link%load_sum(1), link%turn_sum(1))
        end subroutine condense

    end subroutine split_loads

    !> What a load does to the node it is at
    pure function at_node(assembled, load, node) result(share)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: load, node
        type(node_share_type) :: share

        share = node_share_type(load, node, 0.0_wp, 0.0_wp)
        associate (given => assembled%model%loads(load), units => assembled%units)
            if (given%kind == gapbeam_force) share%force = scale(given%value, -units%force)
            if (given%kind == gapbeam_couple) share%couple = scale(given%value, -moment_unit(units))
        end associate
    end function at_node

    !> Give the supports of a case other numbers
    subroutine replace_supports(assembled, values, beam, status)
        !> The beam, none of whose supports has a law
        type(assembled_type), intent(in) :: assembled
        !> Settlement, gap and stiffness of every support of the scene, in its units, shape (3, nsupport)
        real(wp), intent(in) :: values(:, :)
        !> The beam of the cases
        type(beam_type), intent(inout) :: beam
        !> gapbeam_solved; gapbeam_not_finite for numbers out of range; gapbeam_bad_input for supports in each other's way
        integer, intent(out) :: status
        integer :: k
        logical :: lost_stiffness, lost_level

        status = gapbeam_solved
        do k = 1, size(beam%supports)
            associate (s => beam%supports(k), given => values(:, assembled%normal(k)))
                call support_in_units(given(3), given(1) + s%side*given(2), way_unit(assembled, assembled%normal(k)), &
                                      push_unit(assembled, assembled%normal(k)), s%stiffness, s%contact, lost_stiffness, &
                                      lost_level)
                if (lost_stiffness .or. lost_level) status = gapbeam_not_finite
            end associate
        end do
        if (.not. leave_room(assembled, values)) status = gapbeam_bad_input
        if (status /= gapbeam_solved) return
        beam%kind(:) = assembled%beam%kind
        beam%compliance(:) = assembled%beam%compliance
        call leave_out_of_case(assembled, beam)
    end subroutine replace_supports

    !> Do rigid supports at one place leave room for each other in a case, as those of a scene must
    pure function leave_room(assembled, values) result(room)
        !> As for replace_supports
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: values(:, :)
        logical :: room
        integer :: i, j, k, lower, upper

        room = .true.
        associate (beam => assembled%beam)
            do i = 0, size(beam%links)
                do j = beam%first(i) + 1, beam%first(i + 1) - 1
                    do k = beam%first(i), j - 1
                        lower = beam%order(j)
                        upper = beam%order(k)
                        if (beam%supports(lower)%side < beam%supports(upper)%side) then
                            lower = beam%order(k)
                            upper = beam%order(j)
                        end if
                        associate (a => values(:, assembled%normal(lower)), b => values(:, assembled%normal(upper)), &
                                   side => beam%supports(lower)%side, other => beam%supports(upper)%side)
                            if (min(a(3), b(3)) <= huge(1.0_wp)) cycle
                            room = room .and. side > other &
                                .and. is_room(a(1) + side*a(2), b(1) + other*b(2), min(abs(side), abs(other)) == both)
                        end associate
                    end do
                end do
            end do
        end associate
    end function leave_room

    !> Find the contact state of a case and solve it
    subroutine solve_case(loads, factors, rule, beam, closed, work, status)
        !> By split_loads, and the factor of every load
        type(case_loads_type), intent(in) :: loads
        real(wp), intent(in) :: factors(:)
        !> rule_block or rule_single of gapbeam_search
        integer, intent(in) :: rule
        !> The beam; its loads are replaced
        type(beam_type), intent(inout) :: beam
        !> Start in, contact state out
        logical, intent(inout) :: closed(:)
        !> Workspace of the beam in, solution out
        type(workspace_type), intent(inout) :: work
        !> gapbeam_solved, gapbeam_no_equilibrium or the code of an error
        integer, intent(out) :: status
        type(detail_type) :: links_only
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        integer :: k

        call drop_loads(beam, 1)
        call drop_loads(beam, 2)
        do k = 1, size(loads%of_links)
            associate (s => loads%of_links(k))
                associate (link => beam%links(s%link), factor => factors(s%load))
                    link%turn_a(2) = link%turn_a(2) + factor*s%turn_a
                    link%turn_b(2) = link%turn_b(2) + factor*s%turn_b
                    link%shear_a(2) = link%shear_a(2) + factor*s%shear_a
                    link%shear_b(2) = link%shear_b(2) + factor*s%shear_b
                    link%load_sum(2) = link%load_sum(2) + abs(factor)*s%load_sum
                    link%turn_sum(2) = link%turn_sum(2) + abs(factor)*s%turn_sum
                end associate
            end associate
        end do
        do k = 1, size(loads%of_nodes)
            associate (s => loads%of_nodes(k))
                beam%force(2, s%node) = beam%force(2, s%node) + factors(s%load)*s%force
                beam%couple(2, s%node) = beam%couple(2, s%node) + factors(s%load)*s%couple
            end associate
        end do
        call set_loads(beam, 1.0_wp, work)
        call decide_scheme(beam, links_only, 1.0_wp, rule, closed, work, outcome, error)
        status = outcome%status
        if (allocated(error)) status = error%code
    end subroutine solve_case

    !> Make the loads of a case those of the beam: all live, each times its factor
    subroutine take_case(factors, assembled, error)
        !> Factor of every load
        real(wp), intent(in) :: factors(:)
        type(assembled_type), intent(inout) :: assembled
        !> Numbers out of range, or no memory
        type(error_type), allocatable, intent(out) :: error

        assembled%model%loads%value = factors*assembled%model%loads%value
        assembled%model%loads%value_to = factors*assembled%model%loads%value_to
        assembled%model%loads%case = gapbeam_live
        call assemble_loads(assembled, error)
    end subroutine take_case

    !> Put the solution of a case into its columns
    pure subroutine give_case(units, place, i, scheme, deflection, moment_left, moment_right, force, solutions)
        !> Of deflections, moments and forces, as numbers; the scene's units hold what comes out
        real(wp), intent(in) :: units(3)
        !> Where the number of every support is in arrays of them, counted from 0
        integer, intent(in) :: place(:)
        !> The case
        integer, intent(in) :: i
        !> In the engine's units; scheme (1 closed) and forces of supports by places, the others by nodes
        real(wp), intent(in), dimension(0:) :: scheme, deflection, moment_left, moment_right, force
        type(case_solutions_type), intent(inout) :: solutions
        integer :: k

        if (associated(solutions%w)) solutions%w(:, i) = deflection*units(1)
        if (associated(solutions%ml)) solutions%ml(:, i) = moment_left*units(2)
        if (associated(solutions%mr)) solutions%mr(:, i) = moment_right*units(2)
        do k = 1, size(place)
            if (associated(solutions%reaction)) solutions%reaction(k, i) = force(place(k))*units(3)
            solutions%closed(k, i) = merge(1, 0, scheme(place(k)) > 0.5_wp)
        end do
    end subroutine give_case

end module gapbeam_cases
