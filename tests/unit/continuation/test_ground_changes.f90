!> Zones of contact that change from one load factor to another, and those that only move
program test_ground_changes
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_scene, only: gapbeam_below
    use gapbeam_pieces, only: gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits, gapbeam_reaches
    use gapbeam_ground_changes, only: zone_type, zone_change_type, compare_zones
    implicit none
    integer :: status

    call zones_that_move()
    call zones_that_change()
    call where_they_are_looked_for()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Zones between pairs of places on a beam from 0 to 10
    pure function zones(ends) result(made)
        real(wp), intent(in) :: ends(:)
        type(zone_type) :: made(size(ends)/2)
        integer :: i

        do i = 1, size(made)
            associate (from => ends(2*i - 1), to => ends(2*i))
                made(i) = zone_type(1, gapbeam_below, 1, from, to, .not. from > 0.0_wp, .not. to < 10.0_wp)
            end associate
        end do
    end function zones

    !> The changes from zones to others
    subroutine compare(before, after, changes, number)
        real(wp), intent(in) :: before(:), after(:)
        type(zone_change_type), allocatable, intent(out) :: changes(:)
        integer, intent(out) :: number

        call compare_zones(zones(before), zones(after), changes, number)
    end subroutine compare

    !> A zone that is nowhere where it was is the same one, if nothing is between
    subroutine zones_that_move()
        type(zone_change_type), allocatable :: changes(:)
        integer :: number

        call compare([1.0_wp, 2.0_wp], [2.5_wp, 3.5_wp], changes, number)
        call check(number == 0, "a zone that moves")
        call compare([1.0_wp, 2.0_wp, 5.0_wp, 6.0_wp, 8.0_wp, 9.0_wp], [2.5_wp, 3.5_wp, 5.5_wp, 6.5_wp], changes, number)
        call check(number == 1 .and. changes(1)%change == gapbeam_vanishes, "one moves, another one vanishes")
        call check_close(changes(1)%x, 8.5_wp, "in its middle", 0.0_wp)
        call compare([1.0_wp, 2.0_wp, 4.0_wp, 5.0_wp], [4.0_wp, 5.0_wp, 8.0_wp, 9.0_wp], changes, number)
        call check(number == 2 .and. changes(1)%change == gapbeam_appears .and. changes(2)%change == gapbeam_vanishes, &
                   "not over another one")
        call compare([8.0_wp, 9.0_wp], [9.5_wp, 10.0_wp], changes, number)
        call check(number == 1 .and. changes(1)%change == gapbeam_reaches, "one that moves to the end of the beam")
    end subroutine zones_that_move

    !> They merge and split
    subroutine zones_that_change()
        type(zone_change_type), allocatable :: changes(:)
        integer :: number

        call compare([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], [1.0_wp, 4.0_wp], changes, number)
        call check(number == 1 .and. changes(1)%change == gapbeam_merges, "two merge")
        call check_close(changes(1)%x, 2.5_wp, "between the two", 0.0_wp)
        call compare([1.0_wp, 4.0_wp], [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], changes, number)
        call check(number == 1 .and. changes(1)%change == gapbeam_splits, "one splits")
    end subroutine zones_that_change

    !> Around them, as they may have moved, but not where others are
    subroutine where_they_are_looked_for()
        type(zone_change_type), allocatable :: changes(:)
        integer :: number

        call compare([1.0_wp, 2.0_wp, 8.0_wp, 9.0_wp], [1.0_wp, 3.0_wp, 4.0_wp, 4.25_wp, 8.0_wp, 9.0_wp], changes, number)
        call check(number == 1 .and. changes(1)%change == gapbeam_appears, "one appears")
        call check_close([changes(1)%x, changes(1)%from, changes(1)%to], [4.125_wp, 3.5_wp, 6.125_wp], "looked for around it", &
                         1e-15_wp)
        call compare([real(wp) ::], [4.0_wp, 4.125_wp], changes, number)
        call check_close([changes(1)%from, changes(1)%to], [2.0_wp, 6.125_wp], "as far as it may have moved", 1e-15_wp)
    end subroutine where_they_are_looked_for

end program test_ground_changes
