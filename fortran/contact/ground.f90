!> A beam on the ground: its pieces, the layers under them, and the zones in which these act.
!>
!> Where the zones are known, the problem is that of a beam on stretches of elastic ground: a beam_type with a link for every
!> stretch. gapbeam_zones finds them.
module gapbeam_ground
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: piece_type, piece_load_type, link_type, condense_link
    use gapbeam_foundation_stretch, only: stretch_between, are_alike, same_load
    use gapbeam_band, only: plain
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_link_type, condense_loaded
    use gapbeam_curved, only: curved_type, condense_curved
    use gapbeam_layers, only: layer_type, law_piece_type, law_piece, is_curve
    use gapbeam_stretch_loads, only: add_end_loads, ends_of_piece, load_on_part, on_stretch, on_piece, combined_load
    use gapbeam_ground_steps, only: steps_on, border_of_step
    use gapbeam_ground_laws, only: contact_line, slope_of_layer, offset_of_layer, take_curves
    use gapbeam_model, only: beam_type, take_supports
    implicit none
    private
    public :: ground_type, moving_type, zones_type, grounded_type
    public :: new_zones, resize, full_contact, place_stretches, steps_of, steps_of_piece
    ! For gapbeam_ground_nodes
    public :: condense_both
    ! For gapbeam_modes
    public :: stretch_on_layers, curved_stretch

    !> Where supports and ground begin to act at load factor 0 (1), and how far loads move that while it grows by 1 (2); and axial
    !> forces that bending feels, the same
    type :: moving_type
        !> Of the supports, shape (2, size(supports))
        real(wp), allocatable :: supports(:, :)
        !> Of the layers at both ends of their pieces, shape (2, 2, size(layers))
        real(wp), allocatable :: layers(:, :, :)
        !> Tension of the pieces from given load factors on, and by how much it grows from there, shapes (m) and (2, n, m); the
        !> first factor is 0; not allocated where it does not grow
        real(wp), allocatable :: begins(:), tension(:, :, :)
        !> By how much more they are at the right ends, shape (2, n); not allocated where they are constant
        real(wp), allocatable :: tension_change(:, :)
    end type moving_type

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
        !> Not allocated where loads move nothing
        type(moving_type), allocatable :: moving
        !> Of a vibration, whose mass pushes as ground of a negative modulus would (gapbeam_modes)
        real(wp) :: frequency_squared = 0.0_wp
        !> Lumped masses at the nodes, shape (0:n); not allocated where there are none
        real(wp), allocatable :: mass(:)
    end type ground_type

    !> Stretches of the beam, in each of which every layer stays on one piece of its law
    type :: zones_type
        !> Piece of the beam, shape (m), from left to right
        integer, allocatable :: piece(:)
        !> Distances of its ends from the left end of the piece, shape (m)
        real(wp), allocatable :: from(:), to(:)
        !> Piece of its law on which each layer of the piece acts, 0: not in contact, shape (most layers of a piece, m)
        integer, allocatable :: acts(:, :)
        !> Fields (v = w - M/GA, psi, M, V) at the left ends, near which curves are taken for straight, shape (4, m); else unused
        real(wp), allocatable :: start(:, :)
        !> Into how many steps (border_of_step) every piece is cut in any case, so that series hold, shape (n)
        integer, allocatable :: steps(:)
        !> Does rigid ground push with a point force right of each, and left of the first, shape (0:m); else not allocated
        logical, allocatable :: pushed(:)
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
        !> The fields ran away on a curve: there is no such beam
        logical :: lost = .false.
    end type grounded_type

contains

    !> Room for stretches
    pure subroutine new_zones(stretches, layers, steps, zones)
        !> Number of stretches, most layers of a piece
        integer, intent(in) :: stretches, layers
        !> Steps of the pieces, shape (n)
        integer, intent(in) :: steps(:)
        !> Nothing else set yet but the fields, to 0
        type(zones_type), intent(out) :: zones

        allocate (zones%piece(stretches), zones%from(stretches), zones%to(stretches), zones%acts(layers, stretches), &
                  zones%start(4, stretches), zones%steps(size(steps)))
        zones%start(:, :) = 0.0_wp
        zones%steps(:) = steps
    end subroutine new_zones

    !> Room for another number of stretches, the first ones kept
    pure subroutine resize(zones, room, kept)
        type(zones_type), intent(inout) :: zones
        integer, intent(in) :: room, kept
        type(zones_type) :: other

        call new_zones(room, size(zones%acts, 1), zones%steps, other)
        other%piece(:kept) = zones%piece(:kept)
        other%from(:kept) = zones%from(:kept)
        other%to(:kept) = zones%to(:kept)
        other%acts(:, :kept) = zones%acts(:, :kept)
        other%start(:, :kept) = zones%start(:, :kept)
        zones = other
    end subroutine resize

    !> All layers act everywhere, on the first piece of their law
    pure subroutine full_contact(ground, zones)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(out) :: zones
        integer :: j, k, m

        call new_zones(sum(steps_of(ground)), maxval(ground%first(2:) - ground%first(:size(ground%pieces))), steps_of(ground), &
                       zones)
        m = 0
        do j = 1, size(ground%pieces)
            do k = 1, zones%steps(j)
                m = m + 1
                zones%piece(m) = j
                zones%from(m) = border_of_step(ground%pieces(j), k - 1, zones%steps(j))
                zones%to(m) = border_of_step(ground%pieces(j), k, zones%steps(j))
                zones%acts(:, m) = 0
                zones%acts(1:ground%first(j + 1) - ground%first(j), m) = 1
                if (ground%first(j) == ground%first(j + 1)) cycle
                ! As of a beam that lies on the first layer
                associate (layer => ground%layers(ground%first(j)), length => ground%pieces(j)%length)
                    zones%start(:2, m) = [contact_line(layer, zones%from(m), length), (layer%contact_b - layer%contact_a)/length]
                end associate
            end do
        end do
    end subroutine full_contact

    !> Steps of all pieces
    pure function steps_of(ground) result(steps)
        type(ground_type), intent(in) :: ground
        integer, allocatable :: steps(:)
        integer :: j

        allocate (steps(size(ground%pieces)))
        do j = 1, size(steps)
            steps(j) = steps_of_piece(ground, j)
        end do
    end function steps_of

    !> Into how many steps a piece is cut in any case
    pure function steps_of_piece(ground, piece, stiffer) result(steps)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: piece
        !> As for steps_on
        real(wp), intent(in), optional :: stiffer
        integer :: steps

        steps = steps_on(ground%layers(ground%first(piece):ground%first(piece + 1) - 1), ground%laws, ground%pieces(piece), stiffer)
    end function steps_of_piece

    !> The beam as it is on its zones
    pure subroutine place_stretches(ground, zones, factor, grounded, around)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        !> Load factor: under it curves are taken for straight
        real(wp), intent(in) :: factor
        !> The beam, ready to be solved
        type(grounded_type), intent(out) :: grounded
        !> In whose fields curves are taken for straight, where `ground` is how small motions feel it; default is that itself
        type(ground_type), intent(in), optional :: around
        integer :: i, j, m, n

        m = size(zones%piece)
        n = size(ground%pieces)
        allocate (grounded%stretches(m), grounded%dead(m), grounded%live(m), grounded%node(0:n))
        associate (beam => grounded%beam, given => ground%beam)
            allocate (beam%links(m), beam%ground(m), beam%kind(0:m), beam%compliance(0:m), beam%force(2, 0:m), beam%couple(2, 0:m))
            beam%watch = given%watch
            beam%kind(:) = plain
            beam%compliance(:) = 0.0_wp
            beam%force(:, :) = 0.0_wp
            beam%couple(:, :) = 0.0_wp
            grounded%node(0) = 0
            do i = 1, m
                call place_stretch(ground, zones, factor, i, grounded, around)
                if (grounded%lost) return
                grounded%node(zones%piece(i)) = i
            end do
            do j = 0, n
                i = grounded%node(j)
                beam%kind(i) = given%kind(j)
                beam%compliance(i) = given%compliance(j)
                beam%force(:, i) = given%force(:, j)
                beam%couple(:, i) = given%couple(:, j)
            end do
            call take_supports(given, grounded%node, beam)
        end associate
    end subroutine place_stretches

    !> One stretch: its ground, its loads, its link
    pure subroutine place_stretch(ground, zones, factor, i, grounded, around)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        integer, intent(in) :: i
        type(grounded_type), intent(inout) :: grounded
        type(ground_type), intent(in), optional :: around
        type(curved_type) :: curved

        associate (s => grounded%stretches(i), dead => grounded%dead(i), live => grounded%live(i), link => grounded%beam%links(i))
            call stretch_on_layers(ground, zones, i, s, dead, live)
            if (repeats()) then
                link = grounded%beam%links(i - 1)
                grounded%beam%ground(i) = grounded%beam%ground(i - 1)
                return
            end if
            call condense_both(s, dead, live, link, grounded%beam%ground(i))
            if (present(around)) then
                call curved_stretch(around, zones, factor, i, curved)
            else
                call curved_stretch(ground, zones, factor, i, curved)
            end if
            if (allocated(curved%curves)) then
                link%turn_a(2) = 0.0_wp
                link%turn_b(2) = 0.0_wp
                link%shear_a(2) = 0.0_wp
                link%shear_b(2) = 0.0_wp
                call condense_curved(curved, s, grounded%beam%ground(i), link%turn_a(1), link%turn_b(1), link%shear_a(1), &
                                     link%shear_b(1), grounded%lost)
                link%shear_b(1) = -link%shear_b(1)
            end if
            call add_end_loads(grounded%beam%ground(i), [dead, live], link)
        end associate

    contains

        !> Is it as the one before, so that it need not be condensed again
        pure function repeats() result(it_does)
            logical :: it_does

            it_does = .false.
            if (i == 1) return
            associate (s => grounded%stretches(i - 1:i), dead => grounded%dead(i - 1:i), live => grounded%live(i - 1:i))
                it_does = are_alike(s(1), s(2)) .and. same_load(dead(1), dead(2)) .and. same_load(live(1), live(2)) &
                    .and. .not. (on_curves(i - 1) .or. on_curves(i))
            end associate
        end function repeats

        !> Does ground act by curves on a stretch
        pure function on_curves(number) result(it_does)
            integer, intent(in) :: number
            logical :: it_does

            associate (first => ground%first(zones%piece(number)), last => ground%first(zones%piece(number) + 1) - 1)
                it_does = any(is_curve(ground%layers(first:last), zones%acts(:last - first + 1, number)))
            end associate
        end function on_curves

    end subroutine place_stretch

    !> A stretch on which ground acts by curves, and the fields from which it starts
    pure subroutine curved_stretch(ground, zones, factor, i, curved)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        real(wp), intent(in) :: factor
        !> Its number
        integer, intent(in) :: i
        !> Without curves, and nothing set, where none act
        type(curved_type), intent(out) :: curved
        type(stretch_load_type) :: dead, live

        associate (j => zones%piece(i))
            call take_curves(ground%layers(ground%first(j):ground%first(j + 1) - 1), ground%laws, zones%acts(:, i), &
                             zones%from(i), zones%to(i), ground%pieces(j)%length, curved%curves)
        end associate
        if (.not. allocated(curved%curves)) return
        call stretch_on_layers(ground, zones, i, curved%stretch, dead, live)
        curved%load = combined_load(dead, live, factor)
        curved%left = zones%start(:, i)
    end subroutine curved_stretch

    !> What a stretch is made of on its layers, but those that act by curves
    pure subroutine stretch_on_layers(ground, zones, i, stretch, dead, live)
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        !> Its number
        integer, intent(in) :: i
        type(stretch_type), intent(out) :: stretch
        !> Its loads, with those of the layers as if the beam were at deflection zero
        type(stretch_load_type), intent(out) :: dead, live
        type(law_piece_type) :: law
        real(wp) :: slope(2), contact(2), offset(2)
        integer :: k

        associate (j => zones%piece(i), s => stretch, from => zones%from(i), to => zones%to(i), p => ground%pieces(zones%piece(i)))
            s = stretch_between(p, from, to)
            s%modulus_a = 0.0_wp - ground%frequency_squared*p%mass
            s%modulus_b = s%modulus_a
            dead = on_stretch(load_on_part(ground%dead(j), from, to, p%length, ends_of_piece(zones%piece, i)))
            live = on_stretch(load_on_part(ground%live(j), from, to, p%length, ends_of_piece(zones%piece, i)))
            do k = ground%first(j), ground%first(j + 1) - 1
                associate (layer => ground%layers(k), acts => zones%acts(k - ground%first(j) + 1, i))
                    if (acts == 0 .or. is_curve(layer, acts)) cycle
                    if (layer%rigid) then
                        ! It takes all load that lies there, and holds any beam straight, and at rest
                        s%power(:) = 0
                        s%taper(:) = 0.0_wp
                        s%modulus_a = 0.0_wp
                        s%modulus_b = 0.0_wp
                        dead = stretch_load_type(kappa=dead%kappa)
                        live = stretch_load_type(kappa=live%kappa)
                        exit
                    end if
                    law = law_piece(layer, ground%laws, acts)
                    slope(:) = slope_of_layer(layer, law, acts, [from, to], p%length)
                    contact(:) = contact_line(layer, [from, to], p%length)
                    offset(:) = layer%side*offset_of_layer(layer, law, acts, [from, to], p%length)
                    s%modulus_a = s%modulus_a + slope(1)
                    s%modulus_b = s%modulus_b + slope(2)
                    dead%qa = dead%qa + (slope(1)*contact(1) - offset(1))
                    dead%qb = dead%qb + (slope(2)*contact(2) - offset(2))
                    dead%qc = dead%qc - (slope(2) - slope(1))*(contact(2) - contact(1))
                end associate
            end do
        end associate
    end subroutine stretch_on_layers

    !> A stretch as a link: the bar without ground and axial force, for what needs its size only, with what the loads make at its
    !> ends, and what it is on the ground
    pure subroutine condense_both(stretch, dead, live, bar, link)
        type(stretch_type), intent(in) :: stretch
        type(stretch_load_type), intent(in) :: dead, live
        type(link_type), intent(out) :: bar
        type(stretch_link_type), intent(out) :: link
        real(wp) :: work(1)

        call condense_link([piece_type(stretch%length, stretch%flexibility, stretch%shear_flexibility)], [on_piece(dead)], &
                           [on_piece(live)], work, bar)
        call condense_loaded(stretch, [dead, live], link, bar%turn_a, bar%turn_b, bar%shear_a, bar%shear_b)
        bar%shear_b(:) = -bar%shear_b
    end subroutine condense_both

end module gapbeam_ground
