!> Beams for unit tests: one piece a link, and what their links are made of, so that they can be condensed again in
!> quadruple precision. Keep them in variables with the target attribute.
module beams
    use, intrinsic :: iso_fortran_env, only: int64
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use gapbeam_kinds, only: wp
    use gapbeam_link, only: piece_type, piece_load_type, condense_link
    use gapbeam_model, only: beam_type, node_support_type, order_supports
    use gapbeam_refined, only: detail_type
    implicit none
    private
    public :: sample_type, make_beam, detail_of, draw, draw_magnitude, infinite

    !> A beam and what its links are made of
    type :: sample_type
        !> The beam
        type(beam_type) :: beam
        !> Pieces, their dead and live loads, and the last piece of every link, shape (n)
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: dead(:), live(:)
        integer, allocatable :: last(:)
    end type sample_type

contains

    !> A beam of prismatic spans
    subroutine make_beam(length, ei, dead, live, supports, sample)
        !> Length and bending stiffness of every span, shape (n)
        real(wp), intent(in) :: length(:), ei(:)
        !> Dead and live load per length of every span, shape (n)
        real(wp), intent(in) :: dead(:), live(:)
        !> The supports
        type(node_support_type), intent(in) :: supports(:)
        !> The beam, without forces and couples
        type(sample_type), intent(out) :: sample
        real(wp) :: work(1)
        integer :: i, n

        n = size(length)
        allocate (sample%pieces(n), sample%dead(n), sample%live(n), sample%last(n))
        associate (beam => sample%beam)
            allocate (beam%links(n), beam%kind(0:n), beam%compliance(0:n), beam%force(2, 0:n), beam%couple(2, 0:n))
            beam%kind(:) = 0
            beam%compliance(:) = 0.0_wp
            beam%force(:, :) = 0.0_wp
            beam%couple(:, :) = 0.0_wp
            do i = 1, n
                sample%pieces(i) = piece_type(length(i), 1/ei(i), 0.0_wp)
                sample%dead(i) = piece_load_type(dead(i), dead(i), 0, 0, 0)
                sample%live(i) = piece_load_type(live(i), live(i), 0, 0, 0)
                sample%last(i) = i
                call condense_link(sample%pieces(i:i), sample%dead(i:i), sample%live(i:i), work, beam%links(i))
            end do
            call order_supports(supports, beam)
        end associate
    end subroutine make_beam

    !> What the links of a beam are made of
    function detail_of(sample) result(detail)
        !> The beam
        type(sample_type), intent(in), target :: sample
        type(detail_type) :: detail

        detail%pieces => sample%pieces
        detail%dead => sample%dead
        detail%live => sample%live
        detail%last => sample%last
    end function detail_of

    !> A reproducible number between 0 and 1 (Park and Miller 1988)
    function draw(seed) result(number)
        !> Between 1 and 2**31 - 2; the next one out
        integer, intent(inout) :: seed
        real(wp) :: number

        seed = int(modulo(48271_int64*seed, 2147483647_int64))
        number = real(seed, wp)/2147483647.0_wp
    end function draw

    !> A positive number of any magnitude between two powers of ten
    function draw_magnitude(seed, low, high) result(number)
        !> As for draw
        integer, intent(inout) :: seed
        !> Exponents
        real(wp), intent(in) :: low, high
        real(wp) :: number

        number = 10.0_wp**(low + (high - low)*draw(seed))
    end function draw_magnitude

    !> Infinity without an exception
    pure function infinite() result(value)
        real(wp) :: value

        value = ieee_value(value, ieee_positive_inf)
    end function infinite

end module beams
