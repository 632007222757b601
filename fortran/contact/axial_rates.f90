!> Rates of the chain along the beam with all links on their pieces.
!>
!> Rates with links at the ends of their pieces are a linear complementarity problem of a P-matrix, solved by principal pivoting:
!> all wrong signs at once first, then that of the least number alone, which always ends (Murty 1974).
module gapbeam_axial_rates
    use gapbeam_kinds, only: qp
    use gapbeam_axial_quad, only: solve_axial, axial_ok, axial_slides, axial_indeterminate
    use gapbeam_axial_chain, only: chain_type, find_piece, sticks, no_rate
    implicit none
    private
    public :: find_rates, moves_on, moves_at_once, not_told

    !> How the chain goes on: with the load; at this load, all of it, until a link holds it; two rigid links share a force
    integer, parameter :: moves_on = 0, moves_at_once = 1, not_told = 2

contains

    !> The rates with all links on their pieces
    subroutine find_rates(chain, reach, outcome, place, dragged)
        !> Between the points added up
        type(chain_type), intent(inout) :: chain
        !> Points between which pieces or loads have changed: the ends of the chain, or rigid links that stay
        integer, intent(in) :: reach(2)
        !> moves_on, moves_at_once or not_told
        integer, intent(out) :: outcome
        !> Link at which it cannot be told
        integer, intent(out) :: place
        !> Has a link that moves itself changed what friction does, so that the rates are to be found anew
        logical, intent(out) :: dragged
        real(qp), dimension(reach(1):reach(2)) :: stiffness, settlement, force, reaction
        real(qp) :: slope(size(chain%first)), total
        integer :: pieces(size(chain%first)), l, j, node, found

        dragged = .false.
        outcome = moves_on
        stiffness(:) = 0.0_qp
        settlement(:) = 0.0_qp
        chain%holder(reach(1):reach(2)) = 0
        force(:) = chain%load_rate(reach(1):reach(2))
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            l = chain%in_order(j)
            call find_piece(chain, l, slope(l), pieces(l))
            node = chain%laws(chain%first(l))%node
            if (abs(slope(l)) > huge(total)) then
                call choose_holder(chain, l, chain%holder(node), dragged, place)
                if (place > 0) then
                    outcome = not_told
                    return
                end if
            else if (slope(l) > 0.0_qp) then
                stiffness(node) = stiffness(node) + slope(l)
                settlement(node) = settlement(node) + slope(l)*chain%own_rate(l)
            else if (chain%rubs(l)) then
                force(node) = force(node) - (pieces(l) - sticks)*chain%limit_rate(l)
            end if
        end do
        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            l = chain%in_order(j)
            ! What another rigid link holds does not slide: friction does not grow with its limit
            if (.not. chain%rubs(l) .or. abs(slope(l)) > 0.0_qp .or. .not. chain%limit_rate(l) > 0.0_qp) cycle
            node = chain%holder(chain%laws(chain%first(l))%node)
            if (node == 0) cycle
            if (chain%rubs(node) .or. abs(chain%own_rate(node)) > 0.0_qp) cycle
            chain%closed(chain%first(l)) = .true.
            chain%closed(chain%last(l)) = .false.
            dragged = .true.
        end do
        if (dragged) return
        where (stiffness > 0.0_qp) settlement = settlement/stiffness
        do node = reach(1), reach(2)
            if (chain%holder(node) == 0) cycle
            stiffness(node) = slope(chain%holder(node))
            settlement(node) = chain%own_rate(chain%holder(node))
        end do
        call solve_between(chain, reach, force, stiffness, settlement, reaction, found, node)
        chain%solves = chain%solves + 1
        outcome = moves_on
        chain%loose = found == axial_slides
        if (found == axial_indeterminate) then
            outcome = not_told
            place = max(1, chain%holder(node))
            return
        else if (found == axial_slides) then
            total = sum(force)
            if (abs(total) > no_rate*sum(abs(force))) then
                outcome = moves_at_once
                chain%displacement_rate(:) = sign(1.0_qp, total)
                chain%tension_rate(:) = 0.0_qp
                chain%force_rate(:) = 0.0_qp
                return
            end if
            ! Nothing holds it and nothing pushes it: its ends go to either side alike, wherever there are nodes between
            stiffness(0) = 1.0_qp
            call solve_between(chain, reach, force, stiffness, settlement, reaction, found, node)
            associate (rate => chain%displacement_rate)
                rate(:) = rate - (rate(0) + rate(ubound(rate, 1)))/2
            end associate
        end if
        call share_reactions(chain, reach, slope, pieces, reaction)

    end subroutine find_rates

    !> Rates of displacements, bars and reactions between two points
    pure subroutine solve_between(chain, reach, force, stiffness, settlement, reaction, found, place)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        !> Rates of loads and of the movements of supports, and their stiffnesses, at all points
        real(qp), intent(in) :: force(reach(1):), stiffness(reach(1):), settlement(reach(1):)
        !> What supports take, those at the ends beside the bars beyond them as well
        real(qp), intent(out) :: reaction(reach(1):)
        !> By solve_axial
        integer, intent(out) :: found, place

        associate (a => reach(1), b => reach(2))
            call solve_axial(chain%flexibility(a + 1:b), chain%elongation_rate(a + 1:b), force, stiffness, settlement, &
                             chain%displacement_rate(a:b), chain%tension_rate(a + 1:b), reaction, found, place)
            place = place + a
            if (found /= axial_ok) return
            if (a > 0) reaction(a) = reaction(a) + chain%tension_rate(a)
            if (b < size(chain%flexibility)) reaction(b) = reaction(b) - chain%tension_rate(b + 1)
        end associate
    end subroutine solve_between

    !> Which of the rigid links of a node takes its force: friction that is stuck takes none beside another one that stays, and
    !> of several that are stuck the first
    subroutine choose_holder(chain, l, holder, dragged, place)
        type(chain_type), intent(inout) :: chain
        !> A link on a vertical piece
        integer, intent(in) :: l
        !> Of its point so far, 0: none
        integer, intent(inout) :: holder
        !> As for drag
        logical, intent(inout) :: dragged
        !> The link where it cannot be told, 0: it can
        integer, intent(out) :: place
        integer :: other

        place = 0
        other = holder
        if (other == 0) then
            holder = l
        else if (chain%rubs(l) .and. chain%rubs(other)) then
            return
        else if (.not. (chain%rubs(l) .or. chain%rubs(other))) then
            place = l
        else if (chain%rubs(l)) then
            call drag(chain, l, other, dragged)
        else
            call drag(chain, other, l, dragged)
            holder = l
        end if
    end subroutine choose_holder

    !> Rates of the forces of the links from those of the points
    pure subroutine share_reactions(chain, reach, slope, pieces, reaction)
        type(chain_type), intent(inout) :: chain
        integer, intent(in) :: reach(2)
        !> Slope and closed breakpoints of every link
        real(qp), intent(in) :: slope(:)
        integer, intent(in) :: pieces(:)
        !> Of the springs and the rigid link of every point, changed
        real(qp), intent(inout) :: reaction(reach(1):)
        integer :: j, l, node

        do j = chain%first_at(reach(1)), chain%first_at(reach(2) + 1) - 1
            l = chain%in_order(j)
            node = chain%laws(chain%first(l))%node
            chain%force_rate(l) = 0.0_qp
            if (abs(slope(l)) > huge(1.0_qp)) cycle
            if (slope(l) > 0.0_qp) then
                chain%force_rate(l) = slope(l)*(chain%displacement_rate(node) - chain%own_rate(l))
                reaction(node) = reaction(node) + chain%force_rate(l)
            else if (chain%rubs(l)) then
                chain%force_rate(l) = (pieces(l) - sticks)*chain%limit_rate(l)
            end if
        end do
        do node = reach(1), reach(2)
            if (chain%holder(node) > 0) chain%force_rate(chain%holder(node)) = -reaction(node)
        end do
    end subroutine share_reactions

    !> Let a rigid link that moves itself take the beam along over a support that rubs: friction comes to its limit at once, or
    !> what it takes lets the other one go
    pure subroutine drag(chain, friction, mover, changed)
        type(chain_type), intent(inout) :: chain
        !> Two links of a node on vertical pieces; the second is no friction
        integer, intent(in) :: friction, mover
        !> Has one of them another piece now
        logical, intent(inout) :: changed
        real(qp) :: more, room
        integer :: n, way

        if (.not. abs(chain%own_rate(mover)) > 0.0_qp) return
        changed = .true.
        way = nint(sign(1.0_qp, chain%own_rate(mover)))
        more = way*chain%laws(chain%last(friction))%force - chain%force(friction)
        ! The other one gets as much less, as far as its piece goes
        room = huge(room)
        associate (k => chain%first(mover), side => chain%laws(chain%first(mover))%side)
            n = count(chain%closed(k:chain%last(mover)))
            if (side*more > 0.0_qp) then
                room = side*chain%force(mover) - chain%laws(k + n - 1)%force
            else if (side*more < 0.0_qp .and. n < chain%last(mover) - k + 1) then
                room = chain%laws(k + n)%force - side*chain%force(mover)
            end if
            if (room < abs(more)) then
                more = sign(max(room, 0.0_qp), more)
                if (side*more > 0.0_qp .or. side*way < 0) then
                    chain%closed(k + n - 1) = .false.
                else
                    chain%closed(k + n) = .true.
                end if
            else
                chain%closed(chain%first(friction):chain%last(friction)) = way > 0
            end if
        end associate
        chain%force(friction) = chain%force(friction) + more
        chain%force(mover) = chain%force(mover) - more
    end subroutine drag

end module gapbeam_axial_rates
