!> The fields of a solved beam on the ground inside its stretches
module gapbeam_ground_fields
    use gapbeam_kinds, only: wp
    use gapbeam_tolerances, only: lost_digits
    use gapbeam_element, only: field_type
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type, decay_lengths
    use gapbeam_foundation_stretch, only: softest, without_slip, greatest_tension, tension_at
    use gapbeam_foundation_taylor, only: is_sloped, transverse_of
    use gapbeam_foundation_fields, only: shared_type, shared_of, fields_at, moment_at, sloped_start, sloped_fields_from
    use gapbeam_laws, only: law_cubic, parameters_of_law
    use gapbeam_layers, only: layer_type, law_piece_type, law_piece, is_curve, has_points
    use gapbeam_curved, only: curved_type, curved_fields
    use gapbeam_ground_laws, only: along, take_curves, breaks_on_line, line_of_breakpoint
    use gapbeam_ground_solution, only: ground_solution_type
    implicit none
    private
    public :: inside_type, prepare_inside, field_at_end, force_at_end, field_inside, moment_inside, force_inside, curved_stretch
    public :: deflection_size, find_sizes, largest_inside, breakpoint_terms, pressure_terms

    !> A stretch of a solution, ready to be asked for its fields
    type :: inside_type
        private
        type(stretch_type) :: stretch
        type(stretch_load_type) :: load
        !> Moments at its ends
        type(stretch_ends_type) :: ends
        !> Deflections at its ends, slope of the chord between
        real(wp) :: chord(2) = 0.0_wp, slope = 0.0_wp
        !> Fields at both ends where modulus or stiffness change along the stretch (sloped_start)
        logical :: sloped = .false.
        real(wp) :: start(4, 2) = 0.0_wp
        !> Else what fields inside have in common
        type(shared_type) :: shared
        !> What rotation and shear at its ends lack when they are made of load and moments, shape (2, 2)
        real(wp) :: off(2, 2) = 0.0_wp
        !> The same of the transverse force
        real(wp) :: off_force(2) = 0.0_wp
        !> Allocated if ground acts there by curves
        type(curved_type), allocatable :: curved
    end type inside_type

contains

    !> Make a stretch ready
    pure subroutine prepare_inside(layers, laws, length, solution, i, inside, roughly, without_forces)
        !> Layers of ground under the piece of the beam, the pieces of all laws, and the length of the piece of the beam
        type(layer_type), intent(in) :: layers(:)
        type(law_piece_type), intent(in) :: laws(:)
        real(wp), intent(in) :: length
        !> The solution, and the number of the stretch
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        !> Ready for field_inside
        type(inside_type), intent(out) :: inside
        !> Is it enough if rotations and shears are made of load and moments, which costs less; default: no
        logical, intent(in), optional :: roughly
        !> Is force_inside not asked; default: it may be
        logical, intent(in), optional :: without_forces
        logical :: forces

        inside%stretch = solution%stretches(i)
        call curved_stretch(layers, laws, length, solution, i, inside%curved)
        if (allocated(inside%curved)) return
        inside%load = solution%loads(i)
        associate (ends => solution%ends(i))
            ! Beside the chord
            inside%ends = stretch_ends_type(0.0_wp, 0.0_wp, ends%moment_a, ends%moment_b)
            inside%chord = [ends%w_a, ends%w_b]
        end associate
        inside%slope = solution%slope(i)
        inside%sloped = is_sloped(inside%stretch)
        if (inside%sloped) then
            inside%start(:, 1) = sloped_start(inside%stretch, inside%load, inside%ends, 1)
            inside%start(:, 2) = sloped_start(inside%stretch, inside%load, inside%ends, 2)
        else
            inside%shared = shared_of(inside%stretch)
        end if
        forces = .true.
        if (present(without_forces)) forces = .not. without_forces
        if (forces .and. abs(inside%stretch%tension) > 0.0_wp .and. .not. inside%sloped) then
            inside%off_force = solution%force(:, i) - [force_inside(inside, 0.0_wp), force_inside(inside, 1.0_wp)]
        end if
        if (present(roughly)) then
            if (roughly) return
        end if
        if (decay_lengths(inside%stretch) > 1.0_wp) return
        ! In a short stretch the shear is a small difference of moments by a small length, and where shear bends most the rotation
        ! one of slopes: their errors are those at the ends, where they are known
        inside%off(:, 1) = off_at(1)
        inside%off(:, 2) = off_at(2)

    contains

        !> What rotation and shear at an end of the stretch lack when they are made of load and moments
        pure function off_at(side) result(lacking)
            !> 1 left, 2 right
            integer, intent(in) :: side
            real(wp) :: lacking(2)
            type(field_type) :: field

            field = beside_chord(inside, real(side - 1, wp))
            lacking = [solution%rotation(side, i) - (solution%slope(i) + field%rotation), solution%shear(side, i) - field%shear]
        end function off_at

    end subroutine prepare_inside

    !> Fields at an end of a stretch, as they were solved
    pure function field_at_end(solution, i, side) result(field)
        type(ground_solution_type), intent(in) :: solution
        !> The stretch; 1 left, 2 right
        integer, intent(in) :: i, side
        type(field_type) :: field

        associate (ends => solution%ends(i))
            field = field_type(merge(ends%w_a, ends%w_b, side == 1), solution%rotation(side, i), &
                               merge(ends%moment_a, ends%moment_b, side == 1), solution%shear(side, i))
        end associate
    end function field_at_end

    !> Transverse force at an end of a stretch
    pure function force_at_end(solution, i, side) result(force)
        !> As for field_at_end
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i, side
        real(wp) :: force

        force = solution%force(side, i)
    end function force_at_end

    !> Fields between the ends of a stretch
    pure subroutine field_inside(inside, xi, field)
        type(inside_type), intent(in) :: inside
        !> The place, between 0 and 1
        real(wp), intent(in) :: xi
        type(field_type), intent(out) :: field

        if (allocated(inside%curved)) then
            call curved_fields(inside%curved, xi, field%deflection, field%rotation, field%moment, field%shear)
            return
        end if
        field = beside_chord(inside, xi)
        field%deflection = along(inside%chord(1), inside%chord(2), xi, 1.0_wp) + field%deflection
        field%rotation = inside%slope + field%rotation + along(inside%off(1, 1), inside%off(1, 2), xi, 1.0_wp)
        field%shear = field%shear + along(inside%off(2, 1), inside%off(2, 2), xi, 1.0_wp)
    end subroutine field_inside

    !> The moment alone, the same as that of field_inside
    pure function moment_inside(inside, xi) result(moment)
        !> As for field_inside
        type(inside_type), intent(in) :: inside
        real(wp), intent(in) :: xi
        real(wp) :: moment
        type(field_type) :: field

        if (allocated(inside%curved) .or. inside%sloped) then
            call field_inside(inside, xi, field)
            moment = field%moment
        else
            moment = moment_at(inside%stretch, inside%load, inside%ends, inside%shared, xi)
        end if
    end function moment_inside

    !> Transverse force between the ends of a stretch
    pure function force_inside(inside, xi) result(force)
        type(inside_type), intent(in) :: inside
        !> As for field_inside
        real(wp), intent(in) :: xi
        real(wp) :: force
        type(field_type) :: field

        if (allocated(inside%curved) .or. inside%sloped) then
            call field_inside(inside, xi, field)
            force = transverse_of(inside%stretch, xi, field%rotation, field%shear)
        else
            call fields_at(inside%stretch, inside%load, inside%ends, xi, field%deflection, field%rotation, field%moment, &
                           field%shear, force, inside%shared)
            force = force + (inside%stretch%tension*inside%slope + along(inside%off_force(1), inside%off_force(2), xi, 1.0_wp))
        end if
    end function force_inside

    !> Fields beside the chord between the ends
    pure function beside_chord(inside, xi) result(field)
        type(inside_type), intent(in) :: inside
        real(wp), intent(in) :: xi
        type(field_type) :: field

        if (inside%sloped) then
            call sloped_fields_from(inside%stretch, inside%load, inside%start, xi, field%deflection, field%rotation, &
                                    field%moment, field%shear)
        else
            call fields_at(inside%stretch, inside%load, inside%ends, xi, field%deflection, field%rotation, field%moment, &
                           field%shear, shared=inside%shared)
        end if
    end function beside_chord

    !> A stretch on which ground acts by curves
    pure subroutine curved_stretch(layers, laws, length, solution, i, curved)
        !> As for prepare_inside
        type(layer_type), intent(in) :: layers(:)
        type(law_piece_type), intent(in) :: laws(:)
        real(wp), intent(in) :: length
        type(ground_solution_type), intent(in) :: solution
        integer, intent(in) :: i
        !> Not allocated if the ground is linear there
        type(curved_type), allocatable, intent(out) :: curved

        associate (ends => solution%ends(i), s => solution%stretches(i))
            if (.not. any(is_curve(layers, solution%acts(:size(layers), i)))) return
            allocate (curved)
            call take_curves(layers, laws, solution%acts(:, i), solution%from(i), solution%to(i), length, curved%curves)
            curved%stretch = s
            curved%load = solution%loads(i)
            curved%left = [without_slip(s, 0.0_wp, ends%w_a, ends%moment_a), solution%rotation(1, i), ends%moment_a, &
                           solution%shear(1, i)]
            curved%right = [without_slip(s, 1.0_wp, ends%w_b, ends%moment_b), solution%rotation(2, i), ends%moment_b, &
                            solution%shear(2, i)]
        end associate
    end subroutine curved_stretch

    !> Size of what deflections inside a stretch are sums of, which times the rounding unit bounds their error (N. J. Higham,
    !> Accuracy and Stability of Numerical Algorithms, 2002, section 3.1)
    pure function deflection_size(solution, i) result(size_of)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        real(wp) :: size_of
        type(field_type) :: sizes, least

        call find_sizes(solution, i, sizes, least)
        size_of = sizes%deflection
    end function deflection_size

    !> The same of all fields, and sizes below which there is nothing but what quadruple precision leaves where terms cancel
    pure subroutine find_sizes(solution, i, sizes, least)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        type(field_type), intent(out) :: sizes, least
        real(wp) :: moment, bent, q, modulus, square, soft(2)

        soft(:) = softest(solution%stretches(i))
        associate (s => solution%stretches(i), ends => solution%ends(i), load => solution%loads(i), f => soft(1), g => soft(2))
            moment = max(abs(ends%moment_a), abs(ends%moment_b))
            q = max(abs(load%qa), abs(load%qb))
            modulus = max(abs(s%modulus_a), abs(s%modulus_b))
            ! What moment and load bend a simple beam by; on elastic ground what is farther away than 1/beta is not felt
            square = s%length**2/8
            if (s%modulus_a > 0.0_wp .and. f > 0.0_wp) square = min(square, 1/sqrt(s%modulus_a)/sqrt(f))
            sizes%deflection = max(abs(ends%w_a), abs(ends%w_b)) &
                + square*(f*(moment + square*q) + abs(load%kappa) + abs(load%rise)) + g*(moment + square*q)
            sizes%rotation = maxval(abs(solution%rotation(:, i)))
            sizes%moment = moment + square*(q + modulus*sizes%deflection)
            sizes%shear = maxval(abs(solution%shear(:, i))) + abs(greatest_tension(s))*(sizes%rotation + sizes%deflection/s%length)
            bent = sizes%moment
            if (f > 0.0_wp) then
                bent = bent + ((sizes%rotation + sizes%deflection/s%length)/s%length + abs(load%kappa) + abs(load%rise))/f
            end if
            least%deflection = lost_digits*s%length*sizes%rotation
            least%rotation = lost_digits*(sizes%deflection/s%length + g*sizes%shear)
            least%moment = lost_digits*bent
            least%shear = lost_digits*(bent/s%length + s%length*modulus*sizes%deflection)
        end associate
    end subroutine find_sizes

    !> Values that fields in a stretch do not pass, whose rounding is in what is told there: those at its ends, and what the load
    !> makes between them, by bending or, where it is pulled hard, as of a thread
    pure function largest_inside(solution, i) result(largest)
        type(ground_solution_type), intent(in) :: solution
        !> Stretch
        integer, intent(in) :: i
        type(field_type) :: largest, sizes, least
        real(wp) :: q, pull, soft(2)

        call find_sizes(solution, i, sizes, least)
        soft(:) = softest(solution%stretches(i))
        associate (s => solution%stretches(i), ends => solution%ends(i), load => solution%loads(i))
            largest = field_type(sizes%deflection, sizes%rotation, sizes%moment, maxval(abs(solution%shear(:, i))))
            pull = min(s%tension, tension_at(s, 1.0_wp))
            if (pull > 0.0_wp) then
                q = max(abs(load%qa), abs(load%qb))
                if (soft(1) > 0.0_wp) largest%moment = min(largest%moment, max(abs(ends%moment_a), abs(ends%moment_b)) &
                                                           + (q/pull + abs(load%kappa) + abs(load%rise))/soft(1))
                largest%deflection = min(largest%deflection, max(abs(ends%w_a), abs(ends%w_b)) &
                                         + (2*largest%moment + q*s%length**2/8)/pull)
            end if
            largest%rotation = largest%rotation + s%length/4*(soft(1)*largest%moment + abs(load%kappa) + abs(load%rise))
        end associate
    end function largest_inside

    !> How a line at which a law goes on to another piece is approached (distance_to_breakpoint): the change of the measure with the
    !> deflection, and the sizes of its terms
    pure subroutine breakpoint_terms(layer, laws, breakpoint, deflection, steepness, sizes)
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: laws(:)
        !> The piece that begins there
        integer, intent(in) :: breakpoint
        !> Size of the deflection
        real(wp), intent(in) :: deflection
        real(wp), intent(out) :: steepness, sizes

        steepness = 1.0_wp
        sizes = deflection + abs(layer%contact_a) + abs(layer%contact_b) &
            + max(abs(line_of_breakpoint(laws, layer, breakpoint, 0.0_wp, 1.0_wp) - layer%contact_a), &
                  abs(line_of_breakpoint(laws, layer, breakpoint, 1.0_wp, 1.0_wp) - layer%contact_b))
        if (breakpoint == 1 .or. breaks_on_line(layer)) return
        steepness = max(layer%parameter_a(1), layer%parameter_b(1))
        sizes = steepness*sizes + max(layer%parameter_a(2), layer%parameter_b(2))
    end subroutine breakpoint_terms

    !> Size of the terms of a layer's pressure
    pure function pressure_terms(layer, laws, acts, deflection) result(sizes)
        type(layer_type), intent(in) :: layer
        type(law_piece_type), intent(in) :: laws(:)
        !> On which piece of its law it acts, 0: none
        integer, intent(in) :: acts
        !> Size of the deflection
        real(wp), intent(in) :: deflection
        real(wp) :: sizes
        type(law_piece_type) :: piece
        real(wp) :: p(parameters_of_law), u

        sizes = 0.0_wp
        if (acts == 0) return
        u = deflection + abs(layer%contact_a) + abs(layer%contact_b)
        if (has_points(layer)) then
            piece = law_piece(layer, laws, acts)
            sizes = max(layer%modulus_a, layer%modulus_b, abs(piece%slope_a), abs(piece%slope_b)) &
                *(u + max(abs(piece%displacement_a), abs(piece%displacement_b))) + max(abs(piece%force_a), abs(piece%force_b))
            return
        end if
        p = max(abs(layer%parameter_a), abs(layer%parameter_b))
        if (layer%law == law_cubic) then
            sizes = u*(p(1) + u*(2*p(2) + u*3*p(3)))
        else
            sizes = u*max(p(1), p(3)) + p(2)
        end if
    end function pressure_terms

end module gapbeam_ground_fields
