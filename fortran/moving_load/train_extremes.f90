!> Largest value among candidates while a train goes over a beam, exact in place and position.
module gapbeam_train_extremes
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: train_equal, train_rounding
    use gapbeam_bernstein, only: value_of
    use gapbeam_patch, only: greatest_on_patch
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_train, only: track_type, least_distance
    use gapbeam_train_cells, only: cell_type, cells_type, cell_ends, x_in_cell
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_candidates, only: candidate_type, candidates_type, upper_bound
    use gapbeam_train_prescribed_deflections, only: keep_prescribed
    use gapbeam_train_ties, only: tie_type, extreme_type, add_tie
    implicit none
    private
    public :: find_extreme, ends_of

    !> How far inside a stretch that does not hold at its first or last position, in least distances
    real(wp), parameter :: inside(0:2) = [0.0_wp, 2.0_wp, -2.0_wp]

contains

    !> The largest value among candidates, and where it is
    subroutine find_extreme(assembled, track, traversal, cells, candidates, which, power, of_deflection, extreme)
        !> The beam, the train and its way
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(in) :: track
        type(traversal_type), intent(in) :: traversal
        !> What the beam is cut into, and what may be the largest there or at a support
        type(cells_type), intent(in) :: cells
        type(candidates_type), intent(in) :: candidates
        !> 1 largest, 2 smallest
        integer, intent(in) :: which
        !> Exponent of the unit
        integer, intent(in) :: power
        !> Of the beam's deflection
        logical, intent(in) :: of_deflection
        type(extreme_type), intent(out) :: extreme
        type(tie_type) :: tie
        real(wp) :: best, value, v, u, found(3, candidates%number), upper(candidates%number)
        integer :: q, next, step

        best = candidates%known
        do q = 1, candidates%number
            upper(q) = upper_bound(candidates%list(q)%patch)
        end do
        found(1, :) = -huge(1.0_wp)
        do step = 1, candidates%number
            next = maxloc(upper, 1)
            if (upper(next) < best - train_equal*candidates%largest) exit
            associate (one => candidates%list(next))
                call greatest_on_patch(one%patch, best - train_equal*candidates%largest, value, v, u, &
                                       ends_of(track, traversal, cells, one%cell, one%stretch))
            end associate
            found(:, next) = [value, v, u]
            best = max(best, value)
            upper(next) = -huge(1.0_wp)
        end do
        ! In their order, but that what is greater on the beam by more than rounding comes first
        next = 1
        if (candidates%number > 0) next = maxloc(found(1, :), 1)
        do step = 0, candidates%number
            q = step
            if (step == 0) then
                if (candidates%number == 0) return
                if (candidates%list(next)%cell%piece == 0) cycle
                if (.not. any(found(1, :next - 1) >= best - train_equal*candidates%largest .and. &
                              found(1, :next - 1) < found(1, next) - train_rounding*candidates%largest)) cycle
                q = next
            end if
            if (found(1, q) < best - train_equal*candidates%largest) cycle
            tie%value = merge(found(1, q), -found(1, q), which == 1)
            if (of_deflection) call keep_prescribed(track%beam, node_at(candidates%list(q)%cell, found(2, q)), &
                                                    train_equal*candidates%largest, tie%value)
            tie%value = scale(tie%value, power)
            call place_tie(candidates%list(q), found(2, q), found(3, q), train_equal*candidates%largest, tie)
            call add_tie(extreme, tie)
        end do
        do q = 1, extreme%number
            extreme%ties(q)%position = extreme%ties(q)%position + inside(extreme%ties(q)%limit)*least_distance(track)
        end do

    contains

        !> Node at an end of a cell, -1 if there is none
        pure function node_at(cell, v) result(node)
            type(cell_type), intent(in) :: cell
            real(wp), intent(in) :: v
            integer :: node

            node = -1
            if (v <= 0.0_wp .and. cell%left == 0) node = assembled%node_of_point(cell%piece - 1)
            if (v >= 1.0_wp .and. cell%right == 0) node = assembled%node_of_point(cell%piece)
        end function node_at

        !> Where a value is
        subroutine place_tie(candidate, v, share, slack, tie)
            type(candidate_type), intent(in) :: candidate
            real(wp), intent(in) :: v, share
            !> Values that differ by less are equal
            real(wp), intent(in) :: slack
            type(tie_type), intent(inout) :: tie
            real(wp) :: value, u, from, to
            logical :: flat
            integer :: j

            u = share
            associate (whole => traversal%to(candidate%stretch) - traversal%from(candidate%stretch))
                if (u*whole <= least_distance(track)) u = 0.0_wp
                if ((1 - u)*whole <= least_distance(track) .and. u > 0.0_wp) u = 1.0_wp
            end associate
            value = value_of([(value_of(candidate%patch%b(0:candidate%patch%along, j), v), j=0, candidate%patch%across)], u)
            associate (q => candidate%stretch, interval => traversal%intervals(traversal%interval(candidate%stretch)), &
                       cell => candidate%cell, patch => candidate%patch)
                flat = .true.
                do j = 0, patch%across
                    flat = flat .and. abs(value_of(patch%b(0:patch%along, j), v) - value) <= slack
                end do
                if (flat) u = 0.0_wp
                call place_value(q, cell, v, u, tie%x, tie%position)
                call place_value(candidate%last, cell, v, merge(1.0_wp, u, flat), tie%x_end, tie%position_end)
                tie%limit = 0
                if (u >= 1.0_wp .and. traversal%to(q) >= interval%to .and. .not. interval%holds_to) tie%limit = 2
                if (u <= 0.0_wp .and. traversal%from(q) <= interval%from .and. .not. interval%holds_from) tie%limit = 1
                tie%side = 0
                if (cell%piece == 0) return
                if (v >= 1.0_wp) tie%side = 1
                if (v <= 0.0_wp) tie%side = 2
                ! Between a support and an axle that comes to it there is a shear that neither has when it is there
                call cell_ends(track, cells, cell, tie%position, from, to)
                if (to - from > least_distance(track)) return
                if (u <= 0.0_wp) tie%limit = 1
                if (u >= 1.0_wp) tie%limit = 2
                ! It is on that side of the support on which the axle is
                if (cell%left == 0) tie%side = 2
                if (cell%right == 0) tie%side = 1
            end associate
        end subroutine place_tie

        !> x and position of a place in a cell
        subroutine place_value(q, cell, v, u, x, position)
            integer, intent(in) :: q
            type(cell_type), intent(in) :: cell
            real(wp), intent(in) :: v, u
            real(wp), intent(out) :: x, position

            x = 0.0_wp
            position = traversal%from(q) + u*(traversal%to(q) - traversal%from(q))
            if (u >= 1.0_wp) position = traversal%to(q)
            if (cell%piece == 0) return
            x = x_in_cell(track, cells, cell, position, v)
        end subroutine place_value

    end subroutine find_extreme

    !> Ends of a cell at the first and the last position of a stretch
    pure function ends_of(track, traversal, cells, cell, stretch) result(ends)
        type(track_type), intent(in) :: track
        type(traversal_type), intent(in) :: traversal
        type(cells_type), intent(in) :: cells
        !> One of them, or without a piece that of a support, and a stretch of the traversal
        type(cell_type), intent(in) :: cell
        integer, intent(in) :: stretch
        !> x in the user's units, shape (2, 2): of the left and right end, at the first and last position
        real(wp) :: ends(2, 2)

        ends(:, :) = 0.0_wp
        if (cell%piece == 0) return
        call cell_ends(track, cells, cell, traversal%from(stretch), ends(1, 1), ends(2, 1))
        call cell_ends(track, cells, cell, traversal%to(stretch), ends(1, 2), ends(2, 2))
    end function ends_of

end module gapbeam_train_extremes
