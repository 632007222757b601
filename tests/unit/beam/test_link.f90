!> Condensation of pieces into a link, and recovery of the fields in it
program test_link
    use testing, only: check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_element, only: field_type
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link, recover_link
    implicit none
    integer :: status

    call prismatic()
    call many_pieces()
    call determinant_keeps_its_digits()
    call recovered_fields()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Textbook values: L/3EI, L/6EI, shear 1/GAL; rotations under uniform load, force, couple, curvature
    subroutine prismatic()
        type(link_type) :: link
        type(piece_load_type) :: none(1), load(1), two(2)
        real(wp) :: work(2)
        real(wp), parameter :: l = 4.0_wp, ei = 50.0_wp, ga = 7.0_wp, q = 3.0_wp

        none = piece_load_type(0, 0, 0, 0, 0)
        load = piece_load_type(q, q, 0, 0, 0)
        call condense_link([piece_type(l, 1/ei, 1/ga)], load, none, work, link)
        call check_close([link%faa, link%fab, link%fbb], &
                         [l/(3*ei) + 1/(ga*l), l/(6*ei) - 1/(ga*l), l/(3*ei) + 1/(ga*l)], "flexibilities")
        call check_close(link%determinant, l**2/(12*ei**2) + 1/(ga*ei), "determinant")
        call check_close([link%turn_a(1), link%turn_b(1)], spread(q*l**3/(24*ei), 1, 2), "rotations under uniform load")
        call check_close([link%shear_a(1), link%shear_b(1)], q*l/2*[1, -1], "end shears under uniform load")
        call check_close([link%turn_a(2), link%turn_b(2)], [0.0_wp, 0.0_wp], "no live load", absolute=tiny(l))
        load = piece_load_type(0, 0, 0.01_wp, 0, 0)
        call condense_link([piece_type(l, 1/ei, 0.0_wp)], none, load, work, link)
        call check_close([link%turn_a(2), link%turn_b(2)], spread(-0.01_wp*l/2, 1, 2), "imposed curvature")
        ! Force P at a from the left: theta_a = P a b (L + b)/(6 L EI)
        two = none(1)
        two(1)%force = 5.0_wp
        call condense_link([piece_type(1.0_wp, 1/ei, 0.0_wp), piece_type(3.0_wp, 1/ei, 0.0_wp)], two, spread(none(1), 1, 2), &
                           work, link)
        call check_close(link%turn_a(1), 5*1*3*(4 + 3)/(6*4*ei), "force")
        call check_close([link%shear_a(1), link%shear_b(1)], [3.75_wp, -1.25_wp], "shears under a force")
        two(1) = piece_load_type(0, 0, 0, 0, 5)
        call condense_link([piece_type(2.0_wp, 1/ei, 1/ga), piece_type(2.0_wp, 1/ei, 0.0_wp)], two, spread(none(1), 1, 2), &
                           work, link)
        ! Couple at midspan: C L/24 EI by bending; the constant shear -C/L slips in the left half only
        call check_close(link%turn_a(1), -5*l/(24*ei) + 5/l*(2/ga)/l, "couple, and shear flexibility that changes")
        call check_close(link%shear_a(1), -5/l, "shear under a couple")
    end subroutine prismatic

    !> A million pieces of a uniform beam give the digits of one
    subroutine many_pieces()
        integer, parameter :: n = 1000000
        type(piece_type), allocatable :: pieces(:)
        type(piece_load_type), allocatable :: load(:), none(:)
        real(wp), allocatable :: work(:)
        type(link_type) :: link, one

        allocate (pieces(n), load(n), none(n), work(n))
        pieces = piece_type(0.5_wp**20, 0.125_wp, 0.0_wp)
        load = piece_load_type(2, 2, 0, 0, 0)
        none = piece_load_type(0, 0, 0, 0, 0)
        call condense_link(pieces, load, none, work, link)
        call condense_link([piece_type(n*0.5_wp**20, 0.125_wp, 0.0_wp)], load(1:1), none(1:1), work, one)
        call check_close([link%faa, link%fab, link%fbb], [one%faa, one%fab, one%fbb], "flexibilities", 4*epsilon(1.0_wp))
        call check_close([link%turn_a(1), link%turn_b(1)], [one%turn_a(1), one%turn_b(1)], "rotations", 4*epsilon(1.0_wp))
    end subroutine many_pieces

    !> All flexibility in one short piece: the determinant is small and still exact
    subroutine determinant_keeps_its_digits()
        type(link_type) :: link
        type(piece_load_type) :: none(3)
        real(wp) :: work(3)
        real(wp), parameter :: short = 2.0_wp**(-20)

        none = piece_load_type(0, 0, 0, 0, 0)
        call condense_link([piece_type(1.0_wp, 0.0_wp, 0.0_wp), piece_type(short, 1/short, 0.0_wp), &
                            piece_type(1.0_wp, 0.0_wp, 0.0_wp)], none, none, work, link)
        call check_close(link%determinant, short**2/(12*(2 + short)**2), "determinant")
    end subroutine determinant_keeps_its_digits

    !> Simple beam in three pieces: moments and deflections of the uncut one
    subroutine recovered_fields()
        type(piece_load_type) :: load(3)
        type(piece_type) :: pieces(3)
        type(field_type) :: starts(3)
        type(link_type) :: link
        real(wp) :: work(3, 3), x(3), exact(3)
        real(wp), parameter :: l = 8.0_wp, ei = 20.0_wp, q = 3.0_wp

        pieces = [piece_type(1.0_wp, 1/ei, 0.0_wp), piece_type(4.0_wp, 1/ei, 0.0_wp), piece_type(3.0_wp, 1/ei, 0.0_wp)]
        load = piece_load_type(q, q, 0, 0, 0)
        call condense_link(pieces, load, load, work(:, 1), link)
        call recover_link(pieces, load, l, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, link%turn_a(1), work, starts)
        x = [0.0_wp, 1.0_wp, 5.0_wp]
        call check_close(starts%moment, q*x*(l - x)/2, "moments")
        call check_close(starts%shear, q*(l/2 - x), "shears")
        exact = q*x*(l**3 - 2*l*x**2 + x**3)/(24*ei)
        call check_close(starts%deflection, exact, "deflections")
        call check_close(starts%rotation, q*(l**3 - 6*l*x**2 + 4*x**3)/(24*ei), "rotations")
    end subroutine recovered_fields

end program test_link
