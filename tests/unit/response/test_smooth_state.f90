!> States on smooth laws: a force or displacement that is beside its curve is refused
program test_smooth_state
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use testing, only: check, finish
    use gapbeam_scene, only: support_type, gapbeam_below, gapbeam_law_tanh, gapbeam_law_power
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_laws, only: law_force
    use gapbeam_smooth_state, only: audit_laws, place_type
    implicit none
    integer :: status

    call audits(gapbeam_law_tanh, [1000.0_wp, 2.0_wp, 0.0_wp])
    call audits(gapbeam_law_power, [0.015625_wp, 2.0_wp, 3.0_wp])
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> A support on its law, and beside it
    subroutine audits(law, parameter)
        integer, intent(in) :: law
        real(wp), intent(in) :: parameter(3)
        type(assembled_type) :: assembled
        type(place_type) :: place
        type(error_type), allocatable :: error

        allocate (assembled%model%supports(1))
        assembled%model%supports(1) = support_type(node=0, side=gapbeam_below, law=law, parameter=parameter)
        place%past = 0.001_wp
        place%reached = law_force(law, parameter, place%past)
        call audit_laws(assembled, [1], [place], place%past, place%reached, error)
        call check(.not. allocated(error), "on the law")
        place%reached = place%reached*(1 + 1e-9_wp)
        call audit_laws(assembled, [1], [place], place%past, place%reached, error)
        call check(allocated(error), "beside it")
        if (allocated(error)) call check(index(error%message, "support 1 of 1: law") > 0, "named")
    end subroutine audits

end program test_smooth_state
