!> Static indeterminacy of reactions: rigid stretches on more rigid supports than they need.
!>
!> Elastic parts have one state of forces only, since their energy is strictly convex. So the difference of two right states is
!> a moment that no load balances, in parts without flexibility: linear between nodes, with a kink up or down at rigid
!> supports that may push more or less, zero at hinges, and zero where such a part ends. The scheme is right for one reaction only
!> if there is no such moment but zero. From the left, moment and shear that such a difference may have at a node are a cone in the
!> plane, and there is one if it ever comes back to zero.
!>
!> An edge of a cone begins at a support, a hinge or a clamp, so its moment at places farther right has the sign that the order
!> of the nodes gives it. Only this order matters, and numbers of nodes stand for places: all of this is exact.
module gapbeam_static_indeterminacy
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_band, only: hinge, restrained, band_needs_pivoting
    use gapbeam_law, only: both, is_rigid
    use gapbeam_polyline, only: piece_that_acts
    use gapbeam_model, only: beam_type
    use gapbeam_search, only: refuse_scheme
    implicit none
    private
    public :: refuse_indeterminate, find_indeterminacy

    !> A convex cone in the plane of moment and shear: all sums of its rays with factors that are not negative
    type :: cone_type
        integer :: count = 0
        !> Whole numbers, shape (2, count at least); none is a sum of others
        real(wp) :: ray(2, 8) = 0.0_wp
    end type cone_type

contains

    !> Refuse a solved scheme if other reactions would do as well
    subroutine refuse_indeterminate(beam, closed, at_zero, error)
        !> As for find_indeterminacy
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), at_zero(:)
        !> gapbeam_indeterminate
        type(error_type), allocatable, intent(inout) :: error
        integer :: node

        call find_indeterminacy(beam, closed, at_zero, node)
        if (node >= 0) call refuse_scheme(beam, band_needs_pivoting, node, error)
    end subroutine refuse_indeterminate

    !> At which node it turns out that other reactions would do as well, -1 if there are none
    pure subroutine find_indeterminacy(beam, closed, at_zero, node)
        !> The beam, its scheme, and supports whose reaction or opening is zero, shape (size(beam%supports))
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), at_zero(:)
        integer, intent(out) :: node
        type(cone_type) :: before, here
        integer :: i

        node = -1
        ! A scheme that is solved is statically sound: others come from supports that touch without force
        if (.not. any(at_zero .and. (beam%supports%breakpoint > 0 .or. .not. closed))) return
        if (all(beam%links%bending > 0.0_wp)) return
        before = cone_type()
        do i = 0, size(beam%links)
            if (i > 0) call pass_link(beam, i, before)
            if (beam%kind(i) == hinge) call cut(before, [0.0_wp, 1.0_wp])
            call find_changes(beam, closed, at_zero, i, here)
            if (meet(before, here)) then
                node = i
                return
            end if
            call join(here, before)
        end do
    end subroutine find_indeterminacy

    !> From the left end of a link to its right one
    pure subroutine pass_link(beam, i, cone)
        type(beam_type), intent(in) :: beam
        integer, intent(in) :: i
        type(cone_type), intent(inout) :: cone

        associate (link => beam%links(i))
            if (link%bending > 0.0_wp) then
                cone = cone_type()
            else if (abs(link%faa) > 0.0_wp) then
                ! Rigid but for shear
                call cut(cone, [1.0_wp, 0.0_wp])
            else
                cone%ray(1, :cone%count) = cone%ray(1, :cone%count) + cone%ray(2, :cone%count)
            end if
        end associate
    end subroutine pass_link

    !> What supports and restraint of a node may add to the difference: kinks and steps of the moment
    pure subroutine find_changes(beam, closed, at_zero, i, changes)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), at_zero(:)
        integer, intent(in) :: i
        type(cone_type), intent(out) :: changes
        logical :: more, less
        integer :: j

        do j = beam%first(i), beam%first(i + 1) - 1
            call find_freedom(beam, closed, at_zero, beam%order(j), more, less)
            associate (side => beam%supports(beam%order(j))%side)
                associate (up => real(merge(1, side, side == both), wp))
                    if (more) call add([0.0_wp, up], changes)
                    if (less) call add([0.0_wp, -up], changes)
                end associate
            end associate
        end do
        if (beam%kind(i) == restrained .and. .not. beam%compliance(i) > 0.0_wp) then
            call add([1.0_wp, 0.0_wp], changes)
            call add([-1.0_wp, 0.0_wp], changes)
        end if
    end subroutine find_changes

    !> May a support push more, may it push less, with the beam where it is
    pure subroutine find_freedom(beam, closed, at_zero, k, more, less)
        type(beam_type), intent(in) :: beam
        logical, intent(in) :: closed(:), at_zero(:)
        integer, intent(in) :: k
        logical, intent(out) :: more, less
        real(wp) :: slope
        logical :: acts

        associate (s => beam%supports(k))
            if (s%breakpoint == 0) then
                more = is_rigid(s) .and. (s%side == both .or. closed(k) .or. at_zero(k))
                less = more .and. (s%side == both .or. (closed(k) .and. .not. at_zero(k)))
                return
            end if
            more = .false.
            less = .false.
            if (s%passed) return
            if (at_zero(k)) then
                ! At the breakpoint: on along a rigid piece that begins here, or back along one that ends here
                more = is_rigid(s)
                less = s%before > huge(slope)
            else
                call piece_that_acts(beam%supports, closed, k, acts, slope)
                more = acts .and. slope > huge(slope)
                if (more .and. s%more .and. closed(k)) more = .not. at_zero(k + 1)
                less = more
            end if
        end associate
    end subroutine find_freedom

    ! Cones

    !> Is a ray in a cone
    pure function contains_ray(cone, ray) result(within)
        type(cone_type), intent(in) :: cone
        real(wp), intent(in) :: ray(2)
        logical :: within
        real(wp) :: turn
        integer :: j, k

        within = .true.
        do j = 1, cone%count
            if (.not. abs(cross(cone%ray(:, j), ray)) > 0.0_wp .and. dot_product(cone%ray(:, j), ray) > 0.0_wp) return
            do k = 1, cone%count
                turn = cross(cone%ray(:, j), cone%ray(:, k))
                ! Between two rays that are less than half a turn apart
                if (turn > 0.0_wp .and. cross(cone%ray(:, j), ray) >= 0.0_wp .and. cross(ray, cone%ray(:, k)) >= 0.0_wp) return
            end do
        end do
        within = .false.
    end function contains_ray

    !> Signed area between two rays
    pure function cross(a, b) result(area)
        real(wp), intent(in) :: a(2), b(2)
        real(wp) :: area

        area = a(1)*b(2) - a(2)*b(1)
    end function cross

    !> Add a ray, and leave out those that are sums of others then
    pure subroutine add(ray, cone)
        real(wp), intent(in) :: ray(2)
        type(cone_type), intent(inout) :: cone
        type(cone_type) :: others
        integer :: k, j

        if (contains_ray(cone, ray)) return
        cone%count = cone%count + 1
        cone%ray(:, cone%count) = ray
        k = 1
        do while (k <= cone%count)
            others = cone_type()
            do j = 1, cone%count
                if (j == k) cycle
                others%count = others%count + 1
                others%ray(:, others%count) = cone%ray(:, j)
            end do
            if (contains_ray(others, cone%ray(:, k))) then
                cone = others
            else
                k = k + 1
            end if
        end do
    end subroutine add

    !> Add all of one cone to another
    pure subroutine join(from, cone)
        type(cone_type), intent(in) :: from
        type(cone_type), intent(inout) :: cone
        integer :: k

        do k = 1, from%count
            call add(from%ray(:, k), cone)
        end do
    end subroutine join

    !> What a cone has of a line
    pure subroutine cut(cone, along)
        type(cone_type), intent(inout) :: cone
        !> The line
        real(wp), intent(in) :: along(2)
        type(cone_type) :: left

        if (contains_ray(cone, along)) call add(along, left)
        if (contains_ray(cone, -along)) call add(-along, left)
        cone = left
    end subroutine cut

    !> Has a cone, turned by half a turn, more than zero in common with another: an edge of one of them, then
    pure function meet(cone, other) result(so)
        type(cone_type), intent(in) :: cone, other
        logical :: so
        integer :: k

        so = .false.
        do k = 1, cone%count
            so = so .or. contains_ray(other, -cone%ray(:, k))
        end do
        do k = 1, other%count
            so = so .or. contains_ray(cone, -other%ray(:, k))
        end do
    end function meet

end module gapbeam_static_indeterminacy
