!> Certificates of eight cases: residuals and error bounds, as of gapbeam_certificate.
!> Where that compares with a solution in quadruple precision and estimates movements, residuals in twice the working precision are
!> taken here as one more thing by which the rows are off, and all movements are bounds (gapbeam_lane_error_ellipses). Both are
!> bounds of the same errors, none always the smaller.
module gapbeam_lane_certificate
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, lane_rounding_type, pack_type, link_faa, link_fab, link_fbb, link_sum_a, &
        link_sum_b, link_bending
    use gapbeam_lane_search, only: add_loads, apply_scheme
    use gapbeam_tolerances, only: unit => rounding_unit, largest_error_share, greatest_squared
    use gapbeam_lane_row_errors, only: find_sizes, limit_range
    use gapbeam_lane_residual, only: find_rests
    use gapbeam_lane_reactions, only: complete
    use gapbeam_lane_audit, only: audit_pack, is_joined, check_link, check_support, check_restraint, wrong_way
    use gapbeam_lane_fields, only: find_rotations
    use gapbeam_lane_error_ellipses, only: find_movements, kinds_of_movement, of_deflection, of_moment, of_shear, of_rotation
    use gapbeam_lane_stiffness, only: stiffness_lanes
    implicit none
    private
    public :: certify_pack

contains

    !> Certify eight solved cases
    pure subroutine certify_pack(beam, rounding, factors, pack, moves, found, poor)
        !> What the cases have in common
        type(lane_beam_type), intent(in) :: beam
        type(lane_rounding_type), intent(in) :: rounding
        !> Factor of every load, shape (lanes, nload)
        real(wp), intent(in), contiguous :: factors(:, :)
        !> Supports, contact states and solutions with reactions
        type(pack_type), intent(inout) :: pack
        !> Room, shape (lanes, 0:n, kinds_of_movement)
        real(wp), intent(inout), contiguous :: moves(:, 0:, :)
        !> Relative residuals of compatibility, equilibrium and complementarity (measure_pack); largest errors of
        !> deflections of the nodes and of reactions; of deflections, rotations, moments, shears along the beam
        real(wp), intent(out) :: found(lanes, 9)
        !> Above 0 for cases that are not certified here: not a solution, a sign within its rounding error, few digits
        real(wp), intent(out) :: poor(lanes)
        real(wp) :: lost(lanes)
        logical :: wrong(lanes)
        integer :: n

        n = beam%n
        call add_loads(beam, n, factors, pack%left, pack%right, pack%shear, pack%couple, pack%load_size, pack%turn_size, &
                       pack%room, pack%force)
        call audit_pack(beam, pack, wrong)
        call measure_pack(beam, pack, found(:, :3))
        call apply_scheme(n, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%held, pack%known, &
                          pack%spring, pack%force)
        pack%spare(:, :) = pack%reaction
        call complete(beam, n, pack, poor)
        call find_rests(beam, pack)
        poor(:) = poor + count(abs(pack%known_rest) > 0.0_wp, 2)   ! a known deflection is another
        call find_sizes(beam, n, rounding, pack%left, pack%right, pack%force, pack%couple, pack%load_size, pack%turn_size, &
                        pack%held, pack%spring, pack%w, pack%ml, pack%mr, pack%left_rest, pack%turn_rest, pack%force_rest, &
                        pack%dw, pack%dl, pack%dr)
        call limit_range(n, pack%dw, pack%dl, pack%dr, poor)
        call find_movements(beam, n, pack%held, pack%spring, pack%dw, pack%dl, pack%dr, moves, lost)
        poor(:) = poor + lost
        call find_rotations(beam, pack%links, n, pack%left, pack%right, pack%w, pack%ml, pack%mr, pack%room)
        call bound_links(beam, n, rounding, pack%right, pack%turn_size, pack%held, pack%spring, pack%force, pack%w, &
                         pack%ml, pack%mr, pack%couple, pack%room, moves)
        call bound_nodes(beam, n, rounding, pack, moves, found, poor)
        call bound_fields(beam, n, rounding, pack%load_size, pack%turn_size, pack%w, pack%ml, pack%mr, pack%room, moves, found)
        ! A link that hangs between a hinge and the end of the beam has no neighbour that knows its rotation
        poor(:) = poor + merge(1.0_wp, 0.0_wp, found(:, 7) > greatest_squared .or. wrong)
    end subroutine certify_pack

    !> Errors of the shears and rotations of links as they are found for fields: by their own ends, or through a neighbour
    pure subroutine bound_links(beam, n, rounding, right, turn_size, held, spring, force, w, ml, mr, couple, room, moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(lane_rounding_type), intent(in) :: rounding
        real(wp), intent(in), dimension(lanes, 0:n) :: right, turn_size, held, spring, force, w, ml, mr, couple
        !> Rotations (1), how much they change along the link (2), shears (5) in; out how far shears (7) and rotations (8) are from
        !> those that the ends of the link make out
        real(wp), intent(inout) :: room(lanes, 0:n, 10)
        !> Movements of the exact fields in, errors out
        real(wp), intent(inout) :: moves(lanes, 0:n, kinds_of_movement)
        real(wp) :: h, faa, fab, bending, sum_a, sum_b, soft, long, of_load, own, size, other, e, v, by_spring, far
        integer :: i, k, l, from, to, way
        logical :: crosses

        of_load = larger(unit, epsilon(1.0_wp) + rounding%of_loads)
        if (beam%with_couples) moves(:, :, of_moment) = moves(:, :, of_moment) + of_load*abs(couple)
        do k = 1, n
            h = beam%inverse(k)
            faa = beam%links(1, link_faa, k)
            fab = beam%links(1, link_fab, k)
            soft = rounding%flexibility(k)
            long = h*rounding%length(k)
            !$omp simd private(own, size)
            do l = 1, lanes
                own = (ml(l, k) - mr(l, k - 1))*h
                room(l, k, 7) = abs(room(l, k, 5) - own) + 2*epsilon(1.0_wp)*abs(own) + long*abs(ml(l, k) - mr(l, k - 1))
                moves(l, k, of_shear) = moves(l, k, of_shear) + room(l, k, 7) &
                    + of_load*h*(abs(couple(l, k - 1)) + abs(couple(l, k)))
                own = (w(l, k) - w(l, k - 1))*h + (faa*mr(l, k - 1) + fab*ml(l, k)) + right(l, k - 1)
                size = abs(w(l, k) - w(l, k - 1))*h + (faa*abs(mr(l, k - 1)) + abs(fab*ml(l, k))) + abs(right(l, k - 1))
                room(l, k, 8) = abs(room(l, k, 1) - own) + 3*epsilon(1.0_wp)*size &
                    + soft*(abs(mr(l, k - 1)) + abs(ml(l, k))) + long*abs(w(l, k) - w(l, k - 1))
                moves(l, k, of_rotation) = moves(l, k, of_rotation) + room(l, k, 8) + of_load*turn_size(l, k)
            end do
        end do
        do way = 1, -1, -2
            from = merge(1, n, way == 1)
            to = merge(n - 1, 2, way == 1)
            do i = from, to, way
                ! From link i to link k, across the node between them
                k = i + way
                associate (j => merge(i, k, way == 1))
                    sum_a = beam%links(1, link_sum_a, j)
                    sum_b = beam%links(1, link_sum_b, j)
                    far = rounding%flexibility(j)
                    bending = beam%links(1, link_bending, j)
                    crosses = beam%hinge(j) < 0.5_wp
                    !$omp simd private(other, e, v, by_spring, size)
                    do l = 1, lanes
                        by_spring = spring(l, j)*w(l, j)
                        v = room(l, j + 1, 5) - room(l, j, 5) - (by_spring - force(l, j))
                        other = moves(l, i, of_shear) + abs(v) + spring(l, j)*moves(l, j, of_deflection) &
                            + of_load*(abs(by_spring) + abs(force(l, j)) + abs(room(l, j, 5)) + abs(room(l, j + 1, 5)))
                        e = moves(l, k, of_shear)
                        moves(l, k, of_shear) = merge(other, e, other < e .and. held(l, j) < 0.5_wp)
                        v = room(l, j + 1, 1) - room(l, j, 1) + room(l, j, 2)
                        size = abs(mr(l, j - 1)) + abs(ml(l, j))
                        other = moves(l, i, of_rotation) + abs(v) &
                            + sum_a*moves(l, j - 1, of_moment) + sum_b*moves(l, j, of_moment) &
                            + unit*(abs(room(l, j + 1, 1)) + abs(room(l, j, 1)) + bending*size) + 2*far*size &
                            + 2*of_load*turn_size(l, j)
                        e = moves(l, k, of_rotation)
                        moves(l, k, of_rotation) = merge(other, e, other < e .and. crosses)
                    end do
                end associate
            end do
        end do
    end subroutine bound_links

    !> Errors of deflections at the nodes, and of reactions
    pure subroutine bound_nodes(beam, n, rounding, pack, moves, found, poor)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(lane_rounding_type), intent(in) :: rounding
        type(pack_type), intent(in) :: pack
        real(wp), intent(in) :: moves(lanes, 0:n, kinds_of_movement)
        real(wp), intent(inout) :: found(lanes, 9), poor(lanes)
        real(wp) :: of_load, there, left, right, left_error, right_error, own, error, other
        real(wp), dimension(lanes) :: deflection, moment, reaction, straight, largest_w, largest_m, largest_r
        integer :: i, l, after

        deflection(:) = 0.0_wp
        moment(:) = 0.0_wp
        reaction(:) = 0.0_wp
        straight(:) = 0.0_wp
        largest_w(:) = 0.0_wp
        largest_m(:) = 0.0_wp
        largest_r(:) = 0.0_wp
        of_load = larger(unit, epsilon(1.0_wp) + rounding%of_loads)
        do i = 0, n
            there = beam%there(i)
            after = min(i + 1, n)
            !$omp simd private(left, right, left_error, right_error, own, error, other)
            do l = 1, lanes
                left = merge(pack%room(l, i, 5), 0.0_wp, i > 0)
                left_error = merge(moves(l, i, of_shear), 0.0_wp, i > 0)
                right = merge(pack%room(l, after, 5), 0.0_wp, i < n)
                right_error = merge(moves(l, after, of_shear), 0.0_wp, i < n)
                own = pack%shear(l, i) - (left - right)
                error = left_error + right_error + abs(pack%spare(l, i) - own) + of_load*pack%load_size(l, i) &
                    + unit*(abs(pack%shear(l, i)) + abs(left) + abs(right))
                own = pack%stiffness(l, i)*(pack%w(l, i) - pack%contact(l, i))
                other = pack%stiffness(l, i)*moves(l, i, of_deflection) + abs(pack%spare(l, i) - own) &
                    + unit*pack%stiffness(l, i)*(abs(pack%w(l, i)) + abs(pack%contact(l, i)))
                other = merge(other, error, other < error .and. pack%rigid(l, i) < 0.5_wp)
                reaction(l) = larger(reaction(l), there*pack%closed(l, i)*other)
                straight(l) = larger(straight(l), there*pack%held(l, i)*pack%dr(l, i))
                deflection(l) = larger(deflection(l), moves(l, i, of_deflection))
                moment(l) = larger(moment(l), moves(l, i, of_moment))
                largest_w(l) = larger(largest_w(l), abs(pack%w(l, i)))
                largest_m(l) = larger(largest_m(l), larger(abs(pack%ml(l, i)), abs(pack%mr(l, i))))
                largest_r(l) = larger(largest_r(l), there*abs(pack%spare(l, i)))
            end do
        end do
        do l = 1, lanes
            found(l, 4) = deflection(l) + epsilon(1.0_wp)*largest_w(l)
            ! What loads and shears may be off where the deflection is known goes straight into the reaction
            reaction(l) = reaction(l) + straight(l)
            found(l, 5) = reaction(l) + epsilon(1.0_wp)*largest_r(l)
            found(l, 8) = moment(l)
            if (.not. (deflection(l) <= largest_error_share*largest_w(l) .and. moment(l) <= largest_error_share*largest_m(l) &
                       .and. reaction(l) <= largest_error_share*largest_r(l))) poor(l) = poor(l) + 1.0_wp
        end do
    end subroutine bound_nodes

    !> Errors of the fields along the beam: by how much the exact ones move, and what rounding makes of them from the left end of a
    !> piece on, wherever it begins in its link, at most to the end of the link
    pure subroutine bound_fields(beam, n, rounding, load_size, turn_size, w, ml, mr, room, moves, found)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n
        type(lane_rounding_type), intent(in) :: rounding
        real(wp), intent(in), dimension(lanes, 0:n) :: load_size, turn_size, w, ml, mr
        real(wp), intent(in) :: room(lanes, 0:n, 10), moves(lanes, 0:n, kinds_of_movement)
        real(wp), intent(inout) :: found(lanes, 9)
        real(wp) :: length, soft, bending, slip, share, of_load, p, m, turns, ends, v_error, m_error, turn_error, w_error
        real(wp), dimension(lanes) :: deflection, rotation, moment, shear
        integer :: k, l

        deflection(:) = found(:, 4)
        rotation(:) = 0.0_wp
        moment(:) = found(:, 8)
        shear(:) = 0.0_wp
        of_load = larger(unit, epsilon(1.0_wp) + rounding%of_loads)
        do k = 1, n
            length = beam%length(k)
            bending = beam%links(1, link_bending, k)
            soft = larger(bending, beam%links(1, link_faa, k) + beam%links(1, link_fbb, k))
            slip = rounding%slip(k)
            share = rounding%of_fields(k)
            !$omp simd private(p, m, turns, ends, v_error, m_error, turn_error, w_error)
            do l = 1, lanes
                ! Loads of the link are among those of either node
                p = merge(load_size(l, k), load_size(l, k - 1), load_size(l, k) < load_size(l, k - 1))
                m = larger(abs(mr(l, k - 1)), abs(ml(l, k)))
                turns = soft*m + turn_size(l, k)
                ends = larger(moves(l, k - 1, of_moment), moves(l, k, of_moment)) + of_load*length*p/2
                v_error = (unit + share)*(abs(room(l, k, 5)) + p)
                m_error = unit*abs(mr(l, k - 1)) + share*(m + length*p)
                turn_error = unit*abs(room(l, k, 1)) + share*turns
                w_error = unit*abs(w(l, k - 1)) + share*(abs(w(l, k - 1)) + abs(w(l, k)) + length*turns/4)
                shear(l) = larger(shear(l), moves(l, k, of_shear) + v_error + 2*of_load*p)
                v_error = v_error + room(l, k, 7)
                moment(l) = larger(moment(l), ends + m_error + length*(v_error + of_load*p))
                m_error = m_error + length*(v_error/2 + of_load*p/3)
                rotation(l) = larger(rotation(l), moves(l, k, of_rotation) + of_load*turn_size(l, k) + turn_error &
                                     + bending*(ends + m_error))
                deflection(l) = larger(deflection(l), larger(moves(l, k - 1, of_deflection), moves(l, k, of_deflection)) &
                                       + length*(soft*ends/4 + of_load*turn_size(l, k)) + w_error &
                                       + length*(turn_error + room(l, k, 8) + bending*m_error/2) + slip*(v_error + of_load*p))
            end do
        end do
        found(:, 6) = deflection
        found(:, 7) = rotation
        found(:, 8) = moment
        found(:, 9) = shear
    end subroutine bound_fields

    include 'cases/larger.inc'

    !> Residuals of eight cases, of the sums that audit_pack looks at, each relative to the largest size of the terms of one
    pure subroutine measure_pack(beam, pack, residuals)
        !> At most one support at a node
        type(lane_beam_type), intent(in) :: beam
        type(pack_type), intent(in) :: pack
        !> Of rotations; of forces; of laws of supports with what violates contact, in force or in deflection
        real(wp), intent(out) :: residuals(lanes, 3)
        integer, parameter :: turns = 1, forces = 2, reactions = 3, distances = 4
        real(wp) :: far(4), most(4), turned, turned_size, passed, passed_size, start, end, link_size, next, next_size, force_size
        real(wp) :: off, size_of_off, level, law, held, held_size, spring_size
        real(wp), dimension(lanes) :: of_restraint, size_of_restraint
        integer :: i, k, l, m

        do l = 1, lanes
            far(:) = 0.0_wp
            most(:) = tiny(1.0_wp)
            turned = 0.0_wp
            turned_size = 0.0_wp
            passed = 0.0_wp
            passed_size = 0.0_wp
            do i = 0, beam%n
                k = min(i + 1, beam%n)
                associate (link => pack%links(min(l, stiffness_lanes), :, k), w => pack%w(l, i), r => pack%reaction(l, i), &
                           c => pack%contact(l, i), closed => pack%closed(l, i))
                    call check_link(w, pack%w(l, k), pack%mr(l, i), pack%ml(l, k), beam%inverse(k)*merge(1, 0, i < beam%n), &
                                    link(link_faa), link(link_fab), link(link_fbb), start, end, link_size, next, next_size)
                    off = start - turned + (pack%left(l, i) + pack%right(l, i))
                    size_of_off = link_size + turned_size
                    if (is_joined(beam, i)) call raise(abs(off), size_of_off, far(turns), most(turns))
                    call check_support(pack%stiffness(l, i), pack%rigid(l, i), c, closed, w, r, law, held, held_size, spring_size)
                    off = next - passed + (pack%shear(l, i) - r)
                    force_size = next_size + passed_size + (spring_size + abs(r))
                    call raise(abs(off), force_size, far(forces), most(forces))
                    turned = end
                    turned_size = link_size
                    passed = next
                    passed_size = next_size
                    if (beam%there(i) < 0.5_wp) cycle
                    level = abs(w) + abs(c)
                    m = merge(distances, reactions, held > 0.5_wp)
                    call raise(law, merge(level, force_size, m == distances), far(m), most(m))
                    off = wrong_way(beam%changes(i)*beam%side(i), c, closed, w, r)
                    m = merge(reactions, distances, closed > 0.5_wp)
                    call raise(off, merge(level, force_size, m == distances), far(m), most(m))
                end associate
            end do
            do m = 1, size(beam%restrained)
                do k = max(beam%restrained(m), 1), min(beam%restrained(m) + 1, beam%n)
                    call check_restraint(beam, pack%links, beam%n, m, k, pack%left, pack%right, pack%couple, pack%w, pack%ml, &
                                         pack%mr, of_restraint, size_of_restraint)
                    call raise(of_restraint(l), size_of_restraint(l), far(turns), most(turns))
                end do
            end do
            far(:) = far/most
            residuals(l, :) = [far(turns), far(forces), larger(far(reactions), far(distances))]
        end do
    end subroutine measure_pack

    !> Raise largest values
    elemental subroutine raise(off, size_of_off, far, most)
        real(wp), intent(in) :: off, size_of_off
        real(wp), intent(inout) :: far, most

        far = larger(far, off)
        most = larger(most, size_of_off)
    end subroutine raise

end module gapbeam_lane_certificate
