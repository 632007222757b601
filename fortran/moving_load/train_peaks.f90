!> Largest and smallest values over all positions of a train, from states at some of them.
!>
!> Between two changes values are smooth in the position, so around every state that may be near an extreme value polynomials
!> and parabolas lead to it: an error d of the position makes one of d**2 of the value; in the angle of gapbeam_train_tops on the
!> ground.
module gapbeam_train_peaks
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_extreme_ties
    use gapbeam_path_tolerances, only: train_equal
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_query, only: fields_at_places
    use gapbeam_train_asked, only: asked_type, of_field, value_of, keep_extremes
    use gapbeam_train_limits, only: limit_type, ruler_of, shown_position
    use gapbeam_train_climb, only: peak_type, table_type, foretold_type, foretell, climb, alike_heights
    use gapbeam_train_states, only: box_type, kept_type
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: peak_type, find_peaks

    !> What values gain above the states by no more than this share of them is rounding
    real(wp), parameter :: rounding = 2.0_wp**(-46)
    !> Fields jump at a place where they differ on its sides by more than this share
    real(wp), parameter :: jumps = 2.0_wp**(-40)

    !> A state around which values may be greater
    type :: hill_type
        real(wp) :: reach = 0.0_wp
        integer :: run = 0, k = 0
    end type hill_type

contains

    !> The largest value over all positions, with all ties, in ascending order of the position
    subroutine find_peaks(assembled, runs, asked, limits, peaks, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        type(asked_type), intent(in) :: asked
        !> Values besides
        type(limit_type), intent(in) :: limits(:)
        !> None where no position is solved
        type(peak_type), allocatable, intent(out) :: peaks(:)
        !> As for value_of and solve_at
        type(error_type), allocatable, intent(out) :: error
        type(table_type), allocatable :: tables(:)
        type(hill_type), allocatable :: hills(:)
        type(peak_type), allocatable :: found(:)
        type(box_type), allocatable :: tops(:)
        type(kept_type), allocatable :: kept
        type(peak_type) :: top
        type(foretold_type) :: foretold
        real(wp) :: best, scale_of, step
        integer :: i, k

        allocate (peaks(0), found(0))
        if (size(runs%runs) == 0) return
        call fill_tables(runs, asked, tables, error)
        if (allocated(error)) return
        scale_of = 0.0_wp
        best = -huge(best)
        do i = 1, size(tables)
            scale_of = max(scale_of, maxval(abs(tables(i)%value)))
            best = max(best, maxval(tables(i)%value))
        end do
        do i = 1, size(limits)
            associate (value => merge(-limits(i)%value, limits(i)%value, asked%smallest))
                best = max(best, value)
                found = [found, peak_type(value=value, x=limits(i)%x, position=limits(i)%position, state=limits(i)%state, &
                                          side=merge(1, 2, limits(i)%at_left), is_limit=.true., &
                                          at=runs%boxes(limits(i)%state)%of%position)]
            end associate
        end do
        step = longest_step(tables)
        call find_hills(assembled, runs, tables, limits, asked, scale_of, best, found, hills)
        allocate (tops(size(hills)))
        do i = 1, size(hills)
            k = maxloc(hills%reach, 1)
            if (hills(k)%reach < best) exit
            hills(k)%reach = -huge(best)
            associate (run => runs%runs(hills(k)%run), table => tables(hills(k)%run))
                foretold = foretell(table, hills(k)%k, ruler_of(assembled, runs, run))
                if (foretold%known .and. foretold%height + foretold%doubt < best - train_equal*max(abs(best), scale_of)) cycle
                call climb(assembled, runs, hills(k)%run, table, hills(k)%k, asked, foretold, alike_heights*scale_of, top, error)
                if (allocated(error)) return
            end associate
            if (top%state > 0 .and. any(limits%state == top%state)) cycle
            top%hill = i
            call move_alloc(runs%top%of, tops(i)%of)
            found = [found, top]
            best = max(best, top%value)
        end do
        call take_ties(best - train_equal*max(abs(best), scale_of), step, found, peaks)
        do i = 1, size(peaks)
            if (peaks(i)%is_limit) then
                if (asked%smallest) peaks(i)%value = -peaks(i)%value
                cycle
            end if
            associate (box => runs%boxes(max(peaks(i)%state, 1)), is_top => peaks(i)%state == 0)
                if (is_top) then
                    call move_alloc(tops(peaks(i)%hill)%of, kept)
                else
                    call move_alloc(box%of, kept)
                end if
                call place_peak(assembled, runs, asked, kept, peaks(i), error)
                if (.not. is_top) call move_alloc(kept, box%of)
            end associate
            if (allocated(error)) return
        end do
    end subroutine find_peaks

    !> Values of all states
    subroutine fill_tables(runs, asked, tables, error)
        type(runs_type), intent(inout) :: runs
        type(asked_type), intent(in) :: asked
        type(table_type), allocatable, intent(out) :: tables(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i, k

        allocate (tables(size(runs%runs)))
        do i = 1, size(tables)
            associate (states => runs%runs(i)%states)
                allocate (tables(i)%at(size(states)), tables(i)%value(size(states)))
                do k = 1, size(states)
                    tables(i)%at(k) = runs%boxes(states(k))%of%position
                    if (asked%of == of_field) call keep_extremes(runs%boxes(states(k))%of, error)
                    if (.not. allocated(error)) call value_of(asked, runs%boxes(states(k))%of, tables(i)%value(k), error)
                    if (allocated(error)) return
                end do
            end associate
        end do
    end subroutine fill_tables

    !> How far values are from straight lines, about, at all states but the ends
    pure function bends(at, value) result(found)
        real(wp), intent(in) :: at(:), value(:)
        real(wp) :: found(2:size(at) - 1), widths(size(at) - 1), slopes(size(at) - 1)
        integer :: n

        n = size(at)
        widths(:) = at(2:) - at(:n - 1)
        slopes(:) = (value(2:) - value(:n - 1))/widths
        found(:) = abs(slopes(2:) - slopes(:n - 2))*max(widths(2:), widths(:n - 2))
    end function bends

    !> The longest way between two states that follow each other
    pure function longest_step(tables) result(step)
        type(table_type), intent(in) :: tables(:)
        real(wp) :: step
        integer :: i

        step = 0.0_wp
        do i = 1, size(tables)
            associate (at => tables(i)%at)
                if (size(at) > 1) step = max(step, maxval(at(2:) - at(:size(at) - 1)))
            end associate
        end do
    end function longest_step

    !> States with values that are the largest so far, and those around which there may be greater ones
    subroutine find_hills(assembled, runs, tables, limits, asked, scale_of, best, found, hills)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(in) :: runs
        !> Values; those at the ends become the limits there, if these are greater
        type(table_type), intent(inout) :: tables(:)
        type(limit_type), intent(in) :: limits(:)
        type(asked_type), intent(in) :: asked
        !> Size of the values, and the largest one so far
        real(wp), intent(in) :: scale_of, best
        !> They are added
        type(peak_type), allocatable, intent(inout) :: found(:)
        type(hill_type), allocatable, intent(out) :: hills(:)
        real(wp) :: most, step, few
        integer :: i, k, n

        allocate (hills(0))
        most = -1.0_wp
        do i = 1, size(tables)
            if (size(tables(i)%at) > 2) most = max(most, maxval(bends(tables(i)%at, tables(i)%value)))
        end do
        if (most < 0.0_wp) most = abs(best)
        step = longest_step(tables)
        do i = 1, size(tables)
            n = size(tables(i)%at)
            call add_tops(runs, i, tables(i), best - train_equal*max(abs(best), scale_of), found)
            do k = 1, size(limits)
                associate (value => merge(-limits(k)%value, limits(k)%value, asked%smallest), ends => runs%runs(i)%states)
                    if (.not. limits(k)%at_left .and. limits(k)%state == ends(1)) then
                        tables(i)%value(1) = max(tables(i)%value(1), value)
                    end if
                    if (limits(k)%at_left .and. limits(k)%state == ends(n)) tables(i)%value(n) = max(tables(i)%value(n), value)
                end associate
            end do
            few = 0.0_wp
            if (step > 0.0_wp) few = most*min((tables(i)%at(n) - tables(i)%at(1))/step, 1.0_wp)
            call add_hills(i, few)
        end do

    contains

        !> States of a run around which values may be greater than there, and by how much at most, about
        subroutine add_hills(run, gain)
            integer, intent(in) :: run
            !> Where there are but two states
            real(wp), intent(in) :: gain
            real(wp), allocatable :: bend(:)

            associate (value => tables(run)%value)
                if (n < 2) return
                if (n == 2) then
                    call add(run, maxloc(value, 1), gain)
                    return
                end if
                allocate (bend(2:n - 1), source=bends(tables(run)%at, value))
                do k = 2, n - 1
                    if (value(k) >= value(k - 1) .and. value(k) >= value(k + 1)) call add(run, k, bend(k))
                end do
                ! At an end only where the way down from it does not begin at once; where zones are born three states do not tell
                if (may_rise(value(1) - value(2), bend(2))) call add(run, 1, bend(2))
                if (may_rise(value(n) - value(n - 1), bend(n - 1))) call add(run, n, bend(n - 1))
            end associate
        end subroutine add_hills

        !> May values be greater next to an end
        pure function may_rise(down, bend)
            real(wp), intent(in) :: down, bend
            logical :: may_rise

            may_rise = down >= 0.0_wp .and. (allocated(assembled%layers) .or. down <= bend)
        end function may_rise

        !> One more
        subroutine add(run, k, gain)
            integer, intent(in) :: run, k
            real(wp), intent(in) :: gain

            if (gain > rounding*scale_of) hills = [hills, hill_type(tables(run)%value(k) + gain, run, k)]
        end subroutine add

    end subroutine find_hills

    !> The states of a run with values from one on, of those side by side the greatest
    pure subroutine add_tops(runs, run, table, least, found)
        type(runs_type), intent(in) :: runs
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        real(wp), intent(in) :: least
        type(peak_type), allocatable, intent(inout) :: found(:)
        type(peak_type) :: top
        integer :: before, k

        before = -1
        do k = 1, size(table%value)
            if (table%value(k) < least) cycle
            top = peak_type(value=table%value(k), state=runs%runs(run)%states(k), at=table%at(k))
            if (k == before + 1) then
                if (top%value > found(size(found))%value) found(size(found)) = top
            else
                found = [found, top]
            end if
            before = k
        end do
    end subroutine add_tops

    !> Those that tie, in ascending order; of ties at neighbouring states the one with the greatest value
    subroutine take_ties(least, step, found, peaks)
        !> What is below this is none
        real(wp), intent(in) :: least
        !> The longest way between two states
        real(wp), intent(in) :: step
        type(peak_type), intent(in) :: found(:)
        type(peak_type), allocatable, intent(inout) :: peaks(:)
        real(wp), allocatable :: at(:)
        type(peak_type) :: one
        integer :: i, k
        logical :: beside

        allocate (at(size(found)), source=found%at)
        where (found%value < least) at = huge(at)
        do i = 1, size(found)
            k = minloc(at, 1)
            if (at(k) >= huge(at)) exit
            at(k) = huge(at)
            one = found(k)
            beside = size(peaks) > 0
            if (beside) then
                associate (last => peaks(size(peaks)))
                    beside = .not. (last%is_limit .or. one%is_limit) .and. one%at - last%at <= step
                    if (beside .and. one%value > last%value) peaks(size(peaks)) = one
                end associate
            end if
            if (.not. beside .and. size(peaks) < most_extreme_ties) peaks = [peaks, one]
        end do
    end subroutine take_ties

    !> Place and side of a peak, and the position that is shown
    subroutine place_peak(assembled, runs, asked, kept, peak, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(in) :: runs
        type(asked_type), intent(in) :: asked
        !> Its state
        type(kept_type), intent(inout) :: kept
        type(peak_type), intent(inout) :: peak
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: value, sides(1, 2)

        peak%position = shown_position(assembled, runs, kept)
        call value_of(asked, kept, value, error, peak%x, peak%span)
        if (allocated(error)) return
        if (asked%of == of_field) then
            call fields_at_places(kept%placed, kept%state, [asked%number], [peak%x], .true., sides(:, 1:1), error)
            if (.not. allocated(error)) then
                call fields_at_places(kept%placed, kept%state, [asked%number], [peak%x], .false., sides(:, 2:2), error)
            end if
            if (allocated(error)) return
            if (asked%smallest) sides(:, :) = -sides
            if (abs(sides(1, 2) - sides(1, 1)) > jumps*abs(peak%value)) then
                peak%side = merge(1, 2, abs(sides(1, 1) - peak%value) < abs(sides(1, 2) - peak%value))
            end if
        end if
        if (asked%smallest) peak%value = -peak%value
    end subroutine place_peak

end module gapbeam_train_peaks
