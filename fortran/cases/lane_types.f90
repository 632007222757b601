!> Types for many cases of one beam side by side: the lanes of every array are cases.
!> The lane index comes first, so that the processor does in one instruction what is the same for all of them. Masks are reals, 1
!> or 0, which multiply.
module gapbeam_lane_types
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: lanes, lane_beam_type, pack_type, new_pack, lane_pieces_type, piece_pack_type, new_piece_pack
    public :: lane_rounding_type, lane_spans_type
    public :: by_both_ends, by_three_moments, by_chain
    public :: link_numbers, link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, link_bending, link_determinant, link_fixity, &
        link_reach

    !> Cases side by side, whatever the processor's registers hold, so that results do not depend on it
    integer, parameter :: lanes = 8
    !> Numbers of a link that its stiffness decides: as in link_type; as in workspace_type; deflection that a moment of 1 makes
    !> (find_own_sizes of gapbeam_reactions)
    integer, parameter :: link_numbers = 9, link_faa = 1, link_fab = 2, link_fbb = 3, link_sum_a = 4, link_sum_b = 5, &
        link_bending = 6, link_determinant = 7, link_fixity = 8, link_reach = 9
    !> How gapbeam_system solves a scheme
    integer, parameter :: by_both_ends = 1, by_three_moments = 2, by_chain = 3

    !> What cases have in common: links, shape (n), and supports, shape (0:n). What follows from stiffnesses is by lane where these
    !> differ from case to case, and belongs to the eight cases at hand; else the first extent is 1 (gapbeam_lane_stiffness)
    type :: lane_beam_type
        integer :: n = 0
        !> Stiffness of the weak springs that hold a scheme which moves, shape (1 or lanes)
        real(wp), allocatable :: proximal_weight(:)
        !> As in link_type
        real(wp), allocatable, dimension(:) :: length, inverse
        !> Numbers of the links, shape (1 or lanes, link_numbers, n)
        real(wp), allocatable :: links(:, :, :)
        !> Place of every support in arrays of supports: its node, or one beyond the last node where several share a node
        integer, allocatable :: place(:)
        !> Its number in the scene
        integer, allocatable :: number(:)
        !> Nodes with several supports, shape (m), and the last places of these, in the order of the nodes, shape (0:m); those of
        !> the first begin after last_place(0) = n
        integer, allocatable :: shared(:), last_place(:)
        !> Of supports by places: 1 below, -1 above, 0 both or none
        real(wp), allocatable :: side(:)
        !> Is there a support, may it change
        real(wp), allocatable :: there(:), changes(:)
        !> 1 at hinges
        real(wp), allocatable :: hinge(:)
        !> Number of the rotational restraint of every node, 0 where there is none, shape (0:n); nodes of the restraints and their
        !> compliances
        integer, allocatable :: restraint(:), restrained(:)
        real(wp), allocatable :: compliance(:)
        !> Are there hinges or restraints between the ends, and loads with a couple at a node
        logical :: is_plain = .true., with_couples = .true.
        !> What loads with factor 1 do to links: which load, which link; rotations and shears of the simple bar at both ends, sums
        !> of absolute values of loads and rotations (share_type of gapbeam_cases), shape (1 or lanes, 6, :)
        integer, allocatable :: link_load(:), link(:)
        real(wp), allocatable :: to_link(:, :, :)
        !> And to nodes: force and couple, shape (2, :)
        integer, allocatable :: node_load(:), node(:)
        real(wp), allocatable :: to_node(:, :)
    end type lane_beam_type

    !> Eight cases; all arrays have shape (lanes, 0:n), those of links no entry at 0, those of supports entries for all places
    type :: pack_type
        !> Numbers of the links, shape (1 or lanes, link_numbers, n)
        real(wp), allocatable :: links(:, :, :)
        !> Loads: rotations left and right of the node, shear, couple; sizes (workspace_type)
        real(wp), allocatable, dimension(:, :) :: left, right, shear, couple, load_size, turn_size
        !> Supports by places: stiffness, 0 of rigid ones; 1 where rigid; contact level. At the nodes of several those of one in
        !> place of them (gapbeam_lane_shared)
        real(wp), allocatable, dimension(:, :) :: stiffness, rigid, contact
        !> Scheme: 1 closed
        real(wp), allocatable, dimension(:, :) :: closed
        !> What the scheme makes of it: deflection known (1) and which, stiffness of the node, its shear
        real(wp), allocatable, dimension(:, :) :: held, known, spring, force
        !> Loads at the nodes with several supports, shape (lanes, m)
        real(wp), allocatable :: load(:, :)
        !> Solution: deflection, moments; reaction by places
        real(wp), allocatable, dimension(:, :) :: w, ml, mr, reaction
        !> Residuals or, after elimination, corrections; the first also which supports are wrong, by places
        real(wp), allocatable, dimension(:, :) :: turn_rest, force_rest, known_rest, dw, dl, dr, spare
        !> Residuals left of restraints, 0 at other nodes
        real(wp), allocatable :: left_rest(:, :)
        !> Right-hand side of compatibility at plain nodes
        real(wp), allocatable :: turn(:, :)
        !> Has any case a couple at a node
        logical :: with_couples = .true.
        !> Are w and ml, and the elimination in room, those of the contact states
        logical :: is_solved = .false.
        !> Room for elimination and for sizes
        real(wp), allocatable :: room(:, :, :)
        !> Elimination at restraints, shape (lanes, restraints, 5)
        real(wp), allocatable :: turning(:, :, :)
    end type pack_type

    !> What the links of all cases are made of, pieces from left to right
    type :: lane_pieces_type
        !> Last piece of every link, 0 before the first, shape (0:n)
        integer, allocatable :: last(:)
        !> Length; distance of the left end from that of the link, of the right end from its right end, shape (npiece)
        real(wp), allocatable, dimension(:) :: length, before, behind
        !> 1/EI and 1/GA, shape (1 or lanes, npiece)
        real(wp), allocatable, dimension(:, :) :: flexibility, shear_flexibility
        !> 1, 2, ..., and half of the length, shape (npiece)
        integer, allocatable :: number(:)
        real(wp), allocatable :: half(:)
        !> What loads with factor 1 put on pieces: which load, which piece; load per length at both ends, imposed curvature, force
        !> and couple at the right end (piece_load_type), shape (5, :)
        integer, allocatable :: load(:), piece(:)
        real(wp), allocatable :: to_piece(:, :)
    end type lane_pieces_type

    !> What is rounded in all cases
    type :: lane_rounding_type
        !> Of the loads, relative to their sizes (load_size, turn_size)
        real(wp) :: of_loads = 0.0_wp
        !> Of the flexibilities of links, of their lengths relative to these, and of fields where pieces begin inside them relative
        !> to the sizes of their terms, shape (n)
        real(wp), allocatable, dimension(:) :: flexibility, length, of_fields
        !> Deflection by shear that a shear of 1 makes along a link, shape (n)
        real(wp), allocatable :: slip(:)
    end type lane_rounding_type

    !> What links and what loads do to them are made of, where the stiffnesses of spans differ from case to case
    type :: lane_spans_type
        !> Of EI and GA: to the engine's units; what they are between here, at first nothing
        real(wp), dimension(2) :: power = 1.0_wp, least = 1.0_wp, most = 0.0_wp
        !> Stiffness of the softest support
        real(wp) :: softest = 0.0_wp
        !> Span that gives EI and GA of every piece, 0: their own; the flexibilities that these make, shape (2, npiece)
        integer, allocatable :: span(:, :)
        real(wp), allocatable :: own(:, :)
        !> Last piece of every link, 0 before the first, shape (0:n); lengths of the pieces, and distances of their left ends from
        !> those of the links
        integer, allocatable :: last(:)
        real(wp), allocatable :: length(:), before(:)
        !> What loads do to links, as in lane_beam_type: which link, and the last of the terms of each, 0 before, shape (0:)
        integer, allocatable :: link(:), last_term(:)
        !> For every piece of the link: moment_integrals, curvature times half of the length, weights of these at the left and at
        !> the right end of the piece for rotations at the left and at the right end of the link, change of the moment, sum of its
        !> sizes, couple at the right end; shape (10, :)
        real(wp), allocatable :: terms(:, :)
        !> What turn_sum of link_type has without bending, and times bending; shape (2, :)
        real(wp), allocatable :: sizes(:, :)
    end type lane_spans_type

    !> Pieces of eight cases
    type :: piece_pack_type
        !> Loads, as in to_piece, shape (lanes, npiece, 5)
        real(wp), allocatable :: loads(:, :, :)
        !> Deflection, rotation, moment, shear at the left ends, shape (lanes, npiece, 4)
        real(wp), allocatable :: starts(:, :, :)
        !> Room for them, shape (lanes, npiece, 3)
        real(wp), allocatable :: room(:, :, :)
    end type piece_pack_type

contains

    !> Room for the pieces of eight cases
    subroutine new_piece_pack(pieces, pack, made)
        !> Pieces
        integer, intent(in) :: pieces
        type(piece_pack_type), intent(out) :: pack
        !> False where memory ends
        logical, intent(out) :: made
        integer :: stat

        allocate (pack%loads(lanes, pieces, 5), pack%starts(lanes, pieces, 4), pack%room(lanes, pieces, 3), stat=stat)
        made = stat == 0
    end subroutine new_piece_pack

    !> Room for eight cases
    subroutine new_pack(beam, pack, made)
        !> The beam, with its links
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(out) :: pack
        !> False where memory ends
        logical, intent(out) :: made
        integer :: n, last, m, stat

        n = beam%n
        m = size(beam%shared)
        last = beam%last_place(m)
        allocate (pack%left(lanes, 0:n), pack%right(lanes, 0:n), pack%shear(lanes, 0:n), pack%couple(lanes, 0:n), &
                  pack%load_size(lanes, 0:n), pack%turn_size(lanes, 0:n), pack%stiffness(lanes, 0:last), &
                  pack%rigid(lanes, 0:last), pack%contact(lanes, 0:last), pack%closed(lanes, 0:last), pack%load(lanes, m), &
                  pack%held(lanes, 0:n), pack%known(lanes, 0:n), pack%spring(lanes, 0:n), pack%force(lanes, 0:n), &
                  pack%w(lanes, 0:n), pack%ml(lanes, 0:n), pack%mr(lanes, 0:n), pack%reaction(lanes, 0:last), &
                  pack%turn_rest(lanes, 0:last), pack%force_rest(lanes, 0:n), pack%known_rest(lanes, 0:n), &
                  pack%dw(lanes, 0:n), pack%dl(lanes, 0:n), pack%dr(lanes, 0:n), pack%turn(lanes, 0:n), &
                  pack%spare(lanes, 0:n), pack%left_rest(lanes, 0:n), pack%room(lanes, 0:n, 10), &
                  pack%turning(lanes, size(beam%restrained), 5), pack%links(size(beam%links, 1), link_numbers, n), stat=stat)
        made = stat == 0
        if (.not. made) return
        pack%links(:, :, :) = beam%links
        pack%spare(:, :) = 0.0_wp
        pack%left_rest(:, :) = 0.0_wp
    end subroutine new_pack

end module gapbeam_lane_types
