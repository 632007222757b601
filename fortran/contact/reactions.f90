!> Shears and reactions from a solution, with the reach of their rounding errors.
module gapbeam_reactions
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: support_block
    use gapbeam_nodes, only: is_restrained
    use gapbeam_law, only: share_forces
    use gapbeam_model, only: beam_type
    use gapbeam_workspace, only: workspace_type, interval_type
    implicit none
    private
    public :: find_sizes, find_shears, find_reactions, by_stretches

    !> Are links between which nothing holds the beam taken together once a solution is refined: in quadruple precision, which
    !> has the last word; doubles, alone or side by side, are in doubt instead
    logical, parameter :: by_stretches = precision(1.0_wp) > 20

contains

    !> Shears of the links. From the moments at its ends a short link between long ones gets a poor one; then the
    !> equilibrium of a node that no rigid support holds gives a better one from its neighbour
    pure subroutine find_shears(beam, range, work)
        type(beam_type), intent(in) :: beam
        !> First and last link
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        real(wp) :: change, passed
        integer :: i

        if (allocated(beam%ground)) then
            call find_end_shears(beam, range, work)
            return
        end if
        associate (v => work%shear, e => work%shear_error, a => work%answers, links => beam%links)
            do i = range(1), range(2)
                v(i) = (a(i)%moment_left - a(i - 1)%moment_right)*links(i)%inverse
                e(i) = epsilon(1.0_wp)*(abs(a(i)%moment_left) + abs(a(i - 1)%moment_right)) &
                    *links(i)%inverse
                if (i == 1 .or. work%nodes(i - 1)%held) cycle
                call change_at_node(work, i - 1, change, passed)
                if (e(i - 1) + passed < e(i)) then
                    v(i) = v(i - 1) + change
                    e(i) = e(i - 1) + passed
                end if
            end do
            do i = min(range(2), size(links) - 1), range(1), -1
                if (work%nodes(i)%held) cycle
                call change_at_node(work, i, change, passed)
                if (e(i + 1) + passed < e(i)) then
                    v(i) = v(i + 1) - change
                    e(i) = e(i + 1) + passed
                end if
            end do
        end associate
    end subroutine find_shears

    !> On elastic ground a link has a shear at each of its ends, here beside those of its loads with both ends held
    pure subroutine find_end_shears(beam, range, work)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        real(wp) :: terms(4, 2)
        integer :: i

        do i = range(1), range(2)
            associate (a => work%answers(i - 1), b => work%answers(i), g => beam%ground(i))
                terms(:, 1) = [-g%pa*a%moment_right, g%p2*b%moment_left, -g%gaa*a%deflection, -g%gab*b%deflection]
                terms(:, 2) = [g%pb*b%moment_left, -g%p1*a%moment_right, g%gbb*b%deflection, g%gab*a%deflection]
            end associate
            work%end_shear(:, i) = sum(terms, 1)
            work%end_shear_error(:, i) = epsilon(1.0_wp)*sum(abs(terms), 1)
        end do
    end subroutine find_end_shears

    !> By how much the shear changes at a node that is not held, and the rounding error of that
    pure subroutine change_at_node(work, i, change, error)
        type(workspace_type), intent(in) :: work
        integer, intent(in) :: i
        real(wp), intent(out) :: change, error

        change = work%nodes(i)%stiffness*work%answers(i)%deflection - work%rhs(i)%shear
        error = epsilon(1.0_wp)*(abs(work%nodes(i)%stiffness*work%answers(i)%deflection) + abs(work%rhs(i)%shear))
    end subroutine change_at_node

    !> Sizes whose rounding errors reach a node: those beside it, and those of its neighbours; what crosses
    !> a rigid support is halved at least, so sizes far away do not count
    pure subroutine find_sizes(beam, range, work)
        type(beam_type), intent(in) :: beam
        !> First and last node; others follow as far as their sizes change
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        type(interval_type) :: reach
        integer :: i, n, first, last

        n = size(beam%links)
        call find_own_sizes(beam, range, work)
        reach = interval_type()
        if (range(1) > 0) reach = work%reach_left(range(1) - 1)
        do i = range(1), n
            reach = passed_on(reach, work%reach_own(i), work%nodes(i)%held)
            if (i > range(2)) then
                if (same(reach, work%reach_left(i))) exit
            end if
            work%reach_left(i) = reach
        end do
        last = i - 1
        reach = interval_type()
        if (range(2) < n) reach = work%reach_right(range(2) + 1)
        do i = range(2), 0, -1
            reach = passed_on(reach, work%reach_own(i), work%nodes(i)%held)
            if (i < range(1)) then
                if (same(reach, work%reach_right(i))) exit
            end if
            work%reach_right(i) = reach
        end do
        first = i + 1
        do i = first, last
            work%shear_size(i) = max(work%reach_left(i)%shear, work%reach_right(i)%shear)
            work%deflection_size(i) = max(work%reach_left(i)%deflection, work%reach_right(i)%deflection)
        end do
    end subroutine find_sizes

    !> Sizes beside a node
    pure subroutine find_own_sizes(beam, range, work)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        type(interval_type) :: neighbour
        real(wp) :: moment, turn, flexibility, length, of_stretch, of_levels
        integer :: i, last
        logical :: stretches, levels

        do i = range(1), range(2)
            work%reach_own(i) = interval_type(work%load_size(i), abs(work%answers(i)%deflection))
        end do
        stretches = by_stretches .and. work%refined .and. range(1) == 0 .and. range(2) == size(beam%links) &
            .and. .not. allocated(beam%ground)
        levels = allocated(beam%ground) .and. range(1) == 0 .and. range(2) == size(beam%links)
        last = 0
        of_stretch = 0.0_wp
        of_levels = 0.0_wp
        do i = max(range(1), 1), min(range(2) + 1, size(beam%links))
            if (stretches .and. i > last) then
                last = end_of_stretch(work, i)
                of_stretch = shear_of_stretch(beam, work, i, last)
            else if (levels .and. i > last) then
                last = end_of_stretch(work, i)
                of_levels = 0.0_wp
                if (any(beam%links(i:last)%bending > 0.0_wp)) of_levels = (work%level(i - 1) + work%level(last)) &
                    /sum(beam%links(i:last)%length)/sum(beam%links(i:last)%bending)
            end if
            associate (link => beam%links(i), a => work%answers(i - 1), b => work%answers(i))
                ! Also the moments that imposed rotations and contact levels would make if they were held fast; on ground, where
                ! nodes that nothing holds may be next to a support, levels of the supports at the ends of a stretch of links
                turn = work%turn_size(i)
                if (.not. levels) turn = turn + (work%level(i) + work%level(i - 1))*link%inverse
                moment = max(abs(a%moment_right), abs(b%moment_left), turn*work%fixity(i), of_levels)
                if (allocated(beam%ground)) then
                    ! On ground what happens at one end is not seen far beyond 1/beta
                    flexibility = beam%ground(i)%faa + beam%ground(i)%fbb
                    length = link%length
                    if (link%bending > 0.0_wp) length = min(length, flexibility*length/link%bending)
                    neighbour = interval_type(2*moment/length, flexibility*length*moment)
                else
                    neighbour = interval_type(2*moment*link%inverse, work%reach(i)*moment)
                    if (stretches) neighbour%shear = min(neighbour%shear, of_stretch)
                end if
                if (i > range(1)) work%reach_own(i - 1) = passed_on(neighbour, work%reach_own(i - 1), .false.)
                if (i <= range(2)) work%reach_own(i) = passed_on(neighbour, work%reach_own(i), .false.)
            end associate
        end do
    end subroutine find_own_sizes

    !> Last link of the stretch that a link begins: nodes without support and restraint do not divide it
    pure function end_of_stretch(work, first) result(last)
        type(workspace_type), intent(in) :: work
        integer, intent(in) :: first
        integer :: last

        last = first
        do while (last < ubound(work%proximal_weight, 1))
            associate (node => work%nodes(last))
                if (node%held .or. abs(node%stiffness) > work%proximal_weight(last)) return
                if (is_restrained(node%kind)) return
            end associate
            last = last + 1
        end do
    end function end_of_stretch

    !> Size of the shear in a stretch as if it were one link: its inner nodes pass shears on, and nothing holds a link of it fast,
    !> however short it is and however far its support has gone
    pure function shear_of_stretch(beam, work, first, last) result(shear)
        type(beam_type), intent(in) :: beam
        type(workspace_type), intent(in) :: work
        !> Its links
        integer, intent(in) :: first, last
        real(wp) :: shear, length, bending, moment

        length = sum(beam%links(first:last)%length)
        bending = sum(beam%links(first:last)%bending)
        moment = max(maxval(abs(work%answers(first - 1:last - 1)%moment_right)), &
                     maxval(abs(work%answers(first:last)%moment_left)))
        if (bending > 0.0_wp) moment = max(moment, (sum(work%turn_size(first:last)) &
                                                    + (work%level(first - 1) + work%level(last))/length)/bending)
        shear = 2*moment/length
    end function shear_of_stretch

    !> Sizes at a node: its own, and those that come from its neighbour
    pure function passed_on(from, own, held) result(reach)
        type(interval_type), intent(in) :: from, own
        logical, intent(in) :: held
        type(interval_type) :: reach
        real(wp) :: share

        share = merge(0.5_wp, 1.0_wp, held)
        reach = interval_type(max(own%shear, share*from%shear), max(own%deflection, share*from%deflection))
    end function passed_on

    !> Are two sizes the same
    elemental function same(a, b)
        type(interval_type), intent(in) :: a, b
        logical :: same

        same = .not. (abs(a%shear - b%shear) > 0.0_wp .or. abs(a%deflection - b%deflection) > 0.0_wp)
    end function same

    !> Reactions from the equilibrium of the nodes, or from springs
    pure subroutine find_reactions(beam, acting, range, work)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: acting(:)
        !> First and last node
        integer, intent(in) :: range(2)
        type(workspace_type), intent(inout) :: work
        real(wp) :: force(support_block), error(support_block)
        integer :: i, j, from, to, n

        do from = range(1), range(2), support_block
            to = min(from + support_block - 1, range(2))
            do i = from, to
                j = i - from + 1
                call force_at_node(work, i, size(beam%links), force(j), error(j))
                ! For signs, rounding that comes from farther away counts as well
                error(j) = max(error(j), epsilon(1.0_wp)*work%shear_size(i))
            end do
            call share_forces(beam%supports, beam%order, beam%first, acting, [from, to], work%nodes, work%answers, &
                              work%deflection_size, force, error, work%reaction, work%reaction_error)
        end do
        if (.not. allocated(beam%turning)) return
        n = size(beam%links)
        do j = 1, size(beam%turning)
            ! For signs, rounding that comes from farther away counts as well
            associate (i => beam%turning(j))
                work%shear_size(n + j) = max(work%couple_size(j), work%shear_size(i)/2 &
                                              *maxval(beam%links(max(1, i):min(i + 1, n))%length))
                ! On ground, where more of it is passed on, so the turn of a spring
                if (allocated(beam%ground) .and. work%nodes(n + j)%stiffness > 0.0_wp) work%deflection_size(n + j) = &
                    max(work%deflection_size(n + j), work%shear_size(n + j)/work%nodes(n + j)%stiffness)
            end associate
        end do
        call share_forces(beam%supports, beam%order, beam%first, acting, [n + 1, n + size(beam%turning)], work%nodes, &
                          work%answers, work%deflection_size, work%couple, epsilon(1.0_wp)*work%shear_size(n + 1:), work%reaction, &
                          work%reaction_error)
    end subroutine find_reactions

    !> Force of all supports together at a node, from the shears beside it
    pure subroutine force_at_node(work, i, n, reaction, error)
        type(workspace_type), intent(in) :: work
        !> Node, and number of links
        integer, intent(in) :: i, n
        real(wp), intent(out) :: reaction, error
        real(wp) :: left, right

        left = 0.0_wp
        right = 0.0_wp
        error = epsilon(1.0_wp)*work%load_size(i)
        if (allocated(work%end_shear)) then
            if (i > 0) then
                left = work%end_shear(2, i)
                error = error + work%end_shear_error(2, i)
            end if
            if (i < n) then
                right = work%end_shear(1, i + 1)
                error = error + work%end_shear_error(1, i + 1)
            end if
        else
            if (i > 0) then
                left = work%shear(i)
                error = error + work%shear_error(i)
            end if
            if (i < n) then
                right = work%shear(i + 1)
                error = error + work%shear_error(i + 1)
            end if
        end if
        reaction = (work%loads(i)%shear - (left - right)) + work%proximal_weight(i)*(work%reference(i) - work%answers(i)%deflection)
    end subroutine force_at_node

end module gapbeam_reactions
