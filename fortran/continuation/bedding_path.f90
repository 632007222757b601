!> The way of a beam over springs and sliders along it while the load goes on, from one turn of the load to the next.
!> Bending does not feel it; its path tells which way the load goes.
module gapbeam_bedding_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_path_tolerances, only: before_all_slides
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_bedding, only: bedding_type, loads_type, no_limit
    use gapbeam_bedding_zones, only: new_bedding, start_anew, find_zones, turns_back
    use gapbeam_ground_along_path, only: end_path
    use gapbeam_history_record, only: history_type, along_type, on_ground_type
    implicit none
    private
    public :: follow_bedding, loads_at, go_to_loads

    !> Load factors between two turns at which it is looked whether all that slides goes on
    integer, parameter :: looks = 16

contains

    !> Let the beam slide over springs and sliders along it as the load of a path of bending goes
    subroutine follow_bedding(assembled, history, error)
        !> With such ground
        type(assembled_type), intent(in) :: assembled
        !> That of bending in; what there is along the beam where the load turns, or where it slides without end, out
        type(history_type), intent(inout) :: history
        !> Ground that slid begins to hold before the load turns
        type(error_type), allocatable, intent(out) :: error
        type(bedding_type) :: bedding
        real(wp) :: at
        integer :: first, last
        logical :: lost

        associate (axial => assembled%axial)
            call new_bedding(axial%softness, axial%bedding, axial%limits, axial%stiffness, bedding)
        end associate
        allocate (history%along)
        allocate (history%along%on_ground(8))
        last = 0
        do
            call next_run(history, last, first)
            if (first == 0) exit
            call keep(history%along, first, history%stretches(first)%from, bedding)
            call pass(assembled, history, first, last, bedding, at, lost, error)
            if (allocated(error)) return
            if (lost) then
                call end_path(history, stretch_at(history, first, last, at), at)
                return
            end if
            call start_anew(bedding)
        end do
    end subroutine follow_bedding

    !> Keep how the beam is where the load turns
    pure subroutine keep(along, k, at, bedding)
        type(along_type), intent(inout) :: along
        !> The stretch after it, and the load factor
        integer, intent(in) :: k
        real(wp), intent(in) :: at
        type(bedding_type), intent(in) :: bedding
        type(on_ground_type), allocatable :: longer(:)

        if (along%number == size(along%on_ground)) then
            allocate (longer(2*along%number))
            longer(:along%number) = along%on_ground
            call move_alloc(longer, along%on_ground)
        end if
        along%number = along%number + 1
        along%on_ground(along%number)%stretch = k
        along%on_ground(along%number)%factor = at
        along%on_ground(along%number)%ground%springs = bedding
    end subroutine keep

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

    !> Go along such stretches
    subroutine pass(assembled, history, first, last, bedding, at, lost, error)
        type(assembled_type), intent(in) :: assembled
        type(history_type), intent(in) :: history
        integer, intent(in) :: first, last
        !> Where the load turned in, where it turns next out
        type(bedding_type), intent(inout) :: bedding
        !> Load factor where all of it slides, and whether it does
        real(wp), intent(out) :: at
        logical, intent(out) :: lost
        type(error_type), allocatable, intent(out) :: error
        type(loads_type) :: from, to
        real(qp) :: share
        integer :: i
        logical :: settled

        associate (a => history%stretches(first)%from, b => history%stretches(last)%to, is_dead => &
                   history%stretches(first)%leg == 0)
            from = loads_at(assembled, a, is_dead)
            to = loads_at(assembled, b, is_dead)
            share = all_slides(bedding, from, to)
            lost = share <= 1.0_qp
            at = b
            if (lost) at = factor_of(looks)
            do i = 1, looks
                call end_if_stopped(assembled%beam%watch, error)
                if (allocated(error)) return
                call go_to_loads(bedding, from, to, share_of(i), settled)
                if (.not. settled) then
                    call fatal_error(error, gapbeam_not_converged, "along the beam no state is found near load factor "// &
                                     trim(shown(factor_of(i)))//", where rounding hides what slides over the ground: bring the "// &
                                     "magnitudes of the beam nearer to each other")
                    return
                end if
                if (.not. turns_back(bedding, less(to, from))) cycle
                call fatal_error(error, gapbeam_not_converged, "along the beam ground that slides begins to hold again before "// &
                                 "load factor "//trim(shown(factor_of(i)))//", while the load goes on, which is not "// &
                                 "available in this version where that ground has a stiffness: leave the stiffness out, or put "// &
                                 "the loads on one after the other, in a history")
                return
            end do
        end associate

    contains

        !> How far the load is gone at a look
        pure function share_of(i) result(gone)
            integer, intent(in) :: i
            real(qp) :: gone

            gone = min(share, 1.0_qp)*i/looks
        end function share_of

        !> The load factor there
        pure function factor_of(i) result(factor)
            integer, intent(in) :: i
            real(wp) :: factor

            associate (a => real(history%stretches(first)%from, qp), b => history%stretches(last)%to)
                factor = real(a + share_of(i)*(b - a), wp)
            end associate
        end function factor_of

    end subroutine pass

    !> Find the state at a share of the way between loads
    pure subroutine go_to_loads(bedding, from, to, share, settled)
        !> As where the load turned last, or on the way
        type(bedding_type), intent(inout) :: bedding
        type(loads_type), intent(in) :: from, to
        real(qp), intent(in) :: share
        logical, intent(out) :: settled
        type(loads_type) :: loads
        real(qp) :: gone

        gone = min(share, all_slides(bedding, from, to)*(1 - before_all_slides))
        loads = from
        loads%node(:) = loads%node + gone*(to%node - from%node)
        loads%along(:) = loads%along + gone*(to%along - from%along)
        loads%longer(:) = loads%longer + gone*(to%longer - from%longer)
        call find_zones(bedding, loads, settled)
    end subroutine go_to_loads

    !> At which share of the way between loads all of a beam slides that no support holds: they are all that its ground takes
    pure function all_slides(bedding, from, to) result(share)
        type(bedding_type), intent(in) :: bedding
        type(loads_type), intent(in) :: from, to
        real(qp) :: share
        real(qp) :: most, before, after

        share = huge(share)
        if (any(bedding%support > 0.0_wp) .or. any(bedding%limit >= no_limit)) return
        most = sum(bedding%limit)/2
        before = sum(from%node) + sum(from%along)
        after = sum(to%node) + sum(to%along)
        if (abs(after) < most .or. .not. abs(after - before) > 0.0_qp) return
        share = (sign(most, after) - before)/(after - before)
    end function all_slides

    !> Difference of loads
    pure function less(a, b) result(loads)
        type(loads_type), intent(in) :: a, b
        type(loads_type) :: loads

        loads = a
        loads%node(:) = a%node - b%node
        loads%along(:) = a%along - b%along
        loads%longer(:) = a%longer - b%longer
    end function less

    !> Loads along a beam at a load factor
    pure function loads_at(assembled, factor, is_dead) result(loads)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: factor
        !> Does it put on the dead loads
        logical, intent(in) :: is_dead
        type(loads_type) :: loads
        real(qp) :: by_case(2)
        integer :: n

        by_case(:) = merge([real(factor, qp), 0.0_qp], [1.0_qp, real(factor, qp)], is_dead)
        associate (axial => assembled%axial)
            n = size(axial%softness)
            allocate (loads%node(0:n), loads%along(n), loads%longer(n))
            loads%node(:) = matmul(by_case, real(axial%force, qp))
            loads%along(:) = 0.0_qp
            loads%longer(:) = 0.0_qp
            if (allocated(axial%elongation)) loads%longer(:) = matmul(by_case, real(axial%elongation, qp))
            if (.not. allocated(axial%along_bar)) return
            loads%along(:) = matmul(by_case, real(axial%along_bar, qp))
            ! Of these the nodes have half at either end
            loads%node(:n - 1) = loads%node(:n - 1) - loads%along/2
            loads%node(1:) = loads%node(1:) - loads%along/2
        end associate
    end function loads_at

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

end module gapbeam_bedding_path
