!> Counts at which something is given up, cut off or done another way: what each bounds, why so many, who reads it.
!> Those that are only tuned say so. Compiled in double and in quadruple precision.
module gapbeam_limits
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: most_path_segments, changes_at_a_time, most_extreme_ties, most_train_states, most_steps_on_curves
    public :: most_taylor_terms, most_power, most_panels, most_waiting_patches, most_nodes_solved, least_solves
    public :: segments_a_breakpoint, short_chain_bars, limits_anew_bars
    public :: non_monotone_solves, warm_non_monotone_solves, polish_non_monotone_solves, last_non_monotone_solves
    public :: law_non_monotone_solves, final_non_monotone_solves, rounding_changes, most_guess_steps, few_guess_changes
    public :: steps_between_guesses, subdomain_rounds, few_wrong_supports, long_beam_links, least_margin_nodes, nodes_apart
    public :: most_corrections, most_moves, most_refinements, most_mesh_rounds, most_node_rounds, most_line_steps, most_law_steps
    public :: most_nodes_asked, least_mesh_parts, most_first_parts, most_mesh_parts, mesh_cuts, most_zone_rounds
    public :: most_polishing, parts_of_stretch, most_root_steps, most_examined, most_flips, most_tie_solves, last_try
    public :: most_solves_under_more, most_solves_followed
    public :: last_if_tied, most_edge_nodes, most_stiffer, most_motion_steps, most_at_once, short_beam_links, most_looks
    public :: looks_without_progress, most_idle_segments, most_train_changes, most_of_each, most_halves, bound_trials
    public :: cache_block, support_block, least_cases, most_lane_links, most_lane_solves, most_stiffness_power
    public :: most_stiffness_unit, most_load_terms, least_segment_links, most_segment_solves
    public :: segment_non_monotone_solves, end_non_monotone_solves, few_in_segments, few_segment_solves, most_segment_rounds
    public :: most_rigid_rounds, first_rigid_parts, most_rigid_meshes, most_mode_stretches, most_halvings, most_asides
    public :: least_compressions, most_compressions, most_states_of_load, most_fresh_starts, mode_parts
    public :: neighbourhood, kept_columns, most_lane_root_steps, case_batch, most_tangents, most_branch_points
    public :: most_schemes, most_scheme_changes, most_response_numbers, most_cancelled, most_stretchings
    public :: most_decays_in_tension

    !> Tangents in place of smooth laws of supports, at most; some five do, a search by energy may take fifty. Read by
    !> continuation/smooth_events, response/smooth_state
    integer, parameter :: most_tangents = 100
    !> Steps after which a branch beyond a bifurcation on smooth laws is given up; tuned: some fifty do. Read by
    !> continuation/smooth_branches
    integer, parameter :: most_branch_points = 5000
    !> Segments after which a path through a history is cut off: without a history there are finitely many, with one a beam may
    !> flip to and fro without end. Read by continuation/full_load, face/api_history and, through the engine, by
    !> gapbeam.results.paths
    integer, parameter :: most_path_segments = 20000
    !> So many more for every breakpoint of a law and every load factor that is gone to: each may be passed on the way there. Read
    !> by continuation/smooth_path
    integer, parameter :: segments_a_breakpoint = 4
    !> Bars up to which a chain along the beam is in quadruple precision throughout: that takes no time; tuned. Read by
    !> contact/axial_chain
    integer, parameter :: short_chain_bars = 32
    !> Bars up to which all limits of friction are found anew where one changes: reactions then are those of solves, where lines
    !> leave a digit less; tuned. Read by continuation/friction_limits
    integer, parameter :: limits_anew_bars = 400
    !> Changes of the contact state followed in one call, so that arrays stay small; tuned. Read by continuation/events and,
    !> through the engine, by gapbeam.results.paths
    integer, parameter :: changes_at_a_time = 1000
    !> Places and positions listed at which an extreme under trains is reached; beams with many equal spans have more. Read by
    !> moving_load/train_peaks, moving_load/train_ties
    integer, parameter :: most_extreme_ties = 16
    !> States beyond which a train on the ground or on smooth laws is refused: they would take minutes. Read by
    !> moving_load/train_grid
    integer, parameter :: most_train_states = 20000

    !
    ! A stretch of beam
    !
    !> Steps that a stretch on curves is given; a step shorter than the square of its reciprocal gets nowhere; tuned. Read by
    !> base/tolerances, beam/curved
    integer, parameter :: most_steps_on_curves = 512
    !> Terms of a Taylor series on ground of linear modulus; beyond it the stretch is cut. Read by beam/foundation_pieces,
    !> beam/foundation_taylor, precision/ground_solution
    integer, parameter :: most_taylor_terms = 120
    !> Decay lengths of a beam in tension that tapers, or along which loads change it: some seconds. Read by response/axial_tension
    real(wp), parameter :: most_decays_in_tension = 5000.0_wp
    !> Power of a depth that is linear which a stiffness may be: 4 of a round pole. Read by
    !> beam/foundation_stretch, beam/taper_extremes, scene/check
    integer, parameter :: most_power = 4
    !> Panels of half a stretch in a quadrature: they grow the faster the farther they are from the end. Read by base/quadrature
    integer, parameter :: most_panels = 64
    !> Patches that wait to be looked into; each cut adds one, and they are cut to narrowest_patch in both directions. Read by
    !> base/patch
    integer, parameter :: most_waiting_patches = 120

    !> Stretches beyond which modes are not looked for: some 20,000 waves along a beam. Read by contact/modes,
    !> precision/compressed, precision/uniqueness
    integer, parameter :: most_mode_stretches = 100000
    !> Evaluations of a bracket of a mode, more than quadruple precision has digits; doublings until there is one. Read by
    !> contact/mode_values
    integer, parameter :: most_halvings = 1000
    !> Places beside a value, each four times as far away as the one before, at which modes are counted instead; tuned: the last is
    !> 0.2 per cent away in double precision. Read by contact/mode_values
    integer, parameter :: most_asides = 20
    !> Steps in which axial forces grow where a state may not be the only one; tuned: such paths bend slowly. Read by
    !> precision/compressed
    integer, parameter :: least_compressions = 8
    !> States after which they are given up. Read by precision/compressed
    integer, parameter :: most_compressions = 400
    !> Linear solves after which they are not let grow by smaller steps; next to where a support yields none may lead on. Read by
    !> precision/compressed
    integer, parameter :: most_solves_followed = 2**17
    !> The same as loads grow on ground whose force falls: steps are short where the beam is soft beside that. Read by
    !> precision/falling_ground
    integer, parameter :: most_states_of_load = 10000
    !> Looks for a first state under loads on ground whose force falls that begin on ground that never does; tuned. Read by
    !> precision/falling_ground
    integer, parameter :: most_fresh_starts = 8
    !> Places of a mode on every stretch, so that it can be drawn. Read by precision/compressed, precision/unloaded_beam
    integer, parameter :: mode_parts = 8

    !
    ! Contact of supports
    !
    !> Nodes at which a search may solve, all its solves together: some seconds. Read by contact/workspace
    integer, parameter :: most_nodes_solved = merge(2*10**7, 10**6, precision(1.0_wp) < 20)
    !> Solves it may take in any beam. Read by contact/workspace
    integer, parameter :: least_solves = 1000
    !> Solves that need not make the number of wrong supports fall, from all supports closed; tuned. Read by contact/search
    integer, parameter :: non_monotone_solves = 4
    !> The same from another contact state; tuned. Read by contact/search
    integer, parameter :: warm_non_monotone_solves = 12
    !> The same after a guess; tuned. Read by contact/search
    integer, parameter :: polish_non_monotone_solves = 3
    !> The same between least-index phases; tuned. Read by contact/search
    integer, parameter :: last_non_monotone_solves = 2
    !> The same with laws, which go on by one piece at a time then; tuned. Read by contact/search
    integer, parameter :: law_non_monotone_solves = 40
    !> Newton steps with a line search for laws that go to and fro; ten to thirty are usual. Read by contact/search
    integer, parameter :: most_law_steps = 200
    !> The same after the last guess; tuned. Read by contact/search
    integer, parameter :: final_non_monotone_solves = 16
    !> When reactions times openings have fallen to rounding_product, so many changes of a guess in a step show that rounding has
    !> taken over; tuned. Read by contact/search
    integer, parameter :: rounding_changes = 40
    !> Steps of the interior-point method; it takes ten to twenty. Read by contact/search
    integer, parameter :: most_guess_steps = 60
    !> Changes of its guess in a step at which the guess is tried; tuned. Read by contact/search
    integer, parameter :: few_guess_changes = 4
    !> Steps between two trials; tuned. Read by contact/search
    integer, parameter :: steps_between_guesses = 4
    !> Rounds in which subdomains are settled by themselves: a few in the whole beam, half as many within a subdomain, and so on;
    !> tuned. Read by contact/search
    integer, parameter :: subdomain_rounds = 8
    !> So few wrong supports are looked at more closely; tuned. Read by contact/evaluation, contact/search
    integer, parameter :: few_wrong_supports = 8
    !> Links from which on a changed support does not change everything, and a solution is kept up to date; tuned. Read by
    !> contact/evaluation
    integer, parameter :: long_beam_links = 300
    !> Nodes to be taken along on both sides of wrong supports: at least these, at least the root of all, for stretches in which
    !> the beam hardly lifts are about that long; tuned. Read by contact/subdomain
    integer, parameter :: least_margin_nodes = 20
    !> Nodes between two changes that are made in one; tuned. Read by contact/update
    integer, parameter :: nodes_apart = 16
    !> Corrections of a kept solution: two do as a rule. Read by contact/update
    integer, parameter :: most_corrections = 5
    !> Moves of the reference position of the proximal iteration before giving up; some ten do. Read by contact/contact_state
    integer, parameter :: most_moves = 200

    !
    ! Contact with the ground
    !
    !> Steps that bring digits back where zones are short, or compression leaves little of a pivot. Read by contact/system
    integer, parameter :: most_refinements = 16
    !> Rounds on a mesh, and one more for every node up to most_node_rounds, since on stiff ground zones may shrink by a node at
    !> each end in two rounds. Read by contact/ground_energy
    integer, parameter :: most_mesh_rounds = 200
    !> As above; tuned. Read by contact/ground_energy
    integer, parameter :: most_node_rounds = 512
    !> Steps of a line search: bisection to the last bit. Read by contact/ground_energy, contact/law_energy
    integer, parameter :: most_line_steps = 60
    !> Forces and slopes of nodes that are asked for: where stiffnesses lie hundreds of powers of ten apart no mesh settles. Read
    !> by contact/ground_energy
    integer(int64), parameter :: most_nodes_asked = 2_int64**23
    !> Parts of a mesh of the whole beam at least; tuned. Read by contact/ground_mesh
    integer, parameter :: least_mesh_parts = 64
    !> Parts of the first mesh of a stretch. On ground without curves zones that turn out to be short are cut again: from full
    !> contact on a fine mesh of stiff ground they would shrink by a few parts a round. Read by contact/ground_mesh
    integer, parameter :: most_first_parts = 2**8
    !> Parts of a mesh of all; tuned. Read by contact/ground_mesh
    integer, parameter :: most_mesh_parts = 2**15
    !> Into so many parts those are cut in which zones end, or the force of a curve bends; tuned. Read by contact/ground_mesh
    integer, parameter :: mesh_cuts = 8
    !> Rounds in which ends of zones move, few in quadruple precision; where ends only touch they converge by halves. Read by
    !> contact/zones
    integer, parameter :: most_zone_rounds = merge(200, 40, digits(1.0_wp) < 64)
    !> Rounds that polish them. Read by contact/zones
    integer, parameter :: most_polishing = 12
    !> In each of so many parts of a stretch the slope of a way is taken to vanish once at most; tuned. Read by contact/zone_margin
    integer, parameter :: parts_of_stretch = 6
    !> Steps to where it vanishes: bisection to the last bit. Read by contact/zone_margin
    integer, parameter :: most_root_steps = 60

    !
    ! Precision
    !
    !> Of more supports near zero than these all are named weakly active; tuned. Read by precision/undecided
    integer, parameter :: most_examined = 64
    !> Supports that are flipped before a contact state counts as unknown; tuned. Read by precision/ill_scaled_signs
    integer, parameter :: most_flips = 64
    !> Solves for supports that are at zero; tuned. Read by precision/ill_scaled_signs
    integer, parameter :: most_tie_solves = 64
    !> Zones are tried from full contact, then from meshes, each finer than the one before, up to this one; tuned. Read by
    !> precision/ground_solver
    integer, parameter :: last_try = 5
    !> Not from all of them where no mesh can tell. Read by precision/ground_solver
    integer, parameter :: last_if_tied = 4
    !> Linear solves after which no more load is tried where the given one could not be settled; some hundreds do. Read by
    !> precision/less_load
    integer, parameter :: most_solves_under_more = 8192
    !> Nodes of a mesh that are pressed where the beam stands on edges; tuned. Read by precision/ground_solver
    integer, parameter :: most_edge_nodes = 4
    !> How often a mesh is refined at once where ground has become stiffer; tuned. Read by precision/ground_solver
    integer, parameter :: most_stiffer = 6
    !> Steps of the search for a motion: bisection to the last bit. Read by precision/ground_limit
    integer, parameter :: most_motion_steps = 60

    !
    ! Paths and trains
    !
    !> Of more breakpoints at one factor than these not all combinations are tried: there are 2 to that power. Read by
    !> continuation/outgoing_directions
    integer, parameter :: most_at_once = 12
    !> Links up to which doubt on a path is a reason for quadruple precision; in longer beams only if the end of the path is wrong;
    !> tuned. Read by continuation/path
    integer, parameter :: short_beam_links = 200
    !> Looks at regions for the single way on; tuned. Read by continuation/outgoing_directions
    integer, parameter :: most_looks = 200
    !> Looks without progress in which all that moves the wrong way is passed; tuned. Read by continuation/outgoing_directions
    integer, parameter :: looks_without_progress = 3
    !> Segments without length in turn, beyond four for every breakpoint, after which a path is given up; tuned. Read by
    !> continuation/history, response/axial_walk and continuation/ground_along_path
    integer, parameter :: most_idle_segments = 1000
    !> Changes of the contact state in an interval of positions, beside most_of_each; tuned. Read by moving_load/train_path
    integer, parameter :: most_train_changes = 200
    !> And so many a support; tuned. Read by moving_load/train_path
    integer, parameter :: most_of_each = 20
    !> Where an extreme value may be, stretches are halved up to so many times; tuned. Read by moving_load/train_bounds
    integer, parameter :: most_halves = 5
    !> Stretches on which it is tried whether bounds are to be trusted; tuned. Read by moving_load/train_envelope
    integer, parameter :: bound_trials = 8

    !
    ! Cases side by side
    !
    !> Nodes or steps at a time in arrays that stay in the first-level cache; tuned. Read by cases/lane_audit, cases/lane_residual,
    !> elimination/elements, elimination/residual
    integer, parameter :: cache_block = 64
    !> For so many nodes supports are asked at a time, while what they need is in the cache; tuned. Read by contact/reactions,
    !> contact/workspace
    integer, parameter :: support_block = 128
    !> Fewer cases leave most lanes idle; tuned. Read by cases/many_cases
    integer, parameter :: least_cases = 4
    !> Links: eight cases of longer beams leave the processor's memory, and a case alone is solved faster by itself. From
    !> long_beam_links on the last digits of solve_case may be others; tuned. Read by cases/lane_cases
    integer, parameter :: most_lane_links = 1000
    !> Solves before a case is given up to the search for one case; tuned. Read by cases/lane_search
    integer, parameter :: most_lane_solves = 80
    !> Stiffnesses between 2 to minus this power and 2 to this power in the engine's units leave room for all products, in the
    !> units of the case too. Read by cases/lane_spans
    integer, parameter :: most_stiffness_power = 100
    !> Exponents of the units of stiffnesses up to which powers of two and their products with these are doubles. Read by
    !> cases/lane_spans
    integer, parameter :: most_stiffness_unit = 900
    !> Pieces of links times loads on them: beyond that they leave the processor's memory; tuned. Read by cases/lane_spans
    integer, parameter :: most_load_terms = 100000
    !> Links of a beam that is cut into segments: shorter segments feel each other too much; tuned. Read by cases/segment_cases
    integer, parameter :: least_segment_links = 200
    !> Solves in segments; tuned. Read by cases/segment_search
    integer, parameter :: most_segment_solves = 50
    !> Solves in segments without progress; tuned. Read by cases/segment_search
    integer, parameter :: segment_non_monotone_solves = 5
    !> The same with an end that is wrong; tuned. Read by cases/segment_search
    integer, parameter :: end_non_monotone_solves = 3
    !> Without progress so few wrong supports are changed only where others near them are not; tuned. Read by cases/segment_search
    integer, parameter :: few_in_segments = 16
    !> Or as many as there are after so many solves: before that boundaries move, which takes long step by step; tuned. Read by
    !> cases/segment_search
    integer, parameter :: few_segment_solves = 2
    !> Rounds of a solve in segments: what is not yet exact goes on with the next one; tuned. Read by cases/segment_search
    integer, parameter :: most_segment_rounds = 2
    !> So many nodes farther on supports hardly turn each other round; tuned. Read by cases/segment_search
    integer, parameter :: neighbourhood = 20
    !> Rounds in which what touches rigid ground moves; some ten do, a few in quadruple precision. Read by contact/rigid_ground
    integer, parameter :: most_rigid_rounds = merge(80, 40, digits(1.0_wp) < 64)
    !> Parts of the beam between places at which it may touch rigid ground at first; tuned. Read by precision/rigid_search
    integer, parameter :: first_rigid_parts = 48
    !> Meshes, each four times finer than the one before, after which it is given up; tuned. Read by precision/rigid_solver
    integer, parameter :: most_rigid_meshes = 4
    !> Columns from which on what was passed on into a segment is hardly felt; not longer than is cheap to keep; tuned. Read by
    !> cases/segment_two_sided_sweep, cases/segment_types
    integer, parameter :: kept_columns = 48
    !> Steps of Newton's method kept inside a bracket by bisection. Read by cases/lane_roots
    integer, parameter :: most_lane_root_steps = 200
    !> Schemes whose responses are kept for cases of a beam in stretches; a beam of ten spans has some tens that matter; tuned.
    !> Read by cases/stretch_cases
    integer, parameter :: most_schemes = 256
    !> Changes of scheme by which a case is looked for among them: from one case to the next few do; tuned. Read by
    !> cases/stretch_cases
    integer, parameter :: most_scheme_changes = 8
    !> States of a beam by which the tension of its own stretching is looked for; ten do, and a bracket that is halved takes as many
    !> as a double has bits. Read by response/stretching
    integer, parameter :: most_stretchings = 80
    !> Numbers that all of these responses may hold: 256 MB; tuned. Read by cases/stretch_cases
    integer, parameter :: most_response_numbers = 32000000
    !> A sum of responses may be so much less than its terms: four of its 53 bits are lost then. Read by cases/scheme_responses
    integer, parameter :: most_cancelled = 16
    !> Cases that a call from Fortran solves in one go, so that what they need stays in the cache; tuned. Read by face/api_cases
    integer, parameter :: case_batch = 256

end module gapbeam_limits
