!> Whether a train that goes to the left comes to the states that it comes to on its way to the right.
!>
!> Under compression a beam may have several stable states. A train that passes it keeps to one branch of them until the beam snaps
!> to another one, so states depend on the way. Where no two neighbours are apart, and the last state is that to which axial forces
!> lead as they grow, the way back is the same.
module gapbeam_train_reversal
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input, gapbeam_solved, gapbeam_buckles
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_uniqueness, only: is_one_branch
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_train_states, only: kept_type, solve_at, put_near, same_units
    use gapbeam_train_problem, only: train_problem_type
    implicit none
    private
    public :: are_some_of_several, refuse_other_way

contains

    !> Are there other states than those of a train on its way, for all that is known
    pure function are_some_of_several(problem) result(they_are)
        type(train_problem_type), intent(in) :: problem
        logical :: they_are
        integer :: i

        they_are = .false.
        do i = 1, problem%states
            associate (kept => problem%boxes(i)%of)
                if (kept%status == gapbeam_buckles) they_are = .true.
                if (kept%status /= gapbeam_solved .or. .not. allocated(kept%state%ground)) cycle
                they_are = they_are .or. .not. kept%state%ground%unique
            end associate
        end do
    end function are_some_of_several

    !> Refuse a train that goes to the left where it would come to other states than on its way to the right, or may
    subroutine refuse_other_way(problem, error)
        !> Walked to the right, over a beam that may have several states
        type(train_problem_type), intent(inout) :: problem
        !> As for solve_at, or it may
        type(error_type), allocatable, intent(out) :: error
        type(kept_type) :: there
        integer :: i, number, last

        last = 0
        do i = 1, problem%length
            number = problem%way(i)
            if (number < 0) then
                call compare(problem%crossings(-number)%below)
                number = problem%crossings(-number)%above
            end if
            if (.not. allocated(error)) call compare(number)
            if (allocated(error)) return
        end do
        associate (kept => problem%boxes(last)%of)
            call solve_at(problem%assembled, problem%train, problem%rule, kept%position, kept%acts, there, problem%solves, error)
            if (allocated(error)) return
            if (.not. are_on_one_branch(there, kept)) call refuse(error)
        end associate

    contains

        !> Go on to a state
        subroutine compare(next)
            integer, intent(in) :: next

            if (last > 0) then
                if (.not. are_on_one_branch(problem%boxes(last)%of, problem%boxes(next)%of)) call refuse(error)
            else if (problem%boxes(next)%of%status == gapbeam_buckles) then
                call refuse(error)
            end if
            last = next
        end subroutine compare

    end subroutine refuse_other_way

    !> Are two states at neighbouring positions on one branch for sure, or both none because the beam tips
    function are_on_one_branch(one, other) result(they_are)
        type(kept_type), intent(in) :: one, other
        logical :: they_are
        type(ground_start_type) :: start
        type(ground_type) :: ground

        they_are = all([one%status, other%status] /= gapbeam_buckles)
        if (.not. they_are .or. any([one%status, other%status] /= gapbeam_solved)) return
        they_are = same_units(one, other%placed)
        if (.not. they_are) return
        ground = ground_of(other%placed, 1.0_wp, other%state)
        call put_near(one, other%placed, ground, start, they_are)
        if (they_are) they_are = is_one_branch(ground, start, other%start, 1.0_wp)
    end function are_on_one_branch

    !> Say that the way back would be another one
    pure subroutine refuse(error)
        type(error_type), allocatable, intent(out) :: error

        call fatal_error(error, gapbeam_bad_input, "goes to the left over a beam that its compression lets snap or buckle on "// &
                         "the way, so that it would come to other states than on its way to the right, which is not "// &
                         "available in this version; mirror the beam")
    end subroutine refuse

end module gapbeam_train_reversal
