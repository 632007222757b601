!> The way of the chain along the beam while the load goes on: the stretches of a path of bending, cut where links along the beam
!> act, let go, yield, slip or stick.
module gapbeam_axial_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_chain, only: stays_at_rest
    use gapbeam_axial_reach, only: find_reaches
    use gapbeam_axial_progress, only: settle, change_limit
    use gapbeam_axial_walk, only: chain_walk_type, begin_walk, set_loads, go_to, begin_stretch, note_contacts, numbers_of
    use gapbeam_axial_friction, only: set_limit, set_limits, goes_on_so, find_reactions, drop_rounding, zeros_between
    use gapbeam_friction_limits, only: friction_limits_type, go_by_reactions, new_limits, take_lines, find_sizes, find_limits, &
        find_let_go
    use gapbeam_history_stretch, only: stretch_type, nothing_changes
    use gapbeam_history_record, only: history_type, limit_type, new_history, add_stretch, add_column, mechanism, no_limit, cut_off
    implicit none
    private
    public :: follow_along_axis

    !> The chain on its way through the stretches of a path of bending
    type, extends(chain_walk_type) :: walk_type
        !> The stretch of bending at hand; is a part of it kept
        type(stretch_type) :: bending
        logical :: begun = .false.
        !> Leg whose loads are set, and 1 where they rise, -1 where they fall
        integer :: leg = -1
        real(wp) :: way = 0.0_wp
        !> Does the chain stay at rest under them
        logical :: rests = .false.
        !> Are limits of friction found by lines of reactions; these; have they been on the last stretch
        logical :: by_reactions = .false.
        type(friction_limits_type) :: limits
        logical :: follows = .false.
        !> The path as it becomes, and its most stretches
        type(history_type) :: path
        integer :: most = 0
    contains
        procedure :: keep
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

        walk%most = most
        call begin_walk(assembled, walk)
        call new_history(history%at_limit, walk%path)
        allocate (walk%path%along)
        allocate (walk%path%along%support, source=walk%support)
        allocate (walk%path%along%columns(16))
        walk%by_reactions = go_by_reactions(assembled)
        if (walk%by_reactions) call new_limits(assembled, walk%support, walk%chain%rubs, walk%limits)
        first(:) = 1
        last(:) = 0
        do k = 1, history%number
            first(k) = walk%path%number + 1
            walk%begun = .false.
            beam => assembled
            if (history%stretches(k)%leg == 0) beam => dead
            call pass_stretch(walk, assembled, beam, history, k, error)
            if (allocated(error)) return
            last(k) = walk%path%number
            first(k) = min(first(k), max(1, walk%path%number))
            if (walk%lost .or. walk%full) exit
        end do
        call take_limits(history, walk, first, last, k)
        call move_alloc(walk%path%stretches, history%stretches)
        call move_alloc(walk%path%along, history%along)
        history%number = walk%path%number
        if (walk%path%ending /= no_limit) history%ending = walk%path%ending
        history%solves = history%solves + walk%chain%solves
    end subroutine follow_along_axis

    !> Go along a stretch of bending
    subroutine pass_stretch(walk, assembled, beam, history, k, error)
        type(walk_type), intent(inout) :: walk
        !> The beam, and with the loads of its leg
        type(assembled_type), intent(in) :: assembled
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in), target :: history
        integer, intent(in) :: k
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: changed(:)
        real(wp) :: way
        logical :: follows, told

        walk%bending = history%stretches(k)
        follows = walk%follows
        walk%follows = .false.
        walk%goes_on = .false.
        associate (s => history%stretches(k), chain => walk%chain)
            if (walk%by_reactions) call take_lines(walk%limits, s%pressed, s%reactions, changed)
            if (s%skipped .or. .not. abs(s%to - s%from) > 0.0_wp) then
                if (s%skipped .and. any(chain%rubs)) then
                    call fatal_error(error, gapbeam_bad_input, "friction = "//trim(shown(assembled%model%supports( &
                                     walk%support(findloc(chain%rubs, .true., 1)))%friction))//": at load factor "// &
                                     trim(shown(s%from))//" the beam jumps to another state, through which friction is not "// &
                                     "followed: give laws that do not fall, or no friction")
                    return
                end if
                call begin_stretch(walk, assembled)
                call walk%keep(assembled, s%from, s%to, error)
                return
            end if
            way = sign(1.0_wp, s%to - s%from)
            if (s%leg /= walk%leg .or. abs(way - walk%way) > 0.0_wp) then
                call set_loads(assembled, s%leg, way, walk)
                walk%leg = s%leg
                walk%way = way
                walk%rests = .false.
                follows = .false.
            end if
            if (walk%path%number > 0 .and. .not. (follows .and. chain%driven)) then
                if (.not. walk%rests) walk%rests = stays_at_rest(chain)
                if (walk%rests) then
                    call walk%keep(assembled, s%from, s%to, error)
                    return
                end if
            end if
            told = .false.
            if (walk%by_reactions .and. chain%by_parts) then
                if (walk%limits%known) call pass_by_reactions(walk, assembled, history, k, follows, changed, told, error)
            end if
            if (.not. told) call pass_by_states(walk, assembled, beam, history, k, error)
            if (.not. walk%lost) return
            walk%path%ending = mechanism
            walk%path%limits = [limit_type(mechanism, s%leg, walk%lost_at, walk%path%number)]
        end associate
    end subroutine pass_stretch

    !> Go along a stretch whose reactions are known as lines: where these are as they were links go on as they did
    subroutine pass_by_reactions(walk, assembled, history, k, follows, changed, told, error)
        !> As for pass_stretch
        type(walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        type(history_type), intent(in) :: history
        integer, intent(in) :: k
        !> Do limits come from the stretch before; links whose lines are others there
        logical, intent(in) :: follows
        integer, intent(in) :: changed(:)
        !> If not, nothing is done
        logical, intent(out) :: told
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: links(:), reaches(:, :)
        real(qp), allocatable :: limit(:), rate(:)
        logical, allocatable :: others(:)
        integer :: i
        logical :: partly

        associate (s => history%stretches(k), chain => walk%chain)
            walk%goes_on = .false.
            if (k < history%number) walk%goes_on = goes_on_to(history%stretches(k + 1))
            partly = follows
            if (partly) then
                if (walk%goes_on) then
                    call find_let_go(walk%limits, s%to, links, history%stretches(k + 1)%pressed, history%stretches(k + 1)%reactions)
                else
                    call find_let_go(walk%limits, s%to, links)
                end if
                links = [changed, pack(links, [(.not. any(changed == links(i)), i=1, size(links))])]
                call find_limits(walk%limits, links, s%from, s%to, limit, rate, partly)
            end if
            if (.not. partly) then
                links = pack([(i, i=1, size(chain%rubs))], chain%rubs)
                call find_sizes(walk%limits, s%from, s%to)
                call find_limits(walk%limits, links, s%from, s%to, limit, rate, told)
                if (.not. told) return
            end if
            told = .true.
            allocate (others(size(links)), source=.true.)
            if (partly) others(:) = [(.not. goes_on_so(chain, links(i), limit(i), rate(i), abs(real(s%to, qp) - s%from), &
                                                       walk%limits%rounding(links(i))), i=1, size(links))]
            if (partly) then
                reaches = find_reaches(chain, pack(links, others))
            else
                reaches = reshape([0, size(chain%flexibility)], [2, 1])
            end if
            do i = 1, size(reaches, 2)
                call settle(chain, reaches(:, i))
            end do
            do i = 1, size(links)
                if (.not. others(i)) cycle
                call change_limit(chain, links(i), rate(i))
                call set_limit(chain, links(i), limit(i))
            end do
            walk%follows = .true.
            chain%anew = .not. partly
            call go_to(walk, assembled, real(s%from, qp), real(s%to, qp), error, reaches)
        end associate

    contains

        !> Does a stretch follow whose lines are known beside those of this one
        pure function goes_on_to(next) result(it_does)
            type(stretch_type), intent(in) :: next
            logical :: it_does

            it_does = next%leg == walk%leg .and. allocated(next%pressed) .and. .not. next%skipped &
                .and. walk%way*(next%to - next%from) > 0.0_wp
        end function goes_on_to

    end subroutine pass_by_reactions

    !> Go along a stretch by the reactions of the states at its ends
    subroutine pass_by_states(walk, assembled, beam, history, k, error)
        !> As for pass_stretch
        type(walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        type(assembled_type), intent(in), target :: beam
        type(history_type), intent(in), target :: history
        integer, intent(in) :: k
        type(error_type), allocatable, intent(out) :: error
        real(qp) :: from_limit(size(walk%support)), to_limit(size(walk%support)), at
        real(qp), allocatable :: ends(:)
        real(wp) :: from_force(size(walk%support)), to_force(size(walk%support))
        integer :: i

        associate (s => history%stretches(k), chain => walk%chain)
            if (walk%by_reactions) call settle(chain, [0, size(chain%flexibility)])
            ends = [real(s%to, qp)]
            if (any(chain%rubs)) then
                call find_reactions(beam, history, k, s%from, walk%support, chain%rubs, from_force, error)
                if (.not. allocated(error)) call find_reactions(beam, history, k, s%to, walk%support, chain%rubs, to_force, error)
                if (allocated(error)) return
                call drop_rounding(from_force, to_force)
                ends = [zeros_between(s%from, s%to, from_force, to_force), ends]
            end if
            at = s%from
            call begin_stretch(walk, assembled)
            do i = 1, size(ends)
                if (any(chain%rubs)) then
                    call limits_at(at, from_limit)
                    call limits_at(ends(i), to_limit)
                    call set_limits(chain, from_limit)
                    chain%limit_rate(:) = 0.0_qp
                    if (abs(ends(i) - at) > 0.0_qp) chain%limit_rate(:) = (to_limit - from_limit)/abs(ends(i) - at)
                end if
                call go_to(walk, assembled, at, ends(i), error)
                if (allocated(error) .or. walk%lost .or. walk%full) return
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

            associate (s => history%stretches(k), given => assembled%model%supports(walk%support))
                share = (factor - s%from)/(real(s%to, qp) - s%from)
                limit(:) = given%friction*abs((1 - share)*from_force + share*to_force)
                where (.not. walk%chain%rubs) limit = 0.0_qp
            end associate
        end subroutine limits_at

    end subroutine pass_by_states

    !> Keep a stretch of the path, and the numbers of the chain at its ends
    subroutine keep(walk, assembled, from, to, error)
        class(walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: from, to
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: kept
        real(wp), allocatable :: values(:)
        integer :: ends(2)

        if (walk%path%number >= walk%most) then
            walk%path%ending = cut_off
            walk%full = .true.
            return
        end if
        kept = walk%bending
        if (allocated(kept%pressed)) deallocate (kept%pressed, kept%reactions)
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
            if (allocated(error)) return
            allocate (values, source=numbers_of(walk))
            ends(2) = ends(1)
            if (any(abs(values - along%columns(ends(1))%x) > 0.0_wp)) call add_column(values, along, ends(2), error)
        end associate
        if (allocated(error)) return
        kept%ends = ends
        call add_stretch(kept, walk%path, error)
        call move_alloc(values, walk%start)
        call note_contacts(walk, assembled)

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

end module gapbeam_axial_path
