!> A beam on the ground at a load factor, which moves supports and ground and lets axial forces grow, and under shares of these and
!> of its dead loads.
module gapbeam_moved_ground
    use gapbeam_kinds, only: wp
    use gapbeam_piece, only: piece_type, combine_loads, no_load
    use gapbeam_ground, only: ground_type, moving_type
    implicit none
    private
    public :: move_ground, under_share, under_loads

contains

    !> Move supports and ground to where they are at a load factor, with the axial forces there
    pure subroutine move_ground(ground, factor)
        !> As it is at any factor
        type(ground_type), intent(inout) :: ground
        real(wp), intent(in) :: factor
        integer :: k

        if (.not. allocated(ground%moving)) return
        associate (moving => ground%moving, layers => ground%layers)
            ground%beam%supports%contact = moving%supports(1, :) + factor*moving%supports(2, :)
            layers%contact_a = moving%layers(1, 1, :) + factor*moving%layers(2, 1, :)
            layers%contact_b = moving%layers(1, 2, :) + factor*moving%layers(2, 2, :)
        end associate
        if (.not. allocated(ground%moving%tension)) return
        associate (moving => ground%moving, pieces => ground%pieces)
            pieces%tension = tension_at(moving, factor)
            pieces%tension_change = change_at(moving, factor)
            pieces%compression = 0.0_wp
            pieces%pull = 0.0_wp
            call cut_for(tension_at(moving, greatest_near(factor)), change_at(moving, greatest_near(factor)), pieces)
            do k = 1, size(moving%begins)
                call cut_for(tension_at(moving, moving%begins(k)), change_at(moving, moving%begins(k)), pieces)
            end do
        end associate
    end subroutine move_ground

    !> Tensions at a load factor
    pure function tension_at(moving, factor) result(tension)
        type(moving_type), intent(in) :: moving
        real(wp), intent(in) :: factor
        real(wp) :: tension(size(moving%tension, 2))
        integer :: k, last

        ! Load factors from 0 on are all of one sign
        last = 1
        do k = 2, size(moving%begins)
            if (abs(moving%begins(k)) > abs(factor)) exit
            last = k
        end do
        tension(:) = moving%tension(1, :, last) + (factor - moving%begins(last))*moving%tension(2, :, last)
    end function tension_at

    !> By how much they are greater at the right ends of the pieces
    pure function change_at(moving, factor) result(change)
        type(moving_type), intent(in) :: moving
        real(wp), intent(in) :: factor
        real(wp) :: change(size(moving%tension, 2))

        change(:) = 0.0_wp
        if (allocated(moving%tension_change)) change(:) = moving%tension_change(1, :) + factor*moving%tension_change(2, :)
    end function change_at

    !> Let a piece be cut for an axial force that it comes under
    elemental subroutine cut_for(tension, change, piece)
        !> At the left end, and by how much it is greater at the right one
        real(wp), intent(in) :: tension, change
        type(piece_type), intent(inout) :: piece

        piece%compression = max(piece%compression, -tension, -(tension + change))
        if (abs(change) > 0.0_wp) piece%pull = max(piece%pull, tension, tension + change)
    end subroutine cut_for

    !> Load factor for which a beam is cut at those near another one: the next power of 4, so that zones that are carried from one
    !> to another stay short enough
    pure function greatest_near(factor) result(greatest)
        real(wp), intent(in) :: factor
        real(wp) :: greatest

        greatest = 1.0_wp
        do while (greatest < abs(factor))
            greatest = 4*greatest
        end do
        greatest = sign(greatest, factor)
    end function greatest_near

    !> The beam under a share of its axial forces
    pure function under_share(ground, share) result(changed)
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: share
        type(ground_type) :: changed

        changed = ground
        associate (given => ground%pieces%tension, of_ground => ground%pieces%slope_stiffness)
            changed%pieces%tension = of_ground + share*(given - of_ground)
            changed%pieces%tension_change = share*ground%pieces%tension_change
        end associate
    end function under_share

    !> The beam under a share of its dead loads, or some times as many, and at a load factor
    pure function under_loads(ground, dead, factor) result(changed)
        type(ground_type), intent(in) :: ground
        real(wp), intent(in) :: dead, factor
        type(ground_type) :: changed

        changed = ground
        call move_ground(changed, factor)
        if (.not. abs(dead - 1) > 0.0_wp) return
        changed%dead(:) = combine_loads(no_load, ground%dead, dead)
        changed%beam%force(1, :) = dead*ground%beam%force(1, :)
        changed%beam%couple(1, :) = dead*ground%beam%couple(1, :)
    end function under_loads

end module gapbeam_moved_ground
