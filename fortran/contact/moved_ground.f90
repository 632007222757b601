!> A beam on the ground at a load factor, which moves supports and ground and lets axial forces grow, and under shares of these and
!> of its dead loads.
module gapbeam_moved_ground
    use gapbeam_kinds, only: wp
    use gapbeam_piece, only: combine_loads, no_load
    use gapbeam_ground, only: ground_type
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
        associate (begins => ground%moving%begins)
            ground%pieces%tension = tension_at(last_begun(begins, factor), factor)
            ground%pieces%compression = max(0.0_wp, -tension_at(last_begun(begins, greatest_near(factor)), greatest_near(factor)))
            do k = 1, size(begins)
                ground%pieces%compression = max(ground%pieces%compression, -tension_at(k, begins(k)))
            end do
        end associate
        if (.not. allocated(ground%moving%tension_change)) return
        associate (begins => ground%moving%begins, more_at_zero => ground%moving%tension_change(1, :), &
                   more => ground%moving%tension_change(2, :))
            ground%pieces%tension_change = more_at_zero + factor*more
            ground%pieces%compression = max(ground%pieces%compression, -(tension_at(last_begun(begins, greatest_near(factor)), &
                                                                                    greatest_near(factor)) &
                                                                         + more_at_zero + greatest_near(factor)*more))
            do k = 1, size(begins)
                ground%pieces%compression = max(ground%pieces%compression, -(tension_at(k, begins(k)) + more_at_zero &
                                                                             + begins(k)*more))
            end do
        end associate

    contains

        !> Tensions at a load factor on a stretch of their way
        pure function tension_at(stretch, factor) result(tension)
            integer, intent(in) :: stretch
            real(wp), intent(in) :: factor
            real(wp) :: tension(size(ground%pieces))

            associate (moving => ground%moving)
                tension(:) = moving%tension(1, :, stretch) + (factor - moving%begins(stretch))*moving%tension(2, :, stretch)
            end associate
        end function tension_at

    end subroutine move_ground

    !> The last stretch that begins before a load factor, or at it
    pure function last_begun(begins, factor) result(stretch)
        !> From 0 on, all of one sign
        real(wp), intent(in) :: begins(:), factor
        integer :: stretch, k

        stretch = 1
        do k = 2, size(begins)
            if (abs(begins(k)) > abs(factor)) exit
            stretch = k
        end do
    end function last_begun

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
