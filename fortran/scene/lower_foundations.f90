!> Foundations as layers of ground under the pieces of the beam
module gapbeam_lower_foundations
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_layers, only: layer_type, parameters_of_law, law_cubic
    use gapbeam_range, only: is_lost
    use gapbeam_scene, only: foundation_type, gapbeam_both, gapbeam_below, gapbeam_above, gapbeam_unchanged, &
        gapbeam_law_by_points
    use gapbeam_units, only: units_type, exponents_type, stiffness_unit
    use gapbeam_lowered, only: lowered_type
    use gapbeam_check_foundations, only: find_runs, at_right
    use gapbeam_words, only: shown
    use gapbeam_refusal, only: refuse_range, named, of_foundations
    implicit none
    private
    public :: lower_foundations, note_foundations, scale_foundations, greatest_modulus

    !> Where something is: the span and the distance from its left end
    type :: place_type
        integer :: span
        real(wp) :: offset
    end type place_type

contains

    !> Layers and laws in the user's units; nothing without foundations
    subroutine lower_foundations(lowered, error)
        !> Points in
        type(lowered_type), intent(inout) :: lowered
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer, allocatable :: first(:), last(:), law_first(:), law_last(:), next(:)
        real(wp), allocatable :: at_point(:, :)
        integer(int64) :: total
        integer :: i, j, m, n, stat, pieces

        if (.not. allocated(lowered%model%foundations)) return
        m = size(lowered%model%foundations)
        if (m == 0) return
        pieces = size(lowered%pieces)
        if (.not. allocated(lowered%layers)) then
            allocate (lowered%layer_first(pieces + 1), lowered%law_pieces(size(lowered%model%ground_law)), stat=stat)
            if (stat /= 0) then
                call no_memory(error)
                return
            end if
        end if
        allocate (first(m), last(m), law_first(m), law_last(m), next(pieces), at_point(2 + parameters_of_law, 0:pieces), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        associate (model => lowered%model, layers => lowered%layers, from => lowered%foundation_from, to => lowered%foundation_to)
            call find_runs(model%ground%foundation, first, last)
            call find_runs(model%ground_law%foundation, law_first, law_last)
            call make_laws(lowered)
            next(:) = 0
            total = 0
            do i = 1, m
                n = layers_of(model%foundations(i), has_law(i), last(i) >= first(i))
                total = total + int(n, int64)*(to(i) - from(i))
                next(from(i) + 1:to(i)) = next(from(i) + 1:to(i)) + n
            end do
            if (.not. allocated(lowered%layers)) then
                stat = merge(1, 0, total >= huge(n))
                if (stat == 0) allocate (lowered%layers(total), stat=stat)
                if (stat /= 0) then
                    call no_memory(error)
                    return
                end if
            end if
            lowered%layer_first(1) = 1
            do j = 1, pieces
                lowered%layer_first(j + 1) = lowered%layer_first(j) + next(j)
                next(j) = lowered%layer_first(j)
            end do
            do i = 1, m
                call find_values(lowered, i, first(i), last(i), at_point)
                do j = from(i) + 1, to(i)
                    n = layers_of(model%foundations(i), has_law(i), last(i) >= first(i))
                    lowered%layers(next(j)) = layer_at(i, j, merge(gapbeam_below, model%foundations(i)%side, n == 2))
                    if (n == 2) lowered%layers(next(j) + 1) = layer_at(i, j, gapbeam_above)
                    next(j) = next(j) + n
                end do
            end do
        end associate

    contains

        !> Has a foundation a law
        pure function has_law(foundation)
            integer, intent(in) :: foundation
            logical :: has_law

            has_law = law_last(foundation) >= law_first(foundation) &
                .or. lowered%model%foundations(foundation)%law /= gapbeam_law_by_points
        end function has_law

        !> The layer of a foundation under a piece
        pure function layer_at(foundation, piece, side) result(layer)
            integer, intent(in) :: foundation, piece, side
            type(layer_type) :: layer

            layer = layer_type(foundation=foundation, side=side, modulus_a=at_point(1, piece - 1), modulus_b=at_point(1, piece), &
                               contact_a=side*at_point(2, piece - 1), contact_b=side*at_point(2, piece), &
                               law_first=law_first(foundation), law_last=law_last(foundation), &
                               law=lowered%model%foundations(foundation)%law, parameter_a=at_point(3:, piece - 1), &
                               parameter_b=at_point(3:, piece))
        end function layer_at

    end subroutine lower_foundations

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

    !> Pieces of all laws, one for every point: the one that ends there, the last one going on
    pure subroutine make_laws(lowered)
        type(lowered_type), intent(inout) :: lowered
        integer :: i

        associate (points => lowered%model%ground_law, pieces => lowered%law_pieces)
            do i = 1, size(points)
                pieces(i)%displacement = 0.0_wp
                pieces(i)%force = 0.0_wp
                if (i > 1) then
                    if (points(i)%foundation == points(i - 1)%foundation) then
                        pieces(i)%displacement = points(i - 1)%displacement
                        pieces(i)%force = points(i - 1)%force
                    end if
                end if
                pieces(i)%slope = (points(i)%force - pieces(i)%force)/(points(i)%displacement - pieces(i)%displacement)
            end do
        end associate
    end subroutine make_laws

    !> Modulus, gap and parameters of its law of a foundation at its points
    pure subroutine find_values(lowered, foundation, first, last, at_point)
        type(lowered_type), intent(in) :: lowered
        integer, intent(in) :: foundation
        !> First and last point of its profile, the last before the first: none
        integer, intent(in) :: first, last
        !> Modulus, gap, parameters, shape (2 + parameters_of_law, 0:npiece); set from its first to its last point
        real(wp), intent(inout) :: at_point(:, 0:)
        real(wp) :: whole, share
        integer :: left, right, p

        left = lowered%foundation_from(foundation)
        right = lowered%foundation_to(foundation)
        whole = distance(lowered, place_of(lowered, left), place_of(lowered, right))
        associate (f => lowered%model%foundations(foundation))
            do p = left, right
                share = distance(lowered, place_of(lowered, left), place_of(lowered, p))/whole
                at_point(1, p) = between(f%k, at_right(f%k, f%k_to), share)
                at_point(2, p) = between(f%gap, at_right(f%gap, f%gap_to), share)
                at_point(3:, p) = between(f%parameter, at_right(f%parameter, f%parameter_to), share)
            end do
        end associate
        if (first <= last) call follow_profile(lowered, left, right, first, last, at_point(2, :))
    end subroutine find_values

    !> The gap of a profile at points: straight between its points, beyond its ends the last value
    pure subroutine follow_profile(lowered, left, right, first, last, gap)
        type(lowered_type), intent(in) :: lowered
        !> The points of the beam, and those of the profile
        integer, intent(in) :: left, right, first, last
        !> Shape (0:npiece)
        real(wp), intent(inout) :: gap(0:)
        type(place_type) :: here, before, after
        integer :: i, p

        associate (points => lowered%model%ground)
            i = first
            before = place_in_profile(lowered, first)
            after = before
            do p = left, right
                here = place_of(lowered, p)
                ! The first point of the profile that is right of the beam's
                do while (i <= last)
                    if (distance(lowered, after, here) < 0.0_wp) exit
                    before = after
                    i = i + 1
                    if (i <= last) after = place_in_profile(lowered, i)
                end do
                if (i == first) then
                    gap(p) = points(first)%gap
                else if (i > last) then
                    gap(p) = points(last)%gap
                else
                    gap(p) = between(points(i - 1)%gap, points(i)%gap, &
                                     distance(lowered, before, here)/distance(lowered, before, after))
                end if
            end do
        end associate
    end subroutine follow_profile

    !> Where a point of a profile is: on its foundation exactly at the beam's own point, which may differ by rounding
    pure function place_in_profile(lowered, number) result(place)
        type(lowered_type), intent(in) :: lowered
        integer, intent(in) :: number
        type(place_type) :: place

        if (lowered%ground_point(number) >= 0) then
            place = place_of(lowered, lowered%ground_point(number))
        else
            place = place_type(0, lowered%model%ground(number)%x)
        end if
    end function place_in_profile

    !> Where a point of the beam is
    pure function place_of(lowered, point) result(place)
        type(lowered_type), intent(in) :: lowered
        integer, intent(in) :: point
        type(place_type) :: place

        place = place_type(lowered%point_span(point), lowered%point_offset(point))
    end function place_of

    !> Distance from one place to another, positive to the right
    pure function distance(lowered, from, to) result(length)
        type(lowered_type), intent(in) :: lowered
        type(place_type), intent(in) :: from, to
        real(wp) :: length

        length = (lowered%ends(to%span) - lowered%ends(from%span)) + (to%offset - from%offset)
    end function distance

    !> A value at a share of the way from one to another
    elemental function between(a, b, share) result(value)
        real(wp), intent(in) :: a, b, share
        real(wp) :: value

        value = a
        if (abs(a - b) > 0.0_wp) value = a*(1 - share) + b*share
    end function between

    !> Meet the moduli and levels of all foundations
    pure subroutine note_foundations(lowered, length, stiffness, forces, ways)
        !> Layers in the user's units in
        type(lowered_type), intent(in) :: lowered
        !> The exponent of the unit of length
        integer, intent(in) :: length
        type(exponents_type), intent(inout) :: stiffness, forces, ways
        integer :: i

        if (.not. allocated(lowered%layers)) return
        do i = 1, size(lowered%model%foundations)
            call stiffness%note(greatest_modulus(lowered%model%foundations(i)), length)
            associate (f => lowered%model%foundations(i))
                if (f%law == gapbeam_law_by_points) cycle
                call stiffness%note(greatest_parameter(f, 1), length)
                if (f%law == law_cubic) cycle
                call forces%note(greatest_parameter(f, 2), length)
                call stiffness%note(greatest_parameter(f, 3), length)
            end associate
        end do
        do i = 1, size(lowered%law_pieces)
            associate (piece => lowered%law_pieces(i))
                call stiffness%note(piece%slope, length)
                call forces%note(piece%force, length)
                call ways%note(piece%displacement, 0)
            end associate
        end do
        do i = 1, size(lowered%layers)
            call ways%note(max(abs(lowered%layers(i)%contact_a), abs(lowered%layers(i)%contact_b)), 0)
        end do
    end subroutine note_foundations

    !> The greater of the two moduli of a foundation
    elemental function greatest_modulus(foundation) result(k)
        type(foundation_type), intent(in) :: foundation
        real(wp) :: k

        k = max(foundation%k, at_right(foundation%k, foundation%k_to))
    end function greatest_modulus

    !> The greatest of a parameter of a law
    pure function greatest_parameter(foundation, number) result(value)
        type(foundation_type), intent(in) :: foundation
        integer, intent(in) :: number
        real(wp) :: value

        associate (a => foundation%parameter(number), b => foundation%parameter_to(number))
            value = max(abs(a), abs(at_right(a, b)))
        end associate
    end function greatest_parameter

    !> Layers and laws from the user's units to the engine's
    subroutine scale_foundations(lowered, units, error)
        type(lowered_type), intent(inout) :: lowered
        type(units_type), intent(in) :: units
        !> Numbers out of range
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: slope, given(parameters_of_law, 2), scaled(parameters_of_law, 2)
        integer :: i, m, per_length, powers(parameters_of_law)

        if (.not. allocated(lowered%layers)) return
        m = size(lowered%model%foundations)
        per_length = units%length - stiffness_unit(units)
        do i = 1, m
            associate (k => greatest_modulus(lowered%model%foundations(i)))
                if (.not. k > 0.0_wp .or. .not. is_lost(scale(k, per_length))) cycle
                call refuse_range(error, trim(named(of_foundations, i, m))//": k = "//trim(shown(k))// &
                                  " is too far from the stiffness of the beam", "bring them nearer together")
            end associate
            return
        end do
        do i = 1, size(lowered%law_pieces)
            associate (piece => lowered%law_pieces(i))
                piece%displacement = scale(piece%displacement, -units%deflection)
                piece%force = scale(piece%force, units%length - units%force)
                slope = piece%slope
                piece%slope = scale(slope, per_length)
                if (max(piece%displacement, piece%force) <= huge(1.0_wp) &
                    .and. .not. (slope > 0.0_wp .and. is_lost(piece%slope))) cycle
                call refuse_range(error, "the law of "//trim(named(of_foundations, lowered%model%ground_law(i)%foundation, m))// &
                                  " is too far from the other numbers", "bring them nearer together")
            end associate
            return
        end do
        do i = 1, size(lowered%layers)
            associate (layer => lowered%layers(i))
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
                if (any(is_lost(abs(scaled)) .and. abs(given) > 0.0_wp)) then
                    call refuse_range(error, "the law of "//trim(named(of_foundations, layer%foundation, m))// &
                                      " is too far from the other numbers", "bring them nearer together")
                    return
                end if
                layer%parameter_a(:) = scaled(:, 1)
                layer%parameter_b(:) = scaled(:, 2)
                if (max(abs(layer%contact_a), abs(layer%contact_b)) <= huge(1.0_wp)) cycle
                call refuse_range(error, trim(named(of_foundations, layer%foundation, m))//" acts at deflections too far from "// &
                                  "those that the loads make", "give smaller gaps")
            end associate
            return
        end do
    end subroutine scale_foundations

end module gapbeam_lower_foundations
