!> Thresholds that decide a state, each told once: what it bounds, why this value, who reads it. What is only tuned says so.
!> Those along paths and under trains stand in gapbeam_path_tolerances, counts in gapbeam_limits. Compiled in double and in
!> quadruple precision.
module gapbeam_tolerances
    use gapbeam_kinds, only: wp, dp, qp
    use gapbeam_limits, only: most_steps_on_curves
    implicit none
    private
    public :: sign_width, worst_digits, worst_correction, rounding_unit, extreme_margin, proximal_ratio, splitter
    public :: position_tolerance, end_tolerance, cubic_rounding, settled_on_laws, most_unit_power, narrowest_interval
    public :: narrowest_patch, patch_rounding, newton_leaves, ground_ulps, no_decay_left, root_piece_length, same_parameters
    public :: tanh_is_one, largest_field, no_curve_slope, beginning_of_way, step_caution, same_compression, least_share
    public :: little_compression, long_compression, mode_digits, mode_width, same_length, no_decay_length, shortest_step
    public :: most_root_pieces, taylor_tail, root_place, pivot_digits, hidden_change, pivot_hair, least_quad_pivot, near_zero
    public :: last_width, rounding_product, most_in_subdomains, subdomain_lengths, boundary_share, first_spring
    public :: first_reaction_share, last_correction, harmless_correction, no_work, no_speed, clearly_more, least_spring_force
    public :: at_rest_share, short_zone, one_crossing, one_place_on_curves, touching_width, lying_width, lone_node_zone
    public :: parts_of_decay, straight_force, no_node_slope, balanced, flat_energy, first_way, last_way, moving_noise
    public :: far_from_solution, largest_ratio, most_ahead, same_ends, unmoved_share, straight_field, stationary_place
    public :: mesh_rounding, fine_width, most_left_out, most_hidden, given_leeway, least_force_share, softest_hinge, steepest_taper
    public :: most_deepening, everywhere, audit_allows, movement_safety, fine_error, upward, rough, nearly_settled, fine_ends
    public :: movable_ends, no_displacement, min_tied_zone, least_tied_share, most_tied_slope, no_tied_force, no_ground_work
    public :: fine_rounding, near_motion, ground_fine_width, same_ratio_of_slopes, lost_digits, same_slope, touching_distance
    public :: same_extreme, rigid_noise, shortest_zone, same_level, rigid_places, fine_rigid_places, worst_shear_digits
    public :: largest_error_share, second_order, greatest_squared, smallest_squared, greatest_product, smallest_product, least_load
    public :: unknown_movement, audit_unit, refined_rest, underflow_takes, cut_load_error, no_mode_value

    !> Rounding errors beyond which a sign counts. The estimates of rounding are sums of first order; 32 of them have never been
    !> exceeded by the attacks, and what lies within goes to quadruple precision, so that more would only cost time. Read by
    !> cases/lane_reactions, cases/lane_shared, cases/scheme_responses, cases/segment_finish, contact/contact_state,
    !> contact/evaluation, contact/rules, continuation/affine_response, moving_load/train_margins, precision/extended_precision,
    !> precision/ground_solution, precision/undecided
    real(wp), parameter :: sign_width = 32.0_wp
    !> Rounding error of a reaction, relative to the largest, from which on quadruple precision is worth its time: half of the
    !> digits of a double. Read by cases/lane_reactions, cases/segment_finish, precision/extended_precision
    real(wp), parameter :: worst_digits = 1e-8_wp
    !> Correction of deflections, relative to the largest, that refining them once may leave too much of: it leaves about the
    !> square, 1e-12. Read by cases/lane_reactions, precision/extended_precision
    real(wp), parameter :: worst_correction = 1e-6_wp
    !> Roundings of a row of the system, or of a term of a field's polynomial, at most: four operations each. Read by
    !> cases/lane_certificate, cases/lane_row_errors, continuation/affine_response, precision/certificate, response/solution
    real(wp), parameter :: rounding_unit = 4*epsilon(1.0_wp)
    !> Share of a field by which a bound of it is widened before a piece is left out of the search for extremes: far more than
    !> rounding, and too little to cost pieces. Read by beam/fields, cases/lane_roots
    real(wp), parameter :: extreme_margin = 1.0e-6_wp
    !> Weak springs of the proximal iteration relative to the softest stiffness present: a third of the digits, so that two rounds
    !> leave nothing but rounding. Read by cases/lane_blocks, cases/lane_spans, contact/contact_state, contact/ground_energy
    real(wp), parameter :: proximal_ratio = 10.0_wp**(-precision(1.0_wp)/3)
    !> Splits a number into two halves of its bits (Dekker 1971, Numer. Math. 18, 224). Read by cases/lane_residual,
    !> elimination/elements, elimination/residual
    real(wp), parameter :: splitter = 2.0_wp**((digits(1.0_wp) + 1)/2) + 1

    !> Positions whose difference is at most this share of the larger one are the same place: sums of some sixty spans may be so
    !> far off. Read by moving_load/train, moving_load/train_on_beam, response/query, response/smooth_tangents, scene/assemble_laws,
    !> scene/assemble_supports, scene/axial_force, scene/check, scene/check_foundations, scene/check_rigid_ground, scene/stations
    !> and, through the engine, by gapbeam.scene.places
    real(wp), parameter :: position_tolerance = 64*epsilon(1.0_wp)
    !> A place beyond an end of the beam by at most this share of its length is at that end: so much can a sum of spans be off.
    !> Read by response/query, scene/check and, through the engine, by gapbeam.scene.trains
    real(wp), parameter :: end_tolerance = 1.0e-12_wp
    !> By this share k2 of a cubic law may be less than what is allowed: decimals are rounded. Read by scene/check_ground_laws,
    !> scene/support_laws
    real(wp), parameter :: cubic_rounding = 2.0_wp**(-50)
    !> Relative change of a displacement on a smooth law, or of the load factor of an event there, below which another tangent
    !> changes nothing. Read by continuation/smooth_events, response/smooth_state, response/smooth_tangents
    real(wp), parameter :: settled_on_laws = 4*epsilon(1.0_wp)

    !> Powers of two of the units of a case up to which its numbers stay doubles: their range is 2**1023. Read by
    !> cases/case_extremes, cases/lane_cases
    integer, parameter :: most_unit_power = 1000

    !
    ! Numbers and polynomials
    !
    !> Parts of the interval from 0 to 1 narrower than this are not looked into for roots: less than rounding of the place is left.
    !> Read by base/bernstein
    real(wp), parameter :: narrowest_interval = 2.0_wp**(-50)
    !> The same of patches in two variables: a value at an extreme is off by the square of what is left. Read by base/patch
    real(wp), parameter :: narrowest_patch = 2.0_wp**(-30)
    !> What coefficients of a patch that should be equal differ by at most, as a share of the largest. With less, values that stay
    !> the same in one direction are cut there without end; what is found within it is made exact by Newton's method. Read by
    !> base/patch
    real(wp), parameter :: patch_rounding = 2.0_wp**(-45)
    !> Share of a patch by which Newton's method may leave it, or move, before it is given up; tuned. Read by base/patch
    real(wp), parameter :: newton_leaves = 2.0_wp**(-16)

    !
    ! A stretch of beam
    !
    !> Units of the last place by which a value on elastic ground may be wrong, of the sum of what it is made of: operations in a
    !> row of it. Read by beam/foundation_pieces
    real(wp), parameter :: ground_ulps = 16.0_wp
    !> Decay lengths after which nothing is left but the load's own deflection: exp(-x) is below rounding. Read by
    !> beam/foundation_roots
    real(wp), parameter :: no_decay_left = 1.1_wp*digits(1.0_wp)*0.7_wp
    !> Length of a piece, in decay lengths, in which roots are sought: fields there have few; tuned. Read by beam/foundation_roots
    real(wp), parameter :: root_piece_length = 1.5_wp
    !> Parameters of a law keep a ratio along a stretch if they do to this share: they are rounded to doubles. Read by
    !> beam/law_series
    real(wp), parameter :: same_parameters = 2.0_wp**(-47)
    !> From here on a tanh is 1 to rounding. Read by beam/law_series
    real(wp), parameter :: tanh_is_one = 0.35_wp*digits(1.0_wp) + 0.7_wp
    !> Beyond this size there are no fields on curves: products of four of them would overflow. Read by beam/curved
    real(wp), parameter :: largest_field = sqrt(sqrt(huge(1.0_wp)))
    !> Slopes of a curve, relative to its steepest, that are none: elimination would lose its range to them. Read by beam/curved
    real(wp), parameter :: no_curve_slope = 2.0_wp**(-100)
    !> Part of a way at which it is seen on which side of the contact it begins: beyond rounding, before it can turn; tuned. Read
    !> by beam/curved
    real(wp), parameter :: beginning_of_way = 2.0_wp**(-8)
    !> Part of the length that the last terms of a series allow which a step takes; tuned. Read by beam/curved
    real(wp), parameter :: step_caution = 0.9_wp
    !> Products of decay and length below this make the stretch one without ground: the next term of the series is below rounding.
    !> Read by beam/foundation_long
    real(wp), parameter :: no_decay_length = 1e-18_wp
    !> A shorter step on curves, in parts of the stretch, gets nowhere. Read by beam/curved
    real(wp), parameter :: shortest_step = 1/real(most_steps_on_curves, wp)**2
    !> Pieces of a stretch in which roots are sought: beyond it the stretch is longer than all decay. Read by beam/foundation_roots
    real(wp), parameter :: most_root_pieces = 1e6_wp
    !> A term of a Taylor series below this is the last: those that follow shrink. Read by beam/foundation_taylor
    real(wp), parameter :: taylor_tail = epsilon(1.0_wp)/16
    !> A step of Newton's method below this part of the stretch is the last. Read by beam/foundation_zeros, cases/lane_roots
    real(wp), parameter :: root_place = 2*epsilon(1.0_wp)

    !> Share by which lengths of equal steps may differ: rounding of the places of their ends. Read by beam/foundation_stretch
    real(wp), parameter :: same_length = 4*epsilon(1.0_wp)
    !> Width of a bracket of a mode beside its value, below the rounding of a double. Read by contact/mode_values
    real(wp), parameter :: mode_width = epsilon(1.0d0)/32
    !> Value of a mode beside the first step below which it is 0: halving goes no farther. Read by contact/mode_values
    real(wp), parameter :: no_mode_value = 1e-290_wp
    !> Part of a share of the axial forces to which is found when a beam buckles: rounding of states near there. Read by
    !> precision/compressed, precision/falling_way
    real(wp), parameter :: same_compression = 2.0_wp**(-44)
    !> Least share looked for to all digits; tuned. Read by precision/compressed, precision/falling_ground, precision/falling_way
    real(wp), parameter :: least_share = 2.0_wp**(-30)
    !> Phase of a wave under compression along one piece from which on the share that a beam may bear at all is looked for first;
    !> tuned: shorter ones are cut into a few stretches. Read by precision/compressed
    real(wp), parameter :: long_compression = 4.0_wp
    !> Share by which more of the axial forces are tried there, and of the greatest force that is hardly any; tuned: the last
    !> state is nearer. Read by precision/compressed, precision/falling_ground, precision/unloaded_beam
    real(wp), parameter :: little_compression = 2.0_wp**(-14)
    !> Share by which a value of a mode is off in double precision, mostly; tuned. Read by contact/mode_values
    real(wp), parameter :: mode_digits = 2.0_wp**(-36)

    !
    ! Elimination
    !
    !> Rounding of a pivot of the chain as a share of its terms: four operations. Read by elimination/band
    real(wp), parameter :: pivot_digits = 4*epsilon(1.0_wp)
    !> Change, relative to the solution, that cannot be seen in it even if it comes back a thousand times. Read by
    !> elimination/band_substitution
    real(wp), parameter :: hidden_change = 2.0_wp**(-10)*epsilon(1.0_wp)
    !> In place of a pivot that is zero only until the next unknowns are eliminated, as a share of its row: below rounding. Read by
    !> elimination/pivoting
    real(wp), parameter :: pivot_hair = 2.0_wp**(-56)
    !> A pivot in quadruple precision that has shrunk to this share of its row and column is zero but for rounding. Read by
    !> elimination/band_solver_quad
    real(qp), parameter :: least_quad_pivot = 2.0_qp**(-90)

    !
    ! Contact of supports
    !
    !> Margins, as a share of what they are made of, below which supports are watched: far above all rounding errors; tuned. Read
    !> by contact/signs
    real(wp), parameter :: near_zero = 2.0_wp**19*epsilon(1.0_wp)
    !> Rounding errors to which the width of doubt is widened at most where signs still flicker: half of the digits. Read by
    !> contact/search
    real(wp), parameter :: last_width = 1e7_wp
    !> When reactions times openings have fallen to this share, rounding has taken over. Read by contact/search
    real(wp), parameter :: rounding_product = sqrt(epsilon(1.0_wp))
    !> Largest share of the beam that the subdomains of a round may have: beyond it the whole is as cheap; tuned. Read by
    !> contact/search
    real(wp), parameter :: most_in_subdomains = 0.7_wp
    !> How often the length over which a boundary is felt goes into the margin of a subdomain; tuned. Read by contact/subdomain
    real(wp), parameter :: subdomain_lengths = 3.0_wp
    !> Fraction of the way to the boundary that a step of the interior-point method goes (Mehrotra 1992, SIAM J. Optim. 2, 575).
    !> Read by contact/interior_point
    real(wp), parameter :: boundary_share = 0.995_wp
    !> First springs of the interior-point method relative to the stiffness of the whole beam; tuned. Read by
    !> contact/interior_point
    real(wp), parameter :: first_spring = 100.0_wp
    !> Share of the largest reaction added to all at first, so that the method begins inside; tuned. Read by contact/interior_point
    real(wp), parameter :: first_reaction_share = 0.1_wp
    !> A correction this small relative to the solution is the last one: the next is its square. Read by contact/update
    real(wp), parameter :: last_correction = sqrt(epsilon(1.0_wp))
    !> A correction of a kept solution that is no larger beside it has not cost digits; tuned. Read by contact/update
    real(wp), parameter :: harmless_correction = 10.0_wp
    !> Work of the loads along a free motion, relative to the sum of its parts, that counts as none: places and loads are rounded
    !> to doubles, whatever the precision here. Read by contact/unbounded_motions
    real(wp), parameter :: no_work = max(4096*epsilon(1.0_wp), 8*real(epsilon(1.0_dp), wp))
    !> Speed of a support, relative to the largest, that counts as none: the same. Read by contact/contact_state
    real(wp), parameter :: no_speed = max(512*epsilon(1.0_wp), 4*real(epsilon(1.0_dp), wp))
    !> So many times that much is clearly more; tuned. Read by contact/unbounded_motions
    real(wp), parameter :: clearly_more = 1024.0_wp
    !> Forces of the weak springs, relative to loads and shears, that come from rounding of these. Read by contact/contact_state
    real(wp), parameter :: least_spring_force = 8*real(epsilon(1.0_dp), wp)
    !> A reference position that moves by less than this share of its deflections is at rest: rounding of a beam that is nearly
    !> free. Read by contact/contact_state
    real(wp), parameter :: at_rest_share = 4096*epsilon(1.0_wp)

    !
    ! Contact with the ground
    !
    !> Zones of a smaller share of the beam, or of what the ground holds elsewhere, and pivots of which compression leaves less than
    !> the square of it, lose digits that refining brings back; tuned. Read by contact/system
    real(wp), parameter :: short_zone = 2.0_wp**(-10)
    !> Crossings nearer to each other than this share of the length of their piece are one: rounding of the place. Read by
    !> contact/find_zones
    real(wp), parameter :: one_crossing = 16*epsilon(1.0_wp)
    !> The same share where laws are curves, and for ends on a mesh: in a shorter zone the fields at its ends are known too badly
    !> to go on from. Read by contact/find_zones, contact/mesh_zones
    real(wp), parameter :: one_place_on_curves = epsilon(1.0_wp)**0.75_wp
    !> Distance from a line, beside deflection and line, of crossings taken for rounding; tuned. Read by contact/find_zones
    real(wp), parameter :: touching_width = 2**12*epsilon(1.0_wp)
    !> The same of a beam that lies on it without load. Read by contact/find_zones
    real(wp), parameter :: lying_width = 4*epsilon(1.0_wp)
    !> In how many parts beside it a zone reaches at least that shows at one node only. Read by contact/mesh_zones
    real(wp), parameter :: lone_node_zone = 0.5_wp
    !> Parts of a mesh in a decay length of the ground; tuned. Read by contact/ground_mesh
    real(wp), parameter :: parts_of_decay = 4.0_wp
    !> Share of a force that is beside the straight line between those at the ends of a part, where more nodes are needed; tuned.
    !> Read by contact/ground_mesh
    real(wp), parameter :: straight_force = 0.02_wp
    !> Slopes of the law of a node beside the steepest that are none: a mesh needs no more digits. Read by contact/ground_nodes
    real(wp), parameter :: no_node_slope = 2.0_wp**(-40)
    !> Share of all forces that may be out of balance on a mesh in the end: the mesh itself is off by more. Read by
    !> contact/ground_energy
    real(wp), parameter :: balanced = 1e-9_wp
    !> A slope of the energy that has fallen to this share of what it was ends a line search (Nocedal and Wright 2006, 3.1); tuned.
    !> Read by contact/ground_energy, contact/law_energy
    real(wp), parameter :: flat_energy = 0.1_wp
    !> A motion goes so many times the length of the beam at first; tuned. Read by contact/ground_energy, contact/law_energy
    real(wp), parameter :: first_way = 1e-6_wp
    !> And so many times at last: then nothing stops it. Read by contact/ground_energy, contact/law_energy
    real(wp), parameter :: last_way = 1e14_wp
    !> Ends that are moved by rounding alone move by less than this share of the stretches beside them; tuned. Read by
    !> contact/zones
    real(wp), parameter :: moving_noise = epsilon(1.0_wp)**0.375_wp
    !> An end that moves by more of the stretches beside it is far from the solution; tuned. Read by contact/zones
    real(wp), parameter :: far_from_solution = 0.01_wp
    !> Then it goes farther, as if it had moved by this share of the move before at most; tuned. Read by contact/zones
    real(wp), parameter :: largest_ratio = 0.92_wp
    !> And by this share of the stretch ahead at most; tuned. Read by contact/zones
    real(wp), parameter :: most_ahead = 0.4_wp
    !> Ends that have come back differ by less than this share of the stretches beside them; tuned. Read by contact/zones
    real(wp), parameter :: same_ends = 1e-5_wp
    !> What moves by less than this share of the beam does not move: so short zones have no force, and behind a part of the beam
    !> that next to no ground holds no end is known better. Read by contact/zones
    real(wp), parameter :: unmoved_share = sqrt(epsilon(1.0_wp))
    !> Fields near which curves are taken for straight need no more digits than these: the way squared is below rounding. Read by
    !> contact/zone_fields
    real(wp), parameter :: straight_field = 2e-14_wp
    !> Share of a stretch to which the place is found where a way is stationary: the way is off by the square of it. Read by
    !> contact/zone_margin
    real(wp), parameter :: stationary_place = sqrt(epsilon(1.0_wp))/64
    !> Rounding of a force on a mesh as a share of slopes times the largest deflection: eight operations. Read by
    !> contact/ground_energy
    real(wp), parameter :: mesh_rounding = 8*epsilon(1.0_wp)

    !
    ! Precision
    !
    !> Rounding errors in quadruple precision beyond which a sign counts: some digits more than in doubles are given away, there
    !> are enough of them. Read by precision/ill_scaled_signs, precision/undecided
    real(qp), parameter :: fine_width = 2.0_qp**17
    !> Share of the largest load up to which a reaction that is nothing but rounding is left out: half of the digits of a double.
    !> Read by precision/audit, precision/extended_precision
    real(wp), parameter :: most_left_out = 2.0_wp**(-27)
    !> Share of the largest load up to which rounding may hide a reaction of which nothing is left; tuned. Read by
    !> precision/extended_precision
    real(qp), parameter :: most_hidden = 2.0_qp**(-10)
    !> Roundings by which signs of a contact state that is known from the path may be wrong: the last digit of the load factor
    !> moves a beam that is nearly unstable so far. Read by precision/extended_precision
    real(wp), parameter :: given_leeway = 2.0_wp**26
    !> Forces below this share of the largest one do not matter: they are less than doubles promise. Read by
    !> precision/ill_scaled_signs
    real(qp), parameter :: least_force_share = 2.0_qp**(-44)
    !> Compliance of an elastic hinge, beside that of the whole beam (int 1/EI), above which it is refused: its rotation would hide
    !> gaps behind its rounding, and as a free hinge it is off by less than 1/this. Read by scene/assemble_hinges
    real(wp), parameter :: softest_hinge = 1e10_wp
    !> Ratio of a stiffness at both ends of a section beyond which it is refused: integrals take an interval for each factor of two
    !> in depth. Read by scene/check
    real(wp), parameter :: steepest_taper = 1e12_wp
    !> Growth of the depth of a tapered beam along a stretch on ground: a Taylor series loses a factor of four with every term, so
    !> quadruple precision takes sixty of them; tuned. Read by beam/taper
    real(wp), parameter :: most_deepening = 1.25_wp
    !> Share of the largest terms of the beam that count as terms of every sum: elimination carries their rounding everywhere, and
    !> refining leaves the square of it. Read by precision/audit
    real(wp), parameter :: everywhere = 2.0_wp**(-40)
    !> Roundings, of all terms of a sum together, that the audit takes for rounding: the attacks have seen no more than some
    !> twenty. Read by precision/audit, precision/ledger
    real(wp), parameter :: audit_allows = 64.0_wp
    !> Movements and differences in error bounds are taken so many times: they are estimates, hardly ever more than so many times
    !> too small. Read by precision/certificate, precision/undecided, precision/ground_solver
    real(wp), parameter :: movement_safety = 4.0_wp
    !> Error of a certificate's solution in quadruple precision, relative to the sizes of its terms; far more than was seen. Read
    !> by precision/certificate
    real(qp), parameter :: fine_error = 2.0_qp**20*epsilon(1.0_qp)
    !> Factor by which a difference in quadruple precision is enlarged before it is rounded to a bound: more than rounding takes
    !> away. Read by precision/certificate
    real(qp), parameter :: upward = 1 + 64*epsilon(1.0_wp)
    !> Share of the stretches beside them by which ends may still move in the round of a start that is taken for the last one;
    !> tuned. Read by precision/ground_solver, precision/ground_start
    real(wp), parameter :: rough = 1e-10_wp
    !> Share of the stretches beside them by which ends may still move in the last round in double precision, and in quadruple
    !> precision; tuned. Read by precision/ground_solver
    real(wp), parameter :: nearly_settled = 1e-2_wp
    !> The same in quadruple precision: what is left is the square of it. Read by precision/ground_solver
    real(qp), parameter :: fine_ends = 1e-15_qp
    !> Ends that still move by no more are taken, with the fields there: what is left is the square of the way. Read by
    !> precision/ground_solver
    real(qp), parameter :: movable_ends = 1e-11_qp
    !> Deflections, moments and forces of a smaller share of the greatest are nothing where it is asked whether a beam touches rigid
    !> ground; tuned. Read by contact/rigid_state
    real(wp), parameter :: rigid_noise = 2.0_wp**20*epsilon(1.0_wp)
    !> Levels of rigid ground whose difference is a smaller share of them are one: rounding of data, which are doubles in any
    !> precision. Read by contact/rigid_contact
    real(wp), parameter :: same_level = 16*real(epsilon(1.0_dp), wp)
    !> Zones on rigid ground that shrink below this share of their piece are single places; tuned. Read by contact/rigid_zones
    real(wp), parameter :: shortest_zone = 2.0_wp**(-26)
    !> Share of the beam by which places on rigid ground may still move: its square is nothing. Read by precision/rigid_solver
    real(wp), parameter :: rigid_places = 2.0_wp**(-26)
    !> The same in quadruple precision. Read by precision/rigid_solver
    real(qp), parameter :: fine_rigid_places = 2.0_qp**(-80)
    !> Part of the largest displacement that is none, of a motion on the ground or a mode; tuned. Read by
    !> precision/ground_mechanism, precision/ground_solver, response/state_modes
    real(wp), parameter :: no_displacement = 1e-6_wp
    !> Zones of less than this share of the beam have no length: rounding of the place. Read by precision/ground_ties
    real(qp), parameter :: min_tied_zone = 4*epsilon(1.0_wp)
    !> Share of all loads that is nothing while zones are not settled; tuned. Read by precision/ground_ties
    real(qp), parameter :: least_tied_share = 1e-6_qp
    !> Slope in such a zone, in what loads and gaps move the beam by over its length, that has no end. Read by precision/ground_ties
    real(qp), parameter :: most_tied_slope = 1e8_qp
    !> The same where quadruple precision has settled all zones. Read by precision/ground_ties
    real(qp), parameter :: no_tied_force = 1e-20_qp
    !> Work on ground at its limit, relative to its parts, that counts as none: places and loads are rounded to doubles. Read by
    !> precision/ground_limit
    real(qp), parameter :: no_ground_work = 8*epsilon(1.0_wp)
    !> Numbers in quadruple precision that are smaller beside what they are made of are rounding: excess of work, displacements,
    !> forces. Read by precision/ground_limit, precision/ground_solution, precision/ground_ties, response/axial_walk
    real(qp), parameter :: fine_rounding = 2.0_qp**(-90)
    !> How near to a motion its search comes: the work is wrong by the square of that. Read by precision/ground_limit
    real(qp), parameter :: near_motion = 2.0_qp**(-52)
    !> Roundings in quadruple precision below which a reaction beside ground is none; tuned. Read by precision/ground_solution
    real(qp), parameter :: ground_fine_width = 4096.0_qp
    !> Share by which slope and modulus may part along a stretch and have one ratio: rounding of their products. Read by
    !> precision/ground_solution
    real(qp), parameter :: same_ratio_of_slopes = 64*epsilon(1.0_qp)
    !> Rounding of quadruple precision, some digits of it lost, in that of doubles. Read by precision/ground_audit,
    !> precision/ground_fields
    real(wp), parameter :: lost_digits = 2.0_wp**(-90)/epsilon(1.0_wp)

    !
    ! Scenes and answers
    !
    !> Slopes of points that are rounded may differ by this share and be the same: nine digits are given. Read by scene/check_laws
    real(wp), parameter :: same_slope = 1e-9_wp
    !> Distances between beam and ground of so many roundings of what they are made of are none: as sign_width. Read by
    !> response/ground_distance
    real(wp), parameter :: touching_distance = 32*epsilon(1.0_wp)
    !> Values that differ by less than this share are the same, and the first of them, from the left, is taken: else rounding would
    !> choose among those of a symmetric beam. Read by response/ground_query, response/transverse
    real(wp), parameter :: same_extreme = 4*epsilon(1.0_wp)

    !
    ! Cases side by side
    !
    !> Rounding error of a shear, relative to the largest, from which on it has too few digits: worst_digits with a digit to spare.
    !> Read by cases/lane_fields
    real(wp), parameter :: worst_shear_digits = 1e-9_wp
    !> Bounds of first order hold so long as they are smaller shares of what they bound. Read by cases/lane_certificate
    real(wp), parameter :: largest_error_share = 2.0_wp**(-20)
    !> Factor for what is beyond first order, so long as what is off is a small share. Read by cases/lane_row_errors
    real(wp), parameter :: second_order = 1 + 2.0_wp**(-16)
    !> Numbers above it, or below its reciprocal, leave too little room for products of four: huge is 1e308. Read by
    !> cases/lane_certificate, cases/lane_row_errors
    real(wp), parameter :: greatest_squared = 1e70_wp
    !> The reciprocal. Read by cases/lane_row_errors
    real(wp), parameter :: smallest_squared = 1e-70_wp
    !> Numbers above it, or below its reciprocal, leave too little room for products of three. Read by cases/lane_fields
    real(wp), parameter :: greatest_product = 1e100_wp
    !> The reciprocal. Read by cases/lane_fields
    real(wp), parameter :: smallest_product = 1e-100_wp
    !> A load below this leaves too little room for products of two. Read by cases/lane_extremes
    real(wp), parameter :: least_load = 1e-150_wp
    !> More than any movement: a rotation that is known through the neighbour only. Read by cases/lane_error_ellipses
    real(wp), parameter :: unknown_movement = 1e100_wp
    !> Roundings of a term in the audit of cases side by side, at most: operations in a row. Read by cases/lane_audit
    real(wp), parameter :: audit_unit = 16.0_wp*epsilon(1.0_wp)
    !> What refining a solution once may leave beside these, of all terms of a case: rounding of what rounding is corrected by. Few
    !> cases have terms so small beside others. Read by cases/lane_audit
    real(wp), parameter :: refined_rest = 2.0_wp**(-20)*epsilon(1.0_wp)
    !> What underflow may take: the smallest double times all terms of a sum. Read by cases/lane_audit
    real(wp), parameter :: underflow_takes = 1e-290_wp
    !> Rounding of loads that go on over several links, relative: six operations. Read by cases/case_certificates
    real(wp), parameter :: cut_load_error = 6*epsilon(1.0_wp)

end module gapbeam_tolerances
