!> Assembly of foundations as layers of ground under the pieces of the beam.
module gapbeam_assemble_foundations
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_laws, only: parameters_of_law, law_cubic, law_polyline
    use gapbeam_layers, only: layer_type
    use gapbeam_range, only: is_lost
    use gapbeam_scene, only: model_type, foundation_type, gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_unchanged, &
        gapbeam_law_by_points, gapbeam_law_plastic, gapbeam_table_of_k, gapbeam_table_of_gap, gapbeam_table_of_parameter
    use gapbeam_units, only: units_type, exponents_type, stiffness_unit
    use gapbeam_assembled_model, only: assembled_type, from_to
    use gapbeam_axial_force, only: in_stretches
    use gapbeam_assemble_tables, only: place_in_table, place_of, distance, between, follow_table
    use gapbeam_assemble_movements, only: move_layers
    use gapbeam_assemble_ground_laws, only: law_of_foundation_type, find_laws, make_laws, is_straight
    use gapbeam_check, only: entry_type, refuse_entry
    use gapbeam_check_foundations, only: find_tables, at_right, is_rigid, moduli_of, quantities
    use gapbeam_check_ground_laws, only: check_parameters
    use gapbeam_words, only: shown
    use gapbeam_input_error, only: refuse_range, named, of_foundations, bad_law
    implicit none
    private
    public :: assemble_foundations, note_foundations, scale_foundations, greatest_values

contains

    !> Layers and laws in the user's units; nothing without foundations, none where an axial force asks for stretches
    subroutine assemble_foundations(assembled, error)
        !> Points in
        type(assembled_type), intent(inout) :: assembled
        !> Laws that are impossible between the points of their tables, or no memory
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: first(:, :), last(:, :), next(:), here(:)
        type(law_of_foundation_type), allocatable :: laws(:)
        ! Modulus, gap and parameters at both ends of every piece
        real(wp), allocatable :: values(:, :, :)
        integer(int64) :: total
        integer :: i, j, m, stat, pieces

        if (.not. allocated(assembled%model%foundations)) return
        m = size(assembled%model%foundations)
        if (.not. in_stretches(assembled%model)) return
        pieces = size(assembled%pieces)
        if (.not. allocated(assembled%layers)) then
            allocate (assembled%layer_first(pieces + 1), stat=stat)
            if (failed(stat, error)) return
        end if
        allocate (first(quantities, m), last(quantities, m), laws(m), next(pieces), here(pieces), values(quantities, 2, pieces), &
                  stat=stat)
        if (failed(stat, error)) return
        associate (model => assembled%model, layers => assembled%layers, from => assembled%foundation_from, &
                   to => assembled%foundation_to)
            call find_tables(model%ground, first, last)
            call find_laws(assembled, laws)
            call make_laws(assembled, laws, error)
            if (allocated(error)) return
            next(:) = 0
            total = 0
            do i = 1, m
                call find_layers(i)
                if (allocated(error)) return
                total = total + sum(int(here(from(i) + 1:to(i)), int64))
                next(from(i) + 1:to(i)) = next(from(i) + 1:to(i)) + here(from(i) + 1:to(i))
            end do
            if (.not. allocated(assembled%layers)) then
                stat = merge(1, 0, total >= huge(m))
                if (stat == 0) allocate (assembled%layers(total), stat=stat)
                if (failed(stat, error)) return
            end if
            assembled%layer_first(1) = 1
            do j = 1, pieces
                assembled%layer_first(j + 1) = assembled%layer_first(j) + next(j)
                next(j) = assembled%layer_first(j)
            end do
            do i = 1, m
                call find_layers(i)
                do j = from(i) + 1, to(i)
                    if (here(j) > 0) assembled%layers(next(j)) = layer_at(i, j, merge(gapbeam_below, model%foundations(i)%side, &
                                                                                      here(j) == 2))
                    if (here(j) == 2) assembled%layers(next(j) + 1) = layer_at(i, j, gapbeam_above)
                    next(j) = next(j) + here(j)
                end do
            end do
        end associate
        call move_layers(assembled, error)

    contains

        !> Values of a foundation at the ends of its pieces, and how many layers it has there: none where it never carries
        subroutine find_layers(foundation)
            integer, intent(in) :: foundation
            integer :: number, piece, range(2)
            logical :: with_points

            call find_values(assembled, foundation, first(:, foundation), last(:, foundation), values)
            with_points = laws(foundation)%points > 0
            associate (f => assembled%model%foundations(foundation), a => assembled%foundation_from(foundation) + 1, &
                       b => assembled%foundation_to(foundation), q => gapbeam_table_of_gap)
                number = layers_of(f, with_points .or. f%law /= gapbeam_law_by_points, last(q, foundation) >= first(q, foundation))
                here(a:b) = number
                if (.not. (any(last(:, foundation) >= first(:, foundation)) .or. laws(foundation)%varies)) return
                do piece = a, b
                    range = range_under(foundation, piece)
                    if (with_points) then
                        if (.not. any(max(assembled%law_pieces(range(1):range(2))%slope_a, &
                                          assembled%law_pieces(range(1):range(2))%slope_b) > 0.0_wp)) here(piece) = 0
                    else if (.not. (is_rigid(f) .or. carries(f%law, values(:, :, piece)))) then
                        here(piece) = 0
                    end if
                end do
                if (.not. allocated(error)) call check_values(assembled, foundation, with_points, here, values, error)
            end associate
        end subroutine find_layers

        !> First and last piece of the law of a foundation under a piece of the beam
        pure function range_under(foundation, piece) result(range)
            integer, intent(in) :: foundation, piece
            integer :: range(2)

            range = [1, 0]
            associate (law => laws(foundation))
                if (law%points == 0) return
                range(1) = law%first
                if (law%varies) range(1) = law%first + (piece - assembled%foundation_from(foundation) - 1)*law%points
                range(2) = range(1) + law%points - 1
            end associate
        end function range_under

        !> The layer of a foundation under a piece
        pure function layer_at(foundation, piece, side) result(layer)
            integer, intent(in) :: foundation, piece, side
            type(layer_type) :: layer
            integer :: range(2)

            range = range_under(foundation, piece)
            associate (a => values(:, 1, piece), b => values(:, 2, piece), gap => gapbeam_table_of_gap)
                layer = layer_type(foundation=foundation, side=side, modulus_a=a(gapbeam_table_of_k), &
                                   modulus_b=b(gapbeam_table_of_k), contact_a=side*a(gap), contact_b=side*b(gap), &
                                   law_first=range(1), law_last=range(2), &
                                   law=assembled%model%foundations(foundation)%law, &
                                   parameter_a=a(gapbeam_table_of_parameter:), parameter_b=b(gapbeam_table_of_parameter:))
            end associate
            if (.not. is_straight(assembled%law_pieces(range(1):range(2)))) layer%law = law_polyline
            layer%rigid = is_rigid(assembled%model%foundations(foundation))
        end function layer_at

    end subroutine assemble_foundations

    !> Does ground with a modulus, or a law with parameters, carry on a piece at all
    pure function carries(law, values) result(does)
        integer, intent(in) :: law
        !> Modulus, gap and parameters at both ends
        real(wp), intent(in) :: values(:, :)
        logical :: does

        associate (p => values(gapbeam_table_of_parameter:, :))
            if (law == gapbeam_law_by_points) then
                does = any(values(gapbeam_table_of_k, :) > 0.0_wp)
            else if (law == law_cubic) then
                does = any(abs(p) > 0.0_wp)
            else
                does = any(p(1, :) > 0.0_wp)
                if (law == gapbeam_law_plastic) does = does .and. any(p(2, :) > 0.0_wp)
            end if
        end associate
    end function carries

    !> Is a foundation with tables possible on all its pieces
    pure subroutine check_values(assembled, foundation, with_points, layers, values, error)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: foundation
        !> Has it a law by points
        logical, intent(in) :: with_points
        !> How many layers it has on every piece; modulus, gap and parameters at both ends
        integer, intent(in) :: layers(:)
        real(wp), intent(in) :: values(:, :, :)
        type(error_type), allocatable, intent(out) :: error
        integer :: j

        associate (f => assembled%model%foundations(foundation), a => assembled%foundation_from(foundation) + 1, &
                   b => assembled%foundation_to(foundation), &
                   here => entry_type(of_foundations, foundation, size(assembled%model%foundations)))
            if (.not. any(layers(a:b) > 0)) then
                call refuse_entry(error, here, trim(merge("law", "k  ", with_points .or. f%law /= gapbeam_law_by_points)), &
                                  bad_law, "carries nowhere "//trim(from_to(assembled, a - 1, b))//"; remove the foundation")
                return
            end if
            if (f%law == gapbeam_law_by_points) return
            do j = a, b
                if (layers(j) == 0) cycle
                call check_parameters(f%law, values(gapbeam_table_of_parameter:, 1, j), values(gapbeam_table_of_parameter:, 2, j), &
                                      "the stretch "//trim(from_to(assembled, j - 1, j)), here, error)
                if (allocated(error)) return
            end do
        end associate
    end subroutine check_values

    !> Layers of a foundation under each of its pieces: two of one that holds both ways by a law or with a gap
    pure function layers_of(foundation, has_law, has_profile) result(number)
        type(foundation_type), intent(in) :: foundation
        logical, intent(in) :: has_law, has_profile
        integer :: number
        logical :: has_gap

        has_gap = has_profile .or. abs(foundation%gap) > 0.0_wp
        if (foundation%gap_to > gapbeam_unchanged) has_gap = has_gap .or. abs(foundation%gap_to) > 0.0_wp
        number = merge(2, 1, (has_law .or. has_gap) .and. foundation%side == gapbeam_both)
    end function layers_of

    !> Modulus, gap and parameters of its law of a foundation at both ends of its pieces
    pure subroutine find_values(assembled, foundation, first, last, values)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: foundation
        !> First and last point of its tables, the last before the first: none, shape (quantities)
        integer, intent(in) :: first(:), last(:)
        !> Shape (quantities, 2, npiece); set on its pieces
        real(wp), intent(inout) :: values(:, :, :)
        real(wp) :: whole, share, at_point(quantities), k(2)
        integer :: left, right, p, q

        left = assembled%foundation_from(foundation)
        right = assembled%foundation_to(foundation)
        whole = distance(assembled, place_of(assembled, left), place_of(assembled, right))
        k = moduli_of(assembled%model%foundations(foundation))
        associate (f => assembled%model%foundations(foundation))
            do p = left, right
                share = distance(assembled, place_of(assembled, left), place_of(assembled, p))/whole
                at_point = between([k(1), f%gap, f%parameter], [k(2), at_right(f%gap, f%gap_to), &
                                                                at_right(f%parameter, f%parameter_to)], share)
                if (p > left) values(:, 2, p) = at_point
                if (p < right) values(:, 1, p + 1) = at_point
            end do
        end associate
        do q = 1, quantities
            if (first(q) > last(q)) cycle
            call follow_table(assembled, left, right, place_in_table(assembled, [(p, p=first(q), last(q))], &
                                                                     assembled%model%ground(first(q):last(q))%x), &
                              assembled%model%ground(first(q):last(q))%value, values(q, :, left + 1:right))
        end do
    end subroutine find_values

    !> Meet the moduli and levels of all foundations
    pure subroutine note_foundations(assembled, length, stiffness, forces, ways)
        !> Layers in the user's units in
        type(assembled_type), intent(in) :: assembled
        !> The exponent of the unit of length
        integer, intent(in) :: length
        type(exponents_type), intent(inout) :: stiffness, forces, ways
        real(wp) :: most(quantities, size(assembled%model%foundations))
        integer :: i

        if (.not. allocated(assembled%layers)) return
        most(:, :) = greatest_values(assembled%model)
        do i = 1, size(assembled%model%foundations)
            call stiffness%note(most(gapbeam_table_of_k, i), length)
            associate (law => assembled%model%foundations(i)%law, parameters => most(gapbeam_table_of_parameter:, i))
                if (law == gapbeam_law_by_points) cycle
                call stiffness%note(parameters(1), length)
                if (law == law_cubic) cycle
                call forces%note(parameters(2), length)
                call stiffness%note(parameters(3), length)
            end associate
        end do
        do i = 1, size(assembled%law_pieces)
            associate (piece => assembled%law_pieces(i))
                call stiffness%note(max(piece%slope_a, piece%slope_b), length)
                call forces%note(max(piece%force_a, piece%force_b), length)
                call ways%note(max(piece%displacement_a, piece%displacement_b), 0)
            end associate
        end do
        do i = 1, size(assembled%layers)
            call ways%note(max(abs(assembled%layers(i)%contact_a), abs(assembled%layers(i)%contact_b)), 0)
            if (allocated(assembled%layer_growth)) call ways%note(maxval(abs(assembled%layer_growth(:, i))), 0)
        end do
    end subroutine note_foundations

    !> The greatest size of every quantity of all foundations
    pure function greatest_values(model) result(most)
        !> With foundations
        type(model_type), intent(in) :: model
        !> Shape (quantities, number of foundations)
        real(wp) :: most(quantities, size(model%foundations))
        integer :: i

        do i = 1, size(model%foundations)
            associate (f => model%foundations(i))
                most(:, i) = max([maxval(moduli_of(f)), abs(f%gap), abs(f%parameter)], &
                                 [0.0_wp, abs(at_right(f%gap, f%gap_to)), abs(at_right(f%parameter, f%parameter_to))])
            end associate
        end do
        do i = 1, size(model%ground)
            associate (point => model%ground(i))
                most(point%quantity, point%foundation) = max(most(point%quantity, point%foundation), abs(point%value))
            end associate
        end do
    end function greatest_values

    !> Layers and laws from the user's units to the engine's
    subroutine scale_foundations(assembled, units, error)
        type(assembled_type), intent(inout) :: assembled
        type(units_type), intent(in) :: units
        !> Numbers out of range
        type(error_type), allocatable, intent(out) :: error
        logical, allocatable :: lost(:)
        real(wp) :: slopes(2), given(parameters_of_law, 2), scaled(parameters_of_law, 2), size_of_contact
        real(wp) :: most(quantities, size(assembled%model%foundations))
        integer :: i, m, per_length, powers(parameters_of_law)

        if (.not. allocated(assembled%layers)) return
        m = size(assembled%model%foundations)
        per_length = units%length - stiffness_unit(units)
        most(:, :) = greatest_values(assembled%model)
        do i = 1, m
            associate (k => most(gapbeam_table_of_k, i))
                if (.not. k > 0.0_wp .or. .not. is_lost(scale(k, per_length))) cycle
                call refuse_range(error, trim(named(of_foundations, i, m))//": k = "//trim(shown(k))// &
                                  " is too far from the stiffness of the beam", "bring them nearer together")
            end associate
            return
        end do
        allocate (lost(size(assembled%law_pieces)))
        do i = 1, size(assembled%law_pieces)
            associate (piece => assembled%law_pieces(i))
                slopes = [piece%slope_a, piece%slope_b]
                piece%displacement_a = scale(piece%displacement_a, -units%deflection)
                piece%displacement_b = scale(piece%displacement_b, -units%deflection)
                piece%way_a = scale(piece%way_a, -units%deflection)
                piece%way_b = scale(piece%way_b, -units%deflection)
                piece%force_a = scale(piece%force_a, units%length - units%force)
                piece%force_b = scale(piece%force_b, units%length - units%force)
                piece%slope_a = scale(slopes(1), per_length)
                piece%slope_b = scale(slopes(2), per_length)
                lost(i) = max(piece%displacement_a, piece%displacement_b, piece%force_a, piece%force_b) > huge(1.0_wp) &
                    .or. any(abs(slopes) > 0.0_wp .and. is_lost(abs([piece%slope_a, piece%slope_b])))
            end associate
        end do
        do i = 1, size(assembled%layers)
            associate (layer => assembled%layers(i))
                layer%modulus_a = scale(layer%modulus_a, per_length)
                layer%modulus_b = scale(layer%modulus_b, per_length)
                layer%contact_a = scale(layer%contact_a, -units%deflection)
                layer%contact_b = scale(layer%contact_b, -units%deflection)
                ! Stiffness, limit, slope; or force by displacement, its square, its cube
                powers = [per_length, units%length - units%force, per_length]
                if (layer%law == law_cubic) powers = per_length + [0, 1, 2]*units%deflection
                given(:, 1) = layer%parameter_a
                given(:, 2) = layer%parameter_b
                scaled(:, 1) = scale(layer%parameter_a, powers)
                scaled(:, 2) = scale(layer%parameter_b, powers)
                if (any(is_lost(abs(scaled)) .and. abs(given) > 0.0_wp) .or. any(lost(layer%law_first:layer%law_last))) then
                    call refuse_range(error, "the law of "//trim(named(of_foundations, layer%foundation, m))// &
                                      " is too far from the other numbers", "bring them nearer together")
                    return
                end if
                layer%parameter_a(:) = scaled(:, 1)
                layer%parameter_b(:) = scaled(:, 2)
                size_of_contact = max(abs(layer%contact_a), abs(layer%contact_b))
                if (allocated(assembled%layer_growth)) then
                    assembled%layer_growth(:, i) = scale(assembled%layer_growth(:, i), -units%deflection)
                    size_of_contact = max(size_of_contact, maxval(abs(assembled%layer_growth(:, i))))
                end if
                if (size_of_contact <= huge(1.0_wp)) cycle
                call refuse_range(error, trim(named(of_foundations, layer%foundation, m))//" acts at deflections too far from "// &
                                  "those that the loads make", "give smaller gaps and movements")
            end associate
            return
        end do
    end subroutine scale_foundations

end module gapbeam_assemble_foundations
