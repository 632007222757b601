!> Way to the top near a state of a train: by polynomials, by parabolas, or by golden sections where they lead nowhere.
module gapbeam_train_climb
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train_states, only: kept_type
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of, nearer_birth, find_vertex, find_highest
    use gapbeam_train_asked, only: asked_type, value_of
    use gapbeam_train_limits, only: ruler_of, solve_in_run
    use gapbeam_train_runs, only: runs_type
    implicit none
    private
    public :: peak_type, table_type, foretold_type, foretell, climb, alike_heights

    !> States on each side of one through which a polynomial goes, and all of them
    integer, parameter :: on_each_side = 3, nearest = 2*on_each_side + 1
    !> Share of the largest value by which a polynomial may be wrong at its top: the value there is better by half of the digits
    real(wp), parameter :: alike_heights = 1e-9_wp
    !> Parabolas after which the best state is taken; five or so do
    integer, parameter :: most_steps = 60
    !> Share of the distance of two states by which the last parabola moves the place at most
    real(wp), parameter :: settled = 2.0_wp**(-20)
    !> Share of the longer part that is tried where a parabola leads nowhere
    real(wp), parameter :: golden = (3 - sqrt(5.0_wp))/2
    !> An extreme value, and where it is
    type :: peak_type
        real(wp) :: value = 0.0_wp, x = 0.0_wp, position = 0.0_wp
        !> 1 left of x, 2 right of it, 0 both
        integer :: side = 0
        !> Ends and sag of a free span
        real(wp) :: span(3) = 0.0_wp
        !> Position of its state; is it only next to that
        real(wp) :: at = 0.0_wp
        logical :: is_limit = .false.
        !> Number of the state among those of the runs, or 0; then that of the hill on which it is the top
        integer :: state = 0, hill = 0
    end type peak_type

    !> Where polynomials through states have their top: the place as the angle of a ruler
    type :: foretold_type
        logical :: known = .false.
        real(wp) :: place = 0.0_wp, height = 0.0_wp, doubt = 0.0_wp
    end type foretold_type

    !> Values of the states of a run
    type :: table_type
        real(wp), allocatable :: at(:), value(:)
    end type table_type

contains

    !> Top near a state of the polynomials through its neighbours: on one side of a change values are smooth in the position, on the
    !> other in its root, and what is right of that nobody knows beforehand
    function foretell(table, k, ruler) result(best)
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(ruler_type), intent(in) :: ruler
        type(foretold_type) :: best, other

        best = top_of(table, k, ruler, ruler)
        if (.not. ruler%bears_zones .or. .not. best%known) return
        other = top_of(table, k, ruler_type(), ruler)
        if (.not. other%known) then
            best%known = .false.
            return
        end if
        associate (doubt => max(abs(best%height - other%height), best%doubt, other%doubt))
            if (other%height > best%height) best = other
            best%doubt = doubt
        end associate
    end function foretell

    !> The same in one measure
    function top_of(table, k, measure, ruler) result(top)
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(ruler_type), intent(in) :: measure, ruler
        type(foretold_type) :: top
        real(wp) :: at(nearest), place, other
        integer :: first, own, from, to, n

        n = size(table%at)
        if (n < nearest) return
        first = min(max(k - on_each_side, 1), n - nearest + 1)
        own = k - first + 1
        at(:) = angle_of(measure, table%at(first:first + nearest - 1))
        associate (heights => table%value(first:first + nearest - 1), left => at(max(own - 1, 1)), &
                   right => at(min(own + 1, nearest)))
            call find_highest(at, heights, left, right, place, top%height, top%known)
            if (.not. top%known) return
            from = merge(3, 2, own == nearest)
            if (own == 1) from = 1
            to = from + nearest - 3
            call find_highest(at(from:to), heights(from:to), left, right, top%place, other, top%known)
        end associate
        top%doubt = 4*abs(top%height - other)
        top%place = angle_of(ruler, position_of(measure, place))
    end function top_of

    !> Go to the top near a state by polynomials, by parabolas, or by golden sections where they lead nowhere; its own state becomes
    !> the top of the runs
    subroutine climb(assembled, runs, run, table, k, asked, foretold, enough, top, error)
        type(assembled_type), intent(in) :: assembled
        type(runs_type), intent(inout) :: runs
        !> The run, its values, and the state
        integer, intent(in) :: run
        type(table_type), intent(in) :: table
        integer, intent(in) :: k
        type(asked_type), intent(in) :: asked
        type(foretold_type), intent(in) :: foretold
        !> A value as near as this to that foretold is the top
        real(wp), intent(in) :: enough
        type(peak_type), intent(out) :: top
        type(error_type), allocatable, intent(out) :: error
        type(ruler_type) :: ruler
        type(kept_type), allocatable :: kept
        real(wp), allocatable :: at(:), heights(:)
        real(wp) :: left, right, width, best, last, place, height, best_height
        logical :: known, solved
        integer :: first, final, step

        ruler = ruler_of(assembled, runs, runs%runs(run))
        first = max(k - 2, 1)
        final = min(k + 2, size(table%at))
        allocate (at, source=angle_of(ruler, table%at(first:final)))
        allocate (heights, source=table%value(first:final))
        best = at(k - first + 1)
        best_height = table%value(k)
        top = peak_type(value=best_height, state=runs%runs(run)%states(k), at=table%at(k))
        if (allocated(runs%top%of)) deallocate (runs%top%of)
        left = at(max(k - 1, 1) - first + 1)
        right = at(min(k + 1, size(table%at)) - first + 1)
        width = right - left
        last = huge(last)
        if (foretold%known) then
            if (.not. any(abs(at - foretold%place) <= 0.0_wp)) then
                call try(foretold%place)
                if (allocated(error)) return
                if (solved) then
                    if (abs(heights(size(heights)) - foretold%height) <= enough) return
                end if
            end if
        end if
        do step = 1, most_steps
            call find_vertex(best, at, heights, left, right, place, height, known)
            if (.not. known .and. .not. (best > left .and. best < right) .and. size(at) > 2) then
                ! From an end of the run values fall, but what is nearer to the birth of a zone than any state may be greater
                call nearer_birth(best, left, right, width, ruler, place, known)
                if (.not. known) return
            else if (.not. known .or. abs(place - best) > last/2) then
                place = best + golden*merge(right - best, left - best, right - best > best - left)
            end if
            last = abs(place - best)
            if (any(abs(at - place) <= 0.0_wp) .or. last <= settled**2*width) return
            call try(place)
            if (allocated(error) .or. .not. solved .or. last <= settled*width) return
        end do

    contains

        !> Solve at a place, and take it
        subroutine try(there)
            real(wp), intent(in) :: there
            real(wp) :: value

            if (.not. allocated(kept)) allocate (kept)
            call solve_in_run(assembled, runs, runs%runs(run), position_of(ruler, there), kept, solved, error)
            if (allocated(error) .or. .not. solved) return
            call value_of(asked, kept, value, error)
            if (allocated(error)) return
            at = [at, there]
            heights = [heights, value]
            if (value >= best_height) then
                if (there > best) then
                    left = best
                else
                    right = best
                end if
                best = there
                best_height = value
                top = peak_type(value=value, at=kept%position)
                call move_alloc(kept, runs%top%of)
            else if (there > best) then
                right = there
            else
                left = there
            end if
        end subroutine try

    end subroutine climb

end module gapbeam_train_climb
