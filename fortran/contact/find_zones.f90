!> Zones of contact, and of the pieces of laws, that a solution asks for.
!> All crossings inside every stretch are isolated with certainty, and what acts between them is judged anew.
module gapbeam_find_zones
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: one_crossing, one_place_on_curves, touching_width, lying_width
    use gapbeam_watch, only: is_stopped
    use gapbeam_foundation, only: stretch_load_type
    use gapbeam_foundation_fields, only: fields_at
    use gapbeam_ordered, only: sort
    use gapbeam_foundation_roots, only: find_crossings, find_limits
    use gapbeam_curved, only: curved_type, curved_fields
    use gapbeam_laws, only: law_cubic, parameters_of_law
    use gapbeam_layers, only: layer_type, pieces_of_law, has_curves, other_way
    use gapbeam_ground_laws, only: contact_line, breaks_on_line, line_of_breakpoint, piece_of_deflection, parameters_at
    use gapbeam_workspace, only: workspace_type
    use gapbeam_foundation_stretch, only: without_slip
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, new_zones, resize, steps_of_piece
    use gapbeam_stretch_loads, only: combined_load
    use gapbeam_ground_steps, only: border_of_step
    use gapbeam_zone_fields, only: ends_of, take_curved
    implicit none
    private
    public :: find_zones

    !> Shares of a stretch without crossings at which it is looked on which side it is, the next one where a place only touches
    real(wp), parameter :: looks(2) = [0.5_wp, 0.375_wp]

contains

    !> The zones that a solution asks for
    subroutine find_zones(ground, grounded, zones, factor, work, found)
        type(ground_type), intent(in) :: ground
        !> The beam on its zones, solved in work at a load factor
        type(grounded_type), intent(in) :: grounded
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        type(workspace_type), intent(in) :: work
        !> The zones with which to go on; not to be used where the work is stopped
        type(zones_type), intent(out) :: found
        real(wp), allocatable :: cuts(:)
        type(zones_type) :: next
        integer :: j, first, last, m, number, room, looked
        !> At the places of a new stretch where it is looked, so many of which are known
        real(wp) :: deflection(size(looks))
        logical :: curves

        curves = any(has_curves(ground%layers))
        room = 4*size(zones%piece)
        call new_zones(room, size(zones%acts, 1), zones%steps, next)
        if (curves) call cut_finer()
        m = 0
        last = 0
        do j = 1, size(ground%pieces)
            first = last + 1
            last = grounded%node(j)
            call cut_piece(j)
            if (m + number > room) then
                room = 2*(m + number)
                call resize(next, room, m)
            end if
            call judge_piece(j)
        end do
        call resize(next, m, m)
        found = next
        if (curves) call carry_fields()

    contains

        !> Fields at the left ends of the new stretches
        subroutine carry_fields()
            real(wp) :: w, psi, moment, shear, share
            integer :: i, k, of

            i = 1
            do k = 1, m
                do while (i < size(zones%piece))
                    if (zones%piece(i) == found%piece(k) .and. found%from(k) < zones%to(i)) exit
                    if (zones%piece(i) == found%piece(k) .and. zones%piece(i + 1) /= found%piece(k)) exit
                    i = i + 1
                end do
                share = (found%from(k) - zones%from(i))/(zones%to(i) - zones%from(i))
                of = i
                if (i > 1 .and. .not. share > 0.0_wp) then
                    ! What a longer stretch says of its end is known better
                    if (zones%piece(i - 1) == zones%piece(i) &
                        .and. grounded%stretches(i - 1)%length > grounded%stretches(i)%length) then
                        of = i - 1
                        share = 1.0_wp
                    end if
                end if
                call find_fields(of, share, w, psi, moment, shear)
                found%start(:, k) = [without_slip(grounded%stretches(of), share, w, moment), psi, moment, shear]
            end do
        end subroutine carry_fields

        !> Other steps where ground has become stiffer, by no more than twice as many in a round, or much softer
        subroutine cut_finer()
            real(wp) :: stiffer
            integer :: j, k

            do j = 1, size(ground%pieces)
                stiffer = 0.0_wp
                do k = ground%first(j), ground%first(j + 1) - 1
                    if (ground%layers(k)%law == law_cubic) stiffer = stiffer + stiffness_met(j, k)
                end do
                associate (steps => steps_of_piece(ground, j, stiffer), before => zones%steps(j))
                    if (steps > before .or. 4*steps < before) next%steps(j) = min(steps + steps/4, 2*before + 2)
                end associate
            end do
        end subroutine cut_finer

        !> Greatest slope of a cubic law at the nodes of a piece
        pure function stiffness_met(j, k) result(stiffness)
            integer, intent(in) :: j, k
            real(wp) :: stiffness, u, p(parameters_of_law)
            integer :: i

            stiffness = 0.0_wp
            do i = 1, size(zones%piece)
                if (zones%piece(i) /= j) cycle
                associate (layer => ground%layers(k), length => ground%pieces(j)%length)
                    p = max(abs(parameters_at(layer, zones%from(i), length)), abs(parameters_at(layer, zones%to(i), length)))
                    u = max(layer%side*(work%answers(i - 1)%deflection - contact_line(layer, zones%from(i), length)), &
                            layer%side*(work%answers(i)%deflection - contact_line(layer, zones%to(i), length)), 0.0_wp)
                end associate
                stiffness = max(stiffness, u*(2*p(2) + 3*p(3)*u))
            end do
        end function stiffness_met

        !> All places of a piece at which something may change: where it changed before, and where the deflection crosses the
        !> line at which a layer begins or goes on to another piece of its law
        subroutine cut_piece(piece)
            integer, intent(in) :: piece
            real(wp), allocatable :: xi(:)
            real(wp) :: lines(2, sum(pieces_of_law(ground%layers(ground%first(piece):ground%first(piece + 1) - 1))))
            real(wp) :: length, limits(parameters_of_law, 2), near
            type(curved_type), allocatable :: curved
            integer :: i, k, m, law

            length = ground%pieces(piece)%length
            near = merge(one_place_on_curves, one_crossing, curves)*length
            if (allocated(cuts)) deallocate (cuts)
            associate (other => next%steps(piece) /= zones%steps(piece), old => last - first + 1)
                allocate (cuts(old + merge(next%steps(piece), 0, other)))
                cuts(:old) = zones%to(first:last)
                do i = 1, size(cuts) - old
                    cuts(old + i) = border_of_step(ground%pieces(piece), i, next%steps(piece))
                end do
            end associate
            do i = first, last
                if (is_stopped(ground%beam%watch)) exit
                call take_curved(ground, grounded, zones, factor, work, i, curved)
                associate (from => zones%from(i), to => zones%to(i))
                    m = 0
                    do k = ground%first(piece), ground%first(piece + 1) - 1
                        associate (layer => ground%layers(k))
                            if (layer%side == 0) cycle
                            do law = 1, pieces_of_law(layer)
                                if (law == 1 .or. breaks_on_line(layer)) then
                                    m = m + 1
                                    lines(:, m) = [line_of_breakpoint(ground%laws, layer, law, from, length), &
                                                   line_of_breakpoint(ground%laws, layer, law, to, length)]
                                    cycle
                                end if
                                limits = reshape([parameters_at(layer, from, length), parameters_at(layer, to, length)], &
                                                 shape(limits))
                                call find_limits(grounded%stretches(i), load_of(i), ends_of(grounded, factor, work, i), &
                                                 contact_line(layer, [from, to], length), layer%side, limits(1, :), &
                                                 limits(2, :), xi, curved)
                                if (size(xi) > 0) cuts = [cuts, from + xi*(to - from)]
                            end do
                        end associate
                    end do
                    call find_crossings(grounded%stretches(i), load_of(i), ends_of(grounded, factor, work, i), lines(:, :m), xi, &
                                        curved)
                    if (size(xi) > 0) cuts = [cuts, from + xi*(to - from)]
                end associate
            end do
            call sort(cuts)
            number = 0
            do i = 1, size(cuts)
                if (number > 0) then
                    if (cuts(i) - cuts(number) <= near) then
                        if (i == size(cuts)) cuts(number) = cuts(i)
                        cycle
                    end if
                else if (cuts(i) <= near) then
                    cycle
                end if
                number = number + 1
                cuts(number) = cuts(i)
            end do
            cuts(number) = length
        end subroutine cut_piece

        !> What acts between the places, neighbours with the same joined
        subroutine judge_piece(piece)
            integer, intent(in) :: piece
            integer :: acts(size(zones%acts, 1))
            real(wp) :: from, middle
            integer :: i, k, c, step, steps
            logical :: joins

            steps = next%steps(piece)
            from = 0.0_wp
            i = first
            step = 1
            do c = 1, number
                middle = from + (cuts(c) - from)/2
                do while (i < last .and. zones%to(i) < middle)
                    i = i + 1
                end do
                acts(:) = 0
                looked = 0
                do k = ground%first(piece), ground%first(piece + 1) - 1
                    acts(k - ground%first(piece) + 1) = piece_at(k, i, from, cuts(c))
                end do
                joins = .false.
                if (from > 0.0_wp) joins = all(acts == next%acts(:, m))
                do while (step < steps)
                    ! Steps of ground that varies stay
                    if (from < border_of_step(ground%pieces(piece), step, steps)) exit
                    joins = .false.
                    step = step + 1
                end do
                if (joins) then
                    next%to(m) = cuts(c)
                else
                    m = m + 1
                    next%piece(m) = piece
                    next%from(m) = from
                    next%to(m) = cuts(c)
                    next%acts(:, m) = acts
                end if
                from = cuts(c)
            end do
        end subroutine judge_piece

        !> Fields at a share of a stretch
        pure subroutine find_fields(i, share, w, psi, moment, shear)
            integer, intent(in) :: i
            real(wp), intent(in) :: share
            real(wp), intent(out) :: w, psi, moment, shear
            type(curved_type), allocatable :: curved

            call take_curved(ground, grounded, zones, factor, work, i, curved)
            if (allocated(curved)) then
                call curved_fields(curved, share, w, psi, moment, shear)
            else
                call fields_at(grounded%stretches(i), load_of(i), ends_of(grounded, factor, work, i), share, w, psi, moment, shear)
            end if
        end subroutine find_fields

        !> The piece of its law on which a layer is between two places without crossings in between
        function piece_at(k, i, from, to) result(acts)
            !> Layer, stretch, and distances from the left end of the piece
            integer, intent(in) :: k, i
            real(wp), intent(in) :: from, to
            integer :: acts, before, law, look
            real(wp) :: psi, moment, shear, length, place

            associate (layer => ground%layers(k))
                acts = 1
                if (layer%side == 0) return
                length = ground%pieces(zones%piece(i))%length
                do look = 1, size(looks)
                    place = from + (to - from)*looks(look)
                    if (look > looked) then
                        call find_fields(i, (place - zones%from(i))/(zones%to(i) - zones%from(i)), deflection(look), psi, moment, &
                                         shear)
                        looked = look
                    end if
                    acts = piece_of_deflection(ground%laws, layer, deflection(look), place, length)
                    if (.not. touches(layer, acts, deflection(look), place, length)) exit
                end do
                look = min(look, size(looks))
                if (acts == 0 .and. holds_both_ways(k, zones%piece(i))) then
                    ! A beam at rest is held once: by the one that pushes up
                    if (layer%side > 0 .and. .not. abs(deflection(look) - contact_line(layer, place, length)) > 0.0_wp) acts = 1
                    return
                end if
                before = zones%acts(k - ground%first(zones%piece(i)) + 1, i)
                if (before <= acts) return
                ! A beam that lies on it without any load stays as it is
                do law = before, acts + 1, -1
                    if (.not. is_on_line(layer, law, deflection(look), place, length, lying_width)) cycle
                    acts = law
                    return
                end do
            end associate
        end function piece_at

        !> Is a layer one of two that hold both ways
        pure function holds_both_ways(k, piece) result(it_does)
            !> Layer, and the piece of the beam that it is under
            integer, intent(in) :: k, piece
            logical :: it_does

            associate (first => ground%first(piece), last => ground%first(piece + 1) - 1)
                it_does = other_way(ground%layers(first:last), k - first + 1) > 0
            end associate
        end function holds_both_ways

        !> Is a layer at a place on a line between pieces of its law but for rounding, so that it tells nothing of the places beside
        pure function touches(layer, acts, w, place, length)
            type(layer_type), intent(in) :: layer
            integer, intent(in) :: acts
            real(wp), intent(in) :: w, place, length
            logical :: touches
            integer :: law

            touches = any([(is_on_line(layer, law, w, place, length, touching_width), &
                            law=max(1, acts), min(acts + 1, pieces_of_law(layer)))])
        end function touches

        !> Is it on the line at which a piece of its law begins, but for rounding
        pure function is_on_line(layer, law, w, place, length, width) result(it_is)
            type(layer_type), intent(in) :: layer
            integer, intent(in) :: law
            real(wp), intent(in) :: w, place, length
            !> Beside deflection and line
            real(wp), intent(in) :: width
            logical :: it_is
            real(wp) :: line

            line = line_of_breakpoint(ground%laws, layer, law, place, length)
            it_is = abs(w - line) <= width*max(abs(w), abs(line))
        end function is_on_line

        !> Load of a stretch at the factor
        pure function load_of(i) result(load)
            integer, intent(in) :: i
            type(stretch_load_type) :: load

            load = combined_load(grounded%dead(i), grounded%live(i), factor)
        end function load_of

    end subroutine find_zones

end module gapbeam_find_zones
