!> Steps of parts that have hardly begun, which settle far faster than they grow: extrapolation of the linearly implicit Euler rule
!> (Deuflhard; Hairer and Wanner, Solving ordinary differential equations II, IV.9). Rates depend on nothing but where parts end.
module gapbeam_ground_along_stiff
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: slip_settled
    use gapbeam_ground_along, only: ground_along_type, rates_type, find_rates
    implicit none
    private
    public :: take_stiff_step

    !> Columns of the extrapolation
    integer, parameter :: most_columns = 16

    !> Parts that end inside a bar; do these ends lie nearer to the right end of the bar, from which they are told then
    type :: ends_type
        integer, allocatable :: inside(:)
        logical, allocatable :: from_right(:)
    end type ends_type

contains

    !> One step
    pure subroutine take_stiff_step(ground, step, done)
        type(ground_along_type), intent(inout) :: ground
        real(wp), intent(in) :: step
        !> False where it is too long; the ground is as it was then
        logical, intent(out) :: done
        type(ends_type) :: ends
        real(wp), allocatable :: start(:), table(:, :), size_of(:), slopes(:, :), inverse(:, :)
        logical :: sound
        integer :: i, j, k, m, n

        m = size(ground%parts)
        n = size(ground%displacement)
        allocate (ends%inside, source=pack([(k, k=1, m - 1)], ground%parts(2:)%bar == ground%parts(:m - 1)%bar))
        allocate (ends%from_right, source=ground%parts(ends%inside)%back < ground%parts(ends%inside)%to)
        associate (q => size(ends%inside), parts => ground%parts(ends%inside))
            allocate (start(q + m + n), size_of(q + m + n), table(q + m + n, most_columns))
            start(:) = [merge(parts%back, parts%to, ends%from_right), ground%parts%force, ground%displacement]
            size_of(:q) = 1.0_wp
            size_of(q + 1:q + m) = max(maxval(abs(ground%parts%force)), maxval(ground%limit))
            size_of(q + m + 1:) = size_of(q + 1)*maxval(ground%softness) + maxval(abs(ground%displacement))
        end associate
        call find_slopes(ground, ends, start, slopes, sound)
        done = .false.
        if (.not. sound) return
        do i = 1, most_columns
            call invert(-step/i*slopes, inverse)
            call euler(ground, ends, start, step/i, i, inverse, table(:, i), sound)
            if (.not. sound) return
            do j = i - 1, 1, -1
                table(:, j) = table(:, j + 1) + (table(:, j + 1) - table(:, j))*(real(j, wp)/(i - j))
            end do
            if (i == 1) cycle
            if (all(abs(table(:, 1) - table(:, 2)) <= slip_settled*size_of)) then
                call put(ends, table(:, 1), ground)
                ground%longer(:) = ground%longer + step*ground%longer_rate
                done = .true.
                return
            end if
        end do
    end subroutine take_stiff_step

    !> The rule with some substeps
    pure subroutine euler(ground, ends, start, step, number, inverse, end, sound)
        type(ground_along_type), intent(in) :: ground
        type(ends_type), intent(in) :: ends
        !> Values at the beginning, length and number of the substeps, and the inverse of one less a step of the slopes
        real(wp), intent(in) :: start(:), step
        integer, intent(in) :: number
        real(wp), intent(in) :: inverse(:, :)
        real(wp), intent(out) :: end(:)
        logical, intent(out) :: sound
        real(wp) :: rate(size(end))
        integer :: i

        end(:) = start
        do i = 1, number
            call find(ground, ends, end, rate, sound)
            if (.not. sound) return
            associate (q => size(ends%inside))
                end(:q) = end(:q) + step*matmul(inverse, rate(:q))
                end(q + 1:) = end(q + 1:) + step*rate(q + 1:)
            end associate
        end do
    end subroutine euler

    !> Slopes of the rates of the ends over the ends
    pure subroutine find_slopes(ground, ends, start, slopes, sound)
        type(ground_along_type), intent(in) :: ground
        type(ends_type), intent(in) :: ends
        real(wp), intent(in) :: start(:)
        real(wp), allocatable, intent(out) :: slopes(:, :)
        logical, intent(out) :: sound
        real(wp) :: there(size(start)), rate(size(start)), other(size(start))
        integer :: i

        associate (q => size(ends%inside))
            allocate (slopes(q, q), source=0.0_wp)
            call find(ground, ends, start, rate, sound)
            do i = 1, q
                if (.not. sound) return
                there(:) = start
                there(i) = start(i)*(1 + sqrt(epsilon(1.0_wp)))
                call find(ground, ends, there, other, sound)
                slopes(:, i) = (other(:q) - rate(:q))/(there(i) - start(i))
            end do
        end associate
    end subroutine find_slopes

    !> Rates of all values
    pure subroutine find(ground, ends, values, rate, sound)
        type(ground_along_type), intent(in) :: ground
        type(ends_type), intent(in) :: ends
        real(wp), intent(in) :: values(:)
        real(wp), intent(out) :: rate(:)
        !> False where a part has no length left
        logical, intent(out) :: sound
        type(ground_along_type) :: there
        type(rates_type) :: rates

        rate(:) = 0.0_wp
        sound = all(values(:size(ends%inside)) > 0.0_wp)
        if (.not. sound) return
        there = ground
        call put(ends, values, there)
        call find_rates(there, rates)
        sound = .not. (rates%lost .or. any(rates%begins))
        if (.not. sound) return
        rate(:) = [merge(-rates%to(ends%inside), rates%to(ends%inside), ends%from_right), rates%force, rates%displacement]
    end subroutine find

    !> Put values in their places
    pure subroutine put(ends, values, ground)
        type(ends_type), intent(in) :: ends
        real(wp), intent(in) :: values(:)
        type(ground_along_type), intent(inout) :: ground

        associate (q => size(ends%inside), m => size(ground%parts))
            ground%parts(ends%inside)%to = merge(1 - values(:q), values(:q), ends%from_right)
            ground%parts(ends%inside)%back = merge(values(:q), 1 - values(:q), ends%from_right)
            ground%parts%force = values(q + 1:q + m)
            ground%displacement(:) = values(q + m + 1:)
        end associate
    end subroutine put

    !> Inverse of one and a small matrix, by elimination with row pivoting
    pure subroutine invert(matrix, inverse)
        real(wp), intent(in) :: matrix(:, :)
        real(wp), allocatable, intent(out) :: inverse(:, :)
        real(wp) :: both(size(matrix, 1), 2*size(matrix, 1)), row(2*size(matrix, 1))
        integer :: i, k, p, q

        q = size(matrix, 1)
        both(:, :) = 0.0_wp
        both(:, :q) = matrix
        do i = 1, q
            both(i, i) = both(i, i) + 1
            both(i, q + i) = 1.0_wp
        end do
        do k = 1, q
            p = k - 1 + maxloc(abs(both(k:, k)), 1)
            row(:) = both(p, :)
            both(p, :) = both(k, :)
            both(k, :) = row/row(k)
            do i = 1, q
                if (i /= k) both(i, :) = both(i, :) - both(i, k)*both(k, :)
            end do
        end do
        inverse = both(:, q + 1:)
    end subroutine invert

end module gapbeam_ground_along_stiff
