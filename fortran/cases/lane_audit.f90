!> Audit of the solutions of eight cases: equilibrium, compatibility, support laws.
!> Whatever found the solutions: forces and couples balance at every node, and with that those on every part of the beam; rotations
!> are those of one beam, but at hinges; supports and restraints lie on their laws at the deflections that are told, in the states
!> that are told, and no contact is violated. Every sum may be off by what rounding makes of its terms, conditions of signs by
!> nothing
module gapbeam_lane_audit
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: cache_block
    use gapbeam_tolerances, only: audit_unit, refined_rest, underflow_takes
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, link_numbers, link_faa, link_fab, link_fbb
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: audit_pack, audit_along
    public :: is_joined, check_link, check_support, check_restraint, wrong_way   ! for gapbeam_lane_certificate

    !> In place of that where a law is not that of a support alone, as no sum is larger than its terms
    real(wp), parameter :: anything = 2.0_wp
    !> Sums by what they are of: rotations; forces; laws and signs, which hold for the numbers of a support alone
    integer, parameter :: sums = 3, turns = 1, forces = 2, laws = 3

contains

    !> Audit eight cases
    pure subroutine audit_pack(beam, pack, wrong)
        type(lane_beam_type), intent(in) :: beam
        !> Loads, supports, schemes and solutions with reactions. Sums at nodes with several supports go through its room, and take
        !> the place of a reaction there that is no support's
        type(pack_type), intent(inout) :: pack
        !> In which cases a sum or a sign is not what it should be
        logical, intent(out) :: wrong(lanes)
        real(wp), dimension(lanes, sums) :: excess, total
        integer :: n

        n = beam%n
        excess(:, :) = 0.0_wp
        total(:, :) = 0.0_wp
        if (size(beam%shared) > 0) then
            pack%force(:, :) = pack%shear
            call audit_beside(beam, n, ubound(pack%closed, 2), pack%load, pack%stiffness, pack%rigid, pack%contact, pack%closed, &
                              pack%w, pack%ml, pack%mr, pack%reaction, pack%force, excess(:, laws))
            call audit_nodes(beam, pack%links, n, pack%left, pack%right, pack%force, pack%stiffness, pack%rigid, pack%contact, &
                             pack%closed, pack%w, pack%ml, pack%mr, pack%reaction, excess, total)
        else
            call audit_nodes(beam, pack%links, n, pack%left, pack%right, pack%shear, pack%stiffness, pack%rigid, pack%contact, &
                             pack%closed, pack%w, pack%ml, pack%mr, pack%reaction, excess, total)
        end if
        call audit_moments(beam, n, pack%couple, pack%ml, pack%mr, excess(:, laws))
        call audit_restraints(beam, pack, excess(:, turns))
        wrong(:) = is_wrong(excess(:, turns), excess(:, forces), excess(:, laws), total(:, turns), total(:, forces), total(:, laws))
    end subroutine audit_pack

    !> All nodes, with the support of those that have one
    pure subroutine audit_nodes(beam, links, n, left, right, shear, stiffness, rigid, contact, closed, w, ml, mr, &
                                reaction, excess, total)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, shear, stiffness, rigid, contact, closed, w, ml, mr, reaction
        !> By how much sums are off beyond the rounding of their terms, raised; sizes of these, added
        real(wp), intent(inout), dimension(lanes, sums) :: excess, total
        ! Of the link left of the node; sums of dummies would go through the memory at every node
        real(wp), dimension(lanes) :: turned, turned_size, passed, passed_size, turn, force, law, all_turns, all_forces, all_laws
        real(wp) :: start, end, link_size, next, next_size, off_law, held, held_size, spring_size, off, size
        real(wp) :: inverse, joined, law_unit, changing
        integer :: i, k, l

        turned(:) = 0.0_wp
        turned_size(:) = 0.0_wp
        passed(:) = 0.0_wp
        passed_size(:) = 0.0_wp
        turn(:) = excess(:, turns)
        force(:) = excess(:, forces)
        law(:) = excess(:, laws)
        all_turns(:) = 0.0_wp
        all_forces(:) = 0.0_wp
        all_laws(:) = 0.0_wp
        do i = 0, n
            ! The link right of the last node is none
            k = min(i + 1, n)
            inverse = beam%inverse(k)*merge(1.0_wp, 0.0_wp, i < n)
            joined = merge(1.0_wp, 0.0_wp, is_joined(beam, i))
            law_unit = merge(audit_unit, anything, beam%there(i) > 0.5_wp)
            changing = beam%changes(i)*beam%side(i)
            !$omp simd private(start, end, link_size, next, next_size, off_law, held, held_size, spring_size, off, size)
            do l = 1, lanes
                call check_link(w(l, i), w(l, k), mr(l, i), ml(l, k), inverse, links(min(l, stiffness_lanes), link_faa, k), &
                                links(min(l, stiffness_lanes), link_fab, k), links(min(l, stiffness_lanes), link_fbb, k), &
                                start, end, link_size, next, next_size)
                off = joined*abs(start - turned(l) + (left(l, i) + right(l, i)))
                ! What loads make of it is not above the sum of the others
                size = link_size + turned_size(l)
                turn(l) = larger(turn(l), off - audit_unit*size)
                all_turns(l) = all_turns(l) + size
                call check_support(stiffness(l, i), rigid(l, i), contact(l, i), closed(l, i), w(l, i), reaction(l, i), off_law, &
                                   held, held_size, spring_size)
                off = abs(next - passed(l) + (shear(l, i) - reaction(l, i)))
                size = next_size + passed_size(l) + (spring_size + abs(reaction(l, i)))
                force(l) = larger(force(l), off - audit_unit*size)
                all_forces(l) = all_forces(l) + size
                size = held_size + (closed(l, i) - held)*size
                law(l) = larger(law(l), off_law - law_unit*size)
                all_laws(l) = all_laws(l) + size
                off = wrong_way(changing, contact(l, i), closed(l, i), w(l, i), reaction(l, i))
                law(l) = larger(law(l), off)
                turned(l) = end
                turned_size(l) = link_size
                passed(l) = next
                passed_size(l) = next_size
            end do
            if (law_unit < anything .and. abs(beam%side(i)) < 0.5_wp) law(:) = larger(law, 1.0_wp - closed(:, i))
        end do
        excess(:, turns) = turn
        excess(:, forces) = force
        excess(:, laws) = law
        total(:, turns) = total(:, turns) + all_turns
        total(:, forces) = total(:, forces) + all_forces
        total(:, laws) = total(:, laws) + all_laws
    end subroutine audit_nodes

    !> Is more off than rounding makes of terms, or have these left the range of doubles
    elemental function is_wrong(turn, force, law, all_turns, all_forces, all_laws) result(wrong)
        !> By audit_nodes
        real(wp), intent(in) :: turn, force, law, all_turns, all_forces, all_laws
        logical :: wrong

        wrong = .not. (turn <= refined_rest*all_turns + underflow_takes .and. force <= refined_rest*all_forces + underflow_takes &
                       .and. law <= underflow_takes .and. all_turns + (all_forces + all_laws) <= huge(1.0_wp))
    end function is_wrong

    !> Is the beam in one piece at a node, where nothing else than itself holds its rotation
    pure function is_joined(beam, i) result(joined)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: i
        logical :: joined

        joined = i > 0 .and. i < beam%n .and. beam%restraint(i) == 0 .and. beam%hinge(i) < 0.5_wp
    end function is_joined

    !> Nodes with several supports: their laws, and the sums of their forces
    pure subroutine audit_beside(beam, n, last, load, stiffness, rigid, contact, closed, w, ml, mr, reaction, force, &
                                 excess)
        type(lane_beam_type), intent(in) :: beam
        !> Links, and the last place of a support
        integer, intent(in) :: n, last
        real(wp), intent(in) :: load(lanes, size(beam%shared))
        real(wp), intent(in), dimension(lanes, 0:n) :: w, ml, mr
        real(wp), intent(in), dimension(lanes, 0:last) :: stiffness, rigid, contact, closed
        !> At those nodes out what stands for all of them: sizes in place of the reaction, and beside these the force
        real(wp), intent(inout) :: reaction(lanes, 0:last), force(lanes, 0:n)
        !> Of laws or of rotations, as for audit_nodes
        real(wp), intent(inout) :: excess(lanes)
        real(wp), dimension(lanes) :: off, held, held_size, spring_size, sizes
        integer :: g, i, j

        do g = 1, size(beam%shared)
            i = beam%shared(g)
            force(:, i) = load(:, g)
            ! With the shears on both sides, of which the supports have what is left
            sizes(:) = abs(load(:, g))
            if (i > 0) sizes(:) = sizes + (abs(mr(:, i - 1)) + abs(ml(:, i)))*beam%inverse(i)
            if (i < n) sizes(:) = sizes + (abs(mr(:, i)) + abs(ml(:, i + 1)))*beam%inverse(i + 1)
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                force(:, i) = force(:, i) - reaction(:, j)
                sizes(:) = sizes + abs(reaction(:, j)) + closed(:, j)*stiffness(:, j)*(abs(w(:, i)) + abs(contact(:, j)))
            end do
            force(:, i) = force(:, i) + sizes
            reaction(:, i) = sizes
            do j = beam%last_place(g - 1) + 1, beam%last_place(g)
                call check_support(stiffness(:, j), rigid(:, j), contact(:, j), closed(:, j), w(:, i), reaction(:, j), off, &
                                   held, held_size, spring_size)
                excess(:) = larger(excess, off - audit_unit*(held_size + (closed(:, j) - held)*sizes))
                off(:) = wrong_way(beam%changes(j)*beam%side(j), contact(:, j), closed(:, j), w(:, i), reaction(:, j))
                excess(:) = larger(larger(excess, off), (1.0_wp - abs(beam%side(j)))*(1.0_wp - closed(:, j)))
            end do
        end do
    end subroutine audit_beside

    !> Moments: none at hinges and beyond the ends, with steps where there are couples
    pure subroutine audit_moments(beam, n, couple, ml, mr, excess)
        type(lane_beam_type), intent(in) :: beam
        !> As for audit_nodes
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: couple, ml, mr
        real(wp), intent(inout) :: excess(lanes)
        real(wp) :: most(lanes)
        integer :: i

        most(:) = larger(larger(excess, abs(ml(:, 0))), abs(mr(:, n)))
        do i = 0, n
            if (beam%restraint(i) > 0) cycle
            if (beam%with_couples) then
                most(:) = larger(most, abs(ml(:, i) - mr(:, i) + couple(:, i)) &
                                   - audit_unit*(abs(mr(:, i)) + abs(couple(:, i))))
            else
                most(:) = larger(most, abs(ml(:, i) - mr(:, i)))
            end if
            if (beam%hinge(i) > 0.5_wp) most(:) = larger(larger(most, abs(ml(:, i))), abs(mr(:, i)))
        end do
        excess(:) = most
    end subroutine audit_moments

    !> Rotational restraints
    pure subroutine audit_restraints(beam, pack, excess)
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(in) :: pack
        !> Of laws or of rotations, as for audit_nodes
        real(wp), intent(inout) :: excess(lanes)
        real(wp), dimension(lanes) :: off, size_of_off
        integer :: k, m

        do m = 1, size(beam%restrained)
            do k = max(beam%restrained(m), 1), min(beam%restrained(m) + 1, beam%n)
                call check_restraint(beam, pack%links, beam%n, m, k, pack%left, pack%right, pack%couple, pack%w, pack%ml, &
                                     pack%mr, off, size_of_off)
                excess(:) = larger(excess, off - audit_unit*size_of_off)
            end do
        end do
    end subroutine audit_restraints

    !> How far the rotation of a restraint, which its couple makes, is from that of a link
    pure subroutine check_restraint(beam, links, n, m, k, left, right, couple, w, ml, mr, off, size_of_off)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> The restraint, and the link left or right of it
        integer, intent(in) :: m, k
        !> As for audit_nodes
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, couple, w, ml, mr
        real(wp), intent(out), dimension(lanes) :: off, size_of_off
        real(wp) :: start, end, link_size, next, next_size, turn
        integer :: i, l

        i = beam%restrained(m)
        do l = 1, lanes
            call check_link(w(l, k - 1), w(l, k), mr(l, k - 1), ml(l, k), beam%inverse(k), &
                            links(min(l, stiffness_lanes), link_faa, k), links(min(l, stiffness_lanes), link_fab, k), &
                            links(min(l, stiffness_lanes), link_fbb, k), start, end, link_size, next, next_size)
            turn = beam%compliance(m)*(ml(l, i) - mr(l, i) + couple(l, i))
            size_of_off(l) = beam%compliance(m)*(abs(ml(l, i)) + abs(mr(l, i)) + abs(couple(l, i)))
            if (k > i) then
                off(l) = abs(start - turn + right(l, i))
                size_of_off(l) = size_of_off(l) + (link_size + abs(right(l, i)))
            else
                off(l) = abs(turn - end + left(l, i))
                size_of_off(l) = size_of_off(l) + (link_size + abs(left(l, i)))
            end if
        end do
    end subroutine check_restraint

    !> Audit a long beam without hinges, restraints and couples, at most one support at a node, of which neighbouring nodes are side
    !> by side
    pure subroutine audit_along(n, inverse, faa, fab, fbb, side, there, changing, left, right, shear, stiffness, rigid, contact, &
                                closed, w, m, reaction, wrong)
        integer, intent(in) :: n
        !> Links (lane_beam_type)
        real(wp), intent(in), dimension(n) :: inverse, faa, fab, fbb
        !> Supports (segment_beam_type), loads and supports of the case (pack_type), shape (0:n)
        real(wp), intent(in), dimension(0:n) :: side, there, changing, left, right, shear, stiffness, rigid, contact
        !> Scheme and solution, with the moments at both sides of the nodes
        real(wp), intent(in), dimension(0:n) :: closed, w, m, reaction
        !> As for audit_pack
        logical, intent(out) :: wrong
        ! Of the links, from that before the first node on
        real(wp), dimension(0:cache_block) :: start, end, link_size, next, next_size
        real(wp) :: turn, force, law, all_turns, all_forces, all_laws, off, size, off_law, held, held_size, spring_size, joined
        integer :: from, to, i, k

        turn = 0.0_wp
        force = 0.0_wp
        law = larger(abs(m(0)), abs(m(n)))
        all_turns = 0.0_wp
        all_forces = 0.0_wp
        all_laws = 0.0_wp
        do from = 0, n, cache_block
            to = min(from + cache_block - 1, n)
            ! There are no links beyond the ends
            do k = 0, cache_block, to - from + 1
                start(k) = 0.0_wp
                end(k) = 0.0_wp
                link_size(k) = 0.0_wp
                next(k) = 0.0_wp
                next_size(k) = 0.0_wp
            end do
            !$omp simd private(k)
            do i = max(from, 1), min(to + 1, n)
                k = i - from
                call check_link(w(i - 1), w(i), m(i - 1), m(i), inverse(i), faa(i), fab(i), fbb(i), start(k), end(k), &
                                link_size(k), next(k), next_size(k))
            end do
            !$omp simd private(k, off, size, off_law, held, held_size, spring_size, joined) reduction(max: turn, force, law) &
            !$omp   reduction(+: all_turns, all_forces, all_laws)
            do i = from, to
                k = i - from
                joined = merge(1.0_wp, 0.0_wp, i > 0 .and. i < n)
                off = joined*abs(start(k + 1) - end(k) + (left(i) + right(i)))
                size = link_size(k + 1) + link_size(k)
                turn = max(turn, off - audit_unit*size)
                all_turns = all_turns + size
                call check_support(stiffness(i), rigid(i), contact(i), closed(i), w(i), reaction(i), off_law, held, held_size, &
                                   spring_size)
                off = abs(next(k + 1) - next(k) + (shear(i) - reaction(i)))
                size = next_size(k + 1) + next_size(k) + (spring_size + abs(reaction(i)))
                force = max(force, off - audit_unit*size)
                all_forces = all_forces + size
                size = held_size + (closed(i) - held)*size
                law = max(law, there(i)*(off_law - audit_unit*size))
                all_laws = all_laws + size
                law = max(law, wrong_way(changing(i), contact(i), closed(i), w(i), reaction(i)))
                law = max(law, there(i)*(1.0_wp - abs(side(i)))*(1.0_wp - closed(i)))
            end do
        end do
        wrong = is_wrong(turn, force, law, all_turns, all_forces, all_laws)
    end subroutine audit_along

    !> Rotations of both ends of a link, without those that loads on it make, and its shear, with sizes of the terms
    elemental subroutine check_link(w_a, w_b, m_a, m_b, inverse, faa, fab, fbb, start, end, link_size, shear, shear_size)
        real(wp), intent(in) :: w_a, w_b, m_a, m_b, inverse, faa, fab, fbb
        !> The size is of both rotations: fab is not above half of faa + fbb
        real(wp), intent(out) :: start, end, link_size, shear, shear_size
        real(wp) :: slope, moments

        slope = (w_b - w_a)*inverse
        start = slope + (faa*m_a + fab*m_b)
        end = slope - (fab*m_a + fbb*m_b)
        shear = (m_b - m_a)*inverse
        moments = abs(m_a) + abs(m_b)
        link_size = (abs(w_a) + abs(w_b))*inverse + (faa + fbb)*moments
        shear_size = moments*inverse
    end subroutine check_link

    !> How far a support is from its law: in force where it is elastic or open, in deflection where it is rigid
    elemental subroutine check_support(stiffness, rigid, contact, closed, w, reaction, off, held, held_size, spring_size)
        !> As in pack_type
        real(wp), intent(in) :: stiffness, rigid, contact, closed, w, reaction
        !> Does it hold its node rigidly; sizes of the terms of its deflection, if it does, and of its spring, if that acts
        real(wp), intent(out) :: off, held, held_size, spring_size
        real(wp) :: spring, pressed, level

        held = closed*rigid
        spring = closed*stiffness
        pressed = w - contact
        level = abs(w) + abs(contact)
        off = abs((1.0_wp - held)*(reaction - spring*pressed) + held*pressed)
        held_size = held*level
        spring_size = spring*level
    end subroutine check_support

    !> How far a support pulls that may only push, or the beam has gone into it
    elemental function wrong_way(changing, contact, closed, w, reaction) result(off)
        !> The side of one that may change
        real(wp), intent(in) :: changing
        !> As in pack_type
        real(wp), intent(in) :: contact, closed, w, reaction
        real(wp) :: off

        off = changing*((1.0_wp - closed)*(w - contact) - closed*reaction)
    end function wrong_way

    include 'cases/larger.inc'

end module gapbeam_lane_audit
