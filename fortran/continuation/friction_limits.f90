!> Limits of friction by the lines that reactions across the beam have over the load factor, from stretch to stretch of a path of
!> bending.
!>
!> What happens to a support is felt by reactions a few spans around it: limits farther off go on as they did, and so does what
!> follows from them.
module gapbeam_friction_limits
    use gapbeam_kinds, only: wp, qp
    use gapbeam_limits, only: limits_anew_bars
    use gapbeam_path_tolerances, only: same_reaction, same_slope_of_reaction, larger_reaction
    use gapbeam_same_numbers, only: same_numbers_type, new_numbers, find_same
    use gapbeam_polyline, only: last_breakpoint
    use gapbeam_scene, only: gapbeam_both, gapbeam_elastic
    use gapbeam_assembled_model, only: assembled_type
    implicit none
    private
    public :: friction_limits_type, go_by_reactions, new_limits, take_lines, find_sizes, find_limits, find_let_go

    !> What is known of reactions
    type :: friction_limits_type
        !> Are their lines known
        logical :: known = .false.
        !> Link along the beam of every breakpoint of a support that rubs, 0: none; of every link the first and the last of these,
        !> and what reaction its limit is of, to one side or the other, in units of the axial system
        integer, allocatable :: link(:), first(:), last(:)
        real(wp), allocatable :: share(:)
        !> Reaction of every breakpoint at load factor 0, and by a unit of it, shape (2, size(link))
        real(wp), allocatable :: line(:, :)
        !> Largest reaction and slope, and which of them are the same but for rounding
        real(wp) :: largest(2) = 0.0_wp
        type(same_numbers_type) :: same(2)
    contains
        procedure :: rounding
    end type friction_limits_type

contains

    !> Do limits go by the lines of reactions: in a long chain in which friction alone remembers, whose supports push one way
    pure function go_by_reactions(assembled) result(they_do)
        type(assembled_type), intent(in) :: assembled
        logical :: they_do

        they_do = allocated(assembled%axial%laws)
        if (.not. they_do) return
        associate (axial => assembled%axial, its => assembled%model%supports(assembled%axial%support))
            they_do = size(axial%flexibility) > limits_anew_bars .and. any(axial%rubs) &
                .and. all(merge(its%side /= gapbeam_both, its%unloading == gapbeam_elastic, axial%rubs))
        end associate
    end function go_by_reactions

    !> No line is known yet
    pure subroutine new_limits(assembled, support, rubs, limits)
        type(assembled_type), intent(in) :: assembled
        !> Support of every link along the beam, and whether it rubs
        integer, intent(in) :: support(:)
        logical, intent(in) :: rubs(:)
        type(friction_limits_type), intent(out) :: limits
        integer :: l

        associate (n => size(support), laws => assembled%beam%supports, given => assembled%model%supports)
            allocate (limits%link(size(laws)), limits%last(n), source=0)
            allocate (limits%first(n), source=1)
            allocate (limits%line(2, size(laws)), limits%share(n), source=0.0_wp)
            do l = 1, n
                if (.not. rubs(l)) cycle
                if (assembled%beam_support(support(l)) == 0) cycle
                limits%first(l) = assembled%beam_support(support(l))
                limits%last(l) = last_breakpoint(laws, limits%first(l))
                limits%link(limits%first(l):limits%last(l)) = l
                limits%share(l) = scale(given(support(l))%side*given(support(l))%friction, &
                                        assembled%units%force - assembled%axial%units%force)
            end do
        end associate
    end subroutine new_limits

    !> Take the lines of a stretch that are others than on the stretch before
    pure subroutine take_lines(limits, pressed, reactions, changed)
        type(friction_limits_type), intent(inout) :: limits
        !> As in stretch_type (gapbeam_history_stretch)
        integer, allocatable, intent(in) :: pressed(:)
        real(wp), allocatable, intent(in) :: reactions(:, :)
        !> Links of which they are, each once
        integer, allocatable, intent(out) :: changed(:)
        integer :: i, number

        if (.not. allocated(pressed)) then
            limits%known = .false.
            allocate (changed(0))
            return
        end if
        limits%known = limits%known .or. size(pressed) >= size(limits%link)
        limits%line(:, pressed) = reactions
        allocate (changed(size(pressed)))
        number = 0
        do i = 1, size(pressed)
            associate (l => limits%link(pressed(i)))
                if (l == 0) cycle
                if (pressed(i) /= limits%first(l)) cycle
                if (any(changed(:number) == l)) cycle
                number = number + 1
                changed(number) = l
            end associate
        end do
        changed = changed(:number)
    end subroutine take_lines

    !> Find the sizes of reactions and slopes on a stretch, which tell what rounding is
    pure subroutine find_sizes(limits, from, to)
        !> All lines known
        type(friction_limits_type), intent(inout) :: limits
        !> Load factors at its ends
        real(wp), intent(in) :: from, to

        associate (line => limits%line, has => limits%link > 0)
            limits%largest = [max(maxval(abs(line(1, :) + from*line(2, :)), has), maxval(abs(line(1, :) + to*line(2, :)), has)), &
                              maxval(abs(line(2, :)), has)]
        end associate
        call new_numbers(same_reaction*limits%largest(1), limits%same(1))
        call new_numbers(same_slope_of_reaction*same_reaction*limits%largest(2), limits%same(2))
    end subroutine find_sizes

    !> Limits of links on a stretch
    pure subroutine find_limits(limits, links, from, to, limit, rate, told)
        !> With the sizes
        type(friction_limits_type), intent(inout) :: limits
        integer, intent(in) :: links(:)
        !> Load factors at its ends
        real(wp), intent(in) :: from, to
        !> Limits where it begins, and their rates, shape (size(links)): those that end at zero do so to the last digit
        real(qp), allocatable, intent(out) :: limit(:), rate(:)
        !> Are all within the sizes, and do all supports push
        logical, intent(out) :: told
        real(wp) :: line(2), push, least, same, slope
        integer :: i

        allocate (limit(size(links)), rate(size(links)))
        told = .true.
        least = same_reaction*limits%largest(1)
        do i = 1, size(links)
            line = line_of(limits, links(i))
            push = line(1) + from*line(2)
            told = told .and. all(abs([push, line(2)]) <= larger_reaction*limits%largest) &
                .and. min(push, line(1) + to*line(2)) >= -least
            if (push <= least) push = 0.0_wp
            call find_same(limits%same(1), push, same)
            call find_same(limits%same(2), sign(line(2), line(2)*(to - from)), slope)
            if (.not. push > 0.0_wp) slope = max(slope, 0.0_wp)
            limit(i) = abs(limits%share(links(i)))*same
            rate(i) = abs(limits%share(links(i)))*slope
            if (push > 0.0_wp .and. line(1) + to*line(2) <= least) rate(i) = -limit(i)/abs(real(to, qp) - from)
        end do
    end subroutine find_limits

    !> What a link is pressed by at load factor 0, and by a unit of it
    pure function line_of(limits, l) result(line)
        type(friction_limits_type), intent(in) :: limits
        integer, intent(in) :: l
        real(wp) :: line(2)

        line(:) = sign(1.0_wp, limits%share(l))*sum(limits%line(:, limits%first(l):limits%last(l)), 2)
    end function line_of

    !> Links that nothing presses any more where a stretch ends: their breakpoints have no reaction on the next one; or all that
    !> come to nothing there
    pure subroutine find_let_go(limits, to, links, pressed, reactions)
        type(friction_limits_type), intent(in) :: limits
        !> Load factor at its end
        real(wp), intent(in) :: to
        integer, allocatable, intent(out) :: links(:)
        !> Of the next stretch, as in stretch_type (gapbeam_history_stretch), where it follows
        integer, intent(in), optional :: pressed(:)
        real(wp), intent(in), optional :: reactions(:, :)
        real(wp) :: line(2)
        integer :: i, l

        links = [integer ::]
        if (present(pressed)) then
            do i = 1, size(pressed)
                l = limits%link(pressed(i))
                if (l == 0 .or. any(abs(reactions(:, i)) > 0.0_wp)) cycle
                if (all(links /= l)) links = [links, l]
            end do
        else
            links = pack([(l, l=1, size(limits%share))], limits%last > 0)
        end if
        do i = size(links), 1, -1
            line = line_of(limits, links(i))
            if (line(1) + to*line(2) > same_reaction*limits%largest(1) .or. .not. any(abs(line) > 0.0_wp)) then
                links = [links(:i - 1), links(i + 1:)]
            end if
        end do
    end subroutine find_let_go

    !> Rounding of the limit of a link, and of its rate
    pure function rounding(limits, l)
        class(friction_limits_type), intent(in) :: limits
        integer, intent(in) :: l
        real(wp) :: rounding(2)

        rounding(:) = abs(limits%share(l))*same_slope_of_reaction*same_reaction*limits%largest
    end function rounding

end module gapbeam_friction_limits
