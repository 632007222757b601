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
    use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
    use gapbeam_kinds, only: wp
    use gapbeam_environment, only: environment_type, hold_environment
    use gapbeam_error, only: error_type, fatal_error, no_memory, gapbeam_solved, gapbeam_bad_input, gapbeam_not_prepared
    use gapbeam_words, only: shown, whole
    use gapbeam_scene, only: gapbeam_unchanged
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_query, only: find_pieces
    use gapbeam_train, only: train_type, uniform_type, new_track
    use gapbeam_train_traversal, only: traversal_type, gapbeam_moves_freely => not_unique
    use gapbeam_train_path, only: pass_train
    use gapbeam_train_events, only: train_event_type, find_events
    use gapbeam_train_ties, only: extreme_type
    use gapbeam_train_envelope, only: envelope_type, find_envelope
    use gapbeam_train_curves, only: find_curves
    use gapbeam_quantities, only: quantity_count, bending, bending_count, needs_axial, needs_ground, quantity_names
    use gapbeam_api_quantities, only: require_quantities
    use gapbeam_api_objects, only: prepared_type, passing_type, train_gap_type, require_beam, require_no_path, require_no_curves, &
        require_size, bad_argument
    implicit none
    private
    public :: moving_train_type, passing_type, train_event_type, train_gap_type, train_extreme_type, gapbeam_moves_freely
    public :: follow_train, get_train_extremes, get_train_curves, get_train_quantity_extremes, get_train_quantity_curves
    public :: copy_extremes

    !> Fields of get_train_extremes and get_train_curves: the first so many of those of bending
    integer, parameter :: field_count = 4

    !> Loads that move together
    type :: moving_train_type
        !> Distances of the axles behind the first one, 0 or more, and their forces, down, both of one size
        real(wp), allocatable :: distance(:), force(:)
        !> Uniform load over the length of the train, down
        real(wp) :: q = 0.0_wp
        !> Does it go to the left; its axles then stand to the right of the first one
        logical :: to_the_left = .false.
        !> Positions, in ascending order; gapbeam_unchanged: from the first axle on the beam, to the last
        real(wp) :: from = gapbeam_unchanged, to = gapbeam_unchanged
    end type moving_train_type

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
        !> Prepared; without foundations and laws whose state depends on the loading history
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
        if (.not. allocated(error)) call require_no_curves(beam, error)
        if (.not. allocated(error)) call require_no_more(beam%lowered, error)
        if (.not. allocated(error)) call check_train(beam%lowered, train, from, to, error)
        if (allocated(error)) return
        call hold_environment(environment)
        call put_axles(train, passing%train, error)
        if (.not. allocated(error)) call new_track(beam%lowered, passing%track, error)
        if (.not. allocated(error)) call pass_train(beam%lowered, passing%track, passing%train, from, to, passing%passage, error)
        if (.not. allocated(error)) call find_events(beam%lowered, passing%passage, train%to_the_left, passing%events, error)
        if (.not. allocated(error)) call find_gaps(passing%passage, train%to_the_left, passing%gaps, error)
        if (.not. allocated(error)) then
            passing%solves = passing%passage%solves
            passing%fingerprint = beam%lowered%fingerprint
        end if
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
        type(envelope_type) :: envelope
        integer :: k

        call require_passing(beam, passing, error)
        if (.not. allocated(error)) call require_bending(quantities, error)
        if (.not. allocated(error)) call require_size(size(quantities), [size(values, 2)], error)
        if (.not. allocated(error)) call envelope_of(beam, passing, envelope, error)
        if (allocated(error)) return
        do k = 1, size(quantities)
            values(:, k) = first_tie(envelope%fields(:, findloc(bending, quantities(k), 1)))
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
        passing%track%beam%watch = beam%lowered%beam%watch
        call find_envelope(beam%lowered, passing%track, passing%train, passing%passage, envelope, error)
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
        real(wp), allocatable :: distance(:), found(:, :, :, :), found_at(:, :, :, :)
        integer :: i, k, side, stat

        call require_passing(beam, passing, error)
        if (.not. allocated(error)) call require_bending(quantities, error)
        if (.not. allocated(error)) call require_size(size(quantities), [size(value, 2), size(position, 2)], error)
        if (.not. allocated(error)) call require_size(size(x), [size(value, 3), size(position, 3)], error)
        if (allocated(error)) return
        allocate (found(2, bending_count, size(x), 2), found_at(2, bending_count, size(x), 2), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        call hold_environment(environment)
        passing%track%beam%watch = beam%lowered%beam%watch
        do side = 1, 2
            if (.not. allocated(error)) call find_pieces(beam%lowered, x, side == 2, piece, distance, error)
            if (.not. allocated(error)) call find_curves(beam%lowered, passing%track, passing%train, passing%passage, piece, &
                                                         distance, found(:, :, :, side), found_at(:, :, :, side), error)
        end do
        if (allocated(error)) return
        do k = 1, size(quantities)
            associate (j => findloc(bending, quantities(k), 1))
                do i = 1, 2
                    value(i, k, :) = found(i, j, :, 1)
                    position(i, k, :) = found_at(i, j, :, 1)
                    where (merge(1.0_wp, -1.0_wp, i == 1)*(found(i, j, :, 2) - found(i, j, :, 1)) > 0.0_wp)
                        value(i, k, :) = found(i, j, :, 2)
                        position(i, k, :) = found_at(i, j, :, 2)
                    end where
                end do
            end associate
        end do
    end subroutine get_train_quantity_curves

    !> Refuse quantities that are not of bending, which trains do not have
    subroutine require_bending(quantities, error)
        integer, intent(in) :: quantities(:)
        type(error_type), allocatable, intent(out) :: error
        integer :: k

        call require_quantities(quantities, quantity_count, error)
        do k = 1, size(quantities)
            if (allocated(error)) return
            if (.not. any(quantities(k) == [needs_axial, needs_ground])) cycle
            call bad_argument(error, "quantities", "quantities("//trim(whole(k))//"): a train has no "// &
                              trim(quantity_names(quantities(k))))
            error%entry = k
        end do
    end subroutine require_bending

    !> Refuse beams over which no train is followed
    subroutine require_no_more(lowered, error)
        type(assembled_type), intent(in) :: lowered
        type(error_type), allocatable, intent(out) :: error

        if (allocated(lowered%layers)) then
            call fatal_error(error, gapbeam_bad_input, "trains on a foundation are followed in Python only: "// &
                             "give positions as loads, or springs as supports")
        end if
    end subroutine require_no_more

    !> Refuse a train that makes no sense, and find its positions
    subroutine check_train(lowered, train, from, to, error)
        type(assembled_type), intent(in) :: lowered
        type(moving_train_type), intent(in) :: train
        real(wp), intent(out) :: from, to
        type(error_type), allocatable, intent(out) :: error
        character(len=4), parameter :: names(3) = ["q   ", "from", "to  "]
        real(wp) :: end, longest
        logical :: finite(3)
        integer :: i

        from = 0.0_wp
        to = 0.0_wp
        if (.not. (allocated(train%distance) .and. allocated(train%force))) then
            call fatal_error(error, gapbeam_bad_input, "train: distance or force is not allocated")
            return
        end if
        if (size(train%distance) /= size(train%force) .or. size(train%force) == 0) then
            call fatal_error(error, gapbeam_bad_input, "train: expected as many forces as distances, 1 or more, got "// &
                             trim(whole(size(train%force)))//" and "//trim(whole(size(train%distance))))
            return
        end if
        do i = 1, size(train%distance)
            if (.not. (ieee_is_finite(train%distance(i)) .and. train%distance(i) >= 0.0_wp)) then
                call bad_argument(error, "distance", "distance("//trim(whole(i))//"): expected a distance behind "// &
                                 "the first axle, 0 or more, got "//trim(shown(train%distance(i))))
            else if (.not. ieee_is_finite(train%force(i))) then
                call bad_argument(error, "force", "force("//trim(whole(i))//"): expected a finite number, got "// &
                                 trim(shown(train%force(i))))
            end if
            if (allocated(error)) return
        end do
        finite = ieee_is_finite([train%q, train%from, train%to])
        if (.not. all(finite)) then
            call bad_argument(error, names(findloc(finite, .false., 1)), "train: q, from and to must be finite")
            return
        end if
        end = point_x(lowered, size(lowered%pieces))
        longest = maxval(train%distance)
        from = train%from
        to = train%to
        if (.not. from > gapbeam_unchanged) from = merge(-longest, 0.0_wp, train%to_the_left)
        if (.not. to > gapbeam_unchanged) to = merge(end, end + longest, train%to_the_left)
        if (from <= to) return
        call bad_argument(error, "to", "the positions from "//trim(shown(from))//" to "//trim(shown(to))// &
                         " are none: from must be at most to")
    end subroutine check_train

    !> Axles as distances from the position, to the right
    subroutine put_axles(given, train, error)
        type(moving_train_type), intent(in) :: given
        type(train_type), intent(out) :: train
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: longest
        integer :: stat

        associate (n => size(given%force))
            allocate (train%offset(n), train%force(n), train%uniform(merge(1, 0, abs(given%q) > 0.0_wp)), stat=stat)
        end associate
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        longest = maxval(given%distance)
        train%offset(:) = merge(given%distance, -given%distance, given%to_the_left)
        train%force(:) = given%force
        train%uniform(:) = uniform_type(given%q, merge(0.0_wp, -longest, given%to_the_left), &
                                        merge(longest, 0.0_wp, given%to_the_left))
    end subroutine put_axles

    !> Stretches that are not solved, joined where they are alike
    subroutine find_gaps(passage, backwards, gaps, error)
        type(traversal_type), intent(in) :: passage
        logical, intent(in) :: backwards
        type(train_gap_type), allocatable, intent(out) :: gaps(:)
        type(error_type), allocatable, intent(out) :: error
        type(train_gap_type) :: found(passage%number)
        integer :: k, last, number, stat

        number = 0
        last = 0
        do k = 1, passage%number
            if (passage%status(k) == gapbeam_solved) cycle
            if (last == k - 1 .and. number > 0) then
                if (passage%status(k) == passage%status(last) .and. passage%motion_of(k) == passage%motion_of(last)) then
                    found(number)%to = passage%to(k)
                    last = k
                    cycle
                end if
            end if
            number = number + 1
            found(number) = train_gap_type(passage%from(k), passage%to(k), passage%status(k))
            last = k
        end do
        allocate (gaps(number), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        gaps(:) = found(:number)
        if (backwards) gaps(:) = found(number:1:-1)
    end subroutine find_gaps

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
