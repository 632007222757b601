!> Models and loads from plain arrays, one column an entry, as Fortran 77 and Python hand them over
module gapbeam_arrays
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_scene, only: span_type, section_type, support_type, law_point_type, foundation_type, ground_point_type, &
        ground_law_point_type, load_type, model_type
    implicit none
    private
    public :: model_from_arrays, foundations_from_arrays, loads_from_arrays

contains

    !> A model from arrays, without foundations
    subroutine model_from_arrays(span, hinge, sect, isup, sup, ilaw, alaw, iload, aload, model, error)
        !> Length, EI, GA, EA, and axial force and mass if there are rows five and six
        real(wp), intent(in) :: span(:, :)
        !> Places, and couple per relative rotation if there is a second row
        real(wp), intent(in) :: hinge(:, :)
        !> From, to, EI, GA, EA
        real(wp), intent(in) :: sect(:, :)
        !> Side, direction, node, and unloading if there is a fourth row, law by name if there is a fifth; x, stiffness, gap,
        !> settlement, rotation, and the parameters of the law
        integer, intent(in) :: isup(:, :)
        real(wp), intent(in) :: sup(:, :)
        !> Points of laws: support, from 1; displacement, force
        integer, intent(in) :: ilaw(:)
        real(wp), intent(in) :: alaw(:, :)
        !> As for loads_from_arrays
        integer, intent(in) :: iload(:, :)
        real(wp), intent(in) :: aload(:, :)
        type(model_type), intent(out) :: model
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        allocate (model%spans(size(span, 2)), model%hinges(size(hinge, 2)), &
                  model%hinge_stiffness(size(hinge, 2)), model%sections(size(sect, 2)), &
                  model%supports(size(sup, 2)), model%law(size(ilaw)), model%foundations(0), model%ground(0), &
                  model%ground_law(0), stat=stat)
        if (failed(stat, error)) return
        do i = 1, size(model%spans)
            model%spans(i) = span_type(length=span(1, i), EI=span(2, i), GA=span(3, i), EA=span(4, i))
            if (size(span, 1) > 4) model%spans(i)%N = span(5, i)
            if (size(span, 1) > 5) model%spans(i)%mass = span(6, i)
        end do
        model%hinges(:) = hinge(1, :)
        model%hinge_stiffness(:) = 0.0_wp
        if (size(hinge, 1) > 1) model%hinge_stiffness(:) = hinge(2, :)
        do i = 1, size(model%sections)
            associate (s => model%sections(i))
                s = section_type(from=sect(1, i), to=sect(2, i), EI=sect(3, i), GA=sect(4, i), EA=sect(5, i))
                if (size(sect, 1) == 5) cycle
                s%EI_to = sect(6, i)
                s%GA_to = sect(7, i)
                s%EA_to = sect(8, i)
                s%EI_power = nint(sect(9, i))
                s%GA_power = nint(sect(10, i))
                s%EA_power = nint(sect(11, i))
                s%friction = sect(12, i)
                if (size(sect, 1) > 12) s%N = sect(13, i)
                if (size(sect, 1) == 13) cycle
                s%friction_to = sect(14, i)
                s%bedding = sect(15, i)
            end associate
        end do
        do i = 1, size(model%supports)
            associate (s => model%supports(i))
                s = support_type(side=isup(1, i), direction=isup(2, i), node=isup(3, i), x=sup(1, i), stiffness=sup(2, i), &
                                 gap=sup(3, i), settlement=sup(4, i), rotation=sup(5, i))
                if (size(isup, 1) > 3) s%unloading = isup(4, i)
                if (size(isup, 1) > 4) then
                    s%law = isup(5, i)
                    s%parameter = sup(6:8, i)
                end if
                if (size(sup, 1) > 8) s%friction = sup(9, i)
            end associate
        end do
        model%law(:) = [(law_point_type(ilaw(i), alaw(1, i), alaw(2, i)), i=1, size(model%law))]
        call loads_from_arrays(iload, aload, model%loads, error)
    end subroutine model_from_arrays

    !> The foundations of a model from arrays
    subroutine foundations_from_arrays(side, found, iprof, aprof, ilaw, alaw, model, error)
        !> Side; from, to, modulus and gap, each at the left and right end; with laws by parameters also law, its parameters at the
        !> left end and at the right end, and shear if there is a row more
        integer, intent(in) :: side(:)
        real(wp), intent(in) :: found(:, :)
        !> Points of tables: foundation, from 1; x, value, and of what, if there is a third row: of the gap otherwise
        integer, intent(in) :: iprof(:)
        real(wp), intent(in) :: aprof(:, :)
        !> Points of laws: foundation, from 1; displacement, force per length, and place, if there is a third row
        integer, intent(in) :: ilaw(:)
        real(wp), intent(in) :: alaw(:, :)
        !> Their places in it are filled
        type(model_type), intent(inout) :: model
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        deallocate (model%foundations, model%ground, model%ground_law)
        allocate (model%foundations(size(side)), model%ground(size(iprof)), model%ground_law(size(ilaw)), stat=stat)
        if (failed(stat, error)) return
        do i = 1, size(model%foundations)
            associate (f => model%foundations(i))
                f = foundation_type(side=side(i), from=found(1, i), to=found(2, i), k=found(3, i), k_to=found(4, i), &
                                    gap=found(5, i), gap_to=found(6, i))
                if (size(found, 1) == 6) cycle
                f%law = nint(found(7, i))
                f%parameter = found(8:10, i)
                f%parameter_to = found(11:13, i)
                if (size(found, 1) > 13) f%shear = found(14, i)
            end associate
        end do
        do i = 1, size(model%ground)
            model%ground(i) = ground_point_type(iprof(i), aprof(1, i), aprof(2, i))
            if (size(aprof, 1) > 2) model%ground(i)%quantity = nint(aprof(3, i))
        end do
        do i = 1, size(model%ground_law)
            model%ground_law(i) = ground_law_point_type(ilaw(i), alaw(1, i), alaw(2, i))
            if (size(alaw, 1) > 2) model%ground_law(i)%x = alaw(3, i)
        end do
    end subroutine foundations_from_arrays

    !> Loads from arrays
    subroutine loads_from_arrays(iload, aload, loads, error)
        !> Kind, case, node; x or from, to, value, value at the right end
        integer, intent(in) :: iload(:, :)
        real(wp), intent(in) :: aload(:, :)
        type(load_type), allocatable, intent(out) :: loads(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, stat

        allocate (loads(size(aload, 2)), stat=stat)
        if (failed(stat, error)) return
        do i = 1, size(loads)
            loads(i) = load_type(kind=iload(1, i), case=iload(2, i), node=iload(3, i), x=aload(1, i), to=aload(2, i), &
                                 value=aload(3, i), value_to=aload(4, i))
        end do
    end subroutine loads_from_arrays

end module gapbeam_arrays
