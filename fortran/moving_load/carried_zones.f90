!> Zones of contact of a beam with a train on it, carried to the pieces of the same beam with the train elsewhere: a start there.
module gapbeam_carried_zones
    use gapbeam_kinds, only: wp
    use gapbeam_ground_steps, only: border_of_step
    use gapbeam_ground, only: ground_type, new_zones, resize, steps_of_piece
    use gapbeam_ground_start, only: ground_start_type
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_train_on_beam, only: end_of_beam
    implicit none
    private
    public :: carry_zones

    !> Ends of zones as near as this share of the beam to the end of a piece are there
    real(wp), parameter :: at_end = 2.0_wp**(-40)

contains

    !> Take zones to the pieces of another beam: at the same places the same acts
    subroutine carry_zones(from, start, to, ground, carried)
        !> Where they were found, and what they are
        type(assembled_type), intent(in) :: from
        type(ground_start_type), intent(in) :: start
        !> The other beam, with the same ground, in the same units; and its ground
        type(assembled_type), intent(in) :: to
        type(ground_type), intent(in) :: ground
        type(ground_start_type), intent(out) :: carried
        real(wp), allocatable :: right(:)
        integer, allocatable :: steps(:)
        real(wp) :: slack
        integer :: i, j, m

        slack = at_end*end_of_beam(from)
        associate (zones => start%zones)
            allocate (right(size(zones%piece)), steps(size(ground%pieces)))
            do i = 1, size(right)
                right(i) = point_x(from, zones%piece(i))
                if (i == size(right)) cycle
                if (zones%piece(i + 1) == zones%piece(i)) then
                    right(i) = point_x(from, zones%piece(i) - 1) + scale(zones%to(i), from%units%length)
                end if
            end do
            do j = 1, size(steps)
                steps(j) = steps_of_piece(ground, j)
            end do
            call new_zones(sum(steps) + size(zones%piece), size(zones%acts, 1), steps, carried%zones)
        end associate
        allocate (carried%closed, source=start%closed)
        m = 0
        i = 1
        do j = 1, size(steps)
            call cut_piece(j)
        end do
        call resize(carried%zones, m, m)

    contains

        !> The stretches of a piece
        subroutine cut_piece(piece)
            integer, intent(in) :: piece
            real(wp) :: begin, left, next, step_end, length
            integer :: k, step

            begin = point_x(to, piece - 1)
            length = ground%pieces(piece)%length
            left = 0.0_wp
            step = 1
            do while (step <= steps(piece))
                do while (i < size(right))
                    if (right(i) > begin + scale(left, to%units%length) + slack) exit
                    i = i + 1
                end do
                k = last_alike(i, point_x(to, piece) - slack)
                next = length
                if (right(k) < point_x(to, piece) - slack) next = scale(right(k) - begin, -to%units%length)
                step_end = border_of_step(ground%pieces(piece), step, steps(piece))
                if (next >= step_end - scale(slack, -to%units%length)) then
                    next = step_end
                    step = step + 1
                end if
                if (m == size(carried%zones%piece)) call resize(carried%zones, 2*m, m)
                m = m + 1
                carried%zones%piece(m) = piece
                carried%zones%from(m) = left
                carried%zones%to(m) = next
                carried%zones%acts(:, m) = start%zones%acts(:, i)
                carried%zones%start(:, m) = start%zones%start(:, i)
                left = next
            end do
        end subroutine cut_piece

        !> The last stretch from one on, up to a place, in which the same acts
        pure function last_alike(first, until) result(last)
            integer, intent(in) :: first
            real(wp), intent(in) :: until
            integer :: last

            last = first
            do while (last < size(right))
                if (right(last) >= until) exit
                if (any(start%zones%acts(:, last + 1) /= start%zones%acts(:, first))) exit
                last = last + 1
            end do
        end function last_alike

    end subroutine carry_zones

end module gapbeam_carried_zones
