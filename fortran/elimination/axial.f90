!> The axial system (u, N): a chain of bars, uncoupled from bending, present only with axial loads.
!>
!> Signs: displacement and forces positive to the right, N positive in tension. From the left every point sees
!> N = k u + n, the scalar counterpart of the sweep in gapbeam_band. Rigid supports and rigid bars are exact.
module gapbeam_axial
    use gapbeam_kinds, only: wp
    use gapbeam_require, only: checked, require
    implicit none
    private
    public :: solve_axial, axial_ok, axial_slides, axial_indeterminate

    !> Solved; nothing holds the beam lengthwise; a rigid stretch between two rigid supports
    integer, parameter :: axial_ok = 0, axial_slides = 1, axial_indeterminate = 2

contains

    !> Displacements, forces in the bars, reactions
    pure subroutine solve_axial(flexibility, elongation, force, stiffness, settlement, displacement, tension, reaction, state, &
                                place)
        !> int 1/EA of each bar, shape (n)
        real(wp), intent(in) :: flexibility(:)
        !> By how much each would be longer without force, shape (n)
        real(wp), intent(in) :: elongation(:)
        !> Applied force at each point, stiffness of its support (0: none, infinite: rigid) and the support's own
        !> displacement, shape (0:n)
        real(wp), intent(in) :: force(0:), stiffness(0:), settlement(0:)
        !> Displacement of each point and force of its support on the beam, shape (0:n)
        real(wp), intent(out) :: displacement(0:), reaction(0:)
        !> Normal force of each bar, shape (n)
        real(wp), intent(out) :: tension(:)
        !> One of the three states above, and the point where it was found
        integer, intent(out) :: state, place
        real(wp), allocatable :: k(:), n0(:)
        logical, allocatable :: fixed(:), rigid(:)
        real(wp) :: pull, divisor, left
        integer :: i, n

        n = size(flexibility)
        if (checked) then
            call require(all([size(force), size(stiffness), size(settlement)] == n + 1), "solve_axial: shapes")
            call require(all(flexibility >= 0.0_wp) .and. all(stiffness >= 0.0_wp), "solve_axial: below zero")
        end if
        allocate (k(0:n), n0(0:n), fixed(0:n), rigid(0:n))
        rigid = stiffness > huge(pull)
        state = axial_ok
        displacement = 0.0_wp
        reaction = 0.0_wp
        tension = 0.0_wp
        ! From the left: N left of point i is k(i) u + n0(i), or its displacement is already fixed
        k(0) = 0.0_wp
        n0(0) = 0.0_wp
        fixed(0) = .false.
        do i = 0, n
            place = i
            if (rigid(i) .and. fixed(i)) then
                state = axial_indeterminate
                return
            end if
            if (rigid(i)) displacement(i) = settlement(i)
            if (i == n) exit
            fixed(i + 1) = (rigid(i) .or. fixed(i)) .and. .not. flexibility(i + 1) > 0.0_wp
            if (fixed(i + 1)) then
                displacement(i + 1) = displacement(i) + elongation(i + 1)
                k(i + 1) = 0.0_wp
                n0(i + 1) = 0.0_wp
            else if (rigid(i) .or. fixed(i)) then
                k(i + 1) = 1/flexibility(i + 1)
                n0(i + 1) = -(displacement(i) + elongation(i + 1))/flexibility(i + 1)
            else
                divisor = 1/(1 + flexibility(i + 1)*(k(i) + stiffness(i)))
                k(i + 1) = (k(i) + stiffness(i))*divisor
                n0(i + 1) = (n0(i) - force(i) - stiffness(i)*settlement(i) - (k(i) + stiffness(i))*elongation(i + 1))*divisor
            end if
        end do
        if (.not. rigid(n) .and. .not. fixed(n)) then
            if (.not. k(n) + stiffness(n) > 0.0_wp) then
                state = axial_slides
                return
            end if
            displacement(n) = (force(n) + stiffness(n)*settlement(n) - n0(n))/(k(n) + stiffness(n))
        end if
        ! Back: N right of the last point is zero
        pull = 0.0_wp
        do i = n, 1, -1
            if (rigid(i) .or. .not. (k(i) > 0.0_wp .or. fixed(i))) then
                ! Without support on its left it is known by statics, and what is not loaded there has no rounding of the supports
                left = k(i)*displacement(i) + n0(i)
                if (stiffness(i) > 0.0_wp) reaction(i) = left - pull - force(i)
            else
                reaction(i) = -stiffness(i)*(displacement(i) - settlement(i))
                left = pull + force(i) + reaction(i)
            end if
            tension(i) = left
            if (.not. (rigid(i - 1) .or. fixed(i - 1))) displacement(i - 1) = (displacement(i) - elongation(i)) &
                - flexibility(i)*left
            pull = left
        end do
        if (stiffness(0) > 0.0_wp) reaction(0) = -pull - force(0)
    end subroutine solve_axial

end module gapbeam_axial
