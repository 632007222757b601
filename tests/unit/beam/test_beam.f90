!> Inside a beam: what left the range of doubles, fields of the pieces, their extremes
program test_beam
    use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type
    use gapbeam_memory, only: enough_memory, reserve_memory, for_solving, for_fields
    use gapbeam_element, only: field_type
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_band, only: hinge
    use gapbeam_range, only: is_lost, first_lost_link
    use gapbeam_recover, only: recover_beam
    use gapbeam_quantities, only: bending, bending_count, of_moment, of_curvature
    use gapbeam_fields, only: values_at, find_extremes
    implicit none
    integer :: status

    call memory_for_little()
    call lost_numbers()
    call lost_links()
    call simple_beam()
    call rotation_through_a_node()
    call extremes_of_nothing()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> There is memory for a small beam; that there may be none for a large one, tests/languages/test_memory.c shows
    subroutine memory_for_little()
        type(error_type), allocatable :: error

        call check(enough_memory(for_solving, 0, 0, 0), "nothing takes little")
        call reserve_memory(for_fields, 10, 10, 10, error)
        call check(.not. allocated(error), "ten links as well")
    end subroutine memory_for_little

    !> Numbers that have not all their digits
    subroutine lost_numbers()
        real(wp) :: values(6)

        values = [0.0_wp, -1.0_wp, tiny(1.0_wp)/2, tiny(1.0_wp), huge(1.0_wp), ieee_value(1.0_wp, ieee_positive_inf)]
        call check(all(is_lost(values) .eqv. [.true., .true., .true., .false., .false., .true.]), "zero, below, denormal, infinite")
    end subroutine lost_numbers

    !> Links that have none
    subroutine lost_links()
        type(link_type) :: links(2)
        type(piece_type) :: pieces(2)
        type(piece_load_type) :: none(2)
        real(wp) :: work(1)
        integer :: i

        none = piece_load_type(0, 0, 0, 0, 0)
        pieces = [piece_type(2.0_wp, 0.1_wp, 0.0_wp), piece_type(2.0_wp, 1e-160_wp, 0.0_wp)]
        do i = 1, 2
            call condense_link(pieces(i:i), none(i:i), none(i:i), work, links(i))
        end do
        call check(first_lost_link(pieces, links, [1, 2]) == 2, "the determinant of the second is denormal")
        pieces(2)%flexibility = 0.0_wp
        call condense_link(pieces(2:2), none(2:2), none(2:2), work, links(2))
        call check(first_lost_link(pieces, links, [1, 2]) == 0, "zero where a piece is rigid is right")
        links(1)%turn_a(2) = ieee_value(1.0_wp, ieee_positive_inf)
        call check(first_lost_link(pieces, links, [1, 2]) == -1, "loads of the first are no numbers")
        links(2)%inverse = 0.0_wp
        call check(first_lost_link(pieces, links, [1, 2]) == 2, "links before loads")
    end subroutine lost_links

    !> q L**3/24 EI, 5 q L**4/384 EI, q L**2/8; in two pieces
    subroutine simple_beam()
        type(piece_type) :: pieces(2)
        type(piece_load_type) :: dead(2), live(2)
        type(link_type) :: links(1)
        type(field_type) :: starts(2), fields(3)
        real(wp) :: work(2), values(2, bending_count), distance(2, bending_count)
        integer :: piece(2, bending_count)
        integer, parameter :: at_curvature = findloc(bending, of_curvature, 1)
        real(wp), parameter :: l = 4.0_wp, f = 0.125_wp, q = 3.0_wp

        pieces = [piece_type(1.0_wp, f, 0.0_wp), piece_type(3.0_wp, f, 0.0_wp)]
        dead = piece_load_type(1, 1, 0, 0, 0)
        live = piece_load_type(1, 1, 0, 0, 0)
        call condense_link(pieces, dead, live, work, links(1))
        call recover_beam(pieces, dead, live, 2.0_wp, links, [2], [0, 0], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], &
                          [0.0_wp], starts)
        call check_close(starts%rotation, q*f*[l**3/24, l**3/24 - l/4 + 1/6.0_wp], "rotations at the pieces' left ends")
        call check_close(starts%moment, q*[0.0_wp, 1.5_wp], "moments")
        call check_close(starts%shear, q*[2.0_wp, 1.0_wp], "shears")
        call values_at(pieces, dead, live, 2.0_wp, starts, [1, 2, 2], [0.0_wp, 1.0_wp, 3.0_wp], fields)
        call check_close(fields%deflection, q*f*[0.0_wp, 5*l**4/384, 0.0_wp], "deflections", absolute=1e-14_wp)
        call check_close(fields%moment, q*[0.0_wp, l**2/8, 0.0_wp], "moments", absolute=1e-14_wp)
        call values_at(pieces, dead, live, 2.0_wp, starts, [integer ::], [real(wp) ::], fields(:0))
        call find_extremes(pieces, dead, live, 2.0_wp, starts, values, piece, distance)
        call check_close(values(1, :), q*[f*5*l**4/384, f*l**3/24, l**2/8, l/2, f*l**2/8], "maxima")
        call check_close(values(2, 2:5), q*[-f*l**3/24, 0.0_wp, -l/2, 0.0_wp], "minima", absolute=1e-14_wp)
        call check(all(piece(1, :) == [2, 1, 2, 1, 2]), "pieces of the maxima")
        call check_close(distance(1, :), [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp], "and where in them", absolute=1e-7_wp)
        ! Softer on the left, and bent by more than the load bends it on the right: curvature jumps, the moment does not
        pieces(1)%flexibility = 4*f
        dead(2)%kappa = 10.0_wp
        call find_extremes(pieces, dead, live, 2.0_wp, starts, values, piece, distance)
        call check_close(values(:, of_moment), q*[l**2/8, 0.0_wp], "the moment stays", absolute=1e-14_wp)
        call check_close(values(:, at_curvature), [q*4*f*1.5_wp, -10.0_wp], "curvature of both pieces")
        call check(all(piece(:, at_curvature) == [1, 2]), "its pieces")
        call check_close(distance(:, at_curvature), [1.0_wp, 3.0_wp], "and where in them")
    end subroutine simple_beam

    !> A link so short that its chord is rounding has the rotation of its neighbour, unless a hinge is between
    subroutine rotation_through_a_node()
        type(piece_type) :: pieces(2)
        type(piece_load_type) :: none(2)
        type(link_type) :: links(2)
        type(field_type) :: starts(2)
        real(wp) :: work(1)
        integer :: i
        real(wp), parameter :: short = 1e-12_wp, w(0:2) = [1.0_wp, 2.0_wp, 2.0_wp]

        pieces = [piece_type(1.0_wp, 0.125_wp, 0.0_wp), piece_type(short, 0.125_wp, 0.0_wp)]
        none = piece_load_type(0, 0, 0, 0, 0)
        do i = 1, 2
            call condense_link(pieces(i:i), none(i:i), none(i:i), work, links(i))
        end do
        call recover_beam(pieces, none, none, 1.0_wp, links, [1, 2], [0, 0, 0], w, spread(0.0_wp, 1, 3), spread(0.0_wp, 1, 3), &
                          [0.0_wp, 0.0_wp], starts)
        call check_close(starts%rotation, [1.0_wp, 1.0_wp], "through the node")
        call recover_beam(pieces, none, none, 1.0_wp, links, [1, 2], [0, hinge, 0], w, spread(0.0_wp, 1, 3), &
                          spread(0.0_wp, 1, 3), [0.0_wp, 0.0_wp], starts)
        call check_close(starts%rotation, [1.0_wp, 0.0_wp], "not through a hinge")
    end subroutine rotation_through_a_node

    !> All is zero everywhere; then a field that is no number
    subroutine extremes_of_nothing()
        type(piece_type) :: pieces(1)
        type(piece_load_type) :: none(1)
        type(field_type) :: starts(1)
        real(wp) :: values(2, bending_count), distance(2, bending_count)
        integer :: piece(2, bending_count)

        pieces = piece_type(1.0_wp, 1.0_wp, 0.0_wp)
        none = piece_load_type(0, 0, 0, 0, 0)
        starts = field_type(0, 0, 0, 0)
        call find_extremes(pieces, none, none, 1.0_wp, starts, values, piece, distance)
        call check(.not. any(abs(values) > 0.0_wp) .and. all(piece == 1), "zero")
        starts(1)%deflection = ieee_value(1.0_wp, ieee_positive_inf)
        call find_extremes(pieces, none, none, 1.0_wp, starts, values, piece, distance)
        call check(values(1, 1) > huge(1.0_wp) .and. values(2, 1) < -huge(1.0_wp), "no bounds of what is no number")
    end subroutine extremes_of_nothing

end program test_beam
