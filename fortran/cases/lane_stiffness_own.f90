!> Lanes of the arrays that follow from stiffnesses of spans: all of them, for stiffnesses that differ from case to case
module gapbeam_lane_stiffness_own
    use gapbeam_lane_types, only: lanes
    implicit none
    private
    public :: stiffness_lanes, lanes

    !> As in gapbeam_lane_stiffness
    integer, parameter :: stiffness_lanes = lanes

end module gapbeam_lane_stiffness_own
