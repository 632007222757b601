!> Roots on an interval
program test_polynomial
    use testing, only: check, check_close, finish
    use gapbeam_kinds, only: wp
    use gapbeam_polynomial, only: roots_between, highest_degree
    implicit none
    integer :: status

    call known_roots()
    call no_roots()
    call finish(status)
    if (status /= 0) stop 1, quiet=.true.

contains

    !> Polynomials made from their roots
    subroutine known_roots()
        real(wp) :: roots(highest_degree)
        integer :: number

        call roots_between([-1.0_wp, 4.0_wp], 1.0_wp, roots, number)
        call check_close(roots(1:number), [0.25_wp], "linear")
        call roots_between([0.18_wp, -0.9_wp, 1.0_wp], 1.0_wp, roots, number)
        call check_close(roots(1:number), [0.3_wp, 0.6_wp], "quadratic")
        ! (x - 1)(x - 2)(x - 3)(x - 4)
        call roots_between([24.0_wp, -50.0_wp, 35.0_wp, -10.0_wp, 1.0_wp], 10.0_wp, roots, number)
        call check_close(roots(1:number), [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], "four roots of a quartic")
        call roots_between([24.0_wp, -50.0_wp, 35.0_wp, -10.0_wp, 1.0_wp], 2.5_wp, roots, number)
        call check_close(roots(1:number), [1.0_wp, 2.0_wp], "only those on the interval")
        call roots_between([-8e-30_wp, 0.0_wp, 0.0_wp, 1e-30_wp], 10.0_wp, roots, number)
        call check_close(roots(1:number), [2.0_wp], "small coefficients")
    end subroutine known_roots

    !> Polynomials that do not change sign
    subroutine no_roots()
        real(wp) :: roots(highest_degree)
        integer :: number

        call roots_between([1.0_wp, 0.0_wp, 1.0_wp], 10.0_wp, roots, number)
        call check(number == 0, "no real root")
        call roots_between([0.0_wp, 0.0_wp, 0.0_wp], 1.0_wp, roots, number)
        call check(number == 0, "the zero polynomial")
        call roots_between([1.0_wp, -2.0_wp, 1.0_wp], 3.0_wp, roots, number)
        call check(number == 0, "a double root is no change of sign")
    end subroutine no_roots

end program test_polynomial
