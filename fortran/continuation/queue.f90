!> Tournament tree of keys of supports: which comes first (Knuth 1973, 5.4.1).
module gapbeam_queue
    use gapbeam_kinds, only: wp
    implicit none
    private
    public :: queue_type, new_queue, set_key, first_key, all_up_to

    !> Keys of the supports as the leaves of a complete binary tree in which every node holds the lesser of its two children
    type :: queue_type
        private
        !> Number of leaves, a power of two
        integer :: leaves = 0
        !> Children of node i are 2 i and 2 i + 1; leaf k is node leaves + k - 1
        real(wp), allocatable :: least(:)
    end type queue_type

contains

    !> A queue in which all keys are huge
    pure subroutine new_queue(size, queue)
        !> Number of keys
        integer, intent(in) :: size
        type(queue_type), intent(out) :: queue

        queue%leaves = 1
        do while (queue%leaves < size)
            queue%leaves = 2*queue%leaves
        end do
        allocate (queue%least(2*queue%leaves - 1), source=huge(1.0_wp))
    end subroutine new_queue

    !> Set the key of a support
    pure subroutine set_key(queue, k, key)
        type(queue_type), intent(inout) :: queue
        integer, intent(in) :: k
        real(wp), intent(in) :: key
        integer :: i

        i = queue%leaves + k - 1
        queue%least(i) = key
        do while (i > 1)
            i = i/2
            queue%least(i) = min(queue%least(2*i), queue%least(2*i + 1))
        end do
    end subroutine set_key

    !> The least key
    pure function first_key(queue) result(key)
        type(queue_type), intent(in) :: queue
        real(wp) :: key

        key = queue%least(1)
    end function first_key

    !> The supports whose keys are not above a limit, in order of their numbers
    pure function all_up_to(queue, limit) result(found)
        type(queue_type), intent(in) :: queue
        real(wp), intent(in) :: limit
        integer, allocatable :: found(:)
        integer :: i

        allocate (found(0))
        if (queue%least(1) > limit) return
        ! Down to the leaves, always left first; then up to the next branch to the right
        i = 1
        do
            if (queue%least(i) <= limit) then
                if (i < queue%leaves) then
                    i = 2*i
                    cycle
                end if
                found = [found, i - queue%leaves + 1]
            end if
            do while (i > 1 .and. modulo(i, 2) == 1)
                i = i/2
            end do
            if (i <= 1) return
            i = i + 1
        end do
    end function all_up_to

end module gapbeam_queue
