!> Margins of supports: distances from the end of their piece of the law, below zero if wrong.
!>
!> The one measure of all signs, beside the rounding error of the number itself. A margin is the force with which a closed support
!> pushes, or the distance of an open one from contact; of laws with more pieces gapbeam_polyline knows it.
module gapbeam_law_margins
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: answer_type
    use gapbeam_polyline, only: node_support_type, breakpoint_margin, breakpoint_slopes, is_steeper, is_watched, past_level
    use gapbeam_law, only: both
    implicit none
    private
    public :: may_change, margin_of, margin_in_scheme, margin_rates, is_watched_in
    public :: find_margins, find_wrong_states, find_doubtful_states, let_go

contains

    !> Has a support more than one state
    elemental function may_change(support) result(may)
        type(node_support_type), intent(in) :: support
        logical :: may

        may = support%side /= both .and. (support%stiffness > 0.0_wp .or. support%breakpoint > 0)
    end function may_change

    ! Margins

    !> The same of any support in a scheme; of a law with which of its breakpoints something is wrong
    pure subroutine margin_in_scheme(supports, closed, k, deflection, deflection_size, reaction, reaction_error, margin, rounding, &
                                     by_force)
        !> All supports, the scheme, and the number of one of them
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        !> Of its node, and the size of that for rounding errors
        real(wp), intent(in) :: deflection, deflection_size
        !> Reactions of all supports and their rounding errors
        real(wp), intent(in) :: reaction(:), reaction_error(:)
        !> As for margin_of
        real(wp), intent(out) :: margin, rounding
        !> Is it a force, not a distance
        logical, intent(out), optional :: by_force
        logical :: is_force

        if (supports(k)%breakpoint > 0) then
            call breakpoint_margin(supports, closed, k, deflection, deflection_size, reaction, reaction_error, margin, rounding, &
                                   is_force)
        else
            call margin_of(supports(k), closed(k), deflection, deflection_size, reaction(k), reaction_error(k), margin, rounding)
            is_force = closed(k)
        end if
        if (present(by_force)) by_force = is_force
    end subroutine margin_in_scheme

    !> By how much the state of a support is right, and the rounding error of that: the one measure of all signs
    elemental subroutine margin_of(support, closed, deflection, deflection_size, reaction, reaction_error, margin, rounding)
        type(node_support_type), intent(in) :: support
        logical, intent(in) :: closed
        !> Of its node, and the size of that for rounding errors
        real(wp), intent(in) :: deflection, deflection_size
        !> Its reaction and the rounding error of that
        real(wp), intent(in) :: reaction, reaction_error
        !> Force with which it pushes, or distance to contact; 0 for supports whose state does not change
        real(wp), intent(out) :: margin
        real(wp), intent(out) :: rounding

        margin = 0.0_wp
        rounding = 0.0_wp
        if (.not. may_change(support)) return
        if (closed) then
            margin = support%side*reaction
            rounding = reaction_error
        else
            margin = support%side*(support%contact - deflection)
            rounding = epsilon(deflection)*max(deflection_size, abs(support%contact))
        end if
    end subroutine margin_of

    !> By how much the margin of a support that is not held rigidly changes with the deflection of its node, and its contact level
    pure subroutine margin_rates(supports, closed, k, rate, level, by_force)
        !> All supports, the scheme, and the number of one of them
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        !> Absolute values: the slope of its piece where the margin is a force, else 1; its contact level
        real(wp), intent(out) :: rate, level
        !> Is the margin a force
        logical, intent(out) :: by_force
        real(wp) :: here, there
        integer :: from
        logical :: adjacent

        by_force = closed(k)
        if (supports(k)%breakpoint > 0) then
            call breakpoint_slopes(supports, closed, k, adjacent, from, here, there)
            by_force = .not. supports(k)%passed .and. adjacent .and. is_steeper(here, there)
        end if
        rate = 1.0_wp
        if (by_force) rate = abs(merge(supports(k)%stiffness, supports(k)%before, closed(k)))
        level = abs(supports(k)%contact)
    end subroutine margin_rates

    !> Can the state of a support change next
    pure function is_watched_in(supports, closed, k) result(watched)
        !> As for margin_in_scheme
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical :: watched

        watched = may_change(supports(k))
        if (supports(k)%breakpoint > 0) watched = is_watched(supports, closed, k)
    end function is_watched_in

    !> Let supports go that hardly hold the beam any more, and laws on to a flatter piece that begins next to where they are
    pure subroutine let_go(supports, deflection, reaction, next_to_nothing, closed)
        type(node_support_type), intent(in) :: supports(:)
        !> At the nodes, shape (0:n); of the supports, shape (m)
        real(wp), intent(in) :: deflection(0:), reaction(:)
        !> Force up to which a support hardly carries, or has hardly begun to
        real(wp), intent(in) :: next_to_nothing
        !> The scheme, shape (m)
        logical, intent(inout) :: closed(:)
        real(wp) :: none(size(supports)), margin, rounding
        logical :: now(size(closed)), by_force
        integer :: k

        none(:) = 0.0_wp
        now(:) = closed
        do k = 1, size(supports)
            if (.not. is_watched_in(supports, now, k)) cycle
            ! Margins are forces along the steeper one of two pieces: nothing else can be lost
            call margin_in_scheme(supports, now, k, deflection(supports(k)%node), 0.0_wp, reaction, none, margin, rounding, &
                                  by_force)
            if (by_force .and. abs(margin) <= next_to_nothing) closed(k) = .not. now(k)
        end do
    end subroutine let_go

    !> The margins of all supports
    pure subroutine find_margins(supports, closed, answers, deflection_size, reaction, reaction_error, margin, rounding)
        !> The supports and the scheme, shape (m)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        !> At the nodes, shape (0:n)
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(in) :: deflection_size(0:)
        !> Of the supports, shape (m)
        real(wp), intent(in) :: reaction(:), reaction_error(:)
        !> As margin_of, shape (m)
        real(wp), intent(out) :: margin(:), rounding(:)
        integer :: k

        do k = 1, size(closed)
            associate (i => supports(k)%node)
                call margin_in_scheme(supports, closed, k, answers(i)%deflection, deflection_size(i), reaction, reaction_error, &
                                      margin(k), rounding(k))
            end associate
        end do
    end subroutine find_margins

    !> Which states are wrong: margins below zero by more than so many rounding errors
    pure subroutine find_wrong_states(supports, closed, answers, deflection_size, reaction, reaction_error, width, wrong)
        !> As for find_margins
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(in) :: deflection_size(0:), reaction(:), reaction_error(:)
        !> Rounding errors beyond which a sign counts
        real(wp), intent(in) :: width
        !> Shape (m)
        logical, intent(out) :: wrong(:)
        real(wp) :: margin, rounding
        integer :: k

        do k = 1, size(closed)
            associate (i => supports(k)%node)
                if (supports(k)%breakpoint == 0) then
                    call margin_of(supports(k), closed(k), answers(i)%deflection, deflection_size(i), reaction(k), &
                                   reaction_error(k), margin, rounding)
                else
                    call past_level(supports, closed, k, answers(i)%deflection, deflection_size(i), margin, rounding)
                    margin = -margin
                    if (.not. abs(margin) > width*rounding) then
                        call margin_in_scheme(supports, closed, k, answers(i)%deflection, deflection_size(i), reaction, &
                                              reaction_error, margin, rounding)
                    end if
                end if
            end associate
            wrong(k) = margin < -width*rounding
        end do
    end subroutine find_wrong_states

    !> Of which supports the margin cannot be told from zero, so that their state may be either
    pure subroutine find_doubtful_states(supports, closed, answers, deflection_size, reaction, reaction_error, width, doubtful, &
                                         in_doubt)
        !> As for find_wrong_states
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        type(answer_type), intent(in) :: answers(0:)
        real(wp), intent(in) :: deflection_size(0:), reaction(:), reaction_error(:), width
        !> Shape (m)
        logical, intent(out) :: doubtful(:)
        !> Is any of them not exactly zero, or beyond: wrong
        logical, intent(out) :: in_doubt
        real(wp) :: margin, rounding
        integer :: k

        in_doubt = .false.
        do k = 1, size(closed)
            doubtful(k) = .false.
            if (.not. is_watched_in(supports, closed, k)) cycle
            associate (i => supports(k)%node)
                call margin_in_scheme(supports, closed, k, answers(i)%deflection, deflection_size(i), reaction, reaction_error, &
                                      margin, rounding)
            end associate
            doubtful(k) = abs(margin) <= width*rounding
            in_doubt = in_doubt .or. (doubtful(k) .and. rounding > 0.0_wp) .or. margin < -width*rounding
        end do
    end subroutine find_doubtful_states

end module gapbeam_law_margins
