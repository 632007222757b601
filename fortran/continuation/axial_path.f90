!> The way of the chain along the beam while the load goes on: the stretches of a path of bending, cut where links along the beam
!> act, let go, yield, slip or stick.
module gapbeam_axial_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_tolerances, only: fine_rounding
    use gapbeam_limits, only: most_idle_segments
    use gapbeam_watch, only: end_if_stopped
    use gapbeam_error, only: error_type, fatal_error, gapbeam_not_converged, gapbeam_indeterminate, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: of_supports
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_axial_loads, only: make_chain, movement_of, set_loads, set_limits, find_reactions, drop_rounding, zeros_between
    use gapbeam_axial_chain, only: chain_type, next_change, find_reach, stays_at_rest
    use gapbeam_axial_progress, only: advance, change_pieces, settle, settle_link, note_rates, values_of
    use gapbeam_axial_rates, only: moves_at_once, not_told
    use gapbeam_axial_slip, only: find_rates_by_parts
    use gapbeam_history_stretch, only: stretch_type, nothing_changes
    use gapbeam_history_record, only: history_type, limit_type, new_history, add_stretch, add_column, mechanism, no_limit, cut_off
    implicit none
    private
    public :: follow_along_axis

    !> Rounds in which all links of wrong sign change at once, before one alone does
    integer, parameter :: rounds_at_once = 8
    !> Share of a stretch of bending below which what is left of it is rounding
    real(qp), parameter :: no_way_left = 1e-26_qp

    !> The chain on its way
    type :: walk_type
        type(assembled_type), pointer :: assembled => null()
        type(chain_type) :: chain
        !> Support of the model of every link
        integer, allocatable :: support(:)
        !> The path as it becomes
        type(history_type) :: path
        !> Most stretches; changes without a way between them
        integer :: most = 0, idle = 0
        !> Values at the start of the stretch at hand
        real(wp), allocatable :: start(:)
        !> Contacts of the laws there, if some keep a set, shape (size(chain%laws))
        real(wp), allocatable :: contact(:)
        !> Is a part of the stretch of bending at hand kept; does the chain move without end
        logical :: begun = .false., lost = .false.
    end type walk_type

contains

    !> Let the chain along the beam follow a path of bending
    subroutine follow_along_axis(assembled, dead, most, history, error)
        !> With links along the beam; the same while its dead loads are put on, as live ones
        type(assembled_type), intent(in), target :: assembled, dead
        !> Stretches after which the path is cut off
        integer, intent(in) :: most
        !> That of bending in; its stretches cut, with what happens along the beam, out
        type(history_type), intent(inout), target :: history
        !> No memory; two rigid links whose forces cannot be told apart; friction where the beam jumps
        type(error_type), allocatable, intent(out) :: error
        type(walk_type) :: walk
        type(assembled_type), pointer :: beam
        integer :: first(0:history%number), last(0:history%number), k

        walk%assembled => assembled
        walk%most = most
        call make_chain(assembled, walk%chain, walk%support)
        call new_history(history%at_limit, walk%path)
        allocate (walk%path%along)
        allocate (walk%path%along%support, source=walk%support)
        allocate (walk%path%along%columns(16))
        first(:) = 1
        last(:) = 0
        do k = 1, history%number
            first(k) = walk%path%number + 1
            walk%begun = .false.
            beam => assembled
            if (history%stretches(k)%leg == 0) beam => dead
            call pass_stretch(walk, beam, history, k, error)
            if (allocated(error)) return
            last(k) = walk%path%number
            first(k) = min(first(k), max(1, walk%path%number))
            if (walk%lost .or. walk%path%ending == cut_off) exit
        end do
        call take_limits(history, walk, first, last, k)
        call move_alloc(walk%path%stretches, history%stretches)
        call move_alloc(walk%path%along, history%along)
        history%number = walk%path%number
        if (walk%path%ending /= no_limit) history%ending = walk%path%ending
        history%solves = history%solves + walk%chain%solves
    end subroutine follow_along_axis

    !> Go along a stretch of bending
    subroutine pass_stretch(walk, beam, history, k, error)
        type(walk_type), intent(inout) :: walk
        !> With the loads of its leg
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in), target :: history
        integer, intent(in) :: k
        type(error_type), allocatable, intent(out) :: error
        real(qp) :: from_limit(size(walk%support)), to_limit(size(walk%support)), at
        real(qp), allocatable :: ends(:)
        real(wp) :: from_force(size(walk%support)), to_force(size(walk%support))
        integer :: i

        associate (s => history%stretches(k), chain => walk%chain)
            if (s%skipped .or. .not. abs(s%to - s%from) > 0.0_wp) then
                if (s%skipped .and. any(chain%rubs)) then
                    call fatal_error(error, gapbeam_bad_input, "friction = "//trim(shown(walk%assembled%model%supports( &
                                     walk%support(findloc(chain%rubs, .true., 1)))%friction))//": at load factor "// &
                                     trim(shown(s%from))//" the beam jumps to another state, through which friction is not "// &
                                     "followed: give laws that do not fall, or no friction")
                    return
                end if
                call begin_stretch(walk)
                call keep(walk, s, s%from, s%to, error)
                return
            end if
            call set_loads(walk%assembled, walk%support, s%leg, sign(1.0_wp, s%to - s%from), chain)
            if (walk%path%number > 0 .and. stays_at_rest(chain)) then
                call keep(walk, s, s%from, s%to, error)
                return
            end if
            ends = [real(s%to, qp)]
            if (any(chain%rubs)) then
                call find_reactions(beam, history, k, s%from, walk%support, chain%rubs, from_force, error)
                if (.not. allocated(error)) call find_reactions(beam, history, k, s%to, walk%support, chain%rubs, to_force, error)
                if (allocated(error)) return
                call drop_rounding(from_force, to_force)
                ends = [zeros_between(s%from, s%to, from_force, to_force), ends]
            end if
            at = s%from
            call begin_stretch(walk)
            do i = 1, size(ends)
                if (any(chain%rubs)) then
                    call limits_at(at, from_limit)
                    call limits_at(ends(i), to_limit)
                    call set_limits(chain, from_limit)
                    chain%limit_rate(:) = 0.0_qp
                    if (abs(ends(i) - at) > 0.0_qp) chain%limit_rate(:) = (to_limit - from_limit)/abs(ends(i) - at)
                end if
                call go_to(walk, s, at, ends(i), error)
                if (allocated(error) .or. walk%lost .or. walk%path%ending == cut_off) return
                if (any(chain%rubs)) call set_limits(chain, to_limit)
                at = ends(i)
            end do
        end associate

    contains

        !> Limits of friction at a load factor of the stretch
        subroutine limits_at(factor, limit)
            real(qp), intent(in) :: factor
            real(qp), intent(out) :: limit(:)
            real(qp) :: share

            associate (s => history%stretches(k), given => walk%assembled%model%supports(walk%support))
                share = (factor - s%from)/(real(s%to, qp) - s%from)
                limit(:) = given%friction*abs((1 - share)*from_force + share*to_force)
                where (.not. walk%chain%rubs) limit = 0.0_qp
            end associate
        end subroutine limits_at

    end subroutine pass_stretch

    !> Go from one load factor to another, limits of friction being linear between them
    subroutine go_to(walk, s, from, to, error)
        type(walk_type), intent(inout) :: walk
        !> Stretch of bending
        type(stretch_type), intent(in) :: s
        real(qp), intent(in) :: from, to
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: links(:), steps(:)
        real(qp) :: at, way
        integer :: outcome, place, single, whole(2), reach(2), i
        logical :: dragged

        at = from
        whole = [0, size(walk%chain%flexibility)]
        reach = whole
        walk%idle = 0
        walk%chain%anew = .true.
        do
            call end_if_stopped(walk%assembled%beam%watch, error)
            if (allocated(error)) return
            dragged = .true.
            do while (dragged)
                call find_rates_by_parts(walk%chain, reach, outcome, place, dragged)
                if (outcome == not_told) exit
            end do
            call note_rates(walk%chain, reach)
            call begin_stretch(walk)
            if (outcome == not_told) then
                call refuse_shared(walk, place, real(at, wp), error)
                return
            end if
            call next_change(walk%chain, outcome == moves_at_once, reach, way, links, steps)
            ! Where a limit and what it holds vanish together, rounding is no motion
            if (outcome == moves_at_once .and. abs(to - at) <= no_way_left*abs(to - from)) return
            if (outcome == moves_at_once) then
                if (size(links) == 0) then
                    walk%lost = .true.
                    walk%path%ending = mechanism
                    walk%path%limits = [limit_type(mechanism, s%leg, real(at, wp), walk%path%number)]
                    return
                end if
                if (way > 0.0_qp) call advance(walk%chain, way, .true.)
            else
                ! What happens at its end belongs to what follows
                if (way >= abs(to - at) - no_way_left*abs(to - from)) then
                    call go_on(to)
                    return
                end if
                if (way > 0.0_qp) call go_on(at + sign(way, to - from))
                if (allocated(error) .or. walk%path%ending == cut_off) return
            end if
            if (way > 0.0_qp) then
                walk%idle = 0
            else
                walk%idle = walk%idle + 1
            end if
            if (walk%idle > 4*size(walk%support) + most_idle_segments) then
                call fatal_error(error, gapbeam_not_converged, "along the beam the path does not leave load factor "// &
                                 trim(shown(real(at, wp)))//", where rounding hides which support slips first: bring the "// &
                                 "magnitudes of the beam nearer to each other")
                return
            end if
            single = size(links)
            if (walk%idle > rounds_at_once) single = 1
            reach = whole
            if (outcome /= moves_at_once) reach = find_reach(walk%chain, links(:single))
            call settle(walk%chain, reach)
            do i = 1, single
                call settle_link(walk%chain, links(i))
            end do
            call change_pieces(walk%chain, links(:single), steps(:single))
        end do

    contains

        !> Go on with the load, and keep the stretch
        subroutine go_on(next)
            real(qp), intent(in) :: next
            real(wp) :: begin, end

            begin = real(at, wp)
            end = real(next, wp)
            call advance(walk%chain, abs(next - at), .false.)
            if (.not. abs(to - next) > 0.0_qp) then
                ! At the end all digits are those of quadruple precision
                call settle(walk%chain, whole)
                call note_rates(walk%chain, whole)
            end if
            if (abs(end - begin) > 0.0_wp) call keep(walk, s, begin, end, error)
            at = next
        end subroutine go_on

    end subroutine go_to

    !> Begin a stretch: the numbers of the chain, and where laws that keep a set have gone, dead movements of supports included
    pure subroutine begin_stretch(walk)
        type(walk_type), intent(inout) :: walk
        integer :: l

        walk%start = numbers_of(walk)
        if (.not. any(walk%chain%keeps_set)) return
        if (.not. allocated(walk%contact)) allocate (walk%contact(size(walk%chain%laws)))
        associate (chain => walk%chain)
            do l = 1, size(walk%support)
                associate (k => chain%first(l), last => chain%last(l))
                    walk%contact(k:last) = real(chain%laws(k:last)%contact + movement_of(walk%assembled, walk%support(l)), wp)
                end associate
            end do
        end associate
    end subroutine begin_stretch

    !> Numbers of the chain, of which rounding leaves nothing where it comes to rest: first displacements, then forces
    pure function numbers_of(walk) result(values)
        type(walk_type), intent(in) :: walk
        real(wp), allocatable :: values(:)

        values = values_of(walk%chain)
        if (.not. allocated(walk%start)) return
        associate (before => abs(walk%start), n => size(walk%chain%flexibility) + 1)
            where (abs(values(:n)) <= real(fine_rounding, wp)*maxval(before(:n))) values(:n) = 0.0_wp
            where (abs(values(n + 1:)) <= real(fine_rounding, wp)*maxval(before(n + 1:))) values(n + 1:) = 0.0_wp
        end associate
    end function numbers_of

    !> Keep a stretch of the path, and the numbers of the chain at its ends
    subroutine keep(walk, s, from, to, error)
        type(walk_type), intent(inout) :: walk
        !> Of bending
        type(stretch_type), intent(in) :: s
        real(wp), intent(in) :: from, to
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: kept
        integer :: ends(2)

        if (walk%path%number >= walk%most) then
            walk%path%ending = cut_off
            return
        end if
        kept = s
        if (walk%begun) call nothing_changes(kept)
        walk%begun = .true.
        kept%from = from + 0.0_wp
        kept%to = to + 0.0_wp
        allocate (kept%along, source=walk%chain%closed)
        kept%loose = walk%chain%loose
        if (allocated(walk%contact)) kept%along_contact = walk%contact
        associate (along => walk%path%along)
            ends(1) = along%number
            if (ends(1) > 0) then
                if (.not. go_on_from(along%columns(ends(1))%x, walk%start)) ends(1) = 0
            end if
            if (ends(1) == 0) call add_column(walk%start, along, ends(1), error)
            if (.not. allocated(error)) call add_column(numbers_of(walk), along, ends(2), error)
        end associate
        if (allocated(error)) return
        kept%ends = ends
        call add_stretch(kept, walk%path, error)
        call begin_stretch(walk)

    contains

        !> Does the chain go on from where a stretch has ended, but for rounding
        pure function go_on_from(end, start)
            real(wp), intent(in) :: end(:), start(:)
            logical :: go_on_from

            associate (n => size(walk%chain%flexibility) + 1)
                go_on_from = is_near(end(:n), start(:n)) .and. is_near(end(n + 1:), start(n + 1:))
            end associate
        end function go_on_from

        !> Do numbers differ by rounding only
        pure function is_near(end, start)
            real(wp), intent(in) :: end(:), start(:)
            logical :: is_near

            is_near = all(abs(end - start) <= 4*epsilon(end)*maxval(abs(end)))
        end function is_near

    end subroutine keep

    !> Limits of bending up to where the chain has come, and ways not taken, by the stretches as they are now
    subroutine take_limits(history, walk, first, last, reached)
        type(history_type), intent(inout) :: history
        type(walk_type), intent(in) :: walk
        !> New stretches of every old one; the last one that was reached
        integer, intent(in) :: first(0:), last(0:), reached
        integer :: j

        history%limits = pack(history%limits, history%limits%stretch < reached)
        do j = 1, size(history%limits)
            associate (limit => history%limits(j))
                limit%stretch = last(limit%stretch)
                if (limit%landing > reached) limit%landing = 0
                if (limit%landing > 0) limit%landing = first(limit%landing)
            end associate
        end do
        history%limits = [history%limits, walk%path%limits]
        if (walk%lost .and. allocated(history%motion)) deallocate (history%motion)
        do j = 1, size(history%others)
            history%others(j)%stretch = first(min(history%others(j)%stretch, reached, ubound(first, 1)))
        end do
    end subroutine take_limits

    !> Refuse to tell what statics cannot
    subroutine refuse_shared(walk, place, factor, error)
        type(walk_type), intent(in) :: walk
        !> One of the links
        integer, intent(in) :: place
        real(wp), intent(in) :: factor
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: x

        associate (assembled => walk%assembled)
            x = point_x(assembled, assembled%support_point(walk%support(place)))
            call fatal_error(error, gapbeam_indeterminate, "the support at x = "//trim(shown(x))//" and another one hold "// &
                             "the beam rigidly along its axis with nothing between them that gives way, at load factor "// &
                             trim(shown(factor))//", so statics cannot tell what each of them takes: give the beam a finite "// &
                             "EA, or one of them a finite stiffness")
            error%table = of_supports
            error%entry = walk%support(place)
        end associate
    end subroutine refuse_shared

end module gapbeam_axial_path
