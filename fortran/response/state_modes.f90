!> Modes of a solved state: factors of its axial forces at which it buckles, and circular frequencies at which it vibrates, with the
!> supports and the ground that act in it.
module gapbeam_state_modes
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp, qp
    use gapbeam_words, only: whole
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_bad_input
    use gapbeam_piece, only: is_compressed
    use gapbeam_ground, only: ground_type
    use gapbeam_ground_start, only: ground_start_type, start_from
    use gapbeam_unloaded_beam, only: leave_supports
    use gapbeam_refined_ground, only: refine_ground, refine_zones
    use gapbeam_ground_quad, only: fine_ground_type => ground_type, fine_zones_type => zones_type
    use gapbeam_modes, only: by_axial_force, by_vibration
    use gapbeam_mode_values, only: find_mode_values
    use gapbeam_mode_values_quad, only: find_fine_values => find_mode_values
    use gapbeam_modes_quad, only: fine_shape_type => mode_shape_type, find_fine_shape => find_mode_shape
    use gapbeam_assembled_model, only: assembled_type, place_x
    use gapbeam_solution, only: state_type
    use gapbeam_loaded_ground, only: ground_of
    use gapbeam_law_margins, only: margin_in_scheme, is_watched_in
    use gapbeam_tolerances, only: no_displacement
    implicit none
    private
    public :: by_axial_force, by_vibration, shape_type, values_of_modes, shape_of_mode, shape_of_buckling

    !> How a beam moves in a mode, in the user's units
    type :: shape_type
        !> Places; deflections there, the largest 1; moments left and right of them with these, shape (2, ...)
        real(wp), allocatable :: x(:), deflection(:), moment(:, :)
        !> How many times these deflections swing when a support closes or opens first, and which one of the model that is;
        !> infinite and 0 where none does
        real(wp) :: amplitude = 0.0_wp
        integer :: support = 0
    end type shape_type

contains

    !> The first values of modes, in rising order
    subroutine values_of_modes(assembled, state, what, values, found, error)
        !> The beam, and its solved state
        type(assembled_type), intent(in), target :: assembled
        type(state_type), intent(in) :: state
        !> by_axial_force: factors of all axial forces; by_vibration: circular frequencies (rad per unit of time)
        integer, intent(in) :: what
        !> As many as are wanted, and how many there are
        real(wp), intent(out) :: values(:)
        integer, intent(out) :: found
        !> Not available, or no memory
        type(error_type), allocatable, intent(out) :: error
        type(ground_type) :: ground
        type(ground_start_type) :: start
        type(fine_ground_type) :: fine
        type(fine_zones_type) :: zones
        real(qp) :: fine_values(size(values))
        real(wp) :: first
        integer :: known
        logical :: lost

        values(:) = 0.0_wp
        found = 0
        if (.not. has_any(assembled, what)) return
        call check_state(state, error)
        if (allocated(error)) return
        ground = ground_of(assembled, state%factor, state)
        if (what == by_axial_force .and. .not. any(is_compressed(ground%pieces))) return
        call find_acting(ground, state, what, start)
        first = first_step(ground, what)
        call find_mode_values(ground, start%zones, start%closed, start%factor, what, first, values, known, lost)
        if (.not. lost) then
            if (known == 0) return
            call refine_ground(ground, fine)
            call refine_zones(fine, start%zones, zones)
            call find_fine_values(fine, zones, start%closed, real(start%factor, qp), what, real(first, qp), fine_values, found, &
                                  lost, real(values(:known), qp))
            known = found
        end if
        if (lost) then
            found = 0
            call fatal_error(error, gapbeam_bad_input, "modes: stiffnesses, masses and axial forces of the beam are too far "// &
                             "apart to count more than "//trim(whole(known))//"; ask for no more")
            return
        end if
        if (what == by_vibration) fine_values(:found) = sqrt(fine_values(:found))
        values(:found) = real(fine_values(:found), wp)
        values(found + 1:) = 0.0_wp
    end subroutine values_of_modes

    !> How the beam moves in a mode
    subroutine shape_of_mode(assembled, state, what, value, parts, shape, error)
        !> As for values_of_modes
        type(assembled_type), intent(in), target :: assembled
        type(state_type), intent(in) :: state
        integer, intent(in) :: what
        !> One of its values
        real(wp), intent(in) :: value
        !> Places on every stretch at least
        integer, intent(in) :: parts
        type(shape_type), intent(out) :: shape
        type(error_type), allocatable, intent(out) :: error
        type(ground_type) :: ground
        type(ground_start_type) :: start
        type(fine_ground_type) :: fine
        type(fine_zones_type) :: zones
        type(fine_shape_type) :: found
        real(qp) :: at
        integer :: stat

        call check_state(state, error)
        if (.not. allocated(error) .and. .not. has_any(assembled, what)) then
            call fatal_error(error, gapbeam_bad_input, "modes: there are none, since the beam has no "// &
                             trim(merge("mass       ", "compression", what == by_vibration)))
        end if
        if (allocated(error)) return
        ground = ground_of(assembled, state%factor, state)
        call find_acting(ground, state, what, start)
        call refine_ground(ground, fine)
        call refine_zones(fine, start%zones, zones)
        at = value
        if (what == by_vibration) at = at**2
        ! What moves freely is close to its place under next to nothing
        if (.not. at > 0.0_qp) at = epsilon(1.0_wp)*first_step(ground, what)
        call find_fine_shape(fine, zones, start%closed, real(start%factor, qp), what, at, parts, found)
        if (size(found%piece) == 0) then
            call fatal_error(error, gapbeam_bad_input, "modes: the stiffnesses of the beam are too far apart to tell a shape")
            return
        end if
        associate (n => size(found%piece), units => assembled%units)
            allocate (shape%x(n), shape%deflection(n), shape%moment(2, n), stat=stat)
            if (failed(stat, error)) return
            shape%x(:) = place_x(assembled, found%piece, real(found%distance, wp))
            shape%deflection(:) = real(found%deflection, wp)
            shape%moment(:, :) = scale(real(found%moment, wp), units%force + units%length - units%deflection)
        end associate
        call find_amplitude(assembled, ground, state, real(found%at_nodes, wp), real(found%reaction, wp), shape)
    end subroutine shape_of_mode

    !> What acts in a state; a compressed beam without loads may buckle away from what it only touches
    subroutine find_acting(ground, state, what, start)
        type(ground_type), intent(in) :: ground
        type(state_type), intent(in) :: state
        !> As for values_of_modes
        integer, intent(in) :: what
        type(ground_start_type), intent(out) :: start
        real(wp), allocatable :: mode(:)
        real(wp) :: share
        logical :: leaves

        call start_from(state%ground, state%closed, start)
        share = huge(share)
        if (what == by_axial_force) call leave_supports(ground, state%ground, share, start, mode, leaves)
    end subroutine find_acting

    !> How far a mode may swing before a support closes or opens
    pure subroutine find_amplitude(assembled, ground, state, at_nodes, reaction, shape)
        type(assembled_type), intent(in) :: assembled
        !> At the load factor of the state
        type(ground_type), intent(in) :: ground
        type(state_type), intent(in) :: state
        !> Of the mode: deflections of the nodes, the largest anywhere 1, and reactions
        real(wp), intent(in) :: at_nodes(0:), reaction(:)
        type(shape_type), intent(inout) :: shape
        real(wp) :: none(size(reaction)), margin, rounding, moved, rest, most, at
        integer :: k
        logical :: by_force

        shape%amplitude = ieee_value(shape%amplitude, ieee_positive_inf)
        shape%support = 0
        none(:) = 0.0_wp
        associate (supports => ground%beam%supports, closed => state%closed)
            do k = 1, size(supports)
                if (.not. is_watched_in(supports, closed, k)) cycle
                at = at_nodes(supports(k)%node)
                call margin_in_scheme(supports, closed, k, state%deflection(supports(k)%node), 0.0_wp, state%reaction, none, &
                                      margin, rounding)
                ! Margins are straight in deflections and forces
                call margin_in_scheme(supports, closed, k, at, 0.0_wp, reaction, none, moved, rounding, by_force)
                call margin_in_scheme(supports, closed, k, 0.0_wp, 0.0_wp, none, none, rest, rounding)
                most = merge(maxval(abs(reaction)), 1.0_wp, by_force)
                if (.not. abs(moved - rest) > no_displacement*most) cycle
                most = scale(max(margin, 0.0_wp)/abs(moved - rest), assembled%units%deflection)
                if (most >= shape%amplitude) cycle
                shape%amplitude = most
                shape%support = assembled%normal(k)
            end do
        end associate
    end subroutine find_amplitude

    !> How a beam gives way that does not bear its axial forces
    subroutine shape_of_buckling(assembled, state, x, deflection, error)
        !> The beam, and its state with status gapbeam_buckles
        type(assembled_type), intent(in) :: assembled
        type(state_type), intent(in) :: state
        !> Places; deflections there, the largest 1
        real(wp), allocatable, intent(out) :: x(:), deflection(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: stat

        associate (ground => state%ground)
            allocate (x(size(ground%mode_piece)), deflection(size(ground%mode_piece)), stat=stat)
            if (failed(stat, error)) return
            x(:) = place_x(assembled, ground%mode_piece, ground%mode_distance)
            deflection(:) = ground%mode_deflection
        end associate
    end subroutine shape_of_buckling

    !> Has a beam what its modes are of: compression, or mass
    pure function has_any(assembled, what) result(it_has)
        type(assembled_type), intent(in) :: assembled
        integer, intent(in) :: what
        logical :: it_has

        if (what == by_vibration) then
            it_has = any(assembled%pieces%mass > 0.0_wp) .or. any(assembled%model%masses(2, :) > 0.0_wp)
        else
            it_has = any(is_compressed(assembled%pieces)) .or. assembled%model%axial_loads_bend
        end if
    end function has_any

    !> Are there modes of a state in this version
    subroutine check_state(state, error)
        type(state_type), intent(in) :: state
        type(error_type), allocatable, intent(out) :: error

        if (.not. allocated(state%ground)) then
            call fatal_error(error, gapbeam_bad_input, "modes: the beam has neither mass nor an axial force that bending feels")
        end if
    end subroutine check_state

    !> A value that is below the first one, mostly: of the whole beam between pins, with the softest piece all along
    pure function first_step(ground, what) result(step)
        type(ground_type), intent(in) :: ground
        integer, intent(in) :: what
        real(wp) :: step, lumped

        associate (p => ground%pieces, length => sum(ground%pieces%length))
            step = max(maxval(p%flexibility)*length**2, maxval(p%shear_flexibility))
            if (what == by_vibration) then
                lumped = 0.0_wp
                if (allocated(ground%mass)) lumped = sum(ground%mass)
                step = step*(length**2*maxval(p%mass) + length*lumped)
            else
                step = step*maxval(p%slope_stiffness - p%tension)
            end if
        end associate
        step = 1/max(step, epsilon(step))
    end function first_step

end module gapbeam_state_modes
