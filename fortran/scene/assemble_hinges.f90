!> Elastic hinges as compliances at the left ends of pieces, in the engine's units.
module gapbeam_assemble_hinges
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: softest_hinge
    use gapbeam_error, only: error_type
    use gapbeam_range, only: is_lost
    use gapbeam_units, only: turning_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_input_error, only: refuse, of_hinges, bad_law
    implicit none
    private
    public :: assemble_hinges

contains

    !> Compliances of the elastic hinges, if there are any
    subroutine assemble_hinges(assembled, error)
        !> Points, and pieces in the engine's units in
        type(assembled_type), intent(inout) :: assembled
        !> What a hinge cannot be
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: softness
        integer :: j

        assembled%pieces%hinge = 0.0_wp
        if (.not. any(assembled%joint > 0.0_wp)) return
        softness = sum(assembled%pieces%flexibility*assembled%pieces%length)
        do j = 2, size(assembled%pieces)
            if (.not. assembled%joint(j - 1) > 0.0_wp) cycle
            associate (beside => assembled%pieces(j - 1:j)%flexibility, hinge => assembled%pieces(j)%hinge)
                hinge = 1/scale(assembled%joint(j - 1), -turning_unit(assembled%units))
                if (is_lost(hinge)) then
                    call refuse_hinge("it is too far from the other stiffnesses of the beam; bring them nearer together")
                else if (.not. minval(beside) > 0.0_wp) then
                    call refuse_hinge("the beam is rigid beside it (infinite EI), which is not available with a stiffness in "// &
                                      "this version")
                else if (hinge > softest_hinge*softness) then
                    call refuse_hinge("it is so far below EI/length of the beam that it is a free hinge; give 0")
                else if (size(assembled%model%foundations) > 0) then
                    call refuse_hinge("a hinge with a stiffness beside a foundation is not available in this version; leave "// &
                                      "one of them out")
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> Refuse the hinge at the left end of piece j
        subroutine refuse_hinge(problem)
            character(len=*), intent(in) :: problem

            call refuse(error, of_hinges, findloc(assembled%model%hinge_stiffness, assembled%joint(j - 1), 1), &
                        size(assembled%model%hinges), bad_law, "stiffness", problem)
        end subroutine refuse_hinge

    end subroutine assemble_hinges

end module gapbeam_assemble_hinges
