!> Changes between two states of a train, as the engine looks for them.
module gapbeam_train_changes
    use gapbeam_kinds, only: wp
    use gapbeam_laws, only: is_smooth
    use gapbeam_zone_margin, only: change_type
    use gapbeam_smooth_laws, only: past_curve, reaction_at
    use gapbeam_solution, only: way_to_contact
    use gapbeam_ground_changes, only: zone_change_type, compare_zones, looked_for
    use gapbeam_train_states, only: kept_type
    implicit none
    private
    public :: list_changes_between, measure_support

contains

    !> Supports that change, and zones
    subroutine list_changes_between(one, other, changes)
        !> Solved ones
        type(kept_type), intent(in) :: one, other
        type(change_type), allocatable, intent(out) :: changes(:)
        type(zone_change_type), allocatable :: of_zones(:)
        integer :: k, number, s

        allocate (changes(0))
        do k = 1, size(one%state%closed)
            s = one%placed%normal(k)
            if (.not. (one%decided(s) .and. other%decided(s))) cycle
            if (is_smooth(one%placed%model%supports(s)%law)) then
                if (k > 1) then
                    if (one%placed%normal(max(k - 1, 1)) == s) cycle
                end if
                if (one%acting(s)%condition == other%acting(s)%condition) cycle
            else if (one%state%closed(k) .eqv. other%state%closed(k)) then
                cycle
            end if
            changes = [changes, change_type(support=k, closed=one%state%closed(k))]
        end do
        if (.not. allocated(one%zones)) return
        call compare_zones(one%zones, other%zones, of_zones, number)
        changes = [changes, looked_for(of_zones(:number), one%placed%units%length)]
    end subroutine list_changes_between

    !> How far a support is past where it begins to act: of one that acts by its force, or on its curve
    subroutine measure_support(kept, number, margin, known)
        type(kept_type), intent(in) :: kept
        !> Of the engine
        integer, intent(in) :: number
        real(wp), intent(out) :: margin
        logical, intent(out) :: known
        integer :: way

        margin = 0.0_wp
        associate (s => kept%placed%normal(number), placed => kept%placed)
            associate (support => placed%model%supports(s))
                known = .true.
                if (is_smooth(support%law)) then
                    call past_curve(placed, s, kept%state%deflection, kept%state%reaction, margin, way)
                else if (placed%with_law(s)) then
                    known = .false.
                else if (kept%state%closed(number)) then
                    margin = support%side*reaction_at(placed, kept%state%reaction, s)
                else
                    margin = -scale(way_to_contact(placed, kept%state, s), placed%units%deflection)
                end if
            end associate
        end associate
    end subroutine measure_support

end module gapbeam_train_changes
