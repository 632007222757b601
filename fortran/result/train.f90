!> Loads that move together: axles and uniform loads on a beam at a place of the train.
!>
!> The place of a train is that of its first axle. While no axle, and no end of a uniform load, passes a point at which a piece
!> of the beam ends, what it does to the links is a polynomial in the place: the rotations of the simple bar under a unit
!> force are the deflections under unit moments at its ends (Maxwell), of degree 3 in every piece. Such a range of places is a
!> reach.
module gapbeam_train
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, no_memory
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_load_type, recover_link
    use gapbeam_model, only: beam_type
    use gapbeam_lowered, only: lowered_type, point_x
    use gapbeam_places, only: position_tolerance
    implicit none
    private
    public :: train_type, uniform_type, track_type, reach_type, new_track, find_reaches, enter_reach, place_train, degree_of, &
        least_distance

    !> A uniform load of a train, down, from one distance from its place to another
    type :: uniform_type
        real(wp) :: q = 0.0_wp, from = 0.0_wp, to = 0.0_wp
    end type uniform_type

    !> A train, in the user's units
    type :: train_type
        !> Where its axles are, measured from the place of the train to the right, and their forces (down), shape (n)
        real(wp), allocatable :: offset(:), force(:)
        !> Uniform loads, none or more
        type(uniform_type), allocatable :: uniform(:)
    end type train_type

    !> A beam made ready for a train
    type :: track_type
        !> The beam in the engine's units; load index 1: all loads that stay, 2: the train
        type(beam_type) :: beam
        !> x of the points between the pieces in the user's units, shape (0:npiece)
        real(wp), allocatable :: x(:)
        !> Of every piece its link, and the distance of its left end from that of the link in the engine's units
        integer, allocatable :: link(:)
        real(wp), allocatable :: before(:), length(:)
        !> Rotations of the ends of the simple bar under a unit force at a distance from the left end of a piece: coefficients,
        !> shape (0:3, npiece)
        real(wp), allocatable :: turn_a(:, :), turn_b(:, :)
        !> Exponents of the units of length and force
        integer :: length_unit = 0, force_unit = 0
        !> Links with loads of the train, the first `loaded` of them
        integer, allocatable :: with_load(:)
        integer :: loaded = 0
        logical, allocatable :: is_loaded(:)
    end type track_type

    !> Places of a train between which nothing passes a point; of no length where axles come and go at one place
    type :: reach_type
        real(wp) :: from = 0.0_wp, to = 0.0_wp
        !> A place within it that stands for all, and how many axles are left of the beam and right of it
        real(wp) :: about = 0.0_wp
        integer :: outside(2) = 0
        !> By enter_reach: piece of every axle, 0: not on the beam
        integer, allocatable :: piece(:)
        !> And in which every uniform load begins and ends; the first is beyond the last where it is not on the beam
        integer, allocatable :: first(:), last(:)
        !> Do the loads on its ends act there as in between
        logical :: holds_from = .true., holds_to = .true.
    end type reach_type

contains

    !> Make a beam ready for trains
    subroutine new_track(lowered, track, error)
        !> The beam, without foundations
        type(lowered_type), intent(in) :: lowered
        type(track_type), intent(out) :: track
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j, n, first, stat

        n = size(lowered%pieces)
        allocate (track%x(0:n), track%link(n), track%before(n), track%length(n), track%turn_a(0:3, n), track%turn_b(0:3, n), &
                  track%with_load(size(lowered%beam%links)), track%is_loaded(size(lowered%beam%links)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        track%beam = lowered%beam
        track%is_loaded(:) = .false.
        track%length_unit = lowered%units%length
        track%force_unit = lowered%units%force
        track%length(:) = lowered%pieces%length
        do j = 0, n
            track%x(j) = point_x(lowered, j)
        end do
        associate (beam => track%beam)
            beam%force(1, :) = beam%force(1, :) + beam%force(2, :)
            beam%force(2, :) = 0.0_wp
            beam%couple(1, :) = beam%couple(1, :) + beam%couple(2, :)
            beam%couple(2, :) = 0.0_wp
            first = 1
            do i = 1, size(beam%links)
                associate (link => beam%links(i), last => lowered%node_point(i))
                    link%turn_a = [sum(link%turn_a), 0.0_wp]
                    link%turn_b = [sum(link%turn_b), 0.0_wp]
                    link%shear_a = [sum(link%shear_a), 0.0_wp]
                    link%shear_b = [sum(link%shear_b), 0.0_wp]
                    link%load_sum = [sum(link%load_sum), 0.0_wp]
                    link%turn_sum = [sum(link%turn_sum), 0.0_wp]
                    track%link(first:last) = i
                    call find_turns(lowered, i, first, last, track)
                    first = last + 1
                end associate
            end do
        end associate
    end subroutine new_track

    !> Rotations of the ends of a link under a unit force anywhere in it
    subroutine find_turns(lowered, i, first, last, track)
        type(lowered_type), intent(in) :: lowered
        !> The link, its first and its last piece
        integer, intent(in) :: i, first, last
        type(track_type), intent(inout) :: track
        type(piece_load_type) :: nothing(first:last)
        type(field_type) :: starts(first:last)
        real(wp) :: work(last - first + 1, 3), length
        integer :: j

        nothing(:) = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        length = 0.0_wp
        do j = first, last
            track%before(j) = length
            length = length + lowered%pieces(j)%length
        end do
        associate (link => track%beam%links(i))
            call recover_link(lowered%pieces(first:last), nothing, link%length, 1.0_wp, 0.0_wp, -link%inverse, 0.0_wp, 0.0_wp, &
                              link%faa, work, starts)
            do j = first, last
                track%turn_a(:, j) = cubic(starts(j))
            end do
            call recover_link(lowered%pieces(first:last), nothing, link%length, 0.0_wp, 1.0_wp, link%inverse, 0.0_wp, 0.0_wp, &
                              link%fab, work, starts)
            do j = first, last
                track%turn_b(:, j) = cubic(starts(j))
            end do
        end associate
        track%turn_a(0, first) = 0.0_wp
        track%turn_b(0, first) = 0.0_wp

    contains

        !> Deflection from the left end of piece j on
        pure function cubic(start) result(c)
            type(field_type), intent(in) :: start
            real(wp) :: c(0:3)

            associate (p => lowered%pieces(j))
                c = [start%deflection, start%rotation + p%shear_flexibility*start%shear, -p%flexibility*start%moment/2, &
                     -p%flexibility*start%shear/6]
            end associate
        end function cubic

    end subroutine find_turns

    !> Degree in the place of what a train does to a beam
    pure function degree_of(train) result(degree)
        type(train_type), intent(in) :: train
        integer :: degree

        degree = merge(4, 3, size(train%uniform) > 0)
    end function degree_of

    !> Places of a train that are nearer to each other than this are one
    pure function least_distance(track, train) result(distance)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        real(wp) :: distance

        distance = position_tolerance*(track%x(ubound(track%x, 1)) + maxval(abs(train%offset)))
    end function least_distance

    !> The reaches of a range of places
    subroutine find_reaches(track, train, from, to, reaches, error)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        !> Places of the train
        real(wp), intent(in) :: from, to
        !> From left to right
        type(reach_type), allocatable, intent(out) :: reaches(:)
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        type(reach_type), allocatable :: found(:)
        real(wp), allocatable :: place(:)
        real(wp) :: near
        integer :: count, number, i, k, stat

        allocate (place(2 + (size(train%offset) + 2*size(train%uniform))*size(track%x)), stat=stat)
        if (stat == 0) allocate (found(2*size(place)), stat=stat)
        if (stat /= 0) then
            call no_memory(error)
            return
        end if
        near = least_distance(track, train)
        count = 1
        place(1) = from
        do i = 1, size(train%offset)
            call add(train%offset(i))
        end do
        do i = 1, size(train%uniform)
            call add(train%uniform(i)%from)
            call add(train%uniform(i)%to)
        end do
        count = count + 1
        place(count) = to
        call sort(place(:count))
        number = 1
        do k = 2, count - 1
            if (place(k) - place(number) <= near .or. to - place(k) <= near) cycle
            number = number + 1
            place(number) = place(k)
        end do
        if (to > from) then
            number = number + 1
            place(number) = to
        end if
        count = 0
        do k = 1, number
            call add_single(place(k))
            if (k == number) exit
            count = count + 1
            found(count) = reach_at(track, train, place(k), place(k + 1), place(k) + (place(k + 1) - place(k))/2, near)
        end do
        call drop_singles()

    contains

        !> Note the places at which something at a distance from the train's place passes a point
        subroutine add(offset)
            real(wp), intent(in) :: offset
            integer :: j

            do j = 0, ubound(track%x, 1)
                if (track%x(j) - offset <= from .or. track%x(j) - offset >= to) cycle
                count = count + 1
                place(count) = track%x(j) - offset
            end do
        end subroutine add

        !> Add a place by itself
        subroutine add_single(s)
            real(wp), intent(in) :: s

            count = count + 1
            found(count) = reach_at(track, train, s, s, s, near)
        end subroutine add_single

        !> Keep those places by themselves at which other axles act than on both sides
        subroutine drop_singles()
            logical :: keep(count)
            integer :: j

            keep(:) = .true.
            do j = 1, count, 2
                if (j > 1) then
                    found(j - 1)%holds_to = all(found(j - 1)%outside == found(j)%outside)
                    keep(j) = .not. found(j - 1)%holds_to
                end if
                if (j < count) then
                    found(j + 1)%holds_from = all(found(j + 1)%outside == found(j)%outside)
                    keep(j) = keep(j) .and. .not. found(j + 1)%holds_from
                end if
            end do
            reaches = pack(found(:count), keep)
        end subroutine drop_singles

    end subroutine find_reaches

    !> A reach: what acts in it, as the train goes to the right, is told by how many axles are not yet, or no longer, on the beam
    pure function reach_at(track, train, from, to, about, near) result(reach)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        real(wp), intent(in) :: from, to, about
        !> What is not farther from an end of the beam is on it
        real(wp), intent(in) :: near
        type(reach_type) :: reach

        reach%from = from
        reach%to = to
        reach%about = about
        reach%outside = [count(about + train%offset < -near), count(about + train%offset > track%x(ubound(track%x, 1)) + near)]
    end function reach_at

    !> Find the pieces in which axles and uniform loads are, from those of a reach nearby in a few steps
    subroutine enter_reach(track, train, next, reach)
        type(track_type), intent(in) :: track
        type(train_type), intent(in) :: train
        !> By find_reaches
        type(reach_type), intent(in) :: next
        !> The reach where the train was before, if any; the same as the next one then, with all pieces
        type(reach_type), intent(inout) :: reach
        real(wp) :: x, near
        integer :: i, j, n

        n = ubound(track%x, 1)
        near = least_distance(track, train)
        if (.not. allocated(reach%piece)) then
            allocate (reach%piece(size(train%offset)), reach%first(size(train%uniform)), reach%last(size(train%uniform)))
            reach%piece(:) = 0
        end if
        reach%from = next%from
        reach%to = next%to
        reach%about = next%about
        reach%outside = next%outside
        reach%holds_from = next%holds_from
        reach%holds_to = next%holds_to
        do i = 1, size(train%offset)
            x = reach%about + train%offset(i)
            j = reach%piece(i)
            if (.not. (x >= -near .and. x <= track%x(n) + near)) then
                j = 0
            else if (j == 0) then
                j = piece_at(track, x)
            else
                do while (j < n)
                    if (track%x(j) > x) exit
                    j = j + 1
                end do
                do while (j > 1)
                    if (track%x(j - 1) <= x) exit
                    j = j - 1
                end do
            end if
            reach%piece(i) = j
        end do
        do i = 1, size(train%uniform)
            reach%first(i) = 1
            reach%last(i) = 0
            associate (from => reach%about + train%uniform(i)%from, to => reach%about + train%uniform(i)%to)
                if (to <= 0.0_wp .or. from >= track%x(n)) cycle
                reach%first(i) = piece_at(track, from)
                reach%last(i) = piece_at(track, to)
            end associate
        end do
    end subroutine enter_reach

    !> Piece of a place, the nearest one for places beyond the ends
    pure function piece_at(track, x) result(piece)
        type(track_type), intent(in) :: track
        real(wp), intent(in) :: x
        integer :: piece
        integer :: low, high, middle

        low = 0
        high = ubound(track%x, 1)
        do while (high - low > 1)
            middle = low + (high - low)/2
            if (track%x(middle) <= x) then
                low = middle
            else
                high = middle
            end if
        end do
        piece = low + 1
    end function piece_at

    !> Sort numbers (Shell 1959)
    pure subroutine sort(numbers)
        real(wp), intent(inout) :: numbers(:)
        real(wp) :: one
        integer :: gap, i, j

        gap = 1
        do while (gap < size(numbers)/3)
            gap = 3*gap + 1
        end do
        do while (gap > 0)
            do i = gap + 1, size(numbers)
                one = numbers(i)
                j = i
                do while (j > gap)
                    if (numbers(j - gap) <= one) exit
                    numbers(j) = numbers(j - gap)
                    j = j - gap
                end do
                numbers(j) = one
            end do
            gap = gap/3
        end do
    end subroutine sort

    !> Put a train on the beam: its loads are the second ones of the links
    subroutine place_train(track, train, reach, s)
        type(track_type), intent(inout) :: track
        type(train_type), intent(in) :: train
        !> The reach, by enter_reach, and a place in it
        type(reach_type), intent(in) :: reach
        real(wp), intent(in) :: s
        integer :: i, j

        do i = 1, track%loaded
            associate (link => track%beam%links(track%with_load(i)))
                link%turn_a(2) = 0.0_wp
                link%turn_b(2) = 0.0_wp
                link%shear_a(2) = 0.0_wp
                link%shear_b(2) = 0.0_wp
                link%load_sum(2) = 0.0_wp
                link%turn_sum(2) = 0.0_wp
                track%is_loaded(track%with_load(i)) = .false.
            end associate
        end do
        track%loaded = 0
        do i = 1, size(train%offset)
            if (reach%piece(i) == 0) cycle
            call add_force(reach%piece(i), within(track, reach%piece(i), s + train%offset(i)), &
                           scale(train%force(i), -track%force_unit))
        end do
        do i = 1, size(train%uniform)
            do j = reach%first(i), reach%last(i)
                call add_uniform(j, within(track, j, s + train%uniform(i)%from), within(track, j, s + train%uniform(i)%to), &
                                 scale(train%uniform(i)%q, track%length_unit - track%force_unit))
            end do
        end do

    contains

        !> A force in a piece
        subroutine add_force(piece, t, force)
            integer, intent(in) :: piece
            real(wp), intent(in) :: t, force
            real(wp) :: distance, rest

            call note(track%link(piece))
            associate (link => track%beam%links(track%link(piece)))
                distance = track%before(piece) + t
                rest = max(0.0_wp, link%length - distance)
                link%turn_a(2) = link%turn_a(2) + force*value_of_cubic(track%turn_a(:, piece), t)
                link%turn_b(2) = link%turn_b(2) + force*value_of_cubic(track%turn_b(:, piece), t)
                link%shear_a(2) = link%shear_a(2) + force*rest*link%inverse
                link%shear_b(2) = link%shear_b(2) - force*min(1.0_wp, distance*link%inverse)
                link%load_sum(2) = link%load_sum(2) + abs(force)
                link%turn_sum(2) = link%turn_sum(2) + link%bending*abs(force)*distance*rest*link%inverse
            end associate
        end subroutine add_force

        !> A uniform load in a piece from one distance from its left end to another
        subroutine add_uniform(piece, from, to, q)
            integer, intent(in) :: piece
            real(wp), intent(in) :: from, to, q
            real(wp) :: whole, middle

            if (.not. to > from) return
            call note(track%link(piece))
            associate (link => track%beam%links(track%link(piece)))
                whole = q*(to - from)
                middle = track%before(piece) + (from + (to - from)/2)
                link%turn_a(2) = link%turn_a(2) + q*integral(track%turn_a(:, piece), from, to)
                link%turn_b(2) = link%turn_b(2) + q*integral(track%turn_b(:, piece), from, to)
                link%shear_a(2) = link%shear_a(2) + whole*max(0.0_wp, link%length - middle)*link%inverse
                link%shear_b(2) = link%shear_b(2) - whole*min(1.0_wp, middle*link%inverse)
                link%load_sum(2) = link%load_sum(2) + abs(whole)
                link%turn_sum(2) = link%turn_sum(2) + link%bending*abs(whole)*middle
            end associate
        end subroutine add_uniform

        !> Note that a link has loads of the train
        subroutine note(link)
            integer, intent(in) :: link

            if (track%is_loaded(link)) return
            track%is_loaded(link) = .true.
            track%loaded = track%loaded + 1
            track%with_load(track%loaded) = link
        end subroutine note

    end subroutine place_train

    !> Distance of a place from the left end of a piece, in it, in the engine's units
    pure function within(track, piece, x) result(t)
        type(track_type), intent(in) :: track
        integer, intent(in) :: piece
        real(wp), intent(in) :: x
        real(wp) :: t

        t = min(max(scale(x - track%x(piece - 1), -track%length_unit), 0.0_wp), track%length(piece))
    end function within

    !> Value of a cubic
    pure function value_of_cubic(c, t) result(value)
        real(wp), intent(in) :: c(0:3)
        real(wp), intent(in) :: t
        real(wp) :: value

        value = c(0) + t*(c(1) + t*(c(2) + t*c(3)))
    end function value_of_cubic

    !> Integral of a cubic, as a sum about the middle, where no digits cancel
    pure function integral(c, from, to) result(area)
        real(wp), intent(in) :: c(0:3)
        real(wp), intent(in) :: from, to
        real(wp) :: area
        real(wp) :: m, h

        m = from + (to - from)/2
        h = (to - from)/2
        area = 2*h*(value_of_cubic(c, m) + h**2*(c(2) + 3*m*c(3))/3)
    end function integral

end module gapbeam_train
