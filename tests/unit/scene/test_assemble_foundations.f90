!> From the words of foundations to layers of ground under the pieces of the beam
program test_assemble_foundations
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_status_type, ieee_get_status, &
        ieee_set_status, ieee_set_halting_mode, ieee_all
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, gapbeam_bad_input, gapbeam_not_finite
    use gapbeam_scene, only: model_type, span_type, support_type, foundation_type, ground_point_type, ground_law_point_type, &
        point_force, gapbeam_infinity, gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_law_plastic, gapbeam_law_tanh, &
        gapbeam_law_cubic, gapbeam_table_of_k, gapbeam_table_of_gap, gapbeam_table_of_parameter
    use gapbeam_layers, only: layer_type
    use gapbeam_input_error, only: of_foundations, not_expected, off_beam, no_stretch, bad_law
    use gapbeam_fingerprint, only: fingerprint
    use gapbeam_assembled_model, only: assembled_type, copy_model, point_x
    use gapbeam_assemble, only: assemble_model
    use gapbeam_assemble_loads, only: assemble_loads
    implicit none
    integer :: status

    call a_model_without_foundations_has_no_layers()
    call two_foundations_under_a_beam()
    call a_law_both_ways_is_two_layers()
    call a_profile_is_followed()
    call tables_are_followed()
    call a_law_that_varies()
    call a_long_profile()
    call layers_in_units_of_their_own()
    call everything_is_refused_with_a_reason()
    call fingerprints_differ()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Two spans of 6
    function simple() result(model)
        type(model_type) :: model

        allocate (model%spans(2))
        model%spans(:) = span_type(6.0_wp, EI=12.0_wp)
        model%loads = [point_force(1.0_wp, x=3.0_wp)]
    end function simple

    !> Lower a model with all traps off, as gapbeam_api does
    subroutine lower(model, lowered, error)
        type(model_type), intent(in) :: model
        type(assembled_type), intent(out) :: lowered
        type(error_type), allocatable, intent(out) :: error
        type(ieee_status_type) :: environment
        integer :: stat

        call ieee_get_status(environment)
        call ieee_set_halting_mode(ieee_all, .false.)
        call copy_model(model, lowered%model, stat)
        call assemble_model(lowered, error)
        call ieee_set_status(environment)
    end subroutine lower

    !> Places of all points
    function places(lowered) result(x)
        type(assembled_type), intent(in) :: lowered
        real(wp), allocatable :: x(:)
        integer :: i

        allocate (x(0:size(lowered%pieces)))
        do i = 0, size(lowered%pieces)
            x(i) = point_x(lowered, i)
        end do
    end function places

    !> And its nodes are few
    subroutine a_model_without_foundations_has_no_layers()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%supports = [support_type(node=0), support_type(node=2)]
        call lower(model, lowered, error)
        call check(.not. allocated(error) .and. .not. allocated(lowered%layers) .and. .not. allocated(lowered%layer_first), &
                   "no layers without foundations")
        call check(size(lowered%beam%links) == 1 .and. size(lowered%pieces) == 3, "and pieces between nodes are condensed")
    end subroutine a_model_without_foundations_has_no_layers

    !> One with pairs over the middle of the beam, one over all of it
    subroutine two_foundations_under_a_beam()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%foundations = [foundation_type(from=2.0_wp, to=10.0_wp, k=0.0_wp, k_to=800.0_wp, side=gapbeam_below, &
                                             gap=0.0_wp, gap_to=0.4_wp), &
                             foundation_type(k=50.0_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error), "two foundations")
        call check_close(places(lowered), [0.0_wp, 2.0_wp, 3.0_wp, 6.0_wp, 10.0_wp, 12.0_wp], "their ends are points")
        call check(size(lowered%beam%links) == 5 .and. all(lowered%node_point == [0, 1, 2, 3, 4, 5]), "every piece is a link")
        call check(all(lowered%layer_first == [1, 2, 4, 6, 8, 9]) .and. size(lowered%layers) == 8, "one or two layers under them")
        call check(all(lowered%layers%foundation == [2, 1, 2, 1, 2, 1, 2, 2]), "in the order of the foundations")
        call check(all(lowered%layers%side == [0, 1, 0, 1, 0, 1, 0, 0]), "each with its side")
        associate (one => lowered%layers([2, 4, 6]), other => lowered%layers([1, 3, 5, 7, 8]))
            call check_close(one%modulus_a, [0.0_wp, 100.0_wp, 400.0_wp], "soil that grows stiffer: at the left ends")
            call check_close(one%modulus_b, [100.0_wp, 400.0_wp, 800.0_wp], "at the right ends")
            call check_close(one%contact_a, [0.0_wp, 0.05_wp, 0.2_wp], "a gap that opens: at the left ends")
            call check_close(one%contact_b, [0.05_wp, 0.2_wp, 0.4_wp], "at the right ends")
            call check(all(abs(one(2:)%modulus_a - one(:2)%modulus_b) <= 0.0_wp), "neighbours agree to the last digit")
            call check_close(other%modulus_a + other%modulus_b, [100.0_wp, 100.0_wp, 100.0_wp, 100.0_wp, 100.0_wp], &
                             "a constant modulus")
            call check(all(abs(other%contact_a) + abs(other%contact_b) <= 0.0_wp), "at once in contact")
        end associate
        call check(size(lowered%law_pieces) == 0 .and. all(lowered%layers%law_last < lowered%layers%law_first), "and no laws")
    end subroutine two_foundations_under_a_beam

    !> Below and above, each past its gap; the pieces of the law begin where the one before ends
    subroutine a_law_both_ways_is_two_layers()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%foundations = [foundation_type(to=6.0_wp, side=gapbeam_above, gap=0.25_wp), &
                             foundation_type(from=6.0_wp, gap=0.5_wp, gap_to=1.0_wp)]
        model%ground_law = [ground_law_point_type(2, 0.01_wp, 40.0_wp), ground_law_point_type(2, 0.05_wp, 60.0_wp), &
                            ground_law_point_type(2, 0.10_wp, 60.0_wp), ground_law_point_type(1, 2.0_wp, 1.0_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error) .and. all(lowered%layer_first == [1, 2, 3, 5]), "a law both ways is two layers")
        call check(all(lowered%layers%side == [-1, -1, 1, -1]), "the first pushes up, the other down")
        call check_close([lowered%layers%contact_a, lowered%layers%contact_b], &
                         [-0.25_wp, -0.25_wp, 0.5_wp, -0.5_wp, -0.25_wp, -0.25_wp, 1.0_wp, -1.0_wp], "past the gaps on both sides")
        call check(all(lowered%layers%law_first == [1, 1, 2, 2]) .and. all(lowered%layers%law_last == [1, 1, 4, 4]), &
                   "they share the pieces of the law")
        call check_close(lowered%law_pieces%displacement_a, [0.0_wp, 0.0_wp, 0.01_wp, 0.05_wp], "where the pieces begin")
        call check_close(lowered%law_pieces%force_b, [0.0_wp, 0.0_wp, 40.0_wp, 60.0_wp], "the force there")
        call check_close(lowered%law_pieces%slope_b, [0.5_wp, 4000.0_wp, 500.0_wp, 0.0_wp], "and their slopes")
    end subroutine a_law_both_ways_is_two_layers

    !> Straight between its points, beyond them the last value; points outside shape it
    subroutine a_profile_is_followed()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        type(layer_type), allocatable :: one(:), other(:)

        model = simple()
        model%foundations = [foundation_type(k=1.0_wp, side=gapbeam_below), &
                             foundation_type(from=2.0_wp, to=10.0_wp, k=1.0_wp, side=gapbeam_above)]
        model%ground = [ground_point_type(2, -2.0_wp, 1.0_wp), ground_point_type(2, 6.0_wp, 5.0_wp), &
                        ground_point_type(2, 8.0_wp, -1.0_wp), ground_point_type(2, 16.0_wp, 7.0_wp), &
                        ground_point_type(1, 4.0_wp, 1.0_wp), ground_point_type(1, 9.0_wp, 6.0_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error), "two profiles")
        call check_close(places(lowered), [0.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 6.0_wp, 8.0_wp, 9.0_wp, 10.0_wp, 12.0_wp], &
                         "their points on the foundations are points of the beam")
        call check(all(lowered%ground_point == [-1, 4, 5, -1, 3, 6]), "which know them")
        one = pack(lowered%layers, lowered%layers%foundation == 1)
        other = pack(lowered%layers, lowered%layers%foundation == 2)
        call check_close(one%contact_a, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 3.0_wp, 5.0_wp, 6.0_wp, 6.0_wp], &
                         "the last value goes on, at the left ends")
        call check_close(one%contact_b, [1.0_wp, 1.0_wp, 1.0_wp, 3.0_wp, 5.0_wp, 6.0_wp, 6.0_wp, 6.0_wp], "at the right ends")
        call check_close(other%contact_a, [-3.0_wp, -3.5_wp, -4.0_wp, -5.0_wp, 1.0_wp, 0.0_wp], &
                         "straight to points outside, at the left ends", absolute=1e-15_wp)
        call check_close(other%contact_b, [-3.5_wp, -4.0_wp, -5.0_wp, 1.0_wp, 0.0_wp, -1.0_wp], "at the right ends", &
                         absolute=1e-15_wp)
    end subroutine a_profile_is_followed

    !> A table of a modulus and two of a law: steps, a part that never carries, values that meet pairs
    subroutine tables_are_followed()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        type(layer_type), allocatable :: one(:), other(:)

        model = simple()
        model%foundations = [foundation_type(side=gapbeam_below), &
                             foundation_type(to=6.0_wp, law=gapbeam_law_plastic, parameter=[0.0_wp, 2.0_wp, 0.0_wp], &
                                             parameter_to=[0.0_wp, 8.0_wp, 0.0_wp])]
        model%ground = [table(1, gapbeam_table_of_k, -2.0_wp, 1.0_wp), table(1, gapbeam_table_of_k, 2.0_wp, 5.0_wp), &
                        table(1, gapbeam_table_of_k, 2.0_wp, 0.0_wp), table(1, gapbeam_table_of_k, 6.0_wp, 0.0_wp), &
                        table(1, gapbeam_table_of_k, 10.0_wp, 4.0_wp), &
                        table(2, gapbeam_table_of_parameter, 3.0_wp, 1.0_wp), &
                        table(2, gapbeam_table_of_parameter, 8.0_wp, 11.0_wp), table(1, gapbeam_table_of_gap, 4.0_wp, 0.5_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error), "tables")
        call check_close(places(lowered), [0.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 6.0_wp, 10.0_wp, 12.0_wp], "their points are points")
        one = pack(lowered%layers, lowered%layers%foundation == 1)
        other = pack(lowered%layers, lowered%layers%foundation == 2 .and. lowered%layers%side == gapbeam_below)
        call check_close(one%modulus_a, [3.0_wp, 0.0_wp, 4.0_wp], "a modulus at the left ends, none where it is 0")
        call check_close(one%modulus_b, [5.0_wp, 4.0_wp, 4.0_wp], "at the right ends, on the near side of a step")
        call check_close(one%contact_a, [0.5_wp, 0.5_wp, 0.5_wp], "the gap is a table as well")
        call check_close(other%parameter_a(1), [1.0_wp, 1.0_wp, 1.0_wp, 3.0_wp], "a stiffness at the left ends")
        call check_close(other%parameter_b(1), [1.0_wp, 1.0_wp, 3.0_wp, 7.0_wp], "and at the right ends")
        call check_close(other%parameter_b(2), [4.0_wp, 5.0_wp, 6.0_wp, 8.0_wp], "beside a limit that is a pair")
    end subroutine tables_are_followed

    !> A law at three places: its pieces at both ends of every piece of the beam
    subroutine a_law_that_varies()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error

        model = simple()
        model%foundations = [foundation_type(from=2.0_wp, to=10.0_wp, side=gapbeam_below)]
        model%ground_law = [ground_law_point_type(1, 1.0_wp, 0.0_wp, 0.0_wp), ground_law_point_type(1, 2.0_wp, 0.0_wp, 0.0_wp), &
                            ground_law_point_type(1, 1.0_wp, 0.0_wp, 4.0_wp), ground_law_point_type(1, 2.0_wp, 0.0_wp, 4.0_wp), &
                            ground_law_point_type(1, 1.0_wp, 4.0_wp, 8.0_wp), ground_law_point_type(1, 2.0_wp, 8.0_wp, 8.0_wp), &
                            ground_law_point_type(1, 3.0_wp, 4.0_wp, 16.0_wp), ground_law_point_type(1, 8.0_wp, 8.0_wp, 16.0_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error), "a law at four places")
        call check_close(places(lowered), [0.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 6.0_wp, 8.0_wp, 10.0_wp, 12.0_wp], &
                         "which are points")
        call check(size(lowered%layers) == 3 .and. all(lowered%layers%law == [0, 0, 6]), &
                   "straight, then not; nothing where it is 0")
        associate (layer => lowered%layers(1), pieces => lowered%law_pieces)
            call check(layer%law_last - layer%law_first == 1, "two pieces")
            call check_close(pieces(layer%law_first)%slope_a, 0.0_wp, "from 0", absolute=0.0_wp)
            call check_close([pieces(layer%law_first)%slope_b, pieces(layer%law_last)%force_b], [2.0_wp, 2.0_wp], "to 2")
        end associate
        associate (first => lowered%law_pieces(lowered%layers(3)%law_first), last => lowered%law_pieces(lowered%layers(3)%law_last))
            call check_close([first%way_a, first%way_b, first%slope_b], [1.0_wp, 1.5_wp, 4/1.5_wp], "a quarter of the way")
            call check_close([last%displacement_b, last%way_b, last%force_b], [1.5_wp, 2.0_wp, 4.0_wp], "the second piece there")
        end associate
        model%ground_law(8)%x = 15.0_wp
        call lower(model, lowered, error)
        call check(allocated(error) .and. error%key == "law.points" .and. error%partner == 7, "other numbers of points")
        model%ground_law(7:8)%x = 7.0_wp
        call lower(model, lowered, error)
        call check(allocated(error) .and. error%key == "law.x" .and. error%partner == 7, "places that go back")
    end subroutine a_law_that_varies

    !> A point of a table
    elemental function table(foundation, quantity, x, value) result(point)
        integer, intent(in) :: foundation, quantity
        real(wp), intent(in) :: x, value
        type(ground_point_type) :: point

        point = ground_point_type(foundation, x, value, quantity)
    end function table

    !> Every point of a long one is there
    subroutine a_long_profile()
        integer, parameter :: n = 100000
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        integer :: i

        model = simple()
        model%foundations = [foundation_type(k=1.0_wp, side=gapbeam_below)]
        model%ground = [(ground_point_type(1, 12*real(i, wp)/n, real(modulo(7*i, 11), wp)), i=0, n)]
        call lower(model, lowered, error)
        call check(.not. allocated(error) .and. size(lowered%layers) == n, "a hundred thousand points")
        call check(all(abs(lowered%layers%contact_a - model%ground(:n)%value) <= 0.0_wp) &
                   .and. all(abs(lowered%layers%contact_b - model%ground(2:)%value) <= 0.0_wp), "each with its own gap")
    end subroutine a_long_profile

    !> Moduli and levels in powers of two; once more where loads change
    subroutine layers_in_units_of_their_own()
        type(model_type) :: model
        type(assembled_type) :: lowered, before
        type(error_type), allocatable :: error

        model = simple()
        model%spans%EI = 12e200_wp
        model%loads(1)%value = 1e200_wp
        model%foundations = [foundation_type(to=6.0_wp, k=3e200_wp, side=gapbeam_below, gap=0.5_wp), foundation_type(from=6.0_wp)]
        model%ground_law = [ground_law_point_type(2, 0.125_wp, 1e200_wp)]
        call lower(model, lowered, error)
        call check(.not. allocated(error) .and. lowered%units%force > 600, "a stiff beam")
        associate (per_way => lowered%units%force - lowered%units%length - lowered%units%deflection, &
                   way => lowered%units%deflection, layer => lowered%layers(1))
            call check_close(scale(layer%modulus_a, per_way), 3e200_wp, "a modulus is a force by length and deflection")
            call check_close(scale(layer%contact_a, way), 0.5_wp, "a level a deflection")
            call check_close(scale(lowered%law_pieces(1)%slope_a, per_way), 8e200_wp, "and slopes are as moduli")
        end associate
        before = lowered
        call assemble_loads(lowered, error)
        call check_close([lowered%layers%modulus_a, lowered%layers%contact_a, lowered%law_pieces%slope_a], &
                         [before%layers%modulus_a, before%layers%contact_a, before%law_pieces%slope_a], &
                         "loads of other values leave them as they are")
        model%foundations(1)%k = 1e-200_wp
        call lower(model, lowered, error)
        call check(error%code == gapbeam_not_finite .and. index(error%message, "foundation 1 of 2: k = 1e-200") > 0, &
                   "too soft beside the beam")
    end subroutine layers_in_units_of_their_own

    !> Reasons, entries, keys and points
    subroutine everything_is_refused_with_a_reason()
        real(wp) :: nan
        integer :: i

        nan = ieee_value(nan, ieee_quiet_nan)
        call expect(foundation_type(from=-1.0_wp, k=1.0_wp), off_beam, "from", "it begins off the beam")
        call expect(foundation_type(to=13.0_wp, k=1.0_wp), off_beam, "to", "it ends off the beam")
        call expect(foundation_type(from=4.0_wp, to=4.0_wp, k=1.0_wp), no_stretch, "", "it has no length")
        call expect(foundation_type(), bad_law, "k", "it never carries")
        call expect(foundation_type(k=-1.0_wp), not_expected, "k", "a modulus below 0")
        call expect(foundation_type(k=1.0_wp, k_to=nan), not_expected, "k", "a modulus that is no number")
        call expect(foundation_type(k=gapbeam_infinity), bad_law, "side", "rigid ground that holds both ways")
        call expect(foundation_type(k=1.0_wp, k_to=gapbeam_infinity, side=gapbeam_below), bad_law, "k", "ground rigid at one end")
        call expect(foundation_type(k=1.0_wp, side=7), not_expected, "side", "no side")
        call expect(foundation_type(k=1.0_wp, side=gapbeam_below, gap=nan), not_expected, "gap", "a gap that is no number")
        call expect(foundation_type(k=1.0_wp, side=gapbeam_below, gap=0.1_wp), bad_law, "", "a gap and a profile", &
                    profile=[ground_point_type(2, 1.0_wp, 0.1_wp)])
        call expect(foundation_type(k=1.0_wp, side=gapbeam_below), bad_law, "profile", "a profile that goes back", &
                    profile=[(ground_point_type(2, real(modulo(i, 3), wp), 0.0_wp), i=1, 3)], point=3)
        call expect(foundation_type(k=1.0_wp, side=gapbeam_below), bad_law, "profile", "two points at a place", &
                    profile=[(ground_point_type(2, 3.0_wp*(1 + i*epsilon(1.0_wp)), 0.0_wp), i=1, 2)], point=2)
        call expect(foundation_type(k=1.0_wp, side=gapbeam_below), bad_law, "profile", "a point nowhere", &
                    profile=[ground_point_type(2, nan, 0.0_wp)], point=1)
        call expect(foundation_type(k=1.0_wp), bad_law, "k", "a modulus twice", profile=[table(2, 1, 0.0_wp, 1.0_wp)])
        call expect(foundation_type(), bad_law, "k", "a table of zeros", profile=table(2, 1, [0.0_wp, 1.0_wp], 0.0_wp))
        call expect(foundation_type(to=2.0_wp), bad_law, "k", "a table of zeros where the foundation is", &
                    profile=table(2, 1, [0.0_wp, 2.0_wp, 3.0_wp], [0.0_wp, 0.0_wp, 1.0_wp]))
        call expect(foundation_type(), bad_law, "k", "a modulus below 0 in a table", &
                    profile=table(2, 1, [0.0_wp, 1.0_wp], [1.0_wp, -1.0_wp]), point=2)
        call expect(foundation_type(), bad_law, "k", "three points at a place", &
                    profile=table(2, 1, [0.0_wp, 0.0_wp, 0.0_wp], 1.0_wp), point=3)
        call expect(foundation_type(k=1.0_wp), bad_law, "law", "a table of what there is not", &
                    profile=[table(2, 3, 0.0_wp, 1.0_wp)])
        call expect(foundation_type(k=1.0_wp), bad_law, "", "a table of nothing", profile=[table(2, 6, 0.0_wp, 1.0_wp)])
        call expect(foundation_type(law=gapbeam_law_cubic, parameter=[1.0_wp, 0.0_wp, 1.0_wp]), bad_law, "law.k2", &
                    "a law that falls between points of its tables", &
                    profile=table(2, 4, [0.0_wp, 3.0_wp, 6.0_wp], [0.0_wp, -2.0_wp, 0.0_wp]))
        call expect(foundation_type(law=gapbeam_law_tanh, parameter=[1.0_wp, 0.0_wp, 0.0_wp]), bad_law, "law.limit", &
                    "a limit of 0 in the midst of a table", &
                    profile=table(2, 4, [0.0_wp, 3.0_wp, 6.0_wp], [1.0_wp, 0.0_wp, 1.0_wp]))
        call expect(foundation_type(k=1.0_wp), bad_law, "", "a modulus and a law", law=[ground_law_point_type(2, 1.0_wp, 1.0_wp)])
        call expect(foundation_type(), bad_law, "law", "a vertical piece at first", &
                    law=[ground_law_point_type(2, 0.0_wp, 1.0_wp)], point=1)
        call expect(foundation_type(), bad_law, "law", "a slope beyond all numbers", &
                    law=[ground_law_point_type(2, 1e-200_wp, 1e200_wp)], point=1)
        call expect(foundation_type(), bad_law, "law", "a point at the origin", &
                    law=[ground_law_point_type(2, 0.0_wp, 0.0_wp)], point=1)
        call expect(foundation_type(), bad_law, "law", "displacements that go back", &
                    law=[ground_law_point_type(2, 1.0_wp, 1.0_wp), ground_law_point_type(2, 0.5_wp, 2.0_wp)], point=2)
        call expect(foundation_type(), bad_law, "law", "ground that falls at last", &
                    law=[ground_law_point_type(2, 1.0_wp, 2.0_wp), ground_law_point_type(2, 2.0_wp, 1.0_wp)], point=2)
        call expect(foundation_type(), bad_law, "law", "a law that never carries", law=[ground_law_point_type(2, 1.0_wp, 0.0_wp)])
        call expect(foundation_type(), bad_law, "law", "points apart from each other", &
                    law=[ground_law_point_type(2, 1.0_wp, 1.0_wp), ground_law_point_type(1, 1.0_wp, 1.0_wp), &
                         ground_law_point_type(2, 2.0_wp, 1.0_wp)])
    end subroutine everything_is_refused_with_a_reason

    !> The second of two foundations is refused, and why
    subroutine expect(foundation, reason, key, name, profile, law, point)
        type(foundation_type), intent(in) :: foundation
        integer, intent(in) :: reason
        character(len=*), intent(in) :: key, name
        type(ground_point_type), intent(in), optional :: profile(:)
        type(ground_law_point_type), intent(in), optional :: law(:)
        integer, intent(in), optional :: point
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        logical :: right

        model = simple()
        model%foundations = [foundation_type(k=1.0_wp), foundation]
        if (present(profile)) model%ground = profile
        if (present(law)) model%ground_law = law
        call lower(model, lowered, error)
        right = allocated(error)
        if (right) right = error%code == gapbeam_bad_input .and. error%table == of_foundations .and. error%entry == 2 &
            .and. error%reason == reason .and. error%key == key
        if (right .and. present(point)) right = error%partner == point
        call check(right, name)
    end subroutine expect

    !> Results are known by them
    subroutine fingerprints_differ()
        type(model_type) :: model
        type(assembled_type) :: lowered
        type(error_type), allocatable :: error
        integer :: before

        model = simple()
        model%foundations = [foundation_type(side=gapbeam_both)]
        model%ground_law = [ground_law_point_type(1, 1.0_wp, 1.0_wp)]
        call lower(model, lowered, error)
        before = lowered%fingerprint
        model%ground_law(1)%force = 2.0_wp
        call lower(model, lowered, error)
        call check(before /= lowered%fingerprint .and. lowered%fingerprint == fingerprint(lowered%model), "another law")
        before = lowered%fingerprint
        model%foundations(1)%to = 6.0_wp
        call lower(model, lowered, error)
        call check(before /= lowered%fingerprint, "another stretch")
    end subroutine fingerprints_differ

end program test_assemble_foundations
