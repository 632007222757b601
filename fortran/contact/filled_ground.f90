!> Ground whose force falls, and the like whose force never does.
module gapbeam_filled_ground
    use gapbeam_kinds, only: wp
    use gapbeam_layers, only: falls, falls_on, pieces_of_law, law_piece
    use gapbeam_ground, only: ground_type
    implicit none
    private
    public :: any_falls, peak_of, fill_valleys

contains

    !> Does the force of any ground fall
    pure function any_falls(ground) result(it_does)
        !> The beam and its ground
        type(ground_type), intent(in) :: ground
        logical :: it_does
        integer :: k

        it_does = .false.
        do k = 1, size(ground%layers)
            it_does = it_does .or. falls(ground%layers(k), ground%laws)
        end do
    end function any_falls

    !> The piece of a law on which the force of a layer falls first, more than there are: nowhere
    pure function peak_of(ground, layer) result(number)
        !> The beam and its ground, and which layer
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: layer
        integer :: number

        associate (l => ground%layers(layer))
            do number = 1, pieces_of_law(l)
                if (falls_on(law_piece(l, ground%laws, number))) return
            end do
        end associate
    end function peak_of

    !> Ground whose force never falls, and is nowhere less: from point to point of its laws the greatest force so far, and beyond
    !> the last one with the same slope
    pure subroutine fill_valleys(ground)
        !> The beam and its ground
        type(ground_type), intent(inout) :: ground
        real(wp) :: most(2)
        integer :: k, i

        do k = 1, size(ground%layers)
            if (.not. falls(ground%layers(k), ground%laws)) cycle
            most(:) = 0.0_wp
            do i = ground%layers(k)%law_first, ground%layers(k)%law_last
                associate (p => ground%laws(i))
                    most(:) = max(most, [p%force_a, p%force_b])
                    if (i < ground%layers(k)%law_last) then
                        p%slope_a = p%slope_a + (p%force_a - most(1))/p%way_a
                        p%slope_b = p%slope_b + (p%force_b - most(2))/p%way_b
                    end if
                    p%slope_a = max(0.0_wp, p%slope_a)
                    p%slope_b = max(0.0_wp, p%slope_b)
                    p%force_a = most(1)
                    p%force_b = most(2)
                end associate
            end do
        end do
    end subroutine fill_valleys

end module gapbeam_filled_ground
