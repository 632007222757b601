!> Tops of polynomials in the position and in an angle, by numbers that are known; zones carried to other pieces
program test_train_tops
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_train_tops, only: ruler_type, angle_of, position_of, at_birth, nearer_birth, find_vertex, find_highest
    implicit none
    integer :: status

    call angles()
    call tops()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> From 2 to 6, and back
    subroutine angles()
        type(ruler_type), parameter :: way = ruler_type(.true., 2.0_wp, 6.0_wp)
        real(wp), parameter :: pi = acos(-1.0_wp)
        real(wp) :: angle
        logical :: known

        call check_close(angle_of(way, [2.0_wp, 4.0_wp, 6.0_wp]), [0.0_wp, pi/2, pi], "angles")
        call check_close(position_of(way, angle_of(way, [2.5_wp, 5.9_wp])), [2.5_wp, 5.9_wp], "and back")
        call check(at_birth(way, 0.0_wp) .and. at_birth(way, pi) .and. .not. at_birth(way, 1.0_wp), "where zones are born")
        call check(.not. at_birth(ruler_type(), 0.0_wp), "none without ground")
        call nearer_birth(0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, way, angle, known)
        call check(known .and. abs(angle - 0.25_wp) <= 0.0_wp, "a quarter of the way")
        call nearer_birth(0.0_wp, 0.0_wp, 2.0_wp**(-12), 1.0_wp, way, angle, known)
        call check(.not. known, "near enough")
    end subroutine angles

    !> Of parabolas, and of a polynomial of degree 6 with two tops
    subroutine tops()
        real(wp) :: at(7), place, height
        logical :: known
        integer :: k

        call find_vertex(2.0_wp, [0.0_wp, 2.0_wp, 3.0_wp], [2.0_wp, 8.0_wp, 5.0_wp], 0.0_wp, 3.0_wp, place, height, known)
        call check(known, "a vertex")
        call check_close([place, height], [1.75_wp, 8.125_wp], "of a parabola")
        call find_highest([0.0_wp, 1.0_wp, 3.0_wp], [0.0_wp, 3.0_wp, 3.0_wp], 1.0_wp, 3.0_wp, place, height, known)
        call check(known, "a top")
        call check_close([place, height], [2.0_wp, 4.0_wp], "between bounds")
        call find_highest([0.0_wp, 1.0_wp, 3.0_wp], [0.0_wp, -3.0_wp, -3.0_wp], 1.0_wp, 3.0_wp, place, height, known)
        call check(.not. known, "a valley is none")
        at(:) = [(0.5_wp*k - 1.5_wp, k=0, 6)]
        call find_highest(at, -(at**2 - 1)**2*(at**2 + 1) + at/64, -1.5_wp, 1.5_wp, place, height, known)
        call check(known .and. place > 0.9_wp .and. place < 1.1_wp .and. height > 1/64.0_wp, "the higher one of two")
    end subroutine tops

end program test_train_tops
