!> Relative residuals of eight cases for their certificates (gapbeam_lane_audit).
module gapbeam_lane_measures
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_beam_type, pack_type, link_faa, link_fab, link_fbb
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_audit, only: is_joined, check_link, check_support, check_restraint, wrong_way
    implicit none
    private
    public :: measure_pack

contains

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

    include 'cases/larger.inc'

end module gapbeam_lane_measures
