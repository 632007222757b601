!> States of a beam on springs and sliders along it at load factors on a path, and their audit.
module gapbeam_bedding_states
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: bedding_audited
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_exponential_curve, only: curve_type, most_roots, value_of, derivative, roots_of
    use gapbeam_axial_bedding, only: bedding_type, loads_type, give_way, pulling, force_at, is_bedded, no_limit
    use gapbeam_bedding_path, only: loads_at, go_to_loads
    use gapbeam_history_record, only: history_type
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: take_bedding

contains

    !> What there is along the beam at a load factor on a stretch
    subroutine take_bedding(beam, history, stretch, factor, state, error)
        !> With the loads of the leg: its dead ones as live ones while these are put on
        type(assembled_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        integer, intent(in) :: stretch
        real(wp), intent(in) :: factor
        !> Of the same beam
        type(state_type), intent(inout) :: state
        !> It does not stand its audit
        type(error_type), allocatable, intent(out) :: error
        type(bedding_type) :: bedding
        type(loads_type) :: loads
        real(wp) :: worst
        real(qp) :: reaction(0:size(state%tension))
        logical :: settled
        integer :: k

        k = findloc(history%along%on_ground(:history%along%number)%stretch <= stretch, .true., 1, back=.true.)
        loads = loads_at(beam, factor, .false.)
        if (k == 0) then
            ! All of the way is passed in a jump
            settled = .false.
        else
            bedding = history%along%on_ground(k)%ground%springs
            call go_to_loads(bedding, bedding%loads, loads, 1.0_qp, settled)
        end if
        if (settled) then
            state%displacement(:) = real(bedding%displacement, wp)
            state%tension(:) = least_forces(bedding)
            reaction(:) = reactions_of(bedding)
            state%axial_reaction(:) = merge(real(reaction, wp), 0.0_wp, bedding%support > 0.0_wp)
            if (.not. allocated(state%along_ground)) allocate (state%along_ground)
            state%along_ground%springs = bedding
            worst = misfit(bedding, reaction)
            if (worst <= bedding_audited) return
            call fatal_error(error, gapbeam_not_converged, "the result does not stand its own audit: along the ground the beam "// &
                             "is off by "//trim(shown(worst))//" of its size at load factor "//trim(shown(factor))// &
                             "; report the scene")
        else
            call fatal_error(error, gapbeam_not_converged, "along the beam no state is found at load factor "// &
                             trim(shown(factor))//"; report the scene")
        end if
    end subroutine take_bedding

    !> Smallest axial force of every bar
    pure function least_forces(bedding) result(least)
        type(bedding_type), intent(in) :: bedding
        real(wp) :: least(size(bedding%softness))
        type(curve_type) :: force
        real(qp) :: roots(most_roots)
        integer :: i, k, n

        least(:) = huge(1.0_wp)
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k))
                force = pulling(bedding, cell)
                call roots_of(derivative(force), roots, n)
                least(cell%bar) = min(least(cell%bar), real(value_of(force, cell%from), wp), real(value_of(force, cell%to), wp), &
                                      minval([(real(value_of(force, roots(i)), wp), i=1, n)]))
            end associate
        end do
    end function least_forces

    !> What nodes lack to be in equilibrium: forces of supports on the beam, to the right
    pure function reactions_of(bedding) result(reaction)
        type(bedding_type), intent(in) :: bedding
        real(qp) :: reaction(0:size(bedding%softness))
        integer :: k

        reaction(:) = -bedding%loads%node
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k))
                if (.not. cell%from > 0.0_qp) reaction(cell%bar - 1) = reaction(cell%bar - 1) - force_at(bedding, cell, cell%from)
                if (.not. cell%to < 1.0_qp) reaction(cell%bar) = reaction(cell%bar) + force_at(bedding, cell, cell%to)
            end associate
        end do
    end function reactions_of

    !> What is off, relative to the largest: reactions beside displacements, what meets between parts, the equation of a part in its
    !> middle, and pushes on the ground beside its limits
    pure function misfit(bedding, reaction) result(worst)
        type(bedding_type), intent(in) :: bedding
        real(qp), intent(in) :: reaction(0:)
        real(wp) :: worst
        real(qp) :: most, way, off, middle, limit, push
        type(curve_type) :: force
        integer :: k

        ! What is longer without force would make one if it were held
        most = max(maxval(abs(reaction)), maxval(abs(bedding%loads%node)), maxval(abs(bedding%loads%longer)/bedding%softness), &
                   maxval(abs(bedding%loads%along)), tiny(most))
        way = maxval(abs(bedding%displacement))
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k))
                most = max(most, abs(force_at(bedding, cell, cell%from)), abs(force_at(bedding, cell, cell%to)))
            end associate
        end do
        off = 0.0_qp
        do k = 0, size(bedding%softness)
            if (bedding%support(k) > huge(1.0_wp)) then
                off = max(off, abs(bedding%displacement(k))/max(way, tiny(way)))
            else
                off = max(off, abs(reaction(k) + bedding%support(k)*bedding%displacement(k))/most)
            end if
        end do
        do k = 1, size(bedding%cells)
            associate (cell => bedding%cells(k), next => bedding%cells(min(k + 1, size(bedding%cells))))
                if (next%bar == cell%bar .and. k < size(bedding%cells)) then
                    off = max(off, abs(force_at(bedding, cell, cell%to) - force_at(bedding, next, cell%to))/most)
                    off = max(off, abs(value_of(cell%displacement, cell%to) - value_of(next%displacement, cell%to))/max(way, &
                                                                                                                tiny(way)))
                end if
                middle = (cell%from + cell%to)/2
                force = pulling(bedding, cell)
                push = 0.0_qp
                if (is_bedded(bedding, cell%bar)) then
                    push = value_of(give_way(bedding, cell), middle)
                    limit = bedding%limit(1, cell%bar) + middle*(bedding%limit(2, cell%bar) - bedding%limit(1, cell%bar))
                    if (cell%way == 0) then
                        if (limit < no_limit) off = max(off, (abs(push) - limit)*(cell%to - cell%from)/most)
                    else
                        off = max(off, (limit - cell%way*push)*(cell%to - cell%from)/most)
                        push = cell%way*limit
                    end if
                end if
                off = max(off, abs(value_of(derivative(force), middle) - push + bedding%loads%along(cell%bar)) &
                          *(cell%to - cell%from)/most)
            end associate
        end do
        worst = real(off, wp)
    end function misfit

end module gapbeam_bedding_states
