!> A path on its way: the beam with its laws as they have become, the way at hand, and what was known on the way there.
module gapbeam_branch_state
    use gapbeam_kinds, only: wp => qp
    use gapbeam_path_tolerances, only: same_breakpoint
    use gapbeam_polyline, only: coarse_support_type => node_support_type
    use gapbeam_polyline_quad, only: node_support_type, piece_that_acts, break_law
    use gapbeam_model_quad, only: beam_type
    use gapbeam_region_responses, only: responses_type, outgoing_type
    use gapbeam_local_step, only: local_type, rounded, find_passed
    implicit none
    private
    public :: branch_type, note_place, break_supports, find_shared, sense_of, laws_of
    public :: parallel, stays_broken

    !> How a support unloads, if not along its law
    integer, parameter :: parallel = 1, stays_broken = 2
    !> A path on its way
    type :: branch_type
        !> The beam, with the laws as they have become
        type(beam_type) :: beam
        type(responses_type) :: responses
        !> The same in double precision
        type(local_type) :: local
        !> Has a support begun to unload in double precision, so that places are right to that only
        logical :: rounded_places = .false.
        !> How each support unloads, shape (size(supports)); slopes of the first pieces
        integer, allocatable :: unloading(:)
        real(wp), allocatable :: first_slope(:)
        real(wp) :: factor = 0.0_wp
        type(outgoing_type) :: way
        !> Deflections of the nodes, shape (0:n)
        real(wp), allocatable :: deflection(:)
        !> Ways on there were at the last breakpoint, and which is taken
        type(outgoing_type), allocatable :: outgoing(:)
        integer :: taken = 0
        !> Direction of the load times (-1)**index: it stays along the path (Eaves and Scarf 1976)
        integer :: sense = 0
        !> Breakpoints that differ in their scheme or law from the stretch before, if no others do; not allocated: any may
        integer, allocatable :: touched(:)
        !> The two supports, where nothing tells how they share what comes
        integer :: shared(2) = 0
    end type branch_type

contains

    !> Deflections at the factor at hand
    subroutine note_place(branch)
        type(branch_type), intent(inout) :: branch

        branch%deflection(:) = branch%responses%dead%answers%deflection + branch%factor*branch%responses%live%answers%deflection
    end subroutine note_place

    !> Break supports that stay broken at the end of a drop of their force: what lies before it is gone
    subroutine break_supports(branch, at_hand, broken)
        type(branch_type), intent(inout) :: branch
        !> Breakpoints that are reached in, without those out
        logical, intent(inout) :: at_hand(:)
        !> Those of them at which supports break
        logical, intent(out) :: broken(:)
        integer :: k

        broken(:) = .false.
        do k = 1, size(at_hand)
            associate (s => branch%beam%supports)
                if (.not. at_hand(k) .or. branch%way%closed(k) .or. branch%unloading(k) /= stays_broken) cycle
                if (.not. s(k)%before < -huge(1.0_wp)) cycle
                broken(k) = .true.
                at_hand(k) = .false.
                branch%way%closed(k) = .true.
                call break_law(s, k)
            end associate
        end do
    end subroutine break_supports

    !> Find supports at one node that could share a change of load in any way: one on a vertical piece, another one at the end of
    !> such a piece at the same deflection, to which its own set has brought it
    subroutine find_shared(branch)
        type(branch_type), intent(inout) :: branch
        real(wp) :: slope, rate
        logical :: acts, rigid
        integer :: i, j, k

        associate (beam => branch%beam, closed => branch%way%closed)
            do k = 1, size(closed)
                associate (s => beam%supports(k))
                    acts = closed(k)
                    slope = s%stiffness
                    if (s%breakpoint > 0) call piece_that_acts(beam%supports, closed, k, acts, slope)
                    if (.not. (acts .and. slope > huge(slope))) cycle
                    rate = branch%way%direction*s%side*branch%responses%live%reaction(k)
                    do i = beam%first(s%node), beam%first(s%node + 1) - 1
                        j = beam%order(i)
                        associate (other => beam%supports(j))
                            if (branch%unloading(j) /= parallel .or. other%passed .or. other%side /= s%side) cycle
                            if (abs(other%contact - s%contact) > same_breakpoint*abs(s%contact)) cycle
                            rigid = rate < 0.0_wp .and. ends_at(beam%supports, closed, j) .and. other%before > huge(rate)
                            if (other%breakpoint == 1 .and. .not. closed(j)) rigid = rate > 0.0_wp &
                                .and. other%stiffness > huge(rate)
                            if (rigid) branch%shared = [k, j]
                        end associate
                    end do
                end associate
            end do
        end associate
    end subroutine find_shared

    !> Is a closed breakpoint the last one that is not passed before the piece that acts
    pure function ends_at(supports, closed, k) result(last)
        type(node_support_type), intent(in) :: supports(:)
        logical, intent(in) :: closed(:)
        integer, intent(in) :: k
        logical :: last
        integer :: j

        j = k
        do while (supports(j)%more)
            if (.not. supports(j + 1)%passed) exit
            j = j + 1
        end do
        last = closed(k)
        if (supports(j)%more) last = last .and. .not. closed(j + 1)
    end function ends_at

    !> Direction of the load times (-1)**index
    pure function sense_of(way) result(sense)
        type(outgoing_type), intent(in) :: way
        integer :: sense

        sense = way%direction*merge(1, -1, modulo(way%index, 2) == 0)
    end function sense_of

    !> The laws as they have become at some breakpoints, in double precision; those that go on loading as they were
    pure function laws_of(branch, like, places) result(laws)
        type(branch_type), intent(in) :: branch
        !> What does not change of them, at all breakpoints
        type(coarse_support_type), intent(in) :: like(:)
        !> The breakpoints
        integer, intent(in) :: places(:)
        type(coarse_support_type) :: laws(size(places))

        if (branch%local%current .and. branch%local%steps > 0) then
            laws(:) = branch%local%beam%supports(places)
            call find_passed(laws)
        else
            laws(:) = rounded(branch%beam%supports(places), like(places))
        end if
    end function laws_of

end module gapbeam_branch_state
