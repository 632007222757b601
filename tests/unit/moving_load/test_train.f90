!> Trains over beams: events in position, positions without equilibrium, extremes, influence lines
program test_train
    use, intrinsic :: ieee_arithmetic, only: ieee_status_type, ieee_get_status, ieee_set_status, ieee_set_halting_mode, ieee_all
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: bending_count, of_shear
    use gapbeam_error, only: error_type, gapbeam_solved, gapbeam_no_equilibrium
    use gapbeam_scene, only: model_type, span_type, support_type, uniform_load, gapbeam_below, gapbeam_dead
    use gapbeam_assembled_model, only: assembled_type, copy_model
    use gapbeam_assemble, only: assemble_model
    use gapbeam_train, only: train_type, uniform_type, track_type, new_track
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_path, only: pass_train
    use gapbeam_train_events, only: train_event_type, find_events
    use gapbeam_train_envelope, only: envelope_type, find_envelope
    use gapbeam_element, only: field_type
    use gapbeam_train_samples, only: samples_type, new_samples, sample_stretch, degree_in_position
    use gapbeam_train_link_bounds, only: view_type, link_bounds_type, new_view, enter_stretch, bound_link
    use gapbeam_train_curves, only: find_curves
    use gapbeam_train_influence, only: find_influence
    use gapbeam_influence_parts, only: find_parts
    use gapbeam_pieces, only: gapbeam_opens, gapbeam_closes
    implicit none
    integer :: status

    call an_end_lifts()
    call a_plank_tips()
    call a_train_with_a_uniform_load()
    call a_train_as_long_as_the_beam()
    call coefficients_give_the_state()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A beam with own weight on supports from below at its span ends, made ready with all traps off, as the interfaces do
    subroutine make(lengths, at, weight, lowered, track)
        real(wp), intent(in) :: lengths(:), at(:), weight
        type(assembled_type), intent(out) :: lowered
        type(track_type), intent(out) :: track
        type(model_type) :: model
        type(ieee_status_type) :: environment
        type(error_type), allocatable :: error
        integer :: k, stat

        allocate (model%spans(size(lengths)), model%supports(size(at)), model%loads(1))
        do k = 1, size(lengths)
            model%spans(k) = span_type(lengths(k), EI=1.0_wp)
        end do
        do k = 1, size(at)
            model%supports(k) = support_type(x=at(k), side=gapbeam_below)
        end do
        model%loads(1) = uniform_load(weight, 0.0_wp, sum(lengths), gapbeam_dead)
        call ieee_get_status(environment)
        call ieee_set_halting_mode(ieee_all, .false.)
        call copy_model(model, lowered%model, stat)
        call assemble_model(lowered, error)
        call ieee_set_status(environment)
        call check(.not. allocated(error), "a model")
        call new_track(lowered, track, error)
        call check(.not. allocated(error), "a track")
    end subroutine make

    !> Reference problem D1
    subroutine an_end_lifts()
        type(assembled_type) :: lowered
        type(track_type) :: track
        type(train_type) :: train
        type(traversal_type) :: passage
        type(envelope_type) :: envelope
        type(train_event_type), allocatable :: events(:)
        type(error_type), allocatable :: error
        real(wp) :: value(2, bending_count, 1), position(2, bending_count, 1), line(bending_count + 2, 2)
        real(wp) :: edge(12)
        integer :: sign_of(12), number

        call make([1.0_wp, 1.0_wp], [0.0_wp, 1.0_wp, 2.0_wp], 1.0_wp, lowered, track)
        train = axles([0.0_wp], [8.0_wp])
        call pass_train(lowered, track, train, 0.0_wp, 1.0_wp, passage, error)
        call check(.not. allocated(error), "D1")
        call find_events(lowered, passage, .false., events, error)
        call check(size(events) == 2, "two events")
        if (size(events) /= 2) return
        call check_close(events%position, [0.194903920083_wp, 0.888199776858_wp], "where", 1e-12_wp)
        call check(all(events%support == 3) .and. all(events%change == [gapbeam_opens, gapbeam_closes]), "what")
        call find_envelope(lowered, track, passage, envelope, error)
        associate (rise => envelope%fields(2, 1)%ties(1), opening => envelope%supports(1, 2, 3)%ties(1))
            call check_close([rise%value, rise%x], [-0.26320023928_wp, 2.0_wp], "rise", 1e-11_wp)
            call check_close([rise%position, opening%position], [1, 1]/sqrt(3.0_wp), "where it is largest", 1e-12_wp)
            call check_close(opening%value, 8/(9*sqrt(3.0_wp)) - 0.25_wp, "as opening")
        end associate
        call find_curves(lowered, track, passage, [1], [0.25_wp], value, position, error)
        ! The train on the place, the end lifted: simple span of 1 with the overhang's weight
        call check_close([value(1, 3, 1), position(1, 3, 1)], [1.5_wp - 0.125_wp + 0.09375_wp, 0.25_wp], "a moment")
        call find_influence(lowered, track, [.true., .true., .true.], [.false., .true., .false.], 1, 0.5_wp, &
                            [0.25_wp, 1.5_wp], line, error)
        call check_close(line(3, :), [0.125_wp - 0.25_wp*0.9375_wp/8, -0.375_wp/8], "influence on a moment")
        call check_close(line(bending_count + 1, :), [0.25_wp*(3 - 0.0625_wp)/2, 0.5_wp*(3 - 0.25_wp)/2], "influence on a reaction")
        ! Shear at midspan: a force in the other span adds that of the moment at the support, which is negative
        call find_parts(lowered, [.true., .true., .true.], [.false., .true., .false.], 1, 0.5_wp, of_shear, edge, sign_of, number, &
                        error)
        call check(number == 3, "parts of a line")
        call check_close(edge(:3), [0.5_wp, 1.0_wp, 2.0_wp], "ends of the parts")
        call check(all(sign_of(:3) == [-1, 1, -1]), "signs of the parts")
    end subroutine an_end_lifts

    !> A train without uniform loads
    function axles(offset, force) result(train)
        real(wp), intent(in) :: offset(:), force(:)
        type(train_type) :: train

        allocate (train%offset(size(offset)), train%force(size(force)), train%uniform(0))
        train%offset(:) = offset
        train%force(:) = force
    end function axles

    !> The weight cannot hold the train on the overhang
    subroutine a_plank_tips()
        type(assembled_type) :: lowered
        type(track_type) :: track
        type(traversal_type) :: passage
        type(error_type), allocatable :: error

        call make([2.0_wp, 1.0_wp], [0.0_wp, 2.0_wp], 1.0_wp, lowered, track)
        call pass_train(lowered, track, axles([0.0_wp], [5.0_wp]), 0.0_wp, 3.0_wp, passage, error)
        call check(.not. allocated(error), "a plank")
        associate (n => passage%number)
            call check(all(passage%status(:n) == [gapbeam_solved, gapbeam_solved, gapbeam_no_equilibrium]), "tips at the end")
            call check_close([passage%from(n), passage%to(n)], [2.3_wp, 3.0_wp], "where")
            call check_close(passage%motion(:, 1), [-1.0_wp, 0.0_wp, 0.5_wp], "how")
        end associate
    end subroutine a_plank_tips

    !> Of a simple beam: the greatest moment under a force with a load behind it, at the ends of the range nothing
    subroutine a_train_with_a_uniform_load()
        type(assembled_type) :: lowered
        type(track_type) :: track
        type(train_type) :: train
        type(traversal_type) :: passage
        type(envelope_type) :: envelope
        type(error_type), allocatable :: error

        call make([4.0_wp], [0.0_wp, 4.0_wp], 0.0_wp, lowered, track)
        train = train_type([0.0_wp, -4.0_wp], [0.0_wp, 0.0_wp], [uniform_type(2.0_wp, -4.0_wp, 0.0_wp)])
        call pass_train(lowered, track, train, 0.0_wp, 8.0_wp, passage, error)
        call check(.not. allocated(error), "a uniform load")
        call find_envelope(lowered, track, passage, envelope, error)
        associate (moment => envelope%fields(1, 3)%ties(1), sag => envelope%fields(1, 1)%ties(1))
            call check_close([moment%value, moment%x, moment%position], [4.0_wp, 2.0_wp, 4.0_wp], "all of it on the beam", 1e-12_wp)
            call check_close(sag%value, 5*2*4.0_wp**4/384, "and its sag", 1e-12_wp)
        end associate
    end subroutine a_train_with_a_uniform_load

    !> Two axles at a distance of the length of the beam: both act at one position only
    subroutine a_train_as_long_as_the_beam()
        type(assembled_type) :: lowered
        type(track_type) :: track
        type(train_type) :: train
        type(traversal_type) :: passage
        type(envelope_type) :: envelope
        type(error_type), allocatable :: error

        call make([4.0_wp], [1.0_wp, 3.0_wp], 4.0_wp, lowered, track)
        train = axles([0.0_wp, -4.0_wp], [1.0_wp, 1.0_wp])
        call pass_train(lowered, track, train, 0.0_wp, 8.0_wp, passage, error)
        call check(.not. allocated(error), "a long train")
        call find_envelope(lowered, track, passage, envelope, error)
        associate (moment => envelope%fields(2, 3)%ties(1))
            call check_close([moment%value, moment%position], [-3.0_wp, 0.0_wp], "one axle at an end")
        end associate
        associate (r => pack(passage%interval(:passage%number), passage%from(:passage%number) >= passage%to(:passage%number)))
            call check(size(r) == 1, "one position by itself")
            if (size(r) == 1) call check_close(passage%intervals(r(1))%from, 4.0_wp, "where both act")
        end associate
    end subroutine a_train_as_long_as_the_beam

    !> What bounds rest on: the same fields at the end of every stretch as by solving there
    subroutine coefficients_give_the_state()
        type(assembled_type) :: lowered
        type(track_type) :: track
        type(train_type) :: train
        type(traversal_type) :: passage
        type(samples_type) :: samples
        type(view_type) :: view
        type(link_bounds_type) :: look
        type(field_type) :: seen(20)
        type(error_type), allocatable :: error
        real(wp) :: worst
        integer :: c, i, k, stat

        call make([2.0_wp, 3.0_wp, 2.0_wp, 1.0_wp], [0.0_wp, 2.0_wp, 5.0_wp, 7.0_wp], 0.5_wp, lowered, track)
        train = train_type([0.0_wp, -0.75_wp, -3.5_wp], [3.0_wp, 2.0_wp, 4.0_wp], &
                           [uniform_type(0.25_wp, -3.5_wp, 0.0_wp), uniform_type(0.125_wp, -1.0_wp, 2.0_wp)])
        call pass_train(lowered, track, train, 0.0_wp, 11.5_wp, passage, error)
        call check(.not. allocated(error), "a train passes")
        call new_samples(lowered, track, degree_in_position(train), samples, error)
        call new_view(lowered, track, view, stat)
        worst = 0.0_wp
        do k = 1, passage%number
            if (passage%status(k) /= gapbeam_solved) cycle
            call sample_stretch(lowered, track, passage, k, samples, error)
            call enter_stretch(track, passage, k, view)
            do i = 1, size(track%beam%links)
                call bound_link(lowered, track, view, i, 1.0_wp, look, seen)
            end do
            do c = 1, samples%cells%number
                associate (a => seen(c), b => samples%starts(samples%degree, c))
                    worst = max(worst, abs(a%deflection - b%deflection), abs(a%rotation - b%rotation), &
                                abs(a%moment - b%moment), abs(a%shear - b%shear))
                end associate
            end do
        end do
        call check(passage%number > 10, "many stretches")
        call check_close(worst, 0.0_wp, "fields from coefficients", absolute=1.0e-12_wp)
    end subroutine coefficients_give_the_state

end program test_train
