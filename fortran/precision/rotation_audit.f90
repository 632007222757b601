!> Audit of supports that hold rotations of a beam on the ground: nodes as they make them, their laws and couples.
module gapbeam_rotation_audit
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: node_type, rhs_type
    use gapbeam_element, only: field_type
    use gapbeam_law, only: force_by_spring
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_model, only: beam_type, last_place, of_node, of_hinge_held_left, left_of_hinge, right_of_hinge, is_of_hinge
    use gapbeam_turning, only: apply_turning
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_supports, rotations, moments, beyond, pulls
    implicit none
    private
    public :: turned_nodes, audit_rotations

contains

    !> Kinds of the nodes, with what is known of them beside the loads of the links
    subroutine turned_nodes(beam, factor, closed, nodes, rhs)
        !> The beam without ground
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> Which supports act
        logical, intent(in) :: closed(:)
        !> Shape (0:n), behind them what belongs to rotations
        type(node_type), allocatable, intent(out) :: nodes(:)
        type(rhs_type), allocatable, intent(out) :: rhs(:)
        real(wp) :: level(0:last_place(beam))
        integer :: n

        n = size(beam%links)
        allocate (nodes(0:last_place(beam)), rhs(0:last_place(beam)))
        nodes(0:n)%kind = beam%kind
        nodes(0:n)%compliance = beam%compliance
        rhs(0:n)%couple = beam%couple(1, :) + factor*beam%couple(2, :)
        level(:) = 0.0_wp
        if (allocated(beam%turning)) call apply_turning(beam, closed, [0, n], nodes, rhs, level)
    end subroutine turned_nodes

    !> Are the supports of the rotations at a node on their laws, in the right states, and is the couple theirs
    subroutine audit_rotations(beam, node, closed, solution, left, right, sizes, least, ledger)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: node
        logical, intent(in) :: closed(:)
        type(ground_solution_type), intent(in) :: solution
        !> Fields left and right of the node
        type(field_type), intent(in) :: left, right
        !> Sizes of fields there, and below which there is nothing
        type(field_type), intent(in) :: sizes, least
        type(ledger_type), intent(inout) :: ledger
        real(wp) :: rotation, couple, terms, errors(size(closed))
        integer :: j, s, v

        if (.not. allocated(beam%turning)) return
        do j = 1, size(beam%turning)
            if (beam%turning(j) /= node) cycle
            v = size(beam%links) + j
            associate (turned => beam%turned(j), before => solution%moment_left(node), after => solution%moment_right(node), &
                       load => beam%couple(:, node)*[1.0_wp, solution%factor], at => max(node, 1))
                if (is_of_hinge(turned)) then
                    rotation = left%rotation - right%rotation
                    couple = merge(after, before, turned == of_hinge_held_left)
                else
                    rotation = merge(left%rotation, right%rotation, turned == left_of_hinge .or. (turned == of_node .and. node > 0))
                    couple = (before - after) + sum(load)
                end if
                terms = sizes%moment + least%moment + abs(before) + abs(after) + sum(abs(load))
                call note(ledger, of_bending, rotations, solution%deflection(v) - rotation, sizes%rotation + least%rotation, at, &
                          0.0_wp)
                associate (numbers => beam%order(beam%first(v):beam%first(v + 1) - 1))
                    errors(numbers) = epsilon(1.0_wp)*terms
                    call note(ledger, of_equilibrium, moments, couple - sum(solution%reaction(numbers)), &
                              terms + sum(abs(solution%reaction(numbers))), at, 0.0_wp)
                    do s = 1, size(numbers)
                        call audit_law(numbers(s), solution%deflection(v), terms, at)
                    end do
                end associate
            end associate
        end do

    contains

        !> One of the supports
        subroutine audit_law(k, rotation, terms, at)
            integer, intent(in) :: k, at
            real(wp), intent(in) :: rotation, terms
            real(wp) :: force, rounding, margin
            logical :: acts, rigid, by_force

            associate (supports => beam%supports, r => solution%reaction(k))
                call force_by_spring(supports, closed, k, rotation, abs(rotation), acts, rigid, force, rounding)
                if (rigid) then
                    call note(ledger, of_supports, rotations, rotation - supports(k)%contact, abs(supports(k)%contact) &
                              + sizes%rotation + least%rotation, at, 0.0_wp)
                else
                    call note(ledger, of_supports, moments, r - force, rounding/epsilon(1.0_wp) + abs(r) + terms, at, 0.0_wp)
                end if
                if (.not. is_watched_in(supports, closed, k)) return
                call margin_in_scheme(supports, closed, k, rotation, abs(rotation), solution%reaction, errors, margin, rounding, &
                                      by_force)
                if (margin < 0.0_wp) call note(ledger, of_supports, merge(pulls, beyond, by_force), margin, &
                                               rounding/epsilon(1.0_wp) + merge(terms, sizes%rotation + least%rotation, by_force), &
                                               at, 0.0_wp)
            end associate
        end subroutine audit_law

    end subroutine audit_rotations

end module gapbeam_rotation_audit
