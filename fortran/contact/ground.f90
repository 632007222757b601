!> A beam on the ground: its pieces, the layers of ground under them, and the zones in which the layers act.
!>
!> Where the zones are known, the problem is that of a beam on stretches of elastic ground: a beam_type with a link for every
!> stretch. gapbeam_zones finds them.
module gapbeam_ground
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_band, only: plain
    use gapbeam_foundation, only: stretch_type, stretch_load_type, condense_stretch, load_stretch, decay_lengths
    use gapbeam_layers, only: layer_type, law_piece_type, pieces_of_law, law_piece
    use gapbeam_model, only: beam_type, node_support_type, order_supports
    implicit none
    private
    public :: ground_type, zones_type, grounded_type
    public :: new_zones, resize, full_contact, place_stretches, contact_line, along, between, steps_of_piece
    public :: line_of_kink, piece_of_deflection, slope_of_layer, combined_load

    !> A beam and the ground under it
    type :: ground_type
        !> The beam without ground; every piece is a link of its own
        type(beam_type) :: beam
        !> Pieces and their loads, shape (n)
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: dead(:), live(:)
        !> Layers of ground; those of piece j are first(j) to first(j + 1) - 1
        type(layer_type), allocatable :: layers(:)
        integer, allocatable :: first(:)
        !> Pieces of all laws
        type(law_piece_type), allocatable :: laws(:)
    end type ground_type

    !> Stretches of the beam, in each of which every layer stays on one piece of its law
    type :: zones_type
        !> Piece of the beam, shape (m), from left to right
        integer, allocatable :: piece(:)
        !> Distances of its ends from the left end of the piece, shape (m)
        real(wp), allocatable :: from(:), to(:)
        !> Piece of its law on which each layer of the piece acts, 0: not in contact, shape (most layers of a piece, m)
        integer, allocatable :: acts(:, :)
    end type zones_type

    !> The beam on the zones at hand
    type :: grounded_type
        !> A link for every stretch
        type(beam_type) :: beam
        !> What the links are made of; dead loads with those of the layers, as if the beam were at deflection zero, shape (m)
        type(stretch_type), allocatable :: stretches(:)
        type(stretch_load_type), allocatable :: dead(:), live(:)
        !> Node of this beam for every node of the beam without ground, shape (0:n)
        integer, allocatable :: node(:)
    end type grounded_type

contains

    !> Room for stretches
    pure subroutine new_zones(stretches, layers, zones)
        !> Number of stretches, most layers of a piece
        integer, intent(in) :: stretches, layers
        !> Nothing set yet
        type(zones_type), intent(out) :: zones

        allocate (zones%piece(stretches), zones%from(stretches), zones%to(stretches), zones%acts(layers, stretches))
    end subroutine new_zones

    !> Room for another number of stretches, the first ones kept
    pure subroutine resize(zones, room, kept)
        type(zones_type), intent(inout) :: zones
        integer, intent(in) :: room, kept
        type(zones_type) :: other

        call new_zones(room, size(zones%acts, 1), other)
        other%piece(:kept) = zones%piece(:kept)
        other%from(:kept) = zones%from(:kept)
        other%to(:kept) = zones%to(:kept)
        other%acts(:, :kept) = zones%acts(:, :kept)
        zones = other
    end subroutine resize

    !> All layers act everywhere, on the first piece of their law
    pure subroutine full_contact(ground, zones)
        type(ground_type), intent(in) :: ground
        !> The zones
        type(zones_type), intent(out) :: zones
        integer :: j, k, m, steps

        m = 0
        do j = 1, size(ground%pieces)
            m = m + steps_of_piece(ground, j)
        end do
        call new_zones(m, most_layers(ground), zones)
        m = 0
        do j = 1, size(ground%pieces)
            steps = steps_of_piece(ground, j)
            do k = 1, steps
                m = m + 1
                zones%piece(m) = j
                zones%from(m) = between(0.0_wp, ground%pieces(j)%length, k - 1, steps)
                zones%to(m) = between(0.0_wp, ground%pieces(j)%length, k, steps)
                zones%acts(:, m) = 0
                zones%acts(1:ground%first(j + 1) - ground%first(j), m) = 1
            end do
        end do
    end subroutine full_contact

    !> Largest number of layers under a piece
    pure function most_layers(ground) result(most)
        type(ground_type), intent(in) :: ground
        integer :: most

        most = maxval(ground%first(2:) - ground%first(:size(ground%pieces)))
    end function most_layers

    !> Into how many equal steps a piece is cut in any case: where the modulus varies, series hold for beta*length <= 1
    pure function steps_of_piece(ground, piece) result(steps)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: piece
        integer :: steps, k
        real(wp) :: modulus
        logical :: varies

        modulus = 0.0_wp
        varies = .false.
        do k = ground%first(piece), ground%first(piece + 1) - 1
            associate (layer => ground%layers(k))
                if (pieces_of_law(layer) > 1 .or. layer%law_last >= layer%law_first) cycle
                modulus = modulus + max(layer%modulus_a, layer%modulus_b)
                varies = varies .or. abs(layer%modulus_a - layer%modulus_b) > 0.0_wp
            end associate
        end do
        steps = 1
        if (.not. varies) return
        associate (p => ground%pieces(piece))
            steps = max(1, ceiling(decay_lengths(stretch_type(p%length, p%flexibility, p%shear_flexibility, modulus, modulus))))
        end associate
    end function steps_of_piece

    !> A place k of n steps from a to b, exactly b at the end
    elemental function between(a, b, k, n) result(place)
        real(wp), intent(in) :: a, b
        integer, intent(in) :: k, n
        real(wp) :: place

        place = a + (b - a)*k/n
        if (k == n) place = b
    end function between

    !> Value at a distance from the left end of what varies linearly along a length
    elemental function along(value_a, value_b, distance, length) result(value)
        real(wp), intent(in) :: value_a, value_b, distance, length
        real(wp) :: value

        if (distance <= 0.0_wp) then
            value = value_a
        else if (distance >= length) then
            value = value_b
        else
            value = value_a + (value_b - value_a)*(distance/length)
        end if
    end function along

    !> Deflection at which a layer begins to act, at a distance from the left end of its piece
    elemental function contact_line(layer, distance, length) result(level)
        type(layer_type), intent(in) :: layer
        !> Distance, and length of the piece
        real(wp), intent(in) :: distance, length
        real(wp) :: level

        level = along(layer%contact_a, layer%contact_b, distance, length)
    end function contact_line

    !> Deflection at which a layer goes on to a piece of its law
    pure function line_of_kink(ground, layer, number, distance, length) result(level)
        type(ground_type), intent(in) :: ground
        type(layer_type), intent(in) :: layer
        !> The piece, from 1, which begins there
        integer, intent(in) :: number
        real(wp), intent(in) :: distance, length
        real(wp) :: level
        type(law_piece_type) :: piece

        piece = law_piece(layer, ground%laws, number)
        level = contact_line(layer, distance, length) + layer%side*piece%displacement
    end function line_of_kink

    !> The piece of its law on which a layer is at a deflection, 0: it is not reached
    pure function piece_of_deflection(ground, layer, w, distance, length) result(number)
        type(ground_type), intent(in) :: ground
        type(layer_type), intent(in) :: layer
        !> Deflection at a distance from the left end of the piece, and length of the piece
        real(wp), intent(in) :: w, distance, length
        integer :: number

        do number = pieces_of_law(layer), 1, -1
            if (layer%side*(w - line_of_kink(ground, layer, number, distance, length)) > 0.0_wp) exit
        end do
    end function piece_of_deflection

    !> Force per length and deflection of a layer on a piece of its law, at a distance from the left end of the piece
    elemental function slope_of_layer(layer, law, distance, length) result(slope)
        type(layer_type), intent(in) :: layer
        !> The piece of its law
        type(law_piece_type), intent(in) :: law
        real(wp), intent(in) :: distance, length
        real(wp) :: slope

        slope = law%slope
        if (layer%law_last < layer%law_first) slope = along(layer%modulus_a, layer%modulus_b, distance, length)
    end function slope_of_layer

    !> The beam as it is on its zones
    pure subroutine place_stretches(ground, zones, grounded)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        !> The beam, ready to be solved
        type(grounded_type), intent(out) :: grounded
        type(node_support_type), allocatable :: supports(:)
        integer :: i, j, m, n

        m = size(zones%piece)
        n = size(ground%pieces)
        allocate (grounded%stretches(m), grounded%dead(m), grounded%live(m), grounded%node(0:n))
        associate (beam => grounded%beam, given => ground%beam)
            allocate (beam%links(m), beam%ground(m), beam%kind(0:m), beam%compliance(0:m), beam%force(2, 0:m), beam%couple(2, 0:m))
            beam%kind(:) = plain
            beam%compliance(:) = 0.0_wp
            beam%force(:, :) = 0.0_wp
            beam%couple(:, :) = 0.0_wp
            grounded%node(0) = 0
            do i = 1, m
                call place_stretch(ground, zones, i, grounded)
                grounded%node(zones%piece(i)) = i
            end do
            do j = 0, n
                i = grounded%node(j)
                beam%kind(i) = given%kind(j)
                beam%compliance(i) = given%compliance(j)
                beam%force(:, i) = given%force(:, j)
                beam%couple(:, i) = given%couple(:, j)
            end do
            allocate (supports(size(given%supports)))
            supports(:) = given%supports
            supports%node = grounded%node(given%supports%node)
            call order_supports(supports, beam)
        end associate
    end subroutine place_stretches

    !> One stretch: its ground, its loads, its link
    pure subroutine place_stretch(ground, zones, i, grounded)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        integer, intent(in) :: i
        type(grounded_type), intent(inout) :: grounded
        type(law_piece_type) :: law
        type(piece_type) :: piece(1)
        real(wp) :: work(1), slope(2), contact(2), offset
        integer :: k

        associate (j => zones%piece(i), s => grounded%stretches(i), dead => grounded%dead(i), live => grounded%live(i), &
                   link => grounded%beam%links(i), from => zones%from(i), to => zones%to(i), p => ground%pieces(zones%piece(i)))
            s = stretch_type(length=to - from, flexibility=p%flexibility, shear_flexibility=p%shear_flexibility)
            dead = load_between(ground%dead(j), from, to, p%length)
            live = load_between(ground%live(j), from, to, p%length)
            do k = ground%first(j), ground%first(j + 1) - 1
                associate (layer => ground%layers(k), acts => zones%acts(k - ground%first(j) + 1, i))
                    if (acts == 0) cycle
                    law = law_piece(layer, ground%laws, acts)
                    slope(:) = slope_of_layer(layer, law, [from, to], p%length)
                    contact(:) = contact_line(layer, [from, to], p%length)
                    offset = layer%side*(law%force - law%slope*law%displacement)
                    s%modulus_a = s%modulus_a + slope(1)
                    s%modulus_b = s%modulus_b + slope(2)
                    dead%qa = dead%qa + (slope(1)*contact(1) - offset)
                    dead%qb = dead%qb + (slope(2)*contact(2) - offset)
                    dead%qc = dead%qc - (slope(2) - slope(1))*(contact(2) - contact(1))
                end associate
            end do
            ! The bar without ground, for what needs its size only
            piece = piece_type(s%length, s%flexibility, s%shear_flexibility)
            call condense_link(piece, [piece_load(dead)], [piece_load(live)], work, link)
            call condense_stretch(s, grounded%beam%ground(i))
            call load_stretch(s, dead, link%turn_a(1), link%turn_b(1), link%shear_a(1), link%shear_b(1))
            call load_stretch(s, live, link%turn_a(2), link%turn_b(2), link%shear_a(2), link%shear_b(2))
            link%shear_b(:) = -link%shear_b
        end associate
    end subroutine place_stretch

    !> The load of a piece on a stretch of it
    pure function load_between(load, from, to, length) result(found)
        type(piece_load_type), intent(in) :: load
        real(wp), intent(in) :: from, to, length
        type(stretch_load_type) :: found

        found = stretch_load_type(qa=along(load%qa, load%qb, from, length), qb=along(load%qa, load%qb, to, length), &
                                  kappa=load%kappa)
    end function load_between

    !> The same as the load of a piece
    pure function piece_load(load) result(found)
        type(stretch_load_type), intent(in) :: load
        type(piece_load_type) :: found

        found = piece_load_type(load%qa, load%qb, load%kappa, 0.0_wp, 0.0_wp)
    end function piece_load

    !> Dead plus factor times live
    elemental function combined_load(dead, live, factor) result(load)
        type(stretch_load_type), intent(in) :: dead, live
        real(wp), intent(in) :: factor
        type(stretch_load_type) :: load

        load = stretch_load_type(dead%qa + factor*live%qa, dead%qb + factor*live%qb, dead%qc + factor*live%qc, &
                                 dead%kappa + factor*live%kappa)
    end function combined_load

end module gapbeam_ground
