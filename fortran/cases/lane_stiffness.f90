!> Lanes of the arrays that follow from stiffnesses of spans: one for all cases.
!>
!> Modules whose names have _own in them are the same sources compiled for stiffnesses that differ from case to case
!> (gapbeam_lane_stiffness_own), so that there is no second copy of them.
module gapbeam_lane_stiffness
    use gapbeam_lane_types, only: lanes
    implicit none
    private
    public :: stiffness_lanes, lanes

    !> min(l, stiffness_lanes) is the one of lane l, which the compiler knows beforehand
    integer, parameter :: stiffness_lanes = 1

end module gapbeam_lane_stiffness
