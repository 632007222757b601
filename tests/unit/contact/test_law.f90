!> What a support does: states, forces, margins and distances of single supports, by hand
program test_law
    use testing, only: check, check_close, finish
    use beams, only: infinite
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_law, only: node_support_type, below, above, both, is_support, is_rigid, always_closed, separate_rigid_pairs, &
        add_supports, share_forces
    use gapbeam_law_margins, only: may_change, margin_of, margin_rates, find_margins, find_wrong_states, find_doubtful_states
    use gapbeam_law_kinematics, only: mark_held, outermost, is_blocked, leaves_all, distance_to_contact
    use gapbeam_law_adapters, only: least_stiffness, stiffness_of_changing, find_pairs, find_single, hold_both_ways, &
        limit_stiffness, drop_level
    implicit none
    integer :: status

    call states()
    call rigid_pairs()
    call forces_at_a_node()
    call springs_instead()
    call reactions()
    call margins()
    call wrong_states()
    call motions()
    call forms()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A support of each kind: both ways, of no stiffness, spring from below, rigid from below, rigid from above
    function kinds() result(supports)
        type(node_support_type) :: supports(5)

        supports = [node_support_type(0, both, 8.0_wp, 0.5_wp), node_support_type(1, below, 0.0_wp, 0.0_wp), &
                    node_support_type(2, below, 4.0_wp, 0.25_wp), node_support_type(3, below, infinite(), 0.0_wp), &
                    node_support_type(4, above, infinite(), -0.5_wp)]
    end function kinds

    !> Which states there are
    subroutine states()
        call check(all(is_support(kinds())), "supports of every kind")
        call check(.not. any(is_support([node_support_type(0, 2, 1.0_wp, 0.0_wp), node_support_type(0, both, -1.0_wp, 0.0_wp), &
                                         node_support_type(0, both, 1.0_wp, infinite())])), "no such side, stiffness, level")
        call check(all(may_change(kinds()) .eqv. [.false., .false., .true., .true., .true.]), &
                   "only a one-sided support with a stiffness changes its state")
        call check(all(is_rigid(kinds()) .eqv. [.false., .false., .false., .true., .true.]), "infinite is rigid")
        call check(all(always_closed(kinds()) .eqv. [.true., .false., .false., .false., .false.]), &
                   "one that holds both ways is always closed")
        call check(size(always_closed([node_support_type ::])) == 0, "no supports")
    end subroutine states

    !> Rigid supports at one node
    subroutine rigid_pairs()
        logical :: closed(4)
        type(node_support_type) :: supports(4)

        supports = [node_support_type(1, below, infinite(), 0.0_wp), node_support_type(1, above, infinite(), -0.1_wp), &
                    node_support_type(2, below, infinite(), 0.0_wp), node_support_type(1, below, 1.0_wp, 0.0_wp)]
        closed = .true.
        call separate_rigid_pairs(supports, 2, closed)
        call check(all(closed .eqv. [.true., .false., .true., .true.]), "of two rigid ones the first acts, springs do as well")
        closed = [.false., .true., .true., .false.]
        call separate_rigid_pairs(supports, 2, closed)
        call check(all(closed .eqv. [.false., .true., .true., .false.]), "one of them alone stays")
        supports(3) = node_support_type(1, both, infinite(), 0.0_wp)
        closed = .true.
        call separate_rigid_pairs(supports, 2, closed)
        call check(all(closed .eqv. [.false., .false., .true., .true.]), "beside one that holds both ways none acts")
    end subroutine rigid_pairs

    !> Stiffness, load and level that supports add to their nodes
    subroutine forces_at_a_node()
        type(node_type) :: nodes(0:2)
        type(rhs_type) :: rhs(0:2)
        real(wp) :: level(0:2)
        type(node_support_type) :: supports(4)

        supports = [node_support_type(1, below, 10.0_wp, 0.2_wp), node_support_type(1, both, 5.0_wp, -0.4_wp), &
                    node_support_type(1, above, 100.0_wp, 3.0_wp), node_support_type(2, below, infinite(), 0.7_wp)]
        rhs(1)%shear = 1.0_wp
        level = 0.0_wp
        call add_supports(supports, [1, 2, 3, 4], [.true., .true., .false., .true.], nodes, rhs, level)
        call check_close(nodes%stiffness, [0.0_wp, 15.0_wp, 0.0_wp], "stiffnesses add up; an open support has none")
        call check_close(rhs%shear, [0.0_wp, 1.0_wp, 0.0_wp], "so do the forces that hold springs back: 1 + 10*0.2 - 5*0.4")
        call check(all(nodes%held .eqv. [.false., .false., .true.]), "a rigid one holds its node")
        call check_close(rhs%deflection, [0.0_wp, 0.0_wp, 0.7_wp], "at its contact level")
        call check_close(level, [0.0_wp, 0.4_wp, 0.7_wp], "largest level of the closed ones")
        call add_supports(supports, [integer ::], [.true., .true., .true., .true.], nodes, rhs, level)
        call check_close(nodes%stiffness, [0.0_wp, 15.0_wp, 0.0_wp], "none at the nodes at hand")
    end subroutine forces_at_a_node

    !> Springs in place of one-sided supports, open ones too
    subroutine springs_instead()
        type(node_type) :: nodes(0:1)
        type(rhs_type) :: rhs(0:1)
        real(wp) :: level(0:1)

        level = 0.0_wp
        call add_supports([node_support_type(0, both, 2.0_wp, 1.0_wp), node_support_type(1, below, infinite(), 9.0_wp)], [1, 2], &
                          [.true., .false.], nodes, rhs, level, [50.0_wp, 3.0_wp], [50.0_wp, 0.5_wp])
        call check_close(nodes%stiffness, [2.0_wp, 3.0_wp], "the spring takes the place of the one-sided support only")
        call check_close(rhs%shear, [2.0_wp, 1.5_wp], "with its own level")
        call check(.not. any(nodes%held), "nothing is rigid")
    end subroutine springs_instead

    !> Reactions of supports that share a node
    subroutine reactions()
        type(node_type) :: nodes(0:1)
        type(answer_type) :: answers(0:1)
        real(wp) :: reaction(3), error(3)

        answers(1)%deflection = 0.5_wp
        nodes(1)%held = .true.
        reaction = -1.0_wp
        error = -1.0_wp
        ! A spring of 4 from 0.25 on takes 1, the rigid one the rest of 7; the third is open
        call share_forces([node_support_type(1, below, 4.0_wp, 0.25_wp), node_support_type(1, below, infinite(), 0.5_wp), &
                           node_support_type(1, above, infinite(), 9.0_wp)], [1, 2, 3], [1, 1, 4], [.true., .true., .false.], &
                          [1, 1], nodes, answers, [1.0_wp, 1.0_wp], [7.0_wp], [0.0_wp], reaction, error)
        call check_close(reaction, [1.0_wp, 6.0_wp, 0.0_wp], "spring, rigid support, open support")
        call check_close(error, epsilon(1.0_wp)*[4.0_wp, 1.0_wp, 0.0_wp], "their rounding errors")
        ! A spring so stiff that its compression is rounding: 1e20 * 0.5 is nothing to go by
        nodes(1)%held = .false.
        call share_forces([node_support_type(1, below, 1e20_wp, 0.5_wp), node_support_type(1, below, 4.0_wp, 0.25_wp)], [1, 2], &
                          [1, 1, 3], [.true., .true.], [1, 1], nodes, answers, [1.0_wp, 1.0_wp], [7.0_wp], [1e-15_wp], &
                          reaction(:2), error(:2))
        call check_close(reaction(:2), [6.0_wp, 1.0_wp], "the stiffest spring takes what the others leave")
        call check(error(1) < 1e-14_wp, "and is known as well")
        reaction = 5.0_wp
        call share_forces([node_support_type(1, below, 4.0_wp, 0.25_wp)], [1], [1, 1, 2], [.false.], [1, 1], nodes, answers, &
                          [1.0_wp, 1.0_wp], [7.0_wp], [0.0_wp], reaction(:1), error(:1))
        call check_close(reaction(1), 0.0_wp, "nothing acts")
        call check_close(reaction(2), 5.0_wp, "others stay")
    end subroutine reactions

    !> The one measure of all signs
    subroutine margins()
        real(wp) :: margin(5), rounding(5), rate, level
        logical :: by_force
        type(answer_type) :: answers(0:4)

        answers%deflection = [9.0_wp, 9.0_wp, 0.125_wp, -0.25_wp, 0.25_wp]
        call find_margins(kinds(), [.true., .false., .false., .false., .false.], answers, spread(2.0_wp, 1, 5), &
                          [-5.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], spread(1.0_wp, 1, 5), margin, rounding)
        call check_close(margin, [0.0_wp, 0.0_wp, 0.125_wp, 0.25_wp, 0.75_wp], &
                         "distance to contact; 0 where the state does not change, pulled and penetrated as it may be")
        call check_close(rounding, 2*epsilon(1.0_wp)*[0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], "rounding of the deflection")
        call find_margins(kinds(), spread(.true., 1, 5), answers, spread(2.0_wp, 1, 5), &
                          [-5.0_wp, 0.0_wp, 3.0_wp, -3.0_wp, -3.0_wp], spread(0.5_wp, 1, 5), margin, rounding)
        call check_close(margin, [0.0_wp, 0.0_wp, 3.0_wp, -3.0_wp, 3.0_wp], "force with which it pushes")
        call check_close(rounding(3:), spread(0.5_wp, 1, 3), "rounding of the reaction")
        call margin_of(node_support_type(0, above, 1.0_wp, 8.0_wp), .false., 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, margin(1), rounding(1))
        call check_close([margin(1), rounding(1)], [-8.0_wp, 8*epsilon(1.0_wp)], "a contact level beyond the deflections counts")
        call margin_rates([node_support_type(0, above, 3.0_wp, -8.0_wp)], [.true.], 1, rate, level, by_force)
        call check_close([rate, level], [3.0_wp, 8.0_wp], "a closed spring's margin changes by its stiffness")
        call margin_rates([node_support_type(0, above, infinite(), -8.0_wp)], [.false.], 1, rate, level, by_force)
        call check_close(rate, 1.0_wp, "an opening as the deflection")
    end subroutine margins

    !> Which states are wrong, doubtful, clearly wrong
    subroutine wrong_states()
        type(answer_type) :: answers(0:2)
        type(node_support_type) :: supports(3)
        logical :: wrong(3), doubtful(3), in_doubt
        real(wp), parameter :: some(0:2) = 1.0_wp, errors(3) = 1e-3_wp

        supports = [node_support_type(0, below, infinite(), 0.0_wp), node_support_type(1, below, infinite(), 0.0_wp), &
                    node_support_type(2, below, 2.0_wp, 0.5_wp)]
        answers%deflection = [0.0_wp, -0.25_wp, 0.75_wp]
        associate (closed => [.true., .false., .false.], reaction => [-0.02_wp, 0.0_wp, 0.0_wp])
            call find_wrong_states(supports, closed, answers, some, reaction, errors, 10.0_wp, wrong)
            call check(all(wrong .eqv. [.true., .false., .true.]), "one pulls, one is penetrated")
            call find_wrong_states(supports, closed, answers, some, reaction, errors, 32.0_wp, wrong)
            call check(all(wrong .eqv. [.false., .false., .true.]), "what is rounding does not count")
            call find_doubtful_states(supports, closed, answers, some, reaction, errors, 32.0_wp, doubtful, in_doubt)
            call check(all(doubtful .eqv. [.true., .false., .false.]) .and. in_doubt, "but is in doubt")
            call find_doubtful_states(supports(:1), closed(:1), answers, some, [0.0_wp], [0.0_wp], 32.0_wp, doubtful(:1), &
                                      in_doubt)
            call check(doubtful(1) .and. .not. in_doubt, "an exact zero may be either, and that is no doubt")
        end associate
    end subroutine wrong_states

    !> What is in the way of a motion
    subroutine motions()
        logical :: held(0:4)
        real(wp) :: y(0:4)

        held = .false.
        call mark_held(kinds(), [.true., .true., .true., .false., .true.], held)
        call check(all(held .eqv. [.true., .false., .true., .false., .true.]), "a support of no stiffness holds nothing")
        call check(all(outermost(kinds(), below) == [2, 3]), "outermost supports that carry")
        associate (none => outermost(kinds(), 7))
            call check(none(1) > none(2), "none of a side")
        end associate
        y = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
        call check(.not. is_blocked(kinds(), y), "no stiffness, and away from one above: free")
        call check(is_blocked(kinds(), -y), "towards one above: not free")
        y = [-1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
        call check(is_blocked(kinds(), y) .and. is_blocked(kinds(), -y), "one that holds both ways is always in the way")
        y = [9.0_wp, 9.0_wp, -1.0_wp, 0.0_wp, 1.0_wp]
        associate (chosen => [.false., .false., .true., .true., .true.])
            call check(leaves_all(kinds(), chosen, y, 1), "leaves them, or stays")
            call check(.not. leaves_all(kinds(), chosen, y, -1), "the other way it does not")
            y = [9.0_wp, 9.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
            call check(leaves_all(kinds(), chosen, y, -1), "those that it does not move do not count")
        end associate
        y = [1.0_wp, 1.0_wp, 0.5_wp, 1e-9_wp, -1.0_wp]
        associate (open => spread(.false., 1, 5), from => [0.0_wp, 0.0_wp, 0.125_wp, -1.0_wp, 0.0_wp])
            call check_close(distance_to_contact(kinds(), [1, 2, 3, 4, 5], open, y, from, 1e-6_wp), 0.25_wp, "the next contact")
            call check_close(distance_to_contact(kinds(), [1, 2, 4, 5], open, y, from, 1e-6_wp), 0.5_wp, "among fewer")
            call check(distance_to_contact(kinds(), [1, 2, 4], open, y, from, 1e-6_wp) >= huge(1.0_wp), &
                       "none: both ways, no stiffness, too slow")
            call check(distance_to_contact(kinds(), [3], .not. open, y, from, 1e-6_wp) >= huge(1.0_wp), "closed ones do not close")
            call check_close(distance_to_contact(kinds(), [3], open, y, from + 1, 1e-6_wp), 0.0_wp, "never back", absolute=0.0_wp)
        end associate
    end subroutine motions

    !> What other methods make of supports
    subroutine forms()
        type(node_support_type) :: supports(5)
        integer, allocatable :: numbers(:)
        integer :: number(0:4), side(0:4)
        real(wp) :: contact(0:4)
        real(wp), allocatable :: sides(:), contacts(:), compliance(:)

        supports = kinds()
        call check_close(least_stiffness(supports, 4), 4.0_wp, "the least stiffness that is not 0")
        call check(least_stiffness(supports(2:2), 4) >= huge(1.0_wp), "there is none")
        call check_close(stiffness_of_changing(supports(:3)), [0.0_wp, 0.0_wp, 4.0_wp], "only of those that may change")
        call find_pairs(supports, numbers, sides, contacts, compliance)
        call check(all(numbers == [3, 4, 5]), "complementary pairs")
        call check_close([sides, contacts, compliance], [1.0_wp, 1.0_wp, -1.0_wp, 0.25_wp, 0.0_wp, -0.5_wp, 0.25_wp, 0.0_wp, &
                                                         0.0_wp], "sides, levels, compliances")
        supports(4)%node = 2
        call find_single(supports, number, side, contact)
        call check(all(number == [0, 0, 0, 0, 5]), "alone and one-sided: not the two at node 2")
        call check_close(contact(4), -0.5_wp, "level of the one that is")
        call check(side(4) == above, "its side")
        call hold_both_ways(supports(5))
        call check(.not. may_change(supports(5)), "made to hold both ways")
        call limit_stiffness(supports, 6.0_wp)
        call check_close(supports%stiffness, [6.0_wp, 0.0_wp, 4.0_wp, 6.0_wp, 6.0_wp], "no stiffer than 6")
        call drop_level(supports)
        call check(.not. any(abs(supports%contact) > 0.0_wp), "levels dropped")
    end subroutine forms

end program test_law
