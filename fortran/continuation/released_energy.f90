!> Energy that is set free where the load cannot go on and the beam lands further along its path.
!>
!> Along a path the energy changes by the work of the loads only. Where all but smooth laws is linear between two states, the loads
!> that grow do the mean of their work in full at both, times what the factor grows by, less the area between the smooth laws and
!> their chords: for the supports with these hand over the difference (Betti).
!>
!> What the loads of a stretch do is what they make at its ends, held there, along the displacements and with the moments of its
!> ends (Betti again), and what they do along those that they make themselves. That is a number for every load factor, which
!> cancels where the factor comes back to what it was: it is left out.
module gapbeam_released_energy
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_element, only: field_type, sum_type, add, total
    use gapbeam_assembled_model, only: assembled_type, growth_of
    use gapbeam_solution, only: state_type, new_state
    use gapbeam_query, only: find_starts
    use gapbeam_history_record, only: history_type, runs_of
    use gapbeam_history_start, only: grow_dead_loads
    use gapbeam_path_states, only: solve_on_path
    use gapbeam_piece, only: no_load
    use gapbeam_link, only: link_type, condense_link
    use gapbeam_fields, only: values_at
    use gapbeam_foundation, only: stretch_link_type, stretch_load_type, condense_loaded
    use gapbeam_stretch_loads, only: load_on_part, on_stretch
    use gapbeam_laws, only: law_energy
    use gapbeam_smooth_laws, only: smooth_supports, past_the_gap, force_and_slope, deflection_at
    implicit none
    private
    public :: find_released_energy

contains

    !> From a limit to its landing, along the stretches that are passed in between; a smooth law is one piece
    subroutine find_released_energy(assembled, path, number, energy, error)
        type(assembled_type), intent(in), target :: assembled
        !> By follow_on_laws
        type(history_type), intent(in), target :: path
        !> Of a limit that has a landing; met while the dead loads are put on only if supports do not move with them
        integer, intent(in) :: number
        real(wp), intent(out) :: energy
        !> As for solve_on_path
        type(error_type), allocatable, intent(out) :: error
        type(assembled_type), target :: dead
        type(assembled_type), pointer :: beam
        type(field_type), allocatable :: starts(:), starts_of_other(:)
        integer, allocatable :: runs(:, :)
        type(state_type) :: one, other
        real(wp) :: from, to
        integer :: run, first, last, stat

        energy = 0.0_wp
        allocate (starts(size(assembled%pieces)), starts_of_other(size(assembled%pieces)), stat=stat)
        if (failed(stat, error)) return
        beam => assembled
        allocate (runs, source=runs_of(path))
        associate (limit => path%limits(number))
            if (limit%leg == 0) then
                call grow_dead_loads(assembled, dead)
                beam => dead
            end if
            do run = 1, size(runs, 2)
                first = max(runs(1, run), limit%stretch + 1)
                last = min(runs(2, run), limit%landing)
                if (first > last) cycle
                from = path%stretches(first)%from
                to = path%stretches(last)%to
                ! The landing begins at the factor of the limit
                if (last == limit%landing) to = limit%factor
                if (last == limit%landing .and. first > 1) from = path%stretches(first - 1)%to
                if (.not. abs(to - from) > 0.0_wp) cycle
                call find_state(first, from, one, starts)
                if (.not. allocated(error)) call find_state(last, to, other, starts_of_other)
                if (allocated(error)) return
                energy = energy + energy_between(beam, one, starts, other, starts_of_other)
            end do
        end associate

    contains

        !> A state on a stretch, and its fields
        subroutine find_state(stretch, factor, state, fields)
            integer, intent(in) :: stretch
            real(wp), intent(in) :: factor
            type(state_type), intent(out) :: state
            type(field_type), intent(inout) :: fields(:)

            call new_state(beam, state, error)
            if (.not. allocated(error)) call solve_on_path(beam, path, stretch, factor, state, error)
            if (allocated(error) .or. allocated(state%ground)) return
            call find_starts(beam, state, fields, error)
        end subroutine find_state

    end subroutine find_released_energy

    !> Energy that is set free on the way from one state to another, in the user's units, but for a function of their load factors
    function energy_between(assembled, one, starts_of_one, other, starts_of_other) result(energy)
        !> The beam, on ground at most that holds it both ways by its modulus alone
        type(assembled_type), intent(in) :: assembled
        !> The states, and their fields at the left ends of the pieces where these are not solved in stretches
        type(state_type), intent(in) :: one, other
        type(field_type), intent(in) :: starts_of_one(:), starts_of_other(:)
        real(wp) :: energy

        energy = (other%factor - one%factor)*(work_of_live_loads(assembled, one, starts_of_one) &
                                              + work_of_live_loads(assembled, other, starts_of_other))/2 &
            - area_over_chords(assembled, one, other)
    end function energy_between

    !> Work that the live loads in full would do along the displacements of a state; those along the axis are left out. Of imposed
    !> curvatures what the moments do along them, of movements of supports what the reactions do
    function work_of_live_loads(assembled, state, starts) result(work)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        type(field_type), intent(in) :: starts(:)
        real(wp) :: work
        type(sum_type) :: parts
        !> Rotations at the left and right ends of all pieces
        type(field_type) :: left(size(starts)), right(size(starts))
        real(wp) :: growth(size(assembled%normal))
        !> What is at the ends of pieces is looked at by itself
        logical, parameter :: inside(2) = .false.
        integer :: i

        if (allocated(state%ground)) then
            call add_stretches()
        else
            left(:) = starts
            call values_at(assembled%pieces, assembled%dead, assembled%live, state%factor, starts, [(i, i=1, size(starts))], &
                           assembled%pieces%length, right)
            call add_pieces()
        end if
        do i = 1, size(assembled%pieces)
            associate (live => assembled%live(i), a => left(i), b => right(i))
                call add(parts, live%couple_a*a%rotation - live%kink_a*a%moment)
                call add(parts, (live%couple + live%couple_b)*b%rotation - live%kink_b*b%moment + live%force*b%deflection)
            end associate
        end do
        do i = 0, ubound(state%moment_left, 1)
            associate (force => assembled%beam%force(2, i), couple => assembled%beam%couple(2, i), point => assembled%node_point(i))
                call add(parts, force*state%deflection(i))
                ! A couple at a hinge is refused, so the rotation has one value
                if (point == 0) then
                    call add(parts, couple*left(1)%rotation)
                else
                    call add(parts, couple*right(point)%rotation)
                end if
            end associate
        end do
        if (allocated(assembled%growth)) then
            growth(:) = growth_of(assembled)
            do i = 1, size(growth)
                call add(parts, state%reaction(i)*growth(i))
            end do
        end if
        work = scale(total(parts), assembled%units%force + assembled%units%deflection)

    contains

        !> Loads along the stretches of a beam on ground or under an axial force
        subroutine add_stretches()
            type(stretch_load_type) :: load
            type(stretch_link_type) :: link
            real(wp), dimension(1) :: turn_a, turn_b, shear_a, shear_b

            associate (s => state%ground)
                do i = 1, size(s%piece)
                    associate (j => s%piece(i), ends => s%ends(i))
                        load = on_stretch(load_on_part(assembled%live(j), s%from(i), s%to(i), assembled%pieces(j)%length, inside))
                        call condense_loaded(s%stretches(i), [load], link, turn_a, turn_b, shear_a, shear_b)
                        call add(parts, shear_a(1)*ends%w_a + shear_b(1)*ends%w_b)
                        call add(parts, turn_a(1)*ends%moment_a + turn_b(1)*ends%moment_b)
                        if (.not. s%from(i) > 0.0_wp) left(j) = field_type(ends%w_a, s%rotation(1, i), ends%moment_a, 0.0_wp)
                        right(j) = field_type(ends%w_b, s%rotation(2, i), ends%moment_b, 0.0_wp)
                    end associate
                end do
            end associate
        end subroutine add_stretches

        !> Loads along the pieces of any other
        subroutine add_pieces()
            type(link_type) :: bar
            real(wp) :: work_of_link(1)

            do i = 1, size(assembled%pieces)
                associate (length => assembled%pieces(i)%length)
                    call condense_link(assembled%pieces(i:i), [no_load], [load_on_part(assembled%live(i), 0.0_wp, length, length, &
                                                                                       inside)], work_of_link, bar)
                end associate
                call add(parts, bar%shear_a(2)*left(i)%deflection - bar%shear_b(2)*right(i)%deflection)
                call add(parts, bar%turn_a(2)*left(i)%moment + bar%turn_b(2)*right(i)%moment)
            end do
        end subroutine add_pieces

    end function work_of_live_loads

    !> Area between smooth laws and their chords from one state to another
    pure function area_over_chords(assembled, one, other) result(area)
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: one, other
        real(wp) :: area
        integer, allocatable :: numbers(:)
        real(wp) :: w(2), past(2), force(2), slope(2)
        integer :: j, way(2)

        area = 0.0_wp
        allocate (numbers, source=smooth_supports(assembled))
        do j = 1, size(numbers)
            associate (s => assembled%model%supports(numbers(j)))
                w = [deflection_at(assembled, one%deflection, numbers(j)), deflection_at(assembled, other%deflection, numbers(j))]
                call past_the_gap(s, w, past, way)
                call force_and_slope(s, past, force, slope)
                past = max(past, 0.0_wp)
                area = area + law_energy(s%law, s%parameter, past(2)) - law_energy(s%law, s%parameter, past(1)) &
                    - (way(1)*force(1) + way(2)*force(2))/2*(w(2) - w(1))
            end associate
        end do
    end function area_over_chords

end module gapbeam_released_energy
