!> Audit of the results of a beam without ground: equilibrium, compatibility, laws.
!>
!> Nothing of how the solution was found is used. At every node forces and moments balance, and with that those of every part of the
!> beam between hinges; rotations are those of one beam but at hinges, or those of the restraint; every support lies on its law at
!> the deflection told, in the state told, and no contact is violated. What is left over of a sum is measured in roundings of its
!> terms (gapbeam_ledger).
module gapbeam_audit
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: most_left_out, everywhere, audit_allows
    use gapbeam_nodes, only: hinge, jointed, hinge_left, hinge_right, is_restrained, takes_left, takes_right
    use gapbeam_band, only: node_type, rhs_type, answer_type
    use gapbeam_law, only: is_plainly_right, force_by_spring
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_model, only: beam_type, last_place, softest
    use gapbeam_turning, only: apply_turning, find_turning
    use gapbeam_workspace, only: workspace_type
    use gapbeam_rotation_audit, only: turned_type, ends_type, find_turned, audit_rotations
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_supports, of_restraints, rotations, moments, &
        forces, deflections, beyond, pulls, kinds
    implicit none
    private
    public :: audit_beam, audit_axial, audit_residuals

contains

    !> Audit a solution of a beam
    subroutine audit_beam(beam, closed, undecided, floats, leeway, answers, shear, reaction, work, ledger, measured)
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
        !> Rotations that supports hold, and their numbers at the nodes
        type(turned_type), allocatable :: turned(:)
        integer, allocatable :: numbers(:, :)
        integer :: i, j, n

        n = size(beam%links)
        limit = audit_allows*epsilon(1.0_wp)
        if (present(measured)) limit = merge(0.0_wp, limit, measured)
        farthest = maxval(abs(answers(:n)%deflection))
        least(:) = -1.0_wp
        if (allocated(beam%turning)) call find_rotations()
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
                if (is_turned()) then
                    call audit_turned(a, r)
                else if (is_restrained(beam%kind(i))) then
                    call audit_restraint(a, r, jump)
                else if (beam%kind(i) == hinge) then
                    call hold(of_equilibrium, moments, max(abs(a%moment_left - r%moment), abs(jump)), abs(r%moment) + abs(r%couple))
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

        !> A node with a restraint, and where there is a hinge beside that
        subroutine audit_restraint(a, r, jump)
            type(answer_type), intent(in) :: a
            type(rhs_type), intent(in) :: r
            !> What of the moment the restraint takes
            real(wp), intent(in) :: jump
            real(wp) :: turn, turn_size

            turn = beam%compliance(i)*jump
            turn_size = beam%compliance(i)*(abs(a%moment_left) + abs(a%moment_right) + abs(r%couple))
            if (takes_left(beam%kind(i)) .and. i > 0) call hold(of_restraints, rotations, before - turn, before_size + turn_size)
            if (takes_right(beam%kind(i)) .and. i < n) call hold(of_restraints, rotations, after - turn, after_size + turn_size)
            if (beam%kind(i) == hinge_left) call hold(of_equilibrium, moments, a%moment_right - r%moment, abs(r%moment))
            if (beam%kind(i) == hinge_right) call hold(of_equilibrium, moments, a%moment_left - r%moment, abs(r%moment))
        end subroutine audit_restraint

        !> Do supports hold a rotation of the node at hand
        pure function is_turned() result(it_is)
            logical :: it_is

            it_is = .false.
            if (allocated(numbers)) it_is = any(numbers(:, i) > 0)
        end function is_turned

        !> Rotations that supports hold, as the driver finds them
        subroutine find_rotations()
            type(node_type) :: nodes(0:last_place(beam))
            type(rhs_type) :: rhs(0:last_place(beam))
            type(answer_type) :: found(0:last_place(beam))
            real(wp), dimension(size(beam%turning)) :: rotation_size, couple, couple_size
            real(wp) :: level(0:last_place(beam))

            nodes(0:n)%kind = beam%kind
            nodes(0:n)%compliance = beam%compliance
            rhs(0:n) = work%loads(0:n)
            level(:) = 0.0_wp
            call apply_turning(beam, closed, [0, n], nodes, rhs, level)
            found(0:n) = answers(0:n)
            call find_turning(beam, nodes, rhs, level, work%loads, work%turn_size, found, rotation_size, couple, couple_size)
            call find_turned(beam, numbers)
            allocate (turned(size(beam%turning)))
            turned%rotation = found(n + 1:)%deflection
            turned%rotation_size = rotation_size + everywhere*farthest*maxval(beam%links%inverse)
            turned%couple_size = couple_size
            turned%left_out = most_left_out/epsilon(1.0_wp)*maxval(work%load_size)*maxval(beam%links%length)
        end subroutine find_rotations

        !> A node whose rotations supports hold
        subroutine audit_turned(a, r)
            type(answer_type), intent(in) :: a
            type(rhs_type), intent(in) :: r
            type(ends_type) :: ends
            real(wp) :: bent

            if (least(forces) < 0.0_wp) call find_least()
            ! Couples that are nothing but rounding, of what holds links straight or of the largest load, may have been left out
            bent = 0.0_wp
            if (i > 0) bent = forced(i)*beam%links(max(i, 1))%length
            if (i < n) bent = bent + forced(i + 1)*beam%links(min(i + 1, n))%length
            ends = ends_type(rotation=[before, after], rotation_size=before_size + after_size + hidden(rotations), &
                             moment=[a%moment_left, a%moment_right], couple=r%couple, &
                             moment_size=abs(a%moment_left) + abs(a%moment_right) + abs(r%couple) + hidden(moments), &
                             is_there=[i > 0, i < n])
            do j = 1, 2
                if (numbers(j, i) == 0) cycle
                associate (rotation => turned(numbers(j, i)))
                    rotation%couple_size = rotation%couple_size + everywhere*bent + least(moments)
                    rotation%left_out = rotation%left_out + most_left_out/epsilon(1.0_wp)*bent
                end associate
            end do
            call audit_rotations(beam, i, numbers(:, i), closed, undecided, leeway, ends, turned, reaction, ledger)
        end subroutine audit_turned

        !> Note what is left over of a sum at node i
        subroutine hold(what, kind, left, terms)
            integer, intent(in) :: what, kind
            real(wp), intent(in) :: left, terms

            if (.not. abs(left) > 0.0_wp) return
            if (least(forces) < 0.0_wp) call find_least()
            call note(ledger, what, kind, left, terms + hidden(kind), i, 0.0_wp)
            if (.not. terms <= huge(terms)) call note(ledger, what, 0, terms, terms, i, 0.0_wp)
        end subroutine hold

        !> Sizes of the terms of a sum at node i that are not seen there
        pure function hidden(kind) result(terms)
            integer, intent(in) :: kind
            real(wp) :: terms, bent(2)

            bent = 0.0_wp
            if (i > 0) bent(1) = forced(i)
            if (i < n) bent(2) = forced(i + 1)
            select case (kind)
            case (forces, pulls)
                terms = everywhere*sum(bent) + size_left_out(sum(bent))
            case (moments)
                terms = everywhere*sum(bent)*beam%links(max(i, 1))%length
            case (rotations)
                terms = everywhere*turned_by()
            case default
                terms = 0.0_wp
            end select
            terms = terms + least(kind)
        end function hidden

        !> What the largest terms of the beam leave everywhere, and those of points that tell lines of laws, which cancel where a
        !> line passes through no force
        subroutine find_least()
            real(wp) :: lines(2), longest

            lines(:) = size_of_lines()
            longest = maxval(beam%links%length)
            most_load = maxval(work%load_size)
            least(:) = 0.0_wp
            least(forces) = everywhere*max(maxval(abs(shear)), maxval(abs(reaction)), most_load, lines(1), &
                                           lines(2)*maxval(beam%links%inverse))
            ! Loads that balance each other on a beam that nothing holds leave as much to rounding
            if (floats) least(forces) = max(least(forces), most_load)
            least(pulls) = least(forces)
            least(moments) = everywhere*max(maxval(abs(answers%moment_left)), maxval(abs(answers%moment_right)), &
                                            lines(1)*longest, lines(2))
            ! Where all deflections cancel, they do so from the levels of the supports that act, and from what the loads could make
            if (any(closed)) least(deflections) = maxval(abs(beam%supports%contact), closed)
            least(deflections) = everywhere*(least(deflections) + most_load/softest(beam))
            least(rotations) = everywhere*(farthest*maxval(beam%links%inverse) + maxval(work%turn_size)) &
                + least(deflections)*maxval(beam%links%inverse)
        end subroutine find_least

        !> Of the points by which lines of laws are known: of forces, and of couples
        pure function size_of_lines() result(found)
            real(wp) :: found(2), force, rounding
            logical :: acts, rigid
            integer :: k, kind

            found(:) = 0.0_wp
            do k = 1, size(beam%supports)
                if (beam%supports(k)%breakpoint == 0) cycle
                call force_by_spring(beam%supports, closed, k, 0.0_wp, 0.0_wp, acts, rigid, force, rounding)
                kind = merge(2, 1, beam%supports(k)%node > n)
                found(kind) = max(found(kind), rounding/epsilon(1.0_wp))
            end do
        end function size_of_lines

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
        pure function turned_by() result(turn)
            real(wp) :: turn

            turn = 0.0_wp
            if (i > 0) turn = beam%links(i)%fbb
            if (i < n) turn = turn + beam%links(i + 1)%faa
            turn = turn*(abs(answers(i)%moment_left) + abs(answers(i)%moment_right) + abs(work%loads(i)%couple))
        end function turned_by

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
