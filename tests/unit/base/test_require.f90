!> A requirement that does not hold ends the process in the build with checks, where this test has to fail, and nowhere else
program test_require
    use gapbeam_require, only: require
    implicit none

    call require(.true., "holds")
    call require(.false., "does not hold")
end program test_require
