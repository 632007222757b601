!> The assembled model: the engine's arrays, and the way back to the user's places and supports.
module gapbeam_assembled_model
    use gapbeam_kinds, only: wp
    use gapbeam_words, only: shown
    use gapbeam_link, only: piece_type, piece_load_type
    use gapbeam_piece, only: greatest_softness
    use gapbeam_layers, only: layer_type, law_piece_type
    use gapbeam_model, only: beam_type, node_support_type
    use gapbeam_scene, only: section_type, model_type, support_type, law_point_type, load_type, gapbeam_distributed, &
        gapbeam_curvature, gapbeam_linear_curvature, gapbeam_temperature, gapbeam_movement, gapbeam_ground_movement, &
        gapbeam_support_rotation, gapbeam_couple_left, gapbeam_couple_right, gapbeam_axial_force, gapbeam_axial_distributed, &
        gapbeam_rotational, gapbeam_relative, gapbeam_rotational_left, gapbeam_rotational_right
    use gapbeam_stations, only: place_span_ends
    use gapbeam_units, only: units_type, rotation_unit, moment_unit
    implicit none
    private
    public :: in_bending, in_shear, along_axis, axial_force_in, kinds
    public :: assembled_type, axial_type, growth_of, turns, way_unit, push_unit, copy_model, copy_given, &
        is_stretch, is_along, has_ground_along, has_springs_along, is_movement, is_beside_point, is_alone, is_of_support, point_x, &
        place_x, from_to, piece_length, find_length_errors

    !> What spans and sections give: EI, GA, EA, and the axial force in bending
    integer, parameter :: in_bending = 1, in_shear = 2, along_axis = 3, axial_force_in = 4, kinds = 4

    !> The axial system: bars between points with an axial load or support, in units of its own; none allocated if it is not
    !> needed
    type :: axial_type
        !> Units of force and of displacement along the axis
        type(units_type) :: units
        !> Points of the beam that are its nodes, shape (0:n)
        integer, allocatable :: point(:)
        !> Length/EA of every piece of the beam, shape (npiece)
        real(wp), allocatable :: softness(:)
        !> Sum of that over the pieces left of every piece in the same bar, shape (npiece)
        real(wp), allocatable :: before(:)
        !> int 1/EA over each bar, shape (n)
        real(wp), allocatable :: flexibility(:)
        !> Dead and live force at each point, to the right, shape (2, 0:n)
        real(wp), allocatable :: force(:, :)
        !> Where temperatures make the beam longer, by how much each bar under dead and live loads, shape (2, n): every piece is a
        !> bar then
        real(wp), allocatable :: elongation(:, :)
        !> Where loads along the beam are distributed, their dead and live force on each bar, to the right, shape (2, n): every
        !> piece is a bar then. Half of it is at either end, so tensions are those in the middle
        real(wp), allocatable :: along_bar(:, :)
        !> Where ground holds the beam along its axis, most force of it along each bar, shape (n): every piece is a bar then
        real(wp), allocatable :: limit(:)
        !> Where that has a stiffness: it, along each bar, and the limits at both ends times the length, shapes (n) and (2, n)
        real(wp), allocatable :: bedding(:), limits(:, :)
        !> Support of each point, 0: none, shape (0:n)
        real(wp), allocatable :: stiffness(:), settlement(:)
        !> For every support of the model its node of this system; -1 for supports across the beam that do not rub
        integer, allocatable :: node(:)
        !> Where supports along the beam act one way, have a law or are moved by loads, or others rub: all of them as links, one
        !> entry a breakpoint, with its support of the model, and whether it is friction. In units of this system; friction has no
        !> limit yet
        type(node_support_type), allocatable :: laws(:)
        integer, allocatable :: support(:)
        logical, allocatable :: rubs(:)
    end type axial_type

    !> A model made ready
    type :: assembled_type
        !> What the user gave, and its fingerprint
        type(model_type) :: model
        integer :: fingerprint = 0
        !> Points of the laws of its supports, those of laws by name too
        type(law_point_type), allocatable :: law(:)
        !> The engine's units
        type(units_type) :: units
        !> x of the span ends, shape (0:nspan), and the point at each of them
        real(wp), allocatable :: ends(:)
        integer, allocatable :: end_point(:)
        !> Points between pieces: span, distance from the span's left end, shape (0:npiece)
        integer, allocatable :: point_span(:)
        real(wp), allocatable :: point_offset(:)
        !> Point of every support; first and last point of every load
        integer, allocatable :: support_point(:), load_from(:), load_to(:)
        !> First and last point of every foundation; point of every point of tables, then of laws, -1: not on its foundation
        integer, allocatable :: foundation_from(:), foundation_to(:), ground_point(:)
        !> Point of every lumped mass
        integer, allocatable :: mass_point(:)
        !> First and last point of every section; the last section that gives EI, GA, EA, N of a piece, 0: none, shape (4, npiece),
        !> not allocated without sections
        integer, allocatable :: section_from(:), section_to(:), section_of(:, :)
        !> Is there a hinge at a point; couple per relative rotation of an elastic one, 0: none; shape (0:npiece)
        logical, allocatable :: hinged(:)
        real(wp), allocatable :: joint(:)
        !> Pieces and their loads in the engine's units, shape (npiece)
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: dead(:), live(:)
        !> Kinds of the nodes with restraints that are next to nothing, shape (0:n); not allocated where there have been none
        integer, allocatable :: kind_with_all(:)
        !> Ground under the pieces in the engine's units: the layers of piece j are layer_first(j) to layer_first(j + 1) - 1, and of
        !> their laws every piece; none allocated without foundations. With them every point is a node, so every piece a link
        type(layer_type), allocatable :: layers(:)
        integer, allocatable :: layer_first(:)
        type(law_piece_type), allocatable :: law_pieces(:)
        !> Points that are nodes, shape (0:nlink), the last pieces of links; node of every point, -1: none, shape (0:npiece)
        integer, allocatable :: node_point(:), node_of_point(:)
        !> The beam in the engine's units
        type(beam_type) :: beam
        !> For every support of the beam its number in the model: those across the beam that can carry, and those of rotations
        integer, allocatable :: normal(:)
        !> For every support of the model its place among those of the beam, 0: none
        integer, allocatable :: beam_support(:)
        !> Which supports of the model have a law
        logical, allocatable :: with_law(:)
        !> Settlement of every support as the user gave it, where movements with the dead loads have been added to it; movement that
        !> grows with the load factor, where any does. In the user's units, shape (nsupport)
        real(wp), allocatable :: given_settlement(:), growth(:)
        !> How far loads move both ends of layers at load factor 1, in units of these, shape (2, size(layers)); if they do at all
        real(wp), allocatable :: layer_growth(:, :)
        !> What of the tension of the pieces (at load factor 1) grows with the load factor, in the engine's units, shape (npiece);
        !> not allocated where nothing does
        real(wp), allocatable :: tension_growth(:)
        !> Does a state depend on the loading history to it (gapbeam_assemble_laws), or are there loads that move supports
        logical :: depends_on_path = .false.
        !> Stiffness of the rotational restraint of every node in the user's units, shape (0:nlink), and the share that every
        !> support of the model has in that of its node
        real(wp), allocatable :: turning(:), couple_share(:)
        type(axial_type) :: axial
    end type assembled_type

contains

    !> Movement of every support of the engine at load factor 1, in its units
    pure function growth_of(assembled) result(growth)
        type(assembled_type), intent(in) :: assembled
        real(wp) :: growth(size(assembled%normal))
        integer :: k

        growth(:) = 0.0_wp
        if (.not. allocated(assembled%growth)) return
        do k = 1, size(growth)
            growth(k) = scale(assembled%growth(assembled%normal(k)), -way_unit(assembled, assembled%normal(k)))
        end do
    end function growth_of

    !> Does a support hold a rotation, so that angles and couples take the place of lengths and forces
    elemental function turns(support) result(it_does)
        type(support_type), intent(in) :: support
        logical :: it_does

        it_does = any(support%direction == [gapbeam_rotational, gapbeam_relative, gapbeam_rotational_left, &
                                            gapbeam_rotational_right])
    end function turns

    !> Unit of the displacement of a support, as a power of two
    pure function way_unit(assembled, support) result(power)
        type(assembled_type), intent(in) :: assembled
        !> Its number in the model, not along the beam
        integer, intent(in) :: support
        integer :: power

        power = assembled%units%deflection
        if (turns(assembled%model%supports(support))) power = rotation_unit(assembled%units)
    end function way_unit

    !> Unit of its force
    pure function push_unit(assembled, support) result(power)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: support
        integer :: power

        power = assembled%units%force
        if (turns(assembled%model%supports(support))) power = moment_unit(assembled%units)
    end function push_unit

    !> Does a load act over a stretch
    elemental function is_stretch(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = any(load%kind == [gapbeam_distributed, gapbeam_curvature, gapbeam_temperature, gapbeam_axial_distributed, &
                                gapbeam_linear_curvature])
    end function is_stretch

    !> Does ground hold the beam along its axis over a section
    elemental function has_ground_along(section) result(it_does)
        type(section_type), intent(in) :: section
        logical :: it_does

        it_does = max(section%friction, section%friction_to) > 0.0_wp
    end function has_ground_along

    !> Does it give way before the beam slides
    elemental function has_springs_along(section) result(it_does)
        type(section_type), intent(in) :: section
        logical :: it_does

        it_does = has_ground_along(section) .and. section%bedding <= huge(1.0_wp)
    end function has_springs_along

    !> Is a load a force along the beam, and nothing else
    elemental function is_along(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = any(load%kind == [gapbeam_axial_force, gapbeam_axial_distributed])
    end function is_along

    !> Does a load act on the ends of the pieces beside a point: a rotation of a support, a couple on one side of a hinge
    elemental function is_beside_point(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = any(load%kind == [gapbeam_support_rotation, gapbeam_couple_left, gapbeam_couple_right])
    end function is_beside_point

    !> Is a load such a one, or a curvature that changes along the beam: cases with those are solved one by one, and influence lines
    !> of cubic pieces do not know them
    elemental function is_alone(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = is_beside_point(load) .or. load%kind == gapbeam_linear_curvature
    end function is_alone

    !> Does a load move something, a support or a foundation
    elemental function is_movement(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = any(load%kind == [gapbeam_movement, gapbeam_ground_movement])
    end function is_movement

    !> Is a load a movement or a rotation of a support, whose number it has instead of a node
    elemental function is_of_support(load) result(yes)
        type(load_type), intent(in) :: load
        logical :: yes

        yes = any(load%kind == [gapbeam_movement, gapbeam_support_rotation])
    end function is_of_support

    !> x of a point
    pure function point_x(assembled, point) result(x)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: point
        real(wp) :: x

        x = assembled%ends(assembled%point_span(point)) + assembled%point_offset(point)
    end function point_x

    !> x of a place in a piece
    elemental function place_x(assembled, piece, distance) result(x)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: piece
        !> From its left end, in the engine's units
        real(wp), intent(in) :: distance
        real(wp) :: x

        x = point_x(assembled, piece - 1) + scale(distance, assembled%units%length)
    end function place_x

    !> "from x = 0 to x = 6": a stretch between two points, blanks behind it
    pure function from_to(assembled, first, last) result(text)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: first, last
        character(len=80) :: text

        text = "from x = "//trim(shown(point_x(assembled, first)))//" to x = "//trim(shown(point_x(assembled, last)))
    end function from_to

    !> Length of a piece in the user's units
    pure function piece_length(assembled, piece) result(length)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: piece
        real(wp) :: length

        associate (span => assembled%point_span, offset => assembled%point_offset)
            if (span(piece) == span(piece - 1)) then
                length = offset(piece) - offset(piece - 1)
            else
                length = assembled%model%spans(span(piece - 1) + 1)%length - offset(piece - 1)
            end if
        end associate
    end function piece_length

    !> What links, their flexibilities and loads may be off, relative to them, since places are: a distance in a span is an x less
    !> the rounded end of a span
    subroutine find_length_errors(assembled, errors)
        type(assembled_type), intent(in) :: assembled
        !> Shape (nlink)
        real(wp), intent(out) :: errors(:)
        real(wp), allocatable :: rest(:), ends(:)
        real(wp) :: shift, length, each(3), sums(3), shifted(3)
        integer :: i, j

        allocate (rest(0:size(assembled%model%spans)), ends(0:size(assembled%model%spans)))
        call place_span_ends(assembled%model%spans, ends, rest)
        do i = 1, size(errors)
            length = 0.0_wp
            sums(:) = tiny(sums)
            shifted(:) = 0.0_wp
            do j = assembled%node_point(i - 1) + 1, assembled%node_point(i)
                shift = shift_of(j - 1) + shift_of(j)
                associate (piece => assembled%pieces(j), dead => assembled%dead(j), live => assembled%live(j))
                    each = [greatest_softness(piece), &
                            max(abs(dead%qa), abs(dead%qb)) + max(abs(live%qa), abs(live%qb))]
                end associate
                shifted(:) = shifted + shift*each
                sums(:) = sums + piece_length(assembled, j)*each
                length = length + piece_length(assembled, j)
            end do
            shift = shift_of(assembled%node_point(i - 1)) + shift_of(assembled%node_point(i))
            errors(i) = max(shift/length, maxval(shifted/sums))
        end do

    contains

        !> What the distance of a point from the left end of its span may be off
        pure function shift_of(point) result(shift)
            integer, intent(in) :: point
            real(wp) :: shift

            shift = 0.0_wp
            associate (span => assembled%point_span(point), offset => assembled%point_offset(point))
                if (.not. offset > 0.0_wp) return
                shift = abs(rest(span))
                ! The difference of numbers of which one is less than twice the other is exact
                if (span > 0 .and. offset > ends(span)) shift = shift + spacing(offset)/2
            end associate
        end function shift_of

    end subroutine find_length_errors

    !> Copy the model of a beam as it was given: movements with the dead loads are in the settlements of the one it holds
    pure subroutine copy_given(assembled, copy, stat)
        type(assembled_type), intent(in) :: assembled
        !> As for copy_model
        type(model_type), intent(out) :: copy
        integer, intent(out) :: stat

        call copy_model(assembled%model, copy, stat)
        if (stat == 0 .and. allocated(assembled%given_settlement)) copy%supports%settlement = assembled%given_settlement
    end subroutine copy_given

    !> Copy a model, what is missing as arrays of size 0
    pure subroutine copy_model(source, copy, stat)
        !> What the user gave
        type(model_type), intent(in) :: source
        !> With all its arrays allocated
        type(model_type), intent(out) :: copy
        !> 0, or what allocate says where memory is at an end
        integer, intent(out) :: stat
        integer :: spans, hinges, sections, supports, points, foundations, ground, ground_law, loads, masses

        spans = 0
        hinges = 0
        sections = 0
        supports = 0
        points = 0
        foundations = 0
        ground = 0
        ground_law = 0
        loads = 0
        masses = 0
        if (allocated(source%spans)) spans = size(source%spans)
        if (allocated(source%hinges)) hinges = size(source%hinges)
        if (allocated(source%sections)) sections = size(source%sections)
        if (allocated(source%supports)) supports = size(source%supports)
        if (allocated(source%law)) points = size(source%law)
        if (allocated(source%foundations)) foundations = size(source%foundations)
        if (allocated(source%ground)) ground = size(source%ground)
        if (allocated(source%ground_law)) ground_law = size(source%ground_law)
        if (allocated(source%loads)) loads = size(source%loads)
        if (allocated(source%masses)) masses = size(source%masses, 2)
        allocate (copy%spans(spans), copy%hinges(hinges), copy%hinge_stiffness(hinges), copy%sections(sections), &
                  copy%supports(supports), copy%law(points), copy%masses(2, masses), &
                  copy%foundations(foundations), copy%ground(ground), copy%ground_law(ground_law), copy%loads(loads), stat=stat)
        if (stat /= 0) return
        if (spans > 0) copy%spans(:) = source%spans
        if (hinges > 0) copy%hinges(:) = source%hinges
        copy%hinge_stiffness(:) = 0.0_wp
        if (allocated(source%hinge_stiffness)) copy%hinge_stiffness(:) = source%hinge_stiffness
        if (sections > 0) copy%sections(:) = source%sections
        if (supports > 0) copy%supports(:) = source%supports
        if (points > 0) copy%law(:) = source%law
        if (foundations > 0) copy%foundations(:) = source%foundations
        if (ground > 0) copy%ground(:) = source%ground
        if (ground_law > 0) copy%ground_law(:) = source%ground_law
        if (loads > 0) copy%loads(:) = source%loads
        if (allocated(source%masses)) copy%masses(:, :) = source%masses
        copy%N_grows = source%N_grows
        copy%first_order = source%first_order
        copy%axial_loads_bend = source%axial_loads_bend
        copy%stretching = source%stretching
        copy%with_trains = source%with_trains
    end subroutine copy_model

end module gapbeam_assembled_model
