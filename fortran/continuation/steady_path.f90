!> Load path of a beam in stretches that stay as they are, from breakpoint to breakpoint of its supports.
!>
!> On ground that holds both ways by its modulus alone, and under axial forces that do not grow with the load, supports alone
!> change (gapbeam_history_beam), and between two changes all values are linear in the load factor: nothing is to be looked for on
!> a grid. So a path goes as a history does (gapbeam_branch), as long as there is one way on, and the state where that ends must be
!> the same by itself; what comes after it is for gapbeam_walk.
module gapbeam_steady_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: shortest_interval
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_stopped
    use gapbeam_scene, only: gapbeam_elastic
    use gapbeam_assembled_model, only: growth_of
    use gapbeam_model_quad, only: beam_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_ground_events, only: held_type, same_contact
    use gapbeam_ground_problem, only: ground_problem_type
    use gapbeam_history_beam, only: make_history_beam
    use gapbeam_branch, only: branch_type, segment_type, start_branch, step_branch, goes_on, arrived
    use gapbeam_region_responses, only: rise
    implicit none
    private
    public :: pass_steady

    !> A place on the path: its load factor and scheme, and how much is recorded up to it
    type :: mark_type
        real(wp) :: at = 0.0_wp
        logical, allocatable :: closed(:)
        integer :: events = 0, segments = 0
    end type mark_type

contains

    !> Go along the path as far as it is that of supports alone
    subroutine pass_steady(problem, now, error)
        class(ground_problem_type), intent(inout) :: problem
        !> Where it begins, or one of its states farther up
        class(point_type), allocatable, intent(inout) :: now
        !> The call is to end, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(branch_type) :: branch
        type(held_type) :: held
        type(mark_type) :: begin, come_to
        logical :: follows

        select type (now)
        type is (held_type)
            if (now%loose) return
            held = now
        end select
        call start(problem, held, branch, follows, error)
        if (.not. follows) return
        call mark(problem, held%at, held%closed, begin)
        come_to = begin
        call go_along(problem, branch, held, come_to, error)
        problem%solves = problem%solves + branch%responses%solves
        follows = .false.
        if (.not. allocated(error) .and. come_to%at > begin%at) call check(problem, come_to, held, now, follows, error)
        if (allocated(error)) return
        if (.not. follows) come_to = begin
        problem%path%number = come_to%events
        problem%path%segments = come_to%segments
    end subroutine pass_steady

    !> Mark a place, and how much is recorded there
    pure subroutine mark(problem, at, closed, place)
        class(ground_problem_type), intent(in) :: problem
        real(wp), intent(in) :: at
        logical, intent(in) :: closed(:)
        type(mark_type), intent(inout) :: place

        place%at = at
        place%closed = closed
        place%events = problem%path%number
        place%segments = problem%path%segments
    end subroutine mark

    !> Begin where a state is known
    subroutine start(problem, held, branch, follows, error)
        class(ground_problem_type), intent(in) :: problem
        type(held_type), intent(in) :: held
        type(branch_type), intent(out) :: branch
        !> Is there one way on
        logical, intent(out) :: follows
        !> The call is to end
        type(error_type), allocatable, intent(out) :: error
        type(beam_type) :: beam
        integer, allocatable :: node(:), unloading(:)
        real(wp), allocatable :: settling(:)
        integer :: outcome

        follows = .false.
        associate (assembled => problem%assembled)
            call make_history_beam(assembled, beam, node, error)
            if (.not. allocated(error)) then
                allocate (unloading(size(held%closed)), source=gapbeam_elastic)
                settling = growth_of(assembled)
                call start_branch(beam, assembled%beam, unloading, real(settling, qp), held%closed, real(held%at, qp), rise, &
                                  branch, outcome, error)
            end if
        end associate
        if (.not. allocated(error)) then
            follows = is_clear(branch, outcome)
        else if (error%code /= gapbeam_stopped) then
            deallocate (error)
        end if
    end subroutine start

    !> Is there one way on, stable under growing load
    pure function is_clear(branch, outcome)
        type(branch_type), intent(in) :: branch
        !> By start_branch, step_branch
        integer, intent(in) :: outcome
        logical :: is_clear

        is_clear = outcome == goes_on .and. branch%way%direction == rise .and. branch%way%index == 0
        if (is_clear) is_clear = size(branch%outgoing) == 1
    end function is_clear

    !> From breakpoint to breakpoint, with all that changes
    subroutine go_along(problem, branch, held, come_to, error)
        class(ground_problem_type), intent(inout) :: problem
        type(branch_type), intent(inout) :: branch
        !> Where it begins in, with the scheme of the last stretch out
        type(held_type), intent(inout) :: held
        !> The end of the path, or a place on its last stretch that is not short
        type(mark_type), intent(inout) :: come_to
        type(error_type), allocatable, intent(out) :: error
        type(segment_type) :: segment
        logical, allocatable :: closed(:)
        integer :: outcome

        do
            closed = branch%way%closed
            call step_branch(branch, real(problem%last, qp), rise, segment, outcome, error)
            if (.not. allocated(error)) call end_if_stopped(problem%assembled%beam%watch, error)
            if (allocated(error)) then
                ! The walk finds out by itself what there is
                if (error%code /= gapbeam_stopped) deallocate (error)
                return
            end if
            associate (from => real(segment%from, wp), to => min(real(segment%to, wp), problem%last))
                if (to > from) call take(from)
                if (allocated(error)) return
                if (outcome == arrived) then
                    call mark(problem, to, held%closed, come_to)
                else if (to - from > shortest_interval*problem%last) then
                    call mark(problem, from + (to - from)/2, held%closed, come_to)
                end if
            end associate
            if (.not. is_clear(branch, outcome)) return
        end do

    contains

        !> Record what has changed where a stretch begins
        subroutine take(from)
            real(wp), intent(in) :: from
            type(held_type) :: after
            integer :: changes

            changes = count(closed .neqv. held%closed)
            if (changes == 0) return
            after = held
            after%closed = closed
            call problem%take_changes(held, after, spread(from, 1, changes), spread(-1.0_wp, 1, changes), error)
            held%closed = closed
        end subroutine take

    end subroutine go_along

    !> Is the state at a place what the path says
    subroutine check(problem, place, held, now, it_is, error)
        class(ground_problem_type), intent(inout) :: problem
        type(mark_type), intent(in) :: place
        !> Where the path began, near which it is looked for
        type(held_type), intent(inout) :: held
        !> That state, if it is
        class(point_type), allocatable, intent(inout) :: now
        logical, intent(out) :: it_is
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: point

        it_is = .false.
        held%closed = place%closed
        held%start%closed = place%closed
        call problem%find(place%at, point, error, held)
        if (allocated(error)) return
        select type (point)
        type is (held_type)
            it_is = .not. (allocated(point%trouble) .or. point%loose)
            if (it_is) it_is = same_contact(held, point)
        end select
        if (it_is) call move_alloc(point, now)
    end subroutine check

end module gapbeam_steady_path
