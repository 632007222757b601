!> The engine's method as a yardstick: all but supports condensed, and recovered afterwards.
module yardstick_condensed
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: restrained
    use gapbeam_element, only: field_type
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_model, only: chain_type => beam_type, node_support_type, new_beam
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_contact_state, only: find_contact_state, outcome_type
    use gapbeam_search, only: rule_block
    use gapbeam_recover, only: recover_beam
    use yardstick_beam, only: beam_type, answer_type, solved, singular
    implicit none
    private
    public :: solve_condensed

contains

    !> Solve a beam, its contact state included
    subroutine solve_condensed(beam, answer, closed, solves, status)
        !> The beam and where its answer goes
        type(beam_type), intent(in) :: beam
        type(answer_type), intent(in) :: answer
        !> The contact state, shape (0:n)
        logical, intent(out) :: closed(0:)
        integer, intent(out) :: solves
        !> solved or singular
        integer, intent(out) :: status
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: loads(:), none(:)
        type(link_type), allocatable :: links(:)
        type(field_type), allocatable :: starts(:)
        type(node_support_type), allocatable :: supports(:)
        type(chain_type) :: chain
        type(workspace_type) :: work
        type(outcome_type) :: outcome
        type(error_type), allocatable :: error
        real(wp), allocatable :: force(:, :), couple(:, :), compliance(:), room(:)
        integer, allocatable :: at(:), kind(:), support(:)
        logical, allocatable :: acting(:)
        integer :: n, nl, i, k, first

        n = size(beam%length)
        support = pack([(i, i=0, n)], beam%stiff > 0.0_wp)
        at = pack([(i, i=0, n)], beam%stiff > 0.0_wp .or. [(i == 0 .or. i == n, i=0, n)])
        nl = size(at) - 1
        allocate (pieces(n), loads(n), none(n), links(nl), starts(n), room(n))
        allocate (force(2, 0:nl), couple(2, 0:nl), compliance(0:nl), kind(0:nl), supports(size(support)), acting(size(support)))
        none(:) = piece_load_type(0, 0, 0, 0, 0)
        do i = 1, n
            pieces(i) = piece_type(beam%length(i), 1/beam%ei(i), 0.0_wp)
            loads(i) = piece_load_type(beam%q(i), beam%q(i), 0.0_wp, beam%force(i), 0.0_wp)
        end do
        force(:, :) = 0.0_wp
        couple(:, :) = 0.0_wp
        compliance(:) = 0.0_wp
        kind(:) = 0
        do k = 0, nl
            i = at(k + 1)
            force(2, k) = beam%force(i)
            if (i > 0) loads(i)%force = 0.0_wp
        end do
        if (beam%clamped(1)) kind(0) = restrained
        if (beam%clamped(2)) kind(nl) = restrained
        k = 0
        do i = 1, size(support)
            do while (at(k + 1) /= support(i))
                k = k + 1
            end do
            supports(i) = node_support_type(k, beam%side(support(i)), beam%stiff(support(i)), beam%level(support(i)))
        end do
        first = 1
        do k = 1, nl
            associate (last => at(k + 1))
                call condense_link(pieces(first:last), none(first:last), loads(first:last), room, links(k))
                first = last + 1
            end associate
        end do
        call new_beam(links, kind, compliance, force, couple, supports, chain)
        call new_workspace(chain, work)
        call set_loads(chain, 1.0_wp, work)
        acting(:) = .true.
        call find_contact_state(chain, 1.0_wp, rule_block, acting, work, outcome, error)
        solves = work%solves
        closed = .false.
        status = singular
        if (allocated(error) .or. outcome%status /= gapbeam_solved) return
        status = solved
        call recover_beam(pieces, none, loads, 1.0_wp, links, at(2:), kind, work%answers%deflection, work%answers%moment_left, &
                          work%answers%moment_right, work%shear, starts)
        answer%w(0:n - 1) = starts%deflection
        answer%m(0:n - 1) = starts%moment
        answer%w(n) = work%answers(nl)%deflection
        answer%m(n) = work%answers(nl)%moment_left
        answer%r = 0.0_wp
        answer%r(support) = work%reaction
        closed(support) = acting
    end subroutine solve_condensed

end module yardstick_condensed
