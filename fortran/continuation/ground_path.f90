!> Load path of a beam on the ground: changes of zones of contact and supports at their factors.
!>
!> Between two changes the ends of the zones move smoothly with the load, and no formula gives the factor of the next change. So
!> the beam is looked at on a grid of factors, and where what acts differs between two neighbours, the changes between them are
!> found one after the other (gapbeam_ground_narrow). Changes that undo each other between two places of the grid are not seen.
module gapbeam_ground_path
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: load_begin
    use gapbeam_error, only: error_type
    use gapbeam_layers, only: has_limit, has_curves
    use gapbeam_ground_solver, only: limit_on_ground
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_state, only: detail_of
    use gapbeam_ground_events, only: ground_path_type, held_type, new_path, note_changes, add_segment, same_contact
    use gapbeam_ground_walk, only: walk_type, begin_walk, solve_near, hold, make_sure
    use gapbeam_ground_narrow, only: narrow
    implicit none
    private
    public :: follow_on_ground

    !> Parts into which the loading history is cut before changes are looked for
    integer, parameter :: parts = 64
    !> Curves come to their limit where the beam has gone without end: the path is followed until this share of it is missing, or
    !> that, powers of 2
    integer, parameter :: missing_powers(*) = [-20, -10]
    !> Where the load at load_begin is nothing beside gaps and settlements, what acts from the beginning is what acts at one of the
    !> next shares of the way
    real(wp), parameter :: begins(*) = [load_begin, 2.0_wp**(-34), 2.0_wp**(-28), 2.0_wp**(-22)]

contains

    !> Follow the load from factor 0 upwards
    subroutine follow_on_ground(assembled, factor, rule, state, path, error)
        !> A beam on the ground
        type(assembled_type), intent(in), target :: assembled
        !> Where the path ends, above 0
        real(wp), intent(in) :: factor
        !> rule_block or rule_single
        integer, intent(in) :: rule
        !> The scheme that every search starts from in; out the state at `factor`, or the motion just above path%last
        type(state_type), intent(inout) :: state
        !> All changes above load factor 0
        type(ground_path_type), intent(out) :: path
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        type(walk_type) :: walk

        call begin_walk(assembled, factor, rule, state, walk)
        call new_path(path)
        path%beyond = factor
        call go_along(assembled, walk, path, error)
        path%solves = walk%solves
        state = walk%state
    end subroutine follow_on_ground

    !> Go along the whole way
    subroutine go_along(assembled, walk, path, error)
        type(assembled_type), intent(in), target :: assembled
        type(walk_type), intent(inout) :: walk
        type(ground_path_type), intent(inout) :: path
        !> As for solve_state
        type(error_type), allocatable, intent(out) :: error
        !> What holds the beam at the factor come to, at the one before it or the same, at the next one of the grid, around a
        !> change, and where it was last sure
        type(held_type) :: now, earlier, then, below, above, sure
        real(wp) :: at, at_earlier, next, low, high, at_sure
        real(wp), allocatable :: factors(:), places(:)
        logical :: yields, levels_off
        integer :: k

        call find_limits(assembled, yields, levels_off)
        associate (factor => walk%last)
            do k = 1, size(begins)
                at = factor*begins(k)
                if (allocated(walk%trouble)) deallocate (walk%trouble)
                call hold(assembled, walk, at, now, error)
                if (allocated(error)) return
                if (.not. allocated(walk%trouble)) exit
            end do
            if (.not. now%stands) then
                call move_alloc(walk%trouble, error)
                path%beyond = 0.0_wp
                return
            end if
            call add_segment(0.0_wp, now, path, error)
            if (allocated(error)) return
            sure = now
            at_sure = at
            earlier = now
            at_earlier = at
            k = 1
            do while (k <= parts)
                next = factor*(real(k, wp)/parts)
                call solve_near(assembled, walk, next, now, then, error)
                if (allocated(error)) return
                do while (.not. same_contact(now, then))
                    low = at
                    high = next
                    below = now
                    above = then
                    if (.not. then%stands) then
                        call make_sure(assembled, walk, low, below, error)
                        if (allocated(error)) return
                        if (walk%misled) exit
                        call go_to_limit(low, high, below, above)
                        if (allocated(error) .or. path%at_limit) return
                    end if
                    call narrow(assembled, walk, low, below, high, above, at_earlier, earlier, levels_off, factors, places, error)
                    if (allocated(error)) return
                    if (walk%misled) exit
                    if (.not. above%stands) then
                        path%last = low
                        call prove_end(low, high)
                        path%at_limit = yields .and. low > 0.0_wp
                        return
                    end if
                    call note_changes(assembled, below, above, factors, places, path, error)
                    if (allocated(error)) return
                    call add_segment(minval(factors), above, path, error)
                    if (allocated(error)) return
                    now = above
                    at = high
                    sure = now
                    at_sure = at
                    earlier = now
                    at_earlier = at
                    if (.not. high < next) exit
                end do
                if (walk%misled) then
                    ! What double precision saw is not so: from where it was sure on, nothing is only looked at
                    walk%misled = .false.
                    walk%carefully = .true.
                    now = sure
                    at = at_sure
                    earlier = now
                    at_earlier = at
                    k = 1
                    do while (factor*(real(k, wp)/parts) <= at)
                        k = k + 1
                    end do
                    cycle
                end if
                if (at < next) then
                    earlier = now
                    at_earlier = at
                    now = then
                    at = next
                end if
                k = k + 1
            end do
            path%last = factor
            if (walk%state%factor < factor) call hold(assembled, walk, factor, now, error)
        end associate

    contains

        !> Where laws are curves limit analysis knows the limit load: end the path there, or look next to it for what changes before
        subroutine go_to_limit(low, high, below, above)
            real(wp), intent(in) :: low
            real(wp), intent(inout) :: high
            type(held_type), intent(in) :: below
            type(held_type), intent(inout) :: above
            type(held_type) :: held
            real(wp) :: bears, beyond, last
            logical :: found
            integer :: k

            if (.not. levels_off) return
            bears = low
            beyond = high
            call limit_on_ground(walk%ground, detail_of(assembled), bears, beyond, found)
            if (.not. found) return
            do k = 1, size(missing_powers)
                last = bears*(1 - 2.0_wp**missing_powers(k))
                if (last <= low) return
                call hold(assembled, walk, last, held, error, below)
                if (allocated(error)) return
                if (held%stands) exit
            end do
            if (.not. held%stands) return
            if (.not. same_contact(below, held)) then
                high = last
                above = held
                return
            end if
            call hold(assembled, walk, beyond, held, error)
            if (allocated(error)) return
            path%last = last
            path%beyond = beyond
            path%at_limit = .true.
        end subroutine go_to_limit

        !> Find a factor just above the last one at which there is no equilibrium for sure, and how the beam moves there
        subroutine prove_end(last, above)
            real(wp), intent(in) :: last, above
            type(held_type) :: held
            type(error_type), allocatable :: first_trouble
            integer :: power

            path%beyond = last
            if (.not. allocated(walk%trouble)) then
                if (levels_off) path%beyond = above
                call hold(assembled, walk, above, held, error)
                return
            end if
            allocate (first_trouble, source=walk%trouble)
            do power = -50, -9, 4
                path%beyond = last*(1 + 2.0_wp**power)
                call hold(assembled, walk, path%beyond, held, error)
                if (allocated(error)) return
                if (.not. held%stands .and. .not. allocated(walk%trouble)) return
            end do
            call move_alloc(first_trouble, error)
        end subroutine prove_end

    end subroutine go_along

    !> Does some ground carry no more than so much, and does it come to that on a curve
    pure subroutine find_limits(assembled, yields, levels_off)
        type(assembled_type), intent(in) :: assembled
        logical, intent(out) :: yields, levels_off
        integer :: k

        yields = .false.
        levels_off = .false.
        do k = 1, size(assembled%layers)
            associate (layer => assembled%layers(k))
                if (.not. has_limit(layer, assembled%law_pieces)) cycle
                yields = .true.
                levels_off = levels_off .or. has_curves(layer)
            end associate
        end do
    end subroutine find_limits

end module gapbeam_ground_path
