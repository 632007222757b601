!> Trains, for Fortran: loads that move together over a beam, followed from event to event in their position; as gapbeam_api in all
!> else.
!>
!>     type(moving_train_type) :: train
!>     type(passing_type) :: passing
!>
!>     train = moving_train_type(distance=[0d0, 3.6d0], force=[185d0, 185d0])
!>     call follow_train(beam, train, passing, error)                     ! passing%events, passing%gaps
!>     call get_train_extremes(beam, passing, fields, supports, error)    ! largest and smallest values, exact in place and position
!>
!> The position of a train is that of its first axle. All loads of the beam stay, dead and live ones in full
module gapbeam_api_trains
    use gapbeam_kinds, only: wp
    use gapbeam_assembled_model, only: is_alone
    use gapbeam_piece, only: is_tapered
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_words, only: whole
    use gapbeam_query, only: find_pieces
    use gapbeam_train, only: new_track
    use gapbeam_train_traversal, only: gapbeam_moves_freely => not_unique
    use gapbeam_train_path, only: pass_train
    use gapbeam_train_events, only: train_event_type, find_events
    use gapbeam_train_ties, only: extreme_type
    use gapbeam_train_envelope, only: envelope_type, find_envelope
    use gapbeam_train_curves, only: find_curves
    use gapbeam_train_runs, only: follow_train_on_ground
    use gapbeam_train_run_extremes, only: fields_of_runs, supports_of_runs
    use gapbeam_train_lines, only: find_lines
    use gapbeam_smooth_laws, only: smooth_supports
    use gapbeam_search, only: rule_block
    use gapbeam_quantities, only: quantity_count, bending, bending_count, of_shear, of_transverse, needs_axial, needs_ground, &
        quantity_names
    use gapbeam_api_quantities, only: require_quantities
    use gapbeam_api_train_loads, only: moving_train_type, train_gap_type, check_train, put_axles, find_gaps, lost_in
    use gapbeam_api_objects, only: prepared_type, passing_type, require_beam, require_no_path, require_no_ground_along, &
        require_size, bad_argument
    implicit none
    private
    public :: moving_train_type, passing_type, train_event_type, train_gap_type, train_extreme_type, gapbeam_moves_freely
    public :: follow_train, get_train_extremes, get_train_curves, get_train_quantity_extremes, get_train_quantity_curves
    public :: copy_extremes

    !> Fields of get_train_extremes and get_train_curves: the first so many of those of bending
    integer, parameter :: field_count = 4

    !> A largest or smallest value, and where it is; of a support x is 0
    type :: train_extreme_type
        !> Is there one: some position is solved
        logical :: known = .false.
        real(wp) :: value = 0.0_wp, x = 0.0_wp, position = 0.0_wp
        !> -1 left of x, 1 right of it, where a field jumps; 0 on both sides
        integer :: side = 0
        !> How many places and positions have this value; of 16 and more 16
        integer :: ties = 0
    end type train_extreme_type

contains

    !> Move a train over a beam: every change of the contact state at its exact position
    subroutine follow_train(beam, train, passing, error)
        !> Prepared; without laws whose state depends on the loading history
        type(prepared_type), intent(in) :: beam
        type(moving_train_type), intent(in) :: train
        type(passing_type), intent(out) :: passing
        !> gapbeam_bad_input, gapbeam_not_prepared; gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite or
        !> gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        real(wp) :: from, to

        call require_beam(beam, error)
        if (.not. allocated(error)) call require_no_path(beam, error)
        if (.not. allocated(error)) call require_no_ground_along(beam, error)
        if (.not. allocated(error)) then
            if (.not. allocated(beam%lowered%layers) .and. (any(is_tapered(beam%lowered%pieces)) &
                                                            .or. any(beam%lowered%joint > 0.0_wp) &
                                                            .or. allocated(beam%lowered%beam%turning) &
                                                            .or. any(is_alone(beam%lowered%model%loads)))) then
                call bad_argument(error, "beam", "a section that tapers, a hinge with a stiffness, a restraint or hinge with a "// &
                    "law, a slack or a side, a support that is turned, a couple at a hinge or a curvature that changes along "// &
                    "the beam under a train asks for with_trains of the model")
            end if
        end if
        if (.not. allocated(error)) call check_train(beam%lowered, train, from, to, error)
        if (allocated(error)) return
        call hold_environment(environment)
        call put_axles(train, passing%train, error)
        if (allocated(error)) then
            continue
        else if (allocated(beam%lowered%layers) .or. size(smooth_supports(beam%lowered)) > 0) then
            allocate (passing%runs)
            call follow_train_on_ground(beam%lowered, passing%train, rule_block, from, to, train%to_the_left, passing%runs, error)
            if (.not. allocated(error)) then
                passing%events = passing%runs%events
                passing%gaps = lost_in(passing%runs)
                passing%solves = passing%runs%solves
            else if (error%code == gapbeam_bad_input) then
                error%message = "the train "//error%message
            end if
        else
            call new_track(beam%lowered, passing%track, error)
            if (.not. allocated(error)) call pass_train(beam%lowered, passing%track, passing%train, from, to, passing%passage, &
                                                        error)
            if (.not. allocated(error)) call find_events(beam%lowered, passing%passage, train%to_the_left, passing%events, error)
            if (.not. allocated(error)) call find_gaps(passing%passage, train%to_the_left, passing%gaps, error)
            passing%solves = passing%passage%solves
        end if
        if (.not. allocated(error)) passing%fingerprint = beam%lowered%fingerprint
    end subroutine follow_train

    !> Largest and smallest values over all positions, exact in place and position
    subroutine get_train_extremes(beam, passing, fields, supports, error)
        !> The beam that it passes
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(inout) :: passing
        !> Largest (1) and smallest (2) deflection, rotation, moment, shear
        type(train_extreme_type), intent(out) :: fields(2, field_count)
        !> The same of reaction, opening, deflection, couple of every support, shape (2, 4, count_supports(beam))
        type(train_extreme_type), intent(out) :: supports(:, :, :)
        !> gapbeam_not_prepared, gapbeam_bad_input for an array of another size, gapbeam_no_memory
        type(error_type), allocatable, intent(out) :: error
        type(envelope_type) :: envelope

        call require_passing(beam, passing, error)
        if (.not. allocated(error)) call require_size(size(beam%lowered%model%supports), [size(supports, 3)], error)
        if (.not. allocated(error)) call envelope_of(beam, passing, envelope, error)
        if (allocated(error)) return
        fields(:, :) = first_tie(envelope%fields(:, :field_count))
        supports(:, :, :) = first_tie(envelope%supports)
    end subroutine get_train_extremes

    !> The same of quantities by their numbers (gapbeam_api_quantities)
    subroutine get_train_quantity_extremes(beam, passing, quantities, values, error)
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(inout) :: passing
        !> Those of bending, shape (m)
        integer, intent(in) :: quantities(:)
        !> Largest (1) and smallest (2), shape (2, m)
        type(train_extreme_type), intent(out) :: values(:, :)
        !> As for get_train_extremes; gapbeam_bad_input also for other quantities
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        type(envelope_type) :: envelope
        type(extreme_type), allocatable :: found(:, :)
        integer :: k

        call require_passing(beam, passing, error)
        if (.not. allocated(error)) call require_fields(beam, quantities, error)
        call require_size(size(quantities), [size(values, 2)], error)
        if (allocated(error)) return
        if (allocated(passing%runs)) then
            allocate (found(2, size(quantities)))
            call hold_environment(environment)
            call fields_of_runs(beam%lowered, passing%runs, quantities, found, error)
            if (.not. allocated(error)) values(:, :) = first_tie(found)
            return
        end if
        call envelope_of(beam, passing, envelope, error)
        if (allocated(error)) return
        do k = 1, size(quantities)
            values(:, k) = first_tie(envelope%fields(:, place_of(quantities(k))))
        end do
    end subroutine get_train_quantity_extremes

    !> Extremes as numbers, for the other interfaces
    pure subroutine copy_extremes(extremes, numbers)
        type(train_extreme_type), intent(in) :: extremes(:, :)
        !> Value, x, position, side, shape (4, 2, m)
        real(wp), intent(inout) :: numbers(:, :, :)

        numbers(1, :, :) = extremes%value
        numbers(2, :, :) = extremes%x
        numbers(3, :, :) = extremes%position
        numbers(4, :, :) = extremes%side
    end subroutine copy_extremes

    !> Everything that is largest or smallest
    subroutine envelope_of(beam, passing, envelope, error)
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(inout) :: passing
        type(envelope_type), intent(out) :: envelope
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment

        call hold_environment(environment)
        if (allocated(passing%runs)) then
            allocate (envelope%supports(2, 4, size(beam%lowered%model%supports)))
            call fields_of_runs(beam%lowered, passing%runs, bending, envelope%fields, error)
            if (.not. allocated(error)) call supports_of_runs(beam%lowered, passing%runs, envelope%supports, error)
        else
            passing%track%beam%watch = beam%lowered%beam%watch
            call find_envelope(beam%lowered, passing%track, passing%passage, envelope, error)
        end if
    end subroutine envelope_of

    !> Largest and smallest fields at places of the beam over all positions; where a field jumps, of both sides
    subroutine get_train_curves(beam, passing, x, value, position, error)
        !> The beam that it passes
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(inout) :: passing
        !> Places, shape (n)
        real(wp), intent(in) :: x(:)
        !> Largest (1) and smallest (2) deflection, rotation, moment, shear, and the positions of the train, shape (2, 4, n);
        !> where no position is solved -huge and huge
        real(wp), intent(out) :: value(:, :, :), position(:, :, :)
        !> As for get_train_extremes; gapbeam_bad_input also for a place off the beam
        type(error_type), allocatable, intent(out) :: error

        call get_train_quantity_curves(beam, passing, bending(:field_count), x, value, position, error)
    end subroutine get_train_curves

    !> The same of quantities by their numbers (gapbeam_api_quantities)
    subroutine get_train_quantity_curves(beam, passing, quantities, x, value, position, error)
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(inout) :: passing
        !> Those of bending, shape (m)
        integer, intent(in) :: quantities(:)
        real(wp), intent(in) :: x(:)
        !> As for get_train_curves, shape (2, m, n)
        real(wp), intent(out) :: value(:, :, :), position(:, :, :)
        !> As for get_train_curves; gapbeam_bad_input also for other quantities
        type(error_type), allocatable, intent(out) :: error
        type(environment_type) :: environment
        integer, allocatable :: piece(:)
        !> Right of the places, and left of them
        real(wp), allocatable, target :: found(:, :, :, :), found_at(:, :, :, :)
        real(wp), pointer :: of_all(:, :, :), at_all(:, :, :)
        real(wp), allocatable :: distance(:), curves(:, :, :), curves_at(:, :, :)
        integer :: i, k, m, n, side, stat

        call require_passing(beam, passing, error)
        if (.not. allocated(error)) call require_fields(beam, quantities, error)
        call require_size(size(quantities), [size(value, 2), size(position, 2)], error)
        call require_size(size(x), [size(value, 3), size(position, 3)], error)
        if (allocated(error)) return
        m = size(quantities)
        n = size(x)
        allocate (found(2, m, n, 2), found_at(2, m, n, 2), curves(2, bending_count, n), curves_at(2, bending_count, n), stat=stat)
        if (failed(stat, error)) return
        call hold_environment(environment)
        if (allocated(passing%runs)) then
            ! On the ground, or with smooth laws
            call find_pieces(beam%lowered, x, .false., piece, distance, error)
            of_all(1:2, 1:m, 1:2*n) => found
            at_all(1:2, 1:m, 1:2*n) => found_at
            if (.not. allocated(error)) call find_lines(beam%lowered, passing%runs, quantities, [x, x], [(k > n, k=1, 2*n)], &
                                                        of_all, at_all, error)
        else
            passing%track%beam%watch = beam%lowered%beam%watch
            do side = 1, 2
                call find_pieces(beam%lowered, x, side == 2, piece, distance, error)
                if (.not. allocated(error)) call find_curves(beam%lowered, passing%track, passing%passage, piece, &
                                                             distance, curves, curves_at, error)
                if (allocated(error)) return
                found(:, :, :, side) = curves(:, place_of(quantities), :)
                found_at(:, :, :, side) = curves_at(:, place_of(quantities), :)
            end do
        end if
        if (allocated(error)) return
        value(:, :, :) = found(:, :, :, 1)
        position(:, :, :) = found_at(:, :, :, 1)
        do i = 1, 2
            where (merge(1.0_wp, -1.0_wp, i == 1)*(found(i, :, :, 2) - found(i, :, :, 1)) > 0.0_wp)
                value(i, :, :) = found(i, :, :, 2)
                position(i, :, :) = found_at(i, :, :, 2)
            end where
        end do
    end subroutine get_train_quantity_curves

    !> Refuse quantities that trains do not have: those along the axis, and of the ground where there is none
    subroutine require_fields(beam, quantities, error)
        type(prepared_type), intent(in) :: beam
        integer, intent(in) :: quantities(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        call require_quantities(quantities, quantity_count, error)
        do k = 1, size(quantities)
            if (allocated(error)) return
            if (.not. any(quantities(k) == [needs_axial, needs_ground])) cycle
            if (allocated(beam%lowered%layers) .and. any(quantities(k) == needs_ground)) cycle
            call bad_argument(error, "quantities", "quantities("//trim(whole(k))//"): a train has no "// &
                              trim(quantity_names(quantities(k))))
            error%entry = k
        end do
    end subroutine require_fields

    !> Place of a quantity among those of bending; without an axial force that bending feels the transverse force is the shear
    elemental function place_of(quantity) result(place)
        integer, intent(in) :: quantity
        integer :: place

        place = findloc(bending, merge(of_shear, quantity, quantity == of_transverse), 1)
    end function place_of

    !> The first one of those that tie
    elemental function first_tie(extreme) result(found)
        type(extreme_type), intent(in) :: extreme
        type(train_extreme_type) :: found
        integer, parameter :: sides(0:2) = [0, -1, 1]

        if (extreme%number == 0) return
        associate (tie => extreme%ties(1))
            found = train_extreme_type(.true., tie%value, tie%x, tie%position, sides(tie%side), extreme%number)
        end associate
    end function first_tie

    !> Refuse what did not pass this beam
    subroutine require_passing(beam, passing, error)
        type(prepared_type), intent(in) :: beam
        type(passing_type), intent(in) :: passing
        type(error_type), allocatable, intent(out) :: error

        call require_beam(beam, error)
        if (allocated(error)) return
        if (.not. allocated(passing%events)) then
            call fatal_error(error, gapbeam_not_prepared, "no train has passed: call follow_train first")
        else if (passing%fingerprint /= beam%lowered%fingerprint) then
            call fatal_error(error, gapbeam_not_prepared, "the train has passed another beam, or one with other loads")
        end if
    end subroutine require_passing

end module gapbeam_api_trains
