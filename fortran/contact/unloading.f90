!> Laws that unload parallel to their first piece, written anew from where they are.
!>
!> A support that pushes one way is set back: its breakpoints up to where it is become one. One that holds both ways is springs
!> side by side, each with a slider (Prandtl 1928, Iwan 1967): at every breakpoint one slides, which has its two limits at U(i) and
!> L(i) in the order L(n) .. L(1) U(1) .. U(n). Beyond one of its limits a slider goes along: that limit is where the node is, the
!> other as far from it as ever. So breakpoints move, but keep their order and the slopes between them (Masing's rule).
module gapbeam_unloading
    use gapbeam_kinds, only: wp
    use gapbeam_polyline, only: node_support_type, piece_that_acts, last_breakpoint
    implicit none
    private
    public :: unload, rewrite_laws, holds_both_ways

contains

    !> Does a law that unloads so hold both ways: before its first breakpoint it does something
    elemental function holds_both_ways(first) result(it_does)
        !> Its first breakpoint
        type(node_support_type), intent(in) :: first
        logical :: it_does

        it_does = first%breakpoint == 1 .and. (abs(first%before) > 0.0_wp .or. abs(first%force) > 0.0_wp)
    end function holds_both_ways

    !> Write a law that unloads parallel to its first piece anew, from where it is: its breakpoints up to there become one
    pure subroutine rewrite_law(supports, closed, k, top, first_slope, deflection, reaction)
        type(node_support_type), intent(inout) :: supports(:)
        logical, intent(in) :: closed(:)
        !> First breakpoint of the law, and the last one that is closed, a later one
        integer, intent(in) :: k, top
        !> Slope along which it unloads
        real(wp), intent(in) :: first_slope
        !> Of the node beside the support's own movement; reaction, used where the piece is vertical
        real(wp), intent(in) :: deflection, reaction
        real(wp) :: at, force, slope
        logical :: acts

        call piece_that_acts(supports, closed, top, acts, slope)
        associate (s => supports)
            at = deflection
            if (abs(slope) > huge(slope)) then
                at = s(top)%contact
                force = s(k)%side*reaction
            else
                force = s(top)%force + slope*s(top)%side*(at - s(top)%contact)
            end if
            s(k)%contact = at
            if (abs(first_slope) <= huge(slope)) s(k)%contact = at - s(k)%side*force/first_slope
            s(k + 1:top)%contact = at
            s(k + 1:top)%force = force
            s(k + 1:top)%stiffness = s(top)%stiffness
            s(k + 2:top)%before = s(top)%stiffness
            s(k + 2:top)%passed = .true.
            s(k + 1)%before = first_slope
        end associate
    end subroutine rewrite_law

    !> Let the sliders of a law go along that are beyond their limits
    pure subroutine move_sliders(law, closed, deflection)
        !> All its breakpoints, those of the lower limits first
        type(node_support_type), intent(inout) :: law(:)
        !> How many of them are closed
        integer, intent(in) :: closed
        !> Of the node beside the support's own movement
        real(wp), intent(in) :: deflection
        integer :: i, j, k, n, sliding
        real(wp) :: width

        n = size(law)/2
        ! Upper limits are law(n + i), lower ones law(n + 1 - i)
        sliding = abs(closed - n)
        if (sliding == 0) return
        k = merge(closed, closed + 1, closed > n)
        ! The node is on the piece beyond the outermost limit that was passed
        associate (last => law(k))
            last%force = last%force + merge(last%stiffness, last%before, closed > n)*(deflection - last%contact)
        end associate
        do i = 1, sliding
            associate (upper => law(n + i), lower => law(n + 1 - i))
                width = upper%contact - lower%contact
                if (closed > n) then
                    upper%contact = deflection
                    lower%contact = deflection - width
                else
                    lower%contact = deflection
                    upper%contact = deflection + width
                end if
            end associate
        end do
        do j = k, 2*n - 1
            law(j + 1)%force = law(j)%force + law(j)%stiffness*(law(j + 1)%contact - law(j)%contact)
        end do
        do j = k, 2, -1
            law(j - 1)%force = law(j)%force - law(j)%before*(law(j)%contact - law(j - 1)%contact)
        end do
    end subroutine move_sliders

    !> Write the law of a support that turns back anew, from where it is, and tell which of its breakpoints change with that
    pure subroutine unload(supports, closed, k, first_slope, deflection, reaction, changed)
        type(node_support_type), intent(inout) :: supports(:)
        logical, intent(in) :: closed(:)
        !> First breakpoint of the law
        integer, intent(in) :: k
        !> As for rewrite_law
        real(wp), intent(in) :: first_slope, deflection, reaction
        !> First and last breakpoint that open or close where it turns back
        integer, intent(out) :: changed(2)
        integer :: last, count_closed, middle

        last = last_breakpoint(supports, k)
        count_closed = count(closed(k:last))
        if (holds_both_ways(supports(k))) then
            middle = (last - k + 1)/2
            call move_sliders(supports(k:last), count_closed, deflection)
            changed = k - 1 + [min(count_closed, middle) + 1, max(count_closed, middle)]
        else
            call rewrite_law(supports, closed, k, k - 1 + count_closed, first_slope, deflection, reaction)
            changed = [k + 1, k - 1 + count_closed]
        end if
    end subroutine unload

    !> The same for all laws beyond their first breakpoint that unload so, and for those that hold both ways
    pure subroutine rewrite_laws(supports, closed, keeps_set, first_slope, deflection, reaction)
        type(node_support_type), intent(inout) :: supports(:)
        logical, intent(in) :: closed(:)
        !> Which do, and as for rewrite_law, each of shape (size(supports))
        logical, intent(in) :: keeps_set(:)
        real(wp), intent(in) :: first_slope(:), deflection(:), reaction(:)
        integer :: k, last, top

        k = 1
        do while (k <= size(supports))
            last = last_breakpoint(supports, k)
            top = k - 1 + count(closed(k:last))
            if (keeps_set(k) .and. holds_both_ways(supports(k))) then
                call move_sliders(supports(k:last), top - k + 1, deflection(k))
            else if (keeps_set(k) .and. top > k) then
                call rewrite_law(supports, closed, k, top, first_slope(k), deflection(k), sum(reaction(k:last)))
            end if
            k = last + 1
        end do
    end subroutine rewrite_laws

end module gapbeam_unloading
