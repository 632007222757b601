!> Is there memory for a solve
module gapbeam_memory
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_lowered, only: lowered_type
    implicit none
    private
    public :: reserve_memory

    !> Bytes a solve takes at most for every link, support, piece and axial bar, one and a half times what was measured
    !> (tests/test_memory.py), and what small arrays and the allocator itself take
    integer(int64), parameter :: per_link = 2400, per_support = 1200, per_piece = 160, per_bar = 160, besides = 262144

contains

    !> Ask the system for as much memory as the engine may want, and give it back. The engine's own allocations, many and
    !> small, then succeed, unless another thread or process takes the memory in between
    subroutine reserve_memory(lowered, error)
        !> The beam that is to be solved
        type(lowered_type), intent(in) :: lowered
        !> Set where the system refuses
        type(error_type), allocatable, intent(out) :: error
        integer(int64), allocatable :: block(:)
        integer(int64) :: bytes
        integer :: stat

        bytes = besides + per_link*size(lowered%beam%links) + per_support*size(lowered%beam%supports) &
            + per_piece*size(lowered%pieces)
        if (allocated(lowered%axial%flexibility)) bytes = bytes + per_bar*size(lowered%axial%flexibility)
        allocate (block(bytes/8), stat=stat)
        if (stat /= 0) call no_memory(error)
    end subroutine reserve_memory

end module gapbeam_memory
