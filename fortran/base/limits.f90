!> Counts at which something is given up, cut off or done another way: what each bounds, why so many, who reads it.
!> Those that are only tuned say so. Compiled in double and in quadruple precision.
module gapbeam_limits
    implicit none
    private
    public :: most_path_segments, changes_at_a_time, most_extreme_ties

    !> Segments after which a path through a history is cut off: without a history there are finitely many, with one a beam may
    !> flip to and fro without end. Read by face/api_history and, through the engine, by gapbeam.results.paths
    integer, parameter :: most_path_segments = 20000
    !> Changes of the contact state followed in one call, so that arrays stay small; tuned. Read by continuation/events and, through
    !> the engine, by gapbeam.results.paths
    integer, parameter :: changes_at_a_time = 1000
    !> Places and positions listed at which an extreme under trains is reached; beams with many equal spans have more.
    !> Read by moving_load/train_ties and, through the engine, by gapbeam.results.trains
    integer, parameter :: most_extreme_ties = 16

end module gapbeam_limits
