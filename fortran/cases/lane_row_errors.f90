!> Errors of the rows of the systems of eight cases: residuals, rounding, last digits of the data.
module gapbeam_lane_row_errors
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: rounding_unit, second_order, greatest_squared, smallest_squared
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_rounding_type, link_faa, link_fab, link_fbb
    implicit none
    private
    public :: find_sizes, limit_range

contains

    !> By how much the rows are off: residuals, rounding of coefficients, last digits of the data
    pure subroutine find_sizes(beam, n, rounding, left, right, force, couple, load_size, turn_size, held, spring, w, ml, mr, &
                               left_rest, turn_rest, force_rest, left_off, turn_off, force_off)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(lane_rounding_type), intent(in) :: rounding
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, force, couple, load_size, turn_size, held, spring, w, ml, mr
        !> The first at restraints only
        real(wp), intent(in), dimension(lanes, 0:n) :: left_rest, turn_rest, force_rest
        !> Of compatibility left of restraints, 0 elsewhere; of compatibility, 0 at hinges and at ends without restraint; of
        !> equilibrium, at nodes that are held what it does to the reaction there
        real(wp), intent(out), dimension(lanes, 0:n) :: left_off, turn_off, force_off
        real(wp) :: h, faa, fab, fbb, soft, long, slope, step, a, b, apart, compliance, size_of_turn, size_of_shear, both, of_load
        real(wp) :: couple_size
        integer :: i, k, l

        left_off(:, :) = 0.0_wp
        turn_off(:, :) = 0.0_wp
        force_off(:, :) = 0.0_wp
        of_load = max(rounding_unit, epsilon(1.0_wp) + rounding%of_loads)
        ! Sums of the absolute values of the terms, first without those of loads
        do k = 1, n
            h = beam%inverse(k)
            faa = beam%links(1, link_faa, k)
            fab = beam%links(1, link_fab, k)
            fbb = beam%links(1, link_fbb, k)
            apart = merge(1.0_wp, 0.0_wp, beam%restraint(k) > 0)
            !$omp simd private(a, b, slope, step)
            do l = 1, lanes
                a = abs(mr(l, k - 1))
                b = abs(ml(l, k))
                slope = h*(abs(w(l, k) - w(l, k - 1)) + epsilon(1.0_wp)*(abs(w(l, k)) + abs(w(l, k - 1))) &
                           + (held(l, k - 1)*abs(w(l, k - 1)) + held(l, k)*abs(w(l, k)))/8)
                step = h*(abs(ml(l, k) - mr(l, k - 1)) + epsilon(1.0_wp)*(a + b))
                turn_off(l, k - 1) = turn_off(l, k - 1) + (slope + faa*a + abs(fab)*b)
                turn_off(l, k) = turn_off(l, k) + (1.0_wp - apart)*(slope + abs(fab)*a + fbb*b)
                left_off(l, k) = left_off(l, k) + apart*(slope + abs(fab)*a + fbb*b)
                force_off(l, k - 1) = force_off(l, k - 1) + step
                force_off(l, k) = force_off(l, k) + step
            end do
        end do
        do i = 0, n
            both = merge(1.0_wp - beam%hinge(i), 0.0_wp, (i > 0 .and. i < n) .or. beam%restraint(i) > 0)
            apart = 0.0_wp
            compliance = 0.0_wp
            if (beam%restraint(i) > 0) then
                compliance = beam%compliance(beam%restraint(i))
                apart = 1.0_wp
            end if
            !$omp simd private(size_of_turn, size_of_shear, b)
            do l = 1, lanes
                ! The rotation of a restraint
                b = compliance*abs(ml(l, i) - mr(l, i) + couple(l, i))
                size_of_turn = apart*(left_off(l, i) + b + abs(left(l, i)))
                left_off(l, i) = apart*(rounding_unit*size_of_turn + abs(left_rest(l, i)) + of_load*compliance*abs(couple(l, i)))
                size_of_turn = both*(turn_off(l, i) + b + (1.0_wp - apart)*abs(left(l, i)) + abs(right(l, i)))
                size_of_shear = force_off(l, i) + abs(force(l, i)) + abs(spring(l, i)*w(l, i))
                turn_off(l, i) = rounding_unit*size_of_turn + abs(turn_rest(l, i)) + of_load*compliance*abs(couple(l, i))
                force_off(l, i) = rounding_unit*size_of_shear + of_load*load_size(l, i) + abs(force_rest(l, i))
            end do
        end do
        do k = 1, n
            h = beam%inverse(k)
            soft = rounding%flexibility(k)
            long = rounding%length(k)*h
            apart = merge(1.0_wp, 0.0_wp, beam%restraint(k) > 0)
            !$omp simd private(a, b)
            do l = 1, lanes
                a = of_load*turn_size(l, k) + soft*(abs(mr(l, k - 1)) + abs(ml(l, k))) + long*abs(w(l, k) - w(l, k - 1))
                b = long*abs(ml(l, k) - mr(l, k - 1))
                turn_off(l, k - 1) = turn_off(l, k - 1) + a
                turn_off(l, k) = turn_off(l, k) + (1.0_wp - apart)*a
                left_off(l, k) = left_off(l, k) + apart*a
                force_off(l, k - 1) = force_off(l, k - 1) + b
                force_off(l, k) = force_off(l, k) + b
            end do
        end do
        if (beam%with_couples) then
            ! Couples are steps of the moment: what one side of a step does to its link is as uncertain
            do i = 0, n
                if (beam%restraint(i) > 0) cycle
                k = min(i + 1, n)
                faa = merge(beam%links(1, link_faa, k), abs(beam%links(1, link_fab, k)), i < n)
                fbb = merge(abs(beam%links(1, link_fab, k)), beam%links(1, link_fbb, k), i < n)
                h = beam%inverse(k)
                apart = merge(1.0_wp, 0.0_wp, beam%restraint(k) > 0)
                !$omp simd private(couple_size)
                do l = 1, lanes
                    couple_size = of_load*abs(couple(l, i))
                    turn_off(l, k - 1) = turn_off(l, k - 1) + faa*couple_size
                    turn_off(l, k) = turn_off(l, k) + (1.0_wp - apart)*fbb*couple_size
                    left_off(l, k) = left_off(l, k) + apart*fbb*couple_size
                    force_off(l, k - 1) = force_off(l, k - 1) + h*couple_size
                    force_off(l, k) = force_off(l, k) + h*couple_size
                end do
            end do
        end if
        do i = 0, n
            both = merge(1.0_wp - beam%hinge(i), 0.0_wp, (i > 0 .or. beam%restraint(i) > 0) .and. i < n)
            turn_off(:, i) = second_order*both*turn_off(:, i)
            left_off(:, i) = second_order*merge(1.0_wp, 0.0_wp, i > 0)*left_off(:, i)
            force_off(:, i) = second_order*force_off(:, i)
        end do
    end subroutine find_sizes

    !> Numbers too far from 1 for their squares
    pure subroutine limit_range(n, left_off, turn_off, force_off, poor)
        integer, intent(in) :: n
        real(wp), intent(inout), dimension(lanes, 0:n) :: left_off, turn_off, force_off
        real(wp), intent(inout) :: poor(lanes)
        real(wp), dimension(lanes) :: turn, force
        real(wp) :: keep
        integer :: i, l

        turn(:) = 0.0_wp
        force(:) = 0.0_wp
        do i = 0, n
            turn(:) = turn + (left_off(:, i) + turn_off(:, i))
            force(:) = force + force_off(:, i)
        end do
        do l = 1, lanes
            keep = merge(1.0_wp, 0.0_wp, min(turn(l), force(l)) >= smallest_squared .and. &
                                  max(turn(l), force(l)) <= greatest_squared)
            if (keep > 0.5_wp) cycle
            poor(l) = poor(l) + 1.0_wp
            left_off(l, :) = 0.0_wp
            turn_off(l, :) = 0.0_wp
            force_off(l, :) = 0.0_wp
        end do
    end subroutine limit_range

end module gapbeam_lane_row_errors
