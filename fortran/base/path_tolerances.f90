!> Thresholds along paths and under trains, each told once: what it bounds, why this value, who reads it. What is only tuned says
!> so. Those that decide a state stand in gapbeam_tolerances.
module gapbeam_path_tolerances
    use gapbeam_kinds, only: wp, qp
    implicit none
    private
    public :: narrow_bracket, clear_jump
    public :: load_begin, missing_of_limit, train_slack, train_equal
    public :: first_share_of_way, last_share_of_way, unseen_share, weaker_springs, enter_next_interval, agreement
    public :: shortest_interval, far_from_zero, near_breakpoint, no_rate, same_factor, same_breakpoint, first_train_share
    public :: no_friction, same_reaction, same_slope_of_reaction, larger_reaction
    public :: no_push, no_return, beginning_part, first_slip, found_slip, slip_settled, stiff_part
    public :: nothing_left, shortest_part, slip_audited
    public :: no_slip, found_zone, steady_zone, before_all_slides, bedding_audited
    public :: arc_settled, arc_rounding, arc_noise, dependent_branches, nearest_beside, farthest_beside, no_zero
    public :: longest_beyond, farthest_beyond, beside_branching, first_branch_step, longest_branch_step, shortest_branch_step
    public :: branch_bend, branch_rises, crossing_directions, nearest_crossing, less_independent
    public :: nothing_on_arc, wide_of_polyline, further_than_asked, off_its_law, off_its_polyline
    public :: most_train_share, sliver, least_train_share, train_rounding, most_lost, longest_way, far_below, lebesgue, same_tie

    !> What acts at this share of the way acts from the beginning: at factor 0 a beam without dead load lies on the ground without
    !> any force; tuned. Read by continuation/ground_path, continuation/ground_events and, through the engine, by gapbeam.plots
    real(wp), parameter :: load_begin = 2.0_wp**(-40)
    !> Curves come to their limit where the beam has gone without end: a path is followed until this share of it is missing, or
    !> that; tuned. Read by continuation/ground_problem and, through the engine, by gapbeam.results
    real(wp), dimension(2), parameter :: missing_of_limit = [2.0_wp**(-20), 2.0_wp**(-10)]
    !> Values under trains that differ by less than this share of the largest may be the same, for they are not refined: half of
    !> the digits. Read by moving_load/train_bounds, moving_load/train_curves, moving_load/train_envelope,
    !> moving_load/train_support_bounds
    real(wp), parameter :: train_slack = 2.0_wp**(-26)
    !> Values under trains nearer to the largest than this share of the largest absolute value are equal to it; tuned: rounding of
    !> the influence polynomials stays below 2**-44. Read by moving_load/train_candidates, moving_load/train_curves,
    !> moving_load/train_envelope, moving_load/train_extremes, moving_load/train_peaks
    real(wp), parameter :: train_equal = 2.0_wp**(-40)

    !
    ! Paths
    !
    !> The first factor at which a linear region is looked for is above the given one by this share of the way; tuned. Read by
    !> continuation/linear_region, continuation/history_start
    real(qp), parameter :: first_share_of_way = 2.0_qp**(-40)
    !> None nearer than this is: rounding of the factor. Read by continuation/linear_region
    real(qp), parameter :: last_share_of_way = 2.0_qp**(-48)
    !> What happens within this share of the way is not seen where even quadruple precision cannot tell what falls; tuned. Read by
    !> continuation/linear_region
    real(qp), parameter :: unseen_share = 2.0_qp**(-24)
    !> Weak springs that hold a beam that is free to move, relative to those of the search. Read by continuation/linear_region
    real(qp), parameter :: weaker_springs = 2.0_qp**(-24)
    !> Share of the factor by which the contact state beyond an event is looked for; tuned. Read by continuation/path
    real(wp), parameter :: enter_next_interval = 2.0_wp**(-20)
    !> Factors in double and quadruple precision that differ by less, relative to the way, are the same; and events that may be off
    !> by more in doubles are found in quadruple precision. Read by continuation/path, continuation/stretch
    real(wp), parameter :: agreement = 1e-9_wp
    !> Share of the greatest reaction below which that of a support that rubs is rounding, as where it opens: what it leaves of
    !> friction would be held by nothing. Read by continuation/axial_friction
    real(wp), parameter :: no_friction = 2.0_wp**(-46)
    !> The same of differences of reactions: friction of supports that carry as much is the same. Read by
    !> continuation/axial_friction, continuation/friction_limits
    real(wp), parameter :: same_reaction = 2.0_wp**(-46)
    !> Share of that by which slopes of reactions over the load factor are the same, and limits of friction need not be changed.
    !> Read by continuation/friction_limits
    real(wp), parameter :: same_slope_of_reaction = 2.0_wp**(-3)
    !> Shares of the largest reaction, and slope, beyond which what is rounding is told anew. Read by continuation/friction_limits
    real(wp), parameter :: larger_reaction = 2.0_wp
    !> Share of the loads below which what pushes a node over ground along the beam is rounding. Read by contact/ground_along_slip
    real(wp), parameter :: no_push = 2.0_wp**(-46)
    !> Share of the fastest node below which one that goes back does not. Read by contact/ground_along_slip,
    !> continuation/ground_along_path
    real(wp), parameter :: no_return = 2.0_wp**(-44)
    !> Share of a bar up to which a part that begins beside a node grows as what pushes it does, without moving the node. Read by
    !> contact/ground_along, contact/ground_along_slip
    real(wp), parameter :: beginning_part = 2.0_wp**(-47)
    !> Share of the way over which a beam begins to slide over ground along it: small, as what else changes is left out, by its
    !> square. Read by continuation/ground_along_steps
    real(wp), parameter :: first_slip = 2.0_wp**(-28)
    !> Share of the way to which a change of what slides is found. Read by continuation/ground_along_path
    real(wp), parameter :: found_slip = 2.0_wp**(-50)
    !> Share of the way that is rounding. Read by continuation/ground_along_path
    real(wp), parameter :: nothing_left = 2.0_wp**(-46)
    !> Share of a bar below which a part that becomes shorter is none: where two vanish together one is left. Read by
    !> continuation/ground_along_path
    real(wp), parameter :: shortest_part = 2.0_wp**(-36)
    !> Share of the largest by which a state on ground along the beam may be off, as it comes of steps. Read by
    !> continuation/ground_along_states
    real(wp), parameter :: slip_audited = 1e-10_wp
    !> Share of a bar below which steps over a part may be stiff; tuned. Read by continuation/ground_along_steps
    real(wp), parameter :: stiff_part = 2.0_wp**(-6)
    !> Share of the largest to which the way of parts that slide is followed. Read by continuation/ground_along_steps,
    !> continuation/ground_along_stiff
    real(wp), parameter :: slip_settled = 2.0_wp**(-48)
    !> Share of the limit of ground along the beam by which springs may pass it by rounding, and of the fastest rate by which what
    !> slides may go back, in quadruple precision. Read by contact/bedding_zones
    real(wp), parameter :: no_slip = 2.0_wp**(-50)
    !> Share of a bar to which ends of zones over such springs are found, and shorter than which there is none, in quadruple
    !> precision. Read by contact/bedding_zones, contact/bedding_growth
    real(wp), parameter :: found_zone = 2.0_wp**(-64)
    !> The same where rounding hides more: zones that have just begun. Read by contact/bedding_zones
    real(wp), parameter :: steady_zone = 2.0_wp**(-44)
    !> Share of a way to loads that move all of a beam at which it is looked at instead: zones go with the root of it. Read by
    !> response/bedding_loads
    real(wp), parameter :: before_all_slides = 2.0_wp**(-90)
    !> Share of the largest by which a state on springs along the beam may be off. Read by response/bedding_state
    real(wp), parameter :: bedding_audited = 1e-12_wp
    !> Load intervals shorter than this, relative to the way, may be but a few; tuned. Read by continuation/path,
    !> continuation/steady_path
    real(wp), parameter :: shortest_interval = 2.0_wp**(-30)
    !> Rounding errors beyond which a value on a path is not near zero; tuned. Read by continuation/path
    real(wp), parameter :: far_from_zero = 2.0_wp**16
    !> Rounding errors within which another breakpoint is at zero too; tuned. Read by continuation/region_responses
    real(qp), parameter :: near_breakpoint = 2.0_qp**10
    !> Share of the greatest rate of the beam below which a rate is none, in quadruple precision: refined, what is at rest is off
    !> by the square of a rounding, times a condition number. Read by continuation/region_responses
    real(qp), parameter :: no_rate = 2.0_qp**(-140)
    !> What happens so near to each other, relative to the factor or the way, happens at the same factor. Read by
    !> continuation/path, continuation/stretch
    real(wp), parameter :: same_factor = 1e-15_wp
    !> Breakpoints and ways that differ by less than this share are the same, in quadruple precision: as position_tolerance. Read
    !> by continuation/branch, continuation/branch_state
    real(qp), parameter :: same_breakpoint = 64*epsilon(1.0_qp)

    !
    ! Paths on smooth laws
    !
    !> Relative change at which a state on smooth laws is found: rounding of the deflections; and at which a root along an arc is;
    !> share of a typical force of a law that is nothing. Read by continuation/arc_roots, continuation/arc_states,
    !> continuation/path_states
    real(wp), parameter :: arc_settled = 4*epsilon(1.0_wp)
    !> The same where changes grow no smaller any more: rounding of the solve with springs. Read by continuation/arc_states,
    !> continuation/branch_points
    real(wp), parameter :: arc_rounding = 1e-13_wp
    !> The same after many corrections; and share of the largest eigenvalue below which one is rounding; tuned. Read by
    !> continuation/arc_states, continuation/branch_points, continuation/smooth_branches
    real(wp), parameter :: arc_noise = 1e-9_wp
    !> Relative singular value below which the path branches: the way to the other branch is left out then; tuned. Read by
    !> continuation/arc_states
    real(wp), parameter :: dependent_branches = 1e-6_wp
    !> Distance along an arc at which its direction on one side of a place is looked at first; tuned. Read by
    !> continuation/arc_states
    real(wp), parameter :: nearest_beside = 1e-6_wp
    !> The farthest one, where there is no state nearer; and where a support has left the end of its piece at which it is at the
    !> start of an arc: what it does nearer is not seen; tuned. Read by continuation/arc_states, continuation/smooth_path
    real(wp), parameter :: farthest_beside = 1e-2_wp
    !> Share of its values nearby up to which a function along an arc is zero where it changes its sign; more: another path has
    !> been met. Read by continuation/arc_roots
    real(wp), parameter :: no_zero = 1e-6_wp
    !> Longest step with which a root is looked for beyond the two states of an arc, and most that the path may leave a line between
    !> places that are looked at, in sizes of the deflections and the factor; tuned. Read by continuation/arc_roots
    real(wp), parameter :: longest_beyond = 0.02_wp
    !> How far a root is looked for beyond the two states of an arc, in the same sizes; tuned. Read by continuation/arc_roots
    real(wp), parameter :: farthest_beyond = 0.2_wp
    !> How far beside a bifurcation its branches are looked for, in sizes of the deflections; tuned. Read by
    !> continuation/smooth_branches
    real(wp), parameter :: beside_branching = 0.01_wp
    !> First step along a branch, in sizes of the deflections and the factor; tuned. Read by continuation/smooth_branches
    real(wp), parameter :: first_branch_step = 0.005_wp
    !> Longest such step; tuned. Read by continuation/smooth_branches
    real(wp), parameter :: longest_branch_step = 0.05_wp
    !> Steps shorter than this are none: the branch is lost; tuned. Read by continuation/smooth_branches
    real(wp), parameter :: shortest_branch_step = 1e-7_wp
    !> Most that the direction of a branch may change in a step, so that none is taken to another branch; tuned. Read by
    !> continuation/smooth_branches
    real(wp), parameter :: branch_bend = 0.1_wp
    !> Relative change of the load factor by which a branch rises or falls: less is rounding. Read by continuation/smooth_branches
    real(wp), parameter :: branch_rises = 1e-10_wp
    !> Relative singular value below which a direction is left out where branches cross, and where the load is stationary since they
    !> do, not since it turns round: some 1e-6 at crossings found as such; a turn nearer to one is not seen; tuned. Read by
    !> continuation/arc_states, continuation/smooth_branches
    real(wp), parameter :: crossing_directions = 1e-4_wp
    !> How near to a crossing of branches the equations are looked at; tuned. Read by continuation/branch_points
    real(wp), parameter :: nearest_crossing = 1e-5_wp
    !> How many times less dependent, relative to the distance, than farther away they may be near one; tuned. Read by
    !> continuation/branch_points
    real(wp), parameter :: less_independent = 4.0_wp
    !> Share of the largest reaction or deflection, or of an arc, that is nothing on smooth laws: far above the rounding of the
    !> states, far below what polylines leave out; tuned. Read by continuation/path_on_laws, continuation/smooth_path
    real(wp), parameter :: nothing_on_arc = 1e-9_wp
    !> Distance of states, in sizes of the deflections and the factor, against which the error of the polyline of a smooth law is
    !> small; tuned. Read by continuation/path_on_laws
    real(wp), parameter :: wide_of_polyline = 0.05_wp
    !> By what share of its last leg a path is followed further on the polylines, where it does not come to its end on the laws;
    !> tuned. Read by continuation/smooth_path
    real(wp), parameter :: further_than_asked = 0.1_wp
    !> Share of the largest reaction by which a force may be beside its smooth law: far above rounding; tuned. Read by
    !> continuation/path_states
    real(wp), parameter :: off_its_law = 1e-6_wp
    !> The same where the state is known on the polylines only: what these leave out; tuned. Read by continuation/path_states
    real(wp), parameter :: off_its_polyline = 0.05_wp

    !
    ! Trains
    !
    !> Share of what is left of an interval of positions at which the contact state beyond a change is looked for first; tuned.
    !> Read by moving_load/train_search
    real(wp), parameter :: first_train_share = 2.0_wp**(-20)
    !> Largest share of an interval that is left out where nothing else leads on; tuned. Read by moving_load/train_search
    real(wp), parameter :: most_train_share = 2.0_wp**(-24)
    !> What is a sliver of an interval of positions; tuned. Read by moving_load/train_search
    real(wp), parameter :: sliver = 2.0_wp**(-16)
    !> The nearest place at which a contact state is looked for, as a share of what is left of the interval: rounding of its
    !> polynomials. Read by moving_load/train_margins, moving_load/train_passage,
    !> moving_load/train_path
    real(wp), parameter :: least_train_share = 2.0_wp**(-42)
    !> Values under trains that are the same differ by no more than this share of the largest on the beam: rounding of products of
    !> influence polynomials. Read by moving_load/train_curves, moving_load/train_extremes
    real(wp), parameter :: train_rounding = 2.0_wp**(-46)
    !> Share by which bounds under trains are off at most where they are to be trusted: train_slack is far more. Read by
    !> moving_load/train_curves, moving_load/train_envelope
    real(wp), parameter :: most_lost = 2.0_wp**(-34)
    !> The longest way without a look, as a share of a link; tuned. Read by moving_load/train_bounds
    real(wp), parameter :: longest_way = 1.0_wp/14
    !> Values below this share of the largest are not looked at closely; tuned. Read by moving_load/train_bounds
    real(wp), parameter :: far_below = 0.5_wp
    !> No polynomial of the degrees of moving_load/train_samples leaves its samples by more than this times what they differ by:
    !> the Lebesgue constant of the sample points is 2.2 at most. Read by moving_load/train_envelope, moving_load/train_samples
    real(wp), parameter :: lebesgue = 2.5_wp
    !> Ties and motions under trains that differ by less, relative to 1 or to themselves, are the same; tuned. Read by
    !> moving_load/train_ties, moving_load/train_traversal
    real(wp), parameter :: same_tie = 1e-9_wp
    !> Bracket of the logarithm of what deflections lengthen a beam by in which a jump is looked for no more closely. Read by
    !> response/stretching
    real(wp), parameter :: narrow_bracket = 1e-10_wp
    !> Difference of two of these in such a bracket that is a jump: nothing smooth is as steep. Read by response/stretching
    real(wp), parameter :: clear_jump = 1e-2_wp

end module gapbeam_path_tolerances
