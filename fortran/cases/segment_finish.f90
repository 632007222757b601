!> Solution of a long beam in segments, refined, with reactions and doubts.
!> That is gapbeam_system, gapbeam_reactions and gapbeam_law for ordinary supports, one at a node, number by number
module gapbeam_segment_finish
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: sign_width, worst_digits
    use gapbeam_lane_types, only: lanes
    use gapbeam_lane_residual, only: find_rest_along
    use gapbeam_lane_audit, only: audit_along
    use gapbeam_segment_types, only: segment_beam_type, segment_room_type, node_of, half
    use gapbeam_segment_two_sided_sweep, only: solve_segments
    use gapbeam_segment_search, only: search_segments
    implicit none
    private
    public :: solve_long_beam, audit_long_beam

contains

    !> Find the contact state of a case and its solution
    subroutine solve_long_beam(beam, room, solves, doubtful)
        type(segment_beam_type), intent(in) :: beam
        !> Loads, supports and start in; scheme, solution and reactions out, by nodes
        type(segment_room_type), intent(inout) :: room
        integer, intent(out) :: solves
        !> Has no scheme been found, is a sign wrong or within its rounding error, are digits lost, or numbers not finite
        logical, intent(out) :: doubtful
        logical :: found

        call search_segments(beam, room, solves, found)
        doubtful = .not. found
        if (found) call finish_segments(beam, room, doubtful)
    end subroutine solve_long_beam

    !> Audit what came of a case (gapbeam_lane_audit)
    pure subroutine audit_long_beam(beam, room, wrong)
        type(segment_beam_type), intent(in) :: beam
        !> By solve_long_beam
        type(segment_room_type), intent(in) :: room
        !> Is a sum or a sign not what it should be
        logical, intent(out) :: wrong

        call audit_along(beam%n, beam%inverse, beam%faa, beam%fab, beam%fbb, beam%side, beam%there, beam%changing, room%left, &
                         room%right, room%shear, room%stiffness, room%rigid, room%contact, room%closed, room%w, room%m, &
                         room%reaction, wrong)
    end subroutine audit_long_beam

    !> Refine a solution once, and find reactions
    pure subroutine finish_segments(beam, room, doubtful)
        type(segment_beam_type), intent(in) :: beam
        !> Scheme found and solved in, solution by nodes out
        type(segment_room_type), intent(inout) :: room
        !> Is a sign wrong or within its rounding error, are digits lost, or numbers not finite
        logical, intent(out) :: doubtful
        integer :: n
        logical :: exact

        n = beam%n
        associate (b => room%by_node)
            call apply_scheme(n, room%shear, room%stiffness, room%rigid, room%contact, room%closed, b(:, 1), b(:, 2), b(:, 3), &
                              b(:, 4))
            call take_solution(beam, room, room%m, room%w)
            call find_rest_along(n, beam%length, beam%faa, beam%fab, beam%fbb, room%left, room%right, b(:n, 4), b(:n, 1), &
                                 b(:n, 2), b(:n, 3), room%w, room%m, b(:n, 5), b(:n, 6))
            call put_rows(beam, b(:, 5), b(:, 6), room)
            call solve_segments(beam, half + 1, room, exact)
            call take_solution(beam, room, b(:, 5), b(:, 6))
            room%m(:) = room%m + b(:n, 5)
            room%w(:) = room%w + b(:n, 6)
            call find_sizes(beam, n, b(:, 1), room%contact, room%closed, room%load_size, room%turn_size, room%w, room%m, &
                            b(:, 5), b(:, 6), b(:, 7), b(:, 8))
            call find_shears(n, beam%inverse, b(:, 1), b(:, 3), b(:, 4), room%w, room%m, b(:, 7), b(:, 8), b(:, 9), b(:, 10))
            call find_reactions(beam, n, room%shear, room%load_size, room%stiffness, room%rigid, room%contact, room%closed, &
                                room%w, room%m, b(:, 5), b(:, 6), b(:, 7), b(:, 8), room%reaction, doubtful)
        end associate
    end subroutine finish_segments

    !> Nodes as the scheme sees them
    pure subroutine apply_scheme(n, shear, stiffness, rigid, contact, closed, held, known, spring, force)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(0:n) :: shear, stiffness, rigid, contact, closed
        !> As in pack_type of gapbeam_lane_types
        real(wp), intent(inout), dimension(0:n + 1) :: held, known, spring, force
        integer :: i

        do i = 0, n
            call put_support(closed(i), shear(i), stiffness(i), rigid(i), contact(i), held(i), known(i), spring(i), force(i))
        end do
    end subroutine apply_scheme

    !> Moments and deflections by nodes
    pure subroutine take_solution(beam, room, m, w)
        type(segment_beam_type), intent(in) :: beam
        type(segment_room_type), intent(in) :: room
        real(wp), intent(inout) :: m(0:), w(0:)
        integer, dimension(lanes) :: first, step, begin
        integer :: l, s

        call node_of(beam, [(l, l=1, lanes)], first, step, begin)
        do s = 1, beam%columns
            do l = 1, lanes
                if (s < begin(l)) cycle
                m(first(l) + (s - 1)*step(l)) = room%solution(l, 1, s)
                w(first(l) + (s - 1)*step(l)) = room%solution(l, 2, s)
            end do
        end do
        m(beam%n/2) = room%middle(1)
        w(beam%n/2) = room%middle(2)
    end subroutine take_solution

    !> Other right-hand sides
    pure subroutine put_rows(beam, turn, shear, room)
        type(segment_beam_type), intent(in) :: beam
        real(wp), intent(in) :: turn(0:), shear(0:)
        type(segment_room_type), intent(inout) :: room
        integer, dimension(lanes) :: first, step, begin
        integer :: l, s

        call node_of(beam, [(l, l=1, lanes)], first, step, begin)
        do s = 1, beam%columns
            do l = 1, lanes
                if (s < begin(l)) cycle
                room%row(l, 3, s) = turn(first(l) + (s - 1)*step(l))
                room%row(l, 4, s) = shear(first(l) + (s - 1)*step(l))
            end do
        end do
        room%middle_row(3) = turn(beam%n/2)
        room%middle_row(4) = shear(beam%n/2)
    end subroutine put_rows

    !> Sizes of shears and deflections whose rounding errors reach a node
    pure subroutine find_sizes(beam, n, held, contact, closed, load_size, turn_size, w, m, shear_size, deflection_size, shear, &
                               deflection)
        type(segment_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(0:n) :: contact, closed, load_size, turn_size, w, m
        real(wp), intent(in) :: held(0:n + 1)
        real(wp), intent(inout), dimension(0:n + 1) :: shear_size, deflection_size
        !> Room: those of the links, and what comes from the left
        real(wp), intent(inout), dimension(0:n + 1) :: shear, deflection
        real(wp) :: moment, turn, s, d, share
        integer :: i

        do i = 0, n + 1, n + 1
            shear(i) = 0.0_wp
            deflection(i) = 0.0_wp
        end do
        associate (inverse => beam%inverse, fixity => beam%fixity, reach => beam%reach)
            !$omp simd private(moment, turn)
            do i = 1, n
                turn = turn_size(i) + (abs(contact(i))*closed(i) + abs(contact(i - 1))*closed(i - 1))*inverse(i)
                moment = larger(larger(abs(m(i - 1)), abs(m(i))), turn*fixity(i))
                shear(i) = 2*moment*inverse(i)
                deflection(i) = reach(i)*moment
            end do
        end associate
        !$omp simd
        do i = 0, n
            shear_size(i) = larger(load_size(i), larger(shear(i), shear(i + 1)))
            deflection_size(i) = larger(abs(w(i)), larger(deflection(i), deflection(i + 1)))
        end do
        s = 0.0_wp
        d = 0.0_wp
        do i = 0, n
            share = 1.0_wp - 0.5_wp*held(i)
            s = larger(shear_size(i), share*s)
            d = larger(deflection_size(i), share*d)
            shear(i) = s
            deflection(i) = d
        end do
        s = 0.0_wp
        d = 0.0_wp
        do i = n, 0, -1
            share = 1.0_wp - 0.5_wp*held(i)
            s = larger(shear_size(i), share*s)
            d = larger(deflection_size(i), share*d)
            shear_size(i) = larger(shear(i), s)
            deflection_size(i) = larger(deflection(i), d)
        end do
    end subroutine find_sizes

    !> Shears of the links and their rounding errors, by the better of two ways
    pure subroutine find_shears(n, inverse, held, spring, force, w, m, v, e, change, passed)
        integer, intent(in) :: n
        real(wp), intent(in) :: inverse(n)
        real(wp), intent(in), dimension(0:n + 1) :: held, spring, force
        real(wp), intent(in), dimension(0:n) :: w, m
        !> Shear and rounding error of link i, 0 beyond the ends
        real(wp), intent(inout), dimension(0:n + 1) :: v, e
        !> Room
        real(wp), intent(inout), dimension(0:n + 1) :: change, passed
        real(wp) :: by_spring, shear, error
        logical :: better
        integer :: i, j, way

        do i = 0, n + 1, n + 1
            v(i) = 0.0_wp
            e(i) = 0.0_wp
        end do
        !$omp simd private(by_spring)
        do i = 1, n
            v(i) = (m(i) - m(i - 1))*inverse(i)
            e(i) = epsilon(1.0_wp)*(abs(m(i)) + abs(m(i - 1)))*inverse(i)
            by_spring = spring(i)*w(i)
            change(i) = by_spring - force(i)
            passed(i) = epsilon(1.0_wp)*(abs(by_spring) + abs(force(i)))
            ! No way past a rigid support
            passed(i) = merge(sqrt(huge(1.0_wp)), passed(i), held(i) > 0.5_wp)
        end do
        shear = v(1)
        error = e(1)
        do way = 1, -1, -2
            do i = merge(2, n - 1, way == 1), merge(n, 1, way == 1), way
                ! By that of the link before, across node j
                j = min(i, i - way)
                better = error + passed(j) < e(i)
                shear = merge(shear + way*change(j), v(i), better)
                error = merge(error + passed(j), e(i), better)
                v(i) = shear
                e(i) = error
            end do
        end do
    end subroutine find_shears

    !> Reactions, and whether signs and digits are certain
    pure subroutine find_reactions(beam, n, shear, load_size, stiffness, rigid, contact, closed, w, m, shear_size, &
                                   deflection_size, v, e, reaction, doubtful)
        type(segment_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        real(wp), intent(in), dimension(0:n) :: shear, load_size, stiffness, rigid, contact, closed, w, m
        real(wp), intent(in), dimension(0:n + 1) :: shear_size, deflection_size, v, e
        real(wp), intent(out) :: reaction(0:n)
        logical, intent(out) :: doubtful
        real(wp) :: force, error, by_spring, spring_error, r, r_error, margin, rounding, c, bad, largest, worst, wrong, &
            changes
        integer :: i

        wrong = 0.0_wp
        largest = 0.0_wp
        worst = 0.0_wp
        !$omp simd private(force, error, by_spring, spring_error, r, r_error, margin, rounding, c, bad, changes) &
        !$omp   reduction(max: largest, worst) reduction(+: wrong)
        do i = 0, n
            error = epsilon(1.0_wp)*load_size(i) + e(i) + e(i + 1)
            force = shear(i) - (v(i) - v(i + 1))
            changes = abs(beam%changing(i))
            associate (shear_size => shear_size(i), deflection_size => deflection_size(i), stiffness => stiffness(i), &
                       rigid => rigid(i), contact => contact(i), closed => closed(i), w => w(i), side => beam%side(i), &
                       there => beam%there(i))
                include 'cases/support_reaction.inc'
            end associate
            reaction(i) = r
            largest = max(largest, abs(r))
            worst = max(worst, r_error)
            ! Not a number, or beyond the range
            bad = merge(bad, 1.0_wp, abs(w(i)) + 2*abs(m(i)) + abs(r) <= huge(1.0_wp))
            wrong = wrong + bad
        end do
        doubtful = wrong > 0.0_wp .or. worst > worst_digits*largest
    end subroutine find_reactions

    include 'cases/support_in_scheme.inc'

    include 'cases/larger.inc'

end module gapbeam_segment_finish
