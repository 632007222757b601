!> State of a beam on springs and sliders along it, and its audit; found from the loads alone where there is no path.
module gapbeam_bedding_state
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: bedding_audited
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_exponential_curve, only: curve_type, most_roots, value_of, derivative, roots_of
    use gapbeam_axial_bedding, only: bedding_type, loads_type, give_way, pulling, force_at, is_bedded, no_limit
    use gapbeam_bedding_zones, only: new_bedding, start_anew
    use gapbeam_bedding_loads, only: loads_at, follow_loads
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: put_bedding, solve_bedding, refuse_misfit

contains

    !> Put the dead loads on, then go to the load factor of a state
    subroutine solve_bedding(assembled, state, error)
        type(assembled_type), intent(in) :: assembled
        !> With its load factor in; what there is along the beam out, or that it slides
        type(state_type), intent(inout) :: state
        !> As from follow_loads, or it does not stand its audit
        type(error_type), allocatable, intent(out) :: error
        type(bedding_type) :: bedding
        type(loads_type) :: unloaded, dead, acting
        real(wp) :: reached

        associate (axial => assembled%axial)
            call new_bedding(axial%softness, axial%bedding, axial%limits, axial%stiffness, bedding)
        end associate
        unloaded = bedding%loads
        dead = loads_at(assembled, 1.0_wp, .true.)
        acting = loads_at(assembled, state%factor, .false.)
        call follow_loads(assembled, [0.0_wp, 1.0_wp], unloaded, dead, bedding, reached, error)
        if (allocated(error)) return
        state%slides = reached < 1.0_wp
        if (state%slides) return
        call start_anew(bedding)
        call follow_loads(assembled, [0.0_wp, state%factor], dead, acting, bedding, reached, error)
        if (allocated(error)) return
        state%slides = abs(reached) < abs(state%factor)
        if (.not. state%slides) call put_bedding(bedding, state, error)
    end subroutine solve_bedding

    !> Put what there is along the beam into a state
    subroutine put_bedding(bedding, state, error)
        type(bedding_type), intent(in) :: bedding
        !> Of the same beam
        type(state_type), intent(inout) :: state
        !> It does not stand its audit
        type(error_type), allocatable, intent(out) :: error
        real(qp) :: reaction(0:size(state%tension))

        state%displacement(:) = real(bedding%displacement, wp)
        state%tension(:) = least_forces(bedding)
        reaction(:) = reactions_of(bedding)
        state%axial_reaction(:) = merge(real(reaction, wp), 0.0_wp, bedding%support > 0.0_wp)
        if (.not. allocated(state%along_ground)) allocate (state%along_ground)
        state%along_ground%springs = bedding
        call refuse_misfit(misfit(bedding, reaction), bedding_audited, state%factor, error)
    end subroutine put_bedding

    !> Refuse a state that is off along the ground
    pure subroutine refuse_misfit(worst, audited, factor, error)
        !> By how much of its size, and how much may be rounding
        real(wp), intent(in) :: worst, audited
        real(wp), intent(in) :: factor
        type(error_type), allocatable, intent(out) :: error

        if (worst <= audited) return
        call fatal_error(error, gapbeam_not_converged, "the result does not stand its own audit: along the ground the beam "// &
                         "is off by "//trim(shown(worst))//" of its size at load factor "//trim(shown(factor))// &
                         "; report the scene")
    end subroutine refuse_misfit

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

end module gapbeam_bedding_state
