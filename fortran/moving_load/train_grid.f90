!> Positions of a train at which states on the ground or on smooth laws are solved.
!>
!> Where an axle comes to an end of the beam, to a support, a hinge, a load, another section or an end of a foundation is known
!> beforehand. Between such positions the grid is finer than the length in which the beam bends (4 EI/k)**(1/4) and than its spans.
module gapbeam_train_grid
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_train_states
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input
    use gapbeam_words, only: whole
    use gapbeam_ordered, only: sort, sort_once
    use gapbeam_scene, only: gapbeam_by_x, gapbeam_normal, gapbeam_force, gapbeam_right_end, gapbeam_table_of_k, &
        gapbeam_table_of_parameter
    use gapbeam_laws, only: law_cubic
    use gapbeam_assembled_model, only: assembled_type, in_bending, point_x
    use gapbeam_check_rigid_ground, only: is_on_rigid_ground
    use gapbeam_piece_stiffness, only: stiffness_of
    use gapbeam_train, only: train_type
    use gapbeam_train_on_beam, only: end_of_beam, distance_at_end
    use gapbeam_ground, only: ground_type
    use gapbeam_filled_ground, only: any_falls
    use gapbeam_uniqueness, only: is_unique
    use gapbeam_loaded_ground, only: ground_of
    implicit none
    private
    public :: find_borders, find_parts, places_of_jumps, ends_of_ground

    !> States in a length in which the beam bends, and in a mean span; parts between two borders at least
    integer, parameter :: per_length = 16, least_parts = 4

contains

    !> Positions between which states change smoothly as long as the same acts, the first and the last one included
    pure subroutine find_borders(assembled, train, from, to, borders)
        type(assembled_type), intent(in) :: assembled
        type(train_type), intent(in) :: train
        !> Positions, from < to
        real(wp), intent(in) :: from, to
        real(wp), allocatable, intent(out) :: borders(:)
        real(wp), allocatable :: ends(:), places(:), met(:)
        logical, allocatable :: apart(:)
        integer :: i

        allocate (ends, source=[train%offset, train%uniform%from, train%uniform%to])
        places = places_of_kinks(assembled)
        met = [from, to]
        do i = 1, size(ends)
            met = [met, pack(places - ends(i), places - ends(i) > from .and. places - ends(i) < to)]
        end do
        call sort(met)
        allocate (apart(size(met)))
        apart(1) = .true.
        apart(2:) = met(2:) - met(:size(met) - 1) > 4*distance_at_end(assembled, train)
        borders = pack(met, apart)
        if (size(borders) == 1) borders = [from, to]
        borders(size(borders)) = to
    end subroutine find_borders

    !> Into how many parts every way from one border to the next is cut
    subroutine find_parts(assembled, borders, deflection, parts, error)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: borders(:)
        !> How far the beam goes down about, for ground that gets stiffer by that
        real(wp), intent(in) :: deflection
        integer, allocatable, intent(out) :: parts(:)
        !> There are too many, or no memory
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: step, count
        integer :: n, stat

        if (is_on_rigid_ground(assembled)) then
            call fatal_error(error, gapbeam_bad_input, "goes over rigid ground, which is not available in this version; give "// &
                             "the ground a stiffness")
            return
        end if
        if (assembled%model%stretching) then
            call fatal_error(error, gapbeam_bad_input, "goes over a beam that its deflections stretch, which is not available "// &
                             "in this version; give its axles as forces at places")
            return
        end if
        if (allocated(assembled%layers)) then
            if (depends_on_the_way(ground_of(assembled, 1.0_wp))) then
                call fatal_error(error, gapbeam_bad_input, "goes over ground whose force falls, where states depend on the "// &
                                 "way to them, which is not available in this version; give its axles as forces at places")
                return
            end if
        end if
        n = size(borders) - 1
        allocate (parts(n), stat=stat)
        if (failed(stat, error)) return
        step = grid_step(assembled, deflection)
        count = sum(max(real(least_parts, wp), aint((borders(2:) - borders(:n))/step) + 1))
        if (count > most_train_states) then
            call fatal_error(error, gapbeam_bad_input, "would take states at "//trim(whole(nint(min(count, 1e9_wp))))// &
                             " positions, which is too many; give from and to, or a train with fewer axles")
            return
        end if
        parts(:) = max(least_parts, ceiling((borders(2:) - borders(:n))/step))
    end subroutine find_parts

    !> Does ground fall so that there may be several states
    function depends_on_the_way(ground) result(it_does)
        type(ground_type), intent(in) :: ground
        logical :: it_does

        it_does = any_falls(ground)
        if (it_does) it_does = .not. is_unique(ground)
    end function depends_on_the_way

    !> Distance of the positions
    pure function grid_step(assembled, deflection) result(step)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: deflection
        real(wp) :: step
        real(wp), allocatable :: at(:)
        real(wp) :: modulus, stiffness, bends
        integer :: j

        associate (supports => assembled%model%supports)
            allocate (at(size(supports)), source=[(place_of(assembled, supports(j)%x, supports(j)%node), j=1, size(supports))])
        end associate
        call sort(at)
        step = end_of_beam(assembled)/max(1, count(at(2:) > at(:size(at) - 1)))
        modulus = stiffest_ground(assembled, deflection)
        stiffness = minval([(stiffness_of(assembled, j, in_bending), j=1, size(assembled%pieces))])
        bends = end_of_beam(assembled)
        if (modulus > 0.0_wp .and. stiffness <= huge(stiffness)) bends = (4*stiffness/modulus)**0.25_wp
        step = min(step, bends)/per_length
    end function grid_step

    !> Greatest modulus of the ground anywhere, at a deflection
    pure function stiffest_ground(assembled, deflection) result(modulus)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: deflection
        real(wp) :: modulus
        real(wp), allocatable :: most(:, :)
        integer :: i, row
        logical :: first

        associate (model => assembled%model)
            allocate (most(0:3, size(model%foundations)))
            do i = 1, size(model%foundations)
                associate (f => model%foundations(i))
                    most(0, i) = max(0.0_wp, f%k, f%k_to)
                    most(1:, i) = max(0.0_wp, f%parameter, f%parameter_to)
                end associate
            end do
            do i = 1, size(model%ground)
                row = -1
                if (model%ground(i)%quantity == gapbeam_table_of_k) row = 0
                if (model%ground(i)%quantity >= gapbeam_table_of_parameter) then
                    row = model%ground(i)%quantity - gapbeam_table_of_parameter + 1
                end if
                if (row < 0) cycle
                associate (value => most(row, model%ground(i)%foundation))
                    value = max(value, model%ground(i)%value)
                end associate
            end do
            modulus = 0.0_wp
            do i = 1, size(model%foundations)
                modulus = max(modulus, most(0, i), most(1, i))
                if (model%foundations(i)%law == law_cubic) modulus = max(modulus, most(1, i) + 3*most(3, i)*deflection**2)
            end do
            do i = 1, size(model%ground_law)
                associate (point => model%ground_law(i), before => model%ground_law(max(i - 1, 1)))
                    first = i == 1 .or. point%foundation /= before%foundation .or. abs(point%x - before%x) > 0.0_wp
                    if (first .and. point%displacement > 0.0_wp) then
                        modulus = max(modulus, point%force/point%displacement)
                    else if (point%displacement > before%displacement) then
                        modulus = max(modulus, (point%force - before%force)/(point%displacement - before%displacement))
                    end if
                end associate
            end do
        end associate
    end function stiffest_ground

    !> Places at which the shear jumps without the train: of supports across the beam and of forces
    pure function places_of_jumps(assembled) result(places)
        type(assembled_type), intent(in) :: assembled
        real(wp), allocatable :: places(:)
        integer :: i

        associate (s => assembled%model%supports, l => assembled%model%loads)
            places = [pack([(place_of(assembled, s(i)%x, s(i)%node), i=1, size(s))], s%direction == gapbeam_normal), &
                      pack([(place_of(assembled, l(i)%x, l(i)%node), i=1, size(l))], l%kind == gapbeam_force)]
        end associate
        call sort_once(places)
    end function places_of_jumps

    !> Ends of the beam and of foundations: there zones begin and end
    pure function ends_of_ground(assembled) result(places)
        type(assembled_type), intent(in) :: assembled
        real(wp), allocatable :: places(:)

        associate (f => assembled%model%foundations, end => end_of_beam(assembled))
            places = [0.0_wp, end, f%from, merge(end, f%to, f%to <= gapbeam_right_end)]
        end associate
        call sort_once(places)
    end function ends_of_ground

    !> Places at which an axle makes a difference when it passes
    pure function places_of_kinks(assembled) result(places)
        type(assembled_type), intent(in) :: assembled
        real(wp), allocatable :: places(:)
        integer :: i

        associate (model => assembled%model, end => end_of_beam(assembled), from => assembled%load_from, to => assembled%load_to)
            places = [assembled%ends, [(place_of(assembled, model%supports(i)%x, model%supports(i)%node), &
                                        i=1, size(model%supports))], &
                      [(point_x(assembled, from(i)), i=1, size(from))], [(point_x(assembled, to(i)), i=1, size(to))], &
                      model%hinges, ends_of_ground(assembled), model%sections%from, &
                      merge(end, model%sections%to, model%sections%to <= gapbeam_right_end), &
                      pack(model%ground%x, model%ground%x > 0.0_wp .and. model%ground%x < end), &
                      pack(model%ground_law%x, model%ground_law%x > 0.0_wp .and. model%ground_law%x < end)]
        end associate
        call sort_once(places)
    end function places_of_kinks

    !> A place by x or node
    pure function place_of(assembled, x, node) result(place)
        type(assembled_type), intent(in) :: assembled
        real(wp), intent(in) :: x
        integer, intent(in) :: node
        real(wp) :: place

        place = x
        if (node /= gapbeam_by_x) place = assembled%ends(node)
    end function place_of

end module gapbeam_train_grid
