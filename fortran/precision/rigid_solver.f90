!> Solver of a beam on rigid ground: contacts on a mesh, moved in double and then in quadruple precision.
!>
!> The energy is convex and the ground a convex set of deflections, so contacts at which all conditions hold are the right ones,
!> however they were found.
module gapbeam_rigid_solver
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_rigid_meshes
    use gapbeam_tolerances, only: rigid_places, fine_rigid_places
    use gapbeam_error, only: error_type, fatal_error, has_ended, gapbeam_solved, gapbeam_not_converged
    use gapbeam_law, only: both
    use gapbeam_workspace, only: workspace_type
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_ground, only: ground_type, grounded_type
    use gapbeam_rigid_contact, only: contact_type
    use gapbeam_rigid_state, only: rigid_type
    use gapbeam_rigid_ground, only: settle_contacts
    use gapbeam_rigid_search, only: touch_on_mesh
    use gapbeam_contact_state_quad, only: fine_outcome_type => outcome_type
    use gapbeam_kinematics_quad, only: held_by_ties
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_rigid_contact_quad, only: fine_contact_type => contact_type, layer_beyond
    use gapbeam_rigid_state_quad, only: fine_rigid_type => rigid_type, is_zone, load_at, straightened
    use gapbeam_rigid_ground_quad, only: settle_fine_contacts => settle_contacts
    use gapbeam_ground_solution, only: ground_solution_type, take_rounded
    implicit none
    private
    public :: solve_on_rigid_ground

    !> Share of its piece within which a place is beside a node: of a couple there would be forces of more than the inverse of it
    real(qp), parameter :: least_lever = 2.0_qp**(-30)

contains

    !> Solve at a load factor
    subroutine solve_on_rigid_ground(ground, fine, factor, rule, closed, grounded, work, solution, outcome, error)
        !> The beam and its ground, all of it rigid; the same in quadruple precision
        type(ground_type), intent(in) :: ground
        type(fine_ground_type), intent(in) :: fine
        !> Factor of the live loads, and rule for the supports
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> States of the supports: start in, found out
        logical, intent(inout) :: closed(:)
        !> The beam held at its contacts, and its solution, in double precision
        type(grounded_type), intent(out) :: grounded
        type(workspace_type), intent(out) :: work
        !> What was found
        type(ground_solution_type), intent(out) :: solution
        !> Solved, or no equilibrium with the motion of the nodes
        type(outcome_type), intent(out) :: outcome
        !> Not settled, no memory
        type(error_type), allocatable, intent(out) :: error
        type(rigid_type) :: rigid
        type(contact_type), allocatable :: contacts(:)
        type(fine_ground_type) :: straight
        type(fine_rigid_type) :: fine_rigid
        type(fine_outcome_type) :: found
        logical :: start(size(closed)), settled
        integer :: mesh

        start(:) = closed
        call straighten(fine, straight)
        do mesh = 0, most_rigid_meshes - 1
            closed(:) = start
            call touch_on_mesh(ground, factor, rule, 4**mesh, closed, contacts, rigid%solves, outcome, error)
            solution%solves = rigid%solves
            if (allocated(error) .or. outcome%status /= gapbeam_solved) return
            rigid%contacts = contacts
            call settle_contacts(ground, factor, rule, rigid_places, rigid, closed, outcome, settled, error)
            if (has_ended(error)) return
            if (allocated(error)) cycle
            if (.not. settled .or. outcome%status /= gapbeam_solved) cycle
            call refine_contacts(straight, rigid, fine_rigid)
            call settle_fine_contacts(straight, real(factor, qp), rule, fine_rigid_places, fine_rigid, closed, found, settled, &
                                      error)
            if (has_ended(error)) return
            if (allocated(error)) cycle
            if (.not. settled .or. found%status /= gapbeam_solved) cycle
            if (any(without_lever(straight, fine_rigid%contacts))) cycle
            solution%solves = rigid%solves + fine_rigid%solves
            outcome = outcome_type(indifferent=found%indifferent)
            if (.not. found%indifferent) outcome%indifferent = may_leave(fine_rigid, closed)
            call take_solution(straight, real(factor, qp), fine_rigid, closed, solution)
            grounded = rigid%grounded
            work = rigid%work
            return
        end do
        call fatal_error(error, gapbeam_not_converged, "where the beam touches the rigid ground could not be settled: look for "// &
                         "loads or supports that press it against a corner of the ground or hold it where it turns into the "// &
                         "ground, or give the ground a stiffness k")
    end subroutine solve_on_rigid_ground

    !> May the beam move off all that touches it without force
    function may_leave(rigid, closed) result(it_may)
        type(fine_rigid_type), intent(in) :: rigid
        !> States of the supports, behind which those of the ground are
        logical, intent(in) :: closed(:)
        logical :: it_may
        logical, allocatable :: acting(:), idle(:)

        associate (beam => rigid%grounded%beam, work => rigid%work)
            allocate (acting(size(beam%supports)), source=.true.)
            acting(:size(closed)) = closed
            idle = abs(work%answers(beam%supports%node)%deflection - beam%supports%contact) <= rigid%noise%deflection
            idle = beam%supports%side /= both .and. merge(abs(work%reaction) <= rigid%noise%force, idle, acting)
            it_may = held_by_ties(beam, acting, idle)
        end associate
    end function may_leave

    !> Does a beam that is held where it would turn into the ground touch that beside the place: no force does without a lever
    elemental function without_lever(fine, contact) result(it_is)
        type(fine_ground_type), intent(in) :: fine
        type(fine_contact_type), intent(in) :: contact
        logical :: it_is
        real(qp) :: lever

        associate (length => fine%pieces(contact%piece)%length)
            lever = min(contact%from, length - contact%to)
            it_is = lever > 0.0_qp .and. lever < least_lever*length .and. contact%to - contact%from < least_lever*length
        end associate
    end function without_lever

    !> Ground that is straight but for the rounding of its levels at nodes, which a stiff beam would feel, made straight
    subroutine straighten(fine, straight)
        type(fine_ground_type), intent(in) :: fine
        type(fine_ground_type), intent(out) :: straight
        real(qp) :: length, share, ends(2)
        integer :: line(size(fine%pieces)), j, k, i, m, next

        straight = fine
        do j = 1, size(fine%pieces)
            do k = fine%first(j), fine%first(j + 1) - 1
                ! Only where a line begins
                if (layer_beyond(fine, j, k, j - 1) > 0) cycle
                m = 1
                line(1) = k
                do
                    next = layer_beyond(fine, j + m - 1, line(m), j + m)
                    if (next == 0) exit
                    m = m + 1
                    line(m) = next
                end do
                length = sum(fine%pieces(j:j + m - 1)%length)
                ends = [fine%layers(k)%contact_a, fine%layers(line(m))%contact_b]
                share = 0.0_qp
                do i = 1, m - 1
                    share = share + fine%pieces(j + i - 1)%length/length
                    straight%layers(line(i))%contact_b = ends(1) + share*(ends(2) - ends(1))
                    straight%layers(line(i + 1))%contact_a = straight%layers(line(i))%contact_b
                end do
            end do
        end do
    end subroutine straighten

    !> Contacts in quadruple precision: what ends with a piece does so exactly
    pure subroutine refine_contacts(fine, rigid, refined)
        type(fine_ground_type), intent(in) :: fine
        type(rigid_type), intent(in) :: rigid
        type(fine_rigid_type), intent(out) :: refined
        integer :: c

        allocate (refined%contacts(size(rigid%contacts)))
        do c = 1, size(rigid%contacts)
            associate (contact => rigid%contacts(c), length => fine%pieces(rigid%contacts(c)%piece)%length)
                refined%contacts(c) = fine_contact_type(contact%piece, contact%layer, at(contact%from), at(contact%to), &
                                                           real(contact%compliance, qp))
            end associate
        end do

    contains

        !> A place in the piece
        pure function at(place)
            real(wp), intent(in) :: place
            real(qp) :: at

            at = place
            if (place >= real(fine%pieces(rigid%contacts(c)%piece)%length, wp)) at = fine%pieces(rigid%contacts(c)%piece)%length
        end function at

    end subroutine refine_contacts

    !> The solution rounded once, with what the ground pushes
    subroutine take_solution(fine, factor, rigid, closed, solution)
        type(fine_ground_type), intent(in) :: fine
        real(qp), intent(in) :: factor
        type(fine_rigid_type), intent(inout) :: rigid
        logical, intent(in) :: closed(:)
        type(ground_solution_type), intent(inout) :: solution
        logical, allocatable :: acting(:)
        real(qp) :: q(2)
        integer :: h, i, row

        associate (z => rigid%zones, answers => rigid%work%answers)
            do i = 1, size(z%piece)
                if (.not. is_zone(rigid, i)) cycle
                answers(i - 1)%moment_right = straightened(fine, rigid, z%piece(i))
                answers(i)%moment_left = answers(i - 1)%moment_right
            end do
            allocate (acting(size(rigid%grounded%beam%supports)), source=.true.)
            acting(:size(closed)) = closed
            call take_rounded(fine, factor, z, rigid%grounded, acting, rigid%work, solution)
            solution%reaction = solution%reaction(:size(closed))
            solution%undecided = solution%undecided(:size(closed))
            allocate (solution%pressure(2, size(z%piece)), solution%push(0:size(z%piece)), solution%pushing(0:size(z%piece)))
            solution%push(:) = 0.0_wp
            solution%pushing(:) = 0
            do h = 1, size(rigid%holds)
                associate (hold => rigid%holds(h))
                    ! Beside the others it is nothing but rounding
                    if (.not. abs(rigid%push(h)) > rigid%noise%force) cycle
                    solution%push(hold%border) = real(rigid%push(h), wp)
                    solution%pushing(hold%border) = hold%layer
                end associate
            end do
            do i = 1, size(z%piece)
                row = findloc(z%acts(:, i) > 0, .true., 1)
                solution%pressure(:, i) = 0.0_wp
                if (row == 0) cycle
                q = load_at(fine, rigid, z%piece(i), [z%from(i), z%to(i)])
                solution%pressure(:, i) = real(q, wp)
                solution%resultant(row, i) = real((q(1) + q(2))/2*(z%to(i) - z%from(i)), wp)
            end do
        end associate
    end subroutine take_solution

end module gapbeam_rigid_solver
