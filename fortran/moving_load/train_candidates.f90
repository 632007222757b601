!> Candidates for extreme values: parts of a train's way that bounds do not rule out.
module gapbeam_train_candidates
    use gapbeam_kinds, only: wp
    use gapbeam_path_tolerances, only: train_equal
    use gapbeam_patch, only: patch_type
    use gapbeam_train_cells, only: cell_type
    implicit none
    private
    public :: candidate_type, candidates_type, least_of, raise, upper_bound, offer

    !> A part of a stretch that may hold an extreme value
    type :: candidate_type
        type(patch_type) :: patch
        type(cell_type) :: cell
        !> The stretch, and the last one on which it stays the same (of supports)
        integer :: stretch = 0, last = 0
    end type candidate_type

    !> Candidates for one extreme
    type :: candidates_type
        integer :: number = 0
        real(wp) :: known = -huge(1.0_wp), largest = 0.0_wp
        type(candidate_type), allocatable :: list(:)
    end type candidates_type

contains

    !> What is below this is not the largest value
    pure function least_of(candidates) result(least)
        type(candidates_type), intent(in) :: candidates
        real(wp) :: least

        least = candidates%known - train_equal*candidates%largest
    end function least_of

    !> A value is reached
    pure subroutine raise(candidates, value)
        type(candidates_type), intent(inout) :: candidates
        real(wp), intent(in) :: value

        candidates%known = max(candidates%known, value)
        candidates%largest = max(candidates%largest, abs(value))
    end subroutine raise

    !> Largest coefficient
    pure function upper_bound(patch) result(upper)
        type(patch_type), intent(in) :: patch
        real(wp) :: upper

        upper = maxval(patch%b(0:patch%along, 0:patch%across))
    end function upper_bound

    !> Add a part of a stretch to candidates, if it may hold the largest value
    subroutine offer(candidates, patch, cell, stretch, last)
        type(candidates_type), intent(inout) :: candidates
        type(patch_type), intent(in) :: patch
        type(cell_type), intent(in) :: cell
        !> The stretch, and the last one on which it stays the same
        integer, intent(in) :: stretch, last
        integer :: count, q

        candidates%largest = max(candidates%largest, maxval(abs(patch%b(0:patch%along, 0:patch%across))))
        ! Corners are values
        associate (b => patch%b, p => patch%along, r => patch%across)
            candidates%known = max(candidates%known, b(0, 0), b(p, 0), b(0, r), b(p, r))
        end associate
        if (upper_bound(patch) < least_of(candidates)) return
        if (.not. allocated(candidates%list)) allocate (candidates%list(8))
        if (candidates%number == size(candidates%list)) then
            ! Those that are no longer in question make room
            count = 0
            do q = 1, candidates%number
                if (upper_bound(candidates%list(q)%patch) < candidates%known - train_equal*candidates%largest) cycle
                count = count + 1
                if (count < q) candidates%list(count) = candidates%list(q)
            end do
            candidates%number = count
            if (2*count > size(candidates%list)) candidates%list = [candidates%list, candidates%list]
        end if
        if (candidates%number > 0 .and. cell%piece == 0) then
            associate (before => candidates%list(candidates%number))
                if (before%last == stretch - 1 .and. is_level(patch, candidates%largest) .and. &
                    is_level(before%patch, candidates%largest) .and. &
                    abs(patch%b(0, 0) - before%patch%b(0, 0)) <= train_equal*candidates%largest) then
                    before%last = last
                    return
                end if
            end associate
        end if
        candidates%number = candidates%number + 1
        candidates%list(candidates%number) = candidate_type(patch, cell, stretch, last)
    end subroutine offer

    !> Does a value of a support stay the same
    pure function is_level(patch, largest) result(level)
        type(patch_type), intent(in) :: patch
        !> Size of such values
        real(wp), intent(in) :: largest
        logical :: level

        level = all(abs(patch%b(0, 0:patch%across) - patch%b(0, 0)) <= train_equal*largest)
    end function is_level

end module gapbeam_train_candidates
