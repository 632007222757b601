!> Zones and places in which a beam touches rigid ground, found by Newton's method.
!>
!> At the end of a zone the moment vanishes. On zones whose ends are off by e the beam is off by the order of e**2 or less, since
!> what it is held to there is what it comes to by itself: so each end goes where the moment would vanish, and they converge
!> quadratically without any equation of their own. Where the beam touches at a single place it is parallel to the ground, and a
!> spring there tells how far the place has to go (rigid_held, fix_slope). Where the beam goes through the ground it is stopped,
!> and what would have to pull lets go.
module gapbeam_rigid_ground
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_rigid_rounds
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_contact_state, only: outcome_type
    use gapbeam_ground, only: ground_type
    use gapbeam_rigid_contact, only: contact_type
    use gapbeam_rigid_held, only: solve_held
    use gapbeam_rigid_order, only: put_in_order
    use gapbeam_rigid_state, only: rigid_type, find_noise, is_zone
    use gapbeam_rigid_zones, only: move_zone
    use gapbeam_rigid_places, only: move_place, stop_beam
    implicit none
    private
    public :: settle_contacts

contains

    !> Move contacts until they stay where they are
    subroutine settle_contacts(ground, factor, rule, tolerance, rigid, closed, outcome, settled, error)
        type(ground_type), intent(in) :: ground
        !> Load factor, and rule for the supports (gapbeam_search)
        real(wp), intent(in) :: factor
        integer, intent(in) :: rule
        !> Share of the beam's length by which they may still move
        real(wp), intent(in) :: tolerance
        !> Contacts to begin with in; those found, and the solution on them, out
        type(rigid_type), intent(inout) :: rigid
        logical, intent(inout) :: closed(:)
        type(outcome_type), intent(out) :: outcome
        logical, intent(out) :: settled
        !> As for find_contact_state
        type(error_type), allocatable, intent(out) :: error
        integer :: round

        settled = .false.
        rigid%factor = factor
        do round = 1, most_rigid_rounds
            call solve_held(ground, factor, rule, rigid, closed, outcome, error)
            if (allocated(error)) return
            if (outcome%status /= gapbeam_solved) return
            call move_contacts(ground, rigid)
            call end_if_stopped(ground%beam%watch, error)
            if (allocated(error)) return
            settled = way_of(rigid%contacts, rigid%found) <= tolerance*sum(ground%pieces%length)
            if (settled) return
            call move_alloc(rigid%found, rigid%contacts)
        end do
    end subroutine settle_contacts

    !> How far contacts move, huge if they are others
    pure function way_of(contacts, found) result(way)
        type(contact_type), intent(in) :: contacts(:), found(:)
        real(wp) :: way

        way = huge(way)
        if (size(contacts) /= size(found)) return
        if (any(contacts%piece /= found%piece .or. contacts%layer /= found%layer .or. &
                (contacts%to > contacts%from .neqv. found%to > found%from))) return
        way = maxval([0.0_wp, abs(contacts%from - found%from), abs(contacts%to - found%to)])
        ! A place that is new has not been moved
        if (any(contacts%compliance < 0.0_wp .and. found%compliance >= 0.0_wp)) way = huge(way)
        ! A zone that shrinks away goes on
        if (any(found%to > found%from .and. max(abs(contacts%from - found%from), abs(contacts%to - found%to)) &
                > (found%to - found%from)/64)) way = huge(way)
    end function way_of

    !> The contacts that a solution asks for
    subroutine move_contacts(ground, rigid)
        type(ground_type), intent(in) :: ground
        type(rigid_type), intent(inout) :: rigid
        integer :: c, i, most

        most = 4*size(rigid%contacts) + 4*size(rigid%zones%piece)*max(1, size(rigid%zones%acts, 1))
        if (allocated(rigid%found)) deallocate (rigid%found)
        if (allocated(rigid%way)) deallocate (rigid%way)
        allocate (rigid%found(most), rigid%way(0:size(rigid%zones%piece)))
        rigid%number = 0
        rigid%way(:) = 0.0_wp
        call find_noise(ground, rigid)
        do c = 1, size(rigid%contacts)
            if (rigid%contacts(c)%to > rigid%contacts(c)%from) then
                call move_zone(ground, rigid, rigid%contacts(c), rigid%place(c))
            else
                call move_place(ground, rigid, rigid%contacts(c), rigid%place(c))
            end if
        end do
        do i = 1, size(rigid%zones%piece)
            if (.not. is_zone(rigid, i)) call stop_beam(ground, rigid, i)
        end do
        call put_in_order(rigid%found, rigid%number)
    end subroutine move_contacts

end module gapbeam_rigid_ground
