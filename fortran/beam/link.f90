!> All pieces between two nodes condensed into one link, exactly, and recovered again.
!>
!> A link is the simply supported bar of docs/method.md 2 between two nodes. Its flexibilities are kept in
!> the form of the elastic centre: the total bending flexibility, its centroid and its spread. Every one of
!> them is a sum of terms of one sign, so they lose no digits however many pieces there are.
module gapbeam_link
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: sum_type, add, total, load_moment, moment_integrals, field_type
    use gapbeam_piece, only: piece_type, piece_load_type, no_load, is_tapered, any_load, combine_loads
    use gapbeam_taper, only: find_softness, turn_ends
    implicit none
    private
    public :: link_type, piece_type, piece_load_type, condense_link, condense_loads, recover_link, combine_loads
    public :: along_type, next_piece, moments_about_right_end, no_load, drop_loads_of_link

    !> A condensed link; index 1 dead, 2 live
    type :: link_type
        !> Distance of the two nodes and its reciprocal
        real(wp) :: length, inverse
        !> int 1/EI, int (1-xi)/EI = f_aa + f_ab, int xi/EI = f_ab + f_bb
        real(wp) :: bending, sum_a, sum_b
        !> Flexibilities of docs/method.md 2 and the determinant f_aa f_bb - f_ab**2, formed without subtraction
        real(wp) :: faa, fab, fbb, determinant
        !> Rotations t_a, t_b of the ends of the simple bar under its loads
        real(wp) :: turn_a(2), turn_b(2)
        !> Shear of the simple bar at its ends
        real(wp) :: shear_a(2), shear_b(2)
        !> Sums of the absolute values of all loads, and of the rotations they could make: what rounding is relative to
        real(wp) :: load_sum(2), turn_sum(2)
    end type link_type

    !> What loads do along the pieces of a link, one after the other, whatever their stiffnesses
    type :: along_type
        !> Distances of the ends of the piece from the left end of the link; moments of the simple bar there; moment_integrals
        real(wp) :: x0 = 0.0_wp, x1 = 0.0_wp, m0 = 0.0_wp, m1 = 0.0_wp, left = 0.0_wp, right = 0.0_wp
        !> Moment of the loads so far about the left end of the link, and the length; sum of the peaks that each alone would make
        type(sum_type) :: moment, position
        real(wp) :: peaks = 0.0_wp
    end type along_type

contains

    !> Condense the pieces between two nodes into one link
    pure subroutine condense_link(pieces, dead, live, work, link)
        !> The pieces, left to right, shape (n)
        type(piece_type), intent(in) :: pieces(:)
        !> Their dead and live loads, shape (n); the point load of the last one belongs to the node
        type(piece_load_type), intent(in) :: dead(:), live(:)
        !> Workspace, shape (at least n)
        real(wp), intent(inout) :: work(:)
        !> The condensed link
        type(link_type), intent(out) :: link

        call condense_flexibility(pieces, link)
        call condense_loads(pieces, dead, link, 1, work)
        call condense_loads(pieces, live, link, 2, work)
    end subroutine condense_link

    !> Flexibilities of the link: total, centroid and spread of 1/EI along it (elastic centre), and shear
    pure subroutine condense_flexibility(pieces, link)
        type(piece_type), intent(in) :: pieces(:)
        type(link_type), intent(inout) :: link
        type(sum_type) :: length, bending, first, second, shear
        real(wp) :: centre, spread, shear_term, local, own_centre, own_spread, slip
        integer :: j

        if (size(pieces) == 1 .and. .not. (pieces(1)%hinge > 0.0_wp .or. is_tapered(pieces(1)))) then
            link%length = pieces(1)%length
            link%bending = pieces(1)%flexibility*link%length
            centre = 0.5_wp
            spread = 1.0_wp/12.0_wp
            shear_term = pieces(1)%shear_flexibility/link%length
        else
            if (pieces(1)%hinge > 0.0_wp) call add(bending, pieces(1)%hinge)
            do j = 1, size(pieces)
                associate (p => pieces(j))
                    local = p%flexibility*p%length
                    own_centre = p%length/2
                    slip = p%shear_flexibility*p%length
                    if (p%power + p%shear_power > 0) call find_softness(p, local, own_centre, own_spread, slip)
                    call add(bending, local)
                    call add(first, local*(total(length) + own_centre))
                    call add(shear, slip)
                    call add(length, p%length)
                end associate
            end do
            link%length = total(length)
            link%bending = total(bending)
            centre = 0.5_wp
            if (link%bending > 0.0_wp) centre = total(first)/link%bending
            if (pieces(1)%hinge > 0.0_wp) call add(second, pieces(1)%hinge*centre**2)
            length = sum_type()
            do j = 1, size(pieces)
                associate (p => pieces(j))
                    local = p%flexibility*p%length
                    own_centre = p%length/2
                    own_spread = p%length**2/12
                    if (p%power + p%shear_power > 0) call find_softness(p, local, own_centre, own_spread, slip)
                    call add(second, local*((total(length) + own_centre - centre)**2 + own_spread))
                    call add(length, p%length)
                end associate
            end do
            centre = centre/link%length
            spread = 0.0_wp
            if (link%bending > 0.0_wp) spread = total(second)/link%bending/link%length**2
            shear_term = total(shear)/link%length**2
        end if
        link%inverse = 1/link%length
        call condense_centre(link%bending, centre, spread, shear_term, link%sum_a, link%sum_b, link%faa, link%fab, link%fbb, &
                             link%determinant)
    end subroutine condense_flexibility

    !> Load terms of the link for one load case
    pure subroutine condense_loads(pieces, loads, link, k, work)
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: loads(:)
        type(link_type), intent(inout) :: link
        integer, intent(in) :: k
        real(wp), intent(inout) :: work(:)
        type(along_type) :: at
        type(sum_type) :: turn_a, turn_b, slip
        real(wp) :: right_end, turning, softer, slips, left_part, right_part, slipping
        integer :: j, n

        n = size(pieces)
        call drop_loads_of_link(link, k)
        if (.not. any_load(loads)) return
        if (n == 1 .and. .not. is_tapered(pieces(1))) then
            call condense_load(pieces(1), loads(1), link, k)
            call add_end_couples(pieces, loads(1)%couple_a, loads(1)%couple_b, link, k)
            return
        end if

        call moments_about_right_end(pieces, loads, work, right_end)
        slips = 0.0_wp
        do j = 1, n
            call next_piece(pieces(j)%length, loads(j), link%length, merge(right_end, work(max(1, j - 1)), j == 1), work(j), &
                            j == n, at)
            associate (p => pieces(j), q => loads(j))
                left_part = p%flexibility*at%left
                right_part = p%flexibility*at%right
                if (p%power + p%shear_power > 0) call turn_ends(p, at%m0, at%m1, q%qa, q%qb, left_part, right_part, slipping)
                turning = left_part - (q%kappa/2 + q%rise/6)*p%length
                call add(turn_a, (1 - at%x0/link%length)*turning)
                call add(turn_b, (at%x0/link%length)*turning)
                turning = right_part - (q%kappa/2 + q%rise/3)*p%length
                call add(turn_a, (1 - at%x1/link%length)*turning)
                call add(turn_b, (at%x1/link%length)*turning)
                ! What GA has in common along the link slips under couples only, for the moment is zero at both ends
                softer = p%shear_flexibility - pieces(1)%shear_flexibility
                call add(slip, softer*(at%m1 - at%m0))
                slips = slips + abs(softer)*(abs(at%m0) + abs(at%m1))
                if (p%shear_power > 0) then
                    call add(slip, slipping - p%shear_flexibility*(at%m1 - at%m0))
                    slips = slips + max(p%shear_flexibility, p%shear_flexibility_to)*(abs(at%m0) + abs(at%m1) &
                        + (abs(q%qa) + abs(q%qb))*p%length**2)
                end if
                link%load_sum(k) = link%load_sum(k) + (abs(q%qa) + abs(q%qb))*p%length/2
                link%turn_sum(k) = link%turn_sum(k) + (abs(q%kappa) + abs(q%rise))*p%length + abs(q%kink_a) + abs(q%kink_b)
                if (j < n) then
                    call add(slip, -pieces(1)%shear_flexibility*q%couple)
                    slips = slips + pieces(1)%shear_flexibility*abs(q%couple)
                    link%load_sum(k) = link%load_sum(k) + abs(q%force) + abs(q%couple)/link%length
                end if
            end associate
        end do
        ! No moment of the simple bar exceeds the sum of the peaks of all loads alone. Ends held fast against a slip meet the shear
        ! compliance, too: it counts as a rotation that bending alone would answer with the same moment
        slips = slips/link%length
        if (link%determinant > 0.0_wp) slips = min(slips, slips*link%bending*(link%bending/link%determinant))
        link%turn_sum(k) = link%turn_sum(k) + link%bending*at%peaks + slips
        link%turn_a(k) = total(turn_a) - total(slip)/link%length - loads(1)%kink_a
        link%turn_b(k) = total(turn_b) + total(slip)/link%length - loads(n)%kink_b
        link%shear_a(k) = right_end/link%length
        link%shear_b(k) = -total(at%moment)/link%length
        call add_end_couples(pieces, loads(1)%couple_a, loads(n)%couple_b, link, k)
    end subroutine condense_loads

    !> Leave out its dead (1) or live (2) loads
    elemental subroutine drop_loads_of_link(link, k)
        type(link_type), intent(inout) :: link
        integer, intent(in) :: k

        link%turn_a(k) = 0.0_wp
        link%turn_b(k) = 0.0_wp
        link%shear_a(k) = 0.0_wp
        link%shear_b(k) = 0.0_wp
        link%load_sum(k) = 0.0_wp
        link%turn_sum(k) = 0.0_wp
    end subroutine drop_loads_of_link

    !> Couples just inside the ends: as moments there would, but that at the left end does not turn an elastic hinge
    pure subroutine add_end_couples(pieces, couple_a, couple_b, link, k)
        type(piece_type), intent(in) :: pieces(:)
        !> Clockwise
        real(wp), intent(in) :: couple_a, couple_b
        !> With its flexibilities and its other loads
        type(link_type), intent(inout) :: link
        integer, intent(in) :: k
        type(piece_type) :: inside(size(pieces))
        type(link_type) :: without

        if (.not. max(abs(couple_a), abs(couple_b)) > 0.0_wp) return
        inside(:) = pieces
        inside(1)%hinge = 0.0_wp
        call condense_flexibility(inside, without)
        link%turn_a(k) = link%turn_a(k) + (without%faa*couple_a - link%fab*couple_b)
        link%turn_b(k) = link%turn_b(k) + (link%fab*couple_a - link%fbb*couple_b)
        link%shear_a(k) = link%shear_a(k) - (couple_a + couple_b)*link%inverse
        link%shear_b(k) = link%shear_b(k) - (couple_a + couple_b)*link%inverse
        link%load_sum(k) = link%load_sum(k) + (abs(couple_a) + abs(couple_b))*link%inverse
        link%turn_sum(k) = link%turn_sum(k) + link%bending*(abs(couple_a) + abs(couple_b))
    end subroutine add_end_couples

    !> Go on to the next piece of a link
    pure subroutine next_piece(length, load, of_link, before, behind, is_last, at)
        !> Its length and load; length of the link
        real(wp), intent(in) :: length
        type(piece_load_type), intent(in) :: load
        real(wp), intent(in) :: of_link
        !> By moments_about_right_end: loads right of its left end, and of its right end
        real(wp), intent(in) :: before, behind
        logical, intent(in) :: is_last
        !> At first as it is made
        type(along_type), intent(inout) :: at

        at%x0 = at%x1
        at%m0 = (1 - at%x0/of_link)*total(at%moment) + (at%x0/of_link)*before
        call add(at%moment, load_moment(at%x0, length, load%qa, load%qb))
        call add(at%position, length)
        at%x1 = total(at%position)
        if (is_last) at%x1 = of_link
        at%m1 = (1 - at%x1/of_link)*total(at%moment) + (at%x1/of_link)*before_point(behind, load, of_link - at%x1, is_last)
        call moment_integrals(length, at%m0, at%m1, load%qa, load%qb, at%left, at%right)
        at%peaks = at%peaks + (abs(load%qa) + abs(load%qb))*length*(at%x1*(of_link - at%x0)/of_link)
        if (is_last) return
        at%peaks = at%peaks + abs(load%force)*at%x1*(of_link - at%x1)/of_link + abs(load%couple)
        call add(at%moment, load%force*at%x1)
        call add(at%moment, load%couple)
    end subroutine next_piece

    !> The same for a link of one piece, where nothing is to be summed; no zero is to be negative
    pure subroutine condense_load(piece, load, link, k)
        type(piece_type), intent(in) :: piece
        type(piece_load_type), intent(in) :: load
        !> With its flexibility
        type(link_type), intent(inout) :: link
        integer, intent(in) :: k
        real(wp) :: left_part, right_part

        associate (l => piece%length, q => load)
            call moment_integrals(l, 0.0_wp, 0.0_wp, q%qa, q%qb, left_part, right_part)
            link%turn_a(k) = 0.0_wp + (piece%flexibility*left_part - ((q%kappa/2 + q%rise/6)*l + q%kink_a))
            link%turn_b(k) = 0.0_wp + (piece%flexibility*right_part - ((q%kappa/2 + q%rise/3)*l + q%kink_b))
            link%shear_a(k) = (0.0_wp + load_moment(0.0_wp, l, q%qb, q%qa))/l
            link%shear_b(k) = -(0.0_wp + load_moment(0.0_wp, l, q%qa, q%qb))/l
            link%load_sum(k) = (abs(q%qa) + abs(q%qb))*l/2
            link%turn_sum(k) = abs(q%kink_a) + abs(q%kink_b) + (abs(q%kappa) + abs(q%rise))*l &
                + link%bending*((abs(q%qa) + abs(q%qb))*l*(l*l/l))
        end associate
    end subroutine condense_load

    !> Sum of the moments about the right end of all loads that lie to the right of each interior point
    pure subroutine moments_about_right_end(pieces, loads, right, all_of_them)
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: loads(:)
        !> right(j): loads strictly to the right of the right end of piece j
        real(wp), intent(inout) :: right(:)
        !> The same for the left end of the link
        real(wp), intent(out) :: all_of_them
        type(sum_type) :: sum_right, distance
        integer :: j, n

        n = size(pieces)
        right(n) = 0.0_wp
        do j = n, 2, -1
            call add(sum_right, load_moment(total(distance), pieces(j)%length, loads(j)%qb, loads(j)%qa))
            call add(distance, pieces(j)%length)
            right(j - 1) = total(sum_right)
            call add(sum_right, loads(j - 1)%force*total(distance))
            call add(sum_right, -loads(j - 1)%couple)
        end do
        call add(sum_right, load_moment(total(distance), pieces(1)%length, loads(1)%qb, loads(1)%qa))
        all_of_them = total(sum_right)
    end subroutine moments_about_right_end

    !> The same just left of the point at the right end of a piece: its point load is still to the right
    elemental function before_point(right, load, y, is_last) result(moment)
        real(wp), intent(in) :: right
        type(piece_load_type), intent(in) :: load
        real(wp), intent(in) :: y
        logical, intent(in) :: is_last
        real(wp) :: moment

        moment = right
        if (.not. is_last) moment = right + (load%force*y - load%couple)
    end function before_point

    !> Fields at the left end of every piece of a link, from the fields at its nodes.
    !> Sums run from both ends towards the point, so that no large parts cancel.
    pure subroutine recover_link(pieces, loads, length, node_a, node_b, node_shear, w_a, w_b, psi_a, work, starts)
        !> Pieces and their loads (already combined), shape (n)
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: loads(:)
        !> Length of the link
        real(wp), intent(in) :: length
        !> Moments at its nodes, shear that belongs to them, deflections of its ends, rotation at its left end
        real(wp), intent(in) :: node_a, node_b, node_shear, w_a, w_b, psi_a
        !> Workspace, shape (at least n, 3)
        real(wp), intent(inout) :: work(:, :)
        !> Fields just right of the left end of every piece, shape (n)
        type(field_type), intent(out) :: starts(:)
        type(sum_type) :: left, position, turning, first, slip
        real(wp) :: right_end, x0, x1, xi, m1, before, beside, slipping, moment_a, moment_b, shear
        integer :: j, n

        n = size(pieces)
        beside = psi_a + loads(1)%kink_a
        if (pieces(1)%hinge > 0.0_wp) beside = beside - pieces(1)%hinge*node_a
        ! Inside the couples at its ends
        moment_a = node_a + loads(1)%couple_a
        moment_b = node_b - loads(n)%couple_b
        shear = node_shear - (loads(1)%couple_a + loads(n)%couple_b)/length
        if (n == 1) then
            ! Nothing to be summed; no zero is to be negative
            associate (q => loads(1), l => pieces(1)%length)
                starts(1)%deflection = w_a + 0.0_wp
                starts(1)%rotation = beside
                starts(1)%moment = moment_a + 0.0_wp
                starts(1)%shear = shear + (0.0_wp + load_moment(0.0_wp, l, q%qb, q%qa))/length
            end associate
            return
        end if
        call moments_about_right_end(pieces, loads, work(:, 1), right_end)
        ! Forward: moment, shear, rotation; the turning of each piece, weighted to its ends, waits in work(:, 2:3)
        x1 = 0.0_wp
        before = right_end
        do j = 1, n
            associate (p => pieces(j), q => loads(j))
                x0 = x1
                xi = x0/length
                starts(j)%moment = (1 - xi)*(moment_a + total(left)) + xi*(moment_b + before)
                starts(j)%shear = shear + (before - total(left))/length
                starts(j)%rotation = beside - total(turning)
                starts(j)%deflection = total(slip)
                call add(left, load_moment(x0, p%length, q%qa, q%qb))
                call add(position, p%length)
                x1 = total(position)
                if (j == n) x1 = length
                xi = x1/length
                m1 = (1 - xi)*(moment_a + total(left)) &
                    + xi*(moment_b + before_point(work(j, 1), q, length - x1, j == n))
                call moment_integrals(p%length, starts(j)%moment, m1, q%qa, q%qb, work(j, 2), work(j, 3))
                work(j, 2:3) = p%flexibility*work(j, 2:3)
                slipping = p%shear_flexibility*(m1 - starts(j)%moment)
                if (p%power + p%shear_power > 0) call turn_ends(p, starts(j)%moment, m1, q%qa, q%qb, work(j, 2), work(j, 3), &
                                                                slipping)
                work(j, 2:3) = work(j, 2:3) - [q%kappa/2 + q%rise/6, q%kappa/2 + q%rise/3]*p%length
                call add(turning, work(j, 2) + work(j, 3))
                call add(slip, slipping)
                before = work(j, 1)
                if (j < n) then
                    call add(left, q%force*x1)
                    call add(left, q%couple)
                end if
            end associate
        end do
        ! Backward: first moment of the turning right of each piece's start, about the right end of the link
        position = sum_type()
        do j = n, 1, -1
            call add(first, work(j, 3)*total(position))
            call add(position, pieces(j)%length)
            call add(first, work(j, 2)*total(position))
            work(j, 1) = total(first)
        end do
        ! Forward again: deflections by Mohr's theorem, shear deflection relative to the chord
        first = sum_type()
        position = sum_type()
        do j = 1, n
            x0 = total(position)
            xi = x0/length
            starts(j)%deflection = (1 - xi)*(w_a + total(first)) + xi*(w_b + work(j, 1)) &
                + (starts(j)%deflection - xi*total(slip))
            call add(first, work(j, 2)*x0)
            call add(position, pieces(j)%length)
            call add(first, work(j, 3)*total(position))
        end do
    end subroutine recover_link

    include 'beam/elastic_centre.inc'

end module gapbeam_link
