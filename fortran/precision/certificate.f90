!> Certificate of a result: residuals, and error bounds by the solution in quadruple precision.
!>
!> That solution starts from the numbers of the pieces, so what condensing, solving, and going back into the links have
!> cost is all in the comparison. Its own error is some 1e-33 of the sizes of the terms, below all that doubles can show. What
!> the data lost when they were rounded to doubles comes on top (gapbeam_sensitivity). Where fields are evaluated inside a
!> piece, the rounding of their polynomials is bounded term by term (Higham 2002, 5.1).
module gapbeam_certificate
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: unit => rounding_unit, movement_safety, fine_error, upward
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, piece_load_type
    use gapbeam_piece, only: greatest_softness
    use gapbeam_law, only: has_laws
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: plain_workspace_type => workspace_type, new_plain_workspace => new_workspace, &
        set_plain_loads => set_loads, apply_scheme
    use gapbeam_sensitivity, only: sensitivity_type, prepare_sensitivity, add_forces, largest_movement
    use gapbeam_functionals, only: of_deflections, of_rotations, of_moments, of_shears, of_reactions
    use gapbeam_kinematics_quad, only: held_by_ties
    use gapbeam_refined, only: detail_type, refine_loaded_beam, fine_piece, fine_load
    use gapbeam_undecided, only: find_undecided
    use gapbeam_ledger, only: ledger_type
    use gapbeam_audit, only: audit_beam, audit_residuals
    use gapbeam_element_quad, only: fine_field_type => field_type
    use gapbeam_model_quad, only: fine_beam_type => beam_type
    use gapbeam_workspace_quad, only: fine_workspace_type => workspace_type
    use gapbeam_band_quad, only: band_ok
    use gapbeam_system_quad, only: solve_and_refine
    use gapbeam_search_quad, only: rule_block
    use gapbeam_contact_state_quad, only: find_contact_state, outcome_type
    use gapbeam_recover_quad, only: recover_beam
    implicit none
    private
    public :: certificate_type, certify

    !> The certificate of a state
    type :: certificate_type
        !> Largest relative residuals, and the largest wrong-signed reaction or opening, relative to the largest of its kind
        real(wp) :: compatibility = 0.0_wp, equilibrium = 0.0_wp, complementarity = 0.0_wp
        !> Largest errors of the deflections of the nodes and of the reactions, and of the fields along the beam
        real(wp) :: of_nodes = 0.0_wp, reaction = 0.0_wp
        real(wp) :: deflection = 0.0_wp, rotation = 0.0_wp, moment = 0.0_wp, shear = 0.0_wp
        !> Is the position known; if the beam is free to move, deflections and rotations have no bound
        logical :: known = .false.
    end type certificate_type

    real(wp), parameter :: infinity = transfer(int(z"7FF0000000000000", int64), 1.0_wp)
    !> Of a state that quadruple precision does not confirm
    type(certificate_type), parameter :: not_confirmed = certificate_type( &
        infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity, .false.)

contains

    !> Check a solved state
    subroutine certify(beam, detail, factor, closed, deflection, moment_left, moment_right, reaction, starts, length_error, &
                       certificate, error)
        !> The beam, and what its links are made of
        type(beam_type), intent(in) :: beam
        type(detail_type), intent(in) :: detail
        !> Factor of the live loads, and the scheme
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> The result: at the nodes, shape (0:n), of the supports, and at the left ends of the pieces
        real(wp), intent(in) :: deflection(0:), moment_left(0:), moment_right(0:), reaction(:)
        type(field_type), intent(in) :: starts(:)
        !> What the lengths of links may be off, relative to them, shape (n)
        real(wp), intent(in) :: length_error(:)
        !> How good it is; bounds and residuals infinite where quadruple precision does not confirm the state
        type(certificate_type), intent(out) :: certificate
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        type(fine_beam_type) :: fine
        type(fine_workspace_type) :: work
        type(outcome_type) :: outcome
        real(wp) :: springs
        logical, allocatable :: acting(:), undecided(:), pushes(:)
        real(qp), allocatable :: moment_size(:)
        real(wp) :: moves(5), inside
        integer :: state, place, n

        n = size(beam%links)
        allocate (acting, source=closed)
        call refine_loaded_beam(beam, detail, real(factor, qp), fine, work)
        if (has_laws(beam%supports)) then
            ! Of several states the one that is asked about
            call solve_and_refine(fine, acting, work, state, place)
            if (state /= band_ok) certificate = not_confirmed
            if (state /= band_ok) return
        else
            call find_contact_state(fine, real(factor, qp), rule_block, acting, work, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) certificate = not_confirmed
            if (outcome%status /= gapbeam_solved) return
        end if
        allocate (undecided(size(closed)))
        call find_undecided(fine, real(factor, qp), acting, work, undecided)
        certificate%known = .not. outcome%indifferent
        if (certificate%known) certificate%known = .not. held_by_ties(fine, acting, undecided)
        call find_movements(beam, factor, closed, work, deflection, moment_left, moment_right, length_error, moves, inside)
        call compare_fields(detail, factor, fine, work, starts, certificate)
        associate (a => work%answers)
            moment_size = work%shear_size(:n)*maxval(fine%links%length)
            certificate%of_nodes = difference(a(:n)%deflection, deflection(:n), work%deflection_size(:n)) &
                + epsilon(1.0_wp)*maxval(abs(deflection(:n))) + moves(of_deflections)
            ! Couples are bounded by the moments beside them
            pushes = beam%supports%node <= n
            if (any(pushes)) certificate%reaction = difference(pack(work%reaction, pushes), pack(reaction, pushes), &
                                                               work%shear_size(:n)) &
                + epsilon(1.0_wp)*maxval(abs(reaction), pushes) + moves(of_reactions)
            certificate%deflection = max(certificate%deflection + inside, certificate%of_nodes)
            certificate%moment = max(certificate%moment, difference(a(:n)%moment_left, moment_left, moment_size), &
                                     difference(a(:n)%moment_right, moment_right, moment_size))
            certificate%rotation = certificate%rotation + moves(of_rotations)
            certificate%moment = certificate%moment + moves(of_moments)
            ! Weak springs of a beam that is free to move are a load that it does not have
            springs = movement_safety*real(sum(work%proximal_weight*abs(work%reference - a(:n)%deflection)), wp)
            certificate%reaction = certificate%reaction + springs
            certificate%moment = certificate%moment + springs*real(sum(fine%links%length), wp)
            certificate%shear = certificate%shear + springs + moves(of_shears) + real(fine_error*maxval(work%shear_size(:n)), wp)
        end associate
        call measure_residuals(beam, factor, closed, undecided, deflection, moment_left, moment_right, reaction, certificate)
        if (certificate%known) return
        certificate%of_nodes = 0.0_wp
        certificate%deflection = 0.0_wp
        certificate%rotation = 0.0_wp
    end subroutine certify

    !> The residuals of the audit: those of the numbers as they are given
    subroutine measure_residuals(beam, factor, closed, undecided, deflection, moment_left, moment_right, reaction, certificate)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:), undecided(:)
        real(wp), intent(in) :: deflection(0:), moment_left(0:), moment_right(0:), reaction(:)
        type(certificate_type), intent(inout) :: certificate
        type(plain_workspace_type) :: work
        type(ledger_type) :: ledger
        real(wp) :: residuals(3)
        integer :: n

        n = size(beam%links)
        call new_plain_workspace(beam, work)
        call set_plain_loads(beam, factor, work)
        work%answers(:n)%deflection = deflection(:n)
        work%answers(:n)%moment_left = moment_left
        work%answers(:n)%moment_right = moment_right
        call audit_beam(beam, closed, undecided, .not. certificate%known, 1.0_wp, work%answers, &
                        (moment_left(1:) - moment_right(:n - 1))*beam%links%inverse, reaction, work, ledger, measured=.true.)
        residuals = audit_residuals(ledger)
        certificate%compatibility = residuals(1)
        certificate%equilibrium = residuals(2)
        certificate%complementarity = residuals(3)
    end subroutine measure_residuals

    !> By how much results move when the data change in their last digits, and the forces by what quadruple precision rounds
    subroutine find_movements(beam, factor, closed, fine_work, deflection, moment_left, moment_right, length_error, moves, inside)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        !> Solved in quadruple precision
        type(fine_workspace_type), intent(in) :: fine_work
        real(wp), intent(in) :: deflection(0:), moment_left(0:), moment_right(0:)
        !> As for certify
        real(wp), intent(in) :: length_error(:)
        !> Deflections of the nodes, rotations, moments, shears, reactions; deflections between the nodes
        real(wp), intent(out) :: moves(5), inside
        type(plain_workspace_type) :: work
        type(sensitivity_type) :: sensitivity
        real(wp), allocatable :: off(:)
        real(wp) :: turns, bends, of_shear, of_reaction
        integer :: kind, i, n

        n = size(beam%links)
        moves(:) = 0.0_wp
        inside = 0.0_wp
        call new_plain_workspace(beam, work)
        work%proximal_weight(:) = real(fine_work%proximal_weight, wp)
        work%reference(:) = deflection(:n)
        call set_plain_loads(beam, factor, work)
        call apply_scheme(beam, closed, [0, n], work)
        work%answers(:n)%deflection = deflection(:n)
        work%answers(:n)%moment_left = moment_left
        work%answers(:n)%moment_right = moment_right
        call prepare_sensitivity(beam, factor, work, sensitivity)
        if (.not. sensitivity%known) return
        call add_lengths(beam, factor, length_error, work, sensitivity, of_shear, of_reaction)
        if (any(abs(deflection) > 0.0_wp)) call add_forces(work, real(fine_error*maxval(fine_work%shear_size(:n)), wp), sensitivity)
        do kind = 1, size(moves)
            call largest_movement(beam, sensitivity, kind, work, moves(kind))
        end do
        moves(:) = movement_safety*moves
        moves(of_shears) = moves(of_shears) + of_shear
        moves(of_reactions) = moves(of_reactions) + of_reaction
        ! Between the nodes: what the ends of a link do to it, and its own loads
        off = epsilon(1.0_wp) + length_error
        turns = 0.0_wp
        bends = 0.0_wp
        do i = 1, size(beam%links)
            associate (link => beam%links(i), soft => max(beam%links(i)%bending, beam%links(i)%faa + beam%links(i)%fbb), &
                       load => off(i)*(beam%links(i)%load_sum(1) + abs(factor)*beam%links(i)%load_sum(2)), &
                       turn => off(i)*(beam%links(i)%turn_sum(1) + abs(factor)*beam%links(i)%turn_sum(2)))
                inside = max(inside, link%length*(soft*moves(of_moments)/4 + turn))
                turns = max(turns, soft*moves(of_moments)/2 + turn)
                bends = max(bends, load*link%length/2)
                moves(of_shears) = max(moves(of_shears), load)
            end associate
        end do
        inside = moves(of_deflections) + inside
        moves(of_rotations) = moves(of_rotations) + turns
        moves(of_moments) = moves(of_moments) + bends
    end subroutine find_movements

    !> What lengths are off goes into the rows of their links; and what lengths and loads are off goes into shears, and into the
    !> forces of springs, which loads and shears leave over, directly as well
    pure subroutine add_lengths(beam, factor, length_error, work, sensitivity, of_shear, of_reaction)
        type(beam_type), intent(in) :: beam
        real(wp), intent(in) :: factor
        !> As for certify
        real(wp), intent(in) :: length_error(:)
        !> With its answers
        type(plain_workspace_type), intent(in) :: work
        type(sensitivity_type), intent(inout) :: sensitivity
        !> The most that shears and reactions are off directly
        real(wp), intent(out) :: of_shear, of_reaction
        real(wp), allocatable :: error(:), rounding(:)
        real(wp) :: shear, load, turn, share(2)
        integer :: i, n

        n = size(beam%links)
        share = [1.0_wp, abs(factor)]
        allocate (error(0:n), rounding(0:n))
        error(:) = 0.0_wp
        rounding(:) = matmul(share, abs(beam%force))
        of_shear = 0.0_wp
        do i = 1, n
            associate (link => beam%links(i), a => work%answers(i - 1), b => work%answers(i), w => sensitivity%weight)
                shear = abs(b%moment_left - a%moment_right)*link%inverse
                load = dot_product(share, link%load_sum)
                of_shear = max(of_shear, (epsilon(1.0_wp) + length_error(i))*shear)
                rounding(i - 1:i) = rounding(i - 1:i) + shear + load
                if (.not. length_error(i) > 0.0_wp) cycle
                error(i - 1:i) = error(i - 1:i) + length_error(i)*(shear + load)
                turn = length_error(i)*(abs(b%deflection - a%deflection)*link%inverse &
                                        + (link%faa + abs(link%fab))*abs(a%moment_right) &
                                        + (link%fbb + abs(link%fab))*abs(b%moment_left) + dot_product(share, link%turn_sum))
                ! Rows without compatibility have no term of it
                if (w(2, i - 1) > 0.0_wp) w(2, i - 1) = w(2, i - 1) + turn
                if (w(1, i) > 0.0_wp) then
                    w(1, i) = w(1, i) + turn
                else if (w(2, i) > 0.0_wp) then
                    w(2, i) = w(2, i) + turn
                end if
                where (.not. work%nodes(i - 1:i)%held) w(3, i - 1:i) = w(3, i - 1:i) + length_error(i)*(shear + load)
            end associate
        end do
        of_reaction = 0.0_wp
        do i = 1, size(beam%supports)
            if (beam%supports(i)%node > n) cycle
            associate (k => beam%supports(i)%node)
                of_reaction = max(of_reaction, error(k) + epsilon(1.0_wp)*merge(0.0_wp, rounding(k), work%nodes(k)%held))
            end associate
        end do
    end subroutine add_lengths

    !> Largest difference, rounded up; or, if there is anything but zeros, the error of the solution in quadruple precision
    pure function difference(fine, rounded, sizes) result(largest)
        real(qp), intent(in) :: fine(:)
        real(wp), intent(in) :: rounded(:)
        !> Of the terms of that solution
        real(qp), intent(in) :: sizes(:)
        real(wp) :: largest
        real(qp) :: apart

        apart = maxval(abs(fine - rounded))
        largest = 0.0_wp
        if (any(abs(rounded) > 0.0_wp) .or. apart > fine_error*maxval(sizes)) then
            largest = real(max(apart, fine_error*maxval(sizes))*upward, wp)
        end if
    end function difference

    !> Errors of the fields along the beam
    subroutine compare_fields(detail, factor, fine, work, starts, certificate)
        type(detail_type), intent(in) :: detail
        real(wp), intent(in) :: factor
        type(fine_beam_type), intent(in) :: fine
        type(fine_workspace_type), intent(in) :: work
        type(field_type), intent(in) :: starts(:)
        type(certificate_type), intent(inout) :: certificate
        type(fine_field_type), allocatable :: fields(:)
        type(field_type) :: change
        integer :: j, n

        n = size(fine%links)
        allocate (fields(size(starts)))
        associate (a => work%answers)
            call recover_beam(fine_piece(detail%pieces), fine_load(detail%dead), fine_load(detail%live), real(factor, qp), &
                              fine%links, detail%last, fine%kind, a(:n)%deflection, a(:n)%moment_left, a(:n)%moment_right, &
                              work%shear, fields)
        end associate
        do j = 1, size(starts)
            associate (f => fields(j), s => starts(j))
                change = field_type(apart(f%deflection, s%deflection), apart(f%rotation, s%rotation), &
                                    apart(f%moment, s%moment), apart(f%shear, s%shear))
            end associate
            call add_piece(detail%pieces(j), detail%dead(j), detail%live(j), abs(factor), starts(j), change, certificate)
        end do
    end subroutine compare_fields

    !> Distance of a number from what it was rounded to
    elemental function apart(fine, rounded) result(distance)
        real(qp), intent(in) :: fine
        real(wp), intent(in) :: rounded
        real(wp) :: distance

        distance = real(abs(fine - rounded)*upward, wp)
    end function apart

    !> Errors of the fields inside a piece: those at its left end, carried on, and the rounding of every term
    pure subroutine add_piece(piece, dead, live, factor, start, change, certificate)
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: dead, live
        !> Size of the factor of the live loads
        real(wp), intent(in) :: factor
        !> Fields at the left end, and their errors
        type(field_type), intent(in) :: start, change
        type(certificate_type), intent(inout) :: certificate
        type(field_type) :: error
        real(wp) :: q, kappa, softest(2)

        q = max(abs(dead%qa) + factor*abs(live%qa), abs(dead%qb) + factor*abs(live%qb))
        kappa = abs(dead%kappa) + abs(dead%rise) + factor*(abs(live%kappa) + abs(live%rise))
        ! Each error, and what rounds: the absolute values of the fields
        error = field_type(change%deflection + unit*abs(start%deflection), change%rotation + unit*abs(start%rotation), &
                           change%moment + unit*abs(start%moment), change%shear + unit*abs(start%shear))
        softest = greatest_softness(piece)
        associate (l => piece%length, f => softest(1), g => softest(2))
            certificate%shear = max(certificate%shear, error%shear + unit*l*q)
            certificate%moment = max(certificate%moment, error%moment + l*(error%shear + unit*l*q/2))
            certificate%rotation = max(certificate%rotation, error%rotation &
                                       + l*(unit*kappa + f*(error%moment + l*(error%shear/2 + unit*l*q/6))))
            certificate%deflection = max(certificate%deflection, error%deflection + l*(error%rotation &
                                         + l*(unit*kappa/2 + f*(error%moment/2 + l*(error%shear/6 + unit*l*q/24)))) &
                                         + g*l*(error%shear + unit*l*q/2))
        end associate
    end subroutine add_piece

end module gapbeam_certificate
