!> Supports that are neither surely closed nor surely open.
!>
!> What is zero in quadruple precision, but for what the last digits of the data move (gapbeam_sensitivity), is a tie: either
!> state is right then, and the support is named.
module gapbeam_undecided
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: most_examined
    use gapbeam_tolerances, only: sign_width, fine_width, movement_safety
    use gapbeam_model_quad, only: beam_type, softest
    use gapbeam_workspace_quad, only: workspace_type
    use gapbeam_law_margins_quad, only: is_watched_in, find_margins
    use gapbeam_sensitivity_quad, only: sensitivity_type, prepare_sensitivity, way_of_forces, movement_of_support
    implicit none
    private
    public :: find_undecided, come_to_rest

contains

    !> Supports whose reaction or opening is smaller than what it moves when the data change in their last digits. A reaction that
    !> is nothing but rounding is none
    subroutine find_undecided(fine, factor, closed, work, undecided)
        type(beam_type), intent(in) :: fine
        real(qp), intent(in) :: factor
        logical, intent(in) :: closed(:)
        type(workspace_type), intent(inout) :: work
        logical, intent(out) :: undecided(:)
        type(sensitivity_type) :: sensitivity
        real(qp), allocatable :: margin(:), rounding(:), wide(:)
        real(qp) :: movement, force, way
        integer :: k

        allocate (margin(size(closed)), rounding(size(closed)), wide(size(closed)))
        call find_margins(fine%supports, closed, work%answers, work%deflection_size, work%reaction, work%reaction_error, &
                          margin, rounding)
        ! Rounding of the loads alone moves the beam so far: what has no flexibility shows nothing of it
        force = epsilon(1.0_qp)*maxval(work%shear_size(:size(fine%links)))
        call compare(force/softest(fine))
        if (.not. any(undecided)) return
        call prepare_sensitivity(fine, factor, work, sensitivity)
        if (.not. sensitivity%known) return
        if (any(undecided .and. .not. closed)) then
            ! A spring far softer than the others need not be what holds the beam
            call way_of_forces(fine, sensitivity, force, work, way)
            call compare(min(force/softest(fine), movement_safety*way))
        end if
        if (count(undecided) > most_examined) return
        do k = 1, size(closed)
            if (.not. undecided(k)) cycle
            call movement_of_support(fine, sensitivity, closed, k, work, movement)
            undecided(k) = abs(margin(k)) <= max(movement, fine_width*wide(k))
        end do

    contains

        !> Whose margins are rounding
        subroutine compare(least_way)
            !> How far rounding of the loads moves the beam
            real(qp), intent(in) :: least_way
            real(qp) :: least_force, turns, steepest

            wide(:) = rounding
            steepest = maxval(fine%links%inverse)
            do k = 1, size(closed)
                undecided(k) = .false.
                if (.not. is_watched_in(fine%supports, closed, k)) cycle
                if (.not. closed(k) .and. fine%supports(k)%breakpoint == 0) then
                    turns = merge(steepest, 1.0_qp, fine%supports(k)%node > size(fine%links))
                    wide(k) = max(wide(k), turns*least_way/fine_width)
                end if
                ! What is held stiffly beside a soft spring may move it by rounding
                least_force = epsilon(1.0_qp)*work%shear_size(fine%supports(k)%node)
                if (closed(k)) wide(k) = max(wide(k), least_force)
                undecided(k) = abs(margin(k)) <= sign_width*wide(k)*(epsilon(1.0_wp)/epsilon(1.0_qp))
                ! At a breakpoint of a law the margin may be zero, and the reaction is not
                if (closed(k) .and. abs(work%reaction(k)) <= fine_width*max(work%reaction_error(k), least_force)) then
                    work%reaction(k) = 0.0_qp
                end if
            end do
        end subroutine compare

    end subroutine find_undecided

    !> A rigid beam without loads on which nothing pushes has no forces: what is left is rounding of what springs, those too that
    !> hold it in its search, make of the levels at which supports begin to act
    pure subroutine come_to_rest(fine, work, rests)
        type(beam_type), intent(in) :: fine
        type(workspace_type), intent(inout) :: work
        !> Is it such a beam
        logical, intent(out) :: rests
        real(qp) :: stiffest, farthest

        rests = .false.
        if (allocated(fine%turning) .or. any(fine%links%faa > 0.0_qp)) return
        if (any(work%load_size > 0.0_qp) .or. any(work%turn_size > 0.0_qp)) return
        associate (stiffness => fine%supports%stiffness, levels => abs(fine%supports%contact))
            stiffest = max(softest(fine), maxval(stiffness, stiffness <= huge(stiffness)))
            farthest = max(0.0_qp, maxval(levels, levels <= huge(levels)))
        end associate
        if (any(abs(work%reaction) > fine_width*epsilon(1.0_qp)*stiffest*farthest)) return
        work%reaction(:) = 0.0_qp
        work%shear(:) = 0.0_qp
        work%answers%moment_left = 0.0_qp
        work%answers%moment_right = 0.0_qp
        rests = .true.
    end subroutine come_to_rest

end module gapbeam_undecided
