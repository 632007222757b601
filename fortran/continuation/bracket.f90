!> First change between two points of a path: its own parameter, and states on both sides of it.
!>
!> Where the change is to be expected is computed (gapbeam_crossing); states next to that parameter tell whether it is so. What
!> cannot be computed, and where states end or begin, is found by bisection.
module gapbeam_bracket
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_zone_margin, only: change_type
    use gapbeam_path_problem, only: point_type, path_problem_type, crossing_type, copy_point
    use gapbeam_crossing, only: find_crossing
    implicit none
    private
    public :: bracket_change, make_sure

    !> States as near as this to the parameter of a change tell that it is one; where they do not, which may be so where zones begin
    !> without length, those so many times farther away; how often the parameter is computed anew where another change comes first
    real(wp), parameter :: nearest = 2.0_wp**(-38), wider = 64.0_wp, farthest = 2.0_wp**(-26)
    integer, parameter :: most_guesses = 8
    !> Distance of parameters at which it is enough to know that states between them cannot be settled
    real(wp), parameter :: near = 2.0_wp**(-44)
    !> Next to an event a state may not be settled, since a zone has next to no length there: parameters on both sides of it that
    !> are as near as the first are neighbours, and as near as the second if it takes that. It is where the lower one ends
    real(wp), parameter :: next_to = 2.0_wp**(-32), less_near = 2.0_wp**(-22)

contains

    !> Neighbours around the first change between two points, and the parameters and places of what changes there
    subroutine bracket_change(problem, earlier, below, above, at, place, misled, error)
        class(path_problem_type), intent(inout) :: problem
        !> A point not above the lower one from which on nothing was seen to change
        class(point_type), intent(in) :: earlier
        !> The points, not alike in; neighbours, not alike, out
        class(point_type), allocatable, intent(inout) :: below, above
        !> Of the changes between neighbours that stand, as they are listed: parameter, and place, below zero if not measured
        real(wp), allocatable, intent(out) :: at(:), place(:)
        !> Was one that was only looked at not so
        logical, intent(out) :: misled
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: far_below, far_above
        type(change_type), allocatable :: changes(:)
        type(crossing_type) :: crossing
        integer :: guesses, i
        logical :: found, ends

        found = .false.
        misled = .false.
        do guesses = 1, most_guesses
            call copy_point(below, far_below)
            call copy_point(above, far_above)
            call guess_crossing(problem, below, above, crossing, found)
            if (.not. found .and. earlier%at < below%at) then
                ! It may have happened next to the lower one already
                call guess_crossing(problem, earlier, above, crossing, found)
                if (found) found = crossing%at > below%at - farthest*problem%size_at(below%at)
                if (found) call copy_point(earlier, far_below)
            end if
            if (.not. found) exit
            call confirm(problem, crossing, below, above, found, error)
            if (allocated(error)) return
            if (found .or. .not. above%stands) exit
        end do
        ends = .false.
        if (.not. found) call bisect(problem, below, above, ends, error)
        if (allocated(error)) return
        call make_sure(problem, below, misled, error)
        if (allocated(error) .or. misled .or. .not. (below%stands .and. above%stands)) return
        call make_sure(problem, above, misled, error)
        if (allocated(error) .or. misled) return
        call problem%list_changes(below, above, changes)
        allocate (at(size(changes)), place(size(changes)))
        at(:) = merge(below%at, above%at, ends)
        place(:) = -1.0_wp
        if (.not. found) return
        at(:) = crossing%at
        do i = 1, size(changes)
            if (size(changes) > 1) then
                call find_crossing(problem, changes(i), far_below, far_above, crossing, found)
                if (found) call problem%refine(crossing, found)
                if (.not. found .or. abs(crossing%at - at(i)) > above%at - below%at) cycle
                at(i) = crossing%at
            end if
            if (changes(i)%to > changes(i)%from) place(i) = crossing%place
        end do
    end subroutine bracket_change

    !> Find a point for sure that was only looked at
    subroutine make_sure(problem, point, misled, error)
        class(path_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: point
        !> Is it not what it looked like
        logical, intent(out) :: misled
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: sure

        misled = .false.
        if (point%sure) return
        call problem%find(point%at, sure, error, point)
        if (allocated(error)) return
        misled = .not. problem%alike(point, sure)
        call move_alloc(sure, point)
    end subroutine make_sure

    !> Where the first change between two points is to be expected
    subroutine guess_crossing(problem, below, above, first, found)
        class(path_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: below, above
        type(crossing_type), intent(inout) :: first
        !> Is anything known of it
        logical, intent(out) :: found
        type(change_type), allocatable :: changes(:)
        type(crossing_type) :: crossing
        logical :: known
        integer :: i

        found = .false.
        if (.not. (below%stands .and. above%stands)) return
        call problem%list_changes(below, above, changes)
        do i = 1, size(changes)
            call find_crossing(problem, changes(i), below, above, crossing, known)
            if (.not. known) cycle
            if (found) then
                if (.not. crossing%at < first%at) cycle
            end if
            first%change = crossing%change
            first%at = crossing%at
            first%slope = crossing%slope
            first%one_further = crossing%one_further
            first%place = crossing%place
            call move_alloc(crossing%near, first%near)
            found = .true.
        end do
        if (found) call problem%refine(first, found)
        found = found .and. first%at > below%at .and. first%at < above%at
    end subroutine guess_crossing

    !> Is a crossing that of the first change between two points: states just below and just above it tell
    subroutine confirm(problem, crossing, below, above, found, error)
        class(path_problem_type), intent(inout) :: problem
        type(crossing_type), intent(in) :: crossing
        !> As for bracket_change
        class(point_type), allocatable, intent(inout) :: below, above
        logical, intent(out) :: found
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: between, first
        real(wp) :: size, reach
        logical :: others, like_both

        found = .false.
        call copy_point(below, first)
        size = problem%size_at(crossing%at)
        reach = nearest*size
        do while (crossing%at - reach > below%at)
            call problem%find(crossing%at - reach, between, error, crossing%near)
            if (allocated(error)) return
            like_both = .false.
            if (.not. allocated(between%trouble)) then
                others = .not. problem%alike(between, above)
                if (.not. problem%alike(below, between)) then
                    ! There is another change before, or states do not tell so near to it
                    call move_alloc(between, above)
                    if (others) return
                else if (others) then
                    call move_alloc(between, below)
                    exit
                else
                    like_both = .true.
                end if
            end if
            reach = wider*reach
            ! What is like both is undecided: farther away it is not
            if (reach > farthest*size .and. .not. like_both) return
        end do
        reach = nearest*size
        do while (crossing%at + reach < above%at)
            call problem%find(crossing%at + reach, between, error, crossing%near)
            if (allocated(error)) return
            if (allocated(between%trouble) .and. above%stands) then
                call come_down(problem, crossing%at, reach, below, above, error)
                if (allocated(error)) return
                if (above%at - crossing%at <= less_near*size) exit
            end if
            like_both = .false.
            if (.not. allocated(between%trouble)) then
                ! In the lower one what is about to change may be undecided, and so like everything
                others = .not. problem%alike(below, between)
                if (.not. others) others = .not. problem%alike(first, between)
                if (others) then
                    call move_alloc(between, above)
                    exit
                end if
                like_both = problem%alike(between, above)
                if (.not. like_both) call move_alloc(between, below)
            end if
            reach = wider*reach
            if (reach > farthest*size .and. .not. like_both) return
        end do
        found = above%stands
    end subroutine confirm

    !> Where states just above a parameter cannot be settled, they may be from others farther above it: nearer and nearer to it
    subroutine come_down(problem, to, reach, below, above, error)
        class(path_problem_type), intent(inout) :: problem
        !> That parameter, and how near to it is near enough
        real(wp), intent(in) :: to, reach
        !> A point below it
        class(point_type), intent(in) :: below
        !> One above it that is not like that in, the nearest one out
        class(point_type), allocatable, intent(inout) :: above
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: nearer
        real(wp) :: next

        next = to + max(reach, (above%at - to)/4)
        do while (next < above%at)
            call problem%find(next, nearer, error, above)
            if (allocated(error)) return
            if (.not. nearer%stands .or. problem%alike(below, nearer)) return
            call move_alloc(nearer, above)
            next = to + max(reach, (above%at - to)/4)
        end do
    end subroutine come_down

    !> Neighbours around the first change between two points
    subroutine bisect(problem, below, above, ends, error)
        class(path_problem_type), intent(inout) :: problem
        !> As for bracket_change
        class(point_type), allocatable, intent(inout) :: below, above
        !> Is the change where states like the lower one end, and those just above cannot be settled
        logical, intent(out) :: ends
        !> As for find
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: between, standing
        real(wp) :: middle, width, size
        !> May what cannot be settled from the lower point be settled from one above it
        logical :: comes_down

        ends = .false.
        comes_down = .true.
        do
            if (above%stands) call copy_point(above, standing)
            width = above%at - below%at
            middle = below%at + width/2
            if (middle <= below%at .or. middle >= above%at) exit
            size = problem%size_at(above%at)
            if (width <= problem%neighbours*size) exit
            if (.not. above%stands) then
                if (allocated(above%trouble) .and. width <= near*size) exit
                if (width <= problem%neighbours_at_end*size) exit
            end if
            call problem%find(middle, between, error, below)
            if (allocated(error)) return
            if (allocated(between%trouble) .and. allocated(standing) .and. comes_down) then
                comes_down = standing%at - below%at > next_to*size
                if (comes_down) call problem%find(middle, between, error, standing)
                if (allocated(error)) return
                comes_down = comes_down .and. .not. allocated(between%trouble)
            end if
            if (problem%alike(below, between)) then
                call move_alloc(between, below)
            else
                call move_alloc(between, above)
            end if
        end do
        if (above%stands .or. .not. allocated(above%trouble) .or. .not. allocated(standing)) return
        ends = standing%at - below%at <= less_near*problem%size_at(standing%at)
        if (ends) call move_alloc(standing, above)
    end subroutine bisect

end module gapbeam_bracket
