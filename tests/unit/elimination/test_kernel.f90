!> Plain beams solved from both ends, against the elimination from the left
program test_kernel
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_band, only: node_type, rhs_type, pivot_type, answer_type, factor_chain, band_ok, plain, restrained
    use gapbeam_band_substitution, only: solve_chain
    use gapbeam_link, only: link_type, piece_type, piece_load_type, condense_link
    use gapbeam_plain, only: plain_type, prepare_plain, is_plain, ends_hold, solve_plain
    use gapbeam_kernel, only: eliminated_type, last_step
    use gapbeam_elements, only: solve_elements, refine_elements, elements_solved, elements_mechanism, elements_bad_input
    implicit none
    integer :: status, n, ends

    do ends = 0, 3
        do n = 2, 9
            call both_ends(n, merge(restrained, plain, btest(ends, 0)), merge(restrained, plain, btest(ends, 1)))
        end do
        call both_ends(200, merge(restrained, plain, btest(ends, 0)), merge(restrained, plain, btest(ends, 1)))
    end do
    do n = 2, 9
        call elements(n)
    end do
    call elements(128)
    call elements(131)
    call elements(1000)
    call refined(7)
    call refined(20000)
    call refused()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Infinity without an exception
    pure function infinite() result(value)
        use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
        real(wp) :: value

        value = ieee_value(value, ieee_positive_inf)
    end function infinite

    !> Links of a few pieces each, springs, rigid supports with settlements
    subroutine both_ends(n, left, right)
        integer, intent(in) :: n
        !> Kinds of the end nodes
        integer, intent(in) :: left, right
        type(link_type) :: links(n)
        type(piece_type) :: pieces(2)
        type(piece_load_type) :: dead(2), live(2)
        type(node_type) :: nodes(0:n)
        type(rhs_type) :: rhs(0:n), work(0:n)
        type(pivot_type) :: pivots(0:n)
        type(answer_type) :: expected(0:n), answers(0:n)
        type(plain_type) :: beam
        real(wp) :: room(2)
        integer :: i, state, place

        do i = 1, n
            pieces(1) = piece_type(0.3_wp + modulo(7*i, 5), 1.0_wp/(1 + modulo(3*i, 4)), 0.1_wp*modulo(i, 2))
            pieces(2) = piece_type(1.0_wp, 1.0_wp/(1 + modulo(i, 7)), 0.0_wp)
            dead = piece_load_type(0, 0, 0, 0, 0)
            live = dead
            dead(1)%qa = 1.0_wp + modulo(i, 3)
            dead(1)%force = -2.0_wp
            call condense_link(pieces, dead, live, room, links(i))
        end do
        do i = 0, n
            nodes(i) = node_type(plain, modulo(i, 4) == 0, merge(2.5_wp, 0.0_wp, modulo(i, 3) == 1), 0.0_wp)
            rhs(i) = rhs_type(0.0_wp, 0.0_wp, 1.0_wp + i/7.0_wp, merge(0.01_wp, 0.0_wp, nodes(i)%held), 0.0_wp)
        end do
        rhs(:n - 1)%right = links%turn_a(1)
        rhs(1:)%left = links%turn_b(1)
        nodes(0)%kind = left
        nodes(n)%kind = right
        nodes(0)%compliance = 0.3_wp
        nodes(n)%held = right == plain
        call factor_chain(nodes, links, pivots, state, place)
        call check(state == band_ok .and. is_plain(links, nodes%kind) .and. ends_hold(nodes), "a plain beam")
        work = rhs
        call solve_chain(nodes, links, pivots, work, expected)
        call prepare_plain(links, beam)
        call solve_plain(beam, nodes, rhs, answers)
        call check_close(answers%deflection, expected%deflection, "deflections", 1e-12_wp)
        call check_close(answers%moment_left, expected%moment_left, "moments left", 1e-12_wp)
        call check_close(answers%moment_right, expected%moment_right, "moments right", 1e-12_wp)
    end subroutine both_ends

    !> Elements as plain arrays, against links
    subroutine elements(n)
        integer, intent(in) :: n
        real(wp) :: length(n), ei(n), q(n), stiffness(0:n), force(0:n), w(0:n), m(0:n), room(1)
        type(eliminated_type) :: eliminated(0:last_step(n))
        type(link_type) :: links(n)
        type(piece_load_type) :: load(1), none(1)
        type(node_type) :: nodes(0:n)
        type(rhs_type) :: rhs(0:n)
        type(answer_type) :: answers(0:n)
        type(plain_type) :: beam
        integer :: i, state

        none = piece_load_type(0, 0, 0, 0, 0)
        length = [(1.0_wp + modulo(5*i, 7)/7.0_wp, i=1, n)]
        ei = [(100.0_wp*(1 + modulo(3*i, 5)), i=1, n)]
        q = [(modulo(11*i, 13) - 4.0_wp, i=1, n)]
        force = [(modulo(17*i, 5) - 1.0_wp, i=0, n)]
        stiffness = [(merge(50.0_wp, 0.0_wp, modulo(i, 3) == 0), i=0, n)]
        stiffness(4::9) = infinite()
        stiffness(n) = infinite()
        call solve_elements(length, ei, q, stiffness, force, eliminated, w, m, state)
        call check(state == elements_solved, "elements solved")
        do i = 1, n
            load = piece_load_type(q(i), q(i), 0, 0, 0)
            call condense_link([piece_type(length(i), 1/ei(i), 0.0_wp)], load, none, room, links(i))
        end do
        do i = 0, n
            nodes(i)%held = stiffness(i) > huge(1.0_wp)
            if (.not. nodes(i)%held) nodes(i)%stiffness = stiffness(i)
            rhs(i)%shear = force(i)
        end do
        rhs(:n - 1)%right = links%turn_a(1)
        rhs(1:)%left = links%turn_b(1)
        rhs(:n - 1)%shear = rhs(:n - 1)%shear + links%shear_a(1)
        rhs(1:)%shear = rhs(1:)%shear - links%shear_b(1)
        call prepare_plain(links, beam)
        call solve_plain(beam, nodes, rhs, answers)
        call check_close(w, answers%deflection, "deflections of elements", 1e-12_wp)
        call check_close(m(1:n - 1), answers(1:n - 1)%moment_left, "moments of elements", 1e-12_wp)
        call check(abs(m(0)) + abs(m(n)) <= 0.0_wp, "no moments at the ends")
    end subroutine elements

    !> A simple beam under uniform load on a fine mesh: the closed form to all digits
    subroutine refined(n)
        integer, intent(in) :: n
        real(wp) :: length(n), one(n), stiffness(0:n), force(0:n), w(0:n), m(0:n), correction(0:n, 2), x(0:n)
        type(eliminated_type) :: eliminated(0:last_step(n))
        integer :: i, state

        length = 1.0_wp/n
        one = 1.0_wp
        force = 0.0_wp
        stiffness = 0.0_wp
        stiffness(0) = infinite()
        stiffness(n) = infinite()
        x = [(real(i, wp)/n, i=0, n)]
        call solve_elements(length, one, one, stiffness, force, eliminated, w, m, state)
        call refine_elements(length, one, one, stiffness, force, eliminated, correction, w, m)
        call check_close(w, x*(1 - x)*(1 + x*(1 - x))/24, "refined deflections", 2e-15_wp)
        call check_close(m, x*(1 - x)/2, "refined moments", 2e-15_wp)
    end subroutine refined

    !> What cannot be solved is not solved
    subroutine refused()
        real(wp) :: w(0:3), m(0:3)
        type(eliminated_type) :: eliminated(0:1)
        integer :: state

        call solve_elements([1.0_wp, 0.0_wp, 1.0_wp], [1.0_wp, 1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], &
                            [1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], eliminated, w, m, state)
        call check(state == elements_bad_input, "length 0")
        call solve_elements([1.0_wp, 1.0_wp, 1.0_wp], [1.0_wp, 1.0_wp, 1.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], &
                            [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], eliminated, w, m, state)
        call check(state == elements_mechanism, "an end without support")
    end subroutine refused

end program test_kernel
