!> Axial forces of loads, temperatures and settlements along the beam, where bending feels them.
!>
!> The chain of bars and springs is solved for itself. Slopes are small, so bending does not change its forces, but where what
!> deflections lengthen it by pulls it (gapbeam_stretching). They grow straight with the load factor.
module gapbeam_axial_tension
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_units, only: rotation_unit
    use gapbeam_piece, only: is_tapered
    use gapbeam_axial_quad, only: solve_axial
    use gapbeam_axial, only: axial_ok
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_steps, only: decays_between
    use gapbeam_limits, only: most_decays_in_tension
    use gapbeam_input_error, only: refuse_range
    use gapbeam_assembled_model, only: assembled_type, from_to
    implicit none
    private
    public :: tensions_of_loads, changes_of_tension, check_tensions

contains

    !> Forces in the bars at load factor 0 and by how much they grow with it, in the engine's units of forces across the beam that
    !> slopes make of them
    pure function tensions_of_loads(assembled, stretched) result(tension)
        !> Whose bending feels axial loads
        type(assembled_type), intent(in) :: assembled
        !> By what deflections lengthen the bars (state_type)
        real(wp), intent(in), optional :: stretched(:)
        !> Of every piece, shape (2, npiece); 0 where nothing holds the beam along its axis
        real(wp) :: tension(2, size(assembled%pieces))
        real(qp) :: at(2, size(assembled%axial%flexibility))
        integer :: bar, case, piece

        at(:, :) = 0.0_qp
        do case = 1, 2
            call solve_chain(real(case - 1, qp), at(case, :))
        end do
        at(2, :) = at(2, :) - at(1, :)
        bar = 1
        do piece = 1, size(assembled%pieces)
            if (piece > assembled%axial%point(bar)) bar = bar + 1
            tension(:, piece) = scale(real(at(:, bar), wp), &
                                      assembled%axial%units%force + rotation_unit(assembled%units) - assembled%units%force)
        end do

    contains

        !> Forces at a load factor
        pure subroutine solve_chain(factor, tension)
            real(qp), intent(in) :: factor
            real(qp), intent(inout) :: tension(:)
            real(qp) :: longer(size(tension)), force(0:size(tension)), reaction(0:size(tension)), displacement(0:size(tension)), &
                        found_tension(size(tension))
            integer :: found, place

            associate (axial => assembled%axial)
                longer(:) = 0.0_qp
                if (allocated(axial%elongation)) longer(:) = axial%elongation(1, :) + factor*axial%elongation(2, :)
                if (present(stretched)) longer(:) = longer - stretched
                force(:) = axial%force(1, :) + factor*axial%force(2, :)
                call solve_axial(real(axial%flexibility, qp), longer, force, real(axial%stiffness, qp), &
                                 real(axial%settlement, qp), displacement, found_tension, reaction, found, place)
            end associate
            if (found == axial_ok) tension(:) = found_tension
        end subroutine solve_chain

    end function tensions_of_loads

    !> By how much these forces, which are those in the middles of pieces, change along each, at load factor 0 and with it
    pure function changes_of_tension(assembled) result(change)
        !> With loads distributed along it, so that every piece is a bar
        type(assembled_type), intent(in) :: assembled
        !> As tensions_of_loads
        real(wp) :: change(2, size(assembled%pieces))

        change(:, :) = scale(-assembled%axial%along_bar, &
                             assembled%axial%units%force + rotation_unit(assembled%units) - assembled%units%force)
    end function changes_of_tension

    !> Refuse axial forces that are out of range, so great a compression that the beam bends by shear alone, or a tension of a beam
    !> like a thread that changes along it or tapers, which series would cross in far too many steps
    pure subroutine check_tensions(assembled, ground, error)
        type(assembled_type), intent(in) :: assembled
        !> At the load factor at hand
        type(ground_type), intent(in) :: ground
        type(error_type), allocatable, intent(out) :: error
        integer :: piece
        real(wp) :: decays

        decays = 0.0_wp
        do piece = 1, size(ground%pieces)
            associate (p => ground%pieces(piece))
                if (.not. abs(p%tension) + abs(p%tension_change) <= huge(1.0_wp)) then
                    call refuse_range(error, "the axial force "//trim(from_to(assembled, piece - 1, piece))//" is too far from "// &
                                      "the stiffnesses of the beam", "bring them nearer together")
                else if (.not. 1 + p%tension*p%shear_flexibility > 0.0_wp) then
                    call refuse_range(error, "the compression "//trim(from_to(assembled, piece - 1, piece))//" is not below GA "// &
                                      "there, so the beam gives way by shear alone", "give smaller axial loads, or leave GA out")
                end if
                if ((abs(p%tension_change) > 0.0_wp .or. is_tapered(p)) .and. p%tension > 0.0_wp) then
                    decays = decays + decays_between(p, 0.0_wp, p%length, 0.0_wp)
                end if
            end associate
            if (allocated(error)) return
        end do
        if (decays > most_decays_in_tension) then
            call fatal_error(error, gapbeam_bad_input, "where the beam tapers, or loads along it change its tension, it is "// &
                             trim(shown(decays))//" sqrt(EI/N) long, more than "//trim(shown(most_decays_in_tension))// &
                             ": it is next to a thread; give a greater EI, or sections of one EI and N, each with its mean")
        end if
    end subroutine check_tensions

end module gapbeam_axial_tension
