!> Prepared beams and their states in the work arrays of Fortran 77, and back
module gapbeam_pack
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: link_type, piece_type, piece_load_type
    use gapbeam_model, only: node_support_type
    use gapbeam_scene, only: model_type
    use gapbeam_units, only: units_type
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_solution, only: state_type
    use gapbeam_tape, only: tape_type, exchange, exchange_size, reading
    use gapbeam_pack_ground, only: exchange_foundations, exchange_layers, exchange_solution
    implicit none
    private
    public :: exchange_beam, exchange_state

contains

    !> Everything of a prepared beam
    subroutine exchange_beam(tape, lowered)
        !> Measures, writes or reads
        type(tape_type), intent(inout) :: tape
        !> Without any array when it is to be read
        type(assembled_type), intent(inout) :: lowered

        call exchange_model(tape, lowered%model)
        call exchange_foundations(tape, lowered%model)
        call exchange_layers(tape, lowered)
        call exchange(tape, lowered%fingerprint)
        call exchange_units(tape, lowered%units)
        call exchange(tape, lowered%ends, 0)
        call exchange(tape, lowered%end_point, 0)
        call exchange(tape, lowered%point_span, 0)
        call exchange(tape, lowered%point_offset, 0)
        call exchange(tape, lowered%support_point, 1)
        call exchange(tape, lowered%load_from, 1)
        call exchange(tape, lowered%load_to, 1)
        call exchange(tape, lowered%hinged, 0)
        call exchange_pieces(tape, lowered%pieces)
        call exchange_piece_loads(tape, lowered%dead)
        call exchange_piece_loads(tape, lowered%live)
        call exchange(tape, lowered%node_point, 0)
        call exchange(tape, lowered%node_of_point, 0)
        call exchange_links(tape, lowered%beam%links)
        call exchange(tape, lowered%beam%kind, 0)
        call exchange(tape, lowered%beam%compliance, 0)
        call exchange(tape, lowered%beam%force)
        call exchange(tape, lowered%beam%couple)
        call exchange_node_supports(tape, lowered%beam%supports)
        call exchange(tape, lowered%beam%order, 1)
        call exchange(tape, lowered%beam%first, 0)
        call exchange(tape, lowered%normal, 1)
        call exchange(tape, lowered%beam_support, 1)
        call exchange(tape, lowered%with_law, 1)
        call exchange(tape, lowered%depends_on_path)
        call exchange(tape, lowered%turning, 0)
        call exchange(tape, lowered%couple_share, 1)
        call exchange_units(tape, lowered%axial%units)
        call exchange(tape, lowered%axial%point, 0)
        call exchange(tape, lowered%axial%softness, 1)
        call exchange(tape, lowered%axial%before, 1)
        call exchange(tape, lowered%axial%flexibility, 1)
        call exchange(tape, lowered%axial%force)
        call exchange(tape, lowered%axial%stiffness, 0)
        call exchange(tape, lowered%axial%settlement, 0)
        call exchange(tape, lowered%axial%node, 1)
    end subroutine exchange_beam

    !> Units
    subroutine exchange_units(tape, units)
        type(tape_type), intent(inout) :: tape
        type(units_type), intent(inout) :: units

        call exchange(tape, units%length)
        call exchange(tape, units%force)
        call exchange(tape, units%deflection)
    end subroutine exchange_units

    !> Everything of a state
    subroutine exchange_state(tape, state)
        !> Measures, writes or reads
        type(tape_type), intent(inout) :: tape
        !> Without any array when it is to be read
        type(state_type), intent(inout) :: state
        integer :: number, i, stat

        call exchange(tape, state%status)
        call exchange(tape, state%factor)
        call exchange(tape, state%fingerprint)
        call exchange(tape, state%solves)
        call exchange(tape, state%method)
        call exchange(tape, state%indifferent)
        call exchange(tape, state%slides)
        call exchange(tape, state%closed, 1)
        call exchange(tape, state%undecided, 1)
        call exchange(tape, state%deflection, 0)
        call exchange(tape, state%moment_left, 0)
        call exchange(tape, state%moment_right, 0)
        call exchange(tape, state%motion, 0)
        call exchange(tape, state%shear, 1)
        call exchange(tape, state%reaction, 1)
        call exchange(tape, state%displacement, 0)
        call exchange(tape, state%axial_reaction, 0)
        call exchange(tape, state%tension, 1)
        call exchange_node_supports(tape, state%laws)
        call exchange_solution(tape, state%ground)
        call exchange(tape, state%has_starts)
        number = 0
        if (allocated(state%starts)) number = size(state%starts)
        call exchange_size(tape, allocated(state%starts), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (state%starts(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (f => state%starts(i))
                call exchange(tape, f%deflection)
                call exchange(tape, f%rotation)
                call exchange(tape, f%moment)
                call exchange(tape, f%shear)
            end associate
        end do
    end subroutine exchange_state

    !> The user's model
    subroutine exchange_model(tape, model)
        type(tape_type), intent(inout) :: tape
        type(model_type), intent(inout) :: model
        integer :: number, i, stat

        call exchange(tape, model%hinges, 1)
        number = 0
        if (allocated(model%spans)) number = size(model%spans)
        call exchange_size(tape, allocated(model%spans), number)
        if (tape%mode == reading) then
            allocate (model%spans(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (s => model%spans(i))
                call exchange(tape, s%length)
                call exchange(tape, s%EI)
                call exchange(tape, s%GA)
                call exchange(tape, s%EA)
            end associate
        end do
        number = 0
        if (allocated(model%supports)) number = size(model%supports)
        call exchange_size(tape, allocated(model%supports), number)
        if (tape%mode == reading) then
            allocate (model%supports(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (s => model%supports(i))
                call exchange(tape, s%x)
                call exchange(tape, s%node)
                call exchange(tape, s%side)
                call exchange(tape, s%stiffness)
                call exchange(tape, s%gap)
                call exchange(tape, s%settlement)
                call exchange(tape, s%rotation)
                call exchange(tape, s%direction)
                call exchange(tape, s%unloading)
            end associate
        end do
        number = 0
        if (allocated(model%law)) number = size(model%law)
        call exchange_size(tape, allocated(model%law), number)
        if (tape%mode == reading) then
            allocate (model%law(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (point => model%law(i))
                call exchange(tape, point%support)
                call exchange(tape, point%displacement)
                call exchange(tape, point%force)
            end associate
        end do
        number = 0
        if (allocated(model%loads)) number = size(model%loads)
        call exchange_size(tape, allocated(model%loads), number)
        if (tape%mode == reading) then
            allocate (model%loads(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (load => model%loads(i))
                call exchange(tape, load%kind)
                call exchange(tape, load%case)
                call exchange(tape, load%x)
                call exchange(tape, load%node)
                call exchange(tape, load%to)
                call exchange(tape, load%value)
                call exchange(tape, load%value_to)
            end associate
        end do
    end subroutine exchange_model

    !> Pieces
    subroutine exchange_pieces(tape, pieces)
        type(tape_type), intent(inout) :: tape
        type(piece_type), allocatable, intent(inout) :: pieces(:)
        integer :: number, i, stat

        number = 0
        if (allocated(pieces)) number = size(pieces)
        call exchange_size(tape, allocated(pieces), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (pieces(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            call exchange(tape, pieces(i)%length)
            call exchange(tape, pieces(i)%flexibility)
            call exchange(tape, pieces(i)%shear_flexibility)
        end do
    end subroutine exchange_pieces

    !> Loads on pieces
    subroutine exchange_piece_loads(tape, loads)
        type(tape_type), intent(inout) :: tape
        type(piece_load_type), allocatable, intent(inout) :: loads(:)
        integer :: number, i, stat

        number = 0
        if (allocated(loads)) number = size(loads)
        call exchange_size(tape, allocated(loads), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (loads(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (q => loads(i))
                call exchange(tape, q%qa)
                call exchange(tape, q%qb)
                call exchange(tape, q%kappa)
                call exchange(tape, q%force)
                call exchange(tape, q%couple)
            end associate
        end do
    end subroutine exchange_piece_loads

    !> Links
    subroutine exchange_links(tape, links)
        type(tape_type), intent(inout) :: tape
        type(link_type), allocatable, intent(inout) :: links(:)
        real(wp) :: numbers(storage_size(links)/storage_size(1.0_wp))
        integer :: number, i, stat

        number = 0
        if (allocated(links)) number = size(links)
        call exchange_size(tape, allocated(links), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (links(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            if (tape%mode /= reading) numbers = transfer(links(i), numbers)
            call exchange(tape, size(numbers), numbers)
            if (tape%mode == reading) links(i) = transfer(numbers, links(i))
        end do
    end subroutine exchange_links

    !> Supports of nodes
    subroutine exchange_node_supports(tape, supports)
        type(tape_type), intent(inout) :: tape
        type(node_support_type), allocatable, intent(inout) :: supports(:)
        integer :: number, i, stat

        number = 0
        if (allocated(supports)) number = size(supports)
        call exchange_size(tape, allocated(supports), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (supports(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (s => supports(i))
                call exchange(tape, s%node)
                call exchange(tape, s%side)
                call exchange(tape, s%stiffness)
                call exchange(tape, s%contact)
                call exchange(tape, s%breakpoint)
                call exchange(tape, s%more)
                call exchange(tape, s%passed)
                call exchange(tape, s%force)
                call exchange(tape, s%before)
            end associate
        end do
    end subroutine exchange_node_supports

end module gapbeam_pack
