!> Are foundations possible, each alone: their moduli, gaps, profiles and laws
module gapbeam_check_foundations
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_words, only: shown, whole, pair
    use gapbeam_scene, only: model_type, foundation_type, ground_point_type, ground_law_point_type, gapbeam_both, gapbeam_below, &
        gapbeam_above, gapbeam_unchanged, gapbeam_law_by_points
    use gapbeam_places, only: position_tolerance
    use gapbeam_refusal, only: refuse, of_foundations, not_expected, bad_law
    use gapbeam_check_ground_laws, only: check_ground_law
    use gapbeam_check, only: entry_type, check_stretch, refuse_entry, refuse_number
    implicit none
    private
    public :: check_foundations, find_runs, at_right

contains

    !> All foundations
    pure subroutine check_foundations(model, end, error)
        !> With all arrays allocated
        type(model_type), intent(in) :: model
        !> The beam's right end
        real(wp), intent(in) :: end
        !> Bad input, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer :: first(size(model%foundations)), last(size(model%foundations))
        integer :: law_first(size(model%foundations)), law_last(size(model%foundations))
        integer :: i, n

        n = size(model%foundations)
        call check_runs(model%ground%foundation, n, "profile", error)
        if (.not. allocated(error)) call check_runs(model%ground_law%foundation, n, "law", error)
        if (allocated(error)) return
        call find_runs(model%ground%foundation, first, last)
        call find_runs(model%ground_law%foundation, law_first, law_last)
        do i = 1, n
            call check_foundation(model%foundations(i), model%ground(first(i):last(i)), &
                                  model%ground_law(law_first(i):law_last(i)), entry_type(of_foundations, i, n), end, error)
            if (allocated(error)) return
        end do
    end subroutine check_foundations

    !> First and last entry of each owner in a list in which those of one stand beside each other
    pure subroutine find_runs(owner, first, last)
        !> Numbers from 1
        integer, intent(in) :: owner(:)
        !> The last is before the first if there is none, shape (number of owners)
        integer, intent(out) :: first(:), last(:)
        integer :: i

        first(:) = 1
        last(:) = 0
        do i = 1, size(owner)
            associate (k => owner(i))
                if (last(k) == 0) first(k) = i
                last(k) = i
            end associate
        end do
    end subroutine find_runs

    !> A number at the right end of a foundation, where none is given that at the left
    elemental function at_right(value, right) result(number)
        real(wp), intent(in) :: value, right
        real(wp) :: number

        number = right
        if (right >= gapbeam_unchanged .and. right <= gapbeam_unchanged) number = value
    end function at_right

    !> Do points belong to foundations that exist, and stand those of one beside each other
    pure subroutine check_runs(owner, count, key, error)
        !> Foundation of every point
        integer, intent(in) :: owner(:)
        !> Number of foundations, and whether it is profile or law
        integer, intent(in) :: count
        character(len=*), intent(in) :: key
        type(error_type), allocatable, intent(out) :: error
        logical :: seen(count)
        integer :: i, before

        seen(:) = .false.
        before = 0
        do i = 1, size(owner)
            if (owner(i) < 1 .or. owner(i) > count) then
                call refuse(error, of_foundations, 1, count, bad_law, key, "a point belongs to a foundation that does not exist")
                return
            end if
            if (owner(i) == before) cycle
            before = owner(i)
            if (seen(owner(i))) then
                call refuse(error, of_foundations, owner(i), count, bad_law, key, "its points must stand beside each other")
                return
            end if
            seen(owner(i)) = .true.
        end do
    end subroutine check_runs

    !> One foundation; that its stretch has a length is seen when its ends are points
    pure subroutine check_foundation(f, profile, law, here, end, error)
        type(foundation_type), intent(in) :: f
        type(ground_point_type), intent(in) :: profile(:)
        type(ground_law_point_type), intent(in) :: law(:)
        type(entry_type), intent(in) :: here
        real(wp), intent(in) :: end
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: k(2), gap(2)

        call check_stretch(f%from, f%to, here, end, error)
        if (allocated(error)) return
        k = [f%k, at_right(f%k, f%k_to)]
        gap = [f%gap, at_right(f%gap, f%gap_to)]
        if (any(k > huge(1.0_wp))) then
            call refuse_entry(error, here, "k", bad_law, "expected a finite number, got inf; rigid ground is not "// &
                              "available, use supports")
        else if (.not. all(k >= 0.0_wp)) then
            call refuse_number(error, here, "k", k(merge(2, 1, k(1) >= 0.0_wp)), "a finite number, 0 or more")
        else if ((size(law) > 0 .or. f%law /= gapbeam_law_by_points) .and. any(k > 0.0_wp)) then
            call refuse_entry(error, here, "", bad_law, "has both k and law; give one of the two")
        else if (size(law) > 0 .and. f%law /= gapbeam_law_by_points) then
            call refuse_entry(error, here, "law", bad_law, "has both points and parameters; give one of the two")
        else if (size(law) == 0 .and. f%law == gapbeam_law_by_points .and. .not. any(k > 0.0_wp)) then
            call refuse_entry(error, here, "k", bad_law, "with a modulus of 0 it never carries; remove it")
        else if (all(f%side /= [gapbeam_both, gapbeam_below, gapbeam_above])) then
            call refuse_entry(error, here, "side", not_expected, &
                              "expected 0 (both), 1 (below) or -1 (above), got "//trim(whole(f%side)))
        else if (.not. all(abs(gap) <= huge(1.0_wp))) then
            call refuse_number(error, here, "gap", gap(merge(2, 1, abs(gap(1)) <= huge(1.0_wp))), "a finite number")
        else if (size(profile) > 0 .and. any(abs(gap) > 0.0_wp)) then
            call refuse_entry(error, here, "", bad_law, "has both gap and profile; give one of the two")
        end if
        if (.not. allocated(error)) call check_profile(profile, here, error)
        if (.not. allocated(error)) call check_law(law, here, error)
        if (.not. allocated(error)) call check_ground_law(f%law, f%parameter, at_right(f%parameter, f%parameter_to), here, error)
    end subroutine check_foundation

    !> The points of a profile
    pure subroutine check_profile(points, here, error)
        type(ground_point_type), intent(in) :: points(:)
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        do i = 1, size(points)
            associate (x => points(i)%x)
                if (.not. (abs(x) <= huge(x) .and. abs(points(i)%gap) <= huge(x))) then
                    call refuse_point(error, here, "profile", i, "expected finite numbers, got "//trim(pair(x, points(i)%gap)))
                else if (i > 1) then
                    associate (before => points(i - 1)%x)
                        if (x < before) then
                            call refuse_point(error, here, "profile", i, "the places go back to x = "//trim(shown(x))// &
                                              ", after "//trim(shown(before))//"; give them in ascending order")
                        else if (x - before <= position_tolerance*max(abs(x), abs(before))) then
                            call refuse_point(error, here, "profile", i, "there is a point at x = "//trim(shown(x))// &
                                              " already; leave one out, or give a step two places")
                        end if
                    end associate
                end if
            end associate
            if (allocated(error)) return
        end do
    end subroutine check_profile

    !> The points of a law
    pure subroutine check_law(points, here, error)
        type(ground_law_point_type), intent(in) :: points(:)
        type(entry_type), intent(in) :: here
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: before(2)
        integer :: i

        before(:) = 0.0_wp
        do i = 1, size(points)
            associate (d => points(i)%displacement, f => points(i)%force)
                if (.not. (abs(d) <= huge(d) .and. abs(f) <= huge(f))) then
                    call say(error, "expected finite numbers, got "//trim(pair(d, f)))
                else if (d < before(1)) then
                    call say(error, "the displacements go back at "//trim(pair(d, f))//", after "//trim(shown(before(1)))// &
                             "; give them in ascending order")
                else if (f < 0.0_wp) then
                    call say(error, "the force is below zero at "//trim(pair(d, f))//"; ground that pushes cannot pull")
                else if (f < before(2)) then
                    call say(error, "the force falls at "//trim(pair(d, f))//"; softening ground is not available in this version")
                else if (f > before(2) .and. .not. (f - before(2))/huge(f) < d - before(1)) then
                    call say(error, "ground has no vertical piece, as at "//trim(pair(d, f))//"; give a steep slope")
                else if (.not. d > before(1)) then
                    call say(error, "the point "//trim(pair(d, f))//" stands there twice, or at the origin; leave it out")
                end if
                if (allocated(error)) return
                before(:) = [d, f]
            end associate
        end do
        if (size(points) > 0 .and. .not. before(2) > 0.0_wp) then
            call refuse_entry(error, here, "law", bad_law, "its force stays 0, so it never carries; remove the foundation")
        end if

    contains

        !> What is wrong with the point at hand
        pure subroutine say(found, problem)
            type(error_type), allocatable, intent(out) :: found
            character(len=*), intent(in) :: problem

            call refuse_point(found, here, "law", i, problem)
        end subroutine say

    end subroutine check_law

    !> Refuse a point of a profile or a law
    pure subroutine refuse_point(error, here, key, number, problem)
        type(error_type), allocatable, intent(out) :: error
        type(entry_type), intent(in) :: here
        !> Profile or law, the point in it, from 1, and what is wrong
        character(len=*), intent(in) :: key, problem
        integer, intent(in) :: number

        call refuse(error, here%table, here%number, here%count, bad_law, key, "point "//trim(whole(number))//": "//problem, number)
    end subroutine refuse_point

end module gapbeam_check_foundations
