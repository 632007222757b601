!> Motions that a beam with its acting scheme gives way to: under axial forces times a factor, or vibrating at a frequency.
!>
!> The number of negative eigenvalues of its stiffness comes from the pivots of its factor (Sylvester), for links so short that none
!> gives way with both its ends pinned (Wittrick and Williams 1971).
module gapbeam_modes
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_mode_stretches
    use gapbeam_nodes, only: is_hinge, jointed
    use gapbeam_band, only: band_ok, count_unstable_pivots, node_type
    use gapbeam_piece, only: no_load
    use gapbeam_foundation, only: stretch_type, stretch_load_type, decay_lengths
    use gapbeam_curved, only: curved_type, advance_curved
    use gapbeam_foundation_chain, only: factor_foundation_chain, of_working_precision, solve_foundation_chain
    use gapbeam_ground_laws, only: between
    use gapbeam_ground, only: ground_type, zones_type, grounded_type, new_zones, stretch_on_layers, curved_stretch, &
        place_stretches
    use gapbeam_moved_ground, only: under_share
    use gapbeam_model, only: last_place, of_node, left_of_hinge, right_of_hinge
    use gapbeam_turning, only: restrain
    use gapbeam_workspace, only: workspace_type, new_workspace, set_loads, apply_scheme
    use gapbeam_system, only: complete_scheme
    implicit none
    private
    public :: by_axial_force, by_vibration, mode_shape_type, count_modes, find_mode_shape

    !> What the value of a mode multiplies: the axial forces; the mass, and is the square of a circular frequency
    integer, parameter :: by_axial_force = 1, by_vibration = 2

    !> How a beam moves in a mode
    type :: mode_shape_type
        !> Places along the beam, with distances from the left ends of their pieces, none where stiffnesses are too far apart;
        !> deflection there, the largest 1, and moment left and right of them, shape (2, ...)
        integer, allocatable :: piece(:)
        real(wp), allocatable :: distance(:), deflection(:), moment(:, :)
        !> Deflections of the nodes of the beam, shape (0:n), and reactions of the supports
        real(wp), allocatable :: at_nodes(:), reaction(:)
    end type mode_shape_type

contains

    !> How many motions a beam gives way to at a value; -1 where that is a value of a mode exactly, or there are too many stretches
    subroutine count_modes(ground, zones, acting, what, value, number, work, grounded, parts, factor)
        !> The beam and its ground; zones in which that acts, taken as it is near them; supports that act
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        logical, intent(in) :: acting(:)
        !> by_axial_force or by_vibration, and the factor, or the square of the circular frequency
        integer, intent(in) :: what
        real(wp), intent(in) :: value
        integer, intent(out) :: number
        !> The factored beam, in stretches that are short enough
        type(workspace_type), intent(out) :: work
        type(grounded_type), intent(out) :: grounded
        !> Stretches into which every piece is cut at least; default 1
        integer, intent(in), optional :: parts
        !> Load factor at which the zones are, where laws are curves: their slopes are those in the fields of the zones
        real(wp), intent(in), optional :: factor
        type(ground_type) :: changed
        type(zones_type) :: cut
        integer :: state, place, i

        number = -1
        if (what == by_axial_force) then
            changed = under_share(ground, value)
        else
            changed = ground
            changed%frequency_squared = value
        end if
        ! Modes know no loads, and equal steps are condensed once then
        changed%dead = no_load
        changed%live = no_load
        call cut_zones(changed, ground, zones, cut, parts, factor)
        if (size(cut%piece) == 0) return
        if (present(factor)) then
            call place_stretches(changed, cut, factor, grounded, ground)
        else
            call place_stretches(changed, cut, 0.0_wp, grounded)
        end if
        if (grounded%lost) return
        call new_workspace(grounded%beam, work)
        call set_loads(grounded%beam, 0.0_wp, work)
        call apply_scheme(grounded%beam, acting, [0, size(grounded%beam%links)], work)
        if (any(ground%layers%rigid)) call hold_on_rigid_ground(cut, work%nodes)
        if (what == by_vibration .and. allocated(ground%mass)) then
            do i = 0, ubound(ground%mass, 1)
                associate (node => work%nodes(grounded%node(i)))
                    node%stiffness = node%stiffness - value*ground%mass(i)
                end associate
            end do
        end if
        associate (n => size(grounded%beam%links))
            call factor_foundation_chain(work%nodes(0:n), grounded%beam%ground, of_working_precision, work%pivots, state, place)
            if (state /= band_ok .and. place < n) return
            number = count_unstable_pivots(work%nodes(0:n), work%pivots)
        end associate
        if (state /= band_ok .and. number == 0) number = -1
    end subroutine count_modes

    !> Rigid ground holds the beam where it pushes at a place, and its slope as well where a zone begins or ends: that moves, but so
    !> little that the beam does not feel it, since its moment vanishes there
    pure subroutine hold_on_rigid_ground(zones, nodes)
        type(zones_type), intent(in) :: zones
        !> Of the beam on the zones, shape (0:m)
        type(node_type), intent(inout) :: nodes(0:)
        integer :: i, side

        do i = 1, size(zones%piece)
            if (.not. any(zones%acts(:, i) > 0)) cycle
            do side = 0, 1
                associate (node => nodes(i - 1 + side))
                    node%held = .true.
                    if (node%kind == jointed) then
                        call restrain(merge(left_of_hinge, right_of_hinge, side == 1), 0.0_wp, node)
                    else if (.not. is_hinge(node%kind)) then
                        call restrain(of_node, 0.0_wp, node)
                    end if
                end associate
            end do
        end do
        if (.not. allocated(zones%pushed)) return
        do i = 0, size(zones%piece)
            if (zones%pushed(i)) nodes(i)%held = .true.
        end do
    end subroutine hold_on_rigid_ground

    !> Zones cut so that none of the stretches gives way by itself; of no size where there would be too many
    subroutine cut_zones(ground, around, zones, cut, parts, factor)
        !> The beam as its motions feel it, and as it stands, in whose fields curves are taken for straight
        type(ground_type), intent(in) :: ground, around
        type(zones_type), intent(in) :: zones
        type(zones_type), intent(out) :: cut
        integer, intent(in), optional :: parts
        !> As for count_modes
        real(wp), intent(in), optional :: factor
        type(stretch_type) :: stretch
        type(stretch_load_type) :: dead, live
        type(curved_type) :: curved
        real(wp) :: steps(size(zones%piece))
        integer :: i, k, m
        logical :: lost

        do i = 1, size(zones%piece)
            call stretch_on_layers(ground, zones, i, stretch, dead, live)
            steps(i) = 1.0_wp
            if (present(parts)) steps(i) = parts
            if (stretch%tension < 0.0_wp .or. abs(stretch%tension_change) > 0.0_wp &
                .or. min(stretch%modulus_a, stretch%modulus_b) < 0.0_wp &
                .or. abs(stretch%modulus_a - stretch%modulus_b) > 0.0_wp) steps(i) = max(steps(i), decay_lengths(stretch))
        end do
        if (.not. sum(steps) <= real(most_mode_stretches, wp)) then
            call new_zones(0, size(zones%acts, 1), zones%steps, cut)
            return
        end if
        call new_zones(sum(ceiling(steps)), size(zones%acts, 1), zones%steps, cut)
        if (allocated(zones%pushed)) then
            allocate (cut%pushed(0:size(cut%piece)), source=.false.)
            cut%pushed([0, (sum(ceiling(steps(:i))), i=1, size(steps))]) = zones%pushed
        end if
        m = 0
        do i = 1, size(zones%piece)
            if (present(factor) .and. steps(i) > 1.0_wp) call curved_stretch(around, zones, factor, i, curved)
            do k = 1, ceiling(steps(i))
                m = m + 1
                cut%piece(m) = zones%piece(i)
                cut%from(m) = between(zones%from(i), zones%to(i), k - 1, ceiling(steps(i)))
                cut%to(m) = between(zones%from(i), zones%to(i), k, ceiling(steps(i)))
                cut%acts(:, m) = zones%acts(:, i)
                cut%start(:, m) = zones%start(:, i)
                if (k == 1 .or. .not. allocated(curved%curves)) cycle
                call advance_curved(curved, 0.0_wp, curved%left, real(k - 1, wp)/ceiling(steps(i)), cut%start(:, m), lost)
            end do
        end do
    end subroutine cut_zones

    !> How the beam moves in a mode: what small forces near its value do (inverse iteration)
    subroutine find_mode_shape(ground, zones, acting, factor, what, value, parts, shape)
        !> As for count_modes
        type(ground_type), intent(in) :: ground
        type(zones_type), intent(in) :: zones
        logical, intent(in) :: acting(:)
        real(wp), intent(in) :: factor
        integer, intent(in) :: what
        !> Value of the mode, to rounding
        real(wp), intent(in) :: value
        !> Stretches between places at least, of every zone; fewer where beams have so many that there would be no end
        integer, intent(in) :: parts
        type(mode_shape_type), intent(out) :: shape
        type(workspace_type) :: work
        type(grounded_type) :: grounded
        integer :: number, i, n, round, largest, cut

        cut = max(1, min(parts, most_mode_stretches/(2*size(zones%piece))))
        call count_modes(ground, zones, acting, what, value, number, work, grounded, cut, factor)
        if (number < 0) call count_modes(ground, zones, acting, what, value*(1 + 64*epsilon(value)), number, work, grounded, cut, &
                                         factor)
        n = -1
        if (number >= 0) n = size(grounded%stretches)
        allocate (shape%piece(n + 1), shape%distance(n + 1), shape%deflection(n + 1), shape%moment(2, n + 1))
        if (number < 0) return
        ! Forces that no mode is without work of
        do i = 0, n
            work%rhs(i)%shear = 1 + modulo(i*0.6180339887498949_wp, 1.0_wp)
        end do
        do round = 1, 3
            do i = 0, n
                work%rhs(i)%left = 0.0_wp
                work%rhs(i)%right = 0.0_wp
                work%rhs(i)%couple = 0.0_wp
                work%rhs(i)%moment = 0.0_wp
                work%rhs(i)%deflection = 0.0_wp
            end do
            call solve_foundation_chain(work%nodes(0:n), grounded%beam%ground, grounded%beam%links%length, work%pivots, &
                                        work%rhs(0:n), work%eliminated, work%answers(0:n))
            largest = maxloc(abs(work%answers(0:n)%deflection), 1) - 1
            work%rhs(0:n)%shear = work%answers(0:n)%deflection/abs(work%answers(largest)%deflection)
        end do
        associate (scale => 1/work%answers(largest)%deflection, node => grounded%node, piece => shape%piece, &
                   distance => shape%distance)
            shape%deflection(:) = scale*work%answers(0:n)%deflection
            shape%moment(1, :) = scale*work%answers(0:n)%moment_left
            shape%moment(2, :) = scale*work%answers(0:n)%moment_right
            piece(1) = 1
            distance(1) = 0.0_wp
            n = 1
            do i = 1, size(grounded%stretches)
                if (i > node(n)) n = n + 1
                piece(i + 1) = n
                distance(i + 1) = grounded%stretches(i)%length
                if (piece(i) == n .and. i > 1) distance(i + 1) = distance(i + 1) + distance(i)
            end do
            ! Supports push from where they stand now
            grounded%beam%supports%contact = 0.0_wp
            call complete_scheme(grounded%beam, acting, work)
            allocate (shape%at_nodes(0:last_place(ground%beam)))
            n = ubound(node, 1)
            shape%at_nodes(0:n) = scale*work%answers(node)%deflection
            shape%at_nodes(n + 1:) = scale*work%answers(size(grounded%stretches) + 1:)%deflection
            shape%reaction = scale*work%reaction(:size(acting))
        end associate
    end subroutine find_mode_shape

end module gapbeam_modes
