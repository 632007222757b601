!> The real kinds of what is compiled in quadruple precision as well: its working precision is that
module gapbeam_kinds_quad
    use gapbeam_kinds, only: dp, qp
    implicit none
    private
    public :: wp, dp, qp

    !> Working precision
    integer, parameter :: wp = qp
end module gapbeam_kinds_quad
