!> Steps of the parts of a beam that slide over ground along it, by extrapolation of the modified midpoint rule (Gragg, Bulirsch
!> and Stoer; Hairer, Norsett and Wanner, Solving ordinary differential equations I, II.9).
module gapbeam_ground_along_steps
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: first_slip, slip_settled, stiff_part
    use gapbeam_ground_along, only: ground_along_type, rates_type, find_rates, length_of
    use gapbeam_ground_along_slip, only: find_motion, start_sliding, longest_start
    use gapbeam_ground_along_stiff, only: take_stiff_step
    implicit none
    private
    public :: begin, first_step, take_step

    !> Columns of the extrapolation; rounds in which parts begin
    integer, parameter :: most_columns = 12, most_rounds = 200

contains

    !> Go a little way on which parts begin, and more of them as these push others
    pure subroutine begin(ground, rates, most, gone)
        type(ground_along_type), intent(inout) :: ground
        !> By find_motion
        type(rates_type), intent(inout) :: rates
        !> How far to go at most, and how far it went
        real(wp), intent(in) :: most
        real(wp), intent(out) :: gone
        real(wp) :: way
        integer :: round
        logical :: settled

        gone = 0.0_wp
        way = first_slip*most
        do round = 1, most_rounds
            if (rates%lost .or. .not. any(rates%begins) .or. gone >= most) return
            way = min(way, most - gone, longest_start(ground, rates))
            call start_sliding(ground, rates, way)
            gone = gone + way
            call find_motion(ground, rates, settled)
            if (.not. settled) return
            ! What pushes little has not come farther than rounding
            way = 2*way
        end do
    end subroutine begin

    !> Length of the first step: parts that have just begun grow with the way, and steps that are long beside that settle badly
    pure function first_step(way, gone) result(step)
        !> How far to go, and how far parts that have begun have gone of it
        real(wp), intent(in) :: way, gone
        real(wp) :: step

        step = way - gone
        if (gone > 0.0_wp) step = min(step, gone)
    end function first_step

    !> One step
    pure subroutine take_step(ground, step, done)
        type(ground_along_type), intent(inout) :: ground
        real(wp), intent(in) :: step
        !> False where it is too long; the ground is as it was then
        logical, intent(out) :: done
        real(wp), dimension(3*size(ground%parts) + size(ground%displacement)) :: start, size_of
        real(wp) :: table(size(start), most_columns), ratio
        logical :: sound
        integer :: i, j

        start(:) = [ground%parts%force, ground%parts%to, ground%parts%back, ground%displacement]
        size_of(:) = sizes(ground)
        done = .false.
        do i = 1, most_columns
            call midpoint(ground, start, step, 2*i, table(:, i), sound)
            if (.not. sound) exit
            do j = i - 1, 1, -1
                ratio = real(i, wp)**2/(real(i, wp)**2 - real(j, wp)**2)
                table(:, j) = table(:, j + 1) + (table(:, j + 1) - table(:, j))*(ratio - 1)
            end do
            if (i == 1) cycle
            if (all(abs(table(:, 1) - table(:, 2)) <= slip_settled*size_of)) then
                call put(table(:, 1), ground)
                ground%longer(:) = ground%longer + step*ground%longer_rate
                done = .true.
                return
            end if
        end do
        if (shortest(ground) < stiff_part) call take_stiff_step(ground, step, done)
    end subroutine take_step

    !> Length of the shortest part
    pure function shortest(ground) result(length)
        type(ground_along_type), intent(in) :: ground
        real(wp) :: length
        integer :: k

        length = minval([(length_of(ground, k), k=1, size(ground%parts))])
    end function shortest

    !> The modified midpoint rule with an even number of substeps
    pure subroutine midpoint(ground, start, step, number, end, sound)
        type(ground_along_type), intent(in) :: ground
        real(wp), intent(in) :: start(:), step
        integer, intent(in) :: number
        real(wp), intent(out) :: end(:)
        !> Did all parts that slide keep their length
        logical, intent(out) :: sound
        real(wp), dimension(size(start)) :: before, now, after, rate
        real(wp) :: h
        integer :: i

        h = step/number
        end(:) = start
        before(:) = start
        call find(start, rate, sound)
        if (.not. sound) return
        now(:) = start + h*rate
        do i = 2, number
            call find(now, rate, sound)
            if (.not. sound) return
            after(:) = before + 2*h*rate
            before(:) = now
            now(:) = after
        end do
        call find(now, rate, sound)
        if (sound) end(:) = (before + now + h*rate)/2

    contains

        !> Rates of all values
        pure subroutine find(values, rate, sound)
            real(wp), intent(in) :: values(:)
            real(wp), intent(out) :: rate(:)
            logical, intent(out) :: sound
            type(ground_along_type) :: there
            type(rates_type) :: rates

            there = ground
            call put(values, there)
            call find_rates(there, rates)
            sound = .not. rates%lost
            rate(:) = 0.0_wp
            if (sound) rate(:) = [rates%force, rates%to, -rates%to, rates%displacement]
        end subroutine find

    end subroutine midpoint

    !> The sizes of forces, right ends and displacements
    pure function sizes(ground) result(size_of)
        type(ground_along_type), intent(in) :: ground
        real(wp) :: size_of(3*size(ground%parts) + size(ground%displacement))

        associate (m => size(ground%parts), force => max(maxval(abs(ground%parts%force)), maxval(ground%limit)))
            size_of(:m) = force
            size_of(m + 1:3*m) = 1.0_wp
            size_of(3*m + 1:) = force*maxval(ground%softness) + maxval(abs(ground%displacement))
        end associate
    end function sizes

    !> Put such values in their places
    pure subroutine put(values, ground)
        real(wp), intent(in) :: values(:)
        type(ground_along_type), intent(inout) :: ground
        integer :: m

        m = size(ground%parts)
        ground%parts%force = values(:m)
        ground%parts%to = values(m + 1:2*m)
        ground%parts%back = values(2*m + 1:3*m)
        ground%displacement(:) = values(3*m + 1:)
    end subroutine put

end module gapbeam_ground_along_steps
