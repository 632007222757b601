!> Choice of the units in which a model is solved, and its conversion; what does not fit into double precision is refused by name.
module gapbeam_assemble_units
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_link, only: piece_load_type
    use gapbeam_range, only: is_lost
    use gapbeam_units, only: units_type, exponents_type, rotation_unit, moment_unit, turning_unit, units_with_loads, middle, &
        largest, no_exponent, ordinary_exponent
    use gapbeam_assembled_model, only: assembled_type, turns, way_unit, push_unit, point_x, from_to, piece_length, in_bending, &
        in_shear
    use gapbeam_piece_stiffness, only: stiffness_of, stiffness_along
    use gapbeam_axial_force, only: assign_axial_force
    use gapbeam_assemble_supports, only: contact_level
    use gapbeam_assemble_foundations, only: note_foundations, scale_foundations, greatest_values
    use gapbeam_words, only: shown
    use gapbeam_assemble_hinges, only: assemble_hinges
    use gapbeam_slight_supports, only: leave_out_slight
    use gapbeam_input_error, only: refuse_range, named, of_supports, of_foundations
    use gapbeam_scene, only: gapbeam_table_of_k
    implicit none
    private
    public :: change_units, refuse_link, name_farthest, load_in_units, support_in_units

    character(len=*), parameter :: smaller_loads = "give smaller ones", &
        too_great_loads = " are too great together, or beside the levels at which supports act"

contains

    !> Choose the engine's units, and take all of a model in the user's units to them
    subroutine change_units(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        !> Numbers out of range
        type(error_type), allocatable, intent(out) :: error

        call change_laws(assembled, 1)
        call choose_units(assembled)
        call change_laws(assembled, -1)
        call cut_pieces(assembled, error)
        if (.not. allocated(error)) call assign_axial_force(assembled, error)
        if (.not. allocated(error)) call scale_supports(assembled, error)
        if (.not. allocated(error)) call assemble_hinges(assembled, error)
        if (.not. allocated(error)) call scale_foundations(assembled, assembled%units, error)
        if (.not. allocated(error)) call scale_loads(assembled, error)
        if (.not. allocated(error)) call leave_out_slight(assembled)
    end subroutine change_units

    !> Laws in other units. Where loads are assembled anew they come back to the user's first: unlike all else they are kept in the
    !> engine's units only
    pure subroutine change_laws(assembled, way)
        type(assembled_type), intent(inout) :: assembled
        !> -1 from the user's units to the engine's, 1 back
        integer, intent(in) :: way
        integer :: k

        do k = 1, size(assembled%normal)
            if (.not. assembled%with_law(assembled%normal(k))) cycle
            associate (s => assembled%beam%supports(k), displacement => way_unit(assembled, assembled%normal(k)), &
                       force => push_unit(assembled, assembled%normal(k)))
                s%stiffness = scale(s%stiffness, way*(force - displacement))
                s%before = scale(s%before, way*(force - displacement))
                s%contact = scale(s%contact, way*displacement)
                s%force = scale(s%force, way*force)
            end associate
        end do
    end subroutine change_laws

    !> Refuse a link that lost digits, or whose loads are no numbers
    subroutine refuse_link(assembled, lost, error)
        type(assembled_type), intent(in) :: assembled
        !> As first_lost_link gives it, not 0
        integer, intent(in) :: lost
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error

        if (lost > 0) call name_farthest(assembled, error)
        if (lost < 0) call refuse_range(error, "the loads "//trim(from_to(assembled, assembled%node_point(-lost - 1), &
                                                                          assembled%node_point(-lost)))//too_great_loads, &
                                        smaller_loads)
    end subroutine refuse_link

    !> The engine's units: 1 but for models far from it. In them the lengths of the pieces lie about 1, and so does EI; loads and
    !> contact levels likewise, as the deflections that they make. Products such as stiffness * flexibility * length**2 might
    !> otherwise leave the range of doubles
    pure subroutine choose_units(assembled)
        type(assembled_type), intent(inout) :: assembled
        type(exponents_type) :: lengths, stiff(4), forces, ways
        real(wp) :: most(5)
        integer :: length, arm, j, k, stiffness

        do j = 1, size(assembled%pieces)
            call lengths%note(piece_length(assembled, j), 0)
        end do
        length = middle(lengths)
        associate (beam => assembled%beam, model => assembled%model)
            do j = 1, size(assembled%pieces)
                call stiff(1)%note(stiffness_of(assembled, j, in_bending), -3*length)
                call stiff(2)%note(stiffness_of(assembled, j, in_shear), -length)
            end do
            do k = 1, size(assembled%normal)
                associate (s => model%supports(assembled%normal(k)), made => beam%supports(k))
                    arm = merge(length, 0, turns(s))
                    if (assembled%with_law(assembled%normal(k))) then
                        call stiff(merge(4, 3, turns(s)))%note(abs(made%stiffness), -2*arm)
                        call ways%note(abs(made%contact), arm)
                        call forces%note(abs(made%force), -arm)
                    else
                        call stiff(merge(4, 3, turns(s)))%note(s%stiffness, -2*arm)
                        call ways%note(abs(contact_level(s)), arm)
                        if (allocated(assembled%growth)) call ways%note(abs(assembled%growth(assembled%normal(k))), arm)
                    end if
                end associate
            end do
            do j = 0, size(beam%links)
                call stiff(4)%note(assembled%turning(j), -2*length)
            end do
            call forces%note(maxval(abs(beam%force)), 0)
            call forces%note(maxval(abs(beam%couple)), -length)
        end associate
        call note_foundations(assembled, length, stiff(3), forces, ways)
        ! Of loads only the largest counts
        most(:) = 0.0_wp
        do j = 1, size(assembled%pieces)
            associate (a => assembled%dead(j), b => assembled%live(j))
                most(1) = max(most(1), abs(a%qa), abs(a%qb), abs(b%qa), abs(b%qb))
                most(2) = max(most(2), abs(a%force), abs(b%force))
                most(3) = max(most(3), maxval(abs([a%couple, b%couple, a%couple_a, b%couple_a, a%couple_b, b%couple_b])))
                most(4) = max(most(4), abs(a%kappa), abs(b%kappa), abs(a%rise), abs(b%rise))
                most(5) = max(most(5), abs(a%kink_a), abs(b%kink_a), abs(a%kink_b), abs(b%kink_b))
            end associate
        end do
        call forces%note(most(1), length)
        call forces%note(most(2), 0)
        call forces%note(most(3), -length)
        call ways%note(most(4), 2*length)
        call ways%note(most(5), length)
        stiffness = no_exponent
        do k = size(stiff), 1, -1
            if (middle(stiff(k)) /= no_exponent) stiffness = middle(stiff(k))
        end do
        assembled%units = units_with_loads(length, stiffness, largest(forces), largest(ways))
    end subroutine choose_units

    !> Length and flexibilities of every piece in the engine's units
    subroutine cut_pieces(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: EI, GA, EI_to, GA_to
        integer :: j

        do j = 1, size(assembled%pieces)
            call stiffness_along(assembled, j, in_bending, EI, EI_to, assembled%pieces(j)%power)
            call stiffness_along(assembled, j, in_shear, GA, GA_to, assembled%pieces(j)%shear_power)
            associate (units => assembled%units, p => assembled%pieces(j))
                p%length = scale(piece_length(assembled, j), -units%length)
                p%flexibility = 1/scale(EI, -turning_unit(units) - units%length)
                p%shear_flexibility = 1/scale(GA, rotation_unit(units) - units%force)
                p%flexibility_to = 1/scale(EI_to, -turning_unit(units) - units%length)
                p%shear_flexibility_to = 1/scale(GA_to, rotation_unit(units) - units%force)
                if (is_lost(p%length)) then
                    call refuse_range(error, "the stretch "//trim(from_to(assembled, j - 1, j))//", "// &
                                      trim(shown(piece_length(assembled, j)))//" long, is too far from the other lengths of "// &
                                      "the beam", "bring them nearer together")
                else if (is_lost(p%flexibility) .and. EI <= huge(EI)) then
                    call refuse_stiffness("EI", EI)
                else if (is_lost(p%shear_flexibility) .and. GA <= huge(GA)) then
                    call refuse_stiffness("GA", GA)
                else if (is_lost(p%flexibility_to) .and. EI_to <= huge(EI)) then
                    call refuse_stiffness("EI", EI_to)
                else if (is_lost(p%shear_flexibility_to) .and. GA_to <= huge(GA)) then
                    call refuse_stiffness("GA", GA_to)
                end if
            end associate
            if (allocated(error)) return
        end do

    contains

        !> A stiffness is out of range
        subroutine refuse_stiffness(name, value)
            character(len=*), intent(in) :: name
            real(wp), intent(in) :: value

            call refuse_range(error, name//" = "//trim(shown(value))//" "//trim(from_to(assembled, j - 1, j))// &
                              " is too far from the other stiffnesses of the beam", "bring them nearer together")
        end subroutine refuse_stiffness

    end subroutine cut_pieces

    !> Supports and rotational restraints in the engine's units
    subroutine scale_supports(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: i, k, m
        logical :: lost_stiffness, lost_level

        m = size(assembled%model%supports)
        associate (beam => assembled%beam, units => assembled%units)
            beam%compliance(:) = 0.0_wp
            do i = 0, size(beam%links)
                if (.not. assembled%turning(i) > 0.0_wp) cycle
                beam%compliance(i) = 1/scale(assembled%turning(i), -turning_unit(units))
                if (.not. is_lost(beam%compliance(i)) .or. assembled%turning(i) > huge(1.0_wp)) cycle
                call refuse_range(error, "rotation = "//trim(shown(assembled%turning(i)))//" of the supports at x = "// &
                                  trim(shown(point_x(assembled, assembled%node_point(i))))// &
                                  " is too far from the stiffness of the beam", "clamp it, or leave it free")
                return
            end do
            do k = 1, size(beam%supports)
                associate (s => beam%supports(k), given => assembled%model%supports(assembled%normal(k)))
                    if (assembled%with_law(assembled%normal(k))) then
                        if (abs(s%contact) <= huge(1.0_wp) .and. abs(s%force) <= huge(1.0_wp)) cycle
                        call refuse_range(error, "the law of "//trim(named(of_supports, assembled%normal(k), m))//" is too far "// &
                                          "from the other numbers", "bring them nearer together")
                        return
                    end if
                    call support_in_units(given%stiffness, contact_level(given), way_unit(assembled, assembled%normal(k)), &
                                          push_unit(assembled, assembled%normal(k)), s%stiffness, s%contact, lost_stiffness, &
                                          lost_level)
                    if (lost_stiffness) then
                        call refuse_range(error, trim(named(of_supports, assembled%normal(k), m))//": stiffness = "// &
                                          trim(shown(given%stiffness))//" is too far from the stiffness of the beam", &
                                          "make it infinite (rigid) or 0")
                    else if (lost_level) then
                        call refuse_range(error, trim(named(of_supports, assembled%normal(k), m))//" acts at a deflection of "// &
                                          trim(shown(contact_level(given)))//", too far from the deflections that the loads "// &
                                          "make", "give a smaller one")
                    end if
                end associate
                if (allocated(error)) return
            end do
        end associate
    end subroutine scale_supports

    !> A support without a law in the engine's units
    pure subroutine support_in_units(stiffness, level, displacement, force, scaled_stiffness, scaled_level, lost_stiffness, &
                                     lost_level)
        !> In the user's units: stiffness, infinite of a rigid one, and deflection or rotation at which it begins to act
        real(wp), intent(in) :: stiffness, level
        !> Exponents of the units of its displacement and force
        integer, intent(in) :: displacement, force
        !> The same in the engine's
        real(wp), intent(out) :: scaled_stiffness, scaled_level
        !> Did they leave the range of doubles
        logical, intent(out) :: lost_stiffness, lost_level

        scaled_stiffness = scale(stiffness, displacement - force)
        scaled_level = scale(level, -displacement)
        lost_stiffness = is_lost(scaled_stiffness) .and. stiffness > 0.0_wp .and. stiffness <= huge(1.0_wp)
        lost_level = .not. abs(scaled_level) <= huge(1.0_wp)
    end subroutine support_in_units

    !> Loads in the engine's units
    subroutine scale_loads(assembled, error)
        type(assembled_type), intent(inout) :: assembled
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j

        associate (units => assembled%units, beam => assembled%beam)
            ! Mostly all of them are 1
            if (any([units%length, units%force, units%deflection] /= 0)) then
                call load_in_units(assembled%dead, units)
                call load_in_units(assembled%live, units)
                beam%force(:, :) = scale(beam%force, -units%force)
                beam%couple(:, :) = scale(beam%couple, -moment_unit(units))
            end if
            do j = 1, size(assembled%pieces)
                if (is_finite(assembled%dead(j)) .and. is_finite(assembled%live(j))) cycle
                call refuse_range(error, "the loads "//trim(from_to(assembled, j - 1, j))//too_great_loads, smaller_loads)
                return
            end do
            do i = 0, size(beam%links)
                if (all(abs(beam%force(:, i)) <= huge(1.0_wp)) .and. all(abs(beam%couple(:, i)) <= huge(1.0_wp))) cycle
                call refuse_range(error, "the loads at x = "//trim(shown(point_x(assembled, assembled%node_point(i))))// &
                                  too_great_loads, smaller_loads)
                return
            end do
        end associate
    end subroutine scale_loads

    !> Say which of the lengths, stiffnesses and levels is farthest from the others, where solving left the range of double
    !> precision
    subroutine name_farthest(assembled, error)
        type(assembled_type), intent(in) :: assembled
        !> Becomes allocated
        type(error_type), allocatable, intent(out) :: error
        integer :: farthest, kind, entry, k

        farthest = ordinary_exponent
        kind = 0
        associate (pieces => assembled%pieces, beam => assembled%beam)
            call meet(pieces%length, 1, [(k, k=1, size(pieces))])
            call meet(pieces%flexibility, 2, [(k, k=1, size(pieces))])
            call meet(pieces%shear_flexibility, 3, [(k, k=1, size(pieces))])
            call meet(beam%compliance, 4, [(k, k=0, size(beam%links))])
            call meet(beam%supports%stiffness, 5, assembled%normal)
            call meet(abs(beam%supports%contact), 6, assembled%normal)
        end associate
        if (allocated(assembled%layers)) then
            associate (layers => assembled%layers)
                call meet(max(layers%modulus_a, layers%modulus_b), 7, layers%foundation)
            end associate
        end if
        associate (supports => assembled%model%supports)
            select case (kind)
            case (1)
                call say("the length of the stretch "//trim(from_to(assembled, entry - 1, entry)))
            case (2)
                call say("EI = "//trim(shown(stiffness_of(assembled, entry, in_bending)))//" "//from_to(assembled, entry - 1, &
                                                                                                        entry))
            case (3)
                call say("GA = "//trim(shown(stiffness_of(assembled, entry, in_shear)))//" "//from_to(assembled, entry - 1, entry))
            case (4)
                call say("rotation = "//trim(shown(assembled%turning(entry)))//" of the supports at x = "// &
                         shown(point_x(assembled, assembled%node_point(entry))))
            case (5)
                call say(trim(named(of_supports, entry, size(supports)))//": stiffness = "//shown(supports(entry)%stiffness))
            case (6)
                call say("the deflection of "//trim(shown(contact_level(supports(entry))))//" at which "// &
                         trim(named(of_supports, entry, size(supports)))//" acts")
            case (7)
                associate (foundations => assembled%model%foundations, most => greatest_values(assembled%model))
                    call say(trim(named(of_foundations, entry, size(foundations)))//": k = "// &
                             shown(most(gapbeam_table_of_k, entry)))
                end associate
            case default
                call refuse_range(error, "though no length, stiffness or level is far from the rest", &
                                  "give smaller loads and load factors")
            end select
        end associate

    contains

        !> Keep what is farthest from 1 in the engine's units
        subroutine meet(values, what, numbers)
            real(wp), intent(in) :: values(:)
            integer, intent(in) :: what, numbers(:)
            integer :: i

            do i = 1, size(values)
                if (.not. (values(i) > 0.0_wp .and. values(i) <= huge(1.0_wp))) cycle
                if (abs(exponent(values(i))) <= farthest) cycle
                farthest = abs(exponent(values(i)))
                kind = what
                entry = numbers(i)
            end do
        end subroutine meet

        !> Name it
        subroutine say(what)
            character(len=*), intent(in) :: what

            call refuse_range(error, trim(what)//" is too far from the rest", "bring them nearer together")
        end subroutine say

    end subroutine name_farthest

    !> Are all numbers of a load finite
    elemental function is_finite(load) result(finite)
        type(piece_load_type), intent(in) :: load
        logical :: finite

        finite = abs(load%qa) <= huge(1.0_wp) .and. abs(load%qb) <= huge(1.0_wp) .and. abs(load%kappa) <= huge(1.0_wp) &
            .and. abs(load%force) <= huge(1.0_wp) .and. abs(load%couple) <= huge(1.0_wp) &
            .and. abs(load%kink_a) <= huge(1.0_wp) .and. abs(load%kink_b) <= huge(1.0_wp) &
            .and. max(abs(load%couple_a), abs(load%couple_b), abs(load%rise)) <= huge(1.0_wp)
    end function is_finite

    !> The load of a piece in other units
    elemental subroutine load_in_units(load, units)
        type(piece_load_type), intent(inout) :: load
        type(units_type), intent(in) :: units

        load%qa = scale(load%qa, units%length - units%force)
        load%qb = scale(load%qb, units%length - units%force)
        load%kappa = scale(load%kappa, units%length - rotation_unit(units))
        load%rise = scale(load%rise, units%length - rotation_unit(units))
        load%kink_a = scale(load%kink_a, -rotation_unit(units))
        load%kink_b = scale(load%kink_b, -rotation_unit(units))
        load%couple_a = scale(load%couple_a, -moment_unit(units))
        load%couple_b = scale(load%couple_b, -moment_unit(units))
        load%force = scale(load%force, -units%force)
        load%couple = scale(load%couple, -moment_unit(units))
    end subroutine load_in_units

end module gapbeam_assemble_units
