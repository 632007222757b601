!> Links of cases whose spans have stiffnesses of their own (gapbeam_lane_links).
module gapbeam_lane_spans
    use gapbeam_kinds, only: wp
    use gapbeam_limits, only: most_stiffness_power, most_stiffness_unit, most_load_terms
    use gapbeam_tolerances, only: proximal_ratio
    use gapbeam_element, only: moment_integrals
    use gapbeam_link, only: piece_type, piece_load_type, along_type, next_piece, moments_about_right_end, no_load
    use gapbeam_law_adapters, only: least_stiffness
    use gapbeam_units, only: turning_unit, rotation_unit
    use gapbeam_assembled_model, only: assembled_type, in_bending, in_shear
    use gapbeam_cases, only: case_loads_type
    use gapbeam_lane_types, only: lanes, lane_pieces_type, lane_spans_type
    use gapbeam_lane_pieces, only: prepare_pieces
    implicit none
    private
    public :: span_room_type, fits_spans, prepare_spans, take_spans, proximal_weight_of

    !> What eight cases with spans of their own need
    type :: span_room_type
        type(lane_spans_type) :: spans
        !> EI and GA of the spans in the scene's units, shape (lanes, 2, nspan)
        real(wp), allocatable :: stiffness(:, :, :)
        !> 1/EI and 1/GA of the pieces, shape (lanes, npiece)
        real(wp), allocatable :: flexibility(:, :), shear_flexibility(:, :)
    end type span_room_type

contains

    !> Are loads on links of many pieces so few that lanes hold them
    pure function fits_spans(assembled, loads) result(fits)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        logical :: fits

        fits = terms_of(assembled, loads) <= most_load_terms
    end function fits_spans

    !> Pieces of links times loads on them, not much above most_terms
    pure function terms_of(assembled, loads) result(number)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        integer :: number, k

        number = 0
        do k = 1, size(loads%of_links)
            associate (i => loads%of_links(k)%link)
                number = number + assembled%node_point(i) - assembled%node_point(i - 1)
            end associate
            if (number > most_load_terms) return
        end do
    end function terms_of

    !> What does not differ from case to case
    subroutine prepare_spans(assembled, loads, room, made)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        type(span_room_type), intent(out) :: room
        !> False where memory ends
        logical, intent(out) :: made
        type(lane_pieces_type) :: pieces
        integer :: j, m, n, stat, powers(2)

        call prepare_pieces(assembled, 1, pieces, made)
        if (.not. made) return
        n = size(assembled%pieces)
        m = size(loads%of_links)
        associate (spans => room%spans, units => assembled%units)
            allocate (spans%span(2, n), spans%own(2, n), spans%last(0:size(assembled%beam%links)), spans%length(n), &
                      spans%before(n), spans%link(m), spans%last_term(0:m), spans%sizes(2, m), &
                      spans%terms(10, terms_of(assembled, loads)), room%stiffness(lanes, 2, size(assembled%model%spans)), &
                      room%flexibility(lanes, n), room%shear_flexibility(lanes, n), stat=stat)
            made = stat == 0
            if (.not. made) return
            powers = [turning_unit(units) + units%length, units%force - rotation_unit(units)]
            if (all(abs(powers) < most_stiffness_unit)) then
                spans%power = scale(1.0_wp, -powers)
                spans%least = scale(1.0_wp, powers - most_stiffness_power)
                spans%most = scale(1.0_wp, powers + most_stiffness_power)
            end if
            spans%softest = least_stiffness(assembled%beam%supports, size(assembled%beam%links))
            spans%last(:) = pieces%last
            spans%length(:) = pieces%length
            spans%before(:) = pieces%before
            do j = 1, n
                spans%span(:, j) = assembled%point_span(j - 1) + 1
                if (allocated(assembled%section_of)) then
                    if (assembled%section_of(in_bending, j) > 0) spans%span(1, j) = 0
                    if (assembled%section_of(in_shear, j) > 0) spans%span(2, j) = 0
                end if
                spans%own(:, j) = [assembled%pieces(j)%flexibility, assembled%pieces(j)%shear_flexibility]
            end do
            spans%link(:) = loads%of_links%link
        end associate
        call prepare_loads(assembled, loads, pieces, room%spans, made)
    end subroutine prepare_spans

    !> What loads do to links, whatever the stiffnesses
    subroutine prepare_loads(assembled, loads, pieces, spans, made)
        type(assembled_type), intent(in) :: assembled
        type(case_loads_type), intent(in) :: loads
        !> With the loads on them in the order of loads
        type(lane_pieces_type), intent(in) :: pieces
        type(lane_spans_type), intent(inout) :: spans
        !> False where memory ends
        logical, intent(out) :: made
        type(piece_load_type), allocatable :: on_link(:)
        real(wp), allocatable :: work(:)
        integer :: j, k, stat

        allocate (on_link(size(spans%length)), work(size(spans%length)), stat=stat)
        made = stat == 0
        if (.not. made) return
        on_link(:) = no_load
        spans%last_term(0) = 0
        j = 0
        do k = 1, size(spans%link)
            associate (first => spans%last(spans%link(k) - 1) + 1, last => spans%last(spans%link(k)), &
                       before => spans%last_term(k - 1))
                do while (j < size(pieces%load))
                    if (pieces%load(j + 1) /= loads%of_links(k)%load .or. pieces%piece(j + 1) > last) exit
                    j = j + 1
                    associate (q => pieces%to_piece(:, j))
                        on_link(pieces%piece(j)) = piece_load_type(q(1), q(2), q(3), q(4), q(5))
                    end associate
                end do
                spans%last_term(k) = before + (last - first + 1)
                if (first == last) then
                    associate (l => spans%length(first), q => on_link(first), terms => spans%terms(:, before + 1))
                        terms(:) = 0.0_wp
                        call moment_integrals(l, 0.0_wp, 0.0_wp, q%qa, q%qb, terms(1), terms(2))
                        terms(3) = q%kappa*l/2
                        spans%sizes(:, k) = [abs(q%kappa)*l, (abs(q%qa) + abs(q%qb))*l*(l*l/l)]
                    end associate
                else
                    call go_along(assembled%beam%links(spans%link(k))%length, assembled%pieces(first:last), on_link(first:last), &
                                  work, spans%terms(:, before + 1:spans%last_term(k)), spans%sizes(:, k))
                end if
                on_link(first:last) = no_load
            end associate
        end do
    end subroutine prepare_loads

    !> Terms of a load on a link of several pieces, as condense_loads of gapbeam_link has them
    pure subroutine go_along(whole, pieces, loads, work, terms, sizes)
        !> Length of the link
        real(wp), intent(in) :: whole
        !> Pieces, and the load on them, shape (n)
        type(piece_type), intent(in) :: pieces(:)
        type(piece_load_type), intent(in) :: loads(:)
        !> Shape (at least n)
        real(wp), intent(inout) :: work(:)
        !> As in lane_spans_type
        real(wp), intent(out) :: terms(:, :), sizes(:)
        type(along_type) :: at
        real(wp) :: right_end
        integer :: j, n

        n = size(loads)
        call moments_about_right_end(pieces, loads, work, right_end)
        sizes(1) = 0.0_wp
        do j = 1, n
            call next_piece(pieces(j)%length, loads(j), whole, merge(right_end, work(max(1, j - 1)), j == 1), work(j), j == n, at)
            terms(:, j) = [at%left, at%right, loads(j)%kappa*pieces(j)%length/2, 1 - at%x0/whole, at%x0/whole, 1 - at%x1/whole, &
                           at%x1/whole, at%m1 - at%m0, abs(at%m0) + abs(at%m1), merge(0.0_wp, loads(j)%couple, j == n)]
            sizes(1) = sizes(1) + abs(loads(j)%kappa)*pieces(j)%length
        end do
        sizes(2) = at%peaks
    end subroutine go_along

    !> Take the stiffnesses of a case
    pure subroutine take_spans(given, l, room, outside)
        !> EI and GA of every span, shape (2, at least nspan)
        real(wp), intent(in) :: given(:, :)
        !> Its lane
        integer, intent(in) :: l
        type(span_room_type), intent(inout) :: room
        !> Some are rigid or too far from the others for what is made of them here; they are replaced
        logical, intent(out) :: outside
        integer :: i
        logical :: fits

        outside = .false.
        associate (least => room%spans%least, most => room%spans%most)
            do i = 1, size(room%stiffness, 3)
                fits = given(1, i) >= least(1) .and. given(1, i) <= most(1) .and. given(2, i) >= least(2) &
                    .and. (given(2, i) <= most(2) .or. given(2, i) > huge(1.0_wp))
                outside = outside .or. .not. fits
                room%stiffness(l, :, i) = given(:, i)
                if (.not. fits) room%stiffness(l, :, i) = 1/room%spans%power
            end do
        end associate
    end subroutine take_spans

    !> Stiffness of the weak springs of a case: softest of gapbeam_model
    pure function proximal_weight_of(softest, bending, length, n) result(proximal_weight)
        !> Of the supports; of the beam: flexibility, length, links
        real(wp), intent(in) :: softest, bending, length
        integer, intent(in) :: n
        real(wp) :: proximal_weight

        proximal_weight = softest
        if (bending > 0.0_wp) proximal_weight = min(proximal_weight, 1/(bending*length**2))
        if (.not. proximal_weight < huge(proximal_weight)) proximal_weight = 1.0_wp
        proximal_weight = proximal_ratio*(proximal_weight/(n + 1))
    end function proximal_weight_of

end module gapbeam_lane_spans
