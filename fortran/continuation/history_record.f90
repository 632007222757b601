!> Record of a load path through limit points: its stretches, limits and where the beam lands from them, ways not taken.
module gapbeam_history_record
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_polyline, only: node_support_type
    use gapbeam_region_responses, only: outgoing_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_arc, only: arc_type
    use gapbeam_ground_along, only: ground_along_type
    implicit none
    private
    public :: history_type, stretch_type, limit_type, other_way_type, on_laws_type, along_type, on_ground_type, point_type
    public :: new_history, laws_at
    public :: same_laws
    public :: runs_of
    public :: add_stretch, add_others, note_limit, note_landings, is_jumping
    public :: at_limit_stop, at_limit_jump, at_limit_follow
    public :: no_limit, limit_point, bifurcation, mechanism, ended, cut_off

    !> What to do where the load cannot go on: end there; go on from the next stable state at the same factor; follow the path
    integer, parameter :: at_limit_stop = 0, at_limit_jump = 1, at_limit_follow = 2
    !> Kinds of limit. A path may also have ended without an end in sight: no further breakpoint, whatever the load; or after so
    !> many stretches
    integer, parameter :: no_limit = 0, limit_point = 1, bifurcation = 2, mechanism = 3, ended = 4, cut_off = 5

    !> A stretch of the path on which all pieces of all laws stay the same
    type :: stretch_type
        !> Number of the factor that is gone to, from 1; 0 while the dead loads are put on
        integer :: leg
        !> Load factors
        real(wp) :: from, to
        !> Does the load rise (1), fall (-1), or does the beam turn at constant load (0); in how many ways the beam gives way by
        !> itself; ways on there were at its beginning
        integer :: direction, index, ways
        !> Is it passed in a jump
        logical :: skipped
        !> The scheme, shape (size(supports))
        logical, allocatable :: closed(:)
        !> The laws as they have become, where they are not those of the beam
        type(node_support_type), allocatable :: laws(:)
        !> Of links along the beam: their scheme, and which numbers of the chain are at the ends
        logical, allocatable :: along(:)
        integer :: ends(2) = 0
        !> Contacts of their laws as they are at its beginning, where some keep a set, shape (size(axial%laws))
        real(wp), allocatable :: along_contact(:)
        !> Is the chain free there, so that forces are unique and its position is not
        logical :: loose = .false.
    end type stretch_type

    !> Another way on from a tie
    type :: other_way_type
        !> The stretch that was taken instead
        integer :: stretch
        !> As in stretch_type
        integer :: direction, index
        logical, allocatable :: closed(:)
    end type other_way_type

    !> Where the load cannot go on
    type :: limit_type
        !> limit_point, bifurcation or mechanism
        integer :: kind
        !> As in stretch_type; last stretch before it
        integer :: leg
        real(wp) :: factor
        integer :: stretch
        !> Stretch on which the beam lands at the same factor; 0 if nowhere on its path
        integer :: landing = 0
    end type limit_type

    !> Deflections at the smooth laws
    type :: point_type
        real(wp), allocatable :: x(:)
    end type point_type

    !> What is known on the smooth laws themselves of a path that was followed on their polylines (gapbeam_smooth_path)
    type :: on_laws_type
        !> What there is at the end of every stretch (gapbeam_path_on_laws), and load factors at its ends on the polylines
        integer, allocatable :: joins(:)
        real(wp), allocatable :: rough(:, :)
        !> States at its ends (1 start, 2 stop), where they are known; does it begin where a jump has landed
        type(point_type), allocatable :: ends(:, :)
        logical, allocatable :: lands(:)
        !> First and last stretch of what is one on the laws, shape (2, number)
        integer, allocatable :: runs(:, :)
        !> Sizes of the laws and of the load factor
        real(wp) :: size(2) = 0.0_wp
        !> Is there one state only at every load factor, so that tangents lead to it
        logical :: unique = .false.
        !> Leg at whose end the load factor was not found, since there is a limit load before it; -1 if none
        integer :: unreached = -1
        !> Stretch that is a branch beyond a bifurcation, 0 if none; its points from the bifurcation on, and the arc that led there
        integer :: traced = 0
        real(wp), allocatable :: branch(:, :)
        type(arc_type), allocatable :: arc
    end type on_laws_type

    !> A beam on ground along its axis where something begins or ends to slide
    type :: on_ground_type
        !> On which stretch, and at which load factor
        integer :: stretch
        real(wp) :: factor
        type(ground_along_type) :: ground
    end type on_ground_type

    !> The chain along the beam at the ends of stretches, where its links act one way, yield or rub
    type :: along_type
        !> Support of the model of every link
        integer, allocatable :: support(:)
        !> Displacements of its points, forces of its bars, forces of the links on the beam to the right, in units of the axial
        !> system: the first `number` columns
        real(wp), allocatable :: values(:, :)
        integer :: number = 0
        !> Where ground holds the beam along its axis instead, the first `number` entries
        type(on_ground_type), allocatable :: on_ground(:)
    end type along_type

    !> The loading history
    type :: history_type
        !> at_limit_stop, at_limit_jump or at_limit_follow
        integer :: at_limit = at_limit_stop
        !> The stretches, the first `number` entries
        type(stretch_type), allocatable :: stretches(:)
        integer :: number = 0
        !> Where the load could not go on
        type(limit_type), allocatable :: limits(:)
        !> Ways that were not taken
        type(other_way_type), allocatable :: others(:)
        !> How it ended: no_limit at the last factor
        integer :: ending = no_limit
        !> How the beam moves where it ended in a mechanism, if that is a free motion of rigid parts, shape (0:n)
        real(wp), allocatable :: motion(:)
        !> Linear solves
        integer :: solves = 0
        !> Of a beam with smooth laws
        type(on_laws_type), allocatable :: on_laws
        !> Of a beam with such links
        type(along_type), allocatable :: along
    end type history_type

contains

    !> Nothing kept yet
    pure subroutine new_history(at_limit, history)
        !> at_limit_stop, at_limit_jump or at_limit_follow
        integer, intent(in) :: at_limit
        type(history_type), intent(out) :: history

        history%at_limit = at_limit
        allocate (history%stretches(16), history%limits(0), history%others(0))
    end subroutine new_history

    !> Keep a stretch
    pure subroutine add_stretch(stretch, history, error)
        !> What it has allocated is moved from it
        type(stretch_type), intent(inout) :: stretch
        type(history_type), intent(inout) :: history
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type), allocatable :: longer(:)
        integer :: stat, i

        if (history%number == size(history%stretches)) then
            allocate (longer(2*history%number), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
            do i = 1, history%number
                call hand_over(history%stretches(i), longer(i))
            end do
            call move_alloc(longer, history%stretches)
        end if
        history%number = history%number + 1
        call hand_over(stretch, history%stretches(history%number))
    end subroutine add_stretch

    !> Put a stretch to another place, with what it has allocated
    pure subroutine hand_over(from, to)
        type(stretch_type), intent(inout) :: from, to

        call move_alloc(from%closed, to%closed)
        call move_alloc(from%laws, to%laws)
        call move_alloc(from%along, to%along)
        call move_alloc(from%along_contact, to%along_contact)
        to%ends = from%ends
        to%loose = from%loose
        to%leg = from%leg
        to%from = from%from
        to%to = from%to
        to%direction = from%direction
        to%index = from%index
        to%ways = from%ways
        to%skipped = from%skipped
    end subroutine hand_over

    !> Keep the ways that the last stretch is not
    subroutine add_others(ways, taken, history)
        !> The ways on at its beginning, and which was taken
        type(outgoing_type), intent(in) :: ways(:)
        integer, intent(in) :: taken
        type(history_type), intent(inout) :: history
        integer :: w

        do w = 1, size(ways)
            if (w == taken) cycle
            associate (way => ways(w))
                history%others = [history%others, other_way_type(history%number, way%direction, way%index, way%closed)]
            end associate
        end do
    end subroutine add_others

    !> Note a limit, but not while the beam falls from one to its landing
    pure subroutine note_limit(kind, leg, factor, history)
        !> As in limit_type
        integer, intent(in) :: kind, leg
        real(wp), intent(in) :: factor
        type(history_type), intent(inout) :: history

        if (is_jumping(history) .and. history%at_limit /= at_limit_follow) return
        history%limits = [history%limits, limit_type(kind, leg, factor, history%number)]
    end subroutine note_limit

    !> Is there a limit from which the beam has not landed yet
    pure function is_jumping(history)
        type(history_type), intent(in) :: history
        logical :: is_jumping

        is_jumping = size(history%limits) > 0
        if (is_jumping) is_jumping = history%limits(size(history%limits))%landing == 0
    end function is_jumping

    !> From which limits the beam lands on the last stretch, which is stable and passes their load factors
    pure subroutine note_landings(way, history)
        !> Where the load goes on the leg
        integer, intent(in) :: way
        type(history_type), intent(inout) :: history
        integer :: j, k

        associate (s => history%stretches(history%number))
            do j = 1, size(history%limits)
                associate (limit => history%limits(j))
                    if (limit%landing > 0 .or. s%direction /= way .or. s%leg /= limit%leg) cycle
                    if (way*(s%to - limit%factor) < 0.0_wp) cycle
                    limit%landing = history%number
                    if (history%at_limit /= at_limit_jump) cycle
                    s%from = limit%factor
                    do k = limit%stretch + 1, history%number - 1
                        history%stretches(k)%skipped = .true.
                    end do
                end associate
            end do
        end associate
    end subroutine note_landings

    !> The laws of a stretch
    pure function laws_at(assembled, stretch) result(laws)
        type(assembled_type), intent(in) :: assembled
        type(stretch_type), intent(in) :: stretch
        type(node_support_type), allocatable :: laws(:)

        laws = assembled%beam%supports
        if (allocated(stretch%laws)) laws = stretch%laws
    end function laws_at

    !> Are the laws of all supports the same
    pure function same_laws(a, b) result(they_are)
        type(node_support_type), intent(in) :: a(:), b(:)
        logical :: they_are

        they_are = .not. any(a%contact < b%contact .or. a%contact > b%contact .or. a%force < b%force .or. a%force > b%force &
                             .or. a%stiffness < b%stiffness .or. a%stiffness > b%stiffness &
                             .or. a%before < b%before .or. a%before > b%before)
    end function same_laws

    !> First and last stretch of every part of a path on which all supports stay on their piece, a smooth law being one, shape
    !> (2, number)
    pure function runs_of(history) result(runs)
        type(history_type), intent(in) :: history
        integer, allocatable :: runs(:, :)
        integer :: k

        if (allocated(history%on_laws)) then
            runs = history%on_laws%runs
        else
            allocate (runs(2, history%number))
            runs(:, :) = spread([(k, k=1, history%number)], 1, 2)
        end if
    end function runs_of

end module gapbeam_history_record
