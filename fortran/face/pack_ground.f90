!> Foundations of prepared beams, and states on the ground, in the work arrays of Fortran 77, and back
module gapbeam_pack_ground
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_kinds, only: wp
    use gapbeam_scene, only: model_type
    use gapbeam_layers, only: pieces_of_law
    use gapbeam_foundation, only: stretch_type, stretch_load_type, stretch_ends_type
    use gapbeam_ground, only: zones_type, full_contact
    use gapbeam_assembled_model, only: assembled_type
    use gapbeam_state, only: ground_of
    use gapbeam_ground_solver, only: ground_solution_type
    use gapbeam_tape, only: tape_type, exchange, exchange_size, reading
    implicit none
    private
    public :: exchange_foundations, exchange_layers, exchange_solution, add_likely_solution

    !> Numbers in the types of which a stretch consists, and in all of it beside its layers: its piece; its ends, and the rotations
    !> and shears there
    integer, parameter :: of_stretch = storage_size(stretch_type())/storage_size(1.0_wp), &
                          of_load = storage_size(stretch_load_type())/storage_size(1.0_wp), &
                          of_ends = storage_size(stretch_ends_type())/storage_size(1.0_wp), &
                          integers_beside = 1, reals_beside = of_stretch + of_load + of_ends + 7
    !> Numbers of a solution beside its stretches: layers; bounds and residuals
    integer, parameter :: integers_of_all = 1, reals_of_all = 8

contains

    !> Foundations, tables and laws of the user's model
    subroutine exchange_foundations(tape, model)
        !> Measures, writes or reads
        type(tape_type), intent(inout) :: tape
        !> Without these arrays when they are to be read
        type(model_type), intent(inout) :: model
        integer :: number, i, stat

        number = 0
        if (allocated(model%foundations)) number = size(model%foundations)
        call exchange_size(tape, allocated(model%foundations), number)
        if (tape%mode == reading) then
            allocate (model%foundations(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (f => model%foundations(i))
                call exchange(tape, f%from)
                call exchange(tape, f%to)
                call exchange(tape, f%k)
                call exchange(tape, f%k_to)
                call exchange(tape, f%side)
                call exchange(tape, f%gap)
                call exchange(tape, f%gap_to)
                call exchange(tape, f%law)
                call exchange(tape, size(f%parameter), f%parameter)
                call exchange(tape, size(f%parameter_to), f%parameter_to)
            end associate
        end do
        number = 0
        if (allocated(model%ground)) number = size(model%ground)
        call exchange_size(tape, allocated(model%ground), number)
        if (tape%mode == reading) then
            allocate (model%ground(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (point => model%ground(i))
                call exchange(tape, point%foundation)
                call exchange(tape, point%x)
                call exchange(tape, point%value)
                call exchange(tape, point%quantity)
            end associate
        end do
        number = 0
        if (allocated(model%ground_law)) number = size(model%ground_law)
        call exchange_size(tape, allocated(model%ground_law), number)
        if (tape%mode == reading) then
            allocate (model%ground_law(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (point => model%ground_law(i))
                call exchange(tape, point%foundation)
                call exchange(tape, point%displacement)
                call exchange(tape, point%force)
                call exchange(tape, point%x)
            end associate
        end do
    end subroutine exchange_foundations

    !> Points of foundations, and the layers under the pieces
    subroutine exchange_layers(tape, lowered)
        type(tape_type), intent(inout) :: tape
        !> Without these arrays when they are to be read
        type(assembled_type), intent(inout) :: lowered
        integer :: number, i, stat

        call exchange(tape, lowered%foundation_from, 1)
        call exchange(tape, lowered%foundation_to, 1)
        call exchange(tape, lowered%ground_point, 1)
        call exchange(tape, lowered%layer_first, 1)
        number = 0
        if (allocated(lowered%layers)) number = size(lowered%layers)
        call exchange_size(tape, allocated(lowered%layers), number)
        if (number < 0) return
        if (tape%mode == reading) then
            allocate (lowered%layers(number), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (layer => lowered%layers(i))
                call exchange(tape, layer%foundation)
                call exchange(tape, layer%side)
                call exchange(tape, layer%modulus_a)
                call exchange(tape, layer%modulus_b)
                call exchange(tape, layer%contact_a)
                call exchange(tape, layer%contact_b)
                call exchange(tape, layer%law_first)
                call exchange(tape, layer%law_last)
                call exchange(tape, layer%law)
                call exchange(tape, size(layer%parameter_a), layer%parameter_a)
                call exchange(tape, size(layer%parameter_b), layer%parameter_b)
            end associate
        end do
        number = 0
        if (allocated(lowered%law_pieces)) number = size(lowered%law_pieces)
        call exchange_size(tape, allocated(lowered%law_pieces), number)
        if (tape%mode == reading) then
            allocate (lowered%law_pieces(max(number, 0)), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        do i = 1, number
            associate (piece => lowered%law_pieces(i))
                call exchange(tape, piece%displacement_a)
                call exchange(tape, piece%displacement_b)
                call exchange(tape, piece%force_a)
                call exchange(tape, piece%force_b)
                call exchange(tape, piece%slope_a)
                call exchange(tape, piece%slope_b)
                call exchange(tape, piece%way_a)
                call exchange(tape, piece%way_b)
            end associate
        end do
    end subroutine exchange_layers

    !> A solution on the ground, as far as what is asked of a state needs it; without equilibrium there is none
    subroutine exchange_solution(tape, solution)
        type(tape_type), intent(inout) :: tape
        !> Not allocated when it is to be read
        type(ground_solution_type), allocatable, intent(inout) :: solution
        real(wp) :: reals(reals_beside)
        integer :: stretches, layers, i, stat
        logical :: given

        given = allocated(solution)
        if (given) given = allocated(solution%piece)
        stretches = 0
        layers = 0
        if (given) then
            stretches = size(solution%piece)
            layers = size(solution%acts, 1)
        end if
        call exchange_size(tape, given, stretches)
        if (stretches < 0) return
        call exchange(tape, layers)
        if (tape%mode == reading) then
            allocate (solution, stat=stat)
            if (stat == 0) allocate (solution%piece(stretches), solution%from(stretches), solution%to(stretches), &
                                     solution%acts(layers, stretches), solution%stretches(stretches), &
                                     solution%loads(stretches), solution%ends(stretches), solution%slope(stretches), &
                                     solution%rotation(2, stretches), &
                                     solution%shear(2, stretches), solution%resultant(layers, stretches), stat=stat)
            if (stat /= 0) tape%stat = stat
            if (stat /= 0) return
        end if
        call exchange(tape, size(solution%bounds), solution%bounds)
        call exchange(tape, size(solution%residuals), solution%residuals)
        do i = 1, stretches
            associate (s => solution)
                call exchange(tape, s%piece(i))
                if (tape%mode /= reading) reals = [s%from(i), s%to(i), s%rotation(:, i), s%shear(:, i), s%slope(i), &
                                                   transfer(s%stretches(i), reals, of_stretch), &
                                                   transfer(s%loads(i), reals, of_load), transfer(s%ends(i), reals, of_ends)]
                call exchange(tape, reals_beside, reals)
                if (tape%mode == reading) then
                    s%from(i) = reals(1)
                    s%to(i) = reals(2)
                    s%rotation(:, i) = reals(3:4)
                    s%shear(:, i) = reals(5:6)
                    s%slope(i) = reals(7)
                    s%stretches(i) = transfer(reals(8:), s%stretches(i))
                    s%loads(i) = transfer(reals(8 + of_stretch:), s%loads(i))
                    s%ends(i) = transfer(reals(8 + of_stretch + of_load:), s%ends(i))
                end if
                call exchange(tape, layers, s%resultant(:, i))
                call exchange_acts(s%acts(:, i))
            end associate
        end do

    contains

        !> On which pieces of their laws the layers act
        subroutine exchange_acts(acts)
            integer, intent(inout) :: acts(:)
            integer :: k

            do k = 1, size(acts)
                call exchange(tape, acts(k))
            end do
        end subroutine exchange_acts

    end subroutine exchange_solution

    !> Add the lengths that a solution hardly ever exceeds: how many zones there are is known only when it is found
    subroutine add_likely_solution(lowered, reals, integers)
        !> With layers
        type(assembled_type), intent(in) :: lowered
        integer(int64), intent(inout) :: reals, integers
        type(zones_type) :: zones
        integer(int64) :: stretches, layers

        call full_contact(ground_of(lowered), zones)
        layers = size(zones%acts, 1)
        ! Every layer may touch in two places of a piece, and go through its law at both ends of each
        stretches = size(zones%piece, kind=int64) + 4*sum(int(pieces_of_law(lowered%layers), int64)) + 32
        reals = reals + reals_of_all + stretches*(reals_beside + layers)
        integers = integers + integers_of_all + stretches*(integers_beside + layers)
    end subroutine add_likely_solution

end module gapbeam_pack_ground
