!> States of a beam on the ground, or on smooth laws, under a train at one position after another, each looked for near another one.
module gapbeam_train_states
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, gapbeam_indeterminate, &
        gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_laws, only: is_smooth
    use gapbeam_scene, only: gapbeam_both
    use gapbeam_ground, only: ground_type, new_zones, resize, steps_of_piece
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_smooth_laws, only: past_curve, deflections_at_curves, reaction_at
    use gapbeam_smooth_state, only: solve_on_laws
    use gapbeam_pieces, only: acting_type, acting_piece, gapbeam_open, gapbeam_branch
    use gapbeam_ground_changes, only: zone_type, find_zones, same_zones
    use gapbeam_train, only: train_type
    use gapbeam_train_traversal, only: not_unique
    use gapbeam_train_on_beam, only: put_train, end_of_beam
    use gapbeam_ground_steps, only: border_of_step
    implicit none
    private
    public :: kept_type, box_type, solve_at, put_near, take_undecided, alike, same_units

    !> The state at a position
    type :: kept_type
        real(wp) :: position = 0.0_wp
        !> Which axles act
        logical, allocatable :: acts(:)
        !> gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, not_unique, or the code of an error that leaves other positions
        !> their answers
        integer :: status = -1
        !> The beam with the train on it, and what was solved
        type(assembled_type), allocatable :: placed
        type(state_type), allocatable :: state
        !> On the ground its zones, and where the search for other states may begin
        type(zone_type), allocatable :: zones(:)
        type(ground_start_type) :: start
        !> What acts of every support of the model, and whether that is decided
        type(acting_type), allocatable :: acting(:)
        logical, allocatable :: decided(:)
        !> Largest (1) and smallest (2) value of every quantity, and their places, once they have been asked for
        real(wp), allocatable :: extremes(:, :), places(:, :)
    end type kept_type

    !> Room for one
    type :: box_type
        type(kept_type), allocatable :: of
    end type box_type

    !> Ends of zones as near as this share of the beam to the end of a piece are there
    real(wp), parameter :: at_end = 2.0_wp**(-40)

contains

    !> Solve at a position
    subroutine solve_at(assembled, train, rule, position, acts, kept, solves, error, near)
        type(assembled_type), intent(in) :: assembled
        type(train_type), intent(in) :: train
        !> rule_block or rule_single
        integer, intent(in) :: rule
        real(wp), intent(in) :: position
        !> Which axles act
        logical, intent(in) :: acts(:)
        type(kept_type), intent(out) :: kept
        !> Linear solves so far
        integer, intent(inout) :: solves
        !> As for solve_state, but for what leaves other positions their answers
        type(error_type), allocatable, intent(out) :: error
        !> A state nearby
        type(kept_type), intent(in), optional :: near
        type(ground_start_type), allocatable :: start
        real(wp), allocatable :: on_curves(:)

        kept%position = position
        allocate (kept%acts, source=acts)
        allocate (kept%placed, kept%state)
        call put_train(assembled, train, position, acts, kept%placed, error)
        if (.not. allocated(error)) call new_state(kept%placed, kept%state, error)
        if (allocated(error)) return
        if (present(near)) call begin_near(near, kept%placed, start, on_curves)
        ! What is not allocated is not present
        call solve_on_laws(kept%placed, 1.0_wp, rule, kept%state, error, on_curves, start)
        if (allocated(error)) then
            if (all(error%code /= [gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite])) return
            kept%status = error%code
            deallocate (error)
            return
        end if
        solves = solves + kept%state%solves
        kept%status = kept%state%status
        if (kept%status == gapbeam_no_equilibrium .or. kept%status == gapbeam_buckles) return
        if (kept%state%indifferent .and. .not. kept%state%loose_along) then
            kept%status = not_unique
            return
        end if
        call describe(kept)
        if (.not. allocated(kept%state%ground)) return
        call start_from(kept%state%ground, kept%state%closed, kept%start)
        call find_zones(kept%placed, kept%state%ground, kept%zones, error)
    end subroutine solve_at

    !> Where a solve at another position may begin: zones, and deflections at smooth laws; not allocated where these are not known
    subroutine begin_near(near, placed, start, on_curves)
        !> A state nearby
        type(kept_type), intent(in) :: near
        !> The beam at that position
        type(assembled_type), intent(in) :: placed
        type(ground_start_type), allocatable, intent(out) :: start
        real(wp), allocatable, intent(out) :: on_curves(:)
        logical :: known

        if (.not. same_units(near, placed)) return
        if (allocated(placed%layers)) then
            allocate (start)
            call put_near(near, placed, ground_of(placed, 1.0_wp), start, known)
            if (.not. known) deallocate (start)
            if (.not. known) return
        end if
        if (near%status == gapbeam_solved) on_curves = deflections_at_curves(near%placed, near%state%deflection)
    end subroutine begin_near

    !> Is a beam in the units of a state
    pure function same_units(kept, placed) result(same)
        type(kept_type), intent(in) :: kept
        type(assembled_type), intent(in) :: placed
        logical :: same

        same = allocated(kept%placed)
        if (.not. same) return
        associate (a => kept%placed%units, b => placed%units)
            same = a%length == b%length .and. a%force == b%force .and. a%deflection == b%deflection
        end associate
    end function same_units

    !> Zones of a state as a start for another position
    subroutine put_near(near, placed, ground, start, known)
        type(kept_type), intent(in) :: near
        !> The beam at that position, and its ground
        type(assembled_type), intent(in) :: placed
        type(ground_type), intent(in) :: ground
        type(ground_start_type), intent(out) :: start
        !> Has the state any
        logical, intent(out) :: known

        known = allocated(near%start%closed)
        if (known) call carry_zones(near%placed, near%start, placed, ground, start)
    end subroutine put_near

    !> What acts of every support
    pure subroutine describe(kept)
        type(kept_type), intent(inout) :: kept
        real(wp) :: past
        integer :: k, last, s, way
        logical :: held

        associate (placed => kept%placed, supports => kept%placed%beam%supports, models => kept%placed%model%supports)
            allocate (kept%acting(size(models)), kept%decided(size(models)))
            kept%acting(:) = acting_type(gapbeam_open, 0.0_wp, 0)
            kept%decided(:) = .true.
            k = 1
            do while (k <= size(supports))
                last = last_breakpoint(supports, k)
                s = placed%normal(k)
                if (is_smooth(models(s)%law)) then
                    call past_curve(placed, s, kept%state%deflection, kept%state%reaction, past, way)
                    held = past > 0.0_wp .or. (models(s)%side == gapbeam_both .and. .not. abs(models(s)%gap) > 0.0_wp)
                    if (models(s)%side /= gapbeam_both .or. .not. held) way = 1
                    held = held .and. abs(reaction_at(placed, kept%state%reaction, s)) > 0.0_wp
                    kept%acting(s) = acting_type(merge(gapbeam_branch + 1, gapbeam_open, held), merge(1.0_wp, 0.0_wp, held), way)
                else
                    kept%acting(s) = acting_piece(supports(k:last), models(s)%side, kept%state%closed(k:last))
                    kept%decided(s) = .not. any(kept%state%undecided(k:last))
                end if
                k = last + 1
            end do
        end associate
    end subroutine describe

    !> What is not decided is as it was before
    pure subroutine take_undecided(kept, before)
        type(kept_type), intent(inout) :: kept
        type(kept_type), intent(in) :: before

        if (kept%status /= gapbeam_solved .or. before%status /= gapbeam_solved) return
        where (.not. kept%decided .and. before%decided)
            kept%acting = before%acting
            kept%decided = .true.
        end where
    end subroutine take_undecided

    !> Does the same hold the beam, or not: the same supports, and as many zones with ends of the same kind
    pure function alike(one, other)
        type(kept_type), intent(in) :: one, other
        logical :: alike

        alike = one%status == other%status
        if (.not. alike .or. one%status /= gapbeam_solved) return
        alike = all((one%acting%condition == other%acting%condition .and. one%acting%way == other%acting%way) &
                    .or. .not. (one%decided .and. other%decided))
        if (alike .and. allocated(one%zones)) alike = same_zones(one%zones, other%zones)
    end function alike

    !> Take zones to the pieces of another beam: at the same places the same acts
    subroutine carry_zones(from, start, to, ground, carried)
        !> Where they were found, and what they are
        type(assembled_type), intent(in) :: from
        type(ground_start_type), intent(in) :: start
        !> The other beam, with the same ground, in the same units; and its ground
        type(assembled_type), intent(in) :: to
        type(ground_type), intent(in) :: ground
        type(ground_start_type), intent(out) :: carried
        real(wp), allocatable :: right(:)
        integer, allocatable :: steps(:)
        real(wp) :: slack
        integer :: i, j, m

        slack = at_end*end_of_beam(from)
        associate (zones => start%zones)
            allocate (right(size(zones%piece)), steps(size(ground%pieces)))
            do i = 1, size(right)
                right(i) = point_x(from, zones%piece(i))
                if (i == size(right)) cycle
                if (zones%piece(i + 1) == zones%piece(i)) then
                    right(i) = point_x(from, zones%piece(i) - 1) + scale(zones%to(i), from%units%length)
                end if
            end do
            do j = 1, size(steps)
                steps(j) = steps_of_piece(ground, j)
            end do
            call new_zones(sum(steps) + size(zones%piece), size(zones%acts, 1), steps, carried%zones)
        end associate
        allocate (carried%closed, source=start%closed)
        m = 0
        i = 1
        do j = 1, size(steps)
            call cut_piece(j)
        end do
        call resize(carried%zones, m, m)

    contains

        !> The stretches of a piece
        subroutine cut_piece(piece)
            integer, intent(in) :: piece
            real(wp) :: begin, left, next, step_end, length
            integer :: k, step

            begin = point_x(to, piece - 1)
            length = ground%pieces(piece)%length
            left = 0.0_wp
            step = 1
            do while (step <= steps(piece))
                do while (i < size(right))
                    if (right(i) > begin + scale(left, to%units%length) + slack) exit
                    i = i + 1
                end do
                k = last_alike(i, point_x(to, piece) - slack)
                next = length
                if (right(k) < point_x(to, piece) - slack) next = scale(right(k) - begin, -to%units%length)
                step_end = border_of_step(ground%pieces(piece), step, steps(piece))
                if (next >= step_end - scale(slack, -to%units%length)) then
                    next = step_end
                    step = step + 1
                end if
                if (m == size(carried%zones%piece)) call resize(carried%zones, 2*m, m)
                m = m + 1
                carried%zones%piece(m) = piece
                carried%zones%from(m) = left
                carried%zones%to(m) = next
                carried%zones%acts(:, m) = start%zones%acts(:, i)
                carried%zones%start(:, m) = start%zones%start(:, i)
                left = next
            end do
        end subroutine cut_piece

        !> The last stretch from one on, up to a place, in which the same acts
        pure function last_alike(first, until) result(last)
            integer, intent(in) :: first
            real(wp), intent(in) :: until
            integer :: last

            last = first
            do while (last < size(right))
                if (right(last) >= until) exit
                if (any(start%zones%acts(:, last + 1) /= start%zones%acts(:, first))) exit
                last = last + 1
            end do
        end function last_alike

    end subroutine carry_zones

end module gapbeam_train_states
