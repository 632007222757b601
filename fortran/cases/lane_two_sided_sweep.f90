!> Two-sided elimination of the beams of eight cases that are held at both ends.
!> Each end has a support that acts or a restraint, and there are no couples and hinges; with the arithmetic of gapbeam_kernel,
!> number by number: the bits are its. The scheme is applied on the way inward, and a right-hand side can be solved for
!> with the elimination of the pass before
module gapbeam_lane_two_sided_sweep
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, link_numbers, link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, &
        link_bending, link_determinant
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: pass_both_ends, correct_both_ends

contains

    !> Change supports, and solve the scheme
    pure subroutine pass_both_ends(beam, links, n, turn, shear, stiffness, rigid, contact, change, closed, room, w, m)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides and supports (pack_type), shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, shear, stiffness, rigid, contact
        !> 1 where a support is to be changed
        real(wp), intent(in) :: change(lanes, 0:n)
        !> Scheme: 1 closed
        real(wp), intent(inout) :: closed(lanes, 0:n)
        !> Elimination, for correct_both_ends too
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Deflections and moments
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp) :: passed(lanes, 5, 2), acts, free, stiff, load, phi, beta, delta, e, p, b_free, turn_here, load_here
        integer :: l, i, middle

        middle = n/2
        call go_inward(beam, links, n, 1, 0, middle - 1, 1, turn, shear, stiffness, rigid, contact, change, closed, room, &
                       passed(:, :, 1))
        call go_inward(beam, links, n, 2, n, middle + 1, -1, turn, shear, stiffness, rigid, contact, change, closed, room, &
                       passed(:, :, 2))
        i = middle
        !$omp simd private(acts, free, stiff, load, phi, beta, delta, e, p, b_free, turn_here, &
        !$omp   load_here)
        do l = 1, lanes
            acts = abs(closed(l, i) - change(l, i))
            closed(l, i) = acts
            call make_row(acts, shear(l, i), stiffness(l, i), rigid(l, i), contact(l, i), stiff, free, load)
            phi = passed(l, 1, 1) + passed(l, 1, 2)
            beta = passed(l, 2, 1) + passed(l, 2, 2)
            delta = passed(l, 3, 1) + passed(l, 3, 2)
            e = passed(l, 4, 1) + passed(l, 4, 2)
            p = passed(l, 5, 1) + passed(l, 5, 2)
            associate (turn => turn(l, i), moment => m(l, i), deflection => w(l, i), a => room(l, i, 7), b => room(l, i, 8), &
                       c => room(l, i, 9), reciprocal => room(l, i, 10))
                include 'elimination/node_meeting.inc'
            end associate
        end do
        call go_back(n, middle, room, w, m)
    end subroutine pass_both_ends

    !> Inward from an end
    pure subroutine go_inward(beam, links, n, way, first, last, step, turn, shear, stiffness, rigid, contact, change, closed, &
                              room, passed)
        type(lane_beam_type), intent(in) :: beam
        !> Links; 1 from the left, 2 from the right; first and last node, step
        integer, intent(in) :: n, way, first, last, step
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> As for pass_both_ends
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, shear, stiffness, rigid, contact, change
        real(wp), intent(inout) :: closed(lanes, 0:n), room(lanes, 0:n, 10)
        !> What the nodes outside pass on: phi, beta, delta, e, p
        real(wp), intent(out) :: passed(lanes, 5)
        real(wp) :: h, near, far, cross, sum_near, sum_far, bending, determinant
        real(wp) :: acts, free, stiff, load, softness, b_free, turn_here, load_here, c_h, next, turns
        integer :: l, i, link, begin, at_near, at_far, at_sum_near, at_sum_far

        i = first
        begin = merge(first, first + step, beam%restraint(first) > 0)
        ! Where the end is restrained what is found for a free one means nothing, and stays finite
        turns = merge(1.0_wp, 0.0_wp, begin == first)
        link = merge(1, n, way == 1)
        h = beam%inverse(link)
        at_near = merge(link_faa, link_fbb, way == 1)
        at_far = merge(link_fbb, link_faa, way == 1)
        at_sum_near = merge(link_sum_a, link_sum_b, way == 1)
        at_sum_far = merge(link_sum_b, link_sum_a, way == 1)
        !$omp simd private(far, acts, free, stiff, load, softness)
        do l = 1, lanes
            far = links(min(l, stiffness_lanes), at_far, link)
            acts = abs(closed(l, i) - change(l, i))
            closed(l, i) = acts
            call make_row(acts, shear(l, i), stiffness(l, i), rigid(l, i), contact(l, i), stiff, free, load)
            stiff = stiff + turns
            room(l, i, 7) = stiff
            associate (phi => passed(l, 1), beta => passed(l, 2), delta => passed(l, 3), e => passed(l, 4), p => passed(l, 5), &
                       moment => room(l, i, 1), moment_m => room(l, i, 2), moment_w => room(l, i, 3), &
                       deflection => room(l, i, 4), deflection_m => room(l, i, 5), deflection_w => room(l, i, 6))
                include 'elimination/node_start.inc'
            end associate
        end do
        if (begin == first) then
            ! The restraint is what lies outside, and the node is one as those inside
            closed(:, first) = abs(closed(:, first) - change(:, first))
            passed(:, :) = 0.0_wp
            passed(:, 1) = beam%compliance(beam%restraint(first))
        end if
        do i = begin, last, step
            link = merge(i + 1, i, way == 1)
            h = beam%inverse(link)
            !$omp simd private(near, far, cross, sum_near, sum_far, bending, determinant, acts, free, &
            !$omp   stiff, load, b_free, turn_here, load_here, c_h, next)
            do l = 1, lanes
                near = links(min(l, stiffness_lanes), at_near, link)
                far = links(min(l, stiffness_lanes), at_far, link)
                cross = links(min(l, stiffness_lanes), link_fab, link)
                sum_near = links(min(l, stiffness_lanes), at_sum_near, link)
                sum_far = links(min(l, stiffness_lanes), at_sum_far, link)
                bending = links(min(l, stiffness_lanes), link_bending, link)
                determinant = links(min(l, stiffness_lanes), link_determinant, link)
                acts = abs(closed(l, i) - change(l, i))
                closed(l, i) = acts
                call make_row(acts, shear(l, i), stiffness(l, i), rigid(l, i), contact(l, i), stiff, free, load)
                associate (phi => passed(l, 1), beta => passed(l, 2), delta => passed(l, 3), e => passed(l, 4), &
                           p => passed(l, 5), turn => turn(l, i), moment => room(l, i, 1), moment_m => room(l, i, 2), &
                           moment_w => room(l, i, 3), deflection => room(l, i, 4), deflection_m => room(l, i, 5), &
                           deflection_w => room(l, i, 6), a => room(l, i, 7), b => room(l, i, 8), c => room(l, i, 9), &
                           reciprocal => room(l, i, 10))
                    include 'elimination/node_step.inc'
                end associate
            end do
        end do
    end subroutine go_inward

    !> Back from the middle
    pure subroutine go_back(n, middle, room, w, m)
        integer, intent(in) :: n, middle
        real(wp), intent(in) :: room(lanes, 0:n, 10)
        !> Those of the middle node in, all out
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp) :: moment, deflection
        integer :: l, i, way

        do way = -1, 1, 2
            do i = middle + way, merge(0, n, way == -1), way
                !$omp simd private(moment, deflection)
                do l = 1, lanes
                    moment = m(l, i - way)
                    deflection = w(l, i - way)
                    m(l, i) = room(l, i, 1) + room(l, i, 2)*moment - room(l, i, 3)*deflection
                    w(l, i) = room(l, i, 4) + room(l, i, 5)*moment + room(l, i, 6)*deflection
                end do
            end do
        end do
    end subroutine go_back

    !> Solve for another right-hand side after pass_both_ends
    pure subroutine correct_both_ends(beam, links, n, turn, force, held, known, room, w, m)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> Right-hand sides, is the deflection known and which is it, shape (lanes, 0:n)
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, force, held, known
        !> As pass_both_ends left it
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Deflections and moments
        real(wp), intent(inout) :: w(lanes, 0:n), m(lanes, 0:n)
        real(wp) :: passed(lanes, 2, 2), free, load, e, p, b_free, turn_here, load_here
        integer :: l, i, middle

        middle = n/2
        call put_inward(beam, links, n, 1, 0, middle - 1, 1, turn, force, held, known, room, passed(:, :, 1))
        call put_inward(beam, links, n, 2, n, middle + 1, -1, turn, force, held, known, room, passed(:, :, 2))
        i = middle
        !$omp simd private(free, load, e, p, b_free, turn_here, load_here)
        do l = 1, lanes
            free = 1.0_wp - held(l, i)
            load = force(l, i)*free + known(l, i)
            e = passed(l, 1, 1) + passed(l, 1, 2)
            p = passed(l, 2, 1) + passed(l, 2, 2)
            associate (turn => turn(l, i), moment => m(l, i), deflection => w(l, i), a => room(l, i, 7), b => room(l, i, 8), &
                       c => room(l, i, 9), reciprocal => room(l, i, 10))
                b_free = free*b
                include 'elimination/node_solution.inc'
            end associate
        end do
        call go_back(n, middle, room, w, m)
    end subroutine correct_both_ends

    !> A right-hand side inward from an end
    pure subroutine put_inward(beam, links, n, way, first, last, step, turn, force, held, known, room, passed)
        type(lane_beam_type), intent(in) :: beam
        !> As for go_inward
        integer, intent(in) :: n, way, first, last, step
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        !> As for correct_both_ends
        real(wp), intent(in), dimension(lanes, 0:n) :: turn, force, held, known
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> What the nodes outside pass on: e, p
        real(wp), intent(out) :: passed(lanes, 2)
        real(wp) :: h, cross, free, load, b_free, turn_here, load_here
        integer :: l, i, link, begin

        i = first
        begin = merge(first, first + step, beam%restraint(first) > 0)
        h = beam%inverse(merge(1, n, way == 1))
        room(:, i, 4) = (force(:, i)*(1.0_wp - held(:, i)) + known(:, i))/room(:, i, 7)
        passed(:, 1) = h*room(:, i, 4)
        passed(:, 2) = 0.0_wp
        if (begin == first) passed(:, 1) = 0.0_wp
        do i = begin, last, step
            link = merge(i + 1, i, way == 1)
            h = beam%inverse(link)
            !$omp simd private(cross, free, load, b_free, turn_here, load_here)
            do l = 1, lanes
                cross = links(min(l, stiffness_lanes), link_fab, link)
                free = 1.0_wp - held(l, i)
                load = force(l, i)*free + known(l, i)
                associate (e => passed(l, 1), p => passed(l, 2), turn => turn(l, i), moment => room(l, i, 1), &
                           deflection => room(l, i, 4), a => room(l, i, 7), b => room(l, i, 8), c => room(l, i, 9), &
                           reciprocal => room(l, i, 10))
                    b_free = free*b
                    include 'elimination/node_solution.inc'
                    e = h*deflection + cross*moment
                    p = h*moment
                end associate
            end do
        end do
    end subroutine put_inward

    include 'cases/row_of_node.inc'

end module gapbeam_lane_two_sided_sweep
