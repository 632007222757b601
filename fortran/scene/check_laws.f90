!> Checks of the laws of supports.
module gapbeam_check_laws
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: same_slope
    use gapbeam_error, only: error_type
    use gapbeam_words, only: shown, pair
    use gapbeam_scene, only: model_type, law_point_type, gapbeam_both, gapbeam_elastic, gapbeam_plastic, gapbeam_broken
    use gapbeam_input_error, only: refuse, of_supports, bad_law
    implicit none
    private
    public :: check_laws

contains

    !> All laws
    subroutine check_laws(model, law, error)
        !> With all arrays allocated, and the points of its laws
        type(model_type), intent(in) :: model
        type(law_point_type), intent(in) :: law(:)
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: seen(:)
        character(len=:), allocatable :: problem
        integer :: i, first

        allocate (seen(size(model%supports)), source=.false.)
        first = 1
        do i = 1, size(law)
            associate (k => law(i)%support)
                if (k < 1 .or. k > size(model%supports)) then
                    call refuse(error, of_supports, 1, size(model%supports), bad_law, "law", &
                                "a point belongs to a support that does not exist")
                    return
                end if
                if (i < size(law)) then
                    if (law(i + 1)%support == k) cycle
                end if
                if (seen(k)) then
                    problem = "its points must stand beside each other"
                else if (.not. model%supports(k)%stiffness > huge(1.0_wp)) then
                    problem = "it stands instead of a stiffness; leave that out"
                else if (model%supports(k)%side == gapbeam_both .and. model%supports(k)%gap < 0.0_wp) then
                    ! Its two halves would act at once where they meet, and its breakpoints stand in no order
                    call refuse(error, of_supports, k, size(model%supports), bad_law, "gap", "expected 0 or more of a support "// &
                                "that holds both ways, got "//trim(shown(model%supports(k)%gap))// &
                                "; put one below and one above at this place instead")
                else
                    call check_points(law(first:i), problem)
                    if (.not. allocated(problem) .and. model%supports(k)%unloading == gapbeam_plastic) then
                        call check_unloading(law(first:i), problem)
                        if (.not. allocated(problem) .and. model%supports(k)%side == gapbeam_both) then
                            call check_sliders(law(first:i), problem)
                        end if
                    end if
                end if
                if (allocated(problem)) call refuse(error, of_supports, k, size(model%supports), bad_law, "law", problem)
                if (allocated(error)) return
                seen(k) = .true.
                first = i + 1
            end associate
        end do
        call check_ways_to_unload(model, seen, error)
    end subroutine check_laws

    !> Ways to unload
    subroutine check_ways_to_unload(model, seen, error)
        type(model_type), intent(in) :: model
        !> Which supports have a law
        logical, intent(in) :: seen(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: i

        do i = 1, size(model%supports)
            associate (unloading => model%supports(i)%unloading, both_ways => model%supports(i)%side == gapbeam_both)
                if (unloading == gapbeam_elastic) cycle
                if (.not. seen(i)) then
                    call say("unloading", "only a support with a law unloads in another way than along it; give law, or remove it")
                else if (both_ways .and. unloading == gapbeam_broken) then
                    call say("unloading", "a support that holds both ways does not break for good; put one below and one above "// &
                             "at this place instead")
                else if (both_ways .and. unloading == gapbeam_plastic .and. abs(model%supports(i)%gap) > 0.0_wp) then
                    call say("gap", "a support that holds both ways and yields has none in this version; put one below and one "// &
                             "above at this place instead")
                else if (unloading < gapbeam_elastic .or. unloading > gapbeam_broken) then
                    call say("unloading", "expected 0 (elastic), 1 (plastic) or 2 (broken)")
                end if
                if (allocated(error)) return
            end associate
        end do

    contains

        !> What is wrong
        subroutine say(key, problem)
            character(len=*), intent(in) :: key, problem

            call refuse(error, of_supports, i, size(model%supports), bad_law, key, problem)
        end subroutine say

    end subroutine check_ways_to_unload

    !> The points of a law
    subroutine check_points(points, problem)
        type(law_point_type), intent(in) :: points(:)
        !> What is wrong with them
        character(len=:), allocatable, intent(out) :: problem
        real(wp) :: before(2), slope
        integer :: j

        before(:) = 0.0_wp
        slope = 0.0_wp
        do j = 1, size(points)
            associate (d => points(j)%displacement, f => points(j)%force)
                if (.not. (abs(d) <= huge(d) .and. abs(f) <= huge(f))) then
                    problem = "expected finite numbers, got "//trim(pair(d, f))
                else if (d < before(1)) then
                    problem = "the displacements go back at "//trim(pair(d, f))//", after "//trim(shown(before(1)))// &
                        "; give them in ascending order"
                else if (f < 0.0_wp) then
                    problem = "the force is below zero at "//trim(pair(d, f))//"; a support that pushes cannot pull: "// &
                        "end the law at 0"
                else if (.not. (abs(d - before(1)) > 0.0_wp .or. abs(f - before(2)) > 0.0_wp)) then
                    problem = "the point "//trim(pair(d, f))//" stands there twice, or at the origin; leave it out"
                else if (.not. abs(d - before(1)) > 0.0_wp .and. j > 1) then
                    ! Rigid up to a force at which it breaks is a law
                    if (is_vertical(points(:j - 1)) .and. .not. (slope > 0.0_wp .and. f < before(2))) then
                        problem = "there are two vertical pieces at "//trim(shown(d))//"; give the outer points only"
                    end if
                end if
                if (allocated(problem)) return
                if (abs(d - before(1)) > 0.0_wp) then
                    slope = (f - before(2))/(d - before(1))
                else
                    slope = f - before(2)
                end if
                if (j == size(points) .and. slope < 0.0_wp) then
                    problem = "it ends falling, so its force would become negative beyond "//trim(pair(d, f))// &
                        "; add a point from which on it stays, such as "//trim(pair(d + max(d, 1.0_wp), f))
                    return
                end if
                before(:) = [d, f]
            end associate
        end do
    end subroutine check_points

    !> Unloading parallel to the first piece must not give back more work than a steeper one has taken
    subroutine check_unloading(points, problem)
        type(law_point_type), intent(in) :: points(:)
        !> What is wrong with them
        character(len=:), allocatable, intent(out) :: problem
        real(wp) :: width, rise
        integer :: j

        associate (first => points(1))
            if (.not. first%force > 0.0_wp) then
                problem = "plastic unloading is parallel to its first piece, which does not rise; leave that out, and "// &
                    "give a gap"
                return
            end if
            do j = 2, size(points)
                width = points(j)%displacement - points(j - 1)%displacement
                rise = points(j)%force - points(j - 1)%force
                if (rise*first%displacement <= first%force*width*(1 + same_slope)) cycle
                problem = "plastic unloading is parallel to its first piece, but the piece up to "// &
                    trim(pair(points(j)%displacement, points(j)%force))//" is steeper, so it would give back more "// &
                    "work than it took; begin with the steepest piece, or leave unloading out"
                return
            end do
        end associate
    end subroutine check_unloading

    !> A law both ways whose pieces get no steeper and do not fall is springs with sliders side by side
    subroutine check_sliders(points, problem)
        !> With plastic unloading, whose pieces are no steeper than the first
        type(law_point_type), intent(in) :: points(:)
        character(len=:), allocatable, intent(out) :: problem
        real(wp) :: width, rise, width_before, rise_before
        integer :: j

        width_before = points(1)%displacement
        rise_before = points(1)%force
        if (.not. width_before > 0.0_wp) then
            problem = "a support that holds both ways and yields is not rigid at first in this version; give its first "// &
                "piece a slope"
            return
        end if
        if (size(points) < 2) then
            problem = "it has one piece only, so it never yields; leave unloading out"
            return
        end if
        do j = 2, size(points)
            width = points(j)%displacement - points(j - 1)%displacement
            rise = points(j)%force - points(j - 1)%force
            if (rise >= 0.0_wp .and. rise*width_before <= rise_before*width*(1 + same_slope)) then
                width_before = width
                rise_before = rise
                cycle
            end if
            problem = "both ways it yields by springs with sliders side by side, but the piece up to "// &
                trim(pair(points(j)%displacement, points(j)%force))//" falls or is steeper than that before; give pieces "// &
                "that get flatter, or leave unloading out"
            return
        end do
    end subroutine check_sliders

    !> Is the last piece of some points vertical
    pure function is_vertical(points) result(vertical)
        type(law_point_type), intent(in) :: points(:)
        logical :: vertical
        real(wp) :: before

        before = 0.0_wp
        if (size(points) > 1) before = points(size(points) - 1)%displacement
        vertical = .not. points(size(points))%displacement > before
    end function is_vertical

end module gapbeam_check_laws
