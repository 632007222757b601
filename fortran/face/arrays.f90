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
        !> Length, EI, GA, EA, axial force, mass
        real(wp), intent(in) :: span(:, :)
        !> Places, and couple per relative rotation
        real(wp), intent(in) :: hinge(:, :)
        !> From, to; EI, GA, EA, each at both ends; N; friction at both ends, bedding; powers of EI, GA, EA
        real(wp), intent(in) :: sect(:, :)
        !> Side, direction, node, unloading, law by name; x, stiffness, gap, settlement, rotation, parameters of the law, friction
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
        model%spans(:) = [(span_type(span(1, i), span(2, i), span(3, i), span(4, i), span(5, i), span(6, i)), i=1, size(span, 2))]
        model%hinges(:) = hinge(1, :)
        model%hinge_stiffness(:) = hinge(2, :)
        do i = 1, size(model%sections)
            associate (s => sect(:, i))
                model%sections(i) = section_type(from=s(1), to=s(2), EI=s(3), EI_to=s(4), GA=s(5), GA_to=s(6), EA=s(7), &
                                                 EA_to=s(8), N=s(9), friction=s(10), friction_to=s(11), bedding=s(12), &
                                                 EI_power=nint(s(13)), GA_power=nint(s(14)), EA_power=nint(s(15)))
            end associate
        end do
        do i = 1, size(model%supports)
            associate (codes => isup(:, i), s => sup(:, i))
                model%supports(i) = support_type(side=codes(1), direction=codes(2), node=codes(3), unloading=codes(4), &
                                                 law=codes(5), x=s(1), stiffness=s(2), gap=s(3), settlement=s(4), rotation=s(5), &
                                                 parameter=s(6:8), friction=s(9))
            end associate
        end do
        model%law(:) = [(law_point_type(ilaw(i), alaw(1, i), alaw(2, i)), i=1, size(model%law))]
        call loads_from_arrays(iload, aload, model%loads, error)
    end subroutine model_from_arrays

    !> The foundations of a model from arrays
    subroutine foundations_from_arrays(side, found, iprof, aprof, ilaw, alaw, model, error)
        !> Side; from, to, modulus and gap, each at the left and right end, law by name, its parameters at the left end and at the
        !> right end, shear
        integer, intent(in) :: side(:)
        real(wp), intent(in) :: found(:, :)
        !> Points of tables: foundation, from 1; x, value, and of what
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
            associate (f => found(:, i))
                model%foundations(i) = foundation_type(side=side(i), from=f(1), to=f(2), k=f(3), k_to=f(4), gap=f(5), gap_to=f(6), &
                                                       law=nint(f(7)), parameter=f(8:10), parameter_to=f(11:13), shear=f(14))
            end associate
        end do
        model%ground(:) = [(ground_point_type(iprof(i), aprof(1, i), aprof(2, i), nint(aprof(3, i))), i=1, size(model%ground))]
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
