!> The engine's modules under one name. A caller does three things:
!>
!>     call condense_link(pieces, dead, live, work, link)                           ! once for every span
!>     call find_scheme(beam, factor, rule, closed, work, outcome, error)           ! at every load factor
!>     call recover_beam(pieces, dead, live, factor, links, last, kind, w, ml, mr, v, starts) ! for fields
!>
!> Units: any consistent set. Signs: x to the right, deflection and loads down, reactions up, moments sagging,
!> couples and rotations clockwise. No procedure prints, stops, or keeps data between calls.
module gapbeam
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_indeterminate, &
        gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_type, load_type, link_type, condense_link
    use gapbeam_band, only: plain, hinge, restrained
    use gapbeam_model, only: beam_type, support_type, new_beam, place_supports, below, above, both
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads
    use gapbeam_system, only: check_scheme
    use gapbeam_search, only: rule_block, rule_single
    use gapbeam_scheme, only: find_scheme, outcome_type
    use gapbeam_path, only: follow_load, path_type, find_marginal
    use gapbeam_fields, only: recover_beam, values_at, find_extremes
    use gapbeam_axial, only: solve_axial
    implicit none
    public
end module gapbeam
