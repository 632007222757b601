!> The way of a beam over springs and sliders along it while the load goes on, from one turn of the load to the next.
!> Bending does not feel it; its path tells which way the load goes.
module gapbeam_bedding_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_bedding, only: bedding_type
    use gapbeam_bedding_zones, only: new_bedding, start_anew
    use gapbeam_bedding_loads, only: loads_at, go_to_loads, follow_loads
    use gapbeam_bedding_state, only: put_bedding
    use gapbeam_ground_along, only: ground_along_type
    use gapbeam_ground_along_path, only: keep, end_path
    use gapbeam_history_record, only: history_type
    use gapbeam_solution, only: state_type
    implicit none
    private
    public :: follow_bedding, take_bedding

contains

    !> Let the beam slide over springs and sliders along it as the load of a path of bending goes
    subroutine follow_bedding(assembled, history, error)
        !> With such ground
        type(assembled_type), intent(in) :: assembled
        !> That of bending in; what there is along the beam where the load turns, or where it slides without end, out
        type(history_type), intent(inout) :: history
        !> Ground that slid begins to hold before the load turns
        type(error_type), allocatable, intent(out) :: error
        type(ground_along_type) :: ground
        real(wp) :: at
        integer :: first, last
        logical :: lost

        associate (axial => assembled%axial)
            allocate (ground%springs)
            call new_bedding(axial%softness, axial%bedding, axial%limits, axial%stiffness, ground%springs)
        end associate
        allocate (history%along)
        allocate (history%along%on_ground(8))
        last = 0
        do
            call next_run(history, last, first)
            if (first == 0) exit
            call keep(history%along, first, history%stretches(first)%from, ground)
            associate (a => history%stretches(first)%from, b => history%stretches(last)%to, is_dead => &
                       history%stretches(first)%leg == 0)
                call follow_loads(assembled, [a, b], loads_at(assembled, a, is_dead), loads_at(assembled, b, is_dead), &
                                  ground%springs, at, error)
                lost = abs(at - a) < abs(b - a)
            end associate
            if (allocated(error)) return
            if (lost) then
                call end_path(history, stretch_at(history, first, last, at), at)
                return
            end if
            call start_anew(ground%springs)
        end do
    end subroutine follow_bedding

    !> The next stretches over which the load goes one way in one leg; those that are passed in a jump do not count
    pure subroutine next_run(history, last, first)
        type(history_type), intent(in) :: history
        !> The last one of the run before in, of this one out
        integer, intent(inout) :: last
        !> 0: there is none
        integer, intent(out) :: first
        integer :: k

        first = 0
        do k = last + 1, history%number
            associate (s => history%stretches(k))
                if (s%skipped .or. .not. abs(s%to - s%from) > 0.0_wp) cycle
                if (first == 0) first = k
                associate (f => history%stretches(first))
                    if (s%leg /= f%leg .or. (s%to > s%from .neqv. f%to > f%from)) return
                end associate
                last = k
            end associate
        end do
    end subroutine next_run

    !> On which of the stretches of a run a load factor is
    pure function stretch_at(history, first, last, factor) result(k)
        type(history_type), intent(in) :: history
        integer, intent(in) :: first, last
        real(wp), intent(in) :: factor
        integer :: k

        do k = first, last - 1
            associate (s => history%stretches(k))
                if (.not. s%skipped .and. (s%to - factor)*sign(1.0_wp, s%to - s%from) >= 0.0_wp) return
            end associate
        end do
        k = last
    end function stretch_at

    !> What there is along the beam at a load factor on a stretch
    subroutine take_bedding(beam, history, stretch, factor, state, error)
        !> With the loads of the leg: its dead ones as live ones while these are put on
        type(assembled_type), intent(in) :: beam
        type(history_type), intent(in) :: history
        integer, intent(in) :: stretch
        real(wp), intent(in) :: factor
        !> Of the same beam, at that load factor
        type(state_type), intent(inout) :: state
        !> It does not stand its audit
        type(error_type), allocatable, intent(out) :: error
        type(bedding_type) :: bedding
        logical :: settled
        integer :: k

        k = findloc(history%along%on_ground(:history%along%number)%stretch <= stretch, .true., 1, back=.true.)
        ! Where all of the way is passed in a jump there is none
        settled = k > 0
        if (settled) then
            bedding = history%along%on_ground(k)%ground%springs
            call go_to_loads(bedding, bedding%loads, loads_at(beam, factor, .false.), 1.0_qp, settled)
        end if
        if (settled) then
            call put_bedding(bedding, state, error)
        else
            call fatal_error(error, gapbeam_not_converged, "along the beam no state is found at load factor "// &
                             trim(shown(factor))//"; report the scene")
        end if
    end subroutine take_bedding

end module gapbeam_bedding_path
