!> The chain of bars and springs along the axis of a beam: its forces and displacements, audited.
module gapbeam_along_axis
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_indeterminate, gapbeam_not_converged, gapbeam_not_finite
    use gapbeam_words, only: shown
    use gapbeam_ledger, only: ledger_type, words_for
    use gapbeam_audit, only: audit_axial
    use gapbeam_axial_quad, only: solve_axial_finely => solve_axial
    use gapbeam_axial, only: solve_axial, axial_ok, axial_slides, axial_indeterminate
    use gapbeam_assembled_model, only: assembled_type, point_x, place_x
    use gapbeam_assemble_units, only: name_farthest
    use gapbeam_bedding_state, only: solve_bedding
    use gapbeam_axial_links, only: take_links
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: solve_along_axis, name_fault, name_range

contains

    !> Refuse a state that does not stand its audit, in the user's words
    subroutine name_fault(assembled, ledger, error)
        type(assembled_type), intent(in) :: assembled
        type(ledger_type), intent(in) :: ledger
        !> What is wrong, and where
        type(error_type), allocatable, intent(out) :: error

        if (ledger%wrong == 0) return
        call fatal_error(error, gapbeam_not_converged, "the result does not stand its own audit: at x = " &
                         //trim(shown(place_x(assembled, ledger%piece, ledger%distance))) &
                         //" "//trim(words_for(ledger%wrong))//", by "//trim(shown(real(nint(min(ledger%excess, 1e9_wp)), wp))) &
                         //" roundings or more; look for stiffnesses or lengths that lie far apart, and report the scene")
    end subroutine name_fault

    !> Name what is beyond the range of numbers in an error of the engine, and places in the user's units
    subroutine name_range(assembled, error)
        type(assembled_type), intent(in) :: assembled
        !> The engine's error, if there is one
        type(error_type), allocatable, intent(inout) :: error
        character(len=:), allocatable :: told
        integer :: at

        if (.not. allocated(error)) return
        if (error%code == gapbeam_not_finite) call name_farthest(assembled, error)
        if (error%distance < 0.0_wp .or. assembled%units%length == 0) return
        told = trim(shown(error%distance))
        at = index(error%message, told)
        error%message = error%message(:at - 1)//trim(shown(scale(error%distance, assembled%units%length))) &
            //error%message(at + len(told):)
        error%distance = -1.0_wp
    end subroutine name_range

    !> Solve the axial system, if there is one
    subroutine solve_along_axis(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        !> With its load factor in, displacements and forces along the axis out, or that the beam slides
        type(state_type), intent(inout) :: state
        !> Supports that hold a rigid stretch at both ends
        type(error_type), allocatable, intent(out) :: error
        type(ledger_type) :: ledger
        real(wp), allocatable :: longer(:), force(:)
        integer :: found, place

        ! Links that act one way, yield or rub, and ground are known on a path alone, but where bending feels them
        if (.not. allocated(assembled%axial%point)) return
        if (allocated(assembled%axial%bedding) .and. .not. assembled%depends_on_path) then
            call solve_bedding(assembled, state, error)
            return
        end if
        if (allocated(assembled%axial%laws) .and. assembled%model%axial_loads_bend) then
            call take_links(assembled, state, error)
            return
        end if
        if (allocated(assembled%axial%laws) .or. allocated(assembled%axial%limit)) return
        associate (axial => assembled%axial)
            allocate (longer(size(axial%flexibility)), source=0.0_wp)
            force = axial%force(1, :) + state%factor*axial%force(2, :)
            if (allocated(axial%elongation)) then
                ! What a stiff bar would push with if it were held is large beside what soft supports let it
                longer(:) = axial%elongation(1, :) + state%factor*axial%elongation(2, :)
                if (allocated(state%stretched)) longer(:) = longer - state%stretched
                call solve_finely(found, place)
            else
                call solve_axial(axial%flexibility, longer, force, axial%stiffness, axial%settlement, state%displacement, &
                                 state%tension, state%axial_reaction, found, place)
            end if
            state%slides = found == axial_slides
            if (found == axial_ok) then
                call check(error)
                if (allocated(error)) then
                    ! Beside what springs give, bars that are without force have rounding
                    call solve_finely(found, place)
                    call check(error)
                end if
            end if
            if (found /= axial_indeterminate) return
            associate (point => axial%point(place))
                call fatal_error(error, gapbeam_indeterminate, "the axial support at x = " &
                                 //trim(shown(point_x(assembled, point)))// &
                                 " and another one hold a stretch with infinite EA at both ends, so their forces cannot "// &
                                 "be told apart: give the beam a finite EA")
            end associate
        end associate

    contains

        !> Audit the solution
        subroutine check(error)
            type(error_type), allocatable, intent(out) :: error

            associate (axial => assembled%axial)
                call audit_axial(axial%flexibility, longer, force, axial%stiffness, axial%settlement, state%displacement, &
                                 state%tension, state%axial_reaction, ledger)
                ledger%piece = axial%point(ledger%piece) + 1
                call name_fault(assembled, ledger, error)
            end associate
        end subroutine check

        !> Solve in quadruple precision
        subroutine solve_finely(found, place)
            integer, intent(out) :: found, place
            real(qp) :: displacement(0:ubound(state%displacement, 1)), reaction(0:ubound(state%displacement, 1))
            real(qp) :: tension(size(state%tension))

            associate (axial => assembled%axial)
                call solve_axial_finely(real(axial%flexibility, qp), real(longer, qp), real(force, qp), real(axial%stiffness, qp), &
                                        real(axial%settlement, qp), displacement, tension, reaction, found, place)
            end associate
            state%displacement(:) = real(displacement, wp)
            state%tension(:) = real(tension, wp)
            state%axial_reaction(:) = real(reaction, wp)
        end subroutine solve_finely

    end subroutine solve_along_axis

end module gapbeam_along_axis
