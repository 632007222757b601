!> A path with known changes, for test_walk: support k is closed from closes_at(k) on, there is no state between 3 and 3.5, and next
!> to sqrt(2) none can be settled.
module walk_sample
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_zone_margin, only: change_type
    use gapbeam_path_problem, only: point_type, path_problem_type
    implicit none
    private
    public :: sample_type, sample_point_type

    real(wp), parameter :: closes_at(4) = [sqrt(2.0_wp), 2.1_wp, 2.1_wp + 2.0_wp**(-40), 3.8_wp]

    !> A state
    type, extends(point_type) :: sample_point_type
        logical :: closed(size(closes_at)) = .false.
    end type sample_point_type

    !> The path, and what is recorded of it
    type, extends(path_problem_type) :: sample_type
        !> Is there a path beyond the stretch without states; does a look at 0.5 tell what is not so
        logical :: goes_on = .false., misleads = .false.
        integer :: number = 0
        integer :: support(16) = 0
        real(wp) :: changed_at(16) = 0.0_wp
        !> The stretch without states
        real(wp) :: from = 0.0_wp, until = 0.0_wp
        !> The point recorded last, and whether all were in order
        real(wp) :: taken = 0.0_wp
        logical :: ascending = .true.
    contains
        procedure :: find
        procedure :: look
        procedure :: alike
        procedure :: list_changes
        procedure :: measure
        procedure :: next_stop
        procedure :: take_end
        procedure :: take
        procedure :: take_changes
    end type sample_type

contains

    !> The state at a parameter
    subroutine find(problem, at, point, error, near)
        class(sample_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error
        class(point_type), intent(in), optional :: near
        type(sample_point_type), allocatable :: found
        type(error_type), allocatable :: trouble

        if (present(near)) problem%solves = problem%solves + 1
        allocate (found)
        found%at = at
        if (abs(at - closes_at(1)) < 2.0_wp**(-36)) then
            call fatal_error(trouble, gapbeam_not_converged, "too near to tell")
            call move_alloc(trouble, found%trouble)
        else
            found%stands = at < 3.0_wp .or. at >= 3.5_wp
        end if
        found%closed(:) = at >= closes_at
        call move_alloc(found, point)
        if (at < 0.0_wp) call fatal_error(error, gapbeam_not_converged, "before the path")
    end subroutine find

    !> The same, or at 0.5 what is not so
    subroutine look(problem, at, near, point, error)
        class(sample_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        type(error_type), allocatable, intent(out) :: error

        call problem%find(at, point, error, near)
        select type (point)
        type is (sample_point_type)
            point%sure = .not. problem%misleads
            if (problem%misleads .and. abs(at - 0.5_wp) < 0.1_wp) point%closed(4) = .true.
        end select
    end subroutine look

    !> Is the same closed
    function alike(problem, before, after)
        class(sample_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        logical :: alike

        alike = .false.
        if (before%stands .neqv. after%stands .or. problem%last < 0.0_wp) return
        select type (before)
        type is (sample_point_type)
            select type (after)
            type is (sample_point_type)
                alike = all(before%closed .eqv. after%closed) .or. .not. before%stands
            end select
        end select
    end function alike

    !> What closes
    subroutine list_changes(problem, before, after, changes)
        class(sample_type), intent(in) :: problem
        class(point_type), intent(in) :: before, after
        type(change_type), allocatable, intent(out) :: changes(:)
        integer :: k

        allocate (changes(0))
        select type (before)
        type is (sample_point_type)
            select type (after)
            type is (sample_point_type)
                do k = 1, merge(size(closes_at), 0, problem%last > 0.0_wp)
                    if (before%closed(k) .neqv. after%closed(k)) changes = [changes, change_type(support=k)]
                end do
            end select
        end select
    end subroutine list_changes

    !> A distance that bends where it is zero; that of support 4 is not known
    subroutine measure(problem, change, at, near, point, margin, place, known, other)
        class(sample_type), intent(inout) :: problem
        type(change_type), intent(in) :: change
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        real(wp), intent(out) :: margin, place
        logical, intent(out) :: known
        class(point_type), intent(in), optional :: other

        if (present(other)) problem%solves = problem%solves + 1
        allocate (point, source=near)
        associate (way => at - closes_at(change%support))
            margin = merge(1000*way, way + 0.1_wp*way**2, way > 0.0_wp)
        end associate
        place = 1.0_wp
        known = change%support /= 4
    end subroutine measure

    !> Steps of a half
    pure function next_stop(problem, point) result(next)
        class(sample_type), intent(in) :: problem
        class(point_type), intent(in) :: point
        real(wp) :: next

        next = min(problem%last, 0.5_wp*(1 + floor(2*point%at)))
    end function next_stop

    !> Where states end
    subroutine take_end(problem, below, above, goes_on, error)
        class(sample_type), intent(inout) :: problem
        class(point_type), intent(in) :: below, above
        logical, intent(out) :: goes_on
        type(error_type), allocatable, intent(out) :: error

        problem%from = above%at
        goes_on = problem%goes_on
        if (below%at > above%at) call fatal_error(error, gapbeam_not_converged, "not in order")
    end subroutine take_end

    !> Points in their order, and where states begin again
    subroutine take(problem, point, error)
        class(sample_type), intent(inout) :: problem
        class(point_type), intent(in) :: point
        type(error_type), allocatable, intent(out) :: error

        problem%ascending = problem%ascending .and. point%at > problem%taken
        problem%taken = point%at
        if (point%stands .and. problem%from > 0.0_wp .and. .not. problem%until > 0.0_wp) problem%until = point%at
        if (point%at > problem%last) call fatal_error(error, gapbeam_not_converged, "beyond the path")
    end subroutine take

    !> The changes
    subroutine take_changes(problem, before, after, at, place, error)
        class(sample_type), intent(inout) :: problem
        class(point_type), intent(in) :: before, after
        real(wp), intent(in) :: at(:), place(:)
        type(error_type), allocatable, intent(out) :: error
        type(change_type), allocatable :: changes(:)
        integer :: k

        call problem%list_changes(before, after, changes)
        do k = 1, size(at)
            problem%number = problem%number + 1
            problem%support(problem%number) = changes(k)%support
            problem%changed_at(problem%number) = at(k)
        end do
        if (any(place > 1.0_wp)) call fatal_error(error, gapbeam_not_converged, "not measured")
    end subroutine take_changes

end module walk_sample
