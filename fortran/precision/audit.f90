!> Audit of the results of a beam without ground: equilibrium, compatibility, laws.
!>
!> Nothing of how the solution was found is used. At every node forces and moments balance, and with that those of every part of the
!> beam between hinges; rotations are those of one beam but at hinges, or those of the restraint; every support lies on its law at
!> the deflection told, in the state told, and no contact is violated. What is left over of a sum is measured in roundings of its
!> terms (gapbeam_ledger).
module gapbeam_audit
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: most_left_out, everywhere, audit_allows
    use gapbeam_nodes, only: hinge, jointed, hinge_left, hinge_right, joint_left, joint_right, is_restrained, &
        takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_law, only: is_plainly_right, force_by_spring
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_model, only: beam_type, softest
    use gapbeam_turning, only: apply_turning, find_turning
    use gapbeam_workspace, only: workspace_type
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_supports, of_restraints, rotations, moments, &
        forces, deflections, beyond, pulls, kinds
    implicit none
    private
    public :: audit_beam, audit_axial, audit_residuals

contains

    !> Audit a solution of a beam
    recursive subroutine audit_beam(beam, closed, undecided, floats, leeway, answers, shear, reaction, work, ledger, measured)
        !> The beam
        type(beam_type), intent(in) :: beam
        !> The scheme, and which supports may have either state, shape (m)
        logical, intent(in) :: closed(:), undecided(:)
        !> Is the beam free to move without work
        logical, intent(in) :: floats
        !> So many times rounding signs may be wrong: 1, or more where the scheme is that of a path at a rounded load factor
        real(wp), intent(in) :: leeway
        !> Deflections and moments at the nodes, shape (0:n)
        type(answer_type), intent(in) :: answers(0:)
        !> Shear of every link beside that of the simple bar, shape (n), and reactions, up, shape (m)
        real(wp), intent(in) :: shear(:), reaction(:)
        !> With the loads
        type(workspace_type), intent(in) :: work
        !> What is left over, and what is wrong
        type(ledger_type), intent(out) :: ledger
        !> Is all noted that is left over, not only what may be wrong; default no
        logical, intent(in), optional :: measured
        real(wp) :: turn, turn_size, before, before_size, after, after_size, up, up_size, jump, slope, slope_size
        real(wp) :: passed, passed_size, farthest, most_load, limit, least(kinds)
        integer :: i, j, n

        n = size(beam%links)
        if (allocated(beam%turning)) then
            call audit_turning()
            return
        end if
        limit = audit_allows*epsilon(1.0_wp)
        if (present(measured)) limit = merge(0.0_wp, limit, measured)
        farthest = maxval(abs(answers(:n)%deflection))
        least(:) = -1.0_wp
        before = 0.0_wp
        before_size = 0.0_wp
        slope = 0.0_wp
        slope_size = 0.0_wp
        passed = 0.0_wp
        passed_size = 0.0_wp
        do i = 0, n
            associate (a => answers(i), r => work%loads(i))
                ! Forces: of the link on the left as they are from the round before, then of that on the right
                up = passed - r%shear
                up_size = passed_size + work%load_size(i)
                do j = beam%first(i), beam%first(i + 1) - 1
                    up = up + reaction(beam%order(j))
                    up_size = up_size + abs(reaction(beam%order(j)))
                end do
                after = 0.0_wp
                after_size = 0.0_wp
                if (i < n) then
                    associate (link => beam%links(i + 1), b => answers(i + 1))
                        passed = shear(i + 1)
                        passed_size = abs(passed) + (abs(a%moment_right) + abs(b%moment_left))*link%inverse
                        up = up - passed
                        up_size = up_size + passed_size
                        turn = passed - (b%moment_left - a%moment_right)*link%inverse
                        if (.not. abs(turn) <= limit*passed_size) call hold(of_equilibrium, forces, turn, passed_size)
                        slope = (b%deflection - a%deflection)*link%inverse
                        slope_size = (abs(b%deflection) + abs(a%deflection))*link%inverse + work%turn_size(i + 1)
                        after = slope + (link%faa*a%moment_right + link%fab*b%moment_left) + r%right
                        after_size = slope_size + link%faa*abs(a%moment_right) + abs(link%fab*b%moment_left)
                    end associate
                end if
                if (.not. abs(up) <= limit*up_size) call hold(of_equilibrium, forces, up, up_size)
                do j = beam%first(i), beam%first(i + 1) - 1
                    associate (k => beam%order(j))
                        if (.not. is_plainly_right(beam%supports(k), closed(k), a%deflection, farthest, reaction(k), up_size, &
                                                   limit)) call audit_support(k)
                    end associate
                end do
                ! Moments and rotations
                jump = a%moment_left - a%moment_right + r%couple
                if (is_restrained(beam%kind(i))) then
                    call audit_restraint(a, r, jump)
                else if (beam%kind(i) == hinge) then
                    call hold(of_equilibrium, moments, max(abs(a%moment_left - r%moment), abs(jump)), &
                              abs(r%moment) + abs(r%couple))
                else
                    turn_size = abs(a%moment_left) + abs(a%moment_right) + abs(r%couple)
                    if (.not. abs(jump) <= limit*turn_size) call hold(of_equilibrium, moments, jump, turn_size)
                    if (i > 0 .and. i < n) then
                        turn = after - before
                        turn_size = after_size + before_size
                        if (beam%kind(i) == jointed) then
                            turn = turn + beam%compliance(i)*a%moment_left
                            turn_size = turn_size + beam%compliance(i)*abs(a%moment_left)
                        end if
                        if (.not. abs(turn) <= limit*turn_size) call hold(of_bending, rotations, turn, turn_size)
                    end if
                end if
                if (i == n) exit
                associate (link => beam%links(i + 1), b => answers(i + 1))
                    before = slope - (link%fab*a%moment_right + link%fbb*b%moment_left) - work%loads(i + 1)%left
                    before_size = slope_size + abs(link%fab*a%moment_right) + link%fbb*abs(b%moment_left)
                end associate
            end associate
        end do
        i = 0
        call hold(of_equilibrium, moments, answers(0)%moment_left, 0.0_wp)
        i = n
        call hold(of_equilibrium, moments, answers(n)%moment_right, 0.0_wp)

    contains

        !> A node with a restraint, and where there is a hinge or a joint beside that
        subroutine audit_restraint(a, r, jump)
            type(answer_type), intent(in) :: a
            type(rhs_type), intent(in) :: r
            !> What of the moment the restraint takes
            real(wp), intent(in) :: jump
            real(wp) :: turn, turn_size, joint

            turn = beam%compliance(i)*jump
            turn_size = beam%compliance(i)*(abs(a%moment_left) + abs(a%moment_right) + abs(r%couple))
            if (takes_left(beam%kind(i)) .and. i > 0) then
                joint = merge(work%nodes(i)%joint*a%moment_left, 0.0_wp, beam%kind(i) == joint_right)
                call hold(of_restraints, rotations, before - (turn + joint), before_size + turn_size + abs(joint))
            end if
            if (takes_right(beam%kind(i)) .and. i < n) then
                joint = merge(work%nodes(i)%joint*a%moment_right, 0.0_wp, beam%kind(i) == joint_left)
                call hold(of_restraints, rotations, after - (turn - joint), after_size + turn_size + abs(joint))
            end if
            if (beam%kind(i) == hinge_left) call hold(of_equilibrium, moments, a%moment_right - r%moment, abs(r%moment))
            if (beam%kind(i) == hinge_right) call hold(of_equilibrium, moments, a%moment_left - r%moment, abs(r%moment))
        end subroutine audit_restraint

        !> The same where supports hold rotations: the beam with what they do as couples, restraints and joints, then their laws
        subroutine audit_turning()
            type(beam_type) :: without
            type(workspace_type) :: loaded
            type(node_type), allocatable :: nodes(:)
            type(rhs_type), allocatable :: rhs(:)
            type(answer_type), allocatable :: turned(:)
            real(wp), allocatable :: level(:), turn_size(:), couple(:), couple_size(:)
            real(wp) :: hidden_couple, left_out, hidden_rotation
            integer :: r, v

            r = size(beam%turning)
            farthest = maxval(abs(answers(:n)%deflection))
            allocate (nodes(0:n + r), rhs(0:n + r), turned(0:n + r), level(0:n + r), turn_size(r), couple(r), couple_size(r))
            nodes(0:n)%kind = beam%kind
            nodes(0:n)%compliance = beam%compliance
            rhs(0:n) = work%loads(0:n)
            level(:) = 0.0_wp
            call apply_turning(beam, closed, [0, n], nodes, rhs, level)
            turned(0:n) = answers(0:n)
            call find_turning(beam, nodes, rhs, work%loads, work%turn_size, turned, turn_size, couple, couple_size)
            without = beam
            deallocate (without%turning)
            without%kind(:) = nodes(0:n)%kind
            without%compliance(:) = nodes(0:n)%compliance
            loaded = work
            loaded%loads(0:n) = rhs(0:n)
            loaded%nodes(0:n) = nodes(0:n)
            call audit_beam(without, closed, undecided, floats, leeway, answers(0:n), shear, reaction, loaded, ledger, measured)
            hidden_couple = everywhere*maxval(abs(answers(:n)%moment_left))
            left_out = maxval(work%load_size)*maxval(beam%links%length)
            hidden_rotation = everywhere*maxval(abs(answers(:n)%deflection))*maxval(beam%links%inverse)
            do v = n + 1, n + r
                call audit_rotation(beam%turning(v - n), beam%order(beam%first(v):beam%first(v + 1) - 1), turned(v)%deflection, &
                                    turn_size(v - n) + hidden_rotation, couple(v - n), couple_size(v - n) + hidden_couple, left_out)
            end do
        end subroutine audit_turning

        !> Are the supports of a rotation on their laws, in the right states, and is the couple theirs
        subroutine audit_rotation(at, numbers, rotation, of_rotation, couple, couple_size, left_out)
            !> Node of the beam, and the numbers of the supports
            integer, intent(in) :: at, numbers(:)
            !> The rotation and the couple, each with the size of its terms, and the couple that the largest load can make
            real(wp), intent(in) :: rotation, of_rotation, couple, couple_size, left_out
            real(wp) :: force, rounding, margin, of_couple, bent
            logical :: acts, rigid, by_force
            integer :: j, k

            ! Couples that are nothing but rounding, of what holds links straight or of the largest load, may have been left out
            bent = 0.0_wp
            if (at > 0) bent = forced(at)*beam%links(at)%length
            if (at < n) bent = bent + forced(at + 1)*beam%links(at + 1)%length
            of_couple = couple_size + everywhere*bent
            if (.not. abs(sum(reaction(numbers))) > 0.0_wp) then
                of_couple = of_couple + most_left_out/epsilon(1.0_wp)*(left_out + bent)
            end if
            call note(ledger, of_equilibrium, moments, couple - sum(reaction(numbers)), of_couple + sum(abs(reaction(numbers))), &
                      at, 0.0_wp)
            do j = 1, size(numbers)
                k = numbers(j)
                associate (supports => beam%supports)
                    call force_by_spring(supports, closed, k, rotation, of_rotation, acts, rigid, force, rounding)
                    if (acts .and. rigid) then
                        call note(ledger, of_supports, rotations, rotation - supports(k)%contact, of_rotation, at, 0.0_wp)
                    else
                        call note(ledger, of_supports, moments, reaction(k) - force, of_couple + rounding/epsilon(1.0_wp), at, &
                                  0.0_wp)
                    end if
                    if (undecided(k) .or. .not. is_watched_in(supports, closed, k)) cycle
                    if (supports(k)%breakpoint > 0 .and. .not. abs(supports(k)%stiffness - supports(k)%before) > 0.0_wp) cycle
                    call margin_in_scheme(supports, closed, k, rotation, of_rotation, reaction, reaction, margin, rounding, &
                                          by_force)
                    if (margin >= 0.0_wp) cycle
                    call note(ledger, of_supports, merge(pulls, beyond, by_force), margin, &
                              leeway*merge(of_couple, rounding/epsilon(1.0_wp), by_force), at, 0.0_wp)
                end associate
            end do
        end subroutine audit_rotation

        !> Note what is left over of a sum at node i
        subroutine hold(what, kind, left, terms)
            integer, intent(in) :: what, kind
            real(wp), intent(in) :: left, terms
            real(wp) :: bent(2), rest

            if (.not. abs(left) > 0.0_wp) return
            if (least(forces) < 0.0_wp) call find_least()
            bent = 0.0_wp
            if (i > 0) bent(1) = forced(i)
            if (i < n) bent(2) = forced(i + 1)
            select case (kind)
            case (forces, pulls)
                rest = everywhere*sum(bent) + size_left_out(sum(bent))
            case (moments)
                rest = everywhere*sum(bent)*beam%links(max(i, 1))%length
            case (rotations)
                rest = everywhere*turned()
            case default
                rest = 0.0_wp
            end select
            call note(ledger, what, kind, left, terms + least(kind) + rest, i, 0.0_wp)
            if (.not. terms <= huge(terms)) call note(ledger, what, 0, terms, terms, i, 0.0_wp)
        end subroutine hold

        !> What the largest terms of the beam leave everywhere
        subroutine find_least()
            most_load = maxval(work%load_size)
            least(:) = 0.0_wp
            least(forces) = everywhere*max(maxval(abs(shear)), maxval(abs(reaction)), most_load)
            ! Loads that balance each other on a beam that nothing holds leave as much to rounding
            if (floats) least(forces) = most_load
            least(pulls) = least(forces)
            least(moments) = everywhere*max(maxval(abs(answers%moment_left)), maxval(abs(answers%moment_right)))
            ! Where all deflections cancel, they do so from the levels of the supports that act, and from what the loads could make
            if (any(closed)) least(deflections) = maxval(abs(beam%supports%contact), closed)
            least(deflections) = everywhere*(least(deflections) + most_load/softest(beam))
            least(rotations) = everywhere*(farthest*maxval(beam%links%inverse) + maxval(work%turn_size)) &
                + least(deflections)*maxval(beam%links%inverse)
        end subroutine find_least

        !> What may have been left out of the forces at node i: reactions that are nothing but rounding, of the largest load or of
        !> what bends the links beside it, and what the force of a law loses where it is small beside that at its breakpoint
        pure function size_left_out(bent) result(found)
            real(wp), intent(in) :: bent
            real(wp) :: found, force, rounding
            logical :: acts, rigid
            integer :: k

            found = 0.0_wp
            do k = beam%first(i), beam%first(i + 1) - 1
                associate (pushes => abs(reaction(beam%order(k))) > 0.0_wp)
                    if (pushes .and. beam%supports(beam%order(k))%breakpoint == 0) cycle
                    call force_by_spring(beam%supports, closed, beam%order(k), 0.0_wp, 0.0_wp, acts, rigid, force, rounding)
                    if (acts .and. .not. pushes) found = max(found, most_left_out/epsilon(1.0_wp)*most_load + bent)
                end associate
                found = found + rounding/epsilon(1.0_wp)
            end do
        end function size_left_out

        !> By how much the moments at node i would turn the links beside it: what a bar without moment passes by is known to a
        !> rounding of them only
        pure function turned() result(turn)
            real(wp) :: turn

            turn = 0.0_wp
            if (i > 0) turn = beam%links(i)%fbb
            if (i < n) turn = turn + beam%links(i + 1)%faa
            turn = turn*(abs(answers(i)%moment_left) + abs(answers(i)%moment_right) + abs(work%loads(i)%couple))
        end function turned

        !> Force that it would take to hold a link straight against its deflections and imposed curvatures; of a rigid one, which
        !> passes on what others make, the most of all
        pure recursive function forced(k) result(force)
            integer, intent(in) :: k
            real(wp) :: force
            integer :: other

            force = 0.0_wp
            associate (link => beam%links(k))
                if (link%bending > 0.0_wp) then
                    force = 12*link%inverse*(farthest*link%inverse + work%turn_size(k))/link%bending
                    return
                end if
            end associate
            do other = 1, n
                if (beam%links(other)%bending > 0.0_wp) force = max(force, forced(other))
            end do
        end function forced

        !> Is a support on its law, in the right state
        subroutine audit_support(k)
            integer, intent(in) :: k
            real(wp) :: force, rounding, margin, of_force
            logical :: acts, rigid, by_force

            associate (supports => beam%supports, r => reaction(k), w => answers(i)%deflection)
                call force_by_spring(supports, closed, k, w, farthest, acts, rigid, force, rounding)
                of_force = rounding/epsilon(1.0_wp) + up_size
                if (acts .and. rigid) then
                    call hold(of_supports, deflections, w - supports(k)%contact, abs(supports(k)%contact))
                else
                    call hold(of_supports, forces, r - force, merge(of_force, 0.0_wp, acts))
                end if
                if (undecided(k) .or. .not. is_watched_in(supports, closed, k)) return
                ! A breakpoint that is none: either state is right
                if (supports(k)%breakpoint > 0 .and. .not. abs(supports(k)%stiffness - supports(k)%before) > 0.0_wp) return
                call margin_in_scheme(supports, closed, k, w, farthest, reaction, reaction, margin, rounding, by_force)
                if (margin >= 0.0_wp) return
                call hold(of_supports, merge(pulls, beyond, by_force), margin, &
                          leeway*merge(of_force, rounding/epsilon(1.0_wp), by_force))
            end associate
        end subroutine audit_support

    end subroutine audit_beam

    !> Audit the system along the beam: forces at its points balance, bars are as much longer as their forces make them, supports
    !> are on their laws
    subroutine audit_axial(flexibility, elongation, force, stiffness, settlement, displacement, tension, reaction, ledger)
        !> As for solve_axial
        real(wp), intent(in) :: flexibility(:), elongation(:), force(0:), stiffness(0:), settlement(0:), displacement(0:), &
                                tension(:), reaction(0:)
        !> What is left over, and what is wrong at which point, from 0
        type(ledger_type), intent(out) :: ledger
        real(wp) :: left, right, longer, most, farthest
        integer :: i, n

        n = size(flexibility)
        farthest = max(maxval(abs(displacement)), maxval(abs(settlement)))
        ! Where elongations make no force, what springs give is their rounding
        most = max(everywhere*max(maxval(abs(force)), maxval(abs(reaction))), &
                   epsilon(most)*farthest*maxval(stiffness, stiffness <= huge(most)))
        do i = 0, n
            left = 0.0_wp
            right = 0.0_wp
            if (i > 0) left = tension(max(i, 1))
            if (i < n) right = tension(min(i + 1, n))
            call note(ledger, of_equilibrium, forces, right - left + (force(i) + reaction(i)), &
                      abs(left) + abs(right) + abs(force(i)) + abs(reaction(i)) + most, i, 0.0_wp)
            if (i > 0) then
                longer = flexibility(max(i, 1))*left + elongation(max(i, 1))
                call note(ledger, of_bending, deflections, displacement(i) - displacement(max(i, 1) - 1) - longer, &
                          2*farthest + abs(flexibility(max(i, 1))*left) + abs(elongation(max(i, 1))), i, 0.0_wp)
            end if
            if (stiffness(i) > huge(most)) then
                call note(ledger, of_supports, deflections, displacement(i) - settlement(i), abs(settlement(i)), i, 0.0_wp)
            else
                call note(ledger, of_supports, forces, reaction(i) + stiffness(i)*(displacement(i) - settlement(i)), &
                          abs(left) + abs(right) + abs(force(i)) + stiffness(i)*farthest, i, 0.0_wp)
            end if
        end do
    end subroutine audit_axial

    !> Residuals of compatibility, equilibrium and complementarity: the most that is left over of a sum, relative to its terms
    pure function audit_residuals(ledger) result(residuals)
        !> By audit_beam
        type(ledger_type), intent(in) :: ledger
        real(wp) :: residuals(3)

        associate (relative => epsilon(1.0_wp)*ledger%excesses)
            residuals = [maxval(relative([deflections, rotations])), maxval(relative([moments, forces])), &
                         maxval(relative([beyond, pulls]))]
        end associate
    end function audit_residuals

end module gapbeam_audit
