!> Estimates of the memory that a task takes, and whether there is enough.
module gapbeam_memory
    use, intrinsic :: iso_fortran_env, only: int64
    use gapbeam_error, only: error_type, no_memory
    implicit none
    private
    public :: reserve_memory, enough_memory
    public :: for_solving, for_refining, for_following, for_following_closely, for_certifying, for_fields, for_ground, &
        for_assembling, for_laws

    !> What the memory is for: to solve a beam; the same again in quadruple precision; to follow the load; the same in quadruple
    !> precision; to certify a state; to go into the links, condense loads, or solve along the axis; to solve on the ground; to
    !> check a scene (of spans, supports, and all else that is in lists); to make and meet laws by name (pieces are these laws)
    integer, parameter :: for_solving = 1, for_refining = 2, for_following = 3, for_following_closely = 4, for_certifying = 5, &
        for_fields = 6, for_ground = 7, for_assembling = 8, for_laws = 9
    !> Bytes it takes for every link, every support and every piece: one and a half times the most that was measured, of beams in
    !> which the search goes through part after part (test_memory.c and test_memory.py show that it is enough); on
    !> the ground of beams on uneven ground with a law of three pieces, which went through it at every point
    integer(int64), parameter :: per_link(9) = [2850, 5500, 5450, 9700, 6500, 48, 25800, 64, 600], &
        per_support(9) = [200, 600, 500, 1000, 600, 0, 1000, 64, 600], per_piece(9) = [0, 350, 0, 350, 600, 100, 0, 300, 5000]
    !> Bytes for small arrays and the allocator itself
    integer(int64), parameter :: besides = 65536

contains

    !> Ask the system for as much memory as the engine may want, and give it back. The engine's own allocations, many and
    !> small, then succeed, unless another thread or process takes the memory in between
    function enough_memory(purpose, links, supports, pieces) result(enough)
        !> One of the purposes above
        integer, intent(in) :: purpose
        !> Numbers of links and supports of the beam, and of pieces (or axial bars) if they are worked on
        integer, intent(in) :: links, supports, pieces
        !> False where the system refuses
        logical :: enough
        integer(int64), allocatable :: block(:)
        integer(int64) :: bytes
        integer :: stat

        bytes = besides + per_link(purpose)*links + per_support(purpose)*supports + per_piece(purpose)*pieces
        allocate (block(bytes/8), stat=stat)
        enough = stat == 0
    end function enough_memory

    !> The same, with an error where the system refuses
    subroutine reserve_memory(purpose, links, supports, pieces, error)
        !> As for enough_memory
        integer, intent(in) :: purpose, links, supports, pieces
        !> Set where the system refuses
        type(error_type), allocatable, intent(out) :: error

        if (.not. enough_memory(purpose, links, supports, pieces)) call no_memory(error)
    end subroutine reserve_memory

end module gapbeam_memory
