!> Thresholds that more than one file reads, each told once: what it bounds, why this value, who reads it.
!> Thresholds of one file stand at its head. Compiled in double and in quadruple precision.
module gapbeam_tolerances
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: sign_width, worst_digits, worst_correction, rounding_unit, extreme_margin, proximal_ratio, splitter
    public :: position_tolerance, end_tolerance, cubic_rounding, load_begin, train_slack, train_equal, most_unit_power

    !> Rounding errors beyond which a sign counts. The estimates of rounding are sums of first order; 32 of them have never been
    !> exceeded by the attacks, and what lies within goes to quadruple precision, so that more would only cost time.
    !> Read by contact/rules (one case) and by lanes/ (cases side by side), which have to decide alike.
    real(wp), parameter :: sign_width = 32.0_wp
    !> Rounding error of a reaction, relative to the largest, from which on quadruple precision is worth its time: half of the
    !> digits of a double. Read by precision/extended_precision and lanes/
    real(wp), parameter :: worst_digits = 1e-8_wp
    !> Correction of deflections, relative to the largest, that refining them once may leave too much of: it leaves about the
    !> square, 1e-12. Read by precision/extended_precision and lanes/
    real(wp), parameter :: worst_correction = 1e-6_wp
    !> Roundings of a row of the system, or of a term of a field's polynomial, at most: four operations each.
    !> Read by precision/certificate and cases/lane_row_errors
    real(wp), parameter :: rounding_unit = 4*epsilon(1.0_wp)
    !> Share of a field by which a bound of it is widened before a piece is left out of the search for extremes: far more than
    !> rounding, and too little to cost pieces. Read by beam/fields and cases/lane_roots
    real(wp), parameter :: extreme_margin = 1.0e-6_wp
    !> Weak springs of the proximal iteration relative to the softest stiffness present: a third of the digits, so that two rounds
    !> leave nothing but rounding. Read by contact/contact_state and contact/ground_energy, and by cases/lane_spans for cases side
    !> by side
    real(wp), parameter :: proximal_ratio = 10.0_wp**(-precision(1.0_wp)/3)
    !> Splits a number into two halves of its bits (Dekker 1971, Numer. Math. 18, 224). Read by all that form exact products:
    !> elimination/residual, elimination/elements, cases/lane_residual
    real(wp), parameter :: splitter = 2.0_wp**((digits(1.0_wp) + 1)/2) + 1

    !> Positions whose difference is at most this share of the larger one are the same place: sums of some sixty spans may be so
    !> far off. Read by scene/ and, through the engine, by gapbeam.scene.places
    real(wp), parameter :: position_tolerance = 64*epsilon(1.0_wp)
    !> A place beyond an end of the beam by at most this share of its length is at that end: so much can a sum of spans be off
    !> Read by scene/ and, through the engine, by gapbeam.scene.trains
    real(wp), parameter :: end_tolerance = 1.0e-12_wp
    !> By this share k2 of a cubic law may be less than what is allowed: decimals are rounded. Read by scene/check_ground_laws and,
    !> through the engine, by gapbeam.scene.laws
    real(wp), parameter :: cubic_rounding = 2.0_wp**(-50)

    !> What acts at this share of the way acts from the beginning: at factor 0 a beam without dead load lies on the ground without
    !> any force; tuned. Read by continuation/ground_path and, through the engine, by gapbeam.plots
    real(wp), parameter :: load_begin = 2.0_wp**(-40)

    !> Values under trains that differ by less than this share of the largest may be the same, for they are not refined: half of
    !> the digits. Read by moving_load/train_bounds, train_support_bounds, train_envelope and train_curves
    real(wp), parameter :: train_slack = 2.0_wp**(-26)
    !> Values under trains nearer to the largest than this share of the largest absolute value are equal to it; tuned: rounding
    !> of the influence polynomials stays below 2**-44. Read by moving_load/train_candidates and what stands on it
    real(wp), parameter :: train_equal = 2.0_wp**(-40)

    !> Powers of two of the units of a case up to which its numbers stay doubles: their range is 2**1023.
    !> Read by cases/lane_cases, segment_cases and case_extremes
    integer, parameter :: most_unit_power = 1000

end module gapbeam_tolerances
