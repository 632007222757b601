!> Zones of contact, and of the pieces of laws, on a solved mesh: a start for gapbeam_zones.
module gapbeam_mesh_zones
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: one_place_on_curves, lone_node_zone
    use gapbeam_laws, only: law_cubic, parameters_of_law
    use gapbeam_layers, only: pieces_of_law
    use gapbeam_taper, only: softness_at
    use gapbeam_ground_laws, only: distance_to_breakpoint, parameters_at, slope_at
    use gapbeam_ground, only: ground_type, zones_type, new_zones, resize, steps_of, steps_of_piece
    use gapbeam_ground_steps, only: border_of_step
    use gapbeam_ground_mesh, only: mesh_type, acts_at
    implicit none
    private
    public :: zones_of_mesh

contains

    !> The zones that a solved mesh shows, straight between its nodes
    subroutine zones_of_mesh(ground, mesh, zones)
        type(ground_type), intent(in) :: ground
        type(mesh_type), intent(in) :: mesh
        type(zones_type), intent(out) :: zones
        !> Places along a piece at which a layer goes on to a piece of its law, which of them, and to which piece
        real(wp), allocatable :: cuts(:)
        integer, allocatable :: layer(:), to(:), steps(:)
        integer :: j, m, number

        allocate (steps(size(ground%pieces)), source=steps_of(ground))
        do j = 1, size(steps)
            if (stiffer(j) > 0.0_wp) then
                steps(j) = steps_of_piece(ground, j, stiffer(j))
                steps(j) = steps(j) + steps(j)/4
            end if
        end do
        call new_zones(sum(steps) + size(mesh%piece), maxval(ground%first(2:) - ground%first(:size(steps))), steps, zones)
        allocate (cuts(16), layer(16), to(16))
        m = 0
        do j = 1, size(steps)
            call cut_piece(j)
            call make_zones(j)
        end do
        call resize(zones, m, m)

    contains

        !> Greatest slope that cubic laws under a piece have gained
        pure function stiffer(piece) result(stiffness)
            integer, intent(in) :: piece
            real(wp) :: stiffness, most, p(parameters_of_law)
            integer :: i, k

            stiffness = 0.0_wp
            do k = ground%first(piece), ground%first(piece + 1) - 1
                if (ground%layers(k)%law /= law_cubic) cycle
                most = 0.0_wp
                do i = mesh%node(piece - 1) + 1, mesh%node(piece)
                    associate (layer => ground%layers(k), length => ground%pieces(piece)%length)
                        p = parameters_at(layer, mesh%to(i), length)
                        most = max(most, slope_at(layer, ground%laws, acts_at(ground, mesh, k, i, 2), mesh%to(i), length, &
                                                  mesh%deflection(i)) - p(1))
                    end associate
                end do
                stiffness = stiffness + most
            end do
        end function stiffer

        !> All places of a piece at which a layer goes on to another piece of its law, in order
        subroutine cut_piece(piece)
            integer, intent(in) :: piece
            integer :: i, k, law, first, last

            number = 0
            first = mesh%node(piece - 1) + 1
            last = mesh%node(piece)
            do i = first, last
                do k = ground%first(piece), ground%first(piece + 1) - 1
                    if (ground%layers(k)%side == 0) cycle
                    do law = 1, pieces_of_law(ground%layers(k))
                        call cut_part(i, k, law, [merge(i - 1, i, i > first), i, merge(i + 1, i, i < last)])
                    end do
                end do
            end do
        end subroutine cut_piece

        !> Does a layer go on to a piece of its law in a part
        subroutine cut_part(i, k, law, parts)
            integer, intent(in) :: i, k, law
            !> The part before, the part, the one behind, as far as they are in the piece
            integer, intent(in) :: parts(3)
            real(wp) :: past(2), share
            integer :: beyond

            past = [past_breakpoint(i, 1, k, law), past_breakpoint(i, 2, k, law)]
            if (past(1) > 0.0_wp .eqv. past(2) > 0.0_wp) return
            share = past(1)/(past(1) - past(2))
            if (law == 1) then
                ! A node that alone is pressed stands for a zone that is shorter than its parts
                if (past(1) > 0.0_wp) then
                    beyond = parts(1)
                    if (beyond == i .or. .not. past_breakpoint(beyond, 1, k, law) > 0.0_wp) share = max(share, lone_node_zone)
                else
                    beyond = parts(3)
                    if (beyond == i .or. .not. past_breakpoint(beyond, 2, k, law) > 0.0_wp) share = min(share, 1 - lone_node_zone)
                end if
            end if
            call add(mesh%from(i) + share*(mesh%to(i) - mesh%from(i)), k - ground%first(mesh%piece(i)) + 1, &
                     merge(law - 1, law, past(1) > 0.0_wp))
        end subroutine cut_part

        !> How far the beam is beyond a breakpoint of a layer at an end of a part
        pure function past_breakpoint(part, end, k, law) result(past)
            integer, intent(in) :: part, end, k, law
            real(wp) :: past, change

            call distance_to_breakpoint(ground%laws, ground%layers(k), law, mesh%deflection(part + end - 2), 0.0_wp, &
                                        merge(mesh%from(part), mesh%to(part), end == 1), ground%pieces(mesh%piece(part))%length, &
                                        past, change)
        end function past_breakpoint

        !> One more place
        subroutine add(place, layer_of_piece, piece_of_law)
            real(wp), intent(in) :: place
            integer, intent(in) :: layer_of_piece, piece_of_law
            integer :: at

            if (number == size(cuts)) then
                cuts = [cuts, cuts]
                layer = [layer, layer]
                to = [to, to]
            end if
            at = number + 1
            do while (at > 1)
                if (cuts(at - 1) <= place) exit
                cuts(at) = cuts(at - 1)
                layer(at) = layer(at - 1)
                to(at) = to(at - 1)
                at = at - 1
            end do
            cuts(at) = place
            layer(at) = layer_of_piece
            to(at) = piece_of_law
            number = number + 1
        end subroutine add

        !> The stretches of a piece between these places, and between its steps
        subroutine make_zones(piece)
            integer, intent(in) :: piece
            integer :: acts(size(zones%acts, 1)), k, c, step, part
            real(wp) :: from, next, length, border

            length = ground%pieces(piece)%length
            acts(:) = 0
            do k = ground%first(piece), ground%first(piece + 1) - 1
                acts(k - ground%first(piece) + 1) = acts_at(ground, mesh, k, mesh%node(piece - 1) + 1, 1)
            end do
            from = 0.0_wp
            c = 1
            step = 1
            part = mesh%node(piece - 1) + 1
            do
                ! What changes here or next to it
                do while (c <= number)
                    if (cuts(c) > from + one_place_on_curves*length) exit
                    acts(layer(c)) = to(c)
                    c = c + 1
                end do
                border = border_of_step(ground%pieces(piece), step, steps(piece))
                next = border
                if (c <= number) next = min(next, cuts(c))
                if (next >= border - one_place_on_curves*length) then
                    next = border
                    step = step + 1
                end if
                if (m == size(zones%piece)) call resize(zones, 2*m, m)
                m = m + 1
                zones%piece(m) = piece
                zones%from(m) = from
                zones%to(m) = next
                zones%acts(:, m) = acts
                do while (part < mesh%node(piece) .and. mesh%to(part) <= from)
                    part = part + 1
                end do
                zones%start(:, m) = fields_in(part, (from - mesh%from(part))/(mesh%to(part) - mesh%from(part)))
                from = next
                if (step > steps(piece)) exit
            end do
        end subroutine make_zones

        !> Fields (v, psi, M, V) in a part: moments straight between its ends, shears between the middles of the parts
        pure function fields_in(part, share) result(fields)
            integer, intent(in) :: part
            real(wp), intent(in) :: share
            real(wp) :: fields(4), length, shears(2), a, b, soft(2)

            associate (p => ground%pieces(mesh%piece(part)), f => soft(1), g => soft(2))
                length = mesh%to(part) - mesh%from(part)
                soft(:) = softness_at(p, mesh%from(part) + share*length)
                a = mesh%moment_right(part - 1)
                b = mesh%moment_left(part)
                shears = [shear_at(part, max(part - 1, mesh%node(mesh%piece(part) - 1) + 1)), &
                          shear_at(part, min(part + 1, mesh%node(mesh%piece(part))))]
                fields(3) = a + share*(b - a)
                fields(4) = shears(1) + share*(shears(2) - shears(1))
                fields(2) = (mesh%deflection(part) - mesh%deflection(part - 1))/length &
                    + f*length*(a*(1.0_wp/3 - share + share**2/2) + b*(1.0_wp/6 - share**2/2)) &
                    - g*(b - a)/length
                fields(1) = mesh%deflection(part - 1) + share*(mesh%deflection(part) - mesh%deflection(part - 1)) &
                    + f*length**2*share*(1 - share)*(a*(2 - share) + b*(1 + share))/6 - g*fields(3)
            end associate
        end function fields_in

        !> Shear between two parts
        pure function shear_at(one, other) result(shear)
            integer, intent(in) :: one, other
            real(wp) :: shear

            shear = ((mesh%moment_left(one) - mesh%moment_right(one - 1))/(mesh%to(one) - mesh%from(one)) &
                     + (mesh%moment_left(other) - mesh%moment_right(other - 1))/(mesh%to(other) - mesh%from(other)))/2
        end function shear_at

    end subroutine zones_of_mesh

end module gapbeam_mesh_zones
