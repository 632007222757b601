!> Audit of the results of a beam on the ground: equilibrium, compatibility, laws.
!>
!> The solution is rounded from quadruple precision, and nothing of how it was found is used here. On every stretch the fields
!> fulfil the equations of the beam, with the loads as given and the pressure that the laws make of the deflection, which adds up
!> to the resultants (gapbeam_stretch_audit); at nodes forces, moments and supports balance, and so does every part between
!> hinges; every layer is on the piece of its law on which it is said to be, and goes on to another one where it is said to.
module gapbeam_ground_audit
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: lost_digits
    use gapbeam_nodes, only: hinge, jointed, hinge_left, hinge_right, is_hinge, is_restrained, takes_left, takes_right
    use gapbeam_element, only: field_type
    use gapbeam_piece, only: piece_load_type, combine_loads, no_load
    use gapbeam_taper, only: softness_at
    use gapbeam_foundation_stretch, only: tension_at
    use gapbeam_foundation_taylor, only: transverse_of
    use gapbeam_law, only: force_by_spring
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_ground_laws, only: contact_line, distance_to_breakpoint, push_of_layer
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_fields, only: field_at_end, force_at_end, find_sizes, breakpoint_terms, pressure_terms
    use gapbeam_ledger, only: ledger_type, note, of_bending, of_equilibrium, of_parts, of_zone_ends, of_contact, of_supports, &
        of_restraints, of_places, deflections, rotations, moments, forces, beyond, pulls
    use gapbeam_stretch_audit, only: sums_type, audit_stretch
    use gapbeam_rotation_audit, only: turned_type, ends_type, find_turned, audit_rotations
    implicit none
    private
    public :: audit_ground

contains

    !> Audit a solved state
    subroutine audit_ground(ground, factor, closed, solution, ledger, residuals)
        !> The beam and its ground, and the load factor
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: factor
        !> States of the supports, and what was found
        logical, intent(in) :: closed(:)
        type(ground_solution_type), intent(in) :: solution
        !> What is left over, and what is wrong
        type(ledger_type), intent(out) :: ledger
        !> The greatest that is left over of sums of compatibility (deflection, rotation), equilibrium (force, moment) and
        !> complementarity (beam beyond the line at which a state ends, support that pulls), relative to the terms of the sum
        real(wp), intent(out) :: residuals(3)
        type(sums_type) :: part, sums
        !> Sizes of the fields in every stretch, and what is nothing there; the same beside the place at hand
        type(field_type) :: sizes_of(size(solution%piece)), least_of(size(solution%piece)), sizes, least
        !> Rounding errors of the reactions, length of the beam, and whether a support may have either state: none may
        real(wp) :: errors(size(closed)), whole
        logical :: undecided(size(closed))
        !> Rotations that supports hold, and their numbers at every node
        type(turned_type), allocatable :: turned(:)
        integer, allocatable :: numbers(:, :)
        integer :: i, j, m

        m = size(solution%piece)
        whole = sum(ground%pieces%length)
        call find_turned(ground%beam, numbers)
        allocate (turned(maxval(numbers)))
        undecided(:) = .false.
        residuals = 0.0_wp
        call audit_places()
        if (ledger%wrong /= 0) return
        do i = 1, m
            call find_sizes(solution, i, sizes_of(i), least_of(i))
            ! The slope of rigid ground is known as well as its levels at the ends
            if (allocated(solution%push)) sizes_of(i)%rotation = sizes_of(i)%rotation &
                + sizes_of(i)%deflection/solution%stretches(i)%length
        end do
        ! Rounding is passed on from stretch to stretch, that of what supports take, or would where their curves bend, too
        associate (s => sizes_of, n => least_of, taken => max(abs(solution%reaction), abs(ground%beam%supports%force)))
            n%deflection = n%deflection + lost_digits*maxval(s%deflection)
            n%rotation = n%rotation + lost_digits*maxval(s%rotation)
            n%moment = maxval(n%moment) + lost_digits*maxval([s%moment, whole*taken])
            n%shear = maxval(n%shear) + lost_digits*maxval([s%shear, s%moment/whole, taken])
        end associate
        i = 1
        do j = 0, size(ground%pieces)
            call audit_node()
            if (j == size(ground%pieces)) exit
            do
                call audit_stretch(ground, factor, solution, i, sizes_of(i), least_of(i), ledger, sums)
                call audit_shears(i)
                associate (length => solution%stretches(i)%length)
                    part%moment = part%moment + length*part%force + sums%moment
                    part%moment_size = part%moment_size + length*part%force_size + sums%moment_size
                end associate
                part%force = part%force + sums%force
                part%force_size = part%force_size + sums%force_size
                i = i + 1
                if (i > m) exit
                if (solution%piece(i) /= j + 1) exit
                call audit_border(i - 1)
                part%force = part%force + push_at(i - 1)
                part%force_size = part%force_size + abs(push_at(i - 1))
            end do
        end do
        associate (e => ledger%excesses)
            residuals = epsilon(1.0_wp)*[maxval(e([deflections, rotations])), maxval(e([forces, moments])), &
                                         maxval(e([beyond, pulls]))]
        end associate

    contains

        !> Do the stretches cover the beam. Places are known to rounding of the length of their piece
        subroutine audit_places()
            real(wp) :: at
            integer :: piece

            at = 0.0_wp
            piece = 1
            do i = 1, m
                if (solution%piece(i) /= piece) then
                    if (i > 1) call ends_at(piece)
                    piece = piece + 1
                    at = 0.0_wp
                end if
                if (solution%piece(i) /= piece) then
                    call note(ledger, of_places, 0, 1.0_wp, 0.0_wp, min(piece, size(ground%pieces)), 0.0_wp)
                    return
                end if
                associate (length => ground%pieces(piece)%length)
                    call note(ledger, of_places, 0, solution%from(i) - at, length, piece, at)
                    at = solution%to(i)
                    call note(ledger, of_places, 0, (at - solution%from(i)) - solution%stretches(i)%length, length, piece, at)
                end associate
                if (.not. solution%stretches(i)%length > 0.0_wp) call note(ledger, of_places, 0, 1.0_wp, 0.0_wp, piece, at)
            end do
            call ends_at(size(ground%pieces))
        end subroutine audit_places

        !> The last stretch of a piece ends where that does
        subroutine ends_at(piece)
            integer, intent(in) :: piece

            associate (length => ground%pieces(piece)%length)
                call note(ledger, of_places, 0, solution%to(i - 1) - length, length, piece, length)
            end associate
        end subroutine ends_at

        !> Forces, moments, rotations, supports and restraint of node j, and of all that acts on its part of the beam left of it
        subroutine audit_node()
            type(field_type) :: a, b
            type(piece_load_type) :: at_left, at_right
            real(wp) :: load, couple, turn, up, up_size, at, terms, before, after
            integer :: piece, s
            logical :: inside

            piece = max(j, 1)
            at = merge(ground%pieces(piece)%length, 0.0_wp, j > 0)
            inside = j > 0 .and. i <= m
            call find_sizes_beside(i)
            a = field_type(solution%deflection(j), 0.0_wp, 0.0_wp, 0.0_wp)
            b = a
            before = 0.0_wp
            after = 0.0_wp
            if (j > 0) a = field_at_end(solution, i - 1, 2)
            if (j > 0) before = force_at_end(solution, i - 1, 2)
            if (i <= m) b = field_at_end(solution, i, 1)
            if (i <= m) after = force_at_end(solution, i, 1)
            ! What is imposed beside the node is between the ends of the pieces and the node
            at_left = no_load
            at_right = no_load
            if (j > 0) at_left = combine_loads(ground%dead(j), ground%live(j), factor)
            if (i <= m) at_right = combine_loads(ground%dead(j + 1), ground%live(j + 1), factor)
            a%rotation = a%rotation + at_left%kink_b
            b%rotation = b%rotation - at_right%kink_a
            a%moment = a%moment + at_left%couple_b
            b%moment = b%moment - at_right%couple_a
            call pass_couple(at_left%couple_b)
            associate (w => solution%deflection(j), left => solution%moment_left(j), right => solution%moment_right(j), &
                       beam => ground%beam)
                call fits(of_bending, deflections, a%deflection - w, sizes%deflection)
                call fits(of_bending, deflections, b%deflection - w, sizes%deflection)
                call fits(of_equilibrium, moments, a%moment - left, sizes%moment)
                call fits(of_equilibrium, moments, b%moment - right, sizes%moment)
                load = beam%force(1, j) + factor*beam%force(2, j)
                couple = beam%couple(1, j) + factor*beam%couple(2, j)
                up = push_at(i - 1)
                call audit_push(i - 1, piece, at, w)
                up_size = abs(up) + abs(beam%force(1, j)) + abs(factor*beam%force(2, j))
                do s = beam%first(j), beam%first(j + 1) - 1
                    associate (k => beam%order(s))
                        up = up + solution%reaction(k)
                        up_size = up_size + abs(solution%reaction(k))
                        errors(k) = epsilon(1.0_wp)*(sizes%shear + abs(load) + abs(solution%reaction(k)))
                    end associate
                end do
                do s = beam%first(j), beam%first(j + 1) - 1
                    call audit_support(beam%order(s))
                end do
                call fits(of_equilibrium, forces, (after - before) - (up - load), sizes%shear + up_size)
                terms = sizes%moment + abs(left) + abs(right) + abs(beam%couple(1, j)) + abs(factor*beam%couple(2, j)) &
                    + abs(at_left%couple_b) + abs(at_right%couple_a)
                sizes%rotation = sizes%rotation + abs(at_left%kink_b) + abs(at_right%kink_a)
                if (beam%kind(j) == hinge_left) call fits(of_equilibrium, moments, right, terms)
                if (beam%kind(j) == hinge_right) call fits(of_equilibrium, moments, left, terms)
                if (any(numbers(:, j) > 0)) then
                    call audit_turned(a%rotation, b%rotation, left, right, couple, terms)
                else if (is_restrained(beam%kind(j))) then
                    turn = beam%compliance(j)*((left - right) + couple)
                    terms = sizes%rotation + beam%compliance(j)*terms
                    if (takes_left(beam%kind(j)) .and. j > 0) call fits(of_restraints, rotations, a%rotation - turn, terms)
                    if (takes_right(beam%kind(j)) .and. i <= m) call fits(of_restraints, rotations, b%rotation - turn, terms)
                else if (beam%kind(j) == hinge) then
                    call fits(of_equilibrium, moments, max(abs(left), abs(right - left - couple)), terms)
                else
                    call fits(of_equilibrium, moments, (right - left) - couple, terms)
                    ! A joint lets the beam turn by what its moment makes of its compliance, another node by nothing
                    turn = 0.0_wp
                    if (beam%kind(j) == jointed) turn = -beam%compliance(j)*left
                    if (inside) call fits(of_bending, rotations, b%rotation - a%rotation - turn, sizes%rotation + abs(turn))
                end if
                if (j > 0) then
                    ! Under couples alone there is no force but what moments leave by rounding
                    call fits(of_parts, forces, part%force - before, part%force_size + sizes%shear + part%moment_size/whole)
                    call fits(of_parts, moments, part%moment - left, part%moment_size + sizes%moment)
                end if
                if (is_hinge(beam%kind(j))) then
                    part = sums_type(after, right, max(abs(after), sizes%shear), abs(right))
                else
                    part = sums_type(part%force + (up - load), part%moment + (right - left), part%force_size + up_size, &
                                     part%moment_size + abs(left) + abs(right))
                end if
                call pass_couple(at_right%couple_a)
            end associate
        end subroutine audit_node

        !> Rotations of node j that supports hold
        subroutine audit_turned(turn_left, turn_right, left, right, couple, terms)
            !> Rotations and moments beside the node, the couple there, and the sizes of moments
            real(wp), intent(in) :: turn_left, turn_right, left, right, couple, terms
            integer :: k, r

            do k = 1, 2
                r = numbers(k, j)
                if (r == 0) cycle
                associate (rotation => solution%deflection(size(ground%beam%links) + r))
                    turned(r) = turned_type(rotation, abs(rotation), terms + least%moment, 0.0_wp)
                end associate
            end do
            call audit_rotations(ground%beam, j, numbers(:, j), closed, undecided, 1.0_wp, &
                                 ends_type([turn_left, turn_right], sizes%rotation + least%rotation, [left, right], couple, &
                                           terms + least%moment, [j > 0, i <= m]), turned, solution%reaction, ledger)
        end subroutine audit_turned

        !> A couple just inside the end of a piece acts on the part
        subroutine pass_couple(couple)
            real(wp), intent(in) :: couple

            part%moment = part%moment + couple
            part%moment_size = part%moment_size + abs(couple)
        end subroutine pass_couple

        !> Note what is left over at node j
        subroutine fits(what, kind, left_over, sizes)
            integer, intent(in) :: what, kind
            real(wp), intent(in) :: left_over, sizes

            call note(ledger, what, kind, left_over, sizes, max(j, 1), merge(ground%pieces(max(j, 1))%length, 0.0_wp, j > 0))
        end subroutine fits

        !> Is a support at node j on its law, in the right state
        subroutine audit_support(k)
            integer, intent(in) :: k
            real(wp) :: force, rounding, margin
            logical :: acts, rigid, by_force

            associate (supports => ground%beam%supports, r => solution%reaction(k), w => solution%deflection(j))
                call force_by_spring(supports, closed, k, w, abs(w), acts, rigid, force, rounding)
                if (rigid) then
                    call fits(of_supports, deflections, w - supports(k)%contact, abs(supports(k)%contact) + least%deflection)
                else
                    call fits(of_supports, forces, r - force, rounding/epsilon(1.0_wp) + abs(r) + least%shear)
                end if
                if (.not. is_watched_in(supports, closed, k)) return
                errors(k) = errors(k) + rounding
                call margin_in_scheme(supports, closed, k, w, abs(w), solution%reaction, errors, margin, rounding, by_force)
                if (margin < 0.0_wp) call fits(of_supports, merge(pulls, beyond, by_force), margin, &
                                             rounding/epsilon(1.0_wp) + merge(least%shear, least%deflection, by_force))
            end associate
        end subroutine audit_support

        !> Shears and rotations at the ends of a stretch make the transverse forces, which everything else is balanced with
        subroutine audit_shears(i)
            integer, intent(in) :: i
            type(field_type) :: at_end
            integer :: side

            do side = 1, 2
                at_end = field_at_end(solution, i, side)
                call note(ledger, of_equilibrium, forces, &
                          transverse_of(solution%stretches(i), real(side - 1, wp), at_end%rotation, at_end%shear) &
                          - force_at_end(solution, i, side), &
                          sizes_of(i)%shear + least_of(i)%shear &
                          + abs(tension_at(solution%stretches(i), real(side - 1, wp))*at_end%rotation), &
                          solution%piece(i), merge(solution%from(i), solution%to(i), side == 1))
            end do
        end subroutine audit_shears

        !> Between two stretches of a piece nothing jumps, and zones of ground end there, without a jump of their pressure
        subroutine audit_border(i)
            !> The stretch left of it
            integer, intent(in) :: i
            type(field_type) :: a, b
            real(wp) :: past, change, push(2), length, terms, steepness, incline, soft(2)
            integer :: k, breakpoint

            a = field_at_end(solution, i, 2)
            b = field_at_end(solution, i + 1, 1)
            call find_sizes_beside(i + 1)
            associate (piece => solution%piece(i), at => solution%to(i), before => solution%acts(:, i), &
                       after => solution%acts(:, i + 1))
                length = ground%pieces(piece)%length
                call note(ledger, of_bending, deflections, b%deflection - a%deflection, sizes%deflection, piece, at)
                call note(ledger, of_bending, rotations, b%rotation - a%rotation, sizes%rotation, piece, at)
                call note(ledger, of_equilibrium, moments, b%moment - a%moment, sizes%moment, piece, at)
                call note(ledger, of_equilibrium, forces, (force_at_end(solution, i + 1, 1) - force_at_end(solution, i, 2)) &
                          - push_at(i), sizes%shear, piece, at)
                call audit_push(i, piece, at, a%deflection)
                soft(:) = softness_at(ground%pieces(piece), at)
                incline = a%rotation + soft(2)*a%shear
                do k = 1, ground%first(piece + 1) - ground%first(piece)
                    if (before(k) == after(k) .or. ground%layers(ground%first(piece) + k - 1)%rigid) cycle
                    associate (layer => ground%layers(ground%first(piece) + k - 1))
                        do breakpoint = min(before(k), after(k)) + 1, max(before(k), after(k))
                            call distance_to_breakpoint(ground%laws, layer, breakpoint, a%deflection, incline, at, length, past, &
                                                        change)
                            call breakpoint_terms(layer, ground%laws, breakpoint, sizes%deflection, steepness, terms)
                            terms = terms + length*abs(change)
                            if (.not. steepness > 0.0_wp) steepness = 1.0_wp
                            call note(ledger, of_zone_ends, beyond, past/steepness, terms/steepness, piece, at)
                        end do
                        push(1) = push_of_layer(layer, ground%laws, before(k), at, length, a%deflection)
                        push(2) = push_of_layer(layer, ground%laws, after(k), at, length, a%deflection)
                        terms = sizes%deflection + length*abs(incline) + abs(layer%contact_b - layer%contact_a)
                        call note(ledger, of_zone_ends, 0, push(2) - push(1), &
                                  max(pressure_terms(layer, ground%laws, before(k), terms), &
                                      pressure_terms(layer, ground%laws, after(k), terms)), piece, at)
                    end associate
                end do
            end associate
        end subroutine audit_border

        !> Point force of rigid ground where two stretches meet, up
        pure function push_at(border) result(push)
            !> Number of the stretch left of it, 0: left end of the beam
            integer, intent(in) :: border
            real(wp) :: push

            push = 0.0_wp
            if (allocated(solution%push)) push = solution%push(border)
        end function push_at

        !> Rigid ground pushes where the beam touches it, and does not pull
        subroutine audit_push(border, piece, at, w)
            integer, intent(in) :: border, piece
            !> Distance from the left end of the piece, and deflection
            real(wp), intent(in) :: at, w
            real(wp) :: level
            integer :: k

            if (.not. abs(push_at(border)) > 0.0_wp) return
            k = solution%pushing(border)
            ! Of the piece, or at the left end of the next one
            level = ground%layers(k)%contact_a
            if (k >= ground%first(piece) .and. k < ground%first(piece + 1)) level = contact_line(ground%layers(k), at, &
                                                                                                ground%pieces(piece)%length)
            call note(ledger, of_zone_ends, deflections, w - level, abs(level) + sizes%deflection, piece, at)
            if (ground%layers(k)%side*push_at(border) < 0.0_wp) then
                ! Beside shears that are there: in a stretch that is short without end all is nothing
                call note(ledger, of_contact, pulls, push_at(border), maxval(abs(solution%shear)), piece, at)
            end if
        end subroutine audit_push

        !> Sizes of the fields beside the left end of a stretch
        subroutine find_sizes_beside(stretch)
            integer, intent(in) :: stretch
            integer :: left, right

            left = max(stretch - 1, 1)
            right = min(stretch, m)
            least = larger(least_of(left), least_of(right))
            sizes = larger(sizes_of(left), sizes_of(right))
            sizes = field_type(sizes%deflection + least%deflection, sizes%rotation + least%rotation, &
                               sizes%moment + least%moment, sizes%shear + least%shear)
        end subroutine find_sizes_beside

    end subroutine audit_ground

    !> The larger one of each field
    pure function larger(one, other) result(found)
        type(field_type), intent(in) :: one, other
        type(field_type) :: found

        found = field_type(max(one%deflection, other%deflection), max(one%rotation, other%rotation), &
                           max(one%moment, other%moment), max(one%shear, other%shear))
    end function larger

end module gapbeam_ground_audit
