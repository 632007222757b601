!> A path whose states are found by a solve at each value of its parameter: what has to be said of it.
!>
!> The parameter is a load factor, or the position of a train; it only grows. gapbeam_walk goes along it, gapbeam_bracket
!> brackets the first change between two states, gapbeam_crossing finds the parameter at which it happens.
!>
!> How a problem is written:
!>
!>   * extend point_type by what a state is, or as much of it as comparing and starting from it need;
!>   * extend path_problem_type by what is the same along the path, and by what it records;
!>   * find      gives the state at a parameter, or that there is none (stands is false); one that can be neither found nor
!>               excluded has its error in `trouble`, any other error ends the path;
!>   * alike     tells whether nothing changes between two states: the same signature of contact;
!>   * list_changes  names what changes between two that stand, each a change_type;
!>   * measure   gives how far a named change is away at a parameter: a continuous function of it, zero where it happens. `known`
!>               is false where there is none, and what cannot be measured is found by bisection;
!>   * next_stop tells how far to go before the next state is compared: a grid, or a step chosen by the last state;
!>   * take_changes  records the changes at the parameters found.
!>
!> May be left as they are: look (a cheaper find, whose states need not be sure), refine (more digits of a parameter),
!> approach_end (what else is known of an end of the states), take_end (records it, and says whether to go on beyond it), take
!> (records a state come to, on the way or next to a change).
module gapbeam_path_problem
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_zone_margin, only: change_type
    implicit none
    private
    public :: point_type, path_problem_type, crossing_type, copy_point

    !> A state at a parameter, or that there is none
    type, abstract :: point_type
        real(wp) :: at = 0.0_wp
        !> Is there a state; was it found for sure, and not only looked at
        logical :: stands = .false., sure = .true.
        !> Where it could be neither found nor excluded: why
        type(error_type), allocatable :: trouble
    end type point_type

    !> Where a change happens, as far as it is known
    type :: crossing_type
        type(change_type) :: change
        !> Parameter, slope of the margin over it there, and the place of the change along the beam
        real(wp) :: at = 0.0_wp, slope = 0.0_wp, place = 0.0_wp
        !> Where one secant more from the smooth side has it
        real(wp) :: one_further = 0.0_wp
        !> What was measured next to it, on the side on which the margin is smooth
        class(point_type), allocatable :: near
    end type crossing_type

    !> A path, and what comes of it
    type, abstract :: path_problem_type
        !> What its parameter is called, and where it ends
        character(len=:), allocatable :: parameter
        real(wp) :: last = 0.0_wp
        !> Rounding of a parameter is a share of itself, or of this, whichever is larger
        real(wp) :: extent = 0.0_wp
        !> Parameters nearer than this share are neighbours, 0: there is none between them; the same next to an end of the states
        real(wp) :: neighbours = 0.0_wp, neighbours_at_end = 0.0_wp
        !> Linear solves
        integer :: solves = 0
    contains
        procedure(find_interface), deferred :: find
        procedure(alike_interface), deferred :: alike
        procedure(list_changes_interface), deferred :: list_changes
        procedure(measure_interface), deferred :: measure
        procedure(next_stop_interface), deferred :: next_stop
        procedure(take_changes_interface), deferred :: take_changes
        procedure :: look
        procedure :: refine
        procedure :: approach_end
        procedure :: take_end
        procedure :: take
        procedure, non_overridable :: size_at
    end type path_problem_type

    abstract interface

        !> The state at a parameter, for sure
        subroutine find_interface(problem, at, point, error, near)
            import :: path_problem_type, point_type, error_type, wp
            implicit none
            class(path_problem_type), intent(inout) :: problem
            real(wp), intent(in) :: at
            class(point_type), allocatable, intent(out) :: point
            !> What ends the path
            type(error_type), allocatable, intent(out) :: error
            !> A state nearby, or none, from which it may be looked for
            class(point_type), intent(in), optional :: near
        end subroutine find_interface

        !> Does nothing change between two
        function alike_interface(problem, before, after) result(alike)
            import :: path_problem_type, point_type
            implicit none
            class(path_problem_type), intent(in) :: problem
            class(point_type), intent(in) :: before, after
            logical :: alike
        end function alike_interface

        !> What changes between two that stand
        subroutine list_changes_interface(problem, before, after, changes)
            import :: path_problem_type, point_type, change_type
            implicit none
            class(path_problem_type), intent(in) :: problem
            class(point_type), intent(in) :: before, after
            type(change_type), allocatable, intent(out) :: changes(:)
        end subroutine list_changes_interface

        !> How far a change is away at a parameter
        subroutine measure_interface(problem, change, at, near, point, margin, place, known, other)
            import :: path_problem_type, point_type, change_type, wp
            implicit none
            class(path_problem_type), intent(inout) :: problem
            type(change_type), intent(in) :: change
            real(wp), intent(in) :: at
            !> A point nearby that has been found or measured
            class(point_type), intent(in) :: near
            !> As much as another measurement needs to begin there
            class(point_type), allocatable, intent(out) :: point
            !> Of one sign before the change, of the other after it; and its place
            real(wp), intent(out) :: margin, place
            logical, intent(out) :: known
            !> Another one, where that leads nowhere
            class(point_type), intent(in), optional :: other
        end subroutine measure_interface

        !> Where to look next, beyond a parameter; not beyond `last`
        pure function next_stop_interface(problem, point) result(next)
            import :: path_problem_type, point_type, wp
            implicit none
            class(path_problem_type), intent(in) :: problem
            class(point_type), intent(in) :: point
            real(wp) :: next
        end function next_stop_interface

        !> Record what changes between two neighbours that stand
        subroutine take_changes_interface(problem, before, after, at, place, error)
            import :: path_problem_type, point_type, error_type, wp
            implicit none
            class(path_problem_type), intent(inout) :: problem
            class(point_type), intent(in) :: before, after
            !> Of the changes as they are listed: parameter, and place; below zero where that was not measured
            real(wp), intent(in) :: at(:), place(:)
            !> No memory
            type(error_type), allocatable, intent(out) :: error
        end subroutine take_changes_interface

    end interface

contains

    !> The state at a parameter next to another one, sure or not
    subroutine look(problem, at, near, point, error)
        class(path_problem_type), intent(inout) :: problem
        real(wp), intent(in) :: at
        class(point_type), intent(in) :: near
        class(point_type), allocatable, intent(out) :: point
        !> As for find
        type(error_type), allocatable, intent(out) :: error

        call problem%find(at, point, error, near)
    end subroutine look

    !> All digits of the parameter of a change
    subroutine refine(problem, crossing, found)
        class(path_problem_type), intent(inout) :: problem
        type(crossing_type), intent(inout) :: crossing
        !> Is it still one
        logical, intent(out) :: found

        associate (unused => problem)
        end associate
        crossing%at = crossing%one_further
        found = .true.
    end subroutine refine

    !> Bring a state, and that there is none, nearer to each other by what is known of an end of the states
    subroutine approach_end(problem, below, above, ended, error)
        class(path_problem_type), intent(inout) :: problem
        !> The last state so far, and the next point, at which there is none; this may become a state before the end that is not
        !> like the other
        class(point_type), allocatable, intent(inout) :: below, above
        !> Has the path ended here, and is that recorded
        logical, intent(out) :: ended
        !> As for find
        type(error_type), allocatable, intent(out) :: error

        associate (unused => problem, as_well => below, and => above)
        end associate
        ended = .false.
    end subroutine approach_end

    !> Record that there is no state from here on
    subroutine take_end(problem, below, above, goes_on, error)
        class(path_problem_type), intent(inout) :: problem
        !> Neighbours: the last state, and that there is none
        class(point_type), intent(in) :: below, above
        !> Are there others further on
        logical, intent(out) :: goes_on
        !> As for find
        type(error_type), allocatable, intent(out) :: error

        associate (unused => problem, as_well => below, and => above)
        end associate
        goes_on = .true.
    end subroutine take_end

    !> Record a point on the way
    subroutine take(problem, point, error)
        class(path_problem_type), intent(inout) :: problem
        class(point_type), intent(in) :: point
        !> No memory
        type(error_type), allocatable, intent(out) :: error

        associate (unused => problem, as_well => point)
        end associate
    end subroutine take

    !> What rounding of a parameter is a share of
    elemental function size_at(problem, at) result(size)
        class(path_problem_type), intent(in) :: problem
        real(wp), intent(in) :: at
        real(wp) :: size

        size = max(abs(at), problem%extent)
    end function size_at

    !> Copy a point
    subroutine copy_point(from, to)
        class(point_type), intent(in) :: from
        class(point_type), allocatable, intent(out) :: to

        allocate (to, source=from)
    end subroutine copy_point

end module gapbeam_path_problem
