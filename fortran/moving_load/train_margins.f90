!> Margins of a contact state on an interval of train positions, as polynomials, and their roots.
!> The same of the work of the loads along a free motion.
!> the same of the work of the loads along a free motion
module gapbeam_train_margins
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: least_train_share
    use gapbeam_bernstein, only: sample_points, to_coefficients, halve, first_below, crossing, highest_degree
    use gapbeam_band, only: band_ok
    use gapbeam_law_margins, only: find_margins
    use gapbeam_kinematics, only: work_of_loads
    use gapbeam_workspace, only: workspace_type, set_loads
    use gapbeam_tolerances, only: sign_width
    use gapbeam_system, only: solve_and_refine
    use gapbeam_train, only: track_type, degree_of
    use gapbeam_train_intervals, only: interval_type
    use gapbeam_train_loads, only: place_train
    implicit none
    private
    public :: margins_type, sample_margins, sample_work, find_interval, are_zero

    !> Reactions and openings over a stretch, or work along a motion: all are right where none is below its rounding error
    type :: margins_type
        !> Coefficients over the rest of the interval, shape (0:degree, m), and rounding errors
        real(wp), allocatable :: b(:, :), slack(:)
        !> Which are looked at, the first `count` of them
        integer :: count = 0
    end type margins_type

contains

    !> Reactions and openings of a scheme from here to the end of an interval
    subroutine sample_margins(track, interval, now, closed, margins, work, solved)
        type(track_type), intent(inout) :: track
        type(interval_type), intent(in) :: interval
        real(wp), intent(in) :: now
        logical, intent(in) :: closed(:)
        type(margins_type), intent(inout) :: margins
        type(workspace_type), intent(inout) :: work
        !> Has the scheme a solution
        logical, intent(out) :: solved
        real(wp) :: points(0:degree_of(track%train)), values(0:degree_of(track%train), size(closed)), rounding(size(closed))
        real(wp) :: matrix(0:degree_of(track%train), 0:degree_of(track%train))
        integer :: k, p, n, state, place

        n = degree_of(track%train)
        points(:) = sample_points(n)
        matrix(:, :) = to_coefficients(n)
        margins%count = size(closed)
        margins%slack(:) = 0.0_wp
        solved = .false.
        do p = 0, n
            call place_train(track, interval, now + points(p)*(interval%to - now))
            call set_loads(track%beam, 1.0_wp, work)
            call solve_and_refine(track%beam, closed, work, state, place)
            if (state /= band_ok) return
            if (.not. all(abs(work%answers%deflection) <= huge(1.0_wp))) return
            call find_margins(track%beam%supports, closed, work%answers, work%deflection_size, work%reaction, &
                              work%reaction_error, values(p, :), rounding)
            margins%slack(:size(closed)) = max(margins%slack(:size(closed)), sign_width*rounding)
        end do
        do k = 1, size(closed)
            margins%b(0:n, k) = matmul(matrix, values(:, k))
        end do
        solved = .true.
    end subroutine sample_margins

    !> Work of the loads along a motion from here to the end of an interval
    subroutine sample_work(track, interval, now, motion, margins)
        type(track_type), intent(inout) :: track
        type(interval_type), intent(in) :: interval
        real(wp), intent(in) :: now, motion(0:)
        type(margins_type), intent(inout) :: margins
        real(wp) :: points(0:degree_of(track%train)), values(0:degree_of(track%train)), parts
        integer :: p, n

        n = degree_of(track%train)
        points(:) = sample_points(n)
        margins%count = 1
        margins%slack(1) = 0.0_wp
        do p = 0, n
            call place_train(track, interval, now + points(p)*(interval%to - now))
            call work_of_loads(track%beam, 1.0_wp, motion, [0, ubound(motion, 1)], values(p), parts)
            margins%slack(1) = max(margins%slack(1), sign_width*epsilon(1.0_wp)*parts)
        end do
        margins%b(0:n, 1) = matmul(to_coefficients(n), values)
    end subroutine sample_work

    !> The interval about a place on which nothing is below its rounding error
    subroutine find_interval(margins, n, u, begin, end, at_end)
        type(margins_type), intent(in) :: margins
        !> Degree, and the place, all as shares of what is left of the interval
        integer, intent(in) :: n
        real(wp), intent(in) :: u
        !> Ends of the interval; the second one 0 if there is none
        real(wp), intent(out) :: begin, end
        !> What comes to zero at its end
        logical, intent(inout) :: at_end(:)
        real(wp) :: left(0:highest_degree), right(0:highest_degree), lost, zero, zeros(margins%count)
        integer :: k

        begin = 0.0_wp
        end = 1.0_wp
        zeros(:) = 2.0_wp
        do k = 1, margins%count
            associate (b => margins%b(0:n, k), slack => margins%slack(k))
                if (all(b >= -slack)) cycle
                right(0:n) = b
                if (u > 0.0_wp) then
                    call halve(b, u, left(0:n), right(0:n))
                    if (right(0) < -slack) then
                        end = 0.0_wp
                        exit
                    end if
                    left(0:n) = left(n:0:-1)
                    lost = first_below(left(0:n), -slack)
                    if (lost <= 1.0_wp) begin = max(begin, u*(1 - lost))
                end if
                lost = first_below(right(0:n), -slack)
                if (lost > 1.0_wp) cycle
                zero = 0.0_wp
                if (right(0) > 0.0_wp) zero = crossing(right(0:n), min(first_below(right(0:n), 0.0_wp), lost), lost)
                zeros(k) = u + (1 - u)*zero
                end = min(end, zeros(k))
            end associate
        end do
        at_end(:) = .false.
        do k = 1, min(margins%count, size(at_end))
            at_end(k) = zeros(k) <= end + least_train_share .and. margins%count == size(at_end)
        end do
    end subroutine find_interval

    !> What is zero all the way
    pure function are_zero(margins, n, m) result(zero)
        type(margins_type), intent(in) :: margins
        integer, intent(in) :: n, m
        logical :: zero(m)
        integer :: k

        do k = 1, m
            zero(k) = all(abs(margins%b(0:n, k)) <= margins%slack(k))
        end do
    end function are_zero

end module gapbeam_train_margins
