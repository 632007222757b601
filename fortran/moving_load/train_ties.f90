!> Extreme values of a train at all places that tie.
module gapbeam_train_ties
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: same_tie
    use gapbeam_limits, only: most_extreme_ties
    use gapbeam_law, only: both
    implicit none
    private
    public :: tie_type, extreme_type, add_tie, drop_rounding

    !> Where an extreme value is: x, position of the train, value; 1 where it is the value left of x, 2 right of it (0: both). At an
    !> end of a stretch that does not hold there the position is one just inside, at which an axle that is near the end of the beam
    !> is on the same side of it
    type :: tie_type
        real(wp) :: value = 0.0_wp, x = 0.0_wp, position = 0.0_wp
        integer :: side = 0
        !> 1 or 2 where it is the first or last one of such a stretch
        integer :: limit = 0
        !> Where that ends, if the value stays the same on the way: x and position
        real(wp) :: x_end = 0.0_wp, position_end = 0.0_wp
    end type tie_type

    !> Extremes of a quantity, all ties
    type :: extreme_type
        integer :: number = 0
        type(tie_type) :: ties(most_extreme_ties)
    end type extreme_type

contains

    !> A support that acts one way has no reaction the other way, and where it comes to zero, or its opening, but by rounding: zero
    pure subroutine drop_rounding(of_reaction, side, rounding, extreme)
        !> Of a reaction, not an opening
        logical, intent(in) :: of_reaction
        !> 1 below, -1 above, 0 both
        integer, intent(in) :: side
        real(wp), intent(in) :: rounding
        type(extreme_type), intent(inout) :: extreme

        if (side == both) return
        where (abs(extreme%ties%value) <= rounding) extreme%ties%value = 0.0_wp
        if (.not. of_reaction) return
        where (side*extreme%ties%value < 0.0_wp) extreme%ties%value = 0.0_wp
    end subroutine drop_rounding

    !> Add where an extreme is, unless it is the place before: found twice, or what stays the same from stretch to stretch
    subroutine add_tie(extreme, tie)
        type(extreme_type), intent(inout) :: extreme
        type(tie_type), intent(in) :: tie
        integer :: q

        do q = 1, extreme%number
            associate (t => extreme%ties(q))
                if (same(t%x_end, t%position_end, tie%x, tie%position)) then
                    t%x_end = tie%x_end
                    t%position_end = tie%position_end
                    return
                else if (same(t%x, t%position, tie%x_end, tie%position_end)) then
                    t%x = tie%x
                    t%position = tie%position
                    t%side = tie%side
                    t%limit = tie%limit
                    return
                end if
            end associate
        end do
        if (extreme%number == most_extreme_ties) return
        extreme%number = extreme%number + 1
        extreme%ties(extreme%number) = tie

    contains

        !> Are two places and positions the same
        pure function same(x, position, other_x, other_position)
            real(wp), intent(in) :: x, position, other_x, other_position
            logical :: same

            same = abs(x - other_x) <= same_tie*max(1.0_wp, abs(x)) .and. &
                abs(position - other_position) <= same_tie*max(1.0_wp, abs(position))
        end function same

    end subroutine add_tie

end module gapbeam_train_ties
