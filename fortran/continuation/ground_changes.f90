!> Zones of contact at one load factor matched with those at another.
module gapbeam_ground_changes
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: gapbeam_both, gapbeam_below, gapbeam_above
    use gapbeam_zone_margin, only: change_type
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_ground_runs, only: run_type, ground_runs
    use gapbeam_pieces, only: gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits, gapbeam_reaches, gapbeam_leaves
    implicit none
    private
    public :: zone_type, zone_change_type, find_zones, same_zones, compare_zones, looked_for

    !> Zones of a smaller share of the beam only touch: rounding of the load factor makes them and takes them away
    real(wp), parameter :: min_zone_length = 2.0_wp**(-46)
    !> So many times its length a zone, or what is between two, may have moved since it came about, at most half of the way to the
    !> next ones
    real(wp), parameter :: farthest_move = 16.0_wp

    !> A zone in which a layer of one-sided ground acts at least on some branch of its law; 1 is the zone of contact
    type :: zone_type
        !> Number of the foundation in the model; gapbeam_below or gapbeam_above
        integer :: foundation, side
        integer :: branch
        !> Its ends, from the left end of the beam, and whether these are ends of the foundation or of the beam
        real(wp) :: from, to
        logical :: at_left, at_right
    end type zone_type

    !> A change of the zones
    type :: zone_change_type
        integer :: foundation, side, branch
        !> gapbeam_appears, gapbeam_vanishes, gapbeam_merges, gapbeam_splits; of an end gapbeam_reaches, gapbeam_leaves
        integer :: change
        !> Its place, and between which places it is to be looked for, as it may move on the way
        real(wp) :: x, from, to
    end type zone_change_type

contains

    !> The zones of all branches
    subroutine find_zones(assembled, solution, zones, error)
        !> The beam, and its solution on the ground
        type(assembled_type), intent(in) :: assembled
        type(ground_solution_type), intent(in) :: solution
        !> By foundation, below before above, by branch, from left to right
        type(zone_type), allocatable, intent(out) :: zones(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(run_type), allocatable :: runs(:)
        type(zone_type), allocatable :: found(:)
        logical, allocatable :: holds_both_ways(:)
        integer :: first, last, branch, most, number, stat

        call ground_runs(assembled, solution, runs, error, only_acts=.true.)
        if (allocated(error)) return
        call join_thin(min_zone_length*point_x(assembled, size(assembled%pieces)), runs)
        holds_both_ways = find_two_sided(assembled)
        most = 0
        if (size(runs) > 0) most = sum(max(runs%acts, 0))
        allocate (found(most), stat=stat)
        if (failed(stat, error)) return
        number = 0
        last = 0
        do while (last < size(runs))
            first = last + 1
            last = first
            do while (last < size(runs))
                if (.not. same_layer(runs(first), runs(last + 1))) exit
                last = last + 1
            end do
            if (runs(first)%side == gapbeam_both) cycle
            ! Ground that holds both ways from the beginning only changes its direction where the deflection is zero
            do branch = merge(2, 1, holds_both_ways(runs(first)%foundation)), maxval(runs(first:last)%acts)
                call add_zones(runs(first:last), branch, found, number)
            end do
        end do
        allocate (zones(number), source=found(:number), stat=stat)
        if (failed(stat, error)) return
    end subroutine find_zones

    !> Join runs of next to no length to their neighbours, as if what is before went on; places that only touch are none
    pure subroutine join_thin(thin, runs)
        !> Length of what only touches
        real(wp), intent(in) :: thin
        type(run_type), allocatable, intent(inout) :: runs(:)
        type(run_type), allocatable :: joined(:)
        type(run_type) :: run
        integer :: i, n

        allocate (joined(size(runs)))
        n = 0
        do i = 1, size(runs)
            run = runs(i)
            if (run%touches .and. run%acts == 0) cycle
            if (n > 0) then
                associate (before => joined(n))
                    if (same_layer(before, run) .and. .not. run%from > before%to) then
                        if (run%to - run%from <= thin) then
                            before%to = run%to
                            cycle
                        else if (before%to - before%from <= thin) then
                            run%from = before%from
                            before = run
                            cycle
                        end if
                    end if
                end associate
            end if
            n = n + 1
            joined(n) = run
        end do
        deallocate (runs)
        allocate (runs(n), source=joined(:n))
    end subroutine join_thin

    !> Are two runs of one layer
    elemental function same_layer(run, other) result(same)
        type(run_type), intent(in) :: run, other
        logical :: same

        same = run%foundation == other%foundation .and. run%side == other%side
    end function same_layer

    !> Which foundations hold both ways without a gap, by a law
    pure function find_two_sided(assembled) result(two_sided)
        type(assembled_type), intent(in) :: assembled
        !> Shape (number of foundations)
        logical, allocatable :: two_sided(:)
        logical, allocatable :: below(:), above(:), with_gap(:)
        integer :: k

        associate (n => size(assembled%model%foundations))
            allocate (two_sided(n), below(n), above(n), with_gap(n))
        end associate
        below(:) = .false.
        above(:) = .false.
        with_gap(:) = .false.
        do k = 1, size(assembled%layers)
            associate (layer => assembled%layers(k), f => assembled%layers(k)%foundation)
                below(f) = below(f) .or. layer%side == gapbeam_below
                above(f) = above(f) .or. layer%side == gapbeam_above
                ! The layer that pushes down follows that which pushes up
                if (layer%side /= gapbeam_above .or. k == 1) cycle
                associate (other => assembled%layers(k - 1))
                    if (other%foundation /= f) cycle
                    with_gap(f) = with_gap(f) .or. abs(layer%contact_a - other%contact_a) > 0.0_wp &
                        .or. abs(layer%contact_b - other%contact_b) > 0.0_wp
                end associate
            end associate
        end do
        two_sided(:) = below .and. above .and. .not. with_gap
    end function find_two_sided

    !> The zones of one branch of a layer
    pure subroutine add_zones(runs, branch, zones, number)
        !> Of the layer
        type(run_type), intent(in) :: runs(:)
        integer, intent(in) :: branch
        !> The first `number` entries
        type(zone_type), intent(inout) :: zones(:)
        integer, intent(inout) :: number
        logical :: at_left, at_right, joins
        integer :: k

        joins = .false.
        do k = 1, size(runs)
            associate (run => runs(k))
                if (run%acts < branch) then
                    joins = .false.
                    cycle
                end if
                at_left = k == 1 .or. run%from > runs(max(k - 1, 1))%to
                at_right = k == size(runs) .or. runs(min(k + 1, size(runs)))%from > run%to
                if (joins .and. .not. at_left) then
                    zones(number)%to = run%to
                    zones(number)%at_right = at_right
                else
                    number = number + 1
                    zones(number) = zone_type(run%foundation, run%side, branch, run%from, run%to, at_left, at_right)
                end if
                joins = .true.
            end associate
        end do
    end subroutine add_zones

    !> Are there the same zones, but for where they are
    pure function same_zones(zones, others) result(same)
        !> By find_zones
        type(zone_type), intent(in) :: zones(:), others(:)
        logical :: same

        same = size(zones) == size(others)
        if (same) same = all(layer_of(zones) == layer_of(others) .and. (zones%at_left .eqv. others%at_left) &
                             .and. (zones%at_right .eqv. others%at_right))
    end function same_zones

    !> A number for every layer and branch, ascending along the zones
    elemental function layer_of(zone) result(key)
        type(zone_type), intent(in) :: zone
        integer(int64) :: key

        key = shiftl(int(2*zone%foundation - merge(1, 0, zone%side == gapbeam_below), int64), 32) + zone%branch
    end function layer_of

    !> How zones become others
    subroutine compare_zones(before, after, changes, number)
        !> By find_zones
        type(zone_type), intent(in) :: before(:), after(:)
        !> The changes, layer by layer: the first `number` entries
        type(zone_change_type), allocatable, intent(out) :: changes(:)
        integer, intent(out) :: number
        integer(int64) :: key
        integer :: first(2), last(2)

        allocate (changes(4*(size(before) + size(after))))
        number = 0
        last(:) = 0
        do while (last(1) < size(before) .or. last(2) < size(after))
            first(:) = last + 1
            key = huge(key)
            if (first(1) <= size(before)) key = layer_of(before(first(1)))
            if (first(2) <= size(after)) key = min(key, layer_of(after(first(2))))
            last(1) = first(1) - 1 + count(layer_of(before(first(1):)) == key)
            last(2) = first(2) - 1 + count(layer_of(after(first(2):)) == key)
            call compare_layer(before(first(1):last(1)), after(first(2):last(2)), changes, number)
        end do
    end subroutine compare_zones

    !> A change as the engine looks for it
    elemental function looked_for(change, unit) result(sought)
        type(zone_change_type), intent(in) :: change
        !> Power of 2 of the engine's length
        integer, intent(in) :: unit
        type(change_type) :: sought

        sought = change_type(foundation=change%foundation, side=change%side, branch=change%branch, from=scale(change%from, -unit), &
                             to=scale(change%to, -unit), greatest=all(change%change /= [gapbeam_merges, gapbeam_splits]))
    end function looked_for

    !> The same for one branch of a layer
    subroutine compare_layer(before, after, changes, number)
        type(zone_type), intent(in) :: before(:), after(:)
        type(zone_change_type), intent(inout) :: changes(:)
        integer, intent(inout) :: number
        !> Are these the same zone, or parts of one
        logical :: met(size(before), size(after))
        integer :: i, k, last, other

        do i = 1, size(after)
            met(:, i) = meet(before, after(i))
        end do
        call meet_those_that_moved()
        do i = 1, size(after)
            last = 0
            do k = 1, size(before)
                if (.not. met(k, i)) cycle
                if (last > 0) call note(after(i), gapbeam_merges, before(last)%to, before(k)%from, before(last)%from, before(k)%to)
                last = k
            end do
            if (last == 0) call note_zone(after(i), gapbeam_appears)
        end do
        do i = 1, size(before)
            last = 0
            do k = 1, size(after)
                if (.not. met(i, k)) cycle
                if (last > 0) call note(before(i), gapbeam_splits, after(last)%to, after(k)%from, after(last)%from, after(k)%to)
                last = k
            end do
            if (last == 0) call note_zone(before(i), gapbeam_vanishes)
            if (count(met(i, :)) /= 1) cycle
            other = last
            if (count(met(:, other)) /= 1) cycle
            associate (was => before(i), is => after(other))
                if (was%at_left .neqv. is%at_left) call note_end(was, is%at_left, merge(is%from, was%from, is%at_left))
                if (was%at_right .neqv. is%at_right) call note_end(was, is%at_right, merge(is%to, was%to, is%at_right))
            end associate
        end do

    contains

        !> Zones that meet no other, with nothing between the two, are one that has moved
        subroutine meet_those_that_moved()
            real(wp) :: from, to

            do i = 1, size(after)
                if (any(met(:, i))) cycle
                do k = 1, size(before)
                    if (any(met(k, :))) cycle
                    from = min(before(k)%to, after(i)%to)
                    to = max(before(k)%from, after(i)%from)
                    if (any(before%from >= from .and. before%to <= to) .or. any(after%from >= from .and. after%to <= to)) cycle
                    met(k, i) = .true.
                    exit
                end do
            end do
        end subroutine meet_those_that_moved

        !> An end comes to an end of the layer, or leaves it
        subroutine note_end(zone, reaches, x)
            type(zone_type), intent(in) :: zone
            logical, intent(in) :: reaches
            real(wp), intent(in) :: x

            call note(zone, merge(gapbeam_reaches, gapbeam_leaves, reaches), x, x, x, x)
        end subroutine note_end

        !> A zone is there on one side only
        subroutine note_zone(zone, change)
            type(zone_type), intent(in) :: zone
            integer, intent(in) :: change

            call note(zone, change, zone%from, zone%to, &
                      max(maxval(before%to, before%to <= zone%from), maxval(after%to, after%to <= zone%from)), &
                      min(minval(before%from, before%from >= zone%to), minval(after%from, after%from >= zone%to)))
        end subroutine note_zone

        !> One change more
        subroutine note(zone, change, from, to, last, next)
            type(zone_type), intent(in) :: zone
            integer, intent(in) :: change
            !> Between which places it is seen, and what it is surely not beyond
            real(wp), intent(in) :: from, to, last, next
            real(wp) :: move

            move = farthest_move*(to - from)
            number = number + 1
            changes(number) = zone_change_type(zone%foundation, zone%side, zone%branch, change, from + (to - from)/2, &
                                               from - min(move, from/2 - last/2), to + min(move, next/2 - to/2))
        end subroutine note

    end subroutine compare_layer

    !> Have two zones a stretch in common
    elemental function meet(zone, other) result(overlap)
        type(zone_type), intent(in) :: zone, other
        logical :: overlap

        overlap = max(zone%from, other%from) < min(zone%to, other%to)
    end function meet

end module gapbeam_ground_changes
