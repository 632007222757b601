!> Largest and smallest values at places of beams on ground that trains pass: how many linear solves they take
program test_train_lines
    use, intrinsic :: ieee_arithmetic, only: ieee_status_type, ieee_get_status, ieee_set_status, ieee_set_halting_mode, ieee_all
    use testing, only: check, finish
    use gapbeam_kinds, only: wp
    use gapbeam_quantities, only: of_deflection, of_rotation, of_moment, of_shear, of_pressure
    use gapbeam_error, only: error_type
    use gapbeam_search, only: rule_block
    use gapbeam_scene, only: model_type, span_type, support_type, foundation_type, ground_law_point_type, uniform_load, &
        gapbeam_below, gapbeam_dead
    use gapbeam_assembled_model, only: assembled_type, copy_model
    use gapbeam_assemble, only: assemble_model
    use gapbeam_train, only: train_type, uniform_type
    use gapbeam_train_runs, only: runs_type, follow_train_on_ground
    use gapbeam_train_lines, only: find_lines
    implicit none
    integer :: status

    call check_lines("a rail with a stop below it", rail(), bogie(), 0.0_wp, 12.0_wp, 600)
    call check_lines("two layers and a hinge", layers(), lorry(), -2.5_wp, 12.0_wp, 1000)
    call check_lines("a plank that tips", plank(), man(), 0.0_wp, 10.0_wp, 900)
    call check_lines("a rail on ground by lines", bent(), handcar(), 0.0_wp, 12.0_wp, 400)
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A rail on ground that cannot pull, with a stop below it
    function rail() result(model)
        type(model_type) :: model

        allocate (model%spans(1), model%supports(1), model%foundations(1), model%loads(1))
        model%spans(1) = span_type(12.0_wp, EI=200.0_wp)
        model%supports(1) = support_type(x=7.0_wp, side=gapbeam_below, stiffness=300.0_wp, gap=0.01_wp)
        model%foundations(1) = foundation_type(k=60.0_wp, side=gapbeam_below)
        model%loads(1) = uniform_load(0.5_wp, 0.0_wp, 12.0_wp, gapbeam_dead)
    end function rail

    !> Ground on which another one lies, by lines, under two spans with a hinge
    function layers() result(model)
        type(model_type) :: model

        model = rail()
        deallocate (model%spans, model%supports, model%foundations)
        allocate (model%spans(2), model%supports(2), model%foundations(2), model%hinges(1), model%ground_law(2))
        model%spans(:) = [span_type(5.0_wp, EI=200.0_wp), span_type(7.0_wp, EI=200.0_wp)]
        model%hinges(1) = 6.0_wp
        model%supports(1) = support_type(x=0.0_wp)
        model%supports(2) = support_type(x=12.0_wp, side=gapbeam_below, gap=-0.002_wp)
        model%foundations(1) = foundation_type(to=9.0_wp, k=20.0_wp, side=gapbeam_below)
        model%foundations(2) = foundation_type(from=3.0_wp, side=gapbeam_below)
        model%ground_law(:) = [ground_law_point_type(2, 0.05_wp, 2.0_wp), ground_law_point_type(2, 0.2_wp, 4.0_wp)]
    end function layers

    !> A rail on ground by lines
    function bent() result(model)
        type(model_type) :: model

        model = rail()
        deallocate (model%supports)
        model%foundations(1) = foundation_type(side=gapbeam_below)
        allocate (model%ground_law(2))
        model%ground_law(:) = [ground_law_point_type(1, 0.05_wp, 2.0_wp), ground_law_point_type(1, 0.2_wp, 4.0_wp)]
    end function bent

    !> A light axle
    function handcar() result(train)
        type(train_type) :: train

        train = man()
        train%force(1) = 4.0_wp
    end function handcar

    !> Ground under the middle of a plank only
    function plank() result(model)
        type(model_type) :: model

        allocate (model%spans(1), model%foundations(1), model%loads(1))
        model%spans(1) = span_type(10.0_wp, EI=500.0_wp)
        model%foundations(1) = foundation_type(from=4.0_wp, to=6.0_wp, k=40.0_wp, side=gapbeam_below)
        model%loads(1) = uniform_load(1.0_wp, 0.0_wp, 10.0_wp, gapbeam_dead)
    end function plank

    !> One axle
    function man() result(train)
        type(train_type) :: train

        allocate (train%offset(1), train%force(1), train%uniform(0))
        train%offset(1) = 0.0_wp
        train%force(1) = 5.0_wp
    end function man

    !> Two axles
    function bogie() result(train)
        type(train_type) :: train

        allocate (train%offset(2), train%force(2), train%uniform(0))
        train%offset(:) = [0.0_wp, -1.5_wp]
        train%force(:) = 10.0_wp
    end function bogie

    !> An axle in front of a load
    function lorry() result(train)
        type(train_type) :: train

        allocate (train%offset(1), train%force(1), train%uniform(1))
        train%offset(1) = 0.0_wp
        train%force(1) = 7.2_wp
        train%uniform(1) = uniform_type(1.2_wp, -2.5_wp, 0.0_wp)
    end function lorry

    !> Values at places, and what they take
    subroutine check_lines(name, model, train, from, to, most)
        character(len=*), intent(in) :: name
        type(model_type), intent(in) :: model
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: from, to
        !> Linear solves
        integer, intent(in) :: most
        integer, parameter :: count = 21, quantities(5) = [of_deflection, of_rotation, of_moment, of_shear, of_pressure]
        type(assembled_type) :: lowered
        type(runs_type) :: runs
        type(ieee_status_type) :: environment
        type(error_type), allocatable :: error
        real(wp) :: x(count), value(2, size(quantities), count), position(2, size(quantities), count)
        logical :: left(count)
        integer :: before, k, stat

        call ieee_get_status(environment)
        call ieee_set_halting_mode(ieee_all, .false.)
        call copy_model(model, lowered%model, stat)
        call assemble_model(lowered, error)
        call check(.not. allocated(error), name//": a model")
        call follow_train_on_ground(lowered, train, rule_block, from, to, .false., runs, error)
        call check(.not. allocated(error), name//": passed")
        x(:) = [(to*k/(count - 1), k=0, count - 1)]
        left(:) = .false.
        left(count) = .true.
        before = runs%solves
        call find_lines(lowered, runs, quantities, x, left, value, position, error)
        call check(.not. allocated(error), name//": lines")
        call check(runs%solves - before <= most, name//": few states are enough")
        call check(all(value(1, :, :) >= value(2, :, :)), name//": the largest is not below the smallest")
        call check(all(value(2, size(quantities), :) >= 0.0_wp), name//": ground does not pull")
        call ieee_set_status(environment)
    end subroutine check_lines

end program test_train_lines
