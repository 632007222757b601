!> Solutions of the contact states of eight cases, refined once, with reactions and doubts.
module gapbeam_lane_finish
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, link_numbers, lane_beam_type, pack_type, by_both_ends, by_three_moments
    use gapbeam_lane_stiffness, only: stiffness_lanes
    use gapbeam_lane_sweeps, only: sweep_three_moments, sweep_chain
    use gapbeam_lane_two_sided_sweep, only: pass_both_ends, correct_both_ends
    use gapbeam_lane_residual, only: find_rests
    use gapbeam_lane_reactions, only: complete, doubt_corrections
    use gapbeam_lane_search, only: apply_scheme
    implicit none
    private
    public :: finish_pack

contains

    !> Moments right of the nodes, where there are no couples
    pure subroutine copy_moments(n, ml, mr)
        integer, intent(in) :: n
        real(wp), intent(inout) :: ml(lanes, 0:n)
        real(wp), intent(out) :: mr(lanes, 0:n)

        mr(:, :) = ml
        ml(:, 0) = 0.0_wp
        mr(:, n) = 0.0_wp
    end subroutine copy_moments

    !> Solve contact states as gapbeam_system does, refine the solutions once, and find reactions
    subroutine finish_pack(beam, method, pack, doubtful)
        type(lane_beam_type), intent(in) :: beam
        !> How all of them are to be solved, not 0
        integer, intent(in) :: method
        !> Loads, supports and schemes in, solutions out
        type(pack_type), intent(inout) :: pack
        !> In which cases the scheme moves, a sign is wrong or within its rounding error, digits are lost, or numbers are not finite
        logical, intent(out) :: doubtful(lanes)
        real(wp) :: doubt(lanes), moves(lanes)
        integer :: n

        n = beam%n
        moves(:) = 0.0_wp
        if (.not. pack%is_solved) then
            call apply_scheme(n, pack%shear, pack%stiffness, pack%rigid, pack%contact, pack%closed, pack%held, pack%known, &
                              pack%spring, pack%force)
            if (method == by_both_ends) then
                pack%turn(:, :) = pack%left + pack%right
                pack%turn_rest(:, :) = 0.0_wp   ! no support is to be changed
                call pass_both_ends(beam, pack%links, n, pack%turn, pack%shear, pack%stiffness, pack%rigid, pack%contact, &
                                    pack%turn_rest, pack%closed, pack%room, pack%w, pack%ml)
            else
                call solve(beam, pack%links, n, method, pack%left, pack%right, pack%force, pack%couple, pack%held, pack%known, &
                           pack%spring, pack%room, pack%turning, pack%w, pack%ml, pack%mr, moves)
            end if
        end if
        if (method == by_both_ends) call copy_moments(n, pack%ml, pack%mr)
        call find_rests(beam, pack)
        if (method == by_both_ends) then
            if (beam%restraint(n) > 0) pack%turn_rest(:, n) = pack%turn_rest(:, n) + pack%left_rest(:, n)
            call correct_both_ends(beam, pack%links, n, pack%turn_rest, pack%force_rest, pack%held, pack%known_rest, pack%room, &
                                   pack%dw, pack%dl)
            call copy_moments(n, pack%dl, pack%dr)
        else
            call solve(beam, pack%links, n, method, pack%left_rest, pack%turn_rest, pack%force_rest, pack%spare, pack%held, &
                       pack%known_rest, pack%spring, pack%room, pack%turning, pack%dw, pack%dl, pack%dr, moves)
        end if
        call add_correction(n, pack%dw, pack%dl, pack%dr, pack%w, pack%ml, pack%mr)
        call complete(beam, n, pack, doubt)
        call doubt_corrections(n, pack%w, pack%dw, pack%room, doubt)
        doubtful = doubt + moves > 0.5_wp
    end subroutine finish_pack

    !> The ways but that from both ends
    pure subroutine solve(beam, links, n, method, left, right, force, couple, held, known, spring, room, turning, w, ml, mr, &
                          moves)
        type(lane_beam_type), intent(in) :: beam
        integer, intent(in) :: n, method
        !> Numbers of the links (pack_type)
        real(wp), intent(in) :: links(stiffness_lanes, link_numbers, n)
        real(wp), intent(in), dimension(lanes, 0:n) :: left, right, force, couple, held, known, spring
        real(wp), intent(inout), dimension(lanes, 0:n) :: w, ml, mr
        real(wp), intent(inout) :: room(lanes, 0:n, 10), turning(lanes, size(beam%restrained), 5)
        !> 1 for mechanisms
        real(wp), intent(out) :: moves(lanes)

        moves(:) = 0.0_wp
        if (method == by_three_moments) then
            call sweep_three_moments(beam, links, n, left, right, force, couple, held, known, room, w, ml, mr)
        else
            call sweep_chain(beam, links, n, left, right, force, couple, held, known, spring, room, turning, w, ml, mr, moves)
        end if
    end subroutine solve

    !> Solutions refined
    pure subroutine add_correction(n, dw, dl, dr, w, ml, mr)
        integer, intent(in) :: n
        real(wp), intent(in), dimension(lanes, 0:n) :: dw, dl, dr
        real(wp), intent(inout), dimension(lanes, 0:n) :: w, ml, mr

        w(:, :) = w + dw
        ml(:, :) = ml + dl
        mr(:, :) = mr + dr
    end subroutine add_correction

end module gapbeam_lane_finish
