!> Trains as callers give them, for Fortran: checked, and as the engine takes them; and positions that are not solved.
module gapbeam_api_train_loads
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, fatal_error, failed, gapbeam_solved, gapbeam_bad_input
    use gapbeam_words, only: shown, whole
    use gapbeam_scene, only: gapbeam_unchanged
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_train, only: train_type, uniform_type
    use gapbeam_train_traversal, only: traversal_type
    use gapbeam_train_runs, only: runs_type
    use gapbeam_api_objects, only: train_gap_type, bad_argument
    implicit none
    private
    public :: moving_train_type, train_gap_type, check_train, put_axles, find_gaps, lost_in

    !> Loads that move together
    type :: moving_train_type
        !> Distances of the axles behind the first one, 0 or more, and their forces, down, both of one size
        real(wp), allocatable :: distance(:), force(:)
        !> Uniform load over the length of the train, down
        real(wp) :: q = 0.0_wp
        !> Does it go to the left; its axles then stand to the right of the first one
        logical :: to_the_left = .false.
        !> Positions, in ascending order; gapbeam_unchanged: from the first axle on the beam, to the last
        real(wp) :: from = gapbeam_unchanged, to = gapbeam_unchanged
    end type moving_train_type

contains

    !> Refuse a train that makes no sense, and find its positions
    subroutine check_train(lowered, train, from, to, error)
        type(assembled_type), intent(in) :: lowered
        type(moving_train_type), intent(in) :: train
        real(wp), intent(out) :: from, to
        type(error_type), allocatable, intent(out) :: error
        character(len=4), parameter :: names(3) = ["q   ", "from", "to  "]
        real(wp) :: end, longest
        logical :: finite(3)
        integer :: i

        from = 0.0_wp
        to = 0.0_wp
        if (.not. (allocated(train%distance) .and. allocated(train%force))) then
            call fatal_error(error, gapbeam_bad_input, "train: distance or force is not allocated")
            return
        end if
        if (size(train%distance) /= size(train%force) .or. size(train%force) == 0) then
            call fatal_error(error, gapbeam_bad_input, "train: expected as many forces as distances, 1 or more, got "// &
                             trim(whole(size(train%force)))//" and "//trim(whole(size(train%distance))))
            return
        end if
        do i = 1, size(train%distance)
            if (.not. (train%distance(i) >= 0.0_wp .and. train%distance(i) <= huge(1.0_wp))) then
                call bad_argument(error, "distance", "distance("//trim(whole(i))//"): expected a distance behind "// &
                                 "the first axle, 0 or more, got "//trim(shown(train%distance(i))))
            else if (.not. abs(train%force(i)) <= huge(1.0_wp)) then
                call bad_argument(error, "force", "force("//trim(whole(i))//"): expected a finite number, got "// &
                                 trim(shown(train%force(i))))
            end if
            if (allocated(error)) return
        end do
        finite = abs([train%q, train%from, train%to]) <= huge(1.0_wp)
        if (.not. all(finite)) then
            call bad_argument(error, names(findloc(finite, .false., 1)), "train: q, from and to must be finite")
            return
        end if
        end = point_x(lowered, size(lowered%pieces))
        longest = maxval(train%distance)
        from = train%from
        to = train%to
        if (.not. from > gapbeam_unchanged) from = merge(-longest, 0.0_wp, train%to_the_left)
        if (.not. to > gapbeam_unchanged) to = merge(end, end + longest, train%to_the_left)
        if (from <= to) return
        call bad_argument(error, "to", "the positions from "//trim(shown(from))//" to "//trim(shown(to))// &
                         " are none: from must be at most to")
    end subroutine check_train

    !> Axles as distances from the position, to the right
    subroutine put_axles(given, train, error)
        type(moving_train_type), intent(in) :: given
        type(train_type), intent(out) :: train
        type(error_type), allocatable, intent(out) :: error
        real(wp) :: longest
        integer :: stat

        associate (n => size(given%force))
            allocate (train%offset(n), train%force(n), train%uniform(merge(1, 0, abs(given%q) > 0.0_wp)), stat=stat)
        end associate
        if (failed(stat, error)) return
        longest = maxval(given%distance)
        train%offset(:) = merge(given%distance, -given%distance, given%to_the_left)
        train%force(:) = given%force
        train%uniform(:) = uniform_type(given%q, merge(0.0_wp, -longest, given%to_the_left), &
                                        merge(longest, 0.0_wp, given%to_the_left))
    end subroutine put_axles

    !> Stretches that are not solved, joined where they are alike
    subroutine find_gaps(passage, backwards, gaps, error)
        type(traversal_type), intent(in) :: passage
        logical, intent(in) :: backwards
        type(train_gap_type), allocatable, intent(out) :: gaps(:)
        type(error_type), allocatable, intent(out) :: error
        type(train_gap_type) :: found(passage%number)
        integer :: k, last, number, stat

        number = 0
        last = 0
        do k = 1, passage%number
            if (passage%status(k) == gapbeam_solved) cycle
            if (last == k - 1 .and. number > 0) then
                if (passage%status(k) == passage%status(last) .and. passage%motion_of(k) == passage%motion_of(last)) then
                    found(number)%to = passage%to(k)
                    last = k
                    cycle
                end if
            end if
            number = number + 1
            found(number) = train_gap_type(passage%from(k), passage%to(k), passage%status(k))
            last = k
        end do
        allocate (gaps(number), source=found(:number), stat=stat)
        if (failed(stat, error)) return
        if (backwards) gaps(:) = found(number:1:-1)
    end subroutine find_gaps

    !> Positions that are not solved on the ground, or with smooth laws
    pure function lost_in(runs) result(gaps)
        type(runs_type), intent(in) :: runs
        type(train_gap_type), allocatable :: gaps(:)
        integer :: k

        allocate (gaps(size(runs%lost)))
        do k = 1, size(gaps)
            associate (first => runs%boxes(runs%lost(k)%first)%of, last => runs%boxes(runs%lost(k)%last)%of)
                gaps(k) = train_gap_type(first%position, last%position, first%status)
            end associate
        end do
    end function lost_in

end module gapbeam_api_train_loads
