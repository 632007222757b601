!> What follows from the stiffnesses of spans is the same in all cases here. Modules whose names have _own in them are the same
!> sources compiled for stiffnesses that differ from case to case, so that there is no second copy of them
module gapbeam_lane_each
    use gapbeam_lane_types, only: lanes
    implicit none
    private
    public :: each, lanes

    !> How many lanes have such numbers of their own: min(l, each) is the one of lane l, which the compiler knows beforehand
    integer, parameter :: each = 1

end module gapbeam_lane_each
