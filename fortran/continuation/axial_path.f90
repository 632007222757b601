!> The way of the chain along the beam while the load goes on: the stretches of a path of bending, cut where links along the beam
!> act, let go, yield, slip or stick.
module gapbeam_axial_path
    use gapbeam_kinds, only: wp, qp
    use gapbeam_error, only: error_type, fatal_error, gapbeam_bad_input
    use gapbeam_words, only: shown
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_axial_chain, only: stays_at_rest
    use gapbeam_axial_walk, only: chain_walk_type, begin_walk, set_loads, go_to, begin_stretch, numbers_of
    use gapbeam_axial_friction, only: set_limits, find_reactions, drop_rounding, zeros_between
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
        real(qp) :: from_limit(size(walk%support)), to_limit(size(walk%support)), at
        real(qp), allocatable :: ends(:)
        real(wp) :: from_force(size(walk%support)), to_force(size(walk%support))
        integer :: i

        walk%bending = history%stretches(k)
        associate (s => history%stretches(k), chain => walk%chain)
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
            call set_loads(assembled, s%leg, sign(1.0_wp, s%to - s%from), walk)
            if (walk%path%number > 0 .and. stays_at_rest(chain)) then
                call walk%keep(assembled, s%from, s%to, error)
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
                if (walk%lost) then
                    walk%path%ending = mechanism
                    walk%path%limits = [limit_type(mechanism, s%leg, walk%lost_at, walk%path%number)]
                end if
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

    end subroutine pass_stretch

    !> Keep a stretch of the path, and the numbers of the chain at its ends
    subroutine keep(walk, assembled, from, to, error)
        class(walk_type), intent(inout) :: walk
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: from, to
        type(error_type), allocatable, intent(out) :: error
        type(stretch_type) :: kept
        integer :: ends(2)

        if (walk%path%number >= walk%most) then
            walk%path%ending = cut_off
            walk%full = .true.
            return
        end if
        kept = walk%bending
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
        call begin_stretch(walk, assembled)

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
