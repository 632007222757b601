!> Links of eight cases whose spans have other stiffnesses, with loads of factor 1.
!> That is condense_link of gapbeam_link side by side, number by number.
module gapbeam_lane_links
    use gapbeam_kinds, only: wp
    use gapbeam_lane_types, only: lanes, lane_spans_type, link_numbers, link_faa, link_fab, link_fbb, link_sum_a, link_sum_b, &
        link_bending, link_determinant, link_fixity, link_reach
    implicit none
    private
    public :: make_links

    !> Place of the elastic centre along a prismatic piece, and its spread (gapbeam_link)
    real(wp), parameter :: centre = 0.5_wp, spread = 1.0_wp/12.0_wp

contains

    !> Make them
    pure subroutine make_links(spans, length, stiffness, flexibility, shear_flexibility, links, to_link)
        type(lane_spans_type), intent(in) :: spans
        !> Lengths of the links, shape (n)
        real(wp), intent(in), contiguous :: length(:)
        !> EI and GA of the spans, shape (lanes, 2, nspan)
        real(wp), intent(in), contiguous :: stiffness(:, :, :)
        !> 1/EI and 1/GA of the pieces in the engine's units, shape (lanes, npiece)
        real(wp), intent(inout), contiguous :: flexibility(:, :), shear_flexibility(:, :)
        !> As in pack_type and in lane_beam_type
        real(wp), intent(inout), contiguous :: links(:, :, :), to_link(:, :, :)
        integer :: i, j, k, first

        do j = 1, size(spans%length)
            call invert(spans%span(1, j), spans%power(1), spans%own(1, j), stiffness(:, 1, max(spans%span(1, j), 1)), &
                        flexibility(:, j))
            call invert(spans%span(2, j), spans%power(2), spans%own(2, j), stiffness(:, 2, max(spans%span(2, j), 1)), &
                        shear_flexibility(:, j))
        end do
        do i = 1, size(links, 3)
            first = spans%last(i - 1) + 1
            j = spans%last(i)
            if (first == j) then
                call condense(spans%length(j), flexibility(:, j), shear_flexibility(:, j), links(:, :, i))
            else
                call condense_pieces(length(i), spans%length(first:j), spans%before(first:j), flexibility(:, first:j), &
                                     shear_flexibility(:, first:j), links(:, :, i))
            end if
        end do
        do k = 1, size(to_link, 3)
            i = spans%link(k)
            first = spans%last(i - 1) + 1
            j = spans%last(i)
            associate (terms => spans%terms(:, spans%last_term(k - 1) + 1:spans%last_term(k)))
                if (first == j) then
                    call load(terms(:, 1), spans%sizes(:, k), flexibility(:, j), links(:, link_bending, i), to_link(:, :, k))
                else
                    call load_pieces(terms, spans%sizes(:, k), length(i), flexibility(:, first:j), &
                                     shear_flexibility(:, first:j), links(:, :, i), to_link(:, :, k))
                end if
            end associate
        end do
    end subroutine make_links

    !> Flexibility of a piece
    pure subroutine invert(span, power, own, stiffness, flexibility)
        !> Whose stiffness it has, 0: its own
        integer, intent(in) :: span
        !> To the engine's units; its own flexibility
        real(wp), intent(in) :: power, own
        real(wp), intent(in) :: stiffness(lanes)
        real(wp), intent(out) :: flexibility(lanes)

        if (span == 0) then
            flexibility(:) = own
        else
            flexibility(:) = 1/(stiffness*power)
        end if
    end subroutine invert

    !> Numbers of a link of one piece
    pure subroutine condense(length, flexibility, shear_flexibility, link)
        real(wp), intent(in) :: length, flexibility(lanes), shear_flexibility(lanes)
        real(wp), intent(inout) :: link(lanes, link_numbers)
        real(wp) :: m, shear, none, both
        integer :: l

        !$omp simd private(m, shear, none, both)
        do l = 1, lanes
            m = flexibility(l)*length
            shear = shear_flexibility(l)/length
            link(l, link_bending) = m
            call condense_centre(m, centre, spread, shear, link(l, link_sum_a), link(l, link_sum_b), link(l, link_faa), &
                                 link(l, link_fab), link(l, link_fbb), link(l, link_determinant))
            none = merge(0.0_wp, 1.0_wp, m > 0.0_wp)
            link(l, link_fixity) = (1.0_wp - none)/(m + none)
            both = link(l, link_faa) + link(l, link_fbb)
            link(l, link_reach) = merge(m, both, m > both)*length
        end do
    end subroutine condense

    !> Numbers of a link of several pieces: condense_flexibility
    pure subroutine condense_pieces(whole, length, before, flexibility, shear_flexibility, link)
        !> Length of the link
        real(wp), intent(in) :: whole
        !> Of the pieces, shape (n) and (lanes, n)
        real(wp), intent(in), contiguous :: length(:), before(:), flexibility(:, :), shear_flexibility(:, :)
        real(wp), intent(inout) :: link(lanes, link_numbers)
        real(wp), dimension(lanes) :: bending, bending_low, first, first_low, slip, slip_low, second, second_low, centres
        real(wp) :: m, shear, none, middle, spreading, both, x, p
        integer :: j, l

        bending(:) = 0.0_wp
        bending_low(:) = 0.0_wp
        first(:) = 0.0_wp
        first_low(:) = 0.0_wp
        slip(:) = 0.0_wp
        slip_low(:) = 0.0_wp
        second(:) = 0.0_wp
        second_low(:) = 0.0_wp
        do j = 1, size(length)
            p = length(j)
            x = before(j) + p/2
            !$omp simd private(m)
            do l = 1, lanes
                m = flexibility(l, j)*p
                call add(bending(l), bending_low(l), m)
                call add(first(l), first_low(l), m*x)
                call add(slip(l), slip_low(l), shear_flexibility(l, j)*p)
            end do
        end do
        !$omp simd private(m, none, middle)
        do l = 1, lanes
            m = bending(l) + bending_low(l)
            none = merge(0.0_wp, 1.0_wp, m > 0.0_wp)
            middle = (first(l) + first_low(l))/(m + none)
            centres(l) = merge(middle, centre, m > 0.0_wp)
        end do
        do j = 1, size(length)
            p = length(j)
            x = before(j) + p/2
            call add(second, second_low, flexibility(:, j)*p*((x - centres)**2 + p**2/12))
        end do
        !$omp simd private(m, shear, none, middle, spreading, both)
        do l = 1, lanes
            m = bending(l) + bending_low(l)
            none = merge(0.0_wp, 1.0_wp, m > 0.0_wp)
            middle = centres(l)/whole
            spreading = (second(l) + second_low(l))/(m + none)/whole**2
            shear = (slip(l) + slip_low(l))/whole**2
            link(l, link_bending) = m
            call condense_centre(m, middle, spreading, shear, link(l, link_sum_a), link(l, link_sum_b), link(l, link_faa), &
                                 link(l, link_fab), link(l, link_fbb), link(l, link_determinant))
            link(l, link_fixity) = (1.0_wp - none)/(m + none)
            both = link(l, link_faa) + link(l, link_fbb)
            link(l, link_reach) = merge(m, both, m > both)*whole
        end do
    end subroutine condense_pieces

    !> What a load does to a link of one piece: condense_load
    pure subroutine load(terms, sizes, flexibility, bending, to_link)
        !> As in lane_spans_type
        real(wp), intent(in) :: terms(10), sizes(2), flexibility(lanes), bending(lanes)
        real(wp), intent(inout) :: to_link(lanes, 6)

        to_link(:, 1) = 0.0_wp + (flexibility*terms(1) - terms(3))
        to_link(:, 2) = 0.0_wp + (flexibility*terms(2) - terms(3))
        to_link(:, 6) = sizes(1) + bending*sizes(2)
    end subroutine load

    !> What a load does to a link of several pieces: condense_loads
    pure subroutine load_pieces(terms, sizes, whole, flexibility, shear_flexibility, link, to_link)
        !> As in lane_spans_type, shape (10, n); length of the link
        real(wp), intent(in), contiguous :: terms(:, :)
        real(wp), intent(in) :: sizes(2), whole
        !> Of the pieces, shape (lanes, n)
        real(wp), intent(in), contiguous :: flexibility(:, :), shear_flexibility(:, :)
        real(wp), intent(in) :: link(lanes, link_numbers)
        real(wp), intent(inout) :: to_link(lanes, 6)
        real(wp), dimension(lanes) :: turn_a, turn_a_low, turn_b, turn_b_low, slip, slip_low, slips
        real(wp) :: turning, softer, m, none, d, less
        integer :: j, l

        turn_a(:) = 0.0_wp
        turn_a_low(:) = 0.0_wp
        turn_b(:) = 0.0_wp
        turn_b_low(:) = 0.0_wp
        slip(:) = 0.0_wp
        slip_low(:) = 0.0_wp
        slips(:) = 0.0_wp
        do j = 1, size(terms, 2)
            !$omp simd private(turning, softer)
            do l = 1, lanes
                turning = flexibility(l, j)*terms(1, j) - terms(3, j)
                call add(turn_a(l), turn_a_low(l), terms(4, j)*turning)
                call add(turn_b(l), turn_b_low(l), terms(5, j)*turning)
                turning = flexibility(l, j)*terms(2, j) - terms(3, j)
                call add(turn_a(l), turn_a_low(l), terms(6, j)*turning)
                call add(turn_b(l), turn_b_low(l), terms(7, j)*turning)
                softer = shear_flexibility(l, j) - shear_flexibility(l, 1)
                call add(slip(l), slip_low(l), softer*terms(8, j))
                slips(l) = slips(l) + abs(softer)*terms(9, j)
                call add(slip(l), slip_low(l), -shear_flexibility(l, 1)*terms(10, j))
                slips(l) = slips(l) + shear_flexibility(l, 1)*abs(terms(10, j))
            end do
        end do
        !$omp simd private(m, none, d, less)
        do l = 1, lanes
            m = link(l, link_bending)
            d = link(l, link_determinant)
            none = merge(0.0_wp, 1.0_wp, d > 0.0_wp)
            slips(l) = slips(l)/whole
            less = slips(l)*m*(m/(d + none)) + none*slips(l)
            slips(l) = merge(less, slips(l), less < slips(l))
            to_link(l, 1) = (turn_a(l) + turn_a_low(l)) - (slip(l) + slip_low(l))/whole
            to_link(l, 2) = (turn_b(l) + turn_b_low(l)) + (slip(l) + slip_low(l))/whole
            to_link(l, 6) = sizes(1) + m*sizes(2) + slips(l)
        end do
    end subroutine load_pieces

    include 'beam/elastic_centre.inc'
    include 'elimination/add.inc'

end module gapbeam_lane_links
