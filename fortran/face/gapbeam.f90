!> Beams on supports that act one way only: the library's Fortran interface.
!>
!>     use gapbeam
!>     type(model_type) :: model
!>     type(prepared_type) :: beam
!>     type(result_type) :: result
!>     type(error_type), allocatable :: error
!>
!>     model%spans = [span_type(6d0, EI=1d4), span_type(6d0, EI=1d4)]            ! what there is
!>     model%supports = [support_type(node=0), support_type(node=1, side=gapbeam_below), support_type(node=2)]
!>     model%loads = [uniform_load(5d0, from=0d0, to=6d0)]
!>     call prepare_model(model, beam, error)                                    ! once
!>     call solve_beam(beam, 1d0, options_type(), result, error)                 ! at every load factor
!>     call get_fields(beam, result, [3d0], fields, error)                       ! and what it says
!>     call get_quantities(beam, result, [gapbeam_of_curvature], [3d0], values, error)
!>
!> A support may follow a law instead of a stiffness: a polyline of its force over the displacement, which may harden, yield,
!> soften and break. Where a force falls, or a support keeps a set, the state depends on the loading history to it:
!>
!>     model%law = [law_point_type(2, 0.02d0, 40d0), law_point_type(2, 0.05d0, 10d0), law_point_type(2, 1d0, 10d0)]
!>     call follow_history(beam, [1d0], gapbeam_limit_stop, history, error)      ! every event, and the limit of the load
!>     call solve_on_path(beam, history, 0.5d0, result, error)                   ! the state at a factor on it
!>
!> The ground under a stretch of the beam may push it up only, so that the beam lifts off where it likes:
!>
!>     model%foundations = [foundation_type(from=2d0, k=5d3, side=gapbeam_below)]
!>     call get_contact(beam, result, zones, error)                              ! where the ground acts, and its force
!>     call get_pressure(beam, result, [3d0], pressure, error)
!>
!> Bending may feel an axial force, tension positive; under compression a beam may buckle:
!>
!>     model%spans(1)%N = -50d0
!>     if (result%status == gapbeam_buckles) call get_buckling(beam, result, share, x, deflection, error)
!>     call get_modes(beam, result, gapbeam_buckling, factors, found, error)     ! factors of N at which a solved beam buckles
!>
!> Combinations of load cases are beams of their own, each with a contact state of its own:
!>
!>     call combine_loads(beam, [1.35d0, 1.5d0], combined, error)                ! a factor for every load
!>     call solve_beam(combined, 1d0, options_type(), result, error)
!>
!> Many cases go through one call, eight side by side with the widest registers that the processor has:
!>
!>     call prepare_cases(beam, cases, error)                                    ! once
!>     call solve_cases(beam, cases, factors, status, error, gap=gaps, reaction=reactions)   ! a column each for every case
!>
!> Units: any consistent set. Signs: x to the right, deflections, settlements and loads down, reactions up, moments sagging,
!> couples and rotations clockwise, axial forces on the beam to the right. Supports, foundations and loads count from 1,
!> nodes from 0.
!> Errors: `error` is allocated where something failed, with one of the codes of gapbeam_error and a message. That a beam has
!> no equilibrium, or buckles, is no error: result%status says it.
module gapbeam
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium, gapbeam_buckles, gapbeam_bad_input, &
        gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite, gapbeam_no_memory, gapbeam_not_prepared, &
        gapbeam_other_version, gapbeam_stopped, gapbeam_status_message => status_text
    use gapbeam_version, only: gapbeam_version_major, gapbeam_version_minor, gapbeam_version_patch, gapbeam_version_string
    use gapbeam_search, only: gapbeam_rule_block => rule_block, gapbeam_rule_single => rule_single
    use gapbeam_scene, only: span_type, section_type, support_type, law_point_type, load_type, model_type, foundation_type, &
        ground_point_type, ground_law_point_type, point_force, point_couple, uniform_load, linear_load, imposed_curvature, &
        linear_curvature, axial_force, axial_uniform_load, support_movement, temperature_load, support_rotation, ground_movement, &
        gapbeam_infinity, gapbeam_by_x, gapbeam_unchanged, gapbeam_right_end, gapbeam_both, gapbeam_below, gapbeam_above, &
        gapbeam_left, gapbeam_right, gapbeam_normal, gapbeam_axial, gapbeam_rotational, gapbeam_relative, gapbeam_rotational_left, &
        gapbeam_rotational_right, gapbeam_counterclockwise, gapbeam_clockwise, gapbeam_force, gapbeam_couple, gapbeam_distributed, &
        gapbeam_curvature, gapbeam_axial_force, gapbeam_movement, gapbeam_temperature, gapbeam_support_rotation, &
        gapbeam_couple_left, gapbeam_couple_right, gapbeam_axial_distributed, gapbeam_ground_movement, gapbeam_linear_curvature, &
        gapbeam_live, gapbeam_dead, gapbeam_elastic, gapbeam_plastic, gapbeam_broken, gapbeam_law_by_points, gapbeam_law_plastic, &
        gapbeam_law_hardening, gapbeam_law_hyperbolic, gapbeam_law_tanh, gapbeam_law_cubic, gapbeam_law_power, &
        gapbeam_law_brittle, gapbeam_table_of_k, gapbeam_table_of_gap, gapbeam_table_of_parameter
    use gapbeam_events, only: event_type
    use gapbeam_pieces, only: gapbeam_open, gapbeam_closed, gapbeam_bilateral, gapbeam_touching, gapbeam_branch, &
        gapbeam_opens, gapbeam_closes, gapbeam_turns, gapbeam_yields, gapbeam_hardens, gapbeam_softens, gapbeam_breaks, &
        gapbeam_unloads, gapbeam_slips, gapbeam_sticks, gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits, &
        gapbeam_reaches, gapbeam_leaves
    use gapbeam_api, only: prepared_type, options_type, result_type, certificate_type, &
        prepare_model, replace_loads, count_supports, count_nodes, &
        solve_beam, follow_load, get_supports, get_friction, get_fields, get_extremes, get_motion, get_certificate
    use gapbeam_api_quantities, only: get_quantities, get_quantity_extremes, gapbeam_of_deflection, gapbeam_of_rotation, &
        gapbeam_of_moment, gapbeam_of_shear, gapbeam_of_axial_force, gapbeam_of_axial_displacement, gapbeam_of_pressure, &
        gapbeam_of_curvature, gapbeam_of_transverse
    use gapbeam_api_modes, only: gapbeam_buckling, gapbeam_vibration, get_modes, get_mode_shape, get_mode_amplitude, get_buckling
    use gapbeam_api_history, only: history_type, stretch_type, limit_type, follow_history, solve_on_path, &
        get_released_energy, gapbeam_limit_stop, gapbeam_limit_jump, gapbeam_limit_follow, &
        gapbeam_arrived, gapbeam_limit_point, gapbeam_bifurcation, gapbeam_mechanism, gapbeam_path_ended
    use gapbeam_api_cases, only: cases_type, prepare_cases, solve_cases, get_nodes
    use gapbeam_api_combinations, only: combine_loads
    use gapbeam_api_watch, only: watch_type, watch_beam, stop_calls
    use gapbeam_api_trains, only: moving_train_type, passing_type, train_event_type, train_gap_type, train_extreme_type, &
        follow_train, get_train_extremes, get_train_curves, get_train_quantity_extremes, get_train_quantity_curves, &
        gapbeam_moves_freely
    use gapbeam_api_ground, only: contact_type, free_span_type, ground_event_type, follow_ground, get_contact, get_free_spans, &
        get_pressure, get_pressure_extremes
    implicit none
    public
end module gapbeam
