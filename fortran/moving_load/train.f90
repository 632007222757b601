!> Loads that move together: axles and uniform loads on a beam at one position of the train.
!>
!> The place of a train is that of its first axle. While no axle, and no end of a uniform load, passes a point at which a piece
!> of the beam ends, what it does to the links is a polynomial in the place: the rotations of the simple bar under a unit
!> force are the deflections under unit moments at its ends (Maxwell), of degree 3 in every piece. Such a range of places is a
!> interval.
module gapbeam_train
    use gapbeam_kinds, only: wp
    use gapbeam_error, only: error_type, failed
    use gapbeam_element, only: field_type
    use gapbeam_link, only: piece_load_type, recover_link
    use gapbeam_model, only: beam_type, drop_loads
    use gapbeam_assembled_model, only: assembled_type, point_x
    use gapbeam_tolerances, only: position_tolerance
    implicit none
    private
    public :: train_type, uniform_type, track_type, new_track, degree_of, least_distance

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
        !> What passes (pass_train)
        type(train_type) :: train
        !> Exponents of the units of length and force
        integer :: length_unit = 0, force_unit = 0
        !> Links with loads of the train, the first `loaded` of them
        integer, allocatable :: with_load(:)
        integer :: loaded = 0
        logical, allocatable :: is_loaded(:)
    end type track_type

contains

    !> Make a beam ready for trains
    subroutine new_track(assembled, track, error)
        !> The beam, without foundations
        type(assembled_type), intent(in) :: assembled
        type(track_type), intent(out) :: track
        !> No memory
        type(error_type), allocatable, intent(out) :: error
        integer :: i, j, n, first, stat

        n = size(assembled%pieces)
        allocate (track%x(0:n), track%link(n), track%before(n), track%length(n), track%turn_a(0:3, n), track%turn_b(0:3, n), &
                  track%with_load(size(assembled%beam%links)), track%is_loaded(size(assembled%beam%links)), stat=stat)
        if (failed(stat, error)) return
        track%beam = assembled%beam
        track%is_loaded(:) = .false.
        track%length_unit = assembled%units%length
        track%force_unit = assembled%units%force
        track%length(:) = assembled%pieces%length
        track%x(0:) = [(point_x(assembled, j), j=0, n)]
        associate (beam => track%beam)
            beam%force(1, :) = beam%force(1, :) + beam%force(2, :)
            beam%couple(1, :) = beam%couple(1, :) + beam%couple(2, :)
            first = 1
            do i = 1, size(beam%links)
                associate (link => beam%links(i), last => assembled%node_point(i))
                    link%turn_a(1) = sum(link%turn_a)
                    link%turn_b(1) = sum(link%turn_b)
                    link%shear_a(1) = sum(link%shear_a)
                    link%shear_b(1) = sum(link%shear_b)
                    link%load_sum(1) = sum(link%load_sum)
                    link%turn_sum(1) = sum(link%turn_sum)
                    track%link(first:last) = i
                    call find_turns(assembled, i, first, last, track)
                    first = last + 1
                end associate
            end do
            call drop_loads(beam, 2)
        end associate
    end subroutine new_track

    !> Rotations of the ends of a link under a unit force anywhere in it
    subroutine find_turns(assembled, i, first, last, track)
        type(assembled_type), intent(in) :: assembled
        !> The link, its first and its last piece
        integer, intent(in) :: i, first, last
        type(track_type), intent(inout) :: track
        type(piece_load_type) :: no_load(first:last)
        type(field_type) :: starts(first:last)
        real(wp) :: work(last - first + 1, 3), length
        integer :: j

        no_load(:) = piece_load_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
        length = 0.0_wp
        do j = first, last
            track%before(j) = length
            length = length + assembled%pieces(j)%length
        end do
        associate (link => track%beam%links(i))
            call recover_link(assembled%pieces(first:last), no_load, link%length, 1.0_wp, 0.0_wp, -link%inverse, 0.0_wp, 0.0_wp, &
                              link%faa, work, starts)
            do j = first, last
                track%turn_a(:, j) = cubic(starts(j))
            end do
            call recover_link(assembled%pieces(first:last), no_load, link%length, 0.0_wp, 1.0_wp, link%inverse, 0.0_wp, 0.0_wp, &
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

            associate (p => assembled%pieces(j))
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
    pure function least_distance(track) result(distance)
        type(track_type), intent(in) :: track
        real(wp) :: distance

        distance = position_tolerance*(track%x(ubound(track%x, 1)) + maxval(abs(track%train%offset)))
    end function least_distance

end module gapbeam_train
