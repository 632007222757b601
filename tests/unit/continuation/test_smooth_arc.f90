!> Arcs on smooth laws beside closed forms: states, limit points, load factors, where the beam gives way, and branches beyond
program test_smooth_arc
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use testing, only: check, check_close, finish
    use gapbeam_scene, only: model_type, span_type, support_type, point_force, gapbeam_below, gapbeam_law_cubic
    use gapbeam_assembled_model, only: assembled_type, copy_model
    use gapbeam_assemble, only: assemble_model
    use gapbeam_smooth_arc, only: arc_type, new_arc
    use gapbeam_arc_states, only: find_on_arc, rate_beside, eigenvalues_at, wrongness_of
    use gapbeam_arc_roots, only: arc_test_type, of_factor, of_rate, of_eigenvalue, find_root, find_roots
    use gapbeam_smooth_branches, only: branch_points_type, tracer_at, follow_branch, point_at_factor
    implicit none
    !> Force 9 w - 6 w**2 + w**3 beside a beam of stiffness 1: the load is stationary at 2 -+ sqrt(2/3)
    real(wp), parameter :: cubic(3) = [9.0_wp, -6.0_wp, 1.0_wp], top = 2 - sqrt(2.0_wp/3), foot = 2 + sqrt(2.0_wp/3)
    integer :: status

    call limit_points()
    call nothing_there()
    call balance(40.0_wp, .true.)
    call balance(4.0_wp, .false.)
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Force of the law
    pure function force_of(w)
        real(wp), intent(in) :: w
        real(wp) :: force_of

        force_of = w*(cubic(1) + w*(cubic(2) + w*cubic(3)))
    end function force_of

    !> A simple beam of stiffness 1 on the law at midspan, under a force of 10
    subroutine one_law(assembled)
        type(assembled_type), intent(out) :: assembled
        type(model_type) :: model

        model%spans = [span_type(1.0_wp, EI=1.0_wp/48)]
        model%supports = [support_type(node=0), support_type(node=1), &
                          support_type(x=0.5_wp, side=gapbeam_below, law=gapbeam_law_cubic, parameter=cubic)]
        model%loads = [point_force(10.0_wp, x=0.5_wp)]
        call assemble_copy(model, assembled)
    end subroutine one_law

    !> Assemble a model
    subroutine assemble_copy(model, assembled)
        type(model_type), intent(in) :: model
        type(assembled_type), intent(out) :: assembled
        type(error_type), allocatable :: error
        integer :: stat

        call copy_model(model, assembled%model, stat)
        if (stat == 0) call assemble_model(assembled, error)
        call check(stat == 0 .and. .not. allocated(error), "assembled")
    end subroutine assemble_copy

    !> An arc between two deflections near the path
    subroutine arc_between(assembled, from, to, arc, turn)
        type(assembled_type), intent(in), target :: assembled
        real(wp), intent(in) :: from, to
        type(arc_type), intent(out) :: arc
        real(wp), intent(in), optional :: turn
        type(error_type), allocatable :: error
        real(wp), allocatable :: turning(:)

        if (present(turn)) turning = [turn, (turn + force_of(turn))/10]
        call new_arc(assembled, spread(.true., 1, size(assembled%normal)), assembled%beam%supports, &
                     [from, (from + force_of(from))/10], [to, (to + force_of(to))/10], arc, error, turning)
        call check(.not. allocated(error), "an arc")
    end subroutine arc_between

    !> One law, through both limit points
    subroutine limit_points()
        type(assembled_type), target :: assembled
        type(arc_type) :: arc
        type(error_type), allocatable :: error
        integer, allocatable :: states(:)
        real(wp) :: rate, values(1), wrongness
        integer :: number

        call one_law(assembled)
        call arc_between(assembled, 0.5_wp, 1.0_wp, arc)
        call find_on_arc(arc, 0.3_wp, number, error)
        call check(.not. allocated(error), "there is a state between")
        if (allocated(error)) return
        associate (s => arc%known(number)%one)
            call check_close(s%point(2), (s%point(1) + force_of(s%point(1)))/10, "a state is on the path")
            call check_close(s%rate(2)/s%rate(1), (1 + 9 - 12*s%point(1) + 3*s%point(1)**2)/10, "so is its rate", 1e-11_wp)
            call eigenvalues_at(arc, s%slope, values, error)
            call check(values(1) > 0.0_wp, "it is stable")
            call wrongness_of(arc, s%state, wrongness, error)
            call check(wrongness < 1e-12_wp, "all supports are on their pieces")
        end associate
        call find_root(arc, arc_test_type(of_factor, level=0.45_wp), -huge(1.0_wp), huge(1.0_wp), 0.0_wp, number, error)
        call check_close(arc%known(number)%one%point(1) + force_of(arc%known(number)%one%point(1)), 4.5_wp, "a load factor")
        call arc_between(assembled, 0.9_wp, 1.6_wp, arc, turn=1.2_wp)
        call find_roots(arc, arc_test_type(of_rate), states, error)
        call check(size(states) == 1, "one limit point")
        call check_close(arc%known(states(1))%one%point(1), top, "is at the top", 1e-8_wp)
        call check_close(arc%known(states(1))%one%point(2), (top + force_of(top))/10, "of the load")
        call rate_beside(arc, arc%known(states(1))%one%at, -1, rate, error)
        call check(rate > 0.0_wp, "which rises before")
        call rate_beside(arc, arc%known(states(1))%one%at, 1, rate, error)
        call check(rate < 0.0_wp, "and falls beyond")
        call find_root(arc, arc_test_type(of_eigenvalue, 1), -huge(1.0_wp), huge(1.0_wp), 0.0_wp, number, error)
        call check_close(arc%known(number)%one%point(1), top, "where the stiffness is zero", 1e-12_wp)
        call arc_between(assembled, 2.6_wp, 3.1_wp, arc, turn=2.8_wp)
        call find_root(arc, arc_test_type(of_rate), -huge(1.0_wp), huge(1.0_wp), 0.0_wp, number, error)
        call check_close(arc%known(number)%one%point(1), foot, "the other one", 1e-8_wp)
    end subroutine limit_points

    !> What is not there is said to be lost
    subroutine nothing_there()
        type(assembled_type), target :: assembled
        type(arc_type) :: arc
        type(error_type), allocatable :: error
        real(wp) :: point(2)
        integer :: number

        call one_law(assembled)
        call arc_between(assembled, 0.1_wp, 0.2_wp, arc)
        call find_root(arc, arc_test_type(of_rate), 0.0_wp, 1.0_wp, 0.0_wp, number, error)
        call check(allocated(error), "no limit point between two bounds")
        point = [0.1_wp, 0.3_wp]
        call new_arc(assembled, spread(.true., 1, size(assembled%normal)), assembled%beam%supports, point, point, arc, error)
        call check(allocated(error), "no arc between a state and itself")
    end subroutine nothing_there

    !> A beam over a rigid middle with equal laws under its tips: it gives way to a side at the peak of the law, where it is level.
    !> Beside that x and y are two roots of one force c, and the load k (x + y)/2 + c; it rises if k is above 2 r'(z), z the third
    !> root. The peak is at 1, and z at 4, where r' is 9
    subroutine balance(k, rises)
        !> Stiffness of an arm
        real(wp), intent(in) :: k
        logical, intent(in) :: rises
        type(model_type) :: model
        type(assembled_type), target :: assembled
        type(arc_type), target :: arc
        type(error_type), allocatable :: error
        type(branch_points_type) :: branch
        real(wp) :: from(3), to(3), point(3), peak
        integer :: number, j

        model%spans = [span_type(1.0_wp, EI=k/3), span_type(1.0_wp, EI=k/3)]
        model%supports = [support_type(node=0, side=gapbeam_below, law=gapbeam_law_cubic, parameter=cubic), support_type(node=1), &
                          support_type(node=2, side=gapbeam_below, law=gapbeam_law_cubic, parameter=cubic)]
        model%loads = [point_force(10.0_wp, node=0), point_force(10.0_wp, node=2)]
        call assemble_copy(model, assembled)
        from = [0.8_wp, 0.8_wp, (k*0.8_wp + force_of(0.8_wp))/10]
        to = [1.1_wp, 1.1_wp, (k*1.1_wp + force_of(1.1_wp))/10]
        call new_arc(assembled, spread(.true., 1, size(assembled%normal)), assembled%beam%supports, from, to, arc, error)
        call check(.not. allocated(error), "an arc on two laws")
        call find_root(arc, arc_test_type(of_eigenvalue, 1), -huge(1.0_wp), huge(1.0_wp), 0.0_wp, number, error)
        point = arc%known(number)%one%point
        peak = (k + force_of(1.0_wp))/10
        ! The equations are dependent there
        call check_close(point(:2), [1.0_wp, 1.0_wp], "it gives way at the peak", 1e-9_wp)
        call check_close(point(3), peak, "of the law", 1e-12_wp)
        call follow_branch(tracer_at(arc, point), 1, 1.1_wp*peak, branch, error)
        call check(.not. allocated(error), "whether a stable way goes on is told")
        call check((branch%number > 1) .eqv. rises, "as by hand")
        call check((branch%arrives .eqv. rises) .and. .not. branch%lost, "to the load factor")
        if (.not. rises) return
        do j = 2, branch%number
            associate (x => branch%points(1, j), y => branch%points(2, j), factor => branch%points(3, j))
                call check_close(force_of(x), force_of(y), "both take the same force", 1e-9_wp)
                call check_close(k*(x + y)/2 + force_of(x), 10*factor, "that balances the load", 1e-9_wp)
            end associate
        end do
        call check_close(branch%points(3, branch%number), 1.1_wp*peak, "at the end", 1e-12_wp)
        call check(abs(point(1) - branch%points(1, branch%number)) > 0.1_wp, "to a side")
        call point_at_factor(tracer_at(arc, branch%points(:, 1)), branch%points(:, :branch%number), 1.05_wp*peak, point, error)
        call check_close(k*(point(1) + point(2))/2 + force_of(point(1)), 10.5_wp*peak, "and between", 1e-12_wp)
    end subroutine balance

end program test_smooth_arc
