!> Types for a long beam cut into eight segments: the lanes of an array are segments.
!>
!> The node in the middle stands alone. Four segments lie left of it and four right of it; column 1 is the node of a segment that is
!> farthest from the middle. Segments have as many columns each, so those at the ends may begin with some that are no nodes.
module gapbeam_segment_types
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: kept_columns
    use gapbeam_lane_types, only: lanes
    implicit none
    private
    public :: segment_beam_type, segment_room_type, new_segments, node_of, half

    !> Segments on either side of the middle
    integer, parameter :: half = lanes/2

    !> The beam: links, shape (n), and nodes, shape (0:n)
    type :: segment_beam_type
        integer :: n = 0, columns = 0
        !> First column that is a node, of the segments at the left and at the right end
        integer :: start(2) = 1
        !> As in link_type and workspace_type
        real(wp), allocatable, dimension(:) :: length, inverse, faa, fab, fbb, fixity, reach
        !> Side of the support of a node, 0 where there is none; the same where its state may change, else 0; is there one
        real(wp), allocatable, dimension(:) :: side, changing, there
        !> The link inward of every column (cell_type of gapbeam_kernel): 1/length, flexibilities at the node, at the far end,
        !> between them, their sums, near + far + 2 cross, near far - cross**2. Column 0 is the last one of the segment outside,
        !> shape (lanes, 8, 0:columns)
        real(wp), allocatable :: link(:, :, :)
    end type segment_beam_type

    !> A case
    type :: segment_room_type
        !> Loads and supports of the nodes (pack_type of gapbeam_lane_types), shape (0:n); turn_size is of the link before
        real(wp), allocatable, dimension(:) :: left, right, shear, load_size, turn_size, stiffness, rigid, contact
        !> Scheme, 1 closed; solution: moments, deflections, reactions
        real(wp), allocatable, dimension(:) :: closed, m, w, reaction
        !> Room by nodes and what would follow them, shape (0:n + 1, 10)
        real(wp), allocatable :: by_node(:, :)
        !> Supports of the columns: shear of the loads, stiffness, 1 where rigid, contact level, changing; scheme,
        !> shape (lanes, 6, columns)
        real(wp), allocatable :: support(:, :, :)
        !> Rows of the columns (row_type of gapbeam_kernel): stiffness, 1 where the deflection is unknown, right-hand sides, shape
        !> (lanes, 4, columns); and eliminated (eliminated_type): moment, factors of the next moment and deflection; deflection,
        !> likewise, shape (lanes, 6, columns)
        real(wp), allocatable :: row(:, :, :), eliminated(:, :, :)
        !> Moments and deflections, the neighbours of a segment in columns 0 and columns + 1, shape (lanes, 2, 0:columns + 1)
        real(wp), allocatable :: solution(:, :, :)
        !> Room for the supports that are wrong, shape (lanes, columns), and the columns in which any is
        real(wp), allocatable :: wrong(:, :)
        integer, allocatable :: changed(:)
        !> What is passed on (sweep_type) by the first columns of a segment, shape (lanes, 5, kept), and what comes in from outside;
        !> moment and deflection at the next node inward
        real(wp) :: passed(lanes, 5, kept_columns) = 0.0_wp, entry(lanes, 5) = 0.0_wp, next(lanes, 2) = 0.0_wp
        !> The same of the node in the middle
        real(wp) :: middle_support(6) = 0.0_wp, middle_row(4) = 0.0_wp, middle(2) = 0.0_wp
    end type segment_room_type

contains

    !> Cut a beam, and room for cases
    subroutine new_segments(n, beam, room, made)
        !> Links, at least 8*lanes
        integer, intent(in) :: n
        type(segment_beam_type), intent(out) :: beam
        type(segment_room_type), intent(out) :: room
        !> False where memory ends
        logical, intent(out) :: made
        integer :: stat

        beam%n = n
        beam%columns = (n - n/2 + half - 1)/half
        beam%start = 1 + half*beam%columns - [n/2, n - n/2]
        associate (m => beam%columns)
            allocate (beam%length(n), beam%inverse(n), beam%faa(n), beam%fab(n), beam%fbb(n), beam%fixity(n), beam%reach(n), &
                      beam%side(0:n), beam%changing(0:n), beam%there(0:n), beam%link(lanes, 8, 0:m), stat=stat)
            made = stat == 0
            if (.not. made) return
            allocate (room%left(0:n), room%right(0:n), room%shear(0:n), room%load_size(0:n), room%turn_size(0:n), &
                      room%stiffness(0:n), room%rigid(0:n), room%contact(0:n), room%closed(0:n), room%m(0:n), room%w(0:n), &
                      room%reaction(0:n), room%by_node(0:n + 1, 10), room%support(lanes, 6, m), room%row(lanes, 4, m), &
                      room%eliminated(lanes, 6, m), room%solution(lanes, 2, 0:m + 1), room%wrong(lanes, m), &
                      room%changed(m), stat=stat)
        end associate
        made = stat == 0
        if (.not. made) return
        beam%link(:, :, :) = 0.0_wp
        room%support(:, :, :) = 0.0_wp
        room%row(:, :, :) = 0.0_wp
        room%solution(:, :, :) = 0.0_wp
        ! Columns that are no nodes: what is passed on stays finite, with supports that hold and do not change
        beam%link(:, 2, :) = 1.0_wp
        room%support(:, 3, :) = 1.0_wp
        room%support(:, 6, :) = 1.0_wp
        room%row(:, 1, :) = 1.0_wp
    end subroutine new_segments

    !> Node of column 1 of a segment, the step to that of column 2, and the first column that is a node
    elemental subroutine node_of(beam, l, first, step, begin)
        type(segment_beam_type), intent(in) :: beam
        !> Segment
        integer, intent(in) :: l
        integer, intent(out) :: first, step, begin

        begin = 1
        if (l == 1) begin = beam%start(1)
        if (l == half + 1) begin = beam%start(2)
        if (l <= half) then
            first = (l - 1)*beam%columns + 1 - beam%start(1)
            step = 1
        else
            first = beam%n - ((l - half - 1)*beam%columns + 1 - beam%start(2))
            step = -1
        end if
    end subroutine node_of

end module gapbeam_segment_types
