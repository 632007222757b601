!> The one walk along a path whose states are found by a solve at each value of its parameter (gapbeam_path_problem).
!>
!> From stop to stop states are compared. Where what holds the beam differs between two, the changes between them are found one
!> after the other (gapbeam_bracket), recorded, and gone beyond. Changes that undo each other between two stops are not seen.
module gapbeam_walk
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_path_problem, only: point_type, path_problem_type, copy_point
    use gapbeam_bracket, only: bracket_change, make_sure
    implicit none
    private
    public :: walk_along

    !> Changes between two stops, beyond which they are not told apart
    integer, parameter :: most_changes = 10000

contains

    !> Go along a path from a point to its end, or to where the problem ends it
    subroutine walk_along(problem, start, ended, error)
        class(path_problem_type), intent(inout) :: problem
        !> By find, and taken already
        class(point_type), intent(in) :: start
        !> Has the path ended before its last parameter
        logical, intent(out) :: ended
        !> As for find, or changes that cannot be told apart
        type(error_type), allocatable, intent(out) :: error
        !> The point come to, the one before it or the same, the next stop, and where it was last sure
        class(point_type), allocatable :: now, earlier, next, sure
        logical :: carefully, misled

        call copy_point(start, now)
        call copy_point(start, earlier)
        call copy_point(start, sure)
        ended = .false.
        carefully = .false.
        do while (now%at < problem%last)
            if (carefully) then
                call problem%find(problem%next_stop(now), next, error, now)
            else
                call problem%look(problem%next_stop(now), now, next, error)
            end if
            if (allocated(error)) return
            call pass_changes(problem, now, earlier, next, sure, misled, ended, error)
            if (allocated(error) .or. ended) return
            if (misled) then
                ! What it looked like is not so: from where it was sure on, nothing is only looked at
                carefully = .true.
                call copy_point(sure, now)
                call copy_point(sure, earlier)
            else if (now%at < next%at) then
                call problem%take(next, error)
                if (allocated(error)) return
                call move_alloc(now, earlier)
                call move_alloc(next, now)
            end if
        end do
    end subroutine walk_along

    !> Record the changes up to the next stop
    subroutine pass_changes(problem, now, earlier, next, sure, misled, ended, error)
        !> As for walk_along
        class(path_problem_type), intent(inout) :: problem
        class(point_type), allocatable, intent(inout) :: now, earlier, next, sure
        !> Was a point that was only looked at not so
        logical, intent(out) :: misled
        logical, intent(inout) :: ended
        type(error_type), allocatable, intent(out) :: error
        class(point_type), allocatable :: below, above, again
        real(wp), allocatable :: at(:), place(:)
        integer :: number
        logical :: goes_on

        misled = .false.
        do number = 1, most_changes
            if (problem%alike(now, next)) return
            if (number > 1 .and. .not. next%at < problem%last) then
                ! What touches at the end is taken as it was next to that, which a change has changed
                call problem%find(next%at, again, error, now)
                if (allocated(error)) return
                if (problem%alike(now, again)) then
                    call move_alloc(again, next)
                    return
                end if
            end if
            call copy_point(now, below)
            call copy_point(next, above)
            if (below%stands .and. .not. above%stands) then
                call make_sure(problem, below, misled, error)
                if (allocated(error) .or. misled) return
                call problem%approach_end(below, above, ended, error)
                if (allocated(error) .or. ended) return
            end if
            call bracket_change(problem, earlier, below, above, at, place, misled, error)
            if (allocated(error) .or. misled) return
            if (below%at > now%at) call problem%take(below, error)
            if (allocated(error)) return
            if (below%stands .and. .not. above%stands) then
                call problem%take_end(below, above, goes_on, error)
                ended = .not. goes_on
                if (allocated(error) .or. ended) return
            else if (below%stands) then
                call problem%take_changes(below, above, at, place, error)
                if (allocated(error)) return
            end if
            call problem%take(above, error)
            if (allocated(error)) return
            call copy_point(above, now)
            call copy_point(above, earlier)
            call copy_point(above, sure)
            if (.not. above%at < next%at) return
        end do
        call fatal_error(error, gapbeam_not_converged, "changes near "//problem%parameter//" "//trim(shown(now%at))// &
                         " are too many to be told apart")
    end subroutine pass_changes

end module gapbeam_walk
