!> States of a beam on the ground at one load factor after another.
module gapbeam_ground_walk
    use gapbeam_kinds, only: wp
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_ground, only: ground_type, zones_type, grounded_type
    use gapbeam_ground_quad, only: fine_ground_type => ground_type
    use gapbeam_workspace, only: workspace_type
    use gapbeam_refined_ground, only: refine_ground
    use gapbeam_ground_solution, only: ground_solution_type
    use gapbeam_ground_start, only: start_from, settle_nearby, take_zones
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: solve_state, ground_of, detail_of
    use gapbeam_ground_changes, only: find_zones
    use gapbeam_ground_events, only: held_type, same_contact
    implicit none
    private
    public :: walk_type, begin_walk, solve_near, hold, make_sure

    !> Zones of this share of the beam have next to no length
    real(wp), parameter :: shortest = 2.0_wp**(-24)

    !> What is the same at all load factors, and what has come of the last one
    type :: walk_type
        !> The beam and its ground, the same in quadruple precision, and the rule for its supports
        type(ground_type) :: ground
        type(fine_ground_type) :: fine
        integer :: rule
        !> The scheme of the supports from which every search starts
        logical, allocatable :: start(:)
        !> The last factor; from which on nothing is only looked at
        real(wp) :: last
        !> Is nothing only looked at; was what double precision saw not so
        logical :: carefully = .false., misled = .false.
        !> A state next to the last one that could not be settled
        type(error_type), allocatable :: trouble
        !> The state solved last
        type(state_type) :: state
        !> Linear solves
        integer :: solves = 0
    end type walk_type

contains

    !> Make ready
    subroutine begin_walk(assembled, last, rule, state, walk)
        type(assembled_type), intent(in), target :: assembled
        !> The last factor, and the rule
        real(wp), intent(in) :: last
        integer, intent(in) :: rule
        !> With the scheme that every search starts from
        type(state_type), intent(in) :: state
        type(walk_type), intent(out) :: walk

        walk%ground = ground_of(assembled)
        call refine_ground(walk%ground, detail_of(assembled), walk%fine)
        walk%rule = rule
        walk%last = last
        walk%state = state
        allocate (walk%start(size(state%closed)))
        walk%start(:) = state%closed
    end subroutine begin_walk

    !> What holds the beam at a load factor, as far as double precision tells; where that does not tell, for sure
    subroutine solve_near(assembled, walk, at, near, held, error)
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(in) :: at
        !> What holds it at a load factor nearby
        type(held_type), intent(in) :: near
        type(held_type), intent(out) :: held
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(grounded_type) :: grounded
        type(workspace_type) :: work
        type(ground_solution_type) :: solution
        logical :: settled, solved

        if (.not. walk%carefully .and. at < walk%last) then
            held%start = near%start
            call settle_nearby(walk%ground, at, walk%rule, held%start, grounded, work, walk%solves, settled, solved)
            call end_if_stopped(assembled%beam%watch, error)
            if (allocated(error)) return
            if (settled .and. .not. has_short_zone(held%start%zones)) then
                allocate (held%closed(size(walk%start)))
                held%closed(:) = held%start%closed
                call take_zones(held%start%zones, solution)
                call find_zones(assembled, solution, held%zones, error)
                held%stands = .true.
                return
            end if
        end if
        call hold(assembled, walk, at, held, error, near)
    end subroutine solve_near

    !> What holds the beam at a load factor. Just below the last one next to nothing does: what cannot be settled there is put
    !> down as no equilibrium, and prove_end sees to it that there is none
    subroutine hold(assembled, walk, at, held, error, near)
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(in) :: at
        type(held_type), intent(out) :: held
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        !> As for look
        type(held_type), intent(in), optional :: near
        logical :: stands_nearby

        walk%state%closed(:) = walk%start
        stands_nearby = .false.
        if (present(near)) stands_nearby = near%stands
        if (stands_nearby) then
            call solve_state(assembled, at, walk%rule, walk%state, error, near%start)
        else
            call solve_state(assembled, at, walk%rule, walk%state, error)
        end if
        if (allocated(error)) then
            if (error%code == gapbeam_not_converged .or. error%code == gapbeam_not_finite) then
                call move_alloc(error, walk%trouble)
            else
                error%message = "at load factor "//trim(shown(at))//": "//error%message
            end if
            return
        end if
        walk%solves = walk%solves + walk%state%solves
        if (walk%state%status /= gapbeam_solved) then
            if (allocated(walk%trouble)) deallocate (walk%trouble)
            allocate (held%motion(0:size(walk%state%motion) - 1))
            held%motion(:) = walk%state%motion
            return
        end if
        held%stands = .true.
        held%sure = .true.
        allocate (held%closed(size(walk%start)))
        held%closed(:) = walk%state%closed
        call start_from(walk%state%ground, walk%state%closed, held%start)
        call find_zones(assembled, walk%state%ground, held%zones, error)
    end subroutine hold

    !> Solve at a factor that was only looked at
    subroutine make_sure(assembled, walk, at, held, error)
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        real(wp), intent(in) :: at
        type(held_type), intent(inout) :: held
        !> As for look
        type(error_type), allocatable, intent(out) :: error
        type(held_type) :: solved

        if (held%sure) return
        call hold(assembled, walk, at, solved, error, held)
        if (allocated(error)) return
        walk%misled = .not. same_contact(held, solved)
        held = solved
    end subroutine make_sure

    !> Is there a zone with next to no length: it may have to carry what none can (gapbeam_ground_ties)
    pure function has_short_zone(zones) result(has)
        type(zones_type), intent(in) :: zones
        logical :: has
        real(wp) :: length
        integer :: i

        has = .false.
        length = sum(zones%to - zones%from)
        do i = 1, size(zones%piece)
            has = has .or. any(zones%acts(:, i) > 0) .and. zones%to(i) - zones%from(i) <= shortest*length
        end do
    end function has_short_zone

end module gapbeam_ground_walk
