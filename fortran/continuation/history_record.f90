!> Record of a load path through limit points: its stretches, limits and where the beam lands from them, ways not taken.
module gapbeam_history_record
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_polyline, only: node_support_type
    use gapbeam_region_responses, only: outgoing_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_smooth_arc, only: arc_type
    use gapbeam_ground_along, only: ground_along_type
    use gapbeam_history_stretch, only: stretch_type, pieces_type, hand_over, enter_stretch, same_laws
    implicit none
    private
    public :: history_type, limit_type, other_way_type, on_laws_type, along_type, on_ground_type
    public :: new_history, find_pieces, scheme_at, laws_at, runs_of
    ! Of gapbeam_history_stretch
    public :: pieces_type, same_laws
    public :: add_stretch, add_column, add_others, note_limit, note_landings, is_jumping
    public :: at_limit_stop, at_limit_jump, at_limit_follow
    public :: no_limit, limit_point, bifurcation, mechanism, ended, cut_off

    !> What to do where the load cannot go on: end there; go on from the next stable state at the same factor; follow the path
    integer, parameter :: at_limit_stop = 0, at_limit_jump = 1, at_limit_follow = 2
    !> Kinds of limit. A path may also have ended without an end in sight: no further breakpoint, whatever the load; or after so
    !> many stretches
    integer, parameter :: no_limit = 0, limit_point = 1, bifurcation = 2, mechanism = 3, ended = 4, cut_off = 5

    !> Another way on from a tie
    type :: other_way_type
        !> The stretch that was taken instead
        integer :: stretch
        !> As in stretch_type (gapbeam_history_stretch)
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

    !> Deflections at the smooth laws, or numbers along the beam
    type :: point_type
        real(wp), allocatable :: x(:)
    end type point_type

    !> The laws of all supports
    type :: laws_type
        type(node_support_type), allocatable :: laws(:)
    end type laws_type

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
        !> First stretch from which on a support that keeps a set has turned back, and where one does so within a leg; and the laws
        !> with which the legs begin then, from 0 (gapbeam_unloaded_laws)
        integer :: unloaded(2) = huge(1)
        type(laws_type), allocatable :: of_legs(:)
        !> Leg at whose end the load factor was not found, since there is a limit load before it; -1 if none
        integer :: unreached = -1
        !> Stretch that is a branch beyond a bifurcation, 0 if none; its points from the bifurcation on, and the arc that led there
        integer :: traced = 0
        real(wp), allocatable :: branch(:, :)
        type(arc_type), allocatable :: arc
    end type on_laws_type

    !> A beam on ground along its axis where something begins or ends to slide, or where the load turns if that has springs
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
        !> system: the first `number` of these
        type(point_type), allocatable :: columns(:)
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
            if (stat /= 0) call no_memory(error)
            if (allocated(error)) return
            do i = 1, history%number
                call hand_over(history%stretches(i), longer(i))
            end do
            call move_alloc(longer, history%stretches)
        end if
        stretch%whole = history%number + 1
        if (allocated(stretch%changed)) stretch%whole = history%stretches(history%number)%whole
        history%number = history%number + 1
        call hand_over(stretch, history%stretches(history%number))
    end subroutine add_stretch

    !> Keep numbers along the beam
    pure subroutine add_column(values, along, column, error)
        real(wp), intent(in) :: values(:)
        type(along_type), intent(inout) :: along
        !> Where they are
        integer, intent(out) :: column
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(point_type), allocatable :: longer(:)
        integer :: stat, k

        column = along%number + 1
        stat = 0
        if (along%number == size(along%columns)) then
            allocate (longer(2*along%number), stat=stat)
            do k = 1, merge(along%number, 0, stat == 0)
                call move_alloc(along%columns(k)%x, longer(k)%x)
            end do
            if (stat == 0) call move_alloc(longer, along%columns)
        end if
        if (stat == 0) allocate (along%columns(column)%x, source=values, stat=stat)
        if (stat == 0) along%number = column
        if (stat /= 0) call no_memory(error)
    end subroutine add_column

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
                    ! It may become stable beyond that factor only: then there is none there
                    if (way*(s%to - limit%factor) < 0.0_wp .or. way*(s%from - limit%factor) > 0.0_wp) cycle
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

    !> The pieces of all supports on a stretch
    pure subroutine find_pieces(history, number, pieces)
        type(history_type), intent(in) :: history
        !> Of the stretch
        integer, intent(in) :: number
        type(pieces_type), intent(out) :: pieces
        integer :: k

        do k = history%stretches(number)%whole, number
            call enter_stretch(history%stretches(k), pieces)
        end do
    end subroutine find_pieces

    !> The scheme of a stretch
    pure function scheme_at(history, number) result(closed)
        !> As for find_pieces
        type(history_type), intent(in) :: history
        integer, intent(in) :: number
        logical, allocatable :: closed(:)
        type(pieces_type) :: pieces

        call find_pieces(history, number, pieces)
        call move_alloc(pieces%closed, closed)
    end function scheme_at

    !> The laws on a stretch
    pure function laws_at(assembled, history, number) result(laws)
        type(assembled_type), intent(in) :: assembled
        !> As for find_pieces
        type(history_type), intent(in) :: history
        integer, intent(in) :: number
        type(node_support_type), allocatable :: laws(:)
        type(pieces_type) :: pieces

        call find_pieces(history, number, pieces)
        laws = assembled%beam%supports
        if (allocated(pieces%laws)) call move_alloc(pieces%laws, laws)
    end function laws_at

    !> First and last stretch of every part of a path on which all supports stay on their piece, a smooth law being one, shape
    !> (2, number)
    pure function runs_of(history) result(runs)
        type(history_type), intent(in) :: history
        integer, allocatable :: runs(:, :)
        integer :: k

        if (allocated(history%on_laws)) then
            runs = history%on_laws%runs
        else
            allocate (runs(2, history%number), source=spread([(k, k=1, history%number)], 1, 2))
        end if
    end function runs_of

end module gapbeam_history_record
