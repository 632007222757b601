!> The walk along a path whose states are found by a solve at each parameter: changes at known parameters, two so near to each
!> other that no state tells them apart, a stretch without states, one that rounding leaves undecided, and a look that misleads.
program test_walk
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use walk_sample, only: sample_type, sample_point_type
    use gapbeam_path_problem, only: point_type
    use gapbeam_walk, only: walk_along
    implicit none
    integer :: status

    call all_changes()
    call ends_at_a_limit()
    call not_misled()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Walk from 0 to 4
    subroutine walk(sample, ended)
        type(sample_type), intent(inout) :: sample
        logical, intent(out) :: ended
        class(point_type), allocatable :: start
        type(error_type), allocatable :: error

        sample%last = 4.0_wp
        sample%parameter = "time"
        call sample%find(0.0_wp, start, error)
        call walk_along(sample, start, ended, error)
        call check(.not. allocated(error), "no error")
    end subroutine walk

    !> Changes at sqrt(2), twice at 2.1, and beyond the stretch without states
    subroutine all_changes()
        type(sample_type) :: sample
        logical :: ended

        sample%goes_on = .true.
        call walk(sample, ended)
        call check(.not. ended, "goes on beyond the stretch without states")
        call check(sample%number == 4, "as many changes as there are")
        call check(all(sample%support(:4) == [1, 2, 3, 4]), "each of them its own")
        call check_close(sample%changed_at(:4), [sqrt(2.0_wp), 2.1_wp, 2.1_wp + 2.0_wp**(-40), 3.8_wp], "where they happen", &
                         relative=1e-14_wp)
        call check_close(sample%from, 3.0_wp, "where states end", relative=4*epsilon(1.0_wp))
        call check_close(sample%until, 3.5_wp, "where they begin again", relative=4*epsilon(1.0_wp))
        call check(sample%ascending, "points are recorded in ascending order")
    end subroutine all_changes

    !> The path ends where the problem ends it
    subroutine ends_at_a_limit()
        type(sample_type) :: sample
        logical :: ended

        call walk(sample, ended)
        call check(ended .and. sample%number == 3, "the path ends with its states")
        call check(.not. sample%until > 0.0_wp, "nothing is recorded beyond")
    end subroutine ends_at_a_limit

    !> From the state that was sure on, nothing is only looked at
    subroutine not_misled()
        type(sample_type) :: sample
        logical :: ended

        sample%goes_on = .true.
        sample%misleads = .true.
        call walk(sample, ended)
        call check(sample%number == 4, "a look that misleads makes no change")
        call check_close(sample%changed_at(1), sqrt(2.0_wp), "and hides none", relative=1e-14_wp)
    end subroutine not_misled

end program test_walk
