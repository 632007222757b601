!> Supports along the beam, and friction, as links of the axial system, where they are more than springs both ways.
module gapbeam_assemble_links_along
    use gapbeam_kinds, only: wp
    use gapbeam_scene, only: gapbeam_axial, gapbeam_below, gapbeam_infinity
    use gapbeam_model, only: node_support_type
    use gapbeam_units, only: stiffness_unit
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_assemble_laws, only: find_laws, count_breakpoints, make_breakpoints
    implicit none
    private
    public :: assemble_links_along

contains

    !> The links in units of the axial system, one entry a breakpoint
    pure subroutine assemble_links_along(assembled)
        !> With its axial system and the units of that
        type(assembled_type), intent(inout) :: assembled
        integer, allocatable :: first(:), last(:), size_of(:)
        integer :: k, m, n

        associate (axial => assembled%axial, given => assembled%model%supports, law => assembled%law)
            allocate (first(size(given)), last(size(given)), size_of(size(given)))
            call find_laws(law, first, last)
            size_of(:) = 0
            do k = 1, size(given)
                if (axial%node(k) < 0) cycle
                if (given(k)%direction /= gapbeam_axial) then
                    ! A slider: two limits with a rigid piece between them
                    size_of(k) = 2
                else if (assembled%with_law(k)) then
                    size_of(k) = count_breakpoints(given(k), law(first(k):last(k)))
                else if (given(k)%stiffness > 0.0_wp) then
                    size_of(k) = 1
                end if
            end do
            n = sum(size_of)
            ! Of a beam with the loads of a case they are there already
            if (allocated(axial%laws)) deallocate (axial%laws, axial%support, axial%rubs)
            allocate (axial%laws(n), axial%support(n), axial%rubs(n))
            m = 0
            do k = 1, size(given)
                if (size_of(k) == 0) cycle
                associate (s => axial%laws(m + 1:m + size_of(k)))
                    axial%support(m + 1:m + size_of(k)) = k
                    axial%rubs(m + 1:m + size_of(k)) = given(k)%direction /= gapbeam_axial
                    if (given(k)%direction /= gapbeam_axial) then
                        s(1) = node_support_type(axial%node(k), gapbeam_below, gapbeam_infinity, 0.0_wp, 1, .true.)
                        s(2) = node_support_type(axial%node(k), gapbeam_below, 0.0_wp, 0.0_wp, 2, before=gapbeam_infinity)
                    else if (assembled%with_law(k)) then
                        call make_breakpoints(given(k), law(first(k):last(k)), axial%node(k), s)
                    else
                        s(1) = node_support_type(axial%node(k), given(k)%side, given(k)%stiffness, given(k)%settlement &
                                                 + given(k)%side*given(k)%gap)
                    end if
                end associate
                m = m + size_of(k)
            end do
            axial%laws%contact = scale(axial%laws%contact, -axial%units%deflection)
            axial%laws%force = scale(axial%laws%force, -axial%units%force)
            axial%laws%stiffness = scale(axial%laws%stiffness, -stiffness_unit(axial%units))
            axial%laws%before = scale(axial%laws%before, -stiffness_unit(axial%units))
        end associate
    end subroutine assemble_links_along

end module gapbeam_assemble_links_along
