!> Shears between an axle and the support or force to which it comes, which are not there when it has come; and states of a run
!> at further positions.
module gapbeam_train_limits
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_solved
    use gapbeam_quantities, only: of_shear
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_query, only: fields_at_places
    use gapbeam_train_on_beam, only: end_of_beam, distance_at_end, acting_axles
    use gapbeam_train_grid, only: places_of_jumps
    use gapbeam_train_states, only: kept_type, solve_at, put_near, same_units, take_undecided
    use gapbeam_train_tops, only: ruler_type
    use gapbeam_train_runs, only: runs_type, run_type
    implicit none
    private
    public :: limit_type, find_limits, ruler_of, solve_in_run, start_on_way, shown_position

    !> Share of the beam by which an axle stands beside a support when the shear between both is asked for: nearer to it, hardly any
    !> digits of it would be left
    real(wp), parameter :: beside = 2.0_wp**(-26)

    !> Such a shear
    type :: limit_type
        real(wp) :: value = 0.0_wp
        !> Place of the support or force, and on which side of it the axle is
        real(wp) :: x = 0.0_wp
        logical :: at_left = .false.
        !> Number of the state with the axle on it, and a position beside it, at which the axle is on that side
        integer :: state = 0
        real(wp) :: position = 0.0_wp
    end type limit_type

contains

    !> All of them
    subroutine find_limits(assembled, runs, limits, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        type(limit_type), allocatable, intent(out) :: limits(:)
        !> As for fields_at_places
        type(error_type), allocatable, intent(out) :: error
        real(wp), allocatable :: jumps(:)
        real(wp) :: shear(1, 1), sign
        integer :: i, j, k
        logical :: at_left
        logical, allocatable :: there(:)

        allocate (limits(0), jumps(0))
        jumps = places_of_jumps(assembled)
        do i = 1, size(runs%runs)
            associate (states => runs%runs(i)%states)
                if (size(states) < 2) cycle
                do k = 1, 2
                    at_left = k == 2
                    sign = merge(-1.0_wp, 1.0_wp, at_left)
                    associate (kept => runs%boxes(states(merge(size(states), 1, at_left)))%of)
                        do j = 1, size(jumps)
                            there = kept%acts .and. abs(kept%position + runs%train%offset - jumps(j)) &
                                <= distance_at_end(assembled, runs%train)
                            if (.not. any(there)) cycle
                            call fields_at_places(kept%placed, kept%state, [of_shear], jumps(j:j), at_left, shear, error)
                            if (allocated(error)) return
                            limits = [limits, limit_type(shear(1, 1) + sign*sum(pack(runs%train%force, there)), jumps(j), at_left, &
                                                         states(merge(size(states), 1, at_left)), &
                                                         kept%position + sign*beside*end_of_beam(assembled))]
                        end do
                    end associate
                end do
            end associate
        end do
    end subroutine find_limits

    !> What positions of a run are measured by, so that values are smooth up to its ends: zones are born on the ground only
    pure function ruler_of(assembled, runs, run) result(ruler)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(in) :: runs
        type(run_type), intent(in) :: run
        type(ruler_type) :: ruler

        ruler%low = runs%boxes(run%states(1))%of%position
        ruler%high = runs%boxes(run%states(size(run%states)))%of%position
        ruler%bears_zones = allocated(assembled%layers) .and. ruler%high > ruler%low
    end function ruler_of

    !> Solve at a position of a run, near the nearest of its states
    subroutine solve_in_run(assembled, runs, run, position, kept, solved, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        type(run_type), intent(in) :: run
        real(wp), intent(in) :: position
        type(kept_type), intent(out) :: kept
        logical, intent(out) :: solved
        !> As for solve_at
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        i = minloc(abs([(runs%boxes(run%states(i))%of%position, i=1, size(run%states))] - position), 1)
        associate (near => runs%boxes(run%states(i))%of)
            call solve_at(assembled, runs%train, runs%rule, position, near%acts, kept, runs%solves, error, near)
            if (.not. allocated(error)) call take_undecided(kept, near)
        end associate
        solved = kept%status == gapbeam_solved
    end subroutine solve_in_run

    !> Where the search for the state at a position begins, so that it is the one to which the train comes on its way
    subroutine start_on_way(assembled, runs, position, placed, start, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        real(wp), intent(in) :: position
        !> The beam with the train on it
        type(assembled_type), intent(in) :: placed
        !> Not allocated where that is not known
        type(ground_start_type), allocatable, intent(out) :: start
        !> As for solve_at
        type(error_type), allocatable, intent(out) :: error
        type(kept_type) :: kept
        logical :: known
        integer :: k

        do k = 1, size(runs%runs)
            associate (states => runs%runs(k)%states)
                if (runs%boxes(states(1))%of%position > position) cycle
                if (runs%boxes(states(size(states)))%of%position < position) cycle
            end associate
            call solve_in_run(assembled, runs, runs%runs(k), position, kept, known, error)
            if (allocated(error) .or. .not. known) return
            if (.not. same_units(kept, placed)) return
            allocate (start)
            call put_near(kept, placed, ground_of(placed, 1.0_wp), start, known)
            if (.not. known) deallocate (start)
            return
        end do
    end subroutine start_on_way

    !> The next position at which the axles of a state are on the beam: its own but where an axle is just beside an end
    pure function shown_position(assembled, runs, kept) result(position)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(in) :: runs
        type(kept_type), intent(in) :: kept
        real(wp) :: position
        integer, parameter :: tried(*) = [0, -4, 4]
        integer :: i

        do i = 1, size(tried)
            position = kept%position + tried(i)*distance_at_end(assembled, runs%train)
            if (all(acting_axles(assembled, runs%train, position) .eqv. kept%acts)) return
        end do
        position = kept%position
    end function shown_position

end module gapbeam_train_limits
