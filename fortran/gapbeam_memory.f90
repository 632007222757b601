!> Is there memory for a solve
module gapbeam_memory
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_lowered, only: lowered_type
    implicit none
    private
    public :: reserve_memory, for_solving, for_following, for_fields, for_certifying

    !> What the memory is for
    integer, parameter :: for_solving = 1, for_following = 2, for_fields = 3, for_certifying = 4
    !> Bytes it takes for every link and every support: one and a half times the most that was measured (1050 and 100, 2300 and
    !> 250; tests/test_memory.c shows that it is enough); for every piece and axial bar; for small arrays and the allocator itself
    integer(int64), parameter :: per_link(4) = [1600, 3600, 32, 6000], &
        per_support(4) = [200, 600, 0, 1000], per_piece = 160, besides = 65536

contains

    !> Ask the system for as much memory as the engine may want, and give it back. The engine's own allocations, many and
    !> small, then succeed, unless another thread or process takes the memory in between
    subroutine reserve_memory(lowered, purpose, error)
        !> The beam that is to be solved
        type(lowered_type), intent(in) :: lowered
        !> for_solving, for_following, for_fields or for_certifying
        integer, intent(in) :: purpose
        !> Set where the system refuses
        type(error_type), allocatable, intent(out) :: error
        integer(int64), allocatable :: block(:)
        integer(int64) :: bytes
        integer :: stat

        ! Axial bars are made of pieces
        bytes = besides + per_link(purpose)*size(lowered%beam%links) + per_support(purpose)*size(lowered%beam%supports) &
            + per_piece*size(lowered%pieces)
        allocate (block(bytes/8), stat=stat)
        if (stat /= 0) call no_memory(error)
    end subroutine reserve_memory

end module gapbeam_memory
